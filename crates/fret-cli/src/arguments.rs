//! What can be typed after `fret`. What it does lives in `commands`.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};

use crate::threads;

/// Predicts the fretting contact of coated bodies: pressure, shear, stick and slip through the loading history.
#[derive(Debug, Parser)]
#[command(
    name = "fret",
    version,
    after_help = "Exit codes: 0 solved, 1 refused (also a contact that grows to the edge of its grid), 2 failed (numerically, or a file could not be written), 130 interrupted and resumable. A sweep with points that have no answer ends in 1 when they were all refused, in 2 when one failed."
)]
pub struct Arguments {
    /// Answer in JSON, mistakes too, with nothing else on standard output
    #[arg(long, global = true)]
    pub json: bool,
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
        /// Start from a solved state, as `fret run` does
        #[arg(long, value_name = "RESULTS[:INCREMENT]")]
        from: Option<String>,
    },
    /// Say what will be computed, what is left out and why; compute nothing
    Plan {
        /// The case file (TOML)
        case: PathBuf,
        /// Start from a solved state, as `fret run` does
        #[arg(long, value_name = "RESULTS[:INCREMENT]")]
        from: Option<String>,
    },
    /// Print the JSON Schema of the case file
    Schema,
    /// Show a run in one page: loops, sections, stick and slip, energy, convergence; a browser opens it, no network
    Report {
        /// The folder of the results
        results: PathBuf,
        /// The page [default: report.html in that folder]
        #[arg(long, value_name = "FILE")]
        out: Option<PathBuf>,
    },
    /// Write the results of a run for other programs
    Export(ExportArguments),
    /// Solve a case at many resolutions: errors, orders, times, and which grid and increments to choose
    Study(StudyArguments),
    /// Solve stiff and extreme scenes and judge each by what must hold; the exit code says whether all do
    Extremes(ExtremesArguments),
    /// Stresses under the surface, from the kept tractions of a run
    Stress(StressArguments),
    /// Solve many cases: a base case, and keys of it with lists of values
    Sweep(SweepArguments),
}

/// How to solve a case.
#[derive(Debug, Args)]
pub struct RunArguments {
    /// The case file (TOML)
    pub case: PathBuf,
    /// Folder for the results [default: results/ and the name of the case]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Threads to compute with [default: all the machine has]
    #[arg(long, value_name = "N", value_parser = threads::number)]
    pub threads: Option<u16>,
    /// Say nothing but errors
    #[arg(long)]
    pub quiet: bool,
    /// Write into a folder even when it holds other things; only files of fret are replaced
    #[arg(long)]
    pub force: bool,
    /// Go on where a run was broken off; start where there is none, do nothing where it is solved
    #[arg(long, conflicts_with = "force")]
    pub resume: bool,
    /// Start from a solved state: of the last increment of the results in a folder, or of the one whose number (from 0) follows a
    /// colon. The loads of the case go on from there; grid, bodies and profile must be those of the results
    #[arg(long, value_name = "RESULTS[:INCREMENT]", conflicts_with = "estimate_error")]
    pub from: Option<String>,
    /// Solve a coarser companion too, and give every headline number an error bar
    #[arg(long)]
    pub estimate_error: bool,
    /// What is left out where the answer is the same without it: all that can be, or none, which computes everything
    #[arg(long, value_enum, default_value = "all", value_name = "WHAT")]
    pub leave_out: LeavingOut,
}

/// What a run leaves out.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum LeavingOut {
    /// All that the scene does not need
    All,
    /// Nothing
    None,
}

/// Which resolutions to study, and what to measure them by.
#[derive(Debug, Args)]
pub struct StudyArguments {
    /// The case file (TOML)
    pub case: PathBuf,
    /// Numbers of cells along x; the grid keeps its size and shape [default, without any list: the case's own, a half, a quarter]
    #[arg(long, value_name = "N,...", value_delimiter = ',')]
    pub cells: Vec<usize>,
    /// Numbers of increments of every stage, or of one of its cycles [default: as for the cells]
    #[arg(long, value_name = "N,...", value_delimiter = ',')]
    pub increments: Vec<usize>,
    /// Tolerances of the solver [default: that of the case]
    #[arg(long, value_name = "E,...", value_delimiter = ',')]
    pub tolerances: Vec<f64>,
    /// Measure by: analytic (a closed form), finest (the finest rung), or a TOML file of numbers [default: a closed form where
    /// the case has one, the limit of the ladder elsewhere]
    #[arg(long, value_name = "analytic|finest|FILE")]
    pub against: Option<String>,
    /// Folder for the table and the picture [default: results/ and the name of the case with -study]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Threads to compute with [default: all the machine has]
    #[arg(long, value_name = "N", value_parser = threads::number)]
    pub threads: Option<u16>,
    /// Say nothing but errors and the answer
    #[arg(long)]
    pub quiet: bool,
}

/// What to write of a run, in which form.
#[derive(Debug, Args)]
#[command(group = clap::ArgGroup::new("form").required(true).multiple(true))]
pub struct ExportArguments {
    /// The folder of the results
    pub results: PathBuf,
    /// One file for numpy.load
    #[arg(long, group = "form")]
    pub npz: bool,
    /// The history and a file a kept increment, a row a cell
    #[arg(long, group = "form")]
    pub csv: bool,
    /// What `ParaView` and pyvista read.
    #[arg(
        long,
        group = "form",
        help = "A .vti image a kept increment and a .pvd list, for ParaView and pyvista"
    )]
    pub vtk: bool,
    /// The file (npz) or folder (csv, vtk) to write [default: export.npz, csv, vtk in the folder of the results]
    #[arg(long, value_name = "PATH")]
    pub out: Option<PathBuf>,
}

/// Which stresses.
#[derive(Debug, Args)]
pub struct StressArguments {
    /// The folder of a run; of one that is not finished what there is
    pub folder: PathBuf,
    /// Depths under the surface of the body, in the units of the case [default: those of the case, or --auto]
    #[arg(
        long,
        value_name = "Z,...",
        value_delimiter = ',',
        allow_hyphen_values = true,
        conflicts_with = "auto"
    )]
    pub depths: Vec<f64>,
    /// Choose depths: denser toward the surface and the interfaces
    #[arg(long)]
    pub auto: bool,
    /// Look at every N-th kept increment, and the last [default: all]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub every: Option<u32>,
    /// The body: upper or lower
    #[arg(long, value_name = "BODY", value_parser = ["upper", "lower"])]
    pub body: Option<String>,
    /// What `ParaView` reads.
    #[arg(long, help = "Write a volume for ParaView of the last increment looked at")]
    pub volume: bool,
    /// Threads to compute with [default: all the machine has]
    #[arg(long, value_name = "N", value_parser = threads::number)]
    pub threads: Option<u16>,
    /// Say nothing but errors
    #[arg(long)]
    pub quiet: bool,
}

/// How to solve many cases.
#[derive(Debug, Args)]
pub struct SweepArguments {
    /// The sweep file (TOML): base = "case.toml", and [axes] with "key.of.the.case" = [values]
    pub sweep: PathBuf,
    /// Folder for the results; points finished there are not solved again [default: results/ and the name of the sweep]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Start every point from a solved state, as `fret run` does
    #[arg(long, value_name = "RESULTS[:INCREMENT]")]
    pub from: Option<String>,
    /// Threads to compute with, one a point [default: all the machine has]
    #[arg(long, value_name = "N", value_parser = threads::number)]
    pub threads: Option<u16>,
    /// Say nothing but errors
    #[arg(long)]
    pub quiet: bool,
}

/// Which extremes.
#[derive(Debug, Args)]
pub struct ExtremesArguments {
    /// Some of the scenes, on coarser grids: under a minute
    #[arg(long)]
    pub quick: bool,
    /// Write the table as a page of the documentation, too
    #[arg(long, value_name = "FILE")]
    pub page: Option<PathBuf>,
}
