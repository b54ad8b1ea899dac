//! The ways to compute a product, and the choice among them.

use std::fmt;

use super::block::Terms;
use super::lanes::{InstructionSet, LaneProduct};
use super::lengths::is_good_length;
use super::line_product::LineProduct;
use super::mirrors::{in_front, unfolded};
use super::{Kernel, Mirrors, SingleProduct, Workspace};

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
    Lanes(LaneProduct<f64>),
    Lines(LineProduct),
    /// Line by line on the whole grid, whatever its mirrors.
    Unfolded(LineProduct, Terms),
}

/// The terms of the whole grid.
fn whole(terms: &Terms) -> Terms {
    Terms { shape: terms.mirrors.whole(terms.shape), mirrors: Mirrors::NONE, ..terms.clone() }
}

impl PlannedProduct {
    fn lines(terms: &Terms, product: impl Fn(Terms) -> LineProduct) -> Self {
        if terms.mirrors.any() {
            Self::Unfolded(product(whole(terms)), terms.clone())
        } else {
            Self::Lines(product(terms.clone()))
        }
    }

    /// Free-space product; with more fields than the lane engine takes, line by line. So is a single line along x, which the lane
    /// engine would pad to eight.
    pub fn free_space(engine: Engine, terms: &Terms, kernels: &[Kernel<'_>]) -> Self {
        let single_line = terms.shape[1] == 1 && !terms.mirrors.any();
        match engine.0 {
            Choice::Lanes(set) if LaneProduct::takes(terms) && !single_line => {
                Self::Lanes(LaneProduct::free_space(set, terms, kernels))
            }
            _ => Self::lines(terms, |terms| LineProduct::free_space(terms, kernels)),
        }
    }

    /// Periodic product; where the lane engine does not do a length or that many fields, line by line.
    pub fn periodic(engine: Engine, terms: &Terms, symbols: &[Kernel<'_>]) -> Self {
        let good = terms.shape.iter().all(|&n| n > 4 && is_good_length(n));
        match engine.0 {
            Choice::Lanes(set) if good && LaneProduct::takes(terms) => {
                Self::Lanes(LaneProduct::periodic(set, terms, symbols))
            }
            _ => Self::lines(terms, |terms| LineProduct::periodic(terms, symbols)),
        }
    }

    /// Work space for as many threads as the current pool has.
    pub fn workspace(&self) -> Workspace {
        let mut workspace = Workspace::default();
        match self {
            Self::Lanes(product) => {
                workspace.lanes(product.work_len(rayon::current_num_threads()));
            }
            Self::Lines(product) | Self::Unfolded(product, _) => {
                workspace.lines(product.scratch_len());
            }
        }
        workspace
    }

    pub fn apply(&self, workspace: &mut Workspace, input: &[&[f64]], output: &mut [&mut [f64]]) {
        match self {
            Self::Lanes(product) => {
                let count = product.work_len(rayon::current_num_threads());
                product.apply(workspace.lanes(count), input, output);
            }
            Self::Lines(product) => product.apply(workspace.lines(product.scratch_len()), input, output),
            Self::Unfolded(product, terms) => unfolded_product(product, terms, workspace, input, output),
        }
    }

    /// This product, of `terms`, in single precision; `None` where it goes line by line.
    pub fn in_single_precision(&self, terms: &Terms) -> Option<SingleProduct> {
        match self {
            Self::Lanes(product) => Some(SingleProduct::new(product.in_single_precision(terms))),
            Self::Lines(_) | Self::Unfolded(..) => None,
        }
    }

    pub fn memory_bytes(&self) -> usize {
        match self {
            Self::Lanes(product) => product.memory_bytes(),
            Self::Lines(product) | Self::Unfolded(product, _) => product.memory_bytes(),
        }
    }
}

/// The product of what lies in front of mirrors by that of the whole grid.
fn unfolded_product(
    product: &LineProduct,
    terms: &Terms,
    workspace: &mut Workspace,
    input: &[&[f64]],
    output: &mut [&mut [f64]],
) {
    let [nx, ny] = terms.mirrors.whole(terms.shape);
    let wide = |count: usize| vec![vec![0.0; nx * ny]; count];
    let (mut inputs, mut outputs) = (wide(input.len()), wide(output.len()));
    for (index, (part, field)) in input.iter().zip(&mut inputs).enumerate() {
        unfolded(terms, part, terms.mirrors.input_is_odd(index), field);
    }
    let fields: Vec<&[f64]> = inputs.iter().map(Vec::as_slice).collect();
    let mut results: Vec<&mut [f64]> = outputs.iter_mut().map(Vec::as_mut_slice).collect();
    product.apply(workspace.lines(product.scratch_len()), &fields, &mut results);
    for (part, field) in output.iter_mut().zip(&outputs) {
        in_front(terms, field, part);
    }
}
