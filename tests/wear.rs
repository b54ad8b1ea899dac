//! Wear: what is worn off is what was dissipated; the shape that partial slip wears to; blocks of cycles; a coating's end.

use std::f64::consts::PI;

use fret_core::history::History;
use fret_validation::{RADIUS, Sphere, keeping, solved};

const FRICTION: f64 = 0.3;

fn sphere(cells: usize) -> Sphere {
    Sphere { cells, size: 2.4, poisson: 0.0, identical: true, friction: FRICTION, ..Sphere::default() }
}

/// Shift amplitude for which the sphere, held at its approach, sticks within `c` (contact radius 1): the springs of the
/// method of dimensionality reduction slip beyond `4 G* U = mu E* (d - c^2 / R)`.
fn amplitude(sphere: &Sphere, c: f64) -> f64 {
    FRICTION * sphere.effective_modulus() * sphere.approach() * (1.0 - c * c)
        / (4.0 * sphere.effective_shear_modulus())
}

/// Pressed to its approach, then cycles of shift, worn after `wear`.
fn fretted(sphere: &Sphere, shift: f64, cycles: usize, wear: &str) -> History {
    let text = format!(
        "{}[wear]\n{wear}\n[[load]]\napproach = {:e}\nincrements = 1\n[[load]]\nshift = [{shift:e}, 0.0]\nincrements = 8\n\
         cycles = {cycles}\n",
        sphere.head(),
        sphere.approach()
    );
    let fields = keeping(8).replace("\"zone\"", "\"zone\", \"worn_depth\"");
    solved(&(text + &fields))
}

#[test]
fn worn_volume_is_coefficient_times_dissipated_energy() {
    let sphere = sphere(24);
    let shift = amplitude(&sphere, 0.5);
    let energy = fretted(&sphere, shift, 4, "coefficient = 5.0");
    let last = energy.cycles.last().unwrap();
    let dissipated = energy.steps.last().unwrap().dissipated_energy;
    // Both are sums over the same cells and increments, in another order.
    assert!((last.worn_volume / (5.0 * dissipated) - 1.0).abs() < 1e-12, "{}", last.worn_volume / dissipated);
    let depth = energy.fields.last().unwrap().worn_depth.as_ref().unwrap();
    assert!((depth.sum() * energy.grid.cell_area() / last.worn_volume - 1.0).abs() < 1e-14);
    // Where friction is one coefficient, Archard with k is the energy law with k / mu.
    let archard = fretted(&sphere, shift, 4, "law = \"archard\"\ncoefficient = 1.5");
    let other = archard.cycles.last().unwrap().worn_volume;
    // Slipping cells hold |q| = mu p and the slip's direction to the solver's 1e-8.
    assert!((other / last.worn_volume - 1.0).abs() < 1e-6, "{other}");
}

#[test]
fn partial_slip_wears_to_the_shape_of_dimaki_and_popov() {
    // Popov (2014), Sci. Rep. 4, 3749; Dimaki, Dmitriev, Chai & Popov (2014), Int. J. Solids Struct. 51, 4215: at a fixed
    // approach the circle that sticks stays, and the pressure outside it wears away:
    // p = E*/pi (2 sqrt(c^2 - r^2) / R + (d - c^2/R) / sqrt(c^2 - r^2)), F = 2 E* (d c - c^3 / (3 R)).
    let (sphere, c) = (Sphere { size: 3.2, ..sphere(48) }, 0.6);
    let history = fretted(&sphere, amplitude(&sphere, c), 300, "coefficient = 28.0");
    let (modulus, approach) = (sphere.effective_modulus(), sphere.approach());
    let force = 2.0 * modulus * (approach * c - c.powi(3) / (3.0 * RADIUS));
    let start = sphere.force();
    // Stick at the first and the last peak of the shift (a quarter of a cycle after its start).
    let stick = |step: usize| history.steps[step].stick_cells;
    let all = history.steps.len();
    let (first, last) = (stick(2), stick(all - 7));
    let radius = |cells: usize| (cells as f64 * history.grid.cell_area() / PI).sqrt();
    let end = history.steps.last().unwrap().normal_force;
    println!(
        "limiting shape: force {start:.4e} -> {end:.4e}, limit {force:.4e}; stick radius {:.3} -> {:.3} (exact {c})",
        radius(first),
        radius(last)
    );
    // What is left of the outer pressure decays ever more slowly towards the circle, where the slip is zero.
    // The circle itself is known to a part of a cell.
    assert!((end / force - 1.0).abs() < 0.01 && start > 1.2 * force, "{end} {force}");
    // A cell is 0.067.
    assert!((radius(last) - c).abs() < 0.067 && (radius(first) - c).abs() < 0.067);
    let pressure = history.fields.last().unwrap().pressure.as_ref().unwrap();
    let (mut worst, mut outside) = (0.0_f64, 0.0_f64);
    let middle = modulus / PI * (c / RADIUS + approach / c);
    for ((i, j), p) in pressure.indexed_iter() {
        let r = history.grid.centre(0, i).hypot(history.grid.centre(1, j));
        let (root, beyond) = ((c * c - r * r).max(0.0).sqrt(), approach - c * c / RADIUS);
        if r < 0.7 * c {
            let exact = modulus / PI * (2.0 * root / RADIUS + beyond / root);
            worst = worst.max((p / exact - 1.0).abs());
        } else if r > 0.8 {
            outside = outside.max(p / middle);
        }
    }
    println!(
        "limiting shape: pressure within 0.7 c {worst:.1e}, beyond r = 0.8 {outside:.1e} of that in the middle"
    );
    // The square-root rise at the circle is a cell wide on a tenth of the radius.
    assert!(worst < 0.02, "{worst}");
    assert!(outside < 0.01, "{outside}");
}

#[test]
fn a_block_of_cycles_costs_what_its_bound_says() {
    let sphere = sphere(24);
    let shift = amplitude(&sphere, 0.5);
    let volume = |wear: &str| {
        let history = fretted(&sphere, shift, 32, wear);
        let done: usize = history.cycles.iter().map(|cycle| cycle.stands_for).sum();
        assert_eq!(done, 32);
        (history.cycles.len(), history.cycles.last().unwrap().worn_volume)
    };
    let (all, exact) = volume("coefficient = 1.0");
    let (some, four) = volume("coefficient = 1.0\nevery = 4\nlargest_step = 1.0");
    let (few, eight) = volume("coefficient = 1.0\nevery = 8\nlargest_step = 1.0");
    let (bounded, careful) = volume("coefficient = 1.0\nevery = 8\nlargest_step = 5e-4");
    let off = |volume: f64| volume / exact - 1.0;
    println!(
        "blocks: {all} {some} {few} {bounded} computed cycles, volume off {:.1e} {:.1e} {:.1e}",
        off(four),
        off(eight),
        off(careful)
    );
    assert_eq!((all, some, few), (32, 8, 4));
    // A block is an explicit step: of first order in its cycles, so 8 are about (8 - 1)/(4 - 1) times as far off as 4.
    let ratio = off(eight) / off(four);
    assert!(ratio > 1.5 && ratio < 4.0, "{ratio}");
    assert!(bounded > few && bounded < all && off(careful).abs() < off(eight).abs());
}

#[test]
fn a_coating_is_worn_through_once_and_there() {
    let thickness = 2e-4;
    let sphere = Sphere { coating: Some((2.0, thickness)), identical: false, poisson: 0.3, ..sphere(24) };
    let shift = 2.0 * amplitude(&sphere, 0.0);
    let history = fretted(&sphere, shift, 60, "coefficient = 1.0\nevery = 3\nthrough_coating_of = \"lower\"");
    let through = history.worn_through.expect("it wears through");
    let cycles: usize = history.cycles.iter().map(|cycle| cycle.stands_for).sum();
    let [before, last] = &history.cycles[history.cycles.len() - 2..] else { panic!() };
    println!(
        "worn through after {} cycles at {:?}: {:e}",
        through.cycles, through.place, last.max_worn_depth
    );
    assert_eq!(through.cycles, cycles);
    assert_eq!(through.increment, history.steps.last().unwrap().increment);
    assert!(before.max_worn_depth < thickness && last.max_worn_depth >= thickness);
    // The fewest cycles that reach it: one less would not have.
    let each = (last.max_worn_depth - before.max_worn_depth) / last.stands_for as f64;
    assert!(last.max_worn_depth - each < thickness * (1.0 + 1e-9));
    let depth = history.fields.last().unwrap().worn_depth.as_ref().unwrap();
    assert_eq!(depth[through.cell], last.max_worn_depth);
    assert_eq!(through.place[0], history.grid.centre(0, through.cell[0]));
}

#[test]
fn totals_count_every_cycle_that_a_computed_one_stands_for() {
    let sphere = sphere(24);
    let history = fretted(&sphere, amplitude(&sphere, 0.5), 40, "coefficient = 5.0\nevery = 8");
    let (cycles, last) = (&history.cycles, history.steps.last().unwrap());
    let stood_for: usize = cycles.iter().map(|cycle| cycle.stands_for).sum();
    assert_eq!((stood_for, cycles.last().unwrap().last_cycle), (40, 40));
    assert!(cycles.len() < 40);
    let sum: f64 = cycles.iter().map(|cycle| cycle.dissipated_energy * cycle.stands_for as f64).sum();
    // Pressing at one increment of elastically similar bodies dissipates nothing; the rest are sums of the same numbers in another order.
    assert!((last.dissipated_energy / sum - 1.0).abs() < 1e-12, "{} {sum}", last.dissipated_energy);
    assert!((last.worn_volume / (5.0 * last.dissipated_energy) - 1.0).abs() < 1e-12, "{}", last.worn_volume);
    for cycle in cycles {
        let step = &history.steps[cycle.last_increment];
        assert_eq!(
            [step.dissipated_energy, step.worn_volume, step.max_worn_depth],
            [cycle.total_dissipated_energy, cycle.worn_volume, cycle.max_worn_depth]
        );
    }
}

/// A rigid sphere in gross slip wears its mark into the other body until pressure is even. The scar is then a cap of the sphere but for
/// what even pressure `P/(pi a^2)` leaves the surface higher at the rim than within: `V = pi a^4/(4 R) - 4 P a/(3 pi E*)`, from the mean
/// `16 p a/(3 pi E*)` and the rim `4 p a/(pi E*)` of the displacement under a loaded circle (Johnson 1985, Contact Mechanics, 3.3).
#[test]
fn a_scar_worn_far_in_gross_slip_is_a_cap_under_even_pressure() {
    let (modulus, force, cells) = (4.0 / 3.0, 1e-7, 40_u32); // E = 1, nu = .5: no coupling; R = 1
    let first = (0.75_f64 * force / modulus).cbrt();
    let side = 4.0 * first * 2.3 / f64::from(cells);
    let amplitude = 20.0 * first * first;
    // 0.38 of the own displacement of a cell in a cycle: as fast as explicit steps may wear.
    let coefficient = 0.38 * 1.122 * side / (modulus * 4.0 * amplitude);
    let size = side * f64::from(cells);
    let history = solved(&format!(
        "[grid]\ncells = [{cells}, {cells}]\nsize = [{size:e}, {size:e}]\n[upper]\nrigid = true\n[lower]\n\
         substrate = {{ young = 1.0, poisson = 0.5 }}\n[profile.sphere]\nradius = 1.0\n[friction]\ncoefficient = 0.5\n[wear]\n\
         law = \"archard\"\ncoefficient = {coefficient:e}\nlargest_step = 1.0\n[[load]]\nnormal_force = {force:e}\nincrements = 1\n\
         [[load]]\nshift = [{amplitude:e}, 0.0]\nincrements = 4\ncycles = 1500\n[output]\nfields = [\"pressure\", \"worn_depth\"]\n"
    ));
    let (last, fields) = (history.steps.last().unwrap(), history.fields.last().unwrap());
    let radius = (last.contact_area / PI).sqrt();
    let volume = fields.worn_depth.as_ref().unwrap().sum() * history.grid.cell_area();
    let elastic = 4.0 * force * radius / (3.0 * PI * modulus);
    let exact = PI * radius.powi(4) / 4.0 - elastic;
    let even = force / last.contact_area;
    let [mut least, mut most] = [f64::INFINITY, 0.0_f64];
    for p in fields.pressure.as_ref().unwrap().iter().filter(|p| **p > 0.0) {
        (least, most) = (least.min(p / even), most.max(p / even));
    }
    println!(
        "a {:.3} of the first, {:.1} cells; V {:.4}, without the elastic part {:.4}; p {least:.4} to {most:.4}",
        radius / first,
        radius / side,
        volume / exact - 1.0,
        volume / (exact + elastic) - 1.0
    );
    // The rim is where the cells end: to a tenth of a cell of 17, four times that of the volume.
    assert!((volume / exact - 1.0).abs() < 0.024, "{volume:e} {exact:e}");
    // What the mark has not yet worn off its first pressure, which was three times and a half the mean in the middle and none at the rim.
    assert!(least > 0.98 && most < 1.02, "{least} {most}");
}

/// Wear spreads the load of a sphere over ever more cells, so the largest pressure falls from cycle to cycle. A nearly incompressible film is
/// stiffer against long waves of pressure than against pressure that alternates from cell to cell: steps of 120 cycles, which the latter
/// would allow here, let the largest pressure jump up and down by a third.
#[test]
fn on_a_nearly_incompressible_film_the_pressure_falls_all_the_time() {
    let history = solved(
        "[grid]\ncells = [32, 32]\nsize = [6.0, 6.0]\n[upper]\nrigid = true\n[lower]\nbase = \"rigid\"\n\
         coatings = [{ thickness = 0.08, young = 1.0, poisson = 0.4999 }]\n[profile.sphere]\nradius = 20.0\n[friction]\n\
         coefficient = 0.3\n[wear]\nlaw = \"archard\"\ncoefficient = 3e-4\nevery = 1000\nlargest_step = 1.0\n[[load]]\n\
         normal_force = 1.0\nincrements = 1\n[[load]]\nshift = [0.3, 0.0]\nincrements = 4\ncycles = 450\n",
    );
    let pressures: Vec<f64> = history.steps.iter().step_by(4).map(|step| step.max_pressure).collect();
    assert!((50..90).contains(&pressures.len()), "cycles are jumped over: {}", pressures.len());
    // Cells that come into contact one by one: a hundredth.
    assert!(pressures.windows(2).all(|pair| pair[1] < 1.01 * pair[0]), "{pressures:?}");
    assert!(pressures[pressures.len() - 1] < 0.2 * pressures[0]);
}
