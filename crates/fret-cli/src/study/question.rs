//! What is to be studied: resolutions, and what they are compared with.

use std::path::Path;

use fret_core::machine::memory;
use fret_core::plan::Plan;
use fret_core::study::{ClosedForm, Reference, RefinementStudy, Resolutions, VariationError};

use super::reference::reference;
use crate::arguments::StudyRequest;
use crate::failure::Failure;

/// What is to be studied: resolutions that fit into memory, and what they are compared with.
pub struct Question {
    pub resolutions: Resolutions,
    pub against: Against,
}

impl Question {
    /// What the words of a call ask about a plan.
    pub fn new(request: &StudyRequest, plan: &Plan) -> Result<Self, Failure> {
        let resolutions = resolutions(request, plan)?;
        let against = Against::new(request.against.as_deref(), plan)?;
        fits_memory(&resolutions, plan)?;
        Ok(Self { resolutions, against })
    }
}

fn resolutions(request: &StudyRequest, plan: &Plan) -> Result<Resolutions, Failure> {
    let StudyRequest { cells, increments, tolerances, .. } = request;
    if cells.is_empty() && increments.is_empty() && tolerances.is_empty() {
        return Ok(Resolutions::halving(plan));
    }
    Resolutions::new(plan, cells, increments, tolerances)
        .map_err(|error| Failure::call(error.to_string(), "fret study --help"))
}

/// Refuses a study whose finest level the machine has not the memory for.
fn fits_memory(resolutions: &Resolutions, plan: &Plan) -> Result<(), Failure> {
    let finest = resolutions.at(resolutions.finest());
    let too_many = |error: &dyn std::fmt::Display| {
        let cells = plan.grid.dimension().written(finest.cells);
        let message = format!("--cells {}: a grid of {cells} cells {error}", finest.cells[0]);
        Failure::call(message, "--cells with smaller numbers")
    };
    let planned = finest.planned(plan).map_err(|error| match error {
        VariationError::PartsOfCells { why, help } => {
            Failure::call(format!("--cells {}: {why}", finest.cells[0]), help)
        }
        other => too_many(&other),
    })?;
    memory::check(planned.memory_bytes).map_err(|error| too_many(&error))
}

/// What the study is compared with.
pub enum Against {
    /// A closed form where there is one, the limit of the study elsewhere.
    Best(Option<ClosedForm>),
    /// A closed form alone.
    Analytic(ClosedForm),
    /// The finest level.
    Finest,
    /// Numbers from a file.
    Given(Box<Reference>),
}

impl Against {
    fn new(asked: Option<&str>, plan: &Plan) -> Result<Self, Failure> {
        match asked {
            None => Ok(Self::Best(ClosedForm::of(plan))),
            Some("finest") => Ok(Self::Finest),
            Some("analytic") => ClosedForm::of(plan).map(Self::Analytic).ok_or_else(|| {
                Failure::call(
                    "--against analytic: no closed form is available for this case",
                    "without --against Richardson extrapolation is used; --against finest compares with the finest level",
                )
            }),
            Some(file) => {
                let reference = reference(Path::new(file), plan.case.stages.len())?;
                Ok(Self::Given(Box::new(reference)))
            }
        }
    }

    /// What is known of a solved study; nothing without a finest level.
    pub fn reference(self, study: &RefinementStudy) -> Option<Reference> {
        match self {
            Self::Best(form) => {
                let limit = study.limit()?;
                Some(match form {
                    Some(form) => Reference::closed(form).or(limit),
                    None => limit,
                })
            }
            Self::Analytic(form) => Some(Reference::closed(form)),
            Self::Finest => study.finest().map(Reference::finest),
            Self::Given(reference) => Some(*reference),
        }
    }
}
