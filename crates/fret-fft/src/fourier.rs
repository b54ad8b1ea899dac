//! Fourier transforms of single lines over rustfft: the place where sign, normalisation and half-shift are decided.
//!
//! Forward `X_k = sum_j x_j exp(-i w_k j)`, inverse `x_j = sum_k X_k exp(+i w_k j)`; no normalisation, it goes into
//! the kernels. Two grids of frequencies are used:
//!
//! - [`Frequencies::Whole`], `w_k = 2 pi k / n`: products that are periodic in `n`;
//! - [`Frequencies::HalfShifted`], `w_k = pi (4k + 1) / (2n)`: together with `-w_k` these are the `2n` frequencies of a
//!   line that changes sign after `2n` points. A product of such lines is free of wrap-around on the first `n` points,
//!   without ever storing or transforming a zero, and for real data `-w_k` is the conjugate of `w_k`.

use std::f64::consts::PI;
use std::sync::Arc;

use rustfft::num_complex::Complex;
use rustfft::{Fft, FftPlanner};

/// The frequencies at which a line of `n` points is sampled.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Frequencies {
    /// `2 pi k / n`.
    Whole,
    /// `pi (4k + 1) / (2n)`.
    HalfShifted,
}

/// Forward and inverse transform of lines of one length.
pub(super) struct LineTransform {
    length: usize,
    forward: Arc<dyn Fft<f64>>,
    inverse: Arc<dyn Fft<f64>>,
    /// `exp(-i pi j / (2n))`, empty for whole frequencies.
    shift: Vec<Complex<f64>>,
}

impl LineTransform {
    pub fn new(length: usize, frequencies: Frequencies) -> Self {
        let mut planner = FftPlanner::new();
        let shift = match frequencies {
            Frequencies::Whole => Vec::new(),
            Frequencies::HalfShifted => (0..length)
                .map(|j| Complex::from_polar(1.0, -PI * j as f64 / (2.0 * length as f64)))
                .collect(),
        };
        Self {
            length,
            forward: planner.plan_fft_forward(length),
            inverse: planner.plan_fft_inverse(length),
            shift,
        }
    }

    /// Complex numbers of scratch that [`forward`](Self::forward) and [`inverse`](Self::inverse) want.
    pub fn scratch_len(&self) -> usize {
        self.forward.get_inplace_scratch_len().max(self.inverse.get_inplace_scratch_len())
    }

    /// Transforms each of the contiguous `lines` in place.
    pub fn forward(&self, lines: &mut [Complex<f64>], scratch: &mut [Complex<f64>]) {
        if self.length == 1 {
            return; // a point is its own transform
        }
        for line in lines.chunks_exact_mut(self.length) {
            for (value, shift) in line.iter_mut().zip(&self.shift) {
                *value *= shift;
            }
        }
        self.forward.process_with_scratch(lines, scratch);
    }

    /// Undoes [`forward`](Self::forward) up to the factor `n`.
    pub fn inverse(&self, lines: &mut [Complex<f64>], scratch: &mut [Complex<f64>]) {
        if self.length == 1 {
            return;
        }
        self.inverse.process_with_scratch(lines, scratch);
        for line in lines.chunks_exact_mut(self.length) {
            for (value, shift) in line.iter_mut().zip(&self.shift) {
                *value *= shift.conj();
            }
        }
    }
}
