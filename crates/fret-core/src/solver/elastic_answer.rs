//! Packed tractions to the operator of a box, and their displacements back: with six digits where the operator offers them.

use super::contact_set::ContactSet;
use super::krylov::Triple;
use super::single::unit_of;
use super::tractions::{Displacements, Tractions};
use crate::compliance::SurfaceCompliance;

/// Fields of the box, in both precisions as they are needed; tractions are zero outside the contact.
#[derive(Debug, Default)]
pub struct ElasticAnswer {
    cells: usize,
    /// Whether all digits are wanted.
    pub exact: bool,
    tractions: Tractions,
    displacements: Displacements,
    single_tractions: [Vec<f32>; 3],
    single_displacements: [Vec<f32>; 3],
}

impl ElasticAnswer {
    /// Makes ready for an increment in a box of so many cells.
    pub fn begin(&mut self, cells: usize) {
        self.cells = cells;
        self.exact = false;
    }

    /// Forgets the contact before.
    pub fn restart(&mut self) {
        self.tractions.clear();
        for field in &mut self.single_tractions {
            field.clear();
            field.resize(self.cells, 0.0);
        }
        for field in &mut self.single_displacements {
            field.resize(self.cells, 0.0);
        }
    }

    /// The displacements of packed tractions.
    pub fn full(
        &mut self,
        contact: &ContactSet,
        tractions: &Triple,
        displacements: &mut Triple,
        compliance: &mut dyn SurfaceCompliance,
    ) {
        if !self.exact && self.full_single(contact, tractions, displacements, compliance) {
            return;
        }
        self.exact = true;
        if self.tractions.pressure.len() != self.cells {
            self.tractions = Tractions::zeros(self.cells);
            self.displacements = Displacements::zeros(self.cells);
        }
        let Self { tractions: spread, displacements: answer, .. } = self;
        let [p, x, y] = tractions.parts();
        contact.place(p, &mut spread.pressure);
        contact.place(x, &mut spread.shear.x);
        contact.place(y, &mut spread.shear.y);
        compliance.full(&spread.pressure, &spread.shear, &mut answer.normal, &mut answer.tangential);
        let [normal, x, y] = displacements.parts_mut();
        contact.gather(&answer.normal, normal);
        contact.gather(&answer.tangential.x, x);
        contact.gather(&answer.tangential.y, y);
    }

    /// The same in single precision; tells whether the operator has it.
    fn full_single(
        &mut self,
        contact: &ContactSet,
        tractions: &Triple,
        displacements: &mut Triple,
        compliance: &mut dyn SurfaceCompliance,
    ) -> bool {
        let unit = unit_of(tractions.norm());
        for (part, field) in tractions.parts().into_iter().zip(&mut self.single_tractions) {
            contact.place_rounded(part, 1.0 / unit, field);
        }
        let answer = &mut self.single_displacements;
        let Some(out) = compliance.full_single(&self.single_tractions, answer) else { return false };
        for (field, part) in answer.iter().zip(displacements.parts_mut()) {
            contact.gather_widened(field, unit * out, part);
        }
        true
    }
}
