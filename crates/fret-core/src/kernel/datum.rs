//! Where displacements of a line contact are counted from: a point of each body below the load.

use super::depth_response::DepthResponse;
use super::lattice_samples::{DepthChange, WaveResponse};
use super::stack_layer::LayerChanges;
use crate::fields::Dual;
use crate::model::{Base, Body, ContactPair, ElasticMaterial, HalfSpace};

/// The displacement of the datum of both bodies by a line load above it: of the point `depth` below the load in every body with an
/// elastic base. A body on a rigid base has a zero of its own, and a rigid body does not move. Or how that displacement changes with a
/// parameter.
pub(super) struct Datum<R = DepthResponse> {
    depth: f64,
    bodies: Vec<R>,
    /// `1/(2 G)` of all these bodies together, where each is one material throughout, or its derivative.
    halves: Option<f64>,
}

impl Datum {
    /// The datum of a pair, `depth` \[length\] below both surfaces.
    pub(super) fn new(pair: &ContactPair, depth: f64) -> Self {
        let bodies = || bodies_with_datum(pair).map(|(_, half_space)| half_space);
        let half = |half_space: &HalfSpace| {
            half_space.single_material().map(|material| 0.5 / ElasticMaterial::shear_modulus(material))
        };
        Self {
            depth,
            bodies: bodies()
                .map(|half_space| DepthResponse::new(half_space, layer_at(half_space, depth), depth))
                .collect(),
            halves: bodies().map(half).sum(),
        }
    }
}

impl Datum<DepthChange> {
    /// How it changes with a parameter, by the derivatives of the constants of the layers of the lower and of the upper body, from the surface down,
    /// those of the substrate last. The datum stays at its depth.
    pub(super) fn change(pair: &ContactPair, changes: [&[LayerChanges]; 2], depth: f64) -> Self {
        let bodies = || bodies_with_datum(pair).map(|(body, half_space)| (half_space, changes[body]));
        let half = |(half_space, changes): (&HalfSpace, &[LayerChanges])| {
            let material = half_space.single_material().filter(|_| half_space.coatings().is_empty())?;
            let change = changes.last().copied().unwrap_or_default();
            // 1/(2 G) = (1 + nu)/E
            let by_young = -(1.0 + material.poisson()) / (material.young() * material.young());
            Some(by_young * change.young + change.poisson / material.young())
        };
        let below = |(half_space, changes): (&HalfSpace, &[LayerChanges])| {
            DepthChange::new(half_space, changes, (layer_at(half_space, depth), Dual::new(depth, 0.0)))
        };
        Self { depth, bodies: bodies().map(below).collect(), halves: bodies().map(half).sum() }
    }
}

impl<R: WaveResponse> Datum<R> {
    /// Depth of the datum \[length\].
    pub(super) fn depth(&self) -> f64 {
        self.depth
    }

    /// The longest length of the problem \[length\].
    pub(super) fn longest_length(&self) -> f64 {
        self.bodies.iter().map(WaveResponse::longest_length).fold(self.depth, f64::max)
    }

    /// Displacement times k: `u_z` from pressure, `u_x` from `q_x`, `u_y` from `q_y`.
    pub(super) fn times_wavenumber(&self, k: f64) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for body in &self.bodies {
            let found = body.transfer(k);
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
        self.halves.map(|halves| [halves, -halves, 0.0])
    }
}

/// The bodies with an elastic base: which of both it is (0: lower, 1: upper), and its layers.
fn bodies_with_datum(pair: &ContactPair) -> impl Iterator<Item = (usize, &HalfSpace)> {
    [pair.lower(), pair.upper()].into_iter().enumerate().filter_map(|(number, body)| match body {
        Body::Elastic(half_space) if *half_space.base() != Base::Rigid => Some((number, half_space)),
        _ => None,
    })
}

/// The layer in which a depth lies.
fn layer_at(half_space: &HalfSpace, depth: f64) -> usize {
    half_space.interfaces().iter().filter(|below| **below < depth).count()
}

#[cfg(test)]
mod tests {
    use super::super::samples::{pair, stack};
    use super::*;

    #[test]
    fn a_datum_lies_in_every_body_with_an_elastic_base() {
        // displacements at the datum of both bodies together, by the response of each cut there: in the coating of the one
        // (depth 2 of 3), in the substrate of the other (depth 2 below 0.5)
        let (thick, thin) =
            (stack(&[(5.0, 0.2, 3.0)], Some((1.0, 0.2))), stack(&[(5.0, 0.2, 0.5)], Some((2.0, 0.4))));
        let both = ContactPair::new(Body::Elastic(thick.clone()), Body::Elastic(thin.clone())).unwrap();
        let datum = Datum::new(&both, 2.0);
        let cut = [DepthResponse::new(&thick, 0, 2.0), DepthResponse::new(&thin, 1, 2.0)];
        for k in [0.01, 0.3, 1.0, 4.0] {
            let [one, other] = cut.each_ref().map(|response| response.at(k));
            let exact = [
                one.depthwise[1] + other.depthwise[1],
                one.tangential[0] + other.tangential[0],
                one.sideways + other.sideways,
            ];
            for (found, exact) in datum.times_wavenumber(k).into_iter().zip(exact) {
                assert!((found - exact).abs() <= 1e-15 * exact.abs(), "{k}: {found} {exact}");
            }
        }
        assert_eq!(datum.depth(), 2.0);
        // 3 times 5 of the thicker coating; or the depth
        assert!((datum.longest_length() - 15.0).abs() < 1e-13);
        assert_eq!(Datum::new(&both, 20.0).longest_length(), 20.0);
        // a datum at an interface lies in the layer above it
        assert_eq!([3.0, 3.1].map(|depth| layer_at(&thick, depth)), [0, 1]);
        assert!(datum.constants().is_none());
    }

    #[test]
    fn bodies_without_an_elastic_base_have_no_datum() {
        let film = pair(&[(5.0, 0.2, 3.0)], None);
        let datum = Datum::new(&film, 2.0);
        assert_eq!(datum.times_wavenumber(1.0), [0.0; 3]);
        assert_eq!(datum.longest_length(), 2.0);
        // 1/(2 G) of Flamant's constants: G = 1 below, 4 above
        let below = || Body::Elastic(stack(&[], Some((2.5, 0.25))));
        let above = || Body::Elastic(stack(&[(10.0, 0.25, 1.0)], Some((10.0, 0.25))));
        let homogeneous = Datum::new(&ContactPair::new(above(), below()).unwrap(), 2.0);
        let [normal, across, along] = homogeneous.constants().unwrap();
        assert!((normal - 0.625).abs() < 1e-15 && across == -normal && along == 0.0);
    }
}
