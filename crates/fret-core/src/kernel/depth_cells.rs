//! Kernels at depth integrated over rectangular cells: what a unit traction on one cell does under another.

use ndarray::Array2;
use rayon::prelude::*;

use super::cells::{CellQuadrature, MOST_POINTS};
use super::depth_radial::{DepthKernels, Quartet};
use super::depth_response::DepthResponse;

/// Which load, and which answer to it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Load {
    Pressure,
    ShearX,
    ShearY,
}

/// Stress under a cell from unit pressure on another, and from unit shear: shape `(nx, ny)` over offsets `i, j >= 0`, from the
/// loaded cell to the point. Order of the components: xx, yy, zz, xy, xz, yz.
///
/// Parities: from pressure xx, yy, zz even-even, xy odd-odd, xz odd-even, yz even-odd. From `q_x` those with the parity along x
/// turned, from `q_y` along y.
#[derive(Clone, Debug)]
pub(crate) struct StressCoefficients {
    pub pressure: [Array2<f64>; 6],
    /// From `q_x` and from `q_y`.
    pub shear: Option<[[Array2<f64>; 6]; 2]>,
}

/// Displacement `u_x, u_y, u_z` under a cell from pressure, `q_x`, `q_y` on another [length/pressure].
#[derive(Clone, Debug)]
pub(crate) struct DisplacementCoefficients {
    pub from: [[Array2<f64>; 3]; 3],
}

/// Integrals over one cell of the kernels of a quartet times the angular factors of their orders.
///
/// Order 0: `[K]`; 1: `[K x, K y]`; 2: `[K (x^2 - y^2), K x y]`; 3: `[K (x^3 - 3 x y^2), K (3 x^2 y - y^3)]`, two entries a lane.
type Moments = [[f64; 2]; 4];

#[derive(Clone, Copy)]
struct Rectangle {
    centre: [f64; 2],
    sides: [f64; 2],
}

/// Cells under which the kernels of one depth are integrated.
struct DepthCells<'a, const N: usize> {
    quadrature: &'a CellQuadrature,
    kernels: &'a [DepthKernels; N],
    orders: [[usize; 4]; N],
    depth: f64,
}

impl<const N: usize> DepthCells<'_, N> {
    fn moments(&self, offset: [f64; 2], sides: [f64; 2]) -> [Moments; N] {
        let mut sum = [[[0.0; 2]; 4]; N];
        if offset == [0.0, 0.0] {
            self.add_own_cell(sides, &mut sum);
        } else {
            self.add_rectangle(Rectangle { centre: offset, sides }, &mut sum);
        }
        sum
    }

    /// Adds one rectangle, halved across its longer side while that is longer than half its distance.
    fn add_rectangle(&self, rectangle: Rectangle, sum: &mut [Moments; N]) {
        let Rectangle { centre, sides } = rectangle;
        // kernels are smooth on the scale of the distance from the load, depth included
        let distance = (centre[0] * centre[0] + centre[1] * centre[1] + self.depth * self.depth).sqrt();
        let longer = usize::from(sides[1] > sides[0]);
        if sides[longer] > 0.5 * distance {
            let quarter = 0.25 * sides[longer];
            for shift in [-quarter, quarter] {
                let mut half = rectangle;
                half.centre[longer] += shift;
                half.sides[longer] *= 0.5;
                self.add_rectangle(half, sum);
            }
        } else {
            let rules =
                [self.quadrature.rule(distance / sides[0]), self.quadrature.rule(distance / sides[1])];
            self.add_gauss_points(rectangle, rules, sum);
        }
    }

    fn add_gauss_points(&self, rectangle: Rectangle, rules: [&[(f64, f64)]; 2], sum: &mut [Moments; N]) {
        let Rectangle { centre, sides } = rectangle;
        let half = [0.5 * sides[0], 0.5 * sides[1]];
        let mut column = [[0.0; 3]; MOST_POINTS];
        for (place, (point, weight)) in column.iter_mut().zip(rules[1]) {
            let y = centre[1] + half[1] * point;
            *place = [y, y * y, weight * half[1]];
        }
        for (point, weight) in rules[0] {
            let x = centre[0] + half[0] * point;
            let xx = x * x;
            let weight_x = weight * half[0];
            for [y, yy, weight_y] in &column[..rules[1].len()] {
                let weight = weight_x * weight_y;
                let factors = [
                    [weight, 0.0],
                    [weight * x, weight * y],
                    [weight * (xx - yy), weight * (x * y)],
                    [weight * x * (xx - 3.0 * yy), weight * y * (3.0 * xx - yy)],
                ];
                for quartet in 0..N {
                    let values = self.kernels[quartet].at_square(xx + yy);
                    let (orders, sum) = (&self.orders[quartet], &mut sum[quartet]);
                    for lane in 0..4 {
                        let factor = factors[orders[lane]];
                        sum[lane][0] += values[lane] * factor[0];
                        sum[lane][1] += values[lane] * factor[1];
                    }
                }
            }
        }
    }

    /// The loaded cell itself: the inscribed disc by its antiderivative, the rest of the rectangle in polar coordinates. Odd
    /// kernels vanish.
    fn add_own_cell(&self, sides: [f64; 2], sum: &mut [Moments; N]) {
        for quartet in 0..N {
            let disc = self.kernels[quartet].over_disc();
            for lane in 0..4 {
                sum[quartet][lane][0] += disc[lane];
            }
        }
        let radius = 0.5 * sides[0].min(sides[1]);
        self.add_sector(radius, 0.5 * sides[0], 0.5 * sides[1], 1.0, sum);
        self.add_sector(radius, 0.5 * sides[1], 0.5 * sides[0], -1.0, sum);
    }

    /// Adds the four parts between the disc and the edges at distance `edge` with half length `half_length`; `sign` is that of
    /// `cos 2 phi` when phi is counted from the edge's normal instead of from x.
    fn add_sector(&self, radius: f64, edge: f64, half_length: f64, sign: f64, sum: &mut [Moments; N]) {
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
                    for quartet in 0..N {
                        let values = self.kernels[quartet].at_square(square);
                        for lane in 0..4 {
                            match self.orders[quartet][lane] {
                                0 => sum[quartet][lane][0] += weight * values[lane],
                                2 => sum[quartet][lane][0] += weight * values[lane] * square * cos_double,
                                _ => {}
                            }
                        }
                    }
                }
            }
        }
    }
}

/// Moments of all cells, row by row. On square grids of square cells those below the diagonal are turned ones from above.
fn all_moments<const N: usize>(
    response: &DepthResponse,
    quartets: [Quartet; N],
    cells: [usize; 2],
    spacing: [f64; 2],
) -> Vec<[Moments; N]> {
    let size = [cells[0] as f64 * spacing[0], cells[1] as f64 * spacing[1]];
    let least = 0.5 * spacing[0].min(spacing[1]);
    let greatest = (size[0] * size[0] + size[1] * size[1]).sqrt();
    let kernels = DepthKernels::new(response, quartets, least, greatest);
    let quadrature = CellQuadrature::new();
    let orders = quartets.map(Quartet::orders);
    let integrated =
        DepthCells { quadrature: &quadrature, kernels: &kernels, orders, depth: response.depth() };
    let mirrored = cells[0] == cells[1] && spacing[0] == spacing[1];
    let mut moments = vec![[[[0.0; 2]; 4]; N]; cells[0] * cells[1]];
    moments.par_chunks_mut(cells[1]).enumerate().for_each(|(i, row)| {
        let count = if mirrored { i + 1 } else { cells[1] };
        for (j, moments) in row[..count].iter_mut().enumerate() {
            *moments = integrated.moments([i as f64 * spacing[0], j as f64 * spacing[1]], spacing);
        }
    });
    if mirrored {
        for i in 0..cells[0] {
            for j in i + 1..cells[1] {
                let other = moments[j * cells[1] + i];
                let place = &mut moments[i * cells[1] + j];
                for quartet in 0..N {
                    for lane in 0..4 {
                        place[quartet][lane] = turned(orders[quartet][lane], other[quartet][lane]);
                    }
                }
            }
        }
    }
    moments
}

/// Moments with x and y exchanged.
fn turned(order: usize, [one, two]: [f64; 2]) -> [f64; 2] {
    match order {
        0 => [one, two],
        1 => [two, one],
        2 => [-one, two],
        _ => [-two, -one],
    }
}

/// Stress coefficients of one depth on a grid; shear is left out where it is not wanted.
pub(crate) fn stress_coefficients(
    response: &DepthResponse,
    cells: [usize; 2],
    spacing: [f64; 2],
    with_shear: bool,
) -> StressCoefficients {
    let array = |values: &dyn Fn(usize) -> f64| {
        Array2::from_shape_fn((cells[0], cells[1]), |(i, j)| values(i * cells[1] + j))
    };
    if !with_shear {
        let moments = all_moments(response, [Quartet::PressureStress], cells, spacing);
        let pressure = std::array::from_fn(|c| array(&|cell| from_pressure(&moments[cell][0])[c]));
        return StressCoefficients { pressure, shear: None };
    }
    let quartets = [Quartet::PressureStress, Quartet::ShearStress, Quartet::ShearTraction];
    let moments = all_moments(response, quartets, cells, spacing);
    let pressure = std::array::from_fn(|c| array(&|cell| from_pressure(&moments[cell][0])[c]));
    let shear = [Load::ShearX, Load::ShearY].map(|load| {
        std::array::from_fn(|c| array(&|cell| from_shear(load, &moments[cell][1], &moments[cell][2])[c]))
    });
    StressCoefficients { pressure, shear: Some(shear) }
}

/// xx, yy, zz, xy, xz, yz.
fn from_pressure([normal, mean, difference, shear]: &Moments) -> [f64; 6] {
    [mean[0] - difference[0], mean[0] + difference[0], -normal[0], -2.0 * difference[1], shear[0], shear[1]]
}

fn from_shear(load: Load, stress: &Moments, traction: &Moments) -> [f64; 6] {
    let [normal, mean, single, triple] = stress;
    let [even, double, ..] = traction;
    if load == Load::ShearX {
        [
            mean[0] + single[0] - triple[0],
            mean[0] - single[0] + triple[0],
            -normal[0],
            single[1] - triple[1],
            -even[0] + double[0],
            2.0 * double[1],
        ]
    } else {
        [
            mean[1] - single[1] - triple[1],
            mean[1] + single[1] + triple[1],
            -normal[1],
            single[0] + triple[0],
            2.0 * double[1],
            -even[0] - double[0],
        ]
    }
}

/// Displacement coefficients of one depth on a grid.
pub(crate) fn displacement_coefficients(
    response: &DepthResponse,
    cells: [usize; 2],
    spacing: [f64; 2],
) -> DisplacementCoefficients {
    let moments = all_moments(response, [Quartet::Displacement, Quartet::Rise], cells, spacing);
    let from = [Load::Pressure, Load::ShearX, Load::ShearY].map(|load| {
        std::array::from_fn(|component| {
            Array2::from_shape_fn((cells[0], cells[1]), |(i, j)| {
                displacement(load, &moments[i * cells[1] + j])[component]
            })
        })
    });
    DisplacementCoefficients { from }
}

fn displacement(load: Load, [four, [rise, ..]]: &[Moments; 2]) -> [f64; 3] {
    let [depthwise, mean, double, radial] = four;
    match load {
        Load::Pressure => [-radial[0], -radial[1], depthwise[0]],
        Load::ShearX => [mean[0] - double[0], -2.0 * double[1], rise[0]],
        Load::ShearY => [-2.0 * double[1], mean[0] + double[0], rise[1]],
    }
}
