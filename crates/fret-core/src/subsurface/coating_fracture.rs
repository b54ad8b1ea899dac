//! Energy released by cracks of a thin coating: channelling through it, delamination from what lies below.

use serde::Serialize;

use crate::model::{Base, Coating, ElasticMaterial, HalfSpace};

/// Beuth's g without mismatch: `1.12152226^2`, since the mean over all depths of the energy of an edge crack is half of it.
const CHANNELLING_WITHOUT_MISMATCH: f64 = 1.257_812_18;
/// Phase of the interface crack below a film under tension without mismatch [degrees] (Hutchinson & Suo 1992, *Adv. Appl. Mech.* 29, 63).
const PHASE_WITHOUT_MISMATCH: f64 = 52.07;
/// Dundurs' parameters below this are no mismatch.
const NO_MISMATCH: f64 = 1e-9;

/// The outermost coating of a body as a film: what a case calls one coating, and what is one coating in everything else. A graded
/// coating is its sublayers, and layers of one material that are bonded to each other are one layer.
#[derive(Debug, Clone, PartialEq)]
pub struct Film {
    /// Its layers of the half-space, outermost first; of layers of one material one.
    parts: Vec<Part>,
    /// How many layers of the half-space it holds.
    layers: usize,
    /// Its thickness [length].
    thickness: f64,
    /// What lies below it.
    below: ElasticMaterial,
}

/// A part of a film: one material.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Part {
    material: ElasticMaterial,
    thickness: f64,
}

impl Part {
    /// Thickness over the modulus of plane strain, times the square of a stress: twice its energy per area.
    fn energy(&self, stress: f64) -> f64 {
        let Self { material, thickness } = self;
        let stiffness = material.young() / ((1.0 - material.poisson()) * (1.0 + material.poisson()));
        stress * stress * thickness / stiffness
    }
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
        let coatings = half_space.coatings();
        let mut parts: Vec<Part> = Vec::new();
        let (mut layers, mut thickness) = (0, 0.0);
        loop {
            let here = coatings.get(layers)?;
            if !here.interface().is_bonded() {
                return None;
            }
            let part = Part { material: *here.material(), thickness: here.thickness() };
            match parts.last_mut() {
                Some(above) if above.material == part.material => above.thickness += part.thickness,
                _ => parts.push(part),
            }
            (layers, thickness) = (layers + 1, thickness + here.thickness());
            let next = coatings.get(layers).map(Coating::material);
            if !here.continues() && next != Some(here.material()) {
                break;
            }
        }
        let below = match (coatings.get(layers), half_space.base()) {
            (Some(next), _) => *next.material(),
            (None, Base::Elastic(material)) => *material,
            (None, Base::Rigid) => return None,
        };
        Some(Self { parts, layers, thickness, below })
    }

    /// Its thickness [length].
    pub fn thickness(&self) -> f64 {
        self.thickness
    }

    /// Whether a layer of the half-space belongs to it; 0 is the outermost one.
    pub fn holds(&self, layer: usize) -> bool {
        layer < self.layers
    }

    /// Whether it is everywhere as stiff as what lies below it.
    pub fn is_matched(&self) -> bool {
        let is_none =
            |part: &Part| dundurs(&part.material, &self.below).iter().all(|value| value.abs() < NO_MISMATCH);
        self.parts.iter().all(is_none)
    }

    /// Energy released under a stress across the crack [pressure], tension positive: the mean over the thickness, uniform along the film
    /// over several thicknesses.
    ///
    /// Channelling `(pi/2) g s^2 int (1 - nu^2)/E dz`: Beuth (1992), *Int. J. Solids Struct.* 29, 1657. Delamination in the steady state
    /// `s^2 int (1 - nu^2)/(2 E) dz`, whatever the mismatch: Hutchinson & Suo (1992). The integrals go over the thickness: in a
    /// graded film the stress counts as the same at all depths.
    pub fn released(&self, stress: f64, factor: Option<f64>, phase: Option<f64>) -> Released {
        let factor = factor.or(self.is_matched().then_some(CHANNELLING_WITHOUT_MISMATCH));
        let phase = phase.or(self.is_matched().then_some(PHASE_WITHOUT_MISMATCH));
        let energy: f64 = self.parts.iter().map(|part| part.energy(stress)).sum();
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
    use crate::model::{GradedCoating, Interface, YoungGradient};
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
        let [alpha, beta] = dundurs(&stiff.parts[0].material, &stiff.below);
        assert!((alpha - 0.5).abs() < 1e-15 && (beta - 0.5 / 3.0).abs() < 1e-15);
        let unknown = stiff.released(3.0, None, None);
        assert_eq!((unknown.channelling, unknown.phase), (None, None));
        let known = stiff.released(3.0, Some(2.0), Some(54.0));
        assert!(known.channelling.unwrap() > 0.0 && known.phase == Some(54.0));
        assert!(film(1.0, Base::Rigid).is_none());
    }

    /// A modulus that falls linearly from 4 to 1 over h = 5.5 under a stress of 500: `s^2 (1 - nu^2)/2 int dz/E = s^2 (1 - nu^2) h ln 4 / 6`.
    /// Sublayers with the modulus at their middles are the midpoint rule, of order two.
    #[test]
    fn a_graded_coating_is_one_film() {
        let (h, nu, stress) = (5.5, 0.3, 500.0);
        let exact = stress * stress * (1.0 - nu * nu) * h * 4.0_f64.ln() / 6.0;
        let young = YoungGradient::Linear { top: 4.0, bottom: 1.0 };
        let coating = GradedCoating::new(young, nu, h).unwrap();
        let below = ElasticMaterial::new(1.0, nu).unwrap();
        let error = |count: usize| {
            let layers = coating.sublayers(count).unwrap();
            let film = Film::outermost(&HalfSpace::new(layers, Base::Elastic(below)).unwrap()).unwrap();
            assert!((film.thickness() / h - 1.0).abs() < 1e-14);
            assert!(film.holds(count - 1) && !film.holds(count) && !film.is_matched());
            let found = film.released(stress, Some(2.0), Some(54.0));
            let ratio = found.channelling.unwrap() / found.delamination;
            assert!((ratio - 2.0 * PI).abs() < 1e-12); // (pi/2) g over 1/2
            found.delamination / exact - 1.0
        };
        let [coarse, fine] = [40, 80].map(error);
        assert!(coarse.abs() < 1e-3 && (coarse / fine - 4.0).abs() < 0.1, "{coarse} {fine}");
        // below another coating it stays apart from it, and a coating with a film of its own is not part of it
        let mut layers = vec![Coating::new(below, 0.5).unwrap()];
        layers.extend(coating.sublayers(7).unwrap());
        layers.extend(coating.sublayers(3).unwrap());
        let stack = |layers: &[Coating]| HalfSpace::new(layers.to_vec(), Base::Elastic(below)).unwrap();
        assert!(!Film::outermost(&stack(&layers)).unwrap().holds(1));
        let upper = Film::outermost(&stack(&layers[1..])).unwrap();
        assert!(upper.holds(6) && !upper.holds(7));
    }

    /// A film cut into layers of its own material is the film; on a substrate of another material it has mismatch however thin the layer
    /// of its own material below it is.
    #[test]
    fn layers_of_one_material_are_one_film() {
        let [stiff, soft] = [300.0, 100.0].map(|young| ElasticMaterial::new(young, 0.25).unwrap());
        let film = |thicknesses: &[f64], base: ElasticMaterial, lowest: Interface| {
            let mut layers: Vec<Coating> =
                thicknesses.iter().map(|thickness| Coating::new(stiff, *thickness).unwrap()).collect();
            let last = layers.pop().unwrap();
            layers.push(last.on(lowest));
            Film::outermost(&HalfSpace::new(layers, Base::Elastic(base)).unwrap())
        };
        let told = |thicknesses: &[f64], base| {
            film(thicknesses, base, Interface::BONDED).unwrap().released(3.0, None, None)
        };
        let whole = told(&[2.0], soft);
        assert_eq!(told(&[1.0, 1.0], soft), whole);
        assert_eq!((whole.channelling, whole.phase), (None, None));
        assert_eq!(told(&[1.75, 0.25], soft), whole);
        assert_eq!(told(&[1.0, 1.0], stiff), told(&[2.0], stiff));
        assert!(told(&[1.0, 1.0], stiff).channelling.is_some());
        // on springs neither the film nor its lower half is bonded
        let springs = Interface::springs(Some(5.0), None).unwrap();
        assert!(film(&[2.0], soft, springs).is_none() && film(&[1.0, 1.0], soft, springs).is_none());
    }
}
