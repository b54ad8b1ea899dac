//! Pictures of sections: a field over x and depth in false colours, as SVG.

use fret_core::units::Units;

use fret_drawing::{Axis, Drawing, Label, Map, Raster};

use crate::failure::Failure;

/// Width of a picture in its own units.
const WIDTH: f64 = 480.0;
/// Pixels along the depth, and along x at most.
const PIXELS: usize = 256;
const MOST_COLUMNS: usize = 512;

/// A field over the x axis (columns) and depths (rows), to be drawn.
pub struct Section<'a> {
    /// Title.
    pub title: &'a str,
    /// What is shown, where and when.
    pub subject: &'a str,
    /// Name of the quantity and kind of its unit.
    pub quantity: (&'a str, &'a str),
    /// Units that the case declares.
    pub units: Option<&'a Units>,
    /// Cell centres along x.
    pub x: &'a [f64],
    /// Depths of the rows, rising; equal ones are the two sides of an interface.
    pub depths: &'a [f64],
    /// `values[row][column]`.
    pub values: &'a [Vec<f64>],
    /// Depths of interfaces.
    pub interfaces: &'a [f64],
    /// Values of the lowest and the highest colour; by default those of the section.
    pub range: Option<[f64; 2]>,
}

impl Section<'_> {
    /// The picture as a file of its own; empty without data.
    pub fn svg(&self) -> Result<String, Failure> {
        let drawing = self.drawing(WIDTH)?;
        Ok(drawing.map_or_else(String::new, |drawing| drawing.alone(&[self.title, self.subject])))
    }

    /// The picture of a width; none without data.
    pub fn drawing(&self, width: f64) -> Result<Option<Drawing>, Failure> {
        let (Some(first), Some(last)) = (self.x.first(), self.x.last()) else { return Ok(None) };
        let (Some(top), Some(bottom)) = (self.depths.first(), self.depths.last()) else {
            return Ok(None);
        };
        let half = if self.x.len() > 1 { 0.5 * (self.x[1] - self.x[0]) } else { 0.5 };
        let range = self.range.unwrap_or_else(|| Axis::ends(self.values.iter().flatten().copied()));
        let columns = self.x.len().min(MOST_COLUMNS);
        let value = |column: usize, row: usize| {
            let depth = top + (row as f64 + 0.5) / PIXELS as f64 * (bottom - top);
            let i = (2 * column + 1) * self.x.len() / (2 * columns);
            self.values[self.row_at(depth)].get(i).copied().unwrap_or(f64::NAN)
        };
        let label = |name: &str, kind: &str| Label::with(name, self.units.map(|units| units.of(kind)));
        let map = Map {
            what: format!("{}, {}", self.quantity.0, self.subject),
            width,
            axes: [label("x", "length"), label("depth", "length")],
            x: [first - half, last + half],
            y: [*top, *bottom],
            downward: true,
            image: Raster::of_values([columns, PIXELS], range, value).address()?,
            id: None,
            bar: Some((label(self.quantity.0, self.quantity.1), range)),
            levels: self.interfaces.iter().copied().filter(|face| face > top && face < bottom).collect(),
        };
        Ok(Some(map.drawing()?))
    }

    /// The row nearest to a depth, on its side of an interface.
    fn row_at(&self, depth: f64) -> usize {
        let below = self.depths.partition_point(|row| *row < depth).min(self.depths.len() - 1);
        let above = below.saturating_sub(1);
        if depth - self.depths[above] < self.depths[below] - depth { above } else { below }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn titles_are_safe_interfaces_are_drawn_and_axes_have_units() {
        let values = vec![vec![0.0; 8], vec![1.0; 8]];
        let units = Units::new("mm", "N");
        let section = Section {
            title: "a < b & c",
            subject: "increment 3",
            quantity: ("stress", "pressure"),
            units: Some(&units),
            x: &[0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0],
            depths: &[0.0, 2.0],
            values: &values,
            interfaces: &[1.0],
            range: None,
        };
        let svg = section.svg().unwrap();
        assert!(svg.contains("a &lt; b &amp; c"));
        assert!(svg.contains("stress [MPa]") && svg.contains("depth [mm]"));
        assert_eq!(svg.matches("class=\"interface\"").count(), 1);
        assert!(svg.ends_with("</svg>\n") && !svg.contains("NaN"));
    }

    #[test]
    fn a_depth_shows_the_row_nearest_to_it_on_its_own_side_of_an_interface() {
        let rows = [0.0, 1.0, 1.0, 3.0];
        let section = Section {
            title: "",
            subject: "",
            quantity: ("", ""),
            units: None,
            x: &[0.0],
            depths: &rows,
            values: &[],
            interfaces: &[],
            range: None,
        };
        for (depth, row) in [(0.2, 0), (0.8, 1), (1.2, 2), (2.5, 3), (3.0, 3)] {
            assert_eq!(section.row_at(depth), row, "{depth}");
        }
    }
}
