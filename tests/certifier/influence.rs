//! The operator as plain double sums: displacements of a grid's cells from influence coefficients, cell by cell.

use fret_core::kernel::{
    Components, InfluenceCoefficients, PairResponse, influence_coefficients, line_coefficients,
    periodic_symbols, repeated_coefficients,
};
use fret_core::model::{ContactPair, Periodicity, SurfaceGrid};
use ndarray::{Array2, s};

/// Displacement of any cell by unit traction on any other, over their offset.
pub struct Influence {
    cells: [usize; 2],
    /// zz, xx, yy, xy, zx, zy over offsets from `-(n - 1)` to `n - 1` along both axes.
    tables: [Array2<f64>; 6],
    /// Normal displacement of a cell by unit pressure on itself [length/pressure].
    pub own_normal: f64,
    /// Tangential displacement of a cell by unit shear on itself, the smaller of the two directions [length/pressure].
    pub own_tangential: f64,
}

/// Axes along which the six components are odd.
const ODD: [[bool; 2]; 6] =
    [[false, false], [false, false], [false, false], [true, true], [true, false], [false, true]];
/// Displacement (z, x, y), traction (z, x, y), component, sign. `u_x` by pressure is minus `u_z` by `q_x`: reciprocity.
const TERMS: [(usize, usize, usize, f64); 9] = [
    (0, 0, 0, 1.0),
    (1, 1, 1, 1.0),
    (2, 2, 2, 1.0),
    (1, 2, 3, 1.0),
    (2, 1, 3, 1.0),
    (0, 1, 4, 1.0),
    (1, 0, 4, -1.0),
    (0, 2, 5, 1.0),
    (2, 0, 5, -1.0),
];

impl Influence {
    /// Table of a pair on a grid; of a periodic problem with all images.
    pub fn new(bodies: &ContactPair, grid: &SurfaceGrid, periodic: Periodicity, datum: Option<f64>) -> Self {
        let (cells, spacing) = (grid.cells(), grid.spacing());
        let quarters = if periodic.is_both() {
            let symbols = periodic_symbols(bodies, cells, spacing, Components::ALL, 0);
            let all = [symbols.zz, symbols.xx, symbols.yy, symbols.xy, symbols.zx, symbols.zy];
            let mut component = 0..6;
            all.map(|symbol| {
                in_space(&symbol.unwrap_or_default(), cells, ODD[component.next().unwrap_or_default()])
            })
        } else {
            let InfluenceCoefficients { zz, xx, yy, xy, zx, zy } = if grid.is_line() {
                let datum = datum.unwrap_or(grid.size()[0]);
                line_coefficients(bodies, cells[0], spacing[0], datum, Components::ALL)
            } else if let Some(axis) = periodic.one_axis() {
                let datum = datum.unwrap_or(grid.size()[1 - axis]);
                let response = PairResponse::new(bodies);
                repeated_coefficients((bodies, &response), (cells, spacing), axis, datum, Components::ALL)
            } else {
                influence_coefficients(bodies, cells, spacing, Components::ALL)
            };
            [zz, xx, yy, xy, zx, zy].map(|table| table.unwrap_or_else(|| Array2::zeros(cells)))
        };
        let own_normal = quarters[0][[0, 0]];
        let own_tangential = quarters[1][[0, 0]].min(quarters[2][[0, 0]]);
        let mut component = 0..6;
        let tables = quarters.map(|quarter| whole(&quarter, ODD[component.next().unwrap_or_default()]));
        Self { cells, tables, own_normal, own_tangential }
    }

    /// Displacements normal, along x, along y: for every loaded cell its traction times the table about it.
    pub fn displacements(&self, p: &Array2<f64>, q: &[Array2<f64>; 2]) -> [Array2<f64>; 3] {
        let [nx, ny] = self.cells;
        let mut displacements = [0; 3].map(|_| Array2::zeros(self.cells));
        let tractions = [p, &q[0], &q[1]];
        for (to, from, component, sign) in TERMS {
            for ((m, n), &traction) in tractions[from].indexed_iter() {
                if traction != 0.0 {
                    let about = self.tables[component]
                        .slice(s![nx - 1 - m..2 * nx - 1 - m, ny - 1 - n..2 * ny - 1 - n]);
                    displacements[to].scaled_add(sign * traction, &about);
                }
            }
        }
        displacements
    }
}

/// A table over offsets of both signs from that of offsets that are not negative.
fn whole(quarter: &Array2<f64>, odd: [bool; 2]) -> Array2<f64> {
    let (nx, ny) = quarter.dim();
    Array2::from_shape_fn((2 * nx - 1, 2 * ny - 1), |(i, j)| {
        let [x, y] = [i as isize - (nx as isize - 1), j as isize - (ny as isize - 1)];
        let sign = |odd: bool, offset: isize| match offset.signum() {
            0 if odd => 0.0,
            -1 if odd => -1.0,
            _ => 1.0,
        };
        sign(odd[0], x) * sign(odd[1], y) * quarter[[x.unsigned_abs(), y.unsigned_abs()]]
    })
}

/// Coefficients over offsets `0..cells` of a periodic problem from its symbol: a plain Fourier sum, cosines along axes where
/// the component is even and sines where it is odd.
fn in_space(symbol: &Array2<f64>, cells: [usize; 2], odd: [bool; 2]) -> Array2<f64> {
    let waves = |axis: usize| {
        let n = cells[axis];
        Array2::from_shape_fn((n, n / 2 + 1), |(place, wave)| {
            let times = if wave == 0 || 2 * wave == n { 1.0 } else { 2.0 };
            let angle = std::f64::consts::TAU * ((place * wave) % n) as f64 / n as f64;
            times / n as f64 * if odd[axis] { angle.sin() } else { angle.cos() }
        })
    };
    waves(0).dot(symbol).dot(&waves(1).t())
}
