//! Pressure and shear together: zones frozen from feasible tractions, a Krylov method on the frozen problem with a
//! flexible preconditioner, resultants held exactly; then back to feasible tractions, until all laws hold.

use super::alternating::solve_alternating;
use super::contact_set::ContactSet;
use super::coulomb::{CoulombJudge, TangentialTask, TangentialVerdict};
use super::fronts::Fronts;
use super::frozen::{Frozen, KrylovMemory, floor};
use super::packed::Packed;
use super::patience::{Patience, enough};
use super::preconditioner::Preconditioner;
use super::residual::{NormalVerdict, judge_normal};
use super::retraction::{Retraction, retract_pressure};
use super::rigid::{Places, RigidModes};
use super::settings::{SolveError, SolverSettings, Watch};
use super::tractions::{Displacements, Tractions};
use super::zones::Zones;
use crate::compliance::SurfaceCompliance;
use crate::model::TangentialField;
use crate::model::each_cell::{CellRule, Reals, each_cell};

/// What the coupled equations of one increment ask for, over the cells of a box.
#[derive(Debug)]
pub struct CoupledTask<'a> {
    /// Gap before deformation [length].
    pub undeformed: &'a [f64],
    /// Friction coefficient of every cell [-].
    pub friction: &'a [f64],
    /// Sum of the pressures over the cells, when the force is prescribed [pressure].
    pub total: Option<f64>,
    /// Approach, when it is prescribed [length].
    pub approach: f64,
    /// Tangential displacement before the increment [length].
    pub before: &'a TangentialField,
    /// Where the cells are.
    pub places: &'a Places,
    /// Increments of the motions that are prescribed [length].
    pub motion: [f64; 3],
    /// Sums over the cells of shear times mode, for motions that follow from a resultant [pressure].
    pub resultant: [f64; 3],
}

impl CoupledTask<'_> {
    /// The tangential equations under a friction bound, packed.
    pub fn tangential<'a>(
        &self,
        contact: &'a ContactSet,
        bound: &'a [f64],
        before: &'a TangentialField,
        modes: &'a RigidModes,
        own: f64,
    ) -> TangentialTask<'a> {
        TangentialTask {
            shape: self.places.shape(),
            contact,
            bound,
            before,
            modes,
            motion: self.motion,
            resultant: self.resultant,
            own,
        }
    }
}

/// What the coupled solver reached.
#[derive(Debug)]
pub struct CoupledSolution {
    /// Approach and normal residual.
    pub normal: NormalVerdict,
    /// Motions and tangential residual.
    pub tangential: TangentialVerdict,
    /// Gap [length].
    pub gap: Vec<f64>,
    /// Minus the slip increment of the box [length].
    pub s: TangentialField,
    /// Outer iterations made.
    pub iterations: usize,
}

/// Changes of the zones that pressure and shear are given together before they are solved in turn.
const TOGETHER_AT_MOST: usize = 60;
/// The zones are lost when so many changes have not brought the residual below [`FAR`].
const LOST_AFTER: usize = 15;
/// A residual at which the zones are not yet those of the solution.
const FAR: f64 = 0.1;
/// Residuals to which lost zones are brought in turn before they are followed together again.
const NEAR: [f64; 2] = [1e-2, 1e-4];

/// Solves the coupled equations from feasible `tractions` with their `displacements`; both end at the solution. Together; zones
/// that are lost so are brought near the solution in turn, which wanders less, and go on together from there.
pub fn solve_together(
    task: &CoupledTask<'_>,
    (tractions, displacements): (&mut Tractions, &mut Displacements),
    compliance: &mut dyn SurfaceCompliance,
    preconditioner: &mut Preconditioner,
    krylov: &mut KrylovMemory,
    settings: &SolverSettings,
    watch: Watch<'_>,
) -> Result<CoupledSolution, SolveError> {
    let together = SolverSettings {
        most_outer_iterations: settings.most_outer_iterations.min(TOGETHER_AT_MOST),
        ..*settings
    };
    let mut near = tractions.clone();
    for tolerance in NEAR.map(Some).into_iter().chain([None]) {
        let solution = solve_coupled(
            task,
            (&mut *tractions, &mut *displacements),
            compliance,
            preconditioner,
            krylov,
            &together,
            watch,
        );
        let Err(SolveError::NotConverged { .. }) = solution else { return solution };
        let Some(tolerance) = tolerance else { break };
        tractions.copy_from(&near);
        compliance.full(tractions.parts(), displacements.parts_mut());
        let rough = SolverSettings { tolerance, ..together };
        if let Err(SolveError::Stopped) =
            solve_alternating(task, tractions, displacements, compliance, preconditioner, &rough, watch)
        {
            return Err(SolveError::Stopped);
        }
        near.copy_from(tractions);
    }
    tractions.copy_from(&near);
    compliance.full(tractions.parts(), displacements.parts_mut());
    solve_alternating(task, tractions, displacements, compliance, preconditioner, settings, watch)
}

/// Follows pressure and shear together from feasible `tractions` with their `displacements`.
fn solve_coupled(
    task: &CoupledTask<'_>,
    (tractions, displacements): (&mut Tractions, &mut Displacements),
    compliance: &mut dyn SurfaceCompliance,
    preconditioner: &mut Preconditioner,
    krylov: &mut KrylovMemory,
    settings: &SolverSettings,
    watch: Watch<'_>,
) -> Result<CoupledSolution, SolveError> {
    let cells = task.undeformed.len();
    let own = compliance.own();
    let prescribed = if task.total.is_none() { Some(task.approach) } else { None };
    krylov.begin(cells);
    let mut judge = CoulombJudge::default();
    let mut retraction = Retraction::default();
    let mut gap = vec![0.0; cells];
    let mut motion = [0.0; 3];
    let mut contact = ContactSet::default();
    // Whether the contact is another than that of the last frozen problem; between the two a step may be taken back.
    let mut changed = true;
    let mut modes = task.places.modes(&contact);
    let mut packed = Packed::default();
    let [mut before, mut displaced] = [TangentialField::default(), TangentialField::default()];
    let mut heights = Vec::new();
    let mut zones = Zones::default();
    let mut patience = Patience::default();
    let mut fronts = Fronts::default();
    let mut retreat = Retreat::new(cells);
    for iteration in 0..settings.most_outer_iterations {
        each_cell(&Height, [&displacements.normal, task.undeformed], [&mut gap]);
        let normal = judge_normal(&tractions.pressure, &mut gap, task.undeformed, own.normal, prescribed);
        let touching = ContactSet::of(cells, |cell| tractions.pressure[cell] > 0.0 || gap[cell] < 0.0);
        if iteration == 0 || touching != contact {
            changed = true;
            contact = touching;
            modes = task.places.modes(&contact);
            before = contact.packed_tangential(task.before);
            packed.change_contact(&contact, task.friction);
        }
        packed.take(&contact, tractions);
        contact.pack_tangential(&displacements.tangential, &mut displaced);
        let tangential = {
            let judged = task.tangential(&contact, &packed.bound, &before, &modes, own.tangential);
            judge.judge(&judged, &packed.shear, &displaced, motion)
        };
        motion = tangential.motion;
        let residual = normal.residual.max(tangential.residual);
        if watch(iteration, residual).is_break() {
            return Err(SolveError::Stopped);
        }
        if krylov.rough.is_too_rough(residual, settings.tolerance) {
            krylov.rough.with_all_digits(tractions, displacements, compliance);
            continue;
        }
        if residual < settings.tolerance {
            let mut s = TangentialField::zeros(cells);
            contact.scatter_tangential(&judge.s, &mut s);
            return Ok(CoupledSolution { normal, tangential, gap, s, iterations: iteration });
        }
        if iteration >= LOST_AFTER && patience.best > FAR {
            break;
        }
        if retreat.takes_back(residual, tractions, displacements) {
            krylov.rough.averaged();
            packed.forget();
            continue;
        }
        let theta = patience.hears(residual);
        zones.classify(&packed.shear, &judge.s, &packed.bound);
        zones.weigh(own.tangential);
        let frozen = Frozen {
            contact: &contact,
            zones: &zones,
            modes: &modes,
            packed: &packed,
            holds_force: task.total.is_some(),
            most: settings.most_inner_iterations,
            floor: floor(settings.tolerance, &packed.pressure, own.normal),
            enough: enough(settings.tolerance, residual),
            theta,
            exact: patience.is_at_an_end(),
            changed,
        };
        contact.pack(&gap, &mut heights);
        frozen.solve(&heights, &judge.s, krylov, compliance, preconditioner);
        changed = false;
        packed.add(&krylov.step);
        if !retract_pressure(&mut packed.pressure, task.total) {
            break;
        }
        packed.find_bound();
        let Packed { shear, bound, .. } = &mut packed;
        let judged = task.tangential(&contact, bound, &before, &modes, own.tangential);
        fronts.carry_on(shear, &zones, &judged);
        retraction.shear(shear, &zones, &judged);
        retreat.keep(tractions, displacements);
        packed.give(&contact, tractions);
        let (tractions_before, before) = &retreat.kept;
        krylov.rough.follow(
            residual,
            settings.tolerance,
            (&*tractions, &mut *displacements),
            (tractions_before, before),
            compliance,
        );
    }
    Err(SolveError::NotConverged { reached: patience.best, iterations: settings.most_outer_iterations })
}

/// Takes back by half a step that made things much worse.
struct Retreat {
    kept: (Tractions, Displacements),
    residual: f64,
    halvings: usize,
}

impl Retreat {
    fn new(cells: usize) -> Self {
        let kept = (Tractions::zeros(cells), Displacements::zeros(cells));
        Self { kept, residual: f64::INFINITY, halvings: 0 }
    }

    /// Goes halfway back to what was kept; tells whether.
    fn takes_back(
        &mut self,
        residual: f64,
        tractions: &mut Tractions,
        displacements: &mut Displacements,
    ) -> bool {
        if residual > 4.0 * self.residual && self.halvings < 4 {
            self.halvings += 1;
            tractions.average_with(&self.kept.0);
            displacements.average_with(&self.kept.1);
            return true;
        }
        self.residual = residual;
        self.halvings = 0;
        false
    }

    /// Keeps what was reached; leaves fields to be overwritten.
    fn keep(&mut self, tractions: &mut Tractions, displacements: &mut Displacements) {
        std::mem::swap(&mut self.kept.0, tractions);
        std::mem::swap(&mut self.kept.1, displacements);
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
