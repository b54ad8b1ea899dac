//! Stress intensity of a straight crack from the surface, at any angle, from the stress that acts along it without the crack.
//!
//! Distributed dislocations in a half-plane with a free surface (Hills, Kelly, Dai & Korsunsky 1996, *Solution of Crack Problems*), solved
//! once for an angle: the transposed solution gives the moments of the weight function. In plane strain or plane stress, of one elastic
//! material; the crack is taken to be open along its whole length.

use std::f64::consts::{FRAC_PI_2, PI};

use nalgebra::DMatrix;

use super::tensor::StressTensor;
use crate::kernel::complex::Complex;
use crate::kernel::quadrature::GaussRule;

/// Greatest angle to the normal of the surface [radians]: beyond, the weights lose their digits (4e-4 at 60 degrees, 1e-2 at 75).
pub const STEEPEST: f64 = PI / 3.0;
/// Dislocations of the coarser of two solutions; the finer one has twice as many.
const DISLOCATIONS: usize = 32;
/// Terms of the polynomial of a weight function.
const TERMS: usize = 10;

/// The weight function of an edge crack at an angle, in Bueckner's form `(1 - t)^(-1/2)` times a polynomial, `t` from 0 at the mouth to 1 at
/// the tip, with the moments of the solution by dislocations.
#[derive(Debug, Clone)]
pub struct EdgeCrack {
    angle: f64,
    /// Coefficients of Chebyshev's polynomials of `2t - 1`, `[mode][tension or shear]`.
    coefficients: [[[f64; TERMS]; 2]; 2],
}

/// A point along a crack, and what unit tension and unit shear there add to `K_I` and `K_II`, `[mode][tension or shear]`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WeightedPoint {
    /// Distance from the mouth [length].
    pub distance: f64,
    /// Weights [sqrt(length)].
    pub weights: [[f64; 2]; 2],
}

impl EdgeCrack {
    /// A crack that leaves the normal of the surface by an angle [radians], positive towards +x as it goes deeper; `None` beyond
    /// [`STEEPEST`].
    ///
    /// Within 1e-5 up to 45 degrees, 4e-4 at 60: two solutions, whose error falls with the square of the number of dislocations.
    pub fn new(angle: f64) -> Option<Self> {
        if angle.is_nan() || angle.abs() > STEEPEST * (1.0 + 1e-9) {
            return None;
        }
        // Moments of the weight function with Chebyshev's polynomials.
        let mut moments = DMatrix::<f64>::zeros(TERMS, 4);
        for (count, part) in [(2 * DISLOCATIONS, 4.0 / 3.0), (DISLOCATIONS, -1.0 / 3.0)] {
            for (place, weights) in solution(angle, count)? {
                for (row, value) in chebyshev(place).into_iter().enumerate() {
                    for (column, weight) in weights.as_flattened().iter().enumerate() {
                        moments[(row, column)] += part * weight * value;
                    }
                }
            }
        }
        // The polynomial with these moments under the weight (1 - t)^(-1/2), t = 1 - s^2.
        let mut gram = DMatrix::<f64>::zeros(TERMS, TERMS);
        for (node, weight) in GaussRule::new(2 * TERMS).points {
            let s = 0.5 * (1.0 + node);
            let values = chebyshev(1.0 - s * s);
            for (row, one) in values.iter().enumerate() {
                for (column, other) in values.iter().enumerate() {
                    gram[(row, column)] += weight * one * other; // 2 ds = dnode
                }
            }
        }
        let found = gram.lu().solve(&moments)?;
        let of = |column: usize| std::array::from_fn(|row| found[(row, column)]);
        Some(Self { angle, coefficients: [[of(0), of(1)], [of(2), of(3)]] })
    }

    /// Direction of the crack `(x, z)`, z into the body.
    pub fn direction(&self) -> [f64; 2] {
        [self.angle.sin(), self.angle.cos()]
    }

    /// Tension across the crack and shear along it of a stress [pressure], in the plane of the normal of the surface and a horizontal
    /// direction `(x, y)`, a unit vector, in place of x.
    pub fn tractions(&self, stress: &StressTensor, horizontal: [f64; 2]) -> [f64; 2] {
        let [s, c] = self.direction();
        let normal = [-c * horizontal[0], -c * horizontal[1], s];
        let along = [s * horizontal[0], s * horizontal[1], c];
        let traction = stress.on_plane(normal);
        let dot = |axis: [f64; 3]| traction.iter().zip(axis).map(|(t, a)| t * a).sum();
        [dot(normal), dot(along)]
    }

    /// Points along a crack of a length at which the stress is wanted, and their weights: `K = sum of weights times tractions`. Exact to
    /// rounding for a stress that is linear between `breaks`, distances from the mouth, not falling.
    pub fn points(&self, length: f64, breaks: &[f64]) -> Vec<WeightedPoint> {
        // In s = sqrt(1 - t) the weight function is a polynomial, the stress one of second degree.
        let inside = breaks.iter().filter(|place| **place > 0.0 && **place < length);
        let from_tip = inside.map(|place| (1.0 - place / length).sqrt());
        let mut ends: Vec<f64> = std::iter::once(1.0).chain(from_tip).chain(std::iter::once(0.0)).collect();
        ends.dedup();
        let rule = GaussRule::new(TERMS + 1).points;
        let scale = (PI * length).sqrt();
        let mut points = Vec::with_capacity(rule.len() * ends.len());
        for pair in ends.windows(2) {
            let half = 0.5 * (pair[0] - pair[1]);
            for (node, weight) in &rule {
                let s = f64::midpoint(pair[0], pair[1]) - half * node;
                let place = 1.0 - s * s;
                let values = chebyshev(place);
                let factor = 2.0 * half * weight * scale;
                let sum =
                    |terms: [f64; TERMS]| factor * terms.iter().zip(values).map(|(c, v)| c * v).sum::<f64>();
                let weights = self.coefficients.map(|mode| mode.map(sum));
                points.push(WeightedPoint { distance: place * length, weights });
            }
        }
        points
    }
}

/// `K_I` and `K_II` [pressure x sqrt(length)] from tension and shear at the points of a crack.
pub fn stress_intensity(points: &[WeightedPoint], tractions: impl Iterator<Item = [f64; 2]>) -> [f64; 2] {
    let mut sums = [0.0; 2];
    for (point, traction) in points.iter().zip(tractions) {
        for (sum, weights) in sums.iter_mut().zip(point.weights) {
            *sum += weights[0] * traction[0] + weights[1] * traction[1];
        }
    }
    sums
}

/// Chebyshev's polynomials of `2t - 1`.
fn chebyshev(t: f64) -> [f64; TERMS] {
    let x = 2.0 * t - 1.0;
    let mut values = [1.0; TERMS];
    values[1] = x;
    for n in 2..TERMS {
        values[n] = 2.0 * x * values[n - 1] - values[n - 2];
    }
    values
}

/// Each point of collocation and its weights, with so many dislocations on a crack of length 1; always there at the angles taken.
fn solution(angle: f64, count: usize) -> Option<Vec<(f64, [[f64; 2]; 2])>> {
    let n = count as f64;
    let nodes: Vec<f64> = (1..=count).map(|k| ((2 * k - 1) as f64 * PI / (2.0 * n + 1.0)).cos()).collect();
    let places: Vec<f64> =
        (1..=count).map(|k| 0.5 * (1.0 + (2.0 * k as f64 * PI / (2.0 * n + 1.0)).cos())).collect();
    let turn = Complex::new((FRAC_PI_2 - angle).cos(), (FRAC_PI_2 - angle).sin());
    // Rows: tension, then shear at the places; columns: opening, then sliding dislocations.
    let mut matrix = DMatrix::<f64>::zeros(2 * count, 2 * count);
    for (j, node) in nodes.iter().enumerate() {
        let at = turn * (0.5 * (1.0 + node));
        let weight = PI * (1.0 + node) / (2.0 * n + 1.0);
        for (i, place) in places.iter().enumerate() {
            let here = turn * *place;
            let nearness = 2.0 / (place - 0.5 * (1.0 + node));
            for (kind, burgers) in [Complex::new(1.0, 0.0), Complex::new(0.0, 1.0)].into_iter().enumerate() {
                let image = image_traction(here, at, (burgers * turn.conj()).conj(), turn);
                let direct = burgers * nearness;
                matrix[(i, kind * count + j)] = weight * (direct.re + image.re);
                matrix[(count + i, kind * count + j)] = weight * (direct.im + image.im);
            }
        }
    }
    // The density at the tip (Krenk 1975), of each kind.
    let mut tip = DMatrix::<f64>::zeros(2 * count, 2);
    for k in 1..=count {
        let odd = (2 * k - 1) as f64 / (2.0 * n + 1.0) * PI;
        let value = 2.0 / (2.0 * n + 1.0) * (odd * n).sin() / (0.5 * odd).tan();
        tip[(k - 1, 0)] = value;
        tip[(count + k - 1, 1)] = value;
    }
    let rows = matrix.transpose().lu().solve(&tip)?;
    let scale = -PI * 8.0_f64.sqrt();
    let weights = |i: usize| [0, 1].map(|mode| [scale * rows[(i, mode)], scale * rows[(count + i, mode)]]);
    Some(places.into_iter().enumerate().map(|(i, place)| (place, weights(i))).collect())
}

/// Traction `tension + i shear` across a line along `turn` at `z`, from the image that frees the surface of a dislocation at `at`;
/// potentials of Muskhelishvili, the dislocation alone `a/(z - at)`.
fn image_traction(z: Complex, at: Complex, a: Complex, turn: Complex) -> Complex {
    let far = Complex::new(1.0, 0.0) / (z - at.conj());
    let height = at - at.conj();
    let phi = -(a * far + a.conj() * height * far * far);
    let slope = a * far * far + a.conj() * height * far * far * far * 2.0;
    let psi = -phi - z * slope - a.conj() * far;
    Complex::new(2.0 * phi.re, 0.0) + turn * turn * (z.conj() * slope + psi)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `K / sqrt(pi l)` under a stress over the depth, at an angle.
    fn factors(degrees: f64, stress: impl Fn(f64) -> StressTensor) -> [f64; 2] {
        let crack = EdgeCrack::new(degrees.to_radians()).unwrap();
        let down = crack.direction()[1];
        let points = crack.points(1.0 / PI, &[]);
        let at = |point: &WeightedPoint| crack.tractions(&stress(PI * point.distance * down), [1.0, 0.0]);
        stress_intensity(&points, points.iter().map(at))
    }

    fn tension(value: f64) -> StressTensor {
        StressTensor([value, 0.0, 0.0, 0.0, 0.0, 0.0])
    }

    /// Koiter (1956): 1.12152226 in uniform tension; Tada, Paris & Irwin, *The Stress Analysis of Cracks Handbook*: 0.683 for a stress that
    /// rises linearly from the mouth. Digits beyond the book: `tests/golden/edge_crack.py`, by another quadrature.
    #[test]
    fn a_crack_at_right_angles_has_the_factors_of_the_handbook() {
        let [open, slides] = factors(0.0, |_| tension(1.0));
        assert!((open - 1.121_522_26).abs() < 5e-6 && slides.abs() < 1e-12, "{open} {slides}");
        let [open, _] = factors(0.0, tension);
        assert!((open - 0.682_862_88).abs() < 1e-6, "{open}");
        let [open, slides] = factors(0.0, |_| StressTensor([0.0, 0.0, 0.0, 0.0, 1.0, 0.0]));
        assert!(open.abs() < 1e-12 && (slides.abs() - 1.121_522_26).abs() < 5e-6);
    }

    /// Uniform tension across an inclined edge crack: 0.705 and 0.364 at 45 degrees (Murakami, *Stress Intensity Factors Handbook*);
    /// digits by `tests/golden/edge_crack.py`.
    #[test]
    fn inclined_cracks_have_the_factors_of_the_handbook() {
        for (degrees, opens, slides, tolerance) in [
            (30.0, 0.920_10, 0.305_80, 2e-5),
            (45.0, 0.704_91, 0.364_49, 2e-5),
            (60.0, 0.462_4, 0.336_1, 5e-4),
        ] {
            for sign in [1.0, -1.0] {
                let found = factors(sign * degrees, |_| tension(1.0));
                assert!((found[0] - opens).abs() < tolerance, "{degrees}: {found:?}");
                assert!((found[1].abs() - slides).abs() < tolerance, "{degrees}: {found:?}");
            }
        }
        assert!(EdgeCrack::new(1.2).is_none() && EdgeCrack::new(f64::NAN).is_none());
    }
}
