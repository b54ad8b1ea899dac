//! What yields in an increment. Where the pressure is at the hardness and the surfaces would overlap they give way by the overlap, so that they
//! touch again: perfect plasticity, without hardening and without pile-up. The depth stays, and is part of the gap from then on.

use std::borrow::Cow;

use ndarray::Array2;

use super::energy::StateBefore;
use super::increment_problem::{IncrementProblem, Solved};
use super::laws::complementarity::{CellLaw, length_scale, yields_from};
use super::operators::RegionOperators;
use super::settings::{IterationCallback, SolveError};
use super::tractions::Tractions;
use super::{ContactSolver, Coupling};
use crate::fields::{dot, largest, sum};
use crate::model::ContactState;

impl ContactSolver<'_> {
    /// The same solver of surfaces that yield at a hardness [pressure]; `None`: they are elastic.
    #[must_use]
    pub fn with_hardness(self, hardness: Option<f64>) -> Self {
        Self { hardness, ..self }
    }

    /// Takes the gap of surfaces that have yielded as deep as those of a state. Displacements that are known still hold.
    pub(super) fn take_plastic_depth(&mut self, state: &ContactState) {
        if state.plastic_depth.is_none() && self.unyielded.is_none() {
            return;
        }
        let level = self.level.as_ref().unwrap_or(&self.undeformed);
        let unyielded = self.unyielded.get_or_insert_with(|| level.clone());
        let mut gap = unyielded.clone();
        if let Some(depth) = &state.plastic_depth {
            gap += depth;
        }
        if gap != *level {
            let unyielded = self.unyielded.take();
            self.move_gap(gap);
            self.unyielded = unyielded;
        }
    }
}

impl ContactSolver<'_> {
    /// Solves the equations of surfaces that may yield. Where nothing was at the hardness before they are solved as elastic ones first, which they
    /// are as long as nothing is; `yields`: that need not be tried.
    pub(super) fn solve_to_hardness(
        &self,
        operators: &mut RegionOperators,
        (increment, before, yields): (&mut IncrementProblem<'_>, &StateBefore, bool),
        mut tractions: Tractions,
        callback: IterationCallback<'_>,
    ) -> Result<Solved, SolveError> {
        let Some(hardness) = self.hardness else {
            return self.solve_with(operators, (increment, before), tractions, callback);
        };
        let limit = yields_from(hardness);
        let is_below = || increment.state.pressure.iter().all(|pressure| *pressure < limit);
        if !yields && (self.coupling == Coupling::Coupled || is_below()) {
            match self.solve_with(operators, (increment, before), tractions.clone(), callback) {
                Ok(solved) if largest(&solved.tractions.pressure) <= hardness => return Ok(solved),
                Ok(solved) => tractions = solved.tractions,
                Err(SolveError::NotConverged { .. }) => {}
                Err(error) => return Err(error),
            }
            increment.start = Some(Cow::Owned(tractions.pressure.clone()));
        }
        increment.normal = increment.normal.with_hardness(self.hardness);
        self.solve_with(operators, (increment, before), tractions, callback)
    }
}

impl Solved {
    /// Cells at the hardness give way by what they overlap. What a tolerance of the residual cannot tell from nothing is left, so that surfaces
    /// that are loaded again as before do not creep.
    pub(super) fn give_way(&mut self, law: CellLaw, tolerance: f64) {
        let CellLaw { self_influence: own, hardness } = law;
        if hardness.is_infinite() {
            return;
        }
        let Self { tractions, displacements, solution, .. } = self;
        let (pressure, gap) = (&tractions.pressure, &mut solution.gap);
        let load = sum(pressure);
        if load <= 0.0 {
            return;
        }
        let cells = pressure.iter().filter(|p| **p > 0.0).count();
        let mean = dot(pressure, &displacements.normal) / load;
        let least = tolerance * length_scale(mean, [own, load / cells as f64], solution.normal.approach);
        let mut yielded = Vec::new();
        for (cell, (p, gap)) in pressure.iter().zip(gap).enumerate() {
            if *p > 0.0 && -*gap > least + own * (hardness - p) {
                if yielded.is_empty() {
                    yielded = vec![0.0; pressure.len()];
                }
                yielded[cell] = -*gap;
                *gap = 0.0;
            }
        }
        self.yielded = yielded;
    }
}

impl IncrementProblem<'_> {
    /// The plastic depth after an increment, from that before it.
    pub(super) fn plastic_depth(&self, solved: &Solved) -> Option<Array2<f64>> {
        let before = &self.state.plastic_depth;
        if self.normal.hardness.is_none() || solved.yielded.is_empty() {
            return before.clone();
        }
        let mut depth = before.clone().unwrap_or_else(|| Array2::zeros(self.grid.cells()));
        for (cell, yielded) in solved.yielded.iter().enumerate() {
            if *yielded > 0.0 {
                depth[self.region.at(cell)] += yielded;
            }
        }
        Some(depth)
    }
}
