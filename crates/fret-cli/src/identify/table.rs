//! The table of the cycles of a log.

use fret_core::identify::{Cycle, Identification};
use fret_core::units::Units;

/// A column.
pub struct Column {
    pub name: &'static str,
    /// Unit in the words of [`Units::of`].
    pub unit: &'static str,
    pub of: fn(&Cycle) -> Option<f64>,
}

macro_rules! read {
    ($name:literal, $unit:literal, $of:expr) => {
        Column { name: $name, unit: $unit, of: |cycle| cycle.quantities.and_then($of) }
    };
}

/// All columns, in the order of the page.
pub const COLUMNS: [Column; 13] = [
    Column { name: "cycle", unit: "", of: |cycle| Some(cycle.measured.name) },
    Column { name: "points", unit: "", of: |cycle| Some(cycle.measured.force.len() as f64) },
    read!("dissipated_energy", "force x length", |all| Some(all.dissipated_energy)),
    read!("force_amplitude", "force", |all| Some(all.force_amplitude)),
    read!("displacement_amplitude", "length", |all| Some(all.displacement_amplitude)),
    read!("opening", "length", |all| Some(all.opening)),
    read!("energy_ratio", "", |all| Some(all.energy_ratio)),
    read!("sliding_ratio", "", |all| Some(all.sliding_ratio)),
    read!("contact_energy_ratio", "", |all| all.contact_energy_ratio),
    read!("contact_sliding_ratio", "", |all| all.contact_sliding_ratio),
    read!("slope_after_reversal", "force/length", |all| all.slope),
    read!("plateau_friction", "", |all| all.plateau_friction),
    read!("energy_friction", "", |all| all.energy_friction),
];

impl Column {
    /// Whether its numbers count something.
    pub fn counts(&self) -> bool {
        matches!(self.name, "cycle" | "points")
    }
}

/// The rows as CSV; heads with units, where there are any; empty where a cycle was skipped.
pub fn table(found: &Identification) -> String {
    let units = found.has_units.then_some(&found.units);
    let head =
        COLUMNS.each_ref().map(|column| Units::heading(units, column.name, column.unit, found.dimension));
    let mut text = head.join(",") + "\n";
    for cycle in &found.cycles {
        let cell = |column: &Column| {
            (column.of)(cycle).map_or_else(String::new, |value| {
                // As in JSON: 1.0 for a number, 7 for a count.
                if column.counts() { value.to_string() } else { serde_json::Value::from(value).to_string() }
            })
        };
        text += &(COLUMNS.each_ref().map(cell).join(",") + "\n");
    }
    text
}
