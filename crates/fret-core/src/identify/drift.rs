//! The drift of the displacement: from cycle to cycle, and how it bends within one.

use super::cycles::MeasuredCycle;
use super::turns::{at_turn, noise, range, slope};

/// Cycles beside each other from which the bend of the drift is read, at the least and at the most.
const NEIGHBOURS: [usize; 2] = [3, 5];

/// By how much the middle of the displacement wanders from cycle to cycle [length]; `None` of a single one.
pub fn per_cycle(cycles: &[MeasuredCycle]) -> Option<f64> {
    let middles: Vec<[f64; 2]> = cycles
        .iter()
        .enumerate()
        .filter(|(_, cycle)| cycle.fault.is_none())
        .map(|(k, cycle)| {
            let [low, high] = range(&cycle.displacement);
            [k as f64, f64::midpoint(low, high)]
        })
        .collect();
    (middles.len() > 1).then(|| {
        let step = || (middles[1][1] - middles[0][1]) / (middles[1][0] - middles[0][0]);
        slope(&middles).unwrap_or_else(step)
    })
}

/// How the drift bends: `bend (4 t^2 - 1/3)`, `t` from -1/2 to 1/2 over the cycle.
#[derive(Debug, Clone, Copy)]
pub struct Bend {
    /// From its lowest to its highest value [length].
    pub value: f64,
    /// Standard deviation [length].
    pub unsure: f64,
}

/// The bend of the drift in a cycle, by the middles of its whole neighbours: a parabola of least squares. `None` without two of them.
pub fn bend(cycles: &[MeasuredCycle], chosen: usize) -> Option<Bend> {
    let joins = |a: usize, b: usize| {
        cycles[b].fault.is_none() && ((cycles[a].name - cycles[b].name).abs() - 1.0).abs() < 1e-9
    };
    let (mut first, mut last) = (chosen, chosen);
    while last - first + 1 < NEIGHBOURS[1] {
        let before = first > 0 && joins(first, first - 1);
        let after = last + 1 < cycles.len() && joins(last, last + 1);
        match (before, after) {
            (false, false) => break,
            (true, true) if chosen - first > last - chosen => last += 1,
            (true, _) => first -= 1,
            (false, true) => last += 1,
        }
    }
    let count = last - first + 1;
    if count < NEIGHBOURS[0] {
        return None;
    }
    let near = &cycles[first..=last];
    let middles: Vec<f64> = near
        .iter()
        .map(|cycle| {
            0.5 * cycle.turns.iter().map(|&turn| at_turn(&cycle.displacement, turn, [-1, 1])).sum::<f64>()
        })
        .collect();
    // The parabola of equally spaced points: its second difference over the squares of the discrete polynomial of second degree.
    let n = count as f64;
    let weights: Vec<f64> = (0..count)
        .map(|k| {
            let t = k as f64 - 0.5 * (n - 1.0);
            t * t - (n * n - 1.0) / 12.0
        })
        .collect();
    let squares: f64 = weights.iter().map(|weight| weight * weight).sum();
    // In time of cycles the drift is c t^2: a bend of c/4 from the middle of a cycle to its ends.
    let value =
        0.25 * weights.iter().zip(&middles).map(|(weight, middle)| weight * middle).sum::<f64>() / squares;
    // A value at a turn, by parabolas of a twelfth of the points on both sides, is as good as the mean of a quarter of these: 9/n of one
    // point's variance each. Twice that, for what is correlated.
    let unsure = near
        .iter()
        .map(|cycle| {
            let points = (cycle.force.len() as f64 / 12.0).clamp(3.0, 15.0);
            noise(&cycle.displacement, 0.0) * (9.0 / points / 2.0 / 2.0).sqrt()
        })
        .fold(0.0, f64::max);
    Some(Bend { value, unsure: 2.0 * 0.25 * unsure / squares.sqrt() })
}
