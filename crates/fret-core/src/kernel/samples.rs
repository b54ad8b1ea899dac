//! Bodies and reference numbers for tests: golden rows, seeded random stacks, short constructors.

use serde::Deserialize;

use crate::model::{Base, Body, Coating, ContactPair, ElasticMaterial, HalfSpace, Interface};
pub(crate) use crate::random::Random;

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

/// Normal and shear stiffness of the springs below each coating, `None` where it is bonded; shear stiffness 0: no shear passes.
pub(crate) type Springs = Option<(Option<f64>, Option<f64>)>;

/// The same half-space on springs, from the surface down.
pub(crate) fn on_springs(half_space: &HalfSpace, springs: &[Springs]) -> HalfSpace {
    let interface = |springs: &Springs| {
        springs.map_or(Interface::BONDED, |(normal, shear)| Interface::springs(normal, shear).unwrap())
    };
    let coatings = half_space.coatings().iter().zip(springs);
    let coatings = coatings.map(|(coating, springs)| coating.on(interface(springs))).collect();
    HalfSpace::new(coatings, *half_space.base()).unwrap()
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

impl Random {
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

    /// The same half-space, each layer on springs as stiff as itself within a factor of `contrast`.
    pub(crate) fn on_springs(&mut self, half_space: &HalfSpace, contrast: f64) -> HalfSpace {
        let mut stiffness = |coating: &Coating| {
            let own = coating.material().young() / coating.thickness();
            Some(own * self.log_uniform(1.0 / contrast, contrast))
        };
        let springs: Vec<Springs> = half_space
            .coatings()
            .iter()
            .map(|coating| Some((stiffness(coating), stiffness(coating))))
            .collect();
        on_springs(half_space, &springs)
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
