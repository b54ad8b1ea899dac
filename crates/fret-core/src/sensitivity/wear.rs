//! Wear, linearised: what an increment collects, and what is taken off the surfaces where a cycle, or a stage without cycles, ends. The formulas are those
//! of the run (`run/slip_increment.rs`).

use super::energies::{Bound, Inputs, Outputs, shares_of_slip};
use super::rule::{Rule, combination, product};
use super::scene::Scene;
use super::solved::{Solved, at};
use crate::fields::{Slopes, length_of};
use crate::model::{CoulombFriction, WearLaw, WearRule};
use crate::solver::{FrictionLaw, dissipation, length_of_way, slip_until_open};

/// What wears a cell off: its depth for a coefficient of one, and the derivatives of that by slip, shear before and after, bounds before and after,
/// pressures before and after.
struct Worn {
    cell: usize,
    /// Its place in the contact, where it is in contact.
    place: Option<usize>,
    /// Share of its drift and of its offset in its slip.
    shares: [f64; 2],
    depth: f64,
    by: [f64; 10],
    bounds: [Bound; 2],
}

/// The wear of an increment.
pub(super) struct Wear {
    coefficient: f64,
    cells: Vec<Worn>,
}

impl Wear {
    pub fn new(
        of: &WearRule,
        scene: &Scene<'_>,
        [now, before]: [&Solved; 2],
        (law, rule): (&CoulombFriction, &Rule),
    ) -> Self {
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
            let ends = match of.law {
                WearLaw::Energy => [b0, b1],
                WearLaw::Archard => [p0, p1],
            };
            let Slopes { value: depth, by } = dissipation(ends, way);
            Some(Worn { cell, place, shares, depth, by, bounds })
        };
        let cells = places.into_iter().enumerate().filter_map(of_cell).collect();
        Self { coefficient: of.coefficient.unwrap_or(1.0), cells }
    }

    /// Change of the depth that has been collected in all cells of the region; `coefficient`: that of the wear coefficient.
    pub fn forward(&self, of: &Inputs<'_>, coefficient: f64) -> Vec<f64> {
        let Inputs { before, next, paths, friction, .. } = of;
        let mut collected = before.collected.clone();
        for Worn { cell, place, shares, depth, by, bounds } in &self.cells {
            let cell = *cell;
            let ahead = place.map_or([0.0; 2], |place| at(&paths.ahead, place));
            let slip = |axis: usize| {
                shares[0] * (next.slid[axis][cell] - before.slid[axis][cell]) + shares[1] * ahead[axis]
            };
            let pressures = [before.pressure[cell], next.pressure[cell]];
            let bound = |end: usize| {
                let by = bounds[end].by;
                by[0] * pressures[end] + by[1] * friction[0] + by[2] * friction[1]
            };
            let ([x0, y0], [x1, y1]) = (at(&before.shear, cell), at(&next.shear, cell));
            let inputs = [slip(0), slip(1), x0, y0, x1, y1, bound(0), bound(1), pressures[0], pressures[1]];
            collected[cell] += self.coefficient * product(by, &inputs) + coefficient * depth;
        }
        collected
    }

    /// Backwards, from that of what has been collected.
    pub fn transposed(&self, collected: &[f64], to: &mut Outputs<'_>, coefficient: &mut f64) {
        let Outputs { before, next, paths, friction, .. } = to;
        before.collected.iter_mut().zip(collected).for_each(|(before, of)| *before += of);
        for Worn { cell, place, shares, depth, by, bounds } in &self.cells {
            let (cell, of) = (*cell, collected[*cell]);
            *coefficient += of * depth;
            let [x, y, x0, y0, x1, y1, b0, b1, p0, p1] = combination(&[*by], &[of * self.coefficient]);
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
                friction[0] += by[1] * amount;
                friction[1] += by[2] * amount;
                let pressure = if end == 0 { &mut before.pressure } else { &mut next.pressure };
                pressure[cell] += by[0] * amount;
            }
            before.pressure[cell] += p0;
            next.pressure[cell] += p1;
        }
    }
}
