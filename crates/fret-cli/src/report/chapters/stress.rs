//! Stresses below the surface, where `fret stress` has computed them: their maxima, fatigue parameters, and its pictures.

use std::fs;
use std::path::Path;

use base64::prelude::{BASE64_STANDARD, Engine};
use fret_core::units::Units;
use maud::{Markup, html};

use crate::figures::{bounded, capitalised};
use crate::report::{Measured, Overview, answer_beside, chapter, grid, side_by_side};
use crate::stress::{FilmRecord, LargestRecord, ParameterRecord, StressRecord};
use crate::stress::{kind_of_stress, stress_called};
use crate::table::{Cell, Columns};
use fret_drawing::{Chart, Curve, Drawing};
use fret_results::STRESS;

/// Pictures that are shown, at most.
const MOST_PICTURES: usize = 6;

/// The chapter; nothing where there is no `stress.json`.
pub fn stress(view: &Overview<'_>) -> Markup {
    let record: StressRecord = match answer_beside(&view.results.path, STRESS) {
        Some(Ok(record)) => record,
        Some(Err(why)) => return chapter("Stress below the surface", &html! { p class="small" { (why) } }),
        None => return html! {},
    };
    let folder = view.results.path.join(STRESS[0]);
    let parameters: Vec<_> = record.fatigue.iter().flat_map(|fatigue| &fatigue.parameters).collect();
    let columns = Columns::<(&String, &ParameterRecord)>::new()
        .column("", "", |(name, _)| stress_called(name))
        .column("maximum", "", |(name, found)| Cell::Of(found.largest, kind_of_stress(name)))
        .column("x", "length", |(_, found)| found.x)
        .column("depth", "length", |(_, found)| found.depth)
        .column("by the line method", "", |(name, found)| match &found.critical_distance {
            Some(at) => Cell::Of(at.line.value, kind_of_stress(name)),
            None => "–".into(),
        })
        .column("cycles to initiation", "", |(_, found)| found.cycles.map(|cycles| bounded(cycles.0)))
        .column("factor of safety", "", |(_, found)| found.factor_of_safety.map(|factor| bounded(factor.0)));
    let number = |value: f64, kind: &str| view.number(value, kind);
    let mut figures: Vec<Markup> = over_depth(view, &folder, &record).into_iter().collect();
    for (name, address) in pictures(&folder, &record) {
        figures.push(Drawing::captioned(&html! { img class="picture" alt=(name) src=(address); }, &name));
    }
    let body = html! {
        p { "In the " (record.body) " body, from the kept tractions. Maxima over all increments and depths:" }
        (grid(&LargestRecord::columns(stress_called), &record.largest, number))
        @for why in [&record.unfinished, &record.stage_ends_alone, &record.places_travel].into_iter().flatten() {
            p class="small" { (capitalised(why)) "." }
        }
        @if !parameters.is_empty() {
            p class="after" { "Fatigue parameters over the last cycle, under all cells:" }
            (grid(&columns, parameters, number))
        }
        @if let Some(crack) = record.fatigue.as_ref().and_then(|fatigue| fatigue.crack.as_ref()) {
            p { (capitalised(&crack.words(number))) "." }
        }
        @if let Some(films) = &record.coating {
            p class="after" { "Fracture of the outermost coating:" }
            (grid(&FilmRecord::columns(), films, number))
        }
        (side_by_side(&figures))
    };
    chapter("Stress below the surface", &body)
}

/// Von Mises stress over the depth, largest at each, in the increment where it is largest of all.
fn over_depth(view: &Overview<'_>, folder: &Path, record: &StressRecord) -> Option<Markup> {
    let worst = worst(record)?.to_string();
    let text = fs::read_to_string(folder.join("depths.csv")).ok()?;
    let mut lines = text.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let head = lines.next()?;
    let place = |name: &str| head.iter().position(|column| Units::name_of(column) == name);
    let (increment, depth) = (place("increment")?, place("depth")?);
    let rows: Vec<Vec<&str>> = lines.filter(|row| row.get(increment) == Some(&worst.as_str())).collect();
    let of = |column: usize| {
        let number =
            |row: &[&str], at: usize| row.get(at).and_then(|word| word.parse().ok()).unwrap_or(f64::NAN);
        rows.iter().map(|row| [number(row, depth), number(row, column)]).collect()
    };
    let curves = vec![
        Curve::line(of(place("von_mises")?), "von Mises", 0),
        Curve::line(of(place("tension")?), "largest principal stress", 1),
    ];
    let axes = [view.label("depth", "length"), view.label("stress", "pressure")];
    let chart = Chart::new("maximum stress over the depth", axes, curves);
    Some(chart.figure(&format!("Largest values at each depth in increment {worst}.")))
}

/// The increment of the largest von Mises stress.
fn worst(record: &StressRecord) -> Option<usize> {
    record.largest.iter().find(|found| found.measure == "von_mises").map(|found| found.increment)
}

/// Pictures of the folder: von Mises stress of the worst increment, and what fatigue shows.
fn pictures(folder: &Path, record: &StressRecord) -> Vec<(String, String)> {
    let mut names: Vec<String> = fs::read_dir(folder)
        .into_iter()
        .flatten()
        .filter_map(|entry| entry.ok()?.file_name().into_string().ok())
        .filter(|name| Path::new(name).extension().is_some_and(|extension| extension == "svg"))
        .collect();
    names.sort();
    let worst = worst(record).map(|worst| format!("von_mises-{worst:05}.svg"));
    names.retain(|name| !name.starts_with("von_mises-") || Some(name) == worst.as_ref());
    names.sort_by_key(|name| Some(name) != worst.as_ref());
    let picture = |name: String| {
        let svg = fs::read(folder.join(&name)).ok()?;
        let said = stress_called(name.trim_end_matches(".svg").split('-').next().unwrap_or_default());
        Some((said, format!("data:image/svg+xml;base64,{}", BASE64_STANDARD.encode(svg))))
    };
    names.into_iter().take(MOST_PICTURES).filter_map(picture).collect()
}
