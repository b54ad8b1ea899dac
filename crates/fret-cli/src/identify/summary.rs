//! What a person reads of an identification.

use fret_core::case::Units;
use serde_json::Value;

use crate::figures::figure;

/// What a person reads.
pub fn summary(json: &Value, units: &Units) -> String {
    let number = |value: &Value| value.as_f64().map_or_else(|| "-".to_owned(), figure);
    let count = json["cycles"].as_array().map_or(0, Vec::len);
    let left_out = json["left_out"]["cycles"].as_array().map_or(0, Vec::len);
    let of = if left_out == 0 { String::new() } else { format!("{} of ", count - left_out) };
    let mut lines = vec![format!(
        "{}: {of}{count} cycle{}{}, fitted: cycle {}",
        json["log"].as_str().unwrap_or_default(),
        if count == 1 { "" } else { "s" },
        if left_out == 0 { "" } else { " used" },
        json["cycle"].as_f64().unwrap_or_default()
    )];
    for key in ["cycles_in_words", "rows_in_words"] {
        lines.extend(json["left_out"][key].as_str().map(|words| format!("  left out: {words}")));
    }
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
        "  removed from the log: displacement offset {}, drift {} over the cycle{}; force offset {}",
        number(&removed["displacement_offset"]),
        number(&removed["displacement_drift"]),
        match removed["displacement_bend"].as_f64() {
            Some(bend) if bend != 0.0 => format!(", which bends by {}", figure(bend)),
            _ => String::new(),
        },
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
