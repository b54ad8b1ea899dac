//! The edge of contact between the cells: area from the zero line of one level function.
//! Near an edge both `p^2` inside and `gap^(2/3)` outside are linear in the distance to it.

use ndarray::ArrayView2;

/// The zero line lies this share of a cell inside the true edge (measured on Hertz contacts, confirmed on coated ones).
const OFFSET: f64 = 0.024;

/// Contact area in units of one cell, from pressure and gap on a grid (or a box of it). Good to about 0.05 cells along the
/// perimeter for smooth contacts; a contact without an edge inside the grid is counted by cells.
/// Where the gap is wider than `beyond`, a body has ended, at the border of the cell.
pub fn contact_cells(pressure: &ArrayView2<'_, f64>, gap: &ArrayView2<'_, f64>, beyond: f64) -> f64 {
    let (nx, ny) = pressure.dim();
    let ended = |i: usize, j: usize| gap[[i, j]] > beyond;
    let inside = |i: usize, j: usize| pressure[[i, j]] > 0.0;
    let counted = pressure.iter().filter(|p| **p > 0.0).count() as f64;
    let square = |i: usize, j: usize| pressure[[i, j]].powi(2);
    let outer = |i: usize, j: usize| gap[[i, j]].max(0.0).powf(2.0 / 3.0);
    let mut rises = Vec::new();
    let mut falls = Vec::new();
    let mut crossing = |cells: [[usize; 2]; 4]| {
        let [a, b, c, d] = cells.map(|[i, j]| (i, j));
        let open = |cell: (usize, usize)| !inside(cell.0, cell.1) && !ended(cell.0, cell.1);
        if inside(a.0, a.1) && inside(b.0, b.1) && open(c) && open(d) {
            rises.push((square(a.0, a.1) - square(b.0, b.1)).abs());
            falls.push((outer(d.0, d.1) - outer(c.0, c.1)).abs());
        }
    };
    for i in 0..nx {
        for j in 0..ny {
            if i + 3 < nx {
                crossing([[i, j], [i + 1, j], [i + 2, j], [i + 3, j]]);
                crossing([[i + 3, j], [i + 2, j], [i + 1, j], [i, j]]);
            }
            if j + 3 < ny {
                crossing([[i, j], [i, j + 1], [i, j + 2], [i, j + 3]]);
                crossing([[i, j + 3], [i, j + 2], [i, j + 1], [i, j]]);
            }
        }
    }
    let (Some(rise), Some(fall)) = (median(&mut rises), median(&mut falls)) else { return counted };
    if !(rise > 0.0 && fall > 0.0) {
        return counted;
    }
    let kappa = rise / fall;
    let at = |i: usize, j: usize| if inside(i, j) { square(i, j) } else { -kappa * outer(i, j) };
    // Beyond the end of a body the level function goes on as at the cell `here`: it has no edge of its own there.
    let level = |i: isize, j: isize, here: (usize, usize)| {
        let i = i.clamp(0, nx as isize - 1) as usize;
        let j = j.clamp(0, ny as isize - 1) as usize;
        if ended(i, j) { at(here.0, here.1) } else { at(i, j) }
    };
    let mut area = 0.0;
    for i in 0..nx as isize {
        for j in 0..ny as isize {
            let here = (i as usize, j as usize);
            if ended(here.0, here.1) {
                continue;
            }
            let near: Vec<f64> = (-1..=1)
                .flat_map(|a| (-1..=1).map(move |b| (a, b)))
                .map(|(a, b)| level(i + a, j + b, here))
                .collect();
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
