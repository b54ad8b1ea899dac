//! Increments at which active sets wander: membranes on incompressible layers with friction near 1, stiff wavy films that are pressed
//! flat, contact that nearly fills its period. All of them have solutions; each is found and certified.

use fret_validation::certifier::{Ended, run_certified};
use fret_validation::{Sphere, run};

/// A rigid sphere of radius 100 on coatings `(E, nu, thickness)`; an overlap of 0.01 has a contact of 1.4 at the most.
struct Membrane {
    cells: usize,
    coatings: Vec<[f64; 3]>,
    /// `E, nu`; a rigid base where there is none.
    substrate: Option<[f64; 2]>,
    friction: f64,
}

/// Overlap of the undeformed bodies.
const APPROACH: f64 = 0.01;

impl Membrane {
    /// Pressed by its approach, shifted obliquely, shifted to another direction, lifted a little: nine increments.
    fn pressed_shifted_lifted(&self) -> Ended {
        let Self { cells, friction, .. } = self;
        let coatings: Vec<String> = self
            .coatings
            .iter()
            .map(|[young, poisson, thickness]| {
                format!("{{ thickness = {thickness}, young = {young:e}, poisson = {poisson} }}")
            })
            .collect();
        let below = self.substrate.map_or("base = \"rigid\"".to_owned(), |[young, poisson]| {
            format!("substrate = {{ young = {young:e}, poisson = {poisson} }}")
        });
        let mut text = format!(
            "[grid]\ncells = [{cells}, {cells}]\nsize = [6.4, 6.4]\n[upper]\nrigid = true\n[lower]\ncoatings = [{}]\n{below}\n\
             [profile.sphere]\nradius = 100.0\n[friction]\ncoefficient = {friction}\n",
            coatings.join(", ")
        );
        let slides = friction * APPROACH;
        for (controls, increments) in [
            (format!("approach = {APPROACH:e}"), 3),
            (format!("shift = [{:e}, {:e}]", 0.6 * slides, 0.3 * slides), 2),
            (format!("shift = [{:e}, {:e}]", 0.2 * slides, -0.5 * slides), 2),
            (format!("approach = {:e}", 0.8 * APPROACH), 2),
        ] {
            text += &format!("[[load]]\n{controls}\nincrements = {increments}\n");
        }
        run_certified(&text, &[]).unwrap_or_else(|error| panic!("{error}"))
    }
}

/// Checks that a run went to its end and holds all laws. What it took, in words.
fn certified(name: &str, ended: &Ended) -> String {
    assert!(ended.error.is_none(), "{name}: {:?}", ended.error);
    assert_eq!(ended.wrong(), None, "{name}");
    let count = |value: fn(&fret_core::history::StepRecord) -> usize| {
        ended.run.iter().map(|kept| value(&kept.record)).sum::<usize>()
    };
    let contact = ended.run.iter().map(|kept| kept.record.contact_cells).max().unwrap_or(0);
    format!(
        "{name}: up to {contact} cells in contact, {} applications, {} steps of iterates that need not be feasible, {} of {} increments in parts",
        count(|step| step.work.convolutions),
        count(|step| step.work.augmented_steps),
        ended.run.iter().filter(|kept| kept.record.parts > 1).count(),
        ended.run.len()
    )
}

/// Three coatings on a rigid base: 6e11, 1e6 with nu = 0.5, 3e7.
fn three_coatings(film: f64, soft: f64, below: f64) -> Ended {
    Membrane {
        cells: 40,
        coatings: vec![[6e11, 0.3, film], [1e6, 0.5, soft], [3e7, 0.3, below]],
        substrate: None,
        friction: 0.78,
    }
    .pressed_shifted_lifted()
}

/// 4.7e3 with nu = 0.5 on 0.13, on a thick stiff layer.
fn on_a_stiff_layer(film: f64, soft: f64, friction: f64) -> Ended {
    Membrane {
        cells: 32,
        coatings: vec![[4.7e3, 0.5, film], [0.13, 0.3, soft], [6.8e5, 0.3, 30.0]],
        substrate: Some([1.9e4, 0.5]),
        friction,
    }
    .pressed_shifted_lifted()
}

#[test]
fn a_membrane_on_an_incompressible_layer_is_certified() {
    println!("{}", certified("three coatings", &three_coatings(0.01, 0.3, 0.3)));
    println!("{}", certified("on a stiff layer", &on_a_stiff_layer(0.01, 0.3, 1.28)));
}

#[test]
#[ignore = "long: 20 s"]
fn membranes_of_every_thickness_are_certified() {
    for film in [0.003, 0.01, 0.03, 0.1, 0.3] {
        for soft in [0.03, 0.1, 0.3, 1.0, 3.0] {
            for below in [0.1, 1.0] {
                let name = format!("three coatings of {film}, {soft}, {below}");
                println!("{}", certified(&name, &three_coatings(film, soft, below)));
            }
            for friction in [0.1, 1.28] {
                let name = format!("{film} on {soft} on a stiff layer, mu {friction}");
                println!("{}", certified(&name, &on_a_stiff_layer(film, soft, friction)));
            }
        }
    }
}

/// A wave of amplitude 1e-3 of its length, pressed against a film `ratio` times as stiff as its substrate.
fn wavy(ratio: f64, thickness: f64, friction: f64, force: f64, increments: usize) -> Ended {
    let text = format!(
        "[grid]\ncells = [32, 32]\nsize = [1.0, 1.0]\nperiodic = true\n[upper]\nrigid = true\n[lower]\n\
         coatings = [{{ thickness = {thickness}, young = {ratio}, poisson = 0.3 }}]\n\
         substrate = {{ young = 1.0, poisson = 0.3 }}\n\
         [profile.wave]\namplitude = 1e-3\nwavelength_x = 1.0\nwavelength_y = 1.0\n\
         [friction]\ncoefficient = {friction}\n[[load]]\nnormal_force = {force:e}\nincrements = {increments}\n"
    );
    run_certified(&text, &[]).unwrap_or_else(|error| panic!("{error}"))
}

/// The force that just closes the gap everywhere: the frictionless pressure of full contact is a mean and a wave.
fn closing_force(ratio: f64, thickness: f64) -> f64 {
    let ended = wavy(ratio, thickness, 0.0, ratio, 1);
    let pressure = ended.run[0].fields.pressure.as_ref().unwrap();
    let (sum, least) =
        pressure.iter().fold((0.0, f64::INFINITY), |(sum, least), p| (sum + p, f64::min(least, *p)));
    sum / pressure.len() as f64 - least
}

/// Pressed in four increments to 1.1 of full contact.
fn pressed_flat(ratio: f64, thickness: f64, friction: f64) -> String {
    let ended = wavy(ratio, thickness, friction, 1.1 * closing_force(ratio, thickness), 4);
    assert_eq!(ended.run.last().unwrap().record.contact_cells, 1024);
    certified(&format!("wavy film, {ratio} : 1, {thickness} thick, mu {friction}"), &ended)
}

#[test]
fn a_stiff_wavy_film_is_pressed_flat_and_certified() {
    println!("{}", pressed_flat(3000.0, 0.01, 0.3));
}

#[test]
#[ignore = "long: 25 s"]
fn forty_two_stiff_wavy_films_are_pressed_flat_and_certified() {
    for ratio in [300.0, 1000.0, 3000.0] {
        for thickness in [0.01, 0.03] {
            for friction in [0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8] {
                println!("{}", pressed_flat(ratio, thickness, friction));
            }
        }
    }
}

/// A steel sphere of 5 mm on a film of 5 um and a polymer: where the film holds, contact is pressed together along its rim.
fn stiff_film(cells: usize, ratio: f64) -> String {
    format!(
        "[grid]\ncells = [{cells}, {cells}]\nsize = \"auto\"\n[upper]\nsubstrate = {{ young = 210e9, poisson = 0.3 }}\n[lower]\n\
         coatings = [{{ thickness = 5e-6, young = {:e}, poisson = 0.25 }}]\nsubstrate = {{ young = 0.2e9, poisson = 0.4 }}\n\
         [profile.sphere]\nradius = 5e-3\n[friction]\ncoefficient = 0.3\n\
         [[load]]\nnormal_force = 20.0\nincrements = 8\nramp = \"cubic\"\n",
        0.2e9 * ratio
    )
}

/// With feasible iterates alone its seventh increment was not solved.
#[test]
fn a_film_five_thousand_times_stiffer_is_certified() {
    let ended = run_certified(&stiff_film(96, 5000.0), &[]).unwrap();
    println!("{}", certified("stiff film, 5000 : 1", &ended));
    assert!(ended.run.iter().all(|kept| kept.record.parts == 1));
}

#[test]
#[ignore = "long: 15 s"]
fn stiff_films_on_fine_grids_are_certified() {
    for (cells, ratio) in [(96, 1000.0), (96, 20000.0), (192, 100.0), (192, 1000.0), (192, 5000.0)] {
        let ended = run_certified(&stiff_film(cells, ratio), &[]).unwrap();
        println!("{}", certified(&format!("stiff film, {ratio} : 1, {cells} cells"), &ended));
    }
}

/// The dearest increment of a stiff film that is pressed, and pulled through a cycle to three quarters of sliding: its work as operator applications
/// on the whole grid, of which the region takes about half.
fn dearest_in_a_cycle(cells: usize, ratio: f64, rule: &str) -> f64 {
    let solver = format!("[solver]\nintegration = \"{rule}\"\n[[load]]");
    let text = stiff_film(cells, ratio).replace("[[load]]", &solver)
        + "[[load]]\ntangential_force = [4.5, 0.0]\ncycles = 1\nincrements = 16\n";
    let history = run(&text).unwrap_or_else(|error| panic!("{error}"));
    history.steps.iter().map(|step| step.work.full_grid_convolutions).fold(0.0, f64::max)
}

/// Long waves are what the way to a solution costs under a stiff film. Where the normal load stays they are found on coarser grids, too, and kept when the
/// start goes over to finer ones. In the region that is at most 106, 169 and 156 applications (140, 173 and 170 before); on 192 cells 187, 236 and 207
/// (236, 285 and 208). Bounds are a fifth above: where cells change what they do in another order, the dearest increment takes a tenth more or less.
#[test]
fn a_stiff_film_is_pulled_through_a_cycle_in_a_bounded_number_of_applications() {
    for (ratio, most) in [(100.0, 63.0), (1000.0, 101.0), (5000.0, 94.0)] {
        for rule in ["second_order", "end_point"] {
            let dearest = dearest_in_a_cycle(96, ratio, rule);
            println!("{ratio} : 1, {rule}: {dearest:.1}");
            assert!(dearest <= most, "{ratio} : 1, {rule}: {dearest}");
        }
    }
}

#[test]
#[ignore = "long: two minutes"]
fn stiff_films_on_fine_grids_are_pulled_through_a_cycle_in_a_bounded_number_of_applications() {
    for (ratio, most) in [(100.0, 112.0), (1000.0, 141.0), (5000.0, 110.0)] {
        for rule in ["second_order", "end_point"] {
            let dearest = dearest_in_a_cycle(192, ratio, rule);
            println!("{ratio} : 1, {rule}: {dearest:.1}");
            assert!(dearest <= most, "{ratio} : 1, {rule}: {dearest}");
        }
    }
}

/// Operator applications per increment.
fn effort(ended: &Ended) -> f64 {
    let count: usize = ended.run.iter().map(|kept| kept.record.work.convolutions).sum();
    count as f64 / ended.run.len() as f64
}

/// The force that closes a wave on the substrate alone, by so much, on a film of 0.05 wavelengths: pressed in three increments, pulled
/// to 0.8 of sliding in four. By end points, with which the 36 times were counted.
fn nearly_full(ratio: f64, pressed: f64) -> Ended {
    let modulus = 1.0 / (1.0 - 0.09);
    let force = pressed * 2.0_f64.sqrt() * std::f64::consts::PI * modulus * 0.01;
    let text = format!(
        "[grid]\ncells = [32, 32]\nsize = [1.0, 1.0]\nperiodic = true\n[upper]\nrigid = true\n[lower]\n\
         coatings = [{{ thickness = 0.05, young = {ratio}, poisson = 0.3 }}]\nsubstrate = {{ young = 1.0, poisson = 0.3 }}\n\
         [profile.wave]\namplitude = 0.01\nwavelength_x = 1.0\nwavelength_y = 1.0\n[friction]\ncoefficient = 0.3\n\
         [solver]\nintegration = \"end_point\"\n\
         [[load]]\nnormal_force = {force:e}\nincrements = 3\n\
         [[load]]\ntangential_force = [{:e}, 0.0]\nincrements = 4\n",
        0.8 * 0.3 * force
    );
    run_certified(&text, &[]).unwrap_or_else(|error| panic!("{error}"))
}

/// In a strip of a period edges are straight and far apart: what serves a stiff pair on squares takes four times as long there. Without it 406
/// applications of 4 rows of 512 cells and 1135 of 2048 (the bounds leave a fifth for other ways of rounding).
#[test]
fn a_stiff_strip_of_a_period_takes_no_more_than_it_did() {
    for (cells, most) in [(512, 490), (2048, 1360)] {
        let depth = 4.0 / f64::from(cells);
        let force = 2.0 * 2.0_f64.sqrt() * std::f64::consts::PI / 0.91 * 0.01 * depth;
        let text = format!(
            "[grid]\ncells = [{cells}, 4]\nsize = [1.0, {depth:e}]\nperiodic = true\n[upper]\nrigid = true\n[lower]\n\
             coatings = [{{ thickness = 0.05, young = 100.0, poisson = 0.3 }}]\nsubstrate = {{ young = 1.0, poisson = 0.3 }}\n\
             [profile.wave]\namplitude = 0.01\nwavelength_x = 1.0\n[friction]\ncoefficient = 0.3\n\
             [[load]]\nnormal_force = {force:e}\nincrements = 3\n[[load]]\ntangential_force = [{:e}, 0.0]\nincrements = 4\n",
            0.24 * force
        );
        let history = run(&text).unwrap_or_else(|error| panic!("{error}"));
        let made: usize = history.steps.iter().map(|step| step.work.convolutions).sum();
        println!("{cells} x 4 cells: {made} applications");
        assert!(made <= most, "{cells} x 4 cells: {made} applications");
    }
}

/// From contact of half the period to all of it.
#[test]
fn contact_that_nearly_fills_its_period_is_certified_in_a_bounded_number_of_iterations() {
    let sphere = Sphere { cells: 32, size: 3.6, friction: 0.3, ..Sphere::default() };
    let text = sphere.pulled(&sphere.pressed(1.0, 3, "linear"), 0.8, 4, None);
    let benign = effort(&run_certified(&text, &[]).unwrap());
    for (ratio, pressed) in [(10.0, 2.0), (100.0, 2.0), (100.0, 4.0), (100.0, 8.0), (1000.0, 8.0)] {
        let ended = nearly_full(ratio, pressed);
        let times = effort(&ended) / benign;
        println!(
            "{}",
            certified(
                &format!("{ratio} : 1, pressed by {pressed}: {times:.1} times the applications"),
                &ended
            )
        );
        // Once 36 times as many; then 9, and direct solves beside them that took the time of 300; now 3.6 at the most.
        assert!(times < 4.0, "{ratio} : 1, pressed by {pressed}: {times}");
    }
}
