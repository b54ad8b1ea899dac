//! Fields in single precision, brought to a size near one: what approximate inverses and frozen problems work on, which need few
//! digits and whose errors the next look at the exact equations sees.

use pulp::Arch;

/// The power of two nearest below a size; one where there is none.
pub fn unit_of(size: f64) -> f64 {
    if size > 0.0 && size.is_finite() { size.log2().floor().exp2() } else { 1.0 }
}

/// `to = factor * from`, rounded.
pub fn round(from: &[f64], factor: f64, to: &mut [f32]) {
    Arch::new().dispatch(
        #[inline(always)]
        || round_here(from, factor, to),
    );
}

/// `to = factor * from`.
pub fn widen(from: &[f32], factor: f64, to: &mut [f64]) {
    Arch::new().dispatch(
        #[inline(always)]
        || widen_here(from, factor, to),
    );
}

/// [`round`], inside a caller's instruction set.
#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "this is what single precision is")]
pub fn round_here(from: &[f64], factor: f64, to: &mut [f32]) {
    for (to, from) in to.iter_mut().zip(from) {
        *to = (factor * from) as f32;
    }
}

/// [`widen`], inside a caller's instruction set.
#[inline(always)]
pub fn widen_here(from: &[f32], factor: f64, to: &mut [f64]) {
    for (to, from) in to.iter_mut().zip(from) {
        *to = factor * f64::from(*from);
    }
}
