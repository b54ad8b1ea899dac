//! The feet of measured points on the curve, and how far the points are from it.

use super::fit::Fit;
use super::indenter::Pressing;
use super::load_curve::{Curve, Foot};

/// Steps to the foot of a point.
const STEPS_TO_FOOT: usize = 4;

impl<P: Pressing> Fit<'_, P> {
    /// The feet of the points on the curve as it is.
    pub fn find_feet(&mut self) {
        let Some(now) = &self.now else { return };
        let ([length, force], touch, frame) = (self.noises, self.touch(), self.frame());
        let foot = |(depth, load): (&f64, &f64)| {
            let measured = depth - touch;
            let mut seen = now.seen(measured, frame);
            for _ in 0..STEPS_TO_FOOT {
                let at = seen.depth + frame * seen.load;
                let off = load - seen.load - seen.slope * (measured - at);
                let step = seen.slope * off / ((force / length).powi(2) + seen.slope * seen.slope);
                seen = now.seen(measured + step, frame);
            }
            Foot { depth: seen.depth, slope: seen.slope, weight: 1.0 / force.hypot(seen.slope * length) }
        };
        self.feet = self.depths.iter().zip(self.loads).map(foot).collect();
    }

    /// Weighted distances of the points.
    pub fn distances(&self, curve: &Curve) -> Vec<f64> {
        let (touch, frame) = (self.touch(), self.frame());
        let points = self.depths.iter().zip(self.loads).zip(&self.feet);
        points
            .map(|((depth, load), foot)| {
                let [expected, _] = curve.at(foot.depth);
                let along = depth - touch - foot.depth - frame * expected;
                foot.weight * (load - expected - foot.slope * along)
            })
            .collect()
    }
}
