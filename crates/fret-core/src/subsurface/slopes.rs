//! How measures of stress change with the stress.

use super::largest::Measure;
use super::tensor::StressTensor;

impl Measure {
    /// Its derivatives by the components of the stress, of which xy, xz and yz each stand in two places of the tensor; none where all vanish.
    #[must_use]
    pub fn slopes(self, stress: &StressTensor) -> StressTensor {
        let [_, _, _, xy, xz, yz] = stress.0;
        let along = |direction: &[f64; 3]| on_plane(direction);
        match self {
            Self::VonMises => {
                let equivalent = stress.von_mises();
                if equivalent == 0.0 {
                    return StressTensor::default();
                }
                let [xx, yy, zz, ..] = stress.deviator().0;
                StressTensor([xx, yy, zz, 2.0 * xy, 2.0 * xz, 2.0 * yz].map(|part| 1.5 * part / equivalent))
            }
            Self::Tresca => {
                let [first, _, last] = stress.principal().directions;
                along(&first).plus(-1.0, &along(&last))
            }
            Self::Tension => along(&stress.principal().directions[0]),
            Self::Hydrostatic => HYDROSTATIC,
            Self::InterfaceShear => {
                let size = xz.hypot(yz);
                let parts = if size > 0.0 { [xz / size, yz / size] } else { [0.0; 2] };
                StressTensor([0.0, 0.0, 0.0, 0.0, parts[0], parts[1]])
            }
            Self::Peel => StressTensor([0.0, 0.0, 1.0, 0.0, 0.0, 0.0]),
        }
    }
}

/// Derivatives of the mean of the normal stresses.
pub(super) const HYDROSTATIC: StressTensor = StressTensor([1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0, 0.0, 0.0, 0.0]);

/// Derivatives of the normal stress on a plane with unit normal `n`.
pub(super) fn on_plane([x, y, z]: &[f64; 3]) -> StressTensor {
    StressTensor([x * x, y * y, z * z, 2.0 * x * y, 2.0 * x * z, 2.0 * y * z])
}

impl StressTensor {
    /// The sum with another one, times a factor.
    #[must_use]
    pub(super) fn plus(self, factor: f64, other: &Self) -> Self {
        Self(std::array::from_fn(|part| self.0[part] + factor * other.0[part]))
    }

    /// Largest principal stress in the plane of the surface [pressure].
    pub fn tension_in_surface(&self) -> f64 {
        let [xx, yy, _, xy, ..] = self.0;
        0.5 * (xx + yy) + (0.5 * (xx - yy)).hypot(xy)
    }

    /// Its derivatives by the components; those of the mean where both principal stresses are one.
    #[must_use]
    pub fn slopes_of_tension_in_surface(&self) -> Self {
        let [xx, yy, _, xy, ..] = self.0;
        let half = 0.5 * (xx - yy);
        let size = half.hypot(xy);
        let [turned, sheared] = if size > 0.0 { [half / size, xy / size] } else { [0.0; 2] };
        Self([0.5 * (1.0 + turned), 0.5 * (1.0 - turned), 0.0, sheared, 0.0, 0.0])
    }

    /// The sum of the products of the components.
    pub fn times(&self, other: &Self) -> f64 {
        self.0.iter().zip(other.0).map(|(one, other)| one * other).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    /// Every measure against differences of its values in random stresses, one of them uniaxial. 1e-8: rounding of differences of 1e-6.
    #[test]
    fn slopes_are_those_of_the_measures() {
        let mut random = Random::seeded(6);
        for case in 0..20 {
            let mut stress = StressTensor(std::array::from_fn(|_| random.between(-1.0, 1.0)));
            if case == 0 {
                stress = StressTensor([0.0, 0.0, 3.0, 0.0, 0.0, 1.0]);
            }
            for measure in Measure::ALL {
                let slopes = measure.slopes(&stress);
                for part in 0..6 {
                    let at = |step: f64| {
                        let mut moved = stress;
                        moved.0[part] += step;
                        measure.of(&moved)
                    };
                    let expected = (at(1e-6) - at(-1e-6)) / 2e-6;
                    assert!(
                        (slopes.0[part] - expected).abs() < 1e-8,
                        "{measure:?} {part}: {slopes:?} {expected}"
                    );
                }
            }
            let slopes = stress.slopes_of_tension_in_surface();
            for part in 0..6 {
                let [up, down] = [1e-6, -1e-6].map(|step| {
                    let mut moved = stress;
                    moved.0[part] += step;
                    moved.tension_in_surface()
                });
                assert!((slopes.0[part] - (up - down) / 2e-6).abs() < 1e-8, "{part}: {slopes:?}");
            }
        }
        assert_eq!(Measure::VonMises.slopes(&StressTensor::default()), StressTensor::default());
    }
}
