//! `check`, `plan`, `schema`: answers without any heavy work and without any file.

use std::path::Path;

use crate::bench::{Bench, SPHERE};

#[test]
fn a_good_case_is_called_good_with_a_few_facts() {
    let bench = Bench::new("good");
    let case = SPHERE.replace("[240e-6, 240e-6]", "\"auto\"");
    let answer = bench.file("case.toml", &case).fret(&["check", "case.toml"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    assert!(answer.out.starts_with("case.toml: good\n"), "{}", answer.out);
    assert!(answer.out.contains("24 x 24 cells"), "{}", answer.out);
    assert!(answer.out.contains("19 increments"), "{}", answer.out);
    assert_eq!(answer.err, "");
    assert_eq!(bench.names(), ["case.toml"]);
}

#[test]
fn a_plan_says_what_is_left_out_and_why() {
    let bench = Bench::new("plan");
    let frictionless = SPHERE.replace("coefficient = 0.1", "coefficient = 0.0");
    let pressed_only = frictionless.split("[[load]]\nname = \"fretting\"").next().unwrap().to_owned();
    let answer = bench.file("case.toml", &pressed_only).fret(&["plan", "case.toml"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    for words in ["automatic simplifications", "there is no friction", "memory"] {
        assert!(answer.out.contains(words), "expected {words:?}: {}", answer.out);
    }
    assert_eq!(bench.names(), ["case.toml"], "planning writes nothing");
}

#[test]
fn a_run_names_what_is_left_out_a_line_each_and_increments_as_its_files_do() {
    let bench = Bench::new("run-tells");
    let answer = bench.file("case.toml", SPHERE).fret(&["run", "case.toml", "--out", "out"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    let told: Vec<&str> = answer.err.lines().collect();
    let plan = bench.fret(&["plan", "case.toml", "--json"]);
    let plan: serde_json::Value = serde_json::from_str(&plan.out).unwrap();
    let items = plan["left_out"].as_array().unwrap();
    assert!(told[0].contains("`fret plan` gives the reasons"), "{}", answer.err);
    for (line, item) in told[1..].iter().zip(items) {
        assert_eq!(line.trim(), item["what"].as_str().unwrap());
    }
    // The last line is about the last increment, by its number in history.csv.
    let history = bench.text("out/history.csv");
    let last = history.lines().last().unwrap().split(',').next().unwrap();
    let line = told.last().unwrap();
    assert!(line.starts_with(&format!("increment {last}  fretting done")), "{}", answer.err);
    assert!(line.contains("19 of 19 solved"), "{}", answer.err);
}

#[test]
fn a_plan_counts_the_layers_of_a_graded_coating_and_tells_of_the_box() {
    let bench = Bench::new("plan-layers");
    let coating = "coatings = [{ thickness = 20e-6, poisson = 0.3, gradient = { young = [400e9, 210e9], law = \"linear\", \
                   layers = 12 } }]\nsubstrate =";
    let answer =
        bench.file("case.toml", &SPHERE.replace("substrate =", coating)).fret(&["plan", "case.toml"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    for words in ["12 uniform layers on the lower body", "active subdomain around the contact"] {
        assert!(answer.out.contains(words), "expected {words:?}: {}", answer.out);
    }
}

#[test]
fn a_plan_in_json_carries_the_case_as_it_was_understood() {
    let bench = Bench::new("plan-json");
    let answer = bench.file("case.toml", SPHERE).fret(&["plan", "case.toml", "--json"]);
    let plan: serde_json::Value = serde_json::from_str(&answer.out).unwrap();
    assert_eq!(plan["increments"], 19);
    assert_eq!(plan["grid"]["cells"], serde_json::json!([24, 24]));
    assert_eq!(plan["case"]["tolerance"], 1e-8);
    assert!(plan["left_out"].is_array());
}

#[test]
fn the_schema_beside_the_examples_is_the_one_the_command_prints() {
    let printed = Bench::new("schema").fret(&["schema"]);
    assert_eq!(printed.code, Some(0));
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/fret.schema.json");
    let stored = std::fs::read_to_string(path).unwrap().replace("\r\n", "\n");
    assert_eq!(stored, printed.out, "renew it: cargo run -- schema > examples/fret.schema.json");
}

#[test]
fn every_example_is_a_good_case_and_names_its_schema() {
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    let bench = Bench::new("examples");
    for entry in std::fs::read_dir(examples).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|extension| extension == "toml") {
            let text = std::fs::read_to_string(&path).unwrap();
            assert_eq!(text.lines().next(), Some("#:schema ./fret.schema.json"), "{}", path.display());
            let answer = bench.fret(&["check", path.to_str().unwrap()]);
            assert_eq!(answer.code, Some(0), "{}", answer.err);
        }
    }
}

#[test]
fn a_plan_of_a_case_without_a_title_is_called_by_its_file() {
    let bench = Bench::new("plan-title");
    bench.file("ball.toml", &SPHERE.replace("title = \"a small sphere\"", ""));
    let answer = bench.fret(&["plan", "ball.toml"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    assert!(answer.out.starts_with("ball\n\n"), "{}", answer.out);
}
