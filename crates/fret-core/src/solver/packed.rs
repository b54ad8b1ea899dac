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
    holds: bool,
    /// They have been given to the box since the contact changed.
    given: bool,
}

impl Packed {
    /// Goes over to another contact, on a surface of `friction` in every cell of the box.
    pub fn change_contact(&mut self, contact: &ContactSet, friction: &[f64]) {
        contact.pack(friction, &mut self.friction);
        (self.holds, self.given) = (false, false);
    }

    /// The tractions of the box are others now.
    pub fn forget(&mut self) {
        self.holds = false;
    }

    /// Packs the tractions of the box, if they are not those it holds.
    pub fn take(&mut self, contact: &ContactSet, tractions: &Tractions) {
        if !std::mem::replace(&mut self.holds, true) {
            contact.pack(&tractions.pressure, &mut self.pressure);
            contact.pack_tangential(&tractions.shear, &mut self.shear);
            self.find_bound();
        }
    }

    /// Writes them over tractions of the box that are two looks old: on the same contact there is nothing to clear.
    pub fn give(&mut self, contact: &ContactSet, tractions: &mut Tractions) {
        let Self { pressure, shear, .. } = self;
        if std::mem::replace(&mut self.given, true) {
            contact.place(pressure, &mut tractions.pressure);
            contact.place_tangential(shear, &mut tractions.shear);
        } else {
            contact.scatter(pressure, &mut tractions.pressure);
            contact.scatter_tangential(shear, &mut tractions.shear);
        }
        self.holds = true;
    }

    /// Adds a step; what is held is no longer what the box has.
    pub fn add(&mut self, step: &Components<f64, 3>) {
        let [p, x, y] = step.parts();
        add_scaled(&mut self.pressure, 1.0, p);
        add_scaled(&mut self.shear.x, 1.0, x);
        add_scaled(&mut self.shear.y, 1.0, y);
        self.holds = false;
    }

    /// The friction bound of the pressure.
    pub fn find_bound(&mut self) {
        self.bound.resize(self.pressure.len(), 0.0);
        for ((bound, p), mu) in self.bound.iter_mut().zip(&self.pressure).zip(&self.friction) {
            *bound = p * mu;
        }
    }
}
