//! The judgement of wear.

use toml::Spanned;

use super::body_file::BodyFile;
use super::course::{Course, Stage};
use super::file::StressFile;
use super::judge::Judge;
use super::stage_file::{WearFile, WearLawFile, WornBodyFile};
use crate::model::{Body, ContactPair, WearLaw, WearLayers, WearRule, WornLayer};

/// Cycles a computed one may stand for.
pub(super) const MOST_EVERY: usize = 1_000_000;
/// Largest relative change of thickness between two responses.
const MOST_THINNING: f64 = 0.5;

/// The wear of a case; `None` when nothing wears or it was refused.
pub(super) fn wear(
    judge: &mut Judge,
    (given, stress): (Option<&Spanned<WearFile>>, Option<&Spanned<StressFile>>),
    (bodies, files): (Option<&ContactPair>, [(&str, &BodyFile); 2]),
    stages: Option<&[Stage]>,
    frictionless: bool,
) -> Option<WearRule> {
    let before = judge.mistakes.len();
    let layers = files.map(|(which, body)| layers(judge, which, body));
    let own: Option<&Spanned<f64>> = parts(files).into_iter().find_map(|part| part.coefficient);
    let Some(given) = given else {
        return own.and_then(|own| {
            judge.refuse(own.span(), "wear_coefficient without a table [wear]", "[wear] law = \"energy\"")
        });
    };
    let file = given.get_ref();
    let span = file.coefficient.as_ref().or(own).map(Spanned::span);
    let Some(span) = span else {
        return judge.refuse(
            given.span(),
            "[wear] needs a coefficient",
            "coefficient = ... in [wear], or wear_coefficient = ... in the layers that wear",
        );
    };
    let coefficient = file.coefficient.as_ref().map(|given| *given.get_ref());
    if let (Some(given), Some(value)) = (&file.coefficient, coefficient)
        && !(value.is_finite() && value >= 0.0)
    {
        let message = format!("wear.coefficient = {value:?}: must be zero or positive and finite");
        judge.refuse::<()>(given.span(), message, "");
    }
    if let (Some(_), Some(own)) = (&file.coefficient, own) {
        judge.refuse::<()>(
            own.span(),
            "wear_coefficient and wear.coefficient, both at once",
            "wear.coefficient is that of both bodies together: leave out one of the two",
        );
    }
    if frictionless {
        judge.refuse::<()>(
            span.clone(),
            "wear: a contact without friction has no slip in this model",
            "[friction] coefficient = ...",
        );
    }
    let jumps = file.tolerance.is_some();
    let every = file.every.as_ref().map_or(if jumps { MOST_EVERY } else { 1 }, |given| *given.get_ref());
    if let (Some(given), false) = (&file.every, (1..=MOST_EVERY).contains(&every)) {
        let message = format!("wear.every = {every}: must lie between 1 and {MOST_EVERY}");
        judge.refuse::<()>(given.span(), message, "");
    }
    let largest_step = file.largest_step.as_ref().map_or(0.01, |given| *given.get_ref());
    if let (Some(given), false) = (&file.largest_step, largest_step > 0.0 && largest_step <= 1.0) {
        let message = format!("wear.largest_step = {largest_step:?}: must lie above 0, and at 1 at the most");
        judge.refuse::<()>(given.span(), message, "relative to the approach; 0.01 serves most purposes");
    }
    let within = |judge: &mut Judge, key: &str, given: Option<&Spanned<f64>>, most: f64| {
        let given = given?;
        let value = *given.get_ref();
        if value > 0.0 && value <= most {
            return Some(value);
        }
        let message = format!("wear.{key} = {value:?}: must lie above 0, and at {most} at the most");
        judge.refuse(given.span(), message, "0.02 serves most purposes")
    };
    let tolerance = within(judge, "tolerance", file.tolerance.as_ref(), 1.0);
    let thinning = within(judge, "thinning_tolerance", file.thinning_tolerance.as_ref(), MOST_THINNING);
    if let (Some(given), None) = (&file.thinning_tolerance, own) {
        judge.refuse::<()>(
            given.span(),
            "wear.thinning_tolerance: nothing says which body wears, and how its layers do",
            "wear_coefficient = ... in all layers of the body that wears, in place of wear.coefficient",
        );
    }
    if let (Some(table), Some(_)) = (stress, thinning) {
        judge.refuse::<()>(
            table.span(),
            "stress and wear.thinning_tolerance: stresses below are those of the unworn layers",
            "leave out one of the two",
        );
    }
    let jumping = file.every.as_ref().map_or_else(|| span.clone(), Spanned::span);
    cycles_that_wear(judge, jumping, every, stages.unwrap_or_default());
    let layers = own.is_some().then(|| WearLayers::new(layers.map(Option::unwrap_or_default)));
    let limit = limit(judge, file, (bodies, files), layers.as_ref());
    let coating = coating_gone(files, layers.as_ref());
    (judge.mistakes.len() == before).then_some(WearRule {
        law: match file.law.unwrap_or(WearLawFile::Energy) {
            WearLawFile::Archard => WearLaw::Archard,
            WearLawFile::Energy => WearLaw::Energy,
        },
        coefficient,
        layers,
        every,
        largest_step,
        limit,
        coating,
        tolerance,
        thinning_tolerance: thinning,
    })
}

/// Refuses cycles that wear has no place for.
fn cycles_that_wear(judge: &mut Judge, span: std::ops::Range<usize>, every: usize, stages: &[Stage]) {
    for (index, stage) in stages.iter().enumerate() {
        let Course::Cycles(cycles) = stage.course else { continue };
        let words = if cycles.until_steady.is_some() {
            "until_steady of a contact that wears: it changes with every cycle"
        } else if every > 1 && cycles.envelope[0] != cycles.envelope[1] {
            "amplitudes that change from cycle to cycle: none of them can stand for others"
        } else {
            continue;
        };
        let message = format!("wear and load[{index}]: {words}");
        judge.refuse::<()>(span.clone(), message, "cycles = ..., wear.every = 1");
    }
}

/// A part of a body that may wear: a coating, a substrate or what is rigid.
struct Part<'a> {
    place: String,
    span: std::ops::Range<usize>,
    thickness: f64,
    coefficient: Option<&'a Spanned<f64>>,
    /// Whether it may be left without a coefficient: it does not wear then.
    may_lack: bool,
}

fn parts<'a>(files: [(&str, &'a BodyFile); 2]) -> Vec<Part<'a>> {
    files.into_iter().flat_map(|(which, body)| parts_of(which, body)).collect()
}

/// From the surface down.
fn parts_of<'a>(which: &str, body: &'a BodyFile) -> Vec<Part<'a>> {
    let coatings = body.coatings.as_ref().map_or(&[][..], |list| list.get_ref());
    let mut parts: Vec<Part<'a>> = coatings
        .iter()
        .enumerate()
        .map(|(index, coating)| Part {
            place: format!("{which}.coatings[{index}]"),
            span: coating.span(),
            thickness: *coating.get_ref().thickness.get_ref(),
            coefficient: coating.get_ref().wear_coefficient.as_ref(),
            may_lack: false,
        })
        .collect();
    let rigid = body.wear_coefficient.as_ref();
    if let Some(substrate) = &body.substrate {
        parts.push(Part {
            place: format!("{which}.substrate"),
            span: substrate.span(),
            thickness: f64::INFINITY,
            coefficient: substrate.get_ref().wear_coefficient.as_ref(),
            may_lack: false,
        });
    }
    if body.substrate.is_none() || rigid.is_some() {
        parts.push(Part {
            place: which.to_owned(),
            span: rigid.map_or(0..0, Spanned::span),
            thickness: f64::INFINITY,
            coefficient: rigid,
            may_lack: true,
        });
    }
    parts
}

/// The layers of a body that wears; `None` of one that does not, or was refused.
fn layers(judge: &mut Judge, which: &str, body: &BodyFile) -> Option<Vec<WornLayer>> {
    let parts = parts_of(which, body);
    if parts.iter().all(|part| part.coefficient.is_none()) {
        return None;
    }
    if let (Some(own), true) = (&body.wear_coefficient, body.substrate.is_some()) {
        return judge.refuse(
            own.span(),
            format!("{which}.wear_coefficient: beside a substrate it belongs into the substrate"),
            "substrate = { ..., wear_coefficient = ... }",
        );
    }
    let mut layers = Vec::new();
    for part in &parts {
        let place = &part.place;
        let coefficient = match part.coefficient {
            None if part.may_lack => 0.0,
            None => {
                return judge.refuse(
                    part.span.clone(),
                    format!("{place}: no wear_coefficient, but another part of this body has one"),
                    "of all layers and what they lie on, or of none; 0 of one that does not wear",
                );
            }
            Some(given) => *given.get_ref(),
        };
        if !(coefficient.is_finite() && coefficient >= 0.0) {
            let message =
                format!("{place}.wear_coefficient = {coefficient:?}: must be zero or positive and finite");
            return judge.refuse(part.coefficient.map_or(0..0, Spanned::span), message, "");
        }
        layers.push(WornLayer { thickness: part.thickness, coefficient });
    }
    Some(layers)
}

fn limit(
    judge: &mut Judge,
    file: &WearFile,
    (bodies, files): (Option<&ContactPair>, [(&str, &BodyFile); 2]),
    layers: Option<&WearLayers>,
) -> Option<f64> {
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
            let (number, body) = match which.get_ref() {
                WornBodyFile::Lower => (0, bodies.lower()),
                WornBodyFile::Upper => (1, bodies.upper()),
            };
            let coated = matches!(body, Body::Elastic(half_space) if !half_space.coatings().is_empty());
            // As it is written: a graded one is many layers in the half-space.
            let written = files[number].1.coatings.as_ref().and_then(|list| list.get_ref().first());
            let Some(written) = written.filter(|_| coated) else {
                return judge.refuse(
                    which.span(),
                    "wear.through_coating_of: this body has no coating",
                    "wear.limit = ... ends the run at a depth of your choice",
                );
            };
            let thickness = *written.get_ref().thickness.get_ref();
            let Some(layers) = layers else { return Some(thickness) };
            match layers.when_body_has_lost(number, thickness) {
                Some(worn) => Some(worn.depth()),
                None => judge.refuse(
                    which.span(),
                    "wear.through_coating_of: this coating does not wear",
                    "a positive wear_coefficient of this coating",
                ),
            }
        }
    }
}

/// Depth off both bodies together at which the first of their outermost coatings is gone [length]; of one coefficient for both bodies
/// that depth is taken for the coated body's. `None` without coatings that wear.
fn coating_gone(files: [(&str, &BodyFile); 2], layers: Option<&WearLayers>) -> Option<f64> {
    let of_body = |(number, (_, body)): (usize, &(&str, &BodyFile))| {
        let written = body.coatings.as_ref()?.get_ref().first()?;
        let thickness = *written.get_ref().thickness.get_ref();
        match layers {
            None => Some(thickness),
            Some(layers) => layers.when_body_has_lost(number, thickness).map(|worn| worn.depth()),
        }
    };
    files.iter().enumerate().filter_map(of_body).reduce(f64::min)
}

#[cfg(test)]
mod tests;
