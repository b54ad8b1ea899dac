//! Semismooth Newton method for pressure and shear at once (Christensen, Klarbring, Pang & Stromberg 1998; Alart & Curnier 1991), as a
//! primal-dual active set strategy (Hintermueller, Ito & Kunisch 2003): what every cell does is read off feasible tractions, the
//! problem linearised on these sets is solved inexactly by a Krylov method, and what comes out is projected onto what the laws
//! allow, with exact resultants; until all laws hold. Where the pressure is given, the same for shear alone.

use super::contact_set::ContactSet;
use super::contact_vector::ContactVector;
use super::globalisation::{Backtracking, ForcingTerm};
use super::laws::active_sets::ActiveSets;
use super::laws::complementarity::{NormalResidual, normal_residual};
use super::laws::friction::{FrictionBound, FrictionLaw, is_inside, slips};
use super::laws::projection::{ShearProjection, project_pressure};
use super::laws::rigid_motions::{CellPositions, RigidMotions};
use super::laws::slip::{SlipIncrement, TangentialProblem, TangentialResidual};
use super::laws::slip_path::SlipPath;
use super::linear::solver::Linearised;
use super::operators::RegionOperators;
use super::settings::{IterationCallback, SolveError, SolverSettings};
use super::tractions::{Displacements, Tractions};
use crate::compliance::SurfaceCompliance;
use crate::fields::{CellRule, Reals, add_scaled, each_cell, largest, lower, sum};
use crate::model::TangentialField;

/// What the equations of one increment ask for, over the cells of a region.
#[derive(Debug, Clone, Copy)]
pub struct ContactProblem<'a> {
    /// Whether the pressure is unknown, or given with the tractions to start from.
    pub pressure: Pressure,
    /// Gap before deformation [length].
    pub undeformed: &'a [f64],
    /// The friction law of every cell.
    pub friction: &'a FrictionLaw,
    /// Sum of the pressures over the cells, when the force is prescribed [pressure].
    pub total: Option<f64>,
    /// Approach of the body or of the actuator, when it is prescribed [length].
    pub approach: f64,
    /// By how much the machine gives under a unit of the summed pressure; 0: the approach is that of the body [length/pressure].
    pub approach_give: f64,
    /// Tangential displacement before the increment [length].
    pub before: &'a TangentialField,
    /// What is known of the paths of slip.
    pub path: &'a SlipPath,
    /// Where the cells are.
    pub positions: &'a CellPositions,
    /// Increments of the motions that are prescribed [length].
    pub motion: [f64; 3],
    /// Sums over the cells of shear times mode, for motions that follow from a resultant, at no motion [pressure].
    pub resultant: [f64; 3],
}

impl ContactProblem<'_> {
    /// Approach of the body under pressures, where it does not follow from their sum [length].
    pub fn approach_under(&self, pressure: &[f64]) -> Option<f64> {
        let gives = if self.approach_give > 0.0 { self.approach_give * sum(pressure) } else { 0.0 };
        self.total.is_none().then_some(self.approach - gives)
    }

    /// By how much the machine gives under a unit of the summed traction, normally and along x and y [length/pressure].
    fn give(&self) -> [f64; 3] {
        let [x, y, _] = self.positions.spring.map(|spring| if spring > 0.0 { 1.0 / spring } else { 0.0 });
        [self.approach_give, x, y]
    }

    /// Resultants that a projection restores: those that are prescribed, and those of `shear` where a spring lets them be, as far as
    /// the friction `bound` carries them.
    fn to_restore(self, shear: &TangentialField, bound: &[f64]) -> [f64; 3] {
        let spring = self.positions.spring;
        if spring == [0.0; 3] {
            return self.resultant;
        }
        let found = [sum(&shear.x), sum(&shear.y)];
        let (size, most) = (found[0].hypot(found[1]), sum(bound));
        let fraction = if size > most { most / size } else { 1.0 };
        [0, 1, 2].map(|mode| if spring[mode] > 0.0 { found[mode] * fraction } else { self.resultant[mode] })
    }
}

/// Whether the pressure is one of the unknowns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pressure {
    /// It is.
    Unknown,
    /// It is known, and so is the contact.
    Given,
}

/// What was reached besides tractions and displacements.
#[derive(Debug)]
pub struct Solution {
    /// Approach and complementarity; `None` where the pressure was given.
    pub normal: Option<NormalResidual>,
    /// Motions and Coulomb's law.
    pub tangential: TangentialResidual,
    /// Gap [length]; empty where the pressure was given.
    pub gap: Vec<f64>,
    /// Slip increment [length].
    pub slip: TangentialField,
    /// Slip at the end of the increment, up to a factor [length].
    pub end_slip: TangentialField,
    /// Newton iterations made.
    pub iterations: usize,
}

/// The sets are lost when so many iterations have not brought the residual below [`FAR`].
const LOST_AFTER: usize = 15;
/// Shear of slipping cells that a solution leaves inside its circles, by less than the tolerance, is put there so many times.
const MOST_ROUNDS_TO_CIRCLES: usize = 3;
/// A residual at which the sets are not yet those of the solution.
const FAR: f64 = 0.1;

/// Solves the equations from feasible `tractions` with their `displacements`; both end at the solution, or at what was reached.
///
/// # Errors
/// When the iteration does not converge or is stopped.
pub fn solve(
    problem: &ContactProblem<'_>,
    tractions: &mut Tractions,
    displacements: &mut Displacements,
    operators: &mut RegionOperators,
    settings: &SolverSettings,
    callback: IterationCallback<'_>,
) -> Result<Solution, SolveError> {
    let mut iterate = Iterate::new(problem, tractions, displacements, operators);
    let mut forcing = ForcingTerm::default();
    let mut backtracking = Backtracking::default();
    let mut circles_left = MOST_ROUNDS_TO_CIRCLES;
    operators.linear.begin();
    if problem.give() != [0.0; 3] {
        // A machine that gives much drowns what single precision would leave of the contact's own displacement.
        operators.linear.avoid_single_precision();
    }
    for iteration in 0..settings.max_newton_iterations {
        let residual = iterate.evaluate();
        if callback(iteration, residual).is_break() {
            return Err(SolveError::Stopped);
        }
        if residual < settings.tolerance {
            if circles_left > 0 && iterate.puts_slipping_cells_on_their_circles() {
                circles_left -= 1;
                iterate.find_displacements(operators);
                continue;
            }
            return Ok(iterate.solution(iteration));
        }
        if backtracking.rejects(residual) {
            iterate.go_halfway_back(operators);
            continue;
        }
        if iteration >= LOST_AFTER && forcing.best > FAR {
            break;
        }
        let target = forcing.next(residual, settings.tolerance);
        if forcing.wants_double_precision() {
            operators.linear.avoid_single_precision();
        }
        iterate.find_sets();
        iterate.find_step(target, settings, operators);
        if !iterate.take_step() {
            break;
        }
        iterate.find_displacements(operators);
    }
    Err(SolveError::NotConverged { reached: forcing.best, iterations: settings.max_newton_iterations })
}

/// The residual of tractions with their `displacements`, and what goes with it.
pub fn evaluate(
    problem: &ContactProblem<'_>,
    tractions: &mut Tractions,
    displacements: &mut Displacements,
    operators: &RegionOperators,
) -> (f64, Solution) {
    let mut iterate = Iterate::new(problem, tractions, displacements, operators);
    let residual = iterate.evaluate();
    (residual, iterate.solution(0))
}

/// Brings shear to what the friction law allows under its pressure, with exact resultants.
pub fn make_shear_feasible(
    problem: &ContactProblem<'_>,
    tractions: &mut Tractions,
    operators: &RegionOperators,
) {
    let self_influence = operators.compliance.self_influence().tangential;
    let contact = ContactSet::loaded(&tractions.pressure);
    let bound = problem.friction.packed(&contact).bound(&contact.packed(&tractions.pressure));
    let mut shear = contact.packed_tangential(&tractions.shear);
    let at_rest = TangentialField::zeros(contact.len());
    let equations = TangentialProblem {
        bound: &bound.bound,
        before: &at_rest,
        path: &SlipPath::default(),
        motions: &problem.positions.motions_of(&contact),
        motion: problem.motion,
        resultant: problem.to_restore(&shear, &bound.bound),
        self_influence,
    };
    let sets = ActiveSets::of(&shear, &at_rest, &bound, self_influence);
    ShearProjection::default().project(&mut shear, &sets, &equations);
    contact.scatter_tangential(&shear, &mut tractions.shear);
}

/// Tractions on their way to the solution, with everything that follows from them.
struct Iterate<'a> {
    problem: &'a ContactProblem<'a>,
    tractions: &'a mut Tractions,
    displacements: &'a mut Displacements,
    /// Those before the last step.
    last: Tractions,
    /// Self-influence of a cell, normal and tangential [length/pressure].
    self_influence: [f64; 2],
    contact: ContactSet,
    motions: RigidMotions,
    /// Of the region [length].
    gap: Vec<f64>,
    normal: Option<NormalResidual>,
    tangential: TangentialResidual,
    slip: SlipIncrement,
    sets: ActiveSets,
    step: ContactVector<f64>,
    /// Resultants that the next projection restores [pressure].
    to_restore: [f64; 3],
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
        problem: &ContactProblem<'_>,
        motions: &'a RigidMotions,
        self_influence: f64,
    ) -> TangentialProblem<'a> {
        TangentialProblem {
            bound: &self.bound.bound,
            before: &self.before,
            path: &self.path,
            motions,
            motion: problem.motion,
            resultant: problem.resultant,
            self_influence,
        }
    }
}

impl<'a> Iterate<'a> {
    fn new(
        problem: &'a ContactProblem<'a>,
        tractions: &'a mut Tractions,
        displacements: &'a mut Displacements,
        operators: &RegionOperators,
    ) -> Self {
        let own = operators.compliance.self_influence();
        let contact = ContactSet::loaded(&tractions.pressure);
        let motions = problem.positions.motions_of(&contact);
        let mut iterate = Self {
            problem,
            last: Tractions::default(),
            tractions,
            displacements,
            self_influence: [own.normal, own.tangential],
            contact: ContactSet::default(),
            motions,
            gap: Vec::new(),
            normal: None,
            tangential: TangentialResidual { motion: [0.0; 3], residual: 0.0 },
            slip: SlipIncrement::default(),
            sets: ActiveSets::default(),
            step: ContactVector::default(),
            to_restore: problem.resultant,
            packed: Packed::default(),
            projection: ShearProjection::default(),
        };
        iterate.change_contact(contact);
        iterate
    }

    fn change_contact(&mut self, contact: ContactSet) {
        let Self { problem, packed, .. } = self;
        self.motions = problem.positions.motions_of(&contact);
        packed.law = problem.friction.packed(&contact);
        contact.pack_tangential(problem.before, &mut packed.before);
        packed.path = problem.path.packed(&contact);
        self.contact = contact;
    }

    /// The residual of complementarity and of Coulomb's law; finds gap, contact, slip and motions.
    fn evaluate(&mut self) -> f64 {
        let problem = self.problem;
        let mut worst = 0.0;
        if problem.pressure == Pressure::Unknown {
            let Self { gap, tractions, displacements, .. } = self;
            gap.resize(problem.undeformed.len(), 0.0);
            each_cell(&Height, [&displacements.normal, problem.undeformed], [gap]);
            let approach = problem.approach_under(&tractions.pressure);
            let [own, _] = self.self_influence;
            let normal = normal_residual(&tractions.pressure, gap, problem.undeformed, own, approach);
            self.normal = Some(normal);
            worst = normal.residual;
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
        let equations = packed.tangential_problem(problem, motions, *own);
        let Packed { shear, displacement, .. } = &*packed;
        self.tangential = self.slip.find(&equations, shear, displacement, self.tangential.motion);
        worst.max(self.tangential.residual)
    }

    /// What every cell in contact does.
    fn find_sets(&mut self) {
        let Self { packed, slip, self_influence: [_, own], .. } = self;
        self.sets.classify(&packed.shear, slip.at_end(&packed.path), &packed.bound, *own);
    }

    /// The step that solves the linearised problem as far as the sets deserve it.
    fn find_step(&mut self, forcing: f64, settings: &SolverSettings, operators: &mut RegionOperators) {
        let Self { problem, packed, self_influence, .. } = self;
        let Packed { pressure, bound, gap, .. } = packed;
        let (size, own) = match problem.pressure {
            Pressure::Unknown => (largest(pressure), self_influence[0]),
            Pressure::Given => (largest(&bound.bound), self_influence[1]),
        };
        let mut left_over = self.slip.left_over(&packed.path, &self.sets);
        if self.motions.any_spring() {
            // Of the shear as it is the spring makes another motion than of what the law makes of it.
            let left = left_over.to_mut();
            for (mode, (slip, shear)) in
                [(&mut left.x, &packed.shear.x), (&mut left.y, &packed.shear.y)].into_iter().enumerate()
            {
                let spring = self.motions.spring[mode];
                if spring > 0.0 {
                    let motion = (problem.resultant[mode] - sum(shear)) / spring;
                    lower(slip, self.tangential.motion[mode] - motion);
                }
            }
        }
        let linearised = Linearised {
            contact: &self.contact,
            sets: &self.sets,
            motions: &self.motions,
            slope: &bound.slope,
            gap,
            slip: left_over.parts(),
            holds_force: problem.total.is_some(),
            give: problem.give(),
            forcing,
            most_steps: settings.max_krylov_steps,
            floor: 0.02 * settings.tolerance * size * own,
        };
        let RegionOperators { compliance, preconditioner, linear, .. } = operators;
        linear.solve(&linearised, compliance, preconditioner, &mut self.step);
    }

    /// Adds the step and projects onto what the laws allow. False when no pressure is left.
    fn take_step(&mut self) -> bool {
        let Packed { pressure, shear, law, bound, .. } = &mut self.packed;
        let (step, [x, y]) = self.step.parts();
        add_scaled(&mut shear.x, 1.0, x);
        add_scaled(&mut shear.y, 1.0, y);
        self.to_restore = self.problem.to_restore(shear, &bound.bound);
        if self.problem.pressure == Pressure::Unknown {
            add_scaled(pressure, 1.0, step);
            if !project_pressure(pressure, self.problem.total) {
                return false;
            }
            law.find_bound(pressure, bound);
        }
        self.project_shear();
        let Self { contact, packed, tractions, last, .. } = self;
        std::mem::swap(last, *tractions);
        tractions.resize(last.pressure.len());
        contact.scatter(&packed.pressure, &mut tractions.pressure);
        contact.scatter_tangential(&packed.shear, &mut tractions.shear);
        true
    }

    /// Brings packed shear to its discs, where it slips to its circles, and to its resultants.
    fn project_shear(&mut self) {
        let mut shear = std::mem::take(&mut self.packed.shear);
        let [_, own] = self.self_influence;
        let equations = self.packed.tangential_problem(self.problem, &self.motions, own);
        let equations = TangentialProblem { resultant: self.to_restore, ..equations };
        self.projection.project(&mut shear, &self.sets, &equations);
        self.packed.shear = shear;
    }

    /// Puts the shear of cells that slip, and lie inside their circles by what the solution is off, on these. Whether there were any.
    fn puts_slipping_cells_on_their_circles(&mut self) -> bool {
        let [_, own] = self.self_influence;
        let Packed { shear, bound, .. } = &self.packed;
        let end_slip = self.slip.at_end(&self.packed.path);
        let slipping: Vec<usize> = (0..self.contact.len())
            .filter(|&cell| {
                let (q, bound) = (shear.at(cell), bound.bound[cell]);
                is_inside(q, bound) && slips(q, end_slip.at(cell), bound, 1.0 / own)
            })
            .collect();
        if slipping.is_empty() {
            return false;
        }
        self.to_restore = self.problem.to_restore(&self.packed.shear, &self.packed.bound.bound);
        self.find_sets();
        for cell in slipping {
            self.sets.stick[cell] = 0.0;
        }
        self.project_shear();
        self.contact.scatter_tangential(&self.packed.shear, &mut self.tractions.shear);
        true
    }

    /// The displacements of the tractions.
    fn find_displacements(&mut self, operators: &mut RegionOperators) {
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

    /// To the middle between here and where the last step began, as far as the contact is the same; what slipped there is put back on
    /// its circle.
    fn go_halfway_back(&mut self, operators: &mut RegionOperators) {
        self.tractions.average_with(&self.last);
        if self.sets.len() == self.contact.len() {
            let Self { contact, packed, tractions, .. } = self;
            contact.pack(&tractions.pressure, &mut packed.pressure);
            contact.pack_tangential(&tractions.shear, &mut packed.shear);
            packed.law.find_bound(&packed.pressure, &mut packed.bound);
            self.to_restore = self.problem.to_restore(&packed.shear, &packed.bound.bound);
            self.project_shear();
            self.contact.scatter_tangential(&self.packed.shear, &mut self.tractions.shear);
        }
        self.find_displacements(operators);
    }

    fn solution(self, iterations: usize) -> Solution {
        let scattered = |packed: &TangentialField| {
            let mut field = TangentialField::zeros(self.tractions.pressure.len());
            self.contact.scatter_tangential(packed, &mut field);
            field
        };
        let slip = scattered(&self.slip.slip);
        let end_slip = scattered(self.slip.at_end(&self.packed.path));
        let Self { normal, tangential, gap, .. } = self;
        Solution { normal, tangential, gap, slip, end_slip, iterations }
    }
}

struct Height;

impl CellRule<2, 1, 0> for Height {
    #[inline(always)]
    fn at<R: Reals>(&self, [u, g]: [R; 2], [height]: &mut [R; 1]) -> [R; 0] {
        *height = u + g;
        []
    }
}
