//! Complete elliptic integrals by the arithmetic-geometric mean.

use std::f64::consts::FRAC_PI_2;

use serde::Serialize;

use super::error::{AnalyticError, within};

/// Complete elliptic integrals of one modulus k [-].
///
/// `K = ∫ dφ / √(1 − k² sin² φ)`, `E = ∫ √(1 − k² sin² φ) dφ`, φ from 0 to π/2; good to a few units of rounding.
/// Source: Abramowitz & Stegun (1964), §17.6. Fails (infinite K) at k = 1.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct CompleteElliptic {
    /// First kind, K [-].
    pub first_kind: f64,
    /// Second kind, E [-].
    pub second_kind: f64,
    /// `D = (K − E) / k²` [-], without the cancellation at small k; `π/4` at k = 0.
    pub difference: f64,
}

impl CompleteElliptic {
    /// Integrals of modulus `k`, `0 <= k < 1`.
    ///
    /// # Errors
    /// When the modulus is out of range.
    pub fn of_modulus(k: f64) -> Result<Self, AnalyticError> {
        within("modulus", k, (0.0..1.0).contains(&k), "at least 0 and below 1")?;
        Ok(Self::complementary(((1.0 - k) * (1.0 + k)).sqrt()))
    }

    /// Integrals of modulus `√(1 − k'²)`, `0 < k' <= 1`: exact where the modulus itself rounds to 1.
    ///
    /// # Errors
    /// When the complementary modulus is out of range.
    pub fn of_complementary_modulus(k: f64) -> Result<Self, AnalyticError> {
        within("complementary modulus", k, k > 0.0 && k <= 1.0, "above 0 and at most 1")?;
        Ok(Self::complementary(k))
    }

    /// As [`Self::of_complementary_modulus`], for a modulus already known to lie in range.
    pub(super) fn complementary(k: f64) -> Self {
        let (mut mean, mut geometric) = (f64::midpoint(1.0, k), k.sqrt());
        let mut half_gap = (1.0 - k) / 2.0; // c_n = (a_{n−1} − b_{n−1}) / 2
        let mut share = (1.0 - k) / (4.0 * (1.0 + k)); // c_n² / k² of the modulus
        let mut sum = 0.5;
        let mut power = 1.0; // 2^(n−1)
        while half_gap > f64::EPSILON * f64::EPSILON * mean {
            sum += power * share;
            let next = f64::midpoint(mean, geometric);
            geometric = (mean * geometric).sqrt();
            mean = next;
            let ratio = half_gap / (4.0 * mean);
            share *= ratio * ratio;
            half_gap *= ratio;
            power *= 2.0;
        }
        let first_kind = FRAC_PI_2 / mean;
        let difference = first_kind * sum;
        Self { first_kind, second_kind: first_kind - (1.0 - k) * (1.0 + k) * difference, difference }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

    use super::CompleteElliptic;

    #[test]
    fn integrals_agree_with_printed_values() {
        // Abramowitz & Stegun table 17.1 at k² = 0.5 and 0.9.
        for (squared, first, second) in [
            (0.5_f64, 1.854_074_677_301_37, 1.350_643_881_047_67),
            (0.9, 2.578_092_113_348_17, 1.104_774_732_704_07),
        ] {
            let found = CompleteElliptic::of_modulus(squared.sqrt()).unwrap();
            assert!((found.first_kind - first).abs() < 1e-13);
            assert!((found.second_kind - second).abs() < 1e-13);
        }
    }

    #[test]
    fn legendre_relation_holds_from_tiny_to_nearly_one() {
        for k in [1e-8, 1e-3, 0.3, 0.7, 0.99] {
            let (one, other) = (
                CompleteElliptic::of_modulus(k).unwrap(),
                CompleteElliptic::of_complementary_modulus(k).unwrap(),
            );
            let relation = one.second_kind * other.first_kind + other.second_kind * one.first_kind
                - one.first_kind * other.first_kind;
            assert!((relation - FRAC_PI_2).abs() < 1e-13);
        }
    }

    #[test]
    fn limits_and_refusals() {
        let zero = CompleteElliptic::of_modulus(0.0).unwrap();
        assert_eq!((zero.first_kind, zero.second_kind), (FRAC_PI_2, FRAC_PI_2));
        assert!((zero.difference - FRAC_PI_4).abs() < 1e-16);
        let steep = CompleteElliptic::of_complementary_modulus(1e-12).unwrap();
        assert!((steep.first_kind - 4e12_f64.ln()).abs() < 1e-13);
        assert!(
            CompleteElliptic::of_modulus(1.0).is_err() && CompleteElliptic::of_modulus(f64::NAN).is_err()
        );
    }
}
