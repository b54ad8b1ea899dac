//! A planned scene at another resolution.

use serde::Serialize;

use crate::case::{Course, GridSize, Stage};
use crate::model::{GridError, SurfaceGrid};
use crate::plan::Plan;

/// Increments a cycle needs at the least: it turns twice.
const FEWEST_OF_A_CYCLE: usize = 4;

/// Cells, increments and tolerance of a scene.
#[derive(Debug, Clone, PartialEq, Serialize)]
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
        let half = |(count, stage): (&usize, &Stage)| fewest(stage).max(count.div_ceil(2)).min(*count);
        Self {
            cells: self.cells.map(|count| count.div_ceil(2)),
            increments: self.increments.iter().zip(stages).map(half).collect(),
            tolerance: self.tolerance,
        }
    }

    /// The same scene on the same grid area at this resolution, keeping no fields. The plan's size is not judged again.
    ///
    /// # Errors
    /// When a side has no cells.
    pub fn planned(&self, plan: &Plan) -> Result<Plan, GridError> {
        let size = plan.grid.size();
        let spacing = [size[0] / self.cells[0] as f64, size[1] / self.cells[1] as f64];
        let mut varied = plan.clone();
        varied.grid = SurfaceGrid::new(self.cells, spacing)?;
        let case = &mut varied.case;
        case.cells = self.cells;
        case.size = GridSize::Given(size);
        case.tolerance = self.tolerance;
        case.output.fields.clear();
        case.output.every = None;
        case.stress = None;
        for (stage, increments) in case.stages.iter_mut().zip(&self.increments) {
            stage.increments = *increments;
        }
        varied.increments = varied.case.increments();
        Ok(varied)
    }
}

/// Fewest increments a stage can have.
pub(super) fn fewest(stage: &Stage) -> usize {
    if matches!(stage.course, Course::Cycles(_)) { FEWEST_OF_A_CYCLE } else { 1 }
}
