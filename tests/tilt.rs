//! Tilt of the upper body: prescribed, and by the moment of the pressure, against closed forms and itself.

use std::fmt::Write as _;
use std::ops::ControlFlow;

use fret_core::analytic::{EffectiveModuli, TiltedLinePunch, TiltedPunch};
use fret_core::case::Case;
use fret_core::history::{History, KeptFields, StepRecord};
use fret_core::model::{ElasticMaterial, MirroredState};
use fret_core::plan::Plan;
use fret_core::run::{Checkpoint, Observer, RunError, Silent, Simulation, Waypoint};
use fret_validation::certifier::run_certified;
use fret_validation::run;

const BODY: &str = "[upper]\nrigid = true\n[lower]\nsubstrate = { young = 1.0, poisson = 0.3 }\n";

fn modulus() -> f64 {
    EffectiveModuli::rigid_on(&ElasticMaterial::new(1.0, 0.3).unwrap()).normal
}

fn pressure(history: &History) -> &ndarray::Array2<f64> {
    history.fields.last().unwrap().pressure.as_ref().unwrap()
}

/// A parabola touches `R theta` to the side with the same pressure, under the moment `P R theta`.
#[test]
fn a_tilted_parabola_touches_to_the_side() {
    // Five cells of 1e-3 for a radius of 2.
    let slope = 5e-3 / 2.0;
    let line = |tilt: &str| {
        let text = format!(
            "[grid]\ncells = 64\nsize = 6.4e-2\n{BODY}[profile.cylinder]\nradius = 2.0\naxis = \"y\"\n[solver]\n\
             tolerance = 1e-11\n[[load]]\nnormal_force = 1e-4\n{tilt}increments = 1\n"
        );
        run(&text).unwrap()
    };
    let sphere = |tilt: &str| {
        let text = format!(
            "[grid]\ncells = [40, 40]\nsize = [4e-2, 4e-2]\n{BODY}[profile.sphere]\nradius = 2.0\n[solver]\n\
             tolerance = 1e-11\n[[load]]\nnormal_force = 1e-6\n{tilt}increments = 1\n"
        );
        run(&text).unwrap()
    };
    let pairs = vec![
        (line(""), line(&format!("tilt = {slope:e}\n")), [5, 0], 1e-4),
        (line(""), line(&format!("tilt_moment = {:e}\n", 1e-4 * 5e-3)), [5, 0], 1e-4),
        (sphere(""), sphere(&format!("tilt = [{:e}, 0.0]\n", -slope)), [-5, 0], 1e-6),
        (
            sphere(""),
            sphere(&format!("tilt_moment = [{:e}, {:e}]\n", 1e-6 * 2e-3, -1e-6 * 5e-3)),
            [2, -5],
            1e-6,
        ),
    ];
    for (level, tilted, cells, force) in pairs {
        let (a, b) = (pressure(&level), pressure(&tilted));
        let peak = level.steps[0].max_pressure;
        for ((i, j), p) in a.indexed_iter().filter(|(_, p)| **p > 0.0) {
            let at = [i as isize + cells[0], j as isize + cells[1]].map(|at| at as usize);
            // Both are solved to 1e-11; a moment to 1e-11 of the force times the radius of gyration.
            assert!((b[at] - p).abs() < 1e-8 * peak, "{cells:?} {i} {j}: {} {p}", b[at]);
        }
        let step = &tilted.steps[0];
        for axis in 0..2 {
            let shift = cells[axis] as f64 * 1e-3;
            assert!((step.tilt_moment[axis] / force - shift).abs() < 1e-9 * 1e-2, "{:?}", step.tilt_moment);
            assert!((step.tilt[axis] * 2.0 - shift).abs() < 1e-8 * 1e-2, "{:?}", step.tilt);
        }
        // Lowest point of the tilted parabola: R theta^2 / 2 below the middle.
        let lower = step.tilt.iter().map(|tilt| 2.0 * tilt * tilt / 2.0).sum::<f64>();
        assert!((step.approach + lower - level.steps[0].approach).abs() < 1e-8 * level.steps[0].approach);
    }
}

/// `M = (pi/4) E* a^2 theta` in full contact. The edge of the punch lies on an edge of cells; the pressure there is singular.
#[test]
fn a_tilted_flat_punch_on_a_line_is_as_stiff_as_its_closed_form() {
    let errors = [64, 256].map(|cells| {
        let text = |load: &str| {
            format!(
                "[grid]\ncells = {cells}\nsize = 4.0\n{BODY}[profile.flat_punch]\nradius = 1.0\n[[load]]\n\
                 normal_force = 1e-3\n{load}increments = 1\n"
            )
        };
        let slope = 4e-4;
        let exact = TiltedLinePunch::new(1.0, 1e-3, modulus(), slope).unwrap();
        let tilted = run(&text(&format!("tilt = {slope:e}\n"))).unwrap();
        let found = tilted.steps[0].tilt_moment[0];
        let turned = run(&text(&format!("tilt_moment = {found:e}\n"))).unwrap();
        assert!((turned.steps[0].tilt[0] / slope - 1.0).abs() < 1e-6);
        (found / exact.moment - 1.0).abs()
    });
    println!("tilted line punch: moment off {errors:.4?}");
    // First order at the singular edge.
    assert!(errors[1] < 0.01 && errors[1] < errors[0] / 3.0, "{errors:?}");
}

/// `M = (4/3) E* a^3 theta`, about both axes; beyond `M = P a/3` an edge lifts; at `M = P a` there is no equilibrium.
#[test]
fn a_tilted_round_punch_lifts_an_edge_and_then_has_no_equilibrium() {
    let text = |load: &str| {
        format!(
            "[grid]\ncells = [64, 64]\nsize = [2.4, 2.4]\n{BODY}[profile.flat_punch]\nradius = 1.0\n[[load]]\n\
             normal_force = 1e-3\n{load}increments = 1\n"
        )
    };
    let slope = 2e-4;
    let exact = TiltedPunch::new(1.0, 1e-3, modulus(), slope).unwrap();
    for axis in 0..2 {
        let tilt = ["0.0", "0.0"].map(str::to_owned);
        let mut tilt = tilt;
        tilt[axis] = format!("{slope:e}");
        let found = run(&text(&format!("tilt = [{}, {}]\n", tilt[0], tilt[1]))).unwrap();
        let moment = found.steps[0].tilt_moment;
        println!("tilted round punch: moment off {:.1e}", moment[axis] / exact.moment - 1.0);
        // The staircase of the edge: its radius to a seventh of a cell, its cube to three times that; 27 cells.
        assert!((moment[axis] / exact.moment - 1.0).abs() < 0.02, "{moment:?}");
        assert!(moment[1 - axis].abs() < 1e-8 * exact.moment);
    }
    let lifted = run(&text("tilt_moment = [6e-4, 0.0]\n")).unwrap();
    let whole = run(&text("")).unwrap();
    assert!(lifted.steps[0].contact_cells < whole.steps[0].contact_cells * 9 / 10);
    assert!((lifted.steps[0].tilt_moment[0] - 6e-4).abs() < 1e-11);
    let none = run(&text("tilt_moment = [1.01e-3, 0.0]\n"));
    assert!(matches!(none, Err(RunError::NoTilt { .. })), "{none:?}");
}

/// A dovetail's cycle: normal and tangential force, moment and bulk stress together, of bodies unlike and coated.
fn dovetail(grid: &str, profile: &str, axes: bool) -> String {
    let pair = |x: f64| if axes { format!("[{x:e}, {:e}]", 0.4 * x) } else { format!("{x:e}") };
    let force = if axes { 1e-6 } else { 1e-4 };
    let radius = 1.3e-2;
    let scale = if axes { force / (radius * radius) } else { force / radius };
    let mut text = format!(
        "[grid]\n{grid}\n[upper]\nsubstrate = {{ young = 2.0, poisson = 0.2 }}\n[lower]\n\
         coatings = [{{ thickness = 5e-3, young = 3.0, poisson = 0.25 }}]\nsubstrate = {{ young = 1.0, poisson = 0.3 }}\n\
         [profile.{profile}\n[friction]\ncoefficient = 0.4\n[solver]\ntolerance = 1e-10\nintegration = \"end_point\"\n"
    );
    let _ = write!(
        text,
        "[[load]]\nnormal_force = {force:e}\nincrements = 2\n[[load]]\ncycles = 2\nincrements = 8\nwaveform = \"sine\"\n\
         normal_force = {:e}\ntangential_force = [{:e}, 0.0]\ntilt_moment = {}\nbulk_stress = {}\n",
        0.3 * force,
        0.15 * force,
        pair(0.2 * force * radius),
        pair(0.3 * scale)
    );
    text
}

#[test]
fn a_dovetails_cycle_holds_every_law_and_the_balance_of_energy() {
    let line = dovetail("cells = 72\nsize = 5.4e-2", "cylinder]\nradius = 1.0\naxis = \"y\"", false);
    let plane = dovetail("cells = [24, 24]\nsize = [5.4e-2, 5.4e-2]", "sphere]\nradius = 1.0", true);
    for text in [line, plane] {
        let ended = run_certified(&text, &[]).unwrap();
        assert!(ended.error.is_none(), "{:?}", ended.error);
        assert_eq!(ended.wrong(), None);
        let balance = ended.certificates.iter().fold(0.0_f64, |worst, found| worst.max(found.balance));
        println!("dovetail: balance of energy {balance:.1e}");
        assert!(balance < 1e-7);
    }
}

/// Tilts are found with all other motions: an increment under a prescribed moment takes about what it takes without.
#[test]
fn a_prescribed_moment_costs_hardly_more_than_none() {
    let line = dovetail("cells = 72\nsize = 5.4e-2", "cylinder]\nradius = 1.0\naxis = \"y\"", false);
    let plane = dovetail("cells = [32, 32]\nsize = [5.4e-2, 5.4e-2]", "sphere]\nradius = 1.0", true);
    for text in [line, plane] {
        let level: String = text
            .lines()
            .filter(|line| !line.starts_with("tilt_moment"))
            .map(|line| line.to_owned() + "\n")
            .collect();
        let [tilted, level] = [text, level]
            .map(|text| run(&text).unwrap().steps.iter().map(|step| step.work.convolutions).sum::<usize>());
        println!("applications: {tilted} with moments, {level} without");
        assert!(10 * tilted < 13 * level);
    }
}

/// The contact of a sphere moves by five of its radii in one increment, as the moment asks.
#[test]
fn a_contact_follows_a_large_moment() {
    let text = format!(
        "[grid]\ncells = [96, 96]\nsize = [9.6e-2, 9.6e-2]\n{BODY}[profile.sphere]\nradius = 2.0\n[solver]\n\
         tolerance = 1e-9\n[[load]]\nnormal_force = 1e-7\nincrements = 1\n[[load]]\ntilt_moment = [{:e}, {:e}]\nincrements = 1\n",
        1e-7 * 2.5e-2,
        -1e-7 * 1e-2
    );
    let history = run(&text).unwrap();
    let [first, moved] = [&history.steps[0], &history.steps[1]];
    // By whole cells, 25 and -10 of them: the same contact elsewhere.
    assert!((moved.max_pressure / first.max_pressure - 1.0).abs() < 1e-7, "{moved:?}");
    assert!((moved.tilt[0] * 2.0 - 2.5e-2).abs() < 1e-9 && (moved.tilt[1] * 2.0 + 1e-2).abs() < 1e-9);
}

struct Keeper(Vec<Vec<u8>>);

impl Observer for Keeper {
    fn reached(&mut self, waypoint: &Waypoint<'_>) -> ControlFlow<()> {
        let mut bytes = Vec::new();
        waypoint.write(&mut bytes).unwrap();
        self.0.push(bytes);
        ControlFlow::Continue(())
    }

    fn solved(&mut self, _: &StepRecord, _: MirroredState<'_>, _: Option<&KeptFields>) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}

#[test]
fn a_tilted_and_stretched_run_is_resumed_with_the_same_bits() {
    let text = dovetail("cells = [24, 24]\nsize = [5.4e-2, 5.4e-2]", "sphere]\nradius = 1.0", true);
    let plan = Plan::new(Case::from_toml(&text, "case.toml").unwrap()).unwrap();
    let mut keeper = Keeper(Vec::new());
    let whole = Simulation::new(&plan).run(&mut keeper).unwrap();
    for reached in [1, 5, 11] {
        let checkpoint = Checkpoint::read(&keeper.0[reached], &plan).unwrap();
        let rest = Simulation::new(&plan).resume(checkpoint, &mut Silent).unwrap();
        assert_eq!(rest.state, whole.state, "from increment {reached}");
    }
}

#[test]
fn tilt_and_bulk_stress_without_a_meaning_are_refused() {
    let case = |head: &str, load: &str| {
        format!(
            "[grid]\n{head}\n[upper]\nrigid = true\n[lower]\ncoatings = [{{ thickness = 1.0, young = 1.0, poisson = 0.3 }}]\n\
             base = \"rigid\"\n[profile.cylinder]\nradius = 1.0\naxis = \"y\"\n[[load]]\nnormal_force = 1e-4\n{load}\nincrements = 1\n"
        )
    };
    let line = "cells = 64\nsize = 0.06";
    for (head, load, words) in [
        (line, "bulk_stress = 1.0", "rigid base"),
        (line, "upper_bulk_stress = 1.0", "this body is rigid"),
        (line, "tilt = [1e-3, 0.0]", "two values in a line contact"),
        (line, "tilt = 1e-3\ntilt_moment = 1e-6", "both at once"),
        (line, "tilt = inf", "must be finite"),
        ("cells = 64\nsize = \"auto\"", "tilt = 1e-3", "moves sideways"),
        (
            "cells = [16, 4]\nsize = [0.06, 0.06]\nperiodic = true",
            "tilt = [1e-3, 0.0]",
            "neither a strain nor a tilt",
        ),
        ("cells = [16, 16]\nsize = [0.06, 0.06]", "tilt = 1e-3", "has two axes"),
    ] {
        let error = Case::from_toml(&case(head, load), "case.toml").unwrap_err();
        assert!(error.to_string().contains(words), "{load}: {error}");
    }
}
