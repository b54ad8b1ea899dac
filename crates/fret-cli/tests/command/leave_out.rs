//! `fret run --leave-out none`: everything computed, the same answer.

use crate::bench::{Bench, SPHERE};

#[test]
fn a_run_that_leaves_nothing_out_says_so_and_finds_the_same() {
    let bench = Bench::new("leave-out");
    bench.file("case.toml", SPHERE);
    for (what, folder) in [("all", "short"), ("none", "full")] {
        let answer = bench.fret(&["run", "case.toml", "--leave-out", what, "--out", folder, "--quiet"]);
        assert_eq!(answer.code, Some(0), "{}", answer.err);
    }
    let record = |folder: &str| -> serde_json::Value {
        serde_json::from_str(&bench.text(&format!("{folder}/run.json"))).unwrap()
    };
    let (short, full) = (record("short"), record("full"));
    let said = |record: &serde_json::Value| record["plan"]["left_out"].to_string();
    assert!(said(&short).contains("layered response") && said(&short).contains("cells far from the contact"));
    assert!(!said(&full).contains("layered response") && !said(&full).contains("cells far from the contact"));
    assert_eq!(full["plan"]["leave_out"], serde_json::json!([]));
    let last = |folder: &str| -> Vec<f64> {
        let table = bench.text(&format!("{folder}/history.csv"));
        let head: Vec<&str> = table.lines().next().unwrap().split(',').collect();
        let row: Vec<&str> = table.lines().last().unwrap().split(',').collect();
        ["approach", "max_pressure", "dissipated_energy"]
            .map(|name| row[head.iter().position(|column| *column == name).unwrap()].parse().unwrap())
            .into()
    };
    for (a, b) in last("short").iter().zip(last("full")) {
        // both to residuals of 1e-8, each within about a hundred of them
        assert!((a - b).abs() < 2e-6 * b.abs(), "{a} {b}");
    }
}

#[test]
fn what_cannot_be_left_out_is_refused() {
    let bench = Bench::new("leave-out-what");
    let answer = bench.file("case.toml", SPHERE).fret(&["run", "case.toml", "--leave-out", "friction"]);
    assert_eq!(answer.code, Some(1));
    assert!(answer.err.contains("[possible values: all, none]"), "{}", answer.err);
}

#[test]
fn extremes_point_to_where_they_went() {
    let answer = Bench::new("extremes").fret(&["extremes", "--quick"]);
    assert_eq!(answer.code, Some(1));
    assert!(answer.err.contains("cargo xtask extremes"), "{}", answer.err);
}
