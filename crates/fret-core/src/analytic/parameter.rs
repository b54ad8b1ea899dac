//! What closed forms ask for: the parameters that several of them share stand here once.

use serde::Serialize;

/// Something that a closed form asks for.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct Parameter {
    /// Its name.
    pub name: &'static str,
    /// What it is.
    pub kind: Kind,
    /// Its meaning with its unit, a sentence.
    pub meaning: &'static str,
}

/// What a parameter is, and by which numbers it is given.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// A number.
    Number,
    /// A number that is 0 unless it is given.
    NumberOrZero,
    /// A frictionless contact of a sphere: radius, force and effective modulus of [`Hertz`](super::Hertz).
    Sphere,
    /// A frictionless contact of a cylinder: radius, force per length and effective modulus of [`HertzLine`](super::HertzLine).
    Cylinder,
    /// A material: Young's modulus and Poisson's ratio.
    Material,
    /// A material, or nothing for a rigid body.
    MaterialOrRigid,
    /// A layer on a rigid base: Young's modulus, Poisson's ratio and thickness.
    Layer,
}

/// A number.
pub(super) const fn number(name: &'static str, meaning: &'static str) -> Parameter {
    Parameter { name, kind: Kind::Number, meaning }
}

const fn of(kind: Kind, name: &'static str, meaning: &'static str) -> Parameter {
    Parameter { name, kind, meaning }
}

pub(super) const FORCE: Parameter = number("force", "Normal force, positive in compression [force].");
pub(super) const LINE_FORCE: Parameter =
    number("line_force", "Normal force per unit of length [force/length].");
pub(super) const TANGENTIAL_FORCE: Parameter =
    number("tangential_force", "Tangential force [force], at most friction times normal force.");
pub(super) const MODULUS: Parameter =
    number("modulus", "Effective modulus E* [pressure]: ``effective_moduli(...).normal``.");
pub(super) const SHEAR_MODULUS: Parameter =
    number("shear_modulus", "Effective shear modulus G* [pressure]: ``effective_moduli(...).shear``.");
pub(super) const COUPLING: Parameter =
    number("coupling", "Dundurs' beta [-]: ``effective_moduli(...).coupling``.");
pub(super) const FRICTION: Parameter = number("friction_coefficient", "Coefficient of friction [-].");
pub(super) const RADIUS: Parameter = number("radius", "Relative radius of curvature R [length].");
pub(super) const PUNCH_RADIUS: Parameter = number("radius", "Radius of the punch [length].");
pub(super) const STRAIN: Parameter =
    number("strain", "Strain of the lower surface less that of the upper one [-].");
pub(super) const TILT: Parameter = number("tilt", "Slope of the punch against the surface [-].");
pub(super) const SPHERE: Parameter = of(Kind::Sphere, "sphere", "Normal contact, of :func:`hertz`.");
pub(super) const CYLINDER: Parameter =
    of(Kind::Cylinder, "cylinder", "Normal contact, of :func:`hertz_line`.");
pub(super) const LAYER: Parameter = of(
    Kind::Layer,
    "layer",
    r#"``{"young": ..., "poisson": ..., "thickness": ...}`` of the layer [pressure, -, length]."#,
);
pub(super) const LOWER: Parameter =
    of(Kind::Material, "lower", r#"``{"young": ..., "poisson": ...}`` of the lower body [pressure, -]."#);
pub(super) const UPPER: Parameter =
    of(Kind::MaterialOrRigid, "upper", "The same of the upper body. Default: rigid.");
pub(super) const STRAIN_OR_NONE: Parameter = of(
    Kind::NumberOrZero,
    "strain",
    "Strain of the lower surface less that of the upper one [-]: ``sigma (1 - nu^2)/E`` under a tension of the lower body.",
);
