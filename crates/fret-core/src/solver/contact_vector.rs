//! Vectors over the cells in contact: tractions, the displacements against them, residuals; and their way through an operator that
//! acts on a whole region.

use super::contact_set::ContactSet;
use crate::fields::{Number, clear, convert, norm, reset};

/// Both components of shear, after the pressure where that is unknown too; or what goes with them. Packed, one field after the other.
#[derive(Debug, Clone, Default)]
pub struct ContactVector<N> {
    values: Vec<N>,
    cells: usize,
}

impl<N: Number> ContactVector<N> {
    /// Makes room for 2 or 3 fields of so many cells; what it held is lost.
    pub fn reset(&mut self, fields: usize, cells: usize) {
        self.cells = cells;
        reset(&mut self.values, fields * cells);
    }

    /// All zero.
    pub fn clear(&mut self, fields: usize, cells: usize) {
        self.reset(fields, cells);
        self.values.fill(N::default());
    }

    /// Makes room for the same as another one.
    pub fn reset_like(&mut self, other: &Self) {
        self.cells = other.cells;
        reset(&mut self.values, other.values.len());
    }

    /// All zero, with room for the same as another one.
    pub fn clear_like(&mut self, other: &Self) {
        self.reset_like(other);
        self.values.fill(N::default());
    }

    /// Multiplies by a number.
    pub fn scale(&mut self, factor: f64) {
        for value in &mut self.values {
            *value = N::of(*value, factor);
        }
    }

    /// All fields one after the other.
    pub fn values(&self) -> &[N] {
        &self.values
    }

    /// All fields one after the other.
    pub fn values_mut(&mut self) -> &mut [N] {
        &mut self.values
    }

    /// The pressure, empty where it is given; and the components of shear along x and y.
    pub fn parts(&self) -> (&[N], [&[N]; 2]) {
        let (rest, y) = self.values.split_at(self.values.len() - self.cells);
        let (pressure, x) = rest.split_at(rest.len() - self.cells);
        (pressure, [x, y])
    }

    /// The same, to be changed.
    pub fn parts_mut(&mut self) -> (&mut [N], [&mut [N]; 2]) {
        let (len, cells) = (self.values.len(), self.cells);
        let (rest, y) = self.values.split_at_mut(len - cells);
        let (pressure, x) = rest.split_at_mut(len - 2 * cells);
        (pressure, [x, y])
    }

    /// The fields: 2 or 3.
    pub fn fields(&self) -> impl ExactSizeIterator<Item = &[N]> {
        self.values.chunks_exact(self.cells.max(1))
    }

    /// The same, to be changed.
    pub fn fields_mut(&mut self) -> impl ExactSizeIterator<Item = &mut [N]> {
        self.values.chunks_exact_mut(self.cells.max(1))
    }

    /// Euclidean norm.
    pub fn norm(&self) -> f64 {
        norm(&self.values)
    }

    /// Takes over `factor` times another vector, of any precision.
    pub fn convert<A: Number>(&mut self, from: &ContactVector<A>, factor: f64) {
        self.cells = from.cells;
        reset(&mut self.values, from.values.len());
        convert(&from.values, factor, &mut self.values);
    }
}

/// Fields of a region that vectors are spread to: tractions, zero outside the contact, and their displacements.
#[derive(Debug, Default)]
pub struct RegionFields<N> {
    tractions: [Vec<N>; 3],
    displacements: [Vec<N>; 3],
    /// The contact outside of which tractions are zero.
    contact: ContactSet,
}

impl<N: Number> RegionFields<N> {
    /// Makes ready for a contact in a region of so many cells.
    pub fn begin(&mut self, contact: &ContactSet, cells: usize) {
        if self.contact != *contact || self.tractions[0].len() != cells {
            for field in &mut self.tractions {
                clear(field, cells);
            }
            self.contact.clone_from(contact);
        }
        for field in &mut self.displacements {
            reset(field, cells);
        }
    }

    /// The displacements of tractions, by an operator on as many fields of the region.
    pub fn apply(
        &mut self,
        tractions: &ContactVector<N>,
        displacements: &mut ContactVector<N>,
        operator: impl FnOnce(&[&[N]], &mut [&mut [N]]),
    ) {
        let Self { tractions: from, displacements: to, contact } = self;
        let fields = tractions.fields();
        let first = 3 - fields.len();
        for (packed, field) in fields.zip(&mut from[first..]) {
            contact.place(packed, 1.0, field);
        }
        operator(
            &from.each_ref().map(Vec::as_slice)[first..],
            &mut to.each_mut().map(Vec::as_mut_slice)[first..],
        );
        displacements.reset_like(tractions);
        for (field, packed) in to[first..].iter().zip(displacements.fields_mut()) {
            contact.gather(field, 1.0, packed);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vectors_with_and_without_pressure_fall_into_their_fields() {
        for (fields, pressure) in [(3, vec![1.0, 2.0]), (2, vec![])] {
            let mut vector = ContactVector::<f64>::default();
            vector.reset(fields, 2);
            for (value, number) in vector.values_mut().iter_mut().rev().zip([6.0, 5.0, 4.0, 3.0, 2.0, 1.0]) {
                *value = number;
            }
            assert_eq!(vector.parts(), (&pressure[..], [&[3.0, 4.0][..], &[5.0, 6.0]]));
            assert_eq!(vector.fields().len(), fields);
            let (p, [_, y]) = vector.parts_mut();
            assert_eq!(p.len(), pressure.len());
            y[1] = 0.0;
            assert_eq!(vector.values().last(), Some(&0.0));
        }
    }

    /// An operator that takes every cell by its number: what another contact or region left behind would be seen, and so would a wrong
    /// cell.
    #[test]
    fn nothing_is_left_of_another_contact() {
        let mut through = RegionFields::<f64>::default();
        for (cells, region, fields) in
            [(&[0, 1][..], 4, 2), (&[1, 3], 4, 2), (&[1, 3], 6, 3), (&[1, 3], 4, 3), (&[0, 2, 3], 4, 3)]
        {
            let contact = ContactSet::of(region, |cell| cells.contains(&cell));
            through.begin(&contact, region);
            let (mut from, mut to) = (ContactVector::default(), ContactVector::default());
            from.reset(fields, cells.len());
            from.values_mut().iter_mut().enumerate().for_each(|(index, value)| *value = 1.0 + index as f64);
            through.apply(&from, &mut to, |q, u| {
                assert_eq!((q.len(), u.len()), (fields, fields));
                for (field, (q, u)) in q.iter().zip(u).enumerate() {
                    assert_eq!((q.len(), u.len()), (region, region));
                    assert!((0..region).all(|cell| cells.contains(&cell) || q[cell] == 0.0), "{q:?}");
                    (0..region).for_each(|cell| u[cell] = q[cell] * (1 + cell + 10 * field) as f64);
                }
            });
            let expected = (0..fields * cells.len()).map(|index| {
                let (field, place) = (index / cells.len(), index % cells.len());
                (1 + index) as f64 * (1 + cells[place] + 10 * field) as f64
            });
            assert_eq!(to.values(), expected.collect::<Vec<_>>());
        }
    }
}
