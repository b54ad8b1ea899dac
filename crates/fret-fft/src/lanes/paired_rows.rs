//! Row stages of the periodic product: two real rows at a time as the real and imaginary part of one complex row.
//!
//! Of the transform `Z` of `a + i b` the transforms of the two are `2 A_k = Z_k + conj(Z_-k)` and
//! `2 B_k = -i (Z_k - conj(Z_-k))`, wanted for `k = 0..=n/2` only; the factors 2 go into the kernels.
//! Strips hold the wavenumbers in natural order.

use super::butterfly::{Complex, butterfly, plain_butterfly, splat};
use super::memory::{Line, as_lines_mut, as_vectors_mut};
use super::passes::{forward_middle, inverse_middle, load_quad, parts, with_radix};
use super::plan::LinePlan;
use super::row_groups::{Layout, RowGroup, RowGroups, gather_rows, rows_of_strip, scatter_rows};
use super::rows::{Side, mirrored_point};
use super::simd::{Lanes, Number, Task};

/// Where the frequencies `k` and `-k` come out of the transform of a pair of rows.
#[derive(Debug, Clone, Copy)]
pub struct Places {
    pub direct: usize,
    pub mirrored: usize,
}

/// Places of the frequencies `0..=n/2`, filled up to `count` with the place of a spare line behind the transform.
pub fn places(order: &[usize], count: usize) -> Vec<Places> {
    let n = order.len();
    let mut positions = vec![0; n];
    for (position, &frequency) in order.iter().enumerate() {
        positions[frequency] = position;
    }
    let of_frequency = |k: usize| Places { direct: positions[k], mirrored: positions[(n - k) % n] };
    let spare = Places { direct: n, mirrored: n };
    (0..count).map(|k| if k <= n / 2 { of_frequency(k) } else { spare }).collect()
}

/// Rows of a field to pairs of groups of the spectrum, from pair `first` on.
pub struct PairsForward<'a, 's, N> {
    pub layout: &'a Layout,
    pub plan: &'a LinePlan<N>,
    pub side: Side,
    pub places: &'a [Places],
    pub field: &'a [N],
    pub first: usize,
    pub groups: RowGroups<'s, N>,
    pub scratch: &'a mut [N],
}

impl<L: Lanes> Task<L> for PairsForward<'_, '_, L::Number> {
    #[inline(always)]
    fn run(self, lanes: L) {
        let Self { layout, plan, side, places, field, first, mut groups, scratch } = self;
        let [nx, ny] = layout.shape;
        let (staging_a, scratch) = scratch.split_at_mut(plan.padded_length() * L::WIDTH);
        let (staging_b, scratch) = scratch.split_at_mut(plan.padded_length() * L::WIDTH);
        let [staging_a, staging_b] = [as_vectors_mut::<L>(staging_a), as_vectors_mut::<L>(staging_b)];
        let lines = &mut as_lines_mut::<L>(scratch)[..=ny];
        let mut groups = groups.each();
        for pair in first.. {
            let (Some(group_a), Some(group_b)) = (groups.next(), groups.next()) else { break };
            let begin = (2 * pair * L::WIDTH).min(nx);
            let middle = (begin + L::WIDTH).min(nx);
            let end = (middle + L::WIDTH).min(nx);
            gather_rows(lanes, &field[begin * ny..middle * ny], ny, staging_a);
            gather_rows(lanes, &field[middle * ny..end * ny], ny, staging_b);
            with_radix!(plan.outermost(), R => outermost_forward::<L, R>(lanes, plan, side, [staging_a, staging_b], lines));
            for (block, lines) in lines[..ny].chunks_exact_mut(plan.inner_length()).enumerate() {
                forward_middle(lanes, plan, block, lines);
            }
            lanes.enter(Separate::<L> { plan, side, places, lines, group_a, group_b });
        }
    }
}

/// Innermost forward pass, and the spectra of both rows from that of the pair.
struct Separate<'a, 's, L: Lanes> {
    plan: &'a LinePlan<L::Number>,
    side: Side,
    places: &'a [Places],
    /// One line more than the transform has.
    lines: &'a mut [Line<L>],
    group_a: RowGroup<'s, L::Number>,
    group_b: RowGroup<'s, L::Number>,
}

impl<L: Lanes> Task<L> for Separate<'_, '_, L> {
    #[inline(always)]
    fn run(self, lanes: L) {
        let lines = self.lines;
        for (lines, weights) in lines.chunks_exact_mut(4).zip(self.plan.innermost_forward()) {
            let y = butterfly(lanes, load_quad(lanes, lines), &splat(lanes, weights));
            for m in 0..4 {
                y[m].store(&mut lines[m]);
            }
        }
        let (mut group_a, mut group_b) = (self.group_a, self.group_b);
        let groups = group_a.parts::<L>().zip(group_b.parts::<L>());
        let mut a = [lanes.block(lanes.zero()); 2];
        let mut b = [lanes.block(lanes.zero()); 2];
        for (places, (group_a, group_b)) in self.places.chunks_exact(L::WIDTH).zip(groups) {
            for lane in 0..L::WIDTH {
                let z = lines[places[lane].direct];
                let mirrored = lines[places[lane].mirrored];
                a[0][lane] = lanes.add(z[0], mirrored[0]);
                a[1][lane] = lanes.sub(z[1], mirrored[1]);
                b[0][lane] = lanes.add(z[1], mirrored[1]);
                b[1][lane] = lanes.sub(mirrored[0], z[0]);
                if self.side.is_mirrored() {
                    let turn = turn_at(lanes, self.plan, places[lane], 1.0);
                    turned(lanes, &mut a, lane, turn);
                    turned(lanes, &mut b, lane, turn);
                }
            }
            lanes.transpose(&mut a[0]);
            lanes.transpose(&mut a[1]);
            lanes.transpose(&mut b[0]);
            lanes.transpose(&mut b[1]);
            for row in 0..L::WIDTH {
                group_a[row] = [a[0][row], a[1][row]];
                group_b[row] = [b[0][row], b[1][row]];
            }
        }
    }
}

/// Rows of an output from the strips of its spectrum, from pair `first` of row groups on.
pub struct PairsInverse<'a, N> {
    pub layout: &'a Layout,
    pub plan: &'a LinePlan<N>,
    pub side: Side,
    pub places: &'a [Places],
    /// Spectra from this output on.
    pub spectrum: &'a [N],
    pub first: usize,
    pub rows: &'a mut [N],
    pub scratch: &'a mut [N],
}

impl<L: Lanes> Task<L> for PairsInverse<'_, L::Number> {
    #[inline(always)]
    fn run(self, lanes: L) {
        let Self { layout, plan, side, places, spectrum, first, rows, scratch } = self;
        let ny = layout.shape[1];
        let (staging_a, scratch) = scratch.split_at_mut(plan.padded_length() * L::WIDTH);
        let (staging_b, scratch) = scratch.split_at_mut(plan.padded_length() * L::WIDTH);
        let [staging_a, staging_b] = [as_vectors_mut::<L>(staging_a), as_vectors_mut::<L>(staging_b)];
        let lines = &mut as_lines_mut::<L>(scratch)[..=ny];
        for (pair, rows) in (first..).zip(rows.chunks_mut(2 * L::WIDTH * ny)) {
            lanes.enter(Join::<L> { layout, plan, side, spectrum, places, pair, lines });
            for lines in lines[..ny].chunks_exact_mut(plan.inner_length()) {
                inverse_middle(lanes, plan, lines);
            }
            with_radix!(plan.outermost(), R => outermost_inverse::<L, R>(lanes, plan, side, lines, [staging_a, staging_b]));
            let (rows_a, rows_b) = rows.split_at_mut(rows.len().min(L::WIDTH * ny));
            scatter_rows(lanes, staging_a, rows_a, ny);
            scatter_rows(lanes, staging_b, rows_b, ny);
        }
    }
}

/// The spectrum of a pair of rows from those of both, with real and imaginary part exchanged, and innermost inverse pass.
struct Join<'a, L: Lanes> {
    layout: &'a Layout,
    plan: &'a LinePlan<L::Number>,
    side: Side,
    spectrum: &'a [L::Number],
    places: &'a [Places],
    pair: usize,
    /// One line more than the transform has.
    lines: &'a mut [Line<L>],
}

impl<L: Lanes> Task<L> for Join<'_, L> {
    #[inline(always)]
    fn run(self, lanes: L) {
        let Self { layout, plan, side, spectrum, places, pair, lines } = self;
        let mut a = [lanes.block(lanes.zero()); 2];
        let mut b = [lanes.block(lanes.zero()); 2];
        for (strip, places) in places.chunks_exact(L::WIDTH).enumerate() {
            let [a_re, a_im] = &mut a;
            rows_of_strip(lanes, layout, spectrum, strip, 2 * pair, a_re, a_im);
            let [b_re, b_im] = &mut b;
            rows_of_strip(lanes, layout, spectrum, strip, 2 * pair + 1, b_re, b_im);
            lanes.transpose(&mut a[0]);
            lanes.transpose(&mut a[1]);
            lanes.transpose(&mut b[0]);
            lanes.transpose(&mut b[1]);
            for lane in 0..L::WIDTH {
                if side.is_mirrored() {
                    let turn = turn_at(lanes, plan, places[lane], -1.0);
                    turned(lanes, &mut a, lane, turn);
                    turned(lanes, &mut b, lane, turn);
                }
                // Mirrored first: at the ends of the spectrum both are one place.
                lines[places[lane].mirrored] =
                    [lanes.sub(b[0][lane], a[1][lane]), lanes.add(a[0][lane], b[1][lane])];
                lines[places[lane].direct] =
                    [lanes.add(a[1][lane], b[0][lane]), lanes.sub(a[0][lane], b[1][lane])];
            }
        }
        for lines in lines.chunks_exact_mut(4) {
            let y = plain_butterfly(lanes, load_quad(lanes, lines));
            for m in 0..4 {
                y[m].store(&mut lines[m]);
            }
        }
    }
}

/// Phase of a mirrored line at the frequency of some places, forward or (`sign = -1`) back.
#[inline(always)]
fn turn_at<L: Lanes>(lanes: L, plan: &LinePlan<L::Number>, places: Places, sign: f64) -> [L::Reals; 2] {
    let turn = plan.mirror_turns().get(places.direct);
    turn.map_or([lanes.constant(1.0), lanes.zero()], |[cosine, sine]| {
        [lanes.splat(*cosine), lanes.mul(lanes.constant(sign), lanes.splat(*sine))]
    })
}

/// Turns the complex number of one lane index.
#[inline(always)]
fn turned<L: Lanes>(lanes: L, numbers: &mut [L::Block; 2], index: usize, [cosine, sine]: [L::Reals; 2]) {
    let number = Complex::<L> { re: numbers[0][index], im: numbers[1][index] };
    let number = number.rotated(lanes, cosine, sine);
    numbers[0][index] = number.re;
    numbers[1][index] = number.im;
}

/// The point of a row at a place of its transform, and its factor.
#[inline(always)]
fn point_at<N: Number>(plan: &LinePlan<N>, side: Side, place: usize) -> (usize, f64) {
    if !side.is_mirrored() {
        return (place, 1.0);
    }
    let (point, backward) = mirrored_point(place, plan.length());
    (point, if backward { side.backward_sign() } else { 1.0 })
}

#[inline(always)]
fn outermost_forward<L: Lanes, const R: usize>(
    lanes: L,
    plan: &LinePlan<L::Number>,
    side: Side,
    [real, imaginary]: [&[L::Reals]; 2],
    lines: &mut [Line<L>],
) {
    let places = plan.inner_length();
    let weights = splat(lanes, &plan.forward(0)[0]);
    let parts = parts::<L, R>(lines, places);
    for j in 0..places {
        let mut x = [Complex::zero(lanes); R];
        for m in 0..R {
            let (point, sign) = point_at(plan, side, m * places + j);
            x[m] = Complex { re: real[point], im: imaginary[point] };
            if sign < 0.0 {
                x[m] = x[m].negated(lanes);
            }
        }
        let y = butterfly(lanes, x, &weights);
        for m in 0..R {
            y[m].store(&mut parts[m][j]);
        }
    }
}

#[inline(always)]
fn outermost_inverse<L: Lanes, const R: usize>(
    lanes: L,
    plan: &LinePlan<L::Number>,
    side: Side,
    lines: &mut [Line<L>],
    [real, imaginary]: [&mut [L::Reals]; 2],
) {
    let places = plan.inner_length();
    let parts = parts::<L, R>(lines, places);
    for (j, weights) in plan.inverse(0).iter().enumerate() {
        let mut x = [Complex::zero(lanes); R];
        for m in 0..R {
            x[m] = Complex::load(&parts[m][j]);
        }
        let y = butterfly(lanes, x, &splat(lanes, weights));
        for m in 0..R {
            let (point, sign) = point_at(plan, side, m * places + j);
            let y = if sign < 0.0 { y[m].negated(lanes) } else { y[m] };
            real[point] = y.im;
            imaginary[point] = y.re;
        }
    }
}
