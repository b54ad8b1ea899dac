//! How a case ended, and whether what it says is true.

use fret_core::case::{Attachments, Case, CaseError, StageControl};
use fret_core::plan::Plan;
use fret_core::run::{RunError, Silent, Simulation};
use ndarray::Array2;

use super::Family;
use super::body::Body;
use super::loads::MOST_PULL_ON_MAP;
use crate::certifier::{Ended, run_certified};

/// How a case ended.
#[derive(Debug, Clone, PartialEq)]
pub enum Outcome {
    /// Every increment was solved and certified.
    Certified,
    /// There is no answer, for this reason; every increment before was certified.
    Refused(Refusal),
    /// An increment was not solved, although it may have an answer.
    Unsolved(String),
    /// A solved increment breaks a law, or a reason that was given is not true.
    Wrong(String),
}

/// Why there is no answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Refusal {
    /// A nearly incompressible film thinner than a fifth of a cell, on a stiff base.
    UnseenFilm,
    /// The contact reaches the edge of the grid.
    ContactAtEdge,
    /// More tangential force than friction carries.
    AboveSliding,
    /// More moment than friction carries.
    AboveFullSlip,
    /// More wear in a cycle than the grid can follow.
    WearTooFast,
}

impl Refusal {
    /// In words.
    pub fn name(self) -> &'static str {
        match self {
            Self::UnseenFilm => "an incompressible film thinner than the cells resolve",
            Self::ContactAtEdge => "contact at the edge of the grid",
            Self::AboveSliding => "more tangential force than the friction limit",
            Self::AboveFullSlip => "more moment than the friction limit",
            Self::WearTooFast => "more wear in a cycle than the grid can follow",
        }
    }
}

/// How a run ended, and whether what it says is true.
pub(super) fn judged(
    body: &Body,
    text: &str,
    maps: &[Array2<f64>],
    ended: &Result<Ended, CaseError>,
) -> Outcome {
    let ended = match ended {
        Ok(ended) => ended,
        Err(error) => {
            let words = error.to_string();
            return if words.contains("film") && body.has_unseen_film() {
                Outcome::Refused(Refusal::UnseenFilm)
            } else if words.contains("reaches the edge") {
                at_edge(body, text, maps)
            } else if words.contains("friction carries at most") && pulls_more_than_its_map(body, maps) {
                Outcome::Refused(Refusal::AboveSliding)
            } else {
                Outcome::Wrong(format!("refused: {}", words.lines().next().unwrap_or_default()))
            };
        }
    };
    if let Some(wrong) = ended.wrong() {
        return Outcome::Wrong(wrong);
    }
    match &ended.error {
        None if ended.run.is_empty() => Outcome::Wrong("no increment".to_owned()),
        None => Outcome::Certified,
        Some(RunError::ContactAtEdge { .. }) => at_edge(body, text, maps),
        Some(RunError::WearTooFast { share, .. }) if body.family == Family::Wear && *share > 0.4 => {
            Outcome::Refused(Refusal::WearTooFast)
        }
        Some(RunError::AboveSliding { asked, .. }) => match carried(ended) {
            Some(carried) if *asked < 0.999 * carried => match carried_in_sliding(text, maps, ended) {
                // To what the tolerance of a solution leaves of a force.
                Some(in_sliding) if *asked > (1.0 - 1e-5) * in_sliding => {
                    Outcome::Refused(Refusal::AboveSliding)
                }
                found => Outcome::Wrong(format!(
                    "asked {asked:e}, but friction carries {carried:e}, when it slides {found:?}"
                )),
            },
            _ => Outcome::Refused(Refusal::AboveSliding),
        },
        Some(RunError::AboveFullSlip { .. }) => match moments(ended) {
            Some([asked, carried]) if asked > carried => Outcome::Refused(Refusal::AboveFullSlip),
            found => Outcome::Wrong(format!("moment asked for and moment of full slip: {found:?}")),
        },
        Some(error @ RunError::NotConverged { .. }) => Outcome::Unsolved(error.to_string()),
        Some(error) => Outcome::Wrong(error.to_string()),
    }
}

/// Whether a pull that is drawn can be more than the best patch carries; one on a single coefficient never is.
pub(super) fn pulls_more_than_its_map(body: &Body, maps: &[Array2<f64>]) -> bool {
    maps.first()
        .is_some_and(|map| map.iter().all(|coefficient| *coefficient < MOST_PULL_ON_MAP * body.friction))
}

/// A contact that is said to reach the edge has to do so where there is more room: on a grid of three times as many cells.
pub(super) fn at_edge(body: &Body, text: &str, maps: &[Array2<f64>]) -> Outcome {
    let [nx, ny] = body.cells;
    let wide = text.replacen(&body.grid(1), &body.grid(3), 1);
    let kept = format!("{wide}[output]\nfields = [\"pressure\"]\nevery = 1\n");
    let inside = |place: usize, cells: usize| place.clamp(cells, 2 * cells - 1) - cells;
    let padded = |map: &Array2<f64>| {
        Array2::from_shape_fn([3 * nx, 3 * ny], |(i, j)| map[[inside(i, nx), inside(j, ny)]])
    };
    let maps: Vec<_> = maps.iter().map(padded).collect();
    let case = Case::from_toml_with(&kept, "wide.toml", Attachments { arrays: &maps, ..Attachments::none() });
    // What is still too wide, or not solved there, is wide enough.
    let Ok(plan) = case.and_then(Plan::new) else { return Outcome::Refused(Refusal::ContactAtEdge) };
    let Ok(history) = Simulation::new(&plan).run(&mut Silent) else {
        return Outcome::Refused(Refusal::ContactAtEdge);
    };
    let outside = |place: usize, cells: usize| place <= cells || place >= 2 * cells - 1;
    let reaches = history.fields.iter().filter_map(|kept| kept.pressure.as_ref()).any(|pressure| {
        pressure.indexed_iter().any(|((i, j), p)| *p > 0.0 && (outside(i, nx) || outside(j, ny)))
    });
    if reaches {
        Outcome::Refused(Refusal::ContactAtEdge)
    } else {
        Outcome::Wrong("contact at the edge, where a wider grid finds none".to_owned())
    }
}

/// What friction carried in the last solved increment, `sum mu p dA`, when the normal load and the friction stay in the next.
pub(super) fn carried(ended: &Ended) -> Option<f64> {
    let last = ended.run.last()?;
    let case = &ended.plan.case;
    let number = ended.error.as_ref()?.increment();
    let mut first = 0;
    let stage = case.stages.iter().find(|stage| {
        first += stage.increments_in_all();
        number < first
    })?;
    let stays = stage.normal.is_none() && stage.friction.is_none();
    let pressure = last.fields.pressure.as_ref().filter(|_| stays)?;
    let sum: f64 = pressure.indexed_iter().map(|((i, j), p)| p * case.friction.at(i, j)).sum();
    Some(sum * ended.plan.grid.cell_area())
}

/// What friction carries along the force of the increment that failed when the contact slides far along it instead, certified: with its own
/// pressure, which friction that differs from place to place and shear that moves the surfaces apart make another one.
fn carried_in_sliding(text: &str, maps: &[Array2<f64>], ended: &Ended) -> Option<f64> {
    let case = &ended.plan.case;
    let last = &ended.run.last()?.record;
    let number = ended.error.as_ref()?.increment();
    let (mut first, mut failed) = (0, 0);
    while number >= first + case.stages[failed].increments_in_all() {
        first += case.stages[failed].increments_in_all();
        failed += 1;
    }
    let stage = &case.stages[failed];
    let start = &ended.run.iter().rev().find(|kept| kept.record.increment < first)?.record;
    let force = [0, 1].map(|axis| match &stage.tangential[axis] {
        Some(control @ StageControl::Force(_)) => {
            stage.value(control, start.tangential_force[axis], number - first + 1, stage.times().as_ref())
        }
        _ => last.tangential_force[axis],
    });
    let asked = force[0].hypot(force[1]);
    let far = ended.plan.grid.centre(0, ended.plan.grid.cells()[0] - 1).abs();
    let [x, y] = force.map(|part| part / asked * far);
    let stages: Vec<&str> = text.split("[[load]]").take(failed + 1).collect();
    let slid = format!("{}[[load]]\nshift = [{x:e}, {y:e}]\nincrements = 1\n", stages.join("[[load]]"));
    let ended = run_certified(&slid, maps).ok()?;
    if ended.error.is_some() || ended.wrong().is_some() {
        return None;
    }
    let [x, y] = ended.run.last()?.record.tangential_force;
    Some((x * force[0] + y * force[1]) / asked)
}

/// The moment asked for in the increment that failed, and that of full slip under its force, `sum mu p r dA`, about the place where friction
/// carries the least of it: the middle of the grid, or a cell in contact, with the moment of the tangential force about that. With the
/// pressure of the last solved increment. Where the force falls the contact shrinks at least as that of a thin film does, by the fourth
/// root of the force: it carries that much less of the moment per force.
fn moments(ended: &Ended) -> Option<[f64; 2]> {
    let last = ended.run.last()?;
    let case = &ended.plan.case;
    let number = ended.error.as_ref()?.increment();
    let mut first = 0;
    let stage = case.stages.iter().find(|stage| {
        first += stage.increments_in_all();
        number < first
    })?;
    let before = first - stage.increments_in_all();
    let start = &ended.run.iter().rev().find(|kept| kept.record.increment < before)?.record;
    let k = number - before + 1;
    let at_end = |control: &Option<StageControl>, from: f64, now: f64| match control {
        None => Some(now),
        Some(control @ StageControl::Force(_)) => Some(stage.value(control, from, k, stage.times().as_ref())),
        Some(StageControl::Motion(_) | StageControl::FarEnd(_) | StageControl::Rate(_)) => None,
    };
    let asked = at_end(&stage.twist, start.twist_moment, last.record.twist_moment)?;
    let falls =
        at_end(&stage.normal, start.normal_force, last.record.normal_force)? / last.record.normal_force;
    let forces = [0, 1].map(|axis| {
        at_end(&stage.tangential[axis], start.tangential_force[axis], last.record.tangential_force[axis])
    });
    let grid = &ended.plan.grid;
    let pressure = last.fields.pressure.as_ref()?;
    let limits: Vec<([f64; 2], f64)> = pressure
        .indexed_iter()
        .filter(|(_, p)| **p > 0.0)
        .map(|((i, j), p)| {
            let limit = p * case.friction.at(i, j) * grid.cell_area() * falls.powf(1.25);
            ([grid.centre(0, i), grid.centre(1, j)], limit)
        })
        .collect();
    let about = |[x, y]: [f64; 2], [force_x, force_y]: [f64; 2]| {
        let carried = limits.iter().map(|([i, j], limit)| limit * (i - x).hypot(j - y)).sum::<f64>();
        [(asked - x * force_y + y * force_x).abs(), carried]
    };
    let middle = about([0.0; 2], [0.0; 2]);
    let mut centres = vec![middle];
    // Beside a force the contact turns about another place. Where a motion is prescribed its force is not known.
    if let [Some(force_x), Some(force_y)] = forces {
        centres.extend(limits.iter().map(|(at, _)| about(*at, [force_x, force_y])));
    }
    let worst = centres.into_iter().max_by(|a, b| (a[0] * b[1]).total_cmp(&(b[0] * a[1])))?;
    (falls <= 1.0 && stage.friction.is_none()).then_some(worst)
}
