//! A stage of the loading history, and wear, as they are written.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::Deserialize;
use serde::de::{self, Visitor};
use toml::Spanned;

use super::along::{AlongFile, AlongPhaseSchema, AlongSchema};
use super::axis::{AxisFile, AxisSchema};
use super::pair::Pair;
use super::surface_file::CoefficientFile;

/// A stage of the loading history. Controls not named stay as they were.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct StageFile {
    /// A name for messages and tables.
    pub name: Option<String>,
    /// Normal force [force], compression positive: at the end of the stage, or the amplitude of its cycles.
    #[schemars(with = "Option<f64>")]
    pub normal_force: Option<Spanned<f64>>,
    /// Rigid approach [length]: at the end of the stage, or the amplitude.
    #[schemars(with = "Option<f64>")]
    pub approach: Option<Spanned<f64>>,
    /// Tangential force along x and y [force]: at the end, or the amplitude; "held" where this stage does not prescribe it.
    #[schemars(with = "Option<[AxisSchema; 2]>")]
    pub tangential_force: Option<Spanned<Pair<AxisFile>>>,
    /// Rigid tangential displacement of the upper body along x and y [length]: at the end, or the amplitude; or "held".
    #[schemars(with = "Option<[AxisSchema; 2]>")]
    pub shift: Option<Spanned<Pair<AxisFile>>>,
    /// Displacement of the actuator along x and y [length], the far end of the machine's spring ([rig]): shift + tangential force /
    /// stiffness; at the end, or the amplitude; or "held".
    #[schemars(with = "Option<[AxisSchema; 2]>")]
    pub actuator: Option<Spanned<Pair<AxisFile>>>,
    /// Normal displacement of the actuator [length]: approach + normal force / stiffness; at the end, or the amplitude.
    #[schemars(with = "Option<f64>")]
    pub actuator_approach: Option<Spanned<f64>>,
    /// Moment about z [force x length]: at the end, or the amplitude.
    #[schemars(with = "Option<f64>")]
    pub twist_moment: Option<Spanned<f64>>,
    /// Rotation of the upper body about z [rad]: at the end, or the amplitude.
    #[schemars(with = "Option<f64>")]
    pub twist: Option<Spanned<f64>>,
    /// First moment of the pressure along x and y, `sum p x dA` [force x length]: at the end, or the amplitude; or "held". A number
    /// in a line contact.
    #[schemars(with = "Option<AlongSchema>")]
    pub tilt_moment: Option<Spanned<AlongFile<AxisFile>>>,
    /// Slope of the upper body along x and y [-], deeper towards positive x and y: at the end, or the amplitude; or "held". A
    /// number in a line contact. Default: 0, fixed.
    #[schemars(with = "Option<AlongSchema>")]
    pub tilt: Option<Spanned<AlongFile<AxisFile>>>,
    /// Bulk stress of the lower body along x and y [pressure], remote stress of its substrate, tension positive: at the end, or the
    /// amplitude; or "held". A number in a line contact.
    #[schemars(with = "Option<AlongSchema>")]
    pub bulk_stress: Option<Spanned<AlongFile<AxisFile>>>,
    /// The same of the upper body.
    #[schemars(with = "Option<AlongSchema>")]
    pub upper_bulk_stress: Option<Spanned<AlongFile<AxisFile>>>,
    /// A CSV file with the values of the controls, instead of naming them here; its columns are named like the controls.
    #[schemars(with = "Option<String>")]
    pub table: Option<Spanned<String>>,
    /// Which column of the table holds which control, when they are named otherwise: `tangential_force_x = "Q [N]"`.
    #[schemars(with = "Option<BTreeMap<String, String>>")]
    pub columns: Option<BTreeMap<Spanned<String>, Spanned<String>>>,
    /// Number of increments: per stage; with cycles, per cycle; with a table, per row. "auto": 16 per stage, 32 per cycle, 4 per
    /// row, each with adaptive sub-steps controlled by `solver.history_tolerance`.
    #[schemars(with = "IncrementsSchema")]
    pub increments: Spanned<IncrementsFile>,
    /// How the controls run to their targets. Default: "linear".
    #[schemars(with = "Option<RampFile>")]
    pub ramp: Option<Spanned<RampFile>>,
    /// Number of cycles 0, +amplitude, -amplitude, 0 about the values before the stage.
    #[schemars(with = "Option<usize>")]
    pub cycles: Option<Spanned<usize>>,
    /// Instead of a number of cycles: repeat until the cycle is steady.
    #[schemars(with = "Option<SteadyFile>")]
    pub until_steady: Option<Spanned<SteadyFile>>,
    /// Shape of a cycle. Default: "triangle".
    #[schemars(with = "Option<WaveformFile>")]
    pub waveform: Option<Spanned<WaveformFile>>,
    /// Fraction of a cycle for which a trapezoid holds each of its two extremes, below 0.5. Default: 0.25.
    #[schemars(with = "Option<f64>")]
    pub dwell: Option<Spanned<f64>>,
    /// Phase lead of each control [degrees]; all reversal points are ends of increments. The cycle starts from the current value of the control.
    #[schemars(with = "Option<PhaseFile>")]
    pub phase: Option<Spanned<PhaseFile>>,
    /// Fraction of the amplitudes at the start and at the end of the cycles, linear between. Default: [1, 1].
    #[schemars(with = "Option<[f64; 2]>")]
    pub envelope: Option<Spanned<Pair<f64>>>,
    /// Friction from this stage on: a coefficient, or one per cell (a file, or rows of numbers).
    #[schemars(with = "Option<CoefficientFile>")]
    pub friction: Option<Spanned<CoefficientFile>>,
}

/// A number of increments, or the word "auto".
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum IncrementsFile {
    Count(usize),
    Auto,
}

#[derive(JsonSchema)]
#[serde(untagged)]
#[expect(dead_code, reason = "stands for IncrementsFile in the schema")]
enum IncrementsSchema {
    Count(usize),
    Auto(AutoWord),
}

#[derive(JsonSchema)]
#[serde(rename_all = "lowercase")]
#[expect(dead_code, reason = "stands for a word in the schema")]
pub(super) enum AutoWord {
    Auto,
}

impl<'de> Deserialize<'de> for IncrementsFile {
    fn deserialize<D: de::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct IncrementsVisitor;
        impl Visitor<'_> for IncrementsVisitor {
            type Value = IncrementsFile;
            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("a whole number or \"auto\"")
            }
            fn visit_i64<E: de::Error>(self, value: i64) -> Result<IncrementsFile, E> {
                usize::try_from(value)
                    .map(IncrementsFile::Count)
                    .map_err(|_| E::invalid_value(de::Unexpected::Signed(value), &self))
            }
            fn visit_u64<E: de::Error>(self, value: u64) -> Result<IncrementsFile, E> {
                usize::try_from(value)
                    .map(IncrementsFile::Count)
                    .map_err(|_| E::invalid_value(de::Unexpected::Unsigned(value), &self))
            }
            fn visit_str<E: de::Error>(self, word: &str) -> Result<IncrementsFile, E> {
                if word == "auto" {
                    Ok(IncrementsFile::Auto)
                } else {
                    Err(E::invalid_value(de::Unexpected::Str(word), &self))
                }
            }
        }
        deserializer.deserialize_any(IncrementsVisitor)
    }
}

/// How a ramp runs.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(super) enum RampFile {
    /// Equal increments.
    Linear,
    /// Forces with (k/n)^2, motions with (k/n)^(4/3): for a contact that grows from nothing.
    Square,
    /// Forces with (k/n)^3, motions with (k/n)^2: a sphere's contact radius grows evenly.
    Cubic,
}

/// Shape of a cycle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(super) enum WaveformFile {
    /// Straight lines.
    Triangle,
    /// A sine.
    Sine,
    /// Straight lines with both extremes held for a while.
    Trapezoid,
}

/// Phases of the controls [degrees], each by the name of its control.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct PhaseFile {
    /// Of the normal force.
    #[schemars(with = "Option<f64>")]
    pub normal_force: Option<Spanned<f64>>,
    /// Of the approach.
    #[schemars(with = "Option<f64>")]
    pub approach: Option<Spanned<f64>>,
    /// Of the tangential force along x and y.
    #[schemars(with = "Option<[f64; 2]>")]
    pub tangential_force: Option<Spanned<Pair<f64>>>,
    /// Of the shift along x and y.
    #[schemars(with = "Option<[f64; 2]>")]
    pub shift: Option<Spanned<Pair<f64>>>,
    /// Of the actuator along x and y.
    #[schemars(with = "Option<[f64; 2]>")]
    pub actuator: Option<Spanned<Pair<f64>>>,
    /// Of the actuator along z.
    #[schemars(with = "Option<f64>")]
    pub actuator_approach: Option<Spanned<f64>>,
    /// Of the moment about z.
    #[schemars(with = "Option<f64>")]
    pub twist_moment: Option<Spanned<f64>>,
    /// Of the rotation about z.
    #[schemars(with = "Option<f64>")]
    pub twist: Option<Spanned<f64>>,
    /// Of the moments of the pressure.
    #[schemars(with = "Option<AlongPhaseSchema>")]
    pub tilt_moment: Option<Spanned<AlongFile<f64>>>,
    /// Of the slopes.
    #[schemars(with = "Option<AlongPhaseSchema>")]
    pub tilt: Option<Spanned<AlongFile<f64>>>,
    /// Of the bulk stress of the lower body.
    #[schemars(with = "Option<AlongPhaseSchema>")]
    pub bulk_stress: Option<Spanned<AlongFile<f64>>>,
    /// Of that of the upper body.
    #[schemars(with = "Option<AlongPhaseSchema>")]
    pub upper_bulk_stress: Option<Spanned<AlongFile<f64>>>,
}

/// When the cycle counts as steady.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct SteadyFile {
    /// Tractions, forces and motions at the end of a cycle differ from those at its start by at most this, relative.
    #[schemars(with = "f64")]
    pub tolerance: Spanned<f64>,
    /// Maximum number of cycles.
    #[schemars(with = "usize")]
    pub most_cycles: Spanned<usize>,
}

/// Wear of the surfaces: after each computed cycle the gap grows by the wear depth.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct WearFile {
    /// Wear law. Default: "energy".
    pub law: Option<WearLawFile>,
    /// Wear coefficient k [1/pressure] of both bodies together: wear depth = k (pressure x slip distance) (Archard), or k (shear . slip)
    /// (energy). Instead: `wear_coefficient` of the layers, substrates and rigid bodies that wear.
    #[schemars(with = "Option<f64>")]
    pub coefficient: Option<Spanned<f64>>,
    /// Maximum cycle jump: number of cycles one simulated cycle may represent. Default: 1; with `tolerance` 1000000.
    #[schemars(with = "Option<usize>")]
    pub every: Option<Spanned<usize>>,
    /// Maximum wear depth per cycle jump, relative to the approach. Default: 0.01.
    #[schemars(with = "Option<f64>")]
    pub largest_step: Option<Spanned<f64>>,
    /// Stop when the wear depth reaches this value [length].
    #[schemars(with = "Option<f64>")]
    pub limit: Option<Spanned<f64>>,
    /// Stop when the outermost coating of this body is worn through.
    #[schemars(with = "Option<WornBodyFile>")]
    pub through_coating_of: Option<Spanned<WornBodyFile>>,
    /// Maximum relative error of the wear depth of a cycle jump, estimated from the change between computed cycles; jumps begin with
    /// one cycle and at most double. Default: not controlled.
    #[schemars(with = "Option<f64>")]
    pub tolerance: Option<Spanned<f64>>,
    /// Worn layers are thinner in the elastic response, too, which is found anew when the mean thickness of the layer at the surface has
    /// changed by this fraction. Needs `wear_coefficient` of the layers. Default: the response stays that of the unworn bodies.
    #[schemars(with = "Option<f64>")]
    pub thinning_tolerance: Option<Spanned<f64>>,
}

/// Wear law.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(super) enum WearLawFile {
    /// Pressure times slip.
    Archard,
    /// Energy dissipated by friction.
    Energy,
}

/// One of the bodies.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(super) enum WornBodyFile {
    /// The upper one.
    Upper,
    /// The lower one.
    Lower,
}
