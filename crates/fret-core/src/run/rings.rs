//! Rings that the increments of a growing contact leave in its shear, where pressure and shear act on each other: how wide they are, when they
//! matter, and how many increments are enough.

use serde::{Deserialize, Serialize};

use crate::case::{Course, Stage};
use crate::history::{RING_CELLS, RING_FRACTION, RING_SHEAR, Regime, StepRecord, Warning};
use crate::model::{Dimension, Shape};
use crate::plan::{Coupling, Plan};

/// Increments are advised with so much to spare: the advice holds where the contact grows a little less evenly than it is taken to.
const TO_SPARE: f64 = 1.1;

/// Growth in the second of n increments of a square ramp, over n^(-2/3) of the final radius.
const SECOND: f64 = 0.6;

/// A growth of the contact radius in an increment, or in a part of it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
struct Growth {
    /// By how much [length].
    by: f64,
    stage: usize,
    /// Whether it is one of the two increments with which the contact begins.
    early: bool,
}

/// Follows how a contact grows.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Rings {
    /// Whether the contact is a strip.
    dimension: Dimension,
    /// Radius of a flat end, all of which touches at once [length].
    flat: f64,
    /// Stages whose increments are divided by the program, by a bound of their own on the error.
    divided: Vec<bool>,
    /// The largest growth in an increment.
    largest: Option<Growth>,
    /// The first contact.
    first: Option<Growth>,
    /// Whether the bodies may have touched before the first increment that was read.
    may_touch: bool,
    /// Increments with contact.
    touching: usize,
    /// Increments read.
    read: usize,
    /// Contact radius of the increment before [length].
    radius: Option<f64>,
    largest_radius: f64,
}

impl Rings {
    /// Of a run that has yet to begin.
    pub fn of(plan: &Plan) -> Self {
        let flat = match plan.case.profile.shapes[..] {
            [Shape::FlatPunch { radius }] => radius,
            [Shape::RoundedPunch { flat_radius, .. } | Shape::WornSphere { flat_radius, .. }] => flat_radius,
            [Shape::RectangularPunch { lengths: [x, y], .. }] => (x * y / std::f64::consts::PI).sqrt(),
            _ => 0.0,
        };
        let divided = plan.case.stages.iter().map(|stage| stage.history_tolerance.is_some()).collect();
        let may_touch = plan.case.start.is_some();
        Self { dimension: plan.grid.dimension(), flat, divided, may_touch, ..Self::default() }
    }

    /// Reads an increment.
    pub fn add(&mut self, record: &StepRecord) {
        if record.contact_cells == 0 {
            (self.radius, self.may_touch) = (None, false);
            self.read += 1;
            return;
        }
        if self.touching == 0 && (self.may_touch || record.increment > self.read) {
            self.touching = 2; // of a contact from before nobody knows how it grew
        }
        self.read += 1;
        let radius = self.dimension.radius(record.contact_area).max(self.flat);
        self.touching += 1;
        let growth = |by: f64| Growth {
            by: by / record.parts.max(1) as f64,
            stage: record.stage,
            early: self.touching <= 2,
        };
        let matters = record.max_shear > RING_SHEAR * record.friction_coefficient * record.max_pressure
            && !self.divided.get(record.stage).is_some_and(|divided| *divided);
        if record.regime == Regime::GrossSlip {
            // Sliding as a whole leaves nothing of what was before.
            (self.largest, self.first) = (None, None);
        } else if matters {
            let grown = growth(radius - self.radius.unwrap_or(radius));
            if grown.by.is_finite() && self.largest.is_none_or(|known| grown.by > known.by) {
                self.largest = Some(grown);
            }
            if self.touching == 1 {
                self.first = Some(growth(radius - self.flat));
            }
        }
        self.radius = Some(radius);
        self.largest_radius = self.largest_radius.max(radius);
    }

    /// The warning of rings that show on the grid and that the answer may depend on, if there are any.
    pub fn warning(&self, plan: &Plan) -> Option<Warning> {
        if plan.coupling != Coupling::Coupled || !plan.case.profile.heights.is_empty() {
            return None;
        }
        let cell = self.dimension.cell_side(plan.grid.spacing());
        let limit = (RING_CELLS * cell).max(RING_FRACTION * self.largest_radius);
        // A first increment that makes half the contact is a ring like any other.
        let first = self.first.filter(|first| first.by > 0.5 * self.largest_radius);
        let widest = self.largest.into_iter().chain(first).reduce(|a, b| if b.by > a.by { b } else { a })?;
        let stage = plan.case.stages.get(widest.stage)?;
        (widest.by > limit).then(|| {
            let enough = self.enough(stage, widest, limit);
            Warning::of_pressing([widest.by / cell, limit / cell], stage.name.clone(), enough)
        })
    }

    /// Increments of a stage, as its key counts them, that keep its growth below a limit, and their ramp where that is to be another one.
    fn enough(&self, stage: &Stage, widest: Growth, limit: f64) -> (usize, Option<&'static str>) {
        let over = widest.by / limit;
        let own = stage.increments_by_key() as f64;
        let (increments, ramp) = match stage.course {
            // Under a force that begins linearly the radius begins with its cube root: hardly any number is enough.
            Course::Linear if widest.early => {
                let uneven = match self.dimension {
                    Dimension::Plane => 1.0,
                    Dimension::Line => 1.5,
                };
                (uneven * self.largest_radius / limit, Some("cubic"))
            }
            // There it begins with the power 2/3: after the first contact it grows most in the second increment, by 2^(2/3) - 1 of the first.
            Course::Square if widest.early => ((SECOND * self.largest_radius / limit).powf(1.5), None),
            _ => (own * over, None),
        };
        ((TO_SPARE * increments).ceil() as usize, ramp)
    }
}
