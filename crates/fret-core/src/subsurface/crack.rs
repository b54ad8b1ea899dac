//! A short crack from the surface through a cycle of stress: does it grow, where does it stop, how long does it take?

use serde::Serialize;

use super::edge_crack::{EdgeCrack, stress_intensity};
use super::fatigue::CrackConstants;
use super::tensor::StressTensor;

/// Lengths at which a crack is looked at, from the first to the last by equal factors.
const LENGTHS: usize = 161;

/// Stress along the straight path of a crack, without the crack.
#[derive(Debug, Clone, PartialEq)]
pub struct CrackPath {
    /// Angle from the inward normal of the surface towards `horizontal` [radians].
    pub angle: f64,
    /// Unit vector in the surface `(x, y)` towards which the crack leans.
    pub horizontal: [f64; 2],
    /// Depths below the surface [length], from 0, not falling; an interface twice.
    pub depths: Vec<f64>,
    /// Stress `[increment][depth]`.
    pub stress: Vec<Vec<StressTensor>>,
}

/// A crack of one length in the cycle. It is closed where its stress intensity would be negative, and then carries none.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct CrackLength {
    /// Length [length].
    pub length: f64,
    /// Largest `K_I` of the cycle [pressure x sqrt(length)]; 0 where the crack never opens.
    pub largest: f64,
    /// Range of `K_I` while the crack is open.
    pub range: f64,
    /// Range of `K_II`, as if the faces slid without friction.
    pub sliding_range: f64,
    /// Threshold of a crack of this length: `threshold sqrt(l/(l + l0))`.
    pub threshold: f64,
    /// Cycles from the initial length on; `None` where no constants of growth are given, or it does not come so far.
    pub cycles: Option<f64>,
}

/// What becomes of the crack.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum CrackFate {
    /// Below the threshold at its initial length.
    DoesNotGrow,
    /// It grows and falls below the threshold.
    Stops,
    /// It reaches the final length.
    Grows,
    /// Its largest stress intensity reaches the toughness.
    Fractures,
}

/// The course of a crack.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CrackCourse {
    /// What becomes of it.
    pub fate: CrackFate,
    /// Length at which it stops, fractures or is followed no further [length].
    pub length: f64,
    /// Cycles to that length; `None` without constants of growth, or where it stops (it comes near that length for ever more slowly).
    pub cycles: Option<f64>,
    /// All lengths from the initial to the final one.
    pub lengths: Vec<CrackLength>,
}

impl CrackPath {
    /// Stress at a depth in an increment: linear between the depths, the last one beyond.
    fn at(&self, increment: usize, depth: f64) -> StressTensor {
        let stress = &self.stress[increment];
        let below = self.depths.partition_point(|known| *known < depth);
        let (Some(last), true) = (stress.last(), below < self.depths.len()) else {
            return stress.last().copied().unwrap_or_default();
        };
        let Some(above) = below.checked_sub(1) else { return stress.first().copied().unwrap_or(*last) };
        let share = (depth - self.depths[above]) / (self.depths[below] - self.depths[above]);
        let [from, to] = [stress[above].0, stress[below].0];
        StressTensor(std::array::from_fn(|part| from[part] + share * (to[part] - from[part])))
    }
}

/// A crack along a path through the cycle; `None` where the path leaves the normal by more than [`super::edge_crack::STEEPEST`].
///
/// `K_I` by the weight function of a crack in a half-plane of one material: the crack is long along the surface, straight, and the
/// stiffness of layers enters through the stress alone. It grows where the open range of `K_I` exceeds El Haddad's threshold, by Paris' law
/// `C dK^m` (trapezoidal rule over the logarithm of the length).
pub fn crack_course(path: &CrackPath, constants: &CrackConstants) -> Option<CrackCourse> {
    let crack = EdgeCrack::new(path.angle)?;
    let (first, last) = (constants.initial_length, constants.final_length);
    let factor = (last / first).powf(1.0 / (LENGTHS - 1) as f64);
    let lengths = (0..LENGTHS).map(|n| match n {
        0 => first,
        n if n == LENGTHS - 1 => last,
        n => first * factor.powi(n as i32),
    });
    let mut lengths: Vec<CrackLength> =
        lengths.map(|length| at_length(path, &crack, constants, length)).collect();
    let grows = |at: &CrackLength| at.range > at.threshold;
    let fractures = |at: &CrackLength| constants.toughness.is_some_and(|toughness| at.largest >= toughness);
    let end = lengths.iter().position(|at| fractures(at) || !grows(at));
    let (fate, length) = match end {
        Some(end) if fractures(&lengths[end]) => (CrackFate::Fractures, lengths[end].length),
        Some(0) => (CrackFate::DoesNotGrow, first),
        Some(end) => {
            let excess = |at: &CrackLength| at.range - at.threshold;
            let [before, after] = [&lengths[end - 1], &lengths[end]];
            let share = excess(before) / (excess(before) - excess(after));
            (CrackFate::Stops, before.length + share * (after.length - before.length))
        }
        None => (CrackFate::Grows, last),
    };
    let followed = end.map_or(LENGTHS, |end| if fate == CrackFate::Fractures { end + 1 } else { end });
    if let Some((coefficient, exponent)) = constants.paris_coefficient.zip(constants.paris_exponent) {
        let per_log = |at: &CrackLength| at.length / (coefficient * at.range.powf(exponent));
        let mut cycles = 0.0;
        for n in 0..followed {
            if n > 0 {
                cycles += 0.5 * factor.ln() * (per_log(&lengths[n - 1]) + per_log(&lengths[n]));
            }
            lengths[n].cycles = Some(cycles).filter(|cycles| cycles.is_finite());
        }
    }
    let cycles = match fate {
        CrackFate::Grows | CrackFate::Fractures => followed.checked_sub(1).and_then(|n| lengths[n].cycles),
        CrackFate::DoesNotGrow | CrackFate::Stops => None,
    };
    Some(CrackCourse { fate, length, cycles, lengths })
}

fn at_length(path: &CrackPath, crack: &EdgeCrack, constants: &CrackConstants, length: f64) -> CrackLength {
    let down = crack.direction()[1];
    let breaks: Vec<f64> = path.depths.iter().map(|depth| depth / down).collect();
    let points = crack.points(length, &breaks);
    let (mut opening, mut sliding) = ([f64::INFINITY, 0.0_f64], [f64::INFINITY, f64::NEG_INFINITY]);
    for increment in 0..path.stress.len() {
        let tractions = points
            .iter()
            .map(|point| crack.tractions(&path.at(increment, point.distance * down), path.horizontal));
        let [one, two] = stress_intensity(&points, tractions);
        opening = [opening[0].min(one), opening[1].max(one)];
        sliding = [sliding[0].min(two), sliding[1].max(two)];
    }
    let largest = opening[1].max(0.0);
    let range = (largest - opening[0].max(0.0)).max(0.0);
    let threshold = constants.threshold * (length / (length + constants.short_crack_length)).sqrt();
    let sliding_range = (sliding[1] - sliding[0]).max(0.0);
    CrackLength { length, largest, range, sliding_range, threshold, cycles: None }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    const CONSTANTS: CrackConstants = CrackConstants {
        threshold: 3.0,
        short_crack_length: 1e-4,
        initial_length: 1e-5,
        final_length: 1e-2,
        paris_coefficient: Some(1e-11),
        paris_exponent: Some(3.0),
        toughness: None,
    };

    /// Uniform tension between two values, over a depth at which it ends.
    fn path(range: [f64; 2], ends: f64) -> CrackPath {
        let uniform = |value: f64| {
            let depths = [1.0, 1.0, 0.0, 0.0];
            depths.map(|part| StressTensor([part * value, 0.0, 0.0, 0.0, 0.0, 0.0])).to_vec()
        };
        CrackPath {
            angle: 0.0,
            horizontal: [1.0, 0.0],
            depths: vec![0.0, ends, ends, 1.0],
            stress: range.map(uniform).to_vec(),
        }
    }

    /// `N = int dl/(C (1.12152 s sqrt(pi l))^3)` in closed form; threshold met at `l + l0 = (3/(1.12152 s))^2/pi`.
    #[test]
    fn uniform_tension_has_the_life_of_the_closed_form() {
        let stress = 200.0;
        let course = crack_course(&path([-50.0, stress], 0.5), &CONSTANTS).unwrap();
        assert_eq!(course.fate, CrackFate::Grows);
        let rate = 1e-11 * (1.121_522_26 * stress * PI.sqrt()).powi(3);
        let exact = 2.0 / rate * (1.0 / 1e-5_f64.sqrt() - 1.0 / 1e-2_f64.sqrt());
        let found = course.cycles.unwrap();
        assert!((found / exact - 1.0).abs() < 2e-4, "{found} {exact}"); // 160 steps by a factor of 1.044: 1e-4 of the trapezoids
        let first = course.lengths[0];
        assert!((first.range / (1.121_522_26 * stress * (PI * 1e-5).sqrt()) - 1.0).abs() < 1e-5);
        assert!((first.threshold / 3.0 - (1e-5_f64 / 1.1e-4).sqrt()).abs() < 1e-12);
    }

    /// By Kitagawa and El Haddad the limit is `s = threshold / (1.12152 sqrt(pi (l + l0)))`: below it nothing grows.
    #[test]
    fn the_limit_of_kitagawa_lies_between_growing_and_not() {
        let limit = 3.0 / (1.121_522_26 * (PI * 1.1e-4).sqrt());
        let fate = |stress: f64| crack_course(&path([0.0, stress], 0.5), &CONSTANTS).unwrap().fate;
        assert_eq!(fate(0.999 * limit), CrackFate::DoesNotGrow);
        assert_eq!(fate(1.001 * limit), CrackFate::Grows);
    }

    /// Tension that ends at a depth: beyond it the crack is loaded over its first part only. Tada's Green's function
    /// `2 (1.3 - 0.3 t^(5/4))/sqrt(pi l (1 - t^2))` gives the length at which the range falls below the threshold, within 1 %.
    #[test]
    fn a_crack_stops_where_the_stress_has_faded() {
        let (stress, ends) = (170.0, 2e-4);
        let course = crack_course(&path([0.0, stress], ends), &CONSTANTS).unwrap();
        assert_eq!(course.fate, CrackFate::Stops);
        let handbook = |length: f64| {
            let steps = 200_000;
            let top = (ends / length).min(1.0).asin();
            let sum: f64 = (0..steps)
                .map(|n| {
                    let t = (top * (f64::from(n) + 0.5) / f64::from(steps)).sin();
                    1.3 - 0.3 * t.powf(1.25)
                })
                .sum();
            2.0 * stress * (length / PI).sqrt() * sum * top / f64::from(steps)
        };
        let threshold = 3.0 * (course.length / (course.length + 1e-4)).sqrt();
        assert!((handbook(course.length) / threshold - 1.0).abs() < 0.01, "{}", course.length);
        assert!(course.length > ends && course.cycles.is_none());
    }

    #[test]
    fn a_crack_under_pressure_is_closed() {
        let course = crack_course(&path([-300.0, -10.0], 0.5), &CONSTANTS).unwrap();
        assert_eq!(course.fate, CrackFate::DoesNotGrow);
        assert!(course.lengths.iter().all(|at| at.range == 0.0 && at.largest == 0.0));
    }

    #[test]
    fn at_the_toughness_it_runs_through() {
        let tough = CrackConstants { toughness: Some(10.0), ..CONSTANTS };
        let course = crack_course(&path([0.0, 200.0], 0.5), &tough).unwrap();
        assert_eq!(course.fate, CrackFate::Fractures);
        let exact = (10.0_f64 / (1.121_522_26_f64 * 200.0)).powi(2) / PI;
        assert!((course.length / exact - 1.0).abs() < 0.05 && course.cycles.is_some()); // to one of the lengths
    }
}
