//! The frequency response of a pair as a table, for the many wavenumbers of grids.

use ndarray::Array2;
use pulp::Scalar;

use super::axis_waves::{AxisWaves, axis_waves};
use super::frequency_response::{Response, ResponseTimesK};
use super::lattice_samples::ResponseChange;
use super::pair_response::PairResponse;
use super::panels::Panels;
use crate::model::ContactPair;

/// The frequency response of a pair, tabulated as polynomials of `k^2` so that it costs no exponentials, however many layers.
#[derive(Clone, Debug)]
pub struct ResponseTable {
    source: Source,
    values: Values,
}

/// What is tabulated.
#[derive(Clone, Debug)]
enum Source {
    /// The response of a pair.
    Pair(PairResponse),
    /// How it changes with a parameter.
    Change(ResponseChange),
}

impl Source {
    fn times_k(&self, k: f64) -> [f64; 4] {
        match self {
            Self::Pair(pair) => components(pair.times_k(k)),
            Self::Change(change) => {
                let ResponseTimesK { zz, rr, rz, tt } = change.times_wavenumber(k);
                [zz, rr, rz, tt]
            }
        }
    }

    fn is_constant(&self) -> bool {
        match self {
            Self::Pair(pair) => pair.is_homogeneous(),
            Self::Change(change) => change.is_homogeneous(),
        }
    }
}

#[derive(Clone, Debug)]
enum Values {
    /// Homogeneous bodies: `k C` is constant.
    Constant([f64; 4]),
    /// `k C_zz, k C_rr, k C_rz, k C_tt` over `k^2`.
    Tabulated(Panels<1>),
}

impl ResponseTable {
    /// Tabulates `k C(k)` between two wavenumbers `0 < least <= greatest` [rad/length]; beyond them it is computed when asked
    /// for. Relative error of interpolation below 1e-12. Cost: about 100 responses per factor two.
    pub fn new(pair: &ContactPair, least: f64, greatest: f64) -> Self {
        Self::of(PairResponse::new(pair), least, greatest)
    }

    /// The table of a response, as [`ResponseTable::new`] makes it of a pair's.
    pub fn of(pair: PairResponse, least: f64, greatest: f64) -> Self {
        Self::of_source(Source::Pair(pair), least, greatest)
    }

    /// The table of a change of a response.
    pub(super) fn of_change(change: ResponseChange, least: f64, greatest: f64) -> Self {
        Self::of_source(Source::Change(change), least, greatest)
    }

    fn of_source(source: Source, least: f64, greatest: f64) -> Self {
        let values = if source.is_constant() {
            Values::Constant(source.times_k(1.0))
        } else {
            let at = |square: f64| [source.times_k(square.sqrt())];
            Values::Tabulated(Panels::new(least * least, greatest * greatest, at))
        };
        Self { source, values }
    }

    /// `k C(k)` [1/pressure].
    pub fn times_k(&self, k: f64) -> Response {
        let [zz, rr, rz, tt] = self.at_square(k * k);
        Response { zz, rr, rz, tt }
    }

    #[inline]
    pub(super) fn at_square(&self, square: f64) -> [f64; 4] {
        match &self.values {
            Values::Constant(response) => *response,
            Values::Tabulated(panels) if panels.holds(square) => panels.at::<Scalar>(square)[0],
            Values::Tabulated(_) => self.source.times_k(square.sqrt()),
        }
    }

    #[inline]
    fn normal_at_square(&self, square: f64) -> f64 {
        match &self.values {
            Values::Constant([zz, ..]) => *zz,
            Values::Tabulated(_) => self.at_square(square)[0],
        }
    }

    /// `zz` of [`symbols`](Self::symbols) with two aliases, for a preconditioner: to about a percent, since the sum of the
    /// aliases but the wave itself varies slowly and is interpolated. Cost about one response per wavenumber.
    pub fn cell_response(&self, cells: [usize; 2], spacing: [f64; 2]) -> Array2<f64> {
        const KNOTS: usize = 16;
        const ALIASES: usize = 2;
        // the aliases depend on the share of a turn between cells alone
        let knots = [axis_waves(2 * KNOTS, spacing[0], ALIASES), axis_waves(2 * KNOTS, spacing[1], ALIASES)];
        let own = [axis_waves(2 * KNOTS, spacing[0], 0), axis_waves(2 * KNOTS, spacing[1], 0)];
        let aliases = Array2::from_shape_fn([KNOTS + 1; 2], |(a, b)| {
            self.normal_symbol(&knots[0][a], &knots[1][b]) - self.normal_symbol(&own[0][a], &own[1][b])
        });
        let [along_x, along_y] = [0, 1].map(|axis| {
            let place = |index: usize| {
                let at = (2 * KNOTS * index) as f64 / cells[axis].max(1) as f64;
                let knot = (at as usize).min(KNOTS - 1);
                (knot, at - knot as f64)
            };
            let waves = axis_waves(cells[axis], spacing[axis], 0);
            waves.iter().enumerate().map(|(index, wave)| (wave.waves[0], place(index))).collect::<Vec<_>>()
        });
        Array2::from_shape_fn([along_x.len(), along_y.len()], |(a, b)| {
            let ((kx, factor_x), (i, s)) = along_x[a];
            let ((ky, factor_y), (j, t)) = along_y[b];
            let square = kx * kx + ky * ky;
            if square == 0.0 {
                return 0.0;
            }
            let low = (1.0 - t) * aliases[[i, j]] + t * aliases[[i, j + 1]];
            let high = (1.0 - t) * aliases[[i + 1, j]] + t * aliases[[i + 1, j + 1]];
            factor_x * factor_y * self.normal_at_square(square) / square.sqrt() + (1.0 - s) * low + s * high
        })
    }

    /// `zz` alone.
    fn normal_symbol(&self, x: &AxisWaves, y: &AxisWaves) -> f64 {
        let mut sum = 0.0;
        for &(kx, factor_x) in &x.waves {
            for &(ky, factor_y) in &y.waves {
                let square = kx * kx + ky * ky;
                if square != 0.0 {
                    sum += factor_x * factor_y * (1.0 / square.sqrt()) * self.normal_at_square(square);
                }
            }
        }
        sum
    }
}

fn components(response: Response) -> [f64; 4] {
    [response.zz, response.rr, response.rz, response.tt]
}

#[cfg(test)]
mod tests {
    use super::super::samples::{Random, pair, under_rigid};
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn table_keeps_the_response() {
        let mut random = Random::seeded(8);
        for case in 0..40 {
            let pair = under_rigid(random.half_space(4, 1e4, case % 2 == 0));
            let table = ResponseTable::new(&pair, 1e-3, 1e3);
            let direct = PairResponse::new(&pair);
            for n in 0..700 {
                // the ends lie beyond the table
                let k = 10.0_f64.powf(-3.5 + f64::from(n) / 100.0);
                let (found, exact) = (table.times_k(k), direct.times_k(k));
                let size = (exact.rr * exact.zz).sqrt();
                let errors = [
                    (found.zz - exact.zz) / exact.zz,
                    (found.rr - exact.rr) / exact.rr,
                    (found.rz - exact.rz) / size,
                    (found.tt - exact.tt) / exact.tt,
                ];
                // twelve terms with the nearest pole 22 to 90 degrees off
                assert!(errors.iter().all(|error| error.abs() < 1e-12), "{pair:?} {k}: {errors:?}");
            }
        }
    }

    /// The wave itself, and the sum of its aliases up to the second, by the definition; `turns` between neighbouring cells.
    fn wave_and_aliases(pair: &PairResponse, turns: [f64; 2], spacing: [f64; 2]) -> [f64; 2] {
        let mut sums = [0.0; 2];
        for aliases in (0..25).map(|n| [n / 5 - 2, n % 5 - 2]) {
            let half = [0, 1].map(|axis| PI * (turns[axis] + f64::from(aliases[axis])));
            let [x, y] = [0, 1].map(|axis| 2.0 * half[axis] / spacing[axis]);
            let k = x.hypot(y);
            // a uniform wave has no aliases: its factor there is the sine of a whole turn
            if k > 0.0 {
                let factor = half.map(|half| if half == 0.0 { 1.0 } else { half.sin() / half });
                sums[usize::from(aliases != [0, 0])] += factor[0] * factor[1] * pair.times_k(k).zz / k;
            }
        }
        sums
    }

    #[test]
    fn the_response_of_cells_is_a_sum_over_aliases_interpolated_between_knots() {
        let spacing = [0.3, 0.2];
        for pair in [pair(&[], Some((2.6, 0.3))), pair(&[(10.0, 0.3, 0.5)], Some((1.0, 0.4)))] {
            let direct = PairResponse::new(&pair);
            // part of the waves lies beyond the table
            let table = ResponseTable::new(&pair, 0.5, 20.0);
            let aliases = |i: usize, j: usize| {
                wave_and_aliases(&direct, [i as f64 / 32.0, j as f64 / 32.0], spacing)[1]
            };
            for cells in [[32, 32], [64, 32], [16, 128]] {
                let found = table.cell_response(cells, spacing);
                assert_eq!(found.dim(), (cells[0] / 2 + 1, cells[1] / 2 + 1));
                assert_eq!(found[[0, 0]], 0.0);
                for ((a, b), &value) in found.indexed_iter().skip(1) {
                    let turns = [a as f64 / cells[0] as f64, b as f64 / cells[1] as f64];
                    let [own, exact] = wave_and_aliases(&direct, turns, spacing);
                    let [(i, s), (j, t)] = turns.map(|turns| {
                        let knot = ((32.0 * turns) as usize).min(15);
                        (knot, 32.0 * turns - knot as f64)
                    });
                    let corners = [(i, j), (i, j + 1), (i + 1, j), (i + 1, j + 1)];
                    let shares = [(1.0 - s) * (1.0 - t), (1.0 - s) * t, s * (1.0 - t), s * t];
                    let between: f64 =
                        corners.into_iter().zip(shares).map(|((i, j), share)| share * aliases(i, j)).sum();
                    // interpolation of the table, 1e-12, and sines of the aliases' own arguments
                    let error = (value - (own + between)) / own;
                    assert!(error.abs() < 3e-12, "{pair:?} {cells:?} [{a}, {b}]: {error:.1e}");
                    let percent = (value - (own + exact)) / (own + exact);
                    assert!(percent.abs() < 0.01, "{pair:?} {cells:?} [{a}, {b}]: {percent:.1e}");
                }
            }
        }
    }
}
