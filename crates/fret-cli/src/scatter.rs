//! A number of a case with its standard deviation, as it is typed: `friction.coefficient=10%`.

use std::str::FromStr;

/// A number of a case with its standard deviation.
#[derive(Debug, Clone, PartialEq)]
pub struct Scatter {
    /// Its path.
    pub path: String,
    /// The deviation, of the unit of the number, or relative to it.
    pub deviation: f64,
    /// Whether it is relative.
    pub relative: bool,
}

impl FromStr for Scatter {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let form = "expected a number of the case and its standard deviation, friction.coefficient=0.03 or friction.coefficient=10%";
        let (path, deviation) = text.rsplit_once('=').ok_or(form)?;
        let (number, unit) = deviation.strip_suffix('%').map_or((deviation, 1.0), |number| (number, 0.01));
        let number: f64 = number.trim().parse().map_err(|_| form)?;
        if !(number.is_finite() && number > 0.0) {
            return Err(format!("{deviation}: a standard deviation is positive"));
        }
        let relative = deviation.ends_with('%');
        Ok(Self { path: path.trim().to_owned(), deviation: number * unit, relative })
    }
}
