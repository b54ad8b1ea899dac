use ndarray::Array2;
use std::ops::ControlFlow;

use super::super::first_pressure::first_pressure;
use super::*;
use crate::compliance::{OperatorSet, SharedWorkspace, SurfaceResponse};
use crate::kernel::{Components, influence_coefficients, periodic_symbols};
use crate::model::{Base, Body, Coating, ContactPair, ElasticMaterial, HalfSpace};
use crate::random::Random;
use crate::solver::laws::rigid_motions::CellPositions;
use crate::solver::prescribed::NormalLoad;
use crate::solver::region::Region;

const SHAPE: [usize; 2] = [128, 160];

/// A half-space under a coating twice as stiff, of two cells.
fn responses() -> [SurfaceResponse; 2] {
    let material = |young| ElasticMaterial::new(young, 0.3).unwrap();
    let coatings = vec![Coating::new(material(2.0), 2.0).unwrap()];
    let body = HalfSpace::new(coatings, Base::Elastic(material(1.0))).unwrap();
    let pair = ContactPair::new(Body::Rigid, Body::Elastic(body)).unwrap();
    let spacing = [1.0, 1.2];
    [
        SurfaceResponse::FreeSpace(influence_coefficients(&pair, SHAPE, spacing, Components::NORMAL)),
        SurfaceResponse::Periodic(periodic_symbols(&pair, SHAPE, spacing, Components::NORMAL, 0)),
    ]
}

fn operators(response: &SurfaceResponse) -> RegionOperators {
    let wanted = OperatorSet { normal: true, ..OperatorSet::default() };
    RegionOperators::new(response, None, Region::whole(SHAPE), wanted, &SharedWorkspace::default()).unwrap()
}

/// Hills of some ten cells, a few of which are high.
fn rough() -> Vec<f64> {
    let mut random = Random::seeded(7);
    let waves: Vec<[f64; 4]> = (0..60)
        .map(|_| {
            let turns = [2.0, 14.0];
            [
                random.between(-turns[1], turns[1]).round(),
                random.between(turns[0], turns[1]).round(),
                random.between(0.0, 6.3),
                random.between(0.2, 1.0),
            ]
        })
        .collect();
    let height = |i: usize, j: usize| {
        waves.iter().fold(0.0, |height, [along_x, along_y, phase, size]| {
            let at = along_x * i as f64 / SHAPE[0] as f64 + along_y * j as f64 / SHAPE[1] as f64;
            height + size * (std::f64::consts::TAU * at + phase).cos()
        })
    };
    let heights = Array2::from_shape_fn(SHAPE, |(i, j)| height(i, j));
    let highest = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    heights.iter().map(|height| highest - height).collect()
}

/// Beside the products of the whole region. Within its reach single precision rounds; beyond it cubic interpolation of `1/r` is off by 0.5 % at
/// the most, between cells eight apart.
#[test]
fn displacements_are_about_those_of_the_whole_region() {
    let mut random = Random::seeded(3);
    for response in responses() {
        let mut operators = operators(&response);
        let mut sparse = operators.sparse_response().unwrap();
        let all = SHAPE[0] * SHAPE[1];
        // Clusters, two of them at the ends of the region.
        let cells = ContactSet::of(all, |cell| {
            let [i, j] = [cell / SHAPE[1], cell % SHAPE[1]];
            [[0, 40], [64, 64], [127, 41], [90, 159], [91, 0]]
                .iter()
                .any(|[x, y]: &[usize; 2]| i.abs_diff(*x) < 4 && j.abs_diff(*y) < 3)
        });
        let pressure: Vec<f64> = (0..cells.len()).map(|_| random.between(0.5, 1.0)).collect();
        let mut found = vec![0.0; cells.len()];
        for set in [&ContactSet::of(all, |cell| cell % 50 == 0), &cells] {
            sparse.begin(set);
        }
        sparse.displacement(&pressure, &mut found);
        let (mut whole, mut exact) = (vec![0.0; all], vec![0.0; all]);
        cells.scatter(&pressure, 1.0, &mut whole);
        operators.compliance.normal(&whole, &mut exact);
        for (found, exact) in found.iter().zip(cells.packed(&exact)) {
            // Periodic displacements are measured from their mean: the size is that of a cell's own.
            let size = exact.abs() + operators.compliance.self_influence().normal;
            assert!((found - exact).abs() < 5e-3 * size, "{found} {exact}");
        }
    }
}

/// The same as conjugate gradients on all cells, whose residual is the same law's: by force and by approach, alone and in a period.
#[test]
fn the_solution_is_that_on_all_cells() {
    let undeformed = rough();
    let positions = CellPositions::new(vec![0.0], vec![0.0], false);
    let tolerance = 1e-9;
    for response in responses() {
        for (total, approach) in [(Some(150.0), 0.0), (None, 5.0)] {
            let load = NormalLoad { total, approach, give: 0.0, moment: [None; 2], hardness: None };
            let task = NormalEquations { undeformed: &undeformed, load, positions: &positions };
            let mut operators = operators(&response);
            let own = operators.compliance.self_influence().normal;
            let mut heard = |_: usize, _: f64| ControlFlow::Continue(());
            let start = first_pressure(&task, own);
            let (mut plain, mut displacement) = (start.clone(), vec![0.0; start.len()]);
            let fields = [&mut plain[..], &mut displacement];
            let mut problem = NormalIteration::new(&task, fields, &mut operators, tolerance, &mut heard);
            assert!(matches!(projected_cg::iterate(&mut problem, 1000).unwrap(), Ending::Solved(_)));
            // From the same, unsettled: a solution to 1e-2.
            let mut pressure = start;
            let fields = [&mut pressure[..], &mut displacement];
            let mut problem = NormalIteration::new(&task, fields, &mut operators, 1e-2, &mut heard);
            projected_cg::iterate(&mut problem, 1000).unwrap();
            let fields = [&mut pressure[..], &mut displacement];
            let solution = solve(&task, fields, &mut operators, tolerance, &mut heard).unwrap().unwrap();
            assert!(solution.residual.residual < tolerance);
            let loaded = plain.iter().filter(|p| **p > 0.0).count();
            assert!((50..800).contains(&loaded), "{loaded}"); // sparse, and a contact
            let most = plain.iter().copied().fold(0.0, f64::max);
            for (found, exact) in pressure.iter().zip(&plain) {
                // Violations of 1e-9 of the mean displacement, of which a cell's own is a tenth or more.
                assert!((found - exact).abs() < 1e-7 * most, "{found} {exact}");
            }
        }
    }
}

/// Where many cells are in contact nothing is done.
#[test]
fn a_dense_contact_is_left_to_others() {
    let response = &responses()[1];
    let mut operators = operators(response);
    let positions = CellPositions::new(vec![0.0], vec![0.0], false);
    let undeformed = vec![0.0; SHAPE[0] * SHAPE[1]];
    let load = NormalLoad { total: None, approach: 1.0, give: 0.0, moment: [None; 2], hardness: None };
    let task = NormalEquations { undeformed: &undeformed, load, positions: &positions };
    let (mut pressure, mut displacement) = (vec![1.0; undeformed.len()], undeformed.clone());
    let fields = [&mut pressure[..], &mut displacement];
    let found = solve(&task, fields, &mut operators, 1e-8, &mut |_, _| ControlFlow::Continue(()));
    assert!(found.unwrap().is_none());
}
