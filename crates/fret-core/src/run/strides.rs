//! How far a contact goes in an increment: what slip leaves behind, and what a cell remembers of the contact that it runs through, is known at the
//! ends of increments alone.

use serde::{Deserialize, Serialize};

use crate::history::{Concern, StepRecord, Warning};
use crate::model::Frame;
use crate::plan::Plan;

/// Sums of lengths are rounded: two cells of twenty are a tenth.
const ROUNDING: f64 = 1e-9;

/// Follows where a contact goes.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Strides {
    /// What moves the contact, if that matters.
    way: Option<Way>,
    /// Sides of a cell [length].
    spacing: [f64; 2],
    /// Where it was at the end of the increment before [length].
    place: Option<[f64; 2]>,
    /// The longest of all.
    longest: Option<Stride>,
}

/// How far a contact goes in an increment.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
struct Stride {
    /// Over the length of the contact along the way.
    share: f64,
    /// Along x and y [cells].
    cells: [f64; 2],
    /// Number of its stage, from 0.
    stage: usize,
}

#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
enum Way {
    /// The upper body slides, and slip leaves something.
    Slides,
    /// Both bodies roll.
    Rolls,
}

impl Strides {
    /// Of a run that has yet to begin.
    pub fn of(plan: &Plan) -> Self {
        let case = &plan.case;
        let leaves = case.wear.is_some() || case.friction_evolution.is_some();
        let way = match (case.rolls(), case.kinematics.is_finite() && leaves) {
            (true, _) => Some(Way::Rolls),
            (false, true) => Some(Way::Slides),
            (false, false) => None,
        };
        Self { way, spacing: plan.grid.spacing(), ..Self::default() }
    }

    /// Reads an increment.
    pub fn add(&mut self, record: &StepRecord) {
        let Some(way) = self.way else { return };
        let place = match way {
            Way::Slides => record.shift,
            Way::Rolls => record.roll,
        };
        let touches = record.contact_cells > 0;
        if let (Some(from), true) = (self.place, touches) {
            let parts = record.parts.max(1) as f64;
            let cells = [0, 1].map(|axis| (place[axis] - from[axis]) / self.spacing[axis] / parts);
            let along =
                |axis: usize| record.footprint.lengths[axis].map_or(0.0, |length| cells[axis] / length);
            let share = along(0).hypot(along(1));
            if self.longest.is_none_or(|longest| share > longest.share) {
                self.longest = Some(Stride { share, cells, stage: record.stage });
            }
        }
        self.place = touches.then_some(place);
    }

    /// The warning of strides too long for the contact.
    pub fn warning(&self, plan: &Plan) -> Option<Warning> {
        let concern = match self.way? {
            Way::Slides => Concern::MovingInFewIncrements,
            Way::Rolls => Concern::RollingInFewIncrements,
        };
        let longest = self.longest?;
        let stage = plan.case.stages.get(longest.stage)?;
        let warning = Warning::of(concern, longest.share * (1.0 - ROUNDING), Some(stage.name.clone()))?;
        let over = warning.value / warning.bound;
        let steps = stage.increments_by_key();
        let enough = |steps: usize| (steps as f64 * over).ceil() as usize;
        let enough = match self.way? {
            // A steady state goes on by one cell.
            Way::Rolls if stage.steady => None,
            Way::Rolls if plan.case.kinematics.frame == Frame::Contact => {
                let way = longest.cells.map(|cells| (cells.abs() * steps as f64).round() as usize);
                let whole = |into: &usize| way.iter().all(|cells| cells.is_multiple_of(*into));
                (enough(steps)..=way[0].max(way[1])).find(whole)
            }
            // A cycle goes its quarters in whole increments.
            _ if stage.cycles().is_some() => Some(4 * enough((steps / 4).max(1))),
            _ => Some(enough(steps)),
        };
        let help = enough.map_or_else(
            || "a grid of finer cells".to_owned(),
            |enough| format!("increments = {enough} in that stage"),
        );
        Some(Warning { help, ..warning })
    }
}
