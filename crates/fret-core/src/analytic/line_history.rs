//! A cylinder under constant normal force and any sequence of tangential forces along one line.

use std::f64::consts::{FRAC_1_PI, PI};

use fret_table::functions;
use serde::Serialize;

use super::error::{AnalyticError, positive};
use super::hertz_line::HertzLine;

/// Partial slip of a Hertz line contact whose tangential force per length goes to and fro as it likes, at constant normal force.
///
/// A first loading to Q' leaves `c = a √f`, `f = 1 − |Q'|/μP'`, shear `μp0 [√(1 − x²/a²) − (c/a) √(1 − x²/c²)]`, and displaces the bodies by
/// `D/(2π) μP' f ln f` besides what is proportional to Q' (Cattaneo 1938; Mindlin 1949), with the compliance D of the pair, see
/// [`LineHistory::new`]. Masing's memory as in [`TangentialHistory`](super::TangentialHistory); the energy dissipated by friction is then
/// `Q' φ − 2 ∫ φ dQ'` of a first loading and twice that of half the change on a branch (Jäger 1993). For bodies that do not couple.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LineHistory {
    half_width: f64,
    max_shear: f64,
    sliding_force: f64,
    compliance: f64,
    turning_points: Vec<f64>,
    force: f64,
    heading: f64,
    dissipated_energy: f64,
}

#[functions]
impl LineHistory {
    /// Contact at rest, from the normal contact, the friction coefficient μ [-] and the compliance D of the pair: `2/E*` for a force across
    /// the axis, the sum of `1/G` of both bodies for one along it [1/pressure].
    ///
    /// # Errors
    /// When μ or D is not positive and finite.
    pub fn new(hertz: &HertzLine, friction: f64, compliance: f64) -> Result<Self, AnalyticError> {
        let (friction, compliance) = (positive("friction", friction)?, positive("compliance", compliance)?);
        Ok(Self {
            half_width: hertz.half_width,
            max_shear: friction * hertz.max_pressure,
            sliding_force: friction * hertz.line_force,
            compliance,
            turning_points: Vec::new(),
            force: 0.0,
            heading: 0.0,
            dissipated_energy: 0.0,
        })
    }

    /// Moves the tangential force per length monotonically from where it is to Q' [force/length].
    ///
    /// # Errors
    /// When `|Q'| > μP'`; the history is then unchanged.
    pub fn push(&mut self, tangential_force: f64) -> Result<(), AnalyticError> {
        if !(tangential_force.abs() <= self.sliding_force) {
            return Err(AnalyticError::TooLarge {
                name: "tangential force",
                value: tangential_force,
                reason: "friction holds at most",
                limit: self.sliding_force,
            });
        }
        while self.force != tangential_force {
            let heading = (tangential_force - self.force).signum();
            if heading * self.heading < 0.0 {
                self.turning_points.push(self.force);
            }
            self.heading = heading;
            let end = match self.turning_points.as_slice() {
                [] => heading * self.sliding_force,
                [only] => -only,
                [.., before, _] => *before,
            };
            let reached = if heading > 0.0 { tangential_force.min(end) } else { tangential_force.max(end) };
            self.dissipated_energy += self.branch_energy(reached) - self.branch_energy(self.force);
            self.force = reached;
            if reached == end {
                self.turning_points.truncate(self.turning_points.len().saturating_sub(2));
            }
        }
        Ok(())
    }

    /// Tangential force per length Q' it is at [force/length].
    pub fn tangential_force(&self) -> f64 {
        self.force
    }

    /// Forces per length at which it turned and which it remembers [force/length].
    pub fn turning_points(&self) -> &[f64] {
        &self.turning_points
    }

    /// What is not slipped of the sliding force on a first loading, over it: `1 − |Q'|/μP'`.
    fn left(&self, force: f64) -> f64 {
        (1.0 - force.abs() / self.sliding_force).max(0.0)
    }

    /// Energy dissipated by friction in a first loading: `Q φ − 2 ∫ φ dQ` with `φ = D/(2π) μP f ln f`.
    fn first_energy(&self, force: f64) -> f64 {
        let f = self.left(force);
        let logarithm = if f > 0.0 { f * libm::log(f) } else { 0.0 };
        let integral = -0.25 - 0.5 * f * logarithm + 0.25 * f * f;
        let scale = self.compliance / (2.0 * PI) * self.sliding_force * self.sliding_force;
        scale * ((1.0 - f) * logarithm - 2.0 * integral)
    }

    fn branch_energy(&self, force: f64) -> f64 {
        match self.turning_points.last() {
            None => self.first_energy(force),
            Some(turn) => 2.0 * self.first_energy((force - turn) / 2.0),
        }
    }

    /// The first loadings whose sum, with these weights, is the present state; the present branch comes last.
    fn parts(&self) -> impl Iterator<Item = (f64, f64)> {
        let ends = self.turning_points.iter().copied().chain([self.force]);
        let starts = [0.0].into_iter().chain(self.turning_points.iter().copied());
        ends.zip(starts).enumerate().map(|(branch, (end, start))| {
            let weight = if branch == 0 { 1.0 } else { 2.0 };
            (weight, (end - start) / weight)
        })
    }

    /// Tangential displacement of the bodies relative to points so far below their surfaces [length], `at_datum` being what a unit force
    /// per length moves the surface above it less than `D/π ln(depth/x)` at the distance x [length²/force].
    pub fn shift(&self, depth: f64, at_datum: f64) -> f64 {
        let even = self.compliance * FRAC_1_PI * (libm::log(2.0 * depth / self.half_width) + 0.5) - at_datum;
        let bent = |force: f64| {
            let f = self.left(force);
            let logarithm = if f > 0.0 { f * libm::log(f) } else { 0.0 };
            force.signum() * self.compliance / (2.0 * PI) * self.sliding_force * logarithm
        };
        self.force * even + self.parts().map(|(weight, force)| weight * bent(force)).sum::<f64>()
    }

    /// Half-width of what has not slipped on the present branch [length].
    pub fn stick_half_width(&self) -> f64 {
        self.half_width * self.parts().last().map_or(1.0, |(_, force)| self.left(force).sqrt())
    }

    /// Shear at `x` from the middle [pressure], along the force; zero outside the contact.
    #[shown]
    pub fn shear(&self, x: f64) -> f64 {
        let a = self.half_width;
        let root = |half: f64| ((half - x) * (half + x)).max(0.0).sqrt() / a;
        let first = |force: f64| {
            let stick = a * self.left(force).sqrt();
            force.signum() * self.max_shear * (root(a) - root(stick))
        };
        self.parts().map(|(weight, force)| weight * first(force)).sum()
    }

    /// Energy dissipated by friction per length since the start [force].
    pub fn dissipated_energy(&self) -> f64 {
        self.dissipated_energy
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analytic::CattaneoLine;

    const MODULUS: f64 = 3.0;

    fn at_rest() -> LineHistory {
        LineHistory::new(&hertz(), 0.5, 2.0 / MODULUS).unwrap()
    }

    fn hertz() -> HertzLine {
        HertzLine::cylinder(50.0, 0.02, MODULUS).unwrap()
    }

    #[test]
    fn a_first_loading_is_that_of_cattaneo() {
        let mut history = at_rest();
        history.push(4e-3).unwrap();
        let exact = CattaneoLine::new(&hertz(), 0.5, MODULUS, 4e-3, 0.0).unwrap();
        assert!((history.stick_half_width() / exact.stick_half_width - 1.0).abs() < 1e-14);
        for x in [0.0, 0.1, 0.3, 0.5] {
            assert!((history.shear(x) - exact.shear(x)).abs() < 1e-16);
        }
        assert!(history.push(0.011).is_err());
    }

    /// Shear carries the force; the loop's area is what is lost; loops that close are forgotten.
    #[test]
    fn a_history_carries_its_force_and_loses_the_area_of_its_loops() {
        let mut history = at_rest();
        for force in [6e-3, -2e-3, 5e-3, 1e-3, 4e-3, -6e-3] {
            history.push(force).unwrap();
            let a = hertz().half_width;
            let place = |i: i32| a * (f64::from(i) + 0.5) / 20_000.0;
            let carried: f64 = (-20_000..20_000).map(|i| history.shear(place(i)) * a / 20_000.0).sum();
            assert!((carried - force).abs() < 1e-8, "{carried} {force}"); // roots at the edges of stick, n^-1.5 each
        }
        assert_eq!(history.turning_points.len(), 0);
        let before = history.dissipated_energy();
        let (mut area, mut last) = (0.0, (-6e-3, history.shift(1.0, 0.0)));
        for step in 1..=4000 {
            let force = -6e-3 * (1.0 - f64::from(step) / 2000.0).abs() * 2.0 + 6e-3;
            history.push(force).unwrap();
            let here = (force, history.shift(1.0, 0.0));
            area += 0.5 * (here.0 + last.0) * (here.1 - last.1);
            last = here;
        }
        let lost = history.dissipated_energy() - before;
        assert!((area / lost - 1.0).abs() < 1e-4, "{area} {lost}"); // trapezoid of 2000 steps a branch
    }
}
