//! The limit of friction: which part of prescribed forces and moments it can carry at all, at a given pressure. By duality: for any
//! rigid motion `m`, shear within its bounds does at most the work `sum b |m|` on it; forces that would do more have no equilibrium.

use super::rigid_motions::RigidMotions;

/// Tangential forces that are nearer to the limit of friction than this times the tolerance slide: what sticks is less than a residual tells
/// from nothing, and the shift is rounding.
const OF_TOLERANCE: f64 = 0.1;

/// The fraction of the limit of friction from which on a contact is taken to slide as a whole, under a tolerance of the residual.
pub fn sliding_fraction(tolerance: f64) -> f64 {
    1.0 - OF_TOLERANCE * tolerance
}

/// Iterations of the search for the motion; each one gives a bound, later ones better ones.
const MOST_ITERATIONS: usize = 60;

/// How a contact slides under prescribed forces and moments.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sliding {
    /// The fraction of them that friction carries, from above; infinite where nothing is prescribed [-].
    pub fraction: f64,
    /// The motion that tells so, up to a factor.
    pub motion: [f64; 3],
}

/// How a contact slides under the prescribed `resultant` (sums of shear times mode [pressure]) with these bounds. Packed over a contact.
///
/// The least of `sum b |m| / (m . R)` over the motions: iteratively reweighted least squares (Weiszfeld).
pub fn sliding(bound: &[f64], motions: &RigidMotions, resultant: [f64; 3]) -> Sliding {
    let resultant = motions.loads.only_by_force(resultant);
    let mut motion = resultant;
    let mut least = Sliding { fraction: f64::INFINITY, motion };
    for _ in 0..MOST_ITERATIONS {
        let work: f64 = (0..3).map(|mode| motion[mode] * resultant[mode]).sum();
        if !(work > 0.0) {
            break;
        }
        let (mut dissipated, mut gram) = (0.0, [0.0; 6]);
        let sizes: Vec<f64> = (0..bound.len())
            .map(|cell| {
                let [x, y] = motions.at(motion, cell);
                x.hypot(y)
            })
            .collect();
        let largest = sizes.iter().copied().fold(0.0, f64::max);
        for (cell, size) in sizes.iter().enumerate() {
            dissipated += bound[cell] * size;
            let weight = bound[cell] / size.max(1e-9 * largest);
            let [x, y] = if motions.rotates { motions.rotation.at(cell) } else { [0.0; 2] };
            for (entry, term) in gram.iter_mut().zip([1.0, 1.0, x * x + y * y, 0.0, x, y]) {
                *entry += weight * term;
            }
        }
        if dissipated / work < least.fraction {
            least = Sliding { fraction: dissipated / work, motion };
        }
        if !motions.loads.by_force[2] {
            break; // without rotation all cells slide along the force
        }
        motion = motions.solve(gram, resultant);
    }
    least
}

#[cfg(test)]
mod tests {
    use super::super::super::contact_set::ContactSet;
    use super::super::super::prescribed::TangentialLoads;
    use super::super::rigid_motions::CellPositions;
    use super::*;

    /// A square of cells under one bound.
    fn square(by_force: [bool; 3]) -> (Vec<f64>, RigidMotions, f64) {
        let centres: Vec<f64> = (0..40).map(|index| f64::from(index) - 19.5).collect();
        let positions = CellPositions::new(centres.clone(), centres, true);
        let loads = TangentialLoads { by_force, ..TangentialLoads::default() };
        let disc =
            ContactSet::of(1600, |cell| ((cell / 40) as f64 - 19.5).hypot((cell % 40) as f64 - 19.5) < 19.0);
        (vec![2.0; disc.len()], positions.motions_of(&disc, loads), positions.length)
    }

    #[test]
    fn a_force_is_carried_up_to_the_sum_of_the_bounds() {
        let (bound, motions, _) = square([true, true, false]);
        let all = 2.0 * bound.len() as f64;
        let fraction = sliding(&bound, &motions, [0.6 * 2.0 * all, 0.8 * 2.0 * all, 0.0]).fraction;
        assert!((fraction - 0.5).abs() < 1e-12, "{fraction}");
        assert_eq!(sliding(&bound, &motions, [0.0; 3]).fraction, f64::INFINITY);
    }

    /// The moment that turns a disc is the sum of bounds times distances; a force beside it lessens what is left.
    #[test]
    fn a_moment_is_carried_up_to_the_sum_of_bounds_times_distances() {
        let (bound, motions, length) = square([true, true, true]);
        let arms: f64 = (0..bound.len()).map(|cell| motions.rotation.at(cell)).map(|[x, y]| x.hypot(y)).sum();
        let fraction = sliding(&bound, &motions, [0.0, 0.0, 4.0 * arms]).fraction;
        assert!((fraction - 0.5).abs() < 1e-12, "{fraction} {length}");
        let with_force = sliding(&bound, &motions, [bound.len() as f64, 0.0, 4.0 * arms]).fraction;
        assert!(with_force < 0.5 && with_force > 0.3, "{with_force}");
    }

    /// Sliding with any rigid motion `m`, shear has the resultants `sum b m / |m|`: more than these, in their ratio, is carried by no
    /// shear, and less by some. Bounds differ from cell to cell, and all three motions act.
    #[test]
    fn resultants_of_a_sliding_contact_are_just_carried() {
        let (mut bound, motions, _) = square([true, true, true]);
        for (cell, bound) in bound.iter_mut().enumerate() {
            *bound = 1.0 + (cell % 11) as f64 / 5.0;
        }
        for motion in [[1.0, 0.4, 0.6], [-0.2, 0.3, 1.0], [0.1, -1.0, -0.4]] {
            let mut resultant = [0.0; 3];
            for (cell, bound) in bound.iter().enumerate() {
                let ([x, y], [a, b]) = (motions.at(motion, cell), motions.rotation.at(cell));
                let share = bound / x.hypot(y);
                resultant = [
                    resultant[0] + share * x,
                    resultant[1] + share * y,
                    resultant[2] + share * (x * a + y * b),
                ];
            }
            let fraction = sliding(&bound, &motions, resultant.map(|part| 2.5 * part)).fraction;
            // A bound from above; sixty iterations of a method of first order leave less than this.
            assert!(fraction > 0.4 - 1e-12 && fraction < 0.4 + 1e-7, "{motion:?}: {:e}", fraction - 0.4);
        }
    }

    /// A cell in the centre of rotation carries nothing of a moment and does no harm.
    #[test]
    fn a_cell_at_the_centre_of_rotation_carries_no_moment() {
        let positions = CellPositions::new(vec![-1.0, 0.0, 1.0], vec![0.0], true);
        let loads = TangentialLoads { by_force: [true; 3], ..TangentialLoads::default() };
        let motions = positions.motions_of(&ContactSet::of(3, |_| true), loads);
        let Sliding { fraction, .. } = sliding(&[2.0, 7.0, 2.0], &motions, [0.0, 0.0, 8.0]);
        assert!((fraction - 0.5).abs() < 1e-12, "{fraction}");
    }
}
