//! Indentations whose modulus or thickness is known: closed forms of Hertz and Sneddon, and films on a finer grid, with noise in load and depth.

use std::fmt::Write;

use rand_pcg::Pcg64Mcg;
use rayon::prelude::{IntoParallelIterator, ParallelIterator};

use super::super::{Indentation, Key, Request, indentation};
use super::normal;
use crate::case::Case;
use crate::plan::Plan;
use crate::run::{Silent, Simulation};

/// A rigid indenter on a body of E = 70 GPa, nu = 0.3, in mm and N; `cells` along each side.
fn text(profile: &str, body: &str, cells: usize) -> String {
    format!(
        "units = {{ length = 'mm', force = 'N' }}\ngrid = {{ cells = [{cells}, {cells}], size = 'auto' }}\nupper.rigid = true\n{body}\n{profile}\n\
         [[load]]\nnormal_force = 1.0\nincrements = 1\n"
    )
}

/// A test: the case with a value of its key, that value, the deepest point, and the load at a depth.
struct Test<'a> {
    key: &'a str,
    case: &'a (dyn Fn(f64) -> String + Sync),
    truth: f64,
    deepest: f64,
    load: &'a (dyn Fn(f64) -> f64 + Sync),
}

impl Test<'_> {
    /// Two hundred points of loading and unloading, from a tenth of the depth before the touch on, with so much noise in both.
    fn log(&self, noise: f64, seed: u64) -> String {
        let mut random = Pcg64Mcg::new(u128::from(seed) * 2 + 0x51ed_270b_9ac3_4d17);
        let most = (self.load)(self.deepest);
        (0..200).fold("depth [um];load [mN]\n".to_owned(), |mut log, k| {
            let along = 1.0 - (f64::from(k) / 99.5 - 1.0).abs();
            let depth = self.deepest * (1.1 * along - 0.1);
            let load = if depth > 0.0 { (self.load)(depth) } else { 0.0 };
            let [d, p] = [self.deepest, most].map(|size| size * noise * normal(&mut random));
            // the instrument counts from somewhere
            let _ = writeln!(log, "{:.8};{:.8}", 1e3 * (depth + d + 0.3 * self.deepest), 1e3 * (load + p));
            log
        })
    }

    fn found(&self, start: f64, log: &str) -> Indentation {
        let case_of = |value: f64| Case::from_toml(&(self.case)(value), "case.toml");
        let key = Key { name: self.key, value: start, case_with: &case_of };
        indentation(("log.csv", log.as_bytes()), case_of(start).unwrap(), key, &Request::default())
            .unwrap_or_else(|error| panic!("{error}"))
    }

    /// In how many of so many logs the interval holds the truth, the largest error, and the median half-width, relative.
    fn held(&self, noise: f64, count: u64) -> (usize, f64, f64) {
        let all: Vec<[f64; 2]> = (0..count)
            .into_par_iter()
            .map(|seed| {
                let found = self.found(0.6 * self.truth, &self.log(noise, seed));
                let [low, high] = found.constants[0].interval;
                let error = found.constants[0].value / self.truth - 1.0;
                [
                    error,
                    if low <= self.truth && self.truth <= high {
                        (high / low).ln() / 2.0
                    } else {
                        -(high / low).ln() / 2.0
                    },
                ]
            })
            .collect();
        let mut halves: Vec<f64> = all.iter().map(|[_, half]| half.abs()).collect();
        halves.sort_by(f64::total_cmp);
        let worst = all.iter().fold(0.0_f64, |most, [error, _]| most.max(error.abs()));
        (all.iter().filter(|[_, half]| *half > 0.0).count(), worst, halves[halves.len() / 2])
    }
}

const MODULUS: f64 = 70e3 / (1.0 - 0.09);

fn homogeneous(profile: &'static str, cells: usize) -> impl Fn(f64) -> String + Sync {
    move |young| text(profile, &format!("lower.substrate = {{ young = {young:?}, poisson = 0.3 }}"), cells)
}

/// Hertz and Sneddon, from a start 40 % too low: clean curves to 0.5 %, the error of 48 cells along a side (a punch's edge, 1 %), noisy ones
/// within their intervals in 17 of 20 at the least (95 % of 20 are 19; fewer than 17 happen once in 60).
#[test]
fn the_modulus_of_a_homogeneous_body_is_found() {
    let sphere = homogeneous("profile.sphere.radius = 1.0", 48);
    let cone = homogeneous("profile.cone.slope = 0.2", 48);
    let punch = homogeneous("profile.flat_punch.radius = 0.01", 48);
    let hertz = |d: f64| 4.0 / 3.0 * MODULUS * d.powf(1.5);
    let sneddon = |d: f64| 2.0 / std::f64::consts::PI * MODULUS * d * d / 0.2;
    let flat = |d: f64| 2.0 * 0.01 * MODULUS * d;
    let key = "lower.substrate.young";
    for (name, clean, test) in [
        ("sphere", 0.005, Test { key, case: &sphere, truth: 70e3, deepest: 1e-3, load: &hertz }),
        ("cone", 0.005, Test { key, case: &cone, truth: 70e3, deepest: 1e-3, load: &sneddon }),
        ("punch", 0.01, Test { key, case: &punch, truth: 70e3, deepest: 1e-4, load: &flat }),
    ] {
        let found = test.found(42e3, &test.log(0.0, 0));
        let error = found.constants[0].value / test.truth - 1.0;
        let (held, worst, half) = test.held(0.01, 20);
        println!("{name}: clean {error:+.5}; of 20 held {held}, worst {worst:.4}, half-width {half:.4}");
        assert!(error.abs() < clean, "{name}: {error}");
        let touches = found.constants[1].value / (0.3 * test.deepest) - 1.0;
        assert!(touches.abs() < 0.01, "{name}: {touches}");
        assert!(held >= 17, "{name}: {held} of 20, worst {worst}");
    }
}

/// A soft film on a stiff base: its modulus, and its thickness, by curves of the solver on a grid of other cells.
fn film(cells: usize) -> impl Fn([f64; 2]) -> String + Sync {
    move |[young, thickness]| {
        let body = format!(
            "lower.substrate = {{ young = 210e3, poisson = 0.3 }}\nlower.coatings = [{{ thickness = {thickness:?}, young = {young:?}, poisson = 0.3 }}]"
        );
        text("profile.sphere.radius = 1.0", &body, cells)
    }
}

/// Loads of the film at depths, solved one by one on 64 x 64 cells, by a parabola in the logarithms between 24 of them.
fn of_film(deepest: f64) -> impl Fn(f64) -> f64 + Sync {
    let text = film(64)([70e3, 0.02]);
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
        // P/d^1.5 is nearly a line of d
        let after = known.partition_point(|point| point[0] < depth).clamp(4, known.len() - 1);
        let [[a, p], [b, q]] = [known[after - 1], known[after]];
        let [p, q] = [p / a.powf(1.5), q / b.powf(1.5)];
        (p + (q - p) * (depth - a) / (b - a)) * depth.powf(1.5)
    }
}

#[test]
fn modulus_and_thickness_of_a_film_are_found() {
    let deepest = 2e-3;
    let load = of_film(deepest);
    let grid = film(40);
    let by_young = |young: f64| grid([young, 0.02]);
    let by_thickness = |thickness: f64| grid([70e3, thickness]);
    for (test, clean) in [
        (Test { key: "lower.coatings.0.young", case: &by_young, truth: 70e3, deepest, load: &load }, 0.01),
        (
            Test {
                key: "lower.coatings.0.thickness",
                case: &by_thickness,
                truth: 0.02,
                deepest,
                load: &load,
            },
            0.01,
        ),
    ] {
        let found = test.found(0.7 * test.truth, &test.log(0.0, 0));
        let error = found.constants[0].value / test.truth - 1.0;
        let (held, worst, half) = test.held(0.01, 20);
        println!(
            "{}: clean {error:+.5}; of 20 held {held}, worst {worst:.4}, half-width {half:.4}",
            test.key
        );
        assert!(error.abs() < clean, "{}: {error}", test.key);
        assert!(held >= 17, "{}: {held} of 20, worst {worst}", test.key);
    }
}

/// The promise of the page: 95 % intervals hold in 90 of 100 at the least.
#[test]
#[ignore = "long: three hundred fits"]
fn intervals_of_indentations_hold_in_ninety_of_a_hundred() {
    let sphere = homogeneous("profile.sphere.radius = 1.0", 48);
    let hertz = |d: f64| 4.0 / 3.0 * MODULUS * d.powf(1.5);
    let load = of_film(2e-3);
    let grid = film(40);
    let by_young = |young: f64| grid([young, 0.02]);
    let by_thickness = |thickness: f64| grid([70e3, thickness]);
    let young = "lower.substrate.young";
    for test in [
        Test { key: young, case: &sphere, truth: 70e3, deepest: 1e-3, load: &hertz },
        Test { key: "lower.coatings.0.young", case: &by_young, truth: 70e3, deepest: 2e-3, load: &load },
        Test {
            key: "lower.coatings.0.thickness",
            case: &by_thickness,
            truth: 0.02,
            deepest: 2e-3,
            load: &load,
        },
    ] {
        let (held, worst, half) = test.held(0.01, 100);
        println!("{}: {held} of 100, worst {worst:.4}, half-width {half:.4}", test.key);
        assert!(held >= 90, "{}: {held} of 100", test.key);
    }
}
