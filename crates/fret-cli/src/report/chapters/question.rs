//! The question as it was understood, and which simplifications were used.

use maud::{Markup, html};
use serde_json::Value;

use crate::figures::counted;
use crate::report::html::{chapter, given, pairs};
use crate::report::overview::Overview;

/// Coatings that are listed one by one.
const MOST_COATINGS: usize = 4;

/// The case as it was understood.
pub fn question(view: &Overview<'_>) -> Markup {
    let plan = &view.results.record["plan"];
    let case = &plan["case"];
    let mut rows = vec![
        ("upper body".to_owned(), body(view, &case["bodies"]["upper"])),
        ("lower body".to_owned(), body(view, &case["bodies"]["lower"])),
        ("profile".to_owned(), words(&described(view, &case["profile"]))),
        ("friction".to_owned(), friction(view, &case["friction"])),
    ];
    let [nx, ny] = view.results.fields.cells();
    let [dx, dy] = view.results.fields.spacing().map(|side| view.number(side, "length"));
    let repeats = if case["periodic"] == true { ", periodic in x and y" } else { "" };
    rows.push(if view.results.fields.is_line() {
        ("line contact".to_owned(), words(&format!("{nx} cells of {dx}; loads per unit length")))
    } else {
        ("grid".to_owned(), words(&format!("{nx} × {ny} cells of {dx} × {dy}{repeats}")))
    });
    if let Some(datum) = plan["datum"].as_f64() {
        let depth = view.number(datum, "length");
        rows.push((
            "approach and displacement".to_owned(),
            words(&format!("relative to {depth} below the load")),
        ));
    }
    let solved = match plan["coupling"].as_str() {
        Some("frictionless") => "pressure alone: there is no friction",
        Some("uncoupled") => "pressure, then shear: elastically similar bodies",
        Some("coupled") => "pressure and shear together: normal-tangential coupling",
        _ => "",
    };
    rows.push(("solved".to_owned(), words(solved)));
    if !case["wear"].is_null() {
        rows.push(("wear".to_owned(), words(&wear(view, &case["wear"]))));
    }
    for (number, stage) in case["stages"].as_array().map_or(&[][..], Vec::as_slice).iter().enumerate() {
        rows.push((format!("stage {}", number + 1), self::stage(view, stage)));
    }
    let units = match &view.units {
        Some(units) => {
            format!("Units: length {}, force {}, pressure {}.", units.length, units.force, units.pressure)
        }
        None => "The case declares no units: all numbers are in its own, which may be any consistent set."
            .to_owned(),
    };
    chapter("The case", &html! { (pairs(&rows)) p class="small" { (units) } })
}

fn words(text: &str) -> Markup {
    html! { (text) }
}

fn constant(view: &Overview<'_>, value: &Value, kind: &str) -> String {
    value
        .as_f64()
        .map_or("?".to_owned(), |value| if kind.is_empty() { given(value) } else { view.given(value, kind) })
}

fn body(view: &Overview<'_>, body: &Value) -> Markup {
    if body == "rigid" {
        return words("rigid");
    }
    let material = |material: &Value| {
        html! {
            i { "E" } " " (constant(view, &material["young"], "pressure")) ", " i { "ν" } " " (constant(view, &material["poisson"], ""))
        }
    };
    let elastic = &body["elastic"];
    let coatings = elastic["coatings"].as_array().map_or(&[][..], Vec::as_slice);
    html! {
        @if coatings.len() > MOST_COATINGS {
            @let thickness: f64 = coatings.iter().filter_map(|coating| coating["thickness"].as_f64()).sum();
            (coatings.len()) " layers, " (view.given(thickness, "length")) " thick in all; "
        } @else {
            @for coating in coatings {
                "coating " (constant(view, &coating["thickness"], "length")) " thick, " (material(&coating["material"])) "; "
            }
        }
        @if elastic["base"] == "rigid" {
            "on a rigid base"
        } @else {
            @if !coatings.is_empty() { "on a substrate, " }
            (material(&elastic["base"]["elastic"]))
        }
    }
}

/// A profile in words: names and numbers in the order they stand. All its numbers but slopes are lengths.
fn described(view: &Overview<'_>, value: &Value) -> String {
    match value {
        Value::Object(map) if map.contains_key("fnv1a64") => topography(view, value),
        Value::Object(map) => {
            let parts: Vec<String> = map
                .iter()
                .filter(|(_, value)| !value.is_null())
                .map(|(name, value)| match value {
                    Value::Array(parts) if name == "shapes" || name == "heights" => {
                        parts.iter().map(|part| described(view, part)).collect::<Vec<_>>().join(" and ")
                    }
                    Value::Number(slope) if name == "slope" => {
                        format!("slope {}", slope.as_f64().map_or_else(String::new, given))
                    }
                    _ => format!("{} {}", name.replace('_', " "), described(view, value)),
                })
                .filter(|part| !part.is_empty())
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
fn topography(view: &Overview<'_>, heights: &Value) -> String {
    let source = heights["source"].as_str().filter(|source| !source.is_empty());
    let of = source.map_or(String::new(), |source| format!(" of {source}"));
    let height = |name: &str| {
        view.with_unit(&heights[name].as_f64().map_or("?".to_owned(), crate::report::html::number), "length")
    };
    format!(
        "topography{of}: rms {} about the mean, {} from the highest point to the lowest",
        height("rms"),
        height("valley")
    )
}

fn wear(view: &Overview<'_>, wear: &Value) -> String {
    let law = if wear["law"] == "energy" { "by dissipated energy" } else { "by Archard's law" };
    let layers = &wear["layers"];
    let mut parts = vec![if layers.is_null() {
        format!("{law}, coefficient {}", constant(view, &wear["coefficient"], "1/pressure"))
    } else {
        law.to_owned()
    }];
    for body in ["lower", "upper"] {
        let coefficients = layers[body].as_array().filter(|list| !list.is_empty());
        parts.extend(coefficients.map(|list| {
            let told = |layer: &Value| constant(view, &layer["coefficient"], "1/pressure");
            format!("{body} body {}", list.iter().map(told).collect::<Vec<_>>().join(", then "))
        }));
    }
    if let Some(tolerance) = wear["thinning_tolerance"].as_f64() {
        parts.push(format!("worn layers are thinner, followed to {}", given(tolerance)));
    }
    if let Some(tolerance) = wear["tolerance"].as_f64() {
        parts.push(format!("cycle jumps with an error of at most {}", given(tolerance)));
    }
    if let Some(every) = wear["every"].as_u64().filter(|every| *every > 1) {
        parts.push(format!("a computed cycle stands for at most {every}"));
    }
    if !wear["limit"].is_null() {
        parts.push(format!("ends at a wear depth of {}", constant(view, &wear["limit"], "length")));
    }
    parts.join(", ")
}

fn friction(view: &Overview<'_>, friction: &Value) -> Markup {
    let coefficient = &friction["coefficient"];
    let map = &coefficient["map"];
    html! {
        @match coefficient["uniform"].as_f64() {
            Some(0.0) => { "none" }
            Some(coefficient) => { i { "μ" } " " (given(coefficient)) }
            None => {
                "a map of " i { "μ" }
                @if let (Some(least), Some(most)) = (map["smallest"].as_f64(), map["largest"].as_f64()) {
                    " from " (given(least)) " to " (given(most))
                }
            }
        }
        @if let Some(words) = evolution(view) { ", " (words) }
        @if !friction["max_shear"].is_null() {
            @match friction["max_shear"]["uniform"].as_f64() {
                Some(strength) => { ", shear at most " (view.given(strength, "pressure")) }
                None => { ", a map of shear strengths" }
            }
        }
    }
}

/// How friction evolves, where it does.
fn evolution(view: &Overview<'_>) -> Option<String> {
    let evolution = &view.results.record["plan"]["case"]["friction_evolution"];
    let (over, kind) = match evolution["by"].as_str()? {
        "energy" => ("dissipated energy by area", "force/length"),
        "slip_distance" => ("slip distance", "length"),
        _ => ("cycles", ""),
    };
    let exponential = &evolution["law"]["exponential"];
    let driver = |value: f64| if kind.is_empty() { given(value) } else { view.given(value, kind) };
    let law = if let Some((last, scale)) = exponential["last"].as_f64().zip(exponential["scale"].as_f64()) {
        format!("tends to {} over a scale of {}", given(last), driver(scale))
    } else {
        let row = |row: &Value| Some(format!("{} at {}", given(row[1].as_f64()?), driver(row[0].as_f64()?)));
        let rows = evolution["law"]["table"].as_array()?;
        rows.iter().map(row).collect::<Option<Vec<_>>>()?.join(", ")
    };
    let every = evolution["every"].as_u64().filter(|every| *every > 1);
    let jumps = every.map_or(String::new(), |every| format!("; a computed cycle stands for at most {every}"));
    Some(format!("evolves with the {over} of each cell: {law}{jumps}"))
}

fn stage(view: &Overview<'_>, stage: &Value) -> Markup {
    let mut parts: Vec<String> = Vec::new();
    let mut add = |control: &Value, [force, motion]: [&str; 2], [of_force, of_motion]: [&str; 2]| {
        let told = |kind: &str, name: &str, unit: &str| {
            path(view, &control[kind], unit).map(|path| format!("{name} {path}"))
        };
        let actuator = format!("actuator, {motion}");
        let motions = || told("motion", motion, of_motion).or_else(|| told("far_end", &actuator, of_motion));
        parts.extend(told("force", force, of_force).or_else(motions));
    };
    add(&stage["normal"], ["normal force", "approach"], ["force", "length"]);
    for (axis, name) in ["x", "y"].into_iter().enumerate() {
        let names = [format!("tangential force {name}"), format!("displacement {name}")];
        add(&stage["tangential"][axis], [&names[0], &names[1]], ["force", "length"]);
    }
    add(&stage["twist"], ["torsional moment", "rotation"], ["force x length", "rad"]);
    for (axis, name) in ["x", "y"].into_iter().enumerate() {
        let names = [format!("tilt moment {name}"), format!("tilt {name}")];
        add(&stage["tilt"][axis], [&names[0], &names[1]], ["force x length", "rad"]);
        for (body, which) in ["lower", "upper"].into_iter().enumerate() {
            let stress = format!("bulk stress {name} of the {which} body");
            add(&stage["bulk_stress"][body][axis], [&stress, &stress], ["pressure", "pressure"]);
        }
    }
    let increments = counted(stage["increments"].as_u64().unwrap_or(0) as usize, "increment");
    let cycles = &stage["course"]["cycles"];
    let course = match cycles["most"].as_u64() {
        Some(most) => {
            let until = cycles["until_steady"].as_f64().map(given);
            let until = until.map_or(String::new(), |until| format!("until steady to {until}, at most "));
            format!("{until}{} of {increments}", counted(most as usize, "cycle"))
        }
        None => format!("{} in {increments}", stage["course"].as_str().unwrap_or_default()),
    };
    html! {
        b { (stage["name"].as_str().unwrap_or_default()) } ": " (parts.join(", ")) "; " (course)
        @if !stage["friction"].is_null() { "; from here on " (friction(view, &stage["friction"])) }
    }
}

/// What a control runs through; none where there is no control, or one that stays at zero.
fn path(view: &Overview<'_>, path: &Value, unit: &str) -> Option<String> {
    let values =
        path["through"].as_array().map(|values| format!("through {} values of a table", values.len()));
    let amplitude = path["wave"]["amplitude"].as_f64();
    if amplitude == Some(0.0) {
        return None;
    }
    let wave = amplitude.map(|amplitude| {
        let phase = path["wave"]["phase"].as_f64().filter(|phase| *phase != 0.0);
        let ahead = phase.map_or(String::new(), |phase| format!(" with phase {}°", given(360.0 * phase)));
        format!("± {}{ahead}", view.given(amplitude, unit))
    });
    path["to"].as_f64().map(|to| view.given(to, unit)).or(wave).or(values)
}

/// The simplifications that were used, and why.
pub fn simplifications(view: &Overview<'_>) -> Markup {
    let items = view.results.record["plan"]["left_out"].as_array().map_or(&[][..], Vec::as_slice);
    let text = |item: &Value, name: &str| item[name].as_str().unwrap_or_default().to_owned();
    let body = html! {
        @if items.is_empty() {
            p { "None: every part of the model was needed." }
        } @else {
            p { "Same result to the solver tolerance." }
            ul class="out" {
                @for item in items { li { (text(item, "what")) ", because " (text(item, "why")) ". Saves " (text(item, "saves")) "." } }
            }
        }
    };
    chapter("Automatic simplifications", &body)
}
