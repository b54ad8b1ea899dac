//! How well the equations were solved, and what it took.

use maud::{Markup, html};

use crate::figures::duration;
use crate::report::{Overview, chapter, joined, pairs, side_by_side};
use fret_drawing::{Chart, Curve, Label, Stroke};

/// Residuals and work.
pub fn convergence(view: &Overview<'_>) -> Markup {
    let history = &view.results.table;
    let curve = |name: &str, stroke: Stroke| {
        vec![Curve::plain(joined(history.column("increment"), history.column(name))).drawn(stroke)]
    };
    let axes = |name: &str| [Label::plain("increment"), Label::plain(name)];
    let tolerance = view.results.record.tolerance;
    let residual = Chart {
        logarithmic: true,
        level: Some((tolerance, "tolerance".to_owned())),
        ..Chart::new("residual of every increment", axes("residual"), curve("residual", Stroke::Dots))
    };
    let work = Chart::new(
        "convolutions of every increment",
        axes("convolutions"),
        curve("convolutions", Stroke::Line),
    );
    let sum = |name: &str| history.column(name).iter().sum::<f64>();
    let rows = [
        ("convolutions in all", sum("convolutions").to_string()),
        ("preconditioner passes", sum("preconditioner_passes").to_string()),
        ("changes of the zones", sum("outer_iterations").to_string()),
        ("time in increments", duration(sum("wall_s"))),
    ];
    let figures = [
        residual.figure("How well every increment satisfies its equations, relative and dimensionless."),
        work.figure("Applications of the elastic operator: the work, independent of the machine."),
    ];
    chapter("Convergence", &html! { (side_by_side(&figures)) (pairs(rows)) })
}
