//! How pages write what has units: numbers, and the names of axes.

use fret_core::model::Dimension;
use fret_core::units::Units;

use super::{given, number};
use fret_drawing::Label;

/// What has units.
pub trait Measured {
    /// Units that the case declares.
    fn units(&self) -> Option<&Units>;

    /// Whether the contact has two axes or is a line contact, with loads of a unit of its length.
    fn dimension(&self) -> Dimension;

    /// The unit of a kind of quantity such as `force x length`, where the case declares units and the quantity has one.
    fn unit(&self, kind: &str) -> Option<String> {
        let unit = Units::unit(self.units(), kind, self.dimension())?;
        Some(unit.replace("^2", "²").replace("^3", "³"))
    }

    /// The name of an axis with its unit.
    fn label(&self, name: &str, kind: &str) -> Label {
        Label::with(name, self.unit(kind))
    }

    /// Names of the axes of the surface; a line contact has none along y.
    fn labels_of_surface(&self) -> [Label; 2] {
        let y = match self.dimension() {
            Dimension::Plane => self.label("y", "length"),
            Dimension::Line => Label::plain(""),
        };
        [self.label("x", "length"), y]
    }

    /// A printed number with its unit.
    fn with_unit(&self, number: String, kind: &str) -> String {
        self.unit(kind).map_or_else(|| number.clone(), |unit| format!("{number}\u{a0}{unit}"))
    }

    /// A number of the results with its unit.
    fn number(&self, value: f64, kind: &str) -> String {
        self.with_unit(number(value), kind)
    }

    /// A number of the case with its unit.
    fn given(&self, value: f64, kind: &str) -> String {
        self.with_unit(given(value), kind)
    }

    /// Names of the axes of a fretting loop, or of one of torsion.
    fn loop_labels(&self, twists: bool) -> [Label; 2] {
        if twists {
            [self.label("rotation", "rad"), self.label("torsional moment", "force x length")]
        } else {
            [self.label("relative displacement", "length"), self.label("tangential force", "force")]
        }
    }
}
