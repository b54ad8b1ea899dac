//! Scenes that repeat: waves with closed forms, and a lonely sphere.

use std::f64::consts::{PI, TAU};

use fret_core::analytic::Westergaard;
use fret_core::kernel::FrequencyResponse;
use fret_core::model::{Base, Coating, ElasticMaterial, HalfSpace};
use fret_validation::{Sphere, keeping, solved};

const MODULUS: f64 = 1.0 / 0.91;
const AMPLITUDE: f64 = 1e-3;

fn wave(cells: [usize; 2], size: [f64; 2], lengths: &str, coatings: &str, force: f64) -> String {
    format!(
        "[grid]\ncells = {cells:?}\nsize = {size:?}\nperiodic = true\n[upper]\nrigid = true\n[lower]\n{coatings}\
         substrate = {{ young = 1.0, poisson = 0.3 }}\n[profile.wave]\namplitude = {AMPLITUDE:e}\n{lengths}\n\
         [[load]]\nnormal_force = {force:e}\nincrements = 1\n{}",
        keeping(1)
    )
}

#[test]
fn westergaard_s_wave_in_partial_contact() {
    let full = PI * MODULUS * AMPLITUDE;
    for share in [0.1, 0.5, 0.9] {
        let mean = share * full;
        let size = [1.0, 1.0 / 32.0];
        let history = solved(&wave([256, 8], size, "wavelength_x = 1.0", "", mean * size[0] * size[1]));
        let exact = Westergaard::new(AMPLITUDE, 1.0, mean, MODULUS).unwrap();
        let pressure = history.fields[0].pressure.as_ref().unwrap();
        let mut square = 0.0;
        for ((i, _), p) in pressure.indexed_iter() {
            square += (p - exact.pressure(history.grid.centre(0, i))).powi(2);
        }
        let rms = (square / pressure.len() as f64).sqrt() / full;
        println!("mean pressure {share} of full contact: rms error {rms:.1e} p*");
        // 256 cells a wave: the root at the edge is smeared over a cell.
        assert!(rms < 2e-3, "{share}: {rms}");
        let peak = history.steps[0].max_pressure / exact.pressure(0.0) - 1.0;
        assert!(peak.abs() < 1e-3, "{share}: {peak}");
    }
}

#[test]
fn a_coated_wave_in_full_contact_answers_like_its_wavenumber() {
    let coatings = "coatings = [{ thickness = 0.2, young = 2.0, poisson = 0.3 }]\n";
    let lower = HalfSpace::new(
        vec![Coating::new(ElasticMaterial::new(2.0, 0.3).unwrap(), 0.2).unwrap()],
        Base::Elastic(ElasticMaterial::new(1.0, 0.3).unwrap()),
    )
    .unwrap();
    let response = FrequencyResponse::new(&lower).at(TAU * 2.0_f64.sqrt()).zz;
    let amplitude = AMPLITUDE / response;
    let history = solved(&wave(
        [64, 64],
        [1.0, 1.0],
        "wavelength_x = 1.0\nwavelength_y = 1.0",
        coatings,
        1.5 * amplitude,
    ));
    let d = 1.0 / 64.0;
    let sinc = (PI * d).sin() / (PI * d);
    let pressure = history.fields[0].pressure.as_ref().unwrap();
    let mut worst = 0.0_f64;
    for ((i, j), p) in pressure.indexed_iter() {
        let (x, y) = (history.grid.centre(0, i), history.grid.centre(1, j));
        let expected = 1.5 * amplitude + amplitude / (sinc * sinc) * (TAU * x).cos() * (TAU * y).cos();
        worst = worst.max((p - expected).abs());
    }
    // A wave of the grid is an eigenvector; the solver's tolerance of 1e-8 is what is left.
    assert!(worst < 1e-7 * amplitude, "{:e}", worst / amplitude);
    assert_eq!(history.steps[0].contact_cells, 64 * 64);
    // An eigenvector of the preconditioner, too: one step from the pressure of coarser grids, and the gap in the end, on a quarter of the grid.
    assert!(history.steps[0].work.full_grid_convolutions < 0.75, "{:?}", history.steps[0].work);
}

#[test]
fn a_lonely_sphere_in_a_wide_period_is_one_in_free_space() {
    let alone =
        |cells: usize, size: f64| Sphere { cells, size, coating: Some((2.0, 1.0)), ..Sphere::default() };
    let peak = |text: &str| solved(text).steps[0].max_pressure;
    let free = peak(&alone(64, 4.0).pressed(1.0, 1, "linear"));
    // The same cells in wider periods: neighbours bend the surface by the inverse cube of their distance.
    let off = [64, 128].map(|cells| {
        let size = cells as f64 / 16.0;
        let text =
            alone(cells, size).pressed(1.0, 1, "linear").replace("[upper]", "periodic = true\n[upper]");
        (peak(&text) / free - 1.0).abs()
    });
    println!("largest pressure off by {:.1e} and {:.1e} in periods of 4 and 8 lengths", off[0], off[1]);
    assert!(off[1] < 3e-3 && off[0] / off[1] > 4.0, "{off:?}");
}

#[test]
fn friction_in_full_contact_sticks_until_mu_p_is_reached() {
    // Equal bodies, wave far below full contact's mean pressure: a tangential force is carried without slip at first.
    let mean = 4.0 * PI * MODULUS / 2.0 * AMPLITUDE;
    let text = format!(
        "[grid]\ncells = [32, 8]\nsize = [1.0, 0.25]\nperiodic = true\n[upper]\nsubstrate = {{ young = 1.0, poisson = 0.3 }}\n\
         [lower]\nsubstrate = {{ young = 1.0, poisson = 0.3 }}\n[profile.wave]\namplitude = {AMPLITUDE:e}\nwavelength_x = 1.0\n\
         [friction]\ncoefficient = 0.5\n[[load]]\nnormal_force = {:e}\nincrements = 1\n[[load]]\n\
         tangential_force = [{:e}, 0.0]\nincrements = 2\n{}",
        mean * 0.25,
        0.2 * mean * 0.25,
        keeping(1)
    );
    let history = solved(&text);
    let shear = &history.fields.last().unwrap().shear.as_ref().unwrap()[0];
    // Pressure is nowhere below 0.75 of the mean, so 0.2 of it sticks everywhere: a uniform shear moves the bodies rigidly.
    let worst = shear.iter().map(|q| (q - 0.2 * mean).abs()).fold(0.0, f64::max);
    assert!(worst < 1e-8 * mean, "{:e}", worst / mean);
}

/// A flat film on a rigid base under a rigid wave so shallow that everything touches.
fn film(load: &str) -> String {
    format!(
        "[grid]\ncells = [16, 16]\nsize = [1.0, 1.0]\nperiodic = true\n[upper]\nrigid = true\n[lower]\nbase = \"rigid\"\n\
         coatings = [{{ thickness = 0.06, young = 1.0, poisson = 0.3 }}, {{ thickness = 0.04, young = 3.0, poisson = 0.4 }}]\n\
         [profile.wave]\namplitude = 1e-9\nwavelength_x = 1.0\nwavelength_y = 1.0\n[friction]\ncoefficient = 0.5\n{load}"
    )
}

#[test]
fn a_film_on_a_rigid_base_gives_way_to_uniform_tractions() {
    // One-dimensional compression and simple shear, layer by layer.
    let layers: [[f64; 3]; 2] = [[0.06, 1.0, 0.3], [0.04, 3.0, 0.4]];
    let pressed: f64 =
        layers.iter().map(|[h, e, nu]| h * (1.0 + nu) * (1.0 - 2.0 * nu) / (e * (1.0 - nu))).sum();
    let sheared: f64 = layers.iter().map(|[h, e, nu]| 2.0 * h * (1.0 + nu) / e).sum();
    let history = solved(&film(
        "[[load]]\nnormal_force = 0.01\nincrements = 1\n[[load]]\nnormal_force = 0.03\nincrements = 1\n\
         [[load]]\ntangential_force = [0.006, 0.003]\nincrements = 1\n",
    ));
    let [first, second, third] = [0, 1, 2].map(|step| &history.steps[step]);
    assert_eq!(second.contact_cells, 256);
    // The increments' residual of 1e-8, and what the wave's own pressure changes the shear by.
    let slope = (second.approach - first.approach) / 0.02;
    assert!((slope / pressed - 1.0).abs() < 1e-6, "{slope} {pressed}");
    for axis in 0..2 {
        let slope = third.shift[axis] / third.tangential_force[axis];
        assert!((slope / sheared - 1.0).abs() < 1e-6, "{slope} {sheared}");
    }
    // The same asked for by motions.
    let (approach, shift) = (second.approach, third.shift);
    let moved = solved(&film(&format!(
        "[[load]]\napproach = {approach:e}\nincrements = 2\n[[load]]\nshift = [{:e}, {:e}]\nincrements = 1\n",
        shift[0], shift[1]
    )));
    let end = moved.steps.last().unwrap();
    assert!((end.normal_force / 0.03 - 1.0).abs() < 1e-6, "{}", end.normal_force);
    assert!((end.tangential_force[0] / 0.006 - 1.0).abs() < 1e-6, "{}", end.tangential_force[0]);
    assert!((end.tangential_force[1] / 0.003 - 1.0).abs() < 1e-6, "{}", end.tangential_force[1]);
}

#[test]
fn a_lonely_sphere_on_a_film_moves_as_far_whether_the_scene_repeats_or_not() {
    // Films of a tenth and of half a contact radius, a period of eight radii: neighbours do not feel each other.
    for (thickness, off) in [(0.1, 2e-3), (0.5, 4e-3)] {
        let text = |grid: &str| {
            format!(
                "[grid]\n{grid}\n[upper]\nrigid = true\n[lower]\nbase = \"rigid\"\n\
                 coatings = [{{ thickness = {thickness}, young = 1.0, poisson = 0.3 }}]\n[profile.sphere]\nradius = 100.0\n\
                 [friction]\ncoefficient = 0.3\n[[load]]\nnormal_force = 0.02\nincrements = 1\n\
                 [[load]]\ntangential_force = [2e-3, 0.0]\nincrements = 2\n"
            )
        };
        let alone = solved(&text("cells = [64, 64]\nsize = [4.0, 4.0]"));
        let repeated = solved(&text("cells = [128, 128]\nsize = [8.0, 8.0]\nperiodic = true"));
        let [a, b] = [&alone, &repeated].map(|history| history.steps.last().unwrap());
        let (approach, shift) = (b.approach / a.approach - 1.0, b.shift[0] / a.shift[0] - 1.0);
        println!("film {thickness}: approach {approach:.1e}, shift {shift:.1e} off free space");
        // Periodic cells answer in waves, free ones at their centres: what that differs by falls with the cell squared.
        assert!(approach.abs() < off && shift.abs() < off, "{thickness}: {approach} {shift}");
    }
}
