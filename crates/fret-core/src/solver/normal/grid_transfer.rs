//! Between a grid and one twice as coarse. A coarse cell is four cells under one pressure whose displacement is their mean (Galerkin):
//! its coefficients are sums of the finer ones, right for every body, and measured gaps need nothing but means. Pressures are
//! prolonged by the level function of the contact's edge, which is smooth across it.

use ndarray::{Array2, ArrayView2};

use super::super::contact_edge::level_function;
use super::super::region::Region;
use crate::compliance::SurfaceResponse;
use crate::kernel::{InfluenceCoefficients, PeriodicSymbols};

/// Pressure on a grid twice as fine, of `cells`, from that of a region with its gap; scaled to a `total` where the force is prescribed.
/// The edge is moved out by `shift` of a fine cell. `None` where there is no contact.
pub fn prolonged(
    (region, pressure, gap): (Region, &[f64], &[f64]),
    shift: f64,
    cells: [usize; 2],
    total: Option<f64>,
) -> Option<Array2<f64>> {
    let view = |field| ArrayView2::from_shape(region.shape, field).ok();
    let level = level_function(&view(pressure)?, &view(gap)?)?;
    let fine = Region {
        origin: region.origin.map(|first| 2 * first),
        shape: [0, 1]
            .map(|axis| (2 * region.shape[axis]).min(cells[axis].saturating_sub(2 * region.origin[axis]))),
    };
    let height = interpolated(&level, fine.shape);
    let [nx, ny] = fine.shape;
    let mut pressure = Array2::zeros(cells);
    let mut found = 0.0;
    for i in 0..nx {
        for j in 0..ny {
            let here = height[[i, j]];
            let along_x = height[[(i + 1).min(nx - 1), j]] - height[[i.saturating_sub(1), j]];
            let along_y = height[[i, (j + 1).min(ny - 1)]] - height[[i, j.saturating_sub(1)]];
            // A root only where it may tell: near the edge.
            let is_far = here.abs() >= along_x.abs() + along_y.abs();
            let slope = if is_far { 0.0 } else { 0.5 * along_x.hypot(along_y) };
            let shifted = if here.abs() < 2.0 * slope { here + shift * slope } else { here };
            if shifted > 0.0 {
                let p = shifted.sqrt();
                pressure[[fine.origin[0] + i, fine.origin[1] + j]] = p;
                found += p;
            }
        }
    }
    if !(found > 0.0) {
        return None;
    }
    if let Some(total) = total {
        let factor = total / found;
        pressure.mapv_inplace(|p| p * factor);
    }
    Some(pressure)
}

/// Bilinear interpolation to the centres of half cells.
fn interpolated(coarse: &Array2<f64>, fine: [usize; 2]) -> Array2<f64> {
    let (nx, ny) = coarse.dim();
    let places = |count: usize, cells: usize| -> Vec<(usize, usize, f64)> {
        (0..count)
            .map(|index| {
                let at = (0.5 * (index as f64 + 0.5) - 0.5).clamp(0.0, cells as f64 - 1.0);
                let low = at as usize;
                (low, (low + 1).min(cells - 1), at - low as f64)
            })
            .collect()
    };
    let along_y = places(fine[1], ny);
    let mut row = vec![0.0; ny];
    let mut result = Array2::zeros(fine);
    for (mut line, (low, high, fraction)) in result.rows_mut().into_iter().zip(places(fine[0], nx)) {
        for ((value, a), b) in row.iter_mut().zip(coarse.row(low)).zip(coarse.row(high)) {
            *value = (1.0 - fraction) * a + fraction * b;
        }
        for (value, &(low, high, fraction)) in line.iter_mut().zip(&along_y) {
            *value = (1.0 - fraction) * row[low] + fraction * row[high];
        }
    }
    result
}

/// Means of two by two cells; a cell more than half outside counts what is inside.
pub fn coarser_heights(fine: &Array2<f64>) -> Array2<f64> {
    let (nx, ny) = fine.dim();
    Array2::from_shape_fn((nx.div_ceil(2), ny.div_ceil(2)), |(i, j)| {
        let (right, up) = ((2 * i + 1).min(nx - 1), (2 * j + 1).min(ny - 1));
        0.25 * (fine[[2 * i, 2 * j]] + fine[[right, 2 * j]] + fine[[2 * i, up]] + fine[[right, up]])
    })
}

/// The normal response of cells twice as wide.
pub fn coarser_response(fine: &SurfaceResponse, cells: [usize; 2]) -> Option<SurfaceResponse> {
    let normal = |zz| (Some(zz), None, None, None, None, None);
    Some(match fine {
        SurfaceResponse::FreeSpace(coefficients) => {
            let (zz, xx, yy, xy, zx, zy) = normal(coarser_coefficients(coefficients.zz.as_ref()?));
            SurfaceResponse::FreeSpace(InfluenceCoefficients { zz, xx, yy, xy, zx, zy })
        }
        SurfaceResponse::Periodic(symbols) => {
            let (zz, xx, yy, xy, zx, zy) = normal(coarser_symbols(symbols.zz.as_ref()?, cells));
            SurfaceResponse::Periodic(PeriodicSymbols { zz, xx, yy, xy, zx, zy })
        }
    })
}

/// Mean displacement of two by two cells by one pressure on two by two others.
fn coarser_coefficients(fine: &Array2<f64>) -> Array2<f64> {
    let (nx, ny) = fine.dim();
    let mut row = vec![0.0; ny];
    let mut coarse = Array2::zeros((nx.div_ceil(2), ny.div_ceil(2)));
    for (i, mut line) in coarse.rows_mut().into_iter().enumerate() {
        // the quadrant is even; the last offset of an odd count is missing, and no contact inside the grid asks for it
        let near = [(2 * i).abs_diff(1), 2 * i, (2 * i + 1).min(nx - 1)].map(|index| fine.row(index));
        for j in 0..ny {
            row[j] = near[0][j] + 2.0 * near[1][j] + near[2][j];
        }
        for (j, value) in line.iter_mut().enumerate() {
            *value = 0.25 * (row[(2 * j).abs_diff(1)] + 2.0 * row[2 * j] + row[(2 * j + 1).min(ny - 1)]);
        }
    }
    coarse
}

/// The same in waves: each coarse wave is a mixture of four fine ones.
fn coarser_symbols(fine: &Array2<f64>, cells: [usize; 2]) -> Array2<f64> {
    let half = cells.map(|count| count / 2);
    let fractions = |index: usize, count: usize| {
        let (sine, cosine) = libm::sincos(std::f64::consts::PI * index as f64 / count as f64);
        [cosine * cosine, sine * sine]
    };
    Array2::from_shape_fn(half.map(|count| count / 2 + 1), |(a, b)| {
        let [wide_x, narrow_x] = fractions(a, cells[0]);
        let [wide_y, narrow_y] = fractions(b, cells[1]);
        let (c, d) = (half[0] - a, half[1] - b);
        wide_x * (wide_y * fine[[a, b]] + narrow_y * fine[[a, d]])
            + narrow_x * (wide_y * fine[[c, b]] + narrow_y * fine[[c, d]])
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compliance::{OperatorSet, SpectralCompliance, SurfaceCompliance};
    use crate::kernel::{Components, influence_coefficients, periodic_symbols};
    use crate::model::{Base, Body, Coating, ContactPair, ElasticMaterial, HalfSpace};

    fn pair() -> ContactPair {
        let material = |young| ElasticMaterial::new(young, 0.3).unwrap();
        let body =
            HalfSpace::new(vec![Coating::new(material(5.0), 1.5).unwrap()], Base::Elastic(material(1.0)));
        ContactPair::new(Body::Rigid, Body::Elastic(body.unwrap())).unwrap()
    }

    fn responses(cells: [usize; 2]) -> [SurfaceResponse; 2] {
        let spacing = [1.0, 1.5];
        [
            SurfaceResponse::FreeSpace(influence_coefficients(&pair(), cells, spacing, Components::NORMAL)),
            SurfaceResponse::Periodic(periodic_symbols(&pair(), cells, spacing, Components::NORMAL, 0)),
        ]
    }

    #[test]
    fn a_coarse_cell_is_four_cells_under_one_pressure() {
        let cells = [16, 12];
        let normal = OperatorSet { normal: true, ..OperatorSet::default() };
        for response in responses(cells) {
            let coarse = coarser_response(&response, cells).unwrap();
            let pressure = |i: usize, j: usize| ((3 * i + 5 * j * j) % 7) as f64;
            let of_fine: Vec<f64> = (0..192).map(|cell| pressure(cell / 12 / 2, cell % 12 / 2)).collect();
            let of_coarse: Vec<f64> = (0..48).map(|cell| pressure(cell / 6, cell % 6)).collect();
            let (mut fine, mut found) = (vec![0.0; 192], vec![0.0; 48]);
            SpectralCompliance::new(&response, cells, normal).unwrap().normal(&of_fine, &mut fine);
            SpectralCompliance::new(&coarse, [8, 6], normal).unwrap().normal(&of_coarse, &mut found);
            let exact = coarser_heights(&Array2::from_shape_vec(cells, fine).unwrap());
            let size = exact.iter().copied().fold(0.0, f64::max);
            for (found, exact) in found.iter().zip(&exact) {
                assert!((found - exact).abs() < 1e-13 * size, "{found} {exact}"); // sums of 200 products
            }
        }
    }

    #[test]
    fn planes_are_interpolated_exactly() {
        let plane = |x: f64, y: f64| 3.0 + 0.5 * x - 0.25 * y;
        let coarse =
            Array2::from_shape_fn((6, 5), |(i, j)| plane(2.0 * i as f64 + 0.5, 2.0 * j as f64 + 0.5));
        let fine = interpolated(&coarse, [11, 10]);
        for ((i, j), value) in fine.indexed_iter() {
            if (1..10).contains(&i) && (1..9).contains(&j) {
                assert!((value - plane(i as f64, j as f64)).abs() < 1e-14);
            }
        }
        let means = coarser_heights(&Array2::from_shape_fn((12, 10), |(i, j)| plane(i as f64, j as f64)));
        assert!(means.iter().zip(&coarse).all(|(mean, value)| (mean - value).abs() < 1e-14));
    }
}
