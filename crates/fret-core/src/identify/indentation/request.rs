//! What is asked of a measured indentation.

use crate::case::{Case, CaseError};
use crate::measured::Asked;

/// Numbers of a case that are fitted to an indentation.
pub struct Numbers<'a> {
    /// What they are called in the case, such as `lower.coatings[0].young`, and their values there, positive.
    pub keys: Vec<(String, f64)>,
    /// The case with other values.
    pub case_with: &'a (dyn Fn(&[f64]) -> Result<Case, CaseError> + Sync),
}

impl std::fmt::Debug for Numbers<'_> {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.debug_struct("Numbers").field("keys", &self.keys).finish_non_exhaustive()
    }
}

/// Which part of a test is fitted.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Part {
    /// All rows.
    #[default]
    Whole,
    /// Up to the first row with the largest load.
    Loading,
    /// From the last row with the largest load on.
    Unloading,
}

impl Part {
    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Whole => "whole",
            Self::Loading => "loading",
            Self::Unloading => "unloading",
        }
    }

    /// That of a name.
    pub fn named(name: &str) -> Option<Self> {
        [Self::Whole, Self::Loading, Self::Unloading].into_iter().find(|part| part.name() == name)
    }
}

/// What is asked of an indentation.
#[derive(Debug, Clone, Default)]
pub struct IndentationRequest {
    /// Columns by what they hold, `depth` and `force`; and their units.
    pub asked: Asked,
    /// Which part of the test is fitted.
    pub part: Part,
    /// The depth at which the indenter touches, in the unit of the case; `None`: fitted.
    pub touch: Option<f64>,
    /// Whether the compliance of the frame is fitted, too; else it is that of `rig.normal_stiffness` in the case, or nothing.
    pub frame: bool,
    /// Whether a row without a number is refused; else it is skipped and named.
    pub strict: bool,
}
