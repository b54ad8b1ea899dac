//! A sphere under constant normal force, pushed to and fro between two equal tangential forces.

use fret_table::functions;
use serde::Serialize;

use super::cattaneo_mindlin::CattaneoMindlin;
use super::error::{AnalyticError, within};
use super::hertz::Hertz;

/// Which part of the fretting loop.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub enum Branch {
    /// From rest to the first peak.
    Loading,
    /// From the positive peak to the negative.
    Unloading,
    /// From the negative peak to the positive.
    Reloading,
}

/// The fretting loop of a Hertz contact between tangential forces −T0 and T0, at constant normal force.
///
/// On unloading `c1 = a (1 − (T0 − T)/(2μP))^(1/3)`, `q = −μ [p(r; a) − 2p(r; c1) + p(r; c0)]`,
/// `shift = shift0 − 3μP/(8aG*) · [1 − (1 − (T0 − T)/(2μP))^(2/3)]`; reloading is its mirror image.
/// Source: Mindlin & Deresiewicz (1953); Johnson (1985), *Contact Mechanics*, §7.4. Limits as for [`CattaneoMindlin`].
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct MindlinDeresiewicz {
    peak: CattaneoMindlin,
}

/// The contact at one point of the loop.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct LoopPoint {
    turning: CattaneoMindlin,
    /// The load taken back since the turning point, halved: it answers as twice a first loading.
    half_back: CattaneoMindlin,
}

#[functions]
impl MindlinDeresiewicz {
    /// Loop of amplitude T0 [force], from the normal contact, the friction coefficient μ [-] and the shear modulus G* [pressure].
    ///
    /// # Errors
    /// When μ, G* or T0 is not positive and finite, or `T0 > μP`.
    pub fn new(
        hertz: &Hertz,
        friction: f64,
        shear_modulus: f64,
        amplitude: f64,
    ) -> Result<Self, AnalyticError> {
        let contact = CattaneoMindlin::unloaded(hertz, friction, shear_modulus)?;
        within("tangential amplitude", amplitude, amplitude > 0.0, "positive")?;
        Ok(Self { peak: contact.checked_under("tangential amplitude", amplitude)? })
    }

    /// The contact at the first peak.
    pub fn peak(&self) -> &CattaneoMindlin {
        &self.peak
    }

    /// The contact on a branch of the loop at tangential force T [force].
    ///
    /// # Errors
    /// When `|T| > T0`, or T is negative on loading.
    pub fn at(&self, branch: Branch, tangential_force: f64) -> Result<LoopPoint, AnalyticError> {
        let amplitude = self.peak.tangential_force;
        let turn = match branch {
            Branch::Loading => {
                within(
                    "tangential force on loading",
                    tangential_force,
                    tangential_force >= 0.0,
                    "zero or positive",
                )?;
                tangential_force
            }
            Branch::Unloading => amplitude,
            Branch::Reloading => -amplitude,
        };
        if tangential_force.abs() <= amplitude {
            Ok(LoopPoint {
                turning: self.peak.under(turn),
                half_back: self.peak.under((tangential_force - turn) / 2.0),
            })
        } else {
            Err(AnalyticError::TooLarge {
                name: "tangential force",
                value: tangential_force,
                reason: "the loop's amplitude is",
                limit: amplitude,
            })
        }
    }

    /// Energy dissipated by friction in one cycle [force x length]: the area of the loop.
    ///
    /// `(9/10)(μP)²/(aG*) · {1 − (1 − f)^(5/3) − (5f/6)[1 + (1 − f)^(2/3)]}`, `f = T0/μP`.
    #[shown]
    pub fn dissipated_energy_per_cycle(&self) -> f64 {
        4.0 * self.peak.dissipated_energy()
    }

    /// Energy ratio `W / (4 T0 shift0)` [-]: 0.2 at the onset of full slip, the partial-gross criterion of Fouvry et al. (1995).
    #[shown]
    pub fn energy_ratio(&self) -> f64 {
        self.dissipated_energy_per_cycle() / (4.0 * self.peak.tangential_force * self.peak.shift)
    }
}

#[functions]
impl LoopPoint {
    /// Tangential force T [force].
    #[shown]
    pub fn tangential_force(&self) -> f64 {
        self.turning.tangential_force + 2.0 * self.half_back.tangential_force
    }

    /// Tangential shift of the bodies [length].
    #[shown]
    pub fn shift(&self) -> f64 {
        self.turning.shift + 2.0 * self.half_back.shift
    }

    /// Radius of the disc that has not slipped since the last turning point [length].
    #[shown]
    pub fn stick_radius(&self) -> f64 {
        if self.half_back.tangential_force == 0.0 {
            self.turning.stick_radius
        } else {
            self.half_back.stick_radius
        }
    }

    /// Shear at distance `r` from the middle [pressure], along the force; zero outside the contact.
    #[shown]
    pub fn shear(&self, r: f64) -> f64 {
        self.turning.shear(r) + 2.0 * self.half_back.shear(r)
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::{Branch, MindlinDeresiewicz};
    use crate::analytic::cattaneo_mindlin::tests::STEEL_SHEAR_MODULUS;
    use crate::analytic::hertz::tests::steel_example;
    use crate::analytic::quadrature::integral;

    fn example(load_ratio: f64) -> MindlinDeresiewicz {
        MindlinDeresiewicz::new(&steel_example(), 0.1, STEEL_SHEAR_MODULUS, 10.0 * load_ratio).unwrap()
    }

    #[test]
    fn energy_per_cycle_matches_printed_values() {
        let scale = 100.0 / (steel_example().contact_radius * STEEL_SHEAR_MODULUS);
        for (f, energy) in
            [(0.5, 0.005_282_566_92), (0.754, 0.025_558_476_9), (0.92, 0.068_524_372_4), (1.0, 0.15)]
        {
            assert!((example(f).dissipated_energy_per_cycle() / scale - energy).abs() < 1e-10);
        }
        assert!((example(0.5).dissipated_energy_per_cycle() - 7.754_367_76e-5).abs() < 1e-13);
        assert!((example(0.92).dissipated_energy_per_cycle() - 1.005_880_649e-3).abs() < 1e-12);
        for (f, ratio) in [(0.5, 0.038_068), (0.754, 0.074_410), (0.92, 0.121_953)] {
            assert!((example(f).energy_ratio() - ratio).abs() < 1e-6);
        }
        assert!((example(1.0).energy_ratio() - 0.2).abs() < 1e-15);
    }

    #[test]
    fn shear_at_rest_after_the_first_peak_matches_printed_values() {
        let hertz = steel_example();
        let of = |f: f64| example(f).at(Branch::Unloading, 0.0).unwrap();
        for (f, stick, middle, at_stick) in [
            (0.92, 0.814_325_285, 0.019_776_4, -0.058_040_9),
            (0.754, 0.854_075_011_6, 0.008_156_7, -0.052_015_0),
        ] {
            let point = of(f);
            assert!((point.stick_radius() / hertz.contact_radius - stick).abs() < 1e-9);
            assert!((point.shear(0.0) / hertz.max_pressure - middle).abs() < 1e-7);
            assert!((point.shear(point.stick_radius()) / hertz.max_pressure - at_stick).abs() < 1e-7);
        }
        assert!((of(0.5).stick_radius() / hertz.contact_radius - 0.908_560_296_4).abs() < 1e-10);
    }

    #[test]
    fn energy_per_cycle_is_the_area_of_the_loop() {
        for f in [0.1, 0.5, 0.92] {
            let fretting = example(f);
            let opening = |force: f64| {
                let on = |branch| fretting.at(branch, force).unwrap().shift();
                on(Branch::Unloading) - on(Branch::Reloading)
            };
            let area = integral(-10.0 * f, 10.0 * f, opening);
            assert!((area / fretting.dissipated_energy_per_cycle() - 1.0).abs() < 1e-10);
        }
    }

    #[test]
    fn shear_carries_the_force_on_every_branch_and_the_loop_closes() {
        let fretting = example(0.8);
        let a = steel_example().contact_radius;
        for (branch, force) in [(Branch::Loading, 3.0), (Branch::Unloading, -2.0), (Branch::Reloading, 7.5)] {
            let point = fretting.at(branch, force).unwrap();
            let mut edges = [0.0, fretting.peak().stick_radius, point.stick_radius(), a];
            edges.sort_by(f64::total_cmp);
            let carried: f64 = edges
                .windows(2)
                .map(|ring| integral(ring[0], ring[1], |r| 2.0 * PI * r * point.shear(r)))
                .sum();
            assert!((carried - force).abs() < 1e-11 && (point.tangential_force() - force).abs() < 1e-14);
        }
        let closed = fretting.at(Branch::Reloading, 8.0).unwrap();
        assert!((closed.shift() / fretting.peak().shift - 1.0).abs() < 1e-14);
        assert!((closed.shear(0.3 * a) / fretting.peak().shear(0.3 * a) - 1.0).abs() < 1e-13);
    }

    #[test]
    fn forces_outside_the_loop_are_refused() {
        assert!(example(0.5).at(Branch::Unloading, 5.1).is_err());
        assert!(example(0.5).at(Branch::Loading, -1.0).is_err());
        assert!(example(0.5).at(Branch::Reloading, f64::NAN).is_err());
        assert!(MindlinDeresiewicz::new(&steel_example(), 0.1, 1.0, 0.0).is_err());
    }
}
