//! Sums over the cells within a few cells of each of a set: the same coefficients for all cells, or for all of one parity.

use pulp::Arch;

use crate::fields::{in_portions, norm, unit_of};
use crate::solver::contact_set::ContactSet;

/// Cells that it reaches.
pub const REACH: usize = 7;
/// Neighbours along a row.
const SIDE: usize = 2 * REACH + 1;
/// Coefficients along a row, the last of them zero: one register, or a few.
const WIDTH: usize = SIDE + 1;

/// Coefficients of neighbours, rows of columns from the lowest.
type Coefficients = [[f32; WIDTH]; SIDE];

/// Weighted sums over near cells, in single precision.
pub struct NearSums {
    /// By the parity of a cell's row and column: all four, or one for all cells; in units of `unit`.
    coefficients: Vec<Coefficients>,
    unit: f64,
    /// The numbers of the cells on the region, with a border that is in no set; 0 elsewhere.
    field: Vec<f32>,
    /// Columns of that field.
    columns: usize,
    /// Whether the region repeats.
    periodic: bool,
    /// Where the cells of the set are in it, and which coefficients are theirs.
    places: Vec<(u32, u8)>,
    /// Where cells of the set are again, on the border of a region that repeats: place, and number in the set.
    images: Vec<(u32, u32)>,
}

impl NearSums {
    /// On a region of `shape`: the number of a neighbour, at `offset` from `-REACH` to `REACH` along both axes, counts `weight(parity, offset)` in the
    /// sum of a cell whose row and column have this parity; `by_parity`: whether that matters.
    pub fn new(
        (shape, periodic): ([usize; 2], bool),
        by_parity: bool,
        weight: impl Fn([usize; 2], [isize; 2]) -> f64,
    ) -> Self {
        let [rows, columns] = shape;
        let unit = unit_of(weight([0; 2], [0; 2]).abs());
        let of = |parity: [usize; 2]| -> Coefficients {
            let offset = |index: usize| index as isize - REACH as isize;
            std::array::from_fn(|row| {
                std::array::from_fn(|column| {
                    if column == SIDE {
                        return 0.0;
                    }
                    (weight(parity, [offset(row), offset(column)]) / unit) as f32
                })
            })
        };
        let parities: &[[usize; 2]] = if by_parity { &[[0, 0], [0, 1], [1, 0], [1, 1]] } else { &[[0, 0]] };
        let columns = columns + WIDTH;
        Self {
            coefficients: parities.iter().map(|parity| of(*parity)).collect(),
            unit,
            field: vec![0.0; (rows + 2 * REACH) * columns + WIDTH],
            columns,
            periodic,
            places: Vec::new(),
            images: Vec::new(),
        }
    }

    /// Makes ready for a set of cells.
    pub fn begin(&mut self, cells: &ContactSet) {
        for (place, _) in self.places.drain(..) {
            self.field[place as usize] = 0.0;
        }
        for (place, _) in self.images.drain(..) {
            self.field[place as usize] = 0.0;
        }
        let columns = self.columns - WIDTH;
        let rows = self.field.len() / self.columns - 2 * REACH;
        let place = |row: usize, column: usize| (row * self.columns + column) as u32;
        let by_parity = self.coefficients.len() > 1;
        for (number, cell) in cells.cells().enumerate() {
            let [row, column] = [cell / columns, cell % columns];
            let class = if by_parity { (2 * (row % 2) + column % 2) as u8 } else { 0 };
            self.places.push((place(row + REACH, column + REACH), class));
            if !self.periodic {
                continue;
            }
            let [in_rows, in_columns] = [images(row, rows), images(column, columns)];
            for (i, j) in in_rows.flat_map(|i| in_columns.clone().map(move |j| (i, j))) {
                if (i, j) != (row + REACH, column + REACH) {
                    self.images.push((place(i, j), number as u32));
                }
            }
        }
    }

    /// The sums of packed numbers.
    pub fn apply(&mut self, from: &[f64], to: &mut [f64]) {
        let Self { coefficients, unit, field, columns, places, images, .. } = self;
        let size = unit_of(norm(from));
        let (inverse, unit) = (1.0 / size, *unit * size);
        for ((place, _), from) in places.iter().zip(from) {
            field[*place as usize] = (from * inverse) as f32;
        }
        for (place, number) in &*images {
            field[*place as usize] = field[places[*number as usize].0 as usize];
        }
        let (field, places, columns) = (&*field, &*places, *columns);
        in_portions((places.len(), SIDE * SIDE), [to], &|cells, [to]| {
            Arch::new().dispatch(
                #[inline(always)]
                || {
                    for (to, (place, class)) in to.iter_mut().zip(&places[cells]) {
                        let first = *place as usize - REACH * (columns + 1);
                        let mut sums = [0.0_f32; WIDTH];
                        for (row, coefficients) in coefficients[usize::from(*class)].iter().enumerate() {
                            let near = &field[first + row * columns..][..WIDTH];
                            for (sum, (a, b)) in sums.iter_mut().zip(coefficients.iter().zip(near)) {
                                *sum += a * b;
                            }
                        }
                        *to = unit * f64::from(sums.iter().sum::<f32>());
                    }
                },
            );
        });
    }
}

/// Where an index of so many that repeat lies on a line with a border on both sides: there, and on the border if it is near.
fn images(index: usize, count: usize) -> impl Iterator<Item = usize> + Clone {
    [index.checked_sub(count - REACH), Some(index + REACH), (index < REACH).then_some(index + REACH + count)]
        .into_iter()
        .flatten()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Beside sums over all pairs of cells, at the border of the region, too, which repeats or does not.
    #[test]
    fn sums_are_those_over_all_pairs_within_reach() {
        [false, true].into_iter().for_each(sums_beside_all_pairs);
    }

    fn sums_beside_all_pairs(periodic: bool) {
        let shape = [16, 20];
        let weight = |parity: [usize; 2], [row, column]: [isize; 2]| {
            2.0 / (1.0 + (row * row + 2 * column * column) as f64) + 0.1 * (parity[0] + 2 * parity[1]) as f64
        };
        let cells = ContactSet::of(320, |cell| cell % 5 < 2 || cell > 310);
        let from: Vec<f64> = (0..cells.len()).map(|place| ((3 * place) as f64).sin()).collect();
        let mut found = vec![9.0; from.len()];
        let mut sums = NearSums::new((shape, periodic), true, weight);
        for others in [&ContactSet::of(320, |cell| cell % 3 == 0), &cells] {
            // Nothing is left of the first set.
            sums.begin(others);
            sums.apply(&vec![1.0; others.len()], &mut vec![0.0; others.len()]);
        }
        sums.apply(&from, &mut found);
        let at = |cell: usize| [(cell / 20) as isize, (cell % 20) as isize];
        for (cell, found) in cells.cells().zip(&found) {
            let here = at(cell);
            let exact: f64 = cells
                .cells()
                .zip(&from)
                .map(|(other, number)| {
                    let offset = [0, 1].map(|axis| {
                        let (apart, count) = (at(other)[axis] - here[axis], shape[axis] as isize);
                        if periodic { (apart + count / 2).rem_euclid(count) - count / 2 } else { apart }
                    });
                    let is_near = offset.iter().all(|along| along.unsigned_abs() <= REACH);
                    let parity = here.map(|index| (index % 2) as usize);
                    if is_near { weight(parity, offset) * number } else { 0.0 }
                })
                .sum();
            assert!((found - exact).abs() < 1e-5, "{cell}: {found} {exact}"); // single precision, 100 numbers
        }
    }
}
