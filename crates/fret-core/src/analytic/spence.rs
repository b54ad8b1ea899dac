//! Bodies that stick in a disc and slip around it while the normal force grows: coupled normal contact with finite friction.

use std::f64::consts::PI;

use serde::Serialize;

use super::elliptic_integrals::CompleteElliptic;
use super::error::{AnalyticError, positive, within};
use super::moduli;

/// One computed solution of a rigid indenter pressed on a homogeneous half-space with friction.
///
/// The stick ratio c/a follows from friction and Poisson's ratio alone; it is the same for a flat punch and a sphere, and stays as the
/// force grows. Ratios compare a sphere with the frictionless one at the same force. Source: Spence (1968), Proc. R. Soc. A 305, 55;
/// (1975), J. Elasticity 5, 297, for the problem; the numbers were computed with graded ring elements, extrapolated.
/// Uncertainty 1e-4, of friction at `ν = 0`, `c/a = 0.9` 2e-3. The pressure has a mild cusp in the middle.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct SpencePoint {
    /// Poisson's ratio [-].
    pub poisson: f64,
    /// Stick radius over contact radius, c/a [-].
    pub stick_ratio: f64,
    /// Friction coefficient μ [-].
    pub friction: f64,
    /// Contact radius over Hertz's [-].
    pub radius_ratio: Option<f64>,
    /// Pressure in the middle over Hertz's [-].
    pub peak_pressure_ratio: Option<f64>,
    /// Approach over Hertz's [-].
    pub approach_ratio: Option<f64>,
    /// Flat punch: force over the frictionless one at the same approach [-].
    pub punch_force_ratio: Option<f64>,
}

/// All computed points, by Poisson's ratio and stick ratio.
pub const SPENCE_TABLE: &[SpencePoint] = &[
    point(0.0, 0.2, 0.192_84).sphere(0.980_15, 1.320_31).approach(0.986_04).punch(1.034_70),
    point(0.0, 0.4, 0.260_90).sphere(0.973_67, 1.316_13).approach(0.981_61).punch(1.046_29),
    point(0.0, 0.5, 0.298_71).sphere(0.970_36, 1.314_05).approach(0.979_41).punch(1.052_21),
    point(0.0, 0.6, 0.343_50).sphere(0.966_79, 1.311_87).approach(0.977_13).punch(1.058_57),
    point(0.0, 0.7, 0.401_23).sphere(0.962_80, 1.309_53).approach(0.974_70),
    point(0.0, 0.8, 0.485_83).sphere(0.958_13, 1.306_99).approach(0.972_08),
    point(0.0, 0.9, 0.647_5).sphere(0.952_27, 1.304_16).approach(0.969_22),
    point(0.2, 0.2, 0.135_53),
    point(0.2, 0.4, 0.182_15),
    point(0.2, 0.5, 0.207_60).sphere(0.984_15, 1.154_60),
    point(0.2, 0.6, 0.237_26),
    point(0.2, 0.7, 0.274_72),
    point(0.2, 0.8, 0.327_94),
    point(0.2, 0.9, 0.423_71),
    point(0.3, 0.2, 0.100_03).sphere(0.993_99, 1.085_65).approach(0.995_74).punch(1.010_35),
    point(0.3, 0.4, 0.134_06).sphere(0.992_03, 1.084_61),
    point(0.3, 0.5, 0.152_48).sphere(0.991_03, 1.084_09),
    point(0.3, 0.6, 0.173_82).sphere(0.989_96, 1.083_54),
    point(0.3, 0.7, 0.200_53),
    point(0.3, 0.8, 0.238_00),
    point(0.3, 0.9, 0.303_87),
    point(0.4, 0.2, 0.056_78),
    point(0.4, 0.4, 0.075_92),
    point(0.4, 0.5, 0.086_22).sphere(0.997_01, 1.027_06),
    point(0.4, 0.6, 0.098_08),
    point(0.4, 0.7, 0.112_83),
    point(0.4, 0.8, 0.133_32),
    point(0.4, 0.9, 0.168_72),
];

const fn point(poisson: f64, stick_ratio: f64, friction: f64) -> SpencePoint {
    SpencePoint {
        poisson,
        stick_ratio,
        friction,
        radius_ratio: None,
        peak_pressure_ratio: None,
        approach_ratio: None,
        punch_force_ratio: None,
    }
}

impl SpencePoint {
    /// The tabulated point; what lies between is not interpolated.
    ///
    /// # Errors
    /// When the table does not hold it.
    pub fn tabulated(poisson: f64, stick_ratio: f64) -> Result<&'static Self, AnalyticError> {
        SPENCE_TABLE
            .iter()
            .find(|point| point.poisson == poisson && point.stick_ratio == stick_ratio)
            .ok_or(AnalyticError::NotTabulated { poisson, stick_ratio })
    }

    /// Friction coefficient [-] that the same stick ratio would need if pressure ignored shear: low by up to 15 % at `ν = 0`.
    ///
    /// `μ = β ln((1 + s)/(1 − s)) / (2 s K(√(1 − s²)))`, `s = c/a`. Source: Goodman (1962); Johnson (1985), *Contact Mechanics*, §5.4.
    pub fn uncoupled_friction(&self) -> f64 {
        let coupling = (1.0 - 2.0 * self.poisson) / (2.0 * (1.0 - self.poisson));
        let s = self.stick_ratio;
        coupling * s.atanh() / (s * CompleteElliptic::complementary(s).first_kind)
    }

    const fn sphere(mut self, radius_ratio: f64, peak_pressure_ratio: f64) -> Self {
        self.radius_ratio = Some(radius_ratio);
        self.peak_pressure_ratio = Some(peak_pressure_ratio);
        self
    }

    const fn approach(mut self, ratio: f64) -> Self {
        self.approach_ratio = Some(ratio);
        self
    }

    const fn punch(mut self, force_ratio: f64) -> Self {
        self.punch_force_ratio = Some(force_ratio);
        self
    }
}

/// Friction coefficient [-] at which the stick zone of a plane (2-D) contact takes the share `stick_ratio = c/a` of its width.
///
/// `K(√(1 − s²)) / K(s) = |β|/μ`, `s = c/a`. Source: Spence (1973), Proc. Camb. Phil. Soc. 73, 249.
///
/// # Errors
/// When the coupling β is not between -1 and 1, or the stick ratio is not between 0 and 1.
pub fn half_plane_friction(stick_ratio: f64, coupling: f64) -> Result<f64, AnalyticError> {
    let s = within("stick ratio", stick_ratio, stick_ratio > 0.0 && stick_ratio < 1.0, "between 0 and 1")?;
    let coupling = moduli::coupling(coupling)?;
    let first = CompleteElliptic::complementary(((1.0 - s) * (1.0 + s)).sqrt()).first_kind;
    Ok(coupling.abs() * first / CompleteElliptic::complementary(s).first_kind)
}

/// Share c/a [-] of a plane (2-D) contact that sticks; the inverse of [`half_plane_friction`], 1 without coupling.
///
/// `c/a = (θ2(q)/θ3(q))²` of the nome `q = exp(−π|β|/μ)`, or its complement where that converges faster.
///
/// # Errors
/// When μ is not positive and finite, or the coupling β is not between -1 and 1.
pub fn half_plane_stick_ratio(friction: f64, coupling: f64) -> Result<f64, AnalyticError> {
    let ratio = moduli::coupling(coupling)?.abs() / positive("friction", friction)?;
    if ratio >= 1.0 {
        return Ok(modulus_of_nome((-PI * ratio).exp()));
    }
    let complementary = modulus_of_nome((-PI / ratio).exp());
    Ok(((1.0 - complementary) * (1.0 + complementary)).sqrt())
}

/// Modulus of a nome `q <= exp(−π)`, where four terms of the theta series reach rounding.
fn modulus_of_nome(q: f64) -> f64 {
    let theta_2 = 1.0 + q.powi(2) + q.powi(6) + q.powi(12); // without 2 q^(1/4)
    let theta_3 = 1.0 + 2.0 * (q + q.powi(4) + q.powi(9) + q.powi(16));
    4.0 * q.sqrt() * (theta_2 / theta_3).powi(2)
}

#[cfg(test)]
mod tests {
    use super::{SPENCE_TABLE, SpencePoint, half_plane_friction, half_plane_stick_ratio};
    use crate::analytic::no_slip::{NoSlipPunch, NoSlipSphere};

    #[test]
    fn only_tabulated_points_are_given() {
        assert_eq!(SpencePoint::tabulated(0.3, 0.2).unwrap().friction, 0.100_03);
        assert!(SpencePoint::tabulated(0.3, 0.25).is_err());
        assert!(SpencePoint::tabulated(0.25, 0.2).is_err());
    }

    #[test]
    fn more_friction_sticks_more_and_lies_between_sliding_and_sticking() {
        for pair in SPENCE_TABLE.windows(2).filter(|pair| pair[0].poisson == pair[1].poisson) {
            assert!(pair[0].stick_ratio < pair[1].stick_ratio && pair[0].friction < pair[1].friction);
        }
        for point in SPENCE_TABLE {
            let coupling = (1.0 - 2.0 * point.poisson) / (2.0 * (1.0 - point.poisson));
            let stuck = NoSlipSphere::new(1.0, 1.0, 1.0, coupling).unwrap();
            let stuck_punch = NoSlipPunch::new(1.0, 1.0, 1.0, coupling).unwrap();
            assert!(
                point
                    .radius_ratio
                    .is_none_or(|ratio| ratio < 1.0 && ratio > stuck.force_ratio.cbrt().recip())
            );
            assert!(
                point.punch_force_ratio.is_none_or(|ratio| ratio > 1.0 && ratio < stuck_punch.force_ratio)
            );
        }
    }

    #[test]
    fn sphere_columns_agree_with_the_printed_force_ratio_and_approach_factor() {
        // P/P_H at the same radius and δR/a², printed beside the table to 5 digits; a^-3 triples the rounding.
        for (stick, force, factor) in
            [(0.2, 1.061_98, 1.026_37), (0.5, 1.094_47, 1.040_16), (0.6, 1.106_64, 1.045_42)]
        {
            let point = SpencePoint::tabulated(0.0, stick).unwrap();
            let (radius, approach) = (point.radius_ratio.unwrap(), point.approach_ratio.unwrap());
            assert!((radius.powi(-3) - force).abs() < 3e-5);
            assert!((approach / radius.powi(2) - factor).abs() < 3e-5);
        }
    }

    #[test]
    fn uncoupled_estimate_matches_printed_values() {
        for (poisson, stick, friction) in [
            (0.0, 0.2, 0.168_04),
            (0.0, 0.4, 0.224_46),
            (0.0, 0.5, 0.254_72),
            (0.0, 0.6, 0.289_49),
            (0.3, 0.2, 0.096_02),
        ] {
            let point = SpencePoint::tabulated(poisson, stick).unwrap();
            assert!((point.uncoupled_friction() - friction).abs() < 5.1e-6);
        }
    }

    #[test]
    fn half_plane_stick_matches_printed_values_and_its_inverse() {
        let (at_zero, at_three_tenths) = (0.5, 0.4 / 1.4);
        for (coupling, friction, stick) in [
            (at_zero, 0.2, 0.078_689),
            (at_zero, 0.3, 0.285_699),
            (at_zero, 0.5, std::f64::consts::FRAC_1_SQRT_2),
            (at_three_tenths, 0.1, 0.044_950),
            (at_three_tenths, 0.2, 0.405_789),
            (at_three_tenths, 0.3, 0.743_791),
            (at_three_tenths, 0.5, 0.967_764),
        ] {
            let found = half_plane_stick_ratio(friction, coupling).unwrap();
            assert!((found - stick).abs() < 5.1e-7);
            assert!((half_plane_friction(found, -coupling).unwrap() / friction - 1.0).abs() < 1e-13);
        }
        assert_eq!(half_plane_stick_ratio(0.3, 0.0).unwrap(), 1.0);
        assert!(half_plane_stick_ratio(0.0, 0.3).is_err() && half_plane_friction(1.0, 0.3).is_err());
    }
}
