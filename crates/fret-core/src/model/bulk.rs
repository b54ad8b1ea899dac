//! Bulk stress: a remote stress of a body's substrate, and the strain that all of its layers share under it.

use super::dimension::Dimension;
use super::half_space::{Base, Body, ContactPair, ElasticMaterial, HalfSpace};
use crate::fields::{Scalar, Slopes};

/// Strains of the surfaces of a pair under the bulk stresses of its substrates.
///
/// A half-space under a remote stress strains evenly, and its layers with it: `e_x = (s_x - nu s_y) / E`; in plane strain
/// `e_x = s_x (1 - nu^2) / E`, `e_y = 0`, with the constants of the substrate.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct BulkCompliance {
    /// Of the lower body and of the upper one: strain along a stress and across it, per stress [1/pressure]; zero of a rigid body.
    bodies: [[f64; 2]; 2],
}

impl BulkCompliance {
    /// Bodies that do not strain.
    pub const NONE: Self = Self { bodies: [[0.0; 2]; 2] };

    /// That of a pair; in a line contact in plane strain.
    pub fn of(pair: &ContactPair, dimension: Dimension) -> Self {
        let of = |body: &Body| {
            let Some(material) = substrate(body) else { return [0.0; 2] };
            let (young, poisson) = (material.young(), material.poisson());
            match dimension {
                Dimension::Plane => [1.0 / young, -poisson / young],
                Dimension::Line => [(1.0 - poisson * poisson) / young, 0.0],
            }
        };
        Self { bodies: [of(pair.lower()), of(pair.upper())] }
    }

    /// The derivative of that of a pair by Young's modulus (0) or Poisson's ratio (1) of the substrate of a body (0: lower, 1: upper).
    pub fn slope(pair: &ContactPair, dimension: Dimension, body: usize, constant: usize) -> Self {
        let mut bodies = [[0.0; 2]; 2];
        if let Some(material) = substrate([pair.lower(), pair.upper()][body]) {
            let (young, poisson) = (material.young(), material.poisson());
            let plane = 1.0 - poisson * poisson;
            bodies[body] = match (dimension, constant) {
                (Dimension::Plane, 0) => [-1.0 / (young * young), poisson / (young * young)],
                (Dimension::Plane, _) => [0.0, -1.0 / young],
                (Dimension::Line, 0) => [-plane / (young * young), 0.0],
                (Dimension::Line, _) => [-2.0 * poisson / young, 0.0],
            };
        }
        Self { bodies }
    }

    /// Strain of the lower surface less that of the upper one along x and y [-], under the bulk stresses `[lower, upper]`, each along
    /// x and y [pressure].
    pub fn relative_strain(&self, stress: [[f64; 2]; 2]) -> [f64; 2] {
        let [lower, upper] = [0, 1].map(|body| {
            let [along, across] = self.bodies[body];
            let [x, y] = stress[body];
            [along * x + across * y, along * y + across * x]
        });
        [lower[0] - upper[0], lower[1] - upper[1]]
    }

    /// Whether a stress of a body (0: lower, 1: upper) along an axis strains it along another.
    pub fn strains(&self, body: usize, stress_axis: usize, axis: usize) -> bool {
        self.bodies[body][usize::from(stress_axis != axis)] != 0.0
    }
}

/// The material of a body's substrate; none of a rigid body, or of layers on a rigid base.
pub fn substrate(body: &Body) -> Option<&ElasticMaterial> {
    match body {
        Body::Rigid => None,
        Body::Elastic(half_space) => match half_space.base() {
            Base::Elastic(material) => Some(material),
            Base::Rigid => None,
        },
    }
}

/// Stress along x and y [pressure] in a layer of a half-space whose substrate is under a bulk stress along x and y [pressure]:
/// `E_i / (1 - nu_i^2) (e_x + nu_i e_y)` under the strain that all layers share. Nothing on a rigid base.
pub fn bulk_stress_in_layer(
    half_space: &HalfSpace,
    layer: usize,
    bulk_stress: [f64; 2],
    dimension: Dimension,
) -> [f64; 2] {
    let Base::Elastic(base) = half_space.base() else { return [0.0; 2] };
    let material = half_space.coatings().get(layer).map_or(base, |coating| coating.material());
    if material == base && dimension == Dimension::Plane {
        return bulk_stress;
    }
    let of = |material: &ElasticMaterial| [material.young(), material.poisson()];
    stress_under_one_strain(bulk_stress, [of(base), of(material)], dimension)
}

/// Derivatives of that stress along x and y by Young's modulus and Poisson's ratio of the substrate, and by those of the layer.
pub fn slopes_of_bulk_stress_in_layer(
    half_space: &HalfSpace,
    layer: usize,
    bulk_stress: [f64; 2],
    dimension: Dimension,
) -> [[f64; 4]; 2] {
    let Base::Elastic(base) = half_space.base() else { return [[0.0; 4]; 2] };
    let material = half_space.coatings().get(layer).map_or(base, |coating| coating.material());
    let inputs = [base.young(), base.poisson(), material.young(), material.poisson()];
    let [base_young, base_poisson, young, poisson] = Slopes::<4>::of_each(inputs);
    let stress = bulk_stress.map(Scalar::of);
    stress_under_one_strain(stress, [[base_young, base_poisson], [young, poisson]], dimension)
        .map(|part| part.by)
}

/// Stress of a layer along x and y under the strain of a substrate under a stress; of both Young's modulus and Poisson's ratio.
fn stress_under_one_strain<R: Scalar>(
    [x, y]: [R; 2],
    [[young, poisson], [of_layer, nu]]: [[R; 2]; 2],
    dimension: Dimension,
) -> [R; 2] {
    let one = R::of(1.0);
    let [along_x, along_y] = match dimension {
        Dimension::Plane => [(x - poisson * y) / young, (y - poisson * x) / young],
        Dimension::Line => [x * (one - poisson * poisson) / young, R::of(0.0)],
    };
    let stiffness = of_layer / (one - nu * nu);
    [stiffness * (along_x + nu * along_y), stiffness * (along_y + nu * along_x)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Coating;

    /// By hand: E = 2, nu = 0.25 under s = (1, 0): e = (0.5, -0.125); plane strain: e = (15/32, 0).
    #[test]
    fn all_layers_share_the_strain_of_the_substrate() {
        let base = ElasticMaterial::new(2.0, 0.25).unwrap();
        let coat = ElasticMaterial::new(3.0, 0.5).unwrap();
        let body = HalfSpace::new(vec![Coating::new(coat, 1.0).unwrap()], Base::Elastic(base)).unwrap();
        let pair = ContactPair::new(Body::Rigid, Body::Elastic(body.clone())).unwrap();
        let loads = [[1.0, 0.0], [7.0, 7.0]];
        assert_eq!(BulkCompliance::of(&pair, Dimension::Plane).relative_strain(loads), [0.5, -0.125]);
        assert_eq!(BulkCompliance::of(&pair, Dimension::Line).relative_strain(loads), [15.0 / 32.0, 0.0]);
        assert_eq!(bulk_stress_in_layer(&body, 1, [1.0, 0.0], Dimension::Plane), [1.0, 0.0]);
        assert_eq!(bulk_stress_in_layer(&body, 0, [1.0, 0.0], Dimension::Plane), [4.0 * 0.4375, 4.0 * 0.125]);
        assert_eq!(bulk_stress_in_layer(&body, 1, [1.0, 0.0], Dimension::Line), [1.0, 0.25]);
    }

    #[test]
    fn two_bodies_stretched_alike_do_not_slip() {
        let base = ElasticMaterial::new(2.0, 0.25).unwrap();
        let body = || Body::Elastic(HalfSpace::homogeneous(base));
        let pair = ContactPair::new(body(), body()).unwrap();
        assert_eq!(BulkCompliance::of(&pair, Dimension::Plane).relative_strain([[1.0, 3.0]; 2]), [0.0; 2]);
    }
}
