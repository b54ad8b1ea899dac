//! A study while it is solved, level by level, and judged.

use fret_core::plan::Plan;
use fret_core::run::Observer;
use fret_core::study::{
    Level, Line, Place, Quantity, RefinementStudy, Resolutions, VariationError, pressure_is_unbounded,
    solved_level,
};

use super::levels::Levels;
use super::question::{Against, Question};
use super::record::StudyRecord;
use super::table::ErrorColumn;
use super::words;
use crate::defect;
use crate::failure::Failure;
use crate::figures::{counted, duration};
use crate::interrupt;
use crate::manner::Listener;

/// Accuracies a choice is told for.
const ACCURACIES: [f64; 3] = [1e-2, 1e-3, 1e-4];
/// Levels quicker than this are timed again [s], the least of a few times counts.
const QUICK: f64 = 0.3;
/// Times a quick level is timed at the most.
const TIMES: usize = 3;

/// A study with its answer.
pub struct Studied {
    /// All of it.
    pub record: StudyRecord,
    /// Its levels.
    pub study: RefinementStudy,
    /// The levels of each kind of refinement, judged.
    pub lines: Vec<Line>,
    /// What its errors are measured by, in words.
    pub measured: String,
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
    let record = StudyRecord::new(
        (title, plan.case.units.as_ref()),
        &reference,
        (&study, &lines),
        (&advice, &choice),
        &unsolved,
    );
    let known = ErrorColumn::known(&record.lines);
    let shown = |quantity| known.iter().any(|column| column.is_of(quantity));
    let said = [words::measured_by, words::without_order].map(|of| of(&reference, &shown, dimension));
    let measured =
        if known.is_empty() { words::no_errors(&unsolved) } else { said.join("\n").trim_end().to_owned() };
    let of_the_way = words::first_after_steady(&plan.case.stages)
        .map(|stage| words::of_the_way(&plan.case.stages[stage].name, "are not compared"));
    let measured = [measured].into_iter().chain(of_the_way).collect::<Vec<_>>().join("\n");
    Ok(Studied { record, study, lines, measured })
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
            Err(VariationError::PartsOfCells { why, .. }) if *place != resolutions.finest() => {
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
