//! What every compliance promises: linear, reciprocal, positive, the same wherever the load stands, equal to the plain sum.

use std::f64::consts::TAU;

use super::{DirectCompliance, OperatorSet, SpectralCompliance, SurfaceCompliance, SurfaceResponse};
use crate::kernel::samples::{Random, stack, under_rigid};
use crate::kernel::{
    Components, cells_too_coarse_for_incompressible_film, influence_coefficients, periodic_symbols,
};
use crate::model::{Body, ContactPair, TangentialField};

/// Tractions or displacements of all cells: z, x, y.
#[derive(Clone)]
struct Field {
    normal: Vec<f64>,
    tangential: TangentialField,
}

impl Field {
    fn zeros(len: usize) -> Self {
        Self { normal: vec![0.0; len], tangential: TangentialField::zeros(len) }
    }

    fn random(random: &mut Random, len: usize) -> Self {
        let mut part = || (0..len).map(|_| 2.0 * random.uniform() - 1.0).collect();
        Self { normal: part(), tangential: TangentialField { x: part(), y: part() } }
    }

    fn parts(&self) -> [&[f64]; 3] {
        [&self.normal, &self.tangential.x, &self.tangential.y]
    }

    fn parts_mut(&mut self) -> [&mut [f64]; 3] {
        [&mut self.normal, &mut self.tangential.x, &mut self.tangential.y]
    }

    fn dot(&self, other: &Self) -> f64 {
        let pairs = self.parts().into_iter().zip(other.parts());
        pairs.map(|(a, b)| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>()).sum()
    }

    fn largest(&self) -> f64 {
        self.parts().into_iter().flatten().fold(0.0, |largest, value| value.abs().max(largest))
    }

    fn distance(&self, other: &Self) -> f64 {
        let pairs = self.parts().into_iter().flatten().zip(other.parts().into_iter().flatten());
        pairs.fold(0.0, |largest, (a, b)| (a - b).abs().max(largest))
    }

    fn plus(&self, factor: f64, other: &Self) -> Self {
        let mut sum = self.clone();
        for (target, values) in sum.parts_mut().into_iter().zip(other.parts()) {
            for (target, value) in target.iter_mut().zip(values) {
                *target += factor * value;
            }
        }
        sum
    }
}

fn answer(compliance: &mut dyn SurfaceCompliance, traction: &Field) -> Field {
    let mut found = Field::zeros(traction.normal.len());
    // what stands in the output before must not matter
    found.parts_mut().into_iter().flatten().for_each(|value| *value = f64::NAN);
    compliance.full(traction.parts(), found.parts_mut());
    found
}

/// The promises, but for agreement with the plain sum.
fn conforms(compliance: &mut dyn SurfaceCompliance, random: &mut Random, name: &str) {
    let [nx, ny] = compliance.shape();
    let len = nx * ny;
    let [one, two] = [Field::random(random, len), Field::random(random, len)];
    let (from_one, from_two) = (answer(compliance, &one), answer(compliance, &two));
    // sums of len terms of either sign, each rounded; the transforms are better
    let rounding = 1e-13 * from_one.largest().max(from_two.largest());

    let mixed = answer(compliance, &one.plus(-0.7, &two));
    assert!(mixed.distance(&from_one.plus(-0.7, &from_two)) < rounding, "{name}: not linear");

    let (there, back) = (one.dot(&from_two), two.dot(&from_one));
    assert!((there - back).abs() < rounding * len as f64, "{name}: not reciprocal, {there} {back}");

    assert!(one.dot(&from_one) > 0.0 && two.dot(&from_two) > 0.0, "{name}: negative energy");

    let mut alone = Field::zeros(len);
    compliance.normal(&one.normal, &mut alone.normal);
    compliance.tangential(one.tangential.parts(), alone.tangential.parts_mut());
    let pressed = Field { tangential: TangentialField::zeros(len), ..one.clone() };
    let sheared = Field { normal: vec![0.0; len], ..one.clone() };
    let parts = Field {
        normal: answer(compliance, &pressed).normal,
        tangential: answer(compliance, &sheared).tangential,
    };
    assert!(alone.distance(&parts) < rounding, "{name}: parts differ from the whole");

    let (away, aside) = (2, 1);
    let moved = |field: &Field| {
        let mut moved = Field::zeros(len);
        for (target, values) in moved.parts_mut().into_iter().zip(field.parts()) {
            for i in away..nx {
                for j in aside..ny {
                    target[i * ny + j] = values[(i - away) * ny + j - aside];
                }
            }
        }
        moved
    };
    let mut inside = one.clone();
    for part in inside.parts_mut() {
        for (index, value) in part.iter_mut().enumerate() {
            if index / ny + away >= nx || index % ny + aside >= ny {
                *value = 0.0;
            }
        }
    }
    let expected = moved(&answer(compliance, &inside));
    let mut found = answer(compliance, &moved(&inside));
    for part in found.parts_mut() {
        for (index, value) in part.iter_mut().enumerate() {
            if index / ny < away || index % ny < aside {
                *value = 0.0;
            }
        }
    }
    assert!(found.distance(&expected) < rounding, "{name}: depends on the place");

    let own = compliance.self_influence();
    let mut point = Field::zeros(len);
    point.normal[0] = 1.0;
    assert!(
        (answer(compliance, &point).normal[0] - own.normal).abs() < 1e-13 * own.normal,
        "{name}: own normal"
    );
    let tangential = [1, 2].map(|component: usize| {
        let mut point = Field::zeros(len);
        point.parts_mut()[component][0] = 1.0;
        answer(compliance, &point).parts()[component][0]
    });
    let smaller = tangential[0].min(tangential[1]);
    assert!((smaller - own.tangential).abs() < 1e-13 * own.tangential, "{name}: own tangential");
}

/// Seeded pairs: soft and stiff, rigid bases, two coated bodies; the total thickness of a coating is one.
fn pairs() -> Vec<ContactPair> {
    let mut random = Random::seeded(11);
    let mut pairs: Vec<ContactPair> =
        (0..9).map(|case| under_rigid(random.half_space(4, 1e3, case % 3 == 0))).collect();
    for young in [1e4, 1e-4] {
        pairs.push(under_rigid(stack(&[(young, 0.3, 1.0)], Some((1.0, 0.4)))));
        pairs.push(under_rigid(stack(&[(young, 0.5, 0.5), (1.0, 0.2, 0.5)], None)));
    }
    for case in 0..6 {
        let upper = Body::Elastic(random.half_space(3, 1e2, case % 2 == 0));
        let lower = Body::Elastic(random.half_space(3, 1e2, false));
        pairs.push(ContactPair::new(upper, lower).unwrap());
    }
    pairs
}

const GRIDS: [([usize; 2], [f64; 2]); 4] =
    [([8, 8], [0.25, 0.25]), ([12, 7], [0.5, 0.2]), ([5, 16], [0.1, 0.3]), ([9, 9], [0.02, 0.02])];

fn too_coarse(pair: &ContactPair, spacing: [f64; 2]) -> bool {
    [pair.upper(), pair.lower()].into_iter().any(|body| match body {
        Body::Rigid => false,
        Body::Elastic(half_space) => cells_too_coarse_for_incompressible_film(half_space, spacing),
    })
}

#[test]
fn both_compliances_keep_every_promise() {
    let mut random = Random::seeded(12);
    for pair in pairs() {
        for (shape, spacing) in GRIDS {
            if too_coarse(&pair, spacing) {
                continue;
            }
            let coefficients = influence_coefficients(&pair, shape, spacing, Components::ALL);
            let all = OperatorSet {
                normal: true,
                tangential: true,
                full: true,
                normal_from_all: true,
                ..OperatorSet::default()
            };
            let fused = OperatorSet { full: true, ..OperatorSet::default() };
            for (name, wanted) in [("spectral", all), ("spectral, fused only", fused)] {
                let mut spectral =
                    SpectralCompliance::new(&SurfaceResponse::FreeSpace(coefficients.clone()), shape, wanted)
                        .unwrap();
                conforms(&mut spectral, &mut random, name);
            }
            let mut direct = DirectCompliance::new(coefficients, shape).unwrap();
            conforms(&mut direct, &mut random, "direct");
        }
    }
}

#[test]
fn the_fast_convolution_is_the_plain_sum() {
    let mut random = Random::seeded(13);
    for pair in pairs() {
        for (shape, spacing) in GRIDS {
            let coefficients = influence_coefficients(&pair, shape, spacing, Components::ALL);
            let wanted = OperatorSet { full: true, normal_from_all: true, ..OperatorSet::default() };
            let mut spectral =
                SpectralCompliance::new(&SurfaceResponse::FreeSpace(coefficients.clone()), shape, wanted)
                    .unwrap();
            let mut direct = DirectCompliance::new(coefficients, shape).unwrap();
            let traction = Field::random(&mut random, shape[0] * shape[1]);
            let (fast, plain) = (answer(&mut spectral, &traction), answer(&mut direct, &traction));
            for (fast, plain) in fast.parts().iter().zip(plain.parts()) {
                let largest = plain.iter().fold(0.0, |largest: f64, value| value.abs().max(largest));
                for (fast, plain) in fast.iter().zip(plain) {
                    // a component may be what little is left of contributions a hundred times larger
                    assert!(
                        (fast - plain).abs() < 1e-13 * largest,
                        "{pair:?}: {:e}",
                        (fast - plain) / largest
                    );
                }
            }
            let mut normal = vec![f64::NAN; traction.normal.len()];
            spectral.normal_from_all(&traction.normal, traction.tangential.parts(), &mut normal);
            let largest = plain.normal.iter().fold(0.0, |largest: f64, value| value.abs().max(largest));
            assert!(normal.iter().zip(&plain.normal).all(|(a, b)| (a - b).abs() < 1e-13 * largest));
        }
    }
}

#[test]
fn a_compliance_that_repeats_keeps_every_promise() {
    let mut random = Random::seeded(14);
    for pair in pairs() {
        for (shape, spacing) in GRIDS {
            let symbols = periodic_symbols(&pair, shape, spacing, Components::ALL, 0);
            let response = SurfaceResponse::Periodic(symbols.clone());
            let all = OperatorSet {
                normal: true,
                tangential: true,
                full: true,
                normal_from_all: true,
                ..OperatorSet::default()
            };
            let mut periodic = SpectralCompliance::new(&response, shape, all).unwrap();
            conforms(&mut periodic, &mut random, "periodic");

            // Against the plain sum over all waves: u = 1/N sum of C(k) cos(k (x - x')) p(x').
            let zz = symbols.zz.unwrap();
            let kernel = |i: usize, j: usize| {
                let mut sum = 0.0;
                for a in 0..shape[0] {
                    for b in 0..shape[1] {
                        let symbol = zz[[a.min(shape[0] - a), b.min(shape[1] - b)]];
                        let phase =
                            |n: usize, m: usize, count: usize| TAU * ((n * m) % count) as f64 / count as f64;
                        sum += symbol * (phase(a, i, shape[0]) + phase(b, j, shape[1])).cos();
                    }
                }
                sum / (shape[0] * shape[1]) as f64
            };
            let len = shape[0] * shape[1];
            let traction = Field::random(&mut random, len);
            let mut found = vec![0.0; len];
            periodic.normal(&traction.normal, &mut found);
            let own = kernel(0, 0);
            for cell in [0, len / 3, len - 1] {
                let at = [cell / shape[1], cell % shape[1]];
                let plain: f64 = (0..len)
                    .map(|other| {
                        let lag = [0, 1].map(|axis| {
                            let from = [other / shape[1], other % shape[1]][axis];
                            (at[axis] + shape[axis] - from) % shape[axis]
                        });
                        kernel(lag[0], lag[1]) * traction.normal[other]
                    })
                    .sum();
                // cosines good to an ulp, summed over all waves and cells
                assert!(
                    (found[cell] - plain).abs() < 1e-12 * own * (len as f64).sqrt(),
                    "{pair:?} {shape:?}"
                );
            }
        }
    }
}

/// Smallest pivot of the Cholesky factorisation over the largest diagonal; stops at the first that is not positive.
fn smallest_pivot(mut matrix: Vec<Vec<f64>>) -> f64 {
    let size = matrix.len();
    let largest = (0..size).fold(0.0, |largest: f64, n| largest.max(matrix[n][n]));
    let mut smallest = f64::INFINITY;
    for n in 0..size {
        let pivot = matrix[n][n];
        smallest = smallest.min(pivot / largest);
        if pivot <= 0.0 {
            break;
        }
        let row = matrix[n].clone();
        for lower in matrix.iter_mut().skip(n + 1) {
            let factor = lower[n] / pivot;
            for (value, above) in lower.iter_mut().zip(&row).skip(n) {
                *value -= factor * above;
            }
        }
    }
    smallest
}

#[test]
fn the_whole_operator_is_a_positive_definite_symmetric_matrix() {
    let (shape, len) = ([6, 5], 30);
    for pair in pairs() {
        for spacing in [[0.25, 0.25], [0.5, 0.2], [0.05, 0.05]] {
            if too_coarse(&pair, spacing) {
                continue;
            }
            let coefficients = influence_coefficients(&pair, shape, spacing, Components::ALL);
            let mut direct = DirectCompliance::new(coefficients, shape).unwrap();
            let mut columns = Vec::new();
            for component in 0..3 {
                for cell in 0..len {
                    let mut unit = Field::zeros(len);
                    unit.parts_mut()[component][cell] = 1.0;
                    columns.push(answer(&mut direct, &unit).parts().concat());
                }
            }
            let symmetric = (0..3 * len).all(|n| (0..n).all(|m| columns[n][m] == columns[m][n]));
            assert!(symmetric, "{pair:?}"); // every entry is one coefficient, whichever way it is read
            let pivot = smallest_pivot(columns);
            assert!(pivot > 1e-12, "{pair:?} {spacing:?}: {pivot:e}"); // far above the rounding of 90 rows
        }
    }
}

#[test]
fn coefficients_that_do_not_cover_the_box_are_refused() {
    let pair = under_rigid(stack(&[], Some((1.0, 0.3))));
    let coefficients = influence_coefficients(&pair, [4, 4], [1.0, 1.0], Components::NORMAL);
    assert!(DirectCompliance::new(coefficients.clone(), [4, 5]).is_err());
    assert!(DirectCompliance::new(coefficients, [3, 4]).is_ok());
}
