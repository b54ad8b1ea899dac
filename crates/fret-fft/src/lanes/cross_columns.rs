//! Column stage of cross spectra in free space: forward transforms of the columns of what a product takes and of fields beside what it makes, and
//! the sums of their products, place by place, in the order of the kernels.
//!
//! The way back of a product is the transpose of its way there, up to the factor that its kernels carry. So the scalar product of a field with
//! what a product makes is that of the kernels with these sums.

use super::butterfly::{Complex, butterfly, splat};
use super::columns::{OutermostForward, Term};
use super::memory::{Line, as_lines, as_lines_mut, as_vectors_mut};
use super::mirrored_columns::MirroredForward;
use super::mirrored_kernels::slots_of;
use super::passes::{forward_middle, load_quad, with_radix};
use super::plan::LinePlan;
use super::reflection::Reflection;
use super::row_groups::Layout;
use super::simd::{Lanes, Task};

/// Strips of the spectra of at most `F` fields on either side.
pub struct CrossColumns<'a, N, const F: usize> {
    pub layout: &'a Layout,
    pub plan: &'a LinePlan<N>,
    /// How many fields the product takes, and how many it makes.
    pub counts: [usize; 2],
    /// Spectra of both.
    pub spectra: [&'a [N]; 2],
    /// Terms of each output, without mirrors.
    pub terms: &'a [Vec<Term<N>>],
    /// What mirrors change.
    pub reflection: Option<&'a Reflection<N>>,
    /// Kernels, or their tables with mirrors.
    pub table_count: usize,
    /// `[strip][group of four places][table][place of the group]`
    pub sums: &'a mut [N],
    pub scratch: &'a mut [N],
}

impl<L: Lanes, const F: usize> Task<L> for CrossColumns<'_, L::Number, F> {
    #[inline(always)]
    fn run(self, lanes: L) {
        let Self { layout, plan, counts, spectra, terms, reflection, table_count, .. } = self;
        let n = plan.length();
        let inner = plan.inner_length();
        // `[side][field][part][place]`
        let lines = &mut as_lines_mut::<L>(self.scratch)[..4 * F * n];
        let strips = self.sums.chunks_exact_mut(n * table_count * L::WIDTH);
        for (strip, sums) in strips.enumerate() {
            for (side, lines) in lines.chunks_exact_mut(2 * F * n).enumerate() {
                let fields = spectra[side][strip * layout.strip_stride..].chunks_exact(layout.field_len());
                let columns = lines.chunks_exact_mut(2 * n).take(counts[side]);
                for (index, (field, lines)) in fields.zip(columns).enumerate() {
                    let spectrum = as_lines::<L>(field);
                    let sides = reflection.map(|reflection| reflection.columns);
                    let lie = sides.map(|sides| [sides.inputs, sides.outputs][side][index]);
                    with_radix!(plan.outermost(), R => {
                        if let Some(side) = lie.filter(|side| side.is_mirrored()) {
                            let lines = &mut *lines;
                            lanes.enter(MirroredForward::<L, R, 2> { plan, side, spectrum, lines });
                        } else {
                            let (rows, lines) = (layout.rows_read, &mut *lines);
                            lanes.enter(OutermostForward::<L, R, 2> { plan, spectrum, rows, lines });
                        }
                    });
                    for column in lines.chunks_exact_mut(n) {
                        for (block, lines) in column.chunks_exact_mut(inner).enumerate() {
                            forward_middle(lanes, plan, block, lines);
                        }
                    }
                }
            }
            let sums = as_vectors_mut::<L>(sums);
            let lines = &*lines;
            match reflection {
                None => lanes.enter(CrossParts::<L, F> { plan, counts, table_count, terms, lines, sums }),
                Some(reflection) => {
                    lanes.enter(CrossSlots::<L, F> { plan, counts, table_count, reflection, lines, sums });
                }
            }
        }
    }
}

/// The innermost pass on four places of a part of a column.
#[inline(always)]
fn innermost<L: Lanes, const F: usize>(
    lanes: L,
    lines: &[Line<L>],
    n: usize,
    [side, field, part, place]: [usize; 4],
    weights: &[L::Reals; 8],
) -> [Complex<L>; 4] {
    butterfly(lanes, load_quad(lanes, &lines[((side * F + field) * 2 + part) * n + place..][..4]), weights)
}

/// Innermost pass and sums, without mirrors.
struct CrossParts<'a, L: Lanes, const F: usize> {
    plan: &'a LinePlan<L::Number>,
    counts: [usize; 2],
    table_count: usize,
    terms: &'a [Vec<Term<L::Number>>],
    lines: &'a [Line<L>],
    sums: &'a mut [L::Reals],
}

impl<L: Lanes, const F: usize> Task<L> for CrossParts<'_, L, F> {
    #[inline(always)]
    fn run(self, lanes: L) {
        let Self { plan, counts, table_count, terms, lines, sums } = self;
        let n = plan.length();
        let mut values = [[[[Complex::zero(lanes); 4]; 2]; F]; 2];
        for (group, sums) in sums.chunks_exact_mut(4 * table_count).enumerate() {
            let weights = splat(lanes, &plan.innermost_forward()[group]);
            for side in 0..2 {
                for field in 0..counts[side].min(F) {
                    for part in 0..2 {
                        let at = [side, field, part, 4 * group];
                        values[side][field][part] = innermost::<L, F>(lanes, lines, n, at, &weights);
                    }
                }
            }
            let [from, to] = &values;
            for (to, terms) in to.iter().zip(terms) {
                for term in terms {
                    let from = &from[term.input];
                    for part in 0..2 {
                        let factor = lanes.splat(term.factors[part]);
                        for m in 0..4 {
                            let (from, to) = (from[part][m], to[part][m]);
                            let product = if term.imaginary {
                                lanes.sub(lanes.mul(to.im, from.re), lanes.mul(to.re, from.im))
                            } else {
                                lanes.mul_add(to.re, from.re, lanes.mul(to.im, from.im))
                            };
                            let sum = &mut sums[4 * term.kernel + m];
                            *sum = lanes.mul_add(factor, product, *sum);
                        }
                    }
                }
            }
        }
    }
}

/// Innermost pass and sums, with mirrors.
struct CrossSlots<'a, L: Lanes, const F: usize> {
    plan: &'a LinePlan<L::Number>,
    counts: [usize; 2],
    table_count: usize,
    reflection: &'a Reflection<L::Number>,
    lines: &'a [Line<L>],
    sums: &'a mut [L::Reals],
}

impl<L: Lanes, const F: usize> Task<L> for CrossSlots<'_, L, F> {
    #[inline(always)]
    fn run(self, lanes: L) {
        let Self { plan, counts, table_count, reflection, lines, sums } = self;
        let n = plan.length();
        let mirrored = reflection.columns.inputs[0].is_mirrored();
        let mut slots = [[[[lanes.zero(); 4]; 4]; F]; 2];
        for (group, sums) in sums.chunks_exact_mut(4 * table_count).enumerate() {
            let weights = splat(lanes, &plan.innermost_forward()[group]);
            let turns = &plan.mirror_turns()[4 * group..][..4];
            for side in 0..2 {
                for field in 0..counts[side].min(F) {
                    let mut parts = [[Complex::zero(lanes); 4]; 2];
                    for part in 0..2 {
                        let at = [side, field, part, 4 * group];
                        parts[part] = innermost::<L, F>(lanes, lines, n, at, &weights);
                    }
                    slots[side][field] = slots_of(lanes, parts, mirrored.then_some(turns));
                }
            }
            let [from, to] = &slots;
            for (to, terms) in to.iter().zip(&reflection.terms) {
                for term in terms {
                    for (slot, of) in term.slots.iter().enumerate() {
                        let factor = lanes.splat(of.factor);
                        for m in 0..4 {
                            let product = lanes.mul(to[slot][m], from[term.input][of.source][m]);
                            let sum = &mut sums[4 * of.table + m];
                            *sum = lanes.mul_add(factor, product, *sum);
                        }
                    }
                }
            }
        }
    }
}
