//! Dissipated energy, over the increments and by cycle.

use fret_core::history::CycleRecord;
use fret_core::study::{PartialSlip, TangentialForm};
use maud::{Markup, html};

use crate::report::{Measured, Overview, chapter, deviation, grid, joined, side_by_side};
use crate::table::{Cell, Columns};
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
    let shown = cycles.iter().take(1).chain(cycles.iter().skip(1 + skipped));
    let mut columns = Columns::<CycleRecord>::new()
        .column("cycle", "", |cycle| {
            let which = match cycle.stands_for {
                1 => cycle.last_cycle.to_string(),
                all => format!("{} to {}", (cycle.last_cycle + 1).saturating_sub(all), cycle.last_cycle),
            };
            format!("{}, {which}", view.stage_name(cycle.stage))
        })
        .column("dissipated in one", "force x length", |cycle| cycle.dissipated_energy);
    if let Some(form) = form_of(view) {
        let exact = |cycle: &CycleRecord| {
            // Before its first increment the closed form has dissipated nothing.
            let before = cycle.first_increment.checked_sub(1).filter(|before| form.after(*before).is_some());
            let exact = at(form, cycle.last_increment) - before.map_or(0.0, |before| at(form, before));
            exact.is_finite().then_some(exact)
        };
        columns = columns
            .column("closed form", "force x length", move |cycle| {
                exact(cycle).map_or("-".into(), Cell::Number)
            })
            .column("difference", "", move |cycle| {
                exact(cycle).map_or("-".to_owned(), |exact| deviation(cycle.dissipated_energy, exact))
            });
    }
    Some(html! {
        (grid(&columns, shown, |value, kind| view.number(value, kind)))
        @if skipped > 0 { p class="small" { "The first cycle and the last " (MOST_CYCLES - 1) " of " (cycles.len()) "." } }
    })
}
