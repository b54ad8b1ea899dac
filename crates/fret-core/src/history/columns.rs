//! The vocabulary of the tables: every column of increments and of cycles with its name, its meaning, its unit and its value. The
//! files of the command, the Python package and the reference page are made from it, so a new column is a line here.

use super::cycle::{CycleRecord, CycleRegime, Drive};
use super::records::StepRecord;
use crate::solver::Regime;

const NO_UNIT: &str = "";
const RATIO: &str = "-";
const ANGLE: &str = "rad";
const SECONDS: &str = "s";
const LENGTH: &str = "length";
const AREA: &str = "length^2";
const VOLUME: &str = "length^3";
const FORCE: &str = "force";
const WORK: &str = "force x length";
const PRESSURE: &str = "pressure";

/// One number or word of a record.
#[derive(Debug)]
pub struct Column<R: 'static> {
    /// Name in files and in Python.
    pub name: &'static str,
    /// What it means, in a line.
    pub meaning: &'static str,
    /// Its unit in those of the case, `-` for a ratio; empty where it has none, or where that depends on the case.
    pub unit: &'static str,
    /// Its value in a record.
    pub value: Value<R>,
}

/// Where a value stands in a record; by this, what kind it is.
#[derive(Debug)]
pub enum Value<R: 'static> {
    /// A whole number.
    Count(fn(&R) -> usize),
    /// A real number.
    Real(fn(&R) -> f64),
    /// A real number that some records lack.
    RealOrNone(fn(&R) -> Option<f64>),
    /// Yes or no.
    Truth(fn(&R) -> bool),
    /// A word, empty where a record lacks it.
    Word(fn(&R) -> &'static str),
}

const fn count<R>(
    name: &'static str,
    meaning: &'static str,
    unit: &'static str,
    value: fn(&R) -> usize,
) -> Column<R> {
    Column { name, meaning, unit, value: Value::Count(value) }
}

const fn real<R>(
    name: &'static str,
    meaning: &'static str,
    unit: &'static str,
    value: fn(&R) -> f64,
) -> Column<R> {
    Column { name, meaning, unit, value: Value::Real(value) }
}

const fn real_or_none<R>(
    name: &'static str,
    meaning: &'static str,
    unit: &'static str,
    value: fn(&R) -> Option<f64>,
) -> Column<R> {
    Column { name, meaning, unit, value: Value::RealOrNone(value) }
}

const fn truth<R>(
    name: &'static str,
    meaning: &'static str,
    unit: &'static str,
    value: fn(&R) -> bool,
) -> Column<R> {
    Column { name, meaning, unit, value: Value::Truth(value) }
}

const fn word<R>(
    name: &'static str,
    meaning: &'static str,
    unit: &'static str,
    value: fn(&R) -> &'static str,
) -> Column<R> {
    Column { name, meaning, unit, value: Value::Word(value) }
}

/// Columns of the table of increments, in its order: `history.csv`, and `history.increments` in Python.
pub static STEP_COLUMNS: &[Column<StepRecord>] = &[
    count("increment", "number of the increment in the whole history, from 0", NO_UNIT, |step| {
        step.increment
    }),
    count("stage", "number of the stage, from 0", NO_UNIT, |step| step.stage),
    real("normal_force", "normal force, compression positive", FORCE, |step| step.normal_force),
    real("approach", "rigid normal approach", LENGTH, |step| step.approach),
    real("tangential_force_x", "tangential force on the lower body along x", FORCE, |step| {
        step.tangential_force[0]
    }),
    real("tangential_force_y", "tangential force on the lower body along y", FORCE, |step| {
        step.tangential_force[1]
    }),
    real("shift_x", "rigid tangential displacement of the upper body along x", LENGTH, |step| step.shift[0]),
    real("shift_y", "rigid tangential displacement of the upper body along y", LENGTH, |step| step.shift[1]),
    real("twist_moment", "moment about z on the lower body", WORK, |step| step.twist_moment),
    real("twist", "rotation of the upper body about z", ANGLE, |step| step.twist),
    real("max_pressure", "maximum contact pressure of a cell", PRESSURE, |step| step.max_pressure),
    real("max_shear", "maximum shear traction of a cell", PRESSURE, |step| step.max_shear),
    real("contact_area", "contact area", AREA, |step| step.contact_area),
    real("stick_area", "stick area", AREA, |step| step.stick_area),
    real(
        "dissipated_energy",
        "dissipated energy since the start, including the cycles represented by cycle jumps",
        WORK,
        |step| step.dissipated_energy,
    ),
    real(
        "residual",
        "largest of the complementarity, Coulomb and equilibrium residuals, relative",
        RATIO,
        |step| step.residual.largest(),
    ),
    count(
        "convolutions",
        "operator applications, each one fused pass whatever its components",
        NO_UNIT,
        |step| step.work.convolutions,
    ),
    count("preconditioner_passes", "preconditioner applications", NO_UNIT, |step| {
        step.work.preconditioner_passes
    }),
    count("outer_iterations", "changes of the contact, stick and slip zones", NO_UNIT, |step| {
        step.work.outer_iterations
    }),
    real("wall_s", "time spent on the increment", SECONDS, |step| step.wall_s),
    count("contact_cells", "cells in contact", NO_UNIT, |step| step.contact_cells),
    count("stick_cells", "stick cells", NO_UNIT, |step| step.stick_cells),
    word(
        "regime",
        "sliding condition: apart, full_stick, partial_slip, gross_slip or frictionless",
        NO_UNIT,
        |step| regime_word(step.regime),
    ),
    real(
        "full_grid_convolutions",
        "operator applications, each weighted by its fraction of the cells of the whole grid",
        NO_UNIT,
        |step| step.work.full_grid_convolutions,
    ),
    count(
        "parts",
        "number of sub-steps: more than 1 with increments = \"auto\", or where the whole increment did not converge",
        NO_UNIT,
        |step| step.parts,
    ),
    real(
        "worn_volume",
        "wear volume since the start, including the cycles represented by cycle jumps",
        VOLUME,
        |step| step.worn_volume,
    ),
    real("max_worn_depth", "maximum wear depth", LENGTH, |step| step.max_worn_depth),
    real("tilt_x", "slope of the upper body along x, deeper towards positive x", RATIO, |step| step.tilt[0]),
    real("tilt_y", "slope of the upper body along y, deeper towards positive y", RATIO, |step| step.tilt[1]),
    real("tilt_moment_x", "first moment of the pressure along x", WORK, |step| step.tilt_moment[0]),
    real("tilt_moment_y", "first moment of the pressure along y", WORK, |step| step.tilt_moment[1]),
    real("bulk_stress_x", "bulk stress of the lower body along x", PRESSURE, |step| step.bulk_stress[0][0]),
    real("bulk_stress_y", "bulk stress of the lower body along y", PRESSURE, |step| step.bulk_stress[0][1]),
    real("upper_bulk_stress_x", "bulk stress of the upper body along x", PRESSURE, |step| {
        step.bulk_stress[1][0]
    }),
    real("upper_bulk_stress_y", "bulk stress of the upper body along y", PRESSURE, |step| {
        step.bulk_stress[1][1]
    }),
    real(
        "bulk_work",
        "work of the bulk stresses on the contact since the start, including the cycles represented by cycle jumps",
        WORK,
        |step| step.bulk_work,
    ),
    real(
        "actuator_x",
        "tangential displacement of the actuator along x: shift, and force over stiffness of the rig",
        LENGTH,
        |step| step.actuator[0],
    ),
    real("actuator_y", "the same along y", LENGTH, |step| step.actuator[1]),
    real(
        "actuator_approach",
        "normal displacement of the actuator: approach, and force over stiffness of the rig",
        LENGTH,
        |step| step.actuator_approach,
    ),
    real(
        "friction_coefficient",
        "mean friction coefficient over the contact, weighted with the pressure; over all cells where nothing touches",
        RATIO,
        |step| step.friction_coefficient,
    ),
];

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
    real("force_amplitude", "Q*: half the range of the force along it, or of the moment", NO_UNIT, |cycle| {
        cycle.force_amplitude
    }),
    real(
        "displacement_amplitude",
        "delta*: half the range of the relative displacement along it, or of the twist",
        NO_UNIT,
        |cycle| cycle.displacement_amplitude,
    ),
    real("opening", "delta_0: loop half-width at the middle of the force range", NO_UNIT, |cycle| {
        cycle.opening
    }),
    real_or_none("energy_ratio", "A = W_d / (4 Q* delta*)", RATIO, |cycle| cycle.energy_ratio),
    real_or_none("sliding_ratio", "D = delta_0 / delta*", RATIO, |cycle| cycle.sliding_ratio),
    real_or_none("stiffness", "slope of the loop directly after reversal", NO_UNIT, |cycle| cycle.stiffness),
    word("regime", "sliding condition: full_stick, partial_slip, mixed or gross_slip", NO_UNIT, |cycle| {
        cycle.regime.map_or("", cycle_regime_word)
    }),
    real("closure", "cycle-to-cycle change of tractions, forces and motions, relative", RATIO, |cycle| {
        cycle.closure
    }),
    truth("steady", "whether the stage ended here because the cycle is steady", NO_UNIT, |cycle| {
        cycle.steady
    }),
    real("worn_volume", "wear volume since the start of the history", VOLUME, |cycle| cycle.worn_volume),
    real("max_worn_depth", "maximum wear depth after the cycle", LENGTH, |cycle| cycle.max_worn_depth),
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
        NO_UNIT,
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
        NO_UNIT,
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
];

fn regime_word(regime: Regime) -> &'static str {
    match regime {
        Regime::Apart => "apart",
        Regime::FullStick => "full_stick",
        Regime::PartialSlip => "partial_slip",
        Regime::GrossSlip => "gross_slip",
        Regime::Frictionless => "frictionless",
    }
}

fn cycle_regime_word(regime: CycleRegime) -> &'static str {
    match regime {
        CycleRegime::FullStick => "full_stick",
        CycleRegime::PartialSlip => "partial_slip",
        CycleRegime::Mixed => "mixed",
        CycleRegime::GrossSlip => "gross_slip",
    }
}

fn drive_word(drive: Drive) -> &'static str {
    match drive {
        Drive::Tangential => "tangential",
        Drive::Torsional => "torsional",
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use serde_json::json;

    use super::*;

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
            "friction_coefficient": 23.5, "friction_change": 24.5, "jump_error": 25.5,
        });
        serde_json::from_value(all).unwrap()
    }

    #[test]
    fn columns_of_cycles_are_the_entries_of_their_record() {
        let record = cycle();
        let entries = serde_json::to_value(&record).unwrap();
        assert_eq!(names(CYCLE_COLUMNS), entries.as_object().unwrap().keys().map(String::as_str).collect());
        for column in CYCLE_COLUMNS {
            let value = match column.value {
                Value::Count(of) => json!(of(&record)),
                Value::Real(of) => json!(of(&record)),
                Value::RealOrNone(of) => json!(of(&record)),
                Value::Truth(of) => json!(of(&record)),
                Value::Word(of) => json!(of(&record)),
            };
            assert_eq!(value, entries[column.name], "{}", column.name);
        }
    }

    #[test]
    fn words_are_those_that_are_stored() {
        for regime in
            [CycleRegime::FullStick, CycleRegime::PartialSlip, CycleRegime::Mixed, CycleRegime::GrossSlip]
        {
            assert_eq!(json!(cycle_regime_word(regime)), json!(regime));
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
