//! What the iterations of the frictionless problem ask of the bodies: displacements by pressures, and about what removes them.

/// The response of the cells that a problem is about.
pub trait NormalResponse {
    /// Normal displacements [length] of pressures.
    fn displacement(&mut self, pressure: &[f64], displacement: &mut [f64]);
    /// Pressures that would about remove normal displacements [length], before any restriction to a set.
    fn inverse(&mut self, displacement: &[f64], pressure: &mut [f64]);
    /// Influence of a cell on itself [length/pressure].
    fn self_influence(&self) -> f64;
}
