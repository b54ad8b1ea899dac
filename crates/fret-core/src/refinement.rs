//! Increments divided until the history no longer depends on their size: the shear that slip leaves behind in a growing contact is
//! of first order in the increment.

use ndarray::Zip;

use crate::model::{ContactState, LoadStep};
use crate::solver::{ContactSolver, Increment, SolveError, SolverMemory, Watch};
use crate::wear::Wearing;

/// Parts of an increment, at the most.
const MOST_PARTS: usize = 1024;
/// Two solutions of one problem differ by at most so many times the bound on their residuals; 100 leaves room for
/// compliance that amplifies it.
const NOISE: f64 = 100.0;

/// Where an increment starts and ends.
#[derive(Debug, Clone, Copy)]
pub struct Span<'a> {
    /// Tractions and motions at its start.
    pub state: &'a ContactState,
    /// What is prescribed there.
    pub from: &'a LoadStep,
    /// What is prescribed at its end.
    pub to: &'a LoadStep,
}

/// How finely increments are divided.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Refinement {
    /// Bound on the error of the tractions in an increment, in shares of the way they went in it.
    pub tolerance: f64,
    /// Bound on the residuals of each solution.
    pub residual: f64,
    /// Largest coefficient of friction: what makes pressure and shear comparable.
    pub friction: f64,
}

/// An increment solved in parts.
pub struct Divided {
    /// Its end; the work of all tries is in it.
    pub end: Increment,
    /// Parts of the try that was taken.
    pub parts: usize,
    /// Parts to begin the next increment with.
    pub next: usize,
    /// The wear collected on the way.
    pub wearing: Option<Wearing>,
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
    wearing: Option<Wearing>,
    /// How far the tractions went, all parts in turn: Euclidean norm of (mu p, q).
    length: f64,
}

impl Refinement {
    /// Solves an increment in `parts` parts, in twice as many, and so on, until two solutions in turn differ at the end by less than
    /// the tolerance allows, which bounds the error of the finer one where the error is of first order. The solver then
    /// remembers the finer one.
    ///
    /// # Errors
    /// [`DivisionError::Unresolved`] when even the most parts are not enough; errors of the equations as they come, but that a
    /// division that does not converge is followed by a finer one.
    pub fn solve(
        &self,
        solver: &mut ContactSolver<'_>,
        wearing: Option<&Wearing>,
        span: Span<'_>,
        parts: usize,
        watch: Watch<'_>,
    ) -> Result<Divided, DivisionError> {
        let memory = solver.memory().clone();
        let mut work = crate::history::Work::default();
        let mut try_in = |parts: usize| {
            solver.remember(memory.clone());
            let way = self.way(solver, wearing.cloned(), span, parts, watch);
            if let Ok(way) = &way {
                work += way.end.work;
            }
            way
        };
        let mut parts = parts.clamp(1, MOST_PARTS / 2);
        let mut coarse = refused_if_unsolved(try_in(parts))?;
        loop {
            parts *= 2;
            let fine = match try_in(parts) {
                Err(error) if parts >= MOST_PARTS => return Err(error.into()),
                way => refused_if_unsolved(way)?,
            };
            let (Some(rough), Some(fine)) = (coarse, fine) else {
                coarse = None;
                continue;
            };
            let error = self.distance(&rough.end.state, &fine.end.state);
            let size = self
                .distance(&ContactState::untouched(fine.end.state.pressure.dim().into()), &fine.end.state);
            let bound = self.tolerance * fine.length + NOISE * self.residual * size;
            if error <= bound {
                let Way { mut end, memory, wearing, .. } = fine;
                end.work = work;
                solver.remember(memory);
                let next = if error < 0.25 * bound { parts / 4 } else { parts / 2 };
                return Ok(Divided { end, parts, next: next.max(1), wearing });
            }
            if parts >= MOST_PARTS {
                return Err(DivisionError::Unresolved { reached: error / fine.length, parts });
            }
            coarse = Some(fine);
        }
    }

    fn way(
        &self,
        solver: &mut ContactSolver<'_>,
        mut wearing: Option<Wearing>,
        span: Span<'_>,
        parts: usize,
        watch: Watch<'_>,
    ) -> Result<Way, SolveError> {
        let mut step = |before: &ContactState, part: usize| {
            let load = LoadStep::between(span.from, span.to, part as f64 / parts as f64);
            let solved = solver.step(before, &load, watch)?;
            if let Some(wearing) = &mut wearing {
                wearing.add(before, &solved.state);
            }
            Ok((self.distance(before, &solved.state), solved))
        };
        let (mut length, mut end) = step(span.state, 1)?;
        for part in 2..=parts {
            let (way, next) = step(&end.state, part)?;
            let mut work = end.work;
            work += next.work;
            let residual = end.outcome.residual.worse(&next.outcome.residual);
            end = next;
            end.work = work;
            end.outcome.residual = residual;
            length += way;
        }
        Ok(Way { end, memory: solver.memory().clone(), wearing, length })
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

/// A way that was not solved is none; other errors stay.
fn refused_if_unsolved(way: Result<Way, SolveError>) -> Result<Option<Way>, SolveError> {
    match way {
        Ok(way) => Ok(Some(way)),
        Err(SolveError::NotConverged { .. }) => Ok(None),
        Err(error) => Err(error),
    }
}
