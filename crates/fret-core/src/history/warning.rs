//! What about a case or its answer may mislead: facts with a name, a number, the bound it has crossed, words and a way out. Who finds the numbers
//! is `plausibility`.

use serde::{Deserialize, Serialize};

use super::concern::{Concern, Row};

/// A fact that may mislead.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Warning {
    /// What it is about.
    pub name: Concern,
    /// The number [-].
    pub value: f64,
    /// The bound it has crossed [-].
    pub bound: f64,
    /// Name of the stage at whose end, or in which, it was met; `None` where it follows from the case alone.
    pub stage: Option<String>,
    /// In words.
    pub message: String,
    /// A way out.
    pub help: String,
}

impl Warning {
    /// The warning of a number, where it has crossed its bound.
    pub fn of(name: Concern, value: f64, stage: Option<String>) -> Option<Self> {
        let row = name.row();
        let Row { bound, warns_below, consequence, help, .. } = *row;
        let crossed = if warns_below { value < bound } else { value > bound };
        if !(crossed && value.is_finite()) {
            return None;
        }
        let place = stage.as_ref().map_or(String::new(), |stage| format!(", stage \"{stage}\""));
        let side = if warns_below { "at least" } else { "at most" };
        let message = if name == Concern::CoatingThinnerThanCell {
            format!("{} ({} cells); {consequence}", row.begins(), rounded(value))
        } else {
            format!(
                "{}: {}{place} (should be {side} {}); {consequence}",
                row.begins(),
                rounded(value),
                rounded(bound)
            )
        };
        Some(Self { name, value, bound, stage, message, help: help.to_owned() })
    }
}

impl Warning {
    /// The warning of a stage in which the contact radius grows by `growth` cells per increment, more than `limit`; enough
    /// increments, and the ramp that they are meant for, where it is another one.
    pub fn of_pressing(
        [growth, limit]: [f64; 2],
        stage: String,
        (enough, ramp): (usize, Option<&str>),
    ) -> Self {
        let message = format!(
            "stage \"{stage}\": {} {} cells per increment (limit {}), which leaves rings in the shear traction",
            Concern::PressingInFewIncrements.row().begins(),
            rounded(growth),
            rounded(limit)
        );
        let with = ramp.map_or(String::new(), |ramp| format!(" with ramp = \"{ramp}\""));
        Self {
            name: Concern::PressingInFewIncrements,
            value: growth,
            bound: limit,
            stage: Some(stage),
            message,
            help: format!("use at least {enough} increments{with}, or increments = \"auto\""),
        }
    }
}

/// Three digits.
fn rounded(value: f64) -> String {
    if value != 0.0 && !(1e-3..1e5).contains(&value.abs()) {
        return format!("{value:.2e}");
    }
    let digits = (2 - value.abs().max(1e-3).log10().floor() as i32).clamp(0, 5) as usize;
    let text = format!("{value:.digits$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::history::concern::ROWS;

    /// Each with its bound, as the pages name them, and whether small numbers are what is warned of.
    const CONCERNS: [(Concern, f64, bool); 17] = [
        (Concern::FewCells, 6.0, true),
        (Concern::StifferThanDiamond, 1.0, false),
        (Concern::ContactRadiusOverBodyRadius, 0.2, false),
        (Concern::ApproachOverContactRadius, 0.2, false),
        (Concern::ApproachOverLayerThickness, 0.2, false),
        (Concern::ShiftOverContactRadius, 0.2, false),
        (Concern::SteepTopography, 0.3, false),
        (Concern::CoatingThinnerThanCell, 1.0, true),
        (Concern::WearDepthOverCoatingThickness, 0.2, false),
        (Concern::ComplianceSpread, 0.1, false),
        (Concern::FrictionChangesInOneCycle, 0.1, false),
        (Concern::ContactNearEdge, 2.0, true),
        (Concern::PressingInFewIncrements, 1.0, false),
        (Concern::FewCellsPerWave, 6.0, true),
        (Concern::BulkStrain, 0.2, false),
        (Concern::MovingInFewIncrements, 1.0 / 6.0, false),
        (Concern::RollingInFewIncrements, 0.1, false),
    ];

    #[test]
    fn a_warning_is_of_a_number_that_has_crossed_its_bound() {
        for (name, bound, below) in CONCERNS {
            let at = |value: f64| Warning::of(name, value, Some("rub".to_owned()));
            let (within, beyond) = if below { (1.001, 0.999) } else { (0.999, 1.001) };
            assert!(at(bound).is_none() && at(within * bound).is_none(), "{name:?}");
            for none in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                assert!(at(none).is_none(), "{name:?} {none}");
            }
            let warning = at(beyond * bound).unwrap();
            assert_eq!((warning.name, warning.value, warning.bound), (name, beyond * bound, bound));
            assert_eq!(warning.stage.as_deref(), Some("rub"));
            let side = if below { "at least" } else { "at most" };
            let own_words = name == Concern::CoatingThinnerThanCell;
            let words = if own_words {
                "thinner than a cell".to_owned()
            } else {
                format!(", stage \"rub\" (should be {side} ")
            };
            assert!(warning.message.contains(&words), "{warning:?}");
            assert!(!Warning::of(name, beyond * bound, None).unwrap().message.contains("stage \""));
            // The name in tables is that of the files.
            assert_eq!(serde_json::to_string(&name).unwrap(), format!("\"{}\"", name.row().name));
        }
        assert_eq!(CONCERNS.map(|(name, ..)| name), ROWS.map(|row| row.concern));
        assert!(ROWS.iter().all(|row| row.concern.row() == row));
        let words: std::collections::HashSet<_> =
            CONCERNS.iter().flat_map(|(name, ..)| [name.row().quantity, name.row().consequence]).collect();
        assert_eq!(words.len(), 34, "every concern has its own words");
        assert!(CONCERNS.iter().all(|(name, ..)| !name.row().help.is_empty()));
    }

    #[test]
    fn the_words_of_a_warning_are_a_sentence() {
        let warning = Warning::of(Concern::FewCells, 4.567, None).unwrap();
        assert_eq!(
            warning.message,
            "cells in the contact radius: 4.57 (should be at least 6); the contact is under-resolved; errors may be large"
        );
    }

    #[test]
    fn pressing_in_few_increments_is_told_with_enough_of_them() {
        let of = |ramp| Warning::of_pressing([1.642, 1.0], "press".to_owned(), (33, ramp));
        let warning = of(None);
        assert_eq!(
            warning.message,
            "stage \"press\": the contact radius grows by 1.64 cells per increment (limit 1), which leaves rings in the shear traction"
        );
        assert_eq!(warning.help, "use at least 33 increments, or increments = \"auto\"");
        assert_eq!((warning.value, warning.bound), (1.642, 1.0));
        assert_eq!(
            of(Some("cubic")).help,
            "use at least 33 increments with ramp = \"cubic\", or increments = \"auto\""
        );
    }

    #[test]
    fn numbers_have_three_digits() {
        for (value, text) in [
            (0.0, "0"),
            (5.25, "5.25"),
            (-2.5, "-2.5"),
            (0.123_456, "0.123"),
            (0.1, "0.1"),
            (12.3456, "12.3"),
            (123.6, "124"),
            (120.0, "120"),
            (1000.0, "1000"),
            (0.001, "0.001"),
            (0.001_234, "0.00123"),
            (9.99e-4, "9.99e-4"),
            (99_999.0, "99999"),
            (1e5, "1.00e5"),
            (-1.5e7, "-1.50e7"),
        ] {
            assert_eq!(rounded(value), text);
        }
    }
}
