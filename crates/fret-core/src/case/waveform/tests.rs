use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, TAU};

use super::{CycleTimes, Waveform};

const WAVES: [Waveform; 4] = [
    Waveform::Triangle,
    Waveform::Sine,
    Waveform::Trapezoid { dwell: 0.2 },
    Waveform::Trapezoid { dwell: 0.3 },
];

/// Heights of a wave alone after increments 0, 1, ...
fn heights(wave: Waveform, increments: usize, phase: f64) -> Vec<f64> {
    let times = CycleTimes::new(wave, &[phase], increments);
    (0..=increments).map(|k| times.height(phase, k)).collect()
}

/// A wave at a time, by inverse and direct functions of its own: no corners, no increments.
fn exact(wave: Waveform, time: f64) -> f64 {
    let sine = (TAU * time).sin();
    let triangle = sine.asin() / FRAC_PI_2;
    match wave {
        Waveform::Sine => sine,
        Waveform::Triangle => triangle,
        Waveform::Trapezoid { dwell } => (triangle / (1.0 - 2.0 * dwell)).clamp(-1.0, 1.0),
    }
}

#[test]
fn a_wave_meets_its_reversal_points_for_any_number_of_increments_and_any_phase() {
    for wave in WAVES {
        for phase in [0.0, 0.25, 0.1, -0.4, 0.75, 1.0 / 12.0, 0.25 - 1e-4, 0.25 + 1e-4, 1e-12, -1e-12, 3.1] {
            for increments in wave.fewest_increments(&[phase])..40 {
                let values = heights(wave, increments, phase);
                assert!(
                    values.contains(&1.0) && values.contains(&-1.0),
                    "{wave:?} {increments} {phase}: {values:?}"
                );
                assert!(values.iter().all(|value| value.abs() <= 1.0));
                assert_eq!(values[0], values[increments]);
                // The inverse sine loses half of the digits at the extremes.
                assert!(
                    (values[0] - exact(wave, phase)).abs() < 1e-7,
                    "{wave:?} {increments} {phase}: {values:?}"
                );
            }
        }
    }
}

#[test]
fn waves_of_other_phases_are_seen_at_the_same_times() {
    let phases = [0.0, 1.0 / 12.0, -0.2, 0.61];
    for wave in WAVES {
        for increments in [wave.fewest_increments(&phases), 20, 23, 32, 60] {
            let times = CycleTimes::new(wave, &phases, increments);
            let mut before = -1.0;
            for k in 0..increments {
                let time = times.at(k);
                assert!(time > before && (0.0..1.0).contains(&time), "{wave:?} {increments} {k}: {time}");
                before = time;
                for phase in phases {
                    let found = times.height(phase, k);
                    assert!(
                        (found - exact(wave, time + phase)).abs() < 1e-7,
                        "{wave:?} {increments} {k} {phase}: {found}"
                    );
                }
            }
            // Moved to the nearest increment, or by as many increments as lie together: never far from equal.
            let off = (0..increments)
                .map(|k| (times.at(k) * increments as f64 - k as f64).abs())
                .fold(0.0, f64::max);
            if increments == 60 {
                assert!(off <= 2.0, "{wave:?}: {off}");
            }
            for phase in phases {
                let values: Vec<f64> = (0..increments).map(|k| times.height(phase, k)).collect();
                assert!(values.contains(&1.0) && values.contains(&-1.0), "{wave:?} {increments} {phase}");
            }
        }
    }
}

#[test]
fn a_trapezoid_holds_its_extremes_for_its_dwell() {
    for (dwell, increments) in [(0.1, 16), (0.3, 16), (0.3, 5), (0.25, 5), (0.02, 8), (0.499, 7)] {
        let wave = Waveform::Trapezoid { dwell };
        let times = CycleTimes::new(wave, &[0.0], increments);
        for extreme in [1.0, -1.0] {
            let held: Vec<f64> =
                (0..increments).filter(|&k| times.height(0.0, k) == extreme).map(|k| times.at(k)).collect();
            let lasts = held[held.len() - 1] - held[0];
            // Rounding of two times.
            assert!((lasts - dwell).abs() < 1e-15, "{dwell} {increments}: {held:?}");
        }
    }
}

#[test]
fn a_wave_without_phase_ends_at_zero() {
    for wave in WAVES {
        for increments in wave.fewest_increments(&[0.0])..40 {
            let values = heights(wave, increments, 0.0);
            assert_eq!((values[0], values[increments]), (0.0, 0.0), "{wave:?} {increments}");
        }
    }
}

#[test]
fn waves_are_what_their_names_say() {
    for phase in [0.0, 0.125, 0.25, -0.5] {
        for wave in [Waveform::Sine, Waveform::Triangle, Waveform::Trapezoid { dwell: 0.25 }] {
            let times = CycleTimes::new(wave, &[phase], 48);
            assert!(times.are_even());
            for k in 0..48 {
                let share = k as f64 / 48.0;
                // Rounding of the sine's argument; the inverse sine loses half of the digits at the extremes.
                let tolerance = if wave == Waveform::Sine { 1e-14 } else { 1e-7 };
                assert!(
                    (times.height(phase, k) - exact(wave, share + phase)).abs() < tolerance,
                    "{wave:?} {k}"
                );
                assert!((times.at(k) - share).abs() < 1e-15);
            }
        }
    }
}

#[test]
fn a_cycle_needs_an_increment_for_each_reversal_point() {
    let fewest = |wave: Waveform, phases: &[f64]| wave.fewest_increments(phases);
    // Alone, at its ends; with another; with another a half cycle ahead, whose reversal points are the same.
    assert_eq!(fewest(Waveform::Triangle, &[]), 4);
    assert_eq!([0.0, 0.1].map(|phase| fewest(Waveform::Sine, &[phase])), [4, 4]);
    assert_eq!(fewest(Waveform::Sine, &[0.0, 0.25]), 4);
    assert_eq!(fewest(Waveform::Sine, &[0.0, 0.1]), 5);
    assert_eq!(fewest(Waveform::Sine, &[0.0, 0.1, 0.5, 0.6]), 5);
    assert_eq!([0.2, 0.25].map(|dwell| fewest(Waveform::Trapezoid { dwell }, &[0.0])), [5, 5]);
    // Ahead by a quarter less half of its dwell it starts at the beginning of a hold.
    assert_eq!(fewest(Waveform::Trapezoid { dwell: 0.2 }, &[0.15]), 4);
    assert_eq!(fewest(Waveform::Trapezoid { dwell: 0.2 }, &[0.0, 0.05]), 9);
}

#[test]
fn increments_that_are_too_few_are_equally_long() {
    let times = CycleTimes::new(Waveform::Sine, &[0.0, 0.1], 4);
    assert!(times.are_even());
    assert_eq!((0..4).map(|k| times.at(k)).collect::<Vec<_>>(), [0.0, 0.25, 0.5, 0.75]);
}

#[test]
fn reversal_points_halfway_between_increments_are_met_at_the_even_one() {
    // a quarter of six increments is 1.5, three quarters 4.5
    assert_eq!(heights(Waveform::Triangle, 6, 0.0), [0.0, 0.5, 1.0, 0.0, -1.0, -0.5, 0.0]);
    // a sine between its turns at 0, 2, 3, 4 and 6
    let half = FRAC_PI_4.sin();
    let values = heights(Waveform::Sine, 6, 0.0);
    assert!((values[1] - half).abs() < 1e-15 && (values[5] + half).abs() < 1e-15, "{values:?}");
    assert_eq!(values[3], 0.0);
    // phases that rounding has moved off a half: 1.5 +- 1e-9 increments are 1.5
    for small in [1e-10, -1e-10] {
        assert_eq!(heights(Waveform::Triangle, 6, small)[2], 1.0);
    }
}
