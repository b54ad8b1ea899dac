//! Errors of random histories over their increments, both rules against many increments:
//! `cargo run --release -p fret-validation --example histories -- FIRST COUNT FOLDER`. The references are kept in FOLDER.

#![expect(clippy::print_stdout, reason = "its output is the table")]

use std::error::Error;
use std::fs;
use std::path::Path;

use fret_core::history::History;
use fret_validation::random_histories::RandomHistory;
use fret_validation::{by_end_points, run};
use rayon::prelude::*;

const COUNTS: [usize; 3] = [12, 24, 48];
const FINE: usize = 480;

/// Dissipated energy, shift and shear at the end of a history.
#[derive(serde::Serialize, serde::Deserialize, Clone)]
struct End {
    energy: f64,
    shift: [f64; 2],
    reach: f64,
    shear: Vec<f64>,
}

fn end(history: &History) -> End {
    let last = history.steps.last().unwrap();
    let reach = history.steps.iter().map(|step| step.shift[0].hypot(step.shift[1])).fold(0.0, f64::max);
    let shear = history.state.shear.iter().flat_map(|part| part.iter().copied()).collect();
    End { energy: last.dissipated_energy, shift: last.shift, reach, shear }
}

fn errors(found: &End, right: &End) -> [f64; 3] {
    let most = right.shear.iter().fold(0.0_f64, |most, q| most.max(q.abs()));
    let sum: f64 = found.shear.iter().zip(&right.shear).map(|(a, b)| (a - b) * (a - b)).sum();
    let touched = right.shear.iter().filter(|q| **q != 0.0).count().max(1);
    let shift = (found.shift[0] - right.shift[0]).hypot(found.shift[1] - right.shift[1]);
    [found.energy / right.energy - 1.0, shift / right.reach, (sum / touched as f64).sqrt() / most]
}

fn solved(text: &str) -> Result<End, String> {
    let history = run(text).map_err(|error| error.to_string())?;
    let off = fret_validation::off_first_law(&history, 0.0);
    if off > 1e-9 {
        eprintln!("first law: {off:.1e}");
    }
    Ok(end(&history))
}

fn reference(history: &RandomHistory, folder: &Path, rule: &str) -> Result<End, String> {
    let path = folder.join(format!("{}_{rule}.json", history.seed));
    if let Ok(text) = fs::read_to_string(&path) {
        return serde_json::from_str(&text).map_err(|error| error.to_string());
    }
    let text = history.text(FINE);
    let end = solved(&if rule == "end" { by_end_points(&text) } else { text })?;
    fs::write(&path, serde_json::to_string(&end).unwrap()).unwrap();
    Ok(end)
}

fn main() -> Result<(), Box<dyn Error>> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [first, count, folder] = &words[..] else { return Err("FIRST COUNT FOLDER".into()) };
    let (first, count): (u64, u64) = (first.parse()?, count.parse()?);
    let ends = std::env::var("ENDS").is_ok();
    fs::create_dir_all(folder)?;
    let rows: Vec<_> = (first..first + count)
        .into_par_iter()
        .map(|seed| {
            let history = RandomHistory::drawn(seed);
            let folder = Path::new(folder);
            let row = || -> Result<String, String> {
                let right = reference(&history, folder, "second")?;
                let mut text = String::new();
                if ends {
                    let other = reference(&history, folder, "end")?;
                    let apart = errors(&other, &right);
                    text += &format!("{{\"apart\":{apart:?},");
                } else {
                    text += "{";
                }
                let mut by = |rule: &str| -> Result<(), String> {
                    let found: Result<Vec<_>, String> = COUNTS
                        .iter()
                        .map(|n| {
                            let text = history.text(*n);
                            let found = solved(&if rule == "end" { by_end_points(&text) } else { text })?;
                            Ok(errors(&found, &right))
                        })
                        .collect();
                    text += &format!("\"{rule}\":{:?},", found?);
                    Ok(())
                };
                by("second")?;
                if ends {
                    by("end")?;
                }
                text += &format!(
                    "\"seed\":{seed},\"kind\":\"{:?}\",\"line\":{},\"pressing\":{}}}",
                    history.kind, history.is_line, history.pressing
                );
                Ok(text)
            };
            let row = row();
            if let Err(error) = &row {
                eprintln!("seed {seed}, {:?}: {}", history.kind, error.lines().next().unwrap_or_default());
            }
            row.ok()
        })
        .collect();
    for row in rows.into_iter().flatten() {
        println!("{row}");
    }
    Ok(())
}
