//! What a fit to an indentation starts from: where the indenter touches, and how noisy depth and load are.

use super::super::turns::{noise, range};

/// The touch is guessed by rows with more than this part of the largest load, first as of a sphere: load as the depth to the power of 1.5.
const GUESS: f64 = 0.05;
pub const SPHERE: f64 = 1.5;
/// Rows of loading, at the least, by which the touch is guessed.
const FEWEST_ROWS: usize = 5;
/// Noise below this part of the range does not count: what a curve is off is more.
const QUIET: f64 = 1e-4;
/// The noise of one signal over that of the other, relative to the ranges, at the most.
const UNEQUAL: f64 = 4.0;
/// Where the indenter touches, for a start: by regression of the depth against the load to a power, over the rows of loading.
pub fn first_touch([depths, loads]: [&[f64]; 2], frame: f64, exponent: f64) -> f64 {
    let [_, most] = range(loads);
    let top = loads.iter().position(|load| *load >= most).unwrap_or(0);
    let presses = |row: &usize| loads[*row] > GUESS * most;
    let mut rows: Vec<usize> = (0..=top).filter(presses).collect();
    if rows.len() < FEWEST_ROWS {
        rows = (0..loads.len()).filter(presses).collect();
    }
    let own: Vec<[f64; 2]> = rows
        .iter()
        .map(|&row| [(loads[row] / most).powf(1.0 / exponent), depths[row] - frame * loads[row]])
        .collect();
    let mean = |k: usize| own.iter().map(|point| point[k]).sum::<f64>() / own.len() as f64;
    let [x, depth] = [mean(0), mean(1)];
    let square: f64 = own.iter().map(|point| (point[0] - x).powi(2)).sum();
    let slope = own.iter().map(|point| (point[0] - x) * (point[1] - depth)).sum::<f64>() / square;
    if slope > 0.0 && slope.is_finite() { depth - slope * x } else { range(depths)[0] }
}

/// Noise of depth and load, as large as the ranges together.
pub fn noises([depths, loads]: [&[f64]; 2], units: [f64; 2]) -> [f64; 2] {
    let of = |values: &[f64], unit: f64| (noise(values, 0.0) / unit).hypot(QUIET);
    let [length, force] = [of(depths, units[0]), of(loads, units[1])];
    let ratio = (length / force).clamp(1.0 / UNEQUAL, UNEQUAL);
    let force = (2.0 / (1.0 + ratio * ratio)).sqrt();
    [ratio * force * units[0], force * units[1]]
}
