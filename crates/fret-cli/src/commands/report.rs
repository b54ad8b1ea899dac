//! `fret report`: a run, a sweep or a study in one page.

use std::path::Path;

use serde_json::json;

use crate::arguments::ReportArguments;
use crate::failure::Failure;
use crate::manner::refuse_other_file;
use crate::report::{page, study, sweep};
use crate::sweep::RECORD as SWEEP;
use crate::terminal::Answer;
use fret_results::Results;

/// A page with what is told of it.
struct Page {
    text: String,
    /// What is counted, and how many.
    counted: (&'static str, usize),
    /// Why a run is not finished.
    unfinished: Option<String>,
}

/// The page of what lies in the folder.
fn page_of(folder: &Path) -> Result<Page, Failure> {
    if folder.join(SWEEP).is_file() {
        let (text, points) = sweep::page(folder)?;
        return Ok(Page { text, counted: ("points", points), unfinished: None });
    }
    if folder.join(study::STUDY).is_file() {
        let (text, levels) = study::page(folder)?;
        return Ok(Page { text, counted: ("levels", levels), unfinished: None });
    }
    if folder.join("points").is_dir() {
        let way_out = if folder.join("sweep.toml").is_file() {
            "run `fret sweep` once more: finished points of this version are not solved again"
        } else {
            "a sweep of Python is an xarray.Dataset: fretting.plot.regime_map draws it; `fret sweep` writes folders with a page"
        };
        return Err(Failure::call(
            format!("{}: a sweep without the list of its points", folder.display()),
            way_out,
        ));
    }
    let results = Results::read(folder)?;
    let unfinished = results.unfinished();
    Ok(Page { text: page(&results)?, counted: ("increments", results.table.rows()), unfinished })
}

/// Writes the page and tells where it is.
pub fn report(ReportArguments { results: folder, manner }: &ReportArguments) -> Result<Answer, Failure> {
    let path = manner.out.clone().unwrap_or_else(|| folder.join("report.html"));
    refuse_other_file(&path, &["html", "htm"])?;
    let Page { text, counted: (what, count), unfinished } = page_of(folder)?;
    manner.write(&path, text.as_bytes())?;
    let shown = path.display().to_string();
    let record = json!({ "status": "reported", "file": shown, what: count, "unfinished": unfinished });
    let text = [shown].into_iter().chain(unfinished).collect::<Vec<_>>().join("\n");
    Ok(Answer::new(record, text))
}
