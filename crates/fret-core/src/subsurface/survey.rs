//! A walk through a body: depth by depth, at each depth through all increments, so that kernels are made once a depth and
//! memory holds one depth at a time.

use ndarray::Array2;

use super::depths::DepthPoint;
use super::even::EvenStress;
use super::operator::{DepthOperator, Tractions};
use super::tensor::StressField;
use crate::model::{Dimension, HalfSpace, Periodicity, SurfaceGrid};
use fret_fft::ConvolutionError;

/// What acts on the surface of the body in one increment, shape `(nx, ny)`.
#[derive(Debug, Clone)]
pub struct LoadedSurface {
    /// The increment, from 0.
    pub increment: usize,
    /// Pressure [pressure].
    pub pressure: Array2<f64>,
    /// Shear acting on the body in question, x and y [pressure].
    pub shear: Option<[Array2<f64>; 2]>,
    /// Accumulated slip, x and y [length].
    pub slip: Option<[Array2<f64>; 2]>,
    /// What adds to the stress of the tractions: bulk stress and residual stress.
    pub even: EvenStress,
}

/// Displacement `u_x, u_y, u_z` at all points under one surface [length], `z` into the body: of the tractions alone, without that of bulk
/// and residual stress; in a periodic problem without the mean, which a half-space does not determine, and of the grid's own waves, with which
/// the contact is solved. `visit(point, field)`.
///
/// # Errors
/// As [`survey`].
///
/// # Panics
/// In a line contact and one that is periodic along one axis, whose displacements need a datum.
pub fn displacements(
    half_space: &HalfSpace,
    (grid, periodic): (&SurfaceGrid, Periodicity),
    points: &[DepthPoint],
    tractions: &Tractions<'_>,
    mut visit: impl FnMut(usize, [Array2<f64>; 3]),
) -> Result<(), ConvolutionError> {
    let is_endless = grid.dimension() == Dimension::Line || periodic.one_axis().is_some();
    assert!(!is_endless, "displacements of a contact without end along one axis need a datum");
    let Some(&first) = points.first() else { return Ok(()) };
    let with_shear = tractions.shear.is_some();
    let mut operator = DepthOperator::new(half_space, first, grid, periodic, with_shear, true)?;
    for (number, &point) in points.iter().enumerate() {
        if number > 0 {
            operator.move_to(point)?;
        }
        if let Some(found) = operator.displacement(tractions) {
            visit(number, found);
        }
    }
    Ok(())
}

/// Stress at all points under all surfaces, that of the bulk and residual stress included: `visit(point, surface, field)` with their indices, points outermost. `visit`
/// returns whether to go on.
///
/// # Errors
/// When a kernel is not finite: with moduli or lengths of extreme magnitude.
pub fn survey(
    half_space: &HalfSpace,
    grid: &SurfaceGrid,
    periodic: Periodicity,
    points: &[DepthPoint],
    surfaces: &[LoadedSurface],
    mut visit: impl FnMut(usize, usize, &StressField) -> bool,
) -> Result<(), ConvolutionError> {
    let with_shear = surfaces.iter().any(|surface| surface.shear.is_some());
    let none = Array2::zeros((grid.cells()[0], grid.cells()[1]));
    let mut field = StressField::zeros(grid.cells());
    let Some(&first) = points.first() else { return Ok(()) };
    let mut operator = DepthOperator::new(half_space, first, grid, periodic, with_shear, false)?;
    for (number, &point) in points.iter().enumerate() {
        if number > 0 {
            operator.move_to(point)?;
        }
        for (index, surface) in surfaces.iter().enumerate() {
            let shear = with_shear.then(|| match &surface.shear {
                Some([x, y]) => [x.view(), y.view()],
                None => [none.view(), none.view()],
            });
            operator.stress_into(&Tractions { pressure: surface.pressure.view(), shear }, &mut field);
            field.add(surface.even.at(half_space, point, grid.dimension()));
            if !visit(number, index, &field) {
                return Ok(());
            }
        }
    }
    Ok(())
}
