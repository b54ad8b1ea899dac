//! The transpose of the equations of a solved increment: of each of its steps, in the opposite order. The elastic response is its own transpose
//! (Betti), and so is its approximate inverse.

use super::cell::{MOTIONS, Prescribed, Shear};
use super::cell_rows::slip_weight;
use super::change::Solution;
use super::contact::Contact;
use super::fields::{Fields, zeros};
use super::krylov::{LinearProblem, Searches};
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
    /// What tractions and displacements count that are given on all cells of the region, and motions, less what multipliers `rows` make of them, none of
    /// them those of motions: the right side of the transposed equations that is left, and what tractions in the contact count, packed. With no
    /// multipliers and no displacements this is the transpose of [`parted`](Self::parted).
    pub fn left_of(&mut self, counts: &Solution, rows: &[f64]) -> (Vec<f64>, Fields) {
        let (tractions, by_motions) = self.tractions_of(counts, rows);
        let mut left = vec![0.0; self.len()];
        self.rows.unknowns((&tractions, [0.0; MOTIONS]), (rows, -1.0), &mut left);
        for (motion, left) in left[3 * self.cells.len()..].iter_mut().enumerate() {
            *left = self.own[0] * (counts.motions[motion] + by_motions[motion]);
        }
        (left, tractions)
    }

    /// What tractions in the contact count, packed, and the motions by what the multipliers see of them.
    pub fn tractions_of(&mut self, counts: &Solution, rows: &[f64]) -> (Fields, [f64; MOTIONS]) {
        let mut seen = self.rows.no_fields();
        let by_motions = self.rows.seen(rows, &mut seen);
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
        (tractions, by_motions)
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
                    asked[1][place] = x * slip_weight(compliance, self.own[1]) / self.own[0];
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
                    [turned * unit / slip_weight(compliance, self.own[1]), 0.0]
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
}

impl LinearProblem for Transposed<'_, '_> {
    fn apply(&mut self, multipliers: &[f64], unknowns: &mut [f64]) {
        let problem = &mut *self.problem;
        let n = problem.cells.len();
        let amounts = problem.of_resultants(&multipliers[3 * n..]);
        let Linearised { operators, rows, through: [seen, tractions], prescribed, own, .. } = problem;
        let by_motions = rows.seen(multipliers, seen);
        operators.moved(seen, tractions);
        self.aside = self.contact.given_transposed(tractions);
        rows.unknowns((tractions, amounts), (multipliers, 1.0), unknowns);
        for motion in 0..MOTIONS {
            let of_itself = match prescribed[motion] {
                Prescribed::Motion | Prescribed::FarEnd(_) => multipliers[3 * n + motion],
                Prescribed::Resultant => 0.0,
            };
            unknowns[3 * n + motion] = of_itself - own[0] * by_motions[motion];
        }
    }

    fn hurry(&mut self, may: bool) -> bool {
        self.problem.hurry(may)
    }

    fn searches(&mut self) -> &mut Searches {
        self.problem.searches()
    }

    fn aside(&self) -> [f64; 2] {
        self.aside
    }

    fn invert(&mut self, unknowns: &[f64], multipliers: &mut [f64]) {
        let problem = &mut *self.problem;
        let n = problem.cells.len();
        let right: [f64; MOTIONS] = std::array::from_fn(|motion| {
            let bordered = &problem.bordered[motion];
            // A motion that is prescribed is asked by no row but its own.
            let through = if bordered.is_empty() { 0.0 } else { dot(&unknowns[..3 * n], &bordered[..3 * n]) };
            unknowns[3 * n + motion] - through
        });
        let schur: [[f64; MOTIONS]; MOTIONS] =
            std::array::from_fn(|row| std::array::from_fn(|column| problem.schur[column][row]));
        let amounts = solved(schur, right, 0.0);
        let of_resultants = problem.of_resultants(&amounts);
        let Linearised { operators, rows, weights, through: [seen, tractions], left, .. } = problem;
        rows.removed_transposed((unknowns, of_resultants), seen, left);
        operators.removed(seen, tractions, weights);
        rows.to_remove_transposed(tractions, left, multipliers);
        let by_motions = rows.seen(multipliers, seen);
        multipliers[3 * n..].copy_from_slice(&amounts);
        for motion in (0..MOTIONS).filter(|motion| problem.prescribed[*motion] == Prescribed::Motion) {
            multipliers[3 * n + motion] = unknowns[3 * n + motion] + problem.own[0] * by_motions[motion];
        }
    }
}
