//! The case file as it is written: unchecked, with the place of every value. The doc comments here are the schema's descriptions.

use schemars::JsonSchema;

use super::body_file::BodyFile;
use super::control_keys::BothOrOne;
use super::stage_file::{AutoWord, StageFile, WearFile};
use super::surface_file::{FrictionFile, LENGTH, ProfileFile};
use crate::document::{At, Range, Table};
use crate::model::{Beyond, BeyondMaps, Displacement, Frame, Integration, Periodicity, Scheme, Side};

/// A fretting contact: bodies, first gap, friction, and a loading history. Any consistent system of units.
#[derive(Table, JsonSchema)]
#[schemars(deny_unknown_fields)]
#[schemars(title = "fretting case")]
pub(super) struct CaseFile {
    /// A title for tables and figures.
    pub title: Option<String>,
    /// Units of the numbers in the case, which then stand on axes and in attributes. Default: none, any consistent system of units.
    pub units: Option<UnitsFile>,
    /// The mesh of the potential contact area.
    pub grid: GridFile,
    /// The body that moves.
    pub upper: At<BodyFile>,
    /// The body below; z points into it.
    pub lower: At<BodyFile>,
    /// Undeformed gap: zero at first touch. The bodies' own profiles are added.
    pub profile: Option<At<ProfileFile>>,
    /// Dry friction. Default: frictionless.
    pub friction: Option<FrictionFile>,
    /// How the surfaces move against each other. Default: by displacements that are small against the contact.
    pub kinematics: Option<At<KinematicsFile>>,
    /// The machine between the upper body and what is driven. Default: rigid.
    pub rig: Option<RigFile>,
    /// Stages of the loading history, in order.
    pub load: At<Vec<At<StageFile>>>,
    /// Wear of the surfaces. Default: no wear.
    pub wear: Option<At<WearFile>>,
    /// Accuracy of the solution.
    pub solver: Option<SolverFile>,
    /// What is written to the results.
    pub output: Option<OutputFile>,
    /// Subsurface stresses, evaluated from the kept tractions after the run.
    pub stress: Option<At<StressFile>>,
    /// Temperature rise of the surfaces by friction, evaluated from the kept fields after the run.
    pub thermal: Option<At<ThermalFile>>,
}

/// How the surfaces move against each other.
#[derive(Table, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(super) struct KinematicsFile {
    /// "small": opposite points of the surfaces stay opposite, for a shift that is small against the contact; "finite": profile,
    /// topography and wear of the upper body move with it by its shift, and each body wears in its own frame, the lower one in that of the
    /// grid. A table [profile] is then the upper body's. Default: "small".
    pub displacement: Option<At<Displacement>>,
    /// Where the grid is while the contact rolls: fixed to the "bodies", through which the contact travels, or with the "contact", by whole cells
    /// in every increment. Default: "bodies".
    pub frame: Option<At<Frame>>,
    /// What lies beyond the maps of heights and friction, which are as long as the grid, where it goes with the contact: what is at their "edge"
    /// continues, or the map "repeats", or "mirrors" itself at its edges. Needed where such a map travels through the grid.
    pub beyond_maps: Option<At<BeyondMaps>>,
}

/// Stiffness whose inverse is a number, too.
const STIFFNESS: Range =
    Range::between(f64::MIN_POSITIVE, f64::MAX, "must be a positive finite stiffness [force/length]")
        .help("leave it out where the machine does not give");
/// A strength.
const STRESS: Range = Range::POSITIVE.words("must be a positive finite stress");

/// The machine: springs between the upper body and what a stage drives with `actuator` and `actuator_approach`.
#[derive(Table, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(super) struct RigFile {
    /// Tangential stiffness of the machine [force/length], along x and y or in both directions alike: actuator = shift + tangential
    /// force / stiffness. Default: rigid.
    #[range(STIFFNESS)]
    pub tangential_stiffness: Option<At<BothOrOne>>,
    /// Normal stiffness of the machine [force/length]: `actuator_approach` = approach + normal force / stiffness. Default: rigid.
    #[range(STIFFNESS)]
    pub normal_stiffness: Option<At<f64>>,
    /// What the columns of a log that was measured on it are called, for `fret identify`. Default: usual names.
    pub columns: Option<LogColumnsFile>,
}

/// Columns of a measured log by what they hold.
#[derive(Table, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(super) struct LogColumnsFile {
    /// Displacement of the actuator.
    pub displacement: Option<At<String>>,
    /// Tangential force.
    pub force: Option<At<String>>,
    /// Number of the cycle.
    pub cycle: Option<At<String>>,
    /// Normal force.
    pub normal_force: Option<At<String>>,
}

/// Units of the numbers in the case. Nothing is converted: results are in the same units.
#[derive(Table, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(super) struct UnitsFile {
    /// Unit of every length, such as "mm".
    pub length: At<String>,
    /// Unit of every force, such as "N". That of pressures and moduli follows: `MPa` for mm and N.
    pub force: At<String>,
}

/// The mesh of the potential contact area, centred on the first point of touch.
#[derive(Table, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(super) struct GridFile {
    /// Number of cells along x and y; a single number makes a line contact: plane strain across it, all loads per unit length.
    pub cells: At<CellsFile>,
    /// Side lengths along x and y [length], or "auto": chosen so that the contact fits with a margin. A single number in a line contact.
    pub size: At<SizeFile>,
    /// Depth below the load of the point that approach and shift are relative to [length], in each body that has an elastic base; of a line
    /// contact, and of one that repeats along one axis. Default: the size of the grid across that axis.
    pub datum: Option<At<f64>>,
    /// What lies beyond the edge of the grid: "body" (contact that reaches the edge is refused) or "no body": one of the bodies
    /// ends there with a sharp edge, as a flat punch does, and contact may reach it (a rough specimen, a rectangular pad). Default: "body".
    pub beyond: Option<At<Beyond>>,
    /// Periodic in x and y (true), along one axis alone ("x" or "y"; along the other the half-spaces are infinite, and approach and shift are
    /// relative to a datum, as in a line contact), or not at all. Default: false, infinite half-spaces.
    pub periodic: Option<At<Periodicity>>,
}

impl GridFile {
    /// Along which axes the scene repeats.
    pub fn periodicity(&self) -> Periodicity {
        self.periodic.as_deref().copied().unwrap_or_default()
    }
}

/// Numbers of cells: of a grid, or of a line contact.
#[derive(Debug, Clone, Copy, Table, JsonSchema)]
#[expected("numbers of cells [x, y], or one number for a line contact")]
#[schemars(untagged, rename = "CellsSchema", description = "")]
pub(super) enum CellsFile {
    Grid([usize; 2]),
    Line(usize),
}

/// Side lengths, the length of a line contact's grid, or the word "auto".
#[derive(Debug, Clone, Copy, Table, JsonSchema)]
#[expected("two side lengths [x, y], one of a line contact, or \"auto\"")]
#[schemars(untagged, rename = "SizeSchema", description = "")]
pub(super) enum SizeFile {
    Given([f64; 2]),
    Line(f64),
    Auto(AutoWord),
}

/// Accuracy of the solution.
#[derive(Table, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(super) struct SolverFile {
    /// Largest accepted residual of every increment (complementarity, Coulomb, equilibrium; dimensionless). Default: 1e-8.
    pub tolerance: Option<At<f64>>,
    /// With `increments = "auto"`: tolerance of the adaptive sub-stepping, relative to the change of the tractions over the
    /// increment. Default: 0.03.
    #[range(Range::between(1e-6, 0.5, "must lie between 1e-6 and 0.5").help("0.03 serves most purposes"))]
    pub history_tolerance: Option<At<f64>>,
    /// "monolithic": pressure and shear together; "staggered": in alternation (Panagiotopoulos process, the published three-level
    /// scheme), for comparison. Default: "monolithic".
    pub scheme: Option<Scheme>,
    /// "`second_order`": the friction law at the end of an increment takes the direction that slip has there, and slip that turns goes
    /// along an arc; "`end_point`": the direction of the whole slip increment, and straight (backward Euler, of first order), for
    /// comparison. Default: "`second_order`".
    pub integration: Option<Integration>,
}

/// What is written to the results.
#[derive(Table, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(super) struct OutputFile {
    /// Fields to keep: "pressure", "shear", "slip", "gap", "zone", "`worn_depth`" (of bodies that move against each other also of each), "debris",
    /// "`plastic_depth`", "`friction_work`" (energy that friction dissipates in the increment by area), "friction". Default: pressure, shear, slip, zone.
    pub fields: Option<Vec<At<String>>>,
    /// Keep fields of every n-th increment, and of the last of each stage. Default: only of the last of each stage.
    #[range(Range::COUNT.help("every = 1 keeps all increments"))]
    pub every: Option<usize>,
}

/// Subsurface stresses of one body, and constants of the fatigue parameters for those of its layers that name none of their own.
#[derive(Table, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(super) struct StressFile {
    /// Depths below the surface of the body [length], or "auto": denser near the surface and the interfaces.
    pub depths: Option<At<DepthsFile>>,
    /// The body. Default: "lower".
    pub body: Option<At<Side>>,
    /// Evaluate every n-th kept increment, and the last. Default: 1.
    #[range(Range::COUNT)]
    pub every: Option<usize>,
    /// Write volumes for `ParaView`. Default: false.
    pub volume: Option<bool>,
    /// Fatigue limit in fully reversed torsion, amplitude [pressure], for Crossland and Dang Van.
    #[range(STRESS)]
    pub torsion_limit: Option<f64>,
    /// Fatigue limit in fully reversed tension or bending, amplitude [pressure], for Crossland and Dang Van.
    #[range(STRESS)]
    pub tension_limit: Option<f64>,
    /// Yield strength [pressure], for Fatemi and Socie.
    #[range(STRESS)]
    pub yield_strength: Option<f64>,
    /// Weight of the normal stress in Fatemi and Socie's parameter [-]. Default: 1.
    #[range(Range::NOT_NEGATIVE.words("must be zero or positive").help("0.3 to 1 for most metals"))]
    pub normal_stress_sensitivity: Option<f64>,
    /// Critical distance L [length]: fatigue parameters are also told at the depth L/2 (point method) and as means from the surface
    /// down to 2 L (line method).
    #[range(LENGTH)]
    pub critical_distance: Option<f64>,
}

/// Steady temperature rise by the friction of the last cycle.
#[derive(Table, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(super) struct ThermalFile {
    /// Cycles per unit of time; that of the conductivities, so that energy times frequency is their power.
    #[range(Range::POSITIVE.help("cycles per unit of time, as in the conductivities"))]
    pub frequency: f64,
}

/// Depths, or the word "auto".
#[derive(Debug, Clone, Table, JsonSchema)]
#[expected("a list of depths or \"auto\"")]
#[schemars(untagged, rename = "DepthsSchema", description = "")]
pub(super) enum DepthsFile {
    Given(Vec<f64>),
    Auto(AutoWord),
}

/// JSON Schema of the case file.
pub fn schema() -> serde_json::Value {
    schemars::schema_for!(CaseFile).to_value()
}
