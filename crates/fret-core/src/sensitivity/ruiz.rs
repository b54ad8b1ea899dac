//! Ruiz's parameters as results: their largest value at the surface is the largest shear traction of its cell times half the longest chord of its
//! slip, the second one times the largest tension. Each of the three changes with the increments that make it.

use ndarray::Array2;

use super::error::SensitivityError;
use super::field_weights::{FieldWeights, SLIP};
use super::largest::Largest;
use super::parameter::Parameter;
use super::row::{Column, Composed};
use super::scene::Scene;
use crate::case::Side;
use crate::subsurface::fatigue::{RuizParts, SurfacePoint};
use crate::subsurface::{StressField, StressTensor};

/// The derivatives of one of the parameters at its largest place, from the stresses at the surface increment by increment.
pub(super) fn ruiz(
    (mut largest, fields): (Largest<'_>, &[StressField]),
    with_tension: bool,
    scene: &Scene<'_>,
    parameters: &[Parameter],
) -> Result<Composed, SensitivityError> {
    let (beneath, [i, j]) = (largest.beneath, largest.found.cell);
    let pair_at =
        |pair: &Option<[Array2<f64>; 2]>| pair.as_ref().map_or([0.0; 2], |[x, y]| [x[[i, j]], y[[i, j]]]);
    let surfaces = largest.surfaces.iter().map(|&surface| &beneath.surfaces[surface]);
    let (increments, cycle): (Vec<usize>, Vec<SurfacePoint>) = surfaces
        .zip(fields)
        .map(|(surface, field)| {
            let (shear, slip) = (pair_at(&surface.shear), pair_at(&surface.slip));
            (surface.increment, SurfacePoint { shear, slip, stress: field.at(i, j) })
        })
        .unzip();
    let RuizParts { shear: (shear, most), chord: (chord, [from, to]), tension: (tension, tense) } =
        RuizParts::of(&cycle);
    let factor = 0.5 * if with_tension { tension } else { 1.0 };
    let mut columns = Vec::new();
    let mut count = |increment: usize, field: usize, pair: [f64; 2]| {
        for (axis, weight) in pair.into_iter().enumerate().filter(|(_, weight)| *weight != 0.0) {
            let mut weights = Array2::zeros(beneath.plan.grid.cells());
            weights[[i, j]] = weight;
            let weights = FieldWeights::of(field + axis, &weights, scene.plan).in_region(scene);
            columns.push((increment, Column::Field(weights), 1.0));
        }
    };
    // Shear acts on the upper body with the other sign, which its size does not know.
    let sign = if beneath.side == Side::Upper { -1.0 } else { 1.0 };
    if shear > 0.0 && chord > 0.0 {
        count(increments[most], 1, cycle[most].shear.map(|part| sign * factor * chord * part / shear));
        let along = [0, 1].map(|axis| (cycle[to].slip[axis] - cycle[from].slip[axis]) / chord);
        for &increment in &increments[from + 1..=to] {
            count(increment, SLIP, along.map(|part| factor * shear * part));
        }
    }
    let mut found = Composed { value: largest.found.value, columns, by: vec![0.0; parameters.len()] };
    if with_tension {
        let mut by = vec![StressTensor::default(); cycle.len()];
        let slopes = cycle[tense].stress.slopes_of_tension_in_surface();
        by[tense] = StressTensor(slopes.0.map(|part| 0.5 * shear * chord * part));
        largest.cells = vec![([i, j], by)];
        let by_tension = largest.differentiated(scene, parameters)?;
        found.columns.extend(by_tension.columns);
        found.by = by_tension.by;
    }
    Ok(found)
}
