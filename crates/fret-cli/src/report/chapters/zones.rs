//! Maps of stick and slip through the history.

use fret_core::model::Dimension;
use maud::{Markup, html};

use crate::failure::Failure;
use crate::report::{Measured, Overview, Window, chapter};

/// Maps, at most.
const MOST_MAPS: usize = 18;
/// Width over height at which a line contact, one row of cells, is shown.
const BAR: f64 = 16.0;

/// Stick and slip through the history.
pub fn zones(view: &Overview<'_>) -> Result<Markup, Failure> {
    let fields = &view.results.fields;
    let chosen = view.telling(MOST_MAPS);
    if !fields.has("zone") || chosen.is_empty() || view.is_frictionless() {
        return Ok(html! {});
    }
    let mut window = Window::new(fields.cells());
    let mut maps = Vec::new();
    for &position in &chosen {
        let field = fields.field("zone", position)?;
        window.widen(&field);
        maps.push(field);
    }
    let part = window.part();
    let [dx, dy] = fields.spacing();
    let ratio = match view.dimension() {
        Dimension::Plane => part.cells[0] as f64 * dx / (part.cells[1] as f64 * dy),
        Dimension::Line => BAR,
    };
    let mut drawn = Vec::new();
    for (&position, field) in chosen.iter().zip(&maps) {
        drawn.push((view.called(fields.steps[position]), part.zones(|cell| field[cell])?));
    }
    let body = html! {
        p { "What each cell did in the increment: stage, number in it." }
        (legend())
        div class="maps" {
            @for (called, address) in drawn {
                figure {
                    img class="open" style=(format!("aspect-ratio:{ratio:.4}")) alt=(format!("zones after {called}")) src=(address);
                    figcaption { (called) }
                }
            }
        }
    };
    Ok(chapter("Stick and slip", &body))
}

/// The names of the colours.
pub fn legend() -> Markup {
    html! {
        ul class="legend" {
            @for (class, name) in [("stick", "stick"), ("slip", "slip"), ("open", "no contact")] {
                li { span class=(format!("swatch {class}")) {} (name) }
            }
        }
    }
}
