//! `fret run`: from a case file to a folder of results, with a face for the time between.

use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::time::Instant;

use fret_core::checkpoint::{Checkpoint, Waypoint};
use fret_core::cycle::CycleRecord;
use fret_core::history::{KeptFields, StepRecord};
use fret_core::model::{ContactState, SurfaceGrid};
use fret_core::plan::{LeaveOut, Plan};
use fret_core::plausibility;
use fret_core::simulation::{Iteration, Observer, RunError, Simulation};
use fret_core::study::{Headline, companion};
use fret_core::wear::WornThrough;
use serde_json::{Value, json};

use crate::arguments::{LeavingOut, RunArguments};
use crate::case_file::CaseFile;
use crate::commands::plan::left_out_in_short;
use crate::commands::stress::after_run;
use crate::defect;
use crate::estimate::Estimate;
use crate::failure::{Failure, Told, Unwritten};
use crate::figures::counted;
use crate::interrupt;
use crate::output::{ERROR_BARS, ResultFolder, RunRecord, Standing, Stored, Wish, write_whole};
use crate::progress::Progress;
use crate::summary::{Summary, warning_line};
use crate::tally::Tally;
use crate::terminal;
use crate::threads::available_threads;

/// Solves a case.
pub fn run(arguments: &RunArguments, as_json: bool) -> Result<(), Told> {
    let begun = prepared(arguments).and_then(|preparation| {
        interrupt::listen();
        let beginning = preparation.begun(arguments.quiet)?;
        Ok((preparation, beginning))
    });
    match begun {
        Ok((preparation, Beginning::Nothing(record))) => {
            Ok(preparation.solved_before(&record, arguments.quiet, as_json)?)
        }
        Ok((preparation, Beginning::At(departure))) => {
            preparation.solved(*departure, arguments.quiet, as_json)
        }
        Err(failure) => Err(failure.into()),
    }
}

/// Everything judged; nothing written yet.
struct Preparation {
    case_file: CaseFile,
    plan: Plan,
    folder: PathBuf,
    standing: Standing,
    /// The coarser run that error bars are read from, when they are asked for.
    companion: Option<Plan>,
    threads: usize,
    pool: rayon::ThreadPool,
}

/// Where a run begins.
enum Beginning {
    /// There is nothing to do: the record of the run that was solved before.
    Nothing(Value),
    /// At the start of the history, or in its middle.
    At(Box<Departure>),
}

/// A run about to go, or to go on.
struct Departure {
    folder: ResultFolder,
    tally: Tally,
    from: Checkpoint,
    /// Time spent before [s].
    wall_s: f64,
}

fn prepared(arguments: &RunArguments) -> Result<Preparation, Failure> {
    let case_file = CaseFile::read(&arguments.case)?;
    let leave_out = match arguments.leave_out {
        LeavingOut::All => LeaveOut::ALL,
        LeavingOut::None => LeaveOut::NONE,
    };
    let plan = case_file.planned_leaving_out(leave_out)?;
    let folder = arguments.out.clone().unwrap_or_else(|| Path::new("results").join(case_file.stem()));
    let wish = match (arguments.resume, arguments.force) {
        (true, _) => Wish::Resume,
        (false, true) => Wish::Force,
        (false, false) => Wish::Start,
    };
    let companion = arguments.estimate_error.then(|| companion(&plan)).transpose().map_err(|error| {
        Failure::Call(format!("--estimate-error: {error}"), "the same call without it".to_owned())
    })?;
    let standing = ResultFolder::standing(&folder, &case_file, &plan, wish)?;
    if companion.is_some() && matches!(standing, Standing::Solved(_)) {
        return Err(Failure::Call(
            format!("{}: solved already, and its fields are gone: no error bars", folder.display()),
            "with --force in place of --resume it is solved anew".to_owned(),
        ));
    }
    let threads = arguments.threads.map_or_else(available_threads, usize::from);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().map_err(|error| {
        Failure::Call(
            format!("{}: {error}", counted(threads, "thread")),
            "--threads with a smaller number".to_owned(),
        )
    })?;
    if !arguments.quiet && !matches!(standing, Standing::Solved(_)) {
        announce(&plan, &folder, &standing);
    }
    Ok(Preparation { case_file, plan, folder, standing, companion, threads, pool })
}

fn announce(plan: &Plan, folder: &Path, standing: &Standing) {
    if !plan.left_out.is_empty() {
        terminal::say(&left_out_in_short(plan));
    }
    for warning in plausibility::of_plan(plan) {
        terminal::say(&warning_line(&warning));
    }
    let shown = folder.display();
    match standing {
        Standing::Free | Standing::Unfinished | Standing::Solved(_) => {}
        Standing::SameCase => {
            terminal::say(&format!("{shown}: the earlier results of this case are replaced"));
            let made_since = ["report.html", "export.npz", "csv", "vtk", "stress"];
            let stays = |name: &&str| {
                folder.join(name).exists() && !(*name == "stress" && plan.case.stress.is_some())
            };
            let old: Vec<&str> = made_since.into_iter().filter(stays).collect();
            if !old.is_empty() {
                terminal::say(&format!("{shown}: still of the earlier run: {}", old.join(", ")));
            }
        }
        Standing::Forced => terminal::say(&format!("{shown}: written into as it is, by --force")),
    }
}

impl Preparation {
    fn begun(&self, quiet: bool) -> Result<Beginning, Failure> {
        let record = || RunRecord::new(&self.case_file, &self.plan, self.threads);
        if let Standing::Solved(record) = &self.standing {
            return Ok(Beginning::Nothing(record.clone()));
        }
        if self.standing == Standing::Unfinished
            && let Some(taken) = ResultFolder::reopen(&self.folder, &self.plan, record())?
        {
            let Stored { head, checkpoint } = taken.stored;
            if !quiet {
                if let Some(why) = &taken.passed_over {
                    terminal::say(&format!("an older checkpoint is taken: {why}"));
                }
                terminal::say(&format!(
                    "{}: {} of {} increments are solved; going on with increment {} (counted from 0)",
                    self.folder.display(),
                    checkpoint.solved(),
                    self.plan.increments,
                    checkpoint.solved()
                ));
            }
            let (tally, wall_s) = (head.tally, head.wall_s);
            let departure = Departure { folder: taken.folder, tally, from: checkpoint, wall_s };
            return Ok(Beginning::At(Box::new(departure)));
        }
        let folder = ResultFolder::open(&self.folder, &self.case_file, &self.plan, record())?;
        let (tally, from) = (Tally::new(&self.plan), Checkpoint::start(&self.plan));
        Ok(Beginning::At(Box::new(Departure { folder, tally, from, wall_s: 0.0 })))
    }

    /// Tells that the run was solved before; computes and writes nothing.
    fn solved_before(&self, record: &Value, quiet: bool, as_json: bool) -> Result<(), Failure> {
        let shown = self.folder.display().to_string();
        let message = format!("{shown}: solved already, nothing is left to do");
        if as_json {
            let answer = json!({
                "status": "solved",
                "message": message,
                "increments": record["totals"]["increments"],
                "totals": record["totals"],
                "results": shown,
            });
            terminal::answer(&format!("{answer:#}"))?;
        } else if !quiet {
            terminal::answer(&message)?;
        }
        Ok(())
    }

    fn solved(&self, departure: Departure, quiet: bool, as_json: bool) -> Result<(), Told> {
        let title = if self.plan.case.title.is_empty() {
            self.case_file.stem().display().to_string()
        } else {
            self.plan.case.title.clone()
        };
        let Departure { folder, tally, from, wall_s } = departure;
        let mut witness = Witness {
            folder,
            progress: Progress::new(quiet, &title, self.plan.increments, tally.solved),
            tally,
            clock: Clock { started: Instant::now(), before_s: wall_s },
            read_on: self.companion.as_ref().map(|_| self.plan.grid),
            failure: None,
        };
        let outcome = self.followed_by(from, &mut witness);
        let Witness { folder, progress, mut tally, clock, failure, .. } = witness;
        let outcome = outcome.map(|worn_through| tally.worn_through = worn_through);
        progress.end();
        let wall_s = clock.read();
        let failure = failure.or_else(|| outcome.err());
        let warnings = tally.gauge.warnings(&self.plan);
        let closed = folder.close((&tally, &warnings), wall_s, failure.as_ref());
        let failure = failure.or_else(|| closed.err().map(Failure::from));
        let (estimate, failure) = match failure {
            None => match self.estimated(&tally, quiet) {
                Ok(estimate) => (estimate, None),
                Err(unwritten) => (None, Some(unwritten.into())),
            },
            failure => (None, failure),
        };
        let summary = Summary {
            plan: &self.plan,
            tally: &tally,
            warnings: &warnings,
            folder: &self.folder,
            wall_s,
            threads: self.threads,
            estimate: estimate.as_ref(),
        };
        if as_json {
            terminal::answer(&format!("{:#}", summary.to_json(failure.as_ref())))?;
        } else if failure.is_none() && !quiet {
            terminal::answer(&summary.table())?;
        }
        if matches!(failure, Some(Failure::Unwritten(_))) && tally.solved > 0 {
            terminal::say(&format!("{}; once it can be written, --resume goes on", self.kept(&tally)));
        }
        let failure = failure.or_else(|| {
            self.plan.case.stress.as_ref()?;
            self.pool.install(|| after_run(&self.folder, quiet || as_json)).err()
        });
        failure.map_or(Ok(()), |failure| Err(Told { failure, in_json: as_json }))
    }

    /// Error bars, when they are asked for and can be had; also as a file beside the results.
    fn estimated(&self, tally: &Tally, quiet: bool) -> Result<Option<Estimate>, Unwritten> {
        let Some(companion) = &self.companion else { return Ok(None) };
        match self.pool.install(|| Estimate::new(&self.plan, companion, &tally.headlines)) {
            Ok(estimate) => {
                let name = |stage: usize| self.plan.case.stages[stage].name.clone();
                let text = format!("{:#}\n", estimate.to_json(name));
                write_whole(&self.folder.join(ERROR_BARS), text.as_bytes())?;
                Ok(Some(estimate))
            }
            Err(why) => {
                if !quiet {
                    terminal::say(&format!("no error bars: {why}"));
                }
                Ok(None)
            }
        }
    }

    fn followed_by(&self, from: Checkpoint, witness: &mut Witness) -> Result<Option<WornThrough>, Failure> {
        let journey =
            || Simulation::new(&self.plan).resume(from, witness).map(|history| history.worn_through);
        match catch_unwind(AssertUnwindSafe(|| self.pool.install(journey))) {
            Ok(Ok(worn_through)) => Ok(worn_through),
            Ok(Err(RunError::Interrupted { .. })) => {
                let kept = self.kept(&witness.tally);
                Err(Failure::Interrupted(format!("{kept}; --resume goes on from there")))
            }
            Ok(Err(error)) => Err(Failure::Unsolved(error)),
            Err(panic) => Err(Failure::Defect(defect::words_of(panic.as_ref()))),
        }
    }

    fn kept(&self, tally: &Tally) -> String {
        let (solved, all) = (tally.solved, self.plan.increments);
        format!("{solved} of {all} increments are solved and kept in {}", self.folder.display())
    }
}

/// Time of the whole run, that before it was broken off included.
struct Clock {
    started: Instant,
    before_s: f64,
}

impl Clock {
    fn read(&self) -> f64 {
        self.before_s + self.started.elapsed().as_secs_f64()
    }
}

/// Hears about the run: counts it, shows it, writes it down, and stops it when asked to or when it cannot be written down.
struct Witness {
    folder: ResultFolder,
    progress: Progress,
    tally: Tally,
    clock: Clock,
    /// The grid, when headline numbers are read.
    read_on: Option<SurfaceGrid>,
    failure: Option<Failure>,
}

impl Witness {
    /// Goes on after a good writing; remembers why after a bad one.
    fn after<E: Into<Failure>>(&mut self, writing: Result<(), E>) -> ControlFlow<()> {
        match writing {
            Ok(()) => ControlFlow::Continue(()),
            Err(error) => {
                self.failure = Some(error.into());
                ControlFlow::Break(())
            }
        }
    }
}

impl Observer for Witness {
    fn iterated(&mut self, iteration: &Iteration) -> ControlFlow<()> {
        self.progress.iterated(iteration, &self.tally);
        go_on()
    }

    fn solved(
        &mut self,
        record: &StepRecord,
        state: &ContactState,
        kept: Option<&KeptFields>,
    ) -> ControlFlow<()> {
        let writing = self.folder.keep(record, kept);
        self.after(writing)?;
        self.tally.add(record);
        if let Some(grid) = &self.read_on {
            self.tally.read(Headline::new(grid, record, state));
        }
        self.progress.solved(record, &self.tally);
        go_on()
    }

    fn cycled(&mut self, record: &CycleRecord) {
        if self.failure.is_none() {
            self.failure = self.folder.keep_cycle(record).err().map(Failure::from);
            self.tally.add_cycle(record);
        }
    }

    fn reached(&mut self, waypoint: &Waypoint<'_>) -> ControlFlow<()> {
        if self.failure.is_some() {
            return ControlFlow::Break(());
        }
        let writing = self.folder.reached(waypoint, &self.tally, self.clock.read());
        self.after(writing)
    }
}

fn go_on() -> ControlFlow<()> {
    if interrupt::is_asked() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
}
