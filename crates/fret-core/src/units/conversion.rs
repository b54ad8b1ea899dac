//! Units that heads of tables and logs name, and how many of the case's unit one of them is.

use std::f64::consts::PI;

use super::prefixes;
use super::system::Units;

/// A unit as a number of those of SI, `mantissa 10^power m^length N^force`; angles are numbers, in radians.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Known {
    mantissa: f64,
    power: i32,
    length: i32,
    force: i32,
}

const fn known(mantissa: f64, power: i32, length: i32, force: i32) -> Known {
    Known { mantissa, power, length, force }
}

/// Units that take prefixes.
const WITH_PREFIX: [(&str, Known); 7] = [
    ("m", known(1.0, 0, 1, 0)),
    ("N", known(1.0, 0, 0, 1)),
    ("Pa", known(1.0, 0, -2, 1)),
    ("J", known(1.0, 0, 1, 1)),
    ("rad", known(1.0, 0, 0, 0)),
    ("gf", known(9.806_65, -3, 0, 1)), // by definition, as are the pound, the inch and the bar
    ("bar", known(1.0, 5, -2, 1)),
];

const POUND: f64 = 4.448_221_615_260_5;
const INCH: f64 = 0.0254;

/// Units that take none.
const WITHOUT_PREFIX: [(&str, Known); 22] = [
    ("lbf", known(POUND, 0, 0, 1)),
    ("kp", known(9.806_65, 0, 0, 1)),
    ("dyn", known(1.0, -5, 0, 1)),
    ("in", known(25.4, -3, 1, 0)),
    ("inch", known(25.4, -3, 1, 0)),
    ("inches", known(25.4, -3, 1, 0)),
    ("mil", known(25.4, -6, 1, 0)),
    ("ft", known(304.8, -3, 1, 0)),
    ("micron", known(1.0, -6, 1, 0)),
    ("microns", known(1.0, -6, 1, 0)),
    ("micrometer", known(1.0, -6, 1, 0)),
    ("micrometers", known(1.0, -6, 1, 0)),
    ("Å", known(1.0, -10, 1, 0)),
    ("Angstrom", known(1.0, -10, 1, 0)),
    ("psi", known(POUND / (INCH * INCH), 0, -2, 1)),
    ("ksi", known(POUND / (INCH * INCH), 3, -2, 1)),
    ("deg", known(PI / 180.0, 0, 0, 0)),
    ("degree", known(PI / 180.0, 0, 0, 0)),
    ("degrees", known(PI / 180.0, 0, 0, 0)),
    ("°", known(PI / 180.0, 0, 0, 0)),
    ("-", known(1.0, 0, 0, 0)),
    ("1", known(1.0, 0, 0, 0)),
];

impl Known {
    fn to_the(self, exponent: i32) -> Self {
        Self {
            mantissa: self.mantissa.powi(exponent),
            power: self.power * exponent,
            length: self.length * exponent,
            force: self.force * exponent,
        }
    }

    fn times(self, other: Self) -> Self {
        Self {
            mantissa: self.mantissa * other.mantissa,
            power: self.power + other.power,
            length: self.length + other.length,
            force: self.force + other.force,
        }
    }
}

/// The unit that a word such as `kN`, `N mm`, `lbf/in^2` or `N·m` stands for.
fn unit(word: &str) -> Option<Known> {
    let word = word.trim();
    if let Some(known) = symbol(word) {
        return Some(known);
    }
    let plain = word.replace('²', "^2").replace('³', "^3");
    let mut product = known(1.0, 0, 0, 0);
    for (place, factors) in plain.split('/').enumerate() {
        let sign = if place == 0 { 1 } else { -1 };
        let mut is_empty = true;
        for factor in factors.split([' ', '*', '·', '⋅', '.', '-']).filter(|factor| !factor.is_empty()) {
            product = product.times(power(factor)?.to_the(sign));
            is_empty = false;
        }
        if is_empty {
            return None;
        }
    }
    Some(product)
}

/// A symbol with a small whole exponent, `mm^2` or `mm2`, or a force and a length without anything between, `Nmm`.
fn power(factor: &str) -> Option<Known> {
    let (base, exponent) = match factor.split_once('^') {
        Some((base, exponent)) => (base, exponent.parse().ok().filter(|power| (1..=4).contains(power))?),
        None => match factor.strip_suffix(['2', '3']) {
            Some(base) => (base, if factor.ends_with('2') { 2 } else { 3 }),
            None => (factor, 1),
        },
    };
    symbol(base).or_else(|| moment(base)).map(|known| known.to_the(exponent))
}

fn symbol(word: &str) -> Option<Known> {
    let with_prefix = |(name, known): &(&str, Known)| {
        let prefix = word.strip_suffix(name)?;
        Some(Known { power: known.power + prefixes::power(prefix)?, ..*known })
    };
    let without = WITHOUT_PREFIX.iter().find(|(name, _)| *name == word).map(|(_, known)| *known);
    without.or_else(|| WITH_PREFIX.iter().find_map(with_prefix))
}

fn moment(word: &str) -> Option<Known> {
    let parts = word.char_indices().skip(1).map(|(at, _)| word.split_at(at));
    parts.filter_map(|(force, length)| symbol(force).zip(symbol(length))).find_map(|(force, length)| {
        let is_moment = (force.length, force.force, length.length, length.force) == (0, 1, 1, 0);
        is_moment.then(|| force.times(length))
    })
}

/// How a number in one unit becomes one in another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Conversion {
    mantissa: f64,
    power: i32,
}

impl Conversion {
    /// Nothing to do.
    pub const NONE: Self = Self { mantissa: 1.0, power: 0 };

    /// What a number is multiplied by.
    pub fn factor(self) -> f64 {
        self.mantissa * 10_f64.powi(self.power)
    }

    /// The number in the other unit. Powers of ten divide where they make it smaller: 3 um are 0.003 mm to the last digit.
    pub fn of(self, value: f64) -> f64 {
        let scaled =
            if self.power < 0 { value / 10_f64.powi(-self.power) } else { value * 10_f64.powi(self.power) };
        scaled * self.mantissa
    }
}

/// Why a unit cannot be taken.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum UnitError {
    /// Nobody knows it.
    #[error("{0:?} is no unit that is known")]
    Unknown(String),
    /// Of another kind of quantity.
    #[error("{0:?} is no unit of a {1}")]
    OtherKind(String, &'static str),
    /// The unit of the case is not known.
    #[error("{0:?}, and the case is in {1:?}: nothing is known between them")]
    CaseUnknown(String, String),
    /// The case does not name its units, and this is none of SI without a prefix.
    #[error("{0:?}, and the case does not name its units")]
    CaseWithout(String),
}

/// How numbers in a unit become numbers in the units of a case, for a quantity of a `kind` of the words length, force and pressure, such
/// as `force x length`; `rad` and `-` are angles and slopes. A case without units of its own takes those of SI without a prefix as they are.
///
/// # Errors
/// When the unit is not known, is one of another kind, or nothing is known of the units of the case.
pub fn conversion(word: &str, kind: &str, units: Option<&Units>) -> Result<Conversion, UnitError> {
    let word = word.trim();
    if units.is_some_and(|units| units.of(kind) == word) {
        return Ok(Conversion::NONE);
    }
    let from = unit(word).ok_or_else(|| UnitError::Unknown(word.to_owned()))?;
    let wanted = dimensions(kind);
    if [from.length, from.force] != wanted {
        return Err(UnitError::OtherKind(word.to_owned(), in_words(kind)));
    }
    let into = match units {
        _ if wanted == [0, 0] => known(1.0, 0, 0, 0),
        Some(units) => {
            let own = symbol(&units.length).zip(symbol(&units.force));
            let (length, force) = own
                .filter(|(length, force)| {
                    [length.length, length.force, force.length, force.force] == [1, 0, 0, 1]
                })
                .or_else(|| alone(units, wanted))
                .ok_or_else(|| UnitError::CaseUnknown(word.to_owned(), units.of(kind)))?;
            length.to_the(wanted[0]).times(force.to_the(wanted[1]))
        }
        None if from.mantissa == 1.0 && from.power == 0 => from,
        None => return Err(UnitError::CaseWithout(word.to_owned())),
    };
    Ok(Conversion { mantissa: from.mantissa / into.mantissa, power: from.power - into.power })
}

/// Whether a word is a unit that is known.
pub fn is_unit(word: &str) -> bool {
    unit(word).is_some()
}

/// Whether a word is a unit that is known, of another quantity than one of a kind; pure numbers are units of all.
pub fn is_of_another(word: &str, kind: &str) -> bool {
    unit(word).is_some_and(|unit| ![[0, 0], dimensions(kind)].contains(&[unit.length, unit.force]))
}

/// The units of a case of which only the one is known that the quantity has.
fn alone(units: &Units, [length, force]: [i32; 2]) -> Option<(Known, Known)> {
    let one = known(1.0, 0, 0, 0);
    match [length, force] {
        [1, 0] => {
            symbol(&units.length).filter(|unit| [unit.length, unit.force] == [1, 0]).map(|unit| (unit, one))
        }
        [0, 1] => {
            symbol(&units.force).filter(|unit| [unit.length, unit.force] == [0, 1]).map(|unit| (one, unit))
        }
        _ => None,
    }
}

/// Exponents of length and force.
fn dimensions(kind: &str) -> [i32; 2] {
    match kind {
        "length" => [1, 0],
        "force" => [0, 1],
        "pressure" | "force/length^2" => [-2, 1],
        "force x length" => [1, 1],
        "force/length" => [-1, 1],
        _ => [0, 0],
    }
}

fn in_words(kind: &str) -> &'static str {
    match dimensions(kind) {
        [1, 0] => "length",
        [0, 1] => "force",
        [-2, 1] => "pressure",
        [1, 1] => "moment",
        [-1, 1] => "force on a length",
        _ => "number or angle",
    }
}

/// Units that a quantity of a kind may have, in words for a message.
pub fn known_units(kind: &str) -> &'static str {
    match dimensions(kind) {
        [1, 0] => "lengths are in m, mm, um, nm (any prefix), in, mil, ft",
        [0, 1] => "forces are in N, kN, mN (any prefix), gf, kgf, lbf, dyn",
        [-2, 1] => "pressures are in Pa, MPa, GPa (any prefix), bar, psi, ksi, N/mm^2, lbf/in^2",
        [1, 1] => "moments are in N m, N mm, lbf in, kgf mm: a force and a length",
        [-1, 1] => "forces of a line contact are in N/m, N/mm, lbf/in: a force over a length",
        _ => "angles are in rad, mrad, deg; slopes in -, rad, mm/m",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn factor(word: &str, kind: &str, length: &str, force: &str) -> Option<f64> {
        conversion(word, kind, Some(&Units::new(length, force))).ok().map(Conversion::factor)
    }

    /// Definitions: inch 25.4 mm, pound 0.45359237 kg, standard gravity 9.80665 m/s^2; 1 psi = 6894.757 Pa (NIST SP 811).
    #[test]
    fn units_become_those_of_the_case() {
        for (word, kind, length, force, right) in [
            ("kN", "force", "mm", "N", 1e3),
            ("um", "length", "mm", "N", 1e-3),
            ("µm", "length", "um", "mN", 1.0),
            ("nm", "length", "um", "N", 1e-3),
            ("in", "length", "mm", "N", 25.4),
            ("mil", "length", "um", "N", 25.4),
            ("lbf", "force", "m", "N", 0.453_592_37 * 9.806_65),
            ("kgf", "force", "m", "N", 9.806_65),
            ("gf", "force", "mm", "mN", 9.806_65),
            ("daN", "force", "mm", "N", 10.0),
            ("GPa", "pressure", "mm", "N", 1e3),
            ("psi", "pressure", "m", "N", 6_894.757_293_168),
            ("lbf/in^2", "pressure", "m", "kN", 6.894_757_293_168),
            ("N/mm2", "pressure", "mm", "N", 1.0),
            ("N/mm²", "pressure", "m", "N", 1e6),
            ("N m", "force x length", "mm", "N", 1e3),
            ("Nm", "force x length", "mm", "N", 1e3),
            ("N·mm", "force x length", "mm", "N", 1.0),
            ("kN-m", "force x length", "m", "N", 1e3),
            ("lbf in", "force x length", "mm", "N", 112.984_829),
            ("mJ", "force x length", "mm", "N", 1.0),
            ("kN/m", "force/length", "mm", "N", 1.0),
            ("deg", "rad", "mm", "N", PI / 180.0),
            ("mrad", "rad", "mm", "N", 1e-3),
            ("um/mm", "-", "mm", "N", 1e-3),
            ("ft", "length", "in", "lbf", 12.0),
            ("foo", "length", "foo", "N", 1.0),
            ("kN", "force", "foo", "N", 1e3),
        ] {
            let found = factor(word, kind, length, force).unwrap_or(f64::NAN);
            assert!(
                (found / right - 1.0).abs() < 1e-9,
                "{word} of {kind} in {length}, {force}: {found}, {right}"
            );
        }
    }

    #[test]
    fn a_prefix_moves_the_point_and_nothing_else() {
        let um = conversion("um", "length", Some(&Units::new("mm", "N"))).unwrap();
        let kilo = conversion("kN", "force", Some(&Units::new("mm", "N"))).unwrap();
        for (moved, right) in
            [(um.of(3.0), 0.003), (um.of(-0.7), -0.0007), (kilo.of(0.005), 5.0), (um.of(0.0), 0.0)]
        {
            assert_eq!(moved, right);
        }
        assert_eq!(um.factor(), 1e-3);
    }

    #[test]
    fn other_words_and_kinds_are_refused() {
        for (word, kind) in [
            ("bananas", "force"),
            ("um", "force"),
            ("s", "force"),
            ("N", "length"),
            ("", "force"),
            ("g", "force"),
            ("N/mm", "force"),
            ("N/", "force"),
            ("N^9", "force"),
            ("deg", "length"),
            ("m", "rad"),
            ("Pa", "force"),
            ("%", "-"),
            ("mN/m", "pressure"),
        ] {
            assert_eq!(factor(word, kind, "mm", "N"), None, "{word} of {kind}");
        }
        assert_eq!(factor("kN", "force", "mm", "foo"), None);
        assert_eq!(factor("MPa", "pressure", "foo", "N"), None);
    }

    #[test]
    fn a_case_without_units_takes_those_of_si() {
        for (word, kind, right) in [
            ("N", "force", Some(1.0)),
            ("m", "length", Some(1.0)),
            ("Pa", "pressure", Some(1.0)),
            ("N m", "force x length", Some(1.0)),
            ("deg", "rad", Some(PI / 180.0)),
            ("kN", "force", None),
            ("mm", "length", None),
            ("N/mm", "force/length", None),
        ] {
            assert_eq!(conversion(word, kind, None).ok().map(Conversion::factor), right, "{word}");
        }
    }
}
