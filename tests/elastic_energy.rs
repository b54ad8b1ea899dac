//! The elastic energy of a contact, against closed forms, the numbers of another program, and the work that was put in.

use std::f64::consts::PI;

use fret_core::history::History;
use fret_validation::run;

const POISSON: f64 = 0.3;

/// A case of a body of modulus 1 below.
fn solved(grid: &str, upper: &str, rest: &str) -> History {
    run(&format!(
        "[grid]\n{grid}\n[upper]\n{upper}\n[lower]\nsubstrate = {{ young = 1.0, poisson = {POISSON} }}\n{rest}"
    ))
    .unwrap()
}

fn last(history: &History) -> f64 {
    history.steps.last().unwrap().elastic_energy
}

/// `E = integral of P over the approach = 8/15 E* a^5/R^2` of a sphere. Collocation and the cells at the edge leave 3e-4 at 27 cells in
/// the diameter, and 1e-5 at twice as many and more.
#[test]
fn a_hertz_contact_stores_the_integral_of_its_force() {
    let modulus = 1.0 / (1.0 - POISSON * POISSON);
    let radius = 100.0;
    let exact = 8.0 / 15.0 * modulus / (radius * radius);
    for (cells, bound) in [(32, 5e-4), (64, 2e-5), (65, 2e-5)] {
        let force = 4.0 * modulus / (3.0 * radius);
        let history = solved(
            &format!("cells = [{cells}, {cells}]\nsize = [2.4, 2.4]"),
            "rigid = true",
            &format!(
                "[profile.sphere]\nradius = {radius}\n[[load]]\nnormal_force = {force:?}\nincrements = 1\n"
            ),
        );
        let off = last(&history) / exact - 1.0;
        assert!(off.abs() < bound, "{cells} cells: {off:e}");
    }
}

/// Under a cylinder `u_z = approach - x^2/2R`, whose mean under a Hertz pressure is `approach - a^2/8R`: half of it times the force, relative
/// to the datum as the approach is.
#[test]
fn a_line_contact_stores_energy_relative_to_its_datum() {
    let modulus = 1.0 / (1.0 - POISSON * POISSON);
    let force = 1e-2_f64;
    let half_width = (4.0 * force / (PI * modulus)).sqrt();
    for datum in [0.2, 50.0] {
        let history = solved(
            &format!("cells = 128\nsize = {:?}\ndatum = {datum:?}", 2.4 * half_width),
            "rigid = true",
            &format!(
                "[profile.cylinder]\nradius = 1.0\naxis = \"y\"\n[[load]]\nnormal_force = {force:?}\nincrements = 1\n"
            ),
        );
        let exact = 0.5 * force * (history.steps[0].approach - half_width.powi(2) / 8.0);
        let off = last(&history) / exact - 1.0;
        // The cells at the edge, 6e-5 with the smaller datum.
        assert!(off.abs() < 2e-4, "datum {datum}: {off:e}");
    }
}

/// Example `cattaneo` of CONTACT (version of July 2025, second case): a ball of radius 50 mm on its like, 19 x 19 elements of 0.13333 mm.
/// Its output: elastic energy 8.525e-5 J, frictional work 2.750e-6 J, approach 1.998e-2 mm; half a unit of the last digit, and its
/// tolerance of 1e-4.
#[test]
fn a_cattaneo_contact_stores_what_another_program_says() {
    let body = "substrate = { young = 568.0, poisson = 0.42 }"; // 2 G (1 + nu), G = 200 MPa
    let size = 19.0 * 0.13333;
    let text = format!(
        "[grid]\ncells = [19, 19]\nsize = [{size:?}, {size:?}]\n[upper]\n{body}\n[lower]\n{body}\n[profile.sphere]\nradius = 50.0\n\
         [friction]\ncoefficient = 0.4\n[solver]\nintegration = \"end_point\"\n[[load]]\nnormal_force = 9.1954\nincrements = 1\n\
         [[load]]\ntangential_force = [{:?}, 0.0]\nincrements = 1\n",
        0.875 * 0.4 * 9.1954
    );
    let history = run(&text).unwrap();
    let step = history.steps.last().unwrap();
    // N mm are 1e-3 J.
    for (name, found, printed, unit) in [
        ("elastic energy", step.elastic_energy * 1e-3, 8.525e-5, 1e-8),
        ("frictional work", step.dissipated_energy * 1e-3, 2.750e-6, 1e-9),
        ("approach", step.approach, 1.998e-2, 1e-5),
    ] {
        assert!((found - printed).abs() < 0.5 * unit + 1e-4 * printed, "{name}: {found:e}, not {printed:e}");
    }
}

/// Work of the forces on the motions is stored or dissipated: of a contact that is pressed and pulled, with bodies that couple and with
/// their like. The trapezium over the increments leaves 2.3e-4 at 80 increments of the pressing (`P ~ delta^1.5`), sixteen times that at
/// 20, and 1e-5 of the pull.
#[test]
fn what_is_put_in_is_stored_or_dissipated() {
    let body = "substrate = { young = 1.0, poisson = 0.3 }";
    for (upper, force) in [("rigid = true", 0.0146), (body, 0.0073)] {
        let history = solved(
            "cells = [32, 32]\nsize = [2.8, 2.8]",
            upper,
            &format!(
                "[profile.sphere]\nradius = 100.0\n[friction]\ncoefficient = 0.3\n[[load]]\nnormal_force = {force:?}\nincrements = 80\n\
                 [[load]]\ntangential_force = [{:?}, 0.0]\nincrements = 80\n",
                0.2 * force
            ),
        );
        let mut work = [0.0; 2];
        let mut before = ([0.0; 2], [0.0; 2]);
        for step in &history.steps {
            let forces = [step.normal_force, step.tangential_force[0]];
            let motions = [step.approach, step.shift[0]];
            for axis in 0..2 {
                work[step.stage] += 0.5 * (forces[axis] + before.0[axis]) * (motions[axis] - before.1[axis]);
            }
            before = (forces, motions);
        }
        let kept = |step: usize| history.steps[step].elastic_energy + history.steps[step].dissipated_energy;
        let (pressed, all) = (kept(79), kept(159));
        let off = [pressed / work[0] - 1.0, (all - pressed) / work[1] - 1.0];
        assert!(off[0].abs() < 5e-4 && off[1].abs() < 5e-5, "{upper}: {off:?}");
    }
}

/// Bodies apart store nothing, and the energy of a mirrored contact is that of the whole.
#[test]
fn energy_is_of_the_whole_contact_and_none_without_contact() {
    let text = |cells: usize| {
        format!(
            "[grid]\ncells = [{cells}, {cells}]\nsize = [2.8, 2.8]\n[upper]\nrigid = true\n[lower]\nsubstrate = {{ young = 1.0, poisson = 0.3 }}\n\
             [profile.sphere]\nradius = 100.0\n[friction]\ncoefficient = 0.3\n[[load]]\nnormal_force = 0.0\nincrements = 1\n\
             [[load]]\nnormal_force = 0.0146\nincrements = 2\n"
        )
    };
    let (even, odd) = (run(&text(40)).unwrap(), run(&text(41)).unwrap());
    assert_eq!(even.steps[0].elastic_energy, 0.0);
    // An odd number of cells has no mirrors; the grids differ by a cell.
    let off = last(&even) / last(&odd) - 1.0;
    assert!(off.abs() < 1e-3, "{off:e}");
}
