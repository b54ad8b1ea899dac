//! `fret explain`: what a warning means, and what to do.

use fret_core::history::concern::{ROWS, Row};
use serde::Serialize;
use serde_json::json;

use crate::failure::Failure;
use crate::figures::figure;
use crate::terminal::Answer;

/// Where all of them stand in the manual.
const PAGE: &str = "docs/reference/messages.md#warnings";

/// So many names are told at most where none fits.
const MOST_NEAR: usize = 4;

/// Tells what is known of a warning, or lists all.
pub fn explain(name: Option<&str>) -> Result<Answer, Failure> {
    let Some(name) = name else { return Ok(list()) };
    // the stage that a message may name first
    let words = name
        .strip_prefix("stage \"")
        .and_then(|rest| rest.split_once("\": "))
        .map_or(name, |(_, words)| words);
    let asked = plain(words);
    // by its name, or by the words that its message begins with, if those are of one alone
    let begins = |row: &Row| {
        let begins = plain(row.begins());
        !asked.is_empty() && (begins.starts_with(&asked) || asked.starts_with(&begins))
    };
    let begun: Vec<Row> = ROWS.into_iter().filter(begins).collect();
    let named =
        ROWS.into_iter().find(|row| [row.name, row.quantity, row.begins()].map(plain).contains(&asked));
    let Some(row) = named.or(if let [one] = begun[..] { Some(one) } else { None }) else {
        let is_near = |row: &Row| begun.contains(row) || plain(row.name).contains(&asked);
        let near: Vec<&str> = ROWS.into_iter().filter(is_near).map(|row| row.name).collect();
        let help = if near.is_empty() || near.len() > MOST_NEAR {
            "`fret explain` lists them all".to_owned()
        } else {
            format!("did you mean {}?", near.join(", "))
        };
        return Err(Failure::call(format!("no warning is called {name:?}"), help));
    };
    let Row { name, quantity, bound, warns_below, consequence, help, .. } = row;
    let side = if warns_below { "at least" } else { "at most" };
    let text = format!(
        "{name}\n\n  what      {quantity}\n  bound     {side} {}\n  meaning   {consequence}\n  to do     {help}\n  manual    {PAGE}",
        figure(bound).parse().unwrap_or(bound) // without zeros at the end
    );
    Ok(Answer::new(json!(Explained { row, page: PAGE }), text))
}

fn list() -> Answer {
    let lines = ROWS.map(|Row { name, quantity, .. }| format!("\n  {name:<35}{quantity}"));
    let text = format!("warnings, `fret explain NAME` tells more:{}", lines.concat());
    Answer::new(json!({ "warnings": ROWS.map(|row| Explained { row, page: PAGE }) }), text)
}

/// A warning with its place in the manual.
#[derive(Serialize)]
struct Explained {
    #[serde(flatten)]
    row: Row,
    page: &'static str,
}

/// Letters and digits alone, small: dashes, blanks and underscores do not matter.
fn plain(name: &str) -> String {
    name.chars().filter(|letter| letter.is_alphanumeric()).flat_map(char::to_lowercase).collect()
}
