//! Numbers that would mislead: told of on every face of the command, or not shown at all.

use serde_json::Value;

use crate::bench::{Bench, SPHERE};

/// Names of the warnings in an answer in JSON.
fn names(text: &str) -> Vec<String> {
    let answer: Value = serde_json::from_str(text).unwrap();
    let list = answer["warnings"].as_array().unwrap_or_else(|| panic!("{text}"));
    list.iter().map(|warning| warning["name"].as_str().unwrap().to_owned()).collect()
}

#[test]
fn a_grid_of_the_wrong_unit_is_told_of_by_every_verb() {
    let bench = Bench::new("misleading");
    bench.file("case.toml", &SPHERE.replace("[240e-6, 240e-6]", "[1.0, 1.0]"));
    for verb in ["check", "plan"] {
        let answer = bench.fret(&[verb, "case.toml"]);
        assert_eq!(answer.code, Some(0), "{}", answer.err);
        assert!(answer.out.contains("warning: cells in the contact radius: "), "{}", answer.out);
        assert!(names(&bench.fret(&[verb, "case.toml", "--json"]).out).contains(&"few_cells".to_owned()));
    }
    let answer = bench.fret(&["run", "case.toml", "--json"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    assert!(names(&answer.out).contains(&"few_cells".to_owned()));
    assert!(names(&bench.text("results/case/run.json")).contains(&"few_cells".to_owned()));
    assert!(bench.fret(&["run", "case.toml"]).out.contains("warning: cells in the contact radius: "));
    assert_eq!(bench.fret(&["report", "results/case"]).code, Some(0));
    assert!(bench.text("results/case/report.html").contains("Cells in the contact radius: "));
    let refused = bench.fret(&["run", "case.toml", "--estimate-error", "--force"]);
    assert_eq!(refused.code, Some(1));
    assert!(refused.err.contains("cells in the contact radius are too few"), "{}", refused.err);
    // The same contact on a grid of its own size: nothing to say before the run.
    bench.file("good.toml", &SPHERE.replace("[240e-6, 240e-6]", "\"auto\""));
    assert_eq!(names(&bench.fret(&["check", "good.toml", "--json"]).out), Vec::<String>::new());
}

#[test]
fn a_third_value_of_a_pair_is_refused_with_its_place() {
    for (good, bad, place) in [
        ("cells = [24, 24]", "cells = [24, 24, 16]", "4:9"),
        ("tangential_force = [0.05, 0.0]", "tangential_force = [0.05, 0.0, 7.0]", "26:20"),
        ("tangential_force = [0.05, 0.0]", "shift = [1e-9, 0.0, 7.0]", "26:9"),
        ("cycles = 2", "cycles = 2\nenvelope = [1.0, 0.5, 9.0]", "28:12"),
        ("cycles = 2", "cycles = 2\nphase = { tangential_force = [0.0, 90.0, 1.0] }", "28:30"),
    ] {
        let bench = Bench::new("pairs");
        let answer = bench.file("case.toml", &SPHERE.replace(good, bad)).fret(&["check", "case.toml"]);
        assert_eq!(answer.code, Some(1), "{bad}: {}", answer.out);
        let words = "found 3 values, expected a list of two values";
        assert!(
            answer.err.contains(words) && answer.err.contains(&format!("case.toml:{place}")),
            "{bad}: {}",
            answer.err
        );
    }
}

#[test]
fn a_run_with_wear_sums_up_all_its_cycles() {
    let bench = Bench::new("worn");
    let wear = "[wear]\ncoefficient = 1e-12\nevery = 5\n\n[output]";
    let case = SPHERE.replace("cycles = 2", "cycles = 20").replace("[output]", wear);
    let answer = bench.file("case.toml", &case).fret(&["run", "case.toml", "--json"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    let record: Value = serde_json::from_str(&bench.text("results/case/run.json")).unwrap();
    let total = |name: &str| record["totals"][name].as_f64().unwrap();
    // What is worn off is the coefficient times what was dissipated, whatever cycles stand for others.
    let ratio = total("worn_volume") / (1e-12 * total("dissipated_energy"));
    assert!((ratio - 1.0).abs() < 1e-9, "{ratio}");
    assert_eq!(bench.fret(&["run", "case.toml", "--force"]).code, Some(0));
    let table = bench.fret(&["run", "case.toml"]).out;
    for words in [
        "worn volume so far",
        "max wear depth",
        "cycles                                      -             20",
        "cycles solved",
        "in each of cycles",
    ] {
        assert!(table.contains(words), "expected {words:?}:\n{table}");
    }
}

/// Closed forms are laid over a run only where they hold: not over a coupled one, nor over sliding.
#[test]
fn a_report_shows_no_closed_form_of_partial_slip_where_there_is_none() {
    let bench = Bench::new("forms");
    let like = "[upper]\nsubstrate = { young = 210e9, poisson = 0.3 }";
    let partial = SPHERE.replace("[upper]\nrigid = true", like);
    let slides = partial.replace("tangential_force = [0.05, 0.0]", "shift = [1e-6, 0.0]");
    let form = "Mindlin and Deresiewicz";
    for (name, case, has_form) in
        [("partial", &partial, true), ("slides", &slides, false), ("coupled", &SPHERE.to_owned(), false)]
    {
        let file = format!("{name}.toml");
        assert_eq!(bench.file(&file, case).fret(&["run", &file]).code, Some(0), "{name}");
        assert_eq!(bench.fret(&["report", &format!("results/{name}")]).code, Some(0));
        let page = bench.text(&format!("results/{name}/report.html"));
        let comparison = page.find("Against the closed form").map_or("", |at| &page[at..]);
        assert_eq!(
            page.contains(&format!("Dashed: the closed form for the same forces (Cattaneo, {form})")),
            has_form,
            "{name}"
        );
        assert_eq!(comparison.contains("radius of stick"), has_form, "{name}");
    }
}

#[test]
fn a_report_of_torsion_draws_moment_over_twist() {
    let bench = Bench::new("twisted");
    let case = SPHERE.replace("tangential_force = [0.05, 0.0]", "twist_moment = 5e-7");
    assert_eq!(bench.file("case.toml", &case).fret(&["run", "case.toml"]).code, Some(0));
    assert_eq!(bench.fret(&["report", "results/case"]).code, Some(0));
    let page = bench.text("results/case/report.html");
    assert!(
        page.contains("torsional moment over rotation") && page.contains("Moment over rotation"),
        "no loop"
    );
    assert!(page.contains("Dissipated energy"), "no energy");
    assert!(!page.contains("tangential force over relative displacement"));
}
