//! Quartets of radial functions tabulated side by side, as [`Panels`](super::panels) are, one look-up for all.

use pulp::Simd;
use rayon::prelude::*;

use super::panels::{DEGREES, WITHIN_PANEL, chebyshev_cosines, chebyshev_powers, panel_of};

/// Four functions side by side.
pub(crate) type Lanes = [f64; 4];

/// `a b + c`, fused where the machine can.
#[inline(always)]
pub(super) fn fused<S: Simd>(a: f64, b: f64, c: f64) -> f64 {
    if S::IS_SCALAR { a * b + c } else { a.mul_add(b, c) }
}

/// Piecewise polynomials in `s > 0` of `N` quartets.
#[derive(Clone, Debug)]
pub(crate) struct DepthPanels<const N: usize> {
    first: u64,
    polynomials: Vec<[[Lanes; N]; DEGREES]>,
}

impl<const N: usize> DepthPanels<N> {
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
}

/// Powers of u from values at the Chebyshev nodes, as for [`Panels`](super::panels): only the variation over the panel is
/// transformed, first to Chebyshev coefficients, then to powers.
fn polynomial<const N: usize>(
    values: &[[Lanes; N]; DEGREES],
    cosines: &[[f64; DEGREES]; DEGREES],
    powers: &[[f64; DEGREES]; DEGREES],
) -> [[Lanes; N]; DEGREES] {
    let level = values[DEGREES / 2];
    let mut chebyshev = [[[0.0; 4]; N]; DEGREES];
    for (degree, sum) in chebyshev.iter_mut().enumerate() {
        let share = if degree == 0 { 1.0 } else { 2.0 } / DEGREES as f64;
        for node in 0..DEGREES {
            let factor = share * cosines[degree][node];
            for quartet in 0..N {
                for lane in 0..4 {
                    sum[quartet][lane] += (values[node][quartet][lane] - level[quartet][lane]) * factor;
                }
            }
        }
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
