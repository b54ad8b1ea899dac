//! Row stages of the free-space product: real rows to half-shifted frequencies and back.
//!
//! A group of as many rows as there are lanes is turned into vectors, transformed, and turned back into strips: lines whose
//! lanes are neighbouring frequencies of one row.

use super::butterfly::{Complex, butterfly, plain_butterfly, splat};
use super::memory::{Line, as_lines_mut, as_vectors_mut};
use super::passes::{forward_middle, inverse_middle, load_quad, parts, with_radix};
use super::plan::LinePlan;
use super::row_groups::{Layout, RowGroup, RowGroups, gather_rows, rows_of_strip, scatter_rows};
use super::simd::{Lanes, Task};

/// How a line lies to a mirror before its first point.
///
/// Of a line `x_j`, `j = 0..n`, that goes on behind the mirror, even or odd, the transform is real: the cosines or sines at
/// the frequencies `w_k` and at `pi - w_k`. One complex transform of `n` points yields both, as real and minus imaginary part
/// (the other way round for odd lines), of `x_0, x_2, x_4 ...` as real and `... x_5, x_3, x_1` as imaginary numbers (with
/// minus for odd lines). For whole frequencies the latter are real as well.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// No mirror.
    Plain,
    /// Goes on behind the mirror as it is.
    Even,
    /// Goes on with the other sign.
    Odd,
}

impl Side {
    /// Whether there is a mirror.
    pub fn is_mirrored(self) -> bool {
        self != Self::Plain
    }

    /// Factor of the points taken backwards.
    pub fn backward_sign(self) -> f64 {
        if self == Self::Odd { -1.0 } else { 1.0 }
    }
}

/// The point of a mirrored line of `length` points that is taken at `place`, and whether backwards.
#[inline(always)]
pub fn mirrored_point(place: usize, length: usize) -> (usize, bool) {
    if 2 * place < length { (2 * place, false) } else { (2 * (length - place) - 1, true) }
}

/// Rows of a field to groups of the spectrum, from group `first` on.
pub struct RowsForward<'a, 's, N> {
    pub layout: &'a Layout,
    pub plan: &'a LinePlan<N>,
    pub side: Side,
    pub field: &'a [N],
    pub first: usize,
    pub groups: RowGroups<'s, N>,
    pub scratch: &'a mut [N],
}

impl<L: Lanes> Task<L> for RowsForward<'_, '_, L::Number> {
    #[inline(always)]
    fn run(self, lanes: L) {
        let Self { layout, plan, side, field, first, mut groups, scratch } = self;
        let [nx, ny] = layout.shape;
        let (staging, scratch) = scratch.split_at_mut(plan.padded_length() * L::WIDTH);
        let staging = as_vectors_mut::<L>(staging);
        let lines = &mut as_lines_mut::<L>(scratch)[..plan.padded_length()];
        // Frequencies that fill the last strip up: what was left there would go into the spectra, and grow from product to product.
        lines[plan.length()..].fill([lanes.zero(); 2]);
        for (group, mut to) in (first..).zip(groups.each()) {
            let rows = nx.saturating_sub(group * L::WIDTH).min(L::WIDTH);
            if rows == 0 {
                if group * L::WIDTH < layout.rows_read {
                    to.clear();
                }
                continue;
            }
            gather_rows(lanes, &field[group * L::WIDTH * ny..][..rows * ny], ny, staging);
            with_radix!(plan.outermost(), R => outermost_forward::<L, R>(lanes, plan, side, staging, lines));
            for (block, lines) in lines[..plan.length()].chunks_exact_mut(plan.inner_length()).enumerate() {
                forward_middle(lanes, plan, block, lines);
            }
            lanes.enter(InnermostForward::<L> { plan, side, lines, to });
        }
    }
}

/// Innermost forward pass, and the turn from vectors across rows to vectors across frequencies.
struct InnermostForward<'a, 's, L: Lanes> {
    plan: &'a LinePlan<L::Number>,
    side: Side,
    lines: &'a [Line<L>],
    to: RowGroup<'s, L::Number>,
}

impl<L: Lanes> Task<L> for InnermostForward<'_, '_, L> {
    #[inline(always)]
    fn run(self, lanes: L) {
        let mut to = self.to;
        let weights = self.plan.innermost_forward().chunks_exact(L::WIDTH / 4);
        let turns = self.plan.mirror_turns().chunks_exact(L::WIDTH);
        let strips = self.lines.chunks_exact(L::WIDTH).zip(weights).zip(turns);
        for (((lines, weights), turns), strip) in strips.zip(to.parts::<L>()) {
            let mut re = lanes.block(lanes.zero());
            let mut im = lanes.block(lanes.zero());
            for quad in 0..L::WIDTH / 4 {
                let x = load_quad(lanes, &lines[4 * quad..4 * quad + 4]);
                let y = butterfly(lanes, x, &splat(lanes, &weights[quad]));
                for m in 0..4 {
                    let mut y = y[m];
                    if self.side.is_mirrored() {
                        let [cosine, sine] = turns[4 * quad + m];
                        y = y.rotated(lanes, lanes.splat(cosine), lanes.splat(sine));
                    }
                    re[4 * quad + m] = y.re;
                    im[4 * quad + m] = y.im;
                }
            }
            lanes.transpose(&mut re);
            lanes.transpose(&mut im);
            for row in 0..L::WIDTH {
                strip[row] = [re[row], im[row]];
            }
        }
    }
}

/// Rows of an output from the strips of its spectrum, from row group `first` on.
pub struct RowsInverse<'a, N> {
    pub layout: &'a Layout,
    pub plan: &'a LinePlan<N>,
    pub side: Side,
    /// Spectra from this output on.
    pub spectrum: &'a [N],
    pub first: usize,
    pub rows: &'a mut [N],
    pub scratch: &'a mut [N],
}

impl<L: Lanes> Task<L> for RowsInverse<'_, L::Number> {
    #[inline(always)]
    fn run(self, lanes: L) {
        let Self { layout, plan, side, spectrum, first, rows, scratch } = self;
        let ny = layout.shape[1];
        let (staging, scratch) = scratch.split_at_mut(plan.padded_length() * L::WIDTH);
        let staging = as_vectors_mut::<L>(staging);
        let lines = &mut as_lines_mut::<L>(scratch)[..plan.padded_length()];
        for (group, rows) in (first..).zip(rows.chunks_mut(L::WIDTH * ny)) {
            lanes.enter(InnermostInverse::<L> { layout, plan, side, spectrum, group, lines });
            for lines in lines[..plan.length()].chunks_exact_mut(plan.inner_length()) {
                inverse_middle(lanes, plan, lines);
            }
            with_radix!(plan.outermost(), R => outermost_inverse::<L, R>(lanes, plan, side, lines, staging));
            scatter_rows(lanes, staging, rows, ny);
        }
    }
}

/// The turn from vectors across frequencies to vectors across rows, and innermost inverse pass.
struct InnermostInverse<'a, L: Lanes> {
    layout: &'a Layout,
    plan: &'a LinePlan<L::Number>,
    side: Side,
    spectrum: &'a [L::Number],
    group: usize,
    lines: &'a mut [Line<L>],
}

impl<L: Lanes> Task<L> for InnermostInverse<'_, L> {
    #[inline(always)]
    fn run(self, lanes: L) {
        let Self { layout, plan, side, spectrum, group, lines } = self;
        for (strip, lines) in lines.chunks_exact_mut(L::WIDTH).take(layout.strips).enumerate() {
            let mut re = lanes.block(lanes.zero());
            let mut im = lanes.block(lanes.zero());
            rows_of_strip(lanes, layout, spectrum, strip, group, &mut re, &mut im);
            lanes.transpose(&mut re);
            lanes.transpose(&mut im);
            for quad in 0..L::WIDTH / 4 {
                let mut x = [Complex::<L>::zero(lanes); 4];
                for m in 0..4 {
                    x[m] = Complex { re: im[4 * quad + m], im: re[4 * quad + m] };
                    if side.is_mirrored() {
                        // Forward on the swapped number is backward on the number.
                        let [cosine, sine] = plan.mirror_turns()[strip * L::WIDTH + 4 * quad + m];
                        x[m] = x[m].rotated(lanes, lanes.splat(cosine), lanes.splat(sine));
                    }
                }
                let y = plain_butterfly(lanes, x);
                for m in 0..4 {
                    y[m].store(&mut lines[4 * quad + m]);
                }
            }
        }
    }
}

/// Outermost forward pass on real lines.
#[inline(always)]
fn outermost_forward<L: Lanes, const R: usize>(
    lanes: L,
    plan: &LinePlan<L::Number>,
    side: Side,
    staging: &[L::Reals],
    lines: &mut [Line<L>],
) {
    let places = plan.inner_length();
    let weights = splat(lanes, &plan.forward(0)[0]);
    let sign = lanes.constant(side.backward_sign());
    let parts = parts::<L, R>(&mut lines[..R * places], places);
    for j in 0..places {
        let mut x = [Complex::zero(lanes); R];
        for m in 0..R {
            let place = m * places + j;
            if side.is_mirrored() {
                let (point, backward) = mirrored_point(place, plan.length());
                if backward {
                    x[m].im = lanes.mul(sign, staging[point]);
                } else {
                    x[m].re = staging[point];
                }
            } else {
                x[m].re = staging[place];
            }
        }
        let y = butterfly(lanes, x, &weights);
        for m in 0..R {
            y[m].store(&mut parts[m][j]);
        }
    }
}

/// Outermost inverse pass on swapped numbers, of which only the real part of the result is wanted, or, of points that a
/// mirrored line takes backwards, the imaginary part.
#[inline(always)]
fn outermost_inverse<L: Lanes, const R: usize>(
    lanes: L,
    plan: &LinePlan<L::Number>,
    side: Side,
    lines: &mut [Line<L>],
    staging: &mut [L::Reals],
) {
    let places = plan.inner_length();
    let turns = plan.output_turns();
    let sign = lanes.constant(side.backward_sign());
    let parts = parts::<L, R>(&mut lines[..R * places], places);
    for (j, (weights, [cosine, sine])) in plan.inverse(0).iter().zip(plan.first_turns()).enumerate() {
        let mut x = [Complex::zero(lanes); R];
        for m in 0..R {
            x[m] = Complex::load(&parts[m][j]);
        }
        x[0] = x[0].rotated(lanes, lanes.splat(*cosine), lanes.splat(*sine));
        let y = butterfly(lanes, x, &splat(lanes, weights));
        for m in 0..R {
            let [cosine, sine] = [lanes.splat(turns[m][0]), lanes.splat(turns[m][1])];
            let place = m * places + j;
            let (point, backward) =
                if side.is_mirrored() { mirrored_point(place, plan.length()) } else { (place, false) };
            staging[point] = if backward {
                lanes.mul(sign, lanes.mul_add(sine, y[m].im, lanes.mul(cosine, y[m].re)))
            } else if m == 0 {
                y[m].im
            } else {
                lanes.negate_mul_add(sine, y[m].re, lanes.mul(cosine, y[m].im))
            };
        }
    }
}
