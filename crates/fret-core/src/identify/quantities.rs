//! What is read from a measured cycle: energy, amplitudes, ratios, friction.

use super::cycles::MeasuredCycle;
use super::flanks::Flanks;
use super::turns::{at_turn, calm_range, falls, noise, parabola, slope};

/// Part of the way between the turns from which a plateau is read, and up to which.
const PLATEAU: [f64; 2] = [0.75, 0.98];
/// A plateau rises by less than this part of the slope after reversal.
const FLAT: f64 = 0.1;
/// Points from which a flank's middle is read by a parabola through that part of the amplitude of force on either side of it: at the
/// least. With fewer it is read between the two points beside it.
const FEWEST_OF_A_FLANK: usize = 6;
const FLANK: f64 = 0.5;

/// What is read from a cycle, in the units of the case.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quantities {
    /// Dissipated energy, the area of the loop [force x length].
    pub dissipated_energy: f64,
    /// Amplitude of the tangential force [force].
    pub force_amplitude: f64,
    /// Amplitude of the displacement of the actuator [length].
    pub displacement_amplitude: f64,
    /// Half-width of the loop at the middle of the force [length].
    pub opening: f64,
    /// Energy ratio `A = W_d/(4 Q* delta*)`.
    pub energy_ratio: f64,
    /// Sliding ratio `D = delta_0/delta*`.
    pub sliding_ratio: f64,
    /// The energy ratio of the contact without the rig, where its stiffness is told.
    pub contact_energy_ratio: Option<f64>,
    /// Its sliding ratio.
    pub contact_sliding_ratio: Option<f64>,
    /// Slope directly after reversal [force/length].
    pub slope: Option<f64>,
    /// Half of the distance of the plateaus over the normal force, in gross slip with points on the plateaus.
    pub plateau_friction: Option<f64>,
    /// From energy and opening, in gross slip.
    pub energy_friction: Option<f64>,
    /// Whether the contact slides as a whole, by the half-width beside the amplitude; nothing where it is not known how the contact yields.
    pub slides: Option<bool>,
}

/// What the quantities of a cycle are read with.
#[derive(Debug, Clone, Copy)]
pub struct Known<'a> {
    /// Normal force of the case [force].
    pub normal_force: f64,
    /// Stiffness of the rig, where it is told [force/length].
    pub stiffness: Option<f64>,
    /// How the contact itself yields, where that is known.
    pub flanks: Option<&'a Flanks>,
    /// Correlation of the noise of neighbouring points.
    pub correlation: f64,
}

/// A loop, seen from the actuator or from the contact.
#[derive(Debug, Clone, Copy)]
pub struct LoopShape {
    /// Enclosed energy.
    pub energy: f64,
    /// Half of the range of force.
    pub force_amplitude: f64,
    /// Half of the range of displacement.
    pub amplitude: f64,
    /// Half of its width at the middle of the force.
    pub opening: f64,
    /// Compliance there [length/force].
    pub compliance: f64,
    /// Variance of the half-width over that of a point's displacement.
    pub scatter: f64,
}

impl MeasuredCycle {
    /// What is read from the loop; of the contact's own too, with the stiffness of the rig.
    pub(super) fn quantities(&self, known: Known<'_>) -> Quantities {
        let own = self.loop_of(|row| self.displacement[row]);
        let contact = known
            .stiffness
            .map(|stiffness| self.loop_of(|row| self.displacement[row] - self.force[row] / stiffness));
        let pressed = self.normal_force.unwrap_or(known.normal_force);
        let LoopShape { energy, force_amplitude, amplitude, opening, .. } = own;
        let slope = self.slope_after_reversal();
        // In gross slip a flank goes as far as the amplitude is more than the half-width.
        let steep = slope.or_else(|| (amplitude > opening).then(|| force_amplitude / (amplitude - opening)));
        let friction = known.flanks.and_then(|flanks| {
            let [of_energy, of_opening] = self.unsure(&own, known.correlation);
            Some((
                flanks,
                flanks.friction_force([energy, of_energy], [opening, of_opening], force_amplitude)?,
            ))
        });
        Quantities {
            dissipated_energy: energy,
            force_amplitude,
            displacement_amplitude: amplitude,
            opening,
            energy_ratio: energy / (4.0 * force_amplitude * amplitude),
            sliding_ratio: opening / amplitude,
            contact_energy_ratio: contact.map(|own| own.energy / (4.0 * own.force_amplitude * own.amplitude)),
            contact_sliding_ratio: contact.map(|own| own.opening / own.amplitude),
            slope,
            plateau_friction: friction
                .and_then(|(flanks, limit)| self.plateau(steep?, flanks.way(limit, known.stiffness, steep?)))
                .map(|force| force / pressed),
            energy_friction: friction.map(|(_, limit)| limit / pressed),
            slides: known
                .flanks
                .map(|flanks| flanks.slides(opening, [amplitude, force_amplitude], known.stiffness)),
        }
    }

    /// The loop with displacements of its points.
    pub(super) fn loop_of(&self, displacement: impl Fn(usize) -> f64) -> LoopShape {
        let count = self.force.len();
        let places: Vec<f64> = (0..count).map(&displacement).collect();
        let [high, low] = self.turns.map(|turn| at_turn(&places, turn, [-1, 1]));
        let [bottom, top] = self.range_of_force();
        let force_amplitude = 0.5 * (top - bottom);
        let middle = f64::midpoint(bottom, top);
        let energy = (0..count)
            .map(|row| {
                let next = (row + 1) % count;
                0.5 * (self.force[row] + self.force[next]) * (places[next] - places[row])
            })
            .sum();
        let [falling, rising] =
            [true, false].map(|falling| self.middle_of_flank(&places, falling, [middle, force_amplitude]));
        LoopShape {
            energy,
            force_amplitude,
            amplitude: 0.5 * (high - low),
            opening: 0.5 * (rising.at - falling.at).abs(),
            compliance: 0.5 * (rising.compliance + falling.compliance),
            scatter: 0.25 * (rising.scatter + falling.scatter),
        }
    }

    /// Where a flank passes the middle of the force.
    fn middle_of_flank(&self, places: &[f64], falling: bool, [middle, amplitude]: [f64; 2]) -> Middle {
        let count = self.force.len();
        let points: Vec<[f64; 2]> = (0..count)
            .filter(|&row| self.is_falling(row) == falling)
            .map(|row| [(self.force[row] - middle) / amplitude, places[row]])
            .filter(|[force, _]| force.abs() < FLANK)
            .collect();
        if points.len() >= FEWEST_OF_A_FLANK
            && let Some([at, slope, scatter]) = parabola(&points)
        {
            return Middle { at, compliance: slope / amplitude, scatter };
        }
        let mut crossings: Vec<[f64; 2]> = Vec::new();
        for row in (0..count).filter(|&row| falls(row as f64 + 0.5, self.turns) == falling) {
            let next = (row + 1) % count;
            // Crossings of noise are averaged.
            if (self.force[row] - middle) * (self.force[next] - middle) <= 0.0
                && self.force[row] != self.force[next]
            {
                let compliance = (places[next] - places[row]) / (self.force[next] - self.force[row]);
                crossings.push([places[row] + (middle - self.force[row]) * compliance, compliance]);
            }
        }
        let mean = |k: usize| {
            crossings.iter().map(|crossing| crossing[k]).sum::<f64>() / crossings.len().max(1) as f64
        };
        // A place between two points has 2/3 of the variance of one, in the mean.
        Middle { at: mean(0), compliance: mean(1), scatter: 2.0 / 3.0 }
    }

    /// Standard deviations of energy and half-width of a loop by the noise of its points.
    fn unsure(&self, of: &LoopShape, correlation: f64) -> [f64; 2] {
        let [force, length] = [&self.force, &self.displacement].map(|values| noise(values, correlation));
        let point = length.hypot(force * of.compliance);
        let scatter = (of.scatter * times_fewer(correlation)).min(0.5);
        [self.unsure_work(correlation), point * scatter.sqrt()]
    }

    /// Standard deviation of the enclosed work by the noise of the points, whose neighbours are correlated by so much.
    pub(super) fn unsure_work(&self, correlation: f64) -> f64 {
        let count = self.force.len();
        let (mut by_force, mut by_length) = (0.0, 0.0);
        for row in 0..count {
            let (before, after) = ((row + count - 1) % count, (row + 1) % count);
            by_force += (0.5 * (self.displacement[after] - self.displacement[before])).powi(2);
            by_length += (0.5 * (self.force[after] - self.force[before])).powi(2);
        }
        let [force, length] = [&self.force, &self.displacement].map(|values| noise(values, correlation));
        ((force * force * by_force + length * length * by_length) * times_fewer(correlation)).sqrt()
    }

    /// Smallest and largest force: those at the ends of the branches, where the loop has its corners, or beyond them where a branch has
    /// its extreme on the way.
    fn range_of_force(&self) -> [f64; 2] {
        let [bottom, top] = calm_range(&self.force);
        // Not beyond the last point of a branch: its force ends there, or rises on.
        let [first, last] = self.turns.map(|turn| at_turn(&self.force, turn.floor(), [-1]));
        [bottom.min(first).min(last), top.max(first).max(last)]
    }

    /// Slope of the loop directly after both reversals: a line through the points of the first third of the change of force.
    pub(super) fn slope_after_reversal(&self) -> Option<f64> {
        let [bottom, top] = calm_range(&self.force);
        let count = self.force.len();
        let slopes: Vec<f64> = [top, bottom]
            .into_iter()
            .zip(self.turns)
            .filter_map(|(begins, turn)| {
                let mut points = Vec::new();
                for step in 0..count / 2 {
                    let row = (turn.ceil() as usize + step) % count;
                    let share = (self.force[row] - begins).abs() / (top - bottom);
                    if share > 0.4 {
                        break;
                    }
                    if share > 0.04 {
                        points.push([self.displacement[row], self.force[row]]);
                    }
                }
                slope(&points)
            })
            .filter(|slope| *slope > 0.0)
            .collect();
        (!slopes.is_empty()).then(|| slopes.iter().sum::<f64>() / slopes.len() as f64)
    }

    /// Half of the distance of the plateaus of sliding [force], which begin so far behind a turn: means over the last part of the way,
    /// unless they rise.
    pub(super) fn plateau(&self, steep: f64, flank: f64) -> Option<f64> {
        let [high, low] = self.turns.map(|turn| at_turn(&self.displacement, turn, [-1, 1]));
        let from = PLATEAU[0].max(flank / (high - low));
        let side = |falling: bool| {
            let points: Vec<[f64; 2]> = (0..self.force.len())
                .filter(|&row| self.is_falling(row) == falling)
                .map(|row| [self.displacement[row], self.force[row]])
                .filter(|[d, _]| {
                    let done = if falling { (high - d) / (high - low) } else { (d - low) / (high - low) };
                    (from..PLATEAU[1]).contains(&done)
                })
                .collect();
            let rise = slope(&points)?;
            let count = points.len() as f64;
            let [along, force] = [0, 1].map(|k| points.iter().map(|point| point[k]).sum::<f64>() / count);
            let (mut off, mut wide) = (0.0, 0.0);
            for [d, q] in points {
                off += (q - force - rise * (d - along)).powi(2);
                wide += (d - along).powi(2);
            }
            // What noise makes of the slope of a flat plateau: two standard deviations.
            let unsure = 2.0 * (off / (count - 2.0) / wide).sqrt();
            (rise.abs() < FLAT * steep + unsure).then_some(force)
        };
        Some(0.5 * (side(false)? - side(true)?).abs())
    }
}

/// Where a flank passes the middle of the force.
struct Middle {
    /// Displacement [length].
    at: f64,
    /// Its derivative by the force [length/force].
    compliance: f64,
    /// Variance of the place over that of a point's displacement.
    scatter: f64,
}

/// So many times fewer independent points are as good as those whose neighbours are correlated.
fn times_fewer(correlation: f64) -> f64 {
    (1.0 + correlation) / (1.0 - correlation)
}
