//! The frequency response of a pair as a table, for the many wavenumbers of grids.

use ndarray::Array2;
use pulp::Scalar;

use super::axis_waves::{AxisWaves, axis_waves};
use super::frequency_response::Response;
use super::pair_response::PairResponse;
use super::panels::Panels;
use crate::model::ContactPair;

/// The frequency response of a pair, tabulated as polynomials of `k^2` so that it costs no exponentials, however many layers.
#[derive(Clone, Debug)]
pub struct ResponseTable {
    pair: PairResponse,
    values: Values,
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
        let values = match pair.constant() {
            Some(response) => Values::Constant(components(response)),
            None => Values::Tabulated(Panels::new(least * least, greatest * greatest, |square| {
                [components(pair.times_k(square.sqrt()))]
            })),
        };
        Self { pair, values }
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
            Values::Tabulated(_) => components(self.pair.times_k(square.sqrt())),
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
    use super::super::samples::{Random, under_rigid};
    use super::*;

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
}
