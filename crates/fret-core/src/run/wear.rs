//! Wear in the course of a run: the depth of a cycle, the number of cycles it may stand for, and when a coating is gone.

use ndarray::{Array2, Zip};
use serde::{Deserialize, Serialize};

use crate::fields::stored;
use crate::model::{ContactState, CoulombFriction, SurfaceGrid, WearLaw, WearRule};

/// Share of a cell's pressure that a block may take off at the most, as far as the cell's own compliance tells. Above 0.8
/// neighbouring cells would take turns in carrying the load.
const STABLE_SHARE: f64 = 0.4;

/// The wear of one block of cycles is more than the grid can follow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TooFast {
    /// Share of a cell's pressure that one cycle takes off, by its own compliance.
    pub share: f64,
}

/// Wear of increments, until the gap is opened by it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Collected {
    /// Depth worn off [length].
    #[serde(with = "stored")]
    depth: Array2<f64>,
    /// Length of the way slipped [length].
    #[serde(with = "stored")]
    path: Array2<f64>,
}

impl Collected {
    /// Nothing worn yet.
    pub fn nothing(cells: [usize; 2]) -> Self {
        Self { depth: Array2::zeros(cells), path: Array2::zeros(cells) }
    }

    /// Depth worn off [length].
    pub(crate) fn depth(&self) -> &Array2<f64> {
        &self.depth
    }

    /// Whether this was collected on a grid of `cells`.
    pub fn fits(&self, cells: [usize; 2]) -> bool {
        [&self.depth, &self.path].iter().all(|field| field.dim() == cells.into())
    }
}

/// Collects the wear of increments and opens the gap by it.
#[derive(Debug, Clone)]
pub struct Wearing {
    rule: WearRule,
    /// Normal displacement of a cell by unit pressure on itself [length/pressure].
    own: f64,
    /// Gap of the unworn surfaces [length].
    unworn: Array2<f64>,
    /// Friction law in force.
    friction: CoulombFriction,
    collected: Collected,
}

/// A block of equal cycles.
#[derive(Debug, Clone, PartialEq)]
pub struct Block {
    /// How many.
    pub cycles: usize,
    /// Depth they wear off together [length].
    pub depth: Array2<f64>,
    /// The deepest cell, when it has reached the limit.
    pub through: Option<[usize; 2]>,
}

impl Wearing {
    /// Goes on from what was collected; `own`: normal displacement of a cell by unit pressure on itself [length/pressure],
    /// `unworn`: gap of the unworn surfaces [length].
    pub fn new(
        rule: WearRule,
        own: f64,
        unworn: Array2<f64>,
        friction: CoulombFriction,
        collected: Collected,
    ) -> Self {
        Self { rule, own, unworn, friction, collected }
    }

    /// Another friction law from now on.
    pub fn set_friction(&mut self, friction: &CoulombFriction) {
        self.friction.clone_from(friction);
    }

    /// What was collected since the gap was opened last.
    pub fn collected(&self) -> &Collected {
        &self.collected
    }

    /// Undeformed gap of surfaces worn by a depth in all. It depends on that depth alone, whatever steps led to it.
    pub fn gap(&self, worn_depth: &Array2<f64>) -> Array2<f64> {
        &self.unworn + worn_depth
    }

    /// Adds the wear between two states that follow each other.
    pub fn add(&mut self, before: &ContactState, after: &ContactState) {
        self.rule.add(before, after, &self.friction, &mut self.collected.depth);
        let slip_y = &after.slip[1] - &before.slip[1];
        Zip::from(&mut self.collected.path)
            .and(&after.slip[0])
            .and(&before.slip[0])
            .and(&slip_y)
            .for_each(|path, now, then, y| *path += (now - then).hypot(*y));
    }

    /// The block that the wear collected so far stands for, at the most `most` cycles; collecting starts anew.
    ///
    /// # Errors
    /// When a single cycle takes more off a cell than its own compliance can follow.
    pub fn block(&mut self, state: &ContactState, most: usize) -> Result<Block, TooFast> {
        let softening = self
            .collected
            .path
            .indexed_iter()
            .map(|((i, j), path)| match self.rule.law {
                WearLaw::Archard => *path,
                WearLaw::Energy => path * self.friction.at(i, j),
            })
            .fold(0.0, f64::max)
            * self.rule.coefficient
            / self.own;
        if softening > STABLE_SHARE {
            return Err(TooFast { share: softening });
        }
        let deepest = self.collected.depth.iter().copied().fold(0.0, f64::max);
        let within =
            |bound: f64, each: f64| if each > 0.0 { (bound / each).floor() as usize } else { usize::MAX };
        let mut cycles = most
            .min(self.rule.every)
            .min(within(STABLE_SHARE, softening))
            .min(within(self.rule.largest_step * state.approach.abs(), deepest))
            .max(1);
        let worn = |cell: (usize, usize)| state.worn_depth.as_ref().map_or(0.0, |worn| worn[cell]);
        if let Some(limit) = self.rule.limit {
            for (cell, each) in self.collected.depth.indexed_iter().filter(|(_, each)| **each > 0.0) {
                let needed = ((limit - worn(cell)) / each).ceil().max(1.0);
                cycles = cycles.min(needed as usize);
            }
        }
        let depth = &self.collected.depth * cycles as f64;
        let mut deepest = ([0, 0], 0.0);
        for (cell, more) in depth.indexed_iter() {
            if worn(cell) + more > deepest.1 {
                deepest = ([cell.0, cell.1], worn(cell) + more);
            }
        }
        let through = self.rule.limit.filter(|limit| deepest.1 >= *limit).map(|_| deepest.0);
        self.collected.depth.fill(0.0);
        self.collected.path.fill(0.0);
        Ok(Block { cycles, depth, through })
    }
}

/// Volume worn off [length^3], and the largest depth [length].
pub fn worn(state: &ContactState, grid: &SurfaceGrid) -> [f64; 2] {
    state.worn_depth.as_ref().map_or([0.0; 2], |depth| {
        let volume = depth.iter().sum::<f64>() * grid.cell_area();
        [volume, depth.iter().copied().fold(0.0, f64::max)]
    })
}
