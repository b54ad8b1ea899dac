//! Surfaces and friction as they are written in a case file: unchecked, with the place of every value. The doc comments here
//! are the schema's descriptions.

use std::borrow::Cow;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;
use serde::de::{self, MapAccess, SeqAccess, Visitor};
use toml::Spanned;

use super::evolution_file::EvolutionFile;

/// Shape of the undeformed gap, or of one body; the sum when several are given.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct ProfileFile {
    /// A sphere, as the paraboloid r^2 / (2 R).
    #[schemars(with = "Option<SphereFile>")]
    pub sphere: Option<Spanned<SphereFile>>,
    /// A paraboloid with two radii of curvature.
    #[schemars(with = "Option<EllipsoidFile>")]
    pub ellipsoid: Option<Spanned<EllipsoidFile>>,
    /// A cylinder, as the parabola s^2 / (2 R) across its axis.
    #[schemars(with = "Option<CylinderFile>")]
    pub cylinder: Option<Spanned<CylinderFile>>,
    /// A flat punch with a rounded edge: flat within b, (r - b)^2 / (2 R) beyond.
    #[schemars(with = "Option<RoundedPunchFile>")]
    pub rounded_punch: Option<Spanned<RoundedPunchFile>>,
    /// A flat circular punch.
    #[schemars(with = "Option<FlatPunchFile>")]
    pub flat_punch: Option<Spanned<FlatPunchFile>>,
    /// A blunt cone, slope r.
    #[schemars(with = "Option<ConeFile>")]
    pub cone: Option<Spanned<ConeFile>>,
    /// A sinusoidal surface amplitude (1 - cos(2 pi x / Lx) cos(2 pi y / Ly)).
    #[schemars(with = "Option<WaveFile>")]
    pub wave: Option<Spanned<WaveFile>>,
    /// Measured or synthetic topography, one height per cell.
    #[schemars(with = "Option<HeightsFile>")]
    pub heights: Option<Spanned<HeightsFile>>,
}

/// A sphere.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct SphereFile {
    /// Radius [length], positive; in a body's own profile negative for a hollow.
    #[schemars(with = "f64")]
    pub radius: Spanned<f64>,
}

/// An ellipsoid.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct EllipsoidFile {
    /// Radius of curvature in the x-z plane [length], positive; in a body's own profile negative for a hollow.
    #[schemars(with = "f64")]
    pub radius_x: Spanned<f64>,
    /// Radius of curvature in the y-z plane [length], positive; in a body's own profile negative for a hollow.
    #[schemars(with = "f64")]
    pub radius_y: Spanned<f64>,
}

/// A cylinder.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct CylinderFile {
    /// Radius [length], positive; in a body's own profile negative for a groove.
    #[schemars(with = "f64")]
    pub radius: Spanned<f64>,
    /// Direction of its axis.
    pub axis: AxisFile,
    /// Length along the axis [length], positive, with square ends. Default: infinite.
    #[schemars(with = "Option<f64>")]
    pub length: Option<Spanned<f64>>,
}

/// A direction in the surface.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(super) enum AxisFile {
    /// Along x.
    X,
    /// Along y.
    Y,
}

/// A flat punch with a rounded edge.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct RoundedPunchFile {
    /// Radius of the flat [length], positive.
    #[schemars(with = "f64")]
    pub flat_radius: Spanned<f64>,
    /// Radius of the rounding [length], positive.
    #[schemars(with = "f64")]
    pub edge_radius: Spanned<f64>,
}

/// A flat circular punch.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct FlatPunchFile {
    /// Radius [length], positive; no body beyond it.
    #[schemars(with = "f64")]
    pub radius: Spanned<f64>,
}

/// A blunt cone.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct ConeFile {
    /// Slope of its side against the surface, positive: the tangent of the angle between them.
    #[schemars(with = "f64")]
    pub slope: Spanned<f64>,
}

/// A sinusoidal surface.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct WaveFile {
    /// Half of the height from valley to crest [length], positive.
    #[schemars(with = "f64")]
    pub amplitude: Spanned<f64>,
    /// Wavelength along x [length]. Default: constant along x.
    #[schemars(with = "Option<f64>")]
    pub wavelength_x: Option<Spanned<f64>>,
    /// Wavelength along y [length]. Default: constant along y.
    #[schemars(with = "Option<f64>")]
    pub wavelength_y: Option<Spanned<f64>>,
}

/// Topography, one height per cell: `file` or `values`.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct HeightsFile {
    /// A .npy file, or a text file with one row of numbers per line or one point x, y, height. Relative paths start at the case file.
    #[schemars(with = "Option<String>")]
    pub file: Option<Spanned<String>>,
    /// The heights themselves, as rows of numbers, or in a line contact numbers; from Python an array.
    #[schemars(with = "Option<ArrayFile>")]
    pub values: Option<Spanned<ArrayFile>>,
    /// Length of one unit of the heights, in the case's unit of length. Default: 1.
    #[schemars(with = "Option<f64>")]
    pub unit: Option<Spanned<f64>>,
    /// What the heights describe: a "surface" (the highest point touches first) or the "gap" (the lowest does). Default: "surface".
    #[schemars(with = "Option<OfFile>")]
    pub of: Option<Spanned<OfFile>>,
    /// What is subtracted: "none", the "mean", or the least-squares "plane". Default: "none".
    pub detrend: Option<DetrendFile>,
    /// Axis along which the rows follow one another: "x" (index [i, j] = [x, y]) or "y" (rows of an image). Default: "x".
    pub rows: Option<AxisFile>,
}

/// What heights describe.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(super) enum OfFile {
    /// A surface, positive towards the other body: the highest point touches first.
    Surface,
    /// The gap between the bodies: the lowest point touches first.
    Gap,
}

/// What is subtracted from heights.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(super) enum DetrendFile {
    /// Nothing.
    None,
    /// Their mean.
    Mean,
    /// The least-squares plane.
    Plane,
}

/// Coulomb's law of friction, with a shear strength of the interface where it has one.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct FrictionFile {
    /// Coefficient, zero or positive.
    #[schemars(with = "Option<f64>")]
    pub coefficient: Option<Spanned<f64>>,
    /// One coefficient per cell: a .npy or text file, rows of numbers, or from Python an array; index [i, j] = [x, y].
    #[schemars(with = "Option<MapFile>")]
    pub map: Option<Spanned<MapFile>>,
    /// Shear strength of the interface [pressure], zero or positive, a number or one for every cell: shear is at most the smaller of it
    /// and the coefficient times the pressure. Default: none.
    #[schemars(with = "Option<CoefficientFile>")]
    pub max_shear: Option<Spanned<CoefficientFile>>,
    /// Friction that evolves: how the coefficient of each cell follows what slip has done to it. Default: it stays.
    #[schemars(with = "Option<EvolutionFile>")]
    pub evolution: Option<Spanned<EvolutionFile>>,
}

/// An array: rows of numbers, or the number of an array handed over beside the case.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum ArrayFile {
    Rows(Vec<Vec<f64>>),
    Handed(usize),
}

/// A coefficient for every cell: the name of a file, or an array.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum MapFile {
    File(String),
    Array(ArrayFile),
}

/// Friction from a stage on: one coefficient, or one for every cell.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum CoefficientFile {
    Uniform(f64),
    Map(MapFile),
}

impl<'de> Deserialize<'de> for ArrayFile {
    fn deserialize<D: de::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        match deserializer.deserialize_any(Anything { words: "rows of numbers" })? {
            Found::Array(array) => Ok(array),
            Found::Number(value) => Err(wrong(de::Unexpected::Float(value), "rows of numbers")),
            Found::Word(word) => Err(wrong(de::Unexpected::Str(&word), "rows of numbers")),
        }
    }
}

impl<'de> Deserialize<'de> for MapFile {
    fn deserialize<D: de::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        const WORDS: &str = "the name of a file or rows of numbers";
        match deserializer.deserialize_any(Anything { words: WORDS })? {
            Found::Array(array) => Ok(Self::Array(array)),
            Found::Number(value) => Err(wrong(de::Unexpected::Float(value), WORDS)),
            Found::Word(word) => Ok(Self::File(word)),
        }
    }
}

impl<'de> Deserialize<'de> for CoefficientFile {
    fn deserialize<D: de::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let found = deserializer
            .deserialize_any(Anything { words: "a coefficient, the name of a file, or rows of numbers" })?;
        Ok(match found {
            Found::Array(array) => Self::Map(MapFile::Array(array)),
            Found::Number(value) => Self::Uniform(value),
            Found::Word(word) => Self::Map(MapFile::File(word)),
        })
    }
}

fn wrong<E: de::Error>(found: de::Unexpected<'_>, expected: &str) -> E {
    E::invalid_type(found, &expected)
}

/// A row of numbers; a number alone is a row of one.
struct Row(Vec<f64>);

impl<'de> Deserialize<'de> for Row {
    fn deserialize<D: de::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct InRow;

        impl<'de> Visitor<'de> for InRow {
            type Value = Row;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("a row of numbers, or in a line contact a number")
            }

            fn visit_f64<E: de::Error>(self, value: f64) -> Result<Row, E> {
                Ok(Row(vec![value]))
            }

            fn visit_i64<E: de::Error>(self, value: i64) -> Result<Row, E> {
                Ok(Row(vec![value as f64]))
            }

            fn visit_seq<A: SeqAccess<'de>>(self, row: A) -> Result<Row, A::Error> {
                Vec::deserialize(de::value::SeqAccessDeserializer::new(row)).map(Row)
            }
        }

        deserializer.deserialize_any(InRow)
    }
}

/// What can stand where an array is expected.
enum Found {
    Number(f64),
    Word(String),
    Array(ArrayFile),
}

struct Anything {
    words: &'static str,
}

impl<'de> Visitor<'de> for Anything {
    type Value = Found;

    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str(self.words)
    }

    fn visit_f64<E: de::Error>(self, value: f64) -> Result<Found, E> {
        Ok(Found::Number(value))
    }

    fn visit_i64<E: de::Error>(self, value: i64) -> Result<Found, E> {
        Ok(Found::Number(value as f64))
    }

    fn visit_str<E: de::Error>(self, word: &str) -> Result<Found, E> {
        Ok(Found::Word(word.to_owned()))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut sequence: A) -> Result<Found, A::Error> {
        let mut rows = Vec::new();
        while let Some(Row(row)) = sequence.next_element()? {
            rows.push(row);
        }
        Ok(Found::Array(ArrayFile::Rows(rows)))
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Found, A::Error> {
        /// What an array handed over beside the case is replaced by.
        #[derive(Deserialize)]
        #[serde(deny_unknown_fields)]
        struct Handed {
            array: usize,
        }
        let handed = Handed::deserialize(de::value::MapAccessDeserializer::new(map))?;
        Ok(Found::Array(ArrayFile::Handed(handed.array)))
    }
}

fn rows_schema() -> Schema {
    let row = json_schema!({ "type": "array", "items": { "type": "number" } });
    json_schema!({ "type": "array", "items": { "anyOf": [row, { "type": "number" }] } })
}

impl JsonSchema for ArrayFile {
    fn schema_name() -> Cow<'static, str> {
        "ArrayFile".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        rows_schema()
    }
}

impl JsonSchema for MapFile {
    fn schema_name() -> Cow<'static, str> {
        "MapFile".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "anyOf": [{ "type": "string" }, rows_schema()] })
    }
}

impl JsonSchema for CoefficientFile {
    fn schema_name() -> Cow<'static, str> {
        "CoefficientFile".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "anyOf": [{ "type": "number" }, { "type": "string" }, rows_schema()] })
    }
}
