//! What stresses, fatigue and cracks below a surface are told of: the run, what is asked of it, the body, the depths and the surfaces above.

use fret_core::case::StressRequest;
use fret_core::model::HalfSpace;
use fret_core::subsurface::fatigue::LayerConstants;
use fret_core::subsurface::{DepthPoint, LoadedSurface};
use fret_results::Results;

use crate::figures::figure_in;

/// All of it.
#[derive(Clone, Copy)]
pub struct Below<'a> {
    pub run: &'a Results,
    pub request: &'a StressRequest,
    pub half_space: &'a HalfSpace,
    pub constants: &'a LayerConstants,
    pub points: &'a [DepthPoint],
    pub surfaces: &'a [LoadedSurface],
}

impl Below<'_> {
    /// Where a cell lies, moved by parts of cells [length].
    pub fn place(&self, cell: [usize; 2], off: [f64; 2]) -> [f64; 2] {
        let grid = self.run.grid();
        [0, 1].map(|axis| grid.centre(axis, cell[axis]) + off[axis] * grid.spacing()[axis])
    }

    /// A number with its unit, for a person.
    pub fn told(&self, value: f64, kind: &str) -> String {
        figure_in(self.run.units(), value, kind)
    }
}
