//! The slip of the edge that comes to open cells, linearised: means over neighbours nearer to the contact (`solver/moving_edge.rs`).

use std::collections::BTreeMap;

use super::change::{Change, add};
use super::solved::{Solved, at};
use crate::fields::Slopes;
use crate::model::Zone;
use crate::solver::{SlipOfEdge, distance};

/// Slip of the edge in the open cells that it was found in.
#[derive(Debug, Clone, Default)]
pub(super) struct SlipThatComes {
    /// Those nearest to the contact first.
    means: Vec<Mean>,
}

/// The slip of an open cell, as the mean of that of its neighbours nearer to the contact.
#[derive(Debug, Clone)]
struct Mean {
    cell: usize,
    /// Derivative of its distance from the edge by its gap.
    slope: f64,
    /// Sum of the weights.
    total: f64,
    nearer: Vec<Nearer>,
}

#[derive(Debug, Clone)]
struct Nearer {
    cell: usize,
    weight: f64,
    slope: f64,
    /// By how much its slip differs from the mean [length].
    off: [f64; 2],
    zone: Zone,
}

impl SlipThatComes {
    /// As it was found after an increment.
    pub fn new(found: &SlipOfEdge<'_, f64>, before: &Solved) -> Self {
        let [_, columns] = before.shape();
        let number = |[i, j]: [usize; 2]| i * columns + j;
        let slope = |place: [usize; 2]| {
            let [gap] = Slopes::<1>::of_each([before.gap[place]]);
            if before.zone[place] == Zone::Open && gap.value > 0.0 { distance(gap).by[0] } else { 0.0 }
        };
        let mut means = Vec::new();
        let mut known = BTreeMap::new();
        for mean in found.means() {
            known.insert(mean.cell, mean.slip);
            let nearer = mean.nearer.into_iter().map(|(next, weight)| {
                let zone = before.zone[next];
                let there = match zone {
                    Zone::Open => known.get(&next).copied().unwrap_or_default(),
                    Zone::Slip => at(&before.drift, number(next)),
                    Zone::Stick => [0.0; 2],
                };
                let off = [0, 1].map(|axis| there[axis] - mean.slip[axis]);
                Nearer { cell: number(next), weight, slope: slope(next), off, zone }
            });
            let nearer: Vec<Nearer> = nearer.collect();
            let total: f64 = nearer.iter().map(|next| next.weight).sum();
            if total > 0.0 {
                means.push(Mean { cell: number(mean.cell), slope: slope(mean.cell), total, nearer });
            }
        }
        Self { means }
    }

    /// Its change in all cells of the region.
    pub fn forward(&self, before: &Change) -> Vec<[f64; 2]> {
        let mut slid = vec![[0.0; 2]; before.gap.len()];
        for mean in &self.means {
            let mut sum = [0.0; 2];
            for next in &mean.nearer {
                let there = match next.zone {
                    Zone::Open => slid[next.cell],
                    Zone::Slip => at(&before.drift, next.cell),
                    Zone::Stick => [0.0; 2],
                };
                let weight = mean.slope * before.gap[mean.cell] - next.slope * before.gap[next.cell];
                for axis in 0..2 {
                    sum[axis] += next.weight * there[axis] + weight * next.off[axis];
                }
            }
            slid[mean.cell] = sum.map(|part| part / mean.total);
        }
        slid
    }

    /// Backwards: adds to what was before.
    pub fn transposed(&self, mut slid: Vec<[f64; 2]>, before: &mut Change) {
        for mean in self.means.iter().rev() {
            let of = slid[mean.cell].map(|part| part / mean.total);
            for next in &mean.nearer {
                let there = of.map(|part| next.weight * part);
                match next.zone {
                    Zone::Open => {
                        for axis in 0..2 {
                            slid[next.cell][axis] += there[axis];
                        }
                    }
                    Zone::Slip => add(&mut before.drift, next.cell, there),
                    Zone::Stick => {}
                }
                let weight = of[0] * next.off[0] + of[1] * next.off[1];
                before.gap[mean.cell] += mean.slope * weight;
                before.gap[next.cell] -= next.slope * weight;
            }
        }
    }
}
