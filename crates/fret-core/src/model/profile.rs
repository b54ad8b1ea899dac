//! The undeformed gap between the bodies: zero at first touch, positive elsewhere.

use ndarray::Array2;
use serde::{Deserialize, Serialize};

use super::grid::SurfaceGrid;

/// Why a profile was refused.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum ProfileError {
    /// A radius that is not a positive finite length.
    #[error("{name} = {value}: must be a positive finite length")]
    Radius {
        /// Which radius.
        name: &'static str,
        /// What was given.
        value: f64,
    },
}

/// Shape of the undeformed gap.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Profile {
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
    /// A sinusoidal surface `amplitude (1 - cos(2 pi x / Lx) cos(2 pi y / Ly))`.
    Wave {
        /// Amplitude [length]: half of the height from valley to crest.
        amplitude: f64,
        /// Wavelengths along x and y [length]; `None`: straight along that axis.
        wavelengths: [Option<f64>; 2],
    },
}

impl Profile {
    /// The profile itself when its lengths are usable.
    ///
    /// # Errors
    /// When a radius is not a positive finite length.
    pub fn checked(self) -> Result<Self, ProfileError> {
        let lengths = match self {
            Self::Sphere { radius } => [("radius", radius), ("radius", radius)],
            Self::Ellipsoid { radius_x, radius_y } => [("radius_x", radius_x), ("radius_y", radius_y)],
            Self::Wave { amplitude, wavelengths: [x, y] } => {
                let shortest = x.unwrap_or(amplitude).min(y.unwrap_or(amplitude));
                [("amplitude", amplitude), ("wavelength", shortest)]
            }
        };
        for (name, value) in lengths {
            if !(value.is_finite() && value > 0.0) {
                return Err(ProfileError::Radius { name, value });
            }
        }
        Ok(self)
    }

    /// Undeformed gap at a point [length].
    pub fn gap_at(&self, x: f64, y: f64) -> f64 {
        match *self {
            Self::Sphere { radius } => (x * x + y * y) / (2.0 * radius),
            Self::Ellipsoid { radius_x, radius_y } => x * x / (2.0 * radius_x) + y * y / (2.0 * radius_y),
            Self::Wave { amplitude, wavelengths } => {
                let wave = |along: f64, length: Option<f64>| {
                    length.map_or(1.0, |length| (std::f64::consts::TAU * along / length).cos())
                };
                amplitude * (1.0 - wave(x, wavelengths[0]) * wave(y, wavelengths[1]))
            }
        }
    }

    /// Undeformed gap at the cell centres [length], shape `(nx, ny)`.
    pub fn gap(&self, grid: &SurfaceGrid) -> Array2<f64> {
        let [nx, ny] = grid.cells();
        Array2::from_shape_fn((nx, ny), |(i, j)| self.gap_at(grid.centre(0, i), grid.centre(1, j)))
    }
}
