//! One number from the word that stands for it, and the words that stand for none.

/// Why a word is no number.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum NoNumber {
    /// A word for a cell without a measurement.
    #[error("stands for a value that was not measured")]
    Hole,
    /// A number that is infinite or too large for one.
    #[error("is no finite number")]
    NotFinite,
    /// A decimal comma and a decimal point in one word.
    #[error("has a comma and a point: decimal commas, or commas between thousands?")]
    CommaAndPoint,
    /// Anything else.
    #[error("is not a number")]
    Other,
}

/// Words for a cell without a measurement, in small letters; those of spreadsheets begin with a `#`.
const HOLES: [&str; 32] = [
    "", "nan", "na", "n/a", "<na>", "nd", "no", "no data", "nodata", "no_data", "null", "none", "nil",
    "void", "bad", "invalid", "masked", "missing", "-", "--", "---", "#n/a", "#na", "#nv", "#num!",
    "#div/0!", "#value!", "#ref!", "#name?", "#null!", "#wert!", "#zahl!",
];

/// The finite number of a word, whose decimal point may be a comma where commas part nothing.
///
/// # Errors
/// What the word is instead.
pub fn number(word: &str, decimal_comma: bool) -> Result<f64, NoNumber> {
    let parsed = if decimal_comma && word.contains(',') {
        if word.contains('.') {
            return Err(NoNumber::CommaAndPoint);
        }
        word.replacen(',', ".", 1).parse::<f64>()
    } else {
        word.parse::<f64>()
    };
    match parsed {
        Ok(value) if value.is_finite() => Ok(value),
        Ok(value) if value.is_nan() => Err(NoNumber::Hole),
        Ok(_) => Err(NoNumber::NotFinite),
        Err(_) => Err(no_number(word)),
    }
}

fn no_number(word: &str) -> NoNumber {
    let word = word.to_lowercase();
    let unsigned = word.trim_start_matches(['+', '-']);
    // how programs of Windows write what is no number: 1.#QNAN, -1.#IND, 1.#INF, with zeros behind as wide as the column
    if let Some(kind) = unsigned.strip_prefix("1.#") {
        return if kind.starts_with("inf") { NoNumber::NotFinite } else { NoNumber::Hole };
    }
    let is_hole = HOLES.contains(&word.as_str())
        || unsigned.starts_with("nan(")
        || unsigned == "nan"
        || word.chars().all(|letter| letter == '*')
        || word.chars().all(|letter| letter == '?');
    if is_hole { NoNumber::Hole } else { NoNumber::Other }
}

/// Whether a word that begins with `#` is one of a spreadsheet for a cell without a number, and not the start of a comment.
pub(super) fn is_of_a_spreadsheet(word: &str) -> bool {
    word.starts_with('#') && no_number(word) == NoNumber::Hole
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read_and_nothing_else_is() {
        for (word, value) in [
            ("1", 1.0),
            ("-0.009474", -0.009_474),
            ("+.5", 0.5),
            ("5.", 5.0),
            ("1e-8", 1e-8),
            ("1E+3", 1e3),
            ("0,25", 0.25),
            ("-1,5e-3", -1.5e-3),
        ] {
            assert_eq!(number(word, true), Ok(value), "{word}");
        }
        for (word, why) in [
            ("", NoNumber::Hole),
            ("NaN", NoNumber::Hole),
            ("-nan", NoNumber::Hole),
            ("-nan(ind)", NoNumber::Hole),
            ("1.#QNAN", NoNumber::Hole),
            ("-1.#IND00", NoNumber::Hole),
            ("1.#INF", NoNumber::NotFinite),
            ("-1.#INF000", NoNumber::NotFinite),
            ("inf", NoNumber::NotFinite),
            ("1e400", NoNumber::NotFinite),
            ("BAD", NoNumber::Hole),
            ("No Data", NoNumber::Hole),
            ("***", NoNumber::Hole),
            ("#N/A", NoNumber::Hole),
            ("--", NoNumber::Hole),
            ("0.0123#", NoNumber::Other),
            ("7#bad", NoNumber::Other),
            ("0x1p-3", NoNumber::Other),
            ("1D-5", NoNumber::Other),
            ("1_0", NoNumber::Other),
            ("1,234.5", NoNumber::CommaAndPoint),
            ("1,234,5", NoNumber::Other),
            ("5%", NoNumber::Other),
            ("١", NoNumber::Other),
        ] {
            assert_eq!(number(word, true), Err(why), "{word}");
        }
        assert_eq!(number("0,25", false), Err(NoNumber::Other));
    }
}
