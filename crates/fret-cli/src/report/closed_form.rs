//! Which closed forms speak about a run, and what they say. They need a sphere, an ellipsoid, or a cylinder in a line contact, on
//! homogeneous bodies; those of
//! friction a sphere, one coefficient for all stages, one line of force, a normal force that stays, bodies whose pressure and shear
//! do not act on each other, and a contact that sticks somewhere.

use fret_core::analytic::{EffectiveModuli, Hertz, HertzEllipse, HertzLine, TangentialHistory};
use fret_core::model::{Body, ContactPair};
use serde_json::Value;

use crate::results::Results;

/// Share of the largest load below which a change of the load, or a load across, is none.
const STEADY: f64 = 1e-4;

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
    datum: Option<f64>,
    /// Sum of `1/G` of the bodies that deform [1/pressure].
    shear_compliance: f64,
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
        if wears || results.planned::<bool>("/case/periodic")? {
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

/// Partial slip in closed form along the history of a run.
#[derive(Debug)]
pub struct TangentialForm {
    /// After each increment, as long as the closed form can follow.
    after: Vec<Option<TangentialHistory>>,
}

impl TangentialForm {
    /// The closed form of a run whose tangential force acts along `direction`, where it has one.
    pub fn of(results: &Results, normal: &NormalForm, direction: [f64; 2]) -> Option<Self> {
        let Shape::Sphere(radius) = normal.shape else { return None };
        let friction: f64 = results.planned("/case/friction/coefficient/uniform")?;
        if results.planned::<Value>("/case/friction/max_shear").is_some() {
            return None;
        }
        let stages: Vec<Value> = results.planned("/case/stages")?;
        let other_friction = stages.iter().any(|stage| !stage["friction"].is_null());
        if other_friction || results.planned::<String>("/coupling")? == "coupled" {
            return None;
        }
        let table = &results.table;
        let [along, across] = components(results, direction);
        let largest = along.iter().fold(0.0, |most: f64, force| most.max(force.abs()));
        let is_twisted = table.column("twist").iter().any(|twist| *twist != 0.0);
        if is_twisted || across.iter().any(|force| force.abs() > STEADY * largest) {
            return None;
        }
        let forces = table.column("normal_force");
        let start = along.iter().position(|force| force.abs() > STEADY * largest)?;
        let pressed = forces[start];
        let hertz = Hertz::sphere(radius, pressed, normal.moduli.normal).ok()?;
        let mut history = TangentialHistory::new(&hertz, friction, normal.moduli.shear).ok()?;
        let mut after = vec![None; start];
        let slides =
            |row: usize| results.table.regimes().get(row).is_some_and(|regime| regime == "gross_slip");
        for (row, (force, tangential)) in forces.iter().zip(&along).enumerate().skip(start) {
            let is_steady = (force - pressed).abs() <= STEADY * pressed;
            // At the onset of sliding the shift is no longer a matter of the force.
            let holds = tangential.abs() < friction * pressed * (1.0 - 1e-6);
            if !is_steady || !holds || slides(row) || history.push(*tangential).is_err() {
                break;
            }
            after.push(Some(history.clone()));
        }
        let rows = table.rows();
        let any = after.iter().any(Option::is_some);
        after.resize(rows, None);
        any.then_some(Self { after })
    }

    /// The closed form after an increment.
    pub fn after(&self, increment: usize) -> Option<&TangentialHistory> {
        self.after.get(increment)?.as_ref()
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

/// Tangential force of every increment along a direction and across it.
pub fn components(results: &Results, [cosine, sine]: [f64; 2]) -> [Vec<f64>; 2] {
    let table = &results.table;
    let forces = || table.column("tangential_force_x").iter().zip(table.column("tangential_force_y"));
    [
        forces().map(|(x, y)| cosine * x + sine * y).collect(),
        forces().map(|(x, y)| cosine * y - sine * x).collect(),
    ]
}
