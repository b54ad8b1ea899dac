//! Rows of numbers from a text: one a line, parted by blanks, tabs, semicolons or commas.

use std::fmt;

use ndarray::Array2;

use super::NumbersError;
use super::commas::{Commas, commas};
use super::word::{NoNumber, is_of_a_spreadsheet, number};

/// Numbers of a text, at the most: three for every cell of the largest grid.
const MOST: usize = 3 << 26;
/// Letters of a word that messages repeat, at the most.
const SHOWN: usize = 40;

/// Lines that were passed over as comments.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Skipped {
    /// How many.
    pub count: usize,
    /// The first and the last of them, from 1.
    pub lines: [usize; 2],
}

impl Skipped {
    fn add(&mut self, line: usize) {
        self.lines = [if self.count == 0 { line } else { self.lines[0] }, line];
        self.count += 1;
    }
}

impl fmt::Display for Skipped {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [first, last] = self.lines;
        match self.count {
            0 => Ok(()),
            1 => write!(formatter, " (line {first} was read as a comment)"),
            count if last - first + 1 == count => {
                write!(formatter, " (lines {first} to {last} were read as comments)")
            }
            count => write!(formatter, " ({count} lines from {first} to {last} were read as comments)"),
        }
    }
}

/// Whether a line is a comment by its first letters. A semicolon may also part an empty cell from the next: see [`semicolon`].
pub(in crate::case) fn is_comment(line: &str) -> bool {
    let line = line.trim_start();
    ["%", "!", "//"].iter().any(|mark| line.starts_with(mark))
        || line.starts_with('#')
            && !is_of_a_spreadsheet(line.split([' ', '\t', ',', ';']).next().unwrap_or(line))
}

/// Whether a line that begins with a semicolon is a comment: no cell of it is a number, and one has other words.
fn semicolon(line: &str) -> bool {
    let Some(rest) = line.trim_start().strip_prefix(';') else { return false };
    let mut cells = rest.split(';').map(|cell| number(cell.trim(), true));
    cells.clone().all(|cell| cell.is_err()) && cells.any(|cell| cell == Err(NoNumber::Other))
}

/// A line up to a `#` that stands where a word could begin.
fn before_comment(line: &str) -> &str {
    let begins_comment = |&(at, _): &(usize, &str)| {
        let before = line[..at].chars().next_back();
        let word = line[at..].split(|letter| is_part(letter, true)).next().unwrap_or_default();
        before.is_none_or(|letter| is_part(letter, true)) && !is_of_a_spreadsheet(word)
    };
    line.match_indices('#').find(begins_comment).map_or(line, |(at, _)| &line[..at])
}

fn is_part(letter: char, commas_part: bool) -> bool {
    letter.is_whitespace() || letter == ';' || commas_part && letter == ','
}

/// Array `[row, column]` of a text of lines; what stands behind a `#` is a comment, and so is a line that begins with `#`, `%`,
/// `!`, `;` or `//`.
pub(super) fn rows(text: &str) -> Result<Array2<f64>, NumbersError> {
    let is_skipped = |line: &str| is_comment(line) || semicolon(line);
    let lines = || text.lines().zip(1..);
    let mut skipped = Skipped::default();
    lines().filter(|(line, _)| is_skipped(line)).for_each(|(_, number)| skipped.add(number));
    let rows = lines()
        .filter(|(line, _)| !line.trim().is_empty() && !is_skipped(line))
        .map(|(line, number)| (number, if line.contains('#') { before_comment(line) } else { line }));
    let parting = commas(rows.clone()).map_err(|(line, why)| NumbersError::DecimalComma { line, why })?;
    let mut reader = Reader { decimal_comma: parting == Commas::Decimal, values: Vec::new(), skipped };
    let mut columns = 0;
    for (line, row) in rows {
        let found = reader.row(line, row)?;
        if columns > 0 && found != columns {
            return Err(reader.ragged(line, row, [found, columns]));
        }
        columns = found;
        if reader.values.len() > MOST {
            return Err(NumbersError::Many { most: MOST });
        }
    }
    if columns == 0 {
        return Err(NumbersError::Empty(skipped));
    }
    Array2::from_shape_vec((reader.values.len() / columns, columns), reader.values)
        .map_err(|_| NumbersError::Empty(skipped))
}

struct Reader {
    decimal_comma: bool,
    values: Vec<f64>,
    skipped: Skipped,
}

impl Reader {
    /// Reads the numbers of a line; how many there are.
    fn row(&mut self, line: usize, text: &str) -> Result<usize, NumbersError> {
        let mut column = 0;
        // between two marks, and before the first, something must stand; a mark at the end of a line parts nothing
        let mut is_empty = true;
        let mut rest = text.trim_start();
        while let Some(first) = rest.chars().next() {
            if matches!(first, ';' | ',') && is_part(first, !self.decimal_comma) {
                if is_empty {
                    return Err(self.no_number(line, column + 1, "", NoNumber::Hole));
                }
                is_empty = true;
                rest = rest[1..].trim_start();
                continue;
            }
            let end = rest.find(|letter| is_part(letter, !self.decimal_comma)).unwrap_or(rest.len());
            let word = &rest[..end];
            column += 1;
            let value =
                number(word, self.decimal_comma).map_err(|why| self.no_number(line, column, word, why))?;
            self.values.push(value);
            is_empty = false;
            rest = rest[end..].trim_start();
        }
        Ok(column)
    }

    /// Why a row is shorter or longer than those before.
    fn ragged(&self, line: usize, text: &str, [found, expected]: [usize; 2]) -> NumbersError {
        let is_mark = |letter: char| matches!(letter, '\t' | ';') || letter == ',' && !self.decimal_comma;
        let empty = text.trim_matches(' ').split(is_mark).position(|cell| cell.trim().is_empty());
        match empty {
            Some(place) if found < expected => self.no_number(line, place + 1, "", NoNumber::Hole),
            _ => NumbersError::Ragged { line, found, expected, skipped: self.skipped },
        }
    }

    fn no_number(&self, line: usize, column: usize, word: &str, why: NoNumber) -> NumbersError {
        let mut shown: String = word.chars().take(SHOWN).collect();
        if shown.len() < word.len() {
            shown.push_str("...");
        }
        NumbersError::Word { line, column, word: shown, why, skipped: self.skipped }
    }
}
