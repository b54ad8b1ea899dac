//! The fretting map: the sliding condition of every point over two keys, each point a link to its loop and its numbers.

use maud::{Markup, html};

use super::points::MOST_LOOPS;
use super::view::View;
use fret_drawing::{Axis, Drawing, Frame};

const WIDTH: f64 = 480.0;
const HEIGHT: f64 = 340.0;
/// Values over a wider range than this stand on a logarithmic axis.
const WIDE: f64 = 30.0;
/// Maps of more combinations of the other keys are not drawn.
const MOST_MAPS: usize = 9;

/// Sliding conditions from less to more slip, by their words in files.
const CONDITIONS: [&str; 7] =
    ["apart", "frictionless", "full_stick", "partial_slip", "mixed", "gross_slip", "unsolved"];

/// The maps: one for every combination of the keys that are neither of both axes; nothing of a sweep along less than two keys.
pub fn maps(view: &View) -> Option<Markup> {
    let axes = view.axes();
    let [across, up] = chosen(view, &axes)?;
    let others: Vec<usize> = axes.into_iter().filter(|axis| *axis != across && *axis != up).collect();
    let mut groups = view.groups(&others);
    let all = groups.len();
    groups.truncate(MOST_MAPS);
    Some(html! {
        @for (name, points) in &groups {
            (Drawing::captioned(&drawn(view, [across, up], points).in_page(), name))
        }
        (legend(view))
        @if all > MOST_MAPS { p class="small" { (MOST_MAPS) " of " (all) " maps; the table below has all points." } }
    })
}

/// Which keys are the axes of the map: upwards a normal force, where one of the first two is one.
fn chosen(view: &View, axes: &[usize]) -> Option<[usize; 2]> {
    let [first, second] = *axes.get(..2)? else { return None };
    let presses = |key: usize| view.record.keys[key].contains("normal_force");
    Some(if presses(first) && !presses(second) { [second, first] } else { [first, second] })
}

/// The axis of a key, over all points of the sweep.
fn axis_of(view: &View, key: usize, ticks: usize) -> Axis {
    let values = || (0..view.record.points.len()).map(|point| view.position(key, point));
    let [low, high] = Axis::ends(values());
    if low > 0.0 && high > WIDE * low {
        return Axis::logarithmic(values(), 6);
    }
    // points on the frame would be cut in halves
    let margin = 0.06 * (high - low);
    Axis::linear([low - margin, high + margin].into_iter(), ticks)
}

fn drawn(view: &View, [across, up]: [usize; 2], points: &[usize]) -> Drawing {
    let axes = [axis_of(view, across, 6), axis_of(view, up, 6)];
    let frame = Frame::new(axes, WIDTH - 18.0, [16.0, HEIGHT - 45.0]);
    let content = html! {
        (frame.drawn([&view.key_label(across), &view.key_label(up)]))
        @for &point in points {
            @let condition = view.condition(point);
            @let at = [frame.x_of(view.position(across, point)), frame.y_of(view.position(up, point))];
            @let content = html! {
                title { (view.place(&[across, up], point)) ": " (in_words(condition)) }
                (mark(condition, at))
            };
            @if point < MOST_LOOPS {
                a href=(format!("#point-{point}")) aria-label=(format!("point {point}: {}", in_words(condition))) { (content) }
            } @else {
                g { (content) }
            }
        }
    };
    Drawing {
        what: "fretting map: sliding condition of every point".to_owned(),
        size: [WIDTH, HEIGHT],
        reading: None,
        content,
    }
}

/// The mark of a sliding condition: told apart by form as well as by colour.
fn mark(condition: &str, [x, y]: [f64; 2]) -> Markup {
    let class = format!("mark {condition}");
    let path = match condition {
        "partial_slip" => format!("M{:.1} {y:.1}a6 6 0 1 0 12 0a6 6 0 1 0 -12 0", x - 6.0),
        "mixed" => format!("M{x:.1} {:.1}l6.5 6.5l-6.5 6.5l-6.5 -6.5z", y - 6.5),
        "gross_slip" => format!("M{:.1} {:.1}h11v11h-11z", x - 5.5, y - 5.5),
        "unsolved" => format!("M{:.1} {:.1}l9 9m0 -9l-9 9", x - 4.5, y - 4.5),
        _ => format!("M{x:.1} {:.1}l6.5 11h-13z", y - 7.0),
    };
    html! { path class=(class) d=(path) {} }
}

fn in_words(condition: &str) -> String {
    if condition == "unsolved" { "not solved".to_owned() } else { condition.replace('_', " ") }
}

fn legend(view: &View) -> Markup {
    let has = |condition: &str| (0..view.record.points.len()).any(|point| view.condition(point) == condition);
    html! {
        ul class="legend" {
            @for condition in CONDITIONS.into_iter().filter(|condition| has(condition)) {
                li { svg viewBox="0 0 16 16" width="16" height="16" aria-hidden="true" { (mark(condition, [8.0, 8.0])) } (in_words(condition)) }
            }
        }
    }
}
