//! What is asked of a log.

use crate::case::{Case, CaseError};
use crate::measured::Asked;

/// What is asked of a log.
#[derive(Debug, Clone, Default)]
pub struct Request {
    /// Columns by what they hold: `displacement`, `force`, `cycle`, `normal_force`, before those that the case names; and units.
    pub asked: Asked,
    /// The cycle that is fitted; default: the last whole one.
    pub cycle: Option<f64>,
    /// The fit is repeated on the first whole cycle of each group of so many.
    pub every: Option<usize>,
    /// Whether a log with a cycle that is no whole loop, or a row without a number, is refused; else these are skipped and named.
    pub strict: bool,
}

impl Request {
    /// Its columns and units, with the columns that the case names where none is asked for.
    pub(super) fn beside(&self, of_case: &[(&str, String)]) -> Asked {
        let mut asked = self.asked.clone();
        for (what, name) in of_case {
            if !asked.columns.iter().any(|(known, _)| known == what) {
                asked.columns.push(((*what).to_owned(), name.clone()));
            }
        }
        asked
    }
}

/// A number of the case that is fitted, too.
#[derive(Clone, Copy)]
pub struct Key<'a> {
    /// What it is called in the case, such as `lower.substrate.young`.
    pub name: &'a str,
    /// Its value there, positive.
    pub value: f64,
    /// The case with another value.
    pub case_with: &'a dyn Fn(f64) -> Result<Case, CaseError>,
}

impl std::fmt::Debug for Key<'_> {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter
            .debug_struct("Key")
            .field("name", &self.name)
            .field("value", &self.value)
            .finish_non_exhaustive()
    }
}
