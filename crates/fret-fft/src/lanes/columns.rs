//! Column stage: forward transform, kernels and inverse transform of one strip of all fields, in cache.
//!
//! The free-space product has two parts: the columns at `w_k`, and those at `-w_k`, which are the columns at `w_k` of the
//! numbers with real and imaginary part exchanged. The periodic product has the first part only.

use std::ops::Range;

use super::butterfly::{Complex, butterfly, plain_butterfly, splat};
use super::memory::{Line, OnCacheLine, as_lines, as_lines_mut, as_vectors, fetch};
use super::passes::{forward_middle, inverse_middle, load_quad, parts, with_radix};
use super::plan::LinePlan;
use super::row_groups::Layout;
use super::simd::{Lanes, Task};

/// One term of the kernel product, in the order of the engine.
#[derive(Debug, Clone, Copy)]
pub struct Term<N> {
    pub input: usize,
    pub kernel: usize,
    /// Factor in the parts at `w_k` and at `-w_k`.
    pub factors: [N; 2],
    /// Whether the factor is to be multiplied by `i`.
    pub imaginary: bool,
}

/// Strips of the spectra of `F` fields (the larger of the numbers of inputs and outputs), in `P` parts, from `first` on.
pub struct Columns<'a, N, const F: usize, const P: usize> {
    pub layout: &'a Layout,
    pub plan: &'a LinePlan<N>,
    /// How many of the fields are inputs.
    pub inputs: usize,
    /// `[strip][group of four places][kernel][place of the group]`
    pub kernels: &'a [N],
    pub kernel_count: usize,
    /// Terms of each output.
    pub terms: &'a [Vec<Term<N>>],
    pub first: usize,
    /// Spectra of the inputs, which those of the outputs take the place of.
    pub strips: &'a mut [N],
    pub scratch: &'a mut [N],
}

impl<L: Lanes, const F: usize, const P: usize> Task<L> for Columns<'_, L::Number, F, P> {
    #[inline(always)]
    fn run(self, lanes: L) {
        let Self { layout, plan, terms, kernel_count, .. } = self;
        let (n, inner) = (plan.length(), plan.inner_length());
        let inputs = self.inputs;
        let field_len = layout.field_len();
        let lines = &mut as_lines_mut::<L>(self.scratch)[..F * P * n];
        let kernel_len = n * kernel_count * L::WIDTH;
        for (strip, fields) in (self.first..).zip(self.strips.chunks_exact_mut(layout.strip_stride)) {
            let columns = lines.chunks_exact_mut(P * n);
            for (input, lines) in fields.chunks_exact(field_len).take(inputs).zip(columns) {
                let spectrum = as_lines::<L>(input);
                with_radix!(plan.outermost(), R => {
                    let rows = layout.rows_read;
                    lanes.enter(OutermostForward::<L, R, P> { plan, spectrum, rows, lines });
                });
            }
            let kernels = as_vectors::<L>(&self.kernels[strip * kernel_len..][..kernel_len]);
            for block in 0..plan.outermost() {
                let places = block * inner..(block + 1) * inner;
                for column in lines.chunks_exact_mut(n).take(P * inputs) {
                    forward_middle(lanes, plan, block, &mut column[places.clone()]);
                }
                let (lines, places) = (&mut *lines, places.clone());
                lanes.enter(Multiply::<L, F, P> {
                    plan,
                    inputs,
                    kernels,
                    kernel_count,
                    terms,
                    places,
                    lines,
                });
                for column in lines.chunks_exact_mut(n).take(P * terms.len()) {
                    inverse_middle(lanes, plan, &mut column[block * inner..(block + 1) * inner]);
                }
            }
            let columns = lines.chunks_exact_mut(P * n);
            for (output, lines) in fields.chunks_exact_mut(field_len).take(terms.len()).zip(columns) {
                let output = &mut as_lines_mut::<L>(output)[..n];
                with_radix!(plan.outermost(), R => {
                    lanes.enter(OutermostInverse::<L, R, P> { plan, lines, output });
                });
            }
        }
    }
}

/// Reads one column of an input and does the outermost pass of its parts.
pub struct OutermostForward<'a, L: Lanes, const R: usize, const P: usize> {
    pub plan: &'a LinePlan<L::Number>,
    pub spectrum: &'a [Line<L>],
    /// Rows to be read; the others are zero.
    pub rows: usize,
    pub lines: &'a mut [Line<L>],
}

impl<L: Lanes, const R: usize, const P: usize> Task<L> for OutermostForward<'_, L, R, P> {
    #[inline(always)]
    fn run(self, lanes: L) {
        let Self { plan, spectrum, rows, lines } = self;
        let places = plan.inner_length();
        let weights = splat(lanes, &plan.forward(0)[0]);
        let (direct, mirrored) = lines.split_at_mut(plan.length());
        let direct = parts::<L, R>(direct, places);
        let mirrored = parts::<L, R>(mirrored, places);
        for j in 0..places {
            let mut x = [Complex::zero(lanes); R];
            for m in 0..R {
                let row = m * places + j;
                if m * places < rows {
                    x[m] = Complex::load(&spectrum[row]);
                }
            }
            let y = butterfly(lanes, x, &weights);
            for m in 0..R {
                y[m].store(&mut direct[m][j]);
            }
            if P == 2 {
                for m in 0..R {
                    x[m] = x[m].swapped();
                }
                let y = butterfly(lanes, x, &weights);
                for m in 0..R {
                    y[m].store(&mut mirrored[m][j]);
                }
            }
        }
    }
}

/// Innermost forward pass, kernels, innermost inverse pass, on some places of all columns.
struct Multiply<'a, L: Lanes, const F: usize, const P: usize> {
    plan: &'a LinePlan<L::Number>,
    inputs: usize,
    kernels: &'a [L::Reals],
    kernel_count: usize,
    terms: &'a [Vec<Term<L::Number>>],
    places: Range<usize>,
    lines: &'a mut [Line<L>],
}

impl<L: Lanes, const F: usize, const P: usize> Task<L> for Multiply<'_, L, F, P> {
    #[inline(always)]
    fn run(self, lanes: L) {
        let n = self.plan.length();
        let count = self.kernel_count;
        let lines = self.lines;
        let mut before = OnCacheLine([[[Complex::zero(lanes); 4]; P]; F]);
        for place in self.places.step_by(4) {
            let weights = splat(lanes, &self.plan.innermost_forward()[place / 4]);
            let kernels = &self.kernels[place * count..(place + 4) * count];
            fetch(self.kernels.get((place + 8).wrapping_mul(count)..(place + 12).wrapping_mul(count)));
            for field in 0..self.inputs.min(F) {
                for part in 0..P {
                    let quad = &lines[(field * P + part) * n + place..][..4];
                    before.0[field][part] = butterfly(lanes, load_quad(lanes, quad), &weights);
                }
            }
            for (output, terms) in self.terms.iter().enumerate() {
                let mut sums = [[Complex::zero(lanes); 4]; P];
                for term in terms {
                    let kernel = &kernels[4 * term.kernel..][..4];
                    let x = &before.0[term.input];
                    for part in 0..P {
                        let factor = lanes.splat(term.factors[part]);
                        for m in 0..4 {
                            let kernel = lanes.mul(kernel[m], factor);
                            sums[part][m] = if term.imaginary {
                                sums[part][m].add_turned(lanes, kernel, x[part][m])
                            } else {
                                sums[part][m].add_scaled(lanes, kernel, x[part][m])
                            };
                        }
                    }
                }
                for part in 0..P {
                    for m in 0..4 {
                        sums[part][m] = sums[part][m].swapped();
                    }
                    let y = plain_butterfly(lanes, sums[part]);
                    let quad = &mut lines[(output * P + part) * n + place..][..4];
                    for m in 0..4 {
                        y[m].store(&mut quad[m]);
                    }
                }
            }
        }
    }
}

/// Outermost inverse pass of the parts of one column, their sum, and out.
pub struct OutermostInverse<'a, L: Lanes, const R: usize, const P: usize> {
    pub plan: &'a LinePlan<L::Number>,
    pub lines: &'a mut [Line<L>],
    pub output: &'a mut [Line<L>],
}

impl<L: Lanes, const R: usize, const P: usize> Task<L> for OutermostInverse<'_, L, R, P> {
    #[inline(always)]
    fn run(self, lanes: L) {
        let Self { plan, lines, output } = self;
        let places = plan.inner_length();
        let turns = plan.output_turns();
        let (direct, mirrored) = lines.split_at_mut(plan.length());
        let direct = parts::<L, R>(direct, places);
        let mirrored = parts::<L, R>(mirrored, places);
        let output = parts::<L, R>(output, places);
        for (j, (weights, turn)) in plan.inverse(0).iter().zip(plan.first_turns()).enumerate() {
            let weights = splat(lanes, weights);
            let mut x = [Complex::zero(lanes); R];
            for m in 0..R {
                x[m] = Complex::load(&direct[m][j]);
            }
            if P == 1 {
                let y = butterfly(lanes, x, &weights);
                for m in 0..R {
                    y[m].swapped().store(&mut output[m][j]);
                }
                continue;
            }
            let [cosine, sine] = [lanes.splat(turn[0]), lanes.splat(turn[1])];
            x[0] = x[0].rotated(lanes, cosine, sine);
            let a = butterfly(lanes, x, &weights);
            for m in 0..R {
                x[m] = Complex::load(&mirrored[m][j]);
            }
            x[0] = x[0].rotated(lanes, cosine, sine);
            let b = butterfly(lanes, x, &weights);
            for m in 0..R {
                let mut sum =
                    Complex::<L> { re: lanes.add(a[m].im, b[m].re), im: lanes.add(a[m].re, b[m].im) };
                if m > 0 {
                    let [cosine, sine] = [lanes.splat(turns[m][0]), lanes.splat(turns[m][1])];
                    let [across, along] = [lanes.sub(b[m].im, a[m].re), lanes.sub(a[m].im, b[m].re)];
                    sum = Complex {
                        re: lanes.mul_add(sine, across, lanes.mul(cosine, sum.re)),
                        im: lanes.mul_add(sine, along, lanes.mul(cosine, sum.im)),
                    };
                }
                sum.store(&mut output[m][j]);
            }
        }
    }
}
