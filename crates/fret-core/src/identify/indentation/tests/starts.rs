//! Starts far away from what is found.

use super::super::IndentationRequest;
use super::films::{THICKNESS, YOUNG, film, of_film};
use super::{Load, Model, Test, flat, found, hertz, homogeneous, refusal_of, sneddon, sphere};

/// Ten and a hundred times too soft and too stiff, three times, of a sphere, a cone and a punch in closed form, with 0.2 % of noise: the modulus to
/// 1.5 %, the error of 32 cells, the same from each of them to a hundredth of that.
#[test]
fn a_modulus_is_found_from_a_hundred_times_too_soft_or_too_stiff() {
    let ball = homogeneous("profile.sphere.radius = 1.0", 32);
    let cone = homogeneous("profile.cone.slope = 0.2", 32);
    let punch = homogeneous("profile.flat_punch.radius = 0.01", 32);
    let tests: [(&str, Model<'_>, f64, Load<'_>); 3] =
        [("sphere", &ball, 1e-3, &hertz), ("cone", &cone, 1e-3, &sneddon), ("punch", &punch, 1e-4, &flat)];
    for (name, case, deepest, load) in tests {
        let log = Test { deepest, load, frame: 0.0 }.log([0.002; 2], 1);
        let of = |factor: f64| {
            let start = [("lower.substrate.young", factor * 70e3)];
            found(case, &start, &log, &IndentationRequest::default()).unwrap()
        };
        let near = of(1.0).constants[0].value;
        assert!((near / 70e3 - 1.0).abs() < 0.015, "{name}: {near}");
        for factor in [0.01, 0.1, 1.0 / 3.0, 3.0, 10.0, 100.0] {
            let found = of(factor);
            let young = &found.constants[0];
            println!("{name} from {factor}: {} in {} histories", young.value, found.histories);
            assert!(
                young.told && (young.value / near - 1.0).abs() < 1.5e-4,
                "{name} from {factor}: {young:?} {:?}",
                found.notes
            );
        }
    }
}

/// A soft film on a stiff base, whose load is no multiple of its modulus, from a tenth and from ten times: as from near, to the noise's tenth.
#[test]
fn a_film_is_found_from_ten_times_too_soft_or_too_stiff() {
    let deepest = 2e-3;
    let load = of_film(deepest);
    let log = Test { deepest, load: &load, frame: 0.0 }.log([0.002; 2], 1);
    let grid = film(32);
    let case = |values: &[f64]| grid(&[values[0], THICKNESS.1]);
    for factor in [0.1, 1.0, 3.0, 10.0] {
        let start = [(YOUNG.0, factor * YOUNG.1)];
        let found = found(&case, &start, &log, &IndentationRequest::default()).unwrap();
        let young = &found.constants[0];
        println!("film from {factor}: {} in {} histories", young.value, found.histories);
        assert!(
            young.told && (young.value / YOUNG.1 - 1.0).abs() < 0.02,
            "{factor}: {young:?} {:?}",
            found.notes
        );
    }
}

/// Where no point is deeper than a touch that was given, that is said as the log counts it.
#[test]
fn a_touch_beyond_the_deepest_point_is_told_as_the_log_counts_it() {
    let case = |values: &[f64]| sphere(&[values[0], 1.0]);
    let log = Test { deepest: 1e-3, load: &hertz, frame: 0.0 }.log([0.0; 2], 0);
    let turned = log.lines().fold(String::new(), |text, line| {
        text + if line.starts_with(|first: char| first.is_ascii_digit()) { "-" } else { "" } + line + "\n"
    });
    let key = [("lower.substrate.young", 50e3)];
    for (log, touch, shown) in [(&log, 5.0, "5.0"), (&turned, -5.0, "-5.0")] {
        let request = IndentationRequest { touch: Some(touch), ..IndentationRequest::default() };
        let words = refusal_of(&case, log, &key, &request);
        assert!(words.contains(&format!("no point lies deeper than {shown}")), "{words}");
        assert!(words.contains("is the depth at first touch right"), "{words}");
    }
}
