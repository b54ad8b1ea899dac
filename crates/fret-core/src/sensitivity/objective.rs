//! Of what derivatives are taken: columns of an increment, and of a cycle.

use super::error::SensitivityError;
use super::scene::Scene;
use super::track::Track;
use crate::fields::{Dual, Reals, Scalar};
use crate::history::{CycleRecord, STEP_COLUMNS, StepRecord, Value};
use crate::solver::contact_cells;

/// Columns of an increment that have derivatives.
pub const COLUMNS: [&str; 27] = [
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
    "contact_area",
    "stick_area",
    "dissipated_energy",
    "elastic_energy",
    "external_work",
    "unresolved_energy",
    "friction_coefficient",
    "wear_work",
    "worn_volume",
    "max_worn_depth",
];

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
            let known = COLUMNS.into_iter().find(|known| *known == column);
            known.ok_or_else(|| refused(format!("no such result; there are: {}", COLUMNS.join(", "))))
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
            "cycles" => Err(refused("of a cycle there is dissipated_energy; take others of its increments".to_owned())),
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
                let of = of.ok_or_else(|| refused(format!("the history has {} cycles, from 0", cycles.len())))?;
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
pub(super) fn change_of(track: &Track, scene: &Scene<'_>, record: &StepRecord, (column, friction): (&str, f64)) -> f64 {
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
        "contact_area" => Dual::of(0.0).mapped_by(change_of_area(track, scene)),
        "stick_area" => {
            let fraction = record.stick_cells as f64 / record.contact_cells.max(1) as f64;
            Dual::of(0.0).mapped_by(change_of_area(track, scene) * fraction)
        }
        "dissipated_energy" => dissipated,
        "elastic_energy" => elastic,
        "external_work" => external,
        "unresolved_energy" => unresolved,
        "friction_coefficient" => Dual::of(0.0).mapped_by(friction),
        // Nothing wears in the histories whose derivatives are taken.
        _ => Dual::of(0.0),
    };
    dual.change
}

impl Dual {
    /// The same number with another derivative.
    fn mapped_by(self, change: f64) -> Self {
        Self::new(self.value, change)
    }
}

fn largest(values: impl Iterator<Item = Dual>) -> Dual {
    values.fold(Dual::of(0.0), |most, value| if value.value > most.value { value } else { most })
}

/// Derivative of the contact area. It is an explicit function of the pressure and the gap on either side of the edge, with medians and roots
/// in it: the difference along the known changes of both, of fourth order in a step that moves the edge by a ten-thousandth of a cell or so.
fn change_of_area(track: &Track, scene: &Scene<'_>) -> f64 {
    let shape = scene.region.shape;
    let symmetry = scene.plan.symmetry;
    let axes = symmetry.axes();
    let mirrored = [0, 1].map(|axis| axes[axis] && scene.region.origin[axis] == 0);
    let relative = |values: &mut dyn Iterator<Item = &Dual>| {
        let (mut value, mut change) = (0.0_f64, 0.0_f64);
        for dual in values {
            value = value.max(dual.value.abs());
            change = change.max(dual.change.abs());
        }
        if value > 0.0 { change / value } else { 0.0 }
    };
    let near = |gap: &&Dual| gap.value.abs() < scene.beyond_the_body();
    let size = relative(&mut track.pressure.iter()).max(relative(&mut track.gap.iter().filter(near)));
    if !(size > 0.0) {
        return 0.0;
    }
    let step = 1e-5 / size;
    let area = |step: f64| {
        let moved = |dual: &Dual| dual.value + step * dual.change;
        let pressure: Vec<f64> = track.pressure.iter().map(moved).collect();
        let pressure = ndarray::Array2::from_shape_vec(shape, pressure).unwrap_or_default();
        let gap = track.gap.map(moved);
        contact_cells(&pressure.view(), &gap.view(), scene.beyond_the_body(), mirrored)
    };
    let slope = |step: f64| (area(step) - area(-step)) / (2.0 * step);
    (4.0 * slope(step) - slope(2.0 * step)) / 3.0 * scene.area()
}
