//! One pass over a document: values where they are right; where not, a mistake, and where it can be, a value that stands in, so that the
//! rest is judged, too.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::ops::Range as Span;

use toml::Spanned;
use toml::de::DeValue;

use super::mistake::Mistake;
use super::range::Range;
use super::words::{expected, found, near_miss, shortened};

/// A value as it is written.
pub type Written<'d> = Spanned<DeValue<'d>>;

/// A value; or, when a mistake was told, what stands in for it, if anything can.
pub type Reading<T> = Result<T, Option<T>>;

/// The place of what only stands in.
pub(super) const NOWHERE: Span<usize> = usize::MAX..usize::MAX;

/// The help where no nearer one is known.
const EVERY_KEY: &str = "`fret schema` lists every key with its meaning";

/// What can be read from a document.
pub trait Read: Sized {
    /// What belongs there, in words.
    const EXPECTED: &'static str;

    /// Whether the kind of value is the right one, so that this alternative of a choice is meant.
    fn fits(value: &Written<'_>) -> bool;

    /// The value, or a mistake that the reader is told of.
    ///
    /// # Errors
    /// With what stands in for it.
    fn read(value: &Written<'_>, reader: &mut Reader) -> Reading<Self>;

    /// A harmless value, to stand in for one that cannot be read.
    fn stand_in() -> Option<Self> {
        None
    }

    /// Its numbers, of which a range may be asked.
    fn numbers(&self) -> Vec<f64> {
        Vec::new()
    }

    /// Its numbers as messages show them.
    fn shown(&self) -> String {
        String::new()
    }

    /// The first number inside it that lies outside of its range: its key, and what is wrong.
    fn fault(&self) -> Option<(String, String)> {
        None
    }
}

/// The first number of a key, or inside its table, that lies outside of its range.
pub fn fault<T: Read>(key: &str, given: &T, range: Option<Range>) -> Option<(String, String)> {
    let out = range.filter(|range| !given.numbers().iter().all(|number| range.holds(*number)));
    out.map(|out| (key.to_owned(), format!("{key} = {}: {}", given.shown(), out.words)))
        .or_else(|| given.fault().map(|(inner, what)| (format!("{key}.{inner}"), format!("{key}.{what}"))))
}

/// Collects the mistakes of a document, and the places of all that stands in its tables.
#[derive(Debug, Default)]
pub struct Reader {
    mistakes: Vec<Mistake>,
    refused: Vec<Refused>,
    places: BTreeMap<String, Span<usize>>,
    place: String,
}

/// An entry that was refused.
#[derive(Debug)]
struct Refused {
    /// Its dotted key.
    key: String,
    /// Where it stands.
    entry: Span<usize>,
    /// The table that it was meant for; `None` where it was understood.
    table: Option<Span<usize>>,
    /// Whether nothing stands in for it.
    is_lost: bool,
}

/// Where everything stands, by its dotted key, and what of it was refused.
#[derive(Debug, Default)]
pub struct Places {
    refused: Vec<Refused>,
    places: BTreeMap<String, Span<usize>>,
}

impl Places {
    /// Where the value of a dotted key stands.
    pub fn of(&self, key: &str) -> Option<Span<usize>> {
        self.places.get(key).cloned()
    }

    /// Whether nothing was refused, so that one entry can be judged by another.
    pub fn are_whole(&self) -> bool {
        self.refused.is_empty()
    }

    /// Whether nothing at a dotted key or inside of it was refused.
    pub fn are_whole_in(&self, key: &str) -> bool {
        let is_inside = |refused: &Refused| {
            refused.key.strip_prefix(key).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
        };
        !self.refused.iter().any(is_inside)
    }

    /// Whether a mistake at this place follows from one that was told: it is one of what stands in for a refused entry, or of the table
    /// that lacks it.
    pub fn follows(&self, span: &Span<usize>) -> bool {
        if *span == NOWHERE {
            return true;
        }
        let holds = |entry: &Span<usize>| entry.start <= span.start && span.end <= entry.end;
        self.refused.iter().any(|refused| holds(&refused.entry) || refused.table.as_ref() == Some(span))
    }
}

impl Reader {
    /// The mistakes, and where what was written stands.
    pub fn end(self) -> (Vec<Mistake>, Places) {
        (self.mistakes, Places { refused: self.refused, places: self.places })
    }

    fn tell(&mut self, span: Span<usize>, message: String, help: String) {
        self.mistakes.push(Mistake {
            message,
            help: Some(help).filter(|help| !help.is_empty()),
            span: Some(span),
        });
    }

    /// A value of the wrong kind, for which `instead` may stand in.
    ///
    /// # Errors
    /// Always.
    pub fn wrong<T>(&mut self, value: &Written<'_>, wanted: &str, instead: Option<T>) -> Reading<T> {
        self.tell(value.span(), format!("found {}, expected {wanted}", found(value)), EVERY_KEY.to_owned());
        Err(instead)
    }

    /// A list of so many values where others are wanted.
    ///
    /// # Errors
    /// Always.
    pub fn wrong_length<T>(
        &mut self,
        value: &Written<'_>,
        count: usize,
        wanted: &str,
        instead: Option<T>,
    ) -> Reading<T> {
        let values = if count == 1 { "value" } else { "values" };
        self.tell(value.span(), format!("found {count} {values}, expected {wanted}"), EVERY_KEY.to_owned());
        Err(instead)
    }

    /// One of several words.
    ///
    /// # Errors
    /// With the word that was meant, or the first.
    pub fn word<T: Copy>(&mut self, value: &Written<'_>, words: &[(&str, T)]) -> Reading<T> {
        let names: Vec<&str> = words.iter().map(|(name, _)| *name).collect();
        let of = |name: &str| words.iter().find(|(word, _)| *word == name).map(|(_, meaning)| *meaning);
        let DeValue::String(text) = value.get_ref() else {
            return self.wrong(value, expected(&names).trim_start_matches("expected "), None);
        };
        if let Some(meaning) = of(text) {
            return Ok(meaning);
        }
        let meant = near_miss(text, &names);
        self.unknown(value.span(), &format!("unknown name `{}`", shortened(text)), &names, meant);
        Err(of(meant.unwrap_or(names[0])))
    }

    fn unknown(&mut self, span: Span<usize>, what: &str, names: &[&str], meant: Option<&str>) {
        let help = meant.map_or_else(|| EVERY_KEY.to_owned(), |meant| format!("did you mean `{meant}`?"));
        self.tell(span, format!("{what}, {}", expected(names)), help);
    }

    /// Reads what stands a step farther inside.
    fn inside<T>(&mut self, step: std::fmt::Arguments<'_>, read: impl FnOnce(&mut Self) -> T) -> T {
        let length = self.place.len();
        let _ = self.place.write_fmt(step);
        let found = read(self);
        self.place.truncate(length);
        found
    }

    /// Reads the entries of a list. Of wrong entries that something can stand in for, one is told, and all are replaced.
    ///
    /// # Errors
    /// When an entry is wrong.
    pub fn entries<T: Read>(&mut self, entries: &[Written<'_>]) -> Reading<Vec<T>> {
        let mut list = Vec::with_capacity(entries.len());
        for (index, entry) in entries.iter().enumerate() {
            match self.inside(format_args!("[{index}]"), |reader| T::read(entry, reader)) {
                Ok(read) => list.push(read),
                Err(_) if T::stand_in().is_some() => {
                    return Err(entries.iter().map(|_| T::stand_in()).collect());
                }
                Err(_) if !T::fits(entry) => return Err(None),
                Err(_) => {}
            }
        }
        if list.len() == entries.len() { Ok(list) } else { Err(None) }
    }
}

/// A table while it is read.
pub struct TableReader<'v, 'd> {
    span: Span<usize>,
    /// What is given, by the key that it is or was meant to be; with the place of the whole entry.
    entries: BTreeMap<&'static str, (Span<usize>, &'v Written<'d>)>,
}

impl<'v, 'd> TableReader<'v, 'd> {
    /// Opens a table and tells of keys that it does not have; `None` of what is no table.
    pub fn open(value: &'v Written<'d>, keys: &[&'static str], reader: &mut Reader) -> Option<Self> {
        let DeValue::Table(table) = value.get_ref() else {
            return reader.wrong::<Self>(value, "a table", None).ok();
        };
        let mut entries = BTreeMap::new();
        let place =
            |key: &Spanned<_>, value: &Written<'_>| key.span().start..value.span().end.max(key.span().end);
        for key in keys {
            if let Some((name, value)) = table.get_key_value(*key) {
                entries.insert(*key, (place(name, value), value));
            }
        }
        for (name, entry) in table.iter().filter(|(name, _)| !keys.contains(&name.get_ref().as_ref())) {
            let meant = near_miss(name.get_ref(), keys);
            reader.unknown(name.span(), &format!("unknown key `{}`", shortened(name.get_ref())), keys, meant);
            let place = place(name, entry);
            let free =
                meant.and_then(|meant| keys.iter().find(|key| **key == meant && !entries.contains_key(*key)));
            let table = free.is_none().then(|| value.span());
            let key = format!("{}.{}", reader.place, name.get_ref());
            reader.refused.push(Refused { key, entry: place.clone(), table, is_lost: free.is_none() });
            if let Some(key) = free {
                entries.insert(*key, (place, entry));
            }
        }
        Some(Self { span: value.span(), entries })
    }

    /// The value of a key that may be left out.
    pub fn optional<T: Read>(&self, key: &str, range: Option<Range>, reader: &mut Reader) -> Option<T> {
        let (entry, value) = self.entries.get(key)?;
        let dot = if reader.place.is_empty() { "" } else { "." };
        reader.inside(format_args!("{dot}{key}"), |reader| {
            reader.places.insert(reader.place.clone(), value.span());
            let read = T::read(value, reader).and_then(|read| {
                let out = range.filter(|range| !read.numbers().iter().all(|number| range.holds(*number)));
                let Some(out) = out else { return Ok(read) };
                let message = format!("{} = {}: {}", reader.place, read.shown(), out.words);
                reader.tell(value.span(), message, out.help.to_owned());
                Err(T::stand_in())
            });
            read.map_or_else(
                |instead| {
                    let (key, table) = (reader.place.clone(), Some(self.span.clone()));
                    let is_lost = instead.is_none();
                    reader.refused.push(Refused { key, entry: entry.clone(), table, is_lost });
                    instead
                },
                Some,
            )
        })
    }

    /// The value of a key that must be given.
    pub fn required<T: Read>(&self, key: &str, range: Option<Range>, reader: &mut Reader) -> Option<T> {
        // What another mistake took away is not missed; but a whole table at the top is.
        let takes = |refused: &Refused| refused.is_lost && refused.table.as_ref() == Some(&self.span);
        let is_missed = reader.place.is_empty() || !reader.refused.iter().any(takes);
        if !self.entries.contains_key(key) && is_missed {
            reader.tell(self.span.clone(), format!("missing key `{key}`"), EVERY_KEY.to_owned());
        }
        self.optional(key, range, reader)
    }
}

/// What is a table: its keys, and how it is made of them. `#[derive(Table)]` says both.
pub trait Keys: Sized {
    /// The keys, as messages list them.
    fn keys() -> Vec<&'static str>;

    /// What an opened table holds; `None` where a key that must be given is not there.
    fn read_keys(table: &TableReader<'_, '_>, reader: &mut Reader) -> Option<Self>;

    /// The first number that lies outside of its range: its key, and what is wrong.
    fn key_fault(&self) -> Option<(String, String)> {
        None
    }
}

impl<T: Keys> Read for T {
    const EXPECTED: &'static str = "a table";

    fn fits(value: &Written<'_>) -> bool {
        matches!(value.get_ref(), DeValue::Table(_))
    }

    fn read(value: &Written<'_>, reader: &mut Reader) -> Reading<Self> {
        let table = TableReader::open(value, &Self::keys(), reader).ok_or(None)?;
        Self::read_keys(&table, reader).ok_or(None)
    }

    fn fault(&self) -> Option<(String, String)> {
        self.key_fault()
    }
}

/// Whether a text is one of several words.
pub fn is_word(value: &Written<'_>, words: &[&str]) -> bool {
    matches!(value.get_ref(), DeValue::String(text) if words.contains(&text.as_ref()))
}

#[cfg(test)]
mod tests;
