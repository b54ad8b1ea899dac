//! The mean gap between surfaces that repeat, as a column and as what is prescribed.

use std::f64::consts::{FRAC_PI_2, PI};

use fret_core::case::{Attachments, Case};
use fret_core::history::{History, StepRecord};
use fret_core::plan::Plan;
use fret_core::run::{Silent, Simulation};

const WAVE: &str = "grid = { cells = [256, 4], size = [1.0, 0.1], periodic = true }\nupper = { rigid = true }\n\
    lower = { substrate = { young = 0.75, poisson = 0.5 } }\nprofile = { wave = { amplitude = 0.01, wavelength_x = 1.0 } }\n\
    friction = { coefficient = 0.3 }\nsolver = { tolerance = 1e-10 }\n";

fn case(text: &str, table: &'static str) -> Result<Case, String> {
    let file = |_: &str| Ok(table.as_bytes().to_vec());
    Case::from_toml_with(text, "case.toml", Attachments::files(&file)).map_err(|error| error.to_string())
}

fn solved(text: &str) -> History {
    let plan = Plan::new(case(text, "").unwrap()).unwrap();
    Simulation::new(&plan).run(&mut Silent).unwrap()
}

fn last(history: &History) -> &StepRecord {
    history.steps.last().unwrap()
}

/// Mean gap of a wave of height `2 amplitude` on a half-space in contact over the share `contact` of its length. Westergaard's pressure
/// leaves the slope `4 pi amplitude / length cos t sqrt(sin^2 t - s^2)`, `t = pi x / length`, `s = sin(pi contact / 2)`, beside the contact,
/// which is that of the wave for `s = 0`; integrated once in closed form and once by the midpoint rule.
fn mean_gap(amplitude: f64, contact: f64) -> f64 {
    let from = FRAC_PI_2 * contact;
    let s = from.sin();
    let count = 20_000;
    let width = (FRAC_PI_2 - from) / f64::from(count);
    let gap = |t: f64| {
        let v = t.sin();
        2.0 * amplitude * (v * (v * v - s * s).sqrt() - s * s * (v / s).acosh())
    };
    (0..count).map(|k| gap(from + (f64::from(k) + 0.5) * width)).sum::<f64>() * width / FRAC_PI_2
}

/// Mean pressure of that contact: `pi E* amplitude / length sin^2`, with E* = 1 and the area of the period 0.1.
fn force(amplitude: f64, contact: f64) -> f64 {
    PI * amplitude * (FRAC_PI_2 * contact).sin().powi(2) * 0.1
}

#[test]
fn a_wave_pressed_to_a_mean_gap_carries_the_force_of_westergaard() {
    for contact in [0.2, 0.5, 0.8] {
        let gap = mean_gap(0.01, contact);
        let found = solved(&format!("{WAVE}[[load]]\nmean_gap = {gap:e}\nincrements = 2\n"));
        let (found, right) = (last(&found), force(0.01, contact));
        // of second order: 1.9e-4, 4.7e-5, 1.2e-5 at 128, 256, 512 cells and half the wave; at most 6.4e-5 at 256
        assert!(
            (found.normal_force / right - 1.0).abs() < 1e-4,
            "{contact}: {} for {right}",
            found.normal_force
        );
        assert!(
            (found.mean_gap.unwrap() / gap - 1.0).abs() < 1e-7,
            "{contact}: {:?} for {gap}",
            found.mean_gap
        );
    }
}

#[test]
fn the_force_that_a_mean_gap_needs_leaves_that_mean_gap() {
    let by_gap = solved(&format!("{WAVE}[[load]]\nmean_gap = 6e-3\nincrements = 1\n"));
    let by_force =
        solved(&format!("{WAVE}[[load]]\nnormal_force = {:e}\nincrements = 1\n", last(&by_gap).normal_force));
    assert!((last(&by_force).mean_gap.unwrap() - 6e-3).abs() < 1e-10);
    // a force held, and then a gap; and half a cycle of it
    let then = solved(&format!(
        "{WAVE}[[load]]\nnormal_force = 1e-3\nincrements = 1\n[[load]]\nmean_gap = 6e-3\nincrements = 2\n\
         [[load]]\nmean_gap = 1e-3\ncycles = 1\nincrements = 4\n"
    ));
    let gaps: Vec<f64> = then.steps.iter().map(|step| step.mean_gap.unwrap()).collect();
    for (found, right) in gaps[2..].iter().zip([6e-3, 7e-3, 6e-3, 5e-3, 6e-3]) {
        assert!((found - right).abs() < 1e-10, "{gaps:?}");
    }
}

/// Closed at a mean pressure of pi E* amplitude / length; above it nothing is left of the gap, and no rounding of it.
#[test]
fn surfaces_that_touch_everywhere_have_no_mean_gap() {
    for times in [1.1, 3.0] {
        let history = solved(&format!(
            "{WAVE}[[load]]\nnormal_force = {:e}\nincrements = 1\n",
            times * force(0.01, 1.0)
        ));
        assert_eq!(last(&history).mean_gap, Some(0.0));
    }
}

#[test]
fn a_cycle_that_would_close_the_gap_ends_the_run() {
    let text = format!(
        "{WAVE}[[load]]\nmean_gap = 6e-3\nincrements = 1\n[[load]]\nmean_gap = 7e-3\ncycles = 1\nincrements = 4\n"
    );
    let plan = Plan::new(case(&text, "").unwrap()).unwrap();
    let error = Simulation::new(&plan).run(&mut Silent).unwrap_err();
    assert!(error.to_string().contains("the surfaces touch everywhere"), "{error}");
}

#[test]
fn a_mean_gap_is_prescribed_by_a_table_too() {
    let text = format!("{WAVE}[[load]]\ntable = \"gaps.csv\"\nincrements = 1\n");
    let plan = Plan::new(case(&text, "mean_gap\n8e-3\n6e-3\n").unwrap()).unwrap();
    let by_table = Simulation::new(&plan).run(&mut Silent).unwrap();
    let by_key = solved(&format!(
        "{WAVE}[[load]]\nmean_gap = 8e-3\nincrements = 1\n[[load]]\nmean_gap = 6e-3\nincrements = 1\n"
    ));
    for (one, other) in by_table.steps.iter().zip(&by_key.steps) {
        assert_eq!(one.normal_force, other.normal_force);
    }
}

#[test]
fn surfaces_without_a_mean_gap_say_what_they_have() {
    let refused = |changes: &[(&str, &str)], load: &str, words: &[&str]| {
        let text = changes.iter().fold(WAVE.to_owned(), |text, (from, to)| text.replacen(from, to, 1));
        let error = case(&format!("{text}[[load]]\n{load}\nincrements = 1\n"), "").unwrap_err();
        for word in words {
            assert!(error.contains(word), "{error}: expected {word:?}");
        }
    };
    let ball = [
        ("periodic = true", "periodic = false"),
        ("wave = { amplitude = 0.01, wavelength_x = 1.0 }", "sphere = { radius = 10.0 }"),
    ];
    refused(&ball, "mean_gap = 1e-3", &["do not repeat", "approach = ..."]);
    let layer = [(
        "substrate = { young = 0.75, poisson = 0.5 }",
        "base = \"rigid\", coatings = [{ thickness = 0.1, young = 0.75, poisson = 0.5 }]",
    )];
    refused(&layer, "mean_gap = 1e-3", &["layers on a rigid base", "approach = ..."]);
    refused(&[], "mean_gap = 0.0", &["must be above 0", "normal_force"]);
    refused(&[], "approach = 1e-3", &["no such rigid motion", "mean_gap"]);
    refused(&[], "mean_gap = 1e-3\nnormal_force = 1.0", &["both at once"]);
}
