//! Error bars of the quantities of interest, where the run was asked for them.

use fret_results::ERROR_BARS;
use maud::{Markup, html};

use crate::failure::Failure;
use crate::report::{Measured, Overview, chapter, number, read_answer, short, table};
use crate::run::{BarRow, BarsRecord, Cell, Estimate};

/// What brings them back where the file cannot be read.
const AGAIN: &str = "fret run --resume --estimate-error writes it again";

/// The numbers at the ends of the stages with their bars.
pub fn error_bars(view: &Overview<'_>) -> Result<Markup, Failure> {
    let path = view.results.path.join(ERROR_BARS);
    if !path.is_file() {
        return Ok(html! {});
    }
    let record: BarsRecord = read_answer(&path, AGAIN)?;
    let estimate = Estimate::of(record, view.results.plan());
    let stages = &estimate.record.stages;
    let names = stages.iter().map(|bars| bars.name.clone());
    let head: Vec<String> = ["at the end of".to_owned()].into_iter().chain(names).collect();
    let cell = |cell: Option<Cell>, kind: &str| match cell {
        None => "-".to_owned(),
        Some((value, Some(0.0))) => view.number(value, kind),
        Some((value, Some(bar))) => view.with_unit(format!("{} ± {}", number(value), short(bar)), kind),
        Some((_, None)) => "no limit".to_owned(),
    };
    let row = |BarRow { name, kind, cells }: BarRow| {
        [name].into_iter().chain(cells.into_iter().map(|of| cell(of, kind))).collect()
    };
    let rows: Vec<Vec<String>> = estimate.rows(stages).into_iter().map(row).collect();
    let source = estimate.source().replace(" x ", " × ");
    Ok(chapter(
        "Error bars",
        &html! {
            p { "Errors of cells and increments, " (source) ": the true value of the model is expected within them." }
            (table(&head, &rows))
            @for line in estimate.lacking() { p class="small" { (line) } }
        },
    ))
}
