//! Functions of one positive number in quartets, tabulated side by side as polynomials on quarter octaves: one look-up for all,
//! vectors of four per evaluation and no transcendental function. Radial kernels (of `r^2`) and responses (of `k^2`) are both kept so.

use pulp::Simd;
use rayon::prelude::*;

/// Four functions side by side.
pub(crate) type Lanes = [f64; 4];

/// Chebyshev nodes, and coefficients, of one panel. The tabulated functions are analytic but for the imaginary axis of `r`
/// (of `k`: beyond the poles, 22 degrees off the axis and more); their singularities lie 6 half-panels away in the square and
/// more, usually 9: twelve terms leave 1e-13 to 1e-15.
const DEGREES: usize = 12;
/// Bits of a number's pattern below exponent and the two leading bits of its fraction: what stays within a panel.
const WITHIN_PANEL: u32 = 50;

/// `a b + c`, fused where the machine can.
#[inline(always)]
pub(super) fn fused<S: Simd>(a: f64, b: f64, c: f64) -> f64 {
    if S::IS_SCALAR { a * b + c } else { a.mul_add(b, c) }
}

/// Piecewise polynomials in `s > 0` of `N` quartets, on panels `[2^e (1 + q/4), 2^e (1 + (q+1)/4))`.
#[derive(Clone, Debug)]
pub(crate) struct Panels<const N: usize> {
    first: u64,
    polynomials: Vec<[[Lanes; N]; DEGREES]>,
}

impl<const N: usize> Panels<N> {
    /// Tabulates functions on all panels that meet `[least, greatest]`.
    pub(crate) fn new(least: f64, greatest: f64, functions: impl Fn(f64) -> [Lanes; N] + Sync) -> Self {
        let first = panel_of(least);
        let count = (panel_of(greatest) - first + 1) as usize;
        let cosines = chebyshev_cosines();
        let powers = chebyshev_powers();
        let polynomials = (0..count)
            .into_par_iter()
            .with_min_len(16)
            .map(|index| {
                let panel = first + index as u64;
                let start = f64::from_bits(panel << WITHIN_PANEL);
                let end = f64::from_bits((panel + 1) << WITHIN_PANEL);
                let half = 0.5 * (end - start);
                let middle = start + half;
                let values = std::array::from_fn(|node| functions(middle + half * cosines[1][node]));
                polynomial(&values, &cosines, &powers)
            })
            .collect();
        Self { first, polynomials }
    }

    /// Values at `s`, which must lie within the tabulated range.
    #[inline(always)]
    pub(crate) fn at<S: Simd>(&self, s: f64) -> [Lanes; N] {
        let bits = s.to_bits();
        let polynomial = &self.polynomials[(bits >> WITHIN_PANEL).wrapping_sub(self.first) as usize];
        let fraction = (bits << 2) & ((1 << 52) - 1);
        let u = 2.0 * f64::from_bits(fraction | 1.0_f64.to_bits()) - 3.0;
        // even and odd powers apart: two short chains of operations instead of a long one
        let square = u * u;
        let mut even = polynomial[DEGREES - 2];
        let mut odd = polynomial[DEGREES - 1];
        let mut degree = DEGREES - 2;
        while degree > 0 {
            degree -= 2;
            for quartet in 0..N {
                for lane in 0..4 {
                    even[quartet][lane] =
                        fused::<S>(even[quartet][lane], square, polynomial[degree][quartet][lane]);
                    odd[quartet][lane] =
                        fused::<S>(odd[quartet][lane], square, polynomial[degree + 1][quartet][lane]);
                }
            }
        }
        for quartet in 0..N {
            for lane in 0..4 {
                even[quartet][lane] = fused::<S>(odd[quartet][lane], u, even[quartet][lane]);
            }
        }
        even
    }

    /// Whether `s` lies on a tabulated panel.
    pub(crate) fn holds(&self, s: f64) -> bool {
        s > 0.0
            && s.is_finite()
            && panel_of(s)
                .checked_sub(self.first)
                .is_some_and(|index| (index as usize) < self.polynomials.len())
    }
}

fn panel_of(s: f64) -> u64 {
    s.to_bits() >> WITHIN_PANEL
}

/// `cos(degree * angle of node)`.
fn chebyshev_cosines() -> [[f64; DEGREES]; DEGREES] {
    let mut cosines = [[0.0; DEGREES]; DEGREES];
    for (degree, row) in cosines.iter_mut().enumerate() {
        for (node, cosine) in row.iter_mut().enumerate() {
            let quarter_turns = (degree * (2 * node + 1)) as f64 / (2 * DEGREES) as f64;
            *cosine = libm::cos(std::f64::consts::PI * quarter_turns);
        }
    }
    cosines
}

/// Coefficients of the powers of u in the Chebyshev polynomials: whole numbers, exact.
fn chebyshev_powers() -> [[f64; DEGREES]; DEGREES] {
    let mut powers = [[0.0; DEGREES]; DEGREES];
    powers[0][0] = 1.0;
    powers[1][1] = 1.0;
    for degree in 2..DEGREES {
        for power in 0..DEGREES {
            let shifted = if power > 0 { 2.0 * powers[degree - 1][power - 1] } else { 0.0 };
            powers[degree][power] = shifted - powers[degree - 2][power];
        }
    }
    powers
}

/// Powers of u from values at the Chebyshev nodes: first to Chebyshev coefficients, then to powers; one inverse Vandermonde
/// matrix would cost two digits. Only the variation over the panel is transformed, so that only it is rounded.
fn polynomial<const N: usize>(
    values: &[[Lanes; N]; DEGREES],
    cosines: &[[f64; DEGREES]; DEGREES],
    powers: &[[f64; DEGREES]; DEGREES],
) -> [[Lanes; N]; DEGREES] {
    let level = values[DEGREES / 2];
    let mut chebyshev = [[[0.0; 4]; N]; DEGREES];
    for (degree, sum) in chebyshev.iter_mut().enumerate() {
        for node in 0..DEGREES {
            for quartet in 0..N {
                for lane in 0..4 {
                    let change = values[node][quartet][lane] - level[quartet][lane];
                    sum[quartet][lane] += change * cosines[degree][node];
                }
            }
        }
        let share = if degree == 0 { 1.0 } else { 2.0 } / DEGREES as f64;
        sum.as_flattened_mut().iter_mut().for_each(|value| *value *= share);
    }
    let mut coefficients = [[[0.0; 4]; N]; DEGREES];
    for (power, sum) in coefficients.iter_mut().enumerate() {
        // smallest first; a polynomial has the powers of its degree's parity only
        for degree in (power..DEGREES).rev().filter(|degree| (degree - power) % 2 == 0) {
            for quartet in 0..N {
                for lane in 0..4 {
                    sum[quartet][lane] += chebyshev[degree][quartet][lane] * powers[degree][power];
                }
            }
        }
    }
    for quartet in 0..N {
        for lane in 0..4 {
            coefficients[0][quartet][lane] += level[quartet][lane];
        }
    }
    coefficients
}

#[cfg(test)]
mod tests {
    use super::*;
    use pulp::Scalar;

    #[test]
    fn powers_of_the_argument_come_back_to_rounding() {
        let functions = |s: f64| [1.0 / s, 1.0 / s.sqrt(), s.sqrt(), libm::exp(-s.sqrt())];
        let panels = Panels::new(0.3, 40.0, |s| [functions(s)]);
        for n in 0..2000 {
            let s = 0.3 * (40.0_f64 / 0.3).powf(f64::from(n) / 1999.9);
            let [found] = panels.at::<Scalar>(s);
            let exact = functions(s);
            for lane in 0..4 {
                let error = (found[lane] - exact[lane]).abs() / exact[lane];
                // rounding of twelve terms; the last one's expansion feels s = 0, where it is 500 times larger
                let tolerance = if lane == 3 { 2e-14 } else { 4e-15 };
                assert!(error < tolerance, "{s} lane {lane}: {error:.1e}");
            }
        }
    }

    #[test]
    fn range_is_known() {
        let panels = Panels::new(1.0, 4.0, |s| [[s; 4]]);
        assert!(panels.holds(1.0) && panels.holds(4.0));
        // panels are quarters of an octave: 4 lies in the last one, which ends before 5
        assert!(panels.holds(4.999) && !panels.holds(5.0));
        assert!(!panels.holds(0.9) && !panels.holds(6.0) && !panels.holds(0.0) && !panels.holds(f64::NAN));
    }
}
