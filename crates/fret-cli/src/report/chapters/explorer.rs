//! The history as it moves: loop, sections and maps of an increment, and a slider that goes through the kept ones. Without scripts
//! the increment of the largest load stands there.

use fret_core::model::Dimension;
use maud::{Markup, PreEscaped, html};
use serde_json::{Value, json};

use super::loading::loop_curves;
use super::moment::{Ground, Moment};
use super::zones::legend;
use crate::failure::Failure;
use crate::figures::{largest, percent};
use crate::report::{Measured, Overview, chapter};
use fret_drawing::{Axis, Chart, Curve, Drawing, Frame, Map};

/// Increments that the slider shows, at most, and at least where there are so many.
const MOST: usize = 120;
const FEWEST: usize = 12;
/// Bytes of all of them together, about.
const ROOM: usize = 2_500_000;
/// Fraction of the largest value of a load below which there is none.
const ROUNDING: f64 = 1e-12;

/// The chapter.
pub fn explorer(view: &Overview<'_>) -> Result<Markup, Failure> {
    let fields = &view.results.fields;
    if !fields.has("pressure") || fields.steps.is_empty() {
        return Ok(html! {});
    }
    let telling = telling(view);
    let ground = Ground::of(view, MOST)?;
    let first = ground.moment(telling)?;
    let bytes: usize = first.images.iter().map(String::len).sum::<usize>() + 60 * first.pressure.len();
    let chosen = view.telling((ROOM / bytes.max(1)).clamp(FEWEST, MOST));
    let start = (0..chosen.len()).min_by_key(|place| chosen[*place].abs_diff(telling)).unwrap_or(0);
    let mut moments = Vec::new();
    for position in chosen {
        moments.push(ground.moment(position)?);
    }
    ground.shown(&moments, start)
}

/// The kept increment of the largest load, tangential where there is one.
fn telling(view: &Overview<'_>) -> usize {
    let (table, steps) = (&view.results.table, &view.results.fields.steps);
    let load = |position: &usize| {
        let increment = steps[*position];
        let name = if view.twists { "twist_moment" } else { "normal_force" };
        if view.direction.is_some() && !view.twists {
            view.tangential[increment].abs()
        } else {
            table.at(name, increment).abs()
        }
    };
    (0..steps.len()).max_by(|a, b| load(a).total_cmp(&load(b))).unwrap_or(0)
}

impl Ground<'_> {
    fn shown(&self, moments: &[Moment], start: usize) -> Result<Markup, Failure> {
        let view = self.view;
        let now = &moments[start];
        let path = self.loop_chart(now);
        let loop_frame = path.frame();
        let sections = self.section_charts(moments, now);
        let frames = sections.each_ref().map(|section| section.as_ref().map(|(chart, _)| chart.frame()));
        let changes: Vec<Value> =
            moments.iter().map(|moment| self.changes(moment, &loop_frame, &frames)).collect();
        let mut figures = vec![path.figure("The increment on the path of the load.")];
        figures.extend(sections.iter().flatten().map(|(chart, caption)| chart.figure(caption)));
        figures.extend(self.maps(now)?);
        let body = html! {
            @if moments.len() > 1 {
                div class="slider" id="slider" hidden {
                    button type="button" id="play" aria-label="play" { "▶" }
                    input type="range" id="moment" min="0" max=(moments.len() - 1) value=(start) step="1" aria-label="increment";
                }
            }
            dl class="moment" {
                @for (name, id, words) in self.words(now) { div { dt { (name) } dd id=(id) { (words) } } }
            }
            div class="wide figures" { @for figure in &figures { (figure) } }
            @if moments.len() > 1 {
                noscript { p class="small" { "With scripts a slider here goes through " (moments.len()) " increments." } }
                script type="application/json" id="moments" { (PreEscaped(json_in_page(&changes))) }
            }
        };
        let heading = if moments.len() > 1 { "Through the history" } else { "The contact" };
        let kept = view.results.fields.steps.len();
        let note = html! {
            @if kept > moments.len() { p class="small" { (moments.len()) " of the " (kept) " increments whose fields are kept." } }
            @else if kept < view.results.table.rows() && moments.len() > 1 {
                p class="small" {
                    (kept) " of " (view.results.table.rows()) " increments have their fields kept; " code { "[output] every" } " keeps more."
                }
            }
        };
        Ok(chapter(heading, &html! { (body) (note) }))
    }

    fn loop_chart(&self, now: &Moment) -> Chart {
        let points = self.view.loop_points();
        let labels = self.view.labels_of_loop();
        let what = format!("{} over {}", labels[1].name, labels[0].name);
        let here = points.get(now.increment).copied().unwrap_or([f64::NAN; 2]);
        let curves = loop_curves(self.view).into_iter().map(|curve| Curve { name: None, ..curve }).collect();
        let range = |axis: usize| Some(Axis::ends(points.iter().map(|point| point[axis])));
        Chart {
            here: Some((here, "here")),
            ranges: [range(0), range(1)],
            ..Chart::new(&what, labels, curves)
        }
    }

    fn maps(&self, now: &Moment) -> Result<Vec<Markup>, Failure> {
        let fields = &self.view.results.fields;
        let edges = self.window.part().edges_in(fields);
        let map_of = |place: usize, what: &str, bar: Option<&str>, most: f64| Map {
            id: Some(["map-0", "map-1", "map-2"][place]),
            bar: bar.map(|name| (self.view.label(name, "pressure"), [0.0, most])),
            ..Map::of_surface(what, self.view.labels_of_surface(), edges, now.images[place].clone())
        };
        let mut figures = Vec::new();
        let mut place = 0;
        let mut add =
            |what: &str, bar: Option<&str>, most: f64, below: Markup, caption: &str| -> Result<(), Failure> {
                let drawing = map_of(place, what, bar, most).drawing()?.in_page();
                figures.push(Drawing::captioned(&html! { (drawing) (below) }, caption));
                place += 1;
                Ok(())
            };
        if self.has_zones {
            add("stick and slip", None, 0.0, legend(), "What each cell did in the increment.")?;
        }
        if self.view.dimension() == Dimension::Line {
            // it is the same all along y, and its sections tell all
            return Ok(figures);
        }
        add("pressure", Some("pressure"), self.most[0], html! {}, "Contact pressure.")?;
        if self.has_shear {
            add("shear", Some("shear"), self.most[1], html! {}, "Magnitude of the shear traction.")?;
        }
        Ok(figures)
    }

    /// What is told of an increment in words.
    fn words(&self, moment: &Moment) -> Vec<(String, &'static str, String)> {
        let (view, table, at) = (self.view, &self.view.results.table, moment.increment);
        let (stage, number) = view.place(at);
        let of = view.spans.get(stage).map_or(0, |[first, end]| end - first);
        // what vanishes in the rounding of the others is zero
        let beside = |values: &[f64], kind: &str| {
            let value = values[at];
            view.number(if value.abs() <= ROUNDING * largest(values) { 0.0 } else { value }, kind)
        };
        let mut words = Vec::new();
        let mut add = |name: &str, id: &'static str, told: String| words.push((name.to_owned(), id, told));
        add("increment", "word-increment", format!("{at}: {}, {number} of {of}", view.stage_name(stage)));
        add("normal force", "word-force", view.told("normal_force", at));
        if view.twists {
            let moment = beside(table.column("twist_moment"), "force x length");
            add("torsional moment", "word-moment", moment);
        } else if view.direction.is_some() {
            add("tangential force", "word-tangential", beside(&view.tangential, "force"));
            add("displacement", "word-shift", beside(&view.shift, "length"));
        }
        add("max pressure", "word-pressure", view.told("max_pressure", at));
        if !view.is_frictionless() {
            let stick = percent(table.at("stick_area", at) / table.at("contact_area", at));
            add("stick fraction", "word-stick", stick);
        }
        if let Some(rolled) = &view.rolled {
            for column in &rolled.columns {
                let told = if rolled.rolls[at] { view.told(column.name, at) } else { "–".to_owned() };
                add(&column.in_words(), column.name, told);
            }
        }
        words
    }

    /// What the slider changes: attributes, or the text, of the elements of the page.
    fn changes(&self, moment: &Moment, loop_frame: &Frame, sections: &[Option<Frame>; 3]) -> Value {
        let mut changes = serde_json::Map::new();
        for (_, id, words) in self.words(moment) {
            changes.insert(id.to_owned(), json!({ "text": words }));
        }
        let here = self.view.loop_points().get(moment.increment).map(|point| loop_frame.places(&[*point]));
        for [x, y] in here.into_iter().flatten() {
            changes.insert("here".to_owned(), json!({ "cx": format!("{x:.1}"), "cy": format!("{y:.1}") }));
        }
        for (id, path) in self.section_paths(moment, sections) {
            changes.insert(id.to_owned(), json!({ "d": path }));
        }
        for (place, address) in moment.images.iter().enumerate() {
            changes.insert(format!("map-{place}"), json!({ "href": address }));
        }
        Value::Object(changes)
    }
}

/// JSON that cannot end the element it stands in.
pub fn json_in_page(value: &[Value]) -> String {
    serde_json::to_string(value).unwrap_or_default().replace('<', "\\u003c")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_cannot_end_the_script() {
        let text = json_in_page(&[json!({ "text": "</script><b>" })]);
        assert!(
            !text.contains('<') && serde_json::from_str::<Value>(&text).unwrap()[0]["text"] == "</script><b>"
        );
    }
}
