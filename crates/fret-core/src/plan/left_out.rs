//! What a scene does not need, why, and what that saves.

use super::{LeaveOut, LeftOut, Shortcut};
use crate::case::Case;
use crate::model::{Body, SurfaceGrid};
use crate::solver::Coupling;

/// Names of the fields that can be kept, with their bytes a cell.
const FIELDS: [(&str, usize); 5] = [("pressure", 8), ("shear", 16), ("slip", 16), ("gap", 8), ("zone", 1)];

/// The list of what is left out of a case that may take the shortcuts of `leave_out`.
pub fn left_out(case: &Case, grid: &SurfaceGrid, coupling: Coupling, leave_out: LeaveOut) -> Vec<LeftOut> {
    let mut list = Vec::new();
    let mut leave = |what: &str, why: &str, saves: &str| {
        list.push(LeftOut { what: what.to_owned(), why: why.to_owned(), saves: saves.to_owned() });
    };
    let homogeneous = |body: &Body| match body {
        Body::Rigid => true,
        Body::Elastic(half_space) => half_space.single_material().is_some(),
    };
    let plain = homogeneous(case.bodies.upper()) && homogeneous(case.bodies.lower());
    if plain && leave_out.takes(Shortcut::LayeredResponse) {
        leave(
            "layered response",
            "no body has a coating that differs from what lies below it",
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
                "the bodies answer a shear with equal normal displacements, so pressure does not depend on shear"
            };
            leave("coupling of pressure and shear", why, "two of six kernels and every coupled iteration");
        }
        Coupling::Coupled => {}
    }
    if coupling == Coupling::Uncoupled
        && leave_out.takes(Shortcut::Tangential)
        && let Some(increments) = increments_before_a_cause(case)
    {
        leave(
            "tangential equations before anything causes shear",
            "no tangential force, shift or twist has been asked for so far",
            &format!("every tangential iteration of the first {increments} increments"),
        );
    }
    if coupling != Coupling::Coupled && leave_out.takes(Shortcut::Pressure) {
        let increments = increments_at_one_load(case);
        if increments > 0 {
            leave(
                "normal problem while the pressure cannot change",
                "the normal load stays and shear does not act on pressure",
                &format!("the pressure, the gap and the edge of contact in {increments} increments"),
            );
        }
    }
    if !case.periodic && leave_out.takes(Shortcut::Box) {
        leave(
            "cells far from the contact, in the iterations",
            "they carry nothing; whether the surfaces overlap there is checked once the box is solved",
            "the share of the grid outside the box, in every iteration",
        );
    }
    let unasked: Vec<_> =
        FIELDS.iter().filter(|(name, _)| !case.output.fields.iter().any(|asked| asked == name)).collect();
    if !unasked.is_empty() {
        let names: Vec<&str> = unasked.iter().map(|(name, _)| *name).collect();
        let bytes: usize = unasked.iter().map(|(_, bytes)| bytes * grid.len()).sum();
        let kept = case.kept_increments().len();
        leave(
            &format!("kept fields of {}", names.join(", ")),
            "nobody asked for them",
            &format!("{bytes} bytes in each of {kept} kept increments"),
        );
    }
    if case.stress.is_none() {
        leave("stress under the surface", "the case has no table [stress]", "its operators, depth by depth");
    }
    list
}

/// Increments of the stages before the first that names a tangential control; none when the first one does.
fn increments_before_a_cause(case: &Case) -> Option<usize> {
    let quiet = case.stages.iter().take_while(|stage| stage.tangential.is_none() && stage.twist.is_none());
    Some(quiet.map(|stage| stage.increments_in_all()).sum()).filter(|sum| *sum > 0)
}

/// Increments in which no stage changes the normal load.
fn increments_at_one_load(case: &Case) -> usize {
    let held = case.stages.iter().filter(|stage| stage.normal.is_none());
    held.map(|stage| stage.increments_in_all()).sum()
}
