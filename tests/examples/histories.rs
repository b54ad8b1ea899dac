//! Errors of random histories with 12, 24 and 48 increments in a cycle, by both rules, against references of many increments, which are kept
//! in FOLDER: `cargo run --release -p fret-validation --example histories -- FIRST COUNT FOLDER`.
//!
//! It prints the medians of the errors over those of end points, the numbers that are twice as far as by end points, those that grow with the
//! increments, and the operator applications. `HISTORIES_LIST=1` lists them all.

#![expect(clippy::print_stdout, clippy::print_stderr, reason = "its output is the table")]

use std::error::Error;
use std::fs;
use std::path::Path;

use fret_core::history::History;
use fret_validation::random_histories::{End, RandomHistory};
use fret_validation::{by_end_points, off_first_law, run};
use rayon::prelude::*;

const COUNTS: [usize; 3] = [12, 24, 48];
const FINE: usize = 480;
const QUANTITIES: [&str; 3] = ["energy", "shift", "shear"];
/// Errors below are no matter.
const SMALL: f64 = 2e-3;

/// Errors of one history: of every number of increments, of both rules.
struct Row {
    name: String,
    second: Vec<[f64; 3]>,
    ends: Vec<[f64; 3]>,
    applications: [usize; 2],
    off_first_law: f64,
}

fn solved(text: &str) -> Result<History, String> {
    run(text).map_err(|error| error.to_string())
}

/// The reference of a history: solved once, then read.
fn reference(history: &RandomHistory, folder: &Path) -> Result<End, String> {
    let path = folder.join(format!("{}_second.json", history.seed));
    if let Ok(text) = fs::read_to_string(&path) {
        return serde_json::from_str(&text).map_err(|error| error.to_string());
    }
    let end = End::of(&solved(&history.text(FINE))?);
    let text = serde_json::to_string(&end).map_err(|error| error.to_string())?;
    fs::write(&path, text).map_err(|error| error.to_string())?;
    Ok(end)
}

fn row(seed: u64, folder: &Path) -> Result<Row, String> {
    let history = RandomHistory::drawn(seed);
    let right = reference(&history, folder)?;
    let where_ = if history.is_line { "line" } else { "point" };
    let name =
        format!("{seed} {:?} {where_}, {} of a cycle's increments to press", history.kind, history.pressing);
    let mut row =
        Row { name, second: Vec::new(), ends: Vec::new(), applications: [0; 2], off_first_law: 0.0 };
    for count in COUNTS {
        let text = history.text(count);
        let (second, ends) = (solved(&text)?, solved(&by_end_points(&text))?);
        row.off_first_law = [&second, &ends]
            .map(|found| off_first_law(found, 0.0))
            .into_iter()
            .fold(row.off_first_law, f64::max);
        row.applications[0] += second.work().convolutions;
        row.applications[1] += ends.work().convolutions;
        row.second.push(End::of(&second).off(&right).map(f64::abs));
        row.ends.push(End::of(&ends).off(&right).map(f64::abs));
    }
    Ok(row)
}

fn median(mut numbers: Vec<f64>) -> f64 {
    numbers.sort_by(f64::total_cmp);
    numbers.get(numbers.len() / 2).copied().unwrap_or(f64::NAN)
}

fn main() -> Result<(), Box<dyn Error>> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [first, count, folder] = &words[..] else { return Err("FIRST COUNT FOLDER".into()) };
    let (first, count): (u64, u64) = (first.parse()?, count.parse()?);
    fs::create_dir_all(folder)?;
    let rows: Vec<Result<Row, (u64, String)>> = (first..first + count)
        .into_par_iter()
        .map(|seed| row(seed, Path::new(folder)).map_err(|error| (seed, error)))
        .collect();
    let mut solved = Vec::new();
    for row in rows {
        match row {
            Ok(row) => solved.push(row),
            Err((seed, error)) => eprintln!("{seed}: {}", error.lines().next().unwrap_or_default()),
        }
    }
    let lists = std::env::var("HISTORIES_LIST").is_ok();
    println!("{} histories; {COUNTS:?} increments in a cycle", solved.len());
    for (quantity, name) in QUANTITIES.into_iter().enumerate() {
        let medians = (0..COUNTS.len()).map(|at| {
            let ratio = |row: &Row| row.second[at][quantity] / row.ends[at][quantity];
            median(solved.iter().filter(|row| row.ends[at][quantity] > 1e-12).map(ratio).collect())
        });
        let medians: Vec<String> = medians.map(|median| format!("{median:.2}")).collect();
        let (mut twice, mut grown) = (Vec::new(), Vec::new());
        for row in &solved {
            for at in 0..COUNTS.len() {
                let (error, ends) = (row.second[at][quantity], row.ends[at][quantity]);
                let told =
                    format!("{}: {name} at {} {error:.1e}, by end points {ends:.1e}", row.name, COUNTS[at]);
                if error > SMALL && error > 2.0 * ends {
                    twice.push(told.clone());
                }
                if at > 0 && error > SMALL && error > 1.2 * row.second[at - 1][quantity] {
                    grown.push(format!("{told}, at {} {:.1e}", COUNTS[at - 1], row.second[at - 1][quantity]));
                }
            }
        }
        println!(
            "{name}: medians over end points {}; twice {}, grown {}",
            medians.join(", "),
            twice.len(),
            grown.len()
        );
        if lists {
            for told in &twice {
                println!("  twice {told}");
            }
            for told in &grown {
                println!("  grown {told}");
            }
        }
    }
    let applications = [0, 1].map(|rule| solved.iter().map(|row| row.applications[rule]).sum::<usize>());
    println!("applications {applications:?}, {:.3}", applications[0] as f64 / applications[1] as f64);
    println!("first law {:.1e}", solved.iter().map(|row| row.off_first_law).fold(0.0, f64::max));
    Ok(())
}
