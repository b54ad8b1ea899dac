//! Where a line of levels is heading: Richardson's extrapolation (1911) with the order the last three levels show.

/// Bounds on a plausible order.
const ORDERS: [f64; 2] = [0.5, 4.0];

/// Relative steps below this are rounding: the values have no limit but themselves.
const ROUNDING: f64 = 1e-12;

/// What is still missing from the last of `values` at resolutions `counts` (both from coarse to fine): `limit - last`. The order
/// is that of the last three when they shrink from one side; else the `known` one. Of two values an unknown order is taken to be
/// the first. `None` where there is no order, nor a second value: the limit is unknown.
pub fn still_missing(counts: &[f64], values: &[f64], known: Option<f64>) -> Option<f64> {
    let n = counts.len().min(values.len());
    if n < 2 {
        return None;
    }
    let step = values[n - 1] - values[n - 2];
    let ratio = counts[n - 1] / counts[n - 2];
    if step.abs() <= ROUNDING * values[n - 1].abs() {
        return Some(0.0);
    }
    let order = if n == 2 {
        known.or(Some(1.0))
    } else {
        shown_order(&counts[n - 3..n], &values[n - 3..n]).or(known)
    };
    order.filter(|_| ratio > 1.0).map(|order| step / (ratio.powf(order) - 1.0))
}

/// The order `p` three values show: differences as those of `n^-p`; none when the values do not approach a limit from one side, or too slowly.
fn shown_order(counts: &[f64], values: &[f64]) -> Option<f64> {
    let (before, last) = (values[1] - values[0], values[2] - values[1]);
    let ratios = [counts[1] / counts[0], counts[2] / counts[1]];
    if last == 0.0 || before * last <= 0.0 || ratios.iter().any(|ratio| *ratio <= 1.0) {
        return None;
    }
    // ascends with the order
    let of_order = |order: f64| (ratios[0].powf(order) - 1.0) / (1.0 - ratios[1].powf(-order));
    let (mut low, mut high) = (ORDERS[0], ORDERS[1]);
    if before / last < of_order(low) * (1.0 - ROUNDING) {
        return None;
    }
    for _ in 0..50 {
        let middle = low.midpoint(high);
        if of_order(middle) < before / last { low = middle } else { high = middle }
    }
    Some(high)
}

#[cfg(test)]
mod tests {
    use super::still_missing;

    #[test]
    fn the_limit_of_a_pure_power_is_exact() {
        let orders = [0.5_f64, 1.0, 1.5, 2.0];
        let studies = [[8.0_f64, 16.0, 32.0], [32.0, 64.0, 96.0], [32.0, 48.0, 64.0], [16.0, 32.0, 128.0]];
        for (order, counts) in orders.iter().flat_map(|order| studies.map(|counts| (*order, counts))) {
            let values = counts.map(|n| 3.0 + 5.0 * n.powf(-order));
            let limit = values[2] + still_missing(&counts, &values, None).unwrap();
            assert!((limit - 3.0).abs() < 1e-12, "{order}: {limit}");
            let two = values[2] + still_missing(&counts[1..], &values[1..], Some(order)).unwrap();
            assert!((two - 3.0).abs() < 1e-12, "{order}: {two}");
        }
    }

    #[test]
    fn what_does_not_shrink_has_no_limit() {
        let counts = [8.0, 16.0, 32.0];
        for values in [[1.0, 2.0, 1.5], [1.0, 2.0, 4.0]] {
            assert_eq!(still_missing(&counts, &values, None), None);
        }
        assert_eq!(still_missing(&counts[..1], &[1.0], Some(2.0)), None);
        assert_eq!(still_missing(&counts, &[1.0, 2.0, 2.75], Some(2.0)), Some(0.25)); // they show 0.4: taken as scatter
        assert_eq!(still_missing(&counts, &[1.0, 1.0, 1.0 + 1e-15], None), Some(0.0));
    }
}
