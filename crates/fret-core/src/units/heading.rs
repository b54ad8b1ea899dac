//! The head of a column: a name and perhaps a unit.

use super::conversion::is_unit;

/// A name and the unit that stands behind it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Heading {
    /// Name of the column.
    pub name: String,
    /// Its unit, if one is named.
    pub unit: Option<String>,
}

impl Heading {
    /// `Weg [um]`, `Q (N)`, `Q / N` and, of units that are known, `Q_N` are a name and a unit; `None` where a bracket is not closed.
    pub fn of(cell: &str) -> Option<Self> {
        let cell = cell.trim();
        for (open, close) in [('[', ']'), ('(', ')')] {
            if let (Some(from), true) = (cell.rfind(open), cell.ends_with(close)) {
                let unit = cell[from + 1..cell.len() - 1].trim();
                let name = cell[..from].trim().trim_end_matches('_');
                return Some(Self { name: name.to_owned(), unit: Some(unit.to_owned()) });
            }
        }
        if cell.contains(['[', ']']) {
            return None;
        }
        Some(match cell.split_once(" / ") {
            Some((name, unit)) => Self { name: name.trim().to_owned(), unit: Some(unit.trim().to_owned()) },
            None => Self::with_underscore(cell),
        })
    }

    /// What stands behind the last underscore is a unit where it is one that is known, and no number.
    fn with_underscore(cell: &str) -> Self {
        let is_of_letters = |unit: &str| unit.starts_with(char::is_alphabetic) && is_unit(unit);
        match cell.rsplit_once('_').filter(|(name, unit)| !name.is_empty() && is_of_letters(unit)) {
            Some((name, unit)) => Self { name: name.to_owned(), unit: Some(unit.to_owned()) },
            None => Self { name: cell.to_owned(), unit: None },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_unit_stands_in_brackets_behind_a_slash_or_behind_an_underscore() {
        for (cell, name, unit) in [
            ("P", "P", None),
            ("normal_force [kN]", "normal_force", Some("kN")),
            (" Weg (µm) ", "Weg", Some("µm")),
            ("Q / N", "Q", Some("N")),
            ("P[N]", "P", Some("N")),
            ("M [N m]", "M", Some("N m")),
            ("P []", "P", Some("")),
            ("Q/P", "Q/P", None),
            ("x_mm", "x", Some("mm")),
            ("X_(microns)", "X", Some("microns")),
            ("wear_depth_µm", "wear_depth", Some("µm")),
            ("shift_x", "shift_x", None),
            ("h_max", "h_max", None),
            ("point_1", "point_1", None),
            ("_mm", "_mm", None),
        ] {
            let heading = Heading::of(cell).unwrap();
            assert_eq!((heading.name.as_str(), heading.unit.as_deref()), (name, unit), "{cell}");
        }
        for cell in ["P [N", "P N]", "P [N] x"] {
            assert_eq!(Heading::of(cell), None, "{cell}");
        }
    }
}
