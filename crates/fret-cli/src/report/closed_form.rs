//! Which closed forms of the frictionless contact speak about a run, and what they say. They need a sphere, an ellipsoid, or a cylinder in
//! a line contact, on homogeneous bodies that do not tilt.

use fret_core::analytic::{EffectiveModuli, Hertz, HertzEllipse, HertzLine};
use fret_core::model::{Body, ContactPair};
use serde_json::Value;

use crate::results::Results;

/// Undeformed gaps whose contact has a closed form; radii [length].
#[derive(Debug, Clone, Copy)]
enum Shape {
    Sphere(f64),
    Ellipsoid([f64; 2]),
    /// In a line contact.
    Cylinder(f64),
}

/// The frictionless contact in closed form.
#[derive(Debug, Clone, Copy)]
pub struct NormalForm {
    shape: Shape,
    /// Moduli of the pair.
    pub moduli: EffectiveModuli,
    /// Depth of the datum of a line contact [length].
    pub datum: Option<f64>,
    /// Sum of `1/G` of the bodies that deform [1/pressure].
    pub shear_compliance: f64,
}

/// One load of the frictionless contact.
#[derive(Debug, Clone, Copy)]
pub enum Pressed {
    /// A sphere.
    Sphere(Hertz),
    /// An ellipsoid.
    Ellipsoid(HertzEllipse),
    /// A cylinder in a line contact, and its approach where it has a datum.
    Line(HertzLine, Option<f64>),
}

impl NormalForm {
    /// The closed form of a run, where it has one.
    pub fn of(results: &Results) -> Option<Self> {
        let wears = results.planned::<Value>("/case/wear").is_some_and(|wear| !wear.is_null());
        let stages: Vec<Value> = results.planned("/case/stages")?;
        let tilts = stages.iter().any(|stage| !stage["tilt"].is_null());
        if wears || tilts || results.planned::<bool>("/case/periodic")? {
            return None;
        }
        let bodies: ContactPair = results.planned("/case/bodies")?;
        let material = |body: &Body| match body {
            Body::Rigid => Some(None),
            Body::Elastic(half_space) => half_space.single_material().map(|material| Some(*material)),
        };
        let materials = [material(bodies.upper())?, material(bodies.lower())?];
        let shear_compliance =
            materials.iter().flatten().map(|material| 1.0 / material.shear_modulus()).sum();
        let moduli = match materials.into() {
            (None, Some(lower)) => EffectiveModuli::rigid_on(&lower),
            // Seen from below the coupling has the other sign; nothing here asks for its sign.
            (Some(upper), None) => EffectiveModuli::rigid_on(&upper),
            (Some(upper), Some(lower)) => EffectiveModuli::of_pair(&upper, &lower),
            (None, None) => return None,
        };
        let radius = |name: &str| lone_shape(results)?.pointer(name)?.as_f64();
        let ellipsoid =
            || Some(Shape::Ellipsoid([radius("/ellipsoid/radius_x")?, radius("/ellipsoid/radius_y")?]));
        let shape = if results.fields.is_line() {
            Shape::Cylinder(radius("/cylinder/radius")?)
        } else {
            radius("/sphere/radius").map(Shape::Sphere).or_else(ellipsoid)?
        };
        Some(Self { shape, moduli, datum: results.planned("/datum"), shear_compliance })
    }

    /// The contact under a normal force.
    pub fn under(&self, force: f64) -> Option<Pressed> {
        let modulus = self.moduli.normal;
        match self.shape {
            Shape::Sphere(radius) => Hertz::sphere(radius, force, modulus).ok().map(Pressed::Sphere),
            Shape::Ellipsoid(radii) => {
                HertzEllipse::ellipsoid(radii, force, modulus).ok().map(Pressed::Ellipsoid)
            }
            Shape::Cylinder(radius) => {
                let line = HertzLine::cylinder(radius, force, modulus).ok()?;
                let approach = |depth: f64| line.approach(depth, modulus, self.shear_compliance);
                Some(Pressed::Line(line, self.datum.map(approach)))
            }
        }
    }
}

impl Pressed {
    /// Pressure at a point.
    pub fn pressure(&self, x: f64, y: f64) -> f64 {
        match self {
            Self::Sphere(hertz) => hertz.pressure(x.hypot(y)),
            Self::Ellipsoid(hertz) => hertz.pressure(x, y),
            Self::Line(hertz, _) => hertz.pressure(x),
        }
    }

    /// Pressure in the middle.
    pub fn peak(&self) -> f64 {
        match self {
            Self::Sphere(hertz) => hertz.max_pressure,
            Self::Ellipsoid(hertz) => hertz.max_pressure,
            Self::Line(hertz, _) => hertz.max_pressure,
        }
    }

    /// Approach of distant points, of a line contact relative to its datum.
    pub fn approach(&self) -> Option<f64> {
        match self {
            Self::Sphere(hertz) => Some(hertz.approach),
            Self::Ellipsoid(hertz) => Some(hertz.approach),
            Self::Line(_, approach) => *approach,
        }
    }

    /// Area of contact, of a line contact per unit length.
    pub fn area(&self) -> f64 {
        let [a, b] = match self {
            Self::Sphere(hertz) => [hertz.contact_radius; 2],
            Self::Ellipsoid(hertz) => hertz.semi_axes,
            Self::Line(hertz, _) => return 2.0 * hertz.half_width,
        };
        std::f64::consts::PI * a * b
    }
}

/// The shape of the undeformed gap, where it is one and nothing else.
fn lone_shape(results: &Results) -> Option<Value> {
    let profile: Value = results.planned("/case/profile")?;
    let has_heights = profile["heights"].as_array().is_some_and(|heights| !heights.is_empty());
    match profile["shapes"].as_array().map(Vec::as_slice) {
        _ if has_heights => None,
        Some([shape]) => Some(shape.clone()),
        Some(_) => None,
        None => Some(profile),
    }
}
