//! The keys that say what is done to measured heights, as they are written. The doc comments here are the schema's descriptions.

use schemars::JsonSchema;

use crate::document::{At, Range, Table};

/// A wavelength.
const WAVELENGTH: Range = Range::POSITIVE.words("must be a positive finite length");

/// What is done to measured heights, in this order: holes filled, a part cut, the trend removed, filtered, resampled.
#[derive(Table, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct TreatmentFile {
    /// Channel of an instrument's file that has several, by its name. Default: its first with heights.
    pub channel: Option<At<String>>,
    /// Side lengths of the scan along x and y [length], as many spacings of its points as points; one length of a line scan. Default: those
    /// that the file of an instrument states, or those of a list of points.
    pub size: Option<At<ScanSizeFile>>,
    /// How points without a measurement are filled: "none" (they are refused), or "harmonic", the smoothest surface through the heights
    /// around each hole (Laplace's equation). Default: "none".
    pub fill: Option<At<Fill>>,
    /// The part of the scan that is kept: from and to along x and along y [length], counted from its first corner; of a line scan one
    /// pair. Default: all of it.
    pub cut: Option<At<Vec<[f64; 2]>>>,
    /// Waves shorter than this are taken off by a Gaussian filter, which passes half of a wave of this length [length] (ISO 16610-61).
    /// Default: all are kept.
    #[range(WAVELENGTH)]
    pub short_cutoff: Option<At<f64>>,
    /// Waves longer than this are taken off: what a Gaussian filter of this length [length] passes is subtracted. Default: all are kept.
    #[range(WAVELENGTH)]
    pub long_cutoff: Option<At<f64>>,
    /// How measured points become heights of the cells: "none" (one point for every cell), or "linear", the mean over each cell of the
    /// surface that is linear between the points; the grid lies in the middle of the scan. Default: "none".
    pub resample: Option<At<Resample>>,
}

/// Side lengths of a scan.
#[derive(Debug, Clone, Copy, Table, JsonSchema)]
#[expected("two side lengths [x, y], or one of a line scan")]
#[schemars(untagged, rename = "ScanSizeSchema", description = "")]
pub enum ScanSizeFile {
    Sides([f64; 2]),
    Line(f64),
}

/// How holes are filled.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Table, JsonSchema)]
#[schemars(rename_all = "lowercase", description = "")]
pub enum Fill {
    None,
    Harmonic,
}

/// How points become cells.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Table, JsonSchema)]
#[schemars(rename_all = "lowercase", description = "")]
pub enum Resample {
    None,
    Linear,
}

impl TreatmentFile {
    /// Whether anything is to be done or said beyond the heights themselves.
    pub fn is_asked(&self) -> bool {
        self.channel.is_some()
            || self.size.is_some()
            || self.fills()
            || self.cut.is_some()
            || self.short_cutoff.is_some()
            || self.long_cutoff.is_some()
            || self.resamples()
    }

    /// Whether holes are filled.
    pub fn fills(&self) -> bool {
        self.fill.as_ref().is_some_and(|fill| fill.value == Fill::Harmonic)
    }

    /// Whether the points need not be the cells.
    pub fn resamples(&self) -> bool {
        self.resample.as_ref().is_some_and(|how| how.value == Resample::Linear)
    }
}
