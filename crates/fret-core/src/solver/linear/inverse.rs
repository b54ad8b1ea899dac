//! One approximate inverse on the cells of a region, by unpadded transforms, in double or single precision.

use super::super::contact_set::ContactSet;
use crate::compliance::SharedWorkspace;
use crate::fields::{Number, clear, convert, dot, norm, reset};
use fret_fft::{PeriodicProduct, SingleProduct};

/// A product of one or two fields that approximates the inverse of an operator.
pub enum Inverse {
    /// In double precision.
    Double(PeriodicProduct),
    /// In single precision.
    Single(SingleProduct),
}

/// The power of two nearest below a size; one where there is none.
pub fn unit_of(size: f64) -> f64 {
    if size > 0.0 && size.is_finite() { size.log2().floor().exp2() } else { 1.0 }
}

/// Fields of the region that inverses work on, on both sides; those before an inverse are zero outside the contact.
#[derive(Default)]
pub struct InverseFields {
    double: Sides<f64>,
    single: Sides<f32>,
}

#[derive(Default)]
struct Sides<B> {
    before: [Vec<B>; 2],
    after: [Vec<B>; 2],
}

impl<B: Number> Sides<B> {
    fn clear(&mut self, cells: usize) {
        for field in &mut self.before {
            clear(field, cells);
        }
        for field in &mut self.after {
            reset(field, cells);
        }
    }

    /// Carries packed fields divided by `unit` to the region and through `product`, and `factor` times what comes out back.
    fn through<N: Number>(
        &mut self,
        contact: &ContactSet,
        right: &[&[N]],
        left: &mut [&mut [N]],
        [unit, factor]: [f64; 2],
        product: impl FnOnce(&[&[B]], &mut [&mut [B]]),
    ) {
        let Self { before, after } = self;
        for (right, field) in right.iter().zip(before.iter_mut()) {
            contact.place(right, 1.0 / unit, field);
        }
        let count = right.len();
        product(
            &before.each_ref().map(Vec::as_slice)[..count],
            &mut after.each_mut().map(Vec::as_mut_slice)[..count],
        );
        for (left, field) in left.iter_mut().zip(after) {
            contact.gather(field, factor, left);
        }
    }
}

impl Inverse {
    /// Of a product; in single precision where that is wanted and there.
    pub fn new(product: PeriodicProduct, single: bool) -> Self {
        if single && let Some(product) = product.in_single_precision() {
            return Self::Single(product);
        }
        Self::Double(product)
    }

    /// Forgets in `fields` what an earlier contact left, in a region of so many cells.
    pub fn clear(&self, fields: &mut InverseFields, cells: usize) {
        match self {
            Self::Double(_) => fields.double.clear(cells),
            Self::Single(_) => fields.single.clear(cells),
        }
    }

    /// `factor` times what would remove `right`, before any restriction; one or two fields packed over a contact.
    pub fn apply<N: Number>(
        &self,
        contact: &ContactSet,
        right: &[&[N]],
        left: &mut [&mut [N]],
        factor: f64,
        (fields, workspace): (&mut InverseFields, &SharedWorkspace),
    ) {
        match self {
            Self::Double(product) => {
                let apply = |from: &[&[f64]], to: &mut [&mut [f64]]| {
                    workspace.lend(|workspace| product.apply(workspace, from, to));
                };
                fields.double.through(contact, right, left, [1.0, factor], apply);
            }
            Self::Single(product) => {
                let unit = unit_of(right.iter().map(|part| dot(part, part)).sum::<f64>().sqrt());
                let factors = [unit, factor * unit * product.unit()];
                let apply = |from: &[&[f32]], to: &mut [&mut [f32]]| {
                    workspace.lend(|workspace| product.apply(workspace, from, to));
                };
                fields.single.through(contact, right, left, factors, apply);
            }
        }
    }

    /// What would remove a field of the whole region.
    pub fn apply_to_region(
        &self,
        right: &[f64],
        left: &mut [f64],
        (fields, workspace): (&mut InverseFields, &SharedWorkspace),
    ) {
        match self {
            Self::Double(product) => workspace.lend(|work| product.apply(work, &[right], &mut [left])),
            Self::Single(product) => {
                let Sides { before: [before, _], after: [after, _] } = &mut fields.single;
                for field in [&mut *before, &mut *after] {
                    reset(field, right.len());
                }
                let unit = unit_of(norm(right));
                convert(right, 1.0 / unit, before);
                workspace.lend(|workspace| product.apply(workspace, &[before], &mut [after]));
                convert(after, unit * product.unit(), left);
            }
        }
    }
}
