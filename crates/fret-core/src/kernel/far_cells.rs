//! Means over square cells far from their load: five values of a filtered function instead of dozens of Gauss points.
//!
//! The mean of a field over a square of side 1 multiplies its wave `k` by `sinc(k_x/2) sinc(k_y/2)`; five points, the centre and
//! four on the diagonals, by `1 - v + v cos(k_x d) cos(k_y d)`. `v` and `d` are such that the two differ by a function of `|k|`
//! alone up to the sixth power. That function, the filter, commutes with everything radial and costs nothing: it multiplies
//! the response. What is left falls like the eighth power of side over distance.

use super::complex::Wavenumber;

/// Distance, depth included, in sides of a cell beyond which the rule is used: what is left is 1e-3 of its eighth power, rounding.
pub(super) const FAR: f64 = 24.0;

/// `v`, the weight of the four points together.
const WEIGHT: f64 = 0.899_761_459_741_544_3;
/// `d`, over the side.
const DIAGONAL: f64 = 0.260_864_716_935_209_5;

/// Offset from the centre in sides, and weight, of each point.
pub(super) const FIVE_POINTS: [([f64; 2], f64); 5] = [
    ([0.0, 0.0], 1.0 - WEIGHT),
    ([-DIAGONAL, -DIAGONAL], 0.25 * WEIGHT),
    ([-DIAGONAL, DIAGONAL], 0.25 * WEIGHT),
    ([DIAGONAL, -DIAGONAL], 0.25 * WEIGHT),
    ([DIAGONAL, DIAGONAL], 0.25 * WEIGHT),
];

/// Least distance of a point from the load when its cell is the loaded one and not its centre, in sides; a little less.
pub(super) const LEAST: f64 = 0.36;

/// Coefficients of the filter in powers of `(k side)^2`: the exponential of the mean over all directions of
/// `log(sinc sinc) - log(five points)`, as a power series.
pub(super) const FILTER: [f64; 7] = [
    1.0,
    -0.011_052_102_802_974_133,
    8.866_915_132_475_21e-6,
    -5.161_636_370_427_963e-7,
    -8.749_462_117_557_459e-9,
    -1.731_389_470_211_943_6e-10,
    -3.524_381_961_632_105_3e-12,
];

/// The filter at `k side`.
pub(super) fn filter<T: Wavenumber>(k_side: T) -> T {
    let square = k_side * k_side;
    let mut sum = T::real(FILTER[6]);
    for coefficient in FILTER[..6].iter().rev() {
        sum = sum * square + T::real(*coefficient);
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn five_filtered_points_average_waves_over_a_cell_up_to_the_eighth_power() {
        let sinc = |x: f64| if x == 0.0 { 1.0 } else { (0.5 * x).sin() / (0.5 * x) };
        for direction in 0..24 {
            let (s, c) = (f64::from(direction) * 0.3).sin_cos();
            for k in [0.05_f64, 0.3, 1.0, 1.5] {
                let mean = sinc(k * c) * sinc(k * s);
                let points: f64 =
                    FIVE_POINTS.iter().map(|([x, y], weight)| weight * (k * (c * x + s * y)).cos()).sum();
                let error = (mean - points * filter(k)).abs();
                // the first difference that depends on direction: 2.9e-9 and 2.1e-10 of the eighth power
                assert!(error < 4e-9 * k.powi(8) + 4e-16, "{direction} {k}: {error:e}");
            }
        }
    }
}
