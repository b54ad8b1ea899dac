//! The ways to compute a product, and the choice among them.

use std::fmt;

use super::block::Terms;
use super::lanes::{InstructionSet, LaneProduct};
use super::lengths::is_good_length;
use super::line_product::LineProduct;
use super::{Kernel, Workspace};

/// A way to compute products on this machine. All give the same numbers up to rounding.
///
/// Only tests and measurements need to choose; everybody else gets the fastest.
#[derive(Clone, Copy)]
pub struct Engine(Choice);

#[derive(Clone, Copy)]
enum Choice {
    Lanes(InstructionSet),
    Lines,
}

impl fmt::Debug for Engine {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self.0 {
            Choice::Lanes(set) => set.name(),
            Choice::Lines => "lines by rustfft",
        })
    }
}

impl Engine {
    /// All engines of this machine, fastest first: the lane engine on each instruction set present, then lines
    /// transformed one by one with rustfft.
    pub fn available() -> Vec<Self> {
        let lanes = InstructionSet::available().into_iter().map(Choice::Lanes);
        lanes.chain([Choice::Lines]).map(Self).collect()
    }

    /// What this machine does best.
    pub(super) fn fastest() -> Self {
        Self(InstructionSet::available().into_iter().next().map_or(Choice::Lines, Choice::Lanes))
    }
}

/// A product planned on one engine.
pub(super) enum PlannedProduct {
    Lanes(LaneProduct),
    Lines(LineProduct),
}

impl PlannedProduct {
    /// Free-space product; with more fields than the lane engine takes, line by line.
    pub fn free_space(engine: Engine, terms: &Terms, kernels: &[Kernel<'_>]) -> Self {
        match engine.0 {
            Choice::Lanes(set) if LaneProduct::takes(terms) => {
                Self::Lanes(LaneProduct::free_space(set, terms, kernels))
            }
            _ => Self::Lines(LineProduct::free_space(terms.clone(), kernels)),
        }
    }

    /// Periodic product; where the lane engine does not do a length or that many fields, line by line.
    pub fn periodic(engine: Engine, terms: &Terms, symbols: &[Kernel<'_>]) -> Self {
        let good = terms.shape.iter().all(|&n| n > 4 && is_good_length(n));
        match engine.0 {
            Choice::Lanes(set) if good && LaneProduct::takes(terms) => {
                Self::Lanes(LaneProduct::periodic(set, terms, symbols))
            }
            _ => Self::Lines(LineProduct::periodic(terms.clone(), symbols)),
        }
    }

    /// Work space for as many threads as the current pool has.
    pub fn workspace(&self) -> Workspace {
        let mut workspace = Workspace::default();
        match self {
            Self::Lanes(product) => {
                workspace.lanes(product.work_len(rayon::current_num_threads()));
            }
            Self::Lines(product) => {
                workspace.lines(product.scratch_len());
            }
        }
        workspace
    }

    pub fn apply(&self, workspace: &mut Workspace, input: &[&[f64]], output: &mut [&mut [f64]]) {
        match self {
            Self::Lanes(product) => product.apply(workspace.lanes(product.work_len(1)), input, output),
            Self::Lines(product) => product.apply(workspace.lines(product.scratch_len()), input, output),
        }
    }

    pub fn memory_bytes(&self) -> usize {
        match self {
            Self::Lanes(product) => product.memory_bytes(),
            Self::Lines(product) => product.memory_bytes(),
        }
    }
}
