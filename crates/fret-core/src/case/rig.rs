//! The judgement of the machine: how stiff it is, that a stage which drives its far end has one, and what its logs look like.

use std::ops::Range;

use toml::Spanned;

use super::along::AlongFile;
use super::file::{LogColumnsFile, RigFile};
use super::judge::Judge;
use super::stage_file::StageFile;
use super::table::{ACTUATOR, ACTUATOR_APPROACH, COLUMNS, Columns};
use crate::model::Rig;

/// The machine of a case; `None` where there is none, or something about it was refused.
pub(super) fn rig(judge: &mut Judge, file: Option<&RigFile>) -> Option<Rig> {
    let file = file?;
    let before = judge.mistakes.len();
    let mut compliance = |place: &str, stiffness: f64, span: Range<usize>| {
        let compliance = 1.0 / stiffness;
        if stiffness > 0.0 && stiffness.is_finite() && compliance.is_finite() {
            return compliance;
        }
        judge.refuse::<()>(
            span,
            format!("{place} = {stiffness:?}: must be a positive finite stiffness [force/length]"),
            "leave it out where the machine does not give",
        );
        0.0
    };
    let tangential = file.tangential_stiffness.as_ref().map_or([0.0; 2], |given| {
        let stiffness = match *given.get_ref() {
            AlongFile::Both(both) => both,
            AlongFile::Line(one) => [one; 2],
        };
        stiffness.map(|stiffness| compliance("rig.tangential_stiffness", stiffness, given.span()))
    });
    let normal = file
        .normal_stiffness
        .as_ref()
        .map_or(0.0, |given| compliance("rig.normal_stiffness", *given.get_ref(), given.span()));
    (judge.mistakes.len() == before).then_some(Rig { normal, tangential })
}

/// What the columns of a measured log are called: what each holds, and its name.
pub(super) fn log_columns(judge: &mut Judge, file: Option<&RigFile>) -> Vec<(&'static str, String)> {
    let Some(LogColumnsFile { displacement, force, cycle, normal_force }) =
        file.and_then(|rig| rig.columns.as_ref())
    else {
        return Vec::new();
    };
    let given =
        [("displacement", displacement), ("force", force), ("cycle", cycle), ("normal_force", normal_force)];
    let mut columns = Vec::new();
    for (what, name) in given.into_iter().filter_map(|(what, name)| Some((what, name.as_ref()?))) {
        if name.get_ref().trim().is_empty() {
            let message = format!("rig.columns.{what}: must be the name of a column");
            judge.refuse::<()>(name.span(), message, "as it stands in the head of the log, without its unit");
        }
        columns.push((what, name.get_ref().trim().to_owned()));
    }
    columns
}

/// Refuses an actuator that nothing connects with the body.
pub(super) fn driven(
    judge: &mut Judge,
    place: &str,
    file: &StageFile,
    columns: Option<&Columns>,
    rig: Option<&RigFile>,
) {
    let has = |indices: &[usize]| {
        let named = |index: &usize| columns.is_some_and(|columns| columns.contains_key(COLUMNS[*index]));
        indices.iter().any(named).then(|| file.table.as_ref().map(Spanned::span)).flatten()
    };
    let tangential = file.actuator.as_ref().map(Spanned::span).or_else(|| has(&ACTUATOR));
    let normal = file.actuator_approach.as_ref().map(Spanned::span).or_else(|| has(&[ACTUATOR_APPROACH]));
    let stiff = [
        ("actuator", "shift", "tangential_stiffness", tangential, |rig: &RigFile| {
            rig.tangential_stiffness.is_some()
        }),
        ("actuator_approach", "approach", "normal_stiffness", normal, |rig: &RigFile| {
            rig.normal_stiffness.is_some()
        }),
    ] as [(_, _, _, _, fn(&RigFile) -> bool); 2];
    for (key, own, stiffness, span, is_given) in stiff {
        if let (Some(span), false) = (span, rig.is_some_and(is_given)) {
            judge.refuse::<()>(
                span,
                format!("{place}.{key}: the case does not say how stiff the machine is"),
                &format!("[rig] {stiffness} = ...; or prescribe the {own} of the body itself"),
            );
        }
    }
}
