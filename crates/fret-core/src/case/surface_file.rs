//! Surfaces and friction as they are written in a case file: unchecked, with the place of every value. The doc comments here
//! are the schema's descriptions.

use std::borrow::Cow;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};

use crate::document::{At, Named, Range, Table};
use crate::model::{Axis, Detrend, EvolutionDriver, Side};
use crate::topography::TreatmentFile;

/// A length of a shape.
pub(super) const LENGTH: Range = Range::POSITIVE.words("must be a positive finite length");
/// A number of a shape or of a law.
const NUMBER: Range = Range::POSITIVE.words("must be a positive finite number");
/// Angle between the axis of an indenter and its sides.
const ANGLE: Range = Range::between(1.0, 89.9, "must lie between 1 and 89.9 degrees");
/// Cycles that a simulated one may stand for.
pub(super) const JUMP: Range = Range::between(1.0, 1e6, "must lie between 1 and 1000000");
/// Words for a part of a whole.
pub(super) const UP_TO_1: &str = "must lie above 0, and at 1 at the most";

/// Shape of the undeformed gap, or of one body; the sum when several are given.
#[derive(Table, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(super) struct ProfileFile {
    /// A sphere, as the paraboloid r^2 / (2 R).
    pub sphere: Option<At<SphereFile>>,
    /// A paraboloid with two radii of curvature.
    pub ellipsoid: Option<At<EllipsoidFile>>,
    /// A cylinder, as the parabola s^2 / (2 R) across its axis.
    pub cylinder: Option<At<CylinderFile>>,
    /// A flat punch with a rounded edge: flat within b, (r - b)^2 / (2 R) beyond.
    pub rounded_punch: Option<At<RoundedPunchFile>>,
    /// A flat circular punch.
    pub flat_punch: Option<At<FlatPunchFile>>,
    /// A blunt cone, slope r.
    pub cone: Option<At<ConeFile>>,
    /// A cone with a spherical tip: r^2 / (2 R) up to the radius R slope, slope (r - R slope / 2) beyond.
    pub sphero_cone: Option<At<SpheroConeFile>>,
    /// A worn or truncated sphere: flat within b, (r^2 - b^2) / (2 R) beyond.
    pub worn_sphere: Option<At<WornSphereFile>>,
    /// A pyramid, tip first: an indenter by its angle.
    pub pyramid: Option<At<PyramidFile>>,
    /// A rectangular flat punch, with sharp or rounded edges.
    pub rectangular_punch: Option<At<RectangularPunchFile>>,
    /// A roller of finite length with a crown along its axis.
    pub crowned_roller: Option<At<CrownedRollerFile>>,
    /// A sinusoidal surface amplitude (1 - cos(2 pi x / Lx) cos(2 pi y / Ly)).
    pub wave: Option<At<WaveFile>>,
    /// A formula: an expression of x and y.
    pub formula: Option<At<FormulaFile>>,
    /// Measured or synthetic topography, one height per cell.
    pub heights: Option<At<HeightsFile>>,
}

/// A sphere.
#[derive(Table, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(super) struct SphereFile {
    /// Radius [length], positive; in a body's own profile negative for a hollow.
    pub radius: At<f64>,
}

/// An ellipsoid.
#[derive(Table, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(super) struct EllipsoidFile {
    /// Radius of curvature in the x-z plane [length], positive; in a body's own profile negative for a hollow.
    pub radius_x: At<f64>,
    /// Radius of curvature in the y-z plane [length], positive; in a body's own profile negative for a hollow.
    pub radius_y: At<f64>,
}

/// A cylinder.
#[derive(Table, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(super) struct CylinderFile {
    /// Radius [length], positive; in a body's own profile negative for a groove.
    pub radius: At<f64>,
    /// Direction of its axis.
    pub axis: Axis,
    /// Length along the axis [length], positive, with square ends. Default: infinite.
    #[range(LENGTH)]
    pub length: Option<f64>,
}

/// A flat punch with a rounded edge.
#[derive(Clone, Copy, Table, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(super) struct RoundedPunchFile {
    /// Radius of the flat [length], positive.
    #[range(LENGTH)]
    pub flat_radius: f64,
    /// Radius of the rounding [length], positive.
    #[range(LENGTH)]
    pub edge_radius: f64,
}

/// A flat circular punch.
#[derive(Table, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(super) struct FlatPunchFile {
    /// Radius [length], positive; no body beyond it.
    #[range(LENGTH)]
    pub radius: f64,
}

/// A blunt cone.
#[derive(Table, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(super) struct ConeFile {
    /// Slope of its side against the surface, positive: the tangent of the angle between them.
    #[range(NUMBER)]
    pub slope: f64,
}

/// A cone with a spherical tip.
#[derive(Clone, Copy, Table, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(super) struct SpheroConeFile {
    /// Radius of the tip [length], positive.
    #[range(LENGTH)]
    pub radius: f64,
    /// Slope of the side against the surface, positive: the tangent of the angle between them.
    #[range(NUMBER)]
    pub slope: f64,
}

/// A worn or truncated sphere.
#[derive(Clone, Copy, Table, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(super) struct WornSphereFile {
    /// Radius of the sphere [length], positive.
    #[range(LENGTH)]
    pub radius: f64,
    /// Radius of the flat [length], positive.
    #[range(LENGTH)]
    pub flat_radius: f64,
}

/// An indenter with plane sides.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Table, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(super) enum IndenterFile {
    /// Three sides, 65.27 degrees between axis and side.
    Berkovich,
    /// Four sides, 68 degrees between axis and side (136 between opposite ones).
    Vickers,
    /// Three sides, 35.264 degrees: the corner of a cube.
    CubeCorner,
}

/// A pyramid.
#[derive(Clone, Copy, Table, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(super) struct PyramidFile {
    /// A three-sided Berkovich indenter (65.27 degrees), a four-sided Vickers (68 degrees), or the corner of a cube (three sides, 35.264
    /// degrees). The first side faces x.
    pub indenter: IndenterFile,
    /// Angle between the axis and a side [degrees], in place of that of the indenter.
    #[range(ANGLE)]
    pub half_angle: Option<f64>,
}

/// A rectangular flat punch.
#[derive(Clone, Copy, Table, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(super) struct RectangularPunchFile {
    /// Length of the flat along x [length], positive.
    #[range(LENGTH)]
    pub length_x: f64,
    /// Length of the flat along y [length], positive.
    #[range(LENGTH)]
    pub length_y: f64,
    /// Radius of the rounding around the flat [length], positive. Default: sharp edges, no body beyond.
    #[range(LENGTH)]
    pub edge_radius: Option<f64>,
}

/// A crowned roller.
#[derive(Clone, Copy, Table, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(super) struct CrownedRollerFile {
    /// Radius [length], positive.
    #[range(LENGTH)]
    pub radius: f64,
    /// Direction of its axis.
    pub axis: Axis,
    /// Length along the axis [length], positive, with square ends.
    #[range(LENGTH)]
    pub length: f64,
    /// Radius of the crown along the axis [length], positive.
    #[range(LENGTH)]
    pub crown_radius: f64,
    /// Length of the straight middle [length]. Default: none, crowned from the middle on.
    #[range(LENGTH)]
    pub flat_length: Option<f64>,
}

/// A sinusoidal surface.
#[derive(Clone, Copy, Table, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(super) struct WaveFile {
    /// Half of the height from valley to crest [length], positive.
    #[range(LENGTH)]
    pub amplitude: f64,
    /// Wavelength along x [length]. Default: constant along x.
    #[range(LENGTH)]
    pub wavelength_x: Option<f64>,
    /// Wavelength along y [length]. Default: constant along y.
    #[range(LENGTH)]
    pub wavelength_y: Option<f64>,
}

/// A surface by a formula.
#[derive(Table, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(super) struct FormulaFile {
    /// The gap [length], in a body's own profile the distance of its surface from the plane of first touch, as an expression of x and y
    /// [length], counted from the middle of the grid, and of the parameters: "(x^2 + y^2)/(2*R)". Operators + - * / ^, parentheses, pi, and
    /// the functions abs, sqrt, exp, ln, log10, sin, cos, tan, asin, acos, atan, sinh, cosh, tanh, min, max, hypot, mod. It may be
    /// lowest anywhere: the gap is counted from where it touches first.
    pub expression: At<String>,
    /// Numbers that the expression names, each a finite number: { R = 10e-3 }.
    pub parameters: Option<Named<f64>>,
}

/// Topography, one height per cell or a scan that is resampled: `file` or `values`.
#[derive(Table, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(super) struct HeightsFile {
    /// A .npy file, a text file with one row of numbers per line or one point x, y, height, or a file of an instrument (sur, x3p, plu, opd,
    /// al3d, ...; with `pip install 'fretting[instruments]'`). Relative paths start at the case file.
    pub file: Option<At<String>>,
    /// The heights themselves, as rows of numbers, or in a line contact numbers; from Python an array.
    pub values: Option<At<ArrayFile>>,
    /// Length of one unit of the heights, in the case's unit of length. Default: 1.
    #[range(LENGTH)]
    pub unit: Option<f64>,
    /// What the heights describe: a "surface" (the highest point touches first) or the "gap" (the lowest does). Default: "surface".
    pub of: Option<At<OfFile>>,
    /// What is subtracted: "none", the "mean", or the least-squares "plane". Default: "none".
    pub detrend: Option<Detrend>,
    /// Axis along which the rows follow one another: "x" (index [i, j] = [x, y]) or "y" (rows of an image). Default: "x".
    pub rows: Option<Axis>,
    /// What is done to measured points.
    #[table(flatten)]
    #[schemars(flatten)]
    pub treatment: TreatmentFile,
}

/// What heights describe.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Table, JsonSchema)]
#[schemars(rename_all = "lowercase")]
pub(super) enum OfFile {
    /// A surface, positive towards the other body: the highest point touches first.
    Surface,
    /// The gap between the bodies: the lowest point touches first.
    Gap,
}

/// Coulomb's law of friction, with a shear strength of the interface where it has one.
#[derive(Table, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(super) struct FrictionFile {
    /// Coefficient, zero or positive.
    pub coefficient: Option<At<f64>>,
    /// One coefficient per cell: a .npy or text file, rows of numbers, or from Python an array; index [i, j] = [x, y].
    pub map: Option<At<MapFile>>,
    /// Shear strength of the interface [pressure], zero or positive, a number or one for every cell: shear is at most the smaller of it
    /// and the coefficient times the pressure. Default: none.
    pub max_shear: Option<At<CoefficientFile>>,
    /// The body that a map belongs to, and whose places remember what friction that evolves follows: it moves with that where
    /// `kinematics.displacement = "finite"`. Default: "lower".
    pub moves_with: Option<At<Side>>,
    /// Friction that evolves: how the coefficient of each cell follows what slip has done to it. Default: it stays.
    pub evolution: Option<At<EvolutionFile>>,
}

/// Friction that evolves: the coefficient of each cell follows what slip has done to it, from `coefficient` or `map` on. It changes after
/// each simulated cycle, and at the end of a stage without cycles.
#[derive(Table, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(super) struct EvolutionFile {
    /// What the coefficient follows: the energy dissipated in the cell by area [pressure x length], the slip distance of the cell
    /// [length], or the number of cycles.
    pub by: EvolutionDriver,
    /// Coefficient it tends to, positive: coefficient = last + (first - last) exp(-driver / scale).
    #[range(NUMBER)]
    pub last: Option<f64>,
    /// Scale of the exponential, positive, in the unit of what the coefficient follows.
    #[range(NUMBER)]
    pub scale: Option<f64>,
    /// Instead of `last` and `scale`: rows of driver and coefficient, the first at 0 with `friction.coefficient`; linear between them,
    /// constant beyond the last.
    pub table: Option<At<Vec<[f64; 2]>>>,
    /// Maximum cycle jump: number of cycles one simulated cycle may represent. Default: 1.
    #[range(JUMP)]
    pub every: Option<usize>,
    /// Maximum change of the coefficient of a cell per cycle jump. Default: 0.01.
    #[range(Range::up_to(1.0, UP_TO_1).help("0.01 serves most purposes"))]
    pub tolerance: Option<f64>,
}

/// A row of numbers; a number alone is a row of one.
#[derive(Debug, Clone, PartialEq, Table)]
#[expected("a row of numbers, or in a line contact a number")]
pub(super) enum Row {
    Numbers(Vec<f64>),
    One(f64),
}

impl Row {
    /// Its numbers.
    pub fn numbers(&self) -> &[f64] {
        match self {
            Self::Numbers(numbers) => numbers,
            Self::One(number) => std::slice::from_ref(number),
        }
    }
}

/// An array handed over beside the case.
#[derive(Debug, Clone, PartialEq, Table)]
pub(super) struct Handed {
    /// Its number.
    pub array: usize,
}

/// An array: rows of numbers, or one that was handed over.
#[derive(Debug, Clone, PartialEq, Table)]
#[expected("rows of numbers")]
pub(super) enum ArrayFile {
    Rows(Vec<Row>),
    Handed(Handed),
}

/// A number for every cell: the name of a file, or an array.
#[derive(Debug, Clone, PartialEq, Table)]
#[expected("the name of a file or rows of numbers")]
pub(super) enum MapFile {
    File(String),
    Array(ArrayFile),
}

/// One number, or one for every cell.
#[derive(Debug, Clone, PartialEq, Table)]
#[expected("a coefficient, the name of a file, or rows of numbers")]
pub(super) enum CoefficientFile {
    Uniform(f64),
    Map(MapFile),
}

/// Schemas of what can be an array, which no schema says of an array of NumPy.
macro_rules! schema {
    ($($kind:ident: $schema:expr;)*) => {$(
        impl JsonSchema for $kind {
            fn schema_name() -> Cow<'static, str> {
                stringify!($kind).into()
            }

            fn json_schema(_: &mut SchemaGenerator) -> Schema {
                $schema
            }
        }
    )*};
}

schema! {
    ArrayFile: rows();
    MapFile: json_schema!({ "anyOf": [{ "type": "string" }, rows()] });
    CoefficientFile: json_schema!({ "anyOf": [{ "type": "number" }, { "type": "string" }, rows()] });
}

fn rows() -> Schema {
    let row = json_schema!({ "type": "array", "items": { "type": "number" } });
    json_schema!({ "type": "array", "items": { "anyOf": [row, { "type": "number" }] } })
}
