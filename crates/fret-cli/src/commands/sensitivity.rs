//! `fret sensitivity`: what the results of a case depend on, and how much: derivatives by the numbers of the case, and what a scatter of these
//! makes of the results.

use std::fmt::Write;

use fret_core::case::Case;
use fret_core::history::{CYCLE_COLUMNS, STEP_COLUMNS};
use fret_core::model::Dimension;
use fret_core::plan::Plan;
use fret_core::sensitivity::{
    Direction, Gradient, NearEvents, Request, Sensitivities, SensitivityError, gradient,
};
use fret_core::uncertainty::{FirstOrder, first_order};
use fret_core::units::Units;
use serde_json::{Map, Value, json};

use crate::arguments::SensitivityArguments;
use crate::failure::Failure;
use crate::figures::figure;
use crate::interrupt;
use crate::manner::Listener;
use crate::scatter::Scatter;
use crate::stress::kind_of_stress;
use crate::sweep::kinds::kind_of;
use crate::table::Columns;
use crate::terminal::Answer;
use fret_results::{CaseFile, folder_for_answers};

/// The answer, which marks its folder.
const RECORD: &str = "sensitivity.json";
/// Letters of a bar for a logarithmic derivative of one.
const UNIT_BAR: f64 = 10.0;
/// Letters of a bar at the most.
const LONGEST_BAR: usize = 30;

/// Derivatives of the results of a case.
pub fn sensitivity(arguments: &SensitivityArguments) -> Result<Answer, Failure> {
    let plan = CaseFile::asked(&arguments.case)?.planned()?;
    interrupt::listen();
    let pool = arguments.threads.pool()?;
    let of = if arguments.of.is_empty() { usual_results(&plan) } else { arguments.of.clone() };
    let scattered = arguments.scatter.iter().map(|scatter| scatter.path.clone());
    let by = if arguments.by.is_empty() { scattered.collect() } else { arguments.by.clone() };
    let request = Request { of, by, direction: None };
    let folder = arguments.manner.out.as_deref();
    let folder = folder.map(|folder| folder_for_answers(folder, &[RECORD], "a sensitivity")).transpose()?;
    let found = pool
        .install(|| gradient(&plan, &request, &mut Listener::telling(&arguments.manner)))
        .map_err(refused)?;
    let spreads = spreads(&found, &arguments.scatter)?;
    let units = InUnits::of(&plan.case);
    let mut record = record(&found, &units);
    if !spreads.is_empty() {
        record["first_order"] = spreads.iter().map(Spread::entry).collect();
    }
    let mut written = None;
    if let Some(folder) = folder {
        arguments.manner.write_json(&folder.join(RECORD), &record)?;
        arguments.manner.write(&folder.join("sensitivity.csv"), csv(&found, &units).as_bytes())?;
        written = Some(format!("written to {}", folder.display()));
    }
    let parts = std::iter::once(table(&found, &units)).chain(spreads.iter().map(Spread::part)).chain(written);
    Ok(Answer::new(record, parts.collect::<Vec<_>>().join("\n\n")))
}

/// How much a result scatters, to first order.
struct Spread<'a> {
    gradient: &'a Gradient,
    scatter: &'a [Scatter],
    found: FirstOrder,
}

/// Of every result; none without a scatter of numbers.
fn spreads<'a>(found: &'a Sensitivities, scatter: &'a [Scatter]) -> Result<Vec<Spread<'a>>, Failure> {
    let refused = |what: String| Failure::call(what, "one --scatter for each number, also of --by");
    let mut places = Vec::new();
    let mut deviations = Vec::new();
    for Scatter { path, deviation, relative } in scatter {
        let place = found.parameters.iter().position(|entry| entry.path() == path);
        let place =
            place.ok_or_else(|| refused(format!("--scatter {path}: not among the numbers of --by")))?;
        if places.contains(&place) {
            return Err(refused(format!("--scatter {path}: given twice")));
        }
        places.push(place);
        let of = if *relative { found.parameters[place].value().abs() } else { 1.0 };
        if of == 0.0 {
            return Err(refused(format!("--scatter {path}: the number is 0, and so is any part of it")));
        }
        deviations.push(deviation * of);
    }
    if scatter.is_empty() {
        return Ok(Vec::new());
    }
    let of = |gradient: &'a Gradient| {
        let derivatives: Vec<f64> = places.iter().map(|&place| gradient.by[place]).collect();
        Spread { gradient, scatter, found: first_order(&derivatives, &deviations) }
    };
    Ok(found.gradients.iter().map(of).collect())
}

impl Spread<'_> {
    /// The scatter of a result, for programs.
    fn entry(&self) -> (String, Value) {
        let fractions = self.scatter.iter().zip(&self.found.fractions);
        let fractions: Map<String, Value> =
            fractions.map(|(entry, of)| (entry.path.clone(), json!(of))).collect();
        (self.gradient.of.clone(), json!({ "deviation": self.found.deviation, "fractions": fractions }))
    }

    /// The same for a person: the deviation, and the fractions of its square.
    fn part(&self) -> String {
        let Gradient { of, value, .. } = self.gradient;
        let deviation = self.found.deviation;
        let relative = logarithmic(deviation, *value, 100.0).map(f64::abs);
        let relative = relative.map_or_else(String::new, |per_cent| format!(" ({} %)", figure(per_cent)));
        let mut text = format!("{of}: standard deviation {}{relative}, to first order", figure(deviation));
        let width = self.scatter.iter().map(|entry| entry.path.len()).max().unwrap_or(0);
        for (entry, fraction) in self.scatter.iter().zip(&self.found.fractions) {
            let _ = write!(text, "\n  {:<width$}  {:>6.1} % of the variance", entry.path, 100.0 * fraction);
        }
        text
    }
}

/// The results that are asked for where nothing is said.
fn usual_results(plan: &Plan) -> Vec<String> {
    let of_pressure = ["max_pressure", "approach"];
    let of_friction = ["max_shear", "dissipated_energy"];
    let rubs = !plan.case.is_frictionless();
    let of_friction = of_friction.into_iter().filter(|_| rubs);
    of_pressure.into_iter().chain(of_friction).map(str::to_owned).collect()
}

/// A call that is refused, or a run that failed.
fn refused(error: SensitivityError) -> Failure {
    match error {
        SensitivityError::Run(error) => Failure::Unsolved(error),
        SensitivityError::Parameter { .. } => Failure::call(
            error.to_string(),
            "fret sensitivity CASE without --by lists all numbers of the case by which there are derivatives",
        ),
        SensitivityError::Objective { .. } => Failure::call(
            error.to_string(),
            "columns of history.csv and of cycles.csv are results, and of stresses those that fret stress tells with the constants of the case",
        ),
        other => Failure::call(other.to_string(), "fret sensitivity --help tells what is covered"),
    }
}

/// Derivative of the logarithm of a result by that of a parameter; none where one of them is zero.
fn logarithmic(by: f64, value: f64, parameter: f64) -> Option<f64> {
    let found = by * parameter / value;
    (value != 0.0 && parameter != 0.0 && found.is_finite()).then_some(found)
}

/// By how much a derivative is another one on the other side of cells that are about to change their state, in per cent of it.
fn share_of_events(by: f64, other: f64) -> String {
    let share = 100.0 * (other - by) / by;
    if share.is_finite() { format!("{share:+.2} %") } else { "-".to_owned() }
}

/// In which units results and numbers are, where the case declares units and they have one.
struct InUnits<'a> {
    units: Option<&'a Units>,
    dimension: Dimension,
}

impl<'a> InUnits<'a> {
    fn of(case: &'a Case) -> Self {
        Self { units: case.units.as_ref(), dimension: case.dimension() }
    }

    /// That of a result, such as `increments[7].shift_x`, `cycles[0].stiffness` or `fatigue.crossland`.
    fn of_result(&self, result: &str) -> Option<String> {
        let (place, name) = result.rsplit_once('.').unwrap_or(("", result));
        let kind = if place.ends_with("stress") || place.ends_with("fatigue") {
            kind_of_stress(name)
        } else if place.starts_with("cycles") {
            CYCLE_COLUMNS.iter().find(|column| column.name == name)?.unit
        } else {
            STEP_COLUMNS.iter().find(|column| column.name == name)?.unit
        };
        self.named(kind)
    }

    /// That of a number of the case by its path.
    fn of_number(&self, path: &str) -> Option<String> {
        self.named(kind_of(&path.replace('[', ".").replace(']', ""))?)
    }

    fn named(&self, kind: &str) -> Option<String> {
        Units::unit(self.units, kind, self.dimension)
    }
}

/// The answer for programs: of every result its value, and its derivatives by path.
fn record(found: &Sensitivities, units: &InUnits<'_>) -> Value {
    let by_path = |of: &dyn Fn(usize) -> Value| -> Map<String, Value> {
        let entries = found.parameters.iter().enumerate();
        entries.map(|(place, entry)| (entry.path().to_owned(), of(place))).collect()
    };
    let of = |gradient: &Gradient| {
        let others = gradient.on_the_other_side.as_ref();
        let by_logarithms = |place: usize| {
            json!(logarithmic(gradient.by[place], gradient.value, found.parameters[place].value()))
        };
        json!({
            "value": gradient.value,
            "unit": units.of_result(&gradient.of),
            "derivatives": by_path(&|place| json!(gradient.by[place])),
            "logarithmic_derivatives": by_path(&by_logarithms),
            "derivatives_on_the_other_side": others.map(|by| by_path(&|place| json!(by[place]))),
        })
    };
    let gradients: Map<String, Value> =
        found.gradients.iter().map(|gradient| (gradient.of.clone(), of(gradient))).collect();
    let near = found.near_events.map(
        |near| json!({ "increment": near.increment, "cells": near.cells, "contact_cells": near.contact }),
    );
    let direction = if found.direction == Direction::Backward { "backward" } else { "forward" };
    json!({
        "status": "computed",
        "parameters": by_path(&|place| json!(found.parameters[place].value())),
        "units_of_parameters": by_path(&|place| json!(units.of_number(found.parameters[place].path()))),
        "of": gradients,
        "near_a_change_of_state": near,
        "direction": direction,
    })
}

/// The answer as a file: a row for each result and number.
fn csv(found: &Sensitivities, units: &InUnits<'_>) -> String {
    let numbers = |gradient| (0..found.parameters.len()).map(move |place| (gradient, place));
    let rows = found.gradients.iter().flat_map(numbers);
    Columns::<(&Gradient, usize)>::new()
        .column("result", "", |(gradient, _)| gradient.of.clone())
        .column("value", "", |(gradient, _)| gradient.value)
        .column("by", "", |(_, place)| found.parameters[*place].path().to_owned())
        .column("number", "", |(_, place)| found.parameters[*place].value())
        .column("derivative", "", |(gradient, place)| gradient.by[*place])
        .column("logarithmic_derivative", "", |(gradient, place)| {
            logarithmic(gradient.by[*place], gradient.value, found.parameters[*place].value())
        })
        .column("derivative_on_the_other_side", "", |(gradient, place)| {
            gradient.on_the_other_side.as_ref().map(|by| by[*place])
        })
        .column("unit", "", |(gradient, _)| units.of_result(&gradient.of))
        .column("unit_of_number", "", |(_, place)| units.of_number(found.parameters[*place].path()))
        .csv(None, rows)
}

/// The answer for a person: one table a result, its parameters by the size of their effect.
fn table(found: &Sensitivities, units: &InUnits<'_>) -> String {
    let called = |path: &str| match units.of_number(path) {
        Some(unit) => format!("{path} [{unit}]"),
        None => path.to_owned(),
    };
    let names = found.parameters.iter().map(|entry| called(entry.path()).chars().count());
    let width = names.max().unwrap_or(0).max(9);
    let mut text = String::new();
    for gradient in &found.gradients {
        let unit = units.of_result(&gradient.of).map_or_else(String::new, |unit| format!(" {unit}"));
        let _ = writeln!(text, "{} = {}{unit}", gradient.of, figure(gradient.value));
        let others = gradient.on_the_other_side.as_ref();
        let head = if others.is_some() { "  other side" } else { "" };
        let _ = writeln!(text, "  {:<width$}  {:>12}  {:>12}{head}", "by", "d ln / d ln", "derivative");
        let row = |(place, (entry, by)): (usize, (_, &f64))| {
            let share = others.map(|others| share_of_events(*by, others[place]));
            (entry, *by, logarithmic(*by, gradient.value, found.parameters[place].value()), share)
        };
        let mut rows: Vec<_> = found.parameters.iter().zip(&gradient.by).enumerate().map(row).collect();
        rows.sort_by(|one, other| {
            let size = |found: Option<f64>| found.map_or(0.0, f64::abs);
            size(other.2).total_cmp(&size(one.2))
        });
        for (entry, by, found, share) in rows {
            let share = share.map_or_else(String::new, |share| format!("  {share:>10}"));
            let shown = found.map_or_else(|| "-".to_owned(), |found| format!("{found:+.5}"));
            let bar = found.map_or(0, |found| ((found.abs() * UNIT_BAR).round() as usize).min(LONGEST_BAR));
            let sign = if found.is_some_and(|found| found < 0.0) { "-" } else { "+" };
            let line = format!(
                "  {:<width$}  {shown:>12}  {:>12}{share}  {}",
                called(entry.path()),
                figure(by),
                sign.repeat(bar)
            );
            let _ = writeln!(text, "{}", line.trim_end());
        }
        text.push('\n');
    }
    text.push_str("d ln / d ln: by how many per cent the result changes when the number changes by one; on the grid of the case\n");
    text.push_str(match found.direction {
        Direction::Forward => "differentiated forward: one linear problem for each increment and number",
        Direction::Backward => "differentiated backwards: one linear problem for each increment and result",
    });
    if let Some(NearEvents { increment, cells, contact }) = found.near_events {
        let _ = write!(
            text,
            "\nincrement {increment}: {cells} of {contact} cells are within a millionth of another state (open, stick, slip): derivatives on \
             either side of the case differ there (other side: by how much with all such cells in the other state)"
        );
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn logarithmic_derivatives_are_those_of_powers() {
        // y = 5 x^-2 at x = 3
        let (x, y) = (3.0_f64, 5.0 / 9.0);
        let found = logarithmic(-2.0 * 5.0 / x.powi(3), y, x).unwrap();
        assert!((found + 2.0).abs() < 1e-15);
        assert_eq!(logarithmic(1.0, 0.0, 3.0), None);
        assert_eq!(logarithmic(1.0, 2.0, 0.0), None);
    }
}
