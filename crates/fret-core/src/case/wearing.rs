//! The judgement of wear.

use super::course::{Course, Stage};
use super::judge::Judge;
use super::stage_file::{WearFile, WearLawFile, WornBodyFile};
use crate::model::{Body, ContactPair, WearLaw, WearRule};

/// Cycles a computed one may stand for.
pub(super) const MOST_EVERY: usize = 1_000_000;

/// The wear of a case; `None` when nothing wears or it was refused.
pub(super) fn wear(
    judge: &mut Judge,
    file: Option<&WearFile>,
    bodies: Option<&ContactPair>,
    stages: Option<&[Stage]>,
    frictionless: bool,
) -> Option<WearRule> {
    let file = file?;
    let before = judge.mistakes.len();
    let coefficient = *file.coefficient.get_ref();
    if !(coefficient.is_finite() && coefficient >= 0.0) {
        let message = format!("wear.coefficient = {coefficient:?}: must be zero or positive and finite");
        judge.refuse::<()>(file.coefficient.span(), message, "");
    }
    if frictionless {
        judge.refuse::<()>(
            file.coefficient.span(),
            "wear: a contact without friction has no slip in this model",
            "[friction] coefficient = ...",
        );
    }
    let every = file.every.as_ref().map_or(1, |given| *given.get_ref());
    if let (Some(given), false) = (&file.every, (1..=MOST_EVERY).contains(&every)) {
        let message = format!("wear.every = {every}: must lie between 1 and {MOST_EVERY}");
        judge.refuse::<()>(given.span(), message, "");
    }
    let largest_step = file.largest_step.as_ref().map_or(0.01, |given| *given.get_ref());
    if let (Some(given), false) = (&file.largest_step, largest_step > 0.0 && largest_step <= 1.0) {
        let message = format!("wear.largest_step = {largest_step:?}: must lie above 0, and at 1 at the most");
        judge.refuse::<()>(given.span(), message, "relative to the approach; 0.01 serves most purposes");
    }
    for (index, stage) in stages.unwrap_or_default().iter().enumerate() {
        let Course::Cycles(cycles) = stage.course else { continue };
        let words = if cycles.until_steady.is_some() {
            "until_steady of a contact that wears: it changes with every cycle"
        } else if every > 1 && cycles.envelope[0] != cycles.envelope[1] {
            "amplitudes that change from cycle to cycle: none of them can stand for others"
        } else {
            continue;
        };
        let span = file.every.as_ref().map_or_else(|| file.coefficient.span(), toml::Spanned::span);
        judge.refuse::<()>(span, format!("wear and load[{index}]: {words}"), "cycles = ..., wear.every = 1");
    }
    let limit = limit(judge, file, bodies);
    (judge.mistakes.len() == before).then_some(WearRule {
        law: match file.law.unwrap_or(WearLawFile::Energy) {
            WearLawFile::Archard => WearLaw::Archard,
            WearLawFile::Energy => WearLaw::Energy,
        },
        coefficient,
        every,
        largest_step,
        limit,
    })
}

fn limit(judge: &mut Judge, file: &WearFile, bodies: Option<&ContactPair>) -> Option<f64> {
    match (&file.limit, &file.through_coating_of) {
        (None, None) => None,
        (Some(limit), Some(_)) => judge.refuse(
            limit.span(),
            "wear: limit and through_coating_of, both at once",
            "one of the two ends the run",
        ),
        (Some(given), None) => {
            let limit = *given.get_ref();
            if limit.is_finite() && limit > 0.0 {
                return Some(limit);
            }
            let message = format!("wear.limit = {limit:?}: must be a positive finite length");
            judge.refuse(given.span(), message, "")
        }
        (None, Some(which)) => {
            let bodies = bodies?;
            let body = match which.get_ref() {
                WornBodyFile::Upper => bodies.upper(),
                WornBodyFile::Lower => bodies.lower(),
            };
            let coating = match body {
                Body::Rigid => None,
                Body::Elastic(half_space) => half_space.coatings().first(),
            };
            match coating {
                Some(coating) => Some(coating.thickness()),
                None => judge.refuse(
                    which.span(),
                    "wear.through_coating_of: this body has no coating",
                    "wear.limit = ... ends the run at a depth of your choice",
                ),
            }
        }
    }
}
