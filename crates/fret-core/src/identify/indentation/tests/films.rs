//! Films on their substrates, against solutions on a finer grid and against limits of thick and thin ones.

use std::f64::consts::PI;

use super::super::indenter::{Indenter, Pressing};
use super::super::{IndentationRequest, Numbers};
use super::{MODULUS, Model, Test, found, held, hertz, homogeneous, text};
use crate::case::Case;
use crate::plan::Plan;
use crate::run::{Silent, Simulation};

/// A soft film on a stiff base, by its modulus and its thickness.
pub fn film(cells: usize) -> impl Fn(&[f64]) -> String + Sync {
    move |values| {
        let body = format!(
            "lower.substrate = {{ young = 210e3, poisson = 0.3 }}\nlower.coatings = [{{ thickness = {:?}, young = {:?}, poisson = 0.3 }}]",
            values[1], values[0]
        );
        text("profile.sphere.radius = 1.0", &body, cells)
    }
}

pub const YOUNG: (&str, f64) = ("lower.coatings[0].young", 70e3);
pub const THICKNESS: (&str, f64) = ("lower.coatings[0].thickness", 0.02);

/// Loads of the film at depths, solved one by one on 96 x 96 cells: between 24 of them `P/d^1.5` is nearly a line.
pub fn of_film(deepest: f64) -> impl Fn(f64) -> f64 + Sync {
    let text = film(96)(&[YOUNG.1, THICKNESS.1]);
    let depths: Vec<f64> = (1..=24).map(|k| deepest * (f64::from(k) / 24.0).powi(2)).collect();
    let rows: String = depths.iter().fold(String::new(), |text, depth| {
        text + &format!("[[load]]\napproach = {depth:?}\nincrements = 1\n")
    });
    let text = text.split("[[load]]").next().unwrap().to_owned() + &rows;
    let plan = Plan::new(Case::from_toml(&text, "film.toml").unwrap()).unwrap();
    let history = Simulation::new(&plan).run(&mut Silent).unwrap();
    let known: Vec<[f64; 2]> =
        history.steps.iter().zip(&depths).map(|(step, depth)| [*depth, step.normal_force]).collect();
    move |depth: f64| {
        // The smallest ones show the cells.
        let after = known.partition_point(|point| point[0] < depth).clamp(8, known.len() - 1);
        let [[a, p], [b, q]] = [known[after - 1], known[after]];
        let [p, q] = [p / a.powf(1.5), q / b.powf(1.5)];
        (p + (q - p) * (depth - a) / (b - a)) * depth.powf(1.5)
    }
}

/// One number of the film with the other known, from a start 30 % off, on 40 x 40 cells: clean curves to 1 %, of which the grid's own error
/// is a third; of four with 1 % of noise three are held at the least (fewer happen once in 70).
#[test]
fn modulus_and_thickness_of_a_film_are_found() {
    let deepest = 2e-3;
    let load = of_film(deepest);
    let test = Test { deepest, load: &load, frame: 0.0 };
    let grid = film(40);
    let request = IndentationRequest::default();
    for (key, other) in [(YOUNG, THICKNESS), (THICKNESS, YOUNG)] {
        let case = |values: &[f64]| {
            if key == YOUNG { grid(&[values[0], other.1]) } else { grid(&[other.1, values[0]]) }
        };
        let start = [(key.0, 0.7 * key.1)];
        let clean = found(&case, &start, &test.log([0.0; 2], 0), &request).unwrap();
        let error = clean.constants[0].value / key.1 - 1.0;
        let of = |seed| found(&case, &start, &test.log([0.01; 2], seed), &request).unwrap();
        let (held, worst, half) = held(&[key.1], 4, of)[0];
        println!(
            "{}: clean {error:+.5}, half of the cells {:?}, {} histories; of 4 held {held}, worst {worst:.4}, half-width {half:.4}; {:?}",
            key.0, clean.grid, clean.histories, clean.notes
        );
        assert!(error.abs() < 0.01, "{}: {error}", key.0);
        assert!(clean.histories <= 40, "{} histories", clean.histories);
        assert!(held >= 3, "{}: {held} of 4, worst {worst}", key.0);
    }
}

/// The derivatives that come with a curve are those of differences of curves: to their own error, the square of the step, 1e-5.
#[test]
fn derivatives_of_a_curve_are_those_of_differences() {
    let grid = film(32);
    let case_of = |values: &[f64]| Case::from_toml(&grid(values), "case.toml");
    let numbers = Numbers {
        keys: [YOUNG, THICKNESS].map(|(name, value)| (name.to_owned(), value)).to_vec(),
        case_with: &case_of,
    };
    let at = [YOUNG.1, THICKNESS.1];
    let mut indenter = Indenter::new(&case_of(&at).unwrap(), &numbers).unwrap();
    indenter.reach(&at, 2e-3).unwrap();
    let (curve, histories) = indenter.pressed(&at).unwrap();
    assert_eq!(histories, 1);
    for k in 0..2 {
        let beside = |step: f64| {
            let mut values = at;
            values[k] *= step.exp();
            indenter.pressed(&values).unwrap().0
        };
        let (up, down) = (beside(2e-3), beside(-2e-3));
        for depth in [2e-4, 7e-4, 1.3e-3, 2e-3] {
            let difference = (up.at(depth)[0] - down.at(depth)[0]) / 4e-3;
            let off = curve.by(k, depth) / difference - 1.0;
            assert!(off.abs() < 1e-3, "{k}, {depth}: {off}");
        }
    }
}

/// A film much thicker than the contact is wide is a half-space of its own: a rigid base adds 0.88 a/t to the load (Dimitriadis et al. 2002), 0.7 % at
/// a/t = 1/126, one three times as stiff less, and the grid 0.3 %. One that is much thinner tells the base, and nothing of itself.
#[test]
fn thick_films_are_bodies_and_thin_ones_tell_the_base() {
    let hertz = |modulus: f64| move |d: f64| 4.0 / 3.0 * modulus * d.powf(1.5);
    let request = IndentationRequest::default();
    // a = sqrt(R d) = 0.0316
    let (soft, stiff) = (hertz(MODULUS), hertz(210e3 / 0.91));
    let grid = film(48);
    let thick = |values: &[f64]| grid(&[values[0], 4.0]);
    let test = Test { deepest: 1e-3, load: &soft, frame: 0.0 };
    let of_thick = found(&thick, &[(YOUNG.0, 50e3)], &test.log([0.0; 2], 0), &request).unwrap();
    let error = of_thick.constants[0].value / 70e3 - 1.0;
    println!("thick: {error:+.4}");
    assert!(error < 0.003 && error > -0.008, "{error}");
    let thin = |values: &[f64]| grid(&[values[0], 1e-5]);
    let test = Test { deepest: 1e-3, load: &stiff, frame: 0.0 };
    let of_thin = found(&thin, &[(YOUNG.0, 70e3)], &test.log([0.01; 2], 0), &request).unwrap();
    println!("thin: {:?} {:?}", of_thin.constants[0], of_thin.notes);
    assert!(!of_thin.constants[0].told);
    assert!(of_thin.notes.iter().any(|note| note.contains("does not tell lower.coatings[0].young")));
}

/// A layer on a rigid base, thin against the contact: each place a spring of its own, `P = pi R E_oed d^2/t` with the modulus of uniaxial strain
/// (Johnson, Contact Mechanics, sec. 5.8). At a/t = 60 the edge, about t wide, is t/a of the contact.
#[test]
fn a_thin_layer_on_a_rigid_base_is_a_bed_of_springs() {
    let (young, poisson, thickness, deepest) = (5e3, 0.2, 1e-3, 1.8e-3);
    let oedometric = young * (1.0 - poisson) / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
    let load = |d: f64| PI * oedometric * d * d / thickness;
    let case = |values: &[f64]| {
        let body = format!(
            "lower = {{ base = 'rigid', coatings = [{{ thickness = {thickness:?}, young = {:?}, poisson = {poisson:?} }}] }}",
            values[0]
        );
        text("profile.sphere.radius = 1.0", &body, 64)
    };
    let test = Test { deepest, load: &load, frame: 0.0 };
    let request = IndentationRequest::default();
    let found = found(&case, &[(YOUNG.0, 4e3)], &test.log([0.0; 2], 0), &request).unwrap();
    let error = found.constants[0].value / young - 1.0;
    println!("bed: {error:+.4}; touch {:?}", found.constants[1]);
    assert!(error.abs() < 1.0 / 60.0, "{error}");
}

/// Moduli of film and substrate at once, behind a frame that is known, with the touch: the shallow part tells the one, the deep one the other. On
/// 40 x 40 cells the film is told to 3 %: what the grid does to either goes into both.
#[test]
fn two_numbers_behind_a_frame_are_found_together() {
    let deepest = 4e-3;
    let load = of_film(deepest);
    let frame = 0.3 * deepest / load(deepest);
    let case = |values: &[f64]| {
        let body = format!(
            "rig.normal_stiffness = {:?}\nlower.substrate = {{ young = {:?}, poisson = 0.3 }}\nlower.coatings = [{{ thickness = {:?}, young = {:?}, poisson = 0.3 }}]",
            1.0 / frame,
            values[1],
            THICKNESS.1,
            values[0]
        );
        text("profile.sphere.radius = 1.0", &body, 40)
    };
    let test = Test { deepest, load: &load, frame };
    let request = IndentationRequest::default();
    let start = [(YOUNG.0, 60e3), ("lower.substrate.young", 180e3)];
    let found = found(&case, &start, &test.log([0.0; 2], 0), &request).unwrap();
    println!("{:?}, {:?}, {} histories, {:?}", found.constants, found.grid, found.histories, found.notes);
    for (constant, truth) in found.constants.iter().zip([YOUNG.1, 210e3]) {
        assert!((constant.value / truth - 1.0).abs() < 0.03, "{constant:?}");
    }
}

/// A number of which there are no exact derivatives, the modulus at the surface of a graded film, is fitted by differences.
#[test]
fn a_number_without_exact_derivatives_is_found_by_differences() {
    let case = |values: &[f64]| {
        let body = format!(
            "lower.substrate = {{ young = 210e3, poisson = 0.3 }}\nlower.coatings = [{{ thickness = 0.02, poisson = 0.3, gradient = {{ young = [{:?}, 70e3], law = 'linear' }} }}]",
            values[0]
        );
        text("profile.sphere.radius = 1.0", &body, 32)
    };
    let deepest = 2e-3;
    let load = of_film(deepest);
    let test = Test { deepest, load: &load, frame: 0.0 };
    let request = IndentationRequest::default();
    let log = test.log([0.0; 2], 0);
    let found = found(&case, &[("lower.coatings[0].gradient.young[0]", 60e3)], &log, &request).unwrap();
    println!("{:?}, {} histories, {:?}", found.constants, found.histories, found.notes);
    assert!((found.constants[0].value / 70e3 - 1.0).abs() < 0.03, "{:?}", found.constants[0]);
}

/// The promise of the page: of a film on its substrate, 95 % intervals hold in 90 of 100 logs at the least.
#[test]
#[ignore = "long: six hundred fits"]
fn intervals_of_films_hold_in_ninety_of_a_hundred() {
    let deepest = 2e-3;
    let load = of_film(deepest);
    let test = Test { deepest, load: &load, frame: 0.0 };
    let grid = film(40);
    let request = IndentationRequest::default();
    let by_young = |values: &[f64]| grid(&[values[0], THICKNESS.1]);
    let by_thickness = |values: &[f64]| grid(&[YOUNG.1, values[0]]);
    let ball = Test { deepest: 1e-3, load: &hertz, frame: 0.0 };
    let of_ball = homogeneous("profile.sphere.radius = 1.0", 48);
    let trials: [(&str, f64, Model<'_>, &Test<'_>); 3] = [
        ("lower.substrate.young", 70e3, &of_ball, &ball),
        (YOUNG.0, YOUNG.1, &by_young, &test),
        (THICKNESS.0, THICKNESS.1, &by_thickness, &test),
    ];
    for (trial, (key, truth, case, test)) in trials.into_iter().enumerate() {
        for (kind, noise) in [[0.01, 0.01], [0.002, 0.002]].into_iter().enumerate() {
            // Each has logs of its own.
            let first = 1000 * (2 * trial + kind) as u64;
            let log = |seed| test.log(noise, first + seed);
            let of = |seed| found(case, &[(key, 0.7 * truth)], &log(seed), &request).unwrap();
            let (held, worst, half) = held(&[truth], 100, of)[0];
            println!("{key}, noise {noise:?}: {held} of 100, worst {worst:.4}, half-width {half:.4}");
            assert!(held >= 90, "{key}: {held} of 100");
        }
    }
}
