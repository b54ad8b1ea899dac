//! How far the contact of a case will reach: frictionless solutions on a coarse grid under the heaviest normal load.

use std::ops::ControlFlow;

use crate::case::{Case, walk};
use crate::compliance::SurfaceResponse;
use crate::kernel::{Components, influence_coefficients};
use crate::model::{
    Base, Body, ContactState, Control, CoulombFriction, ElasticMaterial, LoadStep, Profile, SurfaceGrid,
};
use crate::solver::{ContactSolver, Coupling, SolveError, SolverSettings};

/// Cells a side of the coarse grid.
const COARSE: usize = 48;
/// Side of an automatic grid in units of the contact's width.
const MARGIN: f64 = 1.2;

/// Where the contact stays under the heaviest load.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Extent {
    /// Inside the grid: its widths along x and y [length], up to a coarse cell.
    Inside([f64; 2]),
    /// It reaches the edge.
    Beyond,
    /// The bodies never touch.
    Nothing,
    /// The coarse problem could not be solved: nothing is known.
    Unknown,
}

/// Whether the contact certainly reaches beyond a grid of side lengths `size`: judged on a coarse grid half as large again,
/// which sees the edge of contact up to one of its cells.
pub fn reaches_beyond(case: &Case, size: [f64; 2]) -> bool {
    let wider = size.map(|side| 1.5 * side);
    match contact_extent(case, wider) {
        Extent::Beyond => true,
        Extent::Inside(widths) => (0..2).any(|axis| widths[axis] - wider[axis] / COARSE as f64 > size[axis]),
        Extent::Nothing | Extent::Unknown => false,
    }
}

/// Extent of the contact of a case on a grid of side lengths `size`.
fn contact_extent(case: &Case, size: [f64; 2]) -> Extent {
    let mut widest = Extent::Nothing;
    for normal in heaviest_loads(case) {
        match extent_under(case, size, normal) {
            Extent::Inside([x, y]) => {
                widest = match widest {
                    Extent::Inside([u, v]) => Extent::Inside([x.max(u), y.max(v)]),
                    _ => Extent::Inside([x, y]),
                };
            }
            Extent::Nothing => {}
            other => return other,
        }
    }
    widest
}

/// Side lengths such that the contact fits with a margin; `None` when no contact was found.
pub fn automatic_size(case: &Case) -> Option<[f64; 2]> {
    let mut size = [3.0 * first_guess(case)?; 2];
    for _ in 0..60 {
        match contact_extent(case, size) {
            Extent::Beyond => size = size.map(|side| 2.0 * side),
            Extent::Inside(widths) => {
                let fine = (0..2).all(|axis| widths[axis] >= 0.45 * size[axis]);
                let wanted = [0, 1].map(|axis| MARGIN * widths[axis]);
                if fine {
                    return Some(wanted);
                }
                size = [0, 1].map(|axis| size[axis].min(1.5 * widths[axis]));
            }
            Extent::Nothing | Extent::Unknown => return None,
        }
    }
    None
}

/// The largest prescribed normal force and the largest prescribed approach.
fn heaviest_loads(case: &Case) -> Vec<Control> {
    let mut force = 0.0_f64;
    let mut approach = 0.0_f64;
    walk(&case.stages, |_, [normal, ..]| match normal {
        Some(Control::Force(value)) => force = force.max(*value),
        Some(Control::Motion(value)) => approach = approach.max(*value),
        None => {}
    });
    let mut loads = Vec::new();
    if force > 0.0 {
        loads.push(Control::Force(force));
    }
    if approach > 0.0 {
        loads.push(Control::Motion(approach));
    }
    loads
}

fn extent_under(case: &Case, size: [f64; 2], normal: Control) -> Extent {
    let cells = [COARSE; 2];
    let spacing = [size[0] / COARSE as f64, size[1] / COARSE as f64];
    let Ok(grid) = SurfaceGrid::new(cells, spacing) else { return Extent::Unknown };
    let frictionless = CoulombFriction::Uniform(0.0);
    let response =
        SurfaceResponse::FreeSpace(influence_coefficients(&case.bodies, cells, spacing, Components::NORMAL));
    let settings = SolverSettings::new(1e-4);
    let mut solver = ContactSolver::new(
        grid,
        case.profile.gap(&grid),
        &frictionless,
        Coupling::Frictionless,
        response,
        settings,
        false,
    );
    let load = LoadStep { normal, tangential: [Control::Force(0.0); 2], twist: Control::Motion(0.0) };
    let untouched = ContactState::untouched(cells);
    let solved = match solver.step(&untouched, &load, &mut |_, _| ControlFlow::Continue(())) {
        Ok(solved) => solved,
        Err(SolveError::ContactAtEdge) => return Extent::Beyond,
        Err(_) => return Extent::Unknown,
    };
    let pressure = &solved.state.pressure;
    let width = |axis: usize| {
        let touched =
            pressure.axis_iter(ndarray::Axis(axis)).filter(|line| line.iter().any(|p| *p > 0.0)).count();
        touched as f64 * spacing[axis]
    };
    if solved.outcome.contact_cells == 0 { Extent::Nothing } else { Extent::Inside([width(0), width(1)]) }
}

/// Order of the contact radius [length]: Hertz with the stiffest material of each body.
fn first_guess(case: &Case) -> Option<f64> {
    let radius = match case.profile {
        Profile::Sphere { radius } => radius,
        Profile::Ellipsoid { radius_x, radius_y } => (radius_x * radius_y).sqrt(),
        Profile::Wave { .. } => return None,
    };
    let compliance = |body: &Body| match body {
        Body::Rigid => 0.0,
        Body::Elastic(half_space) => {
            let of = |material: &ElasticMaterial| (1.0 - material.poisson().powi(2)) / material.young();
            let base = match half_space.base() {
                Base::Elastic(material) => of(material),
                Base::Rigid => f64::INFINITY,
            };
            half_space.coatings().iter().map(|coating| of(coating.material())).fold(base, f64::min)
        }
    };
    let compliance = compliance(case.bodies.upper()) + compliance(case.bodies.lower());
    heaviest_loads(case)
        .into_iter()
        .map(|load| match load {
            Control::Force(force) => (0.75 * force * radius * compliance).cbrt(),
            Control::Motion(approach) => (radius * approach).sqrt(),
        })
        .reduce(f64::max)
        .filter(|guess| guess.is_finite() && *guess > 0.0)
}
