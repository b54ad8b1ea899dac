//! Column stage of products on the part of a grid that its mirrors leave.
//!
//! Numbers of a column are `Z = A - i B`: at a mirror across the rows `A` and `B` are the real transforms at two frequencies
//! (see [`Side`]), otherwise the real and minus the imaginary part at one. Transformed along `x`, each of the two is such a
//! pair again, `P - i Q`. So every place has four real numbers, the slots `AP, AQ, BP, BQ`, and a kernel takes slots to slots
//! with a real factor each: see [`SlotTerm`]. In free space the second part of a column, its numbers with real and imaginary
//! part exchanged, tells `A` from `B`; in a product that repeats, the place of the opposite frequency does.

use std::ops::Range;

use super::butterfly::{Complex, butterfly, plain_butterfly, splat};
use super::columns::{OutermostForward, OutermostInverse};
use super::memory::{Line, OnCacheLine, as_lines, as_lines_mut, as_vectors, fetch};
use super::paired_rows::Places;
use super::passes::{forward_middle, inverse_middle, load_quad, parts, with_radix};
use super::plan::LinePlan;
use super::rows::{Layout, Side, mirrored_point};
use super::simd::{Lanes, Task};

/// Where the number of a slot comes from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SlotTerm<N> {
    /// Slot of the input.
    pub source: usize,
    /// Table of the kernel, at the frequencies of the slot.
    pub table: usize,
    /// Factor beside the table.
    pub factor: N,
}

/// One term of the kernel product.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MirroredTerm<N> {
    pub input: usize,
    pub slots: [SlotTerm<N>; 4],
}

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
    /// Spectra of the inputs, `[input][group][strip][row of the group]`.
    pub inputs: &'a [N],
    /// Numbers of one input.
    pub input_len: usize,
    /// `[strip][group of four places][table][place of the group]`, or `[strip][frequency][table]` where the scene repeats.
    pub kernels: &'a [N],
    pub table_count: usize,
    /// Places of the frequencies `0..=n/2` along `x`, where the scene repeats.
    pub places: &'a [Places],
    /// Terms of each output.
    pub terms: &'a [Vec<MirroredTerm<N>>],
    pub first: usize,
    pub strips: &'a mut [N],
    pub scratch: &'a mut [N],
}

impl<L: Lanes, const F: usize, const P: usize> Task<L> for MirroredColumns<'_, L::Number, F, P> {
    #[inline(always)]
    fn run(self, lanes: L) {
        let Self { layout, plan, terms, table_count, sides, places, .. } = self;
        let (n, inner) = (plan.length(), plan.inner_length());
        let inputs = self.inputs.len() / self.input_len;
        let mirrored = sides.inputs[0].is_mirrored();
        let stride = layout.group_stride / (2 * L::WIDTH);
        let lines = &mut as_lines_mut::<L>(self.scratch)[..F * P * n];
        let rows = if P == 2 { n } else { places.len() };
        let kernel_len = rows * table_count * L::WIDTH;
        for (strip, outputs) in (self.first..).zip(self.strips.chunks_exact_mut(layout.strip_stride)) {
            for ((input, side), lines) in
                self.inputs.chunks_exact(self.input_len).zip(sides.inputs).zip(lines.chunks_exact_mut(P * n))
            {
                let spectrum = &as_lines::<L>(input)[strip * L::WIDTH..];
                with_radix!(plan.outermost(), R => {
                    if mirrored {
                        lanes.enter(MirroredForward::<L, R, P> { plan, side, spectrum, stride, lines });
                    } else {
                        let rows = layout.rows_read;
                        lanes.enter(OutermostForward::<L, R, P> { plan, spectrum, stride, rows, lines });
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
            let outputs = as_lines_mut::<L>(&mut outputs[..terms.len() * n * 2 * L::WIDTH]);
            for ((output, side), lines) in
                outputs.chunks_exact_mut(n).zip(sides.outputs).zip(lines.chunks_exact_mut(P * n))
            {
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
struct MirroredForward<'a, L: Lanes, const R: usize, const P: usize> {
    plan: &'a LinePlan<L::Number>,
    side: Side,
    spectrum: &'a [Line<L>],
    /// Lines from one row group to the next.
    stride: usize,
    lines: &'a mut [Line<L>],
}

impl<L: Lanes, const R: usize, const P: usize> Task<L> for MirroredForward<'_, L, R, P> {
    #[inline(always)]
    fn run(self, lanes: L) {
        let Self { plan, side, spectrum, stride, lines } = self;
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
                let at = (row / L::WIDTH).wrapping_mul(stride).wrapping_add(row % L::WIDTH);
                x[m] = Complex::load(&spectrum[at]);
                let next = if backward { at.wrapping_sub(stride) } else { at.wrapping_add(stride) };
                fetch(spectrum.get(next).map(<[_; 2]>::as_slice));
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

/// Innermost forward pass, kernels, innermost inverse pass, on some places of both parts of all columns in free space.
struct MultiplyParts<'a, L: Lanes, const F: usize> {
    plan: &'a LinePlan<L::Number>,
    mirrored: bool,
    inputs: usize,
    kernels: &'a [L::Reals],
    table_count: usize,
    terms: &'a [Vec<MirroredTerm<L::Number>>],
    places: Range<usize>,
    lines: &'a mut [Line<L>],
}

impl<L: Lanes, const F: usize> Task<L> for MultiplyParts<'_, L, F> {
    #[inline(always)]
    fn run(self, lanes: L) {
        let n = self.plan.length();
        let count = self.table_count;
        let lines = self.lines;
        let zero = lanes.zero();
        let mut slots = OnCacheLine([[[zero; 4]; 4]; F]);
        for place in self.places.step_by(4) {
            let weights = splat(lanes, &self.plan.innermost_forward()[place / 4]);
            let kernels = &self.kernels[place * count..(place + 4) * count];
            fetch(self.kernels.get((place + 8).wrapping_mul(count)..(place + 12).wrapping_mul(count)));
            let turns = &self.plan.mirror_turns()[place..place + 4];
            for field in 0..self.inputs.min(F) {
                let mut d =
                    butterfly(lanes, load_quad(lanes, &lines[2 * field * n + place..][..4]), &weights);
                let mut e =
                    butterfly(lanes, load_quad(lanes, &lines[(2 * field + 1) * n + place..][..4]), &weights);
                for m in 0..4 {
                    if self.mirrored {
                        let [cosine, sine] = [lanes.splat(turns[m][0]), lanes.splat(turns[m][1])];
                        d[m] = d[m].rotated(lanes, cosine, sine);
                        e[m] = e[m].rotated(lanes, cosine, sine);
                    }
                    slots.0[field][0][m] = lanes.add(d[m].re, e[m].im);
                    slots.0[field][1][m] = lanes.sub(e[m].re, d[m].im);
                    slots.0[field][2][m] = lanes.sub(zero, lanes.add(d[m].im, e[m].re));
                    slots.0[field][3][m] = lanes.sub(e[m].im, d[m].re);
                }
            }
            for (output, terms) in self.terms.iter().enumerate() {
                let mut sums = [[zero; 4]; 4];
                for term in terms {
                    for slot in 0..4 {
                        let SlotTerm { source, table, factor } = term.slots[slot];
                        let from = &slots.0[term.input][source];
                        let factor = lanes.splat(factor);
                        for m in 0..4 {
                            let kernel = lanes.mul(kernels[4 * table + m], factor);
                            sums[slot][m] = lanes.mul_add(kernel, from[m], sums[slot][m]);
                        }
                    }
                }
                let mut d = [Complex::<L>::zero(lanes); 4];
                let mut e = [Complex::<L>::zero(lanes); 4];
                for m in 0..4 {
                    d[m] = Complex {
                        re: lanes.sub(sums[0][m], sums[3][m]),
                        im: lanes.sub(zero, lanes.add(sums[1][m], sums[2][m])),
                    };
                    e[m] = Complex {
                        re: lanes.sub(sums[1][m], sums[2][m]),
                        im: lanes.add(sums[0][m], sums[3][m]),
                    };
                    if self.mirrored {
                        let [cosine, sine] =
                            [lanes.splat(turns[m][0]), lanes.sub(zero, lanes.splat(turns[m][1]))];
                        d[m] = d[m].rotated(lanes, cosine, sine);
                        e[m] = e[m].rotated(lanes, cosine, sine);
                    }
                    d[m] = d[m].swapped();
                    e[m] = e[m].swapped();
                }
                let d = plain_butterfly(lanes, d);
                let e = plain_butterfly(lanes, e);
                for m in 0..4 {
                    d[m].store(&mut lines[2 * output * n + place + m]);
                    e[m].store(&mut lines[(2 * output + 1) * n + place + m]);
                }
            }
        }
    }
}

/// Innermost forward pass, kernels, innermost inverse pass on whole columns of a product that repeats, pair by pair of
/// opposite frequencies.
struct MultiplyPairs<'a, L: Lanes, const F: usize> {
    plan: &'a LinePlan<L::Number>,
    mirrored: bool,
    inputs: usize,
    kernels: &'a [L::Reals],
    table_count: usize,
    terms: &'a [Vec<MirroredTerm<L::Number>>],
    places: &'a [Places],
    lines: &'a mut [Line<L>],
}

impl<L: Lanes, const F: usize> Task<L> for MultiplyPairs<'_, L, F> {
    #[inline(always)]
    fn run(self, lanes: L) {
        let n = self.plan.length();
        let count = self.table_count;
        let lines = self.lines;
        let zero = lanes.zero();
        for column in lines.chunks_exact_mut(n).take(self.inputs.min(F)) {
            for (quad, weights) in column.chunks_exact_mut(4).zip(self.plan.innermost_forward()) {
                let y = butterfly(lanes, load_quad(lanes, quad), &splat(lanes, weights));
                for m in 0..4 {
                    y[m].store(&mut quad[m]);
                }
            }
        }
        let mut slots = OnCacheLine([[zero; 4]; F]);
        for (places, kernels) in self.places.iter().zip(self.kernels.chunks_exact(count)) {
            let [cosine, sine] = self.plan.mirror_turns()[places.direct];
            let cosine = lanes.splat(cosine);
            let forward = lanes.splat(sine);
            let back = lanes.sub(zero, forward);
            for field in 0..self.inputs.min(F) {
                let d = Complex::<L>::load(&lines[field * n + places.direct]);
                let e = Complex::<L>::load(&lines[field * n + places.mirrored]);
                let mut a = Complex::<L> { re: lanes.add(d.re, e.re), im: lanes.sub(d.im, e.im) };
                let mut b =
                    Complex::<L> { re: lanes.sub(zero, lanes.add(d.im, e.im)), im: lanes.sub(d.re, e.re) };
                if self.mirrored {
                    a = a.rotated(lanes, cosine, forward);
                    b = b.rotated(lanes, cosine, forward);
                }
                slots.0[field] = [a.re, lanes.sub(zero, a.im), b.re, lanes.sub(zero, b.im)];
            }
            for (output, terms) in self.terms.iter().enumerate() {
                let mut sums = [zero; 4];
                for term in terms {
                    for slot in 0..4 {
                        let SlotTerm { source, table, factor } = term.slots[slot];
                        let kernel = lanes.mul(kernels[table], lanes.splat(factor));
                        sums[slot] = lanes.mul_add(kernel, slots.0[term.input][source], sums[slot]);
                    }
                }
                let mut a = Complex::<L> { re: sums[0], im: lanes.sub(zero, sums[1]) };
                let mut b = Complex::<L> { re: sums[2], im: lanes.sub(zero, sums[3]) };
                if self.mirrored {
                    a = a.rotated(lanes, cosine, back);
                    b = b.rotated(lanes, cosine, back);
                }
                // The other way first: at the ends of the spectrum both are one place. Exchanged for the way back.
                lines[output * n + places.mirrored] =
                    [lanes.sub(zero, lanes.add(a.im, b.re)), lanes.sub(a.re, b.im)];
                lines[output * n + places.direct] = [lanes.sub(a.im, b.re), lanes.add(a.re, b.im)];
            }
        }
        for column in lines.chunks_exact_mut(n).take(self.terms.len()) {
            for quad in column.chunks_exact_mut(4) {
                let y = plain_butterfly(lanes, load_quad(lanes, quad));
                for m in 0..4 {
                    y[m].store(&mut quad[m]);
                }
            }
        }
    }
}
