//! The pressure of a first contact from coarser grids: each grid starts from the one twice as coarse, carried up by the level
//! function of the contact's edge, and works in a box around what it starts from.
//!
//! A coarse cell is four cells under one pressure whose displacement is their mean (Galerkin): its coefficients are sums of
//! the finer ones, right for every body, and measured gaps need nothing but means.

use ndarray::{Array2, ArrayView2};

use super::normal::{NormalTask, first_pressure, solve_normal};
use super::preconditioner::{Preconditioner, Waves};
use super::region::Region;
use super::settings::{SolveError, SolverSettings, Watch};
use crate::compliance::{SpectralCompliance, SurfaceCompliance, SurfaceResponse, Wanted};
use crate::edge::level_function;
use crate::history::Work;
use crate::kernel::{InfluenceCoefficients, PeriodicSymbols, ResponseTable};
use crate::model::Symmetry;
use fret_fft::good_length;

/// No grid with fewer cells a side is made coarser.
const COARSEST: usize = 32;
/// Residual on coarse grids: at 1e-3 the contact of large grids starts out wrong.
const TOLERANCE: f64 = 3e-4;
/// The same for stiff coatings, whose contact settles late: coarse iterations are cheaper than fine ones.
const TOLERANCE_STIFF: f64 = 3e-6;
/// The carried edge is moved out by this share of a fine cell, since cells are added more cheaply than removed.
const SHIFT: f64 = 0.05;
/// The same for stiff coatings, whose frozen contacts shrink more surely than they grow.
const SHIFT_STIFF: f64 = 0.15;
/// Cells kept free around the predicted contact.
pub const MARGIN: usize = 2;
/// A periodic scene starts from the pressure of full contact where that is positive on more of the coarsest grid than this.
const NEARLY_FULL: f64 = 0.9;

/// One coarse grid.
struct Level {
    response: SurfaceResponse,
    undeformed: Array2<f64>,
    spacing: [f64; 2],
    symmetry: Symmetry,
}

/// The grids below one, the finest of them first.
pub struct CoarseGrids {
    levels: Vec<Level>,
    cells: [usize; 2],
}

/// What is prescribed: sum of the pressures over the cells of the finest grid, or the approach.
#[derive(Debug, Clone, Copy)]
pub struct Prescribed {
    /// Sum of the pressures [pressure].
    pub total: Option<f64>,
    /// Approach [length].
    pub approach: f64,
}

impl CoarseGrids {
    /// The grids below one of the given cells, in front of its mirrors; none when it is small.
    pub fn below(
        response: &SurfaceResponse,
        undeformed: &Array2<f64>,
        spacing: [f64; 2],
        symmetry: Symmetry,
    ) -> Self {
        let (nx, ny) = undeformed.dim();
        let mut levels: Vec<Level> = Vec::new();
        loop {
            let (response, undeformed, spacing) =
                levels.last().map_or((response, undeformed, spacing), |last| {
                    (&last.response, &last.undeformed, last.spacing)
                });
            let (nx, ny) = undeformed.dim();
            let cells = symmetry.whole_of([nx, ny]);
            let repeats = response.is_periodic();
            let halves =
                |axis: usize| !(repeats || symmetry.axes()[axis]) || [nx, ny][axis].is_multiple_of(2);
            if cells[0].min(cells[1]) < COARSEST || !(halves(0) && halves(1)) {
                break;
            }
            let Some(response) = coarser_response(response, cells) else { break };
            let level = Level {
                response,
                undeformed: coarser_heights(undeformed),
                spacing: spacing.map(|side| 2.0 * side),
                symmetry,
            };
            levels.push(level);
        }
        Self { levels, cells: [nx, ny] }
    }

    /// A pressure for the grid above, close to the solution, or none when coarse grids do not help. `work` counts what it cost.
    ///
    /// # Errors
    /// When somebody stopped the iteration.
    pub fn pressure_above(
        &self,
        prescribed: Prescribed,
        table: Option<&ResponseTable>,
        settings: &SolverSettings,
        work: &mut Work,
        watch: Watch<'_>,
    ) -> Result<Option<Array2<f64>>, SolveError> {
        if self.levels.last().is_some_and(|coarsest| coarsest.is_nearly_full(prescribed.total, self.cells)) {
            return Ok(None);
        }
        let mut start: Option<Array2<f64>> = None;
        for (index, level) in self.levels.iter().enumerate().rev() {
            let total = prescribed.total.map(|total| total * 0.25_f64.powi(index as i32 + 1));
            let above = if index == 0 { self.cells } else { self.levels[index - 1].cells() };
            let prescribed = Prescribed { total, ..prescribed };
            let waves = table.map(|table| Waves { table, spacing: level.spacing });
            let solved = match level.solve(start.take(), prescribed, waves, settings, watch) {
                Ok(solved) => solved,
                Err(SolveError::Stopped) => return Err(SolveError::Stopped),
                Err(_) => return Ok(None),
            };
            work.convolutions += solved.convolutions;
            work.preconditioner_passes += solved.passes;
            work.full_grid_convolutions +=
                solved.cell_convolutions / (self.cells[0] * self.cells[1] * level.symmetry.copies()) as f64;
            let Some(carried) = solved.carried(above, total) else { return Ok(None) };
            start = Some(carried);
        }
        Ok(start)
    }
}

/// A solved coarse grid.
struct SolvedLevel {
    region: Region,
    pressure: Vec<f64>,
    gap: Vec<f64>,
    shift: f64,
    convolutions: usize,
    passes: usize,
    /// Convolutions times the cells of their boxes.
    cell_convolutions: f64,
}

impl Level {
    fn cells(&self) -> [usize; 2] {
        self.undeformed.dim().into()
    }

    /// Whether a scene that repeats is in contact nearly everywhere, judged by the pressure that closes all gaps. `total`: sum of
    /// the pressures over the finest grid's `cells`.
    fn is_nearly_full(&self, total: Option<f64>, cells: [usize; 2]) -> bool {
        let (true, Some(total)) = (self.response.is_periodic(), total) else { return false };
        let mean = total / (cells[0] * cells[1]) as f64;
        let Ok(mut inverse) = Preconditioner::new(
            &self.response,
            None,
            self.cells(),
            [true, false],
            None,
            self.symmetry,
            false,
        ) else {
            return false;
        };
        let undeformed = Region::whole(self.cells()).gather(&self.undeformed);
        let mut removed = vec![0.0; undeformed.len()];
        inverse.normal(&undeformed, &mut removed);
        let mean = mean + removed.iter().sum::<f64>() / removed.len() as f64;
        let loaded = removed.iter().filter(|part| mean > **part).count();
        loaded as f64 > NEARLY_FULL * removed.len() as f64
    }

    /// Solves the level in a box; on the whole grid when the contact outgrows the box.
    fn solve(
        &self,
        start: Option<Array2<f64>>,
        prescribed: Prescribed,
        waves: Option<Waves<'_>>,
        settings: &SolverSettings,
        watch: Watch<'_>,
    ) -> Result<SolvedLevel, SolveError> {
        let whole = Region::whole(self.cells());
        let mut region = match &start {
            Some(start) if !self.response.is_periodic() => {
                Region::around(self.cells(), self.symmetry.axes(), MARGIN, good_length, |i, j| {
                    start[[i, j]] > 0.0
                })
            }
            _ => whole,
        };
        let mut start = start;
        let (mut convolutions, mut passes, mut cell_convolutions) = (0, 0, 0.0);
        loop {
            let symmetry = self.symmetry;
            let wanted = Wanted { normal: true, symmetry, ..Wanted::default() };
            let missing = |_| SolveError::OperatorsMissing;
            let mut compliance =
                SpectralCompliance::new(&self.response, region.shape, wanted).map_err(missing)?;
            let single = settings.six_digits;
            let shape = region.shape;
            let mut preconditioner =
                Preconditioner::new(&self.response, waves, shape, [true, false], None, symmetry, single)
                    .map_err(missing)?;
            let undeformed = region.gather(&self.undeformed);
            let task = NormalTask {
                undeformed: &undeformed,
                total: prescribed.total,
                approach: prescribed.approach,
            };
            let mut pressure = match &start {
                Some(start) => region.gather(start),
                None => first_pressure(&task, compliance.own().normal),
            };
            let mut displacement = vec![0.0; region.len()];
            compliance.normal(&pressure, &mut displacement);
            let stiff = preconditioner.is_stiff();
            let tolerance = if stiff { TOLERANCE_STIFF } else { TOLERANCE };
            let coarse = SolverSettings { tolerance: tolerance.max(settings.tolerance), ..*settings };
            let solution = solve_normal(
                &task,
                &mut pressure,
                &mut displacement,
                &mut compliance,
                &mut preconditioner,
                &coarse,
                watch,
            )?;
            convolutions += compliance.applications;
            passes += preconditioner.passes;
            cell_convolutions += (compliance.applications * region.len()) as f64;
            if region != whole && touches_box(region, self.cells(), &pressure) {
                let mut found = Array2::zeros(self.cells());
                region.scatter(&pressure, &mut found);
                start = Some(found);
                region = whole;
                continue;
            }
            let shift = if stiff { SHIFT_STIFF } else { SHIFT };
            let gap = solution.gap;
            return Ok(SolvedLevel { region, pressure, gap, shift, convolutions, passes, cell_convolutions });
        }
    }
}

/// Whether the contact reaches a side of its box that is not one of the grid's.
fn touches_box(region: Region, cells: [usize; 2], pressure: &[f64]) -> bool {
    let [nx, ny] = region.shape;
    let low = [0, 1].map(|axis| region.origin[axis] > 0);
    let high = [0, 1].map(|axis| region.origin[axis] + region.shape[axis] < cells[axis]);
    let loaded = |i: usize, j: usize| pressure[i * ny + j] > 0.0;
    (0..ny).any(|j| (low[0] && loaded(0, j)) || (high[0] && loaded(nx - 1, j)))
        || (0..nx).any(|i| (low[1] && loaded(i, 0)) || (high[1] && loaded(i, ny - 1)))
}

impl SolvedLevel {
    /// Pressure on a grid twice as fine, of `cells` and with the sum that goes with `total` here.
    fn carried(&self, cells: [usize; 2], total: Option<f64>) -> Option<Array2<f64>> {
        let view = |field| ArrayView2::from_shape(self.region.shape, field).ok();
        let level =
            level_function(&view(self.pressure.as_slice())?, &view(self.gap.as_slice())?, f64::INFINITY)?;
        let fine = Region {
            origin: self.region.origin.map(|first| 2 * first),
            shape: [0, 1].map(|axis| {
                (2 * self.region.shape[axis]).min(cells[axis].saturating_sub(2 * self.region.origin[axis]))
            }),
        };
        let height = interpolated(&level, fine.shape);
        let [nx, ny] = fine.shape;
        let mut pressure = Array2::zeros(cells);
        let mut found = 0.0;
        for i in 0..nx {
            for j in 0..ny {
                let here = height[[i, j]];
                let along_x = height[[(i + 1).min(nx - 1), j]] - height[[i.saturating_sub(1), j]];
                let along_y = height[[i, (j + 1).min(ny - 1)]] - height[[i, j.saturating_sub(1)]];
                // A root only where it may tell: near the edge.
                let is_far = here.abs() >= along_x.abs() + along_y.abs();
                let slope = if is_far { 0.0 } else { 0.5 * along_x.hypot(along_y) };
                let shifted = if here.abs() < 2.0 * slope { here + self.shift * slope } else { here };
                if shifted > 0.0 {
                    let p = shifted.sqrt();
                    pressure[[fine.origin[0] + i, fine.origin[1] + j]] = p;
                    found += p;
                }
            }
        }
        if !(found > 0.0) {
            return None;
        }
        if let Some(total) = total {
            let share = 4.0 * total / found;
            pressure.mapv_inplace(|p| p * share);
        }
        Some(pressure)
    }
}

/// Bilinear interpolation to the centres of half cells.
fn interpolated(coarse: &Array2<f64>, fine: [usize; 2]) -> Array2<f64> {
    let (nx, ny) = coarse.dim();
    let places = |count: usize, cells: usize| -> Vec<(usize, usize, f64)> {
        (0..count)
            .map(|index| {
                let at = (0.5 * (index as f64 + 0.5) - 0.5).clamp(0.0, cells as f64 - 1.0);
                let low = at as usize;
                (low, (low + 1).min(cells - 1), at - low as f64)
            })
            .collect()
    };
    let along_y = places(fine[1], ny);
    let mut row = vec![0.0; ny];
    let mut result = Array2::zeros(fine);
    for (mut line, (low, high, share)) in result.rows_mut().into_iter().zip(places(fine[0], nx)) {
        for ((value, a), b) in row.iter_mut().zip(coarse.row(low)).zip(coarse.row(high)) {
            *value = (1.0 - share) * a + share * b;
        }
        for (value, &(low, high, share)) in line.iter_mut().zip(&along_y) {
            *value = (1.0 - share) * row[low] + share * row[high];
        }
    }
    result
}

/// Means of two by two cells; a cell more than half outside counts what is inside.
fn coarser_heights(fine: &Array2<f64>) -> Array2<f64> {
    let (nx, ny) = fine.dim();
    Array2::from_shape_fn((nx.div_ceil(2), ny.div_ceil(2)), |(i, j)| {
        let (right, up) = ((2 * i + 1).min(nx - 1), (2 * j + 1).min(ny - 1));
        0.25 * (fine[[2 * i, 2 * j]] + fine[[right, 2 * j]] + fine[[2 * i, up]] + fine[[right, up]])
    })
}

/// The normal response of cells twice as wide.
fn coarser_response(fine: &SurfaceResponse, cells: [usize; 2]) -> Option<SurfaceResponse> {
    let normal = |zz| (Some(zz), None, None, None, None, None);
    Some(match fine {
        SurfaceResponse::FreeSpace(coefficients) => {
            let (zz, xx, yy, xy, zx, zy) = normal(coarser_coefficients(coefficients.zz.as_ref()?));
            SurfaceResponse::FreeSpace(InfluenceCoefficients { zz, xx, yy, xy, zx, zy })
        }
        SurfaceResponse::Periodic(symbols) => {
            let (zz, xx, yy, xy, zx, zy) = normal(coarser_symbols(symbols.zz.as_ref()?, cells));
            SurfaceResponse::Periodic(PeriodicSymbols { zz, xx, yy, xy, zx, zy })
        }
    })
}

/// Mean displacement of two by two cells by one pressure on two by two others.
fn coarser_coefficients(fine: &Array2<f64>) -> Array2<f64> {
    let (nx, ny) = fine.dim();
    let mut row = vec![0.0; ny];
    let mut coarse = Array2::zeros((nx.div_ceil(2), ny.div_ceil(2)));
    for (i, mut line) in coarse.rows_mut().into_iter().enumerate() {
        // the quadrant is even; the last offset of an odd count is missing, and no contact inside the grid asks for it
        let near = [(2 * i).abs_diff(1), 2 * i, (2 * i + 1).min(nx - 1)].map(|index| fine.row(index));
        for j in 0..ny {
            row[j] = near[0][j] + 2.0 * near[1][j] + near[2][j];
        }
        for (j, value) in line.iter_mut().enumerate() {
            *value = 0.25 * (row[(2 * j).abs_diff(1)] + 2.0 * row[2 * j] + row[(2 * j + 1).min(ny - 1)]);
        }
    }
    coarse
}

/// The same in waves: each coarse wave is a mixture of four fine ones.
fn coarser_symbols(fine: &Array2<f64>, cells: [usize; 2]) -> Array2<f64> {
    let half = cells.map(|count| count / 2);
    let shares = |index: usize, count: usize| {
        let (sine, cosine) = libm::sincos(std::f64::consts::PI * index as f64 / count as f64);
        [cosine * cosine, sine * sine]
    };
    Array2::from_shape_fn(half.map(|count| count / 2 + 1), |(a, b)| {
        let [wide_x, narrow_x] = shares(a, cells[0]);
        let [wide_y, narrow_y] = shares(b, cells[1]);
        let (c, d) = (half[0] - a, half[1] - b);
        wide_x * (wide_y * fine[[a, b]] + narrow_y * fine[[a, d]])
            + narrow_x * (wide_y * fine[[c, b]] + narrow_y * fine[[c, d]])
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::{Components, influence_coefficients, periodic_symbols};
    use crate::model::{Base, Body, Coating, ContactPair, ElasticMaterial, HalfSpace};

    fn pair() -> ContactPair {
        let material = |young| ElasticMaterial::new(young, 0.3).unwrap();
        let body =
            HalfSpace::new(vec![Coating::new(material(5.0), 1.5).unwrap()], Base::Elastic(material(1.0)));
        ContactPair::new(Body::Rigid, Body::Elastic(body.unwrap())).unwrap()
    }

    fn responses(cells: [usize; 2]) -> [SurfaceResponse; 2] {
        let spacing = [1.0, 1.5];
        [
            SurfaceResponse::FreeSpace(influence_coefficients(&pair(), cells, spacing, Components::NORMAL)),
            SurfaceResponse::Periodic(periodic_symbols(&pair(), cells, spacing, Components::NORMAL, 0)),
        ]
    }

    #[test]
    fn a_coarse_cell_is_four_cells_under_one_pressure() {
        let cells = [16, 12];
        let normal = Wanted { normal: true, ..Wanted::default() };
        for response in responses(cells) {
            let coarse = coarser_response(&response, cells).unwrap();
            let pressure = |i: usize, j: usize| ((3 * i + 5 * j * j) % 7) as f64;
            let of_fine: Vec<f64> = (0..192).map(|cell| pressure(cell / 12 / 2, cell % 12 / 2)).collect();
            let of_coarse: Vec<f64> = (0..48).map(|cell| pressure(cell / 6, cell % 6)).collect();
            let (mut fine, mut found) = (vec![0.0; 192], vec![0.0; 48]);
            SpectralCompliance::new(&response, cells, normal).unwrap().normal(&of_fine, &mut fine);
            SpectralCompliance::new(&coarse, [8, 6], normal).unwrap().normal(&of_coarse, &mut found);
            let exact = coarser_heights(&Array2::from_shape_vec(cells, fine).unwrap());
            let size = exact.iter().copied().fold(0.0, f64::max);
            for (found, exact) in found.iter().zip(&exact) {
                assert!((found - exact).abs() < 1e-13 * size, "{found} {exact}"); // sums of 200 products
            }
        }
    }

    #[test]
    fn planes_are_carried_as_they_are() {
        let plane = |x: f64, y: f64| 3.0 + 0.5 * x - 0.25 * y;
        let coarse =
            Array2::from_shape_fn((6, 5), |(i, j)| plane(2.0 * i as f64 + 0.5, 2.0 * j as f64 + 0.5));
        let fine = interpolated(&coarse, [11, 10]);
        for ((i, j), value) in fine.indexed_iter() {
            if (1..10).contains(&i) && (1..9).contains(&j) {
                assert!((value - plane(i as f64, j as f64)).abs() < 1e-14);
            }
        }
        let means = coarser_heights(&Array2::from_shape_fn((12, 10), |(i, j)| plane(i as f64, j as f64)));
        assert!(means.iter().zip(&coarse).all(|(mean, value)| (mean - value).abs() < 1e-14));
    }
}
