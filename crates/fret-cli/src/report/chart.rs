//! A line chart as SVG text. Colours are names of the page's style sheet, so that a chart follows light and dark.

use std::fmt::Write;

use super::html::escaped;
use super::scale::Axis;

/// Size of a chart in the units of its drawing.
const WIDTH: f64 = 560.0;
const HEIGHT: f64 = 330.0;
/// Room left of, right of, above and below the plotting area.
const LEFT: f64 = 62.0;
const RIGHT: f64 = 14.0;
const TOP: f64 = 12.0;
const BOTTOM: f64 = 46.0;
/// Points nearer to each other than this are drawn as one.
const NEAR: f64 = 0.25;

/// How a curve is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stroke {
    /// What was computed.
    Line,
    /// What was computed earlier, in the background.
    Faint,
    /// A closed form.
    Dashed,
    /// Computed values one by one.
    Dots,
}

/// One curve.
#[derive(Debug, Clone)]
pub struct Curve {
    /// Its points; a point that is no number breaks the line.
    pub points: Vec<[f64; 2]>,
    /// Its words in the legend; none: it is not named.
    pub name: Option<String>,
    /// Which of the colours of the page, from 0.
    pub colour: usize,
    /// How it is drawn.
    pub stroke: Stroke,
}

/// A chart.
#[derive(Debug, Clone)]
pub struct Chart {
    /// What it shows, for those who cannot see it.
    pub what: String,
    /// Names of the axes.
    pub axes: [String; 2],
    /// The curves, the first at the bottom.
    pub curves: Vec<Curve>,
    /// Whether the vertical axis is logarithmic.
    pub logarithmic: bool,
    /// A level that is drawn across, with its name.
    pub level: Option<(f64, String)>,
}

impl Chart {
    /// The chart as SVG.
    pub fn svg(&self) -> String {
        let points = || self.curves.iter().flat_map(|curve| &curve.points);
        let x = Axis::linear(points().map(|point| point[0]), 7);
        let heights = points().map(|point| point[1]).chain(self.level.iter().map(|(level, _)| *level));
        let y = if self.logarithmic { Axis::logarithmic(heights, 7) } else { Axis::linear(heights, 6) };
        let frame = Frame { x, y };
        let mut svg = format!(
            "<svg viewBox=\"0 0 {WIDTH} {HEIGHT}\" role=\"img\" aria-label=\"{}\">\n",
            escaped(&self.what)
        );
        frame.draw(&mut svg, &self.axes);
        if let Some((level, _)) = &self.level {
            let height = frame.y_of(*level);
            let (from, to) = (LEFT, WIDTH - RIGHT);
            let _ = writeln!(svg, "<path class=\"level\" d=\"M{from} {height:.1}H{to}\"/>");
        }
        for curve in &self.curves {
            frame.draw_curve(&mut svg, curve);
        }
        svg.push_str("</svg>\n");
        svg + &self.legend()
    }

    /// The names of the curves and of the level, as text under the chart, where they lie over no point.
    fn legend(&self) -> String {
        let mut named: Vec<String> = self
            .curves
            .iter()
            .filter_map(|curve| {
                let name = curve.name.as_ref()?;
                let class = class_of(curve.stroke);
                let mark = if curve.stroke == Stroke::Dots {
                    format!("<circle class=\"{class} c{}\" cx=\"13\" cy=\"5\" r=\"2.6\"/>", curve.colour)
                } else {
                    format!("<path class=\"{class} c{}\" d=\"M1 5H25\"/>", curve.colour)
                };
                Some(format!(
                    "<li><svg viewBox=\"0 0 26 10\" class=\"key\">{mark}</svg>{}</li>",
                    escaped(name)
                ))
            })
            .collect();
        if let Some((_, name)) = &self.level {
            named.push(format!(
                "<li><svg viewBox=\"0 0 26 10\" class=\"key\"><path class=\"level\" d=\"M1 5H25\"/></svg>{}</li>",
                escaped(name)
            ));
        }
        if named.is_empty() {
            String::new()
        } else {
            format!("<ul class=\"legend\">{}</ul>\n", named.concat())
        }
    }
}

fn class_of(stroke: Stroke) -> &'static str {
    match stroke {
        Stroke::Line => "line",
        Stroke::Faint => "line faint",
        Stroke::Dashed => "line dashed",
        Stroke::Dots => "dot",
    }
}

/// The axes and the area between them.
struct Frame {
    x: Axis,
    y: Axis,
}

impl Frame {
    fn x_of(&self, value: f64) -> f64 {
        LEFT + self.x.place(value) * (WIDTH - LEFT - RIGHT)
    }

    fn y_of(&self, value: f64) -> f64 {
        HEIGHT - BOTTOM - self.y.place(value) * (HEIGHT - TOP - BOTTOM)
    }

    fn draw(&self, svg: &mut String, names: &[String; 2]) {
        let (bottom, right) = (HEIGHT - BOTTOM, WIDTH - RIGHT);
        for (value, word) in &self.x.ticks {
            let x = self.x_of(*value);
            let _ = writeln!(svg, "<path class=\"grid\" d=\"M{x:.1} {TOP}V{bottom}\"/>");
            let below = bottom + 16.0;
            let _ = writeln!(
                svg,
                "<text class=\"tick\" x=\"{x:.1}\" y=\"{below}\" text-anchor=\"middle\">{word}</text>"
            );
        }
        for (value, word) in &self.y.ticks {
            let y = self.y_of(*value);
            let _ = writeln!(svg, "<path class=\"grid\" d=\"M{LEFT} {y:.1}H{right}\"/>");
            let (beside, middle) = (LEFT - 7.0, y + 4.0);
            let _ = writeln!(
                svg,
                "<text class=\"tick\" x=\"{beside}\" y=\"{middle:.1}\" text-anchor=\"end\">{word}</text>"
            );
        }
        for (axis, zero) in [(&self.x, 0), (&self.y, 1)] {
            if axis.range[0] < 0.0 && axis.range[1] > 0.0 && !axis.logarithmic {
                let line = if zero == 0 {
                    format!("M{:.1} {TOP}V{bottom}", self.x_of(0.0))
                } else {
                    format!("M{LEFT} {:.1}H{right}", self.y_of(0.0))
                };
                let _ = writeln!(svg, "<path class=\"zero\" d=\"{line}\"/>");
            }
        }
        let _ = writeln!(svg, "<path class=\"frame\" d=\"M{LEFT} {TOP}V{bottom}H{right}\"/>");
        let middle = 0.5 * (LEFT + right);
        let _ = writeln!(
            svg,
            "<text class=\"axis\" x=\"{middle}\" y=\"{}\" text-anchor=\"middle\">{}</text>",
            HEIGHT - 8.0,
            escaped(&self.x.named(&names[0]))
        );
        let middle = 0.5 * (TOP + bottom);
        let _ = writeln!(
            svg,
            "<text class=\"axis\" transform=\"translate(14 {middle}) rotate(-90)\" text-anchor=\"middle\">{}</text>",
            escaped(&self.y.named(&names[1]))
        );
    }

    fn draw_curve(&self, svg: &mut String, curve: &Curve) {
        let is_seen = |point: &[f64; 2]| {
            point.iter().all(|value| value.is_finite()) && (point[1] > 0.0 || !self.y.logarithmic)
        };
        let class = class_of(curve.stroke);
        let mut path = String::new();
        let mut last: Option<[f64; 2]> = None;
        let count = curve.points.len();
        for (number, point) in curve.points.iter().enumerate() {
            if !is_seen(point) {
                last = None;
                continue;
            }
            let at = [self.x_of(point[0]), self.y_of(point[1])];
            if curve.stroke == Stroke::Dots {
                let _ = writeln!(
                    svg,
                    "<circle class=\"{class} c{}\" cx=\"{:.1}\" cy=\"{:.1}\" r=\"2.2\"/>",
                    curve.colour, at[0], at[1]
                );
                continue;
            }
            let is_near = last.is_some_and(|last| (last[0] - at[0]).hypot(last[1] - at[1]) < NEAR);
            if is_near && number + 1 < count {
                continue;
            }
            let _ = write!(path, "{}{:.1} {:.1}", if last.is_some() { 'L' } else { 'M' }, at[0], at[1]);
            last = Some(at);
        }
        if !path.is_empty() {
            let _ = writeln!(svg, "<path class=\"{class} c{}\" d=\"{path}\"/>", curve.colour);
        }
    }
}
