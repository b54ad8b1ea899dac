//! One increment of the part in front of the mirrors: what it starts from, its solution in a region, checks on the whole grid, and what
//! is remembered of it.

use ndarray::Array2;

use super::coupled;
use super::energy::StateBefore;
use super::increment_problem::{IncrementProblem, Solved};
use super::laws::complementarity::CellLaw;
use super::laws::friction::FrictionLaw;
use super::laws::limit::sliding_fraction;
use super::linear::preconditioner::CellWaves;
use super::memory::{Before, Drift, GridTractions, LastIncrement};
use super::operators::{Method, RegionOperators};
use super::pace::Pace;
use super::region::Region;
use super::sequential;
use super::slip_history::slip_path;
use super::state_after::state_after;
use super::stretch::Stretch;
use super::tractions::{Displacements, Tractions};
use super::{ContactSolver, Coupling, Increment, IterationCallback, Outcome, SolveError, SolverSettings};
use crate::compliance::{OperatorSet, SurfaceCompliance};
use crate::model::{ContactState, Integration, LoadStep, Scheme};

impl ContactSolver<'_> {
    /// Solves one increment, from the tilt that the gap has.
    pub(super) fn solve(
        &mut self,
        state: &ContactState,
        load: &LoadStep,
        callback: IterationCallback<'_>,
    ) -> Result<Increment, SolveError> {
        if let Some(normal) = load.normal.force() {
            self.check_friction_carries(load, normal, sliding_fraction(self.settings.tolerance))?;
        }
        self.take_last_load_as(load, state);
        self.check_hardness_bears(load)?;
        let start = self.pressure_from_coarse_grids(state, load, callback)?;
        let yields = start.as_ref().is_some_and(|start| start.yields);
        let mut start = start.map(|start| start.pressure);
        let mut region = match &start {
            Some(pressure) => self.region_around(pressure, state),
            None => self.region_for(state, load),
        };
        if !self.hardness_bears(load, region) {
            region = Region::whole(self.grid.cells());
        }
        let mut pace = self.pace(load).filter(|_| self.is_of_second_order());
        loop {
            let solved = self.solve_in(region, (start.as_ref(), pace, yields), (state, load), callback);
            if let (Some(_), Err(SolveError::NotConverged { .. })) = (pace, &solved) {
                self.work.end_point_increments += 1;
                pace = None;
                continue;
            }
            let whole = Region::whole(self.grid.cells());
            let by_moment = load.tilt.iter().any(|tilt| tilt.force().is_some());
            if let (true, Err(SolveError::NotConverged { .. })) = (by_moment && region != whole, &solved) {
                // The centre of the pressure may lie anywhere.
                (region, start) = (whole, None);
                continue;
            }
            let (mut solved, after, outcome) = solved?;
            self.set_tilt(after.tilt);
            self.check(load, &after, &outcome, solved.solution.iterations)?;
            self.take_plastic_depth(&after);
            let (gap, contact_area) = self.gap_and_area((region, load), &mut solved, &after)?;
            if self.overlaps_outside(region, &gap) {
                region = whole;
                start = start.map(|_| after.pressure);
                self.take_plastic_depth(state);
                continue;
            }
            let fraction = outcome.stick_cells as f64 / outcome.contact_cells.max(1) as f64;
            let stick_area = contact_area * fraction;
            let friction_work = self.friction_work.take();
            let increment = Increment {
                state: after,
                outcome,
                contact_area,
                stick_area,
                gap,
                friction_work,
                travelled: self.travel > 0,
                work: self.work,
            };
            self.remember((state, load), (region, pace), solved, &increment);
            return Ok(increment);
        }
    }

    /// Whether slip is followed along its path.
    fn is_of_second_order(&self) -> bool {
        self.coupling != Coupling::Frictionless && self.settings.integration == Integration::SecondOrder
    }

    /// One increment with all contact inside `region`, from the pressure `start` when there is one; `pace`: that of the increment, where it goes
    /// on from the last one; `yields`: whether the surfaces certainly yield.
    fn solve_in(
        &mut self,
        region: Region,
        (start, pace, yields): (Option<&Array2<f64>>, Option<Pace>, bool),
        (state, load): (&ContactState, &LoadStep),
        callback: IterationCallback<'_>,
    ) -> Result<(Solved, ContactState, Outcome), SolveError> {
        let (grid, keeps_work) = (self.grid, self.settings.friction_work);
        let copies = self.symmetry.copies();
        let bodies = (self.rig.of_part(copies), self.stretch(state, load), self.pole);
        let (loads, surface) = ((state, load), (&*self.friction, self.coupling));
        let mut increment = IncrementProblem::new(
            (&grid, copies),
            (&self.undeformed, self.tilt),
            surface,
            loads,
            bodies,
            region,
        );
        increment.friction_before =
            self.friction_before.as_ref().map(|law| FrictionLaw::in_region(law, region));
        increment.pauses = self.pauses(load);
        increment.travels = self.travel > 0;
        increment.carried = self.carried.as_ref().map(|carried| region.gather_tangential(carried));
        increment.moved = self.moved.as_ref().map(|moved| region.gather(moved));
        let known = self.memory.last.as_ref().map(|last| StateBefore::of_gap(&last.gap, region));
        let by_cell = || keeps_work.then(|| Array2::zeros(grid.cells()));
        let apart = match increment.apart() {
            Some(solved) if !increment.touched => {
                let before = known.unwrap_or_else(|| increment.state_before(None));
                let rule = (0.0, self.settings.integration);
                self.friction_work = by_cell();
                let (after, outcome) =
                    state_after(&increment, &solved, &before, rule, self.friction_work.as_mut());
                return Ok((solved, after, outcome));
            }
            apart => apart,
        };
        let mut operators = self.operators_for(region)?;
        let before =
            known.unwrap_or_else(|| increment.state_before(increment.touched.then_some(&mut operators)));
        let solved = if let Some(apart) = apart {
            Ok(increment.parted(apart, self.displacements_before(&increment, &before), &mut operators))
        } else {
            increment.start = start.map(|pressure| region.gathered(pressure));
            let tractions = self.predicted(start, (state, load), region);
            if let Some(pace) = pace {
                let beyond =
                    |before: &Before, drift: &Drift| increment.drift_to_here(before, drift, &mut operators);
                increment.path =
                    slip_path(&self.memory, state, (pace, region, self.ends()), beyond).unwrap_or_default();
            }
            self.solve_to_hardness(&mut operators, (&mut increment, &before, yields), tractions, callback)
        };
        self.work += operators.take_work(region.len() as f64 / self.cells_of_whole());
        let influence = operators.compliance.self_influence();
        self.operators = Some(operators);
        self.memory.region = Some(region);
        let mut solved = solved?;
        let law = CellLaw::under(&increment.normal.with_hardness(self.hardness), influence.normal);
        solved.give_way(law, self.settings.tolerance);
        let rule = (influence.tangential, self.settings.integration);
        let mut work = by_cell();
        let (after, outcome) = state_after(&increment, &solved, &before, rule, work.as_mut());
        increment.take_rate_since_touch(&mut solved);
        self.friction_work = work;
        self.work.outer_iterations += solved.solution.iterations;
        if outcome.residual.equilibrium > self.settings.tolerance {
            increment.check_limit(&solved.tractions, 1.0)?;
        }
        Ok((solved, after, outcome))
    }

    /// Solves the equations by the method that the coupling asks for.
    pub(super) fn solve_with(
        &self,
        operators: &mut RegionOperators,
        (increment, before): (&IncrementProblem<'_>, &StateBefore),
        tractions: Tractions,
        callback: IterationCallback<'_>,
    ) -> Result<Solved, SolveError> {
        let keeps_pressure = self.whose_pressure_is_kept(increment.region, increment.load).is_some();
        let last = self.displacements_before(increment, before);
        let response = || self.response.get();
        // Of the methods for both together this is the one that knows a bound of the pressure from above.
        let alternates = increment.normal.hardness.is_some() && self.coupling == Coupling::Coupled;
        let scheme = if alternates { Scheme::Staggered } else { self.settings.scheme };
        let (settings, operators_of) = (&SolverSettings { scheme, ..self.settings }, self.operator_set());
        let method = Method { settings, response: &response, waves: self.waves(), operators: operators_of };
        match self.coupling {
            Coupling::Coupled => coupled::solve(increment, tractions, last, operators, &method, callback),
            Coupling::Uncoupled | Coupling::Frictionless => {
                sequential::solve(increment, tractions, (last, keeps_pressure), operators, settings, callback)
            }
        }
    }

    /// Displacements of the state before in the region of an increment, where they are known.
    fn displacements_before<'b>(
        &'b self,
        increment: &IncrementProblem<'_>,
        before: &'b StateBefore,
    ) -> Option<&'b Displacements> {
        let last = self.memory.last.as_ref().filter(|last| last.region == increment.region);
        last.map(|last| &last.displacements).or(before.displacements.as_ref())
    }

    /// The last increment, where its pressure is that under a load, too: nothing but the load along the surface has changed.
    fn whose_pressure_is_kept(&self, region: Region, load: &LoadStep) -> Option<&LastIncrement> {
        let may_be_kept = self.coupling != Coupling::Coupled && self.settings.reuse_pressure;
        self.memory.last.as_ref().filter(|last| {
            let same = last.load.normal == load.normal && last.load.tilt == load.tilt;
            may_be_kept && same && last.region == region
        })
    }

    /// Gap on the whole grid [length] and area of contact [length^2]; those of the last increment where its pressure was kept.
    fn gap_and_area(
        &mut self,
        (region, load): (Region, &LoadStep),
        solved: &mut Solved,
        after: &ContactState,
    ) -> Result<(Array2<f64>, f64), SolveError> {
        if let Some(last) = self.whose_pressure_is_kept(region, load) {
            return Ok((last.gap.clone(), last.contact_area));
        }
        let gap = self.gap_everywhere(region, solved, after)?;
        let contact_area = self.contact_area(region, &after.pressure, &gap);
        Ok((gap, contact_area))
    }

    /// Remembers an increment that went from a state to a load, for the next one. One in which nothing changed leaves what is known of those
    /// before as it is.
    fn remember(
        &mut self,
        (state, load): (&ContactState, &LoadStep),
        (region, pace): (Region, Option<Pace>),
        solved: Solved,
        increment: &Increment,
    ) {
        if let (true, Some(from)) = (self.goes_in_cycles(), self.memory.last_load) {
            self.memory.last_cycle.keep([&from, load], &increment.state);
        }
        let pauses = self.pauses(load);
        let last = self.memory.last.take();
        let mut drift = Drift::default();
        if let (true, Some(last)) = (pauses, &last) {
            drift.clone_from(&last.drift);
        } else if self.is_of_second_order() {
            let after = &increment.state;
            let shift = [0, 1].map(|axis| after.shift[axis] - state.shift[axis]);
            let twist = after.twist - state.twist;
            let gap_before = self.memory.before.as_ref().and_then(|before| before.gap.as_ref());
            drift = Drift {
                region: Some(region),
                field: solved.drift,
                // about the middle of the grid
                motion: [shift[0] + twist * self.pole[1], shift[1] - twist * self.pole[0], twist],
                strain: self.stretch(state, load).strain,
                ratio: pace.map_or(1.0, |pace| pace.loads),
                knows_touch: gap_before.is_some() && pace.is_some_and(|pace| pace.edge.is_some()),
            };
        }
        if !pauses {
            let contact_area = last.as_ref().map_or(0.0, |last| last.contact_area);
            let (gap, drift) = last.filter(|_| pace.is_some()).map(|last| (last.gap, last.drift)).unzip();
            let previous = self.memory.last_load.replace(*load);
            let before =
                |load| Before { load, tractions: GridTractions::of(state), contact_area, gap, drift };
            self.memory.before = previous.map(before);
        }
        self.memory.last = Some(LastIncrement {
            region,
            displacements: solved.displacements,
            drift,
            gap: increment.gap.clone(),
            contact_area: increment.contact_area,
            load: *load,
        });
    }

    /// The operators of a region; those of the last one when its shape is the same.
    fn operators_for(&mut self, region: Region) -> Result<RegionOperators, SolveError> {
        if let Some(mut operators) = self.operators.take()
            && operators.region.shape == region.shape
        {
            operators.region = region;
            operators.compliance.set_give(self.give_in(region));
            self.response.give_back();
            return Ok(operators);
        }
        let (waves, operators) = (self.waves(), self.operator_set());
        let mut operators =
            RegionOperators::new(self.response.get(), waves, region, operators, &self.workspace)?;
        operators.compliance.set_give(self.give_in(region));
        // Hardly another region follows one that is this large, and nowhere is memory scarcer than in it.
        if 2 * region.len() > self.grid.len() {
            self.response.give_back();
        }
        Ok(operators)
    }

    /// The frequency response of the pair on the grid's cells, where it is known.
    fn waves(&self) -> Option<CellWaves<'_>> {
        self.table.as_ref().map(|table| CellWaves { table, spacing: self.grid.spacing() })
    }

    /// What operators of a region are asked for.
    fn operator_set(&self) -> OperatorSet {
        OperatorSet {
            normal: true,
            tangential: match self.coupling {
                Coupling::Frictionless => false,
                Coupling::Uncoupled => true,
                Coupling::Coupled => self.settings.scheme == Scheme::Staggered || self.hardness.is_some(),
            },
            full: self.coupling == Coupling::Coupled,
            normal_from_all: false,
            shear_axis: self.shear_axis,
            symmetry: self.symmetry,
            single: self.settings.single_precision,
        }
    }

    /// By how much more the lower surface is strained than the upper one, in the increment.
    fn stretch(&self, state: &ContactState, load: &LoadStep) -> Stretch {
        let [before, after] =
            [state.bulk_stress, load.bulk_stress].map(|stress| self.bulk.relative_strain(stress));
        Stretch { strain: [after[0] - before[0], after[1] - before[1]], middle: self.middle }
    }

    /// Cells of the grid, with what lies behind the mirrors.
    fn cells_of_whole(&self) -> f64 {
        (self.grid.len() * self.symmetry.copies()) as f64
    }
}
