//! What is left out changes the work, never the answer: every shortcut against the same run without it, and against the run
//! that computes everything. `docs/leaving-out.md` is the table of the same scenes on finer grids.

use fret_core::plan::{LeaveOut, Shortcut};
use fret_validation::shortcuts::{TOLERANCE, difference, scenes, solved};

/// A residual of one tolerance leaves an error of the tractions of at most about a hundred: it is measured in the mean over the
/// cells, the error in the worst one.
const AGREES: f64 = 100.0 * TOLERANCE;

#[test]
fn leaving_out_changes_the_work_and_not_the_answer() {
    for scene in scenes(32) {
        let name = scene.name;
        let short = solved(&scene.text, LeaveOut::ALL).history;
        let full = solved(&scene.text, LeaveOut::NONE).history;
        let everything = difference(&full, &short);
        assert!(everything < AGREES, "{name}: {everything:e}");
        let (least, most) = (short.work(), full.work());
        assert!(
            least.full_grid_convolutions < 1.1 * most.full_grid_convolutions,
            "{name}: {least:?} {most:?}"
        );
        let Some(shortcut) = scene.shortcut else {
            assert!(3.0 * least.full_grid_convolutions < most.full_grid_convolutions, "{name}");
            continue;
        };
        let without = solved(&scene.text, LeaveOut::all_but(shortcut)).history;
        let alone = difference(&without, &short);
        println!("{name}: {shortcut:?} {alone:e}, all {everything:e}");
        assert!(alone < AGREES, "{name}: {alone:e}");
        let more = without.work();
        match shortcut {
            // Nothing is approximated: the same numbers are reached by one convolution an increment more.
            Shortcut::Pressure => {
                assert!(least.convolutions + 7 <= more.convolutions, "{name}: {least:?} {more:?}");
            }
            // A convolution of a half or a quarter of the cells.
            Shortcut::Mirror => {
                assert!(1.6 * least.full_grid_convolutions < more.full_grid_convolutions, "{name}");
            }
            Shortcut::Box => {
                assert!(2.0 * least.full_grid_convolutions < more.full_grid_convolutions, "{name}");
            }
            // Shear that nothing causes is none: to the bit.
            Shortcut::Tangential if name.contains("pressed alone") => assert_eq!(alone, 0.0, "{name}"),
            // Other roundings, on a way as long.
            Shortcut::Digits => {
                assert!(alone > 0.0, "{name}");
                let most = 1.1 * more.full_grid_convolutions;
                assert!(least.full_grid_convolutions < most, "{name}: {least:?} {more:?}");
            }
            Shortcut::Tangential | Shortcut::LayeredResponse | Shortcut::Coupling | Shortcut::Transverse => {}
        }
    }
}

#[test]
fn what_is_left_out_is_said_and_nothing_is_said_of_what_is_computed() {
    use fret_core::case::Case;
    use fret_core::plan::Plan;
    let phrases = [
        (Shortcut::LayeredResponse, "layered response"),
        (Shortcut::Coupling, "coupling of pressure and shear"),
        (Shortcut::Tangential, "before anything causes shear"),
        (Shortcut::Pressure, "normal problem while"),
        (Shortcut::Transverse, "shear along y"),
        (Shortcut::Mirror, "three quarters of the grid"),
        (Shortcut::Box, "cells far from the contact"),
        (Shortcut::Digits, "all but six digits"),
    ];
    let text = &scenes(64).pop().expect("the last has all").text;
    let said = |leave_out| {
        let case = Case::from_toml(text, "case.toml").unwrap_or_else(|error| panic!("{error}"));
        let plan = Plan::leaving_out(case, leave_out).unwrap_or_else(|error| panic!("{error}"));
        let named = phrases.map(|(_, phrase)| plan.left_out.iter().any(|item| item.what.contains(phrase)));
        (named, plan.left_out)
    };
    assert_eq!(said(LeaveOut::ALL).0, [true; 8], "{:?}", said(LeaveOut::ALL).1);
    assert_eq!(said(LeaveOut::NONE).0, [false; 8], "{:?}", said(LeaveOut::NONE).1);
    for (index, (shortcut, _)) in phrases.into_iter().enumerate() {
        assert!(!said(LeaveOut::all_but(shortcut)).0[index], "{shortcut:?}");
    }
}
