//! Cross spectra of the fields that a free-space product takes with fields beside those that it makes.

use super::super::cross_columns::CrossColumns;
use super::super::instruction_set::{InstructionSet, enter};
use super::super::memory::AlignedNumbers;
use super::super::rows::Side;
use super::super::simd::{Lanes, Number};
use super::super::threads::{Scratch, pieces};
use super::{Boundary, LaneProduct};

impl LaneProduct<f64> {
    /// Cross spectra of no fields; `None` of a product that repeats.
    pub fn cross_spectra(&self) -> Option<AlignedNumbers<f64>> {
        match self.boundary {
            Boundary::FreeSpace => Some(AlignedNumbers::zeros(self.kernels.len())),
            Boundary::Periodic { .. } => None,
        }
    }

    /// Numbers of work space for cross spectra, for as many threads.
    pub fn cross_len(&self, threads: usize) -> usize {
        2 * self.layout.spectra_len() + threads.max(2) * self.scratch_len()
    }

    /// Adds the cross spectra of `input` with `output`, with work space for at least one thread.
    pub fn add_cross_spectra(
        &self,
        work: &mut [f64],
        (input, output): (&[&[f64]], &[&[f64]]),
        sums: &mut AlignedNumbers<f64>,
    ) {
        match self.inputs.max(self.outputs) {
            1 => self.cross::<1>(work, (input, output), sums),
            2 => self.cross::<2>(work, (input, output), sums),
            _ => self.cross::<3>(work, (input, output), sums),
        }
    }

    fn cross<const F: usize>(
        &self,
        work: &mut [f64],
        (input, output): (&[&[f64]], &[&[f64]]),
        sums: &mut AlignedNumbers<f64>,
    ) {
        let piece_len = self.scratch_len();
        let (of_input, work) = work.split_at_mut(self.layout.spectra_len());
        let (of_output, numbers) = work.split_at_mut(self.layout.spectra_len());
        let pieces = pieces(self.layout.shape, numbers.len() / piece_len);
        let rows = self.reflection.as_ref().map(|reflection| reflection.rows);
        let lie =
            |sides: Option<[Side; 3]>| move |index: usize| sides.map_or(Side::Plain, |sides| sides[index]);
        let (inputs, outputs) = (lie(rows.map(|rows| rows.inputs)), lie(rows.map(|rows| rows.outputs)));
        self.rows_forward(input, &inputs, of_input, Scratch { numbers, piece_len }, pieces);
        self.rows_forward(output, &outputs, of_output, Scratch { numbers, piece_len }, pieces);
        let columns = CrossColumns::<f64, F> {
            layout: &self.layout,
            plan: &self.along_x,
            counts: [self.inputs, self.outputs],
            spectra: [of_input, of_output],
            terms: &self.terms,
            reflection: self.reflection.as_ref(),
            table_count: self.kernel_count,
            sums: sums.as_mut_slice(),
            scratch: numbers,
        };
        enter!(self.set, f64, columns);
    }

    /// The scalar product of cross spectra with the kernels.
    pub fn contracted(&self, sums: &AlignedNumbers<f64>) -> f64 {
        let (kernels, sums) = (self.kernels.as_slice().as_chunks::<8>(), sums.as_slice().as_chunks::<8>());
        let mut lanes = [0.0; 8];
        for (kernels, sums) in kernels.0.iter().zip(sums.0) {
            for (lane, (kernel, sum)) in lanes.iter_mut().zip(kernels.iter().zip(sums)) {
                *lane += kernel * sum;
            }
        }
        let rest: f64 = kernels.1.iter().zip(sums.1).map(|(kernel, sum)| kernel * sum).sum();
        lanes.iter().sum::<f64>() + rest
    }
}
