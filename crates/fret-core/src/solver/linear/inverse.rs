//! One approximate inverse on the cells of a region, by unpadded transforms, in double or single precision.

use super::super::contact_set::ContactSet;
use super::super::region_fields::RegionFields;
use crate::compliance::SharedWorkspace;
use crate::fields::{Number, convert, dot, norm, unit_of};
use fret_fft::{PeriodicProduct, SingleProduct};

/// A product of one to three fields that approximates the inverse of an operator.
pub enum Inverse {
    /// In double precision.
    Double(PeriodicProduct),
    /// In single precision.
    Single(SingleProduct),
}

/// Fields of the region that operators and their inverses work on, in either precision.
#[derive(Default)]
pub struct FieldsOfRegion {
    double: RegionFields<f64>,
    single: RegionFields<f32>,
}

impl FieldsOfRegion {
    /// Makes ready for a contact in a region of so many cells.
    pub fn begin(&mut self, contact: &ContactSet, cells: usize) {
        self.double.begin(contact, cells);
        self.single.begin(contact, cells);
    }
}

/// A precision of linear problems.
pub trait Precision: Number {
    /// The fields in this precision.
    fn fields(of_region: &mut FieldsOfRegion) -> &mut RegionFields<Self>;
}

impl Precision for f64 {
    fn fields(of_region: &mut FieldsOfRegion) -> &mut RegionFields<Self> {
        &mut of_region.double
    }
}

impl Precision for f32 {
    fn fields(of_region: &mut FieldsOfRegion) -> &mut RegionFields<Self> {
        &mut of_region.single
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

    /// `factor` times what would remove `right`, before any restriction; one to three fields packed over the contact that `fields` are ready
    /// for.
    pub fn apply<N: Number>(
        &self,
        right: &[&[N]],
        left: &mut [&mut [N]],
        factor: f64,
        (fields, workspace): (&mut FieldsOfRegion, &SharedWorkspace),
    ) {
        match self {
            Self::Double(product) => {
                let apply = |from: &[&[f64]], to: &mut [&mut [f64]]| {
                    workspace.lend(|workspace| product.apply(workspace, from, to));
                };
                fields.double.carry(right, left, [1.0, factor], apply);
            }
            Self::Single(product) => {
                let unit = unit_of(right.iter().map(|part| dot(part, part)).sum::<f64>().sqrt());
                let factors = [unit, factor * unit * product.unit()];
                let apply = |from: &[&[f32]], to: &mut [&mut [f32]]| {
                    workspace.lend(|workspace| product.apply(workspace, from, to));
                };
                fields.single.carry(right, left, factors, apply);
            }
        }
    }

    /// What would remove a field of the whole region; `fields` are ready for no contact after that.
    pub fn apply_to_region(
        &self,
        right: &[f64],
        left: &mut [f64],
        (fields, workspace): (&mut FieldsOfRegion, &SharedWorkspace),
    ) {
        match self {
            Self::Double(product) => workspace.lend(|work| product.apply(work, &[right], &mut [left])),
            Self::Single(product) => {
                let [before, after] = fields.single.one_of_region(right.len());
                let unit = unit_of(norm(right));
                convert(right, 1.0 / unit, before);
                workspace.lend(|workspace| product.apply(workspace, &[before], &mut [after]));
                convert(after, unit * product.unit(), left);
            }
        }
    }
}
