//! One pass tells all: a table of its own, with every kind of key.

use schemars::JsonSchema;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::{Read, Reader};
use crate::document::{At, Keys, Range, Table};

#[derive(Debug, PartialEq, Table)]
struct Thing {
    name: Option<String>,
    #[range(Range::POSITIVE.help("more"))]
    size: f64,
    #[range(Range::between(0.0, 1.0, "must lie between 0 and 1"))]
    parts: Option<At<[f64; 2]>>,
    #[table(flatten)]
    more: More,
    inner: Option<Vec<Inner>>,
}

#[derive(Debug, PartialEq, Table)]
struct More {
    colour: Option<Colour>,
    count: Option<Count>,
}

#[derive(Debug, PartialEq, Table)]
struct Inner {
    #[range(Range::NEGATIVE)]
    depth: f64,
    width: usize,
}

#[derive(Debug, Clone, Copy, PartialEq, Table, JsonSchema)]
enum Colour {
    Green,
    #[schemars(rename = "deep red")]
    Red,
    LightBlue,
}

#[derive(Debug, PartialEq, Table)]
#[expected("a number or a word")]
enum Count {
    Number(usize),
    Word(Colour),
}

/// What is read, and the mistakes with what stands at their places.
fn read(text: &str) -> (Option<Thing>, Vec<(String, String, String)>) {
    let root = DeTable::parse(text).unwrap();
    let root = Spanned::new(root.span(), DeValue::Table(root.into_inner()));
    let mut reader = Reader::default();
    let thing = Thing::read(&root, &mut reader).ok();
    let (mistakes, places) = reader.end();
    assert!(places.are_whole() == mistakes.is_empty() || thing.is_none(), "{mistakes:?}");
    let told = |mistake: &crate::document::Mistake| {
        let place = text[mistake.span.clone().unwrap()].to_owned();
        (mistake.message.clone(), place, mistake.help.clone().unwrap_or_default())
    };
    (thing, mistakes.iter().map(told).collect())
}

fn messages(text: &str) -> Vec<String> {
    read(text).1.into_iter().map(|(message, place, _)| format!("{message} @ {place}")).collect()
}

#[test]
fn a_right_table_is_read() {
    let (thing, mistakes) = read(
        "size = 2\nparts = [0.5, 1]\ncolour = 'light_blue'\ncount = 'deep red'\ninner = [{ depth = -1, width = 3 }]\nname = 'a'",
    );
    assert!(mistakes.is_empty());
    let Thing { name, size, parts, more, inner } = thing.unwrap();
    assert_eq!((name.as_deref(), size, parts.unwrap().value), (Some("a"), 2.0, [0.5, 1.0]));
    assert_eq!(more, More { colour: Some(Colour::LightBlue), count: Some(Count::Word(Colour::Red)) });
    assert_eq!(inner, Some(vec![Inner { depth: -1.0, width: 3 }]));
    assert_eq!(Thing::keys(), ["name", "size", "parts", "colour", "count", "inner"]);
}

#[test]
fn every_mistake_is_told_in_one_pass() {
    let text = "size = -2\nparts = [0.5, 3]\ncolor = 'green'\ncount = []\ninner = [{ depth = 1, wide = 3 }, { depth = 'low', width = -1 }]\nname = 3\nbanana = 1";
    let mut found = messages(text);
    found.sort();
    let mut right = [
        "unknown key `banana`, expected one of `name`, `size`, `parts`, `colour`, `count`, `inner` @ banana",
        "unknown key `color`, expected one of `name`, `size`, `parts`, `colour`, `count`, `inner` @ color",
        "found 3, expected a text in quotes @ 3",
        "size = -2.0: must be positive and finite @ -2",
        "parts = [0.5, 3.0]: must lie between 0 and 1 @ [0.5, 3]",
        "found a list, expected a number or a word @ []",
        "unknown key `wide`, expected `depth` or `width` @ wide",
        "inner[0].depth = 1.0: must be negative and finite @ 1",
        "found the text \"low\", expected a number @ 'low'",
        "found -1, expected a whole number, 0 or more @ -1",
    ];
    right.sort_unstable();
    assert_eq!(found, right);
}

#[test]
fn what_was_meant_is_read_and_what_is_missing_is_told_once() {
    let (thing, mistakes) = read("siz = 3.0");
    assert_eq!((thing.unwrap().size, mistakes[0].2.as_str()), (3.0, "did you mean `size`?"));
    assert_eq!(messages(""), ["missing key `size` @ "]);
    // a word cut short, or with a letter too many; a word of another kind stands for nothing
    let colour = |word: &str| read(&format!("size = 1\ncolour = {word}")).0.unwrap().more.colour;
    assert_eq!(
        ["'light'", "'greeen'", "3"].map(colour),
        [Some(Colour::LightBlue), Some(Colour::Green), None]
    );
    // an entry that takes a key with it
    let lost = messages("size = 1\ninner = [{ depth = -1, x = 1 }]");
    assert_eq!(lost, ["unknown key `x`, expected `depth` or `width` @ x"]);
    // a number too large for one
    assert_eq!(messages("size = 1e999"), ["found 1e999, too large a number, expected a number @ 1e999"]);
}

#[test]
fn numbers_out_of_their_ranges_are_found_in_what_no_document_holds() {
    let inner = |depth| Some(Inner { depth, width: 1 });
    let thing = |size, inner: Option<Inner>| Thing {
        name: None,
        size,
        parts: None,
        more: More { colour: None, count: None },
        inner: inner.map(|inner| vec![inner]),
    };
    assert_eq!(thing(1.0, inner(-1.0)).key_fault(), None);
    let fault = thing(f64::NAN, None).key_fault().unwrap();
    assert_eq!(fault, ("size".to_owned(), "size = NaN: must be positive and finite".to_owned()));
    assert_eq!(inner(0.0).unwrap().key_fault().unwrap().0, "depth");
}
