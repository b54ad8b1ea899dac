//! Tractions and displacements of a surface.

/// A field of tractions or displacements: normal, along x and y.
pub(super) type Fields = [Vec<f64>; 3];

/// Fields of zeros.
pub(super) fn zeros(cells: usize) -> Fields {
    [(); 3].map(|()| vec![0.0; cells])
}
