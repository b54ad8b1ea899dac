//! The vocabulary of the tables: every column of increments and of cycles with its name, its meaning, its unit and its value. The
//! files of the command, the Python package and the reference page are made from it, so a new column is a line here.

use super::cycle::Drive;
use super::records::StepRecord;
use crate::solver::Regime;

pub(super) const NO_UNIT: &str = "";
pub(super) const RATIO: &str = "-";
pub(super) const ANGLE: &str = "rad";
const SECONDS: &str = "s";
pub(super) const LENGTH: &str = "length";
const AREA: &str = "length^2";
pub(super) const VOLUME: &str = "length^3";
pub(super) const FORCE: &str = "force";
pub(super) const STIFFNESS: &str = "force/length";
pub(super) const WORK: &str = "force x length";
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
    /// The same of a contact that turns about its normal, where that is another: a loop of twist and moment has no force.
    pub turning: Option<&'static str>,
    /// Its value in a record.
    pub value: Value<R>,
}

impl<R> Column<R> {
    /// Its value in a record, where it is a real number that this has.
    pub fn number(&self, record: &R) -> Option<f64> {
        match self.value {
            Value::Real(value) => Some(value(record)),
            Value::RealOrNone(value) | Value::RealOrZero(value) => value(record),
            _ => None,
        }
    }

    /// Its value in a record as files in JSON have it; null where the record lacks a number.
    pub fn json(&self, record: &R) -> serde_json::Value {
        match self.value {
            Value::Count(of) => of(record).into(),
            Value::Real(of) => of(record).into(),
            Value::RealOrNone(of) | Value::RealOrZero(of) => of(record).into(),
            Value::Truth(of) => of(record).into(),
            Value::Word(of) => of(record).into(),
        }
    }

    /// Its unit where all rows are driven so; empty where some rows are driven otherwise (`None`) and it has another unit there.
    pub fn unit_driven(&self, drive: Option<Drive>) -> &'static str {
        match (self.turning, drive) {
            (None, _) | (_, Some(Drive::Tangential)) => self.unit,
            (Some(turning), Some(Drive::Torsional)) => turning,
            (Some(_), None) => NO_UNIT,
        }
    }
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
    /// The same, of what happens while a contact rolls: tables of numbers have 0 where it does not.
    RealOrZero(fn(&R) -> Option<f64>),
    /// Yes or no.
    Truth(fn(&R) -> bool),
    /// A word, empty where a record lacks it.
    Word(fn(&R) -> &'static str),
}

/// A column with another unit where the contact turns.
pub(super) const fn or_turning<R>(turning: &'static str, column: Column<R>) -> Column<R> {
    let Column { name, meaning, unit, value, .. } = column;
    Column { name, meaning, unit, turning: Some(turning), value }
}

pub(super) const fn count<R>(
    name: &'static str,
    meaning: &'static str,
    unit: &'static str,
    value: fn(&R) -> usize,
) -> Column<R> {
    Column { name, meaning, unit, turning: None, value: Value::Count(value) }
}

pub(super) const fn real<R>(
    name: &'static str,
    meaning: &'static str,
    unit: &'static str,
    value: fn(&R) -> f64,
) -> Column<R> {
    Column { name, meaning, unit, turning: None, value: Value::Real(value) }
}

pub(super) const fn real_or_none<R>(
    name: &'static str,
    meaning: &'static str,
    unit: &'static str,
    value: fn(&R) -> Option<f64>,
) -> Column<R> {
    Column { name, meaning, unit, turning: None, value: Value::RealOrNone(value) }
}

const fn real_or_zero<R>(
    name: &'static str,
    meaning: &'static str,
    unit: &'static str,
    value: fn(&R) -> Option<f64>,
) -> Column<R> {
    Column { name, meaning, unit, turning: None, value: Value::RealOrZero(value) }
}

pub(super) const fn truth<R>(
    name: &'static str,
    meaning: &'static str,
    unit: &'static str,
    value: fn(&R) -> bool,
) -> Column<R> {
    Column { name, meaning, unit, turning: None, value: Value::Truth(value) }
}

pub(super) const fn word<R>(
    name: &'static str,
    meaning: &'static str,
    unit: &'static str,
    value: fn(&R) -> &'static str,
) -> Column<R> {
    Column { name, meaning, unit, turning: None, value: Value::Word(value) }
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
    real(
        "twist_moment",
        "moment about z on the lower body, about the middle of the grid; of a contact that rolls, or an upper body that moves, about its own",
        WORK,
        |step| step.twist_moment,
    ),
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
    count(
        "outer_iterations",
        "Newton iterations, without coupling with those of the pressure",
        NO_UNIT,
        |step| step.work.outer_iterations,
    ),
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
        "number of sub-steps: more than 1 with increments = \"auto\", where bodies that were apart come to touch in a linear ramp, on the way to a steady state of rolling, or where the whole increment did not converge",
        NO_UNIT,
        |step| step.parts,
    ),
    real(
        "worn_volume",
        "wear volume since the start, including the cycles represented by cycle jumps",
        VOLUME,
        |step| step.worn_volume,
    ),
    real(
        "max_worn_depth",
        "maximum wear depth of both bodies together; with finite displacement the larger one of the bodies' own",
        LENGTH,
        |step| step.max_worn_depth,
    ),
    real("tilt_x", "slope of the upper body along x, deeper towards positive x", RATIO, |step| step.tilt[0]),
    real("tilt_y", "slope of the upper body along y, deeper towards positive y", RATIO, |step| step.tilt[1]),
    real(
        "tilt_moment_x",
        "first moment of the pressure along x, about the middle of the contact where it rolls",
        WORK,
        |step| step.tilt_moment[0],
    ),
    real(
        "tilt_moment_y",
        "first moment of the pressure along y, about the middle of the contact where it rolls",
        WORK,
        |step| step.tilt_moment[1],
    ),
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
    real(
        "elastic_energy",
        "elastic energy that the tractions of the contact store in the bodies and the interface, of a line contact and one that is periodic along one axis relative to the datum",
        WORK,
        |step| step.elastic_energy,
    ),
    real(
        "external_work",
        "work of forces, moments and bulk stresses, and of surfaces that move, on the contact since the start; its change is that of elastic_energy, dissipated_energy, wear_work, plastic_work and unresolved_energy together",
        WORK,
        |step| step.external_work,
    ),
    real("wear_work", "energy that has gone with what wore off since the start", WORK, |step| step.wear_work),
    real(
        "unresolved_energy",
        "what increments of finite length leave unresolved of the energy balance since the start, an error bar of dissipated_energy",
        WORK,
        |step| step.unresolved_energy,
    ),
    real("roll_x", "distance that the contact has rolled along x", LENGTH, |step| step.roll[0]),
    real("roll_y", "distance that the contact has rolled along y", LENGTH, |step| step.roll[1]),
    real_or_zero(
        "creepage_x",
        "displacement of the upper body along x by distance rolled; 0 where it does not roll",
        RATIO,
        |step| step.creepage.map(|creepage| creepage[0]),
    ),
    real_or_zero("creepage_y", "the same along y", RATIO, |step| step.creepage.map(|creepage| creepage[1])),
    real_or_zero(
        "spin",
        "rotation of the upper body by distance rolled; 0 where it does not roll",
        "rad/length",
        |step| step.spin,
    ),
    real_or_zero(
        "rolling_friction",
        "energy that friction dissipates in the increment by distance rolled; 0 where it does not roll",
        FORCE,
        |step| step.rolling_friction,
    ),
    real("debris_volume", "debris between the surfaces, with wear.debris", VOLUME, |step| step.debris.volume),
    real(
        "debris_outflow",
        "debris that has flowed out of the contact since the start, including the cycles represented by cycle jumps",
        VOLUME,
        |step| step.debris.outflow,
    ),
    real("max_debris", "maximum thickness of the debris", LENGTH, |step| step.debris.max_thickness),
    real_or_none("mean_gap", "mean gap between surfaces that repeat", LENGTH, |step| step.mean_gap),
    real("yielded_area", "area of the cells whose pressure is at the hardness", AREA, |step| {
        step.plastic.area
    }),
    real("plastic_volume", "plastic depth summed over the surface", VOLUME, |step| step.plastic.volume),
    real("max_plastic_depth", "maximum plastic depth", LENGTH, |step| step.plastic.max_depth),
    real(
        "plastic_work",
        "work that yielding has taken since the start: hardness times plastic volume",
        WORK,
        |step| step.plastic.work,
    ),
];

impl<R: 'static> Column<R> {
    /// Its name as a person reads it.
    pub fn in_words(&self) -> String {
        self.name.replace('_', " ")
    }
}

/// A column of what happens while a contact rolls, with its value in a record, which one of a contact that does not roll lacks.
pub type RollingColumn = (&'static Column<StepRecord>, fn(&StepRecord) -> Option<f64>);

/// Those columns, in their order: creepage, spin and friction by distance rolled.
pub fn rolling_columns() -> impl Iterator<Item = RollingColumn> {
    STEP_COLUMNS.iter().filter_map(|column| match column.value {
        Value::RealOrZero(of) => Some((column, of)),
        _ => None,
    })
}

pub(super) fn regime_word(regime: Regime) -> &'static str {
    match regime {
        Regime::Apart => "apart",
        Regime::FullStick => "full_stick",
        Regime::PartialSlip => "partial_slip",
        Regime::GrossSlip => "gross_slip",
        Regime::Frictionless => "frictionless",
    }
}

#[cfg(test)]
mod tests {
    use super::STEP_COLUMNS;
    use crate::model::controls::ways;

    /// So that a table of loads can be a table of results.
    #[test]
    fn every_control_is_a_column_with_its_name_and_unit() {
        for (row, way) in ways() {
            for (name, _) in row.columns(way) {
                let column = STEP_COLUMNS.iter().find(|column| column.name == name);
                assert_eq!(column.map(|column| column.unit), Some(way.unit), "{name}");
            }
        }
    }
}
