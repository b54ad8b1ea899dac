//! Bodies and reference numbers for tests: golden rows, seeded random stacks, short constructors.

use serde::Deserialize;

use crate::model::{Base, Body, Coating, ContactPair, ElasticMaterial, HalfSpace};

/// `(Young's modulus, Poisson's ratio)`
pub(crate) type Elasticity = (f64, f64);

pub(crate) fn material((young, poisson): Elasticity) -> ElasticMaterial {
    ElasticMaterial::new(young, poisson).unwrap()
}

/// Coatings `(E, nu, h)` from the surface down, on a substrate or a rigid base.
pub(crate) fn stack(layers: &[(f64, f64, f64)], substrate: Option<Elasticity>) -> HalfSpace {
    let coatings = layers.iter().map(|&(e, nu, h)| Coating::new(material((e, nu)), h).unwrap()).collect();
    HalfSpace::new(coatings, substrate.map_or(Base::Rigid, |elasticity| Base::Elastic(material(elasticity))))
        .unwrap()
}

/// A half-space under a rigid body.
pub(crate) fn under_rigid(half_space: HalfSpace) -> ContactPair {
    ContactPair::new(Body::Rigid, Body::Elastic(half_space)).unwrap()
}

/// Shorthand for a coated half-space under a rigid body.
pub(crate) fn pair(layers: &[(f64, f64, f64)], substrate: Option<Elasticity>) -> ContactPair {
    under_rigid(stack(layers, substrate))
}

/// The rows of a golden file.
pub(crate) fn golden<Row: for<'a> Deserialize<'a>>(name: &str) -> Vec<Row> {
    #[derive(Deserialize)]
    struct Table<Row> {
        rows: Vec<Row>,
    }
    let path = format!(concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/golden/{}"), name);
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
    serde_json::from_str::<Table<Row>>(&text).unwrap().rows
}

/// A seeded source of random numbers (splitmix64).
pub(crate) struct Random(u64);

impl Random {
    pub(crate) fn seeded(seed: u64) -> Self {
        Self(seed)
    }

    /// Uniform in `[0, 1)`.
    pub(crate) fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Uniform in the logarithm between two positive numbers.
    pub(crate) fn log_uniform(&mut self, least: f64, greatest: f64) -> f64 {
        least * (greatest / least).powf(self.uniform())
    }

    /// A whole number in `first..=last`.
    pub(crate) fn whole(&mut self, first: usize, last: usize) -> usize {
        first + (self.uniform() * (last - first + 1) as f64) as usize
    }

    /// Poisson's ratios with the awkward ones well represented.
    pub(crate) fn poisson(&mut self) -> f64 {
        match self.uniform() {
            u if u < 0.18 => 0.5,
            u if u < 0.28 => 0.5 - 10.0_f64.powf(-1.0 - 11.0 * self.uniform()),
            u if u < 0.38 => -0.9,
            u if u < 0.46 => 0.25,
            _ => -0.9 + 1.4 * self.uniform(),
        }
    }

    /// One to `most` coatings of total thickness one, moduli within `contrast`, thicknesses within three decades.
    pub(crate) fn half_space(&mut self, most: usize, contrast: f64, rigid: bool) -> HalfSpace {
        let count = self.whole(1, most);
        let mut layers: Vec<(f64, f64, f64)> = (0..count)
            .map(|_| (self.log_uniform(1.0, contrast), self.poisson(), self.log_uniform(1e-3, 1.0)))
            .collect();
        let total: f64 = layers.iter().map(|layer| layer.2).sum();
        for layer in &mut layers {
            layer.2 /= total;
        }
        let substrate = (self.log_uniform(1.0, contrast), self.poisson());
        stack(&layers, (!rigid).then_some(substrate))
    }
}
