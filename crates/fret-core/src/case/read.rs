//! From text to a case: structure by serde, one mistake after the other until all are known, then the checks of `check`.

use std::ops::Range;

use serde::Deserialize;
use toml::Spanned;
use toml::de::{DeTable, DeValue, Deserializer};

use super::attachments::Attachments;
use super::check;
use super::definition::Case;
use super::file::CaseFile;
use super::refusal::{CaseError, Mistake};
use super::wording::in_words;

/// More mistakes than this are not looked for.
const MOST_MISTAKES: usize = 30;

/// Deeper tables than a case can have are refused before anything walks them.
const DEEPEST: usize = 16;

/// Longer texts are not cases.
const LONGEST: usize = 4 << 20;

pub(super) fn case(text: &str, name: &str, attachments: Attachments<'_>) -> Result<Case, CaseError> {
    if text.len() > LONGEST {
        return Err(CaseError::plain(
            name,
            format!("{} bytes: a case file has at most {LONGEST}", text.len()),
        ));
    }
    if text.bytes().filter(|byte| matches!(byte, b'[' | b'{')).count() > 100_000 {
        return Err(CaseError::plain(name, "more than 100000 brackets: not a case file"));
    }
    let mut mistakes = Vec::new();
    let mut root = match DeTable::parse(text) {
        Ok(root) => root,
        Err(error) => {
            mistakes.push(Mistake {
                message: format!("not readable as TOML: {}", error.message()),
                help: None,
                span: error.span(),
            });
            return Err(CaseError::new(name, text, mistakes));
        }
    };
    if depth(root.get_ref()) > DEEPEST {
        return Err(CaseError::plain(name, format!("tables nested deeper than {DEEPEST}: not a case")));
    }
    let mut removed: Vec<Taken> = Vec::new();
    let written: Vec<String> = root.get_ref().keys().map(|key| key.get_ref().to_string()).collect();
    let mut lacks_tables = false;
    let file = loop {
        match CaseFile::deserialize(Deserializer::from(root.clone())) {
            Ok(file) => break file,
            Err(error) => {
                if let Some(table) = supplied(root.get_mut(), error.message()) {
                    // A table that was taken out above for what it lacked is not missing from the text.
                    if !written.iter().any(|key| key == table) {
                        mistakes.push(mistake(&error, error.span()));
                    }
                    lacks_tables = true;
                    continue;
                }
                let Some(span) = error.span() else {
                    mistakes.push(mistake(&error, None));
                    return Err(CaseError::new(name, text, mistakes));
                };
                let lost_entry = ["missing field", "wanted exactly 1 element"];
                let echo = lost_entry.iter().any(|words| error.message().starts_with(words))
                    && lacks_what_was_taken(&removed, &span);
                if !echo {
                    mistakes.push(mistake(&error, Some(span.clone())));
                }
                let message = error.message();
                let instead = match (near_miss(message), stand_in(message)) {
                    (Some(meant), _) => Instead::Renamed(meant),
                    (None, Some(value)) => Instead::Value(value),
                    (None, None) => Instead::Nothing,
                };
                let whole = root.span();
                match take_at(root.get_mut(), &whole, &span, &instead) {
                    Some(gone) if mistakes.len() < MOST_MISTAKES => removed.push(gone),
                    _ => return Err(CaseError::new(name, text, mistakes)),
                }
            }
        }
    };
    if lacks_tables {
        // What stands for a whole table would be judged together with the rest.
        return Err(CaseError::new(name, text, mistakes));
    }
    match check::case(file, name, text, attachments, removed.is_empty()) {
        Ok(case) if mistakes.is_empty() => Ok(case),
        Ok(_) => Err(CaseError::new(name, text, mistakes)),
        Err(found) => {
            // What stands in for a refused value is not judged.
            let stood_in = |mistake: &Mistake| {
                mistake.span.as_ref().is_some_and(|span| {
                    let holds = |entry: &Range<usize>| entry.start <= span.start && span.end <= entry.end;
                    removed.iter().any(|taken| holds(&taken.entry)) || lacks_what_was_taken(&removed, span)
                })
            };
            let own = |mistake: &Mistake| !stood_in(mistake);
            mistakes.extend(found.into_iter().filter(own));
            Err(CaseError::new(name, text, mistakes))
        }
    }
}

fn mistake(error: &toml::de::Error, span: Option<Range<usize>>) -> Mistake {
    let message = in_words(error.message());
    let help = near_miss(error.message()).map_or_else(
        || Some("`fret schema` lists every key with its meaning".to_owned()),
        |near| Some(format!("did you mean `{near}`?")),
    );
    Mistake { message, help, span }
}

/// Tables a case cannot do without, each with one that serves.
const TABLES: [(&str, &str); 4] = [
    ("grid", "x = { cells = [4, 4], size = 'auto' }"),
    ("upper", "x = { rigid = true }"),
    ("lower", "x = { rigid = true }"),
    ("load", "x = [{ normal_force = 1.0, increments = 1 }]"),
];

/// Puts in the table that serde's message misses, so that the next one that is missing can be found; its name.
fn supplied(root: &mut DeTable<'_>, message: &str) -> Option<&'static str> {
    let missed = |name: &str| message.starts_with(&format!("missing field `{name}`"));
    let (name, text) = TABLES.into_iter().find(|(name, _)| missed(name) && !root.contains_key(*name))?;
    let value = DeTable::parse(text).ok()?.get_mut().remove("x")?;
    root.insert(Spanned::new(NOWHERE, name.into()), placeless(value.into_inner()));
    Some(name)
}

/// A place where no text has anything.
const NOWHERE: Range<usize> = usize::MAX..usize::MAX;

/// A value that stands nowhere, so that no mistake in the text is looked for inside it.
fn placeless(value: DeValue<'static>) -> Spanned<DeValue<'static>> {
    let value = match value {
        DeValue::Array(items) => {
            DeValue::Array(items.into_iter().map(|item| placeless(item.into_inner())).collect())
        }
        DeValue::Table(table) => DeValue::Table(
            table
                .into_iter()
                .map(|(key, value)| (Spanned::new(NOWHERE, key.into_inner()), placeless(value.into_inner())))
                .collect(),
        ),
        plain => plain,
    };
    Spanned::new(NOWHERE, value)
}

/// The expected word nearest to the one found, when serde's message names both and they are close.
fn near_miss(message: &str) -> Option<String> {
    if !message.starts_with("unknown ") {
        return None;
    }
    let mut words = message.split('`').skip(1).step_by(2);
    let found = words.next()?;
    let words: Vec<&str> = words.collect();
    let nearest = words.iter().map(|word| (strsim::damerau_levenshtein(found, word), *word)).min();
    let close = nearest.filter(|(distance, word)| *distance <= (word.len() / 3).max(1)).map(|(_, word)| word);
    // A word cut short is meant, too, where it can be no other.
    let mut longer = words.iter().filter(|word| found.len() >= SHORTEST && word.starts_with(found));
    let cut_short = longer.next().filter(|_| longer.next().is_none()).copied();
    close.or(cut_short).map(str::to_owned)
}

/// Letters by which a word that is cut short is known, at the least.
const SHORTEST: usize = 3;

fn depth(table: &DeTable<'_>) -> usize {
    fn of_value(value: &DeValue<'_>) -> usize {
        match value {
            DeValue::Array(items) => 1 + items.iter().map(|item| of_value(item.get_ref())).max().unwrap_or(0),
            DeValue::Table(table) => depth(table),
            _ => 0,
        }
    }
    1 + table.iter().map(|(_, value)| of_value(value.get_ref())).max().unwrap_or(0)
}

/// What a refused entry is replaced by, so that the rest of the case can be judged.
enum Instead {
    Nothing,
    /// The word that was meant: of a key or of a value, whichever is misspelt.
    Renamed(String),
    Value(DeValue<'static>),
}

/// A harmless value of the type, or one of the words, that serde's message expected.
fn stand_in(message: &str) -> Option<DeValue<'static>> {
    if message.starts_with("unknown variant") {
        return message.split('`').nth(3).map(|word| DeValue::String(word.to_owned().into()));
    }
    if !message.starts_with("invalid ") {
        return None;
    }
    let text = if message.ends_with("expected an array of length 2")
        || message.ends_with("one number for a line contact")
    {
        // enough for a number of cells, and what a side, a force or a motion may be
        "x = [64, 64]"
    } else if message.ends_with("or \"auto\"") && message.contains("two side lengths") {
        "x = 'auto'"
    } else if message.ends_with("expected f64") {
        "x = 0.3"
    } else if message.ends_with("expected usize") {
        "x = 4"
    } else if message.ends_with("expected a boolean") {
        "x = false"
    } else if message.ends_with("rows of numbers") {
        "x = []"
    } else if message.ends_with("expected a string") {
        "x = ''"
    } else {
        return None;
    };
    let mut table = DeTable::parse(text).ok()?;
    table.get_mut().remove("x").map(Spanned::into_inner)
}

/// Where a refused entry stood, and the table that it was taken from.
struct Taken {
    entry: Range<usize>,
    table: Range<usize>,
}

/// Whether an entry was taken from the table that stands at `span`: what it lacks now is no mistake of its own.
fn lacks_what_was_taken(removed: &[Taken], span: &Range<usize>) -> bool {
    removed.iter().any(|taken| taken.table == *span)
}

/// Takes out the innermost entry of a table, which stands at `whole`, whose key or value stands at `span`, and puts what stands
/// in for it.
fn take_at(
    table: &mut DeTable<'_>,
    whole: &Range<usize>,
    span: &Range<usize>,
    instead: &Instead,
) -> Option<Taken> {
    let mut at: Option<(String, Range<usize>, Range<usize>)> = None;
    let mut is_key = false;
    for (key, value) in table.iter_mut() {
        let (key_span, value_span) = (key.span(), value.span());
        let entry = key_span.start..value_span.end.max(key_span.end);
        if key_span == *span {
            at = Some((key.get_ref().to_string(), entry, value_span));
            is_key = true;
            break;
        }
        if let Some(gone) = take_inside(value, span, instead) {
            return Some(gone);
        }
        if value_span.start <= span.start && span.end <= value_span.end {
            at = Some((key.get_ref().to_string(), entry, value_span));
            break;
        }
    }
    let (key, gone, value_span) = at?;
    let taken = table.remove(key.as_str())?;
    let is_free = matches!(instead, Instead::Renamed(meant) if !table.contains_key(meant.as_str()));
    let mut put = |key: String, value| table.insert(Spanned::new(gone.clone(), key.into()), value);
    let mut table = whole.clone();
    match instead {
        // with what was meant the table lacks nothing
        Instead::Renamed(meant) if is_key && is_free => {
            put(meant.clone(), taken);
            table = NOWHERE;
        }
        Instead::Renamed(meant) if !is_key => {
            put(key, Spanned::new(value_span, DeValue::String(meant.clone().into())));
            table = NOWHERE;
        }
        Instead::Value(value) if !is_key => {
            put(key, Spanned::new(value_span, value.clone()));
        }
        Instead::Renamed(_) | Instead::Value(_) | Instead::Nothing => {}
    }
    Some(Taken { entry: gone, table })
}

fn take_inside(value: &mut Spanned<DeValue<'_>>, span: &Range<usize>, instead: &Instead) -> Option<Taken> {
    let whole = value.span();
    match value.get_mut() {
        DeValue::Table(inner) => take_at(inner, &whole, span, instead),
        DeValue::Array(items) => {
            // Of a list with a wrong entry every entry is put right: one list, one mistake.
            if let (true, Instead::Value(value)) = (items.iter().any(|item| item.span() == *span), instead) {
                for item in items.iter_mut() {
                    *item = Spanned::new(item.span(), value.clone());
                }
                return Some(Taken { entry: whole.clone(), table: whole });
            }
            items.iter_mut().find_map(|item| take_inside(item, span, instead))
        }
        _ => None,
    }
}

impl Case {
    /// Reads and checks a case from TOML text that names no other files. `name` stands in messages (a file name).
    ///
    /// # Errors
    /// With every mistake found, each with its place and a way out.
    pub fn from_toml(text: &str, name: &str) -> Result<Self, CaseError> {
        Self::from_toml_with(text, name, Attachments::none())
    }

    /// As [`Case::from_toml`]; `attachments` hands in the files and arrays the case names.
    ///
    /// # Errors
    /// As [`Case::from_toml`]; also when a file or an array cannot be had or does not hold what the case says.
    pub fn from_toml_with(text: &str, name: &str, attachments: Attachments<'_>) -> Result<Self, CaseError> {
        case(text, name, attachments)
    }

    /// Reads and checks a case given as JSON text of the same structure; messages show it as TOML.
    ///
    /// # Errors
    /// As [`Case::from_toml`]; also when the text is not a JSON object.
    pub fn from_json(text: &str, name: &str) -> Result<Self, CaseError> {
        Self::from_json_with(text, name, Attachments::none())
    }

    /// As [`Case::from_json`]; `attachments` hands in the files and arrays the case names. The n-th array stands in the case as
    /// `{ "array": n }`.
    ///
    /// # Errors
    /// As [`Case::from_json`]; also when a file or an array cannot be had or does not hold what the case says.
    pub fn from_json_with(text: &str, name: &str, attachments: Attachments<'_>) -> Result<Self, CaseError> {
        let refuse = |message: String| CaseError::plain(name, message);
        let value: serde_json::Value =
            serde_json::from_str(text).map_err(|error| refuse(format!("not readable as JSON: {error}")))?;
        let text = toml_of(&value).map_err(refuse)?;
        Self::from_toml_with(&text, name, attachments)
    }
}

/// A case given as JSON, as TOML text of the same structure.
///
/// # Errors
/// With a reason, when the value is no table.
pub fn toml_of(value: &serde_json::Value) -> Result<String, String> {
    let table =
        toml::Table::try_from(without_null(value.clone())).map_err(|error| format!("not a case: {error}"))?;
    toml::to_string(&table).map_err(|error| format!("not a case: {error}"))
}

/// JSON's null means "not given"; TOML has no word for it.
fn without_null(value: serde_json::Value) -> serde_json::Value {
    use serde_json::Value;
    match value {
        Value::Object(map) => Value::Object(
            map.into_iter().filter(|(_, v)| !v.is_null()).map(|(k, v)| (k, without_null(v))).collect(),
        ),
        Value::Array(items) => Value::Array(items.into_iter().map(without_null).collect()),
        other => other,
    }
}

#[cfg(test)]
mod tests;
