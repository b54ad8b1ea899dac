//! The end of a block of cycles, linearised: what one of them has collected is taken off the surfaces, and changes their friction, for all that it
//! stands for. The formulas are those of the run (`run/wear.rs`, `run/evolving.rs`).

use super::case_number::{FRACTION, OF_WEAR};
use super::change::{Change, DISSIPATED, EXTERNAL, OF_BULK, OF_CYCLE, UNRESOLVED};
use super::scene::Scene;
use super::settling::Settling;
use super::solved::Solved;
use crate::fields::{add_scaled, dot};
use crate::model::DepthSlopes;

/// A cell that wears through layers.
struct Through {
    cell: usize,
    /// Derivatives of the depth at the end by that before, and by the work of all cycles [1/pressure].
    by_depth: f64,
    by_work: f64,
    /// By coefficient and thickness of each layer.
    by_layers: Vec<[f64; 2]>,
}

/// The end of a block of cycles.
pub(super) struct Block {
    cycles: usize,
    /// Cells that wear through layers, each by its own coefficient; `None` where one coefficient holds.
    layers: Option<Vec<Through>>,
    /// Debris that stays.
    settling: Option<Settling>,
}

impl Block {
    /// That of so many cycles between two states.
    pub fn new(scene: &Scene<'_>, [before, after]: [&Solved; 2], cycles: usize) -> Self {
        let layers = scene.plan.case.wear.as_ref().and_then(|wear| wear.layers.as_ref());
        let through = |(cell, last): (usize, &f64)| {
            let first = before.worn.get(cell).copied().unwrap_or(0.0);
            if *last <= first {
                return None;
            }
            let [first, last] = [first, *last].map(|depth| layers.map(|layers| layers.slopes_at(depth)));
            let (first, last): (DepthSlopes, DepthSlopes) = first.zip(last)?;
            // At the same depth with another number the work before is another one.
            let by_depth = last.by_work / first.by_work;
            let both = first.by_layers.iter().zip(&last.by_layers);
            let by_layers = both.map(|(first, last)| [0, 1].map(|of| last[of] - by_depth * first[of]));
            Some(Through { cell, by_depth, by_work: last.by_work, by_layers: by_layers.collect() })
        };
        let layers = layers.map(|_| after.worn.iter().enumerate().filter_map(through).collect());
        Self { cycles, layers, settling: Settling::new(scene, [before, after], cycles) }
    }

    /// Changes what is left behind: surfaces wear and rub on; as many cycles dissipate the energy of one, leave as much unresolved, and store nothing.
    /// `wear`: changes of the numbers of the wear rule; `layers`: of coefficient and thickness of each layer.
    pub fn forward(&self, change: &mut Change, wear: &[f64; OF_WEAR], layers: &[[f64; 2]]) {
        let (cycles, others) = (self.cycles as f64, self.cycles as f64 - 1.0);
        let Change { worn, gap, collected, slipped, slipping, debris, path, energies, .. } = change;
        let mut more: Vec<f64> = Vec::new();
        if let Some(through) = &self.layers {
            more.resize(worn.len(), 0.0);
            for Through { cell, by_depth, by_work, by_layers } in through {
                let by_numbers = dot(by_layers.as_flattened(), layers.as_flattened());
                more[*cell] =
                    (by_depth - 1.0) * worn[*cell] + by_work * cycles * collected[*cell] + by_numbers;
            }
        } else {
            more.extend(collected.iter().map(|collected| cycles * collected));
        }
        if let Some(settling) = &self.settling {
            let thicker = settling.forward((debris, path), &more, [wear[FRACTION], wear[FRACTION + 1]]);
            add_scaled(debris, 1.0, &thicker);
            add_scaled(gap, -1.0, &thicker);
        }
        for ((worn, gap), more) in worn.iter_mut().zip(gap).zip(&more) {
            *worn += more;
            *gap += more;
        }
        collected.fill(0.0);
        path.fill(0.0);
        slipped.iter_mut().zip(&*slipping).for_each(|(slipped, more)| *slipped += cycles * more);
        slipping.fill(0.0);
        let [dissipated, unresolved, by_bulk] = OF_CYCLE.map(|place| others * energies[place]);
        energies[DISSIPATED] += dissipated;
        energies[UNRESOLVED] += unresolved;
        energies[EXTERNAL] += dissipated + unresolved;
        energies[OF_BULK] += by_bulk;
        for place in OF_CYCLE {
            energies[place] = 0.0;
        }
    }

    /// Backwards: adds to the numbers of the wear rule and to those of the layers.
    pub fn transposed(&self, change: &mut Change, wear: &mut [f64; OF_WEAR], layers: &mut [[f64; 2]]) {
        let (cycles, others) = (self.cycles as f64, self.cycles as f64 - 1.0);
        let Change { worn, gap, collected, slipped, slipping, debris, path, energies, .. } = change;
        let mut more: Vec<f64> = worn.iter().zip(&*gap).map(|(worn, gap)| worn + gap).collect();
        path.fill(0.0);
        if let Some(settling) = &self.settling {
            let thicker: Vec<f64> = debris.iter().zip(&*gap).map(|(debris, gap)| debris - gap).collect();
            settling.transposed(&thicker, (debris, path), &mut more, &mut wear[FRACTION..]);
        }
        if let Some(through) = &self.layers {
            collected.fill(0.0);
            for Through { cell, by_depth, by_work, by_layers } in through {
                let of = more[*cell];
                collected[*cell] = by_work * cycles * of;
                worn[*cell] += (by_depth - 1.0) * of;
                add_scaled(layers.as_flattened_mut(), of, by_layers.as_flattened());
            }
        } else {
            collected.iter_mut().zip(&more).for_each(|(collected, more)| *collected = cycles * more);
        }
        slipping.iter_mut().zip(&*slipped).for_each(|(more, slipped)| *more = cycles * slipped);
        let of = |energy: usize| energies[energy];
        let of_cycle = [of(DISSIPATED) + of(EXTERNAL), of(UNRESOLVED) + of(EXTERNAL), of(OF_BULK)];
        for (place, of) in OF_CYCLE.into_iter().zip(of_cycle) {
            energies[place] = others * of;
        }
    }
}
