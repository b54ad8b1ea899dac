//! Which uncertain number makes a result uncertain: Sobol' indices from the blocks of a [`SampleDesign`](super::SampleDesign).

use serde::{Deserialize, Deserializer, Serialize};

/// Sobol' indices of one uncertain number.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Sensitivity {
    /// First order: the fraction of the variance that knowing this number would take away [-].
    #[serde(deserialize_with = "or_none")]
    pub first: f64,
    /// Total: the fraction that would be left if all other numbers were known [-], with all interactions.
    #[serde(deserialize_with = "or_none")]
    pub total: f64,
}

/// What is no number, of a variance beyond all numbers, files have as nothing.
fn or_none<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    Ok(Option::deserialize(deserializer)?.unwrap_or(f64::NAN))
}

/// Sobol' indices of a result, one a number, from its values in the rows of a design of `count` samples with blocks for indices. A
/// sample of which a value is no number does not count in any block; `None` where fewer than two are left, the result does not vary, or a value is
/// infinite: it has no variance then.
///
/// First order after Saltelli et al. (2010), Comput. Phys. Commun. 181, 259: `mean(f_B (f_ABi - f_A))/V`; total after Jansen (1999), Comput.
/// Phys. Commun. 117, 35: `mean((f_A - f_ABi)^2)/(2 V)`. Values are taken relative to their mean, which changes no exact index and
/// makes the estimates better.
pub fn sensitivity(values: &[f64], count: usize) -> Option<Vec<Sensitivity>> {
    let blocks: Vec<&[f64]> = values.chunks_exact(count).collect();
    let (&[a, b], mixed) = blocks.split_first_chunk::<2>()?;
    let good: Vec<usize> = (0..count).filter(|&n| blocks.iter().all(|block| block[n].is_finite())).collect();
    if good.len() < 2 || mixed.is_empty() || values.iter().any(|value| value.is_infinite()) {
        return None;
    }
    let number = good.len() as f64;
    let mean = good.iter().map(|&n| a[n] + b[n]).sum::<f64>() / (2.0 * number);
    let variance = good.iter().map(|&n| (a[n] - mean).powi(2) + (b[n] - mean).powi(2)).sum::<f64>()
        / (2.0 * number - 1.0);
    if !(variance > 0.0) {
        return None;
    }
    let of = |mixed: &&[f64]| {
        let first: f64 = good.iter().map(|&n| (b[n] - mean) * (mixed[n] - a[n])).sum();
        let total: f64 = good.iter().map(|&n| (a[n] - mixed[n]).powi(2)).sum();
        Sensitivity { first: first / number / variance, total: total / (2.0 * number) / variance }
    };
    Some(mixed.iter().map(of).collect())
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;
    use crate::uncertainty::{Distribution, SampleDesign};

    /// Of the finite samples alone they would be indices of another number.
    #[test]
    fn a_life_that_is_endless_in_some_samples_has_no_indices() {
        let mut values: Vec<f64> = (0..12).map(|n| f64::from(n * n % 7)).collect();
        assert!(sensitivity(&values, 3).is_some());
        values[4] = f64::INFINITY;
        assert_eq!(sensitivity(&values, 3), None);
    }

    #[test]
    fn ishigamis_function_has_its_indices() {
        // Ishigami & Homma (1990): sin x1 + a sin^2 x2 + b x3^4 sin x1, uniform in (-pi, pi), a = 7, b = 0.1. Exact:
        let (a, b) = (7.0, 0.1);
        let alone = [0.5 * (1.0 + b * PI.powi(4) / 5.0_f64).powi(2), a * a / 8.0, 0.0];
        let together = b * b * PI.powi(8) * (1.0 / 18.0 - 1.0 / 50.0);
        let variance = alone.iter().sum::<f64>() + together;
        let first = alone.map(|part| part / variance);
        let total = [first[0] + together / variance, first[1], together / variance];
        assert!((first[0] - 0.3139).abs() < 1e-4 && (total[2] - 0.2437).abs() < 1e-4); // as published
        let errors = |count: usize, seed: u32| {
            let design = SampleDesign {
                distributions: vec![Distribution::Uniform { from: -PI, to: PI }; 3],
                count,
                seed,
                indices: true,
            };
            let value = |x: Vec<f64>| x[0].sin() * (1.0 + b * x[2].powi(4)) + a * x[1].sin().powi(2);
            let values: Vec<f64> = design.rows().unwrap().into_iter().map(value).collect();
            let found = sensitivity(&values, count).unwrap();
            let error = |n: usize| (found[n].first - first[n]).abs().max((found[n].total - total[n]).abs());
            (0..3).map(error).fold(0.0, f64::max)
        };
        for seed in 0..4 {
            // plain random points would leave 1/sqrt(8192) = 0.011
            assert!(errors(8192, seed) < 4e-3, "seed {seed}: {:.1e}", errors(8192, seed));
        }
        let mean = |count| (0..8).map(|seed| errors(count, seed)).sum::<f64>() / 8.0;
        assert!(mean(4096) < 0.3 * mean(256), "{} {}", mean(256), mean(4096)); // better than the quarter of random points
    }

    #[test]
    fn a_sum_has_indices_by_its_variances_and_lost_samples_are_left_out() {
        let distributions = vec![
            Distribution::Normal { mean: 3.0, deviation: 1.0 },
            Distribution::Uniform { from: 0.0, to: 12.0_f64.sqrt() * 2.0 },
        ];
        let design = SampleDesign { distributions, count: 2048, seed: 5, indices: true };
        let mut values: Vec<f64> = design.rows().unwrap().into_iter().map(|row| row[0] + row[1]).collect();
        values[2 * 2048 + 17] = f64::NAN;
        let found = sensitivity(&values, 2048).unwrap();
        for (found, exact) in found.iter().zip([0.2, 0.8]) {
            assert!((found.first - exact).abs() < 0.01 && (found.total - exact).abs() < 0.01, "{found:?}");
        }
        assert_eq!(sensitivity(&[1.0; 8], 2), None);
        assert_eq!(sensitivity(&values[..4096], 2048), None);
    }
}
