//! Which closed form speaks about a scene, recognised from its plan, and what it says at the end of each stage.
//!
//! Normal: spheres, ellipsoids, rounded and flat punches, cones on homogeneous bodies that are frictionless or do not couple.
//! Cylinders in line contacts likewise, with Cattaneo for forces along one axis and any Poisson's ratio.
//! Tangential: Cattaneo and Mindlin with Masing's memory, for spheres under a steady normal force, one coefficient of friction, forces along one line, and like bodies with a
//! Poisson's ratio of zero: with any other the form neglects the slip across the force, and is no measure of a hundredth of a
//! percent.

use std::f64::consts::PI;

use super::line_form::{LinePressed, at_datum};
use super::quantities::Quantity;
use super::radial_table::RadialTable;
use crate::analytic::{
    Cone, EffectiveModuli, FlatPunch, Hertz, HertzEllipse, LineHistory, RoundedPunch, TangentialHistory,
};
use crate::case::Stage;
use crate::model::{Body, CellValues, Control, ElasticMaterial, LoadStep, Shape};
use crate::plan::{Coupling, Plan};

/// What a closed form says of one stage's end; `None` where it says nothing.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Said([Option<[f64; 2]>; 6]);

impl Said {
    /// A quantity of interest, scalars first.
    pub fn of(&self, quantity: Quantity) -> Option<[f64; 2]> {
        self.0[quantity as usize]
    }

    fn say(&mut self, quantity: Quantity, value: f64) {
        self.0[quantity as usize] = Some([value, 0.0]);
    }
}

/// The contact of a shape without friction.
#[derive(Debug, Clone, Copy)]
enum Pressed {
    Sphere(Hertz),
    Ellipsoid(HertzEllipse),
    Rounded(RoundedPunch),
    Flat(FlatPunch),
    Cone(Cone),
    Line(LinePressed),
}

/// Exact answers to a scene.
#[derive(Debug, Clone)]
pub struct ClosedForm {
    name: &'static str,
    ends: Vec<Said>,
    last: Option<Pressed>,
    /// Shear at the end: the history and the direction of the force.
    shear: Option<(Slipped, [f64; 2])>,
}

/// Partial slip at the end of a history.
#[derive(Debug, Clone)]
enum Slipped {
    Sphere(TangentialHistory),
    Line(LineHistory),
}

impl ClosedForm {
    /// The closed form of a plan, where it has one.
    pub fn of(plan: &Plan) -> Option<Self> {
        let case = &plan.case;
        let tilts = case.tilts(0) || case.tilts(1);
        let changes = case.wear.is_some() || case.is_open_ended() || tilts;
        if case.periodic || !case.beyond.is_body() || changes || plan.coupling == Coupling::Coupled {
            return None;
        }
        let moduli = moduli(plan)?;
        let at_ends = loads_at_ends(&case.stages);
        let pressed_by = |load: &LoadStep| {
            if case.is_line() {
                LinePressed::by(plan, load.normal, moduli.normal).map(Pressed::Line)
            } else {
                pressed_by(plan, load.normal, moduli.normal)
            }
        };
        let pressed: Vec<Pressed> = at_ends.iter().map(pressed_by).collect::<Option<_>>()?;
        let mut ends: Vec<Said> = pressed.iter().map(Pressed::says).collect();
        let shear = if case.is_frictionless() || !has_tangential(&case.stages) {
            none_tangential(&mut ends);
            None
        } else {
            tangential(plan, &pressed, &moduli, &mut ends)
        };
        let name = match (&pressed.last()?, shear.is_some()) {
            (Pressed::Sphere(_), true) => "Hertz; Cattaneo and Mindlin",
            (Pressed::Line(_), true) => "Hertz; Cattaneo",
            (Pressed::Sphere(_) | Pressed::Ellipsoid(_) | Pressed::Line(_), _) => "Hertz",
            (Pressed::Rounded(_), _) => "rounded punch",
            (Pressed::Flat(_), _) => "flat punch",
            (Pressed::Cone(_), _) => "cone",
        };
        Some(Self { name, ends, last: pressed.last().copied(), shear })
    }

    /// Its name.
    pub fn name(&self) -> &'static str {
        self.name
    }

    /// What it says at the end of each stage.
    pub fn ends(&self) -> &[Said] {
        &self.ends
    }

    /// Pressure at a point at the end of the history [pressure].
    pub fn pressure(&self, x: f64, y: f64) -> f64 {
        let r = x.hypot(y);
        match &self.last {
            Some(Pressed::Sphere(hertz)) => hertz.pressure(r),
            Some(Pressed::Ellipsoid(hertz)) => hertz.pressure(x, y),
            Some(Pressed::Rounded(punch)) => punch.pressure(r),
            Some(Pressed::Flat(punch)) => punch.pressure(r),
            Some(Pressed::Cone(cone)) => cone.pressure(r),
            Some(Pressed::Line(line)) => line.hertz.pressure(x),
            None => 0.0,
        }
    }

    /// Pressure as a function of the place at the end of the history, for many places: what takes an integral comes from a table.
    pub fn pressure_everywhere(&self) -> Box<dyn Fn(f64, f64) -> f64 + '_> {
        if let Some(Pressed::Rounded(punch)) = &self.last {
            let table = RadialTable::new(punch.flat_radius(), punch.contact_radius, |r| punch.pressure(r));
            return Box::new(move |x: f64, y: f64| table.at(x.hypot(y)));
        }
        Box::new(move |x: f64, y: f64| self.pressure(x, y))
    }

    /// Whether it knows the shear.
    pub fn knows_shear(&self) -> bool {
        self.shear.is_some()
    }

    /// Shear at a point at the end of the history, x and y [pressure]; zero where it does not know it.
    pub fn shear(&self, x: f64, y: f64) -> [f64; 2] {
        self.shear.as_ref().map_or([0.0; 2], |(history, direction)| {
            let along = match history {
                Slipped::Sphere(history) => history.shear(x.hypot(y)),
                Slipped::Line(history) => history.shear(x),
            };
            direction.map(|part| part * along)
        })
    }
}

impl Pressed {
    fn says(&self) -> Said {
        let mut said = Said::default();
        let (peak, approach, area) = match self {
            Self::Sphere(form) => (Some(form.max_pressure), Some(form.approach), disc(form.contact_radius)),
            Self::Ellipsoid(form) => {
                (Some(form.max_pressure), Some(form.approach), PI * form.semi_axes[0] * form.semi_axes[1])
            }
            // The largest pressure of a rounded punch lies near its edge, in no closed form; those of an edge and a tip are infinite.
            Self::Rounded(form) => (None, Some(form.approach), disc(form.contact_radius)),
            Self::Flat(form) => (None, Some(form.approach), disc(form.contact_radius)),
            Self::Cone(form) => (None, Some(form.approach), disc(form.contact_radius)),
            Self::Line(form) => (Some(form.hertz.max_pressure), form.approach, 2.0 * form.hertz.half_width),
        };
        if let Some(peak) = peak {
            said.say(Quantity::MaxPressure, peak);
        }
        if let Some(approach) = approach {
            said.say(Quantity::Approach, approach);
        }
        said.say(Quantity::ContactArea, area);
        said
    }
}

fn disc(radius: f64) -> f64 {
    PI * radius * radius
}

fn moduli(plan: &Plan) -> Option<EffectiveModuli> {
    let material = |body: &Body| match body {
        Body::Rigid => Some(None),
        Body::Elastic(half_space) => half_space.single_material().map(|material| Some(*material)),
    };
    let bodies = &plan.case.bodies;
    match (material(bodies.upper())?, material(bodies.lower())?) {
        (None, Some(one)) | (Some(one), None) => Some(EffectiveModuli::rigid_on(&one)),
        (Some(upper), Some(lower)) => Some(EffectiveModuli::of_pair(&upper, &lower)),
        (None, None) => None,
    }
}

fn pressed_by(plan: &Plan, control: Control, modulus: f64) -> Option<Pressed> {
    let profile = &plan.case.profile;
    if !profile.heights.is_empty() {
        return None;
    }
    if profile.shapes.iter().all(|shape| shape.curvatures().is_some()) {
        let [x, y] = profile.curvatures();
        if !(x > 0.0 && y > 0.0) {
            return None;
        }
        let is_round = (x - y).abs() <= 1e-15 * x;
        return match control {
            Control::Force(force) if is_round => {
                Hertz::sphere(x.recip(), force, modulus).ok().map(Pressed::Sphere)
            }
            Control::Motion(approach) if is_round => {
                Hertz::sphere_at_approach(x.recip(), approach, modulus).ok().map(Pressed::Sphere)
            }
            Control::Force(force) => {
                HertzEllipse::ellipsoid([x.recip(), y.recip()], force, modulus).ok().map(Pressed::Ellipsoid)
            }
            Control::Motion(_) | Control::FarEnd(_) => None,
        };
    }
    let (Control::Force(force), [shape]) = (control, profile.shapes.as_slice()) else { return None };
    match *shape {
        Shape::RoundedPunch { flat_radius, edge_radius } => {
            RoundedPunch::new(flat_radius, edge_radius, force, modulus).ok().map(Pressed::Rounded)
        }
        Shape::FlatPunch { radius } => FlatPunch::new(radius, force, modulus).ok().map(Pressed::Flat),
        Shape::Cone { slope } => Cone::new(slope, force, modulus).ok().map(Pressed::Cone),
        _ => None,
    }
}

fn has_tangential(stages: &[Stage]) -> bool {
    stages.iter().any(Stage::is_tangential)
}

/// Without any tangential cause nothing slips and nothing is lost.
fn none_tangential(ends: &mut [Said]) {
    for said in ends {
        said.say(Quantity::Shift, 0.0);
        said.say(Quantity::DissipatedEnergy, 0.0);
    }
}

/// Follows the tangential force through the stages and adds what is known; gives the history at the end.
fn tangential(
    plan: &Plan,
    pressed: &[Pressed],
    moduli: &EffectiveModuli,
    ends: &mut [Said],
) -> Option<(Slipped, [f64; 2])> {
    let case = &plan.case;
    let CellValues::Uniform(friction) = *case.friction.coefficient() else { return None };
    if case.friction.max_shear().is_some() || case.friction_evolution.is_some() {
        return None;
    }
    let stages = &case.stages;
    let first = stages.iter().position(Stage::is_tangential)?;
    let steady = stages[first..].iter().all(|stage| stage.normal.is_none());
    let changes =
        stages.iter().any(|stage| stage.friction.is_some() || stage.twist.is_some() || stage.stretches());
    if !steady || changes {
        return None;
    }
    let bound = match pressed.get(first)? {
        Pressed::Sphere(hertz) if without_poisson(plan) => friction * hertz.force,
        Pressed::Line(line) => friction * line.hertz.line_force,
        _ => return None,
    };
    let mut forces = Vec::new();
    for_every_load(stages, |number, load| forces.push((number, load.tangential)));
    let forces: Vec<(usize, [f64; 2])> = forces
        .into_iter()
        .map(|(number, controls)| match controls {
            [Control::Force(x), Control::Force(y)] => Some((number, [x, y])),
            _ => None, // a prescribed shift
        })
        .collect::<Option<_>>()?;
    let size = |force: &[f64; 2]| force[0].hypot(force[1]);
    let largest = forces.iter().map(|(_, force)| *force).max_by(|a, b| size(a).total_cmp(&size(b)))?;
    if size(&largest) == 0.0 {
        return None;
    }
    let direction = largest.map(|part| part / size(&largest));
    let mut history = match pressed.get(first)? {
        Pressed::Sphere(hertz) => {
            Slipped::Sphere(TangentialHistory::new(hertz, friction, moduli.shear).ok()?)
        }
        Pressed::Line(line) => Slipped::Line(line.at_rest(plan, friction, moduli.normal, direction)?),
        _ => return None,
    };
    let mut said = ends.to_vec();
    for (number, force) in &forces {
        let across = force[0] * direction[1] - force[1] * direction[0];
        // Where all of the contact slides the shift is no matter of the force.
        if across.abs() > 1e-12 * size(&largest) || size(force) >= bound * (1.0 - 1e-9) {
            return None;
        }
        let along = force[0] * direction[0] + force[1] * direction[1];
        let (shift, energy, stuck) = match &mut history {
            Slipped::Sphere(history) => {
                history.push(along).ok()?;
                (Some(history.shift()), history.dissipated_energy(), disc(history.stick_radius()))
            }
            Slipped::Line(history) => {
                history.push(along).ok()?;
                let shift = plan.datum.map(|depth| history.shift(depth, at_datum(plan, direction)));
                (shift, history.dissipated_energy(), 2.0 * history.stick_half_width())
            }
        };
        if *number >= first {
            said[*number].say(Quantity::StickArea, stuck);
        }
        if let Some(shift) = shift {
            said[*number].0[Quantity::Shift as usize] = Some(direction.map(|part| part * shift));
        }
        said[*number].say(Quantity::DissipatedEnergy, energy);
    }
    ends.copy_from_slice(&said);
    Some((history, direction))
}

/// Visits the loads at the end of every increment. Where a control changes its kind only the end of its stage is right.
fn for_every_load(stages: &[Stage], mut visit: impl FnMut(usize, &LoadStep)) {
    let force = Control::Force(0.0);
    let mut held = LoadStep { normal: force, tangential: [force; 2], ..LoadStep::FREE };
    for (number, stage) in stages.iter().enumerate() {
        let start = held;
        for k in 1..=stage.increments_in_all() {
            held = stage.load(&start, k);
            visit(number, &held);
        }
    }
}

/// Loads at the ends of the stages.
fn loads_at_ends(stages: &[Stage]) -> Vec<LoadStep> {
    let mut ends: Vec<LoadStep> = Vec::new();
    for_every_load(stages, |number, load| {
        ends.truncate(number);
        ends.push(*load);
    });
    ends
}

/// Whether Poisson's ratio vanishes in both bodies.
fn without_poisson(plan: &Plan) -> bool {
    let bodies = &plan.case.bodies;
    [bodies.upper(), bodies.lower()].into_iter().all(|body| match body {
        Body::Rigid => true,
        Body::Elastic(half_space) => half_space.single_material().map(ElasticMaterial::poisson) == Some(0.0),
    })
}
