//! The judgement of the phases of a cycle's controls [degrees].

use std::ops::Range;

use toml::Spanned;

use super::along::AlongFile;
use super::axis::AxisFile;
use super::judge::Judge;
use super::stage_file::{PhaseFile, StageFile};

/// Phases of the controls [degrees]; 0 where none is given.
#[derive(Default)]
pub(super) struct Phases {
    /// Normal, along x, along y, about z.
    pub rigid: [f64; 4],
    /// Tilt along x and y.
    pub tilt: [f64; 2],
    /// Bulk stress of the lower and the upper body along x and y.
    pub bulk_stress: [[f64; 2]; 2],
}

/// The phases of a stage.
pub(super) fn phases(judge: &mut Judge, place: &str, file: &StageFile) -> Phases {
    let mut phases = Phases::default();
    let Some(given) = &file.phase else { return phases };
    let PhaseFile {
        normal_force,
        approach,
        tangential_force,
        shift,
        actuator,
        actuator_approach,
        twist_moment,
        twist,
        tilt_moment,
        tilt,
        bulk_stress,
        upper_bulk_stress,
    } = given.get_ref();
    let scalars = [
        (0, "normal_force", normal_force, file.normal_force.is_some()),
        (0, "approach", approach, file.approach.is_some()),
        (0, "actuator_approach", actuator_approach, file.actuator_approach.is_some()),
        (3, "twist_moment", twist_moment, file.twist_moment.is_some()),
        (3, "twist", twist, file.twist.is_some()),
    ];
    for (index, key, phase, there) in scalars {
        let Some(phase) = phase else { continue };
        if usable(judge, place, key, &[*phase.get_ref()], there, phase.span()) {
            phases.rigid[index] = *phase.get_ref();
        }
    }
    let mut read =
        |key, phase: Option<([f64; 2], Range<usize>)>, control: Option<[AxisFile; 2]>, to: &mut [f64]| {
            let Some((phase, span)) = phase else { return };
            if usable(judge, place, key, &phase, control.is_some(), span) {
                for axis in 0..2 {
                    if control.is_some_and(|control| control[axis] != AxisFile::Held) {
                        to[axis] = phase[axis];
                    }
                }
            }
        };
    let pairs = [
        ("tangential_force", tangential_force, &file.tangential_force),
        ("shift", shift, &file.shift),
        ("actuator", actuator, &file.actuator),
    ];
    for (key, phase, control) in pairs {
        let phase = phase.as_ref().map(|phase| (phase.get_ref().0, phase.span()));
        read(key, phase, control.as_ref().map(|control| control.get_ref().0), &mut phases.rigid[1..3]);
    }
    let Phases { tilt: tilted, bulk_stress: [lower, upper], .. } = &mut phases;
    let mut one = |key,
                   phase: &Option<Spanned<AlongFile<f64>>>,
                   control: &Option<Spanned<AlongFile<AxisFile>>>,
                   to: &mut [f64]| {
        let phase = phase.as_ref().map(|phase| (phase.get_ref().values(0.0), phase.span()));
        read(key, phase, control.as_ref().map(|control| control.get_ref().values(AxisFile::Held)), to);
    };
    one("tilt_moment", tilt_moment, &file.tilt_moment, tilted);
    one("tilt", tilt, &file.tilt, tilted);
    one("bulk_stress", bulk_stress, &file.bulk_stress, lower);
    one("upper_bulk_stress", upper_bulk_stress, &file.upper_bulk_stress, upper);
    phases
}

fn usable(judge: &mut Judge, place: &str, key: &str, phase: &[f64], there: bool, span: Range<usize>) -> bool {
    let refused = if !there {
        Some((
            format!("{place}.phase.{key}: this stage has no {key}"),
            "phases are named like their controls",
        ))
    } else if phase.iter().any(|value| !value.is_finite()) {
        Some((
            format!("{place}.phase.{key} = {phase:?}: must be finite"),
            "in degrees: 90 is a quarter of a cycle",
        ))
    } else {
        None
    };
    if let Some((message, help)) = refused {
        judge.refuse::<()>(span, message, help);
        return false;
    }
    true
}
