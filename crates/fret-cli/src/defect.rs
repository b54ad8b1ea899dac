//! Mistakes of the program itself: caught, told in one sentence with their place, and never shown as a trace.

use std::any::Any;
use std::panic;
use std::sync::Mutex;

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

/// What a defect said, and where.
pub fn words_of(defect: &(dyn Any + Send)) -> String {
    let literal = defect.downcast_ref::<&str>().map(|words| (*words).to_owned());
    let words =
        literal.or_else(|| defect.downcast_ref::<String>().cloned()).unwrap_or_else(|| "no words".to_owned());
    match PLACE.lock().ok().and_then(|place| place.clone()) {
        Some(place) => format!("{words} ({place})"),
        None => words,
    }
}
