//! Loads of cycles are what the case says, whatever the number of increments, and so is what is read from their loops.

use fret_core::history::{CycleRecord, CycleRegime, History, WornTo};
use fret_validation::{Sphere, solved};

const FRICTION: f64 = 0.3;

/// Identical bodies without coupling; their pressure does not care how it was reached.
fn similar(cells: usize) -> Sphere {
    Sphere { cells, size: 2.2, poisson: 0.0, identical: true, friction: FRICTION, ..Sphere::default() }
}

/// A force of 5/18 of mu P, ahead by 30 degrees, from nothing: it runs to +1/4 and -3/4 of its range, in any number of increments. Energy and
/// shift of two cycles follow from Mindlin and Deresiewicz's loop: a branch of range dQ dissipates twice, and moves twice as far as, a first
/// loading to dQ/2, and beyond the range of a branch before it the contact is as after a first loading.
#[test]
fn a_force_ahead_by_a_twelfth_dissipates_the_same_in_any_number_of_increments() {
    let sphere = similar(96);
    let full = FRICTION * sphere.force();
    let g = sphere.effective_shear_modulus();
    let history = |increments: usize| {
        solved(&format!(
            "{}[[load]]\ntangential_force = [{:e}, 0.0]\nincrements = {increments}\ncycles = 2\nwaveform = \"sine\"\n\
             phase = {{ tangential_force = [30, 0] }}\n",
            sphere.pressed(1.0, 1, "linear"),
            5.0 / 18.0 * full
        ))
    };
    // Of a first loading to a force Q = f mu P: a quarter of the energy of a loop between +-Q, and Cattaneo's displacement.
    let energy = |q: f64| {
        let f = q / 18.0;
        0.225 * full * full / g
            * (1.0 - (1.0 - f).powf(5.0 / 3.0) - 5.0 * f / 6.0 * (1.0 + (1.0 - f).powf(2.0 / 3.0)))
    };
    let moved = |q: f64| 3.0 * full / (16.0 * g) * (1.0 - (1.0 - q / 18.0).powf(2.0 / 3.0));
    let exact = 2.0 * energy(2.5) + energy(7.5) + 4.0 * energy(5.0) + 2.0 * energy(3.75);
    let end = 2.0 * moved(3.75) - moved(7.5);
    for increments in [4, 5, 8, 12, 16, 20, 24, 32] {
        let history = history(increments);
        let last = history.steps.last().unwrap();
        let forces = history.steps.iter().skip(1).map(|step| step.tangential_force[0] / full * 18.0);
        let (least, most) = forces.fold((0.0_f64, 0.0_f64), |(least, most), q| (least.min(q), most.max(q)));
        println!(
            "{increments:2} increments: force {least:.4} to {most:.4}, energy {:.4} and shift {:.4} of exact",
            last.dissipated_energy / exact,
            last.shift[0] / end
        );
        // The solver's tolerance.
        assert!((least + 7.5).abs() < 1e-6 && (most - 2.5).abs() < 1e-6, "{increments}: {least} {most}");
        // The grid: slip annuli of 2 to 7 of the 43 cells of the radius. The increments add nothing: 0.9992 and 1.0009 with each number.
        assert!((last.dissipated_energy / exact - 1.0).abs() < 2e-3, "{increments}");
        assert!((last.shift[0] / end - 1.0).abs() < 2e-3, "{increments}");
    }
}

/// The last cycle of a sphere that is moved to and fro by an amplitude.
fn rubbed(sphere: &Sphere, amplitude: f64, increments: usize) -> CycleRecord {
    let text = format!(
        "{}[[load]]\nshift = [{amplitude:e}, 0.0]\nincrements = {increments}\ncycles = 2\n",
        sphere.pressed(1.0, 1, "linear")
    );
    solved(&text).cycles[1].clone()
}

/// Cattaneo and Mindlin's flank between sliding there and back: force left (1 - x)^(3/2) after a fraction x of twice the displacement
/// at which sliding begins.
#[test]
fn width_and_slope_of_a_loop_that_slides_do_not_depend_on_the_increments() {
    let sphere = similar(64);
    let full = FRICTION * sphere.force();
    let onset = 3.0 * full / (16.0 * sphere.effective_shear_modulus());
    for amplitude in [2.5, 5.0, 20.0] {
        let opening = amplitude - 2.0 * (1.0 - 0.5_f64.powf(2.0 / 3.0));
        let stiffness = 1.5 * full / onset;
        for increments in [4, 6, 8, 16, 24, 80] {
            let cycle = rubbed(&sphere, amplitude * onset, increments);
            let found = cycle.stiffness.unwrap() / stiffness;
            println!(
                "{amplitude} {increments}: {:.5} of {opening:.5}, slope {found:.4}",
                cycle.opening / onset
            );
            assert_eq!(cycle.regime, Some(CycleRegime::GrossSlip));
            // The grid, 29 cells per radius: 1e-4 of the displacement at which sliding begins, 2e-4 of the stiffness.
            assert!((cycle.opening / onset - opening).abs() < 3e-4, "{amplitude} {increments}");
            assert!((cycle.sliding_ratio.unwrap() - opening / amplitude).abs() < 3e-4 / amplitude);
            assert!((found - 1.0).abs() < 1e-3, "{amplitude} {increments}: {found}");
        }
    }
}

/// The same loop behind a spring, which is in series with the contact after reversal, and gives the same on both sides at the middle force.
#[test]
fn a_loop_that_slides_is_as_wide_at_the_actuator() {
    let sphere = similar(48);
    let full = FRICTION * sphere.force();
    let onset = 3.0 * full / (16.0 * sphere.effective_shear_modulus());
    let spring = full / onset;
    let text = format!(
        "{}[[load]]\nactuator = [{:e}, 0.0]\nincrements = 12\ncycles = 2\n[rig]\ntangential_stiffness = {spring:e}\n",
        sphere.pressed(1.0, 1, "linear"),
        6.0 * onset
    );
    let cycle = solved(&text).cycles[1].clone();
    let opening = 5.0 - 2.0 * (1.0 - 0.5_f64.powf(2.0 / 3.0));
    // The grid.
    assert!((cycle.opening / onset - opening).abs() < 1e-2, "{} {opening}", cycle.opening / onset);
    // One number, by both ends of the spring.
    assert!((cycle.actuator_sliding_ratio.unwrap() * 6.0 * onset / cycle.opening - 1.0).abs() < 1e-9);
    let [own, both] = [cycle.stiffness.unwrap(), cycle.actuator_stiffness.unwrap()];
    assert!((1.0 / both - 1.0 / own - 1.0 / spring).abs() < 1e-9 / both);
}

/// Bodies that act on each other, and a coating: no closed form; but a loop of few increments is that of many.
#[test]
fn loops_that_slide_are_read_alike_on_coated_and_dissimilar_bodies() {
    let rigid = Sphere { cells: 48, size: 2.4, friction: FRICTION, ..Sphere::default() };
    for sphere in [rigid.clone(), Sphere { coating: Some((3.0, 0.5)), ..rigid }] {
        let amplitude = 3.0 * FRICTION * sphere.approach();
        let fine = rubbed(&sphere, amplitude, 240);
        for increments in [8, 16, 40] {
            let found = rubbed(&sphere, amplitude, increments);
            let [width, slope] =
                [found.opening / fine.opening, found.stiffness.unwrap() / fine.stiffness.unwrap()];
            println!("{increments}: width {width:.5}, slope {slope:.4}");
            // The shape of the flank, which is a power nearly; its length and area are those of the contact.
            assert!(
                (width - 1.0).abs() < 3e-3 && (slope - 1.0).abs() < 0.05,
                "{increments}: {width} {slope}"
            );
        }
    }
}

/// `McColl`, Ding and Leen's cylinder (2004, Wear 256, 1114): 18.5 N/mm, a stroke of 25 um either way. By chords between increments the
/// half-width is 0.021875 mm in 16 increments, 0.024219 in 64 and 0.0246839 in 6400.
#[test]
fn the_loop_of_a_sliding_cylinder_is_as_wide_in_few_increments_as_in_many() {
    let cycle = |increments: usize| {
        let text = format!(
            "grid = {{ cells = 128, size = 0.3 }}\nupper = {{ substrate = {{ young = 200e3, poisson = 0.3 }} }}\n\
             lower = {{ substrate = {{ young = 200e3, poisson = 0.3 }} }}\nprofile = {{ cylinder = {{ radius = 6.0, axis = \"y\" }} }}\n\
             friction = {{ coefficient = 0.8 }}\n[[load]]\nnormal_force = 18.5\nincrements = 1\n\
             [[load]]\nshift = [0.025, 0.0]\nincrements = {increments}\ncycles = 2\n"
        );
        solved(&text).cycles[1].clone()
    };
    let fine = cycle(800);
    println!("800 increments: {:.6} {:.6e}", fine.opening, fine.stiffness.unwrap());
    assert!((fine.opening - 0.024_683_9).abs() < 1e-6, "{}", fine.opening);
    for increments in [4, 8, 16, 32, 64, 128] {
        let found = cycle(increments);
        println!("{increments} increments: {:.6} {:.6e}", found.opening, found.stiffness.unwrap());
        // A power is not quite the flank of a line contact, whose logarithm it takes the place of.
        assert!((found.opening / fine.opening - 1.0).abs() < 1e-4, "{increments}: {}", found.opening);
        assert!((found.stiffness.unwrap() / fine.stiffness.unwrap() - 1.0).abs() < 0.02, "{increments}");
    }
}

/// A ball on a film that wears through under it, with and without the key that ends the run there.
fn worn(end: &str, cycles: usize) -> History {
    solved(&format!(
        "[units]\nlength = \"mm\"\nforce = \"N\"\n[grid]\ncells = [32, 32]\nsize = [0.8, 0.8]\n\
         [upper]\nsubstrate = {{ young = 210e3, poisson = 0.3 }}\n\
         [lower]\ncoatings = [{{ thickness = 3e-3, young = 420e3, poisson = 0.25, wear_coefficient = 1e-7 }}]\n\
         substrate = {{ young = 210e3, poisson = 0.3, wear_coefficient = 1e-7 }}\n[profile.sphere]\nradius = 5.0\n\
         [friction]\ncoefficient = 0.6\n[wear]\nlaw = \"archard\"\ntolerance = 0.05\n{end}\n\
         [[load]]\nnormal_force = 50.0\nincrements = 6\nramp = \"cubic\"\n\
         [[load]]\nname = \"rub\"\nshift = [4e-3, 0.0]\ncycles = {cycles}\nincrements = 8\n"
    ))
}

#[test]
fn a_coating_worn_through_is_told_of_with_and_without_a_limit() {
    let ended = worn("through_coating_of = \"lower\"", 20_000);
    let through = ended.worn_through.unwrap();
    assert_eq!(through.to, WornTo::Coating);
    let at = ended.cycles.last().unwrap().last_cycle;
    assert_eq!((through.cycles, through.stage), (at, 1));
    // Without the key it goes on: the same place, within the cycles that the last jump stood for, whose length the limit cuts short.
    let on = worn("", 2 * at);
    let told = on.worn_through.unwrap();
    println!("through after {at} cycles; told without a limit: {told:?}");
    assert_eq!((told.to, told.cell), (WornTo::Coating, through.cell));
    assert!((told.cycles as f64 / at as f64 - 1.0).abs() < 0.02, "{told:?} {at}");
    assert_eq!(on.cycles.last().unwrap().last_cycle, 2 * at);
    let before = on.cycles.iter().rfind(|cycle| cycle.last_cycle < told.cycles).unwrap();
    let after = on.cycles.iter().find(|cycle| cycle.last_cycle >= told.cycles).unwrap();
    assert!(before.max_worn_depth < 3e-3 && after.max_worn_depth >= 3e-3);
    assert!(on.worn_by_layer.unwrap().lower[1] > 0.0);
    // A film that lasts is not told of; a limit above it ends the run after it.
    assert_eq!(worn("", at / 2).worn_through, None);
    let limited = worn("limit = 3.5e-3", 2 * at);
    assert_eq!(limited.worn_through.unwrap().to, WornTo::Coating);
    assert!(limited.cycles.last().unwrap().last_cycle < 2 * at);
    let limited = worn("limit = 2e-3", 2 * at);
    assert_eq!(limited.worn_through.unwrap().to, WornTo::Limit);
}
