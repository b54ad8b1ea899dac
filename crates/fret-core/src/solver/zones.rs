//! Contact, stick and slip, taken from feasible tractions: a cell slips only when it is on its friction circle and the
//! surfaces pull it along; it sticks again only when they pull it inward.

use crate::model::field::TangentialField;

/// On the circle up to this share of its radius.
const ON_CIRCLE: f64 = 1e-10;

/// What a cell does, frozen for the inner solver.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Freedom {
    /// Not in contact.
    Open,
    /// Both components of the shear are unknown.
    Stick,
    /// The shear is on its circle and can only turn.
    Slip,
    /// The shear follows pressure in a given direction: the cell just enters contact, or has no friction.
    Follow,
}

/// Frozen zones of a box.
#[derive(Debug, Clone)]
pub struct Zones {
    /// Freedom of every cell.
    pub freedom: Vec<Freedom>,
    /// Direction of the shear in slipping cells, unit vectors; zero elsewhere.
    pub direction: TangentialField,
    /// Slip stiffness of slipping cells [length/pressure]: turning by tau changes the pull along the tangent by D tau.
    pub stiffness: Vec<f64>,
    /// Cells in contact, in their order.
    pub contact: Vec<usize>,
}

impl Zones {
    /// Zones from shear `q`, friction bound `mu p` and `s` = minus the slip increment, over the cells in `contact`;
    /// `entering` tells cells without pressure that join the contact.
    pub fn classify(
        contact: Vec<usize>,
        q: &TangentialField,
        s: &TangentialField,
        bound: &[f64],
        entering: impl Fn(usize) -> bool,
    ) -> Self {
        let largest = contact.iter().map(|&cell| bound[cell]).fold(0.0, f64::max);
        let floor = 1e-6 * largest;
        let mut freedom = vec![Freedom::Open; bound.len()];
        let mut direction = TangentialField::zeros(bound.len());
        let mut stiffness = vec![0.0; bound.len()];
        for &cell in &contact {
            let pull = s.at(cell);
            if entering(cell) {
                let size = pull[0].hypot(pull[1]);
                freedom[cell] = Freedom::Follow;
                let along = if size > 0.0 { [-pull[0] / size, -pull[1] / size] } else { [1.0, 0.0] };
                direction.set(cell, along);
                continue;
            }
            let shear = q.at(cell);
            let size = (shear[0] * shear[0] + shear[1] * shear[1]).sqrt();
            freedom[cell] = Freedom::Stick;
            if size > 0.0 && size >= bound[cell] * (1.0 - ON_CIRCLE) {
                let along = [shear[0] / size, shear[1] / size];
                let outward = -(pull[0] * along[0] + pull[1] * along[1]);
                if outward > 0.0 {
                    freedom[cell] = Freedom::Slip;
                    direction.set(cell, along);
                    stiffness[cell] = outward / bound[cell].max(floor);
                }
            } else if bound[cell] <= 0.0 {
                freedom[cell] = Freedom::Follow;
                direction.set(cell, [1.0, 0.0]);
            }
        }
        Self { freedom, direction, stiffness, contact }
    }

    /// Keeps of a tangential field what the zones leave free: all in stick, the tangent part in slip, nothing elsewhere.
    pub fn keep_free(&self, field: &mut TangentialField) {
        for cell in 0..self.freedom.len() {
            match self.freedom[cell] {
                Freedom::Stick => {}
                Freedom::Open | Freedom::Follow => field.set(cell, [0.0, 0.0]),
                Freedom::Slip => field.set(cell, self.tangent_part(field.at(cell), cell)),
            }
        }
    }

    /// Whether the shear of a cell lies on its circle and grows with pressure.
    #[inline]
    pub fn is_on_circle(&self, cell: usize) -> bool {
        matches!(self.freedom[cell], Freedom::Slip | Freedom::Follow)
    }

    /// Part of a vector along the tangent of a slipping cell's circle.
    #[inline]
    pub fn tangent_part(&self, vector: [f64; 2], cell: usize) -> [f64; 2] {
        let along = self.direction.at(cell);
        let turn = along[0] * vector[1] - along[1] * vector[0];
        [-along[1] * turn, along[0] * turn]
    }

    /// Adds the slip stiffness times the (tangent) field.
    pub fn add_stiffness(&self, image: &mut TangentialField, field: &TangentialField) {
        for &cell in &self.contact {
            if self.freedom[cell] == Freedom::Slip {
                let stiffness = self.stiffness[cell];
                image.x[cell] += stiffness * field.x[cell];
                image.y[cell] += stiffness * field.y[cell];
            }
        }
    }
}
