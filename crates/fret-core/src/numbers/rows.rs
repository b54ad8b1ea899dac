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
///
/// Lines of words above the first row, whose first word is no number, are its head. With `takes_holes` words and empty cells that
/// stand for what was not measured become NaN.
pub(super) fn rows(text: &str, takes_holes: bool) -> Result<Array2<f64>, NumbersError> {
    let lines = || text.lines().zip(1..);
    let is_words =
        |line: &str| is_comment(line) || semicolon(line) || line.trim().is_empty() || is_head(line);
    let head = lines().take_while(|(line, _)| is_words(line)).count();
    // a text of words alone is no head of numbers
    let head = if lines().nth(head).is_some() { head } else { 0 };
    let is_skipped = |line: &str, number: usize| {
        is_comment(line) || semicolon(line) || number <= head && !line.trim().is_empty()
    };
    let mut skipped = Skipped::default();
    lines().filter(|(line, number)| is_skipped(line, *number)).for_each(|(_, number)| skipped.add(number));
    let rows = lines()
        .filter(|(line, number)| !line.trim().is_empty() && !is_skipped(line, *number))
        .map(|(line, number)| (number, if line.contains('#') { before_comment(line) } else { line }));
    let parting = commas(&rows).map_err(|(line, why)| NumbersError::DecimalComma { line, why })?;
    let decimal_comma = parting == Commas::Decimal;
    let mut reader = Reader { decimal_comma, takes_holes, values: Vec::new(), skipped };
    let mut columns = 0;
    for (line, row) in rows {
        let mut found = reader.row(line, row)?;
        if takes_holes && columns > 0 && found != columns {
            found = reader.row_with_empty_cells(line, row, [found, columns])?;
        }
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

/// Whether a line begins with a word that is no number and stands for none: a line above the numbers.
fn is_head(line: &str) -> bool {
    let word = line.trim_start().split(|letter| is_part(letter, true)).next().unwrap_or_default();
    number(word, false) == Err(NoNumber::Other)
}

struct Reader {
    decimal_comma: bool,
    takes_holes: bool,
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
                if is_empty && !self.takes_holes {
                    return Err(self.no_number(line, column + 1, "", NoNumber::Hole));
                }
                if is_empty {
                    self.values.push(f64::NAN);
                    column += 1;
                }
                is_empty = true;
                rest = rest[1..].trim_start();
                continue;
            }
            let end = no_data(rest)
                .or_else(|| rest.find(|letter| is_part(letter, !self.decimal_comma)))
                .unwrap_or(rest.len());
            column += 1;
            let value = self.value(line, column, &rest[..end])?;
            self.values.push(value);
            is_empty = false;
            rest = rest[end..].trim_start();
        }
        Ok(column)
    }

    /// The number of a word; NaN for a hole, where holes are taken.
    fn value(&self, line: usize, column: usize, word: &str) -> Result<f64, NumbersError> {
        match number(word, self.decimal_comma) {
            Ok(value) => Ok(value),
            Err(NoNumber::Hole) if self.takes_holes => Ok(f64::NAN),
            Err(why) => Err(self.no_number(line, column, word, why)),
        }
    }

    /// Reads a row again that has more or fewer words than those before: tabs and marks part its cells, and empty ones are holes.
    fn row_with_empty_cells(
        &mut self,
        line: usize,
        text: &str,
        [found, expected]: [usize; 2],
    ) -> Result<usize, NumbersError> {
        let is_mark = |letter: char| matches!(letter, '\t' | ';') || letter == ',' && !self.decimal_comma;
        let cells: Vec<&str> = text.trim_matches(' ').split(is_mark).map(str::trim).collect();
        if cells.len() != expected {
            return Ok(found);
        }
        self.values.truncate(self.values.len() - found);
        for (place, cell) in cells.into_iter().enumerate() {
            let value = self.value(line, place + 1, cell)?;
            self.values.push(value);
        }
        Ok(expected)
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

/// Where the words `No Data` end, which begin here: one cell of two words.
fn no_data(text: &str) -> Option<usize> {
    const WORDS: &str = "no data";
    let begins = text.get(..WORDS.len()).is_some_and(|start| start.eq_ignore_ascii_case(WORDS));
    begins.then_some(WORDS.len())
}
