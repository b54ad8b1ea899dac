//! Influence coefficients of a contact that repeats along one axis: the displacement of one cell by unit traction on another and on all its
//! images along that axis.

use ndarray::Array2;

use super::cells::{Tables, surface_displacement};
use super::influence::{Components, InfluenceCoefficients};
use super::line_influence::line_coefficients_of;
use super::pair_response::PairResponse;
use super::quartets::SurfaceDisplacement;
use super::repeated::{repeated, with_images};
use crate::model::ContactPair;

/// Components zz, xx, yy, xy, zx, zy that are odd along x and along y.
const ODD: [[bool; 2]; 6] = [[false; 2], [false; 2], [false; 2], [true; 2], [true, false], [false, true]];

/// Influence coefficients of a pair on a grid of one period along `axis` (0: x, 1: y), infinite along the other: offsets of all cells,
/// conventions as [`InfluenceCoefficients`]. Along `axis` an even component repeats as `K(n - i) = K(i)`, an odd one as `-K(i)`, so that the
/// product in free space over one period is that with all images.
///
/// Their mean along `axis` is the coefficient of a line contact: displacements are relative to the point `datum` \[length\] below the load in
/// each body with an elastic base. `response`: that of the pair, in whatever form.
///
/// Error about 1e-12 of the coefficient at offset 0. Cost: of 12.5 times as many cells as the grid has.
pub fn repeated_coefficients(
    (pair, response): (&ContactPair, &PairResponse),
    (cells, spacing): ([usize; 2], [f64; 2]),
    axis: usize,
    datum: f64,
    wanted: Components,
) -> InfluenceCoefficients {
    if axis == 0 {
        let turned = ([cells[1], cells[0]], [spacing[1], spacing[0]]);
        return exchanged(repeated_coefficients((pair, response), turned, 1, datum, wanted));
    }
    let line = line_coefficients_of(response, pair, cells[0], spacing[0], datum, Components::ALL);
    let lines = [line.zz, line.xx, line.yy, line.xy, line.zx, line.zy];
    let uniform = |i: usize, component: usize| lines[component].as_ref().map_or(0.0, |line| line[[i, 0]]);
    let tables = Tables::<SurfaceDisplacement, 1>::new(response, with_images(cells), spacing);
    let odd = |component: usize| ODD[component];
    let found = repeated(&tables, cells, uniform, odd, |[moments]| [surface_displacement(moments)]);
    let array = |wanted: bool, component: usize| wanted.then(|| found.kernel(0, component).to_owned());
    InfluenceCoefficients {
        zz: array(wanted.normal, 0),
        xx: array(wanted.tangential, 1),
        yy: array(wanted.tangential, 2),
        xy: array(wanted.tangential, 3),
        zx: array(wanted.coupling, 4),
        zy: array(wanted.coupling, 5),
    }
}

/// The coefficients of the grid with x and y exchanged.
fn exchanged(found: InfluenceCoefficients) -> InfluenceCoefficients {
    let turned = |array: Option<Array2<f64>>| array.map(|array| array.t().as_standard_layout().into_owned());
    let InfluenceCoefficients { zz, xx, yy, xy, zx, zy } = found;
    let [zz, xx, yy, xy, zx, zy] = [zz, yy, xx, xy, zy, zx].map(turned);
    InfluenceCoefficients { zz, xx, yy, xy, zx, zy }
}

#[cfg(test)]
mod tests;
