//! The largest of each number over depths, cells and increments, with its place.

use ndarray::{Array2, Axis};
use serde::Serialize;

use super::depths::DepthPoint;
use super::rim::at_rims;
use super::tensor::{StressField, StressTensor};

/// What is looked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Measure {
    /// Von Mises equivalent stress.
    VonMises,
    /// Tresca equivalent stress.
    Tresca,
    /// Largest tensile principal stress: where coatings crack.
    Tension,
    /// Largest hydrostatic tension.
    Hydrostatic,
    /// At interfaces alone: shear traction.
    InterfaceShear,
    /// At interfaces alone: tension across the interface, which peels the coating off.
    Peel,
}

impl Measure {
    /// All of them.
    pub const ALL: [Self; 6] =
        [Self::VonMises, Self::Tresca, Self::Tension, Self::Hydrostatic, Self::InterfaceShear, Self::Peel];

    /// The number itself [pressure].
    pub fn of(self, stress: &StressTensor) -> f64 {
        let [_, _, zz, _, xz, yz] = stress.0;
        match self {
            Self::VonMises => stress.von_mises(),
            Self::Tresca => stress.tresca(),
            Self::Tension => stress.principal().values[0],
            Self::Hydrostatic => stress.hydrostatic(),
            Self::InterfaceShear => xz.hypot(yz),
            Self::Peel => zz,
        }
    }

    /// What it cannot exceed, without principal stresses [pressure].
    fn bound(self, stress: &StressTensor) -> f64 {
        let bound = match self {
            Self::Tresca => 2.0 / 3.0_f64.sqrt() * stress.von_mises(),
            Self::Tension => stress.hydrostatic() + 2.0 / 3.0 * stress.von_mises(),
            _ => return f64::INFINITY,
        };
        bound + 1e-9 * bound.abs() // rounding
    }

    /// Whether it has its meaning at interfaces alone.
    pub fn at_interfaces_only(self) -> bool {
        matches!(self, Self::InterfaceShear | Self::Peel)
    }

    /// What it is called.
    pub fn name(self) -> &'static str {
        match self {
            Self::VonMises => "von_mises",
            Self::Tresca => "tresca",
            Self::Tension => "tension",
            Self::Hydrostatic => "hydrostatic",
            Self::InterfaceShear => "interface_shear",
            Self::Peel => "peel",
        }
    }
}

/// The largest value found so far, and where.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Largest {
    /// Which number.
    pub measure: Measure,
    /// Its value [pressure].
    pub value: f64,
    /// The increment, from 0.
    pub increment: usize,
    /// Cell `[i, j]`.
    pub cell: [usize; 2],
    /// Place relative to its centre [cells]: zero but at a rim.
    pub off: [f64; 2],
    /// Depth and layer.
    pub point: DepthPoint,
}

/// Updates a list of largest values, one a measure, with the stress at one depth in one increment. Of equal values the first
/// found stays. `pressure` of the surface that the stress is of, where it is that of the surface itself: tension is then also looked
/// for at the rim of the contact, see [`at_rims`].
pub fn look(
    found: &mut Vec<Largest>,
    field: &StressField,
    point: DepthPoint,
    is_interface: bool,
    increment: usize,
    pressure: Option<&Array2<f64>>,
) {
    for measure in Measure::ALL {
        if measure.at_interfaces_only() && !is_interface {
            continue;
        }
        let mut best: Option<(f64, [usize; 2], [f64; 2])> = None;
        let shape = field.components[0].dim();
        for i in 0..shape.0 {
            for j in 0..shape.1 {
                let stress = field.at(i, j);
                if best.is_some_and(|(most, ..)| measure.bound(&stress) <= most) {
                    continue;
                }
                let value = measure.of(&stress);
                if best.is_none_or(|(most, ..)| value > most) {
                    best = Some((value, [i, j], [0.0; 2]));
                }
            }
        }
        if let (Measure::Tension, Some(pressure)) = (measure, pressure) {
            let values = Array2::from_shape_fn(shape, |(i, j)| measure.of(&field.at(i, j)));
            for (value, cell, off) in along_lines(&values, pressure) {
                if best.is_none_or(|(most, ..)| value > most) {
                    best = Some((value, cell, off));
                }
            }
        }
        let Some((value, cell, off)) = best else { continue };
        match found.iter_mut().find(|largest| largest.measure == measure) {
            Some(largest) if value > largest.value => {
                *largest = Largest { measure, value, increment, cell, off, point };
            }
            Some(_) => {}
            None => found.push(Largest { measure, value, increment, cell, off, point }),
        }
    }
}

/// Values at the rims of all lines of cells along x and y, each with its cell and its place from there [cells].
pub(super) fn along_lines(values: &Array2<f64>, pressure: &Array2<f64>) -> Vec<(f64, [usize; 2], [f64; 2])> {
    let mut found = Vec::new();
    for axis in 0..2 {
        let lines = |field: &Array2<f64>| -> Vec<Vec<f64>> {
            field.lanes(Axis(axis)).into_iter().map(|line| line.to_vec()).collect()
        };
        for (number, (values, pressure)) in lines(values).iter().zip(&lines(pressure)).enumerate() {
            for rim in at_rims(values, pressure) {
                let (cell, off) = match axis {
                    0 => ([rim.cell, number], [rim.off, 0.0]),
                    _ => ([number, rim.cell], [0.0, rim.off]),
                };
                found.push((rim.value, cell, off));
            }
        }
    }
    found
}
