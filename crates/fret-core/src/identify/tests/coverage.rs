//! Whether 95 % intervals hold the truth where the noise is not independent and equal in both signals, or the drift is not straight.

use std::f64::consts::{PI, TAU};
use std::fmt::Write;

use rand_pcg::Pcg64Mcg;
use rayon::prelude::{IntoParallelIterator, ParallelIterator};

use super::{PARTIAL, Request, Rig, constant, identified, normal};

/// A log beyond the assumption of independent errors about a straight drift.
#[derive(Clone, Copy)]
struct Trial {
    name: &'static str,
    /// Standard deviations over the amplitudes, of displacement and force.
    noises: [f64; 2],
    /// Correlation of the noise from point to point.
    correlation: f64,
    /// Curved drift over the amplitude: half a sine over the log.
    curved: f64,
    /// Cycles of the log.
    cycles: usize,
}

const PLAIN: Trial =
    Trial { name: "independent", noises: [0.01; 2], correlation: 0.0, curved: 0.0, cycles: 1 };

const TRIALS: [Trial; 7] = [
    PLAIN,
    Trial { name: "displacement alone", noises: [0.02, 0.0], ..PLAIN },
    Trial { name: "force alone", noises: [0.0, 0.02], ..PLAIN },
    Trial { name: "correlated", correlation: 0.8, ..PLAIN },
    Trial { name: "curved drift, one cycle", curved: 0.02, ..PLAIN },
    Trial { name: "independent, three cycles", cycles: 3, ..PLAIN },
    Trial { name: "curved drift, three cycles", curved: 0.06, cycles: 3, ..PLAIN },
];

impl Trial {
    fn log(self, rig: Rig, is_sine: bool, seed: u64) -> String {
        let mut random = Pcg64Mcg::new(u128::from(seed) * 2 + 0x0f1e_2d3c_4b5a_6979);
        let count = rig.points * self.cycles;
        let mut noise = || -> Vec<f64> {
            let fresh = (1.0 - self.correlation * self.correlation).sqrt();
            let mut value = normal(&mut random);
            (0..count)
                .map(|_| {
                    value = self.correlation * value + fresh * normal(&mut random);
                    value
                })
                .collect()
        };
        let noises = [noise(), noise()];
        let peak = rig.force_at(rig.amplitude);
        let mut text = "cycle,displacement [um],force [N]\n".to_owned();
        for k in 0..count {
            let time = (k % rig.points) as f64 / rig.points as f64;
            let triangle = if time < 0.5 { 1.0 - 4.0 * time } else { 4.0 * time - 3.0 };
            let place = rig.amplitude * if is_sine { (TAU * time).cos() } else { triangle };
            let sign = if time < 0.5 { 1.0 } else { -1.0 };
            let force = sign * (peak - 2.0 * rig.force_at(0.5 * (rig.amplitude - sign * place).max(0.0)));
            let over = k as f64 / count as f64;
            let drift = rig.drift * k as f64 / rig.points as f64 + self.curved * (PI * over).sin();
            let along = place + rig.amplitude * (0.3 + drift + self.noises[0] * noises[0][k]);
            let across = force + peak * (0.05 + self.noises[1] * noises[1][k]);
            let _ = writeln!(text, "{},{:.6},{across:.6}", 1 + k / rig.points, along * 1e3);
        }
        text
    }

    /// In how many logs the intervals hold friction and stiffness; median half-widths, relative.
    fn held(self, rig: Rig, count: u64) -> [(usize, f64); 2] {
        let all: Vec<[[f64; 2]; 2]> = (0..count)
            .into_par_iter()
            .map(|seed| {
                let found = identified(
                    &self.log(rig, seed % 2 == 1, seed),
                    &Request { cycle: Some(self.cycles.min(2) as f64), ..Request::default() },
                );
                [(0, rig.friction), (1, rig.stiffness)].map(|(place, truth)| {
                    let [value, _, high] = constant(&found, place);
                    [(value / truth).ln().abs() / (high / value).ln(), (high / value).ln()]
                })
            })
            .collect();
        [0, 1].map(|k| {
            let mut halves: Vec<f64> = all.iter().map(|trial| trial[k][1]).collect();
            halves.sort_by(f64::total_cmp);
            (all.iter().filter(|trial| trial[k][0] <= 1.0).count(), halves[halves.len() / 2])
        })
    }
}

const SLIPS: [Rig; 2] = [PARTIAL, Rig { amplitude: 8e-3, ..PARTIAL }];

/// A few of each: what was wrong by far (half of the logs not held) is seen.
#[test]
fn intervals_hold_beyond_independent_noise() {
    for trial in [TRIALS[1], TRIALS[3]] {
        for rig in SLIPS {
            for (held, _) in trial.held(rig, 6) {
                assert!(held >= 5, "{}: {held} of 6", trial.name);
            }
        }
    }
}

/// The promise of the page, and its table: 317 of 336 for friction, 329 for the stiffness when it was written. 24 logs each, of triangles and
/// sines; 95 % of 24 are 23, and fewer than 20 happen once in a hundred.
#[test]
#[ignore = "long: three hundred identifications"]
fn intervals_hold_in_nine_of_ten_trials_beyond_independent_noise() {
    let mut missed = Vec::new();
    for trial in TRIALS {
        for (rig, slip) in SLIPS.into_iter().zip(["partial", "gross"]) {
            let [friction, stiffness] = trial.held(rig, 24);
            println!(
                "{:<28} {slip:<8} mu {:2} of 24 (half-width {:.2} %)   S {:2} of 24 (half-width {:.2} %)",
                trial.name,
                friction.0,
                100.0 * friction.1,
                stiffness.0,
                100.0 * stiffness.1
            );
            if friction.0 < 20 || stiffness.0 < 20 {
                missed.push(trial.name);
            }
        }
    }
    assert!(missed.is_empty(), "{missed:?}");
}
