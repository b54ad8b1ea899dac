//! Contact, stick and slip, taken from feasible tractions: a cell slips only when it is on its friction circle and the
//! surfaces pull it along; it sticks again only when they pull it inward.

use pulp::Simd;

use super::rigid::RigidModes;
use crate::model::TangentialField;
use crate::model::each_cell::{CellRule, Reals, each_cell};

/// On the circle up to this share of its radius.
const ON_CIRCLE: f64 = 1e-10;

/// What a cell in contact does, frozen for the inner solver.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Freedom {
    /// Both components of the shear are unknown.
    Stick,
    /// The shear is on its circle and can only turn.
    Slip,
    /// The shear follows pressure in a given direction: the cell just enters contact, or has no friction.
    Follow,
}

/// Frozen zones of the cells in contact.
#[derive(Debug, Clone)]
pub struct Zones {
    /// Freedom of every cell.
    pub freedom: Vec<Freedom>,
    /// 1 where a cell sticks, 0 elsewhere.
    pub stick: Vec<f64>,
    /// 1 where a cell slips, 0 elsewhere.
    pub slip: Vec<f64>,
    /// Direction of the shear of cells that do not stick, unit vectors; zero elsewhere.
    pub direction: TangentialField,
    /// Slip stiffness of slipping cells [length/pressure]: turning by tau changes the pull along the tangent by D tau.
    pub stiffness: Vec<f64>,
    /// Weights of the equations of slipping cells, zero elsewhere: a displacement turns a stiff cell by little, and counts by
    /// as much in the laws; see [`Zones::weigh`].
    pub weighted_slip: Vec<f64>,
}

impl Zones {
    /// Zones from shear `q`, friction bound `mu p` and `s` = minus the slip increment, all packed; `entering` tells cells
    /// without pressure that join the contact.
    pub fn classify(
        q: &TangentialField,
        s: &TangentialField,
        bound: &[f64],
        entering: impl Fn(usize) -> bool,
    ) -> Self {
        let len = bound.len();
        let floor = 1e-6 * bound.iter().copied().fold(0.0, f64::max);
        let mut zones = Self {
            freedom: vec![Freedom::Stick; len],
            stick: vec![1.0; len],
            slip: vec![0.0; len],
            direction: TangentialField::zeros(len),
            stiffness: vec![0.0; len],
            weighted_slip: Vec::new(),
        };
        for cell in 0..len {
            let pull = s.at(cell);
            if entering(cell) {
                let size = pull[0].hypot(pull[1]);
                let along = if size > 0.0 { [-pull[0] / size, -pull[1] / size] } else { [1.0, 0.0] };
                zones.set(cell, Freedom::Follow, along);
                continue;
            }
            let shear = q.at(cell);
            let size = (shear[0] * shear[0] + shear[1] * shear[1]).sqrt();
            if size > 0.0 && size >= bound[cell] * (1.0 - ON_CIRCLE) {
                let along = [shear[0] / size, shear[1] / size];
                let outward = -(pull[0] * along[0] + pull[1] * along[1]);
                if outward > 0.0 {
                    zones.set(cell, Freedom::Slip, along);
                    zones.stiffness[cell] = outward / bound[cell].max(floor);
                }
            } else if bound[cell] <= 0.0 {
                zones.set(cell, Freedom::Follow, [1.0, 0.0]);
            }
        }
        zones
    }

    /// Weights of the equations of slipping cells: `1 / sqrt(1 + D / own)` with a cell's `own` influence [length/pressure].
    pub fn weigh(&mut self, own: f64) {
        self.weighted_slip.resize(self.len(), 0.0);
        each_cell(&Weigh { stiffness: 1.0 / own }, [&self.slip, &self.stiffness], [&mut self.weighted_slip]);
    }

    fn set(&mut self, cell: usize, freedom: Freedom, along: [f64; 2]) {
        self.freedom[cell] = freedom;
        self.stick[cell] = 0.0;
        self.slip[cell] = if freedom == Freedom::Slip { 1.0 } else { 0.0 };
        self.direction.set(cell, along);
    }

    /// Whether the shear of a cell lies on its circle and grows with pressure.
    pub fn is_on_circle(&self, cell: usize) -> bool {
        self.freedom[cell] != Freedom::Stick
    }

    /// Number of cells in contact.
    pub fn len(&self) -> usize {
        self.stick.len()
    }
}

/// Part of a vector that a cell is free to change.
#[inline(always)]
pub fn free_part<S: Simd>(
    vector: [Reals<S>; 2],
    stick: Reals<S>,
    slip: Reals<S>,
    direction: [Reals<S>; 2],
) -> [Reals<S>; 2] {
    let turn = slip * (direction[0] * vector[1] - direction[1] * vector[0]);
    [stick * vector[0] - direction[1] * turn, stick * vector[1] + direction[0] * turn]
}

struct Weigh {
    stiffness: f64,
}

impl CellRule<2, 1, 0> for Weigh {
    #[inline(always)]
    fn at<S: Simd>(&self, [slip, stiffness]: [Reals<S>; 2], [weighted]: &mut [Reals<S>; 1]) -> [Reals<S>; 0] {
        *weighted = slip / (stiffness * self.stiffness + 1.0).sqrt();
        []
    }
}

/// Keeps the free part of a field; sums its products with the free parts of the motions.
struct KeepFree;

impl CellRule<6, 2, 3> for KeepFree {
    #[inline(always)]
    fn at<S: Simd>(
        &self,
        [stick, slip, along_x, along_y, around_x, around_y]: [Reals<S>; 6],
        [x, y]: &mut [Reals<S>; 2],
    ) -> [Reals<S>; 3] {
        [*x, *y] = free_part([*x, *y], stick, slip, [along_x, along_y]);
        products([*x, *y], stick + slip, [around_x, around_y])
    }
}

/// Products of a field that is free with the free parts of the motions.
#[inline(always)]
pub fn products<S: Simd>(
    [x, y]: [Reals<S>; 2],
    weight: Reals<S>,
    [around_x, around_y]: [Reals<S>; 2],
) -> [Reals<S>; 3] {
    [x * weight, y * weight, (x * around_x + y * around_y) * weight]
}

/// Takes off a field what rigid motions that follow from resultants can do on the frozen zones.
pub struct RigidProjector<'a> {
    modes: &'a RigidModes,
    zones: &'a Zones,
    /// Factor of the tangent part of slipping cells, zero elsewhere.
    slip: &'a [f64],
    gram: [f64; 6],
}

impl<'a> RigidProjector<'a> {
    /// Projector of tractions and displacements.
    pub fn new(modes: &'a RigidModes, zones: &'a Zones) -> Self {
        Self::of(modes, zones, &zones.slip)
    }

    /// Projector of weighted equations.
    pub fn of_equations(modes: &'a RigidModes, zones: &'a Zones) -> Self {
        Self::of(modes, zones, &zones.weighted_slip)
    }

    fn of(modes: &'a RigidModes, zones: &'a Zones, slip: &'a [f64]) -> Self {
        let gram = if modes.any_by_force() {
            let read = [
                &zones.stick[..],
                slip,
                &zones.direction.x,
                &zones.direction.y,
                &modes.rotation.x,
                &modes.rotation.y,
            ];
            each_cell(&Gram, read, [])
        } else {
            [0.0; 6]
        };
        Self { modes, zones, slip, gram }
    }

    fn read(&self) -> [&[f64]; 6] {
        let Self { modes: RigidModes { rotation, .. }, zones, slip, .. } = self;
        [&zones.stick, slip, &zones.direction.x, &zones.direction.y, &rotation.x, &rotation.y]
    }

    /// Keeps the free part of a field, without what rigid motions can do.
    pub fn keep_free(&self, [x, y]: [&mut [f64]; 2]) {
        let products = each_cell(&KeepFree, self.read(), [&mut *x, &mut *y]);
        self.remove_resultant([x, y], products);
    }

    /// Takes off the rigid motion whose free part has these products with the free parts of all.
    pub fn remove_resultant(&self, field: [&mut [f64]; 2], resultant: [f64; 3]) {
        if self.modes.any_by_force() {
            let amounts = self.modes.solve(self.gram, resultant);
            each_cell(&RemoveRigid(amounts), self.read(), field);
        }
    }

    /// Amounts of the motions whose free parts have `resultant`; the field that [`Self::remove_resultant`] takes off.
    pub fn amounts(&self, resultant: [f64; 3]) -> [f64; 3] {
        if self.modes.any_by_force() { self.modes.solve(self.gram, resultant) } else { [0.0; 3] }
    }
}

struct Gram;

impl CellRule<6, 0, 6> for Gram {
    #[inline(always)]
    fn at<S: Simd>(
        &self,
        [stick, slip, along_x, along_y, around_x, around_y]: [Reals<S>; 6],
        _: &mut [Reals<S>; 0],
    ) -> [Reals<S>; 6] {
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
    #[inline(always)]
    fn at<S: Simd>(
        &self,
        [stick, slip, along_x, along_y, around_x, around_y]: [Reals<S>; 6],
        [x, y]: &mut [Reals<S>; 2],
    ) -> [Reals<S>; 0] {
        let [shift_x, shift_y, twist] = self.0;
        let rigid = [around_x * twist + shift_x, around_y * twist + shift_y];
        let part = free_part(rigid, stick, slip, [along_x, along_y]);
        *x = *x - part[0];
        *y = *y - part[1];
        []
    }
}
