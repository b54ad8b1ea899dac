//! Where cells stick and where they slip, drawn as SVG: a run of like cells is one rectangle.

use std::fmt::Write;

use super::html::escaped;
use crate::results::Field;

/// Side of the longer edge of a map in the units of its drawing.
const SIDE: f64 = 200.0;
/// Cells around the contact that are shown.
const MARGIN: usize = 2;

/// The part of the grid that maps show: first cell and number of cells along each axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Window {
    first: [usize; 2],
    cells: [usize; 2],
}

impl Window {
    /// Around all cells that are in contact in any of the fields of zones; the whole grid where none is.
    pub fn around(zones: &[Field]) -> Option<Self> {
        let grid = zones.first()?.cells;
        let (mut low, mut high) = (grid, [0; 2]);
        for field in zones {
            for i in 0..grid[0] {
                for j in 0..grid[1] {
                    if field.at(i, j) > 0.0 {
                        low = [low[0].min(i), low[1].min(j)];
                        high = [high[0].max(i), high[1].max(j)];
                    }
                }
            }
        }
        if low[0] > high[0] {
            return Some(Self { first: [0; 2], cells: grid });
        }
        let first = low.map(|low| low.saturating_sub(MARGIN));
        let end = [0, 1].map(|axis| (high[axis] + 1 + MARGIN).min(grid[axis]));
        Some(Self { first, cells: [end[0] - first[0], end[1] - first[1]] })
    }
}

/// A map of zones, x to the right and y upwards, cells of `spacing`.
pub fn zones(field: &Field, window: Window, spacing: [f64; 2], what: &str) -> String {
    let sides = [0, 1].map(|axis| window.cells[axis] as f64 * spacing[axis]);
    let unit = SIDE / sides[0].max(sides[1]);
    let [width, height] = sides.map(|side| side * unit);
    let [cell_x, cell_y] = spacing.map(|side| side * unit);
    let mut svg = format!(
        "<svg viewBox=\"0 0 {width:.1} {height:.1}\" role=\"img\" aria-label=\"{}\" shape-rendering=\"crispEdges\">\
         <rect class=\"open\" width=\"{width:.1}\" height=\"{height:.1}\"/>\n",
        escaped(what)
    );
    for (zone, class) in [(1.0, "stick"), (2.0, "slip")] {
        let mut path = String::new();
        for j in 0..window.cells[1] {
            let is_zone = |i: usize| field.at(window.first[0] + i, window.first[1] + j) == zone;
            let mut i = 0;
            while i < window.cells[0] {
                let start = i;
                while i < window.cells[0] && is_zone(i) {
                    i += 1;
                }
                if i > start {
                    let (x, y) = (start as f64 * cell_x, height - (j + 1) as f64 * cell_y);
                    let run = (i - start) as f64 * cell_x;
                    let _ = write!(path, "M{x:.2} {y:.2}h{run:.2}v{cell_y:.2}h{:.2}z", -run);
                }
                i += 1;
            }
        }
        if !path.is_empty() {
            let _ = writeln!(svg, "<path class=\"{class}\" d=\"{path}\"/>");
        }
    }
    svg + "</svg>"
}
