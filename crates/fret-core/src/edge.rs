//! The edge of contact between the cells: area from the zero line of one level function.
//! Near an edge both `p^2` inside and `gap^(2/3)` outside are linear in the distance to it.

use ndarray::{Array2, ArrayView2, Axis, Slice};

/// The zero line lies this share of a cell inside the true edge (measured on Hertz contacts, confirmed on coated ones).
const OFFSET: f64 = 0.024;

/// How far from the contact the level function is computed [cells].
const NEAR: usize = 2;

/// One function for both sides of the edge: `p^2` where there is pressure, `-kappa gap^(2/3)` outside; kappa makes the median
/// slopes of both along grid lines across the edge equal. Farther out than two cells it is just negative. `None` when no grid
/// line crosses an edge. Cells with a gap wider than `beyond`, where a body has ended, tell nothing about the edge.
pub fn level_function(
    pressure: &ArrayView2<'_, f64>,
    gap: &ArrayView2<'_, f64>,
    beyond: f64,
) -> Option<Array2<f64>> {
    let (nx, ny) = pressure.dim();
    let inside = |i: usize, j: usize| pressure[[i, j]] > 0.0;
    let near = spread(&pressure.mapv(|p| p > 0.0));
    let mut level = Array2::zeros((nx, ny));
    for ((i, j), value) in level.indexed_iter_mut() {
        *value = if inside(i, j) {
            pressure[[i, j]].powi(2)
        } else if near[[i, j]] && gap[[i, j]] <= beyond {
            -libm::cbrt(gap[[i, j]].max(0.0).powi(2))
        } else {
            f64::NEG_INFINITY
        };
    }
    let mut rises = Vec::new();
    let mut falls = Vec::new();
    let mut crossing = |cells: [[usize; 2]; 4]| {
        let [a, b, c, d] = cells;
        let open = |cell: [usize; 2]| level[cell] <= 0.0 && level[cell] > f64::NEG_INFINITY;
        if level[a] > 0.0 && level[b] > 0.0 && open(c) && open(d) {
            rises.push((level[a] - level[b]).abs());
            falls.push((level[d] - level[c]).abs());
        }
    };
    for i in 0..nx {
        for j in 0..ny {
            if !inside(i, j) {
                continue;
            }
            if i + 3 < nx {
                crossing([[i, j], [i + 1, j], [i + 2, j], [i + 3, j]]);
            }
            if i >= 3 {
                crossing([[i, j], [i - 1, j], [i - 2, j], [i - 3, j]]);
            }
            if j + 3 < ny {
                crossing([[i, j], [i, j + 1], [i, j + 2], [i, j + 3]]);
            }
            if j >= 3 {
                crossing([[i, j], [i, j - 1], [i, j - 2], [i, j - 3]]);
            }
        }
    }
    let (rise, fall) = (median(&mut rises)?, median(&mut falls)?);
    if !(rise > 0.0 && fall > 0.0) {
        return None;
    }
    let kappa = rise / fall;
    let mut lowest = 0.0_f64;
    for value in &mut level {
        if *value <= 0.0 && *value > f64::NEG_INFINITY {
            *value *= kappa;
            lowest = lowest.min(*value);
        }
    }
    level.mapv_inplace(|value| value.max(lowest));
    Some(level)
}

/// Cells with a marked one at most [`NEAR`] away along both axes.
fn spread(marked: &Array2<bool>) -> Array2<bool> {
    let mut result = marked.clone();
    for axis in 0..2 {
        let before = result.clone();
        let len = before.len_of(Axis(axis));
        for distance in 1..=NEAR.min(len.saturating_sub(1)) {
            let (far, near) = (len - distance, distance as isize);
            let low = before.slice_axis(Axis(axis), Slice::from(..far as isize));
            let high = before.slice_axis(Axis(axis), Slice::from(near..));
            result
                .slice_axis_mut(Axis(axis), Slice::from(near..))
                .zip_mut_with(&low, |to, from| *to |= *from);
            result
                .slice_axis_mut(Axis(axis), Slice::from(..far as isize))
                .zip_mut_with(&high, |to, from| *to |= *from);
        }
    }
    result
}

/// Contact area in units of one cell, from pressure and gap on a grid (or a box of it). Good to about 0.05 cells along the
/// perimeter for smooth contacts; a contact without an edge inside the grid is counted by cells.
/// Where the gap is wider than `beyond`, a body has ended, at the border of the cell.
pub fn contact_cells(pressure: &ArrayView2<'_, f64>, gap: &ArrayView2<'_, f64>, beyond: f64) -> f64 {
    let (nx, ny) = pressure.dim();
    let Some(level) = level_function(pressure, gap, beyond) else {
        return pressure.iter().filter(|p| **p > 0.0).count() as f64;
    };
    let mut area = 0.0;
    for i in 0..nx {
        let rows = [i.saturating_sub(1), i, (i + 1).min(nx - 1)];
        for j in 0..ny {
            if gap[[i, j]] > beyond {
                continue;
            }
            let columns = [j.saturating_sub(1), j, (j + 1).min(ny - 1)];
            let mut near = [0.0; 9];
            for (place, value) in near.iter_mut().enumerate() {
                let at = [rows[place / 3], columns[place % 3]];
                // Beyond the end of a body the level function goes on as here: it has no edge of its own there.
                *value = if gap[at] > beyond { level[[i, j]] } else { level[at] };
            }
            if near.iter().all(|value| *value > 0.0) {
                area += 1.0;
            } else if near.iter().any(|value| *value > 0.0) {
                area += filled(&near);
            }
        }
    }
    area
}

/// Filled share of a cell from the level function at it and its eight neighbours: bilinear on quarter cells.
fn filled(near: &[f64]) -> f64 {
    const PARTS: usize = 4;
    let at = |x: f64, y: f64| {
        // x, y in cells from the middle of the cell, -0.5..0.5
        let (i, j) = (usize::from(x >= 0.0), usize::from(y >= 0.0));
        let (u, v) = (x + 1.0 - i as f64, y + 1.0 - j as f64);
        let value = |a: usize, b: usize| near[(i + a) * 3 + j + b];
        let h = (1.0 - u) * ((1.0 - v) * value(0, 0) + v * value(0, 1))
            + u * ((1.0 - v) * value(1, 0) + v * value(1, 1));
        let slope_x = (1.0 - v) * (value(1, 0) - value(0, 0)) + v * (value(1, 1) - value(0, 1));
        let slope_y = (1.0 - u) * (value(0, 1) - value(0, 0)) + u * (value(1, 1) - value(1, 0));
        (h, slope_x.hypot(slope_y))
    };
    let mut share = 0.0;
    for a in 0..PARTS {
        for b in 0..PARTS {
            let centre = |k: usize| (k as f64 + 0.5) / PARTS as f64 - 0.5;
            let (h, slope) = at(centre(a), centre(b));
            let part = if slope > 0.0 {
                let distance = h / slope + OFFSET;
                (0.5 + distance * PARTS as f64).clamp(0.0, 1.0)
            } else {
                f64::from(h > 0.0)
            };
            share += part;
        }
    }
    share / (PARTS * PARTS) as f64
}

fn median(values: &mut [f64]) -> Option<f64> {
    if values.is_empty() {
        return None;
    }
    let middle = values.len() / 2;
    Some(*values.select_nth_unstable_by(middle, f64::total_cmp).1)
}
