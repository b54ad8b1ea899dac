//! Directions of a Krylov method for pressure and both shears at once: generalised conjugate residuals.

use super::components::Components;
use crate::model::each_cell::{CellRule, Number, Reals, each_cell};

/// One direction with its image under the frozen equations.
#[derive(Debug, Default)]
pub struct Direction<N> {
    /// Tractions.
    pub along: Components<N, 3>,
    /// Their image, orthogonal to the images of the directions before.
    pub image: Components<N, 3>,
    /// Squared norm of the image.
    square: f64,
}

/// Directions whose images are orthogonal to each other; their memory is used again after a restart.
#[derive(Debug, Default)]
pub struct Directions<N> {
    all: Vec<Direction<N>>,
    used: usize,
}

impl<N: Number> Directions<N> {
    /// Forgets all directions.
    pub fn restart(&mut self) {
        self.used = 0;
    }

    /// A new direction of `len` cells, to be filled.
    pub fn open(&mut self, len: usize) -> &mut Direction<N> {
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
    pub fn descend(&mut self, residual: &mut Components<N, 3>, step: &mut Components<N, 3>) -> Option<f64> {
        let (before, newest) = self.all[..self.used].split_at_mut(self.used - 1);
        let Direction { along, image, square } = newest.first_mut()?;
        for group in before.chunks(4) {
            if let [a, b, c, d] = group {
                let [one, two, three, four] = [a, b, c, d].map(|other| other.image.values());
                let products = each_cell(&FourProducts, [image.values(), one, two, three, four], []);
                let squares = [a, b, c, d].map(|other| other.square);
                let rule = WithoutFour(std::array::from_fn(|other| products[other] / squares[other]));
                each_cell(&rule, [one, two, three, four], [image.values_mut()]);
                each_cell(&rule, [a, b, c, d].map(|other| other.along.values()), [along.values_mut()]);
            } else {
                for other in group {
                    let share = image.dot(&other.image) / other.square;
                    image.add_scaled(-share, &other.image);
                    along.add_scaled(-share, &other.along);
                }
            }
        }
        let [own, product] = each_cell(&OwnAndProduct, [image.values(), residual.values()], []);
        *square = own;
        if !(own > 0.0 && own.is_finite()) {
            return None;
        }
        let share = product / own;
        step.add_scaled(share, along);
        let [left] = each_cell(&AddScaledSquare(-share), [image.values()], [residual.values_mut()]);
        Some(left.sqrt())
    }
}

struct FourProducts;

impl CellRule<5, 0, 4> for FourProducts {
    #[inline(always)]
    fn at<R: Reals>(&self, [v, a, b, c, d]: [R; 5], _: &mut [R; 0]) -> [R; 4] {
        [v * a, v * b, v * c, v * d]
    }
}

struct WithoutFour([f64; 4]);

impl CellRule<4, 1, 0> for WithoutFour {
    #[inline(always)]
    fn at<R: Reals>(&self, [a, b, c, d]: [R; 4], [v]: &mut [R; 1]) -> [R; 0] {
        let shares = self.0;
        *v = *v - (a * shares[0] + b * shares[1]) - (c * shares[2] + d * shares[3]);
        []
    }
}

struct OwnAndProduct;

impl CellRule<2, 0, 2> for OwnAndProduct {
    #[inline(always)]
    fn at<R: Reals>(&self, [a, b]: [R; 2], _: &mut [R; 0]) -> [R; 2] {
        [a * a, a * b]
    }
}

struct AddScaledSquare(f64);

impl CellRule<1, 1, 1> for AddScaledSquare {
    #[inline(always)]
    fn at<R: Reals>(&self, [x]: [R; 1], [y]: &mut [R; 1]) -> [R; 1] {
        *y = *y + x * self.0;
        [*y * *y]
    }
}
