//! What of a solved increment goes into the history.

use crate::footprint::Footprint;
use crate::history::{KeptFields, Residual, StepRecord};
use crate::model::field::largest;
use crate::solver::Increment;

/// The record of a solved increment; what it has worn is not yet known.
pub fn record(solved: &Increment, increment: usize, stage: usize, parts: usize, wall_s: f64) -> StepRecord {
    let state = &solved.state;
    let outcome = &solved.outcome;
    let [qx, qy] = &state.shear;
    // A root only where it may be the largest.
    let larger = |most: f64, (x, y): (&f64, &f64)| {
        if x.abs() + y.abs() > most { most.max(x.hypot(*y)) } else { most }
    };
    let max_shear = qx.iter().zip(qy).fold(0.0, larger);
    StepRecord {
        increment,
        stage,
        parts,
        normal_force: outcome.resultants.normal,
        approach: state.approach,
        tangential_force: outcome.resultants.tangential,
        shift: state.shift,
        twist_moment: outcome.resultants.moment,
        twist: state.twist,
        max_pressure: state.pressure.as_slice().map_or(0.0, largest),
        max_shear,
        contact_area: solved.contact_area,
        stick_area: solved.stick_area,
        contact_cells: outcome.contact_cells,
        stick_cells: outcome.stick_cells,
        footprint: Footprint::of(&state.zone),
        dissipated_energy: state.dissipated_energy,
        worn_volume: 0.0,
        max_worn_depth: 0.0,
        regime: outcome.regime,
        residual: Residual { ..outcome.residual },
        work: solved.work,
        wall_s,
    }
}

/// Its fields by the names asked for; the worn depth is not yet known.
pub fn kept(solved: &Increment, increment: usize, names: &[String]) -> KeptFields {
    let asked = |name: &str| names.iter().any(|asked| asked == name);
    let state = &solved.state;
    KeptFields {
        increment,
        pressure: asked("pressure").then(|| state.pressure.clone()),
        shear: asked("shear").then(|| state.shear.clone()),
        slip: asked("slip").then(|| state.slip.clone()),
        gap: asked("gap").then(|| solved.gap.clone()),
        zone: asked("zone").then(|| state.zone.clone()),
        worn_depth: None,
    }
}
