//! How far the contact of a case will reach: frictionless solutions on a coarse grid under the heaviest normal load.

use std::ops::ControlFlow;

use serde::{Deserialize, Serialize};

use crate::case::{Case, DATUM, walk};
use crate::compliance::SurfaceResponse;
use crate::kernel::{
    Components, cells_too_coarse_for_incompressible_film, influence_coefficients, line_coefficients,
};
use crate::model::{
    Axis, Base, Body, ContactState, Control, CoulombFriction, Dimension, ElasticMaterial, LoadStep, Shape,
    SurfaceGrid,
};
use crate::solver::{ContactSolver, Coupling, SolveError, SolverSettings};

/// Cells per side of the coarse grid.
pub(super) const COARSE: usize = 48;
/// Cells of the coarse grid of a line contact.
const COARSE_LINE: usize = 192;
/// Side of an automatic grid in units of the contact's width.
pub(super) const MARGIN: f64 = 1.2;

/// The contact under the heaviest load, without friction, as a coarse grid shows it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ExpectedContact {
    /// How far it reaches from the origin along x and y [length], to a twentieth; of a line contact, its half-width twice.
    pub half_widths: [f64; 2],
    /// Approach [length].
    pub approach: f64,
}

/// Half-widths over the radii of curvature of the profile [-], the larger; 0 where it has none.
pub fn over_body(case: &Case, half_widths: [f64; 2]) -> f64 {
    let [x, y] = case.profile.curvatures();
    (half_widths[0] * x).max(half_widths[1] * y)
}

/// Where the contact stays under the heaviest load.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Extent {
    /// Inside the grid: twice how far it reaches from the origin along x and y, up to a coarse cell, and the approach [length].
    Inside([f64; 2], f64),
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
    if !case.profile.heights.is_empty() {
        return false; // heights stand on the cells of the grid alone: the run will tell
    }
    let wider = size.map(|side| 1.5 * side);
    match contact_extent(case, wider) {
        Extent::Beyond => true,
        Extent::Inside(widths, _) => {
            let cells = coarse_cells(case);
            case.dimension().axes().any(|axis| widths[axis] - wider[axis] / cells[axis] as f64 > size[axis])
        }
        Extent::Nothing | Extent::Unknown => false,
    }
}

/// The coarse grid of a case.
pub(super) fn coarse_cells(case: &Case) -> [usize; 2] {
    match case.dimension() {
        Dimension::Plane => [COARSE; 2],
        Dimension::Line => [COARSE_LINE, 1],
    }
}

/// Why a contact is not known before the run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Unexpected {
    /// Nothing presses the bodies together, or nothing ends their contact.
    NoContact,
    /// A nearly incompressible film is too thin for the cells of the coarse grid.
    UnseenFilm,
    /// The datum lies too near or too far for a grid of this length around the contact [length].
    Datum(f64),
    /// The coarse problem was not solved.
    Unsolved,
}

/// Extent of the contact of a case on a grid of side lengths `size`.
fn contact_extent(case: &Case, size: [f64; 2]) -> Extent {
    let mut widest = Extent::Nothing;
    for normal in heaviest_loads(case) {
        match extent_under(case, size, normal) {
            Extent::Inside([x, y], approach) => {
                widest = match widest {
                    Extent::Inside([u, v], other) => {
                        Extent::Inside([x.max(u), y.max(v)], approach.max(other))
                    }
                    _ => Extent::Inside([x, y], approach),
                };
            }
            Extent::Nothing => {}
            other => return other,
        }
    }
    widest
}

/// Side lengths such that a contact fits with a margin.
pub fn automatic_size(case: &Case, contact: &ExpectedContact) -> [f64; 2] {
    let sides = [0, 1].map(|axis| margin(case.cells[axis]) * 2.0 * contact.half_widths[axis]);
    case.dimension().sides(sides, case.cells)
}

/// Side of a grid of so many cells in units of the contact's width: the margin, and at least so much that the outermost centres lie a quarter
/// of a cell outside, which fewer than nine cells make more.
fn margin(cells: usize) -> f64 {
    if cells < 9 { MARGIN.max(cells as f64 / (cells as f64 - 1.5)) } else { MARGIN }
}

/// The contact of a case on a coarse grid that it about fills.
///
/// # Errors
/// Why it is not known.
pub fn expected_contact(case: &Case) -> Result<ExpectedContact, Unexpected> {
    if !case.profile.heights.is_empty() {
        return Err(Unexpected::NoContact); // heights stand on the cells of the grid alone
    }
    let mut size = first_guess(case).ok_or(Unexpected::NoContact)?.map(|half| 3.0 * half);
    for _ in 0..60 {
        match contact_extent(case, size) {
            Extent::Beyond => size = size.map(|side| 2.0 * side),
            Extent::Inside(widths, approach) => {
                let fine = case.dimension().axes().all(|axis| widths[axis] >= 0.45 * size[axis]);
                if fine {
                    return Ok(ExpectedContact { half_widths: widths.map(|width| 0.5 * width), approach });
                }
                size = [0, 1].map(|axis| size[axis].min(1.5 * widths[axis]));
            }
            Extent::Nothing => return Err(Unexpected::NoContact),
            Extent::Unknown => return Err(why_unsolved(case, size)),
        }
    }
    Err(Unexpected::Unsolved)
}

/// Why the coarse problem on a grid of side lengths `size` was not solved.
fn why_unsolved(case: &Case, size: [f64; 2]) -> Unexpected {
    let cells = coarse_cells(case);
    let spacing = [0, 1].map(|axis| size[axis] / cells[axis] as f64);
    let is_unseen = |body: &Body| match body {
        Body::Rigid => false,
        Body::Elastic(half_space) => cells_too_coarse_for_incompressible_film(half_space, spacing),
    };
    match case.datum {
        Some(datum) if case.dimension() == Dimension::Line && !DATUM.contains(&(datum / size[0])) => {
            Unexpected::Datum(size[0])
        }
        _ if is_unseen(case.bodies.upper()) || is_unseen(case.bodies.lower()) => Unexpected::UnseenFilm,
        _ => Unexpected::Unsolved,
    }
}

/// The largest prescribed normal force and the largest prescribed approach.
pub(super) fn heaviest_loads(case: &Case) -> Vec<Control> {
    let mut force = 0.0_f64;
    let mut approach = 0.0_f64;
    let mut far_end = 0.0_f64;
    walk(case.start.as_ref(), &case.stages, |_, [normal, ..]| match normal {
        Some(Control::Force(value)) => force = force.max(*value),
        Some(Control::Motion(value)) => approach = approach.max(*value),
        Some(Control::FarEnd(value)) => far_end = far_end.max(*value),
        None => {}
    });
    let mut loads = Vec::new();
    if force > 0.0 {
        loads.push(Control::Force(force));
    }
    if approach > 0.0 {
        loads.push(Control::Motion(approach));
    }
    if far_end > 0.0 {
        loads.push(Control::FarEnd(far_end));
    }
    loads
}

/// The response of the bodies of a case on the cells of a grid of length `length`.
pub(super) fn coarse_response(
    case: &Case,
    (grid, length): (&SurfaceGrid, f64),
    components: Components,
) -> SurfaceResponse {
    let (cells, spacing) = (grid.cells(), grid.spacing());
    SurfaceResponse::FreeSpace(match case.dimension() {
        Dimension::Plane => influence_coefficients(&case.bodies, cells, spacing, components),
        Dimension::Line => {
            let datum = case.datum.unwrap_or(length);
            line_coefficients(&case.bodies, cells[0], spacing[0], datum, components)
        }
    })
}

/// The coarse grid of side lengths `size`.
pub(super) fn coarse_grid(case: &Case, size: [f64; 2]) -> Option<SurfaceGrid> {
    let cells = coarse_cells(case);
    SurfaceGrid::new(cells, [0, 1].map(|axis| size[axis] / cells[axis] as f64)).ok()
}

fn extent_under(case: &Case, size: [f64; 2], normal: Control) -> Extent {
    let Some(grid) = coarse_grid(case, size) else { return Extent::Unknown };
    let (cells, spacing) = (grid.cells(), grid.spacing());
    let frictionless = CoulombFriction::NONE;
    let response = coarse_response(case, (&grid, size[0]), Components::NORMAL);
    let settings = SolverSettings::new(1e-4);
    let mut solver = ContactSolver::new(
        grid,
        case.profile.gap(&grid),
        &frictionless,
        Coupling::Frictionless,
        response,
        settings,
        false,
    )
    .with_rig(case.springs())
    .with_hardness(case.hardness);
    let load = LoadStep { normal, tangential: [Control::Force(0.0); 2], ..LoadStep::FREE };
    let untouched = ContactState::untouched(cells);
    let solved = match solver.step(&untouched, &load, &mut |_, _| ControlFlow::Continue(())) {
        Ok(solved) => solved,
        Err(SolveError::ContactAtEdge) => return Extent::Beyond,
        Err(_) => return Extent::Unknown,
    };
    let pressure = &solved.state.pressure;
    // The grid lies around the origin, and a contact that is not its own mirror image (of a triangular pyramid) reaches farther on one side.
    let width = |axis: usize| {
        let lines = pressure.axis_iter(ndarray::Axis(axis)).enumerate();
        let touched = lines.filter(|(_, line)| line.iter().any(|p| *p > 0.0));
        let reach = touched.map(|(at, _)| (2 * at + 2).max(2 * (cells[axis] - at)) - cells[axis]).max();
        reach.unwrap_or(0) as f64 * spacing[axis]
    };
    let widths = case.dimension().along(width, width(0));
    if solved.outcome.contact_cells == 0 {
        Extent::Nothing
    } else {
        Extent::Inside(widths, solved.state.approach)
    }
}

/// Order of the contact's half-widths along x and y [length], with the stiffest material of each body. Each shape of a sum opens
/// the gap, so that the narrowest decides.
fn first_guess(case: &Case) -> Option<[f64; 2]> {
    let compliance = compliance(case.bodies.upper()) + compliance(case.bodies.lower());
    let [x, y] = case.profile.curvatures();
    if case.dimension() == Dimension::Line {
        return first_guess_of_line(case, x, compliance).map(|half| [half; 2]);
    }
    let round = (x > 0.0 && y > 0.0).then(|| Shape::Sphere { radius: (x * y).sqrt().recip() });
    let others = case.profile.shapes.iter().filter(|shape| shape.curvatures().is_none()).cloned();
    let shapes: Vec<Shape> = round.into_iter().chain(others).collect();
    let under = |load: Control| {
        let guesses = shapes.iter().map(|shape| half_widths(shape, load, compliance));
        guesses.fold([f64::INFINITY; 2], |least, guess| [least[0].min(guess[0]), least[1].min(guess[1])])
    };
    heaviest_loads(case)
        .into_iter()
        .map(under)
        .reduce(|a, b| [a[0].max(b[0]), a[1].max(b[1])])
        .filter(|guess| guess.iter().all(|half| half.is_finite() && *half > 0.0))
}

/// Order of the half-width of a line contact [length]; `curvature` of all its cylinders.
fn first_guess_of_line(case: &Case, curvature: f64, compliance: f64) -> Option<f64> {
    use std::f64::consts::PI;
    let hertz = |radius: f64, load: Control| match load {
        Control::Force(force) => (4.0 * force * radius * compliance / PI).sqrt(),
        Control::Motion(approach) | Control::FarEnd(approach) => (radius * approach).sqrt(),
    };
    let half_width = |shape: &Shape, load: Control| match (shape, load) {
        (&Shape::RoundedPunch { flat_radius, edge_radius }, _) => flat_radius + hertz(edge_radius, load),
        (&Shape::FlatPunch { radius }, _) => radius,
        (&Shape::Cone { slope }, Control::Force(force)) => 2.0 * force * compliance / slope,
        (&Shape::Cone { slope }, Control::Motion(approach) | Control::FarEnd(approach)) => approach / slope,
        _ => f64::INFINITY,
    };
    let under = |load: Control| {
        let round = if curvature > 0.0 { hertz(curvature.recip(), load) } else { f64::INFINITY };
        case.profile.shapes.iter().map(|shape| half_width(shape, load)).fold(round, f64::min)
    };
    let guess = heaviest_loads(case).into_iter().map(under).fold(0.0, f64::max);
    (guess.is_finite() && guess > 0.0).then_some(guess)
}

/// Half-widths of the contact of a shape alone [length]: closed forms, or their order; infinite where nothing ends it.
fn half_widths(shape: &Shape, load: Control, compliance: f64) -> [f64; 2] {
    use std::f64::consts::PI;
    let hertz = |radius: f64| match load {
        Control::Force(force) => (0.75 * force * radius * compliance).cbrt(),
        Control::Motion(approach) | Control::FarEnd(approach) => (radius * approach).sqrt(),
    };
    let cone = |slope: f64| match load {
        Control::Force(force) => (2.0 * force * compliance / (PI * slope)).sqrt(),
        Control::Motion(approach) | Control::FarEnd(approach) => 2.0 * approach / (PI * slope),
    };
    let across = |radius: f64, length: f64| match load {
        Control::Force(force) => (4.0 * force / length * radius * compliance / PI).sqrt(),
        Control::Motion(approach) | Control::FarEnd(approach) => (radius * approach).sqrt(),
    };
    match *shape {
        Shape::Sphere { radius } => [hertz(radius); 2],
        Shape::Cylinder { radius, axis, length: Some(length) } => {
            let across = across(radius, length);
            match axis {
                Axis::X => [length / 2.0, across],
                Axis::Y => [across, length / 2.0],
            }
        }
        Shape::RoundedPunch { flat_radius, edge_radius } => [flat_radius + hertz(edge_radius); 2],
        Shape::FlatPunch { radius } => [radius; 2],
        Shape::Cone { slope } => [cone(slope); 2],
        // wider than the sphere of its tip where the cone is reached, and than the cone without it
        Shape::SpheroCone { radius, slope } => {
            let turn = radius * slope;
            [if hertz(radius) <= turn { hertz(radius) } else { cone(slope).max(turn) + 0.25 * turn }; 2]
        }
        Shape::WornSphere { radius, flat_radius } => [flat_radius.hypot(hertz(radius)); 2],
        // the corners of the polygon that has the area of the circle of the equal cone
        Shape::Pyramid { sides, slope } => {
            let angle = PI / f64::from(sides);
            let area = (f64::from(sides) * angle.tan() / PI).sqrt();
            [cone(slope / area) / (area * angle.cos()); 2]
        }
        Shape::RectangularPunch { lengths, edge_radius } => {
            lengths.map(|length| 0.5 * length + edge_radius.map_or(0.0, hertz))
        }
        Shape::CrownedRoller { radius, axis, length, flat_length, crown_radius } => {
            let along = (0.5 * flat_length + hertz(crown_radius)).min(0.5 * length);
            let across = across(radius, 2.0 * along);
            match axis {
                Axis::X => [along, across],
                Axis::Y => [across, along],
            }
        }
        Shape::Ellipsoid { .. }
        | Shape::Cylinder { length: None, .. }
        | Shape::Wave { .. }
        | Shape::Formula(_) => [f64::INFINITY; 2],
    }
}

/// Compliance `(1 - nu^2) / E` of a body's stiffest material [1/pressure].
fn compliance(body: &Body) -> f64 {
    let Body::Elastic(half_space) = body else { return 0.0 };
    let of = |material: &ElasticMaterial| (1.0 - material.poisson().powi(2)) / material.young();
    let base = match half_space.base() {
        Base::Elastic(material) => of(material),
        Base::Rigid => f64::INFINITY,
    };
    half_space.coatings().iter().map(|coating| of(coating.material())).fold(base, f64::min)
}
