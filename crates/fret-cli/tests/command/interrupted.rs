//! Ctrl-C at long work that is no run: it ends soon and in good order, and what was finished is not done again.
#![cfg(unix)]

use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use serde_json::Value;

use crate::bench::{Answer, Bench, SPHERE};

/// Starts the command, presses Ctrl-C as soon as `ready`, and waits; how it ended, and how long that took.
fn interrupt(bench: &Bench, arguments: &[&str], ready: impl Fn() -> bool) -> (Answer, Duration) {
    let mut command = bench.command(arguments);
    let mut run = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let patience = Instant::now();
    while !ready() && run.try_wait().unwrap().is_none() && patience.elapsed().as_secs() < 120 {
        std::thread::sleep(Duration::from_millis(2));
    }
    assert!(Command::new("kill").args(["-INT", &run.id().to_string()]).status().unwrap().success());
    let sent = Instant::now();
    let answer = Answer::from(run.wait_with_output().unwrap());
    (answer, sent.elapsed())
}

fn files_in(bench: &Bench, folder: &str) -> usize {
    std::fs::read_dir(bench.folder.join(folder)).map_or(0, |entries| {
        entries.filter(|entry| entry.as_ref().is_ok_and(|entry| entry.path().extension().is_none())).count()
    })
}

#[test]
fn a_study_goes_on_with_the_levels_that_are_left() {
    let bench = Bench::new("study-stopped");
    bench.file("case.toml", &SPHERE.replace("cycles = 2", "cycles = 20")); // long enough for a signal on a busy machine
    let study = ["study", "case.toml", "--cells", "8,16,192", "--threads", "1", "--out", "study"];
    let (stopped, _) = interrupt(&bench, &study, || files_in(&bench, "study/levels") == 2);
    assert_eq!(stopped.code, Some(130), "{}", stopped.err);
    assert!(stopped.err.contains("2 of 3 levels of the study are solved and kept"), "{}", stopped.err);
    assert!(!bench.folder.join("study/study.csv").exists());
    let again = bench.fret(&study);
    assert_eq!(again.code, Some(0), "{}", again.err);
    assert_eq!(again.err.matches(", solved before").count(), 2, "{}", again.err);
    assert!(!bench.folder.join("study/levels").exists(), "a finished study needs them no more");
    // What it tells but for the times is what a study without a break tells.
    let whole = bench.fret(&[&study[..study.len() - 1], &["whole"]].concat());
    assert_eq!(whole.code, Some(0), "{}", whole.err);
    let errors = |folder: &str| {
        let told: Value = serde_json::from_str(&bench.text(&format!("{folder}/study.json"))).unwrap();
        told["lines"][0]["levels"]
            .as_array()
            .unwrap()
            .iter()
            .map(|level| level["errors"].clone())
            .collect::<Vec<_>>()
    };
    assert_eq!(errors("study"), errors("whole"));
}

#[test]
fn error_bars_are_computed_of_a_run_that_was_solved_before() {
    let bench = Bench::new("bars-stopped");
    let bars = ["run", "case.toml", "--estimate-error", "--threads", "1", "--quiet", "--out", "run"];
    let is_solved = || {
        std::fs::read_to_string(bench.folder.join("run/run.json"))
            .is_ok_and(|text| text.contains("\"solved\""))
    };
    // The error bars of a short case may be ready before a busy machine brings the signal: then a longer case.
    let stop = |cycles: usize| {
        let case =
            SPHERE.replace("[24, 24]", "[64, 64]").replace("cycles = 2", &format!("cycles = {cycles}"));
        bench.file("case.toml", &case);
        let _ = std::fs::remove_dir_all(bench.folder.join("run"));
        interrupt(&bench, &bars, is_solved).0
    };
    let stopped = [40, 160, 640].into_iter().map(stop).find(|answer| answer.code != Some(0));
    let stopped = stopped.expect("each case, however long, was solved with its error bars before the signal");
    assert_eq!(stopped.code, Some(130), "{}", stopped.err);
    assert!(stopped.err.contains("the case is solved and kept in run"), "{}", stopped.err);
    assert!(stopped.err.contains("--resume --estimate-error"), "{}", stopped.err);
    let history = bench.text("run/history.csv");
    let again = bench.fret(&["run", "case.toml", "--estimate-error", "--resume", "--json", "--out", "run"]);
    assert_eq!(again.code, Some(0), "{}", again.err);
    let said: Value = serde_json::from_str(&again.out).unwrap();
    assert_eq!(bench.text("run/history.csv"), history, "the run itself is not solved again");
    let whole = bench.fret(&["run", "case.toml", "--estimate-error", "--json", "--quiet", "--out", "whole"]);
    let whole: Value = serde_json::from_str(&whole.out).unwrap();
    assert_eq!(said["error_bars"]["stages"], whole["error_bars"]["stages"]);
    assert!(bench.folder.join("run/error_bars.json").exists());
}

#[test]
fn stresses_end_with_the_code_of_an_interrupt_and_leave_no_half_files() {
    let bench = Bench::new("stress-stopped");
    let case = SPHERE.replace("[24, 24]", "[128, 128]").replace("every = 5", "every = 1");
    bench.file("case.toml", &case);
    assert_eq!(bench.fret(&["run", "case.toml", "--out", "run", "--quiet"]).code, Some(0));
    let stress = ["stress", "run", "--auto", "--volume", "--threads", "1"];
    let (stopped, took) = interrupt(&bench, &stress, || bench.folder.join("run/stress").exists());
    assert_eq!(stopped.code, Some(130), "{}", stopped.err);
    assert!(stopped.err.contains("stresses are not finished"), "{}", stopped.err);
    assert!(took < Duration::from_secs(3), "{took:?}"); // one depth of one increment on a busy machine
    assert_eq!(std::fs::read_dir(bench.folder.join("run/stress")).unwrap().count(), 0);
}
