//! Errors of a level, all relative.

use serde::Serialize;

use super::level::Level;
use super::quantities::{PerQuantity, Quantity, StageQuantities};
use super::reference::{NOTHING, Reference};
use crate::model::Dimension;

/// Errors below this are rounding, and show no order.
const ROUNDING: f64 = 1e-12;

/// How a quantity of interest is read.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Form {
    /// As the cells have it.
    Plain,
    /// Between the cells.
    Between,
    /// Between the cells, pressure and approach extrapolated with the next coarser grid.
    Extrapolated,
}

impl Form {
    /// All forms.
    pub const ALL: [Self; 3] = [Self::Plain, Self::Between, Self::Extrapolated];
}

/// Errors of a level: of each quantity of interest the largest at the end of any stage, relative to the largest reference value of all
/// ends (the stick area: to the contact area); of the fields the mean square over the cells at the end of the history.
/// `None` where nothing is known, where nothing happens, and where a level is compared with itself.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Errors {
    /// As the cells have the numbers.
    pub plain: PerQuantity<Option<f64>>,
    /// Read between the cells.
    pub between: PerQuantity<Option<f64>>,
    /// Extrapolated with the coarser level, when there is one.
    pub extrapolated: PerQuantity<Option<f64>>,
    /// Pressure.
    pub pressure: Option<f64>,
    /// Shear.
    pub shear: Option<f64>,
}

impl Errors {
    /// Errors of a form.
    pub fn of(&self, form: Form) -> &PerQuantity<Option<f64>> {
        match form {
            Form::Plain => &self.plain,
            Form::Between => &self.between,
            Form::Extrapolated => &self.extrapolated,
        }
    }

    /// Error of a quantity of interest, read between the cells.
    pub fn of_quantity(&self, quantity: Quantity) -> Option<f64> {
        self.between[quantity as usize]
    }

    /// The worst quantity of interest of a form.
    pub fn worst(&self, form: Form) -> Option<f64> {
        self.of(form).iter().flatten().copied().reduce(f64::max)
    }
}

/// Errors of a level; `coarser` is the level of half the cells, when there is one.
pub fn errors(reference: &Reference, level: &Level, coarser: Option<&Level>) -> Errors {
    let extrapolated = coarser.map_or([None; Quantity::ALL.len()], |coarser| {
        judged(reference, level, &|end, quantity| match coarser.ends.get(end) {
            Some(coarse) => extrapolated(&level.ends[end], coarse, quantity),
            None => level.ends[end].between(quantity),
        })
    });
    Errors {
        plain: judged(reference, level, &|end, quantity| level.ends[end].plain(quantity)),
        between: between(reference, level),
        extrapolated,
        pressure: reference.error_of_pressure(level),
        shear: reference.error_of_shear(level),
    }
}

/// Errors of the quantities of interest of a level alone, read between the cells.
pub(super) fn between(reference: &Reference, level: &Level) -> PerQuantity<Option<f64>> {
    judged(reference, level, &|end, quantity| level.ends[end].between(quantity))
}

/// Errors of the quantities of interest of a level in one reading; none of what is compared with itself.
fn judged(
    reference: &Reference,
    level: &Level,
    reading: &dyn Fn(usize, Quantity) -> Option<[f64; 2]>,
) -> PerQuantity<Option<f64>> {
    Quantity::ALL.map(|quantity| {
        (!reference.is_itself(quantity, level))
            .then(|| error(reference, quantity, level.ends.len(), reading))?
    })
}

/// A quantity of interest with its error of second order taken off; only pressure and approach have one of a known order and sign, and of a
/// line contact not even they: two points are its edge, and where they lie between the centres of cells does not even out.
pub(super) fn extrapolated(
    fine: &StageQuantities,
    coarse: &StageQuantities,
    quantity: Quantity,
) -> Option<[f64; 2]> {
    let value = fine.between(quantity)?;
    let factor = coarse.cell_area / fine.cell_area - 1.0;
    match quantity {
        Quantity::MaxPressure | Quantity::Approach if factor > 0.0 && fine.dimension == Dimension::Plane => {
            let other = coarse.between(quantity)?;
            Some([0, 1].map(|axis| value[axis] + (value[axis] - other[axis]) / factor))
        }
        _ => Some(value),
    }
}

fn error(
    reference: &Reference,
    quantity: Quantity,
    ends: usize,
    reading: &dyn Fn(usize, Quantity) -> Option<[f64; 2]>,
) -> Option<f64> {
    let exact = reference.of(quantity);
    let scaled_by = if quantity == Quantity::StickArea { Quantity::ContactArea } else { quantity };
    let scale = reference.largest(scaled_by)?;
    if scale <= NOTHING * reference.beside(quantity).unwrap_or(0.0) {
        return None;
    }
    let never_sticks = || exact.iter().flatten().all(|[area, _]| *area == 0.0);
    if quantity == Quantity::StickArea
        && never_sticks()
        && (0..ends).all(|end| reading(end, quantity).is_none_or(|[area, _]| area == 0.0))
    {
        return None; // nothing sticks anywhere: no number to be wrong about
    }
    let apart = |end: usize| {
        let [x, y] = (*exact.get(end)?)?;
        let [a, b] = reading(end, quantity)?;
        Some((a - x).hypot(b - y) / scale)
    };
    (0..ends).filter_map(apart).reduce(f64::max)
}

/// Order each level of a line shows against the one before: `ln(e0/e1) / ln(n1/n0)`; the first has none, nor has rounding.
pub fn orders(counts: &[f64], errors: &[Option<f64>]) -> Vec<Option<f64>> {
    (0..counts.len())
        .map(|k| {
            let before = k.checked_sub(1)?;
            let (e0, e1) = (errors[before]?, errors[k]?);
            (e0 > ROUNDING && e1 > ROUNDING).then(|| (e0 / e1).ln() / (counts[k] / counts[before]).ln())
        })
        .collect()
}
