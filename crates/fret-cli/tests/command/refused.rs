//! Cases that cannot be computed: exit code 1, each mistake with its place and a clear word, and nothing written.

use crate::bench::{Answer, Bench, SPHERE};

/// Runs a case that must be refused, and looks that nothing was written.
fn refused(test: &str, case: &str) -> Answer {
    let bench = Bench::new(test);
    let answer = bench.file("case.toml", case).fret(&["run", "case.toml"]);
    assert_eq!(answer.code, Some(1), "{}", answer.err);
    assert_eq!(answer.out, "", "a refusal is no answer");
    assert_eq!(bench.names(), ["case.toml"], "a refused case writes nothing");
    answer
}

/// The one mistake of a case, at line and column, with these words.
fn one_mistake(test: &str, case: &str, place: &str, words: &[&str]) {
    let answer = refused(test, case);
    assert_eq!(answer.err.matches("error: ").count(), 1, "one clear message:\n{}", answer.err);
    assert!(answer.err.contains(&format!("case.toml:{place}")), "expected place {place}:\n{}", answer.err);
    for word in words {
        assert!(answer.err.contains(word), "expected {word:?}:\n{}", answer.err);
    }
}

fn changed(from: &str, to: &str) -> String {
    assert!(SPHERE.contains(from), "{from:?} is not in the case");
    SPHERE.replacen(from, to, 1)
}

#[test]
fn a_misspelt_key_is_named_with_the_key_that_was_meant() {
    let case = changed("young = 210e9", "yuong = 210e9");
    one_mistake("misspelt", &case, "11:15", &["yuong", "did you mean `young`?"]);
}

#[test]
fn a_word_where_a_number_belongs_is_refused_at_its_place() {
    let case = changed("radius = 10e-3", "radius = \"ten\"");
    one_mistake("wrong-type", &case, "14:10", &["found the text", "ten"]);
}

#[test]
fn a_negative_thickness_is_refused() {
    let coated = "coatings = [ { thickness = -2e-6, young = 300e9, poisson = 0.2 } ]\nsubstrate =";
    let case = changed("substrate =", coated);
    one_mistake("thickness", &case, "11:28", &["lower.coatings[0].thickness", "positive"]);
}

#[test]
fn a_poisson_ratio_of_seven_tenths_is_refused() {
    let case = changed("poisson = 0.3", "poisson = 0.7");
    one_mistake("poisson", &case, "11:40", &["lower.substrate.poisson", "0.7", "0.5"]);
}

#[test]
fn two_controls_of_one_motion_at_once_are_refused() {
    let case = changed("normal_force = 1.0", "normal_force = 1.0\napproach = 1e-6");
    one_mistake("two-controls", &case, "22:12", &["normal_force", "approach", "both at once"]);
}

#[test]
fn a_tangential_force_above_what_friction_carries_is_refused() {
    let case = changed("[0.05, 0.0]", "[0.15, 0.0]");
    let words = ["the tangential force reaches 0.15, where friction carries at most mu P = 0.1\n", "shift"];
    one_mistake("sliding", &case, "26:20", &words);
}

#[test]
fn an_unknown_profile_is_refused_with_the_known_ones() {
    let case = changed("[profile.sphere]", "[profile.spere]");
    one_mistake("profile", &case, "13:", &["spere", "sphere"]);
}

#[test]
fn a_contact_that_would_touch_the_edge_of_the_grid_is_refused_before_any_work() {
    let case = changed("size = [240e-6, 240e-6]", "size = [40e-6, 40e-6]");
    let answer = refused("edge", &case);
    assert!(answer.err.contains("size"), "{}", answer.err);
    assert!(answer.err.contains("auto"), "{}", answer.err);
}

#[test]
fn several_mistakes_are_all_shown_each_at_its_place() {
    let case = changed("poisson = 0.3", "poisson = 0.7")
        .replacen("radius = 10e-3", "radius = -1.0", 1)
        .replacen("coefficient = 0.1", "coeficient = 0.1", 1);
    let answer = refused("several", &case);
    for (place, word) in [("11:40", "poisson"), ("14:10", "radius"), ("17:1", "did you mean `coefficient`?")]
    {
        assert!(
            answer.err.contains(&format!("case.toml:{place}")),
            "expected place {place}:\n{}",
            answer.err
        );
        assert!(answer.err.contains(word), "expected {word:?}:\n{}", answer.err);
    }
}

#[test]
fn every_table_that_is_missing_is_named() {
    let answer = refused("missing-tables", "title = \"bare\"\n[upper]\nrigid = true\n");
    for table in ["grid", "lower", "load"] {
        assert_eq!(answer.err.matches(&format!("missing key `{table}`")).count(), 1, "{}", answer.err);
    }
    assert!(!answer.err.contains("`upper`"), "{}", answer.err);
}

#[test]
fn a_table_with_mistakes_inside_is_not_called_missing_and_the_rest_is_judged() {
    let case = changed("size = [240e-6, 240e-6]", "size = \"automatic\"")
        .replacen("radius = 10e-3", "radius = -10e-3", 1)
        .replacen("[0.05, 0.0]", "0.05", 1);
    let answer = refused("inside", &case.replacen("cells = [24, 24]", "cells = [24]", 1));
    for words in ["found 1 value, expected a list of two values", "automatic", "-0.01", "found 0.05"] {
        assert!(answer.err.contains(words), "expected {words:?}:\n{}", answer.err);
    }
    assert_eq!(answer.err.matches("error: ").count(), 4, "{}", answer.err);
}

#[test]
fn a_table_that_loses_all_it_needs_is_not_called_missing() {
    let case = changed("cells = [24, 24]", "number_of_points = [24, 24]");
    one_mistake("lost-table", &case, "4:1", &["unknown key `number_of_points`"]);
}

#[test]
fn no_increments_of_a_cycle_are_one_mistake() {
    one_mistake("no-increments", &changed("increments = 8", "increments = 0"), "28:14", &["increments = 0"]);
}

/// The plan knows the contact up to a cell of its own coarse grid; where only the run finds out, the case is refused as well.
#[test]
fn a_contact_that_grows_to_the_edge_refuses_the_case_during_the_run_too() {
    let bench = Bench::new("edge-in-run");
    // Hertz radius 31.9e-6 against half a side of 32.5e-6: the plan lets it pass, the outermost of the 24 cells is touched.
    let case = changed("size = [240e-6, 240e-6]", "size = [65e-6, 65e-6]");
    let answer = bench.file("case.toml", &case).fret(&["run", "case.toml", "--json"]);
    assert_eq!(answer.code, Some(1), "{}", answer.err);
    let told: serde_json::Value = serde_json::from_str(&answer.out).unwrap();
    assert_eq!(told["status"], "refused");
    assert!(told["message"].as_str().unwrap().contains("edge of the grid"), "{}", answer.out);
}

#[test]
fn a_refusal_in_json_lists_the_mistakes_with_line_and_column() {
    let bench = Bench::new("refused-json");
    bench.file("case.toml", &changed("poisson = 0.3", "poisson = 0.7"));
    for verb in ["run", "plan"] {
        let answer = bench.fret(&[verb, "case.toml", "--json"]);
        assert_eq!(answer.code, Some(1));
        let value: serde_json::Value = serde_json::from_str(&answer.out).unwrap();
        assert_eq!(value["status"], "refused");
        assert_eq!(value["mistakes"][0]["line"], 11);
        assert_eq!(value["mistakes"][0]["column"], 40);
        assert!(answer.err.contains("0.7"), "people read standard error: {}", answer.err);
    }
    assert_eq!(bench.names(), ["case.toml"]);
}

#[test]
fn a_case_file_that_cannot_be_read_is_told_in_one_line() {
    let bench = Bench::new("unreadable");
    std::fs::create_dir(bench.folder.join("folder")).unwrap();
    std::fs::write(bench.folder.join("bytes.toml"), [b't', 0xff, 0xfe]).unwrap();
    for (path, words) in [
        ("nowhere.toml", "no such file"),
        ("folder", "a folder, not a file"),
        ("bytes.toml", "not a text in UTF-8"),
    ] {
        for verb in ["run", "check", "plan"] {
            let answer = bench.fret(&[verb, path]);
            assert_eq!(answer.code, Some(1), "{verb} {path}");
            assert_eq!(answer.err.lines().count(), 1, "{}", answer.err);
            assert!(answer.err.contains(path) && answer.err.contains(words), "{}", answer.err);
        }
    }
    assert_eq!(bench.names(), ["bytes.toml", "folder"]);
}

#[test]
fn a_call_that_makes_no_sense_is_refused_too() {
    let bench = Bench::new("call");
    for arguments in [&["rum"][..], &["run"], &["run", "case.toml", "--threads", "0"], &[]] {
        assert_eq!(bench.fret(arguments).code, Some(1), "{arguments:?}");
    }
}

#[test]
fn a_film_that_the_cells_do_not_see_is_refused() {
    let bench = Bench::new("unseen-film");
    // Cells of 10 micrometres under a film of 1: a fifth of a cell is 2.
    let film = |poisson: f64| {
        SPHERE.replace(
            "substrate = { young = 210e9, poisson = 0.3 }",
            &format!(
                "coatings = [{{ thickness = 1e-6, young = 1e9, poisson = {poisson} }}]\nbase = \"rigid\""
            ),
        )
    };
    let answer = bench.file("case.toml", &film(0.5)).fret(&["plan", "case.toml"]);
    assert_eq!(answer.code, Some(1), "{}", answer.out);
    assert!(
        answer.err.contains("incompressible film") && answer.err.contains("case.toml:"),
        "{}",
        answer.err
    );
    let answer = bench.file("case.toml", &film(0.3)).fret(&["plan", "case.toml"]);
    assert_eq!(answer.code, Some(0), "a film that gives way is seen: {}", answer.err);
}
