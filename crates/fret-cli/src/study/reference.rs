//! Reference numbers from a file: quantities of interest at the end of the history, in the units of the case.

use std::path::Path;

use fret_core::case::{CaseError, Mistake, in_words};
use fret_core::study::{Quantity, Reference};
use serde::Deserialize;
use toml::Spanned;

use fret_results::CaseFile;

/// What may stand in the file.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct ReferenceFile {
    max_pressure: Option<Spanned<f64>>,
    approach: Option<Spanned<f64>>,
    contact_area: Option<Spanned<f64>>,
    stick_area: Option<Spanned<f64>>,
    shift: Option<Spanned<[f64; 2]>>,
    dissipated_energy: Option<Spanned<f64>>,
    creepage: Option<Spanned<[f64; 2]>>,
    spin: Option<Spanned<f64>>,
    rolling_friction: Option<Spanned<f64>>,
    max_worn_depth: Option<Spanned<f64>>,
    worn_volume: Option<Spanned<f64>>,
}

/// The numbers of a reference file (TOML), for a history of so many stages.
///
/// # Errors
/// With every mistake found, each with its place.
pub fn reference(path: &Path, stages: usize) -> Result<Reference, CaseError> {
    let file = CaseFile::read(path)?;
    let refused = |mistakes| CaseError::new(&file.name(), &file.text, mistakes);
    let given: ReferenceFile = toml::from_str(&file.text).map_err(|error| {
        refused(vec![Mistake { span: error.span(), message: in_words(error.message()), help: None }])
    })?;
    let scalar = |value: Option<Spanned<f64>>| value.map(|value| (value.span(), [value.into_inner(), 0.0]));
    let vector = |value: Option<Spanned<[f64; 2]>>| value.map(|value| (value.span(), value.into_inner()));
    let values = [
        (Quantity::MaxPressure, scalar(given.max_pressure)),
        (Quantity::Approach, scalar(given.approach)),
        (Quantity::ContactArea, scalar(given.contact_area)),
        (Quantity::StickArea, scalar(given.stick_area)),
        (Quantity::Shift, vector(given.shift)),
        (Quantity::DissipatedEnergy, scalar(given.dissipated_energy)),
        (Quantity::Creepage, vector(given.creepage)),
        (Quantity::Spin, scalar(given.spin)),
        (Quantity::RollingFriction, scalar(given.rolling_friction)),
        (Quantity::MaxWornDepth, scalar(given.max_worn_depth)),
        (Quantity::WornVolume, scalar(given.worn_volume)),
    ];
    let mut reference = Reference::nothing(stages);
    let mut mistakes = Vec::new();
    let mut count = 0;
    for (quantity, value) in values {
        let Some((span, value)) = value else { continue };
        count += 1;
        if value.iter().all(|part| part.is_finite()) {
            reference = reference.with(quantity, value);
        } else {
            let message = format!("{}: must be a finite number", quantity.name());
            mistakes.push(Mistake { span: Some(span), message, help: None });
        }
    }
    if count == 0 {
        let names: Vec<&str> = Quantity::ALL.iter().map(|quantity| quantity.name()).collect();
        let help = Some(format!("at least one of {}", names.join(", ")));
        mistakes.push(Mistake { span: None, message: "no reference number".to_owned(), help });
    }
    if mistakes.is_empty() { Ok(reference) } else { Err(refused(mistakes)) }
}
