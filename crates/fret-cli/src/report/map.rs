//! Where cells stick and where they slip, drawn as SVG: a run of like cells is one rectangle.

use std::fmt::Write;

use super::html::escaped;
use crate::results::Field;

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

/// A map of zones, x to the right and y upwards, cells of `spacing`. Drawn in cells, so that neighbours share their edges.
pub fn zones(field: &Field, window: Window, spacing: [f64; 2], what: &str) -> String {
    let [width, height] = window.cells;
    // a line contact is one row of cells: a bar
    let ratio = if height == 1 { 16.0 } else { width as f64 * spacing[0] / (height as f64 * spacing[1]) };
    let mut svg = format!(
        "<svg viewBox=\"0 0 {width} {height}\" preserveAspectRatio=\"none\" style=\"aspect-ratio:{ratio:.4}\" role=\"img\" \
         aria-label=\"{}\" shape-rendering=\"crispEdges\"><rect class=\"open\" width=\"{width}\" height=\"{height}\"/>\n",
        escaped(what)
    );
    for (zone, class) in [(1.0, "stick"), (2.0, "slip")] {
        let mut path = String::new();
        for j in 0..height {
            let is_zone = |i: usize| field.at(window.first[0] + i, window.first[1] + j) == zone;
            let mut i = 0;
            while i < width {
                let start = i;
                while i < width && is_zone(i) {
                    i += 1;
                }
                if i > start {
                    let _ = write!(path, "M{start} {}h{1}v1h-{1}z", height - 1 - j, i - start);
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_map_stands_upright_and_joins_cells_of_a_row() {
        // Two columns (x), three rows (y): slip at the bottom, stick above on the right.
        let field = Field { cells: [2, 3], values: vec![2.0, 0.0, 0.0, 2.0, 1.0, 0.0] };
        let window = Window { first: [0; 2], cells: [2, 3] };
        let svg = zones(&field, window, [1.0, 1.0], "");
        assert!(svg.contains("<path class=\"slip\" d=\"M0 2h2v1h-2z\"/>"), "{svg}");
        assert!(svg.contains("<path class=\"stick\" d=\"M1 1h1v1h-1z\"/>"), "{svg}");
    }

    #[test]
    fn a_window_holds_every_contact_with_a_margin() {
        let mut field = Field { cells: [20, 20], values: vec![0.0; 400] };
        field.values[5 * 20 + 9] = 1.0;
        field.values[7 * 20 + 19] = 2.0;
        assert_eq!(Window::around(&[field]), Some(Window { first: [3, 7], cells: [7, 13] }));
    }
}
