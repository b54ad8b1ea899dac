//! Temperatures and contact resistances, where `fret heat` has computed them.

use maud::{Markup, html};

use crate::heat::HeatRecord;
use crate::report::{Measured, Overview, answer_beside, chapter, pairs};
use fret_results::HEAT;

const CHAPTER: &str = "Heat and current";

/// The chapter; nothing where there is no `heat.json`.
pub fn heat(view: &Overview<'_>) -> Markup {
    let record: HeatRecord = match answer_beside(&view.results.path, HEAT) {
        Some(Ok(record)) => record,
        Some(Err(why)) => return chapter(CHAPTER, &html! { p class="small" { (why) } }),
        None => return html! {},
    };
    let row =
        |[name, value, of]: [String; 3]| (if of.is_empty() { name } else { format!("{name}, {of}") }, value);
    let rows = record.lines(|value, kind| view.number(value, kind)).into_iter().map(row);
    let body = html! {
        p { "By the friction of the last cycle, from the kept fields. Temperatures and resistances are in the units of the conductivities of the case." }
        (pairs(rows))
    };
    chapter(CHAPTER, &body)
}
