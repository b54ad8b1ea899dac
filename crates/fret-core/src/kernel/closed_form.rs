//! Uniform traction on a rectangle of a homogeneous half-space: surface displacements in closed form. The judge of the
//! quadrature over cells; it is not used beyond tests, because its corner differences lose the square of distance over side.

use crate::model::ElasticMaterial;
use std::f64::consts::PI;

/// Displacements caused by unit traction on one cell [length/pressure].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct CellResponse {
    pub zz: f64,
    pub xx: f64,
    pub yy: f64,
    pub xy: f64,
    pub zx: f64,
    pub zy: f64,
}

/// Displacement at `offset` from the centre of a rectangle with the given `sides` under unit traction.
///
/// Source: Love (1929) for pressure; Cerruti's solution integrated, Johnson (1985), *Contact Mechanics*, chapter 3.
pub(super) fn homogeneous_cell(
    material: &ElasticMaterial,
    offset: [f64; 2],
    sides: [f64; 2],
) -> CellResponse {
    let nu = material.poisson();
    let per_modulus = 1.0 / (2.0 * PI * material.shear_modulus());
    let difference = |primitive: fn(f64, f64) -> f64| {
        let x = [offset[0] + 0.5 * sides[0], offset[0] - 0.5 * sides[0]];
        let y = [offset[1] + 0.5 * sides[1], offset[1] - 0.5 * sides[1]];
        primitive(x[0], y[0]) - primitive(x[0], y[1]) - primitive(x[1], y[0]) + primitive(x[1], y[1])
    };
    // X ln(Y + r) up to terms that the difference drops
    let along_x = difference(|x, y| x * libm::asinh(y / x.abs()));
    let along_y = difference(|x, y| y * libm::asinh(x / y.abs()));
    let radius = difference(libm::hypot);
    CellResponse {
        zz: (1.0 - nu) * per_modulus * (along_x + along_y),
        xx: per_modulus * ((1.0 - nu) * along_x + along_y),
        yy: per_modulus * (along_x + (1.0 - nu) * along_y),
        xy: -nu * per_modulus * radius,
        zx: 0.5 * (1.0 - 2.0 * nu) * per_modulus * difference(odd_along_x),
        zy: 0.5 * (1.0 - 2.0 * nu) * per_modulus * difference(|x, y| odd_along_x(y, x)),
    }
}

/// Its mixed derivative is `x/r^2`.
fn odd_along_x(x: f64, y: f64) -> f64 {
    x * libm::atan(y / x) + 0.5 * y * libm::log(x * x + y * y)
}
