//! A closed form as a row of the catalogue: its parameters, what its solution holds, and how numbers become a solution. From the rows come the
//! functions and classes of `fretting.analytic`; what a solution says of itself are the doc comments of its struct.

use serde::Serialize;
use serde_json::{Map, Value};

use super::error::AnalyticError;
use super::parameter::Parameter;

/// A closed form that solves a contact from a few numbers.
#[derive(Debug, Serialize)]
pub struct Form {
    /// Its name.
    pub name: &'static str,
    /// What it does, in one sentence.
    pub sentence: &'static str,
    /// What it asks for, in this order.
    pub parameters: &'static [Parameter],
    /// What it answers with.
    pub solution: Contents,
    #[serde(skip)]
    pub(super) solve: fn(&[f64]) -> Result<Solved, AnalyticError>,
}

impl Form {
    /// Its solution for the numbers of all its parameters, one after the other; see [`Kind`](super::Kind).
    ///
    /// # Errors
    /// When a number is out of its range, or there are too few or too many.
    pub fn solve(&self, given: &[f64]) -> Result<Solved, AnalyticError> {
        (self.solve)(given)
    }
}

/// What a solution holds.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct Contents {
    /// Its name as a class.
    pub title: &'static str,
    /// Its doc comment: what it is, its formulas, its source.
    pub meaning: &'static str,
    /// Its numbers.
    pub numbers: &'static [Entry],
    /// Its functions; one of no coordinates is a number, too.
    pub functions: &'static [Function],
}

impl Contents {
    pub(super) const fn of<S: Numbers + Functions>() -> Self {
        Self { title: S::TITLE, meaning: S::MEANING, numbers: S::ENTRIES, functions: S::FUNCTIONS }
    }
}

/// A number of a solution.
#[derive(Debug, Serialize)]
pub struct Entry {
    /// Its name.
    pub name: &'static str,
    /// Its type.
    pub kind: &'static str,
    /// Its meaning with its unit.
    pub meaning: &'static str,
}

/// A function of a solution.
#[derive(Debug, Serialize)]
pub struct Function {
    /// Its name.
    pub name: &'static str,
    /// Names of its coordinates.
    pub at: &'static [&'static str],
    /// Its meaning with its unit.
    pub meaning: &'static str,
}

/// Numbers of a solution, by `#[derive(Numbers)]`: its public fields with their doc comments.
pub trait Numbers {
    /// Name of the struct.
    const TITLE: &'static str;
    /// Doc comment of the struct.
    const MEANING: &'static str;
    /// Its public fields.
    const ENTRIES: &'static [Entry];

    /// Their values.
    fn numbers(&self) -> Map<String, Value>;
}

/// Functions of a solution, by `#[functions]`: the methods marked `#[shown]` with their doc comments.
pub trait Functions {
    /// The functions.
    const FUNCTIONS: &'static [Function] = &[];

    /// The value of one of them at a point.
    fn value(&self, _function: usize, _at: &[f64]) -> f64 {
        f64::NAN
    }
}

/// The value of a function of a solution, by its place among them, at a point.
type Evaluate = Box<dyn Fn(usize, &[f64]) -> f64 + Send + Sync>;

/// A solution by the names of what it holds.
pub struct Solved {
    numbers: Map<String, Value>,
    functions: &'static [Function],
    value: Evaluate,
}

impl Solved {
    /// Any solution.
    pub fn of<S: Numbers + Functions + Send + Sync + 'static>(solution: S) -> Self {
        let numbers = solution.numbers();
        Self::with(numbers, solution)
    }

    /// Functions of a solution with other numbers than its own.
    pub fn with<S: Functions + Send + Sync + 'static>(mut numbers: Map<String, Value>, solution: S) -> Self {
        for (place, function) in
            S::FUNCTIONS.iter().enumerate().filter(|(_, function)| function.at.is_empty())
        {
            numbers.insert(function.name.to_owned(), solution.value(place, &[]).into());
        }
        let value = Box::new(move |function, at: &[f64]| solution.value(function, at));
        Self { numbers, functions: S::FUNCTIONS, value }
    }

    /// Its numbers.
    pub fn numbers(&self) -> &Map<String, Value> {
        &self.numbers
    }

    /// One of its functions of so many coordinates.
    pub fn function(&self, name: &str, coordinates: usize) -> Option<impl Fn(&[f64]) -> f64> {
        let is_meant = |function: &Function| function.name == name && function.at.len() == coordinates;
        let place = self.functions.iter().position(is_meant)?;
        Some(move |at: &[f64]| (self.value)(place, at))
    }
}

/// The solution by as many numbers as a form needs.
pub(super) fn solved<const N: usize, S: Numbers + Functions + Send + Sync + 'static>(
    given: &[f64],
    solve: impl Fn([f64; N]) -> Result<S, AnalyticError>,
) -> Result<Solved, AnalyticError> {
    let given = given.try_into().map_err(|_| AnalyticError::NumbersGiven(given.len()))?;
    solve(given).map(Solved::of)
}
