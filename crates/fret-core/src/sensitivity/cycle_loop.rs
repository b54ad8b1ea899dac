//! Numbers of the loop of force and displacement of a cycle as results: each changes with forces, motions, slip and energies at the ends of its
//! increments.

use super::field_weights::{RegionWeights, SLIP};
use super::parameter::Parameter;
use super::row::{Column, Composed};
use super::scene::Scene;
use super::snapshot::Snapshot;
use crate::fields::{Scalar, Slopes};
use crate::history::{CYCLE_COLUMNS, CycleRecord};
use crate::model::ContactState;
use crate::run::{CycleReading, Point, last_to_slide};

/// Columns of a cycle that are read from its loop.
pub(super) const COLUMNS: [&str; 11] = [
    "direction",
    "force_amplitude",
    "displacement_amplitude",
    "opening",
    "energy_ratio",
    "sliding_ratio",
    "stiffness",
    "actuator_amplitude",
    "actuator_energy_ratio",
    "actuator_sliding_ratio",
    "actuator_stiffness",
];

/// Columns of increments that a point of the loop is made of; besides them the way that all of the contact has slid.
const OF_POINT: [&str; 8] = [
    "tangential_force_x",
    "tangential_force_y",
    "twist_moment",
    "shift_x",
    "shift_y",
    "twist",
    "dissipated_energy",
    "bulk_work",
];
const ENERGIES: [usize; 2] = [6, 7];
const SLID: usize = 8;
const INPUTS: usize = 9;

/// Which numbers derivatives are taken by.
#[derive(Clone, Copy, PartialEq, Eq)]
enum By {
    Point(usize),
    Rig,
}

/// The loop of a cycle of a history.
struct CycleLoop {
    points: Vec<[f64; INPUTS]>,
    rig: Option<[f64; 2]>,
}

/// The number of a column of a cycle; `None` where that has none.
pub(super) fn of_loop(
    scene: &Scene<'_>,
    (run, cycle): (&[&Snapshot], &CycleRecord),
    column: &str,
    parameters: &[Parameter],
) -> Option<Composed> {
    let value = value_of(cycle, column)?;
    let case = &scene.plan.case;
    let (first, last) = (cycle.first_increment, cycle.last_increment);
    let increments = || [first.checked_sub(1)].into_iter().chain((first..=last).map(Some));
    let slides: Vec<_> =
        increments().map(|at| at.filter(|at| *at >= first).and_then(|at| slide(run, at))).collect();
    let mut points: Vec<[f64; INPUTS]> = increments()
        .zip(&slides)
        .map(|(at, slides)| {
            let mut point = at.map_or([0.0; INPUTS], |at| inputs(run[at]));
            point[SLID] = slides.map_or(0.0, |(_, [x, y])| x.hypot(y));
            point
        })
        .collect();
    // The record of the last increment has the energies of all cycles that this one stands for.
    let each = 1.0 / cycle.stands_for as f64;
    let count = points.len();
    for energy in ENERGIES {
        let start = points[0][energy];
        points[count - 1][energy] = start + each * (points[count - 1][energy] - start);
    }
    let loop_of = CycleLoop { points, rig: case.rig.map(|rig| rig.tangential) };
    let mut columns = Vec::new();
    for (place, at) in increments().enumerate() {
        let Some(at) = at else { continue };
        let by = loop_of.number(column, By::Point(place))?.by;
        for (input, name) in OF_POINT.into_iter().enumerate() {
            let shared = place + 1 == count && ENERGIES.contains(&input);
            columns.push((at, Column::Named(name), if shared { each * by[input] } else { by[input] }));
            if let (true, Some(start)) = (shared, first.checked_sub(1)) {
                columns.push((start, Column::Named(name), (1.0 - each) * by[input]));
            }
        }
        let way = loop_of.points[place][SLID];
        if let Some(([i, j], slip)) = slides[place].filter(|_| by[SLID] != 0.0 && way > 0.0) {
            let [[rows, columns_before], [_, width]] = [scene.region.origin, scene.region.shape];
            let cell = (i - rows) * width + (j - columns_before);
            for axis in 0..2 {
                let mut weights = vec![0.0; scene.region.len()];
                weights[cell] = slip[axis] / way;
                let column = Column::Field(RegionWeights { field: SLIP + axis, weights: weights.into() });
                columns.push((at, column, by[SLID]));
            }
        }
    }
    columns.retain(|(.., weight)| *weight != 0.0);
    let by_rig = loop_of.number(column, By::Rig)?.by;
    let of = |parameter: &Parameter| {
        let [_, x, y] = parameter.change_of_rig(case);
        by_rig[0] * x + by_rig[1] * y
    };
    Some(Composed { value, columns, by: parameters.iter().map(of).collect() })
}

impl CycleLoop {
    /// A number of it, with its derivatives.
    fn number(&self, column: &str, by: By) -> Option<Slopes<INPUTS>> {
        let point = |(place, inputs): (usize, &[f64; INPUTS])| {
            let inputs =
                if by == By::Point(place) { Slopes::of_each(*inputs) } else { inputs.map(Slopes::of) };
            let [x, y, moment, shift_x, shift_y, twist, dissipated, by_bulk, slid] = inputs;
            let (force, shift) = ([x, y], [shift_x, shift_y]);
            let point = Point { force, moment, shift, twist, slid, dissipated: dissipated - by_bulk };
            (point, dissipated)
        };
        let (points, dissipated): (Vec<_>, Vec<_>) = self.points.iter().enumerate().map(point).unzip();
        let dissipated = *dissipated.last()? - *dissipated.first()?;
        let rig = self.rig.map(|[x, y]| {
            let mut inputs = [0.0; INPUTS];
            (inputs[0], inputs[1]) = (x, y);
            let [x, y, ..] = if by == By::Rig { Slopes::of_each(inputs) } else { inputs.map(Slopes::of) };
            [x, y]
        });
        let found = CycleReading::of(&points, dissipated, rig);
        let (read, far) = (&found.read, found.at_actuator);
        match column {
            "direction" => Some(found.direction),
            "force_amplitude" => Some(read.force_amplitude),
            "displacement_amplitude" => Some(read.displacement_amplitude),
            "opening" => Some(read.opening),
            "energy_ratio" => found.energy_ratio(read),
            "sliding_ratio" => read.sliding_ratio(),
            "stiffness" => read.stiffness,
            "actuator_amplitude" => Some(far?.displacement_amplitude),
            "actuator_energy_ratio" => found.energy_ratio(&far?),
            "actuator_sliding_ratio" => far?.sliding_ratio(),
            "actuator_stiffness" => far?.stiffness,
            _ => None,
        }
    }
}

/// Value of a column in the record of a cycle.
fn value_of(cycle: &CycleRecord, column: &str) -> Option<f64> {
    CYCLE_COLUMNS.iter().find(|known| known.name == column)?.number(cycle)
}

/// What a point is made of, without its slip.
fn inputs(step: &Snapshot) -> [f64; INPUTS] {
    let record = &step.record;
    let ([x, y], [shift_x, shift_y]) = (record.tangential_force, record.shift);
    let energies = [record.dissipated_energy, record.bulk_work];
    [x, y, record.twist_moment, shift_x, shift_y, record.twist, energies[0], energies[1], 0.0]
}

/// The cell that was the last to slide in an increment, where all do, and its slip.
fn slide(run: &[&Snapshot], increment: usize) -> Option<([usize; 2], [f64; 2])> {
    let after = run[increment].state();
    let before = increment.checked_sub(1).map(|before| run[before].state());
    let before = before.unwrap_or_else(|| ContactState::untouched(after.zone.dim().into()));
    last_to_slide(&before, &after)
}
