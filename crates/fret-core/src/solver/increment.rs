//! One increment in a region: everything the equations need, gathered; and the order in which it is solved.

use std::borrow::Cow;

use ndarray::Array2;

use super::contact_set::ContactSet;
use super::exact_newton;
use super::laws::complementarity::{NormalResidual, normal_residual};
use super::laws::friction::FrictionLaw;
use super::laws::limit::carried_fraction;
use super::laws::projection::project_pressure;
use super::laws::rigid_motions::{CellPositions, RigidMotions};
use super::laws::slip::TangentialResidual;
use super::laws::slip_path::SlipPath;
use super::memory::{Before, Drift};
use super::newton::{self, ContactProblem, Pressure, Solution};
use super::normal::{NormalEquations, first_pressure, full_contact_pressure, solve_normal};
use super::operators::{Method, RegionOperators};
use super::outcome::Resultants;
use super::region::Region;
use super::settings::{Coupling, IterationCallback, SolveError, SolverSettings};
use super::staggered;
use super::tractions::{Displacements, Tractions};
use crate::compliance::{SpectralCompliance, SurfaceCompliance};
use crate::fields::add_scaled;
use crate::model::{
    ContactState, Control, CoulombFriction, LoadStep, Rig, Scheme, SurfaceGrid, TangentialField,
};

/// Residual to which the frictionless start of a coupled contact is solved.
const ROUGH: f64 = 1e-2;

/// Residual of the pressure without friction that a second start, and the limit of friction, are taken from.
const FRICTIONLESS: f64 = 1e-6;
/// Friction that carries less than this fraction of what is prescribed is the reason why there is no solution. By the pressure without
/// friction: coupling takes some of it away. A sphere that slides at a given approach carried 0.89 to 0.997 of it (friction 0.3 to 2,
/// Poisson's ratio -0.5 to 0.3, with and without coatings).
const LIMIT: f64 = 0.98;

/// Newton iterations of the rule of second order; where it converges it takes about six.
const MOST_TURNING: usize = 24;

/// One increment in one region.
pub struct IncrementProblem<'a> {
    pub grid: &'a SurfaceGrid,
    /// The state before.
    pub state: &'a ContactState,
    pub region: Region,
    pub friction: FrictionLaw,
    pub positions: CellPositions,
    undeformed: Vec<f64>,
    /// Sum of the pressures over the cells, when the force is prescribed [pressure].
    total: Option<f64>,
    approach: f64,
    /// By how much the machine gives under a unit of the summed pressure, where its far end is prescribed [length/pressure].
    approach_give: f64,
    /// Increments of prescribed motions: shift, twist x length [length].
    motion: [f64; 3],
    /// Sums of shear times mode over the cells, for motions by force, at no motion [pressure].
    resultant: [f64; 3],
    periodic: bool,
    /// What is known of the paths of slip.
    pub path: SlipPath,
    /// A pressure to start from, whatever the state before.
    start: Option<Vec<f64>>,
    /// What the bulk stresses do in the increment.
    pub stretch: Stretch,
}

/// How much more the lower surface is strained than the upper one in an increment.
#[derive(Debug, Clone, Copy)]
pub struct Stretch {
    /// Increment of the strain along x and y [-].
    pub strain: [f64; 2],
    /// Where the middle of the grid is [length].
    pub middle: [f64; 2],
    /// What is prescribed at the end.
    pub load: LoadStep,
    /// The machine that prescribes it.
    pub rig: Rig,
}

impl Stretch {
    /// Whether there is none.
    pub fn is_none(&self) -> bool {
        self.strain == [0.0; 2]
    }

    /// Relative displacement of a cell, lower surface less upper [length].
    pub fn at(&self, grid: &SurfaceGrid, cell: [usize; 2]) -> [f64; 2] {
        [0, 1].map(|axis| self.strain[axis] * (self.middle[axis] + grid.centre(axis, cell[axis])))
    }
}

/// A solved region.
pub struct Solved {
    /// Pressure and shear.
    pub tractions: Tractions,
    /// Their displacements.
    pub displacements: Displacements,
    /// Gap [length].
    pub gap: Vec<f64>,
    /// Slip increment [length].
    pub slip: TangentialField,
    /// Slip at the end of the increment, up to a factor [length].
    pub end_slip: TangentialField,
    /// Change of the tangential displacement of the upper body over the lower, in every cell [length].
    pub drift: TangentialField,
    pub normal: NormalResidual,
    pub tangential: TangentialResidual,
    /// 1 / K of a cell [pressure/length].
    pub tangential_stiffness: f64,
    /// Outer iterations.
    pub iterations: usize,
}

impl<'a> IncrementProblem<'a> {
    /// Gathers what an increment needs inside `region`.
    pub fn new(
        grid: &'a SurfaceGrid,
        undeformed: &Array2<f64>,
        friction: &CoulombFriction,
        (state, load): (&'a ContactState, &LoadStep),
        region: Region,
        periodic: bool,
        (start, stretch): (Option<&Array2<f64>>, Stretch),
    ) -> Self {
        let centres = |axis: usize| -> Vec<f64> {
            (0..region.shape[axis]).map(|index| grid.centre(axis, region.origin[axis] + index)).collect()
        };
        let controls = [load.tangential[0], load.tangential[1], load.twist];
        let by_force = controls.map(|control| !matches!(control, Control::Motion(_)));
        let rotates = state.twist != 0.0 || load.twist != Control::Motion(0.0);
        let positions = CellPositions::new(centres(0), centres(1), rotates, by_force);
        let area = grid.cell_area();
        let now = [state.shift[0], state.shift[1], state.twist];
        let units = [1.0, 1.0, positions.length];
        let mut motion = [0.0; 3];
        let mut resultant = [0.0; 3];
        let mut spring = [0.0; 3];
        let [x, y] = stretch.rig.tangential;
        for (mode, compliance) in [x, y, 0.0].into_iter().enumerate() {
            match controls[mode] {
                Control::FarEnd(target) if compliance > 0.0 => {
                    spring[mode] = 1.0 / (compliance * area);
                    resultant[mode] = (target - now[mode]) * spring[mode];
                }
                Control::Motion(target) | Control::FarEnd(target) => {
                    motion[mode] = (target - now[mode]) * units[mode];
                }
                Control::Force(target) => resultant[mode] = target / (area * units[mode]),
            }
        }
        // The far end of a spring that does not give is the body itself.
        let by_force = [0, 1, 2].map(|mode| {
            by_force[mode] && (matches!(controls[mode], Control::Force(_)) || spring[mode] > 0.0)
        });
        let positions = positions.with_springs(by_force, spring);
        let (total, approach) = match load.normal {
            Control::Force(force) => (Some(force / area), state.approach),
            Control::Motion(approach) | Control::FarEnd(approach) => (None, approach),
        };
        let approach_give = match load.normal {
            Control::FarEnd(_) => stretch.rig.normal * area,
            Control::Force(_) | Control::Motion(_) => 0.0,
        };
        Self {
            grid,
            state,
            region,
            friction: FrictionLaw::in_region(friction, region),
            positions,
            undeformed: region.gather(undeformed),
            total,
            approach,
            approach_give,
            motion,
            resultant,
            periodic,
            path: SlipPath::default(),
            start: start.map(|pressure| region.gather(pressure)),
            stretch,
        }
    }

    /// The solution where the bodies do not touch under these loads.
    pub fn apart(&self) -> Option<Solved> {
        let lowest = self.undeformed.iter().copied().fold(f64::INFINITY, f64::min);
        let (apart, approach) = match self.total {
            Some(total) => (total <= 0.0, lowest),
            None => (self.approach <= lowest, self.approach),
        };
        let len = self.region.len();
        let spring = self.positions.spring;
        let motion = [0, 1, 2].map(|mode| {
            // A spring that carries nothing keeps its length.
            if spring[mode] > 0.0 { self.resultant[mode] / spring[mode] } else { self.motion[mode] }
        });
        apart.then(|| Solved {
            tractions: Tractions::zeros(len),
            displacements: Displacements::zeros(len),
            gap: self.undeformed.iter().map(|gap| gap - approach).collect(),
            slip: TangentialField::zeros(len),
            end_slip: TangentialField::zeros(len),
            drift: TangentialField::zeros(len),
            normal: NormalResidual { approach, residual: 0.0 },
            tangential: TangentialResidual { motion, residual: 0.0 },
            tangential_stiffness: 1.0,
            iterations: 0,
        })
    }

    /// Solves the increment from predicted `tractions`. `last`: displacements of the state before, when they are known; `unchanged`:
    /// its normal load is the one asked for.
    ///
    /// # Errors
    /// When no method converges, or the iteration is stopped.
    pub fn solve(
        &self,
        tractions: Tractions,
        (last, unchanged): (Option<&Displacements>, bool),
        operators: &mut RegionOperators,
        method: &Method<'_>,
        callback: IterationCallback<'_>,
    ) -> Result<Solved, SolveError> {
        match method.coupling {
            Coupling::Coupled => self.solve_coupled(tractions, last, operators, method, callback),
            Coupling::Uncoupled | Coupling::Frictionless => {
                self.solve_sequentially(tractions, (last, unchanged), operators, method, callback)
            }
        }
    }

    /// Settings with fewer iterations where the end-point rule is left to fall back on.
    fn limited(&self, settings: &SolverSettings) -> SolverSettings {
        let most = if self.path.turns() { MOST_TURNING } else { usize::MAX };
        SolverSettings { max_newton_iterations: settings.max_newton_iterations.min(most), ..*settings }
    }

    /// Pressure and shear together.
    fn solve_coupled(
        &self,
        mut tractions: Tractions,
        last: Option<&Displacements>,
        operators: &mut RegionOperators,
        method: &Method<'_>,
        callback: IterationCallback<'_>,
    ) -> Result<Solved, SolveError> {
        let settings = &self.limited(method.settings);
        let mut displacements = Displacements::zeros(self.region.len());
        let mut before = TangentialField::zeros(self.region.len());
        if self.touched() {
            before = self.displacement_before(last, &mut operators.compliance, true);
        } else {
            tractions.shear.clear();
            tractions.pressure = self.first_pressure(operators);
            let rough = SolverSettings { tolerance: ROUGH, ..*settings };
            self.solve_pressure(&mut tractions, &mut displacements, operators, &rough, callback)?;
        }
        self.stretch_before(&mut before);
        self.make_pressure_feasible(&mut tractions);
        let counted_from = self.counted_from(&before);
        let problem = self.contact_problem(Pressure::Unknown, &counted_from);
        newton::make_shear_feasible(&problem, &mut tractions, operators);
        operators.compliance.full(tractions.parts(), displacements.parts_mut());
        let start = tractions.clone();
        let solution = match settings.scheme {
            Scheme::Monolithic => {
                newton::solve(&problem, &mut tractions, &mut displacements, operators, settings, callback)
            }
            Scheme::Staggered => {
                staggered::solve(&problem, &mut tractions, &mut displacements, operators, settings, callback)
            }
        };
        let solution = match solution {
            Err(failed @ SolveError::NotConverged { .. })
                if settings.scheme == Scheme::Monolithic && !self.path.turns() =>
            {
                let frictionless = self.frictionless(&start, operators, settings, callback)?;
                self.check_limit(&frictionless)?;
                let starts = [&start, &frictionless];
                let ends = (&mut tractions, &mut displacements);
                exact_newton::solve(&problem, starts, ends, operators, method, callback)?.ok_or(failed)
            }
            other => other,
        }?;
        let own = operators.compliance.self_influence();
        let Solution { normal, tangential, gap, slip, end_slip, iterations } = solution;
        let normal = normal.unwrap_or(NormalResidual { approach: self.approach, residual: f64::INFINITY });
        let tangential_stiffness = 1.0 / own.tangential;
        let drift = self.drift(&before, &displacements.tangential, tangential.motion);
        Ok(Solved {
            tractions,
            displacements,
            gap,
            slip,
            end_slip,
            drift,
            normal,
            tangential,
            tangential_stiffness,
            iterations,
        })
    }

    /// Pressure first, then shear on it: for bodies whose shear does not move the surfaces normally.
    fn solve_sequentially(
        &self,
        mut tractions: Tractions,
        (last, unchanged): (Option<&Displacements>, bool),
        operators: &mut RegionOperators,
        method: &Method<'_>,
        callback: IterationCallback<'_>,
    ) -> Result<Solved, SolveError> {
        let len = self.region.len();
        let settings = &self.limited(method.settings);
        let own = operators.compliance.self_influence();
        let mut displacements = Displacements::zeros(len);
        let (mut gap, normal, mut iterations);
        if let (true, Some(last)) = (unchanged && settings.reuse_pressure, last) {
            tractions.pressure = self.region.gather(&self.state.pressure);
            displacements.normal.clone_from(&last.normal);
            gap = displacements.normal.iter().zip(&self.undeformed).map(|(u, g)| u + g).collect::<Vec<_>>();
            let gives = self.normal_equations().given_way(&tractions.pressure);
            let approach = self.total.is_none().then_some(self.approach - gives);
            normal = normal_residual(&tractions.pressure, &mut gap, &self.undeformed, own.normal, approach);
            iterations = 0;
        } else {
            let usable = project_pressure(&mut tractions.pressure, self.total);
            if self.start.is_some() || !self.touched() || !usable {
                tractions.pressure = self.first_pressure(operators);
            }
            (normal, gap, iterations) =
                self.solve_pressure(&mut tractions, &mut displacements, operators, settings, callback)?;
        }
        let mut drift = TangentialField::zeros(len);
        let (mut slip, mut end_slip) = (TangentialField::zeros(len), TangentialField::zeros(len));
        let mut tangential = TangentialResidual { motion: self.motion, residual: 0.0 };
        if method.coupling == Coupling::Frictionless || settings.skip_unloaded_shear && !self.causes_shear() {
            tractions.shear.clear();
        } else {
            let mut before = self.displacement_before(last, &mut operators.compliance, false);
            self.stretch_before(&mut before);
            let counted_from = self.counted_from(&before);
            let problem = self.contact_problem(Pressure::Given, &counted_from);
            newton::make_shear_feasible(&problem, &mut tractions, operators);
            operators.compliance.tangential(tractions.shear.parts(), displacements.tangential.parts_mut());
            let solution =
                newton::solve(&problem, &mut tractions, &mut displacements, operators, settings, callback);
            if let (Err(SolveError::NotConverged { .. }), false) = (&solution, self.path.turns()) {
                self.check_limit(&tractions)?;
            }
            let solution = solution?;
            drift = self.drift(&before, &displacements.tangential, solution.tangential.motion);
            (slip, end_slip) = (solution.slip, solution.end_slip);
            tangential = solution.tangential;
            iterations += solution.iterations;
        }
        let tangential_stiffness = if own.tangential > 0.0 { 1.0 / own.tangential } else { 0.0 };
        Ok(Solved {
            tractions,
            displacements,
            gap,
            slip,
            end_slip,
            drift,
            normal,
            tangential,
            tangential_stiffness,
            iterations,
        })
    }

    /// Solves the frictionless problem from the pressure there is; shear stays as it is.
    fn solve_pressure(
        &self,
        tractions: &mut Tractions,
        displacements: &mut Displacements,
        operators: &mut RegionOperators,
        settings: &SolverSettings,
        callback: IterationCallback<'_>,
    ) -> Result<(NormalResidual, Vec<f64>, usize), SolveError> {
        let RegionOperators { compliance, preconditioner, .. } = operators;
        compliance.normal(&tractions.pressure, &mut displacements.normal);
        let solution = solve_normal(
            &self.normal_equations(),
            &mut tractions.pressure,
            &mut displacements.normal,
            compliance,
            preconditioner,
            settings,
            callback,
        )?;
        Ok((solution.residual, solution.gap, solution.iterations))
    }

    /// The pressure without friction, from that of other tractions; as far as it is found.
    fn frictionless(
        &self,
        start: &Tractions,
        operators: &mut RegionOperators,
        settings: &SolverSettings,
        callback: IterationCallback<'_>,
    ) -> Result<Tractions, SolveError> {
        let mut tractions = start.clone();
        tractions.shear.clear();
        let mut displacements = Displacements::zeros(self.region.len());
        let settings = SolverSettings { tolerance: FRICTIONLESS, ..*settings };
        match self.solve_pressure(&mut tractions, &mut displacements, operators, &settings, callback) {
            Err(SolveError::Stopped) => Err(SolveError::Stopped),
            _ => Ok(tractions),
        }
    }

    fn touched(&self) -> bool {
        self.state.pressure.iter().any(|p| *p > 0.0)
    }

    /// Whether anything asks for shear, or has left some.
    fn causes_shear(&self) -> bool {
        self.motion != [0.0; 3]
            || !self.stretch.is_none()
            || self.resultant != [0.0; 3]
            || self.state.shear.iter().any(|shear| shear.iter().any(|q| *q != 0.0))
    }

    fn contact_problem<'b>(&'b self, pressure: Pressure, before: &'b TangentialField) -> ContactProblem<'b> {
        ContactProblem {
            pressure,
            undeformed: &self.undeformed,
            friction: &self.friction,
            total: self.total,
            approach: self.approach,
            approach_give: self.approach_give,
            before,
            path: &self.path,
            positions: &self.positions,
            motion: self.motion,
            resultant: self.resultant,
        }
    }

    fn normal_equations(&self) -> NormalEquations<'_> {
        NormalEquations {
            undeformed: &self.undeformed,
            total: self.total,
            approach: self.approach,
            give: self.approach_give,
        }
    }

    /// A first pressure; exact at once where a periodic problem is in full contact.
    fn first_pressure(&self, operators: &mut RegionOperators) -> Vec<f64> {
        if let Some(start) = &self.start {
            return start.clone();
        }
        let equations = self.normal_equations();
        let full = if self.periodic {
            full_contact_pressure(&equations, &mut operators.preconditioner)
        } else {
            None
        };
        full.unwrap_or_else(|| first_pressure(&equations, operators.compliance.self_influence().normal))
    }

    /// Brings predicted pressure to what its laws allow.
    fn make_pressure_feasible(&self, tractions: &mut Tractions) {
        if let Some(total) = self.total {
            // Shear keeps its ratio to the pressure: what was on its circle stays there.
            let found: f64 = tractions.pressure.iter().map(|p| p.max(0.0)).sum();
            if found > 0.0 {
                for q in tractions.shear.x.iter_mut().chain(&mut tractions.shear.y) {
                    *q *= total / found;
                }
            }
        }
        project_pressure(&mut tractions.pressure, self.total);
    }

    /// Whether friction can carry what is prescribed, at the pressure without it.
    fn check_limit(&self, tractions: &Tractions) -> Result<(), SolveError> {
        let contact = ContactSet::loaded(&tractions.pressure);
        let bound = self.friction.packed(&contact).bound(&contact.packed(&tractions.pressure));
        let motions = RigidMotions { by_force: self.positions.held(), ..self.positions.motions_of(&contact) };
        let prescribed = motions.only_by_force(self.resultant);
        let fraction = carried_fraction(&bound.bound, &motions, prescribed);
        if fraction > LIMIT {
            return Ok(());
        }
        let [x, y, moment] = prescribed;
        if moment != 0.0 {
            return Err(SolveError::AboveFullSlip { fraction });
        }
        let asked = x.hypot(y) * self.grid.cell_area();
        Err(SolveError::AboveSliding { asked, bound: fraction * asked })
    }

    /// Displacement from which the law counts slip.
    fn counted_from<'b>(&self, before: &'b TangentialField) -> Cow<'b, TangentialField> {
        if !self.path.turns() {
            return Cow::Borrowed(before);
        }
        let mut from = before.clone();
        from.add_scaled(-1.0, &self.path.ahead);
        Cow::Owned(from)
    }

    /// Change of the tangential displacement of the upper body over the lower in every cell of the region.
    fn drift(&self, before: &TangentialField, after: &TangentialField, motion: [f64; 3]) -> TangentialField {
        let motions = self.positions.motions_of(&ContactSet::of(self.region.len(), |_| true));
        let mut drift = before.clone();
        drift.add_scaled(-1.0, after);
        for cell in 0..self.region.len() {
            let (moved, here) = (motions.at(motion, cell), drift.at(cell));
            drift.set(cell, [here[0] + moved[0], here[1] + moved[1]]);
        }
        drift
    }

    /// The drift of the last increment in every cell of the region.
    pub fn drift_to_here(
        &self,
        before: &Before,
        drift: &Drift,
        operators: &mut RegionOperators,
        coupling: Coupling,
    ) -> TangentialField {
        let Self { region, grid, state, .. } = self;
        let change = |now: &Array2<f64>, then: &Array2<f64>| {
            let mut change = region.gather(now);
            add_scaled(&mut change, -1.0, &region.gather(then));
            change
        };
        let pressure = change(&state.pressure, &before.tractions.pressure);
        let [x, y] = [0, 1].map(|axis| change(&state.shear[axis], &before.tractions.shear[axis]));
        let mut moved = Displacements::zeros(region.len());
        if coupling == Coupling::Coupled {
            operators.compliance.full([&pressure, &x, &y], moved.parts_mut());
        } else {
            operators.compliance.tangential([&x, &y], moved.tangential.parts_mut());
        }
        let [shift_x, shift_y, twist] = drift.motion;
        let mut found = moved.tangential;
        for cell in 0..region.len() {
            let [i, j] =
                [region.origin[0] + cell / region.shape[1], region.origin[1] + cell % region.shape[1]];
            let u = found.at(cell);
            let turned = [-twist * grid.centre(1, j), twist * grid.centre(0, i)];
            let [x, y] = Stretch { strain: drift.strain, ..self.stretch }.at(grid, [i, j]);
            found.set(cell, [shift_x + turned[0] - u[0] - x, shift_y + turned[1] - u[1] - y]);
        }
        found
    }

    /// Tangential displacement of the state before, in the region.
    fn displacement_before(
        &self,
        last: Option<&Displacements>,
        compliance: &mut SpectralCompliance,
        from_pressure: bool,
    ) -> TangentialField {
        if let Some(last) = last {
            return last.tangential.clone();
        }
        let mut before = TangentialField::zeros(self.region.len());
        let shear = self.region.gather_tangential(&self.state.shear);
        if from_pressure {
            let pressure = self.region.gather(&self.state.pressure);
            let mut normal = vec![0.0; self.region.len()];
            let ([from_x, from_y], [to_x, to_y]) = (shear.parts(), before.parts_mut());
            compliance.full([&pressure, from_x, from_y], [&mut normal, to_x, to_y]);
        } else if shear.x.iter().chain(&shear.y).any(|q| *q != 0.0) {
            compliance.tangential(shear.parts(), before.parts_mut());
        }
        before
    }

    /// Takes the relative displacement by the bulk stresses off the displacement before: slip counts its increment alone.
    fn stretch_before(&self, before: &mut TangentialField) {
        if self.stretch.is_none() {
            return;
        }
        let columns = self.region.shape[1];
        for cell in 0..self.region.len() {
            let at = [self.region.origin[0] + cell / columns, self.region.origin[1] + cell % columns];
            let [x, y] = self.stretch.at(self.grid, at);
            before.x[cell] -= x;
            before.y[cell] -= y;
        }
    }

    /// How far resultants are from the prescribed ones, relative to the normal force; the tangential ones to the `limit` of friction.
    pub fn off_equilibrium(&self, found: &Resultants, limit: f64) -> f64 {
        let area = self.grid.cell_area();
        let normal = match self.total {
            Some(total) if total > 0.0 => (found.normal / (total * area) - 1.0).abs(),
            _ => 0.0,
        };
        let lengths = [1.0, 1.0, self.positions.length];
        let found = [found.tangential[0], found.tangential[1], found.moment];
        (0..3).filter(|&mode| limit > 0.0 && self.positions.held()[mode]).fold(normal, |worst, mode| {
            worst.max((found[mode] / lengths[mode] - self.resultant[mode] * area).abs() / limit)
        })
    }
}
