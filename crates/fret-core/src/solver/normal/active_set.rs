//! Active set method: conjugate gradients on a fixed contact, which changes only when the residual is small beside its violations. For
//! stiff coatings, whose response to a clipped cell spreads so far that a contact changing in every iteration never settles.
//!
//! Measured on a coating 1e3 times stiffer than the half-space below: the contact, begun a little too large, shrinks in two
//! to four changes; it need not in general (rough surfaces cycle), so it gives up when its violations stop falling.

use super::super::laws::complementarity::{CellLaw, NormalResidual, length_scale, violation};
use super::super::settings::SolveError;
use super::problem::{Ending, NormalIteration};
use super::yielding;
use crate::fields::{CellRule, CellSize, Reals, add_scaled, dot, each_cell, largest_of, sum};

/// When the contact changes, and how often it may change without gain.
#[derive(Debug, Clone, Copy)]
pub struct Care {
    /// The contact changes when the residual on it is this much smaller than its violations.
    small_beside: f64,
    /// Changes without halving the violations before it gives up.
    max_stalled: usize,
}

impl Default for Care {
    fn default() -> Self {
        Self { small_beside: 0.3, max_stalled: 6 }
    }
}

impl Care {
    /// That of the next attempt: a contact that wanders where its pressure is half found settles where it is found.
    pub fn more(self) -> Self {
        Self {
            small_beside: (0.1 * self.small_beside).max(1e-3),
            max_stalled: (2 * self.max_stalled).min(48),
        }
    }
}

/// What is wrong on a fixed contact.
struct Violations {
    approach: f64,
    /// Largest gap on the contact or violation, over the scale.
    residual: f64,
    /// What violations are measured by [length], see [`length_scale`].
    scale: f64,
    /// The same, gap alone.
    inner: f64,
    /// Sums of squares of the gap on the contact and of the violations.
    inner_square: f64,
    outer_square: f64,
    /// Cells of the contact under tension, or above the hardness.
    tense: f64,
}

/// Iterates until solved, or until the violations stop falling; with what `care` it takes.
///
/// # Errors
/// When the caller stopped the iteration, or it has gone on for too long.
pub fn iterate(problem: &mut NormalIteration<'_>, care: Care) -> Result<Ending, SolveError> {
    let task = problem.task;
    yielding::mark_active(problem.pressure, problem.law().hardness, &mut problem.active);
    let mut best = f64::INFINITY;
    let mut changes = 0;
    loop {
        let count = sum(&problem.active);
        if count == 0.0 {
            return Ok(give_up(problem));
        }
        let mut here = examine(problem);
        let mut slope = steepest(problem, task.load.total.map(|_| count));
        each_cell(&Descend { beta: 0.0 }, [&problem.steepest], [&mut problem.change]);
        let mut steps = 0;
        loop {
            problem.report(here.residual)?;
            if here.residual < problem.tolerance && here.tense == 0.0 {
                // What was asked for is more: no gap on the contact at all, however small its pressure.
                let residual = violation(&problem.gap, problem.pressure, problem.law()) / here.scale;
                let (approach, turned) = (here.approach, problem.turned);
                return Ok(Ending::Solved(NormalResidual { approach, turned, residual }));
            }
            let settled = here.inner_square < care.small_beside.powi(2) * here.outer_square;
            if steps > 0 && settled || here.inner < problem.tolerance {
                break;
            }
            problem.convolve_change();
            let curvature = dot(&problem.change, &problem.image);
            if !(curvature > 0.0 && slope > 0.0) {
                return Ok(give_up(problem));
            }
            let length = slope / curvature;
            add_scaled(problem.pressure, length, &problem.change);
            add_scaled(problem.displacement, length, &problem.image);
            here = examine(problem);
            let before = slope;
            slope = steepest(problem, task.load.total.map(|_| count));
            let beta = slope / before;
            each_cell(&Descend { beta }, [&problem.steepest], [&mut problem.change]);
            steps += 1;
        }
        changes += 1;
        if here.outer_square < 0.25 * best {
            (best, changes) = (here.outer_square, 0);
        }
        if changes > care.max_stalled {
            return Ok(give_up(problem));
        }
        let before = problem.tilt.is_some().then(|| problem.pressure.to_vec());
        change_contact(problem, here.tense > 0.0);
        if let Some(before) = before.filter(|_| !problem.has_moments()) {
            // Fewer cells than the moment needs.
            problem.pressure.copy_from_slice(&before);
            return Ok(give_up(problem));
        }
    }
}

/// Gap everywhere, residual on the contact, and what is wrong.
fn examine(problem: &mut NormalIteration<'_>) -> Violations {
    let (own, law) = (problem.self_influence, problem.law());
    problem.turn(|problem, cell| problem.active[cell]);
    let undeformed = problem.level.as_deref().unwrap_or(problem.task.undeformed);
    let read = [&*problem.displacement, undeformed, &*problem.pressure, &problem.active];
    let [heights, count, work, load] = each_cell(&Heights, read, [&mut problem.gap]);
    let approach =
        if problem.task.load.total.is_some() { heights / count } else { problem.task.load.approach };
    let NormalIteration { gap, residual, active, pressure, .. } = &mut *problem;
    let (read, write) = ([&**pressure, active], [&mut gap[..], residual]);
    let [inner_square, outer_square, tense] = each_cell(&Examine { approach, law }, read, write);
    let inner = largest_of(&Size, [residual]);
    let outer = largest_of(&Violation(law), [gap, pressure, active]);
    // Of the body: displacements here have in them what the machine gives.
    let given = problem.task.load.give * load;
    let mean = work / load - given;
    let scale =
        if load > 0.0 { length_scale(mean, [own, load / count.max(1.0)], approach - given) } else { 0.0 };
    let relative = |size: f64| if scale > 0.0 { size / scale } else { f64::INFINITY };
    Violations {
        approach,
        residual: relative(inner.max(outer)),
        scale,
        inner: relative(inner),
        inner_square,
        outer_square,
        tense,
    }
}

/// Preconditioned residual on the contact, without its mean where the force stays; its product with the residual.
fn steepest(problem: &mut NormalIteration<'_>, count: Option<f64>) -> f64 {
    problem.precondition();
    if let Some(tilt) = &problem.tilt {
        tilt.take_off(&mut problem.steepest, &problem.active);
    }
    let mean = count.map_or(0.0, |count| dot(&problem.steepest, &problem.active) / count);
    let read = [&problem.active[..], &problem.residual];
    let [slope] = each_cell(&WithoutMean { mean }, read, [&mut problem.steepest]);
    slope
}

/// Cells under tension leave, cells that overlap enter.
fn change_contact(problem: &mut NormalIteration<'_>, any_tense: bool) {
    let rule = Change { hardness: problem.law().hardness };
    let (read, write) = ([&problem.gap[..]], [&mut problem.active[..], &mut *problem.pressure]);
    let [count, kept] = each_cell(&rule, read, write);
    if !any_tense {
        return;
    }
    if let Some(tilt) = &problem.tilt {
        tilt.lift(problem.pressure, |cell, _| problem.active[cell]);
    } else if let Some(total) = problem.task.load.total {
        let lift = if count > 0.0 { (total - kept) / count } else { 0.0 };
        add_scaled(problem.pressure, lift, &problem.active);
    }
    problem.convolve_pressure();
}

/// Leaves pressures feasible, with their displacements.
fn give_up(problem: &mut NormalIteration<'_>) -> Ending {
    problem.project_pressure();
    problem.convolve_pressure();
    Ending::Stalled
}

/// The next change: down the preconditioned residual, conjugate to the last.
struct Descend {
    beta: f64,
}

impl CellRule<1, 1, 0> for Descend {
    #[inline(always)]
    fn at<R: Reals>(&self, [z]: [R; 1], [change]: &mut [R; 1]) -> [R; 0] {
        *change = *change * self.beta - z;
        []
    }
}

/// Height; sums of it over the contact, of the contact, of work and of load.
struct Heights;

impl CellRule<4, 1, 4> for Heights {
    #[inline(always)]
    fn at<R: Reals>(&self, [u, undeformed, p, active]: [R; 4], [height]: &mut [R; 1]) -> [R; 4] {
        *height = u + undeformed;
        [active * *height, active, p * u, p]
    }
}

/// What a cell violates on a fixed contact: tension or more than the hardness where pressure is unknown, as the gap it would close; overlap of
/// open cells, and a gap of cells at the hardness.
#[inline(always)]
fn off<R: Reals>(CellLaw { self_influence: own, hardness }: CellLaw, gap: R, p: R, active: R) -> R {
    let zero = p.all(0.0);
    let overlap = (gap * -1.0).max(zero);
    let outside = p.all(0.5 * hardness).if_at_most(p, gap.max(zero), overlap);
    active.if_at_most(zero, outside, (p * -own).max((p - hardness) * own).max(zero))
}

/// Gap of a height, the gap on the contact; sums of squares of it and of violations, and cells whose pressure is outside of what is allowed.
struct Examine {
    approach: f64,
    law: CellLaw,
}

impl CellRule<2, 2, 3> for Examine {
    #[inline(always)]
    fn at<R: Reals>(&self, [p, active]: [R; 2], [gap, inside]: &mut [R; 2]) -> [R; 3] {
        let zero = p.all(0.0);
        *gap = *gap - self.approach;
        *inside = active * *gap;
        let off = off(self.law, *gap, p, active);
        let beyond = p.all(self.law.hardness).if_at_most(p, active, zero);
        [*inside * *inside, off * off, zero.if_at_most(p, beyond, active)]
    }
}

struct Size;

impl CellSize<1> for Size {
    #[inline(always)]
    fn of<R: Reals>(&self, [a]: [R; 1]) -> R {
        a.max(a * -1.0)
    }
}

struct Violation(CellLaw);

impl CellSize<3> for Violation {
    #[inline(always)]
    fn of<R: Reals>(&self, [gap, p, active]: [R; 3]) -> R {
        off(self.0, gap, p, active)
    }
}

/// The preconditioned residual on the contact without its mean; its product with the residual.
struct WithoutMean {
    mean: f64,
}

impl CellRule<2, 1, 1> for WithoutMean {
    #[inline(always)]
    fn at<R: Reals>(&self, [active, residual]: [R; 2], [z]: &mut [R; 1]) -> [R; 1] {
        *z = active * (*z - self.mean);
        [*z * residual]
    }
}

/// The contact without what is outside of what is allowed, with open cells that overlap and cells at the hardness that open; its pressure; sums
/// of both.
struct Change {
    hardness: f64,
}

impl CellRule<1, 2, 2> for Change {
    #[inline(always)]
    fn at<R: Reals>(&self, [gap]: [R; 1], [active, p]: &mut [R; 2]) -> [R; 2] {
        let (zero, one, hardness) = (p.all(0.0), p.all(1.0), p.all(self.hardness));
        let holds = zero.if_at_most(*p, hardness.if_at_most(*p, zero, one), zero);
        let overlaps = zero.if_at_most(gap, zero, one);
        let opens = gap.if_at_most(zero, zero, one);
        let enters = p.all(0.5 * self.hardness).if_at_most(*p, opens, overlaps);
        *active = active.if_at_most(zero, enters, holds);
        *p = p.max(zero).min(hardness);
        [*active, *p]
    }
}
