//! The frictionless contact in closed form: about which cases one speaks, and what it says under a load. Refinement studies and reports ask
//! here.
//!
//! Spheres, ellipsoids, rounded and flat punches and cones, and cylinders in line contacts, on homogeneous half-spaces that do not tilt, do not
//! wear and whose surfaces stay where they are. Coupling of pressure and shear is not asked about: under it they neglect what friction does to the pressure.

use std::f64::consts::PI;

use super::radial_table::RadialTable;
use crate::analytic::{Cone, EffectiveModuli, FlatPunch, Hertz, HertzEllipse, HertzLine, RoundedPunch};
use crate::case::Case;
use crate::model::{Body, ContactPair, Control, Dimension, ElasticMaterial, Shape};
use crate::plan::Plan;

/// An undeformed gap whose contact has a closed form; curvatures [1/length].
#[derive(Debug, Clone, Copy)]
enum Gap {
    Paraboloid([f64; 2]),
    /// In a line contact.
    Cylinder(f64),
    Rounded {
        flat_radius: f64,
        edge_radius: f64,
    },
    Flat(f64),
    /// Of a cone, its slope.
    Cone(f64),
}

/// The frictionless contact in closed form.
#[derive(Debug, Clone, Copy)]
pub struct NormalForm {
    gap: Gap,
    /// Moduli of the pair.
    pub moduli: EffectiveModuli,
    /// Depth of the datum of a line contact [length].
    pub datum: Option<f64>,
    /// Sum of `1/G` of the bodies that deform [1/pressure].
    pub shear_compliance: f64,
    /// Whether Poisson's ratio vanishes in both bodies.
    pub without_poisson: bool,
}

/// One load of the frictionless contact.
#[derive(Debug, Clone, Copy)]
pub enum Pressed {
    /// A sphere.
    Sphere(Hertz),
    /// An ellipsoid.
    Ellipsoid(HertzEllipse),
    /// A flat punch with a rounded edge.
    Rounded(RoundedPunch),
    /// A flat punch.
    Flat(FlatPunch),
    /// A cone.
    Cone(Cone),
    /// A cylinder in a line contact, and its approach where it has a datum.
    Line(HertzLine, Option<f64>),
}

impl NormalForm {
    /// The closed form of a plan, where it has one: one that was made, or that of a record.
    pub fn of<M, H>(plan: &Plan<Case<M, H>>) -> Option<Self> {
        let case = &plan.case;
        let was_worn = plan.start.as_ref().is_some_and(|start| start.solved.state.worn_depth.is_some());
        let has_yielded = plan.start.as_ref().is_some_and(|start| start.solved.state.plastic_depth.is_some());
        let moves = case.kinematics.is_finite() || case.hardness.is_some() || has_yielded;
        let changes = case.wear.is_some() || was_worn || moves || case.tilts(0) || case.tilts(1);
        if changes || !case.periodic.is_none() || !case.beyond.is_body() {
            return None;
        }
        let materials: Vec<ElasticMaterial> = materials(&case.bodies)?.into_iter().flatten().collect();
        let moduli = match materials[..] {
            // Seen from below the coupling has the other sign; nothing here asks for its sign.
            [one] => EffectiveModuli::rigid_on(&one),
            [upper, lower] => EffectiveModuli::of_pair(&upper, &lower),
            _ => return None,
        };
        Some(Self {
            gap: Gap::of(case)?,
            moduli,
            datum: plan.datum,
            shear_compliance: materials.iter().map(|material| 1.0 / material.shear_modulus()).sum(),
            without_poisson: materials.iter().all(|material| material.poisson() == 0.0),
        })
    }

    /// Its name.
    pub fn name(&self) -> &'static str {
        match self.gap {
            Gap::Paraboloid(_) | Gap::Cylinder(_) => "Hertz",
            Gap::Rounded { .. } => "rounded punch",
            Gap::Flat(_) => "flat punch",
            Gap::Cone(_) => "cone",
        }
    }

    /// What it says under what is prescribed normally, where it can.
    pub fn under(&self, control: Control) -> Option<Pressed> {
        let modulus = self.moduli.normal;
        let force = control.force();
        match self.gap {
            Gap::Paraboloid([x, y]) => match control {
                Control::FarEnd(_) => None,
                Control::Motion(_) if !is_round([x, y]) => None,
                Control::Motion(approach) => {
                    Hertz::sphere_at_approach(x.recip(), approach, modulus).ok().map(Pressed::Sphere)
                }
                Control::Force(force) if is_round([x, y]) => {
                    Hertz::sphere(x.recip(), force, modulus).ok().map(Pressed::Sphere)
                }
                Control::Force(force) => HertzEllipse::ellipsoid([x.recip(), y.recip()], force, modulus)
                    .ok()
                    .map(Pressed::Ellipsoid),
            },
            Gap::Cylinder(curvature) => {
                let line = HertzLine::cylinder(curvature.recip(), force?, modulus).ok()?;
                let approach = |depth: f64| line.approach(depth, modulus, self.shear_compliance);
                Some(Pressed::Line(line, self.datum.map(approach)))
            }
            Gap::Rounded { flat_radius, edge_radius } => {
                RoundedPunch::new(flat_radius, edge_radius, force?, modulus).ok().map(Pressed::Rounded)
            }
            Gap::Flat(radius) => FlatPunch::new(radius, force?, modulus).ok().map(Pressed::Flat),
            Gap::Cone(slope) => Cone::new(slope, force?, modulus).ok().map(Pressed::Cone),
        }
    }
}

/// Materials of the upper and of the lower body, `None` of a rigid one; nothing where one is not homogeneous.
fn materials(bodies: &ContactPair) -> Option<[Option<ElasticMaterial>; 2]> {
    let material = |body: &Body| match body {
        Body::Rigid => Some(None),
        Body::Elastic(half_space) => half_space.single_material().map(|material| Some(*material)),
    };
    Some([material(bodies.upper())?, material(bodies.lower())?])
}

fn is_round([x, y]: [f64; 2]) -> bool {
    (x - y).abs() <= 1e-15 * x
}

impl Gap {
    fn of<M, H>(case: &Case<M, H>) -> Option<Self> {
        let profile = &case.profile;
        if !profile.heights.is_empty() {
            return None;
        }
        if profile.shapes.iter().all(|shape| shape.curvatures().is_some()) {
            let [x, y] = profile.curvatures();
            return match case.dimension() {
                Dimension::Line if x > 0.0 => Some(Self::Cylinder(x)),
                Dimension::Plane if x > 0.0 && y > 0.0 => Some(Self::Paraboloid([x, y])),
                _ => None,
            };
        }
        match profile.shapes[..] {
            _ if case.dimension() == Dimension::Line => None,
            [Shape::RoundedPunch { flat_radius, edge_radius }] => {
                Some(Self::Rounded { flat_radius, edge_radius })
            }
            [Shape::FlatPunch { radius }] => Some(Self::Flat(radius)),
            [Shape::Cone { slope }] => Some(Self::Cone(slope)),
            _ => None,
        }
    }
}

impl Pressed {
    /// Normal force [force], of a line contact per length.
    pub fn force(&self) -> f64 {
        match self {
            Self::Sphere(form) => form.force,
            Self::Ellipsoid(form) => form.force,
            Self::Rounded(form) => form.force,
            Self::Flat(form) => form.force,
            Self::Cone(form) => form.force,
            Self::Line(form, _) => form.line_force,
        }
    }

    /// Pressure at a point [pressure].
    pub fn pressure(&self, x: f64, y: f64) -> f64 {
        match self {
            Self::Sphere(form) => form.pressure(x.hypot(y)),
            Self::Ellipsoid(form) => form.pressure(x, y),
            Self::Rounded(form) => form.pressure(x.hypot(y)),
            Self::Flat(form) => form.pressure(x.hypot(y)),
            Self::Cone(form) => form.pressure(x.hypot(y)),
            Self::Line(form, _) => form.pressure(x),
        }
    }

    /// Pressure as a function of the place, for many places: what takes an integral comes from a table.
    pub fn pressure_everywhere(self) -> Box<dyn Fn(f64, f64) -> f64> {
        if let Self::Rounded(punch) = self {
            let table = RadialTable::new(punch.flat_radius(), punch.contact_radius, |r| punch.pressure(r));
            return Box::new(move |x: f64, y: f64| table.at(x.hypot(y)));
        }
        Box::new(move |x: f64, y: f64| self.pressure(x, y))
    }

    /// Largest pressure [pressure]; none where it is infinite, at an edge or a tip, or lies in no closed form, as that of a rounded punch
    /// near its edge.
    pub fn peak(&self) -> Option<f64> {
        match self {
            Self::Sphere(form) => Some(form.max_pressure),
            Self::Ellipsoid(form) => Some(form.max_pressure),
            Self::Line(form, _) => Some(form.max_pressure),
            Self::Rounded(_) | Self::Flat(_) | Self::Cone(_) => None,
        }
    }

    /// Approach of distant points [length], of a line contact relative to its datum.
    pub fn approach(&self) -> Option<f64> {
        match self {
            Self::Sphere(form) => Some(form.approach),
            Self::Ellipsoid(form) => Some(form.approach),
            Self::Rounded(form) => Some(form.approach),
            Self::Flat(form) => Some(form.approach),
            Self::Cone(form) => Some(form.approach),
            Self::Line(_, approach) => *approach,
        }
    }

    /// Area of contact [length^2], of a line contact its width [length].
    pub fn area(&self) -> f64 {
        let [a, b] = match self {
            Self::Sphere(form) => [form.contact_radius; 2],
            Self::Ellipsoid(form) => form.semi_axes,
            Self::Rounded(form) => [form.contact_radius; 2],
            Self::Flat(form) => [form.contact_radius; 2],
            Self::Cone(form) => [form.contact_radius; 2],
            Self::Line(form, _) => return 2.0 * form.half_width,
        };
        PI * a * b
    }
}
