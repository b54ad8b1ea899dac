//! The loops of a model that a fit has met. Steps are found with coarse loops, at a tenth of the price, and what these lack of exact ones is found anew
//! from where they lead: so the solution is that of the exact loops.

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
    /// Whether exact loops stand for the coarse ones.
    pub are_exact: bool,
    /// Rounds, and what is asked about the solution after them, meet the same ones again. `None` where there is no solution.
    met: RefCell<Vec<(Key, Option<Rc<Loop>>)>>,
}

/// Whether a loop is exact, and its constants.
type Key = (bool, Constants);

impl<'a> Loops<'a> {
    /// Those of a model, of which the exact one of some constants is known.
    pub fn new(model: &'a Model<'a>, (constants, first): (Constants, Loop)) -> Self {
        // There may be none.
        let are_exact = ptr::eq(model, model.coarse());
        Self { model, are_exact, met: RefCell::new(vec![((true, constants), Some(Rc::new(first)))]) }
    }

    pub fn exact(&self, of: Constants) -> Option<Rc<Loop>> {
        self.met(true, of)
    }

    pub fn coarse(&self, of: Constants) -> Option<Rc<Loop>> {
        self.met(self.are_exact, of)
    }

    fn met(&self, is_exact: bool, of: Constants) -> Option<Rc<Loop>> {
        let key = (is_exact, of);
        let known = self.met.borrow().iter().find(|(known, _)| *known == key).map(|(_, found)| found.clone());
        known.unwrap_or_else(|| {
            let model = if is_exact { self.model } else { self.model.coarse() };
            let ([friction, stiffness, amplitude], value) = of;
            let found = model.loop_of(friction, stiffness, amplitude, value).ok().map(Rc::new);
            self.met.borrow_mut().push((key, found.clone()));
            found
        })
    }
}
