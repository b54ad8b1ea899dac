//! Columns of an increment as rows: what each is of all that changes there.

use super::change::{Change, DISSIPATED, EXTERNAL, OF_BULK, OF_WEAR, STORED, UNRESOLVED};
use super::field_weights::{RegionWeights, SLIP, WORN};
use super::solved::Solved;
use crate::fields::{add_scaled, dot, length, sum};
use crate::history::{STEP_COLUMNS, StepRecord};

/// Value of a column in a record; `None` where it has none.
pub(super) fn value_of(record: &StepRecord, column: &str) -> Option<f64> {
    STEP_COLUMNS.iter().find(|known| known.name == column)?.number(record)
}

/// What derivatives are taken of in an increment.
#[derive(Debug, Clone)]
pub(super) enum Column {
    /// A column of its record.
    Named(&'static str),
    /// The sum of a field, each cell times its weight in the region.
    Field(RegionWeights),
    /// The sum of a bulk stress along x, whose degree of freedom is given, and along y, each times its weight.
    Bulk(usize, [f64; 2]),
}

impl Column {
    /// Whether a part of an increment that ends it, or else another one, has something of the column: slip is that of all parts.
    pub fn is_in_part(&self, ends_increment: bool) -> bool {
        ends_increment || matches!(self, Self::Field(of) if (SLIP..WORN).contains(&of.field))
    }
}

/// A result that is made of columns of increments: its value, how it changes with each of them, and how, beside these, with each of the parameters.
#[derive(Debug, Clone)]
pub(super) struct Composed {
    pub value: f64,
    pub columns: Vec<(usize, Column, f64)>,
    pub by: Vec<f64>,
}

/// A column of an increment as a row: what it is of all that changes there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Row<'a> {
    /// Force, motion or motion of the far end of a degree of freedom.
    Reached(usize, usize),
    /// An energy, by its place.
    Energy(usize),
    /// The pressure of a cell.
    Pressure(usize),
    /// The shear of a cell, along a direction.
    Shear(usize, [f64; 2]),
    /// Pressure (0), shear along x or y (1, 2), slip of the increment (3, 4) or wear depth (5) of all cells, each by a weight.
    Field(usize, &'a [f64]),
    /// The bulk stress of a degree of freedom and that of the next, each by a weight.
    Bulk(usize, [f64; 2]),
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
            Column::Bulk(first, weights) => return Self::Bulk(*first, *weights),
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
            "dissipated_energy" => Self::Energy(DISSIPATED),
            "elastic_energy" => Self::Energy(STORED),
            "external_work" => Self::Energy(EXTERNAL),
            "unresolved_energy" => Self::Energy(UNRESOLVED),
            "wear_work" => Self::Energy(OF_WEAR),
            "bulk_work" => Self::Energy(OF_BULK),
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
            Self::Field(WORN, weights) => dot(weights, &change.worn),
            Self::Field(field, weights) if field >= SLIP => dot(weights, &change.slip[field - SLIP]),
            Self::Field(component, weights) => dot(weights, &change.shear[component - 1]),
            Self::Bulk(first, [x, y]) => x * change.held[first] + y * change.held[first + 1],
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
            Self::Field(WORN, weights) => add_scaled(&mut to.worn, weight, weights),
            Self::Field(field, weights) if field >= SLIP => {
                add_scaled(&mut to.slip[field - SLIP], weight, weights);
            }
            Self::Field(component, weights) => add_scaled(&mut to.shear[component - 1], weight, weights),
            Self::Bulk(first, [x, y]) => {
                to.held[first] += weight * x;
                to.held[first + 1] += weight * y;
            }
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
