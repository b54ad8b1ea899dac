//! Contact, stick and slip, taken from feasible tractions: a cell slips only when it is on its friction circle and the
//! surfaces pull it along; it sticks again only when they pull it inward.

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

struct Weigh {
    stiffness: f64,
}

impl CellRule<2, 1, 0> for Weigh {
    #[inline(always)]
    fn at<R: Reals>(&self, [slip, stiffness]: [R; 2], [weighted]: &mut [R; 1]) -> [R; 0] {
        *weighted = slip / (stiffness * self.stiffness + 1.0).sqrt();
        []
    }
}
