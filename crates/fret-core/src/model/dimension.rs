//! Over what bodies touch: an area, or strips that reach to infinity along y. What differs between the two is answered here.

use std::f64::consts::PI;
use std::ops::Range;

use serde::{Deserialize, Serialize};

/// Whether a contact has two axes, or is a line contact: plane strain across a line along y, areas, forces and energies those of a unit of
/// its length. Files say whether it is a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(from = "bool", into = "bool")]
pub enum Dimension {
    /// Cells along x and y.
    #[default]
    Plane,
    /// Strips along x.
    Line,
}

impl From<bool> for Dimension {
    fn from(of_a_line: bool) -> Self {
        if of_a_line { Self::Line } else { Self::Plane }
    }
}

impl From<Dimension> for bool {
    fn from(dimension: Dimension) -> Self {
        dimension == Dimension::Line
    }
}

impl Dimension {
    /// That of a grid of `[nx, ny]` cells: `[n, 1]` are strips.
    pub fn of(cells: [usize; 2]) -> Self {
        Self::from(cells[1] == 1)
    }

    /// The axes along which anything changes, 0: x, 1: y.
    pub fn axes(self) -> Range<usize> {
        0..self.names().len()
    }

    /// Names of these axes.
    pub fn names(self) -> &'static [&'static str] {
        match self {
            Self::Plane => &["x", "y"],
            Self::Line => &["x"],
        }
    }

    /// What is asked of each axis, `none` along a line.
    pub fn along<T>(self, of: impl Fn(usize) -> T, none: T) -> [T; 2] {
        match self {
            Self::Plane => [of(0), of(1)],
            Self::Line => [of(0), none],
        }
    }

    /// Sides of a grid of `[nx, ny]` cells that is to be so long and so wide [length]; a line contact is as wide as one of its strips.
    pub fn sides(self, [length, width]: [f64; 2], cells: [usize; 2]) -> [f64; 2] {
        match self {
            Self::Plane => [length, width],
            Self::Line => [length, length / cells[0] as f64],
        }
    }

    /// Area of a cell of sides `[dx, dy]` [length^2]; of a strip that of a unit of its length [length].
    pub fn cell_area(self, [dx, dy]: [f64; 2]) -> f64 {
        match self {
            Self::Plane => dx * dy,
            Self::Line => dx,
        }
    }

    /// Side of a square cell of the area of one of sides `[dx, dy]`, width of a strip [length].
    pub fn cell_side(self, [dx, dy]: [f64; 2]) -> f64 {
        match self {
            Self::Plane => (dx * dy).sqrt(),
            Self::Line => dx,
        }
    }

    /// Radius of a circle of an area, half the width of a strip [length].
    pub fn radius(self, area: f64) -> f64 {
        match self {
            Self::Plane => (area / PI).sqrt(),
            Self::Line => 0.5 * area,
        }
    }

    /// The kind of a quantity whose kind is written with the words length and force: loads of a line contact are those of a unit of its
    /// length.
    pub fn kind(self, kind: &str) -> &str {
        match (self, kind) {
            (Self::Line, "force") => "force/length",
            (Self::Line, "force x length") => "force",
            (Self::Line, "length^2") => "length",
            (Self::Line, "length^3") => "length^2",
            (Self::Line, "force/length") => "force/length^2",
            (_, other) => other,
        }
    }

    /// How a number of cells is written, `64 x 32` or `64`.
    pub fn written(self, [nx, ny]: [usize; 2]) -> String {
        match self {
            Self::Plane => format!("{nx} x {ny}"),
            Self::Line => nx.to_string(),
        }
    }

    /// What the area of a contact, or of a part of it, is called: `contact area`, or `contact width` of a line.
    pub fn area(self) -> &'static str {
        match self {
            Self::Plane => "area",
            Self::Line => "width",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A strip of width 2 a carries per unit of its length what a circle carries in all: areas are widths, forces are forces per length.
    #[test]
    fn a_strip_is_measured_by_its_width_and_per_unit_of_its_length() {
        let [plane, line] = [[8, 4], [8, 1]].map(Dimension::of);
        assert_eq!((plane, line), (Dimension::Plane, Dimension::Line));
        assert_eq!((plane.radius(PI * 9.0), line.radius(6.0)), (3.0, 3.0));
        assert_eq!((plane.cell_area([2.0, 8.0]), line.cell_area([2.0, 2.0])), (16.0, 2.0));
        assert_eq!((plane.cell_side([2.0, 8.0]), line.cell_side([2.0, 2.0])), (4.0, 2.0));
        assert_eq!(line.sides([8.0, 3.0], [4, 1]), [8.0, 2.0]);
        assert_eq!((plane.kind("force x length"), line.kind("force x length")), ("force x length", "force"));
        assert_eq!((plane.axes(), line.axes()), (0..2, 0..1));
        assert_eq!(line.along(|axis| axis + 5, 0), [5, 0]);
    }

    #[test]
    fn files_say_whether_it_is_a_line() {
        assert_eq!(serde_json::to_string(&Dimension::Line).unwrap(), "true");
        assert_eq!(serde_json::from_str::<Dimension>("false").unwrap(), Dimension::Plane);
    }
}
