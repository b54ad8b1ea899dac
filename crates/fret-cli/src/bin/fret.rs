//! The command `fret`, as a program of its own.

use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(fretting_cli::command_line(std::env::args_os()))
}
