//! A value and its place.

use std::borrow::Cow;
use std::ops::{Deref, Range};

use schemars::{JsonSchema, Schema, SchemaGenerator};

use super::reader::{NOWHERE, Read, Reader, Reading, Written};

/// A value, and the bytes of the text that it stands at.
#[derive(Debug, Clone, PartialEq)]
pub struct At<T> {
    /// The value.
    pub value: T,
    span: Range<usize>,
}

impl<T> At<T> {
    /// A value at a place.
    pub fn new(value: T, span: Range<usize>) -> Self {
        Self { value, span }
    }

    /// Bytes of the text that it stands at.
    pub fn span(&self) -> Range<usize> {
        self.span.clone()
    }
}

impl<T> Deref for At<T> {
    type Target = T;

    fn deref(&self) -> &T {
        &self.value
    }
}

impl<T: Read> Read for At<T> {
    const EXPECTED: &'static str = T::EXPECTED;

    fn fits(value: &Written<'_>) -> bool {
        T::fits(value)
    }

    fn read(value: &Written<'_>, reader: &mut Reader) -> Reading<Self> {
        let at = |read| Self::new(read, value.span());
        T::read(value, reader).map(at).map_err(|instead| instead.map(at))
    }

    fn stand_in() -> Option<Self> {
        T::stand_in().map(|value| Self::new(value, NOWHERE))
    }

    fn numbers(&self) -> Vec<f64> {
        self.value.numbers()
    }

    fn shown(&self) -> String {
        self.value.shown()
    }
}

/// The schema is that of the value.
impl<T: JsonSchema> JsonSchema for At<T> {
    fn inline_schema() -> bool {
        T::inline_schema()
    }

    fn schema_name() -> Cow<'static, str> {
        T::schema_name()
    }

    fn schema_id() -> Cow<'static, str> {
        T::schema_id()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        T::json_schema(generator)
    }
}
