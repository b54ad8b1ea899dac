//! The kept tractions of a run, as loads for the stresses below them.

use std::path::Path;

use fret_core::case::{Side, StressRequest};
use fret_core::machine::memory;
use fret_core::plan::memory_of_stress;
use fret_core::subsurface::{self, LoadedSurface};

use crate::failure::Failure;
use crate::interrupt;
use fret_results::Results;

/// The tractions on the body in the increments that are looked at.
pub fn loaded_surfaces(
    folder: &Path,
    run: &Results,
    request: &StressRequest,
) -> Result<Vec<LoadedSurface>, Failure> {
    let kept = &run.fields.reached;
    let last = kept.len().saturating_sub(1);
    let chosen = kept.iter().enumerate().filter(|(n, _)| (last - n).is_multiple_of(request.every));
    memory::check(memory_of_stress(run.grid().len(), chosen.clone().count()))?;
    let sign = if request.body == Side::Lower { 1.0 } else { -1.0 };
    let mut surfaces = Vec::new();
    for (_, &increment) in chosen {
        if interrupt::is_asked() {
            return Err(stopped(folder));
        }
        let pair = |name: [&str; 2]| -> Result<Option<[ndarray::Array2<f64>; 2]>, Failure> {
            Ok(run.field(name[0], increment)?.zip(run.field(name[1], increment)?).map(<[_; 2]>::from))
        };
        let Some(pressure) = run.field("pressure", increment)? else { break }; // none was kept
        let shear = if run.is_frictionless() { None } else { pair(["shear_x", "shear_y"])? };
        let shear = shear.map(|shear| shear.map(|component| component * sign));
        let slip = pair(["slip_x", "slip_y"])?;
        let even = run.even_stress(request.body, increment);
        surfaces.push(LoadedSurface { increment, pressure, shear, slip, even });
    }
    let lacks_shear = || surfaces.iter().any(|surface| surface.shear.is_none());
    let missing = if surfaces.is_empty() {
        "holds no tractions: the pressure of no increment was kept"
    } else if !run.is_frictionless() && lacks_shear() {
        "holds no shear, but the contact has friction"
    } else {
        return Ok(surfaces);
    };
    let help = "run the case again with output.fields = [\"pressure\", \"shear\", ...]";
    Err(Failure::call(format!("{}: {missing}", folder.display()), help))
}

/// How deep to look below these surfaces [length].
pub fn reach(run: &Results, surfaces: &[LoadedSurface]) -> f64 {
    let loaded =
        |surface: &LoadedSurface| surface.pressure.iter().filter(|pressure| **pressure > 0.0).count();
    let most = surfaces.iter().map(loaded).max().unwrap_or(0);
    subsurface::reach(run.grid(), run.case().periodic, most)
}

/// The call was interrupted.
pub fn stopped(folder: &Path) -> Failure {
    let shown = folder.display();
    Failure::Interrupted(format!(
        "the stresses are not finished and nothing is written; run `fret stress {shown}` again"
    ))
}
