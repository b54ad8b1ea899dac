//! The path of a short crack: from the most severe place of the surface along its critical plane, and the stress on it.

use super::crack::CrackPath;
use super::depths::{DepthError, depth_points};
use super::edge_crack::STEEPEST;
use super::severity::MostSevere;
use super::survey::{LoadedSurface, survey};
use super::tensor::StressTensor;
use crate::model::{Dimension, HalfSpace, Periodicity, SurfaceGrid};
use fret_fft::ConvolutionError;

/// Depths at which the stress along a crack is computed, denser towards the surface; interfaces besides.
const DEPTHS: usize = 40;

/// Why no crack was followed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NoCrack {
    /// No plane is under tension at any point of the surface.
    #[error("no plane at the surface is under tension in the cycle")]
    NoTension,
    /// The critical plane is nearly parallel to the surface.
    #[error(
        "the critical plane leaves the normal of the surface by {0:.0} degrees: cracks are followed up to 60"
    )]
    TooInclined(f64),
    /// The crack would leave the part of the surface that the grid covers.
    #[error("the crack would leave the grid before its final length")]
    LeavesGrid,
    /// Its final length lies in a rigid base.
    #[error(transparent)]
    Depth(#[from] DepthError),
    /// A kernel is not finite.
    #[error(transparent)]
    Kernel(#[from] ConvolutionError),
    /// The caller stopped it.
    #[error("stopped")]
    Stopped,
}

/// Where a crack starts and how it goes on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CrackStart {
    /// Place on the surface [cells], from the centre of the first cell.
    pub place: [f64; 2],
    /// Angle from the inward normal of the surface towards `horizontal` [radians].
    pub angle: f64,
    /// Unit vector in the surface, in a line contact `[1, 0]`.
    pub horizontal: [f64; 2],
}

impl CrackStart {
    /// From the most severe place of the surface by Smith, Watson and Topper, along its critical plane.
    ///
    /// # Errors
    /// Without tension, or where the plane leaves the normal of the surface by more than [`STEEPEST`].
    pub fn of(severe: &MostSevere, dimension: Dimension) -> Result<Self, NoCrack> {
        let Some([x, y, z]) = severe.normal.filter(|_| severe.value > 0.0) else {
            return Err(NoCrack::NoTension);
        };
        let (across, towards) = match dimension {
            Dimension::Plane => (x.hypot(y), [x, y]),
            Dimension::Line => (x.abs(), [x, 0.0]),
        };
        let angle = (-z).atan2(across);
        if angle.is_nan() || angle.abs() > STEEPEST {
            return Err(NoCrack::TooInclined(angle.abs().to_degrees()));
        }
        // of the two opposite normals the one towards +x
        let sign = if towards[0] < 0.0 || (towards[0] == 0.0 && towards[1] < 0.0) { -1.0 } else { 1.0 };
        let place = [0, 1].map(|axis| severe.cell[axis] as f64 + severe.off[axis]);
        Ok(Self { place, angle: sign * angle, horizontal: towards.map(|part| sign * part / across) })
    }

    /// Place at a depth [cells].
    fn at(&self, depth: f64, grid: &SurfaceGrid) -> [f64; 2] {
        let aside = depth * self.angle.tan();
        [0, 1].map(|axis| self.place[axis] + aside * self.horizontal[axis] / grid.spacing()[axis])
    }
}

/// Stress along a crack of a length through the surfaces of a cycle, linear between the centres of cells. `goes_on` is asked once a depth.
///
/// # Errors
/// Where the crack leaves the grid or enters a rigid base, and when it was stopped.
pub fn crack_path(
    half_space: &HalfSpace,
    (grid, periodic): (&SurfaceGrid, Periodicity),
    start: &CrackStart,
    length: f64,
    cycle: &[LoadedSurface],
    mut goes_on: impl FnMut() -> bool,
) -> Result<CrackPath, NoCrack> {
    let deepest = length * start.angle.cos();
    let inside = |place: [f64; 2]| {
        [0, 1].iter().all(|&axis| {
            let last = (grid.cells()[axis] - 1) as f64;
            last == 0.0 || (-0.5..=last + 0.5).contains(&place[axis])
        })
    };
    if !inside(start.at(deepest, grid)) || !inside(start.place) {
        return Err(NoCrack::LeavesGrid);
    }
    let mut depths: Vec<f64> =
        (0..=DEPTHS).map(|n| deepest * (n as f64 / DEPTHS as f64) * (n as f64 / DEPTHS as f64)).collect();
    depths.extend(half_space.interfaces().into_iter().filter(|face| *face < deepest));
    depths.sort_by(f64::total_cmp);
    let points = depth_points(half_space, &depths)?;
    let mut stress = vec![Vec::with_capacity(points.len()); cycle.len()];
    let mut asked = true;
    survey(half_space, grid, periodic, &points, cycle, |point, surface, field| {
        if surface == 0 {
            asked = goes_on();
        }
        let place = start.at(points[point].depth, grid);
        stress[surface].push(between_cells(&|i, j| field.at(i, j), place, grid.cells()));
        asked
    })?;
    if !asked {
        return Err(NoCrack::Stopped);
    }
    let depths = points.iter().map(|point| point.depth).collect();
    Ok(CrackPath { angle: start.angle, horizontal: start.horizontal, depths, stress })
}

/// A stress between the centres of cells.
fn between_cells(
    at: &impl Fn(usize, usize) -> StressTensor,
    place: [f64; 2],
    cells: [usize; 2],
) -> StressTensor {
    let split = |axis: usize| {
        let low = (place[axis].max(0.0) as usize).min(cells[axis].saturating_sub(2));
        let high = (low + 1).min(cells[axis] - 1);
        (low, high, (place[axis] - low as f64).clamp(0.0, 1.0))
    };
    let [(left, right, u), (front, back, v)] = [split(0), split(1)];
    let corners = [(left, front), (right, front), (left, back), (right, back)].map(|(i, j)| at(i, j).0);
    let weights = [(1.0 - u) * (1.0 - v), u * (1.0 - v), (1.0 - u) * v, u * v];
    StressTensor(std::array::from_fn(|part| {
        corners.iter().zip(weights).map(|(corner, weight)| weight * corner[part]).sum()
    }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::subsurface::DepthPoint;
    use crate::subsurface::fatigue::Parameter;

    fn severe(normal: [f64; 3], value: f64) -> MostSevere {
        MostSevere {
            parameter: Parameter::SmithWatsonTopper,
            value,
            normal: Some(normal),
            cell: [7, 3],
            off: [0.5, 0.0],
            point: DepthPoint { depth: 0.0, layer: 0 },
            cycles: None,
            factor_of_safety: None,
            of_cells: value,
            cycles_of_cells: None,
        }
    }

    #[test]
    fn a_crack_lies_in_its_critical_plane_whichever_normal_names_it() {
        let (s, c) = 0.4_f64.sin_cos();
        for sign in [1.0, -1.0] {
            // the direction (sin, 0, cos) lies in the plane with the normal (cos, 0, -sin)
            let start = CrackStart::of(&severe([sign * c, 0.0, -sign * s], 1.0), Dimension::Line).unwrap();
            assert!((start.angle - 0.4).abs() < 1e-15 && start.horizontal == [1.0, 0.0]);
            assert_eq!(start.place, [7.5, 3.0]);
            let turned = CrackStart::of(&severe([0.0, -sign * c, -sign * s], 1.0), Dimension::Plane).unwrap();
            assert!((turned.angle + 0.4).abs() < 1e-15 && turned.horizontal == [0.0, 1.0]);
        }
        assert_eq!(CrackStart::of(&severe([1.0, 0.0, 0.0], 0.0), Dimension::Line), Err(NoCrack::NoTension));
        assert!(matches!(
            CrackStart::of(&severe([0.1, 0.0, 0.99], 1.0), Dimension::Line),
            Err(NoCrack::TooInclined(_))
        ));
    }

    #[test]
    fn stress_between_cells_is_linear() {
        let at = |i: usize, j: usize| StressTensor([2.0 * i as f64 - 3.0 * j as f64; 6]);
        for place in [[0.25, 1.5], [3.0, 0.0], [2.75, 3.0]] {
            let found = between_cells(&at, place, [4, 4]).0[0];
            assert!((found - (2.0 * place[0] - 3.0 * place[1])).abs() < 1e-15);
        }
        assert_eq!(between_cells(&at, [1.5, 0.0], [4, 1]).0[0], 3.0);
    }
}
