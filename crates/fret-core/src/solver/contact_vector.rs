//! Vectors over the cells in contact: tractions, the displacements against them, residuals.

use crate::fields::{Number, convert, norm, reset, scale};

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
        scale(&mut self.values, factor);
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
}
