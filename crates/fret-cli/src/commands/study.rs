//! `fret study`: one case at many resolutions, how far each is from the reference and what it costs.

use std::path::Path;

use fret_core::machine::memory;
use fret_core::plan::Plan;
use fret_core::run::Observer;
use fret_core::study::{
    ClosedForm, Level, Line, Place, Quantity, Reference, RefinementStudy, Resolutions, VariationError,
    pressure_is_unbounded, solved_level,
};
use serde_json::json;

use crate::arguments::{StudyArguments, StudyRequest};
use crate::defect;
use crate::failure::Failure;
use crate::figures::{counted, duration};
use crate::interrupt;
use crate::manner::Listener;
use crate::report::study::STUDY;
use crate::study::levels::{LEVELS, Levels};
use crate::study::record::StudyRecord;
use crate::study::table::ErrorColumn;
use crate::study::{picture, reference, table, words};
use crate::terminal::Answer;
use fret_results::{CaseFile, folder_for_answers};

/// Accuracies a choice is told for.
const ACCURACIES: [f64; 3] = [1e-2, 1e-3, 1e-4];
/// Levels quicker than this are timed again [s], the least of a few times counts.
const QUICK: f64 = 0.3;
/// Times a quick level is timed at the most.
const TIMES: usize = 3;

/// Studies a case.
pub fn study(arguments: &StudyArguments) -> Result<Answer, Failure> {
    let case_file = CaseFile::asked(&arguments.case)?;
    let plan = case_file.planned()?;
    let question = Question::new(&arguments.request, &plan)?;
    let pool = arguments.threads.pool()?;
    let folder = arguments.manner.out.clone().unwrap_or_else(|| {
        let mut name = case_file.stem().into_os_string();
        name.push("-study");
        Path::new("results").join(name)
    });
    let folder = folder_for_answers(&folder, &[STUDY, LEVELS], "a study")?;
    interrupt::listen();
    let kept = Levels::below(&folder)?;
    let manner = &arguments.manner;
    let say = |text: &str| manner.say(text);
    let title = case_file.title(&plan.case);
    let studied = pool
        .install(|| studied((&title, &plan), question, Some(&kept), &say, &mut Listener::telling(manner)))?;
    let Studied { record, study, lines, measured } = &studied;
    manner.write(&folder.join("study.csv"), table::csv(&record.lines).as_bytes())?;
    manner.write(
        &folder.join("study.svg"),
        picture::picture(&title, plan.case.dimension(), study, lines).as_bytes(),
    )?;
    let answer = json!(record);
    manner.write_json(&folder.join(STUDY), &answer)?;
    kept.remove();
    let text = format!(
        "{title}\n{measured}\n\n{}\n\n{}\n\nresults    {}",
        table::table(record),
        record.choice,
        folder.display()
    );
    Ok(Answer::new(answer, text))
}

/// What is to be studied: resolutions that fit into memory, and what they are compared with.
pub struct Question {
    resolutions: Resolutions,
    against: Against,
}

impl Question {
    /// What the words of a call ask about a plan.
    pub fn new(request: &StudyRequest, plan: &Plan) -> Result<Self, Failure> {
        let resolutions = resolutions(request, plan)?;
        let against = Against::new(request.against.as_deref(), plan)?;
        fits_memory(&resolutions, plan)?;
        Ok(Self { resolutions, against })
    }
}

/// A study with its answer.
pub struct Studied {
    /// All of it.
    pub record: StudyRecord,
    study: RefinementStudy,
    lines: Vec<Line>,
    /// What its errors are measured by, in words.
    measured: String,
}

/// Solves the levels of a study and compares them; finished levels are taken from `kept` and left there.
pub fn studied(
    (title, plan): (&str, &Plan),
    question: Question,
    kept: Option<&Levels>,
    say: &(dyn Fn(&str) + Sync),
    observer: &mut dyn Observer,
) -> Result<Studied, Failure> {
    let Question { resolutions, against } = question;
    let (study, unsolved) = all_levels(plan, resolutions, kept, say, observer)?;
    let is_given = matches!(against, Against::Given(_));
    let mut reference = against.reference(&study).ok_or_else(|| {
        Failure::Defect("a solved study has no finest level".to_owned()) // `all_levels` fails without it
    })?;
    let finest = study.resolutions().cells.last().copied().unwrap_or(plan.case.cells);
    if pressure_is_unbounded(&plan.case, finest) && !is_given {
        reference = reference.without_limit(Quantity::MaxPressure);
    }
    let lines = study.judged_while(&reference, || !interrupt::is_asked()).ok_or_else(|| {
        let kept = "all levels of the study are solved and kept; the same command compares them";
        Failure::Interrupted(kept.to_owned())
    })?;
    let advice = ACCURACIES.map(|accuracy| study.advice(&reference, accuracy));
    let dimension = plan.case.dimension();
    let choice = words::choice(
        &advice,
        &reference,
        study.resolutions(),
        (dimension, plan.case.cells[1] as f64 / plan.case.cells[0] as f64),
    );
    let record = StudyRecord::new(title, &reference, (&study, &lines), (&advice, &choice), &unsolved);
    let known = ErrorColumn::known(&record.lines);
    let shown = |quantity| known.iter().any(|column| column.is_of(quantity));
    let said = [words::measured_by, words::without_order].map(|of| of(&reference, &shown, dimension));
    let measured =
        if known.is_empty() { words::NO_ERRORS.to_owned() } else { said.join("\n").trim_end().to_owned() };
    let of_the_way = words::first_after_steady(&plan.case.stages)
        .map(|stage| words::of_the_way(&plan.case.stages[stage].name, "are not compared"));
    let measured = [measured].into_iter().chain(of_the_way).collect::<Vec<_>>().join("\n");
    Ok(Studied { record, study, lines, measured })
}

fn resolutions(request: &StudyRequest, plan: &Plan) -> Result<Resolutions, Failure> {
    let StudyRequest { cells, increments, tolerances, .. } = request;
    if cells.is_empty() && increments.is_empty() && tolerances.is_empty() {
        return Ok(Resolutions::halving(plan));
    }
    Resolutions::new(plan, cells, increments, tolerances)
        .map_err(|error| Failure::call(error.to_string(), "fret study --help"))
}

/// Refuses a study whose finest level the machine has not the memory for.
fn fits_memory(resolutions: &Resolutions, plan: &Plan) -> Result<(), Failure> {
    let finest = resolutions.at(resolutions.finest());
    let too_many = |error: &dyn std::fmt::Display| {
        let cells = plan.grid.dimension().written(finest.cells);
        let message = format!("--cells {}: a grid of {cells} cells {error}", finest.cells[0]);
        Failure::call(message, "--cells with smaller numbers")
    };
    let planned = finest.planned(plan).map_err(|error| too_many(&error))?;
    memory::check(planned.memory_bytes).map_err(|error| too_many(&error))
}

/// What the study is compared with.
enum Against {
    /// A closed form where there is one, the limit of the study elsewhere.
    Best(Option<ClosedForm>),
    /// A closed form alone.
    Analytic(ClosedForm),
    /// The finest level.
    Finest,
    /// Numbers from a file.
    Given(Box<Reference>),
}

impl Against {
    fn new(asked: Option<&str>, plan: &Plan) -> Result<Self, Failure> {
        match asked {
            None => Ok(Self::Best(ClosedForm::of(plan))),
            Some("finest") => Ok(Self::Finest),
            Some("analytic") => ClosedForm::of(plan).map(Self::Analytic).ok_or_else(|| {
                Failure::call(
                    "--against analytic: no closed form is available for this case",
                    "without --against Richardson extrapolation is used; --against finest compares with the finest level",
                )
            }),
            Some(file) => {
                let reference = reference::reference(Path::new(file), plan.case.stages.len())?;
                Ok(Self::Given(Box::new(reference)))
            }
        }
    }

    fn reference(self, study: &RefinementStudy) -> Option<Reference> {
        match self {
            Self::Best(form) => {
                let limit = study.limit()?;
                Some(match form {
                    Some(form) => Reference::closed(form).or(limit),
                    None => limit,
                })
            }
            Self::Analytic(form) => Some(Reference::closed(form)),
            Self::Finest => study.finest().map(Reference::finest),
            Self::Given(reference) => Some(*reference),
        }
    }
}

/// Why a level has no answer, by its place.
type Unsolved = Vec<(Place, String)>;

/// Solves all levels; those that cannot be solved are told and left out, but for the finest.
fn all_levels(
    plan: &Plan,
    resolutions: Resolutions,
    kept: Option<&Levels>,
    say: &dyn Fn(&str),
    observer: &mut dyn Observer,
) -> Result<(RefinementStudy, Unsolved), Failure> {
    let places = resolutions.places();
    let mut levels = Vec::new();
    let mut unsolved = Vec::new();
    for (number, place) in places.iter().enumerate() {
        let variation = resolutions.at(*place);
        let cells = plan.case.dimension().written(variation.cells);
        let head = format!(
            "level {}/{}  {cells} cells, {}, tolerance {:.0e}",
            number + 1,
            places.len(),
            counted(variation.increments.iter().sum(), "increment"),
            variation.tolerance
        );
        let varied = match variation.planned(plan) {
            Ok(varied) => varied,
            Err(VariationError::PartsOfCells(why)) if *place != resolutions.finest() => {
                say(&format!("{head}: skipped, {why}"));
                unsolved.push((*place, why));
                continue;
            }
            Err(error) => return Err(Failure::call(format!("{cells} cells: {error}"), "fret study --help")),
        };
        if let Some(level) = kept.and_then(|kept| kept.finished(&varied)) {
            say(&format!("{head}: {}, solved before", duration(level.wall_s)));
            levels.push((*place, level));
            continue;
        }
        say(&head);
        match timed(&varied, observer) {
            Ok(level) => {
                if let Some(kept) = kept {
                    kept.keep(&varied, &level)?;
                }
                levels.push((*place, level));
            }
            Err(failure @ Failure::Unsolved(_)) if *place != resolutions.finest() => {
                say(&format!("{head}: skipped, {}", failure.message()));
                unsolved.push((*place, failure.message()));
            }
            Err(Failure::Interrupted(_)) => {
                return Err(Failure::Interrupted(format!(
                    "{} of {} levels of the study are solved and kept; the same command continues with the others",
                    levels.len(),
                    places.len()
                )));
            }
            Err(failure) => return Err(failure),
        }
    }
    Ok((RefinementStudy::new(resolutions, levels), unsolved))
}

/// A level, solved a few times where that is quick, with the least of its times; the observer hears of the first.
fn timed(plan: &Plan, observer: &mut dyn Observer) -> Result<Level, Failure> {
    let once = |observer: &mut dyn Observer| -> Result<Level, Failure> {
        defect::caught(|| Ok(solved_level(plan, observer)?))
    };
    let mut best = once(observer)?;
    for _ in 1..TIMES {
        if best.wall_s < QUICK {
            best.wall_s = best.wall_s.min(once(&mut Listener::silent())?.wall_s);
        }
    }
    Ok(best)
}
