//! Resistance of a contact to heat or current: what its constriction adds between the far ends of the two bodies.

use ndarray::Array2;

use super::potential::{ConductionError, Potential};
use crate::model::{Conductor, Periodicity, SurfaceGrid};

/// Constriction resistance between points far inside both bodies [1/(conductivity length)]: the drop of potential per current through
/// the cells in contact, which are one potential on both faces. Films on the surfaces are layers of the conductors. In a periodic case what the
/// contact of one period adds to bodies in full contact.
///
/// For a disc of radius a between homogeneous bodies `(1/kappa1 + 1/kappa2)/(4 a)` (Holm 1967, *Electric Contacts*); for any contact
/// of homogeneous bodies `2/(E* (kappa1 + kappa2) / (kappa1 kappa2)) dP/d approach` is its inverse (Barber 2003, Proc. R. Soc. A 459, 53).
///
/// # Errors
/// When a body does not conduct, no cell is in contact, or the contact has no end along one axis alone.
pub fn contact_resistance(
    conductors: [Option<&Conductor>; 2],
    grid: &SurfaceGrid,
    periodic: Periodicity,
    contact: &Array2<bool>,
) -> Result<f64, ConductionError> {
    for (body, name) in conductors.iter().zip(["lower", "upper"]) {
        if body.is_none() {
            return Err(ConductionError::InsulatingBody(name));
        }
    }
    let contact: Vec<bool> = contact.iter().copied().collect();
    let touching = contact.iter().filter(|is_in| **is_in).count();
    if touching == 0 {
        return Err(ConductionError::Apart);
    }
    let mut potential = Potential::new(conductors, grid, periodic)?;
    if periodic.is_both() && touching == grid.len() {
        return Ok(0.0);
    }
    let flux = potential.flux_for(&vec![1.0; grid.len()], &contact)?;
    Ok(1.0 / (flux.iter().sum::<f64>() * grid.cell_area()))
}
