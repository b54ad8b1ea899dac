//! The way of packed fields through an operator that acts on a whole region, in the precision of the operator.

use super::contact_set::ContactSet;
use crate::fields::{Number, reset};

/// Fields of a region on both sides of an operator: those before it are zero outside the contact.
#[derive(Debug, Default)]
pub struct RegionFields<N> {
    before: [Vec<N>; 3],
    after: [Vec<N>; 3],
    /// The contact, and which fields before an operator are zero outside of it.
    contact: ContactSet,
    are_zero_outside: [bool; 3],
    /// Cells of the region.
    cells: usize,
}

impl<N: Number> RegionFields<N> {
    /// Makes ready for a contact in a region of so many cells.
    pub fn begin(&mut self, contact: &ContactSet, cells: usize) {
        if self.contact != *contact || self.cells != cells {
            self.are_zero_outside = [false; 3];
            self.contact.clone_from(contact);
            self.cells = cells;
        }
    }

    /// Carries fields packed over the contact, each number divided by `unit`, through an operator on as many fields of the region, at the
    /// most three, and `factor` times what comes out back.
    pub fn carry<A: Number>(
        &mut self,
        packed: &[&[A]],
        results: &mut [&mut [A]],
        [unit, factor]: [f64; 2],
        operator: impl FnOnce(&[&[N]], &mut [&mut [N]]),
    ) {
        let Self { before, after, contact, are_zero_outside, cells } = self;
        for ((packed, field), is_zero_outside) in packed.iter().zip(before.iter_mut()).zip(are_zero_outside) {
            if *is_zero_outside {
                contact.place(packed, 1.0 / unit, field);
            } else {
                reset(field, *cells);
                contact.scatter(packed, 1.0 / unit, field);
                *is_zero_outside = true;
            }
        }
        let count = results.len();
        after[..count].iter_mut().for_each(|field| reset(field, *cells));
        operator(
            &before.each_ref().map(Vec::as_slice)[..packed.len()],
            &mut after.each_mut().map(Vec::as_mut_slice)[..count],
        );
        for (result, field) in results.iter_mut().zip(after) {
            contact.gather(field, factor, result);
        }
    }

    /// One field of so many cells on either side, whatever is in it: no contact is ready after that.
    pub fn one_of_region(&mut self, cells: usize) -> [&mut [N]; 2] {
        self.begin(&ContactSet::default(), cells);
        self.are_zero_outside = [false; 3];
        let ([before, ..], [after, ..]) = (&mut self.before, &mut self.after);
        [before, after].map(|field| {
            reset(field, cells);
            &mut field[..]
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An operator that takes every cell by its number: what another contact or region left behind would be seen, and so would a wrong
    /// cell.
    #[test]
    fn nothing_is_left_of_another_contact() {
        let mut through = RegionFields::<f64>::default();
        for (cells, region, fields) in
            [(&[0, 1][..], 4, 2), (&[1, 3], 4, 2), (&[1, 3], 6, 3), (&[1, 3], 4, 3), (&[0, 2, 3], 4, 3)]
        {
            // Neither of a field of the whole region.
            through.one_of_region(region)[0].fill(9.0);
            let contact = ContactSet::of(region, |cell| cells.contains(&cell));
            through.begin(&contact, region);
            let from: Vec<f64> = (0..fields * cells.len()).map(|index| 1.0 + index as f64).collect();
            let mut to = vec![9.0; from.len()];
            let packed: Vec<&[f64]> = from.chunks(cells.len()).collect();
            let mut results: Vec<&mut [f64]> = to.chunks_mut(cells.len()).collect();
            through.carry(&packed, &mut results, [0.5, 0.25], |q, u| {
                assert_eq!((q.len(), u.len()), (fields, fields));
                for (field, (q, u)) in q.iter().zip(u).enumerate() {
                    assert_eq!((q.len(), u.len()), (region, region));
                    assert!((0..region).all(|cell| cells.contains(&cell) || q[cell] == 0.0), "{q:?}");
                    (0..region).for_each(|cell| u[cell] = q[cell] * (1 + cell + 10 * field) as f64);
                }
            });
            let expected = (0..fields * cells.len()).map(|index| {
                let (field, place) = (index / cells.len(), index % cells.len());
                0.5 * ((1 + index) * (1 + cells[place] + 10 * field)) as f64
            });
            assert_eq!(to, expected.collect::<Vec<_>>());
        }
    }
}
