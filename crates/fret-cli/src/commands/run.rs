//! `fret run`: from a case file to a folder of results, with a face for the time between.

use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::time::Instant;

use fret_core::history::Warning;
use fret_core::history::{WornByLayer, WornThrough};
use fret_core::machine::memory::{self, Claim};
use fret_core::plan::{LeaveOut, Plan};
use fret_core::run::{Checkpoint, Observer, RunError, Simulation, plausibility};
use fret_core::study::{StageQuantities, companion};
use serde_json::{Value, json};

use super::run_observer::{Clock, RunObserver};
use crate::arguments::{LeavingOut, RunArguments};
use crate::case_file::CaseFile;
use crate::commands::plan::left_out_in_short;
use crate::commands::{heat, stress};
use crate::defect;
use crate::estimate::{Estimate, NoBars};
use crate::failure::{Failure, Told};
use crate::interrupt::{self, Listener};
use crate::origin::Origin;
use crate::output::{ERROR_BARS, Ending, ResultFolder, RunRecord, Standing, Stored, Wish, write_whole};
use crate::progress::Progress;
use crate::summary::{Summary, warning_line};
use crate::tally::Tally;
use crate::terminal;
use crate::threads;

/// Solves a case.
pub fn run(arguments: &RunArguments, as_json: bool) -> Result<(), Told> {
    let begun = Wanted::by(arguments).and_then(Wanted::prepared).and_then(|preparation| {
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
    /// Where the run starts, when the call names a state.
    origin: Option<Origin>,
    folder: PathBuf,
    standing: Standing,
    /// The coarser run that error bars are read from, when they are asked for.
    companion: Option<Plan>,
    threads: usize,
    pool: rayon::ThreadPool,
    /// Memory for the run.
    claim: Cell<Option<Claim>>,
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

/// What is to be run, and where to.
pub struct Wanted {
    /// The case.
    pub case_file: CaseFile,
    /// Folder of the results.
    pub folder: PathBuf,
    /// Where it starts, when the call names a state.
    pub origin: Option<Origin>,
    /// What to do with what is in the folder.
    pub wish: Wish,
    /// Which automatic simplifications to use.
    pub leave_out: LeaveOut,
    /// Whether error bars are asked for.
    pub estimate_error: bool,
    /// Number of threads; all cores without.
    pub threads: Option<u16>,
    /// Whether nothing but errors is told.
    pub quiet: bool,
}

impl Wanted {
    fn by(arguments: &RunArguments) -> Result<Self, Failure> {
        let case_file = CaseFile::read(&arguments.case)?;
        let folder = arguments.out.clone().unwrap_or_else(|| Path::new("results").join(case_file.stem()));
        Ok(Self {
            folder,
            case_file,
            origin: arguments.from.as_deref().map(Origin::read).transpose()?,
            wish: match (arguments.resume, arguments.force) {
                (true, _) => Wish::Resume,
                (false, true) => Wish::Force,
                (false, false) => Wish::Start,
            },
            leave_out: match arguments.leave_out {
                LeavingOut::All => LeaveOut::ALL,
                LeavingOut::None => LeaveOut::NONE,
            },
            estimate_error: arguments.estimate_error,
            threads: arguments.threads,
            quiet: arguments.quiet,
        })
    }

    /// Judges everything; writes nothing.
    fn prepared(self) -> Result<Preparation, Failure> {
        let Self { case_file, folder, origin, wish, quiet, .. } = self;
        let earlier = if origin.is_none() && wish == Wish::Resume { Origin::below(&folder)? } else { None };
        let plan = case_file.planned_leaving_out(self.leave_out, origin.as_ref().or(earlier.as_ref()))?;
        if let Some(Origin { results, .. }) = &origin
            && is_same_folder(&folder, Path::new(results))
        {
            return Err(Failure::Call(
                format!("{}: the run would replace the results it starts from", folder.display()),
                "choose another folder with --out DIR".to_owned(),
            ));
        }
        let companion = self.estimate_error.then(|| companion(&plan)).transpose().map_err(|error| {
            Failure::Call(format!("--estimate-error: {error}"), "the same command without it".to_owned())
        })?;
        let standing = ResultFolder::standing(&folder, &case_file, &plan, wish)?;
        let threads = threads::asked(self.threads);
        let pool = threads::pool(threads)?;
        // Once for all: what the run maps on its way would make a second look find less.
        let needed = plan.memory_bytes.max(companion.as_ref().map_or(0, |plan| plan.memory_bytes));
        let claim = Cell::new(match standing {
            Standing::Solved(_) => None,
            _ => Some(pool.install(|| memory::claim(needed))?),
        });
        if !quiet && !matches!(standing, Standing::Solved(_)) {
            announce(&plan, &folder, &standing);
            if let Some(Origin { results, increment, .. }) = &origin {
                terminal::say(&format!(
                    "starts from {results}, end of increment {increment} (counted from 0)"
                ));
            }
        }
        Ok(Preparation { case_file, plan, origin, folder, standing, companion, threads, pool, claim })
    }
}

/// Runs a case into a folder and tells nothing; `guest` hears of every increment and may stop the run.
///
/// # Errors
/// What ended the run early; what was solved is in the folder.
pub fn run_into(wanted: Wanted, guest: &mut Guest<'_>) -> Result<(), Failure> {
    let preparation = Wanted { quiet: true, ..wanted }.prepared()?;
    match preparation.begun(true)? {
        Beginning::Nothing(record) => {
            let quantities = quantities_of(&record);
            preparation.estimated(&quantities, true, guest).map(|_| ())
        }
        Beginning::At(departure) => {
            let failure = preparation.followed(*departure, true, guest).failure;
            failure.or_else(|| preparation.stresses(true).err()).map_or(Ok(()), Err)
        }
    }
}

/// Quantities of interest as a record holds them.
fn quantities_of(record: &Value) -> Vec<StageQuantities> {
    serde_json::from_value(record["quantities_of_interest"].clone()).unwrap_or_default()
}

fn is_same_folder(one: &Path, other: &Path) -> bool {
    one.canonicalize().is_ok_and(|one| other.canonicalize().is_ok_and(|other| one == other))
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
        Standing::Forced => terminal::say(&format!("{shown}: existing folder used, by --force")),
    }
}

impl Preparation {
    fn begun(&self, quiet: bool) -> Result<Beginning, Failure> {
        let record = || RunRecord::new(&self.case_file, &self.plan, self.threads, self.origin.as_ref());
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
                if let Some(why) = &taken.ended {
                    terminal::say(&format!("it failed before, and may fail again: {why}"));
                }
                terminal::say(&format!(
                    "{}: {}; continuing with increment {} (counted from 0)",
                    self.folder.display(),
                    head.tally.standing(),
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

    /// Tells that the run was solved before. Only what error bars need besides is computed, when they are asked for.
    fn solved_before(&self, record: &Value, quiet: bool, as_json: bool) -> Result<(), Failure> {
        let shown = self.folder.display().to_string();
        let estimate = self.estimated(&quantities_of(record), quiet, &mut Listener)?;
        let done =
            if estimate.is_some() { "its error bars are computed now" } else { "nothing is left to do" };
        let message = format!("{shown}: solved already, {done}");
        if as_json {
            let answer = json!({
                "status": "solved",
                "message": message,
                "increments": record["totals"]["increments"],
                "totals": record["totals"],
                "results": shown,
                "error_bars": estimate.map(|estimate| estimate.to_json(|stage| self.stage_name(stage))),
            });
            terminal::answer(&format!("{answer:#}"))?;
        } else if !quiet {
            let bars = estimate.map(|estimate| estimate.table(|stage| self.stage_name(stage)) + "\n\n");
            terminal::answer(&(bars.unwrap_or_default() + &message))?;
        }
        Ok(())
    }

    /// Solves what is to be solved, and writes everything down.
    fn followed(&self, departure: Departure, quiet: bool, guest: &mut Guest<'_>) -> Ended {
        let Departure { folder, tally, from, wall_s } = departure;
        let mut observer = RunObserver {
            folder,
            progress: Progress::new(quiet, &self.title(), &tally),
            tally,
            clock: Clock { started: Instant::now(), before_s: wall_s },
            grid: self.plan.grid,
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
        let closed = folder.close((&tally, &warnings), wall_s, failure.as_ref().map(Ending::of).as_ref());
        let failure = failure.or_else(|| closed.err().map(Failure::from));
        let (estimate, failure) = match failure {
            None => match self.estimated(&tally.stage_quantities, quiet, guest) {
                Ok(estimate) => (estimate, None),
                Err(failure) => (None, Some(failure)),
            },
            failure => (None, failure),
        };
        Ended { tally, warnings, wall_s, estimate, failure }
    }

    fn title(&self) -> String {
        if self.plan.case.title.is_empty() {
            self.case_file.stem().display().to_string()
        } else {
            self.plan.case.title.clone()
        }
    }

    /// Stresses, temperatures and contact resistances, where the case asks for them.
    fn stresses(&self, quiet: bool) -> Result<(), Failure> {
        let (case, folder) = (&self.plan.case, &self.folder);
        if case.stress.is_some() {
            self.pool.install(|| stress::after_run(folder, quiet))?;
        }
        if !case.conduction.is_none() {
            self.pool.install(|| heat::after_run(folder, quiet))?;
        }
        Ok(())
    }

    fn solved(&self, departure: Departure, quiet: bool, as_json: bool) -> Result<(), Told> {
        let Ended { tally, warnings, wall_s, estimate, failure } =
            self.followed(departure, quiet, &mut Listener);
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
        match &failure {
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
        let failure = failure.or_else(|| self.stresses(quiet || as_json).err());
        failure.map_or(Ok(()), |failure| Err(Told { failure, in_json: as_json }))
    }

    /// Error bars, when they are asked for and can be had; also as a file beside the results.
    fn estimated(
        &self,
        stage_quantities: &[StageQuantities],
        quiet: bool,
        guest: &mut Guest<'_>,
    ) -> Result<Option<Estimate>, Failure> {
        let Some(companion) = &self.companion else { return Ok(None) };
        let plan = &self.plan;
        match self.pool.install(|| Estimate::new(plan, companion, stage_quantities, guest)) {
            Ok(estimate) => {
                let text = format!("{:#}\n", estimate.to_json(|stage| self.stage_name(stage)));
                write_whole(&self.folder.join(ERROR_BARS), text.as_bytes())?;
                Ok(Some(estimate))
            }
            Err(NoBars::Interrupted) => Err(Failure::Interrupted(format!(
                "the case is solved and kept in {}, its error bars are not; --resume --estimate-error continues with them",
                self.folder.display()
            ))),
            Err(NoBars::Because(why)) => {
                if !quiet {
                    terminal::say(&format!("no error bars: {why}"));
                }
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
        match catch_unwind(AssertUnwindSafe(|| self.pool.install(journey))) {
            Ok(Ok(worn)) => Ok(worn),
            Ok(Err(RunError::Interrupted { .. })) => {
                let kept = self.kept(&observer.tally);
                Err(Failure::Interrupted(format!("{kept}; --resume continues from there")))
            }
            Ok(Err(error)) => Err(Failure::Unsolved(error)),
            Err(panic) => Err(Failure::Defect(defect::words_of(panic.as_ref()))),
        }
    }

    fn stage_name(&self, stage: usize) -> String {
        self.plan.case.stages[stage].name.clone()
    }

    fn kept(&self, tally: &Tally) -> String {
        format!("{} and kept in {}", tally.standing(), self.folder.display())
    }
}

/// Somebody else who hears about a run, and may stop it.
pub type Guest<'a> = dyn Observer + Send + 'a;

/// How a run ended.
struct Ended {
    tally: Tally,
    warnings: Vec<Warning>,
    /// Time of the whole run [s].
    wall_s: f64,
    estimate: Option<Estimate>,
    /// Why early, if it did.
    failure: Option<Failure>,
}
