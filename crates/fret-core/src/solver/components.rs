//! Fields of several components over the cells in contact, packed one after the other.

use crate::model::each_cell::{Number, convert};
use crate::model::field::{add_scaled, dot, scale_and_add};

/// `K` components: pressure and both components of shear, the displacements against them, or their tangential parts alone.
#[derive(Debug, Clone)]
pub struct Components<N, const K: usize> {
    values: Vec<N>,
    len: usize,
}

impl<N, const K: usize> Default for Components<N, K> {
    fn default() -> Self {
        Self { values: Vec::new(), len: 0 }
    }
}

impl<N: Number, const K: usize> Components<N, K> {
    /// Makes room for `len` cells; what it held is lost.
    pub fn reset(&mut self, len: usize) {
        self.len = len;
        self.values.resize(K * len, N::default());
    }

    /// All zero, for `len` cells.
    pub fn clear(&mut self, len: usize) {
        self.reset(len);
        self.values.fill(N::default());
    }

    /// All components one after the other.
    pub fn values(&self) -> &[N] {
        &self.values
    }

    /// All components one after the other.
    pub fn values_mut(&mut self) -> &mut [N] {
        &mut self.values
    }

    /// The components.
    pub fn parts(&self) -> [&[N]; K] {
        let mut rest = self.values.as_slice();
        std::array::from_fn(|_| {
            let (part, others) = rest.split_at(self.len);
            rest = others;
            part
        })
    }

    /// The components.
    pub fn parts_mut(&mut self) -> [&mut [N]; K] {
        let len = self.len;
        let mut rest = self.values.as_mut_slice();
        std::array::from_fn(|_| {
            let (part, others) = std::mem::take(&mut rest).split_at_mut(len);
            rest = others;
            part
        })
    }

    /// Inner product.
    pub fn dot(&self, other: &Self) -> f64 {
        dot(&self.values, &other.values)
    }

    /// Euclidean norm.
    pub fn norm(&self) -> f64 {
        self.dot(self).sqrt()
    }

    /// `self += factor other`.
    pub fn add_scaled(&mut self, factor: f64, other: &Self) {
        add_scaled(&mut self.values, factor, &other.values);
    }

    /// `self = other + factor self`.
    pub fn scale_and_add(&mut self, factor: f64, other: &Self) {
        scale_and_add(&mut self.values, factor, &other.values);
    }

    /// Takes over another field, keeping the memory.
    pub fn copy_from(&mut self, other: &Self) {
        self.len = other.len;
        self.values.clone_from(&other.values);
    }

    /// Takes over `factor` times fields of any precision.
    pub fn convert<A: Number>(&mut self, from: [&[A]; K], factor: f64) {
        self.reset(from[0].len());
        for (to, from) in self.parts_mut().into_iter().zip(from) {
            convert(from, factor, to);
        }
    }
}
