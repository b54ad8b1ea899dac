//! A cylinder pressed on a half-space, pushed across its axis while one of the bodies is stretched.

use fret_table::{Numbers, functions};
use serde::Serialize;

use super::elliptic_integrals::CompleteElliptic;
use super::error::{AnalyticError, positive, within};
use super::form::{Contents, Form, Functions, solved};
use super::hertz_line::HertzLine;
use super::moduli::effective_modulus;
use super::parameter::{CYLINDER, FRICTION, STRAIN, STRAIN_OR_NONE, number};
use super::root::root_of_increasing;

/// Partial slip of a Hertz line contact under a growing tangential force Q' per length and a strain that grows with it.
///
/// With `f = |Q'|/μP'`: `c = a √(1 − f)`, `q = μp0 [√(1 − x²/a²) − (c/a) √(1 − (x − e)²/c²)]` along the force, the middle of what
/// sticks at `e = a E* ε/(2μp0)`, ε the strain of the lower surface less that of the upper one (`σ(1 − ν²)/E` under a tension of the
/// lower body; `e = aσ/(4μp0)` for bodies of one elasticity). For uncoupled bodies (β = 0), as long as all that slips slips one way: `|e| + c <= a`.
///
/// Source: Cattaneo (1938); Mindlin (1949); Nowell & Hills (1987), Int. J. Mech. Sci. 29, 355.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Numbers)]
#[non_exhaustive]
pub struct CattaneoLine {
    /// Tangential force per length Q' [force / length], signed.
    pub tangential_force: f64,
    /// Largest tangential force per length that friction holds, μP' [force / length].
    pub sliding_force: f64,
    /// Half-width a of the contact [length].
    pub half_width: f64,
    /// Largest shear that friction holds anywhere, μp0 [pressure].
    pub max_shear: f64,
    /// Half-width c of what sticks [length].
    pub stick_half_width: f64,
    /// Middle e of what sticks [length].
    pub stick_offset: f64,
}

#[functions]
impl CattaneoLine {
    /// Partial slip from the normal contact, the friction coefficient μ [-], the effective modulus E* [pressure], Q' and the
    /// relative strain ε [-].
    ///
    /// # Errors
    /// When μ or E* is not positive and finite, `|Q'| > μP'`, or the strain makes the two edges slip in opposite senses.
    pub fn new(
        hertz: &HertzLine,
        friction: f64,
        modulus: f64,
        tangential_force: f64,
        strain: f64,
    ) -> Result<Self, AnalyticError> {
        let (friction, modulus) = (positive("friction", friction)?, effective_modulus(modulus)?);
        within("strain", strain, strain.is_finite(), "finite")?;
        let (a, sliding_force) = (hertz.half_width, friction * hertz.line_force);
        let max_shear = friction * hertz.max_pressure;
        if !(tangential_force.abs() <= sliding_force) {
            return Err(AnalyticError::TooLarge {
                name: "tangential force",
                value: tangential_force,
                reason: "friction holds at most",
                limit: sliding_force,
            });
        }
        let stick_half_width = a * (1.0 - tangential_force.abs() / sliding_force).sqrt();
        let per_strain = a * modulus / (2.0 * max_shear);
        let limit = (a - stick_half_width) / per_strain;
        if strain.abs() > limit {
            return Err(AnalyticError::TooLarge {
                name: "strain",
                value: strain,
                reason: "all that slips slips one way up to",
                limit,
            });
        }
        let stick_offset = per_strain * strain * if tangential_force < 0.0 { -1.0 } else { 1.0 };
        Ok(Self { tangential_force, sliding_force, half_width: a, max_shear, stick_half_width, stick_offset })
    }

    /// Shear at `x` from the middle [pressure], with the sign of the force; zero outside the contact.
    #[shown]
    pub fn shear(&self, x: f64) -> f64 {
        let (a, c) = (self.half_width, self.stick_half_width);
        let root = |x: f64, half: f64| ((half - x) * (half + x)).max(0.0).sqrt() / a;
        let sign = if self.tangential_force < 0.0 { -1.0 } else { 1.0 };
        sign * self.max_shear * (root(x, a) - root(x - self.stick_offset, c))
    }
}

/// A Hertz line contact whose bodies are stretched against each other without a tangential force.
///
/// Both edges slip, in opposite senses, and the middle sticks: `E* ε/(2μp0) = (2/π) [K(k) − E(k)]`, `k² = 1 − c²/a²`, for bodies that do
/// not couple and a strain that grows at a constant normal force. Derived from the condition that the shear has no singularity at
/// the edges of stick, and held to a dense program.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Numbers)]
#[non_exhaustive]
pub struct StretchedLine {
    /// Half-width a of the contact [length].
    pub half_width: f64,
    /// Half-width c of what sticks [length].
    pub stick_half_width: f64,
}

impl StretchedLine {
    /// The contact of cylinders under a relative strain ε [-].
    ///
    /// # Errors
    /// When μ or E* is not positive and finite, or the strain is not finite.
    pub fn new(hertz: &HertzLine, friction: f64, modulus: f64, strain: f64) -> Result<Self, AnalyticError> {
        let (friction, modulus) = (positive("friction", friction)?, effective_modulus(modulus)?);
        within("strain", strain, strain.is_finite(), "finite")?;
        let load = modulus * strain.abs() / (2.0 * friction * hertz.max_pressure);
        let stick = stick_ratio(std::f64::consts::FRAC_PI_2 * load);
        Ok(Self { half_width: hertz.half_width, stick_half_width: stick * hertz.half_width })
    }
}

impl Functions for StretchedLine {}

/// `c/a` with `K(k) − E(k)` given, `k² = 1 − c²/a²`; zero where it is below the smallest number.
pub(super) fn stick_ratio(difference: f64) -> f64 {
    // K − E falls as the complementary modulus grows
    root_of_increasing(f64::MIN_POSITIVE, 1.0, |c| {
        let integrals = CompleteElliptic::complementary(c);
        difference - (1.0 - c) * (1.0 + c) * integrals.difference
    })
}

/// `cattaneo_line` in the catalogue.
pub(super) const PUSHED: Form = Form {
    name: "cattaneo_line",
    sentence: "Push a Hertz line contact across its axis, while a strain grows in proportion.",
    parameters: &[
        CYLINDER,
        FRICTION,
        number(
            "tangential_force",
            "Tangential force per length [force/length], at most friction times normal force.",
        ),
        STRAIN_OR_NONE,
    ],
    solution: Contents::of::<CattaneoLine>(),
    solve: |given| {
        solved(given, |[radius, normal, modulus, friction, tangential, strain]| {
            CattaneoLine::new(
                &HertzLine::cylinder(radius, normal, modulus)?,
                friction,
                modulus,
                tangential,
                strain,
            )
        })
    },
};

/// `stretched_line` in the catalogue.
pub(super) const STRETCHED: Form = Form {
    name: "stretched_line",
    sentence: "Stretch a Hertz line contact without a tangential force: both edges slip, in opposite senses.",
    parameters: &[CYLINDER, FRICTION, STRAIN],
    solution: Contents::of::<StretchedLine>(),
    solve: |given| {
        solved(given, |[radius, force, modulus, friction, strain]| {
            StretchedLine::new(&HertzLine::cylinder(radius, force, modulus)?, friction, modulus, strain)
        })
    },
};

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    const MODULUS: f64 = 3.0;

    fn hertz() -> HertzLine {
        HertzLine::cylinder(50.0, 0.02, MODULUS).unwrap()
    }

    /// Strain that moves the middle of stick by `e/a`.
    fn strain(friction: f64, offset: f64) -> f64 {
        2.0 * friction * hertz().max_pressure * offset / MODULUS
    }

    #[test]
    fn stick_zones_of_a_dense_program() {
        // Q/mu P, e/a and the ends of stick over a, found by a program of 1200 cells to a cell
        for (force, offset, low, high) in
            [(0.36, 0.1, -0.7, 0.9), (0.36, 0.2, -0.6, 1.0), (0.75, 0.25, -0.25, 0.75)]
        {
            let found = CattaneoLine::new(
                &hertz(),
                0.4,
                MODULUS,
                force * 0.4 * 0.02,
                strain(0.4, offset) * (1.0 - 1e-15),
            )
            .unwrap();
            let a = found.half_width;
            assert!(((found.stick_offset - found.stick_half_width) / a - low).abs() < 1e-12);
            assert!(((found.stick_offset + found.stick_half_width) / a - high).abs() < 1e-12);
        }
        assert!(CattaneoLine::new(&hertz(), 0.4, MODULUS, 0.36 * 0.4 * 0.02, strain(0.4, 0.21)).is_err());
        assert!(CattaneoLine::new(&hertz(), 0.4, MODULUS, 0.41 * 0.02, 0.0).is_err());
    }

    #[test]
    fn shear_carries_the_force_and_undoes_the_strain_where_it_sticks() {
        // plane strain: du/dx = -(2/(pi E*)) Int q(s)/(x - s) ds, here by strips whose integral is a logarithm
        for sign in [1.0, -1.0] {
            let strain = strain(0.4, 0.15);
            let found = CattaneoLine::new(&hertz(), 0.4, MODULUS, sign * 0.5 * 0.4 * 0.02, strain).unwrap();
            let (a, strips) = (found.half_width, 20_000_u32);
            let width = 2.0 * a / f64::from(strips);
            let middle = |i: u32| -a + (f64::from(i) + 0.5) * width;
            let force: f64 = (0..strips).map(|i| found.shear(middle(i)) * width).sum();
            assert!((force / found.tangential_force - 1.0).abs() < 1e-5); // square roots at the edges
            for place in [-0.5, 0.0, 0.7] {
                let x = found.stick_offset + place * found.stick_half_width + 0.5 * width;
                let slope: f64 = (0..strips)
                    .map(|i| {
                        let near = x - middle(i);
                        found.shear(middle(i)) * ((near + 0.5 * width) / (near - 0.5 * width)).abs().ln()
                    })
                    .sum();
                let slope = -2.0 / (PI * MODULUS) * slope;
                // the integral of such a root is met to the strips' width over the distance from its end
                assert!((slope + strain).abs() < 1e-3 * strain, "{place}: {slope} {strain}");
            }
        }
    }

    #[test]
    fn stretching_alone_leaves_the_middle_stuck() {
        // E* eps/(2 mu p0) = sigma/(4 mu p0) = 0.25, 1: 6 digits of the dense program's closed form
        for (load, stick) in [(0.25, 0.766_556), (1.0, 0.289_359)] {
            let strain = strain(0.4, load);
            let found = StretchedLine::new(&hertz(), 0.4, MODULUS, strain).unwrap();
            assert!((found.stick_half_width / found.half_width - stick).abs() < 1e-6, "{load}");
            let turned = StretchedLine::new(&hertz(), 0.4, MODULUS, -strain).unwrap();
            assert_eq!(found, turned);
        }
        let unstrained = StretchedLine::new(&hertz(), 0.4, MODULUS, 0.0).unwrap();
        assert!((unstrained.stick_half_width / unstrained.half_width - 1.0).abs() < 1e-15);
    }
}
