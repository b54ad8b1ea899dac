//! The Gaussian filter of profiles and surfaces (ISO 16610-21 and 61).

use std::f64::consts::{LN_2, PI};

use ndarray::{Array2, Axis};

/// Mean of heights under a Gaussian weight that passes half of a wave of length `cutoff` along either axis [points]; beyond the border
/// the weights that remain are made one again, or the points are those of the other end where the surface repeats.
pub fn smoothed(heights: &Array2<f64>, cutoff: [f64; 2], repeats: [bool; 2]) -> Array2<f64> {
    let mut smooth = heights.clone();
    for (axis, cutoff) in cutoff.into_iter().enumerate() {
        if smooth.len_of(Axis(axis)) > 1 {
            along(&mut smooth, axis, cutoff, repeats[axis]);
        }
    }
    smooth
}

/// Widths over a period from which on the mean alone is left: of the wave that fills a period exp(-4 pi) = 3e-6 passes at two.
const WIDEST: f64 = 2.0;

/// At a distance of the cutoff the weight is 7e-7 of that in the middle, and what lies beyond counts for nothing.
fn along(heights: &mut Array2<f64>, axis: usize, cutoff: f64, repeats: bool) {
    let alpha = (LN_2 / PI).sqrt();
    let count = heights.len_of(Axis(axis));
    if repeats {
        return around(heights, axis, alpha * cutoff);
    }
    let reach = (cutoff.ceil() as usize).min(count - 1);
    let weights: Vec<f64> =
        (0..=reach).map(|away| (-PI * (away as f64 / (alpha * cutoff)).powi(2)).exp()).collect();
    let mut before = vec![0.0; count];
    for mut lane in heights.lanes_mut(Axis(axis)) {
        before.iter_mut().zip(&lane).for_each(|(before, height)| *before = *height);
        for (place, height) in lane.iter_mut().enumerate() {
            let (mut sum, mut weight) = (0.0, 0.0);
            let last = (place + reach).min(count - 1);
            for (other, value) in before.iter().enumerate().take(last + 1).skip(place.saturating_sub(reach)) {
                sum += weights[place.abs_diff(other)] * value;
                weight += weights[place.abs_diff(other)];
            }
            *height = sum / weight;
        }
    }
}

/// The same of a surface that repeats: the weights of all periods over one. `width` is the factor alpha times the cutoff.
fn around(heights: &mut Array2<f64>, axis: usize, width: f64) {
    let count = heights.len_of(Axis(axis));
    let mut weights = vec![0.0; count];
    if width > WIDEST * count as f64 {
        weights.fill(1.0);
    } else {
        let reach = (width / (LN_2 / PI).sqrt()).ceil() as usize;
        for away in 0..=reach {
            let weight = (-PI * (away as f64 / width).powi(2)).exp();
            weights[away % count] += weight;
            weights[(count - away % count) % count] += if away > 0 { weight } else { 0.0 };
        }
    }
    let all: f64 = weights.iter().sum();
    for mut lane in heights.lanes_mut(Axis(axis)) {
        let before = lane.to_vec();
        for (place, height) in lane.iter_mut().enumerate() {
            let at = |away: usize| before[(place + away) % count];
            *height = weights.iter().enumerate().map(|(away, weight)| weight * at(away)).sum::<f64>() / all;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A wave that repeats is damped by the transmission everywhere, up to the border; so is one of a period shorter than the reach.
    #[test]
    fn a_period_has_no_border() {
        for (count, waves, cutoff) in [(40, 2, 25.0_f64), (12, 1, 30.0)] {
            let wavelength = f64::from(count) / f64::from(waves);
            let wave = |at: usize| (2.0 * PI * at as f64 / wavelength + 0.4).cos();
            let surface = Array2::from_shape_fn((count as usize, 2), |(i, _)| wave(i));
            let transmission = (-LN_2 * (cutoff / wavelength).powi(2)).exp();
            let smooth = smoothed(&surface, [cutoff, 1e-3], [true, false]);
            for i in 0..count as usize {
                // the weight that is cut off at the reach is 1e-6
                assert!((smooth[[i, 1]] - transmission * surface[[i, 1]]).abs() < 3e-6, "{count} {i}");
            }
        }
    }

    /// However long the cutoff, the mean is left of a period.
    #[test]
    fn a_long_cutoff_leaves_the_mean_of_a_period() {
        let surface = Array2::from_shape_fn((12, 2), |(i, j)| (i * i + j) as f64);
        let mean = surface.mean_axis(Axis(0)).unwrap();
        for cutoff in [60.0, 1e6, 1e300] {
            let smooth = smoothed(&surface, [cutoff, 1e-3], [true, false]);
            let off = |((_, j), height): ((usize, usize), &f64)| (height - mean[j]).abs() / mean[j];
            let off = smooth.indexed_iter().map(off).fold(0.0, f64::max);
            assert!(off < 1e-5, "{cutoff}: {off:e}"); // what is cut off at the reach, and what passes of the longest wave
        }
    }

    /// ISO 16610-21: the transmission is exp(-pi (alpha cutoff / wavelength)^2), one half at the cutoff.
    #[test]
    fn a_wave_is_damped_by_the_transmission_of_the_standard() {
        for (wavelength, cutoff) in [(40.0_f64, 40.0_f64), (80.0, 40.0), (30.0, 60.0)] {
            let wave = |at: f64| (2.0 * PI * at / wavelength).cos();
            let surface = Array2::from_shape_fn((401, 3), |(i, _)| wave(i as f64 - 200.0));
            let transmission = (-LN_2 * (cutoff / wavelength).powi(2)).exp();
            let smooth = smoothed(&surface, [cutoff, 1e-3], [false; 2]);
            // far from the border; the weight that is cut off at the reach is 1e-6
            for i in 150..250 {
                assert!(
                    (smooth[[i, 1]] - transmission * surface[[i, 1]]).abs() < 3e-6,
                    "{wavelength} {cutoff}"
                );
            }
        }
    }

    #[test]
    fn a_level_surface_stays_level_up_to_its_border() {
        let level = Array2::from_elem((20, 30), 7.25);
        assert!((smoothed(&level, [9.0, 50.0], [false; 2]) - &level).iter().all(|error| error.abs() < 1e-14));
    }
}
