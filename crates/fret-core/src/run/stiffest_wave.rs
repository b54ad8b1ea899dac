//! The wave of pressure that displaces the surfaces least: what bounds the wear of one explicit step.

use std::f64::consts::{PI, TAU};

use ndarray::Array2;

use super::pair_compliance::PairCompliance;
use crate::compliance::SurfaceResponse;
use crate::model::SurfaceGrid;

/// Waves of pressure between two wavelengths of which one is twice the other, of bodies that are looked at wave by wave.
const PER_OCTAVE: f64 = 8.0;
/// First zero of the Bessel function `J0`: the longest wave in a circle of radius `a`, zero at its rim, has the wavenumber `2.405/a`.
const FIRST_ZERO: f64 = 2.404_825_557_695_773;

/// Least normal displacement by waves of unit pressure that a contact has room for. On half-spaces that of pressure which alternates from
/// cell to cell; on nearly incompressible films long waves may displace less.
#[derive(Debug, Clone)]
pub struct StiffestWave {
    grid: SurfaceGrid,
    /// Displacement by unit pressure that alternates from cell to cell [length/pressure].
    alternating: f64,
    /// Wavelengths [length], ascending, with the displacement by waves of unit pressure of that length [length/pressure].
    waves: Vec<[f64; 2]>,
}

impl StiffestWave {
    /// The waves on a grid.
    pub fn new(compliance: &PairCompliance, grid: &SurfaceGrid) -> Self {
        let waves = match (&compliance.response, &compliance.table) {
            (SurfaceResponse::Periodic(symbols), _) => {
                let size = grid.size();
                let symbols = symbols.zz.iter().flat_map(|zz| zz.indexed_iter());
                let waves = symbols.map(|((a, b), displacement)| {
                    [(a as f64 / size[0]).hypot(b as f64 / size[1]).recip(), *displacement]
                });
                waves.filter(|[length, _]| length.is_finite()).collect()
            }
            (SurfaceResponse::FreeSpace(_), None) => Vec::new(),
            (SurfaceResponse::FreeSpace(_), Some(table)) => {
                let ([dx, dy], [width, depth]) = (grid.spacing(), grid.size());
                let [shortest, longest] = [2.0 * dx.min(dy), width.max(depth)];
                let count = ((longest / shortest).log2() * PER_OCTAVE).ceil();
                (0..=count as usize)
                    .map(|index| shortest * (longest / shortest).powf(index as f64 / count))
                    .map(|length| [length, table.times_k(TAU / length).zz * length / TAU])
                    .collect()
            }
        };
        Self { grid: *grid, alternating: compliance.response.alternating_normal(), waves }
    }

    /// Displacement [length/pressure] by the stiffest wave that the cells under pressure have room for: in a circle of their area, or a strip
    /// as wide as they are together.
    pub fn displacement(&self, pressure: &Array2<f64>) -> f64 {
        let area = pressure.iter().filter(|p| **p > 0.0).count() as f64 * self.grid.cell_area();
        let longest = if self.grid.is_line() {
            2.0 * area / self.grid.spacing()[1]
        } else {
            TAU / FIRST_ZERO * (area / PI).sqrt()
        };
        let waves = self.waves.iter().filter(|[length, _]| *length <= longest);
        waves.fold(self.alternating, |least, [_, displacement]| least.min(*displacement))
    }
}
