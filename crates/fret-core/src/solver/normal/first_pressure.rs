//! The pressure that a first contact starts from where there are no coarser grids.

use super::super::prescribed::NormalLoad;
use super::equations::NormalEquations;
use super::yielding;

/// A first pressure: uniform over the eighth of the cells with the smallest gap under a force, over more where the hardness asks for these; the
/// self-influences alone under an approach.
pub fn first_pressure(task: &NormalEquations<'_>, own: f64) -> Vec<f64> {
    let NormalLoad { total, approach, hardness, .. } = task.load;
    let Some(total) = total else {
        let most = hardness.unwrap_or(f64::INFINITY);
        let pressure = |gap: &f64| (((approach - gap) / own).max(0.0) * 0.1).min(most);
        return task.undeformed.iter().map(pressure).collect();
    };
    let mut gaps: Vec<f64> = task.undeformed.to_vec();
    let eighth = (gaps.len() / 8).max(1);
    let fewest = hardness.map_or(1, |hardness| yielding::cells_for(total, hardness, gaps.len()));
    let (_, limit, _) = gaps.select_nth_unstable_by(eighth.max(fewest) - 1, f64::total_cmp);
    let limit = *limit;
    let count = task.undeformed.iter().filter(|gap| **gap <= limit).count();
    task.undeformed.iter().map(|gap| if *gap <= limit { total / count as f64 } else { 0.0 }).collect()
}
