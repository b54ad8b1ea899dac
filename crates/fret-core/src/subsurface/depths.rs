//! Where under the surface: depths, each in one layer; at an interface one on each side.

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};

use crate::model::{Base, HalfSpace};

/// Relative distance from an interface that counts as rounding of decimal numbers.
const AT_INTERFACE: f64 = 1e-9;

/// A depth seen from one layer.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct DepthPoint {
    /// Depth under the surface [length].
    pub depth: f64,
    /// The layer: 0 is the outermost coating; the number of coatings is the substrate.
    pub layer: usize,
}

/// Why a depth was refused.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum DepthError {
    /// A negative depth, or none at all.
    #[error("depth {0:?} lies above the surface: depths count from the surface into the body, from 0 on")]
    AboveSurface(f64),
    /// Not a finite number.
    #[error("depth {0:?}: must be a finite length")]
    NotFinite(f64),
    /// Below the coatings of a body on a rigid base.
    #[error("depth {depth:?} lies in the rigid base: the coatings end at {end:?}")]
    InRigidBase {
        /// The depth.
        depth: f64,
        /// Thickness of all coatings.
        end: f64,
    },
    /// No depth given.
    #[error("no depth given")]
    None,
}

/// Depths of the interfaces, from the surface down.
fn interfaces(half_space: &HalfSpace) -> Vec<f64> {
    let mut depth = 0.0;
    let thicknesses = half_space.coatings().iter().map(super::super::model::half_space::Coating::thickness);
    thicknesses
        .map(|thickness| {
            depth += thickness;
            depth
        })
        .collect()
}

/// The points at given depths, in their order; at an interface two of them, first the upper side, then the lower.
///
/// # Errors
/// When there is no depth, or one is negative, not finite, or lies in a rigid base.
pub fn depth_points(half_space: &HalfSpace, depths: &[f64]) -> Result<Vec<DepthPoint>, DepthError> {
    if depths.is_empty() {
        return Err(DepthError::None);
    }
    let interfaces = interfaces(half_space);
    let rigid = matches!(half_space.base(), Base::Rigid);
    let mut points = Vec::with_capacity(depths.len());
    for &depth in depths {
        if !depth.is_finite() {
            return Err(DepthError::NotFinite(depth));
        }
        if depth < 0.0 {
            return Err(DepthError::AboveSurface(depth));
        }
        let at = interfaces.iter().position(|face| (depth - face).abs() <= AT_INTERFACE * face);
        if let Some(face) = at {
            let depth = interfaces[face];
            points.push(DepthPoint { depth, layer: face });
            if !(rigid && face + 1 == interfaces.len()) {
                points.push(DepthPoint { depth, layer: face + 1 });
            }
            continue;
        }
        let layer = interfaces.iter().filter(|face| depth > **face).count();
        if rigid && layer == interfaces.len() {
            let end = interfaces.last().copied().unwrap_or(0.0);
            return Err(DepthError::InRigidBase { depth, end });
        }
        points.push(DepthPoint { depth, layer });
    }
    Ok(points)
}

/// About `count` points down to `reach` \[length\] (or the rigid base), denser toward the surface and toward every interface, which
/// is seen from both sides.
pub fn automatic_depths(half_space: &HalfSpace, reach: f64, count: usize) -> Vec<DepthPoint> {
    let faces = interfaces(half_space);
    let rigid = matches!(half_space.base(), Base::Rigid);
    let thickness = faces.last().copied().unwrap_or(0.0);
    let reach = if rigid { reach.min(thickness) } else { reach };
    // thin coatings get their share by the logarithm of their thickness, so that none is lost
    let mut pieces = Vec::new();
    let mut top = 0.0;
    for (layer, &bottom) in faces.iter().enumerate() {
        if bottom <= reach * (1.0 + AT_INTERFACE) {
            pieces.push((layer, top, bottom, true));
            top = bottom;
        } else {
            pieces.push((layer, top, reach, false));
            top = reach;
            break;
        }
    }
    if top < reach && !rigid {
        pieces.push((faces.len(), top, reach, false));
    }
    let weight = |top: f64, bottom: f64| 0.25 + ((bottom - top) / reach).sqrt();
    let all: f64 = pieces.iter().map(|&(_, top, bottom, _)| weight(top, bottom)).sum();
    let mut points = Vec::new();
    for &(layer, top, bottom, to_interface) in &pieces {
        let steps = ((count as f64 * weight(top, bottom) / all).round() as usize).max(4) - 1;
        for n in 0..=steps {
            let share = n as f64 / steps as f64;
            let graded =
                if to_interface { 0.5 * (1.0 - (PI * share).cos()) } else { share * (0.3 + 0.7 * share) };
            let depth = if n == steps { bottom } else { top + (bottom - top) * graded };
            points.push(DepthPoint { depth, layer });
        }
    }
    points
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Coating, ElasticMaterial};

    fn body(thicknesses: &[f64], rigid: bool) -> HalfSpace {
        let material = |young| ElasticMaterial::new(young, 0.3).unwrap();
        let coatings =
            thicknesses.iter().enumerate().map(|(n, h)| Coating::new(material(2.0 + n as f64), *h).unwrap());
        let base = if rigid { Base::Rigid } else { Base::Elastic(material(1.0)) };
        HalfSpace::new(coatings.collect(), base).unwrap()
    }

    #[test]
    fn interfaces_are_seen_from_both_sides() {
        let points = depth_points(&body(&[0.1, 0.2], false), &[0.0, 0.1, 0.3, 0.5]).unwrap();
        let layers: Vec<usize> = points.iter().map(|point| point.layer).collect();
        assert_eq!(layers, [0, 0, 1, 1, 2, 2]); // 0.1 + 0.2 is not 0.3 in binary
        let points = depth_points(&body(&[0.1, 0.2], true), &[0.1, 0.3]).unwrap();
        assert_eq!(points.iter().map(|point| point.layer).collect::<Vec<_>>(), [0, 1, 1]);
    }

    #[test]
    fn impossible_depths_are_refused() {
        assert_eq!(depth_points(&body(&[1.0], false), &[-1e-9]), Err(DepthError::AboveSurface(-1e-9)));
        assert!(matches!(
            depth_points(&body(&[1.0], true), &[1.1]),
            Err(DepthError::InRigidBase { end: 1.0, .. })
        ));
        assert!(depth_points(&body(&[1.0], false), &[f64::NAN]).is_err());
        assert_eq!(depth_points(&body(&[1.0], false), &[]), Err(DepthError::None));
    }

    #[test]
    fn automatic_depths_are_graded_and_complete() {
        for (thicknesses, rigid, reach) in
            [(&[][..], false, 3.0), (&[0.01], false, 3.0), (&[100.0], false, 3.0), (&[0.5, 0.1], true, 3.0)]
        {
            let points = automatic_depths(&body(thicknesses, rigid), reach, 64);
            assert!((50..90).contains(&points.len()), "{}", points.len());
            assert!(points.windows(2).all(|pair| pair[0].depth <= pair[1].depth));
            assert_eq!(points[0], DepthPoint { depth: 0.0, layer: 0 });
            let first = points[1].depth;
            assert!(first < 0.03 * reach);
            let given: Vec<f64> = points.iter().map(|point| point.depth).collect();
            assert!(depth_points(&body(thicknesses, rigid), &given).is_ok());
        }
    }
}
