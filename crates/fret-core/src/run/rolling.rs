//! Increments of a contact that rolls along both surfaces: where the bodies lie over the grid, or the grid over the bodies.

use std::borrow::Cow;

use ndarray::{Array2, Axis};

use super::turn_by_moment::TurnByMoment;
use crate::fields::{Outside, carried, carried_by_whole_cells};
use crate::model::{
    BeyondMaps, ContactState, CoulombFriction, Frame, LoadStep, Profile, SurfaceGrid, Symmetry,
};
use crate::plan::Plan;
use crate::solver::{ContactSolver, Increment, IterationCallback, SolveError, Work};

/// So much of a cell is rounding: numbers of cells are sums of lengths.
const ROUNDING: f64 = 1e-6;
/// And of a way between two such sums, which a plan has found to be whole.
const WHOLE: f64 = 1e-4;
/// Rounds in which the turn that follows from a moment is found in alternation with the place about which it is.
const MOST_ROUNDS: usize = 12;
/// Two turns are one where they differ by this part of themselves: what half a step does to the place changes slip by less.
const SAME_TURN: f64 = 1e-7;
/// So they are where half a step makes of their difference less than this part of the residual that is accepted, of the approach: a turn that is
/// none, by symmetry say, is found as what the solver leaves of it.
const NO_TURN: f64 = 0.01;

/// What lies beyond the maps of bodies whose places travel through the grid of a plan; `None` where none does.
fn passing(plan: &Plan) -> Option<Outside> {
    let case = &plan.case;
    let mut laws = case.stages.iter().filter_map(|stage| stage.friction.as_ref()).chain([&case.friction]);
    let travel = case.kinematics.frame == Frame::Contact
        && (!case.profile.heights.is_empty() || laws.any(CoulombFriction::is_map));
    travel.then(|| case.kinematics.beyond_maps.map_or(Outside::Edge, BeyondMaps::outside))
}

/// A contact that rolls along both surfaces. Fields are those in front of the mirrors.
pub struct Rolling {
    pub(super) grid: SurfaceGrid,
    /// Bound on the residuals of each increment.
    pub(super) tolerance: f64,
    symmetry: Symmetry,
    frame: Frame,
    profile: Profile,
    /// What lies beyond the maps of the bodies, where their places travel through a grid that goes with the contact; `None` where none does.
    passing: Option<Outside>,
    /// A friction law with maps that travel so.
    friction: Option<CoulombFriction>,
    /// Where gap and friction that the solver has are those of, in cells; `None`: nowhere any more.
    at: Option<[f64; 2]>,
}

impl Rolling {
    /// Of a plan.
    pub fn of(plan: &Plan) -> Self {
        Self {
            grid: plan.grid,
            tolerance: plan.case.tolerance,
            symmetry: plan.symmetry,
            frame: plan.case.kinematics.frame,
            profile: plan.case.profile.clone(),
            passing: passing(plan),
            friction: None,
            at: None,
        }
    }

    /// Another friction law from now on, over the grid where the contact has not rolled.
    pub fn set_friction(&mut self, friction: &CoulombFriction) {
        if self.passing.is_some() {
            self.friction = friction.is_map().then(|| friction.clone());
            self.at = None;
        }
    }

    /// A state before an increment on the cells where its places are after it.
    pub fn brought_to<'s>(&self, state: &'s ContactState, after: &ContactState) -> Cow<'s, ContactState> {
        let by = self.cells_between(state.roll, after.roll);
        if self.frame == Frame::Bodies || by == [0.0; 2] {
            return Cow::Borrowed(state);
        }
        Cow::Owned(state.carried(by.map(|by| -by)))
    }

    /// The surfaces have worn: the gap that the solver has is that of no place.
    pub fn forget_place(&mut self) {
        self.at = None;
    }

    /// Cells that a distance is along each axis, whole ones where rounding has made less or more of them. Along a line contact nothing rolls.
    fn cells(&self, roll: [f64; 2]) -> [f64; 2] {
        let cells = |axis: usize| {
            let cells = roll[axis] / self.grid.spacing()[axis];
            if (cells - cells.round()).abs() < ROUNDING { cells.round() } else { cells }
        };
        self.grid.dimension().along(cells, 0.0)
    }

    /// Cells from a state to a load; with the contact the grid moves by whole ones, whatever rounding has made of sums of lengths.
    fn way(&self, state: &ContactState, load: &LoadStep) -> [f64; 2] {
        self.cells_between(state.roll, load.roll)
    }

    fn cells_between(&self, from: [f64; 2], to: [f64; 2]) -> [f64; 2] {
        let [from, to] = [from, to].map(|roll| self.cells(roll));
        let by = [0, 1].map(|axis| to[axis] - from[axis]);
        if self.frame == Frame::Contact { by.map(f64::round) } else { by }
    }

    /// Whether the grid can be where a load says: with the contact it moves by whole cells.
    pub fn may_stop_at(&self, state: &ContactState, load: &LoadStep) -> bool {
        let [from, to] = [state.roll, load.roll].map(|roll| self.cells(roll));
        let is_whole = |axis: usize| {
            let by = to[axis] - from[axis];
            (by - by.round()).abs() < WHOLE
        };
        self.frame == Frame::Bodies || (0..2).all(is_whole)
    }

    /// Whether a grid that goes with a contact knows what it leaves behind: tractions of the state before, and of the one before that, carried back
    /// by the cells of an increment each. With one open cell in place of two Carter's steady force
    /// is off by 2.4 %, and steady states of balls are not found.
    pub(super) fn is_held(&self, pressure: &Array2<f64>, by: [f64; 2]) -> bool {
        let holds = |axis: usize| {
            let wanted = (2.0 * by[axis].abs()) as usize;
            let touches: Vec<bool> =
                pressure.axis_iter(Axis(axis)).map(|lane| lane.iter().any(|p| *p > 0.0)).collect();
            let beside =
                |touches: &mut dyn Iterator<Item = &bool>| touches.take_while(|touches| !**touches).count();
            beside(&mut touches.iter()).min(beside(&mut touches.iter().rev())) >= wanted
        };
        self.frame == Frame::Bodies || (0..2).all(|axis| by[axis] == 0.0 || holds(axis))
    }

    /// Solves one increment of a contact that rolls to where a load says, see [`Rolling::advance`].
    ///
    /// # Errors
    /// As [`ContactSolver::step`]; that the contact reaches the edge, where a grid that goes with it does not know what it leaves behind.
    pub fn step(
        &mut self,
        solver: &mut ContactSolver<'_>,
        state: &ContactState,
        load: &LoadStep,
        watch: IterationCallback<'_>,
    ) -> Result<Increment, SolveError> {
        if !self.is_held(&state.pressure, self.way(state, load)) {
            return Err(SolveError::ContactAtEdge);
        }
        self.advance(solver, state, load, watch)
    }

    /// As [`Rolling::step`], whatever lies open beside the contact. A turn that follows from a moment is found in rounds: what the place half-way
    /// adds to it is that of the turn that is taken.
    ///
    /// # Errors
    /// As [`ContactSolver::step`]; that the turn wanders, when the rounds do not end.
    pub(super) fn advance(
        &mut self,
        solver: &mut ContactSolver<'_>,
        state: &ContactState,
        load: &LoadStep,
        watch: IterationCallback<'_>,
    ) -> Result<Increment, SolveError> {
        if load.twist.force().is_none() {
            let turned = load.twist.motion().map_or(0.0, |twist| twist - state.twist);
            return self.turned(solver, state, (load, turned), watch);
        }
        let by = self.way(state, load);
        let spacing = self.grid.spacing();
        let half_step = 0.5 * (by[0] * spacing[0]).hypot(by[1] * spacing[1]);
        let memory = solver.memory().clone();
        let (mut taken, mut work, mut turn) = (0.0, Work::default(), TurnByMoment::default());
        let mut apart = 0.0_f64;
        for _ in 0..MOST_ROUNDS {
            let mut solved = self.turned(solver, state, (load, taken), watch)?;
            work += solved.work;
            let found = solved.state.twist - state.twist;
            apart = (found - taken).abs() * half_step;
            let none = NO_TURN * self.tolerance * solved.state.approach.abs();
            if apart <= (SAME_TURN * found.abs() * half_step).max(none) {
                solved.work = work;
                return Ok(solved);
            }
            solver.restore_memory(memory.clone());
            taken = turn.next([taken, found], by);
        }
        Err(SolveError::Wanders { apart: apart / spacing[0].min(spacing[1]), rounds: MOST_ROUNDS })
    }

    /// In the frame of the bodies with the gap there, in that of the contact from the state before, carried back by the cells that the grid goes
    /// ahead. A rotation is about the middle of the contact, which goes along: in all about where it is half-way, and so much more than about its end
    /// is added for a turn that is `turned` [rad].
    fn turned(
        &mut self,
        solver: &mut ContactSolver<'_>,
        state: &ContactState,
        (load, turned): (&LoadStep, f64),
        watch: IterationCallback<'_>,
    ) -> Result<Increment, SolveError> {
        let [from, to] = [state.roll, load.roll].map(|roll| self.cells(roll));
        let by = self.way(state, load);
        // A moment is one about the middle of the contact.
        let is_by_moment = load.twist.force().is_some();
        let middle = if is_by_moment && self.frame == Frame::Bodies { to } else { [0.0; 2] };
        let half_way = |axis: usize| match self.frame {
            Frame::Bodies => 0.5 * (from[axis] + to[axis]) - middle[axis],
            Frame::Contact => -0.5 * by[axis],
        };
        let pole = [0, 1].map(|axis| half_way(axis) * self.grid.spacing()[axis]);
        let of_spin = (turned != 0.0 && pole != [0.0; 2]).then(|| {
            [turned * pole[1], -turned * pole[0]].map(|along| Array2::from_elem(state.pressure.dim(), along))
        });
        solver.set_pole([0, 1].map(|axis| middle[axis] * self.grid.spacing()[axis]));
        match self.frame {
            Frame::Bodies => {
                let moved = (by != [0.0; 2]).then(|| self.part_of_gap(to) - self.part_of_gap(from));
                if self.at != Some(to) {
                    let mut gap = self.part_of_gap(to);
                    state.open(&mut gap);
                    solver.move_gap(gap);
                    self.at = Some(to);
                }
                solver.set_carried(of_spin, moved, by);
                solver.set_rolled(by);
                let solved = solver.step(state, load, watch);
                solver.set_carried(None, None, [0.0; 2]);
                solver.set_rolled([0.0; 2]);
                solved.map(|solved| self.about_the_contact(solved, (to, middle)))
            }
            Frame::Contact => {
                let back = by.map(|by| -by);
                let moved = if let Some(outside) = self.passing {
                    self.pass(solver, [from, to].map(|roll| roll.map(f64::round)), outside)
                } else {
                    let gap = solver.undeformed();
                    (by != [0.0; 2]).then(|| gap - &carried(gap, back, Outside::Edge))
                };
                let memory = solver.carry_memory(back.map(|back| back as isize));
                solver.set_carried(of_spin, moved, by);
                solver.set_rolled(by);
                let solved = solver.step(&state.carried(back), load, watch);
                solver.set_carried(None, None, [0.0; 2]);
                solver.set_rolled([0.0; 2]);
                if solved.is_err() {
                    solver.restore_memory(memory);
                }
                solved
            }
        }
    }

    /// The gap and the friction of the places over which the grid lies after it has rolled to so many cells; by how much the gap of each place has changed
    /// since it was `from` others, where it was.
    fn pass(
        &mut self,
        solver: &mut ContactSolver<'_>,
        [from, to]: [[f64; 2]; 2],
        outside: Outside,
    ) -> Option<Array2<f64>> {
        let back = [0, 1].map(|axis| from[axis] - to[axis]);
        let gap = self.gap_passed(to, outside);
        let moved =
            (from != to).then(|| &gap - &carried(&self.gap_passed(from, outside), back, Outside::Edge));
        if self.at != Some(to) {
            if let Some(law) = &self.friction {
                let by = to.map(|cells| -(cells as isize));
                let law = law.with_maps(|map| carried_by_whole_cells(map, by, (outside, 0.0)));
                solver.set_friction(Cow::Owned(law));
            }
            solver.move_gap(gap);
            self.at = Some(to);
        }
        moved
    }

    fn gap_passed(&self, cells: [f64; 2], outside: Outside) -> Array2<f64> {
        let gap = self.profile.gap_passed(&self.grid, cells.map(|cells| cells as isize), outside);
        if self.symmetry.any() { self.symmetry.part(&gap) } else { gap }
    }

    /// Moments about the middle of the contact, which has rolled by so many cells, not about that of the grid; about z of one that is found about a
    /// `middle` [cells].
    fn about_the_contact(&self, mut solved: Increment, (cells, middle): ([f64; 2], [f64; 2])) -> Increment {
        let [x, y] = [0, 1].map(|axis| cells[axis] * self.grid.spacing()[axis]);
        let [arm_x, arm_y] = [0, 1].map(|axis| (cells[axis] - middle[axis]) * self.grid.spacing()[axis]);
        let found = &mut solved.outcome.resultants;
        found.moment -= arm_x * found.tangential[1] - arm_y * found.tangential[0];
        found.tilt_moment =
            [found.tilt_moment[0] - x * found.normal, found.tilt_moment[1] - y * found.normal];
        solved
    }

    /// Gap before deformation where the contact has rolled by so many cells.
    fn part_of_gap(&self, cells: [f64; 2]) -> Array2<f64> {
        let gap = self.profile.gap_rolled(&self.grid, cells);
        if self.symmetry.any() { self.symmetry.part(&gap) } else { gap }
    }
}
