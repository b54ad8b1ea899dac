//! Loadings: normal and tangential force that vary together, turning forces, twist, mixed controls, tables, steady cycles.

use std::f64::consts::PI;
use std::fmt::Write;

use fret_core::analytic::{Hertz, Torsion, Westergaard};
use fret_core::case::{Attachments, Case};
use fret_core::history::{CycleRegime, History};
use fret_core::model::Zone;
use fret_core::plan::Plan;
use fret_core::run::{Silent, Simulation};
use fret_validation::{RADIUS, Sphere, by_end_points, keeping, solved};

use crate::reduced_contact::Springs;

const FRICTION: f64 = 0.3;

/// Similar bodies with nu = 0: what the one-dimensional theories describe exactly.
fn similar(cells: usize) -> Sphere {
    Sphere { cells, size: 2.4, poisson: 0.0, identical: true, friction: FRICTION, ..Sphere::default() }
}

fn springs(sphere: &Sphere) -> Springs {
    Springs::new(RADIUS, sphere.effective_modulus(), sphere.effective_shear_modulus(), FRICTION, 1.2)
}

/// A stage that leads to normal force `p` and tangential force `t`, both over the force of one length.
fn stage(sphere: &Sphere, p: f64, t: f64, increments: usize) -> String {
    let force = sphere.force();
    format!(
        "[[load]]\nnormal_force = {:e}\ntangential_force = [{:e}, 0.0]\nincrements = {increments}\n",
        p * force,
        t * force
    )
}

/// Steps that the row of springs takes in an increment.
const STEPS: usize = 16;

/// Runs through points (P, T) by straight lines; the largest difference of shift over its range, and of shear (rms in mu p0),
/// against the row of springs, which takes the same increments.
fn against_springs(points: &[(f64, f64)], increments: usize, cells: usize) -> (f64, f64) {
    let sphere = similar(cells);
    let mut text = sphere.head();
    for &(p, t) in points {
        text += &stage(&sphere, p, t, increments);
    }
    let history = solved(&(text + &keeping(1)));
    let mut springs = springs(&sphere);
    let (mut last, mut worst, mut range) = ((0.0, 0.0), 0.0_f64, 0.0_f64);
    let (mut k, mut worst_shear) = (0, 0.0_f64);
    for &(p, t) in points {
        for part in 1..=increments {
            for step in 1..=STEPS {
                let share = (part as f64 - 1.0 + step as f64 / STEPS as f64) / increments as f64;
                let at = (last.0 + (p - last.0) * share, last.1 + (t - last.1) * share);
                springs.press(at.0 * sphere.force());
                springs.pull(at.1 * sphere.force());
            }
            worst = worst.max((history.steps[k].shift[0] - springs.shift).abs());
            range = range.max(springs.shift.abs());
            k += 1;
        }
        last = (p, t);
        let shear = &history.fields[k - 1].shear.as_ref().unwrap()[0];
        let (mut square, mut inside) = (0.0, 0.0);
        let radius = (springs.approach * RADIUS).sqrt();
        for ((i, j), q) in shear.indexed_iter() {
            let r = history.grid.centre(0, i).hypot(history.grid.centre(1, j));
            if r < radius {
                square += (q - springs.shear(r)).powi(2);
                inside += 1.0;
            }
        }
        worst_shear =
            worst_shear.max((square / f64::max(inside, 1.0)).sqrt() / (FRICTION * sphere.max_pressure()));
    }
    (worst / range, worst_shear)
}

#[test]
fn the_springs_are_mindlin_and_deresiewicz() {
    use fret_core::analytic::TangentialHistory;
    let sphere = similar(16);
    let hertz = Hertz::sphere(RADIUS, sphere.force(), sphere.effective_modulus()).unwrap();
    let mut exact = TangentialHistory::new(&hertz, FRICTION, sphere.effective_shear_modulus()).unwrap();
    let mut springs = springs(&sphere);
    springs.press(sphere.force());
    for share in [0.8, -0.5, 0.3, -0.9] {
        let pull = share * FRICTION * sphere.force();
        exact.push(pull).unwrap();
        springs.pull(pull);
        // Midpoint sums over 4000 springs.
        assert!((springs.shift / exact.shift() - 1.0).abs() < 1e-5, "{} {}", springs.shift, exact.shift());
        assert!((springs.shear(0.3) - exact.shear(0.3)).abs() < 1e-4 * FRICTION * sphere.max_pressure());
    }
    assert!((springs.dissipated / exact.dissipated_energy() - 1.0).abs() < 1e-3);
}

#[test]
fn normal_and_tangential_force_that_rise_together_below_friction_stick() {
    // Mindlin and Deresiewicz, dT/dP = l < mu from the start: q = l p everywhere, shift = l d E* / (4 G*), no slip.
    let sphere = similar(48);
    let share = 0.2;
    let exact =
        share * sphere.approach() * sphere.effective_modulus() / (4.0 * sphere.effective_shear_modulus());
    let off = |increments: usize| {
        let text = sphere.head()
            + &stage(&sphere, 1.0, share, increments)
            + "ramp = \"cubic\"\n"
            + &keeping(increments);
        let history = solved(&text);
        // A cell that enters the contact between two increments meets the whole motion of its increment with little
        // pressure, and may slip: only there.
        let before = (history.steps[increments - 2].approach * RADIUS).sqrt();
        for ((i, j), zone) in history.fields.last().unwrap().zone.as_ref().unwrap().indexed_iter() {
            let r = history.grid.centre(0, i).hypot(history.grid.centre(1, j));
            let entered = r > before - history.grid.spacing()[0];
            assert!(*zone != Zone::Slip || entered, "slip at r = {r}, inside {before}");
        }
        let last = history.steps.last().unwrap();
        let lost = last.dissipated_energy / (last.tangential_force[0] * last.shift[0]);
        ((last.shift[0] / exact - 1.0).abs(), lost)
    };
    let errors = [8, 16, 32].map(off);
    println!("together: shift off and energy lost at 8, 16, 32 cubic increments: {errors:?}");
    // End points are off by 4.8, 2.5, 1.3 %. From 32 increments on the edge moves by less than a cell in each, and what
    // cells go on before they touch counts in part only.
    assert!(errors[0].0 < 2e-2 && errors[1].0 < 5e-3 && errors[2].0 < 7e-3, "{errors:?}");
    assert!(errors.iter().all(|(_, lost)| *lost < 5e-4), "{errors:?}");
}

#[test]
#[ignore = "long: 3 s"]
fn changing_normal_force_all_the_cases_of_mindlin_and_deresiewicz() {
    let mu = FRICTION;
    // P up or down, with T up or down, from a loading or an unloading branch, faster or slower than mu: their table.
    let cases: [(&str, &[(f64, f64)]); 6] = [
        ("T up, P up slowly", &[(0.5, 0.0), (0.5, 0.3 * mu), (1.0, 0.9 * mu)]),
        ("T up, P up fast", &[(0.5, 0.0), (0.5, 0.3 * mu), (1.0, 0.45 * mu)]),
        ("T up, P down", &[(1.0, 0.0), (1.0, 0.3 * mu), (0.6, 0.5 * mu)]),
        ("T down, P up", &[(0.5, 0.0), (0.5, 0.4 * mu), (1.0, 0.1 * mu)]),
        ("T down, P down", &[(1.0, 0.0), (1.0, 0.7 * mu), (0.6, 0.2 * mu)]),
        ("T constant, P round", &[(1.0, 0.0), (1.0, 0.5 * mu), (0.6, 0.5 * mu), (1.0, 0.5 * mu)]),
    ];
    for (name, points) in cases {
        let (shift, shear) = against_springs(points, 24, 64);
        println!("{name}: shift {shift:.1e}, shear rms {shear:.1e} mu p0");
        // Shift: below the grid's h^2 at a contact radius of 27 cells (1e-3). Where the contact grows the increments are off by 1.7e-3,
        // 5.2e-4, 1.5e-4 at 6, 12, 24 (end points 4.1e-3, 2.2e-3, 1.0e-3). Shear: the vertical slopes at the borders of stick
        // and at the rim, smeared over a cell: up to mu p0 on a share of 1e-4 of the contact.
        assert!(shift < 5e-4, "{name}: {shift}");
        assert!(shear < 2e-2, "{name}: {shear}");
    }
}

#[test]
#[ignore = "long: 40 s"]
fn normal_and_tangential_cycles_in_and_out_of_phase() {
    for phase in [0.0, 90.0, 180.0] {
        let sphere = similar(48);
        // A quarter of a cycle apart, where the contact grows while slip turns, the second order is worse than end points below that: at 96
        // its shift is 1.3e-3 off and its energy .4 %, theirs 4.8e-4 and -.1 %.
        let (force, increments) = (sphere.force(), 192);
        let mut text = sphere.head();
        text += &stage(&sphere, 0.7, 0.0, 6);
        let _ = write!(
            text,
            "[[load]]\nnormal_force = {:e}\ntangential_force = [{:e}, 0.0]\nincrements = {increments}\ncycles = 2\n\
             waveform = \"sine\"\nphase = {{ normal_force = {phase:?} }}\n",
            0.2 * force,
            0.4 * FRICTION * force
        );
        let history = solved(&text);
        // Springs follow a normal force that changes to first order in their steps.
        let mut springs = springs(&sphere);
        let (mut worst, mut range) = (0.0_f64, 0.0_f64);
        for (k, step) in history.steps.iter().enumerate() {
            for part in 1..=STEPS {
                let after = k as f64 + part as f64 / STEPS as f64;
                let turn = 2.0 * PI * (after - 6.0).max(0.0) / f64::from(increments);
                let ahead = f64::to_radians(phase);
                let cycled = 0.7 + 0.2 * ((turn + ahead).sin() - ahead.sin());
                springs.press(force * if after < 6.0 { 0.7 * after / 6.0 } else { cycled });
                springs.pull(0.4 * FRICTION * force * turn.sin());
            }
            if k >= 6 {
                let turn = 2.0 * PI * (k - 5) as f64 / f64::from(increments);
                let phase = f64::to_radians(phase);
                // The cycle goes on from where the control is.
                let p = 0.7 + 0.2 * ((turn + phase).sin() - phase.sin());
                assert!((step.normal_force / (p * force) - 1.0).abs() < 1e-7);
                assert!(
                    (step.tangential_force[0] - 0.4 * FRICTION * force * turn.sin()).abs() < 1e-7 * force
                );
            }
            worst = worst.max((step.shift[0] - springs.shift).abs());
            range = range.max(springs.shift.abs());
        }
        let energy = history.steps.last().unwrap().dissipated_energy / springs.dissipated - 1.0;
        println!("phase {phase}: shift off {:.1e}, energy off {energy:.1e}", worst / range);
        // The grid: a contact radius of 17 to 20 cells. Energy counts the annulus of slip, a few cells wide.
        assert!(worst / range < 1e-3, "{phase}: {}", worst / range);
        assert!(energy.abs() < 1e-2, "{phase}: {energy}");
    }
}

/// A long wave pressed on similar bodies: a plane problem, for which superposition is exact whatever Poisson's ratio.
#[test]
fn superposition_of_jaeger_and_ciavarella_for_a_plane_contact() {
    let (cells, poisson, amplitude, length) = (512, 0.3, 0.01, 1.0);
    let modulus = 1.0 / (2.0 * (1.0 - poisson * poisson));
    let full = PI * modulus * amplitude / length;
    let (pressure, mu) = (0.4 * full, 0.2);
    let width = 4.0 * length / cells as f64;
    let area = length * width;
    let (p, t) = (pressure * area, 0.7 * mu * pressure * area);
    let text = format!(
        "[grid]\ncells = [{cells}, 4]\nsize = [{length}, {width:e}]\nperiodic = true\n[upper]\nsubstrate = {{ young = 1.0, poisson = {poisson} }}\n\
         [lower]\nsubstrate = {{ young = 1.0, poisson = {poisson} }}\n[profile.wave]\namplitude = {amplitude}\nwavelength_x = {length}\n\
         [friction]\ncoefficient = {mu}\n[[load]]\nnormal_force = {p:e}\nincrements = 1\n\
         [[load]]\ntangential_force = [{t:e}, 0.0]\nincrements = 8\n\
         [[load]]\ntangential_force = [{:e}, 0.0]\nincrements = 8\n[output]\nevery = 8\n",
        -0.2 * t
    );
    let history = solved(&text);
    let at = |mean: f64| Westergaard::new(amplitude, length, mean, modulus).unwrap();
    let (whole, first) = (at(pressure), at(pressure - t / area / mu));
    let second = at(pressure - 1.2 * t / area / (2.0 * mu));
    for (kept, name) in history.fields.iter().skip(1).zip(["loading", "unloading"]) {
        let q = &kept.shear.as_ref().unwrap()[0];
        let (mut square, mut reference) = (0.0, 0.0);
        for i in 0..cells {
            let x = history.grid.centre(0, i);
            let exact = if name == "loading" {
                mu * (whole.pressure(x) - first.pressure(x))
            } else {
                mu * (whole.pressure(x) - first.pressure(x))
                    - 2.0 * mu * (whole.pressure(x) - second.pressure(x))
            };
            square += (q[[i, 1]] - exact).powi(2);
            reference += (mu * whole.pressure(x)).powi(2);
        }
        let off = (square / reference).sqrt();
        println!("plane superposition, {name}: {off:.1e}");
        // Square-root ends of the shear at the borders of stick and of contact, in cells of 1/512 of the wavelength.
        assert!(off < 5e-3, "{name}: {off}");
    }
}

/// Twist by `moments` over the full-slip moment, in turn.
fn twisted(sphere: &Sphere, shares: &[f64], increments: usize) -> History {
    let limit = 3.0 * PI * sphere.friction * sphere.force() / 16.0;
    let mut text = sphere.pressed(1.0, 1, "linear");
    for share in shares {
        let _ = write!(text, "[[load]]\ntwist_moment = {:e}\nincrements = {increments}\n", share * limit);
    }
    solved(&(text + &keeping(increments)))
}

#[test]
fn torsion_of_lubkin_and_its_reversal() {
    let sphere = similar(96);
    let hertz = Hertz::sphere(RADIUS, sphere.force(), sphere.effective_modulus()).unwrap();
    let shear_modulus = 0.5 / 2.0; // 1/G = sum 1/G, two bodies of E = 1, nu = 0
    let exact = |share: f64| {
        let limit = Torsion::full_slip_moment(&hertz, FRICTION).unwrap();
        Torsion::under_moment(&hertz, FRICTION, shear_modulus, share * limit).unwrap()
    };
    let history = twisted(&sphere, &[0.2, 0.6, 0.9, -0.9], 4);
    for (index, share) in [0.2, 0.6, 0.9].into_iter().enumerate() {
        let step = &history.steps[4 * (index + 1)];
        let reference = exact(share);
        let off = step.twist / reference.twist - 1.0;
        let stick =
            (step.stick_area / step.contact_area).sqrt() - reference.stick_radius / hertz.contact_radius;
        let kept = history.fields_of(step.increment).unwrap();
        let [qx, qy] = kept.shear.as_ref().unwrap();
        let (mut square, mut inside) = (0.0, 0.0);
        for ((i, j), qx) in qx.indexed_iter() {
            let (x, y) = (history.grid.centre(0, i), history.grid.centre(1, j));
            let r = x.hypot(y);
            if r < hertz.contact_radius {
                let around = (qy[[i, j]] * x - qx * y) / r;
                square += (around - reference.shear(r)).powi(2);
                inside += 1.0;
            }
        }
        let rms = f64::sqrt(square / inside) / (FRICTION * hertz.max_pressure);
        println!("torsion {share}: twist {off:.1e}, stick radius {stick:.1e}, shear rms {rms:.1e}");
        // Contact radius of 40 cells: h^2 is 6e-4. A stick radius is known to a part of a cell (0.025); the shear is smeared over
        // a cell at the border of stick and at the rim.
        assert!(off.abs() < 1e-3, "{share}: {off}");
        assert!(stick.abs() < 0.5 / 40.0, "{share}: {stick}");
        assert!(rms < 6e-3, "{share}: {rms}");
    }
    // At constant pressure Masing's rule holds: the way back from +M to -M is a first loading with everything doubled.
    let back = history.steps.last().unwrap().twist / -exact(0.9).twist - 1.0;
    println!("torsion reversed: twist {back:.1e}");
    assert!(back.abs() < 1e-3, "{back}");
}

#[test]
fn a_small_moment_and_the_full_slip_moment() {
    let sphere = similar(96);
    let history = twisted(&sphere, &[1e-3], 1);
    let step = history.steps.last().unwrap();
    let stiffness = 16.0 * 0.25 / 3.0;
    // A slip annulus half a cell wide remains.
    assert!(
        (step.twist_moment / step.twist / stiffness - 1.0).abs() < 5e-3,
        "{}",
        step.twist_moment / step.twist
    );
    // Hetenyi and McDonald: turned far, every cell slips around the axis and M = 3 pi mu P a / 16.
    let text = format!(
        "{}[[load]]\ntwist = 0.05\nincrements = 3\n[[load]]\ntwist = -0.05\nincrements = 3\n",
        sphere.pressed(1.0, 1, "linear")
    );
    let history = solved(&text);
    let full = 3.0 * PI * FRICTION * sphere.force() / 16.0;
    for (k, sign) in [(3, 1.0), (6, -1.0)] {
        let off = sign * history.steps[k].twist_moment / full - 1.0;
        println!("full slip moment: {off:.1e}, {:?}", history.steps[k].regime);
        // The sum of r p over square cells, and a twist that is large but finite.
        assert!(off.abs() < 2e-4, "{off}");
    }
}

#[test]
fn shift_and_twist_far_together_follow_the_sliding_velocity() {
    // Rigid sliding with velocity v = (1 - w y, w x): q = -mu p v/|v| once elastic strains are outrun.
    let sphere = similar(64);
    let text = format!(
        "{}[[load]]\nshift = [1.0, 0.0]\ntwist = 1.0\nincrements = 6\n",
        sphere.pressed(1.0, 1, "linear")
    );
    let history = solved(&text);
    let last = history.steps.last().unwrap();
    let (mut force, mut moment) = (0.0, 0.0);
    let n = 400;
    for i in 0..n {
        let r = (f64::from(i) + 0.5) / f64::from(n);
        for j in 0..n {
            let (sin, cos) = (2.0 * PI * (f64::from(j) + 0.5) / f64::from(n)).sin_cos();
            let (x, y) = (r * cos, r * sin);
            let (vx, vy) = (1.0 - y, x);
            let size = vx.hypot(vy);
            let q = FRICTION * sphere.max_pressure() * (1.0 - r * r).sqrt() / size * r * 2.0 * PI
                / f64::from(n).powi(2);
            force += q * vx;
            moment += q * (x * vy - y * vx);
        }
    }
    let off = [last.tangential_force[0] / force - 1.0, last.twist_moment / moment - 1.0];
    println!("sliding and turning: force {:.1e}, moment {:.1e}", off[0], off[1]);
    // The grid, as in the full slip moment (4e-5), and elastic shifts of 1e-2 against a motion of 1; the axis of rotation lies on the rim, where p vanishes.
    assert!(off.iter().all(|off| off.abs() < 1e-3), "{off:?}");
}

/// A tangential force turning on a circle, after it was built up along x.
fn turning(
    amplitude: f64,
    (increments, integration): (usize, &str),
    coating: Option<(f64, f64)>,
    more: &str,
) -> (Sphere, History) {
    let sphere = Sphere { coating, ..Sphere { cells: 32, ..similar(32) } };
    let pull = amplitude * FRICTION * sphere.force();
    let text = format!(
        "{}[[load]]\ntangential_force = [{pull:e}, 0.0]\nincrements = 4\n\
         [[load]]\ntangential_force = [{pull:e}, {pull:e}]\nphase = {{ tangential_force = [90, 0] }}\nwaveform = \"sine\"\n\
         increments = {increments}\ncycles = 3\n{more}",
        sphere.pressed(1.0, 1, "linear")
    );
    let text = text.replacen("[solver]\n", &format!("[solver]\nintegration = \"{integration}\"\n"), 1);
    (sphere, solved(&(text + &keeping(1))))
}

fn assert_turns(per_turn: usize, integration: &str, [most, most_spread]: [f64; 2]) {
    let (sphere, history) = turning(0.7, (per_turn, integration), None, "");
    let pull = 0.7 * FRICTION * sphere.force();
    let steps = &history.steps;
    for step in &steps[4..] {
        let size = step.tangential_force[0].hypot(step.tangential_force[1]);
        assert!((size / pull - 1.0).abs() < 1e-7, "the force keeps its size");
    }
    // After two turns: the state a quarter of a turn later is the state turned by a quarter. Exact on a square grid.
    let (a, b) =
        (&history.fields[5 + 2 * per_turn - 1], &history.fields[5 + 2 * per_turn - 1 + per_turn / 4]);
    let (a, b) = (a.shear.as_ref().unwrap(), b.shear.as_ref().unwrap());
    let n = sphere.cells;
    let mut worst = 0.0_f64;
    for i in 0..n {
        for j in 0..n {
            // (x, y) -> (-y, x): cell (i, j) goes to (n-1-j, i), (qx, qy) to (-qy, qx).
            let to = [n - 1 - j, i];
            worst = worst.max((b[0][to] + a[1][[i, j]]).abs()).max((b[1][to] - a[0][[i, j]]).abs());
        }
    }
    let worst = worst / (FRICTION * sphere.max_pressure());
    let sizes: Vec<f64> =
        steps.iter().skip(5 + 2 * per_turn - 4).map(|step| step.shift[0].hypot(step.shift[1])).collect();
    let spread =
        sizes.iter().copied().fold(0.0, f64::max) / sizes.iter().copied().fold(f64::INFINITY, f64::min) - 1.0;
    // Steady after two turns up to the memory of the start, which decays; the rest is the grid's anisotropy.
    assert!(worst < most, "{worst}");
    assert!(spread < most_spread, "{spread}");
}

#[test]
fn a_turning_force_leads_to_a_turning_state() {
    assert_turns(16, "end_point", [1e-3, 2e-4]);
    // Which cells at the border of stick come to rest in an increment, and with which offset, is not symmetrical: single cells of 700.
    assert_turns(16, "second_order", [1e-2, 1e-3]);
}

#[test]
fn a_turning_force_at_the_limit_slides_everywhere_and_a_small_one_hardly() {
    let (_, small) = turning(0.05, (16, "second_order"), None, "");
    let slipping = small.steps.last().unwrap();
    // c/a = (1 - f)^(1/3) = 0.983 for the first pull: less than a cell of the rim.
    assert!(slipping.stick_area > 0.85 * slipping.contact_area);
    let (_, large) = turning(0.999, (16, "second_order"), None, "");
    let last = large.steps.last().unwrap();
    assert!(last.stick_area < 0.1 * last.contact_area, "{}", last.stick_area / last.contact_area);
}

#[test]
fn a_spiral_grows_along_its_envelope() {
    let sphere = similar(32);
    let pull = 0.8 * FRICTION * sphere.force();
    let text = format!(
        "{}[[load]]\ntangential_force = [{pull:e}, {pull:e}]\nphase = {{ tangential_force = [90, 0] }}\nwaveform = \"sine\"\n\
         envelope = [0, 1]\nincrements = 12\ncycles = 2\n",
        sphere.pressed(1.0, 1, "linear")
    );
    let history = solved(&text);
    for (k, step) in history.steps.iter().enumerate().skip(1) {
        let share = k as f64 / 24.0;
        let size = step.tangential_force[0].hypot(step.tangential_force[1]);
        assert!((size / pull - share).abs() < 1e-7, "{k}: {size} {share}");
    }
    let slipped: Vec<f64> = history.steps.iter().skip(1).map(|step| step.dissipated_energy).collect();
    assert!(slipped.windows(2).all(|pair| pair[1] >= pair[0]));
}

#[test]
fn force_along_x_with_motion_held_along_y() {
    let sphere = Sphere { poisson: 0.3, ..similar(32) };
    let pull = 0.6 * FRICTION * sphere.force();
    let text = format!(
        "{}[[load]]\ntangential_force = [{pull:e}, \"held\"]\nshift = [\"held\", {:e}]\nincrements = 6\n",
        sphere.pressed(1.0, 1, "linear"),
        1e-4
    );
    // By end points: how long an increment is beside the last, which the rule of second order asks for, is told by what is prescribed.
    let text = by_end_points(&text);
    let history = solved(&text);
    let last = history.steps.last().unwrap();
    assert!((last.tangential_force[0] / pull - 1.0).abs() < 1e-7);
    assert_eq!(last.shift[1], 1e-4);
    assert!(last.shift[0] > 0.0 && last.tangential_force[1] > 0.0);
    // The same end by motions alone along the same path is the same state: a control is a way of asking, not another law.
    let mut table = String::from("shift_x,shift_y\n");
    for step in &history.steps[1..] {
        let _ = writeln!(table, "{:?},{:?}", step.shift[0], step.shift[1]);
    }
    let text =
        format!("{}[[load]]\ntable = \"path.csv\"\nincrements = 1\n", sphere.pressed(1.0, 1, "linear"));
    let beside = |name: &str| {
        assert_eq!(name, "path.csv");
        Ok(table.clone().into_bytes())
    };
    let case = Case::from_toml_with(&by_end_points(&text), "case.toml", Attachments::files(&beside));
    let by_motion = Simulation::new(&Plan::new(case.unwrap()).unwrap()).run(&mut Silent).unwrap();
    let again = by_motion.steps.last().unwrap();
    // Both are solved to 1e-8 of mu W.
    assert!((again.tangential_force[0] / pull - 1.0).abs() < 1e-6);
    assert!((again.tangential_force[1] - last.tangential_force[1]).abs() < 1e-6 * pull);
}

#[test]
fn gross_slip_and_reversal_and_what_a_cycle_says_of_itself() {
    let sphere = similar(64);
    let full = FRICTION * sphere.force();
    let onset = 3.0 * full / (16.0 * sphere.effective_shear_modulus());
    let cycle = |amplitude: f64| {
        let text = format!(
            "{}[[load]]\nshift = [{:e}, 0.0]\nincrements = 80\ncycles = 2\n",
            sphere.pressed(1.0, 1, "linear"),
            amplitude * onset
        );
        solved(&text).cycles[1].clone()
    };
    // Rigid-plastic with an elastic start: beyond the onset the loop grows by 4 mu P for every unit of amplitude.
    let (partial, gross) = (cycle(0.5), cycle(3.0));
    let exact = (0.15 * full * full / sphere.effective_shear_modulus() + 4.0 * full * 2.0 * onset)
        / (4.0 * full * 3.0 * onset);
    let ratio = gross.energy_ratio.unwrap();
    println!(
        "gross slip: energy ratio {ratio:.4} exact {exact:.4}; partial {:.4}",
        partial.energy_ratio.unwrap()
    );
    // 80 increments a cycle: one of 0.15 onset at each turn carries the loop's curved part.
    assert!((ratio / exact - 1.0).abs() < 2e-3, "{ratio} {exact}");
    assert_eq!(gross.regime, Some(CycleRegime::GrossSlip));
    assert_eq!(partial.regime, Some(CycleRegime::PartialSlip));
    assert!((gross.force_amplitude / full - 1.0).abs() < 1e-6);
    // Partial slip at f = 1 - (1 - 0.5)^(3/2): Mindlin and Deresiewicz's energy over 4 Q* d*.
    let f = 1.0 - 0.5_f64.powf(1.5);
    let energy = 0.9 * full * full / sphere.effective_shear_modulus()
        * (1.0 - (1.0 - f).powf(5.0 / 3.0) - 5.0 * f / 6.0 * (1.0 + (1.0 - f).powf(2.0 / 3.0)));
    let exact = energy / (4.0 * f * full * 0.5 * onset);
    assert!((partial.energy_ratio.unwrap() / exact - 1.0).abs() < 2e-2, "{:?} {exact}", partial.energy_ratio);
    // Opening: displacement at T = 0 on the way back, over the amplitude.
    let opening = 1.0 - 2.0 * (1.0 - (1.0 - f / 2.0).powf(2.0 / 3.0)) / 0.5;
    assert!((partial.sliding_ratio.unwrap() - opening).abs() < 5e-3, "{:?} {opening}", partial.sliding_ratio);
    // Stiffness: the secant of the first increment back, of length s = 0.5/20 onset: 2 d = s, dT = 2 mu P (1 - (1 - s/2)^(3/2)).
    let s = 0.5 / 20.0;
    let secant = 2.0 * full * (1.0 - (1.0 - s / 2.0_f64).powf(1.5)) / (s * onset);
    println!("stiffness {:e} exact {secant:e}", partial.stiffness.unwrap());
    // The grid: a contact radius of 27 cells.
    assert!((partial.stiffness.unwrap() / secant - 1.0).abs() < 5e-3);
}

#[test]
fn a_cycle_is_repeated_until_it_closes() {
    let steady = |coating| {
        let sphere = Sphere {
            coating,
            poisson: if coating.is_some() { 0.3 } else { 0.0 },
            identical: coating.is_none(),
            ..similar(32)
        };
        let pull = 0.7 * FRICTION * sphere.force();
        let text = format!(
            "{}[[load]]\ntangential_force = [{pull:e}, 0.0]\nincrements = 12\nuntil_steady = {{ tolerance = 2e-3, most_cycles = 30 }}\n\
             [[load]]\nname = \"after\"\ntangential_force = [0.0, 0.0]\nincrements = 2\n",
            sphere.pressed(1.0, 6, "cubic")
        );
        solved(&text)
    };
    // Uncoupled: the first cycle ends with the memory of its reversals, the second repeats it to the solver's tolerance.
    let history = steady(None);
    assert_eq!(history.cycles.len(), 2);
    assert!(history.cycles[1].steady && history.cycles[1].closure < 1e-6, "{}", history.cycles[1].closure);
    assert_eq!(history.steps.len(), 6 + 24 + 2);
    assert_eq!(history.steps.last().unwrap().stage, 2);
    // Coupled: pressure and shear settle over several cycles.
    let history = steady(Some((2.0, 1.0)));
    let closures: Vec<f64> = history.cycles.iter().map(|cycle| cycle.closure).collect();
    println!("coupled closure by cycle: {closures:?}");
    let last = history.cycles.last().unwrap();
    assert!(last.steady && last.closure <= 2e-3 && history.cycles.len() < 30);
    assert!(closures.windows(2).all(|pair| pair[1] < pair[0]));
    assert!(history.cycles.iter().rev().skip(1).all(|cycle| !cycle.steady));
}
