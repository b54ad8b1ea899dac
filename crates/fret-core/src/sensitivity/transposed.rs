//! The transpose of the equations of a solved increment: of each of its steps, in the opposite order. The elastic response is its own transpose
//! (Betti), and so is its approximate inverse.

use super::cell::{MOTIONS, Prescribed, Shear};
use super::krylov::LinearProblem;
use super::linearised::{Fields, Linearised, solved, zeros};
use crate::fields::{add_scaled, dot};

/// The transposed problem.
pub(super) struct Transposed<'a, 'b> {
    problem: &'a mut Linearised<'b>,
    /// Displacements by what the cells saw the last time, packed.
    pub moved: Fields,
}

impl<'a, 'b> Transposed<'a, 'b> {
    /// That of a problem.
    pub fn of(problem: &'a mut Linearised<'b>) -> Self {
        let moved = zeros(problem.cells.len());
        Self { problem, moved }
    }
}

impl Linearised<'_> {
    /// The transpose of the tractions of unknowns, packed.
    pub fn tractions_transposed(&self, [pressure, x, y]: &Fields, unknowns: &mut [f64]) {
        let n = self.cells.len();
        for (place, cell) in self.cells.iter().enumerate() {
            let shear = [x[place], y[place]];
            let (along, across) = (cell.along, cell.across());
            let onto = |direction: [f64; 2]| direction[0] * shear[0] + direction[1] * shear[1];
            let follows = cell.slope * onto(along);
            [unknowns[place], unknowns[n + place], unknowns[2 * n + place]] = match cell.shear {
                Shear::Held => [pressure[place], shear[0], shear[1]],
                Shear::HeldAlong(axis) => [pressure[place], shear[axis], 0.0],
                Shear::Turns { .. } => [pressure[place] + follows, onto(across), 0.0],
                Shear::Follows => [pressure[place] + follows, 0.0, 0.0],
            };
        }
    }

    /// The transpose of the tractions and motions of a vector of unknowns, from all cells of the region.
    pub fn parted_transposed(&self, tractions: &Fields, motions: &[f64; MOTIONS]) -> Vec<f64> {
        let mut unknowns = vec![0.0; self.len()];
        let packed = tractions.each_ref().map(|field| self.contact.packed(field));
        self.tractions_transposed(&packed, &mut unknowns);
        let n = self.cells.len();
        for (unknown, motion) in unknowns[3 * n..].iter_mut().zip(motions) {
            *unknown = motion * self.own[0];
        }
        unknowns
    }

    /// The transpose of the right side: of displacements asked for, packed, and of what is prescribed of the motions.
    pub fn right_side_transposed(&self, right: &[f64]) -> (Fields, [f64; MOTIONS]) {
        let n = self.cells.len();
        let mut asked = zeros(n);
        for (place, cell) in self.cells.iter().enumerate() {
            let [normal, x, y] = [right[place], right[n + place], right[2 * n + place]];
            asked[0][place] = normal / self.own[0];
            match cell.shear {
                Shear::Held => {
                    asked[1][place] = x / self.own[0];
                    asked[2][place] = y / self.own[0];
                }
                Shear::HeldAlong(axis) => asked[1 + axis][place] = x / self.own[0],
                Shear::Turns { compliance, .. } => {
                    asked[1][place] = x * self.slip_weight(compliance) / self.own[0];
                }
                Shear::Follows => {}
            }
        }
        (asked, std::array::from_fn(|motion| right[3 * n + motion] * self.weight_of(motion)))
    }

    /// Rows by which the cells see displacements nearest to these, packed; none of motions.
    pub fn rows_of(&self, [normal, x, y]: &Fields) -> Vec<f64> {
        let n = self.cells.len();
        let unit = self.own[0];
        let mut rows = vec![0.0; self.len()];
        for (place, cell) in self.cells.iter().enumerate() {
            let seen = [x[place], y[place]];
            rows[place] = normal[place] * unit;
            [rows[n + place], rows[2 * n + place]] = match cell.shear {
                Shear::Held => seen.map(|part| part * unit),
                Shear::HeldAlong(axis) => [seen[axis] * unit, 0.0],
                Shear::Turns { row, compliance } => {
                    let (size, along) = (dot(&row, &row), dot(&row, &seen));
                    let turned = if size > 0.0 { along / size } else { 0.0 };
                    [turned * unit / self.slip_weight(compliance), 0.0]
                }
                Shear::Follows => [0.0; 2],
            };
        }
        rows
    }

    /// Amounts of resultants, from what rows of motions make of them: their transpose, before it is spread over the cells.
    fn of_resultants(&self, rows: &[f64]) -> [f64; MOTIONS] {
        std::array::from_fn(|motion| match self.prescribed[motion] {
            Prescribed::Motion => 0.0,
            Prescribed::Resultant => rows[motion] * self.weight_of(motion),
            Prescribed::FarEnd(give) => rows[motion] * give / self.own[0],
        })
    }

    /// The transpose of the resultants: adds the tractions of amounts of them, packed.
    pub fn resultants_transposed(&self, amounts: &[f64; MOTIONS], tractions: &mut Fields) {
        for (place, cell) in self.cells.iter().enumerate() {
            for (amount, mode) in amounts.iter().zip(cell.modes()) {
                for part in 0..3 {
                    tractions[part][place] += amount * mode[part];
                }
            }
        }
    }

    /// The transpose of the rows of the cells: displacements that they see, packed, and the unknowns that they see themselves.
    fn cell_rows_transposed(&self, rows: &[f64], unknowns: &mut [f64]) -> Fields {
        let n = self.cells.len();
        let unit = self.own[0];
        let mut seen = zeros(n);
        for (place, cell) in self.cells.iter().enumerate() {
            let [normal, first, second] = [rows[place], rows[n + place], rows[2 * n + place]];
            seen[0][place] = normal / unit;
            match cell.shear {
                Shear::Held => {
                    seen[1][place] = first / unit;
                    seen[2][place] = second / unit;
                }
                Shear::HeldAlong(axis) => {
                    seen[1 + axis][place] = first / unit;
                    unknowns[2 * n + place] += second;
                }
                Shear::Turns { row, compliance } => {
                    let weighted = first * self.slip_weight(compliance) / unit;
                    seen[1][place] = row[0] * weighted;
                    seen[2][place] = row[1] * weighted;
                    unknowns[n + place] += compliance * weighted;
                    unknowns[2 * n + place] += second;
                }
                Shear::Follows => {
                    unknowns[n + place] += first;
                    unknowns[2 * n + place] += second;
                }
            }
        }
        seen
    }

    /// The transposed approximate inverse of the equations of the cells alone.
    fn invert_cells_transposed(&mut self, unknowns: &[f64], equations: &mut [f64]) {
        let n = self.cells.len();
        let unit = self.own[0];
        let mut pressure = vec![0.0; n];
        self.operators.preconditioner.pressure(&unknowns[..n], &mut pressure, &self.weights);
        let (mut x, mut y) = (vec![0.0; n], vec![0.0; n]);
        for (place, cell) in self.cells.iter().enumerate() {
            let own = [unknowns[n + place], unknowns[2 * n + place]];
            [x[place], y[place]] = match cell.shear {
                Shear::Held => own,
                Shear::HeldAlong(0) => [own[0], 0.0],
                Shear::HeldAlong(_) => [0.0, own[0]],
                Shear::Turns { .. } => cell.across().map(|part| part * own[0]),
                Shear::Follows => [0.0; 2],
            };
        }
        let mut shear = [vec![0.0; n], vec![0.0; n]];
        if self.operators.frictional {
            let [to_x, to_y] = &mut shear;
            self.operators.preconditioner.shear(([&x, &y], None), [to_x, to_y], &mut self.weights);
        }
        for (place, cell) in self.cells.iter().enumerate() {
            let own = [unknowns[n + place], unknowns[2 * n + place]];
            let found = [shear[0][place], shear[1][place]];
            equations[place] = unit * pressure[place];
            [equations[n + place], equations[2 * n + place]] = match cell.shear {
                Shear::Held => found.map(|part| unit * part),
                Shear::HeldAlong(axis) => [unit * found[axis], own[1]],
                Shear::Turns { compliance, .. } => {
                    let across = cell.across();
                    let turned = found[0] * across[0] + found[1] * across[1];
                    [unit * turned / self.slip_weight(compliance), own[1]]
                }
                Shear::Follows => own,
            };
        }
    }
}

impl LinearProblem for Transposed<'_, '_> {
    fn apply(&mut self, rows: &[f64], unknowns: &mut [f64]) {
        let problem = &mut *self.problem;
        let n = problem.cells.len();
        unknowns.fill(0.0);
        let seen = problem.cell_rows_transposed(rows, unknowns);
        self.moved = problem.moved(&seen);
        let mut tractions = self.moved.clone();
        problem.resultants_transposed(&problem.of_resultants(&rows[3 * n..]), &mut tractions);
        let mut of_tractions = vec![0.0; unknowns.len()];
        problem.tractions_transposed(&tractions, &mut of_tractions);
        add_scaled(unknowns, 1.0, &of_tractions);
        let by_motions = problem.resultants(&seen);
        for motion in 0..MOTIONS {
            let own = match problem.prescribed[motion] {
                Prescribed::Motion | Prescribed::FarEnd(_) => rows[3 * n + motion],
                Prescribed::Resultant => 0.0,
            };
            unknowns[3 * n + motion] = own - problem.own[0] * by_motions[motion];
        }
    }

    fn hurry(&mut self, may: bool) -> bool {
        self.problem.hurry(may)
    }

    fn invert(&mut self, unknowns: &[f64], rows: &mut [f64]) {
        let problem = &mut *self.problem;
        let n = problem.cells.len();
        let right = std::array::from_fn(|motion| {
            let bordered = &problem.bordered[motion];
            // A motion that is prescribed is asked by no row but its own.
            let through: f64 = unknowns[..3 * n].iter().zip(bordered).map(|(a, b)| a * b).sum();
            unknowns[3 * n + motion] - through
        });
        let schur = std::array::from_fn(|row| std::array::from_fn(|column| problem.schur[column][row]));
        let amounts = solved(schur, right);
        let mut tractions = zeros(n);
        problem.resultants_transposed(&problem.of_resultants(&amounts), &mut tractions);
        let mut left = vec![0.0; unknowns.len()];
        problem.tractions_transposed(&tractions, &mut left);
        for (left, unknown) in left[..3 * n].iter_mut().zip(unknowns) {
            *left = unknown - *left;
        }
        problem.invert_cells_transposed(&left, rows);
        rows[3 * n..].copy_from_slice(&amounts);
        let by_motions = problem.resultants(&problem.cell_rows_transposed(rows, &mut left));
        for motion in (0..MOTIONS).filter(|motion| problem.prescribed[*motion] == Prescribed::Motion) {
            rows[3 * n + motion] = unknowns[3 * n + motion] + problem.own[0] * by_motions[motion];
        }
    }
}
