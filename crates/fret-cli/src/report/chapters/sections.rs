//! Pressure and shear along a line through the middle of the contact.

use fret_core::model::{Control, Dimension};
use maud::{Markup, html};

use crate::failure::Failure;
use crate::figures::capitalised;
use crate::report::{Measured, Overview, Section, chapter, side_by_side};
use fret_drawing::{Chart, Curve, Stroke};

/// Curves of a section, at most.
const MOST_SECTIONS: usize = 4;
/// Curves that differ by less than this fraction of the largest one, on the average, look the same.
const SEEN: f64 = 0.02;
/// Largest computed pressures up to which a closed form is drawn that has no limit.
const HIGHEST: f64 = 1.5;
/// Points of a closed form along a section.
const FINE: usize = 400;

/// Points for a smooth curve between two ends.
fn fine([from, to]: [f64; 2]) -> impl Iterator<Item = f64> {
    (0..=FINE).map(move |part| from + (to - from) * part as f64 / FINE as f64)
}

/// The part of a section where any of the curves is not zero, with a margin.
pub fn seen(along: &[f64], curves: &[&[f64]]) -> [usize; 2] {
    let is_seen = |k: &usize| curves.iter().any(|values| values[*k] != 0.0);
    let (first, last) = ((0..along.len()).find(is_seen), (0..along.len()).rev().find(is_seen));
    match (first, last) {
        (Some(first), Some(last)) => {
            let margin = ((last - first) / 12).max(1);
            [first.saturating_sub(margin), (last + margin).min(along.len() - 1)]
        }
        _ => [0, along.len() - 1],
    }
}

/// Pressure and shear through the middle of the contact.
pub fn sections(view: &Overview<'_>) -> Result<Markup, Failure> {
    let fields = &view.results.fields;
    let section = Section::of(view);
    let mut figures = Vec::new();
    if fields.steps.is_empty() {
        return Ok(html! {});
    }
    if fields.has("pressure") {
        figures.push(pressure_section(view, &section)?);
    }
    if fields.has("shear_x") && (view.direction.is_some() || view.twists) {
        figures.push(shear_section(view, &section)?);
    }
    Ok(if figures.is_empty() {
        html! {}
    } else {
        chapter("Sections through the contact", &side_by_side(&figures))
    })
}

/// Direction of the shear that sections show: along the load, or across the section where the contact is turned.
pub fn shear_direction(view: &Overview<'_>, section: &Section) -> ([f64; 2], &'static str) {
    match view.direction {
        Some(direction) if !view.twists => (direction, "shear along the load"),
        _ if section.upright => ([-1.0, 0.0], "shear across the section"),
        _ => ([0.0, 1.0], "shear across the section"),
    }
}

/// Of the candidates, in this order, those whose values differ from zero and from each other so that it can be seen.
fn distinct(
    candidates: Vec<usize>,
    mut values_of: impl FnMut(usize) -> Result<Vec<f64>, Failure>,
) -> Result<Vec<(usize, Vec<f64>)>, Failure> {
    let mut read = Vec::new();
    for position in candidates {
        read.push((position, values_of(position)?));
    }
    let sum = |values: &[f64]| values.iter().map(|value| value.abs()).sum::<f64>();
    let largest = read.iter().map(|(_, values)| sum(values)).fold(0.0, f64::max);
    let are_alike = |one: &[f64], other: &[f64]| {
        one.iter().zip(other).map(|(a, b)| (a - b).abs()).sum::<f64>() <= SEEN * largest
    };
    let mut chosen: Vec<(usize, Vec<f64>)> = Vec::new();
    for (position, values) in read {
        let is_nothing = sum(&values) <= SEEN * largest;
        let is_new = chosen.iter().all(|(_, other)| !are_alike(&values, other));
        if chosen.len() < MOST_SECTIONS && is_new && !is_nothing {
            chosen.push((position, values));
        }
    }
    chosen.sort_by_key(|(position, _)| *position);
    Ok(chosen)
}

/// The curves of a section: computed values, and the closed form over them where there is one.
fn section_curves(
    view: &Overview<'_>,
    section: &Section,
    chosen: &[(usize, Vec<f64>)],
    form: impl Fn(usize) -> Option<Box<dyn Fn(f64, f64) -> f64>>,
) -> Vec<Curve> {
    let values: Vec<&[f64]> = chosen.iter().map(|(_, values)| values.as_slice()).collect();
    let [first, last] = seen(&section.along, &values);
    let ends = [section.along[first], section.along[last]];
    let mut curves = Vec::new();
    for (number, (position, values)) in chosen.iter().enumerate() {
        let step = view.results.fields.steps[*position];
        let colour = number;
        let exact = form(step);
        if let Some(exact) = &exact {
            let points = fine(ends).map(|s| {
                let [x, y] = section.point(s);
                [s, exact(x, y)]
            });
            curves.push(Curve { name: None, ..Curve::dashed(points.collect(), "", colour) });
        }
        let stroke = if exact.is_some() { Stroke::Dots } else { Stroke::Line };
        let points = section.points([first, last], |k| values[k]);
        curves.push(Curve::line(points, &view.called(step), colour).drawn(stroke));
    }
    curves
}

fn pressure_section(view: &Overview<'_>, section: &Section) -> Result<Markup, Failure> {
    let fields = &view.results.fields;
    let force = |step: usize| view.results.table.at("normal_force", step);
    // The heaviest load first: it sets the scale.
    let mut candidates = view.telling(2 * MOST_SECTIONS);
    candidates.sort_by(|a, b| force(fields.steps[*b]).total_cmp(&force(fields.steps[*a])));
    let chosen = distinct(candidates, |position| Ok(section.values(&fields.field("pressure", position)?)))?;
    let form = |step: usize| {
        let pressed = view.normal_form?.under(Control::Force(force(step)))?;
        let (pressure, highest) =
            (pressed.pressure_everywhere(), HIGHEST * view.results.table.at("max_pressure", step));
        // The pressure of an edge or a tip has no limit: it is drawn as far as the cells go, and a little further.
        let drawn = move |value: f64| if value <= highest { value } else { f64::NAN };
        Some(Box::new(move |x: f64, y: f64| drawn(pressure(x, y))) as Box<dyn Fn(f64, f64) -> f64>)
    };
    let curves = section_curves(view, section, &chosen, form);
    let has_form = curves.iter().any(|curve| curve.stroke == Stroke::Dashed);
    let axes = [view.label(section.name(), "length"), view.label("pressure", "pressure")];
    let chart = Chart::new("pressure along a line through the contact", axes, curves);
    let caption = if has_form {
        let name = view.normal_form.map_or("", |form| form.name());
        format!(
            "Pressure after these increments (stage, number in it): dots cell by cell, dashed {name} under the same force."
        )
    } else {
        "Pressure after these increments (stage, number in it). No closed form is known for this case."
            .to_owned()
    };
    Ok(chart.figure(&caption))
}

fn shear_section(view: &Overview<'_>, section: &Section) -> Result<Markup, Failure> {
    let fields = &view.results.fields;
    let (direction, name) = shear_direction(view, section);
    let chosen = distinct(pushed_most(view), |position| section.shear(fields, position, direction))?;
    let form = |step: usize| {
        let after = view.tangential_form.as_ref().filter(|_| !view.twists)?.after(step)?.clone();
        Some(Box::new(move |x: f64, y: f64| after.shear(x, y)) as Box<dyn Fn(f64, f64) -> f64>)
    };
    let curves = section_curves(view, section, &chosen, form);
    let has_form = curves.iter().any(|curve| curve.stroke == Stroke::Dashed);
    let axes = [view.label(section.name(), "length"), view.label("shear", "pressure")];
    let chart = Chart::new("shear along a line through the contact", axes, curves);
    let first = capitalised(name);
    let mut caption = if has_form {
        let works = match view.dimension() {
            Dimension::Plane => "Cattaneo, Mindlin and Deresiewicz",
            Dimension::Line => "Cattaneo",
        };
        format!("{first}: dots cell by cell, dashed the closed form ({works}).")
    } else {
        format!("{first}.")
    };
    if view.grows_with_friction() {
        caption += " Every increment in which the contact grows leaves a ring: more increments smooth it.";
    }
    Ok(chart.figure(&caption))
}

/// Kept increments of the last cycle, or of the whole history where there is none: the strongest push to either side first,
/// then the last, then the others evenly.
fn pushed_most(view: &Overview<'_>) -> Vec<usize> {
    let steps = &view.results.fields.steps;
    let [first, end] = view.cycles().last().copied().unwrap_or([0, usize::MAX]);
    let mut inside: Vec<usize> =
        (0..steps.len()).filter(|&position| (first..end).contains(&steps[position])).collect();
    if inside.is_empty() {
        inside = (0..steps.len()).collect();
    }
    let moment = view.results.table.column("twist_moment");
    let push = |position: &usize| {
        if view.twists { moment[steps[*position]] } else { view.tangential[steps[*position]] }
    };
    let by_push = |a: &&usize, b: &&usize| push(a).total_cmp(&push(b));
    let mut ordered: Vec<usize> =
        [inside.iter().max_by(by_push), inside.iter().min_by(by_push), inside.last()]
            .into_iter()
            .flatten()
            .copied()
            .collect();
    let parts = 2 * MOST_SECTIONS;
    ordered.extend((0..parts).map(|part| inside[part * (inside.len() - 1) / (parts - 1)]));
    ordered
}
