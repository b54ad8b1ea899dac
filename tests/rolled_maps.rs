//! A grid that goes with a contact over places that differ: heights and friction maps travel through it, and what lies beyond them is what the
//! case says. It is one problem with a grid that holds all of the way; and an upper body that turns as a moment lets it.

use std::sync::Arc;

use fret_core::case::{Attachments, Case};
use fret_core::history::{History, Start, StepRecord};
use fret_core::plan::{LeaveOut, Plan};
use fret_core::run::{Silent, Simulation};
use fret_core::study::{Variation, VariationError};
use fret_validation::{off_first_law, run, solved, solved_with};
use ndarray::Array2;

/// Cells of the grid that goes along, and of the one that holds the way.
const SMALL: usize = 28;
const LARGE: usize = 68;
const SPACING: f64 = 0.1;

/// Ripples and a slope of ten wavelengths that fit nothing, so that a seam is seen.
fn heights() -> Array2<f64> {
    Array2::from_shape_fn((SMALL, SMALL), |(i, j)| {
        let (x, y) = (i as f64, j as f64);
        2e-4 * (0.9 * x + 0.3).sin() * (0.7 * y).cos() + 1e-5 * x
    })
}

fn friction() -> Array2<f64> {
    Array2::from_shape_fn((SMALL, SMALL), |(i, j)| 0.2 + 0.02 * ((2 * i + 3 * j) % 9) as f64)
}

/// A map on the grid that holds the way, with what lies beyond it along x.
fn beyond(map: &Array2<f64>, how: &str) -> Array2<f64> {
    let first = (LARGE - SMALL) / 2;
    Array2::from_shape_fn((LARGE, SMALL), |(i, j)| {
        let at = i as isize - first as isize;
        let count = SMALL as isize;
        let there = match how {
            "edge" => at.clamp(0, count - 1),
            "repeats" => at.rem_euclid(count),
            _ if at < 0 => -1 - at,
            _ if at >= count => 2 * count - 1 - at,
            _ => at,
        };
        map[[there as usize, j]]
    })
}

/// A rigid ball on an elastic flat, pulled and rolled along x.
fn ball((cells, kinematics): (usize, &str), surface: &str, loads: &str) -> String {
    format!(
        "[grid]\ncells = [{cells}, {SMALL}]\nsize = [{:?}, {:?}]\n[upper]\nrigid = true\n[lower]\nsubstrate = {{ young = 1.0, poisson = 0.2 }}\n\
         [profile.sphere]\nradius = 100.0\n{surface}[kinematics]\n{kinematics}\n[solver]\ntolerance = 1e-10\n\
         [output]\nfields = [\"pressure\", \"shear\", \"slip\", \"friction\"]\nevery = 1\n\
         [[load]]\nnormal_force = 1.2e-2\nincrements = 3\n[[load]]\ntangential_force = [8e-4, 3e-4]\nincrements = 2\n{loads}",
        SPACING * cells as f64,
        SPACING * SMALL as f64,
    )
}

const MAPS: &str = "[profile.heights]\nvalues = { array = 0 }\n[friction]\nmap = { array = 1 }\n";

/// The largest difference of the tractions of two histories, the second of a grid that went along, over the largest pressure; and of what is told of
/// their increments.
fn differ([fixed, along]: [&History; 2]) -> [f64; 2] {
    let (mut tractions, mut numbers) = (0.0_f64, 0.0_f64);
    for (one, other) in fixed.steps.iter().zip(&along.steps) {
        let [a, b] =
            [(fixed, one), (along, other)].map(|(history, step)| history.fields_of(step.increment).unwrap());
        let rolled = (other.roll[0] / SPACING).round() as isize;
        let (p, r) = (a.pressure.as_ref().unwrap(), b.pressure.as_ref().unwrap());
        let most = r.iter().copied().fold(0.0, f64::max);
        for ((i, j), pressure) in r.indexed_iter() {
            let there = (i + (LARGE - SMALL) / 2).checked_add_signed(rolled).unwrap();
            let mut off = (p[[there, j]] - pressure).abs();
            for axis in 0..2 {
                let [q, s] = [a, b].map(|fields| &fields.shear.as_ref().unwrap()[axis]);
                off = off.max((q[[there, j]] - s[[i, j]]).abs());
            }
            if *pressure > 0.0 {
                let [mu, nu] = [a, b].map(|fields| fields.friction.as_ref().unwrap());
                assert_eq!(mu[[there, j]], nu[[i, j]]);
            }
            tractions = tractions.max(off / most);
        }
        assert_eq!((one.contact_cells, one.stick_cells), (other.contact_cells, other.stick_cells));
        let told = |step: &StepRecord| {
            let [[x, y], [qx, qy]] = [step.creepage.unwrap_or_default(), step.tangential_force];
            [step.approach, x, y, qx, qy, step.twist_moment, step.dissipated_energy, step.external_work]
        };
        for (a, b) in told(one).into_iter().zip(told(other)) {
            numbers = numbers.max((a - b).abs() / a.abs().max(1e-6));
        }
    }
    [tractions, numbers]
}

/// Heights and a friction map travel through a grid that goes with the contact as they lie on one that holds all of the way, to residuals of 1e-10 of
/// each: one way, there and back, over what lies beyond the map.
#[test]
fn maps_travel_through_a_grid_that_goes_along() {
    let there = "[[load]]\nroll = [1.9, 0.0]\nincrements = 19\n";
    let and_back = "[[load]]\nroll = [1.6, 0.0]\nshift = [3e-3, \"held\"]\ncycles = 2\nincrements = 32\n";
    for (how, loads) in [("edge", there), ("repeats", there), ("mirrors", there), ("mirrors", and_back)] {
        let maps = [heights(), friction()];
        let kinematics = format!("frame = \"contact\"\nbeyond_maps = \"{how}\"");
        let along = solved_with(&ball((SMALL, &kinematics), MAPS, loads), &maps);
        let large = maps.each_ref().map(|map| beyond(map, how));
        let fixed = solved_with(&ball((LARGE, "frame = \"bodies\""), MAPS, loads), &large);
        let [tractions, numbers] = differ([&fixed, &along]);
        println!(
            "maps that travel, {how}, {loads:?}: tractions differ by {tractions:.1e}, numbers by {numbers:.1e}"
        );
        assert!(tractions < 1e-7 && numbers < 1e-6, "{how}: {tractions:e} {numbers:e}");
        let law = off_first_law(&along, 0.0);
        assert!(law < 1e-9, "{law:e}");
        for (one, other) in fixed.cycles.iter().zip(&along.cycles) {
            for (a, b) in [
                (one.dissipated_energy, other.dissipated_energy),
                (one.displacement_amplitude, other.displacement_amplitude),
                (one.friction_coefficient, other.friction_coefficient),
            ] {
                assert!((a - b).abs() <= 1e-6 * a.abs().max(1e-9), "{a:e} {b:e}");
            }
            assert!((one.closure - other.closure).abs() < 1e-6, "{} {}", one.closure, other.closure);
        }
        assert_eq!(along.cycles.len(), if loads == there { 0 } else { 2 });
    }
}

/// Rolled by the length of a map that repeats, a contact without friction is where it was, and half-way it is not. A history that starts from the state
/// half-way goes on there.
#[test]
fn a_map_that_repeats_comes_round() {
    let surface = "[profile.heights]\nvalues = { array = 0 }\n[friction]\ncoefficient = 0.0\n";
    let kinematics = "frame = \"contact\"\nbeyond_maps = \"repeats\"";
    let loads = |roll: f64| format!("[[load]]\nroll = [{roll:?}, 0.0]\nincrements = 14\n");
    let pressed = |loads: &str| {
        ball((SMALL, kinematics), surface, loads)
            .replace(", \"friction\"]", "]")
            .replace("[[load]]\ntangential_force = [8e-4, 3e-4]\nincrements = 2\n", "")
    };
    let round = solved_with(&pressed(&(loads(1.4) + &loads(2.8))), &[heights()]);
    let [start, half, end] = [2, 16, 30].map(|step| round.fields_of(step).unwrap().pressure.clone().unwrap());
    let largest = |field: &Array2<f64>| field.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    let off = largest(&(&end - &start)) / largest(&start);
    assert!(off < 1e-8 && largest(&(&half - &start)) > 0.05 * largest(&start), "{off:e}");
    let first = solved_with(&pressed(&loads(1.4)), &[heights()]);
    let from = Arc::new(Start::of(&first, 16).unwrap());
    let text = pressed("").replace("[[load]]\nnormal_force = 1.2e-2\nincrements = 3\n", "") + &loads(2.8);
    let arrays = vec![heights()];
    let attachments = Attachments { start: Some(from.solved.loads), arrays: &arrays, ..Attachments::none() };
    let case = Case::from_toml_with(&text, "case.toml", attachments).unwrap();
    let plan = Plan::starting_from(Some(from), case, LeaveOut::ALL).unwrap();
    let rest = Simulation::new(&plan).run(&mut Silent).unwrap();
    let off = largest(&(&rest.state.pressure - &end)) / largest(&end);
    assert!(off < 1e-8, "{off:e}");
}

/// Two bodies of one material, pressed to a circle of radius 1 by Hertz, G = 1, nu = 0.25; friction 0.5; rolled until nothing is left of the start.
fn spheres(motion: &str) -> StepRecord {
    let (cells, size, increments) = (40_usize, 2.4, 240_usize);
    let force = 4.0 / 3.0 * (4.0 / 3.0) / 100.0;
    let text = format!(
        "[grid]\ncells = [{cells}, {cells}]\nsize = [{size}, {size}]\n[upper]\nsubstrate = {{ young = 2.5, poisson = 0.25 }}\n[lower]\n\
         substrate = {{ young = 2.5, poisson = 0.25 }}\n[profile.sphere]\nradius = 100.0\n[friction]\ncoefficient = 0.5\n[kinematics]\n\
         frame = \"contact\"\n[solver]\ntolerance = 1e-8\n[[load]]\nnormal_force = {force:e}\nincrements = 1\n\
         [[load]]\nroll = [{:?}, 0.0]\n{motion}\nincrements = {increments}\n",
        size / cells as f64 * increments as f64
    );
    let history = run(&text).unwrap_or_else(|error| panic!("{error}"));
    history.steps.last().unwrap().clone()
}

/// A ball that is free to turn about the normal, and is pushed across by a small creepage, turns by `C32/C33` of it: Kalker's `M = -G a^3 (C32 eta +
/// a C33 phi)` with C32 = -C23 = -1.47 and C33 = 1.19 for a circle and nu = 0.25 (Kalker 1990, table E3). And by what the moments under that creepage
/// alone and under a spin alone add up to: small ones are linear.
#[test]
fn a_ball_that_is_free_to_turn_spins_as_kalkers_coefficients_say() {
    let small = 1e-6;
    let across = spheres(&format!("creepage = [0.0, {small:e}]"));
    let spun = spheres(&format!("creepage = [0.0, 0.0]\nspin = {small:e}"));
    let free = spheres(&format!("creepage = [0.0, {small:e}]\ntwist_moment = 0.0"));
    let [by_creepage, by_spin] = [&across, &spun].map(|step| step.twist_moment / small);
    let found = free.spin.unwrap() / small;
    println!(
        "free to turn: spin {found:.5} of the creepage, by moments {:.5}, Kalker {:.5}; moment left {:.1e} of {:.1e}",
        -by_creepage / by_spin,
        1.47 / 1.19,
        free.twist_moment,
        across.twist_moment
    );
    assert!(free.twist_moment.abs() < 1e-6 * across.twist_moment.abs());
    // slip at the trailing edge is not linear
    assert!((found / (-by_creepage / by_spin) - 1.0).abs() < 2e-3, "{found}");
    // three digits each, and 33 cells over the contact
    assert!((found / (1.47 / 1.19) - 1.0).abs() < 0.015, "{found}");
}

/// Under a moment a contact spins alike whether the grid is fixed to the bodies or goes along, and under the spin that it has it has the moment.
#[test]
fn moments_turn_a_contact_that_rolls_alike_in_both_frames() {
    let uniform = "[friction]\ncoefficient = 0.3\n";
    let case = |grid: (usize, &str), motion: &str| {
        let loads = format!(
            "[[load]]\ntwist_moment = 2e-4\nincrements = 2\n[[load]]\nroll = [1.6, 0.0]\n{motion}\nincrements = 16\n"
        );
        solved(&ball(grid, uniform, &loads))
    };
    for motion in ["", "creepage = [1e-3, \"held\"]"] {
        let [fixed, along] =
            [(LARGE, "frame = \"bodies\""), (SMALL, "frame = \"contact\"")].map(|grid| case(grid, motion));
        let [tractions, numbers] = differ([&fixed, &along]);
        let last = along.steps.last().unwrap();
        let spin = last.spin.unwrap();
        println!(
            "a moment and a roll, {motion:?}: tractions differ by {tractions:.1e}, numbers by {numbers:.1e}; spin {spin:.3e}, moment {:.6e}",
            last.twist_moment
        );
        assert!(tractions < 1e-6 && numbers < 1e-5, "{tractions:e} {numbers:e}");
        assert!(spin > 1e-5 && (last.twist_moment / 2e-4 - 1.0).abs() < 1e-8, "{spin} {}", last.twist_moment);
        assert!((fixed.steps.last().unwrap().spin.unwrap() / spin - 1.0).abs() < 1e-5);
        for history in [&fixed, &along] {
            assert!(off_first_law(history, 0.0) < 1e-9, "{:e}", off_first_law(history, 0.0));
        }
    }
}

/// A ball that is pulled along its way does not turn, by symmetry: free to do so, it is the one whose twist is held.
#[test]
fn a_ball_that_is_free_to_turn_and_has_no_reason_to_does_not() {
    let uniform = "[friction]\ncoefficient = 0.3\n";
    for grid in [(LARGE, "frame = \"bodies\""), (SMALL, "frame = \"contact\"")] {
        let [free, held] = ["twist_moment = 0.0\n", ""].map(|motion| {
            let text = ball(grid, uniform, "[[load]]\nroll = [0.8, 0.0]\nincrements = 8\n")
                .replace("[8e-4, 3e-4]", "[8e-4, 0.0]")
                .replace("normal_force = 1.2e-2\n", &format!("normal_force = 1.2e-2\n{motion}"));
            solved(&text).steps.last().unwrap().clone()
        });
        let off = (free.shift[0] / held.shift[0] - 1.0).abs();
        println!("free to turn, {}: twist {:.1e} rad, shift off by {off:.1e}", grid.1, free.twist);
        // What the solver leaves of a residual of 1e-10, over the radius of contact, which is about 1.
        assert!(free.twist.abs() < 1e-9 * free.shift[0].abs() && off < 1e-8, "{:e} {off:e}", free.twist);
    }
}

/// The places of a body that has rolled off with its grid: what is fixed to them is refused, and what lies beyond their maps is that of before.
#[test]
fn a_start_that_has_rolled_is_judged_as_a_contact_that_rolls() {
    let rolled = |kinematics: &str, surface: &str| {
        let text = ball((SMALL, kinematics), surface, "[[load]]\nroll = [0.4, 0.0]\nincrements = 4\n");
        Start::of(&solved_with(&text, &[heights()]), 8).unwrap()
    };
    let heights_and_friction = "[profile.heights]\nvalues = { array = 0 }\n[friction]\ncoefficient = 0.3\n";
    let uniform = "[friction]\ncoefficient = 0.3\n";
    let mirrors = "frame = \"contact\"\nbeyond_maps = \"mirrors\"";
    let arrays = vec![heights()];
    let from = |start: &Start, (kinematics, surface): (&str, &str), more: &str| {
        let text = ball((SMALL, kinematics), surface, more);
        let (first, rest) = text.split_once("[[load]]\n").unwrap();
        let rest = rest.splitn(3, "[[load]]\n").nth(2).unwrap();
        let attachments =
            Attachments { start: Some(start.solved.loads), arrays: &arrays, ..Attachments::none() };
        let case = Case::from_toml_with(&format!("{first}[[load]]\n{rest}"), "case.toml", attachments)
            .map_err(|error| error.to_string())?;
        Plan::starting_from(Some(Arc::new(start.clone())), case, LeaveOut::ALL)
            .map(|_| ())
            .map_err(|error| error.to_string())
    };
    let pressed = "[[load]]\nnormal_force = 1.3e-2\nincrements = 1\n";
    let fretted = "[[load]]\nshift = [1e-3, 0.0]\ncycles = 2\nincrements = 8\n";
    let along = rolled(mirrors, heights_and_friction);
    let fixed = rolled("frame = \"bodies\"", uniform);
    let wear = format!("{fretted}[wear]\ncoefficient = 1e-3\n");
    let tilted = "[[load]]\ntilt_moment = [1e-5, 0.0]\nincrements = 1\n";
    let edge = "frame = \"contact\"\nbeyond_maps = \"edge\"";
    for (start, here, more, why) in [
        (&along, (mirrors, heights_and_friction), wear.as_str(), "wear with kinematics.frame = \"contact\""),
        (&along, ("frame = \"contact\"", heights_and_friction), pressed, "rolls off it"),
        (&along, (edge, heights_and_friction), pressed, "kinematics.beyond_maps"),
        (&fixed, ("frame = \"bodies\"", uniform), tilted, "a tilt is about the middle of the grid"),
    ] {
        let refused = from(start, here, more).unwrap_err();
        assert!(refused.contains(why), "{more}: {refused}");
    }
    from(&along, (mirrors, heights_and_friction), pressed).unwrap();
    from(&fixed, ("frame = \"bodies\"", uniform), pressed).unwrap();
}

/// A grid that goes along by whole cells has no answer where an increment is a part of one: neither a study nor an error bar takes such a grid.
#[test]
fn grids_on_which_increments_are_parts_of_cells_are_no_levels() {
    let uniform = "[friction]\ncoefficient = 0.3\n";
    let plan = |increments: usize| {
        let loads = format!("[[load]]\nroll = [1.2, 0.0]\nincrements = {increments}\n");
        let text = ball((SMALL, "frame = \"contact\""), uniform, &loads);
        Plan::new(Case::from_toml(&text, "case.toml").unwrap()).unwrap()
    };
    let coarser = |plan: &Plan, increments: usize| {
        let own = Variation::of(plan);
        let [first, second, _] = own.increments[..] else { panic!("three stages") };
        Variation { cells: [14, 14], increments: vec![first, second, increments], ..own }.planned(plan)
    };
    // Twelve cells of 0.1 or six of 0.2.
    let cell_by_cell = plan(12);
    assert!(
        matches!(coarser(&cell_by_cell, 12), Err(VariationError::PartsOfCells { why, .. }) if why.contains("0.5000 cells"))
    );
    assert_eq!(coarser(&cell_by_cell, 6).unwrap().case.increments(), 3 + 2 + 6);
}

/// The steady state of a free ball has no moment, and is what marching comes to.
#[test]
fn a_steady_ball_that_is_free_to_turn_is_the_one_that_was_marched() {
    let marched = spheres("creepage = [1e-4, 1e-3]\ntwist_moment = 0.0");
    let force = 4.0 / 3.0 * (4.0 / 3.0) / 100.0;
    let text = format!(
        "[grid]\ncells = [40, 40]\nsize = [2.4, 2.4]\n[upper]\nsubstrate = {{ young = 2.5, poisson = 0.25 }}\n[lower]\n\
         substrate = {{ young = 2.5, poisson = 0.25 }}\n[profile.sphere]\nradius = 100.0\n[friction]\ncoefficient = 0.5\n\
         [solver]\ntolerance = 1e-8\n[[load]]\nnormal_force = {force:e}\nincrements = 1\n\
         [[load]]\nroll = \"steady\"\ncreepage = [1e-4, 1e-3]\ntwist_moment = 0.0\nincrements = 1\n"
    );
    let history = run(&text).unwrap_or_else(|error| panic!("{error}"));
    let steady = history.steps.last().unwrap();
    let [one, other] = [&marched, steady].map(|step| (step.spin.unwrap(), step.tangential_force));
    println!(
        "steady and free to turn: {other:?}, marched {one:?}, {} applications",
        steady.work.convolutions
    );
    // what is left of both transients
    assert!((one.0 / other.0 - 1.0).abs() < 1e-4, "{one:?} {other:?}");
    for axis in 0..2 {
        let carries = 0.5 * force;
        assert!((one.1[axis] - other.1[axis]).abs() < 2e-5 * carries, "{one:?} {other:?}");
    }
    assert!(steady.twist_moment.abs() < 1e-8 * carries_moment(force));
}

/// The moment of full friction over the contact, at the most [force x length].
fn carries_moment(force: f64) -> f64 {
    0.5 * force
}
