//! Measured heights as a file of an instrument has them.

use ndarray::Array2;

/// Heights that were read from a file of an instrument, with the lengths that the file states.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Scan {
    /// Heights `[x, y]`, positive out of the surface, in `unit`; NaN where nothing was measured. A line scan has one point along y.
    pub heights: Array2<f64>,
    /// Side lengths along x and y, as many spacings as points, in `unit`; `None`: the file does not say. That along y of a line scan
    /// has no meaning.
    pub size: Option<[f64; 2]>,
    /// Places of the points of a line scan that are not evenly spaced, growing, in `unit`.
    pub places: Option<Vec<f64>>,
    /// Unit of all its lengths, such as "um"; `None`: the file does not say.
    pub unit: Option<String>,
    /// Who read the file, its format and its channel, in words.
    pub read_by: String,
}

/// Reads heights of an instrument's file, by its name and that of a channel.
pub type ReadScan<'a> = dyn Fn(&str, Option<&str>) -> Result<Scan, String> + 'a;
