//! Where displacements of a line contact are counted from: a point of each body below the load.

use super::depth_response::DepthResponse;
use crate::model::{Base, Body, ContactPair, ElasticMaterial, HalfSpace};

/// The displacement of the datum of both bodies by a line load above it: of the point `depth` below the load in every body with an
/// elastic base. A body on a rigid base has a zero of its own, and a rigid body does not move.
#[derive(Clone, Debug)]
pub(super) struct Datum {
    depth: f64,
    bodies: Vec<DepthResponse>,
    /// Whether each of these bodies is one material throughout, and its shear modulus.
    moduli: Option<Vec<f64>>,
}

impl Datum {
    /// The datum of a pair, `depth` \[length\] below both surfaces.
    pub(super) fn new(pair: &ContactPair, depth: f64) -> Self {
        let bodies = || {
            [pair.lower(), pair.upper()].into_iter().filter_map(|body| match body {
                Body::Elastic(half_space) if *half_space.base() != Base::Rigid => Some(half_space),
                _ => None,
            })
        };
        let modulus =
            |half_space: &HalfSpace| half_space.single_material().map(ElasticMaterial::shear_modulus);
        Self {
            depth,
            bodies: bodies()
                .map(|half_space| DepthResponse::new(half_space, layer_at(half_space, depth), depth))
                .collect(),
            moduli: bodies().map(modulus).collect(),
        }
    }

    /// Depth of the datum \[length\].
    pub(super) fn depth(&self) -> f64 {
        self.depth
    }

    /// The longest length of the problem \[length\].
    pub(super) fn longest_length(&self) -> f64 {
        self.bodies.iter().map(DepthResponse::longest_length).fold(self.depth, f64::max)
    }

    /// Displacement times k: `u_z` from pressure, `u_x` from `q_x`, `u_y` from `q_y`.
    pub(super) fn times_wavenumber(&self, k: f64) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for body in &self.bodies {
            let found = body.at(k);
            sum[0] += found.depthwise[1];
            sum[1] += found.tangential[0];
            sum[2] += found.sideways;
        }
        sum
    }

    /// What the datum adds to `D log(depth/x)` of homogeneous half-spaces, with the sign of a displacement of the datum: `1/(2 G)`
    /// along a normal force, minus that along a force across the line (Flamant; Johnson 1985, *Contact Mechanics*, 2.2). None
    /// when a body has layers.
    pub(super) fn constants(&self) -> Option<[f64; 3]> {
        let halves: f64 = self.moduli.as_ref()?.iter().map(|modulus| 0.5 / modulus).sum();
        Some([halves, -halves, 0.0])
    }
}

/// The layer in which a depth lies.
fn layer_at(half_space: &HalfSpace, depth: f64) -> usize {
    let mut below = 0.0;
    let inside = half_space.coatings().iter().position(|coating| {
        below += coating.thickness();
        depth <= below
    });
    inside.unwrap_or(half_space.coatings().len())
}
