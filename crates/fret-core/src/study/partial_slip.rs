//! Partial slip in closed form along a history, where a form holds: a sphere (Cattaneo, Mindlin and Deresiewicz) or a cylinder in a line
//! contact (Cattaneo; with moderate bulk stress Nowell and Hills) on homogeneous bodies that do not couple, one coefficient of friction,
//! one line of force, a normal force that stays, and a contact that sticks somewhere. Refinement studies ask it about the loads of a plan,
//! reports about those of a run.

use std::f64::consts::{FRAC_1_PI, PI};

use super::normal_form::{NormalForm, Pressed};
use crate::analytic::{CattaneoLine, HertzLine, LineHistory, TangentialHistory};
use crate::case::Case;
use crate::model::{BulkCompliance, Control, Dimension};
use crate::plan::{Coupling, Plan};

/// What acts at the end of an increment.
#[derive(Debug, Clone, Copy, Default)]
pub struct Loaded {
    /// Normal force [force].
    pub normal: f64,
    /// Tangential force along x and y [force].
    pub tangential: [f64; 2],
    /// Whether anything turns about z.
    pub twists: bool,
    /// Bulk stresses of the lower and the upper body along x and y [pressure].
    pub bulk_stress: [[f64; 2]; 2],
    /// Whether all of the contact slides.
    pub slides: bool,
}

impl Loaded {
    /// Tangential force along a direction and across it.
    pub fn components(&self, [cosine, sine]: [f64; 2]) -> [f64; 2] {
        let [x, y] = self.tangential;
        [cosine * x + sine * y, cosine * y - sine * x]
    }
}

/// Partial slip in closed form along a history.
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
    /// The closed form of a history whose tangential force acts along `direction`, where it has one: of a plan that was made, or that of a
    /// record. `nothing`: fraction of the largest load below which a change of the load, or a load across, is none.
    pub fn of<M, H>(
        plan: &Plan<Case<M, H>>,
        normal: &NormalForm,
        (direction, history): ([f64; 2], &[Loaded]),
        nothing: f64,
    ) -> Option<Self> {
        let case = &plan.case;
        let friction = case.friction.coefficient().uniform()?;
        let another_law = case.friction.max_shear().is_some()
            || case.friction_evolution.is_some()
            || case.stages.iter().any(|stage| stage.friction.is_some());
        // What slipped before a history starts from a state is not known.
        if another_law || plan.coupling == Coupling::Coupled || case.start.is_some() {
            return None;
        }
        let along: Vec<f64> = history.iter().map(|loaded| loaded.components(direction)[0]).collect();
        let largest = along.iter().fold(0.0, |most: f64, force| most.max(force.abs()));
        let strays = |loaded: &Loaded| loaded.components(direction)[1].abs() > nothing * largest;
        if history.iter().any(|loaded| loaded.twists || strays(loaded)) {
            return None;
        }
        let start = along.iter().position(|force| force.abs() > nothing * largest)?;
        let pressed = history[start].normal;
        let strain = Strain::of(case, direction, (history, &along), nothing)?;
        let held = normal.under(Control::Force(pressed))?;
        let mut state = State::at_rest(normal, held, friction, direction, strain.per_force)?;
        if !(0..start).all(|row| strain.holds(row)) {
            return None;
        }
        let mut after = vec![None; start];
        for (row, (loaded, tangential)) in history.iter().zip(&along).enumerate().skip(start) {
            let is_steady = (loaded.normal - pressed).abs() <= nothing * pressed;
            // At the onset of sliding the shift is no longer a matter of the force.
            let holds = tangential.abs() < friction * pressed * (1.0 - 1e-6) && strain.holds(row);
            if !is_steady || !holds || loaded.slides {
                break;
            }
            let Some(slip) = state.pushed(*tangential) else { break };
            after.push(Some(slip));
        }
        let any = after.iter().any(Option::is_some);
        after.resize(history.len(), None);
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
    /// Strains that differ by less are equal.
    nothing: f64,
}

impl Strain {
    /// Of all increments. None where the bodies are strained otherwise than a closed form knows: across a line contact's axis, with the
    /// force.
    fn of<M, H>(
        case: &Case<M, H>,
        direction: [f64; 2],
        (history, along): (&[Loaded], &[f64]),
        nothing: f64,
    ) -> Option<Self> {
        let dimension = case.dimension();
        let compliance = BulkCompliance::of(&case.bodies, dimension);
        let at = |loaded: &Loaded| compliance.relative_strain(loaded.bulk_stress);
        let strains: Vec<[f64; 2]> = history.iter().map(at).collect();
        let size = |strain: &[f64; 2]| strain[0].hypot(strain[1]);
        let (row, largest) = strains
            .iter()
            .map(size)
            .enumerate()
            .fold((0, 0.0), |most, next| if next.1 > most.1 { next } else { most });
        if largest == 0.0 {
            return Some(Self { pairs: vec![[0.0; 2]; along.len()], per_force: 0.0, nothing: 0.0 });
        }
        let across_axis = dimension == Dimension::Line
            && direction[1] == 0.0
            && strains.iter().all(|strain| strain[1] == 0.0);
        if !across_axis || along[row] == 0.0 {
            return None;
        }
        let strains = strains.iter().map(|strain| strain[0]);
        let per_force = strains.clone().nth(row)? / along[row];
        let pairs = along.iter().zip(strains).map(|(force, strain)| [per_force * force, strain]).collect();
        Some(Self { pairs, per_force, nothing: nothing * largest })
    }

    /// Whether the strain of an increment is in proportion to its force.
    fn holds(&self, row: usize) -> bool {
        self.pairs.get(row).is_some_and(|[expected, found]| (expected - found).abs() <= self.nothing)
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
            Pressed::Ellipsoid(_) | Pressed::Rounded(_) | Pressed::Flat(_) | Pressed::Cone(_) => None,
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
