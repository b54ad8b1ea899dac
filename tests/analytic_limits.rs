//! Limits with closed forms: Hertz, Cattaneo and Mindlin.

use fret_core::analytic::{CattaneoMindlin, Hertz};
use fret_validation::{RADIUS, Sphere, keeping, observed_order, solved};

#[test]
fn hertz_pressure_approach_and_radius_converge_with_second_order() {
    let mut errors = Vec::new();
    for cells in [64, 128, 256] {
        let sphere = Sphere { cells, ..Sphere::default() };
        let hertz = Hertz::sphere(RADIUS, sphere.force(), sphere.effective_modulus()).unwrap();
        let step = solved(&sphere.pressed(1.0, 1, "linear")).steps[0].clone();
        let radius = (step.contact_area / std::f64::consts::PI).sqrt();
        errors.push([
            step.max_pressure / hertz.max_pressure - 1.0,
            step.approach / hertz.approach - 1.0,
            radius / hertz.contact_radius - 1.0,
        ]);
    }
    // Measured on many Hertz scenes: peak 5e-5, approach 3e-5, radius 2e-4 at 50 cells a radius.
    let finest = errors[1];
    assert!(finest[0].abs() < 2e-4 && finest[1].abs() < 1e-4 && finest[2].abs() < 1e-3, "{errors:?}");
    // The approach has one sign and falls with the square of the cell.
    let order = observed_order(errors[0][1], errors[2][1]) / 2.0;
    assert!(order > 1.7, "order {order}, {errors:?}");
}

#[test]
fn approach_control_and_force_control_are_the_same_contact() {
    let sphere = Sphere { cells: 48, tolerance: 1e-11, ..Sphere::default() };
    let by_force = solved(&sphere.pressed(1.0, 1, "linear"));
    let approach = by_force.steps[0].approach;
    let text = format!("{}[[load]]\napproach = {approach:e}\nincrements = 1\n", sphere.head());
    let by_approach = solved(&text);
    // Both are solved to 1e-11 of the displacement; the force follows with a condition of order one.
    let force = by_approach.steps[0].normal_force;
    assert!((force / sphere.force() - 1.0).abs() < 1e-9, "{force} against {}", sphere.force());
}

#[test]
fn cattaneo_mindlin_traction_and_shift() {
    // nu = 0: the closed form is exact, transverse slip vanishes.
    let sphere =
        Sphere { cells: 128, size: 2.2, poisson: 0.0, identical: true, friction: 0.3, ..Sphere::default() };
    let text = sphere.pulled(&sphere.pressed(1.0, 1, "linear"), 0.75, 1, None) + &keeping(1);
    let history = solved(&text);
    let hertz = Hertz::sphere(RADIUS, sphere.force(), sphere.effective_modulus()).unwrap();
    let pull = 0.75 * 0.3 * sphere.force();
    let exact = CattaneoMindlin::new(&hertz, 0.3, sphere.effective_shear_modulus(), pull).unwrap();
    let last = history.steps.last().unwrap();
    // One cell in 58 at the stick border: the discrete shift is good to its square.
    assert!((last.shift[0] / exact.shift - 1.0).abs() < 1e-3, "{} against {}", last.shift[0], exact.shift);
    let shear = history.fields[1].shear.as_ref().unwrap();
    let mut square = 0.0;
    let mut count = 0.0;
    for ((i, j), q) in shear[0].indexed_iter() {
        let r = history.grid.centre(0, i).hypot(history.grid.centre(1, j));
        if r < hertz.contact_radius {
            square += (q - exact.shear(r)).powi(2);
            count += 1.0;
        }
    }
    let rms = (square / count).sqrt() / (0.3 * hertz.max_pressure);
    // The kink at the stick radius and the root at the edge are smeared over a cell.
    assert!(rms < 3e-3, "rms {rms}");
    let stick = (last.stick_area / last.contact_area).sqrt();
    assert!((stick - exact.stick_radius / hertz.contact_radius).abs() < 1.0 / 58.0, "{stick}");
}

#[test]
fn gross_numbers_of_an_elliptical_contact() {
    let text = "[grid]\ncells = [96, 64]\nsize = [4.2, 2.2]\n[upper]\nrigid = true\n[lower]\n\
                substrate = { young = 1.0, poisson = 0.3 }\n[profile.ellipsoid]\nradius_x = 220.0\nradius_y = 70.0\n\
                [[load]]\nnormal_force = 0.0147\nincrements = 1\n";
    let history = solved(text);
    let exact = fret_core::analytic::HertzEllipse::ellipsoid([220.0, 70.0], 0.0147, 1.0 / 0.91).unwrap();
    let step = &history.steps[0];
    // Two different cell sides, 44 and 58 cells over the axes: errors of the order of the cell squared.
    assert!((step.max_pressure / exact.max_pressure - 1.0).abs() < 1e-3, "{step:?} {exact:?}");
    assert!((step.approach / exact.approach - 1.0).abs() < 5e-4, "{step:?} {exact:?}");
    let area = std::f64::consts::PI * exact.semi_axes[0] * exact.semi_axes[1];
    assert!((step.contact_area / area - 1.0).abs() < 5e-3, "{} against {area}", step.contact_area);
}
