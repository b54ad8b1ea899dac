//! Memory: what is needed is compared with what there is before anything starts; nothing is ever ended by a signal for want of it.

use std::fs::File;
use std::time::Instant;

use serde_json::Value;

use crate::bench::{Answer, Bench, SPHERE};

/// The sphere on so many cells a side, pressed once and pulled a little.
fn sphere(cells: usize) -> String {
    SPHERE
        .replace("[24, 24]", &format!("[{cells}, {cells}]"))
        .replace("increments = 3", "increments = 1")
        .replace("cycles = 2\nincrements = 8", "increments = 2")
}

/// The command under a limit on its address space [MB].
#[cfg(target_os = "linux")]
fn limited(bench: &Bench, megabytes: u64, arguments: &[&str]) -> Answer {
    let mut command = std::process::Command::new("sh");
    let words = arguments.join(" ");
    let call = format!("ulimit -v {}; exec \"$FRET\" {words}", megabytes * 1000);
    command.args(["-c", &call]).env("FRET", env!("CARGO_BIN_EXE_fret")).current_dir(&bench.folder);
    Answer::from(command.output().unwrap())
}

/// What the plan of a case says [bytes].
fn planned(bench: &Bench, case: &str, entry: &str) -> u64 {
    let plan = bench.fret(&["plan", case, "--json"]);
    let plan: Value = serde_json::from_str(&plan.out).unwrap();
    plan[entry].as_u64().unwrap()
}

#[cfg(target_os = "linux")]
#[test]
#[ignore = "long: 4 s"]
fn under_any_limit_on_memory_a_run_is_refused_or_solved_and_never_aborted() {
    let bench = Bench::new("memory-limits");
    bench.file("case.toml", &sphere(512));
    // Between the program itself and several times what is needed: threads take address space, and little of it is memory.
    let mut codes = Vec::new();
    for limit in [80, 200, 300, 400, 500, 600, 700, 800, 1000, 1500] {
        let arguments = ["run", "case.toml", "--quiet", "--force", "--threads", "2", "--out", "results"];
        let _ = std::fs::remove_dir_all(bench.folder.join("results"));
        let answer = limited(&bench, limit, &arguments);
        match answer.code {
            Some(0) => assert!(answer.err.is_empty(), "{limit} MB: {}", answer.err),
            Some(1) => {
                assert!(answer.err.contains("ulimit -v"), "{limit} MB: {}", answer.err);
                assert!(
                    answer.err.contains("MB") || answer.err.contains("room for 1;"),
                    "{limit} MB: {}",
                    answer.err
                );
                assert!(!bench.folder.join("results").exists(), "refused before anything was written");
            }
            code => panic!("{limit} MB: {code:?}: {}", answer.err),
        }
        codes.push(answer.code.unwrap());
    }
    assert_eq!((codes.first(), codes.last()), (Some(&1), Some(&0)), "{codes:?}");
}

#[cfg(target_os = "linux")]
#[test]
fn a_plan_under_a_limit_tells_that_the_memory_is_lacking() {
    let bench = Bench::new("memory-plan");
    bench.file("case.toml", &sphere(2048));
    let answer = limited(&bench, 1000, &["plan", "case.toml"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    assert!(answer.out.contains("ulimit -v"), "{}", answer.out);
}

#[cfg(target_os = "linux")]
#[test]
fn points_of_a_sweep_wait_for_memory_and_all_are_solved() {
    let bench = Bench::new("memory-sweep");
    bench
        .file("case.toml", &sphere(512))
        .file("many.toml", "base = 'case.toml'\naxes.friction.coefficient = [0.1, 0.15, 0.2, 0.25]\n");
    // Room for the process with its threads, and for some of the four points.
    let needed = planned(&bench, "case.toml", "memory_bytes") / 1_000_000;
    let answer = limited(&bench, 1200 + 2 * needed, &["sweep", "many.toml", "--threads", "4"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    assert!(answer.out.contains("4 solved"), "{}", answer.out);
    // So little that not even one is, and that many threads cannot be started.
    for threads in ["1", "4", "64"] {
        let none = limited(&bench, needed, &["sweep", "many.toml", "--threads", threads, "--out", "none"]);
        assert_eq!(none.code, Some(1), "{threads}: {}", none.err);
        assert!(none.err.contains("ulimit -v"), "{threads}: {}", none.err);
    }
    let again = bench.fret(&["sweep", "many.toml", "--out", "none"]);
    assert!(again.out.contains("4 solved, 0 not, 0 found finished"), "no answer of theirs: {}", again.out);
}

#[cfg(target_os = "linux")]
#[test]
#[ignore = "long: 6 s"]
fn kept_fields_that_are_on_disk_are_not_held_in_memory_as_well() {
    let bench = Bench::new("memory-kept");
    let kept = sphere(256)
        .replace("increments = 1\n", "increments = 60\n")
        .replace("\"zone\"]\nevery = 5", "\"slip\", \"gap\", \"zone\"]\nevery = 1");
    bench.file("case.toml", &kept);
    // By own count: 60 + 2 increments of 8 + 16 + 16 + 8 + 1 bytes a cell.
    let bytes = 62 * 49 * 256 * 256;
    assert_eq!(planned(&bench, "case.toml", "kept_bytes"), bytes);
    let answer =
        bench.command(&["run", "case.toml", "--quiet", "--threads", "1"]).spawn().and_then(|mut run| {
            let status = format!("/proc/{}/status", run.id());
            let mut most = 0;
            while run.try_wait()?.is_none() {
                let text = std::fs::read_to_string(&status).unwrap_or_default();
                let peak = text
                    .lines()
                    .find_map(|line| line.strip_prefix("VmHWM:")?.split_whitespace().next()?.parse().ok());
                most = most.max(peak.unwrap_or(0));
                std::thread::sleep(std::time::Duration::from_millis(2));
            }
            Ok(1024 * most)
        });
    let (peak, needed) = (answer.unwrap(), planned(&bench, "case.toml", "memory_bytes"));
    assert!(peak > 0 && peak < needed + bytes / 4, "{peak} bytes, planned {needed}, kept {bytes}");
}

#[test]
fn a_study_is_refused_grids_that_no_case_may_have() {
    let bench = Bench::new("memory-study");
    bench.file("case.toml", SPHERE);
    for (cells, words) in [
        ("1000000", "--cells 1000000"),
        ("16385", "at least 4, at most 16384"),
        ("3", "at least 4, at most 16384"),
        ("9000", "67108864 cells in all"),
    ] {
        let started = Instant::now();
        let answer = bench.fret(&["study", "case.toml", "--cells", cells]);
        assert_eq!(answer.code, Some(1), "{cells}: {}", answer.err);
        assert!(answer.err.contains(words) && answer.err.contains("--cells"), "{cells}: {}", answer.err);
        assert!(started.elapsed().as_secs() < 20, "refused before anything is solved");
    }
    assert_eq!(bench.names(), ["case.toml"]);
}

#[cfg(target_os = "linux")]
#[test]
fn a_study_is_refused_grids_that_the_memory_does_not_hold() {
    let bench = Bench::new("memory-study-limit");
    bench.file("case.toml", SPHERE);
    let answer = limited(&bench, 500, &["study", "case.toml", "--cells", "16,2048"]);
    assert_eq!(answer.code, Some(1), "{}", answer.err);
    assert!(answer.err.contains("--cells 2048") && answer.err.contains("ulimit -v"), "{}", answer.err);
    assert_eq!(bench.names(), ["case.toml"]);
}

#[cfg(target_os = "linux")]
#[test]
fn a_file_longer_than_any_grid_is_refused_by_its_size_unread() {
    let bench = Bench::new("memory-file");
    File::create(bench.folder.join("heights.npy")).unwrap().set_len(3 << 30).unwrap();
    let case = SPHERE.replace("radius = 10e-3", "radius = 10e-3\n[profile.heights]\nfile = \"heights.npy\"");
    bench.file("case.toml", &case);
    // To read it would take more than the limit.
    let answer = limited(&bench, 1000, &["check", "case.toml"]);
    assert_eq!(answer.code, Some(1), "{}", answer.err);
    assert!(answer.err.contains("3072 MB long; at most 1024 MB"), "{}", answer.err);
}

#[cfg(target_os = "linux")]
#[test]
fn an_archive_that_outgrows_its_disk_is_told_in_one_line() {
    let bench = Bench::new("full-disk");
    assert_eq!(bench.file("case.toml", &sphere(64)).fret(&["run", "case.toml", "--quiet"]).code, Some(0));
    // A file may not grow beyond 20 blocks, and the system says so instead of ending the process.
    let mut command = std::process::Command::new("sh");
    let call = "trap '' XFSZ; ulimit -f 20; exec \"$FRET\" export results/case --npz";
    command.args(["-c", call]).env("FRET", env!("CARGO_BIN_EXE_fret")).current_dir(&bench.folder);
    let answer = Answer::from(command.output().unwrap());
    assert_eq!(answer.code, Some(2), "{}", answer.err);
    assert_eq!(answer.err.lines().count(), 1, "{}", answer.err);
    assert!(answer.err.contains("export.npz: cannot be written"), "{}", answer.err);
    assert!(!bench.folder.join("results/case/export.npz").exists());
}
