//! Numbers of the stress below the surface as results: where each is largest in a history, and how it changes.

use super::beneath::{Beneath, Found, Number};
use super::error::SensitivityError;
use super::largest::Largest;
use super::parameter::Parameter;
use super::row::Composed;
use super::ruiz::ruiz;
use super::scene::Scene;
use super::snapshot::Snapshot;

/// The largest values of numbers, called by their names, in a history, and their derivatives.
pub(super) fn below(
    scene: &Scene<'_>,
    increments: &[&Snapshot],
    numbers: &[(String, Number)],
    parameters: &[Parameter],
) -> Result<Vec<Composed>, SensitivityError> {
    if numbers.is_empty() {
        return Ok(Vec::new());
    }
    let Some(beneath) = Beneath::of(scene.plan, increments, numbers)? else { return Ok(Vec::new()) };
    let found = beneath.largest(numbers)?;
    let of = |((name, number), found): (&(String, Number), Option<Found>)| {
        let what =
            if matches!(number, Number::Ruiz { .. }) { "the surface is not" } else { "no interface is" };
        let found = found.ok_or_else(|| SensitivityError::Objective {
            name: name.clone(),
            reason: format!("{what} among the depths of the case"),
        })?;
        if let Number::Ruiz { with_tension, .. } = number {
            let (largest, fields) = Largest::at(&beneath, number, found)?;
            return ruiz((largest, &fields), *with_tension, scene, parameters);
        }
        Largest::of(&beneath, number, found)?.differentiated(scene, parameters)
    };
    numbers.iter().zip(found).map(of).collect()
}
