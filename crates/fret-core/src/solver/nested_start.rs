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
use crate::kernel::Components;
use crate::model::TangentialField;

/// No region with fewer cells along a side is made coarser.
const COARSEST: usize = 24;
/// What the equations leave over on coarse grids, of the pressure.
const GOAL: f64 = 1e-3;
/// Cells of a grid for each of the one above it.
const SHARE: f64 = 0.25;

/// Tractions to start from: the solution on coarser grids, from tractions; these where there is none.
///
/// # Errors
/// When the iteration is stopped.
pub fn nested_start(
    problem: &ContactProblem<'_>,
    tractions: Tractions,
    operators: &mut RegionOperators,
    method: &Method<'_>,
    callback: IterationCallback<'_>,
) -> Result<Tractions, SolveError> {
    let shape = problem.positions.shape();
    let response = (method.response)();
    let scene = (response.is_periodic(), method.operators.symmetry);
    if !is_made_coarser(shape, 2 * COARSEST, scene) {
        return Ok(tractions);
    }
    let below = Below { problem, shape, waves: method.waves };
    let found = below.solution(&tractions, response, method, callback)?;
    let Some((coarse, work)) = found else { return Ok(tractions) };
    operators.coarse_work += work;
    Ok(below.prolonged(&coarse))
}

/// A problem that is solved on the grids below its own.
struct Below<'a> {
    problem: &'a ContactProblem<'a>,
    shape: [usize; 2],
    /// On its own cells.
    waves: Option<CellWaves<'a>>,
}

impl Below<'_> {
    /// Tractions of the grid below under which the equations hold well enough; with what they cost, the cells of the grid above counted as one.
    fn solution(
        &self,
        start: &Tractions,
        response: &SurfaceResponse,
        method: &Method<'_>,
        callback: IterationCallback<'_>,
    ) -> Result<Option<(Tractions, Work)>, SolveError> {
        let Self { problem, shape, waves } = *self;
        let whole = method.operators.symmetry.whole_of(shape);
        let response = coarser_response(response, whole, Components::ALL);
        let shape = shape.map(|count| count.div_ceil(2));
        let waves = waves.map(|waves| CellWaves { spacing: waves.spacing.map(|side| 2.0 * side), ..waves });
        let workspace = SharedWorkspace::default();
        let made = RegionOperators::new(&response, waves, Region::whole(shape), method.operators, &workspace);
        let Ok(mut operators) = made else { return Ok(None) };
        let (undeformed, friction) =
            (self.means(problem.undeformed), problem.friction.map(|f| self.means(f)));
        let (before, positions) = (self.mean_vectors(problem.before), problem.positions.coarser());
        let coarse = of_coarse_cells(problem, (&undeformed, &friction), (&before, &positions));
        let mut tractions =
            Tractions { pressure: self.means(&start.pressure), shear: self.mean_vectors(&start.shear) };
        let mut work = Work::default();
        let scene = (response.is_periodic(), method.operators.symmetry);
        if is_made_coarser(shape, 2 * COARSEST, scene) {
            let below = Below { problem: &coarse, shape, waves };
            if let Some((found, work_below)) = below.solution(&tractions, &response, method, callback)? {
                work += work_below;
                tractions = below.prolonged(&found);
            }
        }
        let mut newton = AugmentedNewton::new(&coarse, &tractions, &mut operators);
        let is_solved = newton.advance(GOAL, &mut operators, method.settings, callback)?;
        work += operators.take_work(1.0);
        work.full_grid_convolutions *= SHARE;
        Ok(is_solved.then_some((newton.into_tractions(), work)))
    }

    /// Tractions of the grid below on the grid above, under the same normal force.
    fn prolonged(&self, coarse: &Tractions) -> Tractions {
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
