//! Where a table of loads begins, and what parts its cells.

use crate::numbers::{is_comment, number};

/// Where a table begins.
pub(super) struct Layout {
    /// What parts its cells.
    pub delimiter: u8,
    /// Line of the head, from 1.
    pub line: usize,
    /// The table from its head on, its comments as empty lines.
    pub text: String,
}

/// Finds the head of a table: its first line that is no comment, or where that is a line of numbers, the comment above it.
pub(super) fn layout(text: &str) -> Layout {
    let delimiter_of = |line: &str| [';', '\t'].into_iter().find(|&mark| line.contains(mark)).unwrap_or(',');
    let words = |line: &str| {
        line.split(delimiter_of(line)).map(|cell| cell.trim().to_owned()).collect::<Vec<String>>()
    };
    let is_of_numbers = |line: &str| words(line).iter().all(|cell| number(cell, true).is_ok());
    let plain = |line: &str| !line.trim().is_empty() && !is_comment(line);
    // a semicolon that begins a line makes it a comment where semicolons part nothing
    let parts = |line: &str| line.trim_start_matches(';').contains(';');
    let semicolons_part = text.lines().find(|line| plain(line) && !line.starts_with(';')).is_some_and(parts);
    let is_row = |line: &str| plain(line) && (semicolons_part || !line.starts_with(';'));
    let lines: Vec<&str> = text.lines().collect();
    let first = lines.iter().position(|line| is_row(line)).unwrap_or(lines.len());
    let above = lines[..first].iter().rposition(|line| !line.trim().is_empty());
    let commented = above.filter(|&above| {
        let [head, row] = [above, first].map(|at| lines.get(at).map_or(0, |line| words(line).len()));
        lines.get(first).is_some_and(|line| is_of_numbers(line)) && head == row
    });
    let head = commented.unwrap_or(first);
    let mut table = "\n".repeat(head);
    for (at, line) in lines.iter().enumerate().skip(head) {
        if at == head {
            table.push_str(line.trim_start().trim_start_matches(['#', '%', '!', '/']));
        } else if is_row(line) {
            table.push_str(line);
        }
        table.push('\n');
    }
    Layout { delimiter: delimiter_of(lines.get(head).unwrap_or(&"")) as u8, line: head + 1, text: table }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_head_is_found_below_comments_or_in_the_last_of_them() {
        for (text, delimiter, line, table) in [
            ("a,b\n1,2", b',', 1, "a,b\n1,2\n"),
            ("# rig\n\na;b\n% c\n1;2\n", b';', 3, "\n\na;b\n\n1;2\n"),
            ("# rig\n# a\tb\n1\t2\n", b'\t', 2, "\n a\tb\n1\t2\n"),
            ("; rig\na\n;c\n1\n", b',', 2, "\na\n\n1\n"),
            ("a;b\n;2\n", b';', 1, "a;b\n;2\n"),
            ("# rig 3\n1,2\n", b',', 2, "\n1,2\n"),
            ("", b',', 1, ""),
        ] {
            let found = layout(text);
            assert_eq!(
                (found.delimiter, found.line, found.text.as_str()),
                (delimiter, line, table),
                "{text:?}"
            );
        }
    }
}
