//! Partial slip in closed form along a run, where a form holds: a sphere (Cattaneo, Mindlin and Deresiewicz) or a cylinder in a line
//! contact (Cattaneo; with moderate bulk stress Nowell and Hills) on homogeneous bodies that do not couple, one coefficient of friction,
//! one line of force, a normal force that stays, and a contact that sticks somewhere.

use std::f64::consts::{FRAC_1_PI, PI};

use fret_core::analytic::{CattaneoLine, HertzLine, LineHistory, TangentialHistory};
use fret_core::model::{BulkCompliance, ContactPair};
use serde_json::Value;

use super::closed_form::{NormalForm, Pressed};
use crate::results::Results;

/// Fraction of the largest load below which a change of the load, or a load across, is none.
const STEADY: f64 = 1e-4;

/// Partial slip in closed form along the history of a run.
#[derive(Debug)]
pub struct TangentialForm {
    /// After each increment, as long as the closed form can follow.
    after: Vec<Option<PartialSlip>>,
}

/// Partial slip in closed form after an increment.
#[derive(Debug, Clone)]
pub enum PartialSlip {
    /// Of a sphere.
    Sphere(TangentialHistory),
    /// Of a cylinder in a line contact, and its shift where it has a datum.
    Line(LineHistory, Option<f64>),
    /// The same under a bulk stress.
    Stretched {
        /// Tangential force per length.
        force: f64,
        /// Whether x runs along the force's direction: 1, or else -1.
        sense: f64,
        /// First loadings whose sum, with these weights, it is; the present one comes last.
        parts: Vec<(f64, CattaneoLine)>,
    },
}

impl TangentialForm {
    /// The closed form of a run whose tangential force acts along `direction`, where it has one.
    pub fn of(results: &Results, normal: &NormalForm, direction: [f64; 2]) -> Option<Self> {
        let friction: f64 = results.planned("/case/friction/coefficient/uniform")?;
        let is_given = |place: &str| results.planned::<Value>(place).is_some_and(|value| !value.is_null());
        if is_given("/case/friction/max_shear") || is_given("/case/friction_evolution") {
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
        let strain = Strain::of(results, direction, &along)?;
        let mut state =
            State::at_rest(normal, normal.under(pressed)?, friction, direction, strain.per_force)?;
        let mut after = vec![None; start];
        let slides =
            |row: usize| results.table.regimes().get(row).is_some_and(|regime| regime == "gross_slip");
        if !(0..start).all(|row| strain.holds(row)) {
            return None;
        }
        for (row, (force, tangential)) in forces.iter().zip(&along).enumerate().skip(start) {
            let is_steady = (force - pressed).abs() <= STEADY * pressed;
            // At the onset of sliding the shift is no longer a matter of the force.
            let holds = tangential.abs() < friction * pressed * (1.0 - 1e-6) && strain.holds(row);
            if !is_steady || !holds || slides(row) {
                break;
            }
            let Some(slip) = state.pushed(*tangential) else { break };
            after.push(Some(slip));
        }
        let rows = table.rows();
        let any = after.iter().any(Option::is_some);
        after.resize(rows, None);
        any.then_some(Self { after })
    }

    /// The closed form after an increment.
    pub fn after(&self, increment: usize) -> Option<&PartialSlip> {
        self.after.get(increment)?.as_ref()
    }

    /// Whether some increment satisfies a condition.
    pub fn any(&self, is_so: impl Fn(&PartialSlip) -> bool) -> bool {
        self.after.iter().flatten().any(is_so)
    }
}

/// Strain of the lower body less that of the upper one, along the force.
struct Strain {
    /// What it must be for the force of each increment, and what it is.
    pairs: Vec<[f64; 2]>,
    /// Strain per force per length [length/force].
    per_force: f64,
    largest: f64,
}

impl Strain {
    /// Of all increments. None where the bodies are strained otherwise than a closed form knows: across a line contact's axis, with the
    /// force.
    fn of(results: &Results, direction: [f64; 2], along: &[f64]) -> Option<Self> {
        let bodies: ContactPair = results.planned("/case/bodies")?;
        let is_line = results.fields.is_line();
        let compliance = BulkCompliance::of(&bodies, is_line);
        let column = |name: &str| results.table.column(name);
        let stress = [
            [column("bulk_stress_x"), column("bulk_stress_y")],
            [column("upper_bulk_stress_x"), column("upper_bulk_stress_y")],
        ];
        let at = |row: usize| {
            compliance.relative_strain(stress.map(|of| of.map(|part| part.get(row).copied().unwrap_or(0.0))))
        };
        let strains: Vec<[f64; 2]> = (0..along.len()).map(at).collect();
        let size = |strain: &[f64; 2]| strain[0].hypot(strain[1]);
        let (row, largest) = strains
            .iter()
            .map(size)
            .enumerate()
            .fold((0, 0.0), |most, next| if next.1 > most.1 { next } else { most });
        if largest == 0.0 {
            return Some(Self { pairs: vec![[0.0; 2]; along.len()], per_force: 0.0, largest });
        }
        let across_axis = is_line && direction[1] == 0.0 && strains.iter().all(|strain| strain[1] == 0.0);
        if !across_axis || along[row] == 0.0 {
            return None;
        }
        let strains = strains.iter().map(|strain| strain[0]);
        let per_force = strains.clone().nth(row)? / along[row];
        let pairs = along.iter().zip(strains).map(|(force, strain)| [per_force * force, strain]).collect();
        Some(Self { pairs, per_force, largest })
    }

    /// Whether the strain of an increment is in proportion to its force.
    fn holds(&self, row: usize) -> bool {
        self.pairs.get(row).is_some_and(|[expected, found]| (expected - found).abs() <= STEADY * self.largest)
    }
}

/// What a closed form follows from increment to increment.
enum State {
    Sphere(TangentialHistory),
    Line { history: LineHistory, datum: Option<f64>, at_datum: f64, stretched: Option<Stretched> },
}

/// A line contact whose strain grows with its force.
struct Stretched {
    hertz: HertzLine,
    friction: f64,
    modulus: f64,
    per_force: f64,
    /// Whether x runs along the force's direction: 1, or else -1.
    sense: f64,
}

impl State {
    /// Before the first tangential force.
    fn at_rest(
        normal: &NormalForm,
        pressed: Pressed,
        friction: f64,
        direction: [f64; 2],
        per_force: f64,
    ) -> Option<Self> {
        match pressed {
            Pressed::Sphere(hertz) => {
                TangentialHistory::new(&hertz, friction, normal.moduli.shear).ok().map(Self::Sphere)
            }
            Pressed::Ellipsoid(_) => None,
            Pressed::Line(hertz, _) => {
                let modulus = normal.moduli.normal;
                // across the axis, or along it
                let (compliance, at_datum) = match direction {
                    [_, 0.0] => (2.0 / modulus, -0.5 * FRAC_1_PI * normal.shear_compliance),
                    [0.0, _] => (normal.shear_compliance, 0.0),
                    _ => return None,
                };
                let history = LineHistory::new(&hertz, friction, compliance).ok()?;
                let sense = direction[0].signum();
                let stretched =
                    (per_force != 0.0).then_some(Stretched { hertz, friction, modulus, per_force, sense });
                Some(Self::Line { history, datum: normal.datum, at_datum, stretched })
            }
        }
    }

    /// After a further force; none where the form does not hold.
    fn pushed(&mut self, force: f64) -> Option<PartialSlip> {
        match self {
            Self::Sphere(history) => {
                history.push(force).ok()?;
                Some(PartialSlip::Sphere(history.clone()))
            }
            Self::Line { history, datum, at_datum, stretched } => {
                history.push(force).ok()?;
                if let Some(stretched) = stretched {
                    let (sense, parts) = (stretched.sense, stretched.parts(history)?);
                    return Some(PartialSlip::Stretched { force, sense, parts });
                }
                let shift = datum.map(|depth| history.shift(depth, *at_datum));
                Some(PartialSlip::Line(history.clone(), shift))
            }
        }
    }
}

impl Stretched {
    /// The first loadings whose sum the state is. Force and strain grow in one proportion, so that what slips on a branch always contains what
    /// slipped on it before: then a branch is twice the first loading of half its change, as without strain.
    fn parts(&self, history: &LineHistory) -> Option<Vec<(f64, CattaneoLine)>> {
        let turns = history.turning_points();
        let ends = turns.iter().copied().chain([history.tangential_force()]);
        let starts = [0.0].into_iter().chain(turns.iter().copied());
        let part = |(number, (end, start)): (usize, (f64, f64))| {
            let weight = if number == 0 { 1.0 } else { 2.0 };
            let force = (end - start) / weight;
            let strain = self.per_force * force;
            let form = CattaneoLine::new(&self.hertz, self.friction, self.modulus, force, strain).ok()?;
            Some((weight, form))
        };
        ends.zip(starts).enumerate().map(part).collect()
    }
}

impl PartialSlip {
    /// Tangential displacement [length]; of a line contact relative to its datum, and none under a bulk stress.
    pub fn shift(&self) -> Option<f64> {
        match self {
            Self::Sphere(history) => Some(history.shift()),
            Self::Line(_, shift) => *shift,
            Self::Stretched { .. } => None,
        }
    }

    /// Tangential force [force].
    pub fn tangential_force(&self) -> f64 {
        match self {
            Self::Sphere(history) => history.tangential_force(),
            Self::Line(history, _) => history.tangential_force(),
            Self::Stretched { force, .. } => *force,
        }
    }

    /// Energy dissipated since the start [force x length]; none under a bulk stress.
    pub fn dissipated_energy(&self) -> Option<f64> {
        match self {
            Self::Sphere(history) => Some(history.dissipated_energy()),
            Self::Line(history, _) => Some(history.dissipated_energy()),
            Self::Stretched { .. } => None,
        }
    }

    /// Area that has not slipped on the present branch [length^2], of a line contact its width [length].
    pub fn stick_area(&self) -> f64 {
        match self {
            Self::Sphere(history) => PI * history.stick_radius().powi(2),
            Self::Line(history, _) => 2.0 * history.stick_half_width(),
            Self::Stretched { parts, .. } => {
                parts.last().map_or(0.0, |(_, part)| 2.0 * part.stick_half_width)
            }
        }
    }

    /// Shear at a point along the force [pressure].
    pub fn shear(&self, x: f64, y: f64) -> f64 {
        match self {
            Self::Sphere(history) => history.shear(x.hypot(y)),
            Self::Line(history, _) => history.shear(x),
            Self::Stretched { sense, parts, .. } => {
                parts.iter().map(|(weight, part)| weight * part.shear(sense * x)).sum()
            }
        }
    }

    /// Whether it neglects the slip across the force: of a sphere; a line contact has none.
    pub fn neglects_slip_across(&self) -> bool {
        matches!(self, Self::Sphere(_))
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
