//! Fields carried over the grid: by whole cells, where values stay as they are to the bit, and by a part of a cell, where the sum of all
//! values stays.

use ndarray::{Array2, ArrayViewMut1, Axis, s};

/// What lies beyond the edge of a field.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outside {
    /// Nothing.
    Zero,
    /// What is at the edge.
    Edge,
    /// The field again.
    Repeats,
    /// The field again, mirrored at its edges.
    Mirrors,
}

impl Outside {
    /// Which of `count` places has what lies at an index, which may be beyond them; `None`: nothing lies there.
    fn index(self, index: isize, count: usize) -> Option<usize> {
        match self {
            Self::Repeats => Some(index.rem_euclid(count as isize) as usize),
            Self::Mirrors => {
                let there = index.rem_euclid(2 * count as isize) as usize;
                Some(there.min(2 * count - 1 - there))
            }
            Self::Edge => Some(index.clamp(0, count as isize - 1) as usize),
            Self::Zero => usize::try_from(index).ok().filter(|index| *index < count),
        }
    }
}

/// A field whose content is carried along by `cells` towards higher indices, a number for each axis.
///
/// Values are means over cells. Carried by a part of a cell, the content of each cell is a straight line whose slope is limited so that
/// nothing new rises or sinks (van Leer 1977, J. Comput. Phys. 23, 276): exact for a straight line, of second order for a smooth field, and
/// what one cell gives the next one takes, so that the sum stays to rounding where nothing passes the edge. Across, along one axis after the other,
/// in both orders by half, so that neither axis comes first. Carried by whole cells, to the bit.
pub fn carried(field: &Array2<f64>, cells: [f64; 2], outside: Outside) -> Array2<f64> {
    if cells.iter().all(|by| by.fract() == 0.0) {
        return carried_by_whole_cells(field, cells.map(|by| by as isize), (outside, 0.0));
    }
    let along = |axes: &[usize]| {
        let mut moved = field.clone();
        for axis in axes {
            for mut lane in moved.lanes_mut(Axis(*axis)) {
                carry(&mut lane, cells[*axis], outside);
            }
        }
        moved
    };
    match cells.map(|by| by != 0.0) {
        [true, true] => 0.5 * (along(&[0, 1]) + along(&[1, 0])),
        [true, false] => along(&[0]),
        _ => along(&[1]),
    }
}

/// A field of anything carried along by whole `cells`; `nothing` is what lies outside where that is nothing.
pub fn carried_by_whole_cells<A: Copy>(
    field: &Array2<A>,
    cells: [isize; 2],
    (outside, nothing): (Outside, A),
) -> Array2<A> {
    let (nx, ny) = field.dim();
    let from = |count: usize, by: isize| -> Vec<Option<usize>> {
        (0..count as isize).map(|to| outside.index(to - by, count)).collect()
    };
    let (rows, columns) = (from(nx, cells[0]), from(ny, cells[1]));
    // Along y all but what comes over the edge is one piece.
    let first = cells[1].clamp(0, ny as isize) as usize;
    let end = (ny as isize + cells[1]).clamp(first as isize, ny as isize) as usize;
    let from_first = (first as isize - cells[1]).clamp(0, (ny - (end - first)) as isize) as usize;
    let mut moved = Array2::from_elem((nx, ny), nothing);
    for (mut to, row) in moved.rows_mut().into_iter().zip(rows) {
        let Some(row) = row else { continue };
        let from = field.row(row);
        to.slice_mut(s![first..end]).assign(&from.slice(s![from_first..from_first + (end - first)]));
        for j in (0..first).chain(end..ny) {
            if let Some(column) = columns[j] {
                to[j] = from[column];
            }
        }
    }
    moved
}

/// Carries one lane of a field.
pub(super) fn carry(lane: &mut ArrayViewMut1<'_, f64>, by: f64, outside: Outside) {
    let from: Vec<f64> = lane.iter().copied().collect();
    let at = |index: isize| outside.index(index, from.len()).map_or(0.0, |index| from[index]);
    let whole = by.floor();
    let part = by - whole;
    let first = |to: usize| to as isize - whole as isize;
    if part == 0.0 {
        lane.indexed_iter_mut().for_each(|(to, value)| *value = at(first(to)));
        return;
    }
    // What a cell gives to the next one.
    let given = |cell: isize| {
        let [before, here, next] = [at(cell - 1), at(cell), at(cell + 1)];
        part * (here + 0.5 * (1.0 - part) * limited(here - before, next - here))
    };
    let mut taken = given(first(0) - 1);
    for (to, value) in lane.indexed_iter_mut() {
        let gives = given(first(to));
        *value = at(first(to)) + (taken - gives);
        taken = gives;
    }
}

/// The slope of a cell between its differences from the cells before and behind it: their mean, but neither more than twice one of them nor of
/// another sign than both.
fn limited(before: f64, behind: f64) -> f64 {
    if before * behind <= 0.0 {
        return 0.0;
    }
    let steepest = 2.0 * before.abs().min(behind.abs());
    (0.5 * (before + behind)).clamp(-steepest, steepest)
}

/// Whether what is not zero in a field would be carried beyond its edge.
pub(super) fn leaves(field: &Array2<f64>, cells: [f64; 2]) -> bool {
    let extent = field.dim();
    let is_inside = |index: usize, by: f64, count: usize| {
        let [first, last] = [by.floor(), by.ceil()].map(|by| index as f64 + by);
        by == 0.0 || first >= 0.0 && last <= (count - 1) as f64
    };
    field.indexed_iter().any(|((i, j), value)| {
        *value != 0.0 && !(is_inside(i, cells[0], extent.0) && is_inside(j, cells[1], extent.1))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hill(cells: usize, middle: f64) -> Array2<f64> {
        // means of a parabola over cells of length 1, rounding aside
        let integral = |x: f64| {
            let x = x.clamp(-8.0, 8.0);
            64.0 * x - x.powi(3) / 3.0
        };
        Array2::from_shape_fn((cells, 1), |(i, _)| {
            let left = i as f64 - middle;
            integral(left + 1.0) - integral(left)
        })
    }

    #[test]
    fn whole_cells_are_carried_to_the_bit() {
        let field = Array2::from_shape_fn((5, 4), |(i, j)| (1.0 + i as f64).sqrt() + j as f64 / 3.0);
        let moved = carried(&field, [2.0, -1.0], Outside::Zero);
        for ((i, j), value) in moved.indexed_iter() {
            let there = i.checked_sub(2).and_then(|i| field.get((i, j + 1))).copied().unwrap_or(0.0);
            assert_eq!(*value, there);
        }
        assert_eq!(
            carried(&carried(&field, [2.0, -3.0], Outside::Repeats), [-2.0, 3.0], Outside::Repeats),
            field
        );
        assert_eq!(carried(&field, [1.0, 0.0], Outside::Edge).row(0), field.row(0));
    }

    /// Farther than the field is wide, too, and what is no number.
    #[test]
    fn whole_cells_come_from_where_they_were_or_from_outside() {
        let field = Array2::from_shape_fn((4, 3), |(i, j)| 10 * i + j);
        for cells in [[0, 0], [1, -2], [-3, 3], [2, 5], [-7, -9]] {
            for outside in [Outside::Zero, Outside::Edge, Outside::Repeats, Outside::Mirrors] {
                let moved = carried_by_whole_cells(&field, cells, (outside, 99));
                for ((i, j), value) in moved.indexed_iter() {
                    let [x, y] = [i as isize - cells[0], j as isize - cells[1]];
                    let expected = match outside {
                        Outside::Zero if (0..4).contains(&x) && (0..3).contains(&y) => 10 * x + y,
                        Outside::Zero => 99,
                        Outside::Edge => 10 * x.clamp(0, 3) + y.clamp(0, 2),
                        Outside::Repeats => 10 * x.rem_euclid(4) + y.rem_euclid(3),
                        Outside::Mirrors => {
                            // There and back again.
                            let [there, across] = [x.rem_euclid(8) as usize, y.rem_euclid(6) as usize];
                            [0, 10, 20, 30, 30, 20, 10, 0][there] + [0, 1, 2, 2, 1, 0][across]
                        }
                    };
                    assert_eq!(*value as isize, expected, "{cells:?} {outside:?} {i} {j}");
                }
            }
        }
    }

    /// Sum, sign and order of what is carried by a part of a cell.
    #[test]
    fn a_part_of_a_cell_keeps_the_sum() {
        let field = Array2::from_shape_fn((20, 18), |(i, j)| {
            if (4..9).contains(&i) && j > 5 && j < 9 { (i * j) as f64 } else { 0.0 }
        });
        for cells in [[0.37, 0.0], [-3.21, 2.5], [0.01, -0.99]] {
            let moved = carried(&field, cells, Outside::Zero);
            // rounding of the sum of 360 numbers
            assert!((moved.sum() / field.sum() - 1.0).abs() < 1e-14, "{cells:?}");
            assert!(moved.iter().all(|value| *value >= -1e-12));
            assert!(!leaves(&field, cells));
        }
        // Neither axis comes first: exchanged, to the bit.
        let exchanged = carried(&field.t().to_owned(), [0.37, -1.6], Outside::Zero);
        assert_eq!(carried(&field, [-1.6, 0.37], Outside::Zero), exchanged.t());
        assert!(leaves(&field, [-5.0, 0.0]) && leaves(&field, [11.5, 0.0]) && !leaves(&field, [11.0, 0.0]));
    }

    #[test]
    fn straight_lines_are_carried_exactly_and_curves_of_second_order() {
        let line = Array2::from_shape_fn((1, 12), |(_, j)| 3.0 - 0.5 * j as f64);
        let moved = carried(&line, [0.0, 0.3], Outside::Edge);
        for j in 2..11 {
            assert!((moved[[0, j]] - (3.0 - 0.5 * (j as f64 - 0.3))).abs() < 1e-14);
        }
        // A parabola is carried exactly where nothing is limited: the slope of means is its own.
        let moved = carried(&hill(40, 20.0), [0.4, 0.0], Outside::Zero);
        let exact = hill(40, 20.4);
        let off = |i: usize| (moved[[i, 0]] - exact[[i, 0]]).abs();
        // What is left of the curvature, r (1 - r)(1 - 2 r)/12 f'', is that of both cells and cancels: but for rounding of sums of 64.
        assert!(
            (14..19).chain(23..27).all(|i| off(i) < 1e-11),
            "{:?}",
            (14..27).map(off).collect::<Vec<_>>()
        );
    }
}
