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

/// Fits of the first whole cycle of each span of `every` numbers of cycles, from that of the first cycle on.
///
/// # Errors
/// When the case cannot be planned with the constants of one. A span without a whole cycle, a cycle that is none of such a contact, or whose loop
/// cannot be solved, says so.
pub fn repeated(
    name: &str,
    measured: &[MeasuredCycle],
    model: &Model<'_>,
    every: usize,
) -> Result<Vec<RepeatedFit>, IdentifyError> {
    let first = measured.first().map_or(0.0, |cycle| cycle.name);
    let span = |cycle: &MeasuredCycle| ((cycle.name - first) / every.max(1) as f64).floor();
    let failed = |cycle: f64, why: String| RepeatedFit {
        cycle,
        constants: Vec::new(),
        noise: f64::NAN,
        why: Some(why),
    };
    let fit = |place: usize| {
        let cycle = measured[place].name;
        match fitted(name, &measured[place], model, drift::bend(measured, place)) {
            Ok(Fitted { constants, noise, .. }) => Ok(RepeatedFit { cycle, constants, noise, why: None }),
            Err(IdentifyError::Case(error)) => Err(error.into()),
            Err(error) => Ok(failed(cycle, error.to_string())),
        }
    };
    let of_span =
        |cycles: &[MeasuredCycle], from: usize| match cycles.iter().position(|cycle| cycle.fault.is_none()) {
            Some(place) => fit(from + place),
            None => Ok(failed(cycles[0].name, "no cycle among these is a whole loop".to_owned())),
        };
    let mut from = 0;
    let spans = measured.chunk_by(|one, next| span(one) == span(next)).map(|cycles| {
        from += cycles.len();
        (cycles, from - cycles.len())
    });
    spans.map(|(cycles, from)| of_span(cycles, from)).collect()
}
