//! Numbers that would mislead: told of on every face of the command, or not shown at all.

use serde_json::Value;

use crate::bench::{Bench, SPHERE};

/// Names of the warnings in an answer in JSON.
fn names(text: &str) -> Vec<String> {
    let answer: Value = serde_json::from_str(text).unwrap();
    let list = answer["warnings"].as_array().unwrap_or_else(|| panic!("{text}"));
    list.iter().map(|warning| warning["name"].as_str().unwrap().to_owned()).collect()
}

#[test]
fn a_grid_of_the_wrong_unit_is_told_of_by_every_verb() {
    let bench = Bench::new("misleading");
    bench.file("case.toml", &SPHERE.replace("[240e-6, 240e-6]", "[1.0, 1.0]"));
    for verb in ["check", "plan"] {
        let answer = bench.fret(&[verb, "case.toml"]);
        assert_eq!(answer.code, Some(0), "{}", answer.err);
        assert!(answer.out.contains("warning: cells in the contact radius: "), "{}", answer.out);
        assert_eq!(answer.out.starts_with("case.toml: good, but\n"), verb == "check", "{}", answer.out);
        assert!(names(&bench.fret(&[verb, "case.toml", "--json"]).out).contains(&"few_cells".to_owned()));
    }
    let answer = bench.fret(&["run", "case.toml", "--json"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    assert!(names(&answer.out).contains(&"few_cells".to_owned()));
    assert!(names(&bench.text("results/case/run.json")).contains(&"few_cells".to_owned()));
    assert!(bench.fret(&["run", "case.toml"]).out.contains("warning: cells in the contact radius: "));
    assert_eq!(bench.fret(&["report", "results/case"]).code, Some(0));
    assert!(bench.text("results/case/report.html").contains("Cells in the contact radius: "));
    let refused = bench.fret(&["run", "case.toml", "--estimate-error", "--force"]);
    assert_eq!(refused.code, Some(1));
    assert!(refused.err.contains("cells in the contact radius are too few"), "{}", refused.err);
    // The same contact on a grid of its own size: nothing to say before the run.
    bench.file("good.toml", &SPHERE.replace("[240e-6, 240e-6]", "\"auto\""));
    assert_eq!(names(&bench.fret(&["check", "good.toml", "--json"]).out), Vec::<String>::new());
}

/// Hertz: 1 N on a ball of radius r and E* = 230.8 GPa, a = (3 P r / (4 E*))^(1/3). With r = 10 mm for 10 um written, a / r is 0.15; with
/// 10e-6 in a case in millimetres it is 1.5.
#[test]
fn a_length_off_by_a_thousand_is_refused_where_units_are_declared() {
    let bench = Bench::new("thousand");
    let case = SPHERE.replace("[240e-6, 240e-6]", "\"auto\"").replace("radius = 10e-3", "radius = 10e-6");
    let units = "\n[units]\nlength = \"mm\"\nforce = \"N\"\n\n[grid]";
    let in_units = case.replace("210e9", "210e3").replace("\n[grid]", units);
    let answer = bench.file("case.toml", &in_units).fret(&["check", "case.toml"]);
    assert_eq!(answer.code, Some(1), "{}", answer.out);
    let a = (0.75 * 1.0 * 10e-6 / (210e3 / 0.91_f64)).cbrt();
    let ratio = a / 10e-6;
    assert!(ratio > 1.0);
    let told: f64 =
        answer.err.split("over body radius: ").nth(1).unwrap().split(',').next().unwrap().parse().unwrap();
    assert!((told / ratio - 1.0).abs() < 0.06, "{told} {ratio}"); // a coarse grid knows the radius to a twentieth
    assert!(answer.err.contains("case.toml:17:2") && answer.err.contains("moduli in MPa"), "{}", answer.err);
    // numbers without units may be without dimension
    let plain = in_units.replace(units, "\n[grid]");
    let answer = bench.file("plain.toml", &plain).fret(&["check", "plain.toml"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    assert!(answer.out.contains("warning: contact radius over body radius"), "{}", answer.out);
}

#[test]
fn a_third_value_of_a_pair_is_refused_with_its_place() {
    for (good, bad, place) in [
        ("cells = [24, 24]", "cells = [24, 24, 16]", "4:9"),
        ("tangential_force = [0.05, 0.0]", "tangential_force = [0.05, 0.0, 7.0]", "26:20"),
        ("tangential_force = [0.05, 0.0]", "shift = [1e-9, 0.0, 7.0]", "26:9"),
        ("cycles = 2", "cycles = 2\nenvelope = [1.0, 0.5, 9.0]", "28:12"),
        ("cycles = 2", "cycles = 2\nphase = { tangential_force = [0.0, 90.0, 1.0] }", "28:30"),
    ] {
        let bench = Bench::new("pairs");
        let answer = bench.file("case.toml", &SPHERE.replace(good, bad)).fret(&["check", "case.toml"]);
        assert_eq!(answer.code, Some(1), "{bad}: {}", answer.out);
        let words = "found 3 values, expected a list of two values";
        assert!(
            answer.err.contains(words) && answer.err.contains(&format!("case.toml:{place}")),
            "{bad}: {}",
            answer.err
        );
    }
}

#[test]
fn a_run_with_wear_sums_up_all_its_cycles() {
    let bench = Bench::new("worn");
    let wear = "[wear]\ncoefficient = 1e-12\nevery = 5\n\n[output]";
    let case = SPHERE.replace("cycles = 2", "cycles = 20").replace("[output]", wear);
    let answer = bench.file("case.toml", &case).fret(&["run", "case.toml", "--json"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    let record: Value = serde_json::from_str(&bench.text("results/case/run.json")).unwrap();
    let total = |name: &str| record["totals"][name].as_f64().unwrap();
    // What is worn off is the coefficient times what was dissipated, whatever cycles stand for others.
    let ratio = total("worn_volume") / (1e-12 * total("dissipated_energy"));
    assert!((ratio - 1.0).abs() < 1e-9, "{ratio}");
    assert_eq!(bench.fret(&["run", "case.toml", "--force"]).code, Some(0));
    let table = bench.fret(&["run", "case.toml"]).out;
    for words in [
        "worn volume so far",
        "max wear depth",
        "cycles                                      -             20",
        "cycles solved",
        "in each of cycles",
    ] {
        assert!(table.contains(words), "expected {words:?}:\n{table}");
    }
}

/// Closed forms are laid over a run only where they hold: not over a coupled one, nor over sliding.
#[test]
fn a_report_shows_no_closed_form_of_partial_slip_where_there_is_none() {
    let bench = Bench::new("forms");
    let like = "[upper]\nsubstrate = { young = 210e9, poisson = 0.3 }";
    let partial = SPHERE.replace("[upper]\nrigid = true", like);
    let slides = partial.replace("tangential_force = [0.05, 0.0]", "shift = [1e-6, 0.0]");
    let form = "Mindlin and Deresiewicz";
    for (name, case, has_form) in
        [("partial", &partial, true), ("slides", &slides, false), ("coupled", &SPHERE.to_owned(), false)]
    {
        let file = format!("{name}.toml");
        assert_eq!(bench.file(&file, case).fret(&["run", &file]).code, Some(0), "{name}");
        assert_eq!(bench.fret(&["report", &format!("results/{name}")]).code, Some(0));
        let page = bench.text(&format!("results/{name}/report.html"));
        let comparison = page.find("Against the closed form").map_or("", |at| &page[at..]);
        assert_eq!(
            page.contains(&format!("Dashed: the closed form for the same forces (Cattaneo, {form})")),
            has_form,
            "{name}"
        );
        assert_eq!(comparison.contains("radius of stick"), has_form, "{name}");
    }
}

#[test]
fn a_report_of_torsion_draws_moment_over_twist() {
    let bench = Bench::new("twisted");
    let case = SPHERE.replace("tangential_force = [0.05, 0.0]", "twist_moment = 5e-7");
    assert_eq!(bench.file("case.toml", &case).fret(&["run", "case.toml"]).code, Some(0));
    assert_eq!(bench.fret(&["report", "results/case"]).code, Some(0));
    let page = bench.text("results/case/report.html");
    assert!(
        page.contains("torsional moment over rotation") && page.contains("Moment over rotation"),
        "no loop"
    );
    assert!(page.contains("Dissipated energy"), "no energy");
    assert!(!page.contains("tangential force over relative displacement"));
}

/// Like line contacts have one too, also under a bulk stress in step with the force, but not in another step, nor under a bulk stress so
/// large that both edges slip; the numbers beside it are near.
#[test]
fn a_report_of_a_line_contact_shows_cattaneo_where_it_holds() {
    let bench = Bench::new("line-forms");
    let line =
        include_str!("../../../../examples/cylinder_on_flat.toml").replace("cells = 512", "cells = 128");
    let pull = "tangential_force = [2.5e5, 0.0]";
    let bulk = |words: &str| line.replace(pull, &format!("{pull}\n{words}"));
    // e/a = sigma / (4 mu p0): 0.1 for 171 MPa; moderate up to Q / (2 mu P) = 0.25
    let cases = [
        ("plain", line.clone(), [true, true]),
        ("back", line.replace("[2.5e5, 0.0]", "[-2.5e5, 0.0]"), [true, true]),
        ("along", line.replace("[2.5e5, 0.0]", "[0.0, 2.5e5]"), [true, true]),
        ("in_step", bulk("bulk_stress = 171e6"), [true, false]),
        ("large", bulk("bulk_stress = 600e6"), [false, false]),
        ("out_of_step", bulk("bulk_stress = 171e6\nphase = { bulk_stress = 45.0 }"), [false, false]),
        (
            "coupled",
            line.replace("young = 210e9", "young = 800e9").replacen("young = 800e9", "young = 210e9", 1),
            [false; 2],
        ),
    ];
    for (name, case, [has_form, knows_shift]) in cases {
        let file = format!("{name}.toml");
        let answer = bench.file(&file, &case).fret(&["run", &file]);
        assert_eq!(answer.code, Some(0), "{name}: {}", answer.err);
        assert_eq!(bench.fret(&["report", &format!("results/{name}")]).code, Some(0));
        let page = bench.text(&format!("results/{name}/report.html"));
        assert_eq!(page.contains("dashed the closed form (Cattaneo)"), has_form, "{name}");
        let shift = "Dashed: the closed form for the same forces (Cattaneo), relative to the datum.";
        assert_eq!(page.contains(shift), knows_shift, "{name}");
        let off = |what: &str| -> Option<f64> {
            let row = page.split(&format!("<td>{what}</td>")).nth(1)?;
            let cell = row.split("</td>").nth(2)?.trim_start_matches("<td>");
            cell.replace('−', "-").trim_end_matches(" %").parse().ok()
        };
        let found = [off("width of stick"), off("displacement")];
        assert_eq!(found.map(|found| found.is_some()), [has_form, knows_shift], "{name}: {found:?}");
        // whole cells: two of the 66 that stick; displacement of second order
        assert!(found[0].is_none_or(|off| off.abs() < 3.1), "{name}: {found:?}");
        assert!(found[1].is_none_or(|off| off.abs() < 0.3), "{name}: {found:?}");
    }
}

/// A key of wear cut short is the key, with its place; two stages cannot have one name.
#[test]
fn keys_cut_short_and_stages_of_one_name_are_refused_with_their_places() {
    let bench = Bench::new("cut-short");
    let case = SPHERE.replace("[output]", "[wear]\ncoeff = 1\n\n[output]");
    let answer = bench.file("case.toml", &case).fret(&["check", "case.toml"]);
    assert_eq!(answer.code, Some(1));
    assert_eq!(answer.err.matches("error: ").count(), 1, "{}", answer.err);
    let line = case.lines().position(|line| line == "coeff = 1").unwrap() + 1;
    assert!(answer.err.contains("did you mean `coefficient`?"), "{}", answer.err);
    assert!(answer.err.contains(&format!("case.toml:{line}:1")), "{}", answer.err);

    let case = SPHERE.replace("[output]", "[wear]\nlaw = \"energy\"\n\n[output]");
    let answer = bench.file("case.toml", &case).fret(&["check", "case.toml"]);
    let line = case.lines().position(|line| line == "[wear]").unwrap() + 1;
    assert!(answer.err.contains("[wear] needs a coefficient"), "{}", answer.err);
    assert!(answer.err.contains(&format!("case.toml:{line}:1")), "{}", answer.err);

    let case = SPHERE.replace("name = \"fretting\"", "name = \"indent\"");
    assert_ne!(case, SPHERE);
    let answer = bench.file("case.toml", &case).fret(&["check", "case.toml"]);
    assert_eq!(answer.code, Some(1), "{}", answer.out);
    assert!(answer.err.contains("load[1].name = \"indent\": load[0] has that name, too"), "{}", answer.err);
}
