//! `fret run`: from a case file to a folder of results, with a face for the time between.

use std::time::Instant;

use crate::arguments::RunArguments;
use crate::failure::Told;
use crate::interrupt;
use crate::run::{Beginning, Wanted};

/// Solves a case.
pub fn run(arguments: &RunArguments, as_json: bool, since: Instant) -> Result<(), Told> {
    let begun = Wanted::by(arguments).and_then(Wanted::prepared).and_then(|preparation| {
        interrupt::listen();
        let beginning = preparation.begun()?;
        Ok((preparation, beginning))
    });
    match begun? {
        (preparation, Beginning::Nothing(record)) => preparation.solved_before(&record, as_json)?,
        (preparation, Beginning::At(departure)) => preparation.solved(*departure, as_json)?,
    }
    arguments.manner.done(since);
    Ok(())
}
