//! Von Mises stress in the section y = 0 below the contact, in one increment; the largest value, and how far it is from yield.

use fret_core::history::{History, KeptFields, StepRecord};
use fret_core::model::{Body, HalfSpace};
use fret_core::plan::Plan;
use fret_core::subsurface::{EvenStress, LoadedSurface, automatic_depths, survey};

use crate::failure::Failure;
use crate::interrupt;

/// Depths that are looked at, about.
const DEPTHS: usize = 28;
/// How deep, over the half-width of the contact.
const DEEP: f64 = 2.2;

/// The section of one body.
pub struct StressBelow {
    /// Depths [length].
    pub depths: Vec<f64>,
    /// Von Mises stress `[depth][i]` [pressure].
    pub values: Vec<Vec<f64>>,
    /// Depths of the interfaces [length].
    pub interfaces: Vec<f64>,
    /// The largest value under all cells [pressure], and its depth [length].
    pub largest: (f64, f64),
    /// Yield strength over it, the least of all layers that have one.
    pub margin: Option<f64>,
    /// Which body.
    pub body: &'static str,
}

/// The stress of an increment whose fields are kept; none of bodies that are rigid or apart.
pub fn stress_below(
    plan: &Plan,
    history: &History,
    (record, kept): (&StepRecord, &KeptFields),
) -> Result<Option<StressBelow>, Failure> {
    let bodies = &plan.case.bodies;
    let (half_space, place, body): (&HalfSpace, usize, &str) = match (bodies.lower(), bodies.upper()) {
        (Body::Elastic(lower), _) => (lower, 0, "lower"),
        (_, Body::Elastic(upper)) => (upper, 1, "upper"),
        _ => return Ok(None),
    };
    let Some(pressure) = kept.pressure.clone() else { return Ok(None) };
    let touching = pressure.indexed_iter().filter(|(_, pressure)| **pressure > 0.0);
    let (first, last) =
        touching.fold((usize::MAX, 0), |(first, last), ((i, _), _)| (first.min(i), last.max(i)));
    if first > last {
        return Ok(None);
    }
    let grid = &history.grid;
    let sign = if place == 0 { 1.0 } else { -1.0 };
    let surface = LoadedSurface {
        increment: record.increment,
        pressure,
        shear: kept.shear.as_ref().map(|[x, y]| [x * sign, y * sign]),
        slip: None,
        even: EvenStress {
            bulk: record.bulk_stress[place],
            residual: plan.case.residual_stress[place].clone(),
        },
    };
    let half_width = 0.5 * (last + 1 - first) as f64 * grid.spacing()[0];
    let points = automatic_depths(half_space, DEEP * half_width, DEPTHS);
    let row = grid.cells()[1] / 2;
    let constants = &plan.case.fatigue[place];
    let mut values = vec![Vec::new(); points.len()];
    let mut largest = (0.0, 0.0);
    let mut margin: Option<f64> = None;
    let done = survey(half_space, grid, plan.case.periodic, &points, &[surface], |point, _, field| {
        let at = points[point];
        let mut most = 0.0;
        for ((i, j), _) in field.components[0].indexed_iter() {
            most = f64::max(most, field.at(i, j).von_mises());
        }
        if most > largest.0 {
            largest = (most, at.depth);
        }
        if let Some(strength) = constants.at(at.depth).yield_strength {
            margin = Some(margin.unwrap_or(f64::INFINITY).min(strength / most));
        }
        values[point] = (0..grid.cells()[0]).map(|i| field.at(i, row).von_mises()).collect();
        !interrupt::is_asked()
    });
    done.map_err(|error| Failure::Defect(format!("stress kernels: {error}")))?;
    let depths = points.iter().map(|point| point.depth).collect();
    Ok(Some(StressBelow { depths, values, interfaces: half_space.interfaces(), largest, margin, body }))
}
