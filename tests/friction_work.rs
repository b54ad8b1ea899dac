//! What friction dissipates, cell by cell: all cells together take what the history says, wherever the contact goes.

use fret_core::history::History;
use fret_validation::{Sphere, keeping, solved};

/// Sums of the same numbers in another order; of energies that are sums since the start, whose differences lose digits.
fn assert_cells_add_up(history: &History, name: &str) {
    let mut most = 0.0_f64;
    for (index, step) in history.steps.iter().enumerate() {
        let before = index.checked_sub(1).map_or(0.0, |before| history.steps[before].dissipated_energy);
        let all = history.fields_of(step.increment).unwrap().friction_work.as_ref().unwrap();
        let taken = all.sum() * history.grid.cell_area();
        let told = step.dissipated_energy - before;
        assert!(
            (taken - told).abs() <= 1e-12 * step.dissipated_energy,
            "{name}, increment {index}: {taken:e} {told:e}"
        );
        assert!(all.iter().all(|work| *work >= 0.0));
        most = most.max(taken);
    }
    assert!(most > 0.0, "{name}");
}

fn with_work(text: &str) -> String {
    let fields = keeping(1).replace("\"zone\"", "\"zone\", \"friction_work\"");
    format!("{text}{fields}")
}

/// A coated ball on a half of its grid: pressed, pulled until it slides, released; as the increments are and divided by the program.
#[test]
fn cells_add_up_to_the_dissipated_energy() {
    let sphere = Sphere { cells: 24, coating: Some((4.0, 0.5)), friction: 0.3, ..Sphere::default() };
    let loads = |increments: &str| {
        format!(
            "[[load]]\nshift = [0.02, 0.0]\nincrements = {increments}\n[[load]]\nnormal_force = 0.0\nincrements = 2\n"
        )
    };
    for increments in ["6", "\"auto\""] {
        let text = sphere.pressed(1.0, 3, "cubic") + &loads(increments);
        assert_cells_add_up(&solved(&with_work(&text)), increments);
    }
}

const ROLLER: &str = "[grid]\ncells = [40, 20]\nsize = [4.0, 2.0]\n[upper]\nsubstrate = { young = 1.0, poisson = 0.3 }\n[lower]\n\
    substrate = { young = 3.0, poisson = 0.2 }\n[profile.sphere]\nradius = 100.0\n[friction]\ncoefficient = 0.3\n";

/// Over both bodies, fixed to them or to the contact; in the steady state; and one body over the other.
#[test]
fn cells_add_up_where_the_contact_goes() {
    let press = "[[load]]\nnormal_force = 2e-3\nincrements = 2\n";
    let pull = "[[load]]\ntangential_force = [2e-4, 0.0]\nincrements = 2\n";
    let roll = "[[load]]\nroll = [0.4, 0.0]\nincrements = 4\n";
    let frame = "[kinematics]\nframe = \"contact\"\n";
    let finite = "[kinematics]\ndisplacement = \"finite\"\n";
    let slide = "[[load]]\nshift = [0.25, 0.0]\nincrements = 4\n";
    let steady = "[[load]]\nroll = \"steady\"\nincrements = 1\n";
    for (name, kinematics, loads) in [
        ("rolls, bodies", "", [pull, roll]),
        ("rolls, contact", frame, [pull, roll]),
        ("rolls steadily", frame, [pull, steady]),
        ("slides", finite, ["", slide]),
    ] {
        let text = format!("{ROLLER}{kinematics}{press}{}{}", loads[0], loads[1]);
        assert_cells_add_up(&solved(&with_work(&text)), name);
    }
}

/// In gross slip by small displacements, friction bound times way: cell by cell `mu p` times the step.
#[test]
fn in_gross_slip_it_is_the_bound_times_the_way() {
    let text = "[grid]\ncells = 64\nsize = 2.0\n[upper]\nsubstrate = { young = 1.0, poisson = 0.3 }\n[lower]\n\
        substrate = { young = 1.0, poisson = 0.3 }\n[profile.cylinder]\nradius = 100.0\naxis = \"y\"\n[friction]\ncoefficient = 0.3\n\
        [[load]]\nnormal_force = 2e-3\nincrements = 1\n[[load]]\nshift = [0.02, 0.0]\nincrements = 4\n";
    let history = solved(&with_work(text));
    let fields = history.fields.last().unwrap();
    let (work, pressure) = (fields.friction_work.as_ref().unwrap(), fields.pressure.as_ref().unwrap());
    for (work, pressure) in work.iter().zip(pressure) {
        // nothing changes any more but the shift: to the residual of the pressure
        assert!(
            (work - 0.3 * pressure * 0.005).abs() <= 1e-6 * 0.3 * pressure * 0.005,
            "{work:e} {pressure:e}"
        );
    }
}
