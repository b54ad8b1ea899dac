//! A stage of the loading history, and wear, as they are written.

use schemars::JsonSchema;

use super::body_file::COEFFICIENT;
use super::control_keys::{BothOrOne, ControlKeys, PhaseKeys};
use super::surface_file::{CoefficientFile, JUMP, LENGTH, UP_TO_1};
use crate::document::{At, Named, Range, Table};
use crate::model::WearLaw;

/// A stage of the loading history. Controls not named stay as they were.
#[derive(Table, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(super) struct StageFile {
    /// A name for messages and tables.
    pub name: Option<String>,
    /// What it prescribes.
    #[table(flatten)]
    #[schemars(flatten)]
    pub controls: ControlKeys,
    /// Direction in which a contact with `roll = "steady"` rolls, along x and y, of any length; a number in a line contact. Default: [1, 0].
    pub roll_direction: Option<At<BothOrOne>>,
    /// A CSV file with the values of the controls, instead of naming them here; its columns are named like the controls.
    pub table: Option<At<String>>,
    /// Which column of the table holds which control, when they are named otherwise: `tangential_force_x = "Q [N]"`.
    pub columns: Option<Named>,
    /// Number of increments: per stage; with cycles, per cycle; with a table, per row. "auto": 16 per stage, 32 per cycle, 4 per
    /// row, each with adaptive sub-steps controlled by `solver.history_tolerance`.
    pub increments: IncrementsFile,
    /// How the controls run to their targets. Default: "linear".
    pub ramp: Option<RampFile>,
    /// Number of cycles 0, +amplitude, -amplitude, 0 about the values before the stage.
    pub cycles: Option<usize>,
    /// Instead of a number of cycles: repeat until the cycle is steady.
    pub until_steady: Option<SteadyFile>,
    /// Shape of a cycle. Default: "triangle".
    pub waveform: Option<WaveformFile>,
    /// Fraction of a cycle for which a trapezoid holds each of its two extremes, below 0.5. Default: 0.25.
    pub dwell: Option<f64>,
    /// Phase lead of each control [degrees]; all reversal points are ends of increments. The cycle starts from the current value of the control.
    pub phase: Option<PhaseFile>,
    /// Fraction of the amplitudes at the start and at the end of the cycles, linear between. Default: [1, 1].
    pub envelope: Option<[f64; 2]>,
    /// Friction from this stage on: a coefficient, or one per cell (a file, or rows of numbers).
    pub friction: Option<At<CoefficientFile>>,
}

/// A number of increments, or the word "auto".
#[derive(Debug, Clone, Copy, PartialEq, Table, JsonSchema)]
#[expected("a whole number or \"auto\"")]
#[schemars(untagged, rename = "IncrementsSchema", description = "")]
pub(super) enum IncrementsFile {
    Count(usize),
    Auto(AutoWord),
}

/// A value that is left to the program.
#[derive(Debug, Clone, Copy, PartialEq, Table, JsonSchema)]
#[schemars(rename_all = "lowercase", description = "")]
pub(super) enum AutoWord {
    Auto,
}

/// How a ramp runs.
#[derive(Debug, Clone, Copy, Table, JsonSchema)]
#[schemars(rename_all = "lowercase")]
pub(super) enum RampFile {
    /// Equal increments.
    Linear,
    /// Forces with (k/n)^2, motions with (k/n)^(4/3): for a contact that grows from nothing.
    Square,
    /// Forces with (k/n)^3, motions with (k/n)^2: a sphere's contact radius grows evenly.
    Cubic,
}

/// Shape of a cycle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Table, JsonSchema)]
#[schemars(rename_all = "lowercase")]
pub(super) enum WaveformFile {
    /// Straight lines.
    Triangle,
    /// A sine.
    Sine,
    /// Straight lines with both extremes held for a while.
    Trapezoid,
}

/// Phases of the controls [degrees], each by the name of its control.
#[derive(Table, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(super) struct PhaseFile {
    /// One for each control.
    #[table(flatten)]
    #[schemars(flatten)]
    pub keys: PhaseKeys,
}

/// When the cycle counts as steady.
#[derive(Table, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(super) struct SteadyFile {
    /// Tractions, forces and motions at the end of a cycle differ from those at its start by at most this, relative.
    pub tolerance: f64,
    /// Maximum number of cycles.
    pub most_cycles: usize,
}

/// Relative change of thickness between two responses.
const THINNING: Range =
    Range::up_to(0.5, "must lie above 0, and at 0.5 at the most").help("0.02 serves most purposes");

/// Wear of the surfaces: after each computed cycle the gap grows by the wear depth.
#[derive(Table, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(super) struct WearFile {
    /// Wear law. Default: "energy".
    pub law: Option<WearLaw>,
    /// Wear coefficient k [1/pressure] of both bodies together: wear depth = k (pressure x slip distance) (Archard), or k (shear . slip)
    /// (energy). Instead: `wear_coefficient` of the layers, substrates and rigid bodies that wear.
    #[range(COEFFICIENT)]
    pub coefficient: Option<At<f64>>,
    /// Maximum cycle jump: number of cycles one simulated cycle may represent. Default: 1; with `tolerance` 1000000.
    #[range(JUMP)]
    pub every: Option<At<usize>>,
    /// Maximum wear depth per cycle jump, relative to the approach. Default: 0.01.
    #[range(Range::up_to(1.0, UP_TO_1).help("relative to the approach; 0.01 serves most purposes"))]
    pub largest_step: Option<f64>,
    /// Stop when the wear depth reaches this value [length].
    #[range(LENGTH)]
    pub limit: Option<At<f64>>,
    /// Stop when the outermost coating of this body is worn through.
    pub through_coating_of: Option<At<WornBodyFile>>,
    /// Maximum relative error of the wear depth of a cycle jump, estimated from the change between computed cycles; jumps begin with
    /// one cycle and at most double. Default: not controlled.
    #[range(Range::up_to(1.0, UP_TO_1).help("0.02 serves most purposes"))]
    pub tolerance: Option<f64>,
    /// Worn layers are thinner in the elastic response, too, which is found anew when the mean thickness of the layer at the surface has
    /// changed by this fraction. Needs `wear_coefficient` of the layers. Default: the response stays that of the unworn bodies.
    #[range(THINNING)]
    pub thinning_tolerance: Option<At<f64>>,
    /// Debris that stays between the surfaces. Default: all that wears off is gone; what a history starts with stays as it is.
    pub debris: Option<At<DebrisFile>>,
    /// Another wear coefficient far from the rim of the contact. Default: the same everywhere.
    pub rim: Option<At<RimFile>>,
}

/// Part of a volume.
const FRACTION: Range = Range::between(0.0, 1.0, "must lie between 0 and 1");

/// Debris between the surfaces: a layer that fills the gap, in each cell as thick as what has stayed there. It lies in the frame of the lower
/// body.
#[derive(Table, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(super) struct DebrisFile {
    /// Fraction of what wears off both bodies that stays between them, with its volume.
    #[range(FRACTION)]
    pub fraction: f64,
    /// Slip distance in which all but 1/e of the debris of a cell flows out over the rim of the contact [length]: its thickness falls by thickness x
    /// slip distance / `outflow_length`. Default: none flows out.
    #[range(LENGTH)]
    pub outflow_length: Option<f64>,
    /// Modulus of the debris [pressure]: under a pressure p it gives by p x thickness / `stiffness` and no further aside. Default: it does not give.
    #[range(Range::POSITIVE)]
    pub stiffness: Option<f64>,
}

/// Wear by the distance from the rim of the contact to which air has access; a pocket inside of the contact has none.
#[derive(Table, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(super) struct RimFile {
    /// Distance from the rim within which the surfaces wear by their wear coefficient [length].
    #[range(LENGTH)]
    pub width: f64,
    /// Wear coefficient farther inside, over that at the rim.
    #[range(Range::NOT_NEGATIVE)]
    pub interior: f64,
    /// The same of the upper body, with `kinematics.displacement` = "finite". Default: `interior`.
    #[range(Range::NOT_NEGATIVE)]
    pub upper_interior: Option<At<f64>>,
}

/// One of the bodies.
#[derive(Debug, Clone, Copy, Table, JsonSchema)]
#[schemars(rename_all = "lowercase")]
pub(super) enum WornBodyFile {
    /// The upper one.
    Upper,
    /// The lower one.
    Lower,
}

impl WornBodyFile {
    /// 0: lower, 1: upper.
    pub fn number(self) -> usize {
        match self {
            Self::Lower => 0,
            Self::Upper => 1,
        }
    }
}
