//! The question as it was understood, and which simplifications were used.

use fret_core::case::{Course, Path, Stage, StageControl};
use fret_core::model::controls::{Kind, NORMAL, ways};
use fret_core::model::{
    Base, Body, CellValues, Coating, CoulombFriction, Dimension, ElasticMaterial, EvolutionDriver,
    EvolutionLaw, HeightsSummary, MapSummary, Profile, WearLaw, WearRule,
};
use fret_core::plan::Coupling;
use maud::{Markup, Render, html};
use serde_json::{Value, json};

use crate::figures::counted;
use crate::report::{Measured, Overview, chapter, given, pairs};

/// Coatings that are listed one by one.
const MOST_COATINGS: usize = 4;

/// The case as it was understood.
pub fn question(view: &Overview<'_>) -> Markup {
    let (plan, case) = (view.results.plan(), view.results.case());
    let mut rows: Vec<(String, Markup)> = Vec::new();
    let mut row = |name: &str, told: &dyn Render| rows.push((name.to_owned(), html! { (told) }));
    row("upper body", &body(view, case.bodies.upper()));
    row("lower body", &body(view, case.bodies.lower()));
    row("profile", &profile(view, &case.profile));
    row("friction", &friction(view, &case.friction));
    let [nx, ny] = view.results.fields.cells();
    let [dx, dy] = view.results.fields.spacing().map(|side| view.number(side, "length"));
    let repeats = match case.periodic.in_words() {
        "" => String::new(),
        words => format!(", {words}"),
    };
    match view.dimension() {
        Dimension::Plane => row("grid", &format!("{nx} × {ny} cells of {dx} × {dy}{repeats}")),
        Dimension::Line => row("line contact", &format!("{nx} cells of {dx}; loads per unit length")),
    }
    if let Some(datum) = plan.datum {
        let depth = view.number(datum, "length");
        row("approach and displacement", &format!("relative to {depth} below the load"));
    }
    let solved = match plan.coupling {
        Coupling::Frictionless => "pressure alone: there is no friction",
        Coupling::Uncoupled => "pressure, then shear: elastically similar bodies",
        Coupling::Coupled => "pressure and shear together: normal-tangential coupling",
    };
    row("solved", &solved);
    if let Some(hardness) = case.hardness {
        let hardness = view.given(hardness, "pressure");
        row("hardness", &format!("{hardness}; the softer surface is elastic and perfectly plastic"));
    }
    if let Some(rule) = &case.wear {
        row("wear", &wear(view, rule));
    }
    for (number, stage) in case.stages.iter().enumerate() {
        row(&format!("stage {}", number + 1), &self::stage(view, stage));
    }
    let units = match view.results.units() {
        Some(units) => {
            format!("Units: length {}, force {}, pressure {}.", units.length, units.force, units.pressure)
        }
        None => "The case declares no units: all numbers are in its own, which may be any consistent set."
            .to_owned(),
    };
    chapter("The case", &html! { (pairs(rows)) p class="small" { (units) } })
}

fn body(view: &Overview<'_>, body: &Body) -> Markup {
    let Body::Elastic(half_space) = body else { return html! { "rigid" } };
    let material = |material: &ElasticMaterial| {
        html! {
            i { "E" } " " (view.given(material.young(), "pressure")) ", " i { "ν" } " " (given(material.poisson()))
        }
    };
    let coatings = half_space.coatings();
    html! {
        @if coatings.len() > MOST_COATINGS {
            @let thickness: f64 = coatings.iter().map(Coating::thickness).sum();
            (coatings.len()) " layers, " (view.given(thickness, "length")) " thick in all; "
        } @else {
            @for coating in coatings {
                "coating " (view.given(coating.thickness(), "length")) " thick, " (material(coating.material())) "; "
            }
        }
        @match half_space.base() {
            Base::Rigid => { "on a rigid base" }
            Base::Elastic(substrate) => {
                @if !coatings.is_empty() { "on a substrate, " }
                (material(substrate))
            }
        }
    }
}

fn profile(view: &Overview<'_>, profile: &Profile<HeightsSummary>) -> String {
    let heights: Vec<String> = profile.heights.iter().map(|heights| topography(view, heights)).collect();
    let shapes: Vec<String> = profile.shapes.iter().map(|shape| described(view, &json!(shape))).collect();
    let parts = [heights, shapes].map(|parts| parts.join(" and "));
    parts.into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join(", ")
}

/// A shape in words: names and numbers in the order of their names. All its numbers but slopes and counts of sides are lengths.
fn described(view: &Overview<'_>, value: &Value) -> String {
    match value {
        Value::Object(map) => {
            let parts: Vec<String> = map
                .iter()
                .filter(|(_, value)| !value.is_null())
                .map(|(name, value)| match value {
                    Value::Number(slope) if matches!(name.as_str(), "slope" | "sides") => {
                        format!("{name} {}", slope.as_f64().map_or_else(String::new, given))
                    }
                    // Of the numbers of a formula its author knows the units.
                    Value::Object(parameters) if name == "parameters" => {
                        let own = |(name, value): (&String, &Value)| {
                            format!("{name} = {}", value.as_f64().map_or_else(String::new, given))
                        };
                        parameters.iter().map(own).collect::<Vec<_>>().join(", ")
                    }
                    _ => format!("{} {}", name.replace('_', " "), described(view, value)),
                })
                .collect();
            parts.join(", ")
        }
        Value::Array(items) => items.iter().map(|item| described(view, item)).collect::<Vec<_>>().join(" × "),
        Value::Number(number) => {
            number.as_f64().map_or_else(|| number.to_string(), |number| view.given(number, "length"))
        }
        Value::String(word) => word.clone(),
        Value::Null => "straight".to_owned(),
        Value::Bool(truth) => truth.to_string(),
    }
}

/// Measured heights by what a person asks of them.
fn topography(view: &Overview<'_>, heights: &HeightsSummary) -> String {
    let source = &heights.source;
    let of = if source.is_empty() { String::new() } else { format!(" of {source}") };
    let [rms, valley] = [heights.rms, heights.valley].map(|height| view.number(height, "length"));
    format!("topography{of}: rms {rms} about the mean, {valley} from the highest point to the lowest")
}

fn wear(view: &Overview<'_>, wear: &WearRule) -> String {
    let coefficient = |value: f64| view.given(value, "1/pressure");
    let law = match wear.law {
        WearLaw::Energy => "by dissipated energy",
        WearLaw::Archard => "by Archard's law",
    };
    let mut parts = vec![match wear.coefficient {
        Some(value) if wear.layers.is_none() => format!("{law}, coefficient {}", coefficient(value)),
        _ => law.to_owned(),
    }];
    if let Some(layers) = &wear.layers {
        for (body, layers) in ["lower", "upper"].into_iter().zip(layers.bodies()) {
            let told: Vec<String> = layers.iter().map(|layer| coefficient(layer.coefficient)).collect();
            if !told.is_empty() {
                parts.push(format!("{body} body {}", told.join(", then ")));
            }
        }
    }
    if let Some(debris) = &wear.debris {
        let flows = debris.outflow_length.map_or("none flows out".to_owned(), |length| {
            format!("all but 1/e flows out in a slip distance of {}", view.given(length, "length"))
        });
        let gives = debris.stiffness.map_or(String::new(), |modulus| {
            format!("; it gives by pressure x thickness over {}", view.given(modulus, "pressure"))
        });
        parts.push(format!("{} of it stays as debris, of which {flows}{gives}", given(debris.fraction)));
    }
    if let Some(rim) = &wear.rim {
        let [lower, upper] = rim.interior;
        let inside = if lower == upper {
            given(lower)
        } else {
            format!("{} (lower), {} (upper)", given(lower), given(upper))
        };
        let width = view.given(rim.width, "length");
        parts.push(format!("farther than {width} from the rim {inside} times the coefficient"));
    }
    if let Some(tolerance) = wear.thinning_tolerance {
        parts.push(format!("worn layers are thinner, followed to {}", given(tolerance)));
    }
    if let Some(tolerance) = wear.tolerance {
        parts.push(format!("cycle jumps with an error of at most {}", given(tolerance)));
    }
    if wear.every > 1 {
        parts.push(format!("a computed cycle stands for at most {}", wear.every));
    }
    if let Some(limit) = wear.limit {
        parts.push(format!("ends at a wear depth of {}", view.given(limit, "length")));
    }
    parts.join(", ")
}

fn friction(view: &Overview<'_>, friction: &CoulombFriction<MapSummary>) -> Markup {
    html! {
        @match friction.coefficient() {
            CellValues::Uniform(0.0) => { "none" }
            CellValues::Uniform(coefficient) => { i { "μ" } " " (given(*coefficient)) }
            CellValues::Map(map) => {
                "a map of " i { "μ" } " from " (given(map.smallest)) " to " (given(map.largest))
            }
        }
        @if let Some(words) = evolution(view) { ", " (words) }
        @match friction.max_shear() {
            Some(CellValues::Uniform(strength)) => { ", shear at most " (view.given(*strength, "pressure")) }
            Some(CellValues::Map(_)) => { ", a map of shear strengths" }
            None => {}
        }
    }
}

/// How friction evolves, where it does.
fn evolution(view: &Overview<'_>) -> Option<String> {
    let evolution = view.results.case().friction_evolution.as_ref()?;
    let (over, kind) = match evolution.by {
        EvolutionDriver::Energy => ("dissipated energy by area", "force/length"),
        EvolutionDriver::SlipDistance => ("slip distance", "length"),
        EvolutionDriver::Cycles => ("cycles", ""),
    };
    let driver = |value: f64| view.given(value, kind);
    let law = match &evolution.law {
        EvolutionLaw::Exponential { last, scale } => {
            format!("tends to {} over a scale of {}", given(*last), driver(*scale))
        }
        EvolutionLaw::Table(rows) => {
            let row = |[at, value]: &[f64; 2]| format!("{} at {}", given(*value), driver(*at));
            rows.iter().map(row).collect::<Vec<_>>().join(", ")
        }
    };
    let jumps = match evolution.every {
        0 | 1 => String::new(),
        every => format!("; a computed cycle stands for at most {every}"),
    };
    Some(format!("evolves with the {over} of each cell: {law}{jumps}"))
}

/// What pages call by other words than cases.
const CALLED: [(&str, &str); 3] =
    [("twist_moment", "torsional_moment"), ("twist", "rotation"), ("shift", "displacement")];

/// What a stage prescribes in a degree of freedom, by its row of the table of controls; none of one that stays at zero.
fn control(view: &Overview<'_>, freedom: usize, control: &StageControl) -> Option<String> {
    let (kind, mut run) = match control {
        StageControl::Force(run) => (Kind::Force, run.clone()),
        StageControl::Motion(run) => (Kind::Motion, run.clone()),
        StageControl::FarEnd(run) => (Kind::FarEnd, run.clone()),
        StageControl::Rate(run) => (Kind::Rate, run.clone()),
    };
    let is_gap = freedom == NORMAL && kind == Kind::Motion && view.results.case().counts_mean_gap();
    if is_gap {
        // a case prescribes the gap; a stage holds how far that is below the mean plane
        let table = &view.results.table;
        run = run.below(table.at("approach", 0) + table.at("mean_gap", 0));
    }
    let kind = if is_gap { Kind::MeanGap } else { kind };
    let (row, way) = ways().find(|(row, way)| way.kind == kind && row.freedoms().contains(&freedom))?;
    let (name, _) = row.columns(way).find(|(_, of)| *of == freedom)?;
    let name = CALLED.iter().fold(name, |name, (word, called)| name.replace(word, called));
    Some(format!("{} {}", name.replace('_', " "), path(view, &run, way.unit)?))
}

fn stage(view: &Overview<'_>, stage: &Stage<MapSummary>) -> Markup {
    let controls = stage.by_freedom().into_iter().enumerate();
    let told = controls.filter_map(|(freedom, of)| control(view, freedom, of?));
    let mut parts: Vec<String> = told.collect();
    if stage.steady {
        let [x, y] = stage.roll_direction.map(given);
        parts.push(format!("rolled on along [{x}, {y}] until steady"));
    }
    let increments = counted(stage.increments, "increment");
    let course = match &stage.course {
        Course::Cycles(cycles) => {
            let until = cycles.until_steady.map(given);
            let until = until.map_or(String::new(), |until| format!("until steady to {until}, at most "));
            format!("{until}{} of {increments}", counted(cycles.most, "cycle"))
        }
        Course::Linear => format!("linear in {increments}"),
        Course::Square => format!("square in {increments}"),
        Course::Cubic => format!("cubic in {increments}"),
    };
    html! {
        b { (stage.name) } ": " (parts.join(", ")) "; " (course)
        @if let Some(law) = &stage.friction { "; from here on " (friction(view, law)) }
    }
}

/// What a control runs through; none of one that stays at zero.
fn path(view: &Overview<'_>, path: &Path, unit: &str) -> Option<String> {
    match path {
        Path::To(value) => Some(view.given(*value, unit)),
        Path::Wave { amplitude: 0.0, .. } => None,
        Path::Wave { amplitude, phase } => {
            let ahead =
                if *phase == 0.0 { String::new() } else { format!(" with phase {}°", given(360.0 * phase)) };
            Some(format!("± {}{ahead}", view.given(*amplitude, unit)))
        }
        Path::Through(values) => Some(format!("through {} values of a table", values.len())),
    }
}

/// The simplifications that were used, and why.
pub fn simplifications(view: &Overview<'_>) -> Markup {
    let items = &view.results.plan().left_out;
    let body = html! {
        @if items.is_empty() {
            p { "None: every part of the model was needed." }
        } @else {
            p { "Same result to the solver tolerance." }
            ul class="out" {
                @for item in items { li { (item.what) ", because " (item.why) ". Saves " (item.saves) "." } }
            }
        }
    };
    chapter("Automatic simplifications", &body)
}
