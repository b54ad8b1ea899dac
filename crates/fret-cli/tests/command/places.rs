//! Where answers go: what others have there is never overwritten, deleted or reached through a link.

use crate::bench::{Bench, SPHERE};

#[test]
fn a_path_through_a_folder_that_is_not_there_yet_is_looked_at_as_what_it_will_be() {
    let bench = Bench::new("resolved");
    std::fs::create_dir_all(bench.folder.join("mine/fields.zarr")).unwrap();
    bench.file("case.toml", SPHERE).file("mine/history.csv", "mine").file("mine/fields.zarr/a", "mine");
    for arguments in [
        &["run", "case.toml", "--out", "new/../mine"][..],
        &["study", "case.toml", "--cells", "8,16", "--out", "new/../mine"],
        &["identify", "case.toml", "--case", "case.toml", "--out", "new/../mine"],
    ] {
        let answer = bench.fret(arguments);
        assert_eq!(answer.code, Some(1), "{arguments:?}: {}", answer.err);
        assert!(answer.err.contains("holds files that are not"), "{arguments:?}: {}", answer.err);
    }
    assert_eq!(bench.text("mine/history.csv") + &bench.text("mine/fields.zarr/a"), "minemine");
    assert_eq!(bench.names(), ["case.toml", "mine"]);
    // A case whose name ends in dots has results of its own as well.
    bench.file("...toml", SPHERE).file("history.csv", "mine");
    assert_eq!(bench.fret(&["run", "...toml", "--quiet"]).code, Some(0));
    assert_eq!(bench.text("history.csv"), "mine");
    assert!(bench.folder.join("results/case/history.csv").exists());
}

#[test]
fn a_study_and_an_identification_do_not_write_into_results() {
    let bench = Bench::new("asks-first");
    bench.file("case.toml", SPHERE).file("log.csv", "displacement,force\n0,0\n");
    assert_eq!(bench.fret(&["run", "case.toml", "--out", "run", "--quiet"]).code, Some(0));
    let before = bench.text("run/cycles.csv");
    for arguments in [
        &["study", "case.toml", "--cells", "8,16", "--out", "run"][..],
        &["identify", "log.csv", "--case", "case.toml", "--out", "run"],
    ] {
        let answer = bench.fret(arguments);
        assert_eq!(answer.code, Some(1), "{arguments:?}: {}", answer.err);
        assert!(answer.err.contains("choose another folder"), "{arguments:?}: {}", answer.err);
    }
    assert_eq!(bench.text("run/cycles.csv"), before);
}

/// Whatever link lies in a folder of results: the file or folder that it leads to stays as it is.
#[cfg(unix)]
#[test]
fn nothing_is_written_through_a_link() {
    let bench = Bench::new("through-links");
    bench.file("case.toml", SPHERE);
    let run = ["run", "case.toml", "--out", "run", "--quiet"];
    assert_eq!(bench.fret(&run).code, Some(0));
    let (run_again, forced) = (&run[..], &[&run[..], &["--force"]].concat()[..]);
    let stress: &[&str] = &["stress", "run", "--depths", "2e-5", "--volume", "--quiet"];
    for (name, is_folder, writers) in [
        ("history.csv", false, &[run_again, forced][..]),
        ("cycles.csv", false, &[run_again, forced]),
        ("checkpoint", true, &[run_again, forced]),
        ("fields.zarr", true, &[run_again, forced]),
        ("fields.zarr/pressure", true, &[run_again, forced]),
        ("states", true, &[run_again, forced]),
        ("run.json.part", false, &[run_again, forced]),
        ("report.html.part", false, &[&["report", "run"]]),
        ("export.npz.part", false, &[&["export", "run", "--npz"]]),
        ("csv", true, &[&["export", "run", "--csv"]]),
        ("vtk", true, &[&["export", "run", "--vtk"]]),
        ("stress", true, &[stress]),
    ] {
        for dangling in [false, true] {
            let (link, victim) = (bench.folder.join("run").join(name), bench.folder.join("victim"));
            let aside = bench.folder.join("aside");
            let was_there = std::fs::rename(&link, &aside).is_ok();
            if !dangling && is_folder {
                std::fs::create_dir(&victim).unwrap();
                std::fs::write(victim.join("precious"), "precious").unwrap();
            } else if !dangling {
                std::fs::write(&victim, "precious").unwrap();
            }
            for writer in writers {
                let _ = std::fs::remove_file(&link);
                std::os::unix::fs::symlink(&victim, &link).unwrap();
                let answer = bench.fret(writer);
                assert!(!answer.err.contains("panicked"), "{}", answer.err);
                let is_whole = match (dangling, is_folder) {
                    (true, _) => !victim.exists(),
                    (false, false) => bench.text("victim") == "precious",
                    (false, true) => {
                        bench.text("victim/precious") == "precious"
                            && std::fs::read_dir(&victim).unwrap().count() == 1
                    }
                };
                assert!(is_whole, "{name} {writer:?}: written through: {}", answer.err);
            }
            let remove = if link.is_symlink() || link.is_file() {
                std::fs::remove_file
            } else {
                std::fs::remove_dir_all
            };
            let _ = remove(&link);
            if was_there {
                std::fs::rename(&aside, &link).unwrap();
            }
            let _ = std::fs::remove_file(&victim);
            let _ = std::fs::remove_dir_all(&victim);
            // The run is whole again, for the next link.
            assert_eq!(bench.fret(&run).code, Some(0), "{name}");
        }
    }
}

/// Programs read JSON; letters that would steer a terminal are letters of it.
#[test]
fn json_is_json_whatever_a_stage_is_called() {
    let bench = Bench::new("odd-names");
    let name = "a\u{7f}\u{85}\u{200e}\u{202e}\u{2066}b";
    let written = "\"a\\u007f\\u0085\\u200e\\u202e\\u2066b\"";
    bench.file("case.toml", &SPHERE.replace("\"fretting\"", written));
    for verb in [&["plan", "case.toml"][..], &["run", "case.toml", "--out", "run", "--quiet"]] {
        let answer = bench.fret(&[verb, &["--json"]].concat());
        assert_eq!(answer.code, Some(0), "{}", answer.err);
        let told: serde_json::Value = serde_json::from_str(&answer.out).unwrap();
        let stages = if verb[0] == "plan" { &told["case"]["stages"] } else { &told["stages"] };
        assert_eq!(stages[1]["name"], name, "{}", answer.out);
        assert!(!answer.out.chars().any(|letter| "\u{7f}\u{85}\u{200e}\u{202e}\u{2066}".contains(letter)));
    }
}

/// A sweep reads no more than a case would be given, and no pipes.
#[cfg(unix)]
#[test]
fn a_sweep_refuses_what_has_no_end() {
    let bench = Bench::new("endless-sweeps");
    let axes = "[axes]\n\"lower.substrate.young\" = [1e11, 2e11]\n";
    let case = SPHERE.replace("coefficient = 0.1", "map = \"/dev/zero\"");
    bench.file("case.toml", &case).file("sweep.toml", &format!("base = \"case.toml\"\n{axes}"));
    let answer = bench.fret(&["sweep", "sweep.toml", "--out", "out"]);
    assert_ne!(answer.code, Some(0));
    assert!(std::process::Command::new("mkfifo").arg(bench.folder.join("pipe")).status().unwrap().success());
    bench.file("piped.toml", &format!("base = \"pipe\"\n{axes}"));
    let answer = bench.fret(&["sweep", "piped.toml", "--out", "out"]);
    assert!(answer.code == Some(1) && answer.err.contains("no ordinary file"), "{}", answer.err);
    let long = format!("base = \"case.toml\"\n# {}\n{axes}", "x".repeat(4 << 20));
    let answer = bench.file("long.toml", &long).fret(&["sweep", "long.toml", "--out", "out"]);
    assert!(answer.code == Some(1) && answer.err.contains("at most 4194304"), "{}", answer.err);
    let many = format!("base = \"case.toml\"\n{axes}{}", "[[point]]\n".repeat(60_000));
    let answer = bench.file("many.toml", &many).fret(&["sweep", "many.toml", "--out", "out"]);
    assert!(answer.code == Some(1) && answer.err.contains("brackets"), "{}", answer.err);
}

/// What a spreadsheet would compute stands in the summary as a text; a date as one, too.
#[test]
fn cells_of_a_summary_are_no_formulas() {
    let bench = Bench::new("formulas");
    bench
        .file("case.toml", SPHERE)
        .file("sweep.toml", "base = \"case.toml\"\n[axes]\ntitle = [\"=1+1\", \"@a\", \"a = b\"]\n");
    let answer = bench.fret(&["sweep", "sweep.toml", "--out", "out", "--quiet"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    let summary = bench.text("out/summary.csv");
    let titles: Vec<&str> = summary.lines().skip(1).map(|line| line.split(',').nth(1).unwrap()).collect();
    assert_eq!(titles, ["'=1+1", "'@a", "a = b"]);
}

/// A run under `nohup` outlives its terminal; under a limit of the sizes of files it fails in words.
#[cfg(unix)]
#[test]
fn signals_that_are_ignored_stay_ignored_and_full_files_are_told() {
    use std::process::{Command, Stdio};
    let bench = Bench::new("signals");
    bench.file("case.toml", &SPHERE.replace("[24, 24]", "[64, 64]").replace("cycles = 2", "cycles = 40"));
    let shell = |words: &str| {
        let mut command = Command::new("sh");
        command.args(["-c", words, "sh", env!("CARGO_BIN_EXE_fret")]).current_dir(&bench.folder);
        command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap()
    };
    if cfg!(target_os = "linux") {
        let mut run = shell("trap '' HUP; exec \"$1\" run case.toml --out run --quiet");
        while !bench.folder.join("run/checkpoint/even").exists() && run.try_wait().unwrap().is_none() {
            std::thread::sleep(std::time::Duration::from_millis(2));
        }
        assert!(Command::new("kill").args(["-HUP", &run.id().to_string()]).status().unwrap().success());
        let answer = run.wait_with_output().unwrap();
        assert_eq!(answer.status.code(), Some(0), "{}", String::from_utf8_lossy(&answer.stderr));
    }
    let answer =
        shell("ulimit -f 8; exec \"$1\" run case.toml --out small --quiet").wait_with_output().unwrap();
    let told = String::from_utf8_lossy(&answer.stderr).into_owned();
    assert_eq!(answer.status.code(), Some(2), "{told}");
    assert!(told.contains("longer than a file may be"), "{told}");
}

/// Whoever removes a file of a run while it goes is told so in the end, and no other thing.
#[test]
fn a_table_that_is_removed_during_the_run_is_missed() {
    use fret_core::history::{KeptFields, StepRecord};
    use fret_core::model::MirroredState;
    use fret_core::run::{Iteration, Observer};
    use fret_results::{Beside, CaseFile, Wish};
    use fretting_cli::embedded::{Failure, run_into};
    use std::ops::ControlFlow;
    use std::path::PathBuf;

    struct Remover(PathBuf);
    impl Observer for Remover {
        fn iterated(&mut self, _: &Iteration) -> ControlFlow<()> {
            ControlFlow::Continue(())
        }

        fn solved(
            &mut self,
            record: &StepRecord,
            _: MirroredState<'_>,
            _: Option<&KeptFields>,
        ) -> ControlFlow<()> {
            if record.increment == 4 {
                std::fs::remove_file(&self.0).unwrap();
            }
            ControlFlow::Continue(())
        }
    }
    let bench = Bench::new("removed-meanwhile");
    for (name, part) in [("one", "history.csv"), ("two", "fields.zarr/pressure/c/0/0/0")] {
        let folder = bench.folder.join(name);
        let beside = Beside { folder: bench.folder.clone(), contents: Vec::new() };
        let case = CaseFile::of_text("case", SPHERE.to_owned(), beside);
        let mut remover = Remover(folder.join(part));
        let ended = run_into(case, None, &folder, (Wish::Start, false, Some(1)), &mut remover);
        let Err(Failure::Unwritten(unwritten)) = ended else { panic!("{part}: {ended:?}") };
        let why = unwritten.to_string();
        assert!(unwritten.path == folder.join(part) && why.contains("removed or changed"), "{why}");
        assert!(bench.text(&format!("{name}/run.json")).contains("\"status\": \"failed\""));
    }
}
