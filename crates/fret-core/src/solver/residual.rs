//! The judge of the normal side: how well pressure satisfies its laws. Finds the approach on the way.

use crate::model::each_cell::{CellRule, CellSize, Reals, each_cell, largest_of};

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
    let [loaded, cells, above, work, free_work] = each_cell(&Loads, [pressure, height, undeformed], []);
    let lowest = || height.iter().copied().fold(f64::INFINITY, f64::min);
    if loaded <= 0.0 {
        let lowest = lowest();
        let approach = approach.unwrap_or(lowest);
        each_cell(&Less(approach), [], [height]);
        return NormalVerdict { approach, residual: if lowest >= approach { 0.0 } else { 1.0 } };
    }
    let approach = approach.unwrap_or(above / cells);
    let scale = ((work - free_work) / loaded).abs();
    each_cell(&Less(approach), [], [&mut *height]);
    let worst = largest_of(&Off { own }, [height, pressure]);
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

/// Takes a number off.
struct Less(f64);

impl CellRule<0, 1, 0> for Less {
    #[inline(always)]
    fn at<R: Reals>(&self, _: [R; 0], [height]: &mut [R; 1]) -> [R; 0] {
        *height = *height - self.0;
        []
    }
}

/// How far a cell is off complementarity.
struct Off {
    /// A cell's influence on itself [length/pressure].
    own: f64,
}

impl CellSize<2> for Off {
    #[inline(always)]
    fn of<R: Reals>(&self, [gap, p]: [R; 2]) -> R {
        let off = gap.min(p * self.own);
        off.max(off * -1.0)
    }
}
