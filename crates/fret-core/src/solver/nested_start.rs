//! Where iterates that need not be feasible start under stiff coatings: at the solution on a grid twice as coarse, which starts in the same way (nested iteration). A coarse cell is four cells
//! under the same tractions, whose gaps and displacements are their means (Galerkin), so that its coefficients are sums of the finer ones, right
//! for all bodies.

use ndarray::{Array2, ArrayView2};

use super::augmented_newton::AugmentedNewton;
use super::contact_problem::{ContactProblem, Pressure};
use super::laws::friction::FrictionLaw;
use super::laws::rigid_motions::CellPositions;
use super::laws::slip_path::SlipPath;
use super::linear::preconditioner::CellWaves;
use super::normal::grid_transfer::{coarser_heights, coarser_response, interpolated, is_made_coarser};
use super::operators::{Method, RegionOperators};
use super::outcome::Work;
use super::prescribed::TangentialLoads;
use super::region::Region;
use super::settings::{IterationCallback, SolveError};
use super::tractions::Tractions;
use crate::compliance::{SharedWorkspace, SurfaceResponse};
use crate::fields::add_scaled;
use crate::kernel::Components;
use crate::model::TangentialField;

/// No region with fewer cells along a side is made coarser.
const COARSEST: usize = 24;
/// What the equations leave over on coarse grids, of the pressure.
const GOAL: f64 = 1e-3;
/// Cells of a grid for each of the one above it.
const SHARE: f64 = 0.25;

/// Left over by the equations, of the pressure, where long waves are off: they are the softest, and interpolation does not keep them as they are. By
/// trial, films 100 to 5000 times stiffer on 96 and 192 cells per side: where less is left the interpolated start costs less.
const MUCH: f64 = 0.3;

/// The method at the solution on coarser grids, found from tractions; `None` where there is none. Where the normal `load_stays` it is at the tractions
/// with what these grids change of their means, on their contact: that hardly moves, and is known more finely than a coarse grid tells it.
///
/// # Errors
/// When the iteration is stopped.
pub fn nested_start<'a>(
    (problem, load_stays): (&'a ContactProblem<'a>, bool),
    tractions: &Tractions,
    operators: &mut RegionOperators,
    method: &Method<'_>,
    callback: IterationCallback<'_>,
) -> Result<Option<AugmentedNewton<'a>>, SolveError> {
    let shape = problem.positions.shape();
    let response = (method.response)();
    let scene = (response.is_periodic(), method.operators.symmetry);
    if !is_made_coarser(shape, 2 * COARSEST, scene) {
        return Ok(None);
    }
    let below = Below { problem, load_stays, shape, waves: method.waves };
    let (coarse, work) = below.solution(tractions, response, method, callback)?;
    operators.coarse_work += work;
    let Some(coarse) = coarse else { return Ok(None) };
    let mut start = below.prolonged(&coarse, tractions);
    let from = AugmentedNewton::new(problem, &start, operators);
    if !load_stays || from.left_over() <= MUCH {
        return Ok(Some(from));
    }
    below.take_means(&coarse, &mut start, &tractions.pressure);
    Ok(Some(AugmentedNewton::new(problem, &start, operators)))
}

/// A problem that is solved on the grids below its own.
struct Below<'a> {
    problem: &'a ContactProblem<'a>,
    load_stays: bool,
    shape: [usize; 2],
    /// On its own cells.
    waves: Option<CellWaves<'a>>,
}

impl Below<'_> {
    /// Tractions of the grid below under which the equations hold well enough, where they are found; and what that costs, the cells of the grid above
    /// counted as one.
    fn solution(
        &self,
        start: &Tractions,
        response: &SurfaceResponse,
        method: &Method<'_>,
        callback: IterationCallback<'_>,
    ) -> Result<(Option<Tractions>, Work), SolveError> {
        let Self { problem, load_stays, shape, waves } = *self;
        let whole = method.operators.symmetry.whole_of(shape);
        let response = coarser_response(response, whole, Components::ALL);
        let shape = shape.map(|count| count.div_ceil(2));
        let waves = waves.map(|waves| CellWaves { spacing: waves.spacing.map(|side| 2.0 * side), ..waves });
        let workspace = SharedWorkspace::default();
        let made = RegionOperators::new(&response, waves, Region::whole(shape), method.operators, &workspace);
        let mut work = Work::default();
        let Ok(mut operators) = made else { return Ok((None, work)) };
        let (undeformed, friction) =
            (self.means(problem.undeformed), problem.friction.map(|f| self.means(f)));
        let (before, positions) = (self.mean_vectors(problem.before), problem.positions.coarser());
        let coarse = of_coarse_cells(problem, (&undeformed, &friction), (&before, &positions));
        let mut tractions = self.mean_tractions(start);
        let scene = (response.is_periodic(), method.operators.symmetry);
        if is_made_coarser(shape, 2 * COARSEST, scene) {
            let below = Below { problem: &coarse, load_stays, shape, waves };
            let (found, work_below) = below.solution(&tractions, &response, method, callback)?;
            work += work_below;
            if let Some(found) = found {
                tractions = below.prolonged(&found, &tractions);
            }
        }
        let mut newton = AugmentedNewton::new(&coarse, &tractions, &mut operators);
        let is_solved = newton.advance(GOAL, &mut operators, method.settings, callback)?;
        work += operators.take_work(1.0);
        work.full_grid_convolutions *= SHARE;
        Ok((is_solved.then(|| newton.into_tractions()), work))
    }

    /// Tractions of the grid below on the grid above, under the same normal force; where that stays the `start` with what they are more than its
    /// means, on its contact.
    fn prolonged(&self, coarse: &Tractions, start: &Tractions) -> Tractions {
        if !self.load_stays {
            return self.interpolated(coarse);
        }
        let mut tractions = start.clone();
        let change = self.interpolated(&self.beyond_means(coarse, start));
        for (to, change) in tractions.parts_mut().into_iter().zip(change.parts()) {
            for ((to, change), p) in to.iter_mut().zip(change).zip(&start.pressure) {
                *to = if *p > 0.0 { *to + change } else { 0.0 };
            }
        }
        tractions
    }

    /// Gives tractions the means of the grid below: what these are more goes to the cells in contact under a pressure, alike.
    fn take_means(&self, coarse: &Tractions, fine: &mut Tractions, pressure: &[f64]) {
        let [_, columns] = self.shape;
        let above = |cell: usize| cell / columns / 2 * columns.div_ceil(2) + cell % columns / 2;
        let missing = self.beyond_means(coarse, fine);
        let mut cells = vec![0.0; missing.pressure.len()];
        let in_contact = |cell: &usize| pressure[*cell] > 0.0;
        (0..pressure.len()).filter(in_contact).for_each(|cell| cells[above(cell)] += SHARE);
        for (to, missing) in fine.parts_mut().into_iter().zip(missing.parts()) {
            for cell in (0..pressure.len()).filter(in_contact) {
                to[cell] += missing[above(cell)] / cells[above(cell)];
            }
        }
    }

    /// What tractions of the grid below are more than the means of others on the grid above.
    fn beyond_means(&self, coarse: &Tractions, fine: &Tractions) -> Tractions {
        let mut beyond = coarse.clone();
        for (to, mean) in beyond.parts_mut().into_iter().zip(self.mean_tractions(fine).parts()) {
            add_scaled(to, -1.0, mean);
        }
        beyond
    }

    /// Tractions of the grid below on the grid above.
    fn interpolated(&self, coarse: &Tractions) -> Tractions {
        let below = self.shape.map(|count| count.div_ceil(2));
        let fine = |field: &[f64]| -> Vec<f64> {
            let field = ArrayView2::from_shape(below, field).map(|view| view.to_owned());
            field
                .map(|field| interpolated(&field, self.shape).into_raw_vec_and_offset().0)
                .unwrap_or_default()
        };
        let [pressure, x, y] = coarse.parts().map(fine);
        Tractions { pressure, shear: TangentialField { x, y } }
    }

    /// Tractions of the grid above on the grid below.
    fn mean_tractions(&self, fine: &Tractions) -> Tractions {
        Tractions { pressure: self.means(&fine.pressure), shear: self.mean_vectors(&fine.shear) }
    }

    /// Means of two by two cells.
    fn means(&self, field: &[f64]) -> Vec<f64> {
        let field = ArrayView2::from_shape(self.shape, field).map(|view| view.to_owned());
        field
            .map(|field: Array2<f64>| coarser_heights(&field).into_raw_vec_and_offset().0)
            .unwrap_or_default()
    }

    fn mean_vectors(&self, field: &TangentialField) -> TangentialField {
        TangentialField { x: self.means(&field.x), y: self.means(&field.y) }
    }
}

/// The problem of cells twice as wide, from their fields: sums over cells are a quarter, and slip is taken to be straight.
fn of_coarse_cells<'a>(
    fine: &ContactProblem<'_>,
    (undeformed, friction): (&'a [f64], &'a FrictionLaw),
    (before, positions): (&'a TangentialField, &'a CellPositions),
) -> ContactProblem<'a> {
    let tangential = fine.tangential;
    ContactProblem {
        pressure: Pressure::Unknown,
        undeformed,
        friction,
        normal: fine.normal.of_share(SHARE),
        tangential: TangentialLoads {
            resultant: tangential.resultant.map(|sum| SHARE * sum),
            spring: tangential.spring.map(|spring| SHARE * spring),
            ..tangential
        },
        before,
        path: &STRAIGHT,
        positions,
    }
}

static STRAIGHT: SlipPath = SlipPath::END_POINT;

#[cfg(test)]
mod tests {
    use super::super::tests::few_cells::{Asked, Cells};
    use super::*;
    use crate::random::Random;

    /// Random tractions in cells of which some are out of contact, and others on the grid below: those that are the means of the first change nothing;
    /// others are the means afterwards wherever a cell is in contact, by sums written down here, and none is pressed out of contact.
    #[test]
    fn a_start_changes_by_what_the_grid_below_changes_of_its_means() {
        let cells = Cells::new([6, 4], 0.3);
        let mut random = Random::seeded(47);
        for _ in 0..20 {
            let mut start = Tractions::zeros(24);
            for cell in 0..24 {
                // one coarse cell without any
                if cell / 4 >= 2 && random.between(0.0, 1.0) < 0.7 {
                    start.parts_mut().into_iter().for_each(|part| part[cell] = random.between(0.1, 1.0));
                }
            }
            let mut coarse = Tractions::zeros(6);
            coarse
                .parts_mut()
                .into_iter()
                .flatten()
                .for_each(|traction| *traction = random.between(-1.0, 1.0));
            Asked::drawn(&mut random, &cells).problem(&cells, |problem| {
                let below = Below { problem, load_stays: true, shape: [6, 4], waves: None };
                assert_eq!(below.prolonged(&below.mean_tractions(&start), &start), start);
                let mut fine = below.prolonged(&coarse, &start);
                below.take_means(&coarse, &mut fine, &start.pressure);
                for (fine, coarse) in fine.parts().into_iter().zip(coarse.parts()) {
                    let (mut sums, mut pressed) = ([0.0; 6], [false; 6]);
                    for cell in 0..24 {
                        let above = cell / 4 / 2 * 2 + cell % 4 / 2;
                        sums[above] += fine[cell];
                        pressed[above] |= start.pressure[cell] > 0.0;
                        assert!(start.pressure[cell] > 0.0 || fine[cell] == 0.0);
                    }
                    for above in 0..6 {
                        let wanted = if pressed[above] { coarse[above] } else { 0.0 };
                        assert!((0.25 * sums[above] - wanted).abs() < 1e-14); // rounding of four numbers near 1
                    }
                }
            });
        }
    }
}
