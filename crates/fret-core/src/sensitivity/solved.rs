//! The increments of a history as they were solved, in its region, with what the rule of slip remembers of them: numbers alone.

use std::borrow::Cow;
use std::sync::Arc;

use ndarray::Array2;

use super::cell::MOTIONS;
use super::change::{Reached, Tangential};
use super::fields::{Fields, zeros};
use super::loads::Load;
use super::scene::Scene;
use super::snapshot::Snapshot;
use crate::model::{AccumulatedSlip, CoulombFriction, LoadStep, Zone};
use crate::solver::{ContactSet, Region};

/// A cell's two numbers.
pub(super) fn at(field: &Tangential, cell: usize) -> [f64; 2] {
    [field[0][cell], field[1][cell]]
}

/// Tangential displacement by motions at a place.
pub(super) fn moved_by(motions: &[f64; MOTIONS], [x, y]: [f64; 2]) -> [f64; 2] {
    let [_, _, _, shift_x, shift_y, turned] = *motions;
    [shift_x - turned * y, shift_y + turned * x]
}

/// How deep motions bring a place.
pub(super) fn deep_by(motions: &[f64; MOTIONS], [x, y]: [f64; 2]) -> f64 {
    motions[0] + motions[1] * x + motions[2] * y
}

/// One increment in the region.
#[derive(Debug, Clone)]
pub(super) struct Solved {
    pub tractions: Fields,
    pub displacements: Fields,
    pub gap: Array2<f64>,
    /// Gap before deformation in it [length].
    pub undeformed: Array2<f64>,
    /// Depth worn off after it, and the area that a cell stands for; nothing where nothing wears.
    pub worn: Vec<f64>,
    pub area: f64,
    /// Thickness of the debris after it [length]; nothing where none stays.
    pub debris: Vec<f64>,
    /// Cycles of the block that ends with it, whose wear is taken off then, none where nothing ends; and whether that opens the gap.
    pub block: usize,
    pub opens: bool,
    /// What slip has done to the surfaces until after it, where friction follows that.
    pub slipped: Option<Arc<AccumulatedSlip>>,
    pub zone: Array2<Zone>,
    /// Rotations times the length [length].
    pub motions: [f64; MOTIONS],
    /// Strain of the lower surface less that of the upper one by bulk stresses, times the length of the scene [length].
    pub strain: [f64; 2],
    pub contact: ContactSet,
    /// Tangential displacement of the upper surface over the lower, with bulk strains [length], and what the rule of slip takes for its change.
    pub slid: Tangential,
    pub drift: Tangential,
    /// Load at its start and at its end, of the part in front of the mirrors, in controls of the same kinds; `None` before the first one.
    pub from: Option<LoadStep>,
    pub load: Option<LoadStep>,
    /// Length over that of the increment before in the loads, where it went on from that.
    pub pace: Option<f64>,
    /// Whether the moments of touch in it were known.
    pub knows_touch: bool,
}

impl Solved {
    /// Bodies that have not touched yet.
    pub fn untouched(scene: &Scene<'_>) -> Self {
        let cells = scene.region.len();
        let tangential = || [vec![0.0; cells], vec![0.0; cells]];
        Self {
            tractions: zeros(cells),
            displacements: zeros(cells),
            gap: scene.undeformed.clone(),
            undeformed: scene.undeformed.clone(),
            worn: Vec::new(),
            debris: Vec::new(),
            area: scene.area(),
            block: 0,
            opens: false,
            slipped: None,
            zone: Array2::from_elem(scene.region.shape, Zone::Open),
            motions: [0.0; MOTIONS],
            strain: [0.0; 2],
            contact: ContactSet::of(cells, |_| false),
            slid: tangential(),
            drift: tangential(),
            from: None,
            load: None,
            pace: None,
            knows_touch: false,
        }
    }

    /// Rows and columns of the region.
    pub fn shape(&self) -> [usize; 2] {
        self.zone.dim().into()
    }

    /// What a cell did.
    pub fn zone_of(&self, cell: usize) -> Zone {
        let [_, columns] = self.shape();
        self.zone[[cell / columns, cell % columns]]
    }

    /// Shear of a cell [pressure].
    pub fn shear_at(&self, cell: usize) -> [f64; 2] {
        [self.tractions[1][cell], self.tractions[2][cell]]
    }

    /// Shear along x and y [pressure].
    pub fn shear(&self) -> [&[f64]; 2] {
        [&self.tractions[1], &self.tractions[2]]
    }

    /// Whether it went on from the one before.
    pub fn went_on(&self) -> bool {
        self.pace.is_some()
    }

    /// Its length over that of the one before, in the loads.
    pub fn ratio(&self) -> f64 {
        self.pace.unwrap_or(1.0)
    }

    /// Goes on through an increment in which no load changed, as the run left it after the `last` one.
    pub fn stood(&mut self, step: &Snapshot, last: Option<&Snapshot>, region: Region) {
        self.zone = step.in_region(region).1;
        self.opens = step.has_worn(last);
        self.worn = step.worn_in(region);
        self.debris = step.debris_in(region);
        self.slipped.clone_from(&step.slipped);
    }

    /// Whether a load is the one that it ended with.
    pub fn stands(&self, load: &Load) -> bool {
        self.load.as_ref() == Some(&load.step) && !self.opens
    }

    /// The law of friction in force after it, in an increment of a stage, on the part in front of the mirrors.
    pub fn law_at<'b>(&self, scene: &Scene<'b>, stage: usize) -> Cow<'b, CoulombFriction> {
        let plan = scene.plan;
        let law = plan.symmetry.part_of_friction(plan.case.friction_of(stage));
        match (&plan.case.friction_evolution, &self.slipped) {
            (Some(rule), Some(slipped)) => Cow::Owned(rule.friction(&law, slipped)),
            (Some(rule), None) => Cow::Owned(rule.friction(&law, &AccumulatedSlip::none(scene.grid.cells()))),
            (None, _) => law,
        }
    }

    /// Change of the tangential displacement of the upper surface over the lower in a cell since another increment [length].
    pub fn drift_since(&self, before: &Self, cell: usize) -> [f64; 2] {
        [0, 1].map(|axis| self.slid[axis][cell] - before.slid[axis][cell])
    }

    /// Where each degree of freedom is.
    pub fn reached(&self, scene: &Scene<'_>) -> Reached {
        let [pressure, x, y] = &self.tractions;
        let forces = scene.resultants([pressure, x, y]);
        scene.reached(forces, &self.motions, scene.springs())
    }
}
