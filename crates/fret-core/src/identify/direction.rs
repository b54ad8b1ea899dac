//! Which way the loops of a log run. A contact dissipates: force by displacement encloses positive work, and the force grows with the
//! displacement. A force of the other body, or a displacement of the other sense, turns both; rows from the last to the first turn the work.

use super::cycles::{Fault, MeasuredCycle};
use super::turns::turns;

/// Work counts where it is this many times what noise encloses.
const SURE: f64 = 4.0;

/// What has to be turned for the loops to run forwards.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Direction {
    /// The sign of the force.
    pub turned: bool,
    /// The order of the rows.
    pub backwards: bool,
}

/// Enclosed work over that of noise, and by how much the force grows with the displacement (their correlation).
fn work_and_growth(cycle: &MeasuredCycle) -> [f64; 2] {
    let (along, force) = (&cycle.displacement, &cycle.force);
    let count = force.len();
    let mean = |values: &[f64]| values.iter().sum::<f64>() / count as f64;
    let (middle, level) = (mean(along), mean(force));
    let mut work = 0.0;
    let (mut both, mut lengths, mut forces) = (0.0, 0.0, 0.0);
    for row in 0..count {
        let (before, after) = ((row + count - 1) % count, (row + 1) % count);
        work += (force[row] - level) * 0.5 * (along[after] - along[before]);
        both += (along[row] - middle) * (force[row] - level);
        lengths += (along[row] - middle).powi(2);
        forces += (force[row] - level).powi(2);
    }
    let rounding = 1e-9 * (lengths * forces).sqrt();
    [work / cycle.unsure_work(0.0).max(rounding), both / (lengths * forces).sqrt()]
}

/// The direction of the loops, by all whole cycles together.
pub fn of(cycles: &[MeasuredCycle]) -> Direction {
    let (mut works, mut growths) = (0.0, 0.0);
    for cycle in cycles.iter().filter(|cycle| cycle.fault.is_none()) {
        let [work, growth] = work_and_growth(cycle);
        works += if work.abs() > SURE { work.signum() } else { 0.0 };
        growths += growth;
    }
    let turned = growths < 0.0;
    Direction { turned, backwards: if turned { works > 0.0 } else { works < 0.0 } }
}

impl Direction {
    /// What is wrong, for a person.
    pub fn in_words(self) -> Option<String> {
        let turned = "force and displacement have opposite signs: the force is that on the other body, or one of the two is counted the other way";
        let backwards = "the loops run backwards (the force would do negative work): the rows go from the last to the first";
        match (self.turned, self.backwards) {
            (false, false) => None,
            (true, false) => Some(format!("the loops enclose negative work, and {turned}")),
            (false, true) => Some(backwards.to_owned()),
            (true, true) => Some(format!("{turned}; besides, {backwards}")),
        }
    }

    /// What was done about it, and when that is wrong.
    pub fn note(self) -> Option<String> {
        let done = match (self.turned, self.backwards) {
            (false, false) => return None,
            (true, false) => "the sign of the force was turned",
            (false, true) => {
                "they were read from the last to the first; if they are in the order of time, one of the two signals lags behind the other, and this log tells neither friction nor rig"
            }
            (true, true) => {
                "the sign of the force was turned, and the rows were read from the last to the first"
            }
        };
        Some(format!("{}: {done}", self.in_words()?))
    }

    /// Turns all cycles; a cycle that then encloses negative work is skipped.
    pub fn apply(self, cycles: &mut [MeasuredCycle]) {
        for cycle in cycles.iter_mut() {
            if self.turned {
                cycle.force.iter_mut().for_each(|force| *force = -*force);
            }
            if self.backwards {
                cycle.force.reverse();
                cycle.displacement.reverse();
            }
            if cycle.fault.is_some() {
                continue;
            }
            if self.backwards {
                cycle.turns = turns(&cycle.displacement);
            }
            if work_and_growth(cycle)[0] < -SURE {
                let what = format!(
                    "cycle {} (lines {} to {}) encloses negative work, other than the rest of the log",
                    cycle.name, cycle.lines[0], cycle.lines[1]
                );
                let help = "fit another cycle: --cycle N".to_owned();
                cycle.fault = Some(Fault { brief: "encloses negative work".to_owned(), what, help });
            }
        }
    }
}
