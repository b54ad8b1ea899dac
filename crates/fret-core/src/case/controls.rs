//! The judgement of what a stage prescribes: a force or a motion for each direction, by number or by a table's column.

use toml::Spanned;

use super::course::{Path, StageControl};
use super::judge::Judge;
use super::stage_file::{AxisFile, PhaseFile, StageFile};
use super::table::{COLUMNS, Columns};

/// Normal, along x, along y, about z.
pub(super) type Controls = [Option<StageControl>; 4];

/// The controls of a stage; what is refused is left out.
pub(super) fn controls(
    judge: &mut Judge,
    place: &str,
    file: &StageFile,
    columns: Option<&Columns>,
) -> Controls {
    let named = [
        file.normal_force.as_ref().map(Spanned::span),
        file.approach.as_ref().map(Spanned::span),
        file.tangential_force.as_ref().map(Spanned::span),
        file.shift.as_ref().map(Spanned::span),
        file.twist_moment.as_ref().map(Spanned::span),
        file.twist.as_ref().map(Spanned::span),
    ];
    if let Some(columns) = columns {
        if let Some(span) = named.into_iter().flatten().next() {
            judge.refuse::<()>(
                span,
                format!("{place}: a table and a control, both at once"),
                "the table holds all controls of its stage",
            );
        }
        let column = |index: usize| columns.get(COLUMNS[index]).map(|values| Path::Through(values.clone()));
        let pair = |force: usize, motion: usize| {
            column(force).map(StageControl::Force).or_else(|| column(motion).map(StageControl::Motion))
        };
        return [pair(0, 1), pair(2, 4), pair(3, 5), pair(6, 7)];
    }
    if let Some(columns) = &file.columns
        && let Some(key) = columns.keys().next()
    {
        judge.refuse::<()>(
            key.span(),
            format!("{place}.columns: there is no table"),
            "table = \"history.csv\"",
        );
    }
    let phases = phases(judge, place, file);
    let cyclic = file.cycles.is_some() || file.until_steady.is_some();
    let path = |value: f64, phase: f64| {
        if cyclic { Path::Wave { amplitude: value, phase: phase / 360.0 } } else { Path::To(value) }
    };
    let mut scalar = |force: (&str, &Option<Spanned<f64>>), motion: (&str, &Option<Spanned<f64>>), phase| {
        let (key, given, kind): (_, _, fn(Path) -> StageControl) = match (force.1, motion.1) {
            (None, None) => return None,
            (Some(value), None) => (force.0, value, StageControl::Force),
            (None, Some(value)) => (motion.0, value, StageControl::Motion),
            (Some(_), Some(value)) => return both(judge, place, force.0, motion.0, value.span()),
        };
        let value = *given.get_ref();
        if !value.is_finite() {
            return judge.refuse(given.span(), format!("{place}.{key} = {value}: must be finite"), "");
        }
        Some(kind(path(value, phase)))
    };
    let normal = scalar(("normal_force", &file.normal_force), ("approach", &file.approach), phases[0]);
    let twist = scalar(("twist_moment", &file.twist_moment), ("twist", &file.twist), phases[3]);
    let mut tangential = [None, None];
    for (key, given) in [("tangential_force", &file.tangential_force), ("shift", &file.shift)] {
        let Some(given) = given else { continue };
        let parts = given.get_ref().map(AxisFile::value);
        if parts.iter().flatten().any(|part| !part.is_finite()) {
            judge.refuse::<()>(given.span(), format!("{place}.{key}: must be finite"), "");
            continue;
        }
        for (axis, part) in parts.into_iter().enumerate() {
            let Some(value) = part else { continue };
            if tangential[axis].is_some() {
                both::<()>(judge, place, "tangential_force", "shift", given.span());
                continue;
            }
            let path = path(value, phases[1 + axis]);
            let by_force = key == "tangential_force";
            tangential[axis] =
                Some(if by_force { StageControl::Force(path) } else { StageControl::Motion(path) });
        }
    }
    let [x, y] = tangential;
    [normal, x, y, twist]
}

fn both<T>(
    judge: &mut Judge,
    place: &str,
    force: &str,
    motion: &str,
    span: std::ops::Range<usize>,
) -> Option<T> {
    let help = if motion == "shift" {
        "prescribe one of the two along each axis: tangential_force = [1.0, \"held\"], shift = [\"held\", 0.0]"
    } else {
        "prescribe one of the two; the other follows"
    };
    judge.refuse(span, format!("{place}: {force} and {motion}, both at once"), help)
}

/// Phases of the four controls [degrees].
fn phases(judge: &mut Judge, place: &str, file: &StageFile) -> [f64; 4] {
    let mut phases = [0.0; 4];
    let Some(given) = &file.phase else { return phases };
    let PhaseFile { normal_force, approach, tangential_force, shift, twist_moment, twist } = given.get_ref();
    let scalars = [
        (0, "normal_force", normal_force, file.normal_force.is_some()),
        (0, "approach", approach, file.approach.is_some()),
        (3, "twist_moment", twist_moment, file.twist_moment.is_some()),
        (3, "twist", twist, file.twist.is_some()),
    ];
    for (index, key, phase, there) in scalars {
        let Some(phase) = phase else { continue };
        if usable(judge, place, key, &[*phase.get_ref()], there, phase.span()) {
            phases[index] = *phase.get_ref();
        }
    }
    let pairs =
        [("tangential_force", tangential_force, &file.tangential_force), ("shift", shift, &file.shift)];
    for (key, phase, control) in pairs {
        let Some(phase) = phase else { continue };
        if usable(judge, place, key, &phase.get_ref().0, control.is_some(), phase.span()) {
            for axis in 0..2 {
                let moved = control.as_ref().is_some_and(|control| control.get_ref()[axis] != AxisFile::Held);
                if moved {
                    phases[1 + axis] = phase.get_ref()[axis];
                }
            }
        }
    }
    phases
}

fn usable(
    judge: &mut Judge,
    place: &str,
    key: &str,
    phase: &[f64],
    there: bool,
    span: std::ops::Range<usize>,
) -> bool {
    let refused = if !there {
        Some((
            format!("{place}.phase.{key}: this stage has no {key}"),
            "phases are named like their controls",
        ))
    } else if phase.iter().any(|value| !value.is_finite()) {
        Some((
            format!("{place}.phase.{key} = {phase:?}: must be finite"),
            "in degrees: 90 is a quarter of a cycle",
        ))
    } else {
        None
    };
    if let Some((message, help)) = refused {
        judge.refuse::<()>(span, message, help);
        return false;
    }
    true
}
