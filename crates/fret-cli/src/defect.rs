//! Mistakes of the program itself: caught, told in one sentence with their place, and never shown as a trace.

use std::any::Any;
use std::panic::{self, AssertUnwindSafe, catch_unwind};
use std::sync::Mutex;

use crate::failure::Failure;

/// Where the last one happened.
static PLACE: Mutex<Option<String>> = Mutex::new(None);

/// Notes the place of a defect, in place of printing it.
pub fn listen() {
    panic::set_hook(Box::new(|defect| {
        if let (Some(place), Ok(mut noted)) = (defect.location(), PLACE.lock()) {
            *noted = Some(place.to_string());
        }
    }));
}

/// What is asked: a mistake of the program in it is a failure, and not the end of the caller.
pub fn caught<T, E: From<Failure>>(asked: impl FnOnce() -> Result<T, E>) -> Result<T, E> {
    catch_unwind(AssertUnwindSafe(asked))
        .unwrap_or_else(|panic| Err(Failure::Defect(words_of(panic.as_ref())).into()))
}

/// What a defect said, and where.
fn words_of(defect: &(dyn Any + Send)) -> String {
    let literal = defect.downcast_ref::<&str>().map(|words| (*words).to_owned());
    let words =
        literal.or_else(|| defect.downcast_ref::<String>().cloned()).unwrap_or_else(|| "no words".to_owned());
    match PLACE.lock().ok().and_then(|place| place.clone()) {
        Some(place) => format!("{words} ({place})"),
        None => words,
    }
}
