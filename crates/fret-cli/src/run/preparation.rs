//! What is judged before a run: the case, its plan, the folder, memory. Nothing is written yet.

use std::cell::Cell;
use std::path::{Path, PathBuf};

use fret_core::machine::memory::{self, Claim};
use fret_core::plan::{LeaveOut, Plan};
use fret_core::run::plausibility;
use fret_core::study::companion;

use crate::arguments::{LeavingOut, RunArguments};
use crate::failure::Failure;
use crate::manner::Manner;
use crate::plan_words::{left_out_in_short, warning_line};
use crate::threads;
use fret_results::{CaseFile, HEAT, Origin, ResultFolder, SCAR, STRESS, Standing, Wish, resolved_path};

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
    /// How much is told.
    pub manner: Manner,
}

impl Wanted {
    /// What the arguments of the command ask for.
    pub fn by(arguments: &RunArguments) -> Result<Self, Failure> {
        let case_file = CaseFile::asked(&arguments.case)?;
        let folder =
            arguments.manner.out.clone().unwrap_or_else(|| Path::new("results").join(case_file.stem()));
        Ok(Self {
            folder,
            case_file,
            origin: arguments.from.as_deref().map(Origin::read).transpose()?,
            wish: Wish::of(arguments.resume, arguments.force),
            leave_out: match arguments.leave_out {
                LeavingOut::All => LeaveOut::ALL,
                LeavingOut::None => LeaveOut::NONE,
            },
            estimate_error: arguments.estimate_error,
            threads: arguments.threads.number,
            manner: arguments.manner.clone(),
        })
    }

    /// Judges everything; writes nothing.
    pub fn prepared(self) -> Result<Preparation, Failure> {
        let Self { case_file, folder, origin, wish, manner, .. } = self;
        let folder = resolved_path(&folder);
        let earlier = if origin.is_none() && wish == Wish::Resume { Origin::below(&folder)? } else { None };
        let plan = case_file.planned_leaving_out(
            self.leave_out,
            origin.as_ref().or(earlier.as_ref()).map(|origin| &origin.start),
        )?;
        if let Some(Origin { results, .. }) = &origin
            && is_same_folder(&folder, Path::new(results))
        {
            return Err(Failure::call(
                format!("{}: the run would replace the results it starts from", folder.display()),
                "choose another folder with --out DIR",
            ));
        }
        let companion = self.estimate_error.then(|| companion(&plan)).transpose().map_err(|error| {
            Failure::call(format!("--estimate-error: {error}"), "the same command without it")
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
        if !matches!(standing, Standing::Solved(_)) {
            announce(&manner, &plan, &folder, &standing);
            if let Some(Origin { results, increment, .. }) = &origin {
                manner.say(&format!("starts from {results}, end of increment {increment} (counted from 0)"));
            }
        }
        Ok(Preparation { case_file, plan, origin, folder, standing, companion, threads, pool, claim, manner })
    }
}

/// Everything judged; nothing written yet.
pub struct Preparation {
    pub case_file: CaseFile,
    pub plan: Plan,
    /// Where the run starts, when the call names a state.
    pub origin: Option<Origin>,
    pub folder: PathBuf,
    pub standing: Standing,
    /// The coarser run that error bars are read from, when they are asked for.
    pub companion: Option<Plan>,
    pub threads: usize,
    pub pool: rayon::ThreadPool,
    /// Memory for the run.
    pub claim: Cell<Option<Claim>>,
    /// How much is told.
    pub manner: Manner,
}

fn is_same_folder(one: &Path, other: &Path) -> bool {
    one.canonicalize().is_ok_and(|one| other.canonicalize().is_ok_and(|other| one == other))
}

fn announce(manner: &Manner, plan: &Plan, folder: &Path, standing: &Standing) {
    if !plan.left_out.is_empty() {
        manner.say(&left_out_in_short(plan));
    }
    for warning in plausibility::of_plan(plan) {
        manner.say(&warning_line(&warning));
    }
    let shown = folder.display();
    match standing {
        Standing::Free | Standing::Unfinished | Standing::Solved(_) => {}
        Standing::SameCase => {
            let answers = [STRESS, HEAT, SCAR].map(|[name, record]| (name, folder.join(name).join(record)));
            let gone: Vec<&str> =
                answers.iter().filter(|(_, record)| record.exists()).map(|(name, _)| *name).collect();
            let with =
                if gone.is_empty() { String::new() } else { format!(", and their {}", gone.join(", ")) };
            manner.say(&format!("{shown}: the earlier results of this case are replaced{with}"));
            let made_since = ["report.html", "export.npz", "csv", "vtk"];
            let old: Vec<&str> = made_since.into_iter().filter(|name| folder.join(name).exists()).collect();
            if !old.is_empty() {
                manner.say(&format!("{shown}: still of the earlier run: {}", old.join(", ")));
            }
        }
        Standing::Forced => manner.say(&format!("{shown}: existing folder used, by --force")),
    }
}
