//! A one-dimensional wave pressed on a half-space without friction.

use std::f64::consts::PI;

use fret_table::{Numbers, functions};
use serde::Serialize;

use super::error::{AnalyticError, positive};
use super::form::{Contents, Form, solved};
use super::moduli::effective_modulus;
use super::parameter::{MODULUS, number};

/// Frictionless contact of a wavy surface, gap `D (1 − cos(2πx/L))`, periodic in x and endless in y.
///
/// Full contact at the mean pressure `p* = πE*D/L`; below, `sin²(πa/L) = p̄/p*` and
/// `p = 2p̄ cos(πx/L)/sin²(πa/L) · √(sin²(πa/L) − sin²(πx/L))`; above, `p = p̄ + p* cos(2πx/L)`.
///
/// Source: Westergaard (1939), J. Appl. Mech. 6, 49; Johnson (1985), *Contact Mechanics*, section 13.2.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Numbers)]
#[non_exhaustive]
pub struct Westergaard {
    /// Wavelength L [length].
    pub wavelength: f64,
    /// Mean pressure p̄ over a wavelength [pressure].
    pub mean_pressure: f64,
    /// Mean pressure p* at which the contact becomes full [pressure].
    pub full_contact_pressure: f64,
    /// Half-width a of the contact at a crest [length]; L/2 in full contact.
    pub half_width: f64,
}

#[functions]
impl Westergaard {
    /// Wave of amplitude D and wavelength L [length] under a mean pressure.
    ///
    /// # Errors
    /// When a value is not positive and finite.
    pub fn new(
        amplitude: f64,
        wavelength: f64,
        mean_pressure: f64,
        modulus: f64,
    ) -> Result<Self, AnalyticError> {
        let (amplitude, wavelength) =
            (positive("amplitude", amplitude)?, positive("wavelength", wavelength)?);
        let mean_pressure = positive("mean pressure", mean_pressure)?;
        let full_contact_pressure = PI * effective_modulus(modulus)? * amplitude / wavelength;
        let share = (mean_pressure / full_contact_pressure).min(1.0);
        Ok(Self {
            wavelength,
            mean_pressure,
            full_contact_pressure,
            half_width: share.sqrt().asin() / PI * wavelength,
        })
    }

    /// Whether the surfaces touch everywhere.
    pub fn is_full(&self) -> bool {
        self.mean_pressure >= self.full_contact_pressure
    }

    /// Pressure at `x` from a crest [pressure]; zero where the surfaces are apart.
    #[shown]
    pub fn pressure(&self, x: f64) -> f64 {
        let phase = PI * x / self.wavelength;
        if self.is_full() {
            return self.mean_pressure + self.full_contact_pressure * (2.0 * phase).cos();
        }
        let edge = self.mean_pressure / self.full_contact_pressure;
        let depth = (edge - phase.sin().powi(2)).max(0.0);
        2.0 * self.full_contact_pressure * phase.cos().abs() * depth.sqrt()
    }
}

/// `westergaard` in the catalogue.
pub(super) const FORM: Form = Form {
    name: "westergaard",
    sentence: "Press a sinusoidal surface on a flat half-space without friction.",
    parameters: &[
        number("amplitude", "Amplitude of the wave, half its height [length]."),
        number("wavelength", "Wavelength [length]."),
        number("mean_pressure", "Mean pressure over a wavelength [pressure]."),
        MODULUS,
    ],
    solution: Contents::of::<Westergaard>(),
    solve: |given| {
        solved(given, |[amplitude, wavelength, mean, modulus]| {
            Westergaard::new(amplitude, wavelength, mean, modulus)
        })
    },
};

#[cfg(test)]
mod tests {
    use super::Westergaard;
    use crate::analytic::hertz_line::HertzLine;
    use crate::analytic::quadrature::integral;

    #[test]
    fn half_the_full_contact_pressure_touches_half_the_surface() {
        let full = Westergaard::new(0.01, 2.0, 1.0, 5.0).unwrap().full_contact_pressure;
        let wave = Westergaard::new(0.01, 2.0, full / 2.0, 5.0).unwrap();
        assert!((wave.half_width / 2.0 - 0.25).abs() < 1e-15);
        assert!((wave.pressure(0.0) / wave.mean_pressure - 2.828_427).abs() < 5.1e-7);
        assert!((wave.pressure(2.3) / wave.pressure(0.3) - 1.0).abs() < 1e-13);
        assert_eq!(wave.pressure(1.0), 0.0);
    }

    #[test]
    fn pressure_carries_the_mean_pressure() {
        for mean in [1e-3, 0.05, 0.2] {
            let wave = Westergaard::new(0.01, 2.0, mean, 5.0).unwrap();
            assert_eq!(wave.is_full(), mean > 0.1);
            let carried = integral(-wave.half_width, wave.half_width, |x| wave.pressure(x)) / 2.0;
            assert!((carried / mean - 1.0).abs() < 1e-12);
        }
        assert!(Westergaard::new(0.01, 2.0, 0.0, 5.0).is_err());
    }

    #[test]
    fn a_light_load_touches_like_cylinders() {
        // Radius of the crest L² / (4π² D); the wave's neighbours matter in the order (a/L)².
        let wave = Westergaard::new(0.01, 2.0, 1e-6, 5.0).unwrap();
        let crest = 4.0 / (4.0 * std::f64::consts::PI.powi(2) * 0.01);
        let line = HertzLine::cylinder(crest, 2e-6, 5.0).unwrap();
        assert!((wave.half_width / line.half_width - 1.0).abs() < 1e-5);
        assert!((wave.pressure(0.0) / line.max_pressure - 1.0).abs() < 1e-5);
    }
}
