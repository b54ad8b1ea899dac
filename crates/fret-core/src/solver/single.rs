//! Fields in single precision, brought to a size near one: what approximate inverses and frozen problems work on, which need few
//! digits and whose errors the next look at the exact equations sees.

use pulp::Arch;

use super::contact_set::ContactSet;

/// The power of two nearest below a size; one where there is none.
pub fn unit_of(size: f64) -> f64 {
    if size > 0.0 && size.is_finite() { size.log2().floor().exp2() } else { 1.0 }
}

/// `to = factor * from`, rounded.
#[expect(clippy::cast_possible_truncation, reason = "this is what single precision is")]
pub fn round(from: &[f64], factor: f64, to: &mut [f32]) {
    Arch::new().dispatch(
        #[inline(always)]
        || {
            for (to, from) in to.iter_mut().zip(from) {
                *to = (factor * from) as f32;
            }
        },
    );
}

/// `to = factor * from`.
pub fn widen(from: &[f32], factor: f64, to: &mut [f64]) {
    Arch::new().dispatch(
        #[inline(always)]
        || {
            for (to, from) in to.iter_mut().zip(from) {
                *to = factor * f64::from(*from);
            }
        },
    );
}

/// Between packed fields and those of the box in single precision; keeps its memory.
#[derive(Debug, Default)]
pub struct Rounding {
    packed: Vec<f32>,
}

impl Rounding {
    /// Writes `factor` times a packed field into one of the box, which keeps what it holds elsewhere.
    pub fn place(&mut self, contact: &ContactSet, packed: &[f64], factor: f64, field: &mut [f32]) {
        self.packed.resize(packed.len(), 0.0);
        round(packed, factor, &mut self.packed);
        contact.place(&self.packed, field);
    }

    /// Packs `factor` times a field of the box.
    pub fn gather(&mut self, contact: &ContactSet, field: &[f32], factor: f64, packed: &mut [f64]) {
        self.packed.resize(packed.len(), 0.0);
        contact.gather(field, &mut self.packed);
        widen(&self.packed, factor, packed);
    }
}
