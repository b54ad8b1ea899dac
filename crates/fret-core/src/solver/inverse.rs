//! One approximate inverse on the cells of a box, in the precision it deserves.

use super::contact_set::ContactSet;
use super::single::{Rounding, round, unit_of, widen};
use crate::model::field::{dot, norm};
use crate::spectral::{PeriodicProduct, SingleProduct, Workspace};

/// A product of one or two fields that approximates the inverse of an operator.
pub enum Inverse {
    /// In double precision.
    Double(PeriodicProduct, Workspace),
    /// In single precision.
    Single(SingleProduct),
}

/// Fields of the box that inverses work on, on both sides; those before an inverse are zero outside the contact.
#[derive(Default)]
pub struct BoxFields {
    double: Sides<f64>,
    single: Sides<f32>,
    rounding: Rounding,
}

#[derive(Default)]
struct Sides<T> {
    before: [Vec<T>; 2],
    after: [Vec<T>; 2],
}

impl<T: Copy + Default> Sides<T> {
    fn clear(&mut self, cells: usize) {
        for field in &mut self.before {
            field.clear();
            field.resize(cells, T::default());
        }
        for field in &mut self.after {
            field.resize(cells, T::default());
        }
    }
}

impl Inverse {
    /// Of a product; in single precision where that is wanted and there.
    pub fn new(product: PeriodicProduct, single: bool) -> Self {
        if single && let Some(product) = product.in_single_precision() {
            return Self::Single(product);
        }
        let workspace = product.workspace();
        Self::Double(product, workspace)
    }

    /// Forgets in `fields` what an earlier contact left, in a box of so many cells.
    pub fn clear(&self, fields: &mut BoxFields, cells: usize) {
        match self {
            Self::Double(..) => fields.double.clear(cells),
            Self::Single(_) => fields.single.clear(cells),
        }
    }

    /// What would remove `right`, before any restriction; one or two fields packed over a contact.
    pub fn apply(
        &mut self,
        contact: &ContactSet,
        right: &[&[f64]],
        left: &mut [&mut [f64]],
        fields: &mut BoxFields,
    ) {
        let count = right.len();
        match self {
            Self::Double(product, workspace) => {
                let Sides { before, after } = &mut fields.double;
                for (right, field) in right.iter().zip(before.iter_mut()) {
                    contact.place(right, field);
                }
                let before = before.each_ref().map(Vec::as_slice);
                let mut after = after.each_mut().map(Vec::as_mut_slice);
                product.apply(workspace, &before[..count], &mut after[..count]);
                for (left, field) in left.iter_mut().zip(after) {
                    contact.gather(field, left);
                }
            }
            Self::Single(product) => {
                let BoxFields { single: Sides { before, after }, rounding, .. } = fields;
                let unit = unit_of(right.iter().map(|part| dot(part, part)).sum::<f64>().sqrt());
                for (right, field) in right.iter().zip(before.iter_mut()) {
                    rounding.place(contact, right, 1.0 / unit, field);
                }
                let before = before.each_ref().map(Vec::as_slice);
                let mut after = after.each_mut().map(Vec::as_mut_slice);
                product.apply(&before[..count], &mut after[..count]);
                for (left, field) in left.iter_mut().zip(after) {
                    rounding.gather(contact, field, unit * product.unit(), left);
                }
            }
        }
    }

    /// What would remove a field of the whole box.
    pub fn apply_to_box(&mut self, right: &[f64], left: &mut [f64], fields: &mut BoxFields) {
        match self {
            Self::Double(product, workspace) => product.apply(workspace, &[right], &mut [left]),
            Self::Single(product) => {
                let Sides { before: [before, _], after: [after, _] } = &mut fields.single;
                for field in [&mut *before, &mut *after] {
                    field.resize(right.len(), 0.0);
                }
                let unit = unit_of(norm(right));
                round(right, 1.0 / unit, before);
                product.apply(&[before], &mut [after]);
                widen(after, unit * product.unit(), left);
            }
        }
    }
}
