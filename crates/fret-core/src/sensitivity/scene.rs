//! What stays the same along a history whose derivatives are taken: grid, region, gap, symmetry, machine.

use std::sync::Arc;

use ndarray::Array2;

use super::cell::MOTIONS;
use super::cell_rows::{add_sums_with, sums_with};
use super::change::{Change, Reached};
use super::error::SensitivityError;
use super::fields::Fields;
use super::operators::{Made, Operators};
use super::snapshot::Snapshot;
use super::strain::Strain;
use crate::compliance::{OperatorSet, SpectralCompliance, SurfaceResponse};
use crate::model::{ContactState, Rig, SurfaceGrid};
use crate::plan::{Coupling, Plan};
use crate::run::{OpenRim, PairCompliance};
use crate::solver::{Ends, Region};
use fret_fft::{ConvolutionError, good_length};

/// Cells beyond all contacts of the history: to these the edge may come, and they see those beside them.
const MARGIN: usize = 3;

/// The motion of each degree of freedom, in the order of the controls.
pub(super) const MOTION_OF: [usize; 6] = [0, 3, 4, 5, 1, 2];

/// The fixed part of a history.
pub(super) struct Scene<'a> {
    pub plan: &'a Plan,
    /// Grid in front of the mirrors.
    pub grid: SurfaceGrid,
    /// The cells of it that any contact of the history comes near to.
    pub region: Region,
    /// Places of the cells of the region along x and along y over the length.
    pub places: [Vec<f64>; 2],
    /// Length that makes a rotation a motion [length].
    pub length: f64,
    /// Gap before deformation in the region [length].
    pub undeformed: Array2<f64>,
    /// Springs of the part in front of the mirrors.
    pub rig: Rig,
    /// What bulk stresses do to the surfaces.
    pub strain: Strain,
    /// The rim by which the surfaces wear, where another coefficient holds inside.
    pub rim: Option<OpenRim>,
    /// Whether slip is asked for.
    pub tells_slip: bool,
}

impl<'a> Scene<'a> {
    /// That of a history.
    pub fn new(plan: &'a Plan, snapshots: &[Snapshot]) -> Self {
        let symmetry = plan.symmetry;
        let cells = symmetry.part_of(plan.grid.cells());
        let grid = SurfaceGrid::new(cells, plan.grid.spacing()).unwrap_or(plan.grid);
        let region = region_of(plan, cells, snapshots);
        let undeformed = symmetry.part(&plan.case.profile.gap(&plan.grid));
        let (mirrored, size) = (symmetry.axes(), plan.grid.size());
        let middle = [0, 1].map(|axis| if mirrored[axis] { 0.25 * size[axis] } else { 0.0 });
        let centres: Vec<[f64; 2]> = (0..region.len())
            .map(|cell| {
                let at = region.at(cell);
                [0, 1].map(|axis| middle[axis] + grid.centre(axis, at[axis]))
            })
            .collect();
        let largest = centres.iter().flatten().fold(0.0_f64, |most, place| most.max(place.abs()));
        let rim = plan.case.wear.as_ref().and_then(|wear| wear.rim.as_ref());
        let length = if largest > 0.0 { largest } else { 1.0 };
        Self {
            plan,
            grid,
            region,
            places: [0, 1].map(|axis| centres.iter().map(|centre| centre[axis] / length).collect()),
            length,
            undeformed: field(region, &undeformed),
            rig: plan.case.springs().of_part(symmetry.copies()),
            strain: Strain::of(plan, length),
            rim: rim.map(|rim| OpenRim::new(rim, 0, &plan.grid, symmetry)),
            tells_slip: snapshots.iter().any(|snapshot| snapshot.slip.is_some()),
        }
    }

    /// Whether shear is unknown.
    pub fn is_frictional(&self) -> bool {
        self.plan.coupling != Coupling::Frictionless
    }

    /// No change.
    pub fn no_change(&self) -> Change {
        let change = Change::none(self.region.len()).of_slip(self.tells_slip);
        change
            .of_wear(self.plan.case.wear.is_some())
            .of_debris(self.has_debris())
            .of_evolution(self.evolves())
    }

    /// Whether debris stays between the surfaces.
    pub fn has_debris(&self) -> bool {
        self.plan.case.wear.as_ref().is_some_and(|wear| wear.debris.is_some())
    }

    /// Whether friction evolves.
    pub fn evolves(&self) -> bool {
        self.plan.case.friction_evolution.is_some()
    }

    /// How many layers wear, each by its own coefficient.
    pub fn wearing_layers(&self) -> usize {
        let layers = self.plan.case.wear.as_ref().and_then(|wear| wear.layers.as_ref());
        layers.map_or(0, |layers| layers.bodies().iter().map(|body| body.len()).sum())
    }

    /// Part of the wear coefficient that is in force in each cell of the region under pressures there, and its derivatives by width and inside of
    /// the rim.
    pub fn rim_slopes(&self, rim: &OpenRim, pressed: &[f64]) -> Vec<[f64; 3]> {
        // Beyond the region nothing touches.
        let mut pressure = Array2::zeros(self.grid.cells());
        self.region.place(pressed, &mut pressure);
        self.region.gather_map(&rim.slopes(&pressure), |slopes| *slopes)
    }

    /// How many cells of the whole contact a cell stands for, times the area of one [length^2].
    pub fn area(&self) -> f64 {
        self.grid.cell_area() * self.plan.symmetry.copies() as f64
    }

    fn operator_set(&self) -> OperatorSet {
        OperatorSet {
            normal: true,
            tangential: self.plan.coupling == Coupling::Uncoupled,
            full: self.plan.coupling == Coupling::Coupled,
            normal_from_all: false,
            shear_axis: self.plan.along,
            symmetry: self.plan.symmetry,
            single: self.plan.single_precision,
        }
    }

    /// Operators of a pair on the region.
    pub fn operators(&self, pair: &Arc<PairCompliance>) -> Result<Operators, SensitivityError> {
        Operators::new(Made {
            pair: Arc::clone(pair),
            set: self.operator_set(),
            spacing: self.grid.spacing(),
            region: self.region.shape,
            grid: self.grid.len(),
            periodic: self.plan.case.periodic.is_both(),
            frictional: self.is_frictional(),
        })
    }

    /// The operator by which the displacements of the region change with a response.
    pub fn compliance(&self, change: &SurfaceResponse) -> Result<SpectralCompliance, ConvolutionError> {
        SpectralCompliance::new(change, self.region.shape, self.operator_set())
    }

    /// Motions of a state, rotations times the length [length].
    pub fn motions(&self, state: &ContactState) -> [f64; MOTIONS] {
        let [tilt_x, tilt_y] = state.tilt.map(|slope| slope * self.length);
        [state.approach, tilt_x, tilt_y, state.shift[0], state.shift[1], state.twist * self.length]
    }

    /// Compliances of the machine: normal, along x and y [length/force].
    pub fn springs(&self) -> [f64; 3] {
        let rig = self.plan.case.springs();
        [rig.normal, rig.tangential[0], rig.tangential[1]]
    }

    /// Place of a cell of the region along x and y over the length.
    pub fn place(&self, cell: usize) -> [f64; 2] {
        self.places.each_ref().map(|places| places[cell])
    }

    /// What lies beyond the first and the last cells of the region. One that is a part of the grid ends where nothing touches.
    pub fn ends(&self) -> [Ends; 2] {
        let (mirrored, repeats) = (self.plan.symmetry.axes(), self.plan.case.periodic.axes());
        let is_all = |axis: usize| self.region.shape[axis] == self.grid.cells()[axis];
        [0, 1].map(|axis| Ends::of(mirrored[axis], repeats[axis] && is_all(axis)))
    }

    /// For each degree of freedom the factor of the sum of tractions that goes with its motion in the force of the whole contact: forces normal and along
    /// x and y, moment about z, tilting moments. None of a force that the symmetry forbids.
    fn levers(&self) -> [f64; 6] {
        let symmetry = self.plan.symmetry;
        let [mirrored_x, mirrored_y] = symmetry.axes();
        let (area, moment) = (self.area(), self.area() * self.length);
        let if_allowed = |allowed: bool, factor: f64| if allowed { factor } else { 0.0 };
        let [x, y] = [0, 1].map(|axis| if_allowed(symmetry.shear_is_odd(axis) == [false; 2], area));
        let turned = if_allowed(!symmetry.any(), moment);
        [area, x, y, turned, if_allowed(!mirrored_x, moment), if_allowed(!mirrored_y, moment)]
    }

    /// Forces of the whole contact under tractions, or their changes.
    pub fn resultants(&self, tractions: [&[f64]; 3]) -> [f64; 6] {
        let (sums, levers) = (sums_with(&self.places, tractions), self.levers());
        std::array::from_fn(|freedom| levers[freedom] * sums[MOTION_OF[freedom]])
    }

    /// The transpose of that: adds to tractions what amounts of the forces count.
    pub fn add_resultants(&self, forces: [f64; 6], tractions: &mut Fields) {
        let (levers, mut amounts) = (self.levers(), [0.0; MOTIONS]);
        for freedom in 0..6 {
            amounts[MOTION_OF[freedom]] = levers[freedom] * forces[freedom];
        }
        add_sums_with(&self.places, amounts, tractions);
    }

    /// Where the degrees of freedom are under forces of the whole contact and motions, or how both change.
    pub fn reached(&self, forces: [f64; 6], motions: &[f64; MOTIONS], springs: [f64; 3]) -> Reached {
        let [normal, x, y] = springs;
        let springs = [normal, x, y, 0.0, 0.0, 0.0];
        let units = self.units();
        std::array::from_fn(|freedom| {
            let (motion, unit) = (MOTION_OF[freedom], units[freedom]);
            let moved = motions[motion] / unit;
            [forces[freedom], moved, moved + springs[freedom] * forces[freedom]]
        })
    }

    /// What a motion is divided by, in the order of the controls: the length, of rotations.
    pub fn units(&self) -> [f64; 6] {
        [1.0, 1.0, 1.0, self.length, self.length, self.length]
    }
}

/// The part of a grid field in a region.
pub(super) fn field(region: Region, values: &Array2<f64>) -> Array2<f64> {
    region.view(values).as_standard_layout().into_owned()
}

/// The cells around all contacts of a history, from the mirrors on; of periodic cases all cells.
fn region_of(plan: &Plan, cells: [usize; 2], snapshots: &[Snapshot]) -> Region {
    if plan.case.periodic.is_both() {
        return Region::whole(cells);
    }
    let mut pressed = Array2::from_elem(cells, false);
    snapshots.iter().flat_map(Snapshot::pressed).for_each(|cell| pressed[cell] = true);
    let touched = |i: usize, j: usize| pressed[[i, j]];
    Region::around(cells, plan.symmetry.axes(), MARGIN, good_length, touched)
}
