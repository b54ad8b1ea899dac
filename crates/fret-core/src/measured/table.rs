//! A table of measured numbers: columns below a head, whatever stands above it, with the line of every row.

use crate::numbers::{NoNumber, is_comment, letters, number};

use super::asked::Asked;
use super::error::{MeasuredError, refused};
use super::head::{Head, find};
use super::role::Role;

/// Letters of a cell that messages repeat, at the most.
const SHOWN: usize = 40;

/// One column of a table.
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
    /// Its line, from 1.
    pub line: usize,
    /// Its line and what is wrong there.
    pub what: String,
    /// What to do about it.
    pub help: &'static str,
}

/// The columns of a table that are used.
#[derive(Debug, Default)]
pub struct Table {
    /// Its name in messages.
    pub name: String,
    /// By their roles.
    pub columns: Vec<Option<Column>>,
    /// Line of every row in the file, from 1.
    pub lines: Vec<usize>,
    /// Rows without a number where one has to be.
    pub bad: Vec<BadRow>,
    /// Lines of the heads below the first one.
    pub heads: Vec<usize>,
}

impl Table {
    /// The values of a role; none where it is not there.
    pub fn of(&self, role: usize) -> &[f64] {
        self.columns[role].as_ref().map_or(&[], |column| &column.values)
    }
}

/// Reads a table by the roles of its columns; `what` it is, for messages. `strict`: a row without a number where one has to be is refused, not
/// skipped and named.
///
/// # Errors
/// What is wrong with it, with the line.
pub fn read(
    (name, bytes): (&str, &[u8]),
    (roles, what): (&[Role], &str),
    asked: &Asked,
    strict: bool,
) -> Result<Table, MeasuredError> {
    let text = letters(bytes).map_err(|error| {
        refused(name, &error.to_string(), &format!("a {what} is a text file with columns of numbers"))
    })?;
    let head = find(name, &text, roles, asked)?;
    let mut table = Table { name: name.to_owned(), columns: vec![None; roles.len()], ..Table::default() };
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
    let mut rows = Rows { head: &head, table, between: Vec::new(), empty: 0 };
    for row in reader.records() {
        let row = row.map_err(|error| refused(name, &format!("not readable as CSV: {error}"), ""))?;
        let line = head.above + row.position().map_or(0, |place| place.line() as usize);
        if row.iter().any(|cell| !cell.is_empty()) {
            rows.take(&row, line)?;
        } else if row.len() > 1 {
            rows.take_empty(line);
        }
    }
    let Rows { mut table, between, empty, .. } = rows;
    // Cells without anything below the last number are the rest of a spreadsheet.
    let rows_below = between.len() - empty;
    table.bad.extend(between.into_iter().take(rows_below));
    if let (Some(first), true) = (table.bad.first(), strict || table.bad.len() > table.lines.len()) {
        let all = match table.bad.len() {
            1 => String::new(),
            bad => format!("; {bad} of {} rows are like it", bad + table.lines.len()),
        };
        return Err(refused(name, &format!("{}{all}", first.what), first.help));
    }
    Ok(table)
}

/// The rows of a log as they are read.
struct Rows<'a> {
    head: &'a Head,
    table: Table,
    /// Lines without any number, which belong to a head that may follow.
    between: Vec<BadRow>,
    /// How many of the last of them have nothing in any cell.
    empty: usize,
}

impl Rows<'_> {
    fn take(&mut self, row: &csv::StringRecord, line: usize) -> Result<(), MeasuredError> {
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
        self.empty = 0;
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
                "cut the file at its heads, and read its parts one by one",
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

    /// A row of cells without anything: a hole where numbers stand above it and below.
    fn take_empty(&mut self, line: usize) {
        let begins = self.table.heads.last().copied().unwrap_or_default();
        if self.table.lines.last().is_some_and(|last| *last > begins) {
            self.between.push(self.bad_row(&[], line));
            self.empty += 1;
        }
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
                line,
                what: format!("line {line}: nothing stands in column {column:?}"),
                help: "delete the line, or write the value that was measured",
            };
        }
        let mut shown: String = cell.chars().take(SHOWN).collect();
        if shown.len() < cell.len() {
            shown += "...";
        }
        BadRow {
            line,
            what: format!("line {line}, column {column:?}: {shown:?} {why}"),
            help: "numbers look like 1.5e-6, or 1,5 where semicolons or tabs part the columns",
        }
    }
}
