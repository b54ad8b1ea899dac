//! Values that stand in documents: numbers, words, lists.

use std::borrow::Cow;
use std::collections::BTreeMap;

use schemars::{JsonSchema, Schema, SchemaGenerator};
use toml::de::DeValue;

use super::at::At;
use super::reader::{Read, Reader, Reading, Written};

/// A number that is no larger than numbers can be.
fn number(value: &Written<'_>) -> Option<f64> {
    match value.get_ref() {
        DeValue::Integer(whole) => {
            i64::from_str_radix(whole.as_str(), whole.radix()).ok().map(|whole| whole as f64)
        }
        DeValue::Float(text) => text
            .as_str()
            .parse()
            .ok()
            .filter(|number: &f64| number.is_finite() || !text.as_str().contains(['e', 'E'])),
        _ => None,
    }
}

fn whole_number(value: &Written<'_>) -> Option<usize> {
    let DeValue::Integer(whole) = value.get_ref() else { return None };
    usize::from_str_radix(whole.as_str(), whole.radix()).ok()
}

impl Read for f64 {
    const EXPECTED: &'static str = "a number";

    fn fits(value: &Written<'_>) -> bool {
        number(value).is_some()
    }

    fn read(value: &Written<'_>, reader: &mut Reader) -> Reading<Self> {
        number(value).map_or_else(|| reader.wrong(value, Self::EXPECTED, Self::stand_in()), Ok)
    }

    fn stand_in() -> Option<Self> {
        Some(0.3)
    }

    fn numbers(&self) -> Vec<f64> {
        vec![*self]
    }

    fn shown(&self) -> String {
        format!("{self:?}")
    }
}

impl Read for usize {
    const EXPECTED: &'static str = "a whole number, 0 or more";

    fn fits(value: &Written<'_>) -> bool {
        whole_number(value).is_some()
    }

    fn read(value: &Written<'_>, reader: &mut Reader) -> Reading<Self> {
        whole_number(value).map_or_else(|| reader.wrong(value, Self::EXPECTED, Self::stand_in()), Ok)
    }

    fn stand_in() -> Option<Self> {
        Some(4)
    }

    fn numbers(&self) -> Vec<f64> {
        vec![*self as f64]
    }

    fn shown(&self) -> String {
        self.to_string()
    }
}

impl Read for bool {
    const EXPECTED: &'static str = "true or false";

    fn fits(value: &Written<'_>) -> bool {
        matches!(value.get_ref(), DeValue::Boolean(_))
    }

    fn read(value: &Written<'_>, reader: &mut Reader) -> Reading<Self> {
        match value.get_ref() {
            DeValue::Boolean(is) => Ok(*is),
            _ => reader.wrong(value, Self::EXPECTED, Self::stand_in()),
        }
    }

    fn stand_in() -> Option<Self> {
        Some(false)
    }
}

impl Read for String {
    const EXPECTED: &'static str = "a text in quotes";

    fn fits(value: &Written<'_>) -> bool {
        matches!(value.get_ref(), DeValue::String(_))
    }

    fn read(value: &Written<'_>, reader: &mut Reader) -> Reading<Self> {
        match value.get_ref() {
            DeValue::String(text) => Ok(text.clone().into_owned()),
            _ => reader.wrong(value, Self::EXPECTED, Self::stand_in()),
        }
    }

    fn stand_in() -> Option<Self> {
        Some(Self::new())
    }
}

impl<T: Read> Read for Vec<T> {
    const EXPECTED: &'static str = "a list";

    fn fits(value: &Written<'_>) -> bool {
        matches!(value.get_ref(), DeValue::Array(_))
    }

    fn read(value: &Written<'_>, reader: &mut Reader) -> Reading<Self> {
        match value.get_ref() {
            DeValue::Array(entries) => reader.entries(entries),
            _ => reader.wrong(value, Self::EXPECTED, None),
        }
    }

    fn numbers(&self) -> Vec<f64> {
        self.iter().flat_map(T::numbers).collect()
    }

    fn shown(&self) -> String {
        format!("[{}]", self.iter().map(T::shown).collect::<Vec<_>>().join(", "))
    }
}

/// A list of exactly two: no fewer, and no third one that nobody would read.
impl<T: Read> Read for [T; 2] {
    const EXPECTED: &'static str = "a list of two values";

    fn fits(value: &Written<'_>) -> bool {
        matches!(value.get_ref(), DeValue::Array(_))
    }

    fn read(value: &Written<'_>, reader: &mut Reader) -> Reading<Self> {
        let pair = |list: Vec<T>| <[T; 2]>::try_from(list).ok();
        let DeValue::Array(entries) = value.get_ref() else {
            return reader.wrong(value, Self::EXPECTED, Self::stand_in());
        };
        match reader.entries(entries) {
            Ok(list) => pair(list).map_or_else(
                || reader.wrong_length(value, entries.len(), Self::EXPECTED, Self::stand_in()),
                Ok,
            ),
            Err(_) => Err(Self::stand_in()),
        }
    }

    fn stand_in() -> Option<Self> {
        Some([T::stand_in()?, T::stand_in()?])
    }

    fn numbers(&self) -> Vec<f64> {
        self.iter().flat_map(T::numbers).collect()
    }

    fn shown(&self) -> String {
        format!("[{}]", self.iter().map(T::shown).collect::<Vec<_>>().join(", "))
    }
}

/// A table of texts, or other values of one kind, whose keys are its author's.
#[derive(Debug, Clone, PartialEq)]
pub struct Named<T = String>(pub Vec<(At<String>, At<T>)>);

impl<T: Read> Read for Named<T> {
    const EXPECTED: &'static str = "a table";

    fn fits(value: &Written<'_>) -> bool {
        matches!(value.get_ref(), DeValue::Table(_))
    }

    fn read(value: &Written<'_>, reader: &mut Reader) -> Reading<Self> {
        let DeValue::Table(table) = value.get_ref() else {
            return reader.wrong(value, Self::EXPECTED, None);
        };
        let mut all = Vec::new();
        for (key, value) in table {
            if let Ok(value) = At::read(value, reader) {
                all.push((At::new(key.get_ref().clone().into_owned(), key.span()), value));
            }
        }
        if all.len() == table.len() { Ok(Self(all)) } else { Err(None) }
    }
}

impl<T: JsonSchema> JsonSchema for Named<T> {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "Named".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        BTreeMap::<String, T>::json_schema(generator)
    }
}
