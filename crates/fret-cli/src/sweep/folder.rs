//! The folder of a sweep: `sweep.toml` (verbatim copy), `points/HASH.json` (a finished point, known by the hash of its
//! case, of the files it names, of the state it starts from and of the version), `summary.csv` (a line a point), of samples `uncertainty.json`.

use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

use fret_core::case::{Units, content};
use fret_core::history::{self, CYCLE_COLUMNS, Column, CycleRecord, STEP_COLUMNS, StepRecord};
use fret_core::model::digest;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use crate::failure::{Failure, Unwritten};
use crate::sweep::{Answer, Point, Question, Spread};
use fret_results::Origin;
use fret_results::{folder_below, resolved_path, write_whole};

/// Version of the folder's format.
const FORMAT: u32 = 1;
const SWEEP: &str = "sweep.toml";
const POINTS: &str = "points";
const SUMMARY: &str = "summary.csv";
const UNCERTAINTY: &str = "uncertainty.json";

/// Columns of the summary after the keys: the last increment.
const END: [&str; 12] = [
    "normal_force",
    "approach",
    "max_pressure",
    "max_shear",
    "contact_area",
    "stick_area",
    "dissipated_energy",
    "regime",
    "tangential_force_x",
    "tangential_force_y",
    "shift_x",
    "shift_y",
];
/// Columns of the last cycle.
const CYCLE: [&str; 9] = [
    "dissipated_energy",
    "force_amplitude",
    "displacement_amplitude",
    "energy_ratio",
    "sliding_ratio",
    "stiffness",
    "regime",
    "closure",
    "max_worn_depth",
];

/// A finished point, as it is written down.
#[derive(Serialize, Deserialize)]
struct Kept {
    #[serde(flatten)]
    answer: Answer,
    format: u32,
    version: String,
    values: Map<String, Value>,
    case: String,
}

/// The folder of a sweep.
#[derive(Debug)]
pub struct SweepFolder {
    path: PathBuf,
    /// Digest of the state that every point starts from, when there is one.
    start: Option<String>,
}

impl SweepFolder {
    /// Makes the folder ready; finished points in it stay.
    ///
    /// # Errors
    /// When the folder holds something else, or cannot be written.
    pub fn open(path: &Path, sweep: &str, origin: Option<&Origin>) -> Result<Self, Failure> {
        let path = resolved_path(path);
        let holds_something = fs::read_dir(&path).is_ok_and(|mut entries| entries.next().is_some());
        if path.exists() && !path.is_dir() || holds_something && !path.join(SWEEP).exists() {
            return Err(Failure::Call(
                format!("{}: holds files that are no sweep of fret", path.display()),
                "choose another folder with --out DIR".to_owned(),
            ));
        }
        fs::create_dir_all(&path).map_err(Unwritten::at(&path))?;
        folder_below(&path, Path::new(POINTS))?;
        write_whole(&path.join(SWEEP), sweep.as_bytes())?;
        let start = origin.map(|origin| origin.start.digest().to_owned());
        Ok(Self { path, start })
    }

    /// The answer of a finished point; a file that cannot be read is no answer.
    pub fn finished(&self, point: &Point) -> Option<Answer> {
        let text = fs::read(self.place(point)).ok()?;
        let kept: Kept = serde_json::from_slice(&text).ok()?;
        (kept.format == FORMAT && kept.answer.is_whole()).then_some(kept.answer)
    }

    /// Writes a finished point down, whole or not at all.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub fn keep(&self, keys: &[String], point: &Point, answer: &Answer) -> Result<(), Unwritten> {
        let kept = Kept {
            answer: answer.clone(),
            format: FORMAT,
            version: env!("CARGO_PKG_VERSION").to_owned(),
            values: keys.iter().zip(&point.values).map(|(key, value)| (key.clone(), plain(value))).collect(),
            case: point.case_file.text.clone(),
        };
        write_whole(&self.place(point), format!("{:#}\n", json!(kept)).as_bytes())
    }

    /// Writes the summary of what is finished.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub fn summarise(&self, question: &Question, answers: &[Option<Answer>]) -> Result<PathBuf, Unwritten> {
        let units = question.points.first().and_then(|point| units_of(&point.case_file.text));
        let heading = |name: &str, kind: &str| Units::heading(units.as_ref(), name, kind, false);
        let cycle = of_cycle().map(|column| heading(&format!("cycle_{}", column.name), column.unit));
        let head = ["point".to_owned()].into_iter().chain(question.keys.iter().cloned());
        let head = head
            .chain(["status".to_owned()])
            .chain(at_end().map(|column| heading(column.name, column.unit)))
            .chain(cycle);
        let mut text =
            head.chain(["message".to_owned()]).map(|cell| quoted(&cell)).collect::<Vec<_>>().join(",") + "\n";
        for (number, (point, answer)) in question.points.iter().zip(answers).enumerate() {
            let Some(answer) = answer else { continue };
            let _ = write!(text, "{number}");
            for value in point.values.iter().map(plain) {
                let _ = write!(text, ",{}", cell(&value));
            }
            let _ = write!(text, ",{}", cell(&json!(answer.status())));
            for value in values(answer) {
                let _ = write!(text, ",{}", cell(&value));
            }
            let _ = writeln!(text, ",{}", cell(&json!(answer.message())));
        }
        let path = self.path.join(SUMMARY);
        write_whole(&path, text.as_bytes())?;
        Ok(path)
    }

    /// Writes what the samples of a sweep say, where it has some, at each point of its axes; gives it to a person.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub fn spread(
        &self,
        question: &Question,
        answers: &[Option<Answer>],
    ) -> Result<Option<String>, Unwritten> {
        let Some(design) = &question.design else { return Ok(None) };
        let rows: Vec<Option<Vec<Value>>> =
            answers.iter().map(|answer| answer.as_ref().map(values)).collect();
        let at = |place: usize| rows.iter().map(move |row| row.as_ref()?.get(place)?.as_f64());
        let names = at_end().map(|column| column.name.to_owned());
        let names = names.chain(of_cycle().map(|column| format!("cycle_{}", column.name)));
        let column = |place: usize| at(place).map(|value| value.unwrap_or(f64::NAN)).collect();
        let columns: Vec<_> = names.enumerate().map(|(place, name)| (name, column(place))).collect();
        let keys = question.drawn_keys();
        let beside = question.keys.len() - keys.len();
        let firsts = question.points.iter().step_by(design.points().max(1));
        let at =
            firsts.map(|point| question.keys.iter().cloned().zip(point.values[..beside].to_vec()).collect());
        let spread = Spread::new(keys, design, at.collect(), &columns);
        write_whole(&self.path.join(UNCERTAINTY), format!("{:#}\n", spread.to_json()).as_bytes())?;
        Ok(Some(spread.table()))
    }

    fn place(&self, point: &Point) -> PathBuf {
        let mut known_by = format!("{}\n{}\n", env!("CARGO_PKG_VERSION"), point.case_file.text).into_bytes();
        known_by.extend(self.start.iter().flat_map(|start| start.bytes()));
        let folder = point.case_file.path.parent().unwrap_or_else(|| Path::new(""));
        for name in files_named(&point.case_file.text) {
            known_by.extend(content(&folder.join(name)).unwrap_or_default());
        }
        self.path.join(POINTS).join(format!("{}.json", digest(known_by)))
    }
}

/// Columns of the last increment.
fn at_end() -> impl Iterator<Item = &'static Column<StepRecord>> {
    END.iter().filter_map(|name| STEP_COLUMNS.iter().find(|column| column.name == *name))
}

/// Columns of the last cycle.
fn of_cycle() -> impl Iterator<Item = &'static Column<CycleRecord>> {
    CYCLE.iter().filter_map(|name| CYCLE_COLUMNS.iter().find(|column| column.name == *name))
}

/// Values of all columns; null where an answer has none.
fn values(answer: &Answer) -> Vec<Value> {
    fn told<R>(column: &Column<R>, record: Option<&R>) -> Value {
        let Some(record) = record else { return Value::Null };
        match column.value {
            history::Value::Count(of) => json!(of(record)),
            history::Value::Real(of) => json!(of(record)),
            history::Value::RealOrNone(of) => json!(of(record)),
            history::Value::Truth(of) => json!(of(record)),
            history::Value::Word(of) => json!(of(record)),
        }
    }
    let numbers = answer.numbers.as_ref();
    let end = at_end().map(|column| told(column, numbers.and_then(|numbers| numbers.end.as_ref())));
    let cycle = of_cycle().map(|column| told(column, numbers.and_then(|numbers| numbers.cycle.as_ref())));
    end.chain(cycle).collect()
}

/// Units that the text of a case declares. Of a line contact, whose grid is not known here, none are told.
fn units_of(text: &str) -> Option<Units> {
    let table = text.parse::<toml::Table>().ok()?;
    let units = table.get("units")?;
    let cells = table.get("grid")?.get("cells")?.as_array()?;
    let is_line = cells.get(1).and_then(toml::Value::as_integer) == Some(1);
    (!is_line).then(|| Some(Units::new(units.get("length")?.as_str()?, units.get("force")?.as_str()?)))?
}

/// Names of files in a case: words under the keys that can name one.
fn files_named(text: &str) -> Vec<String> {
    fn look(value: &toml::Value, key: &str, found: &mut Vec<String>) {
        match value {
            toml::Value::Table(table) => table.iter().for_each(|(key, value)| look(value, key, found)),
            toml::Value::Array(items) => items.iter().for_each(|item| look(item, key, found)),
            toml::Value::String(name)
                if matches!(key, "file" | "map" | "friction" | "max_shear" | "table") =>
            {
                found.push(name.clone());
            }
            _ => {}
        }
    }
    let mut found = Vec::new();
    if let Ok(table) = text.parse::<toml::Table>() {
        look(&toml::Value::Table(table), "", &mut found);
    }
    found
}

/// A value of a key as JSON; a date, which JSON does not have, as a text.
fn plain(value: &toml::Value) -> Value {
    if let toml::Value::Datetime(date) = value { json!(date.to_string()) } else { json!(value) }
}

/// A value in a line of comma-separated ones; nothing where there is none. A text that a spreadsheet would take for a formula stands behind
/// an apostrophe.
fn cell(value: &Value) -> String {
    match value {
        Value::Null => String::new(),
        Value::String(text) if text.starts_with(['=', '+', '-', '@', '\t', '\r']) => {
            quoted(&format!("'{text}"))
        }
        Value::String(text) => quoted(text),
        Value::Number(_) | Value::Bool(_) => value.to_string(),
        other => quoted(&other.to_string()),
    }
}

fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_summary_has_columns_of_the_tables() {
        for name in END {
            assert!(STEP_COLUMNS.iter().any(|column| column.name == name), "{name}");
        }
        for name in CYCLE {
            assert!(CYCLE_COLUMNS.iter().any(|column| column.name == name), "{name}");
        }
    }
}
