//! Bessel functions of order 0 to 3: J of a real argument, Hankel functions H = J + iY on a ray of the upper half-plane.

use super::complex::{Complex, Wavenumber};
use std::f64::consts::{FRAC_1_PI, FRAC_PI_2};

/// Euler's constant.
const EULER_GAMMA: f64 = 0.577_215_664_901_532_9;

/// `[J_0, J_1, J_2, J_3](x)`, `x >= 0`.
pub(crate) fn bessel_j(x: f64) -> [f64; 4] {
    if x < 1.0 {
        // their own series: the recurrence would cancel
        let q = -0.25 * x * x;
        let j = |order: usize| power_series(order, Complex::new(q, 0.0)).re;
        let half = 0.5 * x;
        [j(0), half * j(1), half * half * j(2), half * half * half * j(3)]
    } else {
        [libm::j0(x), libm::j1(x), libm::jn(2, x), libm::jn(3, x)]
    }
}

/// `sum_k q^k / (k! (k + order)!)`, `|q| <= 1/4`.
fn power_series(order: usize, q: Complex) -> Complex {
    let mut term = Complex::real([1.0, 1.0, 0.5, 1.0 / 6.0][order]);
    let mut sum = term;
    for k in 1..=SERIES_TERMS {
        term = term * q * (1.0 / (k as f64 * (k + order) as f64));
        sum = sum + term;
    }
    sum
}

/// `4^-10 / (10!)^2 = 7e-20`.
const SERIES_TERMS: usize = 10;

/// Hankel functions of the first kind `[H_0, H_1, H_2, H_3](z)` at `z = modulus exp(i angle)`, `0 < angle < pi/2`, without
/// overflow; they decay like `exp(-modulus sin(angle))`. Relative error about 2e-14.
pub(crate) fn hankel(modulus: f64, angle: f64) -> [Complex; 4] {
    if modulus < 1.0 { hankel_series(modulus, angle) } else { hankel_integral(modulus, angle) }
}

/// Power series (Abramowitz & Stegun 9.1.10, 9.1.11), `|z| <= 1`.
fn hankel_series(modulus: f64, angle: f64) -> [Complex; 4] {
    let z = Complex::polar(modulus, angle);
    let half = z * 0.5;
    let q = -(half * half);
    let log_half = Complex::new(libm::log(0.5 * modulus), angle);
    let (mut power, mut factorial) = (Complex::one(), 1.0);
    let mut result = [Complex::zero(); 4];
    for (order, value) in result.iter_mut().enumerate() {
        if order > 0 {
            power = power * half;
            factorial *= order as f64;
        }
        let j = power * power_series(order, q);
        // sum_k [psi(k+1) + psi(k+n+1)] q^k / (k! (n+k)!)
        let digamma = |n: usize| (1..n).map(|i| 1.0 / i as f64).sum::<f64>() - EULER_GAMMA;
        let mut term = Complex::real(1.0 / factorial);
        let mut sum = term * (digamma(1) + digamma(order + 1));
        for k in 1..=SERIES_TERMS {
            term = term * q * (1.0 / (k as f64 * (k + order) as f64));
            sum = sum + term * (digamma(k + 1) + digamma(k + order + 1));
        }
        // -(1/pi) sum_{k<n} (n-k-1)!/k! (z/2)^(2k-n)
        let poles = match order {
            0 => Complex::zero(),
            1 => Complex::one() / half,
            2 => Complex::one() / (half * half) + Complex::one(),
            _ => Complex::real(2.0) / (half * half * half) + Complex::one() / half + half * 0.5,
        };
        let y = (log_half * j * 2.0 - power * sum - poles) * FRAC_1_PI;
        *value = j + Complex::new(-y.im, y.re);
    }
    result
}

/// `K_n(w) = Int_0^inf exp(-w cosh t) cosh(n t) dt`, `w = -i z`, along `t = tau + i beta tanh(tau)`, on which the exponent
/// becomes real far out; trapezoidal rule. Then `H_0 = 2/(pi i) K_0`, `H_1 = -(2/pi) K_1` and the others by recurrence.
fn hankel_integral(modulus: f64, angle: f64) -> [Complex; 4] {
    let z = Complex::polar(modulus, angle);
    let w = Complex::new(z.im, -z.re);
    let beta = FRAC_PI_2 - angle;
    let step = f64::min(0.08, 0.4 / modulus.sqrt());
    let last = libm::acosh(1.0 + 40.0 / modulus) + 0.3;
    let mut sums = [Complex::zero(); 2];
    for n in 0..=(last / step).ceil() as u32 {
        let tau = f64::from(n) * step;
        let tanh = libm::tanh(tau);
        let t = Complex::new(tau, beta * tanh);
        let slope = Complex::new(1.0, beta * (1.0 - tanh) * (1.0 + tanh));
        let (sinh_half, _) = (t * 0.5).sinh_cosh();
        let (_, cosh) = t.sinh_cosh();
        let weight = if n == 0 { 0.5 * step } else { step };
        let term = (-(w * sinh_half * sinh_half * 2.0)).exp() * slope * weight;
        sums = [sums[0] + term, sums[1] + term * cosh];
    }
    let decay = (-w).exp() * (2.0 * FRAC_1_PI);
    let [k0, k1] = sums.map(|sum| sum * decay);
    let h0 = Complex::new(k0.im, -k0.re);
    let h1 = -k1;
    let h2 = h1 * 2.0 / z - h0;
    [h0, h1, h2, h2 * 4.0 / z - h1]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hankel_functions_of_real_argument_limit_are_bessel_functions() {
        // on a ray of vanishing angle H_n(x) = J_n(x) + i Y_n(x); the angle costs x * 1e-15
        for x in [0.01, 0.3, 0.9, 0.999_999] {
            let h = hankel(x, 1e-15);
            let j = bessel_j(x);
            let y = [libm::y0(x), libm::y1(x), libm::yn(2, x), libm::yn(3, x)];
            for n in 0..4 {
                let exact = Complex::new(j[n], y[n]);
                let error = (h[n] - exact).modulus() / exact.modulus();
                assert!(error < 1e-14, "H_{n}({x}): {error:.1e}"); // a few roundings of series and library
            }
        }
    }

    #[test]
    fn series_and_integral_agree_where_both_hold() {
        for angle in [8.0_f64, 15.0, 25.0] {
            for modulus in [0.7, 1.0, 1.3] {
                let series = hankel_series(modulus, angle.to_radians());
                let integral = hankel_integral(modulus, angle.to_radians());
                for n in 0..4 {
                    let error = (series[n] - integral[n]).modulus() / series[n].modulus();
                    assert!(error < 2e-14, "H_{n}, {modulus} at {angle} degrees: {error:.1e}"); // error of the integral
                }
            }
        }
    }

    #[test]
    fn wronskian_holds_along_the_ray() {
        // J_1 H_0 - J_0 H_1 = 2 i/(pi z), with J from its power series, which still converges well for |z| <= 6
        let angle = 15.0_f64.to_radians();
        for modulus in [0.05, 0.5, 1.0, 2.0, 4.0, 6.0] {
            let z = Complex::polar(modulus, angle);
            let q = -(z * z * 0.25);
            let j = |order: usize| {
                let mut term = if order == 1 { z * 0.5 } else { Complex::one() };
                let mut sum = term;
                for k in 1..40 {
                    term = term * q * (1.0 / (k as f64 * (k + order) as f64));
                    sum = sum + term;
                }
                sum
            };
            let [h0, h1, ..] = hankel(modulus, angle);
            let wronskian = j(1) * h0 - j(0) * h1;
            let exact = Complex::new(0.0, 2.0 * FRAC_1_PI) / z;
            let error = (wronskian - exact).modulus() / exact.modulus();
            assert!(error < 2e-13, "{modulus}: {error:.1e}"); // J loses exp(Re z)-fold cancellation: a factor ten
        }
    }

    #[test]
    fn far_out_the_asymptotic_expansion_holds() {
        // H_n ~ sqrt(2/(pi z)) exp(i (z - n pi/2 - pi/4)) sum_k i^k a_k(n)/z^k (Hankel)
        let angle = 15.0_f64.to_radians();
        for modulus in [25.0, 60.0, 170.0] {
            let z = Complex::polar(modulus, angle);
            let found = hankel(modulus, angle);
            for (n, value) in found.iter().enumerate() {
                let mut term = Complex::one();
                let mut sum = term;
                for k in 1..30 {
                    let k = f64::from(k);
                    let factor = (4.0 * (n * n) as f64 - (2.0 * k - 1.0) * (2.0 * k - 1.0)) / (8.0 * k);
                    term = term * Complex::new(0.0, factor) / z;
                    sum = sum + term;
                }
                let phase = z.re - (n as f64 + 0.5) * FRAC_PI_2;
                let front = Complex::polar(
                    (2.0 * FRAC_1_PI / modulus).sqrt() * libm::exp(-z.im),
                    phase - 0.5 * angle,
                );
                let error = (*value - front * sum).modulus() / (front * sum).modulus();
                assert!(error < 1e-13, "H_{n}, {modulus}: {error:.1e}"); // rounding of the phase, modulus * 1e-16, and 2e-14
            }
        }
    }

    #[test]
    fn bessel_series_meets_the_library() {
        let below = bessel_j(1.0 - 1e-13);
        let above = bessel_j(1.0);
        for n in 0..4 {
            assert!((below[n] - above[n]).abs() < 3e-13); // slope times 1e-13, and two roundings
        }
    }

    #[test]
    fn bessel_functions_are_their_exact_series() {
        // 60 terms in exact fractions, rounded once
        for (x, exact) in [
            (
                0.5,
                [
                    0.938_469_807_240_812_9,
                    0.242_268_457_674_873_9,
                    0.030_604_023_458_682_64,
                    0.002_563_729_994_587_244,
                ],
            ),
            (
                0.75,
                [
                    0.864_242_275_166_648_6,
                    0.349_243_602_174_862_17,
                    0.067_073_997_299_650_55,
                    0.008_484_383_423_274_108,
                ],
            ),
            (
                3.0,
                [
                    -0.260_051_954_901_933_45,
                    0.339_058_958_525_936_5,
                    0.486_091_260_585_891_1,
                    0.309_062_722_255_251_67,
                ],
            ),
            (
                10.0,
                [
                    -0.245_935_764_451_348_35,
                    0.043_472_746_168_861_44,
                    0.254_630_313_685_120_6,
                    0.058_379_379_305_186_815,
                ],
            ),
        ] {
            for (n, (found, exact)) in bessel_j(x).into_iter().zip(exact).enumerate() {
                assert!((found - exact).abs() < 4e-16, "J_{n}({x}): {found} {exact}"); // roundings of numbers below 1
            }
        }
    }
}
