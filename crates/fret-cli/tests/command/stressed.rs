//! `fret stress`: what it writes from a finished run, and how it refuses.

use serde_json::Value;

use crate::bench::{Bench, SPHERE};

fn with_stress(table: &str) -> String {
    let kept = SPHERE.replace("[\"pressure\", \"shear\", \"zone\"]", "[\"pressure\", \"shear\", \"slip\"]");
    format!("{}\n[stress]\n{table}\n", kept.replace("every = 5", "every = 2"))
}

#[test]
fn a_finished_run_tells_its_stresses_without_solving_again() {
    let bench = Bench::new("stress-of-a-run");
    bench.file("case.toml", SPHERE);
    assert_eq!(bench.fret(&["run", "case.toml", "--out", "out", "--quiet"]).code, Some(0));
    let before = bench.text("out/history.csv");
    let answer = bench.fret(&["stress", "out", "--depths", "0,20e-6,40e-6", "--volume", "--json"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    let record: Value = serde_json::from_str(&answer.out).unwrap();
    let file: Value = serde_json::from_str(&bench.text("out/stress/stress.json")).unwrap();
    assert_eq!(record, file);
    assert_eq!(record["depths"].as_array().unwrap().len(), 3);
    // Hertz: the largest von Mises stress lies under the surface, near 0.48 contact radii (15e-6 here), and is 0.62 p0
    let largest = &record["largest"][0];
    assert_eq!(largest["measure"], "von_mises");
    assert_eq!(largest["depth"], 20e-6);
    let modulus = 210e9 / (1.0 - 0.09);
    let radius = f64::cbrt(0.75 * 10e-3 / modulus);
    let peak = 1.5 / (std::f64::consts::PI * radius * radius);
    let ratio = largest["value"].as_f64().unwrap() / peak;
    // at 0.63 radii by Hertz's axis stresses; three cells a radius leave some percent
    assert!((ratio - 0.60).abs() < 0.05, "{ratio}");
    assert_eq!(bench.text("out/history.csv"), before);
    let volume = std::fs::read(bench.folder.join("out/stress/volume-00018.vtr")).unwrap();
    // eleven fields of 24 x 24 x 3 numbers of four bytes, each after its length
    let start = volume.windows(7).position(|window| window == b">\n    _").unwrap() + 7;
    let bytes = 24 * 24 * 3 * 4;
    assert_eq!(volume[start..start + 8], (bytes as u64).to_le_bytes());
    assert_eq!(volume.len() - start, 11 * (8 + bytes) + "\n  </AppendedData>\n</VTKFile>\n".len());
    // the last field is the displacement along z: on the surface, under the middle of the rigid sphere, the approach
    let surface = &volume[start + 10 * (8 + bytes) + 8..][..24 * 24 * 4];
    let deepest =
        surface.chunks(4).map(|four| f32::from_le_bytes(four.try_into().unwrap())).fold(0.0, f32::max);
    let column = before.lines().next().unwrap().split(',').position(|name| name == "approach").unwrap();
    let approach: f64 = before.lines().last().unwrap().split(',').nth(column).unwrap().parse().unwrap();
    // less the gap of the sphere at the centre of the cell beside its middle, half a cell away along both axes
    let size = 240e-6 / 24.0;
    let middle = approach - 0.25 * size * size / 10e-3;
    assert!((f64::from(deepest) / middle - 1.0).abs() < 1e-5, "{deepest} for {middle}");
    let svg = std::fs::read_dir(bench.folder.join("out/stress")).unwrap().filter(|entry| {
        entry.as_ref().unwrap().path().extension().is_some_and(|extension| extension == "svg")
    });
    assert!(svg.count() >= 1);
    let lines = bench.text("out/stress/depths.csv");
    assert_eq!(lines.lines().count(), 1 + 3 * record["increments"].as_array().unwrap().len());
}

#[test]
fn a_case_with_a_stress_table_is_followed_by_stresses_and_fatigue() {
    let bench = Bench::new("stress-in-the-case");
    let table =
        "torsion_limit = 180e6\ntension_limit = 290e6\nyield_strength = 700e6\ncritical_distance = 10e-6";
    bench.file("case.toml", &with_stress(table));
    let answer = bench.fret(&["run", "case.toml", "--out", "out"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    for word in [
        "von mises",
        "fatemi socie",
        "dang van",
        "crossland",
        "smith watson topper",
        "ruiz f1",
        "line method",
    ] {
        assert!(answer.out.contains(word), "{word}: {}", answer.out);
    }
    let record: Value = serde_json::from_str(&bench.text("out/stress/stress.json")).unwrap();
    let parameters = &record["fatigue"]["parameters"];
    for name in ["smith_watson_topper", "fatemi_socie", "crossland", "dang_van"] {
        assert!(parameters[name]["largest"].as_f64().unwrap() > 0.0, "{name}");
        let at = &parameters[name]["critical_distance"];
        assert!(at["point"]["value"].as_f64().is_some() && at["line"]["value"].as_f64().is_some(), "{name}");
    }
    assert!(parameters["ruiz_f1"]["largest"].as_f64().unwrap() > 0.0);
    // every second kept increment, and the last
    let answer = bench.fret(&["stress", "out", "--every", "3", "--json", "--auto"]);
    let record: Value = serde_json::from_str(&answer.out).unwrap();
    assert_eq!(record["increments"].as_array().unwrap().last().unwrap(), 18);
}

#[test]
fn what_cannot_be_told_is_refused_with_a_way_out() {
    let bench = Bench::new("stress-refused");
    bench.file("case.toml", &SPHERE.replace("[\"pressure\", \"shear\", \"zone\"]", "[\"zone\"]"));
    assert_eq!(bench.fret(&["run", "case.toml", "--out", "bare", "--quiet"]).code, Some(0));
    bench.file("good.toml", SPHERE);
    assert_eq!(bench.fret(&["run", "good.toml", "--out", "good", "--quiet"]).code, Some(0));
    let coating = "coatings = [{ thickness = 5e-6, young = 210e9, poisson = 0.3, wear_coefficient = 1e-13 }]";
    let worn = SPHERE.replace(
        "substrate = { young = 210e9, poisson = 0.3 }",
        &format!("{coating}\nsubstrate = {{ young = 210e9, poisson = 0.3, wear_coefficient = 1e-13 }}"),
    ) + "\n[wear]\nthinning_tolerance = 0.1\n";
    bench.file("worn.toml", &worn);
    let answer = bench.fret(&["run", "worn.toml", "--out", "worn", "--quiet"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    for (arguments, words) in [
        (&["stress", "bare"][..], "holds no tractions"),
        (&["stress", "worn"], "those of unworn layers"),
        (&["stress", "nowhere"], "no such folder"),
        (&["stress", "."], "no results of fret"),
        (&["stress", "good", "--depths", "-1e-6"], "above the surface"),
        (&["stress", "good", "--depths", "nan"], "must be a finite length"),
        (&["stress", "good", "--body", "upper"], "the upper body is rigid"),
    ] {
        let answer = bench.fret(arguments);
        assert_eq!(answer.code, Some(1), "{arguments:?}: {}", answer.out);
        assert!(answer.err.contains(words), "{arguments:?}: {}", answer.err);
        assert!(answer.err.contains("help"), "{}", answer.err);
    }
    let on_rigid = with_stress("depths = [0.0, 3e-6]\nyield_strength = -1.0\nbody = \"upper\"\nevery = 0")
        .replace(
            "substrate = { young = 210e9, poisson = 0.3 }",
            "coatings = [{ thickness = 2e-6, young = 1e9, poisson = 0.3 }]\nbase = \"rigid\"",
        );
    bench.file("rigid.toml", &on_rigid);
    let answer = bench.fret(&["check", "rigid.toml"]);
    assert_eq!(answer.code, Some(1));
    for words in ["stress.every = 0", "yield_strength = -1.0"] {
        assert!(answer.err.contains(words), "{}", answer.err);
    }
    bench.file(
        "deep.toml",
        &on_rigid.replace("every = 0", "").replace("-1.0", "1e8").replace("body = \"upper\"", ""),
    );
    let answer = bench.fret(&["check", "deep.toml"]);
    assert!(answer.err.contains("lies in the rigid base"), "{}", answer.err);
}

/// Boussinesq: under a pressure without shear the stress across any plane in parallel to a homogeneous surface presses, whatever the
/// place. A coating of the substrate's own material has an interface, and nothing that peels it.
#[test]
fn a_compression_is_not_called_the_largest_peel() {
    let bench = Bench::new("stress-no-peel");
    let coated = SPHERE
        .replace(
            "substrate =",
            "coatings = [{ young = 210e9, poisson = 0.3, thickness = 20e-6 }]\nsubstrate =",
        )
        .replace("coefficient = 0.1", "coefficient = 0.0")
        .replace("tangential_force = [0.05, 0.0]\ncycles = 2", "normal_force = 2.0");
    bench.file("case.toml", &coated);
    let run = bench.fret(&["run", "case.toml", "--out", "out", "--quiet"]);
    assert_eq!(run.code, Some(0), "{}", run.err);
    let answer = bench.fret(&["stress", "out"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    let peel = answer.out.lines().find(|line| line.trim_start().starts_with("peel")).unwrap();
    assert!(peel.ends_with("none: compression everywhere"), "{}", answer.out);
}

/// Two stages, 3 increments and two cycles of 8: 19 in all, two of them ends. With `every` there is nothing to say.
#[test]
fn only_the_ends_of_stages_are_kept_unless_the_case_says_more_and_that_is_told() {
    let bench = Bench::new("stress-stage-ends");
    bench.file("more.toml", SPHERE).file("ends.toml", &SPHERE.replace("every = 5", ""));
    let told = "kept at the ends of the stages alone (2 of 19 increments): [output] every = 1";
    for (case, is_told) in [("ends", true), ("more", false)] {
        let file = format!("{case}.toml");
        assert_eq!(bench.fret(&["run", &file, "--out", case, "--quiet"]).code, Some(0));
        let answer = bench.fret(&["stress", case, "--depths", "0,20e-6"]);
        assert_eq!(answer.code, Some(0), "{}", answer.err);
        assert_eq!(answer.out.contains(told), is_told, "{}", answer.out);
        let record: Value = serde_json::from_str(&bench.text(&format!("{case}/stress/stress.json"))).unwrap();
        assert_eq!(record.get("stage_ends_alone").is_some(), is_told);
        assert_eq!(bench.fret(&["report", case]).code, Some(0));
        assert_eq!(bench.text(&format!("{case}/report.html")).contains(told), is_told);
    }
}

/// In the frame of the contact a cell is another place of the bodies in each increment of a roll: no fatigue is told of its cycles, and that is said.
#[test]
fn no_fatigue_is_told_of_places_that_travel_through_the_grid() {
    let bench = Bench::new("stress-travel");
    let constants = "poisson = 0.3, fatigue = { torsion_limit = 200e6, tension_limit = 400e6 } }";
    let with = |frame: &str| {
        let (head, _) = SPHERE.split_once("[[load]]").unwrap();
        let head = head.replace("poisson = 0.3 }", constants);
        format!(
            "{head}[kinematics]\nframe = \"{frame}\"\n[output]\nevery = 1\n[[load]]\nnormal_force = 0.2\nincrements = 2\n\
             [[load]]\nroll = [20e-6, 0.0]\ncycles = 1\nincrements = 8\n"
        )
    };
    for (frame, travels) in [("bodies", false), ("contact", true)] {
        let file = format!("{frame}.toml");
        bench.file(&file, &with(frame));
        let run = bench.fret(&["run", &file, "--out", frame, "--quiet"]);
        assert_eq!(run.code, Some(0), "{}", run.err);
        let answer = bench.fret(&["stress", frame, "--depths", "5e-6"]);
        assert_eq!(answer.code, Some(0), "{}", answer.err);
        let told = "the places of the bodies travel through the grid";
        assert_eq!(
            (answer.out.contains(told), answer.out.contains("crossland")),
            (travels, !travels),
            "{}",
            answer.out
        );
        let record: Value =
            serde_json::from_str(&bench.text(&format!("{frame}/stress/stress.json"))).unwrap();
        assert_eq!((record["fatigue"].is_null(), record.get("places_travel").is_some()), (travels, travels));
        assert_eq!(bench.fret(&["report", frame]).code, Some(0));
        assert_eq!(bench.text(&format!("{frame}/report.html")).contains(told), travels);
    }
}
