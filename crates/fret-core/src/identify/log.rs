//! A measured log as it comes from a rig: columns of numbers below a head, whatever stands above it, with the line of every row.

use crate::case::{NoNumber, is_comment, letters, number};

use super::error::{IdentifyError, refused};
use super::head::{Head, find};
use super::request::Request;

/// Rows of numbers, at the least.
pub const FEWEST_ROWS: usize = 12;
/// Letters of a cell that messages repeat, at the most.
const SHOWN: usize = 40;

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

/// A row that is skipped.
#[derive(Debug, Clone)]
pub struct BadRow {
    /// Its line and what is wrong there.
    pub what: String,
    /// What to do about it.
    pub help: &'static str,
}

/// The columns of a log that are used.
#[derive(Debug, Default)]
pub struct Table {
    /// Its name in messages.
    pub name: String,
    /// By what they hold: displacement, force, cycle, normal force.
    pub columns: [Option<Column>; 4],
    /// Line of every row in the file, from 1.
    pub lines: Vec<usize>,
    /// Rows without a number where one has to be.
    pub bad: Vec<BadRow>,
    /// Lines of the heads below the first one.
    pub heads: Vec<usize>,
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
pub fn read(name: &str, bytes: &[u8], request: &Request) -> Result<Table, IdentifyError> {
    let text = letters(bytes)
        .map_err(|error| refused(name, &error.to_string(), "a log is a text file with columns of numbers"))?;
    let head = find(name, &text, request)?;
    let mut table = Table { name: name.to_owned(), ..Table::default() };
    for (role, place) in head.places.iter().enumerate() {
        if let Some(place) = place {
            let (name, unit) = head.name_and_unit(*place);
            table.columns[role] = Some(Column { name, unit, values: Vec::new() });
        }
    }
    // Comments become empty lines, so that the others keep their numbers.
    let below = text.split_inclusive('\n').skip(head.above);
    let below = below.map(|line| if is_comment(line) { "\n" } else { line });
    let (below, delimiter): (String, u8) = if head.delimiter == ' ' {
        (below.map(|line| line.split_whitespace().collect::<Vec<_>>().join("\t") + "\n").collect(), b'\t')
    } else {
        (below.collect(), head.delimiter as u8)
    };
    let mut reader = csv::ReaderBuilder::new()
        .delimiter(delimiter)
        .has_headers(false)
        .flexible(true)
        .trim(csv::Trim::All)
        .from_reader(below.as_bytes());
    let mut rows = Rows { head: &head, table, between: Vec::new() };
    for row in reader.records() {
        let row = row.map_err(|error| refused(name, &format!("not readable as CSV: {error}"), ""))?;
        let line = head.above + row.position().map_or(0, |place| place.line() as usize);
        if !row.iter().all(str::is_empty) {
            rows.take(&row, line)?;
        }
    }
    let Rows { mut table, between, .. } = rows;
    table.bad.extend(between);
    if let (Some(first), true) = (table.bad.first(), request.strict || table.bad.len() > table.lines.len()) {
        let all = match table.bad.len() {
            1 => String::new(),
            bad => format!("; {bad} of {} rows are like it", bad + table.lines.len()),
        };
        return Err(refused(name, &format!("{}{all}", first.what), first.help));
    }
    enough(&table)?;
    Ok(table)
}

/// The rows of a log as they are read.
struct Rows<'a> {
    head: &'a Head,
    table: Table,
    /// Lines without any number, which belong to a head that may follow.
    between: Vec<BadRow>,
}

impl Rows<'_> {
    fn take(&mut self, row: &csv::StringRecord, line: usize) -> Result<(), IdentifyError> {
        let decimal_comma = self.head.delimiter != ',';
        let cells: Vec<(usize, &str)> = self
            .head
            .places
            .iter()
            .enumerate()
            .filter_map(|(role, place)| Some((role, row.get((*place)?).unwrap_or(""))))
            .collect();
        let values: Option<Vec<f64>> =
            cells.iter().map(|(_, cell)| number(cell, decimal_comma).ok()).collect();
        if let Some(values) = values {
            self.table.bad.append(&mut self.between);
            for ((role, _), value) in cells.iter().zip(values) {
                if let Some(column) = &mut self.table.columns[*role] {
                    column.values.push(value);
                }
            }
            self.table.lines.push(line);
            return Ok(());
        }
        let words: Vec<String> = row.iter().map(str::to_owned).collect();
        if self.head.is_repeated_by(&words) {
            // The next block of an export, with the lines above its head.
            self.between.clear();
            self.table.heads.push(line);
            return Ok(());
        }
        if self.table.heads.last().is_some_and(|head| line <= head + 2)
            && let Some(units) = self.head.units_in(&words)
        {
            let of = |units: &[String]| -> Vec<String> {
                self.head
                    .places
                    .iter()
                    .flatten()
                    .map(|&place| units.get(place).cloned().unwrap_or_default())
                    .collect()
            };
            if of(&units) == of(&self.head.units) {
                return Ok(());
            }
            return Err(refused(
                &self.table.name,
                &format!("line {line}: the units below this head are others than below the first"),
                "cut the file at its heads, and identify its parts one by one",
            ));
        }
        let bad = self.bad_row(&cells, line);
        if row.iter().any(|cell| number(cell, decimal_comma).is_ok()) {
            self.table.bad.append(&mut self.between);
            self.table.bad.push(bad);
        } else {
            self.between.push(bad);
        }
        Ok(())
    }

    /// What is wrong with a row.
    fn bad_row(&self, cells: &[(usize, &str)], line: usize) -> BadRow {
        let decimal_comma = self.head.delimiter != ',';
        let wrong =
            cells.iter().find_map(|&(role, cell)| Some((role, cell, number(cell, decimal_comma).err()?)));
        let (role, cell, why) = wrong.unwrap_or((0, "", NoNumber::Hole));
        let column = self.table.columns[role].as_ref().map_or("", |column| &column.name);
        if cell.is_empty() {
            return BadRow {
                what: format!("line {line}: nothing stands in column {column:?}"),
                help: "delete the line, or write the value that was measured",
            };
        }
        let mut shown: String = cell.chars().take(SHOWN).collect();
        if shown.len() < cell.len() {
            shown += "...";
        }
        BadRow {
            what: format!("line {line}, column {column:?}: {shown:?} {why}"),
            help: "numbers look like 1.5e-6, or 1,5 where semicolons or tabs part the columns",
        }
    }
}

/// Whether there are rows for a loop, and something changes in them.
fn enough(table: &Table) -> Result<(), IdentifyError> {
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

#[cfg(test)]
mod tests {
    use super::*;

    fn rows(head: &str, row: impl Fn(usize) -> String) -> String {
        (0..20).fold(head.to_owned(), |text, k| text + &row(k) + "\n")
    }

    fn message(text: &str) -> String {
        match read("log.csv", text.as_bytes(), &Request { strict: true, ..Request::default() }) {
            Ok(_) => String::new(),
            Err(failure) => failure.to_string(),
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
