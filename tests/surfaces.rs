//! Shapes with closed forms, on a half-space of E = 1, nu = 0.3 without friction.

use std::f64::consts::PI;

use fret_core::analytic::{Cone, FlatPunch, Hertz, HertzLine, RoundedPunch};
use fret_core::history::History;
use fret_validation::{pressed_on_half_space, solved};

const MODULUS: f64 = 1.0 / 0.91;

/// Root mean square error of the pressure over the cells with radius below `reach`, in units of `unit`.
fn rms(history: &History, reach: f64, unit: f64, exact: impl Fn(f64) -> f64) -> f64 {
    let pressure = history.fields[0].pressure.as_ref().unwrap();
    let grid = history.grid;
    let inside = pressure.indexed_iter().filter_map(|((i, j), p)| {
        let r = grid.centre(0, i).hypot(grid.centre(1, j));
        (r < reach).then(|| (p - exact(r)).powi(2))
    });
    let squares: Vec<f64> = inside.collect();
    (squares.iter().sum::<f64>() / squares.len() as f64).sqrt() / unit
}

#[test]
fn a_flat_punch_is_as_stiff_as_boussinesq_says() {
    let exact = FlatPunch::new(1.0, 0.01, MODULUS).unwrap();
    let mean = 0.01 / PI;
    let mut errors = Vec::new();
    for cells in [48, 96, 192] {
        let text = pressed_on_half_space(
            [cells; 2],
            "size = [2.4, 2.4]",
            "[profile.flat_punch]\nradius = 1.0",
            "normal_force = 0.01",
        );
        let history = solved(&text);
        let step = &history.steps[0];
        let d = 2.4 / cells as f64;
        // The body ends between two cells: its area is that of the cells whose centres lie on it.
        assert!((step.contact_area / (step.contact_cells as f64 * d * d) - 1.0).abs() < 1e-12);
        let off = [step.approach / exact.approach - 1.0, rms(&history, 0.8, mean, |r| exact.pressure(r))];
        println!("flat punch, {cells} cells: approach {:.1e}, pressure within 0.8 a {:.1e}", off[0], off[1]);
        errors.push(off);
        let gap = history.fields[0].gap.as_ref().unwrap();
        assert!(gap.iter().all(|gap| gap.is_finite()));
    }
    // The edge is a staircase of cells, better or worse as the circle happens to fall: the stiffness is good to a share of a
    // cell of radius, here a seventh of 0.05, 0.025, 0.0125 radii.
    for (off, cell) in errors.iter().zip([0.05, 0.025, 0.0125]) {
        assert!(off[0].abs() < 0.15 * cell && off[1] < 0.25 * cell, "{errors:?}");
    }
}

#[test]
fn a_cone_has_love_s_pressure() {
    let exact = Cone::new(0.01, 0.017, MODULUS).unwrap();
    let mut errors = Vec::new();
    for cells in [64, 128] {
        let text = pressed_on_half_space(
            [cells; 2],
            "size = [2.4, 2.4]",
            "[profile.cone]\nslope = 0.01",
            "normal_force = 0.017",
        );
        let history = solved(&text);
        let step = &history.steps[0];
        let radius = (step.contact_area / PI).sqrt();
        // The logarithm at the tip is integrated over four cells; beyond 0.1 a the pressure is smooth.
        let exact_outside = |r: f64| if r < 0.1 { 0.0 } else { exact.pressure(r) };
        let pressure = history.fields[0].pressure.as_ref().unwrap();
        let mut square = 0.0;
        for ((i, j), p) in pressure.indexed_iter() {
            let r = history.grid.centre(0, i).hypot(history.grid.centre(1, j));
            square += if r < 0.1 { 0.0 } else { (p - exact_outside(r)).powi(2) };
        }
        errors.push([
            step.approach / exact.approach - 1.0,
            radius / exact.contact_radius - 1.0,
            (square / pressure.len() as f64).sqrt() / exact.mean_pressure,
        ]);
    }
    println!("cone, 64 and 128 cells: approach, radius, pressure {errors:.6?}");
    assert!(errors[1][0].abs() < 1e-3 && errors[1][1].abs() < 2e-3 && errors[1][2] < 5e-3, "{errors:?}");
}

#[test]
fn a_rounded_punch_has_sneddon_s_pressure() {
    let mut errors = Vec::new();
    for cells in [64, 128] {
        let exact = RoundedPunch::new(0.6, 30.0, 0.01, MODULUS).unwrap();
        let text = pressed_on_half_space(
            [cells; 2],
            "size = \"auto\"",
            "[profile.rounded_punch]\nflat_radius = 0.6\nedge_radius = 30.0",
            "normal_force = 0.01",
        );
        let history = solved(&text);
        let step = &history.steps[0];
        let radius = (step.contact_area / PI).sqrt();
        let mean = 0.01 / (PI * exact.contact_radius.powi(2));
        errors.push([
            step.approach / exact.approach - 1.0,
            radius / exact.contact_radius - 1.0,
            rms(&history, 2.0, mean, |r| exact.pressure(r)),
        ]);
    }
    println!("rounded punch, 64 and 128 cells: approach, radius, pressure {errors:.6?}");
    // A gap with a jump in its curvature: between first and second order.
    assert!(errors[1][0].abs() < 1e-3 && errors[1][1].abs() < 2e-3 && errors[1][2] < 1e-2, "{errors:?}");
}

/// Parabolas `x^2 / (2 R)` side by side at distances `period` on a half-space, contact half-width `a`: pressure at `x`.
/// With `s = tan(pi x / L)` the kernel `cot` becomes Cauchy's, and the airfoil equation gives
/// `p = E* L / (2 pi^2 R) sqrt(b^2 - s^2) Int (atan t - atan s) / ((t - s) sqrt(b^2 - t^2)) dt`, `b = tan(pi a / L)`.
fn row_of_cylinders(x: f64, a: f64, radius: f64, period: f64) -> f64 {
    let (s, b) = ((PI * x / period).tan(), (PI * a / period).tan());
    if s.abs() >= b {
        return 0.0;
    }
    let nodes = 400;
    let part = |k: usize| {
        let t = b * (PI * (k as f64 + 0.5) / nodes as f64).cos();
        if (t - s).abs() < 1e-9 { 1.0 / (1.0 + s * s) } else { (t.atan() - s.atan()) / (t - s) }
    };
    let integral = PI / nodes as f64 * (0..nodes).map(part).sum::<f64>();
    MODULUS * period / (2.0 * PI * PI * radius) * (b * b - s * s).sqrt() * integral
}

#[test]
fn a_long_cylinder_in_a_period_is_a_row_of_cylinders() {
    let (radius, a) = (50.0, 0.25);
    let depth = 1.0 / 16.0;
    let mut errors = Vec::new();
    for period in [1.0, 2.0] {
        let nodes = 2000;
        // Trapezia in the angle x = a cos(angle), exact for a root at both ends.
        let share = |k: usize| {
            let angle = PI * (k as f64 + 0.5) / nodes as f64;
            row_of_cylinders(a * angle.cos(), a, radius, period) * a * angle.sin()
        };
        let line_force = PI / nodes as f64 * (0..nodes).map(share).sum::<f64>();
        let text = pressed_on_half_space(
            [256, 8],
            &format!("size = [{period:?}, {depth:?}]\nperiodic = true"),
            &format!("[profile.cylinder]\nradius = {radius:?}\naxis = \"y\""),
            &format!("normal_force = {:e}", line_force * depth),
        );
        let history = solved(&text);
        let peak = row_of_cylinders(0.0, a, radius, period);
        let pressure = history.fields[0].pressure.as_ref().unwrap();
        let mut square = 0.0;
        for ((i, _), p) in pressure.indexed_iter() {
            square += (p - row_of_cylinders(history.grid.centre(0, i), a, radius, period)).powi(2);
        }
        errors.push((square / pressure.len() as f64).sqrt() / peak);
        let line = HertzLine::cylinder(radius, line_force, MODULUS).unwrap();
        println!(
            "period {period}: pressure rms {:.1e} of the largest; one cylinder alone would have {:.4} of it",
            errors[errors.len() - 1],
            line.max_pressure / peak
        );
        assert!((history.steps[0].max_pressure / peak - 1.0).abs() < 2e-3);
    }
    // 128 and 64 cells over the contact; the root at the edge is smeared over a cell.
    assert!(errors.iter().all(|error| *error < 5e-3), "{errors:?}");
    // The row itself: far apart, each is Hertz's.
    let line = HertzLine::cylinder(radius, PI * a * a * MODULUS / (4.0 * radius), MODULUS).unwrap();
    assert!((row_of_cylinders(0.1, a, radius, 1e3) / line.pressure(0.1) - 1.0).abs() < 1e-6);
}

#[test]
fn a_finite_cylinder_is_plane_in_its_middle_and_sharp_at_its_ends() {
    let text = pressed_on_half_space(
        [96, 160],
        "size = [1.2, 4.4]",
        "[profile.cylinder]\nradius = 50.0\naxis = \"y\"\nlength = 4.0",
        "normal_force = 0.01",
    );
    let history = solved(&text);
    let pressure = history.fields[0].pressure.as_ref().unwrap();
    let [dx, dy] = history.grid.spacing();
    let middle = pressure.column(80);
    let line = HertzLine::cylinder(50.0, middle.sum() * dx, MODULUS).unwrap();
    let widest = middle.iter().filter(|p| **p > 0.0).count() as f64 * dx / 2.0;
    let off = middle.iter().copied().fold(0.0, f64::max) / line.max_pressure - 1.0;
    println!(
        "finite cylinder, middle: largest pressure {off:.1e} from the plane solution under its own force per length"
    );
    // A section ten half-widths from the ends: the plane solution up to the slow change along the axis, (a/L)^2 = 3e-3.
    assert!(off.abs() < 5e-3, "{off}");
    assert!((widest - line.half_width).abs() < dx, "{widest} against {}", line.half_width);
    // The ends: all the length is in contact, with the largest pressure in the last cells, and nothing beyond.
    let along = pressure.row(48);
    let ends = (along.iter().position(|p| *p > 0.0).unwrap(), along.iter().rposition(|p| *p > 0.0).unwrap());
    let last = ((4.4 - 4.0) / 2.0 / dy).round() as usize;
    assert!(ends.0.abs_diff(last) <= 1 && ends.0 + ends.1 == 159, "{ends:?} {last}");
    assert!(along[ends.0] > 1.2 * along[80], "{} {}", along[ends.0], along[80]);
}

#[test]
fn bodies_add_up_to_one_gap() {
    let contact = |profiles: &str| {
        let text = pressed_on_half_space([32, 32], "size = [2.4, 2.4]", profiles, "normal_force = 0.01");
        solved(&text).steps[0].clone()
    };
    let same = |a: &str, b: &str| {
        let (a, b) = (contact(a), contact(b));
        // The gaps differ by rounding alone; the tolerance of the solver is 1e-8.
        assert!(
            (a.approach / b.approach - 1.0).abs() < 1e-7
                && (a.max_pressure / b.max_pressure - 1.0).abs() < 1e-7
        );
    };
    // Crossed cylinders.
    same(
        "[upper.profile.cylinder]\nradius = 120.0\naxis = \"x\"\n[lower.profile.cylinder]\nradius = 80.0\naxis = \"y\"",
        "[profile.ellipsoid]\nradius_x = 80.0\nradius_y = 120.0",
    );
    // A ball in a hollow: 1/100 = 1/50 - 1/100.
    same(
        "[upper.profile.sphere]\nradius = 50.0\n[lower.profile.sphere]\nradius = -100.0",
        "[profile.sphere]\nradius = 100.0",
    );
    // Several shapes of one body.
    same(
        "[profile.sphere]\nradius = 200.0\n[profile.ellipsoid]\nradius_x = 200.0\nradius_y = 200.0",
        "[profile.sphere]\nradius = 100.0",
    );
}

#[test]
fn automatic_sizes_hold_each_contact_with_a_margin() {
    for (profile, half_width) in [
        ("[profile.cone]\nslope = 0.01", Cone::new(0.01, 0.01, MODULUS).unwrap().contact_radius),
        ("[profile.flat_punch]\nradius = 0.7", 0.7),
        (
            "[profile.rounded_punch]\nflat_radius = 0.3\nedge_radius = 40.0",
            RoundedPunch::new(0.3, 40.0, 0.01, MODULUS).unwrap().contact_radius,
        ),
        ("[profile.sphere]\nradius = 100.0", Hertz::sphere(100.0, 0.01, MODULUS).unwrap().contact_radius),
    ] {
        let text = pressed_on_half_space([32, 32], "size = \"auto\"", profile, "normal_force = 0.01");
        let history = solved(&text);
        let share = history.grid.size()[0] / (2.0 * half_width);
        // A margin of a fifth, up to a coarse cell of the search on either side.
        assert!((1.05..1.4).contains(&share), "{profile}: {share}");
    }
}
