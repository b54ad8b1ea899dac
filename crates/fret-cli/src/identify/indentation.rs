//! A measured indentation, and what is told of it.

use fret_core::identify::{self, Constant, Indentation, IndentationRequest, Numbers};
use maud::{Markup, html};
use serde_json::{Value, json};

use super::constant::{cell, cells, line, of_constant};
use super::identified::Identified;
use super::keys::{case_with, place_of, value_of};
use super::record::rows_in_words;
use crate::failure::Failure;
use crate::figures::{counted, figure};
use crate::report::{number, table, whole_page};
use crate::table::Columns;
use fret_drawing::{Chart, Curve, Label, Stroke};
use fret_results::CaseFile;

/// What is asked of an indentation, and the keys of the case that are fitted, such as `lower.coatings[0].young`.
#[derive(Debug, Clone, Default)]
pub struct IndentationAsked {
    /// Of the log.
    pub request: IndentationRequest,
    /// The keys.
    pub keys: Vec<String>,
}

/// Fits numbers of a case to a measured indentation.
///
/// # Errors
/// When the log cannot be read as load over depth, or the case cannot be solved.
pub fn indentation(
    log: (&str, &[u8]),
    case_file: &CaseFile,
    asked: &IndentationAsked,
) -> Result<Identified, Failure> {
    let case = case_file.case(None)?;
    let keys = &asked.keys;
    let mut places = Vec::new();
    for key in keys {
        let place = place_of(case_file, key)?;
        if places.contains(&place) {
            return Err(Failure::call(format!("--fit {key}: named twice"), "name each key once"));
        }
        places.push(place);
    }
    let named = |key: &String| Ok((key.clone(), value_of(case_file, key)?));
    let numbers = keys.iter().map(named).collect::<Result<_, Failure>>()?;
    let case_of = |values: &[f64]| {
        let numbers = keys.iter().map(String::as_str).zip(values.iter().copied());
        case_with(case_file, &numbers.collect::<Vec<_>>())
    };
    let numbers = Numbers { keys: numbers, case_with: &case_of };
    let found = &identify::indentation(log, &case, &numbers, &asked.request)?;
    Ok(Identified {
        record: record(found),
        text: text(found),
        page: page(found),
        tables: vec![("indentation.csv", points(found))],
    })
}

/// All of it, as `identified.json` has it.
fn record(found: &Indentation) -> Value {
    let along = |k: usize| found.points.iter().map(|point| point[k]).collect::<Vec<f64>>();
    let computed = |k: usize| found.computed.iter().map(|point| point[k]).collect::<Vec<f64>>();
    let parameter = |(k, constant): (usize, &Constant)| {
        let mut entry = of_constant(constant);
        entry["change_on_half_the_cells"] = json!(found.grid.as_ref().map(|grid| grid[k]));
        entry
    };
    let parameters: Vec<Value> = found.constants.iter().enumerate().map(parameter).collect();
    json!({
        "log": found.log,
        "units": {"length": found.units.length, "force": found.units.force},
        "part": found.part.name(),
        "parameters": parameters,
        "touch": found.touch,
        "frame_compliance": found.frame,
        "noise": found.noise,
        "correlation": found.correlation,
        "solved_indentations": found.histories,
        "skipped": {"rows": found.bad_rows.len(), "rows_in_words": rows_in_words(&found.bad_rows)},
        "measured": {"line": found.lines, "depth": along(0), "force": along(1), "computed_force": along(2)},
        "computed": {"depth": computed(0), "force": computed(1), "contact_depth": computed(2)},
        "notes": found.notes,
    })
}

/// What a person reads.
fn text(found: &Indentation) -> String {
    let mut lines = vec![format!(
        "{}: {} of {}, {} fitted with {}",
        found.log,
        counted(found.points.len(), "point"),
        match found.part {
            identify::Part::Whole => "the whole test".to_owned(),
            part => part.name().to_owned(),
        },
        counted(found.constants.len(), "constant"),
        counted(found.histories, "computed indentation"),
    )];
    lines.extend(rows_in_words(&found.bad_rows).map(|words| format!("  skipped: {words}")));
    let width = found.constants.iter().map(|constant| constant.name.len()).max().unwrap_or(0).max(22);
    for (k, constant) in found.constants.iter().enumerate() {
        let value = format!("{} {}", figure(constant.value), found.units.of(constant.unit));
        let grid = found.grid.as_ref().map_or_else(String::new, |grid| {
            format!("   on half of the cells: {}", figure(constant.value + grid[k]))
        });
        lines.push(line(constant, value.trim_end(), (width, "curve", &grid)));
    }
    lines.push(format!("  {:<width$} {:.2} % of the largest", "load off the curve", 100.0 * found.noise));
    lines.extend(found.notes.iter().map(|note| format!("  note: {note}")));
    lines.join("\n")
}

/// The points that were fitted, as CSV: line in the log, depth from the touch on, load, computed load, their difference.
fn points(found: &Indentation) -> String {
    let columns = Columns::<(&usize, &[f64; 3])>::new()
        .column("line", "", |(line, _)| **line)
        .column("depth", "length", |(_, point)| point[0])
        .column("force", "force", |(_, point)| point[1])
        .column("computed_force", "force", |(_, point)| point[2])
        .column("residual", "force", |(_, point)| point[1] - point[2]);
    let rows = found.lines.iter().zip(&found.points);
    columns.csv(found.has_units.then_some(&found.units), rows)
}

/// The page with its pictures.
fn page(found: &Indentation) -> String {
    let title = format!("Indentation of {}", found.log);
    let content = html! {
        h1 { (title) }
        (constants(found))
        (beside(found).figure("Measured points, their depth from the first touch on, and the curve that the solver computes; dashed: without the compliance of the frame, where there is one."))
        (residuals(found).figure("Measured less computed load over the depth. Points without a course are noise; what loading and unloading have apart, or a course along the depth, the model does not have."))
        p {
            "Standard deviation of the loads about the curve: " (number(100.0 * found.noise)) " % of the largest load; correlation of neighbouring residuals: "
            (number(found.correlation)) "; " (counted(found.histories, "computed indentation")) "."
        }
        ul { @for note in &found.notes { li { (note) } } }
    };
    whole_page(&title, &content)
}

fn constants(found: &Indentation) -> Markup {
    let row = |(k, constant): (usize, &Constant)| {
        let coarse = found.grid.as_ref().map(|grid| cell(constant, constant.value + grid[k]));
        let more = [coarse.unwrap_or_else(|| "–".to_owned()), found.units.of(constant.unit)];
        cells(constant).into_iter().chain(more).collect()
    };
    let rows: Vec<Vec<String>> = found.constants.iter().enumerate().map(row).collect();
    table(&["constant", "value", "95 % from", "to", "on half of the cells", "unit"], &rows)
}

fn axes(found: &Indentation, up: &str) -> [Label; 2] {
    let units = &found.units;
    [("depth", &units.length), (up, &units.force)].map(|(name, unit)| Label::with(name, Some(unit.clone())))
}

fn dots(points: Vec<[f64; 2]>) -> Curve {
    Curve::line(points, "measured", 1).drawn(Stroke::Dots)
}

fn beside(found: &Indentation) -> Chart {
    let measured = found.points.iter().map(|[depth, load, _]| [*depth, *load]).collect();
    let computed = found.computed.iter().map(|[depth, load, _]| [*depth, *load]).collect();
    let mut curves = vec![dots(measured), Curve::line(computed, "computed", 0)];
    if found.frame != 0.0 {
        let own = found.computed.iter().map(|[_, load, own]| [*own, *load]).collect();
        curves.push(Curve::dashed(own, "computed, the contact's own", 2));
    }
    Chart::new("measured and computed indentation", axes(found, "load"), curves)
}

fn residuals(found: &Indentation) -> Chart {
    let apart = found.points.iter().map(|[depth, load, computed]| [*depth, load - computed]).collect();
    let mut chart = Chart::new(
        "residuals of the indentation",
        axes(found, "measured less computed load"),
        vec![dots(apart)],
    );
    chart.level = Some((0.0, "computed".to_owned()));
    chart
}
