//! Numbers of a case scaled before the fit, so that their curve has loads of the size of the measured ones.

use super::super::error::IdentifyError;
use super::super::turns::range;
use super::fit::Fit;
use super::indenter::Pressing;

/// Loads are compared from this part of the largest one on, where a guessed touch hardly matters.
const COMPARED: f64 = 0.2;
/// Numbers are scaled while the computed loads are off by more than this, in the logarithm: so near the fit itself comes, touch and all.
const NEAR: f64 = 0.3;
/// Steps of the scaling, and how far the logarithm of a number goes in one of them.
const SCALINGS: usize = 8;
const LONGEST: f64 = 3.0;
/// A step that leaves more than this part of what the loads were off is taken back, and half of it tried, so many times.
const GAINS: f64 = 0.7;
const HALVINGS: usize = 3;

impl<P: Pressing> Fit<'_, P> {
    /// Scales the numbers until the computed loads are of the size of the measured ones, with touch and frame as they are: load at a given depth
    /// is nearly a power of each number. From a modulus that is three times too large the touch would otherwise run away.
    pub fn scaled(mut self, name: &str) -> Result<Self, IdentifyError> {
        self.solve_on_new_grid(name)?;
        let mut off = self.compared();
        for _ in 0..SCALINGS {
            let Some((by, step)) = off.as_ref().and_then(|(off, by)| {
                let square: f64 = by.iter().map(|by| by * by).sum();
                (off.abs() > NEAR && square > 0.0)
                    .then(|| (*off, by.iter().map(|by| by * off / square).collect::<Vec<f64>>()))
            }) else {
                return Ok(self);
            };
            let longest = step.iter().fold(0.0_f64, |longest, step| longest.max(step.abs()));
            let part = (LONGEST / longest).min(1.0);
            let tried = (0..HALVINGS).find_map(|halvings| {
                let mut next = self.clone();
                for (k, step) in step.iter().enumerate() {
                    next.parameters[k] += step * part * 0.5_f64.powi(halvings as i32);
                }
                next.solve_on_new_grid(name).ok()?;
                let found = next.compared()?;
                (found.0.abs() < GAINS * by.abs()).then_some((next, found))
            });
            let Some((next, found)) = tried else { return Ok(self) };
            (self, off) = (next, Some(found));
        }
        Ok(self)
    }

    /// How far the measured loads are above the computed ones, and the derivatives of these by the numbers, all in logarithms and in the mean.
    fn compared(&self) -> Option<(f64, Vec<f64>)> {
        let now = self.now.as_ref()?;
        let [_, most] = range(self.loads);
        let rows = self.loads.iter().copied().zip(self.own_depths());
        let rows: Vec<[f64; 2]> = rows
            .filter(|(load, depth)| *load > COMPARED * most && *depth > 0.0)
            .map(|(load, depth)| [load, depth])
            .collect();
        let mean = |of: &dyn Fn(&[f64; 2]) -> f64| rows.iter().map(of).sum::<f64>() / rows.len() as f64;
        let off = mean(&|[load, depth]| (load / now.at(*depth)[0]).ln());
        let by = |k: usize| mean(&|[_, depth]| now.by(k, *depth) / now.at(*depth)[0]);
        off.is_finite().then(|| (off, (0..self.start.len()).map(by).collect()))
    }
}
