//! Feasible tractions of the cells in contact, packed, and their way from the box and back.

use super::components::Components;
use super::contact_set::ContactSet;
use super::tractions::Tractions;
use crate::model::TangentialField;
use crate::model::field::add_scaled;

/// Feasible tractions of the cells in contact, packed.
#[derive(Debug, Default)]
pub struct Packed {
    /// Pressure [pressure].
    pub pressure: Vec<f64>,
    /// Shear [pressure].
    pub shear: TangentialField,
    /// Friction coefficient [-].
    pub friction: Vec<f64>,
    /// Friction bound [pressure].
    pub bound: Vec<f64>,
    /// They are those of the box.
    is_current: bool,
    /// How often they were given to the box since the contact changed.
    given: usize,
}

impl Packed {
    /// Goes over to another contact, on a surface of `friction` in every cell of the box.
    pub fn change_contact(&mut self, contact: &ContactSet, friction: &[f64]) {
        contact.pack(friction, &mut self.friction);
        (self.is_current, self.given) = (false, 0);
    }

    /// The tractions of the box are others now.
    pub fn forget(&mut self) {
        self.is_current = false;
    }

    /// Packs the tractions of the box, if they are not those it holds.
    pub fn take(&mut self, contact: &ContactSet, tractions: &Tractions) {
        if !std::mem::replace(&mut self.is_current, true) {
            contact.pack(&tractions.pressure, &mut self.pressure);
            contact.pack_tangential(&tractions.shear, &mut self.shear);
            self.find_bound();
        }
    }

    /// Writes them over the older of the two tractions of the box that take turns: once both were written on this contact there is
    /// nothing to clear.
    pub fn give(&mut self, contact: &ContactSet, tractions: &mut Tractions) {
        let Self { pressure, shear, .. } = self;
        if self.given >= 2 {
            contact.place(pressure, &mut tractions.pressure);
            contact.place_tangential(shear, &mut tractions.shear);
        } else {
            contact.scatter(pressure, &mut tractions.pressure);
            contact.scatter_tangential(shear, &mut tractions.shear);
        }
        self.given += 1;
        self.is_current = true;
    }

    /// Adds a step; what is held is no longer what the box has.
    pub fn add(&mut self, step: &Components<f64, 3>) {
        let [p, x, y] = step.parts();
        add_scaled(&mut self.pressure, 1.0, p);
        add_scaled(&mut self.shear.x, 1.0, x);
        add_scaled(&mut self.shear.y, 1.0, y);
        self.is_current = false;
    }

    /// The friction bound of the pressure.
    pub fn find_bound(&mut self) {
        self.bound.resize(self.pressure.len(), 0.0);
        for ((bound, p), mu) in self.bound.iter_mut().zip(&self.pressure).zip(&self.friction) {
            *bound = p * mu;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What other contacts left in either of two buffers that take turns is gone after two looks; what the contact
    /// holds comes back as it went.
    #[test]
    fn nothing_is_left_of_another_contact() {
        let cells = 6;
        let wide = ContactSet::of(cells, |cell| cell != 5);
        let narrow = ContactSet::of(cells, |cell| cell == 1 || cell == 3);
        let friction = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6];
        let mut old = Tractions::zeros(cells);
        old.pressure = vec![1.0, 2.0, 3.0, 4.0, 5.0, 0.0];
        old.shear.y = vec![0.01; cells];
        let mut other = old.clone();
        let mut packed = Packed::default();
        packed.change_contact(&wide, &friction);
        packed.take(&wide, &old);
        assert_eq!(packed.pressure, [1.0, 2.0, 3.0, 4.0, 5.0]);
        assert_eq!(packed.bound, [1.0 * 0.1, 2.0 * 0.2, 3.0 * 0.3, 4.0 * 0.4, 5.0 * 0.5]);
        packed.change_contact(&narrow, &friction);
        packed.take(&narrow, &old);
        assert_eq!(packed.pressure, [2.0, 4.0]);
        for buffer in [&mut old, &mut other] {
            packed.give(&narrow, buffer);
            assert_eq!(buffer.pressure, [0.0, 2.0, 0.0, 4.0, 0.0, 0.0]);
            assert_eq!(buffer.shear.y, [0.0, 0.01, 0.0, 0.01, 0.0, 0.0]);
        }
        // On the same contact once more: as written; and others only after they are forgotten.
        packed.pressure = vec![7.0, 8.0];
        packed.give(&narrow, &mut old);
        assert_eq!(old.pressure, [0.0, 7.0, 0.0, 8.0, 0.0, 0.0]);
        packed.take(&narrow, &other);
        assert_eq!(packed.pressure, [7.0, 8.0]);
        packed.forget();
        packed.take(&narrow, &other);
        assert_eq!(packed.pressure, [2.0, 4.0]);
    }
}
