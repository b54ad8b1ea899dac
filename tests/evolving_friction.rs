//! Friction that evolves: layers that slide as a whole, whose coefficient follows a recurrence in closed form; cycle jumps and their
//! error; the end of partial slip; what stays the same whatever friction does.

use fret_core::case::Case;
use fret_core::history::{History, Start, StepRecord};
use fret_core::plan::{LeaveOut, Plan};
use fret_core::run::{Silent, Simulation};
use fret_validation::{Sphere, keeping, solved};
use ndarray::Array2;

/// Pressure on the layer, and the amplitude of its cycles.
const PRESSURE: f64 = 1e-3;
const AMPLITUDE: f64 = 5e-3;
/// Shear modulus over thickness of the layer: its stiffness under uniform shear.
const STIFFNESS: f64 = 10.0 / 2.6;

/// A flat layer (E = 10, nu = 0.3, thickness 1) on a rigid base under a rigid flat (a wave of 1e-9 of the approach), pressed evenly and slid to and fro: every cell does
/// the same.
fn layer(evolution: &str, cycles: usize) -> String {
    format!(
        "[grid]\ncells = [8, 4]\nsize = [2.0, 1.0]\nperiodic = true\n[upper]\nrigid = true\n[lower]\n\
         coatings = [{{ thickness = 1.0, young = 10.0, poisson = 0.3 }}]\nbase = \"rigid\"\n\
         [profile.wave]\namplitude = 1e-13\nwavelength_x = 2.0\n[friction]\ncoefficient = 0.2\nevolution = {{ {evolution} }}\n[[load]]\nnormal_force = {:e}\nincrements = 1\n\
         [[load]]\nshift = [{AMPLITUDE:e}, 0.0]\nincrements = 8\ncycles = {cycles}\n[output]\nfields = [\"friction\", \"pressure\"]\nevery = 8\n",
        PRESSURE * 2.0
    )
}

/// Slip distance in a cycle with the shear `now` on the circle, after one with `before`: from zero to the amplitude, back, and to zero;
/// at each turn the layer first gives by what its shear changes.
fn slip_of_cycle([before, now]: [f64; 2]) -> f64 {
    4.0 * AMPLITUDE - (5.0 * now - before) / STIFFNESS
}

/// Coefficients of so many cycles and the energies that they dissipate by area, for a law of the driver; `by_energy`, or by slip distance.
fn recurrence(law: impl Fn(f64) -> f64, by_energy: bool, cycles: usize) -> Vec<[f64; 2]> {
    let (mut driver, mut before) = (0.0, 0.0);
    let mut all = Vec::new();
    for _ in 0..cycles {
        let coefficient = law(driver);
        let shear = coefficient * PRESSURE;
        let slip = slip_of_cycle([before, shear]);
        driver += if by_energy { shear * slip } else { slip };
        before = shear;
        all.push([coefficient, shear * slip]);
    }
    all
}

fn towards(last: f64, scale: f64) -> impl Fn(f64) -> f64 {
    move |driver| last + (0.2 - last) * (-driver / scale).exp()
}

/// Of the cycles: coefficient, and energy of the computed one by area.
fn cycles_of(history: &History) -> Vec<[f64; 2]> {
    history.cycles.iter().map(|cycle| [cycle.friction_coefficient, cycle.dissipated_energy / 2.0]).collect()
}

#[track_caller]
fn assert_same(found: &[[f64; 2]], expected: &[[f64; 2]], words: &str) {
    assert_eq!(found.len(), expected.len());
    let mut worst = 0.0_f64;
    for (found, expected) in found.iter().zip(expected) {
        worst = worst.max((found[0] / expected[0] - 1.0).abs()).max((found[1] / expected[1] - 1.0).abs());
    }
    // Residual of the solver, 1e-8, over 20 cycles.
    assert!(worst < 1e-6, "{words}: {worst:e}");
}

/// A layer whose rigid flat goes round a circle of radius R: its shear, of constant size, stands along the slip, so that slip goes round a
/// circle of radius `sqrt(R^2 - (mu p / K)^2)`. Slip distance, which friction evolves with, and energy of a turn are those of its
/// circumference. Polygons of 16 and 32 sides would be 6.4e-3 and 1.6e-3 shorter, and less than a factor of 4 apart; friction changes too
/// little to be seen in the energy.
#[test]
fn a_layer_that_slides_round_a_circle_goes_its_circumference() {
    let shear = 0.2 * PRESSURE;
    let way = std::f64::consts::TAU * (AMPLITUDE * AMPLITUDE - (shear / STIFFNESS).powi(2)).sqrt();
    let errors = [16, 32].map(|per_turn| {
        let evolution = format!("by = \"slip_distance\", table = [[0, 0.2], [{:e}, 0.4]]", 1e6 * way);
        let text = layer(&evolution, 1).replace(
            &format!("shift = [{AMPLITUDE:e}, 0.0]\nincrements = 8\ncycles = 1\n"),
            &format!(
                "shift = [{AMPLITUDE:e}, 0.0]\nincrements = 4\n[[load]]\nshift = [{AMPLITUDE:e}, {AMPLITUDE:e}]\n\
                 phase = {{ shift = [90, 0] }}\nwaveform = \"sine\"\nincrements = {per_turn}\ncycles = 3\n"
            ),
        );
        let cycles = cycles_of(&solved(&text));
        let distance = (cycles[2][0] - cycles[1][0]) / 0.2 * 1e6 * way;
        [distance / way - 1.0, cycles[2][1] / (shear * way) - 1.0].map(f64::abs)
    });
    for [coarse, fine] in [0, 1].map(|k| [errors[0][k], errors[1][k]]) {
        assert!(fine < 3e-4 && fine < coarse / 6.0, "{errors:?}");
    }
}

#[test]
fn a_layer_that_slides_follows_its_recurrence() {
    let (energy, slip) = (4.0 * 0.2 * PRESSURE * AMPLITUDE * 8.0, 4.0 * AMPLITUDE * 8.0);
    let history = solved(&layer(&format!("by = \"energy\", last = 0.7, scale = {energy:e}"), 20));
    assert_same(&cycles_of(&history), &recurrence(towards(0.7, energy), true, 20), "rises with energy");
    let kept = history.fields.last().unwrap().friction.as_ref().unwrap();
    assert!(kept.iter().all(|mu| (mu - history.cycles[19].friction_coefficient).abs() < 1e-7));
    assert_eq!(history.steps.last().unwrap().friction_coefficient, history.cycles[19].friction_coefficient);
    let history = solved(&layer(&format!("by = \"slip_distance\", last = 0.05, scale = {slip:e}"), 20));
    assert_same(&cycles_of(&history), &recurrence(towards(0.05, slip), false, 20), "falls with slip");
    let history = solved(&layer(
        &format!("by = \"slip_distance\", table = [[0, 0.2], [{slip:e}, 0.6], [{:e}, 0.3]]", 2.0 * slip),
        20,
    ));
    let law = |x: f64| match x / slip {
        x if x < 1.0 => 0.2 + 0.4 * x,
        x if x < 2.0 => 0.6 - 0.3 * (x - 1.0),
        _ => 0.3,
    };
    assert_same(&cycles_of(&history), &recurrence(law, false, 20), "a table over slip");
    // By cycles it needs no recurrence: W_d of a layer that slides is its shear times its slip.
    let history = solved(&layer("by = \"cycles\", last = 0.5, scale = 4.0", 20));
    let coefficients: Vec<f64> = (0..20).map(|cycle| towards(0.5, 4.0)(f64::from(cycle))).collect();
    let mut before = 0.0;
    let expected: Vec<[f64; 2]> = coefficients
        .iter()
        .map(|mu| {
            let shear = mu * PRESSURE;
            let slip = slip_of_cycle([before, shear]);
            before = shear;
            [*mu, shear * slip]
        })
        .collect();
    assert_same(&cycles_of(&history), &expected, "by cycles");
}

/// A block of cycles is an explicit step: half the change of friction in a jump, half the error.
#[test]
fn halving_the_tolerance_of_a_jump_halves_its_error() {
    let energy = 4.0 * 0.2 * PRESSURE * AMPLITUDE * 400.0;
    let all = recurrence(towards(0.8, energy), true, 600);
    let exact = all.iter().map(|[_, energy]| energy).sum::<f64>();
    let end = |tolerance: f64| {
        let evolution = format!(
            "by = \"energy\", last = 0.8, scale = {energy:e}, every = 1000, tolerance = {tolerance:e}"
        );
        let history = solved(&layer(&evolution, 600));
        let last = history.cycles.last().unwrap();
        assert_eq!(last.last_cycle, 600);
        let largest = history.cycles.iter().map(|cycle| cycle.friction_change.unwrap()).fold(0.0, f64::max);
        assert!(largest <= tolerance * (1.0 + 1e-9), "{largest:e} {tolerance:e}");
        let off = last.total_dissipated_energy / 2.0 / exact - 1.0;
        println!(
            "tolerance {tolerance:.0e}: {} cycles computed, energy off {:.2e}",
            history.cycles.len(),
            off
        );
        off.abs()
    };
    let errors = [0.04, 0.02, 0.01].map(end);
    for pair in errors.windows(2) {
        let ratio = pair[0] / pair[1];
        // First order; the last block of each run is cut to the number of cycles.
        assert!((1.6..2.5).contains(&ratio), "{errors:?}");
    }
    assert!(errors[2] < 0.01, "{errors:?}");
}

/// The error that a cycle says the jump before it had is that of the coefficient against cycle by cycle.
#[test]
fn the_error_of_a_jump_is_told() {
    let energy = 4.0 * 0.2 * PRESSURE * AMPLITUDE * 100.0;
    let law = towards(0.8, energy);
    let evolution = format!("by = \"energy\", last = 0.8, scale = {energy:e}, every = 20, tolerance = 1.0");
    let history = solved(&layer(&evolution, 21));
    let stands_for: Vec<usize> = history.cycles.iter().map(|cycle| cycle.stands_for).collect();
    assert_eq!(stands_for, [20, 1]);
    let [first, second] = [&history.cycles[0], &history.cycles[1]];
    let exact = recurrence(&law, true, 21)[20][0];
    let (off, told) = ((second.friction_coefficient - exact).abs(), second.jump_error.unwrap());
    println!("jump of 20 cycles: coefficient off {off:.3e}, told {told:.3e}");
    // The estimate takes the change of the cycles for linear; over the jump the coefficient grows by a half, and the first cycle starts
    // without shear.
    assert!((0.7..1.4).contains(&(told / off)), "{told:e} {off:e}");
    assert_eq!(first.jump_error, Some(0.0));
    // Cycle by cycle there is no jump and no error.
    let history = solved(&layer(&evolution.replace("every = 20", "every = 1"), 5));
    assert!(history.cycles.iter().all(|cycle| cycle.jump_error == Some(0.0)));
}

fn timeless(steps: &[StepRecord]) -> Vec<StepRecord> {
    steps.iter().map(|step| StepRecord { wall_s: 0.0, ..step.clone() }).collect()
}

fn sphere() -> Sphere {
    Sphere { cells: 24, size: 2.6, friction: 0.3, coating: Some((2.0, 0.5)), ..Sphere::default() }
}

/// Partial slip of a sphere, with what stands behind the coefficient.
fn fretted(sphere: &Sphere, evolution: &str, cycles: usize) -> String {
    let text = sphere.pulled(&sphere.pressed(1.0, 3, "cubic"), 0.7, 8, Some(cycles));
    let [head, tail] = text.split_once("[solver]").map(|(head, tail)| [head, tail]).unwrap();
    format!("{head}{evolution}[solver]{tail}{}", keeping(8).replace("\"zone\"", "\"zone\", \"friction\""))
}

/// A law whose end is its start, and a table of one value, change nothing, to the bit, also with cycle jumps of one cycle.
#[test]
fn friction_that_stays_has_the_bits_of_a_run_without_evolution() {
    let (without, sphere) = (solved(&fretted(&sphere(), "", 3)), sphere());
    for evolution in
        ["by = \"energy\", last = 0.3, scale = 1e-9", "by = \"cycles\", table = [[0, 0.3], [5, 0.3]]"]
    {
        let with = solved(&fretted(&sphere, &format!("evolution = {{ {evolution} }}\n"), 3));
        assert_eq!(timeless(&with.steps), timeless(&without.steps), "{evolution}");
        for (one, other) in with.fields.iter().zip(&without.fields) {
            assert_eq!((&one.pressure, &one.shear, &one.slip), (&other.pressure, &other.shear, &other.slip));
            assert!(one.friction.as_ref().unwrap().iter().all(|mu| *mu == 0.3));
        }
    }
}

/// Partial slip under force cycles: friction rises where the surfaces slip, and in the end the contact is Cattaneo's with the
/// last coefficient whatever the way there, though the circle that sticks keeps the first (Hills, Nowell & Sackfield 1988).
#[test]
fn partial_slip_ends_as_with_the_last_coefficient() {
    let sphere =
        Sphere { cells: 48, size: 2.2, poisson: 0.0, identical: true, friction: 0.3, ..Sphere::default() };
    // Energy by area of a cycle of gross slip of about the elastic displacement.
    let scale = 0.3 * sphere.max_pressure() * sphere.approach() * 1e-3;
    for law in [
        format!("by = \"energy\", last = 0.6, scale = {scale:e}"),
        format!("by = \"slip_distance\", last = 0.6, scale = {:e}", 1e-4 * sphere.approach()),
    ] {
        let history = solved(&fretted(&sphere, &format!("evolution = {{ {law} }}\n"), 30));
        let share: f64 = 0.7 * 0.3;
        let expected = (1.0 - share / 0.6).powf(1.0 / 3.0);
        // Stick at the largest force of a cycle, a quarter of it after its start; the radius from the number of cells.
        let peak = |cycle: usize| {
            let step = &history.steps[history.cycles[cycle].first_increment + 1];
            (step.stick_cells as f64 * history.grid.cell_area() / std::f64::consts::PI).sqrt()
        };
        println!("{law}: stick radius {:.3} -> {:.3}, Cattaneo {expected:.3}", peak(0), peak(29));
        // A cell is 0.046 wide; the edge of stick is known to one.
        assert!((peak(0) - (1.0 - 0.7_f64).powf(1.0 / 3.0)).abs() < 0.046);
        assert!((peak(29) - expected).abs() < 0.046);
        // Where all slips at the end friction is the last one, in the middle the first.
        let friction = history.fields.last().unwrap().friction.as_ref().unwrap();
        assert_eq!(friction[[24, 24]], 0.3);
        let outermost = friction.iter().copied().fold(0.0, f64::max);
        assert!((outermost - 0.6).abs() < 1e-3, "{outermost}");
    }
}

/// The energy of all cells is that of the run, with cycle jumps; wear by energy removes its coefficient times it, whatever friction does.
#[test]
fn energies_of_the_cells_add_up() {
    let sphere = sphere();
    let scale = 0.3 * sphere.max_pressure() * sphere.approach();
    let evolution = format!(
        "evolution = {{ by = \"energy\", last = 0.6, scale = {scale:e}, every = 5, tolerance = 0.3 }}\n"
    );
    let wear = "[wear]\ncoefficient = 2.0\nevery = 3\n";
    for (text, most) in
        [(fretted(&sphere, &evolution, 24), 5), (fretted(&sphere, &format!("{evolution}{wear}"), 24), 3)]
    {
        let history = solved(&text);
        let last = history.steps.last().unwrap();
        let slipped = history.state.accumulated.as_ref().unwrap();
        let sum = slipped.energy_density.sum() * history.grid.cell_area();
        // Sums of the same numbers in another order.
        assert!((sum / last.dissipated_energy - 1.0).abs() < 1e-12, "{sum:e} {:e}", last.dissipated_energy);
        assert_eq!(slipped.cycles, 24);
        assert_eq!(history.cycles.iter().map(|cycle| cycle.stands_for).max(), Some(most));
        if last.worn_volume > 0.0 {
            assert!((last.worn_volume / (2.0 * sum) - 1.0).abs() < 1e-12, "{:e}", last.worn_volume);
        }
    }
}

/// In front of its mirrors a contact has the same friction as without, and it is its own mirror image.
#[test]
fn friction_is_as_symmetric_as_what_drives_it() {
    let sphere = Sphere { cells: 32, ..sphere() };
    let scale = 0.01 * sphere.max_pressure() * sphere.approach();
    let text =
        fretted(&sphere, &format!("evolution = {{ by = \"energy\", last = 0.8, scale = {scale:e} }}\n"), 4);
    let friction = |leave_out: LeaveOut, mirrored: bool| {
        let plan = Plan::leaving_out(Case::from_toml(&text, "case.toml").unwrap(), leave_out).unwrap();
        assert_eq!(plan.symmetry.any(), mirrored);
        let history = Simulation::new(&plan).run(&mut Silent).unwrap();
        history.fields.last().unwrap().friction.clone().unwrap()
    };
    let [one, other] = [(LeaveOut::ALL, true), (LeaveOut::NONE, false)].map(|(out, any)| friction(out, any));
    for ((i, j), mu) in one.indexed_iter() {
        assert_eq!(*mu, one[[i, 31 - j]], "{i} {j}");
    }
    let apart = (&one - &other).iter().map(|off| off.abs()).fold(0.0, f64::max);
    let range = one.iter().copied().fold(0.0, f64::max) - 0.3;
    println!("friction with and without mirrors: apart by {apart:.1e}, risen by {range:.2}");
    // Two solutions to 1e-8; a cell at the edge of slip may do one or the other.
    assert!(range > 0.1 && apart < 1e-4, "{apart:e} {range}");
}

/// Lengths a thousandth, moduli a million times: the same numbers in other units.
#[test]
fn units_are_the_user_s() {
    let coefficients = |length: f64, modulus: f64| {
        let sphere = Sphere { length, modulus, coating: None, ..sphere() };
        let scale = 0.01 * sphere.max_pressure() * sphere.approach();
        let law = format!("by = \"energy\", last = 0.8, scale = {scale:e}");
        let history = solved(&fretted(&sphere, &format!("evolution = {{ {law} }}\n"), 3));
        history.cycles.iter().map(|cycle| cycle.friction_coefficient).collect::<Vec<_>>()
    };
    let [one, other] = [coefficients(1.0, 1.0), coefficients(1e-3, 1e6)];
    assert!(one[2] > one[1] + 1e-3, "{one:?}");
    for (a, b) in one.iter().zip(&other) {
        // Two solutions to 1e-8.
        assert!((a / b - 1.0).abs() < 1e-6, "{one:?} {other:?}");
    }
}

/// A history that starts from the state of another goes on with what its cells have slipped; without evolution they keep it.
#[test]
fn another_history_goes_on_with_the_friction_reached() {
    let slip = 4.0 * AMPLITUDE * 8.0;
    let evolution = format!("by = \"slip_distance\", last = 0.7, scale = {slip:e}");
    let whole = solved(&layer(&evolution, 12));
    let first = solved(&layer(&evolution, 5));
    let load = "[[load]]\nnormal_force";
    let on = |text: &str| {
        let (head, rest) = text.split_once(load).unwrap();
        let (_, rest) = rest.split_once("[[load]]").unwrap();
        format!("{head}[[load]]{rest}")
    };
    let from = |history: &History, text: &str| {
        let last = history.steps.last().unwrap().increment;
        let start = std::sync::Arc::new(Start::of(history, last).unwrap());
        let attachments = fret_core::case::Attachments {
            start: Some(start.solved.loads),
            ..fret_core::case::Attachments::none()
        };
        let case = Case::from_toml_with(text, "case.toml", attachments).unwrap();
        let plan = Plan::starting_from(Some(start), case, LeaveOut::ALL).unwrap();
        Simulation::new(&plan).run(&mut Silent).unwrap()
    };
    let rest = from(&first, &on(&layer(&evolution, 7)));
    assert_same(&cycles_of(&rest), &cycles_of(&whole)[5..], "from another history");
    // In between a history whose friction does not evolve.
    let still = on(&layer("", 1)).replace("evolution = {  }\n", "");
    let between = from(&first, &still);
    assert_eq!(between.state.accumulated, first.state.accumulated);
    assert_eq!(between.cycles[0].friction_coefficient, 0.2);
    let after = from(&between, &on(&layer(&evolution, 1)));
    assert!((after.cycles[0].friction_coefficient / whole.cycles[5].friction_coefficient - 1.0).abs() < 1e-9);
}

/// Friction falling fast under the energy of a cycle is told.
#[test]
fn friction_that_changes_much_in_one_cycle_is_told() {
    let warned = |scale: f64| {
        let history = solved(&layer(&format!("by = \"slip_distance\", last = 0.7, scale = {scale:e}"), 3));
        let names: Vec<_> = history.warnings.iter().map(|warning| warning.name.row().name).collect();
        names.contains(&"friction_changes_in_one_cycle")
    };
    assert!(warned(4.0 * AMPLITUDE));
    assert!(!warned(400.0 * AMPLITUDE));
}

/// Patches without friction keep none while energy drives, since they dissipate none; each other cell starts from its own coefficient.
#[test]
fn every_cell_of_a_map_starts_from_its_own_coefficient() {
    let map = Array2::from_shape_fn((8, 4), |(i, _)| if i < 4 { 0.0 } else { 0.2 });
    let energy = 4.0 * 0.2 * PRESSURE * AMPLITUDE * 8.0;
    let text = layer(&format!("by = \"energy\", last = 0.7, scale = {energy:e}"), 6)
        .replace("coefficient = 0.2", "map = { array = 0 }");
    let history = fret_validation::solved_with(&text, &[map]);
    let friction = history.fields.last().unwrap().friction.as_ref().unwrap();
    for ((i, _), mu) in friction.indexed_iter() {
        assert!(if i < 4 { *mu == 0.0 } else { *mu > 0.3 && *mu < 0.7 }, "{friction}");
    }
    let kept = history.fields.last().unwrap();
    let pressure = kept.pressure.as_ref().unwrap();
    let mean = (friction * pressure).sum() / pressure.sum();
    let last = history.cycles.last().unwrap();
    // Sums in another order.
    assert!((last.friction_coefficient / mean - 1.0).abs() < 1e-12);
}
