//! Automatic simplifications of a case: what is not needed, why, and what that saves.

use ndarray::Axis;

use serde::{Deserialize, Serialize};

use super::loaded::{is_loaded, is_twisted};
use super::simplification::{LeaveOut, Simplification};
use super::symmetry::is_stretched;
use crate::case::{Case, Stage};
use crate::kernel::PairResponse;
use crate::model::{AccumulatedSlip, Body, ContactState, Dimension, SurfaceGrid, Symmetry};
use crate::solver::Coupling;

/// An automatic simplification.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct LeftOut {
    /// What is not computed.
    pub what: String,
    /// Why it applies to the case.
    pub why: String,
    /// What that saves.
    pub saves: String,
}

/// Names of the fields that can be kept, with their bytes per cell.
const FIELDS: [(&str, usize); 5] = [("pressure", 8), ("shear", 16), ("slip", 16), ("gap", 8), ("zone", 1)];

/// What is skipped where surfaces that may move do not, why, and what that saves.
const MOTION: [&str; 3] = [
    "motion of the surfaces",
    "the upper body moves by less than a hundredth of a cell",
    "another gap and the carried displacement of the upper body in every increment",
];

/// The automatic simplifications of a case, of those that `leave_out` allows.
pub fn left_out(
    case: &Case,
    grid: &SurfaceGrid,
    coupling: Coupling,
    (along, symmetry, single_precision, [moves, is_displaced]): (Option<usize>, Symmetry, bool, [bool; 2]),
    leave_out: LeaveOut,
) -> Vec<LeftOut> {
    let mut list = Vec::new();
    let mut leave = |what: &str, why: &str, saves: &str| {
        list.push(LeftOut { what: what.to_owned(), why: why.to_owned(), saves: saves.to_owned() });
    };
    let homogeneous = |body: &Body| match body {
        Body::Rigid => true,
        Body::Elastic(half_space) => half_space.single_material().is_some(),
    };
    let plain = homogeneous(case.bodies.upper()) && homogeneous(case.bodies.lower());
    if plain && leave_out.takes(Simplification::LayeredResponse) {
        leave(
            "layered response",
            "no body has a coating that differs from its substrate",
            "the radial table of the coated response",
        );
    }
    match coupling {
        Coupling::Frictionless => leave(
            "shear, slip and the tangential equations",
            "there is no friction",
            "five of six kernels and every tangential iteration",
        ),
        Coupling::Uncoupled => {
            let why = if case.is_frictionless() {
                "there is no friction"
            } else {
                "the bodies are elastically similar, so pressure does not depend on shear"
            };
            leave("normal-tangential coupling", why, "two of six kernels and every coupled iteration");
        }
        Coupling::Coupled => {}
    }
    if coupling == Coupling::Uncoupled
        && leave_out.takes(Simplification::Tangential)
        && case.start.is_none()
        && let Some(increments) = increments_before_a_cause(case)
    {
        leave(
            "tangential equations before the first tangential load",
            "no tangential force, shift, twist or bulk stress is prescribed before",
            &format!("every tangential iteration of the first {increments} increments"),
        );
    }
    let stays = !moves && !case.rolls();
    if coupling != Coupling::Coupled && stays && leave_out.takes(Simplification::Pressure) {
        let increments = increments_at_one_load(case);
        if increments > 0 {
            leave(
                "normal problem at constant normal load",
                "the normal load is constant, pressure does not depend on shear, and wear changes the gap only between cycles",
                &format!("the pressure, the gap and the edge of contact in up to {increments} increments"),
            );
        }
    }
    if let Some(axis) = along {
        let [name, across] = [["x", "y"], ["y", "x"]][axis];
        leave(
            &format!("shear along {across}"),
            &format!("no load acts along it, and shear along {name} causes no displacement along it"),
            "three of four tangential kernels, half of the transforms of shear",
        );
    }
    if symmetry.any() {
        let (share, planes) = match symmetry.axes() {
            [true, true] => ("three quarters", "the planes x = 0 and y = 0"),
            [true, false] => ("half", "the plane x = 0"),
            _ => ("half", "the plane y = 0"),
        };
        leave(
            &format!("{share} of the grid"),
            &format!("gap, friction and loads are symmetric about {planes}"),
            &format!("{share} of the solver's fields and transforms"),
        );
    }
    if !case.periodic.is_both() && leave_out.takes(Simplification::Region) {
        leave(
            "cells far from the contact, in the iterations",
            "they carry no pressure; overlap there is checked after the active subdomain is solved",
            "the fraction of the grid outside the active subdomain, in every iteration",
        );
    }
    if case.kinematics.is_finite() && !is_displaced {
        leave(MOTION[0], MOTION[1], MOTION[2]);
    }
    if single_precision {
        leave(
            "double precision, in linear problems and approximate inverses",
            "residuals are evaluated in double precision, which corrects the rounding; no increment is accepted on a single-precision residual",
            "half of the memory traffic of most transforms",
        );
    }
    if let Some((what, saves)) = unasked_fields(case, grid) {
        leave(&what, "not requested", &saves);
    }
    if case.stress.is_none() {
        leave("subsurface stress", "the case has no table [stress]", "its operators, depth by depth");
    }
    list
}

/// The fields that are not kept, and what they would take.
fn unasked_fields(case: &Case, grid: &SurfaceGrid) -> Option<(String, String)> {
    let unasked: Vec<_> =
        FIELDS.iter().filter(|(name, _)| !case.output.fields.iter().any(|asked| asked == name)).collect();
    let names: Vec<&str> = unasked.iter().map(|(name, _)| *name).collect();
    let bytes: usize = unasked.iter().map(|(_, bytes)| bytes * grid.len()).sum();
    let kept = case.kept_increments().len();
    let saves = format!("{bytes} bytes in each of {kept} kept increments");
    (!names.is_empty()).then(|| (format!("kept fields of {}", names.join(", ")), saves))
}

/// Increments of the stages before the first that names a tangential control; none when the first one does.
fn increments_before_a_cause(case: &Case) -> Option<usize> {
    let quiet = case.stages.iter().take_while(|stage| !stage.is_tangential());
    Some(quiet.map(Stage::increments_in_all).sum()).filter(|sum| *sum > 0)
}

/// Increments in which no stage changes the normal load.
fn increments_at_one_load(case: &Case) -> usize {
    let held = case.stages.iter().filter(|stage| stage.normal.is_none() && !stage.tilts());
    held.map(Stage::increments_in_all).sum()
}

/// The one axis along which shear acts: nothing loads the other, and either the bodies know no way across, or nothing changes
/// along an axis of a periodic case.
pub fn one_way(
    case: &Case,
    grid: &SurfaceGrid,
    response: &PairResponse,
    coupling: Coupling,
    start: Option<&ContactState>,
) -> Option<usize> {
    if coupling == Coupling::Frictionless || is_twisted(case, start) {
        return None;
    }
    let moves = |axis: usize| is_loaded(case, axis, start) || is_stretched(case, axis, start);
    let axis = match [moves(0), moves(1)] {
        [true, false] => 0,
        [false, false] if grid.dimension() == Dimension::Line => 0,
        [false, true] => 1,
        _ => return None,
    };
    let uncoupled = coupling == Coupling::Uncoupled;
    // An upper body that moves carries its own displacement along, which has a part across.
    let straight = uncoupled && response.is_straight() && !case.kinematics.is_finite();
    // Pressure moves the surface across a line contact, never along it.
    let line = |axis: usize| is_endless(case, grid, 1 - axis) || uncoupled && is_endless(case, grid, axis);
    let starts_so = start.is_none_or(|state| {
        state.shear[1 - axis].iter().all(|shear| *shear == 0.0)
            && (straight || is_the_same_along_a_line(state))
    });
    (starts_so && (straight || line(axis))).then_some(axis)
}

/// Whether a case is periodic along an axis and nothing in it changes along that, or that is the axis of a line contact.
fn is_endless(case: &Case, grid: &SurfaceGrid, axis: usize) -> bool {
    if grid.dimension() == Dimension::Line {
        return axis == 1;
    }
    let maps = case.stages.iter().filter_map(|stage| stage.friction.as_ref()).chain([&case.friction]);
    case.periodic.axes()[axis]
        && maps.into_iter().all(|friction| !friction.is_map())
        && case
            .profile
            .gap(grid)
            .lanes(Axis(axis))
            .into_iter()
            .all(|line| line.iter().all(|gap| *gap == line[0]))
}

/// Whether nothing in a state changes along one of the axes.
fn is_the_same_along_a_line(state: &ContactState) -> bool {
    let [shear_x, shear_y] = &state.shear;
    let accumulated = || state.accumulated.iter().flat_map(AccumulatedSlip::fields);
    let fields = || {
        let worn = state.worn_depth.iter().chain(&state.upper_worn_depth).chain(&state.debris);
        let worn = worn.chain(&state.plastic_depth);
        [&state.pressure, shear_x, shear_y].into_iter().chain(worn).chain(accumulated())
    };
    (0..2).any(|axis| {
        fields()
            .all(|field| field.lanes(Axis(axis)).into_iter().all(|line| line.iter().all(|q| *q == line[0])))
    })
}
