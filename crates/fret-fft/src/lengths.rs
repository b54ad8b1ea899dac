//! Transform lengths the fast engine likes.

/// Smallest length `4 * 2^a * 3^b * 5^c` that is at least `n`.
///
/// Grids with such sides lose nothing to padding in a [`Convolution`](super::Convolution), and a
/// [`PeriodicProduct`](super::PeriodicProduct) takes the fast path only for them. Saturates at `usize::MAX` for
/// lengths no memory could hold.
pub fn good_length(n: usize) -> usize {
    let mut best = n.max(4).checked_next_power_of_two().unwrap_or(usize::MAX);
    let mut five = 4_usize;
    while five < best {
        let mut three = five;
        while three < best {
            let doublings = n.div_ceil(three).checked_next_power_of_two();
            if let Some(length) = doublings.and_then(|factor| factor.checked_mul(three)) {
                best = best.min(length);
            }
            three = three.saturating_mul(3);
        }
        five = five.saturating_mul(5);
    }
    best
}

/// Whether [`good_length`] leaves the length as it is.
pub(super) fn is_good_length(n: usize) -> bool {
    n >= 4 && good_length(n) == n
}

#[cfg(test)]
mod tests {
    use super::{good_length, is_good_length};

    fn divides_out(mut n: usize) -> bool {
        if !n.is_multiple_of(4) {
            return false;
        }
        n /= 4;
        for factor in [2, 3, 5] {
            while n.is_multiple_of(factor) {
                n /= factor;
            }
        }
        n == 1
    }

    #[test]
    fn the_next_good_length_is_the_smallest_one_that_divides_out() {
        for n in 0..3000 {
            let expected = (n.max(4)..=4 * n.max(4)).find(|&length| divides_out(length));
            assert_eq!(Some(good_length(n)), expected, "n = {n}");
            assert_eq!(is_good_length(n), n >= 4 && divides_out(n), "n = {n}");
        }
    }

    #[test]
    fn absurd_lengths_do_not_overflow() {
        assert!(good_length(usize::MAX - 3) >= usize::MAX - 3);
    }
}
