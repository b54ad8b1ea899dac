//! Surface stress at the rim of the contact, between the cells: under friction the tension behind a slider has a cusp there, with roots
//! of the distance on both sides, which falls between the centres of cells.

use ndarray::Array2;

use crate::fields::{Scalar, Slopes};

/// Cells at the rim are under one pressure each, which shifts the rim that the next ones point to by so much outwards [cells];
/// measured on Hertz contacts of 18 to 85 cells in the radius, between -0.06 and 0.06 about it.
const OUTWARDS: f64 = 0.08;
/// Distance from the rim below which a centre feels the single cell at the rim [cells].
const NEAREST: f64 = 0.3;
/// A last cell that carries less than this part of the pressure of the one behind it counts as open: the rim lies before its centre, and
/// what the stress under it shows is the far side of the cusp.
const FAINT: f64 = 0.1;

/// A value at a rim of a line of cells.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AtRim {
    /// The last loaded cell.
    pub cell: usize,
    /// Where the rim lies from its centre [cells], along the line.
    pub off: f64,
    /// The value.
    pub value: f64,
}

/// Values at the rims of a line of surface cells, where they rise to a cusp: from outside, as `S - b sqrt(d)` through two centres, or
/// `S - b sqrt(d) + c d` through three where the first one is very near, as far as the line has them: two open cells at least. The rim is where the quadratic through `p^2` of the loaded
/// cells behind the last one vanishes. There is no cusp where the pressure falls linearly, as on thin films.
///
/// Within 2 % on Hertz contacts that slide, from 20 cells in the radius on; first order in the cell, where centres alone have an order
/// of a half.
pub fn at_rims(values: &[f64], pressure: &[f64]) -> Vec<AtRim> {
    at_rims_of(|cell| values[cell], &pressure[..values.len().min(pressure.len())])
}

/// The same with values that are asked for where they are needed.
pub(super) fn at_rims_of(value: impl Fn(usize) -> f64, pressure: &[f64]) -> Vec<AtRim> {
    let n = pressure.len();
    let mut found = Vec::new();
    for (cell, &p) in pressure.iter().enumerate() {
        if p <= 0.0 {
            continue;
        }
        for outwards in [-1_isize, 1] {
            let at =
                |distance: isize| cell.checked_add_signed(outwards * distance).filter(|&place| place < n);
            let is = |distance: isize, loaded: bool| {
                at(distance).is_none_or(|place| (pressure[place] > 0.0) == loaded)
            };
            // the last cell whose pressure tells where the rim is
            let is_faint = |faint: f64, behind: f64| faint < FAINT * behind;
            let is_last = at(1).is_none_or(|next| pressure[next] <= 0.0 || is_faint(pressure[next], p))
                && at(-1).is_none_or(|behind| !is_faint(p, pressure[behind]));
            // two open cells at least; beyond the end of the line all are open
            if at(2).is_none() || at(-3).is_none() {
                continue;
            }
            if !(is_last && (2..=4).all(|k| is(k, false)) && (-3..=-1).all(|k| is(k, true))) {
                continue;
            }
            let inside = [-1, -2, -3].map(|k| at(k).map_or(0.0, |place| pressure[place]));
            let near = [1, 2].map(|k| at(k).map_or(0.0, &value));
            let far = [3, 4].map(|k| at(k).map(&value));
            if let Some((off, value)) = cusp(inside, near, far) {
                found.push(AtRim { cell, off: outwards as f64 * off, value });
            }
        }
    }
    found
}

/// What the value at a rim that was found beside a cell is made of: the rims of four directions, of which one has that value.
pub fn of_rim(
    value: impl Fn([usize; 2]) -> f64,
    pressure: &Array2<f64>,
    (cell, found): ([usize; 2], f64),
) -> Option<RimSlopes> {
    [(0, -1), (0, 1), (1, -1), (1, 1)].into_iter().find_map(|(axis, outwards)| {
        let at = |distance: isize| -> Option<[usize; 2]> {
            let mut place = cell;
            place[axis] = place[axis].checked_add_signed(outwards * distance)?;
            pressure.get(place).map(|_| place)
        };
        let (inside, open) = ([-1, -2, -3].map(at), [1, 2, 3, 4].map(at));
        let or_none = |place: Option<[usize; 2]>, of: &dyn Fn([usize; 2]) -> f64| place.map_or(0.0, of);
        let pressures = inside.map(|place| or_none(place, &|place| pressure[place]));
        let [v1, v2] = [open[0], open[1]].map(|place| or_none(place, &value));
        let [v3, v4] = [open[2], open[3]].map(|place| place.map(&value));
        let [p1, p2, p3, s1, s2, s3, s4] = Slopes::<7>::of_each([
            pressures[0],
            pressures[1],
            pressures[2],
            v1,
            v2,
            v3.unwrap_or(0.0),
            v4.unwrap_or(0.0),
        ]);
        let (_, here) = cusp([p1, p2, p3], [s1, s2], [v3.map(|_| s3), v4.map(|_| s4)])?;
        if here.value != found {
            return None;
        }
        let of = |places: &[Option<[usize; 2]>], by: &[f64]| -> Vec<([usize; 2], f64)> {
            let known = places.iter().zip(by).filter_map(|(place, by)| place.map(|place| (place, *by)));
            known.filter(|(_, by)| *by != 0.0).collect()
        };
        Some(RimSlopes { by_values: of(&open, &here.by[3..]), by_pressures: of(&inside, &here.by[..3]) })
    })
}

/// Derivatives of the value at a rim: by the values and by the pressures of cells.
#[derive(Debug, Clone, PartialEq)]
pub struct RimSlopes {
    /// By values.
    pub by_values: Vec<([usize; 2], f64)>,
    /// By pressures.
    pub by_pressures: Vec<([usize; 2], f64)>,
}

/// Distance of the rim from the centre of the last loaded cell, and the value there; from the pressures of the three cells behind it
/// and the values of the four open ones before it, of which the last two may lie beyond the end of the line.
fn cusp<S: Scalar>([p1, p2, p3]: [S; 3], [v1, v2]: [S; 2], [v3, v4]: [Option<S>; 2]) -> Option<(S, S)> {
    let bend = |a: S, b: S, c: S| {
        let [a, b, c] = [a, b, c].map(S::value);
        ((a - 2.0 * b + c) / (c - a)).abs()
    };
    let squares = [p1, p2, p3].map(|p| p * p);
    let less = |one: S, other: S| one.value() < other.value();
    let rises = less(p1, p2) && less(p2, p3) && less(v2, v1) && v3.is_none_or(|v3| less(v3, v2));
    if !rises || bend(squares[0], squares[1], squares[2]) > bend(p1, p2, p3) {
        return None;
    }
    // p^2 = a - b t + c t^2 over the distance t outwards from the cell behind the last one.
    let [a, second, third] = squares;
    let c = (third - second * 2.0 + a) * 0.5;
    let b = second - a - c;
    let root = (b * b - a * 4.0 * c).sqrt();
    let rim = a * 2.0 / (b + root) - 1.0 - OUTWARDS;
    if rim.value().is_nan() {
        return None;
    }
    let rim = rim.max(S::of(0.0)).min(S::of(1.0));
    let root_at = |cells: f64| (S::of(cells) - rim).sqrt();
    let through_two = |[v, w]: [S; 2], [near, far]: [S; 2]| (v * far - w * near) / (far - near);
    let is_near = 1.0 - rim.value() <= NEAREST;
    let value = match (v3, v4) {
        (Some(v3), Some(v4)) if is_near => {
            // Lagrange's polynomial of second degree in the root, at 0.
            let [r, s, t] = [root_at(2.0), root_at(3.0), root_at(4.0)];
            v2 * s * t / ((r - s) * (r - t))
                + v3 * r * t / ((s - r) * (s - t))
                + v4 * r * s / ((t - r) * (t - s))
        }
        (Some(v3), None) if is_near => through_two([v2, v3], [root_at(2.0), root_at(3.0)]),
        _ => through_two([v1, v2], [root_at(1.0), root_at(2.0)]),
    };
    (value.value() > v1.value()).then_some((rim, value))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A root on either side of a rim that lies anywhere between two centres is met to rounding, but for [`OUTWARDS`].
    #[test]
    fn a_cusp_is_met_wherever_the_rim_falls_between_the_cells() {
        for rim in [0.02_f64, 0.3, 0.5, 0.65, 0.8, 0.95] {
            let radius = 20.0 + rim;
            let pressure: Vec<f64> =
                (0..40).map(|i| (radius.powi(2) - f64::from(i).powi(2)).max(0.0).sqrt()).collect();
            let values: Vec<f64> =
                (0..40).map(|i| 1.0 - 0.1 * (f64::from(i) - radius + OUTWARDS).abs().sqrt()).collect();
            let found = at_rims(&values, &pressure);
            assert_eq!(found.len(), 1);
            assert_eq!(found[0].cell, 20);
            assert!((found[0].off - (rim - OUTWARDS).max(0.0)).abs() < 1e-9, "{rim}: {found:?}");
            // Where the rim would lie before the last centre it is put on it.
            let clamped = if rim < OUTWARDS { 0.02 } else { 1e-9 };
            assert!((found[0].value - 1.0).abs() < clamped, "{rim}: {found:?}");
        }
    }

    #[test]
    fn where_pressure_falls_linearly_there_is_no_cusp() {
        let pressure: Vec<f64> = (0..40).map(|i| (20.4 - f64::from(i)).max(0.0)).collect();
        let values: Vec<f64> = (0..40).map(|i| -f64::from(i)).collect();
        assert!(at_rims(&values, &pressure).is_empty());
    }
}
