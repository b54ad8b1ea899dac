//! Fields as results: the sum over the cells of the grid of a field, tractions, slip or wear depth, each times its weight.

use std::ops::RangeInclusive;
use std::sync::Arc;

use ndarray::Array2;

use super::error::SensitivityError;
use super::scene::{Scene, field};
use super::snapshot::Snapshot;
use crate::model::Symmetry;
use crate::plan::Plan;

/// Fields whose sums have derivatives.
pub const FIELDS: [&str; 6] = ["pressure", "shear_x", "shear_y", "slip_x", "slip_y", "worn_depth"];

/// The place of slip along x, beside which that along y stands: here accumulated, in a column of an increment its own.
pub(super) const SLIP: usize = 3;
/// The place of the wear depth of both bodies together.
pub(super) const WORN: usize = 5;

/// A field of an increment, and the weight of each cell.
#[derive(Debug, Clone)]
pub(super) struct FieldWeights {
    /// `None`: the last one.
    increment: Option<usize>,
    /// Its place in [`FIELDS`].
    field: usize,
    /// Over the cells in front of the mirrors, each with what lies behind them.
    weights: Array2<f64>,
}

/// The same in the region of a history.
#[derive(Debug, Clone)]
pub(super) struct RegionWeights {
    pub field: usize,
    /// Shared by the increments that it is the sum of.
    pub weights: Arc<[f64]>,
}

impl FieldWeights {
    /// Those of a field by its name (`pressure`, `increments[7].shear_x`), of all cells of the grid of a plan.
    pub fn new(name: &str, weights: &Array2<f64>, plan: &Plan) -> Result<Self, SensitivityError> {
        let refused = |reason: String| SensitivityError::Objective { name: name.to_owned(), reason };
        let (increment, field) = match name.strip_prefix("increments[") {
            None => (None, name),
            Some(rest) => {
                let form = || refused("written as increments[7].pressure".to_owned());
                let (number, field) = rest.split_once("].").ok_or_else(form)?;
                (Some(number.parse().map_err(|_| form())?), field)
            }
        };
        let field = FIELDS.iter().position(|known| *known == field).ok_or_else(|| {
            refused(format!("no field whose sum has derivatives; of these each has: {}", FIELDS.join(", ")))
        })?;
        if field == WORN && plan.case.wear.is_none() {
            return Err(refused("nothing wears in this case".to_owned()));
        }
        let [rows, columns] = plan.grid.cells();
        if weights.dim() != (rows, columns) {
            let (found_rows, found_columns) = weights.dim();
            return Err(refused(format!(
                "{found_rows} x {found_columns} weights, but the grid has {rows} x {columns} cells"
            )));
        }
        if let Some(value) = weights.iter().find(|value| !value.is_finite()) {
            return Err(refused(format!("a weight is {value}: must be finite")));
        }
        Ok(Self { increment, ..Self::of(field, weights, plan) })
    }

    /// Those of a field by its place in [`FIELDS`], of all cells of the grid of a plan, in the last increment.
    pub fn of(field: usize, weights: &Array2<f64>, plan: &Plan) -> Self {
        let odd = match field {
            0 | WORN => [false; 2],
            component => plan.symmetry.shear_is_odd((component - 1) % 2),
        };
        Self { increment: None, field, weights: folded(weights, plan.symmetry, odd) }
    }

    /// Number of the increment in a history of so many.
    pub fn increment(&self, name: &str, steps: usize) -> Result<usize, SensitivityError> {
        let increment = self.increment.unwrap_or(steps.saturating_sub(1));
        if increment < steps {
            return Ok(increment);
        }
        let reason = format!("the history has {steps} increments, from 0");
        Err(SensitivityError::Objective { name: name.to_owned(), reason })
    }

    /// The sum in an increment.
    pub fn value(&self, step: &Snapshot) -> f64 {
        let state = step.state();
        let ([x, y], [slip_x, slip_y]) = (&state.shear, &state.slip);
        let fields =
            [Some(&state.pressure), Some(x), Some(y), Some(slip_x), Some(slip_y), step.worn.as_deref()];
        let sum =
            |field: &Array2<f64>| self.weights.iter().zip(field).map(|(weight, value)| weight * value).sum();
        // Where nothing wears nothing is worn.
        fields[self.field].map_or(0.0, sum)
    }

    /// Increments whose columns make the sum in one: of slip, which is accumulated, all up to it.
    pub fn increments(&self, increment: usize) -> RangeInclusive<usize> {
        if self.is_slip() { 0..=increment } else { increment..=increment }
    }

    /// Whether it is slip.
    pub fn is_slip(&self) -> bool {
        (SLIP..WORN).contains(&self.field)
    }

    /// The weights in the region of a history: tractions are none beyond it.
    pub fn in_region(&self, scene: &Scene<'_>) -> RegionWeights {
        let (weights, _) = field(scene.region, &self.weights).into_raw_vec_and_offset();
        RegionWeights { field: self.field, weights: weights.into() }
    }
}

/// Weights of cells with those of their mirror images, the latter with the other sign along axes where the field is odd.
fn folded(weights: &Array2<f64>, symmetry: Symmetry, odd: [bool; 2]) -> Array2<f64> {
    let mut folded = symmetry.part(weights);
    let (axes, [rows, columns]) = (symmetry.axes(), [weights.nrows(), weights.ncols()]);
    let first = symmetry.part_of([rows, columns]).map(|part| part.max(1));
    let start = [rows - first[0], columns - first[1]];
    for ((i, j), sum) in folded.indexed_iter_mut() {
        for image in 1..4 {
            let behind = [image & 1 > 0, image & 2 > 0];
            if (0..2).any(|axis| behind[axis] && !axes[axis]) {
                continue;
            }
            let place = [start[0] + i, start[1] + j];
            let [at_x, at_y] = [0, 1]
                .map(|axis| if behind[axis] { [rows, columns][axis] - 1 - place[axis] } else { place[axis] });
            let turns = (behind[0] && odd[0]) != (behind[1] && odd[1]);
            *sum += if turns { -weights[[at_x, at_y]] } else { weights[[at_x, at_y]] };
        }
    }
    folded
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fields::dot;
    use crate::random::Random;

    /// The sum over the part in front of the mirrors is that over the whole field that goes on behind them.
    #[test]
    fn weights_are_folded_as_the_field_goes_on() {
        let mut random = Random::seeded(5);
        for symmetry in [
            Symmetry::NONE,
            Symmetry { odd_shear: [None, Some(1)] },
            Symmetry { odd_shear: [Some(0), Some(1)] },
        ] {
            for odd in [[false; 2], [true, false], [true, true]] {
                let weights = Array2::from_shape_simple_fn((6, 8), || random.between(-1.0, 1.0));
                let [rows, columns] = symmetry.part_of([6, 8]);
                let part = Array2::from_shape_simple_fn((rows, columns), || random.between(-1.0, 1.0));
                let flat = |field: &Array2<f64>| field.iter().copied().collect::<Vec<_>>();
                let whole = dot(&flat(&weights), &flat(&symmetry.whole(&part, odd)));
                let found = dot(&flat(&folded(&weights, symmetry, odd)), &flat(&part));
                assert!((whole - found).abs() < 1e-13, "{symmetry:?} {odd:?}: {whole} {found}");
            }
        }
    }
}
