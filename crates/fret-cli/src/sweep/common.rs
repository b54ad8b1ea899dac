//! What points of a sweep begin with alike: solved once, by the first point that comes to it; the others go on from there. Their bits are
//! those of a point alone.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use fret_core::machine::memory::{self, Claim};
use fret_core::plan::{LeaveOut, Plan};
use fret_core::run::{Beginning, Simulation, beginnings};

use crate::interrupt::Listener;
use crate::origin::Origin;
use crate::output::fnv1a64;
use crate::sweep::Point;

/// The common beginnings of a sweep.
pub struct CommonBeginnings {
    /// For each point that has one.
    of_points: HashMap<usize, Arc<Common>>,
    count: usize,
    /// The plans that were made to find them, of points without fields of their own.
    plans: Mutex<HashMap<usize, Plan>>,
}

/// First stages that several points have in common.
struct Common {
    /// How many stages.
    stages: usize,
    /// Their solution in memory of its own; `None` where there is none, or not the memory for it.
    solution: OnceLock<Option<(Arc<Beginning>, Claim)>>,
}

impl CommonBeginnings {
    /// Those of the open points. A point that is refused has none, nor has a sweep of one point.
    pub fn of(points: &[Point], open: &[usize], origin: Option<&Origin>) -> Self {
        let mut all: Vec<(usize, Vec<String>)> = Vec::new();
        let mut plans = HashMap::new();
        if open.len() > 1 {
            for &number in open {
                if let Ok(plan) = points[number].case_file.planned_leaving_out(LeaveOut::ALL, origin) {
                    let digests = beginnings(&plan).iter().map(|text| fnv1a64(text.as_bytes())).collect();
                    all.push((number, digests));
                    if plan.case.profile.heights.is_empty() && !plan.case.friction.is_map() {
                        plans.insert(number, plan);
                    }
                }
            }
        }
        let mut counts: HashMap<&str, usize> = HashMap::new();
        for digest in all.iter().flat_map(|(_, digests)| digests) {
            *counts.entry(digest.as_str()).or_default() += 1;
        }
        let mut common: HashMap<&str, Arc<Common>> = HashMap::new();
        let mut of_points = HashMap::new();
        for (number, digests) in &all {
            // The last stage ends the point: a point that is another one's double is solved by itself.
            let before_last = digests.len().saturating_sub(1);
            let longest = (1..=before_last).rev().find(|count| counts[digests[count - 1].as_str()] > 1);
            if let Some(stages) = longest {
                let of_these = common.entry(digests[stages - 1].as_str());
                let one = of_these.or_insert_with(|| Arc::new(Common { stages, solution: OnceLock::new() }));
                of_points.insert(*number, Arc::clone(one));
            }
        }
        Self { of_points, count: common.len(), plans: Mutex::new(plans) }
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.count
    }

    /// The plan of a point, where it was made and kept; once.
    pub fn plan_of(&self, number: usize) -> Option<Plan> {
        self.plans.lock().unwrap_or_else(PoisonError::into_inner).remove(&number)
    }

    /// What a point begins with, solved by now; `None` where it is to be solved alone.
    pub fn of_point(
        &self,
        number: usize,
        plan: &Plan,
        simulation: &Simulation<'_>,
    ) -> Option<Arc<Beginning>> {
        let common = self.of_points.get(&number)?;
        let solve = || {
            // A state and what the solver remembers: less than the run takes in all.
            let claim = memory::claim(plan.memory_bytes / 2).ok()?;
            let beginning = simulation.beginning(common.stages, &mut Listener).ok()??;
            Some((Arc::new(beginning), claim))
        };
        common.solution.get_or_init(solve).as_ref().map(|(beginning, _)| Arc::clone(beginning))
    }
}
