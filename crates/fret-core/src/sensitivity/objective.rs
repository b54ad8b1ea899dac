//! Of what derivatives are taken: columns of an increment, and of a cycle.

use super::error::SensitivityError;
use super::track::Track;
use crate::fields::{Dual, Reals, Scalar};
use crate::history::{CycleRecord, STEP_COLUMNS, StepRecord, Value};

/// Columns of an increment that have derivatives.
pub const COLUMNS: [&str; 22] = [
    "normal_force",
    "approach",
    "actuator_approach",
    "tangential_force_x",
    "tangential_force_y",
    "shift_x",
    "shift_y",
    "actuator_x",
    "actuator_y",
    "twist_moment",
    "twist",
    "tilt_x",
    "tilt_y",
    "tilt_moment_x",
    "tilt_moment_y",
    "max_pressure",
    "max_shear",
    "dissipated_energy",
    "elastic_energy",
    "external_work",
    "unresolved_energy",
    "friction_coefficient",
];

/// Columns that have none, and why.
const AREAS: [&str; 2] = ["contact_area", "stick_area"];
const OF_AREAS: &str = "an area is found between the cells, to a twentieth of one along its edge: on one grid its derivative scatters by tenths and \
                        is not taken; compare two runs instead, a few per cent apart";

/// What derivatives are taken of.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Objective {
    /// A column of an increment; `None`: of the last one.
    Increment { increment: Option<usize>, column: &'static str },
    /// The energy that friction dissipates in a cycle.
    CycleEnergy { cycle: usize },
}

impl Objective {
    /// From its name: `max_pressure`, `increments[7].shift_x`, `cycles[0].dissipated_energy`.
    pub fn new(name: &str) -> Result<Self, SensitivityError> {
        let refused = |reason: String| SensitivityError::Objective { name: name.to_owned(), reason };
        let column = |column: &str| {
            if AREAS.contains(&column) {
                return Err(refused(OF_AREAS.to_owned()));
            }
            let known = COLUMNS.into_iter().find(|known| *known == column);
            known.ok_or_else(|| {
                refused(format!("no derivative is taken of it; of these one is: {}", COLUMNS.join(", ")))
            })
        };
        let Some((list, rest)) = name.split_once('[') else {
            return Ok(Self::Increment { increment: None, column: column(name)? });
        };
        let form = || refused("written as increments[7].shift_x or cycles[0].dissipated_energy".to_owned());
        let (index, last) = rest.split_once("].").ok_or_else(form)?;
        let index = index.parse().map_err(|_| form())?;
        match list {
            "increments" => Ok(Self::Increment { increment: Some(index), column: column(last)? }),
            "cycles" if last == "dissipated_energy" => Ok(Self::CycleEnergy { cycle: index }),
            "cycles" => Err(refused(
                "of a cycle there is dissipated_energy; take others of its increments".to_owned(),
            )),
            _ => Err(form()),
        }
    }

    /// Increments whose tracks it needs, each with its sign: the value is the sum. `None` stands for the state before the first.
    pub fn needs(
        &self,
        name: &str,
        (steps, cycles): (usize, &[CycleRecord]),
    ) -> Result<Vec<(Option<usize>, f64)>, SensitivityError> {
        let refused = |reason: String| SensitivityError::Objective { name: name.to_owned(), reason };
        match self {
            Self::Increment { increment, .. } => match increment.unwrap_or(steps.saturating_sub(1)) {
                increment if increment < steps => Ok(vec![(Some(increment), 1.0)]),
                _ => Err(refused(format!("the history has {steps} increments, from 0"))),
            },
            Self::CycleEnergy { cycle } => {
                let of = cycles.get(*cycle);
                let of =
                    of.ok_or_else(|| refused(format!("the history has {} cycles, from 0", cycles.len())))?;
                Ok(vec![(Some(of.last_increment), 1.0), (of.first_increment.checked_sub(1), -1.0)])
            }
        }
    }

    /// The column that it is made of.
    pub fn column(&self) -> &'static str {
        match self {
            Self::Increment { column, .. } => column,
            Self::CycleEnergy { .. } => "dissipated_energy",
        }
    }
}

/// Value of a column in a record.
pub(super) fn value_of(record: &StepRecord, column: &str) -> f64 {
    let found = STEP_COLUMNS.iter().find(|known| known.name == column);
    match found.map(|column| &column.value) {
        Some(Value::Real(value)) => value(record),
        _ => f64::NAN,
    }
}

/// Derivative of a column of the increment that a track has reached; `friction`: that of the coefficient in force.
pub(super) fn change_of(track: &Track, (column, friction): (&str, f64)) -> f64 {
    let [normal, x, y, turn, tilt_x, tilt_y] = &track.reached;
    let [dissipated, elastic, external, unresolved] = track.energies;
    let dual = match column {
        "normal_force" => normal.force,
        "approach" => normal.motion,
        "actuator_approach" => normal.far_end,
        "tangential_force_x" => x.force,
        "tangential_force_y" => y.force,
        "shift_x" => x.motion,
        "shift_y" => y.motion,
        "actuator_x" => x.far_end,
        "actuator_y" => y.far_end,
        "twist_moment" => turn.force,
        "twist" => turn.motion,
        "tilt_x" => tilt_x.motion,
        "tilt_y" => tilt_y.motion,
        "tilt_moment_x" => tilt_x.force,
        "tilt_moment_y" => tilt_y.force,
        "max_pressure" => largest(track.pressure.iter().copied()),
        "max_shear" => {
            let sizes = track.shear[0].iter().zip(&track.shear[1]);
            largest(sizes.map(|(x, y)| Reals::sqrt(*x * *x + *y * *y)))
        }
        "dissipated_energy" => dissipated,
        "elastic_energy" => elastic,
        "external_work" => external,
        "unresolved_energy" => unresolved,
        "friction_coefficient" => return friction,
        // Nothing wears in the histories whose derivatives are taken.
        _ => return 0.0,
    };
    dual.change
}

fn largest(values: impl Iterator<Item = Dual>) -> Dual {
    values.fold(Dual::of(0.0), |most, value| if value.value > most.value { value } else { most })
}
