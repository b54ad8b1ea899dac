//! Maps of stick and slip through the history.

use fret_core::model::Dimension;
use maud::{Markup, html};

use crate::drawing::raster::{Raster, pixels_for};
use crate::failure::Failure;
use crate::report::html::chapter;
use crate::report::overview::Overview;
use crate::report::window::Window;
use fret_results::Field;

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
    let (_, cells) = window.cells();
    let [dx, dy] = fields.spacing();
    let ratio = match view.dimension() {
        Dimension::Plane => cells[0] as f64 * dx / (cells[1] as f64 * dy),
        Dimension::Line => BAR,
    };
    let mut drawn = Vec::new();
    for (&position, field) in chosen.iter().zip(&maps) {
        drawn.push((view.called(fields.steps[position]), image(field, &window)?));
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

/// The zones within a window, x to the right and y upwards.
pub fn image(field: &Field, window: &Window) -> Result<String, Failure> {
    let (first, cells) = window.cells();
    let size = cells.map(pixels_for);
    let zone = |column: usize, row: usize| {
        let [i, j] = cell(first, cells, size, [column, row]);
        field.at(i, j)
    };
    Raster::of_zones(size, zone).address()
}

/// The cell of a window that a pixel shows, rows from the top.
pub fn cell(first: [usize; 2], cells: [usize; 2], size: [usize; 2], [column, row]: [usize; 2]) -> [usize; 2] {
    let nearest = |place: usize, axis: usize| first[axis] + (2 * place + 1) * cells[axis] / (2 * size[axis]);
    [nearest(column, 0), nearest(size[1] - 1 - row, 1)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_map_stands_upright() {
        let (first, cells) = ([3, 5], [2, 3]);
        // the first pixel is the cell on the left at the top
        assert_eq!(cell(first, cells, cells, [0, 0]), [3, 7]);
        assert_eq!(cell(first, cells, cells, [1, 2]), [4, 5]);
        // of 400 cells on 160 pixels the first and the last are within two cells of the edges
        let many = [400, 400];
        assert_eq!(cell([0, 0], many, [160, 160], [0, 159]), [1, 1]);
        assert_eq!(cell([0, 0], many, [160, 160], [159, 0]), [398, 398]);
    }
}
