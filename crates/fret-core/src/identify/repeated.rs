//! The fit repeated over the cycles of a test.

use super::cycles::MeasuredCycle;
use super::drift;
use super::error::IdentifyError;
use super::found::{Constant, Fitted, fitted};
use super::model::Model;

/// What the fit of one cycle among others found.
#[derive(Debug, Clone)]
pub struct RepeatedFit {
    /// The number of the cycle in the log.
    pub cycle: f64,
    /// As those of the one cycle that is fitted; none where this one could not be.
    pub constants: Vec<Constant>,
    /// Standard deviation of the points about the computed loop, relative to the amplitudes; not a number where there is none.
    pub noise: f64,
    /// Why it was not fitted.
    pub why: Option<String>,
}

/// Fits of the first whole cycle of each group of `every` cycles.
///
/// # Errors
/// When the case cannot be planned with the constants of one. A cycle that is none of such a contact, or whose loop cannot be solved, says so.
pub fn repeated(
    name: &str,
    measured: &[MeasuredCycle],
    model: &Model<'_>,
    every: usize,
) -> Result<Vec<RepeatedFit>, IdentifyError> {
    let firsts = (0..measured.len()).step_by(every.max(1)).filter_map(|from| {
        let group = from..measured.len().min(from + every.max(1));
        group.into_iter().find(|&place| measured[place].fault.is_none())
    });
    let fit = |place: usize| {
        let cycle = measured[place].name;
        let failed =
            |why: String| RepeatedFit { cycle, constants: Vec::new(), noise: f64::NAN, why: Some(why) };
        match fitted(name, &measured[place], model, drift::bend(measured, place)) {
            Ok(Fitted { constants, noise, .. }) => Ok(RepeatedFit { cycle, constants, noise, why: None }),
            Err(IdentifyError::Case(error)) => Err(error.into()),
            Err(error) => Ok(failed(error.to_string())),
        }
    };
    firsts.map(fit).collect()
}
