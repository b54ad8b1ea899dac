//! `fret compare-scar`: a measured line over a computed scar.

use serde_json::Value;

use crate::bench::Bench;

pub const WORN: &str = "units = { length = \"mm\", force = \"N\" }\n[grid]\ncells = 96\nsize = 0.6\n[upper]\nrigid = true\n\
    [lower]\nsubstrate = { young = 115e3, poisson = 0.32 }\n[profile.cylinder]\nradius = 6.0\naxis = \"y\"\n[friction]\ncoefficient = 0.8\n\
    [wear]\ncoefficient = 3e-8\nevery = 200\n[output]\nfields = [\"pressure\", \"worn_depth\"]\n\
    [[load]]\nnormal_force = 120.0\nincrements = 4\n[[load]]\nshift = [0.02, 0.0]\ncycles = 1000\nincrements = 8\n";

/// A profilometer's line over a parabola 4 um deep and 0.4 mm wide, in a surface that leans.
fn measured() -> String {
    let height = |x: f64| 2.0 + 5e-3 * (x - 800.0) - (4.0 * (1.0 - ((x - 800.0) / 200.0).powi(2))).max(0.0);
    (0..321).fold("probe 7\nx [um];z [um]\n".to_owned(), |text, k| {
        let x = 5.0 * f64::from(k);
        text + &format!("{x};{:.6}\n", height(x))
    })
}

#[test]
fn a_measured_line_is_levelled_and_laid_over_the_computed_scar() {
    let bench = Bench::new("scar");
    bench.file("case.toml", WORN);
    let run = bench.fret(&["run", "case.toml", "--out", "out", "--quiet"]);
    assert_eq!(run.code, Some(0), "{}", run.err);
    bench.file("line.csv", &measured());
    let answer = bench.fret(&["compare-scar", "out", "line.csv", "--json"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    let record: Value = serde_json::from_str(&answer.out).unwrap();
    assert_eq!(record, serde_json::from_str::<Value>(&bench.text("out/scar/scar.json")).unwrap());
    let measured = |name: &str| record["numbers"][name]["measured"].as_f64().unwrap();
    // cells of 1/64 of the width: their means are off by a thousandth of the depth at most
    for (name, right) in [("depth", 4e-3), ("width", 0.4 * 0.9_f64.sqrt()), ("area", 4e-3 * 0.4 * 2.0 / 3.0)]
    {
        assert!((measured(name) / right - 1.0).abs() < 4e-3, "{name}: {} for {right}", measured(name));
    }
    assert!((record["slope_taken_off"].as_f64().unwrap() - 5e-3).abs() < 1e-7);
    assert!((record["moved"].as_f64().unwrap() + 0.8).abs() < 1e-3);
    // the area of the computed section is the wear volume of a line contact, by length
    let area = record["numbers"]["area"]["computed"].as_f64().unwrap();
    assert!((area / record["worn_volume"].as_f64().unwrap() - 1.0).abs() < 1e-9, "{area}");

    // the computed depths themselves, as somebody would have measured them
    let csv = bench.text("out/scar/scar.csv");
    let mut own = "position,depth\num,um\n".to_owned();
    for line in csv.lines().skip(1) {
        let numbers: Vec<f64> = line.split(',').map(|word| word.parse().unwrap()).collect();
        own += &format!("{},{}\n", 1e3 * numbers[0], 1e3 * numbers[1] + 0.7);
    }
    // with something of the surface beside it
    let wider = own.replacen("position,depth\num,um\n", "position,depth\num,um\n-400,0.7\n", 1) + "400,0.7\n";
    bench.file("own.csv", &wider);
    let answer = bench.fret(&["compare-scar", "out", "own.csv", "--json"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    let record: Value = serde_json::from_str(&answer.out).unwrap();
    assert!(record["notes"][0].as_str().unwrap().contains("taken as depths"), "{record}");
    for name in ["depth", "width", "area"] {
        let off = record["numbers"][name]["difference"].as_f64().unwrap();
        // straight pieces between the cells, in the mean over each
        assert!(off.abs() < 0.01, "{name}: {off}");
    }
    assert!(bench.text("out/scar/scar.svg").contains("measured"));
}

#[test]
fn what_cannot_be_compared_is_refused_with_a_way_out() {
    let bench = Bench::new("scar-refused");
    bench.file("case.toml", &WORN.replace("\"pressure\", \"worn_depth\"", "\"pressure\""));
    assert_eq!(bench.fret(&["run", "case.toml", "--out", "out", "--quiet"]).code, Some(0));
    bench.file("line.csv", &measured());
    let answer = bench.fret(&["compare-scar", "out", "line.csv"]);
    assert_eq!(answer.code, Some(1));
    assert!(
        answer.err.contains("worn_depth was not kept") && answer.err.contains("output.fields"),
        "{}",
        answer.err
    );
    let answer = bench.fret(&["compare-scar", "out", "line.csv", "--columns", "position"]);
    assert!(answer.err.contains("no equals sign"), "{}", answer.err);
    let answer = bench.fret(&["compare-scar", "out", "missing.csv"]);
    assert_eq!(answer.code, Some(1));
    assert!(answer.err.contains("missing.csv"), "{}", answer.err);
}
