//! A rigid sphere on a layer much thinner than the contact is wide, bonded to a rigid base: leading-order asymptotes.

use std::f64::consts::PI;

use fret_table::{Numbers, functions};
use serde::Serialize;

use super::error::{AnalyticError, positive};
use super::form::{Contents, Form, solved};
use super::parameter::{FORCE, LAYER, number};
use crate::model::{Coating, ElasticMaterial};

/// Rigid frictionless sphere on a thin bonded layer, `a >> h`.
///
/// Compressible, the layer answers like springs: `p = Et (δ − r²/2R)/h`, `Et = E(1 − ν)/((1 + ν)(1 − 2ν))`, `δ = a²/2R`,
/// `P = πEt a⁴/(4Rh)`; the force is 2.5 % low at `a = 20h`, 10 % at `a = 5h` (`ν = 0.3`).
/// Incompressible (`ν = 0.5`), it is squeezed out sideways: `p = 3G (a² − r²)²/(32Rh³)`, `δ = a²/4R`, `P = πGa⁶/(32Rh³)`; low by a
/// factor 1.5 at `a = 20h`, 4.3 at `a = 5h`. Neither serves just below 0.5: at `ν = 0.45`, `a = 20h` the springs are 12 % too stiff.
///
/// Source: Johnson (1985), *Contact Mechanics*, section 5.8; Jaffar (1989); Barber (1990).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Numbers)]
#[non_exhaustive]
pub struct ThinLayer {
    /// Normal force P [force].
    pub force: f64,
    /// Radius a of the contact [length].
    pub contact_radius: f64,
    /// Pressure in the middle [pressure].
    pub max_pressure: f64,
    /// Approach δ [length].
    pub approach: f64,
    /// Whether the layer keeps its volume.
    pub incompressible: bool,
}

#[functions]
impl ThinLayer {
    /// Sphere of radius R pressed on the layer by a normal force.
    ///
    /// # Errors
    /// When the radius or the force is not positive and finite.
    pub fn sphere(sphere_radius: f64, force: f64, layer: &Coating) -> Result<Self, AnalyticError> {
        let (sphere_radius, force) = (positive("sphere radius", sphere_radius)?, positive("force", force)?);
        let (young, poisson) = (layer.material().young(), layer.material().poisson());
        if poisson == 0.5 {
            let stiffness =
                layer.material().shear_modulus() / (32.0 * sphere_radius * layer.thickness().powi(3));
            let a = (force / (PI * stiffness)).cbrt().sqrt();
            let (max_pressure, approach) = (3.0 * stiffness * a.powi(4), a * a / (4.0 * sphere_radius));
            return Ok(Self { force, contact_radius: a, max_pressure, approach, incompressible: true });
        }
        let foundation =
            young * (1.0 - poisson) / ((1.0 + poisson) * (1.0 - 2.0 * poisson)) / layer.thickness();
        let a = (4.0 * force * sphere_radius / (PI * foundation)).powf(0.25);
        let approach = a * a / (2.0 * sphere_radius);
        let max_pressure = foundation * approach;
        Ok(Self { force, contact_radius: a, max_pressure, approach, incompressible: false })
    }

    /// Pressure at distance `r` from the middle [pressure]; zero outside the contact.
    #[shown]
    pub fn pressure(&self, r: f64) -> f64 {
        let depth = (1.0 - (r / self.contact_radius).powi(2)).max(0.0);
        self.max_pressure * if self.incompressible { depth * depth } else { depth }
    }
}

/// `thin_layer` in the catalogue.
pub(super) const FORM: Form = Form {
    name: "thin_layer",
    sentence: "Press a rigid sphere on a thin bonded layer.",
    parameters: &[number("radius", "Radius of the sphere [length]."), FORCE, LAYER],
    solution: Contents::of::<ThinLayer>(),
    solve: |given| {
        solved(given, |[radius, force, young, poisson, thickness]| {
            ThinLayer::sphere(radius, force, &Coating::new(ElasticMaterial::new(young, poisson)?, thickness)?)
        })
    },
};

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::ThinLayer;
    use crate::analytic::quadrature::integral;
    use crate::model::{Coating, ElasticMaterial};

    fn contact(force: f64, poisson: f64) -> ThinLayer {
        let layer = Coating::new(ElasticMaterial::new(3.0, poisson).unwrap(), 0.1).unwrap();
        ThinLayer::sphere(50.0, force, &layer).unwrap()
    }

    #[test]
    fn pressure_carries_the_force_and_the_pressure_in_the_middle_is_the_layer_stiffness() {
        for poisson in [0.0, 0.3, 0.5] {
            let layer = contact(2.0, poisson);
            let carried = integral(0.0, layer.contact_radius, |r| 2.0 * PI * r * layer.pressure(r));
            assert!((carried / 2.0 - 1.0).abs() < 1e-13);
        }
        let springs = contact(2.0, 0.0); // Et = E without lateral strain
        assert!((springs.pressure(0.0) / (3.0 * springs.approach / 0.1) - 1.0).abs() < 1e-14);
    }

    #[test]
    fn approach_grows_with_the_square_root_and_with_the_cube_root_of_the_force() {
        assert!((contact(4.0, 0.3).approach / contact(1.0, 0.3).approach - 2.0).abs() < 1e-14);
        assert!((contact(8.0, 0.5).approach / contact(1.0, 0.5).approach - 2.0).abs() < 1e-14);
    }
}
