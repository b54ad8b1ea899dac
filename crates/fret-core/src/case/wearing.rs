//! The judgement of wear.

use super::evolution::changing_cycles;
use super::judge::Judge;
use super::known::Known;
use super::parts::{Constant, NamedBody};
use super::stage_file::WearFile;
use super::third_body::third_body;
use crate::document::At;
use crate::model::{Body, ContactPair, Kinematics, OwnDepths, WearLaw, WearLayers, WearRule, WornLayer};

/// Cycles a computed one may stand for.
pub(super) const MOST_EVERY: usize = 1_000_000;

/// The wear of a case; `None` when nothing wears or it was refused.
pub(super) fn wear(judge: &mut Judge, known: &Known<'_>, kinematics: Kinematics) -> Option<WearRule> {
    let (before, files) = (judge.mistakes.len(), known.written());
    let layers = files.map(|body| {
        let help = "of all layers and what they lie on, or of none; 0 of one that does not wear";
        let parts = Constant::WEAR_COEFFICIENT.values(judge, body, Some(0.0), help)?;
        Some(parts.into_iter().map(|(thickness, coefficient)| WornLayer { thickness, coefficient }).collect())
    });
    let own = files.into_iter().find_map(|body| Constant::WEAR_COEFFICIENT.first(body));
    let Some(given) = &known.file.wear else {
        return own.and_then(|own| {
            judge.refuse(own, "wear_coefficient without a table [wear]", "[wear] law = \"energy\"")
        });
    };
    let file = &given.value;
    let span = file.coefficient.as_ref().map(At::span).or(own.clone());
    let Some(span) = span else {
        return judge.refuse(
            given.span(),
            "[wear] needs a coefficient",
            "coefficient = ... in [wear], or wear_coefficient = ... in the layers that wear",
        );
    };
    let coefficient = file.coefficient.as_ref().map(|given| given.value);
    let whole = if file.tolerance.is_some() { MOST_EVERY } else { 1 };
    let every = file.every.as_ref().map_or(whole, |given| given.value);
    let thinning = file.thinning_tolerance.as_ref().map(|given| given.value);
    judge.refuse_given([
        (
            own.clone().filter(|_| coefficient.is_some()),
            "wear_coefficient and wear.coefficient, both at once",
            "wear.coefficient is that of both bodies together: leave out one of the two",
        ),
        (
            known.is_frictionless().then(|| span.clone()),
            "wear: a contact without friction has no slip in this model",
            "[friction] coefficient = ...",
        ),
        (
            file.thinning_tolerance.as_ref().map(At::span).filter(|_| own.is_none()),
            "wear.thinning_tolerance: nothing says which body wears, and how its layers do",
            "wear_coefficient = ... in all layers of the body that wears, in place of wear.coefficient",
        ),
        (
            known.file.stress.as_ref().map(At::span).filter(|_| thinning.is_some()),
            "stress and wear.thinning_tolerance: stresses below are those of the unworn layers",
            "leave out one of the two",
        ),
    ]);
    let jumping = file.every.as_ref().map_or_else(|| span.clone(), At::span);
    changing_cycles(judge, jumping, ("wear", "that wears"), every, known.stages.unwrap_or_default());
    let layers = own.is_some().then(|| WearLayers::new(layers.map(Option::unwrap_or_default)));
    let limit = limit(judge, file, (known.bodies, files), layers.as_ref());
    let (debris, rim) = third_body(judge, file, (kinematics, !known.periodic().is_none()), layers.as_ref());
    let own = kinematics.is_finite().then(|| [0, 1].map(|body| own_depths(body, file, files, limit)));
    // where the bodies were refused, a thickness may be no number
    let coating = known.bodies.and_then(|_| coating_gone(files, layers.as_ref()));
    (judge.mistakes.len() == before).then_some(WearRule {
        law: file.law.unwrap_or(WearLaw::Energy),
        coefficient,
        layers,
        every,
        largest_step: file.largest_step.unwrap_or(0.01),
        limit,
        coating,
        tolerance: file.tolerance,
        thinning_tolerance: thinning,
        own,
        debris,
        rim,
    })
}

fn limit(
    judge: &mut Judge,
    file: &WearFile,
    (bodies, files): (Option<&ContactPair>, [NamedBody<'_>; 2]),
    layers: Option<&WearLayers>,
) -> Option<f64> {
    match (&file.limit, &file.through_coating_of) {
        (None, None) => None,
        (Some(limit), Some(_)) => {
            judge.both_or(limit.span(), "wear: limit and through_coating_of", "one of the two ends the run")
        }
        (Some(limit), None) => Some(limit.value),
        (None, Some(which)) => {
            let number = which.value.number();
            let body = [bodies?.lower(), bodies?.upper()][number];
            let coated = matches!(body, Body::Elastic(half_space) if !half_space.coatings().is_empty());
            let Some(thickness) = outermost(files, number).filter(|_| coated) else {
                return judge.refuse(
                    which.span(),
                    "wear.through_coating_of: this body has no coating",
                    "wear.limit = ... ends the run at a depth of your choice",
                );
            };
            WearLayers::depth_when_lost(layers, number, thickness).or_else(|| {
                judge.refuse(
                    which.span(),
                    "wear.through_coating_of: this coating does not wear",
                    "a positive wear_coefficient of this coating",
                )
            })
        }
    }
}

/// Thickness of the outermost coating of a body, as it is written: a graded one is many layers in the half-space.
fn outermost(files: [NamedBody<'_>; 2], body: usize) -> Option<f64> {
    Some(files[body].1.coatings.as_ref()?.value.first()?.thickness.value)
}

/// The depths of one body alone that a run looks for; `limit`: where the case has one, of both bodies together.
fn own_depths(body: usize, file: &WearFile, files: [NamedBody<'_>; 2], limit: Option<f64>) -> OwnDepths {
    let coating = outermost(files, body);
    let limit = match &file.through_coating_of {
        Some(which) => coating.filter(|_| which.value.number() == body),
        None => limit,
    };
    OwnDepths { limit, coating }
}

/// Depth off both bodies together at which the first of their outermost coatings is gone [length]; `None` without coatings that wear.
fn coating_gone(files: [NamedBody<'_>; 2], layers: Option<&WearLayers>) -> Option<f64> {
    let gone = |body| WearLayers::depth_when_lost(layers, body, outermost(files, body)?);
    (0..2).filter_map(gone).reduce(f64::min)
}

#[cfg(test)]
mod tests;
