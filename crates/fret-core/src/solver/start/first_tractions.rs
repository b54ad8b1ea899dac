//! Which start an increment takes.

use ndarray::Array2;

use crate::fields::{TangentialField, largest};
use crate::model::{ContactState, Control, LoadStep, Rig};
use crate::solver::increment_problem::centres;
use crate::solver::laws::rigid_motions::CellPositions;
use crate::solver::memory::GridTractions;
use crate::solver::normal::coarse_grids::CoarseGrids;
use crate::solver::prescribed::NormalLoad;
use crate::solver::region::Region;
use crate::solver::tractions::Tractions;
use crate::solver::{ContactSolver, Coupling, IterationCallback, SolveError};

/// A normal load changes much when it changes by more than this fraction: starting on coarse grids is then cheaper than from the
/// pressure before.
const LARGE_CHANGE: f64 = 0.03;

/// Surfaces yield whose elastic pressure on coarser grids is above the hardness by this factor.
const SURELY_YIELDS: f64 = 1.1;

/// What coarser grids tell.
pub(in crate::solver) struct CoarseStart {
    /// Pressure on the grid [pressure].
    pub pressure: Array2<f64>,
    /// Whether surfaces certainly yield under it.
    pub yields: bool,
}

impl ContactSolver<'_> {
    /// Whether increments start from the last cycle: those of surfaces that move and do not roll.
    pub(in crate::solver) fn goes_in_cycles(&self) -> bool {
        self.moved.is_some() && self.rolled == [0.0; 2]
    }

    /// Tractions to start from: those of the last cycle where surfaces move, of a contact that grows to the pressure from coarser grids, or that goes on as it did.
    pub(in crate::solver) fn predicted(
        &self,
        start: Option<&Array2<f64>>,
        (state, load): (&ContactState, &LoadStep),
        region: Region,
    ) -> Tractions {
        let before = self.memory.last_load.filter(|_| self.goes_in_cycles() && start.is_none());
        let as_last = before
            .and_then(|from| self.memory.last_cycle.tractions([&from, load], (region, self.grid.cells())));
        if let Some(tractions) = as_last {
            return tractions;
        }
        if self.coupling == Coupling::Frictionless && self.hardness.is_none() && start.is_some() {
            return Tractions::default(); // it starts from that pressure alone
        }
        let grown = start.filter(|_| self.coupling == Coupling::Coupled);
        let GridTractions { pressure, shear } = if self.rolled != [0.0; 2] && start.is_none() {
            GridTractions::of(state).carried(self.rolled)
        } else {
            let grown = grown.and_then(|pressure| self.grown_to(pressure, state));
            grown.unwrap_or_else(|| self.extrapolated(state, load))
        };
        let rubs = self.coupling != Coupling::Frictionless;
        let shear = if rubs { region.gather_tangential(&shear) } else { TangentialField::default() };
        Tractions { pressure: region.gather(&pressure), shear }
    }

    /// A pressure from coarser grids: for a first contact, and where the normal load changes much.
    pub(in crate::solver) fn pressure_from_coarse_grids(
        &mut self,
        state: &ContactState,
        load: &LoadStep,
        callback: IterationCallback<'_>,
    ) -> Result<Option<CoarseStart>, SolveError> {
        let touched = state.pressure.iter().any(|p| *p > 0.0);
        let far = match (load.normal, self.memory.last_load.map(|last| last.normal)) {
            (Control::Force(now), Some(Control::Force(then)))
            | (Control::Motion(now), Some(Control::Motion(then))) => {
                (now - then).abs() > LARGE_CHANGE * now.abs()
            }
            _ => true,
        };
        // A coupled contact that has grown before goes on from itself, and so does one in a period.
        let goes_on = self.coupling == Coupling::Coupled
            && (self.memory.before.is_some() || self.response.is_periodic());
        if touched && (!far || goes_on) {
            return Ok(None);
        }
        let lowest = self.undeformed.iter().copied().fold(f64::INFINITY, f64::min);
        let presses = match load.normal {
            Control::Force(force) => force > 0.0,
            Control::Motion(approach) => approach > lowest,
            Control::FarEnd(_) => false,
        };
        if !presses {
            return Ok(None);
        }
        let spacing = self.grid.spacing();
        let whole = Region::whole(self.grid.cells());
        let positions =
            CellPositions::new(centres(&self.grid, whole, 0), centres(&self.grid, whole, 1), false);
        let normal = NormalLoad::new(state, load, Rig::RIGID, [positions.length, self.grid.cell_area()]);
        let grids = self.coarse.get_or_insert_with(|| {
            CoarseGrids::below(self.response.get(), &self.undeformed, (&positions, spacing), self.symmetry)
        });
        let (table, settings) = (self.table.as_ref(), &self.settings);
        let elastic = grids.pressure_above(normal, table, settings, &mut self.work, callback)?;
        let is_above = |pressure: &Array2<f64>, hardness: f64| {
            pressure.as_slice().map_or(0.0, largest) > SURELY_YIELDS * hardness
        };
        match (elastic, self.hardness) {
            (Some(pressure), Some(hardness)) if is_above(&pressure, hardness) => {
                let normal = normal.with_hardness(self.hardness);
                let found = grids.pressure_above(normal, table, settings, &mut self.work, callback)?;
                Ok(Some(CoarseStart { pressure: found.unwrap_or(pressure), yields: true }))
            }
            (elastic, _) => Ok(elastic.map(|pressure| CoarseStart { pressure, yields: false })),
        }
    }
}
