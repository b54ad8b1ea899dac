//! The journey of a run: stages, increments, cycles, records. The only file that knows all of it.

use std::borrow::Cow;
use std::cell::RefCell;
use std::time::Instant;

use ndarray::Array2;

use super::checkpoint::{Place, Waypoint, solved_state};
use super::debris::give;
use super::fretting_loop::{CycleEnd, FrettingLoop, slid};
use super::moving::{Stepper, upper_wear_over_grid};
use super::observer::{Iteration, Observer, Part};
use super::pair_compliance::PairCompliance;
use super::plastic::plastic;
use super::plausibility::Gauge;
use super::recording::{kept, record, tell_rates, whole};
use super::records::Records;
use super::refinement::{DivisionError, Heard, Refinement, Span, first_touch, in_halves};
use super::run_error::{RunError, run_error, too_thin};
use super::steady::Onward;
use super::stepping::StageSteps;
use super::stiffest_wave::StiffestWave;
use super::surfaces::{Block, Surfaces};
use super::thinning::{LayersWorn, bodies_left, due, layers_worn};
use super::wear::{debris, worn};
use crate::case::{Case, Stage};
use crate::history::{CycleRecord, History, KeptFields, StepRecord, WornThrough, WornTo};
use crate::kernel::uniform_response;
use crate::model::{ContactState, CoulombFriction, Integration, LoadStep, MirroredState, SolvedState};
use crate::plan::{Coupling, Plan};
use crate::solver::{Increment, Resultants};

/// A run on its way.
pub(super) struct Journey<'a> {
    pub plan: &'a Plan,
    pub solver: Stepper<'a>,
    pub surfaces: Surfaces,
    /// Where it stands, in front of the mirrors.
    pub state: ContactState,
    pub records: Records,
    pub gauge: Gauge,
    pub place: Place,
    /// The cycle at work.
    pub cycle: Option<FrettingLoop>,
    pub observer: &'a mut dyn Observer,
}

impl<'a> Journey<'a> {
    fn case(&self) -> &'a Case {
        &self.plan.case
    }

    /// Whether the end of the next increment depends on the way there.
    fn depends_on_way(&self, stage: &Stage) -> bool {
        let sheared = || self.state.shear.iter().flatten().any(|shear| *shear != 0.0);
        let moves = self.plan.coupling == Coupling::Coupled || stage.is_tangential() || sheared();
        moves && self.solver.solver.friction().largest() > 0.0
    }

    /// How the next increment is divided where that is left to the program.
    fn refinement(&self, stage: &Stage) -> Option<Refinement> {
        let tolerance = stage.history_tolerance?;
        self.depends_on_way(stage).then(|| Refinement {
            tolerance,
            residual: self.case().tolerance,
            integration: self.case().integration,
            friction: self.solver.solver.friction().largest(),
        })
    }

    /// Whether bodies that are apart are pressed together in the next increment, and that is to be solved in parts.
    fn touches_first(&self, stage: &Stage) -> bool {
        stage.divides_first_touch
            && stage.normal.is_some()
            && self.case().integration == Integration::SecondOrder
            && self.depends_on_way(stage)
            && self.state.pressure.iter().all(|pressure| *pressure <= 0.0)
    }

    pub fn through_all_stages(mut self) -> (History, Result<(), RunError>) {
        let outcome = loop {
            let Some(stage) = self.case().stages.get(self.place.stage) else { break Ok(()) };
            if let Err(error) = self.through_stage(stage) {
                break Err(error);
            }
        };
        (self.ended(), outcome)
    }

    /// The history that ends here.
    fn ended(self) -> History {
        let Self { plan, solver, surfaces, state, records, gauge, place, .. } = self;
        drop(solver); // room for the whole state
        Records { warnings: gauge.warnings(plan), ..records }.history(
            plan,
            (&place, state),
            surfaces.underway(),
        )
    }

    /// Solves what is left of the stage at work.
    fn through_stage(&mut self, stage: &'a Stage) -> Result<(), RunError> {
        let (number, begins) = (self.place.stage, self.place.solved_of_stage == 0);
        if begins {
            self.surfaces.begin_stage();
        }
        let friction = match &self.surfaces.evolving {
            None => self.plan.symmetry.part_of_friction(self.case().friction_of(number)),
            Some(evolving) => Cow::Owned(evolving.friction().clone()),
        };
        self.solver.set_friction(friction);
        if begins && self.case().friction_changes_at(number) {
            self.solver.solver.forget_increments_before();
        }
        self.surfaces.take_friction(self.solver.solver.friction());
        let place = &self.place;
        let steps = if begins {
            let reached = (&place.resultants, self.case().springs());
            StageSteps::new(stage, &place.held, &self.state, reached)
        } else {
            StageSteps::from_start(stage, place.stage_start)
        };
        if begins {
            self.place.stage_start = steps.start();
            self.place.cycles = 0;
            self.cycle = stage.cycles().map(|_| self.loop_from_here(1));
        }
        for k in self.place.solved_of_stage + 1..=stage.increments_in_all() {
            let from = if k == 1 { steps.start() } else { steps.at(k - 1) };
            self.increment(stage, k, [&from, &steps.at(k)])?;
            if self.place.stage > number {
                break;
            }
        }
        Ok(())
    }

    /// Solves increment `k` of the stage at work and tells of it. When that ends a cycle or the stage, so does the place.
    fn increment(&mut self, stage: &Stage, k: usize, [from, to]: [&LoadStep; 2]) -> Result<(), RunError> {
        let (number, all) = (self.place.stage, stage.increments_in_all());
        let may_keep = k == all || stage.ends_cycle(k) || self.case().keeps(number, k);
        let (mut record, mut kept) = self.solved([from, to], may_keep)?;
        let ended =
            if stage.ends_cycle(k) || k == all { self.cycle_over(stage, record.increment)? } else { None };
        record.dissipated_energy = self.state.dissipated_energy;
        record.bulk_work = self.state.bulk_work;
        record.external_work = self.state.external_work;
        record.unresolved_energy = self.state.unresolved_energy;
        [record.worn_volume, record.max_worn_depth] = worn(&self.state, self.plan);
        record.debris = debris(&self.state, self.plan);
        record.plastic = plastic(&self.state, self.plan);
        let steady = ended.as_ref().is_some_and(|cycle| cycle.steady);
        let enough = stage.cycles().is_some_and(|course| self.place.cycles >= course.most);
        let last = k == all || steady || enough || self.place.worn_out;
        if !last && !self.case().keeps(number, k) {
            kept = None;
        }
        if let (Some(kept), Some(depth)) = (&mut kept, &self.state.worn_depth)
            && self.case().output.fields.iter().any(|name| name == "worn_depth")
        {
            let increment = record.increment;
            let out_of_memory = |error| RunError::OutOfMemory { increment, error };
            let whole =
                |depth: &Array2<f64>| whole(depth, [false; 2], self.plan.symmetry).map_err(out_of_memory);
            kept.worn_depth = Some(match upper_wear_over_grid(self.plan, &self.state) {
                None => whole(depth)?,
                Some(upper) => whole(&(depth + &upper))?,
            });
            if let Some(upper) = &self.state.upper_worn_depth {
                kept.own_worn_depth = Some([whole(depth)?, whole(upper)?]);
            }
        }
        if let (Some(kept), Some(thickness)) = (&mut kept, &self.state.debris)
            && self.case().output.fields.iter().any(|name| name == "debris")
        {
            let increment = record.increment;
            let found = whole(thickness, [false; 2], self.plan.symmetry);
            kept.debris = Some(found.map_err(|error| RunError::OutOfMemory { increment, error })?);
        }
        self.place.solved += 1;
        self.place.solved_of_stage = k;
        if let Some(kept) = &mut kept {
            kept.rest = self.rest_beside(kept, last).map(Box::new);
            let is_end = last && (self.place.worn_out || number + 1 == self.case().stages.len());
            let memory = self.solver.memory();
            let goes_on = is_end && memory.knows_slip() && self.surfaces.underway().leaves_the_gap();
            kept.memory = goes_on.then(|| Box::new(memory.clone()));
        }
        self.gauge.add(&record);
        let reached = MirroredState { part: &self.state, symmetry: self.plan.symmetry };
        let heard = self.observer.solved(&record, reached, kept.as_ref());
        self.records.steps.push(record);
        if self.observer.leaves_fields() {
            self.records.fields.extend(kept);
        }
        if let Some(cycle) = ended {
            self.observer.cycled(&cycle);
            self.cycle = Some(self.loop_from_here(cycle.cycle + 1));
            self.records.cycles.push(cycle);
        }
        if last {
            self.place.stage = if self.place.worn_out { self.case().stages.len() } else { number + 1 };
            self.place.solved_of_stage = 0;
            self.cycle = None;
        }
        let underway = self.surfaces.underway();
        let stored = self.observer.reached(&Waypoint {
            place: &self.place,
            state: &self.state,
            memory: self.solver.memory(),
            cycle: self.cycle.as_ref(),
            wear: underway.wear[0],
            upper_wear: underway.wear[1],
            debris: underway.debris,
            slip: underway.slip,
        });
        if heard.is_break() || stored.is_break() {
            return Err(RunError::Interrupted { increment: self.place.solved });
        }
        Ok(())
    }

    /// What another history needs to start here besides the kept fields; of what `ends` a stage in any case, of other increments
    /// where the fields that are not kept are zero.
    fn rest_beside(&self, kept: &KeptFields, ends: bool) -> Option<SolvedState> {
        let is_kept = |name: &str| kept.field(name).is_some();
        if !ends && !self.state.is_zero_beside(is_kept) {
            return None;
        }
        let rest = solved_state(&self.place, self.state.beside(is_kept), self.surfaces.underway());
        Some(self.plan.symmetry.whole_solved(rest))
    }

    /// A cycle that starts now, in the stage at work.
    fn loop_from_here(&self, cycle: usize) -> FrettingLoop {
        let Place { solved, stage, resultants, .. } = self.place;
        let Resultants { tangential, moment, .. } = resultants;
        FrettingLoop::new((stage, cycle), solved, &self.state, tangential, moment)
    }

    /// The mean gap that a load prescribes between surfaces that repeat, where it leaves none.
    fn closed_gap(&self, load: &LoadStep) -> Option<f64> {
        let case = self.case();
        let approach = load.normal.motion().filter(|_| case.periodic.is_both())?;
        if uniform_response(&case.bodies).is_some() {
            return None;
        }
        let gap = case.profile.gap(&self.plan.grid).mean()? - approach;
        (gap <= 0.0).then_some(gap)
    }

    /// Solves the next increment, in parts where it is left to the program or not solved as a whole; its fields, should they be kept.
    fn solved(
        &mut self,
        [from, to]: [&LoadStep; 2],
        may_keep: bool,
    ) -> Result<(StepRecord, Option<KeptFields>), RunError> {
        let case = self.case();
        let Place { solved: increment, stage, .. } = self.place;
        let at_work = &case.stages[stage];
        let (refinement, touches_first) = (self.refinement(at_work), self.touches_first(at_work));
        if let Some(gap) = self.closed_gap(to) {
            return Err(RunError::GapClosed { increment, stage: case.stages[stage].name.clone(), gap });
        }
        let started = Instant::now();
        let observer = RefCell::new(&mut *self.observer);
        let failed = |error| run_error(&error, increment, case, stage);
        let mut watch = |iteration: usize, residual: f64| {
            let tolerance = case.tolerance;
            observer.borrow_mut().iterated(&Iteration { increment, stage, iteration, residual, tolerance })
        };
        let (state, plan) = (&self.state, self.plan);
        let setting = (plan.symmetry, case.periodic);
        let (hears, leaves) = (observer.borrow().hears_parts(), observer.borrow().leaves_fields());
        let (mut is_divided, mut unkept) = (false, None);
        let mut passed = |share: f64, solved: &Increment, friction: &CoulombFriction| {
            is_divided |= share < 1.0;
            if !hears || !is_divided {
                return;
            }
            let record = record(solved, (case.springs(), friction, setting), (increment, stage, 1), 0.0);
            let fields = || kept(solved, (friction, plan.symmetry), increment, &case.output.fields);
            match (may_keep && leaves).then(fields).transpose() {
                Err(error) => unkept = Some(error),
                Ok(kept) => {
                    let state = MirroredState { part: &solved.state, symmetry: plan.symmetry };
                    let part = Part { share, record: &record, state, kept: kept.as_ref() };
                    observer.borrow_mut().passed(&part);
                }
            }
        };
        let mut held = *to;
        let (solver, span) = (&mut self.solver, Span::whole(state, [from, to]));
        let (solved, parts) = if at_work.steady {
            let (end, cells);
            let (rates, direction) = (at_work.rates(), at_work.roll_direction);
            let onward = Onward { wanted: to, rates, direction };
            (end, held, cells) = solver.roll_until_steady(state, onward, &mut watch).map_err(failed)?;
            (end, cells)
        } else {
            let heard = &mut Heard { iteration: &mut watch, part: &mut passed };
            match refinement {
                None if touches_first => {
                    first_touch(solver, &mut self.surfaces, span, heard).map_err(failed)?
                }
                None => in_halves(solver, &mut self.surfaces, span, heard).map_err(failed)?,
                Some(refinement) => {
                    let divided = refinement.solve(solver, &self.surfaces, span, self.place.parts, heard);
                    let divided = divided.map_err(|error| match error {
                        DivisionError::Unsolved(error) => failed(error),
                        DivisionError::Unresolved { reached, parts } => RunError::HistoryUnresolved {
                            increment,
                            stage: at_work.name.clone(),
                            reached,
                            tolerance: refinement.tolerance,
                            parts,
                        },
                    })?;
                    self.surfaces = divided.surfaces;
                    self.place.parts = divided.next;
                    (divided.end, divided.parts)
                }
            }
        };
        if let Some(error) = unkept {
            return Err(RunError::OutOfMemory { increment, error });
        }
        let wall_s = started.elapsed().as_secs_f64();
        let (friction, symmetry) = (self.solver.solver.friction(), plan.symmetry);
        let mut record =
            record(&solved, (case.springs(), friction, setting), (increment, stage, parts), wall_s);
        tell_rates(&mut record, &self.state, &solved.state);
        let kept =
            may_keep.then(|| kept(&solved, (friction, symmetry), increment, &case.output.fields)).transpose();
        let kept = kept.map_err(|error| RunError::OutOfMemory { increment, error })?;
        if let Some(cycle) = &mut self.cycle {
            let before = self.solver.brought_to(&self.state, &solved.state);
            cycle.add(&record, slid(&before, &solved.state));
        }
        self.place.resultants = solved.outcome.resultants;
        self.place.held = held;
        self.state = solved.state;
        Ok((record, kept))
    }

    /// Changes the surfaces by what slip did to them in the cycle (or the stage without cycles) that ends with `increment`, and reads the
    /// cycle's loop.
    fn cycle_over(&mut self, stage: &Stage, increment: usize) -> Result<Option<CycleRecord>, RunError> {
        let friction_before = self.cycle.as_ref().map(|_| self.solver.solver.friction().clone());
        let block = self.change_surfaces(stage, increment)?;
        let Block { cycles: stands_for, evolved, .. } = block;
        self.place.cycles += stands_for;
        let (Some(cycle), Some(course)) = (&self.cycle, stage.cycles()) else { return Ok(None) };
        let end = CycleEnd {
            rig: self.case().rig,
            stands_for,
            last_cycle: self.place.cycles,
            tolerance: course.until_steady,
            worn: worn(&self.state, self.plan),
            debris: self.state.debris.is_some().then(|| debris(&self.state, self.plan)),
            evolved,
            layers: self.layers_worn(cycle.contact_area()),
            wear_jump_error: block.wear_jump_error,
        };
        let friction = friction_before.as_ref().unwrap_or_else(|| self.solver.solver.friction());
        let record = cycle.close(&self.state, friction, end);
        self.gauge.add_cycle(&record);
        cycle.repeat(&mut self.state, stands_for);
        Ok(Some(record))
    }

    /// What is known of the layers that wear.
    fn layers_worn(&self, contact_area: f64) -> Option<LayersWorn> {
        let rule = self.case().wear.as_ref()?;
        let over = upper_wear_over_grid(self.plan, &self.state);
        layers_worn(self.plan, rule, (&self.state, over.as_ref()), contact_area)
    }

    /// Finds the elastic response anew where layers have become thinner.
    fn thin(&mut self) -> Result<(), RunError> {
        let Some(wearing) = &mut self.surfaces.wearing else { return Ok(()) };
        let case = &self.plan.case;
        let over = upper_wear_over_grid(self.plan, &self.state);
        let due = case
            .wear
            .as_ref()
            .and_then(|rule| due(rule, wearing.collected().thinned(), (&self.state, over.as_ref())));
        let Some(depths) = due else { return Ok(()) };
        let bodies = bodies_left(self.plan, depths).map_err(|reason| too_thin(case, &self.place, reason))?;
        let compliance = PairCompliance::of_bodies(self.plan, &bodies);
        for wearing in self.surfaces.each_wearing() {
            wearing.set_thinned(depths, StiffestWave::of(self.plan, &compliance));
        }
        let (increment, stage) = (self.place.solved, self.place.stage);
        self.solver
            .set_response(self.plan, &bodies, compliance)
            .map_err(|error| run_error(&error, increment, case, stage))
    }

    /// What is told of a place that is worn through after more cycles of the stage at work.
    fn worn_through(&self, increment: usize, cell: [usize; 2], cycles: usize, to: WornTo) -> WornThrough {
        let Plan { grid, symmetry, .. } = self.plan;
        let cell = symmetry.image_behind(cell, symmetry.part_of(grid.cells()));
        WornThrough {
            to,
            increment,
            stage: self.place.stage,
            cycles: self.place.cycles + cycles,
            cell,
            place: [grid.centre(0, cell[0]), grid.centre(1, cell[1])],
        }
    }

    /// Opens the gap, thins the bodies and changes friction by what slip has done since the last time.
    fn change_surfaces(&mut self, stage: &Stage, increment: usize) -> Result<Block, RunError> {
        let left = stage.cycles().map_or(1, |course| course.most - self.place.cycles);
        let of_cycle = stage.cycles().is_some();
        let state = &mut self.state;
        let block = self.surfaces.end_block(state, (left, of_cycle)).map_err(|too_fast| {
            RunError::WearTooFast { increment, stage: stage.name.clone(), share: too_fast.share }
        })?;
        if let (true, Some(wearing)) = (block.opened, &self.surfaces.wearing) {
            self.solver.solver.set_give(give(self.plan.case.wear.as_ref(), &self.state));
            self.solver.open_gap(|| wearing.gap(&self.state));
        }
        if block.opened && block.through.is_none() {
            self.thin()?;
        }
        if let Some(evolving) = &self.surfaces.evolving {
            self.solver.set_friction(Cow::Owned(evolving.friction().clone()));
        }
        self.place.worn_out = block.through.is_some();
        if self.place.worn_through.is_none() {
            let coating = block.coating_through.map(|(cell, cycles)| (cell, cycles, WornTo::Coating));
            let limit = block.through.map(|cell| (cell, block.cycles, WornTo::Limit));
            self.place.worn_through =
                coating.or(limit).map(|(cell, cycles, to)| self.worn_through(increment, cell, cycles, to));
        }
        Ok(block)
    }
}
