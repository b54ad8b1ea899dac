//! What serde and the parser say of other documents than cases, in the words of cases.

/// What the parser says about the structure of a case, as its author would say it; other messages stay as they are.
pub fn in_words(message: &str) -> String {
    let message = message.trim_end();
    let starts = |prefix: &str| message.strip_prefix(prefix);
    if let Some(rest) = starts("invalid type: ").or_else(|| starts("invalid value: ")) {
        return rest.rsplit_once(", expected ").map_or_else(
            || message.to_owned(),
            |(given, wanted)| format!("found {}, expected {}", found(given), expected(wanted)),
        );
    }
    if let Some((count, wanted)) = starts("invalid length ").and_then(|rest| rest.split_once(", expected ")) {
        let values = if count == "1" { "value" } else { "values" };
        return format!("found {count} {values}, expected {}", expected(wanted));
    }
    if let Some(count) = starts("wanted exactly 1 element, found ") {
        return format!("expected exactly one entry, found {}", count.trim_end_matches(" elements"));
    }
    if let Some(rest) = starts("unknown field ") {
        return format!("unknown key {}", rest.replace("there are no fields", "no key belongs here"));
    }
    if let Some(rest) = starts("unknown variant ") {
        return format!("unknown name {rest}");
    }
    if let Some(rest) = starts("missing field ") {
        return format!("missing key {rest}");
    }
    if let Some(rest) = starts("duplicate field ") {
        return format!("key given twice: {rest}");
    }
    if message.starts_with("data did not match any variant") {
        return "fits none of the forms that are allowed here".to_owned();
    }
    message.to_owned()
}

/// What was found.
fn found(given: &str) -> String {
    let bare = |prefix: &str| given.strip_prefix(prefix).map(|value| value.trim_matches('`').to_owned());
    match given {
        "map" => "a table".to_owned(),
        "sequence" => "a list".to_owned(),
        "unit value" | "null" => "nothing".to_owned(),
        _ => given
            .strip_prefix("string ")
            .map(|text| format!("the text {text}"))
            .or_else(|| bare("integer "))
            .or_else(|| bare("floating point "))
            .or_else(|| bare("boolean "))
            .unwrap_or_else(|| given.to_owned()),
    }
}

/// What belongs there.
fn expected(wanted: &str) -> String {
    let plain = match wanted {
        "f64" => "a number",
        "usize" | "u32" | "u64" => "a whole number, 0 or more",
        "i64" => "a whole number",
        "a boolean" => "true or false",
        "a string" | "string" => "a text in quotes",
        "a map" => "a table",
        "a sequence" => "a list",
        "an array of length 2" => "a list of two values",
        "an array of length 3" => "a list of three values",
        _ if wanted.starts_with("struct ") => "a table",
        _ if wanted.starts_with("enum ") => "a name or a table",
        _ => wanted,
    };
    plain.to_owned()
}
