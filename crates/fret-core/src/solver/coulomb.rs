//! The judge of the tangential side: how well shear satisfies Coulomb's law. Finds shift and twist on the way.

use super::contact_set::ContactSet;
use super::rigid::RigidModes;
use crate::model::TangentialField;
use crate::model::each_cell::{CellRule, Reals, each_cell};

/// What the tangential equations of one increment ask for; fields are packed over the cells in contact.
#[derive(Debug, Clone, Copy)]
pub struct TangentialTask<'a> {
    /// Cells of the box along x and y.
    pub shape: [usize; 2],
    /// Cells in contact; the fields below are packed over them.
    pub contact: &'a ContactSet,
    /// Friction bound mu p [pressure].
    pub bound: &'a [f64],
    /// Tangential displacement before the increment [length].
    pub before: &'a TangentialField,
    /// Rigid motions.
    pub modes: &'a RigidModes,
    /// Increments of the motions that are prescribed [length]; 0 for the others.
    pub motion: [f64; 3],
    /// Sums over the cells of shear times mode, for the motions that follow from a resultant [pressure].
    pub resultant: [f64; 3],
    /// Influence of a cell's own shear [length/pressure].
    pub own: f64,
}

/// Verdict on the tangential side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TangentialVerdict {
    /// Increments of shift (x, y) and of twist x length [length].
    pub motion: [f64; 3],
    /// `|q - Proj(q - s / K)| / |mu p|`, Euclidean.
    pub residual: f64,
}

/// Judges shears of one contact; keeps its memory.
#[derive(Debug, Default)]
pub struct CoulombJudge {
    /// Minus the slip increment of the last shear judged, packed [length].
    pub s: TangentialField,
    /// Vectors `q - s / K` before the motions that follow from resultants.
    vectors: TangentialField,
}

impl CoulombJudge {
    /// Judges shear `q` with displacement `u`; `guess` starts the search for the motions.
    pub fn judge(
        &mut self,
        task: &TangentialTask<'_>,
        q: &TangentialField,
        u: &TangentialField,
        guess: [f64; 3],
    ) -> TangentialVerdict {
        let modes = task.modes;
        let stiffness = 1.0 / task.own;
        let Self { s, vectors } = self;
        for part in [&mut s.x, &mut s.y, &mut vectors.x, &mut vectors.y] {
            part.resize(task.bound.len(), 0.0);
        }
        let read = [
            &u.x[..],
            &u.y,
            &task.before.x,
            &task.before.y,
            &q.x,
            &q.y,
            task.bound,
            &modes.rotation.x,
            &modes.rotation.y,
        ];
        let write = [&mut s.x[..], &mut s.y, &mut vectors.x, &mut vectors.y];
        let pull = Pull { motion: task.motion, stiffness };
        let [vector_squares, bounds, bound_squares] = each_cell(&pull, read, write);
        let mut found = [0.0; 3];
        if modes.any_by_force() && bounds > 0.0 {
            let count = task.bound.len() as f64;
            let scale = Scale { total: bounds, spread: (vector_squares / count).sqrt() + bounds / count };
            found = self.motion_by_force(task, scale, guess.map(|motion| stiffness * motion));
            found = found.map(|motion| motion / stiffness);
        }
        let Self { s, .. } = self;
        let read = [&q.x[..], &q.y, task.bound, &modes.rotation.x, &modes.rotation.y];
        let [off] = each_cell(&Off { motion: found, stiffness }, read, [&mut s.x, &mut s.y]);
        let mut motion = task.motion;
        for mode in 0..3 {
            if modes.by_force[mode] {
                motion[mode] = found[mode];
            }
        }
        let residual = if bound_squares > 0.0 { (off / bound_squares).sqrt() } else { 0.0 };
        TangentialVerdict { motion, residual }
    }

    /// Root of `sum Proj(vector + motion) . mode = resultant`: Newton on a convex potential, with Armijo's rule.
    /// Motions are in units of pressure.
    fn motion_by_force(&self, task: &TangentialTask<'_>, scale: Scale, guess: [f64; 3]) -> [f64; 3] {
        let modes = task.modes;
        let mut motion = modes.only_by_force(guess);
        let mut here = self.potential(task, motion);
        if size(&here.defect) > 0.5 * scale.total {
            // A guess far off: nothing moved may be nearer.
            let at_rest = self.potential(task, [0.0; 3]);
            if at_rest.value < here.value {
                motion = [0.0; 3];
                here = at_rest;
            }
        }
        for _ in 0..60 {
            let defect = size(&here.defect);
            if defect <= 4e-16 * scale.total {
                break;
            }
            let mut change = modes.solve(here.curvature, here.defect.map(|d| -d));
            let length = size(&change);
            if length > 4.0 * scale.spread {
                change = change.map(|c| c * 4.0 * scale.spread / length);
            }
            let slope: f64 = change.iter().zip(&here.defect).map(|(c, d)| c * d).sum();
            if slope >= 0.0 {
                break;
            }
            let slack = 1e-15 * (here.value.abs() + scale.total * scale.spread);
            let mut share = 1.0;
            let mut accepted = false;
            for _ in 0..30 {
                let trial = [0, 1, 2].map(|mode| motion[mode] + share * change[mode]);
                let there = self.potential(task, trial);
                if there.value <= here.value + 1e-4 * share * slope
                    || (there.value <= here.value + slack && size(&there.defect) < defect)
                {
                    motion = trial;
                    here = there;
                    accepted = true;
                    break;
                }
                share *= 0.5;
            }
            if !accepted || (size(&here.defect) > 0.5 * defect && size(&here.defect) < 1e-14 * scale.total) {
                break;
            }
        }
        motion
    }

    fn potential(&self, task: &TangentialTask<'_>, motion: [f64; 3]) -> Potential {
        let modes = task.modes;
        let mut potential = if modes.rotates {
            let read =
                [&self.vectors.x[..], &self.vectors.y, task.bound, &modes.rotation.x, &modes.rotation.y];
            let [value, x, y, r, xx, yy, rr, xy, xr, yr] = each_cell(&Turning(motion), read, []);
            Potential { value, defect: [x, y, r], curvature: [xx, yy, rr, xy, xr, yr] }
        } else {
            let read = [&self.vectors.x[..], &self.vectors.y, task.bound];
            let [value, x, y, xx, yy, xy] = each_cell(&Straight([motion[0], motion[1]]), read, []);
            Potential { value, defect: [x, y, 0.0], curvature: [xx, yy, 0.0, xy, 0.0, 0.0] }
        };
        for mode in 0..3 {
            if modes.by_force[mode] {
                potential.value -= motion[mode] * task.resultant[mode];
                potential.defect[mode] -= task.resultant[mode];
            } else {
                potential.defect[mode] = 0.0;
            }
        }
        potential
    }
}

/// Sizes that the search for motions measures itself by [pressure].
#[derive(Debug, Clone, Copy)]
struct Scale {
    /// Sum of the friction bounds.
    total: f64,
    /// A common size of vectors and bounds.
    spread: f64,
}

/// Gradient, curvature and value of the convex potential whose root is the rigid motion.
struct Potential {
    value: f64,
    defect: [f64; 3],
    curvature: [f64; 6],
}

fn size(vector: &[f64; 3]) -> f64 {
    vector.iter().map(|v| v * v).sum::<f64>().sqrt()
}

/// `s` without the motions that follow from resultants, and the vectors `q - s / K`.
struct Pull {
    motion: [f64; 3],
    stiffness: f64,
}

impl CellRule<9, 4, 3> for Pull {
    const OPTIONAL: usize = 2;

    #[inline(always)]
    fn at<R: Reals>(
        &self,
        [ux, uy, before_x, before_y, qx, qy, bound, around_x, around_y]: [R; 9],
        [sx, sy, vx, vy]: &mut [R; 4],
    ) -> [R; 3] {
        let [shift_x, shift_y, twist] = self.motion;
        *sx = ux - before_x - (around_x * twist + shift_x);
        *sy = uy - before_y - (around_y * twist + shift_y);
        *vx = qx - *sx * self.stiffness;
        *vy = qy - *sy * self.stiffness;
        [*vx * *vx + *vy * *vy, bound, bound * bound]
    }
}

/// `s` with all motions, and the squared distance of `q` from the projection of `q - s / K`.
struct Off {
    motion: [f64; 3],
    stiffness: f64,
}

impl CellRule<5, 2, 1> for Off {
    const OPTIONAL: usize = 2;

    #[inline(always)]
    fn at<R: Reals>(&self, [qx, qy, bound, around_x, around_y]: [R; 5], [sx, sy]: &mut [R; 2]) -> [R; 1] {
        let [shift_x, shift_y, twist] = self.motion;
        *sx = *sx - (around_x * twist + shift_x);
        *sy = *sy - (around_y * twist + shift_y);
        let image = project([qx - *sx * self.stiffness, qy - *sy * self.stiffness], bound);
        let off = [qx - image[0], qy - image[1]];
        [off[0] * off[0] + off[1] * off[1]]
    }
}

/// Sums of the potential without rotation.
struct Straight([f64; 2]);

impl CellRule<3, 0, 6> for Straight {
    #[inline(always)]
    fn at<R: Reals>(&self, [x, y, bound]: [R; 3], _: &mut [R; 0]) -> [R; 6] {
        let on = OnDisc::new([x + self.0[0], y + self.0[1]], bound);
        let [along_x, along_y] = on.along;
        [
            on.value,
            on.image[0],
            on.image[1],
            on.share - on.share * along_x * along_x,
            on.share - on.share * along_y * along_y,
            on.share * along_x * along_y * -1.0,
        ]
    }
}

/// Sums of the potential with all three motions.
struct Turning([f64; 3]);

impl CellRule<5, 0, 10> for Turning {
    #[inline(always)]
    fn at<R: Reals>(&self, [x, y, bound, around_x, around_y]: [R; 5], _: &mut [R; 0]) -> [R; 10] {
        let [shift_x, shift_y, twist] = self.0;
        let on = OnDisc::new([x + (around_x * twist + shift_x), y + (around_y * twist + shift_y)], bound);
        let [along_x, along_y] = on.along;
        let turned = along_x * around_x + along_y * around_y;
        [
            on.value,
            on.image[0],
            on.image[1],
            on.image[0] * around_x + on.image[1] * around_y,
            on.share - on.share * along_x * along_x,
            on.share - on.share * along_y * along_y,
            on.share * (around_x * around_x + around_y * around_y - turned * turned),
            on.share * along_x * along_y * -1.0,
            on.share * (around_x - along_x * turned),
            on.share * (around_y - along_y * turned),
        ]
    }
}

/// A vector brought to its friction disc.
struct OnDisc<R> {
    /// Half the squared length inside the disc, going on linearly outside.
    value: R,
    /// The nearest point of the disc.
    image: [R; 2],
    /// Its share of the vector.
    share: R,
    /// Direction of a vector outside the disc; zero inside.
    along: [R; 2],
}

impl<R: Reals> OnDisc<R> {
    #[inline(always)]
    fn new([x, y]: [R; 2], bound: R) -> Self {
        let square = x * x + y * y;
        let length = square.sqrt();
        let inverse = x.all(1.0) / length;
        let share = length.if_at_most(bound, x.all(1.0), bound * inverse);
        let outside = length.if_at_most(bound, x.all(0.0), inverse);
        Self {
            value: length.if_at_most(bound, square * 0.5, bound * (length - bound * 0.5)),
            image: [share * x, share * y],
            share,
            along: [x * outside, y * outside],
        }
    }
}

/// Nearest point of the friction disc.
#[inline(always)]
pub fn project<R: Reals>([x, y]: [R; 2], bound: R) -> [R; 2] {
    let length = (x * x + y * y).sqrt();
    let share = length.if_at_most(bound, x.all(1.0), bound / length);
    [x * share, y * share]
}
