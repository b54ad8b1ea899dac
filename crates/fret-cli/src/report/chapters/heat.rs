//! Temperatures and contact resistances, where `fret heat` has computed them.

use maud::{Markup, html};

use crate::heat::HeatRecord;
use crate::report::{Measured, Overview, chapter, pairs, read_answer};

/// The chapter; nothing where there is no `heat.json`, or an unreadable one.
pub fn heat(view: &Overview<'_>) -> Markup {
    let path = view.results.path.join("heat").join("heat.json");
    let Ok(record) = read_answer::<HeatRecord>(&path, "") else { return html! {} };
    let row =
        |[name, value, of]: [String; 3]| (if of.is_empty() { name } else { format!("{name}, {of}") }, value);
    let rows = record.lines(|value, kind| view.number(value, kind)).into_iter().map(row);
    let body = html! {
        p { "By the friction of the last cycle, from the kept fields. Temperatures and resistances are in the units of the conductivities of the case." }
        (pairs(rows))
    };
    chapter("Heat and current", &body)
}
