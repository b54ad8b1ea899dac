//! The dense linear system of one iteration of the exact Newton method. Rows of displacements and columns of motions are in units of the
//! normal self-influence.

use faer::Mat;
use faer::linalg::solvers::Solve;

use super::super::tractions::{Displacements, Tractions};
use super::{Attempt, Point};

/// What a cell whose augmented pressure is positive does.
pub struct ActiveCell {
    cell: usize,
    /// Unit vector along its trial shear.
    along: [f64; 2],
    /// Where it slips: the shear along it that does not follow the pressure, bound less slope times augmented pressure [pressure].
    offset: f64,
    /// Slip compliance [length/pressure]; `None` where it sticks.
    slip_compliance: Option<f64>,
    /// The traction `[p, qx, qy]` of a unit of each of its unknowns.
    columns: [[f64; 3]; 3],
    /// The displacement that each of its equations is about.
    rows: [[f64; 3]; 3],
    /// Place of its pressure among the unknowns; its shear follows.
    first: usize,
    /// How many unknowns it has: three in stick, two in slip, the pressure alone without a bound.
    unknowns: usize,
}

impl Attempt<'_> {
    /// Cells in contact by their augmented pressure, and what they do; with the number of their unknowns.
    pub(super) fn active_cells(&self) -> (Vec<ActiveCell>, usize) {
        let Self { problem, self_influence: [_, tangential], here, .. } = self;
        let mut active = Vec::new();
        let mut first = 0;
        for cell in 0..problem.undeformed.len() {
            let (_, augmented, trial) = self.cell(here, cell);
            if augmented <= 0.0 {
                continue;
            }
            let (bound, slope) = problem.friction.at(cell, augmented);
            let size = trial[0].hypot(trial[1]);
            let along = if size > 0.0 { trial.map(|part| part / size) } else { [1.0, 0.0] };
            let (slip_compliance, unknowns) = match (bound > 0.0, size > bound) {
                (true, false) => (None, 3),
                (true, true) => (Some((size - bound) * tangential / bound), 2),
                (false, _) => (Some(0.0), 1),
            };
            let all = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
            let (columns, rows, offset) = if slip_compliance.is_none() {
                (all, all, 0.0)
            } else {
                let across = [-along[1], along[0]];
                let turning = problem.path.row_across(cell, self.slip(here, cell), across);
                let follow = [1.0, slope * along[0], slope * along[1]];
                let columns = [follow, [0.0, across[0], across[1]], [0.0; 3]];
                (columns, [all[0], [0.0, turning[0], turning[1]], [0.0; 3]], bound - slope * augmented)
            };
            active.push(ActiveCell { cell, along, offset, slip_compliance, columns, rows, first, unknowns });
            first += unknowns;
        }
        (active, first)
    }

    /// The solution of the equations linearised here, its displacements left to be found; `None` where the matrix is singular.
    pub(super) fn newton_point(&self, active: &[ActiveCell]) -> Option<Point> {
        let Self { problem, motions, self_influence: [unit, _], .. } = self;
        let (normal, loads) = (problem.normal, problem.tangential);
        let unknowns = active.last().map_or(0, |cell| cell.first + cell.unknowns);
        let motion_unknown: Vec<usize> = (0..3).filter(|&mode| loads.by_force[mode]).collect();
        let gives = normal.give > 0.0;
        let approach_unknown = usize::from(normal.total.is_some() || gives);
        let size = unknowns + approach_unknown + motion_unknown.len();
        let mut matrix = Mat::<f64>::zeros(size, size);
        let mut right = Mat::<f64>::zeros(size, 1);
        let place = |cell: usize| [cell / self.columns, cell % self.columns];
        let prescribed = [0, 1, 2].map(|mode| if loads.by_force[mode] { 0.0 } else { loads.motion[mode] });
        let mode_at = |mode: usize, cell: usize| {
            let mut amounts = [0.0; 3];
            amounts[mode] = 1.0;
            motions.at(amounts, cell)
        };
        for to in active {
            for from in active {
                let block = self.response.between(place(to.cell), place(from.cell));
                for (row, vector) in to.rows[..to.unknowns].iter().enumerate() {
                    let answer =
                        [0, 1, 2].map(|k| (0..3).map(|l| vector[l] * block[l][k]).sum::<f64>() / unit);
                    for (column, traction) in from.columns[..from.unknowns].iter().enumerate() {
                        matrix[(to.first + row, from.first + column)] =
                            (0..3).map(|k| answer[k] * traction[k]).sum();
                    }
                    let constant = answer[1] * from.along[0] + answer[2] * from.along[1];
                    right[(to.first + row, 0)] -= constant * from.offset;
                }
            }
            let approach = if approach_unknown == 1 { 0.0 } else { normal.approach };
            right[(to.first, 0)] += (approach - problem.undeformed[to.cell]) / unit;
            if approach_unknown == 1 {
                matrix[(to.first, unknowns)] = -1.0;
                matrix[(unknowns, to.first)] = 1.0;
            }
            let (before, moved) = (problem.before.at(to.cell), motions.at(prescribed, to.cell));
            for (row, vector) in to.rows[..to.unknowns].iter().enumerate().skip(1) {
                let wanted = vector[1] * (before[0] + moved[0]) + vector[2] * (before[1] + moved[1]);
                right[(to.first + row, 0)] += wanted / unit;
                if let Some(slip_compliance) = to.slip_compliance {
                    matrix[(to.first + row, to.first + row)] += slip_compliance / unit;
                }
            }
            for (index, &mode) in motion_unknown.iter().enumerate() {
                let along = mode_at(mode, to.cell);
                let at = unknowns + approach_unknown + index;
                for (row, vector) in to.rows[..to.unknowns].iter().enumerate().skip(1) {
                    matrix[(to.first + row, at)] = -(vector[1] * along[0] + vector[2] * along[1]);
                }
                for (column, traction) in to.columns[..to.unknowns].iter().enumerate() {
                    matrix[(at, to.first + column)] = traction[1] * along[0] + traction[2] * along[1];
                }
                right[(at, 0)] -= to.offset * (to.along[0] * along[0] + to.along[1] * along[1]);
            }
        }
        if let Some(total) = normal.total {
            right[(unknowns, 0)] = total;
        } else if gives {
            matrix[(unknowns, unknowns)] = unit / normal.give;
            right[(unknowns, 0)] = normal.approach / normal.give;
        }
        for (index, &mode) in motion_unknown.iter().enumerate() {
            let at = unknowns + approach_unknown + index;
            right[(at, 0)] += loads.resultant[mode];
            matrix[(at, at)] += loads.spring[mode] * unit;
        }
        let solution = matrix.partial_piv_lu().solve(&right);
        let value = |index: usize| solution[(index, 0)];
        if (0..size).any(|index| !value(index).is_finite()) {
            return None;
        }
        let mut tractions = Tractions::zeros(problem.undeformed.len());
        for cell in active {
            let mut found = [0.0, cell.offset * cell.along[0], cell.offset * cell.along[1]];
            for (column, traction) in cell.columns[..cell.unknowns].iter().enumerate() {
                found = [0, 1, 2].map(|k| found[k] + traction[k] * value(cell.first + column));
            }
            tractions.pressure[cell.cell] = found[0];
            tractions.shear.set(cell.cell, [found[1], found[2]]);
        }
        let mut motion = loads.motion;
        for (index, &mode) in motion_unknown.iter().enumerate() {
            motion[mode] = value(unknowns + approach_unknown + index) * unit;
        }
        Some(Point {
            displacements: Displacements::zeros(problem.undeformed.len()),
            tractions,
            approach: if approach_unknown == 1 { value(unknowns) * unit } else { normal.approach },
            motion,
        })
    }
}
