//! From a solved region to the state after the increment: what every cell did, what friction dissipated and elasticity stored, resultants
//! and residuals.

use ndarray::Array2;

use super::contact_set::ContactSet;
use super::energy::StateBefore;
use super::increment_problem::{IncrementProblem, Solved};
use super::laws::friction::{dissipation, is_inside, slip_until_open, slips};
use super::laws::slip_path::length_of_way;
use super::outcome::{Outcome, Regime, Residual, Resultants};
use crate::fields::{length, sum};
use crate::model::{ContactState, Integration, Zone};

/// The state after an increment from `start`, and what happened. `self_influence`: of the shear of a cell [length/pressure]; `by_cell`: where
/// it is asked for, what friction dissipates in each cell by area [pressure x length], zero before.
pub(super) fn state_after(
    problem: &IncrementProblem<'_>,
    solved: &Solved,
    start: &StateBefore,
    (self_influence, integration): (f64, Integration),
    mut by_cell: Option<&mut Array2<f64>>,
) -> (ContactState, Outcome) {
    let stiffness = if self_influence > 0.0 { 1.0 / self_influence } else { 0.0 };
    let solution = &solved.solution;
    let IncrementProblem { grid, region, state: before, .. } = *problem;
    let pressure = &solved.tractions.pressure;
    let contact = ContactSet::loaded(pressure);
    let bound = problem.friction.packed(&contact).bound(&contact.packed(pressure)).bound;
    let law_before = problem.friction_before.as_ref().unwrap_or(&problem.friction);
    let of_before = contact.packed(&region.gathered(&before.pressure));
    let bound_before = law_before.packed(&contact).bound(&of_before).bound;
    let shear = contact.packed_tangential(&solved.tractions.shear);
    let [slip, end_slip] = [&solution.slip, &solution.end_slip].map(|field| contact.packed_tangential(field));
    let mut state = tractions_and_motions(problem, solved);
    let mut stick_cells = 0;
    let mut moment = 0.0;
    let (mut tilt_moment, mut second_moment) = ([0.0; 2], [0.0; 2]);
    let mut dissipated = 0.0;
    let mut dissipate = |at: [usize; 2], work: f64| {
        dissipated += work;
        if let Some(by_cell) = &mut by_cell {
            by_cell[at] = work;
        }
    };
    let mut stored = 0.0;
    let moved = &solved.displacements;
    for (place, cell) in contact.cells().enumerate() {
        let at = region.at(cell);
        let [q, end] = [shear.at(place), end_slip.at(place)];
        moment += problem.moment_of(at, q);
        for axis in 0..2 {
            let place = problem.stretch.middle[axis] + grid.centre(axis, at[axis]);
            tilt_moment[axis] += place * pressure[cell];
            second_moment[axis] += place * place * pressure[cell];
        }
        let [ux, uy] = moved.tangential.at_or_zero(cell);
        stored += pressure[cell] * moved.normal[cell] + q[0] * ux + q[1] * uy;
        let (zone, slip) = if slips(q, end, bound[place], stiffness) {
            (Zone::Slip, slip.at(place))
        } else if problem.pauses && before.zone[at] == Zone::Slip && !is_inside(q, bound[place]) {
            (Zone::Slip, [0.0; 2]) // on the verge, as before
        } else {
            stick_cells += 1;
            (Zone::Stick, [0.0; 2])
        };
        // A contact that travels counts all of an increment's slip: in cells that enter it and in those that it leaves behind, under the mean
        // of their bounds before and after, of which one is zero. So the sum over all cells is that of a contact which stays.
        let is_entered = before.zone[at] == Zone::Open && !problem.travels;
        let slip = problem.path.counted(cell, slip, is_entered);
        state.zone[at] = zone;
        for axis in 0..2 {
            state.slip[axis][at] += slip[axis];
        }
        let shear_before = [0, 1].map(|axis| before.shear[axis][at]);
        let zones = [before.zone[at], zone];
        let way = length_of_way(integration, slip, zones, [shear_before, q]);
        dissipate(at, dissipation([bound_before[place], bound[place]], way));
    }
    for cell in (0..region.len()).filter(|&cell| problem.touched && pressure[cell] <= 0.0) {
        let at = region.at(cell);
        let shear = [0, 1].map(|axis| before.shear[axis][at]);
        if shear == [0.0; 2] {
            continue;
        }
        let ((bound, _), drift) = (law_before.at(cell, before.pressure[at]), solved.drift.at_or_zero(cell));
        let slip = if problem.travels { drift } else { slip_until_open(drift, shear, bound) };
        for axis in 0..2 {
            state.slip[axis][at] += slip[axis];
        }
        dissipate(at, dissipation([bound, 0.0], length(slip)));
    }
    let area = grid.cell_area();
    let area_of_copies = area * problem.copies as f64;
    state.elastic_energy = 0.5 * stored * area_of_copies;
    let by_bulk = bulk_work(problem, &state);
    state.bulk_work += by_bulk * area_of_copies;
    problem.account(solved, start, [dissipated, by_bulk], &mut state);
    let limit = sum(&bound);
    let resultants = Resultants {
        normal: sum(pressure) * area,
        tangential: [sum(&shear.x) * area, sum(&shear.y) * area],
        moment: moment * area,
        tilt_moment: tilt_moment.map(|moment| moment * area),
    };
    let regime = match (contact.len(), stick_cells) {
        (0, _) => Regime::Apart,
        _ if limit == 0.0 => Regime::Frictionless,
        (_, 0) => Regime::GrossSlip,
        (all, stick) if all == stick => Regime::FullStick,
        _ => Regime::PartialSlip,
    };
    let residual = Residual {
        complementarity: solution.normal.residual,
        coulomb: solution.tangential.residual,
        equilibrium: off_equilibrium(problem, &resultants, limit * area).max(off_moments(
            problem,
            &resultants,
            second_moment.map(|sum| sum * area),
        )),
    };
    let contact_cells = contact.len();
    let outcome = Outcome { resultants, contact_cells, stick_cells, regime, residual };
    (state, outcome)
}

impl IncrementProblem<'_> {
    /// The arm of a cell: from what the bodies turn about to where it is [length].
    pub(super) fn arm(&self, at: [usize; 2]) -> [f64; 2] {
        let pole = self.positions.pole();
        [0, 1].map(|axis| self.grid.centre(axis, at[axis]) - pole[axis])
    }

    /// The moment of a shear in a cell by its arm [pressure x length].
    fn moment_of(&self, at: [usize; 2], shear: [f64; 2]) -> f64 {
        let [x, y] = self.arm(at);
        x * shear[1] - y * shear[0]
    }
}

/// Tractions and motions after an increment; slip, zones and dissipated energy are still those before.
fn tractions_and_motions(problem: &IncrementProblem<'_>, solved: &Solved) -> ContactState {
    let IncrementProblem { grid, region, state: before, .. } = *problem;
    let mut state = ContactState::untouched(grid.cells());
    state.worn_depth.clone_from(&before.worn_depth);
    state.upper_worn_depth.clone_from(&before.upper_worn_depth);
    state.debris.clone_from(&before.debris);
    state.plastic_depth = problem.plastic_depth(solved);
    state.accumulated.clone_from(&before.accumulated);
    region.place(&solved.tractions.pressure, &mut state.pressure);
    region.place(&solved.tractions.shear.x, &mut state.shear[0]);
    region.place(&solved.tractions.shear.y, &mut state.shear[1]);
    for (slip, before) in state.slip.iter_mut().zip(&before.slip) {
        if before.iter().any(|slip| *slip != 0.0) {
            slip.assign(before);
        }
    }
    let [shift_x, shift_y, turned] = solved.solution.tangential.motion;
    state.approach = solved.solution.normal.approach;
    state.shift = [before.shift[0] + shift_x, before.shift[1] + shift_y];
    state.twist = before.twist + turned / problem.positions.length;
    let load = problem.load;
    let turned = solved.solution.normal.turned;
    state.tilt = [0, 1].map(|axis| {
        let found = || problem.tilt[axis] + turned[axis] / problem.positions.length;
        load.tilt[axis].motion().unwrap_or_else(found)
    });
    state.bulk_stress = load.bulk_stress;
    state.roll = load.roll;
    state.dissipated_energy = before.dissipated_energy;
    state.bulk_work = before.bulk_work;
    state.external_work = before.external_work;
    state.wear_work = before.wear_work;
    state.plastic_work = before.plastic_work;
    state.unresolved_energy = before.unresolved_energy;
    state.debris_outflow = before.debris_outflow;
    state
}

/// Work of the bulk stresses per area of a cell: minus the mean shear times the relative displacement by the strains.
fn bulk_work(problem: &IncrementProblem<'_>, after: &ContactState) -> f64 {
    let IncrementProblem { grid, state: before, stretch, .. } = problem;
    if stretch.is_none() {
        return 0.0;
    }
    let [x, y] = [0, 1].map(|axis| (&before.shear[axis], &after.shear[axis]));
    x.1.indexed_iter().fold(0.0, |work, (at, after)| {
        let [along, across] = stretch.at(grid, [at.0, at.1]);
        work - 0.5 * ((x.0[at] + after) * along + (y.0[at] + y.1[at]) * across)
    })
}

/// How far moments of the pressure are from the prescribed ones, relative to the normal force times the radius of gyration of the pressure.
fn off_moments(problem: &IncrementProblem<'_>, found: &Resultants, second_moment: [f64; 2]) -> f64 {
    (0..2).fold(0.0, |worst: f64, axis| {
        let Some(asked) = problem.load.tilt[axis].force() else { return worst };
        let radius = (second_moment[axis] / found.normal).sqrt().max(0.5 * problem.grid.spacing()[axis]);
        let off = (found.tilt_moment[axis] - asked).abs();
        if off == 0.0 { worst } else { worst.max(off / (radius * found.normal)) }
    })
}

/// How far resultants are from the prescribed ones, relative to the normal force; the tangential ones to the `limit` of friction.
fn off_equilibrium(problem: &IncrementProblem<'_>, found: &Resultants, limit: f64) -> f64 {
    let IncrementProblem { grid, positions, normal, tangential, .. } = problem;
    let area = grid.cell_area();
    let normal = match normal.total {
        Some(total) if total > 0.0 => (found.normal / (total * area) - 1.0).abs(),
        _ => 0.0,
    };
    let lengths = [1.0, 1.0, positions.length];
    let found = [found.tangential[0], found.tangential[1], found.moment];
    (0..3).filter(|&mode| tangential.held()[mode]).fold(normal, |worst, mode| {
        let off = (found[mode] / lengths[mode] - tangential.resultant[mode] * area).abs();
        if off == 0.0 { worst } else { worst.max(off / limit) } // all of it where nothing rubs
    })
}
