//! The controls of a stage: by key, with their phases, or by a table's columns. `model/controls.rs` says what there is.

use std::ops::Range;

use super::control_keys::Given;
use super::judge::Judge;
use super::mean_gap::counted_from;
use super::stage_file::StageFile;
use crate::document::At;
use crate::measured::Loads;
use crate::model::controls::{self, Column, ControlRow, FREEDOMS, Form, Kind, LARGEST};
use crate::model::stage::{Path, StageControl};

/// What a stage prescribes, for each degree of freedom; what is refused is left out.
pub(super) type Controls = [Option<StageControl>; FREEDOMS];

/// The controls of a stage.
pub(super) fn controls(
    judge: &mut Judge,
    place: &str,
    file: &StageFile,
    columns: Option<&Loads>,
) -> Controls {
    if let Some(columns) = columns {
        if let Some(span) = file.controls.place(0..FREEDOMS) {
            let help = "the table holds all controls of its stage";
            judge.both_or::<()>(span, &format!("{place}: a table and a control"), help);
        }
        let span = file.table.as_ref().map(At::span).unwrap_or_default();
        return from_table(judge, (place, &span), columns);
    }
    if let Some((key, _)) = file.columns.as_ref().and_then(|columns| columns.0.first()) {
        judge.refuse::<()>(
            key.span(),
            format!("{place}.columns: there is no table"),
            "table = \"history.csv\"",
        );
    }
    let phases = phases(judge, place, file);
    let cyclic = file.cycles.is_some() || file.until_steady.is_some();
    let mut controls = Controls::default();
    let mut by = [""; FREEDOMS];
    for Given { row, way, values, span } in &file.controls.0 {
        let key = way.name;
        if values.iter().flatten().any(|value| !(value.abs() <= LARGEST)) {
            let value = if let [Some(value)] = values[..] { format!(" = {value:?}") } else { String::new() };
            judge.refuse::<()>(
                span.clone(),
                format!("{place}.{key}{value}: must be finite, 1e100 at the most"),
                "",
            );
            continue;
        }
        for (freedom, value) in row.freedoms().zip(values) {
            let Some(value) = *value else { continue };
            if controls[freedom].is_some() {
                both(judge, place, by[freedom], row, key, span.clone());
                continue;
            }
            let path = if cyclic {
                Path::Wave { amplitude: value, phase: phases[freedom] / 360.0 }
            } else {
                Path::To(value)
            };
            let plane = match way.kind {
                Kind::MeanGap => counted_from(judge, place, span.clone(), (!cyclic).then_some(value)),
                Kind::Force | Kind::Motion | Kind::FarEnd | Kind::Rate => Some(0.0),
            };
            controls[freedom] = plane.map(|plane| StageControl::new(way.kind, path, plane));
            by[freedom] = key;
        }
    }
    controls
}

/// The phase of each degree of freedom [degrees]; 0 where none is given.
fn phases(judge: &mut Judge, place: &str, file: &StageFile) -> [f64; FREEDOMS] {
    let mut phases = [0.0; FREEDOMS];
    for Given { row, way, values, span } in file.phase.iter().flat_map(|phase| &phase.keys.0) {
        let key = way.name;
        let values: Vec<f64> = values.iter().flatten().copied().collect();
        let Some(control) = file.controls.of(key) else {
            judge.refuse::<()>(
                span.clone(),
                format!("{place}.phase.{key}: this stage has no {key}"),
                "phases are named like their controls",
            );
            continue;
        };
        if values.iter().any(|value| !value.is_finite()) {
            judge.refuse::<()>(
                span.clone(),
                format!("{place}.phase.{key} = {values:?}: must be finite"),
                "in degrees: 90 is a quarter of a cycle",
            );
            continue;
        }
        for ((freedom, phase), control) in row.freedoms().zip(values).zip(&control.values) {
            if control.is_some() {
                phases[freedom] = phase;
            }
        }
    }
    phases
}

fn from_table(judge: &mut Judge, (place, span): (&str, &Range<usize>), columns: &Loads) -> Controls {
    let mut controls = Controls::default();
    for Column { name, way, freedom } in controls::columns() {
        let Some(values) = columns.get(&name) else { continue };
        let plane = match way.kind {
            Kind::MeanGap => counted_from(judge, place, span.clone(), values.iter().copied()),
            Kind::Force | Kind::Motion | Kind::FarEnd | Kind::Rate => Some(0.0),
        };
        let path = Path::Through(values.clone());
        controls[freedom] = plane.map(|plane| StageControl::new(way.kind, path, plane));
    }
    controls
}

fn both(judge: &mut Judge, place: &str, one: &str, row: &ControlRow, other: &str, span: Range<usize>) {
    let force = row.ways[0].name;
    let help = if row.form == Form::Number {
        "prescribe one of the two; the other follows".to_owned()
    } else {
        format!(
            "prescribe one of the two along each axis: {force} = [1.0, \"held\"], {other} = [\"held\", 0.0]"
        )
    };
    judge.both_or::<()>(span, &format!("{place}: {one} and {other}"), &help);
}
