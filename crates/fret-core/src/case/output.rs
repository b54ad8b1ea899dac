//! What of the solution is kept.

use serde::{Deserialize, Serialize};

/// Fields that can be kept, by the names of the case file.
pub const FIELD_NAMES: [&str; 10] = [
    "pressure",
    "shear",
    "slip",
    "gap",
    "zone",
    "worn_depth",
    "debris",
    "plastic_depth",
    "friction_work",
    "friction",
];

/// What of the solution is kept.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Output {
    /// Names out of [`FIELD_NAMES`].
    pub fields: Vec<String>,
    /// Fields of every so many increments of a stage are kept, and of its last; `None`: of the last only.
    pub every: Option<usize>,
}

impl Output {
    /// Whether a field is kept.
    pub fn keeps(&self, name: &str) -> bool {
        self.fields.iter().any(|field| field == name)
    }
}
