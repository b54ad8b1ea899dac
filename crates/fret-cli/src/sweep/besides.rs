//! What the case of a point of a sweep asks for besides its numbers: stresses, fatigue, crack, coating, heat. They are computed from a run
//! as `fret run` leaves it, in a folder that is there as long as it takes.

use std::fs;
use std::path::Path;

use fret_core::history::History;
use fret_core::plan::Plan;

use super::answer::Besides;
use super::question::Point;
use crate::failure::{Failure, Unwritten};
use crate::run::{Solved, save};
use crate::{heat, stress};
use fret_results::Wish;

/// Computes what a solved point is asked for; `folder` is gone afterwards.
///
/// # Errors
/// Why it cannot be had.
pub fn besides(folder: &Path, point: &Point, plan: &Plan, history: &History) -> Result<Besides, Failure> {
    removed(folder)?;
    let solved = Solved { plan, history, quantities: &[], early: None, error_bars: None };
    let answer = save(solved, &point.case_file, folder, Wish::Start).and_then(|()| {
        // what is told of it shall not name a folder that is gone
        let nameless = |failure| match failure {
            Failure::Call(why, help) => {
                let shown = format!("{}: ", folder.display());
                Failure::call(format!("not computed: {}", why.replace(&shown, "")), help)
            }
            other => other,
        };
        let stress = stress::answered(folder).map_err(nameless)?.map(|(record, _)| record);
        let heat = heat::answered(folder).map_err(nameless)?.map(|(record, _)| record);
        Ok(Besides { stress, heat })
    });
    removed(folder)?;
    answer
}

fn removed(folder: &Path) -> Result<(), Failure> {
    if folder.exists() {
        fs::remove_dir_all(folder).map_err(Unwritten::at(folder))?;
    }
    Ok(())
}
