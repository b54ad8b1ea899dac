//! Complementarity of gap and pressure: `g >= 0`, `p >= 0`, `g p = 0` (Signorini). Of surfaces that yield at a hardness `H`: `0 <= p <= H`,
//! with `g >= 0` where `p = 0`, `g <= 0` where `p = H`, and `g = 0` between. Its residual, for every way of solving.

use super::super::prescribed::NormalLoad;
use super::tilt_motions::TiltMotions;
use crate::fields::{CellRule, CellSize, Reals, each_cell, largest_of, lower};

/// How well pressure and gap satisfy complementarity, and the approach found on the way.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NormalResidual {
    /// Rigid approach [length].
    pub approach: f64,
    /// By how much the body has tilted since the undeformed gap was taken, where a moment of the pressure is prescribed: slope times the
    /// length of the positions, along x and y [length].
    pub turned: [f64; 2],
    /// Largest `|max(K (p - H), min(g, K p))|` over the cells, over [`length_scale`]; K is a cell's self-influence, and H is infinite where
    /// surfaces do not yield.
    pub residual: f64,
}

/// What a cell knows of its pressure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CellLaw {
    /// Displacement of a cell by its own pressure [length/pressure].
    pub self_influence: f64,
    /// The pressure at which the surfaces yield [pressure]; infinite where they do not.
    pub hardness: f64,
}

impl CellLaw {
    /// Of a cell of this self-influence [length/pressure] under a load.
    pub fn under(load: &NormalLoad, self_influence: f64) -> Self {
        Self { self_influence, hardness: load.hardness.unwrap_or(f64::INFINITY) }
    }
}

/// Nearer to the hardness than this fraction of it a pressure is at the hardness.
const AT_HARDNESS: f64 = 1e-9;

/// Pressures from here on are at the hardness [pressure].
pub fn yields_from(hardness: f64) -> f64 {
    hardness * (1.0 - AT_HARDNESS)
}

/// Evaluates pressures, from normal displacements and the undeformed gap; finds the gap. Without a prescribed `approach` it is the mean
/// height of the loaded cells, of those below the hardness where there are any; where a moment of the pressure is prescribed, approach and `tilt`
/// are those of the plane nearest to the heights of the loaded cells.
pub fn normal_residual(
    pressure: &[f64],
    (displacement, undeformed): (&[f64], &[f64]),
    law: CellLaw,
    (approach, tilt): (Option<f64>, Option<&TiltMotions>),
    gap: &mut Vec<f64>,
) -> NormalResidual {
    if let Some(tilt) = tilt {
        let loaded = |cell: usize| f64::from(u8::from(pressure[cell] > 0.0));
        let (turned, level) = tilt.turn(loaded, (displacement, undeformed, approach.unwrap_or(0.0)));
        let found = normal_residual(pressure, (displacement, &level), law, (approach, None), gap);
        return NormalResidual { turned, ..found };
    }
    let turned = [0.0; 2];
    if gap.len() != pressure.len() {
        *gap = vec![0.0; pressure.len()];
    }
    let read = [pressure, displacement, undeformed];
    let [load, cells, heights, work, undeformed_work] = each_cell(&Loads, read, [gap]);
    let approach = approach
        .or_else(|| if law.hardness.is_finite() { height_below(law.hardness, pressure, gap) } else { None });
    if load <= 0.0 {
        let lowest = gap.iter().copied().fold(f64::INFINITY, f64::min);
        let approach = approach.unwrap_or(lowest);
        lower(gap, approach);
        return NormalResidual { approach, turned, residual: if lowest >= approach { 0.0 } else { 1.0 } };
    }
    let approach = approach.unwrap_or(heights / cells);
    let scale = length_scale((work - undeformed_work) / load, [law.self_influence, load / cells], approach);
    lower(gap, approach);
    let worst = violation(gap, pressure, law);
    NormalResidual { approach, turned, residual: if scale > 0.0 { worst / scale } else { f64::INFINITY } }
}

/// Displacement of a cell under the mean pressure of the loaded cells, times this: the least that violations are measured by. The digits of
/// displacements end at 1e-16 of that displacement, those of a residual of 1e-8 at 1e-13 of it.
const LEAST_SCALE: f64 = 1e-5;

/// The approach times this, likewise: a gap is a difference of heights as large as that, so that its digits end at 1e-16 of it. Surfaces that
/// have worn until hardly anything presses are displaced by less.
const LEAST_OF_APPROACH: f64 = 1e-7;

/// What violations are measured by [length]: the mean displacement under the load, which is no more than rounding where surfaces are flat
/// and periodic, so that nothing but their uniform pressure acts, or where hardly anything presses.
pub fn length_scale(mean_displacement: f64, [self_influence, mean_pressure]: [f64; 2], approach: f64) -> f64 {
    let least = (LEAST_SCALE * self_influence * mean_pressure).max(LEAST_OF_APPROACH * approach.abs());
    mean_displacement.abs().max(least)
}

/// Largest `|max(K (p - H), min(g, K p))|` over the cells [length], K being the self-influence and H the hardness.
pub fn violation(gap: &[f64], pressure: &[f64], law: CellLaw) -> f64 {
    largest_of(&Violation(law), [gap, pressure])
}

/// Mean height [length] of the loaded cells below the hardness; where none is, the largest of all loaded ones, which just touches. `None` where
/// nothing is loaded.
pub fn height_below(hardness: f64, pressure: &[f64], heights: &[f64]) -> Option<f64> {
    let [sum, count] = each_cell(&Below { limit: yields_from(hardness) }, [pressure, heights], []);
    if count > 0.0 {
        return Some(sum / count);
    }
    let loaded = pressure.iter().zip(heights).filter(|(p, _)| **p > 0.0);
    loaded.map(|(_, height)| *height).reduce(f64::max)
}

/// Sums of the heights of cells that are loaded below a limit, and of these cells.
struct Below {
    limit: f64,
}

impl CellRule<2, 0, 2> for Below {
    #[inline(always)]
    fn at<R: Reals>(&self, [p, height]: [R; 2], _: &mut [R; 0]) -> [R; 2] {
        let (zero, one) = (p.all(0.0), p.all(1.0));
        let is_free = p.if_at_most(zero, zero, p.all(self.limit).if_at_most(p, zero, one));
        [is_free * height, is_free]
    }
}

/// Height; sums of pressure, of loaded cells and of their heights, of pressure times height, and of pressure times undeformed gap.
struct Loads;

impl CellRule<3, 1, 5> for Loads {
    #[inline(always)]
    fn at<R: Reals>(&self, [p, u, undeformed]: [R; 3], [height]: &mut [R; 1]) -> [R; 5] {
        let (zero, one) = (p.all(0.0), p.all(1.0));
        *height = u + undeformed;
        [p, p.if_at_most(zero, zero, one), p.if_at_most(zero, zero, *height), p * *height, p * undeformed]
    }
}

/// `|max(K (p - H), min(g, K p))|`.
struct Violation(CellLaw);

impl CellSize<2> for Violation {
    #[inline(always)]
    fn of<R: Reals>(&self, [gap, p]: [R; 2]) -> R {
        let CellLaw { self_influence, hardness } = self.0;
        let off = gap.min(p * self_influence).max((p - hardness) * self_influence);
        off.max(off * -1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn elastic(self_influence: f64) -> CellLaw {
        CellLaw { self_influence, hardness: f64::INFINITY }
    }

    /// Two loaded cells at one height, an open one above: complementary. A cell in tension, an overlap, a loaded cell that is open:
    /// each by its own measure.
    #[test]
    fn every_kind_of_violation_is_seen() {
        let undeformed = [0.0, 0.0, 5.0];
        let residual = |pressure: [f64; 3], displacement: [f64; 3], approach| {
            normal_residual(
                &pressure,
                (&displacement, &undeformed),
                elastic(0.5),
                (approach, None),
                &mut Vec::new(),
            )
        };
        // Mean displacement under the load: 2.
        assert_eq!(
            residual([1.0, 3.0, 0.0], [2.0, 2.0, 1.0], None),
            NormalResidual { approach: 2.0, turned: [0.0; 2], residual: 0.0 }
        );
        assert_eq!(residual([1.0, 3.0, 0.0], [2.0, 2.0, -4.0], None).residual, 0.5); // overlap of 1
        assert_eq!(residual([1.0, 3.0, 0.0], [2.0, 2.0, 1.0], Some(1.5)).residual, 0.25); // a gap of 0.5 under load
        assert_eq!(residual([2.0, 2.0, -0.8], [2.0, 2.0, 4.0], Some(2.0)).residual, 0.4 / (4.8 / 3.2));
    }

    /// A uniform pressure on flat surfaces that moves nothing is a solution; a gap of a millionth of what the pressure moves a cell by is not.
    #[test]
    fn flat_surfaces_that_are_not_displaced_have_a_residual() {
        let residual = |undeformed: [f64; 2]| {
            normal_residual(
                &[2.0, 2.0],
                (&[0.0; 2], &undeformed),
                elastic(0.5),
                (None, None),
                &mut Vec::new(),
            )
            .residual
        };
        assert_eq!(residual([0.0; 2]), 0.0);
        // Half of the difference is the gap; the scale is 1e-5 times 0.5 times 2.
        assert!((residual([0.0, 2e-6]) - 0.1).abs() < 1e-12);
    }

    #[test]
    fn bodies_apart_are_complementary_and_bodies_through_each_other_are_not() {
        let mut gap = Vec::new();
        let mut residual = |approach| {
            normal_residual(&[0.0; 2], (&[0.0; 2], &[1.0, 2.0]), elastic(1.0), (approach, None), &mut gap)
        };
        assert_eq!(residual(Some(1.5)).residual, 1.0);
        // Without a prescribed approach bodies apart just touch.
        assert_eq!(residual(None), NormalResidual { approach: 1.0, turned: [0.0; 2], residual: 0.0 });
        assert_eq!(residual(Some(0.5)).residual, 0.0);
        assert_eq!(gap, [0.5, 1.5]);
    }

    /// Of a pressure that displaces the surfaces by a millionth of a billionth of the approach no digit of the gap is left; by a millionth, all that
    /// a residual asks for.
    #[test]
    fn what_hardly_presses_is_measured_by_the_digits_of_heights() {
        let residual = |gap: f64, displacement: f64| {
            let read = ([1.0, 1.0], [displacement; 2], [1.0, 1.0 + gap]);
            normal_residual(
                &read.0,
                (&read.1, &read.2),
                elastic(1e-3),
                (Some(1.0 + displacement), None),
                &mut Vec::new(),
            )
            .residual
        };
        assert!(residual(f64::EPSILON, 1e-15) < 1e-8);
        assert!((residual(1e-9, 1e-6) / 1e-3 - 1.0).abs() < 1e-6);
    }

    /// A load that displaces nothing, as that of a flat surface on a flat one, is measured by what a cell's own pressure displaces: closed
    /// gaps are solved, and an open one of a thousandth of that is not.
    #[test]
    fn a_load_that_moves_nothing_is_measured_by_the_self_influence() {
        let residual = |gap: f64| {
            normal_residual(
                &[1.0, 1.0],
                (&[0.0; 2], &[0.0, gap]),
                elastic(1.0),
                (Some(0.0), None),
                &mut Vec::new(),
            )
            .residual
        };
        assert_eq!(residual(0.0), 0.0);
        assert!(residual(1e-3) > 1.0 && residual(1e-3).is_finite(), "{}", residual(1e-3));
    }

    /// At a hardness of 4 cells at it may overlap and not be open, cells below it are closed, and no pressure is above it; the approach is
    /// the height of those below it.
    #[test]
    fn what_yields_may_overlap_and_bears_no_more_than_the_hardness() {
        let law = CellLaw { self_influence: 0.5, hardness: 4.0 };
        let residual = |pressure: [f64; 3], displacement: [f64; 3], approach| {
            normal_residual(&pressure, (&displacement, &[0.0; 3]), law, (approach, None), &mut Vec::new())
        };
        let solved = residual([4.0, 1.0, 0.0], [1.0, 2.0, 5.0], None);
        assert_eq!(solved, NormalResidual { approach: 2.0, turned: [0.0; 2], residual: 0.0 });
        // Mean displacements under the loads: 1.2, 2.8 and 2.8.
        assert_eq!(residual([4.0, 1.0, 0.0], [1.0, 2.0, 1.5], None).residual, 0.5 / 1.2);
        assert_eq!(residual([4.0, 1.0, 0.0], [3.0, 2.0, 5.0], None).residual, 1.0 / 2.8);
        assert_eq!(residual([4.0, 1.0, 0.0], [3.0, 2.0, 5.0], Some(2.5)).residual, 0.5 / 2.8);
        // A pressure of 1 too much, and one of 1 too little over an overlap of 1.
        assert_eq!(residual([5.0, 1.0, 0.0], [1.0, 2.0, 5.0], Some(2.0)).residual, 0.5 / (7.0 / 6.0));
        assert_eq!(residual([3.0, 1.0, 0.0], [1.0, 2.0, 5.0], Some(2.0)).residual, 0.5 / 1.25);
        // All at the hardness: the highest just touches.
        assert_eq!(residual([4.0, 4.0, 0.0], [1.0, 2.0, 5.0], None).approach, 2.0);
    }
}
