//! The theory of critical distances: a parameter at half the critical distance below the surface, and its mean down to twice of it.

use ndarray::Array2;
use serde::Serialize;

use super::fatigue::Parameter;

/// The largest values over the surface by both methods. Source: Taylor (2007), *The Theory of Critical Distances*.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct AtDistance {
    /// The critical distance L [length].
    pub distance: f64,
    /// Point method: the largest value at the depth L/2, and its cell.
    pub point: (f64, [usize; 2]),
    /// Line method: the largest mean from the surface down to 2 L (or to the last depth), and its cell.
    pub line: (f64, [usize; 2]),
}

/// Collects the values of parameters from the surface down.
pub(super) struct Distances {
    distance: f64,
    lines: Vec<Line>,
}

/// What is known of one parameter under all cells.
struct Line {
    parameter: Parameter,
    /// The last depth and the values there.
    last: (f64, Array2<f64>),
    /// Integral from the surface down, and the depth to which it goes.
    integral: (f64, Array2<f64>),
    /// Values at half the distance.
    half: Option<Array2<f64>>,
}

impl Distances {
    pub(super) fn new(distance: f64) -> Self {
        Self { distance, lines: Vec::new() }
    }

    /// Whether the values of a parameter under all cells are wanted at a depth.
    pub(super) fn want(&self, parameter: Parameter, depth: f64) -> bool {
        let line = self.lines.iter().find(|line| line.parameter == parameter);
        parameter != Parameter::ShakedownStrength
            && (depth == 0.0 || line.is_some_and(|line| line.integral.0 < 2.0 * self.distance))
    }

    /// Takes the values at a depth, depths from 0 on, not falling; linear between them. Where a depth comes twice, at an interface, the
    /// parameter jumps.
    pub(super) fn take(&mut self, parameter: Parameter, depth: f64, values: &Array2<f64>) {
        let Some(line) = self.lines.iter_mut().find(|line| line.parameter == parameter) else {
            if self.want(parameter, depth) {
                let integral = (0.0, Array2::zeros(values.dim()));
                self.lines.push(Line { parameter, last: (0.0, values.clone()), integral, half: None });
            }
            return;
        };
        let (from, above) = (line.last.0, &line.last.1);
        let step = depth - from;
        if step > 0.0 {
            let at = |wanted: f64| {
                let share = ((wanted - from) / step).min(1.0);
                above + &((values - above) * share)
            };
            if line.half.is_none() && depth >= 0.5 * self.distance {
                line.half = Some(at(0.5 * self.distance));
            }
            let end = depth.min(2.0 * self.distance);
            if end > line.integral.0 {
                line.integral.1 += &((above + &at(end)) * (0.5 * (end - from)));
                line.integral.0 = end;
            }
        }
        line.last = (depth, values.clone());
    }

    /// The largest values over the surface.
    pub(super) fn found(self) -> Vec<(Parameter, AtDistance)> {
        let largest = |values: &Array2<f64>| {
            let first = (f64::NEG_INFINITY, [0, 0]);
            values
                .indexed_iter()
                .fold(first, |best, ((i, j), &value)| if value > best.0 { (value, [i, j]) } else { best })
        };
        let distance = self.distance;
        let of = |line: Line| {
            let (covered, integral) = line.integral;
            if covered <= 0.0 {
                return None;
            }
            let point = largest(line.half.as_ref()?);
            Some((line.parameter, AtDistance { distance, point, line: largest(&(integral / covered)) }))
        };
        self.lines.into_iter().filter_map(of).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A value that falls as `4 - 2 z` under one cell and jumps at an interface under another.
    #[test]
    fn both_methods_follow_the_polygon() {
        let mut distances = Distances::new(1.0);
        let parameter = Parameter::SmithWatsonTopper;
        for (depth, values) in [(0.0, [4.0, 1.0]), (0.75, [2.5, 1.0]), (0.75, [2.5, 5.0]), (3.0, [-2.0, 5.0])]
        {
            assert!(distances.want(parameter, depth) || depth > 2.0);
            distances.take(parameter, depth, &Array2::from_shape_vec((2, 1), values.to_vec()).unwrap());
        }
        assert!(!distances.want(parameter, 3.5));
        let found = distances.found();
        let (_, at) = found[0];
        assert_eq!(at.point, (3.0, [0, 0])); // at L/2 = 0.5
        let mean = 0.5 * (0.75 * 1.0 + 1.25 * 5.0); // over 2 L = 2
        assert!((at.line.0 - mean).abs() < 1e-15 && at.line.1 == [1, 0]);
    }
}
