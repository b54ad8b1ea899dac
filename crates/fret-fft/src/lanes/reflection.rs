//! What mirrors change in a product: which frequencies the numbers of a place belong to, and where kernels take them.

use super::super::terms::Terms;
use super::mirrored_columns::Sides;
use super::mirrored_kernels::{MirroredTerm, SlotTerm};
use super::paired_rows::Places;
use super::rows::Side;
use super::simd::Number;

/// What a product on the part of a grid in front of its mirrors needs beside the passes.
pub struct Reflection<N> {
    /// Per output.
    pub terms: Vec<Vec<MirroredTerm<N>>>,
    /// How the fields lie to a mirror across the rows.
    pub rows: Sides,
    /// How they lie to one across the columns.
    pub columns: Sides,
    /// Places of the frequencies `0..=n/2` along `x`, where the scene repeats.
    pub places: Vec<Places>,
}

/// Tables of each kernel: its values at the frequencies of the first number of a pair and, along a mirrored axis, at those of
/// the second.
pub fn tables([x, y]: [bool; 2]) -> usize {
    (1 + usize::from(x)) * (1 + usize::from(y))
}

/// A table of a kernel: whether it holds the second frequencies along `[x, y]`.
pub fn second_of_table(mirrored: [bool; 2], table: usize) -> [bool; 2] {
    let along_x = 1 + usize::from(mirrored[0]);
    [table % along_x == 1, table / along_x == 1]
}

/// The table of a kernel that holds the second frequencies along `[x, y]` or not.
pub fn table_of_second(mirrored: [bool; 2], second: [bool; 2]) -> usize {
    usize::from(second[1]) * (1 + usize::from(mirrored[0])) + usize::from(second[0])
}

/// What one number of a pair becomes: taken from which, with which sign, at the second frequency or not.
type FromPair = (usize, f64, bool);

/// How a kernel acts on the pair of numbers of one axis.
///
/// Without a mirror the pair is real and minus imaginary part at one frequency, and an odd kernel stands for `-i` times its
/// sines. With one, the pair of an even line are its cosines at the first and at the second frequency, that of an odd line its
/// sines at the second and at the first; an odd kernel makes sines of cosines, and minus cosines of sines.
fn on_pair(mirrored: bool, odd_field: bool, odd_kernel: bool) -> [FromPair; 2] {
    match (mirrored, odd_field, odd_kernel) {
        (false, _, false) => [(0, 1.0, false), (1, 1.0, false)],
        (false, _, true) => [(1, -1.0, false), (0, 1.0, false)],
        (true, false, false) => [(0, 1.0, false), (1, 1.0, true)],
        (true, true, false) => [(0, 1.0, true), (1, 1.0, false)],
        (true, false, true) => [(1, 1.0, true), (0, 1.0, false)],
        (true, true, true) => [(1, -1.0, false), (0, -1.0, true)],
    }
}

impl<N: Number> Reflection<N> {
    /// Of the terms of a product with mirrors.
    pub fn new(terms: &Terms, places: Vec<Places>) -> Self {
        let axes = terms.mirrors.axes;
        let sides = |axis: usize| {
            let side = |odd: [bool; 2]| match (axes[axis], odd[axis]) {
                (false, _) => Side::Plain,
                (true, false) => Side::Even,
                (true, true) => Side::Odd,
            };
            let output = |index: usize| terms.outputs_odd.get(index).copied().unwrap_or_default();
            Sides {
                inputs: [0, 1, 2].map(|index| side(terms.mirrors.input_is_odd(index))),
                outputs: [0, 1, 2].map(|index| side(output(index))),
            }
        };
        let of_output = |output: usize| {
            let blocks = terms.blocks.iter().filter(move |block| block.output == output);
            let list = blocks.map(|block| {
                let field = terms.mirrors.input_is_odd(block.input);
                let kernel = terms.parities[block.kernel].odd();
                let [along_x, along_y] = [0, 1].map(|axis| on_pair(axes[axis], field[axis], kernel[axis]));
                let slots = [0, 1, 2, 3].map(|slot| {
                    let (from_x, sign_x, second_x) = along_x[slot % 2];
                    let (from_y, sign_y, second_y) = along_y[slot / 2];
                    let within = table_of_second(axes, [second_x, second_y]);
                    SlotTerm {
                        source: 2 * from_y + from_x,
                        table: block.kernel * tables(axes) + within,
                        factor: N::of(block.sign * sign_x * sign_y),
                    }
                });
                MirroredTerm { input: block.input, slots }
            });
            list.collect()
        };
        Self { terms: (0..terms.outputs).map(of_output).collect(), rows: sides(1), columns: sides(0), places }
    }
}
