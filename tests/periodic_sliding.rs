//! Surfaces of half-spaces that repeat, sliding: a shift of their mean planes against each other, up to full sliding and on.

use std::fs;
use std::path::Path;

use fret_core::history::{History, StepRecord};
use fret_validation::{keeping, run, solved, solved_with};
use ndarray::Array2;
use serde_json::Value;

use crate::sensitivities::{found, planned};

const FRICTION: f64 = 0.3;

/// A wave of amplitude 0.01 and length 1 between bodies of E* = 1 together, on a period of 1 x 0.1.
const WAVE: &str = "grid = { cells = [256, 4], size = [1.0, 0.1], periodic = true }\n\
    upper = { substrate = { young = 1.5, poisson = 0.5 } }\nlower = { substrate = { young = 1.5, poisson = 0.5 } }\n\
    profile = { wave = { amplitude = 0.01, wavelength_x = 1.0 } }\nfriction = { coefficient = 0.3 }\n";
const AMPLITUDE: f64 = 0.01;
const AREA: f64 = 0.1;

/// Mean pressure of full contact, `pi E* amplitude / length`.
const FULL: f64 = std::f64::consts::PI * AMPLITUDE;

/// How far the mean planes approach in a contact of Westergaard's wave at the fraction `s` of the pressure of full contact, from first touch
/// on: a small part more of it is a row of flat punches, whose approach is `-2 L/(pi E*) ln sin(pi a/L)` by mean pressure, with
/// `sin^2(pi a/L) = s`; from 0 to s this is `amplitude (s - s ln s)`. Beyond full contact nothing approaches any more.
fn approach(s: f64) -> f64 {
    if s < 1.0 { AMPLITUDE * s * (1.0 - s.ln()) } else { AMPLITUDE }
}

/// The fraction at which they have approached by `d`.
fn fraction(d: f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if approach(middle) < d { low = middle } else { high = middle }
    }
    low
}

/// Elastically similar bodies that answer along the surface as along the normal (plane strain across the line; any, for Poisson's ratio 0): shear is
/// `mu (p - p*)`, where p* is the pressure at the approach that is `shift / mu` less (Ciavarella, Jaeger). So the shift slides all of the contact
/// from `mu approach` on, and before that the force is `mu (P - P*)`. In full contact the first of it moves no surface, and is prescribed.
#[test]
fn a_wave_slides_from_a_shift_of_mu_times_its_approach_on() {
    for share in [0.3, 0.7, 1.6] {
        let onset = FRICTION * approach(share);
        let force = share * FULL * AREA;
        let mut text = format!("{WAVE}[[load]]\nnormal_force = {force:e}\nincrements = 1\n");
        let parts = [0.2, 0.5, 0.8, 0.95, 1.05, 2.0, 4.0];
        if share > 1.0 {
            let slips = FRICTION * (share - 0.95) * FULL * AREA;
            text += &format!("[[load]]\ntangential_force = [{slips:e}, 0.0]\nincrements = 1\n");
        }
        for part in parts {
            text += &format!("[[load]]\nshift = [{:e}, 0.0]\nincrements = 1\n", part * onset);
        }
        let history = solved(&text);
        let slid = &history.steps[history.steps.len() - parts.len()..];
        for (part, step) in parts.iter().zip(slid) {
            let less = if *part < 1.0 { fraction(approach(share) - part * onset / FRICTION) } else { 0.0 };
            let exact = FRICTION * (share - less) * FULL * AREA;
            let off = step.tangential_force[0] / exact - 1.0;
            println!(
                "{share} of full contact, {part} of the onset: force off by {off:.1e}, {} stick",
                step.stick_cells
            );
            // The edge of stick lies between cells: of second order in 256 cells a wave before sliding; then equilibrium alone.
            assert!(off.abs() < if *part < 1.0 { 1e-3 } else { 1e-9 }, "{share}, {part}: {off:e}");
            assert_eq!(step.stick_cells == 0, *part > 1.0, "{share}, {part}");
        }
        // What is dissipated in sliding is mu P times the way.
        let [before, after] = [4, 6].map(|number| &slid[number]);
        let way = 2.95 * onset;
        let work = after.dissipated_energy - before.dissipated_energy;
        let off = work / (FRICTION * force * way) - 1.0;
        assert!(off.abs() < 1e-9, "{share}: work off by {off:e}");
        assert!((after.shift[0] - before.shift[0] - way).abs() < 1e-12 * way);
    }
}

/// Where all of it touches and sticks a shift fixes no force: that is said with a way, which the test above takes.
#[test]
fn a_shift_of_a_full_contact_that_sticks_is_told_a_way() {
    let text = format!(
        "{WAVE}[[load]]\nnormal_force = {:e}\nincrements = 1\n[[load]]\nshift = [6e-4, 0.0]\nincrements = 1\n",
        1.6 * FULL * AREA
    );
    let error = run(&text).unwrap_err().to_string();
    assert!(error.contains("touch everywhere and stick") && error.contains("tangential_force"), "{error}");
}

/// Heights of a rough surface of 40 x 40 cells, and the side of its period.
fn rough() -> (Array2<f64>, f64, f64) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("golden/rough_contact.json");
    let golden: Value = serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap();
    let rows: Vec<Vec<f64>> = serde_json::from_value(golden["period"]["heights"].clone()).unwrap();
    let heights = Array2::from_shape_fn((rows.len(), rows[0].len()), |(i, j)| rows[i][j]);
    let size = golden["size"].as_f64().unwrap();
    (heights, size, golden["period"]["mean_pressure"].as_f64().unwrap() * size * size)
}

/// That rough surface between `bodies`, pressed by its force, and then as `loads` say.
fn pressed(bodies: &str, loads: &str) -> History {
    pressed_from([0, 0], bodies, loads)
}

/// The same with the period cut at another cell.
fn pressed_from(first: [usize; 2], bodies: &str, loads: &str) -> History {
    let (heights, size, force) = rough();
    let [nx, ny] = [heights.nrows(), heights.ncols()];
    let heights =
        Array2::from_shape_fn((nx, ny), |(i, j)| heights[[(i + first[0]) % nx, (j + first[1]) % ny]]);
    let text = format!(
        "grid = {{ cells = [40, 40], size = [{size:?}, {size:?}], periodic = true }}\n{bodies}\
         profile = {{ heights = {{ values = {{ array = 0 }} }} }}\nfriction = {{ coefficient = {FRICTION} }}\n\
         [[load]]\nnormal_force = {force:e}\nincrements = 1\n{loads}{}",
        keeping(1)
    );
    solved_with(&text, &[heights])
}

const RIGID_ON_ELASTIC: &str =
    "upper = { rigid = true }\nlower = { substrate = { young = 1.0, poisson = 0.3 } }\n";

#[test]
fn a_rough_surface_slides_with_mu_p_in_every_cell() {
    let (_, _, force) = rough();
    // Of bodies that couple, along a direction that is no axis; ever further, so that slip everywhere comes to point along the shift.
    let approach = pressed(RIGID_ON_ELASTIC, "").steps[0].approach;
    let far = [10.0 * approach, -7.0 * approach];
    let length = far[0].hypot(far[1]);
    let stage = |times: f64| {
        format!("[[load]]\nshift = [{:e}, {:e}]\nincrements = 4\n", times * far[0], times * far[1])
    };
    let history = pressed(RIGID_ON_ELASTIC, &format!("{}{}", stage(1.0), stage(1000.0)));
    let end = history.steps.last().unwrap();
    let carried = FRICTION * force;
    assert_eq!(end.stick_cells, 0);
    for axis in 0..2 {
        let exact = carried * far[axis] / length;
        let off = end.tangential_force[axis] / exact - 1.0;
        assert!(off.abs() < 1e-7, "axis {axis}: {off:e}");
    }
    let fields = history.fields.last().unwrap();
    let (pressure, shear) = (fields.pressure.as_ref().unwrap(), fields.shear.as_ref().unwrap());
    let largest = pressure.iter().copied().fold(0.0, f64::max);
    for (cell, p) in pressure.indexed_iter() {
        for axis in 0..2 {
            let off = shear[axis][cell] - FRICTION * p * far[axis] / length;
            assert!(off.abs() < 1e-6 * largest, "{cell:?}: {off:e} for {largest:e}");
        }
    }
    let way = 999.0 * length / 4.0;
    // the last increments, of which each slides a quarter of the last stage
    for pair in history.steps[history.steps.len() - 3..].windows(2) {
        let off = (pair[1].dissipated_energy - pair[0].dissipated_energy) / (carried * way) - 1.0;
        assert!(off.abs() < 1e-7, "{off:e}");
    }
}

/// Where a period is cut is a choice of whoever writes the file: areas, energies and tractions are the same.
#[test]
fn a_rough_surface_is_the_same_wherever_its_period_is_cut() {
    // a contact that grows and shrinks while it slips: the second order looks at the edge that comes
    let (_, _, force) = rough();
    let loads = format!(
        "[[load]]\nnormal_force = {:e}\ntangential_force = [{:e}, 0.0]\nincrements = 4\ncycles = 1\n",
        0.3 * force,
        0.2 * FRICTION * force
    );
    let numbers = |step: &StepRecord| {
        let StepRecord { contact_area, stick_area, approach, max_pressure, dissipated_energy, .. } = *step;
        [contact_area, stick_area, approach, max_pressure, dissipated_energy, step.shift[0]]
    };
    let whole = pressed_from([0, 0], RIGID_ON_ELASTIC, &loads);
    let largest =
        |number: usize| whole.steps.iter().map(|step| numbers(step)[number].abs()).fold(0.0, f64::max);
    for first in [[17, 0], [5, 31], [39, 20]] {
        let cut = pressed_from(first, RIGID_ON_ELASTIC, &loads);
        for (one, other) in whole.steps.iter().zip(&cut.steps) {
            let (one, other) = (numbers(one), numbers(other));
            for number in 0..one.len() {
                // the solver's tolerance of 1e-8, as far as numbers follow it
                let off = (one[number] - other[number]).abs();
                assert!(off <= 1e-6 * largest(number), "{first:?}, number {number}: {one:?} {other:?}");
            }
        }
    }
}

/// Poisson's ratio 0 and elastically similar bodies: the law above holds of any surface, with the pressures of the same program
/// without friction.
#[test]
fn a_rough_surface_is_sheared_as_much_as_it_is_pressed_less() {
    let similar = "upper = { substrate = { young = 2.0, poisson = 0.0 } }\nlower = { substrate = { young = 2.0, poisson = 0.0 } }\n";
    let (_, _, force) = rough();
    let less = 0.4;
    let unloaded =
        pressed(similar, &format!("[[load]]\nnormal_force = {:e}\nincrements = 1\n", less * force));
    let [whole, part] = [0, 1].map(|number| &unloaded.steps[number]);
    let shift = FRICTION * (whole.approach - part.approach);
    let history = pressed(similar, &format!("[[load]]\nshift = [{shift:e}, 0.0]\nincrements = 1\n"));
    let [p, p_less] = [0, 1].map(|number| unloaded.fields[number].pressure.as_ref().unwrap());
    let shear = &history.fields[1].shear.as_ref().unwrap()[0];
    let largest = p.iter().copied().fold(0.0, f64::max);
    let mut worst = 0.0_f64;
    for (cell, q) in shear.indexed_iter() {
        worst = worst.max((q - FRICTION * (p[cell] - p_less[cell])).abs() / (FRICTION * largest));
    }
    // The solver's tolerance of 1e-8, as far as tractions follow it.
    assert!(worst < 1e-6, "{worst:e}");
    let off = history.steps[1].tangential_force[0] / (FRICTION * (1.0 - less) * force) - 1.0;
    assert!(off.abs() < 1e-7, "{off:e}");
}

/// A machine's spring in series: its far end moves by the shift and the force over its stiffness.
#[test]
fn a_wave_slides_at_the_end_of_a_spring() {
    let (share, stiffness) = (0.5, 2.0);
    let force = share * FULL * AREA;
    let onset = FRICTION * approach(share);
    let carried = FRICTION * force;
    let far = 3.0 * onset + carried / stiffness;
    let text = format!(
        "{WAVE}rig = {{ tangential_stiffness = {stiffness} }}\n[[load]]\nnormal_force = {force:e}\nincrements = 1\n\
         [[load]]\nactuator = [{far:e}, 0.0]\nincrements = 6\n"
    );
    let history = solved(&text);
    let end = history.steps.last().unwrap();
    assert!((end.tangential_force[0] / carried - 1.0).abs() < 1e-9, "{}", end.tangential_force[0]);
    assert!((end.shift[0] / (3.0 * onset) - 1.0).abs() < 1e-8, "{}", end.shift[0]);
}

/// On the way the stiffness is that of the pressure below, `mu dP*/d(approach)/mu`: with `d approach = -amplitude ln s* ds*`.
#[test]
fn the_stiffness_before_sliding_is_that_of_the_closed_form() {
    let (share, part) = (0.7, 0.5);
    let onset = FRICTION * approach(share);
    let text = format!(
        "{WAVE}[[load]]\nnormal_force = {:e}\nincrements = 1\n[[load]]\nshift = [{:e}, 0.0]\nincrements = 1\n",
        share * FULL * AREA,
        part * onset
    );
    let found = found(&planned(&text), &["tangential_force_x"], &["load[1].shift[0]"]).unwrap();
    let stuck = fraction((1.0 - part) * approach(share));
    let exact = FULL * AREA / (-AMPLITUDE * stuck.ln());
    let off = found.gradients[0].by[0] / exact - 1.0;
    // Stick ends between cells, some 40 of which are in its half-width.
    assert!(off.abs() < 0.02, "{off:e}");
}
