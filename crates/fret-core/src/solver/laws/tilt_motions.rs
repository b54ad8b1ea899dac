//! Rigid motions along the normal where moments of the pressure are prescribed: approach and tilts that follow from resultants, all at once, as the
//! three motions along the surface do. The tilt is that of the plane nearest to the heights of the cells in contact; pressure is brought to its
//! resultants by factors that are exponentials of planes, which keep it positive and the shape of its edge, and are unique where there are any
//! (Csiszar 1975: the nearest pressure in the sense of relative entropy).

use super::super::prescribed::NormalLoad;
use super::rigid_motions::{CellPositions, RigidMotions};
use crate::fields::Number;

/// Resultants are off by no more than this, of the pressure.
const EXACT: f64 = 4e-16;
/// Resultants that are further off than this after all steps cannot be had from cells under pressure.
const CLOSE: f64 = 1e-11;
/// Newton steps at the most, and halvings of one.
const MOST_STEPS: usize = 60;
const MOST_HALVINGS: usize = 20;

/// The motions of some cells, packed, and what is prescribed of them.
#[derive(Debug, Clone)]
pub struct TiltMotions {
    /// Places along x and y, over the length that makes them of order one.
    places: [Vec<f64>; 2],
    /// Which of approach and tilts follow from resultants.
    held: [bool; 3],
    /// Sums of pressure times motion that are prescribed [pressure]; zero for the others.
    sums: [f64; 3],
    /// Products of the motions with each other, over all cells.
    gram: [f64; 6],
}

impl TiltMotions {
    /// Those of some cells; `None` where no moment is prescribed.
    pub fn of(
        load: &NormalLoad,
        positions: &CellPositions,
        cells: impl Iterator<Item = usize>,
    ) -> Option<Self> {
        let NormalLoad { total, moment, .. } = *load;
        if moment == [None; 2] {
            return None;
        }
        let (x, y) = cells.map(|cell| positions.place(cell).into()).unzip();
        let held = [total.is_some(), moment[0].is_some(), moment[1].is_some()];
        let sums = [total, moment[0], moment[1]].map(|sum| sum.unwrap_or(0.0));
        let mut motions = Self { places: [x, y], held, sums, gram: [0.0; 6] };
        motions.gram = motions.gram_of((0..motions.places[0].len()).map(|_| 1.0));
        Some(motions)
    }

    fn modes(&self, cell: usize) -> [f64; 3] {
        [1.0, self.places[0][cell], self.places[1][cell]]
    }

    /// A motion of these amounts at a cell.
    pub fn at(&self, amounts: [f64; 3], cell: usize) -> f64 {
        let modes = self.modes(cell);
        amounts[0] + amounts[1] * modes[1] + amounts[2] * modes[2]
    }

    /// Sums of a field times the motions.
    fn products(&self, field: impl Iterator<Item = f64>) -> [f64; 3] {
        field.enumerate().fold([0.0; 3], |sums, (cell, value)| {
            let modes = self.modes(cell);
            [0, 1, 2].map(|k| sums[k] + value * modes[k])
        })
    }

    /// Amounts of the motions whose sums with weights are these; those that follow from no resultant are zero.
    fn amounts(&self, weights: impl Iterator<Item = f64>, products: [f64; 3]) -> [f64; 3] {
        RigidMotions::solve_of(self.held, self.gram_of(weights), products)
    }

    /// Products of the motions with each other, with weights of the cells.
    fn gram_of(&self, weights: impl Iterator<Item = f64>) -> [f64; 6] {
        let mut gram = [0.0; 6];
        for (cell, weight) in weights.enumerate().filter(|(_, weight)| *weight != 0.0) {
            let modes = self.modes(cell);
            for (sum, [k, l]) in gram.iter_mut().zip([[0, 0], [1, 1], [2, 2], [0, 1], [0, 2], [1, 2]]) {
                *sum += weight * modes[k] * modes[l];
            }
        }
        gram
    }

    /// Amounts of the motions nearest to a field, by least squares with weights, whose `gram` is known. Found twice: a contact far from the middle has motions that are
    /// nearly the same, and of a large field the digits of what is left over count.
    fn nearest(&self, gram: [f64; 6], weight: impl Fn(usize) -> f64, field: &[f64]) -> [f64; 3] {
        let mut amounts = [0.0; 3];
        for _ in 0..2 {
            let left = (0..field.len()).map(|cell| weight(cell) * (field[cell] - self.at(amounts, cell)));
            let more = RigidMotions::solve_of(self.held, gram, self.products(left));
            amounts = [0, 1, 2].map(|k| amounts[k] + more[k]);
        }
        amounts
    }

    /// Takes off a field of displacements what the motions can do to the cells of a set; zero elsewhere.
    pub fn take_off(&self, field: &mut [f64], active: &[f64]) {
        let amounts = self.nearest(self.gram_of(active.iter().copied()), |cell| active[cell], field);
        for (cell, (value, active)) in field.iter_mut().zip(active).enumerate() {
            *value = active * (*value - self.at(amounts, cell));
        }
    }

    /// Takes off a field of all cells what the motions can do.
    pub fn remove<N: Number>(&self, field: &mut [N]) {
        let before: Vec<f64> = field.iter().map(|value| value.to_double(1.0)).collect();
        let amounts = self.nearest(self.gram, |_| 1.0, &before);
        for (cell, (value, before)) in field.iter_mut().zip(before).enumerate() {
            *value = N::of(before - self.at(amounts, cell), 1.0);
        }
    }

    /// The tilts that bring the `active` cells nearest to one height [length], and the undeformed gap turned by them.
    pub fn turn(
        &self,
        active: impl Fn(usize) -> f64,
        (displacement, undeformed, approach): (&[f64], &[f64], f64),
    ) -> ([f64; 2], Vec<f64>) {
        let cells = undeformed.len();
        let heights: Vec<f64> =
            (0..cells).map(|cell| displacement[cell] + undeformed[cell] - approach).collect();
        let weights: Vec<f64> = (0..cells).map(active).collect();
        let [_, x, y] = self.nearest(self.gram_of(weights.iter().copied()), |cell| weights[cell], &heights);
        ([x, y], (0..cells).map(|cell| undeformed[cell] - self.at([0.0, x, y], cell)).collect())
    }

    /// What resultants lack.
    pub fn missing(&self, pressure: &[f64]) -> [f64; 3] {
        let found = self.products(pressure.iter().copied());
        [0, 1, 2].map(|k| if self.held[k] { self.sums[k] - found[k] } else { 0.0 })
    }

    /// Adds weights times the motions that bring pressure to its resultants.
    pub fn lift(&self, pressure: &mut [f64], weights: impl Fn(usize, f64) -> f64) {
        let weights: Vec<f64> = pressure.iter().enumerate().map(|(cell, p)| weights(cell, *p)).collect();
        for _ in 0..2 {
            let amounts = self.amounts(weights.iter().copied(), self.missing(pressure));
            for (cell, (p, weight)) in pressure.iter_mut().zip(&weights).enumerate() {
                *p += weight * self.at(amounts, cell);
            }
        }
    }

    /// The same pressure on all cells, of the size of what is prescribed, brought to its resultants. False where no pressure has them.
    pub fn on_all_cells(&self, pressure: &mut [f64]) -> bool {
        let size = self.sums.into_iter().fold(0.0, |most: f64, sum| most.max(sum.abs()));
        pressure.fill(if size > 0.0 { size / pressure.len() as f64 } else { 1.0 });
        self.restore(pressure)
    }

    /// Cuts tension off and brings the rest to its resultants. False where it cannot be: nothing is changed but the tension.
    pub fn restore(&self, pressure: &mut [f64]) -> bool {
        for p in pressure.iter_mut() {
            *p = p.max(0.0);
        }
        let (found, total) = (pressure.iter().sum::<f64>(), self.sums[0]);
        let first = if self.held[0] && found > 0.0 && total > 0.0 { (total / found).ln() } else { 0.0 };
        let mut amounts = [first, 0.0, 0.0];
        let mut here = self.scaled(pressure, amounts);
        let mut last = f64::INFINITY;
        for _ in 0..MOST_STEPS {
            let off = self.off(&here);
            if off <= EXACT || off <= CLOSE && off > 0.5 * last {
                break;
            }
            last = off;
            let right = self.missing(&here);
            let step = self.amounts(here.iter().copied(), right);
            // The convex function whose gradient is what resultants have too much.
            let value = |pressure: &[f64], amounts: [f64; 3]| {
                pressure.iter().sum::<f64>() - (0..3).map(|k| amounts[k] * self.sums[k]).sum::<f64>()
            };
            let now = value(&here, amounts);
            let along: f64 = (0..3).map(|k| step[k] * right[k]).sum();
            let mut share = 1.0;
            let mut next = None;
            for _ in 0..MOST_HALVINGS {
                let tried = [0, 1, 2].map(|k| amounts[k] + share * step[k]);
                let there = self.scaled(pressure, tried);
                let falls = value(&there, tried) <= now - 1e-4 * share * along;
                if there.iter().all(|p| p.is_finite()) && (falls || self.off(&there) < off) {
                    next = Some((tried, there));
                    break;
                }
                share *= 0.5;
            }
            let Some((tried, there)) = next else { break };
            (amounts, here) = (tried, there);
        }
        let done = self.is_held_by(&here);
        if done {
            pressure.copy_from_slice(&here);
        }
        done
    }

    /// Whether pressure has these resultants.
    pub fn is_held_by(&self, pressure: &[f64]) -> bool {
        self.off(pressure) <= CLOSE
    }

    fn scaled(&self, pressure: &[f64], amounts: [f64; 3]) -> Vec<f64> {
        let factor = |cell: usize| self.at(amounts, cell).exp();
        pressure.iter().enumerate().map(|(cell, p)| if *p > 0.0 { p * factor(cell) } else { 0.0 }).collect()
    }

    /// The largest resultant that is missing, of the pressure.
    fn off(&self, pressure: &[f64]) -> f64 {
        let total = pressure.iter().sum::<f64>().max(self.sums[0]);
        let missing =
            self.missing(pressure).into_iter().fold(0.0, |most: f64, missing| most.max(missing.abs()));
        if total > 0.0 {
            missing / total
        } else if missing > 0.0 {
            f64::INFINITY
        } else {
            0.0
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Cells at -2, -1, 0, 1, 2 along x.
    fn row(total: Option<f64>, moment: f64) -> TiltMotions {
        let positions = CellPositions::new(vec![-2.0, -1.0, 0.0, 1.0, 2.0], vec![0.0], false);
        // Places count in the length 2.
        let load = NormalLoad {
            total,
            approach: 0.0,
            give: 0.0,
            moment: [Some(moment / 2.0), None],
            hardness: None,
        };
        TiltMotions::of(&load, &positions, 0..5).unwrap()
    }

    fn force_and_moment(pressure: &[f64]) -> [f64; 2] {
        pressure
            .iter()
            .zip([-2.0, -1.0, 0.0, 1.0, 2.0])
            .fold([0.0; 2], |[force, moment], (p, x)| [force + p, moment + p * x])
    }

    #[test]
    fn pressure_gets_its_force_and_moment() {
        for (start, total, moment) in [
            ([1.0, 1.0, 1.0, 1.0, -3.0], Some(10.0), 4.0),
            ([0.0, 0.0, 1.0, 1.0, 1.0], Some(1.0), 1.999),
            ([1.0, 0.0, 0.0, 1.0, 0.0], None, 0.0),
        ] {
            let mut pressure = start;
            assert!(row(total, moment).restore(&mut pressure));
            let [force, found] = force_and_moment(&pressure);
            let size = pressure.iter().sum::<f64>();
            assert!(
                (found - moment).abs() < 1e-14 * size
                    && total.is_none_or(|total| (force - total).abs() < 1e-14 * size)
            );
            assert!(pressure.iter().zip(start).all(|(p, start)| *p >= 0.0 && (*p == 0.0) == (start <= 0.0)));
        }
    }

    /// No pressure on cells at 0, 1 and 2 has its centre at -1 or 2.5.
    #[test]
    fn what_cells_under_pressure_cannot_carry_is_said() {
        for centre in [-1.0, 2.5] {
            let mut pressure = [0.0, -1.0, 1.0, 1.0, 1.0];
            assert!(!row(Some(3.0), 3.0 * centre).restore(&mut pressure));
            assert_eq!(pressure, [0.0, 0.0, 1.0, 1.0, 1.0]);
        }
    }

    /// Heights 3 + 0.5 x on the cells in contact and anything elsewhere: the turned gap is level there, and no sum or moment is left.
    #[test]
    fn a_plane_is_taken_off() {
        let motions = row(Some(1.0), 0.0);
        let undeformed = [9.0, 2.5, 3.0, 3.5, -7.0];
        let active = [0.0, 1.0, 1.0, 1.0, 0.0];
        let (amounts, turned) = motions.turn(|cell| active[cell], (&[0.0; 5], &undeformed, 0.25));
        assert!((amounts[0] - 1.0).abs() < 1e-12 && amounts[1] == 0.0, "{amounts:?}");
        assert!((1..4).all(|cell| (turned[cell] - 3.0).abs() < 1e-12) && (turned[0] - 10.0).abs() < 1e-12);
        let mut field = [5.0, 1.0, 4.0, 2.0, 8.0];
        motions.take_off(&mut field, &active);
        let [force, moment] = force_and_moment(&field);
        assert!(force.abs() < 1e-12 && moment.abs() < 1e-12 && field[0] == 0.0 && field[4] == 0.0);
        let mut all = [5.0, 1.0, 4.0, 2.0, 8.0];
        motions.remove(&mut all);
        let [force, moment] = force_and_moment(&all);
        assert!(force.abs() < 1e-11 && moment.abs() < 1e-11);
    }
}
