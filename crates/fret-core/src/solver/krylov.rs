//! Directions of a Krylov method for pressure and both shears at once: generalised conjugate residuals.

use pulp::Simd;

use crate::model::each_cell::{CellRule, Reals, each_cell};
use crate::model::field::{add_scaled, dot};

/// Pressure and both components of shear, or the displacements against them, packed one after the other.
#[derive(Debug, Clone, Default)]
pub struct Triple {
    values: Vec<f64>,
    len: usize,
}

impl Triple {
    /// Makes room for `len` cells; what it held is lost.
    pub fn reset(&mut self, len: usize) {
        self.len = len;
        self.values.resize(3 * len, 0.0);
    }

    /// All zero, for `len` cells.
    pub fn clear(&mut self, len: usize) {
        self.reset(len);
        self.values.fill(0.0);
    }

    /// Normal part and both tangential parts.
    pub fn parts(&self) -> [&[f64]; 3] {
        let (normal, rest) = self.values.split_at(self.len);
        let (x, y) = rest.split_at(self.len);
        [normal, x, y]
    }

    /// Normal part and both tangential parts.
    pub fn parts_mut(&mut self) -> [&mut [f64]; 3] {
        let (normal, rest) = self.values.split_at_mut(self.len);
        let (x, y) = rest.split_at_mut(self.len);
        [normal, x, y]
    }

    /// Inner product.
    pub fn dot(&self, other: &Self) -> f64 {
        dot(&self.values, &other.values)
    }

    /// Euclidean norm.
    pub fn norm(&self) -> f64 {
        self.dot(self).sqrt()
    }
}

/// One direction with its image under the frozen equations.
#[derive(Debug, Default)]
pub struct Direction {
    /// Tractions.
    pub along: Triple,
    /// Their image, orthogonal to the images of the directions before.
    pub image: Triple,
    /// Squared norm of the image.
    square: f64,
}

/// Directions whose images are orthogonal to each other; their memory is used again after a restart.
#[derive(Debug, Default)]
pub struct Directions {
    all: Vec<Direction>,
    used: usize,
}

impl Directions {
    /// Forgets all directions.
    pub fn restart(&mut self) {
        self.used = 0;
    }

    /// A new direction of `len` cells, to be filled.
    pub fn open(&mut self, len: usize) -> &mut Direction {
        if self.used == self.all.len() {
            self.all.push(Direction::default());
        }
        self.used += 1;
        let newest = &mut self.all[self.used - 1];
        newest.along.reset(len);
        newest.image.reset(len);
        newest
    }

    /// Makes the newest image orthogonal to the others; takes its part off `residual` and adds the direction to `step`.
    /// Returns the norm of the residual, `None` when nothing of the image is left.
    pub fn descend(&mut self, residual: &mut Triple, step: &mut Triple) -> Option<f64> {
        let (before, newest) = self.all[..self.used].split_at_mut(self.used - 1);
        let Direction { along, image, square } = newest.first_mut()?;
        for group in before.chunks(4) {
            let image = &mut image.values;
            let along = &mut along.values;
            if let [a, b, c, d] = group {
                let [da, db, dc, dd] = each_cell(
                    &FourProducts,
                    [image, &a.image.values, &b.image.values, &c.image.values, &d.image.values],
                    [],
                );
                let shares = [da / a.square, db / b.square, dc / c.square, dd / d.square];
                let rule = WithoutFour(shares);
                let images = [a, b, c, d].map(|other| &other.image.values[..]);
                each_cell(&rule, images, [image]);
                let alongs = [a, b, c, d].map(|other| &other.along.values[..]);
                each_cell(&rule, alongs, [along]);
            } else {
                for other in group {
                    let share = dot(image, &other.image.values) / other.square;
                    add_scaled(image, -share, &other.image.values);
                    add_scaled(along, -share, &other.along.values);
                }
            }
        }
        let [own, product] = each_cell(&OwnAndProduct, [&image.values, &residual.values], []);
        *square = own;
        if !(own > 0.0 && own.is_finite()) {
            return None;
        }
        let share = product / own;
        add_scaled(&mut step.values, share, &along.values);
        let [left] = each_cell(&AddScaledSquare(-share), [&image.values], [&mut residual.values]);
        Some(left.sqrt())
    }
}

struct FourProducts;

impl CellRule<5, 0, 4> for FourProducts {
    #[inline(always)]
    fn at<S: Simd>(&self, [v, a, b, c, d]: [Reals<S>; 5], _: &mut [Reals<S>; 0]) -> [Reals<S>; 4] {
        [v * a, v * b, v * c, v * d]
    }
}

struct WithoutFour([f64; 4]);

impl CellRule<4, 1, 0> for WithoutFour {
    #[inline(always)]
    fn at<S: Simd>(&self, [a, b, c, d]: [Reals<S>; 4], [v]: &mut [Reals<S>; 1]) -> [Reals<S>; 0] {
        let shares = self.0;
        *v = *v - (a * shares[0] + b * shares[1]) - (c * shares[2] + d * shares[3]);
        []
    }
}

struct OwnAndProduct;

impl CellRule<2, 0, 2> for OwnAndProduct {
    #[inline(always)]
    fn at<S: Simd>(&self, [a, b]: [Reals<S>; 2], _: &mut [Reals<S>; 0]) -> [Reals<S>; 2] {
        [a * a, a * b]
    }
}

struct AddScaledSquare(f64);

impl CellRule<1, 1, 1> for AddScaledSquare {
    #[inline(always)]
    fn at<S: Simd>(&self, [x]: [Reals<S>; 1], [y]: &mut [Reals<S>; 1]) -> [Reals<S>; 1] {
        *y = *y + x * self.0;
        [*y * *y]
    }
}
