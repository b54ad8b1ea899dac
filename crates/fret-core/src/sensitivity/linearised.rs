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
use super::cell_rows::{CellRows, slip_weight};
use super::error::SensitivityError;
use super::fields::Fields;
use super::krylov::{LinearProblem, Searches};
use super::operators::Operators;
use crate::fields::{add_scaled, solved};
use crate::solver::{ContactSet, SlipWeights};

/// The linearised equations of one increment.
pub(super) struct Linearised<'a> {
    pub(super) operators: &'a mut Operators,
    pub(super) contact: &'a ContactSet,
    pub(super) cells: &'a [Cell],
    pub(super) rows: CellRows,
    pub(super) prescribed: [Prescribed; MOTIONS],
    pub(super) weights: SlipWeights<f64>,
    /// Fields before and after an operator, packed: what is in them is nobody's.
    pub(super) through: [Fields; 2],
    /// What is left along the surface on the way through the approximate inverse: nobody's, too.
    pub(super) left: [Vec<f64>; 2],
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
        let rows = CellRows::new(cells, own);
        let mut problem = Self {
            operators,
            contact,
            cells,
            prescribed,
            weights,
            through: [rows.no_fields(), rows.no_fields()],
            left: [(); 2].map(|()| vec![0.0; rows.len()]),
            rows,
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

    /// Unknowns of a vector: tractions on all cells of the region [pressure], and motions [length].
    pub fn parted(&self, unknowns: &[f64]) -> (Fields, [f64; MOTIONS]) {
        let n = self.cells.len();
        let mut packed = self.rows.no_fields();
        self.rows.tractions(unknowns, &mut packed);
        let tractions = packed.map(|packed| {
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
                    right[n + place] = tangential[0] * slip_weight(compliance, self.own[1]) / self.own[0];
                }
                Shear::Follows => {}
            }
        }
        for motion in 0..MOTIONS {
            right[3 * n + motion] = motions[motion] * self.weight_of(motion);
        }
        right
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

    /// The approximate inverse of the equations of the cells alone.
    fn invert_cells(&mut self, equations: &[f64], unknowns: &mut [f64]) {
        let Self { operators, rows, weights, through: [right, found], .. } = self;
        rows.to_remove(equations, right);
        operators.removed(right, found, weights);
        rows.removed(found, equations, unknowns);
    }

    /// What motions make of the rows of the cells.
    fn rows_of_motions(&self, amounts: &[f64; MOTIONS]) -> Vec<f64> {
        let (nothing, mut rows) = (vec![0.0; self.len()], vec![0.0; self.len()]);
        let moved = amounts.map(|amount| amount * self.own[0]);
        self.rows.equations(&self.rows.no_fields(), moved, &nothing, &mut rows);
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
                let resultants = self.rows.tractions(&inverse, &mut self.through[0]);
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
        let Self { operators, rows, through: [tractions, moved], own, .. } = self;
        let resultants = rows.tractions(unknowns, tractions);
        operators.moved(tractions, moved);
        let motions = std::array::from_fn(|motion| unknowns[3 * n + motion] * own[0]);
        rows.equations(moved, motions, unknowns, equations);
        self.prescribed_rows(resultants, &unknowns[3 * n..], &mut equations[3 * n..]);
    }

    fn hurry(&mut self, may: bool) -> bool {
        self.operators.hurry(may)
    }

    fn searches(&mut self) -> &mut Searches {
        &mut self.operators.searches
    }

    fn invert(&mut self, equations: &[f64], unknowns: &mut [f64]) {
        let n = self.cells.len();
        let is_known = |motion: usize| self.prescribed[motion] == Prescribed::Motion;
        let known: [f64; MOTIONS] =
            std::array::from_fn(|motion| if is_known(motion) { equations[3 * n + motion] } else { 0.0 });
        if known == [0.0; MOTIONS] {
            self.invert_cells(equations, unknowns);
        } else {
            let mut left = equations.to_vec();
            add_scaled(&mut left[..3 * n], -1.0, &self.rows_of_motions(&known)[..3 * n]);
            self.invert_cells(&left, unknowns);
        }
        unknowns[3 * n..].fill(0.0);
        let resultants = self.rows.tractions(unknowns, &mut self.through[0]);
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
