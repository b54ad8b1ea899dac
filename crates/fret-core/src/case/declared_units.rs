//! The judgement of the units that a case declares.

use super::file::UnitsFile;
use super::judge::Judge;
use crate::document::At;
use crate::units::{Units, is_of_another, symbol_of};

/// Letters of a unit, at most.
const LONGEST: usize = 12;

/// The declared units; `None` where one was refused.
pub(super) fn declared_units(judge: &mut Judge, file: &UnitsFile) -> Option<Units> {
    let mut word = |name: &str, base: &str, given: &At<String>| {
        let unit = &given.value;
        let is_word = !unit.is_empty()
            && unit.chars().count() <= LONGEST
            && unit.chars().all(|letter| letter.is_alphanumeric() || "/^*._-%'\"°".contains(letter));
        if let Some(symbol) = symbol_of(unit) {
            let is_one = symbol.ends_with(base);
            let why = if is_one {
                "the name of a unit, where its symbol belongs: nothing could be converted".to_owned()
            } else {
                format!("no unit of {name}")
            };
            let help = if is_one {
                format!("{name} = \"{symbol}\"")
            } else {
                format!("for example {name} = \"{base}\"")
            };
            return judge.refuse(given.span(), format!("units.{name} = {unit:?}: {why}"), &help);
        }
        if is_word && is_of_another(unit, name) {
            let why = format!("units.{name} = {unit:?}: a unit of another quantity");
            return judge.refuse(given.span(), why, &format!("for example {name} = \"{base}\""));
        }
        if is_word {
            return Some(unit.clone());
        }
        judge.refuse(
            given.span(),
            format!("units.{name} = {unit:?}: must be the symbol of a unit, of 1 to {LONGEST} letters"),
            "for example length = \"mm\", force = \"N\": then pressures are in MPa",
        )
    };
    let (length, force) = (word("length", "m", &file.length), word("force", "N", &file.force));
    Some(Units::new(&length?, &force?))
}

#[cfg(test)]
mod tests {
    use crate::units::Units;

    #[test]
    fn units_of_a_case_are_short_words() {
        use crate::case::check::tests::{BALL, read, refused};
        let units = |length: &str| format!("[units]\nlength = \"{length}\"\nforce = \"N\"\n[grid]");
        for length in ["mm", "µm", "twelve_marks", "\u{b0}"] {
            assert_eq!(read(BALL, &[("[grid]", &units(length))]).units, Some(Units::new(length, "N")));
        }
        for length in ["", "thirteen_mark", "m m", "m,"] {
            let place = format!("\"{length}\"");
            refused(
                BALL,
                &[("[grid]", &units(length))],
                "must be the symbol of a unit, of 1 to 12 letters",
                &place,
            );
        }
        let named = [("[grid]", &units("millimeter")[..])];
        refused(BALL, &named, "units.length = \"millimeter\": the name of a unit", "\"millimeter\"");
        // no symbol of a force helps where a length belongs
        let mistaken = [("[grid]", &units("newton")[..])];
        refused(BALL, &mistaken, "units.length = \"newton\": no unit of length", "\"newton\"");
        let mistaken = [("[grid]", "[units]\nlength = \"mm\"\nforce = \"meter\"\n[grid]")];
        refused(BALL, &mistaken, "units.force = \"meter\": no unit of force", "\"meter\"");
        for other in ["N", "MPa", "mm^2", "Nm"] {
            let (text, place) = (units(other), format!("\"{other}\""));
            refused(BALL, &[("[grid]", &text)], "a unit of another quantity", &place);
        }
        let mistaken = [("[grid]", "[units]\nlength = \"mm\"\nforce = \"mm\"\n[grid]")];
        refused(BALL, &mistaken, "units.force = \"mm\": a unit of another quantity", "\"mm\"");
        assert_eq!(read(BALL, &[]).units, None);
    }
}
