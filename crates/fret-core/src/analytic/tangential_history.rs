//! A sphere under constant normal force and any sequence of tangential forces along one line.

use fret_table::functions;
use serde::Serialize;

use super::cattaneo_mindlin::CattaneoMindlin;
use super::error::AnalyticError;
use super::hertz::Hertz;

/// Partial slip of a Hertz contact whose tangential force goes to and fro as it likes, at constant normal force.
///
/// Masing's memory: after a turning point the contact answers to the change of force as twice a first loading answers to half of it,
/// `shift = φ(T1) + 2φ((T2 − T1)/2) + … + 2φ((T − Tn)/2)`, shear alike; a branch that comes back to the turning point before last closes
/// a small loop and both are forgotten. Source: Mindlin & Deresiewicz (1953); Jäger (1993), Arch. Appl. Mech. 63, 402, for the general
/// rule. Limits as for [`CattaneoMindlin`]. Cost: a push is O(turning points remembered), as are shift and shear.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TangentialHistory {
    contact: CattaneoMindlin,
    turning_points: Vec<f64>,
    force: f64,
    heading: f64,
    dissipated_energy: f64,
}

#[functions]
impl TangentialHistory {
    /// Contact at rest, from the normal contact, the friction coefficient μ [-] and the effective shear modulus G* [pressure].
    ///
    /// # Errors
    /// When μ or G* is not positive and finite.
    pub fn new(hertz: &Hertz, friction: f64, shear_modulus: f64) -> Result<Self, AnalyticError> {
        Ok(Self {
            contact: CattaneoMindlin::unloaded(hertz, friction, shear_modulus)?,
            turning_points: Vec::new(),
            force: 0.0,
            heading: 0.0,
            dissipated_energy: 0.0,
        })
    }

    /// Moves the tangential force monotonically from where it is to T [force].
    ///
    /// # Errors
    /// When `|T| > μP`; the history is then unchanged.
    pub fn push(&mut self, tangential_force: f64) -> Result<(), AnalyticError> {
        self.contact.checked_under("tangential force", tangential_force)?;
        while self.force != tangential_force {
            self.head_for(tangential_force);
            let end = self.branch_end();
            let reached =
                if self.heading > 0.0 { tangential_force.min(end) } else { tangential_force.max(end) };
            self.dissipated_energy += self.branch_energy(reached) - self.branch_energy(self.force);
            self.force = reached;
            if reached == end {
                self.forget_closed_loop();
            }
        }
        Ok(())
    }

    fn head_for(&mut self, tangential_force: f64) {
        let heading = (tangential_force - self.force).signum();
        if heading * self.heading < 0.0 {
            self.turning_points.push(self.force);
        }
        self.heading = heading;
    }

    /// The force at which the present branch ends and an older one goes on.
    fn branch_end(&self) -> f64 {
        match self.turning_points.as_slice() {
            [] => self.heading * self.contact.sliding_force,
            [only] => -only,
            [.., before, _] => *before,
        }
    }

    fn forget_closed_loop(&mut self) {
        self.turning_points.truncate(self.turning_points.len().saturating_sub(2));
    }

    /// Energy dissipated by friction from the start of the present branch to a force on it.
    fn branch_energy(&self, force: f64) -> f64 {
        match self.turning_points.last() {
            None => self.contact.under(force).dissipated_energy(),
            Some(turn) => 2.0 * self.contact.under((force - turn) / 2.0).dissipated_energy(),
        }
    }

    /// The first loadings whose sum, with these weights, is the present state; the present branch comes last.
    fn parts(&self) -> impl Iterator<Item = (f64, CattaneoMindlin)> {
        let ends = self.turning_points.iter().copied().chain([self.force]);
        let starts = [0.0].into_iter().chain(self.turning_points.iter().copied());
        ends.zip(starts).enumerate().map(|(branch, (end, start))| {
            let weight = if branch == 0 { 1.0 } else { 2.0 };
            (weight, self.contact.under((end - start) / weight))
        })
    }

    /// Tangential force T [force].
    pub fn tangential_force(&self) -> f64 {
        self.force
    }

    /// Forces at which the motion turned and which the contact still remembers [force], oldest first.
    pub fn turning_points(&self) -> &[f64] {
        &self.turning_points
    }

    /// Tangential shift of the bodies [length].
    pub fn shift(&self) -> f64 {
        self.parts().map(|(weight, part)| weight * part.shift).sum()
    }

    /// Radius of the disc that has not slipped on the present branch [length].
    pub fn stick_radius(&self) -> f64 {
        self.parts().last().map_or(self.contact.contact_radius, |(_, part)| part.stick_radius)
    }

    /// Shear at distance `r` from the middle [pressure], along the force; zero outside the contact.
    #[shown]
    pub fn shear(&self, r: f64) -> f64 {
        self.parts().map(|(weight, part)| weight * part.shear(r)).sum()
    }

    /// Energy dissipated by friction since the start [force x length].
    pub fn dissipated_energy(&self) -> f64 {
        self.dissipated_energy
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::TangentialHistory;
    use crate::analytic::cattaneo_mindlin::tests::STEEL_SHEAR_MODULUS;
    use crate::analytic::hertz::tests::steel_example;
    use crate::analytic::mindlin_deresiewicz::{Branch, MindlinDeresiewicz};

    fn at_rest() -> TangentialHistory {
        TangentialHistory::new(&steel_example(), 0.1, STEEL_SHEAR_MODULUS).unwrap()
    }

    fn after(forces: &[f64]) -> TangentialHistory {
        let mut history = at_rest();
        for &force in forces {
            history.push(force).unwrap();
        }
        history
    }

    #[test]
    fn a_steady_cycle_is_the_loop_of_mindlin_and_deresiewicz() {
        let fretting = MindlinDeresiewicz::new(&steel_example(), 0.1, STEEL_SHEAR_MODULUS, 9.2).unwrap();
        let (unloading, reloading) = (after(&[9.2, -4.0]), after(&[9.2, -9.2, 3.0]));
        for (history, point) in [
            (&unloading, fretting.at(Branch::Unloading, -4.0).unwrap()),
            (&reloading, fretting.at(Branch::Reloading, 3.0).unwrap()),
        ] {
            assert!((history.shift() - point.shift()).abs() < 1e-17);
            assert!((history.stick_radius() - point.stick_radius()).abs() < 1e-15);
            for r in [0.0, 0.05, 0.1, 0.14] {
                assert!((history.shear(r) - point.shear(r)).abs() < 1e-11);
            }
        }
        let (one, two) = (after(&[9.2, -9.2, 9.2]), after(&[9.2, -9.2, 9.2, -9.2, 9.2]));
        let cycle = two.dissipated_energy() - one.dissipated_energy();
        assert!((cycle / fretting.dissipated_energy_per_cycle() - 1.0).abs() < 1e-13);
        assert!(two.turning_points().is_empty());
    }

    #[test]
    fn a_small_loop_closes_and_is_forgotten() {
        let (plain, detour) = (after(&[8.0, -1.0, -6.0]), after(&[8.0, 2.0, 5.0, -1.0, 3.0, 1.0, 2.5, -6.0]));
        assert_eq!(plain.turning_points(), detour.turning_points());
        assert_eq!(plain.shift(), detour.shift());
        assert!(detour.dissipated_energy() > plain.dissipated_energy());
    }

    #[test]
    fn splitting_a_stroke_changes_nothing() {
        let (one, many) = (after(&[7.0, -5.0, 6.0]), after(&[1.0, 7.0, 3.0, 0.0, -5.0, 4.9, 6.0]));
        assert_eq!((one.shift(), one.shear(0.07)), (many.shift(), many.shear(0.07)));
        assert!((one.dissipated_energy() / many.dissipated_energy() - 1.0).abs() < 1e-13);
    }

    #[test]
    fn a_long_irregular_history_keeps_the_physics() {
        // Shear carries the force, friction bounds it, and what is lost is never given back.
        let hertz = steel_example();
        let mut history = at_rest();
        let mut seed = 12_345_u64;
        for _ in 0..200 {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let before = history.dissipated_energy();
            history.push(20.0 * ((seed >> 11) as f64 / 9_007_199_254_740_992.0) - 10.0).unwrap();
            assert!(history.dissipated_energy() >= before);
            let n = 4000;
            let mut carried = 0.0;
            for k in 0..n {
                // r² grows evenly, so each ring weighs the same
                let r = hertz.contact_radius * ((f64::from(k) + 0.5) / f64::from(n)).sqrt();
                carried += history.shear(r) * PI * hertz.contact_radius.powi(2) / f64::from(n);
                assert!(history.shear(r).abs() <= 0.1 * hertz.pressure(r) * (1.0 + 1e-12));
            }
            assert!((carried - history.tangential_force()).abs() < 2e-4); // midpoint sum over square-root kinks, n^-1.5 each
        }
    }

    #[test]
    fn loss_of_a_closed_inner_loop_is_its_area() {
        let mut history = after(&[9.0, -2.0]);
        let start = history.dissipated_energy();
        let mut area = 0.0;
        let n = 2000;
        for (from, to) in [(-2.0, 6.0), (6.0, -2.0)] {
            for k in 1..=n {
                let (force, shift) = (history.tangential_force(), history.shift());
                history.push(from + (to - from) * f64::from(k) / f64::from(n)).unwrap();
                area += f64::midpoint(force, history.tangential_force()) * (history.shift() - shift);
            }
        }
        assert!((area / (history.dissipated_energy() - start) - 1.0).abs() < 1e-5); // trapezium in 2000 steps
    }

    #[test]
    fn a_force_beyond_friction_leaves_the_history_alone() {
        let mut history = after(&[3.0]);
        assert!(history.push(10.5).is_err());
        assert_eq!(history, after(&[3.0]));
        history.push(10.0).unwrap();
        assert_eq!(history.stick_radius(), 0.0);
        history.push(-10.0).unwrap();
        assert!(history.turning_points().is_empty());
    }
}
