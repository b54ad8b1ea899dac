//! Whether the commas of a text of numbers part them, or are decimal commas.

/// What the commas of a text are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Commas {
    /// They part numbers.
    Part,
    /// They are decimal commas.
    Decimal,
}

/// What the commas are, from the rows of numbers with their lines; or the line that leaves it in doubt, and why.
///
/// A comma with a blank beside it parts. Between two digits it is a decimal comma where semicolons or tabs part the numbers, and
/// parts them where nothing else does; beside blanks alone it could be either. Decimal commas and decimal points in one text, and
/// numbers as only halves of decimals look (`-0`, `00123`), leave a doubt too.
pub(super) fn commas<'a>(
    rows: &(impl Iterator<Item = (usize, &'a str)> + Clone),
) -> Result<Commas, (usize, &'static str)> {
    let Some((line, _)) = rows.clone().find(|(_, row)| has_glued(row)) else { return Ok(Commas::Part) };
    let is_blank = |letter: char| letter.is_whitespace() || letter == ';';
    let words = rows.clone().flat_map(|(line, row)| row.split(is_blank).map(move |word| (line, word)));
    let glued = words.clone().filter(|(_, word)| has_glued(word));
    if rows.clone().any(|(_, row)| row.trim_matches(is_blank).contains([';', '\t'])) {
        return if glued.clone().all(|(_, word)| are_floats(word)) {
            Ok(Commas::Part)
        } else if let Some((line, _)) = glued.clone().find(|(_, word)| !is_decimal(word)) {
            Err((line, "commas part more than two groups of digits here, or stand beside points"))
        } else if let Some((line, _)) = words.clone().find(|(_, word)| word.contains('.')) {
            Err((line, "other lines have decimal commas, and a decimal point stands here"))
        } else {
            Ok(Commas::Decimal)
        };
    }
    if rows.clone().any(|(_, row)| row.trim().contains(char::is_whitespace)) {
        let in_doubt = glued.clone().all(|(_, word)| is_decimal(word))
            || glued.clone().all(|(_, word)| are_thousands(word));
        return if in_doubt {
            Err((line, "commas stand between digits, and blanks between numbers"))
        } else {
            Ok(Commas::Part)
        };
    }
    // nothing but commas: they part, unless only halves of decimals look so
    let is_pairs = glued.clone().all(|(_, word)| {
        let pieces = word.split(',');
        pieces.clone().count() % 2 == 0
            && pieces.skip(1).step_by(2).all(is_digits)
            && !word.contains(['.', 'e', 'E'])
    });
    let half = |word: &str| {
        let pieces = word.split(',');
        pieces.clone().step_by(2).any(|whole| whole == "-0")
            || pieces.skip(1).step_by(2).any(|digits| digits.len() > 1 && digits.starts_with('0'))
    };
    match glued.clone().find(|(_, word)| half(word)) {
        Some((line, _)) if is_pairs => Err((line, "the numbers look like halves of others")),
        _ => Ok(Commas::Part),
    }
}

/// Whether a comma stands between two digits.
fn has_glued(text: &str) -> bool {
    let bytes = text.as_bytes();
    let between = |at: usize| {
        at > 0 && bytes[at - 1].is_ascii_digit() && bytes.get(at + 1).is_some_and(u8::is_ascii_digit)
    };
    text.contains(',') && (0..bytes.len()).any(|at| bytes[at] == b',' && between(at))
}

fn is_digits(piece: &str) -> bool {
    !piece.is_empty() && piece.bytes().all(|byte| byte.is_ascii_digit())
}

/// Whether all pieces are written with a point or an exponent.
fn are_floats(word: &str) -> bool {
    word.trim_end_matches(',').split(',').all(|piece| piece.contains(['.', 'e', 'E']))
}

/// Whether the comma can be a decimal comma: digits before it, digits and perhaps an exponent behind it.
fn is_decimal(word: &str) -> bool {
    let mut pieces = word.trim_end_matches(',').split(',');
    let (Some(whole), Some(rest), None) = (pieces.next(), pieces.next(), pieces.next()) else { return false };
    let (digits, exponent) = rest.split_once(['e', 'E']).unwrap_or((rest, "0"));
    is_digits(whole.trim_start_matches(['+', '-']))
        && is_digits(digits)
        && is_digits(exponent.trim_start_matches(['+', '-']))
}

/// Whether the commas can stand between thousands: groups of three digits behind the first.
fn are_thousands(word: &str) -> bool {
    let whole = word.trim_start_matches(['+', '-']);
    let whole = whole.split_once('.').map_or(whole, |(whole, _)| whole);
    let mut groups = whole.split(',');
    groups.next().is_some_and(|first| is_digits(first) && first.len() <= 3)
        && groups.all(|group| is_digits(group) && group.len() == 3)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn commas_part_or_are_decimal_or_leave_a_doubt() {
        let found = |text: &str| {
            commas(&text.lines().zip(1..).map(|(row, line)| (line, row))).map_err(|(line, _)| line)
        };
        for text in [
            "1 2\n3 4",
            "1.5,2.5\n3.5,4.5",
            "1,2,3\n4,5,6",
            "0, 1, 2",
            "1e-8,2e-8",
            "1.5,2.5;3.5,4.5",
            "1,2,3 4,5,6",
            "10,20\n30,40",
            "1, 2,\n3, 4,",
            "0.5,0\n0.25,0",
            "0,0,0,0",
        ] {
            assert_eq!(found(text), Ok(Commas::Part), "{text:?}");
        }
        for text in ["0,5;0,25", "-0,009474\t1,5e-3", "1;2,5\n3;4", "0,5;-2\n; 0,25;1"] {
            assert_eq!(found(text), Ok(Commas::Decimal), "{text:?}");
        }
        for (text, line) in [
            ("0,5 0,25", 1),         // pairs x,y, or decimals
            ("1;2\n0,5;0.25", 2),    // a comma and a point
            ("1,234.5\t6,789.0", 1), // thousands
            ("1,234.5 6,789.0", 1),
            ("1,2,3;4,5", 1),
            ("0,009474,0,008031", 1), // 009474 is no number of its own
            ("1,5,2,5\n-0,5,3,5", 2),
        ] {
            assert_eq!(found(text), Err(line), "{text:?}");
        }
    }
}
