//! How far a contact reaches that slides: a soft, nearly incompressible layer is dragged along, and rises on one side; and so does a surface
//! under friction much stronger than usual.

use std::ops::ControlFlow;

use super::extent::{MARGIN, coarse_grid, coarse_response, heaviest_loads};
use crate::case::Case;
use crate::kernel::Components;
use crate::model::{
    Base, Body, CellValues, ContactState, Control, CoulombFriction, ElasticMaterial, Integration, LoadStep,
};
use crate::solver::{ContactSolver, Coupling, SolveError, SolverSettings};

/// Poisson's ratio from which on a layer under shear lifts and lowers its surface much.
const NEARLY_INCOMPRESSIBLE: f64 = 0.4;
/// Coefficient of friction above which any surface does.
const STRONG: f64 = 1.0;
/// Sides of the coarse grid in units of those without sliding, and how often they are doubled at the most.
const WIDER: f64 = 1.5;
const MOST_DOUBLINGS: usize = 3;

/// Side lengths in which the contact of a case fits with a margin when it slides as a whole, too: `size`, which holds it without friction,
/// unless a layer is dragged along so far that its contact would reach the outermost cells.
pub fn with_room_to_slide(case: &Case, size: [f64; 2]) -> [f64; 2] {
    let mut wanted = size;
    if !is_dragged(case) && strongest(case).largest() <= STRONG {
        return size;
    }
    let pulled = |axis: &usize| case.stages.iter().any(|stage| stage.tangential[*axis].is_some());
    for direction in case.dimension().axes().filter(pulled) {
        for normal in heaviest_loads(case) {
            let Some(reach) = reach_in_sliding(case, size, normal, direction) else { continue };
            for axis in case.dimension().axes() {
                let outermost = 0.5 * size[axis] * (1.0 - 1.0 / case.cells[axis] as f64);
                if reach[axis] >= outermost {
                    wanted[axis] = wanted[axis].max(2.0 * MARGIN * reach[axis]);
                }
            }
        }
    }
    case.dimension().sides(wanted, case.cells)
}

/// Whether a body has a nearly incompressible layer that is softer than what lies below all layers.
fn is_dragged(case: &Case) -> bool {
    [case.bodies.upper(), case.bodies.lower()].into_iter().any(|body| {
        let Body::Elastic(stack) = body else { return false };
        let below = match stack.base() {
            Base::Rigid => f64::INFINITY,
            Base::Elastic(material) => material.young(),
        };
        let is_soft =
            |layer: &ElasticMaterial| layer.poisson() >= NEARLY_INCOMPRESSIBLE && layer.young() < below;
        stack.coatings().iter().any(|coating| is_soft(coating.material()))
    })
}

/// How far from the middle a contact reaches along x and y [length], up to a coarse cell, while it slides along an axis under a normal load;
/// `None` where that was not solved.
fn reach_in_sliding(case: &Case, size: [f64; 2], normal: Control, direction: usize) -> Option<[f64; 2]> {
    let mut wider = size.map(|side| WIDER * side);
    for _ in 0..=MOST_DOUBLINGS {
        match reach_on(case, wider, normal, direction) {
            Err(SolveError::ContactAtEdge) => wider = wider.map(|side| 2.0 * side),
            found => return found.ok(),
        }
    }
    None
}

fn reach_on(case: &Case, size: [f64; 2], normal: Control, direction: usize) -> Result<[f64; 2], SolveError> {
    let grid = coarse_grid(case, size).ok_or(SolveError::Stopped)?;
    let response = coarse_response(case, (&grid, size[0]), Components::ALL);
    // A start of a size: what does not converge from here is left to the run.
    let settings = SolverSettings {
        integration: Integration::EndPoint,
        another_way: false,
        ..SolverSettings::new(1e-3)
    };
    let friction = strongest(case);
    let gap = case.profile.gap(&grid);
    let mut solver = ContactSolver::new(grid, gap, &friction, Coupling::Coupled, response, settings, false)
        .with_rig(case.springs())
        .with_hardness(case.hardness);
    let mut tangential = [Control::Motion(0.0); 2];
    tangential[direction] = Control::Motion(size[direction]);
    let load = LoadStep { normal, tangential, ..LoadStep::FREE };
    let untouched = ContactState::untouched(grid.cells());
    let solved = solver.step(&untouched, &load, &mut |_, _| ControlFlow::Continue(()))?;
    let mut reach = [0.0_f64; 2];
    for ((i, j), _) in solved.state.pressure.indexed_iter().filter(|(_, p)| **p > 0.0) {
        for (axis, index) in [i, j].into_iter().enumerate() {
            reach[axis] = reach[axis].max(grid.centre(axis, index).abs());
        }
    }
    Ok([0, 1].map(|axis| reach[axis] + grid.spacing()[axis]))
}

/// The strongest friction of a case, the same everywhere.
fn strongest(case: &Case) -> CoulombFriction {
    let evolved = case.friction_evolution.as_ref().map(|evolution| evolution.strongest(&case.friction));
    let changes = case.stages.iter().filter_map(|stage| stage.friction.as_ref());
    let laws = changes.chain(evolved.as_ref());
    let largest = laws.fold(case.friction.largest(), |most, law| most.max(law.largest()));
    case.friction.with_coefficient(CellValues::Uniform(largest))
}
