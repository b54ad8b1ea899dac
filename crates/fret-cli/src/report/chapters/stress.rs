//! Stresses below the surface, where `fret stress` has computed them: their maxima, fatigue parameters, and its pictures.

use std::fs;
use std::path::Path;

use base64::prelude::{BASE64_STANDARD, Engine};
use maud::{Markup, html};

use crate::commands::stress_kinds::{kind_of_stress, stress_called};
use crate::commands::stress_record::{Bounded, CrackRecord, StressRecord, UNLIMITED};
use crate::drawing::chart::{Chart, Curve};
use crate::figures::figure;
use crate::report::html::{chapter, figure_of, side_by_side, table};
use crate::report::overview::Overview;

/// Pictures that are shown, at most.
const MOST_PICTURES: usize = 6;

/// The chapter; nothing where there is no `stress.json`, or an unreadable one.
pub fn stress(view: &Overview<'_>) -> Markup {
    let folder = view.results.path.join("stress");
    let Some(record) = fs::read(folder.join("stress.json"))
        .ok()
        .and_then(|text| serde_json::from_slice::<StressRecord>(&text).ok())
    else {
        return html! {};
    };
    let length = |value: f64| view.number(value, "length");
    let largest: Vec<Vec<String>> = record
        .largest
        .iter()
        .map(|found| {
            vec![
                stress_called(&found.measure),
                view.number(found.value, kind_of_stress(&found.measure)),
                found.increment.to_string(),
                length(found.x),
                length(found.y),
                length(found.depth),
                found.layer.clone(),
            ]
        })
        .collect();
    let fatigue: Vec<Vec<String>> = record
        .fatigue
        .iter()
        .flat_map(|fatigue| &fatigue.parameters)
        .map(|(name, found)| {
            let line = found.critical_distance.as_ref().map(|at| at.line.value);
            vec![
                stress_called(name),
                view.number(found.largest, kind_of_stress(name)),
                length(found.x),
                length(found.depth),
                line.map_or("–".to_owned(), |value| view.number(value, kind_of_stress(name))),
                bounded(found.cycles),
                bounded(found.factor_of_safety),
            ]
        })
        .collect();
    let mut figures: Vec<Markup> = over_depth(view, &folder, &record).into_iter().collect();
    for (name, address) in pictures(&folder, &record) {
        figures.push(figure_of(&html! { img class="picture" alt=(name) src=(address); }, &name));
    }
    let body = html! {
        p { "In the " (record.body) " body, from the kept tractions. Maxima over all increments and depths:" }
        (table(&["", "maximum", "increment", "x", "y", "depth", "in"], &largest))
        @if !fatigue.is_empty() {
            p class="after" { "Fatigue parameters over the last cycle, under all cells:" }
            (table(&["", "maximum", "x", "depth", "by the line method", "cycles to initiation", "factor of safety"], &fatigue))
        }
        @if let Some(sentence) = crack_of(&record) {
            p { (sentence) }
        }
        (side_by_side(&figures))
    };
    chapter("Stress below the surface", &body)
}

/// A number without a unit, or the word in its place; nothing where there is none.
fn bounded(value: Option<Bounded>) -> String {
    value.map_or_else(
        String::new,
        |Bounded(value)| {
            if value.is_finite() { figure(value) } else { UNLIMITED.to_owned() }
        },
    )
}

/// What becomes of the short crack, in a sentence.
fn crack_of(record: &StressRecord) -> Option<String> {
    let (fate, x, angle, length, cycles) = match record.fatigue.as_ref()?.crack.as_ref()? {
        CrackRecord::None { reason, .. } => return Some(format!("No crack was followed: {reason}.")),
        CrackRecord::Followed { fate, x, angle, length, cycles, .. } => (fate, x, angle, length, cycles),
    };
    let [x, angle, length] = [x, angle, length].map(|value| figure(*value));
    let becomes = match fate.as_str() {
        "does_not_grow" => format!("does not grow from its length of {length}"),
        "stops" => format!("stops at a length of {length}"),
        "fractures" => format!("reaches the toughness at a length of {length}"),
        _ => format!("grows to a length of {length}"),
    };
    let cycles = cycles.map_or(String::new(), |cycles| format!(" after {} cycles", figure(cycles)));
    Some(format!("A crack from x = {x}, {angle} degrees from the normal of the surface, {becomes}{cycles}."))
}

/// Von Mises stress over the depth, largest at each, in the increment where it is largest of all.
fn over_depth(view: &Overview<'_>, folder: &Path, record: &StressRecord) -> Option<Markup> {
    let worst = worst(record)?;
    let text = fs::read_to_string(folder.join("depths.csv")).ok()?;
    let mut lines = text.lines();
    let place =
        |name: &str, head: &str| head.split(',').position(|column| column.split(" [").next() == Some(name));
    let head = lines.next()?;
    let [increment, depth, mises, tension] =
        ["increment", "depth", "von_mises", "tension"].map(|name| place(name, head));
    let rows: Vec<Vec<&str>> = lines.map(|line| line.split(',').collect()).collect();
    let of = |column: usize| -> Vec<[f64; 2]> {
        let mine = rows.iter().filter(|row| {
            increment.and_then(|at| row.get(at)).is_some_and(|found| *found == worst.to_string())
        });
        let number =
            |row: &Vec<&str>, at: usize| row.get(at).and_then(|word| word.parse().ok()).unwrap_or(f64::NAN);
        mine.map(|row| [depth.map_or(f64::NAN, |at| number(row, at)), number(row, column)]).collect()
    };
    let curves = vec![
        Curve::line(of(mises?), "von Mises", 0),
        Curve::line(of(tension?), "largest principal stress", 1),
    ];
    let axes = [view.label("depth", "length"), view.label("stress", "pressure")];
    let chart = Chart::new("maximum stress over the depth", axes, curves);
    Some(figure_of(&chart.in_page(), &format!("Largest values at each depth in increment {worst}.")))
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
