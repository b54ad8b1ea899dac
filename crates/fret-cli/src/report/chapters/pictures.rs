//! Loops, sections and maps.

use super::{chapter, side_by_side};
use crate::failure::Failure;
use crate::report::chart::{Chart, Curve, Stroke};
use crate::report::html::{escaped, figure_of};
use crate::report::map;
use crate::report::scene::Scene;
use crate::results::Field;

/// Curves of a section, at the most.
const MOST_SECTIONS: usize = 4;
/// Maps, at the most.
const MOST_MAPS: usize = 18;
/// Colours of the page.
const COLOURS: usize = 6;
/// Curves that differ by less than this share of the largest one, on the average, look the same.
const SEEN: f64 = 0.02;
/// Points of a closed form along a section.
const FINE: usize = 400;

fn line(points: Vec<[f64; 2]>, name: &str, colour: usize) -> Curve {
    Curve { points, name: Some(name.to_owned()), colour, stroke: Stroke::Line }
}

fn pairs(x: &[f64], y: &[f64]) -> Vec<[f64; 2]> {
    x.iter().zip(y).map(|(x, y)| [*x, *y]).collect()
}

/// Normal force over approach, and the loads over the increments.
pub fn pressing(scene: &Scene<'_>) -> String {
    let table = &scene.results.table;
    let (approach, force) = (table.column("approach"), table.column("normal_force"));
    let mut curves = vec![line(pairs(approach, force), "computed", 0)];
    let mut caption = "Normal force over approach.".to_owned();
    if let Some(form) = &scene.normal_form {
        let most = force.iter().copied().fold(0.0, f64::max);
        let curve = (1..=100).filter_map(|part| {
            let force = most * (f64::from(part) / 100.0).powi(3);
            form.under(force).map(|pressed| [pressed.approach(), force])
        });
        let points = std::iter::once([0.0; 2]).chain(curve).collect();
        curves.push(Curve { stroke: Stroke::Dashed, ..line(points, "Hertz", 1) });
        caption += " Dashed: Hertz, without friction.";
    }
    let chart = Chart {
        what: "normal force over approach".to_owned(),
        axes: [scene.axis("approach", "length"), scene.axis("normal force", "force")],
        curves,
        logarithmic: false,
        level: None,
    };
    let mut figures = figure_of(&chart.svg(), &caption);
    let number = table.column("increment");
    let mut loads = vec![line(pairs(number, force), "normal force", 0)];
    if scene.direction.is_some() {
        loads.push(line(pairs(number, &scene.tangential), "tangential force", 1));
    }
    let chart = Chart {
        what: "loads over the increments".to_owned(),
        axes: ["increment".to_owned(), scene.axis("force", "force")],
        curves: loads,
        logarithmic: false,
        level: None,
    };
    figures += &figure_of(&chart.svg(), "Forces through the history, prescribed or found.");
    chapter("Loading", &side_by_side(&figures))
}

/// Tangential force over shift, or moment over twist where that is what moves.
pub fn fretting_loop(scene: &Scene<'_>) -> String {
    if scene.direction.is_none() && !scene.twists {
        return String::new();
    }
    let table = &scene.results.table;
    let (all, axes, words) = if scene.twists {
        (
            pairs(table.column("twist"), table.column("twist_moment")),
            ["rotation", "torsional moment"],
            "Moment over rotation.",
        )
    } else {
        let words = "Tangential force over relative displacement, both along the load.";
        (pairs(&scene.shift, &scene.tangential), ["relative displacement", "tangential force"], words)
    };
    let kinds = if scene.twists { ["rad", "force x length"] } else { ["length", "force"] };
    let cycles = scene.cycles();
    let mut curves = Vec::new();
    let mut caption = words.to_owned();
    if let (Some(last), true) = (cycles.last(), cycles.len() > 1) {
        curves.push(Curve { stroke: Stroke::Faint, ..line(all.clone(), "all of the history", 0) });
        // From the increment before: so the loop is closed.
        let cycle = all[last.span[0].saturating_sub(1)..last.span[1]].to_vec();
        curves.push(line(cycle, "last cycle", 0));
    } else {
        curves.push(line(all, "computed", 0));
    }
    if let (Some(form), false) = (&scene.tangential_form, scene.twists) {
        let points = (0..scene.results.table.rows()).map(|row| {
            form.after(row).map_or([f64::NAN; 2], |after| [after.shift(), after.tangential_force()])
        });
        curves.push(Curve { stroke: Stroke::Dashed, ..line(points.collect(), "closed form", 1) });
        caption += " Dashed: the closed form for the same forces (Cattaneo, Mindlin and Deresiewicz). It neglects the slip \
                    across the force, and so gives a shift that is some percent off.";
    }
    let chart = Chart {
        what: format!("{} over {}", axes[1], axes[0]),
        axes: [scene.axis(axes[0], kinds[0]), scene.axis(axes[1], kinds[1])],
        curves,
        logarithmic: false,
        level: None,
    };
    let figures = figure_of(&chart.svg(), &caption) + &stick_share(scene);
    chapter("Fretting loop", &side_by_side(&figures))
}

/// How much of the contact sticks.
fn stick_share(scene: &Scene<'_>) -> String {
    let table = &scene.results.table;
    let shares: Vec<f64> =
        table.column("stick_area").iter().zip(table.column("contact_area")).map(|(s, c)| s / c).collect();
    let number = table.column("increment");
    let mut curves = vec![line(pairs(number, &shares), "computed", 0)];
    let mut caption = "Share of the contact area that sticks.".to_owned();
    if let Some(form) = &scene.tangential_form {
        let exact: Vec<f64> = (0..table.rows())
            .map(|row| {
                let (after, force) = (form.after(row), table.at("normal_force", row));
                let pressed = scene.normal_form.and_then(|form| form.under(force));
                after.zip(pressed).map_or(f64::NAN, |(after, pressed)| {
                    std::f64::consts::PI * after.stick_radius().powi(2) / pressed.area()
                })
            })
            .collect();
        curves.push(Curve { stroke: Stroke::Dashed, ..line(pairs(number, &exact), "closed form", 1) });
        caption +=
            " Dashed: the closed form. The computed area counts whole cells, and slip within an increment.";
    }
    let chart = Chart {
        what: "stick fraction of the contact over the increments".to_owned(),
        axes: ["increment".to_owned(), "stick".to_owned()],
        curves,
        logarithmic: false,
        level: None,
    };
    figure_of(&chart.svg(), &caption)
}

/// A line of cells through the middle of the grid.
struct Section {
    /// Whether it runs along y.
    upright: bool,
    /// Cell centres along it.
    along: Vec<f64>,
    /// Where it lies across.
    across: f64,
    line: usize,
}

impl Section {
    fn of(scene: &Scene<'_>) -> Self {
        let fields = &scene.results.fields;
        let upright = scene.direction.is_some_and(|[x, y]| y.abs() > x.abs());
        let (along, other) = if upright { (&fields.y, &fields.x) } else { (&fields.x, &fields.y) };
        let line = other.len() / 2;
        Self { upright, along: along.clone(), across: other[line], line }
    }

    fn values(&self, field: &Field) -> Vec<f64> {
        let at = |k: usize| if self.upright { field.at(self.line, k) } else { field.at(k, self.line) };
        (0..self.along.len()).map(at).collect()
    }

    fn point(&self, s: f64) -> [f64; 2] {
        if self.upright { [self.across, s] } else { [s, self.across] }
    }

    fn name(&self) -> &'static str {
        if self.upright { "y" } else { "x" }
    }
}

/// Points for a smooth curve between two ends.
fn fine([from, to]: [f64; 2]) -> impl Iterator<Item = f64> {
    (0..=FINE).map(move |part| from + (to - from) * part as f64 / FINE as f64)
}

/// The part of a section where any of the curves is not zero, with a margin.
fn seen(along: &[f64], curves: &[&[f64]]) -> [usize; 2] {
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
pub fn sections(scene: &Scene<'_>) -> Result<String, Failure> {
    let fields = &scene.results.fields;
    let section = Section::of(scene);
    let mut figures = String::new();
    if fields.has("pressure") && !fields.steps.is_empty() {
        figures += &pressure_section(scene, &section)?;
    }
    if let Some(direction) = scene.direction.filter(|_| fields.has("shear_x") && !fields.steps.is_empty()) {
        figures += &shear_section(scene, &section, direction)?;
    }
    if figures.is_empty() {
        return Ok(String::new());
    }
    Ok(chapter("Sections through the contact", &side_by_side(&figures)))
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
    scene: &Scene<'_>,
    section: &Section,
    chosen: &[(usize, Vec<f64>)],
    form: impl Fn(usize) -> Option<Box<dyn Fn(f64, f64) -> f64>>,
) -> Vec<Curve> {
    let values: Vec<&[f64]> = chosen.iter().map(|(_, values)| values.as_slice()).collect();
    let [first, last] = seen(&section.along, &values);
    let ends = [section.along[first], section.along[last]];
    let mut curves = Vec::new();
    for (number, (position, values)) in chosen.iter().enumerate() {
        let step = scene.results.fields.steps[*position];
        let colour = number % COLOURS;
        let exact = form(step);
        if let Some(exact) = &exact {
            let points = fine(ends).map(|s| {
                let [x, y] = section.point(s);
                [s, exact(x, y)]
            });
            curves.push(Curve { points: points.collect(), name: None, colour, stroke: Stroke::Dashed });
        }
        let stroke = if exact.is_some() { Stroke::Dots } else { Stroke::Line };
        let points = pairs(&section.along[first..=last], &values[first..=last]);
        curves.push(Curve { stroke, ..line(points, &scene.called(step), colour) });
    }
    curves
}

fn pressure_section(scene: &Scene<'_>, section: &Section) -> Result<String, Failure> {
    let fields = &scene.results.fields;
    let force = |step: usize| scene.results.table.at("normal_force", step);
    // The heaviest load first: it sets the scale.
    let mut candidates = scene.telling(2 * MOST_SECTIONS);
    candidates.sort_by(|a, b| force(fields.steps[*b]).total_cmp(&force(fields.steps[*a])));
    let chosen = distinct(candidates, |position| Ok(section.values(&fields.field("pressure", position)?)))?;
    let form = |step: usize| {
        let pressed = scene.normal_form?.under(force(step))?;
        Some(Box::new(move |x: f64, y: f64| pressed.pressure(x, y)) as Box<dyn Fn(f64, f64) -> f64>)
    };
    let curves = section_curves(scene, section, &chosen, form);
    let has_form = curves.iter().any(|curve| curve.stroke == Stroke::Dashed);
    let chart = Chart {
        what: "pressure along a line through the contact".to_owned(),
        axes: [scene.axis(section.name(), "length"), scene.axis("pressure", "pressure")],
        curves,
        logarithmic: false,
        level: None,
    };
    let caption = if has_form {
        "Pressure after these increments (stage, number in it): dots cell by cell, dashed Hertz under the same force."
    } else {
        "Pressure after these increments (stage, number in it). For this scene no closed form is known."
    };
    Ok(figure_of(&chart.svg(), caption))
}

fn shear_section(scene: &Scene<'_>, section: &Section, direction: [f64; 2]) -> Result<String, Failure> {
    let fields = &scene.results.fields;
    let [cosine, sine] = direction;
    let chosen = distinct(pushed_most(scene), |position| {
        let x = section.values(&fields.field("shear_x", position)?);
        let y = section.values(&fields.field("shear_y", position)?);
        Ok(x.iter().zip(&y).map(|(x, y)| cosine * x + sine * y).collect())
    })?;
    let form = |step: usize| {
        let after = scene.tangential_form.as_ref()?.after(step)?.clone();
        Some(Box::new(move |x: f64, y: f64| after.shear(x.hypot(y))) as Box<dyn Fn(f64, f64) -> f64>)
    };
    let curves = section_curves(scene, section, &chosen, form);
    let has_form = curves.iter().any(|curve| curve.stroke == Stroke::Dashed);
    let chart = Chart {
        what: "shear along a line through the contact".to_owned(),
        axes: [scene.axis(section.name(), "length"), scene.axis("shear", "pressure")],
        curves,
        logarithmic: false,
        level: None,
    };
    let caption = if has_form {
        "Shear along the push: dots cell by cell, dashed the closed form (Cattaneo, Mindlin and Deresiewicz)."
    } else {
        "Shear along the push."
    };
    Ok(figure_of(&chart.svg(), caption))
}

/// Kept increments of the last cycle, or of the whole history where there is none: the strongest push to either side first,
/// then the last, then the others evenly.
fn pushed_most(scene: &Scene<'_>) -> Vec<usize> {
    let steps = &scene.results.fields.steps;
    let [first, end] = scene.cycles().last().map_or([0, usize::MAX], |cycle| cycle.span);
    let mut inside: Vec<usize> =
        (0..steps.len()).filter(|&position| (first..end).contains(&steps[position])).collect();
    if inside.is_empty() {
        inside = (0..steps.len()).collect();
    }
    let push = |position: &usize| scene.tangential[steps[*position]];
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

/// Stick and slip through the history.
pub fn zones(scene: &Scene<'_>) -> Result<String, Failure> {
    let fields = &scene.results.fields;
    let chosen = scene.telling(MOST_MAPS);
    if !fields.has("zone") || chosen.is_empty() {
        return Ok(String::new());
    }
    let mut maps = Vec::new();
    for &position in &chosen {
        maps.push(fields.field("zone", position)?);
    }
    let Some(window) = map::Window::around(&maps) else { return Ok(String::new()) };
    let mut drawn = String::new();
    for (&position, field) in chosen.iter().zip(&maps) {
        let step = fields.steps[position];
        let called = scene.called(step);
        let drawing = map::zones(field, window, fields.spacing(), &format!("zones after {called}"));
        drawn += &figure_of(&drawing, &escaped(&called));
    }
    let legend = "<ul class=\"legend\"><li><span class=\"swatch stick\"></span>stick</li><li><span class=\"swatch slip\"></span>\
                  slip</li><li><span class=\"swatch open\"></span>no contact</li></ul>";
    let words = "<p>What each cell did in the increment: stage, number in it.</p>";
    Ok(chapter("Stick and slip", &format!("{words}{legend}<div class=\"maps\">{drawn}</div>\n")))
}
