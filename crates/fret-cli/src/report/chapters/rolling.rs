//! A contact that rolls: creepage, spin and friction by distance rolled, and the force that goes with them.

use maud::{Markup, html};

use super::loading::{loop_curves, stick_fraction};
use super::loop_table::loop_table;
use crate::figures::capitalised;
use crate::report::{Measured, Overview, Rolled, chapter, joined, side_by_side, table};
use fret_drawing::{Axis, Chart, Curve};

/// What changes by less than this fraction of itself along the way does not change.
const SEEN: f64 = 1e-6;

/// The chapter, in place of the fretting loop; nothing where nothing rolls.
pub fn rolling(view: &Overview<'_>) -> Markup {
    let Some(rolled) = &view.rolled else { return html! {} };
    let mut figures = tractive_curve(view, rolled);
    figures.extend(over_distance(view, rolled));
    figures.push(stick_fraction(view));
    chapter("Rolling", &html! { (at_ends(view, rolled)) (side_by_side(&figures)) (loop_table(view)) })
}

/// The numbers at the ends of the stages that roll.
fn at_ends(view: &Overview<'_>, rolled: &Rolled) -> Markup {
    let names = rolled.columns.iter().map(|column| column.in_words());
    let head: Vec<String> = ["at the end of".to_owned()].into_iter().chain(names).collect();
    let ends = view.spans.iter().enumerate().filter(|(_, [_, end])| rolled.rolls[end - 1]);
    let rows: Vec<Vec<String>> = ends
        .map(|(stage, [_, end])| {
            let numbers = rolled.columns.iter().map(|column| view.told(column.name, end - 1));
            [view.stage_name(stage)].into_iter().chain(numbers).collect()
        })
        .collect();
    table(&head, &rows)
}

/// Whether the increments of a stage are steady states.
fn is_steady(view: &Overview<'_>, stage: usize) -> bool {
    view.results.case().stages.get(stage).is_some_and(|stage| stage.steady)
}

/// Force over creepage, and friction over creepage, of steady states where there are several.
fn tractive_curve(view: &Overview<'_>, rolled: &Rolled) -> Vec<Markup> {
    let history = &view.results.table;
    let Some([cosine, sine]) = view.direction else { return Vec::new() };
    let steady = |row: &usize| rolled.rolls[*row] && is_steady(view, history.at("stage", *row) as usize);
    let rows: Vec<usize> = (0..history.rows()).filter(steady).collect();
    if rows.len() < 2 {
        return Vec::new();
    }
    let creepage = |row: usize| cosine * history.at("creepage_x", row) + sine * history.at("creepage_y", row);
    let chart = |what: &str, values: &[f64], caption: &str| {
        let points: Vec<[f64; 2]> = rows.iter().map(|row| [creepage(*row), values[*row]]).collect();
        let curves = Curve::plain(points).dotted();
        let axes = [view.label("creepage", ""), view.label(what, "force")];
        Chart::new(&format!("{what} over creepage"), axes, curves).figure(caption)
    };
    vec![
        chart(
            "tangential force",
            &view.tangential,
            "Tractive curve: tangential force over creepage, both along the load, of each steady state.",
        ),
        chart(
            "rolling friction",
            history.column("rolling_friction"),
            "Energy that friction dissipates by distance rolled, of each steady state.",
        ),
    ]
}

/// Force, creepage, spin and friction over the distance, where it rolls through more than steady states.
fn over_distance(view: &Overview<'_>, rolled: &Rolled) -> Vec<Markup> {
    let history = &view.results.table;
    let passing = |row: usize| rolled.rolls[row] && !is_steady(view, history.at("stage", row) as usize);
    if (0..history.rows()).filter(|row| passing(*row)).count() < 2 {
        return Vec::new();
    }
    let mut figures = Vec::new();
    if view.direction.is_some() {
        let caption = "Tangential force along the load over the distance that the contact has rolled.";
        let curves = match view.rolls_to_the_end() {
            Some(_) => loop_curves(view),
            None => vec![Curve::plain(joined(&rolled.distance, &rolled.where_it_rolls(&view.tangential)))],
        };
        let axes = [view.label("distance rolled", "length"), view.label("tangential force", "force")];
        let chart = Chart::new("tangential force over distance rolled", axes, curves);
        figures.push(chart.figure(caption));
    }
    let cycles = view.cycles();
    let that_roll = cycles.iter().rev().find(|[first, after]| (*first..*after).any(passing));
    let ([from, to], called) = match that_roll {
        Some(cycle) => (*cycle, " The last cycle that rolls."),
        None => ([0, history.rows()], ""),
    };
    for column in &rolled.columns {
        let (name, values) = (column.in_words(), rolled.where_it_rolls(history.column(column.name)));
        let [low, high] = Axis::ends(values[from..to].iter().copied());
        if high - low <= SEEN * low.abs().max(high.abs()) {
            continue; // prescribed, and told above
        }
        let points = joined(&rolled.distance[from..to], &values[from..to]);
        let axes = [view.label("distance rolled", "length"), view.label(&name, column.unit)];
        let chart = Chart::new(&format!("{name} over distance rolled"), axes, vec![Curve::plain(points)]);
        figures.push(chart.figure(&format!("{}, by distance rolled.{called}", capitalised(&name))));
    }
    figures
}
