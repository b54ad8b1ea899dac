//! The tables of a line transform: passes, weights, and the order in which frequencies come out.
//!
//! A line of `n = r_0 r_1 ... 4` points is the polynomial `sum_j x_j z^j`, wanted at the `n` roots of
//! `z^n = exp(-2 pi i f)`: whole frequencies for `f = 0`, half-shifted ones for `f = 1/4`. A forward pass of radix `r`
//! replaces each polynomial modulo `z^(rq) = exp(-2 pi i f)` by the `r` polynomials modulo
//! `z^q = exp(-2 pi i (f + m)/r)`, `m = 0..r`. So all butterflies of one block share their weights, the half-shift is
//! free, and the frequencies come out in the order of reversed digits. The inverse takes them in that order: its passes go
//! back with weights that depend on the place `j` in a block and are the same for all blocks, and only the last of them
//! knows of the half-shift.

use std::f64::consts::TAU;

use super::butterfly::{Weights, weights};
use super::simd::{MAX_WIDTH, Number};

/// Tables of the transform of lines of one length, which is a multiple of 4 greater than 4.
#[derive(Debug)]
pub struct LinePlan<N> {
    length: usize,
    /// Outermost first; the last is always 4.
    radices: Vec<usize>,
    /// `[pass][block]`
    forward: Vec<Vec<Weights<N>>>,
    /// `[pass][place in the block]`
    inverse: Vec<Vec<Weights<N>>>,
    /// Cosine and sine of `2 pi f j / n`, the half-shift of the first input of the outermost inverse butterflies.
    first_turns: Vec<[N; 2]>,
    /// Cosine and sine of `2 pi f m / r_0`, the half-shift of their outputs.
    output_turns: Vec<[N; 2]>,
    /// Cosine and sine of `pi (k + f) / (2n)` at the position of each frequency: the phase between the first point and the
    /// plane of a mirror half a cell of the mirrored line before it.
    mirror_turns: Vec<[N; 2]>,
}

impl<N: Number> LinePlan<N> {
    /// Tables for lines of `length = 4 * 2^a * 3^b * 5^c >= 8` at frequencies `2 pi (k + fraction) / length`.
    pub fn new(length: usize, fraction: f64) -> Self {
        let radices = radices(length);
        let mut forward: Vec<Vec<Weights<N>>> = Vec::new();
        let mut inverse = Vec::new();
        let mut fractions = vec![fraction];
        let mut span = length;
        for (pass, &radix) in radices.iter().enumerate() {
            forward.push(fractions.iter().map(|part| weights_of(radix, part / radix as f64, 0.0)).collect());
            let shift = if pass == 0 { fraction / length as f64 } else { 0.0 };
            let places =
                (0..span / radix).map(|j| weights_of(radix, j as f64 / span as f64, j as f64 * shift));
            inverse.push(places.collect());
            fractions = fractions
                .iter()
                .flat_map(|part| (0..radix).map(move |m| (part + m as f64) / radix as f64))
                .collect();
            span /= radix;
        }
        // The innermost pass takes as many lines at a time as the widest vectors have lanes.
        if let Some(innermost) = forward.last_mut() {
            innermost.resize(innermost.len().next_multiple_of(MAX_WIDTH / 4), [N::default(); 8]);
        }
        let turn = |part: f64| [N::of((TAU * part).cos()), N::of((TAU * part).sin())];
        let outermost = radices[0];
        let first_turns =
            (0..length / outermost).map(|j| turn(fraction * j as f64 / length as f64)).collect();
        let output_turns = (0..outermost).map(|m| turn(fraction * m as f64 / outermost as f64)).collect();
        let mut plan =
            Self { length, radices, forward, inverse, first_turns, output_turns, mirror_turns: Vec::new() };
        let quarter = |k: usize| turn(0.25 * (k as f64 + fraction) / length as f64);
        plan.mirror_turns = plan.order().into_iter().map(quarter).collect();
        plan.mirror_turns.resize(plan.padded_length(), [N::of(1.0), N::default()]);
        plan
    }

    pub fn length(&self) -> usize {
        self.length
    }

    /// Radix of the outermost pass.
    pub fn outermost(&self) -> usize {
        self.radices[0]
    }

    /// Points of one block after the outermost forward pass.
    pub fn inner_length(&self) -> usize {
        self.length / self.radices[0]
    }

    /// The passes between the outermost and the innermost, outermost first, as index and radix.
    pub fn middle_passes(&self) -> impl DoubleEndedIterator<Item = (usize, usize)> + '_ {
        (1..self.radices.len() - 1).map(|pass| (pass, self.radices[pass]))
    }

    /// Weights of a forward pass, one per block.
    pub fn forward(&self, pass: usize) -> &[Weights<N>] {
        &self.forward[pass]
    }

    /// Length of the line, filled up to whole vectors of any instruction set.
    pub fn padded_length(&self) -> usize {
        self.length.next_multiple_of(MAX_WIDTH)
    }

    /// Weights of the innermost forward pass, one per group of four lines of the padded line.
    pub fn innermost_forward(&self) -> &[Weights<N>] {
        &self.forward[self.radices.len() - 1]
    }

    /// Weights of an inverse pass, one per place in a block.
    pub fn inverse(&self, pass: usize) -> &[Weights<N>] {
        &self.inverse[pass]
    }

    pub fn first_turns(&self) -> &[[N; 2]] {
        &self.first_turns
    }

    pub fn output_turns(&self) -> &[[N; 2]] {
        &self.output_turns
    }

    /// One per position of the padded line.
    pub fn mirror_turns(&self) -> &[[N; 2]] {
        &self.mirror_turns
    }

    /// For each position of the transform, the index of its frequency.
    pub fn order(&self) -> Vec<usize> {
        let mut order = vec![0];
        for &radix in self.radices.iter().rev() {
            order = (0..radix).flat_map(|m| order.iter().map(move |k| m + radix * k)).collect();
        }
        order
    }
}

/// Radices of the passes, outermost first: what is not a power of 4 goes outside, where a pass is bound by memory and by
/// registers.
fn radices(length: usize) -> Vec<usize> {
    let mut rest = length / 4;
    let mut radices = Vec::new();
    for radix in [5, 3] {
        while rest.is_multiple_of(radix) {
            radices.push(radix);
            rest /= radix;
        }
    }
    let twos = rest.trailing_zeros() as usize;
    if twos % 2 == 1 {
        radices.push(2);
    }
    radices.resize(radices.len() + twos / 2 + 1, 4);
    radices
}

/// Weights for the turns `s * turn + shift`, `s = 1..radix`.
fn weights_of<N: Number>(radix: usize, turn: f64, shift: f64) -> Weights<N> {
    let mut angles = [0.0; 4];
    for (s, angle) in (1..radix).zip(&mut angles) {
        *angle = TAU * (s as f64 * turn + shift);
    }
    weights(&angles[..radix - 1])
}

#[cfg(test)]
mod tests {
    use super::{LinePlan, radices};

    #[test]
    fn radices_multiply_to_the_length_and_end_in_four() {
        for (length, expected) in [
            (8, vec![2, 4]),
            (12, vec![3, 4]),
            (64, vec![4, 4, 4]),
            (960, vec![5, 3, 4, 4, 4]),
            (128, vec![2, 4, 4, 4]),
        ] {
            assert_eq!(radices(length), expected, "{length}");
        }
    }

    #[test]
    fn every_frequency_comes_out_once() {
        for length in [8, 12, 20, 48, 64, 360] {
            let mut order = LinePlan::<f64>::new(length, 0.25).order();
            assert_eq!(order.len(), length);
            order.sort_unstable();
            assert!(order.into_iter().eq(0..length));
        }
    }
}
