//! A surface that its author writes down: an expression of x and y with named numbers.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::grid::SurfaceGrid;
use crate::document::{Expression, ExpressionError};

/// The variables of an expression.
pub const VARIABLES: [&str; 2] = ["x", "y"];

/// A gap as an expression of x and y [length], counted from the middle of the grid.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Written", into = "Written")]
pub struct Formula {
    text: String,
    parameters: Vec<(String, f64)>,
    expression: Expression,
}

/// A formula as a record of a run has it.
#[derive(Clone, Serialize, Deserialize)]
struct Written {
    expression: String,
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    parameters: BTreeMap<String, f64>,
}

impl Formula {
    /// A formula and the numbers that it names.
    ///
    /// # Errors
    /// When it is no expression of x, y and these numbers.
    pub fn new(text: &str, parameters: Vec<(String, f64)>) -> Result<Self, ExpressionError> {
        let expression = Expression::parse(text, &VARIABLES, &parameters)?;
        Ok(Self { text: text.to_owned(), parameters, expression })
    }

    /// Its value at a point [length]; infinite, as where there is no body, where it has none.
    pub fn at(&self, x: f64, y: f64) -> f64 {
        let value = self.expression.at(&[x, y]);
        if value.is_finite() { value } else { f64::INFINITY }
    }

    /// The first cell centre of a grid at which it has no finite value, or the middle, where there is one.
    pub fn undefined_on(&self, grid: &SurfaceGrid) -> Option<[f64; 2]> {
        let [nx, ny] = grid.cells();
        let centres = (0..nx).flat_map(|i| (0..ny).map(move |j| [grid.centre(0, i), grid.centre(1, j)]));
        centres.chain([[0.0; 2]]).find(|[x, y]| !self.at(*x, *y).is_finite())
    }

    /// Whether the expression names a number.
    pub fn names(&self, number: &str) -> bool {
        let is_of_a_name = |letter: char| letter.is_ascii_alphanumeric() || letter == '_';
        self.text.split(|letter| !is_of_a_name(letter)).any(|word| word == number)
    }

    /// Whether it depends on x (0) or y (1).
    pub fn depends_on(&self, axis: usize) -> bool {
        self.expression.has(axis)
    }
}

impl TryFrom<Written> for Formula {
    type Error = String;

    fn try_from(written: Written) -> Result<Self, String> {
        Self::new(&written.expression, written.parameters.into_iter().collect())
            .map_err(|error| error.message)
    }
}

impl From<Formula> for Written {
    fn from(formula: Formula) -> Self {
        Self { expression: formula.text, parameters: formula.parameters.into_iter().collect() }
    }
}
