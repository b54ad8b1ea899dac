//! A short crack from the most severe place of the surface, through the last cycle.

use fret_core::model::HalfSpace;
use fret_core::subsurface::crack::{CrackCourse, CrackFate, CrackLength, crack_course};
use fret_core::subsurface::crack_path::{CrackStart, NoCrack, crack_path};
use fret_core::subsurface::fatigue::{LayerConstants, Parameter};
use fret_core::subsurface::severity::constants_of;
use fret_core::subsurface::{LoadedSurface, MostSevere};

use super::stress_record::CrackRecord;
use crate::failure::Failure;
use crate::figures::{figure, figure_in};
use crate::interrupt;
use crate::table::Columns;
use fret_results::Results;

/// Kind of a stress intensity.
const INTENSITY: &str = "pressure length^1/2";

/// Where the crack runs.
pub struct Crack<'a> {
    pub run: &'a Results,
    pub half_space: &'a HalfSpace,
    pub constants: &'a LayerConstants,
}

/// What is told of it.
pub struct CrackAnswer {
    pub record: CrackRecord,
    pub table: String,
    /// `crack.csv`, where it was followed.
    pub csv: Option<String>,
}

impl Crack<'_> {
    /// The crack's course; nothing where the outermost layer has no constants of cracks, or the surface is not among the depths.
    pub fn followed(
        &self,
        at_surface: &[MostSevere],
        cycle: &[LoadedSurface],
    ) -> Result<Option<CrackAnswer>, Failure> {
        let Some(constants) = constants_of(self.half_space, self.constants, 0).crack else { return Ok(None) };
        let severe = at_surface.iter().find(|found| found.parameter == Parameter::SmithWatsonTopper);
        let Some(severe) = severe else { return Ok(None) };
        let grid = self.run.grid();
        let followed = CrackStart::of(severe, grid.dimension()).and_then(|start| {
            let setting = (grid, self.run.case().periodic);
            let goes_on = || !interrupt::is_asked();
            let path = crack_path(self.half_space, setting, &start, constants.final_length, cycle, goes_on)?;
            let course =
                crack_course(&path, &constants).ok_or(NoCrack::TooInclined(start.angle.to_degrees()))?;
            Ok((start, course))
        });
        Ok(Some(match followed {
            Ok((start, course)) => self.answer(&start, &course),
            Err(NoCrack::Kernel(error)) => return Err(Failure::Defect(format!("stress kernels: {error}"))),
            Err(NoCrack::Stopped) => {
                return Err(Failure::Interrupted(
                    "the stresses are not finished and nothing is written".to_owned(),
                ));
            }
            Err(why) => {
                let record = CrackRecord::None { fate: "none".to_owned(), reason: why.to_string() };
                let table = format!("  {}\n", record.words(|value, _| figure(value)));
                CrackAnswer { record, table, csv: None }
            }
        }))
    }

    fn answer(&self, start: &CrackStart, course: &CrackCourse) -> CrackAnswer {
        let grid = self.run.grid();
        let [x, y] = [0, 1].map(|axis| grid.centre(axis, 0) + start.place[axis] * grid.spacing()[axis]);
        let degrees = start.angle.to_degrees();
        let fate = match course.fate {
            CrackFate::DoesNotGrow => "does_not_grow",
            CrackFate::Stops => "stops",
            CrackFate::Grows => "grows",
            CrackFate::Fractures => "fractures",
        };
        let record = CrackRecord::Followed {
            fate: fate.to_owned(),
            x,
            y,
            angle: degrees,
            towards: start.horizontal,
            length: course.length,
            cycles: course.cycles,
        };
        let units = self.run.units();
        let table = format!("  {}\n", record.words(|value, kind| figure_in(units, value, kind)));
        let columns = Columns::<CrackLength>::new()
            .column("length", "length", |at| at.length)
            .column("k1_max", INTENSITY, |at| at.largest)
            .column("k1_range", INTENSITY, |at| at.range)
            .column("k2_range", INTENSITY, |at| at.sliding_range)
            .column("threshold", INTENSITY, |at| at.threshold)
            .column("cycles", "", |at| at.cycles);
        let csv = columns.csv(units, &course.lengths);
        CrackAnswer { record, table, csv: Some(csv) }
    }
}
