//! A study of resolutions: each kind of refinement alone with the others at their finest, and cells and increments together.

use serde::{Deserialize, Serialize};

use super::variation::{Variation, fewest, rows};
use crate::case::check::{FEWEST_CELLS as FEWEST_OF_A_CASE, MOST_CELLS, MOST_CELLS_IN_ALL};
use crate::history::concern::CELLS_IN_RADIUS;
use crate::model::Heights;
use crate::plan::{Coupling, Plan};

/// Fewest cells per side of a level that was not given.
const FEWEST_CELLS: usize = 8;

/// What is refined along a line of levels.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// Cells, at the most increments and the least tolerance.
    Cells,
    /// Increments, at the most cells and the least tolerance.
    Increments,
    /// Cells and increments, each a step at a time.
    Together,
    /// Tolerance, at the most cells and increments.
    Tolerance,
}

impl Kind {
    /// All kinds, in the order of tables.
    pub const ALL: [Self; 4] = [Self::Cells, Self::Increments, Self::Together, Self::Tolerance];
}

/// Why a study was refused.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ResolutionError {
    /// A number of cells along x that no grid can have.
    #[error("--cells {0}: a grid of {0} x {1} cells; each side needs at least 4, at most {MOST_CELLS}")]
    Cells(usize, usize),
    /// More cells than a grid can have.
    #[error("--cells {0}: a grid of {0} x {1} cells; at most {MOST_CELLS_IN_ALL} cells in all")]
    CellsInAll(usize, usize),
    /// A number of increments that a stage cannot have.
    #[error("--increments {0}: stage {1:?} needs at least {2}")]
    Increments(usize, String, usize),
    /// A number of increments that a table cannot be run through in.
    #[error("--increments {0}: stage {1:?} has a table, whose {2} rows take equal numbers of increments")]
    Rows(usize, String, usize),
    /// A tolerance out of range.
    #[error("--tolerances {0}: must lie between 1e-14 and 0.1")]
    Tolerance(f64),
    /// A grid that cannot be halved.
    #[error("{0} cells per side are too few to be halved; at least {1}")]
    TooCoarse(usize, usize),
    /// A contact that the cells hardly show.
    #[error(
        "about {0:.1} cells in the contact radius are too few for error bars to hold; at least {CELLS_IN_RADIUS}: more cells, or a \
         smaller grid (but for heights size = \"auto\" finds it)"
    )]
    FewCells(f64),
    /// Heights given cell by cell.
    #[error(
        "heights are given for every cell of one grid, and another grid has other cells; with resample = \"linear\" and the size of the \
         scan any grid takes its heights from the measured surface"
    )]
    Heights,
    /// A contact that would roll by parts of cells on the auxiliary grid.
    #[error("on half as many cells {0}")]
    PartsOfCells(String),
    /// Friction given cell by cell.
    #[error("friction coefficients are given for every cell of one grid, and another grid has other cells")]
    Friction,
}

/// Place of a level: numbers of its cells, increments and tolerance in the lists of the study.
pub type Place = [usize; 3];

/// Resolutions, each list from coarse to fine; the last of each make the finest level.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Resolutions {
    /// Cells `[nx, ny]`.
    pub cells: Vec<[usize; 2]>,
    /// Increments of each stage, or of one of its cycles.
    pub increments: Vec<Vec<usize>>,
    /// Tolerances, the largest first.
    pub tolerances: Vec<f64>,
}

impl Resolutions {
    /// A study for a plan. `cells` counts along x, the other side follows; `increments` holds for every stage, or one cycle of
    /// it. What is empty stays as the plan has it.
    ///
    /// # Errors
    /// When the scene has no such resolution.
    pub fn new(
        plan: &Plan,
        cells: &[usize],
        increments: &[usize],
        tolerances: &[f64],
    ) -> Result<Self, ResolutionError> {
        let own = Variation::of(plan);
        if !cells.is_empty() {
            only_one_grid(plan)?;
        }
        let [nx, ny] = own.cells;
        let axes = plan.grid.dimension().axes();
        let across = |count: usize| match axes.len() {
            1 => 1,
            _ => (count as f64 * ny as f64 / nx as f64).round().max(1.0) as usize,
        };
        let grids: Vec<[usize; 2]> = cells.iter().map(|count| [*count, across(*count)]).collect();
        for &[along, across] in &grids {
            if [along, across][axes.clone()]
                .iter()
                .any(|side| !(FEWEST_OF_A_CASE..=MOST_CELLS).contains(side))
            {
                return Err(ResolutionError::Cells(along, across));
            }
            if along * across > MOST_CELLS_IN_ALL {
                return Err(ResolutionError::CellsInAll(along, across));
            }
        }
        for count in increments {
            if let Some(stage) = plan.case.stages.iter().find(|stage| fewest(stage) > *count) {
                return Err(ResolutionError::Increments(*count, stage.name.clone(), fewest(stage)));
            }
            if let Some(stage) = plan.case.stages.iter().find(|stage| !count.is_multiple_of(rows(stage))) {
                return Err(ResolutionError::Rows(*count, stage.name.clone(), rows(stage)));
            }
        }
        if let Some(bad) = tolerances.iter().find(|tolerance| !(1e-14..=0.1).contains(*tolerance)) {
            return Err(ResolutionError::Tolerance(*bad));
        }
        let mut cells = grids;
        let mut increments: Vec<_> =
            increments.iter().map(|count| vec![*count; plan.case.stages.len()]).collect();
        let mut tolerances = tolerances.to_vec();
        if cells.is_empty() {
            cells.push(own.cells);
        }
        if increments.is_empty() {
            increments.push(own.increments);
        }
        if tolerances.is_empty() {
            tolerances.push(own.tolerance);
        }
        cells.sort_unstable();
        cells.dedup();
        increments.sort_unstable();
        increments.dedup();
        tolerances.sort_by(|a, b| b.total_cmp(a));
        tolerances.dedup();
        Ok(Self { cells, increments, tolerances })
    }

    /// The plan's own resolution and two before it, each with half the cells and half the increments of the next. What cannot
    /// be halved, or makes no difference, stays as it is.
    pub fn halving(plan: &Plan) -> Self {
        let own = Variation::of(plan);
        let half = own.halved(&plan.case.stages);
        let quarter = half.halved(&plan.case.stages);
        let mut cells = vec![own.cells];
        let mut increments = vec![own.increments.clone()];
        for coarser in [half, quarter] {
            if only_one_grid(plan).is_ok()
                && (0..2).all(|axis| coarser.cells[axis] >= FEWEST_CELLS || own.cells[axis] == 1)
            {
                cells.insert(0, coarser.cells);
            }
            if plan.coupling != Coupling::Frictionless && !increments.contains(&coarser.increments) {
                increments.insert(0, coarser.increments);
            }
        }
        Self { cells, increments, tolerances: vec![own.tolerance] }
    }

    /// Place of the finest level.
    pub fn finest(&self) -> Place {
        [self.cells.len() - 1, self.increments.len() - 1, self.tolerances.len() - 1]
    }

    /// Places of the levels of a kind, from coarse to fine; empty when the study has no two of them.
    pub fn line(&self, kind: Kind) -> Vec<Place> {
        let [i, j, k] = self.finest();
        let line: Vec<Place> = match kind {
            Kind::Cells => (0..=i).map(|i| [i, j, k]).collect(),
            Kind::Increments => (0..=j).map(|j| [i, j, k]).collect(),
            Kind::Tolerance => (0..=k).map(|k| [i, j, k]).collect(),
            Kind::Together => (0..=i.min(j)).rev().map(|down| [i - down, j - down, k]).collect(),
        };
        if line.len() > 1 { line } else { Vec::new() }
    }

    /// All places, each once, the cheap ones first.
    pub fn places(&self) -> Vec<Place> {
        let mut places: Vec<Place> = Kind::ALL.iter().flat_map(|kind| self.line(*kind)).collect();
        places.push(self.finest());
        let cost = |[i, j, k]: &Place| {
            let [nx, ny] = self.cells[*i];
            (nx * ny * self.increments[*j].iter().sum::<usize>(), *k)
        };
        places.sort_by_key(|place| (cost(place), *place));
        places.dedup();
        places
    }

    /// What an order is counted in: cells along x, increments of all stages that are refined, the inverse of the tolerance.
    pub fn count(&self, kind: Kind, [i, j, k]: Place) -> f64 {
        match kind {
            Kind::Cells | Kind::Together => self.cells[i][0] as f64,
            Kind::Increments => self.refined(j).sum::<usize>() as f64,
            Kind::Tolerance => self.tolerances[k].recip(),
        }
    }

    /// Increments of the stages that are refined: those whose number differs from list to list; of all, where none does.
    pub(super) fn refined(&self, list: usize) -> impl Iterator<Item = usize> {
        let differs =
            |stage: usize| self.increments.iter().any(|counts| counts[stage] != self.increments[0][stage]);
        let own = &self.increments[list];
        let some = (0..own.len()).any(differs);
        own.iter().enumerate().filter(move |(stage, _)| !some || differs(*stage)).map(|(_, count)| *count)
    }

    /// Resolution at a place.
    pub fn at(&self, [i, j, k]: Place) -> Variation {
        Variation {
            cells: self.cells[i],
            increments: self.increments[j].clone(),
            tolerance: self.tolerances[k],
        }
    }
}

/// Whether a scene can be put on another grid.
///
/// # Errors
/// When heights or friction are given for every cell, and heights are not resampled.
pub(super) fn only_one_grid(plan: &Plan) -> Result<(), ResolutionError> {
    let case = &plan.case;
    if !case.profile.heights.iter().all(Heights::fit_any_cells) {
        return Err(ResolutionError::Heights);
    }
    let mut laws = case.stages.iter().filter_map(|stage| stage.friction.as_ref());
    if case.friction.is_map() || laws.any(crate::model::CoulombFriction::is_map) {
        return Err(ResolutionError::Friction);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::{Kind, Resolutions};
    use crate::case::Case;
    use crate::plan::Plan;

    /// Four cells across a strip are not halved to a line of them, which would be a line contact; a line is.
    #[test]
    fn a_strip_is_not_halved_to_a_line() {
        let cells = |grid: &str| {
            let text = format!(
                "[grid]\n{grid}\n[upper]\nrigid = true\n[lower]\nsubstrate = {{ young = 1.0, poisson = 0.3 }}\n\
                 [profile.cylinder]\nradius = 10.0\naxis = \"y\"\n[[load]]\nnormal_force = 0.01\nincrements = 4\n"
            );
            let plan = Plan::new(Case::from_toml(&text, "").unwrap()).unwrap();
            Resolutions::halving(&plan).cells
        };
        assert_eq!(cells("cells = [64, 4]\nsize = [4.0, 0.25]\nperiodic = \"y\""), [[64, 4]]);
        assert_eq!(cells("cells = 64\nsize = 4.0"), [[16, 1], [32, 1], [64, 1]]);
    }

    /// A table that cannot be halved stands beside a stage that is: an order is counted in the increments of the latter.
    #[test]
    fn increments_are_counted_over_the_stages_that_are_refined() {
        let of = |increments: [[usize; 2]; 3]| {
            let increments = increments.map(Vec::from).to_vec();
            Resolutions { cells: vec![[8, 8], [16, 16]], increments, tolerances: vec![1e-8] }
        };
        let counts =
            |resolutions: &Resolutions| [0, 1, 2].map(|j| resolutions.count(Kind::Increments, [0, j, 0]));
        let one = of([[40, 8], [40, 16], [40, 32]]);
        assert_eq!(counts(&one), [8.0, 16.0, 32.0]);
        assert_eq!(one.refined(2).max(), Some(32));
        assert_eq!(counts(&of([[4, 8], [8, 16], [16, 32]])), [12.0, 24.0, 48.0]);
        assert_eq!(counts(&of([[4, 8]; 3])), [12.0; 3]);
        assert_eq!(one.count(Kind::Cells, [1, 0, 0]), 16.0);
    }
}
