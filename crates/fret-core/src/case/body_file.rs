//! The bodies of a case file as they are written: coatings, gradients, materials.

use schemars::JsonSchema;
use serde::Deserialize;
use toml::Spanned;

use super::interface_file::{InterfaceFile, InterfaceSchema};
use super::pair::Pair;
use super::residual_file::{ResidualFile, ResidualSchema};
use super::surface_file::ProfileFile;
use crate::subsurface::fatigue::FatigueConstants;

/// Constants of a layer, each with its place.
pub(super) type ConstantsFile = FatigueConstants<Spanned<f64>>;

/// A body: `rigid = true`, or coatings (outermost first) on a `substrate` or on `base = "rigid"`.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct BodyFile {
    /// A body that does not deform.
    #[schemars(with = "Option<bool>")]
    pub rigid: Option<Spanned<bool>>,
    /// Coatings, outermost first.
    #[schemars(with = "Option<Vec<CoatingFile>>")]
    pub coatings: Option<Spanned<Vec<Spanned<CoatingFile>>>>,
    /// The elastic half-space under the coatings.
    #[schemars(with = "Option<MaterialFile>")]
    pub substrate: Option<Spanned<MaterialFile>>,
    /// What the coatings lie on when there is no substrate: "rigid".
    #[schemars(with = "Option<BaseFile>")]
    pub base: Option<Spanned<BaseFile>>,
    /// Thermal conductivity [power/(length temperature)], positive; of what is rigid: the body, or the base of its coatings.
    #[schemars(with = "Option<f64>")]
    pub thermal_conductivity: Option<Spanned<f64>>,
    /// Electrical resistivity [resistance x length], positive; of what is rigid: the body, or the base of its coatings.
    #[schemars(with = "Option<f64>")]
    pub electrical_resistivity: Option<Spanned<f64>>,
    /// Wear coefficient [1/pressure], zero or positive, of a rigid body.
    #[schemars(with = "Option<f64>")]
    pub wear_coefficient: Option<Spanned<f64>>,
    /// Shape of this body's surface: its distance from the plane of first touch.
    #[schemars(with = "Option<ProfileFile>")]
    pub profile: Option<Spanned<ProfileFile>>,
}

/// The one foundation that is not a substrate.
#[derive(Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(super) enum BaseFile {
    /// A foundation that does not deform.
    Rigid,
}

/// A layer: uniform (`young`), or of a stiffness that changes with depth (`gradient`).
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct CoatingFile {
    /// Thickness [length], positive.
    #[schemars(with = "f64")]
    pub thickness: Spanned<f64>,
    /// Young's modulus [pressure], positive; instead of a gradient.
    #[schemars(with = "Option<f64>")]
    pub young: Option<Spanned<f64>>,
    /// Young's modulus over the depth; instead of `young`.
    #[schemars(with = "Option<GradientFile>")]
    pub gradient: Option<Spanned<GradientFile>>,
    /// Poisson's ratio, above -1, at most 0.5; the same at every depth.
    #[schemars(with = "f64")]
    pub poisson: Spanned<f64>,
    /// How it is bonded to what lies below it: "bonded" (default), "frictionless" (no shear passes; only without friction on the
    /// surface), or springs of no thickness, `{ normal_stiffness, shear_stiffness }`. Linear: an interface does not open.
    #[schemars(with = "Option<InterfaceSchema>")]
    pub interface: Option<Spanned<InterfaceFile>>,
    /// Residual stress [pressure], tension positive: the same along x and y, or one along each; or rows of depth below the upper
    /// face [length] and stress (one, or along x and y), linear between them. It adds to the stresses below, and to nothing else.
    #[schemars(with = "Option<ResidualSchema>")]
    pub residual_stress: Option<Spanned<ResidualFile>>,
    /// Constants for fatigue and fracture. Criteria without constants are skipped; there are no built-in materials.
    #[schemars(with = "Option<FatigueConstants>")]
    pub fatigue: Option<Spanned<ConstantsFile>>,
    /// Thermal conductivity [power/(length temperature)], positive; of all layers of a body and its substrate, or of none.
    #[schemars(with = "Option<f64>")]
    pub thermal_conductivity: Option<Spanned<f64>>,
    /// Electrical resistivity [resistance x length], positive; of all layers of a body and its substrate, or of none.
    #[schemars(with = "Option<f64>")]
    pub electrical_resistivity: Option<Spanned<f64>>,
    /// Wear coefficient [1/pressure], zero or positive: wear depth = k times dissipated energy by area, or k times pressure times slip
    /// distance. Of all layers of a body and its substrate, or of none: then the body does not wear.
    #[schemars(with = "Option<f64>")]
    pub wear_coefficient: Option<Spanned<f64>>,
}

/// Young's modulus over the depth of a coating: `young` at both faces and the `law` between them, or a `table`.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct GradientFile {
    /// Young's modulus at the coating's surface and at its lower face [pressure], positive.
    #[schemars(with = "Option<[f64; 2]>")]
    pub young: Option<Spanned<Pair<f64>>>,
    /// How it runs from one to the other.
    #[schemars(with = "Option<LawFile>")]
    pub law: Option<Spanned<LawFile>>,
    /// Rows of depth [length] and Young's modulus [pressure], depths rising from 0 to the thickness; linear between them.
    #[schemars(with = "Option<Vec<[f64; 2]>>")]
    pub table: Option<Spanned<Vec<Pair<f64>>>>,
    /// Number of uniform sublayers. Default: chosen such that the surface response changes by less than 1e-4.
    #[schemars(with = "Option<usize>")]
    pub layers: Option<Spanned<usize>>,
}

/// How Young's modulus runs over the depth.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(super) enum LawFile {
    /// By equal factors over equal depths.
    Exponential,
    /// By equal differences over equal depths.
    Linear,
}

/// An isotropic elastic material.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct MaterialFile {
    /// Young's modulus [pressure], positive.
    #[schemars(with = "f64")]
    pub young: Spanned<f64>,
    /// Poisson's ratio, above -1, at most 0.5.
    #[schemars(with = "f64")]
    pub poisson: Spanned<f64>,
    /// Residual stress, as of a coating; below the last row of a table it stays as it is there.
    #[schemars(with = "Option<ResidualSchema>")]
    pub residual_stress: Option<Spanned<ResidualFile>>,
    /// Constants for fatigue and fracture. Criteria without constants are skipped; there are no built-in materials.
    #[schemars(with = "Option<FatigueConstants>")]
    pub fatigue: Option<Spanned<ConstantsFile>>,
    /// Thermal conductivity [power/(length temperature)], positive; of all layers of a body and its substrate, or of none.
    #[schemars(with = "Option<f64>")]
    pub thermal_conductivity: Option<Spanned<f64>>,
    /// Electrical resistivity [resistance x length], positive; of all layers of a body and its substrate, or of none.
    #[schemars(with = "Option<f64>")]
    pub electrical_resistivity: Option<Spanned<f64>>,
    /// Wear coefficient [1/pressure], zero or positive: wear depth = k times dissipated energy by area, or k times pressure times slip
    /// distance. Of all layers of a body and its substrate, or of none: then the body does not wear.
    #[schemars(with = "Option<f64>")]
    pub wear_coefficient: Option<Spanned<f64>>,
}
