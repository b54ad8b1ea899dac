//! Elastic constants of a layer, as the formulas of layers use them.

use crate::fields::Scalar;
use crate::model::ElasticMaterial;

/// Elastic constants of one material, as the layer formulas use them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LayerConstants<C = f64> {
    /// Poisson's ratio.
    pub(super) nu: C,
    /// Shear modulus \[pressure\].
    pub(super) mu: C,
    /// `1 / (2 (1 - nu))`
    pub(super) b: C,
    /// `(1 - 2 nu) / (2 (1 - nu))`
    pub(super) g: C,
    /// `(1 - nu) / mu`, compliance of the half-space [1/pressure].
    pub(super) c0: C,
    /// `b (1 - 4 nu)`
    pub(super) b_one_minus_4nu: C,
    /// `(1 - g) (1 + g)`
    pub(super) one_minus_g2: C,
}

impl<C: Scalar> LayerConstants<C> {
    /// Those of Young's modulus and Poisson's ratio.
    pub(crate) fn of(young: C, nu: C) -> Self {
        let one = C::of(1.0);
        let mu = young / ((nu + 1.0) * 2.0);
        let b = C::of(0.5) / (one - nu);
        let g = (one - nu * 2.0) * b;
        Self {
            nu,
            mu,
            b,
            g,
            c0: (one - nu) / mu,
            b_one_minus_4nu: b * (one - nu * 4.0),
            one_minus_g2: (one - g) * (g + 1.0),
        }
    }
}

impl LayerConstants {
    pub(crate) fn new(material: &ElasticMaterial) -> Self {
        Self::of(material.young(), material.poisson())
    }

    /// Of a layer whose shear modulus stands for a conductivity: conduction is antiplane shear (Poisson's ratio does not enter).
    pub(crate) fn conducting(conductivity: f64) -> Self {
        let c0 = 1.0 / conductivity;
        Self { nu: 0.0, mu: conductivity, b: 0.5, g: 0.5, c0, b_one_minus_4nu: 0.5, one_minus_g2: 0.75 }
    }

    /// Poisson's ratio.
    pub(crate) fn poisson(&self) -> f64 {
        self.nu
    }

    /// Shear modulus \[pressure\].
    pub(crate) fn shear_modulus(&self) -> f64 {
        self.mu
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Shear modulus 4 without lateral contraction.
    #[test]
    fn a_layer_that_conducts_is_one_without_lateral_contraction() {
        let [one, other] =
            [LayerConstants::conducting(4.0), LayerConstants::new(&ElasticMaterial::new(8.0, 0.0).unwrap())];
        let all = |c: &LayerConstants| [c.nu, c.mu, c.b, c.g, c.c0, c.b_one_minus_4nu, c.one_minus_g2];
        assert_eq!(all(&one), all(&other));
        assert_eq!((one.c0, one.shear_modulus(), one.poisson()), (0.25, 4.0, 0.0));
    }
}
