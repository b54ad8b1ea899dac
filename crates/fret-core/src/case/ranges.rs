//! Tests: what the judgement of a case lets pass at both ends of every range, and refuses just beyond; and entries of which one makes
//! another senseless. The ranges are those that its own words and the pages name.

use super::{Attachments, Case, GridSize, apart, walk};
use crate::model::{Control, CoulombFriction};

const BALL: &str = "\
[grid]
cells = [64, 64]
size = [4.0, 4.0]
[upper]
rigid = true
[lower]
substrate = { young = 1.0, poisson = 0.3 }
[profile.sphere]
radius = 100.0
[friction]
coefficient = 0.5
[[load]]
normal_force = 0.01
increments = 4
";

const LINE: &str = "\
[grid]
cells = 64
size = 4.0
[upper]
rigid = true
[lower]
substrate = { young = 1.0, poisson = 0.3 }
[profile.cylinder]
radius = 100.0
axis = \"y\"
[friction]
coefficient = 0.5
[[load]]
normal_force = 0.01
increments = 4
";

/// The ball with a change.
fn ball(from: &str, to: &str) -> String {
    assert!(BALL.contains(from), "{from}");
    BALL.replacen(from, to, 1)
}

fn line(from: &str, to: &str) -> String {
    assert!(LINE.contains(from), "{from}");
    LINE.replacen(from, to, 1)
}

/// The ball pressed, and then a second stage.
fn then(stage: &str) -> String {
    format!("{BALL}[[load]]\n{stage}\n")
}

fn accepted(text: &str) -> Case {
    Case::from_toml(text, "case.toml").unwrap_or_else(|error| panic!("{text}\n{error}"))
}

/// One mistake with these words.
fn refused(text: &str, words: &str) {
    let Err(error) = Case::from_toml(text, "case.toml") else { panic!("accepted:\n{text}") };
    let messages: Vec<&str> = error.mistakes().iter().map(|mistake| mistake.message.as_str()).collect();
    assert!(matches!(messages[..], [one] if one.contains(words)), "{text}\n{messages:?}, not {words:?}");
}

#[test]
fn cells_are_four_to_16384_a_side_and_two_to_the_26_in_all() {
    for cells in [[4, 4], [16384, 4], [4, 16384], [16384, 4096]] {
        let text = ball("[64, 64]", &format!("{cells:?}"));
        let text = text.replacen("[4.0, 4.0]", &format!("[{}.0, {}.0]", cells[0], cells[1]), 1);
        assert_eq!(accepted(&text).cells, cells);
    }
    for cells in ["[3, 4]", "[4, 3]", "[16385, 4]", "[4, 16385]"] {
        refused(&ball("[64, 64]", cells), "each side needs between 4 and 16384 cells");
    }
    refused(&ball("[64, 64]", "[16384, 4097]"), "more than 67108864 cells in all");
    for cells in [4, 16384] {
        assert_eq!(accepted(&line("cells = 64", &format!("cells = {cells}"))).cells, [cells, 1]);
    }
    for cells in [3, 16385] {
        let text = line("cells = 64", &format!("cells = {cells}"));
        refused(&text, "a line contact needs between 4 and 16384 cells");
    }
}

#[test]
fn sizes_are_positive_and_their_powers_are_numbers() {
    for side in ["0.0", "-1.0", "inf", "nan"] {
        refused(&ball("[4.0, 4.0]", &format!("[4.0, {side}]")), "both must be positive finite lengths");
        refused(&ball("[4.0, 4.0]", &format!("[{side}, 4.0]")), "both must be positive finite lengths");
        refused(&line("4.0", side), "must be a length between");
    }
    // 1e-100 itself is not the inverse of 1e100 to the last digit
    for side in ["1e100", "1.000001e-100"] {
        accepted(&ball("[4.0, 4.0]", &format!("[{side}, {side}]")));
        accepted(&line("4.0", side));
    }
    for side in ["1.000001e100", "9.99999e-101"] {
        refused(&ball("[4.0, 4.0]", &format!("[{side}, {side}]")), "each side must lie between");
        refused(&line("4.0", side), "must be a length between");
    }
    let GridSize::Given(sides) = accepted(LINE).size else { panic!("a size is given") };
    assert_eq!(sides, [4.0, 4.0 / 64.0]);
    refused(&line("4.0", "[4.0, 4.0]"), "two side lengths, but a single number of cells");
    refused(&ball("[4.0, 4.0]", "4.0"), "one length, but two numbers of cells");
}

#[test]
fn cells_are_up_to_a_million_times_as_long_as_wide() {
    // powers of two, so that the ratio is exact
    for (cells, sides, good) in [
        ("[64, 64]", "[1e6, 1.0]", true),
        ("[64, 64]", "[1.0, 1e6]", true),
        ("[64, 64]", "[1.000001e6, 1.0]", false),
        ("[64, 64]", "[1.0, 1.000001e6]", false),
        ("[128, 64]", "[2e6, 1.0]", true),
        ("[64, 128]", "[1e6, 1.0]", false),
        ("[64, 128]", "[1.0, 2e6]", true),
        ("[128, 64]", "[1.0, 1e6]", false),
    ] {
        let text = ball("[64, 64]", cells).replacen("[4.0, 4.0]", sides, 1);
        if good {
            accepted(&text);
        } else {
            refused(&text, "times as long as wide");
        }
    }
}

#[test]
fn sizes_are_left_to_the_program_only_where_nothing_is_given_over_cells() {
    assert_eq!(accepted(&ball("[4.0, 4.0]", "\"auto\"")).size, GridSize::Auto);
    let rows = vec![vec![0.0; 4]; 4];
    let rough = ball("[64, 64]", "[4, 4]").replacen(
        "[profile.sphere]",
        &format!("[profile.heights]\nvalues = {rows:?}\n[profile.sphere]"),
        1,
    );
    accepted(&rough);
    refused(&rough.replacen("[4.0, 4.0]", "\"auto\"", 1), "\"auto\" with heights or a friction map");
}

#[test]
fn tolerances_lie_where_they_serve() {
    assert_eq!(accepted(BALL).tolerance, 1e-8);
    for tolerance in ["1e-13", "1e-2"] {
        let case = accepted(&format!("{BALL}[solver]\ntolerance = {tolerance}\n"));
        assert_eq!(case.tolerance, tolerance.parse::<f64>().unwrap());
    }
    for tolerance in ["0.99e-13", "1.01e-2", "-1e-8", "nan"] {
        let text = format!("{BALL}[solver]\ntolerance = {tolerance}\n");
        refused(&text, "must lie between 1e-13 and 1e-2");
    }
    for tolerance in ["1e-6", "0.5"] {
        let text = ball("increments = 4", "increments = \"auto\"");
        let case = accepted(&format!("{text}[solver]\nhistory_tolerance = {tolerance}\n"));
        assert_eq!(case.stages[0].history_tolerance, Some(tolerance.parse::<f64>().unwrap()));
    }
    for tolerance in ["0.99e-6", "0.51", "nan"] {
        let text = ball("increments = 4", "increments = \"auto\"");
        refused(&format!("{text}[solver]\nhistory_tolerance = {tolerance}\n"), "between 1e-6 and 0.5");
    }
    refused(
        &format!("{BALL}[solver]\nhistory_tolerance = 0.1\n"),
        "every stage says its number of increments",
    );
    assert_eq!(accepted(BALL).stages[0].history_tolerance, None);
    let auto = accepted(&ball("increments = 4", "increments = \"auto\""));
    assert_eq!(auto.stages[0].history_tolerance, Some(0.03));
}

#[test]
fn fields_are_known_and_kept_once() {
    let output = |words: &str| format!("{BALL}[output]\n{words}\n");
    assert_eq!(accepted(BALL).output.fields, ["pressure", "shear", "slip", "zone"]);
    assert_eq!(accepted(&output("fields = [\"slip\", \"gap\", \"slip\"]")).output.fields, ["slip", "gap"]);
    refused(&output("fields = [\"slip\", \"slips\"]"), "no field is called \"slips\"");
    assert_eq!(accepted(&output("every = 1")).output.every, Some(1));
    assert_eq!(accepted(BALL).output.every, None);
    refused(&output("every = 0"), "output.every = 0: must be at least 1");
}

#[test]
fn a_history_has_up_to_ten_million_increments() {
    let both = |first: usize, second: usize| {
        let text = ball("increments = 4", &format!("increments = {first}"));
        format!("{text}[[load]]\nnormal_force = 0.02\nincrements = {second}\n")
    };
    accepted(&ball("increments = 4", "increments = 1"));
    accepted(&ball("increments = 4", "increments = 10000000"));
    refused(&ball("increments = 4", "increments = 0"), "must lie between 1 and 10000000");
    refused(&ball("increments = 4", "increments = 10000001"), "must lie between 1 and 10000000");
    accepted(&both(4_000_000, 6_000_000));
    refused(&both(4_000_000, 6_000_001), "10000001 increments in all; at most 10000000");
    let cycles = |cycles: usize, increments: usize| {
        then(&format!("shift = [1e-6, 0.0]\ncycles = {cycles}\nincrements = {increments}"))
    };
    let text = cycles(999_999, 10).replacen("increments = 4", "increments = 10", 1);
    assert_eq!(accepted(&text).increments(), 10_000_000);
    let text = cycles(1_000_000, 10).replacen("increments = 4", "increments = 1", 1);
    refused(&text, "10000001 increments in all");
    accepted(&cycles(1_000_000, 8));
    accepted(&cycles(1, 4));
    refused(&cycles(0, 4), "cycles = 0: must lie between 1 and 1000000");
    refused(&cycles(1_000_001, 4), "cycles = 1000001: must lie between 1 and 1000000");
    refused(&cycles(1, 3), "the turns of this cycle need at least 4");
}

#[test]
fn increments_that_are_left_to_the_program_draw_their_stage() {
    let count =
        |stage: &str| accepted(&then(&format!("{stage}\nincrements = \"auto\""))).stages[1].increments;
    assert_eq!(count("shift = [1e-6, 0.0]"), 16);
    assert_eq!(count("shift = [1e-6, 0.0]\ncycles = 2"), 32);
    assert_eq!(count("shift = [1e-6, 0.0]\nuntil_steady = { tolerance = 1e-3, most_cycles = 9 }"), 32);
    assert_eq!(count("shift = [1e-6, 0.0]\ncycles = 2\nwaveform = \"sine\""), 32);
    assert_eq!(count("shift = [1e-6, 0.0]\ncycles = 2\nwaveform = \"trapezoid\""), 32);
    // an increment on each flank of the trapezoid at the least: 0.5 - 0.49 of a cycle long
    let steep = count("shift = [1e-6, 0.0]\ncycles = 2\nwaveform = \"trapezoid\"\ndwell = 0.49");
    assert!((100..=101).contains(&steep), "{steep}");
    let files = |_: &str| Ok(b"shift_x\n1e-6\n2e-6\n0.0\n".to_vec());
    let text = then("table = \"path.csv\"\nincrements = \"auto\"");
    let case = Case::from_toml_with(&text, "case.toml", Attachments::files(&files)).unwrap();
    assert_eq!(case.stages[1].increments, 12);
}

#[test]
fn words_of_a_cycle_have_their_ranges() {
    let steady = |tolerance: &str, most: usize| {
        then(&format!(
            "shift = [1e-6, 0.0]\nincrements = 8\nuntil_steady = {{ tolerance = {tolerance}, most_cycles = {most} }}"
        ))
    };
    accepted(&steady("0.999", 1));
    accepted(&steady("1e-300", 1_000_000));
    for tolerance in ["0.0", "1.0", "-0.1", "nan"] {
        refused(&steady(tolerance, 9), "must lie between 0 and 1, relative");
    }
    for most in [0, 1_000_001] {
        refused(&steady("0.1", most), "until_steady.most_cycles");
    }
    let cycle = |words: &str| then(&format!("shift = [1e-6, 0.0]\nincrements = 4000\ncycles = 2\n{words}"));
    for dwell in ["0.001", "0.499"] {
        accepted(&cycle(&format!("waveform = \"trapezoid\"\ndwell = {dwell}")));
    }
    for dwell in ["0.00099", "0.4991", "nan"] {
        let text = cycle(&format!("waveform = \"trapezoid\"\ndwell = {dwell}"));
        refused(&text, "must lie between 0.001 and 0.499");
    }
    refused(&cycle("waveform = \"sine\"\ndwell = 0.2"), "only a trapezoid");
    accepted(&cycle("envelope = [0.0, 1.0]"));
    refused(&cycle("envelope = [0.0, inf]"), "both shares must be finite");
    refused(&cycle("envelope = [nan, 1.0]"), "both shares must be finite");
    let until = steady("0.1", 9);
    accepted(&format!("{until}envelope = [0.5, 0.5]\n"));
    refused(&format!("{until}envelope = [0.5, 1.0]\n"), "amplitudes that change never become steady");
    for words in ["dwell = 0.2", "envelope = [0.0, 1.0]", "waveform = \"sine\""] {
        let text = then(&format!("shift = [1e-6, 0.0]\nincrements = 8\n{words}"));
        refused(&text, "the stage has no cycles");
    }
    for words in ["envelope = [0.0, 1.0]", "waveform = \"sine\""] {
        let files = |_: &str| Ok(b"shift_x\n1e-6\n0.0\n".to_vec());
        let text = then(&format!("table = \"path.csv\"\nincrements = 8\ncycles = 2\n{words}"));
        let error = Case::from_toml_with(&text, "case.toml", Attachments::files(&files)).unwrap_err();
        assert!(error.to_string().contains("the cycle stands in the table \"path.csv\""), "{error}");
    }
}

#[test]
fn bodies_are_pressed_first_and_every_stage_says_something() {
    refused(&ball("normal_force = 0.01", "shift = [1e-6, 0.0]"), "says neither normal_force nor approach");
    refused(&then("increments = 4"), "load[1] (stage 2): nothing is prescribed");
    let changed = accepted(&then("increments = 4\nfriction = 0.25"));
    assert_eq!(changed.stages[1].friction.as_ref().map(CoulombFriction::largest), Some(0.25));
    assert!(changed.stages[0].friction.is_none());
    refused(&then("increments = 4\nname = \"rest\""), "load[1] (rest): nothing is prescribed");
}

#[test]
fn without_friction_only_forces_of_zero_act_along_the_surface() {
    let bare = |stage: &str| {
        then(&format!("{stage}\nincrements = 4")).replacen("coefficient = 0.5", "coefficient = 0.0", 1)
    };
    accepted(&bare("tangential_force = [0.0, 0.0]"));
    for stage in ["tangential_force = [0.0, 1e-9]", "shift = [0.0, 0.0]", "twist = 0.0", "twist_moment = 0.0"]
    {
        refused(&bare(stage), "a tangential load on a contact without friction");
    }
}

#[test]
fn forces_reach_what_friction_carries_and_no_more() {
    // mu P = 0.5 * 0.01, a double that 0.003 and 0.004 along x and y reach but for rounding
    accepted(&then("tangential_force = [0.005, 0.0]\nincrements = 4"));
    accepted(&then("tangential_force = [0.003, 0.004]\nincrements = 4"));
    for stage in ["tangential_force = [0.005000001, 0.0]", "tangential_force = [0.003, 0.004000001]"] {
        refused(&then(&format!("{stage}\nincrements = 4")), "friction carries at most mu P = 0.005");
    }
    // the normal force falls while the tangential one stays: at 0.006 they meet, below not
    let lifted = |force: f64| {
        let held = then("tangential_force = [0.003, 0.0]\nincrements = 4");
        format!("{held}[[load]]\nnormal_force = {force}\nincrements = 4\n")
    };
    accepted(&lifted(0.006));
    refused(&lifted(0.005), "load[2] (stage 3).normal_force: the tangential force reaches 0.003");
    refused(&ball("0.01", "-0.01"), "load[0] (stage 1).normal_force reaches -0.01");
    accepted(&ball("0.01", "0.0"));
    // a coefficient that grows in the second stage carries more there
    accepted(&then("tangential_force = [0.006, 0.0]\nincrements = 4\nfriction = 0.6"));
    refused(&then("tangential_force = [0.006, 0.0]\nincrements = 4\nfriction = 0.59"), "mu P = 0.0059");
    // and one that was given stays for the stages that say nothing
    let later = then("friction = 0.6\nincrements = 1");
    accepted(&format!("{later}[[load]]\ntangential_force = [0.006, 0.0]\nincrements = 4\n"));
}

#[test]
fn numbers_are_told_in_as_few_digits_as_tell_them_apart() {
    assert_eq!(apart(0.5, 0.25), ["0.5", "0.25"]);
    assert_eq!(apart(0.123_456_789, 0.2), ["0.123457", "0.2"]);
    assert_eq!(apart(1.000_000_01, 1.0), ["1.00000001", "1.0"]);
}

#[test]
fn a_walk_visits_the_first_and_the_last_cycle() {
    let text = then("tangential_force = [0.004, 0.0]\nincrements = 4\ncycles = 5\nenvelope = [0.25, 1.0]");
    let case = accepted(&text);
    let mut forces = Vec::new();
    walk(case.start.as_ref(), &case.stages, |stage, [_, x, ..]| {
        if let (1, Some(Control::Force(force))) = (stage, x) {
            forces.push((force / 0.004 * 80.0).round());
        }
    });
    // the triangle 1, 0, -1, 0 times a share that grows from a quarter by 3/80 an increment
    assert_eq!(forces, [23.0, 0.0, -29.0, 0.0, 71.0, 0.0, -77.0, 0.0]);
}
