//! The edge of contact between the cells: area from the zero line of one level function.
//! Near the edge of a contact of half-spaces both `p^2` inside and `gap^(2/3)` outside are linear in the distance to it; on layers much
//! thinner than a cell, which answer like a foundation of springs, `p` and `gap` are.

use std::array::from_fn;

use ndarray::{Array2, ArrayView1, ArrayView2};

use super::ends::Ends;

/// The zero line of half-spaces lies this share of a cell inside the true edge (measured on Hertz contacts, confirmed on coated ones).
const OFFSET: f64 = 0.024;

/// A pressure that would reach zero only so many cells beyond its last one, in the median of the edges, though the next cell is open,
/// ends in a step: of half-spaces it gets there within one cell, in contacts of three cells' radius within 1.7. So it is where wear
/// has worn the pressure even, or down to the rim of what sticks.
const STEP: f64 = 2.0;

/// A pressure that falls from one cell to the next leaves less than this fraction: the rest is what a solution may be off.
const FALLS: f64 = 1.0 - 1e-6;

/// How pressure rises from the edge.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Rise {
    /// Power of the pressure that is linear in the distance: 2 of half-spaces, 1 of foundations.
    power: f64,
    /// How many times as steep the level is between the first two open cells as between the last two loaded ones.
    steeper: f64,
}

impl Rise {
    const ROOT: Self = Self { power: 2.0, steeper: 1.0 };

    /// Read off the pressure: the power with which three loaded cells in a row at the edge lie on a line, in the median of all edges
    /// along grid lines. Between a foundation and a half-space: a layer about as thin as a cell.
    ///
    /// Under a round body the power of the pressure is linear in the square of the distance from the middle of a grid line's loaded cells,
    /// so that it bends along the line, and goes on more steeply outside: by a seventh from cell to cell where six cells are in the radius.
    /// Half-spaces are told from layers without that, since there the bend only makes them more certain.
    fn of(pressure: &ArrayView2<'_, f64>, ends: [Ends; 2]) -> Self {
        let mut edges: Vec<EdgeOfLine> = Vec::new();
        for (lines, ends) in [(pressure.t(), ends[0]), (pressure.view(), ends[1])] {
            lines.rows().into_iter().for_each(|line| edges_of(&line, ends, &mut edges));
        }
        let mut bends = Vec::with_capacity(edges.len());
        let mut bend = |power: f64, of: fn(&EdgeOfLine, f64) -> f64| {
            bends.clear();
            bends.extend(edges.iter().map(|edge| of(edge, power)));
            median(&mut bends).unwrap_or(0.0)
        };
        let (mut low, mut high) = (1.0, Self::ROOT.power);
        if bend(high, EdgeOfLine::bend) <= 0.0 {
            return Self::ROOT;
        }
        for _ in 0..20 {
            let middle = 0.5 * (low + high);
            if bend(middle, EdgeOfLine::bend_over_squares) > 0.0 {
                high = middle;
            } else {
                low = middle;
            }
        }
        let power = 0.5 * (low + high);
        let mut across: Vec<f64> = edges.iter().filter_map(|edge| edge.across).collect();
        let steeper = median(&mut across).map_or(1.0, |cells| (cells + 2.0) / (cells - 2.0));
        // that of half-spaces is in their offset
        Self { power, steeper: libm::pow(steeper, Self::ROOT.power - power) }
    }

    /// The level of a pressure.
    fn inside(self, pressure: f64) -> f64 {
        if self == Self::ROOT { pressure.powi(2) } else { libm::pow(pressure, self.power) }
    }

    /// The size of the level of a gap: its power is 2/3 of half-spaces and 1 of foundations, and between them in between.
    fn outside(self, gap: f64) -> f64 {
        if self == Self::ROOT {
            libm::cbrt(gap.powi(2))
        } else {
            libm::pow(gap, 1.0 - (self.power - 1.0) / 3.0)
        }
    }

    /// By how much the zero line lies inside the true edge [cells]: of half-spaces as measured; of foundations since between the centres
    /// of cells a parabola over a circle of radius `a` is above what is linear between them, in the mean over both axes by `1/(6 a)` of its
    /// slope, where grid lines have `sqrt(3) a` loaded cells in the median.
    fn offset(self) -> f64 {
        let of_a_line = 0.5 * (self.steeper - 1.0) / (self.steeper + 1.0);
        OFFSET * (self.power - 1.0) + 3.0_f64.sqrt() / 6.0 * of_a_line
    }
}

/// An edge of contact along a grid line.
#[derive(Debug, Clone, Copy)]
struct EdgeOfLine {
    /// Pressures of the last two loaded cells over that of the one before.
    pressures: [f64; 2],
    /// How many cells in a row are loaded, where they are more than four and have open ones on both sides.
    across: Option<f64>,
}

impl EdgeOfLine {
    /// Bend of a power of the pressure from cell to cell, over its rise: positive where the power is too high.
    fn bend(&self, power: f64) -> f64 {
        let [b, c] = self.pressures.map(|pressure| libm::pow(pressure, power));
        (1.0 - 2.0 * b + c) / (1.0 - c)
    }

    /// The same over the square of the distance from the middle of the loaded cells, where that is known.
    fn bend_over_squares(&self, power: f64) -> f64 {
        let Some(loaded) = self.across else { return self.bend(power) };
        let [b, c] = self.pressures.map(|pressure| libm::pow(pressure, power));
        ((1.0 - b) / (loaded - 4.0) - (b - c) / (loaded - 2.0)) * (loaded - 3.0) / (1.0 - c)
    }
}

/// Notes the edges of a grid line towards which the pressure of three cells falls.
fn edges_of(line: &ArrayView1<'_, f64>, ends: Ends, edges: &mut Vec<EdgeOfLine>) {
    let cells = line.len();
    // A period is read from an open cell on, so that no contact reaches over its end.
    let repeats = ends == Ends::Period;
    let first = if repeats { line.iter().position(|pressure| *pressure <= 0.0) } else { Some(0) };
    let Some(first) = first else { return };
    let at = |cell: usize| line[if first + cell < cells { first + cell } else { first + cell - cells }];
    let [low, high] = ends.mirrored();
    let mut start = 0;
    while start < cells {
        if at(start) <= 0.0 {
            start += 1;
            continue;
        }
        let end = (start..cells).find(|cell| at(*cell) <= 0.0).unwrap_or(cells);
        let loaded = end - start;
        let (from_first, to_last) = (start == 0, end == cells && !repeats);
        let images = usize::from(from_first && low) + usize::from(to_last && high);
        let whole = loaded * (1 + images);
        let is_known = whole > 4 && (!from_first || low) && (!to_last || high);
        let across = is_known.then_some(whole as f64);
        if loaded >= 3 {
            let mut note = |[a, b, c]: [f64; 3]| {
                // beside a mirror two are equal but for rounding
                if a * FALLS > b && b > c {
                    edges.push(EdgeOfLine { pressures: [b / a, c / a], across });
                }
            };
            if !from_first {
                note([start + 2, start + 1, start].map(at));
            }
            if !to_last {
                note([end - 3, end - 2, end - 1].map(at));
            }
        }
        start = end;
    }
}

/// How far from the contact the level function is computed [cells].
pub const NEAR: usize = 2;

/// One function for both sides of the edge: `p^2` where there is pressure, `-kappa gap^(2/3)` outside; kappa makes the median
/// slopes of both along grid lines across the edge equal (of foundations those of a parabola). Farther out than two cells it is just
/// negative. `None` when no grid line crosses an edge.
pub fn level_function(pressure: &ArrayView2<'_, f64>, gap: &ArrayView2<'_, f64>) -> Option<Array2<f64>> {
    let near = near_the_contact(pressure, [Ends::Open; 2]);
    level_of(Rise::ROOT, (pressure, gap), &near, f64::INFINITY, [Ends::Open; 2]).map(|(level, _)| level)
}

/// The level function of pressures that rise so, and how many cells beyond its last one pressure would reach zero, in the median of
/// the edges. `near`: the cells near the contact. Cells with a gap wider than `beyond`, where a body has ended, tell nothing about the edge.
fn level_of(
    rise: Rise,
    (pressure, gap): (&ArrayView2<'_, f64>, &ArrayView2<'_, f64>),
    near: &[usize],
    beyond: f64,
    ends: [Ends; 2],
) -> Option<(Array2<f64>, f64)> {
    let (nx, ny) = pressure.dim();
    let mut level = vec![f64::NEG_INFINITY; nx * ny];
    for &cell in near {
        let at = [cell / ny, cell % ny];
        if pressure[at] > 0.0 {
            level[cell] = rise.inside(pressure[at]);
        } else if gap[at] <= beyond {
            level[cell] = -rise.outside(gap[at].max(0.0));
        }
    }
    let mut slopes = Slopes::default();
    // Of four in a row across an edge the second one is near the contact.
    for &second in near {
        let (i, j) = (second / ny, second % ny);
        if j >= 1 && j + 2 < ny {
            slopes.read([level[second - 1], level[second], level[second + 1], level[second + 2]]);
        }
        if i >= 1 && i + 2 < nx {
            slopes.read([level[second - ny], level[second], level[second + ny], level[second + 2 * ny]]);
        }
    }
    for four in ends[1].fours(ny) {
        for line in level.chunks_exact(ny) {
            slopes.read(four.map(|j| line[j]));
        }
    }
    for four in ends[0].fours(nx) {
        for j in 0..ny {
            slopes.read(four.map(|i| level[i * ny + j]));
        }
    }
    let reach = slopes.reach()?;
    let kappa = slopes.ratio()? * rise.steeper;
    let mut lowest = 0.0_f64;
    for &cell in near {
        let value = &mut level[cell];
        if *value <= 0.0 && *value > f64::NEG_INFINITY {
            *value *= kappa;
            lowest = lowest.min(*value);
        }
    }
    for value in &mut level {
        *value = value.max(lowest);
    }
    Some((Array2::from_shape_vec((nx, ny), level).ok()?, reach))
}

/// Slopes of both sides of the level function along grid lines across the edge.
#[derive(Default)]
struct Slopes {
    rises: Vec<f64>,
    falls: Vec<f64>,
    /// Size of the level in the open cells.
    depths: Vec<f64>,
    /// Where the level inside would reach zero [cells beyond the last loaded one].
    reaches: Vec<f64>,
}

impl Slopes {
    /// Reads four neighbours of a grid line: two loaded and two open ones tell of an edge, from either side.
    fn read(&mut self, [a, b, c, d]: [f64; 4]) {
        if (a > 0.0) == (d > 0.0) {
            return;
        }
        let [a, b, c, d] = if a > 0.0 { [a, b, c, d] } else { [d, c, b, a] };
        let is_open = |value: f64| value <= 0.0 && value > f64::NEG_INFINITY;
        if b > 0.0 && is_open(c) && is_open(d) {
            self.rises.push((a - b).abs());
            self.falls.push((d - c).abs());
            self.depths.push(c.abs().max(d.abs()));
            self.reaches.push(if a > b { b / (a - b) } else { f64::INFINITY });
        }
    }

    /// Where the level inside would reach zero, in the median of the edges [cells beyond the last loaded one]: nowhere where two open cells
    /// in a row have the same gap but for rounding, as between two contacts that mirror each other, which tells of no edge.
    fn reach(&mut self) -> Option<f64> {
        let reach = median(&mut self.reaches)?;
        let rounding = (1.0 - FALLS) * median(&mut self.depths)?;
        Some(if median(&mut self.falls)? > rounding { reach } else { f64::INFINITY })
    }

    /// Median slope inside over the one outside, where there are any.
    fn ratio(mut self) -> Option<f64> {
        let (rise, fall) = (median(&mut self.rises)?, median(&mut self.falls)?);
        (rise > 0.0 && fall > 0.0).then(|| rise / fall)
    }
}

/// Cells with a loaded one at most [`NEAR`] away along both axes, in their order.
fn near_the_contact(pressure: &ArrayView2<'_, f64>, ends: [Ends; 2]) -> Vec<usize> {
    let columns = pressure.ncols();
    let mut near: Vec<bool> = pressure.iter().map(|p| *p > 0.0).collect();
    let mut before = near.clone();
    spread(&mut near, columns, ends[0], &mut before);
    for line in near.chunks_exact_mut(columns) {
        spread(line, 1, ends[1], &mut before[..columns]);
    }
    let groups = near.chunks(16).enumerate().filter(|(_, group)| group.contains(&true));
    groups
        .flat_map(|(first, group)| (16 * first..).zip(group).filter(|(_, near)| **near).map(|(cell, _)| cell))
        .collect()
}

/// Marks what has a marked neighbour at most [`NEAR`] places of `stride` away. `before`: room for the marks before.
fn spread(marks: &mut [bool], stride: usize, ends: Ends, before: &mut [bool]) {
    before.copy_from_slice(marks);
    for distance in 1..=NEAR {
        let shift = (distance * stride).min(marks.len());
        let rest = marks.len() - shift;
        let mut mark = |to: usize, from: usize, count: usize| {
            for (to, from) in marks[to..to + count].iter_mut().zip(&before[from..from + count]) {
                *to |= *from;
            }
        };
        mark(shift, 0, rest);
        mark(0, shift, rest);
        if ends == Ends::Period {
            mark(0, rest, shift);
            mark(rest, 0, shift);
        }
    }
}

/// Contact area in units of one cell, from pressure and gap on a grid (or a box of it). Good to about 0.05 cells along the
/// perimeter for smooth contacts, of half-spaces and of layers much thinner than a cell alike; a contact without an edge inside the
/// grid, and one whose pressure ends in a step, are counted by cells.
/// Where the gap is wider than `beyond`, a body has ended, at the border of the cell. `ends`: what lies beyond those of both axes.
pub fn contact_cells(
    pressure: &ArrayView2<'_, f64>,
    gap: &ArrayView2<'_, f64>,
    beyond: f64,
    ends: [Ends; 2],
) -> f64 {
    let (nx, ny) = pressure.dim();
    let rise = Rise::of(pressure, ends);
    let near = near_the_contact(pressure, ends);
    let level = match level_of(rise, (pressure, gap), &near, beyond, ends) {
        Some((level, reach)) if reach <= STEP => level,
        _ => return pressure.iter().filter(|p| **p > 0.0).count() as f64,
    };
    let kind = |(level, gap): (&f64, &f64)| match *level > 0.0 {
        _ if *gap > beyond => BEYOND,
        true => LOADED,
        false => OPEN,
    };
    let kinds: Vec<u8> = level.iter().zip(gap).map(kind).collect();
    let line = |i: usize| &kinds[i * ny..][..ny];
    let mut threes = vec![0; ny];
    let mut area = 0.0;
    for row in near.chunk_by(|a, b| a / ny == b / ny) {
        let i = row[0] / ny;
        let rows = ends[0].around(i, nx);
        let [low, here, high] = rows.map(line);
        for (((three, low), here), high) in threes.iter_mut().zip(low).zip(here).zip(high) {
            *three = low | here | high;
        }
        for j in row.iter().map(|cell| cell % ny) {
            let columns = ends[1].around(j, ny);
            match threes[columns[0]] | threes[j] | threes[columns[2]] {
                LOADED => area += 1.0,
                OPEN => {}
                _ if here[j] == BEYOND => {}
                _ => {
                    // Beyond the end of a body the level function goes on as here: it has no edge of its own there.
                    let at = |cell: [usize; 2]| level[if gap[cell] > beyond { [i, j] } else { cell }];
                    area +=
                        filled(&from_fn(|place| at([rows[place / 3], columns[place % 3]])), rise.offset());
                }
            }
        }
    }
    area
}

/// What there is in a cell, as marks of which several may be set among neighbours.
const LOADED: u8 = 1;
const OPEN: u8 = 2;
const BEYOND: u8 = 4;

/// Filled share of a cell from the level function at it and its eight neighbours: bilinear on quarter cells. `offset`: by how much
/// the zero line lies inside the true edge [cells].
fn filled(near: &[f64; 9], offset: f64) -> f64 {
    const PARTS: usize = 4;
    if near.iter().all(|value| *value > 0.0) {
        return 1.0;
    }
    if near.iter().all(|value| *value <= 0.0) {
        return 0.0;
    }
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
                let distance = h / slope + offset;
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

#[cfg(test)]
mod tests;
