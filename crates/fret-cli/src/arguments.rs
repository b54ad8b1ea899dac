//! What can be typed after `fret`. What it does lives in `commands`.

use std::ffi::OsString;
use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};

/// Predicts the fretting contact of coated bodies: pressure, shear, stick and slip through the loading history.
#[derive(Debug, Parser)]
#[command(
    name = "fret",
    version,
    after_help = "Exit codes: 0 solved, 1 refused, 2 failed (numerically, or a file could not be written), 130 interrupted."
)]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub verb: Verb,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub enum Verb {
    /// Solve a case
    Run(RunArguments),
    /// Read and judge a case: all mistakes at once, each with its place
    Check {
        /// The case file (TOML)
        case: PathBuf,
    },
    /// Say what will be computed, what is left out and why; compute nothing
    Plan {
        /// The case file (TOML)
        case: PathBuf,
        /// Answer in JSON
        #[arg(long)]
        json: bool,
    },
    /// Print the JSON Schema of the case file
    Schema,
    #[command(hide = true, disable_help_flag = true)]
    Study(Unbuilt),
    #[command(hide = true, disable_help_flag = true)]
    Extremes(Unbuilt),
    #[command(hide = true, disable_help_flag = true)]
    Stress(Unbuilt),
    #[command(hide = true, disable_help_flag = true)]
    Report(Unbuilt),
    #[command(hide = true, disable_help_flag = true)]
    Export(Unbuilt),
    /// Solve many cases: a base case, and keys of it with lists of values
    Sweep(SweepArguments),
}

/// How to solve a case.
#[derive(Debug, Args)]
#[expect(clippy::struct_excessive_bools, reason = "one for each switch that can be typed")]
pub struct RunArguments {
    /// The case file (TOML)
    pub case: PathBuf,
    /// Folder for the results [default: results/ and the name of the case]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Threads to compute with [default: all the machine has]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Say nothing but errors
    #[arg(long)]
    pub quiet: bool,
    /// Answer in JSON, with nothing else on standard output
    #[arg(long)]
    pub json: bool,
    /// Write into a folder even when it holds other things; only files of `fret` are replaced
    #[arg(long)]
    pub force: bool,
    /// Go on where a run was interrupted (not built yet)
    #[arg(long, hide = true)]
    pub resume: bool,
}

/// How to solve many cases.
#[derive(Debug, Args)]
pub struct SweepArguments {
    /// The sweep file (TOML): base = "case.toml", and [axes] with "key.of.the.case" = [values]
    pub sweep: PathBuf,
    /// Folder for the results; points finished there are not solved again [default: results/ and the name of the sweep]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Threads to compute with, one a point [default: all the machine has]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Say nothing but errors
    #[arg(long)]
    pub quiet: bool,
    /// Answer in JSON, with nothing else on standard output
    #[arg(long)]
    pub json: bool,
}

/// Arguments of a verb that is not built yet: anything.
#[derive(Debug, Args)]
pub struct Unbuilt {
    /// Anything.
    #[arg(trailing_var_arg = true, allow_hyphen_values = true, num_args = 0..)]
    pub anything: Vec<OsString>,
}
