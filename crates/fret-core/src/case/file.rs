//! The case file as it is written: unchecked, with the place of every value. The doc comments here are the schema's descriptions.

use schemars::JsonSchema;
use serde::Deserialize;
use serde::de::{self, SeqAccess, Visitor};
use toml::Spanned;

use super::along::{AlongFile, AlongPhaseSchema};
use super::body_file::BodyFile;
use super::pair::Pair;
use super::stage_file::{AutoWord, StageFile, WearFile};
use super::surface_file::{FrictionFile, ProfileFile};
use crate::model::{Beyond, Integration, Scheme};

/// A fretting contact: bodies, first gap, friction, and a loading history. Any consistent system of units.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "fretting case")]
pub(super) struct CaseFile {
    /// A title for tables and figures.
    pub title: Option<String>,
    /// Units of the numbers in the case, which then stand on axes and in attributes. Default: none, any consistent system of units.
    pub units: Option<UnitsFile>,
    /// The mesh of the potential contact area.
    pub grid: GridFile,
    /// The body that moves.
    #[schemars(with = "BodyFile")]
    pub upper: Spanned<BodyFile>,
    /// The body below; z points into it.
    #[schemars(with = "BodyFile")]
    pub lower: Spanned<BodyFile>,
    /// Undeformed gap: zero at first touch. The bodies' own profiles are added.
    #[schemars(with = "Option<ProfileFile>")]
    pub profile: Option<Spanned<ProfileFile>>,
    /// Dry friction. Default: frictionless.
    pub friction: Option<FrictionFile>,
    /// The machine between the upper body and what is driven. Default: rigid.
    pub rig: Option<RigFile>,
    /// Stages of the loading history, in order.
    #[schemars(with = "Vec<StageFile>")]
    pub load: Spanned<Vec<Spanned<StageFile>>>,
    /// Wear of the surfaces. Default: no wear.
    #[schemars(with = "Option<WearFile>")]
    pub wear: Option<Spanned<WearFile>>,
    /// Accuracy of the solution.
    pub solver: Option<SolverFile>,
    /// What is written to the results.
    pub output: Option<OutputFile>,
    /// Subsurface stresses, evaluated from the kept tractions after the run.
    #[schemars(with = "Option<StressFile>")]
    pub stress: Option<Spanned<StressFile>>,
    /// Temperature rise of the surfaces by friction, evaluated from the kept fields after the run.
    #[schemars(with = "Option<ThermalFile>")]
    pub thermal: Option<Spanned<ThermalFile>>,
}

/// The machine: springs between the upper body and what a stage drives with `actuator` and `actuator_approach`.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct RigFile {
    /// Tangential stiffness of the machine [force/length], along x and y or in both directions alike: actuator = shift + tangential
    /// force / stiffness. Default: rigid.
    #[schemars(with = "Option<AlongPhaseSchema>")]
    pub tangential_stiffness: Option<Spanned<AlongFile<f64>>>,
    /// Normal stiffness of the machine [force/length]: `actuator_approach` = approach + normal force / stiffness. Default: rigid.
    #[schemars(with = "Option<f64>")]
    pub normal_stiffness: Option<Spanned<f64>>,
    /// What the columns of a log that was measured on it are called, for `fret identify`. Default: usual names.
    pub columns: Option<LogColumnsFile>,
}

/// Columns of a measured log by what they hold.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct LogColumnsFile {
    /// Displacement of the actuator.
    #[schemars(with = "Option<String>")]
    pub displacement: Option<Spanned<String>>,
    /// Tangential force.
    #[schemars(with = "Option<String>")]
    pub force: Option<Spanned<String>>,
    /// Number of the cycle.
    #[schemars(with = "Option<String>")]
    pub cycle: Option<Spanned<String>>,
    /// Normal force.
    #[schemars(with = "Option<String>")]
    pub normal_force: Option<Spanned<String>>,
}

/// Units of the numbers in the case. Nothing is converted: results are in the same units.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct UnitsFile {
    /// Unit of every length, such as "mm".
    #[schemars(with = "String")]
    pub length: Spanned<String>,
    /// Unit of every force, such as "N". That of pressures and moduli follows: `MPa` for mm and N.
    #[schemars(with = "String")]
    pub force: Spanned<String>,
}

/// The mesh of the potential contact area, centred on the first point of touch.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct GridFile {
    /// Number of cells along x and y; a single number makes a line contact: plane strain across it, all loads per unit length.
    #[schemars(with = "CellsSchema")]
    pub cells: Spanned<CellsFile>,
    /// Side lengths along x and y, or "auto": chosen so that the contact fits with a margin. A single number in a line contact.
    #[schemars(with = "SizeSchema")]
    pub size: Spanned<SizeFile>,
    /// Depth below the load of the point that approach and shift of a line contact are relative to [length], in each body that has
    /// an elastic base. Default: the size of the grid.
    #[schemars(with = "Option<f64>")]
    pub datum: Option<Spanned<f64>>,
    /// What lies beyond the edge of the grid: "body" (contact that reaches the edge is refused) or "no body": one of the bodies
    /// ends there with a sharp edge, as a flat punch does, and contact may reach it (a rough specimen, a rectangular pad). Default: "body".
    #[schemars(with = "Option<Beyond>")]
    pub beyond: Option<Spanned<Beyond>>,
    /// Periodic in x and y. Default: false, infinite half-space.
    #[schemars(with = "Option<bool>")]
    pub periodic: Option<Spanned<bool>>,
}

/// Numbers of cells: of a grid, or of a line contact.
#[derive(Debug, Clone, Copy)]
pub(super) enum CellsFile {
    Grid([usize; 2]),
    Line(usize),
}

#[derive(JsonSchema)]
#[serde(untagged)]
#[expect(dead_code, reason = "stands for CellsFile in the schema")]
enum CellsSchema {
    Grid([usize; 2]),
    Line(usize),
}

impl<'de> Deserialize<'de> for CellsFile {
    fn deserialize<D: de::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct CellsVisitor;
        impl<'de> Visitor<'de> for CellsVisitor {
            type Value = CellsFile;
            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("numbers of cells [x, y], or one number for a line contact")
            }
            fn visit_i64<E: de::Error>(self, value: i64) -> Result<CellsFile, E> {
                let count = usize::try_from(value);
                count.map(CellsFile::Line).map_err(|_| E::invalid_value(de::Unexpected::Signed(value), &self))
            }
            fn visit_u64<E: de::Error>(self, value: u64) -> Result<CellsFile, E> {
                let count = usize::try_from(value);
                count
                    .map(CellsFile::Line)
                    .map_err(|_| E::invalid_value(de::Unexpected::Unsigned(value), &self))
            }
            fn visit_seq<A: SeqAccess<'de>>(self, sequence: A) -> Result<CellsFile, A::Error> {
                let pair = Pair::deserialize(de::value::SeqAccessDeserializer::new(sequence))?;
                Ok(CellsFile::Grid(pair.0))
            }
        }
        deserializer.deserialize_any(CellsVisitor)
    }
}

/// Side lengths, the length of a line contact's grid, or the word "auto".
#[derive(Debug, Clone, Copy)]
pub(super) enum SizeFile {
    Given([f64; 2]),
    Line(f64),
    Auto,
}

#[derive(JsonSchema)]
#[serde(untagged)]
#[expect(dead_code, reason = "stands for SizeFile in the schema")]
enum SizeSchema {
    Given([f64; 2]),
    Line(f64),
    Auto(AutoWord),
}

impl<'de> Deserialize<'de> for SizeFile {
    fn deserialize<D: de::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct SizeVisitor;
        impl<'de> Visitor<'de> for SizeVisitor {
            type Value = SizeFile;
            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("two side lengths [x, y], one of a line contact, or \"auto\"")
            }
            fn visit_f64<E: de::Error>(self, value: f64) -> Result<SizeFile, E> {
                Ok(SizeFile::Line(value))
            }
            fn visit_i64<E: de::Error>(self, value: i64) -> Result<SizeFile, E> {
                Ok(SizeFile::Line(value as f64))
            }
            fn visit_u64<E: de::Error>(self, value: u64) -> Result<SizeFile, E> {
                Ok(SizeFile::Line(value as f64))
            }
            fn visit_str<E: de::Error>(self, word: &str) -> Result<SizeFile, E> {
                if word == "auto" {
                    Ok(SizeFile::Auto)
                } else {
                    Err(E::invalid_value(de::Unexpected::Str(word), &self))
                }
            }
            fn visit_seq<A: SeqAccess<'de>>(self, mut sequence: A) -> Result<SizeFile, A::Error> {
                let mut sides = [0.0; 2];
                for (index, side) in sides.iter_mut().enumerate() {
                    *side =
                        sequence.next_element()?.ok_or_else(|| de::Error::invalid_length(index, &self))?;
                }
                if sequence.next_element::<f64>()?.is_some() {
                    return Err(de::Error::invalid_length(3, &self));
                }
                Ok(SizeFile::Given(sides))
            }
        }
        deserializer.deserialize_any(SizeVisitor)
    }
}

/// Accuracy of the solution.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct SolverFile {
    /// Largest accepted residual of every increment (complementarity, Coulomb, equilibrium; dimensionless). Default: 1e-8.
    #[schemars(with = "Option<f64>")]
    pub tolerance: Option<Spanned<f64>>,
    /// With `increments = "auto"`: tolerance of the adaptive sub-stepping, relative to the change of the tractions over the
    /// increment. Default: 0.03.
    #[schemars(with = "Option<f64>")]
    pub history_tolerance: Option<Spanned<f64>>,
    /// "monolithic": pressure and shear together; "staggered": in alternation (Panagiotopoulos process, the published three-level
    /// scheme), for comparison. Default: "monolithic".
    #[schemars(with = "Option<Scheme>")]
    pub scheme: Option<Spanned<Scheme>>,
    /// "`second_order`": the friction law at the end of an increment takes the direction that slip has there, and slip that turns goes
    /// along an arc; "`end_point`": the direction of the whole slip increment, and straight (backward Euler, of first order), for
    /// comparison. Default: "`second_order`".
    #[schemars(with = "Option<Integration>")]
    pub integration: Option<Spanned<Integration>>,
}

/// What is written to the results.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct OutputFile {
    /// Fields to keep: "pressure", "shear", "slip", "gap", "zone", "`worn_depth`", "friction". Default: pressure, shear, slip, zone.
    #[schemars(with = "Option<Vec<String>>")]
    pub fields: Option<Vec<Spanned<String>>>,
    /// Keep fields of every n-th increment, and of the last of each stage. Default: only of the last of each stage.
    #[schemars(with = "Option<usize>")]
    pub every: Option<Spanned<usize>>,
}

/// Subsurface stresses of one body, and constants of the fatigue parameters for those of its layers that name none of their own.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct StressFile {
    /// Depths below the surface of the body [length], or "auto": denser near the surface and the interfaces.
    #[schemars(with = "Option<DepthsSchema>")]
    pub depths: Option<Spanned<DepthsFile>>,
    /// The body. Default: "lower".
    #[schemars(with = "Option<SideFile>")]
    pub body: Option<Spanned<SideFile>>,
    /// Evaluate every n-th kept increment, and the last. Default: 1.
    #[schemars(with = "Option<usize>")]
    pub every: Option<Spanned<usize>>,
    /// Write volumes for `ParaView`. Default: false.
    pub volume: Option<bool>,
    /// Fatigue limit in fully reversed torsion, amplitude [pressure], for Crossland and Dang Van.
    #[schemars(with = "Option<f64>")]
    pub torsion_limit: Option<Spanned<f64>>,
    /// Fatigue limit in fully reversed tension or bending, amplitude [pressure], for Crossland and Dang Van.
    #[schemars(with = "Option<f64>")]
    pub tension_limit: Option<Spanned<f64>>,
    /// Yield strength [pressure], for Fatemi and Socie.
    #[schemars(with = "Option<f64>")]
    pub yield_strength: Option<Spanned<f64>>,
    /// Weight of the normal stress in Fatemi and Socie's parameter [-]. Default: 1.
    #[schemars(with = "Option<f64>")]
    pub normal_stress_sensitivity: Option<Spanned<f64>>,
    /// Critical distance L [length]: fatigue parameters are also told at the depth L/2 (point method) and as means from the surface
    /// down to 2 L (line method).
    #[schemars(with = "Option<f64>")]
    pub critical_distance: Option<Spanned<f64>>,
}

/// Steady temperature rise by the friction of the last cycle.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct ThermalFile {
    /// Cycles per unit of time; that of the conductivities, so that energy times frequency is their power.
    #[schemars(with = "f64")]
    pub frequency: Spanned<f64>,
}

/// One of the two bodies.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(super) enum SideFile {
    /// The body above.
    Upper,
    /// The body below.
    Lower,
}

/// Depths, or the word "auto".
#[derive(Debug, Clone)]
pub(super) enum DepthsFile {
    Given(Vec<f64>),
    Auto,
}

#[derive(JsonSchema)]
#[serde(untagged)]
#[expect(dead_code, reason = "stands for DepthsFile in the schema")]
enum DepthsSchema {
    Given(Vec<f64>),
    Auto(AutoWord),
}

impl<'de> Deserialize<'de> for DepthsFile {
    fn deserialize<D: de::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct DepthsVisitor;
        impl<'de> Visitor<'de> for DepthsVisitor {
            type Value = DepthsFile;
            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("a list of depths or \"auto\"")
            }
            fn visit_str<E: de::Error>(self, word: &str) -> Result<DepthsFile, E> {
                if word == "auto" {
                    Ok(DepthsFile::Auto)
                } else {
                    Err(E::invalid_value(de::Unexpected::Str(word), &self))
                }
            }
            fn visit_seq<A: SeqAccess<'de>>(self, mut sequence: A) -> Result<DepthsFile, A::Error> {
                let mut depths = Vec::new();
                while let Some(depth) = sequence.next_element::<f64>()? {
                    depths.push(depth);
                }
                Ok(DepthsFile::Given(depths))
            }
        }
        deserializer.deserialize_any(DepthsVisitor)
    }
}

/// JSON Schema of the case file.
pub fn schema() -> serde_json::Value {
    schemars::schema_for!(CaseFile).to_value()
}
