//! In which units the numbers of a sweep are told.

use fret_core::model::Dimension;
use fret_core::units::Units;
use toml::{Table, Value};

use crate::figures::typed;
use crate::sweep::Question;
use crate::sweep::columns::SummaryColumn;
use crate::sweep::kinds::kind_of;

/// In which units the numbers of a sweep are told.
pub struct Setting {
    /// Those that all cases declare.
    pub units: Option<Units>,
    /// Of the contacts.
    pub dimension: Dimension,
}

impl Setting {
    /// Those of its cases, where all declare the same and have the same kind of contact.
    pub fn of(question: &Question) -> Self {
        let mut all = question.points.iter().map(|point| point.case_file.text.parse::<Table>().ok());
        let of = |table: Option<Table>| {
            let table = table.unwrap_or_default();
            (units_of(&table), dimension_of(&table))
        };
        let first = all.next().map_or((None, Dimension::Plane), of);
        let changes = |key: &str| question.keys.iter().any(|changed| changed.starts_with(key));
        let alike = !changes("units") && !changes("grid.cells") || all.all(|other| of(other) == first);
        Self { units: first.0.filter(|_| alike), dimension: first.1 }
    }

    /// The head of a column of the summary.
    pub fn heading(&self, column: &SummaryColumn) -> String {
        Units::heading(self.units.as_ref(), &column.name, &column.kind, self.dimension)
    }

    /// The head of a column of values of a key.
    pub fn heading_of_key(&self, key: &str) -> String {
        Units::heading(self.units.as_ref(), key, kind_of(key).unwrap_or(""), self.dimension)
    }

    /// Values of keys in words, a number with its unit.
    pub fn place<'a>(&self, values: impl IntoIterator<Item = (&'a String, &'a Value)>) -> String {
        let one = |(key, value): (&String, &Value)| {
            let number = value.as_float().or_else(|| Some(value.as_integer()? as f64));
            let unit = || Units::after(self.units.as_ref(), kind_of(key).unwrap_or(""), self.dimension);
            let words = number.map_or_else(|| value.to_string(), |number| typed(number) + &unit());
            format!("{key} = {words}")
        };
        values.into_iter().map(one).collect::<Vec<_>>().join(", ")
    }
}

/// Units that a case declares.
fn units_of(table: &Table) -> Option<Units> {
    let units = table.get("units")?;
    Some(Units::new(units.get("length")?.as_str()?, units.get("force")?.as_str()?))
}

/// Of a line contact the cells of a case are those of one row, or told by one number.
fn dimension_of(table: &Table) -> Dimension {
    Dimension::from(match table.get("grid").and_then(|grid| grid.get("cells")) {
        Some(Value::Array(cells)) => cells.get(1).and_then(Value::as_integer) == Some(1),
        Some(cells) => cells.is_integer(),
        None => false,
    })
}
