//! Stress and displacement at depth in scenes that repeat: the response at the grid's own wavenumbers is the operator.

use std::f64::consts::{PI, TAU};

use ndarray::Array3;
use rayon::prelude::*;

use super::cells::CellCoefficients;
use super::depth_response::{DepthResponse, Transfer};

/// Symbols of stress at one depth, shape `(nx/2 + 1, ny/2 + 1)`, in the convention of [`PeriodicSymbols`]: the transfer function
/// is the value times `-i` for every axis along which the kernel is odd.
///
/// A uniform pressure compresses without lateral strain (the period is held): `sigma_xx = sigma_yy = -nu/(1 - nu) p`.
///
/// [`PeriodicSymbols`]: super::PeriodicSymbols
pub(crate) fn stress_symbols(
    response: &DepthResponse,
    cells: [usize; 2],
    spacing: [f64; 2],
) -> CellCoefficients<6> {
    let nu = response.poisson();
    let lateral = -nu / (1.0 - nu);
    let uniform = [
        [lateral, lateral, -1.0, 0.0, 0.0, 0.0],
        [0.0, 0.0, 0.0, 0.0, -1.0, 0.0],
        [0.0, 0.0, 0.0, 0.0, 0.0, -1.0],
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
    response: &DepthResponse,
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
                *value = of_wave(kx / k, ky / k, &response.at(k), k)
                    .map(|components| components.map(|component| component * factor));
            }
        }
    });
    CellCoefficients::new(Array3::from_shape_fn((shape.0, 3 * N, shape.1), |(a, kernel, b)| {
        values[a * shape.1 + b][kernel / N][kernel % N]
    }))
}
