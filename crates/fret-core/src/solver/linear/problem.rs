//! The linearised problem on fixed active sets, in one precision. Unknown are the changes of pressure on the contact, of shear in
//! stick, and of the direction of shear in slip, where its size follows the pressure. Asked for are changes of displacement that
//! close the gap and the slip of sticking cells, and turn the shear of slipping ones along their slip.

use super::super::contact_set::ContactSet;
use super::super::contact_vector::ContactVector;
use super::super::laws::active_sets::ActiveSets;
use super::super::laws::rigid_motions::RigidMotions;
use super::super::laws::tilt_motions::TiltMotions;
use super::inverse::Precision;
use super::preconditioner::{Preconditioner, SlipWeights};
use super::rigid_projector::{RigidProjector, SetFields, free_part, products, rigid};
use crate::fields::{CellRule, Number, Reals, convert, each_cell, lower, reset, sum};

/// A linearised problem.
#[derive(Debug, Clone, Copy)]
pub struct Linearised<'a> {
    /// Cells in contact.
    pub contact: &'a ContactSet,
    /// What they do.
    pub sets: &'a ActiveSets,
    /// Rigid motions.
    pub motions: &'a RigidMotions,
    /// Derivative of the friction bound by the pressure, packed [-].
    pub slope: &'a [f64],
    /// Gap on the contact [length]; empty where the pressure is given.
    pub gap: &'a [f64],
    /// Slip increment on the contact [length].
    pub slip: [&'a [f64]; 2],
    /// The normal force is prescribed: the mean gap follows.
    pub holds_force: bool,
    /// Where a moment of the pressure is prescribed, the motions that follow, the approach among them.
    pub tilt: Option<&'a TiltMotions>,
    /// Weight of the tangential equations: shear counts in units of the pressure that carries it [-].
    pub weight: f64,
    /// Displacement that the machine gives by a unit of the summed traction, normally and along x and y [length/pressure].
    pub give: [f64; 3],
    /// Relative residual at which it is solved well enough.
    pub forcing: f64,
    /// Size of a residual that is small beside the tolerance [length].
    pub floor: f64,
}

impl Linearised<'_> {
    /// Takes off a normal field what motions along the normal that follow from resultants can do.
    fn without_motions<N: Number>(&self, field: &mut [N]) {
        match self.tilt {
            _ if field.is_empty() => {}
            Some(tilt) => tilt.remove(field),
            None if self.holds_force => remove_mean(field),
            None => {}
        }
    }
}

/// Active sets and what goes with them, packed, in the precision of a linear problem.
#[derive(Debug, Default)]
pub struct LinearSets<N> {
    stick: Vec<N>,
    slip: Vec<N>,
    slip_weight: Vec<N>,
    direction: [Vec<N>; 2],
    row: [Vec<N>; 2],
    /// In units of the problem.
    slip_compliance: Vec<N>,
    /// Rotation about z; empty when the bodies do not rotate.
    rotation: [Vec<N>; 2],
    /// Derivative of the friction bound by the pressure [-].
    slope: Vec<N>,
}

impl<N: Number> LinearSets<N> {
    /// Takes over active sets, rotation and slopes; `compliance` is the unit of slip compliance [length/pressure].
    pub fn take(&mut self, linearised: &Linearised<'_>, compliance: f64) {
        let Linearised { sets, motions, slope, .. } = *linearised;
        let take = |from: &[f64], factor: f64, to: &mut Vec<N>| {
            reset(to, from.len());
            convert(from, factor, to);
        };
        take(&sets.stick, 1.0, &mut self.stick);
        take(&sets.slip, 1.0, &mut self.slip);
        take(&sets.slip_weight, 1.0, &mut self.slip_weight);
        take(&sets.slip_compliance, 1.0 / compliance, &mut self.slip_compliance);
        take(slope, 1.0, &mut self.slope);
        for (from, to) in sets.direction.parts().into_iter().zip(&mut self.direction) {
            take(from, 1.0, to);
        }
        for (from, to) in sets.rows().into_iter().zip(&mut self.row) {
            take(from, 1.0, to);
        }
        for (from, to) in motions.rotation.parts().into_iter().zip(&mut self.rotation) {
            take(from, 1.0, to);
        }
    }

    fn fields(&self) -> SetFields<'_, N> {
        let ([along_x, along_y], [around_x, around_y]) = (&self.direction, &self.rotation);
        [&self.stick, &self.slip, along_x, along_y, around_x, around_y]
    }

    /// The same of the equations: with their weights and rows in slip.
    fn fields_of_equations(&self) -> SetFields<'_, N> {
        let [stick, _, _, _, around_x, around_y] = self.fields();
        let [row_x, row_y] = &self.row;
        [stick, &self.slip_weight, row_x, row_y, around_x, around_y]
    }
}

/// Workspace of a linear problem.
#[derive(Debug, Default)]
pub struct LinearWorkspace<N> {
    slip_weights: SlipWeights<N>,
    /// Tangential part of a residual without weights.
    unweighted: [Vec<N>; 2],
    /// Part of the newest direction that turns shear: by itself, since beside the part that follows pressure digits would be lost.
    turning: Vec<N>,
}

/// The linear problem in one precision.
pub struct LinearProblem<'a, N> {
    linearised: &'a Linearised<'a>,
    sets: &'a LinearSets<N>,
    workspace: &'a mut LinearWorkspace<N>,
    preconditioner: &'a mut Preconditioner,
    tractions: RigidProjector<'a, N>,
    equations: RigidProjector<'a, N>,
}

impl<'a, N: Number> LinearProblem<'a, N> {
    /// The problem on the `sets` taken over from it; `compliance` is the unit of displacements over that of tractions [length/pressure].
    pub fn new(
        linearised: &'a Linearised<'a>,
        sets: &'a LinearSets<N>,
        compliance: f64,
        preconditioner: &'a mut Preconditioner,
        workspace: &'a mut LinearWorkspace<N>,
    ) -> Self {
        let Linearised { contact, motions, .. } = linearised;
        preconditioner.prepare(contact, &sets.slip_compliance, compliance, &mut workspace.slip_weights);
        for field in &mut workspace.unweighted {
            reset(field, contact.len());
        }
        reset(&mut workspace.turning, contact.len());
        Self {
            tractions: RigidProjector::new(motions, sets.fields()),
            equations: RigidProjector::new(motions, sets.fields_of_equations()),
            linearised,
            sets,
            workspace,
            preconditioner,
        }
    }

    /// Tractions that nearly remove a residual: pressure and shear each by its own inverse, shear following the pressure in slip,
    /// resultants kept.
    pub fn precondition(&mut self, residual: &ContactVector<N>, tractions: &mut ContactVector<N>) {
        let Self { sets, workspace, preconditioner, .. } = self;
        let LinearWorkspace { slip_weights, unweighted, turning } = &mut **workspace;
        let [stick, slip, along_x, along_y, around_x, around_y] = sets.fields();
        let (normal, [x, y]) = residual.parts();
        let [unweighted_x, unweighted_y] = unweighted;
        let read = [stick, slip, &sets.slip_weight, x, y, around_x, around_y];
        let rule = Unweigh { unweight: 1.0 / self.linearised.weight };
        let left = each_cell(&rule, read, [&mut *unweighted_x, &mut *unweighted_y]);
        self.tractions.remove([&mut *unweighted_x, &mut *unweighted_y], left);

        tractions.reset_like(residual);
        let (pressure, [x, y]) = tractions.parts_mut();
        if !pressure.is_empty() {
            preconditioner.pressure(normal, pressure, slip_weights);
            self.linearised.without_motions(pressure);
        }
        let right = ([&unweighted_x[..], &unweighted_y[..]], Some(&*pressure).filter(|p| !p.is_empty()));
        preconditioner.shear(right, [&mut *x, &mut *y], slip_weights);
        if pressure.is_empty() {
            self.tractions.keep_free([x, y]);
            each_cell(&Turning, [slip, along_x, along_y, &*x, &*y], [turning]);
            return;
        }
        let read = [stick, slip, along_x, along_y, &sets.slope, &*pressure, around_x, around_y];
        let resultant = each_cell(&FreeAndFollow, read, [&mut *x, &mut *y]);
        let amounts = self.tractions.amounts(resultant);
        each_cell(&Follow(amounts), read, [x, y, turning]);
    }

    /// Carries packed `tractions` through the `operator` of the region: their displacements on the contact.
    pub fn displace(
        &mut self,
        tractions: &ContactVector<N>,
        displacements: &mut ContactVector<N>,
        operator: impl FnOnce(&[&[N]], &mut [&mut [N]]),
    ) where
        N: Precision,
    {
        displacements.reset_like(tractions);
        let packed: Vec<&[N]> = tractions.fields().collect();
        let mut results: Vec<&mut [N]> = displacements.fields_mut().collect();
        self.preconditioner.fields().carry(&packed, &mut results, [1.0; 2], operator);
    }

    /// Makes of the displacements of the tractions preconditioned last the left side of the equations.
    pub fn complete(&self, displacements: &mut ContactVector<N>) {
        let Self { linearised, sets, .. } = self;
        let (normal, [x, y]) = displacements.parts_mut();
        linearised.without_motions(normal);
        let [stick, weight, row_x, row_y, around_x, around_y] = sets.fields_of_equations();
        let turning = &self.workspace.turning;
        let read = [stick, weight, row_x, row_y, &sets.slip_compliance, turning, around_x, around_y];
        let found = each_cell(&FreeAndStiff { weight: linearised.weight }, read, [&mut *x, &mut *y]);
        self.equations.remove([x, y], found);
    }
}

/// The right side of the equations in double precision.
pub fn right_side(linearised: &Linearised<'_>, right: &mut ContactVector<f64>) {
    let Linearised { sets, motions, gap, slip, weight, .. } = *linearised;
    right.reset(if gap.is_empty() { 2 } else { 3 }, sets.len());
    let (normal, [x, y]) = right.parts_mut();
    convert(gap, -1.0, normal);
    linearised.without_motions(normal);
    convert(slip[0], weight, x);
    convert(slip[1], weight, y);
    let ([row_x, row_y], [around_x, around_y]) = (sets.rows(), motions.rotation.parts());
    let fields: SetFields<'_, f64> = [&sets.stick, &sets.slip_weight, row_x, row_y, around_x, around_y];
    RigidProjector::new(motions, fields).keep_free([x, y]);
}

fn remove_mean<N: Number>(field: &mut [N]) {
    let mean = sum(field) / field.len().max(1) as f64;
    lower(field, mean);
}

/// Takes the weights off a residual.
struct Unweigh {
    unweight: f64,
}

impl CellRule<7, 2, 3> for Unweigh {
    const OPTIONAL: usize = 2;

    #[inline(always)]
    fn at<R: Reals>(
        &self,
        [stick, slip, weight, x, y, around_x, around_y]: [R; 7],
        [to_x, to_y]: &mut [R; 2],
    ) -> [R; 3] {
        let zero = x.all(0.0);
        let factor = (stick + weight.if_at_most(zero, zero, slip / weight)) * self.unweight;
        [*to_x, *to_y] = [x * factor, y * factor];
        products([*to_x, *to_y], stick + slip, [around_x, around_y])
    }
}

/// The tangential component in slip.
struct Turning;

impl CellRule<5, 1, 0> for Turning {
    #[inline(always)]
    fn at<R: Reals>(&self, [slip, along_x, along_y, x, y]: [R; 5], [turning]: &mut [R; 1]) -> [R; 0] {
        *turning = slip * (along_x * y - along_y * x);
        []
    }
}

/// Keeps the free part of shear; sums the resultants of it and of the shear that follows pressure.
struct FreeAndFollow;

impl CellRule<8, 2, 3> for FreeAndFollow {
    const OPTIONAL: usize = 2;

    #[inline(always)]
    fn at<R: Reals>(
        &self,
        [stick, slip, along_x, along_y, slope, p, around_x, around_y]: [R; 8],
        [x, y]: &mut [R; 2],
    ) -> [R; 3] {
        [*x, *y] = free_part([*x, *y], stick, slip, [along_x, along_y]);
        let follow = slope * p;
        let both = [*x + follow * along_x, *y + follow * along_y];
        [both[0], both[1], both[0] * around_x + both[1] * around_y]
    }
}

/// Takes the free part of a rigid motion off, and adds the shear that follows pressure; tells what turns before that.
struct Follow([f64; 3]);

impl CellRule<8, 3, 0> for Follow {
    const OPTIONAL: usize = 2;

    #[inline(always)]
    fn at<R: Reals>(
        &self,
        [stick, slip, along_x, along_y, slope, p, around_x, around_y]: [R; 8],
        [x, y, turning]: &mut [R; 3],
    ) -> [R; 0] {
        let part = free_part(rigid(self.0, [around_x, around_y]), stick, slip, [along_x, along_y]);
        let follow = slope * p;
        let free = [*x - part[0], *y - part[1]];
        *turning = slip * (along_x * free[1] - along_y * free[0]);
        *x = free[0] + follow * along_x;
        *y = free[1] + follow * along_y;
        []
    }
}

/// Keeps the free part of a displacement, adds the slip compliance times the turning shear, and weights both; sums the products with
/// the free parts of the motions.
struct FreeAndStiff {
    weight: f64,
}

impl CellRule<8, 2, 3> for FreeAndStiff {
    const OPTIONAL: usize = 2;

    #[inline(always)]
    fn at<R: Reals>(
        &self,
        [stick, slip, row_x, row_y, slip_compliance, turning, around_x, around_y]: [R; 8],
        [x, y]: &mut [R; 2],
    ) -> [R; 3] {
        let turn = slip * (row_x * *y - row_y * *x + slip_compliance * turning);
        *x = (stick * *x - row_y * turn) * self.weight;
        *y = (stick * *y + row_x * turn) * self.weight;
        products([*x, *y], stick + slip, [around_x, around_y])
    }
}
