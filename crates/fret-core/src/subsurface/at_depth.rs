//! A parameter of fatigue under the cells of one depth: everywhere, along a row, or its largest value alone, which bounds find without
//! looking at all cells.

use ndarray::Array2;
use rayon::prelude::*;

use super::fatigue::{Bounds, Evaluated, FatigueConstants, Parameter};
use super::tensor::{StressField, StressTensor};
use crate::model::ElasticMaterial;

/// Cells whose bound is a smaller fraction of the largest value of a depth are not evaluated where only large values count.
const FAR_BELOW: f64 = 0.6;
/// Cells evaluated at once where the largest value is looked for; then twice as many, and so on.
const FIRST_TOGETHER: usize = 64;
/// Fewest cells that are worth a thread where little is computed.
const FEWEST: usize = 1024;

/// The cycle under a cell.
pub(super) fn cycle_at(fields: &[StressField], [i, j]: [usize; 2]) -> Vec<StressTensor> {
    fields.iter().map(|field| field.at(i, j)).collect()
}

/// A parameter in the material of a depth, under all cells.
pub(super) struct AtDepth<'a> {
    pub(super) parameter: Parameter,
    pub(super) material: ElasticMaterial,
    pub(super) constants: FatigueConstants,
    /// Of the cycle under every cell, row by row.
    pub(super) bounds: &'a [Bounds],
}

impl AtDepth<'_> {
    fn value(&self, cycle: &[StressTensor]) -> f64 {
        let found: Option<Evaluated> = self.parameter.of(cycle, &self.material, &self.constants);
        found.map_or(0.0, |found| found.value)
    }

    /// Values under all cells. But for cells that are wanted `exactly`, one whose bound is less than [`FAR_BELOW`] times the largest value
    /// takes its bound: never too small.
    pub(super) fn everywhere(
        &self,
        fields: &[StressField],
        exactly: impl Fn(usize) -> bool + Sync,
    ) -> Array2<f64> {
        let (nx, ny) = fields.first().map_or((0, 0), |field| field.components[0].dim());
        let bounds = if (0..nx * ny).all(&exactly) { Vec::new() } else { self.bounds() };
        let largest = self.largest_within(fields, &bounds, f64::NEG_INFINITY);
        let floor = largest.map_or(f64::NEG_INFINITY, |(_, value)| FAR_BELOW * value);
        let value = |cell: usize| match bounds.get(cell) {
            Some(&bound) if floor > 0.0 && bound <= floor && !exactly(cell) => bound,
            _ => self.value(&cycle_at(fields, [cell / ny, cell % ny])),
        };
        let values: Vec<f64> = (0..nx * ny).into_par_iter().map(value).collect();
        Array2::from_shape_vec((nx, ny), values).unwrap_or_else(|_| Array2::zeros((nx, ny)))
    }

    /// Values along a row of cells, shape `(nx, 1)`.
    pub(super) fn in_row(&self, fields: &[StressField], row: usize) -> Array2<f64> {
        let nx = fields.first().map_or(0, |field| field.components[0].nrows());
        let values: Vec<f64> =
            (0..nx).into_par_iter().map(|i| self.value(&cycle_at(fields, [i, row]))).collect();
        Array2::from_shape_vec((nx, 1), values).unwrap_or_else(|_| Array2::zeros((nx, 1)))
    }

    /// The largest value above a known one, and its cell.
    pub(super) fn largest(&self, fields: &[StressField], known: f64) -> Option<([usize; 2], f64)> {
        self.largest_within(fields, &self.bounds(), known)
    }

    /// Bounds of the values under all cells, row by row.
    fn bounds(&self) -> Vec<f64> {
        let bound = |bounds: &Bounds| bounds.on(self.parameter, &self.material, &self.constants);
        self.bounds.par_iter().with_min_len(FEWEST).map(bound).collect()
    }

    /// The same with the bounds of all cells: the most promising cells come first, and those whose bound lies below what is found are
    /// passed over. Of equal values that of the first cell.
    fn largest_within(
        &self,
        fields: &[StressField],
        bounds: &[f64],
        known: f64,
    ) -> Option<([usize; 2], f64)> {
        let ny = fields.first().map_or(0, |field| field.components[0].ncols());
        let value = |cell: usize| self.value(&cycle_at(fields, [cell / ny, cell % ny]));
        let most = |one: (f64, usize), other: (f64, usize)| if other.0 > one.0 { other } else { one };
        let (bound, promising) = bounds.iter().copied().zip(0..).reduce(most)?;
        if bound <= known {
            return None;
        }
        let first = value(promising);
        let mut best = (first > known).then_some((first, promising));
        let least = first.max(known);
        let mut others: Vec<(f64, usize)> = bounds
            .iter()
            .copied()
            .zip(0..)
            .filter(|(bound, cell)| *bound > least && *cell != promising)
            .collect();
        others.sort_unstable_by(|one, other| other.0.total_cmp(&one.0).then(one.1.cmp(&other.1)));
        let (mut rest, mut count) = (others.as_slice(), FIRST_TOGETHER);
        while !rest.is_empty() {
            let (here, behind) = rest.split_at(count.min(rest.len()));
            let least = best.map_or(known, |(value, _)| value);
            let here = &here[..here.partition_point(|(bound, _)| *bound > least)];
            if here.is_empty() {
                break;
            }
            let values: Vec<f64> = here.par_iter().map(|(_, cell)| value(*cell)).collect();
            for (value, (_, cell)) in values.into_iter().zip(here) {
                let is_more = |(most, at): (f64, usize)| value > most || (value == most && *cell < at);
                if best.map_or(value > known, is_more) {
                    best = Some((value, *cell));
                }
            }
            (rest, count) = (behind, 2 * count);
        }
        best.map(|(value, cell)| ([cell / ny, cell % ny], value))
    }
}

/// Bounds of the cycles under all cells, row by row.
pub(super) fn bounds_of(fields: &[StressField], material: &ElasticMaterial) -> Vec<Bounds> {
    let (nx, ny) = fields.first().map_or((0, 0), |field| field.components[0].dim());
    let cells = (0..nx * ny).into_par_iter().with_min_len(FEWEST);
    let bounds = |cycle: &mut Vec<StressTensor>, cell: usize| {
        cycle.clear();
        cycle.extend(fields.iter().map(|field| field.at(cell / ny, cell % ny)));
        Bounds::of(cycle, material)
    };
    cells.map_init(Vec::new, bounds).collect()
}
