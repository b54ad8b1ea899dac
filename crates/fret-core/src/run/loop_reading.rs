//! What is read from a loop of force against displacement: amplitudes, half-width at the middle force, stiffness after reversal. Of numbers of any
//! kind: with their slopes these are those of the loop.

use crate::fields::Scalar;

/// A force whose range is so much of it is constant: what is left is rounding.
pub(super) const CONSTANT: f64 = 1e-12;

/// A point of a loop, at the end of an increment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoopPoint<R> {
    /// Force along the axis of the loop, or moment.
    pub force: R,
    /// Displacement along it, or twist.
    pub displacement: R,
    /// Way by which the whole contact has slid at the end of the increment [length], 0 where some of it sticks.
    pub slid: R,
    /// Energy dissipated so far less the work of the bulk stress [force x length].
    pub dissipated: R,
}

/// The numbers of a loop.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoopReading<R> {
    /// Half of the range of the force.
    pub force_amplitude: R,
    /// Half of the range of the displacement.
    pub displacement_amplitude: R,
    /// Half-width at the middle of the range of the force.
    pub opening: R,
    /// Slope directly after reversal.
    pub stiffness: Option<R>,
    /// Whether the loop slides as a whole both ways, so that width and slope are those of its [`Flank`]s.
    pub slides: bool,
}

impl<R: Scalar> LoopReading<R> {
    /// Reads the points of a cycle, the one that it starts from first.
    pub fn of(points: &[LoopPoint<R>]) -> Self {
        let range = |of: fn(&LoopPoint<R>) -> R| {
            let none = (R::of(f64::INFINITY), R::of(f64::NEG_INFINITY));
            points.iter().map(of).fold(none, |(low, high), value| (low.min(value), high.max(value)))
        };
        let (force, displacement) = (range(|point| point.force), range(|point| point.displacement));
        // A contact that rolls under one force has no loop of it.
        let half = (force.1 - force.0) * 0.5;
        let largest = force.1.value().abs().max(force.0.value().abs());
        let is_constant = half.value() <= CONSTANT * largest;
        let read = Self {
            force_amplitude: if is_constant { R::of(0.0) } else { half },
            displacement_amplitude: (displacement.1 - displacement.0) * 0.5,
            opening: R::of(0.0),
            stiffness: None,
            slides: false,
        };
        if is_constant {
            return read;
        }
        let flanks = [1.0, -1.0].map(|side| Flank::of(points, side));
        let Some(one) = flanks.iter().flatten().next() else {
            let (opening, stiffness) = (chord_width(points, force), secant(points, force));
            return Self { opening, stiffness, ..read };
        };
        let opening = match &flanks {
            [Some(down), Some(up)] => (down.middle() - up.middle()).size() * 0.5,
            // One flank ends in another cycle: it is like the other.
            _ => (one.middle() - middle_of(displacement)).size(),
        };
        Self { opening, stiffness: Some(one.slope()), slides: true, ..read }
    }

    /// `Q* d*` [force x length], by which the loops of shift and twist are compared.
    pub fn work_scale(&self) -> R {
        self.force_amplitude * self.displacement_amplitude
    }
}

fn middle_of<R: Scalar>((low, high): (R, R)) -> R {
    (low + high) * 0.5
}

/// A force nearer to the middle one than this share of the range is at it: which side it lies on is what the solver leaves.
const AT_MIDDLE: f64 = 1e-6;

/// Half-width at the middle force by the chords between the points.
fn chord_width<R: Scalar>(points: &[LoopPoint<R>], force: (R, R)) -> R {
    let middle = middle_of(force);
    let range = force.1.value() - force.0.value();
    let above = |point: &LoopPoint<R>| {
        let above = point.force - middle;
        if above.value().abs() <= AT_MIDDLE * range { R::of(0.0) } else { above }
    };
    let mut crossings: Option<(R, R)> = None;
    for pair in points.windows(2) {
        let [(f0, d0), (f1, d1)] = [0, 1].map(|i| (above(&pair[i]), pair[i].displacement));
        if f0.value() * f1.value() <= 0.0 && f0.value() != f1.value() {
            let at = d0 - (d1 - d0) * f0 / (f1 - f0);
            crossings = Some(crossings.map_or((at, at), |(low, high)| (low.min(at), high.max(at))));
        }
    }
    crossings.map_or(R::of(0.0), |(low, high)| (high - low) * 0.5)
}

/// Slope over the first increment back from the largest force, or else from the smallest.
fn secant<R: Scalar>(points: &[LoopPoint<R>], force: (R, R)) -> Option<R> {
    let (low, high) = (force.0.value(), force.1.value());
    // On the plateau of sliding the force differs by what the solver leaves.
    let nearly = 1e-6 * (high - low);
    let back_from = |turn: Option<usize>| {
        let pair = points.get(turn?..turn? + 2)?;
        let slope = (pair[0].force - pair[1].force) / (pair[0].displacement - pair[1].displacement);
        (slope.value().is_finite() && slope.value() > 0.0).then_some(slope)
    };
    let highest = points.iter().rposition(|point| point.force.value() >= high - nearly);
    let lowest = points.iter().rposition(|point| point.force.value() <= low + nearly);
    back_from(highest).or_else(|| back_from(lowest))
}

/// Forces are those of a plateau of sliding up to this, relative to it: where slip turns into the direction of the motion little by little the
/// plateau is not quite level.
const LEVEL: f64 = 1e-2;

/// The way from one plateau of sliding to the other, between reversal and the place from which on all of the contact slides. Increments
/// need not resolve it: where it ends follows from the way slid since, and its area from the energy dissipated on it, as the elastic
/// energy is the same on both plateaus. Between known points it is a power of what is left of it, `left = (1 - way)^exponent`:
/// of identical bodies without coupling exactly so for a sphere (Mindlin & Deresiewicz 1953, exponent 3/2), and nearly so for others.
struct Flank<R> {
    /// Force of the plateau, its magnitude.
    plateau: R,
    exponent: R,
    /// Displacement, and fraction of the change of the force that is left, at the known points from reversal to sliding.
    points: Vec<(R, R)>,
}

impl<R: Scalar> Flank<R> {
    /// The first whole flank that leaves the plateau on a `side` of the force (1 or -1), if there is one.
    fn of(points: &[LoopPoint<R>], side: f64) -> Option<Self> {
        let forces = || points.iter().map(|point| point.force * side);
        let highest = forces().fold(R::of(f64::NEG_INFINITY), R::max);
        let lowest = forces().fold(R::of(f64::INFINITY), R::min);
        let plateau = (highest - lowest) * 0.5;
        let near = LEVEL * plateau.value();
        let (top, bottom) = (highest.value(), lowest.value());
        if plateau.value().is_nan() || plateau.value() <= 0.0 || (top + bottom).abs() > near {
            return None;
        }
        let force = |k: usize| side * points[k].force.value();
        let displacement = |k: usize| points[k].displacement.value();
        let falls = |k: usize| side * (displacement(k) - displacement(k - 1)) < 0.0;
        let turns = |k: &usize| force(k - 1) >= top - near && falls(*k) && (*k == 1 || !falls(k - 1));
        let reversal = (1..points.len()).find(turns)? - 1;
        let end = (reversal + 1..points.len()).find(|&k| points[k].slid.value() > 0.0 || !falls(k))?;
        let (from, to) = (&points[reversal], &points[end]);
        if !falls(end) || force(end) > bottom + near {
            return None;
        }
        let way = (from.displacement - to.displacement) * side;
        let length = way - to.slid;
        if length.value().is_nan() || length.value() <= 0.0 {
            return None;
        }
        let dissipated = to.dissipated - from.dissipated - plateau * to.slid;
        // Area between the flank and its end, as a fraction of that of its rectangle: a half of a line, more where it bends.
        let area = dissipated * 0.5 / (length * plateau) + 0.5;
        let area = area.max(R::of(0.5)).min(R::of(0.8));
        let left = |point: &LoopPoint<R>| {
            let left = (point.force * side - lowest) / (plateau * 2.0);
            left.max(R::of(0.0)).min(R::of(1.0))
        };
        let mut known: Vec<(R, R)> =
            points[reversal..end].iter().map(|point| (point.displacement, left(point))).collect();
        known.push((from.displacement - length * side, R::of(0.0)));
        known[0].1 = R::of(1.0);
        Some(Self { plateau, exponent: area / (R::of(1.0) - area), points: known })
    }

    /// What is left of the way, from what is left of the change of the force.
    fn way_left(&self, force_left: R) -> R {
        let (left, power) = (force_left.value(), R::of(1.0) / self.exponent);
        if left <= 0.0 {
            return R::of(0.0);
        }
        let way = left.powf(power.value());
        // A number to the power of another: the second part is 0, with the slope by the power.
        force_left.mapped(way, power.value() * way / left) + power.mapped(0.0, way * left.ln())
    }

    /// Displacement at the middle force.
    fn middle(&self) -> R {
        let past = self.points.iter().position(|(_, left)| left.value() <= 0.5);
        let at = past.unwrap_or(self.points.len() - 1).max(1);
        let [(d0, w0), (d1, w1)] = [at - 1, at].map(|k| (self.points[k].0, self.way_left(self.points[k].1)));
        d0 + (d1 - d0) * (w0 - self.way_left(R::of(0.5))) / (w0 - w1)
    }

    /// Slope directly after reversal.
    fn slope(&self) -> R {
        let [(d0, _), (d1, left)] = [self.points[0], self.points[1]];
        self.plateau * 2.0 * self.exponent * (R::of(1.0) - self.way_left(left)) / (d1 - d0).size()
    }
}

#[cfg(test)]
mod tests;
