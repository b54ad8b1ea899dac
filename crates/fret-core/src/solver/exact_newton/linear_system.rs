//! The dense linear system of one iteration of the exact Newton method.

use faer::Mat;
use faer::linalg::solvers::Solve;

use super::super::contact_problem::ContactProblem;
use super::super::laws::rigid_motions::RigidMotions;
use super::super::tractions::Tractions;
use crate::compliance::CellResponse;

/// What a cell whose augmented pressure is positive does.
pub struct ActiveCell {
    pub cell: usize,
    /// Unit vectors along and across its trial shear.
    pub along: [f64; 2],
    pub across: [f64; 2],
    /// Where it slips, the displacement that turns its shear.
    pub turning: [f64; 2],
    /// Where it slips: bound and slope at the augmented pressure y, with `bound - slope y`.
    pub slope: f64,
    pub offset: f64,
    /// Slip compliance [length/pressure]; `None` where it sticks.
    pub slip_compliance: Option<f64>,
    /// Place of its pressure among the unknowns; its shear follows, two of them in stick and one in slip.
    pub first: usize,
    /// Unknowns of its shear.
    pub shear_unknowns: usize,
}

impl ActiveCell {
    /// The traction `[p, qx, qy]` of a unit of each of its unknowns.
    fn columns(&self) -> [[f64; 3]; 3] {
        let Self { along, across, slope, .. } = self;
        match self.slip_compliance {
            None => [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            Some(_) => [[1.0, slope * along[0], slope * along[1]], [0.0, across[0], across[1]], [0.0; 3]],
        }
    }

    /// The displacement that each of its equations is about.
    fn rows(&self) -> [[f64; 3]; 3] {
        match self.slip_compliance {
            None => [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            Some(_) => [[1.0, 0.0, 0.0], [0.0, self.turning[0], self.turning[1]], [0.0; 3]],
        }
    }

    /// Unknowns of the cell.
    pub fn unknowns(&self) -> usize {
        1 + self.shear_unknowns
    }
}

/// The equations linearised on what the cells in contact do. Rows of displacements and columns of motions are in units of the normal
/// self-influence.
pub struct LinearSystem<'a> {
    pub problem: &'a ContactProblem<'a>,
    pub response: &'a CellResponse,
    /// Rigid motions of all cells of the region.
    pub motions: &'a RigidMotions,
    /// Cells in contact.
    pub active: &'a [ActiveCell],
    /// Cells of the region along y.
    pub columns: usize,
    /// Normal self-influence of a cell [length/pressure].
    pub unit: f64,
}

/// Tractions and motions that solve it.
pub struct NewtonPoint {
    pub tractions: Tractions,
    /// Approach [length].
    pub approach: f64,
    /// Increments of the rigid motions [length].
    pub motion: [f64; 3],
}

impl LinearSystem<'_> {
    /// Its solution; `None` where the matrix is singular.
    pub fn solve(&self) -> Option<NewtonPoint> {
        let Self { problem, motions, active, unit, .. } = *self;
        let (normal, loads) = (problem.normal, problem.tangential);
        let unknowns = active.last().map_or(0, |cell| cell.first + cell.unknowns());
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
            let rows = to.rows();
            for from in active {
                let block = self.response.between(place(to.cell), place(from.cell));
                let columns = from.columns();
                for (row, vector) in rows.iter().enumerate().take(to.unknowns()) {
                    let answer =
                        [0, 1, 2].map(|k| (0..3).map(|l| vector[l] * block[l][k]).sum::<f64>() / unit);
                    for (column, traction) in columns.iter().enumerate().take(from.unknowns()) {
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
            for (row, vector) in rows.iter().enumerate().take(to.unknowns()).skip(1) {
                let wanted = vector[1] * (before[0] + moved[0]) + vector[2] * (before[1] + moved[1]);
                right[(to.first + row, 0)] += wanted / unit;
                if let Some(slip_compliance) = to.slip_compliance {
                    matrix[(to.first + row, to.first + row)] += slip_compliance / unit;
                }
            }
            let columns = to.columns();
            for (index, &mode) in motion_unknown.iter().enumerate() {
                let along = mode_at(mode, to.cell);
                let at = unknowns + approach_unknown + index;
                for (row, vector) in rows.iter().enumerate().take(to.unknowns()).skip(1) {
                    matrix[(to.first + row, at)] = -(vector[1] * along[0] + vector[2] * along[1]);
                }
                for (column, traction) in columns.iter().enumerate().take(to.unknowns()) {
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
            for (column, traction) in cell.columns().iter().enumerate().take(cell.unknowns()) {
                found = [0, 1, 2].map(|k| found[k] + traction[k] * value(cell.first + column));
            }
            tractions.pressure[cell.cell] = found[0];
            tractions.shear.set(cell.cell, [found[1], found[2]]);
        }
        let mut motion = loads.motion;
        for (index, &mode) in motion_unknown.iter().enumerate() {
            motion[mode] = value(unknowns + approach_unknown + index) * unit;
        }
        Some(NewtonPoint {
            tractions,
            approach: if approach_unknown == 1 { value(unknowns) * unit } else { normal.approach },
            motion,
        })
    }
}
