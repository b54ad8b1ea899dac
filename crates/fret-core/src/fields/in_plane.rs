//! Fields that move in their plane with a body: turned about a pole, and carried.
//!
//! A turn is three shears (Paeth 1986, Graphics Interface '86, 77), each of which carries whole lanes: what [`carried`] keeps, it keeps. Neither axis
//! comes first: half of it is made by shears along x, y and x, half along y, x and y. Quarter turns of a square grid and half turns of any only put
//! values elsewhere, to the bit.

use std::f64::consts::FRAC_PI_2;

use ndarray::{Array2, ArrayView2, Axis, s};

use super::moved::{Outside, carried, carry, leaves};

/// A turn by less is none [rad].
const NONE: f64 = 1e-12;

/// A motion of the content of a field in its plane: first the turn, then the way.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InPlane {
    /// Angle from x to y [rad].
    pub turned: f64,
    /// The pole of the turn, in cells along each axis from the middle of the grid.
    pub pole: [f64; 2],
    /// The way along each axis, in cells.
    pub by: [f64; 2],
    /// Side of a cell along y over that along x.
    pub aspect: f64,
}

impl InPlane {
    /// Whether nothing moves.
    pub fn is_none(&self) -> bool {
        self.by == [0.0; 2] && !self.turns()
    }

    /// Whether it turns.
    pub fn turns(&self) -> bool {
        self.turned.abs() > NONE
    }

    /// Where a point goes, in cells from the middle of the grid.
    pub fn of_point(&self, point: [f64; 2]) -> [f64; 2] {
        let (sine, cosine) = self.turned.sin_cos();
        let [x, y] = [point[0] - self.pole[0], (point[1] - self.pole[1]) * self.aspect];
        [
            self.pole[0] + self.by[0] + cosine * x - sine * y,
            self.pole[1] + self.by[1] + (sine * x + cosine * y) / self.aspect,
        ]
    }

    /// A field so moved. Where nothing turns this is [`carried`].
    pub fn of(&self, field: &Array2<f64>, outside: Outside) -> Array2<f64> {
        if !self.turns() {
            return carried(field, self.by, outside);
        }
        let (nx, ny) = field.dim();
        let of_all = if nx == ny && self.aspect == 1.0 { 1.0 } else { 2.0 };
        let quarters = of_all * (self.turned / (of_all * FRAC_PI_2)).round();
        let rest = self.turned - quarters * FRAC_PI_2;
        let (field, pole) = quarter_turned(field, self.pole, quarters.rem_euclid(4.0) as usize);
        // From where the pole has come to in the quarter turns.
        let way = [0, 1].map(|axis| self.pole[axis] - pole[axis] + self.by[axis]);
        if rest.abs() > NONE {
            let turn = Turn { turned: rest, pole, way, aspect: self.aspect };
            0.5 * (turn.sheared(&field.view(), outside) + turn.exchanged().sheared(&field.t(), outside).t())
        } else {
            carried(&field, way, outside)
        }
    }

    /// Two components of vectors so moved, each turned, too.
    pub fn of_vectors(&self, field: [&Array2<f64>; 2], outside: Outside) -> [Array2<f64>; 2] {
        let [x, y] = field.map(|part| self.of(part, outside));
        if !self.turns() {
            return [x, y];
        }
        let (sine, cosine) = self.turned.sin_cos();
        [&x * cosine - &y * sine, &x * sine + &y * cosine]
    }

    /// How far what is not zero in a field goes at the most, in cells along an axis.
    pub fn farthest(&self, field: &Array2<f64>) -> f64 {
        let (nx, ny) = field.dim();
        let half = [nx, ny].map(|count| (count as f64 - 1.0) / 2.0);
        let way = |(i, j): (usize, usize)| {
            let [x, y] = [i as f64 - half[0], j as f64 - half[1]];
            let [to_x, to_y] = self.of_point([x, y]);
            (to_x - x).abs().max((to_y - y).abs())
        };
        let somewhere = field.indexed_iter().filter(|(_, value)| **value != 0.0);
        somewhere.map(|(cell, _)| way(cell)).fold(0.0, f64::max)
    }

    /// Whether what is not zero in a field would come beyond its edge; where it turns, or within two cells of it.
    pub fn leaves(&self, field: &Array2<f64>) -> bool {
        if !self.turns() {
            return leaves(field, self.by);
        }
        let (nx, ny) = field.dim();
        let half = [nx, ny].map(|count| (count as f64 - 1.0) / 2.0);
        field.indexed_iter().any(|((i, j), value)| {
            let [x, y] = self.of_point([i as f64 - half[0], j as f64 - half[1]]);
            *value != 0.0 && (x.abs() > half[0] - 2.0 || y.abs() > half[1] - 2.0)
        })
    }
}

/// A turn by at most a right angle about a pole, and a way along each axis, in cells.
#[derive(Clone, Copy)]
struct Turn {
    turned: f64,
    pole: [f64; 2],
    way: [f64; 2],
    aspect: f64,
}

impl Turn {
    /// The same with x and y exchanged.
    fn exchanged(&self) -> Self {
        let swapped = |[x, y]: [f64; 2]| [y, x];
        let (pole, way) = (swapped(self.pole), swapped(self.way));
        Self { turned: -self.turned, pole, way, aspect: 1.0 / self.aspect }
    }

    /// A field so moved, by shears along x, y and x.
    fn sheared(&self, field: &ArrayView2<'_, f64>, outside: Outside) -> Array2<f64> {
        let Self { turned, pole, way, aspect } = *self;
        let (nx, ny) = field.dim();
        let middle = [nx, ny].map(|count| (count as f64 - 1.0) / 2.0);
        let along_x = -(0.5 * turned).tan() * aspect;
        let along_y = turned.sin() / aspect;
        // Along x the first shear may carry beyond the grid what comes back with the last one.
        let beyond = (along_x.abs() * (middle[1] + pole[1].abs() + 1.0)).ceil() as usize + 1;
        let mut wide = widened(field, beyond, outside);
        for (j, mut lane) in wide.lanes_mut(Axis(0)).into_iter().enumerate() {
            carry(&mut lane, along_x * (j as f64 - middle[1] - pole[1]), outside);
        }
        for (i, mut lane) in wide.lanes_mut(Axis(1)).into_iter().enumerate() {
            let x = i as f64 - beyond as f64 - middle[0];
            carry(&mut lane, along_y * (x - pole[0]) + way[1], outside);
        }
        for (j, mut lane) in wide.lanes_mut(Axis(0)).into_iter().enumerate() {
            carry(&mut lane, along_x * (j as f64 - middle[1] - way[1] - pole[1]) + way[0], outside);
        }
        wide.slice(s![beyond..beyond + nx, ..]).to_owned()
    }
}

/// A field turned by quarters about the middle of its grid, and a pole that goes along.
fn quarter_turned(field: &Array2<f64>, pole: [f64; 2], quarters: usize) -> (Array2<f64>, [f64; 2]) {
    let mut turned = field.view();
    let mut pole = pole;
    for _ in 0..quarters {
        // What lies at (x, y) comes to (-y, x).
        turned = turned.reversed_axes();
        turned.invert_axis(Axis(0));
        pole = [-pole[1], pole[0]];
    }
    (turned.as_standard_layout().into_owned(), pole)
}

/// A field with so many cells more on either side along x.
fn widened(field: &ArrayView2<'_, f64>, by: usize, outside: Outside) -> Array2<f64> {
    let (nx, ny) = field.dim();
    Array2::from_shape_fn((nx + 2 * by, ny), |(i, j)| {
        let inside = (by..by + nx).contains(&i);
        match outside {
            Outside::Zero if !inside => 0.0,
            Outside::Repeats => field[[(i + nx * by - by) % nx, j]],
            _ => field[[i.saturating_sub(by).min(nx - 1), j]],
        }
    })
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    fn motion(turned: f64, pole: [f64; 2], by: [f64; 2], aspect: f64) -> InPlane {
        InPlane { turned, pole, by, aspect }
    }

    /// A hill at a place, in cells from the middle; `aspect` of the cells.
    fn hill(cells: [usize; 2], at: [f64; 2], aspect: f64) -> Array2<f64> {
        Array2::from_shape_fn(cells, |(i, j)| {
            let x = i as f64 - (cells[0] as f64 - 1.0) / 2.0 - at[0];
            let y = (j as f64 - (cells[1] as f64 - 1.0) / 2.0 - at[1]) * aspect;
            (-(x * x + y * y) / 50.0).exp()
        })
    }

    #[test]
    fn right_angles_put_values_elsewhere_to_the_bit() {
        let field = Array2::from_shape_fn((7, 7), |(i, j)| (1.0 + i as f64).sqrt() + j as f64 / 3.0);
        let turned = motion(FRAC_PI_2, [0.0; 2], [0.0; 2], 1.0).of(&field, Outside::Zero);
        for ((i, j), value) in field.indexed_iter() {
            // x = i - 3, y = j - 3 comes to -y, x
            assert_eq!(turned[[6 - j, i]], *value);
        }
        let oblong = Array2::from_shape_fn((6, 3), |(i, j)| (i * 3 + j) as f64);
        let turned = motion(-PI, [0.0; 2], [0.0; 2], 0.3).of(&oblong, Outside::Zero);
        assert_eq!(turned, oblong.slice(s![..;-1, ..;-1]));
        // About another pole by a quarter there and back; what comes from outside is nothing.
        let there = motion(FRAC_PI_2, [1.0, -1.0], [0.0; 2], 1.0);
        let back = motion(-FRAC_PI_2, [1.0, -1.0], [0.0; 2], 1.0);
        let both = back.of(&there.of(&field, Outside::Zero), Outside::Zero);
        assert!(both.iter().zip(&field).all(|(one, other)| *one == 0.0 || one == other));
        assert!(both.iter().filter(|value| **value > 0.0).count() > 20);
    }

    /// A hill goes where its top goes, and nothing of it is lost: with the first moments that is a motion of the plane.
    #[test]
    fn a_hill_goes_where_its_top_goes() {
        for (cells, aspect) in [([96, 96], 1.0), ([90, 70], 1.4)] {
            for (turned, pole, by) in [
                (0.3, [0.0; 2], [0.0; 2]),
                (-0.7, [4.0, 3.0], [1.4, -2.2]),
                (1.4, [-3.0, 2.0], [0.0, 1.0]),
                (2.6, [2.0, 2.0], [-3.3, 0.5]),
                (1e-3, [0.0; 2], [0.0; 2]),
            ] {
                let motion = motion(turned, pole, by, aspect);
                let at = [11.0, 6.0];
                let field = hill(cells, at, aspect);
                let found = motion.of(&field, Outside::Zero);
                let expected = hill(cells, motion.of_point(at), aspect);
                let off = (&found - &expected).iter().fold(0.0_f64, |most, off| most.max(off.abs()));
                println!("{cells:?} {turned} {pole:?}: off by {off:.1e}");
                // second order on a hill of 10 cells, the limiter at its top aside
                assert!(off < 0.02, "{off}");
                // what of the hill lies beyond the edges
                assert!((found.sum() / field.sum() - 1.0).abs() < 1e-6, "{}", found.sum() / field.sum());
                assert!(found.iter().all(|value| *value >= -1e-12));
                // Neither axis comes first.
                let swapped = |[x, y]: [f64; 2]| [y, x];
                let other =
                    InPlane { turned: -turned, pole: swapped(pole), by: swapped(by), aspect: 1.0 / aspect };
                let exchanged = other.of(&field.t().as_standard_layout().to_owned(), Outside::Zero);
                assert!((found - exchanged.t()).iter().all(|off| off.abs() < 1e-13));
            }
        }
    }

    /// Vectors turn with the place that they are at.
    #[test]
    fn vectors_turn_along() {
        let x = hill([64, 64], [5.0, 0.0], 1.0);
        let none = Array2::zeros((64, 64));
        let [to_x, to_y] = motion(FRAC_PI_2, [0.0; 2], [0.0; 2], 1.0).of_vectors([&x, &none], Outside::Zero);
        assert!(to_x.iter().all(|value| value.abs() < 1e-15));
        let expected = hill([64, 64], [0.0, 5.0], 1.0);
        assert!((to_y - expected).iter().all(|off| off.abs() < 1e-15));
    }
}
