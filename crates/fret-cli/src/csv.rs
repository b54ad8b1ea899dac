//! A table as a file: rows of numbers and words below a head with the units of the case, where it declares units.

use fret_core::model::Dimension;
use fret_core::units::Units;

/// What stands in a column of a row.
#[derive(Debug)]
pub enum Cell {
    /// A number, in as few digits as say it exactly.
    Number(f64),
    /// A word or a count; nothing where it is empty.
    Word(String),
}

impl From<f64> for Cell {
    fn from(value: f64) -> Self {
        Self::Number(value)
    }
}

impl From<Option<f64>> for Cell {
    fn from(value: Option<f64>) -> Self {
        value.map_or_else(|| Self::Word(String::new()), Self::Number)
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

/// A column: its name, the kind of its unit, its value in a row.
pub type Column<'a, R> = (&'a str, &'a str, &'a dyn Fn(&R) -> Cell);

/// The text of a table.
pub fn csv<R>(units: Option<&Units>, columns: &[Column<'_, R>], rows: impl IntoIterator<Item = R>) -> String {
    let head = columns.iter().map(|(name, kind, _)| Units::heading(units, name, kind, Dimension::Plane));
    let mut text = head.collect::<Vec<_>>().join(",") + "\n";
    for row in rows {
        let cell = |(_, _, of): &Column<'_, R>| match of(&row) {
            Cell::Number(value) => format!("{value:e}"),
            Cell::Word(word) => word,
        };
        text += &(columns.iter().map(cell).collect::<Vec<_>>().join(",") + "\n");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read_back_as_they_were() {
        let units = Units::new("mm", "N");
        let columns: [Column<'_, (f64, usize, Option<f64>)>; 3] = [
            ("x", "length", &|row| row.0.into()),
            ("layer", "", &|row| row.1.into()),
            ("life", "", &|row| row.2.into()),
        ];
        let text = csv(Some(&units), &columns, [(0.1 + 0.2, 3, None), (-1e-300, 0, Some(2.5e6))]);
        assert_eq!(text, "x [mm],layer,life\n3.0000000000000004e-1,3,\n-1e-300,0,2.5e6\n");
    }
}
