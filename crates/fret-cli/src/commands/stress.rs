//! `fret stress`: stresses under the surface, from the kept tractions of a finished run; nothing is solved again.

use fret_core::case::{Side, StressRequest};
use fret_core::model::Body;
use serde_json::json;

use crate::arguments::StressArguments;
use crate::failure::Failure;
use crate::interrupt;
use crate::stress::computed;
use crate::terminal::Answer;
use fret_results::Results;

/// Computes stresses for a result folder.
pub fn stress(arguments: &StressArguments) -> Result<Answer, Failure> {
    interrupt::listen();
    let run = Results::read(&arguments.folder)?;
    if run.case().wear.as_ref().is_some_and(|wear| wear.thinning_tolerance.is_some()) {
        let why = "the layers of this run became thinner by wear (wear.thinning_tolerance), and stresses below are those of unworn layers";
        let way_out = "a case with the thinner coating, pressed alike";
        return Err(Failure::call(format!("{}: {why}", arguments.folder.display()), way_out));
    }
    let request = requested(arguments, &run);
    let pool = arguments.threads.pool()?;
    let (record, text) = pool.install(|| computed(&arguments.folder, &run, &request, &arguments.manner))?;
    Ok(Answer::new(json!(record), text))
}

/// What the call asks for, or else the case.
fn requested(arguments: &StressArguments, run: &Results) -> StressRequest {
    let mut request = run.case().stress.clone().unwrap_or_default();
    if !arguments.depths.is_empty() {
        request.depths = Some(arguments.depths.clone());
    }
    if arguments.auto {
        request.depths = None;
    }
    if let Some(every) = arguments.every {
        request.every = every as usize;
    }
    match arguments.body.as_deref() {
        Some("upper") => request.body = Side::Upper,
        Some(_) => request.body = Side::Lower,
        // without a word, a rigid lower body means the other one
        None if run.case().stress.is_none() && *run.case().bodies.lower() == Body::Rigid => {
            request.body = Side::Upper;
        }
        None => {}
    }
    request.volume |= arguments.volume;
    request
}
