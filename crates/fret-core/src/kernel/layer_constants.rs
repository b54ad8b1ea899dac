//! Elastic constants of a layer, as the formulas of layers use them.

use crate::model::ElasticMaterial;

/// Elastic constants of one material, as the layer formulas use them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LayerConstants {
    /// Poisson's ratio.
    pub(super) nu: f64,
    /// Shear modulus \[pressure\].
    pub(super) mu: f64,
    /// `1 / (2 (1 - nu))`
    pub(super) b: f64,
    /// `(1 - 2 nu) / (2 (1 - nu))`
    pub(super) g: f64,
    /// `(1 - nu) / mu`, compliance of the half-space [1/pressure].
    pub(super) c0: f64,
    /// `b (1 - 4 nu)`
    pub(super) b_one_minus_4nu: f64,
    /// `(1 - g) (1 + g)`
    pub(super) one_minus_g2: f64,
}

impl LayerConstants {
    pub(crate) fn new(material: &ElasticMaterial) -> Self {
        let nu = material.poisson();
        let mu = material.shear_modulus();
        let b = 0.5 / (1.0 - nu);
        let g = (1.0 - 2.0 * nu) * b;
        Self {
            nu,
            mu,
            b,
            g,
            c0: (1.0 - nu) / mu,
            b_one_minus_4nu: b * (1.0 - 4.0 * nu),
            one_minus_g2: (1.0 - g) * (1.0 + g),
        }
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
