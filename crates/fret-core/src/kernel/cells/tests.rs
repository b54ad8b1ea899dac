use super::super::closed_form::{CellResponse, homogeneous_cell};
use super::super::pair_response::PairResponse;
use super::super::samples::{material, pair};
use super::*;
use crate::model::ContactPair;
use pulp::Scalar;

type Kernels = Tables<SurfaceDisplacement, 1>;

/// Tables that serve cells as far as `farthest`, each cell as near to its load as it is.
fn kernels(pair: &ContactPair, sides: [f64; 2], farthest: f64) -> Kernels {
    let cells = sides.map(|side| (farthest / side) as usize);
    Kernels::new(&PairResponse::new(pair), cells, sides)
}

fn cell(quadrature: &CellQuadrature, kernels: &Kernels, offset: [f64; 2]) -> CellResponse {
    let [zz, xx, yy, xy, zx, zy] =
        surface_displacement(&kernels.moments::<Scalar>(quadrature, offset, &mut Vec::new())[0]);
    CellResponse { zz, xx, yy, xy, zx, zy }
}

/// Largest difference of the components, over zz.
fn difference(found: CellResponse, exact: CellResponse) -> f64 {
    let differences = [
        found.zz - exact.zz,
        found.xx - exact.xx,
        found.yy - exact.yy,
        found.xy - exact.xy,
        found.zx - exact.zx,
        found.zy - exact.zy,
    ];
    differences.iter().fold(0.0_f64, |worst, difference| worst.max(difference.abs())) / exact.zz
}

#[test]
fn homogeneous_cells_follow_love_and_cerruti() {
    let quadrature = CellQuadrature::new();
    for nu in [-0.5, 0.0, 0.3, 0.5] {
        for sides in [[1.0, 1.0], [1.0, 10.0], [3.0, 0.5], [100.0, 1.0]] {
            let kernels = kernels(&pair(&[], Some((2.6, nu))), sides, 2e4);
            for (i, j) in
                [(0, 0), (1, 0), (0, 1), (1, 1), (2, 1), (0, 3), (5, 2), (3, 7), (17, 0), (40, 17), (120, 90)]
            {
                let offset = [f64::from(i) * sides[0], f64::from(j) * sides[1]];
                let found = cell(&quadrature, &kernels, offset);
                let exact = homogeneous_cell(&material((2.6, nu)), offset, sides);
                let far = (offset[0] * offset[0] + offset[1] * offset[1]) / (sides[0] * sides[1]);
                let error = difference(found, exact);
                let tolerance = 1e-14 + 3e-15 * far; // rounding of our sums; of the closed form's corner differences
                assert!(error < tolerance, "nu {nu}, {sides:?}, ({i}, {j}): {error:.1e} > {tolerance:.1e}");
            }
        }
    }
}

#[test]
fn published_values_of_the_unit_square() {
    // G = 1, nu = 0.3; ten digits
    let quadrature = CellQuadrature::new();
    let kernels = kernels(&pair(&[], Some((2.6, 0.3))), [1.0, 1.0], 10.0);
    let values = [
        ([0.0, 0.0], [0.392_769_896_6, 0.476_934_874_5, 0.476_934_874_5, 0.0, 0.0, 0.0]),
        ([1.0, 0.0], [0.115_647_522_7, 0.160_389_456_5, 0.120_468_812_7, 0.0, 0.031_339_914_6, 0.0]),
        (
            [2.0, 1.0],
            [
                0.050_255_129_6,
                0.067_283_300_3,
                0.054_764_871_6,
                0.008_318_168_9,
                0.012_738_830_1,
                0.006_359_210_2,
            ],
        ),
    ];
    for (offset, [zz, xx, yy, xy, zx, zy]) in values {
        let found = cell(&quadrature, &kernels, offset);
        assert!(difference(found, CellResponse { zz, xx, yy, xy, zx, zy }) < 3e-9, "{offset:?}"); // digits given over zz
    }
}

#[test]
fn a_cell_answers_like_the_cells_that_tile_it() {
    // Another disc, another table, other Gauss orders. Own cells agree to 5e-15 in every case; the tolerance of the others,
    // over zz at their place, is the rounding of the table, which grows as the coating gets softer than what lies below
    // and where a rigid base makes zz fall exponentially.
    type Case = (&'static [(f64, f64, f64)], Option<(f64, f64)>, f64);
    let cases: [Case; 12] = [
        (&[], Some((1.0, 0.3)), 1e-14),
        (&[(2.0, 0.3, 1e-3)], Some((1.0, 0.3)), 1e-14),
        (&[(0.5, 0.3, 1.0)], Some((1.0, 0.3)), 1e-14),
        (&[(10.0, 0.5, 30.0)], Some((1.0, 0.0)), 1e-14),
        (&[(1e6, 0.3, 1.0)], Some((1.0, 0.3)), 1e-14),
        (&[(1e4, 0.25, 1e4)], Some((1.0, 0.3)), 1e-14),
        (&[(1e-2, 0.3, 0.1)], Some((1.0, 0.3)), 1e-13),
        (&[(1e-4, 0.3, 1.0)], Some((1.0, 0.3)), 1e-11),
        (&[(1e-6, 0.3, 0.01)], Some((1.0, 0.3)), 1e-10),
        (&[(1.0, 0.45, 1.0), (100.0, 0.2, 0.05), (0.1, 0.5, 0.5)], Some((3.0, 0.3)), 1e-13),
        (&[(1.0, 0.3, 20.0)], None, 1e-12),
        (&[(1.0, 0.5, 30.0)], None, 1e-12),
    ];
    let quadrature = CellQuadrature::new();
    for (layers, substrate, tolerance) in cases {
        let pair = pair(layers, substrate);
        for sides in [[1.0, 1.0], [3.0, 1.0], [1.0, 10.0]] {
            let parts = if sides[1] > 5.0 { [5_i32, 31] } else { [5, 5] };
            let small = [sides[0] / f64::from(parts[0]), sides[1] / f64::from(parts[1])];
            let coarse = kernels(&pair, sides, 400.0);
            let fine = kernels(&pair, small, 400.0);
            for (i, j) in [(0, 0), (1, 0), (0, 1), (1, 1), (3, 1), (7, 2), (15, 4), (30, 3), (3, 25)] {
                let offset = [f64::from(i) * sides[0], f64::from(j) * sides[1]];
                let whole = cell(&quadrature, &coarse, offset);
                let mut sum = CellResponse::default();
                for a in -(parts[0] / 2)..=parts[0] / 2 {
                    for b in -(parts[1] / 2)..=parts[1] / 2 {
                        // whole numbers of small sides, so that the middle one is exactly at the point
                        let place =
                            [f64::from(i * parts[0] + a) * small[0], f64::from(j * parts[1] + b) * small[1]];
                        let part = cell(&quadrature, &fine, place);
                        sum.zz += part.zz;
                        sum.xx += part.xx;
                        sum.yy += part.yy;
                        sum.xy += part.xy;
                        sum.zx += part.zx;
                        sum.zy += part.zy;
                    }
                }
                let error = difference(whole, sum);
                let allowed = if (i, j) == (0, 0) { 1e-14 } else { tolerance };
                assert!(error < allowed, "{layers:?} {substrate:?} {sides:?} ({i}, {j}): {error:.1e}");
            }
        }
    }
}
