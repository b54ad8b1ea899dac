//! One elastic layer in the wavenumber domain: its hybrid matrices, and the step that carries the compliance of what lies
//! below it to its top. No stacks, no bodies.
//!
//! Displacements times wavenumber `w = (k U, k W)` and tractions on the part below `t = (Q, P)` of a layer of thickness `h`
//! are tied by what is fixed at its top (traction) and at its bottom (displacement):
//!
//! ```text
//! w_top    = F t_top   + E w_bottom      F: compliance of the layer bonded to a rigid base
//! t_bottom = E^T t_top - Z w_bottom      Z: stiffness of the layer at its bottom, its top being free
//! ```
//!
//! The mixed form of the layer stiffness matrix (Kausel & Roesset 1981). Its entries, and the determinants of F and Z, are
//! ratios of sums of positive terms, so nothing cancels and nothing grows, from `k h = 0` to infinity, at any contrast and for
//! `nu = 1/2`; and in the ordering of symmetric matrices errors made below a layer are never amplified on the way up.

use super::complex::Wavenumber;
use super::compliance_below::{Compliance, Descent};
use super::layer_constants::LayerConstants;
use super::matrix::{Matrix, Symmetric};
use crate::fields::Scalar;

/// Beyond this real part of `k h` a layer is a half-space to the last bit: `exp(-2 k h)` underflows.
pub(crate) const OPAQUE: f64 = 375.0;

/// Rounding errors of a sum of thin layers' increments, kept for the next increment.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Carry<T> {
    in_plane: Symmetric<T>,
    tt: T,
}

impl<T: Wavenumber> Carry<T> {
    pub(crate) fn none() -> Self {
        Self { in_plane: Symmetric::zero(), tt: T::zero() }
    }
}

/// The hybrid matrices of one layer at one wavenumber.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LayerMatrices<T: Wavenumber> {
    /// Compliance of the layer on a rigid base.
    pub f: Symmetric<T>,
    /// Displacement at the top per displacement at the bottom.
    pub e: Matrix<T>,
    /// Stiffness of the layer at its bottom, top free.
    pub z: Symmetric<T>,
    /// Determinants of f, e, z.
    pub det_f: T,
    pub det_e: T,
    pub det_z: T,
    /// `E - 1`, made without cancellation; asked for in thin layers only.
    e_m1: Matrix<T>,
    /// `tanh(k h)`
    pub tanh: T,
    /// `1 / cosh(k h)`
    sech: T,
    mu: T::Constant,
    thin: bool,
}

/// `1 + z/d_1 (1 + z/d_2 (1 + ...))`.
fn nested<T: Wavenumber, const N: usize>(z: T, divisors: &[f64; N]) -> T {
    let mut sum = T::one();
    for reciprocal in divisors.iter().rev() {
        sum = T::one() + z * *reciprocal * sum;
    }
    sum
}

const fn reciprocals<const N: usize>(a: f64, b: f64, c: f64, d: f64) -> [f64; N] {
    let mut list = [0.0; N];
    let mut n = 0;
    while n < N {
        let m = (n + 1) as f64;
        list[n] = 1.0 / ((a * m + b) * (c * m + d));
        n += 1;
    }
    list
}

/// `sinh x cosh x - x = (2 x^3/3) [1 + z/20 (1 + z/42 (...))]`, `z = 4 x^2`: divisors `(2n+2)(2n+3)`.
const SC_MINUS_X: [f64; 11] = reciprocals(2.0, 2.0, 2.0, 3.0);
/// `sinh^2 x - x^2 = (x^4/3) [1 + z/30 (1 + z/56 (...))]`, `z = 4 x^2`: divisors `(2n+3)(2n+4)`.
const SS_MINUS_XX: [f64; 11] = reciprocals(2.0, 3.0, 2.0, 4.0);
/// `x cosh x - sinh x = (x^3/3) [1 + y/10 (1 + y/28 (...))]`, `y = x^2`: divisors `2n (2n+3)`.
const XC_MINUS_S: [f64; 9] = reciprocals(2.0, 0.0, 2.0, 3.0);

impl<T: Wavenumber> LayerMatrices<T> {
    /// Matrices of a layer with `x = k h`. Every entry is a ratio whose numerator and denominator are multiplied by
    /// `exp(-2 x)`: nothing exceeds order one.
    pub(crate) fn new(constants: &LayerConstants<T::Constant>, x: T) -> Self {
        let inverse = |constant: T::Constant| T::Constant::of(1.0) / constant;
        let LayerConstants { nu, mu, b, g, c0, b_one_minus_4nu, one_minus_g2 } = *constants;
        let size = x.modulus();
        let t = (-x).exp();
        let (sb, e) = if size < 0.25 {
            let sb = (x * -2.0).exp_m1() * -0.5;
            (sb, T::one() - sb * 2.0)
        } else if size < 1.0 {
            ((x * -2.0).exp_m1() * -0.5, t * t)
        } else {
            let e = t * t;
            ((T::one() - e) * 0.5, e)
        };
        let cb = (T::one() + e) * 0.5;
        let sc = sb * cb;
        let ss = sb * sb;
        // x e before x x e: (x x) e would be infinity times zero for absurd x
        let xe = x * e;
        let xxe = x * xe;
        let (sc_minus_x, ss_minus_xx, xc_minus_s) = if size < 1.0 {
            let y = x * x;
            let z = y * 4.0;
            (
                y * xe * (2.0 / 3.0) * nested(z, &SC_MINUS_X),
                y * xxe * (1.0 / 3.0) * nested(z, &SS_MINUS_XX),
                y * x * t * (1.0 / 3.0) * nested(y, &XC_MINUS_S),
            )
        } else {
            (sc - xe, ss - xxe, x * cb - sb)
        };
        let sc_plus_x = sc + xe;
        let delta_m1 = ss * one_minus_g2 + xxe * (b * b);
        let delta = e + delta_m1;
        let per_delta = T::one() / delta;

        let scale_f = per_delta * (c0 * b);
        let scale_z = per_delta * inverse(c0);
        let scale_e = t * per_delta;
        let e_rz = scale_e * (sb * g + x * cb * b);
        let e_zr = -(scale_e * (x * cb * (b * 2.0 * nu) + xc_minus_s * g));
        let bxs = x * sb * b;
        let thin = size < 0.25;
        let e_m1 = if thin {
            let one_minus_t = (-x).exp_m1();
            let cosh_m1 = one_minus_t * one_minus_t * t * 0.5;
            let bxs = bxs * t;
            Matrix {
                rr: per_delta * (cosh_m1 - bxs - delta_m1),
                rz: e_rz,
                zr: e_zr,
                zz: per_delta * (cosh_m1 + bxs - delta_m1),
            }
        } else {
            Matrix { rr: T::zero(), rz: T::zero(), zr: T::zero(), zz: T::zero() }
        };
        Self {
            f: Symmetric {
                rr: scale_f * (sc_plus_x + sc_minus_x * g),
                zz: scale_f * (sc_minus_x + sc_plus_x * g),
                rz: scale_f * (ss_minus_xx * (g * (g + 1.0)) + xxe * b_one_minus_4nu),
            },
            e: Matrix { rr: scale_e * (cb - bxs), rz: e_rz, zr: e_zr, zz: scale_e * (cb + bxs) },
            z: Symmetric {
                rr: scale_z * sc_plus_x,
                zz: scale_z * sc_minus_x,
                rz: scale_z * (ss * g + xxe * b),
            },
            det_f: scale_f * (c0 * b) * (ss_minus_xx * ((g + 1.0) * (g + 1.0)) + xxe * (g * 4.0)),
            det_e: e * per_delta,
            det_z: scale_z * inverse(c0) * ss_minus_xx,
            e_m1,
            tanh: sb / cb,
            sech: t / cb,
            mu,
            thin,
        }
    }

    /// Compliance at the top of the layer from the one below it: `F + E (C^-1 + Z)^-1 E^T`.
    pub(crate) fn lift(&self, below: &Compliance<T>, carry: &mut Carry<T>) -> Compliance<T> {
        let c = below.in_plane;
        let n_minus_1 = self.z.contracted(c) + self.det_z * below.determinant;
        let per_n = T::one() / (T::one() + n_minus_1);
        let (top, above_f) = if self.thin && n_minus_1.modulus() < 1.0 {
            self.lift_by_increment(below, per_n, &mut carry.in_plane)
        } else {
            carry.in_plane = Symmetric::zero();
            let d = below.determinant;
            let m = Symmetric {
                rr: (c.rr + d * self.z.zz) * per_n,
                zz: (c.zz + d * self.z.rr) * per_n,
                rz: (c.rz - d * self.z.rz) * per_n,
            };
            let g = self.e.congruent(m);
            (self.f.plus(g), g)
        };
        let determinant = self.det_f + self.f.rr * above_f.zz + self.f.zz * above_f.rr
            - self.f.rz * above_f.rz * 2.0
            + below.determinant * per_n * self.det_e * self.det_e;
        Compliance { in_plane: top, determinant, tt: self.lift_across(below.tt, &mut carry.tt) }
    }

    /// Traction at the bottom of the layer per traction at its top, over the given compliance: `(1 + Z C)^-1 E^T`.
    pub(crate) fn descend(&self, below: &Compliance<T>) -> Descent<T> {
        let (c, z, e) = (below.in_plane, self.z, self.e);
        let zc = Matrix {
            rr: z.rr * c.rr + z.rz * c.rz,
            rz: z.rr * c.rz + z.rz * c.zz,
            zr: z.rz * c.rr + z.zz * c.rz,
            zz: z.rz * c.rz + z.zz * c.zz,
        };
        let per_n = T::one() / (T::one() + z.contracted(c) + self.det_z * below.determinant);
        let (one_zz, one_rr) = (T::one() + zc.zz, T::one() + zc.rr);
        Descent {
            in_plane: Matrix {
                rr: (one_zz * e.rr - zc.rz * e.rz) * per_n,
                rz: (one_zz * e.zr - zc.rz * e.zz) * per_n,
                zr: (one_rr * e.rz - zc.zr * e.rr) * per_n,
                zz: (one_rr * e.zz - zc.zr * e.zr) * per_n,
            },
            across: self.sech / (T::one() + below.tt * self.tanh * self.mu),
        }
    }

    /// A thin layer adds its small increment with a compensated sum, so that thousands of them add no rounding errors.
    fn lift_by_increment(
        &self,
        below: &Compliance<T>,
        per_n: T,
        carry: &mut Symmetric<T>,
    ) -> (Symmetric<T>, Symmetric<T>) {
        let c = below.in_plane;
        let y = c.around(self.z).plus(c.times(below.determinant * self.det_z)).times(per_n);
        let increment = self.f.plus(self.e_m1.congruent_m1(c)).minus(self.e.congruent(y)).plus(*carry);
        let (rr, low_rr) = two_sum(c.rr, increment.rr);
        let (zz, low_zz) = two_sum(c.zz, increment.zz);
        let (rz, low_rz) = two_sum(c.rz, increment.rz);
        *carry = Symmetric { rr: low_rr, zz: low_zz, rz: low_rz };
        let top = Symmetric { rr, zz, rz };
        (top, top.minus(self.f))
    }

    /// The same across the plane of the wavevector: `(tt + tanh x / mu) / (1 + mu tt tanh x)`.
    fn lift_across(&self, below: T, carry: &mut T) -> T {
        let (ratio, per_mu) = (below * self.mu, T::Constant::of(1.0) / self.mu);
        let product = ratio * self.tanh;
        let denominator = T::one() + product;
        if self.thin && product.modulus() < 1.0 {
            let increment =
                self.tanh * per_mu * (T::one() - ratio) * (T::one() + ratio) / denominator + *carry;
            let (top, low) = two_sum(below, increment);
            *carry = low;
            top
        } else {
            *carry = T::zero();
            (below + self.tanh * per_mu) / denominator
        }
    }
}

/// `a + b` and its rounding error (Knuth).
fn two_sum<T: Wavenumber>(a: T, b: T) -> (T, T) {
    let sum = a + b;
    let shadow = sum - a;
    (sum, (a - (sum - shadow)) + (b - shadow))
}

#[cfg(test)]
mod tests {
    use super::super::complex::Complex;
    use super::super::samples::material;
    use super::*;

    fn constants(nu: f64) -> LayerConstants {
        LayerConstants::new(&material((2.6, nu)))
    }

    /// `(w, t)` at the top from `(w, t)` at the bottom: the first-order system of plane-strain elasticity, integrated by its
    /// power series.
    fn integrated(c: &LayerConstants, x: f64, bottom: [f64; 4]) -> [f64; 4] {
        let a = c.nu / (1.0 - c.nu);
        // minus the derivative with depth
        let rate = |[wr, wz, tr, tz]: [f64; 4]| {
            [wz + tr / c.mu, -a * wr + c.g / c.mu * tz, 4.0 * c.mu * c.b * wr + a * tz, -tr]
        };
        let mut term = bottom;
        let mut sum = bottom;
        for n in 1..60 {
            term = rate(term).map(|value| value * x / f64::from(n));
            for (total, value) in sum.iter_mut().zip(term) {
                *total += value;
            }
        }
        sum
    }

    #[test]
    fn hybrid_matrices_solve_the_equations_of_elasticity() {
        for nu in [-0.9, 0.0, 0.25, 0.3, 0.5] {
            for x in [0.01, 0.2, 0.7, 1.5, 4.0] {
                let constants = constants(nu);
                let LayerMatrices { f, e, z, .. } = LayerMatrices::new(&constants, x);
                for bottom in
                    [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]]
                {
                    let [top_wr, top_wz, top_tr, top_tz] = integrated(&constants, x, bottom);
                    let [wr, wz, tr, tz] = bottom;
                    let residuals = [
                        f.rr * top_tr + f.rz * top_tz + e.rr * wr + e.rz * wz - top_wr,
                        f.rz * top_tr + f.zz * top_tz + e.zr * wr + e.zz * wz - top_wz,
                        e.rr * top_tr + e.zr * top_tz - z.rr * wr - z.rz * wz - tr,
                        e.rz * top_tr + e.zz * top_tz - z.rz * wr - z.zz * wz - tz,
                    ];
                    let size =
                        [top_wr, top_wz, top_tr, top_tz, 1.0].iter().fold(0.0_f64, |a, b| a.max(b.abs()));
                    // rounding of numbers as large as exp(x)
                    assert!(
                        residuals.iter().all(|r| r.abs() < 1e-14 * size),
                        "nu {nu}, x {x}: {residuals:?}"
                    );
                }
            }
        }
    }

    #[test]
    fn determinants_are_those_of_the_entries() {
        for nu in [-0.9, 0.2, 0.5] {
            for x in [0.6, 1.0, 2.0] {
                let layer = LayerMatrices::new(&constants(nu), x);
                let of = |m: Symmetric<f64>| m.rr * m.zz - m.rz * m.rz;
                let e = layer.e;
                // the entries' own determinants cancel by a factor of up to 300 at x = 0.6
                assert!((of(layer.f) - layer.det_f).abs() < 1e-13 * layer.det_f);
                assert!((of(layer.z) - layer.det_z).abs() < 1e-13 * layer.det_z);
                assert!((e.rr * e.zz - e.rz * e.zr - layer.det_e).abs() < 1e-13 * layer.det_e);
            }
        }
    }

    #[test]
    fn branches_meet() {
        for edge in [0.25, 1.0] {
            let below = LayerMatrices::new(&constants(0.2), edge * (1.0 - 1e-16));
            let above = LayerMatrices::new(&constants(0.2), edge);
            let pairs = [
                (below.f.rr, above.f.rr),
                (below.f.zz, above.f.zz),
                (below.f.rz, above.f.rz),
                (below.z.rr, above.z.rr),
                (below.z.zz, above.z.zz),
                (below.z.rz, above.z.rz),
                (below.e.rr, above.e.rr),
                (below.e.zr, above.e.zr),
                (below.det_f, above.det_f),
                (below.tanh, above.tanh),
            ];
            for (below, above) in pairs {
                assert!((below - above).abs() < 3e-15 * above.abs()); // two bits lost where the direct forms begin
            }
        }
    }

    #[test]
    fn increments_and_steps_agree() {
        // a layer just thin enough for the compensated increment, against two exact halves of a thicker one
        let soft = constants(0.4);
        let below = LayerConstants::new(&material((1.0, 0.3))).half_space::<Complex>();
        let lift = |x: f64, below: &Compliance<Complex>| {
            LayerMatrices::new(&soft, Complex::polar(x, 0.2)).lift(below, &mut Carry::none())
        };
        let by_steps = lift(0.48, &below);
        let by_increments = lift(0.24, &lift(0.24, &below));
        let difference = (by_steps.in_plane.zz - by_increments.in_plane.zz).modulus();
        assert!(difference < 2e-15 * by_steps.in_plane.zz.modulus()); // rounding of either
        assert!(
            (by_steps.determinant - by_increments.determinant).modulus()
                < 1e-14 * by_steps.determinant.modulus()
        );
        assert!((by_steps.tt - by_increments.tt).modulus() < 2e-15 * by_steps.tt.modulus());
    }

    #[test]
    fn a_sum_and_its_rounding_error_are_exact() {
        let small = 2.0_f64.powi(-60);
        for (a, b, sum, low) in [
            (1.0, small, 1.0, small),
            (small, 1.0, 1.0, small),
            (1.0, -small, 1.0, -small),
            (3.0, 0.25, 3.25, 0.0),
            // half of the last digit and a bit more goes up
            (1.0, 1.5 * f64::EPSILON, 1.0 + 2.0 * f64::EPSILON, -0.5 * f64::EPSILON),
        ] {
            assert_eq!(two_sum(a, b), (sum, low), "{a:e} + {b:e}");
        }
    }
}
