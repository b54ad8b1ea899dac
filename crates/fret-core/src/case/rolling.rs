//! The judgement of rolling: what a rolling contact cannot be combined with, and which stages can have creepage and spin.

use std::ops::Range;

use super::control_keys::{BothOrOne, LARGEST};
use super::file::CaseFile;
use super::judge::Judge;
use super::known::Known;
use super::loading::Loading;
use super::misfits::Misfit;
use super::rolled_maps::{beyond_no_map, maps_that_travel};
use super::stage_file::{IncrementsFile, StageFile};
use crate::document::At;
use crate::model::controls::{BULK_STRESS, FREEDOMS, Kind, ROLL, TANGENTIAL, TILT};
use crate::model::stage::{Course, Stage, StageControl, along_x};
use crate::model::{Dimension, Frame, Kinematics, Shape};

/// The way out where the state to start from has rolled, in whose frame the history goes on.
const ROLLED_BEFORE: &str =
    "start from a state that has not rolled; or roll in the other frame from the beginning on";

/// Refuses what rolling cannot be combined with.
pub(super) fn rolling(judge: &mut Judge, known: &Known<'_>, kinematics: Kinematics) {
    let loading = known.loading();
    rates(judge, loading);
    if kinematics.frame == Frame::Contact {
        beyond_no_map(judge, known);
    }
    let has_rolled = judge.attachments.start.is_some_and(|start| start.roll != [0.0; 2]);
    if !(has_rolled || loading.stages().any(|stage| stage.rolls())) {
        return;
    }
    let roll = Misfit { freedoms: ROLL..FREEDOMS, motions: false, in_table: "a roll" };
    let mut refuse = |why: &str, help: &str| roll.refuse(judge, loading, why, help);
    if kinematics.is_finite() {
        refuse(
            "with kinematics.displacement = \"finite\": surfaces that roll keep pace with each other",
            "displacement = \"small\": creepage is small against the distance rolled",
        );
    }
    let periodic = known.file.grid.periodicity();
    if periodic.one_axis().is_some() {
        refuse(
            "in a case that is periodic along one axis: contacts roll where nothing repeats",
            "grid.periodic = false",
        );
    } else if !periodic.is_none() {
        refuse("in a periodic case: the contact would roll into its own image", "grid.periodic = false");
    }
    let can_roll = |shape: &Shape| shape.curvatures().is_some() || matches!(shape, Shape::Wave { .. });
    if known.profile.is_some_and(|profile| !profile.shapes.iter().all(can_roll)) {
        refuse(
            "of a profile that does not roll: it has an edge, a flat or a tip, or is a formula",
            "sphere, ellipsoid, or a cylinder without a length",
        );
    }
    if kinematics.frame == Frame::Bodies {
        let tilt = Misfit { freedoms: TILT..BULK_STRESS, motions: false, in_table: "a tilt" };
        let why = "of a contact that rolls, with kinematics.frame = \"bodies\": a tilt is about the middle of the grid, and the contact leaves it";
        let help = if has_rolled { ROLLED_BEFORE } else { "[kinematics] frame = \"contact\"" };
        tilt.refuse(judge, loading, why, help);
    }
    steady(judge, loading, kinematics);
    if kinematics.frame == Frame::Contact {
        in_the_frame_of_the_contact(judge, known.file, (loading, has_rolled));
        maps_that_travel(judge, known, kinematics);
    }
}

/// The way that a stage rolls on to a steady state, along x and y: along x where it says nothing.
pub(super) fn direction(judge: &mut Judge, file: &StageFile) -> [f64; 2] {
    let Some(given) = &file.roll_direction else { return along_x() };
    let direction = match given.value {
        BothOrOne::Both(both) => both,
        BothOrOne::Line(across) => [across, 0.0],
    };
    let is_line = judge.dimension == Dimension::Line;
    let mut refuse = |why: &str, help: &str| {
        judge.refuse::<()>(given.span(), format!("roll_direction = {direction:?}{why}"), help)
    };
    if !file.controls.are_steady() {
        refuse(
            " without roll = \"steady\"",
            "roll = [x, y]: where the contact has rolled to says the way, too",
        );
    } else if direction == [0.0; 2] || direction.iter().any(|part| !(part.abs() <= LARGEST)) {
        refuse(": must be finite, and not zero", "[0, 1] is along y, [-1, 0] against x");
    } else if is_line && direction[1] != 0.0 {
        refuse(": a line contact rolls across its line", "1 or -1");
    }
    direction
}

/// Refuses what has no steady state.
fn steady(judge: &mut Judge, loading: Loading<'_>, kinematics: Kinematics) {
    for prescribed in loading.stages().filter(|stage| stage.file.controls.are_steady()) {
        let (stage, span) = (&prescribed.file.value, prescribed.roll());
        let mut refuse = |why: &str, help: &str| {
            judge.refuse::<()>(span.clone(), format!("roll = \"steady\" {why}"), help)
        };
        if kinematics.frame == Frame::Bodies {
            refuse(
                "with kinematics.frame = \"bodies\": the contact would leave the grid",
                "frame = \"contact\"",
            );
        }
        if stage.cycles.is_some() || stage.until_steady.is_some() {
            refuse(
                "in cycles, which have no steady state of this kind",
                "no cycles; or roll = a distance, until_steady = 1e-3",
            );
        }
        if matches!(stage.increments, IncrementsFile::Auto(_)) {
            refuse("with increments = \"auto\"", "a number of increments: each ends in a steady state");
        }
        let motion = stage.controls.0.iter().find(|given| {
            (TANGENTIAL..TILT).contains(&given.row.freedom)
                && matches!(given.way.kind, Kind::Motion | Kind::FarEnd)
                && given.values.iter().any(Option::is_some)
        });
        if let Some(given) = motion {
            let why = format!("beside {}: what moves on steadily does so by distance rolled", given.way.name);
            refuse(&why, "creepage and spin, or a force");
        }
        if stage.controls.place(BULK_STRESS..ROLL).is_some() {
            refuse("beside a bulk stress that changes", "a stage for each");
        }
    }
    let mut controls = loading.files.iter().flat_map(|file| &file.controls.0);
    let by_actuator = controls.find(|given| given.way.kind == Kind::FarEnd);
    if let Some(given) = by_actuator.filter(|_| loading.is_steady()) {
        let help = "tangential_force, shift or creepage";
        judge.refuse::<()>(
            given.span(),
            "actuator in a case with roll = \"steady\": it would be left behind",
            help,
        );
    }
}

/// Refuses what is fixed to bodies that travel through the grid.
fn in_the_frame_of_the_contact(
    judge: &mut Judge,
    file: &CaseFile,
    (loading, has_rolled): (Loading<'_>, bool),
) {
    let marched = || loading.stages().filter(|stage| stage.rolls() && !stage.file.controls.are_steady());
    for stage in marched() {
        if matches!(stage.file.increments, IncrementsFile::Auto(_)) {
            judge.refuse::<()>(
                stage.roll(),
                "roll with increments = \"auto\" and kinematics.frame = \"contact\": its increments are whole cells",
                "a number of increments; one cell in each is enough",
            );
        }
    }
    // The bodies' frame has no steady state.
    let help = if has_rolled {
        ROLLED_BEFORE
    } else if loading.is_steady() {
        "roll = a distance in place of \"steady\", and frame = \"bodies\" on a grid that holds all of the way; or leave it out"
    } else {
        "frame = \"bodies\", on a grid that holds all of the way"
    };
    let mut refuse = |span: Option<Range<usize>>, what: &str| {
        if let Some(span) = span {
            let why = if has_rolled {
                "with kinematics.frame = \"contact\": the state to start from has rolled, and its places lie elsewhere on the grid"
            } else {
                "with kinematics.frame = \"contact\": it would travel through the grid, and out of it"
            };
            judge.refuse::<()>(span, format!("{what} {why}"), help);
        }
    };
    refuse(file.wear.as_ref().map(At::span), "wear");
    let evolution = file.friction.as_ref().and_then(|friction| friction.evolution.as_ref());
    refuse(evolution.map(At::span), "friction.evolution");
    for stage in marched() {
        let stress = stage.file.controls.place(BULK_STRESS..ROLL).or(stage.by_table(Stage::stretches));
        refuse(stress, "a bulk stress that changes while the contact rolls");
    }
}

/// Refuses creepage and spin where nothing, or not one way, is rolled.
fn rates(judge: &mut Judge, loading: Loading<'_>) {
    let is_rate = |control: &StageControl| matches!(control, StageControl::Rate(_));
    for stage in loading.stages() {
        if let Some(table) = stage.by_table(|stage| stage.controls().any(is_rate)) {
            judge.refuse::<()>(
                table,
                "a table with a column of creepage or spin: they are the same all along a stage",
                "a stage for each value; or shift_x, the creepage summed over the distance rolled",
            );
        }
        let in_cycles = |stage: &Stage| !stage.steady && matches!(stage.course, Course::Cycles(_));
        for given in stage.file.controls.0.iter().filter(|given| given.way.kind == Kind::Rate) {
            let name = given.way.name;
            if stage.file.controls.of("roll").is_none() {
                judge.refuse::<()>(
                    given.span(),
                    format!("{name} without roll in its stage: it is a motion by distance rolled"),
                    "roll = [x, y], the distance rolled at the end of the stage",
                );
            } else if stage.checked.is_some_and(in_cycles) {
                judge.refuse::<()>(
                    given.span(),
                    format!("{name} in cycles: it is the same all along a stage"),
                    "prescribe a force, or a shift, which may have cycles",
                );
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::check::tests::{BALL, ROLLER, read, refused};
    use crate::case::{Attachments, Case};

    fn with(stage: &str) -> String {
        format!("increments = 1\n[[load]]\n{stage}\nincrements = 4\n")
    }

    #[test]
    fn what_cannot_roll_is_refused() {
        let rolled = with("roll = 1.0\ncreepage = [1e-4, 0.0]");
        let case = read(ROLLER, &[("increments = 1\n", &rolled)]);
        assert!(case.stages[1].rolls());
        let alone = with("creepage = [1e-4, 0.0]");
        refused(ROLLER, &[("increments = 1\n", &alone)], "a motion by distance rolled", "[1e-4, 0.0]");
        let to_and_fro = with("roll = 1.0\ncreepage = [1e-4, 0.0]\ncycles = 2");
        refused(ROLLER, &[("increments = 1\n", &to_and_fro)], "the same all along a stage", "[1e-4, 0.0]");
        let finite = ("[friction]", "[kinematics]\ndisplacement = \"finite\"\n[friction]");
        let one = with("roll = 1.0");
        refused(ROLLER, &[finite, ("increments = 1\n", &one)], "keep pace with each other", "1.0");
        let contact = ("[friction]", "[kinematics]\nframe = \"contact\"\n[friction]");
        let worn = with("roll = 1.0") + "[wear]\ncoefficient = 1e-3\n";
        refused(ROLLER, &[contact, ("increments = 1\n", &worn)], "travel through the grid", "[wear]");
        let auto = "increments = 1\n[[load]]\nroll = 1.0\nincrements = \"auto\"\n";
        refused(ROLLER, &[contact, ("increments = 1\n", auto)], "whole cells", "1.0");
        let punch =
            ("[profile.cylinder]\nradius = 100.0\naxis = \"y\"", "[profile.flat_punch]\nradius = 0.5");
        refused(ROLLER, &[punch, ("increments = 1\n", &one)], "an edge, a flat or a tip", "1.0");
        // The upper body may turn as it will.
        let ball = "increments = 1\n[[load]]\nroll = [1.0, 0.0]\ntwist_moment = 0.0\nincrements = 4\n";
        assert!(read(BALL, &[("increments = 1", ball)]).stages[1].rolls());
        let tilted = with("roll = 1.0\ntilt = 1e-3");
        refused(ROLLER, &[("increments = 1\n", &tilted)], "middle of the grid", "1e-3");
    }

    /// What travels through the grid is sent to the frame of the bodies; a steady state, which has none there, to a distance.
    #[test]
    fn the_way_out_of_a_refusal_is_one() {
        let contact = ("[friction]", "[kinematics]\nframe = \"contact\"\n[friction]");
        let wear = "[wear]\ncoefficient = 1e-9\n";
        let message = |edits: &[(&str, &str)]| {
            let text = edits.iter().fold(ROLLER.to_owned(), |text, (from, to)| text.replacen(from, to, 1));
            Case::from_toml(&text, "case.toml").map(|_| ()).map_err(|error| error.to_string())
        };
        for roll in ["roll = 0.5", "roll = 0.5\ncycles = 3"] {
            let rolled = with(roll) + wear;
            let error = message(&[contact, ("increments = 1\n", &rolled)]).unwrap_err();
            assert!(
                error.contains("frame = \"bodies\", on a grid") && !error.contains("in place of"),
                "{error}"
            );
            message(&[("increments = 1\n", &rolled)]).unwrap();
        }
        let steady = with("roll = \"steady\"") + wear;
        let error = message(&[("increments = 1\n", &steady)]).unwrap_err();
        assert!(
            error.contains("roll = a distance in place of \"steady\"") && error.contains("[wear]"),
            "{error}"
        );
    }

    /// The columns of a table prescribe what keys do.
    #[test]
    fn what_cannot_roll_by_a_key_cannot_by_a_table() {
        let text = |increments: &str| {
            let stage = format!("increments = 1\n[[load]]\ntable = \"way.csv\"\nincrements = {increments}\n");
            BALL.replacen("increments = 1\n", &stage, 1).replacen(
                "[friction]",
                "[kinematics]\nframe = \"contact\"\n[friction]",
                1,
            )
        };
        for (table, increments, why) in [
            ("roll_x\n0.5\n1.0\n", "\"auto\"", "whole cells"),
            ("roll_x,bulk_stress_x\n0.5,1e-3\n1.0,0.0\n", "4", "changes while the contact rolls"),
        ] {
            let file = |_: &str| Ok(table.as_bytes().to_vec());
            let read = Case::from_toml_with(&text(increments), "case.toml", Attachments::files(&file));
            let message = read.unwrap_err().to_string();
            assert!(message.contains(why), "{table}: {message}");
        }
    }

    #[test]
    fn what_has_no_steady_state_is_refused() {
        let steady = with("roll = \"steady\"\ncreepage = [1e-4, 0.0]");
        let case = read(ROLLER, &[("increments = 1\n", &steady)]);
        assert!(case.stages[1].steady && case.stages[1].rates() == [Some(1e-4), Some(0.0), None]);
        // the grid goes with it
        assert_eq!(case.kinematics.frame, Frame::Contact);
        let bodies = ("[friction]", "[kinematics]\nframe = \"bodies\"\n[friction]");
        refused(ROLLER, &[bodies, ("increments = 1\n", &steady)], "would leave the grid", "\"steady\"");
        let driven = with("roll = \"steady\"\nshift = [1e-4, 0.0]");
        refused(ROLLER, &[("increments = 1\n", &driven)], "does so by distance rolled", "\"steady\"");
        let auto = "increments = 1\n[[load]]\nroll = \"steady\"\nincrements = \"auto\"\n";
        refused(ROLLER, &[("increments = 1\n", auto)], "increments = \"auto\"", "\"steady\"");
        let to_nowhere = with("roll = \"steady\"\nroll_direction = 0.0");
        refused(ROLLER, &[("increments = 1\n", &to_nowhere)], "not zero", "0.0");
        let along_the_line = with("roll = \"steady\"\nroll_direction = [0.0, 1.0]");
        refused(ROLLER, &[("increments = 1\n", &along_the_line)], "across its line", "[0.0, 1.0]");
        let so_far = with("roll = 1.0\nroll_direction = -1.0");
        refused(ROLLER, &[("increments = 1\n", &so_far)], "without roll = \"steady\"", "-1.0");
        let cycles = with("roll = \"steady\"\ncycles = 3");
        refused(ROLLER, &[("increments = 1\n", &cycles)], "no steady state", "\"steady\"");
    }
}
