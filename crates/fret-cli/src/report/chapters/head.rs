//! The run at a glance: title, how it ended, its most telling numbers, what about them may mislead.

use fret_core::history::WornTo;
use fret_core::study::pressure_of_run_is_unbounded;
use maud::{Markup, html};

use crate::figures::{capitalised, counted, duration, largest, percent};
use crate::loop_numbers::sliding_condition;
use crate::report::{Measured, Overview, short};

/// Title, how the run ended, and its most telling numbers.
pub fn head(view: &Overview<'_>) -> Markup {
    html! {
        header {
            h1 { (view.results.title()) }
            p class="lead" { (how_it_ended(view)) }
            @if let Some(why) = view.results.unfinished() { p class="warning" { (capitalised(&why)) "." } }
            @let cards = cards(view);
            @if !cards.is_empty() {
                dl class="cards" { @for (name, value) in cards { div { dt { (name) } dd { (value) } } } }
            }
            @for warning in &view.results.record.warnings {
                p class="warning" { (capitalised(&warning.message)) "." br; span class="small" { (warning.help) } }
            }
        }
    }
}

fn how_it_ended(view: &Overview<'_>) -> String {
    let (record, table) = (&view.results.record, &view.results.table);
    let all = record.plan.increments;
    let mut line = vec![
        format!("fretting {}", record.version),
        record.status.clone(),
        if table.rows() == all || record.is_solved() {
            counted(table.rows(), "increment")
        } else {
            format!("{} of {all} increments", table.rows())
        },
    ];
    if let Some(end) = &record.end {
        if let Some(worn) = &end.worn_through {
            let what = match worn.to {
                WornTo::Coating => "coating worn through",
                WornTo::Limit => "worn to the limit",
            };
            line.push(format!("{what} after {}", counted(worn.cycles, "cycle")));
        }
        line.push(format!("{} on {}", duration(end.totals.wall_s), counted(record.threads, "thread")));
    }
    line.extend(record.started_unix_s.map(|seconds| format!("started {}", date(seconds))));
    line.join(" · ")
}

fn cards(view: &Overview<'_>) -> Vec<(String, String)> {
    let table = &view.results.table;
    let Some(last) = table.rows().checked_sub(1) else { return Vec::new() };
    let largest = |name: &str| largest(table.column(name));
    let area = format!("max contact {}", view.dimension().area());
    let case = view.results.case();
    let pressure = if pressure_of_run_is_unbounded(case) {
        "max pressure (no limit: it grows with the number of cells)"
    } else {
        "max pressure"
    };
    let mut cards = Vec::new();
    let mut add = |name: &str, told: String| cards.push((name.to_owned(), told));
    add(pressure, view.number(largest("max_pressure"), "pressure"));
    add(&area, view.number(largest("contact_area"), "length^2"));
    if view.direction.is_some() || view.twists {
        add("max shear", view.number(largest("max_shear"), "pressure"));
        add("stick at the end", percent(table.at("stick_cells", last) / table.at("contact_cells", last)));
        add("dissipated energy", view.told("dissipated_energy", last));
    }
    if let Some(cycle) = view.results.cycles.last().filter(|cycle| cycle.regime.is_some()) {
        add("sliding condition", sliding_condition(cycle));
    }
    if let Some(rolled) = view.rolled.as_ref().filter(|rolled| rolled.rolls[last]) {
        for column in &rolled.columns {
            add(&column.in_words(), view.told(column.name, last));
        }
    }
    if case.wear.is_some() {
        add("wear volume", view.told("worn_volume", last));
        add("max wear depth", view.told("max_worn_depth", last));
    }
    if case.wear.as_ref().is_some_and(|wear| wear.debris.is_some()) {
        add("debris", view.told("debris_volume", last));
        if let Some(cycle) = view.results.cycles.last() {
            add("cycles", cycle.last_cycle.to_string());
        }
    }
    add("max residual", short(largest("residual")));
    cards
}

/// The day of a moment, in seconds since 1970 began, in Greenwich.
///
/// Source: Hinnant, "chrono-compatible low-level date algorithms": days to a civil date of the Gregorian calendar.
fn date(seconds: u64) -> String {
    let days = seconds / 86_400 + 719_468;
    let era = days / 146_097;
    let day_of_era = days % 146_097;
    let year_of_era = (day_of_era - day_of_era / 1460 + day_of_era / 36_524 - day_of_era / 146_096) / 365;
    let day_of_year = day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    let shifted_month = (5 * day_of_year + 2) / 153;
    let day = day_of_year - (153 * shifted_month + 2) / 5 + 1;
    let month = if shifted_month < 10 { shifted_month + 3 } else { shifted_month - 9 };
    let year = year_of_era + 400 * era + u64::from(month <= 2);
    let (hour, minute) = (seconds / 3600 % 24, seconds / 60 % 60);
    format!("{year}-{month:02}-{day:02} {hour:02}:{minute:02} UTC")
}

#[cfg(test)]
mod tests {
    use super::date;

    #[test]
    fn dates_are_those_of_the_calendar() {
        // From `date -u -d @SECONDS`.
        for (seconds, day) in [
            (0, "1970-01-01 00:00 UTC"),
            (951_782_399, "2000-02-28 23:59 UTC"),
            (951_868_800, "2000-03-01 00:00 UTC"),
            (1_795_269_876, "2026-11-21 14:04 UTC"),
            (4_107_542_400, "2100-03-01 00:00 UTC"),
        ] {
            assert_eq!(date(seconds), day);
        }
    }
}
