//! Words of mistakes: what was found, what is expected, which name was meant.

use std::borrow::Cow;

use toml::Spanned;
use toml::de::DeValue;

/// Letters by which a word that is cut short is known, at the least.
const SHORTEST: usize = 3;
/// Letters of a text, or digits of a number, that a message shows at the most.
const LONGEST: usize = 60;

/// What stands in a document, in words.
pub(super) fn found(value: &Spanned<DeValue<'_>>) -> String {
    match value.get_ref() {
        DeValue::String(text) => format!("the text {:?}", shortened(text)),
        DeValue::Integer(number) => number.to_string(),
        DeValue::Float(number) => match number.as_str().parse::<f64>() {
            Ok(value) if value.is_finite() => {
                let text = value.to_string();
                match (text.len() > LONGEST, text.contains('.')) {
                    (true, _) => format!("{value:e}"),
                    (false, true) => text,
                    (false, false) => text + ".0",
                }
            }
            Ok(value) if number.as_str().contains("inf") || value.is_nan() => value.to_string(),
            _ => format!("{}, too large a number", number.as_str()),
        },
        DeValue::Boolean(value) => value.to_string(),
        DeValue::Datetime(date) => format!("the date {date}"),
        DeValue::Array(_) => "a list".to_owned(),
        DeValue::Table(_) => "a table".to_owned(),
    }
}

/// A text of which a message shows the beginning, when it is long.
pub(super) fn shortened(text: &str) -> Cow<'_, str> {
    match text.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{} ...", &text[..end]).into(),
        None => text.into(),
    }
}

/// Which of the words belong there.
pub(super) fn expected(words: &[&str]) -> String {
    match words {
        [] => "no key belongs here".to_owned(),
        [one] => format!("expected `{one}`"),
        [one, other] => format!("expected `{one}` or `{other}`"),
        many => format!("expected one of `{}`", many.join("`, `")),
    }
}

/// The word that was meant, when it is close to the one found, or the only one that begins so.
pub(super) fn near_miss<'a>(found: &str, words: &[&'a str]) -> Option<&'a str> {
    let nearest = words.iter().map(|word| (strsim::damerau_levenshtein(found, word), *word)).min();
    let close = nearest.filter(|(distance, word)| *distance <= (word.len() / 3).max(1)).map(|(_, word)| word);
    let mut longer = words.iter().filter(|word| found.len() >= SHORTEST && word.starts_with(found));
    let cut_short = longer.next().filter(|_| longer.next().is_none()).copied();
    close.or(cut_short)
}

/// Two numbers in as few digits as tell them apart.
pub fn apart(one: f64, other: f64) -> [String; 2] {
    let rounded = [one, other].map(|value| {
        let short = format!("{value:.5e}").parse::<f64>().unwrap_or(value);
        format!("{short:?}")
    });
    if rounded[0] == rounded[1] { [one, other].map(|value| format!("{value:?}")) } else { rounded }
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

#[cfg(test)]
mod tests {
    use toml::Spanned;
    use toml::de::{DeTable, DeValue};

    #[test]
    fn of_long_texts_and_numbers_a_message_shows_the_beginning() {
        let text = format!(
            "long = \"{}\"\nshort = \"ab\"\nlarge = -1e308\nplain = 2.5\nwhole = 3e2",
            "x".repeat(100)
        );
        let table = DeTable::parse(&text).unwrap();
        let found = |key: &str| -> String {
            let value: &Spanned<DeValue<'_>> = table.get_ref().get(key).unwrap();
            super::found(value)
        };
        assert_eq!(found("long"), format!("the text \"{} ...\"", "x".repeat(60)));
        assert_eq!(found("short"), "the text \"ab\"");
        assert_eq!([found("large"), found("plain"), found("whole")], ["-1e308", "2.5", "300.0"]);
    }

    #[test]
    fn a_printable_text_shows_what_would_steer_a_terminal() {
        assert_eq!(super::printable("press\n\tµ 1"), "press\n\tµ 1");
        assert_eq!(super::printable("p\u{1b}[31mX\u{7}\u{9b}\r"), "p\\u{1b}[31mX\\u{7}\\u{9b}\\u{d}");
        assert_eq!(super::printable("a\u{202e}b"), "a\\u{202e}b");
    }
}
