//! Increments of a contact that rolls along both surfaces: where the bodies lie over the grid, or the grid over the bodies.

use ndarray::{Array2, Axis};

use crate::fields::{Outside, carried};
use crate::model::{ContactState, Frame, LoadStep, Profile, SurfaceGrid, Symmetry};
use crate::plan::Plan;
use crate::solver::{ContactSolver, Increment, IterationCallback, SolveError};

/// So much of a cell is rounding: numbers of cells are sums of lengths.
const ROUNDING: f64 = 1e-6;
/// And of a way between two such sums, which a plan has found to be whole.
const WHOLE: f64 = 1e-4;

/// A contact that rolls along both surfaces. Fields are those in front of the mirrors.
pub struct Rolling {
    pub(super) grid: SurfaceGrid,
    /// Bound on the residuals of each increment.
    pub(super) tolerance: f64,
    symmetry: Symmetry,
    frame: Frame,
    profile: Profile,
    /// Where the gap that the solver has is that of, in cells, with the frame of the bodies; `None`: nowhere any more.
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
            at: None,
        }
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
        let [from, to] = [state.roll, load.roll].map(|roll| self.cells(roll));
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

    /// In the frame of the bodies with the gap there, in that of the contact from the state before, carried back by the cells that the grid goes
    /// ahead. A spin is about the middle of the contact, which goes along: in all the rotation about where it is half-way.
    ///
    /// # Errors
    /// As [`ContactSolver::step`].
    pub(super) fn advance(
        &mut self,
        solver: &mut ContactSolver<'_>,
        state: &ContactState,
        load: &LoadStep,
        watch: IterationCallback<'_>,
    ) -> Result<Increment, SolveError> {
        let [from, to] = [state.roll, load.roll].map(|roll| self.cells(roll));
        let by = self.way(state, load);
        let half_way = |axis: usize| match self.frame {
            Frame::Bodies => 0.5 * (from[axis] + to[axis]),
            Frame::Contact => -0.5 * by[axis],
        };
        let pole = [0, 1].map(|axis| half_way(axis) * self.grid.spacing()[axis]);
        let turned = load.twist.motion().map_or(0.0, |twist| twist - state.twist);
        let of_spin = (turned != 0.0 && pole != [0.0; 2]).then(|| {
            [turned * pole[1], -turned * pole[0]].map(|along| Array2::from_elem(state.pressure.dim(), along))
        });
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
                solved.map(|solved| self.about_the_contact(solved, to))
            }
            Frame::Contact => {
                let back = by.map(|by| -by);
                let gap = solver.undeformed();
                let moved = (by != [0.0; 2]).then(|| gap - &carried(gap, back, Outside::Edge));
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

    /// Moments about the middle of the contact, which has rolled by so many cells, not about that of the grid.
    fn about_the_contact(&self, mut solved: Increment, cells: [f64; 2]) -> Increment {
        let [x, y] = [0, 1].map(|axis| cells[axis] * self.grid.spacing()[axis]);
        let found = &mut solved.outcome.resultants;
        found.moment -= x * found.tangential[1] - y * found.tangential[0];
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
