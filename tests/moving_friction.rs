//! Friction of a body that moves: what slip does to the coefficient, and what wears under it, belong to the places of the body whose map it is. Judged
//! by integrals of Hertz' pressure along the way, by exchanging the bodies, and by the shifted problem.

use std::f64::consts::PI;

use fret_core::case::{Attachments, Case};
use fret_core::history::{History, Start};
use fret_core::plan::{LeaveOut, Plan};
use fret_validation::{off_first_law, solved, solved_with};
use ndarray::Array2;

const FINITE: &str = "[kinematics]\ndisplacement = \"finite\"\n";
const RIGID: &str = "rigid = true";
const UPPER: &str = "moves_with = \"upper\"";

/// A cylinder of R = 100 and E* = 1 on a rigid flat, of the half-width 0.4, on cells of 0.025; friction of a thousandth, so that the contact gives by
/// a millionth of the way that it slides.
const HALF_WIDTH: f64 = 0.4;
const CELLS: usize = 128;
const FRICTION: f64 = 1e-3;
/// The way is from -REACH to REACH.
const REACH: f64 = 0.6;

fn force() -> f64 {
    PI * HALF_WIDTH * HALF_WIDTH / 400.0
}

/// Hertz' pressure up to a place, of the whole.
fn up_to(x: f64) -> f64 {
    let x = (x / HALF_WIDTH).clamp(-1.0, 1.0);
    0.5 + (x.asin() + x * (1.0 - x * x).sqrt()) / PI
}

/// The upper body is brought to one end of its way, pressed, slid to the other end cell by cell, lifted, and brought back.
fn slid([upper, lower]: [&str; 2], cylinder: &str, friction: &str, (way, more): (f64, &str)) -> String {
    format!(
        "[grid]\ncells = {CELLS}\nsize = 3.2\n[upper]\n{upper}\n[lower]\n{lower}\n[{cylinder}.cylinder]\nradius = 100.0\naxis = \"y\"\n\
         [friction]\n{friction}\n[solver]\ntolerance = 1e-9\n{FINITE}{more}\
         [[load]]\nnormal_force = 0.0\nshift = [{:?}, 0.0]\nincrements = 1\n[[load]]\nnormal_force = {:?}\nincrements = 4\n\
         [[load]]\nshift = [{way:?}, 0.0]\nincrements = 48\n[[load]]\nnormal_force = 0.0\nincrements = 1\n\
         [[load]]\nshift = [0.0, 0.0]\nincrements = 1\n",
        -way,
        force()
    )
}

/// The coefficient over what it was, less 1, at the places of the cells.
fn rise(history: &History) -> Vec<[f64; 2]> {
    let friction = history.fields.last().unwrap().friction.as_ref().unwrap();
    (0..CELLS).map(|i| [history.grid.centre(0, i), friction[[i, 0]] / FRICTION - 1.0]).collect()
}

/// What is expected at the places of a body.
type Expected<'a> = &'a dyn Fn(f64) -> f64;

/// Histories of a flat and a cylinder whose friction evolves by a law, each of them once the lower body, whose places friction belongs to by default, and
/// once the upper one; with what is expected of the places of a flat, over which the cylinder has passed, and of a cylinder, which has stayed under it.
fn evolved<'a>(law: &str, [passed, stayed]: [Expected<'a>; 2]) -> [(&'static str, History, Expected<'a>); 4] {
    let elastic = "substrate = { young = 0.91, poisson = 0.3 }";
    let kept = "[output]\nfields = [\"friction\"]\n";
    let history = |bodies, cylinder: &str, whose: &str, way| {
        let friction = format!("coefficient = {FRICTION}\n{whose}\nevolution = {{ {law} }}");
        solved(&slid(bodies, cylinder, &friction, (way, kept)))
    };
    let (below, above) = ([elastic, RIGID], [RIGID, elastic]);
    [
        ("flat below", history(below, "upper.profile", "", REACH), passed),
        ("flat above", history(above, "lower.profile", UPPER, -REACH), passed),
        ("cylinder below", history(above, "lower.profile", "", -REACH), stayed),
        ("cylinder above", history(below, "upper.profile", UPPER, REACH), stayed),
    ]
}

/// A cylinder passes over a flat whose coefficient rises with the energy of its places: each has what the pressure was over it, by Hertz. It is one
/// thing whether the flat lies below, or is the upper body and slides over the cylinder the other way. Were friction that of the cylinder, its places
/// would have their pressure times the way.
#[test]
fn places_of_the_body_that_friction_belongs_to_remember_what_passed_over_them() {
    // doubled by the energy of all of the pressure
    let of_all = FRICTION * force();
    let law =
        format!("by = \"energy\", table = [[0, {FRICTION}], [{:e}, {:e}]]", 4.0 * of_all, 5.0 * FRICTION);
    let passed = |x: f64| up_to(x + REACH) - up_to(x - REACH);
    let stayed = |x: f64| {
        let part = (1.0 - (x / HALF_WIDTH).powi(2)).max(0.0).sqrt();
        2.0 * part / (PI * HALF_WIDTH) * 2.0 * REACH
    };
    for (name, history, expected) in evolved(&law, [&passed, &stayed]) {
        let (mut largest, mut middle) = (0.0_f64, 0.0_f64);
        for [x, found] in rise(&history) {
            let off = (found - expected(x)).abs();
            // The last cell at either edge of Hertz' pressure, which begins with an upright tangent, is known to a part of itself.
            let at_edge = (x.abs() - HALF_WIDTH).abs() < 0.05;
            if name.starts_with("flat") || !at_edge {
                largest = largest.max(off);
            }
            if name.starts_with("flat") && x.abs() < 0.15 {
                middle = middle.max(off);
            }
        }
        println!("friction that evolves, {name}: off by {largest:.1e}, where all has passed {middle:.1e}");
        // Sixteen cells over the half-width. Where all has passed it is the force, which cells add up to.
        assert!(largest < 5e-3 && middle < 1e-4, "{name}: {largest:e} {middle:e}");
        assert!(off_first_law(&history, 0.0) < 1e-9, "{name}: {:e}", off_first_law(&history, 0.0));
    }
}

/// The same by slip distance: a place of the flat slips as long as the contact is over it, one of the cylinder all the way. Both edges of the contact
/// lie between cells, of which 32 are in contact, and an increment is a cell.
#[test]
fn places_remember_the_way_that_slid_over_them() {
    // doubled where all of the contact has passed
    let law = format!(
        "by = \"slip_distance\", table = [[0, {FRICTION}], [{:e}, {:e}]]",
        8.0 * HALF_WIDTH,
        5.0 * FRICTION
    );
    let passed = |x: f64| {
        let (first, last) = ((x - HALF_WIDTH).max(-REACH), (x + HALF_WIDTH).min(REACH));
        (last - first).max(0.0) / (2.0 * HALF_WIDTH)
    };
    let stayed = |x: f64| if x.abs() < HALF_WIDTH { REACH / HALF_WIDTH } else { 0.0 };
    for (name, history, expected) in evolved(&law, [&passed, &stayed]) {
        let largest = rise(&history)
            .into_iter()
            .fold(0.0_f64, |largest, [x, found]| largest.max((found - expected(x)).abs()));
        println!("slip distance, {name}: off by {largest:.1e}");
        // The pressure moves a place along the surface while it passes, by (1 - 2 nu)(1 + nu) P / E = 7.2e-4 at the most, of 0.8. Counted whole in the
        // increments in which the contact comes and goes, a place would have slipped by another cell, 0.031.
        assert!(largest < 9e-4, "{name}: {largest:e}");
    }
}

/// A flat whose coefficient rises evenly along x slides over a cylinder, and both wear by their energy. A place of the flat loses its own coefficient
/// times the pressure that passes over it, a place of the cylinder its pressure times the coefficients that pass over it, whose mean is that over it
/// half-way. The friction law is that at either end of an increment: of the last alone would make it half a cell of the flat, 0.6 %.
#[test]
fn both_bodies_wear_by_the_friction_that_passes_over_them() {
    const SLOPE: f64 = 0.5;
    let coefficient = 1e-4;
    let wears = |body: &str| body.replace(" }", &format!(", wear_coefficient = {coefficient:e} }}"));
    // incompressible, so that shear does not move the pressure
    let elastic = wears("substrate = { young = 0.75, poisson = 0.5 }");
    let rigid = format!("{RIGID}\nwear_coefficient = {coefficient:e}");
    let spacing = 3.2 / CELLS as f64;
    let at = |i: usize| (i as f64 - (CELLS as f64 - 1.0) / 2.0) * spacing;
    let map: Vec<f64> = (0..CELLS).map(|i| FRICTION * (1.0 + SLOPE * at(i))).collect();
    let friction = format!("map = {map:?}\n{UPPER}");
    let more = "[wear]\n[output]\nfields = [\"worn_depth\", \"pressure\"]\nevery = 1\n";
    let history = solved(&slid([&rigid, &elastic], "lower.profile", &friction, (REACH, more)));
    let [lower, upper] = history.fields.last().unwrap().own_worn_depth.clone().unwrap();
    // The last increment before it slides; wear changes nothing of it.
    let pressure = history.fields_of(4).unwrap().pressure.clone().unwrap();
    let whole = coefficient * FRICTION * force();
    let (mut of_lower, mut of_upper) = (0.0_f64, 0.0_f64);
    for i in 0..CELLS {
        let x = at(i);
        let expected = coefficient * pressure[[i, 0]] * FRICTION * (1.0 + SLOPE * x) * 2.0 * REACH;
        of_lower = of_lower.max((lower[[i, 0]] - expected).abs() / (whole / HALF_WIDTH));
        let expected = (1.0 + SLOPE * x) * (up_to(x + REACH) - up_to(x - REACH));
        of_upper = of_upper.max((upper[[i, 0]] / whole - expected).abs());
    }
    let energy = history.steps.last().unwrap().dissipated_energy;
    let off = energy / (FRICTION * force() * 2.0 * REACH) - 1.0;
    println!(
        "friction that moves: lower body off by {of_lower:.1e}, upper by {of_upper:.1e}, energy by {off:.1e}"
    );
    // What the contact gives, and for the upper body sixteen cells over the half-width.
    assert!(of_lower < 1e-4 && of_upper < 8e-3 && off.abs() < 1e-4, "{of_lower:e} {of_upper:e} {off:e}");
    for scar in [&lower, &upper] {
        let area = scar.sum() * history.grid.cell_area();
        // sums of the same numbers
        assert!((area / (coefficient * energy) - 1.0).abs() < 1e-11, "{area:e}");
    }
}

/// A ball over a flat whose friction evolves, cycle by cycle; the flat is the lower body, or the upper one and friction goes with it.
fn fretted([upper, lower]: [&str; 2], profile: &str, friction: &str, (cells, sign): (usize, f64)) -> History {
    let spacing = 3.2 / cells as f64;
    solved(&format!(
        "[grid]\ncells = [{cells}, {cells}]\nsize = [3.2, 3.2]\n[upper]\n{upper}\n[lower]\n{lower}\n[{profile}.sphere]\nradius = 100.0\n\
         [friction]\n{friction}\n[solver]\ntolerance = 1e-9\nintegration = \"end_point\"\n{FINITE}\
         [output]\nfields = [\"friction\", \"pressure\"]\nevery = 16\n[[load]]\nnormal_force = 1.0e-2\nincrements = 4\n\
         [[load]]\nshift = [{:?}, 0.0]\ncycles = 4\nincrements = 16\n",
        sign * 4.0 * spacing
    ))
}

/// Friction that evolves from cycle to cycle, under a ball that slides to and fro by whole cells: with the bodies exchanged all is the same, to what
/// the bodies give, which their points begin to slip by at other times. That is in proportion to friction.
#[test]
fn friction_evolves_alike_with_the_bodies_exchanged() {
    const SIDE: usize = 48;
    let elastic = "substrate = { young = 1.0, poisson = 0.0 }";
    for (coefficient, bounds) in [(0.3, [5e-4, 2e-3]), (3e-3, [5e-6, 2e-5])] {
        // a fourth of what a cycle does in the middle
        for (driver, scale) in [("energy", 4.6e-3 * coefficient), ("slip_distance", 0.8)] {
            let law = format!("by = \"{driver}\", last = {:e}, scale = {scale:e}", 2.0 * coefficient);
            let friction =
                |whose: &str| format!("coefficient = {coefficient:e}\n{whose}\nevolution = {{ {law} }}");
            let below = fretted([elastic, RIGID], "upper.profile", &friction(""), (SIDE, 1.0));
            let above = fretted([RIGID, elastic], "lower.profile", &friction(UPPER), (SIDE, -1.0));
            let mut cycles = 0.0_f64;
            for (one, other) in below.cycles.iter().zip(&above.cycles) {
                let pairs = [
                    (one.friction_coefficient, other.friction_coefficient),
                    (one.dissipated_energy, other.dissipated_energy),
                ];
                for (a, b) in pairs {
                    cycles = cycles.max((a / b - 1.0).abs());
                }
            }
            let [one, other] =
                [&below, &above].map(|history| history.fields.last().unwrap().friction.clone().unwrap());
            let rise = largest(&(&one / coefficient - 1.0));
            let map = largest(&(&one - &other)) / coefficient;
            println!(
                "exchanged, mu = {coefficient}, by {driver}: cycles off by {cycles:.1e}, the map by {map:.1e} of {rise:.2}"
            );
            assert!(rise > 0.5 && cycles < bounds[0] && map < bounds[1], "{cycles:e} {map:e} {rise}");
        }
    }
}

/// Heights of a ball with ripples, and a friction map, on cells of 0.05.
fn rough(cells: usize) -> [Array2<f64>; 2] {
    let at = |index: usize| (index as f64 - (cells as f64 - 1.0) / 2.0) * 0.05;
    let heights = Array2::from_shape_fn((cells, cells), |(i, j)| {
        let (x, y) = (at(i), at(j));
        -(x * x + y * y) / 200.0 + 2e-4 * (7.0 * x + 1.0).sin() * (5.0 * y).cos()
    });
    let friction = Array2::from_shape_fn((cells, cells), |(i, j)| 0.2 + 0.01 * ((i + 3 * j) % 7) as f64);
    [heights, friction]
}

/// A rough body, whose friction map goes with it and evolves, pressed and rubbed.
fn rubbed([heights, map]: &[Array2<f64>; 2], settings: &str, [first, shift]: [[f64; 2]; 2]) -> History {
    let cells = heights.dim().0;
    let text = format!(
        "[grid]\ncells = [{cells}, {cells}]\nsize = [{size:?}, {size:?}]\n[upper]\nrigid = true\n[upper.profile.heights]\nvalues = {{ array = 0 }}\n\
         [lower]\nsubstrate = {{ young = 1.0, poisson = 0.2 }}\n[solver]\ntolerance = 1e-9\n[output]\nevery = 1\nfields = [\"pressure\", \"shear\", \"friction\"]\n\
         [friction]\nmap = {{ array = 1 }}\nevolution = {{ by = \"energy\", last = 0.5, scale = 1e-8 }}\n{settings}\
         [[load]]\nnormal_force = 0.0\nshift = {first:?}\nincrements = 1\n[[load]]\nnormal_force = 3e-3\nincrements = 3\n\
         [[load]]\nshift = {shift:?}\nincrements = 2\n[[load]]\nshift = {first:?}\nincrements = 2\n",
        size = cells as f64 * 0.05
    );
    solved_with(&text, &[heights.clone(), map.clone()])
}

fn largest(field: &Array2<f64>) -> f64 {
    field.iter().fold(0.0_f64, |most, value| most.max(value.abs()))
}

/// Brought over by whole cells and then rubbed, friction that evolves is that of the shifted problem: to the bit before it slides, and then to what
/// the way from 0.15 to 0.1502 is rounded.
#[test]
fn moved_by_whole_cells_friction_evolves_as_in_the_shifted_problem() {
    const CELLS: usize = 40;
    let own = rough(CELLS);
    let moved = |field: &Array2<f64>, unknown: f64| {
        Array2::from_shape_fn((CELLS, CELLS), |(i, j)| {
            let there = i.checked_sub(3).and_then(|i| field.get((i, j + 2)));
            there.copied().unwrap_or(unknown)
        })
    };
    let there = rubbed(&own, &format!("moves_with = \"upper\"\n{FINITE}"), [[0.15, -0.1], [0.1502, -0.1]]);
    // Where the body that is moved is not known, the other one is far away.
    let placed = [moved(&own[0], -1e8), moved(&own[1], 0.2)];
    let here = rubbed(&placed, "", [[0.0, 0.0], [2e-4, 0.0]]);
    let touches = here.fields_of(3).unwrap().pressure.clone().unwrap().mapv(|p| f64::from(u8::from(p > 0.0)));
    for step in 3..8 {
        let [one, other] = [&there, &here].map(|history| history.fields_of(step).unwrap());
        let [a, b] = [one, other].map(|kept| kept.friction.as_ref().unwrap() * &touches);
        if step == 3 {
            assert_eq!((&one.pressure, &one.shear, &a), (&other.pressure, &other.shear, &b));
        }
        assert!(largest(&(&a - &b)) < 1e-6, "{step}: {:e}", largest(&(&a - &b)));
        if step > 5 {
            let first = &moved(&own[1], 0.2) * &touches;
            assert!(largest(&(&a - &first)) > 0.01, "friction has changed");
        }
    }
}

/// Less than a hundredth of a cell is no motion: to the bit the friction of surfaces that stay.
#[test]
fn friction_that_moves_by_less_than_a_hundredth_of_a_cell_stays() {
    let own = rough(32);
    let ways = [[0.0, 0.0], [0.0099 * 0.05, 0.0]];
    let moving = rubbed(&own, &format!("moves_with = \"upper\"\n{FINITE}"), ways);
    let still = rubbed(&own, "", ways);
    let [one, other] = [&moving, &still].map(|history| history.fields.last().unwrap());
    assert_eq!((&one.friction, &one.pressure, &one.shear), (&other.friction, &other.pressure, &other.shear));
    assert_eq!(moving.state.accumulated, still.state.accumulated);
}

/// A state remembers the slip of the places of one body: a case whose friction belongs to the other one cannot start from it.
#[test]
fn another_history_cannot_give_the_memory_of_a_body_to_the_other_one() {
    let text = |whose: &str, loads: &str| {
        format!(
            "[grid]\ncells = 48\nsize = 2.0\ndatum = 10.0\n[upper]\nrigid = true\n[lower]\nsubstrate = {{ young = 1.0, poisson = 0.2 }}\n\
             [profile.cylinder]\nradius = 100.0\naxis = \"y\"\n[friction]\ncoefficient = 0.3\n{whose}\n\
             evolution = {{ by = \"slip_distance\", last = 0.5, scale = 0.1 }}\n{FINITE}{loads}\
             [[load]]\nshift = [0.1, 0.0]\nincrements = 4\n"
        )
    };
    let first = solved(&text(UPPER, "[[load]]\nnormal_force = 2e-3\nincrements = 2\n"));
    let start = std::sync::Arc::new(Start::of(&first, first.steps.last().unwrap().increment).unwrap());
    let planned = |whose: &str| {
        let attachments = Attachments { start: Some(start.solved.loads), ..Attachments::none() };
        let case = Case::from_toml_with(&text(whose, ""), "case.toml", attachments).unwrap();
        Plan::starting_from(Some(start.clone()), case, LeaveOut::ALL).map(|_| ()).map_err(|e| e.to_string())
    };
    assert_eq!(planned(UPPER), Ok(()));
    let refused = planned("").unwrap_err();
    assert!(refused.contains("friction.moves_with") && refused.contains("upper"), "{refused}");
}
