//! Mirrors of a grid: of fields that go on behind a plane as they are, or with the other sign, a half or a quarter suffices.

use super::{Block, ConvolutionError, Kernel, Parity};

/// Mirror planes before the first row, the first column or both of a grid, and what the fields do behind them.
///
/// A field of `nx x ny` cells with a mirror in `x` stands for one of `2 nx x ny` cells, whose first half is the second in
/// reverse order, with the other sign where the field is odd.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Mirrors {
    /// Whether there is a mirror along `[x, y]`.
    pub axes: [bool; 2],
    /// Parity of each input; what it says along an axis without a mirror does not matter.
    pub inputs: Vec<Parity>,
}

impl Mirrors {
    /// No mirror.
    pub const NONE: Self = Self { axes: [false, false], inputs: Vec::new() };

    /// Whether there is any.
    pub fn any(&self) -> bool {
        self.axes != [false, false]
    }

    /// Cells of the whole grid of which `cells` are in front of the mirrors.
    pub fn whole(&self, cells: [usize; 2]) -> [usize; 2] {
        [0, 1].map(|axis| if self.axes[axis] { 2 * cells[axis] } else { cells[axis] })
    }

    /// Whether an input is odd along each axis.
    pub(super) fn input_is_odd(&self, input: usize) -> [bool; 2] {
        self.inputs.get(input).map_or([false, false], |parity| parity.odd())
    }

    /// Whether each output is odd along each axis: an odd kernel turns even fields to odd ones and the other way round.
    pub(super) fn outputs_odd(
        &self,
        kernels: &[Kernel<'_>],
        blocks: &[Block],
    ) -> Result<Vec<[bool; 2]>, ConvolutionError> {
        let count = blocks.iter().map(|block| block.output + 1).max().unwrap_or(0);
        let mut outputs = vec![None; count];
        for (index, block) in blocks.iter().enumerate() {
            let (input, kernel) = (self.input_is_odd(block.input), kernels[block.kernel].parity.odd());
            let odd = [0, 1].map(|axis| self.axes[axis] && input[axis] != kernel[axis]);
            if *outputs[block.output].get_or_insert(odd) != odd {
                return Err(ConvolutionError::Parity { block: index });
            }
        }
        Ok(outputs.into_iter().map(Option::unwrap_or_default).collect())
    }
}

/// The whole field from the part in front of the mirrors.
pub(super) fn unfolded(
    mirrors: &Mirrors,
    shape: [usize; 2],
    (part, odd): (&[f64], [bool; 2]),
    whole: &mut [f64],
) {
    let [nx, ny] = shape;
    let [_, columns] = mirrors.whole(shape);
    let [mirror_x, mirror_y] = mirrors.axes;
    let sign = |behind: bool, odd: bool| if behind && odd { -1.0 } else { 1.0 };
    for (i, row) in whole.chunks_exact_mut(columns).enumerate() {
        let (from, behind_x) = folded(i, nx, mirror_x);
        for (j, value) in row.iter_mut().enumerate() {
            let (column, behind_y) = folded(j, ny, mirror_y);
            *value = sign(behind_x, odd[0]) * sign(behind_y, odd[1]) * part[from * ny + column];
        }
    }
}

/// The part of a whole field in front of the mirrors.
pub(super) fn in_front(mirrors: &Mirrors, shape: [usize; 2], whole: &[f64], part: &mut [f64]) {
    let [nx, ny] = shape;
    let [_, columns] = mirrors.whole(shape);
    let [first_x, first_y] = [0, 1].map(|axis| if mirrors.axes[axis] { shape[axis] } else { 0 });
    debug_assert_eq!(part.len(), nx * ny);
    for (row, from) in part.chunks_exact_mut(ny).zip(whole.chunks_exact(columns).skip(first_x)) {
        row.copy_from_slice(&from[first_y..first_y + ny]);
    }
}

/// The cell in front of a mirror that stands for one of the whole line, and whether that lies behind.
fn folded(index: usize, cells: usize, mirrored: bool) -> (usize, bool) {
    match (mirrored, index < cells) {
        (false, _) => (index, false),
        (true, true) => (cells - 1 - index, true),
        (true, false) => (index - cells, false),
    }
}

#[cfg(test)]
mod tests {
    use ndarray::Array2;

    use super::super::tests::{PARITIES, full_blocks};
    use super::super::{Convolution, Engine, PeriodicProduct, SingleProduct, Symbol, Workspace};
    use super::*;

    const AXES: [[bool; 2]; 4] = [[false, false], [true, false], [false, true], [true, true]];

    /// Rounding of transforms of a few hundred points, in units of the largest output.
    const DOUBLE: f64 = 1e-13;
    /// The same in single precision, whose numbers are 2^29 times as coarse: 1e-15 becomes 5e-7, and the worst of many cells is
    /// some times that.
    const SINGLE: f64 = 4e-6;

    fn apply_single(product: &SingleProduct, input: &[&[f64]], output: &mut [&mut [f64]]) {
        #[expect(clippy::cast_possible_truncation, reason = "single precision is what is tested")]
        let rounded = |field: &&[f64]| field.iter().map(|value| *value as f32).collect::<Vec<f32>>();
        let fields: Vec<Vec<f32>> = input.iter().map(rounded).collect();
        let mut results: Vec<Vec<f32>> = output.iter().map(|field| vec![f32::NAN; field.len()]).collect();
        let from: Vec<&[f32]> = fields.iter().map(Vec::as_slice).collect();
        let mut to: Vec<&mut [f32]> = results.iter_mut().map(Vec::as_mut_slice).collect();
        product.apply(&mut Workspace::default(), &from, &mut to);
        for (field, result) in output.iter_mut().zip(&results) {
            for (value, result) in field.iter_mut().zip(result) {
                *value = product.unit() * f64::from(*result);
            }
        }
    }

    /// Any numbers without symmetry.
    fn numbers(count: usize, seed: usize) -> Vec<f64> {
        (0..count).map(|i| ((i * i + 3 * i + 17 * seed) as f64 * 0.618).sin()).collect()
    }

    fn array(shape: [usize; 2], seed: usize) -> Array2<f64> {
        Array2::from_shape_vec(shape, numbers(shape[0] * shape[1], seed)).unwrap()
    }

    /// Field in front of the mirrors behind which it goes on with a parity, made whole: written out cell by cell.
    fn made_whole(part: &[f64], shape: [usize; 2], axes: [bool; 2], odd: [bool; 2]) -> Vec<f64> {
        let whole = [0, 1].map(|axis| if axes[axis] { 2 * shape[axis] } else { shape[axis] });
        let mut field = vec![0.0; whole[0] * whole[1]];
        for i in 0..whole[0] {
            for j in 0..whole[1] {
                let mut at = [i, j];
                let mut sign = 1.0;
                for axis in 0..2 {
                    if axes[axis] && at[axis] < shape[axis] {
                        at[axis] = shape[axis] - 1 - at[axis];
                        sign *= if odd[axis] { -1.0 } else { 1.0 };
                    } else if axes[axis] {
                        at[axis] -= shape[axis];
                    }
                }
                field[i * whole[1] + j] = sign * part[at[0] * shape[1] + at[1]];
            }
        }
        field
    }

    /// What a product in front of mirrors must give: that of the whole fields, in front.
    fn check(
        shape: [usize; 2],
        (axes, inputs): ([bool; 2], &[Parity]),
        blocks: &[Block],
        tolerance: f64,
        apply: impl Fn(Engine, Mirrors, &[&[f64]], &mut [&mut [f64]]),
    ) {
        let cells = shape[0] * shape[1];
        let mirrors = Mirrors { axes, inputs: inputs.to_vec() };
        let whole = mirrors.whole(shape);
        let parts: Vec<Vec<f64>> = (0..inputs.len()).map(|seed| numbers(cells, seed)).collect();
        let fields: Vec<Vec<f64>> = parts
            .iter()
            .zip(inputs)
            .map(|(part, parity)| made_whole(part, shape, axes, parity.odd()))
            .collect();
        let outputs = blocks.iter().map(|block| block.output + 1).max().unwrap();
        let judge = *Engine::available().last().unwrap();
        let mut exact = vec![vec![0.0; whole[0] * whole[1]]; outputs];
        let from: Vec<&[f64]> = fields.iter().map(Vec::as_slice).collect();
        let mut to: Vec<&mut [f64]> = exact.iter_mut().map(Vec::as_mut_slice).collect();
        apply(judge, Mirrors::NONE, &from, &mut to);
        let size = exact.iter().flatten().fold(0.0_f64, |size, value| size.max(value.abs()));
        for engine in Engine::available() {
            let mut found = vec![vec![0.0; cells]; outputs];
            let from: Vec<&[f64]> = parts.iter().map(Vec::as_slice).collect();
            let mut to: Vec<&mut [f64]> = found.iter_mut().map(Vec::as_mut_slice).collect();
            apply(engine, mirrors.clone(), &from, &mut to);
            for (found, exact) in found.iter().zip(&exact) {
                for (index, found) in found.iter().enumerate() {
                    let at = [0, 1].map(|axis| {
                        let index = if axis == 0 { index / shape[1] } else { index % shape[1] };
                        if axes[axis] { index + shape[axis] } else { index }
                    });
                    let exact = exact[at[0] * whole[1] + at[1]];
                    assert!(
                        (found - exact).abs() <= tolerance * size,
                        "{engine:?} {shape:?} {axes:?} {inputs:?} {at:?}: {found} {exact}"
                    );
                }
            }
        }
    }

    fn free_space(
        shape: [usize; 2],
        axes: [bool; 2],
        inputs: &[Parity],
        kernels: &[Parity],
        blocks: &[Block],
    ) {
        let whole = [0, 1].map(|axis| if axes[axis] { 2 * shape[axis] } else { shape[axis] });
        let values: Vec<Array2<f64>> = (0..kernels.len()).map(|seed| array(whole, 100 + seed)).collect();
        let kernels: Vec<Kernel<'_>> = values
            .iter()
            .zip(kernels)
            .map(|(values, &parity)| Kernel { values: values.view(), parity })
            .collect();
        let product = |engine, mirrors: Mirrors| {
            let shape = if mirrors.any() { shape } else { whole };
            Convolution::on(engine, shape, &kernels, blocks, mirrors).unwrap()
        };
        check(shape, (axes, inputs), blocks, DOUBLE, |engine, mirrors, from, to| {
            let product = product(engine, mirrors);
            product.apply(&mut product.workspace(), from, to);
        });
        check(shape, (axes, inputs), blocks, SINGLE, |engine, mirrors, from, to| {
            let product = product(engine, mirrors);
            match product.in_single_precision() {
                Some(single) => apply_single(&single, from, to),
                None => product.apply(&mut product.workspace(), from, to),
            }
        });
    }

    fn periodic(shape: [usize; 2], axes: [bool; 2], inputs: &[Parity], symbols: &[Parity], blocks: &[Block]) {
        let whole = [0, 1].map(|axis| if axes[axis] { 2 * shape[axis] } else { shape[axis] });
        let waves = whole.map(|n| n / 2 + 1);
        let values: Vec<Array2<f64>> = (0..symbols.len()).map(|seed| array(waves, 200 + seed)).collect();
        let symbols: Vec<Symbol<'_>> = values
            .iter()
            .zip(symbols)
            .map(|(values, &parity)| Symbol { values: values.view(), parity })
            .collect();
        let product = |engine, mirrors: Mirrors| {
            let shape = if mirrors.any() { shape } else { whole };
            PeriodicProduct::on(engine, shape, &symbols, blocks, mirrors).unwrap()
        };
        check(shape, (axes, inputs), blocks, DOUBLE, |engine, mirrors, from, to| {
            let product = product(engine, mirrors);
            product.apply(&mut product.workspace(), from, to);
        });
        check(shape, (axes, inputs), blocks, SINGLE, |engine, mirrors, from, to| {
            let product = product(engine, mirrors);
            match product.in_single_precision() {
                Some(single) => apply_single(&single, from, to),
                None => product.apply(&mut product.workspace(), from, to),
            }
        });
    }

    const ONE: [Block; 1] = [Block { output: 0, input: 0, kernel: 0, sign: -1.5 }];

    #[test]
    fn every_parity_behind_every_mirror_is_the_product_of_the_whole_in_both_precisions() {
        for axes in AXES {
            for field in PARITIES {
                for kernel in PARITIES {
                    for shape in [[8, 8], [16, 40], [12, 24]] {
                        free_space(shape, axes, &[field], &[kernel], &ONE);
                        periodic(shape, axes, &[field], &[kernel], &ONE);
                    }
                    for shape in [[1, 1], [5, 3], [13, 30], [60, 7], [64, 20]] {
                        free_space(shape, axes, &[field], &[kernel], &ONE);
                    }
                    for shape in [[6, 5], [7, 30], [64, 20]] {
                        periodic(shape, axes, &[field], &[kernel], &ONE);
                    }
                }
            }
        }
    }

    #[test]
    fn pressure_and_shear_together_behind_mirrors_are_the_product_of_the_whole() {
        let (kernels, blocks) = full_blocks();
        // Pressure even, shear as its kernels from pressure.
        let inputs = [Parity::EvenEven, Parity::OddEven, Parity::EvenOdd];
        // Lines of two passes, and of three.
        for shape in [[20, 36], [48, 60]] {
            for axes in AXES {
                free_space(shape, axes, &inputs, &kernels, &blocks);
                periodic(shape, axes, &inputs, &kernels, &blocks);
            }
        }
    }

    #[test]
    fn an_output_that_would_be_even_and_odd_is_refused() {
        let values = array([8, 8], 0);
        let kernel = |parity| Kernel { values: values.view(), parity };
        let blocks = [0, 1].map(|kernel| Block { output: 0, input: 0, kernel, sign: 1.0 });
        let kernels = [kernel(Parity::EvenEven), kernel(Parity::OddEven)];
        let mirrors = |axes| Mirrors { axes, inputs: vec![Parity::EvenEven] };
        let refused = Convolution::mirrored([4, 8], &kernels, &blocks, mirrors([true, false])).err();
        assert_eq!(refused, Some(ConvolutionError::Parity { block: 1 }));
        assert!(Convolution::mirrored([8, 4], &kernels, &blocks, mirrors([false, true])).is_ok());
    }
}
