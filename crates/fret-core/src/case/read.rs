//! From text to a case: structure by serde, one mistake after the other until all are known, then the checks of `check`.

use std::ops::Range;

use serde::Deserialize;
use toml::Spanned;
use toml::de::{DeTable, DeValue, Deserializer};

use super::refusal::{CaseError, Mistake};
use super::{Case, check, file::CaseFile};

/// More mistakes than this are not looked for.
const MOST_MISTAKES: usize = 30;

/// Deeper tables than a case can have are refused before anything walks them.
const DEEPEST: usize = 16;

/// Longer texts are not cases.
const LONGEST: usize = 4 << 20;

pub(super) fn case(text: &str, name: &str) -> Result<Case, CaseError> {
    if text.len() > LONGEST {
        return Err(CaseError::plain(name, format!("{} bytes: a case file has at most {LONGEST}", text.len())));
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
    let mut removed: Vec<Range<usize>> = Vec::new();
    let file = loop {
        match CaseFile::deserialize(Deserializer::from(root.clone())) {
            Ok(file) => break file,
            Err(error) => {
                let Some(span) = error.span() else {
                    mistakes.push(mistake(&error, None));
                    return Err(CaseError::new(name, text, mistakes));
                };
                // A table that lost an entry above may now miss it: that is no mistake of its own.
                let echo = error.message().starts_with("missing field")
                    && removed.iter().any(|gone| span.start <= gone.start && gone.end <= span.end.max(gone.end));
                if !echo {
                    mistakes.push(mistake(&error, Some(span.clone())));
                }
                let taken = remove_at(root.get_mut(), &span);
                match taken {
                    Some(gone) if mistakes.len() < MOST_MISTAKES => removed.push(gone),
                    _ => return Err(CaseError::new(name, text, mistakes)),
                }
            }
        }
    };
    match check::case(file) {
        Ok(case) if mistakes.is_empty() => Ok(case),
        Ok(_) => Err(CaseError::new(name, text, mistakes)),
        Err(found) => {
            mistakes.extend(found);
            Err(CaseError::new(name, text, mistakes))
        }
    }
}

fn mistake(error: &toml::de::Error, span: Option<Range<usize>>) -> Mistake {
    let message = error.message().to_owned();
    let help = near_miss(&message).map_or_else(
        || Some("`fret schema` lists every key with its meaning".to_owned()),
        |near| Some(format!("did you mean `{near}`?")),
    );
    Mistake { message, help, span }
}

/// The expected word nearest to the one found, when serde's message names both and they are close.
fn near_miss(message: &str) -> Option<String> {
    if !message.starts_with("unknown ") {
        return None;
    }
    let mut words = message.split('`').skip(1).step_by(2);
    let found = words.next()?;
    words
        .map(|word| (edit_distance(found, word), word))
        .min()
        .filter(|(distance, word)| *distance <= (word.len() / 3).max(1))
        .map(|(_, word)| word.to_owned())
}

/// Levenshtein's distance.
fn edit_distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, letter) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, other) in b.iter().enumerate() {
            let change = diagonal + usize::from(letter != *other);
            diagonal = row[j + 1];
            row[j + 1] = change.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[b.len()]
}

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

/// Removes the innermost entry whose key or value stands at `span`; the bytes it stood at.
fn remove_at(table: &mut DeTable<'_>, span: &Range<usize>) -> Option<Range<usize>> {
    let mut at: Option<(String, Range<usize>)> = None;
    for (key, value) in table.iter_mut() {
        let (key_span, value_span) = (key.span(), value.span());
        if key_span == *span {
            at = Some((key.get_ref().to_string(), key_span.start..value_span.end.max(key_span.end)));
            break;
        }
        if let Some(gone) = remove_inside(value, span) {
            return Some(gone);
        }
        if value_span.start <= span.start && span.end <= value_span.end {
            at = Some((key.get_ref().to_string(), key_span.start..value_span.end));
            break;
        }
    }
    let (key, gone) = at?;
    table.remove(key.as_str());
    Some(gone)
}

fn remove_inside(value: &mut Spanned<DeValue<'_>>, span: &Range<usize>) -> Option<Range<usize>> {
    match value.get_mut() {
        DeValue::Table(inner) => remove_at(inner, span),
        DeValue::Array(items) => items.iter_mut().find_map(|item| match item.get_mut() {
            DeValue::Table(inner) => remove_at(inner, span),
            _ => None,
        }),
        _ => None,
    }
}
