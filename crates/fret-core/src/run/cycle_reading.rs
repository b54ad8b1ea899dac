//! What is read from the points that a cycle runs through: the axis along which the force varies, and the loops along it, about z and at the
//! actuator. Of numbers of any kind: with their slopes these are those of the cycle.

use serde::{Deserialize, Serialize};

use super::loop_reading::{LoopPoint, LoopReading};
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
    /// Direction of the tangential force's main axis, from x.
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
        let direction = main_axis(points);
        let (cos, sin) = (direction.cosine(), direction.sine());
        let along = |[x, y]: [R; 2]| x * cos + y * sin;
        let slid = slid_along(points, [cos.value(), sin.value()]);
        let tangential = |displacement: &dyn Fn(&Point<R>) -> [R; 2]| {
            let point = |(p, slid): (&Point<R>, &R)| LoopPoint {
                force: along(p.force),
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

/// Direction in which the force varies most [rad], within a quarter turn of x.
fn main_axis<R: Scalar>(points: &[Point<R>]) -> R {
    let n = points.len() as f64;
    let mean = |axis: usize| points.iter().fold(R::of(-0.0), |sum, point| sum + point.force[axis]) / n;
    let (x, y) = (mean(0), mean(1));
    let [mut xx, mut yy, mut xy] = [R::of(0.0); 3];
    for point in points {
        let (dx, dy) = (point.force[0] - x, point.force[1] - y);
        xx = xx + dx * dx;
        yy = yy + dy * dy;
        xy = xy + dx * dy;
    }
    (xy * 2.0).angle_to(xx - yy) * 0.5
}
