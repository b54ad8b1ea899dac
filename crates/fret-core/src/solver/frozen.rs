//! The coupled problem on frozen zones: pressure free on the contact, shear free in stick, turning in slip and following
//! the pressure there.

use super::components::Components;
use super::contact_set::ContactSet;
use super::elastic_answer::ElasticAnswer;
use super::frozen_zones::{FrozenZones, RigidProjector, free_part, parts_of, products};
use super::krylov::Directions;
use super::packed::Packed;
use super::patience::{ETA, SIX_DIGITS};
use super::preconditioner::{Preconditioner, SlipShares};
use super::rigid::RigidModes;
use super::rough_look::RoughLook;
use super::starting_shear::{StartingShear, after, taken};
use super::units::Units;
use super::zones::Zones;
use crate::compliance::SurfaceCompliance;
use crate::model::TangentialField;
use crate::model::each_cell::{CellRule, Number, Reals, each_cell};
use crate::model::field::{largest, lower, norm, sum};

/// The frozen problem.
#[derive(Debug)]
pub struct Frozen<'a> {
    /// Cells in contact.
    pub contact: &'a ContactSet,
    /// What they do.
    pub zones: &'a Zones,
    /// Rigid motions.
    pub modes: &'a RigidModes,
    /// Tractions to start from.
    pub packed: &'a Packed,
    /// The normal force is prescribed: the mean gap follows.
    pub holds_force: bool,
    /// Krylov steps at the most.
    pub most: usize,
    /// Size of a residual that is small beside the tolerance [length].
    pub floor: f64,
    /// Share of its start at which the residual is small enough: see [`enough`](super::patience::enough).
    pub enough: f64,
    /// Share of the cut below which solving stops.
    pub theta: f64,
    /// The elastic answer is wanted with all digits.
    pub exact: bool,
    /// The contact is not that of the frozen problem before.
    pub changed: bool,
}

/// Memory of the Krylov method.
#[derive(Debug, Default)]
pub struct KrylovMemory {
    cells: usize,
    /// Whether all digits are wanted.
    exact: bool,
    right: Components<f64, 3>,
    /// Looks at the equations in six digits.
    pub rough: RoughLook,
    /// The step found, packed.
    pub step: Components<f64, 3>,
    double: Krylov<f64>,
    single: Krylov<f32>,
}

/// The same in one precision.
#[derive(Debug, Default)]
struct Krylov<N> {
    zones: FrozenZones<N>,
    start: Start<N>,
    shares: SlipShares<N>,
    directions: Directions<N>,
    residual: Components<N, 3>,
    step: Components<N, 3>,
    /// Tangential part of the residual, without weights.
    unweighted: Components<N, 2>,
    /// Part of the newest direction that turns shear.
    turning: Vec<N>,
    answer: ElasticAnswer<N, 3>,
}

impl KrylovMemory {
    /// Makes ready for an increment in a box of so many cells.
    pub fn begin(&mut self, cells: usize) {
        self.cells = cells;
        self.exact = false;
        self.rough.begin();
    }
}

impl Frozen<'_> {
    /// Finds the step that solves the frozen problem as far as the zones deserve it, from `gap` and `s`, minus the slip
    /// increment, packed.
    pub fn solve(
        &self,
        gap: &[f64],
        s: &TangentialField,
        memory: &mut KrylovMemory,
        compliance: &mut dyn SurfaceCompliance,
        preconditioner: &mut Preconditioner,
    ) {
        let KrylovMemory { cells, exact, right, step, double, single, .. } = memory;
        *exact |= self.exact;
        let weight = self.find_right(gap, s, right);
        if !*exact && let Some(mut operator) = compliance.full_single() {
            let most = largest(&self.packed.pressure).max(norm(gap) / operator.unit());
            let units = Units::near_one(most, operator.unit());
            single.take(self, right, units);
            single.answer.begin(*cells, self.changed);
            self.solve_in(weight, units, single, |q, u| operator.apply(&q, &mut { u }), preconditioner);
            step.convert(single.step.parts(), units.pressure);
        } else {
            let first = !std::mem::replace(exact, true);
            double.take(self, right, Units::SCENE);
            double.answer.begin(*cells, first || self.changed);
            self.solve_in(weight, Units::SCENE, double, |q, u| compliance.full(q, u), preconditioner);
            step.convert(double.step.parts(), 1.0);
        }
    }

    /// The right side of the equations, with the weight of the tangential ones: shear counts in units of the pressure that carries it.
    /// The pull along slip is larger by far than what turns it: with six digits little of this would be left.
    fn find_right(&self, gap: &[f64], s: &TangentialField, right: &mut Components<f64, 3>) -> f64 {
        let weight = 1.0 / largest(&self.packed.friction).max(f64::MIN_POSITIVE);
        right.convert([gap, &s.x, &s.y], -1.0);
        let [normal, x, y] = right.parts_mut();
        self.remove_mean(normal);
        each_cell(&Times(weight), [], [&mut *x, &mut *y]);
        let parts = parts_of(self.zones, self.modes);
        RigidProjector::weighted(self.modes, parts, &self.zones.weighted_slip).keep_free([x, y]);
        weight
    }

    /// The same in one precision and in its units.
    fn solve_in<N: Number>(
        &self,
        weight: f64,
        units: Units,
        memory: &mut Krylov<N>,
        mut apply: impl FnMut([&[N]; 3], [&mut [N]; 3]),
        preconditioner: &mut Preconditioner,
    ) {
        let Krylov { zones, start, shares, directions, residual, step, unweighted, turning, answer } = memory;
        let problem = Problem {
            frozen: self,
            zones,
            start,
            weight,
            rigid: RigidProjector::new(self.modes, zones.parts()),
            equations: RigidProjector::weighted(self.modes, zones.parts(), &zones.weighted_slip),
        };
        preconditioner.freeze(zones, units.compliance, self.changed, shares);
        directions.restart();
        step.clear(self.contact.len());
        let first = residual.norm();
        let floor = self.floor / units.length();
        let mut first_size = 0.0;
        for depth in 0..self.most {
            let direction = directions.open(self.contact.len());
            problem.unweigh(residual, unweighted);
            problem.precondition(residual, unweighted, preconditioner, shares, &mut direction.along, turning);
            if depth == 0 {
                first_size = problem.size_of(&direction.along);
            }
            answer.find(self.contact, &direction.along, &mut direction.image, &mut apply);
            problem.make_image(turning, &mut direction.image);
            let Some(left_over) = directions.descend(residual, step) else { break };
            let cut = problem.cut_of(step);
            let left = first_size * left_over / first;
            let six_digits = size_of::<N>() < size_of::<f64>() && left_over < SIX_DIGITS * first;
            if left_over < floor.max(self.enough * first)
                || six_digits
                || (cut > 0.0 && (cut > self.theta * left || left_over < ETA * first))
            {
                break;
            }
        }
    }

    fn remove_mean<N: Number>(&self, field: &mut [N]) {
        if self.holds_force {
            let mean = sum(field) / field.len().max(1) as f64;
            lower(field, mean);
        }
    }
}

impl<N: Number> Krylov<N> {
    fn take(&mut self, frozen: &Frozen<'_>, right: &Components<f64, 3>, units: Units) {
        self.residual.convert(right.parts(), 1.0 / units.length());
        self.zones.take(frozen.zones, frozen.modes, units.compliance);
        let Packed { pressure, shear, friction, bound, .. } = frozen.packed;
        taken(pressure, 1.0 / units.pressure, &mut self.start.pressure);
        taken(friction, 1.0, &mut self.start.friction);
        self.start.shear.take(shear, bound, units.pressure);
    }
}

/// Tractions that a frozen problem starts from.
#[derive(Debug, Default)]
struct Start<N> {
    pressure: Vec<N>,
    friction: Vec<N>,
    shear: StartingShear<N>,
}

/// A frozen problem in one precision.
struct Problem<'a, N> {
    frozen: &'a Frozen<'a>,
    zones: &'a FrozenZones<N>,
    start: &'a Start<N>,
    /// Weight of the tangential equations.
    weight: f64,
    rigid: RigidProjector<'a, N>,
    equations: RigidProjector<'a, N>,
}

impl<N: Number> Problem<'_, N> {
    /// The tangential displacements of a weighted residual, without what rigid motions can do.
    fn unweigh(&self, residual: &Components<N, 3>, displacements: &mut Components<N, 2>) {
        displacements.reset(self.zones.len());
        let [stick, slip, _, _, around_x, around_y] = self.zones.parts();
        let [_, x, y] = residual.parts();
        let read = [stick, slip, &self.zones.weighted_slip, x, y, around_x, around_y];
        let rule = Unweigh { unweight: 1.0 / self.weight };
        let products = each_cell(&rule, read, displacements.parts_mut());
        self.rigid.remove_resultant(displacements.parts_mut(), products);
    }

    /// Tractions that would remove the normal part of a residual and the tangential `displacements`: pressure and shear each by
    /// its own inverse, shear following the pressure in slip, resultants kept. `turning` is the part of the shear of slipping cells
    /// that turns it, before the other part makes it lose digits.
    fn precondition(
        &self,
        residual: &Components<N, 3>,
        displacements: &Components<N, 2>,
        preconditioner: &mut Preconditioner,
        shares: &mut SlipShares<N>,
        along: &mut Components<N, 3>,
        turning: &mut Vec<N>,
    ) {
        let contact = self.frozen.contact;
        let [normal, _, _] = residual.parts();
        let [p, qx, qy] = along.parts_mut();
        preconditioner.pressure(normal, contact, p, shares);
        self.frozen.remove_mean(p);
        preconditioner.shear(displacements.parts(), contact, [qx, qy], shares);
        let [stick, slip, along_x, along_y, around_x, around_y] = self.zones.parts();
        let read = [stick, slip, along_x, along_y, &self.start.friction, p, around_x, around_y];
        let resultant = each_cell(&FreeAndFollow, read, [&mut *qx, &mut *qy]);
        let amounts = self.rigid.amounts(resultant);
        turning.resize(qx.len(), N::default());
        each_cell(&Follow(amounts), read, [qx, qy, turning]);
    }

    /// Makes of the displacements of tractions the left side of the frozen equations.
    fn make_image(&self, turning: &[N], image: &mut Components<N, 3>) {
        let [normal, x, y] = image.parts_mut();
        self.frozen.remove_mean(normal);
        let FrozenZones { weighted_slip, stiffness, .. } = self.zones;
        let [stick, _, along_x, along_y, around_x, around_y] = self.zones.parts();
        let read = [stick, weighted_slip, along_x, along_y, stiffness, turning, around_x, around_y];
        let resultant = each_cell(&FreeAndStiff { weight: self.weight }, read, [&mut *x, &mut *y]);
        self.equations.remove_resultant([x, y], resultant);
    }

    /// Distance of tractions + step from feasible ones, in units of pressure.
    fn cut_of(&self, step: &Components<N, 3>) -> f64 {
        let [p, qx, qy] = step.parts();
        let Start { pressure, friction, shear: StartingShear { shear: [x, y], size, excess, .. } } =
            self.start;
        let read = [pressure, x, y, size, excess, friction, &self.zones.stick, p, qx, qy];
        let [square] = each_cell(&Cut, read, []);
        square.sqrt()
    }

    /// Size of tractions in units of pressure.
    fn size_of(&self, tractions: &Components<N, 3>) -> f64 {
        let [p, qx, qy] = tractions.parts();
        let [square] = each_cell(&Size, [&self.start.friction, p, qx, qy], []);
        square.sqrt()
    }
}

/// Residual of the frozen equations that is small beside a tolerance, for pressures and a cell's own influence.
pub fn floor(tolerance: f64, pressure: &[f64], own: f64) -> f64 {
    0.02 * tolerance * largest(pressure) * own
}

/// Times a number.
struct Times(f64);

impl CellRule<0, 2, 0> for Times {
    #[inline(always)]
    fn at<R: Reals>(&self, _: [R; 0], [x, y]: &mut [R; 2]) -> [R; 0] {
        *x = *x * self.0;
        *y = *y * self.0;
        []
    }
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
        [stick, slip, weighted, x, y, around_x, around_y]: [R; 7],
        [to_x, to_y]: &mut [R; 2],
    ) -> [R; 3] {
        let zero = x.all(0.0);
        let factor = (stick + weighted.if_at_most(zero, zero, slip / weighted)) * self.unweight;
        [*to_x, *to_y] = [x * factor, y * factor];
        products([*to_x, *to_y], stick + slip, [around_x, around_y])
    }
}

/// Keeps the free part of shear; sums the resultants of it and of the shear that follows pressure.
struct FreeAndFollow;

impl CellRule<8, 2, 3> for FreeAndFollow {
    const OPTIONAL: usize = 2;

    #[inline(always)]
    fn at<R: Reals>(
        &self,
        [stick, slip, along_x, along_y, friction, p, around_x, around_y]: [R; 8],
        [x, y]: &mut [R; 2],
    ) -> [R; 3] {
        [*x, *y] = free_part([*x, *y], stick, slip, [along_x, along_y]);
        let follow = friction * p;
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
        [stick, slip, along_x, along_y, friction, p, around_x, around_y]: [R; 8],
        [x, y, turning]: &mut [R; 3],
    ) -> [R; 0] {
        let [shift_x, shift_y, twist] = self.0;
        let rigid = [around_x * twist + shift_x, around_y * twist + shift_y];
        let part = free_part(rigid, stick, slip, [along_x, along_y]);
        let follow = friction * p;
        let free = [*x - part[0], *y - part[1]];
        *turning = slip * (along_x * free[1] - along_y * free[0]);
        *x = free[0] + follow * along_x;
        *y = free[1] + follow * along_y;
        []
    }
}

/// Keeps the free part of a displacement, adds the slip stiffness times the turning shear, and weights both; sums the products
/// with the free parts of the motions.
struct FreeAndStiff {
    weight: f64,
}

impl CellRule<8, 2, 3> for FreeAndStiff {
    const OPTIONAL: usize = 2;

    #[inline(always)]
    fn at<R: Reals>(
        &self,
        [stick, slip, along_x, along_y, stiffness, turning, around_x, around_y]: [R; 8],
        [x, y]: &mut [R; 2],
    ) -> [R; 3] {
        let turn = slip * (along_x * *y - along_y * *x + stiffness * turning);
        *x = (stick * *x - along_y * turn) * self.weight;
        *y = (stick * *y + along_x * turn) * self.weight;
        products([*x, *y], stick + slip, [around_x, around_y])
    }
}

struct Cut;

impl CellRule<10, 0, 1> for Cut {
    #[inline(always)]
    fn at<R: Reals>(
        &self,
        [p, qx, qy, size, excess, friction, stick, dp, dx, dy]: [R; 10],
        _: &mut [R; 0],
    ) -> [R; 1] {
        let (zero, one) = (p.all(0.0), p.all(1.0));
        let pressure = p + dp;
        let tension = pressure.min(zero);
        let (moved, growth) = after([qx, qy], size, [dx, dy]);
        let off = pressure.if_at_most(zero, moved, excess + growth - friction * dp);
        let counts = off.if_at_most(zero, one - stick, one);
        let share = friction.if_at_most(zero, zero, counts * off / friction);
        [tension * tension + share * share]
    }
}

struct Size;

impl CellRule<4, 0, 1> for Size {
    #[inline(always)]
    fn at<R: Reals>(&self, [friction, p, x, y]: [R; 4], _: &mut [R; 0]) -> [R; 1] {
        let zero = p.all(0.0);
        let shear = friction.if_at_most(zero, zero, (x * x + y * y) / (friction * friction));
        [p * p + shear]
    }
}
