//! The numbers a person reads off a run, at the end of a stage: as the cells have them, and read between the cells.

use ndarray::Array2;
use serde::{Deserialize, Serialize};

use super::peak::peak_pressure_in_front;
use crate::history::{StepRecord, faces_between};
use crate::model::{ContactState, Dimension, MirroredState, SurfaceGrid, Symmetry, Zone};
use crate::plan::Plan;

/// A quantity of interest.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Quantity {
    /// Largest pressure [pressure].
    MaxPressure,
    /// Rigid approach [length].
    Approach,
    /// Area of contact [length^2].
    ContactArea,
    /// Area that sticks [length^2].
    StickArea,
    /// Rigid tangential displacement [length], x and y.
    Shift,
    /// Energy dissipated by friction since the start [force x length].
    DissipatedEnergy,
    /// Creepage of a contact that rolls on steadily [-], x and y.
    Creepage,
    /// Spin of the same [rad/length].
    Spin,
    /// Energy that friction dissipates in it by distance rolled [force].
    RollingFriction,
    /// Largest worn depth [length].
    MaxWornDepth,
    /// Volume worn off since the start [length^3].
    WornVolume,
}

/// Something of each quantity of interest, in the order of [`Quantity::ALL`].
pub type PerQuantity<T> = [T; Quantity::ALL.len()];

impl Quantity {
    /// All of them, in the order of tables.
    pub const ALL: [Self; 11] = [
        Self::MaxPressure,
        Self::Approach,
        Self::ContactArea,
        Self::StickArea,
        Self::Shift,
        Self::DissipatedEnergy,
        Self::Creepage,
        Self::Spin,
        Self::RollingFriction,
        Self::MaxWornDepth,
        Self::WornVolume,
    ];

    /// Whether it has two components, along x and y.
    pub fn has_components(self) -> bool {
        matches!(self, Self::Shift | Self::Creepage)
    }

    /// Its name in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::MaxPressure => "max_pressure",
            Self::Approach => "approach",
            Self::ContactArea => "contact_area",
            Self::StickArea => "stick_area",
            Self::Shift => "shift",
            Self::DissipatedEnergy => "dissipated_energy",
            Self::Creepage => "creepage",
            Self::Spin => "spin",
            Self::RollingFriction => "rolling_friction",
            Self::MaxWornDepth => "max_worn_depth",
            Self::WornVolume => "worn_volume",
        }
    }

    /// Its name, as a person reads it: a line contact has widths in place of areas.
    pub fn in_words(self, dimension: Dimension) -> String {
        self.name().replace("area", dimension.area()).replace('_', " ")
    }

    /// The kind of its unit, in the words of [`Units::of`](crate::units::Units::of); empty of a ratio.
    pub fn kind(self) -> &'static str {
        match self {
            Self::MaxPressure => "pressure",
            Self::Approach | Self::Shift | Self::MaxWornDepth => "length",
            Self::ContactArea | Self::StickArea => "length^2",
            Self::DissipatedEnergy => "force x length",
            Self::Creepage => "",
            Self::Spin => "1/length",
            Self::RollingFriction => "force",
            Self::WornVolume => "length^3",
        }
    }
}

/// What the cells alone say.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Plain {
    /// Pressure of the largest cell [pressure].
    pub max_pressure: f64,
    /// Cells in contact, as an area [length^2].
    pub contact_area: f64,
    /// Cells that stick, as an area [length^2].
    pub stick_area: f64,
}

/// Quantities of interest at the end of an increment, read between the cells where that is closer.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct StageQuantities {
    /// Number of the stage, from 0.
    pub stage: usize,
    /// Largest pressure [pressure]: [`peak_pressure`](super::peak_pressure).
    pub max_pressure: f64,
    /// Rigid approach [length].
    pub approach: f64,
    /// Area of contact [length^2], from the zero line of the pressure between the cells.
    pub contact_area: f64,
    /// Area that sticks [length^2]: the share of the cells in contact that stick, times the contact area.
    pub stick_area: f64,
    /// Rigid tangential displacement of the upper body [length]; `None` from a steady state of rolling on, whose one increment is as
    /// long as a cell.
    pub shift: Option<[f64; 2]>,
    /// Energy dissipated by friction since the start [force x length], likewise.
    pub dissipated_energy: Option<f64>,
    /// Creepage along x and y [-] of a contact that rolls on steadily.
    #[serde(default)]
    pub creepage: Option<[f64; 2]>,
    /// Its spin [rad/length]; `None` where there is none.
    #[serde(default)]
    pub spin: Option<f64>,
    /// Energy that friction dissipates in it by distance rolled [force].
    #[serde(default)]
    pub rolling_friction: Option<f64>,
    /// Largest worn depth [length], where surfaces wear.
    #[serde(default)]
    pub max_worn_depth: Option<f64>,
    /// Volume worn off since the start [length^3], where surfaces wear.
    #[serde(default)]
    pub worn_volume: Option<f64>,
    /// The same from the cells alone.
    pub plain: Plain,
    /// Area of the cells along the edge of contact [length^2], about its length times the side of a cell.
    pub contact_edge: f64,
    /// The same for the edge of what sticks [length^2].
    pub stick_edge: f64,
    /// Area of one cell [length^2]; of a line contact, of a unit of its length [length].
    pub cell_area: f64,
    /// Whether the contact is that of a line.
    #[serde(rename = "is_line")]
    pub dimension: Dimension,
    /// Cells in the contact radius; `None` for a contact without an edge.
    pub radius_cells: Option<f64>,
}

/// Reads quantities of interest off the increments of a run.
#[derive(Debug, Clone, Copy)]
pub struct QuantityReader {
    grid: SurfaceGrid,
    /// The first stage that rolls on to a steady state.
    steady_from: Option<usize>,
    /// Whether surfaces wear.
    wears: bool,
}

impl QuantityReader {
    /// For the run of a plan.
    pub fn of(plan: &Plan) -> Self {
        Self {
            grid: plan.grid,
            steady_from: plan.case.stages.iter().position(|stage| stage.steady),
            wears: plan.case.wear.is_some(),
        }
    }

    /// Quantities of interest of a solved increment.
    pub fn read(&self, record: &StepRecord, state: MirroredState<'_>) -> StageQuantities {
        let grid = &self.grid;
        let is_steady = self.steady_from.is_some_and(|first| record.stage >= first);
        let MirroredState { part: ContactState { pressure, zone, .. }, symmetry } = state;
        let cell = grid.cell_area();
        let edge = |is_within: fn(&Zone) -> bool| cell * edge_cells(zone, symmetry, is_within);
        StageQuantities {
            stage: record.stage,
            max_pressure: peak_pressure_in_front(pressure, symmetry),
            approach: record.approach,
            contact_area: record.contact_area,
            stick_area: record.stick_area,
            shift: (!is_steady).then_some(record.shift),
            dissipated_energy: (!is_steady).then_some(record.dissipated_energy),
            creepage: record.creepage.filter(|_| is_steady),
            spin: record.spin.filter(|spin| is_steady && *spin != 0.0),
            rolling_friction: record.rolling_friction.filter(|_| is_steady),
            max_worn_depth: self.wears.then_some(record.max_worn_depth),
            worn_volume: self.wears.then_some(record.worn_volume),
            plain: Plain {
                max_pressure: record.max_pressure,
                contact_area: record.contact_cells as f64 * cell,
                stick_area: record.stick_cells as f64 * cell,
            },
            contact_edge: edge(|zone| *zone != Zone::Open),
            stick_edge: edge(|zone| *zone == Zone::Stick),
            cell_area: cell,
            dimension: grid.dimension(),
            radius_cells: record.footprint.radius,
        }
    }
}

impl StageQuantities {
    /// A number read between the cells; scalars first, then zero. `None` where the stage has no such number.
    pub fn between(&self, quantity: Quantity) -> Option<[f64; 2]> {
        let scalar = match quantity {
            Quantity::MaxPressure => Some(self.max_pressure),
            Quantity::Approach => Some(self.approach),
            Quantity::ContactArea => Some(self.contact_area),
            Quantity::StickArea => Some(self.stick_area),
            Quantity::Shift => return self.shift,
            Quantity::DissipatedEnergy => self.dissipated_energy,
            Quantity::Creepage => return self.creepage,
            Quantity::Spin => self.spin,
            Quantity::RollingFriction => self.rolling_friction,
            Quantity::MaxWornDepth => self.max_worn_depth,
            Quantity::WornVolume => self.worn_volume,
        };
        Some([scalar?, 0.0])
    }

    /// A number as the cells have it, likewise.
    pub fn plain(&self, quantity: Quantity) -> Option<[f64; 2]> {
        match quantity {
            Quantity::MaxPressure => Some([self.plain.max_pressure, 0.0]),
            Quantity::ContactArea => Some([self.plain.contact_area, 0.0]),
            Quantity::StickArea => Some([self.plain.stick_area, 0.0]),
            other => self.between(other),
        }
    }
}

/// Length of the edge of a zone in cells, from the cell faces it crosses: for every direction alike a line crosses
/// `4 / pi` faces a cell (Cauchy and Crofton).
fn edge_cells(zone: &Array2<Zone>, symmetry: Symmetry, is_within: impl Fn(&Zone) -> bool) -> f64 {
    let [along_x, along_y] = faces_between(zone, symmetry, is_within);
    if zone.ncols() == 1 {
        return along_x as f64; // of a line contact: its ends
    }
    std::f64::consts::FRAC_PI_4 * (along_x + along_y) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The edge of a disc of 20 cells' radius: 2 pi 20 cells, met to a hundredth by counting 160 faces.
    #[test]
    fn the_edge_of_a_disc_has_its_length() {
        let zone = Array2::from_shape_fn((50, 50), |(i, j)| {
            let r = (i as f64 - 24.5).hypot(j as f64 - 24.5);
            if r < 20.0 { Zone::Stick } else { Zone::Open }
        });
        let length = edge_cells(&zone, Symmetry::NONE, |zone| *zone == Zone::Stick);
        assert!((length / (40.0 * std::f64::consts::PI) - 1.0).abs() < 0.01, "{length}");
    }
}
