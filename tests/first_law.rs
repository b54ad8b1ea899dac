//! The first law of thermodynamics in every increment: what forces, moments and bulk stresses put in is stored, dissipated, gone with wear, or
//! told as unresolved. The program sums each of these by itself: forces times motions, tractions times displacements, bounds times slip, gaps
//! times pressures. 1e-9 of the largest is the rounding of sums and of transforms.

use fret_core::history::History;
use fret_validation::random_histories::RandomHistory;
use fret_validation::{Sphere, by_end_points, off_first_law, run};
use rayon::prelude::*;

const ROUNDING: f64 = 1e-9;

fn keeps(name: &str, text: &str) -> History {
    let history = run(text).unwrap_or_else(|error| panic!("{name}: {error}\n{text}"));
    let off = off_first_law(&history, 0.0);
    assert!(off < ROUNDING, "{name}: {off:e}\n{text}");
    history
}

/// Point and line contacts, coated and dissimilar bodies, torsion, tilt, bulk stress, pauses, sliding; both rules.
#[test]
fn random_histories_keep_the_first_law() {
    (0..40_u64).into_par_iter().for_each(|seed| {
        let history = RandomHistory::drawn(seed);
        let text = history.text(12);
        keeps(&format!("{seed}, {:?}", history.kind), &text);
        if seed % 4 == 0 {
            keeps(&format!("{seed} by end points"), &by_end_points(&text));
        }
    });
}

fn sphere() -> Sphere {
    Sphere { cells: 32, size: 2.6, friction: 0.3, tolerance: 1e-9, ..Sphere::default() }
}

/// A sphere that is tilted further and further rolls: the contact moves over the surface by half a cell an increment, its cells enter in front and
/// leave behind, against a resistance. What no increment misplaces vanishes with their length.
#[test]
fn a_sphere_that_rolls_keeps_the_first_law() {
    let sphere = Sphere { cells: 48, size: 4.0, coating: Some((2.0, 0.5)), ..sphere() };
    let unresolved = |increments: usize| {
        let rolled = 1.0; // a contact radius
        let text = format!(
            "{}[[load]]\ntangential_force = [{:e}, 0.0]\nincrements = 6\n[[load]]\ntilt = [{:e}, 0.0]\nincrements = {increments}\n",
            sphere.pressed(0.5, 6, "cubic"),
            0.1 * sphere.force(),
            rolled / 100.0
        );
        let history = keeps("rolling", &text);
        let [before, last] = [&history.steps[11], history.steps.last().unwrap()];
        let dissipated = last.dissipated_energy - before.dissipated_energy;
        (last.unresolved_energy - before.unresolved_energy) / dissipated
    };
    let [coarse, fine] = [12, 48].map(unresolved);
    println!("unresolved of the energy of rolling: {coarse:.1e}, {fine:.1e}");
    assert!(fine.abs() < 0.5 * coarse.abs(), "{coarse:e} {fine:e}");
}

/// Wear takes energy with it: by its own column, with layers that grow thinner, with cycles that stand for others, and with friction that changes.
#[test]
fn wear_and_friction_that_changes_keep_the_first_law() {
    let coated = Sphere { coating: Some((2.0, 0.2)), ..sphere() };
    let cycles = coated.pulled(&coated.pressed(1.0, 6, "cubic"), 0.7, 12, Some(4));
    let with = |table: &str| {
        cycles.replace("[[load]]\nname = \"press\"", &format!("{table}[[load]]\nname = \"press\""))
    };
    let thinning = with("[wear]\nthinning_tolerance = 1e-5\n")
        .replace("poisson = 0.3 }", "poisson = 0.3, wear_coefficient = 1.0 }");
    for (name, text) in [
        ("wear", with("[wear]\ncoefficient = 0.5\n")),
        ("jumps", with("[wear]\ncoefficient = 0.2\nevery = 2\n")),
        ("thinning", thinning),
        (
            "friction that evolves",
            with("[wear]\ncoefficient = 0.1\n").replace(
                "coefficient = 0.3\n[solver]",
                "coefficient = 0.3\nevolution = { by = \"energy\", last = 0.4, scale = 1e-5 }\n[solver]",
            ),
        ),
    ] {
        let history = keeps(name, &text);
        let last = history.steps.last().unwrap();
        println!(
            "{name}: {:.1e} of {:.1e}, worn {:.1e}",
            last.wear_work, last.external_work, last.max_worn_depth
        );
        assert!(last.wear_work > 0.0, "{name}: {:e}", last.wear_work);
    }
    let history = keeps("no wear", &cycles);
    assert_eq!(history.steps.last().unwrap().wear_work, 0.0);
}

/// The bodies part in one increment: all that was stored is given back, dissipated or told.
/// Bodies that move against each other and both wear, driven by a displacement and by a force, over fractions of cells: slopes work under the
/// pressure, and the displacement that the upper body carries along under the shear.
#[test]
fn bodies_that_move_keep_the_first_law() {
    let case = |kinematics: &str, stages: &str| {
        format!(
            "[grid]\ncells = 96\nsize = 0.6\ndatum = 6.0\n[upper]\nsubstrate = {{ young = 1e5, poisson = 0.2, wear_coefficient = 1e-7 }}\n\
             [lower]\nsubstrate = {{ young = 2e5, poisson = 0.3, wear_coefficient = 1.5e-7 }}\n[profile.cylinder]\nradius = 6.0\naxis = \"y\"\n\
             [friction]\ncoefficient = 0.6\n[solver]\ntolerance = 1e-11\n{kinematics}[wear]\nlaw = \"archard\"\n\
             [[load]]\nnormal_force = 18.5\nincrements = 3\n[[load]]\n{stages}\n"
        )
    };
    let finite = "[kinematics]\ndisplacement = \"finite\"\n";
    let slides = "shift = [0.021, 0.0]\nincrements = 12\ncycles = 4";
    let [moving, still] = [("moving", finite), ("still", "")]
        .map(|(name, kinematics)| keeps(name, &case(kinematics, slides)).steps.pop().unwrap());
    assert!(moving.wear_work > 0.1 * still.wear_work, "{moving:?}");
    keeps("moved by a force", &case(finite, "tangential_force = [9.3, 0.0]\nincrements = 12\ncycles = 2"));
}

#[test]
fn bodies_that_part_keep_the_first_law() {
    let sphere = sphere();
    let text = sphere.pulled(&sphere.pressed(1.0, 6, "cubic"), 0.5, 4, None);
    let text = format!("{text}[[load]]\ntangential_force = [0.0, 0.0]\nnormal_force = 0.0\nincrements = 3\n");
    let history = keeps("parted", &text);
    let last = history.steps.last().unwrap();
    assert_eq!((last.elastic_energy, last.contact_cells), (0.0, 0));
    let told = last.dissipated_energy + last.unresolved_energy;
    assert!((last.external_work / told - 1.0).abs() < ROUNDING);
}
