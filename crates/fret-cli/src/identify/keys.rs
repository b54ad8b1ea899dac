//! Numbers of a case that are fitted, by their keys, such as `lower.coatings[0].young`.

use fret_core::case::{Case, CaseError};
use toml::{Table, Value};

use crate::failure::Failure;
use crate::sweep::key;
use fret_results::CaseFile;

/// The positive number that stands at a key of the case.
pub fn value_of(case_file: &CaseFile, key: &str) -> Result<f64, Failure> {
    let root = Value::Table(read(case_file, key)?);
    let found = place_of(case_file, key)?.iter().try_fold(&root, |here, part| {
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

/// The place in the case that a key names: alike for all ways to write it.
pub fn place_of(case_file: &CaseFile, key: &str) -> Result<Vec<String>, Failure> {
    Ok(key::place(&read(case_file, key)?, key))
}

fn read(case_file: &CaseFile, key: &str) -> Result<Table, Failure> {
    case_file.text.parse().map_err(|_| unknown(key))
}

/// The case with other numbers at keys.
pub fn case_with(case_file: &CaseFile, numbers: &[(&str, f64)]) -> Result<Case, CaseError> {
    let refuse = |why: String| CaseError::plain(&case_file.name(), why);
    let mut table: Table = case_file.text.parse().map_err(|_| refuse("no table of keys".to_owned()))?;
    for (name, value) in numbers {
        key::put(&mut table, name, &Value::Float(*value)).map_err(refuse)?;
    }
    let text = toml::to_string(&table).map_err(|error| refuse(error.to_string()))?;
    CaseFile { text, ..case_file.clone() }.case(None)
}
