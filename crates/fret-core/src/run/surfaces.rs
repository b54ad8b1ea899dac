//! What slip does to the surfaces in the course of a run: it wears them, and changes their friction. Both are collected over a cycle and
//! take effect when it is over.

use ndarray::Array2;

use super::debris::{CollectedDebris, Debris, OneCycle};
use super::evolving::{CollectedSlip, Evolved, Evolving};
use super::slip_increment::SlipIncrement;
use super::upper_frame::UpperFrame;
use super::wear::{self, Collected, TooFast, Wearing};
use crate::model::{CellValues, ContactState, CoulombFriction, Integration};
use crate::solver::SolveError;

/// Surfaces that may change by slip.
#[derive(Debug, Clone, Default)]
pub struct Surfaces {
    /// Their wear, where they wear; that of the lower body alone, where they move against each other.
    pub wearing: Option<Wearing>,
    /// Wear of the upper body in its own frame, where they move against each other; and how it moves.
    pub upper: Option<(Wearing, UpperFrame)>,
    /// Whether a friction map is the upper body's, and moves with it.
    pub friction_of_upper: bool,
    /// What becomes of worn material, where some of it stays between them.
    pub debris: Option<Debris>,
    /// Their friction, where it evolves.
    pub evolving: Option<Evolving>,
    /// How slip is integrated.
    pub integration: Integration,
}

/// What slip has done since the surfaces changed last.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Underway<'a> {
    /// Wear of both bodies together, or of the lower and the upper one.
    pub wear: [Option<&'a Collected>; 2],
    /// What becomes debris.
    pub debris: Option<&'a CollectedDebris>,
    /// What friction follows.
    pub slip: Option<&'a CollectedSlip>,
}

impl Underway<'_> {
    /// Whether the gap is that of the surfaces as they are told. What an unfinished cycle has worn opens it, and the solver remembers another one;
    /// so it does of thinner layers, whose thickness another history finds for itself.
    pub fn leaves_the_gap(&self) -> bool {
        let slips = |wear: &Collected| self.debris.is_some() && wear.path().iter().any(|path| *path != 0.0);
        let [wear, upper] = self.wear;
        wear.is_none_or(|wear| wear.is_empty() && wear.thinned() == [0.0; 2] && !slips(wear))
            && upper.is_none_or(Collected::is_empty)
    }
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

impl Block {
    /// Takes the wear of a body off its depth.
    fn take(&mut self, worn: &wear::Block, depth: &mut Option<Array2<f64>>) {
        self.through = self.through.or(worn.through);
        self.coating_through = match (self.coating_through, worn.coating_through) {
            (Some(one), Some(other)) if other.1 < one.1 => Some(other),
            (one, other) => one.or(other),
        };
        self.wear_jump_error = match (self.wear_jump_error, worn.jump_error) {
            (Some(one), Some(other)) => Some(one.max(other)),
            (one, other) => one.or(other),
        };
        if let Some(depth) = depth
            && worn.depth.iter().any(|depth| *depth > 0.0)
        {
            *depth += &worn.depth;
            self.opened = true;
        }
    }
}

impl Surfaces {
    /// Adds what slips in an increment.
    ///
    /// # Errors
    /// When wear or slip of the upper body leaves the grid.
    pub fn add(&mut self, increment: SlipIncrement<'_>) -> Result<(), SolveError> {
        if let Some((upper, frame)) = &mut self.upper {
            let worn = upper.add_in_frame(increment, *frame)?;
            if let Some(debris) = &mut self.debris {
                debris.add_above(worn.each_ref());
            }
        }
        if let Some(wearing) = &mut self.wearing {
            wearing.add(increment);
        }
        if let Some(evolving) = &mut self.evolving {
            evolving.add(increment)?;
        }
        Ok(())
    }

    /// A stage begins.
    pub fn begin_stage(&mut self) {
        if let Some(evolving) = &mut self.evolving {
            evolving.begin_stage();
        }
        self.debris.iter_mut().for_each(Debris::begin_stage);
        self.each_wearing().for_each(Wearing::begin_stage);
    }

    /// The friction law of the stage at work, over the grid where the body that it belongs to lies without a shift: it bounds what a cycle may
    /// wear. Of bodies that move, what cells of the one pass under maps of the other is at most their largest coefficient.
    pub fn take_friction(&mut self, friction: &CoulombFriction) {
        let Self { wearing, upper, friction_of_upper, .. } = self;
        bound_wear((wearing.as_mut(), upper.as_mut().map(|(upper, _)| upper)), friction, *friction_of_upper);
    }

    /// What slip has done since the surfaces changed last.
    pub(crate) fn underway(&self) -> Underway<'_> {
        let upper = self.upper.as_ref().map(|(upper, _)| upper);
        Underway {
            wear: [self.wearing.as_ref(), upper].map(|wearing| wearing.map(Wearing::collected)),
            debris: self.debris.as_ref().map(Debris::collected),
            slip: self.evolving.as_ref().map(Evolving::collected),
        }
    }

    /// The wear of both bodies together, or of each.
    pub fn each_wearing(&mut self) -> impl Iterator<Item = &mut Wearing> {
        self.wearing.iter_mut().chain(self.upper.as_mut().map(|(upper, _)| upper))
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
        let Self { wearing, upper, debris, evolving, friction_of_upper, .. } = self;
        let mut upper = upper.as_mut().map(|(upper, _)| upper);
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
        let softening = wearing.iter().chain(upper.as_deref()).map(Wearing::softening).sum();
        let before = (state.approach, softening);
        if let Some(wearing) = wearing {
            block.cycles = wearing.cycles(state.worn_depth.as_ref(), before, block.cycles)?;
        }
        if let Some(upper) = &upper {
            block.cycles = upper.cycles(state.upper_worn_depth.as_ref(), before, block.cycles)?;
        }
        let depths = [&state.worn_depth, &state.upper_worn_depth];
        let of_one = debris.as_ref().zip(wearing.as_ref()).map(|(_, wearing)| {
            let both = [Some(wearing.collected()), upper.as_deref().map(Wearing::collected)];
            OneCycle::of(both, depths.map(Option::as_ref))
        });
        if let (Some(debris), Some(of_one), Some(thickness)) = (&debris, &of_one, &state.debris) {
            block.cycles = debris.cycles(of_one, thickness, (state.approach, block.cycles));
        }
        let mut worn = [None, None];
        let bodies =
            [(wearing.as_mut(), &mut state.worn_depth), (upper.as_deref_mut(), &mut state.upper_worn_depth)];
        for ((wearing, depth), worn) in bodies.into_iter().zip(&mut worn) {
            if let Some(wearing) = wearing {
                let of_block = wearing.block(depth.as_ref(), block.cycles);
                block.take(&of_block, depth);
                *worn = Some(of_block.depth);
            }
        }
        if let (Some(debris), Some(of_one), Some(thickness)) = (debris, &of_one, &mut state.debris) {
            let before = thickness.clone();
            let worn = worn.each_ref().map(Option::as_ref);
            let (gone, error) = debris.block(thickness, (of_one, block.cycles), worn);
            state.debris_outflow += gone;
            block.opened |= *thickness != before;
            block.wear_jump_error = block.wear_jump_error.zip(error).map(|(one, other)| one.max(other));
        }
        if let (Some(evolving), Some(slipped)) = (evolving, &mut state.accumulated) {
            block.evolved = Some(evolving.advance(slipped, block.cycles));
            bound_wear((wearing.as_mut(), upper), evolving.friction(), *friction_of_upper);
        }
        Ok(block)
    }
}

/// Bounds the wear of the lower and the upper body by a friction law over the grid where the body that it belongs to lies without a shift.
fn bound_wear(
    (lower, upper): (Option<&mut Wearing>, Option<&mut Wearing>),
    friction: &CoulombFriction,
    of_upper: bool,
) {
    let moves = upper.is_some() && friction.is_map();
    let largest = || friction.with_coefficient(CellValues::Uniform(friction.largest()));
    for (wearing, is_own) in [(lower, !of_upper), (upper, of_upper)] {
        let Some(wearing) = wearing else { continue };
        if moves && !is_own { wearing.set_friction(&largest()) } else { wearing.set_friction(friction) }
    }
}
