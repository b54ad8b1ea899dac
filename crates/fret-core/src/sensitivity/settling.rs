//! Debris at the end of a block of cycles, linearised: a part of what wears off stays, and flows out with the distance that is slipped. The formulas
//! are those of the run (`run/debris.rs`).

use super::scene::Scene;
use super::solved::Solved;
use crate::model::DebrisRule;

/// A cell with debris. Thickness at the end: `b' = b exp(-r) + f (1 - exp(-r)) / r` with the thickness `b` before, what is laid down `f`, and the
/// distance slipped `r` over the outflow length.
struct Settled {
    cell: usize,
    /// Derivatives by `b`, by `f` and by `r`.
    by: [f64; 3],
    /// Depth worn off in the block [length], and `r`.
    depth: f64,
    relaxed: f64,
}

/// The debris of all cells.
pub(super) struct Settling {
    rule: DebrisRule,
    cycles: f64,
    cells: Vec<Settled>,
}

impl Settling {
    /// That of a block of so many cycles between two states; `None` where none stays.
    pub fn new(scene: &Scene<'_>, [before, after]: [&Solved; 2], cycles: usize) -> Option<Self> {
        let rule = scene.plan.case.wear.as_ref()?.debris?;
        let number = |field: &[f64], cell: usize| field.get(cell).copied().unwrap_or(0.0);
        let settled = |cell: usize| {
            let depth = number(&after.worn, cell) - number(&before.worn, cell);
            let (thickness, fresh) = (number(&before.debris, cell), rule.fraction * depth);
            // What is missing of it has flowed out: that tells how far the cell has slipped.
            let relaxed =
                rule.outflow_length.map_or(0.0, |_| relaxed(thickness, fresh, number(&after.debris, cell)));
            let (stays, by_relaxed) = staying(relaxed);
            let by = [(-relaxed).exp(), stays, fresh * by_relaxed - thickness * (-relaxed).exp()];
            (thickness + fresh > 0.0).then_some(Settled { cell, by, depth, relaxed })
        };
        let cells = (0..scene.region.len()).filter_map(settled).collect();
        Some(Self { rule, cycles: cycles as f64, cells })
    }

    /// What relaxes by a unit of the distance slipped in the cycle that was computed, and changes by the outflow length.
    fn rates(&self, relaxed: f64) -> [f64; 2] {
        self.rule.outflow_length.map_or([0.0; 2], |length| [self.cycles / length, -relaxed / length])
    }

    /// Change of the thickness at the end of the block less that before; `more`: changes of the depth that wears off. `numbers`: changes of fraction
    /// and outflow length.
    pub fn forward(&self, (debris, path): (&[f64], &[f64]), more: &[f64], numbers: [f64; 2]) -> Vec<f64> {
        let mut change = vec![0.0; debris.len()];
        for Settled { cell, by, depth, relaxed } in &self.cells {
            let [by_path, by_length] = self.rates(*relaxed);
            let fresh = self.rule.fraction * more[*cell] + numbers[0] * depth;
            let slipped = by_path * path[*cell] + by_length * numbers[1];
            change[*cell] = (by[0] - 1.0) * debris[*cell] + by[1] * fresh + by[2] * slipped;
        }
        change
    }

    /// Backwards, from that of the thickness at the end: adds to that before, to the slip distance, to the depth that wears off and to the numbers.
    pub fn transposed(
        &self,
        of: &[f64],
        (debris, path): (&mut [f64], &mut [f64]),
        more: &mut [f64],
        numbers: &mut [f64],
    ) {
        for Settled { cell, by, depth, relaxed } in &self.cells {
            let [by_path, by_length] = self.rates(*relaxed);
            let of = of[*cell];
            debris[*cell] += (by[0] - 1.0) * of;
            more[*cell] += self.rule.fraction * by[1] * of;
            path[*cell] += by_path * by[2] * of;
            numbers[0] += depth * by[1] * of;
            numbers[1] += by_length * by[2] * of;
        }
    }
}

/// Part of what is laid down evenly that stays where so much of it relaxes, and its derivative.
fn staying(relaxed: f64) -> (f64, f64) {
    // Below, of the series what is left is less than the rounding of the other form.
    if relaxed < 1e-4 {
        return (
            1.0 - relaxed * (0.5 - relaxed * (1.0 / 6.0 - relaxed / 24.0)),
            -0.5 + relaxed * (1.0 / 3.0 - relaxed / 8.0),
        );
    }
    let stays = -(-relaxed).exp_m1() / relaxed;
    (stays, ((-relaxed).exp() - stays) / relaxed)
}

/// How much has relaxed where a thickness and what was laid down have become `after`: by Newton's method, from below, as the function is convex and
/// falls.
fn relaxed(before: f64, fresh: f64, after: f64) -> f64 {
    let mut relaxed = 0.0_f64;
    for _ in 0..100 {
        let (stays, by) = staying(relaxed);
        let off = before * (-relaxed).exp() + fresh * stays - after;
        let step = off / (before * (-relaxed).exp() - fresh * by);
        if !(step > 1e-16 * relaxed) {
            break;
        }
        relaxed += step;
    }
    relaxed
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What has relaxed is found again, from a millionth to thirty. 1e-12, absolute where it is small: rounding of what is left.
    #[test]
    fn what_has_relaxed_is_found_again() {
        for (before, fresh) in [(1.0, 0.0), (0.0, 1.0), (0.3, 2.0), (2.0, 0.01)] {
            for expected in [0.0, 1e-6, 1e-3, 0.1, 1.0, 5.0, 15.0_f64] {
                let stays = if expected == 0.0 { 1.0 } else { -(-expected).exp_m1() / expected };
                let after = before * (-expected).exp() + fresh * stays;
                let found = relaxed(before, fresh, after);
                let bound = 1e-12 * (1.0 + expected) * (before + fresh) / after;
                assert!((found - expected).abs() < bound, "{before} {fresh} {expected}: {found}");
            }
        }
    }
}
