//! The judged families as a table for people and as values for programs.

use serde_json::{Value, json};

use super::judgement::Row;

/// Heads of the columns.
pub const HEADS: [&str; 10] = [
    "family",
    "cases",
    "response",
    "asymmetry",
    "least pivot",
    "residual",
    "energy",
    "symmetry",
    "iterations",
    "result",
];

/// The cells of a row. Iterations are the convolutions per increment, relative to the benign case.
pub fn cells(row: &Row, benign: f64) -> [String; 10] {
    let [response, asymmetry, pivot, residual, balance, mirror, effort] = match &row.worst {
        Some(worst) => [
            format!("{:.0e}", worst.response),
            format!("{:.0e}", worst.asymmetry),
            format!("{:.0e}", worst.pivot),
            format!("{:.0e}", worst.residual),
            format!("{:.0e}", worst.balance),
            format!("{:.0e}", worst.mirror),
            format!("{:.1}", worst.effort / benign),
        ],
        None => [const { String::new() }; 7].map(|_| "-".to_owned()),
    };
    [
        row.name.to_owned(),
        row.scenes.to_string(),
        response,
        asymmetry,
        pivot,
        residual,
        balance,
        mirror,
        effort,
        row.verdict(),
    ]
}

/// Convolutions per increment of the benign case, which is the first family.
pub fn benign(rows: &[Row]) -> f64 {
    rows.first().and_then(|row| row.worst).map_or(f64::NAN, |worst| worst.effort)
}

/// The table, and under it what fails and what was refused.
pub fn table(rows: &[Row]) -> String {
    let benign = benign(rows);
    let mut lines = vec![HEADS.map(str::to_owned)];
    lines.extend(rows.iter().map(|row| cells(row, benign)));
    let widths: [usize; 10] = std::array::from_fn(|column| {
        lines.iter().map(|line| line[column].chars().count()).max().unwrap_or(0)
    });
    let mut text: Vec<String> = lines
        .iter()
        .map(|line| {
            let padded: Vec<String> = line
                .iter()
                .zip(widths)
                .enumerate()
                .map(|(column, (cell, width))| {
                    if column == 0 || column == 9 {
                        format!("{cell:width$}")
                    } else {
                        format!("{cell:>width$}")
                    }
                })
                .collect();
            padded.join("  ").trim_end().to_owned()
        })
        .collect();
    for row in rows {
        for [scene, what] in &row.broken {
            text.push(format!("fails: {}, {scene}: {what}", row.name));
        }
        for [scene, why] in &row.refused {
            text.push(format!("refused: {}, {scene}: {why}", row.name));
        }
    }
    text.join("\n")
}

/// The same for programs.
pub fn json(rows: &[Row]) -> Value {
    let benign = benign(rows);
    let holds = rows.iter().all(Row::holds);
    let pair = |list: &[[String; 2]]| -> Vec<Value> {
        list.iter().map(|[scene, what]| json!({ "scene": scene, "what": what })).collect()
    };
    let families: Vec<Value> = rows
        .iter()
        .map(|row| {
            let worst = row.worst;
            json!({
                "family": row.name,
                "range": row.range,
                "scenes": row.scenes,
                "response_error": worst.map(|worst| worst.response),
                "asymmetry": worst.map(|worst| worst.asymmetry),
                "least_pivot": worst.map(|worst| worst.pivot),
                "residual": worst.map(|worst| worst.residual),
                "energy_missing": worst.map(|worst| worst.balance),
                "mirror_error": worst.map(|worst| worst.mirror),
                "iterations_against_benign": worst.map(|worst| worst.effort / benign),
                "slowest": row.slowest,
                "holds": row.holds(),
                "broken": pair(&row.broken),
                "refused": pair(&row.refused),
            })
        })
        .collect();
    json!({ "status": if holds { "holds" } else { "failed" }, "families": families })
}
