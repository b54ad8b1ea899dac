//! A planned scene at another resolution.

use serde::{Deserialize, Serialize};

use crate::case::{GridSize, Path, Stage};
use crate::machine::memory::MemoryError;
use crate::model::{GridError, SurfaceGrid};
use crate::plan::{Plan, not_in_whole_cells};

/// Why a scene is not planned at another resolution.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum VariationError {
    /// No such grid.
    #[error(transparent)]
    Grid(#[from] GridError),
    /// Heights of the cells of one grid.
    #[error("heights that are given for every cell of one grid have no values on other cells")]
    Heights,
    /// A contact that would roll by parts of cells, in whose frame the grid goes by whole ones.
    #[error("{why}")]
    PartsOfCells {
        /// What the increments are.
        why: String,
        /// What to do.
        help: &'static str,
    },
    /// Not enough memory.
    #[error(transparent)]
    Memory(#[from] MemoryError),
}

/// Cells, increments and tolerance of a scene.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Variation {
    /// Cells `[nx, ny]`.
    pub cells: [usize; 2],
    /// Increments of each stage, or of one of its cycles.
    pub increments: Vec<usize>,
    /// Bound on the residual.
    pub tolerance: f64,
}

impl Variation {
    /// What a plan has.
    pub fn of(plan: &Plan) -> Self {
        Self {
            cells: plan.case.cells,
            increments: plan.case.stages.iter().map(|stage| stage.increments).collect(),
            tolerance: plan.case.tolerance,
        }
    }

    /// About half the cells along each side and half the increments of each stage.
    #[must_use]
    pub fn halved(&self, stages: &[Stage]) -> Self {
        let half = |(count, stage): (&usize, &Stage)| {
            let rows = rows(stage);
            fewest(stage).max(rows * (count / rows).div_ceil(2)).min(*count)
        };
        Self {
            cells: self.cells.map(|count| count.div_ceil(2)),
            increments: self.increments.iter().zip(stages).map(half).collect(),
            tolerance: self.tolerance,
        }
    }

    /// The same scene on the same grid area at this resolution, keeping no fields. The plan's size is not judged again.
    ///
    /// # Errors
    /// When a side has no cells, heights are those of other cells alone, a contact in whose frame the grid goes would roll by parts of cells, or there
    /// is no memory to plan so many.
    pub fn planned(&self, plan: &Plan) -> Result<Plan, VariationError> {
        let size = plan.grid.size();
        let spacing = [size[0] / self.cells[0] as f64, size[1] / self.cells[1] as f64]; // of a line contact the second is not looked at
        let mut varied = plan.clone();
        varied.grid = SurfaceGrid::new(self.cells, spacing)?;
        let case = &mut varied.case;
        case.cells = self.cells;
        case.size = GridSize::Given(varied.grid.size());
        case.tolerance = self.tolerance;
        for heights in &mut case.profile.heights {
            *heights = heights.on(self.cells).ok_or(VariationError::Heights)?;
        }
        case.output.fields.clear();
        case.output.every = None;
        case.stress = None;
        for (stage, increments) in case.stages.iter_mut().zip(&self.increments) {
            stage.increments = *increments;
        }
        if let Some((why, help)) = not_in_whole_cells(&varied.case, &varied.grid) {
            return Err(VariationError::PartsOfCells { why, help });
        }
        varied.follow()?;
        Ok(varied)
    }
}

/// Fewest increments a stage can have: all turning points of its cycle, all rows of its table.
pub(super) fn fewest(stage: &Stage) -> usize {
    if rows(stage) > 1 { rows(stage) } else { stage.fewest_increments() }
}

/// Rows of a stage's table, each of which takes the same number of increments; 1 without a table.
pub(super) fn rows(stage: &Stage) -> usize {
    let rows = stage.controls().map(|control| match control.path() {
        Path::Through(values) => values.len(),
        _ => 1,
    });
    rows.fold(1, usize::max)
}
