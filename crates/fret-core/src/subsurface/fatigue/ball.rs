//! The smallest ball around points in the space of stress deviators.

use crate::fields::solved;

/// Dimensions of the space of deviators.
pub(super) const DIMENSIONS: usize = 5;

/// A point of that space.
pub(super) type Point = [f64; DIMENSIONS];

/// A ball through some points, added one by one (Gärtner 1999, Fast and robust smallest enclosing balls).
#[derive(Clone, Default)]
struct Boundary {
    count: usize,
    on: [Point; DIMENSIONS + 1],
    origin: Point,
    directions: [Point; DIMENSIONS + 1],
    twice_squares: [f64; DIMENSIONS + 1],
    centres: [Point; DIMENSIONS + 1],
    squares: [f64; DIMENSIONS + 1],
}

fn minus(a: &Point, b: &Point) -> Point {
    std::array::from_fn(|n| a[n] - b[n])
}

fn dot(a: &Point, b: &Point) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

impl Boundary {
    /// Centre and squared radius; a squared radius below zero for no point.
    fn ball(&self) -> (Point, f64) {
        match self.count {
            0 => ([0.0; DIMENSIONS], -1.0),
            count => (self.centres[count - 1], self.squares[count - 1]),
        }
    }

    /// The ball through one more point; `None` when that lies in the space of the others.
    fn with(&self, point: &Point, scale: f64) -> Option<Self> {
        let mut next = self.clone();
        let m = self.count;
        if m == 0 {
            next.origin = *point;
            next.centres[0] = *point;
            next.squares[0] = 0.0;
        } else {
            let mut direction = minus(point, &self.origin);
            for i in 1..m {
                let share = 2.0 / self.twice_squares[i] * dot(&self.directions[i], &direction);
                for n in 0..DIMENSIONS {
                    direction[n] -= share * self.directions[i][n];
                }
            }
            let twice = 2.0 * dot(&direction, &direction);
            if twice <= 1e-24 * scale {
                return None;
            }
            let away = minus(point, &self.centres[m - 1]);
            let excess = dot(&away, &away) - self.squares[m - 1];
            let share = excess / twice;
            next.directions[m] = direction;
            next.twice_squares[m] = twice;
            next.centres[m] = std::array::from_fn(|n| self.centres[m - 1][n] + share * direction[n]);
            next.squares[m] = self.squares[m - 1] + 0.5 * excess * share;
        }
        next.on[m] = *point;
        next.count = m + 1;
        Some(next)
    }
}

/// Smallest ball of `points[..end]` with the boundary's points on it; points that had to go on the boundary move to the front.
fn smallest(points: &mut [Point], end: usize, boundary: &Boundary, scale: f64) -> Boundary {
    let mut found = boundary.clone();
    if boundary.count == DIMENSIONS + 1 {
        return found;
    }
    for index in 0..end {
        let (centre, square) = found.ball();
        let away = minus(&points[index], &centre);
        if dot(&away, &away) > square + 1e-13 * scale
            && let Some(next) = boundary.with(&points[index], scale)
        {
            found = smallest(points, index, &next, scale);
            points[..=index].rotate_right(1);
        }
    }
    found
}

/// Centre of the smallest ball around points.
pub(super) fn centre(points: &[Point]) -> Point {
    Ball::around(points).centre
}

/// The smallest ball around points.
pub(super) struct Ball {
    /// Its centre.
    pub centre: Point,
    /// Points on it that hold it, each with its share of the centre.
    pub held: Vec<(Point, f64)>,
    /// Their ways from the centre over a length of their size, that length, and twice the products of these ways, bordered by ones.
    ways: Vec<Point>,
    length: f64,
    matrix: Matrix,
}

/// Points that can hold a ball, and one.
const UNKNOWNS: usize = DIMENSIONS + 2;
type Matrix = [[f64; UNKNOWNS]; UNKNOWNS];
/// Ways that differ by less than a millionth of the ball are one.
const LEAST: f64 = 1e-12;

/// The products of ways, bordered by ones.
fn bordered(ways: &[Point]) -> Matrix {
    let mut matrix = [[0.0; UNKNOWNS]; UNKNOWNS];
    for (n, way) in ways.iter().enumerate() {
        for (m, other) in ways.iter().enumerate() {
            matrix[n][m] = 2.0 * dot(way, other);
        }
        (matrix[n][UNKNOWNS - 1], matrix[UNKNOWNS - 1][n]) = (1.0, 1.0);
    }
    matrix
}

impl Ball {
    /// That around some points.
    pub fn around(points: &[Point]) -> Self {
        let alone = |point: Point| Self {
            centre: point,
            held: vec![(point, 1.0)],
            ways: vec![[0.0; DIMENSIONS]],
            length: 1.0,
            matrix: bordered(&[[0.0; DIMENSIONS]]),
        };
        let Some(first) = points.first() else { return alone([0.0; DIMENSIONS]) };
        let scale =
            points.iter().map(|point| dot(&minus(point, first), &minus(point, first))).fold(0.0, f64::max);
        if scale == 0.0 {
            return alone(*first);
        }
        let boundary = smallest(&mut points.to_vec(), points.len(), &Boundary::default(), scale);
        let centre = boundary.ball().0;
        let on = &boundary.on[..boundary.count];
        let length = scale.sqrt();
        let ways: Vec<Point> =
            on.iter().map(|point| minus(point, &centre).map(|part| part / length)).collect();
        let matrix = bordered(&ways);
        let mut right = [0.0; UNKNOWNS];
        right[UNKNOWNS - 1] = 1.0;
        let shares = solved(matrix, right, LEAST);
        Self { centre, held: on.iter().copied().zip(shares).collect(), ways, length, matrix }
    }

    /// How the radius changes with each of the points that hold the ball.
    pub fn radius_by_points(&self) -> Vec<Point> {
        let of = |((_, share), way): (&(Point, f64), &Point)| {
            let size = dot(way, way).sqrt();
            way.map(|part| if size > 0.0 { share * part / size } else { 0.0 })
        };
        self.held.iter().zip(&self.ways).map(of).collect()
    }

    /// How a number that changes `by` the centre changes with each of the points that hold the ball. Each stays as far from the centre as the
    /// others, and the centre stays between them.
    pub fn by_points(&self, by: &Point) -> Vec<Point> {
        let mut right = [0.0; UNKNOWNS];
        for (right, way) in right.iter_mut().zip(&self.ways) {
            *right = self.length * dot(by, way);
        }
        // The matrix is its own transpose.
        let weights = solved(self.matrix, right, LEAST);
        let pull = |way: &Point, weight: f64| way.map(|part| 2.0 * weight * part / self.length);
        let pulls: Vec<Point> =
            self.ways.iter().zip(weights).map(|(way, weight)| pull(way, weight)).collect();
        let left: Point = std::array::from_fn(|n| by[n] - pulls.iter().map(|pull| pull[n]).sum::<f64>());
        let of =
            |((_, share), pull): (&(Point, f64), &Point)| std::array::from_fn(|n| share * left[n] + pull[n]);
        self.held.iter().zip(&pulls).map(of).collect()
    }
}

/// Radius of the smallest ball around points: the distance of the farthest from its centre.
pub(super) fn farthest_from_centre(points: &[Point]) -> f64 {
    let centre = centre(points);
    let square = |point: &Point| dot(&minus(point, &centre), &minus(point, &centre));
    points.iter().map(square).fold(0.0, f64::max).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn simple_balls_are_found() {
        let two = centre(&[[1.0, 0.0, 0.0, 0.0, 0.0], [-3.0, 2.0, 0.0, 0.0, 0.0]]);
        assert_eq!(two, [-1.0, 1.0, 0.0, 0.0, 0.0]);
        // points on a sphere, its poles among them
        let mut points = Vec::new();
        for axis in 0..5 {
            for sign in [-1.0, 1.0] {
                let mut point = [0.5, -1.0, 2.0, 0.0, 0.25];
                point[axis] += sign * 3.0;
                points.push(point);
            }
        }
        points.push([0.4, -1.0, 2.0, 0.1, 0.2]);
        let found = centre(&points);
        for (found, exact) in found.iter().zip([0.5, -1.0, 2.0, 0.0, 0.25]) {
            assert!((found - exact).abs() < 1e-12);
        }
    }

    /// Centre and radius against differences, with all points moved at random; what holds the ball adds up to its centre. 1e-6: differences of
    /// 1e-6 in cases where hardly a point comes or goes.
    #[test]
    fn the_ball_moves_with_its_points() {
        let mut random = crate::random::Random::seeded(8);
        for case in 0..60 {
            let mut point = || -> Point { std::array::from_fn(|_| random.between(-1.0, 1.0)) };
            let points: Vec<Point> = (0..2 + case % 12).map(|_| point()).collect();
            let ways: Vec<Point> = points.iter().map(|_| point()).collect();
            let by = point();
            let ball = Ball::around(&points);
            let shares: f64 = ball.held.iter().map(|(_, share)| share).sum();
            assert!((shares - 1.0).abs() < 1e-10 && ball.held.iter().all(|(_, share)| *share > -1e-10));
            let at = |step: f64| {
                let moved: Vec<Point> = points
                    .iter()
                    .zip(&ways)
                    .map(|(point, way)| std::array::from_fn(|n| point[n] + step * way[n]))
                    .collect();
                [dot(&by, &centre(&moved)), farthest_from_centre(&moved)]
            };
            let place = |held: &Point| points.iter().position(|point| point == held).unwrap();
            let along = |by: Vec<Point>| -> f64 {
                ball.held.iter().zip(by).map(|((held, _), by)| dot(&by, &ways[place(held)])).sum()
            };
            let found = [along(ball.by_points(&by)), along(ball.radius_by_points())];
            let (up, down) = (at(1e-6), at(-1e-6));
            for n in 0..2 {
                let expected = (up[n] - down[n]) / 2e-6;
                assert!(
                    (found[n] - expected).abs() < 1e-6 * (1.0 + expected.abs()),
                    "{case} {n}: {found:?} {expected}"
                );
            }
        }
    }

    #[test]
    fn no_point_lies_outside_and_no_smaller_ball_does_it() {
        let mut seed = 5_u64;
        let mut random = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (seed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
        };
        for _ in 0..200 {
            let points: Vec<Point> = (0..40).map(|_| std::array::from_fn(|_| random())).collect();
            let centre = centre(&points);
            let farthest = |from: &Point| {
                points.iter().map(|p| dot(&minus(p, from), &minus(p, from))).fold(0.0, f64::max)
            };
            let radius = farthest(&centre);
            // the function `farthest` is convex: no step in any direction lowers it
            for axis in 0..5 {
                for sign in [-1e-4, 1e-4] {
                    let mut moved = centre;
                    moved[axis] += sign;
                    assert!(farthest(&moved) >= radius * (1.0 - 1e-12));
                }
            }
        }
    }
}
