//! Loops of Mindlin and Deresiewicz in series with a spring, with noise and drift, given back their constants.

mod bad_cycles;
mod coverage;
mod exports;
mod friction;

use std::f64::consts::TAU;
use std::fmt::Write;

use nalgebra::{DMatrix, DVector};
use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::Rng;
use rayon::prelude::{IntoParallelIterator, ParallelIterator};

use super::fit::fit;
use super::model::Model;
use super::{Constant, Identification, IdentifyError, Request};
use crate::case::Case;
use crate::history::CycleRegime;
use crate::measured::Asked;

/// Two equal spheres of E = 210 GPa, nu = 0, pressed with 100 N: units mm and N.
const CASE: &str = "[units]\nlength = \"mm\"\nforce = \"N\"\n[grid]\ncells = [40, 40]\nsize = \"auto\"\n[upper]\nsubstrate = { young = 210e3, poisson = 0.0 }\n\
    [lower]\nsubstrate = { young = 210e3, poisson = 0.0 }\n[profile.sphere]\nradius = 10.0\n[friction]\ncoefficient = 0.5\n[[load]]\nnormal_force = 100.0\nincrements = 1\n\
    [[load]]\ntangential_force = [1.0, 0.0]\nincrements = 4\n";
const PRESSED: f64 = 100.0;

fn case() -> Case {
    Case::from_toml(CASE, "case.toml").unwrap()
}

fn identify(log: &str, case: Case, request: &Request) -> Result<Identification, IdentifyError> {
    super::identify(("log.csv", log.as_bytes()), case, None, request)
}

/// A number of the normal distribution.
pub(super) fn normal(random: &mut Pcg64Mcg) -> f64 {
    let mut uniform = || (f64::from(random.next_u32()) + 0.5) / 4_294_967_296.0;
    let (radius, angle) = ((-2.0 * uniform().ln()).sqrt(), TAU * uniform());
    radius * angle.cos()
}

/// A test in closed form.
#[derive(Clone, Copy)]
struct Rig {
    friction: f64,
    stiffness: f64,
    amplitude: f64,
    points: usize,
    noise: f64,
    drift: f64,
}

impl Rig {
    /// Cattaneo and Mindlin: `3 mu P/(16 a G*) [1 - (1 - T/mu P)^(2/3)]`, with the rig's own; `a = (3 P R/(4 E*))^(1/3)`, `1/G* = 4/G`.
    fn first(&self, force: f64) -> f64 {
        let (modulus, shear) = (105e3_f64, 105e3 / 4.0);
        let radius = (0.75 * PRESSED * 10.0 / modulus).cbrt();
        let limit = self.friction * PRESSED;
        3.0 * limit / (16.0 * radius * shear) * (1.0 - (1.0 - force / limit).max(0.0).powf(2.0 / 3.0))
            + force / self.stiffness
    }

    /// The force after a displacement of the actuator from rest.
    fn force_at(&self, displacement: f64) -> f64 {
        let limit = self.friction * PRESSED;
        if displacement >= self.first(limit) {
            return limit;
        }
        let (mut low, mut high) = (0.0, limit);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if self.first(middle) < displacement { low = middle } else { high = middle }
        }
        low
    }

    /// Rows of one cycle, from the largest displacement down and up again: Masing's rule.
    fn rows(&self, random: &mut Pcg64Mcg) -> Vec<[f64; 2]> {
        let peak = self.force_at(self.amplitude);
        let mut normal = || normal(random);
        (0..self.points)
            .map(|k| {
                let time = k as f64 / self.points as f64;
                let wave = if time < 0.5 { 1.0 - 4.0 * time } else { 4.0 * time - 3.0 };
                let place = self.amplitude * wave;
                let sign = if time < 0.5 { 1.0 } else { -1.0 };
                let back = self.amplitude - sign * place;
                let force = sign * (peak - 2.0 * self.force_at(0.5 * back));
                [
                    place + self.amplitude * (0.3 + self.drift * time + self.noise * normal()),
                    force + peak * (0.05 + self.noise * normal()),
                ]
            })
            .collect()
    }

    fn log(&self, seed: u64) -> String {
        let rows = self.rows(&mut Pcg64Mcg::new(u128::from(seed) * 2 + 0x1234_5678_9abc_def1));
        rows.iter().fold("displacement [um],force [N]\n".to_owned(), |mut text, [d, q]| {
            let _ = writeln!(text, "{:.6},{q:.6}", d * 1e3);
            text
        })
    }
}

const PARTIAL: Rig =
    Rig { friction: 0.6, stiffness: 3e4, amplitude: 3.2e-3, points: 200, noise: 0.01, drift: 0.05 };

fn identified(log: &str, request: &Request) -> Identification {
    identify(log, case(), request).unwrap_or_else(|error| panic!("{error}"))
}

/// What is said of a log that is refused, and what to do about it.
fn refusal(log: &str, request: &Request) -> String {
    match identify(log, case(), request) {
        Ok(found) => panic!("{found:?}"),
        Err(IdentifyError::Log { what, help }) => format!("{what} | {help}"),
        Err(error) => error.to_string(),
    }
}

fn constant(found: &Identification, place: usize) -> [f64; 3] {
    let Constant { value, interval: [low, high], .. } = found.constants[place];
    [value, low, high]
}

/// Of every trial, for friction and stiffness: error over the half-width of the interval, and over the truth.
fn trials(rig: Rig, count: u64) -> [Vec<[f64; 2]>; 2] {
    let all: Vec<[[f64; 2]; 2]> = (0..count)
        .into_par_iter()
        .map(|seed| {
            let found = identified(&rig.log(seed), &Request::default());
            [(0, rig.friction), (1, rig.stiffness)].map(|(place, truth)| {
                let [value, _, high] = constant(&found, place);
                [(value / truth).ln().abs() / (high / value).ln(), (value / truth - 1.0).abs()]
            })
        })
        .collect();
    [0, 1].map(|k| all.iter().map(|trial| trial[k]).collect())
}

fn median(trials: &[[f64; 2]], of: usize) -> f64 {
    let mut values: Vec<f64> = trials.iter().map(|trial| trial[of]).collect();
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// Without noise what is left is the error of 40 cells and of the interpolated loop.
#[test]
fn a_clean_loop_gives_its_constants_back() {
    let clean = Rig { noise: 0.0, drift: 0.0, ..PARTIAL };
    let gross = Rig { amplitude: 8e-3, ..clean };
    for rig in [clean, gross] {
        let found = identified(&rig.log(0), &Request::default());
        let [friction, stiffness] = [0, 1].map(|place| constant(&found, place)[0]);
        assert!((friction / rig.friction - 1.0).abs() < 0.01, "{friction}");
        assert!((stiffness / rig.stiffness - 1.0).abs() < 0.01, "{stiffness}");
        // W_d of the log is the closed form's area by 200 chords: below 0.1 %.
        assert!(found.cycles[0].quantities.unwrap().energy_ratio > 0.0);
    }
    let found = identified(&gross.log(0), &Request::default());
    assert_eq!(found.regime, CycleRegime::GrossSlip);
    let plateau = found.cycles[0].quantities.unwrap().plateau_friction.unwrap();
    assert!((plateau / 0.6 - 1.0).abs() < 1e-3);
    assert_eq!(identified(&clean.log(0), &Request::default()).regime, CycleRegime::PartialSlip);
}

/// Offsets that are rounding do not bound the first step of the fit, from which the wrong start was taken for the solution.
#[test]
fn a_loop_about_nothing_but_rounding_is_fitted() {
    let rig = Rig { amplitude: 8e-3, noise: 0.0, drift: 0.0, points: 60, ..PARTIAL };
    let peak = rig.force_at(rig.amplitude);
    let rows = rig.rows(&mut Pcg64Mcg::new(1));
    let log = rows.iter().fold("displacement [um],force [N]\n".to_owned(), |mut text, [d, q]| {
        let [d, q] = [d - 0.3 * rig.amplitude + 5e-17 * rig.amplitude, q - 0.05 * peak + 5e-17 * peak];
        let _ = writeln!(text, "{:e},{q:e}", d * 1e3);
        text
    });
    let found = identified(&log, &Request::default());
    let [friction, stiffness] = [0, 1].map(|place| constant(&found, place)[0]);
    // as a clean loop: 40 cells and the interpolated loop
    assert!((friction / rig.friction - 1.0).abs() < 0.01, "{friction}");
    assert!((stiffness / rig.stiffness - 1.0).abs() < 0.01, "{stiffness}");
}

/// Steps that are found with the loops of other bodies, soft or stiff, end where the exact loops do: these take their place. Bounds as of the clean loop.
#[test]
fn coarse_loops_lead_to_the_constants_or_are_given_up() {
    let clean = Rig { noise: 0.0, drift: 0.0, ..PARTIAL };
    for rig in [clean, Rig { amplitude: 8e-3, ..clean }] {
        let cycle = identified(&rig.log(0), &Request::default()).fitted_cycle().measured.clone();
        let model = |young: &str| {
            let case = Case::from_toml(&CASE.replace("210e3", young), "case.toml").unwrap();
            Model::new(case, None).unwrap()
        };
        for young in ["21e3", "105e3", "420e3", "1900e3"] {
            let model = model("210e3").with_coarse(model(young));
            let fit = fit("log.csv", &cycle, &model, None).unwrap();
            let [friction, stiffness, _] = fit.constants(&fit.parameters).0;
            assert!((friction / rig.friction - 1.0).abs() < 0.01, "{young}: {friction}");
            assert!((stiffness / rig.stiffness - 1.0).abs() < 0.01, "{young}: {stiffness}");
        }
    }
}

/// Three points on each flank tell its slope badly, and what is guessed from it may lead nowhere: from other beginnings the loop is found. The plateaus tell
/// friction to the noise; stiffness and amplitude tell each other.
#[test]
fn loops_with_few_points_on_their_flanks_are_fitted() {
    let rig = Rig { amplitude: 0.04, drift: 0.0, points: 60, ..PARTIAL };
    for seed in 0..6 {
        let found = identified(&rig.log(seed), &Request::default());
        assert!(found.constants[0].told, "{seed}: {found:?}");
        let friction = constant(&found, 0)[0];
        assert!((friction / rig.friction - 1.0).abs() < 0.02, "{seed}: {friction}");
    }
}

/// 1 % of noise, 5 % of drift, 200 points: the middle one of six trials is within 1 %, and twice the 95 % interval (3.9 standard
/// deviations) holds the truth in all.
#[test]
fn noisy_loops_in_gross_slip_give_their_constants_back() {
    for found in trials(Rig { amplitude: 8e-3, ..PARTIAL }, 6) {
        assert!(median(&found, 1) < 0.01, "{found:?}");
        assert!(found.iter().all(|trial| trial[0] < 2.0), "{found:?}");
    }
}

/// Least standard deviations, relative, of any unbiased estimate of friction and stiffness from a log of the rig: Cramer and Rao's bound
/// for noise along both axes and unknown offsets and drift, by differences of the closed form. The amplitude is taken as known, so that
/// no estimate that has to find it, too, does better.
fn least_scatter(rig: Rig) -> [f64; 2] {
    let step = 1e-5;
    let peak = rig.force_at(rig.amplitude);
    let of = |rig: &Rig, sign: f64, place: f64| {
        sign * (rig.force_at(rig.amplitude)
            - 2.0 * rig.force_at(0.5 * (rig.amplitude - sign * place).max(0.0)))
    };
    let mut information = DMatrix::zeros(5, 5);
    for k in 0..rig.points {
        let time = k as f64 / rig.points as f64;
        let sign = if time < 0.5 { 1.0 } else { -1.0 };
        let place = rig.amplitude * if time < 0.5 { 1.0 - 4.0 * time } else { 4.0 * time - 3.0 };
        let central = |changed: &dyn Fn(f64) -> f64| (changed(step) - changed(-step)) / (2.0 * step);
        // At a turn, from within.
        let inside = place - sign * 2.0 * step * rig.amplitude * f64::from(rig.amplitude == sign * place);
        let slope = central(&|by| of(&rig, sign, inside + by * rig.amplitude)) / rig.amplitude;
        let derivatives = DVector::from_vec(vec![
            central(&|by| of(&Rig { friction: rig.friction * (1.0 + by), ..rig }, sign, place)),
            central(&|by| of(&Rig { stiffness: rig.stiffness * (1.0 + by), ..rig }, sign, place)),
            peak,
            slope * rig.amplitude,
            slope * rig.amplitude * time,
        ]);
        let noise = rig.noise * peak.hypot(slope * rig.amplitude);
        information += &derivatives * derivatives.transpose() / (noise * noise);
    }
    let covariance = information.try_inverse().unwrap();
    [0, 1].map(|k| covariance[(k, k)].sqrt())
}

/// The promise of the intervals: 94 and 100 of 100 in partial slip, 99 and 100 in gross slip when this was written.
///
/// The errors are within twice the least that there can be ([`least_scatter`]): 2.0 % for friction in partial slip, whose loop says little
/// of it. The median of a hundred errors is 0.67 of a standard deviation.
#[test]
#[ignore = "long: two hundred identifications"]
fn intervals_hold_the_truth_in_ninety_of_a_hundred_trials() {
    for rig in [PARTIAL, Rig { amplitude: 8e-3, ..PARTIAL }] {
        for (found, bound) in trials(rig, 100).iter().zip(least_scatter(rig)) {
            let held = found.iter().filter(|trial| trial[0] <= 1.0).count();
            let scatter = median(found, 1) / 0.6745;
            println!("{held} held, {scatter:.4} of {bound:.4}");
            assert!(held >= 90, "{held}");
            assert!(scatter <= 2.0 * bound, "{scatter} {bound}");
        }
    }
}

#[test]
fn a_loop_that_sticks_tells_the_rig_alone() {
    let sticking = Rig { friction: 3.0, amplitude: 1.5e-3, ..PARTIAL };
    for seed in 1..=8 {
        let found = identified(&sticking.log(seed), &Request::default());
        assert!(!found.constants[0].told, "{seed}: {:?}", found.constants);
        let [stiffness, ..] = constant(&found, 1);
        assert!((stiffness / 3e4 - 1.0).abs() < 0.05, "{seed}: {stiffness}");
        assert!(found.notes.concat().contains("sticks"), "{seed}: {:?}", found.notes);
    }
}

/// Semicolons, decimal commas, lines above the head, a line of units, cycles by number, and a drift from cycle to cycle.
#[test]
fn an_export_of_a_rig_is_identified() {
    let mut random = Pcg64Mcg::new(7);
    let mut log = String::from("Versuch 12;Kugel auf Kugel\nDatum;03.04.2025\n\nZyklus;Weg;Kraft\n;µm;N\n");
    for cycle in 1..=5 {
        for [d, q] in (Rig { amplitude: 8e-3, ..PARTIAL }).rows(&mut random) {
            let line = format!("{cycle};{:.4};{q:.4}", 1e3 * d + 0.2 * f64::from(cycle));
            log += &(line.replace('.', ",") + "\n");
        }
    }
    let columns = [("displacement", "Weg"), ("force", "Kraft"), ("cycle", "Zyklus")];
    let columns = columns.map(|(role, name)| (role.to_owned(), name.to_owned())).to_vec();
    let found =
        identified(&log, &Request { asked: Asked { columns, ..Asked::default() }, ..Request::default() });
    assert_eq!(found.cycles.len(), 5);
    assert_eq!(found.fitted_cycle().measured.name, 5.0);
    assert!((constant(&found, 0)[0] / 0.6 - 1.0).abs() < 0.01);
    assert!((constant(&found, 1)[0] / 3e4 - 1.0).abs() < 0.03);
    assert!((found.removed.drift_per_cycle.unwrap() / 0.2e-3 - 1.0).abs() < 0.3);
}

/// A case names the columns of its machine's logs; what is asked for goes before.
#[test]
fn the_case_names_the_columns_of_the_log() {
    let names = "nr,hub [um],reibkraft [N],kraft [N]\n";
    let rows = (Rig { noise: 0.0, drift: 0.0, ..PARTIAL }).log(1);
    let log: String = rows.lines().skip(1).fold(names.to_owned(), |text, row| text + "7," + row + ",1.0\n");
    let in_case = |columns: &str| {
        let text = format!("{CASE}[rig]\ntangential_stiffness = 3e4\ncolumns = {{ {columns} }}\n");
        Case::from_toml(&text, "case.toml")
    };
    let good = "displacement = \"hub\", force = \"reibkraft\", cycle = \"nr\"";
    let found = |case: Case, columns: &[(&str, &str)]| {
        let columns = columns.iter().map(|(what, name)| ((*what).to_owned(), (*name).to_owned())).collect();
        identify(&log, case, &Request { asked: Asked { columns, ..Asked::default() }, ..Request::default() })
            .map(|found| (found.fitted_cycle().measured.name, constant(&found, 0)))
            .map_err(|error| error.to_string())
    };
    let (cycle, friction) = found(in_case(good).unwrap(), &[]).unwrap();
    assert_eq!(cycle, 7.0);
    assert!((friction[0] / 0.6 - 1.0).abs() < 0.01, "{friction:?}");
    let wrong = "displacement = \"hub\", force = \"last\"";
    assert_eq!(
        found(in_case(wrong).unwrap(), &[("force", "reibkraft"), ("cycle", "nr")]).unwrap(),
        (cycle, friction)
    );
    let refused = found(in_case(wrong).unwrap(), &[]).unwrap_err();
    assert!(refused.contains("no line names the columns \"hub\" and \"last\""), "{refused}");
    let nothing = in_case("force = \" \"").unwrap_err().to_string();
    assert!(nothing.contains("rig.columns.force: must be the name of a column"), "{nothing}");
}

/// What a person in a laboratory is told.
#[test]
fn logs_that_cannot_be_are_refused_in_words() {
    let rig = Rig { noise: 0.001, ..PARTIAL };
    let rows: Vec<String> = rig.log(3).lines().skip(1).map(str::to_owned).collect();
    let of = |rows: &[String], head: &str| format!("{head}\n{}\n", rows.join("\n"));
    let head = "displacement [um],force [N]";
    for (log, words) in [
        (of(&rows[..60], head), "does not close"),
        (of(&[&rows[..20], &rows[70..]].concat(), head), "between lines 21 and 22: points are missing there"),
        (of(&rows, "displacement [um],force [kN]"), "is the unit of the force right?"),
        (of(&rows, "displacement [mm],force [N]"), "is the unit of the displacement right?"),
        (of(&rows, "displacement [nm],force [N]"), "is the unit of the displacement right?"),
        (of(&rows[..1], head), "1 row of numbers"),
    ] {
        let found = refusal(&log, &Request::default());
        assert!(found.contains(words), "{found}: expected {words}");
    }
}
