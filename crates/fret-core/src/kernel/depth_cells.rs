//! Kernels at depth integrated over rectangular cells: what a unit traction on one cell does under another.

use std::marker::PhantomData;

use ndarray::{Array3, ArrayView2, Axis};
use pulp::{Arch, Simd, WithSimd};
use rayon::prelude::*;

use super::cells::CellQuadrature;
use super::depth_integrals::{Moments, NearCells, Rectangle, add_five_points};
use super::depth_quartets::{DisplacementFromAll, Quartets, StressFromAll, StressFromPressure};
use super::depth_radial::{DepthKernels, KernelLattice};
use super::depth_response::DepthResponse;
use super::far_cells::{FAR, LEAST};

/// Kernels of `C` components: what unit pressure on a cell does under another, and unit shear along x and y. Values over
/// offsets `i, j >= 0` from the loaded cell to the point; of periodic scenes, over indices of wavenumbers.
///
/// Of stress \[1\] the components are xx, yy, zz, xy, xz, yz: from pressure xx, yy, zz are even-even, xy odd-odd, xz odd-even, yz
/// even-odd; from `q_x` the parity along x is turned, from `q_y` along y. Of displacement [length/pressure] they are x, y, z,
/// with the parities of xz, yz, zz.
#[derive(Clone, Debug)]
pub(crate) struct DepthCoefficients<const C: usize> {
    /// Shape `(nx, loads * C, ny)`: rows of all kernels lie together.
    values: Array3<f64>,
}

impl<const C: usize> DepthCoefficients<C> {
    pub(super) fn new(values: Array3<f64>) -> Self {
        Self { values }
    }

    /// The memory the values are in, for the next.
    pub(crate) fn into_memory(self) -> Vec<f64> {
        self.values.into_raw_vec_and_offset().0
    }

    /// The kernel of a component from a load: pressure, `q_x`, `q_y`.
    pub(crate) fn kernel(&self, load: usize, component: usize) -> ArrayView2<'_, f64> {
        self.values.index_axis(Axis(1), load * C + component)
    }
}

/// Kernels of one depth for near cells, and for far ones where cells are square.
struct Tables<Q, const N: usize> {
    near: Option<DepthKernels<N>>,
    far: Option<DepthKernels<N>>,
    depth: f64,
    spacing: [f64; 2],
    quartets: PhantomData<Q>,
}

impl<Q: Quartets<N>, const N: usize> Tables<Q, N> {
    fn new(response: &DepthResponse, cells: [usize; 2], spacing: [f64; 2]) -> Self {
        let depth = response.depth();
        let greatest = diagonal(cells, spacing);
        let least = 0.5 * spacing[0].min(spacing[1]);
        if spacing[0] != spacing[1] {
            return Self::near_only(response, cells, spacing);
        }
        let quartets = PhantomData;
        let side = spacing[0];
        let edge = FAR * side;
        if depth >= edge {
            let lattice = KernelLattice::new::<Q, N>(response, LEAST * side, greatest);
            let far = lattice.filtered::<Q, N>(LEAST * side, greatest, side);
            return Self { near: None, far: Some(far), depth, spacing, quartets };
        }
        // centres of near cells lie within this radius; Gauss points less than a side farther, of the five less nearer
        let radius = ((edge - depth) * (edge + depth)).sqrt();
        let lattice = KernelLattice::new::<Q, N>(response, least, greatest);
        let near = lattice.points::<Q, N>((radius + side).min(greatest));
        let far = (radius < greatest)
            .then(|| lattice.filtered::<Q, N>((radius - LEAST * side - side).max(least), greatest, side));
        Self { near: Some(near), far, depth, spacing, quartets }
    }

    /// All cells as if they were near.
    fn near_only(response: &DepthResponse, cells: [usize; 2], spacing: [f64; 2]) -> Self {
        let least = 0.5 * spacing[0].min(spacing[1]);
        let greatest = diagonal(cells, spacing);
        let near = KernelLattice::new::<Q, N>(response, least, greatest).points::<Q, N>(greatest);
        Self { near: Some(near), far: None, depth: response.depth(), spacing, quartets: PhantomData }
    }

    /// Whether the rule of five points serves a cell.
    #[inline(always)]
    fn is_far(&self, offset: [f64; 2]) -> bool {
        let [x, y] = offset;
        let edge = FAR * self.spacing[0];
        self.far.is_some() && x * x + y * y + self.depth * self.depth >= edge * edge
    }
}

fn diagonal(cells: [usize; 2], spacing: [f64; 2]) -> f64 {
    let size = [cells[0] as f64 * spacing[0], cells[1] as f64 * spacing[1]];
    (size[0] * size[0] + size[1] * size[1]).sqrt()
}

/// A row of cells to be integrated, of which the first `count` are wanted.
struct Row<'a, Q, F, const N: usize, const C: usize, const L: usize> {
    tables: &'a Tables<Q, N>,
    quadrature: &'a CellQuadrature,
    index: usize,
    count: usize,
    of_moments: &'a F,
    /// Rows of all kernels.
    kernels: Vec<&'a mut [f64]>,
}

impl<Q, F, const N: usize, const C: usize, const L: usize> WithSimd for Row<'_, Q, F, N, C, L>
where
    Q: Quartets<N>,
    F: Fn(&[Moments; N]) -> [[f64; C]; L],
{
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Row { tables, quadrature, index, count, of_moments, mut kernels } = self;
        let spacing = tables.spacing;
        let mut parts = Vec::new();
        for j in 0..count {
            let offset = [index as f64 * spacing[0], j as f64 * spacing[1]];
            let mut moments = [[[0.0; 4]; 2]; N];
            match (&tables.near, &tables.far) {
                (_, Some(far)) if tables.is_far(offset) => {
                    add_five_points::<S, Q, N>(far, offset, spacing[0], &mut moments);
                }
                (Some(near), _) => {
                    let quartets = PhantomData::<Q>;
                    let cells = NearCells { quadrature, kernels: near, depth: tables.depth, quartets };
                    if offset == [0.0, 0.0] {
                        cells.add_own_cell::<S>(spacing, &mut moments);
                    } else {
                        parts.push(Rectangle { centre: offset, sides: spacing });
                        cells.add_rectangles::<S>(&mut parts, &mut moments);
                    }
                }
                _ => {}
            }
            let values = of_moments(&moments);
            for (row, value) in kernels.iter_mut().zip(values.as_flattened()) {
                row[j] = *value;
            }
        }
    }
}

/// Kernels on a grid, `K = loads C` of them, from what `of_moments` makes of a cell's moments: `[load][component]`. On square
/// grids of square cells only offsets `j <= i` are integrated; the others are those with x and y exchanged.
fn coefficients<Q: Quartets<N>, const N: usize, const C: usize, const L: usize>(
    tables: &Tables<Q, N>,
    cells: [usize; 2],
    memory: Vec<f64>,
    of_moments: impl Fn(&[Moments; N]) -> [[f64; C]; L] + Sync,
) -> DepthCoefficients<C> {
    let spacing = tables.spacing;
    let quadrature = CellQuadrature::new();
    let [nx, ny] = cells;
    let mirrored = nx == ny && spacing[0] == spacing[1];
    let kernels = L * C;
    let mut values = memory;
    values.resize(nx * kernels * ny, 0.0);
    values.par_chunks_mut(kernels * ny).enumerate().for_each(|(index, rows)| {
        let row = Row::<Q, _, N, C, L> {
            tables,
            quadrature: &quadrature,
            index,
            count: if mirrored { index + 1 } else { ny },
            of_moments: &of_moments,
            kernels: rows.chunks_exact_mut(ny).collect(),
        };
        Arch::new().dispatch(row);
    });
    if mirrored {
        mirror::<C>(&mut values, nx, kernels);
    }
    let shape = (nx, kernels, ny);
    let values = Array3::from_shape_vec(shape, values).unwrap_or_else(|_| Array3::zeros(shape));
    DepthCoefficients::new(values)
}

/// Fills the offsets `j > i` from those with x and y exchanged, block by block.
fn mirror<const C: usize>(values: &mut [f64], n: usize, kernels: usize) {
    const BLOCK: usize = 8;
    let stride = kernels * n;
    for first in (0..n).step_by(BLOCK) {
        let last = (first + BLOCK).min(n);
        let (upper, lower) = values.split_at_mut(last * stride);
        let upper = &mut upper[first * stride..];
        // the block on the diagonal
        for kernel in 0..kernels {
            let [own, partner] = [kernel, exchanged::<C>(kernel)].map(|kernel| kernel * n + first);
            for i in 0..last - first {
                for j in i + 1..last - first {
                    upper[i * stride + own + j] = upper[j * stride + partner + i];
                }
            }
        }
        for (number, rows) in lower.chunks(BLOCK * stride).enumerate() {
            let place = last + number * BLOCK;
            let count = rows.len() / stride;
            for kernel in 0..kernels {
                let [own, partner] = [kernel, exchanged::<C>(kernel)].map(|kernel| kernel * n);
                for (i, row) in upper.chunks_exact_mut(stride).enumerate() {
                    let values = &mut row[own + place..own + place + count];
                    for (value, row) in values.iter_mut().zip(rows.chunks_exact(stride)) {
                        *value = row[partner + first + i];
                    }
                }
            }
        }
    }
}

/// The kernel that another one is when x and y are exchanged.
fn exchanged<const C: usize>(kernel: usize) -> usize {
    let load = [0, 2, 1][kernel / C];
    let component = if C == 6 { [1, 0, 2, 3, 5, 4][kernel % C] } else { [1, 0, 2][kernel % C] };
    load * C + component
}

/// Stress coefficients of one depth on a grid; shear is left out where it is not wanted. `memory` is written over.
pub(crate) fn stress_coefficients(
    response: &DepthResponse,
    cells: [usize; 2],
    spacing: [f64; 2],
    with_shear: bool,
    memory: Vec<f64>,
) -> DepthCoefficients<6> {
    if with_shear {
        let tables = Tables::<StressFromAll, 3>::new(response, cells, spacing);
        coefficients(&tables, cells, memory, stress_from_all)
    } else {
        let tables = Tables::<StressFromPressure, 1>::new(response, cells, spacing);
        coefficients(&tables, cells, memory, |[pressure]| [from_pressure(pressure)])
    }
}

#[inline(always)]
fn stress_from_all([pressure, stress, traction]: &[Moments; 3]) -> [[f64; 6]; 3] {
    let [x, y] = from_shear(stress, traction);
    [from_pressure(pressure), x, y]
}

/// xx, yy, zz, xy, xz, yz.
#[inline(always)]
fn from_pressure([[normal, mean, difference, along_x], [_, _, shear, along_y]]: &Moments) -> [f64; 6] {
    [mean - difference, mean + difference, -normal, -2.0 * shear, *along_x, *along_y]
}

/// From `q_x` and from `q_y`.
#[inline(always)]
fn from_shear(stress: &Moments, traction: &Moments) -> [[f64; 6]; 2] {
    let [[normal, mean, single, triple], [normal_y, mean_y, single_y, triple_y]] = stress;
    let [[even, double, ..], [_, double_y, ..]] = traction;
    [
        [
            mean + single - triple,
            mean - single + triple,
            -normal,
            single_y - triple_y,
            -even + double,
            2.0 * double_y,
        ],
        [
            mean_y - single_y - triple_y,
            mean_y + single_y + triple_y,
            -normal_y,
            single + triple,
            2.0 * double_y,
            -even - double,
        ],
    ]
}

/// Displacement coefficients of one depth on a grid. `memory` is written over.
pub(crate) fn displacement_coefficients(
    response: &DepthResponse,
    cells: [usize; 2],
    spacing: [f64; 2],
    memory: Vec<f64>,
) -> DepthCoefficients<3> {
    let tables = Tables::<DisplacementFromAll, 2>::new(response, cells, spacing);
    coefficients(&tables, cells, memory, displacement_from_all)
}

#[inline(always)]
fn displacement_from_all([four, [[rise, ..], [rise_y, ..]]]: &[Moments; 2]) -> [[f64; 3]; 3] {
    let [[depthwise, mean, double, radial], [_, _, double_y, radial_y]] = four;
    [
        [-radial, -radial_y, *depthwise],
        [mean - double, -2.0 * double_y, *rise],
        [-2.0 * double_y, mean + double, *rise_y],
    ]
}

#[cfg(test)]
mod tests {
    use super::super::samples::stack;
    use super::*;

    /// Of one kernel, the largest effect that any traction between -1 and 1 could have of the difference.
    fn effect<const C: usize>(
        found: &DepthCoefficients<C>,
        exact: &DepthCoefficients<C>,
        kernel: usize,
    ) -> f64 {
        let pairs = found.values.index_axis(Axis(1), kernel).to_owned().into_iter();
        let exact = exact.values.index_axis(Axis(1), kernel);
        4.0 * pairs.zip(exact).map(|(found, exact)| (found - exact).abs()).sum::<f64>()
    }

    #[test]
    fn five_filtered_points_integrate_far_cells_as_well_as_gauss_points() {
        type Case = (&'static [(f64, f64, f64)], Option<(f64, f64)>);
        let cases: [Case; 5] = [
            (&[], Some((1.0, 0.3))),
            (&[(100.0, 0.3, 0.5)], Some((1.0, 0.3))),
            (&[(0.01, 0.2, 0.5)], Some((1.0, 0.4))),
            (&[(1.0, 0.45, 0.3)], None),
            (&[(1e4, 0.25, 0.2), (1.0, 0.5, 1.0)], Some((30.0, 0.3))),
        ];
        // the long way that serves cells of any sides, on a grid that reaches nearly three times as far as where the rule
        // begins
        let (cells, spacing) = ([48; 2], [0.1; 2]);
        let mut worst = [0.0_f64; 2];
        for (layers, substrate) in cases {
            let half_space = stack(layers, substrate);
            for depth in [0.0, 0.04, 0.29, 1.0, 1.59, 1.6, 3.0, 20.0] {
                let bottoms = layers.iter().scan(0.0, |bottom, layer| {
                    *bottom += layer.2;
                    Some(*bottom)
                });
                let layer = bottoms.filter(|bottom| depth > *bottom).count();
                if substrate.is_none() && layer == layers.len() {
                    continue;
                }
                let response = DepthResponse::new(&half_space, layer, depth);
                let found = stress_coefficients(&response, cells, spacing, true, Vec::new());
                let long = Tables::<StressFromAll, 3>::near_only(&response, cells, spacing);
                let exact = coefficients(&long, cells, Vec::new(), stress_from_all);
                for kernel in 0..18 {
                    let effect = effect(&found, &exact, kernel);
                    worst[0] = worst[0].max(effect);
                    // found: 2e-13, rounding of two tables summed over 9000 cells; the rule's own part is 1e-14 of the local kernel
                    assert!(effect < 1e-12, "{layers:?} depth {depth}, kernel {kernel}: {effect:e}");
                }
                let found = displacement_coefficients(&response, cells, spacing, Vec::new());
                let long = Tables::<DisplacementFromAll, 2>::near_only(&response, cells, spacing);
                let exact = coefficients(&long, cells, Vec::new(), displacement_from_all);
                let size = exact.kernel(0, 2).iter().map(|value| value.abs()).sum::<f64>();
                for kernel in 0..9 {
                    let effect = effect(&found, &exact, kernel) / size;
                    worst[1] = worst[1].max(effect);
                    assert!(effect < 1e-12, "{layers:?} depth {depth}, displacement {kernel}: {effect:e}");
                }
            }
        }
        println!("five points against Gauss points: stress {:.1e}, displacement {:.1e}", worst[0], worst[1]);
    }

    #[test]
    fn offsets_with_x_and_y_exchanged_are_as_if_integrated_themselves() {
        // a grid that is not square integrates every offset; sizes with and without a rest of the blocks
        let response = DepthResponse::new(&stack(&[(2.0, 0.3, 0.5)], Some((1.0, 0.3))), 0, 0.3);
        for n in [1_usize, 5, 16, 21] {
            let square = stress_coefficients(&response, [n, n], [0.1; 2], true, vec![f64::NAN; 7]);
            let long = stress_coefficients(&response, [n, n + 1], [0.1; 2], true, Vec::new());
            for (place, value) in square.values.indexed_iter() {
                let exact = long.values[place];
                // rounding of sums taken in another order, and of another table
                assert!((value - exact).abs() < 1e-14, "{n} {place:?}: {value} {exact}");
            }
        }
    }
}
