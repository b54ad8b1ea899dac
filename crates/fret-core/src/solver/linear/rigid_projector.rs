//! What cells are free to do on fixed active sets, and the part of it that rigid motions can do: resultants are held by projection
//! (a bordered system, its border eliminated).

use crate::fields::{CellRule, Number, Reals, each_cell};

use super::super::laws::rigid_motions::RigidMotions;

/// Active sets and rotation as rules read them: stick, slip, direction, rotation; the last is empty when the bodies do not rotate.
pub type SetFields<'a, N> = [&'a [N]; 6];

/// Part of a vector that a cell is free to change: all of it in stick, its tangential part in slip.
#[inline(always)]
pub fn free_part<R: Reals>(vector: [R; 2], stick: R, slip: R, direction: [R; 2]) -> [R; 2] {
    let turn = slip * (direction[0] * vector[1] - direction[1] * vector[0]);
    [stick * vector[0] - direction[1] * turn, stick * vector[1] + direction[0] * turn]
}

/// A rigid motion of these amounts at a cell.
#[inline(always)]
pub fn rigid<R: Reals>([shift_x, shift_y, twist]: [f64; 3], [around_x, around_y]: [R; 2]) -> [R; 2] {
    [around_x * twist + shift_x, around_y * twist + shift_y]
}

/// Products of a field that is free with the free parts of the motions.
#[inline(always)]
pub fn products<R: Reals>([x, y]: [R; 2], weight: R, [around_x, around_y]: [R; 2]) -> [R; 3] {
    [x * weight, y * weight, (x * around_x + y * around_y) * weight]
}

/// Takes off a field what rigid motions that follow from resultants can do.
pub struct RigidProjector<'a, N> {
    sets: SetFields<'a, N>,
    gram: [f64; 6],
    held: [bool; 3],
}

impl<'a, N: Number> RigidProjector<'a, N> {
    /// Projector on active sets. Of equations: with their weights for the slip.
    pub fn new(motions: &RigidMotions, sets: SetFields<'a, N>) -> Self {
        let held = motions.held();
        let gram = if held.contains(&true) { each_cell(&Gram, sets, []) } else { [0.0; 6] };
        Self { sets, gram, held }
    }

    /// Keeps the free part of a field, without what rigid motions can do.
    pub fn keep_free(&self, [x, y]: [&mut [N]; 2]) {
        let products = each_cell(&KeepFree, self.sets, [&mut *x, &mut *y]);
        self.remove([x, y], products);
    }

    /// Amounts of the motions whose free parts have these products with the free parts of all.
    pub fn amounts(&self, products: [f64; 3]) -> [f64; 3] {
        if self.held.contains(&true) {
            RigidMotions::solve_of(self.held, self.gram, products)
        } else {
            [0.0; 3]
        }
    }

    /// Takes off the rigid motion whose free part has these products with the free parts of all.
    pub fn remove(&self, field: [&mut [N]; 2], products: [f64; 3]) {
        if self.held.contains(&true) {
            each_cell(&RemoveRigid(self.amounts(products)), self.sets, field);
        }
    }
}

/// Keeps the free part of a field; sums its products with the free parts of the motions.
struct KeepFree;

impl CellRule<6, 2, 3> for KeepFree {
    const OPTIONAL: usize = 2;

    #[inline(always)]
    fn at<R: Reals>(
        &self,
        [stick, slip, along_x, along_y, around_x, around_y]: [R; 6],
        [x, y]: &mut [R; 2],
    ) -> [R; 3] {
        [*x, *y] = free_part([*x, *y], stick, slip, [along_x, along_y]);
        products([*x, *y], stick + slip, [around_x, around_y])
    }
}

/// Products of the free parts of the motions: 1 in stick, of the tangential parts in slip.
struct Gram;

impl CellRule<6, 0, 6> for Gram {
    const OPTIONAL: usize = 2;

    #[inline(always)]
    fn at<R: Reals>(
        &self,
        [stick, slip, along_x, along_y, around_x, around_y]: [R; 6],
        _: &mut [R; 0],
    ) -> [R; 6] {
        let slip = slip * slip;
        let (tx, ty) = (along_y, along_x * -1.0);
        let tr = tx * around_x + ty * around_y;
        [
            stick + slip * tx * tx,
            stick + slip * ty * ty,
            stick * (around_x * around_x + around_y * around_y) + slip * tr * tr,
            slip * tx * ty,
            stick * around_x + slip * tx * tr,
            stick * around_y + slip * ty * tr,
        ]
    }
}

struct RemoveRigid([f64; 3]);

impl CellRule<6, 2, 0> for RemoveRigid {
    const OPTIONAL: usize = 2;

    #[inline(always)]
    fn at<R: Reals>(
        &self,
        [stick, slip, along_x, along_y, around_x, around_y]: [R; 6],
        [x, y]: &mut [R; 2],
    ) -> [R; 0] {
        let part = free_part(rigid(self.0, [around_x, around_y]), stick, slip, [along_x, along_y]);
        *x = *x - part[0];
        *y = *y - part[1];
        []
    }
}
