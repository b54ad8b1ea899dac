//! The wear scar: a map and sections of its depth.

use maud::{Markup, html};

use crate::drawing::chart::{Chart, Curve};
use crate::drawing::figure_of;
use crate::drawing::map::Map;
use crate::failure::Failure;
use crate::report::Measured;
use crate::report::chapters::sections::seen;
use crate::report::html::{chapter, pairs, side_by_side};
use crate::report::overview::Overview;
use crate::report::window::{Section, Window};
use crate::summary::volumes_by_layer;

/// Sections, at most.
const MOST: usize = 5;

/// The wear scar.
pub fn wear(view: &Overview<'_>) -> Result<Markup, Failure> {
    let fields = &view.results.fields;
    if view.results.case().wear.is_none() {
        return Ok(html! {});
    }
    let Some(last) = fields.steps.len().checked_sub(1).filter(|_| fields.has("worn_depth")) else {
        let words = html! {
            p { "Wear depths are not kept: " code { "\"worn_depth\"" } " in " code { "[output] fields" } " keeps them for a map and sections." }
        };
        return Ok(chapter("Wear scar", &words));
    };
    let scar = fields.field("worn_depth", last)?;
    let most = scar.values.iter().copied().fold(0.0, f64::max);
    let mut window = Window::new(fields.cells());
    window.widen(&scar);
    let part = window.part();
    let value = |[i, j]: [usize; 2]| if scar.at(i, j) > 0.0 { scar.at(i, j) } else { f64::NAN };
    let image = part.values([0.0, most], value)?;
    let map = Map {
        bar: Some((view.label("wear depth", "length"), [0.0, most])),
        ..Map::of_surface("wear depth", |name| view.label(name, "length"), part.edges_in(fields), image)
    };
    let section = Section::of(view);
    let mut profiles = Vec::new();
    for position in scars(view) {
        profiles.push((fields.steps[position], section.values(&fields.field("worn_depth", position)?)));
    }
    let values: Vec<&[f64]> = profiles.iter().map(|(_, values)| values.as_slice()).collect();
    let [low, high] = seen(&section.along, &values);
    let curves = profiles
        .iter()
        .enumerate()
        .map(|(colour, (increment, values))| {
            let points = (low..=high).map(|k| [section.along[k], values[k]]).collect();
            Curve::line(points, &view.after_cycle(*increment), colour)
        })
        .collect();
    let axes = [view.label(section.name(), "length"), view.label("wear depth", "length")];
    let debris = debris(view, &section, last, [low, high])?;
    let figures = [
        Chart::new("wear depth along a line through the contact", axes, curves)
            .figure("Wear depth of both bodies together, along a line through the middle."),
        figure_of(&map.drawing()?.in_page(), "Wear depth at the end."),
    ];
    let figures: Vec<Markup> = figures.into_iter().chain(debris).collect();
    let worn = view.results.record.end.as_ref().and_then(|end| end.worn_by_layer.as_ref());
    let lost =
        worn.map_or_else(Vec::new, |worn| volumes_by_layer(worn, |lost| view.number(lost, "length^3")));
    let lost: Vec<(String, Markup)> = lost.into_iter().map(|(name, lost)| (name, html! { (lost) })).collect();
    Ok(chapter("Wear scar", &html! { (side_by_side(&figures)) @if !lost.is_empty() { (pairs(&lost)) } }))
}

/// The wear depth at the end, the debris in it, and what is open between the two, along the line; `None` where no debris is kept.
fn debris(
    view: &Overview<'_>,
    section: &Section,
    last: usize,
    [low, high]: [usize; 2],
) -> Result<Option<Markup>, Failure> {
    let fields = &view.results.fields;
    if !fields.has("debris") {
        return Ok(None);
    }
    let worn = section.values(&fields.field("worn_depth", last)?);
    let debris = section.values(&fields.field("debris", last)?);
    let curve = |value: &dyn Fn(usize) -> f64, name: &str, colour: usize| {
        Curve::line((low..=high).map(|k| [section.along[k], value(k)]).collect(), name, colour)
    };
    let curves = vec![
        curve(&|k| worn[k], "wear depth", 0),
        curve(&|k| debris[k], "debris", 1),
        curve(&|k| worn[k] - debris[k], "open", 2),
    ];
    let axes = [view.label(section.name(), "length"), view.label("depth", "length")];
    Ok(Some(Chart::new("debris in the scar along a line through the contact", axes, curves).figure("At the end: wear depth of both bodies together, thickness of the debris, and what is open between them.")))
}

/// Kept increments with a scar that can be told from the others, evenly over the run.
fn scars(view: &Overview<'_>) -> Vec<usize> {
    let table = view.results.table.column("max_worn_depth");
    let steps = &view.results.fields.steps;
    let worn: Vec<usize> = (0..steps.len())
        .filter(|position| table.get(steps[*position]).is_some_and(|depth| *depth > 0.0))
        .collect();
    let count = worn.len().min(MOST);
    (1..=count).map(|part| worn[part * worn.len() / count - 1]).collect()
}
