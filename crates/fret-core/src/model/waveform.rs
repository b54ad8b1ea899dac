//! The waves of a cycle's controls, and when in the cycle its increments end.

use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};

/// Shape of a cycle: 0, +1, -1, 0 at the fractions 0, 1/4, 3/4, 1 of its length.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Waveform {
    /// Straight lines.
    Triangle,
    /// A sine.
    Sine,
    /// Straight lines with both extremes held for this fraction of the cycle.
    Trapezoid {
        /// Fraction of the cycle, below a half.
        dwell: f64,
    },
}

/// Increments that any cycle needs, at the least.
const FEWEST: usize = 4;
/// Two times are one when they differ by less, as a fraction of the cycle.
const SAME: f64 = 1e-9;

impl Waveform {
    /// Corners of a cycle: its reversal points, ends of a hold, zero crossings of a sine. Fraction of the cycle, and value.
    fn corners(self) -> Vec<(f64, f64)> {
        match self {
            Self::Triangle => vec![(0.25, 1.0), (0.75, -1.0)],
            Self::Sine => vec![(0.0, 0.0), (0.25, 1.0), (0.5, 0.0), (0.75, -1.0)],
            Self::Trapezoid { dwell } => {
                let half = 0.5 * dwell;
                vec![(0.25 - half, 1.0), (0.25 + half, 1.0), (0.75 - half, -1.0), (0.75 + half, -1.0)]
            }
        }
    }

    /// Times inside the cycle, in its fractions, at which waves that are ahead by these `phases` reverse, hold or go on; where `zeros`
    /// is set those at which a sine is zero, too.
    fn times(self, phases: &[f64], zeros: bool) -> Vec<f64> {
        let corners = self.corners();
        let wanted = corners.iter().filter(|(_, value)| zeros || *value != 0.0);
        let mut times: Vec<f64> = wanted
            .flat_map(|(share, _)| {
                phases.iter().map(move |phase| (share - within_a_cycle(*phase)).rem_euclid(1.0))
            })
            .filter(|time| (SAME..=1.0 - SAME).contains(time))
            .collect();
        times.sort_by(f64::total_cmp);
        times.dedup_by(|later, earlier| *later - *earlier < SAME);
        times
    }

    /// Fewest increments of a cycle that meet all reversal points of waves that are ahead by these `phases` (fractions of a cycle).
    pub fn fewest_increments(self, phases: &[f64]) -> usize {
        FEWEST.max(self.times(phases, false).len() + 1)
    }
}

/// When in its cycle each increment ends. Increments are equally long as far as the reversal points of all waves lie at ends of
/// increments. Others are met by the increment nearest to them, and what lies between two of them is divided evenly: every
/// load is one that the waves go through, all at the same time, and no extreme is missed.
#[derive(Debug, Clone, PartialEq)]
pub struct CycleTimes {
    waveform: Waveform,
    increments: usize,
    /// Ends of increments with their times, first and last those of the cycle.
    fixed: Vec<(f64, f64)>,
}

impl CycleTimes {
    /// Of waves that are ahead by these `phases` (fractions of a cycle). Where the increments are too few for the reversal points,
    /// see [`Waveform::fewest_increments`], they are equally long.
    pub fn new(waveform: Waveform, phases: &[f64], increments: usize) -> Self {
        let all = waveform.times(phases, true);
        // The zeros of a sine are met where that takes no increment beyond those that any cycle has.
        let mut times = if all.len() < FEWEST { all } else { waveform.times(phases, false) };
        if times.len() >= increments {
            times.clear();
        }
        let n = increments as f64;
        // Rounded alike from both ends of the cycle, so that a wave through zero stays one.
        let place = |time: &f64| if *time > 0.5 { n - nearest((1.0 - time) * n) } else { nearest(time * n) };
        let mut places: Vec<f64> = times.iter().map(place).collect();
        let mut free = 1.0;
        for place in &mut places {
            *place = place.max(free);
            free = *place + 1.0;
        }
        let mut free = n - 1.0;
        for place in places.iter_mut().rev() {
            *place = place.min(free);
            free = *place - 1.0;
        }
        let inner = places.into_iter().zip(times);
        let fixed = std::iter::once((0.0, 0.0)).chain(inner).chain(std::iter::once((n, 1.0))).collect();
        Self { waveform, increments, fixed }
    }

    /// Time of the end of increment `k`, counted from 0 at the start of the cycle, as a fraction of the cycle.
    pub fn at(&self, k: usize) -> f64 {
        let k = (k % self.increments) as f64;
        let after = self.fixed.partition_point(|(place, _)| *place <= k).clamp(1, self.fixed.len() - 1);
        let (from, to) = (self.fixed[after - 1], self.fixed[after]);
        from.1 + (to.1 - from.1) * (k - from.0) / (to.0 - from.0)
    }

    /// Whether all increments are equally long.
    pub fn are_even(&self) -> bool {
        self.are_straight((0.0, 0.0), (self.increments as f64, 1.0))
    }

    /// Height of the wave that is ahead by `phase`, after increment `k`.
    pub fn height(&self, phase: f64, k: usize) -> f64 {
        let time = self.at(k);
        let k = (k % self.increments) as f64;
        let phase = within_a_cycle(phase);
        // The corners one cycle before and two after: those on both sides of k are among them. Increment, share, value.
        let mut before = (f64::NEG_INFINITY, 0.0, 0.0);
        let mut after = (f64::INFINITY, 0.0, 0.0);
        for turn in -2..=2 {
            for (share, value) in self.waveform.corners() {
                let share = share + f64::from(turn);
                let place = self.place(share - phase);
                if place <= k && place >= before.0 {
                    before = (place, share, value);
                }
                if place > k && place < after.0 {
                    after = (place, share, value);
                }
            }
        }
        if before.0 == k {
            return before.2;
        }
        let ends = [before, after].map(|(place, share, _)| (place, share - phase));
        // By the number of the increment where increments are equally long from corner to corner, otherwise by their times.
        let (from, to, now) = if self.are_straight(ends[0], ends[1]) {
            (before.0, after.0, k)
        } else {
            (ends[0].1, ends[1].1, time)
        };
        let done = (now - from) / (to - from);
        match self.waveform {
            Waveform::Sine => (TAU * (before.1 + (after.1 - before.1) * done)).sin(),
            // A line through zero is taken from there, so that a cycle ends exactly where it began.
            _ if before.2 == -after.2 => before.2 * (to + from - 2.0 * now) / (to - from),
            _ => before.2 + (after.2 - before.2) * done,
        }
    }

    /// Where in the increments a time lies, of this cycle or of others.
    fn place(&self, time: f64) -> f64 {
        let n = self.increments as f64;
        let cycle = (time + SAME).floor();
        let time = time - cycle;
        let cycle = cycle * n;
        if let Some((place, _)) = self.fixed.iter().find(|(_, fixed)| (fixed - time).abs() < SAME) {
            return place + cycle;
        }
        let after = self.fixed.partition_point(|(_, fixed)| *fixed <= time).clamp(1, self.fixed.len() - 1);
        let (from, to) = (self.fixed[after - 1], self.fixed[after]);
        let place = from.0 + (to.0 - from.0) * (time - from.1) / (to.1 - from.1);
        let whole = place.round();
        (if (place - whole).abs() < SAME * n { whole } else { place }) + cycle
    }

    /// Whether increments are equally long between two places with their times.
    fn are_straight(&self, (from, start): (f64, f64), (to, end): (f64, f64)) -> bool {
        let n = self.increments as f64;
        (-2..=2).all(|turn| {
            let turn = f64::from(turn);
            self.fixed.iter().map(|(place, time)| (place + turn * n, time + turn)).all(|(place, time)| {
                let inside = place > from && place < to;
                !inside || ((place - from) * (end - start) - (time - start) * (to - from)).abs() < SAME * n
            })
        })
    }
}

/// A phase without the whole cycles in it.
fn within_a_cycle(phase: f64) -> f64 {
    if phase.abs() > 1.0 { phase % 1.0 } else { phase }
}

/// The nearest whole number; halves go to the even one, also when rounding has moved them a little.
fn nearest(place: f64) -> f64 {
    const FINE: f64 = (1_u64 << 20) as f64;
    ((place * FINE).round() / FINE).round_ties_even()
}

#[cfg(test)]
mod tests;
