//! Histories in few increments against many: after coarse indentations, on rays, in phase, with pauses. Random ones beside
//! references of 480 increments (`tests/golden/random_histories.json`).

use fret_core::history::History;
use fret_validation::random_histories::{End, RandomHistory};
use fret_validation::{Sphere, by_end_points, run};
use rayon::prelude::*;

/// Energy of the last cycle.
fn last_cycle(history: &History) -> f64 {
    history.cycles.last().unwrap().dissipated_energy
}

/// A rigid sphere on a coating twice as stiff and as thick as the contact radius, pulled to three quarters of what slides.
fn loop_after(pressing: usize) -> String {
    let sphere =
        Sphere { cells: 48, size: 2.6, coating: Some((2.0, 1.0)), friction: 0.3, ..Sphere::default() };
    sphere.pulled(&sphere.pressed(1.0, pressing, "cubic"), 0.75, 64, Some(1))
}

/// The energy of a loop after an indentation of few increments, against one of 256: nearer than by end points, which leave 0.96 % of it at 8 and
/// 0.69 % at 16 (of which 0.5 % are those of their loop), and falling.
#[test]
fn a_loop_after_a_coarse_indentation_is_near() {
    let cases = [256, 8, 16, 24].map(loop_after);
    let energies: Vec<f64> = cases.par_iter().map(|case| last_cycle(&run(case).unwrap())).collect();
    let off: Vec<f64> = energies[1..].iter().map(|energy| energy / energies[0] - 1.0).collect();
    println!("{off:?}");
    assert!(off[0].abs() < 9e-3 && off[1].abs() < 4e-3 && off[2].abs() < 2e-3, "{off:?}");
}

/// Elastically similar spheres without a Poisson effect whose forces grow together from nothing stick, and `shift = l mu approach`, whatever the cells: tangential
/// and normal response are the same. More increments err less, down to a thousandth.
#[test]
fn a_ray_from_nothing_errs_less_with_more_increments() {
    let friction = 0.3;
    for part in [0.3, 0.6] {
        let off = |increments: usize| {
            let sphere = Sphere { size: 2.2, poisson: 0.0, identical: true, friction, ..Sphere::default() };
            let text = format!(
                "{}[[load]]\nnormal_force = {:e}\ntangential_force = [{:e}, 0.0]\nincrements = {increments}\nramp = \"cubic\"\n",
                sphere.head(),
                sphere.force(),
                part * friction * sphere.force()
            );
            let history = run(&text).unwrap();
            let last = history.steps.last().unwrap();
            last.shift[0] / (part * friction * last.approach) - 1.0
        };
        let counts = [16, 32, 48, 64, 96];
        let errors: Vec<f64> = counts.par_iter().map(|count| off(*count).abs()).collect();
        println!("{part}: {errors:?}");
        // By end points 4.0e-2, 2.1e-2, 1.5e-2, 1.1e-2, 7.7e-3 with the smaller force.
        assert!(errors[0] < 8e-3 && errors[1..].iter().all(|error| *error < 2.5e-3), "{errors:?}");
        // From 64 increments on the edge moves by half a cell in each, and what is left, 1.0e-3 and 5e-4, no longer falls: it is of the moments at
        // which single cells are found to touch. None grows by more than a fifth.
        assert!(errors.windows(2).all(|pair| pair[1] < 1.2 * pair[0]), "{errors:?}");
    }
}

/// Normal and tangential force that swing together, the cycle of a dovetail: a rigid sphere or cylinder, P (1 +- 0.2) and Q +- 0.3 mu P.
fn in_phase(is_line: bool, [poisson, friction]: [f64; 2], increments: usize) -> String {
    let pressing = if is_line { 240 } else { 120 };
    let cells = if is_line { 96 } else { 32 };
    let sphere = Sphere { cells, size: 2.7, poisson, friction, tolerance: 1e-9, ..Sphere::default() };
    let (head, force) = if is_line {
        let force = std::f64::consts::PI * sphere.effective_modulus() / 400.0;
        let head = sphere.head().replace("cells = [96, 96]\nsize = [2.7e0, 2.7e0]", "cells = 96\nsize = 2.9");
        (
            head.replace(
                "[profile.sphere]\nradius = 1e2",
                "[profile.cylinder]\nradius = 100.0\naxis = \"y\"",
            ),
            force,
        )
    } else {
        (sphere.head(), sphere.force())
    };
    format!(
        "{head}[[load]]\nnormal_force = {force:e}\nincrements = {pressing}\nramp = \"cubic\"\n\
         [[load]]\nnormal_force = {:e}\ntangential_force = [{:e}, 0.0]\ncycles = 2\nincrements = {increments}\nwaveform = \"sine\"\n",
        0.2 * force,
        0.3 * friction * force
    )
}

/// Both forces in phase: the error of the second cycle's energy against 480 increments is below that of end points, or below 1.3, 0.9, 0.2 % with 12,
/// 24, 48 increments: where that of end points changes its sign it is smaller. Before the entry was taken from the normal load, and nothing
/// across its turn, these were 4.5, 1.9, 0.4 %.
#[test]
#[ignore = "long: a minute"]
fn forces_in_phase_err_by_a_percent_or_less_than_by_end_points() {
    let kinds = [
        (true, [0.45, 0.3]),
        (true, [0.3, 0.3]),
        (false, [0.45, 0.3]),
        (false, [0.3, 0.3]),
        (false, [0.3, 0.1]),
    ];
    let mut above = Vec::new();
    for (is_line, numbers) in kinds {
        let counts: &[usize] = &[480, 12, 24, 48];
        let energies = |ends: bool| -> Vec<f64> {
            let case = |count: &usize| {
                let text = in_phase(is_line, numbers, *count);
                if ends { by_end_points(&text) } else { text }
            };
            counts.par_iter().map(|count| last_cycle(&run(&case(count)).unwrap())).collect()
        };
        let (second, ends) = (energies(false), energies(true));
        let errors =
            |found: &[f64]| found[1..].iter().map(|energy| energy / second[0] - 1.0).collect::<Vec<_>>();
        let (errors, by_end_points) = (errors(&second), errors(&ends));
        println!(
            "{is_line} {numbers:?}: {errors:.5?}, by end points {by_end_points:.5?}, limits apart {:.1e}",
            ends[0] / second[0] - 1.0
        );
        for (at, (error, other)) in errors.iter().zip(by_end_points).enumerate() {
            let bound = [1.3e-2, 9e-3, 2e-3][at];
            if error.abs() > f64::max(other.abs(), bound) {
                above.push((is_line, numbers, *error, other));
            }
        }
    }
    assert!(above.is_empty(), "{above:?}");
}

/// Increments in which nothing changes, between others: they change nothing, neither what they leave nor what comes after.
#[test]
fn pauses_change_nothing() {
    let sphere = Sphere { cells: 32, size: 2.6, friction: 0.3, tolerance: 1e-11, ..Sphere::default() };
    let force = sphere.force();
    let to = |x: f64, y: f64, increments: usize| {
        format!(
            "[[load]]\ntangential_force = [{:e}, {:e}]\nincrements = {increments}\n",
            x * force,
            y * force
        )
    };
    for end in [to(0.2, 0.0, 3), to(0.15, 0.08, 3), to(0.0, 0.0, 3)] {
        let pressed = sphere.pressed(1.0, 8, "cubic");
        let with = |pause: &str| run(&format!("{pressed}{}{pause}{end}", to(0.1, 0.0, 3))).unwrap();
        let (straight, paused) = (with(""), with(&to(0.1, 0.0, 2)));
        let (a, b) = (straight.steps.last().unwrap(), paused.steps.last().unwrap());
        assert!((b.dissipated_energy / a.dissipated_energy - 1.0).abs() < 1e-9);
        assert!(
            (b.shift[0] - a.shift[0]).hypot(b.shift[1] - a.shift[1]) < 1e-9 * a.shift[0].hypot(a.shift[1])
        );
        let off = straight.state.shear.iter().flatten().zip(paused.state.shear.iter().flatten());
        let off = off.fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()));
        assert!(off < 1e-9 * b.max_pressure, "{off:e}");
        // Before and in the pause.
        let [before, during] = [10, 12].map(|increment| &paused.steps[increment]);
        assert_eq!((before.stick_cells, before.regime), (during.stick_cells, during.regime));
        assert!((during.dissipated_energy - before.dissipated_energy).abs() < 1e-12 * a.dissipated_energy);
    }
}

/// Seed and number (energy, shift, shear) of the one that is more than twice as far as by end points, whose error changes its sign there: 2.2 times.
const TWICE: (u64, usize) = (7, 0);

/// A dozen histories in 24 increments a cycle beside references of 480, which both rules find alike: half of the energies are off by less than half
/// of what end points leave, half of the shifts by less than 0.8 of it, and no number but one is twice as far and above 0.2 % (of those of 198
/// histories one in sixty is). Over 198 histories the
/// medians are as on the page; the shear of lines, half of the shears here, gains little.
#[test]
fn random_histories_are_nearer_than_by_end_points() {
    let text = include_str!("golden/random_histories.json");
    let golden: serde_json::Value = serde_json::from_str(text).unwrap();
    let rows = golden["histories"].as_array().unwrap();
    let found: Vec<(u64, [f64; 3], [f64; 3])> = rows
        .par_iter()
        .map(|row| {
            let seed = row["seed"].as_u64().unwrap();
            let history = RandomHistory::drawn(seed);
            let right: End = serde_json::from_value(row["end"].clone()).unwrap();
            let text = history.text(24);
            let errors =
                [text.clone(), by_end_points(&text)].map(|text| End::of(&run(&text).unwrap()).off(&right));
            (seed, errors[0], errors[1])
        })
        .collect();
    let mut ratios = [const { Vec::new() }; 3];
    for (seed, errors, ends) in &found {
        println!("{seed}: {errors:.5?}, by end points {ends:.5?}");
        for quantity in 0..3 {
            let [error, end] = [errors[quantity].abs(), ends[quantity].abs()];
            let bound = if (*seed, quantity) == TWICE { 2.5 } else { 2.0 };
            assert!(error <= (bound * end).max(2e-3), "{seed}: {error:e}, by end points {end:e}");
            ratios[quantity].push(error / end);
        }
    }
    for (ratios, bound) in ratios[..2].iter_mut().zip([0.5, 0.8]) {
        ratios.sort_by(f64::total_cmp);
        let median = 0.5 * (ratios[5] + ratios[6]);
        assert!(median < bound, "{median}");
    }
}
