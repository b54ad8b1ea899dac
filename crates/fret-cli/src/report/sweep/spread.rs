//! What the samples of a sweep say: quantiles, curves of cumulative frequency, Sobol' indices; over an axis the band of its samples.

use std::collections::BTreeMap;

use fret_core::uncertainty::{Distribution, Sensitivity};
use maud::{Markup, html};
use serde_json::{Value, json};

use super::view::View;
use super::words::{called, spoken};
use crate::figures::{bounded, figure};
use crate::report::{Measured, chapter, grid, side_by_side};
use crate::sweep::{Quantities, QuantityRecord, SpreadRecord};
use fret_drawing::{Chart, Curve, Label, Stroke};

/// Numbers that vary by less, relative, do not.
const ROUNDING: f64 = 1e-9;
/// Points of an axis of which the samples are told, at the most.
const MOST_POINTS: usize = 12;
/// Charts of cumulative frequency at the most.
const MOST_CHARTS: usize = 9;

/// The chapter; nothing of a sweep without samples.
pub fn spread(view: &View) -> Markup {
    let Some(told) = &view.uncertainty else { return html! {} };
    let points = told.points.iter().flatten().map(|point| (place(view, &point.values), &point.quantities));
    let alone = told.quantities.iter().map(|quantities| (String::new(), quantities));
    let parts: Vec<(String, &Quantities)> = points.chain(alone).collect();
    let all = parts.len();
    let body = html! {
        p { (distributions(view, told)) }
        @if all > 1 { (bands(view, &parts)) }
        @for (name, quantities) in parts.iter().take(MOST_POINTS) {
            @if !name.is_empty() { h3 { (name) } }
            (quantiles(view, quantities))
            (indices(quantities))
        }
        @if all > MOST_POINTS { p class="small" { (MOST_POINTS) " of " (all) " points; " code { "uncertainty.json" } " has all." } }
        @if all == 1 { (frequencies(view)) }
    };
    chapter("Uncertainty", &body)
}

fn place(view: &View, values: &BTreeMap<String, Value>) -> String {
    let one = |(key, value): (&String, &Value)| {
        let number = view.record.keys.iter().position(|known| known == key);
        let value = number.map_or_else(|| value.to_string(), |number| view.value(number, value));
        format!("{} = {value}", called(key))
    };
    values.iter().map(one).collect::<Vec<_>>().join(", ")
}

/// Which keys were drawn, and from what.
fn distributions(view: &View, told: &SpreadRecord) -> String {
    let one = |(key, of): (&String, &Distribution)| {
        let parts: BTreeMap<String, BTreeMap<String, f64>> =
            serde_json::from_value(json!(of)).unwrap_or_default();
        let words = parts.iter().map(|(kind, numbers)| {
            let numbers = numbers.iter().map(|(name, value)| format!(", {name} {}", figure(*value)));
            kind.clone() + &numbers.collect::<String>()
        });
        let number = view.record.keys.iter().position(|known| known == key);
        let unit = number.and_then(|number| view.key_label(number).unit);
        let unit = unit.map_or_else(String::new, |unit| format!(" [{unit}]"));
        format!("{}{unit} ({})", called(key), words.collect::<String>())
    };
    let keys: Vec<_> = told.distributions.iter().map(one).collect();
    format!("{} samples of {}.", told.count, keys.join("; "))
}

/// Name and entry of the quantities that vary.
fn varying(quantities: &Quantities) -> impl Iterator<Item = (&String, &QuantityRecord)> {
    quantities.iter().filter(|(_, of)| of.statistics.varies(ROUNDING))
}

fn quantiles(view: &View, quantities: &Quantities) -> Markup {
    let number = |value: f64, _: &str| match value {
        value if value.is_nan() => "–".to_owned(),
        value => bounded(value).replace('-', "−"),
    };
    let unit = |name: &str| view.column(name).and_then(|column| view.unit(&column.kind));
    let columns = QuantityRecord::columns("quantity".to_owned(), spoken);
    let columns = columns.column("unit", "", |(name, _)| unit(name));
    let rows = varying(quantities).map(|(name, of)| (name.clone(), of.clone()));
    grid(&columns, rows, number)
}

/// Bars of the first-order and total indices of every quantity.
fn indices(quantities: &Quantities) -> Markup {
    let with: Vec<_> =
        varying(quantities).filter_map(|(name, of)| Some((name, of.sobol_indices.as_ref()?))).collect();
    if with.is_empty() {
        return html! {};
    }
    html! {
        p class="after" { "Sobol' indices: the share of the variance that a key explains alone (dark) and with all its interactions (light)." }
        div class="scroll" {
            table class="grid bars" {
                tbody {
                    @for (name, keys) in with {
                        @for (place, (key, index)) in keys.iter().enumerate() {
                            tr {
                                td { @if place == 0 { (spoken(name)) } }
                                td { (called(key)) }
                                td { (bar(index)) }
                                td { (share(index.first)) }
                                td { (share(index.total)) }
                            }
                        }
                    }
                }
            }
        }
    }
}

/// An index; zero where the variance is beyond all numbers.
fn known(index: f64) -> f64 {
    if index.is_finite() { index } else { 0.0 }
}

fn share(index: f64) -> String {
    format!("{:.2}", known(index)).replace('-', "−")
}

fn bar(index: &Sensitivity) -> Markup {
    let width = |share: f64| format!("{:.1}", 120.0 * known(share).clamp(0.0, 1.0));
    html! {
        svg viewBox="0 0 120 12" width="120" height="12" aria-hidden="true" {
            rect class="bar total" width=(width(index.total)) height="12" {}
            rect class="bar" width=(width(index.first)) height="12" {}
        }
    }
}

/// Cumulative frequency of the numbers of the first samples, those that are none of the indices' own.
fn frequencies(view: &View) -> Markup {
    let Some(SpreadRecord { count, indices, quantities: Some(quantities), .. }) = &view.uncertainty else {
        return html! {};
    };
    let own = if *indices { 2 * count } else { *count };
    let chart = |(name, _): (&String, &QuantityRecord)| {
        let column = view.column(name)?;
        let mut values = column.numbers();
        values.truncate(own);
        values.retain(|value| value.is_finite());
        values.sort_by(f64::total_cmp);
        let all = values.len() as f64;
        let points =
            values.iter().enumerate().map(|(place, value)| [*value, (place as f64 + 0.5) / all]).collect();
        let curve = Curve::plain(points);
        let axes = [view.label_of(column), Label::plain("fraction of the samples below")];
        let chart =
            Chart { ranges: [None, Some([0.0, 1.0])], ..Chart::new(&spoken(name), axes, vec![curve]) };
        Some(chart.figure(&format!("Cumulative frequency: {}.", spoken(name))))
    };
    let figures: Vec<Markup> = varying(quantities).filter_map(chart).take(MOST_CHARTS).collect();
    html! { div class="after" { (side_by_side(&figures)) } }
}

/// Over a single numeric axis: median, and the band between the quantiles 2.5 % and 97.5 %.
fn bands(view: &View, parts: &[(String, &Quantities)]) -> Markup {
    let [axis] = view.axes()[..] else { return html! {} };
    if !view.is_numeric(axis) {
        return html! {};
    }
    let values: Vec<f64> = view.distinct(axis).iter().filter_map(|value| value.as_f64()).collect();
    let varying = parts.first().into_iter().flat_map(|(_, first)| varying(first));
    let chart = |(name, _): (&String, &QuantityRecord)| {
        let column = view.column(name)?;
        let curve = |place: usize, words: &str, stroke: Stroke| {
            let points = values.iter().zip(parts).filter_map(|(x, (_, of))| {
                let quantile = of.get(name)?.statistics.quantiles[place];
                quantile.is_finite().then_some([*x, quantile])
            });
            Curve { stroke, ..Curve::line(points.collect(), words, 0) }
        };
        let low = Curve { name: None, ..curve(0, "", Stroke::Dashed) };
        let curves =
            vec![low, curve(4, "2.5 % and 97.5 %", Stroke::Dashed), curve(2, "median", Stroke::Line)];
        let chart = Chart::new(&spoken(name), [view.key_label(axis), view.label_of(column)], curves);
        Some(chart.figure(&format!("Scatter of {}.", spoken(name))))
    };
    let figures: Vec<Markup> = varying.filter_map(chart).take(MOST_CHARTS).collect();
    side_by_side(&figures)
}
