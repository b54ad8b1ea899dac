//! A measured log, identified by a case: what the core finds (`fret_core::identify`), as a record, a text, a table and a page; of fretting loops,
//! and of an indentation (`indentation.rs`).

mod constant;
pub mod indentation;
mod over_cycles;
mod page;
mod record;
mod repeated;
mod summary;
mod table;
#[cfg(test)]
mod tests;

use std::path::Path;

use fret_core::case::{Case, CaseError};
use fret_core::identify::{self, IdentifyError, Key};
use serde_json::Value;
use toml::Table;

use crate::failure::Failure;
use crate::sweep::key;
use fret_results::CaseFile;

/// What is asked of a log, and the key of the case that is fitted too, such as `lower.substrate.young`.
#[derive(Debug, Clone, Default)]
pub struct Request {
    /// Of the log.
    pub log: identify::Request,
    /// The key.
    pub key: Option<String>,
}

impl From<IdentifyError> for Failure {
    fn from(error: IdentifyError) -> Self {
        match error {
            IdentifyError::Log { what, help } => Self::Call(what, help),
            IdentifyError::Case(error) => Self::Case(error),
            IdentifyError::Unsolved(error) => Self::Unsolved(error),
        }
    }
}

/// What is told of a log.
#[derive(Debug)]
pub struct Identified {
    /// For programs, as `identified.json` has it.
    pub record: Value,
    /// For a person.
    pub text: String,
    /// The page with its pictures.
    pub page: String,
    /// Names and contents of files: the cycles of the loops and the fits repeated over them, or the points of the indentation, as CSV.
    pub tables: Vec<(&'static str, String)>,
}

/// Identifies a log by a case.
///
/// # Errors
/// When the log cannot be read as fretting loops of such a case, or the case cannot be solved.
pub fn identify(log: (&str, &[u8]), case_file: &CaseFile, request: &Request) -> Result<Identified, Failure> {
    let case = case_file.case(None)?;
    let found = match &request.key {
        None => identify::identify(log, case, None, &request.log)?,
        Some(name) => {
            let case_with = |value| case_with(case_file, &[(name, value)]);
            let key = Key { name, value: value_of(case_file, name)?, case_with: &case_with };
            identify::identify(log, case, Some(key), &request.log)?
        }
    };
    let mut tables = vec![("cycles.csv", table::table(&found))];
    if !found.repeated.is_empty() {
        tables.push(("fits.csv", repeated::table(&found)));
    }
    Ok(Identified {
        record: record::record(&found),
        text: summary::summary(&found),
        page: page::page(&found),
        tables,
    })
}

/// The positive number that stands at a key of the case.
fn value_of(case_file: &CaseFile, key: &str) -> Result<f64, Failure> {
    // A bracket that is not one of a pair around a number.
    let is_closed = |part: &str| {
        part.split_once(']').is_some_and(|(index, rest)| {
            index.parse::<usize>().is_ok()
                && (rest.is_empty() || rest.starts_with('.'))
                && !rest.contains(']')
        })
    };
    let mut parts = key.split('[');
    if parts.next().is_some_and(|first| first.contains(']')) || !parts.all(is_closed) {
        return Err(unknown(key));
    }
    let table: Table = case_file.text.parse().map_err(|_| unknown(key))?;
    let root = toml::Value::Table(table);
    let found = key::dotted(key).split('.').try_fold(&root, |here, part| {
        part.parse::<usize>().map_or_else(|_| here.get(part), |index| here.get(index))
    });
    let value =
        found.and_then(|value| value.as_float().or_else(|| value.as_integer().map(|value| value as f64)));
    value.filter(|value| *value > 0.0).ok_or_else(|| unknown(key))
}

fn unknown(key: &str) -> Failure {
    Failure::call(
        format!("--fit {key}: the case has no positive number there"),
        "a key such as lower.substrate.young or lower.coatings.0.thickness; a number that is a default, or that another key stands for \
         (profile.pyramid.indenter for half_angle), is written into the case first",
    )
}

/// The case with other numbers at keys.
fn case_with(case_file: &CaseFile, numbers: &[(&str, f64)]) -> Result<Case, CaseError> {
    let refuse = |why: String| CaseError::plain(&case_file.name(), why);
    let mut table: Table = case_file.text.parse().map_err(|_| refuse("no table of keys".to_owned()))?;
    for (name, value) in numbers {
        key::put(&mut table, name, &toml::Value::Float(*value)).map_err(refuse)?;
    }
    let text = toml::to_string(&table).map_err(|error| refuse(error.to_string()))?;
    CaseFile { text, ..case_file.clone() }.case(None)
}

/// The name of a log in messages and results.
pub fn name_of(path: &Path) -> String {
    path.display().to_string()
}
