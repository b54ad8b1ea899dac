//! What an increment is asked for, and how it can end without an answer.

use std::ops::ControlFlow;

use serde::Serialize;

use super::shortcut::LeaveOut;
use crate::model::Scheme;

/// How pressure and shear act on each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Coupling {
    /// No friction: pressure alone.
    Frictionless,
    /// Shear does not move the surfaces normally: pressure first, then shear.
    Uncoupled,
    /// Pressure and shear together.
    Coupled,
}

/// Limits of the solver.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SolverSettings {
    /// Bound on the residual, dimensionless.
    pub tolerance: f64,
    /// Changes of the zones before an increment is given up.
    pub most_outer_iterations: usize,
    /// Krylov steps on frozen zones.
    pub most_inner_iterations: usize,
    /// How coupled pressure and shear are solved.
    pub scheme: Scheme,
    /// What is left out where the scene allows it.
    pub leave_out: LeaveOut,
    /// Six digits do in approximate inverses and on frozen zones. What is accepted was judged in double precision.
    pub six_digits: bool,
}

impl SolverSettings {
    /// Settings for a tolerance; coupled tractions together.
    pub fn new(tolerance: f64) -> Self {
        Self {
            tolerance,
            most_outer_iterations: 200,
            most_inner_iterations: 30,
            scheme: Scheme::default(),
            leave_out: LeaveOut::ALL,
            six_digits: false,
        }
    }
}

/// Why an increment has no answer.
#[derive(Debug, Clone, PartialEq)]
pub enum SolveError {
    /// The residual stayed above the tolerance.
    NotConverged {
        /// Residual reached.
        reached: f64,
        /// Iterations made.
        iterations: usize,
    },
    /// More tangential force than friction carries.
    AboveSliding {
        /// Force asked for [force].
        asked: f64,
        /// mu W [force].
        bound: f64,
    },
    /// The contact reaches the edge of the grid.
    ContactAtEdge,
    /// The influence coefficients do not cover the scene.
    OperatorsMissing,
    /// Somebody stopped the iteration.
    Stopped,
}

impl SolveError {
    /// The error of a scene with mirrors, of whose cells one in `copies` was solved.
    pub(super) fn of_whole(self, copies: usize) -> Self {
        match self {
            Self::AboveSliding { asked, bound } => {
                let copies = copies as f64;
                Self::AboveSliding { asked: asked * copies, bound: bound * copies }
            }
            other => other,
        }
    }
}

/// Hears of every outer iteration and its residual; may stop it.
pub type Watch<'a> = &'a mut dyn FnMut(usize, f64) -> ControlFlow<()>;
