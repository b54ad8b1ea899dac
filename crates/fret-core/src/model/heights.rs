//! Heights of a measured or synthetic surface, one for every cell.

use std::sync::{Arc, OnceLock};

use ndarray::Array2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize, Serializer};

use super::digest::digest;
use super::shape::ProfileError;
use super::treatment::Treatment;
use crate::document::Table;
use crate::heights::resample::MeasuredSurface;

/// What is subtracted from heights.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Table, JsonSchema)]
#[schemars(rename = "DetrendFile", rename_all = "lowercase")]
pub enum Detrend {
    /// Nothing.
    None,
    // The gap does not notice: it is counted from first touch.
    /// Their mean.
    Mean,
    /// The least-squares plane.
    Plane,
}

/// A surface given by its heights, as a part of the gap.
#[derive(Debug, Clone, PartialEq)]
pub struct Heights {
    source: String,
    depths: Arc<Depths>,
    treatment: Option<Box<Treatment>>,
    /// What they are the means of, where any grid can take them from it.
    surface: Option<Arc<MeasuredSurface>>,
}

/// Depths below the highest point [length]; a hash of them, their root mean square and the largest, found when they are first asked for.
#[derive(Debug)]
struct Depths {
    values: Array2<f64>,
    summary: OnceLock<(String, [f64; 2])>,
}

impl PartialEq for Depths {
    fn eq(&self, other: &Self) -> bool {
        self.values == other.values
    }
}

impl Detrend {
    /// Subtracts it from heights.
    pub fn remove_from(self, heights: &mut Array2<f64>) {
        match self {
            Self::None => {}
            Self::Mean => {
                let mean = heights.sum() / heights.len() as f64;
                *heights -= mean;
            }
            Self::Plane => take_off_plane(heights),
        }
    }
}

impl Heights {
    /// Surface of heights [length] at the cell centres, shape `(nx, ny)`, positive towards the other body: its highest point
    /// touches first. `source` names where they came from.
    ///
    /// # Errors
    /// When a height is not finite.
    pub fn new(source: &str, mut heights: Array2<f64>, detrend: Detrend) -> Result<Self, ProfileError> {
        if let Some((at, value)) = heights.indexed_iter().find(|(_, value)| !value.is_finite()) {
            return Err(ProfileError::Height { at: [at.0, at.1], value: *value });
        }
        detrend.remove_from(&mut heights);
        let highest = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        heights.mapv_inplace(|height| highest - height);
        let depths = Depths { values: heights, summary: OnceLock::new() };
        Ok(Self { source: source.to_owned(), depths: Arc::new(depths), treatment: None, surface: None })
    }

    /// Means of a measured surface over the cells of a grid of so many along x and y; other grids can take theirs from it as well.
    ///
    /// # Errors
    /// As [`Heights::new`].
    pub fn resampled(
        source: &str,
        surface: MeasuredSurface,
        cells: [usize; 2],
    ) -> Result<Self, ProfileError> {
        let means = Self::new(source, surface.on(cells), Detrend::None)?;
        Ok(Self { surface: Some(Arc::new(surface)), ..means })
    }

    /// The same surface on other cells of the same place and size; `None` where the heights are those of their cells alone.
    pub fn on(&self, cells: [usize; 2]) -> Option<Self> {
        if cells == self.cells() {
            return Some(self.clone());
        }
        let surface = self.surface.clone()?;
        let means = Self::new(&self.source, surface.on(cells), Detrend::None).ok()?;
        Some(Self { treatment: self.treatment.clone(), surface: Some(surface), ..means })
    }

    /// Whether grids of other cells can take theirs from the same surface.
    pub fn fit_any_cells(&self) -> bool {
        self.surface.is_some()
    }

    /// Whether they are means of a surface whose points lie farther apart than cells of so many along x and y.
    pub fn are_coarser_than(&self, cells: [usize; 2]) -> bool {
        self.surface.as_ref().is_some_and(|surface| surface.is_coarser_than(cells))
    }

    /// Measured points that are kept beside the cells.
    pub fn points(&self) -> usize {
        self.surface.as_ref().map_or(0, |surface| surface.heights.len())
    }

    /// The same with the record of what was done to them.
    #[must_use]
    pub fn treated(self, treatment: Treatment) -> Self {
        Self { treatment: Some(Box::new(treatment)), ..self }
    }

    /// Where they came from.
    pub fn source(&self) -> &str {
        &self.source
    }

    /// What was done to them, where they came from an instrument or were treated.
    pub fn treatment(&self) -> Option<&Treatment> {
        self.treatment.as_deref()
    }

    /// Depth of every cell below the highest point [length], shape `(nx, ny)`.
    pub fn depths(&self) -> &Array2<f64> {
        &self.depths.values
    }

    /// Number of cells `[nx, ny]`.
    pub fn cells(&self) -> [usize; 2] {
        let (nx, ny) = self.depths().dim();
        [nx, ny]
    }

    /// Root mean square of the heights about their mean [length].
    pub fn rms(&self) -> f64 {
        let count = self.depths().len() as f64;
        let mean = self.depths().sum() / count;
        (self.depths().iter().map(|depth| (depth - mean).powi(2)).sum::<f64>() / count).sqrt()
    }
}

/// What a record of a run holds of heights: what tells them apart.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct HeightsSummary {
    /// Where they came from.
    pub source: String,
    /// Their cells.
    pub cells: [usize; 2],
    /// Root mean square about their mean [length].
    pub rms: f64,
    /// From the highest point to the lowest [length].
    pub valley: f64,
    /// Hash of their depths.
    pub fnv1a64: String,
    /// What was done to them, where they came from an instrument or were treated.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub treatment: Option<Treatment>,
    /// Whether they are means of a surface whose points lie farther apart than the cells: it is straight between them, and has creases.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub has_creases: bool,
}

impl Serialize for Heights {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let valley = || self.depths().iter().copied().fold(0.0, f64::max);
        let summary = || (fingerprint(self.depths()), [self.rms(), valley()]);
        let (hash, [rms, valley]) = self.depths.summary.get_or_init(summary).clone();
        let (source, fnv1a64) = (self.source.clone(), hash);
        let (cells, treatment) = (self.cells(), self.treatment().cloned());
        let has_creases = self.are_coarser_than(cells);
        HeightsSummary { source, cells, rms, valley, fnv1a64, treatment, has_creases }.serialize(serializer)
    }
}

/// Tells arrays apart: a hash of their bits.
pub(super) fn fingerprint(array: &Array2<f64>) -> String {
    digest(array.iter().flat_map(|value| value.to_bits().to_le_bytes()))
}

/// On a uniform grid centred on its middle, the normal equations of the plane are diagonal.
fn take_off_plane(heights: &mut Array2<f64>) {
    let (nx, ny) = heights.dim();
    let place = |index: usize, cells: usize| index as f64 - (cells as f64 - 1.0) / 2.0;
    let mean = heights.sum() / heights.len() as f64;
    let (mut rise, mut square) = ([0.0; 2], [0.0; 2]);
    for ((i, j), height) in heights.indexed_iter() {
        let at = [place(i, nx), place(j, ny)];
        for axis in 0..2 {
            rise[axis] += at[axis] * (height - mean);
            square[axis] += at[axis] * at[axis];
        }
    }
    let slope = [0, 1].map(|axis| if square[axis] > 0.0 { rise[axis] / square[axis] } else { 0.0 });
    for ((i, j), height) in heights.indexed_iter_mut() {
        *height -= mean + slope[0] * place(i, nx) + slope[1] * place(j, ny);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tilted_plane_is_flat_without_its_plane() {
        let tilted = Array2::from_shape_fn((7, 4), |(i, j)| 3.0 + 0.5 * i as f64 - 2.0 * j as f64);
        let flat = Heights::new("tilted", tilted.clone(), Detrend::Plane).unwrap();
        assert!(flat.depths().iter().all(|depth| depth.abs() < 1e-14), "{flat:?}"); // rounding
        let kept = Heights::new("tilted", tilted, Detrend::Mean).unwrap();
        assert_eq!(kept.depths()[[6, 0]], 0.0); // the highest corner
        assert_eq!(kept.depths()[[0, 3]], 9.0);
    }
}
