//! The head of a measured table: which line names the columns, which column holds what, and in which units.

use crate::numbers::{DELIMITERS, cells, delimiter, is_comment, number};
use crate::units::{Heading, is_unit};

use super::asked::Asked;
use super::error::{MeasuredError, refused};
use super::role::{Role, listed, needed};

/// Lines above the first numbers, at the most.
const MOST_ABOVE: usize = 200;

/// Units of other columns: known so that a line of units is not taken for names.
const OTHERS: [&str; 17] =
    ["s", "sec", "ms", "min", "h", "Hz", "1/s", "°C", "C", "K", "%", "V", "mV", "A", "mm/s", "um/s", "rpm"];
/// Units of mass, of which many load cells write their weights.
pub(super) const MASSES: [&str; 4] = ["g", "kg", "mg", "lb"];

/// Where the columns of a table are.
#[derive(Debug)]
pub struct Head {
    /// Lines above the first row, those of the head included.
    pub above: usize,
    /// What parts the columns.
    pub delimiter: char,
    /// The place of every role.
    pub places: Vec<Option<usize>>,
    /// Names, where there are any.
    pub names: Vec<String>,
    /// Units in the line below the names, by place.
    pub units: Vec<String>,
}

impl Head {
    /// The name of a column, and the unit beside or below it.
    pub fn name_and_unit(&self, place: usize) -> (String, Option<String>) {
        let cell = self.names.get(place).cloned().unwrap_or_else(|| format!("column {}", place + 1));
        let (name, unit) = name_and_unit(&cell);
        let below = self.units.get(place).filter(|unit| !unit.is_empty());
        (name, below.cloned().or(unit))
    }

    /// Whether a line repeats the names at the places that are used.
    pub fn is_repeated_by(&self, cells: &[String]) -> bool {
        !self.names.is_empty()
            && self.places.iter().flatten().all(|&place| cells.get(place) == self.names.get(place))
    }

    /// Whether a line has units, or nothing, at the places that are used.
    pub fn units_in(&self, cells: &[String]) -> Option<Vec<String>> {
        let mut any = false;
        for &place in self.places.iter().flatten() {
            let cell = cells.get(place).map_or("", String::as_str);
            any |= !cell.is_empty();
            if cell.parse::<f64>().is_ok() || number(cell, true).is_ok() {
                return None;
            }
        }
        any.then(|| cells.iter().map(|cell| cell.trim_matches(['[', ']', '(', ')']).to_owned()).collect())
    }
}

/// The names of columns that are asked for, by role.
fn wanted(name: &str, roles: &[Role], asked: &Asked) -> Result<Vec<Option<String>>, MeasuredError> {
    let mut wanted = vec![None; roles.len()];
    for (role, column) in &asked.columns {
        let Some(index) = roles.iter().position(|known| known.name == role) else {
            let names: Vec<&str> = roles.iter().map(|role| role.name).collect();
            let help = format!("a column holds one of: {}", names.join(", "));
            return Err(refused(
                name,
                &format!("columns: {role:?} is nothing that such a table holds"),
                &help,
            ));
        };
        wanted[index] = Some(column.clone());
    }
    Ok(wanted)
}

/// How columns are chosen, as a call says it.
fn choice(roles: &[Role], column: impl Fn(usize) -> String) -> String {
    let pairs: Vec<String> =
        (0..needed(roles)).map(|role| format!("{}={}", roles[role].name, column(role))).collect();
    format!("--columns \"{}\"", pairs.join(","))
}

/// The number of a column, from 1, as a place from 0.
fn place_of_number(word: &str) -> Option<usize> {
    word.parse::<usize>().ok()?.checked_sub(1)
}

/// Finds the head.
///
/// # Errors
/// When no line names the columns that are needed, and no numbers of columns were given.
pub fn find(name: &str, text: &str, roles: &[Role], asked: &Asked) -> Result<Head, MeasuredError> {
    let wanted = wanted(name, roles, asked)?;
    let lines: Vec<&str> = text.lines().take(MOST_ABOVE).collect();
    let found = by_names(&lines, roles, &wanted).or_else(|| by_numbers(&lines, roles, &wanted));
    let Some(mut head) = found else { return Err(not_found(name, &lines, roles, &wanted)) };
    let twice = (1..needed(roles)).find(|role| head.places[..*role].contains(&head.places[*role]));
    if let Some(role) = twice {
        let place = head.places[role];
        let other = head.places.iter().position(|other| *other == place).unwrap_or_default();
        return Err(refused(
            name,
            &format!(
                "{} and {} are one column: {:?}",
                roles[other].name,
                roles[role].name,
                head.name_and_unit(place.unwrap_or_default()).0
            ),
            &format!("say which is which: {}", choice(roles, |role| roles[role].example.to_owned())),
        ));
    }
    // A line of units below the names; behind a remark sign only where they are units.
    for line in lines.iter().skip(head.above) {
        if line.trim().is_empty() {
            head.above += 1;
            continue;
        }
        let mut row = cells(line, head.delimiter);
        // Where white space parts the columns, one without a unit leaves no trace: those that are there are the last.
        if head.delimiter == ' ' {
            while row.len() < head.names.len() {
                row.insert(0, String::new());
            }
        }
        let units = head.units_in(&row);
        let is_remark = is_comment(line);
        if let Some(units) = units
            && (!is_remark || is_of_units(&units))
        {
            head.units = units;
            head.above += 1;
        } else if is_remark {
            head.above += 1;
            continue;
        }
        break;
    }
    Ok(head)
}

/// The first line that names the columns that are needed.
fn by_names(lines: &[&str], roles: &[Role], wanted: &[Option<String>]) -> Option<Head> {
    let needed = needed(roles);
    let is_named = |role: usize| wanted[role].as_deref().is_none_or(|word| place_of_number(word).is_none());
    for (row, line) in lines.iter().enumerate() {
        let delimiter = delimiter(line);
        let names = cells(line, delimiter);
        // A line of nothing but numbers is none of names, whatever numbers of columns stand in it.
        if names.iter().all(|name| name.is_empty() || number(name, delimiter != ',').is_ok()) {
            continue;
        }
        let place = |role: usize| match &wanted[role] {
            Some(column) => names
                .iter()
                .position(|name| name == column || name_and_unit(name).0 == *column)
                .or_else(|| place_of_number(column).filter(|place| *place < names.len())),
            // By the order of the names that are known, the surest first; behind an underscore stands part of a name, or a unit.
            None => roles[role].known.iter().find_map(|known| {
                let whole = names.iter().position(|name| normal(name) == *known);
                whole.or_else(|| names.iter().position(|name| normal(&name_and_unit(name).0) == *known))
            }),
        };
        let places: Vec<Option<usize>> = (0..roles.len()).map(place).collect();
        let given = (0..roles.len()).all(|role| wanted[role].is_none() || places[role].is_some());
        // A line of numbers has any place; a name has to be one.
        let named = (0..needed).any(|role| {
            let by_name = wanted[role].as_ref().is_some_and(|column| {
                names.iter().any(|name| name == column || name_and_unit(name).0 == *column)
            });
            places[role].is_some() && (is_named(role) || by_name)
        });
        // Words of a title are a head only above numbers that stand as they do.
        let below =
            |place: &usize| {
                lines[row + 1..].iter().filter(|line| !line.trim().is_empty()).take(3).any(|line| {
                    cells(line, delimiter).get(*place).is_some_and(|cell| number(cell, true).is_ok())
                })
            };
        let fits = delimiter != ' ' || places[..needed].iter().flatten().all(below);
        if places[..needed].iter().all(Option::is_some) && given && named && fits {
            return Some(Head { above: row + 1, delimiter, places, names, units: Vec::new() });
        }
    }
    None
}

/// Columns by their numbers alone: from the first line that has numbers there; names and units stand above it, where they do.
fn by_numbers(lines: &[&str], roles: &[Role], wanted: &[Option<String>]) -> Option<Head> {
    let places: Vec<Option<Option<usize>>> =
        wanted.iter().map(|column| column.as_deref().map(place_of_number)).collect();
    if places[..needed(roles)].contains(&None) || places.contains(&Some(None)) {
        return None;
    }
    let places: Vec<Option<usize>> = places.into_iter().map(Option::flatten).collect();
    for (row, line) in lines.iter().enumerate().filter(|(_, line)| !is_comment(line)) {
        let fits = |delimiter: &char| {
            let row = cells(line, *delimiter);
            let is_number =
                |place: &usize| row.get(*place).is_some_and(|cell| number(cell, *delimiter != ',').is_ok());
            places.iter().flatten().all(is_number)
        };
        let Some(delimiter) = DELIMITERS.into_iter().find(fits) else { continue };
        let count = cells(line, delimiter).len();
        let mut head =
            Head { above: row, delimiter, places: places.clone(), names: Vec::new(), units: Vec::new() };
        for above in lines[..row].iter().rev().filter(|line| !line.trim().is_empty()).take(2) {
            let words = cells(above, delimiter);
            if words.len() != count || words.iter().any(|word| number(word, true).is_ok()) {
                break;
            }
            if head.units.is_empty() && is_of_units(&words) {
                head.units =
                    words.iter().map(|word| word.trim_matches(['[', ']', '(', ')']).to_owned()).collect();
            } else {
                head.names = words;
                break;
            }
        }
        return Some(head);
    }
    None
}

/// Whether all words are units or nothing.
fn is_of_units(words: &[String]) -> bool {
    let is_unit = |word: &String| {
        let plain = word.trim_matches(['[', ']', '(', ')']);
        plain.is_empty() || is_known(plain)
    };
    words.iter().any(|word| !word.is_empty()) && words.iter().all(is_unit)
}

/// What is said where no line names the columns: the names that there are, from the line that looks most like a head.
fn not_found(name: &str, lines: &[&str], roles: &[Role], wanted: &[Option<String>]) -> MeasuredError {
    let needed = needed(roles);
    let mut best: Vec<String> = Vec::new();
    for line in lines {
        let delimiter = delimiter(line);
        let words = cells(line, delimiter);
        let numbers = words.iter().filter(|cell| number(cell, true).is_ok()).count();
        if words.len() > 1 && 2 * numbers > words.len() {
            break;
        }
        // Words of a sentence are no columns.
        if words.len() > 1
            && numbers == 0
            && words.len() >= best.len()
            && delimiter != ' '
            && !is_of_units(&words)
        {
            best = words;
        }
    }
    let missing: Vec<String> = (0..needed)
        .map(|role| format!("{:?}", wanted[role].as_deref().unwrap_or(roles[role].name)))
        .collect();
    let missing: Vec<&str> = missing.iter().map(String::as_str).collect();
    let numbered = choice(roles, |role| (role + 1).to_string());
    let (there, help) = if best.is_empty() {
        ("there are no names".to_owned(), format!("say which is which, by numbers from 1: {numbered}"))
    } else {
        // Those that are known by their names; which the others are nobody knows.
        let by_name = |role: usize| {
            let names = best.iter().map(|cell| name_and_unit(cell).0);
            let known = |name: &String| roles[role].known.contains(&normal(name).as_str());
            names.into_iter().find(known).unwrap_or_else(|| "...".to_owned())
        };
        let example = choice(roles, by_name);
        (
            format!("it has: {}", best.join(" | ")),
            format!("say which is which, by names or by numbers from 1, such as {example}"),
        )
    };
    refused(name, &format!("no line names the columns {}; {there}", listed(&missing)), &help)
}

/// The name of a column and the unit behind it; a bracket that is not closed belongs to the name.
fn name_and_unit(cell: &str) -> (String, Option<String>) {
    Heading::of(cell).map_or_else(|| (cell.trim().to_owned(), None), |Heading { name, unit }| (name, unit))
}

/// A name in small letters, its words parted by underscores.
fn normal(name: &str) -> String {
    name.to_lowercase().replace([' ', '-'], "_")
}

/// Whether a word is a unit of something that logs hold.
fn is_known(word: &str) -> bool {
    OTHERS.contains(&word) || MASSES.contains(&word) || is_unit(word)
}
