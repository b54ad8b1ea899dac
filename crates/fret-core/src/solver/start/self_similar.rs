//! Self-similar prediction: a contact that grows without changing its shape, what a smooth profile does, exactly so where there is no other length than its
//! own (Spence, Proc. R. Soc. A 305 (1968), 55), and nearly so under a coating.

use ndarray::Array2;

use super::super::contact_edge::level_function;
use super::super::memory::GridTractions;
use crate::fields::in_portions;
use crate::model::ContactState;

/// Numbers of straight passes that take as long as a cell.
const NUMBERS: usize = 30;

/// How a contact grows.
#[derive(Debug, Clone, Copy)]
pub struct SelfSimilarGrowth {
    /// Factor of all lengths along the surface.
    pub widening: f64,
    /// Factor of all tractions.
    pub strengthening: f64,
    /// Whether there is a mirror before the first row and column: the middle of the contact.
    pub mirrored: [bool; 2],
}

/// Sum of a field.
pub fn sum_of(field: &Array2<f64>) -> f64 {
    field.iter().sum()
}

impl SelfSimilarGrowth {
    /// Pressure and shear of the grown contact, from those of `state` and its `gap` [length]. The edge moves by parts of a cell:
    /// pressures come from the level function of the edge, shears from their ratio to the pressure.
    pub fn of(&self, state: &ContactState, gap: &Array2<f64>) -> GridTractions {
        let pressure = &state.pressure;
        let level = level_function(&pressure.view(), &gap.view()).unwrap_or_else(|| pressure.mapv(|p| p * p));
        let (nx, ny) = pressure.dim();
        let middle = self.middle(pressure);
        let along_x = self.samples(nx, middle[0]);
        let along_y = self.samples(ny, middle[1]);
        let zeros = || Array2::zeros((nx, ny));
        let mut grown = GridTractions { pressure: zeros(), shear: [zeros(), zeros()] };
        let sheared = state.shear.iter().any(|shear| shear.iter().any(|q| *q != 0.0));
        let in_cell = |cell: usize| {
            let (x, y) = (&along_x[cell / ny], &along_y[cell % ny]);
            let corners = [
                ([x.low, y.low], (1.0 - x.fraction) * (1.0 - y.fraction)),
                ([x.low, y.high], (1.0 - x.fraction) * y.fraction),
                ([x.high, y.low], x.fraction * (1.0 - y.fraction)),
                ([x.high, y.high], x.fraction * y.fraction),
            ];
            let height: f64 = corners.iter().map(|(cell, weight)| weight * level[*cell]).sum();
            if !(height > 0.0) {
                return [0.0; 3];
            }
            let p = self.strengthening * height.sqrt();
            let [x, y] = if sheared { shear_between(&corners, state, p) } else { [0.0; 2] };
            [p, x, y]
        };
        let GridTractions { pressure: grown_pressure, shear: [x, y] } = &mut grown;
        let fields = [grown_pressure, x, y].map(|field| field.as_slice_mut().unwrap_or_default());
        in_portions((nx * ny, NUMBERS), fields, &|cells, [pressure, x, y]| {
            for (place, cell) in cells.enumerate() {
                let here = in_cell(cell);
                if here[0] > 0.0 {
                    [pressure[place], x[place], y[place]] = here;
                }
            }
        });
        grown
    }

    /// The point that stays [cells from the first centre].
    fn middle(&self, pressure: &Array2<f64>) -> [f64; 2] {
        let total = sum_of(pressure);
        let mut moments = [0.0; 2];
        for ((i, j), p) in pressure.indexed_iter() {
            moments[0] += p * i as f64;
            moments[1] += p * j as f64;
        }
        [0, 1].map(|axis| if self.mirrored[axis] { -0.5 } else { moments[axis] / total })
    }

    /// Where the values of each cell of a line come from.
    fn samples(&self, cells: usize, middle: f64) -> Vec<Sample> {
        let last = cells - 1;
        (0..cells)
            .map(|index| {
                let at = (middle + (index as f64 - middle) / self.widening).clamp(0.0, last as f64);
                let low = at as usize;
                Sample { low, high: (low + 1).min(last), fraction: at - low as f64 }
            })
            .collect()
    }
}

/// Shear under a pressure, from its ratios to the pressures of `state` at the corners around a place, each with its weight.
fn shear_between(corners: &[([usize; 2], f64); 4], state: &ContactState, pressure: f64) -> [f64; 2] {
    let is_loaded = |(cell, weight): &&([usize; 2], f64)| *weight > 0.0 && state.pressure[*cell] > 0.0;
    let (mut ratio, mut size, mut weights) = ([0.0; 2], 0.0, 0.0);
    let (mut least, mut most) = (f64::INFINITY, 0.0_f64);
    for (cell, weight) in corners.iter().filter(is_loaded) {
        let here = [0, 1].map(|axis| state.shear[axis][*cell] / state.pressure[*cell]);
        let length = here[0].hypot(here[1]);
        (least, most) = (least.min(length), most.max(length));
        weights += weight;
        size += weight * length;
        ratio = [0, 1].map(|axis| ratio[axis] + weight * here[axis]);
    }
    let length = ratio[0].hypot(ratio[1]);
    if !(length > 0.0) {
        return [0.0; 2];
    }
    // Where all slip, so does what lies between.
    let slips = least > most * (1.0 - 1e-9);
    let size = if slips { most * (1.0 + 1e-9) } else { size / weights };
    ratio.map(|ratio| pressure * size * ratio / length)
}

/// A place between two cells of a line.
#[derive(Debug, Clone, Copy)]
struct Sample {
    low: usize,
    high: usize,
    /// Share of the upper one.
    fraction: f64,
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Hertz: pressure and gap [in units of the peak] of a contact of `radius` cells around `middle`, on `cells` a side.
    fn hertz(cells: usize, middle: f64, radius: f64, peak: f64) -> (Array2<f64>, Array2<f64>) {
        let square = |i: usize, j: usize| {
            ((i as f64 - middle).powi(2) + (j as f64 - middle).powi(2)) / (radius * radius)
        };
        let pressure =
            Array2::from_shape_fn((cells, cells), |(i, j)| peak * (1.0 - square(i, j)).max(0.0).sqrt());
        // The gap beside a Hertz contact, up to a factor (Johnson, Contact Mechanics, eq. 3.42a).
        let gap = Array2::from_shape_fn((cells, cells), |(i, j)| {
            let r = square(i, j).sqrt();
            if r <= 1.0 { 0.0 } else { (r * r - 1.0).sqrt() - (2.0 - r * r) * (1.0 / r).acos() }
        });
        (pressure, gap)
    }

    fn state(pressure: &Array2<f64>) -> ContactState {
        let (nx, ny) = pressure.dim();
        let mut state = ContactState::untouched([nx, ny]);
        state.pressure.assign(pressure);
        state
    }

    #[test]
    fn a_hertz_contact_grows_into_the_larger_one() {
        for (mirrored, middle) in [(true, -0.5), (false, 15.3)] {
            let (then, gap) = hertz(32, middle, 10.0, 1.0);
            let (exact, _) = hertz(32, middle, 11.7, 1.17);
            let growth = SelfSimilarGrowth { widening: 1.17, strengthening: 1.17, mirrored: [mirrored; 2] };
            let found = growth.of(&state(&then), &gap).pressure;
            let norm = |field: &Array2<f64>| field.iter().map(|p| p * p).sum::<f64>().sqrt();
            // An edge off by a tenth of a cell changes the pressures of the outermost cells, a fifth of all, by a tenth of them,
            // which are a third of the mean: 1e-2. Lines between squares of pressures, which are parabolas, miss less.
            let off = norm(&(&found - &exact)) / norm(&exact);
            assert!(off < 1e-2, "{off}");
            let cells = |field: &Array2<f64>| field.iter().filter(|p| **p > 0.0).count() as f64;
            assert!((cells(&found) / cells(&exact) - 1.0).abs() < 0.02);
        }
    }

    #[test]
    fn shear_keeps_its_ratio_and_its_circle() {
        let (pressure, gap) = hertz(32, 15.5, 10.0, 1.0);
        let mut before = state(&pressure);
        let friction = 0.3;
        for ((i, j), p) in pressure.indexed_iter() {
            let arm = [i as f64 - 15.5, j as f64 - 15.5];
            let radius = arm[0].hypot(arm[1]);
            // Slip outside five cells, less inside; always away from the middle.
            let fraction = friction * (radius / 5.0).min(1.0);
            for axis in 0..2 {
                before.shear[axis][[i, j]] = p * fraction * arm[axis] / radius;
            }
        }
        let growth = SelfSimilarGrowth { widening: 1.1, strengthening: 1.05, mirrored: [false; 2] };
        let GridTractions { pressure: grown, shear } = growth.of(&before, &gap);
        for ((i, j), p) in grown.indexed_iter().filter(|(_, p)| **p > 0.0) {
            let arm = [i as f64 - 15.5, j as f64 - 15.5];
            let radius = arm[0].hypot(arm[1]);
            let q = shear[0][[i, j]].hypot(shear[1][[i, j]]);
            if radius > 1.1 * 5.0 + 1.2 {
                // On the circle, a touch outside, so that no rounding takes it off.
                assert!((q / (friction * p) - 1.0).abs() < 2e-9 && q > friction * p, "{radius} {}", q / p);
            } else {
                // Between cells a ratio that is bent at five cells is missed by a part of a cell's step.
                assert!((q / p - friction * (radius / 5.5).min(1.0)).abs() < 0.02, "{radius} {}", q / p);
            }
        }
    }
}
