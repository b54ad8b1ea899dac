//! The fit repeated over the cycles of a test: as a record, a table, words and curves.

use fret_core::identify::{Constant, Identification, RepeatedFit};
use fret_core::units::Units;
use maud::{Markup, html};
use serde_json::{Value, json};

use super::constant::of_constant;
use super::over_cycles::over_cycles;
use crate::figures::{counted, figure};
use fret_drawing::{Curve, Label, Stroke};

/// For programs.
pub fn record(found: &Identification) -> Vec<Value> {
    let of = |fit: &RepeatedFit| {
        json!({
            "cycle": fit.cycle,
            "parameters": fit.constants.iter().map(of_constant).collect::<Vec<_>>(),
            "noise": fit.noise,
            "why": fit.why,
        })
    };
    found.repeated.iter().map(of).collect()
}

/// The constant of a fit with a number among those of the answer, where its loop tells it.
fn told(fit: &RepeatedFit, number: usize) -> Option<&Constant> {
    fit.constants.get(number).filter(|constant| constant.told)
}

/// A row a fit as CSV: each constant with its interval, empty where the loop does not tell it; heads with units, where there are any.
pub fn table(found: &Identification) -> String {
    let units = found.has_units.then_some(&found.units);
    let mut head = vec!["cycle".to_owned(), "noise".to_owned()];
    for constant in &found.constants {
        let name = constant.name.replace(' ', "_");
        head.extend(
            ["", "_low", "_high"]
                .map(|end| Units::heading(units, &format!("{name}{end}"), constant.unit, found.dimension)),
        );
    }
    let mut text = head.join(",") + "\n";
    let cell = |value: f64| Value::from(value).to_string();
    for fit in &found.repeated {
        let noise = if fit.why.is_none() { cell(fit.noise) } else { String::new() };
        let mut cells = vec![fit.cycle.to_string(), noise];
        for number in 0..found.constants.len() {
            cells.extend(told(fit, number).map_or_else(
                || [const { String::new() }; 3],
                |constant| [constant.value, constant.interval[0], constant.interval[1]].map(cell),
            ));
        }
        text += &(cells.join(",") + "\n");
    }
    text
}

/// Lines for a person: how many fits there are, how each constant goes over the cycles, and which cycles were not fitted.
pub fn in_words(found: &Identification) -> Vec<String> {
    let mut lines = Vec::new();
    for (number, constant) in found.constants.iter().enumerate() {
        let fits = || found.repeated.iter().filter_map(|fit| Some((fit.cycle, told(fit, number)?.value)));
        if let (Some((from, first)), Some((to, last))) = (fits().next(), fits().next_back()) {
            lines.push(format!(
                "  {:<22} {} in cycle {from} to {} in cycle {to} ({})",
                constant.name,
                figure(first),
                figure(last),
                counted(fits().count(), "fit")
            ));
        }
    }
    let failed = found.repeated.iter().filter_map(|fit| Some((fit.cycle, fit.why.as_ref()?)));
    lines.extend(failed.map(|(cycle, why)| format!("  not fitted: cycle {cycle}: {why}")));
    lines
}

/// Curves of the constants over the cycles with their intervals, as a part of the page.
pub fn figures(found: &Identification) -> Markup {
    if found.repeated.is_empty() {
        return html! {};
    }
    let chart = |(number, constant): (usize, &Constant)| {
        let curve = |of: fn(&Constant) -> f64, name: &str, colour: usize| {
            let told = |fit: &RepeatedFit| told(fit, number).map_or(f64::NAN, of);
            let points = found.repeated.iter().map(|fit| [fit.cycle, told(fit)]).collect();
            Curve::line(points, name, colour)
        };
        let unit = (!constant.unit.is_empty()).then(|| found.units.of(constant.unit));
        let curves = vec![
            curve(|constant| constant.interval[0], "95 % interval", 2).drawn(Stroke::Dashed),
            Curve { name: None, ..curve(|constant| constant.interval[1], "", 2) }.drawn(Stroke::Dashed),
            curve(|constant| constant.value, "fitted", 0),
        ];
        over_cycles(Label::with(&constant.name, unit), curves)
    };
    html! {
        h2 { "The fit repeated over the cycles" }
        @for chart in found.constants.iter().enumerate().filter_map(chart) {
            (chart.figure(&format!("{}: fits, and their 95 % intervals.", chart.what)))
        }
    }
}
