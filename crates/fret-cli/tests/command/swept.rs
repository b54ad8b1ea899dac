//! Many cases: every point as alone, failures recorded, finished points not solved again.

use serde_json::Value;

use crate::bench::{Bench, SPHERE};

const SWEEP: &str = r#"base = "case.toml"

[axes]
"friction.coefficient" = [0.1, -0.1, 0.2]
"load.fretting.tangential_force.0" = [0.05, 0.08]
"#;

/// The rows of a summary by the names of its columns; no cell of these tests holds a comma but the message, the last.
pub fn column(summary: &str, name: &str) -> Vec<String> {
    let place = summary.lines().next().unwrap().split(',').position(|column| column == name).unwrap();
    let rows =
        summary.lines().skip(1).filter(|line| line.starts_with(|letter: char| letter.is_ascii_digit()));
    rows.filter_map(|line| line.split(',').nth(place).map(str::to_owned)).collect()
}

#[test]
fn a_sweep_solves_every_point_as_it_is_solved_alone_and_records_failures() {
    let bench = Bench::new("sweep");
    let answer = bench.file("case.toml", SPHERE).file("many.toml", SWEEP).fret(&[
        "sweep",
        "many.toml",
        "--threads",
        "2",
    ]);
    assert_eq!(answer.code, Some(1), "refused points, and none that failed: {}", answer.err);
    let why = "refused  friction.coefficient = -0.1, load.fretting.tangential_force.0 = 0.05";
    let told = answer.err.lines().skip_while(|line| !line.contains(why)).nth(1).unwrap();
    assert!(told.contains("friction.coefficient = -0.1: must be zero or positive"), "{}", answer.err);
    assert!(answer.err.contains("2 refused, 0 failed"), "{}", answer.err);
    assert!(answer.out.contains("4 solved, 2 not, 0 found finished"), "{}", answer.out);
    // Both amplitudes of a friction begin with the same indentation.
    assert!(answer.err.contains("2 common beginnings solved once"), "{}", answer.err);
    let points = std::fs::read_dir(bench.folder.join("results/many/points")).unwrap();
    let in_common = points.filter_map(|point| {
        let point: Value = serde_json::from_slice(&std::fs::read(point.unwrap().path()).unwrap()).unwrap();
        point["increments_in_common"].as_u64()
    });
    assert_eq!(in_common.collect::<Vec<_>>(), [3; 4], "the increments of the indentation");
    let summary = bench.text("results/many/summary.csv");
    assert_eq!(column(&summary, "status"), ["solved", "solved", "refused", "refused", "solved", "solved"]);
    assert_eq!(column(&summary, "friction.coefficient"), ["0.1", "0.1", "-0.1", "-0.1", "0.2", "0.2"]);
    assert!(summary.contains("friction.coefficient = -0.1: must be zero or positive"), "{summary}");

    // Point 5 alone: the same bits.
    let alone =
        SPHERE.replace("coefficient = 0.1", "coefficient = 0.2").replace("[0.05, 0.0]", "[0.08, 0.0]");
    assert_eq!(bench.file("alone.toml", &alone).fret(&["run", "alone.toml", "--quiet"]).code, Some(0));
    let history = bench.text("results/alone/history.csv");
    let energies = column(&history, "dissipated_energy");
    assert_eq!(column(&summary, "dissipated_energy")[5], energies[energies.len() - 1]);
    let cycle: f64 = column(&summary, "cycle_dissipated_energy")[5].parse().unwrap();
    let [after, before] = [1, 9].map(|back| energies[energies.len() - back].parse::<f64>().unwrap());
    assert_eq!(cycle, after - before, "the last cycle has 8 increments");

    let again = bench.fret(&["sweep", "many.toml", "--json"]);
    assert_eq!(again.code, Some(1), "{}", again.err);
    let said: Value = serde_json::from_str(&again.out).unwrap();
    assert_eq!((&said["refused"], &said["failed"]), (&Value::from(2), &Value::from(0)));
    assert_eq!((&said["solved_before"], &said["points"]), (&Value::from(4), &Value::from(6)));
    assert_eq!(bench.text("results/many/summary.csv"), summary);
    // A changed base case, and a damaged file of a point, are solved anew.
    bench.file("case.toml", &SPHERE.replace("10e-3", "12e-3"));
    assert!(bench.fret(&["sweep", "many.toml"]).out.contains("0 found finished"));
}

#[test]
fn a_damaged_point_is_solved_again() {
    let bench = Bench::new("sweep-damaged");
    bench
        .file("case.toml", SPHERE)
        .file("many.toml", "base = 'case.toml'\naxes.friction.coefficient = [0.1, 0.2]\n");
    assert_eq!(bench.fret(&["sweep", "many.toml", "--quiet"]).code, Some(0));
    let summary = bench.text("results/many/summary.csv");
    let point = std::fs::read_dir(bench.folder.join("results/many/points")).unwrap().next().unwrap().unwrap();
    std::fs::write(point.path(), "{ \"format\": 1, \"sta").unwrap();
    let answer = bench.fret(&["sweep", "many.toml"]);
    assert!(answer.out.contains("1 found finished"), "{}", answer.out);
    assert_eq!(bench.text("results/many/summary.csv"), summary);
}

/// A point is known by what stands in the files that its case names.
#[test]
fn a_changed_file_of_a_case_makes_other_points() {
    let bench = Bench::new("sweep-files");
    let rows = |value: f64| vec![vec![value.to_string(); 24].join(","); 24].join("\n");
    for key in ["map", "max_shear"] {
        let law = if key == "map" {
            "map = \"values.csv\""
        } else {
            "coefficient = 0.1\nmax_shear = \"values.csv\""
        };
        let case = SPHERE.replace("coefficient = 0.1", law);
        bench
            .file("case.toml", &case)
            .file("many.toml", "base = 'case.toml'\n[axes]\n'load.fretting.tangential_force.0' = [0.05]\n");
        let energy = |value: f64, before: &str| {
            let answer = bench.file("values.csv", &rows(value)).fret(&["sweep", "many.toml"]);
            assert_eq!(answer.code, Some(0), "{key}: {}", answer.err);
            assert!(answer.out.contains(before), "{key}: {}", answer.out);
            column(&bench.text("results/many/summary.csv"), "dissipated_energy")[0].clone()
        };
        // Either keeps the contact from sliding as a whole; the second slips more.
        let values = if key == "map" { [0.1, 0.09] } else { [1e9, 2e7] };
        let first = energy(values[0], "0 found finished");
        assert_eq!(energy(values[0], "1 found finished"), first);
        assert_ne!(energy(values[1], "0 found finished"), first);
    }
}

#[test]
fn points_may_be_listed() {
    let bench = Bench::new("sweep-listed");
    let listed = "base = 'case.toml'\n[[point]]\nfriction.coefficient = 0.1\nload.0.normal_force = 1.0\n\
                  [[point]]\nfriction.coefficient = 0.2\nload.0.normal_force = 2.0\n";
    let answer = bench.file("case.toml", SPHERE).file("many.toml", listed).fret(&["sweep", "many.toml"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    let forces = column(&bench.text("results/many/summary.csv"), "normal_force");
    for (force, asked) in forces.iter().zip([1.0, 2.0]) {
        assert!((force.parse::<f64>().unwrap() - asked).abs() < 1e-8 * asked, "{forces:?}"); // the case's tolerance
    }
}

#[test]
fn mistakes_in_a_sweep_are_refused_with_their_places() {
    let bench = Bench::new("sweep-refused");
    bench.file("case.toml", SPHERE).file("results.txt", "mine");
    for (text, words) in [
        ("base = 'case.toml'", "nothing changes"),
        ("[axes]\n'friction.coefficient' = [0.1]", "no base case"),
        (SPHERE, "a case, not a sweep over cases"),
        ("base = 'case.toml'\n[axes]\n'load.9.normal_force' = [0.1]", "many.toml:3:25"),
        ("base = 'case.toml'\n[axes]\n'friction.coefficient' = 0.1", "must be a list of at least one value"),
        ("base = 'cas.toml'\n[axes]\nx = [0.1]", "many.toml:1:8"),
        ("base = 'case.toml'\naxis.x = [0.1]", "unknown key `axis`"),
        ("base = 'case.toml'\n[axes\nx = [0.1]", "many.toml:2"),
        ("base = 'case.toml'\n[[point]]\nx = 1\n[[point]]\ny = 1", "the same keys"),
        (
            "base = 'case.toml'\n[axes]\n'load[0].normal_force' = [1.0]\n'load.indent.normal_force' = [2.0]",
            "`load.indent.normal_force` and `load[0].normal_force` are one place",
        ),
    ] {
        let answer = bench.file("many.toml", text).fret(&["sweep", "many.toml"]);
        assert_eq!(answer.code, Some(1), "{text}: {}", answer.err);
        assert!(answer.err.contains(words), "{text}: {}", answer.err);
    }
    let refused = bench.fret(&["run", "many.toml"]);
    assert!(
        refused.code == Some(1) && refused.err.contains("a sweep over cases, not a case"),
        "{}",
        refused.err
    );
    let good = "base = 'case.toml'\naxes.friction.coefficient = [0.1]";
    let answer = bench.file("many.toml", good).fret(&["sweep", "many.toml", "--out", "."]);
    assert_eq!(answer.code, Some(1));
    assert!(answer.err.contains("holds files that are no sweep"), "{}", answer.err);
    assert!(!bench.folder.join("results").exists(), "nothing was written");
}

#[test]
fn samples_of_uncertain_keys_are_drawn_told_and_drawn_again_alike() {
    let bench = Bench::new("sweep-samples");
    let sweep = "base = \"case.toml\"\n[distributions]\n\"friction.coefficient\" = { uniform = { from = 0.1, to = 0.2 } }\n\
        [distributions.profile.sphere]\nradius = { lognormal = { mean = 10e-3, deviation = 0.5e-3 } }\n\
        [samples]\ncount = 4\nseed = 3\nindices = true\n";
    let answer = bench.file("case.toml", SPHERE).file("many.toml", sweep).fret(&["sweep", "many.toml"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    assert!(answer.out.contains("16 solved") && answer.out.contains("Sobol' indices"), "{}", answer.out);
    let told: Value = serde_json::from_str(&bench.text("results/many/uncertainty.json")).unwrap();
    let pressure = &told["quantities"]["max_pressure"];
    let summary = bench.text("results/many/summary.csv");
    let values: Vec<f64> =
        column(&summary, "max_pressure").iter().map(|cell| cell.parse().unwrap()).collect();
    let mean = values[..8].iter().sum::<f64>() / 8.0;
    assert!((pressure["mean"].as_f64().unwrap() / mean - 1.0).abs() < 1e-14);
    // friction moves the pressure little, also in four samples
    let total = |key: &str| pressure["sobol_indices"][key]["total"].as_f64().unwrap();
    assert!(total("profile.sphere.radius") > 5.0 * total("friction.coefficient"), "{pressure}");
    std::fs::remove_dir_all(bench.folder.join("results/many/points")).unwrap();
    assert_eq!(bench.fret(&["sweep", "many.toml", "--quiet"]).code, Some(0));
    assert_eq!(bench.text("results/many/summary.csv"), summary);
}

#[test]
fn samples_at_every_point_of_an_axis_are_those_of_a_sweep_for_each() {
    let bench = Bench::new("sweep-samples-axes");
    let drawn = "[distributions]\n\"friction.coefficient\" = { uniform = { from = 0.1, to = 0.2 } }\n[samples]\ncount = 4\n\
        seed = 3\nindices = true\n";
    let axes = "base = \"case.toml\"\n[axes]\nprofile.sphere.radius = [10e-3, 20e-3]\n";
    let with_units = format!("units = {{ length = \"m\", force = \"N\" }}\n{SPHERE}");
    let together = bench.file("case.toml", &with_units).file("many.toml", &format!("{axes}{drawn}"));
    let answer = together.fret(&["sweep", "many.toml"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    assert!(answer.out.contains("profile.sphere.radius = 0.02 m\n8 samples"), "{}", answer.out);
    // of one uncertain key, samples with its value exchanged are those of the other half: four at each radius
    assert!(answer.err.contains("24 points, 8 equal to another"), "{}", answer.err);
    assert_eq!(std::fs::read_dir(bench.folder.join("results/many/points")).unwrap().count(), 16);
    let told = |name: &str| -> Value {
        serde_json::from_str(&bench.text(&format!("results/{name}/uncertainty.json"))).unwrap()
    };
    let points = told("many")["points"].as_array().unwrap().clone();
    assert_eq!(points.len(), 2);
    for (number, radius) in ["10e-3", "20e-3"].into_iter().enumerate() {
        let case = SPHERE.replace("radius = 10e-3", &format!("radius = {radius}"));
        let name = format!("alone{number}");
        bench.file("one.toml", &case).file(&format!("{name}.toml"), &format!("base = \"one.toml\"\n{drawn}"));
        assert_eq!(bench.fret(&["sweep", &format!("{name}.toml"), "--quiet"]).code, Some(0));
        assert_eq!(points[number]["values"]["profile.sphere.radius"], radius.parse::<f64>().unwrap());
        assert_eq!(points[number]["quantities"], told(&name)["quantities"], "radius {radius}");
    }
}

#[test]
fn wrong_distributions_are_refused_where_they_stand() {
    let bench = Bench::new("sweep-wrong-samples");
    bench.file("case.toml", SPHERE);
    let good = "\"friction.coefficient\" = { uniform = { from = 0.1, to = 0.2 } }";
    for (text, words) in [
        (
            "[distributions]\n\"friction.coefficient\" = { uniform = { from = 0.2, to = 0.1 } }\n[samples]\ncount = 4",
            "from must lie below to",
        ),
        (
            "[distributions]\n\"friction.coefficient\" = { normal = { mean = 0.2 } }\n[samples]\ncount = 4",
            "deviation",
        ),
        (
            "[distributions]\n\"friction.coefficient\" = { gauss = 1.0 }\n[samples]\ncount = 4",
            "has no distribution",
        ),
        (&format!("[distributions]\n{good}"), "how many"),
        (&format!("[distributions]\n{good}\n[samples]\ncount = 1"), "between 2 and"),
        (&format!("[distributions]\n{good}\n[samples]\ncount = 4\nsede = 1"), "sede"),
        (
            &format!(
                "[axes]\n\"friction.coefficient\" = [0.1]\n[distributions]\n{good}\n[samples]\ncount = 4"
            ),
            "`friction.coefficient` has values already",
        ),
        ("[samples]\ncount = 4", "nothing to draw from"),
    ] {
        let answer =
            bench.file("many.toml", &format!("base = \"case.toml\"\n{text}\n")).fret(&["sweep", "many.toml"]);
        assert_eq!(answer.code, Some(1), "{text}: {}", answer.err);
        assert!(answer.err.contains(words), "{text}: {}", answer.err);
    }
}
