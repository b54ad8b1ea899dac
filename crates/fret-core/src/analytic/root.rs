//! The root of an increasing function, by bisection: slow and unable to fail.

/// The point between `lower` and `upper`, both of one sign or zero, where the increasing `f` changes its sign.
pub(super) fn root_of_increasing(lower: f64, upper: f64, f: impl Fn(f64) -> f64) -> f64 {
    let (mut lower, mut upper) = (lower, upper);
    loop {
        let middle = f64::midpoint(lower, upper);
        if middle <= lower || middle >= upper {
            return middle;
        }
        if f(middle) < 0.0 {
            lower = middle;
        } else {
            upper = middle;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::root_of_increasing;

    #[test]
    fn a_root_is_found_to_the_last_bit() {
        assert!((root_of_increasing(0.0, 2.0, |x| x * x - 2.0) - std::f64::consts::SQRT_2).abs() < 3e-16);
        assert!((root_of_increasing(0.0, 1.0, |x| x - 1e-30) - 1e-30).abs() < 1e-45);
    }
}
