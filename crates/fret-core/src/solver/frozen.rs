//! The coupled problem on frozen zones: pressure free on the contact, shear free in stick, turning in slip and following
//! the pressure there.

use pulp::Simd;

use super::contact_set::ContactSet;
use super::elastic_answer::ElasticAnswer;
use super::krylov::{Directions, Triple};
use super::preconditioner::Preconditioner;
use super::rigid::RigidModes;
use super::shear::SIX_DIGITS;
use super::tractions::Tractions;
use super::zones::{RigidProjector, Zones, free_part, products};
use crate::compliance::SurfaceCompliance;
use crate::model::TangentialField;
use crate::model::each_cell::{CellRule, Reals, each_cell};
use crate::model::field::{add_scaled, largest, sum};

/// Share of its start to which a frozen problem is solved at the most when something is cut.
const ETA: f64 = 0.01;

/// Feasible tractions of the cells in contact, packed.
#[derive(Debug)]
pub struct Packed {
    /// Pressure [pressure].
    pub pressure: Vec<f64>,
    /// Shear [pressure].
    pub shear: TangentialField,
    /// Friction coefficient [-].
    pub friction: Vec<f64>,
    /// Friction bound [pressure].
    pub bound: Vec<f64>,
}

impl Packed {
    /// Packs the tractions of a box.
    pub fn new(contact: &ContactSet, tractions: &Tractions, friction: &[f64]) -> Self {
        let mut packed = Self {
            pressure: contact.packed(&tractions.pressure),
            shear: contact.packed_tangential(&tractions.shear),
            friction: contact.packed(friction),
            bound: vec![0.0; contact.len()],
        };
        packed.find_bound();
        packed
    }

    /// Adds a step.
    pub fn add(&mut self, step: &Triple) {
        let [p, x, y] = step.parts();
        add_scaled(&mut self.pressure, 1.0, p);
        add_scaled(&mut self.shear.x, 1.0, x);
        add_scaled(&mut self.shear.y, 1.0, y);
    }

    /// The friction bound of the pressure.
    pub fn find_bound(&mut self) {
        for ((bound, p), mu) in self.bound.iter_mut().zip(&self.pressure).zip(&self.friction) {
            *bound = p * mu;
        }
    }
}

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
    /// Share of the cut below which solving stops.
    pub theta: f64,
    /// The elastic answer is wanted with all digits.
    pub exact: bool,
}

/// Memory of the Krylov method.
#[derive(Debug, Default)]
pub struct KrylovMemory {
    directions: Directions,
    residual: Triple,
    /// The step found, packed.
    pub step: Triple,
    /// Tangential part of the residual, without weights.
    unweighted: TangentialField,
    answer: ElasticAnswer,
}

impl KrylovMemory {
    /// Makes ready for an increment in a box of so many cells.
    pub fn begin(&mut self, cells: usize) {
        self.answer.begin(cells);
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
        let len = self.contact.len();
        let rigid = RigidProjector::new(self.modes, self.zones);
        let equations = RigidProjector::of_equations(self.modes, self.zones);
        preconditioner.freeze(self.zones);
        memory.directions.restart();
        memory.answer.restart();
        memory.answer.exact |= self.exact;
        memory.step.clear(len);
        memory.residual.clear(len);
        // Tangential equations are weighted so that shear counts in units of the pressure that carries it.
        let weight = 1.0 / largest(&self.packed.friction).max(f64::MIN_POSITIVE);
        let [normal, x, y] = memory.residual.parts_mut();
        for (to, factor, from) in
            [(&mut *normal, 1.0, gap), (&mut *x, weight, &s.x[..]), (&mut *y, weight, &s.y[..])]
        {
            add_scaled(to, -factor, from);
        }
        self.remove_mean(normal);
        equations.keep_free([x, y]);
        let start = memory.residual.norm();
        let mut first_size = 0.0;
        for depth in 0..self.most {
            let KrylovMemory { directions, residual, step, unweighted, answer } = memory;
            let direction = directions.open(len);
            let [_, x, y] = residual.parts();
            self.unweigh([x, y], weight, &rigid, unweighted);
            self.precondition(residual, unweighted, &rigid, preconditioner, &mut direction.along);
            if depth == 0 {
                first_size = self.size_of(&direction.along);
            }
            answer.full(self.contact, &direction.along, &mut direction.image, compliance);
            self.make_image(&direction.along, weight, &equations, &mut direction.image);
            let Some(left_over) = directions.descend(residual, step) else { break };
            let cut = self.cut_of(step);
            let left = first_size * left_over / start;
            if left_over < self.floor
                || !answer.exact && left_over < SIX_DIGITS * start
                || (cut > 0.0 && (cut > self.theta * left || left_over < ETA * start))
            {
                break;
            }
        }
    }

    fn remove_mean(&self, field: &mut [f64]) {
        if self.holds_force {
            let mean = sum(field) / field.len().max(1) as f64;
            each_cell(&Less(mean), [], [field]);
        }
    }

    /// The tangential displacements of a weighted residual, without what rigid motions can do.
    fn unweigh(
        &self,
        [x, y]: [&[f64]; 2],
        weight: f64,
        rigid: &RigidProjector<'_>,
        displacements: &mut TangentialField,
    ) {
        for part in displacements.each_mut() {
            part.resize(self.contact.len(), 0.0);
        }
        let zones = self.zones;
        let rotation = &self.modes.rotation;
        let read = [&zones.stick[..], &zones.slip, &zones.weighted_slip, &rotation.x, &rotation.y, x, y];
        let rule = Unweigh { unweight: 1.0 / weight };
        let products = each_cell(&rule, read, displacements.parts_mut());
        rigid.remove_resultant(displacements.parts_mut(), products);
    }

    /// Tractions that would remove the normal part of a residual and the tangential `displacements`: pressure and shear each by
    /// its own inverse, shear following the pressure in slip, resultants kept.
    fn precondition(
        &self,
        residual: &Triple,
        displacements: &TangentialField,
        rigid: &RigidProjector<'_>,
        preconditioner: &mut Preconditioner,
        along: &mut Triple,
    ) {
        let [normal, _, _] = residual.parts();
        let [p, qx, qy] = along.parts_mut();
        preconditioner.pressure(normal, self.contact, p);
        self.remove_mean(p);
        preconditioner.shear(displacements.parts(), self.contact, [qx, qy]);
        let zones = self.zones;
        let rotation = &self.modes.rotation;
        let read = [
            &zones.stick[..],
            &zones.slip,
            &zones.direction.x,
            &zones.direction.y,
            &rotation.x,
            &rotation.y,
            &self.packed.friction,
            p,
        ];
        let resultant = each_cell(&FreeAndFollow, read, [&mut *qx, &mut *qy]);
        let amounts = rigid.amounts(resultant);
        each_cell(&Follow(amounts), read, [qx, qy]);
    }

    /// Makes of the displacements of tractions `along` the left side of the frozen equations.
    fn make_image(&self, along: &Triple, weight: f64, rigid: &RigidProjector<'_>, image: &mut Triple) {
        let [normal, x, y] = image.parts_mut();
        self.remove_mean(normal);
        let [_, qx, qy] = along.parts();
        let zones = self.zones;
        let rotation = &self.modes.rotation;
        let read = [
            &zones.stick[..],
            &zones.weighted_slip,
            &zones.direction.x,
            &zones.direction.y,
            &rotation.x,
            &rotation.y,
            &zones.stiffness,
            qx,
            qy,
        ];
        let resultant = each_cell(&FreeAndStiff { weight }, read, [&mut *x, &mut *y]);
        rigid.remove_resultant([x, y], resultant);
    }

    /// Distance of tractions + step from feasible ones, in units of pressure.
    fn cut_of(&self, step: &Triple) -> f64 {
        let [p, qx, qy] = step.parts();
        let packed = self.packed;
        let read = [
            &packed.pressure[..],
            &packed.shear.x,
            &packed.shear.y,
            &packed.friction,
            &self.zones.stick,
            p,
            qx,
            qy,
        ];
        let [square] = each_cell(&Cut, read, []);
        square.sqrt()
    }

    /// Size of tractions in units of pressure.
    fn size_of(&self, tractions: &Triple) -> f64 {
        let [p, qx, qy] = tractions.parts();
        let [square] = each_cell(&Size, [&self.packed.friction, p, qx, qy], []);
        square.sqrt()
    }
}

/// Residual of the frozen equations that is small beside a tolerance, for pressures and a cell's own influence.
pub fn floor(tolerance: f64, pressure: &[f64], own: f64) -> f64 {
    0.02 * tolerance * largest(pressure) * own
}

struct Less(f64);

impl CellRule<0, 1, 0> for Less {
    #[inline(always)]
    fn at<S: Simd>(&self, _: [Reals<S>; 0], [value]: &mut [Reals<S>; 1]) -> [Reals<S>; 0] {
        *value = *value - self.0;
        []
    }
}

/// Takes the weights off a residual.
struct Unweigh {
    unweight: f64,
}

impl CellRule<7, 2, 3> for Unweigh {
    #[inline(always)]
    fn at<S: Simd>(
        &self,
        [stick, slip, weighted, around_x, around_y, x, y]: [Reals<S>; 7],
        [to_x, to_y]: &mut [Reals<S>; 2],
    ) -> [Reals<S>; 3] {
        let zero = x.all(0.0);
        let factor = (stick + weighted.if_at_most(zero, zero, slip / weighted)) * self.unweight;
        [*to_x, *to_y] = [x * factor, y * factor];
        products([*to_x, *to_y], stick + slip, [around_x, around_y])
    }
}

/// Keeps the free part of shear; sums the resultants of it and of the shear that follows pressure.
struct FreeAndFollow;

impl CellRule<8, 2, 3> for FreeAndFollow {
    #[inline(always)]
    fn at<S: Simd>(
        &self,
        [stick, slip, along_x, along_y, around_x, around_y, friction, p]: [Reals<S>; 8],
        [x, y]: &mut [Reals<S>; 2],
    ) -> [Reals<S>; 3] {
        [*x, *y] = free_part([*x, *y], stick, slip, [along_x, along_y]);
        let follow = friction * p;
        let both = [*x + follow * along_x, *y + follow * along_y];
        [both[0], both[1], both[0] * around_x + both[1] * around_y]
    }
}

/// Takes the free part of a rigid motion off, and adds the shear that follows pressure.
struct Follow([f64; 3]);

impl CellRule<8, 2, 0> for Follow {
    #[inline(always)]
    fn at<S: Simd>(
        &self,
        [stick, slip, along_x, along_y, around_x, around_y, friction, p]: [Reals<S>; 8],
        [x, y]: &mut [Reals<S>; 2],
    ) -> [Reals<S>; 0] {
        let [shift_x, shift_y, twist] = self.0;
        let rigid = [around_x * twist + shift_x, around_y * twist + shift_y];
        let part = free_part(rigid, stick, slip, [along_x, along_y]);
        let follow = friction * p;
        *x = *x - part[0] + follow * along_x;
        *y = *y - part[1] + follow * along_y;
        []
    }
}

/// Keeps the free part of a displacement, adds the slip stiffness times the turning shear, and weights both; sums the products
/// with the free parts of the motions.
struct FreeAndStiff {
    weight: f64,
}

impl CellRule<9, 2, 3> for FreeAndStiff {
    #[inline(always)]
    fn at<S: Simd>(
        &self,
        [stick, slip, along_x, along_y, around_x, around_y, stiffness, qx, qy]: [Reals<S>; 9],
        [x, y]: &mut [Reals<S>; 2],
    ) -> [Reals<S>; 3] {
        let turn = slip * (along_x * *y - along_y * *x + stiffness * (along_x * qy - along_y * qx));
        *x = (stick * *x - along_y * turn) * self.weight;
        *y = (stick * *y + along_x * turn) * self.weight;
        products([*x, *y], stick + slip, [around_x, around_y])
    }
}

struct Cut;

impl CellRule<8, 0, 1> for Cut {
    #[inline(always)]
    fn at<S: Simd>(
        &self,
        [p, qx, qy, friction, stick, dp, dx, dy]: [Reals<S>; 8],
        _: &mut [Reals<S>; 0],
    ) -> [Reals<S>; 1] {
        let (zero, one) = (p.all(0.0), p.all(1.0));
        let pressure = p + dp;
        let tension = pressure.min(zero);
        let vector = [qx + dx, qy + dy];
        let size = (vector[0] * vector[0] + vector[1] * vector[1]).sqrt();
        let off = size - friction * pressure.max(zero);
        let counts = off.if_at_most(zero, one - stick, one);
        let share = friction.if_at_most(zero, zero, counts * off / friction);
        [tension * tension + share * share]
    }
}

struct Size;

impl CellRule<4, 0, 1> for Size {
    #[inline(always)]
    fn at<S: Simd>(&self, [friction, p, x, y]: [Reals<S>; 4], _: &mut [Reals<S>; 0]) -> [Reals<S>; 1] {
        let zero = p.all(0.0);
        let shear = friction.if_at_most(zero, zero, (x * x + y * y) / (friction * friction));
        [p * p + shear]
    }
}
