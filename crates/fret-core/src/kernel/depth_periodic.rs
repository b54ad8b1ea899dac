//! Stress and displacement at depth in periodic problems, in the frequency domain: stresses of tractions that are uniform over each cell,
//! displacements of the wavenumbers of the grid alone.

use std::f64::consts::{PI, TAU};

use ndarray::{Array2, Array3, Axis};
use rayon::prelude::*;

use super::aliases::{aliases, nodes, small_period};
use super::cells::CellCoefficients;
use super::depth_cells::{stress_coefficients_in_period, stress_odd};
use super::depth_response::{DepthResponse, Transfer};
use super::lattice_samples::{BelowSurface, WaveResponse};

/// Depth in sides of a cell, the longer ones, from which on the waves of the grid are enough: the least alias is `exp(-12 pi)` = 4e-17 of its
/// traction there, times a depth over wavelength of 40.
const DEEP: f64 = 12.0;

/// Symbols of stress at one depth, shape `(nx/2 + 1, ny/2 + 1)`, in the convention of [`PeriodicSymbols`]: the transfer function
/// is the value times `-i` for every axis along which the kernel is odd. Under the centres of the cells, of tractions that are uniform over each.
/// Shear is left out where it is not wanted, of depths where it costs.
///
/// A uniform pressure compresses without lateral strain (the period is held): `sigma_xx = sigma_yy = -nu/(1 - nu) p`.
///
/// Error about 1e-13 of the traction; of a film 1e4 times as stiff as what it lies on up to 2e-10 of its stress. Cost: one response per wave;
/// above [`DEEP`] that of the coefficients of 160 thousand cells in free space, too.
///
/// [`PeriodicSymbols`]: super::PeriodicSymbols
pub(crate) fn stress_symbols(
    response: &impl BelowSurface,
    cells: [usize; 2],
    spacing: [f64; 2],
    with_shear: bool,
) -> CellCoefficients<6> {
    let mut symbols = stresses_of_waves(response, &waves_of_grid(cells, spacing));
    if response.depth() < DEEP * spacing[0].max(spacing[1]) {
        let small = small_period(cells, spacing);
        let uniform = under_uniform(response);
        let all = stress_coefficients_in_period(response, (small, spacing), &uniform, with_shear);
        let count = nodes(small);
        let of_small = [0, 1].map(|axis| waves(count[axis], small[axis], spacing[axis]));
        let own = stresses_of_waves(response, &of_small);
        let of_kernel = |(kernel, all): (usize, &Array2<f64>)| {
            aliases(all, &own.kernel(kernel / 6, kernel % 6), stress_odd(kernel), cells)
        };
        let found: Vec<_> = all.par_iter().enumerate().map(of_kernel).collect();
        for (kernel, aliases) in found.iter().enumerate() {
            let mut symbols = symbols.values.index_axis_mut(Axis(1), kernel);
            symbols += aliases;
        }
    }
    symbols
}

/// What uniform tractions do.
fn under_uniform(response: &impl BelowSurface) -> [[f64; 6]; 3] {
    let [lateral, arrives] = response.under_uniform();
    [
        [lateral, lateral, -arrives, 0.0, 0.0, 0.0],
        [0.0, 0.0, 0.0, 0.0, -arrives, 0.0],
        [0.0, 0.0, 0.0, 0.0, 0.0, -arrives],
    ]
}

/// Stress by waves as they are.
fn stresses_of_waves(response: &impl BelowSurface, waves: &[Vec<(f64, f64)>; 2]) -> CellCoefficients<6> {
    symbols(response, waves, under_uniform(response), |c, s, t, _| {
        [from_pressure(c, s, t), from_shear_x(c, s, t), exchanged(from_shear_x(s, c, t))]
    })
}

/// Symbols of displacement at one depth [length/pressure]; zero at `k = 0`. Of the grid's own waves alone, as the displacement of the surface
/// that a periodic contact is solved with: at depth 0 they are one.
pub(crate) fn displacement_symbols(
    response: &DepthResponse,
    cells: [usize; 2],
    spacing: [f64; 2],
) -> CellCoefficients<3> {
    symbols(response, &waves_of_grid(cells, spacing), [[0.0; 3]; 3], |c, s, t, k| {
        let per_k = 1.0 / k;
        let difference = t.tangential[0] - t.sideways;
        [
            [-c * t.tangential[1], -s * t.tangential[1], t.depthwise[1]],
            [c * c * t.tangential[0] + s * s * t.sideways, -c * s * difference, c * t.depthwise[0]],
            [-c * s * difference, s * s * t.tangential[0] + c * c * t.sideways, s * t.depthwise[0]],
        ]
        .map(|components| components.map(|value| value * per_k))
    })
}

/// xx, yy, zz, xy, xz, yz.
fn from_pressure(c: f64, s: f64, t: &Transfer<f64>) -> [f64; 6] {
    let (along, across) = (t.along[1], t.across[1]);
    [
        c * c * along + s * s * across,
        s * s * along + c * c * across,
        -t.normal[1],
        -c * s * (along - across),
        c * t.shear[1],
        s * t.shear[1],
    ]
}

fn from_shear_x(c: f64, s: f64, t: &Transfer<f64>) -> [f64; 6] {
    let (along, across, twice) = (t.along[0], t.across[0], 2.0 * t.in_plane_shear);
    [
        c * (c * c * along + s * s * (across - twice)),
        c * (s * s * (along + twice) + c * c * across),
        -c * t.normal[0],
        s * (c * c * (along - across) + 0.5 * twice * (c - s) * (c + s)),
        -(c * c * t.shear[0] + s * s * t.twist_shear),
        c * s * (t.shear[0] - t.twist_shear),
    ]
}

/// With x and y exchanged.
fn exchanged([xx, yy, zz, xy, xz, yz]: [f64; 6]) -> [f64; 6] {
    [yy, xx, zz, xy, yz, xz]
}

/// Wavenumbers of a grid along both axes.
fn waves_of_grid(cells: [usize; 2], spacing: [f64; 2]) -> [Vec<(f64, f64)>; 2] {
    [0, 1].map(|axis| waves(cells[axis] / 2 + 1, cells[axis], spacing[axis]))
}

/// The first wavenumbers of so many cells along an axis, each with what averaging over a cell leaves of the wave.
fn waves(count: usize, cells: usize, side: f64) -> Vec<(f64, f64)> {
    let wave = |index: usize| {
        let k = TAU * index as f64 / (cells as f64 * side);
        let half = PI * index as f64 / cells as f64;
        (k, if index == 0 { 1.0 } else { libm::sin(half) / half })
    };
    (0..count).map(wave).collect()
}

fn symbols<const N: usize>(
    response: &impl WaveResponse,
    [along_x, along_y]: &[Vec<(f64, f64)>; 2],
    uniform: [[f64; N]; 3],
    of_wave: impl Fn(f64, f64, &Transfer<f64>, f64) -> [[f64; N]; 3] + Sync,
) -> CellCoefficients<N> {
    let shape = (along_x.len(), along_y.len());
    let mut values = vec![uniform; shape.0 * shape.1];
    values.par_chunks_mut(shape.1).zip(along_x).for_each(|(row, &(kx, factor_x))| {
        for (value, &(ky, factor_y)) in row.iter_mut().zip(along_y) {
            let k = (kx * kx + ky * ky).sqrt();
            if k > 0.0 {
                let factor = factor_x * factor_y;
                *value = of_wave(kx / k, ky / k, &response.transfer(k), k)
                    .map(|components| components.map(|component| component * factor));
            }
        }
    });
    CellCoefficients::new(Array3::from_shape_fn((shape.0, 3 * N, shape.1), |(a, kernel, b)| {
        values[a * shape.1 + b][kernel / N][kernel % N]
    }))
}

#[cfg(test)]
mod tests {
    use super::super::complex::{Complex, Wavenumber};
    use super::super::samples::stack;
    use super::*;

    /// Axes along which what is positive along `[x, y]` is odd: pressure and depth, x, y; then the six stresses.
    const LOADS: [[bool; 2]; 3] = [[false, false], [true, false], [false, true]];
    const DISPLACEMENTS: [[bool; 2]; 3] = [LOADS[1], LOADS[2], LOADS[0]];
    const STRESSES: [[bool; 2]; 6] = [LOADS[0], LOADS[0], LOADS[0], [true, true], LOADS[1], LOADS[2]];
    const CELLS: [usize; 2] = [8, 6];
    const SPACING: [f64; 2] = [0.4, 0.3];

    /// The transfer function of a symbol: times `-i` for every axis along which the kernel is odd.
    fn transfer(value: f64, load: usize, component: [bool; 2]) -> Complex {
        let odd = [0, 1].map(|axis| LOADS[load][axis] != component[axis]);
        let turned = Complex::new(0.0, -1.0);
        odd.into_iter().filter(|odd| *odd).fold(Complex::new(value, 0.0), |value, _| value * turned)
    }

    /// Wavenumbers of a wave of the grid, and what averaging over a cell leaves of it.
    fn wave([a, b]: [usize; 2]) -> ([f64; 2], f64) {
        let k = [a, b].into_iter().zip(CELLS.into_iter().zip(SPACING));
        let k: Vec<f64> =
            k.map(|(index, (cells, side))| TAU * index as f64 / (cells as f64 * side)).collect();
        let half = [0, 1].map(|axis| 0.5 * k[axis] * SPACING[axis]);
        let averaged = half.map(|half| if half == 0.0 { 1.0 } else { half.sin() / half });
        ([k[0], k[1]], averaged[0] * averaged[1])
    }

    #[test]
    fn stresses_follow_from_displacements_by_hookes_law() {
        let half_space = stack(&[(5.0, 0.2, 0.5)], Some((1.0, 0.4)));
        // in the coating and in the substrate
        for (layer, depth, young, nu) in [(0, 0.3, 5.0, 0.2), (1, 0.8, 1.0, 0.4)] {
            let (mu, lambda) = (0.5 * young / (1.0 + nu), young * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)));
            let at = |depth: f64| DepthResponse::new(&half_space, layer, depth);
            let stress = stresses_of_waves(&at(depth), &waves_of_grid(CELLS, SPACING));
            // derivatives over the depth by five points: errors of h^4 k^5/30 and of rounding over h, both below 1e-10
            let h = 1e-3;
            let displacements = [-2.0, -1.0, 0.0, 1.0, 2.0]
                .map(|steps| displacement_symbols(&at(depth + steps * h), CELLS, SPACING));
            for a in 0..=4 {
                for b in 0..=3 {
                    if a + b == 0 {
                        continue;
                    }
                    let ([kx, ky], _) = wave([a, b]);
                    let slopes = [Complex::new(0.0, kx), Complex::new(0.0, ky)];
                    for load in 0..3 {
                        let u = [0, 1, 2].map(|k| {
                            displacements
                                .each_ref()
                                .map(|u| transfer(u.kernel(load, k)[[a, b]], load, DISPLACEMENTS[k]))
                        });
                        // gradient[i][j]: of component i along j
                        let gradient = u.map(|[ll, l, here, r, rr]| {
                            let along_z = (ll - rr + (r - l) * 8.0) * (1.0 / (12.0 * h));
                            [here * slopes[0], here * slopes[1], along_z]
                        });
                        let opened = gradient[0][0] + gradient[1][1] + gradient[2][2];
                        let own = |i: usize| opened * lambda + gradient[i][i] * (2.0 * mu);
                        let shear = |i: usize, j: usize| (gradient[i][j] + gradient[j][i]) * mu;
                        let exact = [own(0), own(1), own(2), shear(0, 1), shear(0, 2), shear(1, 2)];
                        for (k, exact) in exact.into_iter().enumerate() {
                            let found = transfer(stress.kernel(load, k)[[a, b]], load, STRESSES[k]);
                            let error = (found - exact).modulus();
                            assert!(
                                error < 1e-9,
                                "depth {depth}, wave {a} {b}, load {load}, {k}: {error:.1e}"
                            );
                        }
                    }
                }
            }
        }
    }

    /// Under a loaded cell its traction, under the others nothing: the same in all waves. On small periods that serve themselves, and between
    /// the wavenumbers of one.
    #[test]
    fn at_the_surface_the_stress_is_the_traction() {
        for half_space in [stack(&[], Some((1.0, 0.3))), stack(&[(5.0, 0.2, 0.5)], Some((1.0, 0.4)))] {
            for cells in [[1, 3], CELLS, [50, 35]] {
                let stress = stress_symbols(&DepthResponse::new(&half_space, 0, 0.0), cells, SPACING, true);
                let dim = (cells[0] / 2 + 1, cells[1] / 2 + 1);
                for (load, own) in [(0, 2), (1, 4), (2, 5)] {
                    for k in [2, 4, 5] {
                        let exact = if k == own { -1.0 } else { 0.0 };
                        let stress = stress.kernel(load, k);
                        assert_eq!(stress.dim(), dim);
                        for (place, found) in stress.indexed_iter() {
                            // rounding of waves, of their sums and of polynomials
                            let error = (found - exact).abs();
                            assert!(error < 1e-12, "{cells:?} {place:?}, load {load}, {k}: {found}");
                        }
                    }
                }
            }
        }
    }

    /// The sum over so many aliases on either side, by definition.
    fn summed(
        response: &DepthResponse,
        turns: [f64; 2],
        spacing: [f64; 2],
        count: [i32; 2],
    ) -> [[f64; 6]; 3] {
        let mut sum = [[0.0; 6]; 3];
        for m in -count[0]..=count[0] {
            for n in -count[1]..=count[1] {
                let half = [turns[0] + f64::from(m), turns[1] + f64::from(n)].map(|turns| PI * turns);
                let averaged = half.map(|half| if half == 0.0 { 1.0 } else { half.sin() / half });
                let [x, y] = [2.0 * half[0] / spacing[0], 2.0 * half[1] / spacing[1]];
                let k = x.hypot(y);
                let (c, s, t) = (x / k, y / k, response.at(k));
                let of = [from_pressure(c, s, &t), from_shear_x(c, s, &t), exchanged(from_shear_x(s, c, &t))];
                for (sum, value) in sum.as_flattened_mut().iter_mut().zip(of.as_flattened()) {
                    *sum += averaged[0] * averaged[1] * value;
                }
            }
        }
        sum
    }

    #[test]
    fn stresses_are_sums_over_all_aliases() {
        type Case = (&'static [(f64, f64, f64)], Option<(f64, f64)>);
        let stacks: [Case; 6] = [
            (&[], Some((1.0, 0.3))),
            (&[(3.0, 0.25, 0.4)], Some((1.0, 0.3))),
            (&[(1e4, 0.25, 0.05)], Some((1.0, 0.3))),
            (&[(1e-3, 0.4, 0.1)], Some((1.0, 0.3))),
            (&[(1.0, 0.45, 0.3)], None),
            (&[(100.0, 0.2, 0.02), (0.01, 0.3, 0.05)], Some((1.0, 0.3))),
        ];
        let mut worst_of_all = 0.0_f64;
        // on a grid that serves itself, between wavenumbers, of long cells
        for (cells, spacing) in [([8, 6], [0.1, 0.1]), ([64, 45], [0.1, 0.1]), ([120, 40], [0.05, 0.15])] {
            for (layers, substrate) in stacks {
                let (half_space, mut worst) = (stack(layers, substrate), 0.0_f64);
                for depth in [0.05, 0.1, 0.4, 0.8, 1.7] {
                    let mut bottom = 0.0;
                    let mut below = |layer: &(f64, f64, f64)| {
                        bottom += layer.2;
                        depth > bottom
                    };
                    let layer = layers.iter().filter(|layer| below(layer)).count();
                    if substrate.is_none() && layer == layers.len() {
                        continue;
                    }
                    let response = DepthResponse::new(&half_space, layer, depth);
                    let found = stress_symbols(&response, cells, spacing, true);
                    let count = spacing.map(|side| (6.0 * side / depth).ceil() as i32 + 1); // to exp(-12 pi)
                    let exact_at = |[a, b]: [usize; 2]| {
                        let turns = [a as f64 / cells[0] as f64, b as f64 / cells[1] as f64];
                        summed(&response, turns, spacing, count)
                    };
                    let last = cells.map(|cells| cells / 2);
                    let places = [[0, 1], [1, 0], [1, 1], [last[0], 0], [last[0], 1], [2, last[1]], last]
                        .into_iter()
                        .chain((0..6).map(|n| [(7 * n + 1) % last[0], (5 * n + 2) % last[1]]))
                        .filter(|place| *place != [0, 0]);
                    let exact: Vec<_> = places.map(|place| (place, exact_at(place))).collect();
                    let largest = exact.iter().flat_map(|(_, exact)| exact.as_flattened());
                    let largest = largest.fold(1.0_f64, |most, value| most.max(value.abs()));
                    for ([a, b], exact) in exact {
                        for kernel in 0..18 {
                            // what is odd vanishes in the last wave of an even count
                            let odd = stress_odd(kernel);
                            if (odd[0] && (a == 0 || 2 * a == cells[0]))
                                || (odd[1] && (b == 0 || 2 * b == cells[1]))
                            {
                                continue;
                            }
                            let found = found.kernel(kernel / 6, kernel % 6)[[a, b]];
                            let error = (found - exact[kernel / 6][kernel % 6]).abs() / largest;
                            worst = worst.max(error);
                        }
                    }
                }
                println!("aliases, {cells:?} {layers:?}: {worst:.1e} of the largest stress");
                worst_of_all = worst_of_all.max(worst);
            }
        }
        // rounding of sums over images, in which long waves of a stiff film cancel that are up to 1e4 times as large; bare bodies have 1e-13
        assert!(worst_of_all < 1e-9, "{worst_of_all:e}");
    }

    /// There both ways are one: the sum over images is what the grid's own waves are.
    #[test]
    fn aliases_end_where_they_are_left_out() {
        let half_space = stack(&[(3.0, 0.25, 0.4)], Some((1.0, 0.3)));
        let (cells, spacing) = ([40, 33], [0.1, 0.07]);
        let response = DepthResponse::new(&half_space, 1, 0.999 * DEEP * 0.1);
        let all = stress_symbols(&response, cells, spacing, true);
        let own = stresses_of_waves(&response, &waves_of_grid(cells, spacing));
        for (all, own) in all.values.iter().zip(&own.values) {
            assert!((all - own).abs() < 1e-12, "{all} {own}"); // sums over images
        }
    }

    #[test]
    fn pressure_alone_has_the_stresses_that_it_has_beside_shear() {
        let half_space = stack(&[(3.0, 0.25, 0.4)], Some((1.0, 0.3)));
        let response = DepthResponse::new(&half_space, 0, 0.2);
        let [all, alone] =
            [true, false].map(|with_shear| stress_symbols(&response, [40, 33], [0.1, 0.07], with_shear));
        for kernel in 0..6 {
            for (all, alone) in all.kernel(0, kernel).iter().zip(alone.kernel(0, kernel)) {
                assert!((all - alone).abs() < 1e-13, "{kernel}: {all} {alone}"); // another table's rounding
            }
        }
    }

    #[test]
    fn uniform_tractions_go_down_as_they_are() {
        let half_space = stack(&[(5.0, 0.2, 0.5)], Some((1.0, 0.4)));
        for (layer, depth, nu) in [(0, 0.3, 0.2), (1, 0.8, 0.4)] {
            let response = DepthResponse::new(&half_space, layer, depth);
            let stress = stress_symbols(&response, CELLS, SPACING, true);
            let of = |load: usize| [0, 1, 2, 3, 4, 5].map(|k| stress.kernel(load, k)[[0, 0]]);
            let lateral = -nu / (1.0 - nu);
            assert!(
                of(0).iter().zip([lateral, lateral, -1.0, 0.0, 0.0, 0.0]).all(|(a, b)| (a - b).abs() < 1e-15)
            );
            assert_eq!(of(1), [0.0, 0.0, 0.0, 0.0, -1.0, 0.0]);
            assert_eq!(of(2), [0.0, 0.0, 0.0, 0.0, 0.0, -1.0]);
            let displacement = displacement_symbols(&response, CELLS, SPACING);
            assert!((0..3).all(|load| (0..3).all(|k| displacement.kernel(load, k)[[0, 0]] == 0.0)));
        }
    }
}
