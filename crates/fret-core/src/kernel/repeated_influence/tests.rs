use std::f64::consts::TAU;

use super::super::closed_form::homogeneous_cell;
use super::super::influence::influence_coefficients;
use super::super::samples::{material, pair};
use super::*;
use crate::limit::limit;

const SPACING: [f64; 2] = [1.0, 0.75];
const CELLS: [usize; 2] = [9, 6];

fn arrays(coefficients: InfluenceCoefficients) -> [Array2<f64>; 6] {
    let InfluenceCoefficients { zz, xx, yy, xy, zx, zy } = coefficients;
    [zz, xx, yy, xy, zx, zy].map(Option::unwrap)
}

fn along(
    axis: usize,
    pair: &ContactPair,
    cells: [usize; 2],
    spacing: [f64; 2],
    datum: f64,
) -> [Array2<f64>; 6] {
    let response = PairResponse::new(pair);
    arrays(repeated_coefficients((pair, &response), (cells, spacing), axis, datum, Components::ALL))
}

/// Love's and Cerruti's closed forms summed over images, the tail extrapolated: what pressure and shear along an axis do on their own up to a
/// constant, which the datum is about, the others as they are.
#[test]
fn homogeneous_bodies_are_sums_of_closed_forms_over_all_images() {
    for nu in [0.0, 0.3, 0.5] {
        let body = material((1.7, nu));
        let found = along(1, &pair(&[], Some((1.7, nu))), CELLS, SPACING, 30.0);
        let period = CELLS[1] as f64 * SPACING[1];
        let image = |i: usize, j: usize, n: i32| {
            let y = j as f64 * SPACING[1] + f64::from(n) * period;
            // closed forms with a corner on an axis are 0 times infinity
            let cell = homogeneous_cell(&body, [i as f64 * SPACING[0], y], SPACING);
            [cell.zz, cell.xx, cell.yy, cell.xy, cell.zx, cell.zy]
        };
        let own = found[0][[0, 0]];
        for (i, j) in [(0, 0), (0, 2), (1, 1), (3, 5), (8, 3), (4, 0)] {
            for component in 0..6 {
                let is_apart = component < 3;
                let sum = |end: usize| {
                    let both = |n: i32| {
                        let here = image(i, j, n)[component];
                        if is_apart { here - image(8, 1, n)[component] } else { here }
                    };
                    both(0) + (1..=end as i32).map(|n| both(n) + both(-n)).sum::<f64>()
                };
                // the parts that couple fall like 1/r, those of two shears like 1/r^2, and the differences of the others like 1/r^3
                let powers = if component > 3 { [1, 3, 5] } else { [2, 4, 6] };
                let exact = limit(&[20, 40, 80, 160], &powers, sum);
                let value = found[component][[i, j]];
                let found = if is_apart { value - found[component][[8, 1]] } else { value };
                // corner differences lose digits: 1e-16 of the distance, 700 sides, in each of 300 terms
                let error = (found - exact).abs() / own;
                assert!(error < 3e-11, "{nu} {component} ({i}, {j}): {found} {exact} {error:.1e}");
            }
        }
    }
}

/// The same for coated bodies, by coefficients of single cells.
#[test]
fn coated_bodies_are_sums_over_all_images() {
    for layers in [vec![(4.0, 0.2, 0.6)], vec![(0.2, 0.45, 3.0)], vec![(6.0, 0.3, 0.2), (0.5, 0.4, 3.0)]] {
        let pair = pair(&layers, Some((1.0, 0.3)));
        let single =
            arrays(influence_coefficients(&pair, [CELLS[0], 322 * CELLS[1]], SPACING, Components::ALL));
        let found = along(1, &pair, CELLS, SPACING, 30.0);
        let own = found[0][[0, 0]];
        let image = |component: usize, i: usize, j: usize, n: i32| {
            let index = j as i32 + n * CELLS[1] as i32;
            let value = single[component][[i, index.unsigned_abs() as usize]];
            if index < 0 && ODD[component][1] { -value } else { value }
        };
        for (i, j) in [(0, 0), (0, 2), (1, 1), (3, 5), (8, 3)] {
            for component in 0..6 {
                let is_apart = component < 3;
                let sum = |end: usize| {
                    let both = |n: i32| {
                        let here = image(component, i, j, n);
                        if is_apart { here - image(component, 8, 1, n) } else { here }
                    };
                    both(0) + (1..=end as i32).map(|n| both(n) + both(-n)).sum::<f64>()
                };
                // layers shear along and across a wave otherwise, which adds the even powers
                let powers = if is_apart { [2, 3, 4, 5, 6] } else { [1, 2, 3, 4, 5] };
                let exact = limit(&[10, 20, 40, 80, 160, 320], &powers, sum);
                let value = found[component][[i, j]];
                let found = if is_apart { value - found[component][[8, 1]] } else { value };
                let error = (found - exact).abs() / own;
                // what extrapolation leaves of layers nearly as thick as a period
                assert!(error < 1e-9, "{layers:?} {component} ({i}, {j}): {error:.1e}");
            }
        }
    }
}

/// Waves along y that are uniform along x: coefficients summed over all strips are the frequency response at that wave and its aliases,
/// `Sum_l C(|k + 2 pi l/b|) sin(..)/..`, an alternating series, here by repeated means of its partial sums.
#[test]
fn waves_along_the_period_have_the_frequency_response() {
    let pair = pair(&[(3.0, 0.25, 0.7), (0.5, 0.4, 2.0)], Some((1.0, 0.3)));
    let response = PairResponse::new(&pair);
    let (period, side) = (8, 0.5);
    // six periods across, beyond which the wave is exp(-12 pi) of what it is
    let across = 49;
    let [zz, xx, yy, _, _, zy] = along(1, &pair, [across, period], [0.5, side], 30.0);
    for wave in 1..=3 {
        let phase = |j: usize| TAU * (wave * j) as f64 / period as f64;
        let summed = |array: &Array2<f64>, of: fn(f64) -> f64| -> f64 {
            let row = |i: usize| (0..period).map(|j| array[[i, j]] * of(phase(j))).sum::<f64>();
            row(0) + 2.0 * (1..across).map(row).sum::<f64>()
        };
        let aliases = |of: &dyn Fn(f64) -> f64| {
            let k = TAU * wave as f64 / (period as f64 * side);
            let term = |l: i32| {
                let k = k + TAU * f64::from(l) / side;
                let half = 0.5 * k * side;
                of(k) * half.sin() / half
            };
            let mut sums = vec![term(0)];
            for l in 1..40 {
                sums.push(sums[l - 1] + term(l as i32) + term(-(l as i32)));
            }
            while sums.len() > 1 {
                sums = sums.windows(2).map(|pair| 0.5 * (pair[0] + pair[1])).collect();
            }
            sums[0]
        };
        let at = |k: f64| response.times_k(k.abs());
        let exact = [
            aliases(&|k| at(k).zz / k.abs()),
            aliases(&|k| at(k).tt / k.abs()),
            aliases(&|k| at(k).rr / k.abs()),
            aliases(&|k| at(k).rz / k),
        ];
        let found =
            [summed(&zz, f64::cos), summed(&xx, f64::cos), summed(&yy, f64::cos), summed(&zy, f64::sin)];
        for (component, (found, exact)) in found.into_iter().zip(exact).enumerate() {
            // sums of a period's coefficients, some of them ten times the wave's
            let error = (found.abs() - exact.abs()).abs() / exact.abs();
            assert!(error < 1e-10, "{wave} {component}: {found} {exact} {error:.1e}");
        }
    }
}

#[test]
fn a_traction_that_does_not_change_along_the_axis_is_that_of_a_line_contact() {
    let pair = pair(&[(3.0, 0.25, 0.7)], Some((1.0, 0.3)));
    let line =
        super::super::line_influence::line_coefficients(&pair, CELLS[0], SPACING[0], 30.0, Components::ALL);
    let found = along(1, &pair, CELLS, SPACING, 30.0);
    let own = line.zz.as_ref().unwrap()[[0, 0]];
    let lines = [line.zz, line.xx, line.yy, line.xy, line.zx, line.zy].map(Option::unwrap);
    for (line, found) in lines.iter().zip(&found) {
        for i in 0..CELLS[0] {
            // rounding of the sum over a period
            assert!((found.row(i).sum() - line[[i, 0]]).abs() < 1e-14 * own);
        }
    }
}

#[test]
fn two_periods_are_one_period_twice() {
    let pair = pair(&[(3.0, 0.25, 0.7)], Some((1.0, 0.3)));
    let one = along(1, &pair, CELLS, SPACING, 30.0);
    let two = along(1, &pair, [CELLS[0], 2 * CELLS[1]], SPACING, 30.0);
    let own = one[0][[0, 0]];
    for (one, two) in one.iter().zip(&two) {
        for ((i, j), value) in one.indexed_iter() {
            let both = two[[i, j]] + two[[i, j + CELLS[1]]];
            assert!((value - both).abs() < 3e-12 * own, "({i}, {j}): {value} {both}");
        }
    }
}

#[test]
fn exchanging_the_axes_exchanges_the_components_to_the_bit() {
    let pair = pair(&[(3.0, 0.25, 0.7)], Some((1.0, 0.3)));
    let y = along(1, &pair, CELLS, SPACING, 30.0);
    let x = along(0, &pair, [CELLS[1], CELLS[0]], [SPACING[1], SPACING[0]], 30.0);
    for (component, other) in [0, 2, 1, 3, 5, 4].into_iter().enumerate() {
        assert_eq!(y[component].t(), x[other]);
    }
}

#[test]
fn only_what_is_wanted_is_there() {
    let pair = pair(&[], Some((1.0, 0.3)));
    let response = PairResponse::new(&pair);
    let found = repeated_coefficients((&pair, &response), (CELLS, SPACING), 0, 9.0, Components::TANGENTIAL);
    assert!(found.zz.is_none() && found.zx.is_none());
    assert_eq!(found.xy.unwrap().dim(), (9, 6));
}
