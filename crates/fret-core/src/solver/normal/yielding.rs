//! Where surfaces yield at a hardness `H` pressures stay between 0 and `H`. What empty cells are to tension cells at the hardness are to more
//! pressure, with the sign of the gap turned round: the rules of both iterations have the second bound always, infinite where nothing yields. Here is
//! what is otherwise: how a force is restored between two bounds.

use super::super::laws::complementarity::yields_from;
use crate::fields::{CellRule, Reals, each_cell};

/// Passes at the most in which the shift is found that restores a force; most take three to six.
const MOST_PASSES: usize = 60;
/// A force is restored when no more than this fraction of it is missing: rounding.
const FOUND: f64 = 1e-14;
/// First pressures under a force are at most this fraction of the hardness, where there are cells enough.
const FIRST: f64 = 0.5;

/// Brings a pressure to start from to between 0 and the hardness, and to the force where one is prescribed. False where its loaded cells
/// cannot carry that.
pub fn make_feasible(pressure: &mut [f64], total: Option<f64>, hardness: f64) -> bool {
    clip(pressure, hardness);
    let Some(total) = total else { return true };
    let loaded: Vec<f64> = pressure.iter().map(|p| f64::from(u8::from(*p > 0.0))).collect();
    restore(pressure, &loaded, total, hardness)
}

/// Cuts pressures to between 0 and the hardness.
pub fn clip(pressure: &mut [f64], hardness: f64) {
    each_cell(&Clip { hardness }, [], [pressure]);
}

/// Cells that carry a force at the start, of `cells` in all.
pub fn cells_for(total: f64, hardness: f64, cells: usize) -> usize {
    ((total / (FIRST * hardness)).ceil() as usize).clamp(1, cells)
}

/// Restores the sum of pressures: a shift of all active ones that is cut to what is allowed, which is the nearest point of those (projection);
/// a shift of all cells where the active ones cannot carry it. False where these cannot, either.
pub fn restore(pressure: &mut [f64], active: &[f64], total: f64, hardness: f64) -> bool {
    if let Some(shift) = shift_to(pressure, active, total, hardness) {
        each_cell(&Shift { hardness, shift }, [active], [pressure]);
        return true;
    }
    let all = vec![1.0; pressure.len()];
    let Some(shift) = shift_to(pressure, &all, total, hardness) else { return false };
    each_cell(&Shift { hardness, shift }, [&all], [pressure]);
    true
}

/// The shift of the active pressures under which all of them together have a sum; `None` where none has. The sum rises with the shift along
/// straight pieces: Newton's method, inside a bracket.
fn shift_to(pressure: &[f64], active: &[f64], total: f64, hardness: f64) -> Option<f64> {
    let [rest, count] = each_cell(&Rest, [pressure, active], []);
    let slack = FOUND * total;
    if count == 0.0 || rest > total + slack || rest + count * hardness < total - slack {
        return None;
    }
    let is_active = |(p, active): (&f64, &f64)| (*active > 0.0).then_some(*p);
    let ends = pressure.iter().zip(active).filter_map(is_active);
    let (least, most) =
        ends.fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), p| (least.min(p), most.max(p)));
    let (mut low, mut high) = (-most, hardness - least);
    let mut shift = 0.0_f64.max(low).min(high);
    for _ in 0..MOST_PASSES {
        let [sum, inside] = each_cell(&Shifted { hardness, shift }, [pressure, active], []);
        let off = rest + sum - total;
        if off.abs() <= slack {
            break;
        }
        if off > 0.0 {
            high = shift;
        } else {
            low = shift;
        }
        let next = shift - off / inside;
        let next = if low < next && next < high { next } else { 0.5 * (low + high) };
        if next == shift {
            break;
        }
        shift = next;
    }
    Some(shift)
}

struct Clip {
    hardness: f64,
}

impl CellRule<0, 1, 0> for Clip {
    #[inline(always)]
    fn at<R: Reals>(&self, _: [R; 0], [p]: &mut [R; 1]) -> [R; 0] {
        *p = p.max(p.all(0.0)).min(p.all(self.hardness));
        []
    }
}

/// Sums of the pressures that are not active, and of the active cells.
struct Rest;

impl CellRule<2, 0, 2> for Rest {
    #[inline(always)]
    fn at<R: Reals>(&self, [p, active]: [R; 2], _: &mut [R; 0]) -> [R; 2] {
        let zero = p.all(0.0);
        [active.if_at_most(zero, p, zero), active]
    }
}

/// Sums of the active pressures after a shift, and of the active cells between the bounds then.
struct Shifted {
    hardness: f64,
    shift: f64,
}

impl CellRule<2, 0, 2> for Shifted {
    #[inline(always)]
    fn at<R: Reals>(&self, [p, active]: [R; 2], _: &mut [R; 0]) -> [R; 2] {
        let (zero, hardness) = (p.all(0.0), p.all(self.hardness));
        let shifted = p + self.shift;
        let inside = shifted.if_at_most(zero, zero, hardness.if_at_most(shifted, zero, active));
        [active * shifted.max(zero).min(hardness), inside]
    }
}

struct Shift {
    hardness: f64,
    shift: f64,
}

impl CellRule<1, 1, 0> for Shift {
    #[inline(always)]
    fn at<R: Reals>(&self, [active]: [R; 1], [p]: &mut [R; 1]) -> [R; 0] {
        let (zero, hardness) = (p.all(0.0), p.all(self.hardness));
        *p = active.if_at_most(zero, *p, (*p + self.shift).max(zero).min(hardness));
        []
    }
}

/// Marks the cells whose pressure is unknown: loaded below the hardness.
pub fn mark_active(pressure: &[f64], hardness: f64, active: &mut [f64]) {
    let limit = yields_from(hardness);
    for (active, p) in active.iter_mut().zip(pressure) {
        *active = f64::from(u8::from(*p > 0.0 && *p < limit));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A force is restored exactly, within the bounds; cells that are not active stay.
    #[test]
    fn a_force_is_restored_between_the_bounds() {
        let start = [0.0, 0.2, 1.5, 3.9, 4.0];
        for total in [4.0, 5.0, 9.0, 9.6, 12.0, 15.9, 16.0] {
            let mut pressure = start;
            assert!(restore(&mut pressure, &[0.0, 1.0, 1.0, 1.0, 0.0], total, 4.0));
            let off = pressure.iter().sum::<f64>() - total;
            assert!(off.abs() < 1e-12, "{total}: {off:e}");
            assert!(pressure.iter().all(|p| (0.0..=4.0).contains(p)), "{pressure:?}");
            assert_eq!([pressure[0], pressure[4]], [0.0, 4.0]);
        }
        // Three cells between carry no more than the hardness each, and five cells no more than that.
        let mut pressure = start;
        assert!(restore(&mut pressure, &[0.0, 1.0, 1.0, 1.0, 0.0], 18.0, 4.0));
        assert!((pressure.iter().sum::<f64>() - 18.0).abs() < 1e-12 && pressure[0] < pressure[1]);
        assert!(!restore(&mut start.clone(), &[1.0; 5], 20.5, 4.0));
        // The shift is the same for all that are not at a bound, far outside or not.
        let mut pressure = [-3.0, 0.5, 9.0, 2.0];
        assert!(restore(&mut pressure, &[1.0; 4], 7.0, 4.0));
        assert!(pressure.iter().zip([0.0, 0.75, 4.0, 2.25]).all(|(p, exact)| (p - exact).abs() < 1e-12));
    }
}
