//! Kernels at depth integrated over rectangular cells: what a unit traction on one cell does under another.

use ndarray::{Array3, ArrayView2, Axis};
use pulp::{Arch, Simd, WithSimd};
use rayon::prelude::*;

use super::cells::{CellQuadrature, MOST_POINTS};
use super::depth_panels::Lanes;
use super::depth_radial::{
    DepthKernels, DisplacementFromAll, KernelLattice, Quartets, StressFromAll, StressFromPressure,
};
use super::depth_response::DepthResponse;
use super::far_cells::{FAR, FIVE_POINTS, LEAST};

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

    /// One (pressure alone) or three.
    pub(crate) fn loads(&self) -> usize {
        self.values.len_of(Axis(1)) / C
    }

    /// The kernel of a component from a load: pressure, `q_x`, `q_y`.
    pub(crate) fn kernel(&self, load: usize, component: usize) -> ArrayView2<'_, f64> {
        self.values.index_axis(Axis(1), load * C + component)
    }
}

/// Integrals over one cell of the kernels of a quartet times the angular factors of their orders.
///
/// Order 0: `[K]`; 1: `[K x, K y]`; 2: `[K (x^2 - y^2), K x y]`; 3: `[K (x^3 - 3 x y^2), K (3 x^2 y - y^3)]`: first and second
/// entry of all lanes.
type Moments = [Lanes; 2];

#[derive(Clone, Copy)]
struct Rectangle {
    centre: [f64; 2],
    sides: [f64; 2],
}

/// Kernels of one depth for near cells, and for far ones where cells are square.
struct Tables<const N: usize> {
    near: Option<DepthKernels<N>>,
    far: Option<DepthKernels<N>>,
    depth: f64,
    spacing: [f64; 2],
}

impl<const N: usize> Tables<N> {
    fn new<Q: Quartets<N>>(response: &DepthResponse, cells: [usize; 2], spacing: [f64; 2]) -> Self {
        let depth = response.depth();
        let size = [cells[0] as f64 * spacing[0], cells[1] as f64 * spacing[1]];
        let greatest = (size[0] * size[0] + size[1] * size[1]).sqrt();
        let least = 0.5 * spacing[0].min(spacing[1]);
        if spacing[0] != spacing[1] {
            let lattice = KernelLattice::new(response, least, greatest);
            return Self { near: Some(lattice.points::<Q, N>(greatest)), far: None, depth, spacing };
        }
        let side = spacing[0];
        let edge = FAR * side;
        if depth >= edge {
            let lattice = KernelLattice::new(response, LEAST * side, greatest);
            let far = lattice.filtered::<Q, N>(LEAST * side, greatest, side);
            return Self { near: None, far: Some(far), depth, spacing };
        }
        // centres of near cells lie within this radius; Gauss points less than a side farther, of the five less nearer
        let radius = ((edge - depth) * (edge + depth)).sqrt();
        let lattice = KernelLattice::new(response, least, greatest);
        let near = lattice.points::<Q, N>((radius + side).min(greatest));
        let far = (radius < greatest)
            .then(|| lattice.filtered::<Q, N>((radius - LEAST * side - side).max(least), greatest, side));
        Self { near: Some(near), far, depth, spacing }
    }

    /// Whether the rule of five points serves a cell.
    #[inline(always)]
    fn is_far(&self, offset: [f64; 2]) -> bool {
        let [x, y] = offset;
        let edge = FAR * self.spacing[0];
        self.far.is_some() && x * x + y * y + self.depth * self.depth >= edge * edge
    }
}

/// A row of cells to be integrated.
struct Row<'a, Q, const N: usize> {
    tables: &'a Tables<N>,
    quadrature: &'a CellQuadrature,
    index: usize,
    moments: &'a mut [[Moments; N]],
    quartets: Q,
}

impl<Q: Quartets<N>, const N: usize> WithSimd for Row<'_, Q, N> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { tables, quadrature, index, moments, quartets } = self;
        let spacing = tables.spacing;
        let mut parts = Vec::new();
        for (j, moments) in moments.iter_mut().enumerate() {
            let offset = [index as f64 * spacing[0], j as f64 * spacing[1]];
            *moments = [[[0.0; 4]; 2]; N];
            match (&tables.near, &tables.far) {
                (_, Some(far)) if tables.is_far(offset) => {
                    add_five_points::<S, Q, N>(far, offset, spacing[0], moments);
                }
                (Some(near), _) => {
                    let cells = NearCells { quadrature, kernels: near, depth: tables.depth, quartets };
                    if offset == [0.0, 0.0] {
                        cells.add_own_cell::<S>(spacing, moments);
                    } else {
                        parts.push(Rectangle { centre: offset, sides: spacing });
                        cells.add_rectangles::<S>(&mut parts, moments);
                    }
                }
                _ => {}
            }
        }
    }
}

/// Adds the values at a point, times a weight.
#[inline(always)]
fn add_point<S: Simd, Q: Quartets<N>, const N: usize>(
    kernels: &DepthKernels<N>,
    [x, y]: [f64; 2],
    weight: f64,
    sum: &mut [Moments; N],
) {
    let (xx, yy) = (x * x, y * y);
    let values = kernels.at_square::<S>(xx + yy);
    add_values::<Q, N>(&values, [x, y], weight, sum);
}

#[inline(always)]
fn add_values<Q: Quartets<N>, const N: usize>(
    values: &[Lanes; N],
    [x, y]: [f64; 2],
    weight: f64,
    sum: &mut [Moments; N],
) {
    let (xx, yy) = (x * x, y * y);
    let (weight_x, weight_y) = (weight * x, weight * y);
    let first = [weight, weight_x, weight * (xx - yy), weight_x * (xx - 3.0 * yy)];
    let second = [0.0, weight_y, weight_x * y, weight_y * (3.0 * xx - yy)];
    for quartet in 0..N {
        let orders = Q::LIST[quartet].orders();
        for lane in 0..4 {
            sum[quartet][0][lane] += values[quartet][lane] * first[orders[lane]];
        }
        for lane in 0..4 {
            sum[quartet][1][lane] += values[quartet][lane] * second[orders[lane]];
        }
    }
}

/// The integral over a far square cell.
#[inline(always)]
fn add_five_points<S: Simd, Q: Quartets<N>, const N: usize>(
    kernels: &DepthKernels<N>,
    centre: [f64; 2],
    side: f64,
    sum: &mut [Moments; N],
) {
    let area = side * side;
    for (point, weight) in FIVE_POINTS {
        let place = [centre[0] + side * point[0], centre[1] + side * point[1]];
        if place == [0.0, 0.0] {
            add_values::<Q, N>(&kernels.innermost(), place, area * weight, sum);
        } else {
            add_point::<S, Q, N>(kernels, place, area * weight, sum);
        }
    }
}

/// Cells whose distance from the load may be small.
struct NearCells<'a, Q, const N: usize> {
    quadrature: &'a CellQuadrature,
    kernels: &'a DepthKernels<N>,
    depth: f64,
    #[expect(dead_code, reason = "says which kernels they are")]
    quartets: Q,
}

impl<Q: Quartets<N>, const N: usize> NearCells<'_, Q, N> {
    /// Adds rectangles, each halved across its longer side while that is longer than half its distance. Leaves none.
    #[inline(always)]
    fn add_rectangles<S: Simd>(&self, rectangles: &mut Vec<Rectangle>, sum: &mut [Moments; N]) {
        while let Some(rectangle) = rectangles.pop() {
            let Rectangle { centre, sides } = rectangle;
            // kernels are smooth on the scale of the distance from the load, depth included
            let distance = (centre[0] * centre[0] + centre[1] * centre[1] + self.depth * self.depth).sqrt();
            let longer = usize::from(sides[1] > sides[0]);
            if sides[longer] > 0.5 * distance {
                let quarter = 0.25 * sides[longer];
                for shift in [quarter, -quarter] {
                    let mut half = rectangle;
                    half.centre[longer] += shift;
                    half.sides[longer] *= 0.5;
                    rectangles.push(half);
                }
            } else {
                let rules =
                    [self.quadrature.rule(distance / sides[0]), self.quadrature.rule(distance / sides[1])];
                self.add_gauss_points::<S>(rectangle, rules, sum);
            }
        }
    }

    #[inline(always)]
    fn add_gauss_points<S: Simd>(
        &self,
        rectangle: Rectangle,
        rules: [&[(f64, f64)]; 2],
        sum: &mut [Moments; N],
    ) {
        let Rectangle { centre, sides } = rectangle;
        let half = [0.5 * sides[0], 0.5 * sides[1]];
        let mut column = [[0.0; 2]; MOST_POINTS];
        for (place, (point, weight)) in column.iter_mut().zip(rules[1]) {
            *place = [centre[1] + half[1] * point, weight * half[1]];
        }
        let mut parts = [[[0.0; 4]; 2]; N];
        for (point, weight) in rules[0] {
            let x = centre[0] + half[0] * point;
            let weight_x = weight * half[0];
            for [y, weight_y] in &column[..rules[1].len()] {
                add_point::<S, Q, N>(self.kernels, [x, *y], weight_x * weight_y, &mut parts);
            }
        }
        for quartet in 0..N {
            for entry in 0..2 {
                for lane in 0..4 {
                    sum[quartet][entry][lane] += parts[quartet][entry][lane];
                }
            }
        }
    }

    /// The loaded cell itself: the inscribed disc by its antiderivative, the rest of the rectangle in polar coordinates. Odd
    /// kernels vanish.
    #[inline(always)]
    fn add_own_cell<S: Simd>(&self, sides: [f64; 2], sum: &mut [Moments; N]) {
        let disc = self.kernels.innermost();
        for quartet in 0..N {
            for lane in 0..4 {
                sum[quartet][0][lane] += disc[quartet][lane];
            }
        }
        let radius = 0.5 * sides[0].min(sides[1]);
        for (edge, half_length, sign) in
            [(0.5 * sides[0], 0.5 * sides[1], 1.0), (0.5 * sides[1], 0.5 * sides[0], -1.0)]
        {
            self.add_sector::<S>(radius, edge, half_length, sign, sum);
        }
    }

    /// Adds the four parts between the disc and the edges at distance `edge` with half length `half_length`; `sign` is that of
    /// `cos 2 phi` when phi is counted from the edge's normal instead of from x.
    #[inline(always)]
    fn add_sector<S: Simd>(
        &self,
        radius: f64,
        edge: f64,
        half_length: f64,
        sign: f64,
        sum: &mut [Moments; N],
    ) {
        let last = libm::asinh(half_length / edge);
        for (point, weight) in &self.quadrature.polar_angle.points {
            // y = edge sinh(tau), so that the distance of the edge is edge cosh(tau)
            let tau = 0.5 * last * (1.0 + point);
            let (sinh, cosh) = (libm::sinh(tau), libm::cosh(tau));
            let cos_double = sign * (1.0 - sinh) * (1.0 + sinh) / (cosh * cosh);
            let reach = libm::log(edge * cosh / radius);
            if reach <= 0.0 {
                continue;
            }
            let panels = (reach / 0.35).ceil();
            let angle_weight = 4.0 * 0.5 * last * weight / cosh * (0.5 * reach / panels);
            for panel in 0..panels as u32 {
                for (point, weight) in &self.quadrature.polar_radius.points {
                    let log_radius = reach * (f64::from(panel) + 0.5 * (1.0 + point)) / panels;
                    let r = radius * libm::exp(log_radius);
                    let square = r * r;
                    let weight = angle_weight * weight * square;
                    let values = self.kernels.at_square::<S>(square);
                    let factors = [weight, 0.0, weight * square * cos_double, 0.0];
                    for quartet in 0..N {
                        for lane in 0..4 {
                            let factor = factors[Q::LIST[quartet].orders()[lane]];
                            sum[quartet][0][lane] += values[quartet][lane] * factor;
                        }
                    }
                }
            }
        }
    }
}

/// Kernels on a grid, `K = loads C` of them, from what `of_moments` makes of a cell's moments: `[load][component]`. On square
/// grids of square cells only offsets `j <= i` are integrated; the others are those with x and y exchanged.
fn coefficients<Q: Quartets<N>, const N: usize, const C: usize, const L: usize>(
    quartets: Q,
    response: &DepthResponse,
    cells: [usize; 2],
    spacing: [f64; 2],
    of_moments: impl Fn(&[Moments; N]) -> [[f64; C]; L] + Sync,
) -> DepthCoefficients<C> {
    let tables = Tables::new::<Q>(response, cells, spacing);
    let quadrature = CellQuadrature::new();
    let [nx, ny] = cells;
    let mirrored = nx == ny && spacing[0] == spacing[1];
    let kernels = L * C;
    let mut values = vec![0.0; nx * kernels * ny];
    values.par_chunks_mut(kernels * ny).enumerate().for_each_init(
        || vec![[[[0.0; 4]; 2]; N]; ny],
        |moments, (index, rows)| {
            let moments = &mut moments[..if mirrored { index + 1 } else { ny }];
            Arch::new().dispatch(Row {
                tables: &tables,
                quadrature: &quadrature,
                index,
                moments,
                quartets,
            });
            for (j, moments) in moments.iter().enumerate() {
                for (load, components) in of_moments(moments).into_iter().enumerate() {
                    for (component, value) in components.into_iter().enumerate() {
                        rows[(load * C + component) * ny + j] = value;
                    }
                }
            }
        },
    );
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
    for first in (0..n).step_by(BLOCK) {
        for kernel in 0..kernels {
            let partner = exchanged::<C>(kernel);
            for j in first..n {
                let from = (j * kernels + partner) * n;
                let end = (first + BLOCK).min(j);
                for i in first..end {
                    values[(i * kernels + kernel) * n + j] = values[from + i];
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

/// Stress coefficients of one depth on a grid; shear is left out where it is not wanted.
pub(crate) fn stress_coefficients(
    response: &DepthResponse,
    cells: [usize; 2],
    spacing: [f64; 2],
    with_shear: bool,
) -> DepthCoefficients<6> {
    if with_shear {
        coefficients(StressFromAll, response, cells, spacing, |[pressure, stress, traction]| {
            let [x, y] = from_shear(stress, traction);
            [from_pressure(pressure), x, y]
        })
    } else {
        coefficients(StressFromPressure, response, cells, spacing, |[pressure]| [from_pressure(pressure)])
    }
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

/// Displacement coefficients of one depth on a grid.
pub(crate) fn displacement_coefficients(
    response: &DepthResponse,
    cells: [usize; 2],
    spacing: [f64; 2],
) -> DepthCoefficients<3> {
    coefficients(DisplacementFromAll, response, cells, spacing, |[four, [[rise, ..], [rise_y, ..]]]| {
        let [[depthwise, mean, double, radial], [_, _, double_y, radial_y]] = four;
        [
            [-radial, -radial_y, *depthwise],
            [mean - double, -2.0 * double_y, *rise],
            [-2.0 * double_y, mean + double, *rise_y],
        ]
    })
}
