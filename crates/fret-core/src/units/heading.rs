//! The head of a column: a name and perhaps a unit.

/// A name and the unit that stands behind it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Heading {
    /// Name of the column.
    pub name: String,
    /// Its unit, if one is named.
    pub unit: Option<String>,
}

impl Heading {
    /// `Weg [um]`, `Q (N)` and `Q / N` are a name and a unit; `None` where a bracket is not closed.
    pub fn of(cell: &str) -> Option<Self> {
        let cell = cell.trim();
        for (open, close) in [('[', ']'), ('(', ')')] {
            if let (Some(from), true) = (cell.rfind(open), cell.ends_with(close)) {
                let unit = cell[from + 1..cell.len() - 1].trim();
                return Some(Self { name: cell[..from].trim().to_owned(), unit: Some(unit.to_owned()) });
            }
        }
        if cell.contains(['[', ']']) {
            return None;
        }
        Some(match cell.split_once(" / ") {
            Some((name, unit)) => Self { name: name.trim().to_owned(), unit: Some(unit.trim().to_owned()) },
            None => Self { name: cell.to_owned(), unit: None },
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_unit_stands_in_brackets_or_behind_a_slash() {
        for (cell, name, unit) in [
            ("P", "P", None),
            ("normal_force [kN]", "normal_force", Some("kN")),
            (" Weg (µm) ", "Weg", Some("µm")),
            ("Q / N", "Q", Some("N")),
            ("P[N]", "P", Some("N")),
            ("M [N m]", "M", Some("N m")),
            ("P []", "P", Some("")),
            ("Q/P", "Q/P", None),
        ] {
            let heading = Heading::of(cell).unwrap();
            assert_eq!((heading.name.as_str(), heading.unit.as_deref()), (name, unit), "{cell}");
        }
        for cell in ["P [N", "P N]", "P [N] x"] {
            assert_eq!(Heading::of(cell), None, "{cell}");
        }
    }
}
