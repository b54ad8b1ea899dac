//! Dissipated energy, over the increments and by cycle.

use fret_core::study::{PartialSlip, TangentialForm};
use maud::{Markup, html};

use crate::report::{Measured, Overview, chapter, deviation, joined, side_by_side, table};
use fret_drawing::{Chart, Curve};

/// Cycles listed one by one.
const MOST_CYCLES: usize = 12;

/// The energy dissipated by friction.
pub fn energy(view: &Overview<'_>) -> Markup {
    let history = &view.results.table;
    let energy = history.column("dissipated_energy");
    if (view.direction.is_none() && !view.twists) || energy.last().is_none_or(|energy| *energy == 0.0) {
        return html! {};
    }
    let points = |values: &[f64]| joined(history.column("increment"), values);
    let mut curves = vec![Curve::line(points(energy), "computed", 0)];
    let mut caption = "Dissipated energy since the start.".to_owned();
    if view.results.cycles.iter().any(|cycle| cycle.stands_for > 1) {
        caption += " The end of a computed cycle has the energy of all cycles that it stands for.";
    }
    if let Some(form) = form_of(view) {
        let exact: Vec<f64> = (0..history.rows()).map(|row| at(form, row)).collect();
        curves.push(Curve::dashed(points(&exact), "closed form", 1));
        caption += " Dashed: the closed form.";
    }
    let chart = Chart::over_increments("dissipated energy", view.label_of("dissipated_energy"), curves);
    let mut parts = vec![chart.figure(&caption)];
    parts.extend(account(view).map(|account| html! { div { (account) } }));
    chapter("Dissipated energy", &side_by_side(&parts))
}

/// The closed form, where it knows the energy.
fn form_of<'a>(view: &'a Overview<'_>) -> Option<&'a TangentialForm> {
    view.tangential_form.as_ref().filter(|form| form.any(|slip| slip.dissipated_energy().is_some()))
}

/// Energy after an increment in closed form; not a number, which is not drawn, where there is none.
fn at(form: &TangentialForm, row: usize) -> f64 {
    form.after(row).and_then(PartialSlip::dissipated_energy).unwrap_or(f64::NAN)
}

/// The energy of each cycle, with the closed form where there is one.
fn account(view: &Overview<'_>) -> Option<Markup> {
    let cycles = &view.results.cycles;
    if cycles.is_empty() {
        return None;
    }
    let skipped = cycles.len().saturating_sub(MOST_CYCLES);
    let mut head = vec!["cycle", "dissipated in one"];
    if form_of(view).is_some() {
        head.extend(["closed form", "difference"]);
    }
    let shown = cycles.iter().take(1).chain(cycles.iter().skip(1 + skipped));
    let rows: Vec<Vec<String>> = shown
        .map(|cycle| {
            let (before, last) = (cycle.first_increment.checked_sub(1), cycle.last_increment);
            let computed = cycle.dissipated_energy;
            let which = match cycle.stands_for {
                1 => cycle.last_cycle.to_string(),
                all => format!("{} to {}", (cycle.last_cycle + 1).saturating_sub(all), cycle.last_cycle),
            };
            let mut row = vec![
                format!("{}, {which}", view.stage_name(cycle.stage)),
                view.number(computed, "force x length"),
            ];
            if let Some(form) = form_of(view) {
                // Before its first increment the closed form has dissipated nothing.
                let started =
                    before.map_or(0.0, |before| form.after(before).map_or(0.0, |_| at(form, before)));
                let exact = at(form, last) - started;
                row.extend(if exact.is_finite() {
                    [view.number(exact, "force x length"), deviation(computed, exact)]
                } else {
                    ["–".to_owned(), "–".to_owned()]
                });
            }
            row
        })
        .collect();
    Some(html! {
        (table(&head, &rows))
        @if skipped > 0 { p class="small" { "The first cycle and the last " (MOST_CYCLES - 1) " of " (cycles.len()) "." } }
    })
}
