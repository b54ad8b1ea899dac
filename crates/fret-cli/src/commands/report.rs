//! `fret report`: a run in one page.

use std::path::Path;

use serde_json::json;

use crate::failure::Failure;
use crate::report::page;
use crate::terminal;
use fret_results::Results;
use fret_results::write_whole;

/// Writes the page and tells where it is.
pub fn report(folder: &Path, out: Option<&Path>, as_json: bool) -> Result<(), Failure> {
    let results = Results::read(folder)?;
    let path = out.map_or_else(|| folder.join("report.html"), Path::to_owned);
    let is_page = path.extension().is_some_and(|extension| extension == "html" || extension == "htm");
    if path.is_dir() || (path.exists() && !is_page) {
        let what =
            if path.is_dir() { "a folder" } else { "a file that is there already and is no .html file" };
        return Err(Failure::Call(
            format!("{}: {what}", path.display()),
            "choose another place for the page with --out FILE".to_owned(),
        ));
    }
    write_whole(&path, page(&results)?.as_bytes())?;
    let shown = path.display().to_string();
    if as_json {
        let answer = json!({ "status": "reported", "file": shown, "increments": results.table.rows(), "unfinished": results.unfinished() });
        return terminal::answer_in_json(&answer);
    }
    terminal::answer(&shown)?;
    results.unfinished().map_or(Ok(()), |why| terminal::answer(&why))
}
