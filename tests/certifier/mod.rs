//! Judges a run from what it left behind: kept fields and records of increments that follow each other, and the case. Every
//! law is computed again, in double precision and by plain sums over cells; nothing of the solver is used.
//!
//! Of the library it takes the case (loads, friction, undeformed gap) and the influence coefficients, which are compared with
//! independent tables elsewhere (`coefficient_regimes.rs`, `coefficient_tables.rs`).

mod certificate;
mod increment;
mod influence;
mod measure;
mod run;
mod slip_path;

use std::cell::OnceCell;

use fret_core::case::Stage;
use fret_core::history::{KeptFields, StepRecord};
use fret_core::model::{Base, Body, ContactPair, Control, CoulombFriction, Integration, LoadStep, Zone};
use fret_core::plan::Plan;
use increment::{Fields, Increment};
use influence::Influence;
use ndarray::Array2;
use slip_path::Past;

pub use certificate::{Certificate, ON_CIRCLE, SAME};
pub use increment::dissipated;
pub use run::{Ended, Kept, KeptPart, run_certified};

/// Certificates of a run, increment by increment from the first on; of one that was solved in parts one of each part.
///
/// # Errors
/// When a field that has to be judged was not kept.
pub fn certify(plan: &Plan, run: &[Kept]) -> Result<Vec<Certificate>, String> {
    let mut certifier = Certifier::new(plan);
    let mut certificates = Vec::with_capacity(run.len());
    // Before the first cycle ends.
    let unworn = plan.case.wear.as_ref().map(|_| Array2::zeros(plan.grid.cells()));
    let mut worn = unworn.as_ref();
    for Kept { record, fields, parts } in run {
        let mut record = record.clone();
        if let Some((last, others)) = parts.split_last() {
            for KeptPart { share, record, fields } in others {
                // Nothing is worn off within an increment.
                let fields = KeptFields { worn_depth: worn.cloned(), ..fields.clone() };
                certificates.push(certifier.next((record, *share), &fields)?);
            }
            (record.parts, record.work) = (1, last.record.work);
        }
        certificates.push(certifier.next((&record, 1.0), fields)?);
        worn = fields.worn_depth.as_ref();
    }
    Ok(certificates)
}

/// Goes through a run with its operator and what the increment before left.
pub struct Certifier<'a> {
    plan: &'a Plan,
    influence: Influence,
    undeformed: Array2<f64>,
    before: Before,
    past: Past,
    /// Increments since one whose parts are not known.
    whole: usize,
}

/// Strain of the lower surface less that of the upper one under the bulk stresses of their substrates: Hooke's law.
fn relative_strain(bodies: &ContactPair, plane_strain: bool, stress: [[f64; 2]; 2]) -> [f64; 2] {
    let of = |body: &Body, [x, y]: [f64; 2]| {
        let Body::Elastic(half_space) = body else { return [0.0; 2] };
        let Base::Elastic(material) = half_space.base() else { return [0.0; 2] };
        let (young, nu) = (material.young(), material.poisson());
        if plane_strain {
            // Held along y: s_y = nu s_x.
            return [(x - nu * nu * x) / young, 0.0];
        }
        [(x - nu * y) / young, (y - nu * x) / young]
    };
    let (lower, upper) = (of(bodies.lower(), stress[0]), of(bodies.upper(), stress[1]));
    [lower[0] - upper[0], lower[1] - upper[1]]
}

/// The friction of a stage, as the case gives it.
fn law_of(plan: &Plan, stage: usize) -> &CoulombFriction {
    let mut latest_first = plan.case.stages[..=stage].iter().rev();
    latest_first.find_map(|stage| stage.friction.as_ref()).unwrap_or(&plan.case.friction)
}

/// What an increment leaves to the next one.
struct Before {
    pressure: Array2<f64>,
    slip: [Array2<f64>; 2],
    shear: [Array2<f64>; 2],
    worn: Option<Array2<f64>>,
    tangential: [Array2<f64>; 2],
    approach: f64,
    shift: [f64; 2],
    twist: f64,
    tilt: [f64; 2],
    tilt_moment: [f64; 2],
    /// Strain of the lower surface less that of the upper one.
    strain: [f64; 2],
    bulk_work: f64,
    /// Gap and normal displacement.
    gap: Array2<f64>,
    normal: Array2<f64>,
    energy: f64,
    /// Stage, number of the increment in it and the share of its way, what the stage found prescribed, what is prescribed now.
    stage: usize,
    k: usize,
    share: f64,
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
        let free =
            LoadStep { normal: Control::Force(0.0), tangential: [Control::Force(0.0); 2], ..LoadStep::FREE };
        Self {
            plan,
            influence: Influence::new(&case.bodies, &plan.grid, case.periodic, plan.datum),
            undeformed: case.profile.gap(&plan.grid),
            past: Past { repeats: case.periodic.axes(), ..Past::default() },
            whole: 2,
            before: Before {
                slip: [zero(), zero()],
                shear: [zero(), zero()],
                worn: case.wear.as_ref().map(|_| zero()),
                pressure: zero(),
                tangential: [zero(), zero()],
                approach: 0.0,
                shift: [0.0; 2],
                twist: 0.0,
                tilt: [0.0; 2],
                tilt_moment: [0.0; 2],
                strain: [0.0; 2],
                bulk_work: 0.0,
                gap: case.profile.gap(&plan.grid),
                normal: zero(),
                energy: 0.0,
                stage: usize::MAX,
                k: 0,
                share: 1.0,
                found: free,
                held: free,
                reached: [0.0; 4],
            },
        }
    }

    /// Judges the next increment, or the part of it that ends at a share of its way, and goes on from there.
    ///
    /// # Errors
    /// When pressure, shear, slip, gap or zone was not kept.
    pub fn next(
        &mut self,
        (record, share): (&StepRecord, f64),
        fields: &KeptFields,
    ) -> Result<Certificate, String> {
        let KeptFields {
            pressure: Some(p),
            shear: Some(q),
            slip: Some(slip),
            gap: Some(gap),
            zone: Some(zone),
            friction,
            ..
        } = fields
        else {
            return Err(format!("increment {}: a field was not kept", record.increment));
        };
        let begins_stage = self.before.stage != record.stage;
        let load = self.prescribed(record.stage, share);
        let case = &self.plan.case;
        let evolved = friction.clone().filter(|_| case.friction_evolution.is_some());
        let evolved = evolved.and_then(|map| CoulombFriction::map(map).ok());
        let evolved = evolved.map(|law| law.with_max_shear_of(&case.friction));
        let law = evolved.as_ref().unwrap_or_else(|| law_of(self.plan, record.stage));
        // Where friction has changed at once nothing goes on from before.
        let [own, of_last] =
            [record.stage, record.stage.saturating_sub(1)].map(|stage| law_of(self.plan, stage));
        if begins_stage && own != of_last {
            let last = self.past.loads.len().saturating_sub(1);
            self.past.loads.drain(..last);
        }
        let displacements = self.influence.displacements(p, q);
        let of_second_order =
            case.integration == Integration::SecondOrder && record.work.end_point_increments == 0;
        let ratio = self.past.ratio_to(&load).filter(|_| of_second_order);
        let pace = ratio.map(|ratio| self.past.pace(&load, ratio));
        let strain = relative_strain(&case.bodies, case.is_line(), record.bulk_stress);
        let increment = Increment {
            grid: &self.plan.grid,
            influence: &self.influence,
            undeformed: &self.undeformed,
            before: &self.before,
            zone_before: self.past.zone.as_ref().filter(|_| case.integration == Integration::SecondOrder),
            record,
            slides: !case.is_frictionless(),
            jumps: case.wear.is_some() || case.friction_evolution.is_some(),
            law,
            load,
            fields: Fields { p, q, slip, gap, zone },
            displacements: &displacements,
            past: pace.map(|pace| (&self.past, pace)),
            is_known: self.whole >= 2 || case.integration == Integration::EndPoint,
            strain,
        };
        let certificate = increment.certificate();
        let drift = increment.drift();
        let slipping = zone.indexed_iter().filter(|(_, zone)| **zone == Zone::Slip);
        let largest_slip = slipping.map(|(at, _)| drift[0][at].hypot(drift[1][at])).fold(0.0, f64::max);
        let [normal, x, y] = displacements;
        self.whole = if record.parts == 1 { self.whole + 1 } else { 0 };
        let before = &mut self.before;
        let past = &mut self.past;
        // An increment in which nothing changes leaves what is known of those before as it is.
        let pauses = past.loads.last() == Some(&load) && !past.is_cut;
        past.is_cut = before.worn != fields.worn_depth;
        if past.is_cut {
            past.loads.push(load);
            *past = Past {
                repeats: past.repeats,
                loads: std::mem::take(&mut past.loads),
                is_cut: true,
                ..Past::default()
            };
        } else if pauses {
            past.gap[0] = Some(gap.clone());
        } else {
            past.loads.push(load);
            let (drift_before, gap_before) = (past.drift[0].take(), past.gap[0].take());
            let goes_on = pace.is_some_and(|pace| pace.edge.is_some());
            past.knew_touch = goes_on && gap_before.is_some() && past.gap[1].is_some();
            past.drift = [Some(drift), drift_before.filter(|_| ratio.is_some())];
            past.gap = [Some(gap.clone()), gap_before.filter(|_| ratio.is_some())];
            past.pressure = Some(before.pressure.clone());
            past.ratio = ratio.unwrap_or(1.0);
            past.largest_slip = largest_slip;
        }
        past.zone = Some(zone.clone());
        past.edge_slip = OnceCell::new();
        past.shear = Some(q.clone());
        before.tangential = [x, y];
        before.pressure.clone_from(p);
        before.slip.clone_from(slip);
        before.shear.clone_from(q);
        before.worn.clone_from(&fields.worn_depth);
        (before.approach, before.shift, before.twist) = (record.approach, record.shift, record.twist);
        (before.tilt, before.tilt_moment) = (record.tilt, record.tilt_moment);
        before.strain = strain;
        before.bulk_work = record.bulk_work;
        before.gap.clone_from(gap);
        before.normal = normal;
        before.energy = record.dissipated_energy;
        before.held = load;
        let [force_x, force_y] = record.tangential_force;
        before.reached = [record.normal_force, force_x, force_y, record.twist_moment];
        Ok(certificate)
    }

    /// What the case prescribes for the next increment of a stage, at a share of its way: that is straight.
    fn prescribed(&mut self, number: usize, share: f64) -> LoadStep {
        let before = &mut self.before;
        let stage: &Stage = &self.plan.case.stages[number];
        if before.stage != number {
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
            let held = &before.held;
            let tilt = [0, 1].map(|axis| match (&stage.tilt[axis], held.tilt[axis]) {
                (Some(control), Control::Force(_)) if control.is_motion() => {
                    Control::Motion(before.tilt[axis])
                }
                (Some(control), Control::Motion(_)) if !control.is_motion() => {
                    Control::Force(before.tilt_moment[axis])
                }
                (_, held) => held,
            });
            let bulk_stress = held.bulk_stress;
            before.found = LoadStep { normal, tangential: [x, y], twist, tilt, bulk_stress, roll: held.roll };
            if let Some(last) = self.past.loads.last_mut() {
                (last.normal, last.tangential) = (normal, [x, y]);
            }
            (before.stage, before.k, before.share) = (number, 0, 1.0);
        }
        if before.share >= 1.0 {
            before.k += 1;
        }
        before.share = share;
        let start = if before.k == 1 { before.found } else { stage.load(&before.found, before.k - 1) };
        let mut controls = stage.load(&before.found, before.k).controls();
        for (to, from) in controls.iter_mut().zip(start.controls()).filter(|_| share < 1.0) {
            let value = from.value() + (to.value() - from.value()) * share;
            *to = match to {
                Control::Force(_) => Control::Force(value),
                Control::Motion(_) => Control::Motion(value),
                Control::FarEnd(_) => Control::FarEnd(value),
            };
        }
        LoadStep::of(controls)
    }
}
