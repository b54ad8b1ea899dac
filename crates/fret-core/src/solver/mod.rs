//! One load increment: from the state before and the new loads to the state after.
//!
//! [`ContactSolver`] picks what the scene needs (pressure alone, pressure then shear, or both together), works in a box
//! around the contact, and checks the rest of the grid once.

mod active_set;
mod alternating;
mod components;
mod contact_set;
mod coulomb;
mod coupled;
mod elastic_answer;
mod feasible;
mod fronts;
mod frozen;
mod frozen_zones;
mod growth;
mod inverse;
mod krylov;
mod memory;
mod nested;
mod normal;
mod normal_problem;
mod outside;
mod packed;
mod patience;
mod preconditioner;
mod prediction;
mod region;
mod residual;
mod retraction;
mod rigid;
mod rough_look;
mod scene;
mod settings;
mod shear;
mod shortcut;
mod starting_shear;
mod tractions;
mod units;
mod zones;

use std::borrow::Cow;

use ndarray::Array2;

use crate::compliance::{SpectralCompliance, SurfaceResponse, Wanted};
use crate::history::Work;
use crate::kernel::ResponseTable;
use crate::model::{ContactState, Control, CoulombFriction, LoadStep, Scheme, SurfaceGrid, Symmetry};
use fret_fft::ConvolutionError;

pub use memory::SolverMemory;
pub use scene::{Outcome, Resultants};
pub use settings::{Coupling, SolveError, SolverSettings, Watch};
pub use shortcut::{LeaveOut, Shortcut};

use frozen::KrylovMemory;
use memory::{Before, GridTractions, Settled};
use nested::{CoarseGrids, Prescribed};
use outside::touches_edge;
use preconditioner::{Preconditioner, Waves};
use region::Region;
use scene::{BoxOperators, Scene, Solved, Turn};
use tractions::Tractions;

/// A solved increment.
#[derive(Debug)]
pub struct Increment {
    /// Tractions, motions and history after the increment.
    pub state: ContactState,
    /// Resultants, counts, residuals.
    pub outcome: Outcome,
    /// Area of contact [length^2], from its edge between the cells.
    pub contact_area: f64,
    /// Area that sticks [length^2]: the share of the cells in contact that stick.
    pub stick_area: f64,
    /// Gap on the whole grid [length].
    pub gap: Array2<f64>,
    /// Work spent.
    pub work: Work,
}

impl Increment {
    /// The increment of a scene with mirrors from what lies in front of them.
    fn made_whole(self, symmetry: Symmetry) -> Self {
        let copies = symmetry.copies();
        let Outcome { resultants: Resultants { normal, tangential, moment }, .. } = self.outcome;
        let resultants = Resultants {
            normal: normal * copies as f64,
            tangential: symmetry.whole_force(tangential),
            moment,
        };
        Self {
            state: symmetry.whole_state(&self.state),
            outcome: Outcome {
                resultants,
                contact_cells: self.outcome.contact_cells * copies,
                stick_cells: self.outcome.stick_cells * copies,
                ..self.outcome
            },
            gap: symmetry.whole(&self.gap, [false; 2]),
            ..self
        }
    }
}

/// A normal load changes much when it changes by more than this share: starting on coarse grids is then cheaper than from the
/// pressure before.
const LARGE_CHANGE: f64 = 0.03;

/// Solves increments of one scene; of one with mirrors what lies in front of them, which is what its grid, fields and memory hold.
pub struct ContactSolver<'a> {
    grid: SurfaceGrid,
    undeformed: Array2<f64>,
    friction: Cow<'a, CoulombFriction>,
    coupling: Coupling,
    response: SurfaceResponse,
    settings: SolverSettings,
    operators: Option<BoxOperators>,
    /// Normal displacement of the whole grid, to check what lies outside the box.
    outside: Option<SpectralCompliance>,
    /// Response of the pair to waves, for the preconditioner of pressure.
    table: Option<ResponseTable>,
    /// Made when they are first asked for.
    coarse: Option<CoarseGrids>,
    memory: SolverMemory,
    /// Work of steps that were not solved; the next one that is counts it.
    in_vain: Work,
    boxed: bool,
    /// The one axis along which shear acts.
    along: Option<usize>,
    symmetry: Symmetry,
}

impl<'a> ContactSolver<'a> {
    /// Solver of a scene. `boxed`: iterate in a box around the contact where that is smaller than the grid.
    pub fn new(
        grid: SurfaceGrid,
        undeformed: Array2<f64>,
        friction: &'a CoulombFriction,
        coupling: Coupling,
        response: SurfaceResponse,
        settings: SolverSettings,
        boxed: bool,
    ) -> Self {
        Self {
            grid,
            undeformed,
            friction: Cow::Borrowed(friction),
            coupling,
            response,
            settings,
            operators: None,
            outside: None,
            table: None,
            coarse: None,
            memory: SolverMemory::default(),
            in_vain: Work::default(),
            boxed,
            along: None,
            symmetry: Symmetry::NONE,
        }
    }

    /// The same solver, which also knows how the pair answers waves: for free space, where coefficients on a box do not tell a
    /// preconditioner how a stiff coating bends.
    #[must_use]
    pub fn with_waves(self, table: ResponseTable) -> Self {
        Self { table: Some(table), ..self }
    }

    /// The same solver for a scene whose shear acts along one axis (0: x, 1: y) alone: nothing loads the other, and the bodies
    /// answer a shear along it with no displacement across it.
    #[must_use]
    pub fn sheared_along(self, axis: Option<usize>) -> Self {
        Self { along: axis, ..self }
    }

    /// The same solver for a scene with mirrors: gap, friction and loads are their own mirror images, and cells even in number
    /// along mirrored axes. States pass in and out whole.
    #[must_use]
    pub fn mirrored(self, symmetry: Symmetry) -> Self {
        let cells = symmetry.part_of(self.grid.cells());
        Self {
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

    /// Goes on with the memory of another solver of the same scene: the next increments have the bits they would have there.
    pub fn remember(&mut self, memory: SolverMemory) {
        self.memory = memory;
    }

    /// Another law of friction from the next increment on.
    pub fn rub_with(&mut self, friction: &'a CoulombFriction) {
        self.friction = if self.symmetry.any() {
            Cow::Owned(self.symmetry.part_of_friction(friction))
        } else {
            Cow::Borrowed(friction)
        };
    }

    /// Goes on with another undeformed gap [length], shape of the grid: what was settled before holds no longer. Tractions, loads
    /// and the box of the last increment still do.
    pub fn reshape(&mut self, undeformed: Array2<f64>) {
        self.undeformed = if self.symmetry.any() { self.symmetry.part(&undeformed) } else { undeformed };
        self.coarse = None;
        self.memory.settled = None;
        self.memory.before = None;
    }

    /// Solves one increment: from `state`, which the step before returned, to the loads and motions of `load`.
    ///
    /// # Errors
    /// When the equations cannot be satisfied, the loads have no equilibrium, or the contact reaches the grid's edge.
    pub fn step(
        &mut self,
        state: &ContactState,
        load: &LoadStep,
        watch: Watch<'_>,
    ) -> Result<Increment, SolveError> {
        let mut work = std::mem::take(&mut self.in_vain);
        let symmetry = self.symmetry;
        let solved = if symmetry.any() {
            let part = symmetry.part_of_state(state);
            self.solved(&part, &symmetry.part_of_load(load, state), &mut work, watch)
                .map(|increment| increment.made_whole(symmetry))
                .map_err(|error| error.of_whole(symmetry.copies()))
        } else {
            self.solved(state, load, &mut work, watch)
        };
        match solved {
            Ok(increment) => Ok(Increment { work, ..increment }),
            Err(error) => {
                self.in_vain = work;
                Err(error)
            }
        }
    }

    fn solved(
        &mut self,
        state: &ContactState,
        load: &LoadStep,
        work: &mut Work,
        watch: Watch<'_>,
    ) -> Result<Increment, SolveError> {
        self.check_sliding(load)?;
        let mut start = self.nested_start(state, load, work, watch)?;
        let mut region = match &start {
            Some(pressure) => self.region_around(pressure, state),
            None => self.region_for(state, load),
        };
        let area_before = self.memory.settled.as_ref().map_or(0.0, |settled| settled.contact_area);
        loop {
            let (solved, state_after, outcome) = self
                .step_in(region, start.as_ref(), (state, load), work, watch)
                .map_err(|error| self.explained(error, state, load))?;
            self.check_equilibrium(load, &outcome)?;
            self.check_across(&state_after)?;
            if !self.response.is_periodic() && touches_edge(&state_after.pressure, self.symmetry.axes()) {
                return Err(SolveError::ContactAtEdge);
            }
            let kept = self.memory.settled.take().filter(|settled| {
                self.coupling != Coupling::Coupled
                    && self.settings.leave_out.takes(Shortcut::Pressure)
                    && settled.region == region
                    && settled.load.normal == load.normal
            });
            let (gap, contact_area) = if let Some(settled) = kept {
                (settled.gap, settled.contact_area)
            } else {
                let gap = self.gap_everywhere(region, &solved, &state_after, work);
                if self.overlaps_outside(region, &gap) {
                    region = Region::whole(self.grid.cells());
                    start = start.map(|_| state_after.pressure);
                    continue;
                }
                let area = self.contact_area(region, &solved);
                (gap, area)
            };
            let previous = self.memory.last_load.replace(*load);
            self.memory.before = previous.map(|load| Before {
                load,
                tractions: GridTractions::of(state),
                contact_area: area_before,
            });
            self.memory.settled = Some(Settled {
                region,
                displacements: solved.displacements,
                gap: gap.clone(),
                contact_area,
                load: *load,
            });
            let share = outcome.stick_cells as f64 / outcome.contact_cells.max(1) as f64;
            let stick_area = contact_area * share;
            return Ok(Increment { state: state_after, outcome, contact_area, stick_area, gap, work: *work });
        }
    }

    fn check_sliding(&self, load: &LoadStep) -> Result<(), SolveError> {
        match load.normal {
            Control::Force(normal) => self.check_friction_carries(load, normal, 1e-12),
            Control::Motion(_) => Ok(()), // what force it makes is known afterwards
        }
    }

    /// Whether the forces asked for are those of the solution: with a prescribed approach they may be more than friction carries.
    fn check_equilibrium(&self, load: &LoadStep, outcome: &Outcome) -> Result<(), SolveError> {
        self.check_friction_carries(load, outcome.resultants.normal, self.settings.tolerance)?;
        let reached = outcome.residual.equilibrium;
        if reached <= self.settings.tolerance {
            return Ok(());
        }
        Err(SolveError::NotConverged { reached, iterations: self.settings.most_outer_iterations })
    }

    /// Whether there is no shear across the one axis along which it acts: its displacement is left out, so that nothing else would
    /// tell.
    fn check_across(&self, state: &ContactState) -> Result<(), SolveError> {
        let Some(axis) = self.along else { return Ok(()) };
        let size = |field: &Array2<f64>| field.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
        let (across, bound) = (size(&state.shear[1 - axis]), self.friction.largest() * size(&state.pressure));
        if across <= self.settings.tolerance * bound {
            return Ok(());
        }
        let reached = if bound > 0.0 { across / bound } else { 1.0 };
        Err(SolveError::NotConverged { reached, iterations: self.settings.most_outer_iterations })
    }

    fn check_friction_carries(&self, load: &LoadStep, normal: f64, tolerance: f64) -> Result<(), SolveError> {
        let [x, y] = load.tangential.map(|control| match control {
            Control::Force(force) => force,
            Control::Motion(_) => 0.0,
        });
        let asked = x.hypot(y);
        let bound = self.friction.largest() * normal.max(0.0);
        if asked > bound * (1.0 + tolerance) {
            return Err(SolveError::AboveSliding { asked, bound });
        }
        Ok(())
    }

    /// A pressure from coarser grids: for a first contact, and where the normal load changes much.
    fn nested_start(
        &mut self,
        state: &ContactState,
        load: &LoadStep,
        work: &mut Work,
        watch: Watch<'_>,
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
        let knows = self.coupling == Coupling::Coupled && self.memory.before.is_some();
        if touched && (!far || knows) {
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
        grids.pressure_above(prescribed, self.table.as_ref(), &self.settings, work, watch)
    }

    /// A map carries what its coefficients times the pressure sum to, which is known from the pressure before: an increment that
    /// asks for more has no equilibrium, and did not converge for that reason.
    fn explained(&self, error: SolveError, state: &ContactState, load: &LoadStep) -> SolveError {
        let (SolveError::NotConverged { .. }, CoulombFriction::Map(map), Control::Force(normal)) =
            (&error, &*self.friction, load.normal)
        else {
            return error;
        };
        let part = |control| if let Control::Force(force) = control { force } else { 0.0 };
        let asked = part(load.tangential[0]).hypot(part(load.tangential[1]));
        let pressed: f64 = state.pressure.iter().sum();
        let carried: f64 = map.iter().zip(&state.pressure).map(|(mu, p)| mu * p).sum();
        let bound = carried / pressed * normal;
        if asked > bound { SolveError::AboveSliding { asked, bound } } else { error }
    }

    /// The operators of a box; those of the last box when its shape is the same.
    fn operators_for(&mut self, region: Region) -> Result<BoxOperators, ConvolutionError> {
        if let Some(mut operators) = self.operators.take()
            && operators.region.shape == region.shape
        {
            operators.region = region;
            return Ok(operators);
        }
        let waves = self.table.as_ref().map(|table| Waves { table, spacing: self.grid.spacing() });
        let single = self.settings.six_digits;
        let wanted = Wanted {
            normal: true,
            tangential: self.coupling == Coupling::Uncoupled || self.settings.scheme == Scheme::Alternating,
            full: self.coupling == Coupling::Coupled,
            normal_from_all: false,
            along: self.along,
            symmetry: self.symmetry,
            single,
        };
        let tangential = self.coupling != Coupling::Frictionless;
        Ok(BoxOperators {
            region,
            compliance: SpectralCompliance::new(&self.response, region.shape, wanted)?,
            preconditioner: Preconditioner::new(
                &self.response,
                waves,
                region.shape,
                [true, tangential],
                self.along,
                self.symmetry,
                single,
            )?,
            krylov: KrylovMemory::default(),
        })
    }

    /// One increment with all contact inside `region`, from the pressure `start` when there is one.
    fn step_in(
        &mut self,
        region: Region,
        start: Option<&Array2<f64>>,
        (state, load): (&ContactState, &LoadStep),
        work: &mut Work,
        watch: Watch<'_>,
    ) -> Result<(Solved, ContactState, Outcome), SolveError> {
        let grid = self.grid;
        let mut scene = Scene::new(
            &grid,
            &self.undeformed,
            &self.friction,
            state,
            load,
            region,
            self.response.is_periodic(),
        );
        if let Some(pressure) = start {
            scene = scene.starting_from(pressure);
        }
        if scene.is_apart() {
            let solved = scene.apart();
            let (after, outcome) = scene.settle(&solved);
            return Ok((solved, after, outcome));
        }
        let coupled = self.coupling == Coupling::Coupled;
        let grown = start.filter(|_| coupled).and_then(|pressure| self.grown_to(pressure, state));
        let predicted = grown.unwrap_or_else(|| self.predicted(state, load));
        let tractions = Tractions {
            pressure: region.gather(&predicted.0),
            shear: region.gather_tangential(&predicted.1),
        };
        let mut operators = self.operators_for(region).map_err(|_| SolveError::OperatorsMissing)?;
        let counted = (operators.compliance.applications, operators.preconditioner.passes);
        let settled = self.memory.settled.as_ref().filter(|settled| settled.region == region);
        let displaced = settled.map(|settled| &settled.displacements);
        let leave_out = self.settings.leave_out;
        let unchanged = leave_out.takes(Shortcut::Pressure)
            && settled.is_some_and(|settled| settled.load.normal == load.normal);
        let solved = match self.coupling {
            Coupling::Coupled => scene.together(tractions, displaced, &mut operators, &self.settings, watch),
            Coupling::Uncoupled | Coupling::Frictionless => {
                let turn = Turn {
                    unchanged,
                    frictionless: self.coupling == Coupling::Frictionless,
                    waits_for_a_cause: leave_out.takes(Shortcut::Tangential),
                };
                scene.in_turn(tractions, displaced, turn, &mut operators, &self.settings, watch)
            }
        };
        let applications = operators.compliance.applications - counted.0;
        work.convolutions += applications;
        let whole = (grid.len() * self.symmetry.copies()) as f64;
        work.full_grid_convolutions += applications as f64 * (region.len() as f64 / whole);
        work.preconditioner_passes += operators.preconditioner.passes - counted.1;
        self.operators = Some(operators);
        self.memory.region = Some(region);
        let solved = solved?;
        work.outer_iterations += solved.iterations;
        let (after, outcome) = scene.settle(&solved);
        Ok((solved, after, outcome))
    }
}

#[cfg(test)]
mod tests {
    use std::ops::ControlFlow;

    use super::*;
    use crate::kernel::{Components, influence_coefficients};
    use crate::model::{Base, Body, ContactPair, ElasticMaterial, HalfSpace};

    #[test]
    fn shear_across_the_one_axis_is_not_certified() {
        let material = ElasticMaterial::new(1.0, 0.0).unwrap();
        let body = || Body::Elastic(HalfSpace::new(Vec::new(), Base::Elastic(material)).unwrap());
        let pair = ContactPair::new(body(), body()).unwrap();
        let (cells, spacing) = ([32; 2], [2.6 / 32.0; 2]);
        let grid = SurfaceGrid::new(cells, spacing).unwrap();
        let gap = Array2::from_shape_fn((32, 32), |(i, j)| {
            0.5 * (grid.centre(0, i).powi(2) + grid.centre(1, j).powi(2))
        });
        let response =
            SurfaceResponse::FreeSpace(influence_coefficients(&pair, cells, spacing, Components::ALL));
        let friction = CoulombFriction::Uniform(0.5);
        let settings = SolverSettings::new(1e-8);
        let mut solver =
            ContactSolver::new(grid, gap, &friction, Coupling::Uncoupled, response, settings, true)
                .sheared_along(Some(0));
        let load = |pull| LoadStep {
            normal: Control::Force(0.5),
            tangential: [Control::Force(pull), Control::Force(0.0)],
            twist: Control::Motion(0.0),
        };
        let go_on: Watch<'_> = &mut |_, _| ControlFlow::Continue(());
        let mut state = solver.step(&ContactState::untouched(cells), &load(0.0), go_on).unwrap().state;
        solver.step(&state, &load(0.1), go_on).unwrap();
        // Some shear across with no resultant, well inside the friction bound.
        state.shear[1][[15, 16]] = 1e-3;
        state.shear[1][[16, 16]] = -1e-3;
        assert!(matches!(solver.step(&state, &load(0.1), go_on), Err(SolveError::NotConverged { .. })));
    }
}
