//! Units that a case declares: of length and force; those of everything else follow. The program computes without them: numbers of
//! a case are never converted, only called by their units; tables that name others are converted when they are read.

use serde::{Deserialize, Serialize};

use super::prefixes::{power, prefix};
use crate::model::Dimension;

/// Declared units.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Units {
    /// Of lengths.
    pub length: String,
    /// Of forces.
    pub force: String,
    /// Of pressures, tractions, stresses and moduli; follows from the others.
    pub pressure: String,
}

impl Units {
    /// Units of a length and a force. A pressure has a name of its own where both are SI units with a prefix: N and mm give `MPa`.
    pub fn new(length: &str, force: &str) -> Self {
        let pressure = pascals(length, force).unwrap_or_else(|| format!("{force}/{length}^2"));
        Self { length: length.to_owned(), force: force.to_owned(), pressure }
    }

    /// The unit of a kind of quantity written with the words length, force and pressure, such as `force x length` or `length^2`.
    pub fn of(&self, kind: &str) -> String {
        let named = kind.replace("length", "\u{1}").replace("force", "\u{2}").replace("pressure", "\u{3}");
        named
            .replace(" x ", " ")
            .replace('\u{1}', &self.length)
            .replace('\u{2}', &self.force)
            .replace('\u{3}', &self.pressure)
    }
}

impl Units {
    /// Pascals in the unit of pressure, where it is one of SI.
    pub fn pascals(&self) -> Option<f64> {
        power_of_pressure(&self.length, &self.force).map(|power| 10_f64.powi(power))
    }

    /// The head of a column: its name, with its unit in brackets where the case declares units and the quantity has one of them.
    pub fn heading(units: Option<&Self>, name: &str, kind: &str, dimension: Dimension) -> String {
        match Self::unit(units, kind, dimension) {
            Some(unit) => format!("{name} [{unit}]"),
            None => name.to_owned(),
        }
    }

    /// What follows a number in a sentence: a space and its unit; nothing where the case declares no units or the quantity has none.
    pub fn after(units: Option<&Self>, kind: &str, dimension: Dimension) -> String {
        Self::unit(units, kind, dimension).map_or_else(String::new, |unit| format!(" {unit}"))
    }

    /// The unit of a kind of quantity alone, where the case declares units and the quantity has one of them.
    pub fn unit(units: Option<&Self>, kind: &str, dimension: Dimension) -> Option<String> {
        let kind = dimension.kind(kind);
        let told = ["length", "force", "pressure", "rad", "degrees"].iter().any(|word| kind.contains(word));
        units.filter(|_| told).map(|units| units.of(kind))
    }

    /// The name of a column, whose head may have a unit.
    pub fn name_of(heading: &str) -> &str {
        heading.split_once(" [").map_or(heading, |(name, _)| name)
    }
}

fn power_of(unit: &str, base: &str) -> Option<i32> {
    power(unit.strip_suffix(base)?)
}

/// Power of ten of the pressure of a force in newtons and a length in metres, where both have a prefix.
fn power_of_pressure(length: &str, force: &str) -> Option<i32> {
    Some(power_of(force, "N")? - 2 * power_of(length, "m")?)
}

fn pascals(length: &str, force: &str) -> Option<String> {
    let power = power_of_pressure(length, force)?;
    prefix(power).map(|prefix| format!("{prefix}Pa"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pressures_have_names_of_their_own_where_they_have_some() {
        let pressure = |length: &str, force: &str| Units::new(length, force).pressure;
        // 1 N/mm^2 = 1e6 N/m^2 = 1 MPa; 1 mN/um^2 = 1e-3/1e-12 = 1 GPa.
        assert_eq!(pressure("mm", "N"), "MPa");
        assert_eq!(pressure("m", "N"), "Pa");
        assert_eq!(pressure("µm", "mN"), "GPa");
        assert_eq!(pressure("mm", "kN"), "GPa");
        assert_eq!(pressure("cm", "N"), "N/cm^2"); // 1e4 Pa
        assert_eq!(pressure("in", "lbf"), "lbf/in^2");
    }

    #[test]
    fn other_quantities_follow() {
        let units = Units::new("mm", "N");
        assert_eq!(units.of("force x length"), "N mm");
        assert_eq!(units.of("length^3"), "mm^3");
        assert_eq!(units.of("pressure"), "MPa");
        assert_eq!(units.of("force/length"), "N/mm");
        assert_eq!(units.of("rad"), "rad");
    }

    #[test]
    fn heads_of_columns_have_units_where_there_are_some() {
        let units = Units::new("mm", "N");
        let head = |name: &str, kind: &str, of_a_line: bool| {
            Units::heading(Some(&units), name, kind, Dimension::from(of_a_line))
        };
        assert_eq!(head("normal_force", "force", false), "normal_force [N]");
        assert_eq!(head("normal_force", "force", true), "normal_force [N/mm]");
        assert_eq!(head("dissipated_energy", "force x length", true), "dissipated_energy [N]");
        assert_eq!(head("wall_s", "s", false), "wall_s");
        assert_eq!(Units::heading(None, "approach", "length", Dimension::Plane), "approach");
        assert_eq!(Units::name_of("normal_force [N/mm]"), "normal_force");
        assert_eq!(Units::after(Some(&units), "force", Dimension::Line), " N/mm");
        assert_eq!(Units::after(Some(&units), "-", Dimension::Plane), "");
        assert_eq!(Units::after(None, "force", Dimension::Plane), "");
    }

    #[test]
    fn pressures_are_told_in_pascals_where_their_units_are_of_si() {
        for (length, force, pascals, word) in [
            ("um", "N", Some(1e12), "TPa"),
            ("mm", "N", Some(1e6), "MPa"),
            ("m", "kN", Some(1e3), "kPa"),
            ("m", "N", Some(1.0), "Pa"),
            ("m", "mN", Some(1e-3), "mPa"),
            ("cm", "N", Some(1e4), "N/cm^2"),
            ("in", "lbf", None, "lbf/in^2"),
            ("mm", "lbf", None, "lbf/mm^2"),
        ] {
            let units = Units::new(length, force);
            // a power of ten is right to rounding
            let right = match (units.pascals(), pascals) {
                (Some(found), Some(exact)) => (found / exact - 1.0_f64).abs() < 1e-15,
                (found, exact) => found == exact,
            };
            assert!(
                right && units.pressure == word,
                "{length} {force}: {:?} {}",
                units.pascals(),
                units.pressure
            );
        }
    }
}
