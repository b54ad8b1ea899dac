//! `fret study`: one case at many resolutions, how far each is from the truth and what it costs.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

use fret_core::machine::memory;
use fret_core::plan::Plan;
use fret_core::run::RunError;
use fret_core::study::{Advice, Climb, ClosedForm, Kind, Ladder, Line, Place, Rung, Truth, climbed};
use serde_json::{Value, json};

use crate::arguments::StudyArguments;
use crate::case_file::CaseFile;
use crate::defect;
use crate::failure::{Failure, Unwritten};
use crate::figures::{counted, duration};
use crate::interrupt::{self, Listener};
use crate::output::write_whole;
use crate::study::levels::Levels;
use crate::study::{picture, reference, table, words};
use crate::terminal;
use crate::threads;

/// Accuracies a choice is told for.
const ACCURACIES: [f64; 3] = [1e-2, 1e-3, 1e-4];
/// Rungs quicker than this are timed again [s], the least of a few times counts.
const QUICK: f64 = 0.3;
/// Times a quick rung is timed at the most.
const TIMES: usize = 3;

/// Studies a case.
pub fn study(arguments: &StudyArguments, as_json: bool) -> Result<(), Failure> {
    let case_file = CaseFile::read(&arguments.case)?;
    let plan = case_file.planned()?;
    let ladder = ladder(arguments, &plan)?;
    let against = Against::new(arguments.against.as_deref(), &plan)?;
    let pool = threads::pool(threads::asked(arguments.threads))?;
    fits_memory(&ladder, &plan)?;
    let folder = arguments.out.clone().unwrap_or_else(|| {
        let mut name = case_file.stem().into_os_string();
        name.push("-study");
        Path::new("results").join(name)
    });
    std::fs::create_dir_all(&folder).map_err(Unwritten::at(&folder))?;
    interrupt::listen();
    let levels = Levels::below(&folder)?;
    let (climb, unsolved) = pool.install(|| climb(&plan, ladder, &levels, arguments.quiet))?;
    let truth = against.truth(&climb).ok_or_else(|| {
        Failure::Defect("a solved study has no finest level".to_owned()) // `climb` fails without it
    })?;
    let lines = climb.judged(&truth);
    let advice = ACCURACIES.map(|accuracy| climb.advice(&truth, accuracy));
    let choice = words::choice(
        &advice,
        climb.ladder().cells.len() > 1,
        climb.ladder().increments.len() > 1,
        plan.case.cells[1] as f64 / plan.case.cells[0] as f64,
    );
    let title = if plan.case.title.is_empty() {
        case_file.stem().display().to_string()
    } else {
        plan.case.title.clone()
    };
    let measured =
        if table::shows_errors(&lines) { words::measured_by(&truth) } else { words::NO_ERRORS.to_owned() };
    let answer = answer(&title, &truth, (&climb, &lines), (&advice, &choice), &unsolved);
    let text = format!("{answer:#}");
    write_whole(&folder.join("study.csv"), table::csv(&climb, &lines).as_bytes())?;
    write_whole(&folder.join("study.svg"), picture::picture(&title, &climb, &lines).as_bytes())?;
    write_whole(&folder.join("study.json"), format!("{text}\n").as_bytes())?;
    levels.remove();
    if as_json {
        return terminal::answer(&text);
    }
    terminal::answer(&format!(
        "{title}\n{measured}\n\n{}\n\n{choice}\n\nresults    {}",
        table::table(&climb, &lines),
        folder.display()
    ))
}

fn ladder(arguments: &StudyArguments, plan: &Plan) -> Result<Ladder, Failure> {
    let StudyArguments { cells, increments, tolerances, .. } = arguments;
    if cells.is_empty() && increments.is_empty() && tolerances.is_empty() {
        return Ok(Ladder::halving(plan));
    }
    Ladder::new(plan, cells, increments, tolerances)
        .map_err(|error| Failure::Call(error.to_string(), "fret study --help".to_owned()))
}

/// Refuses a ladder whose finest rung the machine has not the memory for.
fn fits_memory(ladder: &Ladder, plan: &Plan) -> Result<(), Failure> {
    let finest = ladder.at(ladder.finest());
    let [nx, ny] = finest.cells;
    let too_many = |error: &dyn std::fmt::Display| {
        let message = format!("--cells {nx}: a grid of {nx} x {ny} cells {error}");
        Failure::Call(message, "--cells with smaller numbers".to_owned())
    };
    let planned = finest.planned(plan).map_err(|error| too_many(&error))?;
    memory::check(planned.memory_bytes).map_err(|error| too_many(&error))
}

/// What the study is compared with.
enum Against {
    /// A closed form where there is one, the limit of the ladder elsewhere.
    Best(Option<ClosedForm>),
    /// A closed form alone.
    Analytic(ClosedForm),
    /// The finest rung.
    Finest,
    /// Numbers from a file.
    Given(Box<Truth>),
}

impl Against {
    fn new(asked: Option<&str>, plan: &Plan) -> Result<Self, Failure> {
        match asked {
            None => Ok(Self::Best(ClosedForm::of(plan))),
            Some("finest") => Ok(Self::Finest),
            Some("analytic") => ClosedForm::of(plan).map(Self::Analytic).ok_or_else(|| {
                Failure::Call(
                    "--against analytic: no closed form is available for this case".to_owned(),
                    "without --against Richardson extrapolation is used; --against finest compares with the finest level"
                        .to_owned(),
                )
            }),
            Some(file) => {
                let truth = reference::reference(Path::new(file), plan.case.stages.len())?;
                Ok(Self::Given(Box::new(truth)))
            }
        }
    }

    fn truth(self, climb: &Climb) -> Option<Truth> {
        match self {
            Self::Best(form) => {
                let limit = climb.limit()?;
                Some(match form {
                    Some(form) => Truth::closed(form).or(limit),
                    None => limit,
                })
            }
            Self::Analytic(form) => Some(Truth::closed(form)),
            Self::Finest => climb.finest().map(Truth::finest),
            Self::Given(truth) => Some(*truth),
        }
    }
}

/// Why a rung has no answer, by its place.
type Unsolved = Vec<(Place, String)>;

/// Solves all rungs; those that cannot be solved are told and left out, but for the finest.
fn climb(plan: &Plan, ladder: Ladder, levels: &Levels, quiet: bool) -> Result<(Climb, Unsolved), Failure> {
    let places = ladder.places();
    let say = |text: &str| {
        if !quiet {
            terminal::say(text);
        }
    };
    let mut rungs = Vec::new();
    let mut unsolved = Vec::new();
    for (number, place) in places.iter().enumerate() {
        let variation = ladder.at(*place);
        let [nx, ny] = variation.cells;
        let head = format!(
            "level {}/{}  {nx} x {ny} cells, {}, tolerance {:.0e}",
            number + 1,
            places.len(),
            counted(variation.increments.iter().sum(), "increment"),
            variation.tolerance
        );
        let varied = variation.planned(plan).map_err(|error| {
            Failure::Call(format!("{nx} x {ny} cells: {error}"), "fret study --help".to_owned())
        })?;
        if let Some(rung) = levels.finished(&varied) {
            say(&format!("{head}: {}, solved before", duration(rung.wall_s)));
            rungs.push((*place, rung));
            continue;
        }
        match timed(&varied) {
            Ok(rung) => {
                levels.keep(&varied, &rung)?;
                say(&format!("{head}: {}", duration(rung.wall_s)));
                rungs.push((*place, rung));
            }
            Err(failure @ Failure::Unsolved(_)) if *place != ladder.finest() => {
                say(&format!("{head}: skipped, {}", failure.message()));
                unsolved.push((*place, failure.message()));
            }
            Err(Failure::Interrupted(_)) => {
                return Err(Failure::Interrupted(format!(
                    "{} of {} levels of the study are solved and kept; the same command continues with the others",
                    rungs.len(),
                    places.len()
                )));
            }
            Err(failure) => return Err(failure),
        }
    }
    Ok((Climb::new(ladder, rungs), unsolved))
}

/// A rung, solved a few times where that is quick, with the least of its times.
fn timed(plan: &Plan) -> Result<Rung, Failure> {
    let once = || match catch_unwind(AssertUnwindSafe(|| climbed(plan, &mut Listener))) {
        Ok(Ok(rung)) => Ok(rung),
        Ok(Err(RunError::Interrupted { .. })) => Err(Failure::Interrupted(String::new())),
        Ok(Err(error)) => Err(Failure::Unsolved(error)),
        Err(panic) => Err(Failure::Defect(defect::words_of(panic.as_ref()))),
    };
    let mut best = once()?;
    for _ in 1..TIMES {
        if best.wall_s < QUICK {
            best.wall_s = best.wall_s.min(once()?.wall_s);
        }
    }
    Ok(best)
}

/// The whole answer for programs.
fn answer(
    title: &str,
    truth: &Truth,
    (climb, lines): (&Climb, &[Line]),
    (advice, choice): (&[Advice], &str),
    unsolved: &Unsolved,
) -> Value {
    let sources = fret_core::study::Quantity::ALL
        .into_iter()
        .map(|quantity| (quantity.name().to_owned(), json!(truth.source(quantity))));
    let references = fret_core::study::Quantity::ALL
        .into_iter()
        .map(|quantity| (quantity.name().to_owned(), json!(truth.of(quantity))));
    json!({
        "status": "studied",
        "title": title,
        "closed_form": truth.form().map(ClosedForm::name),
        "measured_by": Value::Object(sources.collect()),
        "references": Value::Object(references.collect()),
        "kinds": Kind::ALL,
        "lines": table::to_json(climb, lines),
        "unsolved": unsolved.iter().map(|(place, why)| {
            let variation = climb.ladder().at(*place);
            json!({ "cells": variation.cells, "increments": variation.increments, "message": why })
        }).collect::<Vec<_>>(),
        "advice": advice,
        "choice": choice,
    })
}
