//! What the normal problem may cost: operator applications on all levels, weighted by cells, the final check on the whole grid
//! included. Counts are the same on every machine.

use fret_validation::{Sphere, solved};

/// Weighted applications of a first contact under the whole force.
fn cost(sphere: &Sphere) -> f64 {
    let history = solved(&sphere.pressed(1.0, 1, "linear"));
    history.steps[0].work.full_grid_convolutions
}

#[test]
fn a_hertz_contact_costs_five_convolutions_on_any_grid() {
    for cells in [128, 129, 200, 256] {
        let found = cost(&Sphere { cells, size: 4.0, ..Sphere::default() });
        println!("{cells} cells a side: {found:.2}");
        assert!(found <= 5.0, "{cells}: {found}");
    }
}

#[test]
fn common_coatings_cost_ten() {
    // contact radii of a unit sphere pressed to a radius of 1 without coating, side three times that
    for (ratio, thickness, radius) in [
        (0.1, 0.1, 1.279),
        (0.1, 1.0, 1.9),
        (0.5, 1.0, 1.25),
        (2.0, 0.1, 0.965),
        (2.0, 1.0, 0.82),
        (10.0, 1.0, 0.484),
    ] {
        let coating = Some((ratio, thickness));
        let found = cost(&Sphere { cells: 128, size: 3.0 * radius, coating, ..Sphere::default() });
        println!("E1/E2 = {ratio}, h = {thickness} a: {found:.2}");
        assert!(found <= 10.0, "{ratio} {thickness}: {found}");
    }
}

#[test]
fn a_stiff_thin_coating_settles() {
    for cells in [64, 128] {
        let coating = Some((1e3, 0.1));
        let found = cost(&Sphere { cells, size: 3.0 * 0.3841, coating, ..Sphere::default() });
        println!("E1/E2 = 1000, h = 0.1 a, {cells} cells a side: {found:.2}");
        assert!(found <= 40.0, "{cells}: {found}");
    }
}
