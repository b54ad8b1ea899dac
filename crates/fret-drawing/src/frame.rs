//! The area between two axes, with its ticks, grid and names.

use std::fmt::Write;

use maud::{Markup, html};

use crate::scale::{Axis, Label};

/// Width of a letter of a tick.
const LETTER: f64 = 6.7;
/// Points nearer to each other than this are drawn as one.
const NEAR: f64 = 0.25;

/// The area between two axes.
#[derive(Debug)]
pub struct Frame {
    /// The axes.
    pub axes: [Axis; 2],
    /// Left and right edge.
    pub across: [f64; 2],
    /// Upper and lower edge.
    pub down: [f64; 2],
    /// Whether the vertical axis counts downwards.
    pub downward: bool,
}

/// Room that the words left of a vertical axis need.
pub fn room_for(axis: &Axis) -> f64 {
    let longest = axis.ticks.iter().map(|(_, word)| word.chars().count()).max().unwrap_or(0);
    26.0 + LETTER * longest as f64
}

impl Frame {
    /// The area right of the words of its vertical axis, which counts upwards.
    pub fn new(axes: [Axis; 2], right: f64, down: [f64; 2]) -> Self {
        Self { across: [room_for(&axes[1]), right], axes, down, downward: false }
    }

    /// Place of a value along x.
    pub fn x_of(&self, value: f64) -> f64 {
        self.across[0] + self.axes[0].place(value) * (self.across[1] - self.across[0])
    }

    /// Place of a value along y.
    pub fn y_of(&self, value: f64) -> f64 {
        let part = self.axes[1].place(value);
        let [top, bottom] = self.down;
        if self.downward { top + part * (bottom - top) } else { bottom - part * (bottom - top) }
    }

    /// Grid, ticks, the line of zero, and the names of the axes.
    pub fn drawn(&self, names: [&Label; 2]) -> Markup {
        let ([left, right], [top, bottom]) = (self.across, self.down);
        let [x, y] = &self.axes;
        let middle = [0.5 * (left + right), 0.5 * (top + bottom)];
        let holds_zero = |axis: &Axis| axis.range[0] < 0.0 && axis.range[1] > 0.0 && !axis.logarithmic;
        html! {
            @for (value, word) in &x.ticks {
                @let at = format!("{:.1}", self.x_of(*value));
                path class="grid" d=(format!("M{at} {top}V{bottom:.1}")) {}
                text class="tick" x=(at) y=(format!("{:.1}", bottom + 18.0)) text-anchor="middle" { (word) }
            }
            @for (value, word) in &y.ticks {
                @let at = self.y_of(*value);
                path class="grid" d=(format!("M{left:.1} {at:.1}H{right}")) {}
                text class="tick" x=(format!("{:.1}", left - 6.0)) y=(format!("{:.1}", at + 4.0)) text-anchor="end" { (word) }
            }
            @if holds_zero(x) { path class="zero" d=(format!("M{:.1} {top}V{bottom:.1}", self.x_of(0.0))) {} }
            @if holds_zero(y) { path class="zero" d=(format!("M{left:.1} {:.1}H{right}", self.y_of(0.0))) {} }
            path class="frame" d=(format!("M{left:.1} {top}V{bottom:.1}H{right}")) {}
            text class="axis" x=(format!("{:.1}", middle[0])) y=(format!("{:.1}", bottom + 36.0)) text-anchor="middle" { (x.named(names[0])) }
            text class="axis" transform=(format!("translate(12 {:.1}) rotate(-90)", middle[1])) text-anchor="middle" { (y.named(names[1])) }
        }
    }

    /// Whether a point can be drawn at all.
    fn shows(&self, point: [f64; 2]) -> bool {
        point.iter().all(|value| value.is_finite()) && (point[1] > 0.0 || !self.axes[1].logarithmic)
    }

    /// The places of the points that can be drawn.
    pub fn places(&self, points: &[[f64; 2]]) -> Vec<[f64; 2]> {
        points
            .iter()
            .filter(|point| self.shows(**point))
            .map(|[x, y]| [self.x_of(*x), self.y_of(*y)])
            .collect()
    }

    /// A line through points, as the data of a path; a point that is no number breaks it. Points that cannot be told apart are one.
    pub fn path(&self, points: &[[f64; 2]]) -> String {
        let mut path = String::new();
        let mut last: Option<[f64; 2]> = None;
        for (number, point) in points.iter().enumerate() {
            if !self.shows(*point) {
                last = None;
                continue;
            }
            let at = [self.x_of(point[0]), self.y_of(point[1])];
            let is_near = last.is_some_and(|last| (last[0] - at[0]).hypot(last[1] - at[1]) < NEAR);
            if is_near && number + 1 < points.len() {
                continue;
            }
            let _ = write!(path, "{}{:.1} {:.1}", if last.is_some() { 'L' } else { 'M' }, at[0], at[1]);
            last = Some(at);
        }
        path
    }

    /// What a pointer over the picture reads: edges and ranges of both axes, and whether the vertical one is logarithmic.
    pub fn reading(&self) -> String {
        let ([left, right], [top, bottom]) = (self.across, self.down);
        let ([x0, x1], [y0, y1]) = (self.axes[0].range, self.axes[1].range);
        let [lower, upper] = if self.downward { [top, bottom] } else { [bottom, top] };
        let logarithmic = u8::from(self.axes[1].logarithmic);
        format!("[{left:.1},{right:.1},{lower:.1},{upper:.1},{x0:e},{x1:e},{y0:e},{y1:e},{logarithmic}]")
    }
}
