//! What changes from cycle to cycle, over the number of the cycle.

use fret_core::history::CycleRecord;
use maud::{Markup, html};

use crate::drawing::chart::{Chart, Curve};
use crate::drawing::scale::Label;
use crate::report::html::{chapter, figure_of, side_by_side};
use crate::report::overview::Overview;

/// With fewer cycles there is nothing to see over their number.
const FEWEST: usize = 3;
/// What changes by less than this fraction of itself over the cycles does not change.
const SEEN: f64 = 1e-6;

/// Quantities of the cycles over their number.
pub fn cycles(view: &Overview<'_>) -> Markup {
    let cycles = &view.results.cycles;
    if cycles.len() < FEWEST {
        return html! {};
    }
    let numbers = numbers(cycles);
    let points = |value: &dyn Fn(&CycleRecord) -> f64| -> Vec<[f64; 2]> {
        numbers.iter().zip(cycles).map(|(number, cycle)| [*number, value(cycle)]).collect()
    };
    let chart = |name: &str, kind: &str, value: &dyn Fn(&CycleRecord) -> f64| {
        let label = if kind.is_empty() { Label::plain(name) } else { view.label(name, kind) };
        let curve = Curve { name: None, ..Curve::line(points(value), "", 0) };
        Chart::new(&format!("{name} over the cycles"), [Label::plain("cycle"), label], vec![curve])
    };
    let twists = view.twists;
    let (force, motion) = if twists {
        ("moment amplitude", "rotation amplitude")
    } else {
        ("force amplitude Q*", "displacement amplitude δ*")
    };
    let [of_force, of_motion] = if twists { ["force x length", "rad"] } else { ["force", "length"] };
    let mut figures = vec![figure_of(
        &chart("dissipated energy", "force x length", &|cycle| cycle.dissipated_energy).in_page(),
        "Dissipated energy of each computed cycle.",
    )];
    for (name, kind, value) in [
        (force, of_force, (|cycle| cycle.force_amplitude) as fn(&CycleRecord) -> f64),
        (motion, of_motion, |cycle| cycle.displacement_amplitude),
    ] {
        let values: Vec<f64> = cycles.iter().map(value).collect();
        let [low, high] = values
            .iter()
            .fold([f64::INFINITY, 0.0_f64], |[low, high], value| [low.min(*value), high.max(*value)]);
        if high - low > SEEN * high {
            figures.push(figure_of(&chart(name, kind, &value).in_page(), &format!("{name} of each cycle.")));
        }
    }
    let ratio = chart("energy ratio A", "", &|cycle| cycle.energy_ratio.unwrap_or(f64::NAN));
    figures.push(figure_of(
        &ratio.in_page(),
        "Energy ratio A = W_d / (4 Q* δ*); 0.2 is the transition to gross slip of a sphere.",
    ));
    let change = Chart { logarithmic: true, ..chart("cycle-to-cycle change", "", &|cycle| cycle.closure) };
    figures.push(figure_of(
        &change.in_page(),
        "Change of tractions and motions from the start of a cycle to its end, relative.",
    ));
    if view.results.case().friction_evolution.is_some() {
        figures.push(figure_of(
            &chart("friction coefficient", "", &|cycle| cycle.friction_coefficient).in_page(),
            "Mean friction coefficient over the contact, weighted with the pressure.",
        ));
    }
    if view.results.case().wear.is_some() {
        figures.push(figure_of(
            &chart("wear volume", "length^3", &|cycle| cycle.worn_volume).in_page(),
            "Wear volume since the start.",
        ));
        figures.push(figure_of(
            &chart("max wear depth", "length", &|cycle| cycle.max_worn_depth).in_page(),
            "Maximum wear depth.",
        ));
    }
    chapter("From cycle to cycle", &side_by_side(&figures))
}

/// Number of each cycle in the whole history, where a computed one stands for several that of the last of them.
fn numbers(cycles: &[CycleRecord]) -> Vec<f64> {
    let mut before = 0;
    let mut last: Option<&CycleRecord> = None;
    let mut numbers = Vec::with_capacity(cycles.len());
    for cycle in cycles {
        if let Some(last) = last.filter(|last| last.stage != cycle.stage) {
            before += last.last_cycle;
        }
        numbers.push((before + cycle.last_cycle) as f64);
        last = Some(cycle);
    }
    numbers
}
