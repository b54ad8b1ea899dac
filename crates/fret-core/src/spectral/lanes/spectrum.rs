//! Kernels in the order of the engine: `[strip][group of four places of the column][kernel][place of the group][lane]`.

use super::butterfly::{Complex, butterfly, splat};
use super::memory::{Line, as_lines, as_lines_mut, as_vectors_mut};
use super::passes::{forward_middle, load_quad, parts, with_radix};
use super::plan::LinePlan;
use super::rows::Layout;
use super::simd::{Lanes, Task};

/// Transforms along `x` of one kernel whose rows have been transformed already, all strips.
pub struct KernelColumns<'a, N> {
    pub layout: &'a Layout,
    pub plan: &'a LinePlan<N>,
    /// `[group][strip][row of the group]`
    pub rows: &'a [N],
    /// Whether the kernel is odd along `[x, y]`: then the imaginary part is kept, else the real part.
    pub odd: [bool; 2],
    pub kernel: usize,
    pub kernel_count: usize,
    pub kernels: &'a mut [N],
    pub scratch: &'a mut [N],
}

impl<L: Lanes> Task<L> for KernelColumns<'_, L::Number> {
    #[inline(always)]
    fn run(self, lanes: L) {
        let Self { layout, plan, rows, odd, kernel, kernel_count, kernels, scratch } = self;
        let n = plan.length();
        let lines = &mut as_lines_mut::<L>(scratch)[..n];
        let rows = as_lines::<L>(rows);
        let kept = odd.map(usize::from);
        for (strip, kernels) in as_vectors_mut::<L>(kernels).chunks_exact_mut(n * kernel_count).enumerate() {
            let rows = &rows[strip * L::WIDTH..];
            with_radix!(plan.outermost(), R => outermost::<L, R>(lanes, layout, plan, rows, kept[1], lines));
            for (block, lines) in lines.chunks_exact_mut(plan.inner_length()).enumerate() {
                forward_middle(lanes, plan, block, lines);
            }
            let quads = lines.chunks_exact(4).zip(plan.innermost_forward());
            for ((lines, weights), kernels) in quads.zip(kernels.chunks_exact_mut(4 * kernel_count)) {
                let x = load_quad(lanes, lines);
                let y = butterfly(lanes, x, &splat(lanes, weights));
                for m in 0..4 {
                    kernels[4 * kernel + m] = [y[m].re, y[m].im][kept[0]];
                }
            }
        }
    }
}

#[inline(always)]
fn outermost<L: Lanes, const R: usize>(
    lanes: L,
    layout: &Layout,
    plan: &LinePlan<L::Number>,
    rows: &[Line<L>],
    kept: usize,
    lines: &mut [Line<L>],
) {
    let places = plan.inner_length();
    let weights = splat(lanes, &plan.forward(0)[0]);
    let stride = layout.group_stride / (2 * L::WIDTH);
    let parts = parts::<L, R>(lines, places);
    for j in 0..places {
        let mut x = [Complex::zero(lanes); R];
        for m in 0..R {
            let row = m * places + j;
            if m * places < layout.rows_read {
                x[m].re = rows[row / L::WIDTH * stride + row % L::WIDTH][kept];
            }
        }
        let y = butterfly(lanes, x, &weights);
        for m in 0..R {
            y[m].store(&mut parts[m][j]);
        }
    }
}
