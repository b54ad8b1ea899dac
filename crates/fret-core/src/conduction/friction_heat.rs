//! Heat of friction over a cycle, from the kept fields of its increments.

use ndarray::{Array2, Zip};

/// Fraction of the dissipated energy of a cycle that may be missing in the kept fields, or be too much: beyond it they are not those
/// of all increments.
const MISSING: f64 = 0.1;

/// What is kept of an increment, shape `(nx, ny)`.
#[derive(Debug, Clone)]
pub struct HeatedSurface {
    /// Pressure [pressure].
    pub pressure: Array2<f64>,
    /// Shear along x and y [pressure].
    pub shear: [Array2<f64>; 2],
    /// Relative slip since the start along x and y \[length\].
    pub slip: [Array2<f64>; 2],
}

/// Dissipated energy of a cycle, cell by cell.
#[derive(Debug, Clone, PartialEq)]
pub struct SlipOfCycle {
    /// Energy per area [force/length], so that the whole is the cycle's dissipated energy.
    pub energy: Array2<f64>,
    /// Cells in contact at any end of an increment.
    pub contact: Array2<bool>,
    /// What the kept fields give of the cycle's dissipated energy before they are scaled to it [-].
    pub accounted: f64,
}

/// Dissipated energy per area over the increments of a cycle, the state before its first included, scaled to the `dissipated_energy` that
/// the run recorded of it; `None` when the increments give another energy by more than a tenth: some of them are missing.
///
/// `(|q| (p0 + p)/(2 p)) |ds|`: the mean of the friction bound `mu p` over an increment, for shear q that is at its bound where it slips,
/// along straight lines; not that of an interface with a shear strength. The run itself takes arcs where slip turns, up to 1 % longer in an increment.
pub fn slip_of_cycle(
    increments: impl IntoIterator<Item = HeatedSurface>,
    dissipated_energy: f64,
    cell_area: f64,
) -> Option<SlipOfCycle> {
    let mut increments = increments.into_iter();
    let mut before = increments.next()?;
    let mut energy = Array2::<f64>::zeros(before.pressure.dim());
    let mut contact = before.pressure.mapv(|pressure| pressure > 0.0);
    for after in increments {
        Zip::indexed(&mut energy).and(&after.pressure).and(&before.pressure).for_each(
            |(i, j), energy, now, then| {
                if *now > 0.0 {
                    let at = |field: &[Array2<f64>; 2]| [field[0][[i, j]], field[1][[i, j]]];
                    let [qx, qy] = at(&after.shear);
                    let ([x, y], [x0, y0]) = (at(&after.slip), at(&before.slip));
                    *energy += qx.hypot(qy) * 0.5 * (1.0 + then / now) * (x - x0).hypot(y - y0);
                }
            },
        );
        Zip::from(&mut contact)
            .and(&after.pressure)
            .for_each(|contact, pressure| *contact |= *pressure > 0.0);
        before = after;
    }
    let accounted = energy.sum() * cell_area;
    if dissipated_energy == 0.0 && accounted == 0.0 {
        return Some(SlipOfCycle { energy, contact, accounted: 1.0 });
    }
    let ratio = accounted / dissipated_energy;
    if !((ratio - 1.0).abs() <= MISSING) {
        return None;
    }
    energy /= ratio;
    Some(SlipOfCycle { energy, contact, accounted: ratio })
}

/// Heat by friction [power/area]: the energy of a cycle times the cycles per unit of time.
pub fn friction_heat(slip: &SlipOfCycle, frequency: f64) -> Array2<f64> {
    &slip.energy * frequency
}
