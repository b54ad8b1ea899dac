//! The ways to compute a product, and the choice among them.

use std::fmt;

use super::lanes::{AlignedNumbers, InstructionSet, LaneProduct};
use super::lengths::is_good_length;
use super::line_product::LineProduct;
use super::mirrors::{in_front, unfolded};
use super::terms::Terms;
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

    /// Cross spectra of no fields; `None` where there are none: line by line, and where the scene repeats.
    pub fn cross_spectra(&self) -> Option<AlignedNumbers<f64>> {
        if let Self::Lanes(product) = self { product.cross_spectra() } else { None }
    }

    /// Adds the cross spectra of `input` with `output`.
    pub fn add_cross_spectra(
        &self,
        workspace: &mut Workspace,
        fields: (&[&[f64]], &[&[f64]]),
        sums: &mut AlignedNumbers<f64>,
    ) {
        if let Self::Lanes(product) = self {
            let count = product.cross_len(rayon::current_num_threads());
            product.add_cross_spectra(workspace.lanes(count), fields, sums);
        }
    }

    /// The scalar product of cross spectra with the kernels.
    pub fn contracted(&self, sums: &AlignedNumbers<f64>) -> f64 {
        if let Self::Lanes(product) = self { product.contracted(sums) } else { 0.0 }
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
        unfolded(&terms.mirrors, terms.shape, (part, terms.mirrors.input_is_odd(index)), field);
    }
    let fields: Vec<&[f64]> = inputs.iter().map(Vec::as_slice).collect();
    let mut results: Vec<&mut [f64]> = outputs.iter_mut().map(Vec::as_mut_slice).collect();
    product.apply(workspace.lines(product.scratch_len()), &fields, &mut results);
    for (part, field) in output.iter_mut().zip(&outputs) {
        in_front(&terms.mirrors, terms.shape, field, part);
    }
}

#[cfg(test)]
mod tests {
    use ndarray::Array2;

    use super::super::tests::block;
    use super::*;
    use crate::{Block, Convolution, Parity, PeriodicProduct};

    /// Which way a product goes.
    fn way(product: &PlannedProduct) -> &'static str {
        match product {
            PlannedProduct::Lanes(_) => "lanes",
            PlannedProduct::Lines(_) => "lines",
            PlannedProduct::Unfolded(..) => "unfolded",
        }
    }

    /// The ways of a product in free space and of one that repeats, on the fastest engine and line by line.
    fn ways(shape: [usize; 2], axes: [bool; 2], blocks: &[Block]) -> [[&'static str; 2]; 2] {
        let mirrors = Mirrors { axes, inputs: Vec::new() };
        let whole = mirrors.whole(shape);
        let values = Array2::ones(whole);
        let kernels = [Kernel { values: values.view(), parity: Parity::EvenEven }];
        [Engine::fastest(), Engine(Choice::Lines)].map(|engine| {
            let terms = |quadrant| Terms::new(shape, quadrant, &kernels, blocks, mirrors.clone()).unwrap();
            [
                way(&PlannedProduct::free_space(engine, &terms(whole), &kernels)),
                way(&PlannedProduct::periodic(engine, &terms(whole.map(|n| n / 2 + 1)), &kernels)),
            ]
        })
    }

    #[test]
    fn the_lane_engine_takes_what_it_is_made_for() {
        let one = [block(0, 0, 0, 1.0)];
        let none = [false, false];
        for (shape, expected) in [
            ([8, 12], ["lanes", "lanes"]),
            ([7, 12], ["lanes", "lines"]), // 7 is no length for it, in free space it is filled up
            ([8, 10], ["lanes", "lines"]),
            ([4, 8], ["lanes", "lines"]), // one pass only
            ([1, 8], ["lanes", "lines"]),
            ([8, 1], ["lines", "lines"]),
        ] {
            assert_eq!(ways(shape, none, &one), [expected, ["lines", "lines"]], "{shape:?}");
        }
        // In front of a mirror the lanes take a single line, too.
        assert_eq!(ways([8, 1], [true, false], &one), [["lanes", "unfolded"], ["unfolded"; 2]]);
        assert_eq!(ways([8, 12], [false, true], &one), [["lanes"; 2], ["unfolded"; 2]]);
    }

    #[test]
    fn more_than_three_fields_go_line_by_line() {
        for (blocks, expected) in [
            ([block(2, 0, 0, 1.0), block(0, 2, 0, 1.0)], "lanes"),
            ([block(3, 0, 0, 1.0), block(0, 2, 0, 1.0)], "lines"),
            ([block(2, 0, 0, 1.0), block(0, 3, 0, 1.0)], "lines"),
        ] {
            assert_eq!(ways([8, 12], [false, false], &blocks)[0], [expected; 2], "{blocks:?}");
        }
        let four = [block(0, 3, 0, 1.0)];
        assert_eq!(ways([8, 12], [true, false], &four)[0], ["unfolded"; 2]);
    }

    #[test]
    fn engines_have_names_and_the_fastest_is_the_first() {
        let names: Vec<String> = Engine::available().iter().map(|engine| format!("{engine:?}")).collect();
        assert_eq!(names[names.len() - 2..], ["portable lanes", "lines by rustfft"]);
        assert_eq!(format!("{:?}", Engine::fastest()), names[0]);
        let before: Vec<&str> = names[..names.len() - 2].iter().map(String::as_str).collect();
        let possible: &[&[&str]] = if cfg!(target_arch = "x86_64") {
            &[&["AVX-512 lanes", "AVX2 lanes"], &["AVX2 lanes"], &[]]
        } else if cfg!(target_arch = "aarch64") {
            &[&["NEON lanes"]]
        } else {
            &[&[]]
        };
        assert!(possible.contains(&before.as_slice()), "{names:?}");
    }

    /// A transform as large as the grid, one number for a frequency; a lane engine starts it on a cache line and fills up vectors.
    #[test]
    fn kernels_take_the_memory_of_their_frequencies() {
        const CACHE_LINE: usize = 64;
        let shape = [64, 48];
        let values = Array2::<f64>::ones(shape);
        let kernel = Kernel { values: values.view(), parity: Parity::EvenEven };
        let symbol = crate::Symbol { values: values.view(), parity: Parity::EvenEven };
        for engine in Engine::available() {
            let (width, spare) = match engine.0 {
                Choice::Lanes(set) => (set.width::<f64>(), CACHE_LINE),
                Choice::Lines => (1, 0),
            };
            for count in [1, 2] {
                let blocks: Vec<Block> = (0..count).map(|kernel| block(0, 0, kernel, 1.0)).collect();
                let memory_of = |shape, axes| {
                    let mirrors = Mirrors { axes, inputs: Vec::new() };
                    Convolution::on(engine, shape, &vec![kernel; count], &blocks, mirrors).unwrap()
                };
                let is = |found: usize, numbers: usize| {
                    assert!((8 * numbers..=8 * numbers + spare).contains(&found), "{engine:?} {found}");
                };
                let free_space = memory_of(shape, [false, false]);
                is(free_space.memory_bytes(), count * 64 * 48);
                assert_eq!(free_space.shape(), shape);
                // In front of a mirror two tables for half of the frequencies.
                is(memory_of([32, 48], [true, false]).memory_bytes(), count * 64 * 48);
                let repeating =
                    PeriodicProduct::on(engine, shape, &vec![symbol; count], &blocks, Mirrors::NONE).unwrap();
                let columns = if width == 1 { 48 } else { 25_usize.next_multiple_of(width) };
                is(repeating.memory_bytes(), count * 64 * columns);
                assert_eq!(repeating.shape(), shape);
                assert_eq!(repeating.in_single_precision().is_some(), width > 1);
                match (free_space.in_single_precision(), width) {
                    (None, 1) => {}
                    (Some(single), 2..) => {
                        let numbers = count * 64 * 48;
                        assert!((4 * numbers..=4 * numbers + spare).contains(&single.memory_bytes()));
                    }
                    _ => panic!("{engine:?}: single precision where there are lanes, and only there"),
                }
            }
        }
    }
}
