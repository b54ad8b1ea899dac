//! The smallest ball around points in the space of stress deviators.

/// Dimensions of the space of deviators.
pub(super) const DIMENSIONS: usize = 5;

/// A point of that space.
pub(super) type Point = [f64; DIMENSIONS];

/// A ball through some points, added one by one (Gärtner 1999, Fast and robust smallest enclosing balls).
#[derive(Clone, Default)]
struct Boundary {
    count: usize,
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
        next.count = m + 1;
        Some(next)
    }
}

/// Smallest ball of `points[..end]` with the boundary's points on it; points that had to go on the boundary move to the front.
fn smallest(points: &mut [Point], end: usize, boundary: &Boundary, scale: f64) -> (Point, f64) {
    let mut ball = boundary.ball();
    if boundary.count == DIMENSIONS + 1 {
        return ball;
    }
    for index in 0..end {
        let away = minus(&points[index], &ball.0);
        if dot(&away, &away) > ball.1 + 1e-13 * scale
            && let Some(next) = boundary.with(&points[index], scale)
        {
            ball = smallest(points, index, &next, scale);
            points[..=index].rotate_right(1);
        }
    }
    ball
}

/// Centre of the smallest ball around points.
pub(super) fn centre(points: &[Point]) -> Point {
    let Some(first) = points.first() else { return [0.0; DIMENSIONS] };
    let scale =
        points.iter().map(|point| dot(&minus(point, first), &minus(point, first))).fold(0.0, f64::max);
    if scale == 0.0 {
        return *first;
    }
    smallest(&mut points.to_vec(), points.len(), &Boundary::default(), scale).0
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
