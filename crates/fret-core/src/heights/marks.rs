//! Numbers that instruments write where they measured nothing.

use ndarray::Array2;

/// Numbers that stand for a cell without a measurement: ends of whole numbers, and rows of nines.
const MARKS: [f64; 16] = [
    -999.0,
    999.0,
    -9999.0,
    9999.0,
    -99_999.0,
    99_999.0,
    32_767.0,
    -32_767.0,
    -32_768.0,
    65_535.0,
    2_147_483_647.0,
    -2_147_483_648.0,
    2_147_483_640.0,
    4_294_967_295.0,
    1e10,
    -1e10,
];
/// Numbers that no height is, whatever its unit: those of 1e30 and more, of which single precision has the largest, 3.4e38.
const HUGE: f64 = 1e30;

/// The first height that stands for a cell without a measurement: one of the numbers that are in use for it, farther from all the
/// other heights than they are from one another. Its index, and the range of the others.
pub fn hole(heights: &Array2<f64>) -> Option<([usize; 2], f64, [f64; 2])> {
    let is_mark = |value: f64| is_huge(value) || MARKS.contains(&value);
    let marked = heights.indexed_iter().filter(|(_, value)| is_mark(**value));
    let mut asked: Vec<f64> = Vec::new();
    for ((i, j), &mark) in marked {
        if asked.contains(&mark) {
            continue;
        }
        asked.push(mark);
        let others = heights.iter().filter(|value| **value != mark && !(is_huge(**value) && is_huge(mark)));
        let range = others.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], &value| {
            [low.min(value), high.max(value)]
        });
        let away = (range[0] - mark).max(mark - range[1]);
        if range[0] <= range[1] && away > range[1] - range[0] {
            return Some(([i, j], mark, range));
        }
        if asked.len() > MARKS.len() {
            return None;
        }
    }
    None
}

/// The same heights with NaN in place of all numbers that stand for a cell without a measurement.
pub fn without_marks(mut heights: Array2<f64>) -> Array2<f64> {
    while let Some((_, mark, _)) = hole(&heights) {
        heights.mapv_inplace(|height| if height == mark { f64::NAN } else { height });
    }
    heights
}

fn is_huge(value: f64) -> bool {
    value.abs() >= HUGE
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_far_outside_of_the_rest_are_holes() {
        let rough = |mark: f64| {
            let mut heights = Array2::from_shape_fn((6, 5), |(i, j)| ((7 * i + 3 * j) % 11) as f64 - 5.0);
            heights[[4, 2]] = mark;
            hole(&heights).map(|(at, value, _)| (at, value))
        };
        for mark in
            [1e38, -1.70141e38, 3.402_823_466e38, 1e10, -9999.0, 2_147_483_640.0, -32_768.0, -999.0, 1e31]
        {
            assert_eq!(rough(mark), Some(([4, 2], mark)));
        }
        for height in [0.0, -5.0, 1e3, -9998.0, 1e9, 12345.0] {
            assert_eq!(rough(height), None);
        }
    }

    #[test]
    fn marks_among_numbers_like_them_are_heights() {
        let steps = Array2::from_shape_fn((6, 5), |(i, j)| 2000.0 * i as f64 - 9999.0 + j as f64);
        assert_eq!(hole(&steps), None);
        assert_eq!(hole(&Array2::from_elem((4, 4), 9999.0)), None);
        assert_eq!(hole(&Array2::from_shape_fn((4, 4), |(i, j)| 1e300 * (1 + i + j) as f64)), None);
    }
}
