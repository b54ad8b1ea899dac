//! A short crack from the most severe place of the surface, through the last cycle.

use fret_core::subsurface::crack::{CrackCourse, CrackFate, CrackLength, crack_course};
use fret_core::subsurface::crack_path::{CrackStart, NoCrack, crack_path};
use fret_core::subsurface::fatigue::Parameter;
use fret_core::subsurface::severity::constants_of;
use fret_core::subsurface::{LoadedSurface, MostSevere};

use super::below::Below;
use super::record::{CrackFollowed, CrackRecord};
use crate::failure::Failure;
use crate::figures::figure;
use crate::interrupt;
use crate::table::Columns;

/// Kind of a stress intensity.
const INTENSITY: &str = "pressure length^1/2";

/// What is told of it.
pub struct CrackAnswer {
    pub record: CrackRecord,
    pub table: String,
    /// `crack.csv`, where it was followed.
    pub csv: Option<String>,
}

/// The crack's course; nothing where the outermost layer has no constants of cracks, or the surface is not among the depths.
pub fn followed(
    below: &Below<'_>,
    at_surface: &[MostSevere],
    cycle: &[LoadedSurface],
) -> Result<Option<CrackAnswer>, Failure> {
    let Below { run, half_space, .. } = below;
    let Some(constants) = constants_of(half_space, below.constants, 0).crack else { return Ok(None) };
    let severe = at_surface.iter().find(|found| found.parameter == Parameter::SmithWatsonTopper);
    let Some(severe) = severe else { return Ok(None) };
    let grid = run.grid();
    let followed = CrackStart::of(severe, grid.dimension()).and_then(|start| {
        let setting = (grid, run.case().periodic);
        let goes_on = || !interrupt::is_asked();
        let path = crack_path(half_space, setting, &start, constants.final_length, cycle, goes_on)?;
        let course = crack_course(&path, &constants).ok_or(NoCrack::TooInclined(start.angle.to_degrees()))?;
        Ok((start, course))
    });
    Ok(Some(match followed {
        Ok((start, course)) => answer(below, &start, &course),
        Err(NoCrack::Kernel(error)) => return Err(Failure::Defect(format!("stress kernels: {error}"))),
        Err(NoCrack::Stopped) => {
            return Err(Failure::Interrupted(
                "the stresses are not finished and nothing is written".to_owned(),
            ));
        }
        Err(why) => {
            let record = CrackRecord { fate: "none".to_owned(), reason: Some(why.to_string()), course: None };
            let table = format!("  {}\n", record.words(|value, _| figure(value)));
            CrackAnswer { record, table, csv: None }
        }
    }))
}

fn answer(below: &Below<'_>, start: &CrackStart, course: &CrackCourse) -> CrackAnswer {
    let fate = match course.fate {
        CrackFate::DoesNotGrow => "does_not_grow",
        CrackFate::Stops => "stops",
        CrackFate::Grows => "grows",
        CrackFate::Fractures => "fractures",
    };
    let [x, y] = below.place([0, 0], start.place);
    let followed = CrackFollowed {
        x,
        y,
        angle: start.angle.to_degrees(),
        towards: start.horizontal,
        length: course.length,
        cycles: course.cycles,
    };
    let record = CrackRecord { fate: fate.to_owned(), reason: None, course: Some(followed) };
    let table = format!("  {}\n", record.words(|value, kind| below.told(value, kind)));
    let columns = Columns::<CrackLength>::new()
        .column("length", "length", |at| at.length)
        .column("k1_max", INTENSITY, |at| at.largest)
        .column("k1_range", INTENSITY, |at| at.range)
        .column("k2_range", INTENSITY, |at| at.sliding_range)
        .column("threshold", INTENSITY, |at| at.threshold)
        .column("cycles", "", |at| at.cycles);
    let csv = columns.csv(below.run.units(), &course.lengths);
    CrackAnswer { record, table, csv: Some(csv) }
}
