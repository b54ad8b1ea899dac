//! The judgement of the loading history.

use toml::Spanned;

use super::file::{RampFile, StageFile};
use super::judge::Judge;
use super::{Course, Stage, StageControl};
use crate::model::CoulombFriction;

/// Increments of a whole history, at the most.
const MOST_INCREMENTS: usize = 10_000_000;

/// The stages; `None` when something about them was refused.
pub(super) fn stages(
    judge: &mut Judge,
    list: &Spanned<Vec<Spanned<StageFile>>>,
    friction: Option<&[&CoulombFriction]>,
) -> Option<Vec<Stage>> {
    if list.get_ref().is_empty() {
        return judge.refuse(
            list.span(),
            "load: no stage",
            "[[load]] with normal_force = ... and increments = ...",
        );
    }
    let mut checked = Vec::new();
    for (index, given) in list.get_ref().iter().enumerate() {
        let frictionless = friction.is_some_and(|laws| laws[index].is_frictionless());
        checked.push(stage(judge, index, given, frictionless));
    }
    let stages: Vec<Stage> = checked.into_iter().collect::<Option<_>>()?;
    let in_all = stages.iter().fold(0_usize, |sum, stage| {
        sum.saturating_add(match stage.course {
            Course::Cycles(cycles) => stage.increments.saturating_mul(cycles),
            Course::Linear | Course::Cubic => stage.increments,
        })
    });
    if in_all > MOST_INCREMENTS {
        return judge.refuse(
            list.span(),
            format!("load: {in_all} increments in all; at most {MOST_INCREMENTS}"),
            "",
        );
    }
    Some(stages)
}

fn stage(judge: &mut Judge, index: usize, given: &Spanned<StageFile>, frictionless: bool) -> Option<Stage> {
    let before = judge.mistakes.len();
    let file = given.get_ref();
    let name = file.name.clone().unwrap_or_else(|| format!("stage {}", index + 1));
    let place = format!("load[{index}] ({name})");
    let increments = *file.increments.get_ref();
    if !(1..=MOST_INCREMENTS).contains(&increments) {
        let message = format!("{place}.increments = {increments}: must lie between 1 and {MOST_INCREMENTS}");
        judge.refuse::<()>(file.increments.span(), message, "");
    }
    let normal = one_control(
        judge,
        &place,
        ("normal_force", file.normal_force.as_ref()),
        ("approach", file.approach.as_ref()),
    );
    let twist = one_control(
        judge,
        &place,
        ("twist_moment", file.twist_moment.as_ref()),
        ("twist", file.twist.as_ref()),
    );
    let tangential = tangential_control(judge, &place, file);
    if index == 0 && file.normal_force.is_none() && file.approach.is_none() {
        judge.refuse::<()>(
            given.span(),
            format!("{place}: the first stage says neither normal_force nor approach"),
            "bodies must be pressed together first: normal_force = ...",
        );
    }
    if let (Some(StageControl::Force(force)), Some(value)) = (normal, &file.normal_force)
        && force < 0.0
    {
        judge.refuse::<()>(
            value.span(),
            format!(
                "{place}.normal_force = {force:?}: compression is positive, and the surfaces do not adhere"
            ),
            "",
        );
    }
    let course = course(judge, &place, file, increments);
    if frictionless
        && let Some(span) = [
            file.tangential_force.as_ref().filter(|force| force.get_ref() != &[0.0; 2]).map(Spanned::span),
            file.shift.as_ref().map(Spanned::span),
            file.twist_moment.as_ref().map(Spanned::span),
            file.twist.as_ref().map(Spanned::span),
        ]
        .into_iter()
        .flatten()
        .next()
    {
        judge.refuse::<()>(
            span,
            format!("{place}: a tangential load on a contact without friction"),
            "[friction] coefficient = ..., or leave the tangential load out",
        );
    }
    let says_nothing = normal.is_none() && tangential.is_none() && twist.is_none() && file.friction.is_none();
    if says_nothing && judge.mistakes.len() == before {
        judge.refuse::<()>(
            given.span(),
            format!("{place}: nothing is prescribed"),
            "normal_force, approach, tangential_force, shift, twist_moment, twist or friction",
        );
    }
    (judge.mistakes.len() == before).then(|| Stage {
        name,
        normal,
        tangential,
        twist,
        increments,
        course: course.unwrap_or(Course::Linear),
        friction: None,
    })
}

fn course(judge: &mut Judge, place: &str, file: &StageFile, increments: usize) -> Option<Course> {
    match (&file.cycles, &file.ramp) {
        (Some(cycles), Some(_)) => judge.refuse(
            cycles.span(),
            format!("{place}: ramp and cycles, both at once"),
            "cycles run linearly: leave out the ramp, or give the ramp a stage of its own",
        ),
        (Some(cycles), None) => {
            let count = *cycles.get_ref();
            if !(1..=1_000_000).contains(&count) {
                return judge.refuse(
                    cycles.span(),
                    format!("{place}.cycles = {count}: must lie between 1 and 1000000"),
                    "",
                );
            }
            if increments < 4 {
                return judge.refuse(
                    file.increments.span(),
                    format!("{place}.increments = {increments}: a cycle turns twice and needs at least 4"),
                    "",
                );
            }
            let normal = file.normal_force.as_ref().or(file.approach.as_ref());
            if let Some(normal) = normal {
                return judge.refuse(
                    normal.span(),
                    format!("{place}: a normal load that runs in cycles is not built yet"),
                    "cycles of tangential_force, shift, twist_moment or twist are built",
                );
            }
            Some(Course::Cycles(count))
        }
        (None, Some(ramp)) => Some(match ramp.get_ref() {
            RampFile::Linear => Course::Linear,
            RampFile::Cubic => Course::Cubic,
        }),
        (None, None) => Some(Course::Linear),
    }
}

type Given<'a, T> = (&'a str, Option<&'a Spanned<T>>);

fn one_control(
    judge: &mut Judge,
    place: &str,
    force: Given<'_, f64>,
    motion: Given<'_, f64>,
) -> Option<StageControl> {
    let (key, value, control): (&str, &Spanned<f64>, fn(f64) -> StageControl) = match (force.1, motion.1) {
        (None, None) => return None,
        (Some(value), None) => (force.0, value, StageControl::Force),
        (None, Some(value)) => (motion.0, value, StageControl::Motion),
        (Some(_), Some(value)) => {
            return judge.refuse(
                value.span(),
                format!("{place}: {} and {}, both at once", force.0, motion.0),
                "prescribe one of the two; the other follows",
            );
        }
    };
    if !value.get_ref().is_finite() {
        return judge.refuse(
            value.span(),
            format!("{place}.{key} = {}: must be finite", value.get_ref()),
            "",
        );
    }
    Some(control(*value.get_ref()))
}

fn tangential_control(judge: &mut Judge, place: &str, file: &StageFile) -> Option<[StageControl; 2]> {
    type Kind = fn(f64) -> StageControl;
    let (key, value, control): (&str, &Spanned<[f64; 2]>, Kind) = match (&file.tangential_force, &file.shift)
    {
        (None, None) => return None,
        (Some(value), None) => ("tangential_force", value, StageControl::Force),
        (None, Some(value)) => ("shift", value, StageControl::Motion),
        (Some(_), Some(value)) => {
            return judge.refuse(
                value.span(),
                format!("{place}: tangential_force and shift, both at once"),
                "prescribe one of the two; the other follows",
            );
        }
    };
    if value.get_ref().iter().any(|part| !part.is_finite()) {
        return judge.refuse(
            value.span(),
            format!("{place}.{key} = {:?}: must be finite", value.get_ref()),
            "",
        );
    }
    Some(value.get_ref().map(control))
}

/// Forces that Coulomb's law, which is given for each stage, cannot carry are refused before anything is computed, as far as the forces are given.
pub(super) fn sliding(
    judge: &mut Judge,
    friction: &[&CoulombFriction],
    list: &Spanned<Vec<Spanned<StageFile>>>,
) {
    let mut normal = None;
    let mut held = [0.0; 2];
    for (index, stage) in list.get_ref().iter().enumerate() {
        let stage = stage.get_ref();
        let start = normal;
        if let Some(force) = &stage.normal_force {
            normal = Some(*force.get_ref());
        } else if stage.approach.is_some() {
            normal = None;
        }
        let Some(tangential) = &stage.tangential_force else {
            if stage.shift.is_some() {
                return;
            }
            continue;
        };
        let Some(force) = normal else { continue };
        let force = if stage.cycles.is_some() { start.unwrap_or(force) } else { force };
        let reached = if stage.cycles.is_some() {
            let given = tangential.get_ref();
            let [plus, minus] =
                [1.0, -1.0].map(|sign| (held[0] + sign * given[0]).hypot(held[1] + sign * given[1]));
            plus.max(minus)
        } else {
            held = *tangential.get_ref();
            held[0].hypot(held[1])
        };
        let largest = friction[index].largest();
        let bound = largest * force;
        if reached > bound * (1.0 + 1e-12) && largest > 0.0 {
            judge.refuse::<()>(
                tangential.span(),
                format!("load[{index}].tangential_force reaches {reached:e}: friction carries at most mu W = {bound:e}"),
                "a force above mu W has no equilibrium; prescribe the shift to slide",
            );
        }
    }
}
