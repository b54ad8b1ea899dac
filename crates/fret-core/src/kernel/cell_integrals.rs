//! Radial kernels integrated over one rectangular cell: near the load by Gauss points, far from it by five.

use std::marker::PhantomData;

use pulp::Simd;

use super::cell_rules::{CellQuadrature, MOST_POINTS};
use super::far_cells::FIVE_POINTS;
use super::panels::{Lanes, fused};
use super::quartets::Quartets;
use super::radial::RadialKernels;

/// Integrals over one cell of the kernels of a quartet times the angular factors of their orders.
///
/// Order 0: `[K]`; 1: `[K x, K y]`; 2: `[K (x^2 - y^2), K x y]`; 3: `[K (x^3 - 3 x y^2), K (3 x^2 y - y^3)]`: first and second
/// entry of all lanes.
pub(super) type Moments = [Lanes; 2];

#[derive(Clone, Copy)]
pub(super) struct Rectangle {
    pub centre: [f64; 2],
    pub sides: [f64; 2],
}

/// Adds the values at a point, times a weight.
#[inline(always)]
fn add_point<S: Simd, Q: Quartets<N>, const N: usize>(
    kernels: &RadialKernels<N>,
    [x, y]: [f64; 2],
    weight: f64,
    sum: &mut [Moments; N],
) {
    let (xx, yy) = (x * x, y * y);
    let values = kernels.at_square::<S>(xx + yy);
    add_values::<S, Q, N>(&values, [x, y], weight, sum);
}

#[inline(always)]
fn add_values<S: Simd, Q: Quartets<N>, const N: usize>(
    values: &[Lanes; N],
    [x, y]: [f64; 2],
    weight: f64,
    sum: &mut [Moments; N],
) {
    let (xx, yy) = (x * x, y * y);
    let (weight_x, weight_y) = (weight * x, weight * y);
    let first = [weight, weight_x, weight * (xx - yy), weight_x * (xx - 3.0 * yy)];
    let second = [0.0, weight_y, weight_x * y, weight_y * (3.0 * xx - yy)];
    for quartet in 0..N {
        let [first, second] = [Q::LIST[quartet].spread(first), Q::LIST[quartet].spread(second)];
        for lane in 0..4 {
            sum[quartet][0][lane] = fused::<S>(values[quartet][lane], first[lane], sum[quartet][0][lane]);
        }
        for lane in 0..4 {
            sum[quartet][1][lane] = fused::<S>(values[quartet][lane], second[lane], sum[quartet][1][lane]);
        }
    }
}

/// The integral over a far square cell.
#[inline(always)]
pub(super) fn add_five_points<S: Simd, Q: Quartets<N>, const N: usize>(
    kernels: &RadialKernels<N>,
    centre: [f64; 2],
    side: f64,
    sum: &mut [Moments; N],
) {
    let area = side * side;
    for (point, weight) in FIVE_POINTS {
        let place = [centre[0] + side * point[0], centre[1] + side * point[1]];
        if place == [0.0, 0.0] {
            add_values::<S, Q, N>(&kernels.innermost(), place, area * weight, sum);
        } else {
            add_point::<S, Q, N>(kernels, place, area * weight, sum);
        }
    }
}

/// Cells whose distance from the load may be small.
pub(super) struct NearCells<'a, Q, const N: usize> {
    pub quadrature: &'a CellQuadrature,
    pub kernels: &'a RadialKernels<N>,
    pub depth: f64,
    pub quartets: PhantomData<Q>,
}

impl<Q: Quartets<N>, const N: usize> NearCells<'_, Q, N> {
    /// Adds rectangles, each halved across its longer side while that is longer than half its distance. Leaves none.
    #[inline(always)]
    pub(super) fn add_rectangles<S: Simd>(&self, rectangles: &mut Vec<Rectangle>, sum: &mut [Moments; N]) {
        while let Some(rectangle) = rectangles.pop() {
            let Rectangle { centre, sides } = rectangle;
            // kernels are smooth on the scale of the distance from the load, depth included
            let distance = (centre[0] * centre[0] + centre[1] * centre[1] + self.depth * self.depth).sqrt();
            let longer = usize::from(sides[1] > sides[0]);
            if sides[longer] > 0.5 * distance {
                let quarter = 0.25 * sides[longer];
                for shift in [quarter, -quarter] {
                    let mut half = rectangle;
                    half.centre[longer] += shift;
                    half.sides[longer] *= 0.5;
                    rectangles.push(half);
                }
            } else {
                let rules =
                    [self.quadrature.rule(distance / sides[0]), self.quadrature.rule(distance / sides[1])];
                self.add_gauss_points::<S>(rectangle, rules, sum);
            }
        }
    }

    #[inline(always)]
    fn add_gauss_points<S: Simd>(
        &self,
        rectangle: Rectangle,
        rules: [&[(f64, f64)]; 2],
        sum: &mut [Moments; N],
    ) {
        let Rectangle { centre, sides } = rectangle;
        let half = [0.5 * sides[0], 0.5 * sides[1]];
        let mut column = [[0.0; 2]; MOST_POINTS];
        for (place, (point, weight)) in column.iter_mut().zip(rules[1]) {
            *place = [centre[1] + half[1] * point, weight * half[1]];
        }
        let mut parts = [[[0.0; 4]; 2]; N];
        for (point, weight) in rules[0] {
            let x = centre[0] + half[0] * point;
            let weight_x = weight * half[0];
            for [y, weight_y] in &column[..rules[1].len()] {
                add_point::<S, Q, N>(self.kernels, [x, *y], weight_x * weight_y, &mut parts);
            }
        }
        for quartet in 0..N {
            for entry in 0..2 {
                for lane in 0..4 {
                    sum[quartet][entry][lane] += parts[quartet][entry][lane];
                }
            }
        }
    }

    /// The loaded cell itself: the inscribed disc by its antiderivative, the rest of the rectangle in polar coordinates. Odd
    /// kernels vanish.
    #[inline(always)]
    pub(super) fn add_own_cell<S: Simd>(&self, sides: [f64; 2], sum: &mut [Moments; N]) {
        let radius = 0.5 * sides[0].min(sides[1]);
        // many small terms by themselves, not onto the disc
        let mut parts = [[[0.0; 4]; 2]; N];
        for (edge, half_length, sign) in
            [(0.5 * sides[0], 0.5 * sides[1], 1.0), (0.5 * sides[1], 0.5 * sides[0], -1.0)]
        {
            self.add_sector::<S>(radius, edge, half_length, sign, &mut parts);
        }
        let disc = self.kernels.innermost();
        for quartet in 0..N {
            for lane in 0..4 {
                sum[quartet][0][lane] += disc[quartet][lane] + parts[quartet][0][lane];
            }
        }
    }

    /// Adds the four parts between the disc and the edges at distance `edge` with half length `half_length`; `sign` is that of
    /// `cos 2 phi` when phi is counted from the edge's normal instead of from x.
    #[inline(always)]
    fn add_sector<S: Simd>(
        &self,
        radius: f64,
        edge: f64,
        half_length: f64,
        sign: f64,
        sum: &mut [Moments; N],
    ) {
        let last = libm::asinh(half_length / edge);
        for (point, weight) in &self.quadrature.polar_angle.points {
            // y = edge sinh(tau), so that the distance of the edge is edge cosh(tau)
            let tau = 0.5 * last * (1.0 + point);
            let (sinh, cosh) = (libm::sinh(tau), libm::cosh(tau));
            let cos_double = sign * (1.0 - sinh) * (1.0 + sinh) / (cosh * cosh);
            let reach = libm::log(edge * cosh / radius);
            if reach <= 0.0 {
                continue;
            }
            let panels = (reach / 0.35).ceil();
            let angle_weight = 4.0 * 0.5 * last * weight / cosh * (0.5 * reach / panels);
            for panel in 0..panels as u32 {
                for (point, weight) in &self.quadrature.polar_radius.points {
                    let log_radius = reach * (f64::from(panel) + 0.5 * (1.0 + point)) / panels;
                    let r = radius * libm::exp(log_radius);
                    let square = r * r;
                    let weight = angle_weight * weight * square;
                    let values = self.kernels.at_square::<S>(square);
                    let factors = [weight, 0.0, weight * square * cos_double, 0.0];
                    for quartet in 0..N {
                        let factors = Q::LIST[quartet].spread(factors);
                        for lane in 0..4 {
                            sum[quartet][0][lane] += values[quartet][lane] * factors[lane];
                        }
                    }
                }
            }
        }
    }
}
