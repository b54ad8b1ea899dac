//! The largest of each number over depths, cells and increments, with its place.

use ndarray::{Array2, Axis, CowArray, Ix2};
use pulp::{Arch, Simd, WithSimd};
use rayon::prelude::*;
use serde::Serialize;

use super::depths::DepthPoint;
use super::rim::at_rims_of;
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

    /// Of Tresca's stress and of tension, what they cannot exceed, from the mean stress and von Mises' stress [pressure].
    #[inline(always)]
    fn bound(self, mean: f64, von_mises: f64) -> f64 {
        let (mean, factor) = match self {
            Self::Tresca => (0.0, 2.0 / 3.0_f64.sqrt()),
            _ => (mean, 2.0 / 3.0),
        };
        mean + factor * von_mises + 1e-9 * (mean.abs() + von_mises) // rounding: the two may cancel
    }

    /// Whether Tresca's stress, or tension, is certainly below `value`, without principal stresses: by the sign of a polynomial that
    /// rises from its largest root on.
    fn is_below(self, value: f64, stress: &StressTensor) -> bool {
        let [xx, yy, zz, xy, xz, yz] = stress.deviator().0;
        let second = 0.5 * (xx * xx + yy * yy + zz * zz) + xy * xy + xz * xz + yz * yz;
        let third = xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz);
        if self == Self::Tresca {
            // squares of the differences of principal stresses are the roots; the largest is at least 3 J2
            let t = value * value;
            let polynomial = ((t - 6.0 * second) * t + 9.0 * second * second) * t
                - (4.0 * second * second * second - 27.0 * third * third);
            return value > 0.0 && t >= 3.0 * second && polynomial > 1e-12 * t * t * t;
        }
        // the characteristic polynomial of the deviator, whose largest root is at least sqrt(J2 / 3)
        let mean = stress.hydrostatic();
        let above = value - mean;
        let square = above * above;
        let rounding = 1e-12 * square * (above + mean.abs() + value.abs());
        above > 0.0 && 3.0 * square >= second && (square - second) * above - third > rounding
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
/// for at the rim of the contact, see [`at_rims`](super::rim::at_rims); in a period not where four open cells would lie across its border.
pub fn look(
    found: &mut Vec<Largest>,
    field: &StressField,
    point: DepthPoint,
    is_interface: bool,
    increment: usize,
    pressure: Option<&Array2<f64>>,
) {
    let shape = field.components[0].dim();
    let cells = Cells::of(field);
    let cells = &cells;
    let portions = cells.portions();
    for measure in Measure::ALL {
        if measure.at_interfaces_only() && !is_interface {
            continue;
        }
        let largest = cells.largest(measure, &portions);
        let mut best = largest.map(|(value, cell)| (value, [cell / shape.1, cell % shape.1], [0.0; 2]));
        if let (Measure::Tension, Some(pressure)) = (measure, pressure) {
            for (value, cell, off) in along_lines(|[i, j]| measure.of(&field.at(i, j)), pressure) {
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

/// Cells that are looked through in one go.
const PORTION: usize = 256;

/// A number and its cell.
type At = (f64, usize);

/// The larger one; of equal ones the first.
fn larger(one: At, other: At) -> At {
    if other.0 > one.0 { other } else { one }
}

/// What costs little to know of a portion of the cells: its largest numbers, or bounds, in the order of [`Measure::ALL`]; of the shear
/// at an interface its square.
type Portion = [At; 6];

/// The stress under all cells, row by row.
struct Cells<'a> {
    components: [CowArray<'a, f64, Ix2>; 6],
}

impl<'a> Cells<'a> {
    fn of(field: &'a StressField) -> Self {
        Self { components: field.components.each_ref().map(|component| component.as_standard_layout()) }
    }

    fn len(&self) -> usize {
        self.components[0].len()
    }

    fn at(&self, cell: usize) -> StressTensor {
        StressTensor(self.components.each_ref().map(|of| of.as_slice().unwrap_or_default()[cell]))
    }

    /// All portions, one after the other.
    fn portions(&self) -> Vec<Portion> {
        let portion = |number: usize| {
            let cells = number * PORTION..self.len().min((number + 1) * PORTION);
            let stress =
                self.components.each_ref().map(|of| &of.as_slice().unwrap_or_default()[cells.clone()]);
            let mut found = Arch::new().dispatch(InPortion(stress));
            for (_, cell) in &mut found {
                *cell += cells.start;
            }
            found
        };
        (0..self.len().div_ceil(PORTION)).into_par_iter().map(portion).collect()
    }

    /// The largest value of a measure and its cell; of equal values the first.
    fn largest(&self, measure: Measure, portions: &[Portion]) -> Option<At> {
        let index = Measure::ALL.iter().position(|of| *of == measure)?;
        let (_, promising) = portions.iter().map(|portion| portion[index]).reduce(larger)?;
        let value = measure.of(&self.at(promising));
        if !matches!(measure, Measure::Tresca | Measure::Tension) {
            return Some((value, promising));
        }
        let search = |number: usize| {
            if portions[number][index].0 < value {
                return None;
            }
            let mut best: Option<At> = None;
            for cell in number * PORTION..self.len().min((number + 1) * PORTION) {
                let stress = self.at(cell);
                let least = best.map_or(value, |(most, _)| most);
                let bound = measure.bound(stress.hydrostatic(), stress.von_mises());
                if bound < least || measure.is_below(least, &stress) {
                    continue;
                }
                let here = measure.of(&stress);
                if best.map_or(here >= value, |(most, _)| here > most) {
                    best = Some((here, cell));
                }
            }
            best
        };
        let found: Vec<Option<At>> = (0..portions.len()).into_par_iter().map(search).collect();
        found.into_iter().flatten().reduce(larger)
    }
}

/// The stresses of a portion of cells; its numbers, with cells counted from its first.
struct InPortion<'a>([&'a [f64]; 6]);

impl WithSimd for InPortion<'_> {
    type Output = Portion;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Portion {
        let n = self.0[0].len().min(PORTION);
        let [xx, yy, zz, xy, xz, yz] = self.0.map(|part| &part[..n]);
        let mut numbers = [[0.0_f64; PORTION]; 6];
        let [von_mises, tresca, tension, hydrostatic, shear, peel] =
            numbers.each_mut().map(|numbers| &mut numbers[..n]);
        for c in 0..n {
            let stress = StressTensor([xx[c], yy[c], zz[c], xy[c], xz[c], yz[c]]);
            let (mean, equivalent) = (stress.hydrostatic(), stress.von_mises());
            von_mises[c] = equivalent;
            tresca[c] = Measure::Tresca.bound(mean, equivalent);
            tension[c] = Measure::Tension.bound(mean, equivalent);
            hydrostatic[c] = mean;
            shear[c] = xz[c] * xz[c] + yz[c] * yz[c];
            peel[c] = zz[c];
        }
        numbers.each_ref().map(|numbers| largest_of(&numbers[..n]))
    }
}

/// The largest number and its place; of equal ones the first.
#[inline(always)]
fn largest_of(numbers: &[f64]) -> At {
    // lane by lane, then all lanes
    let mut lanes = [f64::NEG_INFINITY; 16];
    for group in numbers.chunks(16) {
        for (most, number) in lanes.iter_mut().zip(group) {
            *most = if *number > *most { *number } else { *most };
        }
    }
    let most = lanes.into_iter().fold(f64::NEG_INFINITY, |most, lane| if lane > most { lane } else { most });
    (most, numbers.iter().position(|number| *number == most).unwrap_or(0))
}

/// Values at the rims of all lines of cells along x and y, each with its cell and its place from there [cells]; `value` of a cell `[i, j]`.
pub(super) fn along_lines(
    value: impl Fn([usize; 2]) -> f64,
    pressure: &Array2<f64>,
) -> Vec<(f64, [usize; 2], [f64; 2])> {
    let mut found = Vec::new();
    for axis in 0..2 {
        for (number, line) in pressure.lanes(Axis(axis)).into_iter().enumerate() {
            let place = |cell: usize| if axis == 0 { [cell, number] } else { [number, cell] };
            for rim in at_rims_of(|cell| value(place(cell)), &line.to_vec()) {
                let off = if axis == 0 { [rim.off, 0.0] } else { [0.0, rim.off] };
                found.push((rim.value, place(rim.cell), off));
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every measure evaluated under every cell is the judge: on fields with equal values, with equal principal stresses, with large means,
    /// of zeros, and on any number of threads.
    #[test]
    fn the_largest_are_those_of_all_cells_one_by_one() {
        let mut seed = 11_u64;
        let mut random = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (seed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
        };
        let point = DepthPoint { depth: 1.0, layer: 0 };
        for (number, shape) in
            [[97, 61], [97, 61], [5000, 1], [97, 61], [3, 2], [64, 64], [40, 50]].into_iter().enumerate()
        {
            let mut field = StressField::zeros(shape);
            for i in 0..shape[0] {
                for j in 0..shape[1] {
                    let mean = [0.0, 1e3, -1e3, 0.0, 0.0, -0.1, 0.0][number];
                    for (part, component) in field.components.iter_mut().enumerate() {
                        component[[i, j]] = match (number, part) {
                            // uniaxial, then torsion about an axis: equal principal stresses, each value in two cells
                            (5, 0) => ((i / 2) as f64 * 0.1).sin(),
                            (5, 3) if j < 20 => 0.3,
                            // compressed alike along x and y: the mean and the deviator cancel
                            (6, 0 | 1) => -1e4 - (i * shape[1] + j) as f64 * 7.3,
                            (3 | 5 | 6, _) => 0.0,
                            (_, 0..3) => mean + random(),
                            _ => random(),
                        };
                    }
                }
            }
            let found = |threads: usize| {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
                let mut found = Vec::new();
                pool.install(|| look(&mut found, &field, point, true, 0, None));
                found
            };
            let serial = found(1);
            assert_eq!(serial, found(3));
            for largest in serial {
                let exact = field.map(|stress| largest.measure.of(stress));
                let (mut most, mut cell) = (f64::NEG_INFINITY, [0, 0]);
                for ((i, j), &value) in exact.indexed_iter() {
                    if value > most {
                        (most, cell) = (value, [i, j]);
                    }
                }
                assert_eq!((largest.value, largest.cell), (most, cell), "{number} {:?}", largest.measure);
            }
        }
    }
}
