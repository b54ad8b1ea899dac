//! How the response of a pair changes with a constant of a layer.

use super::case_number::{BodyNumber, LayerNumber};
use crate::compliance::SurfaceResponse;
use crate::kernel::{
    Components, LayerChanges, ResponseChange, coefficients_by, line_coefficients_by, symbols_by,
};
use crate::model::{Body, HalfSpace};
use crate::plan::{Coupling, Plan};

/// Derivative of the response by a constant of one of the bodies of a plan, over so many cells; of one that repeats over its period.
pub(super) fn change_of_response(plan: &Plan, number: BodyNumber, cells: [usize; 2]) -> SurfaceResponse {
    let wanted = match plan.coupling {
        Coupling::Frictionless => Components::NORMAL,
        Coupling::Uncoupled => Components { normal: true, tangential: true, coupling: false },
        Coupling::Coupled => Components::ALL,
    };
    let bodies = &plan.case.bodies;
    let body = if number.of_upper { bodies.upper() } else { bodies.lower() };
    let changes = match body {
        Body::Rigid => Vec::new(),
        Body::Elastic(half_space) => changes_of(half_space, number),
    };
    let changes: [&[LayerChanges]; 2] = if number.of_upper { [&[], &changes] } else { [&changes, &[]] };
    let spacing = plan.grid.spacing();
    if plan.case.is_line() {
        let ([width, _], [strips, _]) = (plan.grid.size(), cells);
        let datum = plan.datum.unwrap_or(width);
        return SurfaceResponse::FreeSpace(line_coefficients_by(
            bodies, changes, strips, spacing[0], datum, wanted,
        ));
    }
    if plan.case.periodic.is_both() {
        SurfaceResponse::Periodic(symbols_by(bodies, changes, plan.case.cells, spacing, wanted))
    } else {
        let change = ResponseChange::new(bodies, changes);
        SurfaceResponse::FreeSpace(coefficients_by(&change, cells, spacing, wanted))
    }
}

/// Derivatives of the constants of all layers of a body by one of them, from the surface down, those of the substrate last.
pub(super) fn changes_of(half_space: &HalfSpace, number: BodyNumber) -> Vec<LayerChanges> {
    let coatings = half_space.coatings();
    let mut changes = vec![LayerChanges::default(); coatings.len() + 1];
    let index = number.coating.unwrap_or(coatings.len());
    // Compliance is the inverse of the stiffness that a case gives.
    let by_stiffness = |compliance: f64| -compliance * compliance;
    let interface = coatings.get(index).map(crate::model::Coating::interface);
    let change = &mut changes[index];
    match number.number {
        LayerNumber::Young => change.young = 1.0,
        LayerNumber::Poisson => change.poisson = 1.0,
        LayerNumber::Thickness => change.thickness = 1.0,
        LayerNumber::NormalStiffness => {
            change.normal = interface.map_or(0.0, |springs| by_stiffness(springs.normal_compliance()));
        }
        LayerNumber::ShearStiffness => {
            change.shear = interface.map_or(0.0, |springs| by_stiffness(springs.shear_compliance()));
        }
    }
    changes
}

#[cfg(test)]
mod tests {
    use ndarray::Array2;

    use super::*;
    use crate::kernel::{InfluenceCoefficients, influence_coefficients, line_coefficients};
    use crate::model::{Base, Coating, ContactPair, ElasticMaterial, Interface};
    use crate::random::Random;

    /// A coated body on springs under an uncoated one, with its numbers times factors: of both layers Young's modulus, Poisson's ratio, thickness;
    /// stiffnesses of the springs; modulus and ratio of the substrate, and of the upper body.
    fn pair(numbers: &[f64; 12]) -> ContactPair {
        let [e1, n1, h1, e2, n2, h2, normal, shear, e3, n3, e4, n4] = *numbers;
        let material = |young, poisson| ElasticMaterial::new(young, poisson).unwrap();
        let springs = Interface::springs(Some(normal), Some(shear)).unwrap();
        let coatings = vec![
            Coating::new(material(e1, n1), h1).unwrap(),
            Coating::new(material(e2, n2), h2).unwrap().on(springs),
        ];
        let lower = HalfSpace::new(coatings, Base::Elastic(material(e3, n3))).unwrap();
        ContactPair::new(Body::Elastic(HalfSpace::homogeneous(material(e4, n4))), Body::Elastic(lower))
            .unwrap()
    }

    fn number(index: usize) -> BodyNumber {
        use LayerNumber::{NormalStiffness, Poisson, ShearStiffness, Thickness, Young};
        let numbers = [
            (Some(0), Young),
            (Some(0), Poisson),
            (Some(0), Thickness),
            (Some(1), Young),
            (Some(1), Poisson),
            (Some(1), Thickness),
            (Some(1), NormalStiffness),
            (Some(1), ShearStiffness),
            (None, Young),
            (None, Poisson),
            (None, Young),
            (None, Poisson),
        ];
        BodyNumber { of_upper: index >= 10, coating: numbers[index].0, number: numbers[index].1 }
    }

    fn arrays(c: &InfluenceCoefficients) -> [&Array2<f64>; 6] {
        [&c.zz, &c.xx, &c.yy, &c.xy, &c.zx, &c.zy].map(|array| array.as_ref().unwrap())
    }

    /// Those of line contacts, relative to a datum in a layer or in the substrate, of stacks and of half-spaces, as above.
    #[test]
    fn coefficients_of_lines_change_as_their_differences_say() {
        let mut random = Random::seeded(18);
        for datum in [0.2, 40.0] {
            let mut layer =
                || [random.log_uniform(0.1, 10.0), random.between(0.1, 0.45), random.log_uniform(0.3, 3.0)];
            let [[e1, n1, h1], [e2, n2, h2], [e3, n3, h3], [e4, n4, h4]] =
                [layer(), layer(), layer(), layer()];
            let numbers = [e1, n1, h1, e2, n2, h2, h3, h4, e3, n3, e4, n4];
            let half_spaces = |numbers: &[f64; 12]| {
                let of = |at: usize| ElasticMaterial::new(numbers[at], numbers[at + 1]).unwrap();
                let [lower, upper] = [8, 10].map(|at| Body::Elastic(HalfSpace::homogeneous(of(at))));
                ContactPair::new(upper, lower).unwrap()
            };
            for (made, first) in [(&pair as &dyn Fn(&[f64; 12]) -> ContactPair, 0), (&half_spaces, 8)] {
                let at = |index: usize, factor: f64| {
                    let mut moved = numbers;
                    moved[index] *= 1.0 + factor;
                    line_coefficients(&made(&moved), 12, 0.5, datum, Components::ALL)
                };
                let here = made(&numbers);
                for index in first..numbers.len() {
                    let number = number(index);
                    let body = if number.of_upper { here.upper() } else { here.lower() };
                    let Body::Elastic(body) = body else { unreachable!() };
                    let changes = changes_of(body, number);
                    let changes: [&[LayerChanges]; 2] =
                        if number.of_upper { [&[], &changes] } else { [&changes, &[]] };
                    let found = line_coefficients_by(&here, changes, 12, 0.5, datum, Components::ALL);
                    let [a, b, c, d] = [1e-3, -1e-3, 2e-3, -2e-3].map(|step| at(index, step));
                    for component in 0..6 {
                        let of = |c: &InfluenceCoefficients| arrays(c)[component].clone();
                        let expected = ((of(&a) - of(&b)) * 8.0 - (of(&c) - of(&d))) / 12e-3;
                        // A shallow datum leaves little of the coefficients, not of their derivatives.
                        let own = arrays(&at(index, 0.0))[0][[0, 0]].abs();
                        let size = expected.iter().fold(own, |most, by| most.max(by.abs()));
                        for (found, expected) in of(&found).iter().zip(&expected) {
                            let off = (found * numbers[index] - expected).abs() / size;
                            assert!(off < 1e-9, "{index}, {component}: {found} {expected} {off:.1e}");
                        }
                    }
                }
            }
        }
    }

    /// Influence coefficients of random stacks by all their constants, against differences of fourth order. 1e-9 of the largest coefficient: what
    /// rounding of 1e-14 leaves at steps of 1e-3 is 1e-11, what the order leaves 1e-12, near a ratio of 1/2 more.
    #[test]
    fn coefficients_change_as_their_differences_say() {
        let mut random = Random::seeded(17);
        for _ in 0..4 {
            let mut layer =
                || [random.log_uniform(0.1, 10.0), random.between(0.1, 0.45), random.log_uniform(0.1, 3.0)];
            let [[e1, n1, h1], [e2, n2, h2], [e3, n3, h3], [e4, n4, h4]] =
                [layer(), layer(), layer(), layer()];
            let numbers = [e1, n1, h1, e2, n2, h2, h3, h4, e3, n3, e4, n4];
            let at = |index: usize, factor: f64| {
                let mut moved = numbers;
                moved[index] *= 1.0 + factor;
                influence_coefficients(&pair(&moved), [12, 9], [0.5, 0.7], Components::ALL)
            };
            let here = pair(&numbers);
            for index in 0..numbers.len() {
                let number = number(index);
                let body = if number.of_upper { here.upper() } else { here.lower() };
                let Body::Elastic(body) = body else { unreachable!() };
                let changes = changes_of(body, number);
                let changes: [&[LayerChanges]; 2] =
                    if number.of_upper { [&[], &changes] } else { [&changes, &[]] };
                let change = ResponseChange::new(&here, changes);
                let found = coefficients_by(&change, [12, 9], [0.5, 0.7], Components::ALL);
                let [a, b, c, d] = [1e-3, -1e-3, 2e-3, -2e-3].map(|step| at(index, step));
                for component in 0..6 {
                    let of = |c: &InfluenceCoefficients| arrays(c)[component].clone();
                    let expected = ((of(&a) - of(&b)) * 8.0 - (of(&c) - of(&d))) / 12e-3;
                    let size = arrays(&at(index, 0.0))[0][[0, 0]];
                    for (found, expected) in of(&found).iter().zip(&expected) {
                        let off = (found * numbers[index] - expected).abs() / size;
                        assert!(off < 1e-9, "{index}, {component}: {found} {expected} {off:.1e}");
                    }
                }
            }
        }
    }
}
