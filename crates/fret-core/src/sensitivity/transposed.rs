//! The transpose of the equations of a solved increment: of each of its steps, in the opposite order. The elastic response is its own transpose
//! (Betti), and so is its approximate inverse.

use super::cell::{MOTIONS, Prescribed, Shear};
use super::change::Solution;
use super::contact::Contact;
use super::fields::{Fields, zeros};
use super::krylov::{LinearProblem, Trust};
use super::linearised::Linearised;
use crate::fields::{add_scaled, dot, solved};

/// The transposed problem.
pub(super) struct Transposed<'a, 'b> {
    problem: &'a mut Linearised<'b>,
    contact: &'a Contact<'a>,
    /// How the friction coefficient and the shear strength count by what the cells saw the last time.
    aside: [f64; 2],
}

impl<'a, 'b> Transposed<'a, 'b> {
    /// That of the problem of a contact.
    pub fn of(problem: &'a mut Linearised<'b>, contact: &'a Contact<'a>) -> Self {
        Self { problem, contact, aside: [0.0; 2] }
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

    /// What tractions and displacements count that are given on all cells of the region, and motions, less what multipliers `rows` make of them, none of
    /// them those of motions: the right side of the transposed equations that is left, and what tractions in the contact count, packed. With no
    /// multipliers and no displacements this is the transpose of [`parted`](Self::parted).
    pub fn left_of(&mut self, counts: &Solution, rows: &[f64]) -> (Vec<f64>, Fields) {
        let mut own = vec![0.0; self.len()];
        let seen = self.cell_rows_transposed(rows, &mut own);
        let mut displacements = counts.displacements.clone();
        for (displacement, seen) in displacements.iter_mut().zip(&seen) {
            for (place, cell) in self.contact.cells().enumerate() {
                displacement[cell] -= seen[place];
            }
        }
        let mut tractions = counts.tractions.each_ref().map(|field| self.contact.packed(field));
        // The elastic response is its own transpose.
        if displacements.iter().flatten().any(|value| *value != 0.0) {
            for (traction, by) in
                tractions.iter_mut().zip(self.operators.in_contact(self.contact, &displacements))
            {
                add_scaled(traction, 1.0, &by);
            }
        }
        let mut left = vec![0.0; self.len()];
        self.tractions_transposed(&tractions, &mut left);
        add_scaled(&mut left, -1.0, &own);
        let by_motions = self.resultants(&seen);
        for (motion, left) in left[3 * self.cells.len()..].iter_mut().enumerate() {
            *left = self.own[0] * (counts.motions[motion] + by_motions[motion]);
        }
        (left, tractions)
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
        let mut right = zeros(n);
        for (place, cell) in self.cells.iter().enumerate() {
            let own = [unknowns[n + place], unknowns[2 * n + place]];
            let [x, y] = match cell.shear {
                Shear::Held => own,
                Shear::HeldAlong(0) => [own[0], 0.0],
                Shear::HeldAlong(_) => [0.0, own[0]],
                Shear::Turns { .. } => cell.across().map(|part| part * own[0]),
                Shear::Follows => [0.0; 2],
            };
            (right[0][place], right[1][place], right[2][place]) = (unknowns[place], x, y);
        }
        let [pressure, x, y] = self.operators.removed(&right, &mut self.weights);
        for (place, cell) in self.cells.iter().enumerate() {
            let own = [unknowns[n + place], unknowns[2 * n + place]];
            let found = [x[place], y[place]];
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
        let mut tractions = problem.operators.moved(&seen);
        self.aside = self.contact.given_transposed(&tractions);
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

    fn trust(&mut self) -> &mut Trust {
        self.problem.trust()
    }

    fn aside(&self) -> [f64; 2] {
        self.aside
    }

    fn invert(&mut self, unknowns: &[f64], rows: &mut [f64]) {
        let problem = &mut *self.problem;
        let n = problem.cells.len();
        let right: [f64; MOTIONS] = std::array::from_fn(|motion| {
            let bordered = &problem.bordered[motion];
            // A motion that is prescribed is asked by no row but its own.
            let through: f64 = unknowns[..3 * n].iter().zip(bordered).map(|(a, b)| a * b).sum();
            unknowns[3 * n + motion] - through
        });
        let schur: [[f64; MOTIONS]; MOTIONS] =
            std::array::from_fn(|row| std::array::from_fn(|column| problem.schur[column][row]));
        let amounts = solved(schur, right, 0.0);
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
