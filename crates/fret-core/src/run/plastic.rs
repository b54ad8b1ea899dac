//! What has yielded, as an increment's record tells it.

use crate::history::PlasticRecord;
use crate::model::ContactState;
use crate::plan::Plan;
use crate::solver::yields_from;

/// What of the whole contact has yielded in a state; nothing where no surface ever yields.
pub fn plastic(state: &ContactState, plan: &Plan) -> PlasticRecord {
    let Some(depth) = &state.plastic_depth else { return PlasticRecord::default() };
    let area = plan.area_of_cell();
    let at_hardness = |hardness: f64| {
        let limit = yields_from(hardness);
        state.pressure.iter().filter(|pressure| **pressure >= limit).count()
    };
    PlasticRecord {
        area: plan.case.hardness.map_or(0, at_hardness) as f64 * area,
        volume: depth.sum() * area,
        max_depth: depth.iter().copied().fold(0.0, f64::max),
        work: state.plastic_work,
    }
}
