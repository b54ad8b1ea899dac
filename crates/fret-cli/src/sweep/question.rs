//! The sweep file: `base`, a case file beside it or a table; `[axes]`, values of keys of the case, all combined; or
//! `[[point]]`, values of keys that change together; `[distributions]` of keys, from which `[samples]` are drawn, all of them at each
//! point of the axes.

use std::ops::Range;
use std::path::{Path, PathBuf};

use fret_core::case::{CaseError, Mistake, in_words, refuse_too_long};
use fret_core::uncertainty::SampleDesign;
use toml::de::{DeTable, DeValue};
use toml::{Spanned, Table, Value};

use crate::sweep::drawn::{Drawn, KINDS};
use crate::sweep::key::{place, put, words_of};
use fret_results::CaseFile;

/// More mistakes than this are not told.
const MOST_MISTAKES: usize = 30;
/// Points of a sweep at the most.
const MOST_POINTS: usize = 1_000_000;

/// A sweep that can be begun.
#[derive(Debug)]
pub struct Question {
    /// Its text, verbatim.
    pub text: String,
    /// The keys that change, in the order of the file.
    pub keys: Vec<String>,
    /// The points, the last axis fastest.
    pub points: Vec<Point>,
    /// How the samples were drawn, where there are some; their keys are the last ones.
    pub design: Option<SampleDesign>,
}

impl Question {
    /// The keys whose values are drawn.
    pub fn drawn_keys(&self) -> &[String] {
        let drawn = self.design.as_ref().map_or(0, |design| design.distributions.len());
        &self.keys[self.keys.len() - drawn..]
    }
}

/// One point of a sweep.
#[derive(Debug)]
pub struct Point {
    /// Its values, one a key.
    pub values: Vec<Value>,
    /// Its case, as a file that lies beside the base case.
    pub case_file: CaseFile,
}

/// Values of keys that change together: the keys, and rows of their values.
struct Axis {
    keys: Vec<String>,
    rows: Vec<Vec<Value>>,
    span: Range<usize>,
}

impl Question {
    /// Reads a sweep file.
    ///
    /// # Errors
    /// With every mistake found, each with its place.
    pub fn read(path: &Path) -> Result<Self, CaseError> {
        let file = CaseFile::read(path)?;
        refuse_too_long(&file.text, &file.name(), "a sweep file")?;
        Reader { file: &file, mistakes: Vec::new() }.question()
    }
}

struct Reader<'a> {
    file: &'a CaseFile,
    mistakes: Vec<Mistake>,
}

impl Reader<'_> {
    fn question(mut self) -> Result<Question, CaseError> {
        let text = &self.file.text;
        let table = match DeTable::parse(text) {
            Ok(table) => table.into_inner(),
            Err(error) => {
                self.refuse(error.span(), in_words(error.message()), None);
                return Err(self.refusal());
            }
        };
        let is_case =
            !table.contains_key("base") && ["grid", "load"].iter().all(|&key| table.contains_key(key));
        if is_case {
            let way = "`fret run FILE` solves it; a sweep over it has base = \"FILE\" and [axes]";
            self.refuse(None, "a case, not a sweep over cases", Some(way));
            return Err(self.refusal());
        }
        let mut base = None;
        let mut axes = Vec::new();
        let mut drawn = Drawn::default();
        for (name, value) in &table {
            match name.get_ref().as_ref() {
                "base" => base = self.base(value),
                "axes" => self.axes(value, "", &mut axes),
                "point" => axes.extend(self.points(value)),
                "distributions" => {
                    drawn.span = Some(name.span());
                    self.distributions(value, "", &mut drawn);
                }
                "samples" => self.samples(value, &mut drawn),
                other => self.refuse(
                    name.span(),
                    format!(
                        "unknown key `{other}`, expected `base`, `axes`, `point`, `distributions` or `samples`"
                    ),
                    None,
                ),
            }
        }
        axes.sort_by_key(|axis| axis.span.start);
        let design = self.designed(&drawn, &mut axes);
        let nothing = Some("[axes]\n\"friction.coefficient\" = [0.1, 0.2]");
        if base.is_none() && self.mistakes.is_empty() {
            self.refuse(None, "no base case", Some("base = \"case.toml\", or a table [base]"));
        }
        if axes.is_empty() && self.mistakes.is_empty() {
            self.refuse(None, "nothing changes: no [axes], no [[point]] and no [distributions]", nothing);
        }
        let count = axes.iter().try_fold(1_usize, |count, axis| count.checked_mul(axis.rows.len()));
        if count.is_none_or(|count| count > MOST_POINTS) {
            self.refuse(None, format!("more than {MOST_POINTS} points"), None);
        }
        let Some((base, folder)) = base.filter(|_| self.mistakes.is_empty()) else {
            return Err(self.refusal());
        };
        self.refuse_one_place_twice(&base, &axes);
        if !self.mistakes.is_empty() {
            return Err(self.refusal());
        }
        let points = self.combined(&base, &folder, &axes);
        if let Some(first) = points.first() {
            self.refuse_unknown_keys(first, &axes);
        }
        if self.mistakes.is_empty() {
            Ok(Question {
                text: text.clone(),
                keys: axes.into_iter().flat_map(|axis| axis.keys).collect(),
                points,
                design,
            })
        } else {
            Err(self.refusal())
        }
    }

    /// The base case, and the folder that its files lie in.
    fn base(&mut self, value: &Spanned<DeValue<'_>>) -> Option<(Table, PathBuf)> {
        let here = self.file.path.parent().unwrap_or_else(|| Path::new("")).to_owned();
        match value.get_ref() {
            DeValue::String(name) => {
                let path = here.join(name.as_ref());
                let read = CaseFile::read_ordinary(&path).map_err(|error| error.to_string());
                match read.and_then(|file| {
                    file.text.parse::<Table>().map_err(|error| format!("{}: {error}", file.name()))
                }) {
                    Ok(table) => Some((table, path.parent().map_or(here, Path::to_owned))),
                    Err(error) => {
                        self.refuse(value.span(), error.trim_start_matches("error: ").trim(), None);
                        None
                    }
                }
            }
            DeValue::Table(_) => match self.plain(value) {
                Value::Table(table) => Some((table, here)),
                _ => None,
            },
            _ => {
                self.refuse(value.span(), "base: must be the name of a case file, or a table", None);
                None
            }
        }
    }

    /// Axes of a table; tables in it are parts of dotted keys.
    fn axes(&mut self, value: &Spanned<DeValue<'_>>, before: &str, axes: &mut Vec<Axis>) {
        let DeValue::Table(table) = value.get_ref() else {
            self.refuse(value.span(), "axes: must be a table of lists", None);
            return;
        };
        for (name, value) in table {
            let key = format!("{before}{}", name.get_ref());
            match value.get_ref() {
                DeValue::Table(_) => self.axes(value, &format!("{key}."), axes),
                DeValue::Array(items) if !items.is_empty() => {
                    let rows = items.iter().map(|item| vec![self.plain(item)]).collect();
                    axes.push(Axis { keys: vec![key], rows, span: value.span() });
                }
                _ => self.refuse(
                    value.span(),
                    format!("axes: `{key}` must be a list of at least one value"),
                    Some(&format!("\"{key}\" = [...]")),
                ),
            }
        }
    }

    fn points(&mut self, value: &Spanned<DeValue<'_>>) -> Option<Axis> {
        let Value::Array(points) = self.plain(value) else {
            self.refuse(value.span(), "point: must be a list of tables, [[point]]", None);
            return None;
        };
        let tables: Vec<Table> = points.iter().filter_map(Value::as_table).map(flattened).collect();
        let keys: Vec<&String> = tables.first().map_or_else(Vec::new, |first| first.keys().collect());
        let alike = tables.iter().all(|table| table.keys().eq(keys.iter().copied()));
        if keys.is_empty() || tables.len() < points.len() || !alike {
            self.refuse(value.span(), "point: every [[point]] must have the same keys, at least one", None);
            return None;
        }
        let rows = tables.iter().map(|table| table.values().cloned().collect()).collect();
        Some(Axis { keys: keys.into_iter().cloned().collect(), rows, span: value.span() })
    }

    /// Distributions of a table; tables in it that are none are parts of dotted keys.
    fn distributions(&mut self, value: &Spanned<DeValue<'_>>, before: &str, drawn: &mut Drawn) {
        let help = "\"friction.coefficient\" = { normal = { mean = 0.6, deviation = 0.05 } }";
        let DeValue::Table(table) = value.get_ref() else {
            let key = before.trim_end_matches('.');
            self.refuse(value.span(), format!("distributions: `{key}` has no distribution"), Some(help));
            return;
        };
        for (name, value) in table {
            let key = format!("{before}{}", name.get_ref());
            let kind = match value.get_ref() {
                DeValue::Table(inner) => inner.keys().find(|kind| KINDS.contains(&kind.get_ref().as_ref())),
                _ => None,
            };
            if kind.is_none() {
                self.distributions(value, &format!("{key}."), drawn);
                continue;
            }
            let plain = self.plain(value);
            if let Err(message) = drawn.add(key, plain) {
                self.refuse(value.span(), message, Some(help));
            }
        }
    }

    /// How many samples are drawn, and how.
    fn samples(&mut self, value: &Spanned<DeValue<'_>>, drawn: &mut Drawn) {
        let plain = self.plain(value);
        if let Err(message) = drawn.count(plain) {
            let help = "[samples]\ncount = 256\nseed = 1\nindices = true";
            self.refuse(value.span(), message, Some(help));
        }
        drawn.samples = Some(value.span());
    }

    /// The samples of the distributions, as the rows of the last axis: each of them at every point of the others.
    fn designed(&mut self, drawn: &Drawn, axes: &mut Vec<Axis>) -> Option<SampleDesign> {
        let Some(span) = drawn.span.clone() else {
            if drawn.samples.is_some() {
                self.refuse(
                    drawn.samples.clone(),
                    "samples: there is nothing to draw from",
                    Some("[distributions]"),
                );
            }
            return None;
        };
        if !self.mistakes.is_empty() {
            return None;
        }
        match drawn.rows() {
            Ok((keys, rows, design)) => {
                if let Some(twice) = axes.iter().flat_map(|axis| &axis.keys).find(|key| keys.contains(key)) {
                    let message =
                        format!("distributions: `{twice}` has values already, in [axes] or [[point]]");
                    self.refuse(span, message, Some("a distribution or values"));
                    return None;
                }
                axes.push(Axis { keys, rows, span });
                Some(design)
            }
            Err(message) => {
                let place = drawn.samples.clone().unwrap_or(span);
                self.refuse(place, message, Some("[samples]\ncount = 256"));
                None
            }
        }
    }

    /// All points, the last axis fastest.
    fn combined(&mut self, base: &Table, folder: &Path, axes: &[Axis]) -> Vec<Point> {
        let count: usize = axes.iter().map(|axis| axis.rows.len()).product();
        let mut points = Vec::with_capacity(count);
        for number in 0..count {
            let mut case = base.clone();
            let mut values = Vec::new();
            let mut others = count;
            for axis in axes {
                others /= axis.rows.len();
                let row = &axis.rows[number / others % axis.rows.len()];
                for (key, value) in axis.keys.iter().zip(row) {
                    if let Err(nowhere) = put(&mut case, key, value) {
                        self.refuse(axis.span.clone(), format!("{key}: {nowhere}"), None);
                        return points; // every point would say so again
                    }
                    values.push(value.clone());
                }
            }
            match toml::to_string(&case) {
                Ok(text) => {
                    let path = folder.join(format!("point {number}"));
                    points.push(Point { values, case_file: CaseFile { path, text, beside: None } });
                }
                Err(error) => self.refuse(None, error.to_string(), None),
            }
        }
        points
    }

    /// Refuses two keys that name one place: the values of the first would be lost.
    fn refuse_one_place_twice(&mut self, base: &Table, axes: &[Axis]) {
        let mut before: Vec<(Vec<String>, &String)> = Vec::new();
        for axis in axes {
            for key in &axis.keys {
                let place = place(base, key);
                if let Some((_, other)) = before.iter().find(|(known, _)| *known == place) {
                    let message = format!("`{key}` and `{other}` are one place of the case");
                    self.refuse(axis.span.clone(), message, Some("one of the two"));
                }
                before.push((place, key));
            }
        }
    }

    /// Refuses, once and not at every point, the axes whose keys no case knows.
    fn refuse_unknown_keys(&mut self, first: &Point, axes: &[Axis]) {
        let Err(error) = first.case_file.case(None) else { return };
        let unknown = |mistake: &Mistake| mistake.message.starts_with("unknown key `");
        for mistake in error.mistakes().iter().filter(|mistake| unknown(mistake)) {
            let word = mistake.message.split('`').nth(1).unwrap_or_default();
            let names = |key: &String| words_of(key).contains(&word);
            let axis = axes.iter().find_map(|axis| axis.keys.iter().find(|key| names(key)).zip(Some(axis)));
            if let Some((key, axis)) = axis {
                let message = format!("{key}: {}", mistake.message);
                self.refuse(axis.span.clone(), message, mistake.help.as_deref());
            }
        }
    }

    /// A value without its place.
    fn plain(&mut self, value: &Spanned<DeValue<'_>>) -> Value {
        match value.get_ref() {
            DeValue::String(text) => Value::String(text.to_string()),
            DeValue::Boolean(truth) => Value::Boolean(*truth),
            DeValue::Array(items) => Value::Array(items.iter().map(|item| self.plain(item)).collect()),
            DeValue::Table(table) => Value::Table(
                table.iter().map(|(name, value)| (name.get_ref().to_string(), self.plain(value))).collect(),
            ),
            DeValue::Datetime(moment) => Value::Datetime(*moment),
            DeValue::Integer(_) | DeValue::Float(_) => self.number(value),
        }
    }

    fn number(&mut self, value: &Spanned<DeValue<'_>>) -> Value {
        // As the text has it: its own reader knows all forms of numbers.
        let text = self.file.text.get(value.span()).unwrap_or_default();
        match format!("number = {text}").parse::<Table>() {
            Ok(mut table) => table.remove("number").unwrap_or(Value::Boolean(false)),
            Err(error) => {
                self.refuse(value.span(), in_words(error.message()), None);
                Value::Boolean(false)
            }
        }
    }

    fn refuse(
        &mut self,
        span: impl Into<Option<Range<usize>>>,
        message: impl Into<String>,
        help: Option<&str>,
    ) {
        if self.mistakes.len() < MOST_MISTAKES {
            let (span, help) = (span.into(), help.map(str::to_owned));
            self.mistakes.push(Mistake { message: message.into(), help, span });
        }
    }

    fn refusal(self) -> CaseError {
        CaseError::new(&self.file.name(), &self.file.text, self.mistakes)
    }
}

/// A table whose tables have become dotted keys.
fn flattened(table: &Table) -> Table {
    let mut flat = Table::new();
    for (name, value) in table {
        match value {
            Value::Table(inner) => {
                flat.extend(
                    flattened(inner).into_iter().map(|(rest, value)| (format!("{name}.{rest}"), value)),
                );
            }
            _ => {
                flat.insert(name.clone(), value.clone());
            }
        }
    }
    flat
}
