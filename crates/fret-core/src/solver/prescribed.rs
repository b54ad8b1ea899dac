//! The loads and motions that an increment prescribes, as its equations take them: sums over the cells, increments of motions, springs.

use crate::fields::sum;
use crate::model::{ContactState, Control, LoadStep, Rig};

/// What is prescribed along the normal, and what bounds the pressure under it.
#[derive(Debug, Clone, Copy)]
pub struct NormalLoad {
    /// Sum of the pressures over the cells, when the force is prescribed [pressure].
    pub total: Option<f64>,
    /// Approach of the body or of the actuator, when it is prescribed; that of the state before otherwise [length].
    pub approach: f64,
    /// By how much the machine gives under a unit of the summed pressure, where its far end is prescribed; 0: the approach is that of the
    /// body [length/pressure].
    pub give: f64,
    /// Sums of pressure times place along x and y over the length of the positions, where a moment is prescribed [pressure].
    pub moment: [Option<f64>; 2],
    /// The pressure at which the softer surface yields [pressure]; `None`: both are elastic.
    pub hardness: Option<f64>,
}

impl NormalLoad {
    /// The load at the end of an increment from a state, through a machine that gives. `length`: that of the positions, `area`: of a cell.
    pub fn new(state: &ContactState, load: &LoadStep, rig: Rig, [length, area]: [f64; 2]) -> Self {
        let (total, approach, give) = match load.normal {
            Control::Force(force) => (Some(force / area), state.approach, 0.0),
            Control::Motion(approach) => (None, approach, 0.0),
            Control::FarEnd(approach) => (None, approach, rig.normal * area),
        };
        let moment = load.tilt.map(|tilt| tilt.force().map(|moment| moment / (length * area)));
        Self { total, approach, give, moment, hardness: None }
    }

    /// The same on surfaces that yield at a hardness, if they do.
    pub fn with_hardness(self, hardness: Option<f64>) -> Self {
        Self { hardness, ..self }
    }

    /// The same on cells of which one is as many as `1 / share` of these.
    pub fn of_share(self, share: f64) -> Self {
        Self {
            total: self.total.map(|total| share * total),
            give: self.give / share,
            moment: self.moment.map(|moment| moment.map(|moment| share * moment)),
            ..self
        }
    }

    /// What the machine gives under pressures, or a change of them [length].
    pub fn given_way(&self, pressure: &[f64]) -> f64 {
        if self.give > 0.0 { self.give * sum(pressure) } else { 0.0 }
    }

    /// Approach of the body under pressures, where it does not follow from their sum [length].
    pub fn approach_under(&self, pressure: &[f64]) -> Option<f64> {
        self.total.is_none().then(|| self.approach - self.given_way(pressure))
    }
}

/// What is prescribed along the surface: of shift along x and y and of the twist.
#[derive(Debug, Clone, Copy, Default)]
pub struct TangentialLoads {
    /// Increments of prescribed motions: shift, twist x length [length]; 0 for the others.
    pub motion: [f64; 3],
    /// Sums of shear times mode over the cells, for motions by force, at no motion [pressure].
    pub resultant: [f64; 3],
    /// Which motions follow from a resultant, prescribed or falling with the motion.
    pub by_force: [bool; 3],
    /// By how much the resultant falls with the motion [pressure/length]: `sum q . mode + spring x motion = resultant`; 0 of a
    /// resultant that is prescribed.
    pub spring: [f64; 3],
}

impl TangentialLoads {
    /// The loads of an increment that goes from a state to `load`, through a machine that gives. `length`: that which makes a twist a
    /// motion, `area`: of a cell.
    pub fn new(state: &ContactState, load: &LoadStep, rig: Rig, [length, area]: [f64; 2]) -> Self {
        let controls = [load.tangential[0], load.tangential[1], load.twist];
        let now = [state.shift[0], state.shift[1], state.twist];
        let compliance = [rig.tangential[0], rig.tangential[1], 0.0];
        let units = [1.0, 1.0, length];
        let mut loads = Self::default();
        for mode in 0..3 {
            match controls[mode] {
                Control::FarEnd(target) if compliance[mode] > 0.0 => {
                    loads.by_force[mode] = true;
                    loads.spring[mode] = 1.0 / (compliance[mode] * area);
                    loads.resultant[mode] = (target - now[mode]) * loads.spring[mode];
                }
                // The far end of a spring that does not give is the body itself.
                Control::Motion(target) | Control::FarEnd(target) => {
                    loads.motion[mode] = (target - now[mode]) * units[mode];
                }
                Control::Force(target) => {
                    loads.by_force[mode] = true;
                    loads.resultant[mode] = target / (area * units[mode]);
                }
            }
        }
        loads
    }

    /// Increments of the motions of bodies that do not touch: a spring that carries nothing keeps its length.
    pub fn motion_apart(&self) -> [f64; 3] {
        let Self { spring, resultant, motion, .. } = self;
        [0, 1, 2].map(|mode| if spring[mode] > 0.0 { resultant[mode] / spring[mode] } else { motion[mode] })
    }

    /// Whether any motion follows from a resultant.
    pub fn any_by_force(&self) -> bool {
        self.by_force.contains(&true)
    }

    /// Which motions follow from a resultant that is prescribed as it is.
    pub fn held(&self) -> [bool; 3] {
        [0, 1, 2].map(|mode| self.by_force[mode] && self.spring[mode] == 0.0)
    }

    /// Whether the far end of a spring is prescribed.
    pub fn any_spring(&self) -> bool {
        self.spring != [0.0; 3]
    }

    /// Amounts of the motions that follow from a resultant; the others zero.
    pub fn only_by_force(&self, amounts: [f64; 3]) -> [f64; 3] {
        [0, 1, 2].map(|mode| if self.by_force[mode] { amounts[mode] } else { 0.0 })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn motions_that_are_prescribed_follow_from_no_force() {
        let loads = TangentialLoads { by_force: [false, true, false], ..TangentialLoads::default() };
        assert!(loads.any_by_force() && !TangentialLoads::default().any_by_force());
        assert_eq!(loads.only_by_force([1.0, 2.0, 3.0]), [0.0, 2.0, 0.0]);
    }

    /// A motion whose resultant falls with it follows from a force but is not held at one; without springs all that follow from a
    /// force are held.
    #[test]
    fn springs_take_motions_from_those_that_are_held() {
        let free = TangentialLoads::default();
        assert!(free.held() == [false; 3] && !free.any_spring());
        let loads = TangentialLoads {
            by_force: [true, true, false],
            spring: [0.0, 2.5, 0.0],
            ..TangentialLoads::default()
        };
        assert!(loads.held() == [true, false, false] && loads.any_spring());
    }
}
