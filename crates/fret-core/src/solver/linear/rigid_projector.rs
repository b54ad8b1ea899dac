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
        let held = motions.loads.held();
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

#[cfg(test)]
mod tests {
    use super::super::super::contact_set::ContactSet;
    use super::super::super::laws::rigid_motions::CellPositions;
    use super::super::super::prescribed::TangentialLoads;
    use super::*;

    /// Twelve cells: sticking, slipping in different directions with weights, and neither.
    fn sets() -> [Vec<f64>; 4] {
        let kind = |cell: usize| cell % 3;
        let stick = (0..12).map(|cell| f64::from(u8::from(kind(cell) == 0))).collect();
        let slip = (0..12).map(|cell| if kind(cell) == 1 { 1.0 - 0.05 * cell as f64 } else { 0.0 }).collect();
        let angle = |cell: usize| 0.7 * cell as f64;
        let along = |part: fn(f64) -> f64| {
            (0..12).map(|cell| if kind(cell) == 0 { 0.0 } else { part(angle(cell)) }).collect()
        };
        [stick, slip, along(f64::cos), along(f64::sin)]
    }

    /// What is kept is free, has no resultant on the motions that are held, and is kept as it is the second time; a rigid motion is taken
    /// off whole. Motions by springs and prescribed ones are not taken off.
    #[test]
    fn what_is_kept_has_no_resultants() {
        let [stick, slip, along_x, along_y] = sets();
        for (held, spring) in [
            ([true, true, true], [0.0; 3]),
            ([true, true, false], [0.0; 3]),
            ([false, true, true], [0.0; 3]),
            ([true, true, true], [0.0, 1.0, 0.0]),
            ([false; 3], [0.0; 3]),
        ] {
            let loads = TangentialLoads { by_force: held, spring, ..TangentialLoads::default() };
            let motions = CellPositions::new(vec![-1.0, -0.2, 0.9], vec![-0.8, -0.1, 0.4, 1.1], held[2])
                .motions_of(&ContactSet::of(12, |_| true), loads);
            let [around_x, around_y] = motions.rotation.parts();
            let fields: SetFields<'_, f64> = [&stick, &slip, &along_x, &along_y, around_x, around_y];
            // Of slipping cells with weights the free part carries the weight.
            let unweighted: Vec<f64> = slip.iter().map(|slip| f64::from(u8::from(*slip > 0.0))).collect();
            let plain: SetFields<'_, f64> = [&stick, &unweighted, &along_x, &along_y, around_x, around_y];
            let projector = RigidProjector::new(&motions, plain);
            let mut x: Vec<f64> = (0..12).map(|cell| (1.3 * f64::from(cell)).sin()).collect();
            let mut y: Vec<f64> = (0..12).map(|cell| (0.4 * f64::from(cell)).cos()).collect();
            let given = (x.clone(), y.clone());
            projector.keep_free([&mut x, &mut y]);
            let mut sums = [0.0; 3];
            for cell in 0..12 {
                // Along its slip a cell is not free, and one that neither sticks nor slips is not at all.
                let off = (1.0 - stick[cell]) * (x[cell] * along_x[cell] + y[cell] * along_y[cell]);
                assert!(off.abs() < 1e-14, "{cell}: {off}");
                assert!(stick[cell] + slip[cell] > 0.0 || (x[cell], y[cell]) == (0.0, 0.0));
                let [a, b] = if held[2] { motions.rotation.at(cell) } else { [0.0; 2] };
                sums = [sums[0] + x[cell], sums[1] + y[cell], sums[2] + x[cell] * a + y[cell] * b];
            }
            for mode in 0..if held[2] { 3 } else { 2 } {
                let is_held = held[mode] && spring[mode] == 0.0;
                // The diagonal of the system has a relative 1e-13 more.
                assert_eq!(sums[mode].abs() < 1e-11, is_held, "{held:?} {spring:?} {mode}: {:e}", sums[mode]);
            }
            let (again_x, again_y) = (x.clone(), y.clone());
            projector.keep_free([&mut x, &mut y]);
            assert!((0..12).all(|c| (x[c] - again_x[c]).abs() < 1e-11 && (y[c] - again_y[c]).abs() < 1e-11));
            // What was taken off is the free part of a rigid motion of the amounts said.
            let free = |cell: usize, [x, y]: [f64; 2]| {
                let turn = unweighted[cell] * (along_x[cell] * y - along_y[cell] * x);
                [stick[cell] * x - along_y[cell] * turn, stick[cell] * y + along_x[cell] * turn]
            };
            let mut products = [0.0; 3];
            for cell in 0..12 {
                let [x, y] = free(cell, [given.0[cell], given.1[cell]]);
                let [a, b] = if held[2] { motions.rotation.at(cell) } else { [0.0; 2] };
                products = [products[0] + x, products[1] + y, products[2] + x * a + y * b];
            }
            let amounts = projector.amounts(products);
            for cell in 0..12 {
                let [u, v] = free(cell, [given.0[cell], given.1[cell]]);
                let [p, q] = free(cell, motions.at(amounts, cell));
                assert!((u - p - x[cell]).abs() < 1e-11 && (v - q - y[cell]).abs() < 1e-11, "{cell}");
            }
            // With weights the amounts of a motion's own products are those of the motion.
            let weighted = RigidProjector::new(&motions, fields);
            let amounts =
                [0, 1, 2].map(|mode| if loads.held()[mode] { 0.4 - 0.5 * mode as f64 } else { 0.0 });
            let mut products = [0.0; 3];
            for cell in 0..12 {
                let [a, b] = if held[2] { motions.rotation.at(cell) } else { [0.0; 2] };
                let [dx, dy] = motions.at(amounts, cell);
                let turn = slip[cell] * slip[cell] * (along_x[cell] * dy - along_y[cell] * dx);
                let [u, v] =
                    [stick[cell] * dx - along_y[cell] * turn, stick[cell] * dy + along_x[cell] * turn];
                products = [products[0] + u, products[1] + v, products[2] + u * a + v * b];
            }
            for (found, known) in weighted.amounts(products).iter().zip(amounts) {
                assert!((found - known).abs() < 1e-11, "{found} {known}");
            }
        }
    }
}
