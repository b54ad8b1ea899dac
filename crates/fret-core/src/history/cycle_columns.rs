//! The vocabulary of the table of cycles: a new column is a line here.

use super::columns::{
    ANGLE, Column, FORCE, LENGTH, NO_UNIT, RATIO, STIFFNESS, VOLUME, WORK, count, or_turning, real,
    real_or_none, truth, word,
};
use super::cycle::{CycleRecord, CycleRegime, Drive};

/// Columns of the table of cycles, in its order: `cycles.csv`, and `history.cycles` in Python. Names are those of the record.
pub static CYCLE_COLUMNS: &[Column<CycleRecord>] = &[
    count("stage", "number of the stage, from 0", NO_UNIT, |cycle| cycle.stage),
    count("cycle", "number of the cycle in its stage, from 1", NO_UNIT, |cycle| cycle.cycle),
    count("first_increment", "first increment of the cycle", NO_UNIT, |cycle| cycle.first_increment),
    count("last_increment", "last increment of the cycle", NO_UNIT, |cycle| cycle.last_increment),
    count("stands_for", "cycles it represents: more than 1 with cycle jumps", NO_UNIT, |cycle| {
        cycle.stands_for
    }),
    real("dissipated_energy", "dissipated energy W_d of this simulated cycle", WORK, |cycle| {
        cycle.dissipated_energy
    }),
    word("drive", "tangential, or torsional", NO_UNIT, |cycle| drive_word(cycle.drive)),
    real("direction", "direction of the tangential force's main axis, from x", ANGLE, |cycle| {
        cycle.direction
    }),
    or_turning(
        WORK,
        real(
            "force_amplitude",
            "Q*: half the range of the force along it, or of the moment",
            FORCE,
            |cycle| cycle.force_amplitude,
        ),
    ),
    or_turning(
        ANGLE,
        real(
            "displacement_amplitude",
            "delta*: half the range of the relative displacement along it, or of the twist",
            LENGTH,
            |cycle| cycle.displacement_amplitude,
        ),
    ),
    or_turning(
        ANGLE,
        real("opening", "delta_0: loop half-width at the middle of the force range", LENGTH, |cycle| {
            cycle.opening
        }),
    ),
    real_or_none("energy_ratio", "A = W_d / (4 Q* delta*)", RATIO, |cycle| cycle.energy_ratio),
    real_or_none("sliding_ratio", "D = delta_0 / delta*", RATIO, |cycle| cycle.sliding_ratio),
    or_turning(
        WORK,
        real_or_none("stiffness", "slope of the loop directly after reversal", STIFFNESS, |cycle| {
            cycle.stiffness
        }),
    ),
    word("regime", "sliding condition: full_stick, partial_slip, mixed or gross_slip", NO_UNIT, |cycle| {
        cycle.regime.map_or("", CycleRegime::name)
    }),
    real("closure", "cycle-to-cycle change of tractions, forces and motions, relative", RATIO, |cycle| {
        cycle.closure
    }),
    truth("steady", "whether the stage ended here because the cycle is steady", NO_UNIT, |cycle| {
        cycle.steady
    }),
    real("worn_volume", "wear volume since the start of the history", VOLUME, |cycle| cycle.worn_volume),
    real(
        "max_worn_depth",
        "maximum wear depth of both bodies together; with finite displacement the larger one of the bodies' own, after the cycle",
        LENGTH,
        |cycle| cycle.max_worn_depth,
    ),
    count("last_cycle", "number in its stage of the last cycle it represents, from 1", NO_UNIT, |cycle| {
        cycle.last_cycle
    }),
    real(
        "total_dissipated_energy",
        "dissipated energy since the start of the history, including the cycles represented by cycle jumps",
        WORK,
        |cycle| cycle.total_dissipated_energy,
    ),
    real_or_none(
        "actuator_amplitude",
        "half the range of the actuator's displacement along the axis of the force",
        LENGTH,
        |cycle| cycle.actuator_amplitude,
    ),
    real_or_none("actuator_energy_ratio", "A of the loop at the actuator", RATIO, |cycle| {
        cycle.actuator_energy_ratio
    }),
    real_or_none("actuator_sliding_ratio", "D of the loop at the actuator", RATIO, |cycle| {
        cycle.actuator_sliding_ratio
    }),
    real_or_none(
        "actuator_stiffness",
        "slope of the loop at the actuator directly after reversal",
        STIFFNESS,
        |cycle| cycle.actuator_stiffness,
    ),
    real(
        "friction_coefficient",
        "mean friction coefficient of the cycle over the contact at its end, weighted with the pressure",
        RATIO,
        |cycle| cycle.friction_coefficient,
    ),
    real_or_none(
        "friction_change",
        "largest change of the friction coefficient of a cell by this cycle and those it represents",
        RATIO,
        |cycle| cycle.friction_change,
    ),
    real_or_none(
        "jump_error",
        "estimated error of the friction coefficient of a cell by the cycle jump before this cycle, the largest",
        RATIO,
        |cycle| cycle.jump_error,
    ),
    real_or_none(
        "lower_worn_depth",
        "maximum wear depth of the lower body, of cases whose layers have wear coefficients",
        LENGTH,
        |cycle| cycle.lower_worn_depth,
    ),
    real_or_none("upper_worn_depth", "the same of the upper body", LENGTH, |cycle| cycle.upper_worn_depth),
    real_or_none(
        "compliance_spread",
        "with wear.thinning_tolerance: normal compliance of the most worn place of the contact less that of the least worn, over that of the mean",
        RATIO,
        |cycle| cycle.compliance_spread,
    ),
    real_or_none(
        "wear_jump_error",
        "with wear.tolerance: estimated relative error of the wear depth, or of the debris, by the cycle jump before this cycle",
        RATIO,
        |cycle| cycle.wear_jump_error,
    ),
    real_or_none(
        "debris_volume",
        "with wear.debris: debris between the surfaces after the cycle",
        VOLUME,
        |cycle| cycle.debris_volume,
    ),
    real_or_none(
        "debris_outflow",
        "with wear.debris: debris that has flowed out of the contact since the start of the history",
        VOLUME,
        |cycle| cycle.debris_outflow,
    ),
];

pub(super) fn drive_word(drive: Drive) -> &'static str {
    match drive {
        Drive::Tangential => "tangential",
        Drive::Torsional => "torsional",
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use serde_json::json;

    use super::super::columns::{STEP_COLUMNS, regime_word};
    use super::*;
    use crate::solver::Regime;

    fn names<R>(columns: &[Column<R>]) -> BTreeSet<&'static str> {
        let names: BTreeSet<_> = columns.iter().map(|column| column.name).collect();
        assert_eq!(names.len(), columns.len(), "a name stands twice");
        names
    }

    /// A cycle as JSON, as it goes to Python; each number is another one.
    fn cycle() -> CycleRecord {
        let all = json!({
            "stage": 1, "cycle": 2, "first_increment": 3, "last_increment": 4, "stands_for": 5, "last_cycle": 6,
            "dissipated_energy": 7.5, "total_dissipated_energy": 8.5, "drive": "torsional", "direction": 9.5,
            "force_amplitude": 10.5, "displacement_amplitude": 11.5, "opening": 12.5, "energy_ratio": 13.5,
            "sliding_ratio": 14.5, "stiffness": 15.5, "regime": "mixed", "closure": 16.5, "steady": true,
            "worn_volume": 17.5, "max_worn_depth": 18.5, "actuator_amplitude": 19.5,
            "actuator_energy_ratio": 20.5, "actuator_sliding_ratio": 21.5, "actuator_stiffness": 22.5,
            "friction_coefficient": 23.5, "friction_change": 24.5, "jump_error": 25.5, "lower_worn_depth": 26.5,
            "upper_worn_depth": 27.5, "compliance_spread": 28.5, "wear_jump_error": 29.5,
            "debris_volume": 30.5, "debris_outflow": 31.5,
        });
        serde_json::from_value(all).unwrap()
    }

    #[test]
    fn columns_of_cycles_are_the_entries_of_their_record() {
        let record = cycle();
        let entries = serde_json::to_value(&record).unwrap();
        assert_eq!(names(CYCLE_COLUMNS), entries.as_object().unwrap().keys().map(String::as_str).collect());
        for column in CYCLE_COLUMNS {
            assert_eq!(column.json(&record), entries[column.name], "{}", column.name);
        }
    }

    #[test]
    fn words_are_those_that_are_stored() {
        for regime in
            [CycleRegime::FullStick, CycleRegime::PartialSlip, CycleRegime::Mixed, CycleRegime::GrossSlip]
        {
            assert_eq!(json!(regime.name()), json!(regime));
        }
        for regime in
            [Regime::Apart, Regime::FullStick, Regime::PartialSlip, Regime::GrossSlip, Regime::Frictionless]
        {
            assert_eq!(json!(regime_word(regime)), json!(regime));
        }
        for drive in [Drive::Tangential, Drive::Torsional] {
            assert_eq!(json!(drive_word(drive)), json!(drive));
        }
    }

    #[test]
    fn names_and_meanings_go_into_a_table_of_commas() {
        names(STEP_COLUMNS);
        let told = STEP_COLUMNS.iter().map(|column| (column.name, column.meaning, column.unit));
        for (name, meaning, unit) in
            told.chain(CYCLE_COLUMNS.iter().map(|column| (column.name, column.meaning, column.unit)))
        {
            assert!(name.chars().all(|letter| letter.is_ascii_lowercase() || letter == '_'), "{name}");
            assert!(!meaning.is_empty() && !meaning.contains('['), "{name}: the unit stands by itself");
            assert!(!unit.contains(['[', ']']), "{name}");
        }
    }
}
