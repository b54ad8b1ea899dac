//! What makes the command easy to live with: cases to begin with, warnings explained, standard input and shells.

use std::f64::consts::{PI, TAU};
use std::io::Write;
use std::process::{Command, Stdio};

use serde_json::Value;

use crate::bench::{Bench, SPHERE};

/// What `fret` answers to a text on its standard input: exit code, standard output, standard error.
fn piped(bench: &Bench, words: &[&str], text: &str) -> (Option<i32>, String, String) {
    let mut child = Command::new(env!("CARGO_BIN_EXE_fret"))
        .args(words)
        .current_dir(&bench.folder)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // a verb that does not read it may have ended
    let _ = child.stdin.take().unwrap().write_all(text.as_bytes());
    let done = child.wait_with_output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (done.status.code(), text(done.stdout), text(done.stderr))
}

/// Every template is written, good, without a warning, declares its units, and is solved.
#[test]
fn every_template_is_a_case_that_runs() {
    let bench = Bench::new("templates");
    let list: Value = serde_json::from_str(&bench.fret(&["init", "--json"]).out).unwrap();
    let templates = list["templates"].as_array().unwrap();
    assert_eq!(templates.len(), 8);
    for template in templates {
        let name = template["name"].as_str().unwrap();
        let written = bench.fret(&["init", name]);
        assert_eq!(written.code, Some(0), "{name}: {}", written.err);
        let path = format!("{name}.toml");
        let text = bench.text(&path);
        // the commands in its first lines name it
        assert!(text.contains("[units]") && !text.contains("FILE"), "{name}");
        let check = bench.fret(&["check", &path]);
        assert!(check.out.starts_with(&format!("{path}: good\n")), "{name}: {}{}", check.out, check.err);
        let run = bench.fret(&["run", &path, "-q", "-o", name]);
        assert_eq!(run.code, Some(0), "{name}: {}", run.err);
        assert_eq!(bench.warnings(name), "[]", "{name}");
        // an earlier file is not replaced
        let again = bench.fret(&["init", name]);
        assert_eq!(again.code, Some(1));
        assert!(again.err.contains("exists already"), "{}", again.err);
    }
    let unknown = bench.fret(&["init", "ball"]);
    assert!(unknown.err.contains("there are: ball-on-flat, coated"), "{}", unknown.err);
    std::fs::create_dir(bench.folder.join("beside")).unwrap();
    bench.file("beside/rough-heights.txt", "1 2\n");
    let beside = bench.fret(&["init", "rough", "-o", "beside/mine.toml"]);
    assert!(beside.err.contains("choose another folder"), "{}", beside.err);
    assert!(bench.fret(&["init", "wear", "-o", "-"]).err.contains("written to a file"));
    assert_eq!(bench.fret(&["init", "-o", "x.toml"]).code, Some(1));
    let list = bench.fret(&["init"]).out;
    assert!(list.contains("ball-on-flat") && list.contains("indentation"), "{list}");
}

/// The rough template repeats without a seam, and its largest pressure has a limit: on finer cells it changes less and less, by half at the
/// least (the edges of the contacts are found to a cell).
#[test]
fn the_rough_template_repeats_and_converges() {
    let bench = Bench::new("template-rough");
    assert_eq!(bench.fret(&["init", "rough"]).code, Some(0));
    let rows: Vec<Vec<f64>> = bench
        .text("rough-heights.txt")
        .lines()
        .filter(|line| !line.starts_with('#'))
        .map(|line| line.split(' ').map(|height| height.parse().unwrap()).collect())
        .collect();
    let (nx, ny) = (rows.len(), rows[0].len());
    // second differences
    let bend = |at: [usize; 2], step: [usize; 2]| {
        let to = |times: usize| rows[(at[0] + times * step[0]) % nx][(at[1] + times * step[1]) % ny];
        (to(0) - 2.0 * to(1) + to(2)).abs()
    };
    // Of a sum of waves no shorter than w points none is larger than (2 pi / w)^2 of its largest height (Bernstein), which is at most 1 / cos(pi / w)
    // of that at the points (Ehlich and Zeller). The file has five decimals, and each height counts as often as it does in a difference.
    let shortest = 16.0;
    let mean = rows.iter().flatten().sum::<f64>() / (nx * ny) as f64;
    let largest = rows.iter().flatten().map(|height| (height - mean).abs()).fold(0.0, f64::max);
    let bound = (TAU / shortest).powi(2) * largest / (PI / shortest).cos() + 4.0 * 0.5e-5;
    for (x, y) in (0..nx).flat_map(|x| (0..ny).map(move |y| (x, y))) {
        for step in [[1, 0], [0, 1]] {
            let found = bend([x, y], step);
            assert!(found <= bound, "{found} above {bound} from ({x}, {y}) by {step:?}");
        }
    }
    let answer = bench.fret(&["study", "rough.toml", "--cells", "16,32,64", "--json"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    let told: Value = serde_json::from_str(&answer.out).unwrap();
    let levels = told["lines"][0]["levels"].as_array().unwrap();
    let pressures: Vec<f64> =
        levels.iter().map(|level| level["ends"][0]["max_pressure"].as_f64().unwrap()).collect();
    let changes: Vec<f64> = pressures.windows(2).map(|pair| (pair[1] - pair[0]).abs()).collect();
    assert!(changes[1] < 0.5 * changes[0], "{pressures:?}");
    // on cells finer than its points it is straight between them, and its creases have no largest pressure: so say the run and its page
    for (cells, has_creases) in [(64, false), (128, true)] {
        let case =
            bench.text("rough.toml").replace("cells = [64, 64]", &format!("cells = [{cells}, {cells}]"));
        let run = bench.file("cells.toml", &case).fret(&["run", "cells.toml", "--force", "-o", "run"]);
        assert_eq!(run.code, Some(0), "{}", run.err);
        assert_eq!(run.out.contains("limit of max pressure"), has_creases, "{cells}: {}", run.out);
        assert_eq!(bench.fret(&["report", "run"]).code, Some(0));
        assert_eq!(bench.text("run/report.html").contains("(no limit: it grows"), has_creases, "{cells}");
    }
}

#[test]
fn every_warning_is_explained() {
    let bench = Bench::new("explained");
    let all: Value = serde_json::from_str(&bench.fret(&["explain", "--json"]).out).unwrap();
    let all = all["warnings"].as_array().unwrap();
    assert_eq!(all.len(), 17);
    let page =
        std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/reference/messages.md"))
            .unwrap();
    for warning in all {
        let name = warning["name"].as_str().unwrap();
        // the manual has it, too
        assert!(page.contains(&format!("`{name}`")), "{name}");
        let told = bench.fret(&["explain", name]);
        assert_eq!(told.code, Some(0), "{}", told.err);
        for part in ["consequence", "help"] {
            assert!(told.out.contains(warning[part].as_str().unwrap()), "{name}: {}", told.out);
        }
        assert_eq!(told.out, bench.fret(&["explain", warning["quantity"].as_str().unwrap()]).out);
    }
    assert!(bench.fret(&["explain", "moving_in_few_increments"]).out.contains("at most 0.16667\n"));
    let wrong = bench.fret(&["explain", "waves"]);
    assert_eq!(wrong.code, Some(1));
    assert!(bench.fret(&["explain", "wave"]).err.contains("did you mean few_cells_per_wave?"));
    // what its message begins with, with the stage that it is about or without it
    for (words, name) in [
        ("the coating is thinner than a cell (0.42 cells)", "coating_thinner_than_cell"),
        (
            "stage \"press: twice\": the contact radius grows by 4.1 cells per increment",
            "pressing_in_few_increments",
        ),
        ("the contact radius grows", "pressing_in_few_increments"),
        ("cells in the contact radius: 4.2, stage \"press\"", "few_cells"),
    ] {
        let told = bench.fret(&["explain", words]);
        assert!(told.out.starts_with(&format!("{name}\n")), "{words}: {}{}", told.out, told.err);
    }
    // the first words of its message, where they are of one alone
    assert!(bench.fret(&["explain", "cells in the"]).out.starts_with("few_cells\n"));
    assert!(bench.fret(&["explain", "a"]).err.contains("lists them all"));
    // programs get the way out, too
    let wrong: Value = serde_json::from_str(&bench.fret(&["explain", "waves", "--json"]).out).unwrap();
    assert_eq!(wrong["help"], "`fret explain` lists them all");
}

#[test]
fn a_case_comes_from_standard_input() {
    let bench = Bench::new("piped");
    let (code, out, err) = piped(&bench, &["check", "-"], SPHERE);
    assert_eq!(code, Some(0), "{err}");
    assert!(out.starts_with("stdin: good"), "{out}");
    let (code, _, err) = piped(&bench, &["check", "-"], &SPHERE.replace("radius = 10e-3", "radius = -1.0"));
    assert_eq!(code, Some(1));
    assert!(err.contains("stdin:14:10"), "{err}");
    let (code, _, err) = piped(&bench, &["check", "-"], "\n");
    assert_eq!(code, Some(1));
    assert!(err.contains("nothing came from standard input"), "{err}");
    // what another file names is a file
    bench.file("sweep.toml", "base = \"-\"\n[axes]\n\"friction.coefficient\" = [0.1, 0.2]\n");
    let (code, _, err) = piped(&bench, &["sweep", "sweep.toml"], SPHERE);
    assert_eq!(code, Some(1), "{err}");
    let (code, _, err) = piped(&bench, &["run", "-", "-q", "-o", "piped"], SPHERE);
    assert_eq!(code, Some(0), "{err}");
    bench.file("case.toml", SPHERE).fret(&["run", "case.toml", "--quiet", "--out", "named"]);
    let numbers = |folder: &str| bench.text(&format!("{folder}/cycles.csv"));
    assert_eq!(numbers("piped"), numbers("named"));
    assert_eq!(bench.text("piped/case.toml"), SPHERE);
}

/// Hertz: a^3 = 3 P R / (4 E*), E* = 210e9 / 0.91: 32 um, 3.2 cells of 10 um.
#[test]
fn check_and_plan_tell_the_cells_in_the_contact_radius() {
    let bench = Bench::new("cells");
    let check = bench.file("case.toml", SPHERE).fret(&["check", "case.toml", "--json"]);
    let cells =
        serde_json::from_str::<Value>(&check.out).unwrap()["cells_in_contact_radius"].as_f64().unwrap();
    let radius = (0.75 * 10e-3 / (210e9 / 0.91_f64)).cbrt();
    // the contact of a plan is known to a twentieth
    assert!((cells / (radius / 10e-6) - 1.0).abs() < 0.05, "{cells} {radius}");
    for verb in ["check", "plan"] {
        let told = bench.fret(&[verb, "case.toml"]).out;
        assert!(told.contains("cells in the expected contact radius, about 0.00003"), "{told}");
    }
}

#[test]
fn a_verbose_run_tells_every_increment_and_the_methods() {
    let bench = Bench::new("verbose");
    let run = bench.file("case.toml", SPHERE).fret(&["run", "case.toml", "-v", "-o", "out"]);
    assert_eq!(run.code, Some(0), "{}", run.err);
    assert_eq!(run.err.lines().filter(|line| line.starts_with("increment ")).count(), 19, "{}", run.err);
    let methods = "Coulomb's law held in every cell with a friction coefficient of 0.1";
    assert!(run.out.contains(methods), "{}", run.out);
    assert_eq!(bench.fret(&["report", "out"]).code, Some(0));
    assert!(
        bench
            .text("out/report.html")
            .contains("Coulomb's law held in every cell with a friction coefficient of 0.1")
    );
    assert_eq!(bench.fret(&["run", "case.toml", "-v", "-q"]).code, Some(1));
}

#[test]
fn shells_and_man_know_every_verb() {
    let bench = Bench::new("shells");
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let script = bench.fret(&["completions", shell]);
        assert_eq!(script.code, Some(0), "{}", script.err);
        for verb in ["run", "identify", "explain"] {
            assert!(script.out.contains(verb), "{shell} {verb}");
        }
    }
    let page = bench.fret(&["man"]).out;
    assert!(page.contains(".TH fret 1") && page.contains("identify"), "{page}");
    assert_eq!(bench.fret(&["man", "-o", "pages"]).code, Some(0));
    assert!(bench.text("pages/fret-sweep.1").contains("Parameter sweep"));
}
