//! Increments in parts: where the whole is not solved, where bodies come to touch, and where the history is to depend no longer on the
//! size of increments, since the shear that slip leaves behind in a growing contact is of first order in the increment.

use ndarray::Zip;

use super::moving::Stepper;
use super::slip_increment::SlipIncrement;
use super::surfaces::Surfaces;
use crate::history::Work;
use crate::model::{ContactState, Control, CoulombFriction, Integration, LoadStep};
use crate::solver::{Increment, IterationCallback, SolveError, SolverMemory};

/// Halvings of a step that is not solved as a whole, at the most.
const MOST_HALVINGS: u32 = 5;
/// Parts of an increment in which bodies come to touch.
const OF_FIRST_TOUCH: i32 = 4;
/// Parts of an increment, at the most.
const MOST_PARTS: usize = 1024;
/// Two solutions of one problem differ by at most so many times the bound on their residuals; 100 leaves room for
/// compliance that amplifies it.
const NOISE: f64 = 100.0;
/// The difference of two solutions, one in twice as many parts, over the error of the finer one: 2^order - 1.
const FIRST_ORDER: f64 = 1.0;
const SECOND_ORDER: f64 = 3.0;

/// Where an increment starts and ends, or a part of one.
#[derive(Debug, Clone, Copy)]
pub struct Span<'a> {
    /// Tractions and motions at its start.
    pub state: &'a ContactState,
    /// What is prescribed there.
    pub from: &'a LoadStep,
    /// What is prescribed at its end.
    pub to: &'a LoadStep,
    /// Shares of the way of the whole increment at its start and at its end.
    pub shares: [f64; 2],
}

impl<'a> Span<'a> {
    /// A whole increment.
    pub fn whole(state: &'a ContactState, [from, to]: [&'a LoadStep; 2]) -> Self {
        Self { state, from, to, shares: [0.0, 1.0] }
    }
}

/// Who hears of an increment while it is solved.
pub struct Heard<'a> {
    /// Of every iteration.
    pub iteration: IterationCallback<'a>,
    /// Of every part that is solved: the share of the way at its end, and the friction in it. A way that is given up is followed by another
    /// one, whose shares begin anew.
    pub part: &'a mut dyn FnMut(f64, &Increment, &CoulombFriction),
}

/// Solves a step; one whose equations are not solved as a whole in two halves, and these again. With it the number of parts; what slip
/// does to the surfaces is collected on the way.
///
/// # Errors
/// Those of the equations; that they do not converge, when the smallest part does not.
pub fn in_halves(
    solver: &mut Stepper<'_>,
    surfaces: &mut Surfaces,
    span: Span<'_>,
    heard: &mut Heard<'_>,
) -> Result<(Increment, usize), SolveError> {
    halved(solver, surfaces, span, MOST_HALVINGS, heard)
}

fn halved(
    solver: &mut Stepper<'_>,
    surfaces: &mut Surfaces,
    span: Span<'_>,
    halvings: u32,
    heard: &mut Heard<'_>,
) -> Result<(Increment, usize), SolveError> {
    match solver.step(span.state, span.to, heard.iteration) {
        Ok(end) => {
            take(solver, surfaces, span, &end, heard)?;
            Ok((end, 1))
        }
        Err(error) if error.is_of_long_increments() && halvings > 0 && span.from != span.to => {
            let middle = &LoadStep::between(span.from, span.to, 0.5);
            if !solver.may_stop_at(span.state, middle) {
                return Err(error);
            }
            let [start, end] = span.shares;
            let half = 0.5 * (start + end);
            let first = Span { to: middle, shares: [start, half], ..span };
            let (first, parts) = halved(solver, surfaces, first, halvings - 1, heard)?;
            let second = Span { state: &first.state, from: middle, to: span.to, shares: [half, end] };
            let (second, more) = halved(solver, surfaces, second, halvings - 1, heard)?;
            Ok((after(&first, second), parts + more))
        }
        Err(error) => Err(error),
    }
}

/// Takes a step that is solved: what its slip does to the surfaces is collected, and it is told of.
fn take(
    solver: &Stepper<'_>,
    surfaces: &mut Surfaces,
    span: Span<'_>,
    end: &Increment,
    heard: &mut Heard<'_>,
) -> Result<(), SolveError> {
    surfaces.add(SlipIncrement {
        states: [span.state, &end.state],
        laws: solver.solver.laws(),
        integration: surfaces.integration,
        travels: end.travelled,
    })?;
    let [_, share] = span.shares;
    (heard.part)(share, end, solver.solver.friction());
    Ok(())
}

/// Solves an increment in which bodies that were apart come to touch, under loads that grow evenly, in parts in which the contact of two spheres
/// grows evenly. Nothing is known of what went before the first part, so that it is of first order, and the smaller it is the less of the contact
/// keeps its error. Leading parts after which no cell sticks are passed over: where all slip, as a few cells may, the bodies are nowhere in particular;
/// the next part then starts where the increment does. Where a part has no solution, or surfaces move, the increment is solved as a whole. With the
/// end the number of parts, as [`in_halves`].
///
/// # Errors
/// As [`in_halves`].
pub fn first_touch(
    solver: &mut Stepper<'_>,
    surfaces: &mut Surfaces,
    span: Span<'_>,
    heard: &mut Heard<'_>,
) -> Result<(Increment, usize), SolveError> {
    // Of two spheres the contact radius goes with the third root of the force and with the second one of the approach.
    let power = if matches!(span.to.normal, Control::Force(_)) { 3 } else { 2 };
    let loads = [1, 2, 3, OF_FIRST_TOUCH].map(|part| {
        let share = (f64::from(part) / f64::from(OF_FIRST_TOUCH)).powi(power);
        (share, LoadStep::between(span.from, span.to, share))
    });
    let memory = solver.memory().clone();
    let mut in_vain = Work::default();
    let mut ends: Vec<Increment> = Vec::with_capacity(loads.len());
    // Where surfaces move, friction may be another one in each part.
    let mut is_whole =
        solver.moving.is_some() || !loads.iter().all(|(_, load)| solver.may_stop_at(span.state, load));
    for (share, load) in &loads {
        if is_whole {
            break;
        }
        let state = ends.last().map_or(span.state, |end| &end.state);
        match solver.step(state, load, heard.iteration) {
            Ok(slips) if *share < 1.0 && ends.is_empty() && slips.outcome.stick_cells == 0 => {
                in_vain += Work { end_point_increments: 0, ..slips.work };
                solver.restore_memory(memory.clone());
            }
            Ok(end) => ends.push(end),
            Err(SolveError::Stopped) => return Err(SolveError::Stopped),
            // A part may ask for more than friction bears at its load; what the whole asks for is told by that.
            Err(_) => is_whole = true,
        }
    }
    if is_whole {
        for end in &ends {
            in_vain += Work { end_point_increments: 0, ..end.work };
        }
        solver.restore_memory(memory);
        let (mut end, parts) = in_halves(solver, surfaces, span, heard)?;
        end.work += in_vain;
        return Ok((end, parts));
    }
    let parts = ends.len();
    for (place, (share, load)) in loads[loads.len() - parts..].iter().enumerate() {
        let state = place.checked_sub(1).map_or(span.state, |before| &ends[before].state);
        let part = Span { state, to: load, shares: [0.0, *share], ..span };
        take(solver, surfaces, part, &ends[place], heard)?;
    }
    match ends.into_iter().reduce(|first, second| after(&first, second)) {
        Some(mut end) => {
            end.work += in_vain;
            Ok((end, parts))
        }
        None => in_halves(solver, surfaces, span, heard),
    }
}

/// The second of two steps, with the work of both, what friction took in both and the worse residuals.
fn after(first: &Increment, mut second: Increment) -> Increment {
    second.work += first.work;
    if let (Some(all), Some(before)) = (&mut second.friction_work, &first.friction_work) {
        *all += before;
    }
    second.outcome.residual = second.outcome.residual.worse(&first.outcome.residual);
    second
}

/// How finely increments are divided.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Refinement {
    /// Bound on the error of the tractions in an increment, in shares of the way they went in it.
    pub tolerance: f64,
    /// Of which order the parts are.
    pub integration: Integration,
    /// Bound on the residuals of each solution.
    pub residual: f64,
    /// Largest coefficient of friction: what makes pressure and shear comparable.
    pub friction: f64,
}

/// An increment solved in parts.
pub struct Divided {
    /// Its end; the work of all tries is in it.
    pub end: Increment,
    /// Parts of the try that was taken, halved ones counted as two.
    pub parts: usize,
    /// Parts to begin the next increment with.
    pub next: usize,
    /// What slip did to the surfaces on the way.
    pub surfaces: Surfaces,
}

/// Why an increment has no answer.
#[derive(Debug, Clone, PartialEq)]
pub enum DivisionError {
    /// Its equations have none.
    Unsolved(SolveError),
    /// Even the most parts leave too large an error.
    Unresolved {
        /// Error reached, in shares of the way.
        reached: f64,
        /// Parts made.
        parts: usize,
    },
}

impl From<SolveError> for DivisionError {
    fn from(error: SolveError) -> Self {
        Self::Unsolved(error)
    }
}

/// One way through an increment.
struct Way {
    end: Increment,
    memory: SolverMemory,
    surfaces: Surfaces,
    /// Steps made.
    steps: usize,
    /// How far the tractions went, all parts in turn: Euclidean norm of (mu p, q).
    length: f64,
}

impl Refinement {
    /// Solves an increment in `parts` parts, in twice as many, and so on, until the difference of two solutions in turn says, by the
    /// order of the integration, that the error of the finer one is within the tolerance. The solver then remembers the finer one.
    ///
    /// # Errors
    /// [`DivisionError::Unresolved`] when even the most parts are not enough; errors of the equations as they come.
    pub fn solve(
        &self,
        solver: &mut Stepper<'_>,
        surfaces: &Surfaces,
        span: Span<'_>,
        parts: usize,
        heard: &mut Heard<'_>,
    ) -> Result<Divided, DivisionError> {
        let memory = solver.memory().clone();
        let mut work = Work::default();
        let mut try_in = |parts: usize| {
            solver.restore_memory(memory.clone());
            let way = self.way(solver, surfaces.clone(), span, parts, heard);
            if let Ok(way) = &way {
                work += way.end.work;
            }
            way
        };
        let mut parts = parts.clamp(1, MOST_PARTS / 2);
        let mut coarse = try_in(parts)?;
        let exceeding = match self.integration {
            Integration::EndPoint => FIRST_ORDER,
            Integration::SecondOrder => SECOND_ORDER,
        };
        loop {
            parts *= 2;
            let fine = try_in(parts)?;
            let error = self.distance(&coarse.end.state, &fine.end.state) / exceeding;
            let size = self
                .distance(&ContactState::untouched(fine.end.state.pressure.dim().into()), &fine.end.state);
            let bound = self.tolerance * fine.length + NOISE * self.residual * size;
            if error <= bound {
                let Way { mut end, memory, surfaces, steps, .. } = fine;
                end.work = work;
                solver.restore_memory(memory);
                let next = if error < 0.25 * bound { parts / 4 } else { parts / 2 };
                return Ok(Divided { end, parts: steps, next: next.max(1), surfaces });
            }
            if parts >= MOST_PARTS {
                return Err(DivisionError::Unresolved { reached: error / fine.length, parts });
            }
            coarse = fine;
        }
    }

    fn way(
        &self,
        solver: &mut Stepper<'_>,
        mut surfaces: Surfaces,
        span: Span<'_>,
        parts: usize,
        heard: &mut Heard<'_>,
    ) -> Result<Way, SolveError> {
        let mut from = *span.from;
        let mut steps = 0;
        let share_of = |part: usize| part as f64 / parts as f64;
        let mut step = |before: &ContactState, part: usize| {
            let to = LoadStep::between(span.from, span.to, share_of(part));
            let here =
                Span { state: before, from: &from, to: &to, shares: [share_of(part - 1), share_of(part)] };
            let (solved, made) = in_halves(solver, &mut surfaces, here, heard)?;
            from = to;
            steps += made;
            Ok::<_, SolveError>((self.distance(before, &solved.state), solved))
        };
        let (mut length, mut end) = step(span.state, 1)?;
        for part in 2..=parts {
            let (way, next) = step(&end.state, part)?;
            end = after(&end, next);
            length += way;
        }
        Ok(Way { end, memory: solver.memory().clone(), surfaces, steps, length })
    }

    /// Distance of the tractions of two states.
    fn distance(&self, one: &ContactState, other: &ContactState) -> f64 {
        let mut square = 0.0;
        let fields = [
            (self.friction, &one.pressure, &other.pressure),
            (1.0, &one.shear[0], &other.shear[0]),
            (1.0, &one.shear[1], &other.shear[1]),
        ];
        for (weight, one, other) in fields {
            Zip::from(one).and(other).for_each(|a, b| square += (weight * (a - b)).powi(2));
        }
        square.sqrt()
    }
}

#[cfg(test)]
mod tests {
    use std::ops::ControlFlow;

    use ndarray::Array2;

    use super::*;
    use crate::compliance::SurfaceResponse;
    use crate::kernel::{Components, influence_coefficients};
    use crate::model::{
        Base, Body, ContactPair, Control, CoulombFriction, ElasticMaterial, HalfSpace, Integration,
        SurfaceGrid,
    };
    use crate::solver::{ContactSolver, Coupling, SolverSettings};

    const CELLS: usize = 32;

    /// A rigid sphere on a half-space, whose contact at force 1 has the radius 1 about.
    fn solver(friction: &CoulombFriction, most_changes: usize) -> Stepper<'_> {
        let material = ElasticMaterial::new(0.7, 0.3).unwrap();
        let body = HalfSpace::new(Vec::new(), Base::Elastic(material)).unwrap();
        let pair = ContactPair::new(Body::Rigid, Body::Elastic(body)).unwrap();
        let spacing = [2.6 / CELLS as f64; 2];
        let grid = SurfaceGrid::new([CELLS; 2], spacing).unwrap();
        let gap = Array2::from_shape_fn((CELLS, CELLS), |(i, j)| {
            0.5 * (grid.centre(0, i).powi(2) + grid.centre(1, j).powi(2))
        });
        let response =
            SurfaceResponse::FreeSpace(influence_coefficients(&pair, [CELLS; 2], spacing, Components::ALL));
        let settings = SolverSettings {
            max_newton_iterations: most_changes,
            another_way: false,
            integration: Integration::EndPoint, // whole steps and halves of one and the same rule
            ..SolverSettings::new(1e-9)
        };
        let solver = ContactSolver::new(grid, gap, friction, Coupling::Coupled, response, settings, true);
        Stepper::still(solver)
    }

    fn load(normal: f64, tangential: f64) -> LoadStep {
        LoadStep {
            normal: Control::Force(normal),
            tangential: [Control::Force(tangential), Control::Force(0.0)],
            ..LoadStep::FREE
        }
    }

    /// Newton iterations that a whole step needs and has not got are enough for its halves: a first pressing and pulling at once, whose
    /// stick zone comes from far, asks for more than a half of the way does.
    #[test]
    fn a_step_that_asks_for_too_many_changes_of_the_zones_is_solved_in_parts() {
        let friction = CoulombFriction::uniform(0.3).unwrap();
        let go_on: IterationCallback<'_> = &mut |_, _| ControlFlow::Continue(());
        // Where each part ended.
        let mut shares = Vec::new();
        let untouched = ContactState::untouched([CELLS; 2]);
        let pressed = load(1.0, 0.0);
        // A solver of so many iterations after the pressing, and where that ended.
        let pressed_with = |most: usize| {
            let mut patient = solver(&friction, 60);
            let watch: IterationCallback<'_> = &mut |_, _| ControlFlow::Continue(());
            let start = patient.step(&untouched, &pressed, watch).unwrap();
            let mut hasty = solver(&friction, most);
            hasty.restore_memory(patient.memory().clone());
            (hasty, start.state)
        };
        let in_two = [0.1, 0.15, 0.2, 0.25, 0.28, 0.29, 0.295, 0.299].into_iter().find_map(|force| {
            let pulled = load(1.0, force);
            (1..20).rev().find_map(|most| {
                let watch: IterationCallback<'_> = &mut |_, _| ControlFlow::Continue(());
                let (mut whole, start) = pressed_with(most);
                whole.step(&start, &pulled, watch).err()?;
                let (mut halves, start) = pressed_with(most);
                let span = Span::whole(&start, [&pressed, &pulled]);
                shares.clear();
                let part = &mut |share, _: &Increment, _: &CoulombFriction| shares.push(share);
                let heard = &mut Heard { iteration: watch, part };
                let (end, parts) = in_halves(&mut halves, &mut Surfaces::default(), span, heard).ok()?;
                (parts == 2).then_some((pulled, end))
            })
        });
        let (pulled, end) = in_two.expect("iterations too few for a whole step and enough for its halves");
        assert!(end.outcome.residual.largest() < 1e-9);
        assert_eq!(shares, [0.5, 1.0]);

        // The two halves, asked for one by one.
        let mut patient = solver(&friction, 60);
        let mut state = patient.step(&untouched, &pressed, go_on).unwrap().state;
        for half in [0.5, 1.0] {
            state = patient.step(&state, &LoadStep::between(&pressed, &pulled, half), go_on).unwrap().state;
        }
        let off = (state.shift[0] / end.state.shift[0] - 1.0).abs();
        // The same steps, solved to 1e-9.
        assert!(off < 1e-7, "{off:e}");
    }
}
