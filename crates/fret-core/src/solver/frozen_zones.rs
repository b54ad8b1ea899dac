//! Frozen zones as an inner solver reads them: packed, in the precision it works in; and the part of rigid motions on them that
//! follows from resultants.

use super::rigid::RigidModes;
use super::zones::Zones;
use crate::model::each_cell::{CellRule, Number, Reals, convert, each_cell};

/// What cells in contact are free to do.
#[derive(Debug, Default)]
pub struct FrozenZones<N> {
    /// 1 where a cell sticks, 0 elsewhere.
    pub stick: Vec<N>,
    /// 1 where a cell slips, 0 elsewhere.
    pub slip: Vec<N>,
    /// Weights of the equations of slipping cells, zero elsewhere.
    pub weighted_slip: Vec<N>,
    /// Direction of the shear of cells that do not stick, zero elsewhere.
    pub direction: [Vec<N>; 2],
    /// Slip stiffness, in the units of the problem.
    pub stiffness: Vec<N>,
    /// Rotation about z; empty when the bodies do not rotate.
    pub rotation: [Vec<N>; 2],
}

impl<N: Number> FrozenZones<N> {
    /// Takes over zones and rotation; `compliance` is the unit of slip stiffness [length/pressure].
    pub fn take(&mut self, zones: &Zones, modes: &RigidModes, compliance: f64) {
        let take = |from: &[f64], factor: f64, to: &mut Vec<N>| {
            to.resize(from.len(), N::default());
            convert(from, factor, to);
        };
        take(&zones.stick, 1.0, &mut self.stick);
        take(&zones.slip, 1.0, &mut self.slip);
        take(&zones.weighted_slip, 1.0, &mut self.weighted_slip);
        take(&zones.stiffness, 1.0 / compliance, &mut self.stiffness);
        for (from, to) in zones.direction.parts().into_iter().zip(&mut self.direction) {
            take(from, 1.0, to);
        }
        for (from, to) in modes.rotation.parts().into_iter().zip(&mut self.rotation) {
            take(from, 1.0, to);
        }
    }

    /// Number of cells in contact.
    pub fn len(&self) -> usize {
        self.stick.len()
    }

    /// What rules read.
    pub fn parts(&self) -> ZoneParts<'_, N> {
        let ([along_x, along_y], [around_x, around_y]) = (&self.direction, &self.rotation);
        [&self.stick, &self.slip, along_x, along_y, around_x, around_y]
    }
}

/// Part of a vector that a cell is free to change.
#[inline(always)]
pub fn free_part<R: Reals>(vector: [R; 2], stick: R, slip: R, direction: [R; 2]) -> [R; 2] {
    let turn = slip * (direction[0] * vector[1] - direction[1] * vector[0]);
    [stick * vector[0] - direction[1] * turn, stick * vector[1] + direction[0] * turn]
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

/// Products of a field that is free with the free parts of the motions.
#[inline(always)]
pub fn products<R: Reals>([x, y]: [R; 2], weight: R, [around_x, around_y]: [R; 2]) -> [R; 3] {
    [x * weight, y * weight, (x * around_x + y * around_y) * weight]
}

/// What a rule reads of frozen zones: stick, slip, direction, rotation; the last is empty when the bodies do not rotate.
pub type ZoneParts<'a, N> = [&'a [N]; 6];

/// Those of zones as they were found.
pub fn parts_of<'a>(zones: &'a Zones, modes: &'a RigidModes) -> ZoneParts<'a, f64> {
    let ([along_x, along_y], [around_x, around_y]) = (zones.direction.parts(), modes.rotation.parts());
    [&zones.stick, &zones.slip, along_x, along_y, around_x, around_y]
}

/// Takes off a field what rigid motions that follow from resultants can do on the frozen zones.
pub struct RigidProjector<'a, N> {
    modes: &'a RigidModes,
    parts: ZoneParts<'a, N>,
    gram: [f64; 6],
}

impl<'a, N: Number> RigidProjector<'a, N> {
    /// Projector of tractions and displacements.
    pub fn new(modes: &'a RigidModes, parts: ZoneParts<'a, N>) -> Self {
        let gram = if modes.any_by_force() { each_cell(&Gram, parts, []) } else { [0.0; 6] };
        Self { modes, parts, gram }
    }

    /// Projector of equations that count in slipping cells with their weights.
    pub fn weighted(modes: &'a RigidModes, parts: ZoneParts<'a, N>, weighted_slip: &'a [N]) -> Self {
        let [stick, _, along_x, along_y, around_x, around_y] = parts;
        Self::new(modes, [stick, weighted_slip, along_x, along_y, around_x, around_y])
    }

    /// Keeps the free part of a field, without what rigid motions can do.
    pub fn keep_free(&self, [x, y]: [&mut [N]; 2]) {
        let products = each_cell(&KeepFree, self.parts, [&mut *x, &mut *y]);
        self.remove_resultant([x, y], products);
    }

    /// Takes off the rigid motion whose free part has these products with the free parts of all.
    pub fn remove_resultant(&self, field: [&mut [N]; 2], resultant: [f64; 3]) {
        if self.modes.any_by_force() {
            let amounts = self.modes.solve(self.gram, resultant);
            each_cell(&RemoveRigid(amounts), self.parts, field);
        }
    }

    /// Amounts of the motions whose free parts have `resultant`; the field that [`Self::remove_resultant`] takes off.
    pub fn amounts(&self, resultant: [f64; 3]) -> [f64; 3] {
        if self.modes.any_by_force() { self.modes.solve(self.gram, resultant) } else { [0.0; 3] }
    }
}

struct Gram;

impl CellRule<6, 0, 6> for Gram {
    const OPTIONAL: usize = 2;

    #[inline(always)]
    fn at<R: Reals>(
        &self,
        [stick, slip, along_x, along_y, around_x, around_y]: [R; 6],
        _: &mut [R; 0],
    ) -> [R; 6] {
        // Products of the free parts of the modes: 1 in stick, of the tangent parts in slip.
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
        let [shift_x, shift_y, twist] = self.0;
        let rigid = [around_x * twist + shift_x, around_y * twist + shift_y];
        let part = free_part(rigid, stick, slip, [along_x, along_y]);
        *x = *x - part[0];
        *y = *y - part[1];
        []
    }
}
