//! Numbers against closed forms.

use fret_core::model::{Control, Dimension};
use fret_core::plan::Coupling;
use fret_core::study::PartialSlip;
use maud::{Markup, html};

use crate::report::{Measured, Overview, chapter, deviation, table};

/// Numbers against the closed form at the end of each stage.
pub fn comparison(view: &Overview<'_>) -> Markup {
    let Some(form) = &view.normal_form else { return html! {} };
    let history = &view.results.table;
    let dimension = view.dimension();
    let mut rows = Vec::new();
    let mut add = |place: String, what: &str, kind: &str, computed: f64, exact: f64| {
        let numbers = [view.number(computed, kind), view.number(exact, kind), deviation(computed, exact)];
        rows.push([place, what.to_owned()].into_iter().chain(numbers).collect());
    };
    for (stage, [_, end]) in view.spans.iter().enumerate() {
        let row = end - 1;
        if let Some(pressed) = form.under(Control::Force(history.at("normal_force", row))) {
            let name = || view.stage_name(stage);
            if let Some(peak) = pressed.peak() {
                add(name(), "max pressure", "pressure", history.at("max_pressure", row), peak);
            }
            let area = format!("contact {}", dimension.area());
            add(name(), &area, "length^2", history.at("contact_area", row), pressed.area());
            if let Some(approach) = pressed.approach() {
                add(name(), "approach", "length", history.at("approach", row), approach);
            }
        }
    }
    if let Some(form) = &view.tangential_form {
        let farthest = (0..history.rows())
            .filter(|row| form.after(*row).is_some())
            .max_by(|a, b| view.tangential[*a].abs().total_cmp(&view.tangential[*b].abs()));
        if let Some((row, after)) = farthest.and_then(|row| form.after(row).map(|after| (row, after))) {
            if let Some(shift) = after.shift() {
                add(view.called(row), "displacement", "length", view.shift[row], shift);
            }
            let areas = [history.at("stick_area", row), after.stick_area()];
            match dimension {
                Dimension::Plane => {
                    let [stuck, exact] = areas.map(|area| dimension.radius(area));
                    add(view.called(row), "radius of stick", "length", stuck, exact);
                }
                Dimension::Line => add(view.called(row), "width of stick", "length^2", areas[0], areas[1]),
            }
        }
    }
    if rows.is_empty() {
        return html! {};
    }
    let head = ["at the end of", "", "computed", "closed form", "difference"];
    chapter(
        "Against the closed form",
        &html! { p { (words(view, form.moduli.coupling)) } (table(&head, &rows)) },
    )
}

/// How far the closed form can be trusted here.
fn words(view: &Overview<'_>, coupling: f64) -> Markup {
    if view.results.plan().coupling == Coupling::Coupled {
        return html! {
            "The closed forms are frictionless ones: they neglect normal-tangential coupling (Dundurs' |" i { "β" } "| = "
            (format!("{:.3}", coupling.abs())) "), which changes pressure and approach by some percent. There is none of partial slip here."
        };
    }
    let history = &view.results.table;
    let [dx, _] = view.results.fields.spacing();
    let last = history.rows().saturating_sub(1);
    let width = 2.0 * view.dimension().radius(history.at("contact_area", last));
    let cells = width / dx;
    html! {
        (format!("The contact is {cells:.0} cells wide at the end; its edge is known to about half a cell."))
        @if view.tangential_form.as_ref().is_some_and(|form| form.any(PartialSlip::neglects_slip_across)) { " The closed form of partial slip neglects the slip across the force." }
    }
}
