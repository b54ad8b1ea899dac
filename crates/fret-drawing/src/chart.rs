//! A line chart. Colours are names of the style sheet, so that a chart follows light and dark.

use maud::{Markup, html};

use crate::drawn::Drawing;
use crate::frame::Frame;
use crate::scale::{Axis, Label};

/// Size of a chart: narrow, so that its words are still read on a telephone.
const WIDTH: f64 = 400.0;
const HEIGHT: f64 = 270.0;
const RIGHT: f64 = 18.0;
const TOP: f64 = 20.0;
const BOTTOM: f64 = 45.0;
/// Curves of more points are drawn by their highest and lowest ones in strips of this width.
const MANY: usize = 2000;
const STRIP: f64 = 0.5;

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
    /// By what a script finds it.
    pub id: Option<&'static str>,
}

impl Curve {
    /// A line with a name.
    pub fn line(points: Vec<[f64; 2]>, name: &str, colour: usize) -> Self {
        Self { points, name: Some(name.to_owned()), colour, stroke: Stroke::Line, id: None }
    }

    /// A line without a name.
    pub fn plain(points: Vec<[f64; 2]>) -> Self {
        Self { name: None, ..Self::line(points, "", 0) }
    }

    /// The same curve, drawn in another way.
    #[must_use]
    pub fn drawn(self, stroke: Stroke) -> Self {
        Self { stroke, ..self }
    }

    /// The line, and its points as dots without a name.
    pub fn dotted(self) -> Vec<Self> {
        let dots = Self { name: None, ..self.clone() }.drawn(Stroke::Dots);
        vec![self, dots]
    }

    /// A dashed line with a name: a closed form.
    pub fn dashed(points: Vec<[f64; 2]>, name: &str, colour: usize) -> Self {
        Self::line(points, name, colour).drawn(Stroke::Dashed)
    }
}

/// A chart.
#[derive(Debug, Clone)]
pub struct Chart {
    /// What it shows, for those who cannot see it.
    pub what: String,
    /// Names of the axes.
    pub axes: [Label; 2],
    /// The curves, the first at the bottom.
    pub curves: Vec<Curve>,
    /// Whether the vertical axis is logarithmic.
    pub logarithmic: bool,
    /// A level that is drawn across, with its name.
    pub level: Option<(f64, String)>,
    /// Ranges of the axes where they are not those of the curves.
    pub ranges: [Option<[f64; 2]>; 2],
    /// A point that moves, by what a script finds it.
    pub here: Option<([f64; 2], &'static str)>,
}

impl Chart {
    /// A chart of curves over straight axes.
    pub fn new(what: &str, axes: [Label; 2], curves: Vec<Curve>) -> Self {
        Self {
            what: what.to_owned(),
            axes,
            curves,
            logarithmic: false,
            level: None,
            ranges: [None; 2],
            here: None,
        }
    }

    /// A chart over the increments of a history.
    pub fn over_increments(what: &str, label: Label, curves: Vec<Curve>) -> Self {
        Self::new(&format!("{what} over the increments"), [Label::plain("increment"), label], curves)
    }

    /// The area that its curves are drawn in.
    pub fn frame(&self) -> Frame {
        let points = || self.curves.iter().flat_map(|curve| &curve.points);
        let axis = |direction: usize, ticks: usize| match self.ranges[direction] {
            Some(range) => Axis::linear(range.into_iter(), ticks),
            None => Axis::linear(points().map(|point| point[direction]), ticks),
        };
        let heights = || points().map(|point| point[1]).chain(self.level.iter().map(|(level, _)| *level));
        let y = if self.logarithmic {
            Axis::logarithmic(heights(), 6)
        } else if self.ranges[1].is_some() {
            axis(1, 5)
        } else {
            Axis::linear(heights(), 5)
        };
        Frame::new([axis(0, 6), y], WIDTH - RIGHT, [TOP, HEIGHT - BOTTOM])
    }

    /// The chart with the names of its curves below it.
    pub fn in_page(&self) -> Markup {
        html! { (self.drawing().in_page()) (self.legend()) }
    }

    /// The chart as a figure with its caption.
    pub fn figure(&self, caption: &str) -> Markup {
        Drawing::captioned(&self.in_page(), caption)
    }

    /// The chart alone.
    pub fn drawing(&self) -> Drawing {
        let frame = self.frame();
        let content = html! {
            (frame.drawn([&self.axes[0], &self.axes[1]]))
            @if let Some((level, _)) = &self.level {
                path class="level" d=(format!("M{:.1} {:.1}H{}", frame.across[0], frame.y_of(*level), frame.across[1])) {}
            }
            @for curve in &self.curves { (drawn(&frame, curve)) }
            @if let Some((at, id)) = self.here {
                circle class="here" id=(id) r="5" cx=(format!("{:.1}", frame.x_of(at[0]))) cy=(format!("{:.1}", frame.y_of(at[1]))) {}
            }
        };
        Drawing { what: self.what.clone(), size: [WIDTH, HEIGHT], reading: Some(frame.reading()), content }
    }

    /// The names of the curves and of the level, as text under the chart, where they lie over no point.
    fn legend(&self) -> Markup {
        let named = self.curves.iter().filter_map(|curve| Some((curve.name.as_ref()?, curve)));
        let has_any = self.level.is_some() || self.curves.iter().any(|curve| curve.name.is_some());
        html! {
            @if has_any {
                ul class="legend" {
                    @for (name, curve) in named {
                        li {
                            svg viewBox="0 0 26 10" class="key" aria-hidden="true" {
                                @if is_dotted(curve) {
                                    circle class=(format!("dot c{}", curve.colour)) cx="13" cy="5" r="2.6" {}
                                } @else {
                                    path class=(class_of(curve)) d="M1 5H25" {}
                                }
                            }
                            (name)
                        }
                    }
                    @if let Some((_, name)) = &self.level {
                        li { svg viewBox="0 0 26 10" class="key" aria-hidden="true" { path class="level" d="M1 5H25" {} } (name) }
                    }
                }
            }
        }
    }
}

/// Whether a curve is points: because it shall be, or because it has but one.
fn is_dotted(curve: &Curve) -> bool {
    curve.stroke == Stroke::Dots || (curve.points.len() == 1 && curve.stroke != Stroke::Faint)
}

fn class_of(curve: &Curve) -> String {
    let stroke = match curve.stroke {
        Stroke::Line => "line",
        Stroke::Faint => "line faint",
        Stroke::Dashed => "line dashed",
        Stroke::Dots => "dot",
    };
    format!("{stroke} c{}", curve.colour)
}

fn drawn(frame: &Frame, curve: &Curve) -> Markup {
    let points = thinned(frame, &curve.points);
    let path = frame.path(&points);
    // what does not move is one point
    let is_still = !path.is_empty() && !path.contains('L') && curve.id.is_none();
    html! {
        @if is_dotted(curve) || is_still {
            @for [x, y] in frame.places(&points).into_iter().take(if is_still { 1 } else { usize::MAX }) {
                circle class=(format!("dot c{}", curve.colour)) cx=(format!("{x:.1}")) cy=(format!("{y:.1}")) r="2.2" {}
            }
        } @else if !path.is_empty() || curve.id.is_some() {
            path class=(class_of(curve)) id=[curve.id] d=(path) {}
        }
    }
}

/// Of many points that go from left to right those that can be seen: the lowest and the highest of every strip, in their order.
fn thinned(frame: &Frame, points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    if points.len() < MANY || points.windows(2).any(|pair| pair[1][0] < pair[0][0]) {
        return points.to_vec();
    }
    let strip = |point: &[f64; 2]| (frame.x_of(point[0]) / STRIP) as i64;
    let ends = |strip: &[[f64; 2]]| {
        let order = |a: &(usize, &[f64; 2]), b: &(usize, &[f64; 2])| a.1[1].total_cmp(&b.1[1]);
        let of = || strip.iter().enumerate();
        let [low, high] =
            [of().min_by(order), of().max_by(order)].map(|end| end.map_or(0, |(place, _)| place));
        let mut kept = vec![low.min(high), low.max(high)];
        kept.dedup();
        kept.into_iter().map(|place| strip[place]).collect::<Vec<_>>()
    };
    points.chunk_by(|a, b| strip(a) == strip(b)).flat_map(ends).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_many_points_the_highest_and_the_lowest_stay() {
        let mut points: Vec<[f64; 2]> = (0..20_000).map(|n| [f64::from(n), f64::from(n % 20)]).collect();
        points[7_777][1] = 100.0;
        points[12_345][1] = -50.0;
        let chart =
            Chart::new("", [Label::plain("x"), Label::plain("y")], vec![Curve::line(points.clone(), "", 0)]);
        let left = thinned(&chart.frame(), &points);
        assert!(
            left.len() < 2 * 800 && left.contains(&points[7_777]) && left.contains(&points[12_345]),
            "{}",
            left.len()
        );
        assert!(left.windows(2).all(|pair| pair[0][0] < pair[1][0]));
    }

    #[test]
    fn one_point_is_seen() {
        let chart = Chart::new(
            "",
            [Label::plain("x"), Label::plain("y")],
            vec![Curve::line(vec![[1.0, 2.0]], "one", 0)],
        );
        assert!(chart.drawing().content.into_string().contains("<circle class=\"dot c0\""));
    }
}
