//! Cycles of a log, and what is read from each of them without any model.

use std::f64::consts::TAU;

use serde_json::{Value, json};

use super::log::Table;
use super::refused;
use crate::failure::Failure;

/// Points of a cycle, at the least.
const FEWEST: usize = 12;
/// Neighbouring points further apart than this fraction of the range of displacement have points missing between them.
const GAP: f64 = 0.3;
/// A cycle whose force ends further from where it began than this fraction of its range is not closed.
const OPEN: f64 = 0.25;

/// Points of a parabola at a turn: this part of those of a cycle, at the least and at the most.
const POINTS_OF_A_PARABOLA: [usize; 3] = [12, 3, 15];

/// One measured cycle, in the units of the case.
#[derive(Debug, Clone)]
pub struct MeasuredCycle {
    /// Its number in the log.
    pub name: f64,
    /// Displacement of the actuator, in the order of the log [length].
    pub displacement: Vec<f64>,
    /// Tangential force [force].
    pub force: Vec<f64>,
    /// Mean normal force, where it was measured [force].
    pub normal_force: Option<f64>,
    /// First and last line in the file.
    pub lines: [usize; 2],
    /// Where the displacement is largest and where it is smallest.
    pub turns: [usize; 2],
}

/// What is read from a cycle.
#[derive(Debug, Clone, Copy)]
pub struct Quantities {
    pub dissipated_energy: f64,
    pub force_amplitude: f64,
    pub displacement_amplitude: f64,
    pub opening: f64,
    pub energy_ratio: f64,
    pub sliding_ratio: f64,
    pub contact_energy_ratio: Option<f64>,
    pub contact_sliding_ratio: Option<f64>,
    /// Slope directly after reversal [force/length].
    pub slope: Option<f64>,
    /// Half of the distance of the plateaus over the normal force, where there are plateaus.
    pub plateau_friction: Option<f64>,
    /// `W_d / (4 P delta_0)`.
    pub energy_friction: f64,
}

impl Quantities {
    pub fn to_json(self, cycle: &MeasuredCycle) -> Value {
        json!({
            "cycle": cycle.name,
            "points": cycle.force.len(),
            "dissipated_energy": self.dissipated_energy,
            "force_amplitude": self.force_amplitude,
            "displacement_amplitude": self.displacement_amplitude,
            "opening": self.opening,
            "energy_ratio": self.energy_ratio,
            "sliding_ratio": self.sliding_ratio,
            "contact_energy_ratio": self.contact_energy_ratio,
            "contact_sliding_ratio": self.contact_sliding_ratio,
            "slope_after_reversal": self.slope,
            "plateau_friction": self.plateau_friction,
            "energy_friction": self.energy_friction,
        })
    }
}

/// The cycles of a log: by its column, or from one largest displacement to the next.
///
/// # Errors
/// Where a cycle has too few points, a gap, or no end.
pub fn split(table: &Table, [length, force, normal]: [f64; 3]) -> Result<Vec<MeasuredCycle>, Failure> {
    let displacement: Vec<f64> = table.of(0).iter().map(|value| value * length).collect();
    let forces: Vec<f64> = table.of(1).iter().map(|value| value * force).collect();
    let bounds: Vec<(f64, usize, usize)> = if table.columns[2].is_some() {
        let numbers = table.of(2);
        let starts: Vec<usize> =
            (0..numbers.len()).filter(|&row| row == 0 || numbers[row] != numbers[row - 1]).collect();
        let ends = starts.iter().skip(1).copied().chain([numbers.len()]);
        starts.iter().zip(ends).map(|(&from, to)| (numbers[from], from, to)).collect()
    } else {
        let tops = tops(&displacement);
        if tops.len() >= 3 {
            tops.windows(2).enumerate().map(|(k, pair)| ((k + 1) as f64, pair[0], pair[1])).collect()
        } else {
            vec![(1.0, 0, displacement.len())]
        }
    };
    let mut cycles = Vec::new();
    for (name, from, to) in bounds {
        let normal_force = table.columns[3]
            .as_ref()
            .map(|column| normal * column.values[from..to].iter().sum::<f64>() / (to - from) as f64);
        let cycle = MeasuredCycle {
            name,
            turns: turns(&displacement[from..to]),
            displacement: displacement[from..to].to_vec(),
            force: forces[from..to].to_vec(),
            normal_force,
            lines: [table.lines[from], table.lines[to - 1]],
        };
        cycle.check(table, from)?;
        cycles.push(cycle);
    }
    Ok(cycles)
}

/// The cycle of a number, or the last.
pub fn choose<'a>(
    cycles: &'a [MeasuredCycle],
    number: Option<f64>,
    name: &str,
) -> Result<&'a MeasuredCycle, Failure> {
    let chosen = match number {
        None => cycles.last(),
        Some(number) => cycles.iter().find(|cycle| cycle.name == number),
    };
    chosen.ok_or_else(|| {
        let [first, last] =
            [cycles.first(), cycles.last()].map(|cycle| cycle.map_or(0.0, |cycle| cycle.name));
        refused(
            name,
            &format!("there is no cycle {}", number.unwrap_or_default()),
            &format!("its cycles go from {first} to {last}"),
        )
    })
}

/// By how much the middle of the displacement wanders from cycle to cycle [length]; `None` of a single one.
pub fn drift(cycles: &[MeasuredCycle]) -> Option<f64> {
    let middles: Vec<f64> = cycles
        .iter()
        .map(|cycle| {
            let [low, high] = range(&cycle.displacement);
            f64::midpoint(low, high)
        })
        .collect();
    (middles.len() > 1).then(|| {
        slope(&(0..middles.len()).map(|k| [k as f64, middles[k]]).collect::<Vec<_>>()).unwrap_or(0.0)
    })
}

impl MeasuredCycle {
    fn check(&self, table: &Table, from: usize) -> Result<(), Failure> {
        let name = &table.name;
        let place = format!("cycle {} (lines {} to {})", self.name, self.lines[0], self.lines[1]);
        let count = self.force.len();
        if count < FEWEST {
            return Err(refused(
                name,
                &format!("{place} has {count} points; a loop needs at least {FEWEST}"),
                "delete a cycle that was cut off",
            ));
        }
        let [low, high] = range(&self.displacement);
        for row in 1..count {
            let jump = (self.displacement[row] - self.displacement[row - 1]).abs();
            if jump > GAP * (high - low) {
                return Err(refused(
                    name,
                    &format!(
                        "the displacement jumps by {:.0} % of its range between lines {} and {}: points are missing there",
                        100.0 * jump / (high - low),
                        table.lines[from + row - 1],
                        table.lines[from + row]
                    ),
                    "use a cycle without a gap: --cycle N",
                ));
            }
        }
        let [bottom, top] = range(&self.force);
        let ends = 3.min(count);
        let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
        let open = (mean(&self.force[count - ends..]) - mean(&self.force[..ends])).abs();
        let apart = (mean(&self.displacement[count - ends..]) - mean(&self.displacement[..ends])).abs();
        if open > OPEN * (top - bottom) || apart > OPEN * (high - low) {
            return Err(refused(
                name,
                &format!(
                    "{place} does not close: it ends {:.0} % of the range of force and {:.0} % of that of displacement from where it began",
                    100.0 * open / (top - bottom),
                    100.0 * apart / (high - low)
                ),
                "a cycle begins and ends at one point of the loop; leave out the first loading from zero, and half cycles",
            ));
        }
        let [first, last] = self.turns;
        let between = first.abs_diff(last);
        if between < 3 || count - between < 3 {
            return Err(refused(
                name,
                &format!("{place}: the displacement does not go there and back"),
                "is this the displacement? choose the column with --columns",
            ));
        }
        Ok(())
    }

    /// Whether a point lies on the way down, from the largest displacement to the smallest.
    pub fn is_falling(&self, row: usize) -> bool {
        let [top, bottom] = self.turns;
        if top < bottom { (top..bottom).contains(&row) } else { row >= top || row < bottom }
    }

    /// What is read from the loop; of the contact's own too, with the stiffness of the rig.
    pub fn quantities(&self, normal_force: f64, stiffness: Option<f64>) -> Quantities {
        let own = self.loop_of(|row| self.displacement[row]);
        let contact = stiffness
            .map(|stiffness| self.loop_of(|row| self.displacement[row] - self.force[row] / stiffness));
        let pressed = self.normal_force.unwrap_or(normal_force);
        let [energy, force_amplitude, amplitude, opening] = own;
        let slope = self.slope_after_reversal();
        Quantities {
            dissipated_energy: energy,
            force_amplitude,
            displacement_amplitude: amplitude,
            opening,
            energy_ratio: energy / (4.0 * force_amplitude * amplitude),
            sliding_ratio: opening / amplitude,
            contact_energy_ratio: contact
                .map(|[energy, force, amplitude, _]| energy / (4.0 * force * amplitude)),
            contact_sliding_ratio: contact.map(|[_, _, amplitude, opening]| opening / amplitude),
            slope,
            plateau_friction: self.plateau(slope).map(|force| force / pressed),
            energy_friction: energy / (4.0 * pressed * opening),
        }
    }

    /// Enclosed energy, amplitudes of force and displacement, half-width at the middle of the force.
    fn loop_of(&self, displacement: impl Fn(usize) -> f64) -> [f64; 4] {
        let count = self.force.len();
        let mut energy = 0.0;
        let places: Vec<f64> = (0..count).map(&displacement).collect();
        let [high, low] = self.turns.map(|turn| at_turn(&places, turn, [-1, 1]));
        let [bottom, top] = self.range_of_force();
        let middle = f64::midpoint(bottom, top);
        let (mut falling, mut rising) = (Vec::new(), Vec::new());
        for row in 0..count {
            let next = (row + 1) % count;
            energy += 0.5 * (self.force[row] + self.force[next]) * (places[next] - places[row]);
            // Crossings of noise are averaged.
            if (self.force[row] - middle) * (self.force[next] - middle) <= 0.0
                && self.force[row] != self.force[next]
            {
                let share = (middle - self.force[row]) / (self.force[next] - self.force[row]);
                let at = places[row] + share * (places[next] - places[row]);
                if self.is_falling(row) { falling.push(at) } else { rising.push(at) }
            }
        }
        let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len().max(1) as f64;
        [energy.abs(), 0.5 * (top - bottom), 0.5 * (high - low), 0.5 * (mean(&rising) - mean(&falling)).abs()]
    }

    /// Smallest and largest force: those at the ends of the branches, where the loop has its corners, or beyond them where a branch has
    /// its extreme on the way.
    fn range_of_force(&self) -> [f64; 2] {
        let [bottom, top] = calm_range(&self.force);
        let [first, last] = self.turns.map(|turn| at_turn(&self.force, turn, [-1]));
        [bottom.min(first).min(last), top.max(first).max(last)]
    }

    /// Slope of the loop directly after both reversals: a line through the points of the first third of the change of force.
    pub fn slope_after_reversal(&self) -> Option<f64> {
        let [bottom, top] = calm_range(&self.force);
        let count = self.force.len();
        let slopes: Vec<f64> = self
            .turns
            .iter()
            .filter_map(|&turn| {
                let begins = if self.is_falling(turn) { top } else { bottom };
                let mut points = Vec::new();
                for step in 0..count / 2 {
                    let row = (turn + step) % count;
                    let share = (self.force[row] - begins).abs() / (top - bottom);
                    if share > 0.4 {
                        break;
                    }
                    if share > 0.04 {
                        points.push([self.displacement[row], self.force[row]]);
                    }
                }
                slope(&points)
            })
            .filter(|slope| *slope > 0.0)
            .collect();
        (!slopes.is_empty()).then(|| slopes.iter().sum::<f64>() / slopes.len() as f64)
    }

    /// Half of the distance of the plateaus of sliding [force]: means over the last fifth of the way between the turns, where they
    /// rise by less than a tenth of the slope after reversal.
    fn plateau(&self, steep: Option<f64>) -> Option<f64> {
        let steep = steep?;
        let [low, high] = calm_range(&self.displacement);
        let side = |falling: bool| {
            let points: Vec<[f64; 2]> = (0..self.force.len())
                .filter(|&row| self.is_falling(row) == falling)
                .map(|row| [self.displacement[row], self.force[row]])
                .filter(|[d, _]| {
                    let done = if falling { (high - d) / (high - low) } else { (d - low) / (high - low) };
                    (0.75..0.98).contains(&done)
                })
                .collect();
            let rise = slope(&points)?;
            (rise.abs() < 0.1 * steep)
                .then(|| points.iter().map(|point| point[1]).sum::<f64>() / points.len() as f64)
        };
        Some(0.5 * (side(false)? - side(true)?).abs())
    }
}

/// Slope of the line of least squares.
fn slope(points: &[[f64; 2]]) -> Option<f64> {
    if points.len() < 3 {
        return None;
    }
    let n = points.len() as f64;
    let [x, y] = [0, 1].map(|k| points.iter().map(|point| point[k]).sum::<f64>() / n);
    let (mut xx, mut xy) = (0.0, 0.0);
    for point in points {
        xx += (point[0] - x).powi(2);
        xy += (point[0] - x) * (point[1] - y);
    }
    (xx > 0.0).then(|| xy / xx)
}

/// Value at a turn, where a cycle has a corner (a triangle) or a top (a sine): parabolas of least squares through the points before it
/// (side -1), behind it (1), or the mean of both. Means over a corner would cut it off.
fn at_turn<const N: usize>(values: &[f64], turn: usize, sides: [isize; N]) -> f64 {
    let count = values.len();
    let points = (count / POINTS_OF_A_PARABOLA[0]).clamp(POINTS_OF_A_PARABOLA[1], POINTS_OF_A_PARABOLA[2]);
    let of_side = |side: isize| {
        let value =
            |k: usize| values[(turn as isize + side * k as isize).rem_euclid(count as isize) as usize];
        // Value at the end of the parabola of least squares through points 0, 1, ... n - 1: weights of the discrete orthogonal polynomials.
        let n = points as f64;
        let weight = |k: f64| {
            3.0 * (3.0 * n * n - 3.0 * n + 2.0 - 6.0 * (2.0 * n - 1.0) * k + 10.0 * k * k)
                / (n * (n + 1.0) * (n + 2.0))
        };
        (0..points).map(|k| weight(k as f64) * value(k)).sum::<f64>()
    };
    sides.into_iter().map(of_side).sum::<f64>() / N as f64
}

/// Smallest and largest value.
pub fn range(values: &[f64]) -> [f64; 2] {
    values
        .iter()
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.min(*value), high.max(*value)])
}

/// The same of the means of five neighbours: noise has no extremes there.
pub fn calm_range(values: &[f64]) -> [f64; 2] {
    range(&calm(values))
}

fn calm(values: &[f64]) -> Vec<f64> {
    let count = values.len();
    (0..count).map(|k| (0..5).map(|near| values[(k + count + near - 2) % count]).sum::<f64>() / 5.0).collect()
}

/// Where the displacement is largest and smallest: the middle of the time that it spends in the outermost fifth of its range, which
/// noise does not move.
fn turns(displacement: &[f64]) -> [usize; 2] {
    let [low, high] = calm_range(displacement);
    let count = displacement.len();
    let middle = |sign: f64| {
        let outer = |value: f64| {
            if sign > 0.0 { (value - low) / (high - low) } else { (high - value) / (high - low) }
        };
        let (mut cos, mut sin) = (0.0, 0.0);
        for (row, value) in displacement.iter().enumerate() {
            // A cycle has no first point: the mean of directions around it.
            if outer(*value) > 0.8 {
                let angle = TAU * row as f64 / count as f64;
                cos += angle.cos();
                sin += angle.sin();
            }
        }
        let share = sin.atan2(cos).rem_euclid(TAU) / TAU;
        (share * count as f64).round() as usize % count
    };
    [middle(1.0), middle(-1.0)]
}

/// Where the displacement turns back from its largest values.
fn tops(displacement: &[f64]) -> Vec<usize> {
    let [low, high] = range(displacement);
    let threshold = 0.5 * (high - low);
    let mut found = Vec::new();
    let (mut top, mut bottom) = (0, 0);
    let mut climbs = true;
    for (row, value) in displacement.iter().enumerate() {
        if *value > displacement[top] {
            top = row;
        }
        if *value < displacement[bottom] {
            bottom = row;
        }
        if climbs && displacement[top] - value > threshold {
            found.push(top);
            (climbs, bottom) = (false, row);
        } else if !climbs && value - displacement[bottom] > threshold {
            (climbs, top) = (true, row);
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cycle(displacement: Vec<f64>, force: Vec<f64>) -> MeasuredCycle {
        let turns = turns(&displacement);
        MeasuredCycle { name: 1.0, displacement, force, normal_force: None, lines: [1, 1], turns }
    }

    #[test]
    fn a_parabola_of_least_squares_ends_where_a_parabola_does() {
        let values: Vec<f64> = (0..60).map(|k| 3.0 - 0.2 * f64::from(k) + 0.01 * f64::from(k * k)).collect();
        for turn in [20, 33] {
            assert!((at_turn(&values, turn, [-1, 1]) - values[turn]).abs() < 1e-12);
        }
    }

    #[test]
    fn corners_are_not_cut_off_and_tops_not_heightened() {
        for count in [40, 100, 400] {
            for is_sine in [true, false] {
                let wave = |time: f64| {
                    let triangle = if time < 0.5 { 1.0 - 4.0 * time } else { 4.0 * time - 3.0 };
                    if is_sine { (TAU * time).cos() } else { triangle }
                };
                let displacement: Vec<f64> =
                    (0..count).map(|k| 2.0 * wave(k as f64 / count as f64)).collect();
                // A loop of two straight branches and a share of friction: force follows the displacement, and turns by 0.4 behind it.
                let force =
                    (0..count).map(|k| displacement[k] + if 2 * k < count { -0.2 } else { 0.2 }).collect();
                let read = cycle(displacement, force).quantities(1.0, None);
                // What the fourth derivative of a sine leaves of a parabola over a twelfth of a cycle.
                let bound = if is_sine { 2e-3 } else { 1e-12 };
                assert!(
                    (read.displacement_amplitude / 2.0 - 1.0).abs() < bound,
                    "{count} {is_sine}: {read:?}"
                );
            }
        }
    }
}
