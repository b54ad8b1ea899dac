//! Mean, standard deviation and quantiles of samples.

use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// Fractions below the quantiles that are told.
pub const QUANTILES: [f64; 5] = [0.025, 0.25, 0.5, 0.75, 0.975];

/// What samples of a number have in common. A sample without bound, an endless life, is larger than any other: the mean is infinite then, there is no
/// deviation, and quantiles are what they are.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Statistics {
    /// Samples that count.
    pub count: usize,
    /// Mean.
    #[serde(with = "bounded")]
    pub mean: f64,
    /// Standard deviation of the distribution that was sampled (divisor n - 1); not a number where a sample is infinite.
    #[serde(with = "bounded")]
    pub deviation: f64,
    /// Smallest value.
    #[serde(with = "bounded")]
    pub min: f64,
    /// Largest value.
    #[serde(with = "bounded")]
    pub max: f64,
    /// Values below which lie the fractions [`QUANTILES`], linear between samples.
    #[serde(serialize_with = "each_bounded", deserialize_with = "each_read")]
    pub quantiles: [f64; 5],
}

impl Statistics {
    /// Whether the number varies by more than `rounding`, relative; what is endless in some samples has no deviation, and varies.
    pub fn varies(&self, rounding: f64) -> bool {
        let Self { deviation, min, max, .. } = self;
        *deviation > rounding * min.abs().max(max.abs()) || min < max && (max - min).is_infinite()
    }
}

/// A number as files have it: those beyond all bounds as the words that programs read as such, what is no number as nothing.
#[derive(Serialize, Deserialize)]
#[serde(untagged)]
enum Written {
    Number(f64),
    Word(String),
    Nothing,
}

impl Written {
    fn of(value: f64) -> Self {
        match value {
            f64::INFINITY => Self::Word("inf".to_owned()),
            f64::NEG_INFINITY => Self::Word("-inf".to_owned()),
            value if value.is_nan() => Self::Nothing,
            value => Self::Number(value),
        }
    }

    fn number(self) -> f64 {
        match self {
            Self::Number(value) => value,
            Self::Word(word) => word.parse().unwrap_or(f64::NAN),
            Self::Nothing => f64::NAN,
        }
    }
}

mod bounded {
    use super::{Deserialize, Deserializer, Serialize, Serializer, Written};

    #[expect(clippy::trivially_copy_pass_by_ref, reason = "as serde calls it")]
    pub fn serialize<S: Serializer>(value: &f64, serializer: S) -> Result<S::Ok, S::Error> {
        Written::of(*value).serialize(serializer)
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
        Ok(Written::deserialize(deserializer)?.number())
    }
}

fn each_bounded<S: Serializer>(values: &[f64; 5], serializer: S) -> Result<S::Ok, S::Error> {
    values.map(Written::of).serialize(serializer)
}

fn each_read<'de, D: Deserializer<'de>>(deserializer: D) -> Result<[f64; 5], D::Error> {
    Ok(<[Written; 5]>::deserialize(deserializer)?.map(Written::number))
}

/// Statistics of samples; those that are no numbers do not count. `None` of fewer than two.
pub fn statistics(values: &[f64]) -> Option<Statistics> {
    let mut sorted: Vec<f64> = values.iter().copied().filter(|value| !value.is_nan()).collect();
    sorted.sort_by(f64::total_cmp);
    let count = sorted.len();
    let (first, last) = (*sorted.first()?, *sorted.last()?);
    if count < 2 {
        return None;
    }
    let mean = sorted.iter().sum::<f64>() / count as f64;
    let squares: f64 = sorted.iter().map(|value| (value - mean).powi(2)).sum();
    let quantile = |fraction: f64| {
        // Hazen: the n-th of the sorted samples stands for the fraction (n - 1/2)/count
        let place = (fraction * count as f64 - 0.5).clamp(0.0, (count - 1) as f64);
        let below = place.floor() as usize;
        let above = (below + 1).min(count - 1);
        let part = place - below as f64;
        // nothing of an infinite neighbour, or of one as infinite, is no number
        if part == 0.0 || sorted[above] == sorted[below] {
            sorted[below]
        } else {
            sorted[below] + part * (sorted[above] - sorted[below])
        }
    };
    Some(Statistics {
        count,
        mean,
        deviation: (squares / (count - 1) as f64).sqrt(),
        min: first,
        max: last,
        quantiles: QUANTILES.map(quantile),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::uncertainty::{Distribution, SampleDesign};

    #[test]
    fn quantiles_of_sobol_points_of_a_normal_number_are_those_of_tables() {
        let normal = Distribution::Normal { mean: 10.0, deviation: 2.0 };
        let design = SampleDesign { distributions: vec![normal], count: 4096, seed: 1, indices: false };
        let values: Vec<f64> = design.rows().unwrap().into_iter().flatten().chain([f64::NAN]).collect();
        let found = statistics(&values).unwrap();
        assert_eq!(found.count, 4096);
        // 1.96 and 0.6745 deviations; evenly spread points leave the spacing of the samples there
        for (quantile, deviations) in
            found.quantiles.iter().zip([-1.959_964, -0.674_490, 0.0, 0.674_490, 1.959_964])
        {
            assert!((quantile - 10.0 - 2.0 * deviations).abs() < 0.01, "{found:?}");
        }
        assert!((found.mean - 10.0).abs() < 1e-3 && (found.deviation - 2.0).abs() < 5e-3, "{found:?}");
        assert_eq!(statistics(&[1.0, f64::NAN]), None);
    }

    /// Lives of ten samples, of which three are endless: the median is that of all ten, and the files have words for the rest.
    #[test]
    fn endless_lives_count_among_the_samples() {
        let lives: Vec<f64> = (1..=7).map(f64::from).chain([f64::INFINITY; 3]).collect();
        let found = statistics(&lives).unwrap();
        assert_eq!((found.count, found.min, found.mean, found.max), (10, 1.0, f64::INFINITY, f64::INFINITY));
        assert_eq!(found.quantiles, [1.0, 3.0, 5.5, f64::INFINITY, f64::INFINITY]);
        assert!(found.deviation.is_nan());
        let written = serde_json::to_value(found).unwrap();
        assert_eq!(written["mean"], "inf");
        assert_eq!(written["quantiles"], serde_json::json!([1.0, 3.0, 5.5, "inf", "inf"]));
        assert!(written["deviation"].is_null());
        let read: Statistics = serde_json::from_value(written).unwrap();
        assert_eq!((read.mean, read.quantiles), (found.mean, found.quantiles));
        assert!(read.deviation.is_nan());
    }
}
