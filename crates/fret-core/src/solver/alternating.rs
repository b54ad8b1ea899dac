//! The scheme of the published three-level method: pressure at given shear, then shear at given pressure, each by its
//! conjugate gradients, in turn until the laws of both hold at once. For comparison and cross-check: the coupled solver
//! needs several times fewer convolutions.

use super::contact_set::ContactSet;
use super::coulomb::{CoulombJudge, TangentialTask};
use super::coupled::{CoupledSolution, CoupledTask};
use super::normal::{NormalTask, solve_normal};
use super::preconditioner::Preconditioner;
use super::residual::judge_normal;
use super::retraction::Retraction;
use super::settings::{SolveError, SolverSettings, Watch};
use super::shear::solve_shear;
use super::tractions::{Displacements, Tractions};
use super::zones::Zones;
use crate::compliance::SurfaceCompliance;
use crate::model::TangentialField;
use crate::model::field::add_scaled;

/// Share of the residual reached so far to which pressure and shear are solved in their turn.
const INNER: f64 = 0.1;

/// Solves the coupled equations from feasible `tractions` with their `displacements`; both end at the solution.
pub fn solve_alternating(
    task: &CoupledTask<'_>,
    tractions: &mut Tractions,
    displacements: &mut Displacements,
    compliance: &mut dyn SurfaceCompliance,
    preconditioner: &mut Preconditioner,
    settings: &SolverSettings,
    watch: Watch<'_>,
) -> Result<CoupledSolution, SolveError> {
    let cells = task.undeformed.len();
    let own = compliance.own();
    let prescribed = if task.total.is_none() { Some(task.approach) } else { None };
    let unloaded = Tractions::zeros(cells);
    let mut from_pressure = Displacements::zeros(cells);
    let mut from_shear = Displacements::zeros(cells);
    let mut judge = CoulombJudge::default();
    let mut motion = [0.0; 3];
    let mut best = f64::INFINITY;
    for sweep in 0..settings.most_outer_iterations {
        let mut gap: Vec<f64> =
            displacements.normal.iter().zip(task.undeformed).map(|(u, g)| u + g).collect();
        let normal = judge_normal(&tractions.pressure, &mut gap, task.undeformed, own.normal, prescribed);
        let contact = ContactSet::of(cells, |cell| tractions.pressure[cell] > 0.0);
        let modes = task.places.modes(&contact);
        let before = contact.packed_tangential(task.before);
        let bound = packed_bound(&contact, &tractions.pressure, task.friction);
        let tangential = judge.judge(
            &task.tangential(&contact, &bound, &before, &modes, own.tangential),
            &contact.packed_tangential(&tractions.shear),
            &contact.packed_tangential(&displacements.tangential),
            motion,
        );
        motion = tangential.motion;
        let residual = normal.residual.max(tangential.residual);
        best = best.min(residual);
        if watch(sweep, residual).is_break() {
            return Err(SolveError::Stopped);
        }
        if residual < settings.tolerance {
            let mut s = TangentialField::zeros(cells);
            contact.scatter_tangential(&judge.s, &mut s);
            return Ok(CoupledSolution { normal, tangential, gap, s, iterations: sweep });
        }
        let inner = SolverSettings {
            tolerance: (INNER * residual.min(1.0)).max(0.3 * settings.tolerance),
            ..*settings
        };
        // Pressure, over the surface that the shear has displaced.
        compliance.full([&unloaded.pressure, &tractions.shear.x, &tractions.shear.y], from_shear.parts_mut());
        let mut undeformed = task.undeformed.to_vec();
        add_scaled(&mut undeformed, 1.0, &from_shear.normal);
        let normal_task = NormalTask { undeformed: &undeformed, total: task.total, approach: task.approach };
        compliance.normal(&tractions.pressure, &mut from_pressure.normal);
        solve_normal(
            &normal_task,
            &mut tractions.pressure,
            &mut from_pressure.normal,
            compliance,
            preconditioner,
            &inner,
            watch,
        )?;
        // Shear, under that pressure and its tangential displacement.
        compliance
            .full([&tractions.pressure, &unloaded.shear.x, &unloaded.shear.y], from_pressure.parts_mut());
        let contact = ContactSet::of(cells, |cell| tractions.pressure[cell] > 0.0);
        let modes = task.places.modes(&contact);
        let mut before = contact.packed_tangential(task.before);
        before.add_scaled(-1.0, &contact.packed_tangential(&from_pressure.tangential));
        let bound = packed_bound(&contact, &tractions.pressure, task.friction);
        let tangential_task: TangentialTask<'_> =
            task.tangential(&contact, &bound, &before, &modes, own.tangential);
        let mut shear = contact.packed_tangential(&tractions.shear);
        let at_rest = TangentialField::zeros(contact.len());
        let zones = Zones::of(&shear, &at_rest, &bound);
        Retraction::default().shear(&mut shear, &zones, &tangential_task);
        contact.scatter_tangential(&shear, &mut tractions.shear);
        compliance.tangential(tractions.shear.parts(), from_shear.tangential.parts_mut());
        solve_shear(
            &tangential_task,
            &mut shear,
            &mut from_shear.tangential,
            compliance,
            preconditioner,
            &inner,
            watch,
        )?;
        contact.scatter_tangential(&shear, &mut tractions.shear);
        compliance.full(tractions.parts(), displacements.parts_mut());
    }
    Err(SolveError::NotConverged { reached: best, iterations: settings.most_outer_iterations })
}

fn packed_bound(contact: &ContactSet, pressure: &[f64], friction: &[f64]) -> Vec<f64> {
    contact.cells().map(|cell| pressure[cell] * friction[cell]).collect()
}
