//! Errors of random histories with 12, 24 and 48 increments in a cycle, by both rules, against references of many increments, which are kept
//! in FOLDER: `cargo run --release -p fret-validation --example histories -- FIRST COUNT FOLDER`.
//!
//! It prints the medians of the errors over those of end points, the numbers that are twice as far as by end points (and how many of them are
//! twice as far as what end points have in the other two counts, too, in proportion: an error of end points that changes its sign is small once),
//! those that grow with the increments, and the operator applications. `HISTORIES_LIST=1` lists them all. `HISTORIES_AUTO=0.03` asks instead how far
//! the increments that the program chooses to this tolerance are from the reference.

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
/// End points that err by less are right, but for rounding and what the tolerance leaves.
const ROUNDING: f64 = 1e-6;
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

/// The largest error of end points in all counts, each in proportion to its increments.
fn likely(row: &Row, at: usize, quantity: usize) -> f64 {
    let error = |other: usize| row.ends[other][quantity] * COUNTS[other] as f64 / COUNTS[at] as f64;
    (0..COUNTS.len()).map(error).fold(0.0, f64::max)
}

/// How far a history is from its reference with increments that the program chooses, and what it took.
struct Chosen {
    name: String,
    errors: [f64; 3],
    applications: usize,
    parts: usize,
}

fn chosen(seed: u64, folder: &Path, tolerance: f64) -> Result<Chosen, String> {
    let history = RandomHistory::drawn(seed);
    let right = reference(&history, folder)?;
    let found = solved(&history.with_chosen_increments(tolerance))?;
    Ok(Chosen {
        name: format!("{seed} {:?} {}", history.kind, if history.is_line { "line" } else { "point" }),
        errors: End::of(&found).off(&right).map(f64::abs),
        applications: found.work().convolutions,
        parts: found.steps.iter().map(|step| step.parts).sum(),
    })
}

/// Of all histories, those within three tolerances of their references.
fn print_chosen(rows: &[Chosen], tolerance: f64, lists: bool) {
    let within = |error: f64| error <= 3.0 * tolerance;
    println!("{} histories, increments chosen to {tolerance}", rows.len());
    for (quantity, name) in QUANTITIES.into_iter().enumerate() {
        let errors: Vec<f64> = rows.iter().map(|row| row.errors[quantity]).collect();
        let (held, worst) = (
            errors.iter().filter(|error| within(**error)).count(),
            errors.iter().fold(0.0, |a: f64, b| a.max(*b)),
        );
        println!(
            "{name}: {held} within three tolerances, median {:.1e}, worst {worst:.1e}",
            median(errors.clone())
        );
    }
    let all = rows.iter().filter(|row| row.errors.iter().all(|error| within(*error))).count();
    let sum = |of: fn(&Chosen) -> usize| rows.iter().map(of).sum::<usize>();
    println!(
        "all three: {all}; parts {}, applications {}",
        sum(|row| row.parts),
        sum(|row| row.applications)
    );
    for row in rows.iter().filter(|row| lists && !row.errors.iter().all(|error| within(*error))) {
        println!(
            "  {} {:?} in {} parts",
            row.name,
            row.errors.map(|error| format!("{error:.1e}")),
            row.parts
        );
    }
}

fn median(mut numbers: Vec<f64>) -> f64 {
    numbers.sort_by(f64::total_cmp);
    numbers.get(numbers.len() / 2).copied().unwrap_or(f64::NAN)
}

/// What is found of all seeds; those that fail are told.
fn of_all<T: Send>(first: u64, count: u64, of: impl Fn(u64) -> Result<T, String> + Sync) -> Vec<T> {
    let rows: Vec<_> = (first..first + count).into_par_iter().map(|seed| (seed, of(seed))).collect();
    let told = |(seed, row): (u64, Result<T, String>)| {
        row.map_err(|error| eprintln!("{seed}: {}", error.lines().next().unwrap_or_default())).ok()
    };
    rows.into_iter().filter_map(told).collect()
}

fn main() -> Result<(), Box<dyn Error>> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [first, count, folder] = &words[..] else { return Err("FIRST COUNT FOLDER".into()) };
    let (first, count): (u64, u64) = (first.parse()?, count.parse()?);
    fs::create_dir_all(folder)?;
    let folder = Path::new(folder);
    let lists = std::env::var("HISTORIES_LIST").is_ok();
    if let Ok(tolerance) = std::env::var("HISTORIES_AUTO") {
        let tolerance = tolerance.parse()?;
        print_chosen(&of_all(first, count, |seed| chosen(seed, folder, tolerance)), tolerance, lists);
        return Ok(());
    }
    let solved = of_all(first, count, |seed| row(seed, folder));
    println!("{} histories; {COUNTS:?} increments in a cycle", solved.len());
    for (quantity, name) in QUANTITIES.into_iter().enumerate() {
        let medians_above = |least: f64| {
            let medians = (0..COUNTS.len()).map(|at| {
                let ratio = |row: &Row| row.second[at][quantity] / row.ends[at][quantity];
                median(solved.iter().filter(|row| row.ends[at][quantity] > least).map(ratio).collect())
            });
            medians.map(|median| format!("{median:.2}")).collect::<Vec<_>>().join(", ")
        };
        let (mut twice, mut of_all_counts, mut grown) = (Vec::new(), 0, Vec::new());
        for row in &solved {
            for at in 0..COUNTS.len() {
                let (error, ends) = (row.second[at][quantity], row.ends[at][quantity]);
                let told =
                    format!("{}: {name} at {} {error:.1e}, by end points {ends:.1e}", row.name, COUNTS[at]);
                if error > SMALL && error > 2.0 * ends {
                    twice.push(told.clone());
                    of_all_counts += usize::from(error > 2.0 * likely(row, at, quantity));
                }
                if at > 0 && error > SMALL && error > 1.2 * row.second[at - 1][quantity] {
                    grown.push(format!("{told}, at {} {:.1e}", COUNTS[at - 1], row.second[at - 1][quantity]));
                }
            }
        }
        println!(
            "{name}: medians over end points {} ({} where these err by more than {ROUNDING:e}); twice {} ({of_all_counts} in all counts), grown {}",
            medians_above(1e-12),
            medians_above(ROUNDING),
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
