//! Shear alone, at given pressure: stick and slip zones frozen from feasible shear, conjugate gradients on the frozen
//! problem with the resultants held exactly, back to the friction discs; again until Coulomb's law holds.

use pulp::Simd;

use super::contact_set::ContactSet;
use super::coulomb::{CoulombJudge, TangentialTask, TangentialVerdict};
use super::preconditioner::Preconditioner;
use super::retraction::Retraction;
use super::settings::{SolveError, SolverSettings, Watch};
use super::single::unit_of;
use super::zones::{RigidProjector, Zones};
use crate::compliance::SurfaceCompliance;
use crate::model::TangentialField;
use crate::model::each_cell::{CellRule, Reals, each_cell};
use crate::model::field::{norm, scale_and_add};

/// How much of the cut a frozen problem is solved below; raised while outer steps do not pay.
pub const THETA: f64 = 1.0;
/// Share of its start to which a frozen problem is solved at the most when something is cut.
const ETA: f64 = 0.005;

/// Share of its start to which the residual of a frozen problem falls when its operator has six digits.
pub const SIX_DIGITS: f64 = 1e-5;

/// What the shear solver reached.
#[derive(Debug)]
pub struct ShearSolution {
    /// Increments of the rigid motions.
    pub verdict: TangentialVerdict,
    /// Minus the slip increment, packed.
    pub s: TangentialField,
    /// Outer iterations made.
    pub iterations: usize,
}

/// Solves the tangential equations from a feasible `shear`, packed over its contact, with its `displacement` of the whole
/// box; both end at the solution.
pub fn solve_shear(
    task: &TangentialTask<'_>,
    shear: &mut TangentialField,
    displacement: &mut TangentialField,
    compliance: &mut dyn SurfaceCompliance,
    preconditioner: &mut Preconditioner,
    settings: &SolverSettings,
    watch: Watch<'_>,
) -> Result<ShearSolution, SolveError> {
    let mut judge = CoulombJudge::default();
    let mut retraction = Retraction::default();
    let contact = task.contact;
    let mut here = contact.packed_tangential(displacement);
    let mut inner = ConjugateGradients::new(contact, displacement.x.len());
    let mut motion = [0.0; 3];
    let mut patience = Patience::default();
    for iteration in 0..settings.most_outer_iterations {
        let verdict = judge.judge(task, shear, &here, motion);
        motion = verdict.motion;
        if watch(iteration, verdict.residual).is_break() {
            return Err(SolveError::Stopped);
        }
        if verdict.residual < settings.tolerance {
            return Ok(ShearSolution { verdict, s: judge.s, iterations: iteration });
        }
        let theta = patience.hears(verdict.residual);
        let zones = Zones::classify(shear, &judge.s, task.bound, |_| false);
        inner.exact |= patience.is_at_an_end();
        let frozen = Frozen { task, zones: &zones, settings, theta };
        let cut = inner.solve(&frozen, &judge.s, shear, displacement, compliance, preconditioner);
        retraction.shear(shear, &zones, task);
        if cut || !inner.exact {
            contact.place_tangential(shear, &mut inner.spread);
            compliance.tangential(&inner.spread, displacement);
        }
        contact.gather_tangential(displacement, &mut here);
    }
    Err(SolveError::NotConverged { reached: patience.best, iterations: settings.most_outer_iterations })
}

/// How far frozen problems are solved: further while outer steps do not pay.
#[derive(Debug)]
pub struct Patience {
    theta: f64,
    last: f64,
    /// Smallest residual so far.
    pub best: f64,
}

impl Default for Patience {
    fn default() -> Self {
        Self { theta: THETA, last: f64::INFINITY, best: f64::INFINITY }
    }
}

impl Patience {
    /// Whether several steps in a row did not pay: then nothing is left to chance.
    pub fn is_at_an_end(&self) -> bool {
        self.theta > 16.0 * THETA
    }

    /// Takes note of a residual; returns the share of the cut below which the next frozen problem is solved.
    pub fn hears(&mut self, residual: f64) -> f64 {
        self.theta = if residual > 0.9 * self.last {
            (4.0 * self.theta).min(300.0)
        } else {
            (self.theta / 2.0).max(THETA)
        };
        self.last = residual;
        self.best = self.best.min(residual);
        self.theta
    }
}

/// The tangential problem on frozen zones.
struct Frozen<'a> {
    task: &'a TangentialTask<'a>,
    zones: &'a Zones,
    settings: &'a SolverSettings,
    theta: f64,
}

/// Conjugate gradients on frozen zones, and their memory; fields are packed but for `spread` and `answer`.
struct ConjugateGradients<'a> {
    contact: &'a ContactSet,
    residual: TangentialField,
    z: TangentialField,
    z_before: TangentialField,
    step: TangentialField,
    along: TangentialField,
    image: TangentialField,
    change: TangentialField,
    /// Whether `along` and `image` hold a direction.
    remembers: bool,
    /// A field of the whole box, zero outside the contact.
    spread: TangentialField,
    /// Displacement of the whole box.
    answer: TangentialField,
    /// Whether the answer has all digits.
    exact: bool,
    /// The same fields in single precision, shear zero outside the contact.
    single: [[Vec<f32>; 2]; 2],
}

impl<'a> ConjugateGradients<'a> {
    fn new(contact: &'a ContactSet, cells: usize) -> Self {
        let packed = || TangentialField::zeros(contact.len());
        Self {
            contact,
            residual: packed(),
            z: packed(),
            z_before: packed(),
            step: packed(),
            along: packed(),
            image: packed(),
            change: packed(),
            remembers: false,
            spread: TangentialField::zeros(cells),
            answer: TangentialField::zeros(cells),
            exact: false,
            single: std::array::from_fn(|_| [vec![0.0; cells], vec![0.0; cells]]),
        }
    }

    /// `image` becomes the displacement of `along`: with six digits where the operator offers them and nobody wants more.
    fn answer(&mut self, compliance: &mut dyn SurfaceCompliance) {
        let [spread, answer] = &mut self.single;
        if !self.exact {
            let unit = unit_of(self.along.norm());
            for (part, field) in self.along.parts().into_iter().zip(spread.iter_mut()) {
                self.contact.place_rounded(part, 1.0 / unit, field);
            }
            if let Some(out) = compliance.tangential_single(spread, answer) {
                for (field, part) in answer.iter().zip(self.image.parts_mut()) {
                    self.contact.gather_widened(field, unit * out, part);
                }
                return;
            }
        }
        self.exact = true;
        self.contact.place_tangential(&self.along, &mut self.spread);
        compliance.tangential(&self.spread, &mut self.answer);
        self.contact.gather_tangential(&self.answer, &mut self.image);
    }

    /// Solves until going further would be lost in the cut. Adds the step to `shear` and its image to `displacement`;
    /// tells whether the step leaves the feasible set, so that the image must be computed anew.
    fn solve(
        &mut self,
        frozen: &Frozen<'_>,
        s: &TangentialField,
        shear: &mut TangentialField,
        displacement: &mut TangentialField,
        compliance: &mut dyn SurfaceCompliance,
        preconditioner: &mut Preconditioner,
    ) -> bool {
        let Frozen { task, zones, settings, theta } = *frozen;
        let rigid = RigidProjector::new(task.modes, zones);
        preconditioner.freeze(zones);
        self.residual.clear();
        self.residual.add_scaled(-1.0, s);
        rigid.keep_free(self.residual.parts_mut());
        self.step.clear();
        let start = self.residual.norm();
        let floor = 0.1 * settings.tolerance * norm(task.bound) * task.own;
        let mut product_before: Option<f64> = None;
        let mut cut = 0.0;
        for _ in 0..settings.most_inner_iterations {
            preconditioner.shear(self.residual.parts(), self.contact, self.z.parts_mut());
            rigid.keep_free(self.z.parts_mut());
            let product = self.z.dot(&self.residual);
            let beta = match product_before {
                Some(before) => ((product - self.z_before.dot(&self.residual)) / before).max(0.0),
                None if self.remembers => self.conjugate_to_last(zones, &rigid),
                None => 0.0,
            };
            scale_and_add(&mut self.along.x, beta, &self.z.x);
            scale_and_add(&mut self.along.y, beta, &self.z.y);
            let mut downhill = self.along.dot(&self.residual);
            if downhill <= 0.1 * product {
                self.along.copy_from(&self.z);
                downhill = product;
            }
            if !(downhill > 0.0) {
                self.remembers = false;
                break;
            }
            self.answer(compliance);
            self.change.copy_from(&self.image);
            let curvature = add_slip_stiffness(&mut self.change, &self.along, &zones.stiffness);
            if !(curvature > 0.0) {
                self.remembers = false;
                break;
            }
            self.remembers = true;
            let tau = downhill / curvature;
            self.step.add_scaled(tau, &self.along);
            if self.exact {
                displacement.add_scaled(tau, &self.answer);
            }
            rigid.keep_free(self.change.parts_mut());
            self.residual.add_scaled(-tau, &self.change);
            let z_size = self.z.norm();
            std::mem::swap(&mut self.z, &mut self.z_before);
            product_before = Some(product);
            let read = [&shear.x[..], &shear.y, &self.step.x, &self.step.y, task.bound, &zones.slip];
            let [square] = each_cell(&Cut, read, []);
            cut = square.sqrt();
            let residual = self.residual.norm();
            let left = z_size * tau.abs() * (residual / start).clamp(1e-3, 1.0);
            if residual < floor
                || !self.exact && residual < SIX_DIGITS * start
                || (cut > 0.0 && (cut > theta * left || residual < ETA * start))
            {
                break;
            }
        }
        shear.add_scaled(1.0, &self.step);
        cut > 0.0
    }

    /// Share of the last direction of the problem before, made tangential, that the first one takes up.
    fn conjugate_to_last(&mut self, zones: &Zones, rigid: &RigidProjector<'_>) -> f64 {
        rigid.keep_free(self.along.parts_mut());
        let mut stiff = self.image.clone();
        let curvature = add_slip_stiffness(&mut stiff, &self.along, &zones.stiffness);
        if curvature > 0.0 { -self.z.dot(&stiff) / curvature } else { 0.0 }
    }
}

/// Adds the slip stiffness times a (free) field to its image; returns their product with the field.
pub fn add_slip_stiffness(image: &mut TangentialField, field: &TangentialField, stiffness: &[f64]) -> f64 {
    let read = [&field.x[..], &field.y, stiffness];
    let [product] = each_cell(&AddStiffness, read, [&mut image.x, &mut image.y]);
    product
}

struct AddStiffness;

impl CellRule<3, 2, 1> for AddStiffness {
    #[inline(always)]
    fn at<S: Simd>(
        &self,
        [x, y, stiffness]: [Reals<S>; 3],
        [image_x, image_y]: &mut [Reals<S>; 2],
    ) -> [Reals<S>; 1] {
        *image_x = *image_x + stiffness * x;
        *image_y = *image_y + stiffness * y;
        [x * *image_x + y * *image_y]
    }
}

/// Squared distance of `shear + step` from the discs and circles it has to go back to.
struct Cut;

impl CellRule<6, 0, 1> for Cut {
    #[inline(always)]
    fn at<S: Simd>(
        &self,
        [x, y, step_x, step_y, bound, slip]: [Reals<S>; 6],
        _: &mut [Reals<S>; 0],
    ) -> [Reals<S>; 1] {
        let (zero, one) = (x.all(0.0), x.all(1.0));
        let moved = [x + step_x, y + step_y];
        let off = (moved[0] * moved[0] + moved[1] * moved[1]).sqrt() - bound;
        let moves = (step_x * step_x + step_y * step_y).if_at_most(zero, zero, slip);
        let counts = off.if_at_most(zero, moves, one);
        let square = off * off;
        let rounding = bound * bound * 1e-30;
        [square.if_at_most(rounding, zero, counts * square)]
    }
}
