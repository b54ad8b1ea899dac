//! Of what derivatives are taken: columns of an increment, and of a cycle.

use super::beneath::{Number, constants_for_fatigue, side_of};
use super::change::Change;
use super::error::SensitivityError;
use super::field_weights::{RegionWeights, SLIP};
use super::solved::Solved;
use crate::fields::{add_scaled, dot, length, sum};
use crate::history::{CycleRecord, STEP_COLUMNS, StepRecord, Value};
use crate::model::Body;
use crate::plan::Plan;
use crate::subsurface::Measure;
use crate::subsurface::fatigue::Parameter;
use crate::subsurface::severity::constants_of;

/// Columns of an increment that have derivatives.
pub const COLUMNS: [&str; 24] = [
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
    "worn_volume",
    "max_worn_depth",
];

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
    /// The energy that friction dissipates in a cycle.
    CycleEnergy { cycle: usize },
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
            "cycles" if last == "dissipated_energy" => Ok(Self::CycleEnergy { cycle: index }),
            "cycles" => fatigue(Some(index), last).unwrap_or_else(|| {
                let of = "of a cycle there are dissipated_energy and fatigue.crossland, ...; take others of its increments";
                Err(refused(of.to_owned()))
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
            Self::CycleEnergy { cycle } => {
                let of = cycles.get(*cycle);
                let of =
                    of.ok_or_else(|| refused(format!("the history has {} cycles, from 0", cycles.len())))?;
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
            Self::Increment { .. } | Self::CycleEnergy { .. } => Ok(None),
            Self::Stress { increment, measure } => match increment.unwrap_or(steps.saturating_sub(1)) {
                increment if increment < steps => Ok(Some(Number::Measure { measure, increment })),
                _ => Err(refused(format!("the history has {steps} increments, from 0"))),
            },
            Self::Fatigue { cycle, .. } | Self::Ruiz { cycle, .. } => {
                let of = cycle.map_or(cycles.last(), |cycle| cycles.get(cycle));
                let of =
                    of.ok_or_else(|| refused(format!("the history has {} cycles, from 0", cycles.len())))?;
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
            Self::Increment { .. } | Self::CycleEnergy { .. } => None,
        }
    }

    /// The column that it is made of; of a number of the stress what that is called.
    pub fn column(&self) -> &'static str {
        match self {
            Self::Increment { column, .. } => column,
            Self::CycleEnergy { .. } => "dissipated_energy",
            Self::Stress { measure, .. } => measure.name(),
            Self::Fatigue { parameter, .. } => parameter.name(),
            Self::Ruiz { with_tension, .. } => RUIZ[usize::from(*with_tension)],
        }
    }
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

/// Value of a column in a record.
pub(super) fn value_of(record: &StepRecord, column: &str) -> f64 {
    let found = STEP_COLUMNS.iter().find(|known| known.name == column);
    match found.map(|column| &column.value) {
        Some(Value::Real(value)) => value(record),
        _ => f64::NAN,
    }
}

/// What derivatives are taken of in an increment.
#[derive(Debug, Clone)]
pub(super) enum Column {
    /// A column of its record.
    Named(&'static str),
    /// The sum of a field, each cell times its weight in the region.
    Field(RegionWeights),
}

/// A column of an increment as a row: what it is of all that changes there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Row<'a> {
    /// Force, motion or motion of the far end of a degree of freedom.
    Reached(usize, usize),
    /// An energy.
    Energy(usize),
    /// The pressure of a cell.
    Pressure(usize),
    /// The shear of a cell, along a direction.
    Shear(usize, [f64; 2]),
    /// Pressure (0), shear along x or y (1, 2) or slip of the increment (3, 4) of all cells, each by a weight.
    Field(usize, &'a [f64]),
    /// The friction coefficient in force.
    Friction,
    /// The worn depth of a cell.
    Worn(usize),
    /// The worn volume, with the area that a cell stands for.
    WornVolume(f64),
    /// Nothing.
    Nothing,
}

impl<'a> Row<'a> {
    /// That of a column of an increment.
    pub fn new(column: &'a Column, solved: &Solved) -> Self {
        let column = match column {
            Column::Named(column) => *column,
            Column::Field(of) => return Self::Field(of.field, &of.weights),
        };
        match column {
            "normal_force" => Self::Reached(0, 0),
            "approach" => Self::Reached(0, 1),
            "actuator_approach" => Self::Reached(0, 2),
            "tangential_force_x" => Self::Reached(1, 0),
            "tangential_force_y" => Self::Reached(2, 0),
            "shift_x" => Self::Reached(1, 1),
            "shift_y" => Self::Reached(2, 1),
            "actuator_x" => Self::Reached(1, 2),
            "actuator_y" => Self::Reached(2, 2),
            "twist_moment" => Self::Reached(3, 0),
            "twist" => Self::Reached(3, 1),
            "tilt_x" => Self::Reached(4, 1),
            "tilt_y" => Self::Reached(5, 1),
            "tilt_moment_x" => Self::Reached(4, 0),
            "tilt_moment_y" => Self::Reached(5, 0),
            "max_pressure" => {
                let pressed = solved.contact.cells().map(|cell| (cell, solved.tractions[0][cell]));
                largest(pressed).map_or(Self::Nothing, Self::Pressure)
            }
            "max_shear" => {
                let size = |cell: usize| (cell, length(solved.shear_at(cell)));
                largest(solved.contact.cells().map(size)).map_or(Self::Nothing, |cell| {
                    let shear = solved.shear_at(cell);
                    Self::Shear(cell, shear.map(|part| part / length(shear)))
                })
            }
            "dissipated_energy" => Self::Energy(0),
            "elastic_energy" => Self::Energy(1),
            "external_work" => Self::Energy(2),
            "unresolved_energy" => Self::Energy(3),
            "friction_coefficient" => Self::Friction,
            "worn_volume" => Self::WornVolume(solved.area),
            "max_worn_depth" => {
                largest(solved.worn.iter().copied().enumerate()).map_or(Self::Nothing, Self::Worn)
            }
            _ => Self::Nothing,
        }
    }

    /// Its change; `friction`: that of the coefficient in force.
    pub fn change(&self, change: &Change, friction: f64) -> f64 {
        match *self {
            Self::Reached(freedom, what) => change.reached[freedom][what],
            Self::Energy(energy) => change.energies[energy],
            Self::Pressure(cell) => change.pressure[cell],
            Self::Shear(cell, along) => along[0] * change.shear[0][cell] + along[1] * change.shear[1][cell],
            Self::Field(0, weights) => dot(weights, &change.pressure),
            Self::Field(field, weights) if field >= SLIP => dot(weights, &change.slip[field - SLIP]),
            Self::Field(component, weights) => dot(weights, &change.shear[component - 1]),
            Self::Friction => friction,
            Self::Worn(cell) => change.worn[cell],
            Self::WornVolume(area) => area * sum(&change.worn),
            Self::Nothing => 0.0,
        }
    }

    /// Backwards: adds what it counts, by a weight.
    pub fn add(&self, weight: f64, to: &mut Change, friction: &mut f64) {
        match *self {
            Self::Reached(freedom, what) => to.reached[freedom][what] += weight,
            Self::Energy(energy) => to.energies[energy] += weight,
            Self::Pressure(cell) => to.pressure[cell] += weight,
            Self::Shear(cell, along) => {
                to.shear[0][cell] += weight * along[0];
                to.shear[1][cell] += weight * along[1];
            }
            Self::Field(0, weights) => add_scaled(&mut to.pressure, weight, weights),
            Self::Field(field, weights) if field >= SLIP => {
                add_scaled(&mut to.slip[field - SLIP], weight, weights);
            }
            Self::Field(component, weights) => add_scaled(&mut to.shear[component - 1], weight, weights),
            Self::Friction => *friction += weight,
            Self::Worn(cell) => to.worn[cell] += weight,
            Self::WornVolume(area) => to.worn.iter_mut().for_each(|worn| *worn += weight * area),
            Self::Nothing => {}
        }
    }
}

/// The first cell with the largest number, where one is positive.
fn largest(numbers: impl Iterator<Item = (usize, f64)>) -> Option<usize> {
    let (mut most, mut at) = (0.0, None);
    for (cell, number) in numbers {
        if number > most {
            (most, at) = (number, Some(cell));
        }
    }
    at
}
