//! Increments of bodies whose surfaces move against each other: where the upper one lies over the grid, the gap there, and what of the upper
//! body's displacement before is carried along.

use std::borrow::Cow;

use ndarray::Array2;

use super::pair_compliance::PairCompliance;
use super::rolling::Rolling;
use super::steady::Onward;
use super::turn_by_moment::TurnByMoment;
use crate::compliance::{OperatorSet, SpectralCompliance, SurfaceCompliance};
use crate::fields::Outside;
use crate::model::{
    BEYOND_THE_BODY, Body, ContactPair, ContactState, CoulombFriction, LoadStep, Motion, Place, Profile,
    SurfaceGrid, Symmetry,
};
use crate::plan::{Coupling, Plan};
use crate::solver::{ContactSolver, Increment, IterationCallback, SolveError, SolverMemory, Work};

/// Rounds in which a shift or a twist that follows from a force or a moment and the place of the surfaces are found in alternation. A contact that
/// sticks, or whose machine gives, moves in a round by a small part of what it moved in the one before.
const MOST_ROUNDS: usize = 12;
/// From this round on two places beside each other are taken for one.
const TAKING_TURNS: usize = 4;
/// Two places are one where nothing on the grid lies in them farther apart than this, in cells.
const SAME_PLACE: f64 = 1e-4;
/// Two places are beside each other where they lie no farther apart than this along the axes, in cells: positions are rounded to a hundredth.
const ONE_ROUNDING: f64 = 0.015;
/// And by a turn: less than a hundredth of a cell is rounded to a right angle.
const ROUNDED_TURN: f64 = 0.011;

/// A solver, with what moves the surfaces from one increment to the next, where they move.
pub struct Stepper<'a> {
    /// The solver.
    pub solver: ContactSolver<'a>,
    /// The surfaces that move.
    pub moving: Option<Moving>,
    /// The contact that rolls.
    pub rolling: Option<Rolling>,
}

/// Surfaces that move against each other. Fields are those with symmetry reduction.
pub struct Moving {
    grid: SurfaceGrid,
    symmetry: Symmetry,
    repeats: bool,
    motion: Motion,
    profile: Profile,
    /// The tangential displacement of the upper body alone, where it deforms and friction acts.
    upper: Option<UpperBody>,
    /// A friction law whose maps are the upper body's.
    friction: Option<CoulombFriction>,
    /// Whether friction maps are the upper body's.
    friction_of_upper: bool,
    /// Where the gap that the solver has is that of; `None`: nowhere any more.
    at: Option<Place>,
}

/// How the upper body alone responds. Bodies that are similar do not couple as a pair; each alone does.
struct UpperBody {
    compliance: SpectralCompliance,
}

impl UpperBody {
    /// Of a plan whose upper body is `upper` now; `None` where it does not deform along the surface.
    fn of(plan: &Plan, upper: &Body) -> Result<Option<Self>, SolveError> {
        if *upper == Body::Rigid || plan.coupling == Coupling::Frictionless {
            return Ok(None);
        }
        let Ok(alone) = ContactPair::new(upper.clone(), Body::Rigid) else { return Ok(None) };
        let response = PairCompliance::all_components(plan, &alone);
        let operators = OperatorSet { full: true, symmetry: plan.symmetry, ..OperatorSet::default() };
        let cells = plan.symmetry.part_of(plan.grid.cells());
        Ok(Some(Self { compliance: SpectralCompliance::new(&response, cells, operators)? }))
    }

    /// Tangential displacement of the upper surface against the lower one's direction [length], of the tractions of a state.
    fn displacement(&mut self, state: &ContactState) -> [Array2<f64>; 2] {
        let fields = [&state.pressure, &state.shear[0], &state.shear[1]];
        let tractions = fields.map(|field| field.as_standard_layout().into_owned());
        let [pressure, x, y] = tractions.each_ref().map(|field| field.as_slice().unwrap_or_default());
        let mut moved = [(); 3].map(|()| Array2::zeros(state.pressure.dim()));
        {
            let [normal, along, across] =
                moved.each_mut().map(|field| field.as_slice_mut().unwrap_or_default());
            self.compliance.full([pressure, x, y], [normal, along, across]);
        }
        let [_, along, across] = moved;
        [along, across]
    }
}

/// Depth worn off the upper body [length] in the cells over which it lies in a state; `None` where it does not move.
pub fn upper_wear_over_grid(plan: &Plan, state: &ContactState) -> Option<Array2<f64>> {
    let motion = Motion::over(&plan.grid);
    let over = motion.over_grid(motion.place(state.shift, state.twist));
    let outside = if plan.case.periodic.is_both() { Outside::Repeats } else { Outside::Zero };
    state.upper_worn_depth.as_ref().map(|depth| over.of(depth, outside))
}

impl Moving {
    /// Of a plan.
    ///
    /// # Errors
    /// When the operators of the upper body cannot be made.
    pub fn of(plan: &Plan, bodies: &ContactPair) -> Result<Self, SolveError> {
        Ok(Self {
            grid: plan.grid,
            symmetry: plan.symmetry,
            repeats: plan.case.periodic.is_both(),
            motion: Motion::over(&plan.grid),
            profile: plan.case.profile.clone(),
            upper: UpperBody::of(plan, bodies.upper())?,
            friction: None,
            friction_of_upper: plan.case.kinematics.friction_of_upper,
            at: None,
        })
    }

    /// Other bodies from now on.
    ///
    /// # Errors
    /// As [`Moving::of`].
    pub fn set_bodies(&mut self, plan: &Plan, bodies: &ContactPair) -> Result<(), SolveError> {
        self.upper = UpperBody::of(plan, bodies.upper())?;
        Ok(())
    }

    /// Another friction law from now on, of the upper body where maps move with it.
    pub fn set_friction(&mut self, friction: &CoulombFriction) {
        let moves = self.friction_of_upper && friction.is_map();
        self.friction = moves.then(|| friction.clone());
        self.at = None;
    }

    /// The friction law over the grid where the upper body, whose maps it has, lies at a place; `None` where it has none.
    fn friction_at(&self, place: Place) -> Option<CoulombFriction> {
        let over = self.motion.over_grid(place);
        self.friction.as_ref().map(|law| law.with_maps(|map| over.of(map, self.outside())))
    }

    fn outside(&self) -> Outside {
        if self.repeats { Outside::Repeats } else { Outside::Edge }
    }

    /// Undeformed gap where the upper body lies at a place.
    fn gap_at(&self, state: &ContactState, place: Place) -> Array2<f64> {
        let gap = self.profile.gap_with_upper_at(&self.grid, place, self.repeats);
        let mut gap = if self.symmetry.any() { self.symmetry.part(&gap) } else { gap };
        let outside = if self.repeats { Outside::Repeats } else { Outside::Zero };
        state.open(&mut gap);
        if let Some(upper) = &state.upper_worn_depth {
            gap += &self.motion.over_grid(place).of(upper, outside);
        }
        gap
    }

    /// Where the upper body is brought by a load from a state, as far as that prescribes it: shift [length] and twist [rad]; and whether it does.
    fn prescribed(load: &LoadStep, state: &ContactState) -> ([f64; 2], f64, bool) {
        use crate::model::Control::Motion;
        let controls = [load.tangential[0], load.tangential[1], load.twist];
        let to = controls.map(|control| if let Motion(to) = control { Some(to) } else { None });
        let or = |axis: usize, before: f64| to[axis].unwrap_or(before);
        ([or(0, state.shift[0]), or(1, state.shift[1])], or(2, state.twist), !to.contains(&None))
    }

    /// Where the middle of the upper body is in a place [length].
    fn middle(&self, place: Place) -> [f64; 2] {
        let spacing = self.grid.spacing();
        [0, 1].map(|axis| place.cells[axis] * spacing[axis])
    }

    /// By how much more the upper surface moves over the grid by an increment of the twist [rad] about its own middle half-way between two places than
    /// about where that is in the second one [length]; `None` where that is no more.
    fn of_turn(&self, [from, to]: [Place; 2], twist: f64) -> Option<[Array2<f64>; 2]> {
        let [from, to] = [from, to].map(|place| self.middle(place));
        let [x, y] = [0, 1].map(|axis| 0.5 * (from[axis] - to[axis]));
        let more = (twist != 0.0 && [x, y] != [0.0; 2]).then_some([twist * y, -twist * x])?;
        Some(more.map(|along| Array2::from_elem(self.grid.cells(), along)))
    }

    /// How far a place and a twist that were taken, after a way [cells], are off those that were then found, in cells; and whether these are beside them.
    /// Rounded to a hundredth, two places may take turns; so may a right angle, to which a twist beside it is rounded, and that twist.
    fn off(&self, [(place, twist), (reached, found)]: [(Place, f64); 2], way: [f64; 2]) -> (f64, bool) {
        let [off, turned_off] = self.motion.apart([place, reached]);
        let of_turn = 0.5 * (found - twist).abs() * way[0].hypot(way[1]);
        let off_by_turn = turned_off.max(of_turn);
        let over_a_right_angle = (place.turned == twist) != (reached.turned == found);
        let beside = off < ONE_ROUNDING
            && (off_by_turn < SAME_PLACE || over_a_right_angle && off_by_turn < ROUNDED_TURN);
        (off.max(off_by_turn), beside)
    }

    /// Whether cells in contact lie beside cells over which nothing is known of the upper body.
    fn touches_unknown(&self, gap: &Array2<f64>, pressure: &Array2<f64>) -> bool {
        if self.profile.of_upper[1] == 0 || self.repeats {
            return false;
        }
        let [width, depth] = self.grid.size();
        let unknown = 0.5 * BEYOND_THE_BODY * width.hypot(depth);
        let (nx, ny) = gap.dim();
        pressure.indexed_iter().filter(|(_, p)| **p > 0.0).any(|((i, j), _)| {
            let [rows, columns] =
                [(i, nx), (j, ny)].map(|(at, count)| at.saturating_sub(1)..=(at + 1).min(count - 1));
            rows.into_iter().any(|i| columns.clone().any(|j| gap[[i, j]] >= unknown))
        })
    }
}

impl<'a> Stepper<'a> {
    /// Surfaces that stay where they are.
    #[cfg(test)]
    pub fn still(solver: ContactSolver<'a>) -> Self {
        Self { solver, moving: None, rolling: None }
    }

    /// Another friction law from the next increment on, with the maps of a body where that lies without a shift.
    pub fn set_friction(&mut self, friction: Cow<'a, CoulombFriction>) {
        if let Some(moving) = &mut self.moving {
            moving.set_friction(&friction);
        }
        if let Some(rolling) = &mut self.rolling {
            rolling.set_friction(&friction);
        }
        self.solver.set_friction(friction);
    }

    /// The surfaces have worn: the gap is another one, `gap` where they stay where they are.
    pub fn open_gap(&mut self, gap: impl FnOnce() -> Array2<f64>) {
        match &mut self.moving {
            None => self.solver.set_gap(gap()),
            Some(moving) => {
                moving.at = None;
                self.solver.forget_displacements();
            }
        }
        if let Some(rolling) = &mut self.rolling {
            rolling.forget_place();
        }
    }

    /// Other bodies from the next increment on.
    ///
    /// # Errors
    /// When the operators of the upper body cannot be made.
    pub fn set_response(
        &mut self,
        plan: &Plan,
        bodies: &ContactPair,
        compliance: PairCompliance,
    ) -> Result<(), SolveError> {
        self.solver.set_response(compliance.response, compliance.table);
        self.moving.as_mut().map_or(Ok(()), |moving| moving.set_bodies(plan, bodies))
    }

    /// Rolls on until nothing changes any more, see [`Rolling::until_steady`].
    ///
    /// # Errors
    /// As there.
    pub fn roll_until_steady(
        &mut self,
        state: &ContactState,
        onward: Onward<'_>,
        watch: IterationCallback<'_>,
    ) -> Result<(Increment, LoadStep, usize), SolveError> {
        let Self { solver, rolling, .. } = self;
        match rolling {
            Some(rolling) => rolling.until_steady(solver, state, onward, watch),
            None => solver.step(state, onward.wanted, watch).map(|end| (end, *onward.wanted, 1)),
        }
    }

    /// Whether an increment can be solved in parts that end at a load: a grid that goes with a contact moves by whole cells.
    pub fn may_stop_at(&self, state: &ContactState, load: &LoadStep) -> bool {
        self.rolling.as_ref().is_none_or(|rolling| rolling.may_stop_at(state, load))
    }

    /// A state before an increment on the cells where its places are after it: a grid that goes with a contact leaves them behind.
    pub fn brought_to<'s>(&self, state: &'s ContactState, after: &ContactState) -> Cow<'s, ContactState> {
        self.rolling.as_ref().map_or(Cow::Borrowed(state), |rolling| rolling.brought_to(state, after))
    }

    /// What the solver remembers.
    pub fn memory(&self) -> &SolverMemory {
        self.solver.memory()
    }

    /// The solver goes on with the memory of another one.
    pub fn restore_memory(&mut self, memory: SolverMemory) {
        self.solver.restore_memory(memory);
    }

    /// Solves one increment, with the surfaces where they are at its end: where a force, a spring or a moment moves the upper body, by rounds until
    /// the place is that of the shift and the twist found.
    ///
    /// # Errors
    /// As [`ContactSolver::step`]; that the place wanders, when the rounds do not end.
    pub fn step(
        &mut self,
        state: &ContactState,
        load: &LoadStep,
        watch: IterationCallback<'_>,
    ) -> Result<Increment, SolveError> {
        let Self { solver, moving, rolling } = self;
        if let Some(rolling) = rolling {
            return rolling.step(solver, state, load, watch);
        }
        let Some(moving) = moving else { return solver.step(state, load, watch) };
        let from = moving.motion.place(state.shift, state.twist);
        let (to, mut twist, is_known) = Moving::prescribed(load, state);
        let mut place = moving.motion.place(to, twist);
        let memory = (!is_known).then(|| solver.memory().clone());
        let (gap_before, law_before) = (moving.gap_at(state, from), moving.friction_at(from));
        let (mut before, mut work) = (None, Work::default());
        let (mut round, mut turn) = (1, TurnByMoment::default());
        loop {
            let way = moving.motion.between(from, place);
            let moves = !way.is_none();
            let gap = moves.then(|| moving.gap_at(state, place));
            if moving.at != Some(place) {
                solver.move_gap(gap.as_ref().unwrap_or(&gap_before).clone());
                if let Some(law) = moving.friction_at(place) {
                    solver.set_friction(Cow::Owned(law));
                }
                moving.at = Some(place);
            }
            solver.set_friction_before(law_before.clone().filter(|_| moves));
            let outside = moving.outside();
            let along = moving.upper.as_mut().filter(|_| moves).map(|upper| {
                let before = before.get_or_insert_with(|| {
                    work.convolutions += 1;
                    work.full_grid_convolutions += 1.0 / moving.symmetry.copies() as f64;
                    upper.displacement(state)
                });
                let [x, y] = way.of_vectors(before.each_ref(), outside);
                [x - &before[0], y - &before[1]]
            });
            let of_turn = moving.of_turn([from, place], twist - state.twist);
            let along = match (along, of_turn) {
                (Some([x, y]), Some([more_x, more_y])) => Some([x + more_x, y + more_y]),
                (one, other) => one.or(other),
            };
            let by = if way.turns() { [way.farthest(&state.pressure).max(1.0); 2] } else { way.by };
            solver.set_carried(along, gap.map(|gap| gap - &gap_before), by);
            solver.set_pole(moving.middle(place));
            let solved = solver.step(state, load, watch);
            solver.set_carried(None, None, [0.0; 2]);
            let mut solved = solved?;
            work += solved.work;
            if moving.touches_unknown(solver.undeformed(), &solved.state.pressure) {
                return Err(SolveError::ContactAtEdge);
            }
            let found = solved.state.twist;
            let reached = moving.motion.place(solved.state.shift, found);
            let (off, beside) = moving.off([(place, twist), (reached, found)], way.by);
            if is_known || off < SAME_PLACE || round >= TAKING_TURNS && beside {
                solved.work = work;
                return Ok(solved);
            }
            if let Some(memory) = &memory {
                solver.restore_memory(memory.clone());
            }
            if round == MOST_ROUNDS {
                return Err(SolveError::Wanders { apart: off, rounds: round });
            }
            round += 1;
            let by_moment = load.twist.force().is_some();
            let next = if by_moment { turn.next([twist, found], place.cells) } else { found };
            (place, twist) = (moving.motion.place(solved.state.shift, next), next);
        }
    }
}
