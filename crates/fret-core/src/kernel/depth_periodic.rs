//! Stress and displacement at depth in scenes that repeat: the response at the grid's own wavenumbers is the operator.

use std::f64::consts::{PI, TAU};

use ndarray::Array3;
use rayon::prelude::*;

use super::cells::CellCoefficients;
use super::depth_response::{DepthResponse, Transfer};
use super::lattice_samples::{BelowSurface, WaveResponse};

/// Symbols of stress at one depth, shape `(nx/2 + 1, ny/2 + 1)`, in the convention of [`PeriodicSymbols`]: the transfer function
/// is the value times `-i` for every axis along which the kernel is odd.
///
/// A uniform pressure compresses without lateral strain (the period is held): `sigma_xx = sigma_yy = -nu/(1 - nu) p`.
///
/// [`PeriodicSymbols`]: super::PeriodicSymbols
pub(crate) fn stress_symbols(
    response: &impl BelowSurface,
    cells: [usize; 2],
    spacing: [f64; 2],
) -> CellCoefficients<6> {
    let [lateral, arrives] = response.under_uniform();
    let uniform = [
        [lateral, lateral, -arrives, 0.0, 0.0, 0.0],
        [0.0, 0.0, 0.0, 0.0, -arrives, 0.0],
        [0.0, 0.0, 0.0, 0.0, 0.0, -arrives],
    ];
    symbols(response, cells, spacing, uniform, |c, s, t, _| {
        [from_pressure(c, s, t), from_shear_x(c, s, t), exchanged(from_shear_x(s, c, t))]
    })
}

/// Symbols of displacement at one depth [length/pressure]; zero at `k = 0`.
pub(crate) fn displacement_symbols(
    response: &DepthResponse,
    cells: [usize; 2],
    spacing: [f64; 2],
) -> CellCoefficients<3> {
    symbols(response, cells, spacing, [[0.0; 3]; 3], |c, s, t, k| {
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

fn symbols<const N: usize>(
    response: &impl WaveResponse,
    cells: [usize; 2],
    spacing: [f64; 2],
    uniform: [[f64; N]; 3],
    of_wave: impl Fn(f64, f64, &Transfer<f64>, f64) -> [[f64; N]; 3] + Sync,
) -> CellCoefficients<N> {
    let axis = |axis: usize| -> Vec<(f64, f64)> {
        (0..=cells[axis] / 2)
            .map(|index| {
                let k = TAU * index as f64 / (cells[axis] as f64 * spacing[axis]);
                let half = PI * index as f64 / cells[axis] as f64;
                (k, if index == 0 { 1.0 } else { libm::sin(half) / half })
            })
            .collect()
    };
    let (along_x, along_y) = (axis(0), axis(1));
    let shape = (along_x.len(), along_y.len());
    let mut values = vec![uniform; shape.0 * shape.1];
    values.par_chunks_mut(shape.1).zip(&along_x).for_each(|(row, &(kx, factor_x))| {
        for (value, &(ky, factor_y)) in row.iter_mut().zip(&along_y) {
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
            let stress = stress_symbols(&at(depth), CELLS, SPACING);
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

    #[test]
    fn at_the_surface_the_stress_is_the_traction() {
        for half_space in [stack(&[], Some((1.0, 0.3))), stack(&[(5.0, 0.2, 0.5)], Some((1.0, 0.4)))] {
            let stress = stress_symbols(&DepthResponse::new(&half_space, 0, 0.0), CELLS, SPACING);
            for a in 0..=4 {
                for b in 0..=3 {
                    let (_, averaged) = wave([a, b]);
                    assert_eq!(stress.kernel(0, 0).dim(), (5, 4));
                    for (load, own) in [(0, 2), (1, 4), (2, 5)] {
                        for k in [2, 4, 5] {
                            let exact = if k == own { -averaged } else { 0.0 };
                            let found = stress.kernel(load, k)[[a, b]];
                            assert!((found - exact).abs() < 1e-14, "wave {a} {b}, load {load}, {k}: {found}");
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn uniform_tractions_go_down_as_they_are() {
        let half_space = stack(&[(5.0, 0.2, 0.5)], Some((1.0, 0.4)));
        for (layer, depth, nu) in [(0, 0.3, 0.2), (1, 0.8, 0.4)] {
            let response = DepthResponse::new(&half_space, layer, depth);
            let stress = stress_symbols(&response, CELLS, SPACING);
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
