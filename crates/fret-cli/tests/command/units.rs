//! Declared units: they stand where a person or a program reads a number; the numbers are the same bits with and without them.

use serde_json::Value;

use crate::bench::{Bench, SPHERE};

const UNITS: &str = "[units]\nlength = \"m\"\nforce = \"N\"\n\n[grid]";

/// The small sphere with and without units, solved; what the runs said.
fn both(test: &str) -> (Bench, [String; 2]) {
    let bench = Bench::new(test);
    let declared = SPHERE.replace("[grid]", UNITS);
    bench.file("plain.toml", SPHERE).file("declared.toml", &declared);
    let said = ["plain", "declared"].map(|name| {
        let answer = bench.fret(&["run", &format!("{name}.toml"), "--out", name]);
        assert_eq!(answer.code, Some(0), "{}", answer.err);
        answer.out
    });
    (bench, said)
}

/// Rows without the column of times.
fn rows(table: &str) -> Vec<Vec<String>> {
    let head: Vec<&str> = table.lines().next().unwrap().split(',').collect();
    let time = head.iter().position(|name| *name == "wall_s");
    let cells = |line: &str| -> Vec<String> {
        line.split(',')
            .enumerate()
            .filter(|(n, _)| Some(*n) != time)
            .map(|(_, cell)| cell.to_owned())
            .collect()
    };
    table.lines().skip(1).map(cells).collect()
}

#[test]
fn tables_have_units_in_their_heads_and_the_same_numbers() {
    let (bench, _) = both("unit-heads");
    for (file, expected) in [
        (
            "history.csv",
            &[
                "normal_force [N]",
                "approach [m]",
                "max_pressure [Pa]",
                "contact_area [m^2]",
                "dissipated_energy [N m]",
                "residual",
            ][..],
        ),
        ("cycles.csv", &["stage", "dissipated_energy [N m]", "worn_volume [m^3]"]),
    ] {
        let [plain, declared] = ["plain", "declared"].map(|name| bench.text(&format!("{name}/{file}")));
        let heads = [&plain, &declared]
            .map(|table| table.lines().next().unwrap().split(',').map(str::to_owned).collect::<Vec<_>>());
        for head in expected {
            assert!(heads[1].contains(&(*head).to_owned()), "{head} in {:?}", heads[1]);
        }
        let names: Vec<String> =
            heads[1].iter().map(|head| head.split(" [").next().unwrap().to_owned()).collect();
        assert_eq!(names, heads[0]);
        assert_eq!(rows(&plain), rows(&declared));
    }
}

#[test]
fn a_summary_has_units_beside_its_names() {
    let (_bench, [plain, declared]) = both("unit-summary");
    for words in [
        "normal force [N]",
        "approach [m]",
        "max pressure [Pa]",
        "contact area [m^2]",
        "dissipated energy so far [N m]",
    ] {
        assert!(declared.contains(words), "{words} in {declared}");
        assert!(!plain.contains(words));
    }
}

#[test]
fn exports_carry_units() {
    let (bench, _) = both("unit-exports");
    for (name, has_units) in [("plain", false), ("declared", true)] {
        for (form, out) in [("--csv", "csv"), ("--npz", "run.npz"), ("--vtk", "vtk")] {
            let out = format!("{name}-{out}");
            assert_eq!(bench.fret(&["export", name, form, "--out", &out]).code, Some(0));
        }
        let table = bench.text(&format!("{name}-csv/fields_000018.csv"));
        let head = if has_units {
            "x [m],y [m],pressure [Pa],shear_x [Pa],shear_y [Pa],zone"
        } else {
            "x,y,pressure,shear_x,shear_y,zone"
        };
        assert_eq!(table.lines().next(), Some(head));
        let image = std::fs::read(bench.folder.join(format!("{name}-vtk/fields_000018.vti"))).unwrap();
        let image = String::from_utf8_lossy(&image);
        let key = "Name=\"shear\" NumberOfComponents=\"3\" format=\"appended\" offset=\"4616\"><InformationKey name=\"UNITS_LABEL\" location=\"vtkDataArray\">Pa</InformationKey></DataArray>";
        assert_eq!(image.contains(key), has_units);
        let archive = std::fs::read(bench.folder.join(format!("{name}-run.npz"))).unwrap();
        let utf32: Vec<u8> =
            "\"normal_force\":\"N\"".chars().flat_map(|letter| u32::from(letter).to_le_bytes()).collect();
        assert_eq!(archive.windows(utf32.len()).any(|window| window == utf32), has_units);
    }
}

/// A finished run is recognised, a folder read back, a stress table written: with units in every head.
#[test]
fn results_with_units_are_read_back() {
    let (bench, _) = both("unit-back");
    let again = bench.fret(&["run", "declared.toml", "--out", "declared", "--resume", "--json"]);
    assert_eq!(again.code, Some(0), "{}", again.err);
    let stress = bench.fret(&["stress", "declared", "--depths", "0,1e-5"]);
    assert_eq!(stress.code, Some(0), "{}", stress.err);
    assert!(stress.out.contains("value [Pa]") && stress.out.contains("depth [m]"), "{}", stress.out);
    assert!(
        bench.text("declared/stress/depths.csv").starts_with("increment,depth [m],layer,von_mises [Pa],")
    );
    let record: Value = serde_json::from_str(&bench.text("declared/stress/stress.json")).unwrap();
    assert_eq!(record["units"]["pressure"], "Pa");
    assert_eq!(bench.fret(&["report", "declared"]).code, Some(0));
    let page = bench.text("declared/report.html");
    assert!(
        page.contains("Stress below the surface") && page.contains("Largest values at each depth"),
        "the stresses are not in the page"
    );
}

/// Numbers that the program computed carry their unit in refusals and beside the fatigue of the last cycle.
#[test]
fn what_the_program_computed_is_told_with_its_unit() {
    let bench = Bench::new("unit-messages");
    let declared = SPHERE.replace("[grid]", UNITS);
    bench.file("slides.toml", &declared.replace("[0.05, 0.0]", "[0.15, 0.0]"));
    let refused = bench.fret(&["check", "slides.toml"]);
    assert_eq!(refused.code, Some(1));
    let words = "the tangential force reaches 0.15 N, where friction carries at most mu P = 0.1 N";
    assert!(refused.err.contains(words), "{}", refused.err);
    let moved =
        declared.replace("normal_force = 1.0", "approach = 1e-7").replace("[0.05, 0.0]", "[5.0, 0.0]");
    bench.file("moved.toml", &moved);
    let failed = bench.fret(&["run", "moved.toml", "--quiet"]);
    let told =
        failed.err.contains("tangential force 2.5 N is above ") && failed.err.contains(" 0.0981345 N: ");
    assert!(told, "{}", failed.err);
    let fields = "[\"pressure\", \"shear\", \"slip\"]";
    let kept =
        declared.replace("[\"pressure\", \"shear\", \"zone\"]", fields).replace("every = 5", "every = 2");
    bench.file("kept.toml", &format!("{kept}\n[stress]\nyield_strength = 700e6\n"));
    assert_eq!(bench.fret(&["run", "kept.toml", "--out", "kept", "--quiet"]).code, Some(0));
    let stress = bench.fret(&["stress", "kept", "--depths", "0,1e-5"]);
    let row = stress.out.lines().find(|line| line.contains("smith watson topper")).unwrap();
    assert!(row.contains(" Pa ") && row.contains(" m ") && row.ends_with(" Pa)"), "{row}");
    let row = stress.out.lines().find(|line| line.contains("fatemi socie")).unwrap();
    assert!(!row.contains(" Pa"), "a ratio has no unit: {row}");
    let heads = bench.text("kept/stress/fatigue.csv");
    assert!(heads.starts_with("parameter,layer,largest,x [m],y [m],depth [m],cycles,"), "{heads}");
}
