//! A case that is solved: exit code 0, a summary, and a folder whose files agree with each other.

use serde_json::Value;

use crate::bench::{Bench, SPHERE};

const COLUMNS: &str = "increment,stage,normal_force,approach,tangential_force_x,tangential_force_y,shift_x,shift_y,\
                       twist_moment,twist,max_pressure,max_shear,contact_area,stick_area,dissipated_energy,residual,\
                       convolutions,preconditioner_passes,outer_iterations,wall_s,contact_cells,stick_cells,regime,\
                       full_grid_convolutions,parts,worn_volume,max_worn_depth,tilt_x,tilt_y,tilt_moment_x,tilt_moment_y,bulk_stress_x,\
                       bulk_stress_y,upper_bulk_stress_x,upper_bulk_stress_y,bulk_work,actuator_x,actuator_y,actuator_approach,\
                       friction_coefficient,elastic_energy,external_work,wear_work,unresolved_energy,roll_x,roll_y,creepage_x,creepage_y,spin,\
                       rolling_friction,debris_volume,debris_outflow,max_debris,mean_gap,yielded_area,\
                       plastic_volume,max_plastic_depth,plastic_work";

/// Increments of the small case: 3 of the indentation, 2 cycles of 8.
const INCREMENTS: usize = 19;
/// Increments whose fields are kept: every 5th of a stage, and its last.
const KEPT: [i64; 5] = [2, 7, 12, 17, 18];

fn column(table: &str, name: &str) -> Vec<f64> {
    let place = COLUMNS.split(',').position(|column| column == name).unwrap();
    table.lines().skip(1).map(|line| line.split(',').nth(place).unwrap().parse().unwrap()).collect()
}

fn chunk(bench: &Bench, key: &str) -> Vec<f64> {
    let bytes = std::fs::read(bench.folder.join("results/case/fields.zarr").join(key)).unwrap();
    bytes.chunks_exact(8).map(|eight| f64::from_le_bytes(eight.try_into().unwrap())).collect()
}

#[test]
fn a_small_fretting_case_is_solved_and_written_down() {
    let bench = Bench::new("solved");
    let answer = bench.file("case.toml", SPHERE).fret(&["run", "case.toml", "--threads", "1"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    for words in [
        "a small sphere",
        "after stage",
        "normal force",
        "energy dissipated in cycle 2",
        "in cycle 2 of fretting:",
        "sliding condition                partial slip",
        "force amplitude Q*",
        "displacement amplitude d*",
        "stiffness after reversal",
        "energy ratio A",
        "sliding ratio D",
        "results/case",
    ] {
        assert!(answer.out.contains(words), "expected {words:?}:\n{}", answer.out);
    }
    assert!(answer.err.contains("indent done") && answer.err.contains("fretting done"), "{}", answer.err);
    assert!(!answer.err.contains('\x1b'), "no colour and no bar where nobody watches: {}", answer.err);

    assert_eq!(bench.text("results/case/case.toml"), SPHERE);
    let table = bench.text("results/case/history.csv");
    assert_eq!(table.lines().next(), Some(COLUMNS));
    assert_eq!(table.lines().count(), 1 + INCREMENTS);
    let forces = column(&table, "normal_force");
    assert!((forces[INCREMENTS - 1] - 1.0).abs() < 1e-8, "a prescribed force is kept to the tolerance");
    assert!(column(&table, "residual").iter().all(|&residual| residual <= 1e-8));

    let cycles = bench.text("results/case/cycles.csv");
    let energies: Vec<f64> =
        cycles.lines().skip(1).map(|line| line.split(',').nth(5).unwrap().parse().unwrap()).collect();
    assert_eq!(energies.len(), 2);
    let dissipated = column(&table, "dissipated_energy");
    let in_cycles = dissipated[INCREMENTS - 1] - dissipated[2];
    assert!((energies.iter().sum::<f64>() / in_cycles - 1.0).abs() < 1e-12, "{energies:?} {in_cycles}");

    let record: Value = serde_json::from_str(&bench.text("results/case/run.json")).unwrap();
    assert_eq!(record["format"], 1);
    assert_eq!(record["status"], "solved");
    assert_eq!(record["threads"], 1);
    assert_eq!(record["totals"]["increments"], INCREMENTS);
    assert_eq!(record["plan"]["case"]["output"]["every"], 5);
}

#[test]
fn the_kept_pressure_sums_to_the_normal_force() {
    let bench = Bench::new("fields");
    let answer = bench.file("case.toml", SPHERE).fret(&["run", "case.toml", "--quiet"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    assert_eq!((answer.out.as_str(), answer.err.as_str()), ("", ""), "--quiet says nothing");

    let metadata: Value =
        serde_json::from_str(&bench.text("results/case/fields.zarr/pressure/zarr.json")).unwrap();
    assert_eq!(metadata["shape"], serde_json::json!([KEPT.len(), 24, 24]));
    assert_eq!(metadata["dimension_names"], serde_json::json!(["increment", "y", "x"]));
    let steps = std::fs::read(bench.folder.join("results/case/fields.zarr/increment/c/0")).unwrap();
    let steps: Vec<i64> =
        steps.chunks_exact(8).map(|eight| i64::from_le_bytes(eight.try_into().unwrap())).collect();
    assert_eq!(steps, KEPT);

    let forces = column(&bench.text("results/case/history.csv"), "normal_force");
    let cell_area = (240e-6_f64 / 24.0).powi(2);
    for (place, &step) in KEPT.iter().enumerate() {
        let force: f64 = chunk(&bench, &format!("pressure/c/{place}/0/0")).iter().sum::<f64>() * cell_area;
        let written = forces[usize::try_from(step).unwrap()];
        assert!((force - written).abs() <= 1e-7 * written, "step {step}: {force} against {written}");
    }
    assert!(!bench.folder.join("results/case/fields.zarr/slip_x").exists(), "nobody asked for slip");
}

#[test]
fn json_is_all_that_stands_on_standard_output() {
    let bench = Bench::new("solved-json");
    let answer = bench.file("case.toml", SPHERE).fret(&["run", "case.toml", "--json"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    let summary: Value = serde_json::from_str(&answer.out).unwrap();
    assert_eq!(summary["status"], "solved");
    assert_eq!(summary["increments"], INCREMENTS);
    assert_eq!(summary["stages"][1]["name"], "fretting");
    assert_eq!(summary["cycles"].as_array().map(Vec::len), Some(2));
}

#[test]
fn results_of_the_same_case_are_replaced_and_those_of_another_are_not() {
    let bench = Bench::new("replaced");
    bench.file("case.toml", SPHERE);
    assert_eq!(bench.fret(&["run", "case.toml", "--quiet"]).code, Some(0));
    assert_eq!(bench.fret(&["report", "results/case"]).code, Some(0));

    let changed = SPHERE.replace("every = 5", "every = 19");
    let again = bench.file("case.toml", &changed).fret(&["run", "case.toml"]);
    assert_eq!(again.code, Some(0), "{}", again.err);
    assert!(again.err.contains("replaced"), "{}", again.err);
    assert!(again.err.contains("still of the earlier run: report.html\n"), "{}", again.err);
    assert!(!bench.folder.join("results/case/fields.zarr/pressure/c/4").exists(), "nothing old stays");

    bench.file("other.toml", &SPHERE.replace("1.0", "1.1"));
    let other = bench.fret(&["run", "other.toml", "--out", "results/case"]);
    assert_eq!(other.code, Some(1), "{}", other.err);
    assert!(other.err.contains("another case"), "{}", other.err);
    assert_eq!(bench.text("results/case/case.toml"), changed);
    let forced = bench.fret(&["run", "other.toml", "--out", "results/case", "--force", "--quiet"]);
    assert_eq!(forced.code, Some(0), "{}", forced.err);
}

/// Ctrl-C in the middle: exit code 130, and what was solved before is whole.
#[cfg(unix)]
#[test]
fn an_interrupted_run_keeps_what_was_solved() {
    let bench = Bench::new("interrupted");
    let long = SPHERE.replace("increments = 3\n", "increments = 100000\n");
    bench.file("case.toml", &long);
    let run = bench.command(&["run", "case.toml", "--quiet"]).spawn().unwrap();
    let table = bench.folder.join("results/case/history.csv");
    let lines = || std::fs::read_to_string(&table).map_or(0, |text| text.lines().count());
    let patience = std::time::Instant::now();
    while lines() < 3 && patience.elapsed().as_secs() < 60 {
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
    let asked = std::process::Command::new("kill").args(["-INT", &run.id().to_string()]).status().unwrap();
    assert!(asked.success());
    let answer = crate::bench::Answer::from(run.wait_with_output().unwrap());
    assert_eq!(answer.code, Some(130));
    let record: Value = serde_json::from_str(&bench.text("results/case/run.json")).unwrap();
    assert_eq!(record["status"], "interrupted");
    assert_eq!(record["totals"]["increments"], lines() - 1);
}

/// The examples of loadings and wear, each with a word of its `run.json` or `cycles.csv` that only its own loading brings.
#[test]
fn every_example_of_a_loading_runs() {
    let examples = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    let bench = Bench::new("loadings");
    for (name, word) in [
        ("normal_and_tangential_cycles", "\"sine\""),
        ("turning_force", "\"phase\": 0.25"),
        ("force_spiral", "\"envelope\""),
        ("torsional_fretting", "torsional"),
        ("gross_slip", "gross_slip"),
        ("mixed_controls", "\"motion\""),
        ("force_table", "\"through\""),
        ("until_steady", ",true,"),
        ("wear_partial_slip", ",20,"),
        ("coating_worn_through", "\"cell\""),
        ("friction/evolving", "\"friction_evolution\""),
    ] {
        let path = examples.join(format!("{name}.toml"));
        let out = format!("results/{name}");
        let answer = bench.fret(&["run", path.to_str().unwrap(), "--out", &out, "--quiet"]);
        assert_eq!(answer.code, Some(0), "{name}: {}", answer.err);
        let told = bench.text(&format!("{out}/run.json")) + &bench.text(&format!("{out}/cycles.csv"));
        assert!(told.contains(word), "{name}: no {word}");
        assert_eq!(bench.warnings(&out), "[]", "{name}");
        keeps_the_first_law(name, &bench.text(&format!("{out}/history.csv")));
    }
}

/// What is put in in each increment is stored, dissipated, gone with wear or yielding, or told as unresolved. What is stored is rounded to some 1e-14.
fn keeps_the_first_law(name: &str, table: &str) {
    let mut lines = table.lines();
    let head: Vec<&str> = lines.next().unwrap().split(',').collect();
    let columns = [
        "external_work",
        "elastic_energy",
        "dissipated_energy",
        "wear_work",
        "plastic_work",
        "unresolved_energy",
    ];
    // A head may have a unit behind its name.
    let is_named = |head: &str, name: &str| head.split(' ').next() == Some(name);
    let places = columns.map(|column| head.iter().position(|head| is_named(head, column)).unwrap());
    let mut before = [0.0; 6];
    for line in lines {
        let words: Vec<&str> = line.split(',').collect();
        let now: [f64; 6] = places.map(|place| words[place].parse().unwrap());
        let changes: Vec<f64> = now.iter().zip(&before).map(|(now, before)| now - before).collect();
        let unit = changes.iter().fold(1e-5 * now[1], |most, change| most.max(change.abs()));
        let off = changes[0] - changes[1..].iter().sum::<f64>();
        assert!(off.abs() <= 1e-9 * unit, "{name}: {off:e} of {changes:?}");
        before = now;
    }
}

/// An example that ends in a warning is no example.
#[test]
#[ignore = "long: all examples, half a minute"]
fn no_example_ends_in_a_warning() {
    let examples = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    let bench = Bench::new("all-examples");
    let folders = ["", "friction", "surfaces"].map(|folder| examples.join(folder));
    let mut count = 0;
    for entry in folders.iter().flat_map(|folder| std::fs::read_dir(folder).unwrap()) {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|extension| extension != "toml") {
            continue;
        }
        let answer =
            bench.fret(&["run", path.to_str().unwrap(), "--out", "results/one", "--quiet", "--force"]);
        assert_eq!(answer.code, Some(0), "{}: {}", path.display(), answer.err);
        assert_eq!(bench.warnings("results/one"), "[]", "{}", path.display());
        keeps_the_first_law(&path.display().to_string(), &bench.text("results/one/history.csv"));
        count += 1;
    }
    assert!(count >= 38, "{count} examples");
}
