//! Wear in the course of a run: the depth of a cycle, the number of cycles it may stand for, and when a coating is gone.

use ndarray::{Array2, Zip};
use serde::{Deserialize, Serialize};

use super::rim::OpenRim;
use super::slip_increment::SlipIncrement;
use super::stiffest_wave::StiffestWave;
use super::upper_frame::UpperFrame;
use crate::fields::stored;
use crate::history::DebrisRecord;
use crate::model::{ContactState, CoulombFriction, WearLaw, WearLayers, WearRule};
use crate::plan::Plan;
use crate::solver::SolveError;

/// Share of the stiffest wave of pressure that a block may take off at the most. Above 2 such a wave would grow with every block: on
/// half-spaces neighbouring cells, on nearly incompressible films wider regions would take turns in carrying the load.
const STABLE_SHARE: f64 = 1.0;

/// The wear of one block of cycles is more than the grid can follow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TooFast {
    /// Share of the stiffest wave of pressure that one cycle takes off.
    pub share: f64,
}

/// Wear of increments, until the gap is opened by it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Collected {
    /// Depth worn off [length], or the work that layers wear by [pressure x length].
    #[serde(with = "stored")]
    wear: Array2<f64>,
    /// Length of the way slipped [length].
    #[serde(with = "stored")]
    path: Array2<f64>,
    /// What the cycle before the last jump collected, where the error of jumps is looked at.
    #[serde(with = "stored")]
    last: Option<Array2<f64>>,
    /// Cycles of that jump.
    last_cycles: usize,
    /// Depths off the lower and the upper body for which the elastic response in use was found [length].
    thinned: [f64; 2],
    /// Layers that wear, each by its own coefficient.
    layers: Option<WearLayers>,
}

impl Collected {
    /// Nothing worn yet.
    pub fn nothing(cells: [usize; 2], layers: Option<WearLayers>) -> Self {
        Self {
            wear: Array2::zeros(cells),
            path: Array2::zeros(cells),
            last: None,
            last_cycles: 0,
            thinned: [0.0; 2],
            layers,
        }
    }

    /// The same, of bodies whose elastic response was found for depths off the lower and the upper one [length].
    pub fn thinned_by(self, thinned: [f64; 2]) -> Self {
        Self { thinned, ..self }
    }

    /// Depths off the lower and the upper body for which the elastic response in use was found [length].
    pub fn thinned(&self) -> [f64; 2] {
        self.thinned
    }

    /// Whether anything has worn since the gap was opened last.
    pub(crate) fn is_empty(&self) -> bool {
        self.wear.iter().all(|wear| *wear == 0.0)
    }

    /// Takes off a depth what was collected, once.
    pub(crate) fn take_off(&self, depth: &mut Array2<f64>) {
        let layers = self.layers.as_ref();
        Zip::from(depth).and(&self.wear).for_each(|depth, wear| *depth += deeper(layers, *depth, *wear));
    }

    /// Slip distance in every cell [length].
    pub(super) fn path(&self) -> &Array2<f64> {
        &self.path
    }

    /// Depth [length] that what was collected takes off a body worn by `worn` [length] in so many cycles.
    pub(super) fn of_cycles(&self, cycles: f64, worn: Option<&Array2<f64>>) -> Array2<f64> {
        let mut depth = &self.wear * cycles;
        let layers = self.layers.as_ref();
        if layers.is_some() {
            let worn = |cell: (usize, usize)| worn.map_or(0.0, |worn| worn[cell]);
            depth.indexed_iter_mut().for_each(|(cell, wear)| *wear = deeper(layers, worn(cell), *wear));
        }
        depth
    }

    /// Whether this was collected on a grid of `cells`.
    pub fn fits(&self, cells: [usize; 2]) -> bool {
        [&self.wear, &self.path].into_iter().chain(&self.last).all(|field| field.dim() == cells.into())
            && self.thinned.iter().all(|depth| depth.is_finite() && *depth >= 0.0)
    }
}

/// Depth [length] that what was collected takes off where `worn` is gone already.
fn deeper(layers: Option<&WearLayers>, worn: f64, wear: f64) -> f64 {
    match layers {
        None => wear,
        Some(_) if wear == 0.0 => 0.0,
        Some(layers) => (layers.after(layers.at_depth(worn).work + wear).depth() - worn).max(0.0),
    }
}

/// Collects the wear of increments and opens the gap by it.
#[derive(Debug, Clone)]
pub struct Wearing {
    rule: WearRule,
    /// What bounds the wear of one step.
    stiffest: StiffestWave,
    /// Gap of the unworn surfaces [length].
    unworn: Array2<f64>,
    /// Friction law that bounds what the body loses in a cycle: that of its own cells, or one that no cell exceeds.
    friction: CoulombFriction,
    /// Part of the wear coefficient that is in force in each cell, where that depends on the rim of the contact.
    rim: Option<OpenRim>,
    collected: Collected,
}

/// A block of equal cycles.
#[derive(Debug, Clone, PartialEq)]
pub struct Block {
    /// Depth they wear off together [length].
    pub depth: Array2<f64>,
    /// The deepest cell, when it has reached the limit.
    pub through: Option<[usize; 2]>,
    /// The first cell through whose coating these cycles wear, and after how many of them.
    pub coating_through: Option<([usize; 2], usize)>,
    /// Error of the depth by the jump before relative to the depth of that jump, where it is looked at.
    pub jump_error: Option<f64>,
}

impl Wearing {
    /// Goes on from what was collected; `unworn`: gap of the unworn surfaces [length].
    pub fn new(
        rule: WearRule,
        stiffest: StiffestWave,
        unworn: Array2<f64>,
        friction: CoulombFriction,
        collected: Collected,
    ) -> Self {
        Self { rule, stiffest, unworn, friction, rim: None, collected }
    }

    /// The same with a wear coefficient that depends on the rim of the contact.
    #[must_use]
    pub fn with_rim(self, rim: Option<OpenRim>) -> Self {
        Self { rim, ..self }
    }

    /// Another friction law from now on, of the body's own cells, or one that none of them exceeds.
    pub fn set_friction(&mut self, friction: &CoulombFriction) {
        self.friction.clone_from(friction);
    }

    /// The bodies are found anew, for mean depths off the lower and the upper one.
    pub fn set_thinned(&mut self, depths: [f64; 2], stiffest: StiffestWave) {
        self.collected.thinned = depths;
        self.stiffest = stiffest;
    }

    /// Another stage: its cycles tell nothing of the jumps before.
    pub fn begin_stage(&mut self) {
        self.collected.last = None;
    }

    /// What was collected since the gap was opened last.
    pub fn collected(&self) -> &Collected {
        &self.collected
    }

    /// Undeformed gap of surfaces that are worn as in a state. It depends on what is worn and filled alone, whatever steps led to it.
    pub fn gap(&self, state: &ContactState) -> Array2<f64> {
        let mut gap = self.unworn.clone();
        state.open(&mut gap);
        gap
    }

    /// Adds the wear of an increment.
    pub fn add(&mut self, increment: SlipIncrement<'_>) {
        if self.rim.is_some() {
            for worn in self.by_ends(increment) {
                self.collected.wear += &worn;
            }
        } else {
            increment.add_wear(&self.rule, &mut self.collected.wear);
        }
        self.collected.path += &increment.path();
    }

    /// The wear of an increment, by what each of its ends has a part in.
    fn by_ends(&self, increment: SlipIncrement<'_>) -> [Array2<f64>; 2] {
        let mut worn = increment.wear_by_ends(&self.rule);
        if let Some(rim) = &self.rim {
            for (worn, state) in worn.iter_mut().zip(increment.states) {
                *worn *= &rim.factors(&state.pressure);
            }
        }
        worn
    }

    /// Adds the wear of the upper body in an increment, in its own frame: what each pressure has a part in lies where the body was under it.
    /// Returns both parts over the grid.
    ///
    /// # Errors
    /// When it leaves the grid, on which the body lay without a shift.
    pub fn add_in_frame(
        &mut self,
        increment: SlipIncrement<'_>,
        frame: UpperFrame,
    ) -> Result<[Array2<f64>; 2], SolveError> {
        let worn = self.by_ends(increment);
        for (worn, state) in worn.iter().zip(increment.states) {
            frame.collect(worn, state, &mut self.collected.wear)?;
        }
        self.collected.path += &frame.brought_back(&increment.path(), increment.states[1]);
        Ok(worn)
    }

    /// Share of the stiffest wave of pressure that the wear collected so far takes off.
    pub fn softening(&self) -> f64 {
        self.collected
            .path
            .indexed_iter()
            .map(|((i, j), path)| match self.rule.law {
                WearLaw::Archard => *path,
                WearLaw::Energy => path * self.friction.at(i, j),
            })
            .fold(0.0, f64::max)
            * self.rule.largest_rate()
            / self.stiffest.displacement(&self.collected.path)
    }

    /// Cycles that the wear collected so far may stand for, at the most `most`, at an approach [length]; `softening`: what one of them takes
    /// off both bodies, see [`Wearing::softening`].
    ///
    /// # Errors
    /// When a single cycle takes off more than the stiffest wave of pressure can follow.
    pub fn cycles(
        &self,
        worn: Option<&Array2<f64>>,
        (approach, softening): (f64, f64),
        most: usize,
    ) -> Result<usize, TooFast> {
        if softening > STABLE_SHARE {
            return Err(TooFast { share: softening });
        }
        let rule = &self.rule;
        let deepest = self.collected.of_cycles(1.0, worn).into_iter().fold(0.0, f64::max);
        let worn = |cell: (usize, usize)| worn.map_or(0.0, |worn| worn[cell]);
        let within =
            |bound: f64, each: f64| if each > 0.0 { (bound / each).floor() as usize } else { usize::MAX };
        let mut cycles = most
            .min(rule.every)
            .min(within(STABLE_SHARE, softening))
            .min(within(rule.largest_step * approach.abs(), deepest))
            .min(self.within_tolerance())
            .max(1);
        if let Some(limit) = rule.limit {
            for (cell, each) in self.collected.wear.indexed_iter().filter(|(_, each)| **each > 0.0) {
                let needed = (self.left_to(limit, worn(cell)) / each).ceil().max(1.0);
                cycles = cycles.min(needed as usize);
            }
        }
        Ok(cycles)
    }

    /// The block of so many cycles that the wear collected so far stands for; collecting starts anew.
    pub fn block(&mut self, worn: Option<&Array2<f64>>, cycles: usize) -> Block {
        let depth = self.collected.of_cycles(cycles as f64, worn);
        let worn = |cell: (usize, usize)| worn.map_or(0.0, |worn| worn[cell]);
        let rule = &self.rule;
        let mut deepest = ([0, 0], 0.0);
        for (cell, more) in depth.indexed_iter() {
            if worn(cell) + more > deepest.1 {
                deepest = ([cell.0, cell.1], worn(cell) + more);
            }
        }
        // Depths through layers are rounded.
        let rounding = if rule.layers.is_some() { 1e-12 } else { 0.0 };
        let through = rule.limit.filter(|limit| deepest.1 >= *limit * (1.0 - rounding)).map(|_| deepest.0);
        let coating_through = rule.coating.and_then(|coating| self.first_through(coating, worn, cycles));
        let jump_error = rule.tolerance.map(|_| self.jump_error());
        let Collected { wear, path, last, last_cycles, .. } = &mut self.collected;
        *last = rule.tolerance.map(|_| wear.clone());
        *last_cycles = cycles;
        wear.fill(0.0);
        path.fill(0.0);
        Block { depth, through, coating_through, jump_error }
    }

    /// The first cell whose depth reaches that of a coating within so many cycles, and after how many; of several the most worn. `None`
    /// where one is through already.
    fn first_through(
        &self,
        coating: f64,
        worn: impl Fn((usize, usize)) -> f64,
        cycles: usize,
    ) -> Option<([usize; 2], usize)> {
        // Depths through layers are rounded.
        let rounding = if self.rule.layers.is_some() { 1e-12 } else { 0.0 };
        let mut first: Option<((usize, usize), f64)> = None;
        for (cell, each) in self.collected.wear.indexed_iter() {
            if worn(cell) >= coating * (1.0 - rounding) {
                return None;
            }
            let needed = self.left_to(coating, worn(cell)) / each;
            if *each > 0.0 && first.is_none_or(|(_, least)| needed < least) {
                first = Some((cell, needed));
            }
        }
        let ((i, j), needed) = first?;
        let needed = (needed * (1.0 - rounding)).ceil().max(1.0);
        (needed <= cycles as f64).then_some(([i, j], needed as usize))
    }

    /// What has to be collected in a cell until the depth there is at a limit.
    fn left_to(&self, limit: f64, worn: f64) -> f64 {
        let Some(layers) = &self.rule.layers else { return limit - worn };
        let at_limit = layers.at_depth(limit);
        if at_limit.depth() < limit * (1.0 - 1e-12) {
            return f64::INFINITY; // what lies above does not wear
        }
        at_limit.work - layers.at_depth(worn).work
    }

    /// Change of what a cycle collects since the cycle before the last jump, and what that collected: the largest of all cells, each.
    fn change(&self) -> Option<[f64; 2]> {
        let last = self.collected.last.as_ref()?;
        let pairs = || self.collected.wear.iter().zip(last);
        let change = pairs().map(|(now, then)| (now - then).abs()).fold(0.0, f64::max);
        Some([change, last.iter().copied().fold(0.0, f64::max)])
    }

    /// Error of the depth by the last jump, relative to that depth. It took the wear of its `n` cycles for that of the first; had it changed
    /// evenly to what it is in the cycle after them, all would have had `(n - 1) / 2` times the change more.
    fn jump_error(&self) -> f64 {
        let cycles = self.collected.last_cycles as f64;
        match self.change() {
            Some([change, each]) if each > 0.0 => 0.5 * (cycles - 1.0) * change / (cycles * each),
            _ => 0.0,
        }
    }

    /// Cycles of the next jump whose error is within the tolerance when wear goes on to change as over the last jump.
    fn within_tolerance(&self) -> usize {
        let Some(tolerance) = self.rule.tolerance else { return usize::MAX };
        let Some([change, _]) = self.change() else { return 1 };
        let last = self.collected.last_cycles;
        let each = self.collected.wear.iter().copied().fold(0.0, f64::max);
        let bound = 1.0 + 2.0 * tolerance * each * last as f64 / change;
        // A change of nothing bounds nothing.
        let bound = if bound.is_nan() { f64::INFINITY } else { bound };
        (bound.floor() as usize).min(2 * last)
    }
}

/// The debris of the whole contact.
pub fn debris(state: &ContactState, plan: &Plan) -> DebrisRecord {
    let outflow = state.debris_outflow;
    state.debris.as_ref().map_or_else(DebrisRecord::default, |thickness| DebrisRecord {
        volume: thickness.iter().sum::<f64>() * plan.area_of_cell(),
        outflow,
        max_thickness: thickness.iter().copied().fold(0.0, f64::max),
    })
}

/// Volume worn off the whole contact [length^3], and the largest depth [length]; of bodies that move against each other the larger one of
/// their own.
pub fn worn(state: &ContactState, plan: &Plan) -> [f64; 2] {
    let of = |depth: &Array2<f64>| {
        let volume = depth.iter().sum::<f64>() * plan.area_of_cell();
        [volume, depth.iter().copied().fold(0.0, f64::max)]
    };
    let lower = state.worn_depth.as_ref().map_or([0.0; 2], of);
    let Some(upper) = state.upper_worn_depth.as_ref().map(of) else { return lower };
    [lower[0] + upper[0], lower[1].max(upper[1])]
}
