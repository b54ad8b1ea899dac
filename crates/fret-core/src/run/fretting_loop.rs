//! The loop of force and displacement that a cycle runs through, followed.

use ndarray::Array2;
use serde::{Deserialize, Serialize};

use super::cycle_reading::{CycleReading, Point};
use super::evolving::Evolved;
use super::recording::mean_coefficient;
use super::thinning::LayersWorn;
use crate::fields::stored;
use crate::history::{
    CycleRecord, CycleRegime, DebrisRecord, Drive, Regime, SLIDING_ENERGY_RATIO, StepRecord,
};
use crate::model::{ContactState, CoulombFriction, Rig, Zone};
use crate::solver::friction_bounds;

/// The cell that slips least in the increment between two states, and its slip [length]: those that slip last are the last to have let go. `None`
/// where some cells stick.
pub fn last_to_slide(before: &ContactState, after: &ContactState) -> Option<([usize; 2], [f64; 2])> {
    let (mut least, mut found) = (f64::INFINITY, None);
    for ((i, j), zone) in after.zone.indexed_iter() {
        let at = [i, j];
        if *zone == Zone::Stick {
            return None;
        }
        if *zone == Zone::Slip && before.zone[at] != Zone::Open {
            let [x, y] = [0, 1].map(|axis| after.slip[axis][at] - before.slip[axis][at]);
            if x.hypot(y) < least {
                (least, found) = (x.hypot(y), Some((at, [x, y])));
            }
        }
    }
    found
}

/// Way by which all of the contact has slid at the end of the increment between two states [length]; 0 where some cells stick.
pub fn slid(before: &ContactState, after: &ContactState) -> f64 {
    last_to_slide(before, after).map_or(0.0, |(_, [x, y])| x.hypot(y))
}

/// What the end of a cycle is compared with, besides the first point.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct Start {
    #[serde(with = "stored")]
    pressure: Array2<f64>,
    #[serde(with = "stored")]
    shear: [Array2<f64>; 2],
    approach: f64,
    dissipated_energy: f64,
    unresolved_energy: f64,
    bulk_work: f64,
}

/// Follows one cycle.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FrettingLoop {
    stage: usize,
    cycle: usize,
    first_increment: usize,
    start: Start,
    points: Vec<Point>,
    regimes: Vec<Regime>,
    contact_area: f64,
}

/// What a run knows about a finished cycle beside its loop.
#[derive(Debug, Clone, Copy)]
pub struct CycleEnd {
    /// Cycles it stands for.
    pub stands_for: usize,
    /// Cycles of its stage that are over with them.
    pub last_cycle: usize,
    /// Closure below which the stage ends.
    pub tolerance: Option<f64>,
    /// Volume worn off so far, and largest worn depth.
    pub worn: [f64; 2],
    /// The debris between the surfaces, where some stays.
    pub debris: Option<DebrisRecord>,
    /// What became of friction, where it evolves.
    pub evolved: Option<Evolved>,
    /// What is known of the layers that wear.
    pub layers: Option<LayersWorn>,
    /// Relative error of the wear depth by the cycle jump before, where it is looked at.
    pub wear_jump_error: Option<f64>,
    /// The machine, where it gives.
    pub rig: Option<Rig>,
}

impl FrettingLoop {
    /// A cycle that starts from a state with the given tangential force and moment.
    pub fn new(
        (stage, cycle): (usize, usize),
        first_increment: usize,
        state: &ContactState,
        force: [f64; 2],
        moment: f64,
    ) -> Self {
        let first = Point {
            force,
            moment,
            shift: state.shift,
            twist: state.twist,
            slid: 0.0,
            dissipated: state.dissipated_energy - state.bulk_work,
        };
        Self {
            stage,
            cycle,
            first_increment,
            start: Start {
                pressure: state.pressure.clone(),
                shear: state.shear.clone(),
                approach: state.approach,
                dissipated_energy: state.dissipated_energy,
                unresolved_energy: state.unresolved_energy,
                bulk_work: state.bulk_work,
            },
            points: vec![first],
            regimes: Vec::new(),
            contact_area: 0.0,
        }
    }

    /// Whether this follows a cycle of a stage on a grid of `cells`.
    pub fn fits(&self, stage: usize, cells: [usize; 2]) -> bool {
        let Start { pressure, shear: [x, y], .. } = &self.start;
        self.stage == stage
            && self.points.len() == self.regimes.len() + 1
            && [pressure, x, y].iter().all(|field| field.dim() == cells.into())
    }

    /// Area of contact after the last increment [length^2].
    pub fn contact_area(&self) -> f64 {
        self.contact_area
    }

    /// Adds an increment, at whose end all of the contact has `slid` by a way [length].
    pub fn add(&mut self, record: &StepRecord, slid: f64) {
        self.points.push(Point {
            slid,
            dissipated: record.dissipated_energy - record.bulk_work,
            force: record.tangential_force,
            moment: record.twist_moment,
            shift: record.shift,
            twist: record.twist,
        });
        self.regimes.push(record.regime);
        self.contact_area = record.contact_area;
    }

    /// Adds the energies of the other cycles that this one, which ends in `state`, stands for. They store nothing.
    pub fn repeat(&self, state: &mut ContactState, stands_for: usize) {
        let others = stands_for.saturating_sub(1) as f64;
        let start = &self.start;
        let dissipated = others * (state.dissipated_energy - start.dissipated_energy);
        let unresolved = others * (state.unresolved_energy - start.unresolved_energy);
        state.bulk_work += others * (state.bulk_work - start.bulk_work);
        state.external_work += dissipated + unresolved;
        state.dissipated_energy += dissipated;
        state.unresolved_energy += unresolved;
    }

    /// The record of the cycle that ends in `state`.
    pub fn close(&self, state: &ContactState, friction: &CoulombFriction, end: CycleEnd) -> CycleRecord {
        let dissipated_energy = state.dissipated_energy - self.start.dissipated_energy;
        let rig = end.rig.map(|rig| rig.tangential);
        let reading = CycleReading::of(&self.points, dissipated_energy, rig);
        let CycleReading { drive, direction, read, at_actuator, .. } = reading;
        let energy_ratio = reading.energy_ratio(&read);
        let closure = self.closure(state, friction);
        CycleRecord {
            stage: self.stage,
            cycle: self.cycle,
            first_increment: self.first_increment,
            last_increment: self.first_increment + self.regimes.len().saturating_sub(1),
            stands_for: end.stands_for,
            last_cycle: end.last_cycle,
            dissipated_energy,
            total_dissipated_energy: state.dissipated_energy
                + end.stands_for.saturating_sub(1) as f64 * dissipated_energy,
            drive,
            direction,
            force_amplitude: read.force_amplitude,
            displacement_amplitude: read.displacement_amplitude,
            opening: read.opening,
            energy_ratio,
            sliding_ratio: read.sliding_ratio(),
            stiffness: read.stiffness,
            regime: self.regime(drive, energy_ratio),
            closure,
            steady: end.tolerance.is_some_and(|tolerance| closure <= tolerance),
            worn_volume: end.worn[0],
            max_worn_depth: end.worn[1],
            friction_coefficient: mean_coefficient(friction, &state.pressure),
            friction_change: end.evolved.map(|evolved| evolved.change),
            jump_error: end.evolved.map(|evolved| evolved.jump_error),
            lower_worn_depth: end.layers.map(|layers| layers.depths[0]),
            upper_worn_depth: end.layers.map(|layers| layers.depths[1]),
            compliance_spread: end.layers.and_then(|layers| layers.compliance_spread),
            wear_jump_error: end.wear_jump_error,
            debris_volume: end.debris.map(|debris| debris.volume),
            debris_outflow: end.debris.map(|debris| debris.outflow),
            actuator_amplitude: at_actuator.map(|far| far.displacement_amplitude),
            actuator_energy_ratio: at_actuator.and_then(|far| reading.energy_ratio(&far)),
            actuator_sliding_ratio: at_actuator.and_then(|far| far.sliding_ratio()),
            actuator_stiffness: at_actuator.and_then(|far| far.stiffness),
        }
    }

    fn regime(&self, drive: Drive, energy_ratio: Option<f64>) -> Option<CycleRegime> {
        let any = |wanted: Regime| self.regimes.contains(&wanted);
        if !any(Regime::PartialSlip) && !any(Regime::GrossSlip) {
            return any(Regime::FullStick).then_some(CycleRegime::FullStick);
        }
        let slides = any(Regime::GrossSlip);
        // Twisting has no such bound: the twist grows beyond all bounds before the last cell slips.
        let by_energy = match drive {
            Drive::Tangential => energy_ratio.is_some_and(|ratio| ratio >= SLIDING_ENERGY_RATIO),
            Drive::Torsional => slides,
        };
        Some(match (slides, by_energy) {
            (false, false) => CycleRegime::PartialSlip,
            (true, true) => CycleRegime::GrossSlip,
            _ => CycleRegime::Mixed,
        })
    }

    fn closure(&self, state: &ContactState, friction: &CoulombFriction) -> f64 {
        let distance =
            |a: &Array2<f64>, b: &Array2<f64>| -> f64 { a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum() };
        let pressure = state.pressure.iter().map(|p| p * p).sum::<f64>();
        let bound: f64 = friction_bounds(friction, &state.pressure).iter().map(|bound| bound.powi(2)).sum();
        let share = |change: f64, whole: f64| if whole > 0.0 { (change / whole).sqrt() } else { 0.0 };
        let shear =
            distance(&state.shear[0], &self.start.shear[0]) + distance(&state.shear[1], &self.start.shear[1]);
        let radius = (self.contact_area / std::f64::consts::PI).sqrt();
        let range = |value: fn(&Point) -> f64| {
            let ends = self
                .points
                .iter()
                .map(value)
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
            ends.1 - ends.0
        };
        let moved = range(|p| p.shift[0]).hypot(range(|p| p.shift[1])) + radius * range(|p| p.twist);
        let first = &self.points[0];
        let [x, y] = [0, 1].map(|axis| state.shift[axis] - first.shift[axis]);
        let drift = x.hypot(y) + radius * (state.twist - first.twist).abs();
        let approach = (state.approach - self.start.approach).abs();
        [
            share(distance(&state.pressure, &self.start.pressure), pressure),
            share(shear, bound),
            if moved > 0.0 { drift / moved } else { 0.0 },
            if state.approach == 0.0 { 0.0 } else { approach / state.approach.abs() },
        ]
        .into_iter()
        .fold(0.0, f64::max)
    }
}
