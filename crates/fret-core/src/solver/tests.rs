use std::ops::ControlFlow;

use super::*;
use crate::kernel::{Components, influence_coefficients};
use crate::model::{Base, Body, ContactPair, Control, ElasticMaterial, HalfSpace};

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
