//! What an increment ends with: residuals, resultants, counts, the state after it.

use ndarray::Array2;
use serde::{Deserialize, Serialize};

use crate::model::{ContactState, Symmetry};

/// How well an increment satisfies its equations; all parts dimensionless.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Residual {
    /// Largest `|min(g, K p)|` over the cells, relative to the mean displacement under the load (no less than 1e-5 K times the mean pressure,
    /// or 1e-7 of the approach); g gap, p pressure, K normal self-influence of a cell.
    pub complementarity: f64,
    /// `|q - Proj(q + slip / K)| / |b|`, Euclidean norms over the cells in contact; Proj onto the friction disc of radius b, K tangential
    /// self-influence (the smaller of both axes), slip that at the end of the increment.
    pub coulomb: f64,
    /// Prescribed forces against the sums of the tractions, relative to the normal force (tangential: to the sum of the bounds; torsion: to
    /// that times the largest coordinate; moments of the pressure: to the normal force times its radius of gyration).
    pub equilibrium: f64,
}

impl Residual {
    /// The worse of two, each kind by itself.
    #[must_use]
    pub fn worse(&self, other: &Self) -> Self {
        Self {
            complementarity: worst([self.complementarity, other.complementarity]),
            coulomb: worst([self.coulomb, other.coulomb]),
            equilibrium: worst([self.equilibrium, other.equilibrium]),
        }
    }

    /// The worst of the three; not a number when any of them is none.
    pub fn largest(&self) -> f64 {
        worst([self.complementarity, self.coulomb, self.equilibrium])
    }
}

/// Largest of some values that are not negative; a value that is no number stays one.
pub fn worst(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(0.0, |most: f64, value| if value.is_nan() || value > most { value } else { most })
}

/// Work spent, in counts that do not depend on the machine.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Work {
    /// Operator applications, each one fused pass whatever its components.
    pub convolutions: usize,
    /// The same, each weighted by its number of cells over that of the whole grid: what applications in regions and on coarser
    /// grids are worth.
    #[serde(default)]
    pub full_grid_convolutions: f64,
    /// Preconditioner applications (unpadded).
    pub preconditioner_passes: usize,
    /// Newton iterations; without coupling with those of the pressure before them.
    pub outer_iterations: usize,
    /// Those of them whose iterates need not be feasible, the other way: 0 where the usual one solved the increment.
    #[serde(default)]
    pub augmented_steps: usize,
    /// Increments and sub-steps that were integrated by the end-point rule because that of second order did not converge.
    #[serde(default)]
    pub end_point_increments: usize,
}

impl std::ops::AddAssign for Work {
    fn add_assign(&mut self, other: Self) {
        self.convolutions += other.convolutions;
        self.full_grid_convolutions += other.full_grid_convolutions;
        self.preconditioner_passes += other.preconditioner_passes;
        self.outer_iterations += other.outer_iterations;
        self.augmented_steps += other.augmented_steps;
        self.end_point_increments += other.end_point_increments;
    }
}

/// What the contact as a whole does in an increment.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Regime {
    /// The bodies do not touch.
    Apart,
    /// Every cell in contact sticks.
    FullStick,
    /// Some cells stick, some slip.
    PartialSlip,
    /// Every cell in contact slips.
    GrossSlip,
    /// There is no friction.
    Frictionless,
}

/// Sums of the tractions.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Resultants {
    /// Normal force [force].
    pub normal: f64,
    /// Tangential force on the lower body [force].
    pub tangential: [f64; 2],
    /// Moment about the z axis of the grid on the lower body [force x length].
    pub moment: f64,
    /// First moments of the pressure along x and y [force x length].
    pub tilt_moment: [f64; 2],
}

/// What an increment did, apart from the fields.
#[derive(Debug, Clone, Copy)]
pub struct Outcome {
    /// Resultants of the tractions.
    pub resultants: Resultants,
    /// Cells in contact.
    pub contact_cells: usize,
    /// Cells that stick.
    pub stick_cells: usize,
    /// What the contact does.
    pub regime: Regime,
    /// How well the equations hold.
    pub residual: Residual,
}

impl Outcome {
    /// The outcome of the whole contact from that in front of its mirrors.
    pub(super) fn of_whole(self, symmetry: Symmetry) -> Self {
        let copies = symmetry.copies();
        let Resultants { normal, tangential, tilt_moment, .. } = self.resultants;
        let mirrored = symmetry.axes();
        let resultants = Resultants {
            normal: normal * copies as f64,
            tangential: symmetry.whole_force(tangential),
            moment: 0.0, // one side turns against the other
            tilt_moment: [0, 1]
                .map(|axis| if mirrored[axis] { 0.0 } else { tilt_moment[axis] * copies as f64 }),
        };
        Self {
            resultants,
            contact_cells: self.contact_cells * copies,
            stick_cells: self.stick_cells * copies,
            ..self
        }
    }
}

/// A solved increment. Its fields are those in front of the mirrors, its numbers those of the whole contact.
#[derive(Debug)]
pub struct Increment {
    /// Tractions, motions and history after the increment.
    pub state: ContactState,
    /// Resultants, counts, residuals.
    pub outcome: Outcome,
    /// Area of contact [length^2], from its edge between the cells.
    pub contact_area: f64,
    /// Area that sticks [length^2]: the fraction of the cells in contact that stick.
    pub stick_area: f64,
    /// Gap on the whole of the solver's grid [length].
    pub gap: Array2<f64>,
    /// What friction has dissipated in the increment by area [pressure x length], on the whole of the solver's grid; `None` where it is not asked
    /// for.
    pub friction_work: Option<Array2<f64>>,
    /// Whether the contact has travelled over both surfaces in it.
    pub travelled: bool,
    /// Work spent.
    pub work: Work,
}
