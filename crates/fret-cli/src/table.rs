//! An answer as a table: a column is said once, and a file (CSV), a person and a page (`report::html::grid`) read it, each by one function.

use std::borrow::{Borrow, Cow};

use fret_core::model::Dimension;
use fret_core::units::Units;

use crate::figures::{bounded, figure_in};

/// What stands in a column of a row.
#[derive(Debug)]
pub enum Cell {
    /// A number, in files in as few digits as say it exactly.
    Number(f64),
    /// The same with the kind of its own unit, where a column has numbers of several kinds.
    Of(f64, &'static str),
    /// A word or a count; nothing where it is empty.
    Word(String),
}

impl From<f64> for Cell {
    fn from(value: f64) -> Self {
        Self::Number(value)
    }
}

impl<T: Into<Self>> From<Option<T>> for Cell {
    fn from(value: Option<T>) -> Self {
        value.map_or_else(|| Self::Word(String::new()), T::into)
    }
}

impl From<usize> for Cell {
    fn from(count: usize) -> Self {
        Self::Word(count.to_string())
    }
}

impl From<&str> for Cell {
    fn from(word: &str) -> Self {
        Self::Word(word.to_owned())
    }
}

impl From<String> for Cell {
    fn from(word: String) -> Self {
        Self::Word(word)
    }
}

/// A column.
struct Column<'a, R> {
    name: Cow<'a, str>,
    kind: &'a str,
    of: Box<dyn Fn(&R) -> Cell + 'a>,
}

/// The columns of a table whose rows are so.
pub struct Columns<'a, R>(Vec<Column<'a, R>>);

impl<'a, R> Columns<'a, R> {
    /// None yet.
    pub fn new() -> Self {
        Self(Vec::new())
    }

    /// These and one more: its name, the kind of its unit, such as `force x length` (empty where it has none), and its value in a row.
    pub fn column<C: Into<Cell>>(
        mut self,
        name: impl Into<Cow<'a, str>>,
        kind: &'a str,
        of: impl Fn(&R) -> C + 'a,
    ) -> Self {
        self.0.push(Column { name: name.into(), kind, of: Box::new(move |row| of(row).into()) });
        self
    }

    /// Their names.
    pub fn names(&self) -> Vec<&str> {
        self.0.iter().map(|column| &*column.name).collect()
    }

    /// The cells of a row, numbers as `number` prints them beside the kind of their unit.
    pub fn cells(&self, row: &R, number: impl Fn(&Cell, f64, &str) -> String) -> Vec<String> {
        let cell = |column: &Column<'a, R>| match (column.of)(row) {
            Cell::Word(word) => word,
            cell @ Cell::Number(value) => number(&cell, value, column.kind),
            cell @ Cell::Of(value, kind) => number(&cell, value, kind),
        };
        self.0.iter().map(cell).collect()
    }

    /// Their names, with the units of the case, where it declares units.
    fn heads(&self, units: Option<&Units>) -> Vec<String> {
        let head =
            |column: &Column<'_, R>| Units::heading(units, &column.name, column.kind, Dimension::Plane);
        self.0.iter().map(head).collect()
    }

    /// The text of a file.
    pub fn csv<B: Borrow<R>>(&self, units: Option<&Units>, rows: impl IntoIterator<Item = B>) -> String {
        let cells = |row: B| self.cells(row.borrow(), |_, value, _| format!("{value:e}"));
        let lines = std::iter::once(self.heads(units)).chain(rows.into_iter().map(cells));
        lines.map(|cells| cells.join(",") + "\n").collect()
    }

    /// What a person reads, a line a row below the head; columns are so many letters wide, the last ones as wide as they are.
    pub fn text<B: Borrow<R>>(
        &self,
        widths: &[usize],
        units: Option<&Units>,
        rows: impl IntoIterator<Item = B>,
    ) -> String {
        let number = |cell: &Cell, value: f64, kind: &str| match cell {
            Cell::Of(..) => figure_in(units, value, kind),
            _ => bounded(value),
        };
        let cells = |row: B| self.cells(row.borrow(), number);
        let line = |cells: Vec<String>| {
            let widths = widths.iter().copied().chain(std::iter::repeat(0));
            let line: Vec<String> =
                cells.iter().zip(widths).map(|(cell, width)| format!("{cell:<width$}")).collect();
            line.join(" ").trim_end().to_owned() + "\n"
        };
        std::iter::once(self.heads(units)).chain(rows.into_iter().map(cells)).map(line).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read_back_as_they_were() {
        let units = Units::new("mm", "N");
        let columns = Columns::<(f64, usize, Option<f64>)>::new()
            .column("x", "length", |row| row.0)
            .column("layer", "", |row| row.1)
            .column("life", "", |row| row.2);
        let rows = [(0.1 + 0.2, 3, None), (-1e-300, 0, Some(f64::INFINITY))];
        let file = columns.csv(Some(&units), rows);
        assert_eq!(file, "x [mm],layer,life\n3.0000000000000004e-1,3,\n-1e-300,0,inf\n");
        let read = columns.text(&[10, 7], Some(&units), rows);
        assert_eq!(read, "x [mm]     layer   life\n0.30000    3\n-1.0000e-300 0       unlimited\n");
    }
}
