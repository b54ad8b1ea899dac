//! GMRES (Saad & Schultz 1986): the combination of Krylov directions whose residual is least. Orthogonalisation by
//! modified Gram-Schmidt; sums in double precision whatever the vectors are.

use std::iter;

use super::super::contact_vector::ContactVector;
use crate::fields::{Number, add_scaled, dot};

/// Memory of the method: it is used again.
#[derive(Debug, Default)]
pub struct Gmres<N> {
    /// The right side, of unit length: the first direction.
    right: ContactVector<N>,
    /// The directions after it.
    basis: Vec<ContactVector<N>>,
}

impl<N: Number> Gmres<N> {
    /// The right side, for the caller to fill with a vector of unit length.
    pub fn right(&mut self) -> &mut ContactVector<N> {
        &mut self.right
    }

    /// Finds `combination` so that `apply(combination)` is near the right side: to `target`, in `most` applications at the most. Tells the amounts of
    /// what was applied to, in its order, and the size of what is left, as the method counts it.
    pub fn solve(
        &mut self,
        mut apply: impl FnMut(&ContactVector<N>, &mut ContactVector<N>),
        (target, most): (f64, usize),
        combination: &mut ContactVector<N>,
    ) -> (Vec<f64>, f64) {
        let Self { right, basis } = self;
        // Columns of the upper triangle, rotations that made it one, and the rotated right side.
        let mut columns: Vec<Vec<f64>> = Vec::new();
        let mut rotations: Vec<[f64; 2]> = Vec::new();
        let mut rotated = vec![1.0];
        while columns.len() < most {
            let used = columns.len();
            basis.resize_with(basis.len().max(used + 1), ContactVector::default);
            let (known, rest) = basis.split_at_mut(used);
            let Some(next) = rest.first_mut() else { break };
            apply(known.last().unwrap_or(right), next);
            let size_before = next.norm();
            let mut column = orthogonalise(next, iter::once(&*right).chain(&*known));
            let size = next.norm();
            for (index, [cosine, sine]) in rotations.iter().enumerate() {
                let [upper, lower] = [column[index], column[index + 1]];
                column[index] = cosine * upper + sine * lower;
                column[index + 1] = cosine * lower - sine * upper;
            }
            let length = column[used].hypot(size);
            if !(length > 0.0 && length.is_finite()) {
                break;
            }
            let [cosine, sine] = [column[used] / length, size / length];
            column[used] = length;
            let left = rotated[used];
            rotated[used] = cosine * left;
            rotated.push(-sine * left);
            rotations.push([cosine, sine]);
            columns.push(column);
            // Nothing new is left of the direction: what is reached is the solution.
            if (sine * left).abs() <= target || size <= 1e-14 * size_before {
                break;
            }
            next.scale(1.0 / size);
        }
        let amounts = back_substituted(&columns, &rotated);
        let mut parts = amounts.iter().zip(iter::once(&*right).chain(&*basis));
        match parts.next() {
            Some((amount, direction)) => combination.convert(direction, *amount),
            None => combination.clear_like(right),
        }
        for (amount, direction) in parts {
            add_scaled(combination.values_mut(), *amount, direction.values());
        }
        let left = rotated.get(amounts.len()).map_or(1.0, |left| left.abs());
        (amounts, left)
    }
}

/// Takes the parts along the known directions off a vector, one after the other; returns them.
fn orthogonalise<'a, N: Number>(
    vector: &mut ContactVector<N>,
    known: impl Iterator<Item = &'a ContactVector<N>>,
) -> Vec<f64> {
    known
        .map(|direction| {
            let part = dot(vector.values(), direction.values());
            add_scaled(vector.values_mut(), -part, direction.values());
            part
        })
        .collect()
}

/// Solves the upper triangle.
fn back_substituted(columns: &[Vec<f64>], right: &[f64]) -> Vec<f64> {
    let mut amounts = vec![0.0; columns.len()];
    for row in (0..columns.len()).rev() {
        let known: f64 = (row + 1..columns.len()).map(|column| columns[column][row] * amounts[column]).sum();
        amounts[row] = (right[row] - known) / columns[row][row];
    }
    amounts
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    /// A solver of this right side.
    fn solver(right: &ContactVector<f64>) -> Gmres<f64> {
        let mut solver = Gmres::default();
        solver.right().clone_from(right);
        solver
    }

    /// A matrix that is neither symmetric nor definite, on 6 unknowns: solved in 6 applications, to rounding; and in fewer as far as is
    /// possible, the residual never growing.
    #[test]
    fn a_small_system_is_solved_in_as_many_steps_as_it_has_unknowns() {
        let matrix = |row: usize, column: usize| {
            ((3 * row + 5 * column * column + row * column) % 7) as f64
                - if row == column { 9.0 } else { 2.0 }
        };
        let product = |from: &[f64]| -> Vec<f64> {
            (0..6).map(|row| (0..6).map(|column| matrix(row, column) * from[column]).sum()).collect()
        };
        let vector = |values: Vec<f64>| {
            let mut vector = ContactVector::default();
            vector.reset(3, 2);
            vector.values_mut().copy_from_slice(&values);
            vector
        };
        let right = vector(vec![0.5, -0.5, 0.5, 0.1, 0.3, 0.4]);
        let size = right.norm();
        let mut unit = ContactVector::default();
        unit.convert(&right, 1.0 / size);
        let mut before = 1.0;
        for most in 1..=6 {
            let mut found = ContactVector::default();
            let apply =
                |from: &ContactVector<f64>, to: &mut ContactVector<f64>| *to = vector(product(from.values()));
            solver(&unit).solve(apply, (0.0, most), &mut found);
            let image = product(found.values());
            let left: f64 = image.iter().zip(unit.values()).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
            assert!(left <= before * (1.0 + 1e-12), "{most}: {left} {before}");
            before = left;
        }
        assert!(before < 1e-13, "{before}");
    }

    /// Twenty-one unknowns of a matrix that is neither symmetric nor definite: the residual of
    /// each number of applications is the least over the Krylov space, found by normal equations on an orthonormal basis that is made
    /// one direction at a time; a target ends the search as soon as it is reached.
    #[test]
    fn every_step_has_the_least_residual_of_its_krylov_space() {
        const N: usize = 21;
        let mut random = Random::seeded(8);
        let matrix: Vec<Vec<f64>> = (0..N)
            .map(|row| {
                let entry = |column: usize| if row == column { 1.5 } else { 0.0 };
                (0..N).map(|column| entry(column) + random.between(-0.3, 0.3)).collect()
            })
            .collect();
        let product = |from: &[f64]| -> Vec<f64> {
            matrix.iter().map(|row| row.iter().zip(from).map(|(a, b)| a * b).sum()).collect()
        };
        let vector = |values: &[f64]| {
            let mut vector = ContactVector::default();
            vector.reset(3, N / 3);
            vector.values_mut().copy_from_slice(values);
            vector
        };
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let mut right: Vec<f64> = (0..N).map(|_| random.between(-1.0, 1.0)).collect();
        let size = dot(&right, &right).sqrt();
        for value in &mut right {
            *value /= size;
        }
        // Images of the Krylov directions, orthonormal: what they have of the right side can be removed.
        let mut images: Vec<Vec<f64>> = Vec::new();
        let mut least = vec![1.0];
        let mut power = right.clone();
        for _ in 0..12 {
            power = product(&power);
            let mut image = power.clone();
            for _ in 0..2 {
                for other in &images {
                    let part = dot(&image, other);
                    image.iter_mut().zip(other).for_each(|(value, other)| *value -= part * other);
                }
            }
            let size = dot(&image, &image).sqrt();
            for value in &mut image {
                *value /= size;
            }
            power.clone_from(&image);
            images.push(image);
            let removed: f64 = images.iter().map(|image| dot(image, &right).powi(2)).sum();
            least.push((1.0 - removed).max(0.0).sqrt());
        }
        let mut solver = solver(&vector(&right));
        let mut solve = |target: f64, most: usize| {
            let (mut found, mut count) = (ContactVector::default(), 0);
            let apply = |from: &ContactVector<f64>, to: &mut ContactVector<f64>| {
                count += 1;
                *to = vector(&product(from.values()));
            };
            solver.solve(apply, (target, most), &mut found);
            let image = product(found.values());
            let left: f64 = image.iter().zip(&right).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
            (left, count)
        };
        for most in 1..=12 {
            let (left, count) = solve(0.0, most);
            assert_eq!(count, most);
            // Krylov powers lose digits: the reference is good to this.
            assert!((left - least[most]).abs() < 1e-9, "{most}: {left} {}", least[most]);
            // A target between two steps is reached by the later one, in no more applications.
            let target = 0.5 * (least[most - 1] + least[most]);
            assert_eq!(solve(target, 100).1, most, "{target}");
        }
    }

    /// Where the right side is an eigenvector one application is the solution, and no more are made.
    #[test]
    fn a_krylov_space_that_is_exhausted_ends_the_search() {
        let mut right = ContactVector::<f64>::default();
        right.reset(2, 3);
        right.values_mut()[4] = 1.0;
        let (mut found, mut count) = (ContactVector::default(), 0);
        let apply = |from: &ContactVector<f64>, to: &mut ContactVector<f64>| {
            count += 1;
            to.clone_from(from);
            to.scale(-4.0);
        };
        solver(&right).solve(apply, (0.0, 10), &mut found);
        assert_eq!((count, found.values()), (1, &[0.0, 0.0, 0.0, 0.0, -0.25, 0.0][..]));
        // What rounding leaves of a direction is nothing new, in any unit: parts that are no powers of two, times a number that is none.
        let parts = [0.1, 0.3, -0.7, 0.9, 0.2, -0.6];
        let size = parts.iter().map(|part| part * part).sum::<f64>().sqrt();
        right.values_mut().iter_mut().zip(parts).for_each(|(value, part)| *value = part / size);
        for unit in [3e-20, 3e20] {
            let mut count = 0;
            let apply = |from: &ContactVector<f64>, to: &mut ContactVector<f64>| {
                count += 1;
                to.clone_from(from);
                to.scale(unit);
            };
            solver(&right).solve(apply, (0.0, 10), &mut found);
            assert_eq!(count, 1, "{unit:e}");
            for (found, part) in found.values().iter().zip(right.values()) {
                assert!((found * unit - part).abs() < 1e-15, "{unit:e}: {found} {part}");
            }
        }
        // An operator that makes nothing of it leaves nothing to combine.
        solver(&right).solve(|from, to| to.clear_like(from), (0.0, 10), &mut found);
        assert_eq!(found.values(), [0.0; 6]);
    }
}
