//! The curve of load over depth that the solver computes for an indenter: the case, pressed to given depths.

use super::error::IdentifyError;
use super::request::Key;
use crate::case::{Case, Course, GridSize, Output, Path, Stage, StageControl};
use crate::plan::Plan;
use crate::run::{Silent, Simulation};

/// Depths at which the contact is solved, in equal factors from the smallest part of the largest one on. Below it the curve goes on as a power
/// of the depth: with fewer cells in the contact the grid would be seen.
const DEPTHS: usize = 8;
const SMALLEST: f64 = 1.0 / 16.0;

/// What the curves are computed from.
pub struct Indenter<'a> {
    case: Case,
    key: Key<'a>,
    depths: Vec<f64>,
}

impl<'a> Indenter<'a> {
    /// Of a case, up to a depth.
    ///
    /// # Errors
    /// When it is none of a single contact that ends, or cannot be planned.
    pub fn new(case: Case, key: Key<'a>, deepest: f64) -> Result<Self, IdentifyError> {
        let depths =
            (0..DEPTHS).map(|k| deepest * SMALLEST.powf(1.0 - k as f64 / (DEPTHS - 1) as f64)).collect();
        let mut indenter = Self { case, key, depths };
        indenter.case = indenter.pressed(indenter.case.clone())?;
        // The same cells for all values, so that nothing but these changes the curve.
        indenter.case.size = GridSize::Given(Plan::new(indenter.case.clone())?.grid.size());
        Ok(indenter)
    }

    /// The name of the number that is fitted, and what the case has.
    pub fn key(&self) -> (&str, f64) {
        (self.key.name, self.key.value)
    }

    /// The curve with a value of the key.
    ///
    /// # Errors
    /// When it cannot be solved.
    pub fn curve(&self, value: f64) -> Result<Curve, IdentifyError> {
        let mut case = self.pressed((self.key.case_with)(value)?)?;
        case.size = self.case.size;
        let history = Simulation::new(&Plan::new(case)?).run(&mut Silent)?;
        let points: Vec<[f64; 2]> = history
            .steps
            .iter()
            .filter(|step| step.normal_force > 0.0 && step.actuator_approach > 0.0)
            .map(|step| [step.actuator_approach.ln(), step.normal_force.ln()])
            .collect();
        if points.len() < 3 {
            return Err(refusal(
                "does not touch at the measured depths",
                "compare profile and units with the test",
            ));
        }
        Ok(Curve::through(points))
    }

    /// A case with one stage that presses it to the depths, without what the curve does not need.
    fn pressed(&self, mut case: Case) -> Result<Case, IdentifyError> {
        if case.periodic || case.is_line() {
            let help = "grid.cells = [nx, ny], without grid.periodic";
            return Err(refusal("has no depth of its own: an indenter presses one contact that ends", help));
        }
        let name = "indentation".to_owned();
        case.stages = vec![Stage {
            name,
            normal: Some(StageControl::Motion(Path::Through(self.depths.clone()))),
            tangential: [None, None],
            twist: None,
            tilt: [None, None],
            bulk_stress: [[None, None], [None, None]],
            roll: [None, None],
            steady: false,
            increments: self.depths.len(),
            history_tolerance: None,
            course: Course::Linear,
            friction: None,
        }];
        case.wear = None;
        case.friction_evolution = None;
        case.stress = None;
        case.output = Output { fields: Vec::new(), every: None };
        Ok(case)
    }
}

fn refusal(what: &str, help: &str) -> IdentifyError {
    IdentifyError::Log { what: format!("the case {what}"), help: help.to_owned() }
}

/// Load over depth, between the computed points by cubics in the logarithms: a power of the depth is one exactly.
#[derive(Debug)]
pub struct Curve {
    /// Logarithms of depth and load, and the exponent there.
    points: Vec<[f64; 3]>,
}

impl Curve {
    /// Through points by their logarithms, three at least; exponents are those of the parabola through three neighbours.
    fn through(points: Vec<[f64; 2]>) -> Self {
        let last = points.len() - 1;
        let exponent = |k: usize| {
            let middle = k.clamp(1, last - 1);
            let [[a, u], [b, v], [c, w]] = [points[middle - 1], points[middle], points[middle + 1]];
            let [first, second] = [(v - u) / (b - a), (w - v) / (c - b)];
            first + (second - first) / (c - a) * (2.0 * points[k][0] - a - b)
        };
        Self { points: (0..=last).map(|k| [points[k][0], points[k][1], exponent(k)]).collect() }
    }

    /// Load and its derivative at a depth; nothing above the surface.
    pub fn at(&self, depth: f64) -> [f64; 2] {
        if depth <= 0.0 {
            return [0.0; 2];
        }
        let x = depth.ln();
        let after = self.points.partition_point(|point| point[0] <= x);
        let [value, exponent] = match after {
            0 => power(self.points[0], x),
            _ if after == self.points.len() => power(self.points[after - 1], x),
            _ => {
                let [[a, u, m], [b, v, n]] = [self.points[after - 1], self.points[after]];
                let (wide, part) = (b - a, (x - a) / (b - a));
                let chord = (v - u) / wide;
                let (second, third) = (3.0 * chord - 2.0 * m - n, m + n - 2.0 * chord);
                let value = u + wide * part * (m + part * (second + part * third));
                [value, m + part * (2.0 * second + 3.0 * part * third)]
            }
        };
        let load = value.exp();
        [load, load * exponent / depth]
    }
}

/// Beyond the points: the power of the depth that the last one has.
fn power([x, value, exponent]: [f64; 3], at: f64) -> [f64; 2] {
    [value + exponent * (at - x), exponent]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Sneddon's powers are met anywhere; what bends in the logarithms, to the third order.
    #[test]
    fn powers_of_the_depth_are_met_between_the_points_and_beyond() {
        let depths: Vec<f64> = (0..8).map(|k| SMALLEST.powf(1.0 - f64::from(k) / 7.0)).collect();
        for exponent in [1.0, 1.5, 2.0] {
            let curve = Curve::through(
                depths.iter().map(|d: &f64| [d.ln(), (3.0 * d.powf(exponent)).ln()]).collect(),
            );
            for depth in [1e-3_f64, 0.1, 0.37, 0.99, 1.2] {
                let [load, slope] = curve.at(depth);
                assert!((load / (3.0 * depth.powf(exponent)) - 1.0).abs() < 1e-12);
                assert!((slope / (3.0 * exponent * depth.powf(exponent - 1.0)) - 1.0).abs() < 1e-12);
            }
        }
        let bent = |d: f64| d.powf(1.5) * (1.0 + d);
        let curve = Curve::through(depths.iter().map(|d: &f64| [d.ln(), bent(*d).ln()]).collect());
        assert!((curve.at(0.6)[0] / bent(0.6) - 1.0).abs() < 1e-3);
        assert_eq!(curve.at(-0.1), [0.0; 2]);
    }
}
