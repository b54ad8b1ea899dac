//! Debris between the surfaces: of what both bodies lose a fraction stays where it wore off, fills the gap there, and flows out over the
//! rim of the contact with the distance that the surfaces slip. It lies in the frame of the lower body.

use ndarray::{Array2, Zip};
use serde::{Deserialize, Serialize};

use super::wear::Collected;
use crate::fields::stored;
use crate::model::{ContactState, DebrisRule, WearRule};

/// By how much the debris of a state gives in each cell under a unit of pressure [length/pressure]; `None` where it does not.
pub fn give(rule: Option<&WearRule>, state: &ContactState) -> Option<Array2<f64>> {
    let stiffness = rule?.debris?.stiffness?;
    state.debris.as_ref().map(|thickness| thickness / stiffness)
}

/// What becomes debris when a cycle is over.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CollectedDebris {
    rule: DebrisRule,
    /// Area of the whole contact that a cell stands for [length^2].
    cell_area: f64,
    /// What wore off the upper body in the cells of the lower one, in the measure in which its wear is collected; where the bodies move.
    #[serde(with = "stored")]
    above: Option<Array2<f64>>,
    /// Debris that the cycle before the last jump made, and its slip distance [length], where the error of jumps is looked at.
    #[serde(with = "stored")]
    last: Option<[Array2<f64>; 2]>,
    /// Cycles of that jump.
    last_cycles: usize,
}

/// What a computed cycle does: what wears off the lower body, or off both where they stay, and off the upper one in its own frame, and the slip
/// distance in the frame of the lower body [length].
#[derive(Debug)]
pub struct OneCycle {
    /// Depths worn off [length].
    depths: [Option<Array2<f64>>; 2],
    /// Slip distance [length].
    path: Array2<f64>,
}

impl OneCycle {
    /// What has been collected of each body, worn already by `worn` [length].
    pub fn of(collected: [Option<&Collected>; 2], worn: [Option<&Array2<f64>>; 2]) -> Self {
        let depths = [0, 1].map(|body| Some(collected[body]?.of_cycles(1.0, worn[body])));
        Self {
            depths,
            path: collected[0].map_or_else(|| Array2::zeros([0, 0]), |lower| lower.path().clone()),
        }
    }

    fn depths(&self) -> [Option<&Array2<f64>>; 2] {
        self.depths.each_ref().map(Option::as_ref)
    }
}

impl CollectedDebris {
    /// Nothing yet.
    pub fn nothing(rule: DebrisRule, cell_area: f64, (cells, moves): ([usize; 2], bool)) -> Self {
        Self { rule, cell_area, above: moves.then(|| Array2::zeros(cells)), last: None, last_cycles: 0 }
    }

    /// Whether this was collected on a grid of `cells`.
    pub fn fits(&self, cells: [usize; 2], moves: bool) -> bool {
        let mut fields = self.above.iter().chain(self.last.iter().flatten());
        self.above.is_some() == moves && fields.all(|field| field.dim() == cells.into())
    }

    /// Debris of depths that wear off [length]: what is worn off the upper body lies where it wore off, and the volume is kept.
    fn fresh(&self, [lower, upper]: [Option<&Array2<f64>>; 2]) -> Option<Array2<f64>> {
        let mut fresh = lower? * self.rule.fraction;
        if let (Some(upper), Some(above)) = (upper, &self.above) {
            let all = above.sum();
            if all > 0.0 {
                fresh.scaled_add(self.rule.fraction * upper.sum() / all, above);
            }
        }
        Some(fresh)
    }

    /// Part of the debris of a cell that flows out by distance slipped.
    fn outflow_rate(&self) -> f64 {
        self.rule.outflow_length.map_or(0.0, f64::recip)
    }

    /// Lays the debris of cycles down and lets it flow out meanwhile, evenly over the distance slipped. Returns the volume that has flowed out
    /// [length^3].
    fn settle(
        &self,
        thickness: &mut Array2<f64>,
        fresh: &Array2<f64>,
        (path, cycles): (&Array2<f64>, f64),
    ) -> f64 {
        let rate = self.outflow_rate();
        let mut gone = 0.0;
        Zip::from(thickness).and(fresh).and(path).for_each(|thickness, fresh, path| {
            let relaxed = cycles * path * rate;
            let before = *thickness + fresh;
            if relaxed > 0.0 {
                let stays = -(-relaxed).exp_m1() / relaxed;
                *thickness = *thickness * (-relaxed).exp() + fresh * stays;
            } else {
                *thickness = before;
            }
            gone += before - *thickness;
        });
        gone * self.cell_area
    }

    /// Lays down once what one cycle has made so far, and returns the volume that has flowed out [length^3].
    pub fn settle_once(&self, thickness: &mut Array2<f64>, cycle: &OneCycle) -> f64 {
        let fresh = self.fresh(cycle.depths());
        fresh.map_or(0.0, |fresh| self.settle(thickness, &fresh, (&cycle.path, 1.0)))
    }
}

/// Makes debris of wear.
#[derive(Debug, Clone)]
pub struct Debris {
    /// Error of a block of cycles relative to what they make, at the most.
    tolerance: Option<f64>,
    /// Change of the thickness by such a block relative to the approach, at the most.
    largest_step: f64,
    collected: CollectedDebris,
}

impl Debris {
    /// Goes on from what was collected.
    pub fn new((tolerance, largest_step): (Option<f64>, f64), collected: CollectedDebris) -> Self {
        Self { tolerance, largest_step, collected }
    }

    /// What was collected since the thickness changed last.
    pub fn collected(&self) -> &CollectedDebris {
        &self.collected
    }

    /// Another stage: its cycles tell nothing of the jumps before.
    pub fn begin_stage(&mut self) {
        self.collected.last = None;
    }

    /// Adds what wore off the upper body in an increment, in the cells of the lower one.
    pub fn add_above(&mut self, worn: [&Array2<f64>; 2]) {
        if let Some(above) = &mut self.collected.above {
            for worn in worn {
                *above += worn;
            }
        }
    }

    /// Cycles that a computed one may stand for, at the most `most`, at an approach [length].
    pub fn cycles(&self, cycle: &OneCycle, thickness: &Array2<f64>, (approach, most): (f64, usize)) -> usize {
        let Some(fresh) = self.collected.fresh(cycle.depths()) else { return most };
        let mut after = thickness.clone();
        self.collected.settle(&mut after, &fresh, (&cycle.path, 1.0));
        let change = largest(after.iter().zip(thickness).map(|(after, before)| after - before));
        let by_step = bounded(self.largest_step * approach.abs() / change);
        let by_error = match (self.tolerance, self.change(&fresh, &cycle.path, thickness)) {
            (None, _) => usize::MAX,
            (Some(_), None) => 1,
            (Some(tolerance), Some([change, each])) => {
                let last = self.collected.last_cycles;
                bounded(1.0 + 2.0 * tolerance * each * last as f64 / change).min(2 * last)
            }
        };
        most.min(by_step).min(by_error).max(1)
    }

    /// Change of what a cycle does to the thickness there is now since the cycle before the last jump, and what comes and goes in one: the
    /// largest of all cells, each [length].
    fn change(&self, fresh: &Array2<f64>, path: &Array2<f64>, thickness: &Array2<f64>) -> Option<[f64; 2]> {
        let [last_fresh, last_path] = self.collected.last.as_ref()?;
        let rate = self.collected.outflow_rate();
        let of = |fresh: f64, path: f64, thickness: f64| fresh - thickness * path * rate;
        let now = fresh.iter().zip(path).zip(thickness);
        let then = last_fresh.iter().zip(last_path);
        let change = largest(
            now.zip(then)
                .map(|(((fresh, path), b), (before, way))| of(*fresh, *path, *b) - of(*before, *way, *b)),
        );
        let flows = path.iter().zip(thickness).map(|(path, thickness)| thickness * path * rate);
        Some([change, largest(fresh.iter().copied().chain(flows))])
    }

    /// Lays down the debris of so many cycles, of which one did `cycle` and all together wore off `depths` [length]; collecting starts
    /// anew. The volume that has flowed out [length^3], and the relative error by the jump before, where it is looked at.
    pub fn block(
        &mut self,
        thickness: &mut Array2<f64>,
        (cycle, cycles): (&OneCycle, usize),
        depths: [Option<&Array2<f64>>; 2],
    ) -> (f64, Option<f64>) {
        let of_one = self.collected.fresh(cycle.depths());
        let (Some(of_one), Some(fresh)) = (of_one, self.collected.fresh(depths)) else { return (0.0, None) };
        let error = self.tolerance.map(|_| match self.change(&of_one, &cycle.path, thickness) {
            Some([change, each]) if each > 0.0 => {
                let last = self.collected.last_cycles as f64;
                0.5 * (last - 1.0) * change / (last * each)
            }
            _ => 0.0,
        });
        let gone = self.collected.settle(thickness, &fresh, (&cycle.path, cycles as f64));
        let CollectedDebris { above, last, last_cycles, .. } = &mut self.collected;
        *last = self.tolerance.map(|_| [of_one, cycle.path.clone()]);
        *last_cycles = cycles;
        if let Some(above) = above {
            above.fill(0.0);
        }
        (gone, error)
    }
}

/// The largest size of some numbers.
fn largest(numbers: impl Iterator<Item = f64>) -> f64 {
    numbers.map(f64::abs).fold(0.0, f64::max)
}

/// A bound that is a whole number; a change of nothing bounds nothing.
fn bounded(bound: f64) -> usize {
    if bound.is_nan() { usize::MAX } else { bound.floor() as usize }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `db/dl = s - b/L` with a constant `s` has `b = s L + (b0 - s L) exp(-l/L)`, in one block of cycles or in many; what has come is there or gone.
    #[test]
    fn thickness_relaxes_to_what_comes_by_what_goes() {
        let rule = DebrisRule { fraction: 0.4, outflow_length: Some(3.0), stiffness: None };
        let debris = CollectedDebris::nothing(rule, 2.0, ([1, 2], false));
        // worn 5e-3 by a cycle of 0.2 slipped; the other cell does not slip
        let path = Array2::from_shape_vec((1, 2), vec![0.2, 0.0]).unwrap();
        let worn = Array2::from_shape_vec((1, 2), vec![5e-3, 0.0]).unwrap();
        let start = Array2::from_shape_vec((1, 2), vec![0.5, 0.25]).unwrap();
        let limit: f64 = 0.4 * 5e-3 / 0.2 * 3.0;
        let after = |blocks: usize| {
            let (mut thickness, mut gone) = (start.clone(), 0.0);
            for _ in 0..blocks {
                let cycles = 60.0 / blocks as f64;
                let fresh = debris.fresh([Some(&(&worn * cycles)), None]).unwrap();
                gone += debris.settle(&mut thickness, &fresh, (&path, cycles));
            }
            (thickness, gone)
        };
        let exact = limit + (0.5 - limit) * (-60.0_f64 * 0.2 / 3.0).exp();
        for (thickness, gone) in [after(1), after(60)] {
            // rounding of 60 sums
            assert!((thickness[[0, 0]] - exact).abs() < 1e-14, "{thickness} {exact}");
            assert_eq!(thickness[[0, 1]], 0.25);
            let kept = 2.0 * (thickness.sum() - start.sum());
            assert!((kept + gone - 2.0 * 0.4 * 60.0 * 5e-3).abs() < 1e-14);
        }
    }
}
