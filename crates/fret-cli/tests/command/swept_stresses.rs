//! Sweeps to the answer: what a case asks for after it is solved, stresses, lives, cracks, coating, heat, stands in the table of the points.

use serde_json::Value;

use crate::bench::{Bench, SPHERE};
use crate::swept::column;

/// A line contact that is asked for lives and for a crack: small, and with units.
const CYLINDER: &str = r#"title = "cylinder on a stretched flat"
units = { length = "mm", force = "N" }

[grid]
cells = 64
size = 1.2

[upper]
substrate = { young = 74e3, poisson = 0.33 }

[lower.substrate]
young = 74e3
poisson = 0.33

[lower.substrate.fatigue]
critical_distance = 0.05
strain_life = { strength_coefficient = 714.0, strength_exponent = -0.078, ductility_coefficient = 0.166, ductility_exponent = -0.538 }

[lower.substrate.fatigue.crack]
threshold = 66.0
short_crack_length = 0.09
initial_length = 0.02
final_length = 1.0
paris_coefficient = 1e-12
paris_exponent = 3.0

[profile.cylinder]
radius = 50.0
axis = "y"

[friction]
coefficient = 0.75

[[load]]
name = "press"
normal_force = 93.27
increments = 1

[[load]]
name = "pull"
tangential_force = [42.0, 0.0]
bulk_stress = 90.0
cycles = 1
increments = 12

[output]
every = 1

[stress]
depths = [0.0, 0.02, 0.05, 0.1, 0.2]
"#;

const PULLS: &str = "base = 'case.toml'\n[axes]\n'load.pull.bulk_stress' = [60.0, 90.0]\n";

fn number(summary: &str, name: &str, row: usize) -> f64 {
    column(summary, name)[row].parse().unwrap()
}

/// A point has the stresses, the life and the crack that `fret run` tells of its case alone: the same bits.
#[test]
fn lives_and_cracks_of_a_point_are_those_of_its_run() {
    let bench = Bench::new("sweep-lives");
    bench.file("case.toml", CYLINDER).file("pulls.toml", PULLS);
    let answer = bench.fret(&["sweep", "pulls.toml", "--threads", "2"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    assert_eq!(bench.fret(&["run", "case.toml", "--out", "alone", "--quiet"]).code, Some(0));
    let alone: Value = serde_json::from_str(&bench.text("alone/stress/stress.json")).unwrap();
    let of = &alone["fatigue"]["parameters"]["smith_watson_topper"];
    let summary = bench.text("results/pulls/summary.csv");
    for (name, value) in [
        ("max_von_mises [MPa]", &alone["largest"][0]["value"]),
        ("smith_watson_topper [MPa]", &of["largest"]),
        ("smith_watson_topper_x [mm]", &of["x"]),
        ("smith_watson_topper_depth [mm]", &of["depth"]),
        ("smith_watson_topper_cycles", &of["cycles"]),
        ("smith_watson_topper_point_cycles", &of["critical_distance"]["point"]["cycles"]),
        ("smith_watson_topper_line_cycles", &of["critical_distance"]["line"]["cycles"]),
        ("crack_angle [degrees]", &alone["fatigue"]["crack"]["angle"]),
        ("crack_length [mm]", &alone["fatigue"]["crack"]["length"]),
    ] {
        assert_eq!(number(&summary, name, 1), value.as_f64().unwrap(), "{name}");
    }
    assert_eq!(column(&summary, "crack_fate")[1], alone["fatigue"]["crack"]["fate"]);
    // More bulk stress, a shorter life. Loads of a line contact are told per length.
    let lives = [0, 1].map(|row| number(&summary, "smith_watson_topper_cycles", row));
    assert!(lives[1] < lives[0], "{lives:?}");
    assert_eq!(number(&summary, "normal_force [N/mm]", 0), 93.27);
    // Nothing is left of the runs, and finished points are known again with all that they were asked.
    let left = std::fs::read_dir(bench.folder.join("results/pulls/points")).unwrap();
    assert!(left.map(|entry| entry.unwrap().path()).all(|path| path.extension().unwrap() == "json"));
    let again = bench.fret(&["sweep", "pulls.toml"]);
    assert!(again.out.contains("2 found finished"), "{}", again.out);
    assert_eq!(bench.text("results/pulls/summary.csv"), summary);
}

const FRICTIONS: &str = "base = 'case.toml'\n[axes]\n'friction.coefficient' = [0.1, 0.2]\n";

/// The sphere with a coating, of bodies that conduct, with all that stresses and temperatures are made from.
fn conducting() -> String {
    let layers =
        "{ young = 210e9, poisson = 0.3, thermal_conductivity = 40.0, electrical_resistivity = 2e-7 }";
    let coating = layers.replace("{ ", "{ thickness = 5e-6, ");
    SPHERE
        .replace("rigid = true", &format!("substrate = {layers}"))
        .replace(
            "substrate = { young = 210e9, poisson = 0.3 }",
            &format!("substrate = {layers}\ncoatings = [{coating}]"),
        )
        .replace("[\"pressure\", \"shear\", \"zone\"]", "[\"pressure\", \"shear\", \"slip\"]")
        .replace("every = 5", "every = 1")
}

/// The largest rise and both resistances of a point are those of `fret run`, and a coating's stress stands beside.
#[test]
fn heat_and_coating_of_a_point_are_those_of_its_run() {
    let bench = Bench::new("sweep-heat");
    let case = conducting() + "\n[thermal]\nfrequency = 20.0\n\n[stress]\ndepths = [0.0, 2e-6, 5e-6]\n";
    bench.file("case.toml", &case).file("many.toml", FRICTIONS);
    let answer = bench.fret(&["sweep", "many.toml"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    assert_eq!(bench.fret(&["run", "case.toml", "--out", "alone", "--quiet"]).code, Some(0));
    let [heat, stress] = ["heat/heat.json", "stress/stress.json"]
        .map(|file| serde_json::from_str::<Value>(&bench.text(&format!("alone/{file}"))).unwrap());
    let summary = bench.text("results/many/summary.csv");
    let rise = &heat["temperature"]["max_rise"]["value"];
    assert_eq!(number(&summary, "max_temperature_rise", 0), rise.as_f64().unwrap());
    let resistance = heat["resistance"].as_array().unwrap().last().unwrap();
    for name in ["thermal", "electrical"] {
        let found = number(&summary, &format!("{name}_resistance"), 0);
        assert_eq!(found, resistance[name].as_f64().unwrap(), "{name}");
    }
    let tension = stress["coating"].as_array().unwrap().iter().map(|film| film["stress"].as_f64().unwrap());
    assert_eq!(number(&summary, "coating_tension", 0), tension.fold(f64::NEG_INFINITY, f64::max));
}
