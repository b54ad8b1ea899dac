//! What a run will take on this machine, before it is done: a coarse run of the same case counts increments and operator applications,
//! and a few products of the case's own size tell what one costs here. All of it in less than a second.
//!
//! The constants are fits to the runs of `benches/expected_cost.py`, which sets them beside what runs took; none is proven.

use std::f64::consts::LN_2;
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use ndarray::Array2;
use serde::Serialize;

use super::resolutions::only_one_grid;
use super::variation::Variation;
use crate::compliance::{OperatorSet, SpectralCompliance, SurfaceCompliance, SurfaceResponse};
use crate::fields::largest;
use crate::history::{CycleRecord, KeptFields, StepRecord, Work};
use crate::kernel::{Components, InfluenceCoefficients, influence_coefficients, line_coefficients};
use crate::model::{Dimension, MirroredState};
use crate::plan::{Advance, Coupling, Plan};
use crate::run::{Iteration, Observer, Simulation};

/// Cells along the longer side of the coarse run.
const COARSE: usize = 32;
/// Cells of a grid that is tried as it is.
const SMALL: usize = 64 * 64;
/// Cells of the largest grid that is tried as it is, where the case has no other.
const LARGEST_TRIAL: usize = 128 * 128;
/// Operator applications times cells that the coarse run may take, about half a second: a longer one is broken off after an increment,
/// and its counts are extrapolated to the end. A count, so that the same is expected however busy the machine is.
const ENOUGH: usize = 6_000_000;
/// Time after which a coarse run is broken off all the same: on a machine that is slow, or busy with other work.
const PATIENCE: Duration = Duration::from_secs(5);
/// Cells along a side of the largest grid on which products are timed; those of larger ones are scaled.
const LARGEST_TIMED: usize = 256;

/// What a run is expected to take.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Expectation {
    /// Increments that will be solved: fewer than planned where a stage ends early or cycles stand for others.
    pub increments: usize,
    /// Operator applications.
    pub convolutions: usize,
    /// The same, each weighted by its fraction of the whole grid.
    pub full_grid_convolutions: f64,
    /// Time [s] on the threads of the pool that this was asked in.
    pub seconds: f64,
}

/// What an application is worth, in boxes and on coarser grids, over one on the whole grid, where nothing better is known.
const IN_BOXES: f64 = 0.3;
/// Products are timed for so long: the quickest counts, since other work on the machine only makes them slower.
const TIMING: Duration = Duration::from_millis(80);

/// What a kind of case needs; times are those of the machine that `benches/expected_cost.py` was run on last, one thread.
struct Habit {
    /// Operator applications an increment on [`COARSE`] cells, where nothing better is known.
    convolutions: f64,
    /// How much more they become when the cells of a side are doubled.
    growth: f64,
    /// The same of those weighted by their fraction of the grid.
    growth_on_grid: f64,
    /// Time of a product a cell and power of two of the padded grid [s].
    product: f64,
    /// Time of a weighted application, with all that is done between two, over that of the product alone.
    overhead: f64,
    /// Time to make the operators [s a cell].
    operators: f64,
}

/// Time to begin and to end a run [s].
const ENDS: f64 = 0.04;
/// Time of an increment beside its applications: its records, its line, its checkpoint [s].
const INCREMENT: f64 = 3e-4;
/// The same a cell: states, the edge of contact, the check on the whole grid, the checkpoint [s].
const INCREMENT_CELL: f64 = 0.33e-6;
/// Time to write a kept field to the disk [s], and a byte of it.
const KEPT_FIELD: f64 = 1e-3;
const KEPT_BYTE: f64 = 2e-9;

impl Habit {
    fn of(plan: &Plan) -> Self {
        let [alone, periodic] = [!plan.case.periodic.is_both(), plan.case.periodic.is_both()];
        match plan.coupling {
            Coupling::Frictionless => Self {
                convolutions: 13.0,
                growth: if periodic { 0.1 } else { 0.25 },
                growth_on_grid: if alone { 0.0 } else { 0.1 },
                product: 0.75e-9,
                overhead: 2.5,
                operators: 0.45e-6,
            },
            Coupling::Uncoupled => Self {
                convolutions: 14.0,
                growth: 0.25,
                growth_on_grid: 0.21,
                product: 2.0e-9,
                overhead: 2.1,
                operators: 0.6e-6,
            },
            Coupling::Coupled => Self {
                convolutions: 20.0,
                growth: 0.25,
                growth_on_grid: 0.21,
                product: 2.7e-9,
                overhead: if alone { 3.4 } else { 2.2 },
                operators: 0.8e-6,
            },
        }
    }

    /// Time of a product on a grid in front of its mirrors [s].
    fn product_seconds(&self, [nx, ny]: [usize; 2]) -> f64 {
        let cells = (nx * ny) as f64;
        self.product * cells * (4.0 * cells).log2()
    }
}

/// What a run of `plan` will take in the pool of threads that this is called in.
pub fn expectation(plan: &Plan) -> Expectation {
    let habit = Habit::of(plan);
    let Counts { increments, convolutions, on_grid, cells } = counts(plan, &habit);
    let doublings = (0.5 * (plan.grid.len() as f64 / cells as f64).ln() / LN_2).max(0.0);
    let convolutions = convolutions * (1.0 + habit.growth * doublings);
    let on_grid = on_grid * (1.0 + habit.growth_on_grid * doublings);
    let cells = plan.grid.len() as f64;
    let products = habit.overhead * on_grid * habit.product_seconds(plan.symmetry.part_of(plan.case.cells));
    let around = ENDS + cells * habit.operators + increments * (INCREMENT + cells * INCREMENT_CELL);
    let fields = plan.case.kept_increments().len() * plan.case.output.fields.len();
    let reached = increments / plan.increments as f64;
    let written = reached * (KEPT_FIELD * fields as f64 + KEPT_BYTE * plan.kept_bytes as f64);
    Expectation {
        increments: increments.round() as usize,
        convolutions: convolutions.round() as usize,
        full_grid_convolutions: on_grid,
        seconds: table_seconds(plan) + slowness(plan, &habit) * (around + products) + written,
    }
}

/// Counts of a coarse run, extrapolated to the end of the history.
struct Counts {
    increments: f64,
    convolutions: f64,
    on_grid: f64,
    /// Cells it was solved on.
    cells: usize,
}

fn counts(plan: &Plan, habit: &Habit) -> Counts {
    let trial = trial(plan);
    let solved = trial.as_ref().and_then(|trial| {
        let mut count = Count {
            started: Instant::now(),
            enough: ENOUGH / trial.grid.len(),
            advance: Advance::new(&trial.case),
            limit: trial.case.wear.as_ref().and_then(|wear| wear.limit),
            worn: 0.0,
            solved: 0,
            work: Work::default(),
        };
        // However it ends: what was solved until then is what is known, and all there is when it ends well.
        let is_whole = Simulation::new(trial).run(&mut count).is_ok();
        let passed = count.advance.passed();
        let done = if is_whole { 1.0 } else { count.done() };
        let rest = 1.0 / done;
        (passed > 0).then(|| Counts {
            increments: count.solved as f64 * rest,
            convolutions: count.work.convolutions as f64 * rest,
            on_grid: count.work.full_grid_convolutions * rest,
            cells: trial.grid.len(),
        })
    });
    solved.unwrap_or_else(|| {
        let convolutions = plan.increments as f64 * habit.convolutions;
        Counts {
            increments: plan.increments as f64,
            convolutions,
            on_grid: IN_BOXES * convolutions,
            cells: COARSE * COARSE,
        }
    })
}

/// The case on few cells; as it is where it is small and has no other grid, or a measured surface, of which few cells say little.
fn trial(plan: &Plan) -> Option<Plan> {
    let own = Variation::of(plan);
    let [nx, ny] = own.cells;
    let shrinking = (nx.max(ny) as f64 / COARSE as f64).max(1.0);
    let has_other_grids = plan.case.profile.heights.is_empty() && only_one_grid(plan).is_ok();
    let cells = if plan.grid.len() > SMALL && has_other_grids {
        own.cells.map(|side| ((side as f64 / shrinking).round() as usize).max(4).min(side))
    } else {
        own.cells
    };
    let coarse = Variation { cells, ..own.clone() }.planned(plan).or_else(|_| own.planned(plan)).ok()?;
    (coarse.grid.len() <= LARGEST_TRIAL).then_some(coarse)
}

/// Counts work until it is enough.
struct Count {
    started: Instant,
    /// Applications that are enough.
    enough: usize,
    advance: Advance,
    /// Worn depth that ends the history [length].
    limit: Option<f64>,
    /// Largest worn depth so far [length].
    worn: f64,
    solved: usize,
    work: Work,
}

impl Count {
    /// How much of the history is over: of what is planned, or of the depth that ends it.
    fn done(&self) -> f64 {
        let passed = self.advance.passed() as f64 / self.advance.planned() as f64;
        self.limit.map_or(passed, |limit| passed.max(self.worn / limit))
    }

    fn go_on(&self) -> ControlFlow<()> {
        let is_enough = self.work.convolutions > self.enough || self.started.elapsed() > PATIENCE;
        if is_enough { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

impl Observer for Count {
    fn iterated(&mut self, _: &Iteration) -> ControlFlow<()> {
        self.go_on()
    }

    fn solved(
        &mut self,
        record: &StepRecord,
        state: MirroredState<'_>,
        _: Option<&KeptFields>,
    ) -> ControlFlow<()> {
        self.advance.solved(record);
        if let Some(depth) = state.part.worn_depth.as_ref().and_then(|depth| depth.as_slice()) {
            self.worn = largest(depth);
        }
        self.solved += 1;
        self.work += record.work;
        self.go_on()
    }

    fn cycled(&mut self, record: &CycleRecord) {
        self.advance.cycled(record);
    }

    fn leaves_fields(&self) -> bool {
        false
    }
}

/// The components that a plan's operators have.
fn components(plan: &Plan) -> Components {
    match plan.coupling {
        Coupling::Frictionless => Components::NORMAL,
        Coupling::Uncoupled => Components { normal: true, tangential: true, coupling: false },
        Coupling::Coupled => Components::ALL,
    }
}

/// Time to tabulate how the pair answers [s], which depends on the layers and hardly on the grid.
fn table_seconds(plan: &Plan) -> f64 {
    let started = Instant::now();
    let (bodies, spacing) = (&plan.case.bodies, plan.grid.spacing());
    let _ = if plan.grid.dimension() == Dimension::Line {
        let datum = plan.datum.unwrap_or(plan.grid.size()[0]);
        line_coefficients(bodies, 2, spacing[0], datum, components(plan))
    } else {
        influence_coefficients(bodies, [2, 2], spacing, components(plan))
    };
    started.elapsed().as_secs_f64()
}

/// How many times as long as in the table of habits a product takes on this machine, with the threads at hand.
fn slowness(plan: &Plan, habit: &Habit) -> f64 {
    let timed = plan.symmetry.part_of(plan.case.cells).map(|side| side.min(LARGEST_TIMED));
    let whole = plan.symmetry.whole_of(timed);
    let any = |wanted: bool| wanted.then(|| Array2::from_elem(whole, 1.0));
    let Components { normal, tangential, coupling } = components(plan);
    let response = SurfaceResponse::FreeSpace(InfluenceCoefficients {
        zz: any(normal),
        xx: any(tangential),
        yy: any(tangential),
        xy: any(tangential),
        zx: any(coupling),
        zy: any(coupling),
    });
    let wanted = OperatorSet {
        normal: normal && !coupling,
        tangential: tangential && !coupling,
        full: coupling,
        shear_axis: plan.along,
        symmetry: plan.symmetry,
        ..OperatorSet::default()
    };
    let Ok(mut operators) = SpectralCompliance::new(&response, timed, wanted) else { return 1.0 };
    let cells = timed[0] * timed[1];
    let tractions = vec![1.0; cells];
    let mut displacements = [vec![0.0; cells], vec![0.0; cells], vec![0.0; cells]];
    let once = |operators: &mut SpectralCompliance, [x, y, z]: &mut [Vec<f64>; 3]| {
        let started = Instant::now();
        match plan.coupling {
            Coupling::Frictionless => operators.normal(&tractions, z),
            Coupling::Uncoupled => operators.tangential([&tractions, &tractions], [x, y]),
            Coupling::Coupled => operators.full([&tractions, &tractions, &tractions], [z, x, y]),
        }
        started.elapsed().as_secs_f64()
    };
    let started = Instant::now();
    let mut quickest = f64::INFINITY;
    while started.elapsed() < TIMING {
        quickest = quickest.min(once(&mut operators, &mut displacements));
    }
    quickest / habit.product_seconds(timed)
}
