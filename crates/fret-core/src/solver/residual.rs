//! The judge of the normal side: how well pressure satisfies its laws. Finds the approach on the way.

use crate::model::field::{dot, sum};

/// Verdict on the normal side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NormalVerdict {
    /// Rigid approach [length].
    pub approach: f64,
    /// Largest `|min(gap, K00 p)|` over the cells, in units of the mean displacement under the load.
    pub residual: f64,
}

/// Judges pressures; `height` is normal displacement + undeformed gap and becomes the gap. `own` is a cell's influence on itself.
pub fn judge_normal(
    pressure: &[f64],
    height: &mut [f64],
    undeformed: &[f64],
    own: f64,
    approach: Option<f64>,
) -> NormalVerdict {
    let loaded = sum(pressure);
    let approach = approach.unwrap_or_else(|| mean_where_loaded(pressure, height));
    if loaded <= 0.0 {
        let lowest = height.iter().copied().fold(f64::INFINITY, f64::min);
        for gap in height.iter_mut() {
            *gap -= approach;
        }
        let residual = if lowest >= approach { 0.0 } else { 1.0 };
        return NormalVerdict { approach, residual };
    }
    let work = dot(pressure, height) - dot(pressure, undeformed);
    let scale = (work / loaded).abs();
    let mut worst = 0.0_f64;
    for (gap, &p) in height.iter_mut().zip(pressure) {
        *gap -= approach;
        worst = worst.max(gap.min(own * p).abs());
    }
    NormalVerdict { approach, residual: if scale > 0.0 { worst / scale } else { f64::INFINITY } }
}

/// Mean of a field over the loaded cells; its lowest value when none is loaded.
fn mean_where_loaded(pressure: &[f64], field: &[f64]) -> f64 {
    let mut total = 0.0;
    let mut count = 0_usize;
    for (&p, &value) in pressure.iter().zip(field) {
        if p > 0.0 {
            total += value;
            count += 1;
        }
    }
    if count > 0 { total / count as f64 } else { field.iter().copied().fold(f64::INFINITY, f64::min) }
}
