//! Products with the kernels in the column stage of `mirrored_columns`: from slots to slots, between the innermost passes.

use std::ops::Range;

use super::butterfly::{Complex, butterfly, plain_butterfly, splat};
use super::memory::{Line, OnCacheLine, fetch};
use super::paired_rows::Places;
use super::passes::load_quad;
use super::plan::LinePlan;
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

/// Innermost forward pass, kernels, innermost inverse pass, on some places of both parts of all columns in free space.
pub struct MultiplyParts<'a, L: Lanes, const F: usize> {
    pub plan: &'a LinePlan<L::Number>,
    pub mirrored: bool,
    pub inputs: usize,
    pub kernels: &'a [L::Reals],
    pub table_count: usize,
    pub terms: &'a [Vec<MirroredTerm<L::Number>>],
    pub places: Range<usize>,
    pub lines: &'a mut [Line<L>],
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
            let turns = self.mirrored.then_some(turns);
            for field in 0..self.inputs.min(F) {
                let mut parts = [[Complex::zero(lanes); 4]; 2];
                for part in 0..2 {
                    let quad = &lines[(2 * field + part) * n + place..][..4];
                    parts[part] = butterfly(lanes, load_quad(lanes, quad), &weights);
                }
                slots.0[field] = slots_of(lanes, parts, turns);
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
                    if let Some(turns) = turns {
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

/// The slots of both parts of four places, turned where the columns are mirrored.
#[inline(always)]
pub fn slots_of<L: Lanes>(
    lanes: L,
    [mut d, mut e]: [[Complex<L>; 4]; 2],
    turns: Option<&[[L::Number; 2]]>,
) -> [[L::Reals; 4]; 4] {
    let zero = lanes.zero();
    let mut slots = [[zero; 4]; 4];
    for m in 0..4 {
        if let Some(turns) = turns {
            let [cosine, sine] = [lanes.splat(turns[m][0]), lanes.splat(turns[m][1])];
            d[m] = d[m].rotated(lanes, cosine, sine);
            e[m] = e[m].rotated(lanes, cosine, sine);
        }
        slots[0][m] = lanes.add(d[m].re, e[m].im);
        slots[1][m] = lanes.sub(e[m].re, d[m].im);
        slots[2][m] = lanes.sub(zero, lanes.add(d[m].im, e[m].re));
        slots[3][m] = lanes.sub(e[m].im, d[m].re);
    }
    slots
}

/// Innermost forward pass, kernels, innermost inverse pass on whole columns of a product that repeats, pair by pair of
/// opposite frequencies.
pub struct MultiplyPairs<'a, L: Lanes, const F: usize> {
    pub plan: &'a LinePlan<L::Number>,
    pub mirrored: bool,
    pub inputs: usize,
    pub kernels: &'a [L::Reals],
    pub table_count: usize,
    pub terms: &'a [Vec<MirroredTerm<L::Number>>],
    pub places: &'a [Places],
    pub lines: &'a mut [Line<L>],
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
