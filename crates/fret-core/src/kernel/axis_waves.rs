//! The wavenumbers of a grid along one axis, with those that its cells cannot tell from them.

use std::f64::consts::PI;

/// One of the grid's wavenumbers along an axis.
pub(super) struct AxisWaves {
    /// The wavenumber and its aliases, each with the cell's factor `sin(k d/2)/(k d/2)`.
    pub waves: Vec<(f64, f64)>,
    /// Whether minus the wavenumber is one of its aliases, and not zero.
    pub is_own_mirror: bool,
}

/// Those of all wavenumbers `0..=count/2` of `count` cells with a side [length].
pub(super) fn axis_waves(count: usize, side: f64, aliases: usize) -> Vec<AxisWaves> {
    let aliases = aliases as i32;
    (0..=count / 2)
        .map(|index| {
            if index == 0 {
                // the aliases of a uniform traction are uniform: the cell's factor vanishes for all but itself
                return AxisWaves { waves: vec![(0.0, 1.0)], is_own_mirror: false };
            }
            let turns = index as f64 / count as f64;
            let sine = libm::sin(PI * turns);
            let waves = (-aliases..=aliases)
                .map(|alias| {
                    let half_phase = PI * (turns + f64::from(alias));
                    let sign = if alias % 2 == 0 { 1.0 } else { -1.0 };
                    (2.0 * half_phase / side, sign * sine / half_phase)
                })
                .collect();
            AxisWaves { waves, is_own_mirror: 2 * index == count }
        })
        .collect()
}
