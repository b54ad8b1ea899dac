//! The course of a signal: where it turns, its values there, its range without noise, the slope of a line through points.

use std::f64::consts::TAU;
use std::ops::Range;

use nalgebra::{Matrix3, Vector3};

/// Points of a parabola at a turn: this part of those of a cycle, at the least and at the most.
const POINTS_OF_A_PARABOLA: [usize; 3] = [12, 4, 15];

/// Points before and behind a turn through which lines are laid: those between these parts of the range of displacement.
const SIDE: Range<f64> = 0.5..0.9;

/// Slope of the line of least squares.
pub fn slope(points: &[[f64; 2]]) -> Option<f64> {
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

/// Value and slope at 0 of the parabola of least squares, and the variance of that value over that of a point. `None` where the points do
/// not determine it.
pub fn parabola(points: &[[f64; 2]]) -> Option<[f64; 3]> {
    let moment = |power: i32| points.iter().map(|point| point[0].powi(power)).sum::<f64>();
    let square = Matrix3::from_fn(|row, column| moment((row + column) as i32));
    let right = Vector3::from_fn(|row, _| points.iter().map(|[x, y]| x.powi(row as i32) * y).sum::<f64>());
    let inverse = square.try_inverse()?;
    let found = inverse * right;
    let [value, slope, variance] = [found[0], found[1], inverse[(0, 0)]];
    (value.is_finite() && slope.is_finite() && variance > 0.0).then_some([value, slope, variance])
}

/// Value at a turn (a row, with a fraction), where a cycle has a corner (a triangle) or a top (a sine): parabolas of least squares through
/// the points before it (side -1), behind it (1), or the mean of both. Means over a corner would cut it off.
pub fn at_turn<const N: usize>(values: &[f64], turn: f64, sides: [isize; N]) -> f64 {
    let count = values.len() as isize;
    let points =
        (values.len() / POINTS_OF_A_PARABOLA[0]).clamp(POINTS_OF_A_PARABOLA[1], POINTS_OF_A_PARABOLA[2]);
    let of_side = |side: isize| {
        let first = if side > 0 { turn.ceil() } else { turn.floor() };
        let points: Vec<[f64; 2]> = (0..points as isize)
            .map(|k| first as isize + side * k)
            .map(|row| [(row as f64 - turn) / points as f64, values[row.rem_euclid(count) as usize]])
            .collect();
        parabola(&points).map_or(values[(first as isize).rem_euclid(count) as usize], |[value, ..]| value)
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
    (0..count)
        .map(|k| (0..5).map(|near| values[(k + 2 * count + near - 2) % count]).sum::<f64>() / 5.0)
        .collect()
}

/// Rows, with fractions, at which the displacement is largest and smallest: where the lines through the points before and behind meet. A
/// drift does not move that, and noise little.
pub fn turns(displacement: &[f64]) -> [f64; 2] {
    let count = displacement.len();
    // What drifts is as much higher at the end of a cycle as its last points lead on above the first.
    let drift = jump(displacement);
    let along = |(row, value): (usize, &f64)| value - drift * (row as f64 + 0.5) / count as f64;
    let displacement: Vec<f64> = displacement.iter().enumerate().map(along).collect();
    let [low, high] = calm_range(&displacement);
    let turn = |sign: f64| {
        let outer =
            |row: usize| 0.5 + sign * (displacement[row % count] - f64::midpoint(low, high)) / (high - low);
        let about = middle_of_outer(count, outer);
        let line = |side: isize| {
            let points: Vec<[f64; 2]> = (0..count / 2)
                .map(|step| side * step as isize)
                .map(|step| [step as f64, outer((about as isize + step).rem_euclid(count as isize) as usize)])
                .filter(|[_, outer]| SIDE.contains(outer))
                .collect();
            let rise = slope(&points)?;
            let [step, value] =
                [0, 1].map(|k| points.iter().map(|point| point[k]).sum::<f64>() / points.len() as f64);
            Some((value - rise * step, rise))
        };
        let meet =
            line(-1).zip(line(1)).map(|((before, up), (behind, down))| (behind - before) / (up - down));
        // Lines that do not meet here are none of a turn.
        let meet = meet.filter(|meet| meet.abs() < count as f64 / 8.0).unwrap_or(0.0);
        (about as f64 + meet).rem_euclid(count as f64)
    };
    [turn(1.0), turn(-1.0)]
}

/// Whether a row, or a place between two, lies on the way down, between turns at these rows of a cycle.
pub fn falls(row: f64, turns: [f64; 2]) -> bool {
    let [top, bottom] = turns;
    if top < bottom { (top..bottom).contains(&row) } else { row >= top || row < bottom }
}

/// How much higher the last points of a cycle are than those before its first would be: by lines through a few of both, led on by one row.
fn jump(values: &[f64]) -> f64 {
    let count = values.len();
    let points = (count / 30).clamp(3, 8).min(count);
    let n = points as f64;
    // The line of least squares through points 0, 1, ... n - 1, at n: from the nearest point on.
    let next = |value: &dyn Fn(usize) -> f64| {
        (0..points)
            .map(|k| (4.0 * n + 2.0 - 6.0 * (k as f64 + 1.0)) / (n * (n - 1.0)) * value(k))
            .sum::<f64>()
    };
    let behind_last = next(&|k| values[count - 1 - k]);
    let before_first = next(&|k| values[k]);
    0.5 * (behind_last - values[0] + values[count - 1] - before_first)
}

/// The middle of the rows of a cycle in the outermost fifth of the range of displacement.
fn middle_of_outer(count: usize, outer: impl Fn(usize) -> f64) -> usize {
    let (mut cos, mut sin) = (0.0, 0.0);
    for row in (0..count).filter(|&row| outer(row) > 0.8) {
        // A cycle has no first point: the mean of directions around it.
        let angle = TAU * row as f64 / count as f64;
        cos += angle.cos();
        sin += angle.sin();
    }
    let share = sin.atan2(cos).rem_euclid(TAU) / TAU;
    (share * count as f64).round() as usize % count
}

/// Standard deviation of the noise of a signal, whose neighbouring points are correlated by so much: by the median of its third
/// differences, to which neither turns nor single wrong samples add, and a sine of few points little.
pub fn noise(values: &[f64], correlation: f64) -> f64 {
    let mut third: Vec<f64> =
        values.windows(4).map(|four| (four[3] - 3.0 * four[2] + 3.0 * four[1] - four[0]).abs()).collect();
    third.sort_by(f64::total_cmp);
    // The median of a normal distribution lies at 0.6745; a third difference has the variance of 1 + 9 + 9 + 1 points.
    let r = correlation;
    let variance = 20.0 - r * (30.0 - r * (12.0 - 2.0 * r));
    third.get(third.len() / 2).map_or(0.0, |median| median / 0.6745 / variance.sqrt())
}

/// Where the displacement turns back from its largest values.
pub fn tops(displacement: &[f64]) -> Vec<usize> {
    // Without the outermost hundredth on either side: a single wrong sample makes no range.
    let mut sorted = displacement.to_vec();
    sorted.sort_by(f64::total_cmp);
    let out = sorted.len() / 100;
    let threshold = sorted.get(out).map_or(0.0, |low| 0.5 * (sorted[sorted.len() - 1 - out] - low));
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
    // A log that begins on the way down begins at no top.
    if let [first, second, ..] = found[..]
        && displacement[second] - displacement[first] > 0.5 * threshold
    {
        found.remove(0);
    }
    found
}

/// Where the displacement passes the middle of its range on the way up.
pub fn rising_crossings(displacement: &[f64]) -> Vec<usize> {
    let [low, high] = calm_range(displacement);
    let middle = f64::midpoint(low, high);
    // Noise passes it many times: what counts is the last time before this part of the range above it.
    let apart = 0.1 * (high - low);
    let mut found = Vec::new();
    let (mut is_below, mut last) = (false, 0);
    for (row, value) in displacement.iter().enumerate() {
        if *value < middle {
            last = row + 1;
        }
        if *value < middle - apart {
            is_below = true;
        } else if is_below && *value > middle + apart {
            found.push(last);
            is_below = false;
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use rand_pcg::Pcg64Mcg;
    use rand_pcg::rand_core::Rng;

    use super::*;

    #[test]
    fn a_parabola_of_least_squares_ends_where_a_parabola_does() {
        let values: Vec<f64> = (0..60).map(|k| 3.0 - 0.2 * f64::from(k) + 0.01 * f64::from(k * k)).collect();
        for turn in [20.0, 33.4_f64] {
            let right = 3.0 - 0.2 * turn + 0.01 * turn * turn;
            assert!((at_turn(&values, turn, [-1, 1]) - right).abs() < 1e-12);
        }
    }

    /// A long wave of fifty points with noise of standard deviation 0.1, independent or correlated from point to point: known to 5 % from
    /// 4000 points, whose median is so to 2 %.
    #[test]
    fn noise_is_told_from_a_wave_also_where_it_is_correlated() {
        let mut random = Pcg64Mcg::new(11);
        let mut uniform = || f64::from(random.next_u32()) / 4_294_967_296.0;
        for correlation in [0.0, 0.5, 0.8] {
            let mut value = 0.0;
            let values: Vec<f64> = (0..4000)
                .map(|k| {
                    // Twelve uniform numbers are a normal one, but for their mean.
                    let fresh = (0..12).map(|_| uniform()).sum::<f64>() - 6.0;
                    value = correlation * value + (1.0_f64 - correlation * correlation).sqrt() * fresh;
                    (TAU * f64::from(k) / 50.0).sin() + 0.1 * value
                })
                .collect();
            let found = noise(&values, correlation);
            assert!((found / 0.1 - 1.0).abs() < 0.05, "{correlation}: {found}");
        }
    }

    /// A triangle of forty points begins and ends inside a cycle: its tops and the crossings of its middle, by their places.
    #[test]
    fn tops_and_crossings_are_where_they_are() {
        let wave = |k: i32| f64::from((k.rem_euclid(40) - 20).abs()) - 10.0;
        // From k = 8 on the way down; tops at 40, 80 and 120, of which the last is the last point.
        let values: Vec<f64> = (8..=120).map(wave).collect();
        assert_eq!(tops(&values), [32, 72]);
        // Upwards through the middle at 30, 70 and 110, downwards at 10, 50 and 90.
        assert_eq!(rising_crossings(&values), [22, 62, 102]);
        assert_eq!(rising_crossings(&values.iter().map(|value| -value).collect::<Vec<_>>()), [2, 42, 82]);
    }

    /// Triangles and sines, begun anywhere, with a drift of a tenth of their range and 1 % of noise: to a row and a half of a hundred where a
    /// triangle begins at its turn (what drifts and what turns are told apart there by one row, and noise), elsewhere to one.
    #[test]
    fn turns_are_found_in_spite_of_drift_and_noise() {
        let mut random = Pcg64Mcg::new(5);
        let mut noise = || f64::from(random.next_u32()) / 2_147_483_648.0 - 1.0;
        for begins in [0.0, 0.4, 13.5, 30.4, 60.0] {
            for is_sine in [false, true] {
                let apart = if begins < 1.0 { 1.5 } else { 1.0 };
                let values: Vec<f64> = (0..100)
                    .map(|row| {
                        let time = ((f64::from(row) - begins) / 100.0).rem_euclid(1.0);
                        let triangle = (4.0 * time - 2.0).abs() - 1.0;
                        let place = if is_sine { (TAU * time).cos() } else { triangle };
                        place + 0.2 * f64::from(row) / 100.0 + 0.02 * noise()
                    })
                    .collect();
                for (found, right) in turns(&values).into_iter().zip([begins, begins + 50.0]) {
                    let off = (found - right + 50.0).rem_euclid(100.0) - 50.0;
                    assert!(off.abs() < apart, "{begins} {is_sine}: {found} {right}");
                }
            }
        }
    }
}
