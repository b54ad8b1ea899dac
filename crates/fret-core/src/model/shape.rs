//! Shapes that can be written down: each a gap over the surface, zero where it touches first.

mod gap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::formula::Formula;
use crate::document::Table;

/// Why a profile was refused.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum ProfileError {
    /// A length that is not positive and finite.
    #[error("{name} = {value}: must be positive and finite")]
    Length {
        /// Which length.
        name: &'static str,
        /// What was given.
        value: f64,
    },
    /// A radius of curvature that is zero or not finite.
    #[error("{name} = {value}: must be a finite length, and not zero")]
    Radius {
        /// Which radius.
        name: &'static str,
        /// What was given.
        value: f64,
    },
    /// A height that is not finite.
    #[error("height [{}, {}] = {value}: must be finite", at[0], at[1])]
    Height {
        /// Its cell.
        at: [usize; 2],
        /// What was given.
        value: f64,
    },
}

/// A direction in the surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, Table, JsonSchema)]
#[serde(rename_all = "lowercase")]
#[schemars(rename = "AxisFile")]
pub enum Axis {
    /// Along x.
    X,
    /// Along y.
    Y,
}

/// One part of the undeformed gap. A negative radius of a sphere, an ellipsoid or a cylinder is that of a hollow.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Shape {
    /// Paraboloid `r^2 / (2 R)`, the half-space model's own order of a sphere.
    Sphere {
        /// Radius R [length].
        radius: f64,
    },
    /// Paraboloid `x^2 / (2 Rx) + y^2 / (2 Ry)`.
    Ellipsoid {
        /// Radius of curvature in the x-z plane [length].
        radius_x: f64,
        /// Radius of curvature in the y-z plane [length].
        radius_y: f64,
    },
    /// Parabola `s^2 / (2 R)` across its axis; with a length, cut off square at both ends.
    Cylinder {
        /// Radius R [length].
        radius: f64,
        /// Direction of its axis.
        axis: Axis,
        /// Length along the axis [length]; `None`: without ends.
        length: Option<f64>,
    },
    /// Flat within the flat radius b, `(r - b)^2 / (2 R)` beyond.
    RoundedPunch {
        /// Radius b of the flat [length].
        flat_radius: f64,
        /// Radius R of the rounding [length].
        edge_radius: f64,
    },
    /// A flat circular end; no body beyond its radius.
    FlatPunch {
        /// Radius [length].
        radius: f64,
    },
    /// A blunt cone `slope r`.
    Cone {
        /// Slope of its side against the surface [-].
        slope: f64,
    },
    /// A cone with a spherical tip: `r^2 / (2 R)` up to the radius `R slope`, where it turns into the cone, `slope (r - R slope / 2)` beyond.
    SpheroCone {
        /// Radius R of the tip [length].
        radius: f64,
        /// Slope of the side against the surface [-].
        slope: f64,
    },
    /// A sphere that is worn or ground flat: flat within the flat radius b, `(r^2 - b^2) / (2 R)` beyond.
    WornSphere {
        /// Radius R of the sphere [length].
        radius: f64,
        /// Radius b of the flat [length].
        flat_radius: f64,
    },
    /// A pyramid, tip first: `slope` times the largest of the ways along the normals of its sides. The first side faces x.
    Pyramid {
        /// Number of its sides, three at least.
        sides: u8,
        /// Slope of a side against the surface [-].
        slope: f64,
    },
    /// A rectangular end: flat over its lengths; no body beyond, or with an edge radius R the square of the distance from the flat over 2 R.
    RectangularPunch {
        /// Lengths of the flat along x and y [length].
        lengths: [f64; 2],
        /// Radius R of the rounding [length]; `None`: sharp edges.
        edge_radius: Option<f64>,
    },
    /// A roller: `s^2 / (2 R)` across its axis; along it straight over the flat length, then crowned by the square of the way over
    /// `2 R_c`, and cut off square at its length.
    CrownedRoller {
        /// Radius R [length].
        radius: f64,
        /// Direction of its axis.
        axis: Axis,
        /// Length along the axis [length].
        length: f64,
        /// Length of its straight middle [length], zero or positive.
        flat_length: f64,
        /// Radius `R_c` of the crown along the axis [length].
        crown_radius: f64,
    },
    /// A sinusoidal surface `amplitude (1 - cos(2 pi x / Lx) cos(2 pi y / Ly))`.
    Wave {
        /// Amplitude [length]: half of the height from valley to crest.
        amplitude: f64,
        /// Wavelengths along x and y [length]; `None`: straight along that axis.
        wavelengths: [Option<f64>; 2],
    },
    /// An expression of x and y, lowest anywhere.
    Formula(Formula),
}

impl Shape {
    /// The shape itself when its lengths are usable.
    ///
    /// # Errors
    /// When a length is not positive and finite, or a radius of curvature is zero or not finite.
    pub fn checked(self) -> Result<Self, ProfileError> {
        let curved = |name: &'static str, value: f64| {
            let usable = value.is_finite() && value != 0.0 && value.recip().is_finite();
            if usable { Ok(()) } else { Err(ProfileError::Radius { name, value }) }
        };
        let positive = |name: &'static str, value: f64| {
            let usable = value.is_finite() && value > 0.0;
            if usable { Ok(()) } else { Err(ProfileError::Length { name, value }) }
        };
        match self {
            Self::Sphere { radius } => curved("radius", radius)?,
            Self::Ellipsoid { radius_x, radius_y } => {
                curved("radius_x", radius_x)?;
                curved("radius_y", radius_y)?;
            }
            Self::Cylinder { radius, length, .. } => {
                curved("radius", radius)?;
                length.map_or(Ok(()), |length| positive("length", length))?;
            }
            Self::RoundedPunch { flat_radius, edge_radius } => {
                positive("flat_radius", flat_radius)?;
                positive("edge_radius", edge_radius)?;
            }
            Self::FlatPunch { radius } => positive("radius", radius)?,
            Self::Cone { slope } => positive("slope", slope)?,
            Self::SpheroCone { radius, slope } => {
                positive("radius", radius)?;
                positive("slope", slope)?;
            }
            Self::WornSphere { radius, flat_radius } => {
                positive("radius", radius)?;
                positive("flat_radius", flat_radius)?;
            }
            Self::Pyramid { sides, slope } => {
                positive("sides", f64::from(sides.saturating_sub(2)))?;
                positive("slope", slope)?;
            }
            Self::RectangularPunch { lengths: [x, y], edge_radius } => {
                positive("length_x", x)?;
                positive("length_y", y)?;
                positive("edge_radius", edge_radius.unwrap_or(x))?;
            }
            Self::CrownedRoller { radius, length, flat_length, crown_radius, .. } => {
                positive("radius", radius)?;
                positive("length", length)?;
                positive("flat_length", if flat_length == 0.0 { length } else { flat_length })?;
                positive("crown_radius", crown_radius)?;
            }
            Self::Wave { amplitude, wavelengths: [x, y] } => {
                positive("amplitude", amplitude)?;
                positive("wavelength_x", x.unwrap_or(amplitude))?;
                positive("wavelength_y", y.unwrap_or(amplitude))?;
            }
            Self::Formula(_) => {}
        }
        Ok(self)
    }

    /// One of the numbers that make the shape, called as in a case.
    pub fn number(&self, name: &str) -> Option<f64> {
        match (self, name) {
            (
                &Self::Sphere { radius } | &Self::Cylinder { radius, .. } | &Self::FlatPunch { radius },
                "radius",
            ) => Some(radius),
            (&Self::Ellipsoid { radius_x, .. }, "radius_x") => Some(radius_x),
            (&Self::Ellipsoid { radius_y, .. }, "radius_y") => Some(radius_y),
            (&Self::RoundedPunch { flat_radius, .. }, "flat_radius") => Some(flat_radius),
            (&Self::RoundedPunch { edge_radius, .. }, "edge_radius") => Some(edge_radius),
            (&Self::Cone { slope }, "slope") => Some(slope),
            (&Self::Wave { amplitude, .. }, "amplitude") => Some(amplitude),
            (&Self::Wave { wavelengths, .. }, "wavelength_x") => wavelengths[0],
            (&Self::Wave { wavelengths, .. }, "wavelength_y") => wavelengths[1],
            (&Self::Cylinder { length, .. }, "length") => length,
            _ => None,
        }
    }

    /// The name of its table in a case.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Sphere { .. } => "sphere",
            Self::Ellipsoid { .. } => "ellipsoid",
            Self::Cylinder { .. } => "cylinder",
            Self::RoundedPunch { .. } => "rounded_punch",
            Self::FlatPunch { .. } => "flat_punch",
            Self::Cone { .. } => "cone",
            Self::SpheroCone { .. } => "sphero_cone",
            Self::WornSphere { .. } => "worn_sphere",
            Self::Pyramid { .. } => "pyramid",
            Self::RectangularPunch { .. } => "rectangular_punch",
            Self::CrownedRoller { .. } => "crowned_roller",
            Self::Wave { .. } => "wave",
            Self::Formula(_) => "formula",
        }
    }

    /// Curvatures along x and y of a paraboloid [1/length]; `None` for other shapes.
    pub fn curvatures(&self) -> Option<[f64; 2]> {
        match *self {
            Self::Sphere { radius } => Some([radius.recip(); 2]),
            Self::Ellipsoid { radius_x, radius_y } => Some([radius_x.recip(), radius_y.recip()]),
            Self::Cylinder { radius, axis, length: None } => match axis {
                Axis::X => Some([0.0, radius.recip()]),
                Axis::Y => Some([radius.recip(), 0.0]),
            },
            _ => None,
        }
    }

    /// Whether the gap is the same everywhere along an axis (0: x, 1: y).
    pub fn is_straight_along(&self, axis: usize) -> bool {
        match self {
            Self::Cylinder { axis: own, length: None, .. } => *own == [Axis::X, Axis::Y][axis],
            Self::Wave { wavelengths, .. } => wavelengths[axis].is_none(),
            Self::Formula(formula) => !formula.depends_on(axis),
            _ => false,
        }
    }
}
