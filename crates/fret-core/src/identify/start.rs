//! Where a fit starts, and units that cannot be.

use super::computed::Loop;
use super::cycles::MeasuredCycle;
use super::error::{IdentifyError, refused};
use super::model::Model;
use super::quantities::Known;
use super::turns::calm_range;

/// Forces over the normal force outside of which units are wrong.
const FORCES: [f64; 2] = [1e-3, 5.0];
/// A rig, or a displacement, that is so many times what it is compared with is of another unit.
const FAR: f64 = 300.0;
/// Part of the friction force that a contact carries nearly without slip.
const CARRIED: f64 = 0.2;

/// Friction, stiffness of the rig and amplitude to start from, with their loop; refuses units that cannot be.
pub fn first_guess(
    name: &str,
    cycle: &MeasuredCycle,
    model: &Model<'_>,
) -> Result<([f64; 3], Loop), IdentifyError> {
    let [low, high] = calm_range(&cycle.displacement);
    let [bottom, top] = calm_range(&cycle.force);
    let (amplitude, force) = (0.5 * (high - low), 0.5 * (top - bottom));
    let slope = cycle.slope_after_reversal().unwrap_or(force / amplitude);
    let friction = model.friction().unwrap_or(0.5);
    let probed = |amplitude: f64| {
        let probed = |model: &Model<'_>| model.loop_of(friction, slope, amplitude, None);
        probed(model.coarse()).or_else(|_| probed(model))
    };
    let mut probe = probed(amplitude)?;
    let ratio = force / probe.normal_force;
    if !(FORCES[0]..=FORCES[1]).contains(&ratio) {
        return Err(refused(
            name,
            &format!(
                "the tangential force has an amplitude of {force:.4e}, {ratio:.3e} times the normal force of {:.4e}: friction coefficients lie between 0.01 and 2",
                probe.normal_force
            ),
            "is the unit of the force right? --units \"force=mN\", or units in the case",
        ));
    }
    if !probe.tells_stiffness() {
        // All of it slides at once: the contact's own stiffness is seen at a force that it carries.
        probe = probed(CARRIED * friction * probe.normal_force / slope)?;
    }
    let own = probe.contact_stiffness;
    let of_unit = "is the unit of the displacement right? --units \"displacement=um\"; and are the moduli of the case in its units?";
    if !(own > 0.0 && own.is_finite()) {
        let what = format!(
            "the loop rises by {slope:.4e} after reversal: with such a displacement and this force nothing can be computed of the case"
        );
        return Err(refused(name, &what, of_unit));
    }
    let compared = format!("{:.3e} times the stiffness of the contact itself, {own:.4e}", slope / own);
    if slope > 5.0 * own {
        let what = format!(
            "the loop rises by {slope:.4e} after reversal, {compared}: nothing in series with it can be stiffer"
        );
        return Err(refused(name, &what, of_unit));
    }
    if slope < own / FAR {
        let what = format!(
            "the loop rises by {slope:.4e} after reversal, only {compared}: a rig that gives so much measures itself alone"
        );
        return Err(refused(name, &what, of_unit));
    }
    let series = 1.0 / slope - 1.0 / own;
    let stiffness = if series > 0.05 / own { 1.0 / series } else { 20.0 * own };
    let known = Known { normal_force: probe.normal_force, stiffness: None, flanks: None, correlation: 0.0 };
    let energy = cycle.quantities(known).dissipated_energy;
    // In partial slip more than the force asks for; the less is dissipated, the more.
    let friction = cycle.plateau(slope, 0.0).map_or_else(
        || {
            let width = energy / (force * force / own);
            ratio * (0.25 / width.max(0.01)).clamp(1.15, 3.0)
        },
        |plateau| plateau / cycle.normal_force.unwrap_or(probe.normal_force),
    );
    let start = [friction, stiffness, amplitude];
    let first = model.loop_of(friction, stiffness, amplitude, None)?;
    Ok((start, first))
}
