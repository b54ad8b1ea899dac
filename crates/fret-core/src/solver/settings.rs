//! What a solver is asked for, and how an increment can end without a solution.

use std::ops::ControlFlow;

use fret_fft::ConvolutionError;
use serde::{Deserialize, Serialize};

use crate::model::{Integration, Scheme};

/// How pressure and shear act on each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Coupling {
    /// No friction: pressure alone.
    Frictionless,
    /// Shear does not move the surfaces normally: pressure first, then shear.
    Uncoupled,
    /// Pressure and shear together.
    Coupled,
}

/// What a user may want to set. What stands beside a method in its own file is a property of the method.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SolverSettings {
    /// Bound on the residual, dimensionless.
    pub tolerance: f64,
    /// How coupled pressure and shear are solved.
    pub scheme: Scheme,
    /// How slip is integrated over an increment.
    pub integration: Integration,
    /// Newton iterations, each with new active sets, before an increment is left to other methods.
    pub max_newton_iterations: usize,
    /// What the quick way of Newton's method does not solve is left to the other one.
    pub another_way: bool,
    /// Linear problems and approximate inverses in single precision. Residuals are found in double precision.
    pub single_precision: bool,
    /// Without coupling the pressure is not solved again while the normal load stays.
    pub reuse_pressure: bool,
    /// Without coupling no shear is solved for before something causes it.
    pub skip_unloaded_shear: bool,
    /// What friction dissipates is told of every cell.
    pub friction_work: bool,
}

impl SolverSettings {
    /// Settings for a tolerance.
    pub fn new(tolerance: f64) -> Self {
        Self {
            tolerance,
            scheme: Scheme::default(),
            integration: Integration::default(),
            max_newton_iterations: 60,
            another_way: true,
            single_precision: false,
            reuse_pressure: true,
            skip_unloaded_shear: true,
            friction_work: false,
        }
    }
}

/// What bounds the tangential force that friction carries.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Carried {
    /// The friction coefficient: mu P.
    Coefficient,
    /// The friction coefficient and the shear strength of the interface.
    Strength,
    /// The pressure under which the contact slides, which is another one than before.
    Sliding,
}

/// Why an increment has no solution.
#[derive(Debug, Clone, PartialEq)]
pub enum SolveError {
    /// The residual stayed above the tolerance.
    NotConverged {
        /// Residual reached.
        reached: f64,
        /// Iterations made.
        iterations: usize,
    },
    /// The place of surfaces that move, and the shift or the twist that follow in it, do not come together.
    Wanders {
        /// How far they are apart on the grid [cells].
        apart: f64,
        /// Rounds made.
        rounds: usize,
    },
    /// A contact that rolls comes to no steady state.
    NotSteady {
        /// By how much the tractions still change over a length of the contact, of their size.
        change: f64,
        /// Increments made.
        increments: usize,
    },
    /// More tangential force than friction carries, or as much: the contact slides, and no force tells how far.
    AboveSliding {
        /// Force asked for [force].
        asked: f64,
        /// What friction carries [force].
        bound: f64,
        /// What that is.
        by: Carried,
    },
    /// More force and moment together than friction carries.
    AboveFullSlip {
        /// The fraction of them that it carries at the most [-].
        fraction: f64,
    },
    /// A normal force that all cells at the hardness do not carry, or just carry.
    AboveHardness {
        /// Force asked for [force].
        asked: f64,
        /// What the whole grid carries at the hardness [force].
        bound: f64,
    },
    /// No tilt gives the prescribed moment of the pressure.
    NoTilt {
        /// Moment asked for [force x length].
        asked: f64,
        /// Moment reached [force x length].
        reached: f64,
    },
    /// The contact reaches the edge of the grid.
    ContactAtEdge,
    /// The influence coefficients do not cover the grid.
    OperatorsMissing(ConvolutionError),
    /// The caller stopped the iteration.
    Stopped,
}

impl From<ConvolutionError> for SolveError {
    fn from(error: ConvolutionError) -> Self {
        Self::OperatorsMissing(error)
    }
}

impl SolveError {
    /// Whether a shorter increment may have a solution that was found.
    pub fn is_of_long_increments(&self) -> bool {
        matches!(self, Self::NotConverged { .. } | Self::Wanders { .. })
    }

    /// The error of a grid of whose cells one in `copies` was solved.
    pub(super) fn of_whole(self, copies: usize) -> Self {
        match self {
            Self::AboveSliding { asked, bound, by } => {
                let copies = copies as f64;
                Self::AboveSliding { asked: asked * copies, bound: bound * copies, by }
            }
            Self::AboveHardness { asked, bound } => {
                let copies = copies as f64;
                Self::AboveHardness { asked: asked * copies, bound: bound * copies }
            }
            Self::NoTilt { asked, reached } => {
                let copies = copies as f64;
                Self::NoTilt { asked: asked * copies, reached: reached * copies }
            }
            other => other,
        }
    }
}

/// Is called in every iteration with its number and residual; may stop it.
pub type IterationCallback<'a> = &'a mut dyn FnMut(usize, f64) -> ControlFlow<()>;
