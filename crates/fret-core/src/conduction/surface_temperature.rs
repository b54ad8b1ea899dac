//! Temperature rise of both surfaces by heat that is made between them.

use ndarray::Array2;

use super::potential::{ConductionError, Potential};
use crate::fields::{largest, unit_of};
use crate::model::{Conductor, Periodicity, SurfaceGrid};

/// Temperature rise of two surfaces that are heated where they touch, above bodies that are cold far below. Shape `(nx, ny)`.
#[derive(Debug, Clone, PartialEq)]
pub struct SurfaceTemperature {
    /// Heat that is made [power/area].
    pub heat: Array2<f64>,
    /// Heat that goes into the lower body [power/area]; negative where heat comes back out of it.
    pub into_lower: Array2<f64>,
    /// Temperature rise of the lower and of the upper surface [temperature]; `None` of a body that does not conduct.
    pub rise: [Option<Array2<f64>>; 2],
}

impl SurfaceTemperature {
    /// The largest rise, and its cell.
    pub fn largest(&self) -> (f64, [usize; 2]) {
        let cells = self.rise.iter().flatten().flat_map(|rise| rise.indexed_iter());
        cells.fold((0.0, [0, 0]), |most, ((i, j), rise)| if *rise > most.0 { (*rise, [i, j]) } else { most })
    }

    /// Fraction of the heat that goes into the lower body [-]; `None` without heat.
    pub fn lower_fraction(&self) -> Option<f64> {
        let all = self.heat.sum();
        (all > 0.0).then(|| self.into_lower.sum() / all)
    }
}

/// Shares heat between two bodies so that both have one temperature in the cells in contact: `(C1 + C2) q1 = C2 q` there, with the
/// surface responses `C1`, `C2` of the lower and the upper body. A body that does not conduct takes none.
///
/// # Errors
/// In periodic cases and line contacts, where nothing is steady; when neither body conducts; when the heat or a temperature is beyond all
/// numbers.
pub fn surface_temperature(
    conductors: [Option<&Conductor>; 2],
    grid: &SurfaceGrid,
    periodic: Periodicity,
    heat: &Array2<f64>,
    contact: &Array2<bool>,
) -> Result<SurfaceTemperature, ConductionError> {
    if periodic.is_both() {
        return Err(ConductionError::Periodic);
    }
    let is_number = |field: &Array2<f64>| field.sum().is_finite();
    if !is_number(heat) {
        return Err(ConductionError::Beyond);
    }
    let shape = heat.dim();
    // In a unit in which sums and squares are numbers, too.
    let mut all: Vec<f64> = heat.iter().copied().collect();
    let unit = unit_of(largest(&all));
    for heat in &mut all {
        *heat /= unit;
    }
    let field = |values: &[f64]| Array2::from_shape_fn(shape, |(i, j)| unit * values[i * shape.1 + j]);
    let into_lower = match conductors {
        [None, None] => return Err(ConductionError::Insulating),
        [Some(_), None] => all.clone(),
        [None, Some(_)] => vec![0.0; all.len()],
        [Some(_), Some(upper)] => {
            let target = Potential::new([None, Some(upper)], grid, periodic)?.of(&all);
            let contact: Vec<bool> =
                contact.iter().zip(&all).map(|(touches, heat)| *touches || *heat > 0.0).collect();
            Potential::new(conductors, grid, periodic)?.flux_for(&target, &contact)?
        }
    };
    let into_upper: Vec<f64> = all.iter().zip(&into_lower).map(|(all, lower)| all - lower).collect();
    let mut rise = [None, None];
    for (place, flux) in [&into_lower, &into_upper].into_iter().enumerate() {
        if let Some(body) = conductors[place] {
            rise[place] = Some(field(&Potential::new([Some(body), None], grid, periodic)?.of(flux)));
        }
    }
    if !rise.iter().flatten().all(is_number) {
        return Err(ConductionError::Beyond);
    }
    Ok(SurfaceTemperature { heat: heat.clone(), into_lower: field(&into_lower), rise })
}
