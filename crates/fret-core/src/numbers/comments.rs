//! What stands in a text of numbers and is none: comments.

use std::fmt;

use super::word::{NoNumber, is_of_a_spreadsheet, number};

/// Lines that were passed over as comments.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Skipped {
    /// How many.
    pub count: usize,
    /// The first and the last of them, from 1.
    pub lines: [usize; 2],
}

impl Skipped {
    pub(super) fn add(&mut self, line: usize) {
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

/// Whether a line is a comment by its first letters. A semicolon may also part an empty cell from the next: that is judged apart.
pub fn is_comment(line: &str) -> bool {
    let line = line.trim_start();
    ["%", "!", "//"].iter().any(|mark| line.starts_with(mark))
        || line.starts_with('#')
            && !is_of_a_spreadsheet(line.split([' ', '\t', ',', ';']).next().unwrap_or(line))
}

/// Whether a line that begins with a semicolon is a comment: no cell of it is a number, and one has other words.
pub(super) fn semicolon(line: &str) -> bool {
    let Some(rest) = line.trim_start().strip_prefix(';') else { return false };
    let mut cells = rest.split(';').map(|cell| number(cell.trim(), true));
    cells.clone().all(|cell| cell.is_err()) && cells.any(|cell| cell == Err(NoNumber::Other))
}

/// A line up to a `#` that stands where a word could begin.
pub(super) fn before_comment(line: &str) -> &str {
    let begins_comment = |&(at, _): &(usize, &str)| {
        let before = line[..at].chars().next_back();
        let word = line[at..].split(|letter| is_part(letter, true)).next().unwrap_or_default();
        before.is_none_or(|letter| is_part(letter, true)) && !is_of_a_spreadsheet(word)
    };
    line.match_indices('#').find(begins_comment).map_or(line, |(at, _)| &line[..at])
}

/// Whether a letter parts words.
pub(super) fn is_part(letter: char, commas_part: bool) -> bool {
    letter.is_whitespace() || letter == ';' || commas_part && letter == ','
}
