//! The numbers a person reads off a run, at the end of a stage: as the cells have them, and read between the cells.

use ndarray::Array2;
use serde::{Deserialize, Serialize};

use super::peak::peak_pressure_in_front;
use crate::history::{StepRecord, faces_between};
use crate::model::{ContactState, Dimension, MirroredState, SurfaceGrid, Symmetry, Zone};

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
}

impl Quantity {
    /// All of them, in the order of tables.
    pub const ALL: [Self; 6] = [
        Self::MaxPressure,
        Self::Approach,
        Self::ContactArea,
        Self::StickArea,
        Self::Shift,
        Self::DissipatedEnergy,
    ];

    /// Its name in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::MaxPressure => "max_pressure",
            Self::Approach => "approach",
            Self::ContactArea => "contact_area",
            Self::StickArea => "stick_area",
            Self::Shift => "shift",
            Self::DissipatedEnergy => "dissipated_energy",
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
    /// Rigid tangential displacement of the upper body [length].
    pub shift: [f64; 2],
    /// Energy dissipated by friction since the start [force x length].
    pub dissipated_energy: f64,
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

impl StageQuantities {
    /// Quantities of interest of a solved increment.
    pub fn new(grid: &SurfaceGrid, record: &StepRecord, state: MirroredState<'_>) -> Self {
        let MirroredState { part: ContactState { pressure, zone, .. }, symmetry } = state;
        let cell = grid.cell_area();
        let edge = |is_within: fn(&Zone) -> bool| cell * edge_cells(zone, symmetry, is_within);
        Self {
            stage: record.stage,
            max_pressure: peak_pressure_in_front(pressure, symmetry),
            approach: record.approach,
            contact_area: record.contact_area,
            stick_area: record.stick_area,
            shift: record.shift,
            dissipated_energy: record.dissipated_energy,
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

    /// A number read between the cells; scalars first, then zero.
    pub fn between(&self, quantity: Quantity) -> [f64; 2] {
        match quantity {
            Quantity::MaxPressure => [self.max_pressure, 0.0],
            Quantity::Approach => [self.approach, 0.0],
            Quantity::ContactArea => [self.contact_area, 0.0],
            Quantity::StickArea => [self.stick_area, 0.0],
            Quantity::Shift => self.shift,
            Quantity::DissipatedEnergy => [self.dissipated_energy, 0.0],
        }
    }

    /// A number as the cells have it.
    pub fn plain(&self, quantity: Quantity) -> [f64; 2] {
        match quantity {
            Quantity::MaxPressure => [self.plain.max_pressure, 0.0],
            Quantity::ContactArea => [self.plain.contact_area, 0.0],
            Quantity::StickArea => [self.plain.stick_area, 0.0],
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
