//! The constants of bodies: derivatives of the response by them, and how objectives change with each, summed over the increments.

use super::error::SensitivityError;
use super::fields::Fields;
use super::forward::response_by;
use super::operators::displacements;
use super::parameter::Parameter;
use super::scene::Scene;
use crate::compliance::{CrossSpectra, SpectralCompliance};
use crate::fields::dot;

/// The derivatives of the response by the constants of bodies, and what has been gathered of each objective.
pub(super) struct Constants {
    /// In the order of the numbers; none of a number that is of no body.
    responses: Vec<Option<SpectralCompliance>>,
    frictional: bool,
    sums: Vec<Sums>,
    /// Displacements of the tractions of the increment at work by each, where they are needed.
    displaced: Vec<Option<Fields>>,
}

/// What has been gathered of an objective.
enum Sums {
    /// Products of the spectra of what displacements count with those of the tractions: they serve all constants at once.
    Spectra(CrossSpectra),
    /// The derivatives themselves, where products are periodic or go line by line.
    Derivatives(Vec<f64>),
}

impl Constants {
    /// Nothing yet of so many objectives.
    pub fn new(
        scene: &Scene<'_>,
        parameters: &[Parameter],
        objectives: usize,
    ) -> Result<Self, SensitivityError> {
        let responses = parameters
            .iter()
            .map(|parameter| response_by(scene, parameter))
            .collect::<Result<Vec<Option<SpectralCompliance>>, _>>()?;
        let sums = (0..objectives).map(|_| {
            let spectra = responses.iter().flatten().next().and_then(SpectralCompliance::cross_spectra);
            spectra.map_or_else(|| Sums::Derivatives(vec![0.0; parameters.len()]), Sums::Spectra)
        });
        let sums = sums.collect();
        Ok(Self { responses, frictional: scene.is_frictional(), sums, displaced: Vec::new() })
    }

    /// Makes ready for an increment with such tractions.
    pub fn begin(&mut self, tractions: &Fields) {
        if self.sums.iter().any(|sums| matches!(sums, Sums::Derivatives(_))) {
            let of = |change: &mut Option<SpectralCompliance>| {
                change.as_mut().map(|change| displacements(change, self.frictional, tractions))
            };
            self.displaced = self.responses.iter_mut().map(of).collect();
        }
    }

    /// Takes how an objective changes with displacements of the tractions.
    pub fn take(&mut self, objective: usize, tractions: &Fields, counts: &Fields) {
        match &mut self.sums[objective] {
            Sums::Spectra(spectra) => {
                if let Some(response) = self.responses.iter_mut().flatten().next() {
                    let [from, beside] =
                        [tractions, counts].map(|fields| fields.each_ref().map(Vec::as_slice));
                    response.add_cross_spectra(from, beside, spectra);
                }
            }
            Sums::Derivatives(sums) => {
                for (sum, displaced) in sums.iter_mut().zip(&self.displaced) {
                    if let Some(displaced) = displaced {
                        *sum += displaced.iter().zip(counts).map(|(moved, of)| dot(moved, of)).sum::<f64>();
                    }
                }
            }
        }
    }

    /// The derivative of an objective by a number, as far as that is a constant of a body.
    pub fn derivative(&self, objective: usize, number: usize) -> f64 {
        match (&self.sums[objective], &self.responses[number]) {
            (Sums::Spectra(spectra), Some(response)) => response.contracted(spectra),
            (Sums::Derivatives(sums), _) => sums[number],
            (Sums::Spectra(_), None) => 0.0,
        }
    }

    /// Products with them so far.
    pub fn applications(&self) -> usize {
        self.responses.iter().flatten().map(|response| response.applications).sum()
    }
}
