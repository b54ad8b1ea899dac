//! Where displacements at cell centres stop telling what a film does.

use crate::model::{Base, HalfSpace};

/// Whether the cells are too coarse for a nearly incompressible film on a (nearly) rigid base.
///
/// Such a film moves sideways out from under a uniformly loaded cell: its displacement lives at the cell's edges and the
/// centre, where displacements are taken, hardly moves. The coefficients are right, the discretisation is not: at a thickness
/// of a tenth of a cell the own coefficient is 1e-3 of the half-space's, and the film's true compliance `h^3` is not seen.
/// The remedy is a finer grid.
///
/// True when the coatings down to a base that is rigid, or stiffer than each of them by more than 1e3, have a total thickness
/// `h < 0.2 cell` and `1 - 2 nu < 10 (h/cell)^2` in all of them; the base may be a stiff coating. `cell` is the shorter side
/// of `spacing` \[length\].
pub fn cells_too_coarse_for_incompressible_film(half_space: &HalfSpace, spacing: [f64; 2]) -> bool {
    let half_space = half_space.simplified();
    let coatings = half_space.coatings();
    let cell = spacing[0].min(spacing[1]);
    let mut thickness = 0.0;
    let mut stiffest = 0.0_f64;
    let mut volume_change = 0.0_f64;
    for (index, coating) in coatings.iter().enumerate() {
        thickness += coating.thickness();
        stiffest = stiffest.max(coating.material().shear_modulus());
        volume_change = volume_change.max(1.0 - 2.0 * coating.material().poisson());
        let below = match (coatings.get(index + 1), half_space.base()) {
            (Some(next), _) => next.material().shear_modulus(),
            (None, Base::Elastic(material)) => material.shear_modulus(),
            (None, Base::Rigid) => f64::INFINITY,
        };
        // on a soft shear spring the film moves as a whole, and its centre with it
        if coating.interface().shear_compliance() * stiffest > thickness {
            return false;
        }
        let ratio = thickness / cell;
        if below > 1e3 * stiffest && ratio < 0.2 && volume_change < 10.0 * ratio * ratio {
            return true;
        }
    }
    false
}

#[cfg(test)]
mod tests {
    use super::super::samples::{on_springs, stack};
    use super::*;

    #[test]
    fn only_thin_incompressible_films_on_stiff_bases_are_refused() {
        let refused = |layers: &[(f64, f64, f64)], base| {
            cells_too_coarse_for_incompressible_film(&stack(layers, base), [1.0, 3.0])
        };
        assert!(refused(&[(1.0, 0.5, 0.1)], None));
        assert!(refused(&[(1.0, 0.4999, 0.1)], None));
        assert!(refused(&[(1.0, 0.5, 0.1)], Some((1e4, 0.3))));
        assert!(refused(&[(1.0, 0.5, 0.05), (2.0, 0.5, 0.05), (1e5, 0.3, 1.0)], Some((1e5, 0.2))));
        assert!(!refused(&[(1.0, 0.5, 0.3)], None)); // thick
        assert!(!refused(&[(1.0, 0.3, 0.1)], None)); // compressible
        assert!(!refused(&[(1.0, 0.5, 0.1)], Some((100.0, 0.3)))); // the base gives way
        assert!(!refused(&[], Some((1.0, 0.5))));
    }

    #[test]
    fn the_bounds_of_stiffness_thickness_and_volume_are_those_that_are_told() {
        let refused = |layers: &[(f64, f64, f64)], base, spacing| {
            cells_too_coarse_for_incompressible_film(&stack(layers, base), spacing)
        };
        for cell in [0.25, 4.0] {
            for spacing in [[cell, 3.0 * cell], [3.0 * cell, cell]] {
                let film = |poisson: f64, share: f64| [(2.0, poisson, share * cell)];
                // a fifth of the shorter side
                assert!(
                    refused(&film(0.5, 0.199), None, spacing) && !refused(&film(0.5, 0.201), None, spacing)
                );
                // 1 - 2 nu of 10 shares^2
                assert!(
                    refused(&film(0.451, 0.1), None, spacing) && !refused(&film(0.449, 0.1), None, spacing)
                );
                // a thousand times its modulus, at the same Poisson's ratio
                for (young, expected) in [(2001.0, true), (1999.0, false)] {
                    assert_eq!(refused(&film(0.5, 0.1), Some((young, 0.5)), spacing), expected);
                }
            }
        }
    }

    #[test]
    fn a_film_on_soft_shear_springs_moves_as_a_whole() {
        for modulus in [1.0, 4.0] {
            let film = stack(&[(3.0 * modulus, 0.5, 0.1)], None);
            // springs of ten times its shear modulus give as much as the film itself
            for (times, refused) in [(9.9, false), (10.1, true)] {
                let film = on_springs(&film, &[Some((None, Some(times * modulus)))]);
                assert_eq!(cells_too_coarse_for_incompressible_film(&film, [1.0, 1.0]), refused, "{times}");
            }
        }
    }
}
