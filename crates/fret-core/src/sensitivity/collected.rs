//! What an increment collects in each cell until a cycle, or a stage without cycles, ends: wear, and what friction follows; linearised. The formulas
//! are those of the run (`run/slip_increment.rs`).

use super::case_number::OF_WEAR;
use super::energies::{Bound, Inputs, Outputs, shares_of_slip};
use super::rule::{Rule, combination, product};
use super::scene::Scene;
use super::solved::{Solved, at};
use crate::fields::{Slopes, length_of};
use crate::model::{CoulombFriction, EvolutionDriver, FrictionEvolution, WearLaw, WearRule};
use crate::solver::{FrictionLaw, dissipation, length_of_way, slip_until_open};

/// What is collected of the slip of a cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Measure {
    /// Its way.
    Way,
    /// The way times the friction bound: the energy that friction dissipates.
    Energy,
    /// The way times the pressure.
    Pressure,
}

/// What a cell collects for a coefficient of one, and the derivatives of that by slip, shear before and after, bounds before and after,
/// pressures before and after; by width and inside of the rim.
struct Slipped {
    cell: usize,
    /// Its place in the contact, where it is in contact.
    place: Option<usize>,
    /// Share of its drift and of its offset in its slip.
    shares: [f64; 2],
    depth: f64,
    by: [f64; 10],
    by_rim: [f64; 2],
    bounds: [Bound; 2],
}

/// What an increment collects.
pub(super) struct Collected {
    coefficient: f64,
    cells: Vec<Slipped>,
}

impl Collected {
    /// The wear of an increment: its depth, or where each layer has a coefficient of its own what it wears by.
    pub fn of_wear(
        of: &WearRule,
        scene: &Scene<'_>,
        states: [&Solved; 2],
        friction: (&CoulombFriction, &Rule),
    ) -> Self {
        let measure = match of.law {
            WearLaw::Energy => Measure::Energy,
            WearLaw::Archard => Measure::Pressure,
        };
        Self::new((measure, of.coefficient.unwrap_or(1.0), true), scene, states, friction)
    }

    /// The distance that is slipped.
    pub fn of_path(scene: &Scene<'_>, states: [&Solved; 2], friction: (&CoulombFriction, &Rule)) -> Self {
        Self::new((Measure::Way, 1.0, false), scene, states, friction)
    }

    /// What friction follows; `None` where that is the number of cycles.
    pub fn of_evolution(
        of: &FrictionEvolution,
        scene: &Scene<'_>,
        states: [&Solved; 2],
        friction: (&CoulombFriction, &Rule),
    ) -> Option<Self> {
        let measure = match of.by {
            EvolutionDriver::Energy => Measure::Energy,
            EvolutionDriver::SlipDistance => Measure::Way,
            EvolutionDriver::Cycles => return None,
        };
        Some(Self::new((measure, 1.0, false), scene, states, friction))
    }

    fn new(
        (measure, coefficient, by_rim): (Measure, f64, bool),
        scene: &Scene<'_>,
        [now, before]: [&Solved; 2],
        (law, rule): (&CoulombFriction, &Rule),
    ) -> Self {
        let rim = |solved: &Solved| {
            scene.rim.as_ref().filter(|_| by_rim).map(|rim| scene.rim_slopes(rim, &solved.tractions[0]))
        };
        let [rim_before, rim_now] = [rim(before), rim(now)];
        let in_force =
            |rim: &Option<Vec<[f64; 3]>>, cell: usize| rim.as_ref().map_or([1.0, 0.0, 0.0], |rim| rim[cell]);
        let of_region = FrictionLaw::in_region(law, scene.region);
        let bound = |cell: usize, pressure: f64| Bound::of((law, &of_region), (scene, cell), pressure);
        let mut places = vec![None; scene.region.len()];
        now.contact.cells().enumerate().for_each(|(place, cell)| places[cell] = Some(place));
        let of_cell = |(cell, place): (usize, Option<usize>)| {
            let pressures = [before.tractions[0][cell], now.tractions[0][cell]];
            let bounds = pressures.map(|pressure| bound(cell, pressure));
            let (shear, drift) = ([before.shear_at(cell), now.shear_at(cell)], now.drift_since(before, cell));
            let zones = [before.zone_of(cell), now.zone_of(cell)];
            let shares = match place {
                Some(_) => shares_of_slip(zones, rule.pace.is_some()),
                None if shear[0] == [0.0; 2] || pressures[0] == 0.0 => [0.0; 2],
                None => [1.0, 0.0],
            };
            if shares == [0.0; 2] {
                return None;
            }
            let ahead = place.map_or([0.0; 2], |place| at(&rule.ahead, place));
            let slip = [0, 1].map(|axis| shares[0] * drift[axis] + shares[1] * ahead[axis]);
            let [[x0, y0], [x1, y1]] = shear;
            let [b0, b1] = bounds.each_ref().map(|bound| bound.value);
            let inputs = [slip[0], slip[1], x0, y0, x1, y1, b0, b1, pressures[0], pressures[1]];
            let [x, y, x0, y0, x1, y1, b0, b1, p0, p1] = Slopes::<10>::of_each(inputs);
            let way = if place.is_some() {
                length_of_way(scene.plan.case.integration, [x, y], zones, [[x0, y0], [x1, y1]])
            } else {
                length_of(slip_until_open([x, y], [x0, y0], b0))
            };
            let ends = match measure {
                Measure::Way => {
                    let Slopes { value: depth, by } = way;
                    return Some(Slipped { cell, place, shares, depth, by, by_rim: [0.0; 2], bounds });
                }
                Measure::Energy => [b0, b1],
                Measure::Pressure => [p0, p1],
            };
            let [rim_before, rim_now] = [in_force(&rim_before, cell), in_force(&rim_now, cell)];
            let by_rim = [1, 2].map(|number| {
                dissipation([ends[0].value * rim_before[number], ends[1].value * rim_now[number]], way.value)
            });
            let [first, last] = ends;
            let Slopes { value: depth, by } = dissipation([first * rim_before[0], last * rim_now[0]], way);
            Some(Slipped { cell, place, shares, depth, by, by_rim, bounds })
        };
        let cells = places.into_iter().enumerate().filter_map(of_cell).collect();
        Self { coefficient, cells }
    }

    /// Adds what changes to what has been collected in all cells of the region; `numbers`: changes of those of the wear rule.
    pub fn forward(&self, of: &Inputs<'_>, numbers: [f64; OF_WEAR], collected: &mut [f64]) {
        let Inputs { before, next, paths, friction, .. } = of;
        for Slipped { cell, place, shares, depth, by, by_rim, bounds } in &self.cells {
            let cell = *cell;
            let ahead = place.map_or([0.0; 2], |place| at(&paths.ahead, place));
            let slip = |axis: usize| {
                shares[0] * (next.slid[axis][cell] - before.slid[axis][cell]) + shares[1] * ahead[axis]
            };
            let pressures = [before.pressure[cell], next.pressure[cell]];
            let [by_coefficient, by_strength] = friction.at(cell);
            let bound = |end: usize| {
                let by = bounds[end].by;
                by[0] * pressures[end] + by[1] * by_coefficient + by[2] * by_strength
            };
            let ([x0, y0], [x1, y1]) = (at(&before.shear, cell), at(&next.shear, cell));
            let inputs = [slip(0), slip(1), x0, y0, x1, y1, bound(0), bound(1), pressures[0], pressures[1]];
            let [coefficient, width, inside, ..] = numbers;
            let at_rim = by_rim[0] * width + by_rim[1] * inside;
            collected[cell] += self.coefficient * (product(by, &inputs) + at_rim) + coefficient * depth;
        }
    }

    /// Backwards, from that of what has been collected; adds to the numbers of the wear rule.
    pub fn transposed(&self, collected: &[f64], to: &mut Outputs<'_>, numbers: &mut [f64; OF_WEAR]) {
        let Outputs { before, next, paths, friction, .. } = to;
        for Slipped { cell, place, shares, depth, by, by_rim, bounds } in &self.cells {
            let (cell, of) = (*cell, collected[*cell]);
            let scaled = of * self.coefficient;
            for (number, by) in numbers.iter_mut().zip([of * depth, scaled * by_rim[0], scaled * by_rim[1]]) {
                *number += by;
            }
            let [x, y, x0, y0, x1, y1, b0, b1, p0, p1] = combination(&[*by], &[scaled]);
            for (axis, slip) in [x, y].into_iter().enumerate() {
                next.slid[axis][cell] += shares[0] * slip;
                before.slid[axis][cell] -= shares[0] * slip;
                if let Some(place) = place {
                    paths.ahead[axis][*place] += shares[1] * slip;
                }
            }
            for (axis, (first, last)) in [(x0, x1), (y0, y1)].into_iter().enumerate() {
                before.shear[axis][cell] += first;
                next.shear[axis][cell] += last;
            }
            for (end, amount) in [b0, b1].into_iter().enumerate() {
                let by = bounds[end].by;
                friction.add(cell, [by[1] * amount, by[2] * amount]);
                let pressure = if end == 0 { &mut before.pressure } else { &mut next.pressure };
                pressure[cell] += by[0] * amount;
            }
            before.pressure[cell] += p0;
            next.pressure[cell] += p1;
        }
    }
}
