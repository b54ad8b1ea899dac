//! The order of histories in the increments: against the limit of many increments on the same grid, which both rules have in common.

use fret_core::history::History;
use fret_validation::{Sphere, by_end_points, run, solved};

const FINEST: usize = 256;

/// A case for a number of increments.
type Case<'a> = Box<dyn Fn(usize) -> String + 'a>;

/// A rigid sphere on a coating twice as stiff and as thick as the contact radius, indented in 40 increments, then one cycle.
fn cycle(controls: &str, more: &str, increments: usize) -> String {
    let sphere =
        Sphere { cells: 32, size: 2.6, coating: Some((2.0, 1.0)), friction: 0.3, ..Sphere::default() };
    let pressed = sphere.pressed(1.0, 40, "cubic").replace("[[load]]", &format!("{more}[[load]]"));
    format!("{pressed}[[load]]\n{controls}cycles = 1\nincrements = {increments}\n")
}

/// The force that slides, of those spheres.
fn sliding() -> f64 {
    0.3 * Sphere::default().force()
}

/// A line contact of 128 cells, indented and pulled.
fn line(increments: usize) -> String {
    let force = std::f64::consts::PI * 0.01 / 0.91 / 4.0;
    format!(
        "[grid]\ncells = 128\nsize = 2.6\n[upper]\nrigid = true\n[lower]\nsubstrate = {{ young = 1.0, poisson = 0.3 }}\n\
         [profile.cylinder]\nradius = 100.0\naxis = \"y\"\n[friction]\ncoefficient = 0.3\n[solver]\ntolerance = 1e-8\n\
         [[load]]\nnormal_force = {force:e}\nincrements = 40\nramp = \"cubic\"\n\
         [[load]]\ntangential_force = [{:e}, 0.0]\ncycles = 1\nincrements = {increments}\n",
        0.21 * force
    )
}

/// What friction dissipated in the last stage, or what wore.
fn over_the_cycle(history: &History, worn: bool) -> f64 {
    let steps = &history.steps;
    let last = steps.last().unwrap();
    let before = steps.iter().rfind(|step| step.stage != last.stage).unwrap();
    if worn {
        last.worn_volume - before.worn_volume
    } else {
        last.dissipated_energy - before.dissipated_energy
    }
}

/// Turning slip, torsion with a pull, a normal force that swings a quarter of a cycle ahead, wear, a line contact: from 16 to 64 increments in
/// the cycle the error of the second-order rule falls with the power 1.5 at least (two halvings: eightfold; 2 where only the turn
/// counts, less where slip stops, whose moments are known on average), and ends below a third of that of end points.
#[test]
fn histories_of_every_kind_are_of_second_order() {
    let force = sliding();
    let sine = "waveform = \"sine\"\n";
    let pull = format!("tangential_force = [{:e}, 0.0]\n", 0.4 * force);
    let torsion = format!("{pull}twist_moment = {:e}\nphase = {{ twist_moment = 90 }}\n{sine}", 0.15 * force);
    let swinging = format!("{pull}normal_force = {force:e}\nphase = {{ normal_force = 90 }}\n{sine}");
    let worn = format!("tangential_force = [{:e}, 0.0]\n", 0.7 * force);
    let histories: [(&str, Case<'_>); 4] = [
        ("torsion and pull", Box::new(|n| cycle(&torsion, "", n))),
        ("normal and tangential force", Box::new(|n| cycle(&swinging, "", n))),
        ("wear", Box::new(|n| cycle(&worn, "[wear]\ncoefficient = 0.3\n", n))),
        ("line contact", Box::new(line)),
    ];
    for (name, case) in histories {
        let found = |increments: usize, integration: &str| {
            let rule = format!("[solver]\nintegration = \"{integration}\"\n");
            let history = run(&case(increments).replace("[solver]\n", &rule)).unwrap();
            over_the_cycle(&history, name == "wear")
        };
        let limit = found(FINEST, "second_order");
        let error =
            |increments: usize, integration: &str| (found(increments, integration) / limit - 1.0).abs();
        let [coarse, fine] = [16, 64].map(|increments| error(increments, "second_order"));
        let by_end_points = error(64, "end_point");
        let order = (coarse / fine).log2() / 2.0;
        println!("{name}: {coarse:.1e} {fine:.1e}, order {order:.2}; by end points {by_end_points:.1e}");
        assert!(order > 1.5, "{name}: order {order}");
        assert!(fine < by_end_points / 3.0, "{name}: {fine:e} against {by_end_points:e}");
    }
}

/// Like spheres under forces that grow together from nothing stick, and the shift is known: each part of the force finds the contact that there is
/// (Mindlin & Deresiewicz 1953), the radius going with its third root. A linear ramp makes the greater part of the contact in its first increment,
/// which is solved in four parts: -1.6 %; as a whole it left -5.7 %. The cells leave a tenth of a per cent.
#[test]
fn forces_that_grow_evenly_from_nothing_find_their_shift() {
    let sphere = Sphere { identical: true, friction: 0.3, ..Sphere::default() };
    let force = 0.3 * 0.3 * sphere.force();
    let text = format!(
        "{}[[load]]\nnormal_force = {:e}\ntangential_force = [{force:e}, 0.0]\nincrements = 16\n",
        sphere.head(),
        sphere.force()
    );
    let exact = 1.5 * force / (8.0 * sphere.effective_shear_modulus());
    let off = |text: &str| solved(text).steps.last().unwrap().shift[0] / exact - 1.0;
    let (parts, ends) = (off(&text), off(&by_end_points(&text)));
    println!("shift {parts:.4}, by end points {ends:.4}");
    assert!(parts.abs() < 0.02, "{parts}");
    assert!(ends < -0.05, "{ends}");
    assert_eq!(solved(&text).steps[0].parts, 4);
}

/// A quarter of the way to an approach friction bears an eighth of what it bears at the end, and a force that grows evenly asks for a quarter: where
/// a part asks for too much the whole increment is solved; and it is where the stage has seven.
#[test]
fn a_first_touch_whose_parts_have_no_solution_is_solved_as_a_whole() {
    let sphere = Sphere { cells: 32, friction: 0.3, ..Sphere::default() };
    let pressed = |increments: usize, share: f64| {
        let first = (increments as f64).powf(-1.5) * 0.3 * sphere.force();
        let text = format!(
            "{}[[load]]\napproach = {:e}\ntangential_force = [{:e}, 0.0]\nincrements = {increments}\n",
            sphere.head(),
            sphere.approach(),
            share * first * increments as f64
        );
        solved(&text).steps[0].parts
    };
    assert_eq!([pressed(10, 0.05), pressed(10, 0.4), pressed(7, 0.05)], [4, 1, 1]);
}
