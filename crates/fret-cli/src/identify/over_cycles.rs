//! A test over its cycles: curves of what is read from them, and where the sliding condition changes.

use fret_core::identify::{Cycle, Identification, Quantities, Span};
use maud::{Markup, html};

use crate::loop_numbers::regime;
use fret_drawing::{Chart, Curve, Label, Stroke};

/// Fewest cycles of a test that curves are drawn of.
const FEWEST: usize = 3;

/// The conditions of a test in words; nothing of a single cycle.
pub fn in_words(found: &Identification) -> Option<String> {
    let told = |Span { from, to, sliding_condition }: Span| {
        let words = regime(sliding_condition);
        if from == to {
            format!("{words} in cycle {from}")
        } else {
            format!("{words} in cycles {from} to {to}")
        }
    };
    let spans: Vec<String> = found.sliding_conditions().into_iter().map(told).collect();
    (found.cycles.len() > 1 && !spans.is_empty()).then(|| spans.join(", "))
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
