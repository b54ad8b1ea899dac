//! Kernels in the order of the engine: the passes that make them.

use super::butterfly::{Complex, butterfly, splat};
use super::memory::{Line, as_lines, as_lines_mut, as_vectors, as_vectors_mut};
use super::passes::{forward_middle, load_quad, parts, with_radix};
use super::plan::LinePlan;
use super::row_groups::Layout;
use super::simd::{Lanes, Task};

/// Keeps the real parts of a group of transformed rows, or the imaginary ones: of a kernel even or odd along `y`.
pub struct KeptPart<'a, N> {
    pub spectrum: &'a [N],
    /// 0 for the real part.
    pub part: usize,
    /// Whose end may stay as it is.
    pub to: &'a mut [N],
}

impl<L: Lanes> Task<L> for KeptPart<'_, L::Number> {
    #[inline(always)]
    fn run(self, _lanes: L) {
        for (to, line) in as_vectors_mut::<L>(self.to).iter_mut().zip(as_lines::<L>(self.spectrum)) {
            *to = line[self.part];
        }
    }
}

/// Transform along `x` of one strip of a kernel whose rows have been transformed already.
pub struct KernelColumn<'a, N> {
    pub layout: &'a Layout,
    pub plan: &'a LinePlan<N>,
    /// From the strip on, `[group][strip][row of the group]`.
    pub rows: &'a [N],
    /// Numbers from one row group to the next.
    pub stride: usize,
    /// 0 where the real part is kept, of a kernel even along `x`; else 1.
    pub part: usize,
    /// `[place]`
    pub values: &'a mut [N],
    pub scratch: &'a mut [N],
}

impl<L: Lanes> Task<L> for KernelColumn<'_, L::Number> {
    #[inline(always)]
    fn run(self, lanes: L) {
        let Self { layout, plan, rows, stride, part, values, scratch } = self;
        let lines = &mut as_lines_mut::<L>(scratch)[..plan.length()];
        let (rows, stride) = (as_vectors::<L>(rows), stride / L::WIDTH);
        let read = layout.rows_read;
        with_radix!(plan.outermost(), R => outermost::<L, R>(lanes, plan, rows, stride, read, lines));
        for (block, lines) in lines.chunks_exact_mut(plan.inner_length()).enumerate() {
            forward_middle(lanes, plan, block, lines);
        }
        let quads = lines.chunks_exact(4).zip(plan.innermost_forward());
        for ((lines, weights), values) in quads.zip(as_vectors_mut::<L>(values).chunks_exact_mut(4)) {
            let x = load_quad(lanes, lines);
            let y = butterfly(lanes, x, &splat(lanes, weights));
            for m in 0..4 {
                values[m] = [y[m].re, y[m].im][part];
            }
        }
    }
}

#[inline(always)]
fn outermost<L: Lanes, const R: usize>(
    lanes: L,
    plan: &LinePlan<L::Number>,
    rows: &[L::Reals],
    stride: usize,
    rows_read: usize,
    lines: &mut [Line<L>],
) {
    let places = plan.inner_length();
    let weights = splat(lanes, &plan.forward(0)[0]);
    let parts = parts::<L, R>(lines, places);
    for j in 0..places {
        let mut x = [Complex::zero(lanes); R];
        for m in 0..R {
            let row = m * places + j;
            if m * places < rows_read {
                x[m].re = rows[row / L::WIDTH * stride + row % L::WIDTH];
            }
        }
        let y = butterfly(lanes, x, &weights);
        for m in 0..R {
            y[m].store(&mut parts[m][j]);
        }
    }
}
