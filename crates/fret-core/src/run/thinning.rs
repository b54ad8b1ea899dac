//! Bodies that wear thinner: their mean depths, when the elastic response is to be found anew, and what one response for all of the contact
//! leaves open.

use ndarray::Array2;

use crate::kernel::{PairResponse, cells_too_coarse_for_incompressible_film};
use crate::model::{Body, ContactPair, ContactState, WearLayers, WearRule, thinned};
use crate::plan::Plan;

/// A layer thinner than this fraction of what it was counts as if it were that thick when its change is judged: it is about gone.
const ABOUT_GONE: f64 = 0.01;

/// What is known of the layers at the end of a cycle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LayersWorn {
    /// Largest depth off the lower and the upper body [length].
    pub depths: [f64; 2],
    /// Compliance of the thinnest place of the contact less that of the thickest, over that of the mean; `None` where the response stays.
    pub compliance_spread: Option<f64>,
}

/// Mean depths off the lower and the upper body over the contact, weighted with the pressure [length]; where nothing touches weighted
/// with the depth.
///
/// `over`: depth off the upper body in the cells over which it lies [length], where the bodies move against each other.
pub fn mean_depths(layers: &WearLayers, state: &ContactState, over: Option<&Array2<f64>>) -> [f64; 2] {
    let Some(worn) = &state.worn_depth else { return [0.0; 2] };
    let touches = state.pressure.iter().any(|pressure| *pressure > 0.0);
    let mean_of = |layers: &WearLayers, worn: &Array2<f64>| {
        let weights = if touches { &state.pressure } else { worn };
        mean(layers, worn, weights)
    };
    match over {
        None => mean_of(layers, worn),
        Some(upper) => [mean_of(&layers.of_body(0), worn)[0], mean_of(&layers.of_body(1), upper)[1]],
    }
}

fn mean(layers: &WearLayers, worn: &Array2<f64>, weights: &Array2<f64>) -> [f64; 2] {
    // Counted from one of the cells: the mean of equal depths is that depth.
    let weighted = || worn.iter().zip(weights).filter(|(_, weight)| **weight > 0.0);
    let Some((first, _)) = weighted().next() else { return [0.0; 2] };
    let one = layers.at_depth(*first).depths;
    let (mut sums, mut all) = ([0.0; 2], 0.0);
    for (depth, weight) in weighted() {
        let depths = layers.at_depth(*depth).depths;
        for body in 0..2 {
            sums[body] += weight * (depths[body] - one[body]);
        }
        all += weight;
    }
    [0, 1].map(|body| (one[body] + sums[body] / all).max(0.0))
}

/// The depths for which the response is to be found anew, where those for which it was found are no longer near enough.
pub fn due(
    rule: &WearRule,
    found_for: [f64; 2],
    (state, over): (&ContactState, Option<&Array2<f64>>),
) -> Option<[f64; 2]> {
    let (layers, tolerance) = rule.layers.as_ref().zip(rule.thinning_tolerance)?;
    let now = mean_depths(layers, state, over);
    let bodies = layers.bodies();
    let is_far = (0..2).any(|body| {
        let mut end = 0.0;
        for layer in bodies[body] {
            let start = end;
            end += layer.thickness;
            if end.is_infinite() {
                // A half-space stays one.
                return found_for[body] < start && now[body] >= start;
            }
            if found_for[body] < end {
                let change = (now[body] - found_for[body]).abs();
                let left = (end - found_for[body]).max(ABOUT_GONE * layer.thickness);
                return now[body] >= end || change > tolerance * left;
            }
        }
        false
    });
    is_far.then_some(now)
}

/// The bodies that are left under mean depths.
///
/// # Errors
/// Why there are none that the grid can work with.
pub fn bodies_left(plan: &Plan, depths: [f64; 2]) -> Result<ContactPair, &'static str> {
    let left = thinned(&plan.case.bodies, depths).map_err(|_| "they are worn down to what is rigid")?;
    let unseen = |body: &Body| match body {
        Body::Rigid => false,
        Body::Elastic(half_space) => {
            cells_too_coarse_for_incompressible_film(half_space, plan.grid.spacing())
        }
    };
    if !plan.case.periodic.is_both() && (unseen(left.lower()) || unseen(left.upper())) {
        return Err(
            "a nearly incompressible film on a stiff base is worn thinner than a fifth of a cell, which the grid cannot resolve",
        );
    }
    Ok(left)
}

/// What is known of the layers at the end of a cycle whose contact has an area [length^2, of a line contact length].
pub fn layers_worn(
    plan: &Plan,
    rule: &WearRule,
    (state, over): (&ContactState, Option<&Array2<f64>>),
    area: f64,
) -> Option<LayersWorn> {
    let (layers, worn) = rule.layers.as_ref().zip(state.worn_depth.as_ref())?;
    let most_of = |field: &Array2<f64>| field.iter().copied().fold(0.0, f64::max);
    let deepest = match &state.upper_worn_depth {
        None => layers.at_depth(most_of(worn)).depths,
        Some(upper) => [most_of(worn), most_of(upper)],
    };
    let spread = || {
        // Depths off both bodies in a cell; together, and of each.
        let depths_at = |cell: (usize, usize)| match over {
            None => (worn[cell], layers.at_depth(worn[cell]).depths),
            Some(upper) => (worn[cell] + upper[cell], [worn[cell], upper[cell]]),
        };
        let touching = state.pressure.indexed_iter().filter(|(_, pressure)| **pressure > 0.0);
        let mut ends: Option<[(f64, [f64; 2]); 2]> = None;
        for (cell, _) in touching {
            let here = depths_at(cell);
            let [least, most] = ends.unwrap_or([here; 2]);
            ends = Some([
                if here.0 < least.0 { here } else { least },
                if here.0 > most.0 { here } else { most },
            ]);
        }
        let ends = ends?;
        let radius = plan.grid.dimension().radius(area);
        let compliance = |depths: [f64; 2]| {
            let left = thinned(&plan.case.bodies, depths).ok()?;
            Some(PairResponse::new(&left).times_k(1.0 / radius).zz)
        };
        let ends = ends.map(|(_, depths)| compliance(depths));
        let mean = compliance(mean_depths(layers, state, over))?;
        Some((ends[1]? - ends[0]?).abs() / mean).filter(|spread| spread.is_finite())
    };
    Some(LayersWorn { depths: deepest, compliance_spread: rule.thinning_tolerance.and_then(|_| spread()) })
}
