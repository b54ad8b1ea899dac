//! Shear alone, at given pressure: stick and slip zones frozen from feasible shear, conjugate gradients on the frozen
//! problem with the resultants held exactly, back to the friction discs; again until Coulomb's law holds.

use super::preconditioner::Preconditioner;
use super::residual::{TangentialTask, TangentialVerdict};
use super::retraction::retract_shear;
use super::settings::{SolveError, SolverSettings, Watch};
use super::zones::{Freedom, Zones};
use crate::compliance::SurfaceCompliance;
use crate::model::TangentialField;

/// How much of the cut a frozen problem is solved below; raised while outer steps do not pay.
const THETA: f64 = 0.3;
/// Share of its start to which a frozen problem is solved at the most when something is cut.
const ETA: f64 = 0.02;

/// What the shear solver reached.
#[derive(Debug)]
pub struct ShearSolution {
    /// Increments of the rigid motions.
    pub verdict: TangentialVerdict,
    /// Minus the slip increment.
    pub s: TangentialField,
    /// Outer iterations made.
    pub iterations: usize,
}

/// Solves the tangential equations from a feasible `shear` with its displacement; both end at the solution.
pub fn solve_shear(
    task: &TangentialTask<'_>,
    shear: &mut TangentialField,
    displacement: &mut TangentialField,
    compliance: &mut dyn SurfaceCompliance,
    preconditioner: &mut Preconditioner,
    settings: &SolverSettings,
    watch: Watch<'_>,
) -> Result<ShearSolution, SolveError> {
    let len = task.bound.len();
    let mut s = TangentialField::zeros(len);
    let mut motion = [0.0; 3];
    let mut theta = THETA;
    let mut last_residual = f64::INFINITY;
    let mut best = f64::INFINITY;
    let mut last: Option<Direction> = None;
    for iteration in 0..settings.most_outer_iterations {
        let verdict = task.judge(shear, displacement, motion, &mut s);
        motion = verdict.motion;
        best = best.min(verdict.residual);
        if watch(iteration, verdict.residual).is_break() {
            return Err(SolveError::Stopped);
        }
        if verdict.residual < settings.tolerance {
            return Ok(ShearSolution { verdict, s, iterations: iteration });
        }
        theta = if verdict.residual > 0.9 * last_residual {
            (4.0 * theta).min(300.0)
        } else {
            (theta / 2.0).max(THETA)
        };
        last_residual = verdict.residual;
        let zones = Zones::classify(task.contact.to_vec(), shear, &s, task.bound, |_| false);
        let frozen = Frozen { task, zones: &zones, settings, theta };
        let cut = frozen.solve(&s, shear, displacement, compliance, preconditioner, &mut last);
        retract_shear(shear, &zones, task);
        if cut {
            compliance.tangential(shear, displacement);
        }
    }
    Err(SolveError::NotConverged { reached: best, iterations: settings.most_outer_iterations })
}

/// A search direction with its elastic image.
struct Direction {
    along: TangentialField,
    image: TangentialField,
}

/// The tangential problem on frozen zones.
struct Frozen<'a, 'b> {
    task: &'a TangentialTask<'b>,
    zones: &'a Zones,
    settings: &'a SolverSettings,
    theta: f64,
}

impl Frozen<'_, '_> {
    /// Conjugate gradients until solving further would be lost in the cut. Adds the step to `shear` and its image to
    /// `displacement`; tells whether the step leaves the feasible set, so that the image must be computed anew.
    fn solve(
        &self,
        s: &TangentialField,
        shear: &mut TangentialField,
        displacement: &mut TangentialField,
        compliance: &mut dyn SurfaceCompliance,
        preconditioner: &mut Preconditioner,
        last: &mut Option<Direction>,
    ) -> bool {
        let len = self.task.bound.len();
        let rigid = RigidProjector::new(self.task, self.zones);
        preconditioner.freeze(self.zones);
        let mut rho = s.clone();
        rho.x.iter_mut().chain(rho.y.iter_mut()).for_each(|value| *value = -*value);
        self.zones.keep_free(&mut rho);
        rigid.remove(&mut rho);
        let start = rho.norm();
        let floor = 0.1 * self.settings.tolerance * self.bound_norm() * self.task.own;
        let mut z = TangentialField::zeros(len);
        let mut z_before: Option<(TangentialField, f64)> = None;
        let mut step = TangentialField::zeros(len);
        let mut cut = 0.0;
        for _ in 0..self.settings.most_inner_iterations {
            preconditioner.shear(&rho, self.zones, &mut z);
            rigid.remove(&mut z);
            let z_rho = z.dot(&rho);
            let mut along = z.clone();
            match (&z_before, last.as_mut()) {
                (Some((before, product)), Some(direction)) => {
                    let beta = ((z_rho - before.dot(&rho)) / product).max(0.0);
                    along.add_scaled(beta, &direction.along);
                }
                (None, Some(direction)) => {
                    // The last direction of the problem before, made tangential, is still nearly conjugate.
                    self.zones.keep_free(&mut direction.along);
                    rigid.remove(&mut direction.along);
                    let stiff = self.stiff_product(&direction.along, &direction.along);
                    let curvature = direction.along.dot(&direction.image) + stiff;
                    if curvature > 0.0 {
                        let beta =
                            -(z.dot(&direction.image) + self.stiff_product(&z, &direction.along)) / curvature;
                        along.add_scaled(beta, &direction.along);
                    }
                }
                _ => {}
            }
            let mut d_rho = along.dot(&rho);
            if d_rho <= 0.1 * z_rho {
                along.clone_from(&z);
                d_rho = z_rho;
            }
            if !(d_rho > 0.0) {
                break;
            }
            let mut image = TangentialField::zeros(len);
            compliance.tangential(&along, &mut image);
            let curvature = along.dot(&image) + self.stiff_product(&along, &along);
            if !(curvature > 0.0) {
                break;
            }
            let tau = d_rho / curvature;
            step.add_scaled(tau, &along);
            displacement.add_scaled(tau, &image);
            // rho -= tau (free part of the image + D along), rigid part off.
            let mut change = image.clone();
            self.zones.keep_free(&mut change);
            self.zones.add_stiffness(&mut change, &along);
            rigid.remove(&mut change);
            rho.add_scaled(-tau, &change);
            let z_norm = z.norm();
            z_before = Some((z.clone(), z_rho));
            *last = Some(Direction { along, image });
            cut = self.cut_of(shear, &step);
            let residual = rho.norm();
            let left = z_norm * tau.abs() * (residual / start).clamp(1e-3, 1.0);
            if residual < floor || (cut > 0.0 && (cut > self.theta * left || residual < ETA * start)) {
                break;
            }
        }
        shear.add_scaled(1.0, &step);
        cut > 0.0
    }

    fn bound_norm(&self) -> f64 {
        self.task.contact.iter().map(|&cell| self.task.bound[cell].powi(2)).sum::<f64>().sqrt()
    }

    fn stiff_product(&self, a: &TangentialField, b: &TangentialField) -> f64 {
        let mut product = 0.0;
        for &cell in &self.zones.contact {
            if self.zones.freedom[cell] == Freedom::Slip {
                product += self.zones.stiffness[cell] * (a.x[cell] * b.x[cell] + a.y[cell] * b.y[cell]);
            }
        }
        product
    }

    /// Distance of `shear + step` from the discs and circles it has to go back to.
    fn cut_of(&self, shear: &TangentialField, step: &TangentialField) -> f64 {
        let mut square = 0.0;
        for &cell in &self.zones.contact {
            let vector = [shear.x[cell] + step.x[cell], shear.y[cell] + step.y[cell]];
            let limit = self.task.bound[cell];
            let size = (vector[0] * vector[0] + vector[1] * vector[1]).sqrt();
            let moved = step.x[cell] != 0.0 || step.y[cell] != 0.0;
            if size > limit || (self.zones.freedom[cell] == Freedom::Slip && moved) {
                let off = size - limit;
                if off.abs() > 1e-15 * limit {
                    square += off * off;
                }
            }
        }
        square.sqrt()
    }
}

/// Takes off a field what rigid motions that follow from resultants can do on the frozen zones.
pub(super) struct RigidProjector<'a> {
    task: &'a TangentialTask<'a>,
    zones: &'a Zones,
    gram: [[f64; 3]; 3],
}

impl<'a> RigidProjector<'a> {
    pub fn new(task: &'a TangentialTask<'_>, zones: &'a Zones) -> Self {
        let mut gram = [[0.0; 3]; 3];
        let modes = if task.modes.by_force[2] { 3 } else { 2 };
        if task.modes.any_by_force() {
            for &cell in &zones.contact {
                for m in 0..modes {
                    let a = free_mode(task, zones, m, cell);
                    for n in 0..modes {
                        let b = free_mode(task, zones, n, cell);
                        gram[m][n] += a[0] * b[0] + a[1] * b[1];
                    }
                }
            }
        }
        Self { task, zones, gram }
    }

    pub fn remove(&self, field: &mut TangentialField) {
        if !self.task.modes.any_by_force() {
            return;
        }
        let mut products = [0.0; 3];
        for &cell in &self.zones.contact {
            let found = self.task.modes.products(field.at(cell), cell);
            for mode in 0..3 {
                products[mode] += found[mode];
            }
        }
        self.subtract(field, self.task.modes.solve(&self.gram, &products));
    }

    /// Takes off the rigid motion whose resultant is `resultant`.
    pub fn remove_resultant(&self, field: &mut TangentialField, resultant: [f64; 3]) {
        if self.task.modes.any_by_force() {
            self.subtract(field, self.task.modes.solve(&self.gram, &resultant));
        }
    }

    fn subtract(&self, field: &mut TangentialField, amounts: [f64; 3]) {
        for &cell in &self.zones.contact {
            let rigid = self.task.modes.displacement(&amounts, cell);
            let part = match self.zones.freedom[cell] {
                Freedom::Open | Freedom::Follow => [0.0, 0.0],
                Freedom::Stick => rigid,
                Freedom::Slip => self.zones.tangent_part(rigid, cell),
            };
            field.x[cell] -= part[0];
            field.y[cell] -= part[1];
        }
    }
}

fn free_mode(task: &TangentialTask<'_>, zones: &Zones, mode: usize, cell: usize) -> [f64; 2] {
    let vector = task.modes.mode(mode, cell);
    match zones.freedom[cell] {
        Freedom::Open | Freedom::Follow => [0.0, 0.0],
        Freedom::Stick => vector,
        Freedom::Slip => zones.tangent_part(vector, cell),
    }
}
