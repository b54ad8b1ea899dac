//! The pressure of a first contact from coarser grids (nested iteration): each grid starts from the one twice as coarse, prolonged by
//! the level function of the contact's edge, and works in a region around what it starts from.

use ndarray::Array2;

use super::super::laws::rigid_motions::CellPositions;
use super::super::linear::preconditioner::CellWaves;
use super::super::operators::RegionOperators;
use super::super::outcome::Work;
use super::super::prescribed::NormalLoad;
use super::super::region::Region;
use super::super::settings::{IterationCallback, SolveError, SolverSettings};
use super::grid_transfer::{coarser_heights, coarser_response, is_made_coarser, prolonged};
use super::{NormalEquations, first_pressure, solve_normal};
use crate::compliance::{OperatorSet, SharedWorkspace, SurfaceCompliance, SurfaceResponse};
use crate::kernel::{Components, ResponseTable};
use crate::model::Symmetry;
use fret_fft::good_length;

/// No grid with fewer cells per side is made coarser.
const COARSEST: usize = 32;
/// Residual on coarse grids: at 1e-3 the contact of large grids starts out wrong.
const TOLERANCE: f64 = 3e-4;
/// The same for stiff coatings, whose contact settles late: coarse iterations are cheaper than fine ones.
const TOLERANCE_STIFF: f64 = 3e-6;
/// The prolonged edge is moved out by this fraction of a fine cell, since cells are added more cheaply than removed.
const SHIFT: f64 = 0.05;
/// Cells kept free around the predicted contact.
pub const MARGIN: usize = 2;

/// One coarse grid.
struct Level {
    response: SurfaceResponse,
    undeformed: Array2<f64>,
    positions: CellPositions,
    spacing: [f64; 2],
}

/// The grids below one, the finest of them first.
pub struct CoarseGrids {
    levels: Vec<Level>,
    /// Cells of the grid above, in front of the mirrors.
    cells: [usize; 2],
    symmetry: Symmetry,
}

impl CoarseGrids {
    /// The grids below one of the given cells, with symmetry reduction; none when it is small.
    pub fn below(
        response: &SurfaceResponse,
        undeformed: &Array2<f64>,
        (positions, spacing): (&CellPositions, [f64; 2]),
        symmetry: Symmetry,
    ) -> Self {
        let (nx, ny) = undeformed.dim();
        let mut levels: Vec<Level> = Vec::new();
        loop {
            let (response, undeformed, positions, spacing) =
                levels.last().map_or((response, undeformed, positions, spacing), |last| {
                    (&last.response, &last.undeformed, &last.positions, last.spacing)
                });
            let (nx, ny) = undeformed.dim();
            let cells = symmetry.whole_of([nx, ny]);
            if !is_made_coarser([nx, ny], COARSEST, (response.is_periodic(), symmetry)) {
                break;
            }
            let level = Level {
                response: coarser_response(response, cells, Components::NORMAL),
                undeformed: coarser_heights(undeformed),
                positions: positions.coarser(),
                spacing: spacing.map(|side| 2.0 * side),
            };
            levels.push(level);
        }
        Self { levels, cells: [nx, ny], symmetry }
    }

    /// A pressure for the grid above under its `load`, close to the solution, or none when coarse grids do not help. `work` counts what
    /// it cost.
    ///
    /// # Errors
    /// When the caller stopped the iteration.
    pub fn pressure_above(
        &self,
        load: NormalLoad,
        table: Option<&ResponseTable>,
        settings: &SolverSettings,
        work: &mut Work,
        callback: IterationCallback<'_>,
    ) -> Result<Option<Array2<f64>>, SolveError> {
        let mut start: Option<Array2<f64>> = None;
        for (index, level) in self.levels.iter().enumerate().rev() {
            let load = load.of_share(0.25_f64.powi(index as i32 + 1));
            let above = if index == 0 { self.cells } else { self.levels[index - 1].cells() };
            let waves = table.map(|table| CellWaves { table, spacing: level.spacing });
            let solved = match level.solve((start.take(), self.symmetry), load, waves, settings, callback) {
                Ok(solved) => solved,
                Err(SolveError::Stopped) => return Err(SolveError::Stopped),
                Err(_) => return Ok(None),
            };
            let cells = (self.cells[0] * self.cells[1] * self.symmetry.copies()) as f64;
            let full_grid_convolutions = solved.work.full_grid_convolutions / cells;
            *work += Work { full_grid_convolutions, ..solved.work };
            let SolvedLevel { region, pressure, gap, .. } = solved;
            let total = load.total.map(|total| 4.0 * total);
            start = prolonged((region, &pressure, &gap), SHIFT, above, total);
            if start.is_none() {
                return Ok(None);
            }
        }
        Ok(start)
    }
}

/// A solved coarse grid.
struct SolvedLevel {
    region: Region,
    pressure: Vec<f64>,
    gap: Vec<f64>,
    /// What it cost, the whole grid taken for one cell.
    work: Work,
}

impl Level {
    fn cells(&self) -> [usize; 2] {
        self.undeformed.dim().into()
    }

    /// Solves the level in a region; on the whole grid when the contact outgrows it.
    fn solve(
        &self,
        (mut start, symmetry): (Option<Array2<f64>>, Symmetry),
        load: NormalLoad,
        waves: Option<CellWaves<'_>>,
        settings: &SolverSettings,
        callback: IterationCallback<'_>,
    ) -> Result<SolvedLevel, SolveError> {
        let whole = Region::whole(self.cells());
        let mut region = match &start {
            Some(start) if !self.response.is_periodic() => {
                Region::around(self.cells(), symmetry.axes(), MARGIN, good_length, |i, j| start[[i, j]] > 0.0)
            }
            _ => whole,
        };
        let mut work = Work::default();
        loop {
            let single = settings.single_precision;
            let wanted = OperatorSet { normal: true, symmetry, single, ..OperatorSet::default() };
            let workspace = SharedWorkspace::default();
            let mut operators = RegionOperators::new(&self.response, waves, region, wanted, &workspace)?;
            let undeformed = region.gather(&self.undeformed);
            let task = NormalEquations {
                undeformed: &undeformed,
                load,
                positions: &self.positions.of_region(region),
            };
            let mut pressure = match &start {
                Some(start) => region.gather(start),
                None => first_pressure(&task, operators.compliance.self_influence().normal),
            };
            let tolerance = if operators.preconditioner.is_stiff() { TOLERANCE_STIFF } else { TOLERANCE };
            let coarse = SolverSettings { tolerance: tolerance.max(settings.tolerance), ..*settings };
            let fields = [&mut pressure[..], &mut vec![0.0; region.len()]];
            let solution = solve_normal(&task, fields, &mut operators, &coarse, callback)?;
            work += operators.take_work(region.len() as f64);
            if region != whole && touches_side(region, self.cells(), &pressure) {
                let mut found = Array2::zeros(self.cells());
                region.place(&pressure, &mut found);
                start = Some(found);
                region = whole;
                continue;
            }
            return Ok(SolvedLevel { region, pressure, gap: solution.gap, work });
        }
    }
}

/// Whether the contact reaches a side of its region that is not one of the grid's.
fn touches_side(region: Region, cells: [usize; 2], pressure: &[f64]) -> bool {
    let [nx, ny] = region.shape;
    let low = [0, 1].map(|axis| region.origin[axis] > 0);
    let high = [0, 1].map(|axis| region.origin[axis] + region.shape[axis] < cells[axis]);
    let loaded = |i: usize, j: usize| pressure[i * ny + j] > 0.0;
    (0..ny).any(|j| (low[0] && loaded(0, j)) || (high[0] && loaded(nx - 1, j)))
        || (0..nx).any(|i| (low[1] && loaded(i, 0)) || (high[1] && loaded(i, ny - 1)))
}
