//! `fret run`: from a case file to a folder of results, with a face for the time between.

use std::any::Any;
use std::num::NonZero;
use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::time::Instant;

use fret_core::cycle::CycleRecord;
use fret_core::history::{KeptFields, StepRecord};
use fret_core::model::ContactState;
use fret_core::plan::Plan;
use fret_core::simulation::{Iteration, Observer, RunError, Simulation};
use fret_core::wear::WornThrough;

use crate::arguments::RunArguments;
use crate::case_file::CaseFile;
use crate::commands::plan::left_out;
use crate::failure::{Failure, Unwritten};
use crate::figures::counted;
use crate::interrupt;
use crate::output::{ResultFolder, RunRecord, Standing};
use crate::progress::Progress;
use crate::summary::Summary;
use crate::tally::Tally;
use crate::terminal;

/// Solves a case.
pub fn run(arguments: &RunArguments) -> Result<(), Failure> {
    let begun = prepared(arguments).and_then(|preparation| {
        interrupt::listen();
        let folder = preparation.opened()?;
        Ok((preparation, folder))
    });
    match begun {
        Ok((preparation, folder)) => preparation.solved(folder, arguments),
        Err(failure) => {
            if arguments.json {
                terminal::answer(&format!("{:#}", failure.to_json()))?;
            }
            Err(failure)
        }
    }
}

/// Everything judged; nothing written yet.
struct Preparation {
    case_file: CaseFile,
    plan: Plan,
    folder: PathBuf,
    threads: usize,
    pool: rayon::ThreadPool,
}

fn prepared(arguments: &RunArguments) -> Result<Preparation, Failure> {
    if arguments.resume {
        return Err(Failure::Call(
            "--resume: not built yet".to_owned(),
            "without it the run starts from the beginning".to_owned(),
        ));
    }
    let case_file = CaseFile::read(&arguments.case)?;
    let plan = case_file.planned()?;
    let folder = arguments.out.clone().unwrap_or_else(|| Path::new("results").join(case_file.stem()));
    let standing = ResultFolder::standing(&folder, &case_file, arguments.force)?;
    let threads = arguments.threads.map_or_else(available_threads, usize::from);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().map_err(|error| {
        Failure::Call(
            format!("{}: {error}", counted(threads, "thread")),
            "--threads with a smaller number".to_owned(),
        )
    })?;
    if !arguments.quiet {
        announce(&plan, &folder, standing);
    }
    Ok(Preparation { case_file, plan, folder, threads, pool })
}

fn available_threads() -> usize {
    std::thread::available_parallelism().map_or(1, NonZero::get)
}

fn announce(plan: &Plan, folder: &Path, standing: Standing) {
    if !plan.left_out.is_empty() {
        terminal::say(&left_out(plan));
    }
    match standing {
        Standing::Free => {}
        Standing::SameCase => {
            terminal::say(&format!("{}: the earlier results of this case are replaced", folder.display()));
        }
        Standing::Forced => {
            terminal::say(&format!("{}: written into as it is, by --force", folder.display()));
        }
    }
}

impl Preparation {
    fn opened(&self) -> Result<ResultFolder, Unwritten> {
        let record = RunRecord::new(&self.case_file, &self.plan, self.threads);
        ResultFolder::open(&self.folder, &self.case_file, &self.plan, record)
    }

    fn solved(&self, folder: ResultFolder, arguments: &RunArguments) -> Result<(), Failure> {
        let started = Instant::now();
        let title = if self.plan.case.title.is_empty() {
            self.case_file.stem().display().to_string()
        } else {
            self.plan.case.title.clone()
        };
        let mut witness = Witness {
            folder,
            progress: Progress::new(arguments.quiet, &title, self.plan.increments),
            tally: Tally::new(&self.plan),
            unwritten: None,
        };
        let outcome = self.followed_by(&mut witness);
        let Witness { folder, progress, mut tally, unwritten } = witness;
        let outcome = outcome.map(|worn_through| tally.worn_through = worn_through);
        progress.end();
        let wall_s = started.elapsed().as_secs_f64();
        let failure = unwritten.map(Failure::from).or_else(|| outcome.err());
        let closed = folder.close(&tally, wall_s, failure.as_ref());
        let failure = failure.or_else(|| closed.err().map(Failure::from));
        let summary =
            Summary { plan: &self.plan, tally: &tally, folder: &self.folder, wall_s, threads: self.threads };
        if arguments.json {
            terminal::answer(&format!("{:#}", summary.to_json(failure.as_ref())))?;
        } else if failure.is_none() && !arguments.quiet {
            terminal::answer(&summary.table())?;
        }
        failure.map_or(Ok(()), Err)
    }

    fn followed_by(&self, witness: &mut Witness) -> Result<Option<WornThrough>, Failure> {
        let journey = || Simulation::new(&self.plan).run(witness).map(|history| history.worn_through);
        match catch_unwind(AssertUnwindSafe(|| self.pool.install(journey))) {
            Ok(Ok(worn_through)) => Ok(worn_through),
            Ok(Err(RunError::Interrupted { .. })) => Err(Failure::Interrupted(format!(
                "{} of {} increments are solved and kept in {}",
                witness.tally.solved,
                self.plan.increments,
                self.folder.display()
            ))),
            Ok(Err(error)) => Err(Failure::Unsolved(error)),
            Err(panic) => Err(Failure::Defect(words_of(panic.as_ref()))),
        }
    }
}

fn words_of(panic: &(dyn Any + Send)) -> String {
    let literal = panic.downcast_ref::<&str>().map(|words| (*words).to_owned());
    literal.or_else(|| panic.downcast_ref::<String>().cloned()).unwrap_or_else(|| "no words".to_owned())
}

/// Hears about the run: counts it, shows it, writes it down, and stops it when asked to or when it cannot be written down.
struct Witness {
    folder: ResultFolder,
    progress: Progress,
    tally: Tally,
    unwritten: Option<Unwritten>,
}

impl Observer for Witness {
    fn iterated(&mut self, iteration: &Iteration) -> ControlFlow<()> {
        if self.unwritten.is_some() {
            return ControlFlow::Break(());
        }
        self.progress.iterated(iteration, &self.tally);
        go_on()
    }

    fn solved(
        &mut self,
        record: &StepRecord,
        _: &ContactState,
        kept: Option<&KeptFields>,
    ) -> ControlFlow<()> {
        if self.unwritten.is_some() {
            return ControlFlow::Break(());
        }
        if let Err(unwritten) = self.folder.keep(record, kept) {
            self.unwritten = Some(unwritten);
            return ControlFlow::Break(());
        }
        self.tally.add(record);
        self.progress.solved(record, &self.tally);
        go_on()
    }

    fn cycled(&mut self, record: &CycleRecord) {
        self.tally.add_cycle(record);
        if let Err(unwritten) = self.folder.keep_cycle(record) {
            self.unwritten = Some(unwritten);
        }
    }
}

/// Whether the run goes on.
fn go_on() -> ControlFlow<()> {
    if interrupt::is_asked() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
}
