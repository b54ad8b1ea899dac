//! Radial kernels against a third party's program. Tests only.

use pulp::Scalar;
use serde::Deserialize;

use super::pair_response::PairResponse;
use super::radial::RadialKernels;
use super::samples::{golden, pair};

#[derive(Deserialize)]
struct Row {
    case: String,
    layers: Vec<(f64, f64, f64)>,
    substrate: (f64, f64),
    distances: Vec<f64>,
    zz: Vec<f64>,
    zr: Vec<f64>,
    rr: Vec<f64>,
    tt: Vec<f64>,
}

#[test]
fn three_layers_are_those_of_a_program_for_seismology() {
    let mut worst = 0.0_f64;
    for row in golden::<Row>("three_layers_pygrt.json") {
        let response = PairResponse::new(&pair(&row.layers, Some(row.substrate)));
        let kernels = RadialKernels::of_surface(&response, 0.1, 100.0);
        // zz, zr, rr, tt: Z0, -Z1, A0 - B2, A0 + B2; the table holds B2/r^2 and Z1/r
        let at = |r: f64| {
            let [[z0, a0, b2, z1]] = kernels.at_square::<Scalar>(r * r);
            [z0, -z1 * r, a0 - b2 * r * r, a0 + b2 * r * r]
        };
        let last = at(row.distances[row.distances.len() - 1]);
        for (n, r) in row.distances.iter().enumerate() {
            let found = at(*r);
            for (lane, exact) in [&row.zz, &row.zr, &row.rr, &row.tt].into_iter().enumerate() {
                let error = (found[lane] - last[lane] - exact[n]).abs() / row.zz[0].max(row.rr[0]);
                worst = worst.max(error);
                // its step in the wavenumber leaves 3e-7 in zr, a quarter of what twice the step does
                assert!(error < 1e-6, "{}, r = {r}, {lane}: {error:.1e}", row.case);
            }
        }
    }
    println!("three layers within {worst:.1e} of the third party");
}
