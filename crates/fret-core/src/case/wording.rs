//! The parser's messages in the words of a case file: keys, tables, lists, numbers and texts.

use std::borrow::Cow;

/// What the parser says about the structure of a case, as its author would say it; other messages stay as they are.
pub fn in_words(message: &str) -> String {
    let message = message.trim_end();
    let starts = |prefix: &str| message.strip_prefix(prefix);
    if let Some(rest) = starts("invalid type: ").or_else(|| starts("invalid value: ")) {
        return rest.rsplit_once(", expected ").map_or_else(
            || message.to_owned(),
            |(given, wanted)| format!("found {}, expected {}", found(given), expected(wanted)),
        );
    }
    if let Some((count, wanted)) = starts("invalid length ").and_then(|rest| rest.split_once(", expected ")) {
        let values = if count == "1" { "value" } else { "values" };
        return format!("found {count} {values}, expected {}", expected(wanted));
    }
    if let Some(count) = starts("wanted exactly 1 element, found ") {
        return format!("expected exactly one entry, found {}", count.trim_end_matches(" elements"));
    }
    if let Some(rest) = starts("unknown field ") {
        return format!("unknown key {}", rest.replace("there are no fields", "no key belongs here"));
    }
    if let Some(rest) = starts("unknown variant ") {
        return format!("unknown name {rest}");
    }
    if let Some(rest) = starts("missing field ") {
        return format!("missing key {rest}");
    }
    if let Some(rest) = starts("duplicate field ") {
        return format!("key given twice: {rest}");
    }
    if message.starts_with("data did not match any variant") {
        return "fits none of the forms that are allowed here".to_owned();
    }
    message.to_owned()
}

/// Whether a letter would steer a terminal or turn the direction of writing; lines and tabs do not.
pub fn steers(letter: char) -> bool {
    letter.is_control() && !matches!(letter, '\n' | '\t')
        || matches!(letter, '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

/// A text as a terminal may have it: control characters, which would steer it, and marks that turn the direction of writing are
/// shown as `\\u{1b}`; lines and tabs stay.
pub fn printable(text: &str) -> Cow<'_, str> {
    if !text.chars().any(steers) {
        return Cow::Borrowed(text);
    }
    text.chars()
        .fold(String::new(), |mut shown, letter| {
            if steers(letter) {
                shown.extend(letter.escape_unicode());
            } else {
                shown.push(letter);
            }
            shown
        })
        .into()
}

/// What was found.
fn found(given: &str) -> String {
    let bare = |prefix: &str| given.strip_prefix(prefix).map(|value| value.trim_matches('`').to_owned());
    match given {
        "map" => "a table".to_owned(),
        "sequence" => "a list".to_owned(),
        "unit value" | "null" => "nothing".to_owned(),
        _ => given
            .strip_prefix("string ")
            .map(|text| format!("the text {text}"))
            .or_else(|| bare("integer "))
            .or_else(|| bare("floating point "))
            .or_else(|| bare("boolean "))
            .unwrap_or_else(|| given.to_owned()),
    }
}

/// What belongs there.
fn expected(wanted: &str) -> String {
    let plain = match wanted {
        "f64" => "a number",
        "usize" | "u32" | "u64" => "a whole number, 0 or more",
        "i64" => "a whole number",
        "a boolean" => "true or false",
        "a string" | "string" => "a text in quotes",
        "a map" => "a table",
        "a sequence" => "a list",
        "an array of length 2" => "a list of two values",
        "an array of length 3" => "a list of three values",
        _ if wanted.starts_with("struct ") => "a table",
        _ if wanted.starts_with("enum ") => "a name or a table",
        _ => wanted,
    };
    plain.to_owned()
}

#[cfg(test)]
mod tests {
    use crate::case::Case;

    const GOOD: &str = "[grid]\ncells = [32, 32]\nsize = 'auto'\n[upper]\nrigid = true\n[lower]\n\
                        substrate = { young = 210e9, poisson = 0.3 }\n[profile.sphere]\nradius = 10e-3\n\
                        [friction]\ncoefficient = 0.1\n[[load]]\nnormal_force = 12.0\nincrements = 4\n";

    fn said(good: &str, bad: &str) -> String {
        let text = GOOD.replacen(good, bad, 1);
        assert_ne!(text, GOOD, "{good}");
        let error = Case::from_toml(&text, "case.toml").unwrap_err();
        error.mistakes().iter().map(|mistake| mistake.message.clone()).collect::<Vec<_>>().join("\n")
    }

    #[test]
    fn wrong_structure_is_told_in_the_words_of_a_case_file() {
        for (good, bad, words) in [
            ("10e-3", "'ten'", "found the text \"ten\", expected a number"),
            ("10e-3", "[1.0]", "found a list, expected a number"),
            ("10e-3", "true", "found true, expected a number"),
            ("[32, 32]", "[32, -4]", "found -4, expected a whole number, 0 or more"),
            ("[32, 32]", "[32, 2.5]", "found 2.5, expected a whole number, 0 or more"),
            ("[32, 32]", "[32]", "found 1 value, expected a list of two values"),
            (
                "[32, 32]",
                "3.5",
                "found 3.5, expected numbers of cells [x, y], or one number for a line contact",
            ),
            ("rigid = true", "rigid = 'yes'", "found the text \"yes\", expected true or false"),
            ("{ young = 210e9, poisson = 0.3 }", "210e9", "found 210000000000.0, expected a table"),
            ("{ young = 210e9, poisson = 0.3 }", "{ young = 210e9 }", "missing key `poisson`"),
            ("[grid]", "[gird]", "unknown key `gird`"),
            ("increments = 4", "increments = 4\ntable = 'a'\ncolumns = 3", "found 3, expected a table"),
            ("[lower]", "[lower]\ncoatings = 3", "found 3, expected a list"),
            ("10e-3", "{ a = 1 }", "found a table, expected a number"),
            ("increments = 4", "increments = 4\nname = 3", "found 3, expected a text in quotes"),
            (
                "increments = 4",
                "increments = 4\nenvelope = [1, 1, 1]\ncycles = 1",
                "found 3 values, expected a list of two values",
            ),
            (
                "increments = 4",
                "increments = 4\nenvelope = [1, 1, 1, 1]\ncycles = 1",
                "found 4 values, expected a list of two values",
            ),
        ] {
            let message = said(good, bad);
            assert!(message.contains(words), "{bad}: {message}");
        }
    }

    #[test]
    fn one_mistake_is_told_in_one_message_with_the_right_words() {
        for (good, bad, words) in [
            ("[32, 32]", "['a', 'b']", "found the text \"a\", expected a whole number, 0 or more"),
            ("[32, 32]", "[48.5, 48]", "found 48.5, expected a whole number, 0 or more"),
            ("[32, 32]", "[-48, 48]", "found -48, expected a whole number, 0 or more"),
            ("[32, 32]", "[true, 32]", "found true, expected a whole number, 0 or more"),
            (
                "'auto'",
                "[-1e-4, 1e-4]",
                "grid.size = [-0.0001, 0.0001]: both must be positive finite lengths",
            ),
            ("'auto'", "[inf, 1.0]", "grid.size = [inf, 1.0]: both must be positive finite lengths"),
            (
                "12.0\nincrements = 4",
                "'12 N'\ntangential_force = [1.0, 0.0]\nincrements = 4",
                "found the text \"12 N\", expected a number",
            ),
        ] {
            let message = said(good, bad);
            assert_eq!(message, words, "{bad}");
        }
    }

    #[test]
    fn a_printable_text_shows_what_would_steer_a_terminal() {
        assert_eq!(super::printable("press\n\tµ 1"), "press\n\tµ 1");
        assert_eq!(super::printable("p\u{1b}[31mX\u{7}\u{9b}\r"), "p\\u{1b}[31mX\\u{7}\\u{9b}\\u{d}");
        assert_eq!(super::printable("a\u{202e}b"), "a\\u{202e}b");
    }

    #[test]
    fn no_wrong_value_is_answered_in_the_parsers_words() {
        let parsers = [
            "invalid type",
            "invalid value",
            "invalid length",
            "variant",
            "field",
            "struct",
            "enum",
            "f64",
            "usize",
        ];
        let numbers = ["[32, 32]", "'auto'", "true", "210e9", "0.3", "10e-3", "0.1", "12.0", "4\n"];
        for good in numbers {
            for bad in ["'word'", "-1.5", "[]", "{}", "{ x = 1 }", "true", "1979-05-27", "[[1], [2]]"] {
                let text = GOOD.replacen(good, bad, 1) + "\n";
                let Err(error) = Case::from_toml(&text, "case.toml") else { continue };
                for mistake in error.mistakes() {
                    // A field is also what a contact has: pressure, shear.
                    let message = &mistake.message;
                    let heard = parsers.iter().find(|word| message.contains(**word));
                    assert_eq!(heard, None, "{good} -> {bad}: {message}");
                }
            }
        }
    }
}
