//! Kernels at depth integrated over rectangular cells: stresses and displacements.

use ndarray::{Array2, s};
use rayon::prelude::*;

use super::cell_integrals::Moments;
use super::cells::{CellCoefficients, Tables, coefficients};
use super::depth_response::DepthResponse;
use super::lattice_samples::WaveResponse;
use super::line_depth::line_stress_coefficients;
use super::quartets::{DisplacementFromAll, StressFromAll, StressFromPressure};
use super::repeated::{fold, repeated, window, with_images};

/// xx, yy, zz, xy, xz, yz when x and y are exchanged.
const STRESS_EXCHANGED: [usize; 6] = [1, 0, 2, 3, 5, 4];

/// Which of them are odd along x and along y, from pressure; shear turns the axis along which it acts.
const STRESS_ODD: [[bool; 2]; 6] =
    [[false; 2], [false; 2], [false; 2], [true; 2], [true, false], [false, true]];

/// Whether a kernel, `6 load + component`, is odd along x and along y.
pub(super) fn stress_odd(kernel: usize) -> [bool; 2] {
    let [x, y] = STRESS_ODD[kernel % 6];
    [x != (kernel / 6 == 1), y != (kernel / 6 == 2)]
}

/// Stress coefficients of one depth on a grid; shear is left out where it is not wanted. `memory` is written over.
pub(crate) fn stress_coefficients(
    response: &impl WaveResponse,
    cells: [usize; 2],
    spacing: [f64; 2],
    with_shear: bool,
    memory: Vec<f64>,
) -> CellCoefficients<6> {
    if with_shear {
        let tables = Tables::<StressFromAll, 3>::new(response, cells, spacing);
        coefficients(&tables, cells, memory, STRESS_EXCHANGED, stress_from_all)
    } else {
        let tables = Tables::<StressFromPressure, 1>::new(response, cells, spacing);
        coefficients(&tables, cells, memory, STRESS_EXCHANGED, |[pressure]| [from_pressure(pressure)])
    }
}

/// The same where the contact repeats along `axis` (0: x, 1: y), from tractions on all images: those of a line contact where nothing changes along
/// that axis.
pub(crate) fn repeated_stress_coefficients(
    response: &impl WaveResponse,
    (cells, spacing): ([usize; 2], [f64; 2]),
    axis: usize,
    with_shear: bool,
) -> CellCoefficients<6> {
    if axis == 0 {
        let turned = ([cells[1], cells[0]], [spacing[1], spacing[0]]);
        let found = repeated_stress_coefficients(response, turned, 1, with_shear);
        return found.with_axes_exchanged(STRESS_EXCHANGED);
    }
    let line = line_stress_coefficients(response, cells[0], spacing[0], with_shear);
    let uniform = |i: usize, kernel: usize| line.kernel(kernel / 6, kernel % 6)[[i, 0]];
    let reach = with_images(cells);
    if with_shear {
        let tables = Tables::<StressFromAll, 3>::new(response, reach, spacing);
        repeated(&tables, cells, uniform, stress_odd, stress_from_all)
    } else {
        let tables = Tables::<StressFromPressure, 1>::new(response, reach, spacing);
        repeated(&tables, cells, uniform, stress_odd, |[pressure]| [from_pressure(pressure)])
    }
}

/// The same where the contact repeats along both axes, of so many cells in a period: of each kernel, `6 load + component`, the values over the offsets
/// of one period. `uniform[load][component]` is what uniform tractions do.
///
/// The sum over all images along y, exact by itself, is summed over those along x behind a window, and its mean along x put right: what a row of
/// cells without end along x does, a line contact that repeats along y.
pub(super) fn stress_coefficients_in_period(
    response: &impl WaveResponse,
    (period, spacing): ([usize; 2], [f64; 2]),
    uniform: &[[f64; 6]; 3],
    with_shear: bool,
) -> Vec<Array2<f64>> {
    let [across, along] = period.map(window);
    let rows = repeated_stress_coefficients(response, ([across.len(), period[1]], spacing), 1, with_shear);
    let line = line_stress_coefficients(response, along.len(), spacing[1], with_shear)
        .with_axes_exchanged(STRESS_EXCHANGED);
    let of_kernel = |kernel: usize| {
        let ([load, component], [odd_x, odd_y]) = ([kernel / 6, kernel % 6], stress_odd(kernel));
        let mut without_end = vec![0.0; period[1]];
        let single = line.kernel(load, component).iter().copied().collect::<Vec<_>>();
        fold(&single, &along, odd_y, uniform[load][component], &mut without_end);
        let mut values = Array2::zeros((period[1], period[0]));
        for (j, mut row) in values.rows_mut().into_iter().enumerate() {
            let single = rows.values.slice(s![.., kernel, j]).to_vec();
            let row = row.as_slice_mut().unwrap_or_default(); // contiguous: made by `zeros`
            fold(&single, &across, odd_x, without_end[j], row);
        }
        values.reversed_axes()
    };
    (0..rows.values.dim().1).into_par_iter().map(of_kernel).collect()
}

#[inline(always)]
fn stress_from_all([pressure, stress, traction]: &[Moments; 3]) -> [[f64; 6]; 3] {
    let [x, y] = from_shear(stress, traction);
    [from_pressure(pressure), x, y]
}

/// xx, yy, zz, xy, xz, yz.
#[inline(always)]
fn from_pressure([[normal, mean, difference, along_x], [_, _, shear, along_y]]: &Moments) -> [f64; 6] {
    [mean - difference, mean + difference, -normal, -2.0 * shear, *along_x, *along_y]
}

/// From `q_x` and from `q_y`.
#[inline(always)]
fn from_shear(stress: &Moments, traction: &Moments) -> [[f64; 6]; 2] {
    let [[normal, mean, single, triple], [normal_y, mean_y, single_y, triple_y]] = stress;
    let [[even, double, ..], [_, double_y, ..]] = traction;
    [
        [
            mean + single - triple,
            mean - single + triple,
            -normal,
            single_y - triple_y,
            -even + double,
            2.0 * double_y,
        ],
        [
            mean_y - single_y - triple_y,
            mean_y + single_y + triple_y,
            -normal_y,
            single + triple,
            2.0 * double_y,
            -even - double,
        ],
    ]
}

/// Displacement coefficients of one depth on a grid. `memory` is written over.
pub(crate) fn displacement_coefficients(
    response: &DepthResponse,
    cells: [usize; 2],
    spacing: [f64; 2],
    memory: Vec<f64>,
) -> CellCoefficients<3> {
    let tables = Tables::<DisplacementFromAll, 2>::new(response, cells, spacing);
    coefficients(&tables, cells, memory, [1, 0, 2], displacement_from_all)
}

#[inline(always)]
fn displacement_from_all([four, [[rise, ..], [rise_y, ..]]]: &[Moments; 2]) -> [[f64; 3]; 3] {
    let [[depthwise, mean, double, radial], [_, _, double_y, radial_y]] = four;
    [
        [-radial, -radial_y, *depthwise],
        [mean - double, -2.0 * double_y, *rise],
        [-2.0 * double_y, mean + double, *rise_y],
    ]
}

#[cfg(test)]
mod tests {
    use super::super::closed_form::homogeneous_cell;
    use super::super::samples::{golden, material, stack};
    use super::*;
    use ndarray::Axis;
    use serde::Deserialize;

    #[derive(Deserialize)]
    struct Row {
        layers: Vec<(f64, f64, f64)>,
        substrate: Option<(f64, f64)>,
        depth: f64,
        layer: usize,
        sides: [f64; 2],
        i: usize,
        j: usize,
        stress: [[f64; 6]; 3],
    }

    #[test]
    fn golden_rows_of_stresses_are_met() {
        // by plane waves; their dense systems lose up to 1e-13 at a contrast of 100
        let rows = golden::<Row>("subsurface_cells.json");
        for same in rows
            .chunk_by(|a, b| (&a.layers, a.depth, a.layer, a.sides) == (&b.layers, b.depth, b.layer, b.sides))
        {
            let Row { layers, substrate, depth, layer, sides, .. } = &same[0];
            let response = DepthResponse::new(&stack(layers, *substrate), *layer, *depth);
            let found = stress_coefficients(&response, [9, 9], *sides, true, Vec::new());
            let alone = stress_coefficients(&response, [9, 9], *sides, false, Vec::new());
            for row in same {
                for load in 0..3 {
                    for k in 0..6 {
                        let (found, exact) = (found.kernel(load, k)[[row.i, row.j]], row.stress[load][k]);
                        let error = (found - exact).abs();
                        assert!(
                            error < 1e-11,
                            "{layers:?} depth {depth} [{}, {}]: {error:.1e}",
                            row.i,
                            row.j
                        );
                        if load == 0 {
                            let error = (alone.kernel(0, k)[[row.i, row.j]] - exact).abs();
                            assert!(error < 1e-11, "pressure alone, {layers:?} depth {depth}: {error:.1e}");
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn displacements_without_depth_are_those_of_love_and_cerruti() {
        let response = DepthResponse::new(&stack(&[], Some((2.6, 0.3))), 0, 0.0);
        for spacing in [[1.0, 1.0], [1.0, 2.5]] {
            let found = displacement_coefficients(&response, [30, 5], spacing, Vec::new());
            for (i, j) in [(0, 0), (1, 0), (0, 1), (2, 3), (7, 4), (29, 2)] {
                let offset = [f64::from(i) * spacing[0], f64::from(j) * spacing[1]];
                let exact = homogeneous_cell(&material((2.6, 0.3)), offset, spacing);
                // u_z by shear is minus what pressure moves the surface by, at the same offset (Maxwell and Betti)
                let exact = [
                    [-exact.zx, -exact.zy, exact.zz],
                    [exact.xx, exact.xy, exact.zx],
                    [exact.xy, exact.yy, exact.zy],
                ];
                let far = f64::from(i * i + j * j);
                for load in 0..3 {
                    for k in 0..3 {
                        let error = (found.kernel(load, k)[[i as usize, j as usize]] - exact[load][k]).abs();
                        // rounding of our sums; of the closed form's corner differences
                        assert!(
                            error < (1e-14 + 3e-15 * far) * exact[0][2],
                            "{spacing:?} [{i}, {j}], {load} {k}: {error:.1e}"
                        );
                    }
                }
            }
        }
    }

    /// Of one kernel, the largest effect that any traction between -1 and 1 could have of the difference.
    fn effect<const C: usize>(
        found: &CellCoefficients<C>,
        exact: &CellCoefficients<C>,
        kernel: usize,
    ) -> f64 {
        let pairs = found.values.index_axis(Axis(1), kernel).to_owned().into_iter();
        let exact = exact.values.index_axis(Axis(1), kernel);
        4.0 * pairs.zip(exact).map(|(found, exact)| (found - exact).abs()).sum::<f64>()
    }

    #[test]
    fn five_filtered_points_integrate_far_cells_as_well_as_gauss_points() {
        type Case = (&'static [(f64, f64, f64)], Option<(f64, f64)>);
        let cases: [Case; 5] = [
            (&[], Some((1.0, 0.3))),
            (&[(100.0, 0.3, 0.5)], Some((1.0, 0.3))),
            (&[(0.01, 0.2, 0.5)], Some((1.0, 0.4))),
            (&[(1.0, 0.45, 0.3)], None),
            (&[(1e4, 0.25, 0.2), (1.0, 0.5, 1.0)], Some((30.0, 0.3))),
        ];
        // the long way that serves cells of any sides, on a grid that reaches nearly three times as far as where the rule
        // begins
        let (cells, spacing) = ([48; 2], [0.1; 2]);
        let mut worst = [0.0_f64; 2];
        for (layers, substrate) in cases {
            let half_space = stack(layers, substrate);
            for depth in [0.0, 0.04, 0.29, 1.0, 1.59, 1.6, 3.0, 20.0] {
                let bottoms = layers.iter().scan(0.0, |bottom, layer| {
                    *bottom += layer.2;
                    Some(*bottom)
                });
                let layer = bottoms.filter(|bottom| depth > *bottom).count();
                if substrate.is_none() && layer == layers.len() {
                    continue;
                }
                let response = DepthResponse::new(&half_space, layer, depth);
                let found = stress_coefficients(&response, cells, spacing, true, Vec::new());
                let long = Tables::<StressFromAll, 3>::near_only(&response, cells, spacing);
                let exact = coefficients(&long, cells, Vec::new(), STRESS_EXCHANGED, stress_from_all);
                for kernel in 0..18 {
                    let effect = effect(&found, &exact, kernel);
                    worst[0] = worst[0].max(effect);
                    // found: 2e-13, rounding of two tables summed over 9000 cells; the rule's own part is 1e-14 of the local kernel
                    assert!(effect < 1e-12, "{layers:?} depth {depth}, kernel {kernel}: {effect:e}");
                }
                let found = displacement_coefficients(&response, cells, spacing, Vec::new());
                let long = Tables::<DisplacementFromAll, 2>::near_only(&response, cells, spacing);
                let exact = coefficients(&long, cells, Vec::new(), [1, 0, 2], displacement_from_all);
                let size = exact.kernel(0, 2).iter().map(|value| value.abs()).sum::<f64>();
                for kernel in 0..9 {
                    let effect = effect(&found, &exact, kernel) / size;
                    worst[1] = worst[1].max(effect);
                    assert!(effect < 1e-12, "{layers:?} depth {depth}, displacement {kernel}: {effect:e}");
                }
            }
        }
        println!("five points against Gauss points: stress {:.1e}, displacement {:.1e}", worst[0], worst[1]);
    }

    #[test]
    fn offsets_with_x_and_y_exchanged_are_as_if_integrated_themselves() {
        // a grid that is not square integrates every offset; sizes with and without a rest of the blocks
        let response = DepthResponse::new(&stack(&[(2.0, 0.3, 0.5)], Some((1.0, 0.3))), 0, 0.3);
        for n in [1_usize, 5, 16, 21] {
            let square = stress_coefficients(&response, [n, n], [0.1; 2], true, vec![f64::NAN; 7]);
            let long = stress_coefficients(&response, [n, n + 1], [0.1; 2], true, Vec::new());
            for (place, value) in square.values.indexed_iter() {
                let exact = long.values[place];
                // rounding of sums taken in another order, and of another table
                assert!((value - exact).abs() < 1e-14, "{n} {place:?}: {value} {exact}");
            }
        }
    }

    /// Near and far cells are told by lengths of sides and depths: powers of two change no bit of a stress.
    #[test]
    fn stresses_are_the_same_in_every_unit() {
        let of = |length: f64, modulus: f64, depth: f64| {
            let half_space = stack(&[(3.0 * modulus, 0.25, 0.5 * length)], Some((modulus, 0.3)));
            let response = DepthResponse::new(&half_space, usize::from(depth > 0.5), depth * length);
            stress_coefficients(&response, [30, 30], [0.125 * length; 2], true, Vec::new()).values
        };
        for depth in [0.25, 2.5] {
            let before = of(1.0, 1.0, depth);
            for (length, modulus) in
                [(2.0_f64.powi(-20), 2.0_f64.powi(40)), (2.0_f64.powi(10), 2.0_f64.powi(-7))]
            {
                assert!(of(length, modulus, depth) == before, "depth {depth}, {length:e}");
            }
        }
    }
}
