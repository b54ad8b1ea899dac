//! The bodies of a case file as they are written: coatings, gradients, materials.

use schemars::JsonSchema;
use toml::de::DeValue;

use super::surface_file::ProfileFile;
use crate::document::{At, Range, Read, Reader, Reading, Table, Written};
use crate::kernel::sublayers::MOST_SUBLAYERS;
use crate::subsurface::fatigue::FatigueConstants;

/// A body: `rigid = true`, or coatings (outermost first) on a `substrate` or on `base = "rigid"`.
#[derive(Table, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(super) struct BodyFile {
    /// A body that does not deform.
    pub rigid: Option<At<bool>>,
    /// Coatings, outermost first.
    pub coatings: Option<At<Vec<At<CoatingFile>>>>,
    /// The elastic half-space under the coatings.
    pub substrate: Option<At<MaterialFile>>,
    /// What the coatings lie on when there is no substrate: "rigid".
    pub base: Option<At<BaseFile>>,
    /// Constants of what is rigid.
    #[table(flatten)]
    #[schemars(flatten)]
    pub constants: RigidConstantsFile,
    /// Shape of this body's surface: its distance from the plane of first touch.
    pub profile: Option<At<ProfileFile>>,
    /// Hardness of this body's surface [pressure]: the contact pressure does not exceed that of the softer surface, which yields there and keeps
    /// the plastic depth (elastic - perfectly plastic; about three times the yield strength). Default: it does not yield.
    #[range(HARDNESS)]
    pub hardness: Option<At<f64>>,
}

/// Conductivity or resistivity.
const CONDUCTIVITY: Range =
    Range::between(1e-100, 1e100, "must be positive and finite, between 1e-100 and 1e100");
/// A hardness.
const HARDNESS: Range = Range::POSITIVE
    .words("must be a positive finite pressure")
    .help("about three times the yield strength; leave it out of a surface that does not yield");
/// A wear coefficient.
pub(super) const COEFFICIENT: Range = Range::NOT_NEGATIVE.words("must be zero or positive and finite");

/// Constants of a rigid body, or of the rigid base of coatings.
#[derive(Table, JsonSchema)]
pub(super) struct RigidConstantsFile {
    /// Thermal conductivity [power/(length temperature)], positive; of what is rigid: the body, or the base of its coatings.
    #[range(CONDUCTIVITY)]
    pub thermal_conductivity: Option<At<f64>>,
    /// Electrical resistivity [resistance x length], positive; of what is rigid: the body, or the base of its coatings.
    #[range(CONDUCTIVITY)]
    pub electrical_resistivity: Option<At<f64>>,
    /// Wear coefficient [1/pressure], zero or positive, of a rigid body.
    #[range(COEFFICIENT)]
    pub wear_coefficient: Option<At<f64>>,
}

/// Constants of a coating or a substrate.
#[derive(Table, JsonSchema)]
pub(super) struct LayerConstantsFile {
    /// Constants for fatigue and fracture. Criteria without constants are skipped; there are no built-in materials.
    pub fatigue: Option<At<FatigueConstants>>,
    /// Thermal conductivity [power/(length temperature)], positive; of all layers of a body and its substrate, or of none.
    #[range(CONDUCTIVITY)]
    pub thermal_conductivity: Option<At<f64>>,
    /// Electrical resistivity [resistance x length], positive; of all layers of a body and its substrate, or of none.
    #[range(CONDUCTIVITY)]
    pub electrical_resistivity: Option<At<f64>>,
    /// Wear coefficient [1/pressure], zero or positive: wear depth = k times dissipated energy by area, or k times pressure times slip
    /// distance. Of all layers of a body and its substrate, or of none: then the body does not wear.
    #[range(COEFFICIENT)]
    pub wear_coefficient: Option<At<f64>>,
}

/// The one foundation that is not a substrate.
#[derive(Clone, Copy, Table, JsonSchema)]
#[schemars(rename_all = "lowercase")]
pub(super) enum BaseFile {
    /// A foundation that does not deform.
    Rigid,
}

/// A layer: uniform (`young`), or of a stiffness that changes with depth (`gradient`).
#[derive(Table, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(super) struct CoatingFile {
    /// Thickness [length], positive.
    pub thickness: At<f64>,
    /// Young's modulus [pressure], positive; instead of a gradient.
    pub young: Option<At<f64>>,
    /// Young's modulus over the depth; instead of `young`.
    pub gradient: Option<At<GradientFile>>,
    /// Poisson's ratio, above -1, at most 0.5; the same at every depth.
    pub poisson: At<f64>,
    /// How it is bonded to what lies below it: "bonded" (default), "frictionless" (no shear passes; only without friction on the
    /// surface), or springs of no thickness, `{ normal_stiffness, shear_stiffness }`. Linear: an interface does not open.
    pub interface: Option<At<InterfaceFile>>,
    /// Residual stress [pressure], tension positive: the same along x and y, or one along each; or rows of depth below the upper
    /// face [length] and stress (one, or along x and y), linear between them. It adds to the stresses below, and to nothing else.
    pub residual_stress: Option<At<ResidualFile>>,
    /// Constants of its material.
    #[table(flatten)]
    #[schemars(flatten)]
    pub constants: LayerConstantsFile,
}

/// How a coating is bonded to what lies below it.
#[derive(Debug, Clone, PartialEq, Table, JsonSchema)]
#[expected("\"bonded\", \"frictionless\" or { normal_stiffness = ..., shear_stiffness = ... }")]
#[schemars(untagged, rename = "InterfaceSchema", description = "")]
pub(super) enum InterfaceFile {
    Word(InterfaceWord),
    Springs(SpringsFile),
}

/// Interfaces that have a name.
#[derive(Debug, Clone, Copy, PartialEq, Table, JsonSchema)]
#[schemars(rename_all = "lowercase", description = "")]
pub(super) enum InterfaceWord {
    Bonded,
    Frictionless,
}

/// Springs of no thickness between a coating and what lies below it: displacement jumps by traction over stiffness.
#[derive(Debug, Clone, PartialEq, Table, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(super) struct SpringsFile {
    /// Normal stiffness [pressure/length], positive. Default: bonded along the normal.
    pub normal_stiffness: Option<f64>,
    /// Shear stiffness [pressure/length], the same in all directions; 0: no shear passes. Default: bonded against shear.
    pub shear_stiffness: Option<f64>,
}

/// Young's modulus over the depth of a coating: `young` at both faces and the `law` between them, or a `table`.
#[derive(Table, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(super) struct GradientFile {
    /// Young's modulus at the coating's surface and at its lower face [pressure], positive.
    pub young: Option<At<[f64; 2]>>,
    /// How it runs from one to the other.
    pub law: Option<At<LawFile>>,
    /// Rows of depth [length] and Young's modulus [pressure], depths rising from 0 to the thickness; linear between them.
    pub table: Option<At<Vec<[f64; 2]>>>,
    /// Number of uniform sublayers. Default: chosen such that the surface response changes by less than 1e-4.
    #[range(SUBLAYERS)]
    pub layers: Option<At<usize>>,
}

/// Sublayers of a coating.
const SUBLAYERS: Range = Range::between(1.0, MOST_SUBLAYERS as f64, "must lie between 1 and 4096")
    .help("leave it out: the number is then chosen by an error bound");

/// How Young's modulus runs over the depth.
#[derive(Debug, Clone, Copy, Table, JsonSchema)]
#[schemars(rename_all = "lowercase")]
pub(super) enum LawFile {
    /// By equal factors over equal depths.
    Exponential,
    /// By equal differences over equal depths.
    Linear,
}

/// An isotropic elastic material.
#[derive(Table, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(super) struct MaterialFile {
    /// Young's modulus [pressure], positive.
    pub young: At<f64>,
    /// Poisson's ratio, above -1, at most 0.5.
    pub poisson: At<f64>,
    /// Residual stress [pressure], as of a coating; below the last row of a table it stays as it is there.
    pub residual_stress: Option<At<ResidualFile>>,
    /// Constants of its material.
    #[table(flatten)]
    #[schemars(flatten)]
    pub constants: LayerConstantsFile,
}

/// A stress, the same along x and y; one along each; or rows of depth and of one or two stresses.
#[derive(Debug, Clone, PartialEq, JsonSchema)]
#[schemars(untagged, rename = "ResidualSchema", description = "")]
pub(super) enum ResidualFile {
    Even(f64),
    Axes([f64; 2]),
    Table(Vec<Vec<f64>>),
}

impl ResidualFile {
    /// Rows of depth and stress along x and y; one row at depth 0 where it does not change with depth.
    pub fn rows(&self) -> Vec<(f64, [f64; 2])> {
        match self {
            Self::Even(stress) => vec![(0.0, [*stress; 2])],
            Self::Axes(stress) => vec![(0.0, *stress)],
            Self::Table(rows) => rows.iter().map(|row| (row[0], [row[1], row[row.len() - 1]])).collect(),
        }
    }
}

/// A number, or a row of them.
#[derive(Table)]
#[expected("a number, or a row [depth, stress] or [depth, stress along x, along y]")]
enum Entry {
    Number(f64),
    Row(Vec<f64>),
}

impl Read for ResidualFile {
    const EXPECTED: &'static str = "a stress, two of them [along x, along y], or rows [[depth, stress], ...]";

    fn fits(value: &Written<'_>) -> bool {
        f64::fits(value) || Vec::<Entry>::fits(value)
    }

    fn read(value: &Written<'_>, reader: &mut Reader) -> Reading<Self> {
        if f64::fits(value) {
            return f64::read(value, reader).map(Self::Even).map_err(|_| None);
        }
        let DeValue::Array(list) = value.get_ref() else { return reader.wrong(value, Self::EXPECTED, None) };
        let entries: Vec<Entry> = reader.entries(list).map_err(|_: Option<Vec<Entry>>| None)?;
        if let [Entry::Number(x), Entry::Number(y)] = entries[..] {
            return Ok(Self::Axes([x, y]));
        }
        let row = |entry| match entry {
            Entry::Row(row) if (2..=3).contains(&row.len()) => Some(row),
            _ => None,
        };
        let rows: Vec<Vec<f64>> = entries.into_iter().filter_map(row).collect();
        if rows.is_empty() || rows.len() < list.len() {
            return reader.wrong_length(value, list.len(), Self::EXPECTED, None);
        }
        Ok(Self::Table(rows))
    }
}
