//! What an elastic operator is: displacements of the cells of a region by the tractions on them.

use super::product::SharedWorkspace;
use crate::model::Symmetry;
use fret_fft::SingleProduct;

/// Elastic response of a region. Tractions [pressure], displacements [length]; rows of cells, index `i * ny + j`.
pub trait SurfaceCompliance {
    /// Cells `[nx, ny]` of the region.
    fn shape(&self) -> [usize; 2];
    /// Influence of a cell's pressure on its own normal displacement, and of its shear on its own tangential one [length/pressure].
    fn self_influence(&self) -> SelfInfluence;
    /// `u_z` from pressure alone.
    fn normal(&mut self, pressure: &[f64], normal: &mut [f64]);
    /// `(u_x, u_y)` from shear alone.
    fn tangential(&mut self, shear: [&[f64]; 2], tangential: [&mut [f64]; 2]);
    /// All displacements `[normal, along x, along y]` from all tractions `[pressure, along x, along y]`.
    fn full(&mut self, tractions: [&[f64]; 3], displacements: [&mut [f64]; 3]);

    /// [`tangential`](Self::tangential) in single precision, for shear of a size near one; `None` where double precision is operators.
    fn tangential_single(&mut self) -> Option<SinglePrecisionOperator<'_>> {
        None
    }

    /// [`full`](Self::full) in single precision, for tractions of a size near one; `None` where double precision is operators.
    fn full_single(&mut self) -> Option<SinglePrecisionOperator<'_>> {
        None
    }
}

/// An elastic response in single precision.
pub struct SinglePrecisionOperator<'a> {
    pub(super) product: &'a SingleProduct,
    pub(super) workspace: &'a SharedWorkspace,
    pub(super) shear_axis: Option<usize>,
    /// What gives in each cell, of an operator of all tractions [length/pressure].
    pub(super) give: &'a [f64],
    pub(super) applications: &'a mut usize,
}

impl SinglePrecisionOperator<'_> {
    /// What the displacements are to be multiplied with [length/pressure], a power of two.
    pub fn unit(&self) -> f64 {
        self.product.unit()
    }

    /// The displacements, divided by [`unit`](Self::unit), of tractions.
    pub fn apply(&mut self, tractions: &[&[f32]], displacements: &mut [&mut [f32]]) {
        *self.applications += 1;
        along_one(self.shear_axis, tractions, displacements, |from, to| {
            self.workspace.lend(|workspace| self.product.apply(workspace, from, to));
        });
        let unit = self.unit();
        if let ([pressure, ..], [normal, ..]) = (tractions, displacements) {
            for ((normal, give), pressure) in normal.iter_mut().zip(self.give).zip(*pressure) {
                *normal += (give / unit) as f32 * pressure;
            }
        }
    }
}

/// Applies a product of which only one axis of shear takes part when that is so: across it there is no displacement. Components
/// along x and y come last.
pub(super) fn along_one<T: Copy + Default>(
    along: Option<usize>,
    tractions: &[&[T]],
    displacements: &mut [&mut [T]],
    apply: impl FnOnce(&[&[T]], &mut [&mut [T]]),
) {
    let (Some(axis), Some((normal, [x, y]))) = (along, displacements.split_last_chunk_mut()) else {
        return apply(tractions, displacements);
    };
    let (along, across) = if axis == 0 { (x, y) } else { (y, x) };
    across.fill(T::default());
    match normal {
        [] => apply(&[tractions[axis]], &mut [along]),
        [normal, ..] => apply(&[tractions[0], tractions[1 + axis]], &mut [normal, along]),
    }
}

/// Influence of a cell on itself [length/pressure].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SelfInfluence {
    /// Normal.
    pub normal: f64,
    /// Tangential, the smaller of the two directions.
    pub tangential: f64,
}

/// Which operators a solver will ask for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct OperatorSet {
    /// Normal from pressure.
    pub normal: bool,
    /// Tangential from shear.
    pub tangential: bool,
    /// All from all.
    pub full: bool,
    /// Normal from pressure and shear.
    pub normal_from_all: bool,
    /// The one axis (0: x, 1: y) along which shear acts, where it causes no displacement across it.
    pub shear_axis: Option<usize>,
    /// Mirrors of the problem: the region is what lies before them.
    pub symmetry: Symmetry,
    /// Single precision, where a solver can do with it.
    pub single: bool,
}
