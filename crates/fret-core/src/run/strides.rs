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
    /// The longest stride over the length of the contact, and its stage.
    longest: Option<(f64, usize)>,
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
            let along = |axis: usize| {
                let length =
                    record.footprint.lengths[axis].map_or(f64::INFINITY, |cells| cells * self.spacing[axis]);
                (place[axis] - from[axis]) / length
            };
            let stride = along(0).hypot(along(1)) / record.parts.max(1) as f64;
            if self.longest.is_none_or(|(longest, _)| stride > longest) {
                self.longest = Some((stride, record.stage));
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
        let (longest, stage) = self.longest?;
        let stage = plan.case.stages.get(stage)?;
        let warning = Warning::of(concern, longest * (1.0 - ROUNDING), Some(stage.name.clone()))?;
        let enough = (stage.increments_by_key() as f64 * warning.value / warning.bound).ceil();
        let help = if self.way == Some(Way::Rolls) && plan.case.kinematics.frame == Frame::Contact {
            format!("increments = {enough} in that stage; where these are no whole cells, more of them")
        } else {
            format!("increments = {enough} in that stage")
        };
        Some(Warning { help, ..warning })
    }
}
