//! Residual stress of the layers of a body: what is in them before anything touches.

use serde::{Deserialize, Serialize};

use super::half_space::{Coating, HalfSpace};

/// Residual stresses of a body, layer by layer as a case names them. They balance each other in the body and move no surface.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct ResidualStress {
    layers: Vec<ResidualLayer>,
}

/// The residual stress of one layer over its depth.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ResidualLayer {
    /// Depth of the layer's upper face [length].
    pub top: f64,
    /// Rows of depth below that face [length] and stress along x and y [pressure], tension positive; linear between them, even beyond.
    pub rows: Vec<(f64, [f64; 2])>,
}

impl ResidualStress {
    /// Residual stress of layers, from the surface down; of a layer without rows none.
    pub fn new(layers: Vec<ResidualLayer>) -> Self {
        let is_none = layers.iter().all(|layer| layer.rows.is_empty());
        Self { layers: if is_none { Vec::new() } else { layers } }
    }

    /// Whether there is none.
    pub fn is_none(&self) -> bool {
        self.layers.is_empty()
    }

    /// Stress along x and y at a depth seen from a layer of the body [pressure].
    pub fn at(&self, half_space: &HalfSpace, layer: usize, depth: f64) -> [f64; 2] {
        self.layer(half_space, layer).map_or([0.0; 2], |named| named.at(depth - named.top))
    }

    /// How that changes with the depth below the upper face of the layer [pressure/length].
    pub fn slope(&self, half_space: &HalfSpace, layer: usize, depth: f64) -> [f64; 2] {
        self.layer(half_space, layer).map_or([0.0; 2], |named| named.slope(depth - named.top))
    }

    fn layer(&self, half_space: &HalfSpace, layer: usize) -> Option<&ResidualLayer> {
        self.named(half_space, layer).map(|named| &self.layers[named])
    }

    /// The layers as a case names them, from the surface down; none where there is no residual stress.
    pub fn layers(&self) -> &[ResidualLayer] {
        &self.layers
    }

    /// Which of them holds a layer of the half-space.
    pub fn named(&self, half_space: &HalfSpace, layer: usize) -> Option<usize> {
        // A graded coating is many layers of the half-space: the one that is named holds the middle of each.
        let above: f64 = half_space.coatings().iter().take(layer).map(Coating::thickness).sum();
        let middle = half_space
            .coatings()
            .get(layer)
            .map_or(f64::INFINITY, |coating| above + 0.5 * coating.thickness());
        self.layers.iter().rposition(|named| named.top <= middle)
    }
}

impl ResidualLayer {
    /// Stress along x and y, where it is the same in all its depth [pressure].
    pub fn even(&self) -> Option<[f64; 2]> {
        if let [(_, stress)] = self.rows[..] { Some(stress) } else { None }
    }

    fn at(&self, depth: f64) -> [f64; 2] {
        let (Some(first), Some(last)) = (self.rows.first(), self.rows.last()) else { return [0.0; 2] };
        if depth <= first.0 {
            return first.1;
        }
        let pair = self.rows.windows(2).find(|pair| depth <= pair[1].0);
        let Some([(from, above), (to, below)]) = pair.and_then(|pair| <&[_; 2]>::try_from(pair).ok()) else {
            return last.1;
        };
        let fraction = (depth - from) / (to - from);
        [0, 1].map(|axis| above[axis] + fraction * (below[axis] - above[axis]))
    }

    fn slope(&self, depth: f64) -> [f64; 2] {
        let pair = self.rows.windows(2).find(|pair| pair[0].0 < depth && depth <= pair[1].0);
        let Some([(from, above), (to, below)]) = pair.and_then(|pair| <&[_; 2]>::try_from(pair).ok()) else {
            return [0.0; 2];
        };
        [0, 1].map(|axis| (below[axis] - above[axis]) / (to - from))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Base, ElasticMaterial};

    /// A coating of two sublayers with -3, on a substrate with a table from -2 to 0 over a depth of 4.
    #[test]
    fn each_layer_has_its_own_stress_on_both_sides_of_an_interface() {
        let material = |young| ElasticMaterial::new(young, 0.3).unwrap();
        let coating = |young| Coating::new(material(young), 0.5).unwrap();
        let body = HalfSpace::new(vec![coating(3.0), coating(2.0)], Base::Elastic(material(1.0))).unwrap();
        let residual = ResidualStress::new(vec![
            ResidualLayer { top: 0.0, rows: vec![(0.0, [-3.0, -1.0])] },
            ResidualLayer { top: 1.0, rows: vec![(0.0, [-2.0, -2.0]), (4.0, [0.0, 0.0])] },
        ]);
        let at = |layer, depth| residual.at(&body, layer, depth);
        assert_eq!([at(0, 0.0), at(0, 0.5), at(1, 0.5), at(1, 1.0)], [[-3.0, -1.0]; 4]);
        assert_eq!(at(2, 1.0), [-2.0, -2.0]);
        assert_eq!(at(2, 2.0), [-1.5, -1.5]);
        let slope = |layer, depth| residual.slope(&body, layer, depth);
        assert_eq!([slope(1, 0.7), slope(2, 2.0), slope(2, 6.0)], [[0.0; 2], [0.5; 2], [0.0; 2]]);
        assert_eq!(at(2, 9.0), [0.0, 0.0]);
        assert_eq!(ResidualStress::default().at(&body, 1, 0.7), [0.0, 0.0]);
    }
}
