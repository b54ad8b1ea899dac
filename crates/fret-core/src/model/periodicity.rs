//! Along which axes a problem repeats.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::shape::Axis;
use crate::document::Table;

/// Along which axes a problem repeats, with the sides of the grid for its periods. Files have `false`, `true`, `"x"` or `"y"`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, Table, JsonSchema)]
#[serde(untagged)]
#[expected("true, false, \"x\" or \"y\"")]
#[schemars(untagged, rename = "PeriodicSchema", description = "")]
pub enum Periodicity {
    /// Along both, or along none.
    Both(bool),
    /// Along one; along the other the half-spaces are infinite.
    Along(Axis),
}

impl Default for Periodicity {
    fn default() -> Self {
        Self::NONE
    }
}

impl Periodicity {
    /// A single contact on infinite half-spaces.
    pub const NONE: Self = Self::Both(false);
    /// One that repeats along x and y.
    pub const BOTH: Self = Self::Both(true);

    /// Whether it repeats along x and along y.
    pub fn axes(self) -> [bool; 2] {
        match self {
            Self::Both(both) => [both; 2],
            Self::Along(axis) => [axis == Axis::X, axis == Axis::Y],
        }
    }

    /// Whether it repeats along neither.
    pub fn is_none(self) -> bool {
        self == Self::NONE
    }

    /// Whether it repeats along both.
    pub fn is_both(self) -> bool {
        self == Self::BOTH
    }

    /// The one axis along which it repeats, 0: x, 1: y.
    pub fn one_axis(self) -> Option<usize> {
        match self {
            Self::Both(_) => None,
            Self::Along(Axis::X) => Some(0),
            Self::Along(Axis::Y) => Some(1),
        }
    }

    /// In words: nothing, `periodic in y`, `periodic in x and y`.
    pub fn in_words(self) -> &'static str {
        match self {
            Self::Both(false) => "",
            Self::Both(true) => "periodic in x and y",
            Self::Along(Axis::X) => "periodic in x",
            Self::Along(Axis::Y) => "periodic in y",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_name_the_axes_by_a_truth_or_a_letter() {
        for (text, axes, one) in [
            ("false", [false; 2], None),
            ("true", [true; 2], None),
            ("\"x\"", [true, false], Some(0)),
            ("\"y\"", [false, true], Some(1)),
        ] {
            let read: Periodicity = serde_json::from_str(text).unwrap();
            assert_eq!((read.axes(), read.one_axis()), (axes, one));
            assert_eq!(serde_json::to_string(&read).unwrap(), text);
            assert_eq!([read.is_none(), read.is_both()], [axes == [false; 2], axes == [true; 2]]);
            assert_eq!(read.in_words().is_empty(), read.is_none());
        }
        assert!(Periodicity::default().is_none());
    }
}
