//! Error bars from a companion run at half the cells and half the increments (of a scene without friction: none but the ends).
//!
//! The constants here were measured on scenes with closed forms and on coated spheres; none is proven. A bar is meant to hold in
//! 95 of 100 scenes. What it covers is the error of the cells and the increments, not that of the model.

use serde::Serialize;

use super::errors::extrapolated;
use super::quantities::{Quantity, StageQuantities};
use super::resolutions::{ResolutionError, only_one_grid};
use super::unbounded::pressure_is_unbounded;
use super::variation::{Variation, VariationError, fewest};
use crate::history::concern::CELLS_IN_RADIUS;
use crate::model::{Dimension, Integration, Shape};
use crate::plan::{Coupling, Plan};

/// Residual a companion is solved to at the least: far below what is estimated.
const TOLERANCE: f64 = 1e-6;
/// Fewest cells per side whose half still shows a contact.
const FEWEST_CELLS: usize = 12;
/// Edge of contact: read to this share of a cell.
const EDGE: f64 = 0.08;
/// The same of a line contact, whose two edges lie anywhere between the cells: nothing averages (Hertz contacts of 25 to 127 cells
/// in the half-width err by up to 0.14 cells on either side).
const EDGE_OF_LINE: f64 = 0.2;
/// The same under pyramids, whose contact has corners: of Berkovich and Vickers pyramids on 32 to 64 cells nine err by 0.1 to 0.21 of it.
const EDGE_WITH_CORNERS: f64 = 0.25;
/// The same of measured surfaces, whose contact is many spots: of 13 areas of a rough flat and a ball on one, on 48 to 192 cells, four err by
/// 0.09 to 0.16 of it.
const EDGE_OF_MEASURED: f64 = 0.25;
/// Least relative bar over the number of cells in contact: the edge lies anywhere between the cells, so that errors of second
/// order scatter, and two runs may agree by chance.
/// Of Hertz contacts of 6 to 18 cells in the radius pressure and approach err by up to 0.37 of it.
const SCATTER: f64 = 0.4;
/// The same of the largest pressure where shear acts on it: of 54 coupled contacts three err by 0.44 to 0.65 of it.
const SCATTER_OF_COUPLED_PEAK: f64 = 0.6;
/// The same of shift, and of energy and the largest wear that goes with it, which slip makes in fewer cells.
const SCATTER_OF_SHIFT: f64 = 1.0;
const SCATTER_OF_ENERGY: f64 = 4.0;
/// The same of shift where shear acts on pressure: of 36 shifts two err by 1.5 of it.
const SCATTER_OF_COUPLED_SHIFT: f64 = 1.6;
/// The same of the volume worn off, in which cells average.
const SCATTER_OF_WORN_VOLUME: f64 = 2.0;
/// The same of a steady state of rolling, in a line contact and in one with two axes: there creepage and friction of 28 to 52 cells along it scatter
/// by up to 3.4 of it, and two runs agree by chance.
const SCATTER_OF_ROLLING: f64 = 0.2;
/// That with two axes.
const SCATTER_OF_ROLLING_BALLS: f64 = 6.0;
/// Edge of contact where a body ends: it ends at the border of a cell.
const END_OF_A_BODY: f64 = 0.5;
/// Edge of what sticks: counted by cells, in steps of the load.
const STICK_EDGE: f64 = 0.3;
/// Share of the difference of two runs: of second order extrapolated; of an unknown one; of what sticks; of the shift and the energy of coupled
/// contacts with increments of second order; of a pressure that has a cusp in the middle of a small stick zone. Of 54 coupled contacts
/// three err by 1.5, 1.5 and 2.3 of it in what sticks, two by 2.6 in the energy, which fall outside.
const SECOND_ORDER: f64 = 1.0 / 3.0;
const UNKNOWN_ORDER: f64 = 1.5;
const STICK: f64 = 1.55;
const SHIFT: f64 = 1.0;
const ENERGY: f64 = 2.0;
const CUSP: f64 = 3.5;
/// The same of a steady state of rolling, which goes on by a cell: of first order.
const ROLLING: f64 = 2.5;
/// The same of the largest depth worn off, which is that of one cell: of 12 in partial and gross slip one errs by 1.65 of it.
const WORN_DEPTH: f64 = 2.5;
/// The same of the volume worn off, in which cells average: of those 12 none errs by more than 0.3 of it; twice that, since they are few.
const WORN_VOLUME: f64 = 0.75;
/// Factor on these for increments of first order.
const END_POINTS: f64 = 2.5;

/// A quantity of interest with its error bar.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Bar {
    /// Which number.
    pub quantity: Quantity,
    /// Its best value, scalars first.
    pub value: [f64; 2],
    /// The true value is expected within this distance; `None` where the number has no limit (the pressure of an edge).
    pub bar: Option<f64>,
}

/// The quantities of interest of a stage's end with their bars.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Bars {
    /// Number of the stage, from 0.
    pub stage: usize,
    /// The numbers that the stage has.
    pub bars: Vec<Bar>,
}

impl Bars {
    /// A number with its bar; `None` where the stage has no such number.
    pub fn of(&self, quantity: Quantity) -> Option<Bar> {
        self.bars.iter().find(|bar| bar.quantity == quantity).copied()
    }
}

/// The plan of the companion: half the cells along each side, half the increments of each stage, a tolerance that is enough.
///
/// # Errors
/// When the grid is too coarse to be halved, or the contact that is expected has too few cells, or the scene stands on its cells.
pub fn companion(plan: &Plan) -> Result<Plan, ResolutionError> {
    only_one_grid(plan)?;
    let least = plan.grid.dimension().axes().map(|axis| plan.case.cells[axis]).min().unwrap_or(0);
    if least < FEWEST_CELLS {
        return Err(ResolutionError::TooCoarse(least, FEWEST_CELLS));
    }
    if let Some(contact) = &plan.expected {
        let [x, y] = [0, 1].map(|axis| contact.half_widths[axis] / plan.grid.spacing()[axis]);
        // What a coarse grid cannot tell from the bound is left to the run.
        if 1.05 * x.min(y) < CELLS_IN_RADIUS {
            return Err(ResolutionError::FewCells(x.min(y)));
        }
    }
    let mut half = Variation::of(plan).halved(&plan.case.stages);
    half.tolerance = half.tolerance.max(TOLERANCE);
    if plan.coupling == Coupling::Frictionless {
        // Without friction the way does not matter, only where it ends.
        half.increments = plan.case.stages.iter().map(fewest).collect();
    }
    half.planned(plan).map_err(|error| match error {
        VariationError::PartsOfCells { why, .. } => ResolutionError::PartsOfCells(why),
        _ => ResolutionError::TooCoarse(least, FEWEST_CELLS),
    })
}

/// Whether the cells show the contact at the end of a stage well enough for error bars to hold.
///
/// # Errors
/// When its radius has fewer cells than [`CELLS_IN_RADIUS`].
pub fn resolved(end: &StageQuantities) -> Result<(), ResolutionError> {
    match end.radius_cells {
        Some(few) if few < CELLS_IN_RADIUS => Err(ResolutionError::FewCells(few)),
        _ => Ok(()),
    }
}

/// Error bars at the ends of the stages of `plan`, from its own quantities of interest and those of its companion; of the stages that
/// both have reached and that end [`resolved`].
pub fn error_bars(plan: &Plan, fine: &[StageQuantities], coarse: &[StageQuantities]) -> Vec<Bars> {
    let scene = Scene::of(plan);
    let mut largest = [0.0_f64; Quantity::ALL.len()];
    let mut bars = Vec::new();
    for end in fine {
        for (largest, quantity) in largest.iter_mut().zip(Quantity::ALL) {
            *largest = end.between(quantity).map_or(*largest, |[x, y]| largest.max(x.hypot(y)));
        }
        if resolved(end).is_err() {
            continue;
        }
        if let Some(other) = coarse.iter().find(|other| other.stage == end.stage) {
            let bar = |quantity: Quantity| scene.bar(quantity, end, other, largest[quantity as usize]);
            bars.push(Bars { stage: end.stage, bars: Quantity::ALL.into_iter().filter_map(bar).collect() });
        }
    }
    bars
}

/// What of a scene decides about its errors.
struct Scene {
    /// Surfaces without edges and tips.
    is_smooth: bool,
    /// Measured surfaces, of which finer cells show more.
    is_measured: bool,
    /// A body ends where the contact ends.
    ends: bool,
    /// The contact has corners.
    has_corners: bool,
    /// Somewhere the pressure has no limit.
    is_pointed: bool,
    /// Pressure depends on the way.
    is_coupled: bool,
    /// Something may stick and slip.
    has_friction: bool,
    /// A line contact, or one with two axes.
    dimension: Dimension,
    /// Increments of first order.
    by_end_points: bool,
}

impl Scene {
    fn of(plan: &Plan) -> Self {
        let shapes = &plan.case.profile.shapes;
        let ends = shapes.iter().any(super::unbounded::ends);
        let is_measured = !plan.case.profile.heights.is_empty();
        let is_smooth = |shape: &Shape| shape.curvatures().is_some() || matches!(shape, Shape::Wave { .. });
        Self {
            is_smooth: !is_measured && shapes.iter().all(is_smooth),
            is_measured,
            ends,
            has_corners: shapes.iter().any(|shape| matches!(shape, Shape::Pyramid { .. })),
            is_pointed: pressure_is_unbounded(&plan.case, plan.grid.cells()),
            is_coupled: plan.coupling == Coupling::Coupled,
            has_friction: plan.coupling != Coupling::Frictionless,
            dimension: plan.grid.dimension(),
            by_end_points: plan.coupling == Coupling::Coupled
                && plan.case.integration == Integration::EndPoint,
        }
    }

    /// A number with its bar; `largest` is the most it has been so far.
    fn bar(
        &self,
        quantity: Quantity,
        fine: &StageQuantities,
        coarse: &StageQuantities,
        largest: f64,
    ) -> Option<Bar> {
        let (value, other) = (fine.between(quantity)?, coarse.between(quantity)?);
        let apart = (value[0] - other[0]).hypot(value[1] - other[1]);
        let area = fine.contact_area.max(fine.cell_area);
        let scatter = match quantity {
            Quantity::Shift if self.is_coupled => SCATTER_OF_COUPLED_SHIFT,
            Quantity::Shift => SCATTER_OF_SHIFT,
            Quantity::DissipatedEnergy | Quantity::MaxWornDepth => SCATTER_OF_ENERGY,
            Quantity::WornVolume => SCATTER_OF_WORN_VOLUME,
            Quantity::Creepage | Quantity::Spin | Quantity::RollingFriction => match self.dimension {
                Dimension::Line => SCATTER_OF_ROLLING,
                Dimension::Plane => SCATTER_OF_ROLLING_BALLS,
            },
            Quantity::MaxPressure if self.is_coupled => SCATTER_OF_COUPLED_PEAK,
            _ => SCATTER,
        };
        let least = scatter * fine.cell_area / area * largest;
        let increments = if self.by_end_points { END_POINTS } else { 1.0 };
        let (value, bar) = match quantity {
            Quantity::MaxPressure if self.is_pointed => (value, None),
            Quantity::Approach if self.ends => {
                // As the radius, to which the stiffness of a body that ends is proportional: half the share of the area.
                (value, Some(0.5 * END_OF_A_BODY * fine.contact_edge / area * largest))
            }
            Quantity::MaxPressure | Quantity::Approach
                if self.is_smooth && !self.is_coupled && self.dimension == Dimension::Plane =>
            {
                (extrapolated(fine, coarse, quantity)?, Some(least.max(SECOND_ORDER * apart)))
            }
            Quantity::ContactArea => {
                let edge = match self.dimension {
                    _ if self.ends => END_OF_A_BODY,
                    _ if self.has_corners => EDGE_WITH_CORNERS,
                    _ if self.is_measured => EDGE_OF_MEASURED,
                    Dimension::Plane => EDGE,
                    Dimension::Line => EDGE_OF_LINE,
                };
                let of_peaks = if self.is_measured { UNKNOWN_ORDER * apart } else { 0.0 };
                (value, Some((edge * fine.contact_edge).max(of_peaks)))
            }
            Quantity::StickArea => {
                // What sticks may be a cell that no cell shows.
                let least = if self.has_friction { fine.cell_area } else { 0.0 };
                (value, Some((STICK_EDGE * fine.stick_edge).max(increments * STICK * apart).max(least)))
            }
            _ => {
                let share = match quantity {
                    Quantity::MaxPressure if self.is_coupled || self.is_measured => CUSP,
                    Quantity::Shift if self.is_coupled => SHIFT,
                    Quantity::DissipatedEnergy if self.is_coupled => ENERGY,
                    Quantity::Creepage | Quantity::Spin | Quantity::RollingFriction => ROLLING,
                    Quantity::MaxWornDepth => WORN_DEPTH,
                    Quantity::WornVolume => WORN_VOLUME,
                    _ => UNKNOWN_ORDER,
                };
                (value, Some(least.max(increments * share * apart)))
            }
        };
        Some(Bar { quantity, value, bar })
    }
}
