//! The course of a run: from where it begins to its folder of results, error bars and what its case asks for besides.

use std::time::Instant;

use fret_core::history::{WornByLayer, WornThrough};
use fret_core::run::{Checkpoint, Simulation};
use fret_core::study::{QuantityReader, StageQuantities};
use serde_json::json;

use super::estimate::{Estimate, NoBars};
use super::methods::paragraph;
use super::observer::{Clock, Guest, RunObserver};
use super::preparation::{Preparation, Wanted};
use super::progress::Progress;
use super::summary::{Ended, Summary};
use crate::defect;
use crate::failure::{Failure, Told};
use crate::manner::Listener;
use crate::terminal;
use crate::{heat, stress};
use fret_results::{ERROR_BARS, Origin, Record, ResultFolder, RunRecord, Standing, Stored, Tally};

/// Where a run begins.
pub enum Beginning {
    /// There is nothing to do: the record of the run that was solved before.
    Nothing(Box<Record>),
    /// At the start of the history, or in its middle.
    At(Box<Departure>),
}

/// A run about to go, or to go on.
pub struct Departure {
    folder: ResultFolder,
    tally: Tally,
    from: Checkpoint,
    /// Time spent before [s].
    wall_s: f64,
}

/// Runs a case into a folder as it is wanted, and tells no answer; `guest` hears of every increment and may stop the run.
///
/// # Errors
/// What ended the run early; what was solved is in the folder.
pub fn run_into(wanted: Wanted, guest: &mut Guest<'_>) -> Result<(), Failure> {
    let preparation = wanted.prepared()?;
    match preparation.begun()? {
        Beginning::Nothing(record) => {
            let quantities = quantities_of(&record);
            preparation.estimated(quantities, guest).map(|_| ())
        }
        Beginning::At(departure) => {
            let failure = preparation.followed(*departure, guest).failure;
            failure.or_else(|| preparation.stresses(false).err()).map_or(Ok(()), Err)
        }
    }
}

/// Quantities of interest as a record holds them.
fn quantities_of(record: &Record) -> &[StageQuantities] {
    record.end.as_ref().map_or(&[], |end| &end.quantities_of_interest)
}

impl Preparation {
    /// Where it begins; the folder is opened.
    pub fn begun(&self) -> Result<Beginning, Failure> {
        let start = self.origin.as_ref().map(Origin::told);
        let record = || RunRecord::new(&self.case_file, &self.plan, self.threads, start.as_ref());
        if let Standing::Solved(record) = &self.standing {
            return Ok(Beginning::Nothing(record.clone()));
        }
        if matches!(self.standing, Standing::Unfinished)
            && let Some(taken) = ResultFolder::reopen(&self.folder, &self.case_file, &self.plan, record())?
        {
            let Stored { head, checkpoint } = taken.stored;
            if let Some(why) = &taken.passed_over {
                self.manner.say(&format!("an older checkpoint is taken: {why}"));
            }
            if let Some(why) = &taken.ended {
                self.manner.say(&format!("it failed before, and may fail again: {why}"));
            }
            self.manner.say(&format!(
                "{}: {}; continuing with increment {} (counted from 0)",
                self.folder.display(),
                head.tally.standing(),
                checkpoint.solved()
            ));
            let (tally, wall_s) = (head.tally, head.wall_s);
            let departure = Departure { folder: taken.folder, tally, from: checkpoint, wall_s };
            return Ok(Beginning::At(Box::new(departure)));
        }
        let folder = ResultFolder::open(&self.folder, &self.case_file, &self.plan, record())?;
        let (tally, from) = (Tally::new(&self.plan), Checkpoint::start(&self.plan));
        Ok(Beginning::At(Box::new(Departure { folder, tally, from, wall_s: 0.0 })))
    }

    /// Tells that the run was solved before. Only what error bars need besides is computed, when they are asked for.
    pub fn solved_before(&self, record: &Record, as_json: bool) -> Result<(), Failure> {
        let shown = self.folder.display().to_string();
        let estimate = self.estimated(quantities_of(record), &mut Listener::silent())?;
        let done =
            if estimate.is_some() { "its error bars are computed now" } else { "nothing is left to do" };
        let message = format!("{shown}: solved already, {done}");
        if as_json {
            let totals = record.end.as_ref().map(|end| &end.totals);
            let answer = json!({
                "status": "solved",
                "message": message,
                "increments": totals.map(|totals| totals.increments),
                "totals": totals,
                "results": shown,
                "error_bars": estimate.map(|estimate| estimate.record),
            });
            terminal::answer_in_json(&answer)?;
        } else if !self.manner.quiet {
            let bars = estimate.map(|estimate| estimate.table() + "\n\n");
            terminal::answer(&(bars.unwrap_or_default() + &message))?;
            if let (true, Some(end)) = (self.manner.verbose, &record.end) {
                let by = (record.version.as_str(), record.commit.as_str());
                let methods = paragraph(&record.plan, end.totals.increments, by);
                terminal::answer(&format!("\nfor the methods section:\n{methods}"))?;
            }
        }
        Ok(())
    }

    /// Solves what is to be solved, and writes everything down.
    fn followed(&self, departure: Departure, guest: &mut Guest<'_>) -> Ended {
        let Departure { folder, tally, from, wall_s } = departure;
        let mut observer = RunObserver {
            folder,
            progress: Progress::new(&self.manner, &self.case_file.title(&self.plan.case), &tally),
            tally,
            clock: Clock { started: Instant::now(), before_s: wall_s },
            quantities: QuantityReader::of(&self.plan),
            failure: None,
            guest,
        };
        let outcome = self.followed_by(from, &mut observer);
        let RunObserver { folder, progress, mut tally, clock, failure, guest, .. } = observer;
        let outcome = outcome.map(|worn| (tally.worn_through, tally.worn_by_layer) = worn);
        progress.end();
        let wall_s = clock.read();
        let failure = failure.or_else(|| outcome.err());
        let warnings = tally.gauge.warnings(&self.plan);
        let closed =
            folder.close((&tally, &warnings), wall_s, failure.as_ref().map(Failure::ending).as_ref());
        let failure = failure.or_else(|| closed.err().map(Failure::from));
        let (estimate, failure) = match failure {
            None => match self.estimated(&tally.stage_quantities, guest) {
                Ok(estimate) => (estimate, None),
                Err(failure) => (None, Some(failure)),
            },
            failure => (None, failure),
        };
        Ended { tally, warnings, wall_s, estimate, failure }
    }

    /// Stresses, temperatures and contact resistances, where the case asks for them; `told` if they are to be told in words.
    fn stresses(&self, told: bool) -> Result<(), Failure> {
        let (case, folder) = (&self.plan.case, &self.folder);
        let tell = |text: &str| if told { terminal::answer(text) } else { Ok(()) };
        if case.stress.is_some()
            && let Some((_, text)) = self.pool.install(|| stress::answered(folder))?
        {
            tell(&text)?;
        }
        if !case.conduction.is_none()
            && let Some((_, text)) = self.pool.install(|| heat::answered(folder))?
        {
            tell(&text)?;
        }
        Ok(())
    }

    /// Solves it, tells what it found, and computes what its case asks for besides.
    pub fn solved(&self, departure: Departure, as_json: bool) -> Result<(), Told> {
        let ended = self.followed(departure, &mut Listener::silent());
        let summary =
            Summary { plan: &self.plan, folder: &self.folder, threads: self.threads, ended: &ended };
        if as_json {
            terminal::answer_in_json(&summary.to_json())?;
        } else if ended.failure.is_none() && !self.manner.quiet {
            terminal::answer(&summary.table())?;
            if self.manner.verbose {
                terminal::answer(&format!("\nfor the methods section:\n{}", summary.methods()))?;
            }
        }
        let Ended { tally, failure, .. } = ended;
        match &failure {
            Some(Failure::Unwritten(_)) if !ResultFolder::can_go_on(&self.folder) => {
                let shown = self.folder.display();
                terminal::say(&format!(
                    "{}, but {shown} is gone, or a part of it: nothing is left to continue",
                    tally.standing()
                ));
            }
            Some(Failure::Unwritten(_)) if tally.solved > 0 => {
                terminal::say(&format!("{}; once it can be written, --resume continues", self.kept(&tally)));
            }
            Some(Failure::Unsolved(_)) if tally.solved > 0 => {
                let shown = self.folder.display();
                terminal::say(&format!(
                    "{}; report, export and stress show them. --resume would end in the same increment; a case with other \
                     loads, friction or increments goes on from there with --from {shown}",
                    self.kept(&tally)
                ));
            }
            _ => {}
        }
        let failure = failure.or_else(|| self.stresses(!self.manner.quiet && !as_json).err());
        if failure.is_none() {
            self.manner.wrote(&self.folder);
        }
        failure.map_or(Ok(()), |failure| Err(Told { failure, in_json: as_json }))
    }

    /// Error bars, when they are asked for and can be had; also as a file beside the results.
    fn estimated(
        &self,
        stage_quantities: &[StageQuantities],
        guest: &mut Guest<'_>,
    ) -> Result<Option<Estimate>, Failure> {
        let Some(companion) = &self.companion else { return Ok(None) };
        let plan = &self.plan;
        match self.pool.install(|| Estimate::new(plan, companion, stage_quantities, guest)) {
            Ok(estimate) => {
                self.manner.write_json(&self.folder.join(ERROR_BARS), &estimate.record)?;
                Ok(Some(estimate))
            }
            Err(NoBars::Interrupted) => Err(Failure::Interrupted(format!(
                "the case is solved and kept in {}, its error bars are not; --resume --estimate-error continues with them",
                self.folder.display()
            ))),
            Err(NoBars::Because(why)) => {
                self.manner.say(&format!("no error bars: {why}"));
                Ok(None)
            }
        }
    }

    fn followed_by(
        &self,
        from: Checkpoint,
        observer: &mut RunObserver<'_>,
    ) -> Result<(Option<WornThrough>, Option<WornByLayer>), Failure> {
        let _memory = self.claim.take();
        let simulation = Simulation::new(&self.plan).in_claimed_memory();
        let journey =
            || simulation.resume(from, observer).map(|history| (history.worn_through, history.worn_by_layer));
        defect::caught(|| Ok(self.pool.install(journey)?)).map_err(|failure| match failure {
            Failure::Interrupted(_) => {
                let kept = self.kept(&observer.tally);
                Failure::Interrupted(format!("{kept}; --resume continues from there"))
            }
            failure => failure,
        })
    }

    fn kept(&self, tally: &Tally) -> String {
        format!("{} and kept in {}", tally.standing(), self.folder.display())
    }
}
