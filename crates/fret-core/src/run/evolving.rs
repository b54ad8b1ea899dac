//! Friction that evolves in the course of a run: what slip does in a cycle, the number of cycles that may stand for, and the error of that.

use serde::{Deserialize, Serialize};

use super::slip_increment::SlipIncrement;
use super::upper_frame::UpperFrame;
use crate::model::{AccumulatedSlip, CoulombFriction, FrictionEvolution};
use crate::solver::SolveError;

/// What a run knows of the cycle at work and of the cycle jump before it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CollectedSlip {
    /// What slip has done since the coefficient changed last.
    of_cycle: AccumulatedSlip,
    /// The last cycle jump, where it was one: its number of cycles, and what slip did in the one that was computed.
    jump: Option<(usize, AccumulatedSlip)>,
}

impl CollectedSlip {
    /// Nothing slipped yet.
    pub fn nothing(cells: [usize; 2]) -> Self {
        Self { of_cycle: AccumulatedSlip::none(cells), jump: None }
    }

    /// What slip has done since the coefficient changed last.
    pub fn of_cycle(&self) -> &AccumulatedSlip {
        &self.of_cycle
    }

    /// Whether this was collected on a grid of `cells`.
    pub fn fits(&self, cells: [usize; 2]) -> bool {
        let all = std::iter::once(&self.of_cycle).chain(self.jump.iter().map(|(_, slip)| slip));
        all.flat_map(AccumulatedSlip::fields).all(|field| field.dim() == cells.into())
    }
}

/// What became of friction over a block of equal cycles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Evolved {
    /// Largest change of the coefficient of a cell [-].
    pub change: f64,
    /// Error of the coefficient of a cell by the cycle jump before, the largest [-].
    pub jump_error: f64,
}

/// Friction that follows what slip does to the surfaces.
#[derive(Debug, Clone)]
pub struct Evolving {
    rule: FrictionEvolution,
    /// The law that the history started with.
    first: CoulombFriction,
    /// The law in force: that of what is accumulated in the state.
    now: CoulombFriction,
    collected: CollectedSlip,
    /// How the upper body moves, where the law and all that it follows are of its cells.
    frame: Option<UpperFrame>,
}

impl Evolving {
    /// Goes on from what was collected, on surfaces that have slipped before.
    pub fn new(
        rule: FrictionEvolution,
        first: CoulombFriction,
        slipped: &AccumulatedSlip,
        collected: CollectedSlip,
    ) -> Self {
        let now = rule.friction(&first, slipped);
        Self { rule, first, now, collected, frame: None }
    }

    /// The same on the cells of an upper body that moves over the grid, where it does.
    #[must_use]
    pub fn in_frame(self, frame: Option<UpperFrame>) -> Self {
        Self { frame, ..self }
    }

    /// The law in force, over the grid where the body that it belongs to lies without a shift.
    pub fn friction(&self) -> &CoulombFriction {
        &self.now
    }

    /// What was collected since the coefficient changed last.
    pub fn collected(&self) -> &CollectedSlip {
        &self.collected
    }

    /// Adds what slips in an increment.
    ///
    /// # Errors
    /// When the slip of an upper body leaves the grid, on which that lay without a shift.
    pub fn add(&mut self, increment: SlipIncrement<'_>) -> Result<(), SolveError> {
        let Some(frame) = self.frame else {
            increment.add_slip(&mut self.collected.of_cycle);
            return Ok(());
        };
        for (part, state) in increment.slip_by_ends().iter().zip(increment.states) {
            for (over_grid, to) in part.fields().into_iter().zip(self.collected.of_cycle.fields_mut()) {
                frame.collect(over_grid, state, to)?;
            }
        }
        Ok(())
    }

    /// Another stage: its cycles tell nothing of the jumps before.
    pub fn begin_stage(&mut self) {
        self.collected.jump = None;
    }

    /// The collected slip is that of a whole cycle.
    pub fn end_cycle(&mut self) {
        self.collected.of_cycle.cycles = 1;
    }

    /// Cycles that the one collected may stand for, so that no cell changes its coefficient by more than the tolerance; 1 at the least,
    /// `most` at the most.
    pub fn cycles(&self, slipped: &AccumulatedSlip, most: usize) -> usize {
        let most = most.min(self.rule.every);
        let (since, each) = (self.rule.driver(slipped), self.rule.driver(&self.collected.of_cycle));
        let mut fewest = f64::INFINITY;
        for ((i, j), _) in slipped.distance.indexed_iter() {
            let each = each.at(i, j);
            if each > 0.0 {
                let reach = self.rule.law.reach(self.first.at(i, j), since.at(i, j), self.rule.tolerance);
                fewest = fewest.min(reach / each);
            }
        }
        // The last of some equal steps is not lost to rounding.
        ((fewest * (1.0 + 1e-12)).floor().min(most as f64) as usize).max(1)
    }

    /// Changes the coefficient by the collected slip, so many times; collecting starts anew.
    pub fn advance(&mut self, slipped: &mut AccumulatedSlip, cycles: usize) -> Evolved {
        let jump_error = self.jump_error(slipped);
        slipped.add_times(&self.collected.of_cycle, cycles);
        let next = self.rule.friction(&self.first, slipped);
        let cells = slipped.distance.indexed_iter().map(|((i, j), _)| (i, j));
        let change = cells.map(|(i, j)| (next.at(i, j) - self.now.at(i, j)).abs()).fold(0.0, f64::max);
        self.now = next;
        self.collected.jump = (cycles > 1).then(|| (cycles, self.collected.of_cycle.clone()));
        self.collected.of_cycle.clear();
        Evolved { change, jump_error }
    }

    /// Error of the coefficient by the last cycle jump. It took the slip of its `n` cycles for that of the first; had it changed evenly
    /// to what it is in the cycle after them, all would have had `(n - 1) / 2` times the change more.
    fn jump_error(&self, slipped: &AccumulatedSlip) -> f64 {
        let Some((cycles, before)) = &self.collected.jump else { return 0.0 };
        let more = 0.5 * (*cycles as f64 - 1.0);
        let since = self.rule.driver(slipped);
        let [before, after] = [before, &self.collected.of_cycle].map(|slip| self.rule.driver(slip));
        let mut worst = 0.0_f64;
        for ((i, j), _) in slipped.distance.indexed_iter() {
            let change = after.at(i, j) - before.at(i, j);
            if change != 0.0 {
                let driver = (since.at(i, j) + more * change).max(0.0);
                let better = self.rule.law.at(self.first.at(i, j), driver);
                worst = worst.max((better - self.now.at(i, j)).abs());
            }
        }
        worst
    }
}
