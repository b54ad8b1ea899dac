//! The picture of a study: error over time, both logarithmic, as SVG that stands alone. On the left each kind of refinement with
//! its worst quantity of interest; on the right what reading the numbers between the cells, and extrapolating them, is worth.

use fret_core::model::Dimension;
use fret_core::study::{Form, Kind, Line, Quantity, RefinementStudy};
use maud::{Markup, html};

use crate::study::table::kind_name;
use fret_drawing::{Axis, Drawing, Frame, Label};

const PANEL: f64 = 420.0;
const RIGHT: f64 = 18.0;
/// Upper and lower edge of the plotting area.
const DOWN: [f64; 2] = [28.0, 280.0];
/// Height of a row of the legend.
const ROW: f64 = 17.0;

/// A line of points, from coarse to fine.
struct Curve {
    name: String,
    colour: usize,
    /// Time [s], error, and whether nothing beats it.
    points: Vec<([f64; 2], bool)>,
}

/// One set of axes.
struct Panel {
    title: &'static str,
    curves: Vec<Curve>,
}

/// The picture of judged lines.
pub fn picture(title: &str, dimension: Dimension, study: &RefinementStudy, lines: &[Line]) -> String {
    let panels: Vec<Panel> =
        [Some(kinds(study, lines)), readings(study, lines, dimension.area())].into_iter().flatten().collect();
    let rows = panels.iter().map(|panel| panel.curves.len()).max().unwrap_or(0);
    let content = html! {
        @for (number, panel) in panels.iter().enumerate() {
            g transform=(format!("translate({} 0)", PANEL * number as f64)) { (panel.drawn()) }
        }
    };
    let size = [PANEL * panels.len() as f64, DOWN[1] + 54.0 + ROW * rows as f64];
    Drawing { what: "error over time of every resolution".to_owned(), size, reading: None, content }
        .alone(&[title])
}

fn kinds(study: &RefinementStudy, lines: &[Line]) -> Panel {
    let curve = |line: &Line| {
        let points = line.levels.iter().filter_map(|judged| {
            let error = judged.errors.worst(Form::Between)?;
            let seconds = study.seconds(judged.place, Form::Between)?;
            Some(([seconds, error], judged.is_efficient[Form::Between as usize]))
        });
        Curve {
            name: format!("refined: {}", kind_name(line.kind)),
            colour: line.kind as usize,
            points: points.collect(),
        }
    };
    Panel {
        title: "largest error of the quantities of interest; ringed: efficient",
        curves: lines.iter().map(curve).collect(),
    }
}

fn readings(study: &RefinementStudy, lines: &[Line], area: &str) -> Option<Panel> {
    let line = lines.iter().find(|line| line.kind == Kind::Cells)?;
    let smooth: &[Quantity] = &[Quantity::MaxPressure, Quantity::Approach];
    let areas: &[Quantity] = &[Quantity::ContactArea, Quantity::StickArea];
    let readings = [
        (smooth, Form::Plain, "pressure and approach, cell values".to_owned()),
        (smooth, Form::Between, "the same, sub-cell reconstruction".to_owned()),
        (smooth, Form::Extrapolated, "the same, Richardson extrapolation".to_owned()),
        (areas, Form::Plain, format!("contact and stick {area} by counting cells")),
        (areas, Form::Between, "the same, sub-cell edge reconstruction".to_owned()),
    ];
    let mut curves: Vec<Curve> = readings
        .into_iter()
        .enumerate()
        .map(|(colour, (quantities, form, name))| {
            let points = line.levels.iter().filter_map(|judged| {
                let errors = judged.errors.of(form);
                let known = quantities.iter().filter_map(|quantity| errors[*quantity as usize]);
                Some(([study.seconds(judged.place, form)?, known.reduce(f64::max)?], false))
            });
            Curve { name, colour, points: points.collect() }
        })
        .collect();
    let (of_smooth, of_areas) = curves.split_at_mut(3);
    mark_frontier(of_smooth);
    mark_frontier(of_areas);
    Some(Panel { title: "cells refined: three ways to evaluate a quantity", curves })
}

/// Marks the points of some curves that no other one of them beats.
fn mark_frontier(curves: &mut [Curve]) {
    let all: Vec<[f64; 2]> =
        curves.iter().flat_map(|curve| curve.points.iter().map(|(point, _)| *point)).collect();
    for (point, is_efficient) in curves.iter_mut().flat_map(|curve| &mut curve.points) {
        *is_efficient = !all.iter().any(|other| {
            other[0] <= point[0] && other[1] <= point[1] && (other[0] < point[0] || other[1] < point[1])
        });
    }
}

impl Panel {
    fn drawn(&self) -> Markup {
        let points = |axis: usize| {
            self.curves.iter().flat_map(move |curve| curve.points.iter().map(move |(point, _)| point[axis]))
        };
        let axes = [Axis::logarithmic(points(0), 8), Axis::logarithmic(points(1), 8)];
        let frame = Frame::new(axes, PANEL - RIGHT, DOWN);
        let left = frame.across[0];
        let names = [Label::with("time", Some("s".to_owned())), Label::plain("relative error")];
        html! {
            text class="tick" x=(format!("{left:.1}")) y=(DOWN[0] - 12.0) { (self.title) }
            (frame.drawn([&names[0], &names[1]]))
            @for (number, curve) in self.curves.iter().enumerate() {
                @let all: Vec<[f64; 2]> = curve.points.iter().map(|(point, _)| *point).filter(|[seconds, error]| *seconds > 0.0 && *error > 0.0).collect();
                path class=(format!("line c{}", curve.colour)) d=(frame.path(&all)) {}
                @for (point, is_efficient) in &curve.points {
                    @for [x, y] in frame.places(&[*point]) {
                        circle class=(format!("dot c{}", curve.colour)) cx=(format!("{x:.1}")) cy=(format!("{y:.1}")) r="3" {}
                        @if *is_efficient { circle class="ring" cx=(format!("{x:.1}")) cy=(format!("{y:.1}")) r="7" {} }
                    }
                }
                @let at = DOWN[1] + 52.0 + ROW * number as f64;
                path class=(format!("line c{}", curve.colour)) d=(format!("M{left:.1} {at}h24")) {}
                circle class=(format!("dot c{}", curve.colour)) cx=(format!("{:.1}", left + 12.0)) cy=(at) r="3" {}
                text class="tick" x=(format!("{:.1}", left + 32.0)) y=(at + 4.0) { (curve.name) }
            }
        }
    }
}
