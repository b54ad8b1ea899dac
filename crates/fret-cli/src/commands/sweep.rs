//! `fret sweep`: many cases on the cores of one machine; finished points are not solved again.

use std::path::Path;
use std::time::Instant;

use serde_json::json;

use crate::arguments::SweepArguments;
use crate::failure::{Failure, Told};
use crate::interrupt;
use crate::sweep::columns::columns;
use crate::sweep::setting::Setting;
use crate::sweep::{Answer, Board, Counts, Question, Spread, SweepFolder};
use crate::terminal;
use crate::threads;
use fret_results::{Origin, stem};

/// Solves all points of a sweep.
pub fn sweep(arguments: &SweepArguments, as_json: bool, since: Instant) -> Result<(), Told> {
    let question = Question::read(&arguments.sweep)?;
    let origin = arguments.from.as_deref().map(Origin::read).transpose()?;
    let own = || Path::new("results").join(stem(&arguments.sweep, "sweep"));
    let path = arguments.manner.out.clone().unwrap_or_else(own);
    let folder = SweepFolder::open(&path, &question.text, origin.as_ref(), &arguments.manner)?;
    let setting = Setting::of(&question);
    folder.list(&question, &setting)?;
    interrupt::listen();
    let threads = threads::asked(arguments.threads);
    let known: Vec<Option<Answer>> = question.points.iter().map(|point| folder.finished(point)).collect();
    let board = Board::new((&question, &setting), origin, known, &arguments.manner);
    board.announce(threads);
    let failure = board.work(&folder, threads);
    let answers = board.answers();
    let columns = columns(&answers);
    let summary = folder.summarise((&question, &setting), &answers, &columns);
    if let Some(failure) = failure {
        return Err(failure.into());
    }
    let summary = summary?;
    let spread = Spread::of(&question, &setting, &columns);
    let spread = spread.map(|spread| folder.spread(&spread)).transpose()?;
    let counts = Counts::of(&answers);
    let record = json!({
        "status": if counts.unsolved() == 0 { "solved" } else { "some points not solved" },
        "points": question.points.len(),
        "solved": counts.solved,
        "unsolved": counts.unsolved(),
        "refused": counts.refused,
        "failed": counts.failed,
        "solved_before": board.solved_before,
        "summary": summary.display().to_string(),
    });
    let told = format!(
        "{} solved, {} not, {} found finished\nsummary    {}\npage       fret report {}",
        counts.solved,
        counts.unsolved(),
        board.before,
        summary.display(),
        path.display()
    );
    let text = spread.map(|table| table + "\n").into_iter().chain([told]).collect::<Vec<_>>().join("\n");
    arguments.manner.tell(&terminal::Answer::new(record, text), as_json, since)?;
    match counts {
        Counts { refused: 0, failed: 0, .. } => Ok(()),
        Counts { refused, failed, .. } => {
            Err(Told { failure: Failure::Points { refused, failed }, in_json: as_json })
        }
    }
}
