//! How the contact itself yields from a turn to full sliding, and the friction force that energy and opening of a loop in gross slip tell.
//!
//! In a steady loop the contact yields by `2 g(dQ/2)` after a turn, `g(T)` being its displacement at a first tangential force `T` (Masing's
//! rule). In proportion to the friction force `L`, `g(t L) = L h(t)`: the same `h` for all coefficients of friction, exactly so where
//! normal and tangential problem are uncoupled. Behind a spring of compliance `1/S`, with the amplitude `A`,
//!
//! ```text
//! W_d = 4 L (A - L/S - L 2 int_0^1 h dt),    delta_0 = A - L/S - L 2 h(1/2),
//! ```
//!
//! so that `W_d/(4 delta_0) = L (1 - (2 int h dt - 2 h(1/2)) L/delta_0)`, whatever the spring: 1.2 and 1.110 of the initial compliance for
//! spheres, and 1.5 for `h(1)` (Mindlin). The contact slides where `delta_0` is more than at the onset, `(h(1) - 2 h(1/2)) L`.

use super::error::IdentifyError;
use super::model::Model;

/// Intervals of the force from nothing to full sliding.
const INTERVALS: usize = 12;
/// A friction force whose standard deviation, relative, is more than this is not told.
const UNSURE: f64 = 0.03;
/// Up to so many times the half-width at the onset of sliding the amplitude of force has to agree with the friction force, relative.
const NEAR: f64 = 2.0;
const AGREES: f64 = 0.02;

/// The first tangential displacement of the contact over the friction force [length/force].
#[derive(Debug, Clone, Copy)]
pub struct Flanks {
    /// At the onset of sliding, `h(1)`.
    whole: f64,
    /// Twice at half of the friction force, `2 h(1/2)`.
    half: f64,
    /// Twice the mean over forces, `2 int h dt`.
    mean: f64,
    /// Without slip, `h'(0)`.
    initial: f64,
}

impl Flanks {
    /// Those of a model with a coefficient of friction.
    ///
    /// # Errors
    /// When the case cannot be solved.
    pub fn of(model: &Model<'_>, friction: f64, value: Option<f64>) -> Result<Self, IdentifyError> {
        // Equal steps of u, the radius of stick of a sphere: t = 1 - u^3. In u the displacement of a sphere is a parabola.
        let step = 1.0 / INTERVALS as f64;
        let fractions: Vec<f64> = (1..INTERVALS).map(|k| 1.0 - (1.0 - k as f64 * step).powi(3)).collect();
        let yielded = model.first_loading(friction, &fractions, value)?;
        Ok(Self::from_loading(&yielded))
    }

    /// From `h` at `u = 1 - k/n`, `k = 1, ... n - 1`.
    pub fn from_loading(yielded: &[f64]) -> Self {
        let count = yielded.len() + 1;
        let step = 1.0 / count as f64;
        // By k: h at u = k/n; nothing at u = 1, and at u = 0 by the parabola through the three before it.
        let mut by_radius: Vec<f64> = vec![0.0];
        by_radius.extend(yielded.iter().rev());
        by_radius.push(0.0);
        by_radius[0] = 3.0 * by_radius[1] - 3.0 * by_radius[2] + by_radius[3];
        // Simpson's rule for int h 3 u^2 du.
        let mean = (0..=count)
            .map(|k| {
                let weight = if k == 0 || k == count { 1.0 } else { [2.0, 4.0][k % 2] };
                let u = k as f64 * step;
                weight * step / 3.0 * by_radius[k] * 3.0 * u * u
            })
            .sum::<f64>();
        let half = {
            let at = 0.5_f64.cbrt() / step;
            let k = at.floor() as usize;
            let share = at - k as f64;
            let [before, here, after] = [by_radius[k - 1], by_radius[k], by_radius[k + 1]];
            here + share * (0.5 * (after - before) + share * 0.5 * (after - 2.0 * here + before))
        };
        let first = 1.0 - (1.0 - step).powi(3);
        Self { whole: by_radius[0], half: 2.0 * half, mean: 2.0 * mean, initial: yielded[0] / first }
    }

    /// The friction force of a loop in gross slip [force], from its energy and its half-width, each with its standard deviation; `None` in
    /// partial slip, and where these leave it unsure. Just beyond the onset, where it depends most on the half-width, the amplitude of force
    /// has to agree: the contact slides at the ends of the loop alone, with this force.
    pub fn friction_force(
        &self,
        [energy, of_energy]: [f64; 2],
        [opening, of_opening]: [f64; 2],
        amplitude: f64,
    ) -> Option<f64> {
        let chord = energy / (4.0 * opening);
        let missing = (self.mean - self.half) / opening;
        let root = 1.0 - 4.0 * missing * chord;
        let force =
            (energy > 0.0 && opening > 0.0 && root > 0.0).then(|| 2.0 * chord / (1.0 + root.sqrt()))?;
        // Derivatives of L - c L^2/delta_0 = W_d/(4 delta_0), relative.
        let part = missing * force;
        let unsure = ((1.0 - part) * of_energy / energy).hypot(of_opening / opening) / (1.0 - 2.0 * part);
        let onset = (self.whole - self.half) * force;
        let agrees = opening > NEAR * onset || (amplitude / force - 1.0).abs() < AGREES;
        (opening >= onset && unsure < UNSURE && agrees).then_some(force)
    }

    /// Whether the contact slides as a whole in a loop, by its half-width and its amplitudes, of displacement and force. Relative to the amplitude `A` at the actuator, it grows with `A` all
    /// along, in partial and in gross slip, and at the onset it is `(h(1) - 2 h(1/2))/(h(1) + 1/S)`: neither friction nor the force at the
    /// sharp ends of the loop is needed, which few points do not tell. Without `1/S` the amplitude of force has to serve.
    pub fn slides(&self, opening: f64, [length, force]: [f64; 2], stiffness: Option<f64>) -> bool {
        let limit = stiffness.map_or(force, |stiffness| length / (self.whole + 1.0 / stiffness));
        opening >= (self.whole - self.half) * limit
    }

    /// Way of the actuator from a turn to full sliding [length].
    pub fn way(&self, force: f64, stiffness: Option<f64>, slope: f64) -> f64 {
        let spring =
            stiffness.map_or_else(|| (1.0 / slope - self.initial).max(0.0), |stiffness| 1.0 / stiffness);
        2.0 * force * (self.whole + spring)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Mindlin: `h = 3/2 (1 - (1 - t)^(2/3))` of the initial compliance.
    #[test]
    fn the_flanks_of_spheres_are_those_of_the_closed_form() {
        let yielded: Vec<f64> = (1..12).map(|k| 1.5 * (1.0 - (1.0 - f64::from(k) / 12.0).powi(2))).collect();
        let flanks = Flanks::from_loading(&yielded);
        let half = 3.0 * (1.0 - 0.25_f64.cbrt());
        for (found, right) in [(flanks.whole, 1.5), (flanks.half, half), (flanks.mean, 1.2)] {
            // Simpson's rule of a polynomial of fourth degree.
            assert!((found - right).abs() < 1e-4, "{found} {right}");
        }
        // A loop in gross slip with L = 2, any spring, openings from the onset of sliding on; just below it there is none.
        for beyond in [0.0, 0.1, 1.0, 10.0] {
            let opening = 2.0 * (1.5 - half) + 1e-3 + beyond;
            let energy = 8.0 * (opening + 2.0 * (half - 1.2));
            assert!(
                (flanks.friction_force([energy, 0.0], [opening, 0.0], 2.0).unwrap() / 2.0 - 1.0).abs() < 1e-3
            );
            // A standard deviation of 5 % of either is too much, whatever the loop.
            assert_eq!(flanks.friction_force([energy, 0.05 * energy], [opening, 0.0], 2.0), None);
            assert_eq!(flanks.friction_force([energy, 0.0], [opening, 0.05 * opening], 2.0), None);
        }
    }
}
