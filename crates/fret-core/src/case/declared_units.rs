//! The judgement of the units that a case declares.

use super::file::UnitsFile;
use super::judge::Judge;
use crate::document::At;
use crate::units::{Units, symbol_of};

/// Letters of a unit, at most.
const LONGEST: usize = 12;

/// The declared units; `None` where one was refused.
pub(super) fn declared_units(judge: &mut Judge, file: &UnitsFile) -> Option<Units> {
    let mut word = |name: &str, given: &At<String>| {
        let unit = &given.value;
        let is_word = !unit.is_empty()
            && unit.chars().count() <= LONGEST
            && unit.chars().all(|letter| letter.is_alphanumeric() || "/^*._-%'\"°".contains(letter));
        if let Some(symbol) = symbol_of(unit) {
            let why = "the name of a unit, where its symbol stands: nothing could be converted";
            let message = format!("units.{name} = {unit:?}: {why}");
            return judge.refuse(given.span(), message, &format!("{name} = \"{symbol}\""));
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
    let (length, force) = (word("length", &file.length), word("force", &file.force));
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
        assert_eq!(read(BALL, &[]).units, None);
    }
}
