//! Conjugate gradients on a frozen contact, which changes only when the residual is small beside its violations: for stiff
//! coatings, whose answer to a clipped cell spreads so far that a contact changing in every iteration never settles.
//!
//! Measured on a coating 1e3 times stiffer than the half-space below: the contact, begun a little too large, shrinks in two
//! to four changes; it need not in general (rough surfaces cycle), so it gives up when its violations stop falling.

use super::normal_problem::{Ending, NormalProblem};
use super::residual::NormalVerdict;
use super::settings::SolveError;
use super::sweep::sweep;

/// The contact changes when the residual on it is this much smaller than its violations.
const SMALL_BESIDE: f64 = 0.3;
/// Changes without halving the violations before it gives up.
const PATIENCE: usize = 6;

/// What is wrong on a frozen contact.
struct Look {
    approach: f64,
    /// Largest gap on the contact or violation, in units of the mean displacement under the load.
    residual: f64,
    /// The same, gap alone.
    inner: f64,
    /// Sums of squares of the gap on the contact and of the violations.
    inner_square: f64,
    outer_square: f64,
    /// Cells of the contact under tension.
    tense: f64,
}

/// Iterates until solved, or until the violations stop falling.
///
/// # Errors
/// When somebody stopped the iteration, or it has gone on for too long.
pub fn iterate(problem: &mut NormalProblem<'_>) -> Result<Ending, SolveError> {
    let task = problem.task;
    sweep([&mut problem.active], [&*problem.pressure], |[_], [p]| ([f64::from(u8::from(p > 0.0))], [], []));
    let mut best = f64::INFINITY;
    let mut changes = 0;
    loop {
        let ([count], []) = sweep([], [&problem.active], |[], [active]| ([], [active], []));
        if count == 0.0 {
            return Ok(give_up(problem));
        }
        let mut look = examine(problem);
        let mut slope = steepest(problem, task.total.map(|_| count));
        sweep([&mut problem.change], [&problem.steepest], |[_], [z]| ([-z], [], []));
        let mut steps = 0;
        loop {
            problem.hear(look.residual)?;
            if look.residual < problem.tolerance && look.tense == 0.0 {
                let verdict = NormalVerdict { approach: look.approach, residual: look.residual };
                return Ok(Ending::Solved(verdict));
            }
            let settled = look.inner_square < SMALL_BESIDE * SMALL_BESIDE * look.outer_square;
            if steps > 0 && settled || look.inner < problem.tolerance {
                break;
            }
            problem.convolve_change();
            let ([curvature], []) =
                sweep([], [&problem.change, &problem.image], |[], [c, image]| ([], [c * image], []));
            if !(curvature > 0.0 && slope > 0.0) {
                return Ok(give_up(problem));
            }
            let share = slope / curvature;
            sweep(
                [&mut *problem.pressure, &mut *problem.displacement],
                [&problem.change, &problem.image],
                move |[p, u], [change, image]| ([p + share * change, u + share * image], [], []),
            );
            look = examine(problem);
            let before = slope;
            slope = steepest(problem, task.total.map(|_| count));
            let beta = slope / before;
            sweep([&mut problem.change], [&problem.steepest], move |[t], [z]| ([beta * t - z], [], []));
            steps += 1;
        }
        changes += 1;
        if look.outer_square < 0.25 * best {
            (best, changes) = (look.outer_square, 0);
        }
        if changes > PATIENCE {
            return Ok(give_up(problem));
        }
        change_contact(problem, look.tense > 0.0);
    }
}

/// Gap everywhere, residual on the contact, and what is wrong.
fn examine(problem: &mut NormalProblem<'_>) -> Look {
    let own = problem.own;
    let ([heights, count, work, load], []) = sweep(
        [&mut problem.gap],
        [&*problem.displacement, problem.task.undeformed, &*problem.pressure, &problem.active],
        |[_], [u, g, p, active]| ([u + g], [active * (u + g), active, p * u, p], []),
    );
    let approach = if problem.task.total.is_some() { heights / count } else { problem.task.approach };
    let ([inner_square, outer_square, tense], [inner, outer]) = sweep(
        [&mut problem.gap, &mut problem.residual],
        [&*problem.pressure, &problem.active],
        move |[height, _], [p, active]| {
            let gap = height - approach;
            let (inside, under_tension) = (active * gap, active > 0.0 && p < 0.0);
            let overlap = if active == 0.0 && gap < 0.0 { -gap } else { 0.0 };
            let violation = if under_tension { -own * p } else { overlap };
            let tense = f64::from(u8::from(under_tension));
            ([gap, inside], [inside * inside, violation * violation, tense], [inside.abs(), violation])
        },
    );
    let scale = if load > 0.0 { (work / load).abs() } else { 0.0 };
    let relative = |size: f64| if scale > 0.0 { size / scale } else { f64::INFINITY };
    Look {
        approach,
        residual: relative(inner.max(outer)),
        inner: relative(inner),
        inner_square,
        outer_square,
        tense,
    }
}

/// Preconditioned residual on the contact, without its mean where the force stays; its product with the residual.
fn steepest(problem: &mut NormalProblem<'_>, count: Option<f64>) -> f64 {
    problem.precondition();
    let ([sum], []) =
        sweep([], [&problem.steepest, &problem.active], |[], [z, active]| ([], [z * active], []));
    let mean = count.map_or(0.0, |count| sum / count);
    let ([slope], []) = sweep(
        [&mut problem.steepest],
        [&problem.active, &problem.residual],
        move |[z], [active, residual]| {
            let z = active * (z - mean);
            ([z], [z * residual], [])
        },
    );
    slope
}

/// Cells under tension leave, cells that overlap enter.
fn change_contact(problem: &mut NormalProblem<'_>, any_tense: bool) {
    let ([count, kept], []) =
        sweep([&mut problem.active, &mut *problem.pressure], [&problem.gap], |[active, p], [gap]| {
            let stays = if active > 0.0 { p >= 0.0 } else { gap < 0.0 };
            let (now, p) = if stays { (1.0, p) } else { (0.0, 0.0) };
            ([now, p], [now, p], [])
        });
    if !any_tense {
        return;
    }
    if let Some(total) = problem.task.total {
        let lift = if count > 0.0 { (total - kept) / count } else { 0.0 };
        sweep([&mut *problem.pressure], [&problem.active], move |[p], [active]| {
            ([p + lift * active], [], [])
        });
    }
    problem.convolve_pressure();
}

/// Leaves pressures feasible, with their displacements.
fn give_up(problem: &mut NormalProblem<'_>) -> Ending {
    let ([found], []) = sweep([&mut *problem.pressure], [], |[p], []| {
        let p = if p > 0.0 { p } else { 0.0 };
        ([p], [p], [])
    });
    let share = problem.task.total.map_or(1.0, |total| if found > 0.0 { total / found } else { 1.0 });
    sweep([&mut *problem.pressure], [], move |[p], []| ([share * p], [], []));
    problem.convolve_pressure();
    Ending::Stalled
}
