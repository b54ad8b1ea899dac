//! The wave of pressure that displaces the surfaces least: what bounds the wear of one explicit step.

use std::f64::consts::{PI, TAU};

use ndarray::Array2;

use super::pair_compliance::PairCompliance;
use crate::compliance::SurfaceResponse;
use crate::model::{Dimension, SurfaceGrid};
use crate::plan::Plan;

/// Waves of pressure between two wavelengths of which one is twice the other, of bodies that are looked at wave by wave.
const PER_OCTAVE: f64 = 8.0;
/// First zero of the Bessel function `J0`: the longest wave in a circle of radius `a`, zero at its rim, has the wavenumber `2.405/a`.
const FIRST_ZERO: f64 = 2.404_825_557_695_773;

/// Least normal displacement by waves of unit pressure that a contact has room for. On half-spaces that of pressure which alternates from
/// cell to cell; on nearly incompressible films long waves may displace less.
#[derive(Debug, Clone)]
pub struct StiffestWave {
    /// Area of the whole contact that a cell stands for [length^2].
    cell_area: f64,
    dimension: Dimension,
    /// Whether waves run through, along one axis at least: then all of the period has room for them.
    is_periodic: bool,
    /// Displacement by unit pressure that alternates from cell to cell [length/pressure].
    alternating: f64,
    /// Wavelengths [length] with the displacement by waves of unit pressure of that length [length/pressure]; in a period of waves on its cells.
    waves: Vec<[f64; 2]>,
}

impl StiffestWave {
    /// The waves of a planned contact.
    pub fn of(plan: &Plan, compliance: &PairCompliance) -> Self {
        let is_periodic = !plan.case.periodic.is_none();
        Self { cell_area: plan.area_of_cell(), is_periodic, ..Self::new(compliance, &plan.grid) }
    }

    /// The waves on a grid.
    fn new(compliance: &PairCompliance, grid: &SurfaceGrid) -> Self {
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
        let is_periodic = compliance.response.is_periodic();
        let alternating = compliance.response.alternating_normal();
        Self { cell_area: grid.cell_area(), dimension: grid.dimension(), is_periodic, alternating, waves }
    }

    /// Displacement [length/pressure] by the stiffest wave that the cells which wear have room for, those where `wear` is positive: in a circle
    /// of their area, in a strip as wide as they are together, or anywhere in a period.
    pub fn displacement(&self, wear: &Array2<f64>) -> f64 {
        let area = wear.iter().filter(|wear| **wear > 0.0).count() as f64 * self.cell_area;
        let longest = match (self.is_periodic, self.dimension) {
            (true, _) => f64::INFINITY,
            // a line's cells are counted by their width
            (false, Dimension::Line) => 2.0 * area,
            (false, Dimension::Plane) => TAU / FIRST_ZERO * (area / PI).sqrt(),
        };
        let waves = self.waves.iter().filter(|[length, _]| *length <= longest);
        waves.fold(self.alternating, |least, [_, displacement]| least.min(*displacement))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::{
        Components, ResponseTable, influence_coefficients, line_coefficients, periodic_symbols,
    };
    use crate::model::{Base, Body, Coating, ContactPair, ElasticMaterial, HalfSpace};

    /// An incompressible film of `E = 1` and this thickness, bonded to a rigid base.
    fn film(thickness: f64) -> ContactPair {
        let layer = Coating::new(ElasticMaterial::new(1.0, 0.5).unwrap(), thickness).unwrap();
        let film = HalfSpace::new(vec![layer], Base::Rigid).unwrap();
        ContactPair::new(Body::Rigid, Body::Elastic(film)).unwrap()
    }

    fn table(pair: &ContactPair, grid: &SurfaceGrid) -> ResponseTable {
        let [dx, dy] = grid.spacing();
        ResponseTable::new(pair, TAU / grid.size()[0], 5.0 * PI / dx.min(dy))
    }

    /// Long waves squeeze the film along itself: `u = -h^3/(3 G) p''`, so `h^3 k^2/E` for `E = 3 G`, whatever the unit of length. Waves are
    /// looked at eight to an octave: of the longest one up to `2^(1/4)` is missed; the film is not quite thin, `1 - (2/5) (k h)^2`.
    #[test]
    fn long_waves_on_an_incompressible_film_are_the_stiffest() {
        for unit in [1.0, 1e-5, 3e4] {
            let (cells, side, thickness) = (64, 0.1 * unit, 0.08 * unit);
            let pair = film(thickness);
            let as_told = |found: f64, k: f64| {
                let ratio = found / (thickness.powi(3) * k * k);
                assert!((0.98..1.2).contains(&ratio), "{unit}: {ratio}");
            };
            let grid = SurfaceGrid::new([cells; 2], [side; 2]).unwrap();
            let response = influence_coefficients(&pair, [cells; 2], [side; 2], Components::NORMAL);
            let response = SurfaceResponse::FreeSpace(response);
            let surface =
                StiffestWave::new(&PairCompliance { response, table: Some(table(&pair, &grid)) }, &grid);
            let centre = cells as f64 / 2.0;
            let circle = Array2::from_shape_fn([cells; 2], |(i, j)| {
                f64::from(u8::from((i as f64 - centre).hypot(j as f64 - centre) < 20.0))
            });
            as_told(surface.displacement(&circle), FIRST_ZERO / (circle.sum().sqrt() * side / PI.sqrt()));
            assert_eq!(surface.displacement(&Array2::zeros([cells; 2])), surface.alternating);

            let grid = SurfaceGrid::line(cells, side).unwrap();
            let response = line_coefficients(&pair, cells, side, 10.0 * side, Components::NORMAL);
            let response = SurfaceResponse::FreeSpace(response);
            let line =
                StiffestWave::new(&PairCompliance { response, table: Some(table(&pair, &grid)) }, &grid);
            let strip = Array2::from_shape_fn([cells, 1], |(i, _)| if i < 30 { 1.0 } else { 0.0 });
            as_told(line.displacement(&strip), PI / (30.0 * side));

            let grid = SurfaceGrid::new([cells, 4], [side; 2]).unwrap();
            let response = periodic_symbols(&pair, [cells, 4], [side; 2], Components::NORMAL, 0);
            let response = SurfaceResponse::Periodic(response);
            let period = StiffestWave::new(&PairCompliance { response, table: None }, &grid);
            let one = Array2::from_shape_fn([cells, 4], |cell| if cell == (3, 1) { 1.0 } else { 0.0 });
            as_told(period.displacement(&one), TAU / (cells as f64 * side));
        }
    }

    /// On half-spaces pressure that alternates from cell to cell.
    #[test]
    fn on_a_half_space_it_is_the_shortest_wave() {
        let half_space = HalfSpace::homogeneous(ElasticMaterial::new(1.0, 0.3).unwrap());
        let pair = ContactPair::new(Body::Rigid, Body::Elastic(half_space)).unwrap();
        let grid = SurfaceGrid::new([32; 2], [1.0; 2]).unwrap();
        let response = influence_coefficients(&pair, [32; 2], [1.0; 2], Components::NORMAL);
        let compliance = PairCompliance {
            response: SurfaceResponse::FreeSpace(response),
            table: Some(table(&pair, &grid)),
        };
        let waves = StiffestWave::new(&compliance, &grid);
        assert_eq!(waves.displacement(&Array2::ones([32; 2])), waves.alternating);
    }
}
