//! What can be typed after `fret`. What it does lives in `commands`.

mod columns;
mod measured;

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};

use crate::manner::Manner;
use crate::scatter::Scatter;
use crate::threads::{self, Threads};
pub use columns::columns_asked;
pub use measured::{CompareScarArguments, IdentifyArguments};

/// Fretting and partial slip of coated elastic contacts: pressure, shear, stick and slip zones through a loading history.
#[derive(Debug, Parser)]
#[command(
    name = "fret",
    version = fret_results::commit::VERSION,
    after_help = "Exit codes: 0 solved; 1 the case was refused (also when the contact grows to the edge of its grid); 2 failure (an increment did not converge, or a file could not be written); 130 interrupted, can be resumed. A sweep ends with 1 if points were refused and none failed, with 2 if a point failed."
)]
pub struct Arguments {
    /// Print JSON and nothing else on standard output; errors too
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
    /// Validate a case: report all errors at once, each with line, column and a suggested fix
    Check(PlannedArguments),
    /// Print the discretisation, the expected cost and the automatic simplifications; solve nothing
    Plan(PlannedArguments),
    /// Write a case to begin with, with units and comments; without a name the list of them
    Init(InitArguments),
    /// Explain a warning: what it means for the numbers, and what to do; without a name the list of them
    Explain {
        /// Name of the warning, as in run.json, or the first words of its message
        warning: Option<String>,
    },
    /// Print the JSON Schema of the case file
    Schema,
    /// Print completions of this command line for a shell
    Completions {
        /// Which shell
        shell: clap_complete::Shell,
    },
    /// Print the manual page of this command
    Man {
        /// A folder to write the pages of all commands into
        #[arg(long, short, value_name = "DIR")]
        out: Option<PathBuf>,
    },
    /// Write one HTML page of a run (loops, sections, zone maps, energy, convergence), of a sweep (fretting map, curves, uncertainty) or of
    /// a study; needs no network
    Report(ReportArguments),
    /// Play with a case in the browser: sliders for moduli, thickness, friction and loads solve it again while they are dragged
    Explore(ExploreArguments),
    /// Convert the results of a run: NumPy, CSV, VTK
    Export(ExportArguments),
    /// Refinement study: errors, orders of convergence and times over grids and increments, and which to choose
    Study(StudyArguments),
    /// Exact derivatives of the results by the numbers of the case: what they depend on, and how much. Not covered:
    /// thinning by wear, debris with a stiffness, hardness, surfaces that move or roll, graded coatings
    Sensitivity(SensitivityArguments),
    /// Moved to `cargo xtask extremes`
    #[command(hide = true)]
    Extremes {
        /// Whatever it was called with
        #[arg(trailing_var_arg = true, allow_hyphen_values = true)]
        words: Vec<String>,
    },
    /// Subsurface stresses from the kept tractions of a run
    Stress(StressArguments),
    /// Friction coefficient, stiffness of the rig and the quantities of every cycle from measured fretting loops; moduli and thicknesses from an indentation
    Identify(IdentifyArguments),
    /// The computed wear scar of a run beside a line that a profilometer has measured
    CompareScar(CompareScarArguments),
    /// Temperature rise by the friction of the last cycle, and contact resistance, from the kept fields of a run
    Heat(HeatArguments),
    /// Parameter sweep: solve a base case for lists of values of its keys, or for samples of uncertain ones
    Sweep(SweepArguments),
}

/// A case to begin with.
#[derive(Debug, Args)]
#[command(mut_arg("out", |out| out.value_name("FILE").requires("template").help("The file to write [default: the name with .toml]")))]
pub struct InitArguments {
    /// Which one: ball-on-flat, coated, cylinder, rig-log, wear, rolling, rough, indentation
    pub template: Option<String>,
    /// How it is done.
    #[command(flatten)]
    pub manner: Manner,
}

/// Of what a page is written.
#[derive(Debug, Args)]
#[command(mut_arg("out", |out| out.value_name("FILE").help("The page to write [default: report.html in that folder]")))]
pub struct ReportArguments {
    /// The folder of the results of a run, a sweep or a study
    pub results: PathBuf,
    /// How it is done.
    #[command(flatten)]
    pub manner: Manner,
}

/// Which case is planned.
#[derive(Debug, Args)]
#[command(mut_arg("out", |out| out.value_name("FILE").help("A file to write the answer into, as JSON [default: none]")))]
pub struct PlannedArguments {
    /// The case file (TOML); - reads it from standard input
    pub case: PathBuf,
    /// Start from a solved state, as `fret run` does
    #[arg(long, value_name = "RESULTS[:INCREMENT]")]
    pub from: Option<String>,
    /// How it is done.
    #[command(flatten)]
    pub manner: Manner,
}

/// Of what derivatives are taken, and by what.
#[derive(Debug, Args)]
#[command(mut_arg("out", |out| out.value_name("DIR").help("Folder for the answer, as JSON and as a table [default: none]")))]
pub struct SensitivityArguments {
    /// The case file (TOML); - reads it from standard input
    pub case: PathBuf,
    /// A result: a column of the last increment (`max_pressure`), of another (`increments[7].shift_x`), the energy of a cycle
    /// (`cycles[0].dissipated_energy`), a stress below the surface or a fatigue parameter (`stress.interface_shear`, `fatigue.crossland`); once for each [default: `max_pressure`, `approach`, and with friction `max_shear`, `dissipated_energy`]
    #[arg(long, value_name = "RESULT")]
    pub of: Vec<String>,
    /// A number of the case by its path (`friction.coefficient`, `lower.coatings[0].young`); once for each [default: all there are, or those
    /// with a scatter]
    #[arg(long, value_name = "PATH")]
    pub by: Vec<String>,
    /// The standard deviation of a number, also in per cent of it (`lower.coatings[0].young=10%`); once for each: prints that of the results, to
    /// first order, and what each number brings
    #[arg(long, value_name = "PATH=DEVIATION")]
    pub scatter: Vec<Scatter>,
    /// Threads.
    #[command(flatten)]
    pub threads: Threads,
    /// How it is done.
    #[command(flatten)]
    pub manner: Manner,
}

/// How to solve a case.
#[derive(Debug, Args)]
#[command(
    mut_arg("out", |out| out.value_name("DIR").help("Folder for the results [default: results/ and the name of the case]")),
    mut_arg("verbose", |verbose| verbose.help("Also tell every increment, the files that are written and the time taken, and print a paragraph for the methods section of a paper"))
)]
pub struct RunArguments {
    /// The case file (TOML); - reads it from standard input
    pub case: PathBuf,
    /// Threads.
    #[command(flatten)]
    pub threads: Threads,
    /// How it is done.
    #[command(flatten)]
    pub manner: Manner,
    /// Write into the folder even if it holds other files; only files of fret are replaced
    #[arg(long)]
    pub force: bool,
    /// Resume an interrupted run; start if there is none; do nothing if it is solved
    #[arg(long, conflicts_with = "force")]
    pub resume: bool,
    /// Start from a solved state: the last increment of a results folder, or the one whose number (from 0) follows a colon. The
    /// loads of the case continue from there; grid, bodies and profile must be those of the results
    #[arg(long, value_name = "RESULTS[:INCREMENT]", conflicts_with = "estimate_error")]
    pub from: Option<String>,
    /// Also solve an auxiliary coarse case, and print an error bar for every quantity of interest
    #[arg(long)]
    pub estimate_error: bool,
    /// Automatic simplifications to use (`fret plan` lists them): all, or none
    #[arg(long, value_enum, default_value = "all", value_name = "WHAT")]
    pub leave_out: LeavingOut,
}

/// What a run leaves out.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum LeavingOut {
    /// All that apply to the case
    All,
    /// None; same result to the solver tolerance, more work
    None,
}

/// Which resolutions to study, and what to compare them with.
#[derive(Debug, Clone, Default, Args)]
pub struct StudyRequest {
    /// Numbers of cells along x; the grid keeps its size and shape [default, without any list: the case's value, a half, a quarter]
    #[arg(long, value_name = "N,...", value_delimiter = ',')]
    pub cells: Vec<usize>,
    /// Numbers of increments per stage, or per cycle [default: as for the cells]
    #[arg(long, value_name = "N,...", value_delimiter = ',')]
    pub increments: Vec<usize>,
    /// Tolerances of the solver [default: that of the case]
    #[arg(long, value_name = "E,...", value_delimiter = ',')]
    pub tolerances: Vec<f64>,
    /// Reference: analytic (a closed form), finest (the finest level), or a TOML file of numbers [default: a closed form if the
    /// case has one, otherwise Richardson extrapolation]
    #[arg(long, value_name = "analytic|finest|FILE")]
    pub against: Option<String>,
}

/// Which case to study, and how.
#[derive(Debug, Args)]
#[command(mut_arg("out", |out| out.value_name("DIR").help("Folder for the table and the figure [default: results/ and the name of the case with -study]")))]
pub struct StudyArguments {
    /// The case file (TOML); - reads it from standard input
    pub case: PathBuf,
    /// What is asked.
    #[command(flatten)]
    pub request: StudyRequest,
    /// Threads.
    #[command(flatten)]
    pub threads: Threads,
    /// How it is done.
    #[command(flatten)]
    pub manner: Manner,
}

/// Which case to play with.
#[derive(Debug, Args)]
pub struct ExploreArguments {
    /// The case file (TOML); - reads it from standard input
    pub case: PathBuf,
    /// Cells along the longer side of the grid, at the most (a line contact: four times as many); more are slower
    #[arg(long, value_name = "N", default_value = "64", value_parser = clap::value_parser!(u16).range(8..=512))]
    pub cells: u16,
    /// Port of this machine [default: one that is free]
    #[arg(long, value_name = "N", default_value = "0", hide_default_value = true)]
    pub port: u16,
    /// Threads.
    #[command(flatten)]
    pub threads: Threads,
}

/// What to write of a run, in which form.
#[derive(Debug, Args)]
#[command(
    group = clap::ArgGroup::new("form").required(true).multiple(true),
    mut_arg("out", |out| out.help("The file (npz) or folder (csv, vtk) to write [default: export.npz, csv, vtk in the folder of the results]"))
)]
pub struct ExportArguments {
    /// The folder of the results
    pub results: PathBuf,
    /// One file for numpy.load
    #[arg(long, group = "form")]
    pub npz: bool,
    /// The history, and one file per kept increment with one row per cell
    #[arg(long, group = "form")]
    pub csv: bool,
    /// What `ParaView` and pyvista read.
    #[arg(
        long,
        group = "form",
        help = "One .vti image per kept increment and a .pvd list, for ParaView and pyvista"
    )]
    pub vtk: bool,
    /// How it is done.
    #[command(flatten)]
    pub manner: Manner,
}

/// Which stresses.
#[derive(Debug, Args)]
#[command(mut_arg("out", |out| out.value_name("DIR").help("Folder for the answer [default: stress in the folder of the results, where `fret report` finds it]")))]
pub struct StressArguments {
    /// The results folder of a run, finished or not
    pub folder: PathBuf,
    /// Depths below the surface of the body, in the units of the case [default: those of the case, or --auto]
    #[arg(
        long,
        value_name = "Z,...",
        value_delimiter = ',',
        allow_hyphen_values = true,
        conflicts_with = "auto"
    )]
    pub depths: Vec<f64>,
    /// Choose depths automatically: denser near the surface and the interfaces
    #[arg(long)]
    pub auto: bool,
    /// Evaluate every N-th kept increment, and the last [default: all]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub every: Option<u32>,
    /// The body: upper or lower
    #[arg(long, value_name = "BODY", value_parser = ["upper", "lower"])]
    pub body: Option<String>,
    /// What `ParaView` reads.
    #[arg(long, help = "Write a volume for ParaView of the last evaluated increment")]
    pub volume: bool,
    /// Threads.
    #[command(flatten)]
    pub threads: Threads,
    /// How it is done.
    #[command(flatten)]
    pub manner: Manner,
}

/// Which temperatures and resistances.
#[derive(Debug, Args)]
#[command(mut_arg("out", |out| out.value_name("DIR").help("Folder for the answer [default: heat in the folder of the results, where `fret report` finds it]")))]
pub struct HeatArguments {
    /// The results folder of a run, finished or not
    pub folder: PathBuf,
    /// A case file whose conductivities, resistivities and frequency are used [default: the case of the results]
    #[arg(long, value_name = "FILE")]
    pub case: Option<PathBuf>,
    /// Contact resistance of every N-th kept increment, and the last [default: of the last]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub every: Option<u32>,
    /// Threads.
    #[command(flatten)]
    pub threads: Threads,
    /// How it is done.
    #[command(flatten)]
    pub manner: Manner,
}

/// How to solve many cases.
#[derive(Debug, Args)]
#[command(mut_arg("out", |out| out.value_name("DIR").help("Folder for the results; points that are finished there are skipped [default: results/ and the name of the sweep]")))]
pub struct SweepArguments {
    /// The sweep file (TOML): base = "case.toml", and [axes] with "key.of.the.case" = [values], [distributions] with
    /// "key.of.the.case" = { normal = { mean = 0.6, deviation = 0.05 } } and [samples] count = 256,
    /// or both: the samples at every point of the axes
    pub sweep: PathBuf,
    /// Start every point from a solved state, as `fret run` does
    #[arg(long, value_name = "RESULTS[:INCREMENT]")]
    pub from: Option<String>,
    /// Number of threads, one per point [default: all cores]
    #[arg(long, value_name = "N", value_parser = threads::number)]
    pub threads: Option<u16>,
    /// How it is done.
    #[command(flatten)]
    pub manner: Manner,
}
