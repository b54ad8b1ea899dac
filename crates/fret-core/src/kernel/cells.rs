//! Radial kernels integrated over the rectangular cells of a grid: what a unit traction on one cell does under another, at the surface
//! or at a depth.

use std::marker::PhantomData;

use ndarray::{Array3, ArrayView2, Axis};
use pulp::{Arch, Simd, WithSimd};
use rayon::prelude::*;

use super::cell_integrals::{Moments, NearCells, Rectangle, add_five_points};
use super::cell_rules::CellQuadrature;
use super::constant_kernels::ConstantKernels;
use super::far_cells::{FAR, LEAST};
use super::lattice_samples::WaveResponse;
use super::quartets::{Quartets, SurfaceDisplacement};
use super::radial::{KernelLattice, KernelSource, RadialKernels};

/// Kernels of `C` components: what unit pressure on a cell does under another, and unit shear along x and y. Values over
/// offsets `i, j >= 0` from the loaded cell to the point; of periodic scenes, over indices of wavenumbers.
///
/// Of stress \[1\] the components are xx, yy, zz, xy, xz, yz: from pressure xx, yy, zz are even-even, xy odd-odd, xz odd-even, yz
/// even-odd; from `q_x` the parity along x is turned, from `q_y` along y. Of displacement [length/pressure] they are x, y, z,
/// with the parities of xz, yz, zz.
#[derive(Clone, Debug)]
pub(crate) struct CellCoefficients<const C: usize> {
    /// Shape `(nx, loads * C, ny)`: rows of all kernels lie together.
    pub(super) values: Array3<f64>,
}

impl<const C: usize> CellCoefficients<C> {
    pub(super) fn new(values: Array3<f64>) -> Self {
        Self { values }
    }

    /// The memory the values are in, for the next.
    pub(crate) fn into_memory(self) -> Vec<f64> {
        self.values.into_raw_vec_and_offset().0
    }

    /// Those of the grid with x and y exchanged: `exchanged` components, and the second load for the third.
    pub(super) fn with_axes_exchanged(&self, exchanged: [usize; C]) -> Self {
        let (nx, kernels, ny) = self.values.dim();
        let values = Array3::from_shape_fn((ny, kernels, nx), |(i, kernel, j)| {
            self.values[[j, partner(kernel, exchanged), i]]
        });
        Self { values }
    }

    /// The kernel of a component from a load: pressure, `q_x`, `q_y`.
    pub(crate) fn kernel(&self, load: usize, component: usize) -> ArrayView2<'_, f64> {
        self.values.index_axis(Axis(1), load * C + component)
    }
}

/// Radial kernels for near cells, and for far ones where cells are square.
pub(super) struct Tables<Q, const N: usize> {
    near: Option<RadialKernels<N>>,
    far: Option<RadialKernels<N>>,
    depth: f64,
    spacing: [f64; 2],
    quartets: PhantomData<Q>,
}

impl<Q: Quartets<N>, const N: usize> Tables<Q, N> {
    pub(super) fn new(response: &impl WaveResponse, cells: [usize; 2], spacing: [f64; 2]) -> Self {
        let is_square = spacing[0] == spacing[1];
        Self::of(response, cells, spacing, is_square)
    }

    /// All cells as if they were near.
    #[cfg(test)]
    pub(super) fn near_only(response: &impl WaveResponse, cells: [usize; 2], spacing: [f64; 2]) -> Self {
        Self::of(response, cells, spacing, false)
    }

    fn of(response: &impl WaveResponse, cells: [usize; 2], spacing: [f64; 2], with_far: bool) -> Self {
        let (depth, greatest) = (response.depth(), diagonal(cells, spacing));
        let near = 0.5 * spacing[0].min(spacing[1]);
        let least = if with_far && depth >= FAR * spacing[0] { LEAST * spacing[0] } else { near };
        let source: Box<dyn KernelSource<Q, N>> = match response.constant() {
            Some(transfer) => {
                Box::new(ConstantKernels::new(Q::LIST.map(|quartet| quartet.lanes(1.0, &transfer)), least))
            }
            None => Box::new(KernelLattice::new::<Q, N>(response, least, greatest)),
        };
        let quartets = PhantomData;
        if !with_far {
            return Self { near: Some(source.points(greatest)), far: None, depth, spacing, quartets };
        }
        let side = spacing[0];
        let edge = FAR * side;
        if depth >= edge {
            let far = source.filtered(least, greatest, side);
            return Self { near: None, far: Some(far), depth, spacing, quartets };
        }
        // centres of near cells lie within this radius; Gauss points less than a side farther, of the five less nearer
        let radius = ((edge - depth) * (edge + depth)).sqrt();
        let near = source.points((radius + side).min(greatest));
        let far = (radius < greatest)
            .then(|| source.filtered((radius - LEAST * side - side).max(least), greatest, side));
        Self { near: Some(near), far, depth, spacing, quartets }
    }

    /// Whether the rule of five points serves a cell.
    #[inline(always)]
    fn is_far(&self, offset: [f64; 2]) -> bool {
        let [x, y] = offset;
        let edge = FAR * self.spacing[0];
        self.far.is_some() && x * x + y * y + self.depth * self.depth >= edge * edge
    }

    /// Integrals over the cell at an offset from the load; `parts`: memory to work in.
    #[inline(always)]
    fn moments<S: Simd>(
        &self,
        quadrature: &CellQuadrature,
        offset: [f64; 2],
        parts: &mut Vec<Rectangle>,
    ) -> [Moments; N] {
        let Self { depth, spacing, quartets, .. } = *self;
        let mut moments = [[[0.0; 4]; 2]; N];
        match (&self.near, &self.far) {
            (_, Some(far)) if self.is_far(offset) => {
                add_five_points::<S, Q, N>(far, offset, spacing[0], &mut moments);
            }
            (Some(kernels), _) => {
                let cells = NearCells { quadrature, kernels, depth, quartets };
                if offset == [0.0, 0.0] {
                    cells.add_own_cell::<S>(spacing, &mut moments);
                } else {
                    parts.push(Rectangle { centre: offset, sides: spacing });
                    cells.add_rectangles::<S>(parts, &mut moments);
                }
            }
            _ => {}
        }
        moments
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
            let moments = tables.moments::<S>(quadrature, offset, &mut parts);
            let values = of_moments(&moments);
            for (row, value) in kernels.iter_mut().zip(values.as_flattened()) {
                row[j] = *value;
            }
        }
    }
}

/// Writes the first `count` cells of rows of all kernels at the `index`-th offset along x.
pub(super) fn fill_row<Q: Quartets<N>, const N: usize, const C: usize, const L: usize>(
    tables: &Tables<Q, N>,
    quadrature: &CellQuadrature,
    (index, count): (usize, usize),
    of_moments: &impl Fn(&[Moments; N]) -> [[f64; C]; L],
    kernels: Vec<&mut [f64]>,
) {
    Arch::new().dispatch(Row::<Q, _, N, C, L> { tables, quadrature, index, count, of_moments, kernels });
}

/// Kernels on a grid, `K = loads C` of them, from what `of_moments` makes of a cell's moments: `[load][component]`. On square
/// grids of square cells only offsets `j <= i` are integrated; the others are those with x and y exchanged: `exchanged` components,
/// and the second load for the third. `memory` is written over.
pub(super) fn coefficients<Q: Quartets<N>, const N: usize, const C: usize, const L: usize>(
    tables: &Tables<Q, N>,
    cells: [usize; 2],
    memory: Vec<f64>,
    exchanged: [usize; C],
    of_moments: impl Fn(&[Moments; N]) -> [[f64; C]; L] + Sync,
) -> CellCoefficients<C> {
    let spacing = tables.spacing;
    let quadrature = CellQuadrature::new();
    let [nx, ny] = cells;
    let mirrored = nx == ny && spacing[0] == spacing[1];
    let kernels = L * C;
    let mut values = memory;
    values.resize(nx * kernels * ny, 0.0);
    values.par_chunks_mut(kernels * ny).enumerate().for_each(|(index, rows)| {
        let count = if mirrored { index + 1 } else { ny };
        fill_row(tables, &quadrature, (index, count), &of_moments, rows.chunks_exact_mut(ny).collect());
    });
    if mirrored {
        mirror(&mut values, nx, kernels, exchanged);
    }
    let shape = (nx, kernels, ny);
    let values = Array3::from_shape_vec(shape, values).unwrap_or_else(|_| Array3::zeros(shape));
    CellCoefficients::new(values)
}

/// The kernel that one is with x and y exchanged.
fn partner<const C: usize>(kernel: usize, exchanged: [usize; C]) -> usize {
    [0, 2, 1][kernel / C] * C + exchanged[kernel % C]
}

/// Fills the offsets `j > i` from those with x and y exchanged, block by block.
fn mirror<const C: usize>(values: &mut [f64], n: usize, kernels: usize, exchanged: [usize; C]) {
    let partners: Vec<_> = (0..kernels).map(|kernel| partner(kernel, exchanged)).collect();
    mirror_rows(values, 0, n, &partners);
}

/// The same in a square of rows and columns from `first` on, of which `values` are the rows: the square above the middle on all threads, then
/// both halves of the diagonal.
fn mirror_rows(values: &mut [f64], first: usize, n: usize, partners: &[usize]) {
    const BLOCK: usize = 8;
    let stride = partners.len() * n;
    let rows = values.len() / stride;
    if rows <= BLOCK {
        for (kernel, partner) in partners.iter().enumerate() {
            let [own, partner] = [kernel, *partner].map(|kernel| kernel * n + first);
            for i in 0..rows {
                for j in i + 1..rows {
                    values[i * stride + own + j] = values[j * stride + partner + i];
                }
            }
        }
        return;
    }
    let middle = (rows / 2).next_multiple_of(BLOCK);
    let (upper, lower) = values.split_at_mut(middle * stride);
    upper.par_chunks_mut(BLOCK * stride).enumerate().for_each(|(number, upper)| {
        for (block, rows) in lower.chunks(BLOCK * stride).enumerate() {
            let place = first + middle + block * BLOCK;
            for (kernel, partner) in partners.iter().enumerate() {
                for (i, row) in upper.chunks_exact_mut(stride).enumerate() {
                    let from = partner * n + first + number * BLOCK + i;
                    let to = &mut row[kernel * n + place..][..rows.len() / stride];
                    for (value, row) in to.iter_mut().zip(rows.chunks_exact(stride)) {
                        *value = row[from];
                    }
                }
            }
        }
    });
    rayon::join(
        || mirror_rows(upper, first, n, partners),
        || mirror_rows(lower, first + middle, n, partners),
    );
}

/// Displacement of the surface by unit traction on a cell: zz, xx, yy, xy, zx, zy.
pub(super) fn surface_coefficients(
    response: &impl WaveResponse,
    cells: [usize; 2],
    spacing: [f64; 2],
) -> CellCoefficients<6> {
    let tables = Tables::<SurfaceDisplacement, 1>::new(response, cells, spacing);
    coefficients(&tables, cells, Vec::new(), [0, 2, 1, 3, 5, 4], |[moments]| [surface_displacement(moments)])
}

#[inline(always)]
pub(super) fn surface_displacement([[zz, mean, double, zx], [_, _, double_y, zy]]: &Moments) -> [f64; 6] {
    [*zz, mean - double, mean + double, -2.0 * double_y, *zx, *zy]
}

#[cfg(test)]
mod tests;
