//! A dotted key: which entry of a case an axis changes.

use toml::{Table, Value};

/// Gives `value` to the entry of a case that a dotted key names.
///
/// Parts are names of tables, numbers of a list's entries from 0 (negative: from the end; `load[0]` is `load.0`), or, in a list of tables, the
/// `name` of one. Tables that are not there are made, entries of lists are not.
///
/// # Errors
/// What stands where the key leads, when it leads nowhere.
pub fn put(case: &mut Table, key: &str, value: &Value) -> Result<(), String> {
    let nothing = || Value::Table(Table::new());
    let key = dotted(key);
    let key = key.as_str();
    let (first, rest) = key.split_once('.').map_or((key, None), |(first, rest)| (first, Some(rest)));
    let (mut here, mut place) = (case.entry(first).or_insert_with(nothing), first.to_owned());
    for part in rest.into_iter().flat_map(|rest| rest.split('.')) {
        here = match here {
            Value::Table(table) => table.entry(part).or_insert_with(nothing),
            Value::Array(items) => {
                let index = entry_of(items, &place, part)?;
                &mut items[index]
            }
            other => return Err(format!("{place} is {other}, which has no entry `{part}`")),
        };
        place = format!("{place}.{part}");
    }
    *here = value.clone();
    Ok(())
}

/// A key with the numbers of entries between points: `load[0].normal_force`, as derivatives name it, is `load.0.normal_force`.
pub fn dotted(key: &str) -> String {
    let is_number = |word: &str| word.parse::<isize>().is_ok();
    let part = |part: &str| match part.strip_suffix(']').and_then(|part| part.split_once('[')) {
        Some((name, numbers)) if numbers.split("][").all(is_number) => {
            std::iter::once(name).chain(numbers.split("][")).collect::<Vec<_>>().join(".")
        }
        _ => part.to_owned(),
    };
    key.split('.').map(part).collect::<Vec<_>>().join(".")
}

/// Parts of a key that are no numbers of entries.
pub fn words_of(key: &str) -> Vec<&str> {
    key.split('.').filter(|part| part.parse::<usize>().is_err()).collect()
}

fn entry_of(items: &[Value], place: &str, word: &str) -> Result<usize, String> {
    let named = |item: &Value| item.get("name").and_then(Value::as_str) == Some(word);
    if let Some(index) = items.iter().position(named) {
        return Ok(index);
    }
    let Ok(number) = word.parse::<isize>() else {
        return Err(format!("no entry of {place} is called `{word}`; a number from 0 serves as well"));
    };
    let index =
        if number < 0 { items.len().checked_add_signed(number) } else { usize::try_from(number).ok() };
    index
        .filter(|&index| index < items.len())
        .ok_or_else(|| format!("{place} has {} entries, from 0; there is no {number}", items.len()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_entries_stand_between_points_or_in_brackets() {
        for (key, dotted_key) in [
            ("load[0].normal_force", "load.0.normal_force"),
            ("lower.coatings[1].young", "lower.coatings.1.young"),
            ("load[-1].tangential_force[0]", "load.-1.tangential_force.0"),
            ("friction.coefficient", "friction.coefficient"),
            ("load.press [1]", "load.press .1"),
            ("load.[odd]", "load.[odd]"),
        ] {
            assert_eq!(dotted(key), dotted_key);
        }
        let mut one = case();
        put(&mut one, "load[1].tangential_force[0]", &Value::Float(2.0)).unwrap();
        let mut other = case();
        put(&mut other, "load.1.tangential_force.0", &Value::Float(2.0)).unwrap();
        assert!(one == other && one != case());
    }

    fn case() -> Table {
        "[friction]\ncoefficient = 0.2\n[[load]]\nname = 'press'\nnormal_force = 1.0\n[[load]]\ntangential_force = [1.0, 0.0]"
            .parse()
            .unwrap()
    }

    #[test]
    fn keys_lead_through_tables_lists_and_names_of_stages() {
        for (key, pointer) in [
            ("friction.coefficient", "friction.coefficient"),
            ("load.0.normal_force", "load.0.normal_force"),
            ("load.press.normal_force", "load.0.normal_force"),
            ("load.-1.tangential_force.1", "load.1.tangential_force.1"),
            ("profile.sphere.radius", "profile.sphere.radius"),
        ] {
            let mut case = case();
            put(&mut case, key, &Value::Float(7.0)).unwrap();
            let found = pointer.split('.').fold(Some(&Value::Table(case.clone())).cloned(), |here, part| {
                let here = here?;
                part.parse::<usize>()
                    .map_or_else(|_| here.get(part).cloned(), |index| here.get(index).cloned())
            });
            assert_eq!(found, Some(Value::Float(7.0)), "{key}");
        }
    }

    #[test]
    fn keys_that_lead_nowhere_say_where_they_end() {
        for (key, words) in [
            ("load.2.normal_force", "load has 2 entries, from 0; there is no 2"),
            ("load.-3.normal_force", "there is no -3"),
            ("load.pull.normal_force", "no entry of load is called `pull`"),
            ("friction.coefficient.x", "coefficient is 0.2, which has no entry `x`"),
        ] {
            let refusal = put(&mut case(), key, &Value::Float(7.0)).unwrap_err();
            assert!(refusal.contains(words), "{key}: {refusal}");
        }
    }
}
