//! Contact, stick and slip, taken from feasible tractions: a cell slips only when it is on its friction circle and the
//! surfaces pull it along; it sticks again only when they pull it inward.

use crate::model::TangentialField;
use crate::model::each_cell::{CellRule, Reals, each_cell};
use crate::model::field::largest;

/// On the circle up to this share of its radius.
const ON_CIRCLE: f64 = 1e-10;

/// Frozen zones of the cells in contact. A cell sticks: both components of its shear are unknown; or slips: its shear is on its
/// circle and can only turn; or follows: its shear follows pressure in a given direction, since it just enters contact or has no
/// friction.
#[derive(Debug, Clone, Default)]
pub struct Zones {
    /// 1 where a cell sticks, 0 elsewhere.
    pub stick: Vec<f64>,
    /// 1 where a cell slips, 0 elsewhere.
    pub slip: Vec<f64>,
    /// Direction of the shear of cells that do not stick, unit vectors; zero elsewhere.
    pub direction: TangentialField,
    /// Slip stiffness of slipping cells [length/pressure]: turning by tau changes the pull along the tangent by D tau.
    pub stiffness: Vec<f64>,
    /// Weights of the equations of slipping cells, `1 / sqrt(1 + D / own)` with a cell's own influence, zero elsewhere: a
    /// displacement turns a stiff cell by little, and counts by as much in the laws. Found by [`Zones::weigh`].
    pub weighted_slip: Vec<f64>,
}

impl Zones {
    /// Zones from shear `q`, friction bound `mu p` and `s` = minus the slip increment, all packed.
    pub fn of(q: &TangentialField, s: &TangentialField, bound: &[f64]) -> Self {
        let mut zones = Self::default();
        zones.classify(q, s, bound);
        zones
    }

    /// Takes over the zones of other tractions, keeping the memory.
    pub fn classify(&mut self, q: &TangentialField, s: &TangentialField, bound: &[f64]) {
        let Self { stick, slip, direction, stiffness, .. } = self;
        let [along_x, along_y] = direction.each_mut();
        let mut write = [stick, slip, along_x, along_y, stiffness];
        for field in &mut write {
            field.resize(bound.len(), 0.0);
        }
        let rule = Classify { least: 1e-6 * largest(bound) };
        each_cell(&rule, [&q.x, &q.y, &s.x, &s.y, bound], write.map(Vec::as_mut_slice));
    }

    /// Weights of the equations, by a cell's `own` influence [length/pressure].
    pub fn weigh(&mut self, own: f64) {
        self.weighted_slip.resize(self.len(), 0.0);
        each_cell(&Weigh { stiffness: 1.0 / own }, [&self.slip, &self.stiffness], [&mut self.weighted_slip]);
    }

    /// Whether the shear of a cell lies on its circle and grows with pressure.
    pub fn is_on_circle(&self, cell: usize) -> bool {
        self.stick[cell] == 0.0
    }

    /// Number of cells in contact.
    pub fn len(&self) -> usize {
        self.stick.len()
    }
}

struct Classify {
    /// Friction bound below which slip stiffness grows no more [pressure].
    least: f64,
}

impl CellRule<5, 5, 0> for Classify {
    #[inline(always)]
    fn at<R: Reals>(
        &self,
        [qx, qy, sx, sy, bound]: [R; 5],
        [stick, slip, along_x, along_y, stiffness]: &mut [R; 5],
    ) -> [R; 0] {
        let (zero, one) = (qx.all(0.0), qx.all(1.0));
        let size = (qx * qx + qy * qy).sqrt();
        let towards = [qx / size, qy / size];
        let outward = (sx * towards[0] + sy * towards[1]) * -1.0;
        let on_circle = (bound * (1.0 - ON_CIRCLE)).if_at_most(size, one, zero);
        let pulled = outward.if_at_most(zero, zero, on_circle);
        *slip = size.if_at_most(zero, zero, bound.if_at_most(zero, zero, pulled));
        let follows = bound.if_at_most(zero, one, zero);
        *stick = one - *slip - follows;
        // What just enters goes against its pull.
        let pull = (sx * sx + sy * sy).sqrt();
        let against =
            [pull.if_at_most(zero, one, sx / pull * -1.0), pull.if_at_most(zero, zero, sy / pull * -1.0)];
        let slips =
            |along: R, entering: R| slip.if_at_most(zero, follows.if_at_most(zero, zero, entering), along);
        [*along_x, *along_y] = [slips(towards[0], against[0]), slips(towards[1], against[1])];
        *stiffness = slip.if_at_most(zero, zero, outward / bound.max(bound.all(self.least)));
        []
    }
}

struct Weigh {
    /// Of a cell [pressure/length].
    stiffness: f64,
}

impl CellRule<2, 1, 0> for Weigh {
    #[inline(always)]
    fn at<R: Reals>(&self, [slip, stiffness]: [R; 2], [weighted]: &mut [R; 1]) -> [R; 0] {
        *weighted = slip / (stiffness * self.stiffness + 1.0).sqrt();
        []
    }
}
