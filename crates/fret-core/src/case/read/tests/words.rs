//! Mistakes of structure are told in the words of a case file.

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
        ("[32, 32]", "3.5", "found 3.5, expected numbers of cells [x, y], or one number for a line contact"),
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
        ("'auto'", "[-1e-4, 1e-4]", "grid.size = [-0.0001, 0.0001]: both must be positive finite lengths"),
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
