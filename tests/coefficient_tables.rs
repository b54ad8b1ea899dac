//! Influence coefficients and frequency responses against tables made by other means, and on random stacks: the errors are
//! printed (`cargo test -p fret-validation coefficient_tables -- --nocapture`).

use fret_core::kernel::{Components, FrequencyResponse, InfluenceCoefficients, influence_coefficients};
use fret_core::model::{Base, Body, Coating, ContactPair, ElasticMaterial, HalfSpace};
use fret_validation::random::Random;
use ndarray::Array2;
use serde::Deserialize;

#[derive(Deserialize)]
struct Table<Row> {
    rows: Vec<Row>,
}

/// `(E, nu, h)`.
type Layer = (f64, f64, f64);

fn stack(layers: &[Layer], substrate: Option<(f64, f64)>) -> HalfSpace {
    let material = |young, poisson| ElasticMaterial::new(young, poisson).unwrap();
    let coatings = layers.iter().map(|&(e, nu, h)| Coating::new(material(e, nu), h).unwrap()).collect();
    let base = substrate.map_or(Base::Rigid, |(e, nu)| Base::Elastic(material(e, nu)));
    HalfSpace::new(coatings, base).unwrap()
}

fn pair(layers: &[Layer], substrate: Option<(f64, f64)>) -> ContactPair {
    ContactPair::new(Body::Rigid, Body::Elastic(stack(layers, substrate))).unwrap()
}

/// zz, xx, yy, xy, zx, zy.
fn arrays(coefficients: InfluenceCoefficients) -> [Array2<f64>; 6] {
    let InfluenceCoefficients { zz, xx, yy, xy, zx, zy } = coefficients;
    [zz, xx, yy, xy, zx, zy].map(Option::unwrap)
}

#[derive(Deserialize)]
struct CoefficientRow {
    layers: Vec<Layer>,
    substrate: (f64, f64),
    i: usize,
    j: usize,
    zz: f64,
    xx: f64,
    yy: f64,
    xy: f64,
    zx: f64,
    zy: f64,
}

#[test]
fn six_components_against_hankel_quadrature() {
    let rows: Table<CoefficientRow> =
        serde_json::from_str(include_str!("golden/influence_coefficients.json")).unwrap();
    println!("largest error of the six components over zz at the offset");
    for body in rows.rows.chunk_by(|one, next| one.layers == next.layers) {
        let pair = pair(&body[0].layers, Some(body[0].substrate));
        let found = arrays(influence_coefficients(&pair, [121, 91], [1.0, 1.0], Components::ALL));
        print!("{:>40} ", format!("{:?}", body[0].layers));
        for row in body {
            let exact = [row.zz, row.xx, row.yy, row.xy, row.zx, row.zy];
            let error = (0..6).fold(0.0_f64, |worst, component| {
                worst.max((found[component][[row.i, row.j]] - exact[component]).abs() / row.zz)
            });
            print!(" ({},{}) {error:.0e}", row.i, row.j);
            assert!(error < 3e-14, "{:?} ({}, {}): {error:.1e}", row.layers, row.i, row.j); // measured 5e-15
        }
        println!();
    }
}

#[derive(Deserialize)]
struct NormalRow {
    layers: Vec<Layer>,
    substrate: (f64, f64),
    i: usize,
    j: usize,
    zz: String,
}

#[test]
fn normal_component_from_the_own_cell_to_the_end_of_a_large_grid() {
    let rows: Table<NormalRow> =
        serde_json::from_str(include_str!("golden/normal_coefficients.json")).unwrap();
    println!("error of zz over itself");
    for body in rows.rows.chunk_by(|one, next| one.layers == next.layers) {
        let pair = pair(&body[0].layers, Some(body[0].substrate));
        let zz = influence_coefficients(&pair, [256, 256], [1.0, 1.0], Components::NORMAL).zz.unwrap();
        print!("{:>20} ", format!("{:?}", body[0].layers));
        for row in body {
            let exact: f64 = row.zz.parse().unwrap();
            let error = (zz[[row.i, row.j]] / exact - 1.0).abs();
            print!(" ({},{}) {error:.0e}", row.i, row.j);
            assert!(error < 1e-14, "{:?} ({}, {}): {error:.1e}", row.layers, row.i, row.j); // some ulp of sums of 2000 terms
        }
        println!();
    }
}

#[derive(Deserialize)]
struct ResponseRow {
    case: String,
    layers: Vec<Layer>,
    substrate: Option<(f64, f64)>,
    k: f64,
    zz: String,
    rr: String,
    rz: String,
    tt: String,
}

#[test]
fn frequency_response_against_120_digits() {
    println!(
        "largest error over wavenumbers, k h from 1e-8 to 300: zz, rr, tt of themselves, rz of sqrt(zz rr)"
    );
    for text in [
        include_str!("golden/frequency_response.json"),
        include_str!("golden/frequency_response_random.json"),
    ] {
        let rows: Table<ResponseRow> = serde_json::from_str(text).unwrap();
        let mut worst_of_all = 0.0_f64;
        for stack_rows in rows.rows.chunk_by(|one, next| one.case == next.case) {
            let response = FrequencyResponse::new(&stack(&stack_rows[0].layers, stack_rows[0].substrate));
            let mut worst = 0.0_f64;
            for row in stack_rows {
                let found = response.at(row.k);
                let [zz, rr, rz, tt] =
                    [&row.zz, &row.rr, &row.rz, &row.tt].map(|value| value.parse::<f64>().unwrap());
                let errors = [
                    (found.zz - zz) / zz,
                    (found.rr - rr) / rr,
                    (found.rz - rz) / (zz * rr).sqrt(),
                    (found.tt - tt) / tt,
                ];
                worst = errors.iter().fold(worst, |worst, error| worst.max(error.abs()));
            }
            if rows.rows.len() < 100 {
                println!("{:>40}  {worst:.1e}", stack_rows[0].case);
            }
            worst_of_all = worst_of_all.max(worst);
        }
        println!("{:>40}  {worst_of_all:.1e}", format!("{} rows", rows.rows.len()));
        assert!(worst_of_all < 1e-14, "{worst_of_all:e}"); // 2e-15 but for decimal inputs rounded to binary
    }
}

fn poisson(random: &mut Random) -> f64 {
    if random.chance(0.2) { 0.5 } else { random.between(-0.5, 0.5) }
}

fn layers(random: &mut Random, contrast: f64) -> Vec<Layer> {
    let count = random.whole(1, 4);
    (0..count)
        .map(|_| {
            (random.log_uniform(1.0 / contrast, contrast), poisson(random), random.log_uniform(0.01, 30.0))
        })
        .collect()
}

#[test]
fn random_stacks_have_finite_coefficients_and_give_way_where_they_are_pressed() {
    let mut random = Random::seeded(1);
    for case in 0..60 {
        let layers = layers(&mut random, 1e4);
        let substrate = (case % 3 != 0).then_some((1.0, 0.3));
        for spacing in [[1.0, 1.0], [0.3, 2.0]] {
            let found =
                arrays(influence_coefficients(&pair(&layers, substrate), [20, 13], spacing, Components::ALL));
            assert!(found.iter().flatten().all(|value| value.is_finite()), "{layers:?}");
            let own = [0, 1, 2].map(|component| found[component][[0, 0]]);
            assert!(own.iter().all(|value| *value > 0.0), "{layers:?}: {own:?}");
            // reciprocity and energy: no cell moves more than the loaded one moves itself
            for (component, bound) in [
                own[0],
                own[1],
                own[2],
                (own[1] * own[2]).sqrt(),
                (own[0] * own[1]).sqrt(),
                (own[0] * own[2]).sqrt(),
            ]
            .into_iter()
            .enumerate()
            {
                assert!(found[component].iter().all(|value| value.abs() <= bound), "{layers:?} {component}");
            }
        }
    }
}

/// Largest difference of any component at any offset, over zz at the offset.
fn difference(found: &[Array2<f64>; 6], exact: &[Array2<f64>; 6]) -> f64 {
    let mut worst = 0.0_f64;
    for (found, exact_component) in found.iter().zip(exact) {
        for (index, value) in found.indexed_iter() {
            worst = worst.max((value - exact_component[index]).abs() / exact[0][index].abs());
        }
    }
    worst
}

#[test]
fn a_layer_on_top_vanishes_or_becomes_everything_with_first_order() {
    let mut random = Random::seeded(2);
    println!(
        "difference: layer 1e-5, 1e-6 thick from none; layer 1e5, 1e6 thick from a half-space of its own"
    );
    for _ in 0..12 {
        let below = layers(&mut random, 10.0);
        let (young, poisson) = (random.log_uniform(0.1, 10.0), poisson(&mut random));
        let with = |thickness: f64| {
            let layers: Vec<Layer> =
                std::iter::once((young, poisson, thickness)).chain(below.iter().copied()).collect();
            arrays(influence_coefficients(
                &pair(&layers, Some((1.0, 0.3))),
                [16, 11],
                [1.0, 0.6],
                Components::ALL,
            ))
        };
        let limit = |layers: &[Layer], substrate| {
            arrays(influence_coefficients(
                &pair(layers, Some(substrate)),
                [16, 11],
                [1.0, 0.6],
                Components::ALL,
            ))
        };
        let (none, all) = (limit(&below, (1.0, 0.3)), limit(&[], (young, poisson)));
        let [thin, thinner] = [1e-5, 1e-6].map(|thickness| difference(&with(thickness), &none));
        let [thick, thicker] = [1e5, 1e6].map(|thickness| difference(&with(thickness), &all));
        println!("{young:>8.2} {poisson:>6.2}: {thin:.2e} {thinner:.2e}   {thick:.2e} {thicker:.2e}");
        // first order in h/cell and in cell/h; the next order is 1e-3 of it at most
        assert!((thin / thinner - 10.0).abs() < 0.1, "{thin:e} {thinner:e}");
        assert!((thick / thicker - 10.0).abs() < 0.1, "{thick:e} {thicker:e}");
        // and its size is at most some times the thickness, or its inverse, times the contrast of what it lies on
        let moduli = below.iter().map(|layer| layer.0).chain([young, 1.0]);
        let (softest, stiffest) =
            moduli.fold((f64::INFINITY, 0.0_f64), |(low, high), one| (low.min(one), high.max(one)));
        let bound = 10.0 * 1e-5 * stiffest / softest;
        assert!(thin < bound && thick < bound, "{thin:e} {thick:e} {bound:e}");
    }
}
