//! From measured fretting loops to the constants of a model: friction coefficient, stiffness of the rig, one constant of the case.
//!
//! From the ground: `log` (rows of numbers with their lines) below its `head`, `unit_names`; `turns` of a signal, `cycles` (which are
//! whole), `direction`, `drift`; `computed` (a loop between its points), `model` (the loop that the solver computes), `flanks`, `quantities` (what is read from a cycle); `start`,
//! `fit` (least squares), `intervals`, `found`; `summary` and `page` (pictures); the whole question here.

mod computed;
mod cycles;
mod direction;
mod drift;
mod fit;
mod flanks;
mod found;
mod head;
mod intervals;
mod log;
mod model;
mod page;
mod quantities;
mod start;
mod summary;
#[cfg(test)]
mod tests;
mod turns;
mod unit_names;

use std::path::Path;

use fret_core::case::Units;
use serde_json::{Value, json};

use crate::case_file::CaseFile;
use crate::failure::Failure;

use cycles::MeasuredCycle;
use page::page;
use quantities::Known;

/// Energy ratio of the contact's loop from which it slides: Fouvry, Kapsa and Vincent (1995).
const SLIDING: f64 = 0.2;
/// An interval wider than this on either side, relative, tells nothing of its constant.
const TOLD: f64 = 0.5;

/// Rows without a number that are named, at the most.
const ROWS_NAMED: usize = 3;

/// What is asked of a log.
#[derive(Debug, Clone, Default)]
pub struct Request {
    /// Columns by what they hold: `displacement`, `force`, `cycle`, `normal_force`; by name, or by number from 1; before those that the
    /// case names.
    pub columns: Vec<(String, String)>,
    /// Units by what they are of: `displacement`, `force`.
    pub units: Vec<(String, String)>,
    /// The cycle that is fitted; default: the last.
    pub cycle: Option<f64>,
    /// A key of the case that is fitted too, such as `lower.substrate.young`.
    pub key: Option<String>,
    /// Whether a log with a cycle that is no whole loop, or a row without a number, is refused; else these are left out and named.
    pub strict: bool,
}

impl Request {
    /// With the columns that the case names, where none is asked for.
    fn beside(&self, of_case: &[(&str, String)]) -> Self {
        let mut request = self.clone();
        for (what, name) in of_case {
            if !self.columns.iter().any(|(asked, _)| asked == what) {
                request.columns.push(((*what).to_owned(), name.clone()));
            }
        }
        request
    }
}

/// The answer.
#[derive(Debug)]
pub struct Identification {
    /// All of it, as `identified.json` has it.
    pub json: Value,
    /// What a person reads.
    pub text: String,
    /// The page with its pictures.
    pub page: String,
    /// The table of the cycles, as CSV.
    pub table: String,
}

/// Identifies a log by a case.
///
/// # Errors
/// When the log cannot be read as fretting loops of such a case, or the case cannot be solved.
pub fn identify(
    (name, bytes): (&str, &[u8]),
    case_file: CaseFile,
    request: &Request,
) -> Result<Identification, Failure> {
    let case = case_file.case(None)?;
    let request = &request.beside(&case.log_columns);
    let table = log::read(name, bytes, request)?;
    let mut notes = Vec::new();
    let scale = unit_names::scales(&table, request, case.units.as_ref(), &mut notes)?;
    let has_units =
        case.units.is_some() || table.columns.iter().flatten().any(|column| column.unit.is_some());
    if !table.heads.is_empty() {
        let blocks = table.heads.len() + 1;
        notes.push(format!(
            "the log has {blocks} blocks with a head each: they were read one after the other"
        ));
    }
    let mut measured = cycles::split(&table, scale);
    let direction = direction::of(&measured);
    if let (Some(what), true) = (direction.in_words(), request.strict) {
        return Err(refused(
            name,
            &what,
            "turn the column, or leave out --strict: then it is turned and told",
        ));
    }
    direction.apply(&mut measured);
    notes.extend(direction.note());
    if let (Some(fault), true) = (measured.iter().find_map(|cycle| cycle.fault.as_ref()), request.strict) {
        return Err(refused(name, &fault.what, &fault.help));
    }
    let model = model::Model::new(case_file, request.key.as_deref())?;
    let place = cycles::choose(&measured, request.cycle, name)?;
    let chosen = &measured[place];
    let fitted = fit::fit(name, chosen, &model, drift::bend(&measured, place))?;
    let normal_force = fitted.normal_force;
    let friction = fitted.friction().or_else(|| model.friction()).unwrap_or(0.5);
    // Without it friction is not read from the single cycles; the fit itself stands.
    let flanks = flanks::Flanks::of(&model, friction, fitted.value_of_key).ok();
    let known = Known {
        normal_force,
        stiffness: fitted.stiffness(),
        flanks: flanks.as_ref(),
        correlation: fitted.correlation,
    };
    let rows: Vec<Value> = measured
        .iter()
        .map(|cycle| quantities::row(cycle, cycle.fault.is_none().then(|| cycle.quantities(known))))
        .collect();
    let own = chosen.quantities(known);
    let drift = drift::per_cycle(&measured);
    notes.extend(fitted.notes.iter().cloned());
    let units = case.units.clone().unwrap_or_else(|| Units::new("m", "N"));
    let [offset, within, bend, force_offset] = fitted.removed;
    let json = json!({
        "log": name,
        "units": {"length": units.length, "force": units.force},
        "cycle": chosen.name,
        "normal_force": normal_force,
        "parameters": fitted.constants.iter().map(found::Constant::to_json).collect::<Vec<_>>(),
        "noise": fitted.noise,
        "removed": {
            "displacement_offset": offset,
            "displacement_drift": within,
            "displacement_bend": bend,
            "force_offset": force_offset,
            "drift_per_cycle": drift,
        },
        "turned": {"force": direction.turned, "order_of_rows": direction.backwards},
        "left_out": left_out(&measured, &table),
        "sliding_condition": condition(own.contact_energy_ratio.unwrap_or(own.energy_ratio), fitted.slides),
        "contact_stiffness": fitted.contact_stiffness,
        "cycles": rows,
        "measured": {"displacement": chosen.displacement, "force": chosen.force},
        "computed": {
            "displacement": fitted.computed.iter().map(|point| point[0]).collect::<Vec<_>>(),
            "force": fitted.computed.iter().map(|point| point[1]).collect::<Vec<_>>(),
            "shift": fitted.computed.iter().map(|point| point[2]).collect::<Vec<_>>(),
        },
        "notes": notes,
    });
    let text = summary::summary(&json, &units);
    let page = page(&json, &units, &measured);
    let table = quantities::table(&json["cycles"], has_units.then_some(&units));
    Ok(Identification { json, text, page, table })
}

/// Cycles and rows that are left out, and why; in words where there are any.
fn left_out(cycles: &[MeasuredCycle], table: &log::Table) -> Value {
    let faults: Vec<Value> = cycles
        .iter()
        .filter_map(|cycle| {
            let fault = cycle.fault.as_ref()?;
            Some(json!({"cycle": cycle.name, "lines": cycle.lines, "why": fault.brief}))
        })
        .collect();
    let cycles_in_words = (!faults.is_empty()).then(|| cycles::left_out(cycles));
    let rows: Vec<&str> = table.bad.iter().map(|row| row.what.as_str()).collect();
    let more = match rows.len() {
        0..=ROWS_NAMED => String::new(),
        bad => format!("; and {} rows more", bad - ROWS_NAMED),
    };
    let named = rows.iter().take(ROWS_NAMED).copied().collect::<Vec<_>>().join("; ");
    json!({
        "cycles": faults,
        "rows": rows.len(),
        "cycles_in_words": cycles_in_words,
        "rows_in_words": (!rows.is_empty()).then(|| named + &more),
    })
}

fn condition(energy_ratio: f64, slides: bool) -> &'static str {
    match (energy_ratio >= SLIDING, slides) {
        (true, true) => "gross_slip",
        (false, false) => "partial_slip",
        _ => "mixed",
    }
}

/// A refusal of a log, with what to do about it.
fn refused(name: &str, what: &str, help: &str) -> Failure {
    Failure::Call(format!("{name}: {what}"), help.to_owned())
}

/// The name of a log in messages and results.
pub fn name_of(path: &Path) -> String {
    path.display().to_string()
}
