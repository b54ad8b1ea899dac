//! Shear alone, at given pressure: stick and slip zones frozen from feasible shear, conjugate gradients on the frozen
//! problem with the resultants held exactly, back to the friction discs; again until Coulomb's law holds.

use super::components::Components;
use super::coulomb::{CoulombJudge, TangentialTask, TangentialVerdict};
use super::elastic_answer::ElasticAnswer;
use super::fronts::Fronts;
use super::frozen_zones::{FrozenZones, RigidProjector, parts_of};
use super::patience::{ETA, Patience, SIX_DIGITS, enough};
use super::preconditioner::{Preconditioner, SlipShares};
use super::retraction::Retraction;
use super::settings::{SolveError, SolverSettings, Watch};
use super::starting_shear::{StartingShear, after, taken};
use super::units::Units;
use super::zones::Zones;
use crate::compliance::SurfaceCompliance;
use crate::model::TangentialField;
use crate::model::each_cell::{CellRule, Number, Reals, each_cell};
use crate::model::field::{add_converted, add_scaled, largest, norm};

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
    let cells = displacement.x.len();
    let mut here = contact.packed_tangential(displacement);
    let mut spread = TangentialField::zeros(cells);
    let mut gradients = Gradients::default();
    let mut zones = Zones::default();
    let mut motion = [0.0; 3];
    let mut patience = Patience::default();
    let mut fronts = Fronts::default();
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
        gradients.exact |= patience.is_at_an_end();
        zones.classify(shear, &judge.s, task.bound);
        let enough = enough(settings.tolerance, verdict.residual);
        let frozen = Frozen { task, zones: &zones, settings, enough, theta, cells, first: iteration == 0 };
        let cut = frozen.solve(&judge.s, shear, displacement, &mut gradients, compliance, preconditioner);
        let carried = fronts.carry_on(shear, &zones, task);
        retraction.shear(shear, &zones, task);
        if cut || carried {
            contact.place_tangential(shear, &mut spread);
            compliance.tangential(spread.parts(), displacement.parts_mut());
        }
        contact.gather_tangential(displacement, &mut here);
    }
    Err(SolveError::NotConverged { reached: patience.best, iterations: settings.most_outer_iterations })
}

/// The tangential problem on frozen zones.
struct Frozen<'a> {
    task: &'a TangentialTask<'a>,
    zones: &'a Zones,
    settings: &'a SolverSettings,
    /// Share of its start at which the residual is small enough.
    enough: f64,
    /// Share of the cut below which solving stops.
    theta: f64,
    /// Cells of the box.
    cells: usize,
    /// It is the first one on this contact.
    first: bool,
}

/// Conjugate gradients on frozen zones.
#[derive(Default)]
struct Gradients {
    /// Whether all digits are wanted.
    exact: bool,
    double: ConjugateGradients<f64>,
    single: ConjugateGradients<f32>,
}

/// Their memory in one precision; fields are packed.
#[derive(Default)]
struct ConjugateGradients<N> {
    zones: FrozenZones<N>,
    start: StartingShear<N>,
    bound: Vec<N>,
    shares: SlipShares<N>,
    residual: Components<N, 2>,
    z: Components<N, 2>,
    z_before: Components<N, 2>,
    step: Components<N, 2>,
    along: Components<N, 2>,
    image: Components<N, 2>,
    answer: ElasticAnswer<N, 2>,
}

impl Frozen<'_> {
    /// Solves until going further would be lost in the cut. Adds the step to `shear` and, when it stays in the feasible set, its
    /// image to `displacement`; tells whether the image must be computed anew.
    fn solve(
        &self,
        s: &TangentialField,
        shear: &mut TangentialField,
        displacement: &mut TangentialField,
        gradients: &mut Gradients,
        compliance: &mut dyn SurfaceCompliance,
        preconditioner: &mut Preconditioner,
    ) -> bool {
        let mut right = Components::default();
        // The pull along slip is larger by far than what turns it: with six digits little of this would be left.
        right.convert(s.parts(), -1.0);
        let parts = parts_of(self.zones, self.task.modes);
        RigidProjector::new(self.task.modes, parts).keep_free(right.parts_mut());
        if !gradients.exact
            && let Some(mut operator) = compliance.tangential_single()
        {
            let units = Units::near_one(largest(self.task.bound), operator.unit());
            let memory = &mut gradients.single;
            memory.take(self, &right, shear, units);
            memory.answer.begin(self.cells, self.first);
            self.solve_in(units, memory, |q, u| operator.apply(&q, &mut { u }), |_, _| (), preconditioner);
            for (shear, step) in shear.parts_mut().into_iter().zip(memory.step.parts()) {
                add_converted(shear, units.pressure, step);
            }
            true
        } else {
            let first = !std::mem::replace(&mut gradients.exact, true);
            let memory = &mut gradients.double;
            memory.take(self, &right, shear, Units::SCENE);
            memory.answer.begin(self.cells, first || self.first);
            let moved = |tau: f64, [x, y]: &[Vec<f64>; 2]| {
                add_scaled(&mut displacement.x, tau, x);
                add_scaled(&mut displacement.y, tau, y);
            };
            let apply = |q: [&[f64]; 2], u: [&mut [f64]; 2]| compliance.tangential(q, u);
            let cut = self.solve_in(Units::SCENE, memory, apply, moved, preconditioner);
            let [x, y] = memory.step.parts();
            add_scaled(&mut shear.x, 1.0, x);
            add_scaled(&mut shear.y, 1.0, y);
            cut
        }
    }

    /// The same in one precision and in its units; `moved` is told the share and the displacements of each direction. Returns
    /// whether the step leaves the feasible set.
    fn solve_in<N: Number>(
        &self,
        units: Units,
        memory: &mut ConjugateGradients<N>,
        mut apply: impl FnMut([&[N]; 2], [&mut [N]; 2]),
        mut moved: impl FnMut(f64, &[Vec<N>; 2]),
        preconditioner: &mut Preconditioner,
    ) -> bool {
        let Self { task, settings, enough, theta, .. } = *self;
        let ConjugateGradients {
            zones,
            start,
            bound,
            shares,
            residual,
            z,
            z_before,
            step,
            along,
            image,
            answer,
        } = memory;
        let rigid = RigidProjector::new(task.modes, zones.parts());
        preconditioner.freeze(zones, units.compliance, self.first, shares);
        step.clear(zones.len());
        z.reset(zones.len());
        z_before.reset(zones.len());
        image.reset(zones.len());
        let first = residual.norm();
        let floor = 0.1 * settings.tolerance * norm(task.bound) * task.own / units.length();
        let mut product_before: Option<f64> = None;
        let mut cut = 0.0;
        for _ in 0..settings.most_inner_iterations {
            preconditioner.shear(residual.parts(), task.contact, z.parts_mut(), shares);
            rigid.keep_free(z.parts_mut());
            let product = z.dot(residual);
            let mut downhill = 0.0;
            if let Some(before) = product_before {
                let beta = ((product - z_before.dot(residual)) / before).max(0.0);
                along.scale_and_add(beta, z);
                downhill = along.dot(residual);
            }
            if downhill <= 0.1 * product {
                along.copy_from(z);
                downhill = product;
            }
            if !(downhill > 0.0) {
                break;
            }
            answer.find(task.contact, along, image, &mut apply);
            let curvature = add_slip_stiffness(image, along, &zones.stiffness);
            if !(curvature > 0.0) {
                break;
            }
            let tau = downhill / curvature;
            step.add_scaled(tau, along);
            moved(tau, answer.in_box());
            rigid.keep_free(image.parts_mut());
            residual.add_scaled(-tau, image);
            let z_size = z.norm();
            std::mem::swap(z, z_before);
            product_before = Some(product);
            cut = cut_of(start, bound, &zones.slip, step);
            let here = residual.norm();
            let left = z_size * tau.abs() * (here / first).clamp(1e-3, 1.0);
            let six_digits = size_of::<N>() < size_of::<f64>() && here < SIX_DIGITS * first;
            if here < floor.max(enough * first)
                || six_digits
                || (cut > 0.0 && (cut > theta * left || here < ETA * first))
            {
                break;
            }
        }
        cut > 0.0
    }
}

impl<N: Number> ConjugateGradients<N> {
    fn take(
        &mut self,
        frozen: &Frozen<'_>,
        right: &Components<f64, 2>,
        shear: &TangentialField,
        units: Units,
    ) {
        self.residual.convert(right.parts(), 1.0 / units.length());
        let Frozen { task, zones, .. } = frozen;
        self.zones.take(zones, task.modes, units.compliance);
        self.start.take(shear, task.bound, units.pressure);
        taken(task.bound, 1.0 / units.pressure, &mut self.bound);
    }
}

/// Distance of shear + step from the discs and circles it has to go back to.
fn cut_of<N: Number>(start: &StartingShear<N>, bound: &[N], slip: &[N], step: &Components<N, 2>) -> f64 {
    let StartingShear { shear: [x, y], size, excess, .. } = start;
    let [step_x, step_y] = step.parts();
    let [square] = each_cell(&Cut, [x, y, size, excess, bound, slip, step_x, step_y], []);
    square.sqrt()
}

/// Adds the slip stiffness times a (free) field to its image; returns their product with the field.
fn add_slip_stiffness<N: Number>(
    image: &mut Components<N, 2>,
    field: &Components<N, 2>,
    stiffness: &[N],
) -> f64 {
    let [x, y] = field.parts();
    let [product] = each_cell(&AddStiffness, [x, y, stiffness], image.parts_mut());
    product
}

struct AddStiffness;

impl CellRule<3, 2, 1> for AddStiffness {
    #[inline(always)]
    fn at<R: Reals>(&self, [x, y, stiffness]: [R; 3], [image_x, image_y]: &mut [R; 2]) -> [R; 1] {
        *image_x = *image_x + stiffness * x;
        *image_y = *image_y + stiffness * y;
        [x * *image_x + y * *image_y]
    }
}

/// Squared distance of `shear + step` from the discs and circles it has to go back to.
struct Cut;

impl CellRule<8, 0, 1> for Cut {
    #[inline(always)]
    fn at<R: Reals>(
        &self,
        [x, y, size, excess, bound, slip, step_x, step_y]: [R; 8],
        _: &mut [R; 0],
    ) -> [R; 1] {
        let (zero, one) = (x.all(0.0), x.all(1.0));
        let (_, growth) = after([x, y], size, [step_x, step_y]);
        let off = excess + growth;
        let moves = (step_x * step_x + step_y * step_y).if_at_most(zero, zero, slip);
        let counts = off.if_at_most(zero, moves, one);
        let square = off * off;
        let rounding = bound * bound * 1e-30;
        [square.if_at_most(rounding, zero, counts * square)]
    }
}
