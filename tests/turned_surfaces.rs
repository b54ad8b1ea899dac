//! Surfaces that turn with their body: turned by a right angle a contact is that of the body laid so from the start; a body of revolution turns
//! within itself, about its own middle wherever that is; each body wears in its own frame, and nothing is lost.

use std::f64::consts::{FRAC_PI_2, PI};

use fret_core::history::History;
use fret_core::run::RunError;
use fret_validation::{by_end_points, off_first_law, run, solved, solved_with};
use ndarray::Array2;

const FINITE: &str = "[kinematics]\ndisplacement = \"finite\"\n";

/// The field that a body carries to where a right angle to the left brings it.
fn turned_left(field: &Array2<f64>) -> Array2<f64> {
    let mut turned = Array2::zeros(field.dim());
    let count = field.dim().0;
    for ((i, j), value) in field.indexed_iter() {
        turned[[count - 1 - j, i]] = *value;
    }
    turned
}

fn largest(field: &Array2<f64>) -> f64 {
    field.iter().fold(0.0_f64, |most, value| most.max(value.abs()))
}

/// A rough body with its own friction, turned by a right angle and then pressed and pulled, is to the bit what a body is that lies so from the start.
#[test]
fn turned_by_a_right_angle_it_is_the_scene_with_axes_exchanged() {
    const CELLS: usize = 40;
    let at = |index: usize| (index as f64 - (CELLS as f64 - 1.0) / 2.0) * 0.05;
    let heights = Array2::from_shape_fn((CELLS, CELLS), |(i, j)| {
        let (x, y) = (at(i), at(j));
        -(x * x + 2.0 * y * y) / 200.0 + 2e-4 * (7.0 * x + 1.0).sin() * (5.0 * y).cos()
    });
    let friction = Array2::from_shape_fn((CELLS, CELLS), |(i, j)| 0.2 + 0.01 * ((i + 3 * j) % 7) as f64);
    let case = |kinematics: &str, friction: &Array2<f64>, moves_with: &str, first: &str| {
        let rows: Vec<Vec<f64>> = friction.rows().into_iter().map(|row| row.to_vec()).collect();
        format!(
            "[grid]\ncells = [{CELLS}, {CELLS}]\nsize = [2.0, 2.0]\n[upper]\nrigid = true\n[upper.profile.heights]\nvalues = {{ array = 0 }}\n\
             [lower]\nsubstrate = {{ young = 1.0, poisson = 0.2 }}\n[friction]\nmap = {rows:?}\n{moves_with}\n[solver]\ntolerance = 1e-9\n\
             [output]\nevery = 1\n{kinematics}[[load]]\nnormal_force = 0.0\n{first}\nincrements = 1\n\
             [[load]]\nnormal_force = 3e-3\nincrements = 3\n[[load]]\nshift = [1e-4, 5e-5]\nincrements = 2\n"
        )
    };
    let turn = format!("twist = {FRAC_PI_2:?}");
    let there = case(FINITE, &friction, "moves_with = \"upper\"", &turn);
    let there = solved_with(&there, std::slice::from_ref(&heights));
    let here = case("", &turned_left(&friction), "", "");
    let here = solved_with(&here, &[turned_left(&heights)]);
    assert!(here.steps.last().unwrap().contact_cells > 100);
    let pressed = [&there, &here].map(|history| history.fields_of(3).unwrap());
    assert_eq!(pressed[0].pressure, pressed[1].pressure);
    assert_eq!(pressed[0].shear, pressed[1].shear);
    assert_eq!(there.steps[3].approach, here.steps[3].approach);
    for axis in 0..2 {
        let [one, other] = [&there.state.shear[axis], &here.state.shear[axis]];
        // Positions are rounded to a hundredth of a cell, and the way from there is shorter.
        assert!(largest(&(one - other)) < 1e-7 * largest(other), "{:e}", largest(&(one - other)));
    }
}

/// An ellipsoid turned by 30 degrees and pressed is one whose gap is written down so: shapes are taken at their places.
#[test]
fn a_shape_turns_to_any_angle() {
    let case = |profile: &str, kinematics: &str, twist: &str| {
        format!(
            "[grid]\ncells = [48, 48]\nsize = [2.4, 2.4]\n[upper]\nrigid = true\n{profile}\n[lower]\nsubstrate = {{ young = 1.0, poisson = 0.2 }}\n\
             [friction]\ncoefficient = 0.3\n[solver]\ntolerance = 1e-10\n{kinematics}[[load]]\nnormal_force = 0.0\n{twist}\nincrements = 1\n\
             [[load]]\nnormal_force = 3e-3\nincrements = 2\n"
        )
    };
    let angle = PI / 6.0;
    let turned = solved(&case(
        "[upper.profile.ellipsoid]\nradius_x = 200.0\nradius_y = 50.0",
        FINITE,
        &format!("twist = {angle:?}"),
    ));
    let (c, s) = (angle.cos(), angle.sin());
    let written = format!(
        "[upper.profile.formula]\nexpression = \"({c:?}*x + {s:?}*y)^2/400 + ({c:?}*y - {s:?}*x)^2/100\""
    );
    let written = solved(&case(&written, "", ""));
    let off = largest(&(&turned.state.pressure - &written.state.pressure)) / largest(&written.state.pressure);
    // the rounding of a formula, and residuals of 1e-10
    assert!(off < 1e-7, "{off:e}");
    assert!(
        (turned.steps.last().unwrap().approach / written.steps.last().unwrap().approach - 1.0).abs() < 1e-8
    );
}

/// A rigid ball that wears, on a flat that does: it is brought to a place, pressed there and turned.
fn turned_ball(shift: f64, kinematics: &str, wear: &str) -> History {
    let [lower, upper] =
        if wear.is_empty() { ["", ""] } else { [", wear_coefficient = 0.02", "wear_coefficient = 0.01\n"] };
    solved(&format!(
        "[grid]\ncells = [64, 64]\nsize = [3.2, 3.2]\n[upper]\nrigid = true\n{upper}[upper.profile.sphere]\nradius = 100.0\n[lower]\n\
         substrate = {{ young = 0.91, poisson = 0.3{lower} }}\n[friction]\ncoefficient = 0.3\n[solver]\ntolerance = 1e-9\n{kinematics}{wear}\
         [output]\nfields = [\"pressure\", \"worn_depth\"]\n[[load]]\nnormal_force = 0.0\nshift = [{shift:?}, 0.0]\nincrements = 1\n\
         [[load]]\nnormal_force = 8e-3\nincrements = 3\n[[load]]\ntwist = 0.4\nincrements = 20\n"
    ))
}

/// A rigid ball turns within itself: nothing moves but what small displacement lets move. Turned about its own middle at another place it does there the
/// same; nothing pulls it.
#[test]
fn a_body_of_revolution_turns_within_itself() {
    let small = turned_ball(0.0, "", "");
    let finite = turned_ball(0.0, FINITE, "");
    let away = turned_ball(0.4, FINITE, "");
    let sliding = |history: &History| history.steps.last().unwrap().clone();
    let [one, other, there] = [&small, &finite, &away].map(sliding);
    // Coulomb's torque under a Hertz pressure, 3 pi/16 mu P a, with 20 cells over a radius
    let radius = (0.75 * 8e-3 * 100.0_f64).cbrt();
    let torque = 3.0 * PI / 16.0 * 0.3 * 8e-3 * radius;
    println!(
        "ball turned: moment {:.6e} small, {:.6e} finite, {:.6e} away; Coulomb {torque:.6e}",
        one.twist_moment, other.twist_moment, there.twist_moment
    );
    assert!((one.twist_moment / torque - 1.0).abs() < 5e-3);
    let pressures = [&small, &finite].map(|history| &history.state.pressure);
    let off = largest(&(pressures[0] - pressures[1])) / largest(pressures[0]);
    // residuals of 1e-9 of each
    assert!(off < 1e-7, "{off:e}");
    assert!((other.twist_moment / one.twist_moment - 1.0).abs() < 1e-7);
    assert!((there.twist_moment / other.twist_moment - 1.0).abs() < 1e-6);
    for (step, moved) in finite.steps.iter().zip(&away.steps) {
        assert!((step.approach / moved.approach - 1.0).abs() < 1e-6 || step.approach == moved.approach);
        assert!(moved.tangential_force[0].hypot(moved.tangential_force[1]) < 1e-6 * 0.3 * 8e-3);
    }
    for history in [&small, &finite, &away] {
        assert!(off_first_law(history, 0.0) < 1e-9, "{:e}", off_first_law(history, 0.0));
    }
}

/// Both wear as they turn: each by its coefficient times the energy of friction, to rounding; and the scar of the ball, which has turned through all of
/// them, is as round as that of the flat.
#[test]
fn bodies_that_turn_wear_and_nothing_is_lost() {
    let wear = "[wear]\nlaw = \"energy\"\nlargest_step = 1.0\n";
    for shift in [0.0, 0.21] {
        let history = turned_ball(shift, FINITE, wear);
        let energy = history.steps.last().unwrap().dissipated_energy;
        let [lower, upper] = history.fields.last().unwrap().own_worn_depth.clone().unwrap();
        let area = history.grid.cell_area();
        let volumes = [lower.sum() * area, upper.sum() * area];
        println!("turned at {shift}: energy {energy:.6e}, worn {volumes:?}");
        for (volume, coefficient) in volumes.into_iter().zip([0.02, 0.01]) {
            // three passes over 64 cells for each increment
            assert!(
                (volume / (coefficient * energy) - 1.0).abs() < 1e-11,
                "{volume:e} {coefficient} {energy:e}"
            );
        }
        assert!(upper.iter().all(|depth| *depth >= -1e-12 * largest(&upper)));
        if shift == 0.0 {
            let off = &lower * 0.5 - &upper;
            let in_all = off.iter().map(|off| off.abs()).sum::<f64>() / upper.sum();
            let radius = |(i, j): (usize, usize)| history.grid.centre(0, i).hypot(history.grid.centre(1, j));
            // five cells from the edge, where the depth ends with a vertical slope
            let inside = off.indexed_iter().filter(|(cell, _)| radius(*cell) < 0.6).map(|(_, off)| off.abs());
            let inside = inside.fold(0.0, f64::max) / largest(&upper);
            println!(
                "scar of the ball against that of the flat: {in_all:.1e} off in all, {inside:.1e} inside"
            );
            // carried by parts of cells of a seventeenth of the radius: of second order inside, of first at the edge
            assert!(in_all < 0.03 && inside < 0.015, "{in_all:e} {inside:e}");
        }
    }
}

/// An ellipse that turns by a right angle lies across: the automatic grid holds it all the way.
#[test]
fn an_automatic_size_holds_a_contact_that_turns() {
    let text = format!(
        "[grid]\ncells = [32, 32]\nsize = \"auto\"\n[upper]\nrigid = true\n[lower]\nsubstrate = {{ young = 1.0, poisson = 0.3 }}\n\
         [profile.ellipsoid]\nradius_x = 400.0\nradius_y = 40.0\n{FINITE}[friction]\ncoefficient = 0.3\n\
         [[load]]\nnormal_force = 1e-2\nincrements = 1\n[[load]]\ntwist = {FRAC_PI_2:?}\nincrements = 6\n"
    );
    let history = solved(&text);
    let [dx, dy] = history.grid.spacing();
    assert!((dx / dy - 1.0).abs() < 1e-12 && history.steps.iter().all(|step| step.footprint.free >= 1));
}

/// A twist of a rough ellipsoid that is pressed, brought aside and turned, is what the moment about its middle that was read off turns it by: one
/// history, prescribed by motions or by moments.
#[test]
fn a_moment_turns_by_the_twist_that_it_was_read_off() {
    const CELLS: usize = 32;
    let at = |index: usize| (index as f64 - (CELLS as f64 - 1.0) / 2.0) * 0.075;
    let heights = Array2::from_shape_fn((CELLS, CELLS), |(i, j)| {
        let (x, y) = (at(i), at(j));
        -(x * x / 40.0 + y * y / 10.0) + 2e-3 * (5.0 * x + 1.0).sin() * (4.0 * y).cos()
    });
    let shifts = [[0.02, 0.01], [0.05, 0.02], [0.08, 0.05], [0.06, 0.04]];
    let twists = [0.32, 0.35, 0.34, 0.31];
    let case = |turns: [String; 4]| {
        let loads: String = shifts
            .iter()
            .zip(turns)
            .map(|([x, y], turn)| format!("[[load]]\nshift = [{x:?}, {y:?}]\n{turn}\nincrements = 1\n"))
            .collect();
        format!(
            "[grid]\ncells = [{CELLS}, {CELLS}]\nsize = [2.4, 2.4]\n[upper]\nsubstrate = {{ young = 2.0, poisson = 0.2 }}\n\
             [upper.profile.heights]\nvalues = {{ array = 0 }}\n[lower]\nsubstrate = {{ young = 1.0, poisson = 0.3 }}\n\
             [friction]\ncoefficient = 0.9\n[solver]\ntolerance = 1e-10\n[output]\nevery = 1\n{FINITE}\
             [[load]]\nnormal_force = 0.0\ntwist = 0.3\nincrements = 1\n[[load]]\nnormal_force = 2e-2\nincrements = 2\n{loads}"
        )
    };
    let maps = std::slice::from_ref(&heights);
    // By end points: what is known of a path of slip inside an increment is another thing for motions than for forces.
    let solved_with = |text: String, maps: &[Array2<f64>]| solved_with(&by_end_points(&text), maps);
    let by_twist = solved_with(case(twists.map(|twist| format!("twist = {twist:?}"))), maps);
    let moments = [3, 4, 5, 6].map(|step| by_twist.steps[step].twist_moment);
    let by_moment = solved_with(case(moments.map(|moment| format!("twist_moment = {moment:?}"))), maps);
    assert!(by_twist.steps.last().unwrap().stick_cells > 20 && by_moment.steps.len() == 7);
    let mut off = [0.0_f64; 3];
    for step in 3..7 {
        let [one, other] = [&by_twist, &by_moment].map(|history| history.fields_of(step).unwrap());
        let [p, r] = [one, other].map(|fields| fields.pressure.as_ref().unwrap());
        off[0] = off[0].max(largest(&(p - r)) / largest(p));
        for axis in 0..2 {
            let [q, s] = [one, other].map(|fields| &fields.shear.as_ref().unwrap()[axis]);
            off[1] = off[1].max(largest(&(q - s)) / largest(p));
        }
        let [one, other] = [&by_twist, &by_moment].map(|history| &history.steps[step]);
        off[2] = off[2].max((one.twist - other.twist).abs());
        assert!((other.twist_moment / moments[step - 3] - 1.0).abs() < 1e-7);
    }
    println!(
        "moments {moments:?}: pressure, shear off by {:.1e}, {:.1e}, twist by {:.1e}",
        off[0], off[1], off[2]
    );
    // Places are one to 1e-4 of a cell where the grid ends, 23 cells from its middle: 5e-6 of a turn of 0.05.
    assert!(off[0] < 1e-5 && off[1] < 1e-5 && off[2] < 5e-6, "{off:?}");
    // What an increment starts from lies by that much off where the one before was solved, and its pressure works on it.
    for (history, most) in [(&by_twist, 1e-9), (&by_moment, 1e-8)] {
        let off = off_first_law(history, 0.0);
        assert!(off < most, "{off:e} {most:e}");
    }
}

/// A rigid ball that a moment turns turns within itself: as far as with small displacement, wherever it is, and nothing pulls it there; under all that
/// Coulomb's law gives at this place it slides, and more is refused.
#[test]
fn a_moment_turns_a_ball_within_itself_wherever_it_is() {
    let radius = (0.75 * 8e-3 * 100.0_f64).cbrt();
    let torque = 3.0 * PI / 16.0 * 0.3 * 8e-3 * radius;
    let case = |shift: f64, kinematics: &str, fraction: f64| {
        format!(
            "[grid]\ncells = [64, 64]\nsize = [3.2, 3.2]\n[upper]\nrigid = true\n[upper.profile.sphere]\nradius = 100.0\n[lower]\n\
             substrate = {{ young = 0.91, poisson = 0.3 }}\n[friction]\ncoefficient = 0.3\n[solver]\ntolerance = 1e-9\n{kinematics}\
             [[load]]\nnormal_force = 0.0\nshift = [{shift:?}, {:?}]\nincrements = 1\n[[load]]\nnormal_force = 8e-3\nincrements = 3\n\
             [[load]]\ntwist_moment = {:e}\nincrements = 4\n",
            -0.5 * shift,
            fraction * torque,
        )
    };
    let small = solved(&case(0.0, "", 0.8));
    let away = solved(&case(0.4, FINITE, 0.8));
    for (step, moved) in small.steps.iter().zip(&away.steps).skip(4) {
        println!("turned by {:.8e}, away by {:.8e}", step.twist, moved.twist);
        // whole cells away: residuals of 1e-9 of each
        assert!((step.twist / moved.twist - 1.0).abs() < 1e-6 && step.twist > 0.0);
        assert!((moved.twist_moment / step.twist_moment - 1.0).abs() < 1e-7);
        assert!(moved.tangential_force[0].hypot(moved.tangential_force[1]) < 1e-6 * 0.3 * 8e-3);
    }
    assert!(off_first_law(&away, 0.0) < 1e-9, "{:e}", off_first_law(&away, 0.0));
    // half a per cent is what the cells make of the torque
    assert!(matches!(run(&case(0.4, FINITE, 1.01)), Err(RunError::AboveFullSlip { .. })));
}

/// A moment twists a rough body that has been turned by a right angle as it does one that lies so from the start.
#[test]
fn a_moment_on_a_body_turned_by_a_right_angle_is_that_on_one_that_lies_so() {
    const CELLS: usize = 32;
    let at = |index: usize| (index as f64 - (CELLS as f64 - 1.0) / 2.0) * 0.0625;
    let heights = Array2::from_shape_fn((CELLS, CELLS), |(i, j)| {
        let (x, y) = (at(i), at(j));
        -(x * x + 2.0 * y * y) / 200.0 + 2e-4 * (7.0 * x + 1.0).sin() * (5.0 * y).cos()
    });
    let case = |first: &str| {
        format!(
            "[grid]\ncells = [{CELLS}, {CELLS}]\nsize = [2.0, 2.0]\n[upper]\nrigid = true\n[upper.profile.heights]\nvalues = {{ array = 0 }}\n\
             [lower]\nsubstrate = {{ young = 1.0, poisson = 0.2 }}\n[friction]\ncoefficient = 0.3\n[solver]\ntolerance = 1e-9\n{FINITE}\
             [[load]]\nnormal_force = 0.0\n{first}\nincrements = 1\n[[load]]\nnormal_force = 3e-3\nincrements = 2\n\
             [[load]]\ntwist_moment = 1.5e-4\ntangential_force = [1e-4, 2e-4]\nincrements = 3\n"
        )
    };
    let there = solved_with(&case(&format!("twist = {FRAC_PI_2:?}")), std::slice::from_ref(&heights));
    let here = solved_with(&case(""), &[turned_left(&heights)]);
    let [one, other] = [&there, &here].map(|history| history.steps.last().unwrap());
    println!("turned by {:.8e} there, {:.8e} here", one.twist - FRAC_PI_2, other.twist);
    // The angle has lost five digits beside a right one.
    assert!(((one.twist - FRAC_PI_2) / other.twist - 1.0).abs() < 1e-5 && other.twist > 0.0);
    for axis in 0..2 {
        let [one, other] = [&there, &here].map(|history| &history.state.shear[axis]);
        assert!(largest(&(one - other)) < 1e-6 * largest(other), "{:e}", largest(&(one - other)));
    }
}
