//! What can be typed after the verbs that read what somebody has measured.

use std::path::PathBuf;

use clap::Args;

use crate::manner::Manner;
use crate::threads::Threads;

/// Which scar, and which line.
#[derive(Debug, Args)]
#[command(mut_arg("out", |out| out.value_name("DIR").help("Folder for the answer [default: scar in the folder of the results]")))]
pub struct CompareScarArguments {
    /// The results folder of a run with wear, finished or not, that kept its wear depth
    pub folder: PathBuf,
    /// The measured line (CSV): position and height, row by row; any lines above the names of the columns
    pub measured: PathBuf,
    /// Which column holds what, by name or by number from 1: `position=NAME,height=NAME` [default: usual names]
    #[arg(long, value_name = "WHAT=NAME,...", value_delimiter = ',')]
    pub columns: Vec<String>,
    /// Units of the columns, such as position=um,height=nm [default: those beside the names, or those of the case]
    #[arg(long, value_name = "WHAT=UNIT,...", value_delimiter = ',')]
    pub units: Vec<String>,
    /// The body whose scar it is: upper or lower, of bodies that move against each other [default: lower, or both together]
    #[arg(long, value_parser = ["upper", "lower"])]
    pub body: Option<String>,
    /// Along which axis the line runs, through the deepest place
    #[arg(long, value_parser = ["x", "y"], default_value = "x")]
    pub along: String,
    /// How it is done.
    #[command(flatten)]
    pub manner: Manner,
}

/// Which loops, and what is known of the test.
#[derive(Debug, Args)]
#[command(mut_arg("out", |out| out.value_name("DIR").help("Folder for the answer [default: results/ and the name of the log with -identified]")))]
pub struct IdentifyArguments {
    /// The measured log (CSV): displacement of the actuator and tangential force, row by row, or depth and load of an indentation; any lines above the names of the columns
    pub log: PathBuf,
    /// The case: bodies, profile, grid and the stages that press them. Its friction, or its numbers named by --fit, are where the fit starts
    #[arg(long, value_name = "CASE")]
    pub case: PathBuf,
    /// Which column holds what, by name or by number from 1: `displacement=NAME,force=NAME,cycle=NAME,normal_force=NAME`; of an indentation `depth=NAME,force=NAME` [default: rig.columns of the case, else usual names]
    #[arg(long, value_name = "WHAT=NAME,...", value_delimiter = ',')]
    pub columns: Vec<String>,
    /// Units of the columns, such as displacement=um,force=N [default: those beside the names, or those of the case]
    #[arg(long, value_name = "WHAT=UNIT,...", value_delimiter = ',')]
    pub units: Vec<String>,
    /// The cycle to fit, by its number [default: the last whole one]
    #[arg(long, value_name = "N")]
    pub cycle: Option<f64>,
    /// Repeat the fit on the first whole cycle of every N cycle numbers, over the whole test
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..), conflicts_with = "indentation")]
    pub every: Option<u32>,
    /// Also fit one number of the case, such as lower.substrate.young; of an indentation, numbers of bodies and profile, once for each
    #[arg(long, value_name = "KEY")]
    pub fit: Vec<String>,
    /// The log is load over depth of an indentation: fit the numbers named by --fit, such as lower.coatings[0].young, and the depth at first touch
    #[arg(long, conflicts_with = "cycle")]
    pub indentation: bool,
    /// Of an indentation: which part is fitted [default: whole]
    #[arg(long, value_name = "PART", value_parser = ["whole", "loading", "unloading"], requires = "indentation")]
    pub part: Option<String>,
    /// Of an indentation: the depth at which the indenter touches, in the unit of the case, where it is known [default: fitted]
    #[arg(long, value_name = "DEPTH", allow_negative_numbers = true, requires = "indentation")]
    pub touch: Option<f64>,
    /// Of an indentation: also fit the compliance of the instrument's frame [default: that of the rig in the case, or none]
    #[arg(long, requires = "indentation")]
    pub frame: bool,
    /// Refuse a log with a cycle that is no whole loop, or a row without a number [default: leave these out and name them]
    #[arg(long)]
    pub strict: bool,
    /// Threads.
    #[command(flatten)]
    pub threads: Threads,
    /// How it is done.
    #[command(flatten)]
    pub manner: Manner,
}
