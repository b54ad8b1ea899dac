//! The feet of measured points on a loop, and how far the points are off it: see `fit` for the distance that is meant.

use super::computed::Loop;
use super::turns::falls;

/// Points nearer to a turn than so many rows lie next to it: so well the displacement tells it.
const AT_TURN: f64 = 1.5;
/// Steps to the foot of a point.
const STEPS_TO_FOOT: usize = 3;

/// Points of a cycle: displacement without offset and drift, force without offset, row by row.
pub struct Points {
    /// Displacements [length].
    pub places: Vec<f64>,
    /// Forces [force].
    pub forces: Vec<f64>,
}

/// The foot of a point on the loop.
struct Foot {
    /// Whether the point lies on the way down.
    falling: bool,
    /// Displacement [length].
    at: f64,
    /// Slope of the loop there [force/length].
    slope: f64,
    /// One over the noise of a distance in direction of the force.
    weight: f64,
}

/// The feet of all points of a cycle.
#[derive(Default)]
pub struct Feet(Vec<Foot>);

impl Feet {
    /// Feet on a loop: at the measured displacements, or, where they are to be `near`, nearest in units of the noise of displacement and
    /// force. `turns`: rows at which the cycle turns.
    pub fn on(of: &Loop, points: &Points, turns: [f64; 2], [length, force]: [f64; 2], near: bool) -> Self {
        let Points { places, forces } = points;
        let count = places.len();
        let near_turn = |row: usize| {
            let apart = |turn: f64| {
                let rows = (row as f64 - turn).rem_euclid(count as f64);
                rows.min(count as f64 - rows)
            };
            near && apart(turns[0]).min(apart(turns[1])) < AT_TURN
        };
        // Next to a turn it is open on which side of it a point lies: on that whose branch is nearer.
        let off = |row: usize, falling: bool| {
            let [expected, slope] = of.at(falling, places[row]);
            ((forces[row] - expected) / force.hypot(slope * length)).abs()
        };
        let foot = |(row, &place): (usize, &f64)| {
            let falling =
                if near_turn(row) { off(row, true) < off(row, false) } else { falls(row as f64, turns) };
            let mut at = place;
            for _ in 0..if near { STEPS_TO_FOOT } else { 0 } {
                let [expected, slope] = of.at(falling, at);
                let off = forces[row] - expected - slope * (place - at);
                at = place + slope * off / ((force / length).powi(2) + slope * slope);
            }
            let slope = of.at(falling, at)[1];
            Foot { falling, at, slope, weight: 1.0 / force.hypot(slope * length) }
        };
        Self(places.iter().enumerate().map(foot).collect())
    }

    /// Distances of the points from another loop near to that of the feet, in units of the noise.
    pub fn distances(&self, of: &Loop, points: &Points) -> Vec<f64> {
        let off = |((foot, place), force): ((&Foot, &f64), &f64)| {
            let expected = of.at(foot.falling, foot.at)[0] + foot.slope * (place - foot.at);
            foot.weight * (force - expected)
        };
        self.0.iter().zip(&points.places).zip(&points.forces).map(off).collect()
    }

    /// Slope of the loop at every foot, and one over the noise of a distance in direction of the force there.
    pub fn slopes(&self) -> impl Iterator<Item = [f64; 2]> {
        self.0.iter().map(|foot| [foot.slope, foot.weight])
    }
}
