//! Where an answer is written and how much is told, alike for all verbs: `-o`, `-q`, `-v`; and the answers that they write.

use serde_json::Value;

use crate::bench::{Bench, SPHERE};
use crate::scars;

/// Every verb but those whose answer is all they do (or that never ends by itself).
const WITH_RESULTS: [&str; 13] = [
    "run",
    "check",
    "plan",
    "init",
    "report",
    "export",
    "study",
    "sensitivity",
    "stress",
    "identify",
    "compare-scar",
    "heat",
    "sweep",
];

#[test]
fn every_verb_with_results_takes_the_same_options() {
    let bench = Bench::new("options");
    for verb in WITH_RESULTS {
        let help = bench.fret(&[verb, "--help"]).out;
        for option in ["  -o, --out <", "  -q, --quiet", "  -v, --verbose"] {
            assert!(help.contains(option), "{verb} {option}: {help}");
        }
        let both = bench.fret(&[verb, "-q", "-v"]);
        assert_eq!(both.code, Some(1), "{verb}");
        assert!(both.err.contains("cannot be used with"), "{verb}: {}", both.err);
    }
    let all = bench.fret(&["--help"]).out;
    let verbs = all.split("Commands:").nth(1).unwrap().split("Options:").next().unwrap();
    let names = verbs.lines().filter(|line| line.starts_with("  ") && !line.starts_with("   "));
    let names: Vec<&str> = names.filter_map(|line| line.split_whitespace().next()).collect();
    let without = ["explain", "schema", "completions", "man", "explore", "help"];
    let others: Vec<&&str> = names.iter().filter(|name| !WITH_RESULTS.contains(name)).collect();
    assert!(others.iter().all(|name| without.contains(name)) && others.len() == without.len(), "{others:?}");
}

/// Quiet says nothing at all, verbose what is done on the way and which files are written; a folder takes the answer, word for word that of
/// standard output.
#[test]
fn answers_about_a_run_go_where_they_are_asked_to() {
    let bench = Bench::new("options-used");
    let conducting = SPHERE.replace(
        "substrate = { young = 210e9, poisson = 0.3 }",
        "substrate = { young = 210e9, poisson = 0.3, thermal_conductivity = 45.0 }",
    );
    let both = conducting
        .replace("rigid = true", "substrate = { young = 210e9, poisson = 0.3, thermal_conductivity = 45.0 }");
    bench.file("case.toml", &both);
    assert_eq!(bench.fret(&["run", "case.toml", "-q", "-o", "run"]).code, Some(0));
    let of_run = |verb: &'static str| [verb, "run"];
    for (words, mark) in [
        (of_run("stress"), "stress.json"),
        (of_run("heat"), "heat.json"),
        (["sensitivity", "case.toml"], "sensitivity.json"),
        (["study", "case.toml"], "study.json"),
    ] {
        let folder = format!("told-{}", words[0]);
        let quiet = bench.fret(&[words[0], words[1], "-q", "-o", &folder]);
        assert_eq!((quiet.code, quiet.out.as_str(), quiet.err.as_str()), (Some(0), "", ""), "{words:?}");
        let told = bench.fret(&[words[0], words[1], "-v", "-o", &folder]);
        assert_eq!(told.code, Some(0), "{words:?}: {}", told.err);
        assert!(!told.out.is_empty());
        assert!(
            told.err.lines().any(|line| line.starts_with("written: ") && line.ends_with(mark)),
            "{}",
            told.err
        );
        let steps = told.err.lines().filter(|line| !line.starts_with("written: ")).count();
        assert!(steps > 1, "{words:?}: {}", told.err);
        let told = bench.fret(&[words[0], words[1], "--json", "-o", &folder]);
        let mut on_screen: Value = serde_json::from_str(&told.out).unwrap();
        let mut in_file: Value = serde_json::from_str(&bench.text(&format!("{folder}/{mark}"))).unwrap();
        for answer in [&mut on_screen, &mut in_file] {
            answer.as_object_mut().unwrap().remove("wall_s");
        }
        assert_eq!(on_screen, in_file, "{words:?}");
        // nothing but answers of this kind is replaced
        let refused = bench.fret(&[words[0], words[1], "-v", "-o", "run"]);
        assert_eq!(refused.code, Some(1), "{words:?}: {}", refused.err);
        // before any work is done for it
        assert!(refused.err.starts_with("error: run: holds files that are not those of "), "{}", refused.err);
        assert!(refused.err.contains("--out DIR"), "{words:?}: {}", refused.err);
    }
    assert!(!bench.folder.join("run/stress").exists());
    let rows = bench.text("told-sensitivity/sensitivity.csv");
    let record: Value = serde_json::from_str(&bench.text("told-sensitivity/sensitivity.json")).unwrap();
    let row = rows
        .lines()
        .find(|row| row.starts_with("max_pressure,") && row.contains(",profile.sphere.radius,"))
        .unwrap();
    let derivative: f64 = row.split(',').nth(4).unwrap().parse().unwrap();
    let by = &record["of"]["max_pressure"]["derivatives"]["profile.sphere.radius"];
    assert_eq!(Some(derivative), by.as_f64());
    for verb in ["check", "plan"] {
        let file = format!("{verb}.json");
        let quiet = bench.fret(&[verb, "case.toml", "-q", "-o", &file]);
        assert_eq!((quiet.code, quiet.out.as_str()), (Some(0), ""), "{}", quiet.err);
        assert_eq!(
            serde_json::from_str::<Value>(&bench.text(&file)).unwrap()["grid"].is_object(),
            verb == "plan"
        );
    }
    assert!(bench.fret(&["check", "case.toml", "-v"]).err.contains("automatic simplifications"));
}

/// A mistyped place for the answer of a verb that writes one file costs nobody a file.
#[test]
fn no_file_but_an_earlier_answer_is_replaced() {
    let bench = Bench::new("answers-over-files");
    bench.file("case.toml", SPHERE).file("notes", "mine");
    std::fs::create_dir(bench.folder.join("folder.json")).unwrap();
    let before = bench.names();
    for verb in ["check", "plan"] {
        for (place, words) in [
            ("case.toml", "no .json file"),
            ("notes", "no .json file"),
            ("-", "standard output"),
            ("folder.json", "a folder"),
        ] {
            let refused = bench.fret(&[verb, "case.toml", "-o", place]);
            assert_eq!((refused.code, refused.out.as_str()), (Some(1), ""), "{verb} {place}");
            assert!(refused.err.contains(words), "{verb} {place}: {}", refused.err);
        }
        assert_eq!((bench.text("case.toml").as_str(), bench.text("notes").as_str()), (SPHERE, "mine"));
        assert_eq!(bench.names(), before, "{verb}");
    }
    for verb in ["check", "plan", "check"] {
        assert_eq!(bench.fret(&[verb, "case.toml", "-o", "answer.json"]).code, Some(0), "{verb}");
    }
    // JSON of others, and what a run has written, are no earlier answers
    assert_eq!(bench.fret(&["run", "case.toml", "-o", "out", "-q"]).code, Some(0));
    bench.file("mine.json", "{\"a\": 1}");
    for place in ["mine.json", "out/run.json", "out/fields.zarr/zarr.json"] {
        let before = bench.text(place);
        assert_eq!(bench.fret(&["check", "case.toml", "-o", place]).code, Some(1), "{place}");
        assert_eq!(bench.text(place), before);
    }
}

/// An export replaces an earlier one, all of it, and neither results nor files of others.
#[test]
fn an_export_replaces_an_earlier_one_alone() {
    let bench = Bench::new("exports-over-files");
    bench.file("often.toml", SPHERE).file("ends.toml", &SPHERE.replace("every = 5", ""));
    for case in ["often", "ends"] {
        assert_eq!(bench.fret(&["run", &format!("{case}.toml"), "-o", case, "-q"]).code, Some(0));
    }
    std::fs::create_dir(bench.folder.join("mine")).unwrap();
    bench.file("mine/notes.csv", "mine");
    for form in ["--csv", "--vtk"] {
        for place in ["ends", "mine"] {
            let refused = bench.fret(&["export", "often", form, "-o", place]);
            assert!(
                refused.code == Some(1) && refused.err.contains("no earlier export of this kind"),
                "{}",
                refused.err
            );
        }
        let table = bench.text("ends/history.csv");
        assert_eq!(bench.fret(&["export", "often", form, "-o", "exported"]).code, Some(0));
        // what others put beside it stays; what a kill has left does not
        let left = if form == "--csv" { "exported/history.csv.part" } else { "exported/history.pvd.part" };
        bench.file("exported/view.pvsm", "mine").file(left, "half");
        assert_eq!(bench.fret(&["export", "ends", form, "-o", "exported"]).code, Some(0));
        let files = std::fs::read_dir(bench.folder.join("exported")).unwrap().count();
        // the history, the ends of two stages, and the file of another
        assert_eq!((files, bench.text("ends/history.csv")), (4, table), "{form}");
        assert_eq!(bench.text("exported/view.pvsm"), "mine");
        std::fs::remove_dir_all(bench.folder.join("exported")).unwrap();
    }
}

/// Stresses that were computed of earlier results in the folder are gone with them, and files of others beside them stay.
#[test]
fn answers_about_earlier_results_go_with_them() {
    let bench = Bench::new("answers-of-earlier-results");
    bench.file("case.toml", SPHERE);
    let run = || assert_eq!(bench.fret(&["run", "case.toml", "-o", "out", "-q"]).code, Some(0));
    run();
    assert_eq!(bench.fret(&["stress", "out", "--depths", "5e-6"]).code, Some(0));
    bench
        .file("out/stress/notes.csv", "mine")
        .file("case.toml", &SPHERE.replace("radius = 10e-3", "radius = 20e-3"));
    run();
    assert_eq!(bench.fret(&["report", "out"]).code, Some(0));
    assert!(!bench.text("out/report.html").contains("Stress below the surface"));
    assert_eq!(bench.text("out/stress/notes.csv"), "mine");
    // one that cannot be read is told, with what to do
    bench.file("out/stress/stress.json", "{");
    assert_eq!(bench.fret(&["report", "out"]).code, Some(0));
    assert!(bench.text("out/report.html").contains("run fret stress again"));
}

/// Which files or folders are written, and the time taken, say all verbs; the files lie where the call wants them.
#[test]
fn verbose_means_the_same_for_every_verb() {
    let bench = Bench::new("verbose-verbs");
    let body = "substrate = { young = 210e9, poisson = 0.3, thermal_conductivity = 45.0 }";
    let conducting =
        SPHERE.replace("substrate = { young = 210e9, poisson = 0.3 }", body).replace("rigid = true", body);
    bench.file("case.toml", &conducting).file("worn.toml", &scars::WORN.replace("cells = 96", "cells = 48"));
    bench.file(
        "sweep.toml",
        "base = 'case.toml'\n[distributions]\n\"friction.coefficient\" = { uniform = { from = 0.1, to = 0.2 } }\n[samples]\ncount = 2\n",
    );
    for file in ["ball_on_ball.toml", "test_12.csv"] {
        let rig = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/rig/");
        bench.file(file, &std::fs::read_to_string(format!("{rig}{file}")).unwrap());
    }
    for case in ["case", "worn"] {
        assert_eq!(bench.fret(&["run", &format!("{case}.toml"), "-q", "-o", case]).code, Some(0), "{case}");
    }
    let height = |x: f64| 2.0 - (4.0 * (1.0 - ((x - 800.0) / 200.0).powi(2))).max(0.0);
    let line = (0..321).map(|k| 5.0 * f64::from(k)).map(|x| format!("{x};{:.6}\n", height(x)));
    bench.file("line.csv", &("x [um];z [um]\n".to_owned() + &line.collect::<String>()));
    for (words, place, files) in [
        ("run case.toml", "answer/run", &[""][..]),
        ("check case.toml", "check.json", &[""]),
        ("plan case.toml", "plan.json", &[""]),
        ("init wear", "wear.toml", &[""]),
        ("report case", "page.html", &[""]),
        ("export case --csv", "answer/csv", &["/history.csv"]),
        ("study case.toml --cells 8,16", "answer/study", &["/study.json", "/study.csv", "/study.svg"]),
        ("sensitivity case.toml", "answer/sensitivity", &["/sensitivity.json", "/sensitivity.csv"]),
        ("stress case", "answer/stress", &["/stress.json"]),
        ("compare-scar worn line.csv", "answer/scar", &["/scar.json", "/scar.csv", "/scar.svg"]),
        ("heat case", "answer/heat", &["/heat.json"]),
        (
            "identify test_12.csv --case ball_on_ball.toml",
            "answer/identify",
            &["/identified.json", "/identified.html"],
        ),
        (
            "sweep sweep.toml",
            "answer/sweep",
            &["/sweep.toml", "/points.json", "/summary.csv", "/uncertainty.json"],
        ),
    ] {
        let words: Vec<&str> = words.split(' ').chain(["-v", "-o", place]).collect();
        let told = bench.fret(&words);
        assert_eq!(told.code, Some(0), "{words:?}: {}", told.err);
        assert!(told.err.lines().last().unwrap().starts_with("done in "), "{words:?}: {}", told.err);
        let written: Vec<&str> = told.err.lines().filter_map(|line| line.strip_prefix("written: ")).collect();
        for file in files {
            let wanted = format!("{place}{file}");
            let is_told = written.iter().any(|path| path.ends_with(&wanted));
            assert!(is_told && bench.folder.join(&wanted).exists(), "{words:?} {wanted}: {}", told.err);
        }
    }
    // every increment of a study once, behind the line of its level
    let study = bench.fret(&["study", "case.toml", "--cells", "8,16", "-v", "-o", "again"]).err;
    let steps: Vec<&str> = study
        .lines()
        .filter_map(|line| line.split_whitespace().next())
        .filter(|word| ["level", "increment"].contains(word))
        .collect();
    let level: Vec<&str> = std::iter::once("level").chain(std::iter::repeat_n("increment", 3 + 16)).collect();
    assert_eq!(steps, level.repeat(2), "{study}");
}

/// Results and numbers have the units of the case, in both files and on the screen.
#[test]
fn sensitivities_are_told_in_the_units_of_the_case() {
    let bench = Bench::new("sensitivity-units");
    let case = SPHERE.replacen("title =", "units = { length = \"m\", force = \"N\" }\ntitle =", 1);
    let of = ["--of", "max_pressure", "--of", "cycles[0].dissipated_energy"];
    let by = ["--by", "profile.sphere.radius", "--by", "friction.coefficient"];
    let words = [&["sensitivity", "case.toml", "-o", "out"][..], &of, &by].concat();
    let told = bench.file("case.toml", &case).fret(&words);
    assert_eq!(told.code, Some(0), "{}", told.err);
    let csv = bench.text("out/sensitivity.csv");
    let ends: Vec<[&str; 3]> = csv
        .lines()
        .map(|line| line.split(',').collect::<Vec<_>>())
        .map(|cells| [cells[0], cells[cells.len() - 2], cells[cells.len() - 1]])
        .collect();
    let wanted = [
        ["result", "unit", "unit_of_number"],
        ["max_pressure", "Pa", "m"],
        ["max_pressure", "Pa", ""],
        ["cycles[0].dissipated_energy", "N m", "m"],
        ["cycles[0].dissipated_energy", "N m", ""],
    ];
    assert_eq!(ends, wanted);
    let record: Value = serde_json::from_str(&bench.text("out/sensitivity.json")).unwrap();
    assert_eq!(record["of"]["max_pressure"]["unit"], "Pa");
    assert_eq!(record["units_of_parameters"]["profile.sphere.radius"], "m");
    assert_eq!(record["units_of_parameters"]["friction.coefficient"], Value::Null);
    assert!(told.out.contains("\n  profile.sphere.radius [m] "), "{}", told.out);
    let pressure = told.out.lines().find(|line| line.starts_with("max_pressure = ")).unwrap();
    assert!(pressure.ends_with(" Pa"), "{pressure}");
}
