//! The page of an identification: the measured loop beside the computed one, the loops of all cycles, what was found.

use fret_core::identify::{Constant, Cycle, Identification, MeasuredCycle};
use maud::{Markup, html};

use super::constant::cells;
use super::table::{COLUMNS, Column};
use super::{over_cycles, repeated};
use crate::report::{number, table, whole_page};
use fret_drawing::{Axis, Chart, Curve, Label, Stroke};

/// Loops that the stack shows, at the most.
const MOST_LOOPS: usize = 40;

/// Columns of the table of cycles that are in `cycles.csv` alone.
const NOT_ON_THE_PAGE: [&str; 3] = ["points", "contact_sliding_ratio", "slope_after_reversal"];

/// The page.
pub fn page(found: &Identification) -> String {
    let title = format!("Fretting loops of {}", found.log);
    let units = [("displacement", found.units.length.clone()), ("tangential force", found.unit_of("force"))];
    let axes = units.map(|(name, unit)| Label::with(name, Some(unit)));
    let content = html! {
        h1 { (title) }
        (constants(found))
        (beside(found, axes.clone()).figure("Measured points without offset and drift, and the loop that the solver computes; dashed: the loop of the contact itself."))
        @if found.cycles.len() > 1 {
            (stack(found, axes).figure("Fretting log: the loops one after the other, each moved to the right and up; the first at the bottom."))
        }
        (over_cycles::figures(found))
        (repeated::figures(found))
        (rows(found))
        ul { @for note in &found.notes { li { (note) } } }
    };
    whole_page(&title, &content)
}

fn constants(found: &Identification) -> Markup {
    let row =
        |constant: &Constant| cells(constant).into_iter().chain([found.units.of(constant.unit)]).collect();
    let rows: Vec<Vec<String>> = found.constants.iter().map(row).collect();
    table(&["constant", "value", "95 % from", "to", "unit"], &rows)
}

fn beside(found: &Identification, axes: [Label; 2]) -> Chart {
    let computed = |along: usize| -> Vec<[f64; 2]> {
        found.computed.iter().map(|point| [point[along], point[1]]).collect()
    };
    Chart::new(
        "measured and computed fretting loop",
        axes,
        vec![
            Curve::line(found.points(), "measured", 1).drawn(Stroke::Dots),
            Curve::line(computed(0), "computed, at the actuator", 0),
            Curve::dashed(computed(2), "computed, the contact's own", 2),
        ],
    )
}

/// The loops of a log, each moved on by a part of the range.
fn stack(found: &Identification, axes: [Label; 2]) -> Chart {
    let cycles: Vec<&MeasuredCycle> =
        found.cycles.iter().map(|cycle| &cycle.measured).filter(|cycle| cycle.fault.is_none()).collect();
    let every = cycles.len().div_ceil(MOST_LOOPS).max(1);
    let range = |of: &dyn Fn(&MeasuredCycle) -> &[f64]| {
        let [low, high] = Axis::ends(cycles.iter().flat_map(|&cycle| of(cycle).iter().copied()));
        high - low
    };
    let (along, up) = (range(&|cycle| &cycle.displacement), range(&|cycle| &cycle.force));
    let shown: Vec<&MeasuredCycle> = cycles.iter().copied().step_by(every).collect();
    let curves = shown.iter().enumerate().map(|(k, cycle)| {
        let moved = 1.5 * k as f64 / shown.len() as f64;
        let points = cycle.displacement.iter().zip(&cycle.force);
        let mut points: Vec<[f64; 2]> = points.map(|(d, q)| [d + moved * along, q + moved * up]).collect();
        points.extend(points.first().copied());
        Curve::plain(points).drawn(if k + 1 == shown.len() { Stroke::Line } else { Stroke::Faint })
    });
    Chart::new("fretting log: loops of the cycles", axes, curves.collect())
}

fn rows(found: &Identification) -> Markup {
    let on_the_page = |column: &&Column| !NOT_ON_THE_PAGE.contains(&column.name);
    let columns: Vec<&Column> = COLUMNS.iter().filter(on_the_page).collect();
    let name = |column: &&Column| {
        let name = column.name.replace('_', " ");
        if column.unit.is_empty() { name } else { format!("{name} [{}]", found.unit_of(column.unit)) }
    };
    let head: Vec<String> = columns.iter().map(name).collect();
    let cell = |cycle: &Cycle, column: &Column| match (column.of)(cycle) {
        None => "–".to_owned(),
        Some(count) if column.counts() => count.to_string(),
        Some(value) => number(value),
    };
    let row = |cycle: &Cycle| columns.iter().map(|column| cell(cycle, column)).collect();
    let every = found.cycles.len().div_ceil(MOST_LOOPS).max(1);
    let rows: Vec<Vec<String>> = found.cycles.iter().step_by(every).map(row).collect();
    table(&head, &rows)
}
