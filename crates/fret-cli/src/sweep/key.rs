//! A dotted key: which entry of a case an axis changes.

use toml::{Table, Value};

/// Gives `value` to the entry of a case that a dotted key names.
///
/// Parts are names of tables, numbers of a list's entries from 0 (negative: from the end), or, in a list of tables, the
/// `name` of one. `load[0]` is `load.0` where nothing is called `load[0]`. Tables that are not there are made, entries of lists are not.
///
/// # Errors
/// What stands where the key leads, when it leads nowhere.
pub fn put(case: &mut Table, key: &str, value: &Value) -> Result<(), String> {
    let mut all = Value::Table(std::mem::take(case));
    let done = put_in(&mut all, key, value);
    if let Value::Table(all) = all {
        *case = all;
    }
    done
}

fn put_in(case: &mut Value, key: &str, value: &Value) -> Result<(), String> {
    let (mut here, mut place) = (case, String::new());
    let mut parts: Vec<&str> = key.split('.').rev().collect();
    while let Some(part) = parts.pop() {
        if let Some((name, numbers)) = apart(Some(here), part) {
            parts.extend(numbers.into_iter().rev());
            parts.push(name);
            continue;
        }
        here = match here {
            Value::Table(table) => table.entry(part).or_insert_with(|| Value::Table(Table::new())),
            Value::Array(items) => {
                let index = entry_of(items, &place, part)?;
                &mut items[index]
            }
            other => return Err(format!("{place} is {other}, which has no entry `{part}`")),
        };
        place = if place.is_empty() { part.to_owned() } else { format!("{place}.{part}") };
    }
    *here = value.clone();
    Ok(())
}

/// The name and the numbers of a part as `load[0]`, where nothing is called so.
fn apart<'k>(here: Option<&Value>, part: &'k str) -> Option<(&'k str, Vec<&'k str>)> {
    let (name, numbers) = part.strip_suffix(']')?.split_once('[').filter(|(name, _)| !name.is_empty())?;
    let numbers: Vec<&str> = numbers.split("][").collect();
    let stands_there = match here {
        Some(Value::Table(table)) => table.contains_key(part),
        Some(Value::Array(items)) => items.iter().any(|item| is_called(item, part)),
        _ => false,
    };
    let are_numbers = numbers.iter().all(|number| number.parse::<isize>().is_ok());
    (are_numbers && !stands_there).then_some((name, numbers))
}

fn is_called(item: &Value, name: &str) -> bool {
    item.get("name").and_then(Value::as_str) == Some(name)
}

/// The place in a case that a key names: alike for all ways to write it.
pub fn place(case: &Table, key: &str) -> Vec<String> {
    let all = Value::Table(case.clone());
    let (mut here, mut place) = (Some(&all), Vec::new());
    let mut parts: Vec<&str> = key.split('.').rev().collect();
    while let Some(part) = parts.pop() {
        if let Some((name, numbers)) = apart(here, part) {
            parts.extend(numbers.into_iter().rev());
            parts.push(name);
            continue;
        }
        let index = match here {
            Some(Value::Array(items)) => entry_of(items, "", part).ok(),
            _ => None,
        };
        place.push(index.map_or_else(|| part.to_owned(), |index| index.to_string()));
        here = here.and_then(|here| index.map_or_else(|| here.get(part), |index| here.get(index)));
    }
    place
}

/// Parts of a key that are no numbers of entries.
pub fn words_of(key: &str) -> Vec<&str> {
    key.split('.')
        .map(|part| apart(None, part).map_or(part, |(name, _)| name))
        .filter(|part| part.parse::<usize>().is_err())
        .collect()
}

fn entry_of(items: &[Value], place: &str, word: &str) -> Result<usize, String> {
    if let Some(index) = items.iter().position(|item| is_called(item, word)) {
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

    /// One place in all the ways to write it; a stage may be called as a number of another one is written.
    #[test]
    fn numbers_of_entries_stand_between_points_or_in_brackets() {
        let mut named = case();
        put(&mut named, "load.1.name", &Value::String("rub[1]".to_owned())).unwrap();
        let keys = [
            "load.1.tangential_force.0",
            "load[1].tangential_force[0]",
            "load[-1].tangential_force.0",
            "load.rub[1].tangential_force[-2]",
        ];
        let changed = keys.map(|key| {
            let mut changed = named.clone();
            put(&mut changed, key, &Value::Float(2.0)).unwrap();
            assert_eq!(place(&named, key).join("."), keys[0], "{key}");
            changed
        });
        assert!(changed.iter().all(|one| *one == changed[0] && *one != named));
        assert_eq!(words_of("load[1].tangential_force[0]"), ["load", "tangential_force"]);
        put(&mut case(), "load[2].normal_force", &Value::Float(2.0)).unwrap_err();
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
