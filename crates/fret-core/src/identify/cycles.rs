//! Cycles of a log: where each begins and ends, which of them are whole, and why the others are skipped.

use super::error::{IdentifyError, refused};
use super::log::{CYCLE, DISPLACEMENT, FORCE, NORMAL_FORCE};
use super::turns::{falls, range, rising_crossings, tops, turns};
use crate::measured::Table;

/// Points of a cycle, at the least.
const FEWEST: usize = 12;
/// Neighbouring points further apart than this fraction of the range of displacement have points missing between them.
const GAP: f64 = 0.3;
/// A cycle whose force ends further from where it began than this fraction of its range is not closed.
const OPEN: f64 = 0.25;
/// Cycles that are named in a message, at the most.
const MOST_NAMED: usize = 10;

/// One measured cycle, in the units of the case.
#[derive(Debug, Clone)]
pub struct MeasuredCycle {
    /// Its number in the log.
    pub name: f64,
    /// Displacement of the actuator, in the order of time [length].
    pub displacement: Vec<f64>,
    /// Tangential force [force].
    pub force: Vec<f64>,
    /// Mean normal force, where it was measured: positive [force].
    pub normal_force: Option<f64>,
    /// First and last line in the file.
    pub lines: [usize; 2],
    /// Rows, with fractions, at which the displacement is largest and smallest; nothing where there are too few points.
    pub(super) turns: [f64; 2],
    /// Why it is skipped.
    pub fault: Option<Fault>,
}

/// Why a cycle is no whole loop.
#[derive(Debug, Clone)]
pub struct Fault {
    /// In a few words.
    pub brief: String,
    /// In a sentence, with its place.
    pub what: String,
    /// What to do about it.
    pub help: String,
}

/// The cycles of a log: by its column, or from one turn of the displacement to the next of its kind.
pub fn split(table: &Table, scale: &[f64]) -> Vec<MeasuredCycle> {
    let of = |role: usize| -> Vec<f64> { table.of(role).iter().map(|value| value * scale[role]).collect() };
    let (displacement, forces) = (of(DISPLACEMENT), of(FORCE));
    let cycle = |(name, from, to): (f64, usize, usize)| {
        let normal_force = table.columns[NORMAL_FORCE].as_ref().map(|column| {
            (scale[NORMAL_FORCE] * column.values[from..to].iter().sum::<f64>() / (to - from) as f64).abs()
        });
        let mut cycle = MeasuredCycle {
            name,
            turns: [0.0; 2],
            displacement: displacement[from..to].to_vec(),
            force: forces[from..to].to_vec(),
            normal_force,
            lines: [table.lines[from], table.lines[to - 1]],
            fault: None,
        };
        if to - from >= FEWEST {
            cycle.turns = turns(&cycle.displacement);
        }
        cycle.fault = cycle.fault_of(&table.lines[from..to]);
        cycle
    };
    let mut cycles: Vec<MeasuredCycle> = if table.columns[CYCLE].is_some() {
        let numbers = table.of(CYCLE);
        let starts: Vec<usize> =
            (0..numbers.len()).filter(|&row| row == 0 || numbers[row] != numbers[row - 1]).collect();
        let ends = starts.iter().skip(1).copied().chain([numbers.len()]);
        starts.iter().zip(ends).map(|(&from, to)| cycle((numbers[from], from, to))).collect()
    } else {
        let between = |turns: &[usize]| -> Vec<MeasuredCycle> {
            turns.windows(2).enumerate().map(|(k, pair)| cycle(((k + 1) as f64, pair[0], pair[1]))).collect()
        };
        let highest = tops(&displacement);
        if highest.len() >= 3 {
            between(&highest)
        } else {
            // One cycle, and perhaps parts of others around it: a whole one lies between any two points of the same kind.
            let turned: Vec<f64> = displacement.iter().map(|value| -value).collect();
            let crossings = [&displacement, &turned].map(|values| rising_crossings(values));
            let is_one = crossings.iter().all(|found| found.len() < 2);
            let all = vec![cycle((1.0, 0, displacement.len()))];
            let [rising, falling] = &crossings;
            let parts = [&highest, &tops(&turned), rising, falling].map(|ends| between(ends));
            let whole =
                |cycles: &[MeasuredCycle]| cycles.iter().filter(|cycle| cycle.fault.is_none()).count();
            // The first of those with the most whole cycles.
            let most = parts.into_iter().rev().max_by_key(|cycles| (whole(cycles), !cycles.is_empty()));
            match most {
                Some(most) if !(is_one && whole(&all) == 1) && whole(&most) > 0 => most,
                Some(most) if !is_one && !most.is_empty() => most,
                _ => all,
            }
        }
    };
    name_ends(&mut cycles);
    cycles
}

/// A log is started and stopped by hand: its first and last cycle are cut off.
fn name_ends(cycles: &mut [MeasuredCycle]) {
    let last = cycles.len().saturating_sub(1);
    for (place, words) in [(0, "starts late"), (last, "ends early")] {
        if let (true, Some(fault)) = (last > 0, cycles.get_mut(place).and_then(|cycle| cycle.fault.as_mut()))
            && fault.brief == "does not close"
        {
            words.clone_into(&mut fault.brief);
        }
    }
}

/// The whole cycle of a number, or the last whole one, by its place.
///
/// # Errors
/// When it is not there, or is none.
pub fn choose(cycles: &[MeasuredCycle], number: Option<f64>, name: &str) -> Result<usize, IdentifyError> {
    let whole = |cycle: &MeasuredCycle| cycle.fault.is_none();
    let chosen = match number {
        None => cycles.iter().rposition(whole),
        Some(number) => cycles.iter().position(|cycle| cycle.name == number && whole(cycle)),
    };
    if let Some(chosen) = chosen {
        return Ok(chosen);
    }
    let asked = |cycle: &&MeasuredCycle| number.is_none_or(|number| cycle.name == number);
    let fault = cycles.iter().find(asked).and_then(|cycle| cycle.fault.as_ref());
    let others: Vec<f64> = cycles.iter().filter(|cycle| whole(cycle)).map(|cycle| cycle.name).collect();
    match (fault, number) {
        (Some(fault), Some(number)) if !others.is_empty() => {
            let near =
                others.iter().copied().min_by(|a, b| (a - number).abs().total_cmp(&(b - number).abs()));
            let help = format!("fit a whole cycle: --cycle {}", near.unwrap_or_default());
            Err(refused(name, &fault.what, &help))
        }
        (Some(fault), None) if cycles.len() > 1 => {
            let what = format!("none of its {} cycles is whole: {}", cycles.len(), skipped(cycles));
            Err(refused(name, &what, &fault.help))
        }
        (Some(fault), _) => Err(refused(name, &fault.what, &fault.help)),
        (None, _) => {
            let [first, last] =
                [cycles.first(), cycles.last()].map(|cycle| cycle.map_or(0.0, |cycle| cycle.name));
            Err(refused(
                name,
                &format!("there is no cycle {}", number.unwrap_or_default()),
                &format!("its cycles go from {first} to {last}"),
            ))
        }
    }
}

/// The cycles that are skipped, and why: `1234 (does not close), 5000 (ends early)`.
pub fn skipped<'a>(cycles: impl IntoIterator<Item = &'a MeasuredCycle>) -> String {
    let all: Vec<String> = cycles
        .into_iter()
        .filter_map(|cycle| Some(format!("{} ({})", cycle.name, cycle.fault.as_ref()?.brief)))
        .collect();
    let named = all.iter().take(MOST_NAMED).cloned().collect::<Vec<_>>().join(", ");
    if all.len() > MOST_NAMED { format!("{named}, and {} more", all.len() - MOST_NAMED) } else { named }
}

impl MeasuredCycle {
    /// Why it is no whole loop; `lines` are those of its rows.
    fn fault_of(&self, lines: &[usize]) -> Option<Fault> {
        let place = format!("cycle {} (lines {} to {})", self.name, self.lines[0], self.lines[1]);
        let fault = |brief: &str, what: String, help: &str| {
            Some(Fault { brief: brief.to_owned(), what, help: help.to_owned() })
        };
        let count = self.force.len();
        if count < FEWEST {
            let points = if count == 1 { "1 point".to_owned() } else { format!("{count} points") };
            return fault(
                &points,
                format!("{place} has {points}; a loop needs at least {FEWEST}"),
                "is this the column of cycles? choose it with --columns, or leave it out",
            );
        }
        let [low, high] = range(&self.displacement);
        for row in 1..count {
            let jump = (self.displacement[row] - self.displacement[row - 1]).abs();
            if jump > GAP * (high - low) {
                let between = format!("between lines {} and {}", lines[row - 1], lines[row]);
                return fault(
                    &format!("points are missing {between}"),
                    format!(
                        "the displacement jumps by {:.0} % of its range {between}: points are missing there",
                        100.0 * jump / (high - low)
                    ),
                    "a loop needs points all around it: measure it again, with a hundred points a cycle",
                );
            }
        }
        let [bottom, top] = range(&self.force);
        let ends = 3.min(count);
        let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
        // Where a branch begins steeply, the first points differ from the last by as much as from each other.
        let steepest = |values: &[f64]| {
            let steps = |part: &[f64]| range(part)[1] - range(part)[0];
            steps(&values[..ends]).max(steps(&values[count - ends..]))
        };
        let open = (mean(&self.force[count - ends..]) - mean(&self.force[..ends])).abs();
        let apart = (mean(&self.displacement[count - ends..]) - mean(&self.displacement[..ends])).abs();
        if !(open <= OPEN * (top - bottom) + steepest(&self.force) && apart <= OPEN * (high - low)) {
            return fault(
                "does not close",
                format!(
                    "{place} does not close: it ends {:.0} % of the range of force and {:.0} % of that of displacement from where it began",
                    100.0 * open / (top - bottom),
                    100.0 * apart / (high - low)
                ),
                "a cycle begins and ends at one point of the loop; leave out the first loading from zero, and half cycles",
            );
        }
        let [first, last] = self.turns;
        let between = (first - last).abs();
        if !(between >= 3.0 && count as f64 - between >= 3.0) || high == low || top == bottom {
            return fault(
                "does not go there and back",
                format!("{place}: the displacement does not go there and back"),
                "is this the displacement? choose the column with --columns",
            );
        }
        None
    }

    /// Whether a point lies on the way down, from the largest displacement to the smallest.
    pub(super) fn is_falling(&self, row: usize) -> bool {
        falls(row as f64, self.turns)
    }
}
