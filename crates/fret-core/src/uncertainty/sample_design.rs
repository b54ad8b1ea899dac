//! Which values uncertain numbers take in the samples of a study: Sobol' points.

use serde::{Deserialize, Serialize};

use super::distribution::Distribution;

/// Samples at the most: beyond them the points are no longer spread evenly.
pub const MOST_SAMPLES: usize = 1 << 16;
/// Uncertain numbers at the most; with Sobol' indices half as many.
const MOST_NUMBERS: usize = sobol_burley::NUM_DIMENSIONS as usize;

/// Why a design was refused.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum DesignError {
    /// No distribution.
    #[error("no key has a distribution")]
    Nothing,
    /// A number of samples out of range.
    #[error("{0} samples: between 2 and {MOST_SAMPLES} are allowed")]
    Count(usize),
    /// Too many uncertain numbers.
    #[error("{0} uncertain keys: too many for one set of Sobol' points")]
    Numbers(usize),
}

/// Samples of some uncertain numbers that do not depend on each other.
///
/// Points of Sobol' (1967), scrambled as of Owen (1995) by a hash of the seed (Burley 2020, J. Comput. Graph. Tech. 9, 4): the same seed,
/// the same points; a power of two of them is spread most evenly. For Sobol' indices the blocks A, B and, for every number i, A with the
/// i-th column of B: `count (numbers + 2)` rows (Saltelli et al. 2010, Comput. Phys. Commun. 181, 259).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SampleDesign {
    /// Distributions of the numbers.
    pub distributions: Vec<Distribution>,
    /// Samples of one block.
    pub count: usize,
    /// Chooses one set of points of many.
    pub seed: u32,
    /// Whether blocks for Sobol' indices are added.
    pub indices: bool,
}

impl SampleDesign {
    /// The values of every number in every sample, row by row.
    ///
    /// # Errors
    /// When there are too few or too many samples or numbers.
    pub fn rows(&self) -> Result<Vec<Vec<f64>>, DesignError> {
        let numbers = self.distributions.len();
        if numbers == 0 {
            return Err(DesignError::Nothing);
        }
        if !(2..=MOST_SAMPLES).contains(&self.count) {
            return Err(DesignError::Count(self.count));
        }
        if numbers * if self.indices { 2 } else { 1 } > MOST_NUMBERS {
            return Err(DesignError::Numbers(numbers));
        }
        let block = |exchanged: &dyn Fn(usize) -> bool| {
            let row = |sample: usize| {
                let value = |number: usize| {
                    let dimension = if exchanged(number) { number + numbers } else { number };
                    self.distributions[number].quantile(self.fraction(sample, dimension))
                };
                (0..numbers).map(value).collect::<Vec<f64>>()
            };
            (0..self.count).map(row).collect::<Vec<_>>()
        };
        let mut rows = block(&|_| false);
        if self.indices {
            rows.extend(block(&|_| true));
            for one in 0..numbers {
                rows.extend(block(&|number| number == one));
            }
        }
        Ok(rows)
    }

    /// Number of rows.
    pub fn points(&self) -> usize {
        self.count * if self.indices { self.distributions.len() + 2 } else { 1 }
    }

    /// A coordinate of a point, between 0 and 1 and neither of them.
    fn fraction(&self, sample: usize, dimension: usize) -> f64 {
        let coordinate = sobol_burley::sample(sample as u32, dimension as u32, self.seed);
        // coordinates are multiples of 2^-24 from 0 on: the middle of each step
        f64::from(coordinate) + 0.5_f64.powi(25)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn design(numbers: usize, count: usize, seed: u32, indices: bool) -> SampleDesign {
        SampleDesign {
            distributions: vec![Distribution::Uniform { from: 0.0, to: 1.0 }; numbers],
            count,
            seed,
            indices,
        }
    }

    #[test]
    fn a_power_of_two_of_points_has_one_in_every_part_of_an_axis() {
        let rows = design(6, 64, 3, false).rows().unwrap();
        for number in 0..6 {
            let mut hit = [0; 64];
            for row in &rows {
                hit[(row[number] * 64.0) as usize] += 1;
            }
            assert!(hit.iter().all(|count| *count == 1), "{number}: {hit:?}");
        }
    }

    #[test]
    fn the_seed_decides_and_blocks_share_their_columns() {
        let one = design(3, 16, 7, true).rows().unwrap();
        assert_eq!(one, design(3, 16, 7, true).rows().unwrap());
        assert_ne!(one, design(3, 16, 8, true).rows().unwrap());
        assert_eq!(one.len(), 16 * 5);
        for sample in 0..16 {
            let at = |block: usize| &one[16 * block + sample];
            assert_eq!(at(3), &vec![at(0)[0], at(1)[1], at(0)[2]]);
        }
        assert!(design(0, 16, 0, false).rows().is_err() && design(1, 1, 0, false).rows().is_err());
    }
}
