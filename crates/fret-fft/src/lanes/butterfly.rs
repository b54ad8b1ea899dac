//! Transforms of 2, 3, 4 or 5 points with weights on their inputs, on whole vectors of lines.
//!
//! A butterfly of radix `R` computes `y_m = sum_s exp(-2 pi i m s / R) d_s x_s` with `|d_s| = 1`, `d_0 = 1`. For radix 2
//! and 4 the weights are stored as tangents and cosines, so that a weight costs only fused multiply-adds: of
//! `d x = cos (x_re + tan x_im) + i cos (x_im - tan x_re)` the cosines are taken along in the additions that follow.
//! A tangent may be as large as 1e16; its cosine is then as small, and nothing is lost.
//!
//! The inverse transform is the forward one with real and imaginary parts exchanged before and after, which costs nothing:
//! see [`Complex::swapped`].

use super::memory::Line;
use super::simd::{Lanes, Number};

/// The weights of one butterfly, laid out as its radix wants them; see [`weights`].
pub type Weights<N> = [N; 8];

/// Complex numbers of all lanes.
#[derive(Debug, Clone, Copy)]
pub struct Complex<L: Lanes> {
    pub re: L::Reals,
    pub im: L::Reals,
}

impl<L: Lanes> Complex<L> {
    #[inline(always)]
    pub fn load(line: &Line<L>) -> Self {
        Self { re: line[0], im: line[1] }
    }

    #[inline(always)]
    pub fn store(self, line: &mut Line<L>) {
        *line = [self.re, self.im];
    }

    #[inline(always)]
    pub fn zero(lanes: L) -> Self {
        Self { re: lanes.zero(), im: lanes.zero() }
    }

    /// Real and imaginary part exchanged.
    #[inline(always)]
    pub fn swapped(self) -> Self {
        Self { re: self.im, im: self.re }
    }

    /// `-self`
    #[inline(always)]
    pub fn negated(self, lanes: L) -> Self {
        Self { re: lanes.sub(lanes.zero(), self.re), im: lanes.sub(lanes.zero(), self.im) }
    }

    #[inline(always)]
    fn add(self, lanes: L, other: Self) -> Self {
        Self { re: lanes.add(self.re, other.re), im: lanes.add(self.im, other.im) }
    }

    #[inline(always)]
    fn sub(self, lanes: L, other: Self) -> Self {
        Self { re: lanes.sub(self.re, other.re), im: lanes.sub(self.im, other.im) }
    }

    /// `self + factor * other`
    #[inline(always)]
    pub fn add_scaled(self, lanes: L, factor: L::Reals, other: Self) -> Self {
        Self { re: lanes.mul_add(factor, other.re, self.re), im: lanes.mul_add(factor, other.im, self.im) }
    }

    /// `self - factor * other`
    #[inline(always)]
    pub fn sub_scaled(self, lanes: L, factor: L::Reals, other: Self) -> Self {
        Self {
            re: lanes.negate_mul_add(factor, other.re, self.re),
            im: lanes.negate_mul_add(factor, other.im, self.im),
        }
    }

    /// `self + i factor * other`
    #[inline(always)]
    pub fn add_turned(self, lanes: L, factor: L::Reals, other: Self) -> Self {
        Self {
            re: lanes.negate_mul_add(factor, other.im, self.re),
            im: lanes.mul_add(factor, other.re, self.im),
        }
    }

    /// `self - i factor * other`
    #[inline(always)]
    pub fn sub_turned(self, lanes: L, factor: L::Reals, other: Self) -> Self {
        Self {
            re: lanes.mul_add(factor, other.im, self.re),
            im: lanes.negate_mul_add(factor, other.re, self.im),
        }
    }

    /// `self * exp(-i angle) / cos(angle)`
    #[inline(always)]
    fn sheared(self, lanes: L, tangent: L::Reals) -> Self {
        Self {
            re: lanes.mul_add(tangent, self.im, self.re),
            im: lanes.negate_mul_add(tangent, self.re, self.im),
        }
    }

    /// `self * (cosine - i sine)`
    #[inline(always)]
    pub fn rotated(self, lanes: L, cosine: L::Reals, sine: L::Reals) -> Self {
        Self {
            re: lanes.mul_add(sine, self.im, lanes.mul(cosine, self.re)),
            im: lanes.negate_mul_add(sine, self.re, lanes.mul(cosine, self.im)),
        }
    }
}

/// Weights `exp(-i angle_s)`, `s = 1..R`, in the layout of radix `R = angles.len() + 1`.
pub fn weights<N: Number>(angles: &[f64]) -> Weights<N> {
    let mut weights = [0.0; 8];
    match *angles {
        [a] => weights[..2].copy_from_slice(&[a.tan(), a.cos()]),
        [a, b, c] => {
            weights[..6].copy_from_slice(&[a.tan(), b.tan(), c.tan(), b.cos(), c.cos() / a.cos(), a.cos()]);
        }
        _ => {
            for (weight, angle) in weights.chunks_exact_mut(2).zip(angles) {
                weight.copy_from_slice(&[angle.cos(), angle.sin()]);
            }
        }
    }
    weights.map(N::of)
}

/// Butterfly of radix `R`, one of 2, 3, 4, 5, with the weights in all lanes.
#[inline(always)]
pub fn butterfly<L: Lanes, const R: usize>(
    lanes: L,
    x: [Complex<L>; R],
    w: &[L::Reals; 8],
) -> [Complex<L>; R] {
    let mut y = x;
    match R {
        2 => {
            let turned = x[1].sheared(lanes, w[0]);
            y[0] = x[0].add_scaled(lanes, w[1], turned);
            y[1] = x[0].sub_scaled(lanes, w[1], turned);
        }
        3 => {
            let [b, c] = [x[1].rotated(lanes, w[0], w[1]), x[2].rotated(lanes, w[2], w[3])];
            let [sum, difference] = [b.add(lanes, c), b.sub(lanes, c)];
            let middle = x[0].sub_scaled(lanes, lanes.constant(0.5), sum);
            let height = lanes.constant(SINE_OF_THIRD);
            y[0] = x[0].add(lanes, sum);
            y[1] = middle.sub_turned(lanes, height, difference);
            y[2] = middle.add_turned(lanes, height, difference);
        }
        4 => {
            let [b, c, d] = [x[1].sheared(lanes, w[0]), x[2].sheared(lanes, w[1]), x[3].sheared(lanes, w[2])];
            let [even_sum, even_difference] =
                [x[0].add_scaled(lanes, w[3], c), x[0].sub_scaled(lanes, w[3], c)];
            let [odd_sum, odd_difference] = [b.add_scaled(lanes, w[4], d), b.sub_scaled(lanes, w[4], d)];
            y[0] = even_sum.add_scaled(lanes, w[5], odd_sum);
            y[1] = even_difference.sub_turned(lanes, w[5], odd_difference);
            y[2] = even_sum.sub_scaled(lanes, w[5], odd_sum);
            y[3] = even_difference.add_turned(lanes, w[5], odd_difference);
        }
        _ => {
            let [b, c] = [x[1].rotated(lanes, w[0], w[1]), x[2].rotated(lanes, w[2], w[3])];
            let [d, e] = [x[3].rotated(lanes, w[4], w[5]), x[4].rotated(lanes, w[6], w[7])];
            let [outer_sum, outer_difference] = [b.add(lanes, e), b.sub(lanes, e)];
            let [inner_sum, inner_difference] = [c.add(lanes, d), c.sub(lanes, d)];
            let [cosine1, cosine2] = [lanes.constant(COSINE_OF_FIFTH), lanes.constant(COSINE_OF_TWO_FIFTHS)];
            let [sine1, sine2] = [lanes.constant(SINE_OF_FIFTH), lanes.constant(SINE_OF_TWO_FIFTHS)];
            let near = x[0].add_scaled(lanes, cosine1, outer_sum).add_scaled(lanes, cosine2, inner_sum);
            let far = x[0].add_scaled(lanes, cosine2, outer_sum).add_scaled(lanes, cosine1, inner_sum);
            y[0] = x[0].add(lanes, outer_sum).add(lanes, inner_sum);
            y[1] = near.sub_turned(lanes, sine1, outer_difference).sub_turned(lanes, sine2, inner_difference);
            y[4] = near.add_turned(lanes, sine1, outer_difference).add_turned(lanes, sine2, inner_difference);
            y[2] = far.sub_turned(lanes, sine2, outer_difference).add_turned(lanes, sine1, inner_difference);
            y[3] = far.add_turned(lanes, sine2, outer_difference).sub_turned(lanes, sine1, inner_difference);
        }
    }
    y
}

/// Butterfly of radix 4 without weights.
#[inline(always)]
pub fn plain_butterfly<L: Lanes>(lanes: L, x: [Complex<L>; 4]) -> [Complex<L>; 4] {
    let [even_sum, even_difference] = [x[0].add(lanes, x[2]), x[0].sub(lanes, x[2])];
    let [odd_sum, odd_difference] = [x[1].add(lanes, x[3]), x[1].sub(lanes, x[3])];
    let turned = odd_difference.swapped();
    [
        even_sum.add(lanes, odd_sum),
        Complex {
            re: lanes.add(even_difference.re, turned.re),
            im: lanes.sub(even_difference.im, turned.im),
        },
        even_sum.sub(lanes, odd_sum),
        Complex {
            re: lanes.sub(even_difference.re, turned.re),
            im: lanes.add(even_difference.im, turned.im),
        },
    ]
}

/// Weights in all lanes.
#[inline(always)]
pub fn splat<L: Lanes>(lanes: L, weights: &Weights<L::Number>) -> [L::Reals; 8] {
    // Written out, so that what a radix does not use is not even loaded.
    let [a, b, c, d, e, f, g, h] = *weights;
    [
        lanes.splat(a),
        lanes.splat(b),
        lanes.splat(c),
        lanes.splat(d),
        lanes.splat(e),
        lanes.splat(f),
        lanes.splat(g),
        lanes.splat(h),
    ]
}

/// `sin(2 pi / 3)`
const SINE_OF_THIRD: f64 = 0.866_025_403_784_438_6;
/// `cos(2 pi / 5)`
const COSINE_OF_FIFTH: f64 = 0.309_016_994_374_947_45;
/// `cos(4 pi / 5)`
const COSINE_OF_TWO_FIFTHS: f64 = -0.809_016_994_374_947_5;
/// `sin(2 pi / 5)`
const SINE_OF_FIFTH: f64 = 0.951_056_516_295_153_5;
/// `sin(4 pi / 5)`
const SINE_OF_TWO_FIFTHS: f64 = 0.587_785_252_292_473_1;
