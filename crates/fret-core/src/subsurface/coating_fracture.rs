//! Energy released by cracks of a thin coating: channelling through it, delamination from what lies below.

use serde::Serialize;

use crate::model::{Base, ElasticMaterial, HalfSpace};

/// Beuth's g without mismatch: `1.12152226^2`, since the mean over all depths of the energy of an edge crack is half of it.
const CHANNELLING_WITHOUT_MISMATCH: f64 = 1.257_812_18;
/// Phase of the interface crack below a film under tension without mismatch [degrees] (Hutchinson & Suo 1992, *Adv. Appl. Mech.* 29, 63).
const PHASE_WITHOUT_MISMATCH: f64 = 52.07;
/// Dundurs' parameters below this are no mismatch.
const NO_MISMATCH: f64 = 1e-9;

/// The outermost coating of a body as a film: one uniform layer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Film {
    /// Its material.
    pub material: ElasticMaterial,
    /// Its thickness [length].
    pub thickness: f64,
    /// Dundurs' parameters alpha and beta with what lies below it; positive alpha where the film is stiffer.
    pub dundurs: [f64; 2],
}

/// Energy released per area by cracks of the film [force/length].
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Released {
    /// By a channelling crack; 0 in compression; `None` where Beuth's g is not known: with mismatch the case gives it.
    pub channelling: Option<f64>,
    /// By a straight delamination front far from the edge it started from.
    pub delamination: f64,
    /// Phase angle of the delamination [degrees], 0 opening, 90 sliding; of a film under compression 90, since its crack is closed. `None`
    /// where it is not known: with mismatch the case gives it.
    pub phase: Option<f64>,
}

impl Film {
    /// The outermost coating; `None` without a coating, where the base below it is rigid, or where springs bond it: the energies below are
    /// those of a bonded film.
    pub fn outermost(half_space: &HalfSpace) -> Option<Self> {
        let coating = half_space.coatings().first().filter(|coating| coating.interface().is_bonded())?;
        let below = match (half_space.coatings().get(1), half_space.base()) {
            (Some(next), _) => next.material(),
            (None, Base::Elastic(material)) => material,
            (None, Base::Rigid) => return None,
        };
        let material = *coating.material();
        Some(Self { material, thickness: coating.thickness(), dundurs: dundurs(&material, below) })
    }

    /// Whether it is as stiff as what lies below it.
    pub fn is_matched(&self) -> bool {
        self.dundurs.iter().all(|value| value.abs() < NO_MISMATCH)
    }

    /// Energy released under a stress across the crack [pressure], tension positive: the mean over the thickness, uniform along the film
    /// over several thicknesses.
    ///
    /// Channelling `(pi/2) g s^2 h (1 - nu^2)/E`: Beuth (1992), *Int. J. Solids Struct.* 29, 1657. Delamination in the steady state
    /// `s^2 h (1 - nu^2)/(2 E)`, whatever the mismatch: Hutchinson & Suo (1992).
    pub fn released(&self, stress: f64, factor: Option<f64>, phase: Option<f64>) -> Released {
        let factor = factor.or(self.is_matched().then_some(CHANNELLING_WITHOUT_MISMATCH));
        let phase = phase.or(self.is_matched().then_some(PHASE_WITHOUT_MISMATCH));
        let stiffness =
            self.material.young() / ((1.0 - self.material.poisson()) * (1.0 + self.material.poisson()));
        let energy = stress * stress * self.thickness / stiffness;
        Released {
            channelling: factor
                .map(|g| if stress > 0.0 { std::f64::consts::FRAC_PI_2 * g * energy } else { 0.0 }),
            delamination: 0.5 * energy,
            phase: if stress > 0.0 { phase } else { Some(90.0) },
        }
    }
}

/// Dundurs' parameters of two materials in plane strain.
fn dundurs(upper: &ElasticMaterial, lower: &ElasticMaterial) -> [f64; 2] {
    let kolosov = |material: &ElasticMaterial| 3.0 - 4.0 * material.poisson();
    let [up, low] = [upper.shear_modulus(), lower.shear_modulus()];
    let sum = up * (kolosov(lower) + 1.0) + low * (kolosov(upper) + 1.0);
    let alpha = up * (kolosov(lower) + 1.0) - low * (kolosov(upper) + 1.0);
    let beta = up * (kolosov(lower) - 1.0) - low * (kolosov(upper) - 1.0);
    [alpha / sum, beta / sum]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Coating;
    use crate::subsurface::edge_crack::{EdgeCrack, stress_intensity};
    use std::f64::consts::PI;

    fn film(young: f64, base: Base) -> Option<Film> {
        let coating = Coating::new(ElasticMaterial::new(young, 0.25).unwrap(), 2.0).unwrap();
        Film::outermost(&HalfSpace::new(vec![coating], base).unwrap())
    }

    /// Beuth (1992): g(0, 0) = 1.258. The energy of a channelling crack is the mean of that of an edge crack over the depths it cuts
    /// through: by the program's own edge crack, whose factors have their own references.
    #[test]
    fn channelling_without_mismatch_is_the_mean_of_edge_cracks() {
        let matched = film(100.0, Base::Elastic(ElasticMaterial::new(100.0, 0.25).unwrap())).unwrap();
        assert!(matched.is_matched());
        let found = matched.released(3.0, None, None);
        let modulus = 100.0 / (1.0 - 0.0625);
        let crack = EdgeCrack::new(0.0).unwrap();
        let steps = 1000;
        let mean: f64 = (0..steps)
            .map(|n| {
                let depth = 2.0 * (f64::from(n) + 0.5) / f64::from(steps);
                let points = crack.points(depth, &[]);
                let [k, _] = stress_intensity(&points, points.iter().map(|_| [3.0, 0.0]));
                k * k / modulus / f64::from(steps)
            })
            .sum();
        assert!((found.channelling.unwrap() / mean - 1.0).abs() < 1e-5);
        let g = found.channelling.unwrap() / (0.5 * PI * 9.0 * 2.0 / modulus);
        assert!((g - 1.258).abs() < 5e-4);
        assert!((found.delamination - 9.0 * 2.0 / (2.0 * modulus)).abs() < 1e-12);
        assert_eq!(found.phase, Some(52.07));
        let pressed = matched.released(-3.0, None, None);
        assert_eq!((pressed.channelling, pressed.phase), (Some(0.0), Some(90.0)));
        assert_eq!(pressed.delamination, found.delamination);
    }

    #[test]
    fn with_mismatch_the_factors_are_asked_for() {
        let stiff = film(300.0, Base::Elastic(ElasticMaterial::new(100.0, 0.25).unwrap())).unwrap();
        // equal Poisson's ratios: alpha = (E1 - E2)/(E1 + E2), beta = alpha (1 - 2 nu)/(2 (1 - nu))
        assert!((stiff.dundurs[0] - 0.5).abs() < 1e-15 && (stiff.dundurs[1] - 0.5 / 3.0).abs() < 1e-15);
        let unknown = stiff.released(3.0, None, None);
        assert_eq!((unknown.channelling, unknown.phase), (None, None));
        let known = stiff.released(3.0, Some(2.0), Some(54.0));
        assert!(known.channelling.unwrap() > 0.0 && known.phase == Some(54.0));
        assert!(film(1.0, Base::Rigid).is_none());
    }
}
