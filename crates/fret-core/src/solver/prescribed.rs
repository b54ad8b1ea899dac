//! The loads and motions that an increment prescribes, as its equations take them: sums over the cells, increments of motions, springs.

use crate::model::{ContactState, Control, LoadStep, Rig};

/// What is prescribed in one increment.
#[derive(Debug, Clone, Copy)]
pub struct PrescribedLoads {
    /// Sum of the pressures over the cells, when the force is prescribed [pressure].
    pub total: Option<f64>,
    /// Approach of the body or of the actuator, when it is prescribed; that of the state before otherwise [length].
    pub approach: f64,
    /// By how much the machine gives under a unit of the summed pressure, where its far end is prescribed [length/pressure].
    pub approach_give: f64,
    /// Increments of prescribed motions: shift, twist x length [length].
    pub motion: [f64; 3],
    /// Sums of shear times mode over the cells, for motions by force, at no motion [pressure].
    pub resultant: [f64; 3],
    /// Which motions follow from a resultant.
    pub by_force: [bool; 3],
    /// By how much their resultants fall with the motion [pressure/length].
    pub spring: [f64; 3],
}

impl PrescribedLoads {
    /// The loads of an increment that goes from a state to `load`, through a machine that gives. `length`: that which makes a twist a
    /// motion, `area`: of a cell.
    pub fn new(state: &ContactState, load: &LoadStep, rig: Rig, [length, area]: [f64; 2]) -> Self {
        let controls = [load.tangential[0], load.tangential[1], load.twist];
        let now = [state.shift[0], state.shift[1], state.twist];
        let compliance = [rig.tangential[0], rig.tangential[1], 0.0];
        let units = [1.0, 1.0, length];
        let (mut motion, mut resultant, mut spring) = ([0.0; 3], [0.0; 3], [0.0; 3]);
        let mut by_force = [false; 3];
        for mode in 0..3 {
            match controls[mode] {
                Control::FarEnd(target) if compliance[mode] > 0.0 => {
                    by_force[mode] = true;
                    spring[mode] = 1.0 / (compliance[mode] * area);
                    resultant[mode] = (target - now[mode]) * spring[mode];
                }
                // The far end of a spring that does not give is the body itself.
                Control::Motion(target) | Control::FarEnd(target) => {
                    motion[mode] = (target - now[mode]) * units[mode];
                }
                Control::Force(target) => {
                    by_force[mode] = true;
                    resultant[mode] = target / (area * units[mode]);
                }
            }
        }
        let (total, approach, approach_give) = match load.normal {
            Control::Force(force) => (Some(force / area), state.approach, 0.0),
            Control::Motion(approach) => (None, approach, 0.0),
            Control::FarEnd(approach) => (None, approach, rig.normal * area),
        };
        Self { total, approach, approach_give, motion, resultant, by_force, spring }
    }

    /// Increments of the motions of bodies that do not touch: a spring that carries nothing keeps its length.
    pub fn motion_apart(&self) -> [f64; 3] {
        let Self { spring, resultant, motion, .. } = self;
        [0, 1, 2].map(|mode| if spring[mode] > 0.0 { resultant[mode] / spring[mode] } else { motion[mode] })
    }
}
