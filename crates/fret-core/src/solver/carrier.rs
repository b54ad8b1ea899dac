//! Between packed fields and those of a box of another precision, brought to a size near one: what approximate inverses work on,
//! which need few digits.

use super::contact_set::ContactSet;
use crate::model::each_cell::{Number, convert};

/// The power of two nearest below a size; one where there is none.
pub fn unit_of(size: f64) -> f64 {
    if size > 0.0 && size.is_finite() { size.log2().floor().exp2() } else { 1.0 }
}

/// Carries fields to a box and back; keeps its memory.
#[derive(Debug, Default)]
pub struct Carrier<B> {
    packed: Vec<B>,
}

impl<B: Number> Carrier<B> {
    /// Writes `factor` times a packed field into one of the box, which keeps what it holds elsewhere.
    pub fn place<A: Number>(&mut self, contact: &ContactSet, packed: &[A], factor: f64, field: &mut [B]) {
        self.packed.resize(packed.len(), B::default());
        convert(packed, factor, &mut self.packed);
        contact.place(&self.packed, field);
    }

    /// Packs `factor` times a field of the box.
    pub fn gather<A: Number>(&mut self, contact: &ContactSet, field: &[B], factor: f64, packed: &mut [A]) {
        self.packed.resize(packed.len(), B::default());
        contact.gather(field, &mut self.packed);
        convert(&self.packed, factor, packed);
    }
}
