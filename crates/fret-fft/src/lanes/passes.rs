//! The passes of a line transform between the outermost and the innermost one, which belong to the stages.

use super::butterfly::{Complex, Weights, butterfly, splat};
use super::memory::Line;
use super::plan::LinePlan;
use super::simd::{Lanes, Task};

/// An expression in which `$r` is the radix as a constant.
macro_rules! with_radix {
    ($radix:expr, $r:ident => $body:expr) => {
        match $radix {
            2 => {
                const $r: usize = 2;
                $body
            }
            3 => {
                const $r: usize = 3;
                $body
            }
            4 => {
                const $r: usize = 4;
                $body
            }
            _ => {
                const $r: usize = 5;
                $body
            }
        }
    };
}
pub(super) use with_radix;

/// Forward passes on the lines of one block of the outermost pass, in place.
#[inline(always)]
pub fn forward_middle<L: Lanes>(lanes: L, plan: &LinePlan<L::Number>, block: usize, lines: &mut [Line<L>]) {
    for (pass, radix) in plan.middle_passes() {
        let weights = plan.forward(pass);
        let count = weights.len() / plan.outermost();
        let weights = &weights[block * count..(block + 1) * count];
        with_radix!(radix, R => lanes.enter(ForwardPass::<L, R> { lines, weights }));
    }
}

/// Inverse passes on the lines of one block of the outermost pass, in place, on swapped numbers.
#[inline(always)]
pub fn inverse_middle<L: Lanes>(lanes: L, plan: &LinePlan<L::Number>, lines: &mut [Line<L>]) {
    for (pass, radix) in plan.middle_passes().rev() {
        let weights = plan.inverse(pass);
        with_radix!(radix, R => lanes.enter(InversePass::<L, R> { lines, weights }));
    }
}

/// Butterflies with the same weights all over a block.
struct ForwardPass<'a, L: Lanes, const R: usize> {
    lines: &'a mut [Line<L>],
    /// One per block.
    weights: &'a [Weights<L::Number>],
}

impl<L: Lanes, const R: usize> Task<L> for ForwardPass<'_, L, R> {
    #[inline(always)]
    fn run(self, lanes: L) {
        let places = self.lines.len() / (R * self.weights.len());
        for (block, weights) in self.lines.chunks_exact_mut(R * places).zip(self.weights) {
            let weights = splat(lanes, weights);
            let parts = parts::<L, R>(block, places);
            for j in 0..places {
                let mut x = [Complex::zero(lanes); R];
                for m in 0..R {
                    x[m] = Complex::load(&parts[m][j]);
                }
                let y = butterfly(lanes, x, &weights);
                for m in 0..R {
                    y[m].store(&mut parts[m][j]);
                }
            }
        }
    }
}

/// Butterflies with the same weights at the same place of every block.
struct InversePass<'a, L: Lanes, const R: usize> {
    lines: &'a mut [Line<L>],
    /// One per place.
    weights: &'a [Weights<L::Number>],
}

impl<L: Lanes, const R: usize> Task<L> for InversePass<'_, L, R> {
    #[inline(always)]
    fn run(self, lanes: L) {
        let places = self.weights.len();
        for block in self.lines.chunks_exact_mut(R * places) {
            let parts = parts::<L, R>(block, places);
            for (j, weights) in self.weights.iter().enumerate() {
                let weights = splat(lanes, weights);
                let mut x = [Complex::zero(lanes); R];
                for m in 0..R {
                    x[m] = Complex::load(&parts[m][j]);
                }
                let y = butterfly(lanes, x, &weights);
                for m in 0..R {
                    y[m].store(&mut parts[m][j]);
                }
            }
        }
    }
}

/// A block as `R` runs of `places` lines.
#[inline(always)]
pub fn parts<L: Lanes, const R: usize>(block: &mut [Line<L>], places: usize) -> [&mut [Line<L>]; R] {
    let mut parts: [&mut [Line<L>]; R] = std::array::from_fn(|_| Default::default());
    for (part, lines) in parts.iter_mut().zip(block.chunks_exact_mut(places)) {
        *part = lines;
    }
    parts
}

/// Four neighbouring lines.
#[inline(always)]
pub fn load_quad<L: Lanes>(lanes: L, lines: &[Line<L>]) -> [Complex<L>; 4] {
    let mut quad = [Complex::zero(lanes); 4];
    for (number, line) in quad.iter_mut().zip(lines) {
        *number = Complex::load(line);
    }
    quad
}
