//! The run at a glance, the question as it was understood, and what was left out.

use serde_json::Value;

use super::chapter;
use crate::figures::{counted, duration};
use crate::report::html::{escaped, given, number, pairs, percent, short};
use crate::report::scene::Scene;

/// Title, how the run ended, and its most telling numbers.
pub fn head(scene: &Scene<'_>) -> String {
    let record = &scene.results.record;
    let table = &scene.results.table;
    let text = |value: &Value| value.as_str().unwrap_or_default().to_owned();
    let status = text(&record["status"]);
    let all = record["plan"]["increments"].as_u64().unwrap_or(0) as usize;
    let mut line = vec![
        format!("fretting {}", text(&record["version"])),
        status.clone(),
        if table.rows() == all || status == "solved" {
            counted(table.rows(), "increment")
        } else {
            format!("{} of {all} increments", table.rows())
        },
    ];
    if let Some(cycles) = record["worn_through"]["cycles"].as_u64() {
        line.push(format!("worn to the limit after {}", counted(cycles as usize, "cycle")));
    }
    if let Some(wall_s) = record["totals"]["wall_s"].as_f64() {
        let threads = record["threads"].as_u64().unwrap_or(1) as usize;
        line.push(format!("{} on {}", duration(wall_s), counted(threads, "thread")));
    }
    line.extend(record["started_unix_s"].as_u64().map(|seconds| format!("started {}", date(seconds))));
    let mut head = format!(
        "<header><h1>{}</h1>\n<p class=\"lead\">{}</p>\n",
        escaped(&scene.results.title()),
        escaped(&line.join(" · "))
    );
    if let Some(why) = scene.results.unfinished() {
        head += &format!("<p class=\"warning\">{}.</p>\n", escaped(&capitalised(&why)));
    }
    head + &cards(scene) + &warnings(record) + "</header>\n"
}

/// What about the numbers may mislead.
fn warnings(record: &Value) -> String {
    let text = |warning: &Value, name: &str| escaped(warning[name].as_str().unwrap_or_default());
    let list = record["warnings"].as_array().map_or(&[][..], Vec::as_slice);
    let line = |warning: &Value| {
        format!("<p class=\"warning\">{}. {}.</p>\n", text(warning, "message"), text(warning, "help"))
    };
    list.iter().map(line).collect()
}

/// A sentence that begins with a capital letter.
fn capitalised(words: &str) -> String {
    let mut letters = words.chars();
    letters.next().map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
}

fn cards(scene: &Scene<'_>) -> String {
    let table = &scene.results.table;
    let Some(last) = table.rows().checked_sub(1) else { return String::new() };
    let largest = |name: &str| table.column(name).iter().copied().fold(0.0, f64::max);
    let mut cards = vec![
        ("max pressure", number(largest("max_pressure"))),
        ("max contact area", number(largest("contact_area"))),
    ];
    if scene.direction.is_some() || scene.twists {
        cards.push(("max shear", number(largest("max_shear"))));
        cards.push((
            "stick at the end",
            percent(table.at("stick_cells", last) / table.at("contact_cells", last)),
        ));
        cards.push(("energy dissipated", number(table.at("dissipated_energy", last))));
    }
    if !scene.results.record["plan"]["case"]["wear"].is_null() {
        cards.push(("wear volume", number(table.at("worn_volume", last))));
        cards.push(("max wear depth", number(table.at("max_worn_depth", last))));
        if let Some(cycle) = scene.results.cycles.last() {
            cards.push(("cycles", cycle.last_cycle.to_string()));
        }
    }
    cards.push(("max residual", short(largest("residual"))));
    let cards: String =
        cards.iter().map(|(name, value)| format!("<div><dt>{name}</dt><dd>{value}</dd></div>")).collect();
    format!("<dl class=\"cards\">{cards}</dl>\n")
}

/// The case as it was understood.
pub fn question(scene: &Scene<'_>) -> String {
    let plan = &scene.results.record["plan"];
    let case = &plan["case"];
    let mut rows = vec![
        ("upper body".to_owned(), body(&case["bodies"]["upper"])),
        ("lower body".to_owned(), body(&case["bodies"]["lower"])),
        ("profile".to_owned(), described(&case["profile"])),
        ("friction".to_owned(), friction(&case["friction"])),
    ];
    let [nx, ny] = scene.results.fields.cells();
    let [dx, dy] = scene.results.fields.spacing();
    let repeats = if case["periodic"] == true { ", repeating in x and y" } else { "" };
    rows.push(if scene.results.fields.is_line() {
        ("line contact".to_owned(), format!("{nx} cells of {}; loads per unit length", number(dx)))
    } else {
        ("grid".to_owned(), format!("{nx} × {ny} cells of {} × {}{repeats}", number(dx), number(dy)))
    });
    if let Some(datum) = plan["datum"].as_f64() {
        rows.push(("approach and shift".to_owned(), format!("relative to {} below the load", number(datum))));
    }
    let solved = match plan["coupling"].as_str() {
        Some("frictionless") => "pressure alone: there is no friction",
        Some("uncoupled") => "pressure, then shear: they do not act on each other",
        Some("coupled") => "pressure and shear together: each acts on the other",
        _ => "",
    };
    rows.push(("solved".to_owned(), solved.to_owned()));
    if !case["wear"].is_null() {
        rows.push(("wear".to_owned(), described(&case["wear"])));
    }
    for (number, stage) in case["stages"].as_array().map_or(&[][..], Vec::as_slice).iter().enumerate() {
        rows.push((format!("stage {}", number + 1), self::stage(stage)));
    }
    let units = "<p class=\"small\">All numbers are in the units of the case, which may be any that belong together.</p>\n";
    chapter("The case", &format!("<div class=\"scroll\">{}</div>{units}", pairs(&rows)))
}

fn body(body: &Value) -> String {
    if body == "rigid" {
        return "rigid".to_owned();
    }
    let material = |material: &Value| {
        let constant = |name: &str| material[name].as_f64().map_or("?".to_owned(), given);
        format!("<i>E</i> {}, <i>ν</i> {}", constant("young"), constant("poisson"))
    };
    let elastic = &body["elastic"];
    let coatings = elastic["coatings"].as_array().map_or(&[][..], Vec::as_slice);
    let mut parts: Vec<String> = Vec::new();
    if coatings.len() > 4 {
        let thickness: f64 = coatings.iter().filter_map(|coating| coating["thickness"].as_f64()).sum();
        parts.push(format!("{} layers, {} thick in all", coatings.len(), given(thickness)));
    } else {
        parts.extend(coatings.iter().map(|coating| {
            let thickness = coating["thickness"].as_f64().map_or("?".to_owned(), given);
            format!("coating {thickness} thick, {}", material(&coating["material"]))
        }));
    }
    let base = if elastic["base"] == "rigid" {
        "on a rigid base".to_owned()
    } else {
        let words = if coatings.is_empty() { "" } else { "on a substrate, " };
        format!("{words}{}", material(&elastic["base"]["elastic"]))
    };
    parts.push(base);
    parts.join("; ")
}

/// A value of the plan in words: names and numbers in the order they stand.
fn described(value: &Value) -> String {
    match value {
        Value::Object(map) => {
            let parts: Vec<String> = map
                .iter()
                .filter(|(_, value)| !value.is_null())
                .map(|(name, value)| match value {
                    Value::Array(shapes) if name == "shapes" => {
                        shapes.iter().map(described).collect::<Vec<_>>().join(" and ")
                    }
                    _ => format!("{} {}", escaped(&name.replace('_', " ")), described(value)),
                })
                .collect();
            parts.join(", ")
        }
        Value::Array(items) if items.len() > 4 => format!("of {} values", items.len()),
        Value::Array(items) => items.iter().map(described).collect::<Vec<_>>().join(" × "),
        Value::Number(number) => number.as_f64().map_or_else(|| number.to_string(), given),
        Value::String(word) => escaped(word),
        other => other.to_string(),
    }
}

fn friction(friction: &Value) -> String {
    let coefficient = match friction["coefficient"]["uniform"].as_f64() {
        Some(0.0) => return "none".to_owned(),
        Some(coefficient) => format!("<i>μ</i> {}", given(coefficient)),
        None => "a map of coefficients".to_owned(),
    };
    match (&friction["max_shear"], friction["max_shear"]["uniform"].as_f64()) {
        (Value::Null, _) => coefficient,
        (_, Some(strength)) => format!("{coefficient}, shear at most {}", given(strength)),
        (_, None) => format!("{coefficient}, a map of shear strengths"),
    }
}

fn stage(stage: &Value) -> String {
    let to = |control: &Value, force: &str, motion: &str| {
        let told = |kind: &str, name: &str| path(&control[kind]).map(|path| format!("{name} {path}"));
        let actuator = format!("actuator, {motion}");
        told("force", force).or_else(|| told("motion", motion)).or_else(|| told("far_end", &actuator))
    };
    let mut parts: Vec<String> = Vec::new();
    parts.extend(to(&stage["normal"], "normal force", "approach"));
    for (axis, name) in ["x", "y"].into_iter().enumerate() {
        let control = &stage["tangential"][axis];
        let force = format!("tangential force {name}");
        parts.extend(to(control, &force, &format!("shift {name}")));
    }
    parts.extend(to(&stage["twist"], "torsional moment", "rotation"));
    for (axis, name) in ["x", "y"].into_iter().enumerate() {
        parts.extend(to(&stage["tilt"][axis], &format!("tilt moment {name}"), &format!("tilt {name}")));
        for (body, which) in ["lower", "upper"].into_iter().enumerate() {
            let stress = format!("bulk stress {name} of the {which} body");
            parts.extend(to(&stage["bulk_stress"][body][axis], &stress, &stress));
        }
    }
    let increments = stage["increments"].as_u64().unwrap_or(0) as usize;
    let cycles = &stage["course"]["cycles"];
    let course = match cycles["most"].as_u64() {
        Some(most) => {
            let until = cycles["until_steady"].as_f64().map(given);
            let until = until.map_or(String::new(), |until| format!("until they close to {until}, at most "));
            format!("{until}{} of {}", counted(most as usize, "cycle"), counted(increments, "increment"))
        }
        None => format!(
            "{} in {}",
            stage["course"].as_str().unwrap_or_default(),
            counted(increments, "increment")
        ),
    };
    format!("<b>{}</b>: {}; {course}", escaped(stage["name"].as_str().unwrap_or_default()), parts.join(", "))
}

/// What a control runs through; none where there is no control.
fn path(path: &Value) -> Option<String> {
    let values =
        path["through"].as_array().map(|values| format!("through {} values of a table", values.len()));
    let wave = path["wave"]["amplitude"].as_f64().map(|amplitude| {
        let phase = path["wave"]["phase"].as_f64().filter(|phase| *phase != 0.0);
        let ahead = phase.map_or(String::new(), |phase| format!(" ahead by {} of a cycle", given(phase)));
        format!("± {}{ahead}", given(amplitude))
    });
    path["to"].as_f64().map(given).or(wave).or(values)
}

/// What was not computed, and why the answer is the same without it.
pub fn left_out(scene: &Scene<'_>) -> String {
    let items = scene.results.record["plan"]["left_out"].as_array().map_or(&[][..], Vec::as_slice);
    let text = |item: &Value, name: &str| escaped(item[name].as_str().unwrap_or_default());
    let listed: Vec<String> = items
        .iter()
        .map(|item| {
            format!(
                "<li>{}, because {}. Saves {}.</li>",
                text(item, "what"),
                text(item, "why"),
                text(item, "saves")
            )
        })
        .collect();
    let body = if listed.is_empty() {
        "<p>Nothing: every part of the model was needed.</p>\n".to_owned()
    } else {
        format!("<p>Same result to the solver tolerance.</p><ul class=\"out\">{}</ul>\n", listed.concat())
    };
    chapter("Automatic simplifications", &body)
}

/// The day of a moment, in seconds since 1970 began, in Greenwich.
///
/// Source: Hinnant, "chrono-compatible low-level date algorithms": days to a civil date of the Gregorian calendar.
fn date(seconds: u64) -> String {
    let days = seconds / 86_400 + 719_468;
    let era = days / 146_097;
    let day_of_era = days % 146_097;
    let year_of_era = (day_of_era - day_of_era / 1460 + day_of_era / 36_524 - day_of_era / 146_096) / 365;
    let day_of_year = day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    let shifted_month = (5 * day_of_year + 2) / 153;
    let day = day_of_year - (153 * shifted_month + 2) / 5 + 1;
    let month = if shifted_month < 10 { shifted_month + 3 } else { shifted_month - 9 };
    let year = year_of_era + 400 * era + u64::from(month <= 2);
    let (hour, minute) = (seconds / 3600 % 24, seconds / 60 % 60);
    format!("{year}-{month:02}-{day:02} {hour:02}:{minute:02} UTC")
}

#[cfg(test)]
mod tests {
    use super::date;

    #[test]
    fn dates_are_those_of_the_calendar() {
        // From `date -u -d @SECONDS`.
        for (seconds, day) in [
            (0, "1970-01-01 00:00 UTC"),
            (951_782_399, "2000-02-28 23:59 UTC"),
            (951_868_800, "2000-03-01 00:00 UTC"),
            (1_795_269_876, "2026-11-21 14:04 UTC"),
            (4_107_542_400, "2100-03-01 00:00 UTC"),
        ] {
            assert_eq!(date(seconds), day);
        }
    }
}
