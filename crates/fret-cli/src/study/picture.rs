//! The picture of a study: error over time, both logarithmic, as SVG that stands alone. On the left each kind of refinement with
//! its worst quantity of interest; on the right what reading the numbers between the cells, and extrapolating them, is worth.

use std::fmt::Write;

use fret_core::study::{Form, Kind, Line, Quantity, RefinementStudy};

use crate::report::html::escaped;
use crate::report::scale::Axis;
use crate::study::table::kind_name;

const PANEL: f64 = 470.0;
const HEIGHT: f64 = 440.0;
const LEFT: f64 = 62.0;
const RIGHT: f64 = 16.0;
const TOP: f64 = 62.0;
const BOTTOM: f64 = 144.0;
/// Height of a row of the legend.
const ROW: f64 = 18.0;
const COLOURS: [&str; 5] = ["#1f5a93", "#b4452c", "#2c7a4b", "#8a5a9e", "#b07d12"];
/// A line of points, from coarse to fine.
struct Curve {
    name: String,
    colour: &'static str,
    /// Time [s], error, and whether nothing beats it.
    points: Vec<([f64; 2], bool)>,
}

/// One set of axes.
struct Panel {
    title: String,
    curves: Vec<Curve>,
}

/// The picture of judged lines.
pub fn picture(title: &str, study: &RefinementStudy, lines: &[Line]) -> String {
    let panels: Vec<Panel> =
        [Some(kinds(study, lines)), readings(study, lines)].into_iter().flatten().collect();
    let width = PANEL * panels.len() as f64;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {HEIGHT}\" width=\"{width}\" height=\"{HEIGHT}\" \
         font-family=\"system-ui, 'DejaVu Sans', sans-serif\" font-size=\"12\" fill=\"#23241f\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n<text x=\"{LEFT}\" y=\"22\" font-size=\"15\">{}</text>\n",
        escaped(title)
    );
    for (number, panel) in panels.iter().enumerate() {
        let _ = writeln!(svg, "<g transform=\"translate({} 0)\">", PANEL * number as f64);
        panel.draw(&mut svg);
        svg.push_str("</g>\n");
    }
    svg + "</svg>\n"
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
            colour: COLOURS[line.kind as usize],
            points: points.collect(),
        }
    };
    Panel {
        title: "largest error of the quantities of interest; ringed: efficient frontier".to_owned(),
        curves: lines.iter().map(curve).collect(),
    }
}

fn readings(study: &RefinementStudy, lines: &[Line]) -> Option<Panel> {
    let line = lines.iter().find(|line| line.kind == Kind::Cells)?;
    let smooth: &[Quantity] = &[Quantity::MaxPressure, Quantity::Approach];
    let areas: &[Quantity] = &[Quantity::ContactArea, Quantity::StickArea];
    let readings = [
        (smooth, Form::Plain, "pressure and approach, cell values"),
        (smooth, Form::Between, "the same, sub-cell reconstruction"),
        (smooth, Form::Extrapolated, "the same, Richardson extrapolation"),
        (areas, Form::Plain, "contact and stick area by counting cells"),
        (areas, Form::Between, "the same, sub-cell edge reconstruction"),
    ];
    let mut curves: Vec<Curve> = readings
        .into_iter()
        .zip(COLOURS)
        .map(|((quantities, form, name), colour)| {
            let points = line.levels.iter().filter_map(|judged| {
                let errors = judged.errors.of(form);
                let known = quantities.iter().filter_map(|quantity| errors[*quantity as usize]);
                Some(([study.seconds(judged.place, form)?, known.reduce(f64::max)?], false))
            });
            Curve { name: name.to_owned(), colour, points: points.collect() }
        })
        .collect();
    let (of_smooth, of_areas) = curves.split_at_mut(3);
    mark_frontier(of_smooth);
    mark_frontier(of_areas);
    let title = "cells refined: three ways to evaluate a quantity".to_owned();
    Some(Panel { title, curves })
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
    fn draw(&self, svg: &mut String) {
        let points = || self.curves.iter().flat_map(|curve| curve.points.iter().map(|(point, _)| *point));
        let x = Axis::logarithmic(points().map(|point| point[0]), 8);
        let y = Axis::logarithmic(points().map(|point| point[1]), 8);
        let (bottom, right) = (HEIGHT - BOTTOM, PANEL - RIGHT);
        let x_of = |value: f64| LEFT + x.place(value) * (right - LEFT);
        let y_of = |value: f64| bottom - y.place(value) * (bottom - TOP);
        let _ = writeln!(
            svg,
            "<text x=\"{LEFT}\" y=\"{}\" fill=\"#6d6c64\">{}</text>",
            TOP - 14.0,
            escaped(&self.title)
        );
        for (value, word) in &x.ticks {
            let at = x_of(*value);
            let _ = writeln!(svg, "<path d=\"M{at:.1} {TOP}V{bottom}\" stroke=\"#e4e1d6\" fill=\"none\"/>");
            let _ = writeln!(
                svg,
                "<text x=\"{at:.1}\" y=\"{}\" text-anchor=\"middle\">{word}</text>",
                bottom + 17.0
            );
        }
        for (value, word) in &y.ticks {
            let at = y_of(*value);
            let _ = writeln!(svg, "<path d=\"M{LEFT} {at:.1}H{right}\" stroke=\"#e4e1d6\" fill=\"none\"/>");
            let _ = writeln!(
                svg,
                "<text x=\"{}\" y=\"{:.1}\" text-anchor=\"end\">{word}</text>",
                LEFT - 7.0,
                at + 4.0
            );
        }
        let _ =
            writeln!(svg, "<path d=\"M{LEFT} {TOP}V{bottom}H{right}\" stroke=\"#6d6c64\" fill=\"none\"/>");
        let middle = 0.5 * (LEFT + right);
        let _ = writeln!(
            svg,
            "<text x=\"{middle}\" y=\"{}\" text-anchor=\"middle\">time [s]</text>",
            bottom + 35.0
        );
        let middle = 0.5 * (TOP + bottom);
        let _ = writeln!(
            svg,
            "<text transform=\"translate(15 {middle}) rotate(-90)\" text-anchor=\"middle\">relative error</text>"
        );
        for (number, curve) in self.curves.iter().enumerate() {
            let seen = curve.points.iter().filter(|([seconds, error], _)| *seconds > 0.0 && *error > 0.0);
            let mut path = String::new();
            let mut marks = String::new();
            for ([seconds, error], is_efficient) in seen {
                let (a, b) = (x_of(*seconds), y_of(*error));
                let _ = write!(path, "{}{a:.1} {b:.1}", if path.is_empty() { 'M' } else { 'L' });
                let _ = writeln!(
                    marks,
                    "<circle cx=\"{a:.1}\" cy=\"{b:.1}\" r=\"3\" fill=\"{}\"/>",
                    curve.colour
                );
                if *is_efficient {
                    let _ = writeln!(
                        marks,
                        "<circle cx=\"{a:.1}\" cy=\"{b:.1}\" r=\"7\" fill=\"none\" stroke=\"#23241f\" stroke-width=\"1.2\"/>"
                    );
                }
            }
            let _ = writeln!(
                svg,
                "<path d=\"{path}\" stroke=\"{}\" stroke-width=\"1.7\" fill=\"none\"/>\n{marks}",
                curve.colour
            );
            let at = bottom + 52.0 + ROW * number as f64;
            let _ = writeln!(
                svg,
                "<path d=\"M{LEFT} {at}h24\" stroke=\"{}\" stroke-width=\"1.7\"/><circle cx=\"{}\" cy=\"{at}\" r=\"3\" fill=\"{}\"/><text x=\"{}\" y=\"{}\">{}</text>",
                curve.colour,
                LEFT + 12.0,
                curve.colour,
                LEFT + 32.0,
                at + 4.0,
                escaped(&curve.name)
            );
        }
    }
}
