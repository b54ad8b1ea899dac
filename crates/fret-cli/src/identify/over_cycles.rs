//! A test over its cycles: curves of what is read from them, and where the sliding condition changes.

use fret_core::history::CycleRegime;
use fret_core::identify::{Cycle, Identification, Quantities};
use maud::{Markup, html};
use serde_json::{Value, json};

use fret_drawing::{Chart, Curve, Label, Stroke};

/// Single cycles that a change of the sliding condition must explain: fewer, one after the other, are noise at the border.
const CHANGE: usize = 5;
/// Fewest cycles of a test that curves are drawn of.
const FEWEST: usize = 3;

/// Cycles of one sliding condition, by their names in the log.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Span {
    /// The first.
    pub from: f64,
    /// The last.
    pub to: f64,
    /// Whether the whole contact slides.
    pub slides: bool,
}

impl Span {
    /// Its sliding condition, as files name it.
    fn word(self) -> &'static str {
        if self.slides { CycleRegime::GrossSlip } else { CycleRegime::PartialSlip }.name()
    }
}

/// The sliding conditions of a test, in their order.
pub fn spans(found: &Identification) -> Vec<Span> {
    let judged: Vec<(f64, bool)> = found.cycles.iter().filter_map(condition).collect();
    let slides: Vec<bool> = judged.iter().map(|(_, slides)| *slides).collect();
    let mut spans: Vec<Span> = Vec::new();
    for ((name, _), slides) in judged.iter().zip(smoothed(&slides)) {
        match spans.last_mut() {
            Some(last) if last.slides == slides => last.to = *name,
            _ => spans.push(Span { from: *name, to: *name, slides }),
        }
    }
    spans
}

/// The name of a cycle, and whether it is in gross slip; nothing of one that was skipped. That noise hides the friction of a cycle says
/// nothing about it.
fn condition(cycle: &Cycle) -> Option<(f64, bool)> {
    Some((cycle.measured.name, cycle.quantities.as_ref()?.slides?))
}

/// The sequence of two conditions that contradicts fewest cycles, where each change costs as much as [`CHANGE`] contradictions (Viterbi).
fn smoothed(slides: &[bool]) -> Vec<bool> {
    // cost of the best sequence that ends in either condition, and which one it came from
    let mut cost = [0, 0];
    let mut came_from = Vec::with_capacity(slides.len());
    for &slides in slides {
        let from = [0, 1].map(|to: usize| if cost[1 - to] + CHANGE < cost[to] { 1 - to } else { to });
        cost = [0, 1].map(|to: usize| {
            let change = if from[to] == to { 0 } else { CHANGE };
            cost[from[to]] + change + usize::from(usize::from(slides) != to)
        });
        came_from.push(from);
    }
    let mut state = usize::from(cost[1] < cost[0]);
    let step_back = |from: &[usize; 2]| {
        let now = state;
        state = from[now];
        now == 1
    };
    let mut sequence: Vec<bool> = came_from.iter().rev().map(step_back).collect();
    sequence.reverse();
    sequence
}

/// The conditions of a test in words; nothing of a single cycle.
pub fn in_words(found: &Identification) -> Option<String> {
    let spans = spans(found);
    let told = |span: &Span| {
        let words = span.word().replace('_', " ");
        if span.from == span.to {
            format!("{words} in cycle {}", span.from)
        } else {
            format!("{words} in cycles {} to {}", span.from, span.to)
        }
    };
    (found.cycles.len() > 1 && !spans.is_empty())
        .then(|| spans.iter().map(told).collect::<Vec<_>>().join(", "))
}

/// The same for programs.
pub fn record(found: &Identification) -> Vec<Value> {
    let of = |span: Span| json!({"from": span.from, "to": span.to, "sliding_condition": span.word()});
    spans(found).into_iter().map(of).collect()
}

/// A chart over the cycles; none where nothing is known.
pub fn over_cycles(label: Label, curves: Vec<Curve>) -> Option<Chart> {
    let is_drawn = curves.iter().any(|curve| curve.points.iter().any(|point| point[1].is_finite()));
    let what = format!("{} over the cycles", label.name);
    is_drawn.then(|| Chart::new(&what, [Label::plain("cycle"), label], curves))
}

/// Curves over the cycles, as a part of the page.
pub fn figures(found: &Identification) -> Markup {
    type Read = fn(&Quantities) -> Option<f64>;
    if found.cycles.len() < FEWEST {
        return html! {};
    }
    let curve = |read: Read, name: &str, colour: usize| {
        let value = |cycle: &Cycle| cycle.quantities.as_ref().and_then(read).unwrap_or(f64::NAN);
        let points = found.cycles.iter().map(|cycle| [cycle.measured.name, value(cycle)]).collect();
        Curve::line(points, name, colour)
    };
    let chart = |what: &str, unit: &str, curves: Vec<Curve>| {
        let unit = (!unit.is_empty()).then(|| found.unit_of(unit));
        over_cycles(Label::with(what, unit), curves)
    };
    let charts = [
        chart(
            "friction coefficient",
            "",
            vec![
                curve(|all| all.energy_friction, "from energy and opening", 0),
                curve(|all| all.plateau_friction, "from the plateaus", 1).drawn(Stroke::Dots),
            ],
        ),
        chart(
            "dissipated energy",
            "force x length",
            vec![curve(|all| Some(all.dissipated_energy), "W_d", 0)],
        ),
        chart("force amplitude", "force", vec![curve(|all| Some(all.force_amplitude), "Q*", 0)]),
        chart(
            "displacement amplitude",
            "length",
            vec![curve(|all| Some(all.displacement_amplitude), "at the actuator", 0)],
        ),
        chart("slope after reversal", "force/length", vec![curve(|all| all.slope, "slope", 0)]),
        chart(
            "energy ratio",
            "",
            vec![
                curve(|all| Some(all.energy_ratio), "A at the actuator", 0),
                curve(|all| all.contact_energy_ratio, "A of the contact", 1),
            ],
        ),
    ];
    let caption = in_words(found).map_or_else(
        || "What is read from the cycles.".to_owned(),
        |words| format!("What is read from the cycles: {words}. Friction is read in gross slip alone."),
    );
    html! {
        h2 { "Over the cycles" }
        p { (caption) }
        @for chart in charts.iter().flatten() {
            (chart.figure(&format!("{}.", chart.what)))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Judged cycle by cycle a test flickers where it changes from gross to partial slip; the one change that contradicts fewest cycles
    /// is told.
    #[test]
    fn a_change_is_told_once_where_single_cycles_flicker() {
        let mut judged: Vec<bool> = (0..400).map(|cycle| cycle < 200).collect();
        for flicker in [50, 185, 190, 191, 197, 203, 206, 350] {
            judged[flicker] = !judged[flicker];
        }
        let right: Vec<bool> = (0..400).map(|cycle| cycle < 200).collect();
        let found = smoothed(&judged);
        let wrong = found.iter().zip(&right).filter(|(found, right)| found != right).count();
        assert!(wrong <= 3, "{wrong}"); // the border itself is not known better than the cycles around it say
        assert_eq!(found.windows(2).filter(|pair| pair[0] != pair[1]).count(), 1);
    }

    #[test]
    fn long_stretches_are_kept_and_single_cycles_are_not() {
        let of = |text: &str| text.chars().map(|letter| letter == 's').collect::<Vec<bool>>();
        for (judged, right) in [
            ("", ""),
            ("s", "s"),
            ("pps", "ppp"),
            ("ssss", "ssss"),
            ("ssssssssssspsssssssss", "sssssssssssssssssssss"),
            ("sssssssssssspppppppppppppsssssssssssss", "sssssssssssspppppppppppppsssssssssssss"),
        ] {
            assert_eq!(smoothed(&of(judged)), of(right), "{judged}");
        }
    }
}
