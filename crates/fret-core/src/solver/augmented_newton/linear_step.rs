//! The step of the method: the equations linearised on the active sets of a point. What is known of the next point (cells that open have no
//! traction, the shear of slipping cells follows their pressure along the trial shear, resultants are those prescribed) is its start; from there
//! the linear problem is that of feasible iterates.

use super::super::contact_set::ContactSet;
use super::super::contact_vector::ContactVector;
use super::super::laws::active_sets::ActiveSets;
use super::super::laws::friction::FrictionBound;
use super::super::laws::rigid_motions::RigidMotions;
use super::super::laws::tilt_motions::TiltMotions;
use super::super::linear::problem::Linearised;
use super::super::operators::RegionOperators;
use super::super::settings::SolverSettings;
use super::super::tractions::{Displacements, Tractions};
use super::equations::{AtCell, Equations};
use super::point::Point;
use crate::compliance::SurfaceCompliance;
use crate::fields::{add_scaled, largest};
use crate::model::TangentialField;

/// The cells whose augmented pressure is positive and what they do, packed.
struct Active {
    contact: ContactSet,
    sets: ActiveSets,
    /// Augmented pressure, and the friction bound under it.
    augmented: Vec<f64>,
    bound: FrictionBound,
    motions: RigidMotions,
    tilt: Option<TiltMotions>,
}

/// Fit of rigid motions to vectors of the cells, by least squares.
#[derive(Default)]
struct Fit {
    gram: [f64; 6],
    right: [f64; 3],
}

impl Fit {
    /// One more cell: what the motions are there, and the vector that they are to be.
    fn add(&mut self, modes: [[f64; 2]; 3], vector: [f64; 2], weight: f64) {
        let product = |a: [f64; 2], b: [f64; 2]| weight * (a[0] * b[0] + a[1] * b[1]);
        for (sum, [k, l]) in self.gram.iter_mut().zip([[0, 0], [1, 1], [2, 2], [0, 1], [0, 2], [1, 2]]) {
            *sum += product(modes[k], modes[l]);
        }
        self.right = [0, 1, 2].map(|mode| self.right[mode] + product(modes[mode], vector));
    }

    /// Amounts of the motions in `held`, others zero.
    fn amounts(&self, held: [bool; 3]) -> [f64; 3] {
        let right = [0, 1, 2].map(|mode| if held[mode] { self.right[mode] } else { 0.0 });
        RigidMotions::solve_of(held, self.gram, right)
    }
}

impl Equations<'_> {
    /// The solution of the equations linearised at a point, as far as the forcing term asks for; `None` where no cell is left in contact.
    pub fn newton_point(
        &self,
        here: &Point,
        operators: &mut RegionOperators,
        settings: &SolverSettings,
        forcing: f64,
    ) -> Option<Point> {
        let Self { problem, self_influence: [own, _], .. } = self;
        let active = self.active(here)?;
        let mut packed = self.known_part(here, &active)?;
        let mut next = here.clone();
        active.scatter(&packed, &mut next.tractions);
        operators.compliance.full(next.tractions.parts(), next.displacements.parts_mut());
        let (gap, slip) = self.left_over(&active, &packed, &next);
        let linearised = Linearised {
            contact: &active.contact,
            sets: &active.sets,
            motions: &active.motions,
            slope: &active.bound.slope,
            gap: &gap,
            slip: slip.parts(),
            holds_force: problem.normal.total.is_some(),
            tilt: active.tilt.as_ref(),
            weight: self.weight,
            give: problem.give(),
            forcing,
            floor: 0.02 * settings.tolerance * largest(&packed.pressure) * own,
        };
        let mut step = ContactVector::default();
        let RegionOperators { compliance, preconditioner, linear, .. } = operators;
        linear.solve(&linearised, compliance, preconditioner, &mut step);
        let (pressure, [x, y]) = step.parts();
        add_scaled(&mut packed.pressure, 1.0, pressure);
        add_scaled(&mut packed.shear.x, 1.0, x);
        add_scaled(&mut packed.shear.y, 1.0, y);
        active.scatter(&packed, &mut next.tractions);
        operators.compliance.full(next.tractions.parts(), next.displacements.parts_mut());
        (next.approach, next.turned) =
            self.approach_under(&next.tractions.pressure, &next.displacements.normal, &active.contact);
        next.motion = self.motion_of(&active, &packed, &next);
        Some(next)
    }

    fn active(&self, here: &Point) -> Option<Active> {
        let Self { problem, self_influence: [_, own], .. } = self;
        let at: Vec<_> = (0..problem.undeformed.len()).map(|cell| self.at(here, cell)).collect();
        let contact = ContactSet::of(at.len(), |cell| at[cell].augmented > 0.0);
        if contact.len() == 0 {
            return None;
        }
        let augmented: Vec<f64> = contact.cells().map(|cell| at[cell].augmented).collect();
        let bound = problem.friction.packed(&contact).bound(&augmented);
        let vectors = |of: fn(&AtCell) -> [f64; 2]| {
            let mut field = TangentialField::zeros(contact.len());
            contact.cells().enumerate().for_each(|(place, cell)| field.set(place, of(&at[cell])));
            field
        };
        let mut sets = ActiveSets::of_trial(&vectors(|at| at.trial), &bound, *own);
        sets.turn(&problem.path.packed(&contact), &vectors(|at| at.slip));
        let motions = problem.motions_of(&contact);
        let tilt = problem.tilt_of(&contact);
        Some(Active { contact, sets, augmented, bound, motions, tilt })
    }

    /// What is known of the next point, packed over the contact; `None` where nothing carries the normal force.
    fn known_part(&self, here: &Point, active: &Active) -> Option<Tractions> {
        let Self { problem, .. } = self;
        let Active { contact, sets, augmented, bound, motions, tilt } = active;
        let mut pressure = contact.packed(&here.tractions.pressure);
        if let Some(tilt) = tilt {
            tilt.lift(&mut pressure, |_, p| p.max(0.0));
            if !tilt.is_held_by(&pressure) {
                return None;
            }
        } else if let Some(total) = problem.normal.total {
            let missing = total - pressure.iter().sum::<f64>();
            let positive: f64 = pressure.iter().map(|p| p.max(0.0)).sum();
            if !(positive > 0.0) {
                return None;
            }
            for p in &mut pressure {
                *p += missing * p.max(0.0) / positive;
            }
        }
        let mut shear = contact.packed_tangential(&here.tractions.shear);
        for cell in (0..contact.len()).filter(|&cell| sets.stick[cell] == 0.0) {
            let along = sets.direction.at(cell);
            let size = bound.bound[cell] + bound.slope[cell] * (pressure[cell] - augmented[cell]);
            let turned = sets.slip[cell] * across(along, shear.at(cell));
            shear.set(cell, [size * along[0] - turned * along[1], size * along[1] + turned * along[0]]);
        }
        let held = problem.tangential.held();
        if held.contains(&true) {
            let mut fit = Fit::default();
            let mut sums = [0.0; 3];
            for cell in 0..contact.len() {
                let (modes, q) = (motions.modes(cell), shear.at(cell));
                sums = [0, 1, 2].map(|mode| sums[mode] + q[0] * modes[mode][0] + q[1] * modes[mode][1]);
                fit.add(modes.map(|mode| active.free_part(cell, mode)), [0.0; 2], bound.bound[cell]);
            }
            fit.right = [0, 1, 2].map(|mode| problem.tangential.resultant[mode] - sums[mode]);
            let amounts = fit.amounts(held);
            for cell in 0..contact.len() {
                let (q, push) = (shear.at(cell), active.free_part(cell, motions.at(amounts, cell)));
                shear.set(cell, [0, 1].map(|axis| q[axis] + bound.bound[cell] * push[axis]));
            }
        }
        Some(Tractions { pressure, shear })
    }

    /// Gap and slip that the rest of the step is to remove, packed: without motions by force.
    fn left_over(&self, active: &Active, packed: &Tractions, known: &Point) -> (Vec<f64>, TangentialField) {
        let Self { problem, .. } = self;
        let Active { contact, sets, motions, .. } = active;
        let approach = problem.normal.approach_under(&packed.pressure).unwrap_or(0.0);
        let fixed = self.motion_under(&packed.shear, [0.0; 3]);
        let Displacements { normal, tangential } = &known.displacements;
        let gap = contact.cells().map(|cell| problem.undeformed[cell] + normal[cell] - approach).collect();
        let mut slip = TangentialField::zeros(contact.len());
        for (place, cell) in contact.cells().enumerate() {
            let (rigid, before, u) = (motions.at(fixed, place), problem.before.at(cell), tangential.at(cell));
            let here = [0, 1].map(|axis| rigid[axis] + before[axis] - u[axis]);
            slip.set(place, here);
            if sets.slip[place] > 0.0 {
                // As a vector whose part across the row is what is left of the equation.
                let row = sets.row(place);
                let left = across(row, here) - sets.slip_compliance[place] * active.turned(packed, place);
                let share = left / (row[0] * row[0] + row[1] * row[1]);
                slip.set(place, [-row[1] * share, row[0] * share]);
            }
        }
        (gap, slip)
    }

    /// The motions of the next point: those by force leave least of the equations.
    fn motion_of(&self, active: &Active, packed: &Tractions, next: &Point) -> [f64; 3] {
        let Self { problem, .. } = self;
        let Active { contact, sets, motions, .. } = active;
        let fixed = self.motion_under(&next.tractions.shear, [0.0; 3]);
        let held = problem.tangential.held();
        if !held.contains(&true) {
            return fixed;
        }
        let mut fit = Fit::default();
        for (place, cell) in contact.cells().enumerate() {
            let (rigid, before) = (motions.at(fixed, place), problem.before.at(cell));
            let u = next.displacements.tangential.at(cell);
            let here = [0, 1].map(|axis| u[axis] - before[axis] - rigid[axis]);
            let modes = motions.modes(place);
            if sets.stick[place] > 0.0 {
                fit.add(modes, here, 1.0);
            } else if sets.slip[place] > 0.0 {
                let row = sets.row(place);
                let left = across(row, here) + sets.slip_compliance[place] * active.turned(packed, place);
                let weight = sets.slip_weight[place].powi(2);
                fit.add(modes.map(|mode| [across(row, mode), 0.0]), [left, 0.0], weight);
            }
        }
        let found = fit.amounts(held);
        [0, 1, 2].map(|mode| if held[mode] { found[mode] } else { fixed[mode] })
    }
}

impl Active {
    fn scatter(&self, packed: &Tractions, tractions: &mut Tractions) {
        self.contact.scatter(&packed.pressure, 1.0, &mut tractions.pressure);
        self.contact.scatter_tangential(&packed.shear, &mut tractions.shear);
    }

    /// Of a vector at a cell the part that its shear may take: all in stick, that across the trial shear in slip.
    fn free_part(&self, cell: usize, vector: [f64; 2]) -> [f64; 2] {
        if self.sets.stick[cell] > 0.0 {
            return vector;
        }
        let along = self.sets.direction.at(cell);
        let turned = self.sets.slip[cell] * across(along, vector);
        [-along[1] * turned, along[0] * turned]
    }

    /// Shear of a slipping cell across its trial shear.
    fn turned(&self, packed: &Tractions, cell: usize) -> f64 {
        across(self.sets.direction.at(cell), packed.shear.at(cell))
    }
}

/// The part of a vector across another one, times the length of that.
fn across(along: [f64; 2], vector: [f64; 2]) -> f64 {
    along[0] * vector[1] - along[1] * vector[0]
}
