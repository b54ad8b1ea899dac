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
    // Without an iteration: the pressure of full contact is the first guess.
    assert_eq!(history.steps[0].contact_cells, 64 * 64);
    assert!(history.steps[0].work.convolutions <= 2, "{:?}", history.steps[0].work);
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
