//! The accounts of a run, kept by an operator of their own: work done = energy stored + dissipated, increment by increment.
//!
//! Forces and motions run linearly through an increment, so that with symmetric operators the work of the mean forces is exactly
//! the rise of `1/2 t . C t`, plus the mean shear times the slip, plus what the pressure does across gaps that open or close.
//!
//! A run with end points counts the mean of the friction bound at both ends times the slip, since a cell that slips has its bound while it does. That
//! is the mean shear times the slip plus `1/2 (mu p - q . n) |s|` of the cells that had not reached their bound when the increment
//! began: never less, and the same where a cell slips on as it did. Of a cell that comes out of contact it counts half of its mean shear times
//! its motion, where that is positive. What it leaves of the balance it tells as unresolved.

use std::ops::ControlFlow;

use fret_core::compliance::{OperatorSet, SpectralCompliance, SurfaceCompliance, SurfaceResponse};
use fret_core::history::{KeptFields, StepRecord};
use fret_core::kernel::{Components, influence_coefficients, periodic_symbols};
use fret_core::model::{ContactState, MirroredState, TangentialField};
use fret_core::plan::Plan;
use fret_core::run::Observer;
use fret_fft::ConvolutionError;

/// Keeps the accounts of a run and looks at its mirror image.
pub struct Accounts {
    compliance: SpectralCompliance,
    undeformed: Vec<f64>,
    area: f64,
    before: Moment,
    /// Work of the forces, and the sum of its sizes.
    work: [f64; 2],
    dissipated: f64,
    /// Worst of what was found so far.
    worst: f64,
    mirror: f64,
}

/// What the accounts need of an increment.
#[derive(Clone)]
struct Moment {
    pressure: Vec<f64>,
    shear: TangentialField,
    aside: TangentialField,
    gap: Vec<f64>,
    slip: TangentialField,
    approach: f64,
    shift: [f64; 2],
    forces: [f64; 3],
    stored: f64,
}

impl Accounts {
    /// Accounts of a planned run.
    pub fn of(plan: &Plan) -> Result<Self, ConvolutionError> {
        let case = &plan.case;
        let spacing = plan.grid.spacing();
        let response = if case.periodic.is_both() {
            SurfaceResponse::Periodic(periodic_symbols(&case.bodies, case.cells, spacing, Components::ALL, 0))
        } else {
            let all = influence_coefficients(&case.bodies, case.cells, spacing, Components::ALL);
            SurfaceResponse::FreeSpace(all)
        };
        let wanted = OperatorSet { full: true, ..OperatorSet::default() };
        let len = plan.grid.len();
        let undeformed: Vec<f64> = case.profile.gap(&plan.grid).iter().copied().collect();
        let lowest = undeformed.iter().copied().fold(f64::INFINITY, f64::min);
        Ok(Self {
            compliance: SpectralCompliance::new(&response, case.cells, wanted)?,
            area: plan.grid.cell_area(),
            before: Moment {
                pressure: vec![0.0; len],
                shear: TangentialField::zeros(len),
                aside: TangentialField::zeros(len),
                gap: undeformed.iter().map(|gap| gap - lowest).collect(),
                slip: TangentialField::zeros(len),
                approach: lowest,
                shift: [0.0; 2],
                forces: [0.0; 3],
                stored: 0.0,
            },
            undeformed,
            work: [0.0; 2],
            dissipated: 0.0,
            worst: 0.0,
            mirror: 0.0,
        })
    }

    /// Largest gap in the accounts after any increment, relative to the work done so far.
    pub fn balance(&self) -> f64 {
        self.worst
    }

    /// Largest difference of pressure and shear to their mirror images in the line of the pull, relative to the largest.
    pub fn mirror(&self) -> f64 {
        self.mirror
    }

    fn moment(&mut self, state: &ContactState) -> Moment {
        let flat = |field: &ndarray::Array2<f64>| field.iter().copied().collect::<Vec<_>>();
        let pair =
            |fields: &[ndarray::Array2<f64>; 2]| TangentialField { x: flat(&fields[0]), y: flat(&fields[1]) };
        let (pressure, shear, slip) = (flat(&state.pressure), pair(&state.shear), pair(&state.slip));
        let mut normal = vec![0.0; pressure.len()];
        let mut aside = TangentialField::zeros(pressure.len());
        let [along_x, along_y] = aside.parts_mut();
        self.compliance.full([&pressure, &shear.x, &shear.y], [&mut normal, along_x, along_y]);
        let gap = self.undeformed.iter().zip(&normal).map(|(gap, u)| gap + u - state.approach).collect();
        let sum = |field: &[f64]| self.area * field.iter().sum::<f64>();
        let forces = [sum(&pressure), sum(&shear.x), sum(&shear.y)];
        let stored =
            0.5 * self.area * (dot(&pressure, &normal) + dot(&shear.x, &aside.x) + dot(&shear.y, &aside.y));
        Moment {
            pressure,
            shear,
            aside,
            gap,
            slip,
            approach: state.approach,
            shift: state.shift,
            forces,
            stored,
        }
    }

    /// Mean shear times slip of the cells in contact, and times what cells slid that were in contact before and are not any more: all of it, and
    /// that of cells where it is positive.
    fn slid(&self, now: &Moment) -> [f64; 3] {
        let before = &self.before;
        let mut sums = [0.0; 3];
        for cell in 0..now.pressure.len() {
            let is_loaded = now.pressure[cell] > 0.0;
            let work: f64 = (0..2)
                .map(|axis| {
                    let at = |moment: &Moment, field: fn(&Moment) -> &TangentialField| {
                        field(moment).parts()[axis][cell]
                    };
                    let change = |field: fn(&Moment) -> &TangentialField| at(now, field) - at(before, field);
                    let moved = now.shift[axis] - before.shift[axis] - change(|moment| &moment.aside);
                    let slip = if is_loaded { change(|moment| &moment.slip) } else { moved };
                    0.5 * (at(before, |moment| &moment.shear) + at(now, |moment| &moment.shear)) * slip
                })
                .sum();
            sums[usize::from(!is_loaded)] += work;
            sums[2] += if is_loaded { 0.0 } else { work.max(0.0) };
        }
        sums.map(|sum| sum * self.area)
    }

    /// Mean of the friction bound at both ends times slip: what the run itself counts.
    fn rubbed(&self, now: &Moment) -> f64 {
        let before = &self.before;
        let mut sum = 0.0;
        for cell in (0..now.pressure.len()).filter(|cell| now.pressure[*cell] > 0.0) {
            let mean = 0.5 * (before.pressure[cell] + now.pressure[cell]) / now.pressure[cell];
            for axis in 0..2 {
                let slip = now.slip.parts()[axis][cell] - before.slip.parts()[axis][cell];
                sum += mean * now.shear.parts()[axis][cell] * slip;
            }
        }
        self.area * sum
    }
}

fn dot(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(a, b)| a * b).sum()
}

impl Observer for Accounts {
    fn solved(
        &mut self,
        record: &StepRecord,
        state: MirroredState<'_>,
        _: Option<&KeptFields>,
    ) -> ControlFlow<()> {
        let state = state.whole();
        let now = self.moment(&state);
        let before = &self.before;
        let motions =
            [now.approach - before.approach, now.shift[0] - before.shift[0], now.shift[1] - before.shift[1]];
        let works: [f64; 3] =
            std::array::from_fn(|axis| 0.5 * (before.forces[axis] + now.forces[axis]) * motions[axis]);
        let done: f64 = works.iter().sum();
        self.work[0] += done;
        self.work[1] += works.iter().map(|work| work.abs()).sum::<f64>();
        self.mirror = worse(self.mirror, mirrored(&state));
        if record.parts > 1 {
            // Its two ends do not tell where the parts between them slid, nor under which shear.
            self.dissipated = record.dissipated_energy;
            self.before = now;
            return ControlFlow::Continue(());
        }
        let crossed = 0.5 * self.area * (dot(&now.pressure, &before.gap) - dot(&before.pressure, &now.gap));
        let stored = now.stored - before.stored;
        let [slid, left, forward] = self.slid(&now);
        let missing = done - (stored + slid + left + crossed);
        let rubbed = self.rubbed(&now);
        let too_little = (slid - rubbed).max(0.0);
        self.dissipated += rubbed + 0.5 * forward;
        let unrecorded = record.dissipated_energy - self.dissipated;
        let [_, size] = self.work;
        self.worst = worse(self.worst, missing.abs().max(unrecorded.abs()).max(too_little) / size);
        self.before = now;
        ControlFlow::Continue(())
    }
}

/// The larger; what is no number is infinitely bad.
fn worse(so_far: f64, found: f64) -> f64 {
    if found.is_nan() { f64::INFINITY } else { so_far.max(found) }
}

/// Largest difference to the mirror image in the middle line along x, relative to the largest value.
fn mirrored(state: &ContactState) -> f64 {
    let (_, columns) = state.pressure.dim();
    let off = |field: &ndarray::Array2<f64>, sign: f64| {
        field
            .indexed_iter()
            .map(|((i, j), value)| (value - sign * field[[i, columns - 1 - j]]).abs())
            .fold(0.0, f64::max)
    };
    let largest =
        |field: &ndarray::Array2<f64>| field.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    let pressure = off(&state.pressure, 1.0) / largest(&state.pressure);
    let shear = largest(&state.shear[0]).max(largest(&state.shear[1]));
    if shear > 0.0 {
        pressure.max(off(&state.shear[0], 1.0).max(off(&state.shear[1], -1.0)) / shear)
    } else {
        pressure
    }
}
