//! Runs that start from a solved state: what they find is what one unbroken run finds; states of another setting are refused.

use serde_json::Value;

use crate::bench::{Bench, SPHERE};

/// Coated, so that pressure and shear act on each other, and pulled in both directions.
const HEAD: &str = r"
[grid]
cells = [20, 24]
size = [200e-6, 240e-6]
[upper]
rigid = true
[lower]
coatings = [{ thickness = 20e-6, young = 400e9, poisson = 0.25 }]
substrate = { young = 210e9, poisson = 0.3 }
[profile.sphere]
radius = 10e-3
[friction]
coefficient = 0.2
";
const PRESS: &str = "[[load]]\nname = \"press\"\nnormal_force = 1.0\nincrements = 6\n";
const RUB: &str = "[[load]]\nname = \"rub\"\ntangential_force = [0.1, 0.05]\ncycles = 2\nincrements = 8\n[output]\nevery = 3\n";

/// What is compared of two histories, and to which share of its largest value: the solver's tolerance is 1e-8; tractions that
/// satisfy the equations to that differ by up to 100 times as much.
const COMPARED: [&str; 8] = [
    "normal_force",
    "approach",
    "tangential_force_x",
    "shift_x",
    "shift_y",
    "max_pressure",
    "max_shear",
    "dissipated_energy",
];
const SAME: f64 = 1e-6;

/// A column of a table.
fn column(table: &str, name: &str) -> Vec<f64> {
    let place = table.lines().next().unwrap().split(',').position(|column| column == name).unwrap();
    table.lines().skip(1).map(|line| line.split(',').nth(place).unwrap().parse().unwrap()).collect()
}

/// Asserts that the rows of `part` are the last ones of `whole`.
fn assert_goes_on(whole: &str, part: &str) {
    for name in COMPARED {
        let (all, found) = (column(whole, name), column(part, name));
        let largest = all.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
        let last = &all[all.len() - found.len()..];
        for (row, (one, other)) in last.iter().zip(&found).enumerate() {
            assert!((one - other).abs() <= SAME * largest, "{name}, row {row}: {one:e} {other:e}");
        }
    }
}

fn solved(bench: &Bench, case: &str, arguments: &[&str]) -> String {
    let name = format!("{}.toml", arguments.last().unwrap());
    let arguments =
        [&["run", &name, "--out"], &arguments[arguments.len() - 1..], &arguments[..arguments.len() - 1]];
    let answer = bench.file(&name, case).fret(&arguments.concat());
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    answer.err
}

/// The last field of a name in the store of a folder.
fn last_field(bench: &Bench, folder: &str, name: &str) -> Vec<f64> {
    let chunks = bench.folder.join(folder).join("fields.zarr").join(name).join("c");
    let last = std::fs::read_dir(&chunks).unwrap().count() - 1;
    let bytes = std::fs::read(chunks.join(format!("{last}/0/0"))).unwrap();
    bytes.chunks_exact(8).map(|eight| f64::from_le_bytes(eight.try_into().unwrap())).collect()
}

#[test]
fn press_then_rub_from_there_is_press_and_rub_in_one_run() {
    let bench = Bench::new("from-a-stage");
    solved(&bench, &format!("{HEAD}{PRESS}{RUB}"), &["whole"]);
    solved(&bench, &format!("{HEAD}{PRESS}"), &["press"]);
    let said = solved(&bench, &format!("{HEAD}{RUB}"), &["--from", "press", "rub"]);
    assert!(said.contains("starts from press, end of increment 5"), "{said}");
    let [whole, rub] = ["whole", "rub"].map(|folder| bench.text(&format!("{folder}/history.csv")));
    assert_goes_on(&whole, &rub);
    assert_eq!(column(&rub, "increment"), (0..16).map(f64::from).collect::<Vec<_>>());
    let cycles = ["whole", "rub"]
        .map(|folder| column(&bench.text(&format!("{folder}/cycles.csv")), "dissipated_energy"));
    for (one, other) in cycles[0].iter().zip(&cycles[1]) {
        assert!((one / other - 1.0).abs() < 1e-5, "{cycles:?}"); // differences of energies that agree to 1e-6 of the larger one
    }
    for name in ["pressure", "shear_x", "slip_y"] {
        let [one, other] = ["whole", "rub"].map(|folder| last_field(&bench, folder, name));
        let largest = one.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
        assert!(largest > 0.0);
        assert!(one.iter().zip(&other).all(|(one, other)| (one - other).abs() <= SAME * largest), "{name}");
    }
    let record: Value = serde_json::from_str(&bench.text("rub/run.json")).unwrap();
    assert_eq!((&record["start"]["results"], &record["start"]["increment"]), (&"press".into(), &5.into()));
    assert_eq!(record["start"]["fnv1a64"].as_str().unwrap().len(), 16);
}

#[test]
fn kept_increments_of_a_finished_run_can_be_started_from() {
    let bench = Bench::new("from-a-kept-increment");
    solved(&bench, &format!("{HEAD}{PRESS}{RUB}"), &["whole"]);
    // Increment 11 is the turning point of the first cycle, from which on nothing is known of what went before, in one run or in two.
    let on = "[[load]]\ntangential_force = [0.1, 0.05]\nincrements = 4\n";
    let turning = "[[load]]\ntangential_force = [0.1, 0.05]\nincrements = 2\n\
        [[load]]\ntangential_force = [-0.1, -0.05]\nincrements = 4\n";
    solved(&bench, &format!("{HEAD}{PRESS}{turning}{on}"), &["unbroken"]);
    solved(&bench, &format!("{HEAD}{on}"), &["--from", "whole:11", "branch"]);
    let [unbroken, branch] =
        ["unbroken", "branch"].map(|folder| bench.text(&format!("{folder}/history.csv")));
    assert_goes_on(&unbroken, &branch);

    // Increment 17 is the middle of the second cycle, where the force passes zero on its way down. End points ask for nothing that is not
    // kept there; the second order would begin with an increment of the first.
    let rub = RUB.replace("[output]\n", "[solver]\nintegration = \"end_point\"\n[output]\n");
    let going = "[[load]]\ntangential_force = [-0.1, -0.05]\nincrements = 2\n\
        [solver]\nintegration = \"end_point\"\n";
    solved(&bench, &format!("{HEAD}{PRESS}{rub}"), &["rubbed"]);
    let whole_cycle = RUB.replace("cycles = 2", "cycles = 1").replace("[output]\nevery = 3\n", "");
    let to_middle = "[[load]]\ntangential_force = [0.1, 0.05]\nincrements = 2\n\
        [[load]]\ntangential_force = [0.0, 0.0]\nincrements = 2\n";
    solved(&bench, &format!("{HEAD}{PRESS}{whole_cycle}{to_middle}{going}"), &["straight"]);
    solved(&bench, &format!("{HEAD}{going}"), &["--from", "rubbed:17", "middle"]);
    let [straight, middle] =
        ["straight", "middle"].map(|folder| bench.text(&format!("{folder}/history.csv")));
    assert_goes_on(&straight, &middle);

    let refused = bench.fret(&["run", "branch.toml", "--out", "other", "--from", "whole:15"]);
    assert_eq!(refused.code, Some(1));
    assert!(refused.err.contains("no state at the end of increment 15"), "{}", refused.err);
    // Every third increment of a stage and its last, as counted from 0 over the whole history.
    assert!(refused.err.contains("2, 5, 8, 11, 14, 17, 20, 21"), "{}", refused.err);
}

/// The second order goes on where a finished run ends, since that keeps what the solver remembers: normal and tangential force that grow together,
/// the most that it asks of the increments before. By end points of the run, and of the stage before that, where it begins anew.
#[test]
fn a_load_that_goes_on_goes_on_from_the_end_of_a_finished_run() {
    let bench = Bench::new("from-the-end");
    let both = "[[load]]\nnormal_force = 1.0\ntangential_force = [0.15, 0.05]\nincrements = 5\n";
    let on = "[[load]]\nnormal_force = 1.6\ntangential_force = [0.24, 0.08]\nincrements = 3\n";
    solved(&bench, &format!("{HEAD}{both}{on}"), &["whole"]);
    solved(&bench, &format!("{HEAD}{both}"), &["part"]);
    solved(&bench, &format!("{HEAD}{on}"), &["--from", "part", "on"]);
    solved(&bench, &format!("{HEAD}{on}"), &["--from", "whole:4", "anew"]);
    let [whole, on, anew] =
        ["whole", "on", "anew"].map(|folder| bench.text(&format!("{folder}/history.csv")));
    assert_goes_on(&whole, &on);
    let energy = |table: &str| *column(table, "dissipated_energy").last().unwrap();
    assert!((energy(&anew) / energy(&whole) - 1.0).abs() > 1e-4);
}

/// Where friction changes no increment goes on, in one run or in two; the second one does from the first.
#[test]
fn under_other_friction_nothing_is_remembered() {
    let bench = Bench::new("from-other-friction");
    let press = "[[load]]\nnormal_force = 1.0\nincrements = 3\n[[load]]\ntangential_force = [0.14, 0.0]\nincrements = 5\n";
    let on = "[[load]]\ntangential_force = [0.145, 0.0]\nincrements = 3\n";
    let other = HEAD.replace("coefficient = 0.2", "coefficient = 0.15");
    let changed = on.replace("increments = 3\n", "increments = 3\nfriction = 0.15\n");
    solved(&bench, &format!("{HEAD}{press}{changed}"), &["whole"]);
    solved(&bench, &format!("{HEAD}{press}"), &["part"]);
    solved(&bench, &format!("{other}{on}"), &["--from", "part", "on"]);
    let [whole, on] = ["whole", "on"].map(|folder| bench.text(&format!("{folder}/history.csv")));
    assert_goes_on(&whole, &on);
}

/// The fields that are asked for do not hold the slip: only the ends of stages do, in a file of their own.
#[test]
fn the_end_of_a_stage_can_be_started_from_whatever_fields_are_kept() {
    let bench = Bench::new("from-few-fields");
    solved(&bench, SPHERE, &["whole"]);
    let on = format!(
        "{}[[load]]\ntangential_force = [0.02, 0.0]\nincrements = 2\n",
        SPHERE.split("[[load]]").next().unwrap()
    );
    solved(&bench, &on, &["--from", "whole", "on"]);
    let (fields, rest) = SPHERE.split_at(SPHERE.find("[output]").unwrap());
    solved(
        &bench,
        &format!("{fields}[[load]]\ntangential_force = [0.02, 0.0]\nincrements = 2\n{rest}"),
        &["unbroken"],
    );
    let [unbroken, on_from] = ["unbroken", "on"].map(|folder| bench.text(&format!("{folder}/history.csv")));
    assert_goes_on(&unbroken, &on_from);
    let refused = bench.fret(&["run", "on.toml", "--out", "other", "--from", "whole:7"]);
    assert!(refused.err.contains("(counted from 0): 2, 18;"), "{}", refused.err);
}

/// Where the solver's memory is known, in the checkpoint of a run that did not end well, the bits are those of the unbroken run.
#[test]
fn a_failing_stage_is_mended_without_solving_the_ones_before_again_to_the_bit() {
    let bench = Bench::new("mended");
    // The force is known only when it is solved: the judge of the case cannot tell that friction will not carry it.
    let press = PRESS.replace("normal_force = 1.0", "approach = 70e-9");
    let [head, rub] = [HEAD, RUB].map(|part| part.replace("[0.1, 0.05]", "[0.06, 0.03]"));
    solved(&bench, &format!("{head}{press}{rub}"), &["whole"]);
    bench.file("failing.toml", &format!("{head}{press}{}", rub.replace("[0.06, 0.03]", "[9.0, 4.5]")));
    let failed = bench.fret(&["run", "failing.toml", "--out", "failed"]);
    assert_eq!(failed.code, Some(1), "{}", failed.err);
    assert!(failed.err.contains("--resume would end in the same increment"), "{}", failed.err);
    assert!(failed.err.contains("--from failed"), "{}", failed.err);
    solved(&bench, &format!("{head}{rub}"), &["--from", "failed", "mended"]);
    let timeless = |table: String, from: usize| -> Vec<String> {
        // Number of increment, stage, and time.
        let row = |line: &str| {
            line.split(',')
                .enumerate()
                .filter(|(n, _)| ![0, 1, 19].contains(n))
                .map(|(_, cell)| cell.to_owned())
                .collect::<Vec<_>>()
                .join(",")
        };
        table.lines().skip(1 + from).map(row).collect()
    };
    let [whole, mended] = [("whole", 6), ("mended", 0)]
        .map(|(folder, from)| timeless(bench.text(&format!("{folder}/history.csv")), from));
    assert_eq!(whole.len(), 16);
    assert_eq!(whole, mended);

    // Mended in its own file: the results it starts from are not replaced, nor are they when it starts anew.
    bench.file("failing.toml", &format!("{head}{rub}"));
    let own = bench.fret(&["run", "failing.toml", "--out", "failed", "--from", "failed"]);
    assert!(
        own.code == Some(1) && own.err.contains("would replace the results it starts from"),
        "{}",
        own.err
    );
    bench.file("failing.toml", &format!("{head}{press}{rub}"));
    let anew = bench.fret(&["run", "failing.toml", "--out", "failed"]);
    assert!(anew.code == Some(1) && anew.err.contains("before it was changed"), "{}", anew.err);
    bench.file("failing.toml", &format!("{head}{press}{}", rub.replace("[0.06, 0.03]", "[9.0, 4.5]")));

    // Meanwhile nothing of the failed run is thrown away unasked, and a run that only tries again is told the truth.
    let again = bench.fret(&["run", "failing.toml", "--out", "failed"]);
    assert_eq!(again.code, Some(1));
    assert!(again.err.contains("which failed") && again.err.contains("--from failed"), "{}", again.err);
    let resumed = bench.fret(&["run", "failing.toml", "--out", "failed", "--resume"]);
    assert_eq!(resumed.code, Some(1));
    assert!(resumed.err.contains("may fail again"), "{}", resumed.err);
}

#[test]
fn an_unfinished_run_is_shown_reported_exported_and_its_stresses_are_told() {
    let bench = Bench::new("shown-unfinished");
    let press = PRESS.replace("normal_force = 1.0", "approach = 70e-9");
    bench.file("case.toml", &format!("{HEAD}{press}{}", RUB.replace("[0.1, 0.05]", "[9.0, 4.5]")));
    assert_eq!(bench.fret(&["run", "case.toml", "--out", "failed", "--quiet"]).code, Some(1));
    let why = "ot the whole history, 6 of 22 increments: refused, increment 6 (rub): tangential force";
    let report = bench.fret(&["report", "failed"]);
    assert!(report.code == Some(0) && report.out.contains(why), "{}{}", report.out, report.err);
    assert!(bench.text("failed/report.html").contains(why));
    let export = bench.fret(&["export", "failed", "--npz"]);
    assert!(export.code == Some(0) && export.out.contains(why), "{}{}", export.out, export.err);
    let stress = bench.fret(&["stress", "failed", "--depths", "0,20e-6"]);
    assert!(stress.code == Some(0) && stress.out.contains(why), "{}{}", stress.out, stress.err);
    let record: Value = serde_json::from_str(&bench.text("failed/stress/stress.json")).unwrap();
    assert_eq!(record["increments"], serde_json::json!([2, 5]));
    assert!(record["unfinished"].as_str().unwrap().contains(why));
}

#[test]
fn a_state_of_another_setting_is_refused_with_the_key_and_both_values() {
    let bench = Bench::new("from-elsewhere");
    solved(&bench, &format!("{HEAD}{PRESS}"), &["press"]);
    for (from, to, words) in [
        ("young = 210e9", "young = 200e9", ["lower.substrate.young = 200000000000.0", "210000000000.0"]),
        ("thickness = 20e-6", "thickness = 2e-5\n", ["", ""]),
        ("thickness = 20e-6", "thickness = 30e-6", ["lower.coatings[0].thickness = 0.00003", "0.00002"]),
        ("radius = 10e-3", "radius = 12e-3", ["profile.sphere.radius = 0.012", "0.01"]),
        ("cells = [20, 24]", "cells = [40, 24]", ["grid.cells = [40,24]", "[20,24]"]),
        ("rigid = true", "substrate = { young = 210e9, poisson = 0.3 }", ["upper = ", "\"rigid\""]),
        ("coefficient = 0.2", "coefficient = 0.3", ["", ""]),
        ("size = [200e-6, 240e-6]", "size = \"auto\"", ["", ""]),
    ] {
        let case = format!("{HEAD}{RUB}").replace(from, &to.replace('\n', ""));
        let answer = bench.file("case.toml", &case).fret(&["check", "case.toml", "--from", "press"]);
        if words[0].is_empty() {
            assert_eq!(answer.code, Some(0), "{to}: {}", answer.err);
        } else {
            assert_eq!(answer.code, Some(1), "{to}: {}", answer.out);
            assert!(words.iter().all(|word| answer.err.contains(word)), "{to}: {}", answer.err);
            assert!(answer.err.contains("case.toml:"), "with its place: {}", answer.err);
        }
    }
    // Without a state there is nothing to go on from.
    bench.file("case.toml", &format!("{HEAD}{RUB}"));
    let refused = bench.fret(&["check", "case.toml"]);
    assert!(refused.code == Some(1) && refused.err.contains("--from RESULTS"), "{}", refused.err);
    let refused = bench.fret(&["run", "case.toml", "--from", "nowhere"]);
    assert!(refused.code == Some(1) && refused.err.contains("no such folder"), "{}", refused.err);
    // What the state holds tangentially counts in what friction carries.
    let pulled = format!("{HEAD}[[load]]\nnormal_force = 0.1\nincrements = 2\n");
    solved(
        &bench,
        &format!("{HEAD}{PRESS}[[load]]\ntangential_force = [0.1, 0.0]\nincrements = 4\n"),
        &["pulled"],
    );
    let refused = bench.file("case.toml", &pulled).fret(&["run", "case.toml", "--from", "pulled"]);
    assert!(refused.code == Some(1) && refused.err.contains("friction carries at most"), "{}", refused.err);
}

/// Between equal bodies, where half or a quarter of the grid is solved: a state that is not symmetric is solved whole.
#[test]
fn a_state_that_is_no_mirror_image_of_itself_is_gone_on_with_rightly() {
    let bench = Bench::new("from-askew");
    let head = HEAD.replace("coatings = [{ thickness = 20e-6, young = 400e9, poisson = 0.25 }]\n", "");
    let askew = "[[load]]\ntangential_force = [0.05, 0.08]\nincrements = 4\n[[load]]\ntangential_force = [0.0, 0.0]\nincrements = 3\n";
    let on = "[[load]]\ntangential_force = [0.1, 0.0]\nincrements = 4\n";
    solved(&bench, &format!("{head}{PRESS}{askew}{on}"), &["whole"]);
    solved(&bench, &format!("{head}{PRESS}{askew}"), &["askew"]);
    solved(&bench, &format!("{head}{on}"), &["--from", "askew", "on"]);
    let [whole, part] = ["whole", "on"].map(|folder| bench.text(&format!("{folder}/history.csv")));
    assert_goes_on(&whole, &part);
    assert!(
        column(&part, "shift_y").iter().any(|shift| shift.abs() > 1e-10),
        "slip across must have left a shift"
    );
}

#[test]
fn worn_surfaces_stay_worn() {
    let bench = Bench::new("from-worn");
    // By end points: the rule of second order goes on from what the solver remembers of the increments before.
    let wear = "[wear]\ncoefficient = 2e-11\n[solver]\nintegration = \"end_point\"\n";
    let rub = "[[load]]\nshift = [60e-9, 0.0]\ncycles = 3\nincrements = 8\n";
    let on = "[[load]]\nshift = [40e-9, 0.0]\ncycles = 2\nincrements = 8\n";
    solved(&bench, &format!("{HEAD}{wear}{PRESS}{rub}{on}"), &["whole"]);
    solved(&bench, &format!("{HEAD}{wear}{PRESS}{rub}"), &["worn"]);
    solved(&bench, &format!("{HEAD}{wear}{on}"), &["--from", "worn", "on"]);
    let [whole, part] = ["whole", "on"].map(|folder| bench.text(&format!("{folder}/history.csv")));
    assert_goes_on(&whole, &part);
    let depths =
        ["whole", "on"].map(|folder| column(&bench.text(&format!("{folder}/cycles.csv")), "max_worn_depth"));
    for (one, other) in depths[0][3..].iter().zip(&depths[1]) {
        assert!((one / other - 1.0).abs() < 1e-6, "{depths:?}");
    }
    // Without wear the depth stays as it is: released and pressed again, the worn surfaces meet otherwise than new ones.
    let press = "[[load]]\nshift = [0.0, 0.0]\nincrements = 2\n[[load]]\nnormal_force = 0.01\nincrements = 2\n[[load]]\nnormal_force = 1.0\nincrements = 2\n";
    solved(&bench, &format!("{HEAD}{press}"), &["--from", "worn", "worn-press"]);
    solved(&bench, &format!("{HEAD}{PRESS}"), &["press"]);
    let ends = ["worn-press", "press"]
        .map(|folder| *column(&bench.text(&format!("{folder}/history.csv")), "approach").last().unwrap());
    let deepest = *depths[0][2..3].last().unwrap();
    assert!(ends[0] - ends[1] > 0.2 * deepest, "{ends:?}, worn by {deepest:e}");
}

#[cfg(unix)]
#[test]
#[ignore = "long: 7 s"]
fn a_run_from_a_state_that_is_killed_goes_on_to_the_bit_without_its_source() {
    let bench = Bench::new("from-killed");
    let rub = RUB.replace("cycles = 2", "cycles = 20");
    solved(&bench, &format!("{HEAD}{PRESS}"), &["press"]);
    solved(&bench, &format!("{HEAD}{rub}"), &["--from", "press", "whole"]);
    bench.file("case.toml", &format!("{HEAD}{rub}"));
    let mut run = bench
        .command(&["run", "case.toml", "--from", "press", "--out", "broken", "--quiet"])
        .spawn()
        .unwrap();
    let table = bench.folder.join("broken/history.csv");
    let written = || std::fs::read_to_string(&table).map_or(0, |text| text.lines().count());
    while written() < 30 && run.try_wait().unwrap().is_none() {
        std::thread::sleep(std::time::Duration::from_millis(1));
    }
    run.kill().unwrap();
    run.wait().unwrap();
    std::fs::remove_dir_all(bench.folder.join("press")).unwrap();
    let answer = bench.fret(&["run", "case.toml", "--out", "broken", "--resume"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    assert!(answer.err.contains("continuing with increment"), "{}", answer.err);
    for name in [COMPARED.as_slice(), &["convolutions"]].concat() {
        let [whole, broken] =
            ["whole", "broken"].map(|folder| column(&bench.text(&format!("{folder}/history.csv")), name));
        assert_eq!(whole, broken, "{name}");
    }
    let [whole, broken] = ["whole", "broken"]
        .map(|folder| -> Value { serde_json::from_str(&bench.text(&format!("{folder}/run.json"))).unwrap() });
    assert_eq!(whole["start"], broken["start"]);
}

#[test]
fn a_sweep_branches_from_one_state() {
    let bench = Bench::new("sweep-from");
    solved(&bench, &format!("{HEAD}{PRESS}"), &["press"]);
    bench.file("rub.toml", &format!("{HEAD}{RUB}"));
    bench.file("many.toml", "base = \"rub.toml\"\n[axes]\n\"load.rub.tangential_force.0\" = [0.02, 0.1]\n");
    let answer = bench.fret(&["sweep", "many.toml", "--from", "press", "--quiet"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    solved(&bench, &format!("{HEAD}{RUB}"), &["--from", "press", "rub"]);
    let alone = column(&bench.text("rub/history.csv"), "dissipated_energy");
    let summary = bench.text("results/many/summary.csv");
    let energies: Vec<&str> = summary.lines().skip(1).map(|line| line.split(',').nth(9).unwrap()).collect();
    assert_eq!(energies[1].parse::<f64>().unwrap(), *alone.last().unwrap(), "{summary}");
}

#[test]
fn states_take_little_room_beside_the_fields() {
    fn bytes(folder: &std::path::Path) -> u64 {
        let entries = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
        entries.map(|path| if path.is_dir() { bytes(&path) } else { path.metadata().unwrap().len() }).sum()
    }
    let bench = Bench::new("state-size");
    solved(&bench, &format!("{HEAD}{PRESS}{RUB}"), &["whole"]);
    let [states, fields] =
        ["states", "fields.zarr"].map(|name| bytes(&bench.folder.join("whole").join(name)));
    let memory = bench.folder.join("whole/states/memory").metadata().unwrap().len();
    // One byte a cell for the zones at the most, packed, beside 41 of the fields.
    assert!((states - memory) * 40 < fields, "{states} {fields}");
    // Once a run: tractions and gap before the last increment, drift of two and the gap after it, eleven numbers a cell.
    assert!(memory < 11 * 8 * 20 * 24, "{memory}");
}
