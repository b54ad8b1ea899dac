//! Inputs that nobody means well with: an answer in words before memory is asked for, never a fall.

use std::fmt::Write;
use std::time::Instant;

use crate::bench::{Answer, Bench, SPHERE};

/// A refusal of `check`, `plan` and `run` alike, with these words, soon, and with nothing written.
fn refused(bench: &Bench, case: &str, words: &[&str]) {
    for verb in ["check", "plan", "run"] {
        let names = bench.names();
        let started = Instant::now();
        let answer = bench.fret(&[verb, case]);
        assert_eq!(answer.code, Some(1), "{verb} {case}: {}", shown(&answer));
        assert!(started.elapsed().as_secs() < 20, "{verb} {case} took {:?}", started.elapsed());
        for word in words {
            assert!(answer.err.contains(word), "{verb} {case}: expected {word:?}: {}", shown(&answer));
        }
        assert!(answer.err.len() < 200_000, "a refusal is read by a person");
        assert_eq!(bench.names(), names);
    }
}

fn shown(answer: &Answer) -> String {
    answer.err.chars().take(2000).collect()
}

#[test]
fn tables_as_deep_as_a_well_are_refused() {
    let bench = Bench::new("deep");
    for (name, case) in [
        ("arrays.toml", format!("x = {}1{}", "[".repeat(40_000), "]".repeat(40_000))),
        ("inline.toml", format!("x = {}1{}", "{ a = ".repeat(40_000), "}".repeat(40_000))),
        ("dotted.toml", format!("{}x = 1", "a.".repeat(200_000))),
        ("header.toml", format!("[{}a]\nx = 1", "a.".repeat(200_000))),
        ("brackets.toml", "[".repeat(1_000_000)),
    ] {
        bench.file(name, &case);
        refused(&bench, name, &[]);
    }
}

#[test]
fn a_file_as_long_as_a_film_is_refused_unread() {
    let bench = Bench::new("long");
    bench.file("long.toml", &format!("{SPHERE}\n# {}", "x".repeat(5 << 20)));
    refused(&bench, "long.toml", &["at most"]);
    let mut many = SPHERE.to_owned();
    for number in 0..50_000 {
        let _ = writeln!(many, "wrong{number} = {number}");
    }
    bench.file("many.toml", &many);
    refused(&bench, "many.toml", &["unknown key"]);
}

#[cfg(unix)]
#[test]
fn a_stream_without_end_is_refused() {
    refused(&Bench::new("endless"), "/dev/zero", &["at most"]);
}

#[test]
fn a_grid_larger_than_any_memory_is_refused_before_memory_is_asked_for() {
    let bench = Bench::new("huge-grid");
    for cells in
        ["[1000000, 1000000]", "[16384, 16384]", "[9223372036854775807, 9223372036854775807]", "[4, 99999]"]
    {
        bench.file("huge.toml", &SPHERE.replace("[24, 24]", cells));
        refused(&bench, "huge.toml", &["grid.cells", "huge.toml:4:9"]);
    }
}

#[test]
fn a_history_longer_than_any_life_is_refused() {
    let bench = Bench::new("endless-history");
    for (from, to) in [
        ("increments = 8", "increments = 9223372036854775807"),
        ("cycles = 2", "cycles = 9223372036854775807"),
        ("increments = 3", "increments = 4000000000000"),
    ] {
        bench.file("endless.toml", &SPHERE.replace(from, to));
        refused(&bench, "endless.toml", &["must lie between", "endless.toml:"]);
    }
}

#[test]
fn bytes_that_are_no_text_are_refused() {
    let bench = Bench::new("bytes");
    let mut bytes = SPHERE.as_bytes().to_vec();
    bytes.extend([0xc3, 0x28, 0xff]);
    std::fs::write(bench.folder.join("bytes.toml"), bytes).unwrap();
    refused(&bench, "bytes.toml", &["UTF-8"]);
    bench.file("zero.toml", "title = \"\u{0}\"");
    refused(&bench, "zero.toml", &["not readable as TOML"]);
    std::fs::create_dir(bench.folder.join("folder.toml")).unwrap();
    refused(&bench, "folder.toml", &["a folder"]);
}

#[test]
fn numbers_that_are_none_are_refused() {
    let bench = Bench::new("not-numbers");
    for (from, to) in [
        ("radius = 10e-3", "radius = nan"),
        ("radius = 10e-3", "radius = inf"),
        ("young = 210e9", "young = -inf"),
        ("poisson = 0.3", "poisson = nan"),
        ("size = [240e-6, 240e-6]", "size = [nan, 240e-6]"),
        ("size = [240e-6, 240e-6]", "size = [1e-320, 1e308]"),
        ("coefficient = 0.1", "coefficient = nan"),
        ("normal_force = 1.0", "normal_force = inf"),
        ("tangential_force = [0.05, 0.0]", "tangential_force = [nan, 0.0]"),
    ] {
        bench.file("case.toml", &SPHERE.replacen(from, to, 1));
        refused(&bench, "case.toml", &["error"]);
    }
}

/// A path that leads elsewhere than it seems to is followed or refused as the system does; what lies there is never replaced.
#[cfg(unix)]
#[test]
fn results_do_not_replace_what_a_link_points_to() {
    let bench = Bench::new("links");
    bench.file("case.toml", SPHERE).file("thesis.txt", "mine");
    std::os::unix::fs::symlink(bench.folder.join("thesis.txt"), bench.folder.join("out")).unwrap();
    let answer = bench.fret(&["run", "case.toml", "--out", "out"]);
    assert_eq!(answer.code, Some(1), "{}", answer.err);
    std::os::unix::fs::symlink("nowhere", bench.folder.join("dangling")).unwrap();
    assert_eq!(bench.fret(&["run", "case.toml", "--out", "dangling", "--quiet"]).code, Some(2));
    assert_eq!(bench.text("thesis.txt"), "mine");

    // A page that shall go where a link points replaces the link, not the file behind it.
    assert_eq!(bench.fret(&["run", "case.toml", "--out", "run", "--quiet"]).code, Some(0));
    std::os::unix::fs::symlink(bench.folder.join("thesis.txt"), bench.folder.join("page.html")).unwrap();
    assert_eq!(bench.fret(&["report", "run", "--out", "page.html"]).code, Some(0));
    assert_eq!(bench.text("thesis.txt"), "mine");
}

#[test]
fn every_verb_refuses_in_json_when_asked_to() {
    let bench = Bench::new("json-refusals");
    for arguments in [
        &["run", "nowhere.toml"][..],
        &["check", "nowhere.toml"],
        &["plan", "nowhere.toml"],
        &["report", "nowhere"],
        &["export", "nowhere", "--npz"],
        &["run"],
        &["rum"],
        &["run", "case.toml", "--threads", "many"],
    ] {
        let answer = bench.fret(&[arguments, &["--json"]].concat());
        assert_eq!(answer.code, Some(1), "{arguments:?}");
        let told: serde_json::Value = serde_json::from_str(&answer.out).unwrap();
        assert_eq!(told["status"], "refused", "{arguments:?}");
        assert!(!told["message"].as_str().unwrap().is_empty());
    }
    let good = bench.file("case.toml", SPHERE).fret(&["check", "case.toml", "--json"]);
    let told: serde_json::Value = serde_json::from_str(&good.out).unwrap();
    assert_eq!((&told["status"], &told["increments"]), (&"good".into(), &19.into()));
    let schema: serde_json::Value = serde_json::from_str(&bench.fret(&["schema", "--json"]).out).unwrap();
    assert_eq!(schema["title"], "fretting case");
}
