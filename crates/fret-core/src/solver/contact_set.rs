//! The cells of a box that are in contact. Fields over them are packed: one number a cell, in the order of the cells.

use std::ops::Range;

use pulp::Arch;

use crate::model::TangentialField;
use crate::model::each_cell::Number;

/// Cells in contact, as runs along the rows of the box.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct ContactSet {
    runs: Vec<Range<usize>>,
    len: usize,
}

impl ContactSet {
    /// The cells below `count` where `within`.
    pub fn of(count: usize, within: impl Fn(usize) -> bool) -> Self {
        let mut runs: Vec<Range<usize>> = Vec::new();
        for cell in (0..count).filter(|&cell| within(cell)) {
            match runs.last_mut() {
                Some(run) if run.end == cell => run.end += 1,
                _ => runs.push(cell..cell + 1),
            }
        }
        let len = runs.iter().map(ExactSizeIterator::len).sum();
        Self { runs, len }
    }

    /// Number of cells.
    pub fn len(&self) -> usize {
        self.len
    }

    /// The cells, in their order.
    pub fn cells(&self) -> impl Iterator<Item = usize> {
        self.runs.iter().cloned().flatten()
    }

    /// Packs a field of the box, of either precision.
    pub fn gather<T: Copy>(&self, field: &[T], packed: &mut [T]) {
        let mut first = 0;
        for run in &self.runs {
            packed[first..first + run.len()].copy_from_slice(&field[run.clone()]);
            first += run.len();
        }
    }

    /// The same times a factor, into a packed field of any precision.
    pub fn gather_scaled<A: Number, B: Number>(&self, field: &[A], factor: f64, packed: &mut [B]) {
        Arch::new().dispatch(
            #[inline(always)]
            || {
                let mut first = 0;
                for run in &self.runs {
                    let to = &mut packed[first..first + run.len()];
                    for (to, from) in to.iter_mut().zip(&field[run.clone()]) {
                        *to = B::of(*from, factor);
                    }
                    first += run.len();
                }
            },
        );
    }

    /// A packed copy of a field of the box.
    pub fn packed(&self, field: &[f64]) -> Vec<f64> {
        let mut packed = Vec::with_capacity(self.len);
        self.pack(field, &mut packed);
        packed
    }

    /// Packs a field of the box into one of any length, keeping the memory.
    pub fn pack(&self, field: &[f64], packed: &mut Vec<f64>) {
        packed.clear();
        for run in &self.runs {
            packed.extend_from_slice(&field[run.clone()]);
        }
    }

    /// Packs a tangential field of the box into one of any length, keeping the memory.
    pub fn pack_tangential(&self, field: &TangentialField, packed: &mut TangentialField) {
        self.pack(&field.x, &mut packed.x);
        self.pack(&field.y, &mut packed.y);
    }

    /// Packs a tangential field of the box.
    pub fn gather_tangential(&self, field: &TangentialField, packed: &mut TangentialField) {
        self.gather(&field.x, &mut packed.x);
        self.gather(&field.y, &mut packed.y);
    }

    /// A packed copy of a tangential field of the box.
    pub fn packed_tangential(&self, field: &TangentialField) -> TangentialField {
        TangentialField { x: self.packed(&field.x), y: self.packed(&field.y) }
    }

    /// Writes a packed field into one of the box, of either precision, which keeps what it holds elsewhere.
    pub fn place<T: Copy>(&self, packed: &[T], field: &mut [T]) {
        let mut first = 0;
        for run in &self.runs {
            field[run.clone()].copy_from_slice(&packed[first..first + run.len()]);
            first += run.len();
        }
    }

    /// The same times a factor, into a field of any precision.
    pub fn place_scaled<A: Number, B: Number>(&self, packed: &[A], factor: f64, field: &mut [B]) {
        Arch::new().dispatch(
            #[inline(always)]
            || {
                let mut first = 0;
                for run in &self.runs {
                    let from = &packed[first..first + run.len()];
                    for (to, from) in field[run.clone()].iter_mut().zip(from) {
                        *to = B::of(*from, factor);
                    }
                    first += run.len();
                }
            },
        );
    }

    /// Writes a packed tangential field into one of the box, which keeps what it holds elsewhere.
    pub fn place_tangential(&self, packed: &TangentialField, field: &mut TangentialField) {
        self.place(&packed.x, &mut field.x);
        self.place(&packed.y, &mut field.y);
    }

    /// Writes a packed field into one of the box, which is zero elsewhere.
    pub fn scatter(&self, packed: &[f64], field: &mut [f64]) {
        field.fill(0.0);
        self.place(packed, field);
    }

    /// Writes a packed tangential field into one of the box, which is zero elsewhere.
    pub fn scatter_tangential(&self, packed: &TangentialField, field: &mut TangentialField) {
        self.scatter(&packed.x, &mut field.x);
        self.scatter(&packed.y, &mut field.y);
    }
}
