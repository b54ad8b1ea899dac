//! Half of `cargo xtask extremes`: solves the stiff and extreme cases, family by family, and writes the page
//! `docs/trust/extremes.md`: `cargo run --release -p fret-validation --example stiff_cases -- [--page FILE]`.

#![expect(clippy::print_stdout, reason = "its output is the table")]

use std::error::Error;
use std::process::ExitCode;

use fret_validation::stiff_cases::{Row, families, page, row};

fn main() -> Result<ExitCode, Box<dyn Error>> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let rows: Vec<Row> = families(false).iter().map(row).collect();
    let text = page(&rows);
    match &words[..] {
        [] => {}
        [option, file] if option == "--page" => std::fs::write(file, &text)?,
        _ => return Err("usage: stiff_cases [--page FILE]".into()),
    }
    print!("{text}");
    Ok(if rows.iter().all(Row::holds) { ExitCode::SUCCESS } else { ExitCode::from(2) })
}
