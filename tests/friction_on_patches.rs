//! Friction that differs from place to place, or from stage to stage.

use std::fs;
use std::path::Path;

use fret_core::case::{Attachments, Case};
use fret_core::plan::Plan;
use fret_core::run::{RunError, Silent, Simulation};
use fret_validation::{Sphere, keeping, solved, solved_with};
use ndarray::Array2;
use serde::Deserialize;

#[derive(Deserialize)]
struct Patches {
    cells: usize,
    size: f64,
    approach: f64,
    shifts: [[f64; 2]; 2],
    halves: Scene,
    quarters: Scene,
}

#[derive(Deserialize)]
struct Scene {
    friction: Vec<f64>,
    steps: Vec<Step>,
}

#[derive(Deserialize)]
struct Step {
    force: [f64; 3],
    pressure: Vec<f64>,
    shear_x: Vec<f64>,
    shear_y: Vec<f64>,
}

#[test]
fn two_patches_are_those_of_a_dense_solution() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("golden/two_patches.json");
    let golden: Patches = serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap();
    let Patches { cells, size, approach, shifts: [first, second], .. } = golden;
    let text = format!(
        "[grid]\ncells = [{cells}, {cells}]\nsize = [{size:?}, {size:?}]\n[upper]\nrigid = true\n[lower]\n\
         substrate = {{ young = 1.0, poisson = 0.3 }}\n[profile.sphere]\nradius = 100.0\n[friction]\nmap = {{ array = 0 }}\n\
         [solver]\nintegration = \"end_point\"\ntolerance = 1e-10\n[[load]]\napproach = {approach:e}\nshift = [0.0, 0.0]\nincrements = 1\n\
         [[load]]\nshift = {first:?}\nincrements = 1\n[[load]]\nshift = {second:?}\nincrements = 1\n{}",
        keeping(1)
    );
    for (name, scene) in [("halves", golden.halves), ("quarters", golden.quarters)] {
        let field = |values: &[f64]| Array2::from_shape_vec((cells, cells), values.to_vec()).unwrap();
        let history = solved_with(&text, &[field(&scene.friction)]);
        let mut worst = 0.0_f64;
        for (number, step) in scene.steps.iter().enumerate() {
            let kept = &history.fields[number];
            let shear = kept.shear.as_ref().unwrap();
            let largest = step.pressure.iter().copied().fold(0.0, f64::max);
            let pairs = [
                (kept.pressure.as_ref().unwrap(), &step.pressure),
                (&shear[0], &step.shear_x),
                (&shear[1], &step.shear_y),
            ];
            for (found, expected) in pairs {
                let off = (found - &field(expected)).iter().fold(0.0_f64, |worst, d| worst.max(d.abs()));
                worst = worst.max(off / largest);
            }
            let record = &history.steps[number];
            let forces = [record.normal_force, record.tangential_force[0], record.tangential_force[1]];
            for (found, expected) in forces.iter().zip(step.force) {
                assert!((found - expected).abs() < 1e-9 * step.force[0], "{name} {number}: {forces:?}");
            }
        }
        println!("friction on {name}: tractions off by {worst:.1e} of the largest pressure");
        // The same discrete problem; the dense solution stands at 1e-12, this one's residual is 1e-10.
        assert!(worst < 1e-8, "{name}: {worst:e}");
    }
}

fn sphere() -> Sphere {
    Sphere { cells: 32, friction: 0.3, tolerance: 1e-10, ..Sphere::default() }
}

#[test]
fn a_map_of_one_coefficient_is_that_coefficient() {
    let sphere = sphere();
    let text = sphere.pulled(&sphere.pressed(0.8, 2, "cubic"), 0.4, 4, None) + &keeping(1);
    let uniform = solved(&text);
    let mapped = solved_with(
        &text.replace("coefficient = 0.3", "map = { array = 0 }"),
        &[Array2::from_elem((32, 32), 0.3)],
    );
    // The same numbers in every cell: the same bits.
    assert_eq!(uniform.fields, mapped.fields);
}

#[test]
fn a_patch_without_friction_carries_no_shear_and_the_rest_slides_at_its_own_bound() {
    let sphere = sphere();
    let map = Array2::from_shape_fn((32, 32), |(i, _)| if i < 16 { 0.0 } else { 0.3 });
    let head = sphere.pressed(0.8, 2, "cubic").replace("coefficient = 0.3", "map = { array = 0 }");
    let slide = format!("{head}[[load]]\nshift = [0.05, 0.0]\nincrements = 3\n{}", keeping(1));
    let history = solved_with(&slide, std::slice::from_ref(&map));
    let kept = history.fields.last().unwrap();
    let (pressure, shear) = (kept.pressure.as_ref().unwrap(), &kept.shear.as_ref().unwrap()[0]);
    assert!(shear.indexed_iter().all(|((i, _), q)| i >= 16 || *q == 0.0));
    let area = history.grid.cell_area();
    let bound: f64 = pressure.iter().zip(&map).map(|(p, mu)| mu * p).sum::<f64>() * area;
    let pull = history.steps.last().unwrap().tangential_force[0];
    // Far beyond the onset of sliding all slip points along x but for what pressure pushes aside, here 1e-5 of a radian squared.
    assert!((pull / bound - 1.0).abs() < 1e-3, "{pull} against {bound}");
    // More than that has no equilibrium, and is told so although mu W of the larger coefficient is not reached.
    let above = sphere.pulled(&head, 0.7, 2, None);
    let attachments = Attachments { arrays: std::slice::from_ref(&map), ..Attachments::none() };
    let plan = Plan::new(Case::from_toml_with(&above, "case.toml", attachments).unwrap()).unwrap();
    let error = Simulation::new(&plan).run(&mut Silent).unwrap_err();
    assert!(matches!(error, RunError::AboveSliding { .. }), "{error}");
}

/// Friction that falls at once under loads that stand, and forces that change after it, or from the same moment on: with the length of the first
/// increment after it the difference goes away, which an extrapolation of slip from the time before would not.
#[test]
fn friction_that_falls_with_the_loads_ends_where_it_ends_before_them() {
    let sphere = sphere();
    let held = sphere.pulled(&sphere.pressed(0.8, 4, "cubic"), 0.4, 4, None);
    let ended = |pause: &str, increments: usize| {
        let stage = if pause.is_empty() { "friction = 0.2\n" } else { "" };
        let more = sphere.pulled(&format!("{held}{pause}"), 0.45, increments, None);
        let at = more.rfind("[[load]]\n").unwrap() + "[[load]]\n".len();
        let history = solved(&format!("{}{stage}{}", &more[..at], &more[at..]));
        history.steps.last().unwrap().shift[0]
    };
    let apart = [8, 32].map(|increments| {
        let after = ended("[[load]]\nfriction = 0.2\nincrements = 1\n", increments);
        ended("", increments) / after - 1.0
    });
    assert!(apart[1].abs() < 0.4 * apart[0].abs() && apart[1].abs() < 1e-3, "{apart:?}");
}

/// Where all cells in contact are without friction nothing carries a force, however much friction there is elsewhere.
#[test]
fn a_contact_on_a_patch_without_friction_carries_no_force() {
    let sphere = sphere();
    let map = Array2::from_shape_fn((32, 32), |(i, j)| if i == 0 && j == 0 { 0.3 } else { 0.0 });
    let head = sphere.pressed(0.8, 2, "cubic").replace("coefficient = 0.3", "map = { array = 0 }");
    let pulled = sphere.pulled(&head, 1e-3, 1, None);
    let attachments = Attachments { arrays: std::slice::from_ref(&map), ..Attachments::none() };
    let plan = Plan::new(Case::from_toml_with(&pulled, "case.toml", attachments).unwrap()).unwrap();
    let error = Simulation::new(&plan).run(&mut Silent).unwrap_err();
    assert!(matches!(error, RunError::AboveSliding { .. }), "{error}");
}

#[test]
fn friction_that_falls_lets_go_and_friction_that_rises_changes_nothing() {
    let sphere = sphere();
    let held = sphere.pulled(&sphere.pressed(0.8, 4, "cubic"), 0.4, 2, None);
    let change = |coefficient: &str| {
        format!("{held}[[load]]\nname = \"change\"\nfriction = {coefficient}\nincrements = 2\n{}", keeping(1))
    };
    // Higher friction: the contact is in equilibrium already.
    let risen = solved(&change("0.6"));
    let [before, after] = [5, 7].map(|number: usize| &risen.fields[number]);
    let largest = risen.steps[5].max_pressure;
    let off = |a: &Array2<f64>, b: &Array2<f64>| {
        (a - b).iter().fold(0.0_f64, |worst, d| worst.max(d.abs())) / largest
    };
    assert!(off(before.pressure.as_ref().unwrap(), after.pressure.as_ref().unwrap()) < 1e-8);
    assert!(off(&before.shear.as_ref().unwrap()[0], &after.shear.as_ref().unwrap()[0]) < 1e-8);
    // Lower friction: everywhere within its own bound, and the force is still carried.
    let fallen = solved(&change("0.2"));
    let last = fallen.fields.last().unwrap();
    let shear = last.shear.as_ref().unwrap();
    for ((at, p), (x, y)) in
        last.pressure.as_ref().unwrap().indexed_iter().zip(shear[0].iter().zip(&shear[1]))
    {
        assert!(x.hypot(*y) <= 0.2 * p * (1.0 + 1e-12), "{at:?}");
    }
    let pull = 0.4 * 0.3 * sphere.force();
    assert!((fallen.steps.last().unwrap().tangential_force[0] / pull - 1.0).abs() < 1e-9);
    assert!(fallen.steps.last().unwrap().shift[0] > fallen.steps[5].shift[0]);
    // None at all, by a shift that is held: no shear is left, and the pressure is that of a contact that never had friction.
    let dropped = format!(
        "{}[[load]]\nshift = [0.001, 0.0]\nincrements = 2\n[[load]]\nfriction = 0.0\nincrements = 1\n{}",
        sphere.pressed(0.8, 4, "cubic"),
        keeping(1)
    );
    let dropped = solved(&dropped);
    let never = Sphere { friction: 0.0, ..sphere.clone() };
    let never = solved(&(never.pressed(0.8, 1, "linear") + &keeping(1)));
    let last = dropped.fields.last().unwrap();
    assert!(last.shear.as_ref().unwrap().iter().all(|part| part.iter().all(|q| *q == 0.0)));
    assert!(off(last.pressure.as_ref().unwrap(), never.fields[0].pressure.as_ref().unwrap()) < 1e-8);
}
