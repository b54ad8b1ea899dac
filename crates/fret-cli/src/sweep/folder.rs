//! The folder of a sweep: `sweep.toml` (verbatim copy), `points/HASH.json` (a finished point, known by the hash of its
//! case, of the files it names, of the state it starts from and of the version), `points.json` (the points in their order), `summary.csv` (a
//! line a point), of samples `uncertainty.json`.

use std::fs;
use std::path::{Path, PathBuf};

use fret_core::case::content;
use fret_core::model::digest;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use crate::failure::{Failure, Unwritten};
use crate::manner::Manner;
use crate::sweep::columns::SummaryColumn;
use crate::sweep::record::{PointOfSweep, SweepRecord};
use crate::sweep::setting::Setting;
use crate::sweep::{Answer, Point, Question, Spread};
use fret_results::{Origin, folder_below, resolved_path};

/// Version of the folder's format.
const FORMAT: u32 = 2;
const SWEEP: &str = "sweep.toml";
/// Finished points.
pub const POINTS: &str = "points";
const SUMMARY: &str = "summary.csv";
/// What the samples say.
pub const UNCERTAINTY: &str = "uncertainty.json";
/// The points in their order.
pub const RECORD: &str = "points.json";

/// A finished point, as it is written down.
#[derive(Serialize, Deserialize)]
pub struct Kept {
    /// What it came to.
    #[serde(flatten)]
    pub answer: Answer,
    format: u32,
    version: String,
    values: Map<String, Value>,
    case: String,
}

/// The folder of a sweep.
#[derive(Debug)]
pub struct SweepFolder<'a> {
    path: PathBuf,
    /// How much is told of what is written.
    manner: &'a Manner,
    /// Digest of the state that every point starts from, when there is one.
    start: Option<String>,
}

impl<'a> SweepFolder<'a> {
    /// Makes the folder ready; finished points in it stay.
    ///
    /// # Errors
    /// When the folder holds something else, or cannot be written.
    pub fn open(
        path: &Path,
        sweep: &str,
        origin: Option<&Origin>,
        manner: &'a Manner,
    ) -> Result<Self, Failure> {
        let path = resolved_path(path);
        let holds_something = fs::read_dir(&path).is_ok_and(|mut entries| entries.next().is_some());
        if path.exists() && !path.is_dir() || holds_something && !path.join(SWEEP).exists() {
            return Err(Failure::call(
                format!("{}: holds files that are no sweep of fret", path.display()),
                "choose another folder with --out DIR",
            ));
        }
        fs::create_dir_all(&path).map_err(Unwritten::at(&path))?;
        folder_below(&path, Path::new(POINTS))?;
        manner.write(&path.join(SWEEP), sweep.as_bytes())?;
        let start = origin.map(|origin| origin.start.digest().to_owned());
        Ok(Self { path, manner, start })
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
        self.manner.write_json(&self.place(point), &kept)
    }

    /// Writes the summary of what is finished.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub fn summarise(
        &self,
        (question, setting): (&Question, &Setting),
        answers: &[Option<Answer>],
        columns: &[SummaryColumn],
    ) -> Result<PathBuf, Unwritten> {
        let line = |first: &str, keys: Vec<String>, status: &str, numbers: Vec<String>, last: &str| {
            let cells = [&[first.to_owned()], &keys[..], &[status.to_owned()], &numbers, &[last.to_owned()]];
            cells.concat().join(",") + "\n"
        };
        let keys = question.keys.iter().map(|key| quoted(&setting.heading_of_key(key)));
        let names = columns.iter().map(|column| quoted(&setting.heading(column)));
        let mut text = line("point", keys.collect(), "status", names.collect(), "message");
        for (number, (point, answer)) in question.points.iter().zip(answers).enumerate() {
            let Some(answer) = answer else { continue };
            let values = point.values.iter().map(|value| cell(&plain(value)));
            let numbers = columns.iter().map(|column| cell(&column.values[number]));
            let [status, message] = [answer.status(), answer.message()].map(|word| cell(&json!(word)));
            text += &line(&number.to_string(), values.collect(), &status, numbers.collect(), &message);
        }
        let path = self.path.join(SUMMARY);
        self.manner.write(&path, text.as_bytes())?;
        Ok(path)
    }

    /// Writes what the samples of a sweep say, at each point of its axes; gives it to a person.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub fn spread(&self, spread: &Spread<'_>) -> Result<String, Unwritten> {
        let record = spread.record();
        self.manner.write_json(&self.path.join(UNCERTAINTY), &record)?;
        Ok(spread.table(&record))
    }

    /// Writes down which points there are, in their order: what the page of the sweep is made from.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub fn list(&self, question: &Question, setting: &Setting) -> Result<(), Unwritten> {
        let point = |point: &Point| PointOfSweep {
            values: point.values.iter().map(plain).collect(),
            file: self.file_name(point),
        };
        let record = SweepRecord {
            title: question.points.first().and_then(|point| title_of(&point.case_file.text)),
            keys: question.keys.clone(),
            drawn: question.drawn_keys().to_vec(),
            units: setting.units.clone(),
            dimension: setting.dimension,
            points: question.points.iter().map(point).collect(),
        };
        self.manner.write(&self.path.join(RECORD), format!("{}\n", json!(record)).as_bytes())
    }

    /// A folder beside the finished points for the run of one of them, while it is asked for more than its numbers.
    pub fn beside(&self, point: &Point) -> PathBuf {
        self.place(point).with_extension("run")
    }

    /// The file of a point.
    pub fn place(&self, point: &Point) -> PathBuf {
        self.path.join(POINTS).join(self.file_name(point))
    }

    fn file_name(&self, point: &Point) -> String {
        let mut known_by = format!("{}\n{}\n", env!("CARGO_PKG_VERSION"), point.case_file.text).into_bytes();
        known_by.extend(self.start.iter().flat_map(|start| start.bytes()));
        let folder = point.case_file.path.parent().unwrap_or_else(|| Path::new(""));
        for name in files_named(&point.case_file.text) {
            known_by.extend(content(&folder.join(name)).unwrap_or_default());
        }
        format!("{}.json", digest(known_by))
    }
}

fn title_of(text: &str) -> Option<String> {
    let table = text.parse::<toml::Table>().ok()?;
    Some(table.get("title")?.as_str()?.to_owned()).filter(|title| !title.is_empty())
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
