//! Error bars of the quantities of interest, where the run was asked for them.

use fret_results::ERROR_BARS;
use maud::{Markup, html};

use crate::estimate::{BarsRecord, Cell, Estimate};
use crate::failure::Failure;
use crate::report::Measured;
use crate::report::html::{chapter, number, short, table};
use crate::report::overview::Overview;
use crate::report::written::read_answer;

/// What brings them back where the file cannot be read.
const AGAIN: &str = "fret run --resume --estimate-error writes it again";

/// The numbers at the ends of the stages with their bars.
pub fn error_bars(view: &Overview<'_>) -> Result<Markup, Failure> {
    let path = view.results.path.join(ERROR_BARS);
    if !path.is_file() {
        return Ok(html! {});
    }
    let record: BarsRecord = read_answer(&path, AGAIN)?;
    let estimate = Estimate::read_back(&record, view.results.plan());
    let names: Vec<String> = estimate.bars.iter().map(|bars| view.stage_name(bars.stage)).collect();
    let head: Vec<&str> = std::iter::once("at the end of").chain(names.iter().map(String::as_str)).collect();
    let rows: Vec<Vec<String>> = estimate
        .rows(&estimate.bars)
        .into_iter()
        .map(|row| {
            let cell = |cell: Option<Cell>| match cell {
                None => "-".to_owned(),
                Some((value, Some(0.0))) => view.number(value, row.kind),
                Some((value, Some(bar))) => {
                    view.with_unit(format!("{} ± {}", number(value), short(bar)), row.kind)
                }
                Some((_, None)) => "no limit".to_owned(),
            };
            std::iter::once(row.name).chain(row.cells.into_iter().map(cell)).collect()
        })
        .collect();
    let source = estimate.source().replace(" x ", " × ");
    Ok(chapter(
        "Error bars",
        &html! {
            p { "Errors of cells and increments, " (source) ": the true value of the model is expected within them." }
            (table(&head, &rows))
            @for line in estimate.lacking(|stage| view.stage_name(stage)) { p class="small" { (line) } }
        },
    ))
}
