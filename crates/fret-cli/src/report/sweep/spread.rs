//! What the samples of a sweep say: quantiles, curves of cumulative frequency, Sobol' indices; over an axis the band of its samples.

use maud::{Markup, html};
use serde_json::Value;

use super::view::{View, called, spoken};
use crate::drawing::chart::{Chart, Curve, Stroke};
use crate::drawing::scale::Label;
use crate::figures::figure;
use crate::report::html::{chapter, figure_of, side_by_side, table};
use crate::sweep::columns::{SummaryColumn, number as told};

/// Numbers that vary by less, relative, do not.
const ROUNDING: f64 = 1e-9;
/// Points of an axis of which the samples are told, at the most.
const MOST_POINTS: usize = 12;
/// Charts of cumulative frequency at the most.
const MOST_CHARTS: usize = 9;

/// The chapter; nothing of a sweep without samples.
pub fn spread(view: &View) -> Markup {
    let Some(told) = &view.uncertainty else { return html! {} };
    let parts: Vec<(String, &Value)> = match told["points"].as_array() {
        Some(points) => {
            points.iter().map(|point| (place(view, &point["values"]), &point["quantities"])).collect()
        }
        None => vec![(String::new(), &told["quantities"])],
    };
    let all = parts.len();
    let body = html! {
        p { (distributions(told)) }
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

fn place(view: &View, values: &Value) -> String {
    let Some(values) = values.as_object() else { return String::new() };
    let one = |(key, value): (&String, &Value)| {
        let number = view.record.keys.iter().position(|known| known == key);
        let value = number.map_or_else(|| value.to_string(), |number| view.value(number, value));
        format!("{} = {value}", called(key))
    };
    values.iter().map(one).collect::<Vec<_>>().join(", ")
}

/// Which keys were drawn, and from what.
fn distributions(told: &Value) -> String {
    let Some(keys) = told["distributions"].as_object() else { return String::new() };
    let number = |value: &Value| value.as_f64().map_or_else(|| value.to_string(), figure);
    let one = |(key, of): (&String, &Value)| {
        let kind = of.as_object().and_then(|of| of.iter().next());
        let words = kind.map_or(String::new(), |(kind, of)| {
            let parts = of.as_object().into_iter().flatten();
            let parts: Vec<_> = parts.map(|(name, value)| format!("{name} {}", number(value))).collect();
            format!("{kind}, {}", parts.join(", "))
        });
        format!("{} ({words})", called(key))
    };
    let keys: Vec<_> = keys.iter().map(one).collect();
    format!("{} samples of {}.", told["count"], keys.join("; "))
}

/// Name and entry of the quantities that vary.
fn varying(quantities: &Value) -> Vec<(&String, &Value)> {
    let varies = |of: &Value| {
        let [deviation, min, max] = ["deviation", "min", "max"].map(|name| told(&of[name]));
        // what is endless in some samples has no deviation, and varies
        deviation > ROUNDING * min.abs().max(max.abs()) || min < max && (max - min).is_infinite()
    };
    quantities.as_object().into_iter().flatten().filter(|(_, of)| varies(of)).collect()
}

fn column_called<'a>(view: &'a View, name: &str) -> Option<&'a SummaryColumn> {
    view.column(name)
}

fn quantiles(view: &View, quantities: &Value) -> Markup {
    let row = |(name, of): (&String, &Value)| {
        let unit = column_called(view, name).and_then(|column| view.unit(&column.kind)).unwrap_or_default();
        let number = |value: &Value| match told(value) {
            f64::INFINITY => "unlimited".to_owned(),
            value if value.is_nan() => "–".to_owned(),
            value => figure(value).replace('-', "−"),
        };
        let quantile = |place: usize| number(&of["quantiles"][place]);
        vec![
            spoken(name),
            number(&of["mean"]),
            number(&of["deviation"]),
            quantile(0),
            quantile(2),
            quantile(4),
            unit,
        ]
    };
    let rows: Vec<_> = varying(quantities).into_iter().map(row).collect();
    table(&["quantity", "mean", "deviation", "2.5 %", "median", "97.5 %", "unit"], &rows)
}

/// Bars of the first-order and total indices of every quantity.
fn indices(quantities: &Value) -> Markup {
    let with = varying(quantities)
        .into_iter()
        .filter_map(|(name, of)| Some((name, of["sobol_indices"].as_object()?)));
    let with: Vec<_> = with.collect();
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
                                td { (format!("{:.2}", index["first"].as_f64().unwrap_or(0.0)).replace('-', "−")) }
                                td { (format!("{:.2}", index["total"].as_f64().unwrap_or(0.0)).replace('-', "−")) }
                            }
                        }
                    }
                }
            }
        }
    }
}

fn bar(index: &Value) -> Markup {
    let share = |name: &str| 120.0 * index[name].as_f64().unwrap_or(0.0).clamp(0.0, 1.0);
    html! {
        svg viewBox="0 0 120 12" width="120" height="12" aria-hidden="true" {
            rect class="bar total" width=(format!("{:.1}", share("total"))) height="12" {}
            rect class="bar" width=(format!("{:.1}", share("first"))) height="12" {}
        }
    }
}

/// Cumulative frequency of the numbers of the first samples, those that are none of the indices' own.
fn frequencies(view: &View) -> Markup {
    let Some(told) = &view.uncertainty else { return html! {} };
    let count = told["count"].as_u64().unwrap_or(0) as usize;
    let own = if told["indices"] == true { 2 * count } else { count };
    let chart = |(name, _): (&String, &Value)| {
        let column = column_called(view, name)?;
        let mut values = column.numbers();
        values.truncate(own);
        values.retain(|value| value.is_finite());
        values.sort_by(f64::total_cmp);
        let all = values.len() as f64;
        let points =
            values.iter().enumerate().map(|(place, value)| [*value, (place as f64 + 0.5) / all]).collect();
        let curve = Curve { name: None, ..Curve::line(points, "", 0) };
        let axes = [view.label(column), Label::plain("fraction of the samples below")];
        let chart =
            Chart { ranges: [None, Some([0.0, 1.0])], ..Chart::new(&spoken(name), axes, vec![curve]) };
        Some(figure_of(&chart.in_page(), &format!("Cumulative frequency: {}.", spoken(name))))
    };
    let figures: Vec<Markup> =
        varying(&told["quantities"]).into_iter().filter_map(chart).take(MOST_CHARTS).collect();
    html! { div class="after" { (side_by_side(&figures)) } }
}

/// Over a single numeric axis: median, and the band between the quantiles 2.5 % and 97.5 %.
fn bands(view: &View, parts: &[(String, &Value)]) -> Markup {
    let [axis] = view.axes()[..] else { return html! {} };
    if !view.is_numeric(axis) {
        return html! {};
    }
    let values: Vec<f64> = view.distinct(axis).iter().filter_map(|value| value.as_f64()).collect();
    let names: Vec<&String> = parts
        .first()
        .map(|(_, first)| varying(first).into_iter().map(|(name, _)| name).collect())
        .unwrap_or_default();
    let chart = |name: &&String| {
        let column = column_called(view, name)?;
        let curve = |place: usize, words: &str, stroke: Stroke| {
            let points = values
                .iter()
                .zip(parts)
                .filter_map(|(x, (_, of))| Some([*x, of[name.as_str()]["quantiles"][place].as_f64()?]));
            Curve { stroke, ..Curve::line(points.collect(), words, 0) }
        };
        let low = Curve { name: None, ..curve(0, "", Stroke::Dashed) };
        let curves =
            vec![low, curve(4, "2.5 % and 97.5 %", Stroke::Dashed), curve(2, "median", Stroke::Line)];
        let chart = Chart::new(&spoken(name), [view.key_label(axis), view.label(column)], curves);
        Some(figure_of(&chart.in_page(), &format!("Scatter of {}.", spoken(name))))
    };
    let figures: Vec<Markup> = names.iter().filter_map(chart).take(MOST_CHARTS).collect();
    side_by_side(&figures)
}
