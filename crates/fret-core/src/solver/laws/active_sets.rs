//! Stick and slip: what every cell in contact does, as the linearisation of the friction law needs it.

use super::friction::{CellState, FrictionBound};
use crate::fields::{CellRule, Reals, each_cell, largest};
use crate::model::TangentialField;

/// Fraction of the largest bound below which slip stiffness grows no more: cells at the edge carry next to nothing.
const LEAST_BOUND: f64 = 1e-6;

/// Active sets of the cells in contact, packed. A cell that neither sticks nor slips just enters contact, or has no friction.
#[derive(Debug, Clone, Default)]
pub struct ActiveSets {
    /// 1 where a cell sticks, 0 elsewhere.
    pub stick: Vec<f64>,
    /// 1 where a cell slips, 0 elsewhere.
    pub slip: Vec<f64>,
    /// Direction of the shear of cells that do not stick, unit vectors; zero elsewhere.
    pub direction: TangentialField,
    /// Slip stiffness of slipping cells [length/pressure].
    pub stiffness: Vec<f64>,
    /// Weights of the equations of slipping cells, `1 / sqrt(1 + D / K)` with slip stiffness D and self-influence K, zero elsewhere: a
    /// displacement turns the shear of a stiff cell by little, and counts by as much.
    pub slip_weight: Vec<f64>,
}

impl ActiveSets {
    /// Those of feasible shear `q`, its bounds and its slip increment, all packed. `self_influence`: tangential, of a cell
    /// [length/pressure].
    pub fn of(
        q: &TangentialField,
        slip: &TangentialField,
        bound: &FrictionBound,
        self_influence: f64,
    ) -> Self {
        let mut sets = Self::default();
        sets.classify(q, slip, bound, self_influence);
        sets
    }

    /// The same, keeping the memory.
    pub fn classify(
        &mut self,
        q: &TangentialField,
        slip_increment: &TangentialField,
        bound: &FrictionBound,
        self_influence: f64,
    ) {
        let Self { stick, slip, direction, stiffness, slip_weight } = self;
        let [along_x, along_y] = direction.each_mut();
        let mut write = [stick, slip, along_x, along_y, stiffness, slip_weight];
        for field in &mut write {
            field.resize(bound.bound.len(), 0.0);
        }
        let rule =
            Classify { least: LEAST_BOUND * largest(&bound.bound), cell_stiffness: 1.0 / self_influence };
        let read = [&q.x[..], &q.y, &slip_increment.x, &slip_increment.y, &bound.bound];
        each_cell(&rule, read, write.map(Vec::as_mut_slice));
    }

    /// Number of cells in contact.
    pub fn len(&self) -> usize {
        self.stick.len()
    }
}

struct Classify {
    least: f64,
    /// 1 / K of a cell [pressure/length].
    cell_stiffness: f64,
}

impl CellRule<5, 6, 0> for Classify {
    #[inline(always)]
    fn at<R: Reals>(
        &self,
        [qx, qy, slip_x, slip_y, bound]: [R; 5],
        [stick, slip, along_x, along_y, stiffness, weight]: &mut [R; 6],
    ) -> [R; 0] {
        let cell = CellState::new([qx, qy], [slip_x, slip_y], bound, self.least);
        [*stick, *slip, *stiffness] = [cell.stick, cell.slip, cell.stiffness];
        [*along_x, *along_y] = cell.direction;
        *weight = cell.slip / (cell.stiffness * self.cell_stiffness + 1.0).sqrt();
        []
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One cell of each kind, under a bound of 2: inside the disc; on the circle and dragged outward, obliquely; on it and dragged
    /// inward; without a bound.
    #[test]
    fn cells_stick_slip_or_enter() {
        let q = TangentialField { x: vec![1.0, 2.0, 2.0, 0.0], y: vec![0.0; 4] };
        let slip = TangentialField { x: vec![0.5, 0.3, -0.3, 0.0], y: vec![0.0, 0.4, 0.4, -3.0] };
        let bound = FrictionBound { bound: vec![2.0, 2.0, 2.0, 0.0], slope: vec![0.1; 4] };
        let sets = ActiveSets::of(&q, &slip, &bound, 0.05);
        assert_eq!(sets.stick, [1.0, 0.0, 1.0, 0.0]);
        assert_eq!(sets.slip, [0.0, 1.0, 0.0, 0.0]);
        assert_eq!(sets.direction.x, [0.0, 1.0, 0.0, 0.0]);
        assert_eq!(sets.direction.y, [0.0, 0.0, 0.0, -1.0]);
        assert_eq!(sets.stiffness, [0.0, 0.15, 0.0, 0.0]);
        // 1 / sqrt(1 + 0.15 / 0.05)
        assert!((sets.slip_weight[1] - 0.5).abs() < 1e-15);
    }

    /// A cell whose bound is next to nothing is as stiff as one of a millionth of the largest bound.
    #[test]
    fn stiffness_grows_no_more_below_a_millionth_of_the_largest_bound() {
        let q = TangentialField { x: vec![4.0, 4e-9, 8e-6], y: vec![0.0; 3] };
        let slip = TangentialField { x: vec![0.2; 3], y: vec![0.0; 3] };
        let bound = FrictionBound { bound: q.x.clone(), slope: vec![0.1; 3] };
        let sets = ActiveSets::of(&q, &slip, &bound, 1.0);
        let expected = [0.2 / 4.0, 0.2 / 4e-6, 0.2 / 8e-6];
        for (found, expected) in sets.stiffness.iter().zip(expected) {
            assert!((found / expected - 1.0).abs() < 1e-14, "{:?}", sets.stiffness);
        }
    }
}
