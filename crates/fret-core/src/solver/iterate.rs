//! Tractions on their way to the solution of one increment, with everything that follows from them: gap, contact, slip, rigid motions,
//! residuals, active sets; and the step from one iterate to the next.

use super::contact_problem::{ContactProblem, Pressure, Solution};
use super::contact_set::ContactSet;
use super::contact_vector::ContactVector;
use super::laws::active_sets::ActiveSets;
use super::laws::complementarity::{CellLaw, NormalResidual, normal_residual};
use super::laws::friction::{FrictionBound, FrictionLaw, is_inside, slips};
use super::laws::projection::{ShearProjection, project_pressure};
use super::laws::rigid_motions::RigidMotions;
use super::laws::slip::{SlipIncrement, TangentialProblem, TangentialResidual};
use super::laws::slip_path::SlipPath;
use super::laws::tilt_motions::TiltMotions;
use super::linear::problem::Linearised;
use super::operators::RegionOperators;
use super::settings::SolverSettings;
use super::tractions::{Displacements, Tractions};
use crate::compliance::SurfaceCompliance;
use crate::fields::{TangentialField, add_scaled, largest, lower, sum};

/// A residual of the friction law above which the solution is far. By trial: coated loops of 256 to 1024
/// cells per side take up to 3 % more applications with 0.1 and 0.01; with 0, groups of cells go to and fro and increments fail.
const FAR: f64 = 1e-3;

/// Known motions are believed where they leave less than this fraction of what motions that are looked for from none leave over.
const BELIEVED: f64 = 0.5;

/// Tractions on their way to the solution, with everything that follows from them.
pub struct Iterate<'a> {
    problem: &'a ContactProblem<'a>,
    tractions: &'a mut Tractions,
    displacements: &'a mut Displacements,
    /// Self-influence of a cell, normal and tangential [length/pressure].
    self_influence: [f64; 2],
    contact: ContactSet,
    motions: RigidMotions,
    /// The motions along the normal of the region, where a moment of the pressure is prescribed; and of the contact.
    tilt: Option<TiltMotions>,
    tilt_of_contact: Option<TiltMotions>,
    /// Of the region [length].
    gap: Vec<f64>,
    normal: NormalResidual,
    tangential: TangentialResidual,
    /// Motions that are known before any are found.
    known_motion: Option<[f64; 3]>,
    slip: SlipIncrement,
    sets: ActiveSets,
    step: ContactVector<f64>,
    packed: Packed,
    projection: ShearProjection,
}

/// Fields packed over the contact.
#[derive(Default)]
struct Packed {
    pressure: Vec<f64>,
    shear: TangentialField,
    law: FrictionLaw,
    bound: FrictionBound,
    before: TangentialField,
    path: SlipPath,
    displacement: TangentialField,
    gap: Vec<f64>,
}

impl Packed {
    fn tangential_problem<'a>(
        &'a self,
        motions: &'a RigidMotions,
        self_influence: f64,
    ) -> TangentialProblem<'a> {
        let Self { bound, before, path, .. } = self;
        TangentialProblem { bound: &bound.bound, before, path, motions, self_influence }
    }
}

impl<'a> Iterate<'a> {
    pub fn new(
        problem: &'a ContactProblem<'a>,
        tractions: &'a mut Tractions,
        displacements: &'a mut Displacements,
        operators: &RegionOperators,
    ) -> Self {
        let own = operators.compliance.self_influence();
        let contact = ContactSet::loaded(&tractions.pressure);
        let motions = problem.motions_of(&contact);
        let mut iterate = Self {
            problem,
            tractions,
            displacements,
            self_influence: [own.normal, own.tangential],
            contact: ContactSet::default(),
            motions,
            tilt: problem.tilt_of(&ContactSet::of(problem.undeformed.len(), |_| true)),
            tilt_of_contact: None,
            gap: Vec::new(),
            normal: NormalResidual { approach: problem.normal.approach, turned: [0.0; 2], residual: 0.0 },
            tangential: TangentialResidual { motion: [0.0; 3], residual: 0.0 },
            known_motion: None,
            slip: SlipIncrement::default(),
            sets: ActiveSets::default(),
            step: ContactVector::default(),
            packed: Packed::default(),
            projection: ShearProjection::default(),
        };
        iterate.change_contact(contact);
        iterate
    }

    /// The same of known rigid motions. Where paths of slip turn more than one goes with the same tractions.
    pub fn near_motion(self, motion: [f64; 3]) -> Self {
        let known_motion = Some(motion).filter(|_| self.problem.path.turns());
        Self { known_motion, ..self }
    }

    /// Whether pressure and shear are unknown.
    pub fn is_of_both(&self) -> bool {
        self.problem.pressure == Pressure::Unknown
    }

    fn change_contact(&mut self, contact: ContactSet) {
        let Self { problem, packed, .. } = self;
        self.motions = problem.motions_of(&contact);
        self.tilt_of_contact = problem.tilt_of(&contact);
        packed.law = problem.friction.packed(&contact);
        contact.pack_tangential(problem.before, &mut packed.before);
        packed.path = problem.path.packed(&contact);
        self.contact = contact;
    }

    /// The residual of complementarity and of Coulomb's law; finds gap, contact, slip and motions.
    pub fn evaluate(&mut self) -> f64 {
        let problem = self.problem;
        let mut worst = 0.0;
        if self.is_of_both() {
            let Self { gap, tilt, tractions, displacements, self_influence: [own, _], .. } = self;
            let (pressure, displacement) = (&tractions.pressure, &displacements.normal);
            let approach = problem.normal.approach_under(pressure);
            let heights = (&displacement[..], problem.undeformed);
            let law = CellLaw::under(&problem.normal, *own);
            self.normal = normal_residual(pressure, heights, law, (approach, tilt.as_ref()), gap);
            worst = self.normal.residual;
            let contact =
                ContactSet::of(gap.len(), |cell| self.tractions.pressure[cell] > 0.0 || self.gap[cell] < 0.0);
            if contact != self.contact {
                self.change_contact(contact);
            }
            self.contact.pack(&self.gap, &mut self.packed.gap);
        }
        let Self { contact, packed, tractions, displacements, .. } = self;
        contact.pack(&tractions.pressure, &mut packed.pressure);
        contact.pack_tangential(&tractions.shear, &mut packed.shear);
        contact.pack_tangential(&displacements.tangential, &mut packed.displacement);
        packed.law.find_bound(&packed.pressure, &mut packed.bound);
        let Self { packed, motions, self_influence: [_, own], .. } = self;
        let equations = packed.tangential_problem(motions, *own);
        let Packed { shear, displacement, .. } = &*packed;
        self.tangential = self.slip.find(&equations, shear, displacement, self.tangential.motion);
        if let Some(motion) = self.known_motion.take() {
            let mut slip = SlipIncrement::default();
            let found = slip.find(&equations, shear, displacement, motion);
            if found.residual < BELIEVED * self.tangential.residual {
                (self.tangential, self.slip) = (found, slip);
            }
        }
        worst.max(self.tangential.residual)
    }

    /// The stick and slip sets.
    pub fn find_sets(&mut self) {
        let Self { packed, slip, self_influence: [_, own], .. } = self;
        let far = self.tangential.residual > FAR;
        self.sets.classify(&packed.shear, &slip.at_end, &packed.bound, (*own, far));
        if far {
            self.sets.direct(&mut packed.shear, &packed.bound.bound);
        }
        self.sets.turn(&packed.path, &slip.slip);
    }

    /// The step that solves the linearised problem to the forcing term.
    pub fn find_step(&mut self, forcing: f64, settings: &SolverSettings, operators: &mut RegionOperators) {
        let Self { problem, packed, self_influence, .. } = self;
        let Packed { pressure, bound, gap, .. } = packed;
        let (size, own) = match problem.pressure {
            Pressure::Unknown => (largest(pressure), self_influence[0]),
            Pressure::Given => (largest(&bound.bound), self_influence[1]),
        };
        let left_over = self.slip.left_over(&self.sets);
        let loads = problem.tangential;
        if loads.any_spring() {
            // The displacement of the spring follows from the shear as it is, not from what the law makes of it.
            let parts = [(&mut left_over.x, &packed.shear.x), (&mut left_over.y, &packed.shear.y)];
            for (mode, (slip, shear)) in parts.into_iter().enumerate() {
                let spring = loads.spring[mode];
                if spring > 0.0 {
                    let motion = (loads.resultant[mode] - sum(shear)) / spring;
                    lower(slip, self.tangential.motion[mode] - motion);
                }
            }
        }
        let steepest = largest(&bound.slope);
        let linearised = Linearised {
            contact: &self.contact,
            sets: &self.sets,
            motions: &self.motions,
            slope: &bound.slope,
            gap,
            slip: left_over.parts(),
            holds_force: problem.normal.total.is_some(),
            tilt: self.tilt_of_contact.as_ref(),
            weight: if steepest > 0.0 { 1.0 / steepest } else { 1.0 },
            give: problem.give(),
            forcing,
            floor: 0.02 * settings.tolerance * size * own,
        };
        let RegionOperators { compliance, preconditioner, linear, .. } = operators;
        linear.solve(&linearised, compliance, preconditioner, &mut self.step);
    }

    /// Adds the step and projects onto what the laws allow. False when no pressure is left.
    pub fn take_step(&mut self) -> bool {
        let Packed { pressure, shear, law, bound, .. } = &mut self.packed;
        let (step, [x, y]) = self.step.parts();
        add_scaled(&mut shear.x, 1.0, x);
        add_scaled(&mut shear.y, 1.0, y);
        let resultant = self.problem.to_restore(shear, &bound.bound);
        if self.problem.pressure == Pressure::Unknown {
            add_scaled(pressure, 1.0, step);
            if !project_pressure(pressure, self.problem.normal.total, self.tilt_of_contact.as_ref()) {
                return false;
            }
            law.find_bound(pressure, bound);
        }
        self.project_shear(resultant);
        let Self { contact, packed, tractions, .. } = self;
        contact.scatter(&packed.pressure, 1.0, &mut tractions.pressure);
        contact.scatter_tangential(&packed.shear, &mut tractions.shear);
        true
    }

    /// Brings packed shear to its discs, where it slips to its circles, and to a `resultant` [pressure].
    fn project_shear(&mut self, resultant: [f64; 3]) {
        let Self { packed: Packed { shear, bound, .. }, sets, motions, projection, .. } = self;
        projection.project(shear, sets, &bound.bound, motions, resultant);
    }

    /// Moves slipping cells that lie inside their friction circles, by what the solution is off, onto these. Whether there were any.
    pub fn puts_slipping_cells_on_their_circles(&mut self) -> bool {
        let [_, own] = self.self_influence;
        let Packed { shear, bound, .. } = &self.packed;
        let end_slip = &self.slip.at_end;
        let slipping: Vec<usize> = (0..self.contact.len())
            .filter(|&cell| {
                let (q, bound) = (shear.at(cell), bound.bound[cell]);
                is_inside(q, bound) && slips(q, end_slip.at(cell), bound, 1.0 / own)
            })
            .collect();
        if slipping.is_empty() {
            return false;
        }
        let resultant = self.problem.to_restore(shear, &bound.bound);
        self.find_sets();
        for cell in slipping {
            self.sets.stick[cell] = 0.0;
        }
        self.project_shear(resultant);
        self.contact.scatter_tangential(&self.packed.shear, &mut self.tractions.shear);
        true
    }

    /// The displacements of the tractions.
    pub fn find_displacements(&mut self, operators: &mut RegionOperators) {
        let Self { problem, tractions, displacements, .. } = self;
        match problem.pressure {
            Pressure::Unknown => operators.compliance.full(tractions.parts(), displacements.parts_mut()),
            Pressure::Given => {
                operators
                    .compliance
                    .tangential(tractions.shear.parts(), displacements.tangential.parts_mut());
            }
        }
    }

    pub fn solution(self, iterations: usize) -> Solution {
        let Self {
            tractions, contact, normal, tangential, gap, slip, sets, step, packed, projection, ..
        } = self;
        drop((sets, step, packed, projection)); // before memory for the next fields is taken
        let scattered = |packed: TangentialField| {
            let mut field = TangentialField::zeros(tractions.pressure.len());
            contact.scatter_tangential(&packed, &mut field);
            field
        };
        let [slip, end_slip] = [slip.slip, slip.at_end].map(scattered);
        Solution { normal, tangential, gap, slip, end_slip, iterations }
    }
}
