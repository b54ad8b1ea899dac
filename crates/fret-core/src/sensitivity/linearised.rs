//! The equations of a solved increment, linearised on the sets that its solution has: cells in contact keep their gap closed, cells that
//! stick their slip, the shear of those that slip follows the friction bound and turns with the slip; resultants and motions that are prescribed
//! stay so. Left sides alone: what they ask for stands in `contact.rs`, their transpose in `transposed.rs`.
//!
//! Unknown are the changes of the pressure `p` in contact, of shear `q`, and of the rigid motions. In slip
//! `dq = (b' dp) e + dt n` with the direction `e` of the shear, `n` across it; what is unknown is `dt`.
//!
//! ```text
//! contact: du_z - motions                          stick: du - motions
//! slip:    r . (du - motions) + D dt               D = |s| / b, r: row of the slip at the end of the increment
//! ```

use super::cell::{Cell, MOTIONS, Prescribed, Shear};
use super::error::SensitivityError;
use super::fields::{Fields, zeros};
use super::krylov::{LinearProblem, Trust};
use super::operators::Operators;
use crate::fields::{add_scaled, solved};
use crate::solver::{ContactSet, SlipWeights};

/// The linearised equations of one increment.
pub(super) struct Linearised<'a> {
    pub(super) operators: &'a mut Operators,
    pub(super) contact: &'a ContactSet,
    pub(super) cells: &'a [Cell],
    pub(super) prescribed: [Prescribed; MOTIONS],
    pub(super) weights: SlipWeights<f64>,
    /// Influence of a cell on itself, normal and tangential: the unit of the equations [length/pressure].
    pub(super) own: [f64; 2],
    /// What the approximate inverse makes of each motion, and the small matrix of motions against their rows.
    pub(super) bordered: Vec<Vec<f64>>,
    pub(super) schur: [[f64; MOTIONS]; MOTIONS],
    region: usize,
}

impl<'a> Linearised<'a> {
    /// The equations on the `cells` of a contact.
    pub fn new(
        operators: &'a mut Operators,
        (contact, cells): (&'a ContactSet, &'a [Cell]),
        prescribed: [Prescribed; MOTIONS],
        region: usize,
    ) -> Result<Self, SensitivityError> {
        let slip: Vec<f64> = cells
            .iter()
            .map(|cell| if let Shear::Turns { compliance, .. } = cell.shear { compliance } else { 0.0 })
            .collect();
        operators.come_to(contact)?;
        let mut weights = SlipWeights::default();
        operators.prepare(&slip, &mut weights);
        let own = operators.self_influence();
        let own = [own.normal, if own.tangential > 0.0 { own.tangential } else { own.normal }];
        let mut problem = Self {
            operators,
            contact,
            cells,
            prescribed,
            weights,
            own,
            bordered: Vec::new(),
            schur: [[0.0; MOTIONS]; MOTIONS],
            region,
        };
        if !cells.is_empty() {
            problem.border();
        }
        Ok(problem)
    }

    /// How many unknowns there are.
    pub fn len(&self) -> usize {
        3 * self.cells.len() + MOTIONS
    }

    /// Tractions of unknowns, packed.
    fn tractions(&self, unknowns: &[f64]) -> Fields {
        let n = self.cells.len();
        let mut tractions = zeros(n);
        let [pressure, x, y] = &mut tractions;
        for (place, cell) in self.cells.iter().enumerate() {
            let p = unknowns[place];
            let [first, second] = [unknowns[n + place], unknowns[2 * n + place]];
            pressure[place] = p;
            let (along, across) = (cell.along, cell.across());
            [x[place], y[place]] = match cell.shear {
                Shear::Held => [first, second],
                Shear::HeldAlong(0) => [first, 0.0],
                Shear::HeldAlong(_) => [0.0, first],
                Shear::Turns { .. } => [0, 1].map(|axis| cell.slope * p * along[axis] + first * across[axis]),
                Shear::Follows => along.map(|part| cell.slope * p * part),
            };
        }
        tractions
    }

    /// Sums of packed tractions that go with the motions.
    pub fn resultants(&self, [pressure, x, y]: &Fields) -> [f64; MOTIONS] {
        let mut sums = [0.0; MOTIONS];
        for (place, cell) in self.cells.iter().enumerate() {
            let traction = [pressure[place], x[place], y[place]];
            for (sum, mode) in sums.iter_mut().zip(cell.modes()) {
                *sum += (0..3).map(|part| mode[part] * traction[part]).sum::<f64>();
            }
        }
        sums
    }

    /// Unknowns of a vector: tractions on all cells of the region [pressure], and motions [length].
    pub fn parted(&self, unknowns: &[f64]) -> (Fields, [f64; MOTIONS]) {
        let n = self.cells.len();
        let tractions = self.tractions(unknowns).map(|packed| {
            let mut field = vec![0.0; self.region];
            self.contact.scatter(&packed, 1.0, &mut field);
            field
        });
        (tractions, std::array::from_fn(|motion| unknowns[3 * n + motion] * self.own[0]))
    }

    /// The right side of the equations from what displacements ask for: normal and tangential ones to be made, in slip across the shear, packed
    /// [length]; and what is prescribed of motions [length] or resultants [pressure].
    pub fn right_side(&self, asked: &Fields, motions: &[f64; MOTIONS]) -> Vec<f64> {
        let n = self.cells.len();
        let mut right = vec![0.0; self.len()];
        for (place, cell) in self.cells.iter().enumerate() {
            right[place] = asked[0][place] / self.own[0];
            let tangential = [asked[1][place], asked[2][place]];
            match cell.shear {
                Shear::Held => {
                    right[n + place] = tangential[0] / self.own[0];
                    right[2 * n + place] = tangential[1] / self.own[0];
                }
                Shear::HeldAlong(axis) => right[n + place] = tangential[axis] / self.own[0],
                Shear::Turns { compliance, .. } => {
                    right[n + place] = tangential[0] * self.slip_weight(compliance) / self.own[0];
                }
                Shear::Follows => {}
            }
        }
        for motion in 0..MOTIONS {
            right[3 * n + motion] = motions[motion] * self.weight_of(motion);
        }
        right
    }

    /// Weight of the equation of a cell that slips: then a residual means a traction.
    pub(super) fn slip_weight(&self, compliance: f64) -> f64 {
        1.0 / (1.0 + compliance / self.own[1])
    }

    /// Weight of the equation of a motion.
    pub(super) fn weight_of(&self, motion: usize) -> f64 {
        match self.prescribed[motion] {
            Prescribed::Motion | Prescribed::FarEnd(_) => 1.0 / self.own[0],
            Prescribed::Resultant => 1.0 / self.cells.len() as f64,
        }
    }

    /// Left sides of what is prescribed.
    pub(super) fn prescribed_rows(&self, resultants: [f64; MOTIONS], motions: &[f64], to: &mut [f64]) {
        for motion in 0..MOTIONS {
            let moved = motions[motion];
            to[motion] = match self.prescribed[motion] {
                Prescribed::Motion => moved,
                Prescribed::Resultant => resultants[motion] * self.weight_of(motion),
                Prescribed::FarEnd(give) => moved + give * resultants[motion] / self.own[0],
            };
        }
    }

    /// Left sides of the cells from displacements less motions, packed, and the unknowns.
    fn cell_rows(&self, [normal, x, y]: &Fields, unknowns: &[f64], to: &mut [f64]) {
        let n = self.cells.len();
        let unit = self.own[0];
        for (place, cell) in self.cells.iter().enumerate() {
            let moved = [x[place], y[place]];
            let own = [unknowns[n + place], unknowns[2 * n + place]];
            to[place] = normal[place] / unit;
            [to[n + place], to[2 * n + place]] = match cell.shear {
                Shear::Held => moved.map(|part| part / unit),
                Shear::HeldAlong(axis) => [moved[axis] / unit, own[1]],
                Shear::Turns { row, compliance } => {
                    let turned = row[0] * moved[0] + row[1] * moved[1] + compliance * own[0];
                    [turned * self.slip_weight(compliance) / unit, own[1]]
                }
                Shear::Follows => own,
            };
        }
    }

    /// The approximate inverse of the equations of the cells alone.
    fn invert_cells(&mut self, equations: &[f64], unknowns: &mut [f64]) {
        let n = self.cells.len();
        let unit = self.own[0];
        let mut right = zeros(n);
        for (place, cell) in self.cells.iter().enumerate() {
            let own = [equations[n + place], equations[2 * n + place]];
            let [x, y] = match cell.shear {
                Shear::Held => own.map(|part| part * unit),
                Shear::HeldAlong(0) => [own[0] * unit, 0.0],
                Shear::HeldAlong(_) => [0.0, own[0] * unit],
                Shear::Turns { compliance, .. } => {
                    cell.across().map(|part| part * own[0] * unit / self.slip_weight(compliance))
                }
                Shear::Follows => [0.0; 2],
            };
            (right[0][place], right[1][place], right[2][place]) = (equations[place] * unit, x, y);
        }
        let [pressure, x, y] = self.operators.removed(&right, &mut self.weights);
        unknowns[..n].copy_from_slice(&pressure);
        for (place, cell) in self.cells.iter().enumerate() {
            let own = [equations[n + place], equations[2 * n + place]];
            let found = [x[place], y[place]];
            [unknowns[n + place], unknowns[2 * n + place]] = match cell.shear {
                Shear::Held => found,
                Shear::HeldAlong(axis) => [found[axis], own[1]],
                Shear::Turns { .. } => {
                    let across = cell.across();
                    [found[0] * across[0] + found[1] * across[1], own[1]]
                }
                Shear::Follows => own,
            };
        }
    }

    /// What motions make of the rows of the cells.
    fn rows_of_motions(&self, amounts: &[f64; MOTIONS]) -> Vec<f64> {
        let moved = amounts.map(|amount| -amount * self.own[0]);
        let mut by_motions = zeros(self.cells.len());
        for (place, cell) in self.cells.iter().enumerate() {
            for (part, moved) in cell.moved(&moved).into_iter().enumerate() {
                by_motions[part][place] = moved;
            }
        }
        let mut rows = vec![0.0; self.len()];
        self.cell_rows(&by_motions, &vec![0.0; self.len()], &mut rows);
        rows
    }

    /// Prepares the border: motions that follow from resultants, and their rows. What is prescribed of the others they are.
    fn border(&mut self) {
        for motion in 0..MOTIONS {
            self.schur[motion][motion] = 1.0;
            let mut inverse = Vec::new();
            if self.prescribed[motion] != Prescribed::Motion {
                let mut unit = [0.0; MOTIONS];
                unit[motion] = 1.0;
                let equations = self.rows_of_motions(&unit);
                inverse.resize(self.len(), 0.0);
                self.invert_cells(&equations, &mut inverse);
                let resultants = self.resultants(&self.tractions(&inverse));
                let (mut own, mut through) = ([0.0; MOTIONS], [0.0; MOTIONS]);
                self.prescribed_rows([0.0; MOTIONS], &unit, &mut own);
                self.prescribed_rows(resultants, &[0.0; MOTIONS], &mut through);
                for row in 0..MOTIONS {
                    self.schur[row][motion] = own[row] - through[row];
                }
            }
            self.bordered.push(inverse);
        }
    }
}

impl LinearProblem for Linearised<'_> {
    fn apply(&mut self, unknowns: &[f64], equations: &mut [f64]) {
        let n = self.cells.len();
        let tractions = self.tractions(unknowns);
        let motions = std::array::from_fn(|motion| unknowns[3 * n + motion] * self.own[0]);
        let mut moved = self.operators.moved(&tractions);
        for (place, cell) in self.cells.iter().enumerate() {
            let by_motions = cell.moved(&motions);
            for part in 0..3 {
                moved[part][place] -= by_motions[part];
            }
        }
        self.cell_rows(&moved, unknowns, equations);
        let resultants = self.resultants(&tractions);
        self.prescribed_rows(resultants, &unknowns[3 * n..], &mut equations[3 * n..]);
    }

    fn hurry(&mut self, may: bool) -> bool {
        self.operators.hurry(may)
    }

    fn trust(&mut self) -> &mut Trust {
        &mut self.operators.trust
    }

    fn invert(&mut self, equations: &[f64], unknowns: &mut [f64]) {
        let n = self.cells.len();
        let is_known = |motion: usize| self.prescribed[motion] == Prescribed::Motion;
        let known: [f64; MOTIONS] =
            std::array::from_fn(|motion| if is_known(motion) { equations[3 * n + motion] } else { 0.0 });
        let mut left = equations.to_vec();
        if known != [0.0; MOTIONS] {
            add_scaled(&mut left[..3 * n], -1.0, &self.rows_of_motions(&known)[..3 * n]);
        }
        self.invert_cells(&left, unknowns);
        unknowns[3 * n..].fill(0.0);
        let resultants = self.resultants(&self.tractions(unknowns));
        let mut through = [0.0; MOTIONS];
        self.prescribed_rows(resultants, &[0.0; MOTIONS], &mut through);
        let right = std::array::from_fn(|motion| equations[3 * n + motion] - through[motion]);
        let amounts = solved(self.schur, right, 0.0);
        for (amount, inverse) in amounts.iter().zip(&self.bordered).filter(|(_, inverse)| !inverse.is_empty())
        {
            add_scaled(&mut unknowns[..3 * n], -amount, &inverse[..3 * n]);
        }
        unknowns[3 * n..].copy_from_slice(&amounts);
    }
}
