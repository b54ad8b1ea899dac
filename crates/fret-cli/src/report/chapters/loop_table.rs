//! The loops in numbers: running condition, sliding condition, amplitudes, stiffness, A and D of the last cycle of each stage.

use maud::{Markup, html};

use crate::loop_numbers::{loop_numbers, running_condition, sliding_condition};
use crate::report::Measured;
use crate::report::html::table;
use crate::report::overview::Overview;

/// Stages side by side, at most.
const MOST_STAGES: usize = 4;

/// The table; nothing where no cycle is over.
pub fn loop_table(view: &Overview<'_>) -> Markup {
    let cycles = &view.results.cycles;
    let last_of = |stage: usize| cycles.iter().rfind(|cycle| cycle.stage == stage);
    let Some(newest) = cycles.last() else { return html! {} };
    let mut lasts: Vec<_> = (0..view.results.case().stages.len()).filter_map(last_of).collect();
    lasts.retain(|cycle| cycle.drive == newest.drive);
    let lasts = &lasts[lasts.len().saturating_sub(MOST_STAGES)..];
    let printed = |word: &str| if word == "-" { "–".to_owned() } else { word.to_owned() };
    let heads: Vec<String> = lasts
        .iter()
        .map(|cycle| format!("{}, cycle {}", view.stage_name(cycle.stage), cycle.last_cycle))
        .collect();
    let head: Vec<&str> = std::iter::once("in").chain(heads.iter().map(String::as_str)).collect();
    let running = view.results.running_conditions();
    let row =
        |name: &str, cells: Vec<String>| std::iter::once(name.to_owned()).chain(cells).collect::<Vec<_>>();
    let mut rows = vec![
        row(
            "running condition of all cycles",
            lasts
                .iter()
                .map(|cycle| printed(running_condition(running.get(cycle.stage).copied().flatten())))
                .collect(),
        ),
        row("sliding condition", lasts.iter().map(|cycle| printed(sliding_condition(cycle))).collect()),
    ];
    for (place, (name, ..)) in loop_numbers(newest).into_iter().enumerate() {
        let number = |(_, kind, value): (_, _, Option<f64>)| {
            value.map_or_else(|| "–".to_owned(), |value| view.number(value, kind))
        };
        let cells = lasts.iter().map(|cycle| number(loop_numbers(cycle)[place])).collect();
        rows.push(row(&name.replace("d*", "δ*"), cells));
    }
    table(&head, &rows)
}
