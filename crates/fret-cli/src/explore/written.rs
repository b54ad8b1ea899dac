//! The text of a case with other numbers at some of its keys: comments, order and whatever else was written stay as they are.

use std::collections::BTreeMap;
use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// The text with the numbers; `None` where a key has no number of its own in it.
pub fn with_numbers(text: &str, values: &BTreeMap<String, f64>) -> Option<String> {
    let root = DeTable::parse(text).ok()?;
    let mut places: Vec<(Range<usize>, f64)> = Vec::new();
    for (key, value) in values {
        let span = place_of(root.get_ref(), key)?;
        // a number that was not moved stays as it was written: 210e3, 1_000
        let own: f64 = text.get(span.clone())?.replace('_', "").parse().ok()?;
        if own.to_bits() != value.to_bits() {
            places.push((span, *value));
        }
    }
    places.sort_by_key(|(span, _)| std::cmp::Reverse(span.start));
    let mut text = text.to_owned();
    for (span, value) in places {
        text.replace_range(span, &format!("{value:?}"));
    }
    Some(text)
}

/// Where the value of a dotted key stands.
fn place_of(table: &DeTable<'_>, key: &str) -> Option<Range<usize>> {
    let mut parts = key.split('.');
    let mut here = entry(table, parts.next()?)?;
    for part in parts {
        here = match here.get_ref() {
            DeValue::Table(table) => entry(table, part)?,
            DeValue::Array(items) => {
                let named = items.iter().find(|item| name_of(item.get_ref()) == Some(part));
                named.or_else(|| items.get(part.parse::<usize>().ok()?))?
            }
            _ => return None,
        };
    }
    Some(here.span())
}

fn entry<'a, 'b>(table: &'a DeTable<'b>, name: &str) -> Option<&'a Spanned<DeValue<'b>>> {
    table.iter().find(|(key, _)| key.get_ref().as_ref() == name).map(|(_, value)| value)
}

/// The name of a stage.
fn name_of<'a>(item: &'a DeValue<'_>) -> Option<&'a str> {
    let DeValue::Table(table) = item else { return None };
    match entry(table, "name")?.get_ref() {
        DeValue::String(name) => Some(name.as_ref()),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CASE: &str = "# a comment\nfriction.coefficient = 0.2  # of steel\r\n\n[lower]\nsubstrate = { young = 210e3, poisson = 0.3 } # both\n\
                        # stages\n[[load]]\nname = \"press\"\nnormal_force = 1_000\n[[load]]\nshift = [1e-3, 0]   # x, y\n";

    fn with(values: &[(&str, f64)]) -> Option<String> {
        let values: BTreeMap<String, f64> =
            values.iter().map(|(key, value)| ((*key).to_owned(), *value)).collect();
        with_numbers(CASE, &values)
    }

    #[test]
    fn numbers_change_and_nothing_else() {
        let found = with(&[
            ("friction.coefficient", 0.25),
            ("lower.substrate.young", 210e3),
            ("lower.substrate.poisson", 0.31),
            ("load.press.normal_force", 1e3),
            ("load.1.shift.0", 2.5e-7),
            ("load.1.shift.1", 2.0),
        ]);
        let right = CASE
            .replace("0.2 ", "0.25 ")
            .replace("poisson = 0.3", "poisson = 0.31")
            .replace("[1e-3, 0]", "[2.5e-7, 2.0]");
        assert_eq!(found.as_deref(), Some(&right[..]));
        assert_eq!(with(&[]).as_deref(), Some(CASE));
    }

    #[test]
    fn a_key_without_a_number_in_the_text_has_no_place() {
        for key in ["friction.max_shear", "load.rub.shift.0", "load.1.shift.2", "load.press.name", "load"] {
            assert_eq!(with(&[(key, 1.0)]), None, "{key}");
        }
    }
}
