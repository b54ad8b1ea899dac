//! Between a grid and one twice as coarse. A coarse cell is four cells under one pressure whose displacement is their mean (Galerkin):
//! its coefficients are sums of the finer ones, right for every body, and measured gaps need nothing but means. Pressures are
//! prolonged by the level function of the contact's edge, which is smooth across it.

use ndarray::{Array2, ArrayView2};

use super::super::contact_edge::level_function;
use super::super::region::Region;
use crate::compliance::SurfaceResponse;
use crate::kernel::{Components, InfluenceCoefficients, PeriodicSymbols};
use crate::model::Symmetry;

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
    let [nx, ny] = fine.shape;
    let mut finer = Interpolation::new(&level, fine.shape);
    // Heights of the row before, of a row and of the one behind it.
    let mut heights = [vec![0.0; ny], vec![0.0; ny], vec![0.0; ny]];
    finer.row(0, &mut heights[1]);
    let [before, first, _] = &mut heights;
    before.clone_from(first);
    let mut pressure = Array2::zeros(cells);
    let mut found = 0.0;
    for i in 0..nx {
        finer.row((i + 1).min(nx - 1), &mut heights[2]);
        let [before, height, behind] = &heights;
        for j in 0..ny {
            let here = height[j];
            let along_x = behind[j] - before[j];
            let along_y = height[(j + 1).min(ny - 1)] - height[j.saturating_sub(1)];
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
        heights.rotate_left(1);
    }
    if !(found > 0.0) {
        return None;
    }
    if let Some(total) = total {
        let factor = total / found;
        // Memory of zeros that nobody writes to costs nothing.
        pressure.iter_mut().filter(|p| **p > 0.0).for_each(|p| *p *= factor);
    }
    Some(pressure)
}

/// Bilinear interpolation to the centres of half cells.
pub fn interpolated(coarse: &Array2<f64>, fine: [usize; 2]) -> Array2<f64> {
    let mut finer = Interpolation::new(coarse, fine);
    let mut result = Array2::zeros(fine);
    for (index, mut line) in result.rows_mut().into_iter().enumerate() {
        finer.row(index, line.as_slice_mut().unwrap_or_default());
    }
    result
}

/// The same row by row.
struct Interpolation<'a> {
    coarse: &'a Array2<f64>,
    /// Of every cell along each axis the coarse ones on both sides, and how far it lies from the first towards the second.
    places: [Vec<(usize, usize, f64)>; 2],
    /// Between two coarse rows.
    between: Vec<f64>,
}

impl<'a> Interpolation<'a> {
    fn new(coarse: &'a Array2<f64>, fine: [usize; 2]) -> Self {
        let cells: [usize; 2] = coarse.dim().into();
        let places = [0, 1].map(|axis| {
            let place = |index: usize| {
                let at = (0.5 * (index as f64 + 0.5) - 0.5).clamp(0.0, cells[axis] as f64 - 1.0);
                let low = at as usize;
                (low, (low + 1).min(cells[axis] - 1), at - low as f64)
            };
            (0..fine[axis]).map(place).collect()
        });
        Self { coarse, places, between: vec![0.0; cells[1]] }
    }

    fn row(&mut self, index: usize, line: &mut [f64]) {
        let Self { coarse, places: [rows, columns], between } = self;
        let (low, high, fraction) = rows[index];
        for ((value, a), b) in between.iter_mut().zip(coarse.row(low)).zip(coarse.row(high)) {
            *value = (1.0 - fraction) * a + fraction * b;
        }
        for (value, &(low, high, fraction)) in line.iter_mut().zip(&*columns) {
            *value = (1.0 - fraction) * between[low] + fraction * between[high];
        }
    }
}

/// Whether a grid of a `shape` in front of its mirrors has one twice as coarse: with so many cells along each axis at the least, even in number
/// where they repeat or are mirrored.
pub fn is_made_coarser(shape: [usize; 2], least: usize, (is_periodic, symmetry): (bool, Symmetry)) -> bool {
    let (whole, mirrored) = (symmetry.whole_of(shape), symmetry.axes());
    (0..2).all(|axis| {
        whole[axis] >= least && (shape[axis].is_multiple_of(2) || !(is_periodic || mirrored[axis]))
    })
}

/// Means of two by two cells; a cell more than half outside counts what is inside.
pub fn coarser_heights(fine: &Array2<f64>) -> Array2<f64> {
    let (nx, ny) = fine.dim();
    Array2::from_shape_fn((nx.div_ceil(2), ny.div_ceil(2)), |(i, j)| {
        let (right, up) = ((2 * i + 1).min(nx - 1), (2 * j + 1).min(ny - 1));
        0.25 * (fine[[2 * i, 2 * j]] + fine[[right, 2 * j]] + fine[[2 * i, up]] + fine[[right, up]])
    })
}

/// The `wanted` response of cells twice as wide, as far as that of `cells` is there.
pub fn coarser_response(fine: &SurfaceResponse, cells: [usize; 2], wanted: Components) -> SurfaceResponse {
    let Components { normal, tangential, coupling } = wanted;
    let is_wanted = [normal, tangential, tangential, tangential, coupling, coupling];
    let odd = [[false; 2], [false; 2], [false; 2], [true; 2], [true, false], [false, true]];
    let is_periodic = fine.is_periodic();
    let parts = fine.parts();
    let [zz, xx, yy, xy, zx, zy] = [0, 1, 2, 3, 4, 5].map(|k| {
        let coarser = |values| {
            if is_periodic {
                coarser_symbols(values, cells, odd[k])
            } else {
                coarser_coefficients(values, odd[k])
            }
        };
        parts[k].as_ref().filter(|_| is_wanted[k]).map(coarser)
    });
    if is_periodic {
        SurfaceResponse::Periodic(PeriodicSymbols { zz, xx, yy, xy, zx, zy })
    } else {
        SurfaceResponse::FreeSpace(InfluenceCoefficients { zz, xx, yy, xy, zx, zy })
    }
}

/// Mean displacement of two by two cells by one traction on two by two others. `odd`: along which axes coefficients change their sign.
fn coarser_coefficients(fine: &Array2<f64>, odd: [bool; 2]) -> Array2<f64> {
    let (nx, ny) = fine.dim();
    // The last offset of an odd count is missing, and no contact inside the grid asks for it.
    let near =
        |index: usize, count: usize| [(2 * index).abs_diff(1), 2 * index, (2 * index + 1).min(count - 1)];
    let sign = |index: usize, axis: usize| if odd[axis] && index == 0 { -1.0 } else { 1.0 };
    let mut row = vec![0.0; ny];
    let mut coarse = Array2::zeros((nx.div_ceil(2), ny.div_ceil(2)));
    for (i, mut line) in coarse.rows_mut().into_iter().enumerate() {
        let near_x = near(i, nx).map(|index| fine.row(index.min(nx - 1)));
        for j in 0..ny {
            row[j] = sign(i, 0) * near_x[0][j] + 2.0 * near_x[1][j] + near_x[2][j];
        }
        for (j, value) in line.iter_mut().enumerate() {
            let [low, middle, high] = near(j, ny).map(|index| row[index.min(ny - 1)]);
            *value = 0.25 * (sign(j, 1) * low + 2.0 * middle + high);
        }
    }
    coarse
}

/// The same in waves: each coarse wave is a mixture of four fine ones, of which those folded over are counted from the other side.
fn coarser_symbols(fine: &Array2<f64>, cells: [usize; 2], odd: [bool; 2]) -> Array2<f64> {
    let half = cells.map(|count| count / 2);
    let fractions = |index: usize, axis: usize| {
        let (sine, cosine) = libm::sincos(std::f64::consts::PI * index as f64 / cells[axis] as f64);
        [cosine * cosine, if odd[axis] { -sine * sine } else { sine * sine }]
    };
    Array2::from_shape_fn(half.map(|count| count / 2 + 1), |(a, b)| {
        let [wide_x, narrow_x] = fractions(a, 0);
        let [wide_y, narrow_y] = fractions(b, 1);
        let (c, d) = (half[0] - a, half[1] - b);
        wide_x * (wide_y * fine[[a, b]] + narrow_y * fine[[a, d]])
            + narrow_x * (wide_y * fine[[c, b]] + narrow_y * fine[[c, d]])
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compliance::{OperatorSet, SpectralCompliance, SurfaceCompliance};
    use crate::kernel::{influence_coefficients, periodic_symbols};
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
            SurfaceResponse::FreeSpace(influence_coefficients(&pair(), cells, spacing, Components::ALL)),
            SurfaceResponse::Periodic(periodic_symbols(&pair(), cells, spacing, Components::ALL, 0)),
        ]
    }

    /// Pressure and shear, each of them its own, and all that they displace.
    #[test]
    fn a_coarse_cell_is_four_cells_under_the_same_tractions() {
        let cells = [16, 12];
        let full = OperatorSet { full: true, ..OperatorSet::default() };
        for response in responses(cells) {
            let coarse = coarser_response(&response, cells, Components::ALL);
            let traction =
                |part: usize, i: usize, j: usize| ((3 * i + 5 * j * j + part * (i + 2)) % 7) as f64;
            let of_fine = [0, 1, 2].map(|part| -> Vec<f64> {
                (0..192).map(|cell| traction(part, cell / 12 / 2, cell % 12 / 2)).collect()
            });
            let of_coarse = [0, 1, 2]
                .map(|part| -> Vec<f64> { (0..48).map(|cell| traction(part, cell / 6, cell % 6)).collect() });
            let (mut fine, mut found) = ([0, 1, 2].map(|_| vec![0.0; 192]), [0, 1, 2].map(|_| vec![0.0; 48]));
            let apply = |response: &SurfaceResponse,
                         cells: [usize; 2],
                         from: &[Vec<f64>; 3],
                         to: &mut [Vec<f64>; 3]| {
                let mut operator = SpectralCompliance::new(response, cells, full).unwrap();
                operator.full(from.each_ref().map(Vec::as_slice), to.each_mut().map(Vec::as_mut_slice));
            };
            apply(&response, cells, &of_fine, &mut fine);
            apply(&coarse, [8, 6], &of_coarse, &mut found);
            let exact = fine.map(|fine| coarser_heights(&Array2::from_shape_vec(cells, fine).unwrap()));
            let size = exact[0].iter().copied().fold(0.0, f64::max);
            for (found, exact) in found.iter().flatten().zip(exact.iter().flatten()) {
                assert!((found - exact).abs() < 1e-13 * size, "{found} {exact}"); // sums of 600 products
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
