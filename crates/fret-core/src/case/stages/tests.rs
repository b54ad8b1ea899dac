//! What the judgement of histories lets pass at both ends of every range, and refuses just beyond.

mod course;

use crate::case::check::tests::{BALL, read, refused};
use crate::case::{Attachments, Case};
use crate::document::apart;
use crate::model::CoulombFriction;

/// The ball pressed with a force of 0.01 under a coefficient of 0.3, and then a second stage.
fn then(stage: &str) -> String {
    format!("{BALL}[[load]]\n{stage}\n")
}

/// A case whose files all hold this text.
fn with_file(text: &str, content: &'static str) -> Result<Case, crate::case::CaseError> {
    let files = |_: &str| Ok(content.as_bytes().to_vec());
    Case::from_toml_with(text, "case.toml", Attachments::files(&files))
}

#[test]
fn the_tolerance_of_a_history_lies_between_a_millionth_and_a_half() {
    let auto = BALL.replacen("increments = 1", "increments = \"auto\"", 1);
    let with = |tolerance: &str| format!("{auto}[solver]\nhistory_tolerance = {tolerance}\n");
    for tolerance in [1e-6, 0.5] {
        let case = read(&with(&format!("{tolerance:e}")), &[]);
        assert_eq!(case.stages[0].history_tolerance, Some(tolerance));
    }
    for tolerance in ["0.99e-6", "0.51", "nan"] {
        refused(&with(tolerance), &[], "between 1e-6 and 0.5", tolerance);
    }
    let needless = format!("{BALL}[solver]\nhistory_tolerance = 0.1\n");
    refused(&needless, &[], "every stage says its number of increments", "0.1");
    assert_eq!(read(BALL, &[]).stages[0].history_tolerance, None);
    assert_eq!(read(&auto, &[]).stages[0].history_tolerance, Some(0.03));
}

#[test]
fn a_history_has_up_to_ten_million_increments() {
    let first = |count: usize| format!("increments = {count}");
    let both = |one: usize, other: usize| {
        then(&format!("normal_force = 0.02\nincrements = {other}")).replacen(
            "= 1\n",
            &format!("= {one}\n"),
            1,
        )
    };
    for count in [1, 10_000_000] {
        read(BALL, &[("increments = 1", &first(count))]);
    }
    for count in ["0", "10000001"] {
        let change = format!("increments = {count}");
        refused(BALL, &[("increments = 1", &change)], "must lie between 1 and 10000000", count);
    }
    read(&both(4_000_000, 6_000_000), &[]);
    let in_all = |text: &str| {
        let error = Case::from_toml(text, "case.toml").unwrap_err().to_string();
        assert!(error.contains("10000001 increments in all; at most 10000000"), "{error}");
    };
    in_all(&both(4_000_000, 6_000_001));
    let cycles = |cycles: usize, increments: usize| {
        then(&format!("shift = [1e-6, 0.0]\ncycles = {cycles}\nincrements = {increments}"))
    };
    let most = read(&cycles(999_999, 10), &[("increments = 1\n", "increments = 10\n")]);
    assert_eq!(most.increments(), 10_000_000);
    in_all(&cycles(1_000_000, 10));
    read(&cycles(1_000_000, 8), &[]);
    read(&cycles(1, 4), &[]);
    for count in [0, 1_000_001] {
        let place = count.to_string();
        refused(&cycles(count, 4), &[], "must lie between 1 and 1000000", &place);
    }
    refused(&cycles(1, 3), &[], "the reversal points of this cycle need at least 4", "3");
}

#[test]
fn increments_that_are_left_to_the_program_draw_their_stage() {
    let count =
        |stage: &str| read(&then(&format!("{stage}\nincrements = \"auto\"")), &[]).stages[1].increments;
    assert_eq!(count("shift = [1e-6, 0.0]"), 16);
    assert_eq!(count("shift = [1e-6, 0.0]\ncycles = 2"), 32);
    assert_eq!(count("shift = [1e-6, 0.0]\nuntil_steady = { tolerance = 1e-3, most_cycles = 9 }"), 32);
    assert_eq!(count("shift = [1e-6, 0.0]\ncycles = 2\nwaveform = \"sine\""), 32);
    assert_eq!(count("shift = [1e-6, 0.0]\ncycles = 2\nwaveform = \"trapezoid\""), 32);
    // an increment on each flank of the trapezoid at the least: 0.5 - 0.49 of a cycle long
    let steep = count("shift = [1e-6, 0.0]\ncycles = 2\nwaveform = \"trapezoid\"\ndwell = 0.49");
    assert!((100..=101).contains(&steep), "{steep}");
    let table = then("table = \"path.csv\"\nincrements = \"auto\"");
    let case = with_file(&table, "shift_x\n1e-6\n2e-6\n0.0\n").unwrap();
    assert_eq!(case.stages[1].increments, 12);
}

#[test]
fn words_of_a_cycle_have_their_ranges() {
    let steady = |tolerance: &str, most: usize| {
        then(&format!(
            "shift = [1e-6, 0.0]\nincrements = 8\nuntil_steady = {{ tolerance = {tolerance}, most_cycles = {most} }}"
        ))
    };
    read(&steady("0.999", 1), &[]);
    read(&steady("1e-300", 1_000_000), &[]);
    for tolerance in ["0.0", "1.0", "-0.1", "nan"] {
        refused(&steady(tolerance, 9), &[], "must lie between 0 and 1, relative", tolerance);
    }
    for most in [0, 1_000_001] {
        refused(&steady("0.1", most), &[], "until_steady.most_cycles", &most.to_string());
    }
    let cycle = |words: &str| then(&format!("shift = [1e-6, 0.0]\nincrements = 4000\ncycles = 2\n{words}"));
    let trapezoid = |dwell: &str| cycle(&format!("waveform = \"trapezoid\"\ndwell = {dwell}"));
    for dwell in ["0.001", "0.499"] {
        read(&trapezoid(dwell), &[]);
    }
    for dwell in ["0.00099", "0.4991", "nan"] {
        refused(&trapezoid(dwell), &[], "must lie between 0.001 and 0.499", dwell);
    }
    refused(&cycle("waveform = \"sine\"\ndwell = 0.2"), &[], "only a trapezoid", "0.2");
    let far = "[1e-6, 1e308]"; // energies of such a motion are beyond all numbers
    refused(&then(&format!("shift = {far}\nincrements = 8\ncycles = 1\n")), &[], "1e100 at the most", far);
    read(&cycle("envelope = [0.0, 1.0]"), &[]);
    for envelope in ["[0.0, inf]", "[nan, 1.0]"] {
        refused(&cycle(&format!("envelope = {envelope}")), &[], "both shares must be finite", envelope);
    }
    let until = steady("0.1", 9);
    read(&format!("{until}envelope = [0.5, 0.5]\n"), &[]);
    let growing = format!("{until}envelope = [0.5, 1.0]\n");
    refused(&growing, &[], "amplitudes that change never become steady", "[0.5, 1.0]");
    for (key, value) in [("dwell", "0.2"), ("envelope", "[0.0, 1.0]"), ("waveform", "\"sine\"")] {
        let text = then(&format!("shift = [1e-6, 0.0]\nincrements = 8\n{key} = {value}"));
        refused(&text, &[], "the stage has no cycles", value);
    }
    for words in ["envelope = [0.0, 1.0]", "waveform = \"sine\""] {
        let text = then(&format!("table = \"path.csv\"\nincrements = 8\ncycles = 2\n{words}"));
        let error = with_file(&text, "shift_x\n1e-6\n0.0\n").unwrap_err();
        assert!(error.to_string().contains("the cycle stands in the table \"path.csv\""), "{error}");
    }
}

#[test]
fn bodies_are_pressed_first_and_every_stage_says_something() {
    let unpressed =
        Case::from_toml(&BALL.replacen("normal_force = 0.01", "shift = [1e-6, 0.0]", 1), "case.toml");
    assert!(unpressed.unwrap_err().to_string().contains("says neither normal_force nor approach"));
    for (stage, words) in [
        ("increments = 4", "load[1] (stage 2): nothing is prescribed"),
        ("increments = 4\nname = \"rest\"", "load[1] (rest): nothing is prescribed"),
    ] {
        let error = Case::from_toml(&then(stage), "case.toml").unwrap_err();
        assert!(error.to_string().contains(words), "{error}");
    }
    let changed = read(&then("increments = 4\nfriction = 0.25"), &[]);
    assert_eq!(changed.stages[1].friction.as_ref().map(CoulombFriction::largest), Some(0.25));
    assert!(changed.stages[0].friction.is_none());
}

#[test]
fn without_friction_only_forces_of_zero_act_along_the_surface() {
    let bare = |stage: &str| {
        then(&format!("{stage}\nincrements = 4")).replacen("coefficient = 0.3", "coefficient = 0.0", 1)
    };
    read(&bare("tangential_force = [0.0, 0.0]"), &[]);
    for (key, value) in [
        ("tangential_force", "[0.0, 1e-9]"),
        ("shift", "[0.0, 0.0]"),
        ("twist", "0.5"),
        ("twist_moment", "0.5"),
    ] {
        let text = bare(&format!("{key} = {value}"));
        refused(&text, &[], "a tangential load on a contact without friction", value);
    }
}

#[test]
fn forces_come_close_to_what_friction_carries_and_do_not_reach_it() {
    // mu P = 0.3 * 0.01, which 0.0018 and 0.0024 along x and y reach but for rounding; a tenth of the tolerance of 1e-8 below, they slide
    read(&then("tangential_force = [0.00299999999, 0.0]\nincrements = 4"), &[]);
    read(&then("tangential_force = [0.0018, 0.00239999999]\nincrements = 4"), &[]);
    for force in [
        "[0.003000001, 0.0]",
        "[0.0018, 0.002400001]",
        "[0.003, 0.0]",
        "[0.0018, 0.0024]",
        "[0.0029999999999, 0.0]",
    ] {
        let text = then(&format!("tangential_force = {force}\nincrements = 4"));
        refused(&text, &[], "friction carries at most mu P = 0.003", force);
    }
    // the normal force falls while the tangential one stays: at 0.006 they meet, below not
    let lifted = |force: &str| {
        let held = then("tangential_force = [0.0018, 0.0]\nincrements = 4");
        format!("{held}[[load]]\nnormal_force = {force}\nincrements = 4\n")
    };
    read(&lifted("0.0060001"), &[]);
    let words = "load[2] (stage 3).normal_force: the tangential force reaches 0.0018";
    refused(&lifted("0.005"), &[], words, "0.005");
    refused(BALL, &[("= 0.01", "= -0.01")], "load[0] (stage 1).normal_force reaches -0.01", "-0.01");
    read(BALL, &[("= 0.01", "= 0.0")]);
    // a coefficient that grows in the second stage carries more there
    let stronger = |friction: f64| {
        then(&format!("tangential_force = [0.006, 0.0]\nincrements = 4\nfriction = {friction}"))
    };
    read(&stronger(0.6001), &[]);
    refused(&stronger(0.59), &[], "mu P = 0.0059", "[0.006, 0.0]");
    // and one that was given stays for the stages that say nothing
    let later = then("friction = 0.6001\nincrements = 1");
    read(&format!("{later}[[load]]\ntangential_force = [0.006, 0.0]\nincrements = 4\n"), &[]);
}

#[test]
fn numbers_are_told_in_as_few_digits_as_tell_them_apart() {
    assert_eq!(apart(0.5, 0.25), ["0.5", "0.25"]);
    assert_eq!(apart(0.123_456_789, 0.2), ["0.123457", "0.2"]);
    assert_eq!(apart(1.000_000_01, 1.0), ["1.00000001", "1.0"]);
}
