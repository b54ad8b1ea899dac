//! A rigid sphere on a layer thicker than the contact is wide, bonded to a rigid base: an expansion about Hertz.

use std::f64::consts::PI;

use fret_table::Numbers;
use serde::Serialize;

use super::error::{AnalyticError, positive, within};
use super::form::{Contents, Form, Functions, solved};
use super::parameter::{LAYER, number};
use super::quadrature::integral;
use crate::model::{Coating, ElasticMaterial};

/// Largest a/h that is accepted: the force is then 0.5 % high, the approach 0.5 %.
const LARGEST_RATIO: f64 = 0.4;

/// Rigid frictionless sphere on a thick layer, expanded in `ε = a/h`.
///
/// `P = 4E*a³/(3R) · (1 − 8α1ε³/3π)`, `δ = a²/R · (1 − 4α0ε/3π − 16α1ε³/5π + 32α0α1ε⁴/9π²)`, where `α0 = ∫ Λ du` and
/// `α1 = −¼ ∫ Λ u² du` of the layer's response. Refused above `a = 0.4h`.
///
/// Source: Vorovich, Aleksandrov & Babeshko (1974); Argatov (2001); Li et al. (2020), Proc. `IMechE` J 234, 73.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Numbers)]
#[non_exhaustive]
pub struct ThickLayer {
    /// Normal force P [force].
    pub force: f64,
    /// Radius a of the contact [length].
    pub contact_radius: f64,
    /// Approach δ [length].
    pub approach: f64,
}

impl ThickLayer {
    /// Sphere of radius R that touches the layer over a disc of radius a.
    ///
    /// # Errors
    /// When a length is not positive and finite, or the contact is too wide for the expansion.
    pub fn sphere(sphere_radius: f64, contact_radius: f64, layer: &Coating) -> Result<Self, AnalyticError> {
        let (radius, a) =
            (positive("sphere radius", sphere_radius)?, positive("contact radius", contact_radius)?);
        let epsilon = a / layer.thickness();
        within("contact radius over thickness", epsilon, epsilon <= LARGEST_RATIO, "at most 0.4")?;
        let poisson = layer.material().poisson();
        let modulus = layer.material().young() / (1.0 - poisson * poisson);
        let [a0, a1] = response_moments(poisson);
        let deeper = 1.0 - 4.0 * a0 * epsilon / (3.0 * PI) - 16.0 * a1 * epsilon.powi(3) / (5.0 * PI)
            + 32.0 * a0 * a1 * epsilon.powi(4) / (9.0 * PI * PI);
        Ok(Self {
            force: 4.0 * modulus * a.powi(3) / (3.0 * radius)
                * (1.0 - 8.0 * a1 * epsilon.powi(3) / (3.0 * PI)),
            contact_radius: a,
            approach: a * a / radius * deeper,
        })
    }
}

impl Functions for ThickLayer {}

/// `[α0, α1]` of [`ThickLayer`].
fn response_moments(poisson: f64) -> [f64; 2] {
    let l = 4.0 * poisson - 3.0;
    let response = |u: f64| {
        let (near, far) = ((-2.0 * u).exp(), (-4.0 * u).exp());
        let squares = l * l + 1.0 + 4.0 * u * u;
        (2.0 * l * far - (squares + 4.0 * u) * near) / (l - squares * near + l * far)
    };
    let beyond_rounding = 25.0;
    [
        integral(0.0, beyond_rounding, response),
        -0.25 * integral(0.0, beyond_rounding, |u| response(u) * u * u),
    ]
}

/// `thick_layer` in the catalogue.
pub(super) const FORM: Form = Form {
    name: "thick_layer",
    sentence: "Press a rigid sphere on a thick bonded layer until it touches over a disc of `contact_radius`, at most 0.4 h.",
    parameters: &[
        number("radius", "Radius of the sphere [length]."),
        number("contact_radius", "Radius of the contact, at most 0.4 of the thickness [length]."),
        LAYER,
    ],
    solution: Contents::of::<ThickLayer>(),
    solve: |given| {
        solved(given, |[radius, a, young, poisson, thickness]| {
            ThickLayer::sphere(radius, a, &Coating::new(ElasticMaterial::new(young, poisson)?, thickness)?)
        })
    },
};

#[cfg(test)]
mod tests {
    use super::{ThickLayer, response_moments};
    use crate::analytic::hertz::Hertz;
    use crate::model::{Coating, ElasticMaterial};

    fn layer() -> Coating {
        Coating::new(ElasticMaterial::new(1.0, 0.3).unwrap(), 1.0).unwrap()
    }

    #[test]
    fn moments_of_the_response_match_printed_values() {
        let [a0, a1] = response_moments(0.3);
        assert!((a0 - 1.376_854_165_46).abs() < 1e-11);
        assert!((a1 + 0.627_551_661_384).abs() < 1e-12);
    }

    #[test]
    fn force_and_approach_follow_the_exact_solution() {
        // Exact ratios to Hertz from a Fredholm equation; the series drops the fourth power of a/h.
        for (ratio, force, approach, tolerance) in [
            (0.1, 1.000_525_84, 0.942_166_53, 1e-5),
            (0.2, 1.004_057_52, 0.887_577_70, 3e-4),
            (0.4, 1.028_663_60, 0.795_441_83, 6e-3),
        ] {
            let contact = ThickLayer::sphere(10.0, ratio, &layer()).unwrap();
            let hertz = Hertz::sphere_at_approach(10.0, ratio * ratio / 10.0, 1.0 / 0.91).unwrap();
            assert!((contact.force / hertz.force - force).abs() < tolerance);
            assert!((contact.approach / hertz.approach - approach).abs() < tolerance);
        }
        let contact = ThickLayer::sphere(10.0, 0.1, &layer()).unwrap();
        assert!((contact.force * 7.5 * 0.91 / 0.1_f64.powi(3) - 1.000_532_68).abs() < 5.1e-9); // printed series value
        assert!((contact.approach * 1000.0 - 0.942_172_59).abs() < 5.1e-9);
    }

    #[test]
    fn a_contact_too_wide_for_the_expansion_is_refused() {
        assert!(ThickLayer::sphere(10.0, 0.5, &layer()).is_err());
        assert!(ThickLayer::sphere(10.0, 0.0, &layer()).is_err());
    }
}
