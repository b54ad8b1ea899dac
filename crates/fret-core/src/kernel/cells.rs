//! Radial kernels integrated over rectangular cells.

use super::quadrature::GaussRule;
use super::radial::RadialKernels;

/// Displacements caused by unit traction on one cell [length/pressure].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct CellResponse {
    pub zz: f64,
    pub xx: f64,
    pub yy: f64,
    pub xy: f64,
    pub zx: f64,
    pub zy: f64,
}

/// Gauss rules for cells at any distance.
///
/// The number of points in a direction depends on distance over side only: enough for `exp(-c r/h)/r` at the largest `c r/h`
/// that matters at a contrast of 1e6. A fixed order needs no error estimate, which the rounding of the table would defeat.
#[derive(Clone, Debug)]
pub(crate) struct CellQuadrature {
    rules: [(f64, GaussRule); 7],
    pub(super) polar_angle: GaussRule,
    pub(super) polar_radius: GaussRule,
}

/// A rectangle seen from the point whose displacement is asked.
#[derive(Clone, Copy, Debug)]
struct Rectangle {
    centre: [f64; 2],
    sides: [f64; 2],
}

/// Largest number of points in one direction.
pub(super) const MOST_POINTS: usize = 11;

impl CellQuadrature {
    pub(crate) fn new() -> Self {
        let up_to = |ratio: f64, count: usize| (ratio, GaussRule::new(count));
        Self {
            rules: [
                up_to(3.0, MOST_POINTS),
                up_to(6.0, 10),
                up_to(12.0, 8),
                up_to(20.0, 6),
                up_to(40.0, 5),
                up_to(200.0, 4),
                up_to(f64::INFINITY, 3),
            ],
            polar_angle: GaussRule::new(28),
            polar_radius: GaussRule::new(14),
        }
    }

    /// The rule for a rectangle whose distance is so many times its side.
    pub(super) fn rule(&self, distance_over_side: f64) -> &[(f64, f64)] {
        let index = self.rules[..6].iter().position(|(limit, _)| distance_over_side < *limit).unwrap_or(6);
        &self.rules[index].1.points
    }

    /// Displacement at `offset` from the centre of a loaded cell, outside that cell.
    pub(crate) fn distant_cell(
        &self,
        kernels: &RadialKernels,
        offset: [f64; 2],
        sides: [f64; 2],
    ) -> CellResponse {
        let mut sum = CellResponse::default();
        self.add_rectangle(kernels, Rectangle { centre: offset, sides }, &mut sum);
        // the parts that are odd across an axis vanish on it
        if offset[0] == 0.0 {
            (sum.xy, sum.zx) = (0.0, 0.0);
        }
        if offset[1] == 0.0 {
            (sum.xy, sum.zy) = (0.0, 0.0);
        }
        sum
    }

    /// Adds one rectangle, halved across its longer side while that is longer than half its distance.
    fn add_rectangle(&self, kernels: &RadialKernels, rectangle: Rectangle, sum: &mut CellResponse) {
        let Rectangle { centre, sides } = rectangle;
        let distance = (centre[0] * centre[0] + centre[1] * centre[1]).sqrt();
        let longer = usize::from(sides[1] > sides[0]);
        if sides[longer] > 0.5 * distance {
            let quarter = 0.25 * sides[longer];
            for shift in [-quarter, quarter] {
                let mut half = rectangle;
                half.centre[longer] += shift;
                half.sides[longer] *= 0.5;
                self.add_rectangle(kernels, half, sum);
            }
        } else {
            let rules = [self.rule(distance / sides[0]), self.rule(distance / sides[1])];
            add_gauss_points(kernels, rectangle, rules, sum);
        }
    }

    /// Displacement at the centre of the loaded cell itself: the inscribed disc by its antiderivative, the rest of the
    /// rectangle in polar coordinates.
    pub(crate) fn own_cell(&self, kernels: &RadialKernels, sides: [f64; 2]) -> CellResponse {
        let [disc_zz, disc_mean] = kernels.over_disc();
        let half = [0.5 * sides[0], 0.5 * sides[1]];
        let towards_x = self.sector(kernels, half[0], half[1]);
        let towards_y = self.sector(kernels, half[1], half[0]);
        let mean = disc_mean + 4.0 * (towards_x[1] + towards_y[1]);
        let difference = 4.0 * (towards_x[2] - towards_y[2]);
        CellResponse {
            zz: disc_zz + 4.0 * (towards_x[0] + towards_y[0]),
            xx: mean - difference,
            yy: mean + difference,
            ..CellResponse::default()
        }
    }

    /// Integrals of Z0, A0 and cos(2 phi) B2 between the disc and an edge at distance `edge` with half length `half_length`,
    /// over half the angle under which the edge is seen; phi is the angle from the edge's normal.
    fn sector(&self, kernels: &RadialKernels, edge: f64, half_length: f64) -> [f64; 3] {
        let radius = kernels.disc_radius();
        let last = libm::asinh(half_length / edge);
        let mut sum = [0.0; 3];
        for (point, weight) in &self.polar_angle.points {
            // y = edge sinh(tau), so that the distance of the edge is edge cosh(tau)
            let tau = 0.5 * last * (1.0 + point);
            let (sinh, cosh) = (libm::sinh(tau), libm::cosh(tau));
            let cos_double = (1.0 - sinh) * (1.0 + sinh) / (cosh * cosh);
            let reach = libm::log(edge * cosh / radius);
            if reach <= 0.0 {
                continue;
            }
            let panels = (reach / 0.35).ceil();
            let angle_weight = 0.5 * last * weight / cosh * (0.5 * reach / panels);
            for panel in 0..panels as u32 {
                for (point, weight) in &self.polar_radius.points {
                    let log_radius = reach * (f64::from(panel) + 0.5 * (1.0 + point)) / panels;
                    let r = radius * libm::exp(log_radius);
                    let square = r * r;
                    let [z0, a0, b2_per_square, _] = kernels.at_square(square);
                    let weight = angle_weight * weight * square;
                    sum[0] += weight * z0;
                    sum[1] += weight * a0;
                    sum[2] += weight * cos_double * b2_per_square * square;
                }
            }
        }
        sum
    }
}

fn add_gauss_points(
    kernels: &RadialKernels,
    rectangle: Rectangle,
    rules: [&[(f64, f64)]; 2],
    sum: &mut CellResponse,
) {
    let Rectangle { centre, sides } = rectangle;
    let half = [0.5 * sides[0], 0.5 * sides[1]];
    let mut column = [[0.0; 3]; MOST_POINTS];
    for (place, (point, weight)) in column.iter_mut().zip(rules[1]) {
        let y = centre[1] + half[1] * point;
        *place = [y, y * y, weight * half[1]];
    }
    let column = &column[..rules[1].len()];
    let [mut zz, mut mean, mut difference, mut xy, mut zx, mut zy] = [0.0; 6];
    for (point, weight) in rules[0] {
        let x = centre[0] + half[0] * point;
        let xx = x * x;
        let weight_x = weight * half[0];
        for [y, yy, weight_y] in column {
            let [z0, a0, b, z] = kernels.at_square(xx + yy);
            let weight = weight_x * weight_y;
            let (weight_b, weight_z) = (weight * b, weight * z);
            zz += weight * z0;
            mean += weight * a0;
            difference += weight_b * (xx - yy);
            xy += weight_b * (x * y);
            zx += weight_z * x;
            zy += weight_z * y;
        }
    }
    sum.zz += zz;
    sum.xx += mean - difference;
    sum.yy += mean + difference;
    sum.xy -= 2.0 * xy;
    sum.zx += zx;
    sum.zy += zy;
}

#[cfg(test)]
mod tests {
    use super::super::closed_form::homogeneous_cell;
    use super::super::pair_response::PairResponse;
    use super::super::samples::{material, pair};
    use super::*;
    use crate::model::ContactPair;

    fn kernels(pair: &ContactPair, sides: [f64; 2], farthest: f64) -> RadialKernels {
        RadialKernels::new(&PairResponse::new(pair), 0.5 * sides[0].min(sides[1]), farthest)
    }

    fn cell(
        quadrature: &CellQuadrature,
        kernels: &RadialKernels,
        offset: [f64; 2],
        sides: [f64; 2],
    ) -> CellResponse {
        if offset == [0.0, 0.0] {
            quadrature.own_cell(kernels, sides)
        } else {
            quadrature.distant_cell(kernels, offset, sides)
        }
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
                for (i, j) in [
                    (0, 0),
                    (1, 0),
                    (0, 1),
                    (1, 1),
                    (2, 1),
                    (0, 3),
                    (5, 2),
                    (3, 7),
                    (17, 0),
                    (40, 17),
                    (120, 90),
                ] {
                    let offset = [f64::from(i) * sides[0], f64::from(j) * sides[1]];
                    let found = cell(&quadrature, &kernels, offset, sides);
                    let exact = homogeneous_cell(&material((2.6, nu)), offset, sides);
                    let far = (offset[0] * offset[0] + offset[1] * offset[1]) / (sides[0] * sides[1]);
                    let error = difference(found, exact);
                    let tolerance = 1e-14 + 3e-15 * far; // rounding of our sums; of the closed form's corner differences
                    assert!(
                        error < tolerance,
                        "nu {nu}, {sides:?}, ({i}, {j}): {error:.1e} > {tolerance:.1e}"
                    );
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
            let found = cell(&quadrature, &kernels, offset, [1.0, 1.0]);
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
                    let whole = cell(&quadrature, &coarse, offset, sides);
                    let mut sum = CellResponse::default();
                    for a in -(parts[0] / 2)..=parts[0] / 2 {
                        for b in -(parts[1] / 2)..=parts[1] / 2 {
                            // whole numbers of small sides, so that the middle one is exactly at the point
                            let place = [
                                f64::from(i * parts[0] + a) * small[0],
                                f64::from(j * parts[1] + b) * small[1],
                            ];
                            let part = cell(&quadrature, &fine, place, small);
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
}
