//! The end of a block of cycles, linearised: what one of them has collected is taken off the surfaces, and changes their friction, for all that it
//! stands for. The formulas are those of the run (`run/wear.rs`, `run/evolving.rs`).

use super::change::{Change, DISSIPATED, EXTERNAL, OF_BULK, OF_CYCLE, UNRESOLVED};
use super::scene::Scene;
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
}

impl Block {
    /// That of so many cycles, with the depths before and after in the cells of the region; none where nothing has worn.
    pub fn new(scene: &Scene<'_>, [before, after]: [&[f64]; 2], cycles: usize) -> Self {
        let layers = scene.plan.case.wear.as_ref().and_then(|wear| wear.layers.as_ref());
        let through = |(cell, after): (usize, &f64)| {
            let before = before.get(cell).copied().unwrap_or(0.0);
            if *after <= before {
                return None;
            }
            let [first, last] = [before, *after].map(|depth| layers.map(|layers| layers.slopes_at(depth)));
            let (first, last): (DepthSlopes, DepthSlopes) = first.zip(last)?;
            // At the same depth with another number the work before is another one.
            let by_depth = last.by_work / first.by_work;
            let both = first.by_layers.iter().zip(&last.by_layers);
            let by_layers = both.map(|(first, last)| [0, 1].map(|of| last[of] - by_depth * first[of]));
            Some(Through { cell, by_depth, by_work: last.by_work, by_layers: by_layers.collect() })
        };
        let layers = layers.map(|_| after.iter().enumerate().filter_map(through).collect());
        Self { cycles, layers }
    }

    /// Changes what is left behind: surfaces wear and rub on; as many cycles dissipate the energy of one, leave as much unresolved, and store nothing.
    /// `layers`: changes of coefficient and thickness of each layer.
    pub fn forward(&self, change: &mut Change, layers: &[[f64; 2]]) {
        let (cycles, others) = (self.cycles as f64, self.cycles as f64 - 1.0);
        let Change { worn, gap, collected, slipped, slipping, energies, .. } = change;
        if let Some(through) = &self.layers {
            for Through { cell, by_depth, by_work, by_layers } in through {
                let by_numbers: f64 =
                    by_layers.iter().flatten().zip(layers.iter().flatten()).map(|(by, of)| by * of).sum();
                let more = (by_depth - 1.0) * worn[*cell] + by_work * cycles * collected[*cell] + by_numbers;
                worn[*cell] += more;
                gap[*cell] += more;
            }
        } else {
            for ((worn, gap), more) in worn.iter_mut().zip(gap).zip(&*collected) {
                *worn += cycles * more;
                *gap += cycles * more;
            }
        }
        collected.fill(0.0);
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

    /// Backwards: adds to those of the layers.
    pub fn transposed(&self, change: &mut Change, layers: &mut [[f64; 2]]) {
        let (cycles, others) = (self.cycles as f64, self.cycles as f64 - 1.0);
        let Change { worn, gap, collected, slipped, slipping, energies, .. } = change;
        if let Some(through) = &self.layers {
            collected.fill(0.0);
            for Through { cell, by_depth, by_work, by_layers } in through {
                let of = worn[*cell] + gap[*cell];
                collected[*cell] = by_work * cycles * of;
                worn[*cell] += (by_depth - 1.0) * of;
                for (layer, by) in layers.iter_mut().flatten().zip(by_layers.iter().flatten()) {
                    *layer += by * of;
                }
            }
        } else {
            for ((more, worn), gap) in collected.iter_mut().zip(&*worn).zip(&*gap) {
                *more = cycles * (worn + gap);
            }
        }
        slipping.iter_mut().zip(&*slipped).for_each(|(more, slipped)| *more = cycles * slipped);
        let of = |energy: usize| energies[energy];
        let of_cycle = [of(DISSIPATED) + of(EXTERNAL), of(UNRESOLVED) + of(EXTERNAL), of(OF_BULK)];
        for (place, of) in OF_CYCLE.into_iter().zip(of_cycle) {
            energies[place] = others * of;
        }
    }
}
