//! Rows of numbers from a text: one a line, parted by blanks, tabs, semicolons or commas.

use ndarray::Array2;

use super::commas::{Commas, commas};
use super::comments::{Skipped, before_comment, is_comment, is_part, semicolon};
use super::error::NumbersError;
use super::word::{NoNumber, number};

/// Numbers of a text, at the most: three for every cell of the largest grid.
const MOST: usize = 3 << 26;
/// Letters of a word that messages repeat, at the most.
const SHOWN: usize = 40;

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
    let parting = commas(&rows).map_err(|(line, why)| NumbersError::DecimalComma { line, why })?;
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
