//! What slip does to the surfaces in the course of a run: it wears them, and changes their friction. Both are collected over a cycle and
//! take effect when it is over.

use super::evolving::{Evolved, Evolving};
use super::wear::{TooFast, Wearing};
use crate::model::{ContactState, CoulombFriction, Integration};

/// Surfaces that may change by slip.
#[derive(Debug, Clone, Default)]
pub struct Surfaces {
    /// Their wear, where they wear.
    pub wearing: Option<Wearing>,
    /// Their friction, where it evolves.
    pub evolving: Option<Evolving>,
    /// How slip is integrated.
    pub integration: Integration,
}

/// A block of equal cycles that is over.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Block {
    /// How many.
    pub cycles: usize,
    /// Whether the gap has opened.
    pub opened: bool,
    /// The deepest cell, when it has reached the limit of wear.
    pub through: Option<[usize; 2]>,
    /// The first cell through whose coating these cycles wear, and after how many of them.
    pub coating_through: Option<([usize; 2], usize)>,
    /// What became of friction.
    pub evolved: Option<Evolved>,
    /// Relative error of the wear depth by the cycle jump before, where it is looked at.
    pub wear_jump_error: Option<f64>,
}

impl Surfaces {
    /// Adds the slip between two states that follow each other.
    pub fn add(&mut self, before: &ContactState, after: &ContactState) {
        if let Some(wearing) = &mut self.wearing {
            wearing.add([before, after], self.integration);
        }
        if let Some(evolving) = &mut self.evolving {
            evolving.add([before, after], self.integration);
        }
    }

    /// A stage begins.
    pub fn begin_stage(&mut self) {
        if let Some(evolving) = &mut self.evolving {
            evolving.begin_stage();
        }
        if let Some(wearing) = &mut self.wearing {
            wearing.begin_stage();
        }
    }

    /// The friction law that the case has for the stage at work, unless friction evolves: that by which the surfaces wear.
    pub fn take_friction(&mut self, friction: &CoulombFriction) {
        if let Some(wearing) = &mut self.wearing {
            wearing.set_friction(self.evolving.as_ref().map_or(friction, Evolving::friction));
        }
    }

    /// Changes a state by what was collected, as often as that may stand for cycles: `most` times at the most, once where it is that of
    /// a stage without cycles.
    ///
    /// # Errors
    /// When a single cycle wears more off a cell than its own compliance can follow.
    pub fn end_block(
        &mut self,
        state: &mut ContactState,
        (most, of_cycle): (usize, bool),
    ) -> Result<Block, TooFast> {
        let Self { wearing, evolving, .. } = self;
        let mut most = most;
        if wearing.is_none() && evolving.is_none() {
            most = 1;
        }
        if let (Some(evolving), Some(slipped)) = (evolving.as_mut(), &state.accumulated) {
            if of_cycle {
                evolving.end_cycle();
            }
            most = evolving.cycles(slipped, most);
        }
        let mut block = Block {
            cycles: most,
            opened: false,
            through: None,
            coating_through: None,
            evolved: None,
            wear_jump_error: None,
        };
        if let Some(wearing) = wearing {
            let worn = wearing.block(state, most)?;
            (block.cycles, block.through, block.coating_through) =
                (worn.cycles, worn.through, worn.coating_through);
            block.wear_jump_error = worn.jump_error;
            if let Some(depth) = &mut state.worn_depth
                && worn.depth.iter().any(|depth| *depth > 0.0)
            {
                *depth += &worn.depth;
                block.opened = true;
            }
        }
        if let (Some(evolving), Some(slipped)) = (evolving, &mut state.accumulated) {
            block.evolved = Some(evolving.advance(slipped, block.cycles));
            if let Some(wearing) = wearing {
                wearing.set_friction(evolving.friction());
            }
        }
        Ok(block)
    }
}
