//! Charts of a section through the contact in an increment, whose lines the slider moves.

use super::moment::{Ground, Moment};
use super::sections::seen;
use crate::figures::largest;
use crate::report::{Measured, joined};
use fret_drawing::{Axis, Chart, Curve, Frame, Stroke};

/// What is said of the surfaces.
const SURFACES: &str = "The surfaces along the same line, worn and not deformed, brought together until they touch on it; the upper one moves with \
                        its body.";

/// A line of a chart of the section, which the slider moves.
struct Line {
    /// Which chart: of pressure, of shear, of the surfaces.
    chart: usize,
    /// By what the script finds it.
    id: &'static str,
    name: Option<&'static str>,
    colour: usize,
    stroke: Stroke,
    /// Its values in an increment, where it has some.
    of: fn(&Moment) -> Option<Vec<f64>>,
}

impl Line {
    const fn new(
        (chart, id): (usize, &'static str),
        name: Option<&'static str>,
        (colour, stroke): (usize, Stroke),
        of: fn(&Moment) -> Option<Vec<f64>>,
    ) -> Self {
        Self { chart, id, name, colour, stroke, of }
    }
}

/// The shear, whose name says along what it is.
const SHEAR: &str = "shear-line";

/// All lines, the first of a chart at the bottom.
const LINES: [Line; 6] = [
    Line::new((0, "pressure-line"), None, (0, Stroke::Line), |now| Some(now.pressure.clone())),
    Line::new((1, "bound-above"), Some("± the friction bound"), (1, Stroke::Dashed), |now| {
        now.bound.clone()
    }),
    Line::new((1, "bound-below"), None, (1, Stroke::Dashed), |now| {
        Some(now.bound.as_ref()?.iter().map(|bound| -bound).collect())
    }),
    Line::new((1, SHEAR), None, (0, Stroke::Line), |now| Some(now.shear.clone())),
    Line::new((2, "lower-surface"), Some("lower body"), (0, Stroke::Line), |now| {
        now.surfaces.as_ref().map(|[lower, _]| lower.clone())
    }),
    Line::new((2, "upper-surface"), Some("upper body"), (1, Stroke::Line), |now| {
        now.surfaces.as_ref().map(|[_, upper]| upper.clone())
    }),
];

impl Ground<'_> {
    /// Charts of the section with their captions, by the numbers of [`LINES`]: pressure, shear with its bound, the surfaces.
    pub fn section_charts(&self, moments: &[Moment], now: &Moment) -> [Option<(Chart, &'static str)>; 3] {
        let all: Vec<&[f64]> = moments.iter().map(|moment| moment.pressure.as_slice()).collect();
        let along = &self.section.along;
        let x = seen(along, &all).map(|end| along[end]);
        let chart = |number: usize, what: &str, [name, kind]: [&str; 2], x: [f64; 2], y: [f64; 2]| {
            let curves = LINES.iter().filter(|line| line.chart == number).filter_map(|line| {
                let name = if line.id == SHEAR { Some(self.shear_name) } else { line.name };
                let points = joined(along, &(line.of)(now)?);
                let curve = Curve {
                    name: name.map(str::to_owned),
                    id: Some(line.id),
                    ..Curve::line(points, "", line.colour)
                };
                Some(curve.drawn(line.stroke))
            });
            let axes = [self.view.label(self.section.name(), "length"), self.view.label(name, kind)];
            let chart =
                Chart::new(&format!("{what} along a line through the contact"), axes, curves.collect());
            Chart { ranges: [Some(x), Some(y)], ..chart }
        };
        let high = all.iter().map(|values| largest(*values)).fold(0.0, f64::max);
        let pressure = chart(0, "pressure", ["pressure"; 2], x, [0.0, high]);
        let shear = self.has_shear.then(|| {
            let bounds = moments.iter().filter_map(|moment| moment.bound.as_ref());
            let most =
                moments.iter().map(|moment| &moment.shear).chain(bounds).map(largest).fold(0.0, f64::max);
            chart(1, "shear", ["shear", "pressure"], x, [-most, most])
        });
        // over the contact, and as far as they move beside it
        let surfaces = now.surfaces.is_some().then(|| {
            let way = largest(&self.view.shift);
            let x = [x[0] - way, x[1] + way];
            let heights = moments.iter().flat_map(|moment| moment.surfaces.iter().flatten());
            let heights = heights.flat_map(|values| along.iter().zip(values));
            let shown = heights.filter(|(s, _)| (x[0]..=x[1]).contains(*s)).map(|(_, height)| *height);
            chart(2, "surfaces", ["height", "length"], x, Axis::ends(shown))
        });
        [
            Some((pressure, "Pressure along a line through the middle.")),
            shear.map(|chart| {
                (chart, "Shear along the same line; where it reaches the bound the contact slips.")
            }),
            surfaces.map(|chart| (chart, SURFACES)),
        ]
    }

    /// The lines in an increment by what the script finds them, as far as they lie in the frames of their charts.
    pub fn section_paths(&self, moment: &Moment, frames: &[Option<Frame>; 3]) -> Vec<(&'static str, String)> {
        let path = |line: &Line| {
            let (values, frame) = ((line.of)(moment)?, frames[line.chart].as_ref()?);
            let [low, high] = frame.axes[0].range;
            let mut points = joined(&self.section.along, &values);
            points.retain(|[s, _]| (low..=high).contains(s));
            Some((line.id, frame.path(&points)))
        };
        LINES.iter().filter_map(path).collect()
    }
}
