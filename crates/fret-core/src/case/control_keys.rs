//! The keys of the controls in a stage and in its `phase`: those of the table in `model/controls.rs`.

use std::ops::Range;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde_json::{Map, Value};

use crate::document::{At, Keys, Read, Reader, Table, TableReader};
pub(super) use crate::model::controls::LARGEST;
use crate::model::controls::{ControlRow, Form, Way, ways};

/// What stays as it was.
#[derive(Debug, Clone, Copy, PartialEq, Table, JsonSchema)]
#[schemars(rename_all = "lowercase", description = "")]
pub(super) enum HeldWord {
    Held,
}

/// A number for one axis, or the word "held".
#[derive(Debug, Clone, Copy, PartialEq, Table, JsonSchema)]
#[expected("a number or \"held\"")]
#[schemars(untagged, rename = "AxisSchema", description = "")]
pub(super) enum AxisFile {
    Value(f64),
    Held(HeldWord),
}

/// Values along x and y that may be held; in a line contact one number.
#[derive(Debug, Clone, Copy, PartialEq, Table, JsonSchema)]
#[expected("two values [x, y], or one number in a line contact")]
#[schemars(untagged, rename = "AlongSchema", description = "")]
pub(super) enum AlongFile {
    Both([AxisFile; 2]),
    Line(f64),
}

/// The word for what rolls until nothing changes any more.
#[derive(Debug, Clone, Copy, PartialEq, Table, JsonSchema)]
#[schemars(rename_all = "lowercase", description = "")]
pub(super) enum SteadyRoll {
    Steady,
}

/// Values along x and y that may be held; in a line contact one number; or the word "steady".
#[derive(Debug, Clone, Copy, PartialEq, Table, JsonSchema)]
#[expected("two values [x, y], one number in a line contact, or \"steady\"")]
#[schemars(untagged, rename = "RollSchema", description = "")]
pub(super) enum RollFile {
    Both([AxisFile; 2]),
    Line(f64),
    Steady(SteadyRoll),
}

/// Two numbers along x and y; one where both are alike, or in a line contact.
#[derive(Debug, Clone, Copy, PartialEq, Table, JsonSchema)]
#[expected("two values [x, y], or one number in a line contact")]
#[schemars(untagged, rename = "AlongPhaseSchema", description = "")]
pub(super) enum BothOrOne {
    Both([f64; 2]),
    Line(f64),
}

/// What stands at the key of a control: one number, or one along each axis; `None` where it is held; nothing at all where it is "steady".
pub(super) struct Given {
    pub row: &'static ControlRow,
    pub way: &'static Way,
    pub values: Vec<Option<f64>>,
    pub span: Range<usize>,
}

impl Given {
    pub fn span(&self) -> Range<usize> {
        self.span.clone()
    }
}

/// The controls of a stage.
pub(super) struct ControlKeys(pub Vec<Given>);

/// Their phases [degrees].
pub(super) struct PhaseKeys(pub Vec<Given>);

impl ControlKeys {
    /// What stands at a key.
    pub fn of(&self, name: &str) -> Option<&Given> {
        self.0.iter().find(|given| given.way.name == name)
    }

    /// Where it stands.
    pub fn span_of(&self, name: &str) -> Option<Range<usize>> {
        self.of(name).map(Given::span)
    }

    /// Whether the contact is to roll until nothing changes any more.
    pub fn are_steady(&self) -> bool {
        self.of("roll").is_some_and(|roll| roll.values.is_empty())
    }

    /// Where the first control of some degrees of freedom stands.
    pub fn place(&self, freedoms: Range<usize>) -> Option<Range<usize>> {
        self.0.iter().find(|given| freedoms.contains(&given.row.freedom)).map(Given::span)
    }
}

impl RollFile {
    fn values(self) -> Vec<Option<f64>> {
        match self {
            Self::Both(both) => both.map(Into::into).to_vec(),
            Self::Line(one) => vec![Some(one)],
            Self::Steady(SteadyRoll::Steady) => Vec::new(),
        }
    }
}

impl BothOrOne {
    fn values(self) -> Vec<Option<f64>> {
        match self {
            Self::Both(both) => both.map(Some).to_vec(),
            Self::Line(one) => vec![Some(one)],
        }
    }
}

impl From<AxisFile> for Option<f64> {
    fn from(axis: AxisFile) -> Self {
        if let AxisFile::Value(value) = axis { Some(value) } else { None }
    }
}

/// The keys of the table of controls, with what stands for one axis, what for both where one number may do, and their descriptions.
macro_rules! keys {
    ($($keys:ident: $axis:ty, $along:ident, $roll:ty, $about:ident;)*) => {$(
        impl Keys for $keys {
            fn keys() -> Vec<&'static str> {
                ways().map(|(_, way)| way.name).collect()
            }

            fn read_keys(table: &TableReader<'_, '_>, reader: &mut Reader) -> Option<Self> {
                let given = |(row, way): (&'static ControlRow, &'static Way)| {
                    let (values, span) = match row.form {
                        Form::Number => key(way, table, reader, |value: &f64| vec![Some(*value)]),
                        Form::Pair => key(way, table, reader, |pair: &[$axis; 2]| pair.map(Into::into).to_vec()),
                        Form::PairOrNumber => key(way, table, reader, |along: &$along| match along {
                            $along::Both(both) => both.map(Into::into).to_vec(),
                            $along::Line(one) => vec![Some(*one)],
                        }),
                        Form::PairNumberOrSteady => key(way, table, reader, |roll: &$roll| roll.values()),
                    }?;
                    Some(Given { row, way, values, span })
                };
                Some(Self(ways().filter_map(given).collect()))
            }
        }

        impl JsonSchema for $keys {
            fn schema_name() -> std::borrow::Cow<'static, str> {
                stringify!($keys).into()
            }

            fn json_schema(generator: &mut SchemaGenerator) -> Schema {
                let mut properties = Map::new();
                for (row, way) in ways() {
                    let mut schema = match row.form {
                        Form::Number => generator.subschema_for::<Option<f64>>(),
                        Form::Pair => generator.subschema_for::<Option<[$axis; 2]>>(),
                        Form::PairOrNumber => generator.subschema_for::<Option<$along>>(),
                        Form::PairNumberOrSteady => generator.subschema_for::<Option<$roll>>(),
                    };
                    schema.insert("description".to_owned(), way.$about.into());
                    properties.insert(way.name.to_owned(), schema.into());
                }
                json_schema!({ "properties": Value::Object(properties) })
            }
        }
    )*};
}

keys! {
    ControlKeys: AxisFile, AlongFile, RollFile, about;
    PhaseKeys: f64, BothOrOne, BothOrOne, phase;
}

/// What stands at the key of a control, and where.
fn key<T: Read>(
    way: &Way,
    table: &TableReader<'_, '_>,
    reader: &mut Reader,
    values: impl Fn(&T) -> Vec<Option<f64>>,
) -> Option<(Vec<Option<f64>>, Range<usize>)> {
    let given: At<T> = table.optional(way.name, None, reader)?;
    Some((values(&given.value), given.span()))
}
