//! The one seeded source of random numbers of all tests: the same numbers on every machine and under every version of its crate,
//! which promises that for this generator and for its seeding.

use rand_pcg::Pcg64;
use rand_pcg::rand_core::{Rng, SeedableRng};

/// Seeded random numbers.
#[derive(Debug, Clone)]
pub struct Random(Pcg64);

impl Random {
    /// The sequence of a seed.
    pub fn seeded(seed: u64) -> Self {
        Self(Pcg64::seed_from_u64(seed))
    }

    /// Any 64 bits.
    pub fn bits(&mut self) -> u64 {
        self.0.next_u64()
    }

    /// Uniform in `[0, 1)`.
    pub fn uniform(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Uniform between two numbers.
    pub fn between(&mut self, least: f64, greatest: f64) -> f64 {
        least + (greatest - least) * self.uniform()
    }

    /// Uniform in the logarithm between two positive numbers.
    pub fn log_uniform(&mut self, least: f64, greatest: f64) -> f64 {
        least * (greatest / least).powf(self.uniform())
    }

    /// A whole number in `first..=last`.
    pub fn whole(&mut self, first: usize, last: usize) -> usize {
        first + (self.uniform() * (last - first + 1) as f64) as usize
    }

    /// True in this fraction of all draws.
    pub fn chance(&mut self, fraction: f64) -> bool {
        self.uniform() < fraction
    }
}
