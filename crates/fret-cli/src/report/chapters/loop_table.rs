//! The loops in numbers: running condition, sliding condition, amplitudes, stiffness, A and D of the last cycle of each stage.

use fret_core::history::CycleRecord;
use maud::{Markup, html};

use crate::loop_numbers::{loop_numbers, running_condition, sliding_condition};
use crate::report::{Measured, Overview, table};

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
    let printed = |word: String| if word == "-" { "–".to_owned() } else { word };
    let row = |name: &str, cell: &dyn Fn(&CycleRecord) -> String| -> Vec<String> {
        [name.to_owned()].into_iter().chain(lasts.iter().map(|cycle| cell(cycle))).collect()
    };
    let head = row("in", &|cycle| format!("{}, cycle {}", view.stage_name(cycle.stage), cycle.last_cycle));
    let running = view.results.running_conditions();
    let running = |cycle: &CycleRecord| running_condition(running.get(cycle.stage).copied().flatten());
    let mut rows = vec![
        row("running condition of all cycles", &|cycle| printed(running(cycle).to_owned())),
        row("sliding condition", &|cycle| printed(sliding_condition(cycle))),
    ];
    for (place, (name, ..)) in loop_numbers(newest).into_iter().enumerate() {
        let number = |cycle: &CycleRecord| {
            let (_, kind, value) = loop_numbers(cycle)[place];
            value.map_or_else(|| "–".to_owned(), |value| view.number(value, kind))
        };
        rows.push(row(&name.replace("d*", "δ*"), &number));
    }
    table(&head, &rows)
}
