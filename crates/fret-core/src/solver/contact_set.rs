//! The cells of a region that are in contact. Fields over them are packed: one number per cell, in the order of the cells.

use std::ops::Range;

use pulp::Arch;

use crate::fields::{Number, in_portions, pieces, reset};
use crate::model::TangentialField;

/// Numbers of straight passes that take as long as a cell of a run: its two fields are read in pieces.
const NUMBERS: usize = 5;

/// Cells in contact, as runs along the rows of the region.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct ContactSet {
    runs: Vec<Range<usize>>,
    len: usize,
}

impl ContactSet {
    /// The cells below `count` where `within`.
    pub fn of(count: usize, within: impl Fn(usize) -> bool + Sync) -> Self {
        let found = in_portions((count, NUMBERS), [], &|cells, _: [&mut [f64]; 0]| {
            joined(cells.filter(|&cell| within(cell)).map(|cell| cell..cell + 1))
        });
        let runs = joined(found.into_iter().flatten());
        let len = runs.iter().map(ExactSizeIterator::len).sum();
        Self { runs, len }
    }

    /// The cells with pressure.
    pub fn loaded(pressure: &[f64]) -> Self {
        Self::of(pressure.len(), |cell| pressure[cell] > 0.0)
    }

    /// Number of cells.
    pub fn len(&self) -> usize {
        self.len
    }

    /// The cells, in their order.
    pub fn cells(&self) -> impl Iterator<Item = usize> {
        self.runs.iter().cloned().flatten()
    }

    /// A packed copy of a field of the region.
    pub fn packed(&self, field: &[f64]) -> Vec<f64> {
        let mut packed = vec![0.0; self.len];
        self.gather(field, 1.0, &mut packed);
        packed
    }

    /// A packed copy of a tangential field of the region; of zeros where that has no cells.
    pub fn packed_tangential(&self, field: &TangentialField) -> TangentialField {
        if field.x.is_empty() {
            return TangentialField::zeros(self.len);
        }
        TangentialField { x: self.packed(&field.x), y: self.packed(&field.y) }
    }

    /// Packs a field of the region into one of any length, keeping the memory.
    pub fn pack(&self, field: &[f64], packed: &mut Vec<f64>) {
        reset(packed, self.len);
        self.gather(field, 1.0, packed);
    }

    /// Packs a tangential field of the region into one of any length, keeping the memory.
    pub fn pack_tangential(&self, field: &TangentialField, packed: &mut TangentialField) {
        self.pack(&field.x, &mut packed.x);
        self.pack(&field.y, &mut packed.y);
    }

    /// Packs `factor` times a field of the region, into any precision.
    pub fn gather<A: Number, B: Number>(&self, field: &[A], factor: f64, packed: &mut [B]) {
        copy_runs(pieces(self.len, NUMBERS), &self.runs, ([Some(0), None], false), field, factor, packed);
    }

    /// Writes `factor` times a packed field into one of the region, which keeps what it holds elsewhere, in any precision.
    pub fn place<A: Number, B: Number>(&self, packed: &[A], factor: f64, field: &mut [B]) {
        copy_runs(pieces(self.len, NUMBERS), &self.runs, ([None, Some(0)], false), packed, factor, field);
    }

    /// The same; elsewhere the field is zero after that.
    pub fn scatter<A: Number, B: Number>(&self, packed: &[A], factor: f64, field: &mut [B]) {
        copy_runs(pieces(self.len, NUMBERS), &self.runs, ([None, Some(0)], true), packed, factor, field);
    }

    /// Writes a packed tangential field into one of the region, which is zero elsewhere.
    pub fn scatter_tangential(&self, packed: &TangentialField, field: &mut TangentialField) {
        self.scatter(&packed.x, 1.0, &mut field.x);
        self.scatter(&packed.y, 1.0, &mut field.y);
    }
}

/// Neighbouring runs joined.
fn joined(runs: impl Iterator<Item = Range<usize>>) -> Vec<Range<usize>> {
    let mut joined: Vec<Range<usize>> = Vec::new();
    for run in runs {
        match joined.last_mut() {
            Some(last) if last.end == run.start => last.end = run.end,
            _ => joined.push(run),
        }
    }
    joined
}

/// The first of so many pieces of runs and the others; and how many cells the first ones have.
fn divided(runs: &[Range<usize>], pieces: usize) -> (&[Range<usize>], &[Range<usize>], usize) {
    let all: usize = runs.iter().map(ExactSizeIterator::len).sum();
    let (mut count, mut cells) = (0, 0);
    while cells < all * (pieces / 2) / pieces {
        cells += runs[count].len();
        count += 1;
    }
    let (first, others) = runs.split_at(count);
    (first, others, cells)
}

/// Where a run lies in a field: in one of the region that begins with the cell `start`, or in a packed one, behind so many cells `before`.
fn place(start: Option<usize>, run: &Range<usize>, before: usize) -> Range<usize> {
    let first = start.map_or(before, |start| run.start - start);
    first..first + run.len()
}

/// Copies `factor` times the runs of a field into another one. `starts`: with which cells of the region both begin; `None`: it is packed. What
/// lies between the runs there is cleared where `clears`.
fn copy_runs<A: Number, B: Number>(
    pieces: usize,
    runs: &[Range<usize>],
    (starts, clears): ([Option<usize>; 2], bool),
    from: &[A],
    factor: f64,
    to: &mut [B],
) {
    if pieces > 1 {
        let (first, others, cells) = divided(runs, pieces);
        if let Some(border) = others.first() {
            let [split_from, split_to] = starts.map(|start| place(start, border, cells).start);
            let (from, from_behind) = from.split_at(split_from);
            let (to, to_behind) = to.split_at_mut(split_to);
            let behind = starts.map(|start| start.map(|_| border.start));
            fret_fft::join(
                || copy_runs(pieces / 2, first, (starts, clears), from, factor, to),
                || copy_runs(pieces - pieces / 2, others, (behind, clears), from_behind, factor, to_behind),
            );
            return;
        }
    }
    Arch::new().dispatch(
        #[inline(always)]
        || {
            let (mut before, mut done) = (0, 0);
            for run in runs {
                let there = place(starts[1], run, before);
                if clears {
                    to[done..there.start].fill(B::default());
                    done = there.end;
                }
                let from = &from[place(starts[0], run, before)];
                for (to, from) in to[there].iter_mut().zip(from) {
                    *to = B::of(*from, factor);
                }
                before += run.len();
            }
            if clears {
                to[done..].fill(B::default());
            }
        },
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fields_are_packed_and_put_back_in_the_order_of_the_cells() {
        let contact = ContactSet::of(7, |cell| [1, 2, 5].contains(&cell));
        assert_eq!((contact.len(), contact.cells().collect::<Vec<_>>()), (3, vec![1, 2, 5]));
        let field = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0];
        assert_eq!(contact.packed(&field), [1.0, 2.0, 5.0]);
        let mut single = [0.0_f32; 3];
        contact.gather(&field, 2.0, &mut single);
        assert_eq!(single, [2.0, 4.0, 10.0]);
        let mut back = [9.0; 7];
        contact.place(&single, 0.5, &mut back);
        assert_eq!(back, [9.0, 1.0, 2.0, 9.0, 9.0, 5.0, 9.0]);
        contact.scatter(&[7.0, 8.0, 9.0], 1.0, &mut back);
        assert_eq!(back, [0.0, 7.0, 8.0, 0.0, 0.0, 9.0, 0.0]);
    }

    /// Neighbours are one run; no pressure is no contact.
    #[test]
    fn the_loaded_cells_are_in_contact() {
        let contact = ContactSet::loaded(&[0.0, 1.0, 2.0, -1.0, 0.0, 3.0]);
        assert_eq!((contact.len(), contact.runs.as_slice()), (3, &[1..3, 5..6][..]));
        let field =
            TangentialField { x: vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0], y: vec![0.1, 0.2, 0.3, 0.4, 0.5, 0.6] };
        let expected = TangentialField { x: vec![2.0, 3.0, 6.0], y: vec![0.2, 0.3, 0.6] };
        let mut packed = TangentialField::zeros(1);
        contact.pack_tangential(&field, &mut packed);
        assert_eq!(packed, expected);
        assert_eq!(contact.packed_tangential(&field), expected);
        let mut back = field.clone();
        contact.scatter_tangential(&expected, &mut back);
        assert_eq!(back.x, [0.0, 2.0, 3.0, 0.0, 0.0, 6.0]);
        assert_eq!(back.y, [0.0, 0.2, 0.3, 0.0, 0.0, 0.6]);
    }

    #[test]
    fn large_fields_go_the_same_way_on_many_threads() {
        let cells = 16_384;
        let contact = ContactSet::of(cells, |cell| cell % 97 < 80);
        let field: Vec<f64> = (0..cells).map(|cell| cell as f64).collect();
        rayon::ThreadPoolBuilder::new().num_threads(3).build().unwrap().install(|| {
            assert_eq!(contact, ContactSet::of(cells, |cell| cell % 97 < 80));
            let mut packed = vec![0.0; contact.len()];
            contact.gather(&field, 2.0, &mut packed);
            assert!(packed.iter().zip(contact.cells()).all(|(value, cell)| *value == 2.0 * cell as f64));
            let mut back = vec![-1.0; cells];
            contact.place(&packed, 0.5, &mut back);
            let expected = |cell: usize| if cell % 97 < 80 { cell as f64 } else { -1.0 };
            assert!(back.iter().enumerate().all(|(cell, value)| *value == expected(cell)));
            contact.scatter(&packed, 0.5, &mut back);
            assert!(back.iter().enumerate().all(|(cell, value)| *value == expected(cell).max(0.0)));
        });
    }
}
