//! Shear that a frozen problem starts from, and how far a step takes it off its friction discs.

use crate::model::TangentialField;
use crate::model::each_cell::{CellRule, Number, Reals, convert, each_cell};

/// Shear on or inside its friction discs, packed.
#[derive(Debug, Default)]
pub struct StartingShear<N> {
    /// The shear.
    pub shear: [Vec<N>; 2],
    /// Its size.
    pub size: Vec<N>,
    /// Its size less the friction bound: lost when taken in single precision.
    pub excess: Vec<N>,
    /// Size and excess before they are taken.
    wide: [Vec<f64>; 2],
}

impl<N: Number> StartingShear<N> {
    /// Takes over shear with its friction bound, in units of `unit`.
    pub fn take(&mut self, shear: &TangentialField, bound: &[f64], unit: f64) {
        let Self { shear: [x, y], size, excess, wide } = self;
        for field in wide.iter_mut() {
            field.resize(bound.len(), 0.0);
        }
        let [own_size, own_excess] = wide;
        each_cell(&SizeAndExcess, [&shear.x, &shear.y, bound], [own_size, own_excess]);
        for (from, to) in [(&shear.x, x), (&shear.y, y), (own_size, size), (own_excess, excess)] {
            taken(from, 1.0 / unit, to);
        }
    }
}

/// `to` becomes `factor` times a field.
pub fn taken<N: Number>(from: &[f64], factor: f64, to: &mut Vec<N>) {
    to.resize(from.len(), N::default());
    convert(from, factor, to);
}

/// Sizes of shear `[x, y]` of a `size` after a step, and how much they grow: by itself, since a small growth would be lost in the
/// size.
#[inline(always)]
pub fn after<R: Reals>([x, y]: [R; 2], size: R, [step_x, step_y]: [R; 2]) -> (R, R) {
    let zero = x.all(0.0);
    let [to_x, to_y] = [x + step_x, y + step_y];
    let moved = (to_x * to_x + to_y * to_y).sqrt();
    let both = moved + size;
    let growth = ((x + to_x) * step_x + (y + to_y) * step_y) / both;
    (moved, both.if_at_most(zero, zero, growth))
}

struct SizeAndExcess;

impl CellRule<3, 2, 0> for SizeAndExcess {
    #[inline(always)]
    fn at<R: Reals>(&self, [x, y, bound]: [R; 3], [size, excess]: &mut [R; 2]) -> [R; 0] {
        *size = (x * x + y * y).sqrt();
        *excess = *size - bound;
        []
    }
}
