//! What of a solved increment goes into the history.

use ndarray::Array2;

use crate::fields::{copied, largest};
use crate::history::{DebrisRecord, Footprint, KeptFields, PlasticRecord, Regime, Residual, StepRecord};
use crate::machine::memory::MemoryError;
use crate::model::{CellMap, CellValues, ContactState, CoulombFriction, Periodicity, Rig, Symmetry, Zone};
use crate::solver::Increment;

/// The record of a solved increment of surfaces that may repeat; what it has worn is not yet known.
pub fn record(
    solved: &Increment,
    (rig, friction, (symmetry, periodic)): (Rig, &CoulombFriction, (Symmetry, Periodicity)),
    (increment, stage, parts): (usize, usize, usize),
    wall_s: f64,
) -> StepRecord {
    let state = &solved.state;
    let outcome = &solved.outcome;
    let [qx, qy] = &state.shear;
    // A root only where it may be the largest.
    let larger = |most: f64, (x, y): (&f64, &f64)| {
        if x.abs() + y.abs() > most { most.max(x.hypot(*y)) } else { most }
    };
    let rubs = !matches!(outcome.regime, Regime::Apart | Regime::Frictionless);
    let max_shear = if rubs { qx.iter().zip(qy).fold(0.0, larger) } else { 0.0 };
    StepRecord {
        increment,
        stage,
        parts,
        normal_force: outcome.resultants.normal,
        approach: state.approach,
        mean_gap: periodic.is_both().then(|| mean_gap(solved)).flatten(),
        tangential_force: outcome.resultants.tangential,
        shift: state.shift,
        actuator_approach: rig.actuator_approach(state.approach, outcome.resultants.normal),
        actuator: rig.actuator(state.shift, outcome.resultants.tangential),
        twist_moment: outcome.resultants.moment,
        twist: state.twist,
        tilt: state.tilt,
        tilt_moment: outcome.resultants.tilt_moment,
        bulk_stress: state.bulk_stress,
        bulk_work: state.bulk_work,
        max_pressure: state.pressure.as_slice().map_or(0.0, largest),
        max_shear,
        contact_area: solved.contact_area,
        stick_area: solved.stick_area,
        contact_cells: outcome.contact_cells,
        stick_cells: outcome.stick_cells,
        footprint: Footprint::of(&state.zone, symmetry, periodic),
        dissipated_energy: state.dissipated_energy,
        elastic_energy: state.elastic_energy,
        external_work: state.external_work,
        wear_work: state.wear_work,
        unresolved_energy: state.unresolved_energy,
        worn_volume: 0.0,
        max_worn_depth: 0.0,
        debris: DebrisRecord::default(),
        plastic: PlasticRecord::default(),
        friction_coefficient: mean_coefficient(friction, &state.pressure),
        roll: state.roll,
        creepage: None,
        spin: None,
        rolling_friction: None,
        regime: outcome.regime,
        residual: Residual { ..outcome.residual },
        work: solved.work,
        wall_s,
    }
}

/// What there is by distance rolled between two states: creepage along x and y [-], spin [rad/length] and dissipated energy [force].
pub fn tell_rates(record: &mut StepRecord, before: &ContactState, after: &ContactState) {
    let rolled = (after.roll[0] - before.roll[0]).hypot(after.roll[1] - before.roll[1]);
    if rolled == 0.0 {
        return;
    }
    record.creepage = Some([0, 1].map(|axis| (after.shift[axis] - before.shift[axis]) / rolled));
    record.spin = Some((after.twist - before.twist) / rolled);
    record.rolling_friction = Some((after.dissipated_energy - before.dissipated_energy) / rolled);
}

/// Its fields by the names asked for, made whole; the worn depth is not yet known.
///
/// # Errors
/// When there is no memory for them: they are what grows while a run goes.
pub fn kept(
    solved: &Increment,
    (friction, symmetry): (&CoulombFriction, Symmetry),
    increment: usize,
    names: &[String],
) -> Result<KeptFields, MemoryError> {
    let asked = |name: &str| names.iter().any(|asked| asked == name);
    let state = &solved.state;
    let one =
        |name: &str, field: &Array2<f64>| asked(name).then(|| whole(field, [false; 2], symmetry)).transpose();
    let two = |name: &str, [x, y]: &[Array2<f64>; 2]| {
        let part = |axis, field| whole(field, symmetry.shear_is_odd(axis), symmetry);
        asked(name).then(|| Ok([part(0, x)?, part(1, y)?])).transpose()
    };
    let coefficients = if asked("friction") {
        Array2::from_shape_fn(state.pressure.dim(), |(i, j)| friction.at(i, j))
    } else {
        Array2::zeros([0, 0])
    };
    Ok(KeptFields {
        memory: None,
        increment,
        pressure: one("pressure", &state.pressure)?,
        shear: two("shear", &state.shear)?,
        slip: two("slip", &state.slip)?,
        gap: one("gap", &solved.gap)?,
        zone: asked("zone").then(|| whole_zones(&state.zone, symmetry)).transpose()?,
        friction_work: solved
            .friction_work
            .as_ref()
            .and_then(|work| one("friction_work", work).transpose())
            .transpose()?,
        worn_depth: None,
        own_worn_depth: None,
        debris: None,
        plastic_depth: state
            .plastic_depth
            .as_ref()
            .and_then(|depth| one("plastic_depth", depth).transpose())
            .transpose()?,
        friction: one("friction", &coefficients)?,
        rest: None,
    })
}

/// Mean gap [length]: none, without rounding, where the surfaces touch everywhere.
fn mean_gap(solved: &Increment) -> Option<f64> {
    let touch_everywhere = solved.state.pressure.iter().all(|pressure| *pressure > 0.0);
    if touch_everywhere { Some(0.0) } else { solved.gap.mean() }
}

/// Mean coefficient of friction over the contact, weighted with the pressure [-]: what sliding carries of the normal force. Over all cells
/// where nothing touches.
pub fn mean_coefficient(friction: &CoulombFriction, pressure: &Array2<f64>) -> f64 {
    let CellValues::Map(CellMap(coefficients)) = friction.coefficient() else { return friction.largest() };
    // Counted from one of them: the mean of equal numbers is that number.
    let one = coefficients.iter().next().copied().unwrap_or_default();
    let (mut weighted, mut weights, mut plain) = (0.0, 0.0, 0.0);
    for (coefficient, pressure) in coefficients.iter().zip(pressure) {
        weighted += (coefficient - one) * pressure;
        weights += pressure;
        plain += coefficient - one;
    }
    one + if weights > 0.0 { weighted / weights } else { plain / coefficients.len().max(1) as f64 }
}

/// A field of the whole contact that changes its sign behind the mirrors where it is odd, in memory that is asked for first.
///
/// # Errors
/// When there is none.
pub fn whole(part: &Array2<f64>, odd: [bool; 2], symmetry: Symmetry) -> Result<Array2<f64>, MemoryError> {
    let cells = symmetry.whole_of(part.dim().into());
    ask_for::<f64>(cells)?;
    Ok(if symmetry.any() { symmetry.whole(part, odd) } else { copied(part) })
}

/// The same of zones.
fn whole_zones(part: &Array2<Zone>, symmetry: Symmetry) -> Result<Array2<Zone>, MemoryError> {
    ask_for::<Zone>(symmetry.whole_of(part.dim().into()))?;
    Ok(symmetry.whole_zones(part))
}

/// Whether there is memory for a field.
fn ask_for<T>([nx, ny]: [usize; 2]) -> Result<(), MemoryError> {
    let asked = Vec::<T>::new().try_reserve_exact(nx * ny);
    asked.map_err(|_| MemoryError::NotGiven((nx * ny * size_of::<T>()) as u64))
}
