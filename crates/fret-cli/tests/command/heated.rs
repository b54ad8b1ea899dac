//! `fret heat`: what it tells of a finished run, and how it refuses.

use serde_json::Value;

use crate::bench::Bench;

const CASE: &str = r"
[grid]
cells = [32, 32]
size = [140e-6, 140e-6]
[upper]
substrate = { young = 210e9, poisson = 0.3, thermal_conductivity = 15.0, electrical_resistivity = 6e-7 }
[lower]
substrate = { young = 210e9, poisson = 0.3, thermal_conductivity = 45.0, electrical_resistivity = 2e-7 }
[profile.sphere]
radius = 10e-3
[friction]
coefficient = 0.5
[output]
every = 1
[thermal]
frequency = 100.0
[[load]]
normal_force = 1.0
increments = 1
[[load]]
shift = [2e-6, 0.0]
increments = 16
cycles = 1
";

#[test]
fn a_run_ends_with_temperature_and_resistances_and_heat_tells_them_again() {
    let bench = Bench::new("heat-of-a-run");
    bench.file("case.toml", CASE);
    let run = bench.fret(&["run", "case.toml", "--out", "out"]);
    assert_eq!(run.code, Some(0), "{}", run.err);
    assert!(
        run.out.contains("max temperature rise") && run.out.contains("electrical contact resistance"),
        "{}",
        run.out
    );
    let first: Value = serde_json::from_str(&bench.text("out/heat/heat.json")).unwrap();
    let answer = bench.fret(&["heat", "out", "--every", "4", "--json"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    let record: Value = serde_json::from_str(&answer.out).unwrap();
    assert_eq!(first["temperature"], record["temperature"]);
    assert_eq!(record["resistance"].as_array().unwrap().len(), 5); // of increments 0 to 16
    let number = |value: &Value| value.as_f64().unwrap();
    let rise = &record["temperature"];
    // homogeneous bodies share heat as they conduct it; power is energy times frequency
    assert!((number(&rise["lower_fraction"]) - 0.75).abs() < 1e-9);
    assert!((number(&rise["power"]) / (100.0 * number(&rise["dissipated_energy"])) - 1.0).abs() < 1e-12);
    assert!((number(&rise["kept_fields_account_for"]) - 1.0).abs() < 1e-3);
    // gross slip nearly all the time: Hertz's flux, mean rise at the centre pi q0 a/(4 (kappa1 + kappa2)), q0 = 3 power/(2 pi a^2)
    let modulus = 0.5 * 210e9 / 0.91;
    let radius = f64::cbrt(0.75 * 10e-3 / modulus);
    let centre = 3.0 * number(&rise["power"]) / (8.0 * radius * 60.0);
    assert!((number(&rise["max_rise"]["value"]) / centre - 1.0).abs() < 0.03, "{rise}"); // nine cells a radius
    let last = record["resistance"].as_array().unwrap().last().unwrap();
    let holm = 8e-7 / (4.0 * radius);
    assert!((number(&last["electrical"]) / holm - 1.0).abs() < 0.08, "{last}");
    assert!((number(&last["thermal"]) / ((1.0 / 15.0 + 1.0 / 45.0) / (4.0 * radius)) - 1.0).abs() < 0.08);
    let npz = std::fs::read(bench.folder.join("out/heat/temperature.npz")).unwrap();
    assert!(npz.starts_with(b"PK") && npz.len() > 4 * 32 * 32 * 8);
}

#[test]
fn conductivities_come_from_another_case_where_the_results_have_none() {
    let bench = Bench::new("heat-of-another-case");
    let bare = CASE
        .replace(", thermal_conductivity = 15.0, electrical_resistivity = 6e-7", "")
        .replace(", thermal_conductivity = 45.0, electrical_resistivity = 2e-7", "")
        .replace("[thermal]\nfrequency = 100.0\n", "");
    bench.file("bare.toml", &bare);
    bench.file("case.toml", CASE);
    assert_eq!(bench.fret(&["run", "bare.toml", "--out", "out", "--quiet"]).code, Some(0));
    assert!(!bench.folder.join("out/heat").exists());
    let refused = bench.fret(&["heat", "out"]);
    assert_eq!(refused.code, Some(1));
    assert!(
        refused.err.contains("says nothing about conduction") && refused.err.contains("--case"),
        "{}",
        refused.err
    );
    assert_eq!(bench.fret(&["heat", "out", "--case", "case.toml"]).code, Some(0));
    // conductors of other bodies, or in other units, are none of these results
    bench.file("other.toml", &CASE.replace("young = 210e9", "young = 200e9"));
    bench.file("units.toml", &format!("[units]\nlength = \"mm\"\nforce = \"N\"\n{CASE}"));
    for (case, what) in
        [("other.toml", "its bodies are not those"), ("units.toml", "its units are not those")]
    {
        let refused = bench.fret(&["heat", "out", "--case", case]);
        assert!(refused.code == Some(1) && refused.err.contains(what), "{case}: {}", refused.err);
    }
}

/// The rise is linear in the frequency up to the largest numbers: to where the shares of the bodies stop, at 1e-11 of the flux.
#[test]
fn cycles_as_fast_as_numbers_go_heat_in_proportion() {
    let bench = Bench::new("heat-by-frequency");
    let [one, other] = ["100.0", "1e300"].map(|frequency| {
        bench.file("case.toml", &CASE.replace("frequency = 100.0", &format!("frequency = {frequency}")));
        let run = bench.fret(&["run", "case.toml", "--out", frequency, "--quiet"]);
        assert_eq!(run.code, Some(0), "{}", run.err);
        let record: Value =
            serde_json::from_str(&bench.text(&format!("{frequency}/heat/heat.json"))).unwrap();
        ["mean_rise", "power"].map(|of| record["temperature"][of].as_f64().unwrap())
    });
    for (one, other) in one.into_iter().zip(other) {
        assert!((other / one * 1e-298 - 1.0).abs() < 1e-10, "{one} {other}");
    }
}

#[test]
fn increments_that_were_not_kept_are_named() {
    let bench = Bench::new("heat-not-kept");
    bench.file("case.toml", CASE);
    let sparse = CASE.replace("every = 1\n", "every = 3\n").replace("[thermal]\nfrequency = 100.0\n", "");
    bench.file("sparse.toml", &sparse);
    assert_eq!(bench.fret(&["run", "sparse.toml", "--out", "out", "--quiet"]).code, Some(0));
    let refused = bench.fret(&["heat", "out", "--case", "case.toml"]);
    assert_eq!(refused.code, Some(1), "{}", refused.out);
    assert!(
        refused.err.contains("of the last cycle is not kept") && refused.err.contains("every = 1"),
        "{}",
        refused.err
    );
}

/// A run of a line contact is told that it has no answer and what has one; so is one of which one body alone conducts and no temperature is asked for.
#[test]
fn what_has_no_heat_to_tell_is_refused_with_a_way_out() {
    let bench = Bench::new("heat-without-answer");
    let line = CASE
        .replace("cells = [32, 32]\nsize = [140e-6, 140e-6]", "cells = 32\nsize = 4e-5\ndatum = 1e-2")
        .replace("[profile.sphere]\n", "[profile.cylinder]\naxis = \"y\"\n")
        .replace("[thermal]\nfrequency = 100.0\n", "");
    bench.file("line.toml", &line);
    let run = bench.fret(&["run", "line.toml", "--out", "line"]);
    assert_eq!(run.code, Some(0), "{}", run.err);
    let refused = bench.fret(&["heat", "line"]);
    assert_eq!(refused.code, Some(1), "{}", refused.out);
    assert!(
        refused.err.contains("along an infinite line")
            && refused.err.contains("finite length: cells = [x, y]"),
        "{}",
        refused.err
    );
    let one = CASE
        .replace(", thermal_conductivity = 15.0, electrical_resistivity = 6e-7", "")
        .replace("[thermal]\nfrequency = 100.0\n", "");
    bench.file("one.toml", &one);
    let run = bench.fret(&["run", "one.toml", "--out", "one"]);
    assert_eq!(run.code, Some(0), "{}", run.err);
    assert!(!bench.folder.join("one/heat").exists());
    let refused = bench.fret(&["heat", "one"]);
    assert_eq!(refused.code, Some(1), "{}", refused.out);
    assert!(
        refused.err.contains("by one body at the most") && refused.err.contains("frequency = ..."),
        "{}",
        refused.err
    );
    // With a frequency all of the heat goes into the body that conducts.
    let asked = one + "[thermal]\nfrequency = 100.0\n";
    bench.file("asked.toml", &asked);
    let answer = bench.fret(&["heat", "one", "--case", "asked.toml", "--json"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    let record: Value = serde_json::from_str(&answer.out).unwrap();
    assert_eq!(record["temperature"]["lower_fraction"], 1.0);
    assert_eq!(record["resistance"].as_array().unwrap().len(), 0);
}
