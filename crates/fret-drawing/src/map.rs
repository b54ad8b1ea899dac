//! A false-colour map: a field over two lengths in a frame, with the bar of its colours; or zones, which have no bar.

use maud::{Markup, html};

use png::EncodingError;

use crate::drawn::Drawing;
use crate::frame::{Frame, room_for};
use crate::raster::Raster;
use crate::scale::{Axis, Label};

const TOP: f64 = 26.0;
const BOTTOM: f64 = 45.0;
/// Room right of a map that has no bar: about that of a bar.
const MARGIN: f64 = 64.0;
/// Height that a tick needs.
const TICK: f64 = 26.0;
/// Between map and bar, and the width of the bar.
const APART: f64 = 10.0;
const BAR: f64 = 11.0;
/// Height over width of the area, at least and at most: a longer scene is squeezed, and its axes say so.
const FLATTEST: f64 = 0.12;
const TALLEST: f64 = 1.5;

/// A map.
#[derive(Debug)]
pub struct Map {
    /// What it shows, for those who cannot see it.
    pub what: String,
    /// Width of the whole.
    pub width: f64,
    /// Names of the axes.
    pub axes: [Label; 2],
    /// Left and right end of the image.
    pub x: [f64; 2],
    /// Lower and upper end of the image; downwards, upper and lower.
    pub y: [f64; 2],
    /// Whether the vertical axis counts downwards, as a depth does.
    pub downward: bool,
    /// The image, as an address.
    pub image: String,
    /// By what a script finds the image.
    pub id: Option<&'static str>,
    /// Name of the colours and values of their ends.
    pub bar: Option<(Label, [f64; 2])>,
    /// Levels that are drawn across.
    pub levels: Vec<f64>,
}

impl Map {
    /// Width of a map of the surface.
    pub const WIDTH: f64 = 400.0;

    /// A map of the surface without a bar, whose axes are so called; a line contact has none along y.
    pub fn of_surface(what: &str, axes: [Label; 2], [x, y]: [[f64; 2]; 2], image: String) -> Self {
        Self {
            what: what.to_owned(),
            width: Self::WIDTH,
            axes,
            x,
            y,
            downward: false,
            image,
            id: None,
            bar: None,
            levels: Vec::new(),
        }
    }

    /// The map.
    ///
    /// # Errors
    /// When the colours of its bar cannot be written as an image.
    pub fn drawing(&self) -> Result<Drawing, EncodingError> {
        let x_to_y = ((self.y[1] - self.y[0]) / (self.x[1] - self.x[0])).clamp(FLATTEST, TALLEST);
        let ticks = ((x_to_y * 0.7 * self.width / TICK) as usize).min(5);
        let bar = self.bar.as_ref().map(|(label, range)| (label, Axis::over(*range, ticks)));
        let mut y = Axis::over(self.y, ticks);
        if ticks == 0 || self.axes[1].name.is_empty() {
            y.ticks.clear();
        }
        let left = room_for(&y);
        let right = self.width - bar.as_ref().map_or(MARGIN, |(_, axis)| APART + BAR + room_for(axis) - 14.0);
        let high = (right - left) * x_to_y;
        let bottom = TOP + high;
        let frame = Frame {
            axes: [Axis::over(self.x, 4), y],
            across: [left, right],
            down: [TOP, bottom],
            downward: self.downward,
        };
        let content = html! {
            rect class="open" x=(format!("{left:.1}")) y=(TOP) width=(format!("{:.1}", right - left)) height=(format!("{high:.1}")) {}
            image id=[self.id] href=(self.image) x=(format!("{left:.1}")) y=(TOP) width=(format!("{:.1}", right - left))
                height=(format!("{high:.1}")) preserveAspectRatio="none" {}
            (outside(&frame, [&self.axes[0], &self.axes[1]]))
            @for level in &self.levels {
                path class="interface" d=(format!("M{left:.1} {:.1}H{right:.1}", frame.y_of(*level))) {}
            }
            @if let Some((label, axis)) = &bar { (drawn_bar(label, axis, right + APART, [TOP, bottom], self.width)?) }
        };
        Ok(Drawing { what: self.what.clone(), size: [self.width, bottom + BOTTOM], reading: None, content })
    }
}

/// Ticks outside of the image, and names.
fn outside(frame: &Frame, names: [&Label; 2]) -> Markup {
    let ([left, right], [top, bottom]) = (frame.across, frame.down);
    let [x, y] = &frame.axes;
    html! {
        path class="frame" d=(format!("M{left:.1} {top}V{bottom:.1}H{right:.1}V{top}Z")) {}
        @for (value, word) in &x.ticks {
            @let at = format!("{:.1}", frame.x_of(*value));
            path class="frame" d=(format!("M{at} {bottom:.1}v3")) {}
            text class="tick" x=(at) y=(format!("{:.1}", bottom + 18.0)) text-anchor="middle" { (word) }
        }
        @for (value, word) in &y.ticks {
            @let at = frame.y_of(*value);
            path class="frame" d=(format!("M{left:.1} {at:.1}h-3")) {}
            text class="tick" x=(format!("{:.1}", left - 6.0)) y=(format!("{:.1}", at + 4.0)) text-anchor="end" { (word) }
        }
        text class="axis" x=(format!("{:.1}", 0.5 * (left + right))) y=(format!("{:.1}", bottom + 36.0)) text-anchor="middle" { (x.named(names[0])) }
        @if !names[1].name.is_empty() {
            text class="axis" transform=(format!("translate(12 {:.1}) rotate(-90)", 0.5 * (top + bottom))) text-anchor="middle" { (y.named(names[1])) }
        }
    }
}

fn drawn_bar(
    label: &Label,
    axis: &Axis,
    left: f64,
    [top, bottom]: [f64; 2],
    width: f64,
) -> Result<Markup, EncodingError> {
    let address = Raster::of_scale().address()?;
    let high = bottom - top;
    Ok(html! {
        image href=(address) x=(format!("{left:.1}")) y=(top) width=(BAR) height=(format!("{high:.1}")) preserveAspectRatio="none" {}
        @for (value, word) in &axis.ticks {
            @let at = bottom - axis.place(*value) * high;
            path class="frame" d=(format!("M{:.1} {at:.1}h3", left + BAR)) {}
            text class="tick" x=(format!("{:.1}", left + BAR + 6.0)) y=(format!("{:.1}", at + 4.0)) { (word) }
        }
        text class="axis" x=(width - 4.0) y=(top - 11.0) text-anchor="end" { (axis.named(label)) }
    })
}
