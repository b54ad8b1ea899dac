//! Wear: the depth that slip takes off the surfaces, so that the gap opens.

use ndarray::{Array2, Zip};
use serde::{Deserialize, Serialize};

use super::friction::CoulombFriction;
use super::slip_increment::add_dissipation;
use super::state::ContactState;

/// What the worn depth follows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum WearLaw {
    /// `k p |ds|`: mean pressure of the increment times slip. Archard (1953), J. Appl. Phys. 24, 981.
    Archard,
    /// `k q . ds`: the energy that friction dissipates. Fouvry, Kapsa & Vincent (1996), Wear 200, 186.
    Energy,
}

/// How surfaces wear, and how many cycles a computed one stands for.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct WearRule {
    /// What the depth follows.
    pub law: WearLaw,
    /// Depth for pressure times slip, or for dissipated energy by area [1/pressure].
    pub coefficient: f64,
    /// Cycles that a computed one stands for, at the most.
    pub every: usize,
    /// Depth of such a block of cycles relative to the approach, at the most.
    pub largest_step: f64,
    /// Depth at which the run ends [length].
    pub limit: Option<f64>,
}

impl WearRule {
    /// Adds the depth [length] worn between two states that follow each other under a friction law. Only slipping cells have slip.
    pub fn add(
        &self,
        before: &ContactState,
        after: &ContactState,
        friction: &CoulombFriction,
        depth: &mut Array2<f64>,
    ) {
        for axis in 0..2 {
            debug_assert_eq!(before.slip[axis].dim(), depth.dim());
        }
        let k = self.coefficient;
        match self.law {
            WearLaw::Energy => add_dissipation(before, after, friction, k, depth),
            WearLaw::Archard => {
                let slip_y = &after.slip[1] - &before.slip[1];
                let pressure = &before.pressure + &after.pressure;
                Zip::from(depth)
                    .and(&pressure)
                    .and(&after.slip[0])
                    .and(&before.slip[0])
                    .and(&slip_y)
                    .for_each(|depth, p, now, then, y| *depth += k * 0.5 * p * (now - then).hypot(*y));
            }
        }
    }
}
