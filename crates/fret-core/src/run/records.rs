//! What a run has written down so far, and the history that it makes of it in the end.

use super::checkpoint::{Checkpoint, Place, solved_state};
use super::surfaces::Underway;
use crate::history::{CycleRecord, History, KeptFields, StepRecord, Warning, WornByLayer};
use crate::model::ContactState;
use crate::plan::Plan;

/// What a run has written down so far.
#[derive(Debug, Default)]
pub struct Records {
    /// One record an increment.
    pub steps: Vec<StepRecord>,
    /// One record a cycle.
    pub cycles: Vec<CycleRecord>,
    /// Kept fields, of the whole contact.
    pub fields: Vec<KeptFields>,
    /// What about these numbers may mislead.
    pub warnings: Vec<Warning>,
}

impl Records {
    /// The history of a plan that ends at a place, in a state in front of the mirrors.
    pub fn history(
        self,
        plan: &Plan,
        (place, state): (&Place, ContactState),
        underway: Underway<'_>,
    ) -> History {
        let case = &plan.case;
        let Self { steps, cycles, fields, warnings } = self;
        let end = solved_state(place, state.beside(|_| true), underway);
        let end = plan.symmetry.whole_solved(end);
        let state = plan.symmetry.whole_state(state);
        let layers = case.wear.as_ref().and_then(|rule| rule.layers.as_ref());
        History {
            grid: plan.grid,
            bodies: case.bodies.clone(),
            periodic: case.periodic,
            stages: case.stages.iter().map(|stage| stage.name.clone()).collect(),
            steps,
            cycles,
            worn_through: place.worn_through,
            worn_by_layer: layers.zip(state.worn_depth.as_ref()).map(|(layers, depth)| {
                match &state.upper_worn_depth {
                    None => WornByLayer::new(layers, depth, plan.grid.cell_area()),
                    Some(upper) => WornByLayer::of_bodies(layers, [depth, upper], plan.grid.cell_area()),
                }
            }),
            fields,
            state,
            end,
            plan: plan.to_json(),
            warnings,
        }
    }
}

impl Checkpoint {
    /// A history that has nothing but its start.
    pub(super) fn history(self, plan: &Plan) -> History {
        Records::default().history(plan, (&self.place, self.state.clone()), self.underway())
    }
}
