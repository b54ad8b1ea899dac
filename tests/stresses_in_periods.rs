//! Stresses below contacts that repeat along both axes: those of tractions that are uniform over each cell, at every depth.

use fret_core::model::{Axis, Base, Coating, ElasticMaterial, HalfSpace, Periodicity, SurfaceGrid};
use fret_core::subsurface::{DepthOperator, DepthPoint, StressField, Tractions};
use fret_validation::limit::limit;
use ndarray::{Array2, s};

fn body(coating: Option<(f64, f64, f64)>) -> HalfSpace {
    let material = |young, nu| ElasticMaterial::new(young, nu).unwrap();
    let coatings = coating.iter().map(|&(young, nu, h)| Coating::new(material(young, nu), h).unwrap());
    HalfSpace::new(coatings.collect(), Base::Elastic(material(1.0, 0.3))).unwrap()
}

type Loads = [Array2<f64>; 3];

fn stress(
    body: &HalfSpace,
    point: DepthPoint,
    grid: &SurfaceGrid,
    periodic: Periodicity,
    loads: &Loads,
) -> StressField {
    let mut operator = DepthOperator::new(body, point, grid, periodic, true, false).unwrap();
    let [pressure, x, y] = loads.each_ref().map(|load| load.view());
    operator.stress(&Tractions { pressure, shear: Some([x, y]) })
}

/// Of one loaded cell at depth 0: the traction under it, nothing outside. On grids that are as long as what aliases are taken from, and longer.
#[test]
fn in_the_surface_the_stress_is_the_traction_of_each_cell() {
    for coating in [None, Some((5.0, 0.25, 0.03))] {
        for cells in [[24, 24], [70, 45]] {
            let grid = SurfaceGrid::new(cells, [1.0 / 24.0; 2]).unwrap();
            let mut loads = [0.0576, 0.02, -0.03].map(|_| Array2::zeros((cells[0], cells[1])));
            for (load, value) in loads.iter_mut().zip([0.0576, 0.02, -0.03]) {
                load[[11, 5]] = value;
            }
            let point = DepthPoint { depth: 0.0, layer: 0 };
            let found = stress(&body(coating), point, &grid, Periodicity::BOTH, &loads);
            for (load, component) in [(0, 2), (1, 4), (2, 5)] {
                for (found, traction) in found.components[component].iter().zip(&loads[load]) {
                    // rounding of the sums over images and waves
                    assert!((found + traction).abs() < 1e-12, "{cells:?} {component}: {found} {traction}");
                }
            }
        }
    }
}

/// Against direct sums of what repeats along y alone over more and more images along x, without end by extrapolation. A sum over images
/// leaves the mean open: that is the one of uniform tractions.
#[test]
fn stresses_are_those_of_rows_that_repeat_along_y_repeated_along_x() {
    let (nu, coating) = ([0.25, 0.3], (3.0, 0.25, 0.2));
    let (across, period, spacing) = (7, 5, [0.2, 0.25]);
    let loads = [1.0, 2.0, 3.0].map(|seed: f64| {
        Array2::from_shape_fn((across, period), |(i, j)| ((3 * i + 5 * j) as f64 * seed).sin() + 0.5 * seed)
    });
    let means = loads.each_ref().map(|load| load.mean().unwrap());
    let grid = SurfaceGrid::new([across, period], spacing).unwrap();
    for coating in [None, Some(coating)] {
        let body = body(coating);
        for (depth, layer) in [(0.0, 0), (0.13, 0), (0.2, 0), (0.2, 1), (0.9, 1)] {
            let point = DepthPoint { depth, layer };
            let found = stress(&body, point, &grid, Periodicity::BOTH, &loads);
            let ends = [16, 32, 64, 128, 256, 512];
            let rows = ends.map(|images: usize| {
                let count = 2 * images + 1;
                let grid = SurfaceGrid::new([count * across, period], spacing).unwrap();
                let loads = loads.each_ref().map(|load| {
                    Array2::from_shape_fn((count * across, period), |(i, j)| load[[i % across, j]])
                });
                let all = stress(&body, point, &grid, Periodicity::Along(Axis::Y), &loads);
                let middle = images * across;
                all.components.map(|field| field.slice(s![middle..middle + across, ..]).to_owned())
            });
            let nu = if coating.is_some() && layer == 0 { nu[0] } else { nu[1] };
            let lateral = -nu / (1.0 - nu) * means[0];
            let uniform = [lateral, lateral, -means[0], 0.0, -means[1], -means[2]];
            for component in 0..6 {
                let sums = Array2::from_shape_fn((across, period), |place| {
                    let partial = |end: usize| {
                        let number = ends.iter().position(|images| *images == end).unwrap();
                        rows[number][component][place]
                    };
                    limit(&ends, &[1, 2, 3, 4, 5], partial)
                });
                let mean = sums.mean().unwrap();
                for (place, value) in found.components[component].indexed_iter() {
                    let exact = sums[place] - mean + uniform[component];
                    // what extrapolation leaves, of tractions up to 4: the sixth power of the bodies' longest length over 16 of the grid
                    assert!(
                        (value - exact).abs() < 1e-9,
                        "{coating:?} {depth} {component} {place:?}: {value} {exact}"
                    );
                }
            }
        }
    }
}

/// A scene is the same twice over: its stresses do not change with how many of its periods are in the grid, that is with the wavenumbers
/// between which aliases are interpolated.
#[test]
fn stresses_do_not_depend_on_how_many_periods_the_grid_holds() {
    let body = body(Some((20.0, 0.2, 0.07)));
    let (cells, spacing) = ([20, 12], [0.1, 0.15]);
    let of = |times: [usize; 2], point: DepthPoint| {
        let all = [0, 1].map(|axis| times[axis] * cells[axis]);
        let loads = [1.0, 2.0, 3.0].map(|seed: f64| {
            Array2::from_shape_fn((all[0], all[1]), |(i, j)| {
                ((7 * (i % cells[0]) + 5 * (j % cells[1])) as f64 * seed).sin()
            })
        });
        let grid = SurfaceGrid::new(all, spacing).unwrap();
        stress(&body, point, &grid, Periodicity::BOTH, &loads)
    };
    for (depth, layer) in [(0.0, 0), (0.04, 0), (0.07, 0), (0.07, 1), (0.3, 1), (1.0, 1)] {
        let point = DepthPoint { depth, layer };
        let (one, many) = (of([1, 1], point), of([4, 5], point));
        for (one, many) in one.components.iter().zip(&many.components) {
            for ((i, j), many) in many.indexed_iter() {
                // polynomials through 24 wavenumbers, of stresses up to 20 in the coating
                let one = one[[i % cells[0], j % cells[1]]];
                assert!((one - many).abs() < 1e-9, "{depth} {layer}: {one} {many}");
            }
        }
    }
}
