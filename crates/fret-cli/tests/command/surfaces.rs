//! Surfaces and friction: every example of them is solved, and every bad array is refused where it is named.

use std::path::Path;

use crate::bench::{Bench, SPHERE};

/// Checks that a case is refused in one message, at its place and with these words.
fn one_mistake(bench: &Bench, case: &str, place: &str, words: &[&str]) {
    let answer = bench.file("case.toml", case).fret(&["check", "case.toml"]);
    assert_eq!(answer.code, Some(1), "{case}\n{}", answer.err);
    assert_eq!(answer.err.matches("error: ").count(), 1, "one clear message:\n{}", answer.err);
    assert!(answer.err.contains(&format!("case.toml:{place}")), "expected place {place}:\n{}", answer.err);
    for word in words {
        assert!(answer.err.contains(word), "expected {word:?}:\n{}", answer.err);
    }
}

#[test]
fn every_example_of_a_surface_and_of_friction_is_solved() {
    let bench = Bench::new("surface-examples");
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    let mut count = 0;
    for folder in ["surfaces", "friction"] {
        for entry in std::fs::read_dir(examples.join(folder)).unwrap() {
            let path = entry.unwrap().path();
            if path.extension().is_none_or(|extension| extension != "toml") {
                continue;
            }
            let text = std::fs::read_to_string(&path).unwrap();
            assert_eq!(text.lines().next(), Some("#:schema ../fret.schema.json"), "{}", path.display());
            let answer = bench.fret(&["run", path.to_str().unwrap(), "--threads", "1", "--quiet"]);
            assert_eq!(answer.code, Some(0), "{}: {}", path.display(), answer.err);
            let name = path.file_stem().unwrap().to_str().unwrap().to_owned();
            assert_eq!(bench.warnings(&format!("results/{name}")), "[]", "{name}");
            count += 1;
        }
    }
    assert!(count >= 14, "{count} examples");
    // The record of a run tells its heights apart, and does not repeat them.
    let record = std::fs::read_to_string(bench.folder.join("results/rough_flat/run.json")).unwrap();
    let record: serde_json::Value = serde_json::from_str(&record).unwrap();
    let heights = &record["plan"]["case"]["profile"]["heights"][0];
    assert_eq!(heights["source"], "ground.npy");
    assert_eq!(heights["cells"], serde_json::json!([48, 48]));
    // The file's rms of 0.2 um, and the rounding of single precision.
    assert!((heights["rms"].as_f64().unwrap() / 0.2e-6 - 1.0).abs() < 0.1, "{heights}");
}

/// A .npy file of doubles, 24 x 24 unless said otherwise.
fn npy(cells: [usize; 2], kind: &str, value: impl Fn(usize) -> f64) -> Vec<u8> {
    let header =
        format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': ({}, {}), }}\n", cells[0], cells[1]);
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend((header.len() as u16).to_le_bytes());
    bytes.extend(header.as_bytes());
    bytes.extend((0..cells[0] * cells[1]).flat_map(|index| value(index).to_le_bytes()));
    bytes
}

#[test]
fn every_bad_array_is_one_clear_message_at_its_place() {
    let bench = Bench::new("bad-arrays");
    let write = |name: &str, bytes: &[u8]| std::fs::write(bench.folder.join(name), bytes).unwrap();
    write("good.npy", &npy([24, 24], "<f8", |index| index as f64 * 1e-9));
    write("turned.npy", &npy([24, 12], "<f8", |_| 0.0));
    write("nan.npy", &npy([24, 24], "<f8", |index| if index == 27 { f64::NAN } else { 0.0 }));
    write("negative.npy", &npy([24, 24], "<f8", |index| if index == 50 { -0.1 } else { 0.1 }));
    write("complex.npy", &npy([24, 12], "<c16", |_| 0.0));
    write("cut.npy", &npy([24, 24], "<f8", |_| 0.0)[..3000]);
    write("words.txt", b"1 2 3\n4 five 6\n");
    write("ragged.txt", b"1 2 3\n4 5\n");
    write("bytes.bin", &[0xff, 0xfe, 0x00]);
    let heights = |rest: &str| {
        SPHERE.replace("[profile.sphere]\nradius = 10e-3", &format!("[profile.heights]\n{rest}"))
    };
    let map = |name: &str| SPHERE.replace("coefficient = 0.1", &format!("map = \"{name}\""));
    let file = |name: &str| heights(&format!("file = \"{name}\""));
    for (case, place, words) in [
        (file("nowhere.npy"), "14:8", vec!["nowhere.npy", "no such file"]),
        (file("."), "14:8", vec!["no ordinary file"]),
        (file("/dev/zero"), "14:8", vec!["no ordinary file"]),
        (file("turned.npy"), "14:8", vec!["24 x 12 numbers", "24 x 24 cells"]),
        (file("nan.npy"), "14:8", vec!["height [1, 3] = NaN", "finite"]),
        (file("complex.npy"), "14:8", vec!["c16"]),
        (file("cut.npy"), "14:8", vec!["its header says 4608"]),
        (file("words.txt"), "14:8", vec!["line 2, column 2: \"five\" is not a number"]),
        (file("ragged.txt"), "14:8", vec!["line 2: a row of 2 numbers after rows of 3"]),
        (file("bytes.bin"), "14:8", vec!["neither a .npy file nor a text"]),
        (heights("unit = 1e-6"), "13:", vec!["profile.heights: no heights"]),
        (heights("file = \"good.npy\"\nvalues = [[1.0]]"), "15:10", vec!["file and values, both at once"]),
        (heights("file = \"good.npy\"\nunit = -1.0"), "15:8", vec!["profile.heights.unit", "positive"]),
        (heights("values = [[1.0, 2.0], [3.0]]"), "14:10", vec!["row 1 has 1 numbers, row 0 has 2"]),
        (heights("values = \"good.npy\""), "14:10", vec!["rows of numbers"]),
        (file("good.npy").replace("[240e-6, 240e-6]", "\"auto\""), "5:8", vec!["auto", "size = [x, y]"]),
        (map("negative.npy"), "17:7", vec!["friction.map", "entry [2, 2] = -0.1"]),
        (map("nan.npy"), "17:7", vec!["entry [1, 3] = NaN"]),
        (map("turned.npy"), "17:7", vec!["24 x 12 numbers"]),
        (
            SPHERE.replace("coefficient = 0.1", "coefficient = 0.1\nmap = \"good.npy\""),
            "18:7",
            vec!["both at once"],
        ),
        (
            SPHERE.replace("cycles = 2", "cycles = 2\nfriction = -0.5"),
            "28:12",
            vec!["load[1].friction", "-0.5"],
        ),
        (
            SPHERE.replace("cycles = 2", "cycles = 2\nfriction = \"negative.npy\""),
            "28:12",
            vec!["entry [2, 2]"],
        ),
    ] {
        one_mistake(&bench, &case, place, &words);
    }
}

#[test]
fn every_bad_shape_is_one_clear_message_at_its_place() {
    let bench = Bench::new("bad-shapes");
    let shape = |rest: &str| SPHERE.replace("[profile.sphere]\nradius = 10e-3", rest);
    for (case, place, words) in [
        (shape("[profile]"), "13:", vec!["profile: empty", "sphere, ellipsoid"]),
        (shape(""), "10:", vec!["what shape the bodies have"]),
        (shape("[profile.cylinder]\nradius = 0.01\naxis = \"z\"\nlength = 1e-4"), "15:8", vec!["`z`", "`x`"]),
        (
            shape("[profile.cylinder]\nradius = 0.01\naxis = \"y\""),
            "4:9",
            vec!["infinite along y", "periodic"],
        ),
        (
            shape("[profile.cylinder]\nradius = 0.01\naxis = \"y\"\nlength = 0.0"),
            "16:10",
            vec!["profile.cylinder.length", "positive"],
        ),
        (
            shape("[profile.flat_punch]\nradius = -1.0"),
            "14:10",
            vec!["profile.flat_punch.radius", "positive"],
        ),
        (shape("[profile.flat_punch]\nradius = 1e-6"), "5:8", vec!["no cell centre lies on the body"]),
        (shape("[profile.flat_punch]\nradius = 1e-3"), "5:8", vec!["reaches the edge"]),
        (shape("[profile.rounded_punch]\nflat_radius = 1e-4"), "13:", vec!["missing key", "edge_radius"]),
        (shape("[profile.cone]\nslope = nan"), "14:9", vec!["profile.cone.slope", "positive finite number"]),
        (shape("[profile.sphere]\nradius = -0.01"), "14:10", vec!["positive"]),
        (shape("[lower.profile.sphere]\nradius = 0.0"), "14:10", vec!["lower.profile.sphere", "not zero"]),
        (
            shape("[lower.profile.sphere]\nradius = -0.01\n[upper.profile.sphere]\nradius = 0.02"),
            "15:8",
            vec!["must open away from the middle", "hollow"],
        ),
        (
            shape("[lower.profile.heights]\nvalues = [[0.0]]\nof = \"gap\""),
            "15:6",
            vec!["a body has a surface"],
        ),
    ] {
        one_mistake(&bench, &case, place, &words);
    }
}

/// Periodic half-spaces have a mean gap and no approach: summary and page say so.
#[test]
fn a_mean_gap_is_shown_as_a_mean_gap() {
    let bench = Bench::new("mean-gap");
    let case = "units = { length = 'mm', force = 'N' }\ngrid = { cells = [32, 32], size = [1.0, 1.0], periodic = true }\n\
                upper.rigid = true\nlower.substrate = { young = 1e3, poisson = 0.3 }\n\
                profile.wave = { amplitude = 0.01, wavelength_x = 1.0, wavelength_y = 1.0 }\n\
                [[load]]\nmean_gap = 0.0075\nincrements = 4\n";
    let answer = bench.file("case.toml", case).fret(&["run", "case.toml"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    let row = answer.out.lines().find(|line| line.starts_with("mean gap [mm]")).unwrap_or_default();
    assert!(row.ends_with("7.5000e-3"), "{}", answer.out);
    assert!(!answer.out.contains("approach"), "{}", answer.out);
    assert_eq!(bench.fret(&["report", "results/case"]).code, Some(0));
    let page = bench.text("results/case/report.html");
    for words in ["mean gap 0.0075", "Normal force over mean gap."] {
        assert!(page.contains(words), "{words}");
    }
}
