//! The cells of a box that are in contact. Fields over them are packed: one number a cell, in the order of the cells.

use std::ops::Range;

use pulp::Arch;

use super::single::{round_here, widen_here};
use crate::model::TangentialField;

/// Cells in contact, as runs along the rows of the box.
#[derive(Debug, Clone, PartialEq, Eq)]
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

    /// Packs a field of the box.
    pub fn gather(&self, field: &[f64], packed: &mut [f64]) {
        let mut first = 0;
        for run in &self.runs {
            packed[first..first + run.len()].copy_from_slice(&field[run.clone()]);
            first += run.len();
        }
    }

    /// A packed copy of a field of the box.
    pub fn packed(&self, field: &[f64]) -> Vec<f64> {
        let mut packed = Vec::with_capacity(self.len);
        for run in &self.runs {
            packed.extend_from_slice(&field[run.clone()]);
        }
        packed
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

    /// Writes a packed field into one of the box, which keeps what it holds elsewhere.
    pub fn place(&self, packed: &[f64], field: &mut [f64]) {
        let mut first = 0;
        for run in &self.runs {
            field[run.clone()].copy_from_slice(&packed[first..first + run.len()]);
            first += run.len();
        }
    }

    /// Writes a packed tangential field into one of the box, which keeps what it holds elsewhere.
    pub fn place_tangential(&self, packed: &TangentialField, field: &mut TangentialField) {
        self.place(&packed.x, &mut field.x);
        self.place(&packed.y, &mut field.y);
    }

    /// Writes `factor` times a packed field, rounded, into one of the box, which keeps what it holds elsewhere.
    pub fn place_rounded(&self, packed: &[f64], factor: f64, field: &mut [f32]) {
        Arch::new().dispatch(
            #[inline(always)]
            || {
                let mut rest = packed;
                for run in &self.runs {
                    let (here, after) = rest.split_at(run.len());
                    round_here(here, factor, &mut field[run.clone()]);
                    rest = after;
                }
            },
        );
    }

    /// Packs `factor` times a field of the box.
    pub fn gather_widened(&self, field: &[f32], factor: f64, packed: &mut [f64]) {
        Arch::new().dispatch(
            #[inline(always)]
            || {
                let mut rest = packed;
                for run in &self.runs {
                    let (here, after) = rest.split_at_mut(run.len());
                    widen_here(&field[run.clone()], factor, here);
                    rest = after;
                }
            },
        );
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
