//! Temperatures and contact resistances, where `fret heat` has computed them.

use std::fs;

use maud::{Markup, html};

use crate::commands::heat_record::HeatRecord;
use crate::report::html::{chapter, number, pairs};
use crate::report::overview::Overview;

/// The chapter; nothing where there is no `heat.json`, or an unreadable one.
pub fn heat(view: &Overview<'_>) -> Markup {
    let text = fs::read(view.results.path.join("heat").join("heat.json")).ok();
    let Some(record) = text.and_then(|text| serde_json::from_slice::<HeatRecord>(&text).ok()) else {
        return html! {};
    };
    let figure = |value: f64, kind: &str| {
        if kind.is_empty() { number(value) } else { view.number(value, kind) }
    };
    let row = |[name, value, of]: [String; 3]| {
        let name = if of.is_empty() { name } else { format!("{name}, {of}") };
        (name, html! { (value) })
    };
    let rows: Vec<_> = record.lines(figure).into_iter().map(row).collect();
    let body = html! {
        p { "By the friction of the last cycle, from the kept fields. Temperatures and resistances are in the units of the conductivities of the case." }
        (pairs(&rows))
    };
    chapter("Heat and current", &body)
}
