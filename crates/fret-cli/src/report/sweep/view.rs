//! A sweep seen as a whole, read back from its folder: its points, their answers and numbers, and which of its keys are axes.

use std::fs;
use std::path::Path;

use fret_core::model::Dimension;
use fret_core::units::Units;
use serde_json::Value;

use super::words::{OF_CYCLE, called, spoken};
use crate::failure::Failure;
use crate::report::{Measured, given, number, read_answer};
use crate::sweep::columns::{SummaryColumn, columns};
use crate::sweep::key::words_of;
use crate::sweep::kinds::kind_of;
use crate::sweep::record::PointOfSweep;
use crate::sweep::{Answer, Kept, POINTS, RECORD, SpreadRecord, SweepRecord, UNCERTAINTY};
use fret_drawing::Label;

/// What to do where a file of a sweep cannot be read.
const AGAIN: &str = "run `fret sweep` again: finished points are not solved again";

/// A sweep.
pub struct View {
    /// Its points and keys.
    pub record: SweepRecord,
    /// Name of the folder, for a sweep whose cases have no title.
    folder: String,
    /// What the points came to; nothing of those that are not finished.
    pub answers: Vec<Option<Answer>>,
    /// Numbers of the answers.
    pub columns: Vec<SummaryColumn>,
    /// What the samples say, where there are some.
    pub uncertainty: Option<SpreadRecord>,
}

impl View {
    /// Reads a folder that `fret sweep` has written.
    ///
    /// # Errors
    /// When a file that must be there cannot be read.
    pub fn read(folder: &Path) -> Result<Self, Failure> {
        let record: SweepRecord = read_answer(&folder.join(RECORD), AGAIN)?;
        let fits = |point: &PointOfSweep| point.values.len() == record.keys.len();
        if record.drawn.len() > record.keys.len() || !record.points.iter().all(fits) {
            let what = format!("{}: not what a sweep writes", folder.join(RECORD).display());
            return Err(Failure::call(what, "run fret sweep again"));
        }
        let answer = |file: &String| {
            let text = fs::read(folder.join(POINTS).join(file)).ok()?;
            Some(serde_json::from_slice::<Kept>(&text).ok()?.answer)
        };
        let answers: Vec<Option<Answer>> = record.points.iter().map(|point| answer(&point.file)).collect();
        let uncertainty = folder.join(UNCERTAINTY);
        let uncertainty = if uncertainty.exists() && !record.drawn.is_empty() {
            Some(read_answer(&uncertainty, AGAIN)?)
        } else {
            None
        };
        let name = folder.file_name().map_or_else(String::new, |name| name.display().to_string());
        // What is nowhere anything but nothing, wear where nothing wears, is no column of a page; the files have it.
        let mut columns = columns(&answers);
        let is_nothing = |value: &Value| value.is_null() || value.as_f64() == Some(0.0);
        columns.retain(|column| !column.values.iter().all(is_nothing));
        Ok(Self { columns, folder: name, record, answers, uncertainty })
    }

    /// The title of the page.
    pub fn title(&self) -> String {
        match &self.record.title {
            Some(title) => format!("Sweep: {title}"),
            None => format!("Sweep {}", self.folder),
        }
    }

    /// The column of a name.
    pub fn column(&self, name: &str) -> Option<&SummaryColumn> {
        self.columns.iter().find(|column| column.name == name)
    }

    /// Keys with more than one value, by their numbers; drawn ones are none of them.
    pub fn axes(&self) -> Vec<usize> {
        let kept = self.record.keys.len() - self.record.drawn.len();
        (0..kept).filter(|&key| self.distinct(key).len() > 1).collect()
    }

    /// Values of a key, each once, in their order.
    pub fn distinct(&self, key: usize) -> Vec<&Value> {
        let mut found: Vec<&Value> = Vec::new();
        for point in &self.record.points {
            if !found.contains(&&point.values[key]) {
                found.push(&point.values[key]);
            }
        }
        found
    }

    /// Where a point stands along a key: its value, or, where the values are no numbers, which of them it is, from 1.
    pub fn position(&self, key: usize, point: usize) -> f64 {
        let value = |point: usize| self.record.points[point].values[key].as_f64();
        if let (Some(value), true) = (value(point), self.is_numeric(key)) {
            return value;
        }
        let own = &self.record.points[point].values[key];
        1.0 + self.distinct(key).iter().position(|value| *value == own).unwrap_or(0) as f64
    }

    /// Whether all values of a key are numbers.
    pub fn is_numeric(&self, key: usize) -> bool {
        self.record.points.iter().all(|point| point.values[key].is_number())
    }

    /// The name of a key as an axis, with its unit where it is known.
    pub fn key_label(&self, key: usize) -> Label {
        let name = called(&self.record.keys[key]);
        if !self.is_numeric(key) {
            return Label::plain(&format!("{name}, which of its values"));
        }
        Label::with(&name, self.unit_of_key(&self.record.keys[key]))
    }

    fn unit_of_key(&self, key: &str) -> Option<String> {
        if words_of(key).contains(&"phase") {
            return Some("°".to_owned());
        }
        self.unit(kind_of(key)?)
    }

    /// The name of a column as an axis.
    pub fn label_of(&self, column: &SummaryColumn) -> Label {
        // that it is of the last cycle says the caption
        self.label(&spoken(&column.name).replace(OF_CYCLE, ""), &column.kind)
    }

    /// A value of a key in words.
    pub fn value(&self, key: usize, value: &Value) -> String {
        let unit = self.unit_of_key(&self.record.keys[key]).filter(|_| value.is_number());
        let words = value.as_f64().map_or_else(|| plain(value), given);
        unit.map_or_else(|| words.clone(), |unit| format!("{words}\u{a0}{unit}"))
    }

    /// A value of a column in words.
    pub fn told(&self, column: &SummaryColumn, point: usize) -> String {
        match &column.values[point] {
            Value::Null => "–".to_owned(),
            Value::String(word) if word == "inf" => "unlimited".to_owned(),
            Value::String(word) => word.replace('_', " "),
            other => self.with_unit(other.as_f64().map_or_else(|| plain(other), number), &column.kind),
        }
    }

    /// The values of a point along some keys, in words.
    pub fn place(&self, keys: &[usize], point: usize) -> String {
        let one = |&key: &usize| {
            let value = &self.record.points[point].values[key];
            format!("{} = {}", called(&self.record.keys[key]), self.value(key, value))
        };
        keys.iter().map(one).collect::<Vec<_>>().join(", ")
    }

    /// The points by their values along some keys, in words.
    pub fn groups(&self, keys: &[usize]) -> Vec<(String, Vec<usize>)> {
        let mut groups: Vec<(String, Vec<usize>)> = Vec::new();
        for point in 0..self.record.points.len() {
            let name = self.place(keys, point);
            match groups.iter_mut().find(|(known, _)| *known == name) {
                Some((_, points)) => points.push(point),
                None => groups.push((name, vec![point])),
            }
        }
        groups
    }

    /// The sliding condition of a point: of its last cycle, or at its end; `unsolved` of one without answer.
    pub fn condition(&self, point: usize) -> &str {
        let word = |name: &str| self.column(name).and_then(|column| column.values[point].as_str());
        word("cycle_regime").filter(|word| !word.is_empty()).or_else(|| word("regime")).unwrap_or("unsolved")
    }
}

impl Measured for View {
    fn units(&self) -> Option<&Units> {
        self.record.units.as_ref()
    }

    fn dimension(&self) -> Dimension {
        self.record.dimension
    }
}

/// A value that is no number, as it stands in a file.
fn plain(value: &Value) -> String {
    value.as_str().map_or_else(|| value.to_string(), str::to_owned)
}
