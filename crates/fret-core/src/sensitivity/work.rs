//! What derivatives take beside the run.

use super::operators::Operators;

/// Work of derivatives beside the run itself, in counts that do not depend on the machine.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Work {
    /// Operator applications in the linear problems.
    pub of_linear_problems: usize,
    /// All others: displacements of what is known.
    pub others: usize,
    /// Both together, each counted as the part of the grid that it works on.
    pub full_grid_applications: f64,
    /// Products with the derivative of the response by a constant of a body.
    pub of_constants: usize,
    /// Preconditioner applications (unpadded).
    pub preconditioner_passes: usize,
    /// Memory of the increments that are kept [bytes], at the most.
    pub kept_bytes: usize,
}

impl Work {
    /// That of operators, and so many products with derivatives of the response.
    pub(super) fn of(operators: &Operators, of_constants: usize) -> Self {
        let (of_linear_problems, others, full_grid_applications, preconditioner_passes) = operators.work();
        Self {
            of_linear_problems,
            others,
            full_grid_applications,
            of_constants,
            preconditioner_passes,
            kept_bytes: 0,
        }
    }
}
