//! Packed tractions to the operator of a box, and their displacements back.

use super::components::Components;
use super::contact_set::ContactSet;
use crate::model::each_cell::Number;

/// Fields of the box; tractions are zero outside the contact.
#[derive(Debug)]
pub struct ElasticAnswer<N, const K: usize> {
    tractions: [Vec<N>; K],
    displacements: [Vec<N>; K],
}

impl<N, const K: usize> Default for ElasticAnswer<N, K> {
    fn default() -> Self {
        Self { tractions: [const { Vec::new() }; K], displacements: [const { Vec::new() }; K] }
    }
}

impl<N: Number, const K: usize> ElasticAnswer<N, K> {
    /// Makes ready for a box of so many cells; forgets the contact before when it has `changed`.
    pub fn begin(&mut self, cells: usize, changed: bool) {
        for field in &mut self.tractions {
            if changed {
                field.clear();
            }
            field.resize(cells, N::default());
        }
        for field in &mut self.displacements {
            field.resize(cells, N::default());
        }
    }

    /// The displacements of packed tractions, by the operator `apply`.
    pub fn find(
        &mut self,
        contact: &ContactSet,
        tractions: &Components<N, K>,
        displacements: &mut Components<N, K>,
        apply: impl FnOnce([&[N]; K], [&mut [N]; K]),
    ) {
        let Self { tractions: spread, displacements: answer } = self;
        for (part, field) in tractions.parts().into_iter().zip(spread.iter_mut()) {
            contact.place(part, field);
        }
        apply(spread.each_ref().map(Vec::as_slice), answer.each_mut().map(Vec::as_mut_slice));
        for (field, part) in answer.iter().zip(displacements.parts_mut()) {
            contact.gather(field, part);
        }
    }

    /// The displacements last found, in the whole box.
    pub fn in_box(&self) -> &[Vec<N>; K] {
        &self.displacements
    }
}
