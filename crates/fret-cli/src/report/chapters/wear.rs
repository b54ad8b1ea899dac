//! The wear scar: a map and sections of its depth.

use maud::{Markup, html};

use crate::failure::Failure;
use crate::report::chapters::sections::seen;
use crate::report::chapters::surfaces::OWN_DEPTHS;
use crate::report::{Measured, Overview, Section, Window, chapter, pairs, side_by_side};
use crate::run::volumes_by_layer;
use fret_drawing::{Chart, Curve, Drawing, Map};

/// Sections, at most.
const MOST: usize = 5;

/// A wear depth that is shown.
struct Scar {
    field: &'static str,
    /// Whose it is, and in which frame.
    of: &'static str,
}

const TOGETHER: [Scar; 1] = [Scar { field: "worn_depth", of: "both bodies together" }];
/// Where the bodies move against each other.
const OWN: [Scar; 2] = [
    Scar { field: OWN_DEPTHS[0], of: "the lower body" },
    Scar { field: OWN_DEPTHS[1], of: "the upper body, in its own frame, which moves with it" },
];

/// The wear scar, or that of each body.
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
    let is_own = OWN_DEPTHS.iter().all(|name| fields.has(name));
    let section = Section::of(view);
    let mut figures = Vec::new();
    for scar in if is_own { &OWN[..] } else { &TOGETHER[..] } {
        figures.extend(scar_figures(view, &section, scar, last)?);
    }
    figures.extend(debris(view, &section, last)?);
    let worn = view.results.record.end.as_ref().and_then(|end| end.worn_by_layer.as_ref());
    let lost =
        worn.map_or_else(Vec::new, |worn| volumes_by_layer(worn, |lost| view.number(lost, "length^3")));
    let heading = if is_own { "Wear scars" } else { "Wear scar" };
    Ok(chapter(heading, &html! { (side_by_side(&figures)) @if !lost.is_empty() { (pairs(lost)) } }))
}

/// Sections of a scar through the run, and its map at the end.
fn scar_figures(
    view: &Overview<'_>,
    section: &Section,
    scar: &Scar,
    last: usize,
) -> Result<[Markup; 2], Failure> {
    let fields = &view.results.fields;
    let depth = fields.field(scar.field, last)?;
    let most = depth.iter().copied().fold(0.0, f64::max);
    let mut window = Window::new(fields.cells());
    window.widen(&depth);
    let part = window.part();
    let value = |cell: [usize; 2]| if depth[cell] > 0.0 { depth[cell] } else { f64::NAN };
    let image = part.values([0.0, most], value)?;
    let what = format!("wear depth of {}", scar.of);
    let axes = ["x", "y"].map(|name| view.label(name, "length"));
    let map = Map {
        bar: Some((view.label("wear depth", "length"), [0.0, most])),
        ..Map::of_surface(&what, axes, part.edges_in(fields), image)
    };
    let mut profiles = Vec::new();
    for position in scars(view) {
        profiles.push((fields.steps[position], section.values(&fields.field(scar.field, position)?)));
    }
    let values: Vec<&[f64]> = profiles.iter().map(|(_, values)| values.as_slice()).collect();
    let seen = seen(&section.along, &values);
    let curve = |(colour, (increment, values)): (usize, &(usize, Vec<f64>))| {
        Curve::line(section.points(seen, |k| values[k]), &view.after_cycle(*increment), colour)
    };
    let curves = profiles.iter().enumerate().map(curve).collect();
    let axes = [view.label(section.name(), "length"), view.label("wear depth", "length")];
    Ok([
        Chart::new(&format!("{what} along a line through the contact"), axes, curves)
            .figure(&format!("Wear depth of {}, along a line through the middle.", scar.of)),
        Drawing::captioned(&map.drawing()?.in_page(), &format!("Wear depth of {} at the end.", scar.of)),
    ])
}

/// The wear depth at the end, the debris in it, and what is open between the two, along the line; `None` where no debris is kept.
fn debris(view: &Overview<'_>, section: &Section, last: usize) -> Result<Option<Markup>, Failure> {
    let fields = &view.results.fields;
    if !fields.has("debris") {
        return Ok(None);
    }
    let worn = section.values(&fields.field("worn_depth", last)?);
    let debris = section.values(&fields.field("debris", last)?);
    let seen = seen(&section.along, &[&worn, &debris]);
    let curve = |value: &dyn Fn(usize) -> f64, name: &str, colour: usize| {
        Curve::line(section.points(seen, value), name, colour)
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
