//! What a text is refused for before its values are judged, and how the rest is judged beside what was refused.

mod words;

use super::MOST_MISTAKES;
use crate::case::Case;
use crate::case::check::tests::BALL;
use crate::document::{DEEPEST, LONGEST, toml_of};

/// What every mistake says, and what stands at its place.
fn mistakes(text: &str) -> Vec<(String, String, String)> {
    let error = Case::from_toml(text, "case.toml").expect_err(text);
    let at = |span: std::ops::Range<usize>| text.get(span).unwrap_or("nowhere").to_owned();
    let all = error.mistakes().iter();
    all.map(|mistake| {
        let place = mistake.span.clone().map_or("nowhere".to_owned(), at);
        (mistake.message.clone(), place, mistake.help.clone().unwrap_or_default())
    })
    .collect()
}

/// The mistakes are these: their words, and what stands at their places.
fn told(text: &str, expected: &[(&str, &str)]) {
    let found = mistakes(text);
    assert_eq!(found.len(), expected.len(), "{found:#?}");
    for ((message, place, _), (words, at)) in found.iter().zip(expected) {
        assert!(message.contains(words) && place.contains(at), "{found:#?}\n{words}, {at}");
    }
}

fn changed(from: &str, to: &str) -> String {
    assert!(BALL.contains(from), "{from}");
    BALL.replacen(from, to, 1)
}

#[test]
fn texts_beyond_any_case_are_refused_before_they_are_walked() {
    let filled = |length: usize| format!("{BALL}#{}", "-".repeat(length - BALL.len() - 1));
    assert!(Case::from_toml(&filled(LONGEST), "case.toml").is_ok());
    told(&filled(LONGEST + 1), &[("4194305 bytes: a case file has at most 4194304", "nowhere")]);
    let brackets = |count: usize| {
        let of_case = BALL.bytes().filter(|byte| b"[{".contains(byte)).count();
        format!("{BALL}# {}", "[{".repeat((count - of_case) / 2) + &"[".repeat((count - of_case) % 2))
    };
    assert!(Case::from_toml(&brackets(100_000), "case.toml").is_ok());
    told(&brackets(100_001), &[("more than 100000 brackets", "nowhere")]);
    // tables in tables, and lists in lists: the root is one table, the value of the key below it the next
    for (open, value, close) in [("{ x = ", "1", " }"), ("[", "", "]")] {
        let nested = |depth: usize| {
            format!("{BALL}[deep]\nx = {}{value}{}\n", open.repeat(depth - 2), close.repeat(depth - 2))
        };
        told(&nested(DEEPEST), &[("unknown key `deep`", "deep")]);
        told(&nested(DEEPEST + 1), &[("tables nested deeper than 16", "nowhere")]);
    }
    told("[grid", &[("not readable as TOML", "")]);
    told("size = [4e-3 0.0]", &[("not readable as TOML: a comma is missing between numbers", "4e-3 0.0")]);
    for (table, place) in [
        ("{ young = 210e3 poisson = 0.3 }", "poisson"),
        ("{ name = 'a' poisson = 0.3 }", "poisson"),
        ("{ young = 1.0\n poisson = 0.3 }", "poisson"),
        ("{ young = { a = 1 } poisson = 0.3 }", "poisson"),
    ] {
        let text = format!("substrate = {table}\n");
        told(&text, &[("not readable as TOML: a comma is missing between keys of a table", place)]);
        assert_eq!(mistakes(&text)[0].2, ", poisson");
    }
    told("a = ['b' 3]\n", &[("a comma is missing between entries of a list", "3")]);
    // not every second `=` is one
    told("a = { b = = 3 }\n", &[("not readable as TOML: ", "")]);
    assert!(!mistakes("a = { b = = 3 }\n")[0].0.contains("comma is missing"));
}

#[test]
fn a_sweep_is_told_as_such_not_by_each_of_its_keys() {
    told(
        "[base]\nfile = 'case.toml'\n[axes]\n'friction.coefficient' = [0.1]",
        &[("a sweep over cases, not a case", "base")],
    );
    // a key of that name in a case is one that is not known
    told(&format!("base = 1\n{BALL}"), &[("unknown key `base`", "base")]);
}

#[test]
fn mistakes_beyond_the_thirtieth_are_not_looked_for() {
    let unknown =
        |count: usize| (0..count).map(|n| format!("{}_ = 1\n", "z".repeat(n + 20))).collect::<String>();
    for (count, found) in
        [(3, 4), (MOST_MISTAKES - 1, MOST_MISTAKES), (MOST_MISTAKES, MOST_MISTAKES), (50, MOST_MISTAKES)]
    {
        // after the unknown keys are all told, the rest is judged
        let text = unknown(count) + &changed("coefficient = 0.3", "coefficient = -0.3");
        assert_eq!(mistakes(&text).len(), found, "{count}");
    }
}

#[test]
fn a_misspelt_key_is_judged_as_the_one_that_was_meant() {
    let text = changed("[friction]\ncoefficient = 0.3", "[frction]\ncoefficient = -0.3");
    told(&text, &[("unknown key `frction`", "frction"), ("coefficient = -0.3", "-0.3")]);
    assert_eq!(mistakes(&text)[0].2, "did you mean `friction`?");
    // not where the one that was meant is there
    let text = changed("coefficient = 0.3", "coefficient = -0.3\ncoeficient = -0.4");
    told(&text, &[("coefficient = -0.3", "-0.3"), ("unknown key `coeficient`", "coeficient")]);
    // one letter in three, and no more: neighbours exchanged and another letter changed are two
    let help =
        |key: &str| mistakes(&changed("young = 1.0", &format!("young = 1.0, {key} = 1.0")))[0].2.clone();
    for (key, meant) in
        [("yuong", "did you mean `young`?"), ("yuonk", "`fret schema` lists every key with its meaning")]
    {
        assert_eq!(help(key), meant);
    }
    // words, too
    let text = changed("increments = 1", "increments = 1\nramp = \"liner\"\n[solver]\ntolerance = 1.0");
    told(&text, &[("unknown name `liner`", "\"liner\""), ("tolerance = 1e0", "1.0")]);
    assert_eq!(mistakes(&text)[0].2, "did you mean `linear`?");
}

#[test]
fn beside_a_value_of_the_wrong_type_the_rest_is_judged_and_nothing_is_told_twice() {
    let wrong = [
        ("cells = [16, 32]", "cells = \"many\"", "\"many\""),
        ("size = [3.0, 3.0]", "size = true", "true"),
        ("young = 1.0", "young = \"soft\"", "\"soft\""),
        ("radius = 100.0", "radius = [1.0]", "[1.0]"),
        ("size = [3.0, 3.0]", "size = [3.0, 3.0]\nperiodic = 1.5", "1.5"),
        ("increments = 1", "increments = 1\nname = 3", "3"),
        ("increments = 1", "increments = 1\n[output]\nevery = 2.5", "2.5"),
        ("[3.0, 3.0]", "[3.0, 3.0, 3.0]", "[3.0, 3.0, 3.0]"),
        ("increments = 1", "increments = 1\nshift = \"there\"", "\"there\""),
        ("radius = 100.0", "radius = 100.0\n[profile.heights]\nvalues = 3.0", "3.0"),
    ];
    for (from, to, place) in wrong {
        let text = changed(from, to);
        let found = mistakes(&text);
        assert!(found[0].0.contains("expected"), "{to}: {found:#?}");
        assert_eq!((found.len(), found[0].1.as_str()), (1, place), "{to}: {found:#?}");
        let text = text.replacen("coefficient = 0.3", "coefficient = -0.3", 1);
        let both = mistakes(&text);
        let friction = both.iter().filter(|(message, ..)| message.contains("coefficient = -0.3")).count();
        assert_eq!((both.len(), friction), (2, 1), "{to}: {both:#?}");
    }
}

#[test]
fn a_list_with_wrong_entries_is_one_mistake() {
    let text =
        changed("increments = 1", "increments = 1\nshift = [true, true]\n[output]\nfields = [1, \"gap\", 2]");
    let found = mistakes(&text);
    assert_eq!(found.len(), 2, "{found:#?}");
}

#[test]
fn tables_that_a_case_cannot_do_without_are_all_asked_for() {
    let names = ["grid", "upper", "lower", "load"];
    let found = mistakes("");
    for name in names {
        let words = format!("missing key `{name}`");
        assert_eq!(found.iter().filter(|(message, ..)| message.contains(&words)).count(), 1, "{found:#?}");
    }
    assert_eq!(found.len(), names.len(), "{found:#?}");
    // what stands in for them is not judged, nor is the rest with it
    let text =
        changed("[grid]\ncells = [16, 32]\nsize = [3.0, 3.0]\n", "").replacen("= 0.3\n", "= -0.3\n", 1);
    told(&text, &[("missing key `grid`", "")]);
    // a wrong type beside it is told
    let text = text.replacen("young = 1.0", "young = \"soft\"", 1);
    told(&text, &[("missing key `grid`", ""), ("found the text \"soft\"", "soft")]);
}

#[test]
fn what_an_entry_takes_with_it_when_it_is_refused_is_no_mistake_of_its_own() {
    // the sphere loses its only key
    told(&changed("radius = 100.0", "banana = 1.0"), &[("unknown key `banana`", "banana")]);
    // the profile its only shape, a body what it is made of, a list of a pair one of its two
    told(&changed("[profile.sphere]", "[profile.banana]"), &[("unknown key `banana`", "banana")]);
    told(
        &changed("young = 1.0, poisson = 0.3", "young = 1.0"),
        &[("missing key `poisson`", "{ young = 1.0 }")],
    );
    told(&changed("rigid = true", "rigid = 1.5"), &[("found 1.5", "1.5")]);
    told(&changed("[3.0, 3.0]", "[3.0, \"wide\"]"), &[("found the text \"wide\"", "wide")]);
}

#[test]
fn what_is_missing_is_told_beside_what_is_refused_elsewhere() {
    let without =
        |from: &str, to: &str| changed("young = 1.0, poisson = 0.3", "young = 1.0").replacen(from, to, 1);
    let missing = ("missing key `poisson`", "{ young = 1.0 }");
    // tables are read by the order of their names: load before lower, lower before profile
    told(&without("normal_force = 0.01", "apple = 1"), &[missing, ("unknown key `apple`", "apple")]);
    told(&without("radius = 100.0", "apple = 1"), &[missing, ("unknown key `apple`", "apple")]);
    told(&without("cells = [16, 32]", "apple = 1"), &[("unknown key `apple`", "apple"), missing]);
    let text = changed("radius = 100.0", "").replacen("cells = [16, 32]", "apple = 1", 1);
    told(&text, &[("unknown key `apple`", "apple"), ("missing key `radius`", "[profile.sphere]")]);
    // in one table, too: what the first takes with it is the other's
    told(
        &changed("radius = 100.0", "apple = 1\nbanana = 2"),
        &[("`apple`", "apple"), ("`banana`", "banana")],
    );
}

#[test]
fn null_means_not_given() {
    let value: serde_json::Value =
        serde_json::from_str(r#"{ "a": null, "b": { "c": null, "d": [1, { "e": null, "f": 2.5 }] } }"#)
            .unwrap();
    let text = toml_of(&value).unwrap();
    let table: toml::Table = text.parse().unwrap();
    assert_eq!(table, "[b]\nd = [1, { f = 2.5 }]".parse().unwrap());
    assert!(toml_of(&serde_json::json!(3)).unwrap_err().contains("not a case"));
    assert!(Case::from_json("{", "case.json").unwrap_err().to_string().contains("not readable as JSON"));
}

#[test]
fn mistakes_of_several_kinds_are_told_together() {
    let text = changed("cells = [16, 32]", "cells = [16]")
        .replacen("size = [3.0, 3.0]", "size = \"automatic\"", 1)
        .replacen("radius = 100.0", "radius = -100.0", 1)
        .replacen("increments = 1", "increments = 1\ntangential_force = 0.05", 1);
    told(
        &text,
        &[
            ("found 1 value, expected a list of two values", "[16]"),
            ("automatic", "automatic"),
            ("-100.0", "-100.0"),
            ("found 0.05", "0.05"),
        ],
    );
}

/// An endless search for the depth at which such a coating is gone was the answer once.
#[test]
fn a_coating_without_a_thickness_is_refused_where_it_wears() {
    let coated = changed(
        "substrate = { young = 1.0, poisson = 0.3 }",
        "substrate = { young = 1.0, poisson = 0.3, wear_coefficient = 1.0 }\n\
         coatings = [{ thickness = nan, young = 1.0, poisson = 0.3, wear_coefficient = 1.0 }]\n[wear]",
    );
    told(&coated, &[("lower.coatings[0].thickness: ", "nan")]);
}

#[test]
fn a_date_is_called_a_date() {
    told(
        &changed("radius = 100.0", "radius = 1979-05-27"),
        &[("found the date 1979-05-27, expected a number", "1979")],
    );
}
