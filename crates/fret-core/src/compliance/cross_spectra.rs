//! Cross spectra: what scalar products of displacements with fields beside them depend on, whatever the response is.

use super::product::Product;
use super::spectral::SpectralCompliance;

/// Sums of the products of spectra of tractions with those of fields beside the displacements, of every operator at work.
#[derive(Debug, Clone)]
pub struct CrossSpectra(Vec<fret_fft::CrossSpectra>);

impl SpectralCompliance {
    /// The operators that together make all displacements, each with the components that it takes and makes.
    fn all_from_all(&self) -> impl Iterator<Item = (&Product, &'static [usize])> {
        let (all, sheared): (&[usize], &[usize]) = match self.shear_axis {
            Some(axis) => ([&[0, 1], &[0, 2]][axis], [&[1], &[2]][axis]),
            None => (&[0, 1, 2], &[1, 2]),
        };
        let apart = [(&self.normal, &[0][..]), (&self.tangential, sheared)];
        let operators = if self.full.is_some() { vec![(&self.full, all)] } else { apart.to_vec() };
        operators.into_iter().filter_map(|(product, parts)| product.as_ref().map(|product| (product, parts)))
    }

    /// Cross spectra of no fields, for all responses on this region; `None` where the operators have none (periodic problems).
    pub fn cross_spectra(&self) -> Option<CrossSpectra> {
        let made = self.all_from_all().map(|(product, _)| match product {
            Product::FreeSpace(convolution) => convolution.cross_spectra(),
            Product::Periodic(_) => None,
        });
        made.collect::<Option<Vec<_>>>().map(CrossSpectra)
    }

    /// Adds the cross spectra of tractions with fields beside their displacements, each normal, along x and along y.
    pub fn add_cross_spectra(
        &mut self,
        tractions: [&[f64]; 3],
        beside: [&[f64]; 3],
        CrossSpectra(spectra): &mut CrossSpectra,
    ) {
        for ((product, parts), to) in self.all_from_all().zip(spectra) {
            let Product::FreeSpace(convolution) = product else { continue };
            let [from, beside] = [tractions, beside]
                .map(|fields| parts.iter().map(|part| fields[*part]).collect::<Vec<&[f64]>>());
            self.workspace.lend(|workspace| convolution.add_cross_spectra(workspace, (&from, &beside), to));
        }
        self.applications += 1;
    }

    /// The sum, over all that were added, of the scalar products of the fields with the displacements by this response.
    pub fn contracted(&self, CrossSpectra(spectra): &CrossSpectra) -> f64 {
        let operators = self.all_from_all().zip(spectra);
        let of = |((product, _), spectra): ((&Product, _), &fret_fft::CrossSpectra)| match product {
            Product::FreeSpace(convolution) => convolution.contracted(spectra),
            Product::Periodic(_) => 0.0,
        };
        operators.map(of).sum()
    }
}
