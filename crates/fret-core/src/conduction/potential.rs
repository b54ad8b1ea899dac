//! The potential of a surface by the flux through its cells, and the flux that gives the cells of a contact a potential.

use crate::compliance::{OperatorSet, SpectralCompliance, SurfaceCompliance, SurfaceResponse};
use crate::kernel::{Components, PairResponse, coefficients_of, symbols_of};
use crate::model::{Conductor, Dimension, Periodicity, SurfaceGrid};
use fret_fft::ConvolutionError;

/// Residual that is accepted, relative to the largest potential asked for.
const TOLERANCE: f64 = 1e-11;
/// Iterations at the most; a contact of a million cells takes some hundred.
const MOST_ITERATIONS: usize = 20_000;

/// Why a problem of conduction has no answer.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ConductionError {
    /// A line contact, or one that is periodic along one axis.
    #[error(
        "a line contact or one that is periodic along one axis: along an infinite line no steady temperature or potential is finite"
    )]
    Line,
    /// Heat in a periodic case.
    #[error("a periodic case: heated all over, a half-space has no steady temperature")]
    Periodic,
    /// No body conducts.
    #[error("neither body conducts")]
    Insulating,
    /// One body does not conduct.
    #[error("the {0} body does not conduct")]
    InsulatingBody(&'static str),
    /// No cell in contact.
    #[error("the bodies do not touch")]
    Apart,
    /// The equations were not solved.
    #[error("the linear problem was not solved: residual {0:.1e}")]
    Unsolved(f64),
    /// More heat than there are numbers for.
    #[error("the heat or the temperature it causes is beyond all numbers")]
    Beyond,
    /// A coefficient that is no number.
    #[error("{0}")]
    Kernel(#[from] ConvolutionError),
}

/// The potential (temperature, voltage) of the cells of a grid by a flux through them, of one body or the sum of two.
pub struct Potential {
    operator: SpectralCompliance,
    cells: usize,
}

impl Potential {
    /// Operator of the bodies that are given: at the centre of each cell, exact for a flux that is uniform over each; in a periodic case
    /// relative to the mean of the surface.
    ///
    /// # Errors
    /// Of a line contact, of one that is periodic along one axis, and when a coefficient is not finite.
    pub fn new(
        conductors: [Option<&Conductor>; 2],
        grid: &SurfaceGrid,
        periodic: Periodicity,
    ) -> Result<Self, ConductionError> {
        if grid.dimension() == Dimension::Line || periodic.one_axis().is_some() {
            return Err(ConductionError::Line);
        }
        let response = PairResponse::conduction(conductors);
        let (cells, spacing) = (grid.cells(), grid.spacing());
        let response = if periodic.is_both() {
            SurfaceResponse::Periodic(symbols_of(response, cells, spacing, Components::NORMAL))
        } else {
            SurfaceResponse::FreeSpace(coefficients_of(&response, cells, spacing, Components::NORMAL))
        };
        let operators = OperatorSet { normal: true, ..OperatorSet::default() };
        let operator = SpectralCompliance::new(&response, cells, operators)?;
        Ok(Self { operator, cells: grid.len() })
    }

    /// Potential by a flux, in rows of cells.
    pub fn of(&mut self, flux: &[f64]) -> Vec<f64> {
        let mut potential = vec![0.0; self.cells];
        self.operator.normal(flux, &mut potential);
        potential
    }

    /// The flux through the cells in contact, zero elsewhere, that gives these cells their potentials.
    ///
    /// Conjugate gradients on the cells in contact: the operator is symmetric and positive.
    ///
    /// # Errors
    /// When the residual does not fall to 1e-11 of the largest potential.
    pub fn flux_for(&mut self, potential: &[f64], contact: &[bool]) -> Result<Vec<f64>, ConductionError> {
        let masked = |value: (&f64, &bool)| if *value.1 { *value.0 } else { 0.0 };
        let wanted: Vec<f64> = potential.iter().zip(contact).map(masked).collect();
        let mut flux = vec![0.0; self.cells];
        let mut residual = wanted.clone();
        let mut direction = residual.clone();
        let scale = largest(&wanted);
        let mut square = dot(&residual, &residual);
        for _ in 0..MOST_ITERATIONS {
            if largest(&residual) <= TOLERANCE * scale {
                return Ok(flux);
            }
            let mut product = self.of(&direction);
            product.iter_mut().zip(contact).filter(|(_, is_in)| !**is_in).for_each(|(value, _)| *value = 0.0);
            let along = dot(&direction, &product);
            if !(along > 0.0) {
                break;
            }
            let step = square / along;
            for ((flux, direction), (residual, product)) in
                flux.iter_mut().zip(&direction).zip(residual.iter_mut().zip(&product))
            {
                *flux += step * direction;
                *residual -= step * product;
            }
            let next = dot(&residual, &residual);
            let ratio = next / square;
            square = next;
            direction
                .iter_mut()
                .zip(&residual)
                .for_each(|(direction, residual)| *direction = residual + ratio * *direction);
        }
        Err(ConductionError::Unsolved(largest(&residual) / scale))
    }
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, value| value.abs().max(most))
}

fn dot(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(one, other)| one * other).sum()
}
