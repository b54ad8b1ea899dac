//! The loops of a model that a fit has met. Steps are found with coarse loops, at a tenth of the price, and what these lack of exact ones is found anew
//! from where they lead.

use std::cell::RefCell;
use std::ptr;
use std::rc::Rc;

use super::computed::Loop;
use super::model::Model;

/// Friction, stiffness of the rig and amplitude, and the value of the key.
pub type Constants = ([f64; 3], Option<f64>);

/// Exact and coarse loops, by their constants.
pub struct Loops<'a> {
    model: &'a Model<'a>,
    /// The model of the coarse ones: the model itself, where there is no other or that was given up.
    coarse: &'a Model<'a>,
    /// Rounds, and what is asked about the solution after them, meet the same ones again. `None` where there is no solution.
    met: RefCell<Vec<(Key, Option<Rc<Loop>>)>>,
}

/// Whether a loop is exact, and its constants.
type Key = (bool, Constants);

impl<'a> Loops<'a> {
    /// Those of a model, of which the exact one of some constants is known.
    pub fn new(model: &'a Model<'a>, (constants, first): (Constants, Loop)) -> Self {
        let met = RefCell::new(vec![((true, constants), Some(Rc::new(first)))]);
        Self { model, coarse: model.coarse(), met }
    }

    /// Whether exact loops stand for the coarse ones.
    pub fn are_exact(&self) -> bool {
        ptr::eq(self.model, self.coarse)
    }

    pub fn give_up_coarse(&mut self) {
        self.coarse = self.model;
    }

    /// Whether all coarse loops that were met could be solved: else steps may have stopped short.
    pub fn lead(&self) -> bool {
        self.are_exact()
            || self.met.borrow().iter().all(|((is_exact, _), found)| *is_exact || found.is_some())
    }

    pub fn exact(&self, of: Constants) -> Option<Rc<Loop>> {
        self.of(self.model, of)
    }

    pub fn coarse(&self, of: Constants) -> Option<Rc<Loop>> {
        self.of(self.coarse, of)
    }

    fn of(&self, model: &Model<'_>, constants: Constants) -> Option<Rc<Loop>> {
        let key = (ptr::eq(self.model, model), constants);
        let known = self.met.borrow().iter().find(|(known, _)| *known == key).map(|(_, found)| found.clone());
        known.unwrap_or_else(|| {
            let ([friction, stiffness, amplitude], value) = constants;
            let found = model.loop_of(friction, stiffness, amplitude, value).ok().map(Rc::new);
            self.met.borrow_mut().push((key, found.clone()));
            found
        })
    }
}
