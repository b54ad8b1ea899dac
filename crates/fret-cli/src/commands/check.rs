//! `fret check`: is this a case that can be computed? All mistakes at once, or a few facts.

use std::path::Path;

use crate::case_file::CaseFile;
use crate::commands::plan::{cells, stages};
use crate::failure::Failure;
use crate::figures::counted;
use crate::terminal;

/// Judges a case.
pub fn check(path: &Path) -> Result<(), Failure> {
    let case_file = CaseFile::read(path)?;
    let plan = case_file.planned()?;
    terminal::answer(&format!(
        "{}: good\n  {}\n  {}: {}",
        case_file.name(),
        cells(&plan),
        counted(plan.increments, "increment"),
        stages(&plan),
    ))
}
