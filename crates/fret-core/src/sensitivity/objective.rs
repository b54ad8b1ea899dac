//! Of what derivatives are taken: columns of an increment, and of a cycle.

use super::beneath::{Number, constants_for_fatigue, side_of};
use super::cycle_loop;
use super::error::SensitivityError;
use crate::history::CycleRecord;
use crate::model::Body;
use crate::plan::Plan;
use crate::subsurface::Measure;
use crate::subsurface::fatigue::Parameter;
use crate::subsurface::severity::constants_of;

/// Columns of an increment that have derivatives.
pub const COLUMNS: [&str; 26] = [
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
    "wear_work",
    "bulk_work",
    "friction_coefficient",
    "worn_volume",
    "max_worn_depth",
];

/// Columns of a cycle that have derivatives, beside those of its loop ([`cycle_loop::COLUMNS`]): sums of such of its increments.
const OF_CYCLES: [&str; 5] =
    ["dissipated_energy", "total_dissipated_energy", "worn_volume", "max_worn_depth", "friction_coefficient"];

/// Ruiz's parameters.
const RUIZ: [&str; 2] = ["ruiz_f1", "ruiz_f2"];

/// Columns that have none, and why.
const AREAS: [&str; 2] = ["contact_area", "stick_area"];
const OF_AREAS: &str = "an area is found between the cells, to a twentieth of one along its edge: on one grid its derivative scatters by tenths and \
                        is not taken; compare two runs instead, a few per cent apart";

/// What derivatives are taken of.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Objective {
    /// A column of an increment; `None`: of the last one.
    Increment { increment: Option<usize>, column: &'static str },
    /// A column of a cycle.
    Cycle { cycle: usize, column: &'static str },
    /// The largest value of a measure of the stress below the surface, in an increment; `None`: in the last one.
    Stress { increment: Option<usize>, measure: Measure },
    /// The largest value of a fatigue parameter below the surface, over a cycle; `None`: over the last one.
    Fatigue { cycle: Option<usize>, parameter: Parameter },
    /// The largest of Ruiz's parameters at the surface over a cycle, the second with the tension; `None`: over the last one.
    Ruiz { cycle: Option<usize>, with_tension: bool },
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
                refused(format!("{}, stress.von_mises, fatigue.crossland, ...", none_of(COLUMNS)))
            })
        };
        let stress = |increment: Option<usize>, of: &str| {
            let of = of.strip_prefix("stress.")?;
            Some(match Measure::ALL.into_iter().find(|known| known.name() == of) {
                Some(measure) => Ok(Self::Stress { increment, measure }),
                None => Err(refused(none_of(Measure::ALL.map(Measure::name)))),
            })
        };
        let fatigue = |cycle: Option<usize>, of: &str| {
            let of = of.strip_prefix("fatigue.")?;
            if let Some(place) = RUIZ.into_iter().position(|known| known == of) {
                return Some(Ok(Self::Ruiz { cycle, with_tension: place == 1 }));
            }
            Some(match Parameter::ALL.into_iter().find(|known| known.name() == of) {
                Some(parameter) => Ok(Self::Fatigue { cycle, parameter }),
                None => Err(refused(format!(
                    "{}, {}",
                    none_of(Parameter::ALL.map(Parameter::name)),
                    RUIZ.join(", ")
                ))),
            })
        };
        let Some((list, rest)) = name.split_once('[') else {
            return match stress(None, name).or_else(|| fatigue(None, name)) {
                Some(below) => below,
                None => Ok(Self::Increment { increment: None, column: column(name)? }),
            };
        };
        let form = || refused("written as increments[7].shift_x or cycles[0].dissipated_energy".to_owned());
        let (index, last) = rest.split_once("].").ok_or_else(form)?;
        let index = index.parse().map_err(|_| form())?;
        match list {
            "increments" => match stress(Some(index), last) {
                Some(below) => below,
                None => Ok(Self::Increment { increment: Some(index), column: column(last)? }),
            },
            "cycles" => fatigue(Some(index), last).unwrap_or_else(|| {
                let known = OF_CYCLES.into_iter().chain(cycle_loop::COLUMNS);
                let column = known.clone().find(|known| *known == last);
                let column = column.map(|column| Self::Cycle { cycle: index, column });
                let all = known.collect::<Vec<_>>().join(", ");
                column.ok_or_else(|| {
                    refused(format!(
                        "of a cycle there are {all}, fatigue.crossland, ...; take others of its increments"
                    ))
                })
            }),
            _ => Err(form()),
        }
    }

    /// Increments that it needs, each with its sign: the value is the sum. `None` stands for the state before the first.
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
            Self::Cycle { column, .. } if cycle_loop::COLUMNS.contains(column) => Ok(Vec::new()),
            Self::Cycle { cycle, column } => {
                let of = cycle_of(cycles, *cycle).map_err(refused)?;
                if *column != "dissipated_energy" {
                    return Ok(vec![(Some(of.last_increment), 1.0)]);
                }
                // It is dissipated as often as there are cycles that it stands for.
                let each = 1.0 / of.stands_for as f64;
                Ok(vec![(Some(of.last_increment), each), (of.first_increment.checked_sub(1), -each)])
            }
            Self::Stress { .. } | Self::Fatigue { .. } | Self::Ruiz { .. } => Ok(Vec::new()),
        }
    }

    /// The number of the stress below the surface that it is, if it is one.
    pub fn below(
        &self,
        name: &str,
        (steps, cycles): (usize, &[CycleRecord]),
    ) -> Result<Option<Number>, SensitivityError> {
        let refused = |reason: String| SensitivityError::Objective { name: name.to_owned(), reason };
        match *self {
            Self::Increment { .. } | Self::Cycle { .. } => Ok(None),
            Self::Stress { increment, measure } => match increment.unwrap_or(steps.saturating_sub(1)) {
                increment if increment < steps => Ok(Some(Number::Measure { measure, increment })),
                _ => Err(refused(format!("the history has {steps} increments, from 0"))),
            },
            Self::Fatigue { cycle, .. } | Self::Ruiz { cycle, .. } => {
                let last = cycles.len().saturating_sub(1);
                let of = cycle_of(cycles, cycle.unwrap_or(last)).map_err(refused)?;
                // With the state that the cycle starts from, where there is one.
                let increments = of.first_increment.saturating_sub(1)..=of.last_increment;
                Ok(Some(match *self {
                    Self::Fatigue { parameter, .. } => Number::Fatigue { parameter, increments },
                    _ => Number::Ruiz {
                        with_tension: matches!(self, Self::Ruiz { with_tension: true, .. }),
                        increments,
                    },
                }))
            }
        }
    }

    /// The column of increments that it is a sum of.
    pub fn column_of_increments(&self) -> &'static str {
        match self {
            Self::Cycle { column: "total_dissipated_energy", .. } => "dissipated_energy",
            _ => self.column(),
        }
    }

    /// The cycle and the number of its loop that it is, if it is one.
    pub fn of_loop<'a>(
        &self,
        name: &str,
        cycles: &'a [CycleRecord],
    ) -> Result<Option<(&'a CycleRecord, &'static str)>, SensitivityError> {
        let Self::Cycle { cycle, column } = self else { return Ok(None) };
        if !cycle_loop::COLUMNS.contains(column) {
            return Ok(None);
        }
        let refused = |reason| SensitivityError::Objective { name: name.to_owned(), reason };
        Ok(Some((cycle_of(cycles, *cycle).map_err(refused)?, column)))
    }

    /// Whether the slip of increments is needed for it.
    pub fn needs_slip(&self) -> bool {
        match self {
            Self::Ruiz { .. } => true,
            Self::Cycle { column, .. } => cycle_loop::COLUMNS.contains(column),
            _ => false,
        }
    }

    /// Whether it is a number of the stress below the surface.
    pub fn is_below(&self) -> bool {
        matches!(self, Self::Stress { .. } | Self::Fatigue { .. } | Self::Ruiz { .. })
    }

    /// Why the bodies of a plan have no such number of the stress below the surface, if they have none.
    pub fn missing_below(&self, plan: &Plan) -> Option<String> {
        let side = side_of(plan);
        let (name, body) = (side.name(), side.of(&plan.case.bodies));
        let Body::Elastic(half_space) = body else {
            return Some(format!("the {name} body is rigid: there is no stress in it"));
        };
        match self {
            Self::Stress { measure, .. } => {
                let lacks = measure.at_interfaces_only() && half_space.coatings().is_empty();
                lacks.then(|| format!("the {name} body has no coating, and so no interface"))
            }
            Self::Fatigue { parameter, .. } => {
                let constants = constants_for_fatigue(plan, side);
                let is_given =
                    |layer: usize| parameter.is_given(&constants_of(half_space, &constants, layer));
                let lacks = !(0..=half_space.coatings().len()).any(is_given);
                lacks.then(|| {
                    format!("the {name} body lacks the constants for it, yield strength or fatigue limits")
                })
            }
            Self::Ruiz { .. } => plan
                .case
                .is_frictionless()
                .then(|| "without friction there is neither shear nor slip".to_owned()),
            Self::Increment { .. } | Self::Cycle { .. } => None,
        }
    }

    /// The column that it is made of; of a number of the stress what that is called.
    pub fn column(&self) -> &'static str {
        match self {
            Self::Increment { column, .. } | Self::Cycle { column, .. } => column,
            Self::Stress { measure, .. } => measure.name(),
            Self::Fatigue { parameter, .. } => parameter.name(),
            Self::Ruiz { with_tension, .. } => RUIZ[usize::from(*with_tension)],
        }
    }
}

/// A cycle of a history, or that there is none such.
fn cycle_of(cycles: &[CycleRecord], cycle: usize) -> Result<&CycleRecord, String> {
    cycles.get(cycle).ok_or_else(|| format!("the history has {} cycles, from 0", cycles.len()))
}

/// That a name is none of those known.
fn none_of<const N: usize>(known: [&str; N]) -> String {
    format!("no derivative is taken of it; of these one is: {}", known.join(", "))
}

/// Whether a name is one of a result that has derivatives; whether the history has it is for the run to say.
///
/// # Errors
/// When it is none, with those that are.
pub fn check_name(name: &str) -> Result<(), SensitivityError> {
    Objective::new(name).map(drop)
}
