//! Where a line of levels is heading: Richardson's extrapolation (1911) with the order the last three levels show.

/// Bounds on a plausible order where none is known: half the first and twice the second.
const ORDERS: [f64; 2] = [0.5, 4.0];

/// Relative steps below this are rounding: the values have no limit but themselves.
const ROUNDING: f64 = 1e-12;

/// Where values are heading.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Heading {
    /// A single value: nowhere that is known.
    Alone,
    /// To a limit that lies so far beyond the last value; the order is the one that three values show.
    Limit(f64),
    /// Nowhere that two values show; the whole change from one to the other lies beyond the last, as far as is known.
    TwoLevels(f64),
    /// The last three values do not approach a limit from one side with an order within the bounds.
    NotAsymptotic,
}

/// Where `values` at resolutions `counts` (both from coarse to fine) are heading. Of three values the order has to lie between half and
/// twice the `known` one, or else between the bounds on any order. Two show none: the whole change counts, which is more than what is missing
/// wherever the order and the ratio of the counts are such that changes at least halve. What changes by less than `noise` has arrived.
pub fn heading(counts: &[f64], values: &[f64], known: Option<f64>, noise: f64) -> Heading {
    let n = counts.len().min(values.len());
    if n < 2 || counts[n - 1] <= counts[n - 2] {
        return Heading::Alone;
    }
    let changes =
        |from: usize| (values[from + 1] - values[from]).abs() > noise.max(ROUNDING * values[n - 1].abs());
    let step = values[n - 1] - values[n - 2];
    let ratio = counts[n - 1] / counts[n - 2];
    let beyond = |order: f64| step / (ratio.powf(order) - 1.0);
    let step = if step.abs() <= ROUNDING * values[n - 1].abs() { 0.0 } else { step };
    if n == 2 {
        return Heading::TwoLevels(step);
    }
    if step == 0.0 {
        return Heading::Limit(0.0);
    }
    let within = known.map_or(ORDERS, |known| [0.5 * known, 2.0 * known]);
    match shown_order(&counts[n - 3..n], &values[n - 3..n], within) {
        Some(order) => Heading::Limit(beyond(order)),
        None if !(changes(n - 3) || changes(n - 2)) => Heading::Limit(0.0),
        None => Heading::NotAsymptotic,
    }
}

/// The order `p` three values show: differences as those of `n^-p`; none when the values do not approach a limit from one side, or with an
/// order that is not within the bounds.
fn shown_order(counts: &[f64], values: &[f64], [least, most]: [f64; 2]) -> Option<f64> {
    let (before, last) = (values[1] - values[0], values[2] - values[1]);
    let ratios = [counts[1] / counts[0], counts[2] / counts[1]];
    if last == 0.0 || before * last <= 0.0 || ratios.iter().any(|ratio| *ratio <= 1.0) {
        return None;
    }
    // ascends with the order
    let of_order = |order: f64| (ratios[0].powf(order) - 1.0) / (1.0 - ratios[1].powf(-order));
    let shrinks = before / last;
    if shrinks < of_order(least) * (1.0 - ROUNDING) || shrinks > of_order(most) * (1.0 + ROUNDING) {
        return None;
    }
    let (mut low, mut high) = (least, most);
    for _ in 0..50 {
        let middle = low.midpoint(high);
        if of_order(middle) < shrinks { low = middle } else { high = middle }
    }
    Some(high)
}

#[cfg(test)]
mod tests {
    use super::{Heading, heading};

    fn limit(counts: &[f64], values: &[f64], known: Option<f64>) -> f64 {
        let last = values.last().copied().unwrap();
        match heading(counts, values, known, 0.0) {
            Heading::Limit(missing) => last + missing,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn the_limit_of_a_pure_power_is_exact() {
        let orders = [0.5_f64, 1.0, 1.5, 2.0];
        let studies = [[8.0_f64, 16.0, 32.0], [32.0, 64.0, 96.0], [32.0, 48.0, 64.0], [16.0, 32.0, 128.0]];
        for (order, counts) in orders.iter().flat_map(|order| studies.map(|counts| (*order, counts))) {
            let values = counts.map(|n| 3.0 + 5.0 * n.powf(-order));
            let found = limit(&counts, &values, None);
            assert!((found - 3.0).abs() < 1e-12, "{order}: {found}");
        }
    }

    #[test]
    fn what_does_not_shrink_has_no_limit() {
        let counts = [8.0, 16.0, 32.0];
        for values in [[1.0, 2.0, 1.5], [1.0, 2.0, 4.0]] {
            assert_eq!(heading(&counts, &values, None, 0.0), Heading::NotAsymptotic);
        }
        assert_eq!(heading(&counts[..1], &[1.0], Some(2.0), 0.0), Heading::Alone);
        // two equal values show no limit either: the next may be another one
        assert_eq!(heading(&counts[..2], &[1.0, 1.0 + 1e-15], None, 0.0), Heading::TwoLevels(0.0));
        assert_eq!(heading(&counts, &[1.0, 1.0, 1.0 + 1e-15], None, 0.0), Heading::Limit(0.0));
        // changes as small as the solver leaves them are no sign of an order
        assert_eq!(heading(&counts, &[1.0, 1.0 + 2e-9, 1.0 + 1e-9], None, 1e-8), Heading::Limit(0.0));
        // pressure below the edge of a punch grows as the root of the number of cells, at the tip of a cone as its logarithm
        let edge = counts.map(f64::sqrt);
        let tip = counts.map(f64::ln);
        for values in [edge, tip] {
            for known in [Some(2.0), None] {
                assert_eq!(heading(&counts, &values, known, 1e-8), Heading::NotAsymptotic);
            }
        }
    }

    /// Of an order of two that is known, one and four are still plausible; 0.4, 0.9 and 5 are not, nor is 5 of one that is not known. Two
    /// values show no order.
    #[test]
    fn an_order_far_from_the_known_one_is_not_extrapolated() {
        let counts = [8.0, 16.0, 32.0];
        let of = |order: f64, known: Option<f64>| {
            heading(&counts, &counts.map(|n: f64| 3.0 - n.powf(-order)), known, 1e-8)
        };
        for order in [1.0, 2.0, 3.9] {
            assert!(matches!(of(order, Some(2.0)), Heading::Limit(_)), "{order}");
        }
        for order in [0.4, 0.9, 4.4] {
            assert_eq!(of(order, Some(2.0)), Heading::NotAsymptotic, "{order}");
        }
        assert!(matches!(of(0.6, None), Heading::Limit(_)));
        assert_eq!(of(4.4, None), Heading::NotAsymptotic);
    }

    /// The error of the finer of two levels is at most the whole change, where changes at least halve.
    #[test]
    fn two_levels_show_no_order_and_their_whole_change_covers_the_error() {
        for order in [1.0_f64, 1.5, 2.0, 4.0] {
            let counts = [16.0_f64, 32.0];
            let values = counts.map(|n| 3.0 - 5.0 * n.powf(-order));
            for known in [None, Some(order)] {
                let found = heading(&counts, &values, known, 0.0);
                let Heading::TwoLevels(missing) = found else { panic!("{found:?}") };
                assert_eq!(missing, values[1] - values[0]);
                assert!(3.0 - values[1] <= missing * (1.0 + 1e-12), "{order}");
            }
        }
    }
}
