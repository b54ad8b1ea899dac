//! What is read from the points that a cycle runs through: the axis along which the force varies, and the loops along it, about z and at the
//! actuator. Of numbers of any kind: with their slopes these are those of the cycle.

use serde::{Deserialize, Serialize};

use super::loop_reading::{CONSTANT, LoopPoint, LoopReading};
use crate::fields::Scalar;
use crate::history::Drive;

/// Force and moment, shift and twist at the end of an increment.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Point<R = f64> {
    /// On the lower body, along x and y [force].
    pub force: [R; 2],
    /// About z [force x length].
    pub moment: R,
    /// Of the upper body [length].
    pub shift: [R; 2],
    /// Of the upper body.
    pub twist: R,
    /// Way by which all of the contact has slid at the end of the increment [length].
    pub slid: R,
    /// Energy dissipated so far less the work of the bulk stress [force x length].
    pub dissipated: R,
}

/// The numbers of a cycle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CycleReading<R> {
    /// What drives it.
    pub drive: Drive,
    /// Direction of the tangential force's main axis, from x; of the shift's where the force is held.
    pub direction: R,
    /// Its loop, along that or about z.
    pub read: LoopReading<R>,
    /// That at the actuator, where the machine gives.
    pub at_actuator: Option<LoopReading<R>>,
    dissipated: R,
}

impl<R: Scalar> CycleReading<R> {
    /// Reads the points of a cycle that has `dissipated` an energy, the point that it starts from first; `rig`: compliances of the machine along
    /// x and y [length/force], where it gives.
    pub fn of(points: &[Point<R>], dissipated: R, rig: Option<[R; 2]>) -> Self {
        let (force, shift) =
            (Spread::of(points, |point| point.force), Spread::of(points, |point| point.shift));
        // A force that is held varies by rounding alone, along any axis.
        let (held, moved) = (force.is_none(), !shift.is_none());
        let direction =
            if held && moved && force.largest > 0.0 { shift.main_axis() } else { force.main_axis() };
        let (cos, sin) = (direction.cosine(), direction.sine());
        let along = |[x, y]: [R; 2]| x * cos + y * sin;
        let slid = slid_along(points, [cos.value(), sin.value()]);
        let tangential = |displacement: &dyn Fn(&Point<R>) -> [R; 2]| {
            let point = |(p, slid): (&Point<R>, &R)| LoopPoint {
                force: along(if held { points[0].force } else { p.force }),
                displacement: along(displacement(p)),
                slid: *slid,
                dissipated: p.dissipated,
            };
            LoopReading::of(&points.iter().zip(&slid).map(point).collect::<Vec<_>>())
        };
        // Twisted, the last cell slips after a twist beyond all bounds: such a loop has no plateau.
        let torsional = points.iter().map(|p| LoopPoint {
            force: p.moment,
            displacement: p.twist,
            slid: R::of(0.0),
            dissipated: R::of(0.0),
        });
        let sideways = tangential(&|point| point.shift);
        let about = LoopReading::of(&torsional.collect::<Vec<_>>());
        let twists = about.work_scale().value() > sideways.work_scale().value();
        let (drive, read) = if twists { (Drive::Torsional, about) } else { (Drive::Tangential, sideways) };
        let at_actuator = rig.filter(|_| drive == Drive::Tangential).map(|[x, y]| {
            let far = tangential(&|point| {
                [point.shift[0] + x * point.force[0], point.shift[1] + y * point.force[1]]
            });
            if !read.slides {
                return far;
            }
            // At the middle force the machine gives the same on both sides, and after reversal it is in series with the contact.
            let gives = x * cos * cos + y * sin * sin;
            let one = R::of(1.0);
            let stiffness = read.stiffness.map(|slope| one / (one / slope + gives));
            LoopReading { opening: read.opening, stiffness, ..far }
        });
        Self { drive, direction, read, at_actuator, dissipated }
    }

    /// `W_d / (4 Q* d*)` of one of its loops; `None` where that does not move.
    pub fn energy_ratio(&self, of: &LoopReading<R>) -> Option<R> {
        let scale = of.work_scale();
        (scale.value() > 0.0).then(|| self.dissipated / (scale * 4.0))
    }
}

impl<R: Scalar> LoopReading<R> {
    /// `d_0 / d*`; `None` where the loop does not move.
    pub fn sliding_ratio(&self) -> Option<R> {
        (self.work_scale().value() > 0.0).then(|| self.opening / self.displacement_amplitude)
    }
}

/// Cosine of the angle to its axis within which an increment of motion is one along it.
const STRAIGHT: f64 = 0.9999;

/// Way by which all of the contact has slid at the end of each increment, where it moved along an axis; 0 where it did not.
fn slid_along<R: Scalar>(points: &[Point<R>], [cos, sin]: [f64; 2]) -> Vec<R> {
    let none = R::of(0.0);
    let of = |pair: &[Point<R>]| {
        let [x, y] = [0, 1].map(|axis| pair[1].shift[axis].value() - pair[0].shift[axis].value());
        let along = (x * cos + y * sin).abs();
        if along >= STRAIGHT * x.hypot(y) { pair[1].slid } else { none }
    };
    std::iter::once(none).chain(points.windows(2).map(of)).collect()
}

/// How far vectors lie from their mean.
struct Spread<R> {
    xx: R,
    yy: R,
    xy: R,
    /// Of their number.
    count: f64,
    /// Length of the longest.
    largest: f64,
}

impl<R: Scalar> Spread<R> {
    fn of(points: &[Point<R>], vector: fn(&Point<R>) -> [R; 2]) -> Self {
        let count = points.len() as f64;
        let mean =
            |axis: usize| points.iter().fold(R::of(-0.0), |sum, point| sum + vector(point)[axis]) / count;
        let (x, y) = (mean(0), mean(1));
        let none = R::of(0.0);
        let mut spread = Self { xx: none, yy: none, xy: none, count, largest: 0.0 };
        for point in points {
            let [vx, vy] = vector(point);
            let (dx, dy) = (vx - x, vy - y);
            spread.xx = spread.xx + dx * dx;
            spread.yy = spread.yy + dy * dy;
            spread.xy = spread.xy + dx * dy;
            spread.largest = spread.largest.max(vx.value().hypot(vy.value()));
        }
        spread
    }

    /// Whether it is what rounding leaves.
    fn is_none(&self) -> bool {
        (self.xx + self.yy).value() <= (CONSTANT * self.largest).powi(2) * self.count
    }

    /// Direction along which it is widest [rad], within a quarter turn of x.
    fn main_axis(&self) -> R {
        (self.xy * 2.0).angle_to(self.xx - self.yy) * 0.5
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Under a force that is held a contact creeps: the loop lies along that way, has no force and nothing that is made of one; what rounding leaves of
    /// the force, here its last digit, says nothing.
    #[test]
    fn a_force_that_is_held_has_no_loop() {
        let last_digit = f64::EPSILON;
        let points: Vec<Point> = (0..=8)
            .map(|k| {
                let noise = 1.0 + last_digit * f64::from(k % 3 - 1);
                let shift = [0.4 * f64::from(k), 0.3 * f64::from(k)];
                let force = [8e-4 * noise, 3e-4 / noise];
                Point { force, moment: 0.0, shift, twist: 0.0, slid: 0.0, dissipated: 0.0 }
            })
            .collect();
        let reading = CycleReading::of(&points, 1.0, None);
        assert!((reading.direction - 0.75_f64.atan()).abs() < 1e-12, "{}", reading.direction);
        assert!((reading.read.displacement_amplitude - 2.0).abs() < 1e-12);
        assert_eq!((reading.read.force_amplitude, reading.read.opening), (0.0, 0.0));
        assert_eq!((reading.read.stiffness, reading.energy_ratio(&reading.read)), (None, None));
    }
}
