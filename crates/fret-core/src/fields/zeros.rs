//! Fields that are zero: memory of zeros that nobody wrote to costs nothing.

use ndarray::Array2;

/// Whether a field is zero everywhere.
pub fn is_zero(field: &Array2<f64>) -> bool {
    field.iter().all(|value| *value == 0.0)
}

/// A copy that costs no memory while the field is zero.
pub fn copied(field: &Array2<f64>) -> Array2<f64> {
    if is_zero(field) { Array2::zeros(field.dim()) } else { field.clone() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_copy_is_what_it_was_taken_from() {
        let mut field = Array2::zeros((3, 2));
        assert!(is_zero(&field) && copied(&field) == field);
        field[[2, 1]] = -1.0;
        assert!(!is_zero(&field) && copied(&field) == field);
    }
}
