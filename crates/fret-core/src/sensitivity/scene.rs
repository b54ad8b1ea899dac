//! What stays the same along a history whose derivatives are taken: grid, region, gap, symmetry, machine; and its increments as they were
//! solved.

use std::borrow::Cow;

use ndarray::Array2;

use super::cell::MOTIONS;
use super::linearised::{Fields, Operators, displacements, zeros};
use crate::compliance::{OperatorSet, SpectralCompliance, SurfaceResponse};
use crate::history::StepRecord;
use crate::kernel::ResponseTable;
use crate::model::{ContactState, CoulombFriction, Rig, SurfaceGrid, Zone};
use crate::plan::{Coupling, Plan};
use crate::solver::{CellWaves, ContactSet, Preconditioner, Region};
use fret_fft::{ConvolutionError, good_length};

/// Cells beyond all contacts of the history: to these the edge may come, and they see those beside them.
const MARGIN: usize = 3;

/// An increment as the run left it: its record, and the state in front of the mirrors.
pub(super) struct Snapshot {
    pub record: StepRecord,
    pub state: ContactState,
}

/// The fixed part of a history.
pub(super) struct Scene<'a> {
    pub plan: &'a Plan,
    /// Grid in front of the mirrors.
    pub grid: SurfaceGrid,
    /// The cells of it that any contact of the history comes near to.
    pub region: Region,
    /// Place of every cell of the region along x and y over the length.
    pub places: Vec<[f64; 2]>,
    /// Length that makes a rotation a motion [length].
    pub length: f64,
    /// Gap before deformation in the region [length].
    pub undeformed: Array2<f64>,
    /// Springs of the part in front of the mirrors.
    pub rig: Rig,
}

/// One increment in the region.
pub(super) struct Solved<'a> {
    pub record: &'a StepRecord,
    pub law: Cow<'a, CoulombFriction>,
    pub tractions: Fields,
    pub displacements: Fields,
    pub zone: Array2<Zone>,
    /// Rotations times the length [length].
    pub motions: [f64; MOTIONS],
    pub contact: ContactSet,
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
        let length = if largest > 0.0 { largest } else { 1.0 };
        Self {
            plan,
            grid,
            region,
            places: centres.iter().map(|centre| centre.map(|part| part / length)).collect(),
            length,
            undeformed: field(region, &undeformed),
            rig: plan.case.springs().of_part(symmetry.copies()),
        }
    }

    /// Whether shear is unknown.
    pub fn is_frictional(&self) -> bool {
        self.plan.coupling != Coupling::Frictionless
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
            single: false,
        }
    }

    /// Operators of a response on the region.
    pub fn operators(
        &self,
        response: &SurfaceResponse,
        table: Option<&ResponseTable>,
    ) -> Result<Operators, ConvolutionError> {
        let (shape, set) = (self.region.shape, self.operator_set());
        let waves = table.map(|table| CellWaves { table, spacing: self.grid.spacing() });
        Ok(Operators {
            compliance: SpectralCompliance::new(response, shape, set)?,
            preconditioner: Preconditioner::new(response, waves, shape, set)?,
            frictional: self.is_frictional(),
        })
    }

    /// The operator by which the displacements of the region change with a response.
    pub fn compliance(&self, change: &SurfaceResponse) -> Result<SpectralCompliance, ConvolutionError> {
        SpectralCompliance::new(change, self.region.shape, self.operator_set())
    }

    /// An increment of the history in the region, under a law of friction of the whole grid.
    pub fn solved<'b>(
        &self,
        snapshot: &'b Snapshot,
        law: &'b CoulombFriction,
        operators: &mut Operators,
    ) -> Solved<'b> {
        let Snapshot { record, state } = snapshot;
        let region = self.region;
        let tractions = [&state.pressure, &state.shear[0], &state.shear[1]].map(|field| region.gather(field));
        let moved = if tractions[0].iter().any(|p| *p > 0.0) {
            displacements(&mut operators.compliance, operators.frictional, &tractions)
        } else {
            zeros(region.len())
        };
        let zones = region.gather_map(&state.zone, |zone| *zone);
        let shape = region.shape;
        Solved {
            record,
            law: self.plan.symmetry.part_of_friction(law),
            contact: ContactSet::loaded(&tractions[0]),
            tractions,
            displacements: moved,
            zone: Array2::from_shape_vec(shape, zones).unwrap_or_else(|_| Array2::default(shape)),
            motions: self.motions(state),
        }
    }

    /// Motions of a state, rotations times the length [length].
    pub fn motions(&self, state: &ContactState) -> [f64; MOTIONS] {
        let [tilt_x, tilt_y] = state.tilt.map(|slope| slope * self.length);
        [state.approach, tilt_x, tilt_y, state.shift[0], state.shift[1], state.twist * self.length]
    }
}

/// The part of a grid field in a region.
pub(super) fn field(region: Region, values: &Array2<f64>) -> Array2<f64> {
    region.view(values).as_standard_layout().into_owned()
}

/// The cells around all contacts of a history, from the mirrors on; of periodic cases all cells.
fn region_of(plan: &Plan, cells: [usize; 2], snapshots: &[Snapshot]) -> Region {
    if plan.case.periodic {
        return Region::whole(cells);
    }
    let touched = |i: usize, j: usize| snapshots.iter().any(|step| step.state.pressure[[i, j]] > 0.0);
    Region::around(cells, plan.symmetry.axes(), MARGIN, good_length, touched)
}
