//! Two elastic bodies, coated or not: what adds, what subtracts, and when pressure and shear do not act on each other.

use fret_core::case::Case;
use fret_core::kernel::{Components, InfluenceCoefficients, PairResponse, influence_coefficients};
use fret_core::model::{Base, Body, Coating, ContactPair, ElasticMaterial, HalfSpace};
use fret_core::plan::{Coupling, Plan};
use ndarray::Array2;

const CELLS: [usize; 2] = [24, 17];
const SPACING: [f64; 2] = [0.2, 0.35];

/// Coatings `(E, nu, h)` on a substrate, or on a rigid base.
fn body(layers: &[(f64, f64, f64)], substrate: Option<(f64, f64)>) -> Body {
    let material = |young, poisson| ElasticMaterial::new(young, poisson).unwrap();
    let coatings = layers.iter().map(|&(e, nu, h)| Coating::new(material(e, nu), h).unwrap()).collect();
    let base = substrate.map_or(Base::Rigid, |(e, nu)| Base::Elastic(material(e, nu)));
    Body::Elastic(HalfSpace::new(coatings, base).unwrap())
}

fn bodies() -> Vec<Body> {
    vec![
        body(&[], Some((1.0, 0.3))),
        body(&[], Some((3.0, 0.5))),
        body(&[(5.0, 0.2, 0.4)], Some((1.0, 0.4))),
        body(&[(0.01, 0.45, 0.3), (2.0, 0.1, 1.0)], Some((1.0, 0.3))),
        body(&[(100.0, 0.25, 0.1)], Some((1.0, 0.3))),
        body(&[(2.0, 0.3, 1.5), (0.5, 0.48, 0.5)], None),
    ]
}

fn coefficients(upper: &Body, lower: &Body) -> InfluenceCoefficients {
    let pair = ContactPair::new(upper.clone(), lower.clone()).unwrap();
    influence_coefficients(&pair, CELLS, SPACING, Components::ALL)
}

/// zz, xx, yy, xy, zx, zy.
fn arrays(coefficients: InfluenceCoefficients) -> [Array2<f64>; 6] {
    let InfluenceCoefficients { zz, xx, yy, xy, zx, zy } = coefficients;
    [zz, xx, yy, xy, zx, zy].map(Option::unwrap)
}

fn coupling_planned(upper: &str, lower: &str) -> Coupling {
    let text = format!(
        "[grid]\ncells = [16, 16]\nsize = [4.0, 4.0]\n[upper]\n{upper}\n[lower]\n{lower}\n[profile.sphere]\nradius = 100.0\n\
         [friction]\ncoefficient = 0.3\n[[load]]\nnormal_force = 1e-3\nincrements = 1\n"
    );
    Plan::new(Case::from_toml(&text, "case.toml").unwrap()).unwrap().coupling
}

#[test]
fn the_pair_is_the_sum_of_its_bodies_and_the_difference_of_their_couplings() {
    let bodies = bodies();
    let alone: Vec<_> = bodies.iter().map(|body| arrays(coefficients(&Body::Rigid, body))).collect();
    for (m, upper) in bodies.iter().enumerate() {
        for (n, lower) in bodies.iter().enumerate() {
            let together = arrays(coefficients(upper, lower));
            for component in 0..6 {
                let sign = if component < 4 { 1.0 } else { -1.0 };
                for (index, found) in together[component].indexed_iter() {
                    let expected = alone[n][component][index] + sign * alone[m][component][index];
                    let size: f64 =
                        [m, n].map(|body| alone[body][0][index].abs() + alone[body][1][index]).iter().sum();
                    // each of the three is good to 1e-14 of its body, and to 2e-13 under a film 100 times softer
                    let error = (found - expected).abs() / size;
                    assert!(error < 1e-12, "bodies {m} {n}, component {component}, {index:?}: {error:.1e}");
                }
            }
        }
    }
}

#[test]
fn exchanging_the_bodies_changes_the_sign_of_the_coupling_and_no_other_bit() {
    let bodies = bodies();
    for upper in &bodies {
        for lower in &bodies {
            let (one, other) = (arrays(coefficients(upper, lower)), arrays(coefficients(lower, upper)));
            for component in 0..4 {
                assert_eq!(one[component], other[component]);
            }
            for component in 4..6 {
                assert!(one[component].iter().zip(&other[component]).all(|(a, b)| *a == -b));
            }
        }
    }
}

#[test]
fn equal_bodies_do_not_couple_at_all() {
    for body in bodies() {
        let pair = ContactPair::new(body.clone(), body.clone()).unwrap();
        assert!(PairResponse::new(&pair).is_uncoupled());
        let [.., zx, zy] = arrays(coefficients(&body, &body));
        assert!(zx.iter().chain(&zy).all(|value| *value == 0.0));
    }
    let coated = "coatings = [{ thickness = 0.5, young = 3.0, poisson = 0.2 }]\nsubstrate = { young = 1.0, poisson = 0.3 }";
    let other = "coatings = [{ thickness = 0.5, young = 3.0, poisson = 0.25 }]\nsubstrate = { young = 1.0, poisson = 0.3 }";
    assert_eq!(coupling_planned(coated, coated), Coupling::Uncoupled);
    assert_eq!(coupling_planned(other, coated), Coupling::Coupled);
}

#[test]
fn equally_graded_bodies_do_not_couple() {
    let graded = "coatings = [{ thickness = 0.5, poisson = 0.2, gradient = { young = [3.0, 1.0], law = \"exponential\" } }]\n\
                  substrate = { young = 1.0, poisson = 0.3 }";
    assert_eq!(coupling_planned(graded, graded), Coupling::Uncoupled);
    assert_eq!(coupling_planned("rigid = true", graded), Coupling::Coupled);
}

#[test]
fn different_bodies_of_equal_dundurs_coupling_do_not_couple() {
    // (1 - 2 nu)/G is what counts: zero for incompressible half-spaces, and equal for the last two
    let young = |nu: f64| (1.0 + nu) * (1.0 - 2.0 * nu);
    for (upper, lower) in [
        ((1.0, 0.5), (7.0, 0.5)),
        ((young(0.1), 0.1), (young(0.4), 0.4)),
        ((young(0.3), 0.3), (young(-0.2), -0.2)),
    ] {
        let pair = ContactPair::new(body(&[], Some(upper)), body(&[], Some(lower))).unwrap();
        assert!(PairResponse::new(&pair).is_uncoupled(), "{upper:?} {lower:?}");
        let [zz, .., zx, _] = arrays(influence_coefficients(&pair, CELLS, SPACING, Components::ALL));
        // what is left is the rounding of the two couplings
        assert!(zx.iter().zip(&zz).all(|(zx, zz)| zx.abs() < 1e-15 * zz));
        let text = |(e, nu): (f64, f64)| format!("substrate = {{ young = {e:e}, poisson = {nu} }}");
        assert_eq!(coupling_planned(&text(upper), &text(lower)), Coupling::Uncoupled);
    }
    assert_eq!(
        coupling_planned("rigid = true", "substrate = { young = 1.0, poisson = 0.5 }"),
        Coupling::Uncoupled
    );
}
