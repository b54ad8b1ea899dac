//! `fret report` of a sweep and of a study: one page that stands alone.

use crate::bench::{Bench, SPHERE};
use crate::shown::{assert_balanced, assert_stands_alone};

/// The page has a mark of the map for every point, each leads to a place of the page with the loop and the numbers of that point.
#[test]
fn every_mark_of_the_fretting_map_leads_to_its_point() {
    let bench = Bench::new("sweep-page");
    let sweep = "base = 'case.toml'\n[axes]\n'friction.coefficient' = [0.06, 0.1, -0.1]\n\
                 'load.fretting.tangential_force.0' = [0.03, 0.05]\n";
    bench
        .file("case.toml", &SPHERE.replace("a small sphere", "a <sphere>"))
        .file("many.toml", sweep)
        .fret(&["sweep", "many.toml", "--quiet"]);
    let answer = bench.fret(&["report", "results/many"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    let page = bench.text("results/many/report.html");
    assert_stands_alone(&page);
    assert_balanced(&page);
    assert!(page.contains("Sweep: a &lt;sphere&gt;") && !page.contains("NaN"));
    let map = page.split("fretting map: sliding condition").nth(1).unwrap().split("</svg>").next().unwrap();
    for point in 0..6 {
        assert_eq!(map.matches(&format!("href=\"#point-{point}\"")).count(), 1, "{point}");
        let place = page.split(&format!("id=\"point-{point}\"")).nth(1).unwrap();
        let place = place.split("class=\"point\"").next().unwrap();
        // points 4 and 5 are refused: they say why
        assert_eq!(place.contains("fretting loop of the point"), point < 4, "{point}");
        assert_eq!(place.contains("must be zero or positive"), point >= 4, "{point}");
    }
    // Q = 0.05 of mu P = 0.06: partial slip; the refused ones have a mark of their own.
    assert_eq!(map.matches("mark partial_slip").count(), 4);
    assert_eq!(map.matches("mark unsolved").count(), 2);
    for words in ["Over an axis", "dissipated energy of the last cycle", "All points", "4 solved, 2 refused"]
    {
        assert!(page.contains(words), "{words}");
    }
}

/// Samples are told by quantiles, curves of frequency and bars of Sobol' indices: the numbers of `uncertainty.json`.
#[test]
fn the_page_of_samples_tells_their_scatter() {
    let bench = Bench::new("sweep-page-samples");
    let sweep = "base = 'case.toml'\n[distributions]\n\
                 'friction.coefficient' = { uniform = { from = 0.08, to = 0.16 } }\n\
                 'profile.sphere.radius' = { normal = { mean = 10e-3, deviation = 0.5e-3 } }\n\
                 [samples]\ncount = 8\nindices = true\n";
    let answer =
        bench.file("case.toml", SPHERE).file("drawn.toml", sweep).fret(&["sweep", "drawn.toml", "--quiet"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    assert_eq!(bench.fret(&["report", "results/drawn"]).code, Some(0));
    let page = bench.text("results/drawn/report.html");
    assert_stands_alone(&page);
    assert_balanced(&page);
    let told: serde_json::Value =
        serde_json::from_str(&bench.text("results/drawn/uncertainty.json")).unwrap();
    let mean = told["quantities"]["max_pressure"]["mean"].as_f64().unwrap();
    let digits = format!("{mean:.4e}");
    assert!(page.contains(digits.split('e').next().unwrap()), "{mean}");
    let total =
        told["quantities"]["max_pressure"]["sobol_indices"]["profile.sphere.radius"]["total"].as_f64();
    assert!(page.contains(&format!("<td>{:.2}</td>", total.unwrap())), "{total:?}");
    for words in
        ["Cumulative frequency: max pressure", "class=\"bar total\"", "friction coefficient (uniform"]
    {
        assert!(page.contains(words), "{words}");
    }
}

/// A study is told with its choice, its errors and its levels.
#[test]
fn a_study_has_a_page() {
    let bench = Bench::new("study-page");
    let frictionless = SPHERE.split("[friction]").next().unwrap().to_owned()
        + "[[load]]\nname = \"indent\"\nnormal_force = 1.0\nincrements = 3\n";
    let answer =
        bench.file("case.toml", &frictionless).fret(&["study", "case.toml", "--cells", "16,32", "--quiet"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    let answer = bench.fret(&["report", "results/case-study", "--json"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    assert!(answer.out.contains("\"levels\": 2"), "{}", answer.out);
    let page = bench.text("results/case-study/report.html");
    assert_stands_alone(&page);
    assert_balanced(&page);
    let told: serde_json::Value = serde_json::from_str(&bench.text("results/case-study/study.json")).unwrap();
    let error = told["lines"][0]["levels"][1]["errors"]["max_pressure"].as_f64().unwrap();
    assert!(page.contains(&format!("<td>{error:.1e}</td>")), "{error}");
    assert!(page.contains("closed form: ") && page.contains("Error of every quantity over the resolution"));
}

#[test]
fn a_folder_that_is_no_sweep_of_the_command_says_what_makes_one() {
    let bench = Bench::new("sweep-page-none");
    std::fs::create_dir_all(bench.folder.join("other/points")).unwrap();
    let answer = bench.fret(&["report", "other"]);
    assert_eq!(answer.code, Some(1));
    assert!(answer.err.contains("regime_map"), "{}", answer.err);
}

/// Every control has its unit on the axes, by the table of the controls: the displacement of an actuator as that of the body.
#[test]
fn the_axis_of_an_actuator_has_its_unit() {
    let bench = Bench::new("sweep-page-actuator");
    let case = "units = { length = 'mm', force = 'N' }\ngrid = { cells = [16, 16], size = [0.3, 0.3] }\nupper.rigid = true\n\
                lower.substrate = { young = 210e3, poisson = 0.3 }\nprofile.sphere.radius = 10.0\nfriction.coefficient = 0.3\n\
                rig.tangential_stiffness = 1e4\n[[load]]\nnormal_force = 10.0\nincrements = 1\n\
                [[load]]\nname = 'rub'\nactuator = [1e-4, 0.0]\nincrements = 2\n";
    let sweep = "base = 'case.toml'\n[axes]\n'load.rub.actuator.0' = [1e-4, 2e-4, 3e-4]\n'rig.tangential_stiffness' = [1e4, 2e4]\n";
    let answer =
        bench.file("case.toml", case).file("pulled.toml", sweep).fret(&["sweep", "pulled.toml", "--quiet"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    assert_eq!(bench.fret(&["report", "results/pulled"]).code, Some(0));
    let page = bench.text("results/pulled/report.html");
    assert!(page.contains("actuator, rub = 3 · 10⁻⁴\u{a0}mm"), "{page}");
    assert!(page.contains("\u{a0}N/mm"), "{page}");
}

/// Keys that change, amplitudes and stiffness have their units in every table: those of a loop of force and shift, or of moment and rotation.
#[test]
fn heads_of_a_sweep_have_their_units() {
    let bench = Bench::new("sweep-units");
    let case = |motion: &str| {
        format!(
            "units = {{ length = 'mm', force = 'N' }}\ngrid = {{ cells = [16, 16], size = [0.3, 0.3] }}\nupper.rigid = true\n\
             lower.substrate = {{ young = 210e3, poisson = 0.3 }}\nprofile.sphere.radius = 10.0\nfriction.coefficient = 0.3\n\
             [[load]]\nname = 'press'\nnormal_force = 10.0\nincrements = 1\n[[load]]\nname = 'rub'\n{motion}\ncycles = 1\nincrements = 8\n"
        )
    };
    let sweep = "base = 'case.toml'\n[axes]\n'load.press.normal_force' = [8.0, 10.0]\n'friction.coefficient' = [0.3]\n";
    bench.file("sweep.toml", sweep);
    for (motion, amplitude, stiffness) in
        [("shift = [1e-4, 0.0]", ["N", "mm"], "N/mm"), ("twist = 1e-3", ["N mm", "rad"], "N mm")]
    {
        let folder = amplitude[1];
        bench.file("case.toml", &case(motion));
        let answer = bench.fret(&["sweep", "sweep.toml", "-q", "-o", folder]);
        assert_eq!(answer.code, Some(0), "{}", answer.err);
        let head = bench.text(&format!("{folder}/summary.csv")).lines().next().unwrap().to_owned();
        let [force, motion] = amplitude;
        for column in [
            "load.press.normal_force [N]",
            "friction.coefficient",
            &format!("cycle_force_amplitude [{force}]"),
            &format!("cycle_displacement_amplitude [{motion}]"),
            &format!("cycle_stiffness [{stiffness}]"),
        ] {
            assert!(head.split(',').any(|found| found == column), "{column}: {head}");
        }
        assert_eq!(bench.fret(&["report", folder]).code, Some(0));
        let page = bench.text(&format!("{folder}/report.html"));
        assert!(page.contains(&format!("\u{a0}{stiffness}<")), "{page}");
        assert_eq!(bench.fret(&["run", "case.toml", "-q", "--force", "-o", "run"]).code, Some(0));
        let head = bench.text("run/cycles.csv").lines().next().unwrap().to_owned();
        for column in [
            format!("force_amplitude [{force}]"),
            format!("opening [{motion}]"),
            format!("stiffness [{stiffness}]"),
        ] {
            assert!(head.split(',').any(|found| found == column), "{column}: {head}");
        }
    }
    // what the samples say of numbers has their units, too
    let drawn = "base = 'case.toml'\n[distributions]\n'load.press.normal_force' = { uniform = { from = 8.0, to = 10.0 } }\n[samples]\ncount = 4\n";
    bench.file("case.toml", &case("shift = [1e-4, 0.0]"));
    let answer = bench.file("drawn.toml", drawn).fret(&["sweep", "drawn.toml"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    assert!(
        answer.out.contains("cycle_stiffness [N/mm]") && answer.out.contains("max_pressure [MPa]"),
        "{}",
        answer.out
    );
    assert_eq!(bench.fret(&["report", "results/drawn"]).code, Some(0));
    assert!(bench.text("results/drawn/report.html").contains("[N] (uniform"));
}
