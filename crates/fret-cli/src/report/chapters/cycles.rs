//! What changes from cycle to cycle, over the number of the cycle.

use fret_core::history::CycleRecord;
use maud::{Markup, html};

use crate::report::{Measured, Overview, chapter, side_by_side};
use fret_drawing::{Axis, Chart, Curve, Label};

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
        let axes = [Label::plain("cycle"), view.label(name, kind)];
        Chart::new(&format!("{name} over the cycles"), axes, vec![Curve::plain(points(value))])
    };
    let energy = chart("dissipated energy", "force x length", &|cycle| cycle.dissipated_energy);
    let mut figures = vec![energy.figure("Dissipated energy of each computed cycle.")];
    let amplitudes = if view.twists {
        [("moment amplitude", "force x length"), ("rotation amplitude", "rad")]
    } else {
        [("force amplitude Q*", "force"), ("displacement amplitude δ*", "length")]
    };
    let reads: [fn(&CycleRecord) -> f64; 2] =
        [|cycle| cycle.force_amplitude, |cycle| cycle.displacement_amplitude];
    for ((name, kind), value) in amplitudes.into_iter().zip(reads) {
        let [low, high] = Axis::ends(cycles.iter().map(value));
        if high - low > SEEN * high {
            figures.push(chart(name, kind, &value).figure(&format!("{name} of each cycle.")));
        }
    }
    let ratio = chart("energy ratio A", "", &|cycle| cycle.energy_ratio.unwrap_or(f64::NAN));
    figures.push(
        ratio.figure("Energy ratio A = W_d / (4 Q* δ*); 0.2 is the transition to gross slip of a sphere."),
    );
    let change = Chart { logarithmic: true, ..chart("cycle-to-cycle change", "", &|cycle| cycle.closure) };
    let caption = "Change of tractions and motions from the start of a cycle to its end, relative.";
    figures.push(change.figure(caption));
    if view.results.case().friction_evolution.is_some() {
        let friction = chart("friction coefficient", "", &|cycle| cycle.friction_coefficient);
        let caption = "Mean friction coefficient over the contact, weighted with the pressure.";
        figures.push(friction.figure(caption));
    }
    if view.results.case().wear.is_some() {
        let volume = chart("wear volume", "length^3", &|cycle| cycle.worn_volume);
        let depth = chart("max wear depth", "length", &|cycle| cycle.max_worn_depth);
        figures.push(volume.figure("Wear volume since the start."));
        figures.push(depth.figure("Maximum wear depth."));
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
