//! The open points of a sweep, planned: what they have in common.

use std::collections::HashMap;
use std::sync::Mutex;

use fret_core::plan::{LeaveOut, Plan};
use fret_core::run::{InCommon, beginnings};

use crate::interrupt;
use crate::sweep::Point;
use crate::threads::locked;
use fret_results::Origin;

/// Whether the case of a point asks for stresses, temperatures or resistances.
pub fn asks_for_more(plan: &Plan) -> bool {
    plan.case.stress.is_some() || !plan.case.conduction.is_none()
}

/// Points, planned once.
pub struct Planned {
    /// What they have in common.
    pub common: InCommon,
    /// The plans, of points without fields of their own.
    plans: Mutex<HashMap<usize, Plan>>,
}

impl Planned {
    /// The open points, one after the other: threads of their own would take address space from those that solve. A point that is refused has
    /// nothing in common with others, nor has a sweep of one; where somebody asks to stop, points are left out.
    pub fn of(points: &[Point], open: &[usize], origin: Option<&Origin>) -> Self {
        let plan = |number: &usize| {
            if open.len() < 2 || interrupt::is_asked() {
                return None;
            }
            let plan = points[*number]
                .case_file
                .planned_leaving_out(LeaveOut::ALL, origin.map(|origin| &origin.start))
                .ok()?;
            // The fields of a common beginning belong to none of the points, and stresses ask for those of the whole history.
            let beginnings = if asks_for_more(&plan) { Vec::new() } else { beginnings(&plan) };
            let is_small = plan.case.profile.heights.is_empty() && !plan.case.friction.is_map();
            Some(((*number, beginnings), is_small.then_some((*number, plan))))
        };
        let (histories, plans): (Vec<_>, Vec<_>) = open.iter().filter_map(plan).unzip();
        Self { common: InCommon::of(&histories), plans: Mutex::new(plans.into_iter().flatten().collect()) }
    }

    /// The plan of a point, where it was made and kept; once.
    pub fn plan_of(&self, number: usize) -> Option<Plan> {
        locked(&self.plans).remove(&number)
    }
}
