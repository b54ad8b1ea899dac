//! One load increment: from the state before and the new loads to the state after.
//!
//! [`ContactSolver`] picks what the problem needs (pressure alone, pressure then shear: `sequential`; both together: `coupled`), works in
//! a region around the contact, and checks the rest of the grid once: `increment` is that loop. The laws stand in `laws`, the method for
//! pressure and shear together in `newton`, its linear problems in `linear`, the frictionless problem in `normal`. Theory: `docs/theory/contact-problem.md` and
//! `docs/theory/solution-algorithm.md`.

mod augmented_newton;
mod checks;
mod contact_edge;
mod contact_problem;
mod contact_set;
mod contact_vector;
mod coupled;
mod ends;
mod energy;
mod full_grid_check;
mod globalisation;
mod held_response;
mod increment;
mod increment_problem;
mod iterate;
mod last_cycle;
mod laws;
mod linear;
mod memory;
mod moving_edge;
mod nested_start;
mod newton;
mod normal;
mod normal_response;
mod operators;
mod outcome;
mod pace;
mod prescribed;
mod region;
mod region_fields;
mod relative_displacement;
mod sequential;
mod settings;
mod sliding_limit;
mod slip_history;
mod staggered;
mod start;
mod state_after;
mod stretch;
mod tilt;
mod tractions;
mod yielded;

use std::borrow::Cow;

use ndarray::Array2;

use crate::compliance::{SharedWorkspace, SpectralCompliance, SurfaceResponse};
use crate::kernel::ResponseTable;
use crate::model::{
    Beyond, BulkCompliance, ContactState, CoulombFriction, LoadStep, Periodicity, Rig, SurfaceGrid, Symmetry,
};

pub(crate) use contact_set::ContactSet;
pub(crate) use contact_vector::ContactVector;
pub(crate) use ends::Ends;
pub(crate) use last_cycle::NUMBERS as NUMBERS_OF_CYCLE;
pub(crate) use laws::complementarity::yields_from;
pub(crate) use laws::friction::{
    FrictionLaw, bounds_on_grid as friction_bounds, dissipation, slip_until_open,
};
pub(crate) use laws::limit::sliding_fraction;
pub(crate) use laws::slip_path::{end_of_chord, length_of_way, rate_since_touch};
pub(crate) use linear::Gmres;
pub(crate) use linear::preconditioner::{CellWaves, Preconditioner, SlipWeights};
pub use memory::SolverMemory;
pub(crate) use moving_edge::{Edge, SlipOfEdge, distance, moment_of_touch};
pub(crate) use outcome::worst;
pub use outcome::{Increment, Outcome, Regime, Residual, Resultants, Work};
pub(crate) use pace::{Pace, pace_of};
pub(crate) use region::Region;
pub use settings::{Carried, Coupling, IterationCallback, SolveError, SolverSettings};
pub(crate) use slip_history::{Then, path_after_slip, turn_after_stick, way_to_touch};

use held_response::HeldResponse;
pub use held_response::ResponseMaker;
use normal::coarse_grids::CoarseGrids;
use operators::RegionOperators;

/// Solves increments of one contact; of one with mirrors the part in front of them, which is what its grid, fields and memory hold.
/// Forces and other numbers are always those of the whole contact.
pub struct ContactSolver<'a> {
    grid: SurfaceGrid,
    undeformed: Array2<f64>,
    friction: Cow<'a, CoulombFriction>,
    /// The law over the grid in the state before an increment, where its maps have moved since then.
    friction_before: Option<CoulombFriction>,
    coupling: Coupling,
    response: HeldResponse<'a>,
    settings: SolverSettings,
    operators: Option<RegionOperators>,
    /// Normal displacement of the whole grid, to check what lies outside the region; none while the region is the grid.
    full_grid: Option<SpectralCompliance>,
    /// Where all operators work.
    workspace: SharedWorkspace,
    /// Frequency response of the pair, for the preconditioner.
    table: Option<ResponseTable>,
    /// Made when they are first asked for.
    coarse: Option<CoarseGrids>,
    memory: SolverMemory,
    /// Work since an increment was solved last: the next one that is counts what was spent on those that were not.
    work: Work,
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
    /// What lies beyond the edge of the grid.
    beyond: Beyond,
    /// Along which axes the grid has no edge.
    periodic: Periodicity,
    /// Slope of the upper body that is in the gap, and the gap without it.
    tilt: [f64; 2],
    level: Option<Array2<f64>>,
    /// The pressure at which the softer surface yields [pressure], and the gap without tilt before anything has yielded.
    hardness: Option<f64>,
    unyielded: Option<Array2<f64>>,
    /// By how much what lies between the surfaces gives under a unit of pressure [length/pressure].
    give: Option<Array2<f64>>,
    /// What moving surfaces add to the displacement before the next increment [length], and the cells that the contact may move by in it.
    carried: Option<[Array2<f64>; 2]>,
    /// What friction has dissipated in the cells in the increment at work, where it is asked for.
    friction_work: Option<Array2<f64>>,
    travel: usize,
    /// By how much moving surfaces change the gap before deformation in the next increment [length].
    moved: Option<Array2<f64>>,
    /// Where the bodies turn about in the next increment, and their moment counts [length].
    pole: [f64; 2],
    /// Cells that the contact travels over both surfaces by in the next increment.
    rolled: [f64; 2],
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
            friction_before: None,
            coupling,
            response: HeldResponse::Kept(response),
            settings,
            operators: None,
            full_grid: None,
            workspace: SharedWorkspace::default(),
            table: None,
            coarse: None,
            memory: SolverMemory::default(),
            work: Work::default(),
            in_region,
            shear_axis: None,
            symmetry: Symmetry::NONE,
            middle: [0.0; 2],
            bulk: BulkCompliance::NONE,
            rig: Rig::RIGID,
            beyond: Beyond::Body,
            periodic: Periodicity::NONE,
            tilt: [0.0; 2],
            level: None,
            hardness: None,
            unyielded: None,
            give: None,
            carried: None,
            friction_work: None,
            travel: 0,
            moved: None,
            pole: [0.0; 2],
            rolled: [0.0; 2],
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

    /// The same solver of bodies that go on beyond the grid, or of one that ends there.
    #[must_use]
    pub fn with_beyond(self, beyond: Beyond) -> Self {
        Self { beyond, ..self }
    }

    /// The same solver of a contact that repeats along an axis, whose coefficients are those with all images: there the grid has no edge.
    #[must_use]
    pub fn with_periods(self, periodic: Periodicity) -> Self {
        Self { periodic, ..self }
    }

    /// The same solver, which also knows the frequency response of the pair: for non-periodic problems, where coefficients on a region
    /// do not tell a preconditioner how a stiff coating bends.
    #[must_use]
    pub fn with_response_table(self, table: ResponseTable) -> Self {
        Self { table: Some(table), ..self }
    }

    /// The same solver, which gives the memory of the response back while no operators have to be made of it, and has it made again with the
    /// same bits: for large grids.
    #[must_use]
    pub fn with_response_made_by(self, make: ResponseMaker<'a>) -> Self {
        Self { response: self.response.made_again_by(make), ..self }
    }

    /// The same solver for a contact whose shear acts along one axis (0: x, 1: y) alone: nothing loads the other, and the bodies
    /// respond to a shear along it with no displacement across it.
    #[must_use]
    pub fn with_shear_axis(self, axis: Option<usize>) -> Self {
        Self { shear_axis: axis, ..self }
    }

    /// The same solver for a problem with mirrors: gap, friction and loads are their own mirror images, and cells even in number
    /// along mirrored axes. From here on the fields of states, of the gap and of friction are those in front of the mirrors.
    #[must_use]
    pub fn with_symmetry(self, symmetry: Symmetry) -> Self {
        let cells = symmetry.part_of(self.grid.cells());
        let (mirrored, size) = (symmetry.axes(), self.grid.size());
        Self {
            middle: [0, 1].map(|axis| if mirrored[axis] { 0.25 * size[axis] } else { 0.0 }),
            grid: SurfaceGrid::new(cells, self.grid.spacing()).unwrap_or(self.grid),
            undeformed: if symmetry.any() { symmetry.part(&self.undeformed) } else { self.undeformed },
            friction: match self.friction {
                Cow::Borrowed(friction) => symmetry.part_of_friction(friction),
                Cow::Owned(friction) => Cow::Owned(symmetry.part_of_friction(&friction).into_owned()),
            },
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

    /// The friction law in force.
    pub fn friction(&self) -> &CoulombFriction {
        &self.friction
    }

    /// Another friction law from the next increment on.
    pub fn set_friction(&mut self, friction: Cow<'a, CoulombFriction>) {
        self.friction = friction;
        self.friction_before = None;
    }

    /// The law over the grid in the state before the next increments, where its maps move in them: what slips dissipates under the mean of the
    /// bounds at both ends.
    pub fn set_friction_before(&mut self, friction: Option<CoulombFriction>) {
        self.friction_before = friction;
    }

    /// The laws over the grid before and after the last increment.
    pub fn laws(&self) -> [&CoulombFriction; 2] {
        [self.friction_before.as_ref().unwrap_or(&self.friction), &self.friction]
    }

    /// Friction has changed at once, between the last increment and the next, which does not go on from those before.
    pub fn forget_increments_before(&mut self) {
        self.memory.before = None;
    }

    /// Goes on with another undeformed gap [length], shape of the grid, without what has yielded, which is in the states: the displacements known
    /// so far hold no longer. Tractions, loads and the region of the last increment still do.
    pub fn set_gap(&mut self, undeformed: Array2<f64>) {
        self.move_gap(undeformed);
        self.forget_displacements();
    }

    /// Goes on with something between the surfaces that gives in each cell by so much under a unit of pressure [length/pressure], shape of the grid:
    /// the displacements known so far hold no longer.
    pub fn set_give(&mut self, give: Option<Array2<f64>>) {
        if self.give != give {
            self.give = give;
            self.full_grid = None;
            self.forget_displacements();
        }
    }

    /// What gives in the cells of a region [length/pressure]; nothing where nothing does.
    fn give_in(&self, region: Region) -> Vec<f64> {
        self.give.as_ref().map_or_else(Vec::new, |give| region.gather(give))
    }

    /// The undeformed gap in force [length].
    pub fn undeformed(&self) -> &Array2<f64> {
        &self.undeformed
    }

    /// Goes on with the undeformed gap [length] of surfaces that have moved: the displacements known so far, which are those of the
    /// tractions, still hold.
    pub fn move_gap(&mut self, undeformed: Array2<f64>) {
        self.undeformed = undeformed;
        self.unyielded = None;
        self.coarse = None;
        let tilt = std::mem::take(&mut self.tilt);
        self.level = None;
        self.set_tilt(tilt);
    }

    /// The bodies have been carried over the grid by whole cells along each axis, with all that is known of their last states. What was remembered
    /// before.
    pub fn carry_memory(&mut self, cells: [isize; 2]) -> SolverMemory {
        let ends_inside = self.beyond.is_body() && self.periodic.is_none();
        let carried = self.memory.carried(cells, ends_inside);
        std::mem::replace(&mut self.memory, carried)
    }

    /// Another bound on the residuals from the next increment on.
    pub fn set_tolerance(&mut self, tolerance: f64) {
        self.settings.tolerance = tolerance;
    }

    /// In the next increments the contact travels over both surfaces by so many cells along each axis: tractions are looked for first where it
    /// will be.
    pub fn set_rolled(&mut self, cells: [f64; 2]) {
        self.rolled = cells;
    }

    /// What surfaces that move by `cells` along each axis in the next increments add to the tangential displacement before [length], shape of the
    /// grid: displacements that were elsewhere in the state before; and by how much they have changed the gap before deformation since then.
    pub fn set_carried(
        &mut self,
        carried: Option<[Array2<f64>; 2]>,
        moved: Option<Array2<f64>>,
        cells: [f64; 2],
    ) {
        self.carried = carried;
        self.moved = moved;
        let [nx, ny] = self.grid.cells();
        self.travel = (cells[0].abs().max(cells[1].abs()).ceil() as usize).min(nx.max(ny));
    }

    /// In the next increments the bodies turn about a place [length], and the moment counts about it: the middle of the grid otherwise.
    pub fn set_pole(&mut self, pole: [f64; 2]) {
        self.pole = pole;
    }

    /// Goes on with bodies that respond otherwise; `table`: their frequency response, where it is used. As with another gap, the displacements
    /// known so far hold no longer.
    pub fn set_response(&mut self, response: SurfaceResponse, table: Option<ResponseTable>) {
        self.response = HeldResponse::Kept(response);
        self.table = table;
        self.operators = None;
        self.full_grid = None;
        self.coarse = None;
        self.forget_displacements();
    }

    /// Surfaces or bodies are others now: the displacements known so far hold no longer.
    pub fn forget_displacements(&mut self) {
        self.memory.last = None;
        self.memory.before = None;
    }

    /// Solves one increment: from `state`, which the increment before returned, to the loads and motions of `load`, which are those of the
    /// whole contact.
    ///
    /// # Errors
    /// When the equations cannot be satisfied, the loads have no equilibrium, or the contact reaches the grid's edge.
    pub fn step(
        &mut self,
        state: &ContactState,
        load: &LoadStep,
        callback: IterationCallback<'_>,
    ) -> Result<Increment, SolveError> {
        // Work of an attempt that failed counts; which rule it ended by does not.
        self.work.end_point_increments = 0;
        let symmetry = self.symmetry;
        let solved = if symmetry.any() {
            self.solve_tilted(state, &symmetry.part_of_load(load, state), callback)
                .map(|increment| Increment { outcome: increment.outcome.of_whole(symmetry), ..increment })
                .map_err(|error| error.of_whole(symmetry.copies()))
        } else {
            self.solve_tilted(state, load, callback)
        };
        solved.map(|increment| Increment { work: std::mem::take(&mut self.work), ..increment })
    }
}

#[cfg(test)]
mod tests;
