//! What is said on the way: how far a run is, what stands in a name, one mistake once.

use std::time::{Duration, Instant};

use serde_json::Value;

use crate::bench::{Bench, SPHERE};

/// Cycles that wear in blocks: most of the increments planned are never solved.
fn worn_in_blocks() -> String {
    let worn = SPHERE.replace("cycles = 2", "cycles = 200");
    worn + "\n[wear]\nlaw = \"energy\"\ncoefficient = 1e-13\nevery = 20\n"
}

#[test]
fn progress_counts_the_cycles_that_a_computed_one_stands_for() {
    let bench = Bench::new("progress");
    let answer = bench.file("case.toml", &worn_in_blocks()).fret(&["run", "case.toml", "--threads", "1"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    let table = bench.text("results/case/cycles.csv");
    let place = table.lines().next().unwrap().split(',').position(|name| name == "stands_for").unwrap();
    let stands_for = |line: &str| line.split(',').nth(place).unwrap().parse::<usize>().unwrap();
    let passed = 3 + 8 * table.lines().skip(1).map(stands_for).sum::<usize>();
    let solved = bench.text("results/case/history.csv").lines().count() - 1;
    assert_eq!(passed, 3 + 8 * 200, "all cycles are stood for");
    assert!(solved < passed / 2, "{solved} increments are solved");
    let last = answer.err.lines().rfind(|line| line.contains(" solved for ")).unwrap();
    assert!(last.contains(&format!("{solved} solved for {passed} of {passed}")), "{last}");
    assert!(!last.contains("left"), "nothing is left: {last}");
}

#[test]
fn a_name_from_a_file_does_not_steer_the_terminal() {
    let bench = Bench::new("escapes");
    let long = "x".repeat(100_000);
    let title = format!("title = \"a\\u001b[31m\\u001b]0;renamed\\u0007\\u202e{long}\"");
    let case = SPHERE
        .replace("title = \"a small sphere\"", &title)
        .replace("name = \"indent\"", &format!("name = \"p\\u001b[2J\\u009b31m{long}\""));
    bench.file("case.toml", &case);
    for arguments in [&["check", "case.toml"][..], &["plan", "case.toml"], &["run", "case.toml"]] {
        let answer = bench.fret(arguments);
        assert_eq!(answer.code, Some(0), "{}", answer.err);
        for text in [&answer.out, &answer.err] {
            let steers = |letter: &char| letter.is_control() && *letter != '\n' || *letter == '\u{202e}';
            assert_eq!(text.chars().find(steers), None, "{arguments:?}");
            assert!(text.len() < 20_000, "{arguments:?}: {} letters", text.len());
        }
    }
    // In a message of a run that ends on its way: how much the friction carries is known only then.
    let slid = case
        .replace("normal_force = 1.0", "approach = 1e-7")
        .replace("[0.05, 0.0]", "[50.0, 0.0]")
        .replace("name = \"fretting\"", "name = \"f\\u001b[31m\"");
    bench.file("case.toml", &slid);
    let refused = bench.fret(&["run", "case.toml", "--force"]);
    assert_ne!(refused.code, Some(0));
    assert!(refused.err.contains("f\\u{1b}[31m"), "the stage is named: {}", refused.err.len());
    assert!(!refused.err.contains('\u{1b}') && refused.err.len() < 20_000, "{} letters", refused.err.len());
}

#[cfg(unix)]
#[test]
fn a_folder_that_is_being_written_is_refused_before_anything_else_is_said() {
    let bench = Bench::new("being-written");
    bench.file("case.toml", &SPHERE.replace("cycles = 2", "cycles = 100000"));
    let mut first = bench.command(&["run", "case.toml", "--quiet"]).spawn().unwrap();
    let patience = Instant::now();
    while !bench.folder.join("results/case/checkpoint/even").exists() && patience.elapsed().as_secs() < 60 {
        std::thread::sleep(Duration::from_millis(5));
    }
    for wish in [&[][..], &["--force"], &["--resume"]] {
        let second = bench.fret(&[&["run", "case.toml"], wish].concat());
        assert_eq!(second.code, Some(1), "{wish:?}: {}", second.err);
        let line = second.err.lines().next().unwrap();
        assert!(line.contains("another run is writing into it at this moment"), "{wish:?}: {}", second.err);
    }
    first.kill().unwrap();
    first.wait().unwrap();
}

#[test]
fn a_misspelt_axis_is_told_once_with_the_word_that_was_meant() {
    let bench = Bench::new("misspelt-axis");
    bench.file("case.toml", SPHERE);
    bench.file("many.toml", "base = 'case.toml'\n[axes]\n\"frction.coefficient\" = [0.1, 0.2, 0.3]\n");
    let answer = bench.fret(&["sweep", "many.toml"]);
    assert_eq!(answer.code, Some(1), "{}", answer.err);
    assert_eq!(answer.err.matches("unknown key `frction`").count(), 1, "{}", answer.err);
    assert_eq!(answer.err.matches("did you mean `friction`?").count(), 1, "{}", answer.err);
    assert!(answer.err.contains("many.toml:3:"), "the line of the axis: {}", answer.err);
    assert_eq!(bench.names(), ["case.toml", "many.toml"]);
}

#[test]
fn a_plan_tells_a_time_and_counts_that_a_run_keeps_to() {
    let bench = Bench::new("expected");
    bench.file("blocks.toml", &worn_in_blocks()).file("case.toml", SPHERE);
    for case in ["case", "blocks"] {
        let plan = bench.fret(&["plan", &format!("{case}.toml"), "--json"]);
        let plan: Value = serde_json::from_str(&plan.out).unwrap();
        let run = bench.fret(&["run", &format!("{case}.toml"), "--json"]);
        let run: Value = serde_json::from_str(&run.out).unwrap();
        // A grid as coarse as the one that is tried: the counts are those of the run itself.
        assert_eq!(plan["increments_expected"], run["increments"], "{case}");
        assert_eq!(plan["convolutions_expected"], run["work"]["convolutions"], "{case}");
        assert!(plan["seconds_expected"].as_f64().unwrap() > 0.0, "{case}");
        let shown = bench.fret(&["plan", &format!("{case}.toml")]);
        assert!(shown.out.contains(" s on "), "{}", shown.out);
    }
}
