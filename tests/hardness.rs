//! Surfaces that yield at a hardness: a bound of the pressure from above, and a plastic depth that stays. Judged by projected Gauss-Seidel on a
//! dense matrix of Love's closed form, by Hertz's load at first yield, by the bearing area of a rigid surface, and by what must not matter.

use std::f64::consts::PI;
use std::ops::ControlFlow;
use std::sync::Arc;

use fret_core::case::{Attachments, Case};
use fret_core::history::{History, Start};
use fret_core::plan::{LeaveOut, Plan, Simplification};
use fret_core::run::{Checkpoint, Observer, Silent, Simulation, Waypoint, beginnings};
use fret_validation::{
    Sphere, by_end_points, off_first_law, pressed_on_half_space, run, solved, solved_with,
};
use ndarray::Array2;

/// A case whose lower body has a hardness.
fn with_hardness(text: &str, hardness: f64) -> String {
    text.replacen("[lower]\n", &format!("[lower]\nhardness = {hardness:e}\n"), 1)
}

/// The same, which keeps all fields of every increment.
fn keeping(text: &str) -> String {
    format!(
        "{text}[output]\nfields = [\"pressure\", \"shear\", \"slip\", \"gap\", \"zone\", \"plastic_depth\"]\nevery = 1\n"
    )
}

/// Integral of `1/r` over a rectangle around (0, 0) seen from a place (Love 1929).
fn love([x, y]: [f64; 2], [half_x, half_y]: [f64; 2]) -> f64 {
    let corner = |x: f64, y: f64| {
        let r = x.hypot(y);
        x * (y + r).ln() + y * (x + r).ln()
    };
    let (a, b, c, d) = (x + half_x, x - half_x, y + half_y, y - half_y);
    corner(a, c) - corner(b, c) - corner(a, d) + corner(b, d)
}

/// Uneven heights, the same on every machine.
fn roughness(cells: usize) -> Array2<f64> {
    let wave = |i: usize, j: usize, n: f64, m: f64| (n * i as f64 + 0.3).sin() * (m * j as f64 - 0.7).cos();
    Array2::from_shape_fn((cells, cells), |(i, j)| {
        wave(i, j, 0.9, 1.1) + 0.6 * wave(i, j, 2.3, 1.9) + 0.4 * wave(i, j, 3.1, 2.7)
    })
}

/// Pressures between 0 and a hardness on cells of a homogeneous half-space (`E = 1`, `nu = 0.3`) at a given approach: projected Gauss-Seidel.
fn by_gauss_seidel(gap: &Array2<f64>, spacing: f64, approach: f64, hardness: f64) -> Array2<f64> {
    let n = gap.nrows();
    let at = |cell: usize| [(cell / n) as f64 * spacing, (cell % n) as f64 * spacing];
    let influence = |one: usize, other: usize| {
        let ([x, y], [u, v]) = (at(one), at(other));
        0.91 / PI * love([x - u, y - v], [0.5 * spacing; 2])
    };
    let cells = n * n;
    let matrix = Array2::from_shape_fn((cells, cells), |(one, other)| influence(one, other));
    let heights: Vec<f64> = gap.iter().copied().collect();
    let mut pressure = vec![0.0; cells];
    for _ in 0..20_000 {
        let mut largest = 0.0_f64;
        for cell in 0..cells {
            let displacement: f64 = matrix.row(cell).iter().zip(&pressure).map(|(c, p)| c * p).sum();
            let open = heights[cell] + displacement - approach;
            let new = (pressure[cell] - open / matrix[[cell, cell]]).clamp(0.0, hardness);
            largest = largest.max((new - pressure[cell]).abs());
            pressure[cell] = new;
        }
        if largest < 1e-15 * hardness {
            break;
        }
    }
    Array2::from_shape_vec((n, n), pressure).unwrap()
}

#[test]
fn a_small_contact_is_that_of_projected_gauss_seidel() {
    let (cells, size, approach) = (14, 2.0, 0.02);
    let spacing = size / cells as f64;
    let centre = |index: usize| (index as f64 + 0.5) * spacing - 0.5 * size;
    let uneven = roughness(cells);
    let ball = Array2::from_shape_fn((cells, cells), |(i, j)| {
        (centre(i).powi(2) + centre(j).powi(2)) / 40.0 + 2e-3 * uneven[[i, j]]
    });
    let gap = &ball - ball.iter().copied().fold(f64::INFINITY, f64::min);
    for hardness in [0.006, 0.012, 0.022] {
        let expected = by_gauss_seidel(&gap, spacing, approach, hardness);
        let at_hardness = expected.iter().filter(|p| **p >= hardness).count();
        let loaded = expected.iter().filter(|p| **p > 0.0).count();
        assert!(at_hardness > 3 && at_hardness < loaded && loaded < cells * cells, "{at_hardness} {loaded}");
        let force = expected.sum() * spacing * spacing;
        // Springs of the machine give by the force over their stiffness.
        let rig = format!("\n[rig]\nnormal_stiffness = {:e}", 2.0 * force / approach);
        let driven = format!("actuator_approach = {:e}", 1.5 * approach);
        let [pressed, weighed] = [format!("approach = {approach:e}"), format!("normal_force = {force:e}")];
        for (load, rig) in [(pressed, ""), (weighed, ""), (driven, rig.as_str())] {
            let text = pressed_on_half_space(
                [cells; 2],
                &format!("size = [{size:?}, {size:?}]"),
                &format!("[profile.heights]\nvalues = {{ array = 0 }}\n[solver]\ntolerance = 1e-11{rig}"),
                &load,
            );
            let text = with_hardness(&text, hardness).replace("\"gap\"", "\"gap\", \"plastic_depth\"");
            let history = solved_with(&text, &[-&gap]);
            let kept = &history.fields[0];
            let [pressure, open, depth] =
                [&kept.pressure, &kept.gap, &kept.plastic_depth].map(|field| field.as_ref().unwrap());
            let off = (pressure - &expected).iter().fold(0.0_f64, |worst, d| worst.max(d.abs())) / hardness;
            println!(
                "hardness {hardness}, {load}: off by {off:.1e} of it, {at_hardness} of {loaded} cells at it"
            );
            // A residual of 1e-11 of the mean displacement, which a cell's own pressure makes a tenth of.
            assert!(off < 1e-8, "{hardness}, {load}: {off:e}");
            let step = &history.steps[0];
            let cell = spacing * spacing;
            assert_eq!((step.plastic.area / cell).round() as usize, at_hardness);
            assert!((step.normal_force / force - 1.0).abs() < 1e-8);
            // What has yielded touches, and nothing else has.
            for ((p, open), depth) in pressure.iter().zip(open).zip(depth) {
                assert!(
                    *depth == 0.0 || *p > (1.0 - 1e-8) * hardness && open.abs() < 1e-9,
                    "{p} {open} {depth}"
                );
            }
            assert!((step.plastic.volume / (depth.sum() * cell) - 1.0).abs() < 1e-12);
            assert!((step.plastic.work / (hardness * step.plastic.volume) - 1.0).abs() < 1e-12);
        }
    }
}

/// A flat body with a sharp edge that ends with the grid: the infinite pressure at the edge is cut.
#[test]
fn a_sharp_edge_yields() {
    let (cells, size, approach, hardness) = (12, 1.0, 1e-3, 1.2e-3);
    let expected = by_gauss_seidel(&Array2::zeros((cells, cells)), size / cells as f64, approach, hardness);
    let at_hardness = expected.iter().filter(|p| **p >= hardness).count();
    assert!(at_hardness > 0 && at_hardness < cells * cells, "{at_hardness}");
    let text = pressed_on_half_space(
        [cells; 2],
        "size = [1.0, 1.0]\nbeyond = \"no body\"",
        "[profile.heights]\nvalues = { array = 0 }\n[solver]\ntolerance = 1e-11",
        &format!("approach = {approach:e}"),
    );
    let history = solved_with(&with_hardness(&text, hardness), &[Array2::zeros((cells, cells))]);
    let pressure = history.fields[0].pressure.as_ref().unwrap();
    let off = (pressure - &expected).iter().fold(0.0_f64, |worst, d| worst.max(d.abs())) / hardness;
    // As above.
    assert!(off < 1e-8, "{off:e}");
}

/// A sphere of Hertz's largest pressure 1 in units of the hardness under a share of its force.
fn ball(hardness: f64, share: f64, more: &str) -> String {
    let sphere = Sphere { size: 4.0, tolerance: 1e-9, ..Sphere::default() };
    let text = sphere.pressed(share, 1, "linear");
    with_hardness(&format!("{text}{more}"), hardness * sphere.max_pressure())
}

/// `p0 = (6 W E*^2 / (pi^3 R^2))^(1/3) = H`: a sphere yields from `W = pi^3 R^2 H^3 / (6 E*^2)` on, which is where Hertz's largest pressure, by which
/// the hardness is given here, is the hardness.
#[test]
fn a_sphere_yields_when_hertz_s_largest_pressure_is_the_hardness() {
    let sphere = Sphere::default();
    let [radius, modulus, hardness] = [100.0, 1.0 / 0.91, sphere.max_pressure()];
    let force = PI.powi(3) * radius * radius * hardness.powi(3) / (6.0 * modulus * modulus);
    assert!((force / sphere.force() - 1.0).abs() < 1e-12);
    // Mean pressures of cells of 1/16 of the radius are up to 1e-3 below the largest one, and forces go with its third power.
    assert_eq!(solved(&ball(1.0, 0.99, "")).steps[0].plastic.volume, 0.0);
    assert!(solved(&ball(1.0, 1.02, "")).steps[0].plastic.volume > 0.0);
}

#[test]
fn a_line_contact_yields_when_hertz_s_largest_pressure_is_the_hardness() {
    // p0^2 = W E* / (pi R)
    let (force, modulus): (f64, f64) = (1e-3, 1.0 / 0.91);
    let text = |share: f64| {
        let hardness = (force * modulus / PI).sqrt();
        format!(
            "[grid]\ncells = 256\nsize = 0.24\n[upper]\nrigid = true\n[lower]\nhardness = {hardness:e}\n\
             substrate = {{ young = 1.0, poisson = 0.3 }}\n[profile.cylinder]\nradius = 1.0\naxis = \"y\"\n\
             [[load]]\nnormal_force = {:e}\nincrements = 2\n",
            share * force
        )
    };
    // Forces go with the square of the pressure; cells of a half-width over 36 are 1e-4 below the largest.
    assert_eq!(solved(&text(0.995)).steps[1].plastic.volume, 0.0);
    let history = solved(&text(3.0));
    let [first, last] = [0, 1].map(|step| &history.steps[step]);
    assert!(first.plastic.volume > 0.0 && last.plastic.volume > first.plastic.volume);
    assert!((last.normal_force / (3.0 * force) - 1.0).abs() < 1e-8);
    let yielded = last.plastic.area * (force * modulus / PI).sqrt();
    assert!(yielded < 3.0 * force && yielded > 1.5 * force, "{yielded:e}");
}

#[test]
fn what_does_not_yield_has_the_bits_of_elastic_surfaces() {
    for share in [0.3, 0.98] {
        let loads = "[[load]]\nnormal_force = 1e-3\nincrements = 2\n";
        let text = ball(1.0, share, loads);
        let start = text.find("hardness").unwrap();
        let elastic = text.replacen(&text[start..=start + text[start..].find('\n').unwrap()], "", 1);
        let [with, without] = [text, elastic].map(|text| solved(&text).state);
        assert!(with.plastic_depth.as_ref().unwrap().iter().all(|depth| *depth == 0.0));
        assert_eq!(fret_core::model::ContactState { plastic_depth: None, ..with }, without);
    }
}

/// Of surfaces that are all but rigid the lowest cells carry the hardness each, as many as the force takes: the bearing area.
#[test]
fn a_stiff_rough_surface_is_carried_by_its_bearing_area() {
    let cells = 32;
    let heights = roughness(cells);
    for share in [0.1, 0.4] {
        let hardness = 1e-6;
        let text = pressed_on_half_space(
            [cells; 2],
            "size = [1.0, 1.0]\nperiodic = true",
            "[profile.heights]\nvalues = { array = 0 }",
            &format!("normal_force = {:e}", share * hardness),
        );
        let history = solved_with(&with_hardness(&text, hardness), std::slice::from_ref(&heights));
        let pressure = history.fields[0].pressure.as_ref().unwrap();
        let mut by_height: Vec<(f64, f64)> = heights.iter().copied().zip(pressure.iter().copied()).collect();
        by_height.sort_by(|one, other| other.0.total_cmp(&one.0));
        let force = share * (cells * cells) as f64;
        let full = force as usize;
        for (place, (height, p)) in by_height.iter().enumerate() {
            // The last one carries what is left.
            let expected = (force - place as f64).clamp(0.0, 1.0) * hardness;
            assert!((p - expected).abs() < 1e-6 * hardness, "{place}: {height} {p:e} {expected:e}");
        }
        let step = &history.steps[0];
        assert_eq!((step.plastic.area * (cells * cells) as f64).round() as usize, full);
    }
}

/// Pressed, unloaded, loaded again twice.
#[test]
fn surfaces_that_are_loaded_again_as_before_do_not_yield_again() {
    let force = |share: f64| share * Sphere::default().force();
    let more: String = [0.1, 2.5, 0.0, 2.5, 1.0, 2.5]
        .map(|share| format!("[[load]]\nnormal_force = {:e}\nincrements = 2\n", force(share)))
        .concat();
    let history = solved(&keeping(&ball(0.8, 2.5, &more)));
    let first = &history.steps[0];
    assert!(first.plastic.volume > 0.0);
    let fields: Vec<_> = history.fields.iter().map(|kept| kept.plastic_depth.as_ref().unwrap()).collect();
    for (step, depth) in history.steps.iter().zip(&fields) {
        assert_eq!(step.plastic.volume, first.plastic.volume, "increment {}", step.increment);
        assert_eq!(depth, &fields[0]);
    }
    let [last, pressed] =
        [history.fields.last(), history.fields.first()].map(|kept| kept.unwrap().pressure.clone().unwrap());
    let hardness = 0.8 * Sphere::default().max_pressure();
    let off = (&last - &pressed).iter().fold(0.0_f64, |worst, d| worst.max(d.abs())) / hardness;
    // Residuals of 1e-9 of the mean displacement, of which a cell's own pressure makes a twentieth.
    assert!(off < 1e-6, "{off:e}");
    // A larger force yields more, and as much as at once from the start of a monotonic loading it does not.
    let more = format!("[[load]]\nnormal_force = {:e}\nincrements = 1\n", force(3.0));
    let grown = solved(&keeping(&ball(0.8, 2.5, &more)));
    let [before, after] = [0, 1].map(|at| grown.fields[at].plastic_depth.clone().unwrap());
    assert!(before.iter().zip(&after).all(|(before, after)| after >= before));
    assert!(grown.steps[1].plastic.volume > 1.2 * first.plastic.volume);
    // An unloaded ball leaves a crater: its gap at zero force is the undeformed one and the plastic depth, less the approach.
    assert_eq!(history.steps[6].normal_force, 0.0);
    assert!(off_first_law(&history, 0.0) < 1e-10 && off_first_law(&grown, 0.0) < 1e-10);
}

fn rubbed(identical: bool) -> Sphere {
    Sphere { identical, size: 4.0, friction: 0.3, ..Sphere::default() }
}

fn pulled(identical: bool, loads: &str) -> String {
    let sphere = rubbed(identical);
    let hardness = 0.7 * sphere.max_pressure();
    with_hardness(&format!("{}{loads}", sphere.pressed(1.5, 2, "linear")), hardness)
}

fn loads(sphere: &Sphere) -> String {
    let limit = sphere.friction * sphere.force();
    format!(
        "[[load]]\ntangential_force = [{:e}, 0.0]\nincrements = 3\n[[load]]\ntangential_force = [{:e}, 0.0]\ncycles = 2\nincrements = 4\n\
         [[load]]\nnormal_force = {:e}\nincrements = 2\n",
        0.6 * limit,
        0.6 * limit,
        2.0 * sphere.force()
    )
}

/// Pulled and pressed on, of bodies that do not couple and of bodies that do: the bound of the shear is that of the hardness.
#[test]
fn friction_is_bounded_by_the_pressure_of_yielded_surfaces() {
    for identical in [true, false] {
        let sphere = rubbed(identical);
        let history = solved(&keeping(&pulled(identical, &loads(&sphere))));
        let hardness = 0.7 * sphere.max_pressure();
        for (step, kept) in history.steps.iter().zip(&history.fields) {
            assert!(step.max_pressure <= hardness, "{}", step.max_pressure / hardness);
            let (pressure, [x, y]) = (kept.pressure.as_ref().unwrap(), kept.shear.as_ref().unwrap());
            for ((p, x), y) in pressure.iter().zip(x).zip(y) {
                assert!(x.hypot(*y) <= sphere.friction * p * (1.0 + 1e-12));
            }
        }
        let depths: Vec<f64> = history.steps.iter().map(|step| step.plastic.volume).collect();
        println!("coupled {}: plastic volumes {depths:?}", !identical);
        assert!(depths.windows(2).all(|pair| pair[1] >= pair[0]));
        if identical {
            // Shear does not move the surfaces normally: nothing yields while they are pulled.
            assert_eq!(depths[1], depths[depths.len() - 3]);
        }
        assert!(depths.last() > depths.get(1));
        assert!(history.steps.last().unwrap().dissipated_energy > 0.0);
        assert!(off_first_law(&history, 0.0) < 1e-9, "{:e}", off_first_law(&history, 0.0));
    }
}

/// Bodies whose shear does not move the surfaces normally, solved as if it did. By end points: what turns is followed along other paths in the
/// iterations, to 4e-6 of the shift.
#[test]
fn pressure_and_shear_in_alternation_find_what_one_after_the_other_find() {
    let text = keeping(&by_end_points(&pulled(true, &loads(&rubbed(true)))));
    let text = text.replace("tolerance = 1e-8", "tolerance = 1e-10");
    let [one, other] = [LeaveOut::ALL, LeaveOut::all_but(Simplification::Coupling)].map(|leave_out| {
        let plan = Plan::leaving_out(Case::from_toml(&text, "case.toml").unwrap(), leave_out).unwrap();
        Simulation::new(&plan).run(&mut Silent).unwrap()
    });
    let shifts = |history: &History| history.steps.iter().map(|step| step.shift[0]).collect::<Vec<_>>();
    let (first, second) = (shifts(&one), shifts(&other));
    println!("{first:?}\n{second:?}");
    let largest = first.iter().fold(0.0_f64, |most, shift| most.max(shift.abs()));
    assert!(largest > 0.0 && first.iter().zip(&second).all(|(a, b)| (a - b).abs() < 1e-6 * largest));
    are_alike(&one, &other, 1e-6);
}

/// Pressures, shear and plastic depths of two histories differ by no more than this fraction of their largest numbers.
fn are_alike(one: &History, other: &History, tolerance: f64) {
    for (a, b) in one.fields.iter().zip(&other.fields) {
        let [sx, sy] = a.shear.as_ref().unwrap();
        let [tx, ty] = b.shear.as_ref().unwrap();
        let [p, q] = [a, b].map(|kept| kept.pressure.as_ref().unwrap());
        let [d, e] = [a, b].map(|kept| kept.plastic_depth.as_ref().unwrap());
        for (one, other, scale) in [(p, q, p), (sx, tx, p), (sy, ty, p), (d, e, d)] {
            let size = scale.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
            let off = (one - other).iter().fold(0.0_f64, |most, value| most.max(value.abs()));
            assert!(off <= tolerance * size, "increment {}: {:e}", a.increment, off / size);
        }
    }
}

/// On a quarter of the grid and on all of it; in a region and on the whole grid.
#[test]
fn mirrors_and_regions_do_not_matter() {
    let text = keeping(&pulled(true, &loads(&rubbed(true))));
    let found = |leave_out: LeaveOut, copies: usize| {
        let plan = Plan::leaving_out(Case::from_toml(&text, "case.toml").unwrap(), leave_out).unwrap();
        assert_eq!(plan.symmetry.copies(), copies);
        Simulation::new(&plan).run(&mut Silent).unwrap()
    };
    let all = found(LeaveOut::ALL, 4);
    are_alike(&all, &found(LeaveOut::all_but(Simplification::Mirror), 1), 1e-6);
    are_alike(&all, &found(LeaveOut::all_but(Simplification::Region), 4), 1e-6);
}

#[test]
fn units_do_not_matter() {
    let text = |length: f64, modulus: f64| {
        let sphere = Sphere { length, modulus, size: 4.0, tolerance: 1e-10, ..Sphere::default() };
        let hardness = 0.7 * sphere.max_pressure();
        (with_hardness(&sphere.pressed(1.5, 2, "linear"), hardness), sphere)
    };
    let (first, _) = text(1.0, 1.0);
    let first = solved(&first).steps.remove(1);
    for (length, modulus) in [(1e-3, 2.1e11), (1e6, 1e-3)] {
        let (text, sphere) = text(length, modulus);
        let step = solved(&text).steps.remove(1);
        let depth = sphere.length * first.plastic.max_depth;
        assert!((step.plastic.max_depth / depth - 1.0).abs() < 1e-6);
        assert!((step.plastic.volume / (first.plastic.volume * length.powi(3)) - 1.0).abs() < 1e-6);
        assert!((step.plastic.area / (first.plastic.area * length.powi(2)) - 1.0).abs() < 1e-9);
    }
}

/// Coatings 30 times stiffer and softer than what is below, and on a rigid base: as many other methods at the start.
#[test]
fn coated_bodies_yield() {
    for coating in [(30.0, 0.3), (1.0 / 30.0, 0.3), (1e3, 0.05)] {
        let sphere = Sphere { coating: Some(coating), friction: 0.0, size: 6.0, ..Sphere::default() };
        let text = sphere.pressed(1.0, 3, "linear");
        let elastic = solved(&text).steps.last().unwrap().max_pressure;
        let history = solved(&with_hardness(&text, 0.6 * elastic));
        let last = history.steps.last().unwrap();
        println!("coating {coating:?}: {} cells, work {:?}", last.contact_cells, last.work);
        assert!(last.plastic.volume > 0.0 && last.max_pressure <= 0.6 * elastic);
        assert!((last.normal_force / sphere.force() - 1.0).abs() < 1e-8);
    }
}

/// A history that starts from a yielded state goes on in its crater, with a hardness of its own or none: an elastic one presses into it as the
/// unloading came out of it.
#[test]
fn a_crater_stays_when_another_history_starts_from_it() {
    let force = |share: f64| {
        format!("[[load]]\nnormal_force = {:e}\nincrements = 1\n", share * Sphere::default().force())
    };
    let one = solved(&keeping(&ball(0.7, 2.0, &format!("{}{}", force(0.5), force(1.5)))));
    let history = solved(&keeping(&ball(0.7, 2.0, &force(0.5))));
    let start = Arc::new(Start::of(&history, 1).unwrap());
    let head = Sphere { size: 4.0, tolerance: 1e-9, ..Sphere::default() }.head();
    for hardness in [Some(0.7), None] {
        let text = format!("{head}{}", keeping(&force(1.5)));
        let text = hardness.map_or(text.clone(), |hardness| {
            with_hardness(&text, hardness * Sphere::default().max_pressure())
        });
        let attachments = Attachments { start: Some(start.solved.loads), ..Attachments::none() };
        let case = Case::from_toml_with(&text, "case.toml", attachments).unwrap();
        let plan = Plan::starting_from(Some(start.clone()), case, LeaveOut::ALL).unwrap();
        let went_on = Simulation::new(&plan).run(&mut Silent).unwrap();
        let [found, expected] =
            [&went_on.fields[0], &one.fields[2]].map(|kept| kept.pressure.as_ref().unwrap());
        let size = expected.iter().copied().fold(0.0, f64::max);
        let off = (found - expected).iter().fold(0.0_f64, |most, value| most.max(value.abs())) / size;
        // Other starts of the iteration: the tolerance of 1e-9 of the mean displacement is left.
        assert!(off < 1e-6, "{hardness:?}: {off:e}");
        assert_eq!(went_on.state.plastic_depth, one.state.plastic_depth);
    }
}

/// A force that the whole period does not carry at the hardness has no equilibrium.
#[test]
fn a_force_above_the_hardness_of_the_whole_surface_is_refused() {
    let text = |mean: f64| {
        with_hardness(
            &pressed_on_half_space(
                [16, 16],
                "size = [1.0, 1.0]\nperiodic = true",
                "[profile.wave]\namplitude = 1e-2\nwavelength_x = 1.0",
                &format!("normal_force = {mean:e}"),
            ),
            1e-3,
        )
    };
    let told = run(&text(1.1e-3)).unwrap_err().to_string();
    assert!(told.contains("hardness times the area"), "{told}");
    assert!(solved(&text(0.95e-3)).steps[0].plastic.volume > 0.0);
}

/// A size that is left to the program holds a contact that yields, too.
#[test]
fn an_automatic_size_holds_what_yields() {
    let text = ball(0.2, 1.0, "").replace("size = [4e0, 4e0]", "size = \"auto\"");
    let step = solved(&text).steps.remove(0);
    let force = Sphere::default().force();
    let hardness = 0.2 * Sphere::default().max_pressure();
    assert!(step.contact_area > 0.99 * force / hardness, "{} {}", step.contact_area, force / hardness);
}

#[test]
fn what_yields_is_not_combined_with_what_is_not_known() {
    let refused = |from: &str, to: &str, words: &str| {
        let text = pulled(false, "[[load]]\nshift = [1e-3, 0.0]\nincrements = 2\n").replacen(from, to, 1);
        let told = Case::from_toml(&text, "case.toml").map(|_| ()).unwrap_err().to_string();
        assert!(told.contains(words), "{told}");
    };
    refused("[friction]", "[wear]\ncoefficient = 1e-3\n[friction]", "wear with a hardness");
    refused(
        "[friction]",
        "[kinematics]\ndisplacement = \"finite\"\n[friction]",
        "\"finite\" with a hardness",
    );
    refused("shift = [1e-3, 0.0]", "tilt = [1e-3, 0.0]", "tilt with a hardness");
    refused("shift = [1e-3, 0.0]", "roll = 0.1", "roll with a hardness");
    refused("rigid = true", "rigid = true\nhardness = 1.0", "a body that is rigid does not yield");
    refused("hardness = ", "hardness = -", "must be a positive finite pressure");
}

fn plan_of(text: &str) -> Plan {
    Plan::new(Case::from_toml(text, "case.toml").unwrap()).unwrap()
}

/// The points of a sweep solve what they begin with in common once: not where they yield at another pressure. What is kept is no matter.
#[test]
fn histories_of_another_hardness_have_no_beginning_in_common() {
    let more = "[[load]]\nnormal_force = 1e-6\nincrements = 2\n";
    let of = |text: &str| beginnings(&plan_of(text));
    let (one, other) = (of(&ball(0.7, 1.0, more)), of(&ball(0.8, 1.0, more)));
    assert!(one.len() == 2 && one.iter().zip(&other).all(|(one, other)| one != other));
    assert_eq!(one, of(&keeping(&ball(0.7, 1.0, more))));
}

/// Keeps the bytes of the last waypoint.
struct Last(Vec<u8>);

impl Observer for Last {
    fn reached(&mut self, waypoint: &Waypoint<'_>) -> ControlFlow<()> {
        self.0.clear();
        waypoint.write(&mut self.0).unwrap();
        ControlFlow::Continue(())
    }
}

/// Elastic under a force and interrupted; pulled from there by another case, under the same force: the pressure is no longer that of before.
/// Of bodies that do not couple, whose pressure is kept otherwise.
#[test]
fn an_interrupted_history_is_continued_with_a_hardness() {
    let sphere = Sphere { size: 4.0, tolerance: 1e-9, identical: true, friction: 0.3, ..Sphere::default() };
    let head = sphere.head();
    let pressed = format!("{head}[[load]]\nnormal_force = {:e}\nincrements = 1\n", sphere.force());
    let plan = plan_of(&pressed);
    let mut last = Last(Vec::new());
    let elastic = Simulation::new(&plan).run(&mut last).unwrap();
    let start = Arc::new(Checkpoint::start_of(&last.0, &plan.to_json()).unwrap());
    let hardness = 0.7 * elastic.steps[0].max_pressure;
    let pulled =
        format!("{head}[[load]]\ntangential_force = [{:e}, 0.0]\nincrements = 2\n", 0.1 * sphere.force());
    let continued = |text: &str| {
        let attachments = Attachments { start: Some(start.solved.loads), ..Attachments::none() };
        let case = Case::from_toml_with(text, "case.toml", attachments).unwrap();
        let plan = Plan::starting_from(Some(start.clone()), case, LeaveOut::ALL).unwrap();
        Simulation::new(&plan).run(&mut Silent).unwrap()
    };
    let yielded = continued(&with_hardness(&pulled, hardness));
    let whole = solved(&with_hardness(&pressed, hardness));
    for step in &yielded.steps {
        assert!(step.max_pressure <= hardness, "{} of {hardness}", step.max_pressure);
        // Two ways to one solution, each to the tolerance.
        assert!((step.approach / whole.steps[0].approach - 1.0).abs() < 1e-6);
    }
    // Without one the pressure is that of before.
    assert_eq!(continued(&pulled).steps[1].max_pressure, elastic.steps[0].max_pressure);
}

/// The frame of a contact that rolls would leave a crater behind.
#[test]
fn a_contact_with_a_crater_rolls_in_the_frame_of_the_bodies() {
    let history = solved(&keeping(&ball(0.7, 1.0, "")));
    let start = Arc::new(Start::of(&history, 0).unwrap());
    let head = Sphere { size: 4.0, tolerance: 1e-9, ..Sphere::default() }.head();
    let step = history.grid.spacing()[0];
    let rolled = |frame: &str| {
        let text = format!(
            "{head}[kinematics]\nframe = \"{frame}\"\n[[load]]\nroll = [{:e}, 0.0]\nincrements = 2\n",
            2.0 * step
        );
        let attachments = Attachments { start: Some(start.solved.loads), ..Attachments::none() };
        let case = Case::from_toml_with(&text, "case.toml", attachments).unwrap();
        Plan::starting_from(Some(start.clone()), case, LeaveOut::ALL).map_err(|error| error.to_string())
    };
    let error = rolled("contact").unwrap_err();
    assert!(error.contains("have worn or yielded"), "{error}");
    assert!(rolled("bodies").is_ok());
}
