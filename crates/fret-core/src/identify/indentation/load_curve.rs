//! Load over depth of an indenter between the points that were computed, with its derivatives by the numbers that are fitted, and as an
//! instrument shows it whose frame gives.

use nalgebra::{DMatrix, DVector};

/// Steps to the depth of the contact behind a frame that gives, at the most.
const STEPS: usize = 60;
/// Part of the slope of a rigid frame below which that of a frame is not followed: frames do not push.
const LEAST_SLOPE: f64 = 0.05;

/// A function of the logarithm of the depth: the cubic spline through points (no knot at the last but one on either side); lines beyond. It
/// is linear in the values at the points, so that its derivatives are those of the values, found in the same way.
#[derive(Debug, Clone)]
struct Cubics {
    /// Place, value and slope.
    points: Vec<[f64; 3]>,
}

impl Cubics {
    /// Through three points at least, by their places.
    fn through(points: &[[f64; 2]]) -> Self {
        let last = points.len() - 1;
        let [wide, chord]: [Vec<f64>; 2] = [0, 1].map(|k| {
            let of = |two: &[[f64; 2]]| {
                let wide = two[1][0] - two[0][0];
                if k == 0 { wide } else { (two[1][1] - two[0][1]) / wide }
            };
            points.windows(2).map(of).collect()
        });
        // The second derivative goes through each point, the third through the last but one on either side; of three points the parabola.
        let mut matrix = DMatrix::zeros(last + 1, last + 1);
        let mut right = DVector::zeros(last + 1);
        for k in 1..last {
            let [before, after] = [1.0 / wide[k - 1], 1.0 / wide[k]];
            for (place, factor) in [(k - 1, before), (k, 2.0 * (before + after)), (k + 1, after)] {
                matrix[(k, place)] = factor;
            }
            right[k] = 3.0 * (chord[k - 1] * before + chord[k] * after);
        }
        for (row, k) in [(0, 1), (last, last - 1)] {
            let [before, after] = [wide[k - 1].powi(-2), wide[k].powi(-2)];
            // Of three points both say the same: the second derivative of the first cubic does not change, either.
            let is_parabola = last == 2 && row == 0;
            let factors = if is_parabola { [1.0, 1.0, 0.0] } else { [before, before - after, -after] };
            for (place, factor) in (k - 1..=k + 1).zip(factors) {
                matrix[(row, place)] = factor;
            }
            right[row] = 2.0 * if is_parabola { chord[0] } else { chord[k - 1] * before - chord[k] * after };
        }
        let slopes = matrix.lu().solve(&right);
        // Places that grow have a spline.
        let slope = |k: usize| slopes.as_ref().map_or(chord[k.min(last - 1)], |slopes| slopes[k]);
        Self { points: (0..=last).map(|k| [points[k][0], points[k][1], slope(k)]).collect() }
    }

    /// Value and slope at a place.
    fn at(&self, x: f64) -> [f64; 2] {
        let after = self.points.partition_point(|point| point[0] <= x);
        if after == 0 || after == self.points.len() {
            let [place, value, slope] = self.points[after.saturating_sub(1)];
            return [value + slope * (x - place), slope];
        }
        let [[a, u, m], [b, v, n]] = [self.points[after - 1], self.points[after]];
        let (wide, part) = (b - a, (x - a) / (b - a));
        let chord = (v - u) / wide;
        let (second, third) = (3.0 * chord - 2.0 * m - n, m + n - 2.0 * chord);
        let value = u + wide * part * (m + part * (second + part * third));
        [value, m + part * (2.0 * second + 3.0 * part * third)]
    }
}

/// Load over depth, between the computed points by a spline in the logarithms: a power of the depth is met exactly. Below the first point and
/// beyond the last one it is the power of the depth that the curve has there.
#[derive(Debug, Clone)]
pub struct Curve {
    load: Cubics,
    by: Vec<Cubics>,
}

/// A point of the curve as an instrument shows it.
#[derive(Debug, Clone, Copy)]
pub struct Seen {
    /// Depth of the contact itself [length].
    pub depth: f64,
    /// Load [force].
    pub load: f64,
    /// Its derivative by the depth of the instrument [force/length].
    pub slope: f64,
}

/// The foot of a point on the curve.
#[derive(Debug, Clone, Copy)]
pub struct Foot {
    /// Depth of the contact there, without that of the frame [length].
    pub depth: f64,
    /// Slope of the curve as the instrument shows it [force/length].
    pub slope: f64,
    /// One over the noise of a distance in direction of the load.
    pub weight: f64,
}

impl Curve {
    /// Through points of depth and load with the derivatives of the logarithm of the load by those of the numbers. Points without a load
    /// are skipped; `None` where fewer than three are left.
    pub fn through(points: &[[f64; 2]], by: &[Vec<f64>]) -> Option<Self> {
        let pressed = |k: &usize| points[*k][0] > 0.0 && points[*k][1] > 0.0;
        let rows: Vec<usize> = (0..points.len()).filter(pressed).collect();
        if rows.len() < 3 {
            return None;
        }
        let cubics = |of: &dyn Fn(usize) -> f64| {
            Cubics::through(&rows.iter().map(|&k| [points[k][0].ln(), of(k)]).collect::<Vec<_>>())
        };
        Some(Self {
            load: cubics(&|k| points[k][1].ln()),
            by: by.iter().map(|derivative| cubics(&|k| derivative[k])).collect(),
        })
    }

    /// Load and its derivative at a depth of the contact; nothing above the surface.
    pub fn at(&self, depth: f64) -> [f64; 2] {
        if depth <= 0.0 {
            return [0.0; 2];
        }
        let [logarithm, exponent] = self.load.at(depth.ln());
        let load = logarithm.exp();
        [load, load * exponent / depth]
    }

    /// Derivative of the load at a depth of the contact by the logarithm of a number.
    pub fn by(&self, number: usize, depth: f64) -> f64 {
        if depth <= 0.0 { 0.0 } else { self.at(depth)[0] * self.by[number].at(depth.ln())[0] }
    }

    /// What an instrument shows at a depth from the touch on, whose frame has a compliance: the contact is less deep by that times the load.
    pub fn seen(&self, depth: f64, compliance: f64) -> Seen {
        if depth <= 0.0 {
            return Seen { depth, load: 0.0, slope: 0.0 };
        }
        // Newton's steps from the depth itself: the curve is convex, so that they come from one side.
        let mut own = depth;
        for _ in 0..STEPS {
            let [load, slope] = self.at(own);
            let off = depth - own - compliance * load;
            let next = own + off / (1.0 + compliance * slope).max(LEAST_SLOPE);
            let next = next.clamp(0.1 * own, 10.0 * own);
            let moved = (next - own).abs();
            own = next;
            if moved <= 1e-14 * own {
                break;
            }
        }
        let [load, slope] = self.at(own);
        Seen { depth: own, load, slope: slope / (1.0 + compliance * slope).max(LEAST_SLOPE) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Ten depths in equal factors from a sixteenth on.
    fn through(load: impl Fn(f64) -> f64, by: impl Fn(f64) -> f64) -> Curve {
        let depths: Vec<f64> = (0..10).map(|k| 0.0625_f64.powf(1.0 - f64::from(k) / 9.0)).collect();
        let points: Vec<[f64; 2]> = depths.iter().map(|depth| [*depth, load(*depth)]).collect();
        Curve::through(&points, &[depths.iter().map(|depth| by(*depth)).collect()]).unwrap()
    }

    /// Sneddon's powers are met anywhere, to rounding; what bends in the logarithms, as the curve of a film does, to the fourth order: a film
    /// that is four times as stiff as its substrate, whose part in the modulus falls from 1 to 1/16 with the depth, to 1e-5 of the load.
    /// (Parabolas through three of eight depths left 1.6e-4, which two numbers that act nearly alike make to a percent of either.)
    #[test]
    fn powers_of_the_depth_are_met_between_the_points_and_beyond() {
        for exponent in [1.0, 1.5, 2.0] {
            let curve = through(|d| 3.0 * d.powf(exponent), |_| 1.0);
            for depth in [1e-3_f64, 0.1, 0.37, 0.99, 1.2] {
                let [load, slope] = curve.at(depth);
                assert!((load / (3.0 * depth.powf(exponent)) - 1.0).abs() < 1e-12);
                assert!((slope / (3.0 * exponent * depth.powf(exponent - 1.0)) - 1.0).abs() < 1e-12);
                assert!((curve.by(0, depth) / load - 1.0).abs() < 1e-12);
            }
        }
        let bent = |d: f64| d.powf(1.5) * (1.0 + 3.0 / (1.0 + 3.0 * d.sqrt()).powi(2));
        for depth in (25..=400).map(|k| 0.0025 * f64::from(k)) {
            assert!((through(bent, |_| 0.0).at(depth)[0] / bent(depth) - 1.0).abs() < 1e-5);
        }
        let three = Curve::through(&[0.1, 0.3, 1.0].map(|d: f64| [d, d.powi(2)]), &[]).unwrap();
        assert!((three.at(0.5)[0] / 0.25 - 1.0).abs() < 1e-12);
        assert_eq!(through(bent, |_| 0.0).at(-0.1), [0.0; 2]);
    }

    /// A cone behind a spring: `H = d + C k d^2`, a quadratic equation. Its slope by differences of that.
    #[test]
    fn a_frame_that_gives_takes_its_part_of_the_depth() {
        let (stiffness, compliance) = (3.0, 0.4);
        let curve = through(|d| stiffness * d * d, |_| 1.0);
        let own = |depth: f64| {
            let product = compliance * stiffness;
            ((1.0 + 4.0 * product * depth).sqrt() - 1.0) / (2.0 * product)
        };
        let load = |depth: f64| stiffness * own(depth).powi(2);
        for depth in [0.01, 0.3, 1.0, 2.0] {
            let seen = curve.seen(depth, compliance);
            assert!((seen.depth / own(depth) - 1.0).abs() < 1e-12, "{seen:?}");
            assert!((seen.load / load(depth) - 1.0).abs() < 1e-11);
            let slope = (load(depth * 1.0001) - load(depth * 0.9999)) / (0.0002 * depth);
            assert!((seen.slope / slope - 1.0).abs() < 1e-7);
        }
        assert!((curve.seen(0.5, 0.0).load / curve.at(0.5)[0] - 1.0).abs() < 1e-15);
    }
}
