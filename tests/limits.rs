//! Where increments end: small forces after large ones, surfaces without relief, forces at the limit of friction, drives far away, grids
//! that are to be found. Each is solved, by a closed form or a bound, or refused with the reason.

use std::f64::consts::PI;

use fret_core::case::{Attachments, Case};
use fret_core::history::History;
use fret_core::model::Zone;
use fret_core::plan::{LeaveOut, Plan};
use fret_core::run::{RunError, Silent, Simulation};
use fret_core::solver::Carried;
use fret_validation::{keeping, run, solved, solved_with};
use ndarray::Array2;

const RADIUS: f64 = 0.01;
const YOUNG: f64 = 210e9;
const POISSON: f64 = 0.3;

/// A rigid ball of 10 mm on steel, SI units.
fn ball(cells: usize, size: &str, friction: &str, loads: &str) -> String {
    format!(
        "[grid]\ncells = [{cells}, {cells}]\nsize = {size}\n[upper]\nrigid = true\n[lower]\n\
         substrate = {{ young = {YOUNG:e}, poisson = {POISSON} }}\n[profile.sphere]\nradius = {RADIUS:e}\n[friction]\n{friction}\n{loads}"
    )
}

/// Displacement of the origin of a half-space under a unit pressure on a square of side 1 around `(x, y)`, times `pi E / (1 - nu^2)`: Love's
/// integral of 1/r.
fn love(x: f64, y: f64) -> f64 {
    let corner = |x: f64, y: f64| x * (y / x.abs()).asinh() + y * (x / y.abs()).asinh();
    let [left, right, low, high] = [x - 0.5, x + 0.5, y - 0.5, y + 0.5];
    corner(right, high) - corner(left, high) - corner(right, low) + corner(left, low)
}

/// Approach of a rigid ball that four cells of a side `dx` around the middle carry, without friction.
fn approach_on_four_cells(force: f64, dx: f64) -> f64 {
    let pressure = force / (4.0 * dx * dx);
    let sum = love(0.0, 0.0) + 2.0 * love(1.0, 0.0) + love(1.0, 1.0);
    // The centres lie half a cell from the middle along both axes.
    dx * dx / (4.0 * RADIUS) + pressure * dx * (1.0 - POISSON * POISSON) / (PI * YOUNG) * sum
}

/// After a ramp to almost nothing the contact is smaller than a cell: the four cells in the middle carry it, on an even grid.
#[test]
fn unloading_to_a_small_force_leaves_the_four_cells_in_the_middle() {
    for (cells, size, friction, small, loads) in [
        (24, 1.8e-4, 0.01, 1.2e-3, "normal_force = 1.2e-3\nincrements = 3\n"),
        (24, 1.8e-4, 0.3, 1.2e-3, "normal_force = 1.2e-3\nincrements = 3\n"),
        (24, 1.8e-4, 1.0, 1.2e-3, "normal_force = 1.2e-3\nincrements = 5\n"),
        (32, 1.8e-4, 0.3, 1.2e-3, "normal_force = 1.2e-3\nincrements = 3\n"),
        (48, 1.8e-4, 0.01, 1.2e-4, "normal_force = 1.2e-4\nincrements = 8\n"),
        // a cycle: up by 11.9999 and down to what is left
        (24, 2.4e-4, 0.1, 1e-4, "normal_force = 11.9999\ncycles = 1\nincrements = 8\n"),
    ] {
        let text = ball(
            cells,
            &format!("[{size:e}, {size:e}]"),
            &format!("coefficient = {friction}"),
            &format!("[[load]]\nnormal_force = 12.0\nincrements = 3\n[[load]]\n{loads}"),
        );
        let history = solved(&text);
        let unloaded = history.steps.iter().filter(|step| step.stage == 1);
        let step = unloaded.min_by(|a, b| a.normal_force.total_cmp(&b.normal_force)).unwrap();
        assert!((step.normal_force / small - 1.0).abs() < 1e-6, "{}", step.normal_force);
        assert_eq!(step.contact_cells, 4, "{cells} {friction}");
        let exact = approach_on_four_cells(small, history.grid.spacing()[0]);
        // Shear of at most mu p in the other three cells moves the middle of one by at most 0.12 mu of what pressure does (from the integrals
        // of x / r^2 over them).
        let off = (step.approach - exact).abs() / (exact - history.grid.cell_area() / (4.0 * RADIUS));
        assert!(off < 0.12 * friction + 1e-6, "{cells} {friction}: {off}");
    }
}

/// Surfaces without relief in periodic contact.
fn flat(upper: &str, lower: &str, friction: &str, loads: &str) -> String {
    format!(
        "[grid]\ncells = [16, 16]\nsize = [1e-3, 1e-3]\nperiodic = true\n[upper]\n{upper}\n[lower]\n{lower}\n[profile.heights]\n\
         values = {{ array = 0 }}\nof = \"gap\"\n[friction]\n{friction}\n{}[[load]]\nnormal_force = 10.0\nincrements = 3\n{loads}",
        keeping(1)
    )
}

const STEEL: &str = "substrate = { young = 210e9, poisson = 0.3 }";

#[test]
fn flat_surfaces_in_periodic_contact_carry_even_tractions() {
    let coated = format!("coatings = [{{ thickness = 1e-4, young = 1e9, poisson = 0.4 }}]\n{STEEL}");
    let pulled = "[[load]]\ntangential_force = [1.5, 0.5]\nincrements = 2\n";
    for (upper, lower) in [("rigid = true", STEEL), (STEEL, STEEL), ("rigid = true", coated.as_str())] {
        let history =
            solved_with(&flat(upper, lower, "coefficient = 0.2", pulled), &[Array2::zeros((16, 16))]);
        let last = history.fields.last().unwrap();
        // P / A and Q / A, to the sums' rounding.
        let even = |field: &Array2<f64>, value: f64| field.iter().all(|p| (p / value - 1.0).abs() < 1e-12);
        assert!(even(last.pressure.as_ref().unwrap(), 1e7));
        let shear = last.shear.as_ref().unwrap();
        assert!(even(&shear[0], 1.5e6) && even(&shear[1], 5e5));
        let step = history.steps.last().unwrap();
        assert_eq!((step.contact_cells, step.stick_cells), (256, 256));
        assert!((step.contact_area / 1e-6 - 1.0).abs() < 1e-12 && step.approach.abs() < 1e-20);
    }
}

/// Relief of a millionth of an atom: the pressure is even up to what the relief makes of it, which is less than `E* 2 pi h / dx`.
#[test]
fn relief_that_is_next_to_nothing_is_next_to_nothing() {
    let relief = Array2::from_shape_fn((16, 16), |(i, j)| ((7 * i + 3 * j) % 5) as f64 * 2.5e-17);
    let history = solved_with(&flat("rigid = true", STEEL, "coefficient = 0.2", ""), &[relief]);
    let pressure = history.fields.last().unwrap().pressure.as_ref().unwrap();
    let most = YOUNG / (1.0 - POISSON * POISSON) * 2.0 * PI * 1e-16 / 6.25e-5;
    assert!(pressure.iter().all(|p| (p - 1e7).abs() < most), "{most}");
}

/// A textured surface: squares of two coefficients under an even pressure, of equal bodies, whose shear does not change it. What slips is at
/// its bound, and the contact slides once the force reaches the sum of all bounds.
#[test]
fn a_flat_surface_with_a_friction_map_slips_where_it_is_slippery() {
    let map = Array2::from_shape_fn((16, 16), |(i, j)| if (i / 4 + j / 4) % 2 == 0 { 0.1 } else { 0.3 });
    let text = |force: f64| {
        let pulled = format!("[[load]]\ntangential_force = [{force:?}, 0.0]\nincrements = 4\n");
        flat(STEEL, STEEL, "map = { array = 1 }", &pulled)
    };
    let arrays = [Array2::zeros((16, 16)), map.clone()];
    let history = solved_with(&text(1.99), &arrays);
    let last = history.fields.last().unwrap();
    assert!(last.pressure.as_ref().unwrap().iter().all(|p| (p / 1e7 - 1.0).abs() < 1e-12));
    let mut slipping = [0; 2];
    let shear = last.shear.as_ref().unwrap();
    for ((cell, &coefficient), zone) in map.indexed_iter().zip(last.zone.as_ref().unwrap()) {
        let fraction = shear[0][cell].hypot(shear[1][cell]) / (coefficient * 1e7);
        let slips = *zone == Zone::Slip;
        slipping[usize::from(coefficient > 0.2)] += usize::from(slips);
        // The residual of 1e-8 is that of all cells together.
        assert!(fraction < 1.0 + 1e-12 && (!slips || fraction > 1.0 - 1e-6), "{coefficient}: {fraction}");
    }
    // Of a force half a per cent below the limit the slippery half of the cells, 128, carries nearly all that it can.
    assert!(slipping[0] > 115 && slipping[0] >= slipping[1], "{slipping:?}");
    assert!((history.steps.last().unwrap().tangential_force[0] / 1.99 - 1.0).abs() < 1e-12);
    // 0.2 P in the mean
    let attachments = Attachments { arrays: &arrays, ..Attachments::none() };
    let case = Case::from_toml_with(&text(2.2), "case.toml", attachments).unwrap();
    let plan = Plan::new(case).unwrap();
    let refused = Simulation::new(&plan).run(&mut Silent).unwrap_err();
    let RunError::AboveSliding { increment, asked, bound, .. } = refused else { panic!("{refused}") };
    assert_eq!(increment, 6);
    assert!((asked / 2.2 - 1.0).abs() < 1e-12 && (bound / 2.0 - 1.0).abs() < 1e-9, "{asked} {bound}");
}

/// A tangential force of mu P: the contact slides, and no force tells how far; as near to it as rounding, too. A little below, the centre sticks
/// in a circle of `(1 - Q / mu P)^(1/3)` of the radius (Cattaneo), which is less than a cell: four cells or none of them.
#[test]
fn a_force_of_mu_p_slides_and_one_just_below_sticks_in_the_middle() {
    let text = |short: f64| {
        let pulled =
            format!("[[load]]\ntangential_force = [{:?}, 0.0]\nincrements = 4\n", 3.6 * (1.0 - short));
        ball(
            24,
            "[2e-4, 2e-4]",
            "coefficient = 0.3",
            &format!("[[load]]\nnormal_force = 12.0\nincrements = 3\n{pulled}"),
        )
    };
    for short in [0.0, 1e-14, 1e-12, 1e-10] {
        let refused = Case::from_toml(&text(short), "case.toml").unwrap_err().to_string();
        assert!(refused.contains("friction carries at most mu P = 3."), "{refused}");
        assert!(refused.contains("prescribe the shift to slide"), "{refused}");
    }
    for short in [1e-8, 1e-6] {
        let history = solved(&text(short));
        let step = history.steps.last().unwrap();
        assert!(step.stick_cells <= 4, "{}", step.stick_cells);
        assert!((step.tangential_force[0] / 3.6 - 1.0).abs() < 2e-6);
    }
}

/// Where the shear strength of the interface limits the force, it is named; the strength acts over the width `2 a` of Hertz's strip but for
/// the cells at its edge.
#[test]
fn a_force_above_the_shear_strength_is_refused_for_it() {
    let strength = 1e6;
    let line = format!(
        "[grid]\ncells = 64\nsize = \"auto\"\n[upper]\nrigid = true\n[lower]\n{STEEL}\n[profile.cylinder]\nradius = 0.01\naxis = \"y\"\n\
         [friction]\ncoefficient = 0.5\nmax_shear = {strength:e}\n[[load]]\nnormal_force = 1e4\nincrements = 4\n\
         [[load]]\ntangential_force = [2e3, 0.0]\nincrements = 4\n"
    );
    let modulus = YOUNG / (1.0 - POISSON * POISSON);
    let half_width = (4.0 * 1e4 * RADIUS / (PI * modulus)).sqrt();
    let point = ball(
        24,
        "\"auto\"",
        &format!("coefficient = 0.3\nmax_shear = {strength:e}"),
        "[[load]]\nnormal_force = 12.0\nincrements = 3\n[[load]]\ntangential_force = [2.0, 0.0]\nincrements = 4\n",
    );
    let radius = (0.75 * 12.0 * RADIUS / modulus).cbrt();
    for (text, carried) in [(line, 2.0 * half_width * strength), (point, PI * radius * radius * strength)] {
        let refused = run(&text).unwrap_err();
        let words = refused.to_string();
        assert!(
            words.contains("mu P and the shear strength of the interface (friction.max_shear)"),
            "{words}"
        );
        let RunError::AboveSliding { bound, by: Carried::Strength, .. } = refused else { panic!("{words}") };
        // Cells of a twentieth of the width: half of one at each edge.
        assert!((bound / carried - 1.0).abs() < 0.1, "{bound} {carried}");
    }
}

/// One cell in contact turns on its own centre: its uniform shear has no moment, and slipping or not it carries none.
#[test]
fn one_cell_carries_no_moment() {
    let text = ball(
        9,
        "[1e-2, 1e-2]",
        "coefficient = 0.3",
        "[[load]]\nnormal_force = 12.0\nincrements = 3\n[[load]]\ntwist_moment = 1e-6\nincrements = 3\n",
    );
    let refused = run(&text).unwrap_err();
    assert!(matches!(refused, RunError::AboveFullSlip { fraction, .. } if fraction < 1e-6), "{refused}");
}

/// Through a spring the contact slides behind a far end as far as it is pulled: `shift = actuator - mu P / k`, whatever the distance; a far end
/// at a thousand contact radii in one increment or a million.
#[test]
fn a_contact_follows_the_far_end_of_a_spring_anywhere() {
    for (stiffness, far, normal, increments) in [
        (1e7, 0.1, 12.0, 4),
        (1e7, 1.0, 12.0, 4),
        (1e4, 0.1, 12.0, 1),
        (1e10, 0.1, 12.0, 4),
        (1e7, 1e-6, 1.2e-5, 4),
    ] {
        let friction = format!("coefficient = 0.3\n[rig]\ntangential_stiffness = {stiffness:e}");
        let loads = format!(
            "[[load]]\nnormal_force = {normal:e}\nincrements = 3\n[[load]]\nactuator = [{far:e}, 0.0]\nincrements = {increments}\n"
        );
        let history = solved(&ball(24, "\"auto\"", &friction, &loads));
        for step in history.steps.iter().filter(|step| step.stage == 1) {
            let done = (step.increment - 2) as f64 / f64::from(increments);
            let expected = far * done - 0.3 * normal / stiffness;
            // The force is that of full sliding to the residual, and shifts are rounded at the far end's size.
            let rounding = 1e-15 * far + 1e-7 * 0.3 * normal / stiffness;
            assert!(
                (step.shift[0] - expected).abs() < rounding,
                "{far} {stiffness}: {} {expected}",
                step.shift[0]
            );
            assert!((step.tangential_force[0] / (0.3 * normal) - 1.0).abs() < 1e-7);
        }
    }
}

/// At a prescribed approach the normal force falls while a film that keeps its volume is dragged along: a force above that of sliding, which
/// a run by shift shows, is refused for it, and one below is carried.
#[test]
fn a_force_that_sliding_takes_the_pressure_from_is_refused_for_it() {
    let text = |load: &str| {
        format!(
            "[grid]\ncells = [48, 48]\nsize = [1.6e-3, 1.6e-3]\n[upper]\nrigid = true\n[lower]\n\
             coatings = [{{ thickness = 2e-4, young = 1e6, poisson = 0.5 }}]\nbase = \"rigid\"\n[profile.sphere]\nradius = 0.01\n\
             [friction]\ncoefficient = 0.8\n[[load]]\napproach = 1e-5\nincrements = 4\n[[load]]\n{load}\n"
        )
    };
    let by_shift = solved(&text("shift = [6e-5, 0.0]\nincrements = 12"));
    let most = by_shift.steps.iter().map(|step| step.tangential_force[0]).fold(0.0, f64::max);
    let by_force = solved(&text(&format!("tangential_force = [{:e}, 0.0]\nincrements = 4", 0.97 * most)));
    assert!((by_force.steps.last().unwrap().tangential_force[0] / most - 0.97).abs() < 1e-7);
    let refused =
        run(&text(&format!("tangential_force = [{:e}, 0.0]\nincrements = 4", 1.05 * most))).unwrap_err();
    let RunError::AboveSliding { increment: 7, bound, .. } = refused else { panic!("{refused}") };
    assert!((bound / most - 1.0).abs() < 0.01, "{bound} {most}");
}

/// A rigid ball on a half-space that couples, 24 x 24 cells, with friction that differs from cell to cell.
fn on_patches(coefficient: impl Fn(usize, usize) -> f64, loads: &str) -> String {
    let rows: Vec<String> =
        (0..24).map(|i| format!("{:?}", (0..24).map(|j| coefficient(i, j)).collect::<Vec<f64>>())).collect();
    format!(
        "[grid]\ncells = [24, 24]\nsize = [3.0, 3.0]\n[upper]\nrigid = true\n[lower]\nsubstrate = {{ young = 100.0, poisson = 0.0 }}\n\
         [profile.sphere]\nradius = 10.0\n[friction]\nmap = [{}]\n[[load]]\nnormal_force = 5.0\nincrements = 2\n{loads}",
        rows.join(", ")
    )
}

/// Where a contact on patches slides, pressure goes over from one to another, and with it the centre of rotation: a moment beside a force is
/// carried up to the one that a prescribed twist slides under, and refused for that number above it.
#[test]
fn a_moment_beside_a_force_is_carried_up_to_that_of_a_twist() {
    let text = |load: &str| {
        let coefficient = |i: usize, j: usize| if i + j < 20 { 1.2 } else { 0.2 };
        let force = "[[load]]\ntangential_force = [1.33666, 0.0]\nincrements = 2\n";
        on_patches(coefficient, &format!("{force}[[load]]\n{load}\n"))
    };
    let by_twist = solved(&text("twist = 0.3\nincrements = 12"));
    let most = by_twist.steps.iter().map(|step| step.twist_moment).fold(0.0, f64::max);
    for share in [0.97, 0.985, 0.993] {
        let carried = solved(&text(&format!("twist_moment = {:e}\nincrements = 1", share * most)));
        assert!((carried.steps.last().unwrap().twist_moment / most - share).abs() < 1e-7);
    }
    let refused = run(&text(&format!("twist_moment = {:e}\nincrements = 1", 1.03 * most))).unwrap_err();
    let RunError::AboveFullSlip { fraction, .. } = refused else { panic!("{refused}") };
    // the force stays in the twist that slides, and falls in proportion to the moment in what is refused: a little apart
    assert!((fraction * 1.03 - 1.0).abs() < 0.01, "{fraction}");
}

/// A force whose contact may turn slides at less than the sum of the bounds: what is above that is refused for it, however little.
#[test]
fn a_force_that_turns_the_contact_is_refused_above_that_of_a_shift() {
    let text = |load: &str| {
        let coefficient = |i: usize, _: usize| if i < 12 { 0.6 } else { 0.1 };
        on_patches(coefficient, &format!("[[load]]\ntwist_moment = 0.0\n{load}\n"))
    };
    let by_shift = solved(&text("shift = [0.3, 0.0]\nincrements = 12"));
    let most = by_shift.steps.iter().map(|step| step.tangential_force[0]).fold(0.0, f64::max);
    let carried = solved(&text(&format!("tangential_force = [{:e}, 0.0]\nincrements = 4", 0.998 * most)));
    assert!((carried.steps.last().unwrap().tangential_force[0] / most - 0.998).abs() < 1e-7);
    let refused =
        run(&text(&format!("tangential_force = [{:e}, 0.0]\nincrements = 4", 1.003 * most))).unwrap_err();
    let RunError::AboveSliding { bound, .. } = refused else { panic!("{refused}") };
    // what slides may carry 0.1 % less than the peak on the way
    assert!((bound / most - 1.0).abs() < 2e-3, "{bound} {most}");
}

/// A force a thousandth above what a shear strength carries is refused for the force of sliding, not for that of a contact that fell apart on the
/// way of the iteration.
#[test]
fn a_force_just_above_a_shear_strength_is_refused_for_that_of_a_shift() {
    let text = |load: &str| {
        let friction = "[friction]\ncoefficient = 0.5\nmax_shear = 1.2\n";
        let map = on_patches(|_, _| 0.5, &format!("[[load]]\n{load}\n"));
        let (from, to) = (map.find("[friction]").unwrap(), map.find("[[load]]").unwrap());
        format!("{}{friction}{}", &map[..from], &map[to..])
    };
    let by_shift = solved(&text("shift = [0.3, 0.0]\nincrements = 12"));
    let most = by_shift.steps.iter().map(|step| step.tangential_force[0]).fold(0.0, f64::max);
    for share in [1.0009, 1.002, 1.01] {
        let refused =
            run(&text(&format!("tangential_force = [{:e}, 0.0]\nincrements = 4", share * most))).unwrap_err();
        let RunError::AboveSliding { bound, .. } = refused else { panic!("{refused}") };
        assert!((bound / most - 1.0).abs() < 2e-3, "{bound} {most}");
    }
}

/// Coefficients of 20 to 50 stand for full stick to 1 % of the shift: so says the advice where a larger one is not solved.
#[test]
fn coefficients_of_twenty_and_more_stand_for_full_stick() {
    let shift = |coefficient: f64| {
        let loads = "[[load]]\nnormal_force = 12.0\nincrements = 4\n[[load]]\ntangential_force = [2.0, 0.5]\nincrements = 2\n";
        let film = "coatings = [{ thickness = 5e-5, young = 420e9, poisson = 0.2 }]\nsubstrate";
        let text = ball(24, "\"auto\"", &format!("coefficient = {coefficient}"), loads);
        let history = run(&text.replace("substrate", film)).map_err(|error| error.to_string());
        history.map(|history| history.steps.last().unwrap().shift[0])
    };
    let stuck = shift(100.0).unwrap();
    for coefficient in [20.0, 50.0] {
        let found = shift(coefficient).unwrap();
        assert!((found / stuck - 1.0).abs() < 0.01, "{coefficient}: {found} {stuck}");
    }
    if let Err(refused) = shift(1000.0) {
        assert!(refused.contains("one of 20 to 50 comes within 1 % of it"), "{refused}");
    }
}

/// A triangular pyramid reaches as far again along one side as along the other: the automatic grid holds both.
#[test]
fn automatic_sizes_hold_triangular_pyramids() {
    for indenter in ["berkovich", "cube_corner"] {
        for load in ["approach = 0.1", "normal_force = 20.0"] {
            let text = format!(
                "[grid]\ncells = [48, 48]\nsize = \"auto\"\n[upper]\nrigid = true\n[lower]\nsubstrate = {{ young = 210.0, poisson = 0.3 }}\n\
                 [profile.pyramid]\nindenter = \"{indenter}\"\n[[load]]\n{load}\nincrements = 2\n"
            );
            let history = solved(&text);
            assert!(history.steps.iter().all(|step| step.footprint.free >= 1), "{indenter} {load}");
        }
    }
}

/// A film that keeps its volume is dragged to one side by shear: the automatic grid holds its contact while it slides.
#[test]
fn automatic_sizes_hold_soft_films_that_slide() {
    for (poisson, thickness, friction, load) in [
        (0.5, 2e-4, 0.8, "normal_force = 0.02"),
        (0.5, 2e-4, 1.5, "approach = 1e-5"),
        (0.49, 5e-4, 1.5, "normal_force = 0.02"),
    ] {
        let text = format!(
            "[grid]\ncells = [48, 48]\nsize = \"auto\"\n[upper]\nrigid = true\n[lower]\n\
             coatings = [{{ thickness = {thickness:e}, young = 1e6, poisson = {poisson} }}]\nbase = \"rigid\"\n[profile.sphere]\nradius = 0.01\n\
             [friction]\ncoefficient = {friction}\n[[load]]\n{load}\nincrements = 4\n[[load]]\nshift = [2e-5, 0.0]\nincrements = 6\n"
        );
        let history = solved(&text);
        assert!(history.steps.iter().all(|step| step.footprint.free >= 1));
    }
}

/// Few cells have wide edges: what a fifth of the width leaves free is less than half a cell of four.
/// Friction of three times the pressure moves the contact of elastically dissimilar bodies while it slides: none of it at the grid's edge.
#[test]
fn automatic_sizes_hold_strong_friction_that_slides() {
    let loads = "[[load]]\nnormal_force = 12.0\nincrements = 3\n[[load]]\nshift = [1e-5, 0.0]\ncycles = 1\nincrements = 8\n";
    for cells in [24, 48] {
        let history = solved(&ball(cells, "\"auto\"", "coefficient = 3.0", loads));
        assert!(history.steps.iter().all(|step| step.footprint.free >= 1));
        // of 3 P = 36 N all but what a few cells that still stick may carry more
        let pulled = history.steps.iter().map(|step| step.tangential_force[0].abs()).fold(0.0, f64::max);
        assert!(pulled > 35.9 && pulled < 36.0 + 1e-6, "{pulled}");
    }
}

#[test]
fn automatic_sizes_hold_contacts_of_four_cells() {
    for cells in [4, 5, 6] {
        let loads = "[[load]]\nnormal_force = 12.0\nincrements = 3\n[[load]]\ntangential_force = [2.0, 0.0]\nincrements = 3\n";
        let history = solved(&ball(cells, "\"auto\"", "coefficient = 0.3", loads));
        assert!((history.steps.last().unwrap().normal_force / 12.0 - 1.0).abs() < 1e-12);
    }
}

/// Where the contact cannot be looked for, the size is refused for what stands in the way.
#[test]
fn an_automatic_size_is_refused_for_the_true_mistake() {
    let press = "[[load]]\nnormal_force = 12.0\nincrements = 3\n";
    let film = ball(24, "\"auto\"", "coefficient = 0.3", press).replace(
        "substrate = { young = 2.1e11, poisson = 0.3 }",
        "coatings = [{ thickness = 1e-6, young = 1e6, poisson = 0.5 }]\nbase = \"rigid\"",
    );
    let line = "[grid]\ncells = 24\nsize = \"auto\"\ndatum = 1e-30\n[upper]\nrigid = true\n[lower]\n\
                substrate = { young = 210e9, poisson = 0.3 }\n[profile.cylinder]\nradius = 0.01\naxis = \"y\"\n[[load]]\nnormal_force = 1e4\nincrements = 3\n";
    let apart = ball(24, "\"auto\"", "coefficient = 0.3", "[[load]]\nnormal_force = 0.0\nincrements = 3\n");
    for (text, words) in [
        (film.as_str(), "a nearly incompressible film on a stiff base is thinner than a fifth of a cell"),
        (line, "grid.datum = 1e-30 must lie between a thousandth and 1e12 of the size of the grid"),
        (apart.as_str(), "no contact was found under the heaviest load"),
    ] {
        let refused = Plan::new(Case::from_toml(text, "case.toml").unwrap()).unwrap_err().to_string();
        assert!(refused.contains(words), "{refused}");
    }
}

fn planned(text: &str, leave_out: LeaveOut) -> History {
    let plan = Plan::leaving_out(Case::from_toml(text, "case.toml").unwrap(), leave_out).unwrap();
    Simulation::new(&plan).run(&mut Silent).unwrap()
}

/// A wave that is nearly pressed flat leaves gaps of two cells that are each other's mirror images, which tell nothing of the edge: the area is
/// that of the cells in contact, with and without a mirror between them.
#[test]
fn the_contact_area_of_a_wave_is_the_same_with_and_without_simplifications() {
    let text = "[grid]\ncells = [16, 16]\nsize = [1e-3, 1e-3]\nperiodic = true\n[upper]\nrigid = true\n[lower]\n\
                substrate = { young = 21e9, poisson = 0.3 }\n[profile.wave]\namplitude = 1e-7\nwavelength_x = 1e-3\nwavelength_y = 1e-3\n\
                [friction]\ncoefficient = 0.2\n[[load]]\nnormal_force = 10.0\nincrements = 3\n";
    let [short, full] = [LeaveOut::ALL, LeaveOut::NONE].map(|leave_out| planned(text, leave_out));
    for (one, other) in short.steps.iter().zip(&full.steps) {
        assert!(
            (one.contact_area / other.contact_area - 1.0).abs() < 1e-7,
            "{} {}",
            one.contact_area,
            other.contact_area
        );
    }
    // 256 cells per side: 9.766e-7 and 7.969e-7. A cell at each of eight corners is 3 %.
    assert!((full.steps[2].contact_area / 9.766e-7 - 1.0).abs() < 0.02);
    assert!((full.steps[1].contact_area / 7.969e-7 - 1.0).abs() < 0.02);
}
