//! All that an increment leaves behind for the next one: history lives here and nowhere else.

use std::borrow::Cow;

use ndarray::Array2;
use serde::{Deserialize, Serialize};

use super::stored::{self, Number};

/// What a cell of the surface does.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[repr(u8)]
pub enum Zone {
    /// The surfaces are apart.
    #[default]
    Open = 0,
    /// In contact without slip in this increment.
    Stick = 1,
    /// In contact and slipping in this increment.
    Slip = 2,
}

impl Number for Zone {
    fn bytes(zones: &[Self]) -> Cow<'_, [u8]> {
        Cow::Owned(zones.iter().map(|&zone| zone as u8).collect())
    }

    fn numbers(bytes: &[u8]) -> Option<Vec<Self>> {
        let zones = [Self::Open, Self::Stick, Self::Slip];
        bytes.iter().map(|&byte| zones.get(usize::from(byte)).copied()).collect()
    }
}

/// Tractions, displacements and rigid motions at the end of an increment. Fields have shape `(nx, ny)`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ContactState {
    /// Contact pressure [pressure], compression positive.
    #[serde(with = "stored")]
    pub pressure: Array2<f64>,
    /// Shear traction on the lower body along x and y [pressure].
    #[serde(with = "stored")]
    pub shear: [Array2<f64>; 2],
    /// Slip accumulated along its path: sum of the increments of the upper point relative to the lower, x and y [length].
    #[serde(with = "stored")]
    pub slip: [Array2<f64>; 2],
    /// What each cell did in the last increment.
    #[serde(with = "stored")]
    pub zone: Array2<Zone>,
    /// Depth worn off both bodies together [length]; `None` where nothing wears.
    #[serde(with = "stored")]
    pub worn_depth: Option<Array2<f64>>,
    /// Rigid normal approach [length].
    pub approach: f64,
    /// Rigid tangential displacement of the upper body relative to the lower [length].
    pub shift: [f64; 2],
    /// Rotation of the upper body about z [rad].
    pub twist: f64,
    /// Work of friction since the start [force x length]; with wear that of all cycles that computed ones stand for.
    pub dissipated_energy: f64,
}

/// Mean of a slipping cell's friction bound over an increment in which its pressure goes evenly from `before` to `after`, relative
/// to the bound at its end [-]. One rule for the dissipated energy and for wear. With it the energy of a pressure that changes is
/// of second order in the increments; with the bound of the end alone it is of first order, and too large where pressure grows.
/// Exactly 1 where the pressure stays, a half for a cell that was open before.
pub fn mean_bound(before: f64, after: f64) -> f64 {
    // Bounded, so that what is multiplied with a pressure next to nothing stays a number.
    0.5 * (1.0 + (before / after).min(1e300))
}

impl ContactState {
    /// Bodies that have not touched yet.
    pub fn untouched(cells: [usize; 2]) -> Self {
        // Each made anew, not copied: zeros that nobody wrote to take no memory.
        let zero = || Array2::zeros(cells);
        Self {
            pressure: zero(),
            shear: [zero(), zero()],
            slip: [zero(), zero()],
            zone: Array2::from_elem(cells, Zone::Open),
            worn_depth: None,
            approach: 0.0,
            shift: [0.0; 2],
            twist: 0.0,
            dissipated_energy: 0.0,
        }
    }

    /// Whether this can be a state on a grid of `cells`: every field of its shape, every number finite.
    pub fn is_sound(&self, cells: [usize; 2]) -> bool {
        let [qx, qy] = &self.shear;
        let [sx, sy] = &self.slip;
        let motions = [self.approach, self.shift[0], self.shift[1], self.twist, self.dissipated_energy];
        let field = |field: &Array2<f64>| field.dim() == cells.into() && field.iter().all(|v| v.is_finite());
        [&self.pressure, qx, qy, sx, sy].into_iter().chain(&self.worn_depth).all(field)
            && self.zone.dim() == cells.into()
            && motions.iter().all(|motion| motion.is_finite())
    }
}
