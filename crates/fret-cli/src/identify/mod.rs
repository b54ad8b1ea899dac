//! From measured fretting loops to the constants of a model: friction coefficient, stiffness of the rig, one constant of the case.
//!
//! From the ground: `log` (rows of numbers with their lines), `unit_names`, `cycles` (what is read from a loop), `model` (the loop
//! that the solver computes), `fit` (least squares), `page` (pictures); the whole question here.

mod cycles;
mod fit;
mod log;
mod model;
mod page;
#[cfg(test)]
mod tests;
mod unit_names;

use std::path::Path;

use fret_core::case::Units;
use serde_json::{Value, json};

use crate::case_file::CaseFile;
use crate::failure::Failure;
use crate::figures::figure;

pub use cycles::MeasuredCycle;
pub use page::page;

/// Energy ratio of the contact's loop from which it slides: Fouvry, Kapsa and Vincent (1995).
const SLIDING: f64 = 0.2;
/// An interval wider than this on either side, relative, tells nothing of its constant.
const TOLD: f64 = 0.5;

/// What is asked of a log.
#[derive(Debug, Clone, Default)]
pub struct Request {
    /// Columns by what they hold: `displacement`, `force`, `cycle`, `normal_force`; before those that the case names.
    pub columns: Vec<(String, String)>,
    /// Units by what they are of: `displacement`, `force`.
    pub units: Vec<(String, String)>,
    /// The cycle that is fitted; default: the last.
    pub cycle: Option<f64>,
    /// A key of the case that is fitted too, such as `lower.substrate.young`.
    pub key: Option<String>,
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
    let measured = cycles::split(&table, scale)?;
    let model = model::Model::new(case_file, request.key.as_deref())?;
    let chosen = cycles::choose(&measured, request.cycle, name)?;
    let fitted = fit::fit(name, chosen, &model)?;
    let normal_force = fitted.normal_force;
    let rows: Vec<Value> = measured
        .iter()
        .map(|cycle| cycle.quantities(normal_force, fitted.stiffness()).to_json(cycle))
        .collect();
    let own = chosen.quantities(normal_force, fitted.stiffness());
    let drift = cycles::drift(&measured);
    notes.extend(fitted.notes.iter().cloned());
    let units = case.units.clone().unwrap_or_else(|| Units::new("m", "N"));
    let [offset, within, force_offset] = fitted.removed;
    let json = json!({
        "log": name,
        "units": {"length": units.length, "force": units.force},
        "cycle": chosen.name,
        "normal_force": normal_force,
        "parameters": fitted.constants.iter().map(fit::Constant::to_json).collect::<Vec<_>>(),
        "noise": fitted.noise,
        "removed": {
            "displacement_offset": offset,
            "displacement_drift": within,
            "force_offset": force_offset,
            "drift_per_cycle": drift,
        },
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
    let text = text(&json, &units, measured.len());
    let page = page(&json, &units, &measured);
    Ok(Identification { json, text, page })
}

fn condition(energy_ratio: f64, slides: bool) -> &'static str {
    match (energy_ratio >= SLIDING, slides) {
        (true, true) => "gross_slip",
        (false, false) => "partial_slip",
        _ => "mixed",
    }
}

/// What a person reads.
fn text(json: &Value, units: &Units, cycles: usize) -> String {
    let number = |value: &Value| value.as_f64().map_or_else(|| "-".to_owned(), figure);
    let mut lines = vec![format!(
        "{}: {cycles} cycle{}, fitted: cycle {}",
        json["log"].as_str().unwrap_or_default(),
        if cycles == 1 { "" } else { "s" },
        json["cycle"].as_f64().unwrap_or_default()
    )];
    for constant in json["parameters"].as_array().into_iter().flatten() {
        let name = constant["name"].as_str().unwrap_or_default();
        let unit = units.of(constant["unit"].as_str().unwrap_or_default());
        if constant["told"].as_bool() == Some(true) {
            lines.push(format!(
                "  {name:<22} {} {unit}   95 %: {} .. {}",
                number(&constant["value"]),
                number(&constant["low"]),
                number(&constant["high"])
            ));
        } else {
            lines.push(format!("  {name:<22} not told by this loop"));
        }
    }
    let last =
        json["cycles"].as_array().and_then(|rows| rows.iter().find(|row| row["cycle"] == json["cycle"]));
    if let Some(row) = last {
        for (key, words, unit) in [
            ("dissipated_energy", "dissipated energy W_d", "force x length"),
            ("force_amplitude", "force amplitude Q*", "force"),
            ("displacement_amplitude", "displacement amplitude", "length"),
            ("opening", "delta_0", "length"),
            ("energy_ratio", "A", ""),
            ("sliding_ratio", "D", ""),
            ("contact_energy_ratio", "A of the contact", ""),
            ("contact_sliding_ratio", "D of the contact", ""),
            ("plateau_friction", "mu of the plateaus", ""),
            ("energy_friction", "mu by energy", ""),
        ] {
            if !row[key].is_null() {
                lines.push(
                    format!("  {words:<22} {} {}", number(&row[key]), units.of(unit)).trim_end().to_owned(),
                );
            }
        }
    }
    lines.push(format!(
        "  sliding condition      {}",
        json["sliding_condition"].as_str().unwrap_or_default().replace('_', " ")
    ));
    let removed = &json["removed"];
    lines.push(format!(
        "  removed from the log: displacement offset {}, drift {} over the cycle; force offset {}",
        number(&removed["displacement_offset"]),
        number(&removed["displacement_drift"]),
        number(&removed["force_offset"])
    ));
    lines.extend(
        json["notes"]
            .as_array()
            .into_iter()
            .flatten()
            .map(|note| format!("  note: {}", note.as_str().unwrap_or_default())),
    );
    lines.join("\n")
}

/// A refusal of a log, with what to do about it.
fn refused(name: &str, what: &str, help: &str) -> Failure {
    Failure::Call(format!("{name}: {what}"), help.to_owned())
}

/// The name of a log in messages and results.
pub fn name_of(path: &Path) -> String {
    path.display().to_string()
}
