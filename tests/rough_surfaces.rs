//! Surfaces by heights: the same contact as by formula, and rough contacts that independent packages solved.

use std::fs;
use std::path::Path;

use fret_validation::{pressed_on_half_space, solved, solved_with};
use ndarray::Array2;
use serde::Deserialize;

#[derive(Deserialize)]
struct Rough {
    mean_pressure: f64,
    contact_cells: usize,
    heights: Vec<Vec<f64>>,
    pressure: Vec<Vec<f64>>,
}

#[derive(Deserialize)]
struct RoughContacts {
    size: f64,
    ball: Rough,
    period: Rough,
}

fn array(rows: &[Vec<f64>]) -> Array2<f64> {
    Array2::from_shape_fn((rows.len(), rows[0].len()), |(i, j)| rows[i][j])
}

#[test]
fn rough_contacts_are_those_of_an_independent_solver() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("golden/rough_contact.json");
    let golden: RoughContacts = serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap();
    let size = golden.size;
    for (name, rough, repeats) in [("ball", golden.ball, false), ("period", golden.period, true)] {
        let text = pressed_on_half_space(
            [40, 40],
            &format!("size = [{size:?}, {size:?}]\nperiodic = {repeats}"),
            "[profile.heights]\nvalues = { array = 0 }\n[solver]\ntolerance = 1e-11",
            &format!("normal_force = {:e}", rough.mean_pressure * size * size),
        );
        let history = solved_with(&text, &[array(&rough.heights)]);
        let found = history.fields[0].pressure.as_ref().unwrap();
        let expected = array(&rough.pressure);
        let largest = expected.iter().copied().fold(0.0, f64::max);
        let off = (found - &expected).iter().fold(0.0_f64, |worst, d| worst.max(d.abs())) / largest;
        println!(
            "rough {name}: pressures off by {off:.1e} of the largest, {} cells in contact",
            rough.contact_cells
        );
        assert_eq!(history.steps[0].contact_cells, rough.contact_cells, "{name}");
        // The same kernels on the same cells: the tolerances of the two solvers, 1e-11 in the gap, are what is left.
        assert!(off < 1e-9, "{name}: {off:e}");
    }
}

#[test]
fn a_sphere_by_heights_is_the_sphere_by_formula() {
    let cells = [32, 24];
    let centre = |index: usize, cells: usize, side: f64| {
        (index as f64 - (cells as f64 - 1.0) / 2.0) * side / cells as f64
    };
    let gap = Array2::from_shape_fn(cells, |(i, j)| {
        (centre(i, 32, 2.4).powi(2) + centre(j, 24, 2.0).powi(2)) / 200.0
    });
    let contact = |profile: &str, array: Array2<f64>| {
        let text = pressed_on_half_space(
            cells,
            "size = [2.4, 2.0]",
            &format!("[profile.heights]\nvalues = {{ array = 0 }}\n{profile}"),
            "normal_force = 0.008",
        );
        solved_with(&text, &[array]).fields[0].pressure.clone().unwrap()
    };
    let text = pressed_on_half_space(
        cells,
        "size = [2.4, 2.0]",
        "[profile.sphere]\nradius = 100.0",
        "normal_force = 0.008",
    );
    let formula = solved(&text).fields[0].pressure.clone().unwrap();
    let largest = formula.iter().copied().fold(0.0, f64::max);
    let tilted = Array2::from_shape_fn(cells, |(i, j)| 7.0 + 1e-3 * i as f64 - 2e-3 * j as f64 - gap[[i, j]]);
    for (profile, array) in [
        ("of = \"gap\"", gap.clone()),
        ("of = \"surface\"", -gap.clone()),
        ("", 3.0 - gap.clone()),
        ("unit = 1e-6", gap.mapv(|g| -1e6 * g)),
        ("rows = \"y\"", -gap.t().to_owned()),
        ("detrend = \"mean\"", 5.0 - gap.clone()),
        ("detrend = \"plane\"", tilted),
    ] {
        let found = contact(profile, array);
        let off = (&found - &formula).iter().fold(0.0_f64, |worst, d| worst.max(d.abs())) / largest;
        // The gaps agree to the rounding of heights of a few units, 1e-15 of 3e-3; the solver's tolerance is 1e-8.
        assert!(off < 1e-7, "{profile}: {off:e}");
    }
    // A shape and heights: half a sphere each.
    let half = pressed_on_half_space(
        cells,
        "size = [2.4, 2.0]",
        "[profile.sphere]\nradius = 200.0\n[lower.profile.heights]\nvalues = { array = 0 }",
        "normal_force = 0.008",
    );
    let found = solved_with(&half, &[-gap / 2.0]).fields[0].pressure.clone().unwrap();
    assert!((&found - &formula).iter().all(|d| d.abs() < 1e-7 * largest));
}
