//! An identification as `identified.json` has it.

use fret_core::identify::{Cycle, Identification};
use serde_json::{Map, Value, json};

use super::constant::of_constant;
use super::repeated;
use super::table::COLUMNS;

/// Rows without a number that are named, at the most.
const ROWS_NAMED: usize = 3;

/// All of it.
pub fn record(found: &Identification) -> Value {
    let fitted = &found.fitted_cycle().measured;
    let along = |k: usize| found.computed.iter().map(|point| point[k]).collect::<Vec<f64>>();
    json!({
        "log": found.log,
        "units": {"length": found.units.length, "force": found.units.force},
        "line_contact": bool::from(found.dimension),
        "cycle": fitted.name,
        "normal_force": found.normal_force,
        "parameters": found.constants.iter().map(of_constant).collect::<Vec<_>>(),
        "noise": found.noise,
        "removed": found.removed,
        "turned": {"force": found.turned.turned, "order_of_rows": found.turned.backwards},
        "skipped": skipped(found),
        "sliding_condition": found.regime,
        "sliding_conditions": found.sliding_conditions(),
        "contact_stiffness": found.contact_stiffness,
        "cycles": found.cycles.iter().map(row).collect::<Vec<_>>(),
        "fits": repeated::record(found),
        "measured": {"displacement": fitted.displacement, "force": fitted.force},
        "computed": {"displacement": along(0), "force": along(1), "shift": along(2)},
        "notes": found.notes,
    })
}

/// A cycle by the names of the columns of the table.
fn row(cycle: &Cycle) -> Value {
    let mut row: Map<String, Value> =
        COLUMNS.iter().map(|column| (column.name.to_owned(), json!((column.of)(cycle)))).collect();
    row.insert("points".to_owned(), json!(cycle.measured.force.len()));
    Value::Object(row)
}

/// Cycles and rows that were skipped, and why; in words where there are any.
fn skipped(found: &Identification) -> Value {
    let cycles: Vec<Value> = found
        .skipped()
        .map(|(cycle, fault)| json!({"cycle": cycle.name, "lines": cycle.lines, "why": fault.brief}))
        .collect();
    json!({
        "cycles": cycles,
        "rows": found.bad_rows.len(),
        "cycles_in_words": found.skipped_in_words(),
        "rows_in_words": rows_in_words(&found.bad_rows),
    })
}

/// Rows that were skipped.
pub fn rows_in_words(rows: &[String]) -> Option<String> {
    let named = rows.iter().take(ROWS_NAMED).map(String::as_str).collect::<Vec<_>>().join("; ");
    match rows.len() {
        0 => None,
        1..=ROWS_NAMED => Some(named),
        bad => {
            let more = bad - ROWS_NAMED;
            Some(format!("{named}; and {more} row{} more", if more == 1 { "" } else { "s" }))
        }
    }
}
