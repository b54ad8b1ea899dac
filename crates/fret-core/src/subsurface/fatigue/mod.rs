//! How near a cycle of stress brings a point to fatigue: parameters by invariants (Crossland, Dang Van), on the critical plane
//! (Smith-Watson-Topper, Fatemi-Socie), and of the surface (Ruiz); cycles to initiation from them; elastic shakedown.
//!
//! A cycle is the list of stresses at its increments; its order matters to none of the parameters.

mod ball;
mod constants;
mod critical_plane;
mod invariants;
mod life;
mod shakedown;
mod surface;

pub use constants::{CrackConstants, FatigueConstants, LayerConstants, Range, StrainLife};
pub use critical_plane::{CriticalPlane, fatemi_socie, smith_watson_topper};
pub use invariants::{Endurance, crossland, dang_van};
pub use life::{cycles_by_fatemi_socie, cycles_by_smith_watson_topper};
pub use shakedown::{first_yield_strength, shakedown_strength};
pub use surface::{Ruiz, SurfacePoint, ruiz};

/// Mean of a parameter from the surface down to `distance`: values at rising depths from 0, linear between them. Where the distance
/// ends beyond the last depth, the mean goes so far. The line method of the theory of critical distances (Taylor 2007) averages over
/// `2 L`, where `L` is the critical distance.
pub fn line_mean(depths: &[f64], values: &[f64], distance: f64) -> f64 {
    let mut integral = 0.0;
    let mut covered = 0.0;
    for (depth, value) in depths.windows(2).zip(values.windows(2)) {
        let step = depth[1] - depth[0];
        let left = distance - depth[0];
        if left <= 0.0 {
            break;
        }
        if step <= 0.0 {
            continue; // the other side of an interface
        }
        let part = left.min(step);
        let end = value[0] + (value[1] - value[0]) * part / step;
        integral += 0.5 * (value[0] + end) * part;
        covered += part;
    }
    if covered > 0.0 { integral / covered } else { values.first().copied().unwrap_or(0.0) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn means_over_a_distance_are_those_of_the_polygon() {
        let (depths, values) = ([0.0, 1.0, 1.0, 3.0], [4.0, 2.0, 6.0, 2.0]);
        assert_eq!(line_mean(&depths, &values, 0.0), 4.0);
        assert_eq!(line_mean(&depths, &values, 1.0), 3.0);
        assert_eq!(line_mean(&depths, &values, 2.0), f64::midpoint(3.0, 5.0));
        assert_eq!(line_mean(&depths, &values, 50.0), (3.0 + 8.0) / 3.0);
    }
}
