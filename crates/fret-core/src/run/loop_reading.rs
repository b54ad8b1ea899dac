//! What is read from a loop of force against displacement: amplitudes, half-width at the middle force, stiffness after reversal.

/// A force whose range is so much of it is constant: what is left is rounding.
const CONSTANT: f64 = 1e-12;

/// A point of a loop, at the end of an increment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoopPoint {
    /// Force along the axis of the loop, or moment.
    pub force: f64,
    /// Displacement along it, or twist.
    pub displacement: f64,
    /// Way by which the whole contact has slid at the end of the increment [length], 0 where some of it sticks.
    pub slid: f64,
    /// Energy dissipated so far less the work of the bulk stress [force x length].
    pub dissipated: f64,
}

/// The numbers of a loop.
#[derive(Debug, Clone, PartialEq)]
pub struct LoopReading {
    /// Half of the range of the force.
    pub force_amplitude: f64,
    /// Half of the range of the displacement.
    pub displacement_amplitude: f64,
    /// Half-width at the middle of the range of the force.
    pub opening: f64,
    /// Slope directly after reversal.
    pub stiffness: Option<f64>,
    /// Whether the loop slides as a whole both ways, so that width and slope are those of its [`Flank`]s.
    pub slides: bool,
}

impl LoopReading {
    /// Reads the points of a cycle, the one that it starts from first.
    pub fn of(points: &[LoopPoint]) -> Self {
        let range = |of: fn(&LoopPoint) -> f64| {
            points.iter().map(of).fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
                (low.min(value), high.max(value))
            })
        };
        let (force, displacement) = (range(|point| point.force), range(|point| point.displacement));
        // A contact that rolls under one force has no loop of it.
        let half = 0.5 * (force.1 - force.0);
        let is_constant = half <= CONSTANT * force.1.abs().max(force.0.abs());
        let read = Self {
            force_amplitude: if is_constant { 0.0 } else { half },
            displacement_amplitude: 0.5 * (displacement.1 - displacement.0),
            opening: 0.0,
            stiffness: None,
            slides: false,
        };
        let flanks = [1.0, -1.0].map(|side| Flank::of(points, side));
        let Some(one) = flanks.iter().flatten().next() else {
            let (opening, stiffness) = (chord_width(points, force), secant(points, force));
            return Self { opening, stiffness, ..read };
        };
        let opening = match &flanks {
            [Some(down), Some(up)] => 0.5 * (down.middle() - up.middle()).abs(),
            // One flank ends in another cycle: it is like the other.
            _ => (one.middle() - f64::midpoint(displacement.0, displacement.1)).abs(),
        };
        Self { opening, stiffness: Some(one.slope()), slides: true, ..read }
    }

    /// `Q* d*` [force x length], by which the loops of shift and twist are compared.
    pub fn work_scale(&self) -> f64 {
        self.force_amplitude * self.displacement_amplitude
    }
}

/// A force nearer to the middle one than this share of the range is at it: which side it lies on is what the solver leaves.
const AT_MIDDLE: f64 = 1e-6;

/// Half-width at the middle force by the chords between the points.
fn chord_width(points: &[LoopPoint], force: (f64, f64)) -> f64 {
    let middle = f64::midpoint(force.0, force.1);
    let above = |point: &LoopPoint| {
        let above = point.force - middle;
        if above.abs() <= AT_MIDDLE * (force.1 - force.0) { 0.0 } else { above }
    };
    let mut crossings = (f64::INFINITY, f64::NEG_INFINITY);
    for pair in points.windows(2) {
        let [(f0, d0), (f1, d1)] = [0, 1].map(|i| (above(&pair[i]), pair[i].displacement));
        if f0 * f1 <= 0.0 && f0 != f1 {
            let at = d0 - (d1 - d0) * f0 / (f1 - f0);
            crossings = (crossings.0.min(at), crossings.1.max(at));
        }
    }
    if crossings.0 <= crossings.1 { 0.5 * (crossings.1 - crossings.0) } else { 0.0 }
}

/// Slope over the first increment back from the largest force, or else from the smallest.
fn secant(points: &[LoopPoint], force: (f64, f64)) -> Option<f64> {
    // On the plateau of sliding the force differs by what the solver leaves.
    let nearly = 1e-6 * (force.1 - force.0);
    let back_from = |turn: Option<usize>| {
        let pair = points.get(turn?..turn? + 2)?;
        let slope = (pair[0].force - pair[1].force) / (pair[0].displacement - pair[1].displacement);
        (slope.is_finite() && slope > 0.0).then_some(slope)
    };
    let highest = points.iter().rposition(|point| point.force >= force.1 - nearly);
    let lowest = points.iter().rposition(|point| point.force <= force.0 + nearly);
    back_from(highest).or_else(|| back_from(lowest))
}

/// Forces are those of a plateau of sliding up to this, relative to it: where slip turns into the direction of the motion little by little the
/// plateau is not quite level.
const LEVEL: f64 = 1e-2;

/// The way from one plateau of sliding to the other, between reversal and the place from which on all of the contact slides. Increments
/// need not resolve it: where it ends follows from the way slid since, and its area from the energy dissipated on it, as the elastic
/// energy is the same on both plateaus. Between known points it is a power of what is left of it, `left = (1 - way)^exponent`:
/// of identical bodies without coupling exactly so for a sphere (Mindlin & Deresiewicz 1953, exponent 3/2), and nearly so for others.
struct Flank {
    /// Force of the plateau, its magnitude.
    plateau: f64,
    exponent: f64,
    /// Displacement, and fraction of the change of the force that is left, at the known points from reversal to sliding.
    points: Vec<(f64, f64)>,
}

impl Flank {
    /// The first whole flank that leaves the plateau on a `side` of the force (1 or -1), if there is one.
    fn of(points: &[LoopPoint], side: f64) -> Option<Self> {
        let highest = points.iter().map(|point| side * point.force).fold(f64::NEG_INFINITY, f64::max);
        let lowest = points.iter().map(|point| side * point.force).fold(f64::INFINITY, f64::min);
        let plateau = 0.5 * (highest - lowest);
        let near = LEVEL * plateau;
        if plateau.is_nan() || plateau <= 0.0 || (highest + lowest).abs() > near {
            return None;
        }
        let falls = |k: usize| side * (points[k].displacement - points[k - 1].displacement) < 0.0;
        let turns = |k: &usize| {
            side * points[k - 1].force >= highest - near && falls(*k) && (*k == 1 || !falls(k - 1))
        };
        let reversal = (1..points.len()).find(turns)? - 1;
        let end = (reversal + 1..points.len()).find(|&k| points[k].slid > 0.0 || !falls(k))?;
        let (from, to) = (&points[reversal], &points[end]);
        if !falls(end) || side * to.force > lowest + near {
            return None;
        }
        let way = side * (from.displacement - to.displacement);
        let length = way - to.slid;
        if length.is_nan() || length <= 0.0 {
            return None;
        }
        let dissipated = to.dissipated - from.dissipated - plateau * to.slid;
        // Area between the flank and its end, as a fraction of that of its rectangle: a half of a line, more where it bends.
        let area = (0.5 + 0.5 * dissipated / (length * plateau)).clamp(0.5, 0.8);
        let left = |point: &LoopPoint| ((side * point.force - lowest) / (2.0 * plateau)).clamp(0.0, 1.0);
        let mut known: Vec<(f64, f64)> =
            points[reversal..end].iter().map(|point| (point.displacement, left(point))).collect();
        known.push((from.displacement - side * length, 0.0));
        known[0].1 = 1.0;
        Some(Self { plateau, exponent: area / (1.0 - area), points: known })
    }

    /// What is left of the way, from what is left of the change of the force.
    fn way_left(&self, force_left: f64) -> f64 {
        force_left.powf(1.0 / self.exponent)
    }

    /// Displacement at the middle force.
    fn middle(&self) -> f64 {
        let at =
            self.points.iter().position(|(_, left)| *left <= 0.5).unwrap_or(self.points.len() - 1).max(1);
        let [(d0, w0), (d1, w1)] = [at - 1, at].map(|k| (self.points[k].0, self.way_left(self.points[k].1)));
        d0 + (d1 - d0) * (w0 - self.way_left(0.5)) / (w0 - w1)
    }

    /// Slope directly after reversal.
    fn slope(&self) -> f64 {
        let [(d0, _), (d1, left)] = [self.points[0], self.points[1]];
        2.0 * self.plateau * self.exponent * (1.0 - self.way_left(left)) / (d1 - d0).abs()
    }
}

#[cfg(test)]
mod tests;
