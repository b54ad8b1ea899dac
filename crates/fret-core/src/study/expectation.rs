//! What a run will take on this machine, before it is done: a coarse run of the same case counts increments and operator applications,
//! and a few products of the case's own size tell what one costs here. All of it in less than a second.
//!
//! The constants are fits to the runs of `benches/expected_cost.py`, which sets them beside what runs took; none is proven.

use std::f64::consts::LN_2;
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use ndarray::Array2;
use serde::Serialize;

use super::variation::Variation;
use crate::compliance::{SpectralCompliance, SurfaceCompliance, SurfaceResponse, Wanted};
use crate::cycle::CycleRecord;
use crate::history::{KeptFields, StepRecord, Work};
use crate::kernel::{Components, InfluenceCoefficients, influence_coefficients};
use crate::model::ContactState;
use crate::plan::{Advance, Coupling, Plan};
use crate::simulation::{Iteration, Observer, Simulation};

/// Cells along the longer side of the coarse run.
const COARSE: usize = 32;
/// Cells of the largest grid that is solved as it is, where the case has no other.
const LARGEST_TRIAL: usize = 128 * 128;
/// Time the coarse run may take; a longer one is broken off, and its counts are carried on to the end.
const PATIENCE: Duration = Duration::from_millis(400);
/// Cells along a side of the largest grid on which products are timed; those of larger ones are scaled.
const LARGEST_TIMED: usize = 256;
/// Products that are timed: the quickest counts.
const TIMES: usize = 3;
/// Cells along a side of the grid on which influence coefficients are timed.
const COEFFICIENTS: usize = 48;

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

/// What a kind of case needs.
struct Habit {
    /// Operator applications an increment on [`COARSE`] cells, where nothing better is known.
    convolutions: f64,
    /// How much more they become when the cells of a side are doubled.
    growth: f64,
    /// The same of those weighted by their fraction of the grid.
    growth_on_grid: f64,
    /// Time of a weighted application, with all that is done between two, over that of the product alone.
    overhead: f64,
}

impl Habit {
    fn of(plan: &Plan) -> Self {
        match (plan.coupling, plan.case.periodic) {
            (Coupling::Frictionless, false) => Self { convolutions: 14.0, growth: 0.14, growth_on_grid: 0.0, overhead: 3.0 },
            (Coupling::Frictionless, true) => Self { convolutions: 20.0, growth: 0.02, growth_on_grid: 0.02, overhead: 1.5 },
            (Coupling::Uncoupled, false) => Self { convolutions: 15.0, growth: 0.2, growth_on_grid: 0.2, overhead: 2.0 },
            (Coupling::Coupled, false) => Self { convolutions: 20.0, growth: 0.2, growth_on_grid: 0.2, overhead: 1.3 },
            (_, true) => Self { convolutions: 25.0, growth: 0.1, growth_on_grid: 0.1, overhead: 1.3 },
        }
    }
}

/// What a run of `plan` will take in the pool of threads that this is called in.
pub fn expectation(plan: &Plan) -> Expectation {
    let habit = Habit::of(plan);
    let Counts { increments, convolutions, on_grid, cells } = counts(plan, &habit);
    let doublings = (0.5 * (plan.grid.len() as f64 / cells as f64).ln() / LN_2).max(0.0);
    let convolutions = convolutions * (1.0 + habit.growth * doublings);
    let on_grid = on_grid * (1.0 + habit.growth_on_grid * doublings);
    Expectation {
        increments: increments.round() as usize,
        convolutions: convolutions.round() as usize,
        full_grid_convolutions: on_grid,
        seconds: coefficient_seconds(plan) + habit.overhead * on_grid * product_seconds(plan),
    }
}

/// Counts of a coarse run, carried on to the end of the history.
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
        let mut count = Count { started: Instant::now(), advance: Advance::new(&trial.case), solved: 0, work: Work::default() };
        // However it ends: what was solved until then is what is known.
        let _ = Simulation::new(trial).run(&mut count);
        let passed = count.advance.passed();
        let rest = count.advance.planned() as f64 / passed as f64;
        (passed > 0).then(|| Counts {
            increments: count.solved as f64 * rest,
            convolutions: count.work.convolutions as f64 * rest,
            on_grid: count.work.full_grid_convolutions * rest,
            cells: trial.grid.len(),
        })
    });
    solved.unwrap_or_else(|| {
        let convolutions = plan.increments as f64 * habit.convolutions;
        Counts { increments: plan.increments as f64, convolutions, on_grid: convolutions, cells: COARSE * COARSE }
    })
}

/// The case on few cells; as it is where it has no other grid and is small.
fn trial(plan: &Plan) -> Option<Plan> {
    let own = Variation::of(plan);
    let [nx, ny] = own.cells;
    let shrinking = (nx.max(ny) as f64 / COARSE as f64).max(1.0);
    let cells = if super::ladder::only_one_grid(plan).is_ok() {
        own.cells.map(|side| ((side as f64 / shrinking).round() as usize).max(4).min(side))
    } else {
        own.cells
    };
    let coarse = Variation { cells, ..own }.planned(plan).ok()?;
    (coarse.grid.len() <= LARGEST_TRIAL).then_some(coarse)
}

/// Counts work until its patience is over.
struct Count {
    started: Instant,
    advance: Advance,
    solved: usize,
    work: Work,
}

impl Count {
    fn go_on(&self) -> ControlFlow<()> {
        if self.started.elapsed() > PATIENCE { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

impl Observer for Count {
    fn iterated(&mut self, _: &Iteration) -> ControlFlow<()> {
        self.go_on()
    }

    fn solved(&mut self, record: &StepRecord, _: &ContactState, _: Option<&KeptFields>) -> ControlFlow<()> {
        self.advance.solved(record);
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

/// Time to compute the influence coefficients [s]: that of few cells, scaled.
fn coefficient_seconds(plan: &Plan) -> f64 {
    let cells = plan.case.cells.map(|side| side.min(COEFFICIENTS));
    let started = Instant::now();
    let _ = influence_coefficients(&plan.case.bodies, cells, plan.grid.spacing(), components(plan));
    started.elapsed().as_secs_f64() * plan.grid.len() as f64 / (cells[0] * cells[1]) as f64
}

/// Time of one product with the operators on the plan's grid, in front of its mirrors [s].
fn product_seconds(plan: &Plan) -> f64 {
    let part = plan.symmetry.part_of(plan.case.cells);
    let timed = part.map(|side| side.min(LARGEST_TIMED));
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
    let wanted = Wanted {
        normal: normal && !coupling,
        tangential: tangential && !coupling,
        full: coupling,
        along: plan.along,
        symmetry: plan.symmetry,
        ..Wanted::default()
    };
    let Ok(mut operators) = SpectralCompliance::new(&response, timed, wanted) else { return 0.0 };
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
    let quickest = (0..TIMES).map(|_| once(&mut operators, &mut displacements)).fold(f64::INFINITY, f64::min);
    let work = |[nx, ny]: [usize; 2]| (nx * ny) as f64 * (4.0 * (nx * ny) as f64).log2();
    quickest * work(part) / work(timed)
}
