//! Where under the surface: depths, each in one layer; at an interface one on each side.

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};

use crate::model::{Base, Dimension, HalfSpace, Periodicity, SurfaceGrid};

/// Depths that are chosen where none are given.
pub const AUTOMATIC: usize = 64;

/// How deep to look below a contact of so many loaded cells at the most: three times the radius, or half-width, of their area; in a period
/// half of its longer side [length].
pub fn reach(grid: &SurfaceGrid, periodic: Periodicity, loaded: usize) -> f64 {
    let ([width, length], dimension) = (grid.size(), grid.dimension());
    if periodic.is_both() {
        return 0.5 * width.max(length);
    }
    let area = loaded as f64 * grid.cell_area();
    let radius = dimension.radius(area);
    // What repeats along one axis may be a strip: half as wide as its area for the length of a period.
    let of_strip = periodic.one_axis().map_or(0.0, |axis| 0.5 * area / grid.size()[axis]);
    match dimension {
        _ if radius > 0.0 => 3.0 * radius.max(of_strip),
        Dimension::Plane => width.min(length),
        Dimension::Line => width,
    }
}

/// How a depth moves with the thicknesses of the coatings above it, whose derivatives by a parameter are given: one at an interface goes with
/// that; one that was chosen ([`automatic_depths`]) keeps its share of the layer, or of what is looked at down to `reach`; one that was given
/// stays.
pub fn deeper(half_space: &HalfSpace, point: DepthPoint, reach: Option<f64>, thicker: &[f64]) -> f64 {
    let faces = interfaces(half_space);
    let moves = |face: usize| thicker.iter().take(face + 1).sum::<f64>();
    if let Some(face) = faces.iter().position(|face| (point.depth - face).abs() <= AT_INTERFACE * face) {
        return moves(face);
    }
    let Some(reach) = reach else { return 0.0 };
    let above = point.layer.checked_sub(1);
    let (top, top_moves) = above.map_or((0.0, 0.0), |face| (faces[face], moves(face)));
    let (bottom, bottom_moves) = match faces.get(point.layer) {
        Some(&bottom) if bottom <= reach * (1.0 + AT_INTERFACE) => (bottom, moves(point.layer)),
        _ => (reach, 0.0),
    };
    let share = if bottom > top { (point.depth - top) / (bottom - top) } else { 0.0 };
    top_moves + share * (bottom_moves - top_moves)
}

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
    use crate::model::{Axis, Coating, ElasticMaterial};

    fn body(thicknesses: &[f64], rigid: bool) -> HalfSpace {
        let material = |young| ElasticMaterial::new(young, 0.3).unwrap();
        let coatings =
            thicknesses.iter().enumerate().map(|(n, h)| Coating::new(material(2.0 + n as f64), *h).unwrap());
        let base = if rigid { Base::Rigid } else { Base::Elastic(material(1.0)) };
        HalfSpace::new(coatings.collect(), base).unwrap()
    }

    /// Ten columns of a strip are as wide as ten cells of a line, whatever the period; balls in a row are looked at as one ball.
    #[test]
    fn below_a_strip_as_deep_as_below_a_line() {
        let strip = |columns: usize| SurfaceGrid::new([64, columns], [0.5, 0.5]).unwrap();
        let line = reach(&SurfaceGrid::new([64, 1], [0.5, 0.5]).unwrap(), Periodicity::NONE, 10);
        for columns in [2, 8, 16] {
            let found = reach(&strip(columns), Periodicity::Along(Axis::Y), 10 * columns);
            assert!(found >= line * (1.0 - 1e-12), "{columns}: {found} {line}");
        }
        assert_eq!(reach(&strip(2), Periodicity::Along(Axis::Y), 20), line);
        let of_ball = |periodic| reach(&strip(64), periodic, 12);
        assert_eq!(of_ball(Periodicity::Along(Axis::Y)), of_ball(Periodicity::NONE));
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

    /// Every depth of a body against the same one where a coating is a little thicker: rounding of differences of 1e-6.
    #[test]
    fn depths_move_with_the_layers() {
        let thickness = [0.3, 0.5];
        for (chosen, reach) in [(true, 3.0), (true, 0.6), (false, 3.0)] {
            let points = |thickness: &[f64]| {
                let body = body(thickness, false);
                let depths = [0.1, body.interfaces()[0], 0.7, body.interfaces()[1], 2.0];
                if chosen {
                    automatic_depths(&body, reach, 20)
                } else {
                    depth_points(&body, &depths).unwrap()
                }
            };
            for layer in 0..2 {
                let moved = |step: f64| {
                    let mut thickness = thickness;
                    thickness[layer] += step;
                    points(&thickness)
                };
                let mut thicker = [0.0; 2];
                thicker[layer] = 1.0;
                let here = points(&thickness);
                for (n, (up, down)) in moved(1e-6).iter().zip(&moved(-1e-6)).enumerate() {
                    let expected = (up.depth - down.depth) / 2e-6;
                    let found = deeper(&body(&thickness, false), here[n], chosen.then_some(reach), &thicker);
                    assert!((found - expected).abs() < 1e-8, "{reach} {layer} {n}: {found} {expected}");
                }
            }
        }
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
