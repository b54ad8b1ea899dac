//! The cells of a line of words: names of columns, and their units.

/// What may part columns, the surest first; the last stands for any white space.
pub const DELIMITERS: [char; 4] = [';', '\t', ',', ' '];

/// What parts the columns of a line; a comma where nothing does.
pub fn delimiter(line: &str) -> char {
    DELIMITERS.into_iter().find(|mark| line.contains(*mark)).unwrap_or(',')
}

/// The cells of a line; a remark sign before them is skipped.
pub fn cells(line: &str, delimiter: char) -> Vec<String> {
    let line = line.trim_start().trim_start_matches(['#', '%', '!', '/']);
    let plain = |cell: &str| cell.trim().trim_matches('"').trim().to_owned();
    if delimiter == ' ' {
        // A unit in brackets belongs to the word before it.
        line.split_whitespace().map(plain).fold(Vec::new(), |mut words: Vec<String>, word| {
            let opens = |word: &str| word.starts_with(['[', '(']);
            match words.last_mut() {
                Some(last) if opens(&word) && !opens(last) => *last += &format!(" {word}"),
                _ => words.push(word),
            }
            words
        })
    } else {
        line.split(delimiter).map(plain).collect()
    }
}
