//! Cases with one thing changed: what they are read as, or the one mistake that they are refused for.

use crate::case::{Case, GridSize};

pub(in crate::case) const BALL: &str = "[grid]\ncells = [16, 32]\nsize = [3.0, 3.0]\n[upper]\nrigid = true\n[lower]\n\
                    substrate = { young = 1.0, poisson = 0.3 }\n[profile.sphere]\nradius = 100.0\n\
                    [friction]\ncoefficient = 0.3\n[[load]]\nnormal_force = 0.01\nincrements = 1\n";
pub(in crate::case) const ROLLER: &str = "[grid]\ncells = 16\nsize = 3.0\n[upper]\nrigid = true\n[lower]\n\
                      substrate = { young = 1.0, poisson = 0.3 }\n[profile.cylinder]\nradius = 100.0\naxis = \"y\"\n\
                      [friction]\ncoefficient = 0.3\n[[load]]\nnormal_force = 0.01\nincrements = 1\n";

fn changed(text: &str, changes: &[(&str, &str)]) -> String {
    changes.iter().fold(text.to_owned(), |text, (from, to)| {
        assert!(text.contains(from), "{from:?} is not in the case");
        text.replacen(from, to, 1)
    })
}

pub(in crate::case) fn read(text: &str, changes: &[(&str, &str)]) -> Case {
    Case::from_toml(&changed(text, changes), "case.toml")
        .unwrap_or_else(|error| panic!("{changes:?}: {error}"))
}

/// The case is refused for one mistake, whose words and place in the text these are.
pub(in crate::case) fn refused(text: &str, changes: &[(&str, &str)], words: &str, place: &str) {
    let text = changed(text, changes);
    let error = Case::from_toml(&text, "case.toml").expect_err(place);
    let [mistake] = error.mistakes() else { panic!("{changes:?}: {error}") };
    assert!(mistake.message.contains(words), "{changes:?}: {error}");
    assert_eq!(&text[mistake.span.clone().unwrap_or_default()], place, "{error}");
}

#[test]
fn a_grid_has_cells_within_its_bounds() {
    // on the bounds, and one beyond: 4 and 2^14 along a side, 2^26 in all
    for cells in [[4, 4], [4, 16_384], [16_384, 4096], [8192, 8192]] {
        let read = read(BALL, &[("[16, 32]", &format!("{cells:?}"))]);
        assert_eq!(read.cells, cells);
    }
    for cells in ["[3, 16]", "[16, 3]", "[16385, 4]", "[4, 16385]"] {
        refused(BALL, &[("[16, 32]", cells)], "each side needs between 4 and 16384", cells);
    }
    for cells in ["[16384, 4097]", "[8193, 8192]", "[16384, 16384]"] {
        refused(BALL, &[("[16, 32]", cells)], "more than 67108864 cells in all", cells);
    }
    for count in [4, 16_384] {
        assert_eq!(read(ROLLER, &[("= 16", &format!("= {count}"))]).cells, [count, 1]);
    }
    for count in ["3", "16385", "0"] {
        refused(ROLLER, &[("16", count)], "a line contact needs between 4 and 16384", count);
    }
}

#[test]
fn a_grid_has_a_size_that_can_be_computed_with() {
    assert_eq!(read(BALL, &[]).size, GridSize::Given([3.0, 3.0]));
    assert_eq!(read(BALL, &[("[3.0, 3.0]", "\"auto\"")]).size, GridSize::Auto);
    assert_eq!(read(ROLLER, &[]).size, GridSize::Given([3.0, 3.0 / 16.0]));
    // cells of 1 by 1e6, either way, and a little longer
    for sides in [[16.0, 32e6], [16e6, 32.0]] {
        assert_eq!(read(BALL, &[("[3.0, 3.0]", &format!("{sides:?}"))]).size, GridSize::Given(sides));
    }
    // 1e-100 itself is not the inverse of 1e100 to the last digit
    for side in [1e100, 1.000_001e-100] {
        read(BALL, &[("[3.0, 3.0]", &format!("[{side:e}, {side:e}]"))]);
        read(ROLLER, &[("3.0", &format!("{side:e}"))]);
    }
    for sides in ["[16.0, 32.001e6]", "[16.001e6, 32.0]"] {
        refused(BALL, &[("[3.0, 3.0]", sides)], "1e6 times as long as wide", sides);
    }
    for sides in ["[0.0, 3.0]", "[3.0, -3.0]", "[nan, 3.0]", "[3.0, inf]"] {
        refused(BALL, &[("[3.0, 3.0]", sides)], "must be positive finite lengths", sides);
    }
    for sides in ["[1.1e100, 1.1e100]", "[1e-101, 1e-101]", "[1e100, 1.1e100]"] {
        refused(BALL, &[("[3.0, 3.0]", sides)], "each side must lie between 1e-100 and 1e100", sides);
    }
    for length in ["0.0", "-1.0", "nan", "inf", "1.1e100", "9e-101"] {
        refused(ROLLER, &[("3.0", length)], "must be a length between 1e-100 and 1e100", length);
    }
    refused(BALL, &[("[3.0, 3.0]", "3.0")], "one length, but two numbers of cells", "3.0");
    refused(ROLLER, &[("3.0", "[3.0, 3.0]")], "two side lengths, but a single number of cells", "[3.0, 3.0]");
    // of refused cells the size cannot be judged
    refused(BALL, &[("[16, 32]", "[1, 1]"), ("[3.0, 3.0]", "3.0")], "each side needs between", "[1, 1]");
    refused(ROLLER, &[("16", "1"), ("3.0", "3.5")], "a line contact needs", "1");
}

#[test]
fn arrays_over_cells_need_a_given_size() {
    let row = |value: f64, count: usize| format!("[{}]", vec![format!("{value}"); count].join(", "));
    let map = |value: f64| format!("[{}]", vec![row(value, 4); 4].join(", "));
    let small = ("[16, 32]", "[4, 4]");
    let auto = ("[3.0, 3.0]", "\"auto\"");
    let friction = format!("map = {}", map(0.3));
    let words = "\"auto\" with heights or a friction map";
    assert!(read(BALL, &[small, ("coefficient = 0.3", &friction)]).friction.is_map());
    refused(BALL, &[small, auto, ("coefficient = 0.3", &friction)], words, "\"auto\"");
    let heights = format!("radius = 100.0\n[profile.heights]\nvalues = {}", map(1e-3));
    read(BALL, &[small, ("radius = 100.0", &heights)]);
    refused(BALL, &[small, auto, ("radius = 100.0", &heights)], words, "\"auto\"");
    let of_stage = format!("increments = 1\nfriction = {}", map(0.2));
    refused(BALL, &[small, auto, ("increments = 1", &of_stage)], words, "\"auto\"");
    // that a periodic case has no size is told once
    let periodic = ("\"auto\"", "\"auto\"\nperiodic = true");
    refused(
        BALL,
        &[small, auto, periodic, ("radius = 100.0", &heights)],
        "the period must be given",
        "\"auto\"",
    );
}

#[test]
fn the_tolerance_lies_between_rounding_and_a_percent() {
    assert_eq!(read(BALL, &[]).tolerance, 1e-8);
    let with = |tolerance: &str| format!("[solver]\ntolerance = {tolerance}\n[friction]");
    for (given, value) in [("1e-13", 1e-13), ("1e-2", 1e-2), ("3e-5", 3e-5)] {
        assert_eq!(read(BALL, &[("[friction]", &with(given))]).tolerance, value);
    }
    for given in ["0.9e-13", "1.1e-2", "0.0", "-1e-8", "nan"] {
        refused(BALL, &[("[friction]", &with(given))], "must lie between 1e-13 and 1e-2", given);
    }
}

#[test]
fn fields_are_kept_once_and_by_their_names() {
    let output =
        |words: &str| read(BALL, &[("[friction]", &format!("[output]\n{words}\n[friction]"))]).output;
    let plain = read(BALL, &[]).output;
    assert_eq!(plain.fields, ["pressure", "shear", "slip", "zone"]);
    assert_eq!(plain.every, None);
    assert_eq!(output("fields = [\"gap\", \"slip\", \"gap\"]").fields, ["gap", "slip"]);
    assert_eq!(output("every = 1").every, Some(1));
    assert_eq!(output("every = 7").every, Some(7));
    let refused = |words: &str, message: &str, place: &str| {
        refused(BALL, &[("[friction]", &format!("[output]\n{words}\n[friction]"))], message, place);
    };
    refused("every = 0", "must be at least 1", "0");
    refused("fields = [\"gap\", \"gaps\"]", "no field is called \"gaps\"", "\"gaps\"");
}

#[test]
fn friction_is_in_force_from_its_stage_on_and_keeps_its_strength() {
    // forces of 2e-3, 1e-3, 1e-3 where 0.3, then 0.15 of the normal force of 0.01 are carried
    let stages = |last: &str| {
        format!(
            "increments = 1\n[[load]]\ntangential_force = [2e-3, 0.0]\nincrements = 1\n[[load]]\nfriction = 0.15\n\
             tangential_force = [1e-3, 0.0]\nincrements = 1\n[[load]]\ntangential_force = {last}\nincrements = 1"
        )
    };
    let case = read(
        BALL,
        &[("increments = 1", &stages("[1.4e-3, 0.0]")), ("= 0.3\n[", "= 0.3\nmax_shear = 7.0\n[")],
    );
    let friction: Vec<_> = case.stages.iter().map(|stage| stage.friction.as_ref()).collect();
    assert!(friction[0].is_none() && friction[1].is_none() && friction[3].is_none());
    let law = friction[2].unwrap();
    assert_eq!(law.largest(), 0.15);
    // stages change the coefficient, not the shear strength
    assert_eq!([law, &case.friction].map(|law| law.max_shear().unwrap().at(0, 0)), [7.0, 7.0]);
    refused(
        BALL,
        &[("increments = 1", &stages("[1.6e-3, 0.0]"))],
        "load[3] (stage 4).tangential_force: the tangential force reaches 0.0016, where friction carries at most mu P = 0.0015",
        "[1.6e-3, 0.0]",
    );
}
