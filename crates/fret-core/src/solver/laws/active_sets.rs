//! Stick and slip: what every cell in contact does, as the linearisation of the friction law needs it.

use super::friction::{CellState, FrictionBound, Limits};
use super::slip_path::{SlipPath, row_of_chord};
use crate::fields::{CellRule, Reals, each_cell, largest, reset};
use crate::model::TangentialField;

/// Fraction of the largest bound below which slip compliance grows no more: cells at the edge carry next to nothing.
const LEAST_BOUND: f64 = 1e-6;
/// Fraction of the largest bound below which a cell barely touches: the pressure of a sphere at a twenty-thousandth of the radius from the
/// edge of contact. Far from a solution such cells are not asked to stick; near it they are, since several of them may have to.
const BARELY: f64 = 0.01;

/// Active sets of the cells in contact, packed. A cell that neither sticks nor slips just enters contact, or has no friction.
#[derive(Debug, Clone, Default)]
pub struct ActiveSets {
    /// 1 where a cell sticks, 0 elsewhere.
    pub stick: Vec<f64>,
    /// 1 where a cell slips, 0 elsewhere.
    pub slip: Vec<f64>,
    /// Direction of the shear of cells that do not stick, unit vectors; zero elsewhere.
    pub direction: TangentialField,
    /// In place of the direction where slip turns: see [`ActiveSets::turn`].
    turned: TangentialField,
    /// Whether any does.
    turns: bool,
    /// Slip compliance of slipping cells [length/pressure].
    pub slip_compliance: Vec<f64>,
    /// Weights of the equations of slipping cells, `1 / sqrt(1 + D / K)` with slip compliance D and self-influence K, zero elsewhere: a
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
        sets.classify(q, slip, bound, (self_influence, false));
        sets
    }

    /// The same, keeping the memory; `far` from a solution cells that [barely touch](Limits::barely) do not stick.
    pub fn classify(
        &mut self,
        q: &TangentialField,
        slip_increment: &TangentialField,
        bound: &FrictionBound,
        (self_influence, far): (f64, bool),
    ) {
        let Self { stick, slip, direction, slip_compliance, slip_weight, .. } = self;
        let [along_x, along_y] = direction.each_mut();
        let mut write = [stick, slip, along_x, along_y, slip_compliance, slip_weight];
        for field in &mut write {
            reset(field, bound.bound.len());
        }
        let largest = largest(&bound.bound);
        let barely = if far { BARELY * largest } else { 0.0 };
        let limits = Limits { least: LEAST_BOUND * largest, barely, stiffness: 1.0 / self_influence };
        let read = [&q.x[..], &q.y, &slip_increment.x, &slip_increment.y, &bound.bound];
        each_cell(&Classify(limits), read, write.map(Vec::as_mut_slice));
    }

    /// Those of trial shear `q + slip / K`, which need not be feasible: cells stick inside their discs and slip along it outside.
    pub fn of_trial(trial: &TangentialField, bound: &FrictionBound, self_influence: f64) -> Self {
        let cells = bound.bound.len();
        let field = || vec![0.0; cells];
        let [stick, slip, slip_compliance, slip_weight] = [field(), field(), field(), field()];
        let direction = TangentialField::zeros(cells);
        let mut sets = Self { stick, slip, direction, slip_compliance, slip_weight, ..Self::default() };
        let least = LEAST_BOUND * largest(&bound.bound);
        for (cell, &bound) in bound.bound.iter().enumerate() {
            let trial = trial.at(cell);
            let size = trial[0].hypot(trial[1]);
            if bound > 0.0 && size <= bound {
                sets.stick[cell] = 1.0;
                continue;
            }
            if size > 0.0 {
                sets.direction.set(cell, trial.map(|part| part / size));
            }
            if bound > 0.0 {
                let stretched = (size - bound) / bound.max(least);
                sets.slip[cell] = 1.0;
                sets.slip_compliance[cell] = self_influence * stretched;
                sets.slip_weight[cell] = 1.0 / (1.0 + stretched).sqrt();
            }
        }
        sets
    }

    /// Takes into account how slip turns on its `path`; `slip`: what is not yet turned, packed [length].
    pub fn turn(&mut self, path: &SlipPath, slip: &TangentialField) {
        self.turns = path.turns();
        if !self.turns {
            return;
        }
        let Self { slip: slips, direction, turned, .. } = self;
        let write = turned.each_mut().map(|field| {
            reset(field, slips.len());
            &mut field[..]
        });
        let ([along_x, along_y], [turn_x, turn_y]) = (direction.parts(), path.turn.parts());
        each_cell(&Turned, [slips, &slip.x, &slip.y, turn_x, turn_y, along_x, along_y], write);
    }

    /// In place of the direction of shear, where slip turns, the vector of the same cell across which a change of slip is as much as that of
    /// the slip at the end across the shear. `None` where none turns.
    pub fn turned(&self) -> Option<[&[f64]; 2]> {
        self.turns.then(|| self.turned.parts())
    }

    /// These vectors, or the direction of shear.
    pub fn rows(&self) -> [&[f64]; 2] {
        self.turned().unwrap_or_else(|| self.direction.parts())
    }

    /// The one of a cell.
    pub fn row(&self, cell: usize) -> [f64; 2] {
        self.rows().map(|row| row[cell])
    }

    /// Puts shear of cells that neither stick nor slip on their circles, along their slip.
    pub fn direct(&self, shear: &mut TangentialField, bound: &[f64]) {
        let [along_x, along_y] = self.direction.parts();
        each_cell(&Directed, [&self.stick, &self.slip, along_x, along_y, bound], shear.parts_mut());
    }

    /// Number of cells in contact.
    pub fn len(&self) -> usize {
        self.stick.len()
    }
}

struct Classify(Limits);

impl CellRule<5, 6, 0> for Classify {
    #[inline(always)]
    fn at<R: Reals>(
        &self,
        [qx, qy, slip_x, slip_y, bound]: [R; 5],
        [stick, slip, along_x, along_y, slip_compliance, weight]: &mut [R; 6],
    ) -> [R; 0] {
        let cell = CellState::new([qx, qy], [slip_x, slip_y], bound, &self.0);
        [*stick, *slip, *slip_compliance] = [cell.stick, cell.slip, cell.slip_compliance];
        [*along_x, *along_y] = cell.direction;
        *weight = cell.slip / (cell.slip_compliance * self.0.stiffness + 1.0).sqrt();
        []
    }
}

/// The bound along the direction, where a cell neither sticks nor slips.
struct Directed;

impl CellRule<5, 2, 0> for Directed {
    #[inline(always)]
    fn at<R: Reals>(&self, [stick, slip, along_x, along_y, bound]: [R; 5], [x, y]: &mut [R; 2]) -> [R; 0] {
        let zero = bound.all(0.0);
        let either = stick + slip;
        *x = either.if_at_most(zero, bound * along_x, *x);
        *y = either.if_at_most(zero, bound * along_y, *y);
        []
    }
}

/// The direction of shear, where the cell slips and turns the one across which its change of slip counts.
struct Turned;

impl CellRule<7, 2, 0> for Turned {
    #[inline(always)]
    fn at<R: Reals>(
        &self,
        [slips, slip_x, slip_y, turn_x, turn_y, along_x, along_y]: [R; 7],
        [x, y]: &mut [R; 2],
    ) -> [R; 0] {
        let zero = slips.all(0.0);
        let [row_x, row_y] = row_of_chord([slip_x, slip_y], [turn_x, turn_y], [along_y * -1.0, along_x]);
        *x = slips.if_at_most(zero, along_x, row_y);
        *y = slips.if_at_most(zero, along_y, row_x * -1.0);
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
        assert_eq!(sets.slip_compliance, [0.0, 0.15, 0.0, 0.0]);
        // 1 / sqrt(1 + 0.15 / 0.05)
        assert!((sets.slip_weight[1] - 0.5).abs() < 1e-15);
    }

    /// Differences of the slip at the end, across the shear, of cells that slip and turn: 20 degrees off their last slip, along it, beyond the
    /// angle from which on nothing turns; of cells that stick or enter the direction of shear. Without a path as if nothing turned.
    #[test]
    fn rows_are_those_of_the_slip_at_the_end() {
        let chords = [[1.0, 0.36], [1.0, 0.0], [-0.3, 1.0], [0.2, 0.1], [0.0, -3.0]];
        let mut path = SlipPath::straight(chords.len());
        (0..chords.len()).for_each(|cell| path.go_on(cell, [0.7, 0.0], (1.0, 0.05, 1.0)));
        let slip = TangentialField { x: chords.map(|c| c[0]).to_vec(), y: chords.map(|c| c[1]).to_vec() };
        let shear = [[1.2, 1.6], [2.0, 0.0], [0.0, 2.0], [1.0, 0.0], [0.0, 0.0]];
        let q = TangentialField { x: shear.map(|q| q[0]).to_vec(), y: shear.map(|q| q[1]).to_vec() };
        let bound = FrictionBound { bound: vec![2.0, 2.0, 2.0, 2.0, 0.0], slope: vec![0.1; 5] };
        let mut sets = ActiveSets::of(&q, &slip, &bound, 0.05);
        assert_eq!(sets.rows(), sets.direction.parts());
        sets.turn(&path, &slip);
        let [row_x, row_y] = sets.rows();
        for (cell, chord) in chords.into_iter().enumerate() {
            let (row, along) = ([-row_y[cell], row_x[cell]], sets.direction.at(cell));
            let across = [-along[1], along[0]];
            if sets.slip[cell] == 0.0 {
                assert_eq!(row, across);
                continue;
            }
            for axis in 0..2 {
                let mut there = chord;
                there[axis] += 1e-6;
                let [one, other] = [chord, there].map(|slip| path.end_of(cell, slip));
                let change = (0..2).map(|k| across[k] * (other[k] - one[k])).sum::<f64>() / 1e-6;
                assert!((row[axis] - change).abs() < 1e-5, "{cell}: {row:?} {change}");
            }
        }
        assert!((row_x[0].hypot(row_y[0]) - 1.0).abs() > 0.05);
        sets.classify(&q, &slip, &bound, (0.05, false));
        sets.turn(&SlipPath::default(), &slip);
        assert_eq!(sets.turned(), None);
    }

    /// Cells under bounds of 100, 1 and 0.9, with 1 / K = 2: of those that barely touch, dragged inward or inside their discs, those stick that
    /// `q + 2 slip` leaves inside; the others, and what just enters, have their bound along their slip. Near a solution all stick.
    #[test]
    fn far_from_a_solution_cells_that_barely_touch_stick_only_inside_their_discs() {
        let shear = [[50.0, 0.0], [-1.0, 0.0], [0.0, 0.4], [0.9, 0.0], [0.5, 0.0], [0.0, 0.0]];
        let slips = [[9e3, 0.0], [3.0, 4.0], [0.0, 0.1], [4.0, 0.0], [0.0, -2.0], [0.0, 5.0]];
        let field = |values: [[f64; 2]; 6]| TangentialField {
            x: values.map(|value| value[0]).to_vec(),
            y: values.map(|value| value[1]).to_vec(),
        };
        let bound = FrictionBound { bound: vec![100.0, 1.0, 1.0, 0.9, 0.9, 0.0], slope: vec![0.1; 6] };
        let (mut q, slip) = (field(shear), field(slips));
        let mut sets = ActiveSets::default();
        sets.classify(&q, &slip, &bound, (0.5, false));
        assert_eq!(sets.stick, [1.0, 1.0, 1.0, 0.0, 1.0, 0.0]);
        sets.classify(&q, &slip, &bound, (0.5, true));
        assert_eq!(sets.stick, [1.0, 0.0, 1.0, 0.0, 0.0, 0.0]);
        assert_eq!(sets.slip, [0.0, 0.0, 0.0, 1.0, 0.0, 0.0]);
        sets.direct(&mut q, &bound.bound);
        for (cell, expected) in
            [(0, shear[0]), (1, [0.6, 0.8]), (2, shear[2]), (3, shear[3]), (4, [0.0, -0.9])]
        {
            assert!((0..2).all(|axis| (q.at(cell)[axis] - expected[axis]).abs() < 1e-15), "{cell} {q:?}");
        }
        assert_eq!((q.at(5), sets.direction.at(5)), ([0.0; 2], [0.0, 1.0]));
    }

    /// A cell whose bound is next to nothing is as stiff as one of a millionth of the largest bound.
    #[test]
    fn slip_compliance_grows_no_more_below_a_millionth_of_the_largest_bound() {
        let q = TangentialField { x: vec![4.0, 4e-9, 8e-6], y: vec![0.0; 3] };
        let slip = TangentialField { x: vec![0.2; 3], y: vec![0.0; 3] };
        let bound = FrictionBound { bound: q.x.clone(), slope: vec![0.1; 3] };
        let sets = ActiveSets::of(&q, &slip, &bound, 1.0);
        let expected = [0.2 / 4.0, 0.2 / 4e-6, 0.2 / 8e-6];
        for (found, expected) in sets.slip_compliance.iter().zip(expected) {
            assert!((found / expected - 1.0).abs() < 1e-14, "{:?}", sets.slip_compliance);
        }
    }
}
