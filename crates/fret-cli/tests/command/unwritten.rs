//! Where results must not or cannot go.

use crate::bench::{Bench, SPHERE};

#[test]
fn files_that_are_no_results_are_not_written_over() {
    let bench = Bench::new("foreign");
    bench.file("case.toml", SPHERE);
    std::fs::create_dir(bench.folder.join("thesis")).unwrap();
    bench.file("thesis/history.csv", "mine");
    let answer = bench.fret(&["run", "case.toml", "--out", "thesis"]);
    assert_eq!(answer.code, Some(1), "{}", answer.err);
    assert!(answer.err.contains("thesis") && answer.err.contains("--force"), "{}", answer.err);
    assert_eq!(bench.text("thesis/history.csv"), "mine");
}

#[test]
fn a_file_is_no_folder_for_results() {
    let bench = Bench::new("file-as-folder");
    let answer = bench.file("case.toml", SPHERE).fret(&["run", "case.toml", "--out", "case.toml"]);
    assert_eq!(answer.code, Some(1), "{}", answer.err);
    assert!(answer.err.contains("a file, not a folder"), "{}", answer.err);
    assert_eq!(bench.text("case.toml"), SPHERE);
}

#[test]
fn a_folder_that_cannot_be_made_ends_in_exit_code_two() {
    let bench = Bench::new("impossible-folder");
    let answer =
        bench.file("case.toml", SPHERE).fret(&["run", "case.toml", "--quiet", "--out", "case.toml/below"]);
    assert_eq!(answer.code, Some(2), "{}", answer.err);
    assert!(answer.err.contains("cannot be written"), "{}", answer.err);
    assert_eq!(bench.names(), ["case.toml"]);
}
