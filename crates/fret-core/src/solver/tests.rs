pub(super) mod few_cells;

use std::ops::ControlFlow;

use super::*;
use crate::kernel::{Components, influence_coefficients};
use crate::model::{Base, Body, ContactPair, Control, ElasticMaterial, HalfSpace, Scheme};

#[test]
fn shear_across_the_one_axis_is_not_certified() {
    let material = ElasticMaterial::new(1.0, 0.0).unwrap();
    let body = || Body::Elastic(HalfSpace::new(Vec::new(), Base::Elastic(material)).unwrap());
    let pair = ContactPair::new(body(), body()).unwrap();
    let (cells, spacing) = ([32; 2], [2.6 / 32.0; 2]);
    let grid = SurfaceGrid::new(cells, spacing).unwrap();
    let gap = Array2::from_shape_fn((32, 32), |(i, j)| {
        0.5 * (grid.centre(0, i).powi(2) + grid.centre(1, j).powi(2))
    });
    let response = SurfaceResponse::FreeSpace(influence_coefficients(&pair, cells, spacing, Components::ALL));
    let friction = CoulombFriction::uniform(0.5).unwrap();
    let settings = SolverSettings::new(1e-8);
    let mut solver = ContactSolver::new(grid, gap, &friction, Coupling::Uncoupled, response, settings, true)
        .with_shear_axis(Some(0));
    let load = |pull| LoadStep {
        normal: Control::Force(0.5),
        tangential: [Control::Force(pull), Control::Force(0.0)],
        ..LoadStep::FREE
    };
    let go_on: IterationCallback<'_> = &mut |_, _| ControlFlow::Continue(());
    let mut state = solver.step(&ContactState::untouched(cells), &load(0.0), go_on).unwrap().state;
    solver.step(&state, &load(0.1), go_on).unwrap();
    // Some shear across with no resultant, well inside the friction bound.
    state.shear[1][[15, 16]] = 1e-3;
    state.shear[1][[16, 16]] = -1e-3;
    assert!(matches!(solver.step(&state, &load(0.1), go_on), Err(SolveError::NotConverged { .. })));
}

/// Without friction there is no shear, and no coefficients for it: how pressure and shear are solved makes no difference.
#[test]
fn without_friction_pressure_is_alone_in_either_scheme() {
    let material = ElasticMaterial::new(1.0, 0.3).unwrap();
    let lower = Body::Elastic(HalfSpace::new(Vec::new(), Base::Elastic(material)).unwrap());
    let pair = ContactPair::new(Body::Rigid, lower).unwrap();
    let (cells, spacing) = ([16; 2], [0.1; 2]);
    let grid = SurfaceGrid::new(cells, spacing).unwrap();
    let gap = Array2::from_shape_fn((16, 16), |(i, j)| {
        0.5 * (grid.centre(0, i).powi(2) + grid.centre(1, j).powi(2))
    });
    let friction = CoulombFriction::uniform(0.0).unwrap();
    let load = LoadStep { normal: Control::Force(0.1), ..LoadStep::FREE };
    let [monolithic, staggered] = [Scheme::Monolithic, Scheme::Staggered].map(|scheme| {
        let coefficients = influence_coefficients(&pair, cells, spacing, Components::NORMAL);
        let response = SurfaceResponse::FreeSpace(coefficients);
        let settings = SolverSettings { scheme, ..SolverSettings::new(1e-8) };
        let coupling = Coupling::Frictionless;
        ContactSolver::new(grid, gap.clone(), &friction, coupling, response, settings, true)
            .step(&ContactState::untouched(cells), &load, &mut |_, _| ControlFlow::Continue(()))
            .unwrap()
            .state
    });
    assert_eq!(monolithic, staggered);
}
