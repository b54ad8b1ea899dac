//! The open rim of a contact: how far inside of it a cell lies. Air comes from beyond the grid, through cells that do not touch; a
//! pocket within the contact is closed.

use ndarray::Array2;

use crate::model::{RimRule, SurfaceGrid, Symmetry};

/// Part of a wear coefficient that is in force in each cell.
#[derive(Debug, Clone)]
pub struct OpenRim {
    width: f64,
    interior: f64,
    spacing: [f64; 2],
    /// Side of a square of the area of a cell, width of a strip [length].
    side: f64,
    /// Whether there is anything beyond the first and the last cell along each axis: not along a line contact, and not at a mirror.
    open_ends: [[bool; 2]; 2],
}

impl OpenRim {
    /// Of contacts on a grid, whose mirrors lie before its first cells; for one body (0: lower, 1: upper).
    pub fn new(rule: &RimRule, body: usize, grid: &SurfaceGrid, symmetry: Symmetry) -> Self {
        let mirrored = symmetry.axes();
        let (spacing, dimension) = (grid.spacing(), grid.dimension());
        let open_ends = dimension.along(|axis| [!mirrored[axis], true], [false; 2]);
        let side = dimension.cell_side(spacing);
        Self { width: rule.width, interior: rule.interior[body], spacing, side, open_ends }
    }

    /// Wear coefficient in each cell over that at the rim: the mean over the cell of 1 within the width and of another number farther inside.
    pub fn factors(&self, pressure: &Array2<f64>) -> Array2<f64> {
        self.squares_to_open(pressure).mapv(|square| {
            let within = self.within(square).clamp(0.0, 1.0);
            within + (1.0 - within) * self.interior
        })
    }

    /// The same with its derivatives by the width and by the number farther inside. With the pressure it changes where a cell opens or touches alone.
    pub fn slopes(&self, pressure: &Array2<f64>) -> Array2<[f64; 3]> {
        self.squares_to_open(pressure).mapv(|square| {
            let whole = self.within(square);
            let within = whole.clamp(0.0, 1.0);
            let by_width = if within == whole { (1.0 - self.interior) / self.side } else { 0.0 };
            [within + (1.0 - within) * self.interior, by_width, 1.0 - within]
        })
    }

    /// Part of a cell within the width, at a square of its distance: below 0 and above 1 none and all of it. Half a cell lies between the centre of
    /// the open cell and the rim.
    fn within(&self, square: f64) -> f64 {
        (self.width - square.sqrt()) / self.side + 1.0
    }

    /// Squares of the distances from each cell to the nearest one that is open to the air, centre to centre [length^2].
    ///
    /// Felzenszwalb & Huttenlocher (2012), Theory Comput. 8, 415: exact, line by line along one axis and then along the other. Behind a mirror no
    /// cell is nearer than its image.
    fn squares_to_open(&self, pressure: &Array2<f64>) -> Array2<f64> {
        let (nx, ny) = pressure.dim();
        let open = self.open_to_air(pressure);
        let mut squares =
            Array2::from_shape_fn((nx + 2, ny + 2), |at| if open[at] { 0.0 } else { f64::INFINITY });
        for (axis, spacing) in self.spacing.into_iter().enumerate() {
            for mut lane in squares.lanes_mut(ndarray::Axis(axis)) {
                let nearest = lower_envelope(&lane.to_vec(), spacing);
                lane.iter_mut().zip(nearest).for_each(|(to, square)| *to = square);
            }
        }
        Array2::from_shape_fn((nx, ny), |(i, j)| squares[[i + 1, j + 1]])
    }

    /// Cells that air comes to, in a grid with one more cell beyond each end.
    fn open_to_air(&self, pressure: &Array2<f64>) -> Array2<bool> {
        let (nx, ny) = pressure.dim();
        let [[left, right], [front, back]] = self.open_ends;
        let beyond = |i: usize, j: usize| {
            let inside = [(1..=nx).contains(&i), (1..=ny).contains(&j)];
            (i == 0 && left || i > nx && right) && inside[1]
                || (j == 0 && front || j > ny && back) && inside[0]
        };
        let mut open = Array2::from_shape_fn((nx + 2, ny + 2), |(i, j)| beyond(i, j));
        let mut next: Vec<[usize; 2]> =
            open.indexed_iter().filter(|(_, open)| **open).map(|((i, j), _)| [i, j]).collect();
        while let Some([i, j]) = next.pop() {
            for [i, j] in [[i.wrapping_sub(1), j], [i + 1, j], [i, j.wrapping_sub(1)], [i, j + 1]] {
                let is_inside = (1..=nx).contains(&i) && (1..=ny).contains(&j);
                if is_inside && !open[[i, j]] && pressure[[i - 1, j - 1]] <= 0.0 {
                    open[[i, j]] = true;
                    next.push([i, j]);
                }
            }
        }
        open
    }
}

/// For each place of a line the least of what other places have and the square of the distance to them.
fn lower_envelope(line: &[f64], spacing: f64) -> Vec<f64> {
    let mut lowest: Vec<usize> = Vec::with_capacity(line.len()); // parabolas of the envelope
    let mut from: Vec<f64> = Vec::with_capacity(line.len()); // where each of them begins
    let height = |at: usize| line[at] / (spacing * spacing) + (at * at) as f64;
    for place in (0..line.len()).filter(|place| line[*place].is_finite()) {
        let mut begins = f64::NEG_INFINITY;
        while let (Some(last), Some(its)) = (lowest.last(), from.last()) {
            begins = 0.5 * (height(place) - height(*last)) / (place - last) as f64;
            if begins > *its {
                break;
            }
            lowest.pop();
            from.pop();
            begins = f64::NEG_INFINITY;
        }
        lowest.push(place);
        from.push(begins);
    }
    let mut parabola = 0;
    (0..line.len())
        .map(|place| {
            while from.get(parabola + 1).is_some_and(|begins| *begins < place as f64) {
                parabola += 1;
            }
            lowest.get(parabola).map_or(f64::INFINITY, |lowest| {
                line[*lowest] + (spacing * (place as f64 - *lowest as f64)).powi(2)
            })
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rim(width: f64, grid: &SurfaceGrid, symmetry: Symmetry) -> OpenRim {
        OpenRim::new(&RimRule { width, interior: [0.25; 2] }, 0, grid, symmetry)
    }

    /// Every pair of cells, one by one.
    #[test]
    fn distances_are_those_of_all_pairs() {
        let grid = SurfaceGrid::new([14, 11], [0.3, 0.5]).unwrap();
        // an ellipse with a closed pocket, and a piece apart
        let pressure = Array2::from_shape_fn((14, 11), |(i, j)| {
            let (x, y) = (i as f64 - 6.3, j as f64 - 4.8);
            let ring = (x / 6.0).powi(2) + (y / 4.2).powi(2) < 1.0 && x * x + y * y > 2.0;
            if ring || (i, j) == (13, 10) { 1.0 } else { 0.0 }
        });
        assert!(pressure[[6, 5]] == 0.0); // the pocket
        let rim = rim(0.6, &grid, Symmetry::NONE);
        let found = rim.squares_to_open(&pressure);
        let is_open = |i: isize, j: isize| {
            let inside = (0..14).contains(&i) && (0..11).contains(&j);
            let pocket = (i as f64 - 6.3).powi(2) + (j as f64 - 4.8).powi(2) <= 2.0;
            !inside || pressure[[i as usize, j as usize]] == 0.0 && !pocket
        };
        for ((i, j), found) in found.indexed_iter() {
            let mut least = f64::INFINITY;
            for (k, l) in
                (-1..15).flat_map(|k| (-1..12).map(move |l| (k, l))).filter(|(k, l)| is_open(*k, *l))
            {
                // air beyond the grid lies beside it, not across its corners
                if (0..14).contains(&k) || (0..11).contains(&l) {
                    let [x, y] = [0.3 * (k as f64 - i as f64), 0.5 * (l as f64 - j as f64)];
                    least = least.min(x * x + y * y);
                }
            }
            // rounding of squares of at most 8
            assert!((found - least).abs() < 1e-13, "{i} {j}: {found} {least}");
        }
    }

    /// A pad that fills its grid: a rim of 2.6 cells is 2.6 cells wide.
    #[test]
    fn a_rim_of_parts_of_cells_has_its_width() {
        let line = SurfaceGrid::line(20, 0.1).unwrap();
        let factors = rim(0.26, &line, Symmetry::NONE).factors(&Array2::ones((20, 1)));
        for (i, part) in [1.0, 1.0, 0.6, 0.0].into_iter().enumerate() {
            let expected = part + (1.0 - part) * 0.25;
            assert!(
                (factors[[i, 0]] - expected).abs() < 1e-14 && (factors[[19 - i, 0]] - expected).abs() < 1e-14
            );
        }
        assert!(factors.iter().skip(3).take(14).all(|factor| *factor == 0.25));
        // without contact there is air everywhere
        assert!(
            rim(0.26, &line, Symmetry::NONE)
                .factors(&Array2::zeros((20, 1)))
                .iter()
                .all(|factor| *factor == 1.0)
        );
    }

    #[test]
    fn a_part_in_front_of_mirrors_has_the_distances_of_the_whole() {
        let grid = SurfaceGrid::new([16, 12], [0.2, 0.2]).unwrap();
        let disc = Array2::from_shape_fn((16, 12), |(i, j)| {
            let square = (i as f64 - 7.5).powi(2) + (j as f64 - 5.5).powi(2);
            if square < 28.0 && square > 3.0 { 1.0 } else { 0.0 }
        });
        let whole = rim(0.5, &grid, Symmetry::NONE).squares_to_open(&disc);
        for odd_shear in [[Some(0), Some(1)], [None, Some(1)], [Some(0), None]] {
            let symmetry = Symmetry { odd_shear };
            let part = rim(0.5, &grid, symmetry).squares_to_open(&symmetry.part(&disc));
            assert_eq!(part, symmetry.part(&whole));
        }
    }
}
