//! `fret explore`: a case to play with, in the browser of this machine.

use serde_json::json;

use crate::arguments::ExploreArguments;
use crate::explore::{Question, Server, Solver};
use crate::failure::Failure;
use crate::interrupt;
use crate::terminal;
use fret_results::CaseFile;

/// Serves the page until somebody asks to stop.
pub fn explore(arguments: &ExploreArguments, as_json: bool) -> Result<(), Failure> {
    let case_file = CaseFile::asked(&arguments.case)?;
    let pool = arguments.threads.pool()?;
    let question = pool.install(|| Question::new(&case_file, arguments.cells))?;
    if question.sliders.is_empty() {
        let why = format!("{}: has no number that a slider could change", case_file.name());
        return Err(Failure::call(why, "a case with moduli, friction or loads as plain numbers"));
    }
    let server = Server::open(arguments.port)?;
    interrupt::listen();
    if as_json {
        terminal::answer_in_json(&json!({ "status": "serving", "address": server.address() }))?;
    } else {
        terminal::answer(&format!("open {}\nCtrl-C ends it", server.address()))?;
    }
    server.serve(Solver::new(question, pool))?;
    Ok(())
}
