//! The judge of the normal side: how well pressure satisfies its laws. Finds the approach on the way.

use crate::model::each_cell::{CellRule, CellSize, Reals, each_cell, largest_of};
use crate::model::field::lower;

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
    let [loaded, cells, heights, work, free_work] = each_cell(&Loads, [pressure, height, undeformed], []);
    if loaded <= 0.0 {
        let lowest = height.iter().copied().fold(f64::INFINITY, f64::min);
        let approach = approach.unwrap_or(lowest);
        lower(height, approach);
        return NormalVerdict { approach, residual: if lowest >= approach { 0.0 } else { 1.0 } };
    }
    let approach = approach.unwrap_or(heights / cells);
    let scale = ((work - free_work) / loaded).abs();
    lower(height, approach);
    let worst = off_complementarity(height, pressure, own);
    NormalVerdict { approach, residual: if scale > 0.0 { worst / scale } else { f64::INFINITY } }
}

/// Sums of pressure, of loaded cells and of their heights, of pressure times height, and of pressure times undeformed gap.
struct Loads;

impl CellRule<3, 0, 5> for Loads {
    #[inline(always)]
    fn at<R: Reals>(&self, [p, height, undeformed]: [R; 3], _: &mut [R; 0]) -> [R; 5] {
        let (zero, one) = (p.all(0.0), p.all(1.0));
        [p, p.if_at_most(zero, zero, one), p.if_at_most(zero, zero, height), p * height, p * undeformed]
    }
}

/// `|min(gap, K00 p)|`.
struct Complementarity {
    own: f64,
}

impl CellSize<2> for Complementarity {
    #[inline(always)]
    fn of<R: Reals>(&self, [gap, p]: [R; 2]) -> R {
        let off = gap.min(p * self.own);
        off.max(off * -1.0)
    }
}

/// Largest `|min(gap, K00 p)|` over the cells, `own` being `K00`.
pub fn off_complementarity(gap: &[f64], pressure: &[f64], own: f64) -> f64 {
    largest_of(&Complementarity { own }, [gap, pressure])
}
