//! Pressure and shear together: one Newton-type loop on feasible tractions. Contact, stick and slip zones are frozen,
//! the frozen problem (not symmetric, since slipping shear follows pressure) is solved by generalised conjugate residuals
//! with a flexible preconditioner, resultants held exactly; then back to feasible tractions, until all laws hold.

use serde::{Deserialize, Serialize};

use super::preconditioner::Preconditioner;
use super::residual::{NormalVerdict, TangentialTask, TangentialVerdict, judge_normal};
use super::retraction::{retract_pressure, retract_shear};
use super::rigid::RigidModes;
use super::settings::{SolveError, SolverSettings, Watch};
use super::shear::RigidProjector;
use super::zones::{Freedom, Zones};
use crate::compliance::SurfaceCompliance;
use crate::model::TangentialField;
use crate::model::field::{add_scaled, dot, largest};

/// How much of the cut a frozen problem is solved below; raised while outer steps do not pay.
const THETA: f64 = 0.3;
/// Share of its start to which a frozen problem is solved at the most when something is cut.
const ETA: f64 = 0.02;

/// What the coupled equations of one increment ask for, over the cells of a box.
#[derive(Debug)]
pub struct CoupledTask<'a> {
    /// Gap before deformation [length].
    pub undeformed: &'a [f64],
    /// Friction coefficient of every cell [-].
    pub friction: &'a [f64],
    /// Sum of the pressures over the cells, when the force is prescribed [pressure].
    pub total: Option<f64>,
    /// Approach, when it is prescribed [length].
    pub approach: f64,
    /// Tangential displacement before the increment [length].
    pub before: &'a TangentialField,
    /// Rigid tangential motions.
    pub modes: &'a RigidModes,
    /// Increments of the motions that are prescribed [length].
    pub motion: [f64; 3],
    /// Sums over the cells of shear times mode, for motions that follow from a resultant [pressure].
    pub resultant: [f64; 3],
}

/// Tractions of a box: pressure and shear.
#[derive(Debug, Clone)]
pub struct Tractions {
    /// Pressure [pressure].
    pub pressure: Vec<f64>,
    /// Shear on the lower body [pressure].
    pub shear: TangentialField,
}

impl Tractions {
    /// No traction anywhere.
    pub fn zeros(len: usize) -> Self {
        Self { pressure: vec![0.0; len], shear: TangentialField::zeros(len) }
    }

    fn dot(&self, other: &Self) -> f64 {
        dot(&self.pressure, &other.pressure) + self.shear.dot(&other.shear)
    }

    fn add_scaled(&mut self, factor: f64, other: &Self) {
        add_scaled(&mut self.pressure, factor, &other.pressure);
        self.shear.add_scaled(factor, &other.shear);
    }
}

/// What the coupled solver reached.
#[derive(Debug)]
pub struct CoupledSolution {
    /// Approach and normal residual.
    pub normal: NormalVerdict,
    /// Motions and tangential residual.
    pub tangential: TangentialVerdict,
    /// Gap [length].
    pub gap: Vec<f64>,
    /// Minus the slip increment [length].
    pub s: TangentialField,
    /// Outer iterations made.
    pub iterations: usize,
}

/// Displacements of a box [length].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Displacements {
    /// Normal.
    pub normal: Vec<f64>,
    /// Tangential.
    pub tangential: TangentialField,
}

impl Displacements {
    /// Nothing displaced.
    pub fn zeros(len: usize) -> Self {
        Self { normal: vec![0.0; len], tangential: TangentialField::zeros(len) }
    }
}

/// Solves the coupled equations from feasible `tractions` with their `displacements`; both end at the solution.
pub fn solve_coupled(
    task: &CoupledTask<'_>,
    tractions: &mut Tractions,
    displacements: &mut Displacements,
    compliance: &mut dyn SurfaceCompliance,
    preconditioner: &mut Preconditioner,
    settings: &SolverSettings,
    watch: Watch<'_>,
) -> Result<CoupledSolution, SolveError> {
    let len = task.undeformed.len();
    let own = compliance.own();
    let prescribed = if task.total.is_none() { Some(task.approach) } else { None };
    let mut s = TangentialField::zeros(len);
    let mut motion = [0.0; 3];
    let mut theta = THETA;
    let mut last_residual = f64::INFINITY;
    let mut best = f64::INFINITY;
    let mut kept: Option<(Tractions, Displacements, f64)> = None;
    let mut damping = 1.0_f64;
    for iteration in 0..settings.most_outer_iterations {
        let mut gap: Vec<f64> =
            displacements.normal.iter().zip(task.undeformed).map(|(u, g)| u + g).collect();
        let normal = judge_normal(&tractions.pressure, &mut gap, task.undeformed, own.normal, prescribed);
        let bound: Vec<f64> = tractions.pressure.iter().zip(task.friction).map(|(p, mu)| p * mu).collect();
        let contact: Vec<usize> =
            (0..len).filter(|&cell| tractions.pressure[cell] > 0.0 || gap[cell] < 0.0).collect();
        let tangential_task = TangentialTask {
            contact: &contact,
            bound: &bound,
            before: task.before,
            modes: task.modes,
            motion: task.motion,
            resultant: task.resultant,
            own: own.tangential,
        };
        let tangential = tangential_task.judge(&tractions.shear, &displacements.tangential, motion, &mut s);
        motion = tangential.motion;
        let residual = normal.residual.max(tangential.residual);
        best = best.min(residual);
        if watch(iteration, residual).is_break() {
            return Err(SolveError::Stopped);
        }
        if residual < settings.tolerance {
            return Ok(CoupledSolution { normal, tangential, gap, s, iterations: iteration });
        }
        // A step that made things much worse is taken back by half.
        if let Some((before, displaced, residual_before)) = &kept
            && residual > 4.0 * residual_before
            && damping > 0.1
        {
            damping *= 0.5;
            let mut half = before.clone();
            half.add_scaled(-1.0, tractions);
            tractions.add_scaled(0.5, &half);
            for (u, b) in displacements.normal.iter_mut().zip(&displaced.normal) {
                *u = 0.5 * (*u + b);
            }
            displacements.tangential.add_scaled(-1.0, &displaced.tangential);
            displacements
                .tangential
                .x
                .iter_mut()
                .chain(displacements.tangential.y.iter_mut())
                .for_each(|u| *u *= 0.5);
            displacements.tangential.add_scaled(1.0, &displaced.tangential);
            continue;
        }
        damping = 1.0;
        theta =
            if residual > 0.9 * last_residual { (4.0 * theta).min(300.0) } else { (theta / 2.0).max(THETA) };
        last_residual = residual;
        kept = Some((tractions.clone(), displacements.clone(), residual));
        let zones = Zones::classify(contact.clone(), &tractions.shear, &s, &bound, |cell| {
            tractions.pressure[cell] <= 0.0
        });
        let frozen = Frozen { task, tangential: &tangential_task, zones: &zones, settings, theta };
        let step = frozen.solve(&gap, &s, tractions, compliance, preconditioner);
        tractions.add_scaled(1.0, &step);
        if !retract_pressure(&mut tractions.pressure, task.total) {
            break;
        }
        let bound: Vec<f64> = tractions.pressure.iter().zip(task.friction).map(|(p, mu)| p * mu).collect();
        retract_shear(&mut tractions.shear, &zones, &TangentialTask { bound: &bound, ..tangential_task });
        compliance.full(
            &tractions.pressure,
            &tractions.shear,
            &mut displacements.normal,
            &mut displacements.tangential,
        );
    }
    Err(SolveError::NotConverged { reached: best, iterations: settings.most_outer_iterations })
}

/// The coupled problem on frozen zones.
struct Frozen<'a, 'b> {
    task: &'a CoupledTask<'b>,
    tangential: &'a TangentialTask<'a>,
    zones: &'a Zones,
    settings: &'a SolverSettings,
    theta: f64,
}

impl Frozen<'_, '_> {
    /// Step that solves the frozen problem as far as the zones deserve it.
    fn solve(
        &self,
        gap: &[f64],
        s: &TangentialField,
        tractions: &Tractions,
        compliance: &mut dyn SurfaceCompliance,
        preconditioner: &mut Preconditioner,
    ) -> Tractions {
        let len = gap.len();
        let rigid = RigidProjector::new(self.tangential, self.zones);
        preconditioner.freeze(self.zones);
        let mut residual = Tractions::zeros(len);
        for &cell in &self.zones.contact {
            residual.pressure[cell] = -gap[cell];
            residual.shear.set(cell, [-s.x[cell], -s.y[cell]]);
        }
        self.remove_mean(&mut residual.pressure);
        self.zones.keep_free(&mut residual.shear);
        rigid.remove(&mut residual.shear);
        let start = residual.dot(&residual).sqrt();
        let scale = largest(&tractions.pressure);
        let floor = 0.02 * self.settings.tolerance * scale * compliance.own().normal;
        let mut step = Tractions::zeros(len);
        let mut first_size = 0.0;
        let mut directions: Vec<(Tractions, Tractions)> = Vec::new();
        let mut displaced = Displacements::zeros(len);
        for depth in 0..self.settings.most_inner_iterations {
            let mut along = self.precondition(&residual, &rigid, preconditioner);
            if depth == 0 {
                first_size = self.size_of(&along);
            }
            compliance.full(&along.pressure, &along.shear, &mut displaced.normal, &mut displaced.tangential);
            let mut image = self.image_of(&along, &displaced, &rigid);
            for (other, other_image) in &directions {
                let share = image.dot(other_image);
                image.add_scaled(-share, other_image);
                along.add_scaled(-share, other);
            }
            let size = image.dot(&image).sqrt();
            if !(size > 0.0 && size.is_finite()) {
                break;
            }
            scale_by(&mut image, 1.0 / size);
            scale_by(&mut along, 1.0 / size);
            let share = residual.dot(&image);
            step.add_scaled(share, &along);
            residual.add_scaled(-share, &image);
            directions.push((along, image));
            let left_over = residual.dot(&residual).sqrt();
            let cut = self.cut_of(tractions, &step);
            let left = first_size * left_over / start;
            if left_over < floor || (cut > 0.0 && (cut > self.theta * left || left_over < ETA * start)) {
                break;
            }
        }
        step
    }

    fn remove_mean(&self, field: &mut [f64]) {
        if self.task.total.is_none() {
            return;
        }
        let total: f64 = self.zones.contact.iter().map(|&cell| field[cell]).sum();
        let mean = total / self.zones.contact.len().max(1) as f64;
        for &cell in &self.zones.contact {
            field[cell] -= mean;
        }
    }

    fn precondition(
        &self,
        residual: &Tractions,
        rigid: &RigidProjector<'_>,
        preconditioner: &mut Preconditioner,
    ) -> Tractions {
        let len = residual.pressure.len();
        let mut image = vec![0.0; len];
        preconditioner.normal(&residual.pressure, &mut image);
        let mut along = Tractions::zeros(len);
        for &cell in &self.zones.contact {
            along.pressure[cell] = image[cell];
        }
        self.remove_mean(&mut along.pressure);
        preconditioner.shear(&residual.shear, self.zones, &mut along.shear);
        // The shear that follows pressure in slipping cells, and the rigid part that keeps the resultants.
        let mut resultant = [0.0; 3];
        for &cell in &self.zones.contact {
            let mut vector = along.shear.at(cell);
            if self.zones.is_on_circle(cell) {
                let follow = self.task.friction[cell] * along.pressure[cell];
                let direction = self.zones.direction.at(cell);
                vector = [vector[0] + follow * direction[0], vector[1] + follow * direction[1]];
            }
            let products = self.task.modes.products(vector, cell);
            for mode in 0..3 {
                resultant[mode] += products[mode];
            }
        }
        rigid.remove_resultant(&mut along.shear, resultant);
        for &cell in &self.zones.contact {
            if self.zones.is_on_circle(cell) {
                let follow = self.task.friction[cell] * along.pressure[cell];
                along.shear.x[cell] += follow * self.zones.direction.x[cell];
                along.shear.y[cell] += follow * self.zones.direction.y[cell];
            }
        }
        along
    }

    /// Left side of the frozen equations for tractions `along` with their displacements.
    fn image_of(
        &self,
        along: &Tractions,
        displaced: &Displacements,
        rigid: &RigidProjector<'_>,
    ) -> Tractions {
        let len = along.pressure.len();
        let mut image = Tractions::zeros(len);
        let mut turning = TangentialField::zeros(len);
        for &cell in &self.zones.contact {
            image.pressure[cell] = displaced.normal[cell];
            image.shear.set(cell, displaced.tangential.at(cell));
            if self.zones.freedom[cell] == Freedom::Slip {
                turning.set(cell, self.zones.tangent_part(along.shear.at(cell), cell));
            }
        }
        self.remove_mean(&mut image.pressure);
        self.zones.keep_free(&mut image.shear);
        self.zones.add_stiffness(&mut image.shear, &turning);
        rigid.remove(&mut image.shear);
        image
    }

    /// Distance of tractions + step from feasible ones, in units of pressure.
    fn cut_of(&self, tractions: &Tractions, step: &Tractions) -> f64 {
        let mut square = 0.0;
        for &cell in &self.zones.contact {
            let pressure = tractions.pressure[cell] + step.pressure[cell];
            square += pressure.min(0.0).powi(2);
            let friction = self.task.friction[cell];
            if friction <= 0.0 {
                continue;
            }
            let limit = friction * pressure.max(0.0);
            let vector =
                [tractions.shear.x[cell] + step.shear.x[cell], tractions.shear.y[cell] + step.shear.y[cell]];
            let size = (vector[0] * vector[0] + vector[1] * vector[1]).sqrt();
            if size > limit || self.zones.is_on_circle(cell) {
                square += ((size - limit) / friction).powi(2);
            }
        }
        square.sqrt()
    }

    /// Size of tractions in units of pressure.
    fn size_of(&self, tractions: &Tractions) -> f64 {
        let mut square = dot(&tractions.pressure, &tractions.pressure);
        for &cell in &self.zones.contact {
            let friction = self.task.friction[cell];
            if friction > 0.0 {
                let vector = tractions.shear.at(cell);
                square += (vector[0] * vector[0] + vector[1] * vector[1]) / (friction * friction);
            }
        }
        square.sqrt()
    }
}

fn scale_by(tractions: &mut Tractions, factor: f64) {
    let Tractions { pressure, shear } = tractions;
    pressure
        .iter_mut()
        .chain(shear.x.iter_mut())
        .chain(shear.y.iter_mut())
        .for_each(|value| *value *= factor);
}
