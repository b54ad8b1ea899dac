//! Points without a measurement, filled by harmonic interpolation.

use ndarray::Array2;

/// Residual at which the interpolation ends, relative to the first: far below what any instrument resolves.
const TOLERANCE: f64 = 1e-12;
/// Steps of the conjugate gradients per point along the sides, at most.
const STEPS_PER_POINT: usize = 20;

/// Puts a height where an array has NaN: the solution of Laplace's equation, so that each is the mean of its four neighbours and none
/// lies beyond the heights around its hole. At the border of the array the slope across it is zero. `weights` are those of
/// neighbours along x and y, the inverse squares of the spacings.
///
/// # Errors
/// In words, where nothing was measured at all, or the equation is not solved.
pub fn fill(heights: &mut Array2<f64>, weights: [f64; 2]) -> Result<(), &'static str> {
    let (nx, ny) = heights.dim();
    let holes: Vec<usize> =
        heights.iter().enumerate().filter(|(_, height)| height.is_nan()).map(|(at, _)| at).collect();
    if holes.is_empty() {
        return Ok(());
    }
    if holes.len() == heights.len() {
        return Err("no point has a measurement");
    }
    let mut number = vec![usize::MAX; heights.len()];
    holes.iter().enumerate().for_each(|(hole, &at)| number[at] = hole);
    // relative to the mean of what was measured, so that rounding is that of the relief
    let measured = heights.iter().filter(|height| !height.is_nan());
    let mean = measured.sum::<f64>() / (heights.len() - holes.len()) as f64;
    let neighbours = |at: usize| {
        let (i, j) = (at / ny, at % ny);
        let along = |is_there: bool, to: usize, axis: usize| is_there.then_some((to, weights[axis]));
        [
            along(i > 0, at.wrapping_sub(ny), 0),
            along(i + 1 < nx, at + ny, 0),
            along(j > 0, at.wrapping_sub(1), 1),
            along(j + 1 < ny, at + 1, 1),
        ]
    };
    let values: Vec<f64> = heights.iter().map(|height| height - mean).collect();
    let mut system = Laplace { links: Vec::with_capacity(holes.len()), diagonal: Vec::new() };
    let mut residual = vec![0.0; holes.len()];
    for (&at, known) in holes.iter().zip(&mut residual) {
        let mut links = [(usize::MAX, 0.0); 4];
        let mut diagonal = 0.0;
        for ((to, weight), link) in neighbours(at).into_iter().flatten().zip(&mut links) {
            diagonal += weight;
            if number[to] == usize::MAX {
                *known += weight * values[to];
            } else {
                *link = (number[to], weight);
            }
        }
        system.links.push(links);
        system.diagonal.push(diagonal);
    }
    let filled = system
        .solved(residual, STEPS_PER_POINT * (nx + ny) + 100)
        .ok_or("the heights of its holes were not found by interpolation")?;
    let whole = heights.as_slice_mut().unwrap_or_default();
    holes.iter().zip(filled).for_each(|(&at, height)| whole[at] = mean + height);
    Ok(())
}

/// Laplace's equation on the holes: symmetric and positive definite, since every region of holes has a measured neighbour.
struct Laplace {
    /// Neighbours that are holes themselves, with their weights.
    links: Vec<[(usize, f64); 4]>,
    diagonal: Vec<f64>,
}

impl Laplace {
    fn product(&self, vector: &[f64], into: &mut [f64]) {
        for (hole, (links, value)) in self.links.iter().zip(into).enumerate() {
            let linked: f64 = links
                .iter()
                .filter(|(to, _)| *to != usize::MAX)
                .map(|&(to, weight)| weight * vector[to])
                .sum();
            *value = self.diagonal[hole] * vector[hole] - linked;
        }
    }

    /// The solution by conjugate gradients, scaled by the diagonal; `None` where they do not come to it.
    fn solved(&self, right: Vec<f64>, most_steps: usize) -> Option<Vec<f64>> {
        let dot = |one: &[f64], other: &[f64]| one.iter().zip(other).map(|(a, b)| a * b).sum::<f64>();
        let scaled = |vector: &[f64]| -> Vec<f64> {
            vector.iter().zip(&self.diagonal).map(|(value, diagonal)| value / diagonal).collect()
        };
        let mut solution = vec![0.0; right.len()];
        let mut residual = right;
        let mut direction = scaled(&residual);
        let mut descent = dot(&residual, &direction);
        let enough = TOLERANCE * TOLERANCE * descent;
        let mut image = vec![0.0; residual.len()];
        for _ in 0..most_steps {
            if descent <= enough {
                return Some(solution);
            }
            self.product(&direction, &mut image);
            let step = descent / dot(&direction, &image);
            for (hole, value) in solution.iter_mut().enumerate() {
                *value += step * direction[hole];
                residual[hole] -= step * image[hole];
            }
            let towards = scaled(&residual);
            let before = std::mem::replace(&mut descent, dot(&residual, &towards));
            direction.iter_mut().zip(&towards).for_each(|(direction, towards)| {
                *direction = towards + descent / before * *direction;
            });
        }
        (descent <= enough).then_some(solution)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// x^2 - y^2 and x y are harmonic on an even grid, too: their second differences cancel to the last term.
    #[test]
    fn holes_in_a_harmonic_surface_are_filled_with_it() {
        let surface = Array2::from_shape_fn((23, 17), |(i, j)| {
            let (x, y) = (i as f64 - 9.0, j as f64 - 8.0);
            3.0 + 0.2 * x - 0.1 * y + 0.01 * (x * x - y * y) + 0.02 * x * y
        });
        let mut holed = surface.clone();
        for (at, height) in holed.indexed_iter_mut() {
            let inside = (1..22).contains(&at.0) && (1..16).contains(&at.1);
            if inside && ((7 * at.0 + 5 * at.1) % 4 == 0 || (8..14).contains(&at.0)) {
                *height = f64::NAN;
            }
        }
        let holes = holed.iter().filter(|height| height.is_nan()).count();
        assert!(holes > 100);
        assert_eq!(fill(&mut holed, [1.0; 2]), Ok(()));
        // the tolerance of the gradients times the condition of a hole of fifteen points across
        assert!((&holed - &surface).iter().all(|error| error.abs() < 1e-9));
    }

    /// Between two known ends a line of holes is straight; beyond the last it stays level. With spacings of 2 and 1, x^2 - y^2 is
    /// harmonic for weights of 1/4 and 1.
    #[test]
    fn lines_are_straight_and_spacings_count() {
        let nan = f64::NAN;
        let mut line = Array2::from_shape_vec((7, 1), vec![nan, 1.0, nan, nan, 4.0, nan, nan]).unwrap();
        assert_eq!(fill(&mut line, [1.0; 2]), Ok(()));
        for (found, right) in line.iter().zip([1.0, 1.0, 2.0, 3.0, 4.0, 4.0, 4.0]) {
            assert!((found - right).abs() < 1e-11, "{line:?}");
        }
        let surface = Array2::from_shape_fn((9, 9), |(i, j)| (2.0 * i as f64).powi(2) - (j as f64).powi(2));
        let mut holed = surface.clone();
        holed.slice_mut(ndarray::s![2..7, 3..6]).fill(nan);
        assert_eq!(fill(&mut holed, [0.25, 1.0]), Ok(()));
        assert!((&holed - &surface).iter().all(|error| error.abs() < 1e-9));
        assert!(fill(&mut Array2::from_elem((3, 3), nan), [1.0; 2]).is_err());
        assert_eq!(fill(&mut Array2::zeros((3, 3)), [1.0; 2]), Ok(()));
    }
}
