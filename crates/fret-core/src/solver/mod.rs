//! One load increment: from the state before and the new loads to the state after.
//!
//! [`ContactSolver`] picks what the problem needs (pressure alone, pressure then shear, or both together), works in a region around the
//! contact, and checks the rest of the grid once. The laws stand in `laws`, the method for pressure and shear together in `newton`,
//! its linear problems in `linear`, the frictionless problem in `normal`. Theory: `docs/theory/contact-problem.md` and
//! `docs/theory/solution-algorithm.md`.

mod contact_edge;
mod contact_set;
mod contact_vector;
mod exact_newton;
mod full_grid_check;
mod globalisation;
mod increment;
mod laws;
mod linear;
mod memory;
mod newton;
mod normal;
mod operators;
mod outcome;
mod region;
mod settings;
mod settle;
mod slip_history;
mod staggered;
mod start;
mod tilt;
mod tractions;

use std::borrow::Cow;

use ndarray::Array2;

use crate::compliance::{CellResponse, OperatorSet, SharedWorkspace, SpectralCompliance, SurfaceResponse};
use crate::kernel::ResponseTable;
use crate::model::{
    BulkCompliance, ContactState, Control, CoulombFriction, Integration, LoadStep, Rig, Scheme, SurfaceGrid,
    Symmetry,
};

pub use memory::SolverMemory;
pub(crate) use outcome::worst;
pub use outcome::{Increment, Outcome, Regime, Residual, Resultants, Work};
pub use settings::{Coupling, IterationCallback, SolveError, SolverSettings};

use increment::{IncrementProblem, Solved, Stretch};
use linear::preconditioner::{CellWaves, Preconditioner};
use linear::solver::LinearSolver;
use memory::{Before, Drift, GridTractions, LastIncrement};
use normal::coarse_grids::{CoarseGrids, Prescribed};
use operators::{Method, RegionOperators};
use region::Region;
use slip_history::slip_path;
use tractions::Tractions;

/// A normal load changes much when it changes by more than this fraction: starting on coarse grids is then cheaper than from the
/// pressure before.
const LARGE_CHANGE: f64 = 0.03;

/// Solves increments of one contact; of one with mirrors the part before them, which is what its grid, fields and memory hold.
pub struct ContactSolver<'a> {
    grid: SurfaceGrid,
    undeformed: Array2<f64>,
    friction: Cow<'a, CoulombFriction>,
    coupling: Coupling,
    response: SurfaceResponse,
    settings: SolverSettings,
    operators: Option<RegionOperators>,
    /// Normal displacement of the whole grid, to check what lies outside the region.
    full_grid: Option<SpectralCompliance>,
    /// Where all operators work.
    workspace: SharedWorkspace,
    /// Frequency response of the pair, for the preconditioner of pressure.
    table: Option<ResponseTable>,
    /// Made when they are first asked for.
    coarse: Option<CoarseGrids>,
    memory: SolverMemory,
    /// Work of increments that were not solved; the next one that is counts it.
    unsolved_work: Work,
    in_region: bool,
    /// The one axis along which shear acts.
    shear_axis: Option<usize>,
    symmetry: Symmetry,
    /// Where the middle of its grid is, which is that of the part in front of the mirrors [length].
    middle: [f64; 2],
    /// Strains of the bodies under their bulk stresses.
    bulk: BulkCompliance,
    /// Springs between the upper body and what is driven, of the whole contact.
    rig: Rig,
    /// Slope of the upper body that is in the gap, and the gap without it.
    tilt: [f64; 2],
    level: Option<Array2<f64>>,
}

impl<'a> ContactSolver<'a> {
    /// Solver of a contact. `in_region`: iterate in a region around the contact where that is smaller than the grid.
    pub fn new(
        grid: SurfaceGrid,
        undeformed: Array2<f64>,
        friction: &'a CoulombFriction,
        coupling: Coupling,
        response: SurfaceResponse,
        settings: SolverSettings,
        in_region: bool,
    ) -> Self {
        Self {
            grid,
            undeformed,
            friction: Cow::Borrowed(friction),
            coupling,
            response,
            settings,
            operators: None,
            full_grid: None,
            workspace: SharedWorkspace::default(),
            table: None,
            coarse: None,
            memory: SolverMemory::default(),
            unsolved_work: Work::default(),
            in_region,
            shear_axis: None,
            symmetry: Symmetry::NONE,
            middle: [0.0; 2],
            bulk: BulkCompliance::NONE,
            rig: Rig::RIGID,
            tilt: [0.0; 2],
            level: None,
        }
    }

    /// The same solver of bodies that strain under their bulk stresses.
    #[must_use]
    pub fn with_bulk(self, bulk: BulkCompliance) -> Self {
        Self { bulk, ..self }
    }

    /// The same solver of a contact in a machine that gives.
    #[must_use]
    pub fn with_rig(self, rig: Rig) -> Self {
        Self { rig, ..self }
    }

    /// The same solver, which also knows the frequency response of the pair: for non-periodic problems, where coefficients on a region
    /// do not tell a preconditioner how a stiff coating bends.
    #[must_use]
    pub fn with_response_table(self, table: ResponseTable) -> Self {
        Self { table: Some(table), ..self }
    }

    /// The same solver for a contact whose shear acts along one axis (0: x, 1: y) alone: nothing loads the other, and the bodies
    /// respond to a shear along it with no displacement across it.
    #[must_use]
    pub fn with_shear_axis(self, axis: Option<usize>) -> Self {
        Self { shear_axis: axis, ..self }
    }

    /// The same solver for a problem with mirrors: gap, friction and loads are their own mirror images, and cells even in number
    /// along mirrored axes. States pass in and out whole.
    #[must_use]
    pub fn with_symmetry(self, symmetry: Symmetry) -> Self {
        let cells = symmetry.part_of(self.grid.cells());
        let (mirrored, size) = (symmetry.axes(), self.grid.size());
        Self {
            middle: [0, 1].map(|axis| if mirrored[axis] { 0.25 * size[axis] } else { 0.0 }),
            grid: SurfaceGrid::new(cells, self.grid.spacing()).unwrap_or(self.grid),
            undeformed: symmetry.part(&self.undeformed),
            friction: Cow::Owned(symmetry.part_of_friction(&self.friction)),
            symmetry,
            ..self
        }
    }

    /// What is remembered of the increments solved so far.
    pub fn memory(&self) -> &SolverMemory {
        &self.memory
    }

    /// Goes on with the memory of another solver of the same contact: the next increments have the bits they would have there.
    pub fn restore_memory(&mut self, memory: SolverMemory) {
        self.memory = memory;
    }

    /// Another friction law from the next increment on.
    pub fn set_friction(&mut self, friction: &'a CoulombFriction) {
        self.friction = if self.symmetry.any() {
            Cow::Owned(self.symmetry.part_of_friction(friction))
        } else {
            Cow::Borrowed(friction)
        };
    }

    /// The same, of a law that nobody else holds.
    pub fn take_friction(&mut self, friction: CoulombFriction) {
        let friction = if self.symmetry.any() { self.symmetry.part_of_friction(&friction) } else { friction };
        self.friction = Cow::Owned(friction);
    }

    /// Goes on with another undeformed gap [length], shape of the grid: the displacements known so far hold no longer. Tractions, loads
    /// and the region of the last increment still do.
    pub fn set_gap(&mut self, undeformed: Array2<f64>) {
        self.undeformed = if self.symmetry.any() { self.symmetry.part(&undeformed) } else { undeformed };
        self.coarse = None;
        self.memory.last = None;
        self.memory.before = None;
        let tilt = std::mem::take(&mut self.tilt);
        self.level = None;
        self.set_tilt(tilt);
    }

    /// Goes on with bodies that respond otherwise; `table`: their frequency response, where it is used. As with another gap, the displacements
    /// known so far hold no longer.
    pub fn set_response(&mut self, response: SurfaceResponse, table: Option<ResponseTable>) {
        self.response = response;
        self.table = table;
        self.operators = None;
        self.full_grid = None;
        self.coarse = None;
        self.memory.last = None;
        self.memory.before = None;
    }

    /// Solves one increment: from `state`, which the increment before returned, to the loads and motions of `load`.
    ///
    /// # Errors
    /// When the equations cannot be satisfied, the loads have no equilibrium, or the contact reaches the grid's edge.
    pub fn step(
        &mut self,
        state: &ContactState,
        load: &LoadStep,
        callback: IterationCallback<'_>,
    ) -> Result<Increment, SolveError> {
        let mut work = std::mem::take(&mut self.unsolved_work);
        let symmetry = self.symmetry;
        let solved = if symmetry.any() {
            let part = symmetry.part_of_state(state);
            self.solve_tilted(&part, &symmetry.part_of_load(load, state), &mut work, callback)
                .map(|increment| increment.of_whole(symmetry))
                .map_err(|error| error.of_whole(symmetry.copies()))
        } else {
            self.solve_tilted(state, load, &mut work, callback)
        };
        match solved {
            Ok(increment) => Ok(Increment { work, ..increment }),
            Err(error) => {
                self.unsolved_work = work;
                Err(error)
            }
        }
    }

    fn solve(
        &mut self,
        state: &ContactState,
        load: &LoadStep,
        work: &mut Work,
        callback: IterationCallback<'_>,
    ) -> Result<Increment, SolveError> {
        if let Control::Force(normal) = load.normal {
            self.check_friction_carries(load, normal, 1e-12)?;
        }
        self.take_last_load_as(load, state);
        let mut start = self.pressure_from_coarse_grids(state, load, work, callback)?;
        let mut region = match &start {
            Some(pressure) => self.region_around(pressure, state),
            None => self.region_for(state, load),
        };
        let ratio = self.ratio_to_last(load);
        let follows =
            self.coupling != Coupling::Frictionless && self.settings.integration == Integration::SecondOrder;
        let mut ratio = ratio.filter(|_| follows);
        loop {
            let solved = self.solve_in(region, (start.as_ref(), ratio), (state, load), work, callback);
            if let (Some(_), Err(SolveError::NotConverged { .. })) = (ratio, &solved) {
                work.end_point_increments += 1;
                ratio = None;
                continue;
            }
            let (solved, after, outcome) = solved?;
            self.check_equilibrium(load, &outcome)?;
            self.check_across(&after)?;
            if self.touches_edge(&after.pressure) {
                return Err(SolveError::ContactAtEdge);
            }
            let same_pressure = self.memory.last.as_ref().filter(|last| {
                self.coupling != Coupling::Coupled
                    && self.settings.reuse_pressure
                    && last.region == region
                    && last.load.normal == load.normal
                    && last.load.tilt == load.tilt
            });
            let (gap, contact_area) = if let Some(last) = same_pressure {
                (last.gap.clone(), last.contact_area)
            } else {
                let gap = self.gap_everywhere(region, &solved, &after, work)?;
                if self.overlaps_outside(region, &gap) {
                    region = Region::whole(self.grid.cells());
                    start = start.map(|_| after.pressure);
                    continue;
                }
                (gap, self.contact_area(region, &solved))
            };
            let last = self.memory.last.take();
            let contact_area_before = last.as_ref().map_or(0.0, |last| last.contact_area);
            let (gap_before, drift_before) = last.map(|last| (last.gap, last.drift)).unzip();
            let previous = self.memory.last_load.replace(*load);
            self.memory.before = previous.map(|load| Before {
                load,
                tractions: GridTractions::of(state),
                contact_area: contact_area_before,
                gap: gap_before.filter(|_| ratio.is_some()),
                drift: drift_before.filter(|_| ratio.is_some()),
            });
            let motion =
                [after.shift[0] - state.shift[0], after.shift[1] - state.shift[1], after.twist - state.twist];
            let drift = Drift {
                region: Some(region),
                field: solved.drift,
                motion,
                strain: self.stretch(state, load).strain,
                ratio: ratio.unwrap_or(1.0),
            };
            self.memory.last = Some(LastIncrement {
                region,
                displacements: solved.displacements,
                drift: if follows { drift } else { Drift::default() },
                gap: gap.clone(),
                contact_area,
                load: *load,
            });
            let fraction = outcome.stick_cells as f64 / outcome.contact_cells.max(1) as f64;
            let stick_area = contact_area * fraction;
            return Ok(Increment { state: after, outcome, contact_area, stick_area, gap, work: *work });
        }
    }

    /// One increment with all contact inside `region`, from the pressure `start` when there is one.
    fn solve_in(
        &mut self,
        region: Region,
        (start, ratio): (Option<&Array2<f64>>, Option<f64>),
        (state, load): (&ContactState, &LoadStep),
        work: &mut Work,
        callback: IterationCallback<'_>,
    ) -> Result<(Solved, ContactState, Outcome), SolveError> {
        let grid = self.grid;
        let periodic = self.response.is_periodic();
        let mut increment = IncrementProblem::new(
            &grid,
            &self.undeformed,
            &self.friction,
            (state, load),
            region,
            periodic,
            (start, self.stretch(state, load)),
        );
        if let Some(solved) = increment.apart() {
            let (after, outcome) = settle::settle(&increment, &solved);
            return Ok((solved, after, outcome));
        }
        let coupled = self.coupling == Coupling::Coupled;
        let grown = start.filter(|_| coupled).and_then(|pressure| self.grown_to(pressure, state));
        let predicted = grown.unwrap_or_else(|| self.extrapolated(state, load));
        let tractions = Tractions {
            pressure: region.gather(&predicted.0),
            shear: region.gather_tangential(&predicted.1),
        };
        let mut operators = self.operators_for(region)?;
        let counted =
            (operators.compliance.applications, operators.preconditioner.passes, operators.direct_solves);
        let beyond = |before: &Before, drift: &Drift| {
            increment.drift_to_here(before, drift, &mut operators, self.coupling)
        };
        if let Some(path) = ratio.and_then(|ratio| slip_path(&self.memory, state, (ratio, region), beyond)) {
            increment.path = path;
        }
        let last = self.memory.last.as_ref().filter(|last| last.region == region);
        let unchanged =
            last.is_some_and(|last| last.load.normal == load.normal && last.load.tilt == load.tilt);
        let last = last.map(|last| &last.displacements);
        let cells = || Ok(CellResponse::new(&self.response, self.grid.cells(), self.symmetry)?);
        let method = Method { coupling: self.coupling, settings: &self.settings, cells: &cells };
        let solved = increment.solve(tractions, (last, unchanged), &mut operators, &method, callback);
        let applications = operators.compliance.applications - counted.0;
        work.convolutions += applications;
        let whole = (grid.len() * self.symmetry.copies()) as f64;
        work.full_grid_convolutions += applications as f64 * (region.len() as f64 / whole);
        work.preconditioner_passes += operators.preconditioner.passes - counted.1;
        work.direct_solves += operators.direct_solves - counted.2;
        self.operators = Some(operators);
        self.memory.region = Some(region);
        let solved = solved?;
        let (after, outcome) = settle::settle(&increment, &solved);
        work.outer_iterations += solved.iterations;
        Ok((solved, after, outcome))
    }

    /// The operators of a region; those of the last one when its shape is the same.
    fn operators_for(&mut self, region: Region) -> Result<RegionOperators, SolveError> {
        if let Some(mut operators) = self.operators.take()
            && operators.region.shape == region.shape
        {
            operators.region = region;
            return Ok(operators);
        }
        let waves = self.table.as_ref().map(|table| CellWaves { table, spacing: self.grid.spacing() });
        let single = self.settings.single_precision;
        let operators = OperatorSet {
            normal: true,
            tangential: self.coupling == Coupling::Uncoupled || self.settings.scheme == Scheme::Staggered,
            full: self.coupling == Coupling::Coupled,
            normal_from_all: false,
            shear_axis: self.shear_axis,
            symmetry: self.symmetry,
            single,
        };
        let tangential = self.coupling != Coupling::Frictionless;
        Ok(RegionOperators {
            region,
            compliance: SpectralCompliance::new(&self.response, region.shape, operators)?
                .working_in(&self.workspace),
            preconditioner: Preconditioner::new(
                &self.response,
                waves,
                region.shape,
                [true, tangential],
                self.shear_axis,
                self.symmetry,
                single,
            )?
            .working_in(&self.workspace),
            linear: LinearSolver::default(),
            direct_solves: 0,
        })
    }

    /// A pressure from coarser grids: for a first contact, and where the normal load changes much.
    fn pressure_from_coarse_grids(
        &mut self,
        state: &ContactState,
        load: &LoadStep,
        work: &mut Work,
        callback: IterationCallback<'_>,
    ) -> Result<Option<Array2<f64>>, SolveError> {
        let touched = state.pressure.iter().any(|p| *p > 0.0);
        let far = match (load.normal, self.memory.last_load.map(|last| last.normal)) {
            (Control::Force(now), Some(Control::Force(then)))
            | (Control::Motion(now), Some(Control::Motion(then))) => {
                (now - then).abs() > LARGE_CHANGE * now.abs()
            }
            _ => true,
        };
        // A coupled contact that has grown before goes on from itself.
        let goes_on = self.coupling == Coupling::Coupled && self.memory.before.is_some();
        if touched && (!far || goes_on) {
            return Ok(None);
        }
        let lowest = self.undeformed.iter().copied().fold(f64::INFINITY, f64::min);
        let prescribed = match load.normal {
            Control::Force(force) if force > 0.0 => {
                Prescribed { total: Some(force / self.grid.cell_area()), approach: 0.0 }
            }
            Control::Motion(approach) if approach > lowest => Prescribed { total: None, approach },
            _ => return Ok(None),
        };
        let spacing = self.grid.spacing();
        let grids = self.coarse.get_or_insert_with(|| {
            CoarseGrids::below(&self.response, &self.undeformed, spacing, self.symmetry)
        });
        grids.pressure_above(prescribed, self.table.as_ref(), &self.settings, work, callback)
    }

    /// By how much more the lower surface is strained than the upper one, in the increment.
    fn stretch(&self, state: &ContactState, load: &LoadStep) -> Stretch {
        let [before, after] =
            [state.bulk_stress, load.bulk_stress].map(|stress| self.bulk.relative_strain(stress));
        Stretch {
            strain: [after[0] - before[0], after[1] - before[1]],
            middle: self.middle,
            load: *load,
            rig: self.rig.of_part(self.symmetry.copies()),
        }
    }

    /// Whether the forces asked for are those of the solution: with a prescribed approach they may be more than friction carries.
    fn check_equilibrium(&self, load: &LoadStep, outcome: &Outcome) -> Result<(), SolveError> {
        self.check_friction_carries(load, outcome.resultants.normal, self.settings.tolerance)?;
        let reached = outcome.residual.equilibrium;
        if reached <= self.settings.tolerance {
            return Ok(());
        }
        Err(SolveError::NotConverged { reached, iterations: self.settings.max_newton_iterations })
    }

    /// Whether there is no shear across the one axis along which it acts: its displacement is left out, so that nothing else would
    /// tell.
    fn check_across(&self, state: &ContactState) -> Result<(), SolveError> {
        let Some(axis) = self.shear_axis else { return Ok(()) };
        let size = |field: &Array2<f64>| field.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
        let (across, bound) = (size(&state.shear[1 - axis]), self.friction.largest() * size(&state.pressure));
        if across <= self.settings.tolerance * bound {
            return Ok(());
        }
        let reached = if bound > 0.0 { across / bound } else { 1.0 };
        Err(SolveError::NotConverged { reached, iterations: self.settings.max_newton_iterations })
    }

    fn check_friction_carries(&self, load: &LoadStep, normal: f64, tolerance: f64) -> Result<(), SolveError> {
        let asked = tangential_force(load);
        let bound = self.friction.largest() * normal.max(0.0);
        if asked > bound * (1.0 + tolerance) {
            return Err(SolveError::AboveSliding { asked, bound });
        }
        Ok(())
    }
}

/// Size of the prescribed tangential force [force].
fn tangential_force(load: &LoadStep) -> f64 {
    let [x, y] = load.tangential.map(|control| match control {
        Control::Force(force) => force,
        Control::Motion(_) | Control::FarEnd(_) => 0.0,
    });
    x.hypot(y)
}

#[cfg(test)]
mod tests;
