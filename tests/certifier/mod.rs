//! Judges a run from what it left behind: kept fields and records of increments that follow each other, and the case. Every
//! law is computed again, in double precision and by plain sums over cells; nothing of the solver is used.
//!
//! Of the library it takes the case (loads, friction, undeformed gap) and the influence coefficients, which are compared with
//! independent tables elsewhere (`coefficient_regimes.rs`, `coefficient_tables.rs`).

mod influence;
mod run;

use fret_core::case::Stage;
use fret_core::history::{KeptFields, Regime, StepRecord};
use fret_core::model::{Control, CoulombFriction, LoadStep, SurfaceGrid, Zone};
use fret_core::plan::Plan;
use influence::Influence;
use ndarray::Array2;

pub use run::{Ended, Kept, run_certified};

/// Bound on what is the same number computed twice, relative to the largest term of its sum. Sums of a few thousand terms in
/// another order differ by 1e-14; under a coating 1e6 times softer than its base, where displacements nearly cancel, by 1e-12.
pub const SAME: f64 = 1e-11;

/// Shear counts as on its disc's circle up to this fraction of it; ten times what the program allows itself.
pub const ON_CIRCLE: f64 = 1e-9;

/// How far an increment is from the laws of contact. Every number is dimensionless and 0 for an exact solution.
///
/// `p` pressure, `q` shear, `g` gap, `v` slip increment (motion of the upper body less that of the lower in the increment);
/// `u` mean normal displacement under the load, `sum p u_z / sum p`; `Kn`, `Kt` displacement of a cell by unit traction on
/// itself; `|mu p|` the Euclidean norm over all cells.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Certificate {
    /// Number of the increment in the whole history.
    pub increment: usize,
    /// Whether it was solved as a whole: the slip of one solved in parts depends on tractions in between, which nobody kept.
    pub whole: bool,
    /// Kept gap against `g0 + worn depth + u_z - approach`, over the largest of these terms in the cell and `u`.
    pub gap: f64,
    /// Largest `|min(g, Kn p)|` over `u`: pressure only where the gap is closed, no overlap.
    pub complementarity: f64,
    /// Largest tension over the largest pressure.
    pub tension: f64,
    /// Largest excess of `|q|` over `mu p`, over the largest `mu p`; shear where there is no pressure counts.
    pub excess: f64,
    /// Coulomb's law, stick and slip in one: `|q - P(q + v/Kt)| / |mu p|`, `P` the nearest point of the disc `|q| <= mu p`.
    pub coulomb: f64,
    /// Largest `|v|` of a sticking cell over `Kt |mu p|`.
    pub stick: f64,
    /// Largest part of `v/Kt` across the shear of a slipping cell, over `|mu p| (1 + |v| / (Kt mu p))`: slip along the shear.
    pub direction: f64,
    /// Largest part of `v/Kt` against the shear of a slipping cell, over `|mu p|`: friction takes energy and never gives any.
    pub against: f64,
    /// Largest `mu p - |q|` of a slipping cell over the largest `mu p`.
    pub on_circle: f64,
    /// Kept slip increment against `v` in slipping cells and against 0 in all others, over the largest term of `v`.
    pub slip: f64,
    /// Prescribed forces against the sums of the tractions: over the normal force, `sum mu p dA`, and this times the contact's
    /// largest coordinate.
    pub equilibrium: f64,
    /// Prescribed motions against those reached, relative.
    pub motion: f64,
    /// Columns of the record against the same numbers from the fields, relative; 1 where a count or a name is wrong.
    pub columns: f64,
    /// The same of the moment about z.
    pub moment: f64,
    /// Whether the bodies turn or have turned about z, or may.
    pub turns: bool,
    /// Dissipated energy of the increment against [`dissipated`], over `sum mu p |v| dA` and the energy so far.
    pub energy: f64,
}

impl Certificate {
    /// Every law by name, how far the increment is from it, and how far it may be: by the solver's `tolerance`, or by rounding
    /// where a number has to be the same.
    pub fn laws(&self, tolerance: f64) -> [(&'static str, f64, f64); 15] {
        // Half a tolerance more than the program grants itself: its norms are other ones where they are not the same.
        let solved = 1.5 * tolerance + SAME;
        [
            ("gap", self.gap, SAME),
            ("complementarity", self.complementarity, solved),
            ("tension", self.tension, 0.0),
            ("excess", self.excess, 1e-12),
            ("coulomb", self.coulomb, solved),
            ("stick", self.stick, solved),
            ("direction", self.direction, solved),
            ("against", self.against, solved),
            ("on_circle", self.on_circle, ON_CIRCLE),
            ("slip", self.slip, SAME),
            ("equilibrium", self.equilibrium, solved),
            ("motion", self.motion, SAME),
            ("columns", self.columns, SAME),
            // A moment that merely holds the bodies back is not reported: see the ignored test in `certified.rs`.
            ("moment", if self.turns { self.moment } else { 0.0 }, SAME),
            ("energy", self.energy, SAME),
        ]
    }

    /// The laws that are broken, and by how much.
    pub fn violations(&self, tolerance: f64) -> Vec<(&'static str, f64)> {
        // What is not a number proves nothing.
        let broken = |(name, value, bound)| (!(value <= bound)).then_some((name, value));
        self.laws(tolerance).into_iter().filter_map(broken).collect()
    }
}

/// The rule by which friction dissipates in a cell, per area: the mean of the friction bounds before and after the increment times the
/// slip along the shear. The bounds go as the pressures `[before, after]`.
pub fn dissipated([before, after]: [f64; 2], shear: [f64; 2], slip: [f64; 2]) -> f64 {
    if after > 0.0 { 0.5 * (before + after) / after * dot(shear, slip) } else { 0.0 }
}

/// Certificates of a run, increment by increment from the first on.
///
/// # Errors
/// When a field that has to be judged was not kept.
pub fn certify(plan: &Plan, run: &[Kept]) -> Result<Vec<Certificate>, String> {
    let mut certifier = Certifier::new(plan);
    run.iter().map(|kept| certifier.next(&kept.record, &kept.fields)).collect()
}

/// Goes through a run with its operator and what the increment before left.
pub struct Certifier<'a> {
    plan: &'a Plan,
    influence: Influence,
    undeformed: Array2<f64>,
    before: Before,
}

/// What an increment leaves to the next one.
struct Before {
    pressure: Array2<f64>,
    slip: [Array2<f64>; 2],
    worn: Option<Array2<f64>>,
    tangential: [Array2<f64>; 2],
    approach: f64,
    shift: [f64; 2],
    twist: f64,
    energy: f64,
    /// Stage, number of the increment in it, what it found prescribed, what is prescribed now.
    stage: usize,
    k: usize,
    found: LoadStep,
    held: LoadStep,
    /// Normal force, tangential forces, moment.
    reached: [f64; 4],
}

impl<'a> Certifier<'a> {
    /// Certifier of a planned case, before its first increment.
    pub fn new(plan: &'a Plan) -> Self {
        let case = &plan.case;
        let zero = || Array2::zeros(case.cells);
        let free = LoadStep {
            normal: Control::Force(0.0),
            tangential: [Control::Force(0.0); 2],
            twist: Control::Motion(0.0),
        };
        Self {
            plan,
            influence: Influence::new(&case.bodies, &plan.grid, case.periodic),
            undeformed: case.profile.gap(&plan.grid),
            before: Before {
                slip: [zero(), zero()],
                worn: None,
                pressure: zero(),
                tangential: [zero(), zero()],
                approach: 0.0,
                shift: [0.0; 2],
                twist: 0.0,
                energy: 0.0,
                stage: usize::MAX,
                k: 0,
                found: free,
                held: free,
                reached: [0.0; 4],
            },
        }
    }

    /// Judges the next increment, and goes on from it.
    ///
    /// # Errors
    /// When pressure, shear, slip, gap or zone was not kept.
    pub fn next(&mut self, record: &StepRecord, fields: &KeptFields) -> Result<Certificate, String> {
        let missing = || format!("increment {}: a field was not kept", record.increment);
        let KeptFields {
            pressure: Some(p),
            shear: Some(q),
            slip: Some(slip),
            gap: Some(gap),
            zone: Some(zone),
            ..
        } = fields
        else {
            return Err(missing());
        };
        let load = self.prescribed(record);
        let case = &self.plan.case;
        let law = case.stages[..=record.stage].iter().rev().find_map(|stage| stage.friction.as_ref());
        let law = law.unwrap_or(&case.friction);
        let displacements = self.influence.displacements(p, q);
        let increment = Increment {
            grid: &self.plan.grid,
            influence: &self.influence,
            undeformed: &self.undeformed,
            before: &self.before,
            record,
            slides: !case.is_frictionless(),
            jumps: case.wear.is_some(),
            law,
            load,
            fields: Fields { p, q, slip, gap, zone },
            displacements: &displacements,
        };
        let certificate = increment.certificate();
        let [_, x, y] = displacements;
        let before = &mut self.before;
        before.tangential = [x, y];
        before.pressure.clone_from(p);
        before.slip.clone_from(slip);
        before.worn.clone_from(&fields.worn_depth);
        (before.approach, before.shift, before.twist) = (record.approach, record.shift, record.twist);
        before.energy = record.dissipated_energy;
        before.held = load;
        let [x, y] = record.tangential_force;
        before.reached = [record.normal_force, x, y, record.twist_moment];
        Ok(certificate)
    }

    /// What the case prescribes for this increment.
    fn prescribed(&mut self, record: &StepRecord) -> LoadStep {
        let before = &mut self.before;
        let stage: &Stage = &self.plan.case.stages[record.stage];
        if before.stage != record.stage {
            // A control that changes its kind goes on from what was reached.
            let motions = [before.approach, before.shift[0], before.shift[1], before.twist];
            let controls = [&stage.normal, &stage.tangential[0], &stage.tangential[1], &stage.twist];
            let held =
                [before.held.normal, before.held.tangential[0], before.held.tangential[1], before.held.twist];
            let found = [0, 1, 2, 3].map(|mode| match (controls[mode], held[mode]) {
                (Some(control), Control::Force(_)) if control.is_motion() => Control::Motion(motions[mode]),
                (Some(control), Control::Motion(_)) if !control.is_motion() => {
                    Control::Force(before.reached[mode])
                }
                (_, held) => held,
            });
            let [normal, x, y, twist] = found;
            before.found = LoadStep { normal, tangential: [x, y], twist };
            (before.stage, before.k) = (record.stage, 0);
        }
        before.k += 1;
        stage.load(&before.found, before.k)
    }
}

#[derive(Clone, Copy)]
struct Fields<'a> {
    p: &'a Array2<f64>,
    q: &'a [Array2<f64>; 2],
    slip: &'a [Array2<f64>; 2],
    gap: &'a Array2<f64>,
    zone: &'a Array2<Zone>,
}

/// One increment with all it has to hold.
struct Increment<'a> {
    grid: &'a SurfaceGrid,
    /// Cycles may stand for others that are not computed.
    jumps: bool,
    influence: &'a Influence,
    undeformed: &'a Array2<f64>,
    before: &'a Before,
    record: &'a StepRecord,
    /// There is friction somewhere in the history: slip is followed.
    slides: bool,
    law: &'a CoulombFriction,
    load: LoadStep,
    fields: Fields<'a>,
    displacements: &'a [Array2<f64>; 3],
}

impl Increment<'_> {
    fn certificate(&self) -> Certificate {
        let mut certificate = Certificate {
            increment: self.record.increment,
            whole: self.record.parts == 1,
            equilibrium: self.equilibrium(),
            motion: self.motion(),
            columns: self.columns(),
            moment: over(self.record.twist_moment - self.resultants()[3], self.units()[3]),
            turns: self.load.twist != Control::Motion(0.0) || self.before.twist != 0.0,
            ..Certificate::default()
        };
        self.judge_normal(&mut certificate);
        self.judge_friction(&mut certificate);
        certificate
    }

    fn judge_normal(&self, certificate: &mut Certificate) {
        let Fields { p, gap, .. } = self.fields;
        let u = &self.displacements[0];
        let total = p.sum();
        let mean = if total > 0.0 { (p * u).sum() / total } else { 0.0 };
        let largest = largest(p);
        for ((i, j), &p) in p.indexed_iter() {
            let at = [i, j];
            let worn = self.before.worn.as_ref().map_or(0.0, |worn| worn[at]);
            let found = self.undeformed[at] + worn + u[at] - self.record.approach;
            let terms = [self.undeformed[at], worn, u[at], self.record.approach, mean];
            if found != gap[at] {
                certificate.gap.raise(over(found - gap[at], size(&terms)));
            }
            // Without a load the approach is what an overlap can be compared with.
            let off = if mean > 0.0 {
                found.min(self.influence.own_normal * p) / mean
            } else {
                over(found.min(0.0), size(&terms))
            };
            certificate.complementarity.raise(off);
            certificate.tension.raise(over((-p).max(0.0), largest));
        }
    }

    fn judge_friction(&self, certificate: &mut Certificate) {
        let Fields { p, q, slip, zone, .. } = self.fields;
        let bound = self.bound();
        let most = largest(&bound);
        let norm = bound.iter().map(|bound| bound * bound).sum::<f64>().sqrt();
        let kt = self.influence.own_tangential;
        let (mut off, mut work, mut limit) = (0.0, 0.0, 0.0);
        let scale = self.largest_term_of_slip();
        for ((i, j), &zone) in zone.indexed_iter() {
            let at = [i, j];
            let (q, bound) = ([q[0][at], q[1][at]], bound[at]);
            let length = hypot(q);
            certificate.excess.raise(over((length - bound).max(0.0), most));
            let kept = [0, 1].map(|axis| slip[axis][at] - self.before.slip[axis][at]);
            work += dissipated([self.before.pressure[at], p[at]], q, kept);
            limit += bound * hypot(kept);
            if zone == Zone::Slip {
                certificate.on_circle.raise(over((bound - length).max(0.0), most));
            } else if certificate.whole {
                // Exactly: nothing is added to the slip of a cell that does not slip.
                certificate.slip.raise(if kept == [0.0; 2] { 0.0 } else { 1.0 });
            }
            if !certificate.whole || !self.slides || zone == Zone::Open || p[at] <= 0.0 {
                continue;
            }
            let v = self.slip_increment(at);
            let w = v.map(|v| v / kt);
            let image = project([q[0] + w[0], q[1] + w[1]], bound);
            off += (q[0] - image[0]).powi(2) + (q[1] - image[1]).powi(2);
            if zone == Zone::Stick {
                certificate.stick.raise(over(hypot(w), norm));
                continue;
            }
            certificate.slip.raise(over(hypot([kept[0] - v[0], kept[1] - v[1]]), scale));
            if bound > 0.0 {
                let across = (q[0] * w[1] - q[1] * w[0]).abs() / bound;
                certificate.direction.raise(over(across, norm * (1.0 + hypot(w) / bound)));
                certificate.against.raise(over((-dot(q, w) / bound).max(0.0), norm));
            }
        }
        certificate.coulomb = over(off.sqrt(), norm);
        let area = self.grid.cell_area();
        let more = self.record.dissipated_energy - self.before.energy;
        let unit = size(&[limit * area, self.record.dissipated_energy]);
        // Of an increment in parts only the sign is known; one that ends a cycle counts those as well that the cycle stands for.
        let wrong = match (certificate.whole, self.jumps) {
            (true, false) => more - work * area,
            (true, true) => (work * area - more).max(0.0),
            (false, _) => (-more).max(0.0),
        };
        certificate.energy = over(wrong, unit);
    }

    /// `mu p` of every cell.
    fn bound(&self) -> Array2<f64> {
        let mut bound = self.fields.p.clone();
        bound.indexed_iter_mut().for_each(|((i, j), p)| *p *= self.law.at(i, j));
        bound
    }

    /// Motion of the upper point less that of the lower one in the increment [length].
    fn slip_increment(&self, at: [usize; 2]) -> [f64; 2] {
        let turned = self.record.twist - self.before.twist;
        let turn = [-turned * self.grid.centre(1, at[1]), turned * self.grid.centre(0, at[0])];
        [0, 1].map(|axis| {
            let moved = self.record.shift[axis] - self.before.shift[axis] + turn[axis];
            moved - (self.displacements[1 + axis][at] - self.before.tangential[axis][at])
        })
    }

    /// Largest number that enters a slip increment [length].
    fn largest_term_of_slip(&self) -> f64 {
        let [_, x, y] = self.displacements;
        let [half_x, half_y] = self.grid.size().map(|side| 0.5 * side);
        let fields = [x, y, &self.before.tangential[0], &self.before.tangential[1]].map(largest);
        let slips = [&self.fields.slip[0], &self.fields.slip[1]].map(largest);
        let turn = self.record.twist.abs().max(self.before.twist.abs()) * half_x.hypot(half_y);
        let shifts = [self.record.shift, self.before.shift].map(hypot);
        size(&[size(&fields), size(&slips), size(&shifts), turn])
    }

    /// Sums of the tractions: normal force, tangential forces, moment about z.
    fn resultants(&self) -> [f64; 4] {
        let Fields { p, q, .. } = self.fields;
        let mut moment = 0.0;
        for ((i, j), &x) in q[0].indexed_iter() {
            moment += q[1][[i, j]] * self.grid.centre(0, i) - x * self.grid.centre(1, j);
        }
        [p.sum(), q[0].sum(), q[1].sum(), moment].map(|sum| sum * self.grid.cell_area())
    }

    /// What each resultant is compared with: the normal force; all the friction there can be; its moment.
    fn units(&self) -> [f64; 4] {
        let mut arm = 0.0_f64;
        for ((i, j), &p) in self.fields.p.indexed_iter() {
            if p > 0.0 {
                arm = arm.max(self.grid.centre(0, i).abs()).max(self.grid.centre(1, j).abs());
            }
        }
        let [normal, ..] = self.resultants();
        let friction = self.bound().sum() * self.grid.cell_area();
        [normal, friction, friction, friction * arm]
    }

    fn controls(&self) -> [Control; 4] {
        let LoadStep { normal, tangential: [x, y], twist } = self.load;
        [normal, x, y, twist]
    }

    fn equilibrium(&self) -> f64 {
        let (found, units) = (self.resultants(), self.units());
        let mut worst = 0.0;
        for (mode, control) in self.controls().into_iter().enumerate() {
            match control {
                // Bodies pulled apart carry nothing.
                Control::Force(asked) if mode == 0 && asked <= 0.0 => {
                    worst.raise(over(found[0].abs(), found[0].abs()));
                }
                Control::Force(asked) => worst.raise(over(found[mode] - asked, units[mode])),
                Control::Motion(_) => {}
            }
        }
        worst
    }

    fn motion(&self) -> f64 {
        let (now, then) = (self.record, self.before);
        let pairs = [
            (now.approach, then.approach),
            (now.shift[0], then.shift[0]),
            (now.shift[1], then.shift[1]),
            (now.twist, then.twist),
        ];
        let mut worst = 0.0;
        for (control, (found, from)) in self.controls().into_iter().zip(pairs) {
            if let Control::Motion(asked) = control {
                worst.raise(over(found - asked, size(&[asked, from])));
            }
        }
        worst
    }

    fn columns(&self) -> f64 {
        let Fields { p, q, zone, .. } = self.fields;
        let record = self.record;
        let (found, units) = (self.resultants(), self.units());
        let [x, y] = record.tangential_force;
        let mut worst = 0.0;
        for (mode, said) in [record.normal_force, x, y].into_iter().enumerate() {
            worst.raise(over(said - found[mode], units[mode]));
        }
        let peak = largest(p);
        worst.raise(over(record.max_pressure - peak, peak));
        let shear = q[0].iter().zip(&q[1]).fold(0.0_f64, |most, (x, y)| most.max(x.hypot(*y)));
        worst.raise(over(record.max_shear - shear, shear));
        let count = |wanted: Zone| zone.iter().filter(|&&zone| zone == wanted).count();
        let (stick, slip) = (count(Zone::Stick), count(Zone::Slip));
        let loaded = p.iter().filter(|p| **p > 0.0).count();
        let open = zone.iter().zip(p).all(|(zone, p)| (*zone == Zone::Open) == (*p == 0.0));
        let regime = match (loaded, stick) {
            (0, _) => Regime::Apart,
            _ if self.bound().sum() == 0.0 => Regime::Frictionless,
            (_, 0) => Regime::GrossSlip,
            _ if slip == 0 => Regime::FullStick,
            _ => Regime::PartialSlip,
        };
        let facts = [
            open,
            record.contact_cells == loaded,
            record.stick_cells == stick,
            record.regime == regime,
            (record.contact_area > 0.0) == (loaded > 0),
        ];
        worst.raise(if facts.contains(&false) { 1.0 } else { 0.0 });
        let share = stick as f64 / loaded.max(1) as f64;
        worst.raise(over(record.stick_area - share * record.contact_area, record.contact_area));
        worst
    }
}

/// A worst value so far.
trait Raise {
    /// Takes the larger one; what is not a number stays.
    fn raise(&mut self, value: f64);
}

impl Raise for f64 {
    fn raise(&mut self, value: f64) {
        if value.is_nan() || value.abs() > *self {
            *self = value.abs();
        }
    }
}

/// A deviation in its unit; none at all where the unit is nothing as well.
fn over(deviation: f64, unit: f64) -> f64 {
    if deviation == 0.0 { 0.0 } else { (deviation / unit).abs() }
}

fn size(values: &[f64]) -> f64 {
    values.iter().filter(|value| value.is_finite()).fold(0.0, |most, value| value.abs().max(most))
}

fn largest(field: &Array2<f64>) -> f64 {
    field.iter().fold(0.0, |most, value| value.abs().max(most))
}

fn hypot([x, y]: [f64; 2]) -> f64 {
    x.hypot(y)
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// Nearest point of a disc.
fn project(q: [f64; 2], bound: f64) -> [f64; 2] {
    let length = hypot(q);
    if length <= bound { q } else { q.map(|q| q * (bound / length)) }
}
