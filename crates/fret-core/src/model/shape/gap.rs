//! The gap that a shape leaves over the surface, and how it changes with the numbers that make the shape.

use super::{Axis, Shape};

impl Shape {
    /// Undeformed gap at a point [length]; infinite where there is no body.
    pub fn gap_at(&self, x: f64, y: f64) -> f64 {
        match *self {
            Self::Sphere { radius } => (x * x + y * y) / (2.0 * radius),
            Self::Ellipsoid { radius_x, radius_y } => x * x / (2.0 * radius_x) + y * y / (2.0 * radius_y),
            Self::Cylinder { radius, axis, length } => {
                let (along, across) = match axis {
                    Axis::X => (x, y),
                    Axis::Y => (y, x),
                };
                match length {
                    Some(length) if 2.0 * along.abs() > length => f64::INFINITY,
                    _ => across * across / (2.0 * radius),
                }
            }
            Self::RoundedPunch { flat_radius, edge_radius } => {
                (x.hypot(y) - flat_radius).max(0.0).powi(2) / (2.0 * edge_radius)
            }
            Self::FlatPunch { radius } => {
                if x.hypot(y) > radius {
                    f64::INFINITY
                } else {
                    0.0
                }
            }
            Self::Cone { slope } => slope * x.hypot(y),
            Self::SpheroCone { radius, slope } => {
                let (r, turn) = (x.hypot(y), radius * slope);
                if r <= turn { r * r / (2.0 * radius) } else { slope * (r - 0.5 * turn) }
            }
            Self::WornSphere { radius, flat_radius } => {
                let r = x.hypot(y);
                if r <= flat_radius { 0.0 } else { (r - flat_radius) * (r + flat_radius) / (2.0 * radius) }
            }
            Self::Pyramid { sides, slope } => {
                let way = |side: u8| {
                    let (sine, cosine) =
                        (std::f64::consts::TAU * f64::from(side) / f64::from(sides)).sin_cos();
                    cosine * x + sine * y
                };
                slope * (0..sides).map(way).fold(0.0, f64::max)
            }
            Self::RectangularPunch { lengths, edge_radius } => {
                let beyond = |at: f64, length: f64| (at.abs() - 0.5 * length).max(0.0);
                let square = beyond(x, lengths[0]).powi(2) + beyond(y, lengths[1]).powi(2);
                match edge_radius {
                    Some(radius) => square / (2.0 * radius),
                    None if square > 0.0 => f64::INFINITY,
                    None => 0.0,
                }
            }
            Self::CrownedRoller { radius, axis, length, flat_length, crown_radius } => {
                let (along, across) = match axis {
                    Axis::X => (x, y),
                    Axis::Y => (y, x),
                };
                if 2.0 * along.abs() > length {
                    return f64::INFINITY;
                }
                let crowned = (along.abs() - 0.5 * flat_length).max(0.0);
                across * across / (2.0 * radius) + crowned * crowned / (2.0 * crown_radius)
            }
            Self::Wave { amplitude, wavelengths } => {
                let wave = |along: f64, length: Option<f64>| {
                    length.map_or(1.0, |length| (std::f64::consts::TAU * along / length).cos())
                };
                amplitude * (1.0 - wave(x, wavelengths[0]) * wave(y, wavelengths[1]))
            }
            Self::Formula(ref formula) => formula.at(x, y),
        }
    }

    /// Derivative of the gap at a point by one of the numbers that make the shape, called as in a case; `None` where it has no such number, or
    /// none that the gap depends on smoothly.
    pub fn gap_change_at(&self, by: &str, x: f64, y: f64) -> Option<f64> {
        let gap = self.gap_at(x, y);
        match (self, by) {
            (&Self::Sphere { radius } | &Self::Cylinder { radius, .. }, "radius") => {
                Some(if gap.is_finite() { -gap / radius } else { 0.0 })
            }
            (&Self::Ellipsoid { radius_x, .. }, "radius_x") => Some(-x * x / (2.0 * radius_x * radius_x)),
            (&Self::Ellipsoid { radius_y, .. }, "radius_y") => Some(-y * y / (2.0 * radius_y * radius_y)),
            (&Self::RoundedPunch { flat_radius, edge_radius }, "flat_radius") => {
                Some(-(x.hypot(y) - flat_radius).max(0.0) / edge_radius)
            }
            (&Self::RoundedPunch { edge_radius, .. }, "edge_radius") => Some(-gap / edge_radius),
            (&Self::Cone { slope }, "slope") => Some(gap / slope),
            (&Self::Wave { amplitude, .. }, "amplitude") => Some(gap / amplitude),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What a pyramid displaces up to a height: a third of its base, a polygon around a circle, times the height. By sums over a lattice.
    #[test]
    fn a_pyramid_has_the_volume_of_a_pyramid() {
        for (sides, slope) in [(3, 0.46), (4, 0.4), (5, 0.1)] {
            let pyramid = Shape::Pyramid { sides, slope };
            let (height, cells, side) = (1.0, 600_i32, 2.2 / slope * 2.0);
            let step = side / f64::from(cells);
            let at = |n: i32| (f64::from(n) + 0.5) * step - 0.5 * side;
            let below = |x: f64, y: f64| (height - pyramid.gap_at(x, y)).max(0.0);
            let sum: f64 = (0..cells)
                .flat_map(|i| (0..cells).map(move |j| (i, j)))
                .map(|(i, j)| below(at(i), at(j)))
                .sum();
            let angle = std::f64::consts::PI / f64::from(sides);
            let base = f64::from(sides) * angle.tan() * (height / slope).powi(2);
            // the rule of midpoints: the square of a cell over the size, at the edges
            assert!((sum * step * step / (base * height / 3.0) - 1.0).abs() < 1e-4, "{sides}");
        }
    }

    /// Many sides make a cone: a polygon around a circle is larger by the square of its angle.
    #[test]
    fn a_pyramid_of_many_sides_is_a_cone_and_a_small_tip_too() {
        let cone = Shape::Cone { slope: 0.3 };
        let pyramid = Shape::Pyramid { sides: 240, slope: 0.3 };
        let rounded = Shape::SpheroCone { radius: 1e-6, slope: 0.3 };
        for (x, y) in [(1.0, 0.0), (0.3, -0.7), (-2.0, 0.11)] {
            let exact = cone.gap_at(x, y);
            let less = 1.0 - pyramid.gap_at(x, y) / exact;
            assert!((0.0..0.5 * (std::f64::consts::PI / 240.0).powi(2) + 1e-12).contains(&less), "{less}");
            // lower by half of what the tip lacks, slope^2 R / 2
            assert!((exact - rounded.gap_at(x, y) - 0.5 * 0.09e-6).abs() < 1e-12);
        }
        let sphere = Shape::Sphere { radius: 2.0 };
        let wide = Shape::SpheroCone { radius: 2.0, slope: 10.0 };
        let whole = Shape::WornSphere { radius: 2.0, flat_radius: 1e-9 };
        for (x, y) in [(0.0, 0.0), (1.0, 0.5), (0.3, -0.7)] {
            assert!((wide.gap_at(x, y) - sphere.gap_at(x, y)).abs() < 1e-15);
            assert!((whole.gap_at(x, y) - sphere.gap_at(x, y)).abs() < 1e-15);
        }
    }

    #[test]
    fn a_roller_without_a_crown_is_a_cylinder_and_one_that_is_crowned_all_along_an_ellipsoid() {
        let roller = |flat_length: f64| Shape::CrownedRoller {
            radius: 2.0,
            axis: Axis::Y,
            length: 4.0,
            flat_length,
            crown_radius: 50.0,
        };
        let cylinder = Shape::Cylinder { radius: 2.0, axis: Axis::Y, length: Some(4.0) };
        let ellipsoid = Shape::Ellipsoid { radius_x: 2.0, radius_y: 50.0 };
        for (x, y) in [(0.0, 0.0), (0.3, 1.9), (-0.4, -2.0)] {
            assert_eq!(roller(4.0).gap_at(x, y), cylinder.gap_at(x, y));
            assert!((roller(0.0).gap_at(x, y) - ellipsoid.gap_at(x, y)).abs() < 1e-15);
        }
        assert_eq!(roller(0.0).gap_at(0.0, 2.1), f64::INFINITY);
    }
}
