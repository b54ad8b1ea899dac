//! `fret explain`: what a warning means, and what to do.

use fret_core::history::Concern;
use serde_json::{Value, json};

use crate::failure::Failure;
use crate::terminal::Answer;

/// Where all of them stand in the manual.
const PAGE: &str = "docs/reference/messages.md#warnings";

/// So many names are told at most where none fits.
const MOST_NEAR: usize = 4;

/// Tells what is known of a warning, or lists all.
pub fn explain(name: Option<&str>) -> Result<Answer, Failure> {
    let Some(name) = name else { return Ok(list()) };
    let asked = plain(name);
    // by its name, or by the words that its message begins with, if those are of one alone
    let begins = |concern: &Concern| !asked.is_empty() && plain(concern.quantity()).starts_with(&asked);
    let begun: Vec<Concern> = Concern::ALL.into_iter().filter(begins).collect();
    let named = Concern::ALL
        .into_iter()
        .find(|concern| [concern.name(), concern.quantity()].map(plain).contains(&asked));
    let concern = named.or(if let [one] = begun[..] { Some(one) } else { None });
    let Some(concern) = concern else {
        let is_near = |concern: &Concern| begun.contains(concern) || plain(concern.name()).contains(&asked);
        let near: Vec<&str> = Concern::ALL.into_iter().filter(is_near).map(Concern::name).collect();
        let help = if near.is_empty() || near.len() > MOST_NEAR {
            "`fret explain` lists them all".to_owned()
        } else {
            format!("did you mean {}?", near.join(", "))
        };
        return Err(Failure::Call(format!("no warning is called {name:?}"), help));
    };
    let side = if concern.warns_below() { "at least" } else { "at most" };
    let text = format!(
        "{}\n\n  what      {}\n  bound     {side} {}\n  meaning   {}\n  to do     {}\n  manual    {PAGE}",
        concern.name(),
        concern.quantity(),
        concern.bound(),
        concern.consequence(),
        concern.help()
    );
    Ok(Answer::new(of(concern), text, false))
}

fn list() -> Answer {
    let lines = Concern::ALL.map(|concern| format!("\n  {:<35}{}", concern.name(), concern.quantity()));
    let text = format!("warnings, `fret explain NAME` tells more:{}", lines.concat());
    Answer::new(json!({ "warnings": Concern::ALL.map(of) }), text, false)
}

fn of(concern: Concern) -> Value {
    json!({
        "name": concern.name(),
        "quantity": concern.quantity(),
        "bound": concern.bound(),
        "warns_below": concern.warns_below(),
        "consequence": concern.consequence(),
        "help": concern.help(),
        "page": PAGE,
    })
}

/// Letters and digits alone, small: dashes, blanks and underscores do not matter.
fn plain(name: &str) -> String {
    name.chars().filter(|letter| letter.is_alphanumeric()).flat_map(char::to_lowercase).collect()
}
