//! A measured log as it comes from a rig: columns of numbers below a head, whatever stands above it, with the line of every row.

use super::{Request, refused};
use crate::failure::Failure;

/// What a column can hold.
pub const ROLES: [&str; 4] = ["displacement", "force", "cycle", "normal_force"];
/// Names by which columns are known when none are given.
const KNOWN: [&[&str]; 4] = [
    &["displacement", "actuator", "actuator_x", "delta", "stroke", "position", "weg"],
    &["force", "tangential_force", "tangential_force_x", "friction_force", "q", "ft", "kraft"],
    &["cycle", "cycles", "cycle_number", "zyklus"],
    &["normal_force", "p", "fn", "normal_load", "normalkraft"],
];
/// Lines above the head, at the most.
const MOST_ABOVE: usize = 200;
/// Rows of numbers, at the least.
pub const FEWEST_ROWS: usize = 12;

/// One column of a log.
#[derive(Debug, Clone, Default)]
pub struct Column {
    /// As it is called there.
    pub name: String,
    /// The unit in brackets, behind a slash, or in the line below the head.
    pub unit: Option<String>,
    /// One value a row.
    pub values: Vec<f64>,
}

/// The columns of a log that are used.
#[derive(Debug, Default)]
pub struct Table {
    /// Its name in messages.
    pub name: String,
    /// By [`ROLES`].
    pub columns: [Option<Column>; 4],
    /// Line of every row in the file, from 1.
    pub lines: Vec<usize>,
}

impl Table {
    /// The column of a role that must be there.
    pub fn of(&self, role: usize) -> &[f64] {
        self.columns[role].as_ref().map_or(&[], |column| &column.values)
    }
}

/// Reads a log.
///
/// # Errors
/// What is wrong with it, with the line.
pub fn read(name: &str, bytes: &[u8], request: &Request) -> Result<Table, Failure> {
    let text = String::from_utf8(bytes.to_vec())
        // What old programs write: every byte is a letter of Latin-1.
        .unwrap_or_else(|_| bytes.iter().map(|&byte| char::from(byte)).collect());
    let text = text.trim_start_matches('\u{feff}');
    let wanted = wanted(name, request)?;
    let (above, delimiter, places, names) = head(name, text, &wanted)?;
    let decimal_comma = delimiter != b',';
    let mut table = Table { name: name.to_owned(), ..Table::default() };
    for (role, place) in places.iter().enumerate() {
        if let Some(place) = place {
            let (name, unit) = name_and_unit(&names[*place]);
            table.columns[role] = Some(Column { name, unit, values: Vec::new() });
        }
    }
    let below: String = text.split_inclusive('\n').skip(above + 1).collect();
    let mut reader = csv::ReaderBuilder::new()
        .delimiter(delimiter)
        .has_headers(false)
        .flexible(true)
        .comment(Some(b'#'))
        .trim(csv::Trim::All)
        .from_reader(below.as_bytes());
    let mut first = true;
    for row in reader.records() {
        let row = row.map_err(|error| refused(name, &format!("not readable as CSV: {error}"), ""))?;
        let line = above + 1 + row.position().map_or(0, |place| place.line() as usize);
        if row.iter().all(str::is_empty) {
            continue;
        }
        let cells: Vec<(usize, &str)> = places
            .iter()
            .enumerate()
            .filter_map(|(role, place)| Some((role, row.get((*place)?).unwrap_or(""))))
            .collect();
        let is_units = first && cells.iter().all(|(_, cell)| number(cell, decimal_comma).is_none());
        first = false;
        if is_units {
            for (role, cell) in cells {
                if let (Some(column), false) = (&mut table.columns[role], cell.is_empty()) {
                    column.unit = Some(cell.trim_matches(['[', ']', '(', ')']).to_owned());
                }
            }
            continue;
        }
        for (role, cell) in cells {
            let Some(column) = &mut table.columns[role] else { continue };
            match number(cell, decimal_comma) {
                Some(value) => column.values.push(value),
                None if cell.is_empty() => {
                    return Err(refused(
                        name,
                        &format!("line {line}: nothing stands in column {:?}", column.name),
                        "delete the line, or write the value that was measured",
                    ));
                }
                None => {
                    return Err(refused(
                        name,
                        &format!("line {line}, column {:?}: {cell:?} is not a number", column.name),
                        "numbers look like 1.5e-6, or 1,5 where semicolons or tabs part the columns",
                    ));
                }
            }
        }
        table.lines.push(line);
    }
    enough(&table)?;
    Ok(table)
}

/// Whether there are rows for a loop, and something changes in them.
fn enough(table: &Table) -> Result<(), Failure> {
    let rows = table.lines.len();
    if rows < FEWEST_ROWS {
        return Err(refused(
            &table.name,
            &format!(
                "{rows} row{} of numbers: a loop needs at least {FEWEST_ROWS} points",
                if rows == 1 { "" } else { "s" }
            ),
            "a hundred points a cycle serve well",
        ));
    }
    for column in table.columns.iter().take(2).flatten() {
        if column.values.iter().all(|value| *value == column.values[0]) {
            return Err(refused(
                &table.name,
                &format!(
                    "column {:?} is {:?} in all lines from {} to {}: nothing was measured there",
                    column.name,
                    column.values[0],
                    table.lines[0],
                    table.lines[rows - 1]
                ),
                "choose another column with --columns, or look at the sensor",
            ));
        }
    }
    Ok(())
}

/// The names of columns that the request gives, by role.
fn wanted(name: &str, request: &Request) -> Result<[Option<String>; 4], Failure> {
    let mut wanted = [const { None }; 4];
    for (role, column) in &request.columns {
        let Some(index) = ROLES.iter().position(|known| known == role) else {
            let help = format!("a column holds one of: {}", ROLES.join(", "));
            return Err(refused(name, &format!("columns: {role:?} is nothing that a log holds"), &help));
        };
        wanted[index] = Some(column.clone());
    }
    Ok(wanted)
}

/// Lines above the head, the delimiter, the place of every role, and the names in the head.
type Head = (usize, u8, [Option<usize>; 4], Vec<String>);

/// Finds the head: the first line that has a displacement and a force.
fn head(name: &str, text: &str, wanted: &[Option<String>; 4]) -> Result<Head, Failure> {
    let mut best: Vec<String> = Vec::new();
    for (above, line) in text.lines().enumerate().take(MOST_ABOVE) {
        let delimiter = [';', '\t', ','].into_iter().find(|mark| line.contains(*mark)).unwrap_or(',');
        let names: Vec<String> = line
            .trim_start_matches('#')
            .split(delimiter)
            .map(|cell| cell.trim().trim_matches('"').to_owned())
            .collect();
        let place = |role: usize| match &wanted[role] {
            Some(column) => names.iter().position(|name| name == column || name_and_unit(name).0 == *column),
            None => names.iter().position(|name| {
                let plain = name_and_unit(name).0.to_lowercase().replace([' ', '-'], "_");
                KNOWN[role].contains(&plain.as_str())
            }),
        };
        let places = [0, 1, 2, 3].map(place);
        let given = (0..4).all(|role| wanted[role].is_none() || places[role].is_some());
        if places[0].is_some() && places[1].is_some() && given {
            return Ok((above, delimiter as u8, places, names));
        }
        let is_words = names.len() > 1 && names.iter().all(|cell| number(cell, true).is_none());
        if is_words && names.len() >= best.len() {
            best = names;
        }
    }
    let missing: Vec<&str> = (0..2).map(|role| wanted[role].as_deref().unwrap_or(ROLES[role])).collect();
    let there = if best.is_empty() {
        "there are no names".to_owned()
    } else {
        format!("it has: {}", best.join(" | "))
    };
    Err(refused(
        name,
        &format!("no line names the columns {:?} and {:?}; {there}", missing[0], missing[1]),
        "say which is which: --columns \"displacement=stroke,force=load\"",
    ))
}

/// `Weg [um]`, `Q (N)` and `Q / N` are a name and a unit.
fn name_and_unit(cell: &str) -> (String, Option<String>) {
    for (open, close) in [('[', ']'), ('(', ')')] {
        if let (Some(from), true) = (cell.rfind(open), cell.ends_with(close)) {
            let unit = cell[from + 1..cell.len() - 1].trim();
            return (cell[..from].trim().to_owned(), Some(unit.to_owned()));
        }
    }
    match cell.split_once(" / ") {
        Some((name, unit)) => (name.trim().to_owned(), Some(unit.trim().to_owned())),
        None => (cell.trim().to_owned(), None),
    }
}

/// A finite number, with a decimal comma where commas part nothing.
fn number(cell: &str, decimal_comma: bool) -> Option<f64> {
    let plain = if decimal_comma && !cell.contains('.') { cell.replace(',', ".") } else { cell.to_owned() };
    plain.parse().ok().filter(|value: &f64| value.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows(head: &str, row: impl Fn(usize) -> String) -> String {
        (0..20).fold(head.to_owned(), |text, k| text + &row(k) + "\n")
    }

    fn message(text: &str) -> String {
        match read("log.csv", text.as_bytes(), &Request::default()) {
            Ok(_) => String::new(),
            Err(failure) => failure.message(),
        }
    }

    #[test]
    fn exports_of_rigs_are_read() {
        let plain = rows("displacement,force\n", |k| format!("{k}e-6,{k}"));
        let german =
            rows("Versuch 12\nDatum;3.4.2025\n\nZyklus;Weg;Kraft\n;µm;N\n", |k| format!("7;{k},5;{k},25"));
        let bracketed = rows("# rig\nt [s]\tdisplacement [um]\tforce [N]\n", |k| format!("0,1\t{k},5\t{k}"));
        for (text, first, unit) in
            [(plain, 1e-6, None), (german, 1.5, Some("µm")), (bracketed, 1.5, Some("um"))]
        {
            let table = read("log.csv", text.as_bytes(), &Request::default()).unwrap();
            let column = table.columns[0].as_ref().unwrap();
            assert_eq!((column.values[1], column.unit.as_deref()), (first, unit));
            assert_eq!(column.values.len(), 20);
        }
    }

    #[test]
    fn bad_logs_are_told_where() {
        let with = |bad: &'static str| {
            rows("displacement,force\n", move |k| if k == 7 { bad.to_owned() } else { format!("{k}e-6,{k}") })
        };
        for (text, words) in [
            (with("1e-6,abc"), "line 9, column \"force\": \"abc\" is not a number"),
            (with("1e-6,"), "line 9: nothing stands in column \"force\""),
            (with("1e-6"), "line 9: nothing stands in column \"force\""),
            (rows("time,force\n", |k| format!("{k},{k}")), "no line names the columns"),
            (
                rows("displacement,force\n", |k| format!("{k},3.5")),
                "column \"force\" is 3.5 in all lines from 2 to 21",
            ),
            ("displacement,force\n1,2\n".to_owned(), "1 row of numbers"),
            (String::new(), "there are no names"),
        ] {
            assert!(message(&text).contains(words), "{}: expected {words}", message(&text));
        }
    }
}
