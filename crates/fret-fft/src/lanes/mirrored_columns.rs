//! Column stage of products on the part of a grid that its mirrors leave.
//!
//! Numbers of a column are `Z = A - i B`: at a mirror across the rows `A` and `B` are the real transforms at two frequencies
//! (see [`Side`]), otherwise the real and minus the imaginary part at one. Transformed along `x`, each of the two is such a
//! pair again, `P - i Q`. So every place has four real numbers, the slots `AP, AQ, BP, BQ`, and a kernel takes slots to slots
//! with a real factor each: see [`SlotTerm`](super::mirrored_kernels::SlotTerm). In free space the second part of a column, its numbers with real and imaginary
//! part exchanged, tells `A` from `B`; in a product that repeats, the place of the opposite frequency does.

use super::butterfly::{Complex, butterfly, splat};
use super::columns::{OutermostForward, OutermostInverse};
use super::memory::{Line, as_lines, as_lines_mut, as_vectors};
use super::mirrored_kernels::{MirroredTerm, MultiplyPairs, MultiplyParts};
use super::paired_rows::Places;
use super::passes::{forward_middle, inverse_middle, parts, with_radix};
use super::plan::LinePlan;
use super::row_groups::Layout;
use super::rows::{Side, mirrored_point};
use super::simd::{Lanes, Task};

/// How the fields lie to a mirror across the columns, at most three of each kind.
#[derive(Debug, Clone, Copy)]
pub struct Sides {
    pub inputs: [Side; 3],
    pub outputs: [Side; 3],
}

/// Strips of the spectra of `F` fields (the larger of the numbers of inputs and outputs), in `P` parts, from `first` on:
/// two parts in free space, one where the scene repeats.
pub struct MirroredColumns<'a, N, const F: usize, const P: usize> {
    pub layout: &'a Layout,
    pub plan: &'a LinePlan<N>,
    pub sides: Sides,
    /// How many of the fields are inputs.
    pub inputs: usize,
    /// `[strip][group of four places][table][place of the group]`, or `[strip][frequency][table]` where the scene repeats.
    pub kernels: &'a [N],
    pub table_count: usize,
    /// Places of the frequencies `0..=n/2` along `x`, where the scene repeats.
    pub places: &'a [Places],
    /// Terms of each output.
    pub terms: &'a [Vec<MirroredTerm<N>>],
    pub first: usize,
    /// Spectra of the inputs, which those of the outputs take the place of.
    pub strips: &'a mut [N],
    pub scratch: &'a mut [N],
}

impl<L: Lanes, const F: usize, const P: usize> Task<L> for MirroredColumns<'_, L::Number, F, P> {
    #[inline(always)]
    fn run(self, lanes: L) {
        let Self { layout, plan, terms, table_count, sides, places, .. } = self;
        let (n, inner) = (plan.length(), plan.inner_length());
        let inputs = self.inputs;
        let mirrored = sides.inputs[0].is_mirrored();
        let field_len = layout.field_len();
        let lines = &mut as_lines_mut::<L>(self.scratch)[..F * P * n];
        let rows = if P == 2 { n } else { places.len() };
        let kernel_len = rows * table_count * L::WIDTH;
        for (strip, fields) in (self.first..).zip(self.strips.chunks_exact_mut(layout.strip_stride)) {
            let columns = lines.chunks_exact_mut(P * n).zip(sides.inputs);
            for (input, (lines, side)) in fields.chunks_exact(field_len).take(inputs).zip(columns) {
                let spectrum = as_lines::<L>(input);
                with_radix!(plan.outermost(), R => {
                    if mirrored {
                        lanes.enter(MirroredForward::<L, R, P> { plan, side, spectrum, lines });
                    } else {
                        let rows = layout.rows_read;
                        lanes.enter(OutermostForward::<L, R, P> { plan, spectrum, rows, lines });
                    }
                });
            }
            let kernels = as_vectors::<L>(&self.kernels[strip * kernel_len..][..kernel_len]);
            for block in 0..plan.outermost() {
                let within = block * inner..(block + 1) * inner;
                for column in lines.chunks_exact_mut(n).take(P * inputs) {
                    forward_middle(lanes, plan, block, &mut column[within.clone()]);
                }
                if P == 2 {
                    let (lines, places) = (&mut *lines, within.clone());
                    lanes.enter(MultiplyParts::<L, F> {
                        plan,
                        mirrored,
                        inputs,
                        kernels,
                        table_count,
                        terms,
                        places,
                        lines,
                    });
                    for column in lines.chunks_exact_mut(n).take(P * terms.len()) {
                        inverse_middle(lanes, plan, &mut column[within.clone()]);
                    }
                }
            }
            if P == 1 {
                let lines = &mut *lines;
                lanes.enter(MultiplyPairs::<L, F> {
                    plan,
                    mirrored,
                    inputs,
                    kernels,
                    table_count,
                    terms,
                    places,
                    lines,
                });
                for column in lines.chunks_exact_mut(n).take(terms.len()) {
                    for block in column.chunks_exact_mut(inner) {
                        inverse_middle(lanes, plan, block);
                    }
                }
            }
            let columns = lines.chunks_exact_mut(P * n).zip(sides.outputs);
            for (output, (lines, side)) in fields.chunks_exact_mut(field_len).take(terms.len()).zip(columns) {
                let output = &mut as_lines_mut::<L>(output)[..n];
                with_radix!(plan.outermost(), R => {
                    if mirrored {
                        lanes.enter(MirroredInverse::<L, R, P> { plan, side, lines, output });
                    } else {
                        lanes.enter(OutermostInverse::<L, R, P> { plan, lines, output });
                    }
                });
            }
        }
    }
}

/// Reads one column of an input in the order of a mirrored line and does the outermost pass of its parts.
pub struct MirroredForward<'a, L: Lanes, const R: usize, const P: usize> {
    pub plan: &'a LinePlan<L::Number>,
    pub side: Side,
    pub spectrum: &'a [Line<L>],
    pub lines: &'a mut [Line<L>],
}

impl<L: Lanes, const R: usize, const P: usize> Task<L> for MirroredForward<'_, L, R, P> {
    #[inline(always)]
    fn run(self, lanes: L) {
        let Self { plan, side, spectrum, lines } = self;
        let places = plan.inner_length();
        let weights = splat(lanes, &plan.forward(0)[0]);
        let sign = lanes.constant(side.backward_sign());
        let (direct, exchanged) = lines.split_at_mut(plan.length());
        let direct = parts::<L, R>(direct, places);
        let exchanged = parts::<L, R>(exchanged, places);
        for j in 0..places {
            let mut x = [Complex::zero(lanes); R];
            let mut y = [Complex::zero(lanes); R];
            for m in 0..R {
                let (row, backward) = mirrored_point(m * places + j, plan.length());
                x[m] = Complex::load(&spectrum[row]);
                y[m] = x[m].swapped();
                if backward {
                    x[m] = taken_backwards::<L, P>(lanes, sign, x[m]);
                    y[m] = taken_backwards::<L, P>(lanes, sign, y[m]);
                }
            }
            let x = butterfly(lanes, x, &weights);
            for m in 0..R {
                x[m].store(&mut direct[m][j]);
            }
            if P == 2 {
                let y = butterfly(lanes, y, &weights);
                for m in 0..R {
                    y[m].store(&mut exchanged[m][j]);
                }
            }
        }
    }
}

/// A point that a mirrored line takes backwards: times `i` in free space.
#[inline(always)]
fn taken_backwards<L: Lanes, const P: usize>(lanes: L, sign: L::Reals, x: Complex<L>) -> Complex<L> {
    if P == 2 {
        Complex { re: lanes.sub(lanes.zero(), lanes.mul(sign, x.im)), im: lanes.mul(sign, x.re) }
    } else {
        Complex { re: lanes.mul(sign, x.re), im: lanes.mul(sign, x.im) }
    }
}

/// Outermost inverse pass of the parts of one mirrored column, and out in the order of the rows.
struct MirroredInverse<'a, L: Lanes, const R: usize, const P: usize> {
    plan: &'a LinePlan<L::Number>,
    side: Side,
    lines: &'a mut [Line<L>],
    output: &'a mut [Line<L>],
}

impl<L: Lanes, const R: usize, const P: usize> Task<L> for MirroredInverse<'_, L, R, P> {
    #[inline(always)]
    fn run(self, lanes: L) {
        let Self { plan, side, lines, output } = self;
        let places = plan.inner_length();
        let turns = plan.output_turns();
        let sign = lanes.constant(side.backward_sign());
        let (direct, exchanged) = lines.split_at_mut(plan.length());
        let direct = parts::<L, R>(direct, places);
        let exchanged = parts::<L, R>(exchanged, places);
        for (j, (weights, turn)) in plan.inverse(0).iter().zip(plan.first_turns()).enumerate() {
            let weights = splat(lanes, weights);
            let [cosine, sine] = [lanes.splat(turn[0]), lanes.splat(turn[1])];
            let mut x = [Complex::zero(lanes); R];
            for m in 0..R {
                x[m] = Complex::load(&direct[m][j]);
            }
            if P == 1 {
                let y = butterfly(lanes, x, &weights);
                for m in 0..R {
                    let (row, backward) = mirrored_point(m * places + j, plan.length());
                    let mut number = y[m].swapped();
                    if backward {
                        number = taken_backwards::<L, P>(lanes, sign, number);
                    }
                    number.store(&mut output[row]);
                }
                continue;
            }
            x[0] = x[0].rotated(lanes, cosine, sine);
            let a = butterfly(lanes, x, &weights);
            for m in 0..R {
                x[m] = Complex::load(&exchanged[m][j]);
            }
            x[0] = x[0].rotated(lanes, cosine, sine);
            let b = butterfly(lanes, x, &weights);
            for m in 0..R {
                let [cosine, sine] = [lanes.splat(turns[m][0]), lanes.splat(turns[m][1])];
                let (a, b) = (a[m].rotated(lanes, cosine, sine), b[m].rotated(lanes, cosine, sine));
                let (row, backward) = mirrored_point(m * places + j, plan.length());
                let number = if backward {
                    Complex::<L> {
                        re: lanes.mul(sign, lanes.sub(a.re, b.im)),
                        im: lanes.mul(sign, lanes.sub(b.re, a.im)),
                    }
                } else {
                    Complex::<L> { re: lanes.add(a.im, b.re), im: lanes.add(a.re, b.im) }
                };
                number.store(&mut output[row]);
            }
        }
    }
}
